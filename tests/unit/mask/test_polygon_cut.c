/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask_parts.h"
#include "scene.h"
#include <stdlib.h>

typedef struct edge {
    fw_geometry_point a, b;
} edge;

static int by_ends(const void *left, const void *right) {
    return memcmp(left, right, sizeof(edge));
}

/* Parts within the limit, simple, counter-clockwise; areas add up exactly; every edge of the
   polygon is an edge of one part, and every other edge of a part is there once in either direction:
   so the parts cover the polygon without gap or overlap. */
static void assert_partition(fw_arena *arena, const fw_geometry_polygon *p, int most,
                             const fw_geometry_polygon *part, int npart) {
    int64_t area = 0;
    int total = 0, n = 0;
    for (int k = 0; k < npart; k++)
        total += part[k].count;
    edge *list = fw_arena_array(arena, edge, (size_t)(total + p->count));
    for (int k = 0; k < npart; k++) {
        fw_geometry_polygon_report report;
        assert_true(part[k].count >= 3 && part[k].count <= most);
        assert_int_equal(fw_geometry_polygon_check(arena, &part[k], &report), FW_OK);
        assert_true(report.simple);
        assert_true(fw_geometry_polygon_area2(&part[k]) > 0);
        area += fw_geometry_polygon_area2(&part[k]);
        for (int i = 0; i < part[k].count; i++)
            list[n++] = (edge){part[k].vertex[i], part[k].vertex[(i + 1) % part[k].count]};
    }
    assert_true(area == fw_geometry_polygon_area2(p));
    for (int i = 0; i < p->count; i++) /* the outline backwards: then all edges go both ways */
        list[n++] = (edge){p->vertex[(i + 1) % p->count], p->vertex[i]};
    qsort(list, (size_t)n, sizeof *list, by_ends);
    for (int i = 0; i < n; i++) {
        edge back = {list[i].b, list[i].a};
        assert_non_null(bsearch(&back, list, (size_t)n, sizeof *list, by_ends));
        assert_true(i == 0 || by_ends(&list[i], &list[i - 1]) != 0);
    }
    assert_int_equal(total, p->count + 2 * (npart - 1));
}

/* least distance of a vertex from an edge that is not its own, nm */
static double clearance_dbu(const fw_geometry_polygon *p) {
    double least = HUGE_VAL;
    for (int i = 0; i < p->count; i++)
        for (int j = 0; j < p->count; j++) {
            fw_geometry_point v = p->vertex[i], a = p->vertex[j], b = p->vertex[(j + 1) % p->count];
            if (j == i || (j + 1) % p->count == i) continue;
            double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
            double u = (double)v.x_dbu - a.x_dbu, w = (double)v.y_dbu - a.y_dbu;
            double t = fmin(1, fmax(0, (x * u + y * w) / (x * x + y * y)));
            double dx = u - t * x, dy = w - t * y;
            least = fmin(least, dx * dx + dy * dy);
        }
    return sqrt(least);
}

/* the parts cover the polygon, and what is said of the cuts is what all pairs of vertices and edges
   say. Returns it. */
static double cut_and_check(fw_arena *arena, const fw_geometry_polygon *p, int most,
                            int npart_most) {
    fw_geometry_polygon *part;
    int npart;
    double said, least = HUGE_VAL;
    assert_int_equal(fw_mask_polygon_cut(arena, p, most, &part, &npart, &said), FW_OK);
    assert_partition(arena, p, most, part, npart);
    if (npart > npart_most) fail_msg("%d parts of %d vertices", npart, p->count);
    for (int k = 0; k < npart; k++)
        least = fmin(least, clearance_dbu(&part[k]));
    if (p->count > 3000) return least; /* all pairs of the whole: too long */
    assert_true(least > fmin(said, clearance_dbu(p)) - 1e-6);
    return least;
}

static double shortest_dbu(const fw_geometry_polygon *p) {
    double least = HUGE_VAL;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point a = p->vertex[i], b = p->vertex[(i + 1) % p->count];
        least = fmin(least, hypot((double)b.x_dbu - a.x_dbu, (double)b.y_dbu - a.y_dbu));
    }
    return least;
}

