/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geo.h"

#define GRID 1e-9
#define SNAP (0.70710678118654757 * GRID)

static fw_geometry_vec2 metres(fw_geometry_point p) {
    return (fw_geometry_vec2){p.x_dbu * GRID, p.y_dbu * GRID};
}

/* vertex error <= g / sqrt 2 and edge error <= eps + g / sqrt 2, against the exact outline */
static double to_edge(fw_geometry_vec2 at, fw_geometry_vec2 a, fw_geometry_vec2 b) {
    fw_geometry_segment s = {.kind = FW_LINE, .a = a, .b = b};
    return fw_geometry_segment_nearest(&s, at, NULL, NULL);
}

/* Hausdorff distance and area against what is told of both, either way of flattening */
static void told_bounds_hold(void **state) {
    double worst[2] = {0, 0}, area[2] = {0, 0};
    for (int i = 0; i < 400; i++) {
        fw_mark mark = fw_arena_mark(*state);
        fw_geometry_flattening kind = i % 2 ? FW_FLATTEN_EQUAL_AREA : FW_FLATTEN_INSIDE;
        double size = pow(10, uniform(-5.5, -3.5)), eps = pow(10, uniform(-8.84, -7));
        fw_geometry_contour c = random_shape(*state, size, 0);
        fw_geometry_region exact = region_of(&c);
        fw_geometry_polygon p;
        fw_geometry_flat_bounds bound;
        assert_int_equal(fw_geometry_flatten(*state, &c, eps, kind, &p, &bound), FW_OK);
        assert_true(bound.edge_m <= eps * (1 + 1e-6) + SNAP * (1 + 1e-9));
        for (int k = 0; k < p.count; k++) {
            fw_geometry_vec2 a = metres(p.vertex[k]), b = metres(p.vertex[(k + 1) % p.count]);
            for (int n = 0; n < 8; n++)
                worst[0] = fmax(worst[0], region_edge(&exact, vec_along(a, n / 8., vec_sub(b, a))) /
                                              bound.edge_m);
        }
        for (int k = 0; k < 40; k++) {
            const fw_geometry_segment *s = &c.segment[whole(0, c.count - 1)];
            fw_geometry_vec2 at = fw_geometry_segment_point(s, uniform(0, 1));
            double least = HUGE_VAL;
            for (int n = 0; n < p.count; n++)
                least = fmin(least,
                             to_edge(at, metres(p.vertex[n]), metres(p.vertex[(n + 1) % p.count])));
            worst[1] = fmax(worst[1], least / bound.edge_m);
        }
        double flat = (double)fw_geometry_polygon_area2(&p) * 0.5 * GRID * GRID;
        double error = fabs(flat - fw_geometry_contour_area(&c)) / bound.area_m2;
        area[kind] = fmax(area[kind], error);
        fw_arena_rewind(*state, mark);
    }
    print_message("of the bounds: edge %.3f, outline %.3f, area %.3f inside, %.3f equal\n",
                  worst[0], worst[1], area[0], area[1]);
    assert_true(worst[0] <= 1 + 1e-9 && worst[0] > 0.8);
    assert_true(worst[1] <= 1 + 1e-9 && worst[1] > 0.6);
    assert_true(area[0] <= 1 && area[0] > 0.5 && area[1] <= 1 && area[1] > 0.05);
}

/* on a grid that is fine beside the arc the chords enclose its area, ends and all */
static void equal_area_is_equal(void **state) {
    double worst = 0;
    for (int i = 0; i < 300; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double r = uniform(2e-3, 2e-2), w = FW_TURN, eps = pow(10, uniform(-7, -6));
        fw_geometry_contour c;
        fw_geometry_polygon p, inside;
        fw_geometry_flat_bounds bound;
        assert_int_equal(fw_geometry_contour_disc(*state, (fw_geometry_vec2){1e-3, 0}, r, &c),
                         FW_OK);
        assert_int_equal(fw_geometry_flatten(*state, &c, eps, FW_FLATTEN_EQUAL_AREA, &p, &bound),
                         FW_OK);
        assert_int_equal(fw_geometry_tessellate(*state, &c, eps, &inside), FW_OK);
        double error = (double)fw_geometry_polygon_area2(&p) * 0.5 * GRID * GRID - 0.5 * r * r * w;
        double lost =
            0.5 * r * r * w - (double)fw_geometry_polygon_area2(&inside) * 0.5 * GRID * GRID;
        assert_true(fabs(error) <= bound.area_m2);
        assert_true(lost > 0.5 * eps * r * w); /* 2/3 of the sagitta times the length */
        worst = fmax(worst, fabs(error) / lost);
        assert_true(p.count <= inside.count);
        fw_arena_rewind(*state, mark);
    }
    print_message("area error %.1e of what chords inside lose\n", worst);
    assert_true(worst < 2e-3);
}

