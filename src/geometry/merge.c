/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Winding numbers of every set on both sides of every edge, and the edges that bound a region. */
#include "geometry/merge.h"
#include "base/sort.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- equal edges as one ---- */

typedef struct line { /* low before high */
    fw_geometry_point low, high;
    int16_t times[FW_MERGE_SETS]; /* from below to above each set gains so many */
    int16_t above[FW_MERGE_SETS]; /* winding numbers there */
    bool in_below, in_above;      /* does the region lie there? */
} line;

/* by the lower end, then from the one that turns most to the right to the one most to the left */
static int by_start_and_turn(fw_geometry_point a_low, fw_geometry_point a_high,
                             fw_geometry_point b_low, fw_geometry_point b_high) {
    int order = fw_order_wholes(fw_geometry_merge_key(a_low), fw_geometry_merge_key(b_low));
    if (order) return order;
    return fw_order_wholes(0, fw_cross(a_low, a_high, b_high));
}

static int by_edge(const void *left, const void *right) {
    const fw_geometry_merge_edge *a = left, *b = right;
    int order = by_start_and_turn(a->low, a->high, b->low, b->high);
    if (order) return order;
    order = fw_order_wholes(fw_geometry_merge_key(a->high), fw_geometry_merge_key(b->high));
    return order ? order : fw_order_wholes(a->set, b->set);
}

static bool nothing(const line *l, int sets) {
    for (int k = 0; k < sets; k++)
        if (l->times[k]) return false;
    return true;
}

static fw_status lines_of(fw_arena *arena, const fw_geometry_merge_edges *edges, int sets,
                          line **out, int *count) {
    fw_geometry_merge_edge *sorted =
        fw_arena_array(arena, fw_geometry_merge_edge, (size_t)edges->n);
    line *l = fw_arena_array(arena, line, (size_t)edges->n);
    FW_NEED(sorted && l ? l : NULL);
    if (edges->n) memcpy(sorted, edges->edge, (size_t)edges->n * sizeof *sorted);
    qsort(sorted, (size_t)edges->n, sizeof *sorted, by_edge);
    int n = 0;
    for (int i = 0; i < edges->n; i++) {
        const fw_geometry_merge_edge *e = &sorted[i];
        bool same = i > 0 &&
                    fw_geometry_merge_key(sorted[i - 1].low) == fw_geometry_merge_key(e->low) &&
                    fw_geometry_merge_key(sorted[i - 1].high) == fw_geometry_merge_key(e->high);
        if (!same) {
            if (n > 0 && nothing(&l[n - 1], sets)) n--; /* two neighbours share it */
            l[n++] = (line){.low = e->low, .high = e->high};
        }
        l[n - 1].times[e->set] = (int16_t)(l[n - 1].times[e->set] + e->times);
    }
    if (n > 0 && nothing(&l[n - 1], sets)) n--;
    *out = l;
    *count = n;
    return FW_OK;
}

/* ---- the sweep ---- */

typedef struct sweep {
    line *line;
    int nline;
    int *active; /* (nactive) lines that the vertical meets, from below */
    int nactive;
    const fw_geometry_merge_term *term;
    int nterm, sets;
} sweep;

static bool inside(const sweep *s, const int16_t *winding) {
    bool in = false;
    for (int i = 0; i < s->nterm; i++) {
        bool there = winding[s->term[i].set] != 0;
        switch (s->term[i].rule) {
        case FW_SET_OR:
            in = in || there;
            break;
        case FW_SET_AND:
            in = in && there;
            break;
        case FW_SET_NOT:
            in = in && !there;
            break;
        case FW_SET_XOR:
            in = in != there;
            break;
        }
    }
    return in;
}

