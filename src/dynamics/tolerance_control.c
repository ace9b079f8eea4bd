/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tolerances by the accuracy that is wanted. Two runs are made, a looser one first, then the
   answer. With rho the ratio of their tolerances and D what they differ by
   (fw_dynamics_tolerance_difference), the error of the answer is

     |error| <= c (10/rho)^0.6 D + b |drift of the energies| + round-off,  b = 1/2

   c = 1, for dop853 0.7 where the looser tolerance is at most 1e-6; b = 3 where both runs took
   about the same steps: then D says nothing of the steps' error. Twice as much D where switches of
   contacts, stops or friction turned: when they do does not go with the tolerance. How far apart
   the two are follows from the steps N of the looser one and the number n of bodies: the error of
   dop853 is about rtol kappa N^0.9 n^1.5 (a fit over 545 random devices at tolerances from 1e-2 to
   1e-11, right within a factor of 9 for two of three of them), so that

     rho = looser kappa N^0.9 n^1.5 / wanted,  at least sqrt(10), at most 100

   Where the estimate is not below what is wanted, this answer is the looser run of the next one,
   whose tolerance is lower by 2 estimate / wanted, at least by sqrt(10). Joint forces, and
   verdicts, count D whole (trust below). Validity: integrators in the table below; wanted between
   1e-12 and 0.1. Error: measured on a thousand other random devices, docs/theory/integrators.md.
   Source: tolerance proportionality, Hairer, Norsett and Wanner I, II.4; factors are measured.
   Test: test_steer.c, tests/accuracy/survey.c. */
#include "dynamics/run.h"
#include "base/constants.h"
#include "multibody/system.h"
#include <float.h>
#include <math.h>

static const double fw_tightest = 1e-13;
/* beyond, steps of order 8 span whole oscillations, and what they miss both runs may miss */
static const double fw_loosest_of_two = 1e-3, fw_loosest_of_verdicts = 5e-4;
static const double fw_ratio = 10, fw_ratio_far = 100, fw_ratio_least = 3.1622776601683795;
static const double fw_part_power = 0.6;
static const double fw_loose_of_forces = 25; /* as pace_row.loose, where forces are asked for */
static const double fw_tolerable = 1e-6;     /* looser tolerances above are trusted less */

typedef struct tolerance_trust { /* above fw_tolerable, and below */
    double kappa;                /* of the error law; 0: there is none, and the ratio is 10 */
    double part;                 /* c */
} tolerance_trust;
typedef struct tolerance_row {
    const fw_maths_stepper_row *row;
    double loose; /* wanted over the looser tolerance, for a start */
    tolerance_trust loose_ones, tight_ones;
} tolerance_row;
static const tolerance_row fw_dynamics_tolerance_table[] = {
    {&fw_maths_dop853_row, 3, {0.04, 1}, {0.015, 0.7}},
    {&fw_maths_radau5_row, 10, {0, 1}, {0, 1}},
    {&fw_maths_dopri5_row, 30, {0, 1}, {0, 1}}};

static const tolerance_row *row_of(const fw_maths_stepper_row *row) {
    for (size_t i = 0; i < sizeof fw_dynamics_tolerance_table / sizeof *fw_dynamics_tolerance_table;
         i++)
        if (fw_dynamics_tolerance_table[i].row == row) return &fw_dynamics_tolerance_table[i];
    return NULL;
}

/* where m r^2/J is huge the accelerations carry round-off of 1e-16 m r^2/J; below some 1e-3 of that
   the error estimate follows noise, and steps shrink for nothing. Likewise where a light body sits
   between heavy ones, but for methods in independent coordinates. */
static double noise_floor(const fw_dynamics_problem *problem) {
    const fw_multibody_model *m = problem->model;
    double ratio = 0, masses = m->method->independent ? 0 : 3e-17 * problem->uneven;
    for (int i = 0; i < 2 * m->nblock; i++) {
        int b = m->body[i];
        double x = m->local[2 * i], y = m->local[2 * i + 1];
        if (b < m->nbody) ratio = fmax(ratio, m->jinv[b] / m->minv[b] * (x * x + y * y));
    }
    return fmax(3e-19 * ratio, masses);
}

