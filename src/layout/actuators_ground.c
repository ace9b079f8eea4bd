/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eyelets on base and frame, and the pieces of all that moves the device. */
#include "geometry/segment.h"
#include "layout/draw.h"
#include "layout/text.h"
#include <math.h>

/* ---- on the ground ---- */

static fw_status avoid(fw_drawing *d, const fw_contour *c) {
    FW_NEED(d->lug = fw_arena_grow(d->arena, d->lug, (size_t)d->nlug, (size_t)d->nlug + 1,
                                   sizeof *d->lug));
    d->lug[d->nlug++] = *c;
    return FW_OK;
}

/* metres from a ring's centre to the frame; 0: over it */
static double to_frame(const fw_drawing *d, fw_vec2 p) {
    const fw_box *w = &d->layout->window;
    return fmax(0.0, fmin(fmin(p.x - w->x0, w->x1 - p.x), fmin(p.y - w->y0, w->y1 - p.y)));
}

/* the base that is nearest and nearer than the frame; -1: the frame */
static int base_of(const fw_drawing *d, fw_vec2 at) {
    double least = to_frame(d, at);
    int best = -1;
    for (int s = d->device->nbody; s < d->nslot && least > 0.0; s++) {
        if (d->plain[s].count == 0) continue;
        double far = HUGE_VAL, t;
        fw_vec2 on;
        for (int i = 0; i < d->plain[s].count; i++)
            far = fmin(far, fw_segment_nearest(&d->plain[s].segment[i], at, &t, &on));
        if (fw_contour_contains(&d->plain[s], at)) far = 0.0;
        if (far > least) continue;
        least = far;
        best = s;
    }
    return best;
}

static const char across[] = "it lies across the cut between base and frame";

/* does a ring on the frame reach a base? */
static bool near_base(const fw_drawing *d, const fw_eyelet_plan *e) {
    double reach = 0.5 * e->hole_m + e->ring_m + FW_LEAST_SPACE_M, t;
    fw_vec2 on;
    for (int s = d->device->nbody; s < d->nslot; s++)
        for (int i = 0; i < d->plain[s].count; i++)
            if (fw_segment_nearest(&d->plain[s].segment[i], e->at, &t, &on) < reach) return true;
    return false;
}

fw_status fw_actuators_on_base(fw_drawing *d) {
    for (int i = 0; i < d->neyelet; i++) {
        fw_eyelet_plan *e = &d->eyelet[i];
        fw_contour disc;
        if (e->off) continue;
        FW_TRY(fw_contour_disc(d->arena, e->at, 0.5 * e->hole_m + e->ring_m, &disc));
        FW_TRY(avoid(d, &disc));
        if (e->cap.count > 0) FW_TRY(avoid(d, &e->cap));
        int slot = e->eyelet->body == FW_GROUND ? base_of(d, e->at) : -1;
        e->on_frame = e->eyelet->body == FW_GROUND && slot < 0;
        if (slot >= 0 && to_frame(d, e->at) < 0.5 * e->hole_m + e->ring_m + FW_LEAST_SPACE_M) {
            fw_eyelet_off(d, e, across);
            continue;
        }
        if (slot >= 0) FW_TRY(fw_eyelet_add(d, slot, FW_GROUND, e, &d->raw[slot]));
    }
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off) FW_TRY(avoid(d, &d->comb[i].stator));
    return FW_OK;
}

static bool outside(const fw_drawing *d, const fw_eyelet_plan *e) {
    const fw_box die = d->layout->die;
    double rim = d->lane_m + 0.5 * e->hole_m + e->ring_m;
    return e->at.x < die.x0 + rim || e->at.x > die.x1 - rim || e->at.y < die.y0 + rim ||
           e->at.y > die.y1 - rim;
}

/* rings whose centre is over a half of the frame, or nearest to it, before it is rounded */
fw_status fw_actuators_on_frame(fw_drawing *d, fw_contour *raw) {
    fw_box half = fw_contour_box(raw);
    for (int i = 0; i < d->neyelet; i++) {
        fw_eyelet_plan *e = &d->eyelet[i];
        if (e->off || !e->on_frame || e->cap.count > 0) continue;
        if (outside(d, e)) {
            fw_eyelet_off(d, e, "it lies outside of the frame");
            continue;
        }
        if (e->at.y < half.y0 || e->at.y > half.y1) continue;
        if (near_base(d, e)) {
            fw_eyelet_off(d, e, across);
            continue;
        }
        fw_contour open = *raw;
        const char *why;
        double before;
        FW_TRY(fw_frame_soundness(d, raw, &before));
        FW_TRY(fw_eyelet_fit(d, -1, FW_GROUND, e, before, &open, &why));
        if (why)
            fw_eyelet_off(d, e, why);
        else
            *raw = open;
    }
    return FW_OK;
}