static void errors_stay_in_bounds(void **state) {
    double worst_vertex = 0, worst_edge = 0;
    for (int i = 0; i < 600; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double size = pow(10, uniform(-5.5, -3)), eps = pow(10, uniform(-8.84, -7));
        fw_geometry_contour c = random_shape(*state, size, 0);
        fw_geometry_region exact = region_of(&c);
        fw_geometry_polygon p;
        assert_int_equal(fw_geometry_tessellate(*state, &c, eps, &p), FW_OK);
        for (int k = 0; k < p.count; k++) {
            fw_geometry_vec2 a = metres(p.vertex[k]), b = metres(p.vertex[(k + 1) % p.count]);
            worst_vertex = fmax(worst_vertex, region_edge(&exact, a) / SNAP);
            for (int n = 0; n < 8; n++) {
                fw_geometry_vec2 at = vec_along(a, n / 8., vec_sub(b, a));
                worst_edge = fmax(worst_edge, region_edge(&exact, at) / (eps + SNAP));
            }
            assert_false(vec_same(a, b));
        }
        double area = (double)fw_geometry_polygon_area2(&p) * 0.5 * GRID * GRID;
        double bound = fw_geometry_contour_perimeter(&c) * (eps + SNAP);
        assert_near(area, fw_geometry_contour_area(&c), bound);
        fw_arena_rewind(*state, mark);
    }
    print_message("worst vertex error %.4f and edge error %.4f of their bounds\n", worst_vertex,
                  worst_edge);
    assert_true(worst_vertex <= 1 + 1e-9 && worst_vertex > 0.9);
    assert_true(worst_edge <= 1 + 1e-9 && worst_edge > 0.8);
}

/* every corner strictly inside an arc turns the arc's way */
static void arcs_keep_one_sign(void **state) {
    long corners = 0;
    for (int i = 0; i < 3000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double r = pow(10, uniform(-6, -3)), eps = uniform(1.42e-9, 6e-9);
        if (i % 3 == 0) eps = 1.42e-9;
        fw_geometry_vec2 m = {uniform(-5e-3, 5e-3), uniform(-5e-3, 5e-3)};
        fw_geometry_contour disc;
        fw_geometry_polygon p;
        assert_int_equal(fw_geometry_contour_disc(*state, m, r, &disc), FW_OK);
        fw_geometry_flattening kind = i % 2 ? FW_FLATTEN_EQUAL_AREA : FW_FLATTEN_INSIDE;
        assert_int_equal(fw_geometry_flatten(*state, &disc, eps, kind, &p, NULL), FW_OK);
        for (int k = 0; k < p.count; k++) {
            fw_geometry_point a = p.vertex[k], b = p.vertex[(k + 1) % p.count],
                              c = p.vertex[(k + 2) % p.count];
            int64_t turn = ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - b.y_dbu) -
                           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - b.x_dbu);
            /* where the two half circles meet, the chord is the same: the lemma holds there too */
            assert_true(turn > 0);
            corners++;
        }
        fw_arena_rewind(*state, mark);
    }
    print_message("%ld corners, none the wrong way\n", corners);
}

/* vertices 0 .. count-1 after the centre: turns of one sign, by the definition */
static bool one_sign(const fw_geometry_polygon *p, fw_geometry_point centre) {
    for (int k = 0; k < p->count; k++) {
        fw_geometry_point a = p->vertex[k], b = p->vertex[(k + 1) % p->count],
                          c = p->vertex[(k + 2) % p->count];
        bool corner = false; /* the sector's own three */
        if (b.x_dbu == centre.x_dbu && b.y_dbu == centre.y_dbu) corner = true;
        if (a.x_dbu == centre.x_dbu && a.y_dbu == centre.y_dbu) corner = true;
        if (c.x_dbu == centre.x_dbu && c.y_dbu == centre.y_dbu) corner = true;
        int64_t turn = ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - b.y_dbu) -
                       ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - b.x_dbu);
        if (!corner && turn <= 0) return false;
    }
    return true;
}

