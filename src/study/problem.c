/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device and one scene with everything but the numbers decided: what something will cost before
   it is run, the problem itself, one answer.

   The model of costs depends on counts alone, so that the same settings are run on every
   machine: how large a part of the budget something takes, where nothing counts instructions. */
#include "study/tradeoff.h"
#include "maths/ode.h"
#include "multibody/system.h"
#include "plan/stages.h"
#include "statics/statics.h"
#include "verdict/strain.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* hinges that give are springs, not constraints: without any constraint all methods are alike */
static bool constrained(const fw_study_problem *p) {
    const fw_mechanism *m = p->mechanism;
    return m->npin - p->loads.nreleased + m->njoint + m->ndriver > 0;
}

double fw_study_cost_rhs(const fw_study_problem *p, const char *method) {
    double effects = 0, times = (1 + p->mechanism->nbody) / 6.0;
    for (int i = 0; i < p->ledger.count; i++)
        if (p->ledger.item[i].active) effects += p->ledger.item[i].cost;
    const fw_multibody_method *row = method ? fw_multibody_method_find(method) : NULL;
    if (!row || !constrained(p)) row = fw_multibody_method_find(NULL);
    return effects + row->cost.six_bar * pow(times, row->cost.power);
}

static const fw_maths_stepper_row *stepper(const char *integrator) {
    return integrator ? fw_maths_stepper_find(integrator) : NULL;
}

double fw_study_cost_answer(const fw_study_problem *p, const fw_study_tradeoff_point *point) {
    double n = 3.0 * p->mechanism->nbody;
    const fw_maths_stepper_row *row = stepper(point->integrator);
    /* iterations evaluate more than they count */
    double kind = row && row->implicit ? 2 : 1;
    double lean = row && row->rhs_per_count > 0 ? row->rhs_per_count : kind;
    return lean * (double)point->rhs * fw_study_cost_rhs(p, point->method) +
           (double)point->factorisations * (2.5 * n * n * n + 50 * n * n);
}

double fw_study_cost_step(const fw_study_problem *p, const char *method, const char *integrator) {
    const fw_maths_stepper_row *row = stepper(integrator);
    double n = 3.0 * p->mechanism->nbody, rhs = fw_study_cost_rhs(p, method);
    /* strains are watched at so many instants of every step, each of which solves for the forces */
    double looks = p->mechanism->nhinge > 0 ? FW_INSTANTS : 0;
    if (row && row->rhs_per_step > 0) return row->rhs_per_step * rhs;
    if (row && row->implicit) return (20 + looks) * rhs + 2.5 * n * n * n + 50 * n * n;
    return ((row && row->order < 6 ? 7 : 15) + looks) * rhs;
}

double fw_study_cost_digit(const char *integrator) {
    const fw_maths_stepper_row *row = stepper(integrator);
    double order = row ? row->order : 8;
    return pow(10, 1 / fmin(order, 8)); /* those of variable order reach some 8 */
}

/* ---- everything but the numbers, decided once ---- */

static const double fw_nominal_rate = 2.5e9; /* instructions a second of the budget */

fw_status fw_study_problem_compile(fw_study_problem *p) {
    FW_TRY(fw_effects_compile(p->arena, p->mechanism, p->scene, &p->effects, p->accuracy,
                              &p->plan->diags, &p->ledger, &p->loads));
    p->ledger.left_out = 0;        /* errors of the numbers, not of the model */
    p->loads.quasi_static = false; /* integrators are compared: inertia acts */
    return FW_OK;
}

static fw_status start(fw_plan *plan, fw_study_problem *p) {
    const fw_dynamics_motion_options *wanted = &plan->options.verdict.motion;
    *p = (fw_study_problem){.plan = plan,
                            .arena = plan->arena,
                            .accuracy = wanted->accuracy > 0 ? wanted->accuracy : 1e-3,
                            .effects = wanted->effects};
    return fw_plan_start(plan, &p->mechanism, &p->scene, &p->moved_m);
}

/* exact beams take some 25 000 instructions each, and several times as many as are known before */
static long beams(double budget) {
    return (long)fmax(1, 0.03 * budget / 25000);
}

