/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the peaks of a mechanism with ideal pins are from those of one whose hinges give and
   drift. Two linear motions under the same loads, hinges as pins (a) and as springs (b), are known
   up to their peaks (peaks.c); to |peak a - peak b| is added, with u the doubt of the envelope:

     4 u (differences of what stands still, of the rings; rings of the modes that the hinges add)
                what is not linear does to both alike
     sources    what of a hinge is not linear, as the envelope allows it: the drift d(th), a give of
                its forces F by what its softness changes with th, the torque F d'(th) + k'/2k F
   give, couples F give/2 on both bodies. Their answer: modes of b beyond those of a as in statics,
   signs kept, twice; the others sizes times what a product of two of the motion's courses can do:
   2/|1 - (W/w)^2| for W = w_j, w_j +- w_k, at most w T/2

     phases     frequencies shift, and rings of several modes or of later loads then meet at other
                times. The shift of one ring from the start only stretches time; others: their size
                times the shift of their phase, known to first order in the peaks (so times
                min(1, u w T)), and in full for the shift by the sources


   Inputs SI from the envelopes; outputs rad over the floor. Infinite where the hinges give at
   frequencies below twice those of the motion. Valid as the envelope is. Cost: peaks.c, and modes
   times pins times hinges. Source: docs/theory/effects/nonlinear-hinge.md. Test: test_hinge_give.c,
   test_hinge_bounds.c. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/peaks.h"
#include <math.h>

typedef struct work {
    const fw_effect_case *c;
    const fw_envelope *a, *b; /* pinned, given */
    fw_peaks pa, pb;
    int slow; /* modes of a */
    double unsure;
    double *rapid_rad; /* (npin) sources in the modes beyond */
    double *swing;     /* (slow) sources: static |q| */
    double *up, *down; /* (slow) of it those that always push one way, or the other */
    double *overshoot; /* (slow) */
    double *phase;     /* (slow) w T, T the time over which its damping lets it count */
} work;

/* ---- sources ---- */

/* Largest of what the law does within these angles; of the compliances 1/kx, 1/ky (0 and 1: along
   e and n) their change, slope and difference */
typedef struct worst {
    bool one_way; /* the drift never changes its sign */
    double drift_m, slope_m, softer_m_per_N[2], twist_per_N[2], uneven_m_per_N;
} worst;

static worst worst_of(const fw_hinge_law *law, double angle_rad) {
    enum { STEPS = 16 };
    worst w = {.one_way = true};
    fw_hinge_at at, rest;
    fw_hinge_law_at(law, 0, &rest);
    for (int i = -STEPS; i <= STEPS; i++) {
        fw_hinge_law_at(law, angle_rad * i / STEPS, &at);
        const fw_hinge_jet *k[2] = {&at.kx_N_per_m, &at.ky_N_per_m};
        const double drawn[2] = {rest.kx_N_per_m.value, rest.ky_N_per_m.value};
        w.one_way = w.one_way && at.drift_m.value > -1e-6 * law->length_m * angle_rad * angle_rad;
        w.drift_m = fmax(w.drift_m, fabs(at.drift_m.value));
        w.slope_m = fmax(w.slope_m, fabs(at.drift_m.slope));
        w.uneven_m_per_N = fmax(w.uneven_m_per_N, fabs(1 / k[0]->value - 1 / k[1]->value));
        for (int d = 0; d < 2; d++) {
            double v = k[d]->value;
            w.softer_m_per_N[d] = fmax(w.softer_m_per_N[d], fabs(1 / v - 1 / drawn[d]));
            w.twist_per_N[d] = fmax(w.twist_per_N[d], fabs(k[d]->slope) / (v * v));
        }
    }
    return w;
}

static worst worst_at(const fw_effect_case *c, const fw_envelope *e, int hinge) {
    const fw_hinge *h = &c->mechanism->hinge[hinge];
    return worst_of(&h->law, e->angle[h->pin] + fabs(fw_pin_deflection(c->mechanism, h->pin)));
}

