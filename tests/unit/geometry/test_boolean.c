/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

static fw_geometry_region boolean(fw_arena *arena, const fw_geometry_region *p,
                                  const fw_geometry_region *q, fw_geometry_boolean op) {
    fw_geometry_region r;
    assert_int_equal(fw_geometry_region_boolean(arena, p, q, op, &r), FW_OK);
    for (int i = 0; i < r.count; i++)
        assert_true(fw_geometry_contour_valid(&r.contour[i]));
    return r;
}

/* area identities and membership of random points; area tolerance: 1e-12 m times all edges */
static void check_pair(fw_arena *arena, const fw_geometry_region *p, const fw_geometry_region *q,
                       double size, int points) {
    fw_geometry_region both = boolean(arena, p, q, FW_INTERSECTION);
    fw_geometry_region any = boolean(arena, p, q, FW_UNION);
    fw_geometry_region less = boolean(arena, p, q, FW_DIFFERENCE);
    double tolerance = 60e-12 * size;
    double ap = region_area(p), aq = region_area(q), ab = region_area(&both);
    assert_near(region_area(&any) + ab, ap + aq, tolerance);
    assert_near(region_area(&less), ap - ab, tolerance);
    assert_true(ab >= -tolerance && ab <= fmin(ap, aq) + tolerance);
    for (int k = 0; k < points; k++) {
        fw_geometry_vec2 at = {uniform(-3 * size, 3 * size), uniform(-3 * size, 3 * size)};
        if (region_edge(p, at) < 1e-11 || region_edge(q, at) < 1e-11) continue;
        int in_p = region_turns(p, at), in_q = region_turns(q, at);
        assert_int_equal(region_turns(&both, at), in_p && in_q);
        assert_int_equal(region_turns(&any, at), in_p || in_q);
        assert_int_equal(region_turns(&less, at), in_p && !in_q);
    }
}

static void random_shapes_obey_identities(void **state) {
    for (int i = 0; i < 3000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double size = pow(10, uniform(-5, -3));
        fw_geometry_contour a = random_shape(*state, size, 0), b = random_shape(*state, size, 0);
        fw_geometry_region p = region_of(&a), q = region_of(&b);
        check_pair(*state, &p, &q, size, 20);
        fw_arena_rewind(*state, mark);
    }
}

static void gridded_shapes_obey_identities(void **state) {
    for (int i = 0; i < 10000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double size = 1e-4;
        fw_geometry_contour a = random_shape(*state, size, size / 4),
                            b = random_shape(*state, size, size / 4);
        fw_geometry_region p = region_of(&a), q = region_of(&b);
        check_pair(*state, &p, &q, size, 20);
        fw_arena_rewind(*state, mark);
    }
}

/* results of booleans as operands: holes, touching outlines, many segments */
static void chains_obey_identities(void **state) {
    for (int i = 0; i < 600; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double size = 1e-4, snap = i % 2 ? size / 4 : 0;
        fw_geometry_contour a = random_shape(*state, size, snap);
        fw_geometry_region p = region_of(&a);
        for (int k = 0; k < 6; k++) {
            fw_geometry_contour b = random_shape(*state, size, snap);
            fw_geometry_region q = region_of(&b);
            check_pair(*state, &p, &q, 4 * size, 10);
            p = boolean(*state, &p, &q, k % 3 == 1 ? FW_DIFFERENCE : FW_UNION);
        }
        fw_arena_rewind(*state, mark);
    }
}

/* gridded shapes, one of them moved by a hair: to the tolerance the same, clearly apart, or
   between, where the answer may be a refusal but never a wrong region */
