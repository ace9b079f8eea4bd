/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What moves the device: eyelets of tendons and electrodes of comb drives become part of the
   drawing, as far as nothing is in their way. What cannot be drawn is left out whole and said
   (FW-D131); the motion has it all the same, so that the device is rejected. */
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

enum { SETTLING = 20 };
static const double SETTLED_M = 1e-12;
static const double STEM_MOST_M = 1e-3, STEM_STEP_M = 5e-6; /* behind an electrode, to its body */
static const double STEM_INSIDE_M = 20e-6;                  /* at both of its ends */
static const double RING_CLEAR_M = 10e-6;                   /* of letters from an eyelet's hole */
static const double LETTER_M = 45e-6, STROKE_M = 5e-6;      /* on bond pads, as on the frame */

/* ---- collecting ---- */

static void plan_tendon(fw_layout_drawing *d, const fw_device_tendon *t) {
    for (int k = 0; k < t->neyelet; k++) {
        const fw_device_eyelet *e = &t->eyelet[k];
        bool there = false;
        for (int i = 0; i < d->neyelet && !there; i++)
            there = fw_layout_same_eyelet(d->eyelet[i].eyelet, e);
        if (!there)
            d->eyelet[d->neyelet++] =
                (fw_layout_eyelet_plan){.tendon = t,
                                        .eyelet = e,
                                        .at = fw_v(e->x_m, e->y_m),
                                        .hole_m = e->hole_m > 0.0 ? e->hole_m : FW_EYELET_HOLE_M,
                                        .ring_m = e->ring_m > 0.0 ? e->ring_m : FW_EYELET_RING_M};
    }
}

static void plan_comb(fw_layout_drawing *d, const fw_device_comb *c) {
    for (int i = 0; i < d->ncomb; i++)
        if (fw_device_same_comb(d->comb[i].comb, c)) {
            d->comb[i].at_edge = d->comb[i].at_edge || c->pad_at_edge;
            return;
        }
    double length = c->length_m;
    if (isnan(length)) length = 2.0 * c->overlap_m;
    d->comb[d->ncomb++] = (fw_layout_comb_plan){.comb = c,
                                                .at_edge = c->pad_at_edge,
                                                .width_m = fw_device_comb_width_m(c),
                                                .length_m = length};
}

fw_status fw_layout_actuators_plan(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    size_t neyelet = 0, ncomb = 0;
    for (int i = 0; i < device->nscene; i++) {
        const fw_device_scene *s = &device->scene[i];
        ncomb += (size_t)s->ncomb;
        for (int t = 0; t < s->ntendon; t++)
            neyelet += (size_t)s->tendon[t].neyelet;
    }
    if (neyelet + ncomb == 0) return FW_OK;
    FW_NEED(d->eyelet = fw_arena_array(d->arena, fw_layout_eyelet_plan, neyelet));
    FW_NEED(d->comb = fw_arena_array(d->arena, fw_layout_comb_plan, ncomb));
    for (int i = 0; i < device->nscene; i++) {
        const fw_device_scene *s = &device->scene[i];
        for (int t = 0; t < s->ntendon; t++)
            plan_tendon(d, &s->tendon[t]);
        for (int c = 0; c < s->ncomb; c++)
            plan_comb(d, &s->comb[c]);
    }
    FW_NEED(d->bare = fw_arena_array(d->arena, fw_geometry_contour, (size_t)device->nbody));
    return FW_OK;
}

/* ---- saying ---- */

static fw_status eyelet_off(fw_layout_drawing *d, fw_layout_eyelet_plan *e, const char *why) {
    const char *of = fw_text_name(e->tendon->id);
    e->off = true;
    e->cap.count = 0;
    return fw_layout_missing_add(
        d, (fw_layout_missing){
               .number = 131,
               .eyelet = e->eyelet,
               .body = e->eyelet->body,
               .name = fw_arena_printf(d->arena, "eyelet of %s%s", FW_NAMED("tendon", of)),
               .at = e->at,
               .place = e->eyelet->place,
               .why = why});
}

