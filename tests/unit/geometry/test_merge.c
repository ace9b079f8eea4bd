/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Booleans of polygons on the grid: closed forms, and random sets against winding numbers of points. */
#include "geometry/merge.h"
#include "test.h"
#include <stdlib.h>

static fw_arena *arena;

static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : 1;
}

static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_geometry_polygon *box(int32_t x0, int32_t y0, int32_t x1, int32_t y1) {
    const fw_geometry_point p[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    fw_geometry_polygon *b = fw_arena_one(arena, fw_geometry_polygon);
    *b = (fw_geometry_polygon){fw_arena_array(arena, fw_geometry_point, 4), 4};
    for (int i = 0; i < 4; i++)
        b->vertex[i] = p[i];
    return b;
}

/* every polygon is simple and has no edge in common with another but cuts */
static void check_parts(const fw_geometry_merged *m) {
    for (int i = 0; i < m->n; i++) {
        fw_geometry_polygon_report report;
        assert_int_equal(fw_geometry_polygon_check(arena, &m->polygon[i], &report), FW_OK);
        assert_true(report.simple);
        assert_true(fw_geometry_polygon_area2(&m->polygon[i]) > 0);
    }
}

static const fw_geometry_merge_term first[] = {{0, FW_SET_OR}};
static const fw_geometry_merge_term without[] = {{0, FW_SET_OR}, {1, FW_SET_NOT}};

static void two_squares(void **state) {
    (void)state;
    static const struct {
        fw_geometry_set_rule rule;
        int64_t area;
        int n, holes;
    } want[] = {{FW_SET_OR, 175, 1, 0},
                {FW_SET_AND, 25, 1, 0},
                {FW_SET_NOT, 75, 1, 0},
                {FW_SET_XOR, 150, 2, 0}};
    const fw_geometry_merge_input in[] = {{box(0, 0, 10, 10), 0}, {box(5, 5, 15, 15), 1}};
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
        const fw_geometry_merge_term term[] = {{0, FW_SET_OR}, {1, want[i].rule}};
        fw_geometry_merged m;
        assert_int_equal(fw_geometry_merge(arena, in, 2, term, 2, 4094, &m), FW_OK);
        assert_true(m.area2_dbu == 2 * want[i].area);
        assert_int_equal(m.n, want[i].n);
        assert_int_equal(m.rounded, 0);
        check_parts(&m);
    }
}

static bool has_edge(const fw_geometry_polygon *p, fw_geometry_point a, fw_geometry_point b) {
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point u = p->vertex[i], v = p->vertex[(i + 1) % p->count];
        if (u.x_dbu == a.x_dbu && u.y_dbu == a.y_dbu && v.x_dbu == b.x_dbu && v.y_dbu == b.y_dbu)
            return true;
    }
    return false;
}

static double from_edge(fw_geometry_point a, fw_geometry_point b, fw_geometry_point p) {
    double dx = b.x_dbu - a.x_dbu, dy = b.y_dbu - a.y_dbu, l2 = dx * dx + dy * dy;
    double t = ((p.x_dbu - a.x_dbu) * dx + (p.y_dbu - a.y_dbu) * dy) / l2;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(p.x_dbu - a.x_dbu - t * dx, p.y_dbu - a.y_dbu - t * dy);
}

/* by every vertex of every polygon against every edge that two of them share */
static double clear_by_hand(const fw_geometry_merged *m) {
    double least = HUGE_VAL;
    for (int i = 0; i < m->n; i++)
        for (int k = 0; k < m->polygon[i].count; k++) {
            fw_geometry_point a = m->polygon[i].vertex[k],
                              b = m->polygon[i].vertex[(k + 1) % m->polygon[i].count];
            bool cut = false;
            for (int j = 0; j < m->n; j++)
                cut = cut || has_edge(&m->polygon[j], b, a);
            for (int j = 0; cut && j < m->n; j++)
                for (int v = 0; v < m->polygon[j].count; v++) {
                    fw_geometry_point p = m->polygon[j].vertex[v];
                    bool end = (p.x_dbu == a.x_dbu && p.y_dbu == a.y_dbu) ||
                               (p.x_dbu == b.x_dbu && p.y_dbu == b.y_dbu);
                    if (!end) least = fmin(least, from_edge(a, b, p));
                }
        }
    return least * 1e-9;
}

