/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancel.h"
#include "dynamics/model.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <time.h>

static const long fw_most_steps = 2 * 1000 * 1000;
/* beyond 1e-5 a step of order 8 spans whole oscillations and its estimates mean little */
static const double fw_tightest = 1e-13, fw_loosest = 1e-5;

typedef struct run {
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_scene *scene;
    fw_diags *diags;
    fw_motion *motion;
    fw_model *model;
    double *q0;       /* (3 nbody) assembled, SI */
    double *start;    /* (ny) */
    double *state;    /* (ny) a sample */
    double *rate;     /* (ny) its derivative: only the joint forces found on the way are used */
    double amplitude; /* scaled size of the motion: the absolute tolerance is rtol times this */
    fw_energy first;
    double drift, largest;
    fw_observer observe;
    void *context;
    double *seen_q, *seen_angle, *seen_force; /* what the observer is shown, SI */
    double most_angle;                        /* rad; HUGE_VAL: no end before the end */
    long steps;                               /* over all tries */
} run;

static double cpu_seconds(void) {
    struct timespec now;
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* where m r^2/J is huge the accelerations carry round-off of 1e-16 m r^2/J; below some 1e-3 of that
   the error estimate follows noise, and steps shrink for nothing */
static double noise_floor(const fw_model *m) {
    double ratio = 0;
    for (int i = 0; i < 2 * m->npin; i++) {
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

/* ---- start ---- */

/* size of the motion in scaled units, at most 1: twice the linear static response to what acts, and
   the starting velocity; 1 when the mechanism can move freely */
static fw_status motion_size(run *r, const fw_terms *terms) {
    const fw_mechanism *m = r->mechanism;
    size_t n = 3 * (size_t)m->nbody;
    double *force, *displacement, *rotation, size = 0, speed = 0;
    fw_mark mark = fw_arena_mark(r->arena);
    bool valid = false;
    FW_NEED(force = fw_arena_array(r->arena, double, n));
    FW_NEED(displacement = fw_arena_array(r->arena, double, n));
    FW_NEED(rotation = fw_arena_array(r->arena, double, (size_t)m->npin));
    fw_terms_initial_force(m, terms, force);
    FW_TRY(fw_static_response(r->arena, m, terms, force, displacement, rotation, &valid));
    const fw_scale s = r->model->scale;
    for (size_t i = 0; i < n; i++) {
        double unit = i % 3 == 2 ? 1 : s.length_m;
        if (valid) size = fmax(size, 2 * fabs(displacement[i]) / unit);
        speed = fmax(speed, fabs(r->start[n + i]));
    }
    fw_arena_rewind(r->arena, mark);
    size = fmax(size, speed);
    r->amplitude = valid && size > 0 ? fmin(1, size) : 1;
    return FW_OK;
}

/* assembled pose, initial velocities moved onto G v = 0; says so when they contradicted the joints
 */
static fw_status prepare(run *r, const fw_terms *terms) {
    fw_model *m = r->model;
    const fw_scale s = m->scale;
    double *v = r->start + m->nq, size = 0, moved = 0;
    for (int i = 0; i < m->nq; i++) {
        v[i] = terms->velocity[i] * s.time_s / (i % 3 == 2 ? 1 : s.length_m);
        r->state[i] = v[i];
        size = fmax(size, fabs(v[i]));
    }
    fw_model_pose(m, r->start);
    fw_chain_assemble(m);
    if (!fw_chain_factor(&m->chain, fw_epsilon) || !fw_model_project_position(m, r->start))
        return FW_INTERNAL;
    fw_chain_assemble(m);
    if (!fw_chain_factor(&m->chain, fw_epsilon) || !fw_model_project_velocity(m, v))
        return FW_INTERNAL;
    for (int i = 0; i < m->nq; i++)
        moved = fmax(moved, fabs(v[i] - r->state[i]));
    if (moved > 1e-6 * size) {
        char text[32];
        fw_diag_warning(
            r->diags, 106, r->scene->place,
            "initial velocities of scene %s contradict the joints; they were changed by up "
            "to %s %% to fit",
            r->scene->name ? r->scene->name : "(unnamed)",
            fw_number_text(text, sizeof text, 100 * moved / size, 3));
    }
    return FW_OK;
}

/* ---- samples ---- */

/* state y in SI: pose and joint angles */
static void pose_in_SI(const run *r, const double *y, double *q, double *angle) {
    const fw_model *m = r->model;
    for (int i = 0; i < m->nq; i++)
        q[i] = r->q0[i] + (i % 3 == 2 ? 1 : m->scale.length_m) * y[i];
    for (int i = 0; i < r->mechanism->npin; i++) {
        const fw_pin *p = &r->mechanism->pin[i];
        angle[i] = (p->body_b == FW_GROUND ? 0 : q[3 * p->body_b + 2]) -
                   (p->body_a == FW_GROUND ? 0 : q[3 * p->body_a + 2]) - p->free_angle_rad;
    }
}

static void store_sample(run *r, int row, double t, const double *y) {
    fw_motion *out = r->motion;
    const fw_model *m = r->model;
    const fw_scale s = m->scale;
    size_t base = (size_t)row * (size_t)m->nq;
    out->t_s[row] = t;
    pose_in_SI(r, y, out->q + base, out->angle_rad + (size_t)row * (size_t)out->npin);
    for (int i = 0; i < m->nq; i++)
        out->v[base + (size_t)i] = (i % 3 == 2 ? 1 : s.length_m) / s.time_s * y[m->nq + i];
}

/* force of every pin on its body b, world axes: the multipliers of the accelerations at this state
 */
static void reactions(run *r, const double *y, double *out) {
    fw_model *m = r->model;
    const fw_scale s = m->scale;
    double newton = s.mass_kg * s.length_m / (s.time_s * s.time_s);
    fw_model_rhs(m, 0, y, r->rate);
    for (int i = 0; i < m->npin; i++)
        for (int k = 0; k < 2; k++)
            out[2 * m->pin[i] + k] = newton * m->lambda[2 * i + k];
}

static void store_reactions(run *r, int row, const double *y) {
    reactions(r, y, r->motion->reaction_N + (size_t)row * 2 * (size_t)r->model->npin);
}

/* shows the observer the step just made, and the start of the first one */
static void show_step(run *r, fw_dop853 *s) {
    if (!r->observe) return;
    fw_dop853_dense_prepare(s);
    for (int i = s->t_old > 0 ? 1 : 0; i <= FW_INSTANTS; i++) {
        double theta = (double)i / FW_INSTANTS;
        fw_dop853_dense(s, theta, r->state);
        pose_in_SI(r, r->state, r->seen_q, r->seen_angle);
        reactions(r, r->state, r->seen_force);
        const fw_instant now = {(s->t_old + theta * s->h) * r->model->scale.time_s, r->seen_q,
                                r->seen_angle, r->seen_force};
        r->observe(r->context, &now);
    }
}

static double sample_time(const run *r, int row) {
    int last = r->motion->nsample - 1;
    return row == last ? r->scene->duration_s : r->scene->duration_s * row / (last > 0 ? last : 1);
}

/* rows up to the end of this step, from the dense output, projected like an accepted step */
static bool take_samples(run *r, fw_dop853 *s, int *row) {
    fw_model *m = r->model;
    for (; *row < r->motion->nsample; (*row)++) {
        double t = sample_time(r, *row) / m->scale.time_s;
        bool end = *row == r->motion->nsample - 1;
        if (end ? s->t < s->t_end : t > s->t) return true;
        if (t >= s->t || end) {
            store_sample(r, *row, sample_time(r, *row), s->y);
            store_reactions(r, *row, s->y);
            continue;
        }
        fw_dop853_dense_prepare(s);
        fw_dop853_dense(s, (t - s->t_old) / s->h, r->state);
        fw_model_pose(m, r->state);
        fw_chain_assemble(m);
        if (!fw_chain_factor(&m->chain, fw_epsilon) || !fw_model_project_position(m, r->state))
            return false;
        fw_chain_assemble(m);
        if (!fw_chain_factor(&m->chain, fw_epsilon) ||
            !fw_model_project_velocity(m, r->state + m->nq))
            return false;
        store_sample(r, *row, sample_time(r, *row), r->state);
        store_reactions(r, *row, r->state);
    }
    return true;
}

/* ---- the run ---- */

static void watch_energy(run *r, const double *y) {
    fw_model_pose(r->model, y);
    fw_energy e = fw_model_energy(r->model, y);
    double balance = e.kinetic + e.elastic + e.dissipated - e.work;
    double start = r->first.kinetic + r->first.elastic + r->first.dissipated - r->first.work;
    r->drift = fmax(r->drift, fabs(balance - start));
    r->largest = fmax(r->largest, fmax(e.kinetic + e.elastic + e.dissipated, fabs(e.work)));
}

static fw_status stopped(const run *r, const fw_dop853 *s, fw_ode_result why) {
    const fw_model *m = r->model;
    int worst = 0;
    double most = -1;
    for (int b = 0; b < m->nbody; b++) {
        const double *a = s->f + m->nq + 3 * b;
        double size = fabs(a[0]) + fabs(a[1]) + fabs(a[2]);
        if (size > most || isnan(size)) most = isnan(size) ? (double)INFINITY : size, worst = b;
    }
    const char *id = r->mechanism->body[worst].id;
    char time[32];
    fw_number_text(time, sizeof time, s->t * m->scale.time_s, 6);
    fw_status status =
        why == FW_ODE_NAN
            ? fw_diag_error(
                  r->diags, 102, r->scene->place,
                  "the motion of scene %s is no longer a number after %s s, at body %s; check "
                  "loads, masses and stiffnesses",
                  r->scene->name ? r->scene->name : "(unnamed)", time, id ? id : "(unnamed)")
            : fw_diag_error(
                  r->diags, 101, r->scene->place,
                  "the steps of scene %s become too small at %s s, at body %s; the motion "
                  "runs into a position it cannot pass, or rtol is too tight",
                  r->scene->name ? r->scene->name : "(unnamed)", time, id ? id : "(unnamed)");
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

static bool turned_too_far(const run *r, const fw_peaks *peaks) {
    for (int i = 0; i < peaks->npin; i++)
        if (fabs(peaks->peak[i].angle_rad) > r->most_angle) return true;
    return false;
}

/* the step says which of the two it is: a few per period of the motion, or tiny ones */
static fw_status too_long(const run *r, const fw_dop853 *s) {
    char step[32], at[32];
    double unit = r->model->scale.time_s;
    fw_status status =
        fw_diag_error(r->diags, 108, r->scene->place,
                      "scene %s needs more than 2 million steps (they are %s s, and %s s are "
                      "reached): shorten it, or "
                      "look for a stiffness or damping that is extreme against the masses",
                      r->scene->name ? r->scene->name : "(unnamed)",
                      fw_number_text(step, sizeof step, s->h * unit, 2),
                      fw_number_text(at, sizeof at, s->t * unit, 3));
    return status == FW_NOMEM ? FW_NOMEM : FW_LIMIT;
}

/* from start to end with one tolerance; `full` takes samples and the energy balance too */
static fw_status integrate(run *r, fw_dop853 *s, fw_peaks *peaks, bool full) {
    fw_model *m = r->model;
    int row = 0;
    if (full && r->observe) r->observe(r->context, NULL);
    m->projections = 0;
    m->worst_position = m->worst_velocity = 0;
    fw_dop853_start(s, 0, r->start, r->scene->duration_s / m->scale.time_s);
    if (full && r->motion->nsample > 0) {
        store_sample(r, 0, 0, s->y);
        store_reactions(r, 0, s->y);
        row = 1;
    }
    if (full) {
        fw_model_pose(m, s->y);
        r->first = fw_model_energy(m, s->y);
        r->drift = 0;
        r->largest = r->first.kinetic + r->first.elastic;
    }
    while (s->t < s->t_end) {
        if (fw_cancel_requested()) return FW_CANCELLED;
        fw_ode_result result = fw_dop853_step(s);
        if (result != FW_ODE_STEP) return stopped(r, s, result);
        fw_peaks_step(peaks, m, s);
        if (full) {
            watch_energy(r, s->y);
            show_step(r, s);
            if (!take_samples(r, s, &row)) return stopped(r, s, FW_ODE_SMALL);
        }
        if (++r->steps > fw_most_steps) return too_long(r, s);
        if (turned_too_far(r, peaks)) break;
    }
    if (full) {
        r->motion->ended = s->t < s->t_end;
        r->motion->end_s = r->motion->ended ? s->t * m->scale.time_s : r->scene->duration_s;
        r->motion->nsample = row;
    }
    return FW_OK;
}

static fw_status run_once(run *r, double rtol, bool full, fw_peaks *peaks, fw_dop853 **integrator) {
    fw_model *m = r->model;
    const fw_ode ode = {m, fw_model_rhs, fw_model_project, m->ny, 2 * m->nq};
    double *atol;
    FW_NEED(atol = fw_arena_array(r->arena, double, (size_t)m->ny));
    for (int i = 0; i < m->ny; i++)
        atol[i] = fmax(rtol * r->amplitude, 2e-15);
    FW_TRY(fw_dop853_new(r->arena, &ode, rtol, atol, integrator));
    FW_TRY(fw_peaks_new(r->arena, r->mechanism, r->q0, peaks));
    return integrate(r, *integrator, peaks, full);
}

/* error of each peak from a second run at a hundred times the tolerance: the largest change of any
   pin's peak, and of any pin's angle at the end where errors of phase show too, because one number
   may agree by chance; and round-off. Output rad. Never below the true error in 40 000 random cases
   (at ten times the tolerance it was in 7 of 80 000), and about a thousand times above it in the
   geometric mean. Source: tolerance proportionality, Hairer, Norsett and Wanner I, II.4. Test:
   test_peak.c. */
static void estimate_errors(run *r, const fw_peaks *fine, const fw_peaks *coarse,
                            const fw_dop853 *s, const fw_dop853 *check) {
    double worst = 0;
    for (int i = 0; i < fine->npin; i++) {
        double end = fw_peaks_angle(fine, i, s->y) - fw_peaks_angle(coarse, i, check->y);
        double change = fabs(fine->peak[i].angle_rad) - fabs(coarse->peak[i].angle_rad);
        worst = fmax(worst, fmax(fabs(change), fabs(end)));
    }
    for (int i = 0; i < fine->npin; i++) {
        fw_peak *p = &r->motion->peak[i];
        *p = fine->peak[i];
        p->t_s *= r->model->scale.time_s;
        p->error_rad =
            worst + DBL_EPSILON * (double)(8 + s->steps) * (1 + fabs(p->angle_rad)) +
            r->motion->stats.energy_error * fabs(p->angle_rad); /* never below the books */
    }
}

static bool good_enough(const run *r, const fw_motion_options *o) {
    double accuracy = o->accuracy > 0 ? o->accuracy : 1e-3, most = 0, error = 0;
    for (int i = 0; i < r->motion->npin; i++) {
        most = fmax(most, fabs(r->motion->peak[i].angle_rad));
        error = fmax(error, r->motion->peak[i].error_rad);
    }
    return error <= accuracy * most;
}

static fw_status solve(run *r, const fw_motion_options *o) {
    double rtol = chosen_rtol(o, r->model), tightest = fmax(fw_tightest, noise_floor(r->model));
    int rows = r->motion->nsample;
    for (;;) {
        r->motion->nsample = rows;
        fw_peaks fine, coarse;
        fw_dop853 *s, *check;
        double began = cpu_seconds();
        FW_TRY(run_once(r, rtol, true, &fine, &s));
        double between = cpu_seconds();
        fw_motion_stats *stats = &r->motion->stats;
        stats->cpu_s = between - began;
        stats->steps = s->steps, stats->rejected = s->rejected, stats->rhs = s->rhs;
        stats->projections = r->model->projections;
        stats->max_constraint_norm = r->model->worst_position;
        stats->max_velocity_norm = r->model->worst_velocity;
        stats->energy_error = r->largest > 0 ? r->drift / r->largest : 0;
        stats->rtol = rtol;
        FW_TRY(run_once(r, 100 * rtol, false, &coarse, &check));
        stats->estimate_cpu_s = cpu_seconds() - between;
        estimate_errors(r, &fine, &coarse, s, check);
        /* a tolerance of our own choosing is tightened until the estimate is good enough */
        if (o->rtol > 0 || r->motion->ended || good_enough(r, o) || rtol <= tightest) return FW_OK;
        rtol = fmax(tightest, rtol / 100);
    }
}

static fw_status output_arrays(run *r, int samples) {
    fw_motion *m = r->motion;
    size_t rows = (size_t)samples, n = 3 * (size_t)r->mechanism->nbody;
    m->nbody = r->mechanism->nbody;
    m->npin = r->mechanism->npin;
    m->nsample = samples;
    if (rows > ((size_t)1 << 40) / (n + (size_t)m->npin + 1)) return FW_LIMIT;
    FW_NEED(m->t_s = fw_arena_array(r->arena, double, rows));
    FW_NEED(m->q = fw_arena_array(r->arena, double, rows *n));
    FW_NEED(m->v = fw_arena_array(r->arena, double, rows *n));
    FW_NEED(m->angle_rad = fw_arena_array(r->arena, double, rows *(size_t)m->npin));
    FW_NEED(m->reaction_N = fw_arena_array(r->arena, double, rows * 2 * (size_t)m->npin));
    FW_NEED(m->peak = fw_arena_array(r->arena, fw_peak, (size_t)m->npin));
    return FW_OK;
}

fw_status fw_simulate(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                      const fw_motion_options *options, fw_diags *diags, const fw_motion **motion) {
    fw_terms terms;
    run r = {.arena = arena, .mechanism = mechanism, .scene = scene, .diags = diags};
    *motion = NULL;
    FW_TRY(fw_check_options(options, scene, diags));
    FW_TRY(fw_check_motion(mechanism, scene, diags));
    FW_NEED(r.motion = fw_arena_one(arena, fw_motion));
    FW_TRY(fw_check_names(options, diags, r.motion));
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags,
                              &r.motion->ledger, &terms));
    FW_TRY(output_arrays(&r, options->samples));
    size_t n = 3 * (size_t)mechanism->nbody;
    FW_NEED(r.q0 = fw_arena_array(arena, double, n));
    for (int b = 0; b < mechanism->nbody; b++) {
        r.q0[3 * b] = mechanism->body[b].x_m;
        r.q0[3 * b + 1] = mechanism->body[b].y_m;
        r.q0[3 * b + 2] = mechanism->body[b].phi_rad;
    }
    FW_TRY(fw_assemble(arena, mechanism, r.q0, &r.motion->stats.assembly_moved_m, diags));
    FW_TRY(fw_model_new(arena, mechanism, &terms, r.q0, scene->duration_s, &r.model));
    FW_NEED(r.start = fw_arena_array(arena, double, (size_t)r.model->ny));
    FW_NEED(r.state = fw_arena_array(arena, double, (size_t)r.model->ny));
    FW_NEED(r.rate = fw_arena_array(arena, double, (size_t)r.model->ny));
    r.observe = options->observe;
    r.context = options->context;
    FW_NEED(r.seen_q = fw_arena_array(arena, double, n));
    FW_NEED(r.seen_angle = fw_arena_array(arena, double, (size_t)mechanism->npin));
    FW_NEED(r.seen_force = fw_arena_array(arena, double, 2 * (size_t)mechanism->npin));
    r.most_angle = options->most_angle_rad > 0 ? options->most_angle_rad : HUGE_VAL;
    FW_TRY(prepare(&r, &terms));
    FW_TRY(motion_size(&r, &terms));
    FW_TRY(solve(&r, options));
    *motion = r.motion;
    return FW_OK;
}
