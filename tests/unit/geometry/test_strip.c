/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strips of lines and arcs with varying width: edges, widths, crossings. */
#include "geometry/segment.h"
#include "geometry/contour.h"
#include "test.h"

static uint64_t seed = 0x51a7;
static double uniform(double low, double high) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 11) / 9007199254740992.0;
}

static fw_geometry_strip_piece random_piece(void) {
    double w = uniform(5e-6, 10e-6), angle = uniform(-3.5, 3.5), r = uniform(60e-6, 120e-6);
    bool line = uniform(0, 1) < 0.4;
    return (fw_geometry_strip_piece){line ? uniform(60e-6, 300e-6) : r * fabs(angle),
                                     line ? 0 : copysign(1 / r, angle),
                                     {w, w * uniform(0.7, 1.4), w * uniform(0.7, 1.4)}};
}

/* the edges go through the stated places, and the width at any place is the distance between the
   points at which the normal meets them, found here by bisection along it */
static void edges_hold_the_widths(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        const fw_geometry_strip_piece p = random_piece();
        fw_geometry_strip_shape f;
        fw_geometry_strip_shape_of(&p, &f);
        const fw_geometry_pose start = {uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3), uniform(-3, 3)};
        for (int i = 0; i < 3; i++)
            assert_relative(fw_geometry_strip_width(&f, 0.5 * i * p.length_m), p.width_m[i], 1e-11);
        for (int i = 0; i <= 8; i++) {
            double s = p.length_m * i / 8, w = fw_geometry_strip_width(&f, s),
                   m = fw_geometry_strip_aside(&f, s);
            const fw_geometry_pose at = fw_geometry_strip_along(start, p.curvature_per_m, s);
            for (int side = 0; side < 2; side++) {
                const fw_geometry_segment e = fw_geometry_strip_edge(&f, start, side);
                double off = m + (side ? -0.5 : 0.5) * w, t;
                fw_geometry_vec2 q = {at.x_m - off * sin(at.angle_rad),
                                      at.y_m + off * cos(at.angle_rad)},
                                 on;
                assert_near(fw_geometry_segment_nearest(&e, q, &t, &on), 0, 1e-14);
            }
        }
    }
}

/* outline, counter-clockwise, with a JOINT segment at either end */
static fw_status contour_of(fw_arena *arena, const fw_geometry_strip_piece *piece, int n,
                            fw_geometry_pose start, fw_geometry_contour *contour) {
    fw_geometry_segment left[FW_STRIP_MOST], right[FW_STRIP_MOST];
    fw_geometry_pose at = start;
    for (int i = 0; i < n; i++) {
        fw_geometry_strip_shape f;
        fw_geometry_strip_shape_of(&piece[i], &f);
        left[i] = fw_geometry_strip_edge(&f, at, 0);
        right[i] = fw_geometry_strip_edge(&f, at, 1);
        at = fw_geometry_strip_along(at, piece[i].curvature_per_m, piece[i].length_m);
    }
    fw_geometry_outline k = fw_geometry_outline_start(arena, right[0].a);
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 to = i + 1 < n ? right[i + 1].a : right[i].b;
        if (right[i].kind == FW_LINE)
            fw_geometry_outline_line(&k, to, 0);
        else
            fw_geometry_outline_arc_to(&k, right[i].centre, right[i].sweep_rad, to, 0);
    }
    fw_geometry_outline_line(&k, left[n - 1].b, FW_SEGMENT_JOINT);
    for (int i = n - 1; i >= 0; i--) {
        if (left[i].kind == FW_LINE)
            fw_geometry_outline_line(&k, left[i].a, 0);
        else
            fw_geometry_outline_arc_to(&k, left[i].centre, -left[i].sweep_rad, left[i].a, 0);
    }
    fw_geometry_outline_line(&k, right[0].a, FW_SEGMENT_JOINT);
    return fw_geometry_outline_close(&k, contour);
}

/* one width: concentric arcs; area of an arc = its length times its width; of a line with straight
   edges mean width times length; of any strip against a fine polygon of it */
