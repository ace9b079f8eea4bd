/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

static void builder_joins_and_closes(void **state) {
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){2e-5, 0}, 0);
    fw_geometry_outline_arc(&o, (fw_geometry_vec2){2e-5, 1e-5}, FW_PI / 2, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){3e-5, 2e-5}, FW_SEGMENT_JOINT);
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    assert_int_equal(c.count, 4); /* the closing line was added */
    assert_int_equal(c.segment[2].flags, FW_SEGMENT_JOINT);
    for (int i = 0; i < c.count; i++)
        assert_memory_equal(&c.segment[i].b, &c.segment[(i + 1) % c.count].a,
                            sizeof(fw_geometry_vec2));
    assert_near(fw_geometry_segment_length(&c.segment[1]), FW_PI / 2 * 1e-5, 1e-20);
}

static void builder_closes_rounding_gaps_without_slivers(void **state) {
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){1e-5, 0});
    for (int i = 0; i < 7; i++) /* round the circle in sevenths: ends 1e-20 m from the start */
        fw_geometry_outline_arc(&o, (fw_geometry_vec2){0, 0}, FW_TURN / 7, 0);
    fw_geometry_contour c;
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
    assert_int_equal(c.count, 7);
    assert_memory_equal(&c.segment[6].b, &c.segment[0].a, sizeof(fw_geometry_vec2));
    assert_relative(fw_geometry_contour_area(&c), FW_PI * 1e-10, 1e-14);
}

static void builder_refuses_what_is_no_outline(void **state) {
    fw_geometry_contour c;
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){(double)NAN, 0});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-5, 0}, 0);
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_GEOMETRY);
    o = fw_geometry_outline_start(*state, (fw_geometry_vec2){1e-5, 0});
    fw_geometry_outline_arc_to(&o, (fw_geometry_vec2){0, 0}, 1, (fw_geometry_vec2){0, 1.1e-5},
                               0); /* off the circle */
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 0}, 0);
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_GEOMETRY);
    o = fw_geometry_outline_start(*state, (fw_geometry_vec2){1e-5, 0});
    fw_geometry_outline_arc_to(&o, (fw_geometry_vec2){0, 0}, 1, (fw_geometry_vec2){0, 1e-5},
                               0); /* on it, wrong angle */
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_GEOMETRY);
    o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_GEOMETRY);
    fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 0, &c);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, -1, &c),
                     FW_GEOMETRY);
    assert_int_equal(fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 0, 1}, &c),
                     FW_GEOMETRY);
    assert_int_equal(
        fw_geometry_contour_ring_sector(*state, (fw_geometry_vec2){0, 0}, 1e-5, 2e-5, 0, 7, &c),
        FW_GEOMETRY);
    assert_int_equal(fw_geometry_contour_bar(*state, (fw_geometry_vec2){0, 0},
                                             (fw_geometry_vec2){0, 0}, 1e-5, &c),
                     FW_GEOMETRY);
}

static void shapes_have_their_areas(void **state) {
    fw_geometry_contour c;
    for (int i = 0; i < 200; i++) {
        double x = uniform(-1e-3, 1e-3), a = uniform(1e-6, 1e-4), w = uniform(1e-6, 1e-4);
        double angle = uniform(0, FW_TURN), sweep = uniform(0.01, 6.28);
        fw_geometry_vec2 p = {x, -x}, q = {x + a * cos(angle), -x + a * sin(angle)};
        assert_int_equal(fw_geometry_contour_bar(*state, p, q, w, &c), FW_OK);
        assert_relative(fw_geometry_contour_area(&c), a * w, 1e-11);
        assert_int_equal(fw_geometry_contour_ring_sector(*state, p, a, a + w, angle, sweep, &c),
                         FW_OK);
        assert_relative(fw_geometry_contour_area(&c), sweep * w * (a + 0.5 * w), 1e-10);
        assert_relative(fw_geometry_contour_perimeter(&c), 2 * w + sweep * (2 * a + w), 1e-10);
        assert_int_equal(fw_geometry_contour_ring_sector(*state, p, 0, w, angle, sweep, &c), FW_OK);
        assert_int_equal(c.count, 3);
        assert_relative(fw_geometry_contour_area(&c), 0.5 * sweep * w * w, 1e-10);
    }
}

static void transform_keeps_shape_and_sharing(void **state) {
    for (int i = 0; i < 500; i++) {
        fw_geometry_contour c = random_shape(*state, 1e-4, 0), t, back;
        fw_geometry_pose pose = {uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3), uniform(-7, 7)};
        bool mirror = i % 2;
        assert_int_equal(fw_geometry_contour_transform(*state, &c, pose, mirror, &t), FW_OK);
        assert_true(fw_geometry_contour_valid(&t));
        assert_relative(fw_geometry_contour_area(&t), fw_geometry_contour_area(&c), 1e-10);
        assert_relative(fw_geometry_contour_perimeter(&t), fw_geometry_contour_perimeter(&c),
                        1e-12);
        /* a point stays inside or outside */
        fw_geometry_vec2 p = {uniform(-3e-4, 3e-4), uniform(-3e-4, 3e-4)};
        fw_geometry_vec2 m =
            fw_geometry_vec_rotate((fw_geometry_vec2){p.x, mirror ? -p.y : p.y}, pose.angle_rad);
        fw_geometry_vec2 moved = {m.x + pose.x_m, m.y + pose.y_m};
        assert_int_equal(fw_geometry_contour_contains(&c, p),
                         fw_geometry_contour_contains(&t, moved));
        assert_int_equal(fw_geometry_contour_reverse(*state, &c, &back), FW_OK);
        assert_true(fw_geometry_contour_valid(&back));
        assert_relative(fw_geometry_contour_area(&back), -fw_geometry_contour_area(&c), 1e-12);
    }
    fw_geometry_contour c = random_shape(*state, 1e-4, 0), t;
    assert_int_equal(
        fw_geometry_contour_transform(*state, &c, (fw_geometry_pose){0, 0, (double)NAN}, false, &t),
        FW_GEOMETRY);
    assert_int_equal(
        fw_geometry_contour_transform(*state, &c, (fw_geometry_pose){0, 0, 0}, false, &t), FW_OK);
    assert_memory_equal(&c.segment[0].a, &t.segment[0].a, sizeof(fw_geometry_vec2));
}

static void out_of_memory_is_reported(void **state) {
    fw_geometry_contour c;
    fw_arena_fail_at(1, 1);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 1e-5, &c),
                     FW_NOMEM);
    assert_int_equal(fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1e-5, 1e-5}, &c),
                     FW_NOMEM);
    assert_int_equal(
        fw_geometry_contour_ring_sector(*state, (fw_geometry_vec2){0, 0}, 1e-5, 2e-5, 0, 1, &c),
        FW_NOMEM);
    fw_arena_fail_at(2, 1);
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
    for (int i = 1; i < 30; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){i * 1e-6, (i % 2) * 1e-6}, 0);
    assert_int_equal(fw_geometry_outline_close(&o, &c), FW_NOMEM);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(builder_joins_and_closes),
        geo_test(builder_closes_rounding_gaps_without_slivers),
        geo_test(builder_refuses_what_is_no_outline),
        geo_test(shapes_have_their_areas),
        geo_test(transform_keeps_shape_and_sharing),
        geo_test(out_of_memory_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
