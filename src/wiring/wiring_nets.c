/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nets of a drawing: pieces of the device layer that hang together.

   Pieces share a cut as a JOINT segment, the same for both to the last bit; the cuts are sorted by their middle,
   and those at one place join their pieces (union by index). In: layout, or the same pieces with the contours
   of a mask, where both sides of a cut are moved to the same doubles. Out: for each piece the lowest index of
   its conductor. Error: none, cuts within TOGETHER_M of each other at both ends are one. Cost: n log n in the
   cuts; where touching pieces are looked for besides, the pairs of edges whose boxes are nearer than that.
   Test: test_wiring_nets.c, against the flood of a raster. */
#include "wiring/wiring.h"
#include "geometry/segment.h"
#include <math.h>
#include <stdlib.h>

static const double TOGETHER_M = 0.5e-9; /* half of the masks' grid */

bool fw_wiring_conducts(const fw_layout_piece *p, bool islands) {
    bool layer = p->role == FW_ROLE_STRUCTURE || p->role == FW_ROLE_FLEXURE ||
                 p->role == FW_ROLE_FRAME || p->role == FW_ROLE_TETHER;
    if (p->body == FW_ISLAND) return layer && islands;
    return layer && p->body >= FW_GROUND;
}

typedef struct cut {
    fw_geometry_vec2 middle, a, b;
    int piece;
} cut;

static int by_place(const void *p, const void *q) {
    const cut *a = p, *b = q;
    if (a->middle.x != b->middle.x) return a->middle.x < b->middle.x ? -1 : 1;
    if (a->middle.y != b->middle.y) return a->middle.y < b->middle.y ? -1 : 1;
    return a->piece - b->piece;
}

static int root(int *part, int i) {
    while (part[i] != i)
        i = part[i] = part[part[i]];
    return i;
}

static void unite(int *part, int i, int k) {
    int a = root(part, i), b = root(part, k);
    part[a > b ? a : b] = a > b ? b : a;
}

/* a tether is broken at the body that it holds, and stays with the frame */
static bool breaks(const fw_layout_piece *p, const fw_layout_piece *q) {
    return (p->role == FW_ROLE_TETHER && q->body >= 0) ||
           (q->role == FW_ROLE_TETHER && p->body >= 0);
}

static bool same_cut(const cut *p, const cut *q) {
    return (vec_distance(p->a, q->b) < TOGETHER_M && vec_distance(p->b, q->a) < TOGETHER_M) ||
           (vec_distance(p->a, q->a) < TOGETHER_M && vec_distance(p->b, q->b) < TOGETHER_M);
}

static fw_status join_cuts(fw_arena *arena, const fw_layout *layout,
                           const fw_geometry_contour *contour, int *part) {
    size_t n = 0, k = 0;
    for (int pass = 0; pass < 2; pass++) {
        cut *list = NULL;
        if (pass) FW_NEED(list = fw_arena_array(arena, cut, n));
        for (int i = 0; i < layout->npiece; i++)
            for (int s = 0; part[i] >= 0 && s < contour[i].count; s++) {
                const fw_geometry_segment *e = &contour[i].segment[s];
                if (!(e->flags & FW_SEGMENT_JOINT)) continue;
                if (!pass) n++;
                if (pass)
                    list[k++] =
                        (cut){{0.5 * (e->a.x + e->b.x), 0.5 * (e->a.y + e->b.y)}, e->a, e->b, i};
            }
        if (!pass) continue;
        qsort(list, n, sizeof *list, by_place);
        for (size_t i = 0; i < n; i++)
            for (size_t j = i + 1; j < n && list[j].middle.x - list[i].middle.x < TOGETHER_M; j++)
                if (same_cut(&list[i], &list[j]) &&
                    !breaks(&layout->piece[list[i].piece], &layout->piece[list[j].piece]))
                    unite(part, list[i].piece, list[j].piece);
    }
    return FW_OK;
}