/* ---- the plain search ----
   What fw_mask_polygon_cut searches cleverly, as its comment says it: all pairs of vertices in order, each against all
   vertices and edges. Of polygons without more vertices than it looks at (1024). */

static int64_t plain_cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

static fw_geometry_point plain_at(const fw_geometry_polygon *p, int i) {
    return p->vertex[(i + p->count) % p->count];
}

static double plain_length2(fw_geometry_point a, fw_geometry_point b) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    return x * x + y * y;
}

static double plain_distance(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    double u = (double)c.x_dbu - a.x_dbu, w = (double)c.y_dbu - a.y_dbu;
    double t = fmin(1, fmax(0, (x * u + y * w) / (x * x + y * y)));
    double dx = u - t * x, dy = w - t * y;
    return sqrt(dx * dx + dy * dy);
}

/* c on the segment from a to b, if it is on its line */
static bool plain_between(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)c.x_dbu - a.x_dbu) * ((int64_t)c.x_dbu - b.x_dbu) <= 0 &&
           ((int64_t)c.y_dbu - a.y_dbu) * ((int64_t)c.y_dbu - b.y_dbu) <= 0;
}

static bool plain_meet(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c,
                       fw_geometry_point d) {
    int64_t abc = plain_cross(a, b, c), abd = plain_cross(a, b, d), cda = plain_cross(c, d, a),
            cdb = plain_cross(c, d, b);
    if (abc && abd && cda && cdb) return (abc > 0) != (abd > 0) && (cda > 0) != (cdb > 0);
    return (abc == 0 && plain_between(a, b, c)) || (abd == 0 && plain_between(a, b, d)) ||
           (cda == 0 && plain_between(c, d, a)) || (cdb == 0 && plain_between(c, d, b));
}

static bool plain_enters(const fw_geometry_polygon *p, int i, fw_geometry_point q) {
    fw_geometry_point v = plain_at(p, i), before = plain_at(p, i - 1), after = plain_at(p, i + 1);
    bool out = plain_cross(v, after, q) > 0, in = plain_cross(before, v, q) > 0;
    return plain_cross(before, v, after) > 0 ? out && in : out || in;
}

static bool plain_along(const fw_geometry_polygon *p, int i, fw_geometry_point q) {
    for (int side = -1; side <= 1; side += 2) {
        fw_geometry_point v = plain_at(p, i), w = plain_at(p, i + side);
        int64_t x = ((int64_t)w.x_dbu - v.x_dbu) * ((int64_t)q.x_dbu - v.x_dbu);
        int64_t y = ((int64_t)w.y_dbu - v.y_dbu) * ((int64_t)q.y_dbu - v.y_dbu);
        if (plain_cross(v, w, q) == 0 && x >= 0 && y >= 0) return true;
    }
    return false;
}

/* -1: not strictly inside */
static double plain_clear(const fw_geometry_polygon *p, int i, int j, double most) {
    fw_geometry_point a = p->vertex[i], b = p->vertex[j];
    double clear = most;
    if (!plain_enters(p, i, b) || !plain_enters(p, j, a)) return -1;
    if (plain_along(p, i, b) || plain_along(p, j, a)) return -1;
    for (int k = 0; k < p->count; k++) {
        int next = (k + 1) % p->count;
        bool own = k == i || k == j;
        if (!own) clear = fmin(clear, plain_distance(a, b, p->vertex[k]));
        if (!own && next != i && next != j && plain_meet(a, b, p->vertex[k], p->vertex[next]))
            return -1;
    }
    return clear;
}

typedef struct plain_found {
    int i, j;
    double length2, clear;
} plain_found;