static fw_status comb_off(fw_layout_drawing *d, fw_layout_comb_plan *p, const char *why) {
    const char *id = fw_text_name(p->comb->id);
    p->off = true;
    p->why = why;
    p->rotor.count = p->stator.count = 0;
    return fw_layout_missing_add(
        d,
        (fw_layout_missing){.number = 131,
                            .comb = p->comb,
                            .body = p->comb->body_b,
                            .name = fw_arena_printf(d->arena, "%s%s", FW_NAMED("comb drive", id)),
                            .at = p->local.origin,
                            .place = p->comb->place,
                            .why = why});
}

/* ---- bodies ---- */

/* pose of a body as drawn: where the file does not say, its outline's centroid */
static fw_geometry_vec2 centre_of(const fw_layout_drawing *d, int body) {
    const fw_device_body *b = &d->device->body[body];
    fw_geometry_vec2 c = d->layout->body[body].centroid;
    return fw_v(isnan(b->x_m) ? c.x : b->x_m, isnan(b->y_m) ? c.y : b->y_m);
}

static fw_geometry_vec2 placed(const fw_layout_drawing *d, int body, double x, double y) {
    if (body < 0) return fw_v(x, y);
    fw_layout_local l = {centre_of(d, body), cos(d->device->body[body].phi_rad),
                         sin(d->device->body[body].phi_rad), false};
    return fw_layout_local_point(&l, fw_v(x, y));
}

static void place_all(fw_layout_drawing *d, int body) {
    for (int i = 0; i < d->neyelet; i++) {
        const fw_device_eyelet *e = d->eyelet[i].eyelet;
        if (e->body == body) d->eyelet[i].at = placed(d, body, e->x_m, e->y_m);
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_device_comb *c = d->comb[i].comb;
        double turn = c->direction_rad;
        if (c->body_b != body) continue;
        if (c->body_a >= 0) turn += d->device->body[c->body_a].phi_rad;
        double cosine = cos(turn), sine = sin(turn); /* axes are axes to the last bit */
        if (fabs(sine) < 1e-12) sine = 0.0, cosine = cosine < 0.0 ? -1.0 : 1.0;
        if (fabs(cosine) < 1e-12) cosine = 0.0, sine = sine < 0.0 ? -1.0 : 1.0;
        d->comb[i].local =
            (fw_layout_local){placed(d, body, c->bx_m, c->by_m), cosine, sine, false};
    }
}

/* every cut of `before` is one of `after`, bit for bit */
static bool keeps_joints(const fw_geometry_contour *before, const fw_geometry_contour *after) {
    for (int i = 0; i < before->count; i++) {
        const fw_geometry_segment *s = &before->segment[i];
        bool there = !(s->flags & FW_SEGMENT_JOINT);
        for (int k = 0; k < after->count && !there; k++)
            there = after->segment[k].flags & FW_SEGMENT_JOINT &&
                    vec_same(after->segment[k].a, s->a) && vec_same(after->segment[k].b, s->b);
        if (!there) return false;
    }
    return true;
}

/* Rounded without a word, and no worse for a mask than the outline before, whose soundness *sound is; else not *good,
   and what was there stays, and *sound with it. */
static fw_status rounds(fw_layout_drawing *d, int slot, int body, const fw_geometry_contour *raw,
                        double *sound, bool *good) {
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    fw_geometry_contour plain;
    fw_geometry_vec2 where;
    d->diags = &unsaid;
    fw_status status = fw_layout_body_round(d, body, raw, &plain, &d->corner_m[slot], &where);
    d->diags = said;
    const double now = status == FW_OK ? fw_layout_body_soundness(&plain, &where) : 0.0;
    *good = status == FW_OK && now > 0.95 * *sound;
    if (*good && *sound > 0.0) FW_TRY(fw_layout_takes_bias(d->arena, &plain, now, good));
    if (*good) d->plain[slot] = plain, *sound = fmin(1.0, now);
    return status == FW_GEOMETRY ? FW_OK : status;
}

