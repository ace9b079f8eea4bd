/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least change of a kind that is accepted.

   In: a trial whose `changed` device is accepted, and the device as described, which is not. Every
   quantity that differs is taken to y(s) = y0 (y1/y0)^s, s from 0 (as described) to 1 (changed).

   Out: `changed` at the least s that was run and accepted, lengths rounded up to their unit.

   Method: between what glances (coarse, as drawn and at the corner that governed last) do not accept
   and what they may, s is found by the secant of ln(utilisation), or halved where that gains less than
   half or has no number, until the change is known to 1 % of itself. There it is stated as settings and
   judged wholly; where that does not accept, it told which corner governs, and the search goes on
   between there and 1, in growing steps at the least. Acceptance need not be monotonous in s: what is
   found was run as it is stated; a smaller one beyond a gap may be missed.

   Cost: 5 to 12 glances for each whole judgement, of which one or two are usual, MOST_JUDGED at most;
   beyond most_work evaluations of hinges the change that was accepted is proposed as it is.
   Test: tests/cli/test_advice.py, test_lengths_are_the_least. */
#include "verdict/advice.h"
#include "base/sort.h"
#include "effects/effects.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_GLANCES = 14, MOST_JUDGED = 8 };
static const double known_to = 0.01; /* of the change */

static double along(double from, double to, double s) {
    return from > 0 && to > 0 ? from * pow(to / from, s) : from + s * (to - from);
}

/* up to the unit, which is what the change is written in, but not beyond where it was accepted */
static double rounded_up(double x, double unit, double most) {
    return fmin(ceil(x / unit - 1e-6) * unit, most);
}

static void flexure_at(const fw_device_flexure *was, const fw_device_flexure *full, double s,
                       fw_device_flexure *f) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double unit = arc && f->radius_given ? 1e-7 * f->angle_rad : 1e-7;
    if (full->length_m != was->length_m)
        f->length_m = rounded_up(along(was->length_m, full->length_m, s), unit, full->length_m);
    if (arc && full->length_m != was->length_m) f->radius_m = f->length_m / f->angle_rad;
    if (full->width_m != was->width_m)
        f->width_m = rounded_up(along(was->width_m, full->width_m, s), 1e-8, full->width_m);
}

static void box_at(const fw_device_workspace_box *full, double s, fw_device_workspace_box *w) {
    w->x_min_m = along(w->x_min_m, full->x_min_m, s);
    w->x_max_m = along(w->x_max_m, full->x_max_m, s);
    w->y_min_m = along(w->y_min_m, full->y_min_m, s);
    w->y_max_m = along(w->y_max_m, full->y_max_m, s);
    w->phi_min_rad = along(w->phi_min_rad, full->phi_min_rad, s);
    w->phi_max_rad = along(w->phi_max_rad, full->phi_max_rad, s);
}

/* the device at s of the way to `full` */
static fw_status go_to(fw_verdict_trial *trial, const fw_device *full, const double *share,
                       double s) {
    FW_TRY(fw_verdict_trial_reset(trial));
    fw_device *d = trial->changed;
    for (int i = 0; i < d->nflexure; i++)
        flexure_at(&trial->device->flexure[i], &full->flexure[i], s, &d->flexure[i]);
    for (int i = 0; i < d->nscene; i++) {
        double part = pow(share[i], s);
        if (part < 1 && fw_effects_scale(&d->scene[i], part)) trial->share[i] = part;
    }
    for (int i = 0; i < d->nworkspace; i++)
        box_at(&full->workspace[i], s, &d->workspace[i]);
    return FW_OK;
}

typedef struct way { /* from the device as described to `full` */
    fw_verdict_trial *trial;
    const fw_device *full;
    double *share; /* (full->nscene) */
    double most_work;
    double
        bias; /* ln of what a whole judgement found over what a glance does there; 0: not known */
} way;

static bool spent(const way *w) {
    return w->trial->work >= w->most_work;
}

typedef struct place { /* on the way */
    double s;
    /* ln of the largest utilisation: above 0 where it is not accepted; NaN: other reasons */
    double over;
} place;

/* by what the trial's last run says, which is off by `bias` */
static place place_of(const fw_verdict_trial *trial, double s, double bias, bool *may) {
    const double over = log(fw_verdict_trial_excess(trial)) + bias;
    *may = trial->decision != FW_REJECT && trial->drawn && !(over > 0);
    return (place){s, *may == (over <= 0) && isfinite(over) ? over : (double)NAN};
}

static fw_status glance(const way *w, double s, place *out, bool *may) {
    FW_TRY(go_to(w->trial, w->full, w->share, s));
    FW_TRY(fw_verdict_trial_run(w->trial, FW_LOOK_GLANCE));
    *out = place_of(w->trial, s, w->bias, may);
    return FW_OK;
}

/* After a whole judgement at s: what glances are off by there, at the corner that governs now. Else the same place would
   be judged wholly again and again, a hundredth of the way further each time. */
static fw_status learn(way *w, double s) {
    const double most = 0.5; /* beyond, both are about different things */
    const double whole = log(fw_verdict_trial_excess(w->trial));
    place coarse;
    bool may;
    w->bias = 0;
    FW_TRY(glance(w, s, &coarse, &may));
    if (fabs(whole - coarse.over) < most) w->bias = whole - coarse.over; /* NaN is passed */
    return FW_OK;
}

/* where the straight line between both meets 0, `beside` parts of what is resolved further; the middle
   where that is asked for, or there is no line */
