/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexures as they are instead of pins (the element is in hinge_element.c, the law in flexure/finite.c): the row, and its bound.
   How far the peaks of a mechanism with ideal pins are from those of one whose hinges give and
   drift. Two motions under the same loads are known up to their peaks (peaks.c): the linear one
   with pins (a), and the one with hinges as springs and with what of a hinge is not linear along it
   (b; hinge_source.c). To |peak a - peak b| is added, with u the nonlinearity estimate of the
   envelope:

     4 u (differences of what stands still, of the rings; rings of the modes that the hinges add)
                what is not linear does to both alike
     4 u (answer to the sources, 2 of the static one); as far as it is resonance times min(1, u w
   T/2) (2/|1 - (W/w)^2| for W = w_j, w_j +- w_k, at most w T/2) what the rings of the modes that
   the hinges add put on the sources: in step with them, off resonance; for good, as sizes phases
   frequencies shift, and rings of several modes or of later loads then meet at other times. The
   shift of one ring from the start only stretches time; others: their size times the shift of their
   phase between a and b, known to first order in the peaks (so times min(1, u w T/2): u is of
   stiffness)

   Inputs SI from the envelopes; outputs rad over the floor. Infinite where the hinges give at
   frequencies below twice those of the motion, or are drawn under stress. Valid as the envelope is.
   Cost: peaks.c three times, and modes times hinges at every instant. The nonlinearity estimates
   are tested, not proved. Source: docs/theory/effects/nonlinear-hinge.md. Test: test_hinge_give.c,
   test_hinge_bounds.c. */
#include "base/constants.h"
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "quantity/law_kind.h"
#include <math.h>

typedef struct work {
    const fw_effect_case *c;
    const fw_effects_envelope *a, *b; /* pinned, given */
    fw_effects_peaks pa, pb, pc;      /* linear ones; b with what is not linear of the hinges */
    fw_effects_hinge_sources sources;
    int slow; /* modes of a */
    double nonlinearity;
    double *swing;     /* (slow) sources: static |q| */
    double *ring;      /* (slow) static |q|, of what the fast rings add to them */
    double *rapid_rad; /* (npin) likewise in the modes beyond */
    double *overshoot; /* (slow) */
    double *phase;     /* (slow) w T, T the time over which its damping lets it count */
} work;

double fw_effects_hinge_give_most(const fw_effect_case *c, int pin) {
    enum { STEPS = 16 };
    const fw_effects_envelope *e = c->envelope;
    int hinge = c->mechanism->pin[pin].hinge;
    if (!e->pinned || hinge == FW_NONE || !fw_effects_hinge_is_known(&c->mechanism->hinge[hinge]))
        return e->give[pin];
    double angle = e->angle[pin] + fabs(fw_effects_pin_deflection(c->mechanism, pin)), drift = 0;
    for (int i = -STEPS; i <= STEPS; i++) {
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&c->mechanism->hinge[hinge].law, angle * i / STEPS, &at);
        drift = fmax(drift, fabs(at.drift_m.value));
    }
    return e->give[pin] + drift;
}

/* ---- what a product of two courses of the motion does to a mode ---- */

/* answer of a mode w, over the static one, to cos W t from rest */
static double answer(double modal_speed, double omega, double most) {
    double apart = fabs(1 - modal_speed / omega * (modal_speed / omega));
    return apart * most > 2 ? 2 / apart : most;
}

static double both(double j, double k, double omega, double most) {
    double x = fmax(answer(j + k, omega, most), answer(fabs(j - k), omega, most));
    /* with a constant; the mode's own course shifts its frequency: see phases */
    if (j != omega) x = fmax(x, answer(j, omega, most));
    if (k != omega) x = fmax(x, answer(k, omega, most));
    return fmax(2, x);
}

/* The mode's own course under constant loads: s + r cos(w t + f) times the same of another ratio
   has a constant and a wave of 2 w, which answer at most 2 s or 1.54 r of s + r; from rest r >= s
 */
