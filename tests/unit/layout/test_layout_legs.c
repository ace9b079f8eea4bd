/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Leaves whose axis the layout chooses: it says where it turns one off the leg that it holds and that decides what
   moves (FW-D653), and is silent where the leaf is a pivot. Heads of leaves: on the leaf's line, alike on both sides of it,
   and mirror images where hinges are. */
#include "fixture.h"
#include "layout/layout.h"
#include "test.h"
#include <math.h>
#include <stdio.h>
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

/* one pair, whose base is a bar between its feet: the leaves of the feet would lie across the legs. Lower, the coupler is
   in the way of that bar, and of two bases each leads from its foot in line with the leg */
static void legs_on_one_base(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fixture f;
    four_bar(&f, (const double[]){-2, -0.5, 0.5, 2}, (const double[]){0, 0.15, 0.15, 0});
    assert_null(said_of(arena, &f));
    four_bar(&f, (const double[]){-2, -0.5, 0.5, 2}, (const double[]){0, 0.6, 0.6, 0});
    const char *said = said_of(arena, &f);
    assert_non_null(said);
    assert_non_null(strstr(said, "hinge A by 79.1 deg off body crank (axis=\"111.801 deg\""));
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

/* ---- heads ---- */

static fw_status drawn(fw_arena *arena, const char *leaf, const char *mechanism, fw_diags *diags, const fw_layout **l) {
    const fw_device *device;
    char *xml = fw_arena_printf(arena,
                                "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
                                "thickness=\"50 um\"/><flow ref=\"al-masked-rie\"/><flexure id=\"leaf\" kind=\"leaf\" "
                                "%s/><mechanism>%s</mechanism></device>",
                                leaf, mechanism);
    assert_non_null(xml);
    *diags = fw_diags_new(arena);
    if (fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, diags, &device) != FW_OK)
        fail_msg("%s", diags->item[0].message);
    return fw_layout_build(arena, device, diags, l);
}

static const fw_layout *is_drawn(fw_arena *arena, const char *leaf, const char *mechanism) {
    const fw_layout *l;
    fw_diags diags;
    if (drawn(arena, leaf, mechanism, &diags, &l) != FW_OK) fail_msg("%s", diags.item[0].message);
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].severity != FW_NOTE) fail_msg("%s", diags.item[i].message);
    return l;
}

static bool of_body(const fw_layout *l, int hinge, int body, double x, double y) {
    const fw_layout_hinge_layout *h = &l->hinge[hinge];
    return fw_geometry_contour_contains(&h->solid[h->upper == body], (fw_geometry_vec2){x, y});
}

/* Is what `body` has about hinge j the mirror image, across x or y, of what it has about hinge i? A corner is rounded where
   the two meet, so that edges are compared up to rounding */
static void mirror_each_other(const fw_layout *l, int i, int j, int body, double sx, double sy) {
    const fw_geometry_vec2 w = l->hinge[i].centre;
    const double far = l->hinge[i].keep_out_m, step = 7.31e-6;
    for (double y = -far; y < far; y += step)
        for (double x = -far; x < far; x += step)
            if (hypot(x, y) < far &&
                of_body(l, i, body, w.x + x, w.y + y) != of_body(l, j, body, sx * (w.x + x), sy * (w.y + y)))
                fail_msg("hinges %d and %d at (%g, %g) um from the hinge", i, j, 1e6 * x, 1e6 * y);
}

/* A plate on four leaves: however axes are signed its four heads are one head and its mirror images, square to the plate
   and alike on both sides of their leaves. Two hung on crescents of 39 um beside two solid ones */