/* the rotor's electrode, and a stem behind it where its bar does not reach the body */
static fw_status add_rotor(fw_layout_drawing *d, fw_layout_comb_plan *p, fw_geometry_contour *raw,
                           const char **why) {
    fw_geometry_vec2 u = fw_v(p->local.c, p->local.s), back;
    fw_geometry_region all = {raw, 1}, add, both = {NULL, 0};
    double root =
        p->comb->kind == FW_ELECTRODES_COMB ? p->length_m - 0.5 * p->comb->overlap_m : 0.0;
    const char *what;
    *why = NULL;
    FW_TRY(fw_layout_comb_rotor(d->arena, p, &p->rotor));
    FW_TRY(fw_layout_actuator_crosses(d, &p->rotor, p->comb->body_b, fw_layout_rule.least_space_m,
                                      (int)(p - d->comb), &what));
    if (what) {
        FW_NEED(*why = fw_arena_printf(d->arena, "its rotor would cross or nearly touch %s", what));
        return FW_OK;
    }
    add = (fw_geometry_region){&p->rotor, 1};
    fw_status status = fw_geometry_region_boolean(d->arena, &all, &add, FW_UNION, &both);
    for (double s = 0.0; status == FW_OK && both.count != 1 && s < STEM_MOST_M; s += STEM_STEP_M) {
        fw_geometry_contour stem;
        back = fw_add(p->local.origin, -root - STEM_INSIDE_M, u);
        if (!fw_geometry_contour_contains(raw, fw_add(back, -s, u))) continue;
        FW_TRY(fw_geometry_contour_bar(d->arena, back, fw_add(back, -s - STEM_INSIDE_M, u),
                                       fw_layout_rule.neck_width_m, &stem));
        FW_TRY(fw_layout_actuator_crosses(d, &stem, p->comb->body_b, fw_layout_rule.least_space_m,
                                          (int)(p - d->comb), &what));
        if (what) break;
        fw_geometry_region way = {&stem, 1};
        fw_geometry_region parts = both;
        status = fw_geometry_region_boolean(d->arena, &parts, &way, FW_UNION, &both);
        break;
    }
    if (status == FW_OK && both.count == 1 && keeps_joints(raw, &both.contour[0]))
        *raw = both.contour[0];
    else if (status == FW_OK || status == FW_GEOMETRY)
        *why = "its rotor and its body do not make one outline, not even with a stem of up to 1 mm "
               "straight behind the electrode";
    return status == FW_GEOMETRY ? FW_OK : status;
}

static double soundness_now(const fw_layout_drawing *d, int slot) {
    fw_geometry_vec2 where;
    return fmin(1.0, fw_layout_body_soundness(&d->plain[slot], &where));
}

/* soundness of a half of the frame as it will be rounded; 0: it cannot be */
static fw_status frame_soundness(fw_layout_drawing *d, const fw_geometry_contour *raw,
                                 double *sound) {
    fw_geometry_contour round;
    fw_geometry_vec2 where;
    fw_status status =
        fw_geometry_contour_round(d->arena, raw, 0.0, fw_layout_rule.corner_m, &round, &where);
    *sound = status == FW_OK ? fmin(1.0, fw_layout_body_soundness(&round, &where)) : 0.0;
    bool good = true;
    if (status == FW_OK) FW_TRY(fw_layout_takes_bias(d->arena, &round, 0.0, &good));
    if (!good) *sound = 0.0;
    return status == FW_GEOMETRY ? FW_OK : status;
}

/* Ring and hole on an outline; *why set: they cannot be there. Where a ring's edge nearly coincides
   with another the outline would get a step that no mask can show; then the ring is made wider.
   slot -1: a half of the frame. *least: soundness of the outline before; with the ring, that of what is there now. */
