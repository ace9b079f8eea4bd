/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One answer: the motion of the scene by one setting, its peaks and what it uses of the hinges. */
#include "statics/quasi.h"
#include "study/problem.h"
#include "verdict/strain_monitor.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    if (!s->row)
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

double fw_study_peaks_largest(const double *a, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i]));
    return most;
}

double fw_study_peaks_differ(const double *a, const double *ref, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(fabs(a[i]) - fabs(ref[i])));
    return most / fw_study_peaks_largest(ref, n);
}

/* the larger of angle over limit angle and strain over limit strain, as the verdict has it */
double fw_study_problem_utilisation(const fw_mechanism *m, const fw_dynamics_motion *motion,
                                    const void *monitor) {
    const fw_verdict_strain_monitor *w = monitor;
    double most = (double)NAN;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_flexure_result *c = &m->hinge[k].closed_form;
        double angle = fabs(motion->peak[m->hinge[k].pin].angle_rad) / c->limit_angle_rad;
        double strain = w ? w->hinge[k].strain / (c->limit_angle_rad * c->strain_per_rad) : 0;
        if (isfinite(angle)) most = fmax(most, fmax(angle, strain)); /* fmax passes by NaN */
    }
    return most;
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
    point->estimated = error / fw_study_peaks_largest(point->peak_rad, x->npin);
    point->utilisation = fw_study_problem_utilisation(p->mechanism, x, w);
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
    FW_TRY(fw_verdict_strain_monitor_new(p->arena, p->mechanism, p->plan->layout, false, &saw));
    FW_TRY(fw_verdict_strain_monitor_new(p->arena, p->mechanism, p->plan->layout, false, &looser));
    if (p->mechanism->nhinge > 0)
        o.observe = fw_verdict_strain_monitor_record, o.context = &saw, o.other = &looser;
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