double fw_hinge_give_most(const fw_effect_case *c, int pin) {
    const fw_envelope *e = c->envelope;
    int hinge = c->mechanism->pin[pin].hinge;
    if (!e->pinned || hinge == FW_NONE || !fw_hinge_is_known(&c->mechanism->hinge[hinge]))
        return e->give[pin];
    return e->give[pin] + worst_at(c, e, hinge).drift_m;
}

/* One source: modal force (modes) of a unit of it, and how large it is. Of one that has always the
   same sign (`sign`, else 0) only those that agree in theirs add up */
static void add_source(work *w, const double *force, double size, double sign) {
    const fw_envelope *e = w->b;
    size_t pins = (size_t)e->npin;
    for (int j = 0; j < w->slow; j++) {
        double q = w->b->margin * size * force[j] / (e->omega[j] * e->omega[j]);
        if (sign == 0)
            w->swing[j] += fabs(q);
        else
            *(sign * q > 0 ? &w->up[j] : &w->down[j]) += fabs(q);
    }
    for (size_t i = 0; i < pins; i++) {
        double sum = 0;
        for (int j = w->slow; j < e->modes; j++)
            sum += e->turn[(size_t)j * pins + i] * force[j] / (e->omega[j] * e->omega[j]);
        w->rapid_rad[i] += 2 * w->b->margin * size * fabs(sum);
    }
}

/* N: along e and n of the hinge, in the modes as sizes; like the angles without the margin, which
   the answer has */
static void force_of(const work *w, int hinge, double *most) {
    const fw_envelope *e = w->b;
    const fw_hinge *h = &w->c->mechanism->hinge[hinge];
    double c = cos(h->axis_rad), s = sin(h->axis_rad);
    most[0] = most[1] = 0;
    for (int j = 0; j < e->modes; j++) {
        const double *pull = e->modal->pull + 2 * ((size_t)j * (size_t)e->npin + (size_t)h->pin);
        most[0] += e->amplitude[j] * fabs(c * pull[0] + s * pull[1]);
        most[1] += e->amplitude[j] * fabs(c * pull[1] - s * pull[0]);
    }
}

static void add_hinge(work *w, int hinge, double *force) {
    const fw_mechanism *m = w->c->mechanism;
    const fw_envelope *e = w->b;
    const fw_hinge *h = &m->hinge[hinge];
    size_t pins = (size_t)e->npin, pin = (size_t)h->pin, modes = (size_t)e->modes;
    double angle = fabs(fw_pin_deflection(m, h->pin));
    for (size_t j = 0; j < modes; j++)
        angle += fabs(e->turn[j * pins + pin]) * e->amplitude[j];
    worst x = worst_of(&h->law, angle);
    double c = cos(h->axis_rad), s = sin(h->axis_rad), push[2];
    force_of(w, hinge, push);
    for (int d = 0; d < 2; d++) {
        for (size_t j = 0; j < modes; j++) {
            const double *pull = e->modal->pull + 2 * (j * pins + pin);
            force[j] = d ? c * pull[1] - s * pull[0] : c * pull[0] + s * pull[1];
        }
        add_source(w, force, x.softer_m_per_N[d] * push[d], 0);
        bool known = x.one_way && fw_pin_deflection(m, h->pin) == 0; /* drawn free of force */
        if (d) add_source(w, force, x.drift_m, known ? h->first_is_a ? 1 : -1 : 0);
    }
    for (size_t j = 0; j < modes; j++)
        force[j] = e->turn[j * pins + pin];
    double twist = x.twist_per_N[0] * push[0] * push[0] + x.twist_per_N[1] * push[1] * push[1];
    add_source(w, force, push[1] * x.slope_m + 0.5 * twist, 0);
    double couple = push[0] * (push[1] * x.uneven_m_per_N + x.drift_m);
    for (int side = 0; side < 2; side++) {
        int b = side ? m->pin[pin].body_b : m->pin[pin].body_a;
        for (size_t j = 0; j < modes && b != FW_GROUND; j++)
            force[j] = e->shape[j * (size_t)e->n + 3 * (size_t)b + 2];
        if (b != FW_GROUND) add_source(w, force, 0.5 * couple, 0);
    }
}

