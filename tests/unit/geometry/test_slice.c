/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"
#include "geometry/polygon.h"

static double length_of(fw_geometry_slices p) {
    double sum = 0.0;
    for (int i = 0; i < p.n; i++)
        sum += p.item[i].to_m - p.item[i].from_m;
    return sum;
}

/* ends: yes */
static bool contain(fw_geometry_slices p, double s_m) {
    for (int i = 0; i < p.n; i++)
        if (s_m >= p.item[i].from_m && s_m <= p.item[i].to_m) return true;
    return false;
}

static fw_geometry_cut_line line_at(double x, double y, double angle) {
    return (fw_geometry_cut_line){{x, y}, {cos(angle), sin(angle)}};
}

static fw_geometry_slices sliced(fw_arena *arena, const fw_geometry_contour *c,
                                 fw_geometry_cut_line line) {
    fw_geometry_slices s;
    assert_int_equal(fw_geometry_contour_slice(arena, c, line, &s), FW_OK);
    for (int i = 0; i < s.n; i++) {
        assert_true(s.item[i].from_m < s.item[i].to_m);
        assert_true(i == 0 || s.item[i - 1].to_m < s.item[i].from_m);
    }
    return s;
}

/* a chord of a circle at distance h is 2 sqrt(r^2 - h^2) long and cut at the angle acos(h/r) */
static void chords_of_discs(void **state) {
    fw_arena *arena = *state;
    for (int i = 0; i < 2000; i++) {
        double r = uniform(1e-6, 1e-3), x = uniform(-1e-2, 1e-2), y = uniform(-1e-2, 1e-2);
        double angle = uniform(0, FW_TURN), h = uniform(-1.5, 1.5) * r;
        fw_geometry_contour c;
        assert_int_equal(fw_geometry_contour_disc(arena, (fw_geometry_vec2){x, y}, r, &c), FW_OK);
        fw_geometry_cut_line line = line_at(x - h * sin(angle), y + h * cos(angle), angle);
        fw_geometry_slices s = sliced(arena, &c, line);
        if (fabs(h) >= r) {
            assert_int_equal(s.n, 0);
            continue;
        }
        double half = sqrt((r - h) * (r + h));
        if (half < 1e-3 * r) continue; /* grazing: the chord is as long as rounding says */
        assert_int_equal(s.n, 1);
        assert_near(s.item[0].from_m, -half, 1e-17 * r / half + 1e-16);
        assert_near(s.item[0].to_m, half, 1e-17 * r / half + 1e-16);
        assert_near(s.item[0].from_sine, half / r, 1e-9);
        assert_near(s.item[0].to_sine, half / r, 1e-9);
    }
}

/* through the corners, along the edges, and the reverse outline: the same intervals */
static void a_square_on_its_corners(void **state) {
    fw_arena *arena = *state;
    fw_geometry_contour c, back;
    assert_int_equal(fw_geometry_contour_rectangle(arena, (fw_geometry_box){0, 0, 4e-6, 4e-6}, &c),
                     FW_OK);
    assert_int_equal(fw_geometry_contour_reverse(arena, &c, &back), FW_OK);
    fw_geometry_slices s = sliced(arena, &c, line_at(0, 0, FW_PI / 4));
    assert_int_equal(s.n, 1);
    assert_near(s.item[0].from_m, 0, 1e-20);
    assert_near(s.item[0].to_m, 4e-6 * sqrt(2.0), 1e-20);
    assert_near(s.item[0].from_sine, sqrt(0.5), 1e-12);
    s = sliced(arena, &back, line_at(0, 0, FW_PI / 4));
    assert_int_equal(s.n, 1);
    /* an edge on the line belongs to one side of it: the line lies a step to its own left */
    s = sliced(arena, &c, line_at(0, 0, 0));
    assert_int_equal(s.n, 1);
    assert_near(length_of(s), 4e-6, 1e-20);
    assert_int_equal(sliced(arena, &c, line_at(0, 4e-6, 0)).n, 0);
    assert_int_equal(sliced(arena, &c, line_at(0, 5e-6, 0)).n, 0);
    /* a touch at a corner is nothing, from either side */
    assert_near(length_of(sliced(arena, &c, line_at(0, 0, -FW_PI / 4))), 0, 1e-18);
    assert_near(length_of(sliced(arena, &c, line_at(0, 0, 3 * FW_PI / 4))), 0, 1e-18);
}

/* random lines through random outlines against their polygons, of which no edge is farther than
   1.5 nm + 0.71 nm away: along the cut that is so much over the sine */
static void random_lines_match_polygons(void **state) {
    fw_arena *arena = *state;
    int whole_ones = 0;
    for (int i = 0; i < 3000; i++) {
        fw_geometry_contour c = random_shape(arena, 1e-4, i % 3 == 0 ? 1e-5 : 0);
        fw_geometry_polygon p;
        if (fw_geometry_tessellate(arena, &c, 1.5e-9, &p) != FW_OK) continue;
        fw_geometry_cut_line line =
            line_at(uniform(-1e-4, 1e-4), uniform(-1e-4, 1e-4), uniform(0, FW_TURN));
        fw_geometry_slices s = sliced(arena, &c, line);
        fw_geometry_outline o = fw_geometry_outline_start(
            arena, (fw_geometry_vec2){1e-9 * p.vertex[0].x_dbu, 1e-9 * p.vertex[0].y_dbu});
        for (int k = 1; k < p.count; k++)
            fw_geometry_outline_line(
                &o, (fw_geometry_vec2){1e-9 * p.vertex[k].x_dbu, 1e-9 * p.vertex[k].y_dbu}, 0);
        fw_geometry_contour flat;
        assert_int_equal(fw_geometry_outline_close(&o, &flat), FW_OK);
        fw_geometry_slices t = sliced(arena, &flat, line);
        double least = 1.0;
        for (int k = 0; k < s.n; k++)
            least = fmin(least, fmin(s.item[k].from_sine, s.item[k].to_sine));
        if (least < 0.05 || s.n != t.n) continue; /* grazes: one of the two may miss it */
        whole_ones++;
        for (int k = 0; k < s.n; k++) {
            assert_near(s.item[k].from_m, t.item[k].from_m, 4e-9 / s.item[k].from_sine);
            assert_near(s.item[k].to_m, t.item[k].to_m, 4e-9 / s.item[k].to_sine);
        }
    }
    assert_true(whole_ones > 2400);
}