static void guided_stage(void **state) {
    (void)state;
    double area = 0;
    for (int signs = 0; signs < 16; signs++) {
        fw_arena *arena = fw_arena_new(0);
        const char *all = "<body id=\"S\" plate-width=\"1.6 mm\" plate-height=\"0.5 mm\" x=\"0 mm\" y=\"0 mm\"/>";
        for (int i = 0; i < 4; i++) {
            const double x = i % 2 ? 0.6 : -0.6, y = i < 2 ? 0.6 : -0.6;
            all = fw_arena_printf(arena,
                                  "%s<revolute id=\"h%d\" a=\"ground\" a-x=\"%g mm\" a-y=\"%g mm\" b=\"S\" b-x=\"%g mm\" "
                                  "b-y=\"%g mm\" hinge=\"leaf\" axis=\"%d deg\"/>",
                                  all, i, x, y, x, y, signs & 1 << i ? 180 : 0);
        }
        const fw_layout *l = is_drawn(arena, "length=\"400 um\" width=\"8 um\" fillet=\"4 um\"", all);
        const fw_layout_body_layout *b = &l->body[0];
        assert_true(fabs(b->spread_m4.y) < 1e-9 * b->polar_m4); /* no product of inertia */
        assert_true(hypot(b->centroid.x, b->centroid.y) < 1e-10);
        for (int i = 1; i < 4; i++)
            mirror_each_other(l, 0, i, 0, i % 2 ? -1 : 1, i < 2 ? 1 : -1);
        for (int i = 1; i < 4; i++)
            mirror_each_other(l, 0, i, FW_GROUND, i % 2 ? -1 : 1, i < 2 ? 1 : -1);
        for (int side = -1; side <= 1; side += 2) { /* the root is at 400 um, the plate from 250 um on */
            assert_true(of_body(l, 0, 0, -0.6e-3 + side * 45e-6, 390e-6));
            assert_true(of_body(l, 0, 0, -0.6e-3 + side * 54e-6, 300e-6));
            assert_false(of_body(l, 0, 0, -0.6e-3 + side * 60e-6, 300e-6));
        }
        if (signs == 0) area = b->area_m2;
        assert_true(fabs(b->area_m2 - area) < 1e-9 * area);
        fw_arena_free(arena);
    }
}

/* A platform on two leaves that lean towards each other: the line of each would leave it at a corner, so that necks turn
   as little as leads them in. One head, and one foot, hung on a crescent */
static void leaning_leaves(void **state) {
    (void)state;
    static const char *const axis[4][2] = {{"35", "-35"}, {"215", "-35"}, {"35", "145"}, {"215", "145"}};
    for (int i = 0; i < 4; i++) {
        fw_arena *arena = fw_arena_new(0);
        const char *all = fw_arena_printf(
            arena,
            "<body id=\"top\" x=\"0 mm\" y=\"0.9 mm\" plate-width=\"2.6 mm\" plate-height=\"0.4 mm\"/>"
            "<revolute id=\"A\" a=\"ground\" a-x=\"-0.803 mm\" b=\"top\" b-x=\"-0.803 mm\" b-y=\"-0.9 mm\" hinge=\"leaf\" axis=\"%s deg\"/>"
            "<revolute id=\"B\" a=\"ground\" a-x=\"0.803 mm\" b=\"top\" b-x=\"0.803 mm\" b-y=\"-0.9 mm\" hinge=\"leaf\" axis=\"%s deg\"/>",
            axis[i][0], axis[i][1]);
        const fw_layout *l = is_drawn(arena, "length=\"500 um\" width=\"10 um\" fillet=\"10 um\"", all);
        if (fabs(l->body[0].centroid.x) > 1e-9) fail_msg("%d: %g", i, l->body[0].centroid.x);
        mirror_each_other(l, 0, 1, 0, -1, 1);
        mirror_each_other(l, 0, 1, FW_GROUND, -1, 1);
        for (int side = -1; side <= 1; side += 2) { /* 10 um behind the root, 40 um to either side of the leaf */
            const double c = cos(0.25 * M_PI - M_PI / 18), s = sin(0.25 * M_PI - M_PI / 18); /* 35 degrees */
            assert_true(of_body(l, 0, 0, -0.803e-3 - s * 260e-6 + side * c * 40e-6, c * 260e-6 + side * s * 40e-6));
        }
        fw_arena_free(arena);
    }
}

/* Beside a straight head its plate is whole: the round place of the hinge took a bay out of it, and left a tooth of 9 um
   where that ended near the plate's end */