/* ---- what a product of two courses of the motion does to a mode ---- */

/* answer of a mode w, over the static one, to cos W t from rest */
static double answer(double pace, double omega, double most) {
    double apart = fabs(1 - pace / omega * (pace / omega));
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

/* of a course that is no wave: by its variation */
static double restless(const fw_pushes *p, int modes) {
    double most = 0;
    for (int i = 0; i < p->count; i++) {
        const fw_push *f = &p->item[i];
        if (!f->element && (fw_law_is_constant(f->law) || f->law->kind == FW_LAW_SINE)) continue;
        for (int j = 0; j < modes; j++)
            if (f->sup[j] > 0) most = fmax(most, f->sway[j] / f->sup[j]);
    }
    return most;
}

static fw_status overshoots(work *w, const fw_pushes *p) {
    const fw_envelope *e = w->b;
    int count = 0;
    double *pace, *share, sum = 0, other = restless(p, w->slow);
    size_t most = (size_t)w->slow + (size_t)p->count;
    FW_NEED(pace = fw_arena_array(w->c->arena, double, most));
    FW_NEED(share = fw_arena_array(w->c->arena, double, most));
    for (int j = 0; j < w->slow; j++, count++) {
        pace[j] = e->omega[j];
        for (int i = 0; i < e->npin; i++)
            share[j] = fmax(share[j], fabs(e->turn[j * e->npin + i]) * e->amplitude[j]);
        sum += share[j];
    }
    for (int j = 0; j < w->slow; j++)
        share[j] /= sum;
    for (int i = 0; i < p->count; i++)
        if (p->item[i].law && p->item[i].law->kind == FW_LAW_SINE) {
            pace[count] = 2 * M_PI * p->item[i].law->frequency_Hz;
            share[count++] = 1;
        }
    const bool constant = other == 0 && count == w->slow;
    for (int l = 0; l < w->slow; l++) {
        double cap = fmax(2, 0.5 * e->omega[l] * e->duration_s);
        for (int j = 0; j < count; j++)
            for (int k = 0; k < count; k++)
                w->overshoot[l] +=
                    share[j] * share[k] *
                    (j == l && k == l && constant ? alone(w, l)
                                                  : both(pace[j], pace[k], e->omega[l], cap));
        w->overshoot[l] += other > 0 ? fmin(cap, 2 * other) : 0;
    }
    return FW_OK;
}

/* ---- the sum ---- */

/* rings that may meet at other times, of pin i, where the ring d only stretches time */
static double phases(const work *w, int i, int d) {
    double sum = 0, pinned = w->a->omega[d], shift = fabs(pinned / w->b->omega[d] - 1);
    for (int l = 0; l < w->slow; l++) {
        double turn = fabs(w->b->turn[l * w->b->npin + i]), ring = w->pb.ring[l];
        double own = fabs(w->a->omega[l] / w->b->omega[l] - w->a->omega[d] / w->b->omega[d]);
        double late = fmin(ring, w->pb.late[l]), loose = l == d ? late : ring;
        double known = fmin(1, w->unsure * w->phase[l]);
        sum += turn * known *
               (loose * fmin(2, own * w->phase[l]) + late * fmin(2, shift * w->phase[l]));
        sum +=
            turn * fmin(0.5 * w->swing[l] * w->phase[l] * (ring > 0 ? loose / ring : 0), 2 * loose);
    }
    return sum;
}

static double apart(const work *w, int i) {
    const fw_peaks *a = &w->pa, *b = &w->pb;
    double bracket = fmax(a->high[i] - b->low[i], b->high[i] - a->low[i]);
    double alike = fabs(a->still[i] - b->still[i]) + a->rapid_rad[i] + b->rapid_rad[i];
    double sources = w->rapid_rad[i], least = (double)INFINITY;
    for (int l = 0; l < w->slow; l++) {
        double ta = fabs(w->a->turn[l * w->a->npin + i]), tb = fabs(w->b->turn[l * w->b->npin + i]);
        alike += fabs(ta * a->ring[l] - tb * b->ring[l]);
        sources += tb * w->swing[l] * w->overshoot[l];
        least = fmin(least, phases(w, i, l));
    }
    for (int l = w->slow; l < w->b->modes; l++) /* those that are followed are no part of rapid */
        alike += fabs(w->b->turn[l * w->b->npin + i]) * b->ring[l];
    return bracket + 4 * w->unsure * alike + sources + least;
}

static const char *outside(const fw_effect_case *c) {
    const fw_envelope *b = c->envelope, *a = b->pinned;
    if (!b->valid) return b->why_not;
    if (!a && b->modal && (b->modal->terms->strained || b->modal->terms->stretch.law))
        return "free strains bend hinges that give";
    if (!a) return "pins in place of the hinges have no linear theory";
    if (!a->valid) return a->why_not;
    if (!(a->modes < b->modes) || a->modes == 0) return "no hinge gives";
    if (!(a->omega[a->modes - 1] < 0.5 * b->omega[a->modes]))
        return "the hinges give at frequencies near those of the motion";
    return NULL;
}

static fw_status compare(work *w, const char **why) {
    const fw_effect_case *c = w->c;
    const fw_envelope *e = w->b;
    double *force, followed = 0;
    fw_pushes pushes;
    for (int j = 0; j < w->slow; j++)
        followed = fmax(followed, fmax(w->a->omega[j], e->omega[j]));
    FW_TRY(fw_pushes_find(c->arena, w->a->modal, &pushes));
    FW_TRY(fw_peaks_find(c->arena, w->a->modal, &pushes, followed, w->a->amplitude, &w->pa));
    FW_TRY(fw_pushes_find(c->arena, e->modal, &pushes));
    FW_TRY(fw_peaks_find(c->arena, e->modal, &pushes, followed, e->amplitude, &w->pb));
    *why = w->pa.why_not ? w->pa.why_not : w->pb.why_not;
    if (*why) return FW_OK;
    FW_NEED(w->rapid_rad = fw_arena_array(c->arena, double, (size_t)e->npin));
    FW_NEED(w->swing = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->up = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->down = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->overshoot = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(w->phase = fw_arena_array(c->arena, double, (size_t)w->slow));
    FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->modes));
    FW_TRY(overshoots(w, &pushes));
    for (int j = 0; j < w->slow; j++) {
        double zeta = 0.5 * e->modal->damping[j * e->modes + j] / e->omega[j];
        w->phase[j] = fmin(e->omega[j] * e->duration_s, 1 / (M_E * fmax(zeta, 1e-12)));
    }
    for (int h = 0; h < c->mechanism->nhinge; h++)
        if (e->modal->terms->released[c->mechanism->hinge[h].pin]) add_hinge(w, h, force);
    for (int j = 0; j < w->slow; j++)
        w->swing[j] += fmax(w->up[j], w->down[j]);
    return FW_OK;
}

fw_status fw_hinge_give_bound(const fw_effect_case *c, double *value, const char **why) {
    const fw_envelope *e = c->envelope;
    work w = {.c = c, .a = e->pinned, .b = e};
    *value = (double)INFINITY;
    if ((*why = outside(c))) return FW_OK;
    w.slow = w.a->modes;
    w.unsure = 0.25 * (fmax(w.a->margin, w.b->margin) - 1);
    fw_mark mark = fw_arena_mark(c->arena);
    double most = 0;
    FW_TRY(compare(&w, why));
    for (int i = 0; i < e->npin && !*why; i++) {
        double x = apart(&w, i);
        most = isnan(x) ? (double)INFINITY : fmax(most, x);
    }
    fw_arena_rewind(c->arena, mark);
    if (!*why) *value = most / e->floor;
    return FW_OK;
}
