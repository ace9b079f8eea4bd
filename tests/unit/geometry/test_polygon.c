/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"
#include "geometry/polygon.h"
#include <time.h>

static int64_t cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

static bool on(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    int64_t x0 = a.x_dbu, x1 = b.x_dbu, y0 = a.y_dbu, y1 = b.y_dbu, x = c.x_dbu, y = c.y_dbu;
    return cross(a, b, c) == 0 && (x - x0) * (x - x1) <= 0 && (y - y0) * (y - y1) <= 0;
}

static int sign(int64_t v) {
    return (v > 0) - (v < 0);
}

/* every pair of edges, by definition */
static bool simple_by_pairs(const fw_geometry_polygon *p) {
    int n = p->count;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++) {
            fw_geometry_point a = p->vertex[i], b = p->vertex[(i + 1) % n];
            fw_geometry_point c = p->vertex[j], d = p->vertex[(j + 1) % n];
            bool after = j == i + 1, before = i == 0 && j == n - 1;
            if (after || before) {
                fw_geometry_point shared = after ? b : a, p0 = after ? a : b, p1 = after ? d : c;
                if (on(shared, p0, p1) || on(shared, p1, p0)) return false;
                continue;
            }
            if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return false;
            if (sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 &&
                sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0)
                return false;
        }
    return true;
}

static bool edges_clash(const fw_geometry_polygon *p, int i, int j) {
    int n = p->count;
    fw_geometry_point a = p->vertex[i], b = p->vertex[(i + 1) % n];
    fw_geometry_point c = p->vertex[j], d = p->vertex[(j + 1) % n];
    return on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b) ||
           (sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 &&
            sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0);
}

/* the sweep over chains proves a polygon when and only when it is simple */
static void assert_proved(fw_arena *arena, const fw_geometry_polygon *p,
                          const fw_geometry_polygon_report *report) {
    bool proved;
    if (report->zero_edges > 0) return; /* not asked then */
    assert_int_equal(fw_geometry_polygon_prove(arena, p, &proved), FW_OK);
    assert_int_equal(proved, report->simple);
}

/* small coordinates make touches, overlaps, spikes and repeated vertices common */
static void agrees_with_all_pairs(void **state) {
    int simple = 0, not_simple = 0;
    for (int i = 0; i < 200000; i++) {
        int n = whole(3, 9), range = i % 2 ? 4 : 12;
        fw_geometry_point v[9];
        for (int k = 0; k < n; k++)
            v[k] = (fw_geometry_point){whole(0, range), whole(0, range)};
        fw_geometry_polygon p = {v, n};
        fw_geometry_polygon_report report;
        fw_mark mark = fw_arena_mark(*state);
        assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
        assert_proved(*state, &p, &report);
        fw_arena_rewind(*state, mark);
        bool want = simple_by_pairs(&p);
        assert_int_equal(report.simple, want);
        if (want) {
            simple++;
            assert_int_equal(report.bad_i, -1);
        } else {
            not_simple++;
            assert_true(report.bad_i >= 0 && report.bad_j < n && report.bad_i != report.bad_j);
            assert_true(edges_clash(&p, report.bad_i, report.bad_j));
        }
    }
    assert_true(simple > 10000 && not_simple > 10000);
}

/* larger star-shaped polygons, one vertex pushed to a random place */
static void agrees_on_larger_polygons(void **state) {
    int simple = 0, not_simple = 0;
    for (int i = 0; i < 1500; i++) {
        enum { N = 120 };
        fw_geometry_point v[N];
        for (int k = 0; k < N; k++) {
            double r = uniform(300, 1000), angle = FW_TURN * k / N;
            v[k] = (fw_geometry_point){(int32_t)(r * cos(angle)), (int32_t)(r * sin(angle))};
        }
        if (i % 2) v[whole(0, N - 1)] = (fw_geometry_point){whole(-1000, 1000), whole(-1000, 1000)};
        fw_geometry_polygon p = {v, N};
        fw_geometry_polygon_report report;
        fw_mark mark = fw_arena_mark(*state);
        assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
        assert_proved(*state, &p, &report);
        fw_arena_rewind(*state, mark);
        assert_int_equal(report.simple, simple_by_pairs(&p));
        simple += report.simple;
        not_simple += !report.simple;
    }
    assert_true(simple > 500 && not_simple > 300);
}

