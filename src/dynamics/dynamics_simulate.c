/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One scene: two runs (the answer, and a looser one that its error is estimated from),
   statistics. */
#include "dynamics/run.h"
#include "multibody/system.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <time.h>

/* of a tolerance that is asked for: beyond, a step of order 8 spans whole oscillations */
static const double fw_loosest = 1e-5;

static double cpu_seconds(void) {
    struct timespec now;
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* of integrators that are asked for by name and have no table (tolerance_control.c), and as it is
   asked for */
static double chosen_rtol(const fw_dynamics_motion_options *o, const fw_dynamics_problem *problem) {
    double accuracy = o->accuracy > 0 ? o->accuracy : 1e-3;
    double rtol = o->rtol > 0 ? o->rtol : fmin(1e-6, 1e-4 * accuracy);
    double loosest = o->looser == 1 ? HUGE_VAL : fw_loosest; /* no estimate that has to hold */
    return fmin(loosest, fmax(fw_dynamics_tolerance_tightest(problem), rtol));
}

/* ---- the two runs ---- */

typedef struct pass {
    fw_maths_stepper *stepper;
    fw_dynamics_peaks peaks;
    fw_dynamics_extreme *extreme;     /* (channels) or NULL */
    double uncertainty[FW_MARKS + 1]; /* fw_dynamics_near_zero_uncertainty */
} pass;

/* ---- where a formula ends ---- */

/* A loose run may come to where a formula ends and a tight one pass: tolerances are tightened until that is settled. It
   is where two passes by another integrator, or at another tolerance, end within this part of their time of each other:
   a hundredth for whom only the decision counts, else as many digits as are printed. Test: test_actuators.c, a_formula_ends */
static const double fw_ends_alike = 1e-4, fw_ends_alike_sparing = 1e-2;

static void note_end(fw_dynamics_run *r, size_t said, double rtol, double t) {
    fw_dynamics_controller *c = &r->control;
    bool ended = false;
    for (size_t i = said; i < r->diags->count; i++)
        ended = ended || r->diags->item[i].ended != FW_ENDED_NOT;
    const fw_dynamics_formula_end now = {ended ? t : (double)NAN, rtol, c->integrator};
    if (now.rtol != c->end.rtol || now.integrator != c->end.integrator) c->before = c->end;
    c->end = now;
}

static bool ends_alike(const fw_dynamics_run *r) {
    const fw_dynamics_formula_end *a = &r->control.end, *b = &r->control.before;
    const double near = r->problem.options->sparing ? fw_ends_alike_sparing : fw_ends_alike;
    return fabs(a->t - b->t) <= near * a->t; /* NaN: one of them passed */
}

/* other: the run that this one is compared with, NULL: it is the first. full: the answer. A fixed
 * step has no tolerance: h = rtol^(1/4) scaled makes its error go with rtol, too */
static fw_status run_once(fw_dynamics_run *r, double rtol, const pass *other, bool full, pass *p) {
    const fw_multibody_model *m = r->problem.model;
    /* a multistep method chooses its order by what it controls: where the motion is a straight line
       (a joint that sticks to a belt) it would integrate the energies by order 1 */
    bool energies = r->control.integrator->variable_order && !r->control.integrator->implicit;
    const fw_maths_ode ode = {.context = r->problem.system,
                              .rhs = fw_multibody_rhs,
                              .lean = fw_multibody_rhs_motion,
                              .project = fw_multibody_project,
                              .n = m->ny,
                              .controlled = energies ? m->ny : 2 * m->nq,
                              .positions = m->nq};
    double *atol;
    FW_NEED(atol = fw_arena_array(r->problem.arena, double, (size_t)m->ny));
    for (int i = 0; i < m->ny; i++)
        atol[i] = fmax(rtol * r->problem.amplitude, 2e-15);
    FW_TRY(fw_dynamics_peaks_new(r->problem.arena, r->problem.mechanism, r->problem.q0,
                                 r->problem.model, &p->peaks));
    p->peaks.marked = other ? &other->peaks : NULL;
    p->peaks.sized = r->control.part > 0;
    r->record.extreme = NULL;
    if (r->problem.options->reactions)
        FW_NEED(r->record.extreme = fw_arena_array(r->problem.arena, fw_dynamics_extreme,
                                                   (size_t)fw_dynamics_run_channels(&r->problem)));
    FW_TRY(fw_maths_stepper_new(r->problem.arena, r->control.integrator, &ode, rtol, atol,
                                &p->stepper));
    p->stepper->h_fixed = pow(rtol, 0.25);
    p->extreme = r->record.extreme;
    r->record.full = full;
    r->control.law_stride = full ? 1 : 1.5;
    r->control.fixed_part = full ? 0.125 : 0.395;
    const size_t said = r->diags->count;
    fw_status status = fw_dynamics_tape_pass(r, p->stepper, &p->peaks);
    fw_dynamics_spent *spent = r->problem.options->spent;
    const bool beams = r->record.motion->ledger.hinge.used == FW_HINGE_ELASTICA;
    if (spent) atomic_fetch_add(&spent->all, p->stepper->rhs);
    if (spent && beams) atomic_fetch_add(&spent->beams, p->stepper->rhs);
    note_end(r, said, rtol, p->stepper->t);
    fw_dynamics_near_zero_uncertainty(&r->control, p->uncertainty);
    fw_maths_stepper_free(p->stepper); /* what a library holds for it; its results stay */
    return status;
}

/* the rounding of positions and velocities near 1 makes energies of DBL_EPSILON times the scaled
   masses: against this floor, where nothing moves, that is a balance of 1e-6 */
static double least_energy(const fw_multibody_model *m) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++)
        sum += m->mass[b] + m->inertia[b];
    return 1e6 * DBL_EPSILON * sum;
}