/* before an integrator is chosen nothing is trusted */
static const tolerance_trust *trust_of(const fw_dynamics_controller *control, double looser) {
    static const tolerance_trust none = {0, 1};
    const tolerance_row *p = row_of(control->integrator);
    if (!p) return &none;
    return looser > fw_tolerable ? &p->loose_ones : &p->tight_ones;
}

double fw_dynamics_tolerance_tightest(const fw_dynamics_problem *problem) {
    return fmax(fw_tightest, noise_floor(problem));
}

static double wanted_of_deflections(const fw_dynamics_motion *motion) {
    return fmax(motion->accuracy - motion->ledger.left_out, 0.05 * motion->accuracy);
}

/* Where velocities are looked at they are those of what goes to and fro, which may be a small share of
   the deflection: it is followed as well as what is required of a probe (fw_probe_monitor_unsettled).
   Test: test_probe.py */
static const double fw_of_swing = 30, fw_swing_finest = 1e-8;

static double wanted_of(const fw_dynamics_motion *motion) {
    const double wanted = wanted_of_deflections(motion), swing = motion->ledger.swing;
    return swing > 0 ? fmin(wanted, fmax(wanted * fw_of_swing * swing, fw_swing_finest)) : wanted;
}

double fw_dynamics_tolerance_wanted(const fw_dynamics_recorder *record) {
    return wanted_of(record->motion);
}

bool fw_dynamics_tolerance_known(const fw_dynamics_problem *problem,
                                 const fw_maths_stepper_row *row) {
    return !(problem->options->rtol > 0) && row_of(row);
}

/* Verdicts stand on their errors: of 400 devices near their limit, factors that serve 99 % left
   three outside their bands, and runs a hundred times apart, whose difference counts as it is, none
   of 60 000 (test_hard_verdict.c, test_peak.c). Loads that may begin at any time are met by chance:
   likewise, and run_margin of dynamics_simulate.c counts. */
static bool far_apart(const fw_dynamics_problem *problem) {
    return problem->sudden || problem->options->unsettled;
}

/* What differences of the two runs are multiplied with. Runs that the same tolerances may have come
   out alike by chance must be far apart for their difference to count as it is. */
static void set_margins(const fw_dynamics_controller *control, fw_dynamics_tolerances *p) {
    double rho = p->looser / p->rtol;
    p->margin = 1, p->part = 0;
    if (far_apart(control->problem)) return;
    p->margin = p->looser > fw_tolerable ? 3 : 2;
    if (rho < fw_ratio) p->margin *= pow(fw_ratio / rho, fw_part_power);
    p->part = trust_of(control, p->looser)->part * pow(fw_ratio / rho, fw_part_power);
}

/* Round-off as large as the error does not go with the tolerance. */
static fw_dynamics_tolerances tolerances_at(const fw_dynamics_controller *control, double looser,
                                            double rtol) {
    double tightest = fw_dynamics_tolerance_tightest(control->problem);
    const double rounded = 1 + 1e-9; /* of a quotient that comes to the tightest one */
    fw_dynamics_tolerances p = {.looser = looser, .rtol = rtol};
    if (p.rtol <= rounded * tightest)
        return (fw_dynamics_tolerances){.looser = 100 * tightest, .rtol = tightest, .margin = 1};
    set_margins(control, &p);
    return p;
}

static fw_dynamics_tolerances tolerances_below(const fw_dynamics_controller *control,
                                               double looser) {
    bool far = far_apart(control->problem);
    looser = fmin(looser, far ? fw_loosest_of_verdicts : fw_loosest_of_two);
    return tolerances_at(control, looser, looser / (far ? fw_ratio_far : fw_ratio));
}

/* Forces of hinges that give are a stiffness times a tiny displacement: to have them as exactly as
   angles takes tolerances this much tighter, as measured on the devices of docs/gallery. */
static double tighter_for_forces(const fw_dynamics_problem *problem) {
    if (problem->model->nreleased == 0) return 1;
    return problem->options->reactions ? 3000 : 1;
}