/* corners, spikes and straight vertices by definition, on small random polygons */
static void measures_what_is_there(void **state) {
    int spikes = 0, zero = 0, straight = 0;
    for (int i = 0; i < 20000; i++) {
        int n = whole(3, 8);
        fw_geometry_point v[8];
        for (int k = 0; k < n; k++)
            v[k] = (fw_geometry_point){whole(-5, 5), whole(-5, 5)};
        fw_geometry_polygon p = {v, n};
        fw_geometry_polygon_report report;
        fw_mark mark = fw_arena_mark(*state);
        assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
        fw_arena_rewind(*state, mark);
        double shortest = HUGE_VAL, sharpest[2] = {FW_PI, FW_PI};
        int count[3] = {0};
        bool acute = false;
        for (int k = 0; k < n; k++) {
            fw_geometry_point a = v[k], b = v[(k + 1) % n], c = v[(k + 2) % n];
            double ux = a.x_dbu - b.x_dbu, uy = a.y_dbu - b.y_dbu;
            double vx = c.x_dbu - b.x_dbu, vy = c.y_dbu - b.y_dbu;
            double turn = ux * vy - uy * vx, dot = ux * vx + uy * vy;
            shortest = fmin(shortest, 1e-9 * hypot(vx, vy));
            acute = acute || dot > 0;
            count[0] += hypot(vx, vy) == 0;
            count[1] += turn == 0 && dot > 0;
            count[2] += turn == 0 && dot < 0;
            if (turn != 0) sharpest[turn > 0] = fmin(sharpest[turn > 0], atan2(fabs(turn), dot));
        }
        assert_near(report.shortest_edge_m, shortest, 1e-20);
        assert_int_equal(report.zero_edges, count[0]);
        assert_int_equal(report.spikes, count[1]);
        assert_int_equal(report.straight, count[2]);
        if (!report.simple) continue;
        assert_int_equal(report.acute, acute);
        assert_near(report.sharpest_material_rad, sharpest[0], 1e-12);
        assert_near(report.sharpest_space_rad, sharpest[1], 1e-12);
        assert_near(report.sharpest_rad, fmin(sharpest[0], sharpest[1]), 1e-12);
        zero += count[0], spikes += count[1], straight += count[2];
    }
    print_message("%d straight vertices\n", straight);
    assert_true(zero == 0 && spikes == 0 && straight > 50);
}

static void measures_edge_and_angle(void **state) {
    fw_geometry_point v[] = {{0, 0}, {1000, 0}, {1000, 3}, {0, 2000}};
    fw_geometry_polygon_report report;
    assert_int_equal(fw_geometry_polygon_check(*state, &(fw_geometry_polygon){v, 4}, &report),
                     FW_OK);
    assert_true(report.simple);
    assert_near(report.shortest_edge_m, 3e-9, 1e-22);
    assert_near(report.sharpest_rad, atan2(1000, 1997), 1e-12);
}

/* a comb with long teeth: any sweep by x alone or grid of mean edge length has all edges at once.
   The time is printed, not judged. */
static void large_polygons_are_certified(void **state) {
    int n = 100000;
    fw_geometry_point *v = calloc((size_t)n, sizeof *v);
    assert_non_null(v);
    for (int k = 0; k < n; k++)
        v[k] = (fw_geometry_point){k % 2 ? 900000000 : (k == 0 || k == n - 2 ? 0 : 10), 10 * k};
    v[n - 1] = (fw_geometry_point){-5, 10 * n};
    fw_geometry_polygon p = {v, n};
    fw_geometry_polygon_report report;
    clock_t start = clock();
    assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
    print_message("1e5 vertices: %.3f s\n", (double)(clock() - start) / CLOCKS_PER_SEC);
    assert_true(report.simple);
    v[5001].y_dbu -= 25; /* one tooth reaches over its neighbour */
    assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
    assert_false(report.simple);
    assert_true(abs(report.bad_i - 5000) < 6 && abs(report.bad_j - 5000) < 6);
    free(v);
}

/* flattened outlines of booleans are simple */
static void flattened_outlines_are_simple(void **state) {
    int checked = 0;
    for (int i = 0; i < 1000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        fw_geometry_contour a = random_shape(*state, 1e-4, 0), b = random_shape(*state, 1e-4, 0);
        fw_geometry_region p = region_of(&a), q = region_of(&b), any;
        assert_int_equal(fw_geometry_region_boolean(*state, &p, &q, FW_UNION, &any), FW_OK);
        for (int k = 0; k < any.count; k++) {
            fw_geometry_polygon flat;
            fw_geometry_polygon_report report;
            assert_int_equal(fw_geometry_tessellate(*state, &any.contour[k], 5e-9, &flat), FW_OK);
            assert_int_equal(fw_geometry_polygon_check(*state, &flat, &report), FW_OK);
            /* the bound: clear of itself by more than 2 (eps + g / sqrt 2), corners not needles */
            if (report.sharpest_rad > 0.2) {
                assert_true(report.simple);
                checked++;
            }
        }
        fw_arena_rewind(*state, mark);
    }
    assert_true(checked > 700);
}

static void errors(void **state) {
    fw_geometry_point v[] = {{0, 0}, {1 << 30, 0}, {0, 5}};
    fw_geometry_polygon_report report;
    assert_int_equal(fw_geometry_polygon_check(*state, &(fw_geometry_polygon){v, 3}, &report),
                     FW_LIMIT);
    assert_int_equal(fw_geometry_polygon_check(*state, &(fw_geometry_polygon){v, 2}, &report),
                     FW_GEOMETRY);
    v[1].x_dbu = 7;
    fw_arena_fail_at(1, 1);
    assert_int_equal(fw_geometry_polygon_check(*state, &(fw_geometry_polygon){v, 3}, &report),
                     FW_NOMEM);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(agrees_with_all_pairs),
        geo_test(agrees_on_larger_polygons),
        geo_test(measures_what_is_there),
        geo_test(measures_edge_and_angle),
        geo_test(large_polygons_are_certified),
        geo_test(flattened_outlines_are_simple),
        geo_test(errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
