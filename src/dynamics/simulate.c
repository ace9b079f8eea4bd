/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One scene: tolerance, two runs (the answer, and a looser one that its error is estimated from),
   statistics. */
#include "dynamics/run.h"
#include "multibody/reactions.h"
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
   the error estimate follows noise, and steps shrink for nothing. Likewise where a light body sits
   between heavy ones, but for methods in independent coordinates. */
static double noise_floor(const fw_run *r) {
    const fw_model *m = r->model;
    double ratio = 0, masses = m->method->independent ? 0 : 3e-17 * r->uneven;
    for (int i = 0; i < 2 * m->nblock; i++) {
        int b = m->body[i];
        double x = m->local[2 * i], y = m->local[2 * i + 1];
        if (b < m->nbody) ratio = fmax(ratio, m->jinv[b] / m->minv[b] * (x * x + y * y));
    }
    return fmax(3e-19 * ratio, masses);
}

static double chosen_rtol(const fw_motion_options *o, const fw_run *r) {
    double accuracy = o->accuracy > 0 ? o->accuracy : 1e-3;
    double rtol = o->rtol > 0 ? o->rtol : fmin(1e-6, 1e-4 * accuracy);
    return fmin(fw_loosest, fmax(fmax(fw_tightest, noise_floor(r)), rtol));
}

/* ---- the two runs ---- */

typedef struct pass {
    fw_stepper *stepper;
    fw_peaks peaks;
    fw_extreme *extreme;        /* (channels) or NULL */
    double doubt[FW_MARKS + 1]; /* fw_kinks_doubt */
} pass;

/* other: the run that this one is compared with, NULL: it is the first. full: the answer. A fixed
 * step has no tolerance: h = rtol^(1/4) scaled makes its error go with rtol, too */
static fw_status run_once(fw_run *r, double rtol, const pass *other, bool full, pass *p) {
    fw_model *m = r->model;
    /* a multistep method chooses its order by what it controls: where the motion is a straight line
       (a joint that sticks to a belt) it would integrate the energies by order 1 */
    bool energies = r->integrator->variable_order && !r->integrator->implicit;
    const fw_ode ode = {.context = m,
                        .rhs = fw_model_rhs,
                        .lean = fw_model_lean_rhs,
                        .project = fw_model_project,
                        .n = m->ny,
                        .controlled = energies ? m->ny : 2 * m->nq,
                        .positions = m->nq};
    double *atol;
    FW_NEED(atol = fw_arena_array(r->arena, double, (size_t)m->ny));
    for (int i = 0; i < m->ny; i++)
        atol[i] = fmax(rtol * r->amplitude, 2e-15);
    FW_TRY(fw_peaks_new(r->arena, r->mechanism, r->q0, &p->peaks));
    p->peaks.marked = other ? &other->peaks : NULL;
    r->extreme = NULL;
    if (r->options->reactions)
        FW_NEED(r->extreme = fw_arena_array(r->arena, fw_extreme, (size_t)fw_run_channels(r)));
    FW_TRY(fw_stepper_new(r->arena, r->integrator, &ode, rtol, atol, &p->stepper));
    p->stepper->h_fixed = pow(rtol, 0.25);
    p->extreme = r->extreme;
    r->full = full;
    fw_status status = fw_run_pass(r, p->stepper, &p->peaks);
    fw_kinks_doubt(r, p->doubt);
    fw_stepper_free(p->stepper); /* what a library holds for it; its results stay */
    return status;
}

/* the rounding of positions and velocities near 1 makes energies of DBL_EPSILON times the scaled
   masses: against this floor, where nothing moves, that is a balance of 1e-6 */
static double least_energy(const fw_model *m) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++)
        sum += m->mass[b] + m->inertia[b];
    return 1e6 * DBL_EPSILON * sum;
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
    stats->energy_error = r->drift / fmax(r->largest, least_energy(m));
    stats->largest_energy_J = r->largest * unit.mass_kg * speed * speed;
    stats->rtol = rtol;
}

/* how far the two runs differ, up to each mark and (last) up to the end: any angle at the marks,
   where errors of phase show too, because one number may agree by chance, and the sizes of the
   peaks that lie before. What becomes of the motion later does not count: a chaotic one ends
   anywhere. */