/* cuts and what is nearest to them: of a square with random holes, and of one without */
static void clearance_of_cuts(void **state) {
    (void)state;
    fw_geometry_merged m;
    const fw_geometry_merge_input alone = {box(0, 0, 10, 10), 0};
    assert_int_equal(fw_geometry_merge(arena, &alone, 1, first, 1, 4094, &m), FW_OK);
    assert_true(isinf(m.clear_m));
    srand(21);
    for (int round = 0; round < 40; round++) {
        fw_geometry_merge_input in[10] = {{box(0, 0, 1000, 1000), 0}};
        for (int i = 1; i < 10; i++) {
            int32_t x = 20 + 100 * i - rand() % 60, y = 20 + rand() % 800;
            in[i] =
                (fw_geometry_merge_input){box(x, y, x + 3 + rand() % 30, y + 3 + rand() % 150), 1};
        }
        assert_int_equal(fw_geometry_merge(arena, in, 10, without, 2, 4094, &m), FW_OK);
        check_parts(&m);
        assert_true(m.cuts > 0);
        assert_near(m.clear_m, clear_by_hand(&m), 1e-15);
    }
}

/* a frame of two halves that share two cuts, letters out of it: the joints vanish, each hole costs two
   cuts */
static void a_frame(void **state) {
    (void)state;
    const fw_geometry_point left[] = {{0, 0},   {50, 0},  {50, 10},  {10, 10},
                                      {10, 90}, {50, 90}, {50, 100}, {0, 100}};
    const fw_geometry_point right[] = {{50, 0},  {100, 0}, {100, 100}, {50, 100},
                                       {50, 90}, {90, 90}, {90, 10},   {50, 10}};
    fw_geometry_polygon half[] = {{(fw_geometry_point *)left, 8}, {(fw_geometry_point *)right, 8}};
    const fw_geometry_merge_input in[] = {
        {&half[0], 0}, {&half[1], 0}, {box(2, 40, 6, 60), 1}, {box(94, 94, 97, 97), 1}};
    fw_geometry_merged m;
    assert_int_equal(fw_geometry_merge(arena, in, 2, first, 1, 4094, &m), FW_OK);
    assert_true(m.area2_dbu == 2 * 3600);
    assert_int_equal(m.outlines, 1);
    assert_int_equal(m.holes, 1);
    assert_int_equal(m.n, 2);
    assert_int_equal(m.cuts, 2);
    assert_int_equal(m.vertices, 4 + 4 + 4);
    check_parts(&m);
    assert_int_equal(fw_geometry_merge(arena, in, 4, without, 2, 4094, &m), FW_OK);
    assert_true(m.area2_dbu == 2 * (3600 - 80 - 9));
    assert_int_equal(m.holes, 3);
    assert_true(m.cuts == m.n + 3 - 1); /* a plane graph: parts + holes - outlines */
    check_parts(&m);
}

/* parts of a plate with many holes; each costs two cuts at most, and more holes than parts stay */
static void a_sieve(void **state) {
    (void)state;
    enum { N = 12 };
    fw_geometry_merge_input in[N * N + 1];
    in[0] = (fw_geometry_merge_input){box(0, 0, 100 * N, 100 * N), 0};
    for (int i = 0; i < N * N; i++) {
        int32_t x = 100 * (i % N) + 30, y = 100 * (i / N) + 30;
        fw_geometry_polygon *p = box(x, y, x + 40, y + 40);
        p->vertex[0].x_dbu += 3; /* no two of its edges are parallel */
        p->vertex[1].y_dbu -= 5;
        in[i + 1] = (fw_geometry_merge_input){p, 1};
    }
    fw_geometry_merged m;
    assert_int_equal(fw_geometry_merge(arena, in, N * N + 1, without, 2, 4094, &m), FW_OK);
    assert_int_equal(m.holes, N * N);
    assert_true(m.cuts == m.n + m.holes - m.outlines);
    assert_true(m.n < N * N / 2);
    check_parts(&m);
    assert_int_equal(fw_geometry_merge(arena, in, N * N + 1, without, 2, 60, &m), FW_OK);
    int more = m.n;
    assert_int_equal(fw_geometry_merge(arena, in, N * N + 1, without, 2, 4094, &m), FW_OK);
    assert_true(more > m.n);
    check_parts(&m);
}

/* ---- random sets ---- */

static unsigned seed;

static int roll(int n) {
    seed = seed * 1664525u + 1013904223u;
    return (int)((seed >> 8) % (unsigned)n);
}

static fw_geometry_polygon *star(int32_t size) {
    int n = 3 + roll(9);
    fw_geometry_polygon *p = fw_arena_one(arena, fw_geometry_polygon);
    *p = (fw_geometry_polygon){fw_arena_array(arena, fw_geometry_point, (size_t)n), n};
    double x = roll(size), y = roll(size), start = roll(1000) * 1e-3;
    for (int i = 0; i < n; i++) {
        double r = (0.2 + 0.8e-3 * roll(1000)) * size / 3, a = start + 6.283185307 * i / n;
        p->vertex[i] =
            (fw_geometry_point){(int32_t)lround(x + r * cos(a)), (int32_t)lround(y + r * sin(a))};
    }
    return p;
}