static double between(const place *low, const place *high, double beside, bool halve) {
    const double gap = high->s - low->s;
    if (halve || !(low->over > 0 && high->over < 0)) return low->s + 0.5 * gap;
    const double t = low->over / (low->over - high->over) + beside * known_to * high->s / gap;
    return low->s + fmin(fmax(t, 0.02), 0.98) * gap;
}

/* the least s above `low` that a glance may accept */
static fw_status approach(const way *w, place low, place *high) {
    double beside = 0.4, before = HUGE_VAL;
    bool jumps = false;
    for (int i = 0; i < MOST_GLANCES && !spent(w) && high->s - low.s > known_to * high->s; i++) {
        const double gap = high->s - low.s;
        const bool halve = jumps || gap > 0.5 * before;
        place middle;
        bool may;
        FW_TRY(glance(w, between(&low, high, beside, halve), &middle, &may));
        before = gap;
        beside = may ? -0.4 : 0.4; /* the other side is to come closer */
        place *side = may ? high : &low;
        jumps = jumps || (!halve && fw_verdict_jumps(side->over, middle.over));
        *side = middle;
    }
    return FW_OK;
}

fw_status fw_verdict_least_change(fw_verdict_trial *trial, double most_work,
                                  fw_verdict_propose *propose, void *context, bool *added) {
    way w = {.trial = trial,
             .full = trial->changed,
             .most_work = fmin(trial->work + most_work, trial->most_work)};
    FW_NEED(w.share = fw_arena_array(trial->arena, double, (size_t)w.full->nscene));
    for (int i = 0; i < w.full->nscene; i++)
        w.share[i] = trial->share[i];
    bool may;
    const place full = place_of(trial, 1, 0, &may);
    place low = {0, log(trial->excess_as_described)};
    double step = known_to;
    *added = false;
    for (int i = 0; i < MOST_JUDGED && !*added && low.s < 1; i++) {
        place at = full; /* there it was accepted */
        const bool last = i == MOST_JUDGED - 1 || spent(&w);
        if (!last) FW_TRY(approach(&w, low, &at));
        FW_TRY(go_to(trial, w.full, w.share, at.s));
        FW_TRY(propose(context, added));
        if (!*added && !last) FW_TRY(learn(&w, at.s));
        low = (place){last ? 1 : fmin(at.s * (1 + step), 1), (double)NAN};
        step *= 2;
        trial->ended = spent(&w);
    }
    return FW_OK;
}

/* ---- one value, in steps ---- */

/* Drawings go in steps with some values, as holes with their pitch, so that nothing is to be learnt from slopes: a
   dozen steps to the end of its range, then halves of the last one. */
enum { MOST_STEPS = 12, MOST_HALVES = 3 };
static const double near_limit = 1.03; /* of a glance that a whole verdict may still accept */

static fw_status accepts(fw_verdict_trial *trial, const fw_verdict_variable *v, double z, double *x,
                         bool *yes) {
    *x = fw_verdict_variable_typed(v, fw_verdict_variable_x(v, z));
    const char *value = fw_verdict_value_text(trial->arena, &v->value, *x, 12);
    FW_NEED(value);
    const fw_device_set set = {v->value.path, value};
    *yes = false;
    if (*x == v->value.now) return FW_OK;
    FW_TRY(fw_verdict_trial_restate(trial, &set, 1, FW_LOOK_GLANCE));
    if (!trial->drawn || trial->decision == FW_REJECT ||
        fw_verdict_trial_excess(trial) > near_limit)
        return FW_OK;
    FW_TRY(fw_verdict_trial_restate(trial, &set, 1, FW_LOOK_WHOLE));
    *yes = trial->drawn && trial->decision == FW_ACCEPT;
    return FW_OK;
}

fw_status fw_verdict_least_step(fw_verdict_trial *trial, const fw_verdict_variable *v,
                                double most_work, double *x, bool *found) {
    const double end = v->value.low < v->value.now ? v->value.low : v->value.high,
                 whole = fw_verdict_variable_z(v, end);
    double not_yet = 0, enough = 0, at;
    bool yes;
    *found = false;
    for (int k = 1; k <= MOST_STEPS && !*found && trial->work < most_work; k++) {
        const double z = whole * pow((double)k / MOST_STEPS, 1.5);
        FW_TRY(accepts(trial, v, z, x, found));
        *(*found ? &enough : &not_yet) = z;
    }
    for (int k = 0; *found && k < MOST_HALVES && trial->work < most_work; k++) {
        const double z = 0.5 * (not_yet + enough);
        FW_TRY(accepts(trial, v, z, &at, &yes));
        *(yes ? &enough : &not_yet) = z;
        if (yes) *x = at;
    }
    return FW_OK;
}

/* ---- the least change first ---- */

/* to a thousandth; of the same size parameters go first */
static int by_change(const void *a, const void *b) {
    const fw_verdict_proposal *p = a, *q = b;
    int order = fw_order_doubles(nearbyint(1e3 * p->change), nearbyint(1e3 * q->change));
    if (order == 0) order = fw_order_wholes((int)p->kind, (int)q->kind);
    if (order == 0) order = fw_order_wholes(p->nset, q->nset);
    return order ? order : strcmp(p->text, q->text);
}

void fw_verdict_sort_proposals(fw_verdict *verdict) {
    qsort(verdict->proposal, (size_t)verdict->nproposal, sizeof *verdict->proposal, by_change);
}