static plain_found plain_round(const fw_geometry_polygon *p, double wanted, int least, int peel) {
    plain_found best = {-1, -1, HUGE_VAL, -1};
    int n = p->count;
    for (int i = 0; i < n; i++)
        for (int j = i + least; j < n && j <= i + n - least; j++) {
            double l2 = plain_length2(p->vertex[i], p->vertex[j]);
            double more = wanted > 0 ? wanted * (1 - 1e-12) : best.clear;
            if (peel && j - i > peel && n - j + i > peel) continue;
            if (wanted > 0 && !(l2 < best.length2)) continue;
            double clear = plain_clear(p, i, j, wanted > 0 ? wanted : HUGE_VAL);
            if (clear > more) best = (plain_found){i, j, l2, clear};
        }
    return best;
}

static plain_found plain_find(const fw_geometry_polygon *p, double wanted, int most, int share,
                              bool peels) {
    static const int part[] = {1, 2, 4, 8, 2, 8, 1};
    plain_found best = {-1, -1, 0, 0};
    for (int k = 0; k < 7 && best.i < 0; k++) {
        bool peel = peels && k < 6 && p->count / 64 < most;
        int of = peel && 2 * most < p->count ? 2 * most : p->count, least = of / (part[k] * share);
        best = plain_round(p, k < 4 ? wanted : 0, least > 2 ? least : 2, peel ? most - 1 : 0);
    }
    return best;
}

/* into parts of `list`; the least distance of a cut */
static double plain_cut(fw_arena *arena, const fw_geometry_polygon *p, int most, double wanted,
                        double above, int share, bool peels, fw_geometry_polygon *list, int *n) {
    double clear = HUGE_VAL;
    list[0] = *p;
    *n = 1;
    for (int k = 0; k < *n && clear > above;) {
        fw_geometry_polygon whole = list[k];
        if (whole.count <= most) {
            k++;
            continue;
        }
        plain_found f = plain_find(&whole, fmin(wanted, clear), most, share, peels);
        assert_true(f.i >= 0);
        clear = fmin(clear, f.clear);
        memmove(&list[k + 2], &list[k + 1], (size_t)(*n - k - 1) * sizeof *list);
        for (int side = 0; side < 2; side++) {
            int from = side ? f.j : f.i, to = side ? f.i + whole.count : f.j;
            list[k + side].count = to - from + 1;
            list[k + side].vertex =
                fw_arena_array(arena, fw_geometry_point, (size_t)(to - from + 1));
            for (int m = from; m <= to; m++)
                list[k + side].vertex[m - from] = plain_at(&whole, m);
        }
        (*n)++;
    }
    return clear;
}

/* the parts are those of the plain search, vertex by vertex */
static void assert_plain(fw_arena *arena, const fw_geometry_polygon *p, int most) {
    static const struct {
        int share;
        bool peels;
    } manner[] = {{4, true}, {4, false}, {3, false}, {8, false}};
    fw_geometry_polygon *part, *now = fw_arena_array(arena, fw_geometry_polygon, (size_t)p->count),
                               *best = fw_arena_array(arena, fw_geometry_polygon, (size_t)p->count);
    double clear, least = -1, wanted = fmax(50, FW_CUT_SHARE * shortest_dbu(p));
    int npart, n = 0, nbest = 0;
    for (int k = 0; k < 4; k++) {
        double above = k == 0 ? -HUGE_VAL : 1.1 * least;
        double found = plain_cut(arena, p, most, wanted, above, manner[k].share, manner[k].peels, now, &n);
        if (found > above) {
            least = found;
            nbest = n;
            memcpy(best, now, (size_t)n * sizeof *now);
        }
        if (least >= wanted || least < wanted / 8) break;
    }
    assert_int_equal(fw_mask_polygon_cut(arena, p, most, &part, &npart, &clear), FW_OK);
    assert_int_equal(npart, nbest);
    assert_near(clear, least, 1e-9 * fabs(least));
    for (int k = 0; k < npart; k++) {
        assert_int_equal(part[k].count, best[k].count);
        assert_memory_equal(part[k].vertex, best[k].vertex, (size_t)part[k].count * sizeof *part[k].vertex);
    }
}

static fw_geometry_polygon flat(fw_arena *arena, const fw_geometry_contour *c, double tolerance_m) {
    fw_geometry_polygon p;
    assert_int_equal(fw_geometry_tessellate(arena, c, tolerance_m, &p), FW_OK);
    return p;
}