static double alone(const work *w, int j) {
    double r = w->pb.ring[j], s = fmin(r, fmax(0, w->b->amplitude[j] - r));
    return r > 0 ? fmax(2 * s, 1.54 * r) / (s + r) : 2;
}

/* rad/s of a law that is a single wave, over and over; else 0 */
static double lasting_wave(const fw_quantity_law *law) {
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(law);
    return wave.repeats ? wave.rad_per_s : 0;
}

/* of a course that is no wave: by its variation */
static double restless(const fw_effects_modal_loads *p, int modes) {
    double most = 0;
    for (int i = 0; i < p->count; i++) {
        const fw_effects_modal_load *f = &p->item[i];
        if (!f->element && (fw_quantity_law_is_constant(f->law) || lasting_wave(f->law) > 0))
            continue;
        for (int j = 0; j < modes; j++)
            if (f->sup[j] > 0) most = fmax(most, f->sway[j] / f->sup[j]);
    }
    return most;
}

static fw_status overshoots(work *w, const fw_effects_modal_loads *p) {
    const fw_effects_envelope *e = w->b;
    int count = 0;
    double *modal_speed, *share, sum = 0, other = restless(p, w->slow);
    size_t most = (size_t)w->slow + (size_t)p->count;
    FW_NEED(modal_speed = fw_arena_array(w->c->arena, double, most));
    FW_NEED(share = fw_arena_array(w->c->arena, double, most));
    for (int j = 0; j < w->slow; j++, count++) {
        modal_speed[j] = e->omega[j];
        for (int i = 0; i < e->npin; i++)
            share[j] = fmax(share[j], fabs(e->turn[j * e->npin + i]) * e->amplitude[j]);
        sum += share[j];
    }
    for (int j = 0; j < w->slow; j++)
        share[j] /= sum;
    for (int i = 0; i < p->count; i++) {
        modal_speed[count] = lasting_wave(p->item[i].law);
        if (modal_speed[count] > 0) share[count++] = 1;
    }
    const bool constant = other == 0 && count == w->slow;
    for (int l = 0; l < w->slow; l++) {
        double cap = fmax(2, 0.5 * e->omega[l] * e->duration_s);
        for (int j = 0; j < count; j++)
            for (int k = 0; k < count; k++)
                w->overshoot[l] += share[j] * share[k] *
                                   (j == l && k == l && constant
                                        ? alone(w, l)
                                        : both(modal_speed[j], modal_speed[k], e->omega[l], cap));
        w->overshoot[l] += other > 0 ? fmin(cap, 2 * other) : 0;
    }
    return FW_OK;
}

/* ---- what fast rings add ---- */

/* their waves meet a slow mode off resonance: at a fast frequency, or that less one of the motion
 */
static double aside(const work *w, int l) {
    const fw_effects_envelope *e = w->b;
    double least = (e->omega[w->slow] - e->omega[w->slow - 1]) / e->omega[l];
    return least > 1 ? fmin(w->overshoot[l], 2 / (least * least - 1)) : w->overshoot[l];
}

static void add_rings(work *w) {
    const fw_effects_envelope *e = w->b;
    size_t pins = (size_t)e->npin;
    for (int i = 0; i < w->sources.count; i++)
        for (int k = 0; k < FW_HINGE_PARTS; k++) {
            const fw_effects_hinge_source *h = &w->sources.item[i];
            for (int l = 0; l < w->slow; l++)
                w->ring[l] += fabs(fw_effects_hinge_source_mode(h, k, l)) /
                              (e->omega[l] * e->omega[l]) *
                              (h->wave[k] * aside(w, l) + h->lasting[k] * w->overshoot[l]);
            for (size_t pin = 0; pin < pins; pin++) {
                double sum = 0;
                for (int l = w->slow; l < e->modes; l++)
                    sum += e->turn[(size_t)l * pins + pin] * fw_effects_hinge_source_mode(h, k, l) /
                           (e->omega[l] * e->omega[l]);
                w->rapid_rad[pin] += 2 * fabs(sum) * (h->wave[k] + h->lasting[k]);
            }
        }
}

/* ---- the sum ---- */