static void almost_coincident_shapes(void **state) {
    static const double hair[] = {1e-18, 1e-16, 1e-14, 1e-13, 1e-12, 3e-12, 1e-11, 1e-10, 1e-9};
    int refused = 0;
    for (int i = 0; i < 20000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double size = 1e-4, e = hair[i % 9];
        fw_geometry_contour a = random_shape(*state, size, size / 4),
                            b = random_shape(*state, size, size / 4);
        fw_geometry_contour moved;
        fw_geometry_pose pose = {uniform(-e, e), uniform(-e, e), uniform(-e, e) / size};
        assert_int_equal(fw_geometry_contour_transform(*state, &b, pose, false, &moved), FW_OK);
        fw_geometry_region p = region_of(&a), q = region_of(&moved), r;
        fw_status status = fw_geometry_region_boolean(*state, &p, &q, FW_UNION, &r);
        if (status == FW_OK) status = fw_geometry_region_boolean(*state, &p, &q, FW_DIFFERENCE, &r);
        if (status == FW_OK)
            status = fw_geometry_region_boolean(*state, &p, &q, FW_INTERSECTION, &r);
        if (status == FW_OK)
            check_pair(*state, &p, &q, 4 * size, 10);
        else {
            assert_int_equal(status, FW_GEOMETRY);
            assert_true(e > 5e-13 && e < 5e-11);
            refused++;
        }
        fw_arena_rewind(*state, mark);
    }
    print_message("%d of 20000 refused\n", refused);
    assert_true(refused <= 5);
}

static void bar_through_disc(void **state) {
    fw_geometry_contour disc, bar;
    double r = 50e-6, w = 20e-6;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, r, &disc), 0);
    assert_int_equal(fw_geometry_contour_bar(*state, (fw_geometry_vec2){-2 * r, 0},
                                             (fw_geometry_vec2){2 * r, 0}, w, &bar),
                     0);
    fw_geometry_region p = region_of(&disc), q = region_of(&bar);
    fw_geometry_region both = boolean(*state, &p, &q, FW_INTERSECTION);
    /* strip of a disc: r^2 (2 asin(w/2r)) + w sqrt(r^2 - w^2/4) */
    double want = 2 * r * r * asin(w / (2 * r)) + w * sqrt(r * r - w * w / 4);
    assert_relative(region_area(&both), want, 1e-14);
    fw_geometry_region rest = boolean(*state, &p, &q, FW_DIFFERENCE);
    assert_int_equal(rest.count, 2);
    assert_relative(region_area(&rest), FW_PI * r * r - want, 1e-14);
    fw_geometry_region any = boolean(*state, &p, &q, FW_UNION);
    assert_int_equal(any.count, 1);
}

static void identical_operands(void **state) {
    fw_geometry_contour disc;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){1e-3, 2e-3}, 5e-5, &disc),
                     0);
    fw_geometry_region p = region_of(&disc);
    fw_geometry_region any = boolean(*state, &p, &p, FW_UNION),
                       both = boolean(*state, &p, &p, FW_INTERSECTION);
    assert_int_equal(boolean(*state, &p, &p, FW_DIFFERENCE).count, 0);
    assert_int_equal(any.count, 1);
    assert_int_equal(both.count, 1);
    for (int i = 0; i < 2; i++) /* untouched: every double as it was */
        assert_memory_equal(&any.contour[0].segment[i].a, &disc.segment[i].a,
                            sizeof(fw_geometry_vec2));
}

static void disc_touching_from_inside(void **state) {
    fw_geometry_contour big, small;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 50e-6, &big), 0);
    double angle = 0.7;
    fw_geometry_vec2 c = {30e-6 * cos(angle), 30e-6 * sin(angle)};
    assert_int_equal(fw_geometry_contour_disc(*state, c, 20e-6, &small), 0);
    fw_geometry_region p = region_of(&big), q = region_of(&small);
    fw_geometry_region less = boolean(*state, &p, &q, FW_DIFFERENCE);
    assert_int_equal(less.count, 2); /* the hole is not lost in a keyhole outline */
    assert_relative(region_area(&less), FW_PI * (2500e-12 - 400e-12), 1e-13);
    assert_int_equal(boolean(*state, &p, &q, FW_UNION).count, 1);
}

static void disc_inside_leaves_a_hole(void **state) {
    fw_geometry_contour box, disc;
    assert_int_equal(
        fw_geometry_contour_rectangle(*state, (fw_geometry_box){-1e-4, -1e-4, 1e-4, 1e-4}, &box),
        0);
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){1e-5, 0}, 3e-5, &disc), 0);
    fw_geometry_region p = region_of(&box), q = region_of(&disc);
    fw_geometry_region ring = boolean(*state, &p, &q, FW_DIFFERENCE);
    assert_int_equal(ring.count, 2);
    assert_true(fw_geometry_contour_area(&ring.contour[0]) > 0 &&
                fw_geometry_contour_area(&ring.contour[1]) < 0);
    fw_geometry_region again = boolean(*state, &ring, &q, FW_UNION); /* fills it */
    assert_int_equal(again.count, 1);
    assert_int_equal(again.contour[0].count, 4);
}