static void small_ones_stay(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_point v[4] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    fw_geometry_polygon p = {v, 4}, *part;
    int npart;
    assert_int_equal(fw_mask_polygon_cut(arena, &p, 8, &part, &npart, NULL), FW_OK);
    assert_int_equal(npart, 1);
    assert_ptr_equal(part->vertex, v);
    fw_arena_free(arena);
}

static void discs_and_rings(void **state) {
    (void)state;
    static const int limit[3] = {199, 4094, 8190};
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_contour c;
    for (int k = 0; k < 3; k += test_cases(1, 2)) {
        assert_int_equal(fw_geometry_contour_disc(arena, (fw_geometry_vec2){1e-3, 0}, 20e-3, &c),
                         FW_OK);
        fw_geometry_polygon p = flat(arena, &c, 2e-9);
        assert_true(p.count > 6900);
        cut_and_check(arena, &p, limit[k], 4 * p.count / limit[k] + 1);
        assert_int_equal(fw_geometry_contour_ring_sector(arena, (fw_geometry_vec2){0, 0}, 195e-6,
                                                         205e-6, 1, 6, &c),
                         FW_OK);
        p = flat(arena, &c, 1.5e-9);
        cut_and_check(arena, &p, limit[k], 4 * p.count / limit[k] + 1);
    }
    fw_arena_free(arena);
}

/* a cut goes through the neck of a narrow ring, across it and not along it */
static void necks_are_preferred(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_contour c;
    assert_int_equal(
        fw_geometry_contour_ring_sector(arena, (fw_geometry_vec2){0, 0}, 195e-6, 205e-6, 0, 6, &c),
        FW_OK);
    fw_geometry_polygon p = flat(arena, &c, 1.5e-9), *part;
    int npart;
    assert_int_equal(fw_mask_polygon_cut(arena, &p, p.count - 1, &part, &npart, NULL), FW_OK);
    assert_int_equal(npart, 2);
    fw_geometry_point a = part[0].vertex[0], b = part[0].vertex[part[0].count - 1];
    assert_near(hypot(a.x_dbu - b.x_dbu, a.y_dbu - b.y_dbu), 10000, 60);
    fw_arena_free(arena);
}

/* star-shaped and spiral outlines with random radii: hollow corners everywhere, few clean cuts */
static void random_outlines(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int run = 0; run < test_cases(60, 20); run++) {
        fw_arena *arena = fw_arena_new(0);
        int n = 20 + (int)(700 * random01(&seed)), size = run % 3 ? 100000 : 3000;
        fw_geometry_point *v = fw_arena_array(arena, fw_geometry_point, (size_t)n);
        for (int i = 0; i < n; i++) {
            double r = size * (0.1 + random01(&seed)), angle = 2 * PI * i / n;
            v[i] = (fw_geometry_point){(int32_t)lround(r * cos(angle)),
                                       (int32_t)lround(r * sin(angle))};
        }
        fw_geometry_polygon p = {v, n};
        fw_geometry_polygon_report report;
        assert_int_equal(fw_geometry_polygon_check(arena, &p, &report), FW_OK);
        if (report.simple) cut_and_check(arena, &p, 8 + (int)(60 * random01(&seed)), n);
        fw_arena_free(arena);
    }
}