static void area_in_closed_form(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_contour c;
    const fw_geometry_strip_piece three[3] = {{120e-6, 0, {9e-6, 8e-6, 7e-6}},
                                              {80e-6 * 2.2, 1 / 80e-6, {7e-6, 7e-6, 7e-6}},
                                              {60e-6, 0, {7e-6, 7.5e-6, 8e-6}}};
    assert_int_equal(contour_of(arena, three, 3, (fw_geometry_pose){1e-3, -2e-3, 0.7}, &c), FW_OK);
    assert_relative(fw_geometry_contour_area(&c),
                    120e-6 * 8e-6 + 80e-6 * 2.2 * 7e-6 + 60e-6 * 7.5e-6, 1e-9);
    for (int trial = 0; trial < 50; trial++) {
        fw_geometry_strip_piece p = random_piece();
        p.length_m = fmin(p.length_m, fabs(3.0 / p.curvature_per_m));
        fw_geometry_strip_shape f;
        fw_geometry_strip_shape_of(&p, &f);
        assert_int_equal(contour_of(arena, &p, 1, (fw_geometry_pose){0, 0, 0.3}, &c), FW_OK);
        double sum = 0; /* int over s of int (1 - k n) dn between the edges, Simpson */
        enum { N = 2000 };
        for (int i = 0; i <= N; i++) {
            double s = p.length_m * i / N, w = fw_geometry_strip_width(&f, s),
                   m = fw_geometry_strip_aside(&f, s);
            sum += (i == 0 || i == N ? 1 : i % 2 ? 4 : 2) * w * (1 - p.curvature_per_m * m);
        }
        assert_relative(fw_geometry_contour_area(&c), sum * p.length_m / (3 * N), 1e-9);
        assert_true(fw_geometry_contour_valid(&c));
    }
    fw_arena_free(arena);
}

static void turned_is_the_mirror_image(void **state) {
    (void)state;
    for (int trial = 0; trial < 50; trial++) {
        fw_geometry_strip_piece p[4], back[4], again[4];
        for (int i = 0; i < 4; i++)
            p[i] = random_piece();
        fw_geometry_strip_turned(p, 4, back);
        fw_geometry_strip_turned(back, 4, again);
        assert_memory_equal(p, again, sizeof p);
        const fw_geometry_pose a = fw_geometry_strip_end(p, 4, (fw_geometry_pose){0}),
                               b = fw_geometry_strip_end(back, 4, (fw_geometry_pose){0});
        /* same chord, and the same turn to the left */
        assert_relative(hypot(a.x_m, a.y_m), hypot(b.x_m, b.y_m), 1e-9);
        assert_near(a.angle_rad, b.angle_rad, 1e-12);
    }
}

static void crossings_are_found(void **state) {
    (void)state;
    int i, j;
    const double w = 8e-6, r = 60e-6;
    const fw_geometry_strip_piece loop[2] = {{200e-6, 0, {w, w, w}}, {r * 6, 1 / r, {w, w, w}}};
    assert_true(fw_geometry_strip_crosses(loop, 2, &i, &j));
    assert_int_equal(i, 0);
    assert_int_equal(j, 1);
    const fw_geometry_strip_piece snake[3] = {
        {r * 3, 1 / r, {w, w, w}}, {r * 3, -1 / r, {w, w, w}}, {r * 3, 1 / r, {w, w, w}}};
    assert_false(fw_geometry_strip_crosses(snake, 3, &i, &j));
    const fw_geometry_strip_piece fat[1] = {{r * 6.2, 1 / r, {w, w, w}}};
    assert_false(fw_geometry_strip_crosses(fat, 1, &i, &j));
}

/* nothing is found where a width vanishes between places that are wide enough */
static void a_width_that_vanishes_is_seen(void **state) {
    (void)state;
    fw_geometry_strip_shape f;
    double low, high;
    const fw_geometry_strip_piece thin = {100e-6, 0, {20e-6, 1e-6, 2e-6}};
    fw_geometry_strip_shape_of(&thin, &f);
    fw_geometry_strip_widths(&f, &low, &high);
    assert_true(!(low >= 1e-7));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_hold_the_widths),         cmocka_unit_test(area_in_closed_form),
        cmocka_unit_test(turned_is_the_mirror_image),    cmocka_unit_test(crossings_are_found),
        cmocka_unit_test(a_width_that_vanishes_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
