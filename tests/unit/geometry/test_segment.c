/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

static fw_geometry_segment random_segment(double size) {
    fw_geometry_vec2 a = {uniform(-size, size), uniform(-size, size)};
    if (whole(0, 1) == 0)
        return (fw_geometry_segment){
            .kind = FW_LINE, .a = a, .b = {uniform(-size, size), uniform(-size, size)}};
    double r = uniform(0.1, 1) * size, start = uniform(0, FW_TURN), sweep = uniform(-6.2, 6.2);
    fw_geometry_vec2 from = {a.x + r * cos(start), a.y + r * sin(start)};
    fw_geometry_vec2 to = {a.x + r * cos(start + sweep), a.y + r * sin(start + sweep)};
    return (fw_geometry_segment){FW_ARC, 0, from, to, a, r, sweep};
}

static void points_lie_on_the_segment(void **state) {
    (void)state;
    for (int i = 0; i < 2000; i++) {
        fw_geometry_segment s = random_segment(1e-4);
        double t = uniform(0, 1), back;
        fw_geometry_vec2 p = fw_geometry_segment_point(&s, t), at;
        assert_near(fw_geometry_segment_nearest(&s, p, &back, &at), 0, 1e-19);
        assert_near(back, t, 1e-12);
        assert_near(fw_geometry_segment_parameter(&s, p), t, 1e-12);
        assert_true(vec_same(fw_geometry_segment_point(&s, 0), s.a) &&
                    vec_same(fw_geometry_segment_point(&s, 1), s.b));
        fw_geometry_vec2 ahead = vec_sub(fw_geometry_segment_point(&s, t + 1e-6),
                                         fw_geometry_segment_point(&s, t - 1e-6));
        fw_geometry_vec2 tangent = fw_geometry_segment_tangent(&s, t);
        assert_near(fw_geometry_vec_angle(tangent, ahead), 0, 1e-5);
        fw_geometry_box box = fw_segment_box(&s);
        assert_true(p.x >= box.x0 - 1e-19 && p.x <= box.x1 + 1e-19 && p.y >= box.y0 - 1e-19 &&
                    p.y <= box.y1 + 1e-19);
    }
}

/* number of crossings of a finely flattened pair, as a witness */
static int flat_crossings(const fw_geometry_segment *p, const fw_geometry_segment *q) {
    enum { STEPS = 400 };
    int n = 0;
    for (int i = 0; i < STEPS; i++) {
        fw_geometry_vec2 a = fw_geometry_segment_point(p, (double)i / STEPS);
        fw_geometry_vec2 b = fw_geometry_segment_point(p, (double)(i + 1) / STEPS);
        for (int k = 0; k < STEPS; k++) {
            fw_geometry_vec2 c = fw_geometry_segment_point(q, (double)k / STEPS);
            fw_geometry_vec2 d = fw_geometry_segment_point(q, (double)(k + 1) / STEPS);
            fw_geometry_vec2 u = vec_sub(b, a), v = vec_sub(d, c);
            bool split = (vec_cross(u, vec_sub(c, a)) > 0) != (vec_cross(u, vec_sub(d, a)) > 0);
            bool cut = (vec_cross(v, vec_sub(a, c)) > 0) != (vec_cross(v, vec_sub(b, c)) > 0);
            n += split && cut;
        }
    }
    return n;
}

static void intersections_match_a_flattened_pair(void **state) {
    (void)state;
    int differ = 0, total = 0;
    int pairs = test_cases(500, 200);
    for (int i = 0; i < pairs; i++) {
        fw_geometry_segment p = random_segment(1e-4), q = random_segment(1e-4);
        fw_geometry_hit hit[FW_MOST_HITS];
        int n = fw_geometry_segment_intersect(&p, &q, hit);
        for (int k = 0; k < n; k++) {
            assert_near(vec_distance(fw_geometry_segment_point(&p, hit[k].tp), hit[k].at), 0,
                        2e-16);
            assert_near(vec_distance(fw_geometry_segment_point(&q, hit[k].tq), hit[k].at), 0,
                        2e-16);
        }
        total += n;
        differ += n != flat_crossings(&p, &q);
    }
    assert_true(total > pairs / 6);
    assert_int_equal(differ, 0);
}

static void touches_are_one_point(void **state) {
    (void)state;
    fw_geometry_vec2 hit[2], c = {3e-3, -2e-3};
    for (int i = 0; i < 1000; i++) {
        double r = pow(10, uniform(-6, -2)), angle = uniform(0, FW_TURN);
        fw_geometry_vec2 n = {cos(angle), sin(angle)}, at = vec_along(c, r, n), u = vec_left(n);
        assert_int_equal(fw_geometry_line_circle(vec_along(at, -0.3 * r, u), u, c, r, hit), 1);
        assert_near(vec_distance(hit[0], at), 0, 1e-17);
        double r2 = r * uniform(0.1, 0.9);
        assert_int_equal(fw_geometry_circle_circle(c, r, vec_along(c, r - r2, n), r2, hit), 1);
        assert_near(vec_distance(hit[0], at), 0, 1e-16);
        assert_int_equal(fw_geometry_circle_circle(c, r, vec_along(c, r + r2, n), r2, hit), 1);
        assert_near(vec_distance(hit[0], at), 0, 1e-16);
        assert_int_equal(fw_geometry_line_circle(vec_along(at, 3e-12, n), u, c, r, hit), 0);
        assert_int_equal(fw_geometry_line_circle(vec_along(at, -3e-12, n), u, c, r, hit), 2);
    }
}