/* ---- where to begin, as a motion much like this one tells ---- */

/* Between two tolerances errors go with a power of them, some 1.5 as a rule, since phases count
   beside peaks. One of two tries may have come out small by luck: the tighter answer counts. */
static const double fw_power = 1.5;

static double enough_by(double looser, double off) {
    return looser > 0 ? looser * pow(off, -1 / fw_power) : HUGE_VAL;
}

double fw_dynamics_tolerance_needed(double looser, double off, double before, double off_before) {
    return off > 0 ? fmin(enough_by(looser, off), enough_by(before, off_before)) : 0;
}

/* a fifth of what is just allowed, so that a try at a looser tolerance, which would be thrown away,
   is left out. What observers want grows at most to five times with the accuracy. */
static double known_of(const fw_dynamics_motion *like, double wanted) {
    if (!like || !(like->stats.needed_rtol > 0)) return HUGE_VAL;
    double room = 0.2 * fmin(5, wanted / wanted_of(like));
    return like->stats.needed_rtol * pow(room, 1 / fw_power);
}

fw_dynamics_tolerances fw_dynamics_tolerance_start(const fw_dynamics_controller *control,
                                                   const fw_maths_stepper_row *row, double wanted) {
    const fw_dynamics_motion_options *o = control->problem->options;
    if (o->unsettled && o->like &&
        o->like->stats.beyond >= FW_DYNAMICS_VAIN) /* as far as that went, and no farther */
        return tolerances_at(control, o->like->stats.looser_rtol, o->like->stats.rtol);
    if (o->unsettled)
        return tolerances_below(control, fmin(fmin(1e-4, wanted / 100), known_of(o->like, wanted)));
    if (control->problem->sudden) return tolerances_below(control, wanted / 30);
    double loose = control->problem->options->reactions ? fw_loose_of_forces : row_of(row)->loose;
    return tolerances_below(control, wanted / tighter_for_forces(control->problem) / loose);
}

fw_dynamics_tolerances fw_dynamics_tolerance_answer(const fw_dynamics_run *r,
                                                    fw_dynamics_tolerances tolerances, long steps) {
    const double kappa = trust_of(&r->control, tolerances.looser)->kappa;
    double bodies = r->problem.model->nbody,
           wanted = fw_dynamics_tolerance_wanted(&r->record) / tighter_for_forces(&r->problem);
    if (far_apart(&r->problem) || !(kappa > 0) ||
        tolerances.rtol <= fw_dynamics_tolerance_tightest(&r->problem))
        return tolerances;
    double law = kappa * pow((double)steps, 0.9) * pow(bodies, 1.5);
    double ratio = fmin(fw_ratio_far, tolerances.looser * law / wanted);
    double least = r->problem.options->reactions ? fw_ratio : fw_ratio_least;
    tolerances.rtol =
        fmax(fw_dynamics_tolerance_tightest(&r->problem), tolerances.looser / fmax(least, ratio));
    set_margins(&r->control, &tolerances);
    return tolerances;
}

fw_dynamics_tolerances fw_dynamics_tolerance_next(const fw_dynamics_controller *control,
                                                  fw_dynamics_tolerances tolerances, double off,
                                                  int tries, bool *reuse) {
    const bool far = far_apart(control->problem);
    /* errors fall faster than tolerances: to go with `off` itself makes them smaller than they have to be, which only
       those want who see them */
    const double needed =
        far && control->problem->options->sparing ? pow(2 * off, 1 / fw_power) : 2 * off;
    /* what does not go with the tolerance is not waited for: 10, 30, 100, ... */
    double lower = fmax(needed, tries > 1 ? pow(10, 0.5 * tries) : fw_ratio_least);
    if (!(lower < 1e3)) lower = 1e3;
    if (far) {
        *reuse = lower <= fw_ratio_far && control->problem->nstride == 0;
        return tolerances_below(control,
                                tolerances.looser / fmax(lower, *reuse ? fw_ratio_far : lower));
    }
    *reuse = control->problem->nstride == 0;
    if (!*reuse) return tolerances_below(control, tolerances.looser / lower);
    if (control->problem->options->reactions) lower = fmax(lower, fw_ratio);
    fw_dynamics_tolerances next = tolerances_at(control, tolerances.rtol, tolerances.rtol / lower);
    /* this once errors did not go with the tolerance */
    if (next.part > 0) next.part = fmax(next.part, trust_of(control, next.looser)->part);
    *reuse = next.looser == tolerances.rtol;
    return next;
}