/* area = integral of the length over parallel lines; midpoint rule, whose error falls as h^(3/2) */
static void area_by_slices(void **state) {
    fw_arena *arena = *state;
    enum { LINES = 4000 };
    for (int i = 0; i < 12; i++) {
        fw_geometry_contour c = random_shape(arena, 1e-4, 0);
        double angle = uniform(0, FW_TURN), reach = 6e-4, sum = 0.0;
        fw_mark mark = fw_arena_mark(arena);
        for (int k = 0; k < LINES; k++) {
            double h = reach * ((k + 0.5) / LINES * 2.0 - 1.0);
            sum += length_of(sliced(arena, &c, line_at(-h * sin(angle), h * cos(angle), angle)));
            fw_arena_rewind(arena, mark);
        }
        double area = fw_geometry_contour_area(&c);
        assert_near(sum * 2.0 * reach / LINES, area, 2e-3 * area + 2e-12);
    }
}

/* both sides of a cut along a shared edge: nothing between them, nothing twice */
static void pieces_that_share_an_edge_are_one(void **state) {
    fw_arena *arena = *state;
    for (int i = 0; i < 500; i++) {
        double angle = uniform(0, FW_TURN), x = uniform(-1e-3, 1e-3), y = uniform(-1e-3, 1e-3);
        fw_geometry_vec2 u = {cos(angle), sin(angle)}, v = {-u.y, u.x};
        fw_geometry_vec2 p[4] = {
            {x, y}, vec_along((fw_geometry_vec2){x, y}, 1e-5, v), {0, 0}, {0, 0}};
        fw_geometry_contour side[2];
        for (int k = 0; k < 2; k++) { /* one to the left of the edge p0 p1, one to the right */
            double far = k ? 2e-5 : -3e-5;
            fw_geometry_outline o = fw_geometry_outline_start(arena, p[k]);
            fw_geometry_outline_line(&o, p[1 - k], 0);
            fw_geometry_outline_line(&o, vec_along(p[1 - k], far, u), 0);
            fw_geometry_outline_line(&o, vec_along(p[k], far, u), 0);
            assert_int_equal(fw_geometry_outline_close(&o, &side[k]), FW_OK);
        }
        double turn = uniform(-1.2, 1.2);
        fw_geometry_vec2 on = vec_along(p[0], uniform(0.3, 0.7) * 1e-5, v);
        fw_geometry_cut_line line = line_at(on.x, on.y, angle + 0.05 * turn);
        fw_geometry_slices a = sliced(arena, &side[0], line), b = sliced(arena, &side[1], line),
                           all, both;
        assert_int_equal(fw_geometry_slices_combine(arena, a, b, FW_SET_OR, &all), FW_OK);
        assert_int_equal(fw_geometry_slices_combine(arena, a, b, FW_SET_AND, &both), FW_OK);
        assert_int_equal(all.n, 1);
        assert_int_equal(both.n, 0);
        assert_near(length_of(all), length_of(a) + length_of(b), 1e-15);
    }
}

static fw_geometry_slices random_set(fw_arena *arena) {
    fw_geometry_slices s = {fw_arena_array(arena, fw_geometry_slice, 8), whole(0, 8)};
    double at = uniform(-1, 0);
    for (int i = 0; i < s.n; i++) {
        double from = at + uniform(0.01, 0.3), to = from + uniform(0.01, 0.3);
        s.item[i] = (fw_geometry_slice){from, to, 1, 1};
        at = to;
    }
    return s;
}

/* every rule at random points, and |p OR q| + |p AND q| = |p| + |q| */
static void sets(void **state) {
    fw_arena *arena = *state;
    for (int i = 0; i < 500; i++) {
        fw_geometry_slices p = random_set(arena), q = random_set(arena), r[4];
        for (int rule = 0; rule < 4; rule++)
            assert_int_equal(
                fw_geometry_slices_combine(arena, p, q, (fw_geometry_set_rule)rule, &r[rule]),
                FW_OK);
        for (int k = 0; k < 40; k++) {
            double s = uniform(-1, 5);
            bool in = contain(p, s), iq = contain(q, s);
            assert_int_equal(contain(r[FW_SET_OR], s), in || iq);
            assert_int_equal(contain(r[FW_SET_AND], s), in && iq);
            assert_int_equal(contain(r[FW_SET_NOT], s), in && !iq);
            assert_int_equal(contain(r[FW_SET_XOR], s), in != iq);
        }
        assert_near(length_of(r[FW_SET_OR]) + length_of(r[FW_SET_AND]), length_of(p) + length_of(q),
                    1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(chords_of_discs),
        geo_test(a_square_on_its_corners),
        geo_test(area_by_slices),
        geo_test(random_lines_match_polygons),
        geo_test(sets),
        geo_test(pieces_that_share_an_edge_are_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