static void take_statistics(fw_dynamics_recorder *record, const fw_maths_stepper *s, double rtol,
                            double cpu_s) {
    const fw_multibody_model *m = record->problem->model;
    const fw_multibody_record *kept = &record->problem->system->record;
    const fw_multibody_scale unit = m->scale;
    fw_dynamics_motion_stats *stats = &record->motion->stats;
    double speed = unit.length_m / unit.time_s;
    stats->cpu_s = cpu_s;
    stats->steps = s->steps, stats->rejected = s->rejected, stats->rhs = s->rhs;
    stats->jacobians = s->jacobians, stats->factorisations = s->factorisations;
    stats->projections = kept->projections;
    stats->events = kept->events;
    stats->max_constraint_norm = kept->worst_position;
    stats->max_velocity_norm = kept->worst_velocity;
    stats->energy_error = record->drift / fmax(record->largest, least_energy(m));
    stats->largest_energy_J = record->largest * unit.mass_kg * speed * speed;
    stats->rtol = rtol;
}

/* how far the two runs differ, up to each mark and (last) up to the end. angles: any angle at the
   marks, where errors of phase show too, because one number may agree by chance, and the sizes of
   the peaks that lie before; sizes: the largest sizes up to the marks, and the peaks. What becomes
   of the motion later does not count: a chaotic one ends anywhere. */
typedef struct differences {
    double angles[FW_MARKS + 1], sizes[FW_MARKS + 1];
} differences;

static void compare(const pass *fine, const pass *coarse, differences *d) {
    const fw_dynamics_peaks *a = &fine->peaks, *b = &coarse->peaks;
    for (int k = 0; k <= FW_MARKS; k++) {
        d->angles[k] = fw_dynamics_peaks_apart(a, b, k);
        d->sizes[k] = fw_dynamics_peaks_sizes_apart(a, b, k);
    }
    for (int i = 0; i < a->npin; i++) {
        double end = fw_dynamics_peaks_angle(a, i, fine->stepper->y) -
                     fw_dynamics_peaks_angle(b, i, coarse->stepper->y);
        double peak = fabs(fabs(a->peak[i].angle_rad) - fabs(b->peak[i].angle_rad));
        int up_to = fw_dynamics_peaks_first_mark(a, b, a->peak[i].t_s);
        d->angles[FW_MARKS] = fmax(d->angles[FW_MARKS], fabs(end));
        d->angles[up_to] = fmax(d->angles[up_to], peak);
        d->sizes[up_to] = fmax(d->sizes[up_to], peak);
    }
    for (int k = 1; k <= FW_MARKS; k++) {
        d->angles[k] = fmax(d->angles[k], d->angles[k - 1]);
        d->sizes[k] = fmax(d->sizes[k], d->sizes[k - 1]);
    }
}

/* After a rest the two runs may agree by chance on how they meet a load: of 12 000 short ones the
   error was up to 4.6 times their difference in 5 cases; rk4, which knows no error, up to 34 times
   in a few. Test: test_pulse.c. */
