/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole comparison: its parts in order, what no tolerance takes away, and what the measured settings say together:
   errors, front, orders, what a digit costs, honesty. */
#include "base/sort.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "process/process.h"
#include "study/tradeoff.h"
#include <math.h>
#include <string.h>

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

/* ---- what no tolerance takes away ----
   How hinges are taken, effects that are left out, solids, and what the flow may make of the device. All by the program's
   own numbers, whose error is far below. */

static const double model_share = 0.03; /* of the budget, for one run */
enum { MOST = 40 };

static fw_study_tradeoff_model *add(fw_study_tradeoff *t, const char *kind, const char *name) {
    fw_study_tradeoff_model *m = &t->model[t->nmodel++];
    *m = (fw_study_tradeoff_model){.kind = kind,
                                   .name = name,
                                   .change = (double)NAN,
                                   .bound = (double)NAN,
                                   .utilisation = (double)NAN,
                                   .instructions = (double)NAN};
    return m;
}

/* the answer of a changed problem by the program's own choice of numbers; point->state says whether
   there is one */
static fw_status answer(fw_study_problem *q, fw_study_tradeoff_point *point) {
    fw_study_tradeoff_setting s = {.quasi_static = q->quasi_static};
    s.most_steps =
        (long)fmax(1000, model_share * q->budget / fw_study_cost_step(q, "chain", "radau5"));
    *point = (fw_study_tradeoff_point){0};
    return fw_study_problem_run(q, &s, point);
}

/* ---- levels of hinges ---- */

static fw_status level(const fw_study_problem *p, fw_study_tradeoff *t,
                       fw_effects_hinge_model wanted, fw_study_tradeoff_point *point) {
    fw_study_problem q = *p;
    fw_study_tradeoff_model *m = add(t, "hinge", fw_effects_hinge_model_text(wanted));
    m->chosen = wanted == p->by_itself->ledger.hinge.used;
    q.effects.hinge = wanted;
    FW_TRY(fw_study_problem_compile(&q));
    point->state = m->state = FW_TRADEOFF_SKIPPED;
    if (q.ledger.hinge.used != wanted) {
        m->why = q.ledger.hinge.why;
        return FW_OK;
    }
    if (m->chosen)
        *point = t->point[0];
    else
        FW_TRY(answer(&q, point));
    m->state = point->state, m->why = point->why;
    if (m->state == FW_TRADEOFF_SKIPPED) m->why = "more steps than its share of the budget allows";
    m->utilisation = point->utilisation;
    m->instructions = point->instructions;
    return FW_OK;
}

static fw_status levels(const fw_study_problem *p, fw_study_tradeoff *t) {
    fw_study_tradeoff_point point[3];
    int best = -1, first = t->nmodel, n = p->mechanism->npin;
    const fw_statics_level_step *step = p->by_itself->level;
    for (int i = 0; i < 3; i++) {
        FW_TRY(level(p, t, (fw_effects_hinge_model)(FW_HINGE_REVOLUTE + i), &point[i]));
        if (point[i].state == FW_TRADEOFF_DONE) best = i;
    }
    for (int i = 0; i <= best; i++) {
        fw_study_tradeoff_model *m = &t->model[first + i];
        if (m->state != FW_TRADEOFF_DONE) continue;
        if (best > 0) m->change = fw_study_peaks_differ(point[i].peak_rad, point[best].peak_rad, n);
        if (m->chosen && step && !step->why_not && step->next != step->used)
            m->bound = step->relative;
    }
    /* the one above could not be run: what it changes was computed at one instant */
    if (best >= 0 && best < 2 && t->model[first + best].chosen)
        t->model[first + best].change = t->model[first + best].bound;
    return FW_OK;
}

/* ---- effects, solids ---- */

static fw_status effects(const fw_study_problem *p, fw_study_tradeoff *t) {
    fw_study_problem q = *p;
    fw_study_tradeoff_point point;
    double *own;
    int n = p->mechanism->npin;
    fw_study_tradeoff_model *m = add(t, "effects", "as chosen");
    q.effects.mode = FW_EFFECTS_ALL;
    q.quasi_static = false; /* inertia is one of them */
    FW_TRY(fw_study_problem_compile(&q));
    FW_TRY(answer(&q, &point));
    m->chosen = true;
    m->state = point.state, m->why = point.why;
    m->bound = p->by_itself->ledger.left_out;
    FW_NEED(own = fw_arena_array(p->arena, double, (size_t)n));
    for (int i = 0; i < n; i++)
        own[i] = p->by_itself->peak[i].angle_rad;
    if (point.state != FW_TRADEOFF_DONE) return FW_OK;
    m->change = fw_study_peaks_differ(own, point.peak_rad, n);
    fw_study_tradeoff_model *all = add(t, "effects", "all");
    all->change = 0;
    all->utilisation = point.utilisation;
    all->instructions = point.instructions;
    return FW_OK;
}

