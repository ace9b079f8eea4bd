/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snap rounding: edges on the grid are cut so that they meet at their ends only.

   A square of 1 dbu about every vertex and every rounded crossing is hot; an edge that passes through a
   hot square is led through its middle. Then no two edges cross (Hobby 1999). A square holds its left and
   lower rim and not the others, so that every point lies in exactly one. All decisions are exact: with
   |coordinate| < 2^28 products of two differences fit into 64 bits, those of three into 128. */
#include "base/sort.h"
#include "geometry/merge.h"
#include <math.h>
#include <stdlib.h>

__extension__ typedef __int128 wide;

static const int64_t FARTHEST_DBU = (int64_t)1 << 28;

/* ---- a grid of cells, each with the edges that pass it and the points in it ---- */

typedef struct cells {
    int64_t x0, y0, size; /* of a cell, dbu */
    int columns, rows;
    int *edge_from, *edge; /* (cells + 1); edges of cell c: edge[edge_from[c] ..] */
    int *point_from, *point;
} cells;

typedef struct work {
    fw_arena *arena;
    const fw_geometry_merge_edges *in;
    fw_geometry_point *hot; /* (nhot) each once, sorted */
    int nhot, capacity;
    cells grid;
    int rounded;
    int64_t looks; /* at two edges, or an edge and a point, that share a cell */
} work;

/* a second and a half: a mask of two million vertices takes a tenth of it. What lies upon itself over and over, as an array
   that steps by less than its cell, grows with the square of its shapes */
static const int64_t LOOKS_MOST = 300000000;

static fw_status goes_on(work *w, int64_t looks) {
    w->looks += looks;
    if (w->looks > LOOKS_MOST) return FW_LIMIT;
    return fw_arena_cancelled(w->arena) ? FW_CANCELLED : FW_OK;
}

static int by_point(const void *left, const void *right) {
    const fw_geometry_point *a = left, *b = right;
    return fw_order_wholes(fw_geometry_merge_key(*a), fw_geometry_merge_key(*b));
}

static int64_t floor_of(int64_t a, int64_t b) { /* a / b downwards, b > 0 */
    return a / b - (a % b < 0);
}

static int clamped(int64_t v, int most) {
    return v < 0 ? 0 : v >= most ? most - 1 : (int)v;
}

static int column_of(const cells *g, int64_t x) {
    return clamped(floor_of(x - g->x0, g->size), g->columns);
}

static int row_of(const cells *g, int64_t y) {
    return clamped(floor_of(y - g->y0, g->size), g->rows);
}

/* rows of the cells of one column that an edge passes, and 1 dbu around */
static void rows_of(const cells *g, const fw_geometry_merge_edge *e, int column, int *first,
                    int *last) {
    int64_t left = g->x0 + column * g->size - 2, right = left + g->size + 4;
    int64_t dx = (int64_t)e->high.x_dbu - e->low.x_dbu, dy = (int64_t)e->high.y_dbu - e->low.y_dbu;
    int64_t from = e->low.y_dbu, to = e->high.y_dbu;
    if (dx > 0 && left > e->low.x_dbu)
        from = e->low.y_dbu + floor_of(dy * (left - e->low.x_dbu), dx);
    if (dx > 0 && right < e->high.x_dbu)
        to = e->low.y_dbu + floor_of(dy * (right - e->low.x_dbu), dx);
    *first = row_of(g, (from < to ? from : to) - 2);
    *last = row_of(g, (from < to ? to : from) + 3);
}

/* calls for every cell that an edge passes: counts, or writes */
static void place_edges(work *w, int *count, int *list) {
    cells *g = &w->grid;
    for (int i = 0; i < w->in->n; i++) {
        const fw_geometry_merge_edge *e = &w->in->edge[i];
        int c1 = column_of(g, (int64_t)e->high.x_dbu + 2);
        for (int c = column_of(g, (int64_t)e->low.x_dbu - 2), first, last; c <= c1; c++) {
            rows_of(g, e, c, &first, &last);
            for (int r = first; r <= last; r++) {
                int cell = r * g->columns + c;
                if (list) list[count[cell]] = i;
                count[cell]++;
            }
        }
    }
}

