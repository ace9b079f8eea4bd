/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strips of one line or arc whose width varies, beside solids: tests/data/hinge/varying.csv, made by
   tools/solids as those of one width are (test_root_strain.c), E 150 GPa, nothing fitted to them.
   Peak strain per radian and stiffness lie within what the closed form states of its own errors, and
   these are not so wide that they say nothing. */
#include "solid_input.h"
#include "test.h"

typedef struct row { /* um, deg, 1/rad, N m/rad */
    solid_shape shape;
    double middle, strain, stiffness;
} row;

enum { MOST = 200 };

static int rows_of(row *rows) {
    char line[256], kind[16];
    int n = 0;
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/hinge/varying.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (row *r = rows; n < MOST && fgets(line, sizeof line, file); r++, n++) {
        assert_int_equal(
            sscanf(line, "%15[^,],isotropic,%lf,%lf,%lf,%lf,%lf,%lf,%*f,%lf,%*d,%lf,%lf", kind,
                   &r->shape.size, &r->shape.width, &r->shape.angle, &r->shape.fillet,
                   &r->shape.depth, &r->shape.poisson, &r->strain, &r->stiffness, &r->middle),
            10);
        assert_true((strcmp(kind, "leaf") == 0) == (r->shape.angle == 0));
    }
    fclose(file);
    return n;
}

static fw_flexure_result closed_form(const row *r) {
    fw_flexure_input in = solid_input(&r->shape);
    in.width_middle_m = r->middle * 1e-6;
    fw_flexure_result out;
    fw_flexure_closed_form(&in, &out);
    return out;
}

static void solids_lie_within_the_errors(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows), wider = 0;
    double down = 0, up = 0, sum = 0;
    for (int i = 0; i < n; i++) {
        const fw_flexure_result o = closed_form(&rows[i]);
        double strain = rows[i].strain / o.strain_per_rad - 1;
        double stiffness = rows[i].stiffness / o.stiffness_Nm_per_rad - 1;
        if (!(strain >= -o.error.strain && strain <= o.error.above))
            fail_msg("row %d: strain %.4f, stated -%.4f to %.4f", i + 2, strain, o.error.strain,
                     o.error.above);
        if (!(stiffness >= -o.error.softer && stiffness <= o.error.stiffness))
            fail_msg("row %d: stiffness %.4f, stated -%.4f to %.4f", i + 2, stiffness,
                     o.error.softer, o.error.stiffness);
        down = fmin(down, strain), up = fmax(up, strain), sum += o.error.stiffness;
        wider += rows[i].middle > rows[i].shape.width;
    }
    assert_true(n > 50 && wider > 15 && n - wider > 15);
    assert_true(down < -0.05 && up < 0.008); /* a strip that opens is far below, none far above */
    assert_true(sum / n < 0.01);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(solids_lie_within_the_errors)};
    return cmocka_run_group_tests_name("varying", tests, NULL, NULL);
}
