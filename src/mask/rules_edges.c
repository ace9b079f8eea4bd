/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boundary of the union on one layer: every segment that is no joint, shape by shape, and where
   it turns. */
#include "mask/rules_search.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

struct fw_rule_starts { /* chains of edges whose places fall into one slot */
    int *first, *next;  /* (slots), (nedge); -1: the end */
    uint32_t mask;      /* slots - 1 */
};

/* of the bits; 0.0 and -0.0 are one place */
static uint32_t slot_of(const struct fw_rule_starts *s, fw_vec2 at) {
    double p[2] = {at.x + 0.0, at.y + 0.0};
    uint64_t bits[2];
    memcpy(bits, p, sizeof bits);
    uint64_t h = (bits[0] ^ (bits[1] << 17 | bits[1] >> 47)) * UINT64_C(0x9e3779b97f4a7c15);
    return (uint32_t)(h >> 32) & s->mask;
}

static int same_place(const fw_rule_search *in, fw_vec2 at, int edge) {
    while (edge >= 0 && !vec_same(in->edge[edge].s.a, at))
        edge = in->start->next[edge];
    return edge;
}

int fw_rule_start_at(const fw_rule_search *in, fw_vec2 at, int after) {
    const struct fw_rule_starts *s = in->start;
    return same_place(in, at, after >= 0 ? s->next[after] : s->first[slot_of(s, at)]);
}

static fw_status list_starts(fw_rule_search *in) {
    uint32_t slots = 16;
    while (slots < 2 * (uint32_t)in->nedge)
        slots *= 2;
    struct fw_rule_starts *s = fw_arena_one(in->arena, struct fw_rule_starts);
    FW_NEED(s);
    FW_NEED(s->first = fw_arena_array(in->arena, int, slots));
    FW_NEED(s->next = fw_arena_array(in->arena, int, (size_t)in->nedge));
    s->mask = slots - 1;
    memset(s->first, -1, slots * sizeof *s->first);
    for (int i = in->nedge - 1; i >= 0; i--) { /* backwards: chains then run forwards */
        int *head = &s->first[slot_of(s, in->edge[i].s.a)];
        s->next[i] = *head;
        *head = i;
    }
    in->start = s;
    return FW_OK;
}

static fw_vec2 tangent(const fw_rule_edge *e, double t) {
    return e->s.kind == FW_LINE ? e->along : fw_segment_tangent(&e->s, t);
}

/* corners of the union: across a joint the outline goes on in the other piece. Cost O(n) */
static void mark_corners(fw_rule_search *in) {
    fw_rule_edge *list = in->edge;
    for (int i = 0; i < in->nedge; i++)
        list[i].corner_a = list[i].corner_b = true;
    for (int i = 0; i < in->nedge; i++)
        for (int j = fw_rule_start_at(in, list[i].s.b, -1); j >= 0;
             j = fw_rule_start_at(in, list[i].s.b, j)) {
            fw_vec2 u = tangent(&list[i], 1), v = tangent(&list[j], 0);
            if (vec_dot(u, v) > 0 && fabs(vec_cross(u, v)) < FW_SMOOTH_RAD)
                list[i].corner_b = list[j].corner_a = false;
        }
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
    *range = (fw_rule_range){.first = in->nedge, .shape = k};
    for (int i = 0; i < c->count; i++) {
        const fw_segment *s = &c->segment[i];
        fw_box box = fw_segment_box(s);
        range->box = i > 0 ? fw_box_join(range->box, box) : box;
        if (s->flags & FW_SEGMENT_JOINT) continue;
        fw_rule_edge *e = &in->edge[in->nedge++];
        *e = (fw_rule_edge){
            .s = *s, .box = box, .shape = k, .segment = i, .slack_m = slack_of(s, tolerance_m)};
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
    /* not zeroed: each is filled as a whole */
    FW_NEED(in->edge = fw_arena_raw(in->arena, edges * sizeof *in->edge));
    FW_NEED(in->range = fw_arena_array(in->arena, fw_rule_range, shapes));
    for (int k = 0; k < nshape; k++)
        if (in->shape[k].layer == in->index) add_shape(in, k, tolerance_m);
    FW_TRY(list_starts(in));
    mark_corners(in);
    qsort(in->range, (size_t)in->nrange, sizeof *in->range, by_left);
    return FW_OK;
}

bool fw_rule_parts(fw_rule_search *in, fw_rule_edge *e) {
    if (e->part) return true;
    int n = (int)ceil(fabs(e->s.sweep_rad) / PART_RAD);
    if (e->s.kind == FW_LINE) { /* itself */
        e->part = &e->s, e->part_box = &e->box, e->nparts = 1;
        return true;
    }
    fw_segment *part = fw_arena_raw(in->arena, (size_t)n * sizeof *part);
    fw_box *box = fw_arena_raw(in->arena, (size_t)n * sizeof *box);
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