/* rings that may meet at other times, of pin i, where the ring d only stretches time */
static double phases(const work *w, int i, int d) {
    double sum = 0, pinned = w->a->omega[d], shift = fabs(pinned / w->b->omega[d] - 1);
    for (int l = 0; l < w->slow; l++) {
        double turn = fabs(w->b->turn[l * w->b->npin + i]), ring = w->pb.ring[l];
        double own = fabs(w->a->omega[l] / w->b->omega[l] - w->a->omega[d] / w->b->omega[d]);
        double late = fmin(ring, w->pb.late[l]), loose = l == d ? late : ring;
        double known = fmin(1, 0.5 * w->nonlinearity * w->phase[l]);
        if (ring > 0) own += 0.5 * w->swing[l] / ring;
        sum += turn * known *
               (loose * fmin(2, own * w->phase[l]) + late * fmin(2, shift * w->phase[l]));
    }
    return sum;
}

static double apart(const work *w, int i) {
    const fw_effects_peaks *a = &w->pa, *b = &w->pb, *c = &w->pc;
    double bracket = fmax(a->high[i] - c->low[i], c->high[i] - a->low[i]);
    double alike = fabs(a->still[i] - b->still[i]) + a->rapid_rad[i] + b->rapid_rad[i];
    double sources = 2 * w->sources.rapid_rad[i], least = (double)INFINITY, open = w->rapid_rad[i];
    for (int l = 0; l < w->slow; l++) {
        double ta = fabs(w->a->turn[l * w->a->npin + i]), tb = fabs(w->b->turn[l * w->b->npin + i]);
        alike += fabs(ta * a->ring[l] - tb * b->ring[l]);
        sources += 2 * tb * w->swing[l];
        open += tb * w->ring[l];
        open +=
            tb * w->swing[l] * (w->overshoot[l] - 2) * fmin(1, 0.5 * w->nonlinearity * w->phase[l]);
        least = fmin(least, phases(w, i, l));
    }
    for (int l = w->slow; l < w->b->modes; l++) /* those that are followed are no part of rapid */
        alike += fabs(w->b->turn[l * w->b->npin + i]) * b->ring[l];
    return bracket + 4 * w->nonlinearity * (alike + sources) + open + least;
}

/* What pin i is deflected by for sure: its linear peak less what stiffness and geometry, wrong by
   u, and frequencies, wrong by u/2, take of it. The shift of the ring d only stretches time. */
static double sure(const work *w, int i) {
    double off = w->nonlinearity * (w->pb.still[i] + w->pb.rapid_rad[i]), least = (double)INFINITY;
    for (int l = 0; l < w->slow; l++)
        off += w->nonlinearity * fabs(w->b->turn[l * w->b->npin + i]) * w->pb.ring[l];
    for (int d = 0; d < w->slow; d++) {
        double sum = 0;
        for (int l = 0; l < w->slow; l++) {
            double turn = fabs(w->b->turn[l * w->b->npin + i]), ring = w->pb.ring[l];
            double loose = l == d ? fmin(ring, w->pb.late[l]) : ring;
            sum += turn * loose * fmin(2, 0.5 * w->nonlinearity * w->phase[l] * (l == d ? 1 : 2));
        }
        least = fmin(least, sum);
    }
    return w->pb.low[i] - off - least;
}

static const char *outside(const fw_effect_case *c) {
    const fw_effects_envelope *b = c->envelope, *a = b->pinned;
    if (!b->valid) return b->why_not;
    if (!a && b->modal && (b->modal->loads->strained || b->modal->loads->stretch.law))
        return "free strains bend hinges that give";
    if (!a) return "pins in place of the hinges have no linear theory";
    if (!a->valid) return a->why_not;
    if (!(a->modes < b->modes) || a->modes == 0) return "no hinge gives";
    if (!(a->omega[a->modes - 1] < 0.5 * b->omega[a->modes]))
        return "the hinges give at frequencies near those of the motion";
    for (int i = 0; i < b->npin; i++)
        if (b->modal->loads->released[i] && fw_effects_pin_deflection(c->mechanism, i) != 0)
            return "a hinge is drawn under stress";
    return NULL;
}

