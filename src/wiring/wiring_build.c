/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nets of a layout with their names, and the same nets on a mask. Test: test_wiring_drives.c,
   test_wiring_mask.c */
#include "geometry/segment.h"
#include "wiring/wiring_nets.h"
#include <math.h>

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

/* tethers that end at a body of another net connect the two until they are broken */
static void mark_tethers(const fw_layout *layout, fw_wiring *w) {
    for (int i = 0; i < layout->npiece; i++) {
        if (layout->piece[i].role != FW_ROLE_TETHER || w->net_of[i] < 0) continue;
        for (int k = 0; k < layout->npiece; k++)
            if (layout->piece[k].body >= 0 && w->net_of[k] >= 0 && w->net_of[k] != w->net_of[i] &&
                fw_wiring_share_cut(&layout->piece[i].contour, &layout->piece[k].contour))
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
    w->layout = layout;
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