static void overlaps_give_their_ends(void **state) {
    (void)state;
    fw_geometry_segment p = {.kind = FW_LINE, .a = {0, 0}, .b = {4e-5, 0}};
    fw_geometry_segment q = {.kind = FW_LINE, .a = {6e-5, 0}, .b = {1e-5, 0}};
    fw_geometry_hit hit[FW_MOST_HITS];
    assert_int_equal(fw_geometry_segment_intersect(&p, &q, hit), 2);
    assert_near(hit[0].at.x, 4e-5, 0);
    assert_near(hit[1].at.x, 1e-5, 0);
    assert_near(hit[1].tp, 0.25, 1e-15);
}

/* never more than the distance of any point of the box from any point of the arc, and more than
   nothing where the box is clear of the circle */
static void bound_of_an_arc_and_a_box(void **state) {
    (void)state;
    int clear = 0;
    for (int i = 0; i < 2000; i++) {
        fw_geometry_vec2 c = {uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3)};
        double r = uniform(1e-5, 5e-4), from = uniform(0, 6), w = uniform(-6, 6);
        fw_geometry_segment s = {FW_ARC,
                                 0,
                                 {c.x + r * cos(from), c.y + r * sin(from)},
                                 {c.x + r * cos(from + w), c.y + r * sin(from + w)},
                                 c,
                                 r,
                                 w};
        double x = c.x + uniform(-7e-4, 7e-4), y = c.y + uniform(-7e-4, 7e-4);
        fw_geometry_box b = {x, y, x + uniform(0, 1e-4), y + uniform(0, 1e-4)};
        double bound = fw_geometry_segment_clear_of(&s, &b), least = HUGE_VAL;
        for (int k = 0; k <= 8; k++)
            for (int m = 0; m <= 8; m++) {
                fw_geometry_vec2 p = {b.x0 + (b.x1 - b.x0) * k / 8, b.y0 + (b.y1 - b.y0) * m / 8};
                least = fmin(least, fw_geometry_segment_nearest(&s, p, NULL, NULL));
            }
        assert_true(bound >= 0 && bound <= least);
        clear += bound > 1e-6;
        s.kind = FW_LINE;
        assert_true(fw_geometry_segment_clear_of(&s, &b) == 0);
    }
    assert_true(clear > 500);
}

/* the same answer as the nearest point's, also a hair on either side of the reach */
static void within_is_nearest(void **state) {
    (void)state;
    int in = 0;
    for (int i = 0; i < 20000; i++) {
        fw_geometry_segment s = random_segment(1e-4);
        fw_geometry_vec2 p = {uniform(-2e-4, 2e-4), uniform(-2e-4, 2e-4)};
        double far = fw_geometry_segment_nearest(&s, p, NULL, NULL), reach = uniform(1e-6, 2e-4);
        const double hair[] = {0.5, 1 - 1e-12, 1, 1 + 1e-12, 2};
        fw_geometry_near near = fw_geometry_near_of(&s, reach);
        assert_int_equal(fw_geometry_is_near(&near, p), far <= reach);
        in += far <= reach;
        for (int k = 0; k < 5; k++) {
            near = fw_geometry_near_of(&s, hair[k] * far);
            assert_int_equal(fw_geometry_is_near(&near, p), far <= hair[k] * far);
        }
    }
    assert_true(in > 5000 && in < 19000);
}

/* a row of places at once says what each says by itself, of level lines too, and leaves what was set */
static void rows_are_their_places(void **state) {
    (void)state;
    enum { PLACES = 80 };
    int level = 0, set = 0;
    for (int i = 0; i < 4000; i++) {
        fw_geometry_segment s = random_segment(1e-4);
        if (i % 2) s.kind = FW_LINE, s.radius = s.sweep_rad = 0;
        if (i % 4 == 1) s.b.y = s.a.y;
        double step = uniform(1e-6, 6e-6), from_x = uniform(-2e-4, 0), reach = 0.7072 * step;
        double y = s.a.y + uniform(-2, 2) * step;
        unsigned char row[PLACES], before[PLACES];
        int first = whole(0, PLACES / 2), last = whole(first - 1, PLACES - 1);
        for (int k = 0; k < PLACES; k++)
            row[k] = before[k] = uniform(0, 1) < 0.2;
        fw_geometry_near near = fw_geometry_near_of(&s, reach);
        fw_geometry_near_row(&near, from_x, step, y, first, last, row);
        for (int k = 0; k < PLACES; k++) {
            bool is = k >= first && k <= last &&
                      fw_geometry_is_near(&near, (fw_geometry_vec2){from_x + (k + 0.5) * step, y});
            assert_int_equal(row[k], before[k] || is);
            set += is, level += is && i % 4 == 1;
        }
    }
    assert_true(level > 1000 && set - level > 300);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_lie_on_the_segment),
        cmocka_unit_test(intersections_match_a_flattened_pair),
        cmocka_unit_test(touches_are_one_point),
        cmocka_unit_test(overlaps_give_their_ends),
        geo_test(bound_of_an_arc_and_a_box),
        geo_test(within_is_nearest),
        geo_test(rows_are_their_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