static fw_status solids(const fw_study_problem *p, fw_study_tradeoff *t) {
    if (p->mechanism->nhinge == 0) return FW_OK;
    FW_TRY(fw_verdict_level_strains(p->arena, p->mechanism, p->by_itself->loads,
                                    p->by_itself->level, NULL));
    fw_study_tradeoff_model *m = add(t, "solid", "what the verdict allows for");
    m->change = m->bound = fw_verdict_motion_model_error(p->mechanism, p->by_itself);
    m->chosen = true;
    return FW_OK;
}

/* ---- what the flow may make of it ---- */

static const fw_plan_flow *flow_of(const fw_study_problem *p) {
    for (int i = 0; i < p->plan->nflow; i++)
        if (&p->plan->flow[i].variant == p->mechanism->variant) return &p->plan->flow[i];
    return NULL;
}

static fw_status fabricated_answer(const fw_study_problem *p, const fw_verdict_variant_verdict *v,
                                   const double *x, fw_study_tradeoff_point *point) {
    fw_study_problem q = *p;
    fw_verdict_fabricated_device d;
    const fw_verdict_fabrication fabricated = fw_verdict_fabrication_at(v->input, v->ninput, x);
    const fw_mechanism *built;
    fw_diags own = fw_diags_new(p->arena);
    point->state = FW_TRADEOFF_FAILED;
    FW_TRY(fw_verdict_fabrication_build(p->arena, p->plan->device, p->plan->layout,
                                        p->mechanism->variant, &fabricated, &d));
    if (d.gone) return FW_OK;
    fw_status status = fw_mechanism_build(p->arena, &d.device, d.drawn, &d.variant, &own, &built);
    if (status == FW_OK)
        status = fw_assembly_assembled(p->arena, built, &own, &q.mechanism, &q.moved_m);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    if (status != FW_OK || q.mechanism->npin != p->mechanism->npin) return FW_OK;
    q.scene = fw_mechanism_scene(q.mechanism, p->mechanism->device, p->scene);
    status = fw_study_problem_compile(&q);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    return status == FW_OK ? answer(&q, point) : FW_OK;
}

/* one input of the flow from its nominal value to either end, the others nominal */
static fw_status input(const fw_study_problem *p, const fw_verdict_variant_verdict *v, int i,
                       const fw_study_tradeoff_point *nominal, fw_study_tradeoff_model *m) {
    double x[FW_FABRICATION_INPUTS], most = 0;
    for (int end = 0; end < 2; end++) {
        fw_study_tradeoff_point point = {0};
        for (int k = 0; k < v->ninput; k++)
            x[k] = v->input[k].nominal;
        x[i] = end ? v->input[i].high : v->input[i].low;
        FW_TRY(fabricated_answer(p, v, x, &point));
        m->state = point.state;
        m->why = point.state == FW_TRADEOFF_DONE ? NULL : "no such device, or over the budget";
        if (point.state != FW_TRADEOFF_DONE) return FW_OK;
        most = fmax(most,
                    fw_study_peaks_differ(point.peak_rad, nominal->peak_rad, p->mechanism->npin));
    }
    m->change = most;
    return FW_OK;
}

static fw_status process(const fw_study_problem *p, fw_study_tradeoff *t) {
    const fw_plan_flow *pf = flow_of(p);
    fw_verdict_variant_verdict v = {0};
    fw_process_mask_facts facts;
    double x[FW_FABRICATION_INPUTS];
    if (!pf || !pf->flow || !p->plan->layout || !p->plan->layout->drawn) return FW_OK;
    FW_TRY(
        fw_plan_edge_facts(p->arena, p->plan->device, p->plan->layout, pf, &pf->variant, &facts));
    FW_TRY(fw_plan_join_swept(p->plan, p->arena, (int)(pf - p->plan->flow), &facts));
    FW_TRY(
        fw_process_flow_fabricated(p->arena, pf->flow, &facts, &pf->variant, &v.input, &v.ninput));
    fw_study_tradeoff_point nominal = {0};
    for (int k = 0; k < v.ninput; k++)
        x[k] = v.input[k].nominal;
    if (v.ninput > 0) FW_TRY(fabricated_answer(p, &v, x, &nominal));
    for (int i = 0; i < v.ninput && nominal.state == FW_TRADEOFF_DONE && !v.input[i].open; i++)
        FW_TRY(input(p, &v, i, &nominal, add(t, "process", v.input[i].name)));
    return FW_OK;
}

fw_status fw_study_tradeoff_models(fw_study_problem *p, fw_study_tradeoff *t) {
    FW_NEED(t->model = fw_arena_array(p->arena, fw_study_tradeoff_model, MOST));
    if (p->mechanism->nhinge > 0) FW_TRY(levels(p, t));
    FW_TRY(effects(p, t));
    FW_TRY(solids(p, t));
    FW_TRY(process(p, t));
    t->floor = (double)NAN;
    for (int i = 0; i < t->nmodel; i++) {
        const fw_study_tradeoff_model *m = &t->model[i];
        if (!m->chosen || !isfinite(m->change) || m->change <= 0) continue;
        if (!(m->change <= t->floor)) t->floor = m->change, t->floor_what = m->kind;
    }
    return FW_OK;
}