static double run_margin(const fw_dynamics_controller *control) {
    return control->trust * (!control->problem->sudden         ? 1
                             : control->integrator->fixed_step ? 32
                                                               : 8);
}

/* what the looser run and the energies say of the error of one peak, rad; late: the mark up to
   which the runs are compared */
static double difference_counts(const fw_dynamics_run *r, const pass *fine, const pass *coarse,
                                const differences *d, int pin, int late) {
    const fw_dynamics_peak *p = &fine->peaks.peak[pin], *other = &coarse->peaks.peak[pin];
    double own = fabs(fabs(p->angle_rad) - fabs(other->angle_rad));
    double energy_balance = r->record.motion->stats.energy_error * fabs(p->angle_rad);
    if (!(r->control.part > 0)) /* never below the energy balance error */
        return run_margin(&r->control) * fmax(own, d->angles[late]) + energy_balance;
    return r->control.part *
               fw_dynamics_tolerance_difference(own, d->sizes[late], d->angles[late]) +
           fw_dynamics_tolerance_energy_ratio(fine->stepper->steps, coarse->stepper->steps) *
               energy_balance;
}

/* Error of each peak from a second run: its own change, and whatever else changes until a quarter
   of its time and an eighth of the scene later (up to the peak alone was too little twice in 60 000
   cases); and round-off. Output rad. At a hundred times the tolerance, where differences count
   whole: never below the true error in 60 000 random cases (at ten times it was in 7 of 80 000),
   and about a thousand times above it in the geometric mean. Nearer ones: tolerance_control.c.
   Source: tolerance proportionality, Hairer, Norsett and Wanner I, II.4. Test: test_peak.c. */
static void estimate_errors(fw_dynamics_run *r, const pass *fine, const pass *coarse) {
    const fw_maths_stepper *s = fine->stepper;
    r->record.motion->stats.estimate_margin = run_margin(&r->control);
    double unit = r->problem.model->scale.time_s, eighth = fw_dynamics_end(&r->problem) / 8;
    differences d;
    compare(fine, coarse, &d);
    r->record.motion->displaced = fine->peaks.displaced;
    for (int i = 0; i < fine->peaks.npin; i++) {
        fw_dynamics_peak *p = &r->record.motion->peak[i];
        /* who compares again until it comes out small meets luck: errors fall with the tolerance */
        double least =
            r->control.part > 0 && r->control.lower > 0 ? p->error_rad / r->control.lower : 0;
        *p = fine->peaks.peak[i];
        double late = 1.25 * p->t_s + eighth;
        int near_zero = (int)fmin(FW_MARKS, 1 + late * FW_MARKS / (8 * eighth));
        int mark = fw_dynamics_peaks_first_mark(&fine->peaks, &coarse->peaks, late);
        p->t_s *= unit;
        p->error_rad = fmax(least, difference_counts(r, fine, coarse, &d, i, mark)) +
                       DBL_EPSILON * (double)(8 + s->steps) * (1 + fabs(p->angle_rad)) +
                       fine->uncertainty[near_zero];
    }
    if (fine->extreme)
        fw_dynamics_run_take_extremes(&r->record, run_margin(&r->control), fine->extreme,
                                      coarse->extreme, fine->uncertainty[FW_MARKS], s->steps);
}

/* nobody wants to know: peaks as they came out */
static void no_estimate(fw_dynamics_run *r, const pass *only) {
    r->record.motion->displaced = only->peaks.displaced;
    for (int i = 0; i < only->peaks.npin; i++) {
        r->record.motion->peak[i] = only->peaks.peak[i];
        r->record.motion->peak[i].t_s *= r->problem.model->scale.time_s;
        r->record.motion->peak[i].error_rad = HUGE_VAL;
    }
    if (only->extreme)
        fw_dynamics_run_take_extremes(&r->record, run_margin(&r->control), only->extreme,
                                      only->extreme, HUGE_VAL, 0);
}

/* ---- tolerances ---- */

typedef struct pair { /* of runs */
    pass fine, coarse;
    bool again;      /* coarse: an answer that was not good enough */
    double answered; /* tolerance of the answer before; 0: there was none */
    double began_s;  /* of CPU, before the first run */
} pair;

void fw_dynamics_spent_less(fw_dynamics_spent *spent, const fw_dynamics_motion *motion) {
    if (!spent || !motion) return;
    atomic_fetch_sub(&spent->all, motion->stats.all_rhs);
    if (motion->ledger.hinge.used == FW_HINGE_ELASTICA)
        atomic_fetch_sub(&spent->beams, motion->stats.all_rhs);
}