/* ---- what the two runs differ by ---- */

/* Sizes count, angles at the marks a fifth: what is asked for are peaks, and an error of phase,
   which methods of even order make first, moves the angles of an oscillation but not its peaks. The
   largest size so far is compared at sixteen marks, because one number may agree by chance. */
double fw_dynamics_tolerance_difference(double peak, double sizes, double angles) {
    return fmax(fmax(peak, sizes), 0.2 * angles);
}

double fw_dynamics_tolerance_energy_ratio(long steps, long looser_steps) {
    return 20 * steps <= 21 * looser_steps ? 3 : 0.5;
}

/* ---- what is said ---- */

/* Is a motion good enough, and what is said of that. */

typedef struct reached { /* largest deflection, and errors of any pin; force 0 when not asked for */
    double angle_rad, error_rad, force_N, error_N;
} reached;

static reached what_is_reached(const fw_dynamics_recorder *record) {
    reached x = {.angle_rad = record->motion->displaced};
    for (int i = 0; i < record->motion->npin; i++) {
        x.angle_rad = fmax(x.angle_rad, fabs(record->motion->peak[i].angle_rad));
        x.error_rad = fmax(x.error_rad, record->motion->peak[i].error_rad);
        if (!record->problem->options->reactions) continue;
        x.force_N = fmax(x.force_N, record->motion->force_peak[i].force_N);
        x.error_N = fmax(x.error_N, record->motion->force_peak[i].error_N);
    }
    return x;
}

/* What errors are relative to, rad. A mechanism that nothing moves has no deflection, only round-off,
   which no tolerance makes accurate: there 1e-4 is taken, a thousandth of what a hinge bears. Loads that
   balance each other leave it at rest, too: what is below 1e-8 has no accuracy of its own; of an arm
   of 1 mm that is 10 pm. */
static double relative_to(const fw_dynamics_recorder *record, const reached *x) {
    return fmax(record->problem->idle ? 1e-4 : 1e-8, x->angle_rad);
}

double fw_dynamics_run_error_ratio(const fw_dynamics_recorder *record) {
    const reached x = what_is_reached(record);
    const fw_dynamics_motion_options *o = record->problem->options;
    double wanted = fw_dynamics_tolerance_wanted(record), off = 0;
    if (x.error_rad > 0) off = x.error_rad / (wanted * relative_to(record, &x));
    if (o->reactions) off = fmax(off, fw_dynamics_run_extremes_off(record) / wanted);
    double unsettled = !o->unsettled
                           ? 0
                           : o->unsettled(record->motion->observed, record->motion->compared,
                                          record->motion->stats.estimate_margin, wanted);
    return fmax(off, unsettled > 1 ? fmax(unsettled, 5) : unsettled);
}

/* an angle or a force that is round-off has no relative accuracy */
static const double nothing = 1e-10;