/* Between 0.36 and 1.42 nm: what is made turns one way only and is within the tolerance; what is
   refused is an arc of few chords of a sagitta below 0.354 nm, and the tolerance that is told takes
   it. Long arcs are never refused. */
static void small_tolerances_are_proven(void **state) {
    int refused = 0, made = 0;
    for (int i = 0; i < 20000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        bool whole = i % 10 == 0;
        double r = pow(10, uniform(-5.3, -3.3)), eps = uniform(0.36e-9, 1.42e-9);
        bool worst = i % 3 == 0; /* two chords that are hardly needed */
        if (worst) eps = uniform(0.36e-9, 0.5e-9);
        double h = 4 * asin(sqrt(0.5 * eps / r));
        double w = whole ? uniform(1, 3) : h * (worst ? uniform(1, 1.1) : uniform(0.5, 4.5));
        fw_geometry_vec2 m = {round(uniform(-5e6, 5e6)) * GRID, round(uniform(-5e6, 5e6)) * GRID};
        fw_geometry_point centre = {(int32_t)round(m.x / GRID), (int32_t)round(m.y / GRID)};
        fw_geometry_contour c;
        fw_geometry_polygon p;
        fw_geometry_flat_bounds b;
        assert_int_equal(fw_geometry_contour_ring_sector(*state, m, 0, r, uniform(0, 6), w, &c),
                         FW_OK);
        fw_geometry_flattening kind = i % 2 ? FW_FLATTEN_EQUAL_AREA : FW_FLATTEN_INSIDE;
        fw_status status = fw_geometry_flatten(*state, &c, eps, kind, &p, &b);
        double n = ceil(w / h), s = r * (1 - cos(0.5 * w / n));
        if (status == FW_OK) {
            made++;
            assert_true(one_sign(&p, centre));
            assert_true(b.edge_m <= (eps + SNAP) * (1 + 1e-8));
        } else {
            refused++;
            assert_int_equal(status, FW_GEOMETRY);
            assert_int_equal(c.segment[b.wavy].kind, FW_ARC);
            assert_false(whole);
            if (kind == FW_FLATTEN_INSIDE) assert_true(n >= 2 && s < 0.354e-9);
            double next = fmax(b.next_m * (1 + 1e-9), eps);
            assert_true(next < 4 * 0.354e-9 * (1 + 1e-3));
            assert_int_equal(
                fw_geometry_flatten(*state, &c, fmin(next, 1.5e-9), FW_FLATTEN_INSIDE, &p, &b),
                FW_OK);
        }
        fw_arena_rewind(*state, mark);
    }
    print_message("%d made, %d refused\n", made, refused);
    assert_true(refused > 100 && made > 10000);
}

static void chord_count_is_the_formula(void **state) {
    for (int i = 0; i < 500; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double r = pow(10, uniform(-5, -3)), eps = uniform(1.5e-9, 1e-8), w = uniform(0.5, 3);
        fw_geometry_contour c;
        fw_geometry_polygon p;
        assert_int_equal(
            fw_geometry_contour_ring_sector(*state, (fw_geometry_vec2){0, 0}, 0, r, 0.1, w, &c),
            FW_OK);
        assert_int_equal(fw_geometry_tessellate(*state, &c, eps, &p), FW_OK);
        double n = w / (2 * acos(1 - eps / r));
        if (fabs(n - round(n)) > 1e-6) assert_int_equal(p.count, (int)ceil(n) + 2);
        fw_arena_rewind(*state, mark);
    }
}

/* two pieces that share an arc run along it in opposite directions: the same vertices, for ends and
   sweeps computed in either direction too */