static void note_run(fw_dynamics_recorder *record, const pass *p) {
    record->motion->stats.runs++;
    record->motion->stats.all_rhs += p->stepper->rhs;
    record->motion->stats.all_steps += p->stepper->steps;
}

/* the answer of a pair */
static fw_status run_fine(fw_dynamics_run *r, pair *two, double rtol, const pass *marks, int rows) {
    r->record.motion->nsample = rows;
    if (two->again &&
        r->problem.options->other) { /* what the answer so far showed is the looser run's */
        void *looser = r->record.motion->observed;
        r->record.motion->observed = r->record.motion->compared;
        r->record.motion->compared = looser;
    }
    double began = cpu_seconds();
    FW_TRY(run_once(r, rtol, marks, true, &two->fine));
    note_run(&r->record, &two->fine);
    take_statistics(&r->record, two->fine.stepper, rtol, cpu_seconds() - began);
    return FW_OK;
}

static fw_status run_coarse(fw_dynamics_run *r, pair *two, double rtol, const pass *marks) {
    two->coarse = (pass){0};
    fw_status status = run_once(r, rtol, marks, false, &two->coarse);
    if (two->coarse.stepper) note_run(&r->record, &two->coarse);
    return status;
}

static fw_status end_tries(fw_dynamics_run *r, const pair *two, double looser, bool enough) {
    fw_dynamics_motion_stats *stats = &r->record.motion->stats;
    stats->looser_rtol = looser;
    stats->estimate_cpu_s = fmax(0, cpu_seconds() - two->began_s - stats->cpu_s);
    return fw_dynamics_run_report(r, enough);
}

/* The tolerance is asked for, or the integrator is one that nothing is known of: then it is
   tightened by 100 until the estimate is good enough. */
static fw_status tighten(fw_dynamics_run *r) {
    const fw_dynamics_motion_options *o = r->problem.options;
    double rtol = chosen_rtol(o, &r->problem),
           tightest = fw_dynamics_tolerance_tightest(&r->problem);
    int rows = r->record.motion->nsample;
    pair two = {.began_s = cpu_seconds()};
    for (;;) {
        FW_TRY(run_fine(r, &two, rtol, two.again ? &two.coarse : NULL, rows));
        if (o->looser == 1 || (o->alone && o->rtol > 0)) {
            no_estimate(r, &two.fine);
            return fw_dynamics_run_report(r, true);
        }
        double looser = o->looser > 0 ? o->looser * rtol : 100 * rtol;
        if (!two.again) FW_TRY(run_coarse(r, &two, looser, &two.fine));
        estimate_errors(r, &two.fine, &two.coarse);
        bool enough =
            o->rtol > 0 || r->record.motion->ended || fw_dynamics_run_error_ratio(&r->record) <= 1;
        if (enough || rtol <= tightest) {
            return end_tries(r, &two, looser, enough);
        }
        /* the next estimate has this run to compare with, unless laws limit its steps (which are
           longer in runs that only serve the estimate) */
        two.again = rtol / 100 >= tightest && r->problem.nstride == 0;
        if (two.again) two.coarse = two.fine;
        rtol = fmax(tightest, rtol / 100);
    }
}

/* the looser run by another integrator, which takes over when it comes to the end cheaper; steps:
   of the first one, 0: that was not made yet */
static fw_status try_other(fw_dynamics_run *r, pair *two, double looser, long steps, bool *won) {
    const fw_maths_stepper_row *before = r->control.integrator;
    const pass kept = two->coarse;
    const fw_dynamics_integrator_trial trial = fw_dynamics_integrator_trial_of(&r->control, steps);
    *won = false;
    if (trial.steps <= 0) return FW_OK;
    fw_diags *said = r->diags, own = fw_diags_new(r->problem.arena);
    r->diags = &own, r->control.integrator = trial.row, r->control.trial = trial.steps;
    fw_status status = run_coarse(r, two, looser, NULL);
    r->diags = said, r->control.trial = 0;
    if (own.failed) return FW_NOMEM;
    *won = status == FW_OK;
    if (*won) return fw_dynamics_integrator_trial_won(r, steps, two->coarse.stepper->steps);
    r->control.integrator = before;
    two->coarse = kept;
    return status == FW_CANCELLED || status == FW_NOMEM ? status : FW_OK;
}

