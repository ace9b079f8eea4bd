/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole comparison: its parts in order, and what the measured settings say together: errors,
   front, orders, what a digit costs, honesty. */
#include "base/sort.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "study/tradeoff_parts.h"
#include "study/tradeoff.h"
#include <math.h>

/* ---- cost against error ---- */

static bool real(double x) {
    return isfinite(x) && x > 0;
}

void fw_study_front_mark(const double *cost, const double *error, int n, bool *front) {
    for (int i = 0; i < n; i++) {
        front[i] = real(cost[i]) && real(error[i]);
        for (int k = 0; k < n && front[i]; k++) {
            if (k == i || !real(cost[k]) || !real(error[k])) continue;
            bool less = cost[k] < cost[i] || error[k] < error[i] || k < i;
            if (cost[k] <= cost[i] && error[k] <= error[i] && less) front[i] = false;
        }
    }
}

/* the dearest front point that does not reach it and the cheapest that does; -1: none */
static void neighbours(const double *cost, const double *error, const bool *front, int n,
                       double wanted, int *below, int *reached) {
    *below = *reached = -1;
    for (int i = 0; i < n; i++) {
        if (!front[i]) continue;
        if (error[i] <= wanted) {
            if (*reached < 0 || cost[i] < cost[*reached]) *reached = i;
        } else if (*below < 0 || cost[i] > cost[*below])
            *below = i;
    }
}

double fw_study_front_cost(const double *cost, const double *error, const bool *front, int n,
                           double wanted) {
    int a, b;
    neighbours(cost, error, front, n, wanted, &a, &b);
    if (b < 0) return (double)NAN;
    if (a < 0) return cost[b];
    double part = log(error[a] / wanted) / log(error[a] / error[b]);
    return cost[a] * pow(cost[b] / cost[a], part);
}

double fw_study_front_digit(const double *cost, const double *error, const bool *front, int n) {
    int cheap = -1, best = -1;
    for (int i = 0; i < n; i++) {
        if (!front[i]) continue;
        if (cheap < 0 || cost[i] < cost[cheap]) cheap = i;
        if (best < 0 || error[i] < error[best]) best = i;
    }
    if (cheap < 0) return (double)NAN;
    double digits = log10(error[cheap] / error[best]);
    return digits < 0.5 ? (double)NAN : pow(cost[best] / cost[cheap], 1 / digits);
}

double fw_study_front_order(const double *work, const double *error, int n, double least) {
    double count = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < n; i++) {
        if (!real(work[i]) || !real(error[i]) || error[i] <= least) continue;
        double u = log(work[i]), v = -log(error[i]);
        count++, x += u, y += v, xx += u * u, xy += u * v;
    }
    double spread = xx - x * x / fmax(count, 1);
    if (count < 3 || !(spread > 1e-6)) return (double)NAN;
    return (xy - x * y / count) / spread;
}

/* ---- the comparison ---- */

/* true errors below this many times the reference's own are not known well enough to be compared */
static const double known = 3;

