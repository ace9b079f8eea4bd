/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tolerances by the accuracy that is wanted. Two runs are made, the looser one first, whose
   tolerance is 10^(1/2) times that of the answer. Of the difference D of the two the error of the
   answer is

     |error| <= margin D,   margin 3 where the looser tolerance is above 1e-6, else 2

   in: wanted, relative to the largest deflection; out: tolerances, scaled as the integrator's are.
   Where margin D is not below what is wanted the next looser tolerance is lower by 2 margin D /
   wanted (errors go with the tolerance), and the answer so far is compared with where that is
   enough. The first one is such that it is good enough for three scenes of four: tighter for all
   would cost more than a third run for one of them, since a digit costs a factor of 1.2 (order 8)
   or 1.6 (radau5).
   Validity: integrators in the table below; wanted between 1e-12 and 0.1.
   Error: measured on a thousand random devices, docs/theory/integrators.md.
   Source: tolerance proportionality, Hairer, Norsett and Wanner I, II.4; factors are measured.
   Test: test_steer.c, tests/accuracy/survey.c. */
#include "dynamics/steer.h"
#include <math.h>

static const double fw_tightest = 1e-13;
/* beyond, steps of order 8 span whole oscillations, and what they miss both runs may miss */
static const double fw_loosest_of_two = 5e-4;
static const double fw_ratio = 3.1622776601683795, fw_ratio_far = 100;
static const double fw_tolerable = 1e-6; /* looser tolerances above are trusted less */

typedef struct pace_row {
    const fw_stepper_row *row;
    double loose, tight; /* wanted over the looser tolerance: above fw_tolerable, and below */
} pace_row;
static const pace_row fw_pace_table[] = {
    {&fw_dop853_row, 30, 15}, {&fw_radau5_row, 40, 30}, {&fw_dopri5_row, 180, 60}};

static const pace_row *row_of(const fw_stepper_row *row) {
    for (size_t i = 0; i < sizeof fw_pace_table / sizeof *fw_pace_table; i++)
        if (fw_pace_table[i].row == row) return &fw_pace_table[i];
    return NULL;
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

double fw_pace_tightest(const fw_run *r) {
    return fmax(fw_tightest, noise_floor(r));
}

double fw_pace_wanted(const fw_run *r) {
    double accuracy = r->motion->accuracy;
    return fmax(accuracy - r->motion->ledger.left_out, 0.05 * accuracy);
}

bool fw_pace_known(const fw_run *r, const fw_stepper_row *row) {
    return !(r->options->rtol > 0) && row_of(row);
}

/* Verdicts stand on their errors: of 400 devices near their limit, factors that serve 99 % left
   three outside their bands, and runs a hundred times apart, whose difference counts as it is, none
   of 60 000 (test_hard_verdict.c, test_peak.c). Loads that may begin at any time are met by chance:
   likewise, and fw_run_margin counts. */
static bool far_apart(const fw_run *r) {
    return r->sudden || r->options->settled;
}

/* Round-off as large as the error does not go with the tolerance. */
static fw_pace pace_at(const fw_run *r, double looser) {
    double tightest = fw_pace_tightest(r), ratio = far_apart(r) ? fw_ratio_far : fw_ratio;
    fw_pace p = {.looser = fmin(looser, fw_loosest_of_two)};
    p.rtol = p.looser / ratio;
    p.margin = far_apart(r) ? 1 : p.looser > fw_tolerable ? 3 : 2;
    if (p.rtol <= tightest) p = (fw_pace){.looser = 100 * tightest, .rtol = tightest, .margin = 1};
    return p;
}

/* Forces of hinges that give are a stiffness times a tiny displacement: to have them as exactly as
   angles takes tolerances this much tighter, as measured on the devices of docs/gallery. */
static double tighter_for_forces(const fw_run *r) {
    if (r->model->nreleased == 0) return 1;
    return r->options->reactions ? 3000 : 1;
}

fw_pace fw_pace_start(const fw_run *r, const fw_stepper_row *row, double wanted) {
    const pace_row *p = row_of(row);
    if (r->options->settled) return pace_at(r, fmin(1e-4, wanted / 100));
    wanted /= tighter_for_forces(r);
    double loose = wanted / p->loose;
    return pace_at(r, loose > fw_tolerable ? loose : fmin(fw_tolerable, wanted / p->tight));
}

fw_pace fw_pace_next(const fw_run *r, fw_pace pace, double off, int tries, bool *reuse) {
    /* what does not go with the tolerance is not waited for: 10, 30, 100, ... */
    double lower = fmax(2 * off, tries > 1 ? pow(fw_ratio, tries) : 0);
    if (!(lower < 1e3)) lower = 1e3;
    double least = pace.looser / pace.rtol;
    *reuse = lower <= least && r->nstride == 0;
    return pace_at(r, pace.looser / fmax(lower, *reuse ? least : lower));
}
