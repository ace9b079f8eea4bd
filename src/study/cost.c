/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model of costs: how large a part of the budget something takes, before it is run and where
   nothing counts instructions. It depends on counts alone, so that the same settings are run on
   every machine. */
#include "maths/ode.h"
#include "study/problem.h"
#include <math.h>
#include <string.h>

/* Instructions of an answer for the reference six-bar (five bodies, n = 15, m = 12) by dop853 at a
   tolerance of 1e-7, over the right-hand sides of its finer run: projection, dense output, peaks
   and the run that errors are estimated from included; and how that grows with the bodies. Counted
   by this program, gcc -O2 (docs/theory/tradeoff.md). Dense factorisations grow with the cube of
   the bodies, where small ones are mostly calls. */
static const struct {
    const char *method;
    double six_bar, power;
} cost_table[] = {
    {"chain", 3700, 1},
    {"minimal", 27000, 1},
    {"augmented", 133000, 3},
    {"coordinate-partitioning", 66000, 3},
    {"udwadia-kalaba", 371000, 3},
    {"svd", 376000, 3},
    {"qr", 167000, 3},
    {"schur", 291000, 3},
    {"block-least-squares", 162000, 2},
};

/* hinges that give are springs, not constraints: without any constraint all methods are alike */
static bool constrained(const fw_study_problem *p) {
    const fw_mechanism *m = p->mechanism;
    return m->npin - p->loads.nreleased + m->njoint + m->ndriver > 0;
}

double fw_study_cost_rhs(const fw_study_problem *p, const char *method) {
    double effects = 0, times = (1 + p->mechanism->nbody) / 6.0;
    for (int i = 0; i < p->ledger.count; i++)
        if (p->ledger.item[i].active) effects += p->ledger.item[i].cost;
    for (size_t i = 0; method && constrained(p) && i < sizeof cost_table / sizeof cost_table[0];
         i++)
        if (strcmp(cost_table[i].method, method) == 0)
            return effects + cost_table[i].six_bar * pow(times, cost_table[i].power);
    return effects + cost_table[0].six_bar * times;
}

static const fw_maths_stepper_row *stepper(const char *integrator) {
    return integrator ? fw_maths_stepper_find(integrator) : NULL;
}

double fw_study_cost_answer(const fw_study_problem *p, const fw_study_tradeoff_point *point) {
    double n = 3.0 * p->mechanism->nbody;
    const fw_maths_stepper_row *row = stepper(point->integrator);
    /* iterations evaluate more than they count, and GSL's extrapolation much more */
    double lean = !row || !row->implicit ? 1 : row == fw_maths_stepper_find("gsl-bsimp") ? 5 : 2;
    return lean * (double)point->rhs * fw_study_cost_rhs(p, point->method) +
           (double)point->factorisations * (2.5 * n * n * n + 50 * n * n);
}

double fw_study_cost_step(const fw_study_problem *p, const char *method, const char *integrator) {
    const fw_maths_stepper_row *row = stepper(integrator);
    double n = 3.0 * p->mechanism->nbody, rhs = fw_study_cost_rhs(p, method);
    /* strains are watched at so many instants of every step, each of which solves for the forces */
    double looks = p->mechanism->nhinge > 0 ? FW_INSTANTS : 0;
    /* GSL's extrapolation takes a Jacobian by differences and many small steps in each of its own
     */
    if (row && row == fw_maths_stepper_find("gsl-bsimp")) return 1000 * rhs;
    if (row && row->implicit) return (20 + looks) * rhs + 2.5 * n * n * n + 50 * n * n;
    return ((row && row->order < 6 ? 7 : 15) + looks) * rhs;
}

double fw_study_cost_digit(const char *integrator) {
    const fw_maths_stepper_row *row = stepper(integrator);
    double order = row ? row->order : 8;
    return pow(10, 1 / fmin(order, 8)); /* those of variable order reach some 8 */
}