/* errors by the reference; and with costs known front, digits, honesty, what is drawn */
static void find_errors(fw_study_tradeoff *t) {
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

/* estimated over true error, where the true one is known */
static fw_status honesty(fw_arena *arena, fw_study_tradeoff *t) {
    double *ratio;
    double least = HUGE_VAL;
    FW_NEED(ratio = fw_arena_array(arena, double, (size_t)t->npoint));
    t->least_honest = FW_NONE;
    for (int i = 0; i < t->npoint; i++) {
        const fw_study_tradeoff_point *p = &t->point[i];
        if (p->state != FW_TRADEOFF_DONE || !(p->error > known * t->reference.error)) continue;
        if (i == 0 && t->quasi_static && !t->quasi_static_only)
            continue; /* its error holds that of the model */
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

static fw_status judge_settings(fw_arena *arena, fw_study_tradeoff *t) {
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

/* ---- the whole ---- */

static const double usual_budget_s = 20;

/* what simulate does by itself is the first point; where that is quasi-static its error will
   hold what inertia does */
static fw_status own(fw_study_problem *p, fw_study_tradeoff *t) {
    const fw_study_tradeoff_setting s = {.quasi_static = p->quasi_static};
    FW_NEED(t->point = fw_arena_array(p->arena, fw_study_tradeoff_point, 1));
    t->npoint = 1;
    FW_TRY(fw_study_problem_run(p, &s, &t->point[0]));
    if (t->point[0].state == FW_TRADEOFF_DONE) return FW_OK;
    fw_diag_error(&p->plan->diags, 290, p->scene->place, "%s%s: %s",
                  FW_NAMED("scene", fw_text_name(p->scene->name)), t->point[0].why);
    return FW_SOLVER;
}

static void say(const fw_study_problem *p, const fw_study_tradeoff *t) {
    fw_diags *d = &p->plan->diags;
    const fw_study_tradeoff_reference *r = &t->reference;
    if (t->instructions_why)
        fw_diag_note(
            d, 291, p->scene->place,
            "instructions were not counted (%s): costs are right-hand sides times what one "
            "is known to take, good to a factor of two",
            t->instructions_why);
    if (!r->run[1])
        fw_diag_warning(d, 292, p->scene->place,
                        "there is no second run at a tight tolerance to compare the reference "
                        "with, so the stated errors are unconfirmed; a larger --budget may "
                        "allow one");
    else if (!r->independent)
        fw_diag_warning(
            d, 292, p->scene->place,
            "the two reference runs share a method or an integrator with each other or with "
            "what is measured (%s + %s, %s + %s): an error of that method or integrator would "
            "not be noticed",
            r->run[0]->method, r->run[0]->integrator, r->run[1]->method, r->run[1]->integrator);
}

fw_status fw_study_tradeoff_run(fw_plan *plan, const fw_study_tradeoff_options *options,
                                const fw_study_tradeoff **out) {
    fw_study_problem p;
    double budget = options->budget_s > 0 ? options->budget_s : usual_budget_s;
    fw_study_tradeoff *t = fw_arena_one(plan->arena, fw_study_tradeoff);
    FW_NEED(t);
    *out = NULL;
    FW_TRY(fw_study_problem_open(plan, budget, &p));
    *t = (fw_study_tradeoff){.mechanism = p.mechanism,
                             .scene = p.scene,
                             .device = plan->device->name,
                             .flow = p.mechanism->variant->flow,
                             .accuracy = p.accuracy,
                             .level = fw_effects_hinge_model_text(p.effects.hinge),
                             .level_why = p.by_itself->ledger.hinge.why,
                             .duration_s = p.scene->duration_s,
                             .chosen_why = p.by_itself->reason,
                             .quasi_static = p.quasi_static,
                             .budget_s = budget,
                             .honesty = {(double)NAN, (double)NAN, (double)NAN}};
    FW_TRY(own(&p, t));
    FW_TRY(fw_study_tradeoff_find_reference(&p, t));
    if (!t->quasi_static_only) FW_TRY(fw_study_tradeoff_grid(&p, t));
    find_errors(t);
    FW_TRY(fw_plan_compute_flows(plan));
    FW_TRY(fw_study_tradeoff_models(&p, t));
    FW_TRY(fw_study_tradeoff_masks(&p, t));
    FW_TRY(fw_study_tradeoff_count(&p, options, t));
    FW_TRY(judge_settings(plan->arena, t));
    FW_TRY(fw_study_tradeoff_times(&p, options, t));
    say(&p, t);
    *out = t;
    return FW_OK;
}

/* ---- fw_design_tradeoff of the public library: the stage, and who composes its documents. ---- */

static fw_status work(fw_design *d, void *argument) {
    FW_TRY(fw_study_tradeoff_run(d->plan, argument, &d->tradeoff));
    d->tradeoff_document[0] = fw_study_tradeoff_json;
    d->tradeoff_document[1] = fw_study_tradeoff_text;
    d->tradeoff_document[2] = fw_study_tradeoff_csv;
    d->tradeoff_document[3] = fw_study_tradeoff_svg;
    return FW_OK;
}

int fw_design_tradeoff(fw_design *design, double budget_s, int times) {
    fw_study_tradeoff_options options = {.budget_s = budget_s, .times = times != 0};
    if (!design) return FW_STATUS_USAGE;
    if (!(budget_s == 0 || (budget_s >= 1 && budget_s <= 3600)))
        return (int)fw_plan_design_usage(design, "the budget of tradeoff is 1 to 3600 s, or 0");
    if (!(design->done & FW_DONE_READ))
        return (int)fw_plan_design_usage(design, "read a description before its tradeoff");
    if (design->done & FW_DONE_TRADEOFF) return FW_STATUS_OK;
    int status = fw_plan_design_run(design, work, &options);
    if (status == FW_STATUS_OK) design->done |= FW_DONE_TRADEOFF;
    fw_plan_design_forget_documents(design);
    return status;
}