static void plates_beside_heads_are_whole(void **state) {
    (void)state;
    static const char *const plate[] = {
        "<body id=\"T\" x=\"0 mm\" y=\"0.95 mm\"><plate width=\"3.4 mm\" height=\"0.3 mm\"/></body>",
        "<body id=\"T\" x=\"0 mm\" y=\"0.95 mm\" plate-width=\"3.4 mm\" plate-height=\"0.3 mm\"/>"};
    for (int i = 0; i < 2; i++) {
        fw_arena *arena = fw_arena_new(0);
        const char *all = fw_arena_printf(
            arena,
            "%s<revolute id=\"A\" a=\"ground\" a-x=\"-1.5 mm\" a-y=\"0.53 mm\" b=\"T\" b-x=\"-1.5 mm\" b-y=\"-0.42 mm\" hinge=\"leaf\" axis=\"0 deg\"/>"
            "<revolute id=\"B\" a=\"ground\" a-x=\"1.5 mm\" a-y=\"0.53 mm\" b=\"T\" b-x=\"1.5 mm\" b-y=\"-0.42 mm\" hinge=\"leaf\" axis=\"0 deg\"/>",
            plate[i]);
        const fw_layout *l = is_drawn(arena, "length=\"400 um\" width=\"8 um\" fillet=\"4 um\"", all);
        assert_true(of_body(l, 0, 0, -1.60e-3, 0.803e-3));
        assert_true(of_body(l, 0, 0, -1.40e-3, 0.803e-3));
        /* the plate, two necks of 114 by 70 um with half a leaf each, and corners */
        assert_true(fabs(l->body[0].area_m2 - (3.4e-3 * 0.3e-3 + 2 * (114e-6 * 70e-6 + 200e-6 * 8e-6))) < 0.5e-9);
        fw_arena_free(arena);
    }
}

/* A shuttle between two leaves, left and right of it: one base between both would cross it, and each gets its own */
static void one_vee(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    int bases = 0;
    const fw_layout *l = is_drawn(
        arena, "length=\"400 um\" width=\"8 um\" fillet=\"4 um\"",
        "<body id=\"S\" x=\"0 mm\" y=\"0 mm\" plate-width=\"0.4 mm\" plate-height=\"0.6 mm\"/>"
        "<revolute id=\"L\" a=\"ground\" a-x=\"-0.5 mm\" a-y=\"-0.05 mm\" b=\"S\" b-x=\"-0.5 mm\" b-y=\"-0.05 mm\" hinge=\"leaf\" axis=\"98 deg\"/>"
        "<revolute id=\"R\" a=\"ground\" a-x=\"0.5 mm\" a-y=\"-0.05 mm\" b=\"S\" b-x=\"0.5 mm\" b-y=\"-0.05 mm\" hinge=\"leaf\" axis=\"82 deg\"/>");
    for (int i = 0; i < l->npiece; i++)
        bases += l->piece[i].role == FW_ROLE_STRUCTURE && l->piece[i].body == FW_GROUND;
    assert_int_equal(bases, 2);
    mirror_each_other(l, 0, 1, 0, -1, 1);
    mirror_each_other(l, 0, 1, FW_GROUND, -1, 1);
    fw_arena_free(arena);
}

/* necks towards the middle of a long plate enclose something, and the message says how it is drawn instead */
static void necks_that_enclose(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags;
    const fw_layout *l;
    const char *all = "<body id=\"S\" x=\"0 mm\" y=\"0 mm\" plate-width=\"1.5 mm\" plate-height=\"0.5 mm\"/>"
                      "<body id=\"T\" x=\"0 mm\" y=\"0.95 mm\" plate-width=\"3.4 mm\" plate-height=\"0.3 mm\"/>";
    for (int i = 0; i < 4; i++) {
        const double x = i - 1.5;
        const bool inner = i == 1 || i == 2;
        all = fw_arena_printf(arena,
                              "%s<revolute id=\"h%d\" a=\"%s\" a-x=\"%g mm\" a-y=\"0.53 mm\" b=\"T\" b-x=\"%g mm\" "
                              "b-y=\"-0.42 mm\" hinge=\"leaf\" axis=\"%d deg\"/>",
                              all, i, inner ? "S" : "ground", x, x, inner ? 180 : 0);
    }
    assert_int_equal(drawn(arena, "length=\"400 um\" width=\"8 um\" fillet=\"4 um\" width-middle=\"7 um\"", all, &diags, &l), FW_GEOMETRY);
    const char *said = NULL;
    for (size_t i = 0; i < diags.count && !said; i++)
        if (diags.item[i].number == 123) said = diags.item[i].message;
    assert_non_null(said);
    if (!strstr(said, "draw it as <plate> inside <body>")) fail_msg("%s", said);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legs_that_snap),
        cmocka_unit_test(legs_on_one_base),
        cmocka_unit_test(pivots_of_a_linkage),
        cmocka_unit_test(guided_stage),
        cmocka_unit_test(leaning_leaves),
        cmocka_unit_test(plates_beside_heads_are_whole),
        cmocka_unit_test(one_vee),
        cmocka_unit_test(necks_that_enclose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
