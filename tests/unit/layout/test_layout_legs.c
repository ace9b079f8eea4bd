/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Leaves whose axis the layout chooses: it says where it turns one off the leg that it holds and that decides what
   moves (FW-D653), and is silent where the leaf is a pivot. */
#include "fixture.h"
#include "layout/layout.h"
#include "test.h"
#include <math.h>
#include <string.h>

static void leaf(fixture *f, int i, const char *id, int a, int b, double x_mm, double y_mm) {
    fixture_hinge(f, i, id, a, b, 1e-3 * x_mm, 1e-3 * y_mm, 400e-6, 8e-6, 1);
    f->flexure[i].kind = FW_FLEXURE_LEAF;
    f->flexure[i].angle_rad = f->flexure[i].radius_m = NONE;
    f->flexure[i].gap_m = 0;
}

/* A shuttle between two pairs of legs, 1.5 mm long and rising by 0.15 mm towards it: pins hold it, and it snaps through by
   what leaves give. `in_line`: every leaf in line with its leg */
static void two_pairs(fixture *f, bool in_line) {
    static const char *const leg[] = {"lu", "ru", "ld", "rd"};
    static const char *const foot[] = {"Alu", "Aru", "Ald", "Ard"};
    static const char *const head[] = {"Blu", "Bru", "Bld", "Brd"};
    *f = (fixture){0};
    f->body[0] = fixture_body("shuttle", NONE);
    f->body[0].plate_width_m = 0.5e-3, f->body[0].plate_height_m = 4.7e-3;
    f->body[0].x_m = f->body[0].plate_x_m = 0, f->body[0].y_m = f->body[0].plate_y_m = 0.15e-3;
    for (int i = 0; i < 4; i++) {
        double side = i % 2 ? 1 : -1, y = i < 2 ? 2.2 : -2.2;
        f->body[1 + i] = fixture_body(leg[i], 120e-6);
        leaf(f, 2 * i, foot[i], FW_GROUND, 1 + i, 2 * side, y);
        leaf(f, 2 * i + 1, head[i], 1 + i, 0, 0.5 * side, y + 0.15);
        double along = 0.5 * M_PI - side * atan(0.15 / 1.5);
        if (in_line) f->revolute[2 * i].axis_rad = f->revolute[2 * i + 1].axis_rad = along;
    }
    fixture_finish(f, "two-pairs", 5, 8);
}

/* bodies in a row on four leaves, between two hinges of the ground */
static void four_bar(fixture *f, const double x_mm[4], const double y_mm[4]) {
    static const char *const bar[] = {"crank", "coupler", "rocker"};
    static const char *const hinge[] = {"A", "B", "C", "D"};
    *f = (fixture){0};
    for (int i = 0; i < 3; i++)
        f->body[i] = fixture_body(bar[i], 120e-6);
    for (int i = 0; i < 4; i++)
        leaf(f, i, hinge[i], i - 1 < 0 ? FW_GROUND : i - 1, i < 3 ? i : FW_GROUND, x_mm[i], y_mm[i]);
    fixture_finish(f, "four-bar", 3, 4);
}

/* what is said of leaves off their legs; NULL: nothing. What else the drawing says does not matter */
static const char *said_of(fw_arena *arena, fixture *f) {
    fw_diags diags = fw_diags_new(arena);
    const fw_layout *l;
    const char *said = NULL;
    fw_layout_build(arena, &f->device, &diags, &l);
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].number == 653) {
            assert_null(said);
            assert_int_equal(diags.item[i].severity, FW_WARNING);
            said = diags.item[i].message;
        }
    return said;
}

static void legs_that_snap(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture f;
    two_pairs(&f, false);
    const char *said = said_of(arena, &f);
    assert_non_null(said);
    assert_non_null(strstr(said, "hinge Alu by 47.9 deg off body lu (axis=\"-84.2894 deg\" lays it in line)"));
    assert_non_null(strstr(said, "hinge Bru by 41.5 deg off body ru (axis=\"84.2894 deg\" lays it in line)"));
    assert_non_null(strstr(said, ", and 4 more"));
    two_pairs(&f, true);
    assert_null(said_of(arena, &f));
    fw_arena_free(arena);
}

/* one pair, whose base is a bar between its feet: the leaves of the feet would lie across the legs */
static void legs_on_one_base(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture f;
    four_bar(&f, (const double[]){-2, -0.5, 0.5, 2}, (const double[]){0, 0.15, 0.15, 0});
    const char *said = said_of(arena, &f);
    assert_non_null(said);
    assert_non_null(strstr(said, "hinge A by 87.1 deg off body crank (axis=\"95.7106 deg\""));
    assert_null(strstr(said, "hinge B"));
    fw_arena_free(arena);
}

/* halfway between crank and coupler a leaf is a pivot like any */
static void pivots_of_a_linkage(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture f;
    four_bar(&f, (const double[]){0, 0, 1.8, 1.8}, (const double[]){0, 1.5, 1.5, 0});
    assert_null(said_of(arena, &f));
    four_bar(&f, (const double[]){0, 0.4, 1.8, 1.8}, (const double[]){0, 1.5, 1.5, 0});
    assert_null(said_of(arena, &f));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legs_that_snap),
        cmocka_unit_test(legs_on_one_base),
        cmocka_unit_test(pivots_of_a_linkage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