static void warn_inaccurate(const fw_dynamics_run *r) {
    const reached x = what_is_reached(&r->record);
    double wanted = wanted_of_deflections(r->record.motion), degree = FW_DEG_PER_RAD;
    double accuracy = r->record.motion->accuracy;
    char a[32], b[32], c[32];
    if (x.error_rad > fmax(nothing, wanted * relative_to(&r->record, &x)))
        fw_diag_warning(r->diags, 240, r->problem.scene->place,
                        "%s%s: peaks are uncertain by %s deg where the largest is %s deg, and "
                        "an accuracy of %s is wanted; no tolerance is tight enough: shorten the "
                        "scene, or judge by the stated errors",
                        FW_NAMED("scene", fw_text_name(r->problem.scene->name)),
                        fw_number_text(a, sizeof a, x.error_rad * degree, 3),
                        fw_number_text(b, sizeof b, x.angle_rad * degree, 3),
                        fw_number_text(c, sizeof c, accuracy, 3));
    else if (x.error_N > fmax(nothing * fw_multibody_newton(r->problem.model), wanted * x.force_N))
        fw_diag_warning(r->diags, 240, r->problem.scene->place,
                        "%s%s: joint forces are uncertain by %s N where the largest is %s N, "
                        "and an accuracy of %s is wanted; no tolerance is tight enough: shorten "
                        "the scene, or judge by the stated errors",
                        FW_NAMED("scene", fw_text_name(r->problem.scene->name)),
                        fw_number_text(a, sizeof a, x.error_N, 3),
                        fw_number_text(b, sizeof b, x.force_N, 3),
                        fw_number_text(c, sizeof c, accuracy, 3));
}

/* rtol is relative to the amplitude, or to the motion where that is larger; 100 times as much is
   not explained, and a thousandth is always allowed */
static double energy_allowed(const fw_dynamics_recorder *record) {
    const fw_multibody_model *m = record->problem->model;
    double mass = 0;
    for (int b = 0; b < m->nbody; b++)
        mass += m->mass[b] + m->inertia[b];
    double motion = sqrt(record->largest / mass);
    double part = motion < record->problem->amplitude
                      ? record->problem->amplitude / fmax(motion, DBL_MIN)
                      : 1;
    return fmax(1e-3, 100 * record->motion->stats.rtol * part);
}

static void warn_energy(const fw_dynamics_run *r) {
    double off = r->record.motion->stats.energy_error;
    char a[32], b[32];
    if (!(off > energy_allowed(&r->record))) return;
    fw_diag_unreliable(r->diags, 241, r->problem.scene->place,
                       "%s%s: the energy balance error is %s of the largest energy, far more "
                       "than the tolerance %s explains; this motion is not reliable: use another "
                       "--method or --integrator",
                       FW_NAMED("scene", fw_text_name(r->problem.scene->name)),
                       fw_number_text(a, sizeof a, off, 2),
                       fw_number_text(b, sizeof b, r->record.motion->stats.rtol, 2));
}

/* what was chosen and why */
static fw_status report_tolerance(fw_dynamics_recorder *record, bool enough) {
    const double tightest = fw_dynamics_tolerance_tightest(record->problem);
    const fw_dynamics_motion_stats *s = &record->motion->stats;
    bool asked = record->problem->options->rtol > 0;
    char wanted[32], rtol[32], error[32], looser[32];
    fw_percent_text(wanted, sizeof wanted, record->motion->accuracy);
    fw_percent_text(error, sizeof error, fw_dynamics_motion_estimated(record->motion));
    fw_number_text(rtol, sizeof rtol, s->rtol, 2);
    fw_number_text(looser, sizeof looser, s->looser_rtol, 2);
    fw_text text = fw_text_new(record->problem->arena);
    if (asked)
        fw_text_printf(&text, "rtol %s was asked for", rtol);
    else
        fw_text_printf(&text, "rtol %s is %s for %s %%", rtol,
                       enough                   ? "enough"
                       : s->rtol > 2 * tightest ? "not enough, and a tighter one would not be,"
                                                : "not enough and the tightest that there is",
                       wanted);
    if (s->looser_rtol > 0)
        fw_text_printf(&text,
                       ": by a run at %s that it was compared with, peaks are off by at most %s %%",
                       looser, error);
    if (s->runs > 2) fw_text_printf(&text, "; %d runs were computed", s->runs);
    if (!asked && !enough) fw_text_add(&text, "; judge by the stated errors");
    FW_TRY(fw_text_end(&text));
    record->motion->tolerance = text.data;
    return FW_OK;
}

fw_status fw_dynamics_run_report(fw_dynamics_run *r, bool enough) {
    if (!enough) warn_inaccurate(r);
    warn_energy(r);
    return report_tolerance(&r->record, enough);
}
