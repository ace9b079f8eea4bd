/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nets of a drawing: pieces of the device layer that hang together.

   Pieces share a cut as a JOINT segment, the same for both to the last bit; the cuts are sorted by their middle,
   and those at one place join their pieces (union by index). In: layout, or the same pieces with the contours
   of a mask, where both sides of a cut are moved to the same doubles. Out: for each piece the lowest index of
   its conductor. Error: none, cuts within TOGETHER_M of each other at both ends are one. Cost: n log n in the
   cuts; where touching pieces are looked for besides, the pairs of edges whose boxes are nearer than that.
   Test: test_wiring_nets.c, against the flood of a raster. */
#include "wiring/wiring_nets.h"
#include "geometry/segment.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

fw_wiring_near fw_wiring_least(const fw_layout *layout, const fw_geometry_contour *contour,
                               const fw_geometry_box *box, const int *part, int a, int b) {
    fw_wiring_near near = {.m = HUGE_VAL, .piece = {-1, -1}};
    for (double within = 25e-6; within < 1.0 && near.m == HUGE_VAL; within *= 8.0) {
        double limit = within; /* most pairs are near: far edges are looked at only where none is */
        for (int i = 0; i < layout->npiece; i++)
            for (int k = 0; part[i] == a && k < layout->npiece; k++) {
                fw_geometry_vec2 at[2];
                if (part[k] != b || fw_box_gap(box[i], box[k]) >= limit) continue;
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

/* ---- the nets of a layout ---- */

/* drawn contours of all pieces, as a list of their own */
static fw_status contours_of(fw_arena *arena, const fw_layout *layout, fw_geometry_contour **out) {
    FW_NEED(*out = fw_arena_array(arena, fw_geometry_contour, (size_t)layout->npiece));
    for (int i = 0; i < layout->npiece; i++)
        (*out)[i] = layout->piece[i].contour;
    return FW_OK;
}

static fw_wiring_kind kind_of(const fw_layout *layout, const int *part, int of) {
    fw_wiring_kind kind = FW_WIRING_HELD;
    for (int i = 0; i < layout->npiece; i++) {
        if (part[i] != of) continue;
        if (layout->piece[i].body >= 0 || layout->piece[i].role == FW_ROLE_FLEXURE)
            return FW_WIRING_ROTOR;
        if (layout->piece[i].body == FW_ISLAND) kind = FW_WIRING_STATOR;
    }
    return kind;
}

/* all that stands on a carrier which conducts is one with it */
static void join_carrier(const fw_layout *layout, int *part) {
    int first = -1;
    for (int i = 0; i < layout->npiece; i++) {
        if (part[i] < 0 || layout->piece[i].body >= 0) continue;
        int mine = part[i];
        if (first < 0) first = mine;
        for (int k = 0; k < layout->npiece && mine != first; k++)
            if (part[k] == mine) part[k] = first;
    }
}

static fw_status name_net(fw_arena *arena, const fw_layout *layout, const int *net_of, int net,
                          int nth, int of, fw_wiring_net *w) {
    const char *label = NULL;
    for (int i = 0; i < layout->npiece && !label; i++)
        if (net_of[i] == net) label = layout->piece[i].label;
    w->name = label ? label : "a part";
    if (w->kind == FW_WIRING_STATOR) return FW_OK;
    const char *what = w->kind == FW_WIRING_ROTOR ? "rotor" : w->frame ? "frame" : w->name;
    if (of > 1) FW_NEED(what = fw_arena_printf(arena, "%s %d", what, nth));
    FW_NEED(w->name = fw_arena_printf(arena, "%s%s%s", what,
                                      w->kind == FW_WIRING_ROTOR && w->frame ? " and frame" : "",
                                      w->carrier ? " and carrier" : ""));
    return FW_OK;
}

static fw_status fill_nets(fw_arena *arena, const fw_layout *layout, const fw_wiring_asked *asked,
                           int *part, fw_wiring *w) {
    int *net_of;
    size_t most = 0;
    FW_NEED(net_of = fw_arena_array(arena, int, (size_t)layout->npiece));
    for (int i = 0; i < layout->npiece; i++) {
        net_of[i] = -1;
        most += part[i] == i;
    }
    FW_NEED(w->net = fw_arena_array(arena, fw_wiring_net, most));
    for (int kind = FW_WIRING_ROTOR; kind <= FW_WIRING_HELD; kind++)
        for (int i = 0; i < layout->npiece; i++) {
            if (part[i] != i || kind_of(layout, part, i) != (fw_wiring_kind)kind) continue;
            fw_wiring_net *n = &w->net[w->nnet];
            *n = (fw_wiring_net){.kind = (fw_wiring_kind)kind};
            n->at = layout->piece[i].contour.segment[0].a;
            for (int k = 0; k < layout->npiece; k++) {
                const fw_layout_piece *p = &layout->piece[k];
                if (part[k] != i) continue;
                net_of[k] = w->nnet;
                n->pieces++;
                n->area_m2 += fw_geometry_contour_area(&p->contour);
                n->frame = n->frame || p->role == FW_ROLE_FRAME;
                n->carrier = n->carrier || (!asked->carrier.insulates && p->body < 0);
            }
            w->nnet++;
        }
    w->net_of = net_of;
    w->npiece = layout->npiece;
    for (int i = 0; i < w->nnet; i++) {
        int nth = 0, of = 0;
        for (int k = 0; k < w->nnet; k++) {
            bool alike = w->net[k].kind == w->net[i].kind && w->net[k].frame == w->net[i].frame;
            of += alike;
            nth += alike && k <= i;
        }
        FW_TRY(name_net(arena, layout, net_of, i, nth, of, &w->net[i]));
    }
    return FW_OK;
}

static bool shares_cut(const fw_geometry_contour *p, const fw_geometry_contour *q) {
    for (int i = 0; i < p->count; i++)
        for (int k = 0; (p->segment[i].flags & FW_SEGMENT_JOINT) && k < q->count; k++) {
            const fw_geometry_segment *s = &p->segment[i], *t = &q->segment[k];
            if ((t->flags & FW_SEGMENT_JOINT) && vec_same(s->a, t->b) && vec_same(s->b, t->a))
                return true;
        }
    return false;
}

/* tethers that end at a body of another net connect the two until they are broken */
static void mark_tethers(const fw_layout *layout, fw_wiring *w) {
    for (int i = 0; i < layout->npiece; i++) {
        if (layout->piece[i].role != FW_ROLE_TETHER || w->net_of[i] < 0) continue;
        for (int k = 0; k < layout->npiece; k++)
            if (layout->piece[k].body >= 0 && w->net_of[k] >= 0 && w->net_of[k] != w->net_of[i] &&
                shares_cut(&layout->piece[i].contour, &layout->piece[k].contour))
                w->net[w->net_of[i]].tethered = true;
    }
}

fw_status fw_wiring_find(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                         const fw_wiring_asked *asked, const fw_wiring **wiring) {
    fw_wiring *w = fw_arena_one(arena, fw_wiring);
    fw_geometry_contour *contour;
    int *part;
    FW_NEED(w);
    *wiring = w;
    w->carrier = asked->carrier;
    if (!layout->drawn) return FW_OK;
    FW_TRY(contours_of(arena, layout, &contour));
    FW_NEED(part = fw_arena_array(arena, int, (size_t)layout->npiece));
    FW_TRY(fw_wiring_parts(arena, layout, contour, asked->carrier.insulates, false, part));
    if (!asked->carrier.insulates) join_carrier(layout, part);
    FW_TRY(fill_nets(arena, layout, asked, part, w));
    mark_tethers(layout, w);
    FW_TRY(fw_wiring_drives(arena, device, layout, asked, w));
    return fw_wiring_gaps(arena, layout, asked, w);
}

/* ---- the same on a mask ---- */

static fw_status say_difference(fw_arena *arena, const fw_layout *layout, const fw_wiring *w, int i,
                                int k, bool joined, fw_wiring_on_mask *found) {
    const fw_layout_piece *p = &layout->piece[i], *q = &layout->piece[k];
    FW_NEED(found->differs = fw_arena_printf(
                arena,
                joined ? "on the mask %s touches %s, so that %s and %s are one net: draw them "
                         "further apart"
                       : "on the mask %s and %s do not hang together any more, so that %s, %s is "
                         "in pieces",
                p->label, q->label, w->net[w->net_of[i]].name, w->net[w->net_of[k]].name));
    return FW_OK;
}

fw_status fw_wiring_compare(fw_arena *arena, const fw_wiring *w, const fw_layout *layout,
                            const fw_geometry_contour *contour, fw_wiring_on_mask *found) {
    int *part, *first;
    fw_geometry_box *box;
    size_t n = (size_t)layout->npiece;
    *found = (fw_wiring_on_mask){.same = true, .least_m = HUGE_VAL};
    FW_NEED(part = fw_arena_array(arena, int, n));
    FW_NEED(box = fw_arena_array(arena, fw_geometry_box, n));
    FW_NEED(first = fw_arena_array(arena, int, (size_t)w->nnet));
    FW_TRY(fw_wiring_parts(arena, layout, contour, w->carrier.insulates, true, part));
    if (!w->carrier.insulates) join_carrier(layout, part);
    for (int i = 0; i < w->nnet; i++)
        first[i] = -1;
    for (int i = 0; i < layout->npiece; i++) {
        if (part[i] < 0) continue;
        box[i] = fw_geometry_contour_box(&contour[i]);
        found->nnet += part[i] == i;
        int *one = &first[w->net_of[i]];
        if (*one < 0) *one = i;
        bool split = part[i] != part[*one];
        if (split && !found->differs)
            FW_TRY(say_difference(arena, layout, w, *one, i, false, found));
        if (w->net_of[part[i]] != w->net_of[i] && !found->differs)
            FW_TRY(say_difference(arena, layout, w, part[i], i, true, found));
    }
    found->same = !found->differs;
    for (int a = 0; a < w->nnet && found->same; a++)
        for (int b = a + 1; b < w->nnet; b++) {
            fw_wiring_near near = fw_wiring_least(layout, contour, box, w->net_of, a, b);
            if (near.m >= found->least_m) continue;
            found->least_m = near.m;
            for (int k = 0; k < 2; k++) {
                found->at[k] = near.at[k];
                found->label[k] = layout->piece[near.piece[k]].label;
            }
        }
    return FW_OK;
}