static fw_status eyelet_fit(fw_layout_drawing *d, int slot, int body, fw_layout_eyelet_plan *e,
                            double *least, fw_geometry_contour *raw, const char **why) {
    static const double wider_m[] = {0.0, 6e-6, 12e-6, 18e-6, 25e-6};
    const char *first = NULL;
    for (; e->wider < (int)(sizeof wider_m / sizeof wider_m[0]); e->wider++) {
        fw_geometry_contour ringed, open;
        fw_layout_eyelet_plan ring = *e;
        double sound = 0.0;
        bool good = false;
        ring.ring_m += wider_m[e->wider];
        FW_TRY(fw_layout_eyelet_ring(d, &ring, body, raw, &ringed, why));
        if (!*why) FW_TRY(fw_layout_eyelet_hole(d, e, &ringed, &open, &e->cap, why));
        if (!*why && !keeps_joints(raw, &open))
            *why = "its ring would cover the cut between two pieces";
        if (!*why && slot >= 0) FW_TRY(rounds(d, slot, body, &open, least, &good));
        if (!*why && slot < 0) {
            FW_TRY(frame_soundness(d, &open, &sound));
            good = sound > 0.95 * *least;
        }
        if (good) {
            *raw = open;
            return FW_OK;
        }
        if (!*why)
            *why = "between its ring and what carries it there would be steps or slits that no "
                   "mask shows";
        if (!first) first = *why;
    }
    *why = first ? first : "its ring does not fit";
    return FW_OK;
}

/* the same; where it cannot be, the eyelet is given up and that is said */
static fw_status eyelet_add(fw_layout_drawing *d, int slot, int body, fw_layout_eyelet_plan *e,
                            double *sound, fw_geometry_contour *raw) {
    const char *why;
    FW_TRY(eyelet_fit(d, slot, body, e, sound, raw, &why));
    return why ? eyelet_off(d, e, why) : FW_OK;
}

/* a rotor on an outline that is rounded already; where it cannot be, the drive is given up. *last: what was rounded
   last is the outline that is kept */
static fw_status dress_with_rotor(fw_layout_drawing *d, int body, fw_layout_comb_plan *p,
                                  double *sound, fw_geometry_contour *raw, bool *last) {
    fw_geometry_contour with = *raw;
    const char *why;
    bool good = false;
    FW_TRY(add_rotor(d, p, &with, &why));
    if (!why) {
        FW_TRY(rounds(d, body, body, &with, sound, &good));
        *last = good;
        if (!good) FW_TRY(fw_layout_rotor_flaw(d, body, p, &with, &why));
        if (!good && !why)
            why = "between its rotor and its body there would be steps or slits that no mask shows";
    }
    if (why) return comb_off(d, p, why);
    *raw = with;
    return FW_OK;
}

/* body as it was before, then everything on it that can be drawn; one pass for the poses that hold
   now */
static fw_status dress(fw_layout_drawing *d, int body) {
    fw_geometry_contour raw = d->bare[body];
    double sound = 0.0, any = 0.0;
    bool good, last = true;
    FW_TRY(rounds(d, body, body, &raw, &sound, &good));
    if (!good) sound = soundness_now(d, body);
    place_all(d, body);
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off && d->comb[i].comb->body_b == body)
            FW_TRY(dress_with_rotor(d, body, &d->comb[i], &sound, &raw, &last));
    for (int i = 0; i < d->neyelet; i++) {
        fw_layout_eyelet_plan *e = &d->eyelet[i];
        if (e->off || e->eyelet->body != body) continue;
        FW_TRY(eyelet_add(d, body, body, e, &sound, &raw));
        last = !e->off;
    }
    d->raw[body] = raw;
    return last ? FW_OK : rounds(d, body, body, &raw, &any, &good);
}

/* with the caps of its eyelets */
static fw_status measure(fw_layout_drawing *d, int body) {
    fw_geometry_contour *cap;
    int n = 0;
    FW_NEED(cap = fw_arena_array(d->arena, fw_geometry_contour, (size_t)d->neyelet));
    for (int i = 0; i < d->neyelet; i++) {
        const fw_layout_eyelet_plan *e = &d->eyelet[i];
        if (!e->off && e->eyelet->body == body && e->cap.count > 0) cap[n++] = e->cap;
    }
    return fw_layout_body_measure(d, body, cap, n);
}