/* is (x, y) in it? *near: an edge is nearer than 2 */
static bool holds(const fw_geometry_polygon *p, double x, double y, bool *near) {
    bool in = false;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point a = p->vertex[i], b = p->vertex[(i + 1) % p->count];
        double dx = b.x_dbu - a.x_dbu, dy = b.y_dbu - a.y_dbu, l2 = dx * dx + dy * dy;
        double t = l2 > 0 ? ((x - a.x_dbu) * dx + (y - a.y_dbu) * dy) / l2 : 0;
        t = fmin(1, fmax(0, t));
        *near = *near || hypot(a.x_dbu + t * dx - x, a.y_dbu + t * dy - y) < 2;
        if ((a.y_dbu > y) != (b.y_dbu > y) && x < a.x_dbu + (y - a.y_dbu) * dx / dy) in = !in;
    }
    return in;
}

enum { POLYGONS = 24 };

static bool wanted(const fw_geometry_merge_input *in, const fw_geometry_merge_term *term, int nterm,
                   double x, double y, bool *near) {
    bool there[3] = {false, false, false}, result = false;
    for (int i = 0; i < POLYGONS; i++)
        if (holds(in[i].polygon, x, y, near)) there[in[i].set] = true;
    for (int i = 0; i < nterm; i++) {
        bool t = there[term[i].set];
        result = term[i].rule == FW_SET_OR    ? result || t
                 : term[i].rule == FW_SET_AND ? result && t
                 : term[i].rule == FW_SET_NOT ? result && !t
                                              : result != t;
    }
    return result;
}

/* small sizes: many edges share points and cross beside the grid */
static void random_sets(void **state) {
    (void)state;
    static const int32_t sizes[] = {12, 60, 1000, 40000, 200000000};
    int crossed = 0;
    for (unsigned round = 0; round < 200; round++) {
        fw_mark mark = fw_arena_mark(arena);
        int32_t size = sizes[round % 5];
        fw_geometry_merge_input in[POLYGONS];
        fw_geometry_merge_term term[4];
        seed = 77 + round;
        for (int i = 0; i < POLYGONS; i++)
            in[i] = (fw_geometry_merge_input){star(size), roll(3)};
        for (int i = 0; i < 4; i++)
            term[i] =
                (fw_geometry_merge_term){roll(3), i ? (fw_geometry_set_rule)roll(4) : FW_SET_OR};
        fw_geometry_merged m;
        fw_status status = fw_geometry_merge(arena, in, POLYGONS, term, 4, 50, &m);
        if (status) fail_msg("round %u, size %d: %s", round, (int)size, fw_status_text(status));
        crossed += m.rounded;
        if (size > 100) check_parts(&m);
        /* as it is bounded: as many lines, which enclose the same area by their depths */
        fw_geometry_polygon *loop;
        int *depth, n;
        int64_t area2 = 0;
        assert_int_equal(fw_geometry_merge_loops(arena, in, POLYGONS, term, 4, &loop, &depth, &n),
                         FW_OK);
        assert_int_equal(n, m.outlines + m.holes);
        for (int i = 0; i < n; i++) {
            assert_true(fw_geometry_polygon_area2(&loop[i]) > 0);
            area2 += (depth[i] % 2 ? -1 : 1) * fw_geometry_polygon_area2(&loop[i]);
        }
        assert_true(area2 == m.area2_dbu);
        for (int k = 0; k < 300; k++) {
            double x = roll(size) + 0.5, y = roll(size) + 0.5;
            bool near = false, want = wanted(in, term, 4, x, y, &near);
            int got = 0;
            if (near) continue;
            for (int i = 0; i < m.n; i++)
                got += holds(&m.polygon[i], x, y, &near);
            if (got != want) fail_msg("round %u: %d at %g, %g, not %d", round, got, x, y, want);
        }
        fw_arena_rewind(arena, mark);
    }
    assert_true(crossed > 1000);
}

static void nothing_and_too_much(void **state) {
    (void)state;
    fw_geometry_merged m;
    const fw_geometry_merge_input far = {box(0, 0, 1 << 28, 5), 0}, odd = {box(0, 0, 5, 5), 16};
    assert_int_equal(fw_geometry_merge(arena, NULL, 0, first, 1, 4094, &m), FW_OK);
    assert_int_equal(m.n, 0);
    assert_int_equal(fw_geometry_merge(arena, &far, 1, first, 1, 4094, &m), FW_LIMIT);
    assert_int_equal(fw_geometry_merge(arena, &odd, 1, first, 1, 4094, &m), FW_LIMIT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(clearance_of_cuts, setup, teardown),
        cmocka_unit_test_setup_teardown(two_squares, setup, teardown),
        cmocka_unit_test_setup_teardown(a_frame, setup, teardown),
        cmocka_unit_test_setup_teardown(a_sieve, setup, teardown),
        cmocka_unit_test_setup_teardown(random_sets, setup, teardown),
        cmocka_unit_test_setup_teardown(nothing_and_too_much, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
