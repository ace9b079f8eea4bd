/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"
#include "geometry/polygon.h"

/* Euler: n - 2 triangles, every side once, every diagonal once each way, and areas that add up, all
   positive: then they tile the polygon */
static void assert_tiles(fw_arena *arena, const fw_geometry_polygon *p) {
    fw_geometry_polygon_triangle *t =
        fw_arena_array(arena, fw_geometry_polygon_triangle, (size_t)p->count);
    assert_int_equal(fw_geometry_polygon_triangulate(arena, p, t), FW_OK);
    int64_t sum = 0;
    int sides = 0, inner = 0, n = p->count;
    for (int i = 0; i < n - 2; i++) {
        const int *v = t[i].vertex;
        int64_t area2 = fw_cross(p->vertex[v[0]], p->vertex[v[1]], p->vertex[v[2]]);
        assert_true(area2 > 0);
        sum += area2;
        for (int k = 0; k < 3; k++) {
            int a = v[k], b = v[(k + 1) % 3], twins = 0, same = 0;
            if (b == (a + 1) % n) sides++;
            for (int j = 0; j < n - 2; j++)
                for (int m = 0; m < 3; m++) {
                    twins += t[j].vertex[m] == b && t[j].vertex[(m + 1) % 3] == a;
                    same += t[j].vertex[m] == a && t[j].vertex[(m + 1) % 3] == b;
                }
            assert_int_equal(same, 1);
            assert_int_equal(twins, b == (a + 1) % n ? 0 : 1);
            inner += twins;
        }
    }
    assert_int_equal(sides, n);
    assert_int_equal(inner, 2 * (n - 3));
    assert_true(sum == fw_geometry_polygon_area2(p));
}

static void small_random_polygons(void **state) {
    int tiled = 0, straight = 0;
    for (int i = 0; i < 60000; i++) {
        int n = whole(3, 10);
        fw_geometry_point v[10];
        for (int k = 0; k < n; k++)
            v[k] = (fw_geometry_point){whole(0, 6), whole(0, 6)};
        fw_geometry_polygon p = {v, n};
        fw_geometry_polygon_report report;
        fw_mark mark = fw_arena_mark(*state);
        assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
        if (report.simple && fw_geometry_polygon_area2(&p) > 0) {
            assert_tiles(*state, &p);
            tiled++;
            straight += report.straight;
        }
        fw_arena_rewind(*state, mark);
    }
    print_message("%d polygons with %d straight vertices\n", tiled, straight);
    assert_true(tiled > 3000 && straight > 200);
}

static void flattened_shapes(void **state) {
    for (int i = 0; i < 60; i++) {
        fw_mark mark = fw_arena_mark(*state);
        fw_geometry_contour c = random_shape(*state, 3e-5, 0);
        fw_geometry_polygon p;
        fw_geometry_polygon_report report;
        assert_int_equal(fw_geometry_tessellate(*state, &c, 2e-8, &p), FW_OK);
        assert_int_equal(fw_geometry_polygon_check(*state, &p, &report), FW_OK);
        if (report.simple) assert_tiles(*state, &p);
        fw_arena_rewind(*state, mark);
    }
}

static void what_is_not_simple_is_refused(void **state) {
    fw_geometry_point bow[] = {{0, 0}, {10, 10}, {10, 0}, {0, 10}},
                      flat[] = {{0, 0}, {5, 0}, {9, 0}};
    fw_geometry_polygon_triangle t[4];
    assert_int_equal(fw_geometry_polygon_triangulate(*state, &(fw_geometry_polygon){bow, 4}, t),
                     FW_GEOMETRY);
    assert_int_equal(fw_geometry_polygon_triangulate(*state, &(fw_geometry_polygon){flat, 3}, t),
                     FW_GEOMETRY);
    assert_int_equal(fw_geometry_polygon_triangulate(*state, &(fw_geometry_polygon){flat, 2}, t),
                     FW_GEOMETRY);
    for (int n = 1; n <= 4; n++) {
        fw_arena_fail_at(n, 0);
        assert_int_equal(fw_geometry_polygon_triangulate(*state, &(fw_geometry_polygon){bow, 4}, t),
                         FW_NOMEM);
        fw_arena_fail_at(0, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(small_random_polygons),
        geo_test(flattened_shapes),
        geo_test(what_is_not_simple_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
