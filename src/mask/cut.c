/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/cut.h"
#include <math.h>
#include <string.h>

/* Cuts of good quality keep 30 degrees to the edges at their ends and 50 nm to all other vertices,
   so that no part has a sliver; where there is none, not even with less of the polygon on one side,
   at least the 50 nm; and any cut inside the polygon will do before none does. */
static const double SINE_30 = 0.5, CLEAR_DBU = 50;
enum { SAMPLES = 1024 };

typedef struct search {
    const fw_polygon *p;
    bool wide, clear; /* the two qualities asked for */
    int share;        /* of the vertices that lie on either side at least: a fourth, an eighth .. */
    int i, j;         /* best so far; -1: none */
    double least2;
} search;

static fw_point at(const fw_polygon *p, int i) {
    return p->vertex[i < 0 ? i + p->count : i < p->count ? i : i - p->count];
}

/* twice the area of a triangle: exact, |coordinate| < 2^30 */
static int64_t cross(fw_point a, fw_point b, fw_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

static double length2(fw_point a, fw_point b) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    return x * x + y * y;
}

/* does the line from vertex i to q leave into the polygon? */
static bool enters(const fw_polygon *p, int i, fw_point q) {
    fw_point v = at(p, i), before = at(p, i - 1), after = at(p, i + 1);
    bool left_of_out = cross(v, after, q) > 0, left_of_in = cross(before, v, q) > 0;
    return cross(before, v, after) > 0 ? left_of_out && left_of_in : left_of_out || left_of_in;
}

/* 30 degrees or more between v -> a and v -> q */
static bool wide(fw_point v, fw_point a, fw_point q) {
    double x = (double)a.x_dbu - v.x_dbu, y = (double)a.y_dbu - v.y_dbu;
    double u = (double)q.x_dbu - v.x_dbu, w = (double)q.y_dbu - v.y_dbu;
    double turn = x * w - y * u;
    return x * u + y * w <= 0 ||
           turn * turn >= SINE_30 * SINE_30 * (x * x + y * y) * (u * u + w * w);
}

/* does the line from vertex i to q run over one of the edges there? */
static bool along(const fw_polygon *p, int i, fw_point q) {
    for (int side = -1; side <= 1; side += 2) {
        fw_point v = at(p, i), w = at(p, i + side);
        int64_t x = ((int64_t)w.x_dbu - v.x_dbu) * ((int64_t)q.x_dbu - v.x_dbu);
        int64_t y = ((int64_t)w.y_dbu - v.y_dbu) * ((int64_t)q.y_dbu - v.y_dbu);
        if (cross(v, w, q) == 0 && x >= 0 && y >= 0) return true;
    }
    return false;
}

static bool between(fw_point a, fw_point b, fw_point c) { /* c on the line through a and b */
    int64_t dot = ((int64_t)c.x_dbu - a.x_dbu) * ((int64_t)c.x_dbu - b.x_dbu);
    int64_t more = ((int64_t)c.y_dbu - a.y_dbu) * ((int64_t)c.y_dbu - b.y_dbu);
    return dot <= 0 && more <= 0;
}

static bool meet(fw_point a, fw_point b, fw_point c, fw_point d) {
    int64_t abc = cross(a, b, c), abd = cross(a, b, d), cda = cross(c, d, a), cdb = cross(c, d, b);
    if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc && abd && cda && cdb)
        return true;
    return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) ||
           (cda == 0 && between(c, d, a)) || (cdb == 0 && between(c, d, b));
}

static double distance_to_line(fw_point a, fw_point b, fw_point c) {
    double x = (double)b.x_dbu - a.x_dbu, y = (double)b.y_dbu - a.y_dbu;
    double u = (double)c.x_dbu - a.x_dbu, w = (double)c.y_dbu - a.y_dbu;
    double t = fmin(1, fmax(0, (x * u + y * w) / (x * x + y * y)));
    return hypot(u - t * x, w - t * y);
}

static bool is_neighbour(const fw_polygon *p, int k, int i) {
    int gap = k > i ? k - i : i - k;
    return gap <= 1 || gap == p->count - 1;
}