/* with somebody looking on the trial is a run of its own: what it shows must not be mixed with the
   other's */
static fw_status try_unseen(fw_dynamics_run *r, pair *two, double looser) {
    const fw_dynamics_motion_options *asked = r->problem.options;
    fw_dynamics_motion_options unseen = *asked;
    bool won;
    unseen.observe = NULL, unseen.unsettled = NULL, unseen.other = NULL;
    r->problem.options = &unseen;
    fw_status status = try_other(r, two, looser, 0, &won);
    r->problem.options = asked;
    return status;
}

/* the run that is compared with, by whichever integrator is cheaper where that is in doubt */
static fw_status first_run(fw_dynamics_run *r, pair *two, double looser) {
    const fw_dynamics_motion_options *o = r->problem.options;
    bool won, again = fw_dynamics_integrator_trial_of(&r->control, 0).steps > 0;
    if (o->unsettled || o->other) FW_TRY(try_unseen(r, two, looser));
    FW_TRY(try_other(r, two, looser, 0, &won));
    if (won) return FW_OK;
    FW_TRY(run_coarse(r, two, looser, NULL));
    return again ? FW_OK : try_other(r, two, looser, two->coarse.stepper->steps, &won);
}

/* one pair of runs; quiet: FW_SOLVER without a word where tighter ones may still go through */
static fw_status try_tolerances(fw_dynamics_run *r, pair *two, fw_dynamics_tolerances *tolerances,
                                int rows, bool quiet) {
    fw_diags *said = r->diags, own = fw_diags_new(r->problem.arena);
    if (quiet) r->diags = &own;
    fw_status status = FW_OK;
    r->control.part = tolerances->part;
    if (!two->again) {
        status = first_run(r, two, tolerances->looser);
        if (status == FW_OK)
            *tolerances = fw_dynamics_tolerance_answer(r, *tolerances, two->coarse.stepper->steps);
    }
    r->control.trust = tolerances->margin, r->control.part = tolerances->part;
    r->control.lower = two->answered > 0 ? two->answered / tolerances->rtol : 0;
    two->answered = tolerances->rtol;
    if (status == FW_OK) status = run_fine(r, two, tolerances->rtol, &two->coarse, rows);
    r->diags = said;
    if (own.failed) return FW_NOMEM;
    const bool last_word = status != FW_OK && (status != FW_SOLVER || ends_alike(r));
    for (size_t i = 0; i < own.count && last_word; i++)
        fw_diags_add(said, &own.item[i], FW_ERROR);
    return said->failed ? FW_NOMEM : status;
}

/* what sticks, slips or touches at other times does not change in proportion to the tolerance: of
   60 such devices one had an error of 1.8 times the estimate without this */
static const double fw_trust_events = 3, fw_part_events = 2;

/* What rings undamped behind a snap departs from its neighbours e-fold, again and again: a tolerance a thousand times
   tighter follows it for some periods more, and errors of the whole scene stay what they are. Where they are ten times
   what is wanted, did not fall by half between two pairs of runs that are so far apart, and so many evaluations were
   made, a third pair is not: of a verdict, whose bands have those errors, and which is undecided by them. A motion
   much like this one that ended so says it of its first pair. Cost: saves the tightest runs, which take most. Source:
   the largest Lyapunov exponent; Hairer, Norsett and Wanner I, I.16. Test: test_trust.c,
   test_chaos_is_not_chased */
static const double fw_vain_fall = 0.5, fw_vain_apart = 100;
static const long fw_vain_rhs = 1000000;

static bool is_vain(const fw_dynamics_run *r, double off, double before, double apart) {
    const fw_dynamics_motion *like = r->problem.options->like;
    if (!r->problem.options->unsettled || !(off >= FW_DYNAMICS_VAIN)) return false;
    if (like && like->stats.beyond >= FW_DYNAMICS_VAIN) return true;
    return before > 0 && off > fw_vain_fall * before && apart >= fw_vain_apart &&
           r->record.motion->stats.all_rhs > fw_vain_rhs;
}

/* Loose runs stop where a tight one passes, next to singular positions: they are not the last word.
   Below a millionth of what was tried first they are. */
