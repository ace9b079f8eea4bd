/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One scene: tolerance, two runs (the answer, and a looser one that its error is estimated from),
   statistics. */
#include "dynamics/run.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <time.h>

/* beyond 1e-5 a step of order 8 spans whole oscillations and its estimates mean little */
static const double fw_tightest = 1e-13, fw_loosest = 1e-5;

static double cpu_seconds(void) {
    struct timespec now;
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* where m r^2/J is huge the accelerations carry round-off of 1e-16 m r^2/J; below some 1e-3 of that
   the error estimate follows noise, and steps shrink for nothing */
static double noise_floor(const fw_model *m) {
    double ratio = 0;
    for (int i = 0; i < 2 * m->nblock; i++) {
        int b = m->body[i];
        double x = m->local[2 * i], y = m->local[2 * i + 1];
        if (b < m->nbody) ratio = fmax(ratio, m->jinv[b] / m->minv[b] * (x * x + y * y));
    }
    return 3e-19 * ratio;
}

static double chosen_rtol(const fw_motion_options *o, const fw_model *m) {
    double accuracy = o->accuracy > 0 ? o->accuracy : 1e-3;
    double rtol = o->rtol > 0 ? o->rtol : fmin(1e-6, 1e-4 * accuracy);
    return fmin(fw_loosest, fmax(fmax(fw_tightest, noise_floor(m)), rtol));
}

/* ---- the two runs ---- */

typedef struct pass {
    fw_stepper *stepper;
    fw_peaks peaks;
    fw_extreme *extreme; /* (channels) or NULL */
} pass;

/* a fixed step has no tolerance: h = rtol^(1/4) scaled makes its error go with rtol, too */
static fw_status run_once(fw_run *r, double rtol, bool full, pass *p) {
    fw_model *m = r->model;
    const fw_ode ode = {.context = m,
                        .rhs = fw_model_rhs,
                        .project = fw_model_project,
                        .n = m->ny,
                        .controlled = 2 * m->nq,
                        .positions = m->nq};
    double *atol;
    FW_NEED(atol = fw_arena_array(r->arena, double, (size_t)m->ny));
    for (int i = 0; i < m->ny; i++)
        atol[i] = fmax(rtol * r->amplitude, 2e-15);
    FW_TRY(fw_peaks_new(r->arena, r->mechanism, r->q0, &p->peaks));
    r->extreme = NULL;
    if (r->options->reactions)
        FW_NEED(r->extreme = fw_arena_array(r->arena, fw_extreme, (size_t)fw_run_channels(r)));
    FW_TRY(fw_stepper_new(r->arena, r->integrator, &ode, rtol, atol, &p->stepper));
    p->stepper->h_fixed = pow(rtol, 0.25);
    p->extreme = r->extreme;
    r->full = full;
    fw_status status = fw_run_pass(r, p->stepper, &p->peaks);
    fw_stepper_free(p->stepper); /* what a library holds for it; its results stay */
    return status;
}

static void take_statistics(fw_run *r, const fw_stepper *s, double rtol, double cpu_s) {
    const fw_model *m = r->model;
    const fw_scale unit = m->scale;
    fw_motion_stats *stats = &r->motion->stats;
    double speed = unit.length_m / unit.time_s;
    stats->cpu_s = cpu_s;
    stats->steps = s->steps, stats->rejected = s->rejected, stats->rhs = s->rhs;
    stats->jacobians = s->jacobians, stats->factorisations = s->factorisations;
    stats->projections = m->projections;
    stats->events = m->events;
    stats->max_constraint_norm = m->worst_position;
    stats->max_velocity_norm = m->worst_velocity;
    stats->energy_error = r->largest > 0 ? r->drift / r->largest : 0;
    stats->largest_energy_J = r->largest * unit.mass_kg * speed * speed;
    stats->rtol = rtol;
}

/* error of each peak from a second run at a hundred times the tolerance: the largest change of any
   pin's peak, and of any pin's angle at the end where errors of phase show too, because one number
   may agree by chance; and round-off. Output rad. Never below the true error in 40 000 random cases
   (at ten times the tolerance it was in 7 of 80 000), and about a thousand times above it in the
   geometric mean. Source: tolerance proportionality, Hairer, Norsett and Wanner I, II.4. Test:
   test_peak.c. */
static void estimate_errors(fw_run *r, const pass *fine, const pass *coarse) {
    const fw_stepper *s = fine->stepper, *check = coarse->stepper;
    double worst = 0, unit = r->model->scale.time_s;
    for (int i = 0; i < fine->peaks.npin; i++) {
        double end =
            fw_peaks_angle(&fine->peaks, i, s->y) - fw_peaks_angle(&coarse->peaks, i, check->y);
        double change = fabs(fine->peaks.peak[i].angle_rad) - fabs(coarse->peaks.peak[i].angle_rad);
        worst = fmax(worst, fmax(fabs(change), fabs(end)));
    }
    for (int i = 0; i < fine->peaks.npin; i++) {
        fw_peak *p = &r->motion->peak[i];
        *p = fine->peaks.peak[i];
        p->t_s *= unit;
        p->error_rad =
            worst + DBL_EPSILON * (double)(8 + s->steps) * (1 + fabs(p->angle_rad)) +
            r->motion->stats.energy_error * fabs(p->angle_rad); /* never below the books */
    }
    if (fine->extreme) fw_run_take_extremes(r, fine->extreme, coarse->extreme, s->steps);
}

static bool good_enough(const fw_run *r) {
    const fw_motion_options *o = r->options;
    double accuracy = o->accuracy > 0 ? o->accuracy : 1e-3, most = 0, error = 0;
    for (int i = 0; i < r->motion->npin; i++) {
        most = fmax(most, fabs(r->motion->peak[i].angle_rad));
        error = fmax(error, r->motion->peak[i].error_rad);
    }
    return error <= accuracy * most && (!o->reactions || fw_run_extremes_good(r, accuracy));
}

static fw_status solve(fw_run *r) {
    const fw_motion_options *o = r->options;
    double rtol = chosen_rtol(o, r->model), tightest = fmax(fw_tightest, noise_floor(r->model));
    int rows = r->motion->nsample;
    for (;;) {
        r->motion->nsample = rows;
        pass fine, coarse;
        double began = cpu_seconds();
        FW_TRY(run_once(r, rtol, true, &fine));
        double between = cpu_seconds();
        take_statistics(r, fine.stepper, rtol, between - began);
        FW_TRY(run_once(r, 100 * rtol, false, &coarse));
        r->motion->stats.estimate_cpu_s = cpu_seconds() - between;
        estimate_errors(r, &fine, &coarse);
        /* a tolerance of our own choosing is tightened until the estimate is good enough */
        if (o->rtol > 0 || r->motion->ended || good_enough(r) || rtol <= tightest) return FW_OK;
        rtol = fmax(tightest, rtol / 100);
    }
}

/* ---- the entry ---- */

static fw_status assembled(fw_run *r) {
    const fw_mechanism *m = r->mechanism;
    FW_NEED(r->q0 = fw_arena_array(r->arena, double, 3 * (size_t)m->nbody));
    for (int b = 0; b < m->nbody; b++) {
        r->q0[3 * b] = m->body[b].x_m;
        r->q0[3 * b + 1] = m->body[b].y_m;
        r->q0[3 * b + 2] = m->body[b].phi_rad;
    }
    double moved;
    FW_TRY(fw_assemble(r->arena, m, r->q0, &moved, r->diags));
    r->motion->stats.assembly_moved_m = fmax(moved, r->options->moved_m);
    return FW_OK;
}

static void set_stabilisation(fw_run *r) {
    const char *wanted = r->options->stabilise ? r->options->stabilise : "projection";
    r->motion->stabilise = wanted;
    r->model->projecting = strcmp(wanted, "projection") == 0;
    /* both roots at 5 per scaled unit of time: some five times faster than the motion itself */
    r->model->baumgarte = strcmp(wanted, "baumgarte") == 0 ? 5 : 0;
}

static fw_status say_method(fw_run *r) {
    const fw_method *method = r->model->method;
    if (!method->report) return FW_OK;
    fw_text text = fw_text_new(r->arena);
    FW_TRY(method->report(r->model, r->mechanism, &text));
    FW_TRY(fw_text_end(&text));
    r->motion->method_report = text.data;
    return FW_OK;
}

fw_status fw_simulate(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                      const fw_motion_options *options, fw_diags *diags, const fw_motion **motion) {
    fw_terms terms;
    fw_run r = {
        .arena = arena, .mechanism = mechanism, .scene = scene, .options = options, .diags = diags};
    *motion = NULL;
    FW_TRY(fw_check_options(options, diags));
    FW_TRY(fw_check_motion(mechanism, scene, diags));
    FW_NEED(r.motion = fw_arena_one(arena, fw_motion));
    FW_TRY(fw_check_names(options, diags, r.motion));
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags,
                              &r.motion->ledger, &terms));
    FW_TRY(assembled(&r));
    FW_TRY(fw_model_new(arena, mechanism, &terms, r.q0, scene->duration_s,
                        fw_method_find(r.motion->method), diags, &r.model));
    FW_TRY(fw_run_arrays(&r));
    set_stabilisation(&r);
    r.most_angle = options->most_angle_rad > 0 ? options->most_angle_rad : HUGE_VAL;
    FW_TRY(fw_run_prepare(&r, &terms));
    FW_TRY(fw_integrator_choose(&r, &terms, options->integrator));
    FW_TRY(solve(&r));
    FW_TRY(say_method(&r));
    *motion = r.motion;
    return FW_OK;
}