/* strictly inside the polygon, and of the quality asked for. Cost O(n). */
static bool valid(const search *s, int i, int j) {
    const fw_polygon *p = s->p;
    fw_point a = at(p, i), b = at(p, j);
    if (!enters(p, i, b) || !enters(p, j, a)) return false;
    if (along(p, i, b) || along(p, j, a)) return false;
    if (s->wide && !(wide(a, at(p, i - 1), b) && wide(a, at(p, i + 1), b) &&
                     wide(b, at(p, j - 1), a) && wide(b, at(p, j + 1), a)))
        return false;
    for (int d = 0; d < p->count; d++) { /* from i both ways: most lines that fail do so near it */
        int k = i + (d % 2 ? (d + 1) / 2 : -(d / 2)) + p->count;
        k %= p->count;
        int next = k + 1 < p->count ? k + 1 : 0;
        if (k != i && next != i && k != j && next != j && meet(a, b, at(p, k), at(p, next)))
            return false;
        bool own = k == i || k == j;
        if (s->wide) own = is_neighbour(p, k, i) || is_neighbour(p, k, j); /* at their angle */
        if (s->clear && !own && distance_to_line(a, b, at(p, k)) < CLEAR_DBU) return false;
    }
    return true;
}

static void look(search *s, int step) {
    int n = s->p->count, least = n / s->share > 2 ? n / s->share : 2;
    for (int i = 0; i < n; i += step)
        for (int j = i + least; j <= i + n - least && j < n; j += step) {
            double l2 = length2(at(s->p, i), at(s->p, j));
            if (!(l2 < s->least2) || !valid(s, i, j)) continue;
            s->least2 = l2;
            s->i = i;
            s->j = j;
        }
}

/* Shortest straight cut that leaves at least a quarter of the vertices on either side (less where
   that makes it a good one): a neck, where there is one. In: a simple polygon,
   counter-clockwise. Every polygon has a cut inside it with at least n / 3 edges on either side
   (the middle edge of the tree of any triangulation), so the last search, over all pairs, finds
   one. Cost: at most SAMPLES^2 / 2 lengths and an O(n) check for each that is shorter than the
   best; only where that finds nothing, all pairs. Exact integers decide what is inside. Test:
   test_polygon_cut.c. */
static bool find(const fw_polygon *p, int *i, int *j) {
    static const struct {
        bool wide, clear, all;
        int share;
    } rounds[] = {
        {true, true, false, 4},   {true, true, false, 8},
        {false, true, false, 8}, /* discs: no angle is wide */
        {true, true, false, 32}, /* one finger of a comb */
        {false, true, false, 32}, {false, false, false, 4},
        {false, false, true, 4},
    };
    int coarse = p->count / SAMPLES > 1 ? p->count / SAMPLES : 1;
    for (size_t round = 0; round < sizeof rounds / sizeof *rounds; round++) {
        search s = {.p = p,
                    .wide = rounds[round].wide,
                    .clear = rounds[round].clear,
                    .share = rounds[round].share,
                    .i = -1,
                    .j = -1,
                    .least2 = HUGE_VAL};
        look(&s, rounds[round].all ? 1 : coarse);
        *i = s.i;
        *j = s.j;
        if (s.i >= 0) return true;
    }
    return false;
}

static fw_status part_of(fw_arena *arena, const fw_polygon *p, int from, int to, fw_polygon *out) {
    int n = to - from + 1;
    FW_NEED(out->vertex = fw_arena_array(arena, fw_point, (size_t)n));
    for (int k = 0; k < n; k++)
        out->vertex[k] = at(p, from + k);
    out->count = n;
    return FW_OK;
}

fw_status fw_polygon_cut(fw_arena *arena, const fw_polygon *polygon, int most, fw_polygon **part,
                         int *npart) {
    size_t room = polygon->count <= most ? 1 : (size_t)polygon->count; /* triangles are fewer */
    fw_polygon *list = fw_arena_array(arena, fw_polygon, room);
    FW_NEED(list);
    list[0] = *polygon;
    int n = 1;
    for (int k = 0; k < n;) {
        int i, j;
        if (list[k].count <= most) {
            k++;
            continue;
        }
        if ((size_t)n == room || !find(&list[k], &i, &j)) return FW_GEOMETRY;
        fw_polygon whole = list[k], first, second;
        FW_TRY(part_of(arena, &whole, i, j, &first));
        FW_TRY(part_of(arena, &whole, j, i + whole.count, &second));
        memmove(list + k + 2, list + k + 1, (size_t)(n - k - 1) * sizeof *list);
        list[k] = first;
        list[k + 1] = second;
        n++;
    }
    *part = list;
    *npart = n;
    return FW_OK;
}