static void differences(const pass *fine, const pass *coarse, double worst[FW_MARKS + 1]) {
    const fw_peaks *a = &fine->peaks, *b = &coarse->peaks;
    for (int k = 0; k <= FW_MARKS; k++)
        worst[k] = fw_peaks_apart(a, b, k);
    for (int i = 0; i < a->npin; i++) {
        double end =
            fw_peaks_angle(a, i, fine->stepper->y) - fw_peaks_angle(b, i, coarse->stepper->y);
        double *up_to = &worst[fw_peaks_first_mark(a, b, a->peak[i].t_s)];
        worst[FW_MARKS] = fmax(worst[FW_MARKS], fabs(end));
        *up_to = fmax(*up_to, fabs(fabs(a->peak[i].angle_rad) - fabs(b->peak[i].angle_rad)));
    }
    for (int k = 1; k <= FW_MARKS; k++)
        worst[k] = fmax(worst[k], worst[k - 1]);
}

/* After a rest the two runs may agree by chance on how they meet a load: of 12 000 short ones the
   error was up to 4.6 times their difference in 5 cases; rk4, which knows no error, up to 34 times
   in a few. Test: test_pulse.c. */
double fw_run_margin(const fw_run *r) {
    return !r->sudden ? 1 : r->integrator->fixed_step ? 32 : 8;
}

/* error of each peak from a second run at a hundred times the tolerance: its own change, and
   whatever else changes until a quarter of its time and an eighth of the scene later (up to the
   peak alone was too little twice in 60 000 cases); and round-off. Output rad. Never below the true
   error in 60 000 random cases (at ten times the tolerance it was in 7 of 80 000), and about a
   thousand times above it in the geometric mean. Source: tolerance proportionality, Hairer, Norsett
   and Wanner I, II.4. Test: test_peak.c. */
static void estimate_errors(fw_run *r, const pass *fine, const pass *coarse) {
    const fw_stepper *s = fine->stepper;
    r->motion->stats.estimate_margin = fw_run_margin(r);
    double unit = r->model->scale.time_s, eighth = r->end[r->npiece - 1] / 8, worst[FW_MARKS + 1];
    differences(fine, coarse, worst);
    for (int i = 0; i < fine->peaks.npin; i++) {
        const fw_peak *other = &coarse->peaks.peak[i];
        fw_peak *p = &r->motion->peak[i];
        *p = fine->peaks.peak[i];
        double late = 1.25 * p->t_s + eighth;
        int kinks = (int)fmin(FW_MARKS, 1 + late * FW_MARKS / (8 * eighth));
        double own = fabs(fabs(p->angle_rad) - fabs(other->angle_rad));
        p->t_s *= unit;
        p->error_rad =
            fw_run_margin(r) *
                fmax(own, worst[fw_peaks_first_mark(&fine->peaks, &coarse->peaks, late)]) +
            DBL_EPSILON * (double)(8 + s->steps) * (1 + fabs(p->angle_rad)) +
            r->motion->stats.energy_error * fabs(p->angle_rad) + /* never below the books */
            fine->doubt[kinks];
    }
    if (fine->extreme)
        fw_run_take_extremes(r, fine->extreme, coarse->extreme, fine->doubt[FW_MARKS], s->steps);
}

typedef struct reached { /* largest values and errors of any pin; force 0 when not asked for */
    double angle_rad, error_rad, force_N, error_N;
} reached;

static reached what_is_reached(const fw_run *r) {
    reached x = {0};
    for (int i = 0; i < r->motion->npin; i++) {
        x.angle_rad = fmax(x.angle_rad, fabs(r->motion->peak[i].angle_rad));
        x.error_rad = fmax(x.error_rad, r->motion->peak[i].error_rad);
        if (!r->options->reactions) continue;
        x.force_N = fmax(x.force_N, r->motion->force_peak[i].force_N);
        x.error_N = fmax(x.error_N, r->motion->force_peak[i].error_N);
    }
    return x;
}

static double accuracy_wanted(const fw_run *r) {
    return r->options->accuracy > 0 ? r->options->accuracy : 1e-3;
}

static bool good_enough(const fw_run *r) {
    const reached x = what_is_reached(r);
    double accuracy = accuracy_wanted(r);
    const fw_motion_options *o = r->options;
    return x.error_rad <= accuracy * x.angle_rad &&
           (!o->reactions || fw_run_extremes_good(r, accuracy)) &&
           (!o->settled || o->settled(r->motion->observed, r->motion->compared,
                                      r->motion->stats.estimate_margin, accuracy));
}