/* the larger of angle over limit angle and strain over limit strain, as the verdict has it */
static double utilisation_of(const fw_mechanism *m, const fw_dynamics_motion *motion,
                             const void *monitor) {
    const fw_verdict_strain_monitor *w = monitor;
    double most = (double)NAN;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_flexure_result *c = &m->hinge[k].closed_form;
        double angle = fabs(motion->peak[m->hinge[k].pin].angle_rad) / c->limit_angle_rad;
        double strain = w ? w->hinge[k].strain.value / (c->limit_angle_rad * c->strain_per_rad) : 0;
        if (isfinite(angle)) most = fmax(most, fmax(angle, strain)); /* fmax passes by NaN */
    }
    return most;
}

/* Hinges may hold a stage so that they hardly turn, and bend by the forces that they carry. Where turning is less of what
   they use than the accuracy wanted, errors relative to the peak angle are nothing that the verdict goes by, and simulate
   does not choose its tolerance by them. */
static fw_status something_turns(fw_study_problem *p, const fw_verdict_strain_monitor *saw) {
    double most = 0;
    for (int i = 0; i < p->by_itself->npin; i++)
        most = fmax(most, fabs(p->by_itself->peak[i].angle_rad));
    const double turned = utilisation_of(p->mechanism, p->by_itself, NULL),
                 used = utilisation_of(p->mechanism, p->by_itself, saw);
    if (most > 1e-10 && !(turned < p->accuracy * used)) return FW_OK;
    return fw_diag_error(&p->plan->diags, 290, p->scene->place,
                         "%s%s: no joint turns%s, so that there is no peak deflection whose "
                         "error could be shown; choose another with --scene, or load it",
                         FW_NAMED("scene", fw_text_name(p->scene->name)),
                         most > 1e-10 ? " by more than the accuracy wanted of what hinges use "
                                        "(they bend by the forces that they carry, and by these "
                                        "check judges them)"
                                      : "");
}

static fw_status look(fw_study_problem *p, double budget) {
    fw_dynamics_motion_options o = p->plan->options.verdict.motion;
    fw_verdict_strain_monitor saw, looser;
    o.moved_m = p->moved_m;
    o.samples = 1001; /* the level of hinges is looked at in the row nearest the peak */
    o.most_beams = beams(budget);
    FW_TRY(fw_verdict_strain_monitor_new(p->arena, p->mechanism, false, &saw));
    FW_TRY(fw_verdict_strain_monitor_new(p->arena, p->mechanism, false, &looser));
    if (p->mechanism->nhinge > 0) fw_verdict_strain_monitor_watch(&saw, &o), o.other = &looser;
    FW_TRY(fw_statics_move_scene(p->arena, p->mechanism, p->scene, &o, &p->plan->diags,
                                 &p->by_itself));
    if (saw.no_memory) return FW_NOMEM;
    p->quasi_static = p->by_itself->loads->quasi_static;
    return something_turns(p, p->by_itself->observed ? p->by_itself->observed : &saw);
}

fw_status fw_study_problem_open(fw_plan *plan, double budget_s, fw_study_problem *p) {
    FW_TRY(start(plan, p));
    p->budget = budget_s * fw_nominal_rate;
    FW_TRY(look(p, p->budget));
    p->effects.hinge = p->by_itself->ledger.hinge.used;
    return fw_study_problem_compile(p);
}

fw_status fw_study_problem_at_level(fw_plan *plan, fw_effects_hinge_model level,
                                    fw_study_problem *p) {
    FW_TRY(start(plan, p));
    p->effects.hinge = level;
    return fw_study_problem_compile(p);
}

/* ---- one answer: the motion by one setting, its peaks and what it uses of the hinges ---- */

static fw_dynamics_motion_options options_of(const fw_study_problem *p,
                                             const fw_study_tradeoff_setting *s) {
    fw_dynamics_motion_options o = p->plan->options.verdict.motion;
    o.method = s->method;
    o.integrator = s->integrator;
    o.rtol = s->rtol;
    o.accuracy = p->accuracy;
    o.samples = 2;
    o.effects = p->effects;
    o.moved_m = p->moved_m;
    o.most_steps = s->most_steps;
    return o;
}

static fw_status move(const fw_study_problem *p, const fw_study_tradeoff_setting *s,
                      const fw_dynamics_motion_options *o, fw_diags *diags,
                      const fw_dynamics_motion **motion) {
    if (!s->quasi_static)
        return fw_dynamics_simulate_compiled(p->arena, p->mechanism, p->scene, o, &p->ledger,
                                             &p->loads, diags, motion);
    const char *why;
    fw_effects_loads resting = p->loads;
    fw_dynamics_motion_options at = *o;
    resting.quasi_static = true;
    if (s->rtol > 0) at.accuracy = s->rtol; /* equilibria have no other tolerance */
    at.rtol = 0;
    return fw_statics_quasi_static_motion(p->arena, p->mechanism, p->scene, &at, &p->ledger,
                                          &resting, diags, motion, &why);
}

