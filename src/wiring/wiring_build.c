/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nets of a layout with their names, what the actuators ask of them, and the same nets on a mask. Test:
   test_wiring_drives.c, test_wiring_mask.c */
#include "base/constants.h"
#include "base/text.h"
#include "geometry/segment.h"
#include "quantity/law_kind.h"
#include "release/release.h"
#include "wiring/wiring.h"
#include <math.h>
#include <stdio.h>

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

/* ---- what the actuators ask ----
   A potential between rotor and stator, and a contact on both.

   The range of a drive's voltage is V times that of its law: up to its largest size, 0 included, and below 0
   only where the law may be negative. A contact is the largest square on a part that is held, INSET_M clear
   of its edges and of lettering; a probe or a wire needs LEAST_M. Theory: docs/theory/wiring.md. */

static const double INSET_M = 10e-6, LEAST_M = 80e-6, STEP_M = 5e-6;

/* ---- voltages ---- */

static void voltage_of(const fw_device_comb *c, double duration_s, double *low, double *high) {
    double most = c->voltage_V * fw_quantity_law_largest(c->law, duration_s);
    bool one_sided = fw_quantity_law_never_negative(c->law);
    *low = fmin(0.0, one_sided ? most : -fabs(most));
    *high = fmax(0.0, one_sided ? most : fabs(most));
}

/* ---- contacts ---- */

/* where a track ends at the edge of the chip */
static const fw_layout_electrode *track_of(const fw_layout *layout, const fw_wiring *w, int net) {
    for (int k = 0; k < layout->nelectrode; k++)
        for (int i = 0; layout->electrode[k].routed && i < layout->npiece; i++)
            if (w->net_of[i] == net && layout->piece[i].label == layout->electrode[k].stator)
                return &layout->electrode[k];
    return NULL;
}

/* the piece of a net with the largest square; bases before the frame, which has marks and letters. At the edge
   of the chip: the track's own pad, or the frame. */
static fw_status find_pad(fw_arena *arena, const fw_layout *layout, const fw_wiring *w, int net,
                          bool edge, fw_wiring_net *n) {
    double best = 0.0;
    const fw_layout_electrode *track = edge ? track_of(layout, w, net) : NULL;
    bool frame_first = edge && n->frame;
    if (track) {
        fw_geometry_box b = track->edge_pad;
        n->pad = (fw_geometry_box){b.x0 + INSET_M, b.y0 + INSET_M, b.x1 - INSET_M, b.y1 - INSET_M};
        n->pad_on = track->stator;
        n->padded = fmin(b.x1 - b.x0, b.y1 - b.y0) - 2.0 * INSET_M >= LEAST_M * (1.0 - 1e-9);
        n->at_edge = true;
        return FW_OK;
    }
    for (int pass = 0; pass < 2 && !n->padded; pass++)
        for (int i = 0; i < layout->npiece; i++) {
            const fw_layout_piece *p = &layout->piece[i];
            fw_geometry_box b;
            bool frame = (pass == 1) != frame_first;
            bool held = p->role == (frame ? FW_ROLE_FRAME : FW_ROLE_STRUCTURE) && p->body < 0;
            if (w->net_of[i] != net || !held) continue;
            FW_TRY(fw_release_square_in(arena, layout, i, INSET_M, STEP_M, &b));
            if (!(b.x1 - b.x0 > best)) continue;
            best = b.x1 - b.x0;
            n->pad = b;
            n->pad_on = p->label;
            n->padded = best >= LEAST_M * (1.0 - 1e-9);
            n->at_edge = edge && frame;
        }
    return FW_OK;
}

/* ---- faults ---- */

static int net_of_body(const fw_layout *layout, const fw_wiring *w, int body) {
    for (int i = 0; i < layout->npiece; i++)
        if (layout->piece[i].body == body && layout->piece[i].role == FW_ROLE_STRUCTURE &&
            w->net_of[i] >= 0)
            return w->net_of[i];
    return -1;
}