/* how many active lines lie wholly below a point */
static int below(const sweep *s, fw_geometry_point p) {
    int low = 0, high = s->nactive;
    while (low < high) {
        int middle = (low + high) / 2;
        const line *l = &s->line[s->active[middle]];
        if (fw_cross(l->low, l->high, p) > 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* the lines from `at` on that end in p, replaced by those that begin there, from..to */
static void exchange(sweep *s, int at, fw_geometry_point p, int from, int to) {
    int ending = 0;
    while (at + ending < s->nactive &&
           fw_geometry_merge_key(s->line[s->active[at + ending]].high) == fw_geometry_merge_key(p))
        ending++;
    int beginning = to - from;
    if (beginning != ending)
        memmove(s->active + at + beginning, s->active + at + ending,
                (size_t)(s->nactive - at - ending) * sizeof *s->active);
    s->nactive += beginning - ending;
    for (int i = 0; i < beginning; i++)
        s->active[at + i] = from + i;
}

static void wind(sweep *s, int at, int from, int to) {
    int16_t winding[FW_MERGE_SETS] = {0};
    if (at > 0) memcpy(winding, s->line[s->active[at - 1]].above, sizeof winding);
    for (int i = from; i < to; i++) {
        line *l = &s->line[i];
        l->in_below = inside(s, winding);
        for (int k = 0; k < s->sets; k++)
            winding[k] = (int16_t)(winding[k] + l->times[k]);
        l->in_above = inside(s, winding);
        memcpy(l->above, winding, sizeof winding);
    }
}

static int by_key(const void *left, const void *right) {
    return fw_order_wholes(*(const int64_t *)left, *(const int64_t *)right);
}

static fw_geometry_point point_of(int64_t key) {
    int32_t y = (int32_t)(uint32_t)((uint64_t)key & 0xffffffffu);
    return (fw_geometry_point){(int32_t)((key - y) / ((int64_t)1 << 32)), y};
}

static fw_status sweep_lines(fw_arena *arena, sweep *s) {
    int64_t *key = fw_arena_array(arena, int64_t, 2 * (size_t)s->nline);
    s->active = fw_arena_array(arena, int, (size_t)s->nline);
    FW_NEED(key && s->active ? key : NULL);
    for (int i = 0; i < s->nline; i++) {
        key[2 * i] = fw_geometry_merge_key(s->line[i].low);
        key[2 * i + 1] = fw_geometry_merge_key(s->line[i].high);
    }
    qsort(key, 2 * (size_t)s->nline, sizeof *key, by_key);
    for (int i = 0, from = 0; i < 2 * s->nline; i++) {
        if (i > 0 && key[i] == key[i - 1]) continue;
        fw_geometry_point p = point_of(key[i]);
        int to = from, at = below(s, p);
        while (to < s->nline && fw_geometry_merge_key(s->line[to].low) == key[i])
            to++;
        wind(s, at, from, to);
        exchange(s, at, p, from, to);
        from = to;
    }
    return s->nactive == 0 ? FW_OK : FW_INTERNAL; /* edges met elsewhere than at their ends */
}

/* ---- closed lines ---- */

/* is b on the way from a to c? */
static bool straight(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return fw_cross(a, b, c) == 0 &&
           ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.x_dbu - b.x_dbu) +
                   ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.y_dbu - b.y_dbu) >
               0;
}

/* does no other line come by where a side starts? */
static bool alone(const fw_geometry_merge_sides *s, int i) {
    int64_t key = fw_geometry_merge_key(s->side[i].a);
    return (i == 0 || fw_geometry_merge_key(s->side[i - 1].a) != key) &&
           (i + 1 == s->n || fw_geometry_merge_key(s->side[i + 1].a) != key);
}

/* one closed line without its straight vertices; says its direction */
static fw_status add_loop(fw_arena *arena, const fw_geometry_merge_sides *s, const int *next,
                          int start, bool *done, fw_geometry_merge_sides *out, int *outlines,
                          int *holes) {
    int from = out->n;
    int64_t area2 = 0;
    for (int i = start; !done[i]; i = next[i]) {
        const fw_geometry_merge_side *e = &s->side[i];
        fw_geometry_merge_side *last = out->n > from ? &out->side[out->n - 1] : NULL;
        done[i] = true;
        area2 +=
            ((int64_t)e->a.x_dbu - s->side[start].a.x_dbu) * ((int64_t)e->b.y_dbu - e->a.y_dbu) -
            ((int64_t)e->a.y_dbu - s->side[start].a.y_dbu) * ((int64_t)e->b.x_dbu - e->a.x_dbu);
        if (last && alone(s, i) && straight(last->a, last->b, e->b))
            last->b = e->b;
        else
            FW_TRY(fw_geometry_merge_add_side(arena, out, *e));
    }
    fw_geometry_merge_side *first = &out->side[from], *last = &out->side[out->n - 1];
    if (alone(s, start) && straight(last->a, last->b, first->b)) {
        first->a = last->a;
        out->n--;
    }
    *(area2 > 0 ? outlines : holes) += 1;
    return FW_OK;
}

fw_status fw_geometry_merge_border(fw_arena *arena, const fw_geometry_merge_edges *edges,
                                   const fw_geometry_merge_term *term, int nterm,
                                   fw_geometry_merge_sides *out, int *outlines, int *holes) {
    sweep s = {.term = term, .nterm = nterm};
    fw_geometry_merge_sides border = {0};
    *out = (fw_geometry_merge_sides){0};
    *outlines = *holes = 0;
    for (int i = 0; i < edges->n; i++)
        s.sets = edges->edge[i].set >= s.sets ? edges->edge[i].set + 1 : s.sets;
    FW_TRY(lines_of(arena, edges, s.sets, &s.line, &s.nline));
    if (s.nline == 0) return FW_OK;
    FW_TRY(sweep_lines(arena, &s));
    for (int i = 0; i < s.nline; i++) {
        const line *l = &s.line[i];
        if (l->in_below == l->in_above) continue;
        fw_geometry_merge_side side = {l->in_above ? l->low : l->high,
                                       l->in_above ? l->high : l->low, false, -1};
        FW_TRY(fw_geometry_merge_add_side(arena, &border, side));
    }
    int *next;
    FW_TRY(fw_geometry_merge_follow(arena, &border, &next));
    bool *done = fw_arena_array(arena, bool, (size_t)border.n + 1);
    FW_NEED(done);
    for (int i = 0; i < border.n; i++)
        if (!done[i]) FW_TRY(add_loop(arena, &border, next, i, done, out, outlines, holes));
    return FW_OK;
}

/* ---- the whole ---- */

static fw_status edges_of(fw_arena *arena, const fw_geometry_merge_input *input, int ninput,
                          fw_geometry_merge_edges *out) {
    size_t n = 0;
    for (int i = 0; i < ninput; i++)
        n += (size_t)input[i].polygon->count;
    if (n > INT32_MAX / 4) return FW_LIMIT;
    *out = (fw_geometry_merge_edges){.edge = fw_arena_array(arena, fw_geometry_merge_edge, n + 1)};
    FW_NEED(out->edge);
    for (int i = 0; i < ninput; i++) {
        const fw_geometry_polygon *p = input[i].polygon;
        int times = fw_geometry_polygon_area2(p) < 0 ? -1 : 1; /* of either direction */
        for (int k = 0; k < p->count; k++) {
            fw_geometry_point a = p->vertex[k], b = p->vertex[k + 1 < p->count ? k + 1 : 0];
            bool forward = fw_geometry_merge_key(a) < fw_geometry_merge_key(b);
            if (fw_geometry_merge_key(a) == fw_geometry_merge_key(b)) continue;
            out->edge[out->n++] = (fw_geometry_merge_edge){forward ? a : b, forward ? b : a,
                                                           input[i].set, forward ? times : -times};
        }
    }
    return FW_OK;
}

fw_status fw_geometry_merge(fw_arena *arena, const fw_geometry_merge_input *input, int ninput,
                            const fw_geometry_merge_term *term, int nterm, int most,
                            fw_geometry_merged *out) {
    fw_geometry_merge_edges edges, nodes;
    fw_geometry_merge_sides sides;
    *out = (fw_geometry_merged){.clear_m = HUGE_VAL};
    for (int i = 0; i < ninput; i++)
        if (input[i].set < 0 || input[i].set >= FW_MERGE_SETS) return FW_LIMIT;
    for (int i = 0; i < nterm; i++)
        if (term[i].set < 0 || term[i].set >= FW_MERGE_SETS) return FW_LIMIT;
    FW_TRY(edges_of(arena, input, ninput, &edges));
    FW_TRY(fw_geometry_merge_nodes(arena, &edges, &nodes, &out->rounded));
    FW_TRY(
        fw_geometry_merge_border(arena, &nodes, term, nterm, &sides, &out->outlines, &out->holes));
    FW_TRY(fw_geometry_merge_monotone(arena, &sides));
    return fw_geometry_merge_parts(arena, &sides, most, out);
}

/* ---- the region as it is bounded ---- */

static fw_status loop_of(fw_arena *arena, const fw_geometry_merge_side *side, int n,
                         fw_geometry_polygon *out) {
    int64_t area2;
    FW_NEED(out->vertex = fw_arena_array(arena, fw_geometry_point, (size_t)n));
    out->count = n;
    for (int i = 0; i < n; i++)
        out->vertex[i] = side[i].a;
    area2 = fw_geometry_polygon_area2(out);
    for (int i = 0; i < n && area2 < 0; i++)
        out->vertex[i] = side[n - 1 - i].a;
    return FW_OK;
}

/* is the middle of its first edge inside? Borders of a region do not lie upon each other. */
static bool lies_in(const fw_geometry_polygon *p, const fw_geometry_polygon *around) {
    const double x = 0.5 * ((double)p->vertex[0].x_dbu + p->vertex[1].x_dbu),
                 y = 0.5 * ((double)p->vertex[0].y_dbu + p->vertex[1].y_dbu);
    bool in = false;
    for (int i = 0; i < around->count; i++) {
        const fw_geometry_point a = around->vertex[i],
                                b = around->vertex[i + 1 < around->count ? i + 1 : 0];
        if ((a.y_dbu > y) == (b.y_dbu > y)) continue;
        const double at =
            a.x_dbu + (y - a.y_dbu) * ((double)b.x_dbu - a.x_dbu) / ((double)b.y_dbu - a.y_dbu);
        if (at > x) in = !in;
    }
    return in;
}

fw_status fw_geometry_merge_loops(fw_arena *arena, const fw_geometry_merge_input *input, int ninput,
                                  const fw_geometry_merge_term *term, int nterm,
                                  fw_geometry_polygon **loop, int **depth, int *n) {
    fw_geometry_merge_edges edges, nodes;
    fw_geometry_merge_sides sides;
    int rounded, outlines, holes;
    *n = 0;
    FW_TRY(edges_of(arena, input, ninput, &edges));
    FW_TRY(fw_geometry_merge_nodes(arena, &edges, &nodes, &rounded));
    FW_TRY(fw_geometry_merge_border(arena, &nodes, term, nterm, &sides, &outlines, &holes));
    const size_t most = (size_t)outlines + (size_t)holes;
    fw_geometry_polygon *list = fw_arena_array(arena, fw_geometry_polygon, most);
    int *deep = fw_arena_array(arena, int, most);
    FW_NEED(list && deep ? list : NULL);
    for (int from = 0, to; from < sides.n; from = to) {
        const int64_t start = fw_geometry_merge_key(sides.side[from].a);
        for (to = from + 1; fw_geometry_merge_key(sides.side[to - 1].b) != start;)
            to++;
        FW_TRY(loop_of(arena, &sides.side[from], to - from, &list[(*n)++]));
    }
    for (int i = 0; i < *n; i++) {
        for (int k = 0; k < *n; k++)
            deep[i] += k != i && lies_in(&list[i], &list[k]);
        if (deep[i] >= FW_MERGE_SETS) return FW_LIMIT;
    }
    *loop = list;
    *depth = deep;
    return FW_OK;
}