static bool carries(const fw_layout_drawing *d, int body) {
    for (int i = 0; i < d->ncomb; i++)
        if (d->comb[i].comb->body_b == body) return true;
    return fw_layout_eyelets_on(d, body);
}

/* Points are given from the centre of mass, which moves with what is added at them: the drawing is
   repeated until it stands. Each round leaves the share of the added mass (a few per cent) of the
   last shift; 1e-12 m after about six. */
static fw_status dress_until_still(fw_layout_drawing *d, int body) {
    for (int round = 0; round < SETTLING; round++) {
        fw_geometry_vec2 before = centre_of(d, body);
        FW_TRY(dress(d, body));
        FW_TRY(measure(d, body));
        if (fw_norm(fw_sub(centre_of(d, body), before)) < SETTLED_M) break;
    }
    return FW_OK;
}

fw_status fw_layout_actuators_draw(fw_layout_drawing *d) {
    for (int b = 0; b < d->device->nbody && d->bare; b++)
        if (d->bare[b].count == 0) d->bare[b] = d->raw[b];
    for (bool again = d->bare != NULL; again;) {
        again = false;
        for (int b = 0; b < d->device->nbody; b++)
            if (carries(d, b)) FW_TRY(dress_until_still(d, b));
        for (int i = 0; i < d->ncomb; i++) {
            const char *why;
            if (d->comb[i].off) continue;
            FW_TRY(fw_layout_stator_place(d, &d->comb[i], &why));
            if (!why) continue;
            FW_TRY(comb_off(d, &d->comb[i], why));
            again = true; /* its rotor goes, too */
        }
    }
    return FW_OK;
}

/* ---- stators ---- */

fw_status fw_layout_stators_drop(fw_layout_drawing *d, const char *why) {
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off) FW_TRY(comb_off(d, &d->comb[i], why));
    return FW_OK;
}

/* Eyelets on base and frame, and the pieces of all that moves the device. */

/* ---- on the ground ---- */

static fw_status avoid(fw_layout_drawing *d, const fw_geometry_contour *c) {
    FW_NEED(d->lug = fw_arena_grow(d->arena, d->lug, (size_t)d->nlug, (size_t)d->nlug + 1,
                                   sizeof *d->lug));
    d->lug[d->nlug++] = *c;
    return FW_OK;
}

/* metres from a ring's centre to the frame; 0: over it */
static double to_frame(const fw_layout_drawing *d, fw_geometry_vec2 p) {
    const fw_geometry_box *w = &d->layout->window;
    return fmax(0.0, fmin(fmin(p.x - w->x0, w->x1 - p.x), fmin(p.y - w->y0, w->y1 - p.y)));
}

/* the base that is nearest and nearer than the frame; -1: the frame */
static int base_of(const fw_layout_drawing *d, fw_geometry_vec2 at) {
    double least = to_frame(d, at);
    int best = -1;
    for (int s = d->device->nbody; s < d->nslot && least > 0.0; s++) {
        if (d->plain[s].count == 0) continue;
        double far = HUGE_VAL, t;
        fw_geometry_vec2 on;
        for (int i = 0; i < d->plain[s].count; i++)
            far = fmin(far, fw_geometry_segment_nearest(&d->plain[s].segment[i], at, &t, &on));
        if (fw_geometry_contour_contains(&d->plain[s], at)) far = 0.0;
        if (far > least) continue;
        least = far;
        best = s;
    }
    return best;
}

static const char across[] = "it lies across the cut between base and frame";

/* does a ring on the frame reach a base? */
static bool near_base(const fw_layout_drawing *d, const fw_layout_eyelet_plan *e) {
    double reach = 0.5 * e->hole_m + e->ring_m + fw_layout_rule.least_space_m, t;
    fw_geometry_vec2 on;
    for (int s = d->device->nbody; s < d->nslot; s++)
        for (int i = 0; i < d->plain[s].count; i++)
            if (fw_geometry_segment_nearest(&d->plain[s].segment[i], e->at, &t, &on) < reach)
                return true;
    return false;
}