static void abutting_rectangles_become_one(void **state) {
    fw_geometry_contour a, b;
    assert_int_equal(fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1e-4, 1e-4}, &a),
                     0);
    assert_int_equal(
        fw_geometry_contour_rectangle(*state, (fw_geometry_box){1e-4, 0, 3e-4, 1e-4}, &b), 0);
    fw_geometry_region p = region_of(&a), q = region_of(&b);
    fw_geometry_region any = boolean(*state, &p, &q, FW_UNION);
    assert_int_equal(any.count, 1);
    assert_int_equal(any.contour[0].count, 4); /* no vertex left in the straight edges */
    assert_int_equal(boolean(*state, &p, &q, FW_INTERSECTION).count, 0);
    fw_geometry_region less = boolean(*state, &p, &q, FW_DIFFERENCE);
    assert_int_equal(less.contour[0].count, 4);
}

/* a joint away from the change keeps its flag and its doubles */
static void untouched_segments_stay(void **state) {
    fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0.1e-3, 0.2e-3});
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0.7e-3, 0.2e-3}, 0);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0.7e-3, 0.3e-3}, FW_SEGMENT_JOINT);
    fw_geometry_outline_line(&o, (fw_geometry_vec2){0.1e-3, 0.3e-3}, 0);
    fw_geometry_contour link, disc;
    assert_int_equal(fw_geometry_outline_close(&o, &link), 0);
    assert_int_equal(
        fw_geometry_contour_disc(*state, (fw_geometry_vec2){0.3e-3, 0.35e-3}, 0.1e-3, &disc), 0);
    fw_geometry_region p = region_of(&link), q = region_of(&disc);
    fw_geometry_region less = boolean(*state, &p, &q, FW_DIFFERENCE);
    assert_int_equal(less.count, 1);
    int joints = 0;
    for (int i = 0; i < less.contour[0].count; i++)
        if (less.contour[0].segment[i].flags & FW_SEGMENT_JOINT) {
            assert_memory_equal(&less.contour[0].segment[i], &link.segment[1],
                                sizeof(fw_geometry_segment));
            joints++;
        }
    assert_int_equal(joints, 1);
}

static void out_of_memory_is_reported(void **state) {
    fw_geometry_contour disc, bar;
    assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){0, 0}, 1e-4, &disc), 0);
    assert_int_equal(fw_geometry_contour_bar(*state, (fw_geometry_vec2){0, 0},
                                             (fw_geometry_vec2){3e-4, 0}, 1e-5, &bar),
                     0);
    fw_geometry_region p = region_of(&disc), q = region_of(&bar), r;
    for (long n = 1;; n++) {
        fw_arena_fail_at(n, 0);
        fw_status status = fw_geometry_region_boolean(*state, &p, &q, FW_UNION, &r);
        long used = fw_arena_count();
        fw_arena_fail_at(0, 0);
        if (used < n) {
            assert_int_equal(status, FW_OK);
            assert_true(n > 8);
            break;
        }
        assert_int_equal(status, FW_NOMEM);
    }
}

static void bad_operands_are_refused(void **state) {
    fw_geometry_contour box;
    assert_int_equal(
        fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1e-4, 1e-4}, &box), 0);
    box.segment[1].b.x = (double)NAN;
    fw_geometry_region p = region_of(&box), none = {0}, r;
    assert_int_equal(fw_geometry_region_boolean(*state, &p, &none, FW_UNION, &r), FW_GEOMETRY);
    assert_int_equal(fw_geometry_region_boolean(*state, &none, &none, FW_UNION, &r), FW_OK);
    assert_int_equal(r.count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(bar_through_disc),
        geo_test(identical_operands),
        geo_test(disc_touching_from_inside),
        geo_test(disc_inside_leaves_a_hole),
        geo_test(abutting_rectangles_become_one),
        geo_test(untouched_segments_stay),
        geo_test(random_shapes_obey_identities),
        geo_test(gridded_shapes_obey_identities),
        geo_test(chains_obey_identities),
        geo_test(almost_coincident_shapes),
        geo_test(out_of_memory_is_reported),
        geo_test(bad_operands_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