static fw_status steer(fw_dynamics_run *r) {
    int rows = r->record.motion->nsample;
    pair two = {.began_s = cpu_seconds()};
    fw_dynamics_tolerances tolerances = fw_dynamics_tolerance_start(
        &r->control, r->control.integrator, fw_dynamics_tolerance_wanted(&r->record));
    double looser = 0, before = 0; /* of the try before, and how far off it was */
    for (int tries = 1;; tries++) {
        bool last = tolerances.rtol <= fmax(1e-9, fw_dynamics_tolerance_tightest(&r->problem));
        fw_status status = try_tolerances(r, &two, &tolerances, rows, !last);
        if (status == FW_SOLVER && !last && !ends_alike(r) && isnan(r->control.given_up_s)) {
            two.again = false;
            tolerances = fw_dynamics_tolerance_next(&r->control, tolerances, 1e3, 1, &two.again);
            continue;
        }
        FW_TRY(status);
        if (r->problem.system->record.events > 0 && !r->problem.options->unsettled)
            r->control.trust *= fw_trust_events, r->control.part *= fw_part_events;
        estimate_errors(r, &two.fine, &two.coarse);
        double off = r->record.motion->ended ? 0 : fw_dynamics_run_error_ratio(&r->record);
        const bool vain = is_vain(r, off, before, looser / tolerances.looser);
        if (off <= 1 || vain || tolerances.rtol <= fw_dynamics_tolerance_tightest(&r->problem)) {
            r->record.motion->stats.beyond = off > 1 ? off : 0;
            r->record.motion->stats.needed_rtol =
                fw_dynamics_tolerance_needed(tolerances.looser, off, looser, before);
            return end_tries(r, &two, tolerances.looser, off <= 1);
        }
        looser = tolerances.looser, before = off;
        bool back;
        FW_TRY(fw_dynamics_integrator_back(r, two.fine.stepper->steps, &back));
        if (back) {
            two.again = false;
            tolerances = fw_dynamics_tolerance_start(&r->control, r->control.integrator,
                                                     fw_dynamics_tolerance_wanted(&r->record));
            tries = 0;
            continue;
        }
        tolerances = fw_dynamics_tolerance_next(&r->control, tolerances, off, tries, &two.again);
        if (two.again) two.coarse = two.fine;
    }
}

static fw_status find_motion(fw_dynamics_run *r) {
    r->record.motion->observed = r->problem.options->context;
    r->record.motion->compared = r->problem.options->other;
    r->control.trust = 1, r->control.part = 0;
    r->control.end = r->control.before = (fw_dynamics_formula_end){.t = (double)NAN};
    bool known = fw_dynamics_tolerance_known(&r->problem, r->control.integrator) &&
                 !(r->problem.options->looser > 0);
    return known ? steer(r) : tighten(r);
}

/* starts over where a choice of ours was wrong */
static fw_status solve(fw_dynamics_run *r) {
    int rows = r->record.motion->nsample;
    r->control.given_up_s = (double)NAN;
    fw_status status = find_motion(r);
    if (isnan(r->control.given_up_s)) return status;
    FW_TRY(fw_dynamics_integrator_change(r));
    r->record.motion->nsample = rows;
    return find_motion(r);
}

/* ---- the entry ---- */

static fw_status assembled(fw_dynamics_run *r, const fw_effects_loads *loads) {
    const fw_mechanism *m;
    FW_TRY(fw_effects_at_start(r->problem.arena, r->problem.mechanism, loads, &m));
    FW_NEED(r->problem.q0 = fw_arena_array(r->problem.arena, double, 3 * (size_t)m->nbody));
    for (int b = 0; b < m->nbody; b++) {
        r->problem.q0[3 * b] = m->body[b].x_m;
        r->problem.q0[3 * b + 1] = m->body[b].y_m;
        r->problem.q0[3 * b + 2] = m->body[b].phi_rad;
    }
    double moved;
    const fw_status status = fw_assembly_assemble_giving(r->problem.arena, m, loads->released,
                                                         r->problem.q0, &moved, r->diags);
    if (status == FW_SOLVER && loads->strained)
        fw_diag_warning(r->diags, 100, r->problem.scene->place,
                        "%s%s: heat or stress makes the layer grow or shrink against the ground%s",
                        FW_NAMED("scene", fw_dynamics_scene_name(&r->problem)),
                        fw_dynamics_run_pinned(r));
    FW_TRY(status);
    r->record.motion->stats.assembly_moved_m = fmax(moved, r->problem.options->moved_m);
    return FW_OK;
}

