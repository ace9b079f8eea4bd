/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first event of a step: where a stop, a cable, a switch of an element or the state of a joint
   with friction no longer fits its flag. Looked for on the dense output at FW_PLACES + 1 places,
   and between them wherever a touch may be shorter than their spacing; found to round-off. Entries
   are numbered as fw_model_switches has them, then the joints with friction. Test: test_events.c,
   test_friction.c. */
#include "dynamics/run.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* r->moved at theta, posed; returns the time */
static double stand_at(fw_run *r, fw_stepper *s, double theta) {
    fw_stepper_dense(s, theta, r->moved);
    fw_model_at(r->model, s->t_old + theta * s->h);
    fw_model_pose(r->model, r->moved);
    return s->t_old + theta * s->h;
}

/* how well switch i fits its flag: >= 0 fits, its value with the sign of the flag */
static double fitting(const fw_run *r, int i, double value) {
    if (fw_model_switch_on(r->model, i)) return value > 0 ? value : fmin(value, -DBL_MIN);
    return value > 0 ? -value : fabs(value);
}

static double fitness(fw_run *r, fw_stepper *s, int i, double theta) {
    double t = stand_at(r, s, theta);
    int friction = i - fw_model_switches(r->model);
    if (friction < 0) return fitting(r, i, fw_model_switch_value(r->model, t, i, r->moved));
    fw_friction_fits(r->model, t, r->moved, r->friction_fit);
    return r->friction_fit[friction];
}

/* of all entries at place k, which share their evaluations */
static void look_at_place(fw_run *r, fw_stepper *s, int k, double *f) {
    fw_model *m = r->model;
    int switches = fw_model_switches(m);
    double t = stand_at(r, s, (double)k / FW_PLACES);
    fw_model_switch_values(m, t, r->moved, f);
    for (int i = 0; i < switches; i++)
        f[i] = fitting(r, i, f[i]);
    if (fw_friction_count(m) > 0) fw_friction_fits(m, t, r->moved, f + switches);
}

/* first place in (low, high] where entry i does not fit, given that it does at low and not at
   high; to round-off of theta, from above */
static double bisect(fw_run *r, fw_stepper *s, int i, double low, double high) {
    for (int k = 0; k < 52 && high - low > 1e-15; k++) {
        double middle = 0.5 * (low + high);
        *(fitness(r, s, i, middle) < 0 ? &high : &low) = middle;
    }
    return high;
}

/* a place in (low, high) where entry i does not fit, though it does at both ends: the least fit
   one, by golden section; NaN when it fits there too. Finds a touch shorter than the spacing. */
static double dip(fw_run *r, fw_stepper *s, int i, double low, double high) {
    const double golden = 0.6180339887498949;
    double x = high - golden * (high - low), y = low + golden * (high - low);
    double fx = fitness(r, s, i, x), fy = fitness(r, s, i, y);
    for (int k = 0; k < 60 && fx >= 0 && fy >= 0 && high - low > 1e-12; k++) {
        if (fx < fy) {
            high = y, y = x, fy = fx, x = high - golden * (high - low);
            fx = fitness(r, s, i, x);
        } else {
            low = x, x = y, fx = fy, y = low + golden * (high - low);
            fy = fitness(r, s, i, y);
        }
    }
    return fx < 0 ? x : fy < 0 ? y : (double)NAN;
}

/* does entry i, which fits least at an end of the step (f: there, beside it, and beyond), become
   less fit on its way in, so far that a parabola through the three may reach below 0? */
static bool dips_at_end(fw_run *r, fw_stepper *s, int i, double f, double beside, double beyond,
                        double theta, double inward) {
    if (!(f >= 0 && f <= beside && 2 * f <= f - 2 * beside + beyond)) return false;
    return fitness(r, s, i, theta + 1e-3 * inward) < f;
}

/* first place up to place k of the step where entry i does not fit, though it did up to k - 1: by
   its fitness f at the places so far, between any three of which the middle one is least and so
   small that a parabola through them may reach below 0, and at the ends of the step. NaN: none */
static double first_unfit(fw_run *r, fw_stepper *s, int i, int count, int k) {
    const double part = 1.0 / FW_PLACES;
    const double *f = r->fit + (size_t)k * (size_t)count + i;
    if (k == 0) return (double)NAN;
    const double *f1 = f - count, *f2 = f1 - (k > 1 ? count : 0);
    if (k > 1 && *f1 <= *f2 && *f1 <= *f && *f1 >= 0 && *f >= 0 && *f1 <= *f2 - 2 * *f1 + *f) {
        double low = (k - 2) * part, at = dip(r, s, i, low, k * part);
        if (!isnan(at)) return bisect(r, s, i, low, at);
    }
    if (k == 2 && dips_at_end(r, s, i, *f2, *f1, *f, 0, part)) {
        double at = dip(r, s, i, 0, part);
        if (!isnan(at)) return bisect(r, s, i, 0, at);
    }
    if (k == FW_PLACES && dips_at_end(r, s, i, *f, *f1, *f2, 1, -part)) {
        double at = dip(r, s, i, 1 - part, 1);
        if (!isnan(at)) return bisect(r, s, i, 1 - part, at);
    }
    return *f < 0 ? bisect(r, s, i, (k - 1) * part, k * part) : (double)NAN;
}

/* What is found at the next place lies beyond the place before this one. */
double fw_run_event(fw_run *r, fw_stepper *s, int *which) {
    int count = fw_model_switches(r->model) + fw_friction_count(r->model);
    double first = 1;
    *which = -1;
    if (count == 0) return first;
    fw_friction_watch(r->model, s->y);
    memset(r->unfit, 0, (size_t)count * sizeof *r->unfit);
    for (int k = 0; k <= FW_PLACES && !(*which >= 0 && first <= (k - 2.0) / FW_PLACES); k++) {
        look_at_place(r, s, k, r->fit + (size_t)k * (size_t)count);
        for (int i = 0; i < count; i++) {
            double at = r->unfit[i] ? (double)NAN : first_unfit(r, s, i, count, k);
            if (isnan(at)) continue;
            r->unfit[i] = true;
            if (*which < 0 || at < first || (at == first && i < *which)) first = at, *which = i;
        }
    }
    return first;
}