/* stars, combs with teeth of any length, and rows of bays as dense holes leave them */
static void as_the_plain_search(void **state) {
    (void)state;
    uint64_t seed = 71;
    for (int run = 0; run < test_cases(30, 6); run++) {
        fw_arena *arena = fw_arena_new(0);
        int n = 0, teeth = 6 + (int)(20 * random01(&seed)), kind = run % 3;
        int size = run % 2 ? 40000 : 900;
        fw_geometry_point v[400];
        if (kind == 0)
            for (int i = 0; i < 4 * teeth; i++) {
                double r = size * (0.3 + random01(&seed)), angle = 2 * PI * i / (4 * teeth);
                v[n++] = (fw_geometry_point){(int32_t)lround(r * cos(angle)),
                                             (int32_t)lround(r * sin(angle))};
            }
        for (int side = 0; side < 2 && kind > 0; side++) /* below to the right, above to the left */
            for (int i = 0; i < teeth; i++) {
                int32_t x = size * i / 2, deep = (int32_t)(size * (kind == 1 ? random01(&seed) : 0.3)),
                        y = side ? 3 * size : 0, sign = side ? -1 : 1;
                const int32_t at[6][2] = {{x, y}, {x + size / 6, y}, {x + size / 6, y + sign * deep / 2},
                                          {x + size / 4, y + sign * deep}, {x + size / 3, y + sign * deep / 2},
                                          {x + size / 3, y}};
                for (int k = 0; k < 6; k++)
                    v[n++] = (fw_geometry_point){side ? size * teeth / 2 - at[k][0] : at[k][0], at[k][1]};
            }
        fw_geometry_polygon p = {v, n};
        fw_geometry_polygon_report report;
        assert_int_equal(fw_geometry_polygon_check(arena, &p, &report), FW_OK);
        if (report.simple && fw_geometry_polygon_area2(&p) > 0)
            assert_plain(arena, &p, 8 + (int)(0.4 * n * random01(&seed)));
        fw_arena_free(arena);
    }
}

/* a staircase and a comb on the grid: cuts must not run over vertices or along edges */
static void combs(void **state) {
    (void)state;
    enum { TEETH = 120 };
    fw_arena *arena = fw_arena_new(0);
    fw_geometry_point v[4 * TEETH];
    int n = 0;
    for (int i = 0; i < TEETH; i++) { /* teeth down, from left to right */
        v[n++] = (fw_geometry_point){20 * i, 0};
        v[n++] = (fw_geometry_point){20 * i + 10, 0};
        v[n++] = (fw_geometry_point){20 * i + 10, 500};
        v[n++] = (fw_geometry_point){20 * i + 20, 500};
    }
    v[n - 2] = (fw_geometry_point){20 * TEETH - 10, 600};
    v[n - 1] = (fw_geometry_point){0, 600};
    fw_geometry_polygon p = {v, n};
    for (int most = 8; most < 200; most += 37 * test_cases(1, 2))
        cut_and_check(arena, &p, most, n);
    fw_arena_free(arena);
}

/* Rounded fingers on a stage, as a comb drive has them, turned by any angle: the shortest cuts run
   along their roots, where vertices lie on one line but for the roundings of a few micrometres, and
   a cut that takes any one of them leaves parts that have none. */
static void fingers_leave_no_slivers(void **state) {
    (void)state;
    uint64_t seed = 11;
    for (int run = 0; run < 5; run++) {
        fw_arena *arena = fw_arena_new(0);
        int fingers = 6 + (int)(7 * random01(&seed));
        double pitch = (33 + 4 * random01(&seed)) * UM, wide = 11.48 * UM;
        double height = (fingers + 2) * pitch, turn = run % 2 ? 2 * PI * random01(&seed) : 0;
        double tolerance_m = (run % 2 ? 1.42 : 3) * 1e-9;
        fw_geometry_vec2 corner[4 * 16 + 4];
        int n = 0;
        corner[n++] = (fw_geometry_vec2){0, 0};
        corner[n++] = (fw_geometry_vec2){200 * UM, 0};
        for (int k = 0; k < fingers; k++)
            for (int i = 0; i < 4; i++)
                corner[n++] = (fw_geometry_vec2){(i == 1 || i == 2 ? 296 : 200) * UM,
                                                 (k + 1) * pitch + (i > 1 ? wide : 0)};
        corner[n++] = (fw_geometry_vec2){200 * UM, height};
        corner[n++] = (fw_geometry_vec2){0, height};
        fw_geometry_outline o = {0};
        for (int i = 0; i < n; i++) {
            fw_geometry_vec2 at = {corner[i].x * cos(turn) - corner[i].y * sin(turn),
                                   corner[i].x * sin(turn) + corner[i].y * cos(turn)};
            if (i == 0)
                o = fw_geometry_outline_start(arena, at);
            else
                fw_geometry_outline_line(&o, at, 0);
        }
        fw_geometry_contour sharp, c;
        assert_int_equal(fw_geometry_outline_close(&o, &sharp), FW_OK);
        assert_int_equal(fw_geometry_contour_round(arena, &sharp, 3.1 * UM, 6.9 * UM, &c, NULL),
                         FW_OK);
        fw_geometry_polygon p = flat(arena, &c, tolerance_m);
        double least = cut_and_check(arena, &p, 199, 2 * p.count / 199 + 4);
        if (least < FW_CUT_SHARE * shortest_dbu(&p) * (1 - 1e-9))
            fail_msg("run %d, %d fingers: %g nm where %g are the shortest edge", run, fingers,
                     least, shortest_dbu(&p));
        fw_arena_free(arena);
    }
}