static void place_points(work *w, int *count, int *list) {
    cells *g = &w->grid;
    for (int i = 0; i < w->nhot; i++) {
        int cell = row_of(g, w->hot[i].y_dbu) * g->columns + column_of(g, w->hot[i].x_dbu);
        if (list) list[count[cell]] = i;
        count[cell]++;
    }
}

/* lists by cell: counted, summed, written */
static fw_status listed(work *w, void (*place)(work *, int *, int *), int **from, int **list) {
    size_t n = (size_t)w->grid.columns * (size_t)w->grid.rows;
    int *count = fw_arena_array(w->arena, int, n + 1);
    int *at = fw_arena_array(w->arena, int, n + 1);
    FW_NEED(count && at ? count : NULL);
    place(w, count, NULL);
    int64_t sum = 0;
    for (size_t c = 0; c <= n; c++) {
        int here = c < n ? count[c] : 0;
        at[c] = (int)sum;
        count[c] = (int)sum;
        sum += here;
        if (sum > INT32_MAX) return FW_LIMIT;
    }
    FW_NEED(*list = fw_arena_array(w->arena, int, (size_t)sum + 1));
    place(w, count, *list);
    *from = at;
    return FW_OK;
}

static fw_status lay_grid(work *w) {
    cells *g = &w->grid;
    int64_t x0 = INT64_MAX, y0 = INT64_MAX, x1 = INT64_MIN, y1 = INT64_MIN;
    for (int i = 0; i < w->in->n; i++) {
        const fw_geometry_point p[2] = {w->in->edge[i].low, w->in->edge[i].high};
        for (int k = 0; k < 2; k++) {
            int64_t x = p[k].x_dbu, y = p[k].y_dbu;
            if (llabs(x) >= FARTHEST_DBU || llabs(y) >= FARTHEST_DBU) return FW_LIMIT;
            x0 = x < x0 ? x : x0, x1 = x > x1 ? x : x1;
            y0 = y < y0 ? y : y0, y1 = y > y1 ? y : y1;
        }
    }
    g->x0 = x0, g->y0 = y0;
    /* as many cells as edges, about */
    double area = (double)(x1 - x0 + 1) * (double)(y1 - y0 + 1);
    g->size = (int64_t)ceil(sqrt(area / (w->in->n + 1)));
    int64_t longest = x1 - x0 > y1 - y0 ? x1 - x0 : y1 - y0;
    if (g->size < longest / 4096 + 8) g->size = longest / 4096 + 8;
    g->columns = (int)((x1 - x0) / g->size) + 1;
    g->rows = (int)((y1 - y0) / g->size) + 1;
    return listed(w, place_edges, &g->edge_from, &g->edge);
}

/* ---- crossings ---- */

static fw_status add_hot(work *w, fw_geometry_point p) {
    if (w->nhot == w->capacity) {
        int more = 2 * w->capacity;
        FW_NEED(w->hot =
                    fw_arena_grow(w->arena, w->hot, (size_t)w->nhot, (size_t)more, sizeof *w->hot));
        w->capacity = more;
    }
    w->hot[w->nhot++] = p;
    return FW_OK;
}

/* a + d num / den to the nearest whole number, halves upwards; den > 0 */
static int32_t nearest(int64_t a, int64_t d, int64_t num, int64_t den) {
    wide twice = 2 * (wide)d * num + den, by = 2 * (wide)den;
    wide q = twice / by;
    if (twice % by < 0) q--;
    return (int32_t)(a + (int64_t)q);
}

/* where two edges cross, strictly within both: the rounded point */
static bool crossing(const fw_geometry_merge_edge *e, const fw_geometry_merge_edge *f,
                     fw_geometry_point *at, bool *exact) {
    int64_t a = fw_cross(e->low, e->high, f->low), b = fw_cross(e->low, e->high, f->high);
    if ((a >= 0 && b >= 0) || (a <= 0 && b <= 0)) return false;
    int64_t c = fw_cross(f->low, f->high, e->low), d = fw_cross(f->low, f->high, e->high);
    if ((c >= 0 && d >= 0) || (c <= 0 && d <= 0)) return false;
    int64_t num = c, den = c - d; /* along e, from low */
    if (den < 0) num = -num, den = -den;
    int64_t dx = (int64_t)e->high.x_dbu - e->low.x_dbu, dy = (int64_t)e->high.y_dbu - e->low.y_dbu;
    at->x_dbu = nearest(e->low.x_dbu, dx, num, den);
    at->y_dbu = nearest(e->low.y_dbu, dy, num, den);
    *exact = (wide)dx * num % den == 0 && (wide)dy * num % den == 0;
    return true;
}

