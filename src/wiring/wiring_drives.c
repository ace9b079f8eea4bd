/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the actuators ask of the nets: a potential between rotor and stator, and a contact on both.

   The range of a drive's voltage is V times that of its law: up to its largest size, 0 included, and below 0
   only where the law may be negative. A contact is the largest square on a part that is held, INSET_M clear
   of its edges and of lettering; a probe or a wire needs LEAST_M. Theory: docs/theory/wiring.md. Test:
   test_wiring_drives.c */
#include "base/text.h"
#include "quantity/law_kind.h"
#include "release/release_cavity.h"
#include "wiring/wiring_nets.h"
#include <math.h>
#include <stdio.h>

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
static fw_status judge(fw_arena *arena, const fw_wiring *w, const fw_layout_electrode *e,
                       fw_wiring_drive *d) {
    char at[80];
    const char *stator = e ? e->stator : NULL;
    if (!e || (!stator && d->comb->body_a < 0)) {
        d->fault = FW_WIRING_NOT_DRAWN;
        FW_NEED(
            d->why = fw_arena_printf(
                arena,
                "comb drive %s is not on the mask, so that nothing of what the scenes ask of it "
                "can be made: %s. Move it, or leave it out of the scenes of this flow",
                d->id, e && e->why_not ? e->why_not : "nothing is drawn for it"));
    } else if (d->comb->body_a >= 0 || d->rotor == d->stator || d->stator < 0) {
        d->fault = FW_WIRING_SHORTED;
        FW_NEED(d->why = fw_arena_printf(
                    arena,
                    "comb drive %s is shorted: its rotor and its stator are one net%s%s%s, at %s. "
                    "%s",
                    d->id, d->rotor >= 0 ? " (" : "", d->rotor >= 0 ? w->net[d->rotor].name : "",
                    d->rotor >= 0 ? ")" : "", place(at, d->at),
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
                "comb drive %s has no contact for its %s: %s at %s has no square of 80 um, 10 "
                "um clear of its edges and of lettering, on a part that is held. Make a base or "
                "its pad wider",
                d->id, side ? "stator" : "rotor", net >= 0 ? w->net[net].name : "its net",
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

static fw_status collect(const fw_device *device, const fw_layout *layout, const char *flow,
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
                                       .id = comb->id ? comb->id : "(unnamed)",
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

fw_status fw_wiring_drives(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                           const fw_wiring_asked *asked, fw_wiring *w) {
    size_t most = 0;
    const fw_layout_electrode **plan;
    for (int i = 0; i < device->nscene; i++)
        most += (size_t)device->scene[i].ncomb;
    FW_NEED(w->drive = fw_arena_array(arena, fw_wiring_drive, most));
    FW_NEED(plan = fw_arena_array(arena, const fw_layout_electrode *, most));
    FW_TRY(collect(device, layout, asked->flow, w, plan));
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
        FW_TRY(judge(arena, w, plan[i], &w->drive[i]));
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