/* an angle or a force that is round-off has no relative accuracy */
static const double nothing = 1e-10;

static void warn_inaccurate(const fw_run *r) {
    const reached x = what_is_reached(r);
    double accuracy = accuracy_wanted(r), degree = 57.29577951308232;
    char a[32], b[32], c[32];
    if (x.error_rad > fmax(nothing, accuracy * x.angle_rad))
        fw_diag_warning(r->diags, 240, r->scene->place,
                        "scene %s: peaks are uncertain by %s deg where the largest is %s deg, and "
                        "an accuracy of %s is wanted; no tolerance is tight enough: shorten the "
                        "scene, or judge by the stated errors",
                        r->scene->name ? r->scene->name : "(unnamed)",
                        fw_number_text(a, sizeof a, x.error_rad * degree, 3),
                        fw_number_text(b, sizeof b, x.angle_rad * degree, 3),
                        fw_number_text(c, sizeof c, accuracy, 3));
    else if (x.error_N > fmax(nothing * fw_newton(r->model), accuracy * x.force_N))
        fw_diag_warning(r->diags, 240, r->scene->place,
                        "scene %s: joint forces are uncertain by %s N where the largest is %s N, "
                        "and an accuracy of %s is wanted; no tolerance is tight enough: shorten "
                        "the scene, or judge by the stated errors",
                        r->scene->name ? r->scene->name : "(unnamed)",
                        fw_number_text(a, sizeof a, x.error_N, 3),
                        fw_number_text(b, sizeof b, x.force_N, 3),
                        fw_number_text(c, sizeof c, accuracy, 3));
}

/* rtol is relative to the amplitude, or to the motion where that is larger; 100 times as much is
   not explained, and a thousandth is always allowed */
static double energy_allowed(const fw_run *r) {
    const fw_model *m = r->model;
    double mass = 0;
    for (int b = 0; b < m->nbody; b++)
        mass += m->mass[b] + m->inertia[b];
    double motion = sqrt(r->largest / mass);
    double part = motion < r->amplitude ? r->amplitude / fmax(motion, DBL_MIN) : 1;
    return fmax(1e-3, 100 * r->motion->stats.rtol * part);
}

static void warn_energy(const fw_run *r) {
    double off = r->motion->stats.energy_error;
    char a[32], b[32];
    if (!(off > energy_allowed(r))) return;
    fw_diag_warning(r->diags, 241, r->scene->place,
                    "scene %s: the energies do not add up, by %s of the largest, far more than "
                    "the tolerance %s explains; do not trust this motion, try another --method or "
                    "--integrator",
                    r->scene->name ? r->scene->name : "(unnamed)",
                    fw_number_text(a, sizeof a, off, 2),
                    fw_number_text(b, sizeof b, r->motion->stats.rtol, 2));
}

static fw_status tighten(fw_run *r) {
    const fw_motion_options *o = r->options;
    double rtol = chosen_rtol(o, r), tightest = fmax(fw_tightest, noise_floor(r));
    int rows = r->motion->nsample;
    r->motion->observed = o->context;
    r->motion->compared = o->other;
    bool again = false; /* coarse: the answer at a hundred times the tolerance, not good enough */
    pass fine, coarse;
    for (;;) {
        r->motion->nsample = rows;
        double began = cpu_seconds();
        if (again && o->other) { /* what the answer so far showed is now the looser run */
            void *looser = r->motion->observed;
            r->motion->observed = r->motion->compared;
            r->motion->compared = looser;
        }
        FW_TRY(run_once(r, rtol, again ? &coarse : NULL, true, &fine));
        double between = cpu_seconds();
        take_statistics(r, fine.stepper, rtol, between - began);
        if (!again) {
            FW_TRY(run_once(r, 100 * rtol, &fine, false, &coarse));
            r->motion->stats.estimate_cpu_s = cpu_seconds() - between;
        }
        estimate_errors(r, &fine, &coarse);
        /* a tolerance of our own choosing is tightened until the estimate is good enough */
        bool enough = o->rtol > 0 || r->motion->ended || good_enough(r);
        if (enough || rtol <= tightest) {
            if (!enough) warn_inaccurate(r);
            warn_energy(r);
            return FW_OK;
        }
        /* the next estimate has this run to compare with, unless laws limit its steps (which are
           longer in runs that only serve the estimate) */
        again = rtol / 100 >= tightest && r->nstride == 0;
        if (again) coarse = fine, r->motion->stats.estimate_cpu_s = r->motion->stats.cpu_s;
        rtol = fmax(tightest, rtol / 100);
    }
}