/* ---- pieces ---- */

static fw_status add_cap(fw_drawing *d, const fw_eyelet_plan *e) {
    const char *label =
        fw_arena_printf(d->arena, "ring of tendon %s", e->tendon->id ? e->tendon->id : "");
    return fw_drawing_add(d, e->on_frame ? FW_ROLE_FRAME : FW_ROLE_STRUCTURE, e->eyelet->body,
                          FW_NONE, label, &e->cap);
}

static void say_masses(fw_drawing *d) {
    for (int b = 0; b < d->device->nbody && !d->said; b++) {
        const fw_body *body = &d->device->body[b];
        bool drawn = false;
        for (int i = 0; i < d->ncomb; i++)
            drawn = drawn || (!d->comb[i].off && d->comb[i].comb->body_b == b);
        for (int i = 0; i < d->neyelet; i++)
            drawn = drawn || (!d->eyelet[i].off && d->eyelet[i].eyelet->body == b);
        if (drawn && !isnan(body->mass_kg))
            fw_diag_note(d->diags, 255, body->place,
                         "body %s states its mass, which holds as it is: electrodes and rings that "
                         "are drawn on it add nothing; leave mass and inertia out to have them "
                         "counted",
                         body->id);
    }
}

fw_status fw_actuators_add(fw_drawing *d) {
    for (int i = 0; i < d->neyelet; i++) {
        const fw_eyelet_plan *e = &d->eyelet[i];
        if (!e->off && e->cap.count > 0) FW_TRY(add_cap(d, e));
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_comb_plan *p = &d->comb[i];
        if (p->off) continue;
        const char *id = p->comb->id ? p->comb->id : "(unnamed)",
                   *label = fw_arena_printf(d->arena, "stator of comb drive %s", id);
        FW_TRY(fw_drawing_add(d, FW_ROLE_STRUCTURE, FW_ISLAND, FW_NONE, label, &p->stator));
    }
    say_masses(d);
    return FW_OK;
}

static bool apart(fw_box a, fw_box b) {
    return a.x1 < b.x0 || b.x1 < a.x0 || a.y1 < b.y0 || b.y1 < a.y0;
}

/* the letters of the pads come, those under a ring in the frame go */
fw_status fw_actuators_letters(fw_drawing *d) {
    fw_layout *l = d->layout;
    for (int i = 0; i < d->neyelet; i++) {
        const fw_eyelet_plan *e = &d->eyelet[i];
        double r = 0.5 * e->hole_m + 10e-6;
        fw_box box = {e->at.x - r, e->at.y - r, e->at.x + r, e->at.y + r};
        int kept = 0, gone = 0;
        if (e->off || e->eyelet->body != FW_GROUND || e->cap.count == 0) continue;
        for (int k = 0; k < l->npiece; k++) {
            fw_role role = l->piece[k].role;
            if ((role == FW_ROLE_TEXT || role == FW_ROLE_MARK) &&
                (!apart(fw_contour_box(&l->piece[k].contour), box) ||
                 !apart(fw_contour_box(&l->piece[k].contour), fw_contour_box(&e->cap))))
                gone++;
            else
                l->piece[kept++] = l->piece[k];
        }
        l->npiece = kept;
        if (gone > 0 && !d->said)
            fw_diag_warning(
                d->diags, 258, e->eyelet->place,
                "this eyelet is where the frame has lettering or a mark; %d polygons of "
                "that are left out: move the eyelet to have them whole",
                gone);
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_comb_plan *p = &d->comb[i];
        if (p->off) continue;
        int first = l->npiece;
        FW_TRY(fw_layout_text(d->arena, p->letter, p->letter_at, 45e-6, 5e-6, FW_ROLE_TEXT,
                              "lettering of a bond pad", &l->piece, &l->npiece, &d->capacity));
        for (int k = first; k < l->npiece; k++)
            l->piece[k].body = FW_ISLAND;
    }
    return FW_OK;
}
