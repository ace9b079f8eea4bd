/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least change of a kind that is accepted.

   In: a trial whose `changed` device is accepted, and the device as described, which is not. Every
   quantity that differs is taken to y(s) = y0 (y1/y0)^s, s from 0 (as described) to 1 (changed).

   Out: `changed` at the least s that was run and accepted, lengths rounded up to their unit.

   Method: s is halved between what is not accepted and what is, until the change is known to 1 %
   of itself. Acceptance need not be monotonous in s: what is found was run, and lies at the end of an
   interval that accepts; a smaller one beyond a gap may be missed.

   Cost: at most 8 judgements. Test: tests/cli/test_advice.py, test_lengths_are_the_least. */
#include "verdict/trial.h"
#include "effects/effects.h"
#include <math.h>

enum { HALVINGS = 8 };
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

fw_status fw_verdict_least_change(fw_verdict_trial *trial) {
    const fw_device *full = trial->changed;
    double low = 0, high = 1, *share;
    FW_NEED(share = fw_arena_array(trial->arena, double, (size_t)full->nscene));
    for (int i = 0; i < full->nscene; i++)
        share[i] = trial->share[i];
    for (int i = 0; i < HALVINGS && high - low > known_to * high; i++) {
        double s = 0.5 * (low + high);
        FW_TRY(go_to(trial, full, share, s));
        FW_TRY(fw_verdict_trial_run(trial));
        *(trial->decision == FW_ACCEPT && trial->drawn ? &high : &low) = s;
    }
    FW_TRY(go_to(trial, full, share, high));
    trial->decision = FW_ACCEPT; /* at `high` it was */
    trial->drawn = true;
    return FW_OK;
}