static void shared_arcs_have_the_same_vertices(void **state) {
    for (int i = 0; i < 2000; i++) {
        fw_mark mark = fw_arena_mark(*state);
        double r = pow(10, uniform(-5, -3)), start = uniform(-4, 4), w = uniform(0.05, 6);
        fw_geometry_vec2 m = {uniform(-3e-3, 3e-3), uniform(-3e-3, 3e-3)};
        fw_geometry_vec2 a = {m.x + r * cos(start), m.y + r * sin(start)};
        fw_geometry_vec2 b = {m.x + r * cos(start + w), m.y + r * sin(start + w)};
        fw_geometry_outline o = fw_geometry_outline_start(*state, a);
        fw_geometry_outline_arc_to(&o, m, w, b, 0);
        fw_geometry_contour inner, outer;
        fw_geometry_outline_line(&o, m, 0);
        assert_int_equal(fw_geometry_outline_close(&o, &inner), FW_OK);
        o = fw_geometry_outline_start(*state, b);
        fw_geometry_outline_arc_to(&o, m, -w, a, 0);
        fw_geometry_outline_line(&o, vec_along(m, 2 * r, vec_unit(vec_sub(a, m))), 0);
        fw_geometry_outline_line(&o, vec_along(m, 2 * r, vec_unit(vec_sub(b, m))), 0);
        assert_int_equal(fw_geometry_outline_close(&o, &outer), FW_OK);
        fw_geometry_polygon p, q;
        fw_geometry_flattening kind = i % 2 ? FW_FLATTEN_EQUAL_AREA : FW_FLATTEN_INSIDE;
        assert_int_equal(fw_geometry_flatten(*state, &inner, 5e-9, kind, &p, NULL), FW_OK);
        assert_int_equal(fw_geometry_flatten(*state, &outer, 5e-9, kind, &q, NULL), FW_OK);
        int n = p.count - 2; /* chords: p has the centre and n + 1 points of the arc */
        for (int k = 0; k <= n; k++)
            assert_memory_equal(&p.vertex[k], &q.vertex[n - k], sizeof(fw_geometry_point));
        fw_arena_rewind(*state, mark);
    }
}

static void straight_vertices_go_unless_they_end_a_joint(void **state) {
    for (int joint = 0; joint < 2; joint++) {
        fw_geometry_outline o = fw_geometry_outline_start(*state, (fw_geometry_vec2){0, 0});
        fw_geometry_outline_line(&o, (fw_geometry_vec2){1e-5, 0}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){2e-5, 0}, joint ? FW_SEGMENT_JOINT : 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){3e-5, 0}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){3e-5, 1e-5}, 0);
        fw_geometry_outline_line(&o, (fw_geometry_vec2){3e-5, 1.00002e-5}, 0); /* below the grid */
        fw_geometry_outline_line(&o, (fw_geometry_vec2){0, 1e-5}, 0);
        fw_geometry_contour c;
        fw_geometry_polygon p;
        assert_int_equal(fw_geometry_outline_close(&o, &c), FW_OK);
        assert_int_equal(fw_geometry_tessellate(*state, &c, 5e-9, &p), FW_OK);
        assert_int_equal(p.count, joint ? 6 : 4);
        assert_true(fw_geometry_polygon_area2(&p) == 2LL * 30000 * 10000);
    }
}

static void limits(void **state) {
    fw_geometry_contour c;
    fw_geometry_polygon p;
    assert_int_equal(fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1e-5, 1e-5}, &c),
                     FW_OK);
    assert_int_equal(fw_geometry_tessellate(*state, &c, 0.35e-9, &p), FW_INPUT);
    assert_int_equal(fw_geometry_tessellate(*state, &c, (double)NAN, &p), FW_INPUT);
    fw_arena_fail_at(1, 1);
    assert_int_equal(fw_geometry_tessellate(*state, &c, 5e-9, &p), FW_NOMEM);
    fw_arena_fail_at(0, 0);
    assert_int_equal(fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1.08, 1e-5}, &c),
                     FW_OK);
    assert_int_equal(fw_geometry_tessellate(*state, &c, 5e-9, &p), FW_LIMIT);
    assert_int_equal(
        fw_geometry_contour_rectangle(*state, (fw_geometry_box){0, 0, 1e-10, 1e-10}, &c), FW_OK);
    assert_int_equal(fw_geometry_tessellate(*state, &c, 5e-9, &p), FW_GEOMETRY);
    int32_t most = (1 << 30) - 1; /* the largest square: 2 A = 2^63 - 2^34 + 8 - ... fits */
    fw_geometry_point corner[] = {{-most, -most}, {most, -most}, {most, most}, {-most, most}};
    assert_true(fw_geometry_polygon_area2(&(fw_geometry_polygon){corner, 4}) ==
                2LL * (2LL * most) * (2LL * most));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        geo_test(errors_stay_in_bounds),
        geo_test(told_bounds_hold),
        geo_test(equal_area_is_equal),
        geo_test(arcs_keep_one_sign),
        geo_test(small_tolerances_are_proven),
        geo_test(chord_count_is_the_formula),
        geo_test(shared_arcs_have_the_same_vertices),
        geo_test(straight_vertices_go_unless_they_end_a_joint),
        geo_test(limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