static fw_status motions(work *w, fw_effects_modal_loads *modal_loads, const char **why) {
    const fw_effect_case *c = w->c;
    const fw_effects_envelope *e = w->b;
    double followed = 0, *ring;
    for (int j = 0; j < w->slow; j++)
        followed = fmax(followed, fmax(w->a->omega[j], e->omega[j]));
    FW_TRY(fw_effects_modal_loads_find(c->arena, w->a->modal, modal_loads));
    FW_TRY(fw_effects_peaks_find(c->arena, w->a->modal, modal_loads, followed, w->a->amplitude,
                                 NULL, &w->pa));
    FW_TRY(fw_effects_modal_loads_find(c->arena, e->modal, modal_loads));
    FW_TRY(fw_effects_peaks_find(c->arena, e->modal, modal_loads, followed, e->amplitude, NULL,
                                 &w->pb));
    *why = w->pa.why_not ? w->pa.why_not : w->pb.why_not;
    if (*why) return FW_OK;
    FW_NEED(ring = fw_arena_array(c->arena, double, (size_t)e->modes));
    for (int j = 0; j < e->modes; j++)
        ring[j] = fmin(w->pb.ring[j] + w->pb.late[j], e->amplitude[j]);
    FW_TRY(fw_effects_hinge_sources_new(c->arena, e->modal, w->slow, ring, &w->sources));
    const fw_effects_peaks_source source = {fw_effects_hinge_sources_at, &w->sources, w->pb.late};
    FW_TRY(fw_effects_peaks_find(c->arena, e->modal, modal_loads, followed, e->amplitude, &source,
                                 &w->pc));
    *why = w->pc.why_not;
    return FW_OK;
}

