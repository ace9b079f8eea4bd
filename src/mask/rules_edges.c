/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boundary of the union on one layer: every segment that is no joint, shape by shape, and where
   it turns. */
#include "mask/rule.h"
#include "base/constants.h"
#include "base/sort.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double ROUND_M = FW_SQRT_HALF / 1e9; /* a vertex moves by at most g/sqrt2 */

/* nearest whole number, as nearbyint finds it, without its call */
static double nearest(double n) {
    const double magic = 6755399441055744.0, far = 1125899906842624.0; /* 1.5 2^52, 2^50 */
    return fabs(n) < far ? n + magic - magic : nearbyint(n);
}

static bool on_grid(fw_geometry_vec2 p) {
    double x = p.x / FW_GEOMETRY_GRID_M, y = p.y / FW_GEOMETRY_GRID_M;
    return fabs(x - nearest(x)) < 1e-5 && fabs(y - nearest(y)) < 1e-5;
}

struct fw_mask_rule_starts { /* chains of edges whose places fall into one slot */
    int *first, *next;       /* (slots), (nedge); -1: the end */
    fw_geometry_vec2 *at;    /* (nedge) where each begins, side by side to be looked through */
    uint32_t mask;           /* slots - 1 */
};

/* of the bits; 0.0 and -0.0 are one place */
static uint32_t slot_of(const struct fw_mask_rule_starts *s, fw_geometry_vec2 at) {
    double p[2] = {at.x + 0.0, at.y + 0.0};
    uint64_t bits[2];
    memcpy(bits, p, sizeof bits);
    uint64_t h = (bits[0] ^ (bits[1] << 17 | bits[1] >> 47)) * UINT64_C(0x9e3779b97f4a7c15);
    return (uint32_t)(h >> 32) & s->mask;
}

static int same_place(const fw_mask_rule_search *in, fw_geometry_vec2 at, int edge) {
    while (edge >= 0 && !vec_same(in->start->at[edge], at))
        edge = in->start->next[edge];
    return edge;
}

int fw_mask_rule_start_at(const fw_mask_rule_search *in, fw_geometry_vec2 at, int after) {
    const struct fw_mask_rule_starts *s = in->start;
    return same_place(in, at, after >= 0 ? s->next[after] : s->first[slot_of(s, at)]);
}

static fw_status list_starts(fw_mask_rule_search *in) {
    uint32_t slots = 16;
    while (slots < 2 * (uint32_t)in->nedge)
        slots *= 2;
    struct fw_mask_rule_starts *s = fw_arena_one(in->arena, struct fw_mask_rule_starts);
    FW_NEED(s);
    FW_NEED(s->first = fw_arena_raw(in->arena, slots * sizeof *s->first));
    FW_NEED(s->next = fw_arena_raw(in->arena, (size_t)in->nedge * sizeof *s->next));
    FW_NEED(s->at = fw_arena_raw(in->arena, (size_t)in->nedge * sizeof *s->at));
    s->mask = slots - 1;
    memset(s->first, -1, slots * sizeof *s->first);
    for (int i = in->nedge - 1; i >= 0; i--) { /* backwards: chains then run forwards */
        s->at[i] = in->edge[i].s.a;
        int *head = &s->first[slot_of(s, s->at[i])];
        s->next[i] = *head;
        *head = i;
    }
    in->start = s;
    return FW_OK;
}

static fw_geometry_vec2 tangent(const fw_mask_rule_edge *e, double t) {
    return e->s.kind == FW_LINE ? e->along : fw_geometry_segment_tangent(&e->s, t);
}

/* corners of the union: across a joint the outline goes on in the other piece. Cost O(n) */
static void mark_corners(fw_mask_rule_search *in) {
    fw_mask_rule_edge *list = in->edge;
    for (int i = 0; i < in->nedge; i++)
        list[i].corner_a = list[i].corner_b = true;
    for (int i = 0; i < in->nedge; i++)
        for (int j = fw_mask_rule_start_at(in, list[i].s.b, -1); j >= 0;
             j = fw_mask_rule_start_at(in, list[i].s.b, j)) {
            fw_geometry_vec2 u = tangent(&list[i], 1), v = tangent(&list[j], 0);
            if (vec_dot(u, v) > 0 && fabs(vec_cross(u, v)) < FW_SMOOTH_RAD)
                list[i].corner_b = list[j].corner_a = false;
        }
}