/* starts over where a choice of ours was wrong */
static fw_status solve(fw_run *r) {
    int rows = r->motion->nsample;
    r->given_up_s = (double)NAN;
    fw_status status = tighten(r);
    if (isnan(r->given_up_s)) return status;
    FW_TRY(fw_integrator_change(r));
    r->motion->nsample = rows;
    return tighten(r);
}

/* ---- the entry ---- */

static fw_status assembled(fw_run *r, const fw_terms *terms) {
    const fw_mechanism *m;
    FW_TRY(fw_effects_at_start(r->arena, r->mechanism, terms, &m));
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
    r->motion->method_report = r->why;
    if (!method->report) return FW_OK;
    fw_text text = fw_text_new(r->arena);
    if (r->why) fw_text_printf(&text, "%s; ", r->why);
    FW_TRY(method->report(r->model, r->mechanism, &text));
    FW_TRY(fw_text_end(&text));
    r->motion->method_report = text.data;
    return FW_OK;
}

/* The bounds are relative to the largest deflection of any hinge with nothing left out, which is at
   least 1 - their sum of the one seen here. */
double fw_motion_left_out(const fw_motion *motion) {
    double largest = 0, out = motion->ledger.left_out;
    for (int i = 0; i < motion->npin; i++)
        largest = fmax(largest, fabs(motion->peak[i].angle_rad));
    return out < 1 ? out / (1 - out) * largest : HUGE_VAL;
}

void fw_motion_widen(fw_motion *motion) {
    double more = fw_motion_left_out(motion);
    for (int i = 0; i < motion->npin; i++)
        motion->peak[i].error_rad += more;
}

fw_status fw_check_request(const fw_mechanism *mechanism, const fw_scene *scene,
                           const fw_motion_options *options, fw_diags *diags) {
    fw_motion unused = {0};
    FW_TRY(fw_check_options(options, diags));
    FW_TRY(fw_check_motion(mechanism, scene, diags));
    return fw_check_names(options, diags, &unused);
}

fw_status fw_simulate_compiled(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_scene *scene, const fw_motion_options *options,
                               const fw_effect_ledger *ledger, const fw_terms *given,
                               fw_diags *diags, const fw_motion **motion) {
    fw_terms own = *given, *terms = &own;
    fw_run r = {
        .arena = arena, .mechanism = mechanism, .scene = scene, .options = options, .diags = diags};
    *motion = NULL;
    FW_NEED(r.motion = fw_arena_one(arena, fw_motion));
    r.motion->ledger = *ledger;
    FW_NEED(r.motion->terms = fw_terms_keep(arena, given));
    FW_TRY(fw_check_names(options, diags, r.motion));
    FW_TRY(fw_method_choose(&r, terms));
    FW_TRY(fw_effects_strain(arena, mechanism, terms, &r.mechanism));
    mechanism = r.mechanism;
    FW_TRY(assembled(&r, terms));
    FW_TRY(fw_model_new(arena, mechanism, terms, r.q0, scene->duration_s,
                        fw_method_find(r.motion->method), diags, &r.model));
    FW_TRY(fw_run_arrays(&r));
    set_stabilisation(&r);
    r.most_angle = options->most_angle_rad > 0 ? options->most_angle_rad : HUGE_VAL;
    FW_TRY(fw_run_prepare(&r, terms));
    FW_TRY(fw_integrator_choose(&r, terms, options->integrator));
    FW_TRY(solve(&r));
    FW_TRY(say_method(&r));
    fw_motion_widen(r.motion);
    *motion = r.motion;
    return FW_OK;
}

fw_status fw_simulate(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                      const fw_motion_options *options, fw_diags *diags, const fw_motion **motion) {
    fw_terms terms;
    fw_effect_ledger ledger;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    *motion = NULL;
    FW_TRY(fw_check_request(mechanism, scene, options, diags));
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags, &ledger,
                              &terms));
    return fw_simulate_compiled(arena, mechanism, scene, options, &ledger, &terms, diags, motion);
}