static fw_status compare(work *w, const char **why) {
    const fw_effect_case *c = w->c;
    const fw_effects_envelope *e = w->b;
    fw_effects_modal_loads modal_loads;
    FW_TRY(motions(w, &modal_loads, why));
    if (*why) return FW_OK;
    FW_NEED(w->swing = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->ring = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->rapid_rad = fw_arena_array(c->arena, double, (size_t)e->npin));
    FW_NEED(w->overshoot = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->phase = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_TRY(overshoots(w, &modal_loads));
    for (int j = 0; j < w->slow; j++) {
        double zeta = 0.5 * e->modal->damping[j * e->modes + j] / e->omega[j];
        w->phase[j] = fmin(e->omega[j] * e->duration_s, 1 / (FW_E * fmax(zeta, 1e-12)));
        w->swing[j] = w->sources.force[j] / (e->omega[j] * e->omega[j]);
        w->overshoot[j] = fmax(2, w->overshoot[j]);
    }
    add_rings(w);
    return FW_OK;
}

fw_status fw_effects_hinge_give_bound(const fw_effect_case *c, double *value, const char **why) {
    const fw_effects_envelope *e = c->envelope;
    work w = {.c = c, .a = e->pinned, .b = e};
    *value = (double)INFINITY;
    if ((*why = outside(c))) return FW_OK;
    w.slow = w.a->modes;
    w.nonlinearity = 0.25 * (fmax(w.a->margin, w.b->margin) - 1);
    fw_mark mark = fw_arena_mark(c->arena);
    double most = 0, floor_rad = e->floor;
    FW_TRY(compare(&w, why));
    for (int i = 0; i < e->npin && !*why; i++)
        floor_rad = fmax(floor_rad, sure(&w, i));
    for (int i = 0; i < e->npin && !*why; i++) {
        double x = apart(&w, i);
        most = isnan(x) ? (double)INFINITY : fmax(most, x);
    }
    fw_arena_rewind(c->arena, mark);
    if (!*why) *value = most / floor_rad;
    return FW_OK;
}

/* Which gaps the motion can close at all: hinges by the give and drift of W (above), points
   by the reach of their bodies. Inputs SI from the envelope. Test:
   test_hinge_give.c, test_contact.c. */

const fw_mechanism_hinge *fw_effects_contact_hinge(const fw_mechanism *m,
                                                   const fw_device_contact_use *use) {
    if (use->joint < 0 || use->joint >= m->npin || m->pin[use->joint].hinge == FW_NONE) return NULL;
    return &m->hinge[m->pin[use->joint].hinge];
}

double fw_effects_contact_gap(const fw_effect_case *c, const fw_device_contact_use *use,
                              const fw_mechanism_hinge *h) {
    if (!isnan(use->distance_m)) return use->distance_m;
    const fw_device *d = c->mechanism->device;
    bool drawn = h->surface_radius_m > 0 && d && h->flexure >= 0 && h->flexure < d->nflexure;
    const fw_device_flexure *f = drawn ? &d->flexure[h->flexure] : NULL;
    return f ? f->gap_m - (d->meets_midway ? 0 : fabs(f->flare_m)) : 0;
}

/* as far as a point of a body can move, m */
static double reach_of(const fw_effect_case *c, int body, double x, double y) {
    if (body == FW_GROUND) return 0;
    const double *r = c->envelope->reach + 3 * body;
    return hypot(r[0], r[1]) + r[2] * hypot(x, y);
}

/* the least overlap that is still open: distance left, less what the motion can take of it */
static double room(const fw_effect_case *c, const fw_device_contact_use *use) {
    const fw_mechanism *m = c->mechanism;
    if (use->joint != FW_NONE) {
        const fw_mechanism_hinge *h = fw_effects_contact_hinge(m, use);
        if (!h) return -1;
        /* the surfaces' centres move against each other as the hinge turns about W beside them */
        double turn =
            c->envelope->angle[use->joint] + fabs(fw_effects_pin_deflection(m, use->joint));
        return fw_effects_contact_gap(c, use, h) - fw_effects_hinge_give_most(c, use->joint) -
               turn * hypot(h->off_a_m.x, h->off_a_m.y);
    }
    if (use->face) return 0; /* whose normal turns: not bounded */
    fw_geometry_vec2 a = fw_mechanism_local_place(m, use->body_a, use->ax_m, use->ay_m);
    fw_geometry_vec2 b = fw_mechanism_local_place(m, use->body_b, use->bx_m, use->by_m);
    double now = hypot(b.x - a.x, b.y - a.y), moves = 0;
    moves += reach_of(c, use->body_a, use->ax_m, use->ay_m);
    moves += reach_of(c, use->body_b, use->bx_m, use->by_m);
    const fw_effects_foreign of = fw_effects_foreign_of(c, use->expansion_per_K);
    if (use->undrawn != FW_UNDRAWN_ETCHED)
        moves += use->distance_m * fw_effects_foreign_most(&of, c->scene->duration_s);
    return (use->side == FW_CONTACT_INSIDE ? use->distance_m - now : now - use->distance_m) - moves;
}

bool fw_effects_contact_may_touch(const fw_effect_case *c) {
    bool known = c->envelope->valid;
    for (int i = 0; i < c->mechanism->nhinge; i++) /* hinges that give and are not in it */
        known = known && (!fw_effects_hinge_flexes(c, i) || c->envelope->pinned);
    for (int i = 0; i < c->scene->ncontact; i++)
        if (!known || !(room(c, &c->scene->contact[i]) > 0)) return true;
    return false;
}

/* ---- the effect: flexures as they are instead of pins. The element is in hinge_element.c, the law in flexure/finite.c ---- */

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->nhinge; i++)
        if (fw_effects_hinge_flexes(c, i)) return true;
    return false;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->nhinge; i++)
        n += fw_effects_hinge_flexes(c, i);
    return n;
}

/* What ideal pins in place of the hinges change in the peaks: above. Where surfaces may
   touch the hinge must be able to give. Test: test_hinge_give.c, test_hinge_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const char *why;
    *value = (double)INFINITY;
    *reason = "conjugate surfaces may touch, which needs the hinge to give: kept";
    if (c->scene->ncontact > 0 && fw_effects_contact_may_touch(c)) return FW_OK;
    FW_TRY(fw_effects_hinge_give_bound(c, value, &why));
    *reason = "flexures give and drift: peaks of the linear motion with pins and with hinges that "
              "give, and what the hinges do besides";
    if (why)
        FW_NEED(*reason = fw_arena_printf(
                    c->arena,
                    "flexures give and drift, and nothing bounds what that does: kept (%s)", why));
    return FW_OK;
}

/* ---- hinges side by side ---- */