static bool apart(const fw_geometry_merge_edge *e, const fw_geometry_merge_edge *f) {
    if (e->high.x_dbu < f->low.x_dbu || f->high.x_dbu < e->low.x_dbu) return true;
    int32_t e0 = e->low.y_dbu, e1 = e->high.y_dbu, f0 = f->low.y_dbu, f1 = f->high.y_dbu;
    return (e0 < f0 && e0 < f1 && e1 < f0 && e1 < f1) || (e0 > f0 && e0 > f1 && e1 > f0 && e1 > f1);
}

static void unique_points(work *w) {
    qsort(w->hot, (size_t)w->nhot, sizeof *w->hot, by_point);
    int n = 0;
    for (int i = 0; i < w->nhot; i++)
        if (n == 0 || fw_geometry_merge_key(w->hot[n - 1]) != fw_geometry_merge_key(w->hot[i]))
            w->hot[n++] = w->hot[i];
    w->nhot = n;
}

/* vertices, and crossings of edges that share a cell */
static fw_status find_hot(work *w) {
    w->capacity = 2 * w->in->n + 64;
    FW_NEED(w->hot = fw_arena_array(w->arena, fw_geometry_point, (size_t)w->capacity));
    for (int i = 0; i < w->in->n; i++) {
        FW_TRY(add_hot(w, w->in->edge[i].low));
        FW_TRY(add_hot(w, w->in->edge[i].high));
    }
    unique_points(w);
    int from = w->nhot, ncell = w->grid.columns * w->grid.rows;
    for (int c = 0; c < ncell; c++)
        for (int i = w->grid.edge_from[c]; i < w->grid.edge_from[c + 1]; i++) {
            FW_TRY(goes_on(w, w->grid.edge_from[c + 1] - i));
            for (int k = i + 1; k < w->grid.edge_from[c + 1]; k++) {
                const fw_geometry_merge_edge *e = &w->in->edge[w->grid.edge[i]];
                const fw_geometry_merge_edge *f = &w->in->edge[w->grid.edge[k]];
                fw_geometry_point at;
                bool exact;
                if (apart(e, f) || !crossing(e, f, &at, &exact)) continue;
                int column = column_of(&w->grid, at.x_dbu), row = row_of(&w->grid, at.y_dbu);
                if (!exact && row * w->grid.columns + column == c) w->rounded++;
                FW_TRY(add_hot(w, at));
            }
        }
    if (w->nhot > from) unique_points(w);
    return listed(w, place_points, &w->grid.point_from, &w->grid.point);
}

/* ---- cutting ---- */

/* Does the edge pass the square about c, its left and lower rim included? The same as: does the edge,
   moved right and up by nothing, pass the open square? */
static bool passes(const fw_geometry_merge_edge *e, fw_geometry_point c) {
    int64_t x0 = 2 * ((int64_t)e->low.x_dbu - c.x_dbu), x1 = 2 * ((int64_t)e->high.x_dbu - c.x_dbu);
    int64_t y0 = 2 * ((int64_t)e->low.y_dbu - c.y_dbu), y1 = 2 * ((int64_t)e->high.y_dbu - c.y_dbu);
    int64_t low = y0 < y1 ? y0 : y1, high = y0 < y1 ? y1 : y0;
    if (x1 < -1 || x0 >= 1 || high < -1 || low >= 1) return false;
    int64_t dx = (x1 - x0) / 2, dy = (y1 - y0) / 2;
    bool left = false, right = false;
    for (int k = 0; k < 4; k++) {
        int64_t s = dx * ((k & 2 ? 1 : -1) - y0) - dy * ((k & 1 ? 1 : -1) - x0);
        if (s == 0) s = dy - dx;
        left = left || s > 0;
        right = right || s < 0;
    }
    return left && right;
}

