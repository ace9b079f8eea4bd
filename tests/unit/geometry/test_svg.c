/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "geometry/contour.h"
#include <math.h>

/* a half disc, flat side below: 1 mm radius */
static fw_geometry_segment half_disc[2] = {
    {.kind = FW_ARC,
     .a = {1e-3, 0},
     .b = {-1e-3, 0},
     .radius = 1e-3,
     .sweep_rad = 3.14159265358979},
    {.kind = FW_LINE, .flags = FW_SEGMENT_JOINT, .a = {-1e-3, 0}, .b = {1e-3, 0}}};

static void expect(const char *want, double most_rad, bool edges) {
    fw_arena *arena = fw_arena_new(0);
    fw_text out = fw_text_new(arena);
    const fw_geometry_sheet sheet = {-1e-3, 1e-3, 1e3, 3, most_rad};
    const fw_geometry_contour contour = {half_disc, 2};
    if (edges)
        fw_geometry_svg_edges(&out, &sheet, &contour);
    else
        fw_geometry_svg_contour(&out, &sheet, &contour);
    assert_string_equal(out.data, want);
    fw_arena_free(arena);
}

static void arcs_are_split_as_asked(void **state) {
    (void)state;
    expect("M2 1A1 1 0 0 0 0 1L2 1Z", FW_GEOMETRY_ARC_PICTURE, false);
    expect("M2 1A1 1 0 0 0 1 0A1 1 0 0 0 0 1L2 1Z", FW_GEOMETRY_ARC_EXACT, false);
}

static void edges_leave_joints_out(void **state) {
    (void)state;
    expect("M2 1A1 1 0 0 0 0 1", FW_GEOMETRY_ARC_PICTURE, true);
}

static void large_arcs_say_so(void **state) {
    (void)state;
    fw_geometry_segment s = half_disc[0];
    s.sweep_rad = -1.5 * 3.14159265358979;
    fw_arena *arena = fw_arena_new(0);
    fw_text out = fw_text_new(arena);
    const fw_geometry_sheet sheet = {0, 0, 1e3, 2, FW_GEOMETRY_ARC_PICTURE};
    s.b = (fw_geometry_vec2){0, 1e-3};
    fw_geometry_svg_contour(&out, &sheet, &(fw_geometry_contour){&s, 1});
    assert_string_equal(out.data, "M1 0A1 1 0 1 1 0 -1Z");
    s.sweep_rad = 2 * 3.14159265358979; /* a full turn has no direction in one piece */
    assert_int_equal(fw_geometry_arc_parts(&s, FW_GEOMETRY_ARC_PICTURE), 2);
    assert_int_equal(fw_geometry_arc_parts(&s, FW_GEOMETRY_ARC_EXACT), 3);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arcs_are_split_as_asked),
        cmocka_unit_test(edges_leave_joints_out),
        cmocka_unit_test(large_arcs_say_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