static fw_status join_touching(fw_arena *arena, const fw_layout *layout,
                               const fw_geometry_contour *contour, int *part) {
    fw_geometry_box *box;
    FW_NEED(box = fw_arena_array(arena, fw_geometry_box, (size_t)layout->npiece));
    for (int i = 0; i < layout->npiece; i++)
        if (part[i] >= 0) box[i] = fw_geometry_contour_box(&contour[i]);
    for (int i = 0; i < layout->npiece; i++)
        for (int k = i + 1; part[i] >= 0 && k < layout->npiece; k++) {
            if (part[k] < 0 || root(part, i) == root(part, k)) continue;
            if (fw_box_gap(box[i], box[k]) > TOGETHER_M ||
                breaks(&layout->piece[i], &layout->piece[k]))
                continue;
            bool meet = fw_geometry_contour_distance_below(
                            &contour[i], &contour[k], 2.0 * TOGETHER_M, NULL, NULL) < TOGETHER_M ||
                        fw_geometry_contour_contains(&contour[i], contour[k].segment[0].a) ||
                        fw_geometry_contour_contains(&contour[k], contour[i].segment[0].a);
            if (meet) unite(part, i, k);
        }
    return FW_OK;
}

fw_status fw_wiring_parts(fw_arena *arena, const fw_layout *layout,
                          const fw_geometry_contour *contour, bool islands, bool touching,
                          int *part) {
    fw_mark mark = fw_arena_mark(arena);
    for (int i = 0; i < layout->npiece; i++)
        part[i] = contour[i].count > 0 && fw_wiring_conducts(&layout->piece[i], islands) ? i : -1;
    FW_TRY(join_cuts(arena, layout, contour, part));
    if (touching) FW_TRY(join_touching(arena, layout, contour, part));
    for (int i = 0; i < layout->npiece; i++)
        if (part[i] >= 0) part[i] = root(part, i);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

bool fw_wiring_share_cut(const fw_geometry_contour *p, const fw_geometry_contour *q) {
    for (int i = 0; i < p->count; i++)
        for (int k = 0; (p->segment[i].flags & FW_SEGMENT_JOINT) && k < q->count; k++) {
            const fw_geometry_segment *s = &p->segment[i], *t = &q->segment[k];
            if ((t->flags & FW_SEGMENT_JOINT) && vec_distance(s->a, t->b) < TOGETHER_M &&
                vec_distance(s->b, t->a) < TOGETHER_M)
                return true;
        }
    return false;
}

fw_wiring_near fw_wiring_least(const fw_layout *layout, const fw_geometry_contour *contour,
                               const fw_geometry_box *box, const int *part, int a, int b) {
    fw_wiring_near near = {.m = HUGE_VAL, .piece = {-1, -1}};
    for (double within = 25e-6; within < 1.0 && near.m == HUGE_VAL; within *= 8.0) {
        double limit = within; /* most pairs are near: far edges are looked at only where none is */
        for (int i = 0; i < layout->npiece; i++)
            for (int k = 0; part[i] == a && k < layout->npiece; k++) {
                fw_geometry_vec2 at[2];
                if (part[k] != b || fw_box_gap(box[i], box[k]) >= limit) continue;
                if (breaks(&layout->piece[i], &layout->piece[k]) &&
                    fw_wiring_share_cut(&contour[i], &contour[k]))
                    continue; /* a tether and what it holds: broken apart */
                double m = fw_geometry_contour_distance_below(&contour[i], &contour[k], limit,
                                                              &at[0], &at[1]);
                if (m >= limit) continue;
                limit = m;
                near = (fw_wiring_near){m, {at[0], at[1]}, {i, k}};
            }
    }
    return near;
}

fw_status fw_wiring_say(fw_arena *arena, const char ***list, int *n, const char *sentence) {
    FW_NEED(sentence);
    FW_NEED(*list = fw_arena_grow(arena, *list, (size_t)*n, (size_t)*n + 1, sizeof **list));
    (*list)[(*n)++] = sentence;
    return FW_OK;
}
