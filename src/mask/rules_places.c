/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chords that are too short, as places. Two edges have many such chords, and a thin part has many
   edges; what a person wants is one finding for each place, with its shortest chord.
     - A chord stands for the stretch of either edge around its foot in which the other edge is
   nearer than the limit, walked from the foot in steps of a quarter of the limit. Chords of the
   same two edges with both feet in these stretches belong to it.
     - Stretches that run on along an edge, or over the end it shares with the next one, within half
   the limit, are one place.
   In: chords of one kind below the limit, m. Out: per pair of shapes the places, shortest chord
   first in their box. Error: places less than half a limit apart become one; none is lost, and no
   length is changed. Cost O(n log n + length / limit) per pair of edges, the square of the
   stretches per pair of shapes. Test: test_rule_seeded.c, test_rules_search.c. */
#include "mask/rules_search.h"
#include <stdlib.h>

enum { MOST_STEPS = 8192 };

typedef struct stretch { /* of both edges */
    const fw_finding *worst;
    double from[2], to[2];
    int place; /* the first stretch of its place */
} stretch;

static int in_order(const void *left, const void *right) {
    const fw_finding *p = left, *q = right;
    for (int k = 0; k < 2; k++)
        if (p->shape[k] != q->shape[k]) return p->shape[k] - q->shape[k];
    for (int k = 0; k < 2; k++) /* of one array each: the order is the same every time */
        if (p->edge[k] != q->edge[k]) return p->edge[k] < q->edge[k] ? -1 : 1;
    if (p->value_m != q->value_m) return p->value_m < q->value_m ? -1 : 1;
    if (!vec_same(p->at[0], q->at[0])) return vec_before(p->at[0], q->at[0]) ? -1 : 1;
    return vec_same(p->at[1], q->at[1]) ? 0 : vec_before(p->at[1], q->at[1]) ? -1 : 1;
}

static bool same_edges(const fw_finding *f, const fw_finding *g) {
    return f->edge[0] == g->edge[0] && f->edge[1] == g->edge[1];
}

static bool same_shapes(const fw_finding *f, const fw_finding *g) {
    return f->shape[0] == g->shape[0] && f->shape[1] == g->shape[1];
}

/* how far from t the other edge stays nearer than the limit, in steps of dt */
static double walk(const fw_segment *s, const fw_segment *other, double t, double dt,
                   double needed) {
    fw_vec2 foot;
    double at, end = dt > 0 ? 1 : 0;
    while (t != end) {
        double next = dt > 0 ? fmin(t + dt, 1) : fmax(t + dt, 0);
        if (!(fw_segment_nearest(other, fw_segment_point(s, next), &at, &foot) < needed)) break;
        t = next;
    }
    return t;
}

static stretch around(const fw_finding *f, double limit_m) {
    stretch r = {.worst = f};
    for (int k = 0; k < 2; k++) {
        const fw_segment *s = &f->edge[k]->s, *other = &f->edge[1 - k]->s;
        double needed = limit_m + f->slack_m, length = fw_segment_length(s);
        double step = fmax(0.25 * needed / length, 1.0 / MOST_STEPS);
        double t = fw_segment_parameter(s, f->at[k]);
        r.from[k] = s == other ? 0 : walk(s, other, t, -step, needed);
        r.to[k] = s == other ? 1 : walk(s, other, t, step, needed);
    }
    return r;
}

static bool covers(const stretch *r, const fw_finding *f) {
    for (int k = 0; k < 2; k++) {
        double t = fw_segment_parameter(&f->edge[k]->s, f->at[k]);
        if (t < r->from[k] - 1e-9 || t > r->to[k] + 1e-9) return false;
    }
    return true;
}

/* do two stretches of edges run into each other, within `near_m` along them? */
static bool run_on(const fw_segment *s, double from_s, double to_s, const fw_segment *t,
                   double from_t, double to_t, double near_m) {
    double length = fw_segment_length(s);
    if (s == t) return fmax(from_s, from_t) - fmin(to_s, to_t) <= near_m / length;
    double at_end = (1 - to_s) * length, at_start = from_s * length;
    double t_end = (1 - to_t) * fw_segment_length(t), t_start = from_t * fw_segment_length(t);
    return (vec_same(s->b, t->a) && at_end + t_start <= near_m) ||
           (vec_same(t->b, s->a) && t_end + at_start <= near_m);
}

static bool one_place(const stretch *p, const stretch *q, double limit_m) {
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            if (run_on(&p->worst->edge[i]->s, p->from[i], p->to[i], &q->worst->edge[j]->s,
                       q->from[j], q->to[j], 0.5 * limit_m))
                return true;
    return false;
}

static fw_box box_of(const stretch *r) {
    fw_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 2; k++) {
        const fw_segment *s = &r->worst->edge[k]->s;
        fw_vec2 at = r->worst->at[k], a = fw_segment_point(s, r->from[k]),
                b = fw_segment_point(s, r->to[k]);
        box = fw_box_join(box, (fw_box){at.x, at.y, at.x, at.y});
        if (r->to[k] - r->from[k] > 1e-9) {
            fw_segment part = fw_segment_cut(s, r->from[k], a, r->to[k], b);
            box = fw_box_join(box, fw_segment_box(&part));
        }
    }
    return box;
}

/* chords of one pair of edges, shortest first: a stretch around each that is in none before */
static int stretches_of(const fw_finding *f, int n, double limit_m, stretch *out, int count) {
    int first = count;
    for (int i = 0; i < n; i++) {
        bool new = true;
        for (int k = first; k < count && new; k++)
            new = !covers(&out[k], &f[i]);
        if (new) out[count++] = around(&f[i], limit_m);
    }
    return count;
}

static int root(const stretch *list, int i) {
    while (list[i].place != i)
        i = list[i].place;
    return i;
}

/* all stretches of one pair of shapes: places, each with its shortest chord */
static int places_of(stretch *list, int n, double limit_m, fw_finding *out) {
    for (int i = 0; i < n; i++) {
        list[i].place = i;
        for (int j = 0; j < i; j++) {
            int p = root(list, i), q = root(list, j);
            if (p != q && one_place(&list[i], &list[j], limit_m))
                list[p > q ? p : q].place = p > q ? q : p;
        }
    }
    int count = 0;
    for (int i = 0; i < n; i++) {
        if (list[i].place != i) continue;
        fw_finding best = *list[i].worst;
        best.box = box_of(&list[i]);
        for (int j = i + 1; j < n; j++) {
            if (root(list, j) != i) continue;
            fw_box box = fw_box_join(best.box, box_of(&list[j]));
            if (list[j].worst->value_m < best.value_m) best = *list[j].worst;
            best.box = box;
        }
        out[count++] = best;
    }
    return count;
}

fw_status fw_rule_places(fw_arena *arena, fw_finding *list, int n, double limit_m, fw_finding **out,
                         int *nout) {
    *nout = 0;
    FW_NEED(*out = fw_arena_array(arena, fw_finding, (size_t)n));
    fw_mark mark = fw_arena_mark(arena);
    stretch *r = fw_arena_array(arena, stretch, (size_t)n);
    FW_NEED(r);
    if (n) qsort(list, (size_t)n, sizeof *list, in_order);
    for (int i = 0, next; i < n; i = next) {
        int count = 0;
        for (next = i; next < n && same_shapes(&list[next], &list[i]);) {
            int from = next;
            while (next < n && same_shapes(&list[next], &list[i]) &&
                   same_edges(&list[next], &list[from]))
                next++;
            count = stretches_of(list + from, next - from, limit_m, r, count);
        }
        *nout += places_of(r, count, limit_m, *out + *nout);
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
