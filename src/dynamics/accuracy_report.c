/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is a motion good enough, and what is said of that. */
#include "dynamics/tolerance_control.h"
#include "base/constants.h"
#include "multibody/system.h"
#include <float.h>
#include <math.h>

typedef struct reached { /* largest values and errors of any pin; force 0 when not asked for */
    double angle_rad, error_rad, force_N, error_N;
} reached;

static reached what_is_reached(const fw_dynamics_recorder *record) {
    reached x = {0};
    for (int i = 0; i < record->motion->npin; i++) {
        x.angle_rad = fmax(x.angle_rad, fabs(record->motion->peak[i].angle_rad));
        x.error_rad = fmax(x.error_rad, record->motion->peak[i].error_rad);
        if (!record->problem->options->reactions) continue;
        x.force_N = fmax(x.force_N, record->motion->force_peak[i].force_N);
        x.error_N = fmax(x.error_N, record->motion->force_peak[i].error_N);
    }
    return x;
}

double fw_dynamics_run_error_ratio(const fw_dynamics_recorder *record) {
    const reached x = what_is_reached(record);
    const fw_dynamics_motion_options *o = record->problem->options;
    double wanted = fw_dynamics_tolerance_wanted(record), off = 0;
    if (x.error_rad > 0) off = x.error_rad / (wanted * x.angle_rad);
    if (o->reactions) off = fmax(off, fw_dynamics_run_extremes_off(record) / wanted);
    double seen = !o->unsettled ? 0
                                : o->unsettled(record->motion->observed, record->motion->compared,
                                               record->motion->stats.estimate_margin, wanted);
    return seen > 1 ? fmax(off, fmax(seen, 5)) : off;
}

/* an angle or a force that is round-off has no relative accuracy */
static const double nothing = 1e-10;

static void warn_inaccurate(const fw_dynamics_run *r) {
    const reached x = what_is_reached(&r->record);
    double wanted = fw_dynamics_tolerance_wanted(&r->record), degree = FW_DEG_PER_RAD;
    double accuracy = r->record.motion->accuracy;
    char a[32], b[32], c[32];
    if (x.error_rad > fmax(nothing, wanted * x.angle_rad))
        fw_diag_warning(r->diags, 240, r->problem.scene->place,
                        "scene %s: peaks are uncertain by %s deg where the largest is %s deg, and "
                        "an accuracy of %s is wanted; no tolerance is tight enough: shorten the "
                        "scene, or judge by the stated errors",
                        r->problem.scene->name ? r->problem.scene->name : "(unnamed)",
                        fw_number_text(a, sizeof a, x.error_rad * degree, 3),
                        fw_number_text(b, sizeof b, x.angle_rad * degree, 3),
                        fw_number_text(c, sizeof c, accuracy, 3));
    else if (x.error_N > fmax(nothing * fw_multibody_newton(r->problem.model), wanted * x.force_N))
        fw_diag_warning(r->diags, 240, r->problem.scene->place,
                        "scene %s: joint forces are uncertain by %s N where the largest is %s N, "
                        "and an accuracy of %s is wanted; no tolerance is tight enough: shorten "
                        "the scene, or judge by the stated errors",
                        r->problem.scene->name ? r->problem.scene->name : "(unnamed)",
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
    fw_diag_warning(r->diags, 241, r->problem.scene->place,
                    "scene %s: the energy balance error is %s of the largest energy, far more "
                    "than the tolerance %s explains; this motion is not reliable: use another "
                    "--method or --integrator",
                    r->problem.scene->name ? r->problem.scene->name : "(unnamed)",
                    fw_number_text(a, sizeof a, off, 2),
                    fw_number_text(b, sizeof b, r->record.motion->stats.rtol, 2));
}

/* what was chosen and why */
static fw_status report_tolerance(fw_dynamics_recorder *record, bool enough) {
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
                       enough ? "enough" : "not enough and the tightest that there is", wanted);
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