static int net_labelled(const fw_layout *layout, const fw_wiring *w, const char *label) {
    for (int i = 0; i < layout->npiece && label; i++)
        if (layout->piece[i].label == label && w->net_of[i] >= 0) return w->net_of[i];
    return -1;
}

static const char *place(char text[80], fw_geometry_vec2 at) {
    char x[32], y[32];
    snprintf(text, 80, "(%s, %s) um", fw_number_text(x, sizeof x, 1e6 * at.x, 5),
             fw_number_text(y, sizeof y, 1e6 * at.y, 5));
    return text;
}

/* what is wrong with a drive, in a sentence */
static fw_status judge_drive(fw_arena *arena, const fw_wiring *w, const fw_layout_electrode *e,
                             fw_wiring_drive *d) {
    char at[80];
    const char *stator = e ? e->stator : NULL;
    if (!e || (!stator && d->comb->body_a < 0)) {
        d->fault = FW_WIRING_NOT_DRAWN;
        FW_NEED(d->why = fw_arena_printf(
                    arena,
                    "%s%s is not on the mask, so that nothing of what the scenes ask of it "
                    "can be made: %s. Move it, or leave it out of the scenes of this flow",
                    FW_NAMED("comb drive", d->id),
                    e && e->why_not ? e->why_not : "nothing is drawn for it"));
    } else if (d->comb->body_a >= 0 || d->rotor == d->stator || d->stator < 0) {
        d->fault = FW_WIRING_SHORTED;
        FW_NEED(d->why = fw_arena_printf(
                    arena,
                    "%s%s is shorted: its rotor and its stator are one net%s%s%s, at %s. "
                    "%s",
                    FW_NAMED("comb drive", d->id), d->rotor >= 0 ? " (" : "",
                    d->rotor >= 0 ? w->net[d->rotor].name : "", d->rotor >= 0 ? ")" : "",
                    place(at, d->at),
                    d->comb->body_a >= 0
                        ? "Let its stator stand on the ground"
                        : "Take a carrier that insulates, carrier=\"insulating\" in <flow>"));
    }
    for (int side = 0; side < 2 && d->fault == FW_WIRING_FINE; side++) {
        int net = side ? d->stator : d->rotor;
        if (net >= 0 && w->net[net].padded) continue;
        d->fault = FW_WIRING_NO_PAD;
        FW_NEED(
            d->why = fw_arena_printf(
                arena,
                "%s%s has no contact for its %s: %s at %s has no square of 80 um, 10 "
                "um clear of its edges and of lettering, on a part that is held. Make a base or "
                "its pad wider",
                FW_NAMED("comb drive", d->id), side ? "stator" : "rotor",
                net >= 0 ? w->net[net].name : "its net",
                place(at, net >= 0 ? w->net[net].at : d->at)));
    }
    return FW_OK;
}

/* ---- collecting ---- */

static void widen(fw_wiring_net *n, double low, double high) {
    n->needed = true;
    n->low_V = fmin(n->low_V, low);
    n->high_V = fmax(n->high_V, high);
}

static fw_status collect_drives(const fw_device *device, const fw_layout *layout, const char *flow,
                                fw_wiring *w, const fw_layout_electrode **plan) {
    for (int i = 0; i < device->nscene; i++) {
        const fw_device_scene *s = &device->scene[i];
        if (!fw_device_in_flow(s->flow, flow)) continue;
        for (int c = 0; c < s->ncomb; c++) {
            const fw_device_comb *comb = &s->comb[c];
            const fw_layout_electrode *e = fw_layout_electrode_of(layout, comb);
            int k = 0;
            double low, high;
            voltage_of(comb, s->duration_s, &low, &high);
            while (k < w->ndrive && (!e || plan[k] != e))
                k++;
            fw_wiring_drive *d = &w->drive[k];
            if (k == w->ndrive) {
                plan[w->ndrive++] = e;
                *d = (fw_wiring_drive){.comb = comb,
                                       .id = fw_text_name(comb->id),
                                       .rotor = net_of_body(layout, w, comb->body_b),
                                       .stator = net_labelled(layout, w, e ? e->stator : NULL),
                                       .at = {(double)NAN, (double)NAN}};
                if (e) d->at = e->at;
                if (comb->body_a >= 0) d->stator = net_of_body(layout, w, comb->body_a);
            }
            d->low_V = fmin(d->low_V, low);
            d->high_V = fmax(d->high_V, high);
        }
    }
    return FW_OK;
}