__attribute__((noinline)) fw_status fw_study_tradeoff_answer(const fw_study_problem *p,
                                                             const fw_study_tradeoff_setting *s,
                                                             fw_diags *diags,
                                                             const fw_dynamics_motion **motion) {
    const fw_dynamics_motion_options o = options_of(p, s);
    return move(p, s, &o, diags, motion);
}

/* ---- what it says ---- */

static double largest_peak(const double *a, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i]));
    return most;
}

double fw_study_peaks_differ(const double *a, const double *ref, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(fabs(a[i]) - fabs(ref[i])));
    return most / largest_peak(ref, n);
}

static void take(const fw_study_problem *p, const fw_dynamics_motion *x,
                 const fw_verdict_strain_monitor *w, fw_study_tradeoff_point *point) {
    double left_out = fw_dynamics_motion_left_out(x), error = 0;
    for (int i = 0; i < x->npin; i++) {
        point->peak_rad[i] = x->peak[i].angle_rad;
        error = fmax(error, x->peak[i].error_rad - left_out);
    }
    point->method = x->method ? x->method : "equilibria";
    point->integrator = x->integrator ? x->integrator : "none";
    point->rtol = x->stats.rtol;
    point->estimated = error / largest_peak(point->peak_rad, x->npin);
    point->utilisation = utilisation_of(p->mechanism, x, w);
    point->steps = x->stats.steps, point->rejected = x->stats.rejected, point->rhs = x->stats.rhs;
    point->jacobians = x->stats.jacobians, point->factorisations = x->stats.factorisations;
    point->instructions = fw_study_cost_answer(p, point);
    point->by = FW_COUNT_MODEL;
    point->state = FW_TRADEOFF_DONE;
}

/* the message of the last error, which outlives the arena that is given back */
static void failed(const fw_diags *diags, fw_status status, char *buffer, size_t n,
                   fw_study_tradeoff_point *point) {
    const char *say = fw_status_text(status);
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].severity == FW_ERROR) say = diags->item[i].message;
    strncpy(buffer, say, n - 1);
    buffer[n - 1] = '\0';
    point->state = status == FW_LIMIT ? FW_TRADEOFF_SKIPPED : FW_TRADEOFF_FAILED;
}

fw_status fw_study_problem_run(fw_study_problem *p, const fw_study_tradeoff_setting *s,
                               fw_study_tradeoff_point *point) {
    char why[400] = "";
    fw_dynamics_motion_options o = options_of(p, s);
    fw_verdict_strain_monitor saw, looser;
    const fw_dynamics_motion *motion = NULL;
    if (!point->peak_rad) /* outlives the run */
        FW_NEED(point->peak_rad = fw_arena_array(p->arena, double, (size_t)p->mechanism->npin));
    point->error = point->utilisation_error = point->utilisation = (double)NAN;
    point->estimated = point->instructions = (double)NAN;
    point->method = s->method ? s->method : "auto";
    point->integrator = s->integrator ? s->integrator : "auto";
    point->rtol = s->rtol;
    fw_mark mark = fw_arena_mark(p->arena);
    fw_diags own = fw_diags_new(p->arena);
    FW_TRY(fw_verdict_strain_monitor_new(p->arena, p->mechanism, false, &saw));
    FW_TRY(fw_verdict_strain_monitor_new(p->arena, p->mechanism, false, &looser));
    if (p->mechanism->nhinge > 0) fw_verdict_strain_monitor_watch(&saw, &o), o.other = &looser;
    fw_status status = move(p, s, &o, &own, &motion);
    if (status == FW_NOMEM || status == FW_CANCELLED || own.failed || saw.no_memory)
        return status == FW_CANCELLED ? status : FW_NOMEM;
    if (status == FW_OK)
        take(p, motion, motion->observed ? motion->observed : &saw, point);
    else
        failed(&own, status, why, sizeof why, point);
    fw_arena_rewind(p->arena, mark);
    if (status == FW_OK) return FW_OK;
    return (point->why = fw_arena_strdup(p->arena, why)) ? FW_OK : FW_NOMEM;
}