static void set_stabilisation(fw_dynamics_recorder *record) {
    const char *wanted =
        record->problem->options->stabilise ? record->problem->options->stabilise : "projection";
    record->motion->stabilise = wanted;
    record->problem->system->projecting = strcmp(wanted, "projection") == 0;
    /* both roots at 5 per scaled unit of time: some five times faster than the motion itself */
    record->problem->system->baumgarte = strcmp(wanted, "baumgarte") == 0 ? 5 : 0;
}

static fw_status report_method(fw_dynamics_recorder *record) {
    const fw_multibody_method *method = record->problem->model->method;
    record->motion->method_report = record->problem->why;
    if (!method->report) return FW_OK;
    fw_text text = fw_text_new(record->problem->arena);
    if (record->problem->why) fw_text_printf(&text, "%s; ", record->problem->why);
    FW_TRY(method->report(record->problem->system, record->problem->mechanism, &text));
    FW_TRY(fw_text_end(&text));
    record->motion->method_report = text.data;
    return FW_OK;
}

fw_status fw_dynamics_check_request(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                    const fw_dynamics_motion_options *options, fw_diags *diags) {
    fw_dynamics_motion unused = {0};
    FW_TRY(fw_dynamics_check_options(options, diags));
    FW_TRY(fw_multibody_check_motion(mechanism, scene, diags));
    return fw_dynamics_check_names(options, diags, &unused);
}

fw_status fw_dynamics_simulate_compiled(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_device_scene *scene,
                                        const fw_dynamics_motion_options *options,
                                        const fw_effect_ledger *ledger,
                                        const fw_effects_loads *given, fw_diags *diags,
                                        const fw_dynamics_motion **motion) {
    fw_effects_loads own = *given, *loads = &own;
    fw_dynamics_run r = {
        .problem = {.arena = arena, .mechanism = mechanism, .scene = scene, .options = options},
        .control = {.problem = &r.problem},
        .record = {.problem = &r.problem},
        .diags = diags};
    fw_dynamics_problem *problem = &r.problem;
    fw_dynamics_motion *result;
    *motion = NULL;
    FW_NEED(r.record.motion = result = fw_arena_one(arena, fw_dynamics_motion));
    result->ledger = *ledger;
    result->accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    FW_NEED(result->loads = fw_effects_loads_keep(arena, given));
    FW_TRY(fw_dynamics_check_names(options, diags, result));
    FW_TRY(fw_dynamics_method_choose(&r, loads));
    FW_TRY(fw_effects_strain(arena, mechanism, loads, &problem->mechanism));
    FW_TRY(assembled(&r, loads));
    FW_TRY(fw_multibody_model_new(arena, problem->mechanism, loads, problem->q0, scene->duration_s,
                                  fw_multibody_method_find(result->method), &problem->model));
    FW_TRY(fw_multibody_system_new(arena, problem->model, problem->mechanism, diags,
                                   &problem->system));
    FW_TRY(fw_dynamics_run_arrays(&r));
    set_stabilisation(&r.record);
    problem->most_angle = options->most_angle_rad > 0 ? options->most_angle_rad : HUGE_VAL;
    FW_TRY(fw_dynamics_run_prepare(&r, loads));
    FW_TRY(fw_dynamics_integrator_choose(&r, loads, options->integrator));
    if (options->late_rows) FW_TRY(fw_dynamics_record_late(&r.record));
    FW_TRY(fw_effects_hinges_follow(arena, loads));
    if (result->ledger.hinge.used == FW_HINGE_ELASTICA)
        result->ledger.hinge.error = fw_effects_followed_error;
    fw_status status = solve(&r);
    FW_TRY(fw_effects_hinges_follow(NULL, loads));
    FW_TRY(status);
    FW_TRY(report_method(&r.record));
    fw_dynamics_motion_widen(result);
    *motion = result;
    return FW_OK;
}

fw_status fw_dynamics_simulate(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene,
                               const fw_dynamics_motion_options *options, fw_diags *diags,
                               const fw_dynamics_motion **motion) {
    fw_effects_loads loads;
    fw_effect_ledger ledger;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    *motion = NULL;
    FW_TRY(fw_dynamics_check_request(mechanism, scene, options, diags));
    FW_TRY(fw_effects_compile(arena, mechanism, scene, &options->effects, accuracy, diags, &ledger,
                              &loads));
    return fw_dynamics_simulate_compiled(arena, mechanism, scene, options, &ledger, &loads, diags,
                                         motion);
}
