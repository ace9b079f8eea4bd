/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strips of one line or arc whose width varies, beside solids: tests/data/hinge/varying.csv, made by
   tools/solids as those of one width are (test_root_strain.c), E 150 GPa, nothing fitted to them.
   Peak strain per radian and stiffness lie within what the closed form states of its own errors, and
   these are not so wide that they say nothing. The narrower errors of a verdict, which go by the place of the
   peak and by strain per moment, hold those of varying_after.csv, too, which were drawn and solved afterwards. */
#include "placed.h"
#include "test.h"
#include <string.h>

typedef struct row { /* um, deg, 1/rad, N m/rad */
    solid_shape shape;
    double middle, strain, stiffness, axis; /* axis: of silicon, from [100] */
    bool silicon;
} row;

enum { MOST = 200 };

static int rows_in(const char *path, row *rows) {
    char line[256], kind[16], material[16];
    int n = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (row *r = rows; n < MOST && fgets(line, sizeof line, file); r++, n++) {
        assert_int_equal(
            sscanf(line, "%15[^,],%15[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%*d,%lf,%lf", kind,
                   material, &r->shape.size, &r->shape.width, &r->shape.angle, &r->shape.fillet,
                   &r->shape.depth, &r->shape.poisson, &r->axis, &r->strain, &r->stiffness,
                   &r->middle),
            12);
        r->silicon = strcmp(material, "silicon") == 0;
        assert_true((strcmp(kind, "leaf") == 0) == (r->shape.angle == 0));
    }
    fclose(file);
    return n;
}

static int rows_of(row *rows) {
    return rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/varying.csv", rows);
}

static int after(row *rows) {
    return rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/varying_after.csv", rows);
}

static fw_flexure_input input_of(const row *r) {
    fw_flexure_input in = solid_input(&r->shape);
    in.width_middle_m = r->middle * 1e-6;
    if (r->silicon)
        in.crystal = fw_flexure_crystal_cubic(165.7e9, 63.9e9, 79.6e9, r->axis * FW_PI / 180);
    return in;
}

static fw_flexure_result closed_form(const row *r, bool ends) {
    fw_flexure_input in = input_of(r);
    fw_flexure_result out;
    in.ends = ends;
    fw_flexure_closed_form(&in, &out);
    return out;
}

static void within_the_errors(bool ends) {
    static row rows[MOST];
    int n = rows_of(rows), wider = 0;
    double down = 0, up = 0, sum = 0;
    for (int i = 0; i < n; i++) {
        const fw_flexure_result o = closed_form(&rows[i], ends);
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
    assert_true(sum / n < (ends ? 0.005 : 0.01));
}

static void solids_lie_within_the_errors(void **state) {
    (void)state;
    within_the_errors(false);
    within_the_errors(true);
}

static void placed(bool ends) {
    static row rows[MOST];
    int n = rows_of(rows), wide = 0;
    const int first = n;
    n += after(rows + n);
    assert_true(first > 50 && n - first > 30);
    double narrower = 0;
    for (int i = 0; i < n; i++) {
        fw_flexure_input in = input_of(&rows[i]);
        const fw_flexure_result o = closed_form(&rows[i], ends);
        in.ends = ends;
        const double width = placed_width(&in, rows[i].strain, rows[i].stiffness, i + 2);
        if (o.error.above > 0.1) wide++;
        else
            narrower +=
                o.error.strain + o.error.above + o.error.root_less + o.error.root_more - width;
    }
    assert_true(wide < 10 && narrower / (n - wide) > 0.02);
}

static void by_the_place_of_the_peak(void **state) {
    (void)state;
    placed(false);
    placed(true);
}

/* Leaves of silicon that open in any direction, and that are thin in their middle along <100> and <110>, where the
   middle section of a solid is plane by itself. Nothing was fitted to them, but one figure for those that open */
static void leaves_of_silicon(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_in(FW_TEST_SOURCE_DIR "/tests/data/hinge/varying_silicon.csv", rows), opening = 0;
    for (int i = 0; i < n; i++) {
        const fw_flexure_input in = input_of(&rows[i]);
        placed_width(&in, rows[i].strain, rows[i].stiffness, i + 2);
        opening += rows[i].middle > rows[i].shape.width;
    }
    assert_true(opening >= 12 && n - opening >= 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(solids_lie_within_the_errors),
                                       cmocka_unit_test(by_the_place_of_the_peak),
                                       cmocka_unit_test(leaves_of_silicon)};
    return cmocka_run_group_tests_name("varying", tests, NULL, NULL);
}
