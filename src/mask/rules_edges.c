/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boundary of the union on one layer: every segment that is no joint, shape by shape, and where
   it turns. */
#include "mask/rules_search.h"
#include <stdlib.h>

static const double GRID_M = 1e-9;
static const double ROUND_M = 0.70710678118654752e-9; /* a vertex moves by at most g/sqrt2 */
static const double PART_RAD = FW_PI / 24;            /* 7.5 deg */

static bool on_grid(double x) {
    double n = x / GRID_M;
    return fabs(n - nearbyint(n)) < 1e-5;
}

static double slack_of(const fw_segment *s, double tolerance_m) {
    if (s->kind == FW_ARC) return tolerance_m + ROUND_M;
    bool exact = on_grid(s->a.x) && on_grid(s->a.y) && on_grid(s->b.x) && on_grid(s->b.y);
    return exact ? 0 : ROUND_M;
}

static int by_place(const void *left, const void *right) {
    const fw_rule_start *p = left, *q = right;
    if (!vec_same(p->at, q->at)) return vec_before(p->at, q->at) ? -1 : 1;
    return p->edge - q->edge;
}

int fw_rule_first_at(const fw_rule_start *list, int n, fw_vec2 at) {
    int low = 0;
    while (n > 0) {
        int half = n / 2;
        if (vec_before(list[low + half].at, at))
            low += half + 1, n -= half + 1;
        else
            n = half;
    }
    return low;
}

fw_rule_start *fw_rule_starts(fw_arena *arena, const fw_rule_edge *edge, int n) {
    fw_rule_start *by = fw_arena_array(arena, fw_rule_start, (size_t)n);
    for (int i = 0; by && i < n; i++)
        by[i] = (fw_rule_start){edge[i].s.a, i};
    if (by && n) qsort(by, (size_t)n, sizeof *by, by_place);
    return by;
}

static fw_vec2 tangent(const fw_rule_edge *e, double t) {
    return e->s.kind == FW_LINE ? e->along : fw_segment_tangent(&e->s, t);
}

/* corners of the union: across a joint the outline goes on in the other piece. Cost O(n log n) */
static fw_status mark_corners(fw_arena *arena, fw_rule_edge *list, int n, fw_rule_start **starts) {
    fw_rule_start *by = fw_rule_starts(arena, list, n);
    FW_NEED(*starts = by);
    for (int i = 0; i < n; i++)
        list[i].corner_a = list[i].corner_b = true;
    for (int i = 0; i < n; i++)
        for (int k = fw_rule_first_at(by, n, list[i].s.b); k < n && vec_same(by[k].at, list[i].s.b);
             k++) {
            int j = by[k].edge;
            fw_vec2 u = tangent(&list[i], 1), v = tangent(&list[j], 0);
            if (vec_dot(u, v) > 0 && fabs(vec_cross(u, v)) < FW_SMOOTH_RAD)
                list[i].corner_b = list[j].corner_a = false;
        }
    return FW_OK;
}

static int by_left(const void *left, const void *right) {
    const fw_rule_range *p = left, *q = right;
    if (p->box.x0 != q->box.x0) return p->box.x0 < q->box.x0 ? -1 : 1;
    return p->first - q->first;
}

static int by_left_edge(const void *left, const void *right) {
    const fw_rule_edge *p = left, *q = right;
    if (p->box.x0 != q->box.x0) return p->box.x0 < q->box.x0 ? -1 : 1;
    return p->segment - q->segment;
}

/* which ways it runs: the direction of the chord is that of the middle, up to a whole turn */
static void set_direction(fw_rule_edge *e) {
    double half = 0.5 * fabs(e->s.sweep_rad);
    bool line = e->s.kind == FW_LINE;
    e->along = vec_unit(vec_sub(e->s.b, e->s.a));
    e->sin_half = line ? 0 : sin(half);
    e->cos_half = line ? 1 : cos(half);
}

static void add_shape(fw_rule_search *in, int k, double tolerance_m) {
    const fw_contour *c = &in->shape[k].contour;
    fw_rule_range *range = &in->range[in->nrange];
    *range = (fw_rule_range){.first = in->nedge, .shape = k, .box = fw_contour_box(c)};
    for (int i = 0; i < c->count; i++) {
        const fw_segment *s = &c->segment[i];
        if (s->flags & FW_SEGMENT_JOINT) continue;
        fw_rule_edge *e = &in->edge[in->nedge++];
        *e = (fw_rule_edge){.s = *s,
                            .box = fw_segment_box(s),
                            .shape = k,
                            .segment = i,
                            .slack_m = slack_of(s, tolerance_m)};
        set_direction(e);
        range->count++;
        in->slack_m = fmax(in->slack_m, e->slack_m);
    }
    if (range->count == 0) return;
    qsort(in->edge + range->first, (size_t)range->count, sizeof *in->edge, by_left_edge);
    in->nrange++;
}

fw_status fw_rule_edges(fw_rule_search *in, int nshape, double tolerance_m) {
    size_t edges = 0, shapes = 0;
    for (int k = 0; k < nshape; k++)
        if (in->shape[k].layer == in->index) shapes++, edges += (size_t)in->shape[k].contour.count;
    FW_NEED(in->edge = fw_arena_array(in->arena, fw_rule_edge, edges));
    FW_NEED(in->range = fw_arena_array(in->arena, fw_rule_range, shapes));
    for (int k = 0; k < nshape; k++)
        if (in->shape[k].layer == in->index) add_shape(in, k, tolerance_m);
    FW_TRY(mark_corners(in->arena, in->edge, in->nedge, &in->start));
    qsort(in->range, (size_t)in->nrange, sizeof *in->range, by_left);
    return FW_OK;
}

bool fw_rule_parts(fw_rule_search *in, fw_rule_edge *e) {
    if (e->part) return true;
    int n = e->s.kind == FW_ARC ? (int)ceil(fabs(e->s.sweep_rad) / PART_RAD) : 1;
    fw_segment *part = fw_arena_array(in->arena, fw_segment, (size_t)n);
    fw_box *box = fw_arena_array(in->arena, fw_box, (size_t)n);
    if (!part || !box) {
        in->no_memory = true;
        return false;
    }
    for (int m = 0; m < n; m++) {
        part[m] = e->s;
        part[m].sweep_rad = e->s.sweep_rad / n;
        if (m > 0) part[m].a = part[m - 1].b;
        if (m + 1 < n) part[m].b = fw_segment_point(&e->s, (double)(m + 1) / n);
        box[m] = fw_segment_box(&part[m]);
    }
    e->part = part, e->part_box = box, e->nparts = n;
    return true;
}