fw_status fw_layout_actuators_on_base(fw_layout_drawing *d) {
    for (int i = 0; i < d->neyelet; i++) {
        fw_layout_eyelet_plan *e = &d->eyelet[i];
        fw_geometry_contour disc;
        if (e->off) continue;
        FW_TRY(fw_geometry_contour_disc(d->arena, e->at, 0.5 * e->hole_m + e->ring_m, &disc));
        FW_TRY(avoid(d, &disc));
        if (e->cap.count > 0) FW_TRY(avoid(d, &e->cap));
        int slot = e->eyelet->body == FW_GROUND ? base_of(d, e->at) : -1;
        e->on_frame = e->eyelet->body == FW_GROUND && slot < 0;
        if (slot >= 0 &&
            to_frame(d, e->at) < 0.5 * e->hole_m + e->ring_m + fw_layout_rule.least_space_m) {
            FW_TRY(eyelet_off(d, e, across));
            continue;
        }
        if (slot < 0) continue;
        double sound = soundness_now(d, slot);
        FW_TRY(eyelet_add(d, slot, FW_GROUND, e, &sound, &d->raw[slot]));
    }
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off) FW_TRY(avoid(d, &d->comb[i].stator));
    return FW_OK;
}

/* where the centre of a ring on the frame may be, short of its window; false: it is not there */
static fw_status outside(const fw_layout_drawing *d, const fw_layout_eyelet_plan *e,
                         const char **why) {
    const fw_geometry_box die = d->layout->die, w = d->layout->window;
    double rim = d->lane_m + 0.5 * e->hole_m + e->ring_m;
    char x0[32], x1[32], y0[32], y1[32], wx[32], wy[32];
    *why = NULL;
    if (e->at.x >= die.x0 + rim && e->at.x <= die.x1 - rim && e->at.y >= die.y0 + rim &&
        e->at.y <= die.y1 - rim)
        return FW_OK;
    FW_NEED(*why = fw_arena_printf(
                d->arena,
                "it lies outside of the frame, whose window is %s by %s um and where its ring has "
                "room for centres from x = %s to %s um and y = %s to %s um",
                fw_layout_um(wx, w.x1 - w.x0), fw_layout_um(wy, w.y1 - w.y0),
                fw_layout_um(x0, die.x0 + rim), fw_layout_um(x1, die.x1 - rim),
                fw_layout_um(y0, die.y0 + rim), fw_layout_um(y1, die.y1 - rim)));
    return FW_OK;
}

/* rings whose centre is over a half of the frame, or nearest to it, before it is rounded */
fw_status fw_layout_actuators_on_frame(fw_layout_drawing *d, fw_geometry_contour *raw) {
    fw_geometry_box half = fw_geometry_contour_box(raw);
    for (int i = 0; i < d->neyelet; i++) {
        fw_layout_eyelet_plan *e = &d->eyelet[i];
        if (e->off || !e->on_frame || e->cap.count > 0) continue;
        const char *beyond;
        FW_TRY(outside(d, e, &beyond));
        if (beyond) {
            FW_TRY(eyelet_off(d, e, beyond));
            continue;
        }
        if (e->at.y < half.y0 || e->at.y > half.y1) continue;
        if (near_base(d, e)) {
            FW_TRY(eyelet_off(d, e, across));
            continue;
        }
        fw_geometry_contour open = *raw;
        const char *why;
        double before;
        FW_TRY(frame_soundness(d, raw, &before));
        FW_TRY(eyelet_fit(d, -1, FW_GROUND, e, &before, &open, &why));
        if (why)
            FW_TRY(eyelet_off(d, e, why));
        else
            *raw = open;
    }
    return FW_OK;
}

/* ---- pieces ---- */

static fw_status add_cap(fw_layout_drawing *d, const fw_layout_eyelet_plan *e) {
    const char *label = fw_arena_printf(d->arena, "ring of %s%s",
                                        FW_NAMED("tendon", e->tendon->id ? e->tendon->id : ""));
    return fw_layout_drawing_add(d, e->on_frame ? FW_ROLE_FRAME : FW_ROLE_STRUCTURE,
                                 e->eyelet->body, FW_NONE, label, &e->cap);
}

