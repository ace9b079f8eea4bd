/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strips of two or three lines and arcs beside solids of full depth: tests/data/hinge/paths.csv, made by
   tests/judge/paths.py with a mesh that is not the product's, E 150 GPa, nothing fitted to them. Peak
   strain per radian and stiffness lie within what the closed form states of its own errors, and with
   the ends of (13a) the stiffness is nearer. */
#include "placed.h"
#include "test.h"
#include <string.h>

enum { PIECES = 3, MOST = 200 };

typedef struct row {
    fw_geometry_strip_piece piece[PIECES];
    fw_flexure_input input;
    double stiffness, strain;
} row;

static int rows_of(row *rows) {
    char line[512];
    int n = 0;
    FILE *file = fopen(FW_TEST_SOURCE_DIR "/tests/data/hinge/paths.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file)); /* the head */
    for (row *r = rows; n < MOST && fgets(line, sizeof line, file); r++, n++) {
        double fillet, depth, poisson;
        int at, pieces = 0;
        assert_int_equal(sscanf(line, "%*d,%lf,%lf,%lf,%lf,%lf,%n", &fillet, &depth, &poisson,
                                &r->stiffness, &r->strain, &at),
                         5);
        for (const char *p = line + at; *p && pieces < PIECES; pieces++) {
            double length, curvature, first, last;
            int used;
            assert_int_equal(
                sscanf(p, "%lf:%lf:%lf:%lf%n", &length, &curvature, &first, &last, &used), 4);
            r->piece[pieces] = (fw_geometry_strip_piece){
                length * 1e-6,
                curvature * 1e6,
                {first * 1e-6, 0.5e-6 * (first + last), last * 1e-6}};
            p += used;
            if (*p != ';') p = "";
            else p++;
        }
        assert_true(pieces > 1);
        double length = 0;
        for (int i = 0; i < pieces; i++)
            length += r->piece[i].length_m;
        r->input = (fw_flexure_input){.kind = FW_FLEXURE_PATH,
                                      .piece = r->piece,
                                      .npiece = pieces,
                                      .length_m = length,
                                      .width_m = r->piece[0].width_m[0],
                                      .fillet_m = fillet * 1e-6,
                                      .depth_m = depth * 1e-6,
                                      .youngs_Pa = 150e9,
                                      .poisson = poisson,
                                      .strength_Pa = 500e6,
                                      .safety_factor = 1};
    }
    fclose(file);
    return n;
}

static void solids_lie_within_the_errors(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows);
    double stated = 0, narrow = 0, up = -1;
    for (int i = 0; i < n; i++) {
        fw_flexure_result o, with;
        fw_flexure_closed_form(&rows[i].input, &o);
        rows[i].input.ends = true;
        fw_flexure_closed_form(&rows[i].input, &with);
        double strain = rows[i].strain / o.strain_per_rad - 1;
        double stiffness = rows[i].stiffness / o.stiffness_Nm_per_rad - 1;
        double ends = rows[i].stiffness / with.stiffness_Nm_per_rad - 1;
        if (!(strain >= -o.error.strain && strain <= o.error.above))
            fail_msg("row %d: strain %.4f, stated -%.4f to %.4f", i + 2, strain, o.error.strain,
                     o.error.above);
        if (!(stiffness >= -o.error.softer && stiffness <= o.error.stiffness))
            fail_msg("row %d: stiffness %.4f, stated -%.4f to %.4f", i + 2, stiffness,
                     o.error.softer, o.error.stiffness);
        if (!(ends >= -with.error.softer && ends <= with.error.stiffness && fabs(ends) < 0.004))
            fail_msg("row %d: stiffness with ends %.4f, stated %.4f", i + 2, ends,
                     with.error.stiffness);
        up = fmax(up, strain), stated += o.error.stiffness, narrow += with.error.stiffness;
    }
    /* they do not say so little that it is true of anything, and the mesh has at most 1 % too little strain */
    assert_true(n >= 30 && up < 0 && up > -0.01);
    assert_true(stated / n < 0.015 && narrow / n < 0.008);
}

static void by_the_place_of_the_peak(void **state) {
    (void)state;
    static row rows[MOST];
    int n = rows_of(rows);
    double narrower = 0;
    for (int i = 0; i < 2 * n; i++) {
        fw_flexure_result o;
        rows[i % n].input.ends = i >= n;
        fw_flexure_closed_form(&rows[i % n].input, &o);
        const double width =
            placed_width(&rows[i % n].input, rows[i % n].strain, rows[i % n].stiffness, i % n + 2);
        narrower += o.error.strain + o.error.above + o.error.root_less + o.error.root_more - width;
    }
    assert_true(narrower / (2 * n) > 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(solids_lie_within_the_errors),
                                       cmocka_unit_test(by_the_place_of_the_peak)};
    return cmocka_run_group_tests_name("paths", tests, NULL, NULL);
}