static int by_left(const void *left, const void *right) {
    const fw_mask_rule_range *p = left, *q = right;
    int order = fw_order_doubles(p->box.x0, q->box.x0);
    return order ? order : fw_order_wholes(p->first, q->first);
}

typedef struct entry { /* an edge to be */
    fw_geometry_box box;
    double slack_m;
    int segment;
} entry;

static int by_left_entry(const void *left, const void *right) {
    const entry *p = left, *q = right;
    int order = fw_order_doubles(p->box.x0, q->box.x0);
    return order ? order : fw_order_wholes(p->segment, q->segment);
}

/* they come in the order of segments */
static void sort_entries(entry *list, int n) {
    enum { FEW = 32 }; /* put into order one by one */
    if (n > FEW) {
        qsort(list, (size_t)n, sizeof *list, by_left_entry);
        return;
    }
    for (int i = 1; i < n; i++) {
        entry e = list[i];
        int k = i;
        for (; k > 0 && list[k - 1].box.x0 > e.box.x0; k--)
            list[k] = list[k - 1];
        list[k] = e;
    }
}

/* which ways it runs: the direction of the chord is that of the middle, up to a whole turn */
static void set_direction(fw_mask_rule_edge *e) {
    double half = 0.5 * fabs(e->s.sweep_rad);
    bool line = e->s.kind == FW_LINE;
    e->along = vec_unit(vec_sub(e->s.b, e->s.a));
    e->sin_half = line ? 0 : sin(half);
    e->cos_half = line ? 1 : cos(half);
}

/* all of a shape that is no joint, by the left end; a vertex is asked once whether it is on the
 * grid
 */
static int list_entries(const fw_geometry_contour *c, double tolerance_m, entry *list,
                        fw_geometry_box *box) {
    int n = 0;
    bool start, end = c->count > 0 && on_grid(c->segment[0].a);
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        entry e = {.box = fw_segment_box(s), .segment = i};
        *box = i > 0 ? fw_box_join(*box, e.box) : e.box;
        start = end, end = on_grid(s->b);
        if (s->flags & FW_SEGMENT_JOINT) continue;
        e.slack_m = s->kind == FW_ARC ? tolerance_m + ROUND_M : start && end ? 0 : ROUND_M;
        list[n++] = e;
    }
    sort_entries(list, n);
    return n;
}

static fw_status add_shape(fw_mask_rule_search *in, int k, double tolerance_m) {
    const fw_geometry_contour *c = &in->shape[k].contour;
    fw_mask_rule_range *range = &in->range[in->nrange];
    *range = (fw_mask_rule_range){.first = in->nedge, .shape = k};
    fw_mark mark = fw_arena_mark(in->arena);
    entry *list = fw_arena_raw(in->arena, (size_t)c->count * sizeof *list);
    FW_NEED(list);
    range->count = list_entries(c, tolerance_m, list, &range->box);
    for (int i = 0; i < range->count; i++) {
        fw_mask_rule_edge *e = &in->edge[in->nedge++];
        *e = (fw_mask_rule_edge){.s = c->segment[list[i].segment],
                                 .box = list[i].box,
                                 .shape = k,
                                 .segment = list[i].segment,
                                 .slack_m = list[i].slack_m};
        set_direction(e);
        in->slack_m = fw_greater(in->slack_m, e->slack_m);
    }
    fw_arena_rewind(in->arena, mark);
    if (range->count > 0) in->nrange++;
    return FW_OK;
}

fw_status fw_mask_rule_edges(fw_mask_rule_search *in, int nshape, double tolerance_m) {
    size_t edges = 0, shapes = 0;
    for (int k = 0; k < nshape; k++)
        if (in->shape[k].layer == in->index) shapes++, edges += (size_t)in->shape[k].contour.count;
    /* not zeroed: each is filled as a whole */
    in->tolerance_m = tolerance_m;
    FW_NEED(in->edge = fw_arena_raw(in->arena, edges * sizeof *in->edge));
    FW_NEED(in->range = fw_arena_array(in->arena, fw_mask_rule_range, shapes));
    for (int k = 0; k < nshape; k++)
        if (in->shape[k].layer == in->index) FW_TRY(add_shape(in, k, tolerance_m));
    FW_TRY(list_starts(in));
    mark_corners(in);
    qsort(in->range, (size_t)in->nrange, sizeof *in->range, by_left);
    return FW_OK;
}