static void report_masses(fw_layout_drawing *d) {
    for (int b = 0; b < d->device->nbody && !d->said; b++) {
        const fw_device_body *body = &d->device->body[b];
        bool drawn = false;
        for (int i = 0; i < d->ncomb; i++)
            drawn = drawn || (!d->comb[i].off && d->comb[i].comb->body_b == b);
        for (int i = 0; i < d->neyelet; i++)
            drawn = drawn || (!d->eyelet[i].off && d->eyelet[i].eyelet->body == b);
        if (drawn && !isnan(body->mass_kg))
            fw_diag_note(d->diags, 255, body->place,
                         "%s%s states its mass, which holds as it is: electrodes and rings that "
                         "are drawn on it add nothing; leave mass and inertia out to have them "
                         "counted",
                         FW_NAMED("body", body->id));
    }
}

fw_status fw_layout_actuators_add(fw_layout_drawing *d) {
    fw_layout_electrode *electrode =
        fw_arena_array(d->arena, fw_layout_electrode, (size_t)d->ncomb);
    FW_NEED(electrode);
    d->layout->electrode = electrode;
    d->layout->nelectrode = d->ncomb;
    for (int i = 0; i < d->neyelet; i++) {
        const fw_layout_eyelet_plan *e = &d->eyelet[i];
        if (!e->off && e->cap.count > 0) FW_TRY(add_cap(d, e));
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_layout_comb_plan *p = &d->comb[i];
        electrode[i] =
            (fw_layout_electrode){.comb = p->comb, .why_not = p->why, .at = p->local.origin};
        if (p->off) continue;
        const char *id = fw_text_name(p->comb->id),
                   *label = fw_arena_printf(d->arena, "stator of %s%s", FW_NAMED("comb drive", id));
        FW_NEED(label);
        electrode[i].stator = label;
        electrode[i].routed = p->routed;
        electrode[i].edge_pad = p->edge_pad;
        FW_TRY(fw_layout_drawing_add(d, FW_ROLE_STRUCTURE, FW_ISLAND, FW_NONE, label, &p->stator));
    }
    report_masses(d);
    return FW_OK;
}

static bool apart(fw_geometry_box a, fw_geometry_box b) {
    return a.x1 < b.x0 || b.x1 < a.x0 || a.y1 < b.y0 || b.y1 < a.y0;
}

/* the letters of the pads come, those under a ring in the frame go */
fw_status fw_layout_actuators_letters(fw_layout_drawing *d) {
    fw_layout *l = d->layout;
    for (int i = 0; i < d->neyelet; i++) {
        const fw_layout_eyelet_plan *e = &d->eyelet[i];
        double r = 0.5 * e->hole_m + RING_CLEAR_M;
        fw_geometry_box box = {e->at.x - r, e->at.y - r, e->at.x + r, e->at.y + r};
        int kept = 0, gone = 0;
        if (e->off || e->eyelet->body != FW_GROUND || e->cap.count == 0) continue;
        for (int k = 0; k < l->npiece; k++) {
            fw_layout_role role = l->piece[k].role;
            if ((role == FW_ROLE_TEXT || role == FW_ROLE_MARK) &&
                (!apart(fw_geometry_contour_box(&l->piece[k].contour), box) ||
                 !apart(fw_geometry_contour_box(&l->piece[k].contour),
                        fw_geometry_contour_box(&e->cap))))
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
        const fw_layout_comb_plan *p = &d->comb[i];
        if (p->off) continue;
        int first = l->npiece;
        FW_TRY(fw_layout_text(d->arena, p->letter, p->letter_at, LETTER_M, STROKE_M, FW_ROLE_TEXT,
                              "lettering of a bond pad", &l->piece, &l->npiece, &d->capacity));
        for (int k = first; k < l->npiece; k++)
            l->piece[k].body = FW_ISLAND;
    }
    return FW_OK;
}