/* Polygons of random corners around a point, all rounded, as plates and links are: every part keeps
   0.9 of the shortest edge to every vertex, though most cuts end on arcs. */
static void rounded_plates(void **state) {
    (void)state;
    uint64_t seed = 23;
    int cut = 0;
    for (int run = 0; run < 24; run++) {
        fw_arena *arena = fw_arena_new(0);
        int n = 5 + (int)(12 * random01(&seed));
        fw_geometry_outline o = {0};
        for (int i = 0; i < n; i++) {
            double r = (i % 2 ? 150 : 60) * (1 + 2 * random01(&seed)) * UM;
            double angle = 2 * PI * (i + 0.4 * random01(&seed)) / n;
            fw_geometry_vec2 at = {r * cos(angle), r * sin(angle)};
            if (i == 0)
                o = fw_geometry_outline_start(arena, at);
            else
                fw_geometry_outline_line(&o, at, 0);
        }
        fw_geometry_contour sharp, c;
        assert_int_equal(fw_geometry_outline_close(&o, &sharp), FW_OK);
        double radius_m = (3 + 9 * random01(&seed)) * UM;
        if (fw_geometry_contour_round(arena, &sharp, radius_m, radius_m, &c, NULL) == FW_OK) {
            fw_geometry_polygon p = flat(arena, &c, 1.42e-9);
            int most = p.count > 120 ? 60 + (int)(60 * random01(&seed)) : p.count;
            double least = cut_and_check(arena, &p, most, 3 * p.count / most + 4);
            double wanted = fmin(FW_CUT_SHARE * shortest_dbu(&p), clearance_dbu(&p));
            if (least < wanted * (1 - 1e-9))
                fail_msg("run %d: %g nm of %g, %d vertices in parts of %d", run, least, wanted,
                         p.count, most);
            cut += p.count > most;
        }
        fw_arena_free(arena);
    }
    assert_true(cut > 16);
}

/* through the whole room: the file has the same area, in parts within the limit */
static void limits_of_a_mask(void **state) {
    (void)state;
    double area[2];
    for (int k = 0; k < 2; k++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_arch(s, 500, 8, 20);
        s->options.tolerance_m = 2e-9;
        s->options.vertex_limit = k ? 199 : 8190;
        const fw_mask *mask = NULL;
        assert_int_equal(scene_build(s, &mask), FW_OK);
        area[k] = 0;
        for (int i = 0; i < mask->nshape; i++) {
            const fw_mask_shape *shape = &mask->shape[i];
            assert_int_equal(shape->npart > 1, k == 1 && shape->polygon.count > 199);
            for (int j = 0; j < shape->npart; j++) {
                assert_true(shape->part[j].count <= mask->vertex_limit);
                area[k] += (double)fw_geometry_polygon_area2(&shape->part[j]);
            }
        }
        scene_free(s);
    }
    assert_true(area[0] == area[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_ones_stay),
        cmocka_unit_test(discs_and_rings),
        cmocka_unit_test(necks_are_preferred),
        cmocka_unit_test(random_outlines),
        cmocka_unit_test(as_the_plain_search),
        cmocka_unit_test(combs),
        cmocka_unit_test(fingers_leave_no_slivers),
        cmocka_unit_test(rounded_plates),
        cmocka_unit_test(limits_of_a_mask),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
