/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the measured settings say together: errors, front, orders, what a digit costs, honesty. */
#include "study/front.h"
#include "base/sort.h"
#include "study/problem.h"
#include <math.h>
#include <stdlib.h>

/* true errors below this many times the reference's own are not known well enough to be compared */
static const double known = 3;

void fw_study_tradeoff_errors(fw_study_tradeoff *t) {
    const fw_study_tradeoff_point *ref = t->reference.run[0];
    int n = t->mechanism->npin;
    for (int i = 0; i < t->npoint; i++) {
        fw_study_tradeoff_point *p = &t->point[i];
        if (p->state != FW_TRADEOFF_DONE || !ref) continue;
        p->error = fw_study_peaks_differ(p->peak_rad, ref->peak_rad, n);
        p->utilisation_error = fabs(p->utilisation / ref->utilisation - 1);
        p->floor = !(p->error > t->reference.error);
    }
}

bool fw_study_tradeoff_good(const fw_study_tradeoff *t, const fw_study_tradeoff_point *p) {
    const fw_study_tradeoff_point *ref = t->reference.run[0];
    if (p->state != FW_TRADEOFF_DONE || !ref || !(p->error <= t->accuracy)) return false;
    double used = fabs(p->utilisation - ref->utilisation);
    return !(used > 10 * t->accuracy); /* NaN: no hinge has a limit */
}

/* estimated over true error, where the true one is known */
static fw_status honesty(fw_arena *arena, fw_study_tradeoff *t) {
    double *ratio;
    double least = HUGE_VAL;
    FW_NEED(ratio = fw_arena_array(arena, double, (size_t)t->npoint));
    t->least_honest = FW_NONE;
    for (int i = 0; i < t->npoint; i++) {
        const fw_study_tradeoff_point *p = &t->point[i];
        if (p->state != FW_TRADEOFF_DONE || !(p->error > known * t->reference.error)) continue;
        if (i == 0 && t->row && !t->rows_only) continue; /* its error holds that of the model */
        ratio[t->judged++] = p->estimated / p->error;
        if (p->estimated / p->error < least) least = p->estimated / p->error, t->least_honest = i;
        t->honest += p->estimated >= p->error;
    }
    if (t->judged == 0) return FW_OK;
    fw_sort_doubles(ratio, (size_t)t->judged);
    t->honesty[0] = ratio[0];
    t->honesty[1] = 0.5 * (ratio[(t->judged - 1) / 2] + ratio[t->judged / 2]);
    t->honesty[2] = ratio[t->judged - 1];
    return FW_OK;
}

static void orders(fw_study_tradeoff *t) {
    double work[FW_TRADEOFF_TOLERANCES], error[FW_TRADEOFF_TOLERANCES];
    for (int i = 0; i < t->ncurve; i++) {
        fw_study_tradeoff_curve *c = &t->curve[i];
        for (int k = 0; k < c->count; k++) {
            const fw_study_tradeoff_point *p = &t->point[c->first + k];
            bool done = p->state == FW_TRADEOFF_DONE;
            work[k] = done ? (double)p->rhs : (double)NAN;
            error[k] = done ? p->error : (double)NAN;
        }
        c->order = fw_study_front_order(work, error, c->count, known * t->reference.error);
    }
}

fw_status fw_study_tradeoff_judge(fw_arena *arena, fw_study_tradeoff *t) {
    double *cost, *error;
    bool *front;
    size_t n = (size_t)t->npoint;
    FW_NEED(cost = fw_arena_array(arena, double, n));
    FW_NEED(error = fw_arena_array(arena, double, n));
    FW_NEED(front = fw_arena_array(arena, bool, n));
    t->cheapest = FW_NONE;
    for (int i = 0; i < t->npoint; i++) {
        const fw_study_tradeoff_point *p = &t->point[i];
        bool done = p->state == FW_TRADEOFF_DONE;
        /* what is only modelled is not set against what is counted */
        bool comparable = t->instructions_why || p->by != FW_COUNT_MODEL;
        cost[i] = done && comparable ? p->instructions : (double)NAN;
        error[i] = done ? fmax(p->error, t->reference.error) : (double)NAN;
        if (fw_study_tradeoff_good(t, p) && comparable &&
            (t->cheapest < 0 || cost[i] < cost[t->cheapest]))
            t->cheapest = i;
    }
    fw_study_front_mark(cost, error, t->npoint, front);
    for (int i = 0; i < t->npoint; i++)
        t->point[i].front = front[i];
    t->digit_overall = fw_study_front_digit(cost, error, front, t->npoint);
    t->digit_here = fw_study_front_cost(cost, error, front, t->npoint, 0.1 * error[0]) /
                    fw_study_front_cost(cost, error, front, t->npoint, error[0]);
    t->over_cheapest = t->cheapest < 0 ? (double)NAN : cost[0] / cost[t->cheapest];
    orders(t);
    return honesty(arena, t);
}