typedef struct stop { /* a hot point on an edge */
    int64_t along;
    fw_geometry_point at;
} stop;

static int by_along(const void *left, const void *right) {
    const stop *a = left, *b = right;
    int order = fw_order_wholes(a->along, b->along);
    return order ? order
                 : fw_order_wholes(fw_geometry_merge_key(a->at), fw_geometry_merge_key(b->at));
}

static fw_status add_edge(fw_arena *arena, fw_geometry_merge_edges *list, fw_geometry_point a,
                          fw_geometry_point b, int set, int times) {
    if (fw_geometry_merge_key(a) == fw_geometry_merge_key(b)) return FW_OK;
    if (list->n == list->capacity) {
        int more = list->capacity ? 2 * list->capacity : 256;
        FW_NEED(list->edge = fw_arena_grow(arena, list->edge, (size_t)list->n, (size_t)more,
                                           sizeof *list->edge));
        list->capacity = more;
    }
    bool forward = fw_geometry_merge_key(a) < fw_geometry_merge_key(b);
    list->edge[list->n++] =
        (fw_geometry_merge_edge){forward ? a : b, forward ? b : a, set, forward ? times : -times};
    return FW_OK;
}

typedef struct stops {
    stop *item;
    int n, capacity;
} stops;

static fw_status stop_at(work *w, stops *s, const fw_geometry_merge_edge *e, fw_geometry_point p) {
    if (s->n == s->capacity) {
        int more = 2 * s->capacity + 16;
        FW_NEED(s->item =
                    fw_arena_grow(w->arena, s->item, (size_t)s->n, (size_t)more, sizeof *s->item));
        s->capacity = more;
    }
    int64_t dx = (int64_t)e->high.x_dbu - e->low.x_dbu, dy = (int64_t)e->high.y_dbu - e->low.y_dbu;
    s->item[s->n++] =
        (stop){dx * ((int64_t)p.x_dbu - e->low.x_dbu) + dy * ((int64_t)p.y_dbu - e->low.y_dbu), p};
    return FW_OK;
}

static fw_status cut(work *w, const fw_geometry_merge_edge *e, stops *s,
                     fw_geometry_merge_edges *out) {
    const cells *g = &w->grid;
    s->n = 0;
    int c1 = column_of(g, (int64_t)e->high.x_dbu + 1);
    for (int c = column_of(g, (int64_t)e->low.x_dbu - 1), first, last; c <= c1; c++) {
        rows_of(g, e, c, &first, &last);
        for (int r = first; r <= last; r++) {
            int cell = r * g->columns + c;
            FW_TRY(goes_on(w, g->point_from[cell + 1] - g->point_from[cell]));
            for (int k = g->point_from[cell]; k < g->point_from[cell + 1]; k++)
                if (passes(e, w->hot[g->point[k]])) FW_TRY(stop_at(w, s, e, w->hot[g->point[k]]));
        }
    }
    if (s->n > 2) qsort(s->item, (size_t)s->n, sizeof *s->item, by_along);
    fw_geometry_point at = e->low;
    for (int i = 0; i < s->n; i++) {
        fw_geometry_point p = s->item[i].at;
        if (fw_geometry_merge_key(p) == fw_geometry_merge_key(e->low) ||
            fw_geometry_merge_key(p) == fw_geometry_merge_key(e->high))
            continue;
        FW_TRY(add_edge(w->arena, out, at, p, e->set, e->times));
        at = p;
    }
    return add_edge(w->arena, out, at, e->high, e->set, e->times);
}

fw_status fw_geometry_merge_nodes(fw_arena *arena, const fw_geometry_merge_edges *in,
                                  fw_geometry_merge_edges *out, int *rounded) {
    work w = {.arena = arena, .in = in};
    stops s = {0};
    *out = (fw_geometry_merge_edges){0};
    *rounded = 0;
    if (in->n == 0) return FW_OK;
    FW_TRY(lay_grid(&w));
    FW_TRY(find_hot(&w));
    for (int i = 0; i < in->n; i++)
        FW_TRY(cut(&w, &in->edge[i], &s, out));
    *rounded = w.rounded;
    return FW_OK;
}