/* ---- the mask: chord error of arcs against vertices and bytes of the GDSII ---- */

static const double tolerance_m[] = {2e-9, 5e-9, 10e-9, 20e-9, 50e-9, 100e-9, 200e-9, 500e-9};
enum { COUNT = sizeof tolerance_m / sizeof tolerance_m[0] };

/* the flow of the scene, where it has a layer table; NULL: there is no mask to make */
static fw_plan_flow *masked_flow(const fw_study_problem *p) {
    for (int i = 0; i < p->plan->nflow; i++) {
        fw_plan_flow *pf = &p->plan->flow[i];
        if (pf->flow && pf->table && &pf->variant == p->mechanism->variant) return pf;
    }
    return NULL;
}

static double narrowest_m(const fw_device *device) {
    double least = HUGE_VAL;
    for (int i = 0; i < device->nflexure; i++)
        if (device->flexure[i].width_m > 0) least = fmin(least, device->flexure[i].width_m);
    return least;
}

/* In: m, farthest that an edge is off; width of the narrowest flexure. Stiffness goes with the cube
   of the width, which two edges change: of a deflection under given loads at most 6 e / w to first
   order. Relative. Source: Euler-Bernoulli. Test: test_tradeoff.py. */
static double deflection(double edge_m, double width_m) {
    return isfinite(width_m) ? 6 * edge_m / width_m : (double)NAN;
}

static fw_status one(fw_study_problem *p, const fw_plan_flow *pf, const fw_layout *layout,
                     double tolerance, fw_study_tradeoff_mask *out, bool *fabricated) {
    fw_plan *plan = p->plan;
    fw_mask_options options = {.bias_m = pf->flow->bias_m,
                               .tolerance_m = tolerance,
                               .vertex_limit = plan->options.mask_vertices,
                               .thickness_m = pf->variant.thickness_m,
                               .no_islands = !fw_plan_insulated(pf)};
    if (!fw_mask_flattening_named(plan->options.mask_flatten, &options.flattening)) return FW_USAGE;
    FW_TRY(fw_plan_layer_bias(plan, pf, &options.layer_bias_m));
    fw_mark mark = fw_arena_mark(p->arena);
    fw_diags own = fw_diags_new(p->arena);
    const fw_mask *mask = NULL;
    fw_status status =
        fw_mask_examine(p->arena, layout, pf->table, plan->device->name, &options, &own, &mask);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    *fabricated = mask && mask->whole;
    if (*fabricated) {
        fw_text gds = fw_text_new(p->arena);
        FW_TRY(fw_mask_write_gds(mask, &gds));
        *out = (fw_study_tradeoff_mask){.tolerance_m = tolerance, .bytes = (long)gds.length};
        for (int i = 0; i < mask->table->nlayer; i++) {
            out->vertices += mask->measure[i].vertices;
            out->edge_m = fmax(out->edge_m, mask->measure[i].edge_m);
        }
        out->deflection = deflection(out->edge_m, narrowest_m(plan->device));
    }
    fw_arena_rewind(p->arena, mark);
    return FW_OK;
}

fw_status fw_study_tradeoff_masks(fw_study_problem *p, fw_study_tradeoff *t) {
    fw_plan_flow *pf = masked_flow(p);
    const fw_layout *layout;
    fw_layout_no_room no_room;
    if (!pf) t->mask_why = "the device names no process flow";
    if (pf && (!p->plan->layout || !p->plan->layout->drawn))
        t->mask_why = "the device has no shapes to draw";
    if (!t->mask_why && !pf->flow->edges.solved)
        t->mask_why = "no bias brings the edges to where they are drawn";
    if (t->mask_why) return FW_OK;
    FW_NEED(t->mask = fw_arena_array(p->arena, fw_study_tradeoff_mask, COUNT));
    FW_TRY(fw_mask_frame_marks(p->arena, pf->table, p->plan->layout, &layout, &no_room));
    double usual = p->plan->options.mask_tolerance_m;
    if (!(usual > 0)) usual = 5e-9;
    for (int i = 0; i < COUNT; i++) {
        bool fabricated = false;
        FW_TRY(one(p, pf, layout, tolerance_m[i], &t->mask[t->nmask], &fabricated));
        if (!fabricated) continue;
        t->mask[t->nmask].usual = fabs(tolerance_m[i] / usual - 1) < 1e-6;
        t->nmask++;
    }
    if (t->nmask == 0) t->mask_why = "the mask cannot be drawn; see flexwright mask";
    return FW_OK;
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
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
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