/* what the air is like in which the drives of a flow have their voltages; a scene without <air> is in that of a room */
static void find_air(const fw_device *device, const char *flow, double density[2]) {
    const double room_K = 293.15;
    bool any = false;
    density[0] = density[1] = 1;
    for (int i = 0; i < device->nscene; i++) {
        const fw_device_scene *s = &device->scene[i];
        if (!fw_device_in_flow(s->flow, flow) || s->ncomb == 0) continue;
        for (int k = 0; k == 0 || k < s->nair; k++) {
            double now = 1;
            if (k < s->nair && !isnan(s->air[k].pressure_Pa))
                now = s->air[k].pressure_Pa / FW_STANDARD_ATMOSPHERE_Pa;
            if (k < s->nair && !isnan(s->air[k].temperature_K))
                now *= room_K / s->air[k].temperature_K;
            density[0] = any ? fmin(density[0], now) : now;
            density[1] = any ? fmax(density[1], now) : now;
            any = true;
        }
    }
}

static fw_status ask_drives(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                            const fw_wiring_asked *asked, fw_wiring *w) {
    size_t most = 0;
    const fw_layout_electrode **plan;
    for (int i = 0; i < device->nscene; i++)
        most += (size_t)device->scene[i].ncomb;
    FW_NEED(w->drive = fw_arena_array(arena, fw_wiring_drive, most));
    FW_NEED(plan = fw_arena_array(arena, const fw_layout_electrode *, most));
    FW_TRY(collect_drives(device, layout, asked->flow, w, plan));
    find_air(device, asked->flow, w->density);
    for (int i = 0; i < w->ndrive; i++) {
        const fw_wiring_drive *d = &w->drive[i];
        if (d->rotor < 0 || d->stator < 0 || d->rotor == d->stator) continue;
        widen(&w->net[d->rotor], 0.0, 0.0);
        widen(&w->net[d->stator], d->low_V, d->high_V);
    }
    bool edge = false;
    for (int i = 0; i < layout->nelectrode; i++)
        edge = edge || layout->electrode[i].routed;
    for (int i = 0; i < w->nnet; i++)
        if (w->net[i].needed || w->net[i].kind == FW_WIRING_STATOR)
            FW_TRY(find_pad(arena, layout, w, i, edge, &w->net[i]));
    for (int i = 0; i < w->ndrive; i++) {
        FW_TRY(judge_drive(arena, w, plan[i], &w->drive[i]));
        if (w->drive[i].fault == FW_WIRING_NOT_DRAWN) /* added by hand it may work all the same */
            FW_TRY(fw_wiring_say(arena, &w->open, &w->nopen, w->drive[i].why));
        else if (w->drive[i].why)
            FW_TRY(fw_wiring_say(arena, &w->refusal, &w->nrefusal, w->drive[i].why));
    }
    for (int i = 0; i < w->nnet; i++)
        if (w->net[i].kind == FW_WIRING_STATOR && !w->net[i].needed)
            FW_TRY(fw_wiring_say(arena, &w->remark, &w->nremark,
                                 fw_arena_printf(arena,
                                                 "the pad of %s is needed by no scene of this flow",
                                                 w->net[i].name)));
    return FW_OK;
}

/* ---- all of it ---- */

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
    FW_TRY(ask_drives(arena, device, layout, asked, w));
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