/* A motion asks all elements for their forces at one pose. What the closed forms among them need is worked out for all
   at once, in lanes (flexure/finite_lanes.c), and kept where each of them looks first. Cost 620 instructions a hinge of
   four, 200 of which are the sine and cosine of its place. Test: test_finite_lanes.c, test_nonlinear_hinge.c beside_each_other */
struct fw_effects_beside {
    int count;
    const fw_effects_flexed **hinge; /* (count) */
    int *port;                       /* (count) the first of its two among those of all elements */
    bool *known;
    fw_flexure_hinge_lanes lanes;
};

fw_status fw_effects_beside_new(fw_arena *arena, int n, const fw_effects_force_element *e,
                                fw_effects_beside **out) {
    fw_effects_beside *b = fw_arena_one(arena, fw_effects_beside);
    const fw_flexure_hinge_rest **rest;
    const size_t most = (size_t)n + 1;
    *out = NULL;
    FW_NEED(b);
    FW_NEED(b->hinge = fw_arena_array(arena, const fw_effects_flexed *, most));
    FW_NEED(b->port = fw_arena_array(arena, int, most));
    FW_NEED(b->known = fw_arena_array(arena, bool, most));
    FW_NEED(rest = fw_arena_array(arena, const fw_flexure_hinge_rest *, most));
    for (int i = 0, port = 0; i < n; port += e[i++].ports) {
        if (e[i].class_ != &fw_effects_flexed_class) continue;
        b->hinge[b->count] = e[i].data, b->port[b->count] = port;
        rest[b->count] = &b->hinge[b->count]->rest;
        b->count++;
    }
    if (b->count < 2) return FW_OK;
    FW_TRY(fw_flexure_hinge_lanes_new(arena, b->count, rest, &b->lanes));
    for (int i = 0; i < b->count; i++)
        b->lanes.out[i] = &b->hinge[i]->last->law;
    *out = b;
    return FW_OK;
}

void fw_effects_beside_bend(fw_effects_beside *b, const double *p) {
    const fw_flexure_hinge_lanes *lanes = &b->lanes;
    const size_t stride = lanes->stride;
    bool all = true;
    for (int i = 0; i < b->count && all; i++)
        all = fw_effects_bent_at(b->hinge[i]->last, p + 3 * b->port[i]);
    if (all) return;
    for (int i = 0; i < b->count; i++) {
        const fw_effects_flexed *f = b->hinge[i];
        fw_effects_flexed_place(f, p + 3 * b->port[i], f->last);
        double *at = lanes->at + i;
        at[0] = f->sense * f->last->th;
        at[stride] = f->sense * f->last->x, at[2 * stride] = f->sense * f->last->y;
    }
    fw_flexure_hinge_lanes_bend(lanes, b->known);
    for (int i = 0; i < b->count; i++) {
        const fw_effects_flexed *f = b->hinge[i];
        const double *from = lanes->at + i, at[3] = {from[0], from[stride], from[2 * stride]};
        if (!b->known[i]) { /* its series do not know, which is not asked once more */
            fw_flexure_hinge_rest rest = f->rest;
            rest.number[FW_HINGE_RANGE] = -1;
            fw_flexure_hinge_law_bend(&f->law, &rest, at, false, &f->last->law);
        }
        f->last->known = true;
    }
}

const fw_effect_row fw_effect_nonlinear_hinge = {
    .id = "nonlinear-hinge",
    .summary = "what flexures do besides turning: their axis drifts, forces displace it",
    .called_for = called_for,
    .bound = bound,
    .add = fw_effects_hinges_flex,
    .adds_blindly = true,
    .cost = 2900,
    .count = count,
    .solid = FW_EFFECTS_SOLID_HAS};
