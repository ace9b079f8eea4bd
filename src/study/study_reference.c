/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference of one device: two far tighter runs that share neither method nor integrator, nor
   with what the program takes by itself. What they differ by is what is known of it. */
#include "maths/ode.h"
#include "study/problem.h"
#include <math.h>
#include <string.h>

/* of the budget, for one run; and for explicit steps that are short for stability alone */
static const double reference_share = 0.08, stable_share = 0.2;

typedef struct candidate {
    const char *integrator;
    double tightest;
} candidate;
/* those of the highest order first */
static const candidate table[] = {
    {"gsl-rk8pd", 1e-13},   {"radau5", 1e-13},    {"dop853", 1e-13},
    {"gsl-msadams", 1e-13}, {"gsl-rkf45", 1e-12}, {"dopri5", 1e-12},
};
enum { CANDIDATES = sizeof table / sizeof table[0] };

static const char *const method_table[] = {"augmented", "coordinate-partitioning", "qr", "minimal",
                                           "chain"};
enum { METHODS = sizeof method_table / sizeof method_table[0] };

/* a method that is neither `a` nor `b`, dense ones first, as long as a right-hand side is no dearer
   than `times` that of chain */
static const char *other_method(const fw_study_problem *p, const char *a, const char *b,
                                double times) {
    double own = fw_study_cost_rhs(p, "chain");
    for (int i = 0; i < METHODS; i++) {
        const char *name = method_table[i];
        if (strcmp(name, a) == 0 || (b && strcmp(name, b) == 0)) continue;
        if (fw_study_cost_rhs(p, name) < times * own) return name;
    }
    return "chain";
}

static fw_status attempt(fw_study_problem *p, const char *method, const char *integrator,
                         double rtol, double share, fw_study_tradeoff_point *point) {
    fw_study_tradeoff_setting s = {.method = method, .integrator = integrator, .rtol = rtol};
    double most = share * p->budget;
    s.most_steps = (long)fmax(200, most / fw_study_cost_step(p, method, integrator));
    return fw_study_problem_run(p, &s, point);
}

/* the tighter of two tolerances at which it ends within its share */
static fw_status tight(fw_study_problem *p, const char *method, const candidate *c,
                       fw_study_tradeoff_point *point) {
    for (double rtol = c->tightest; rtol < 150 * c->tightest; rtol *= 100) {
        FW_TRY(attempt(p, method, c->integrator, rtol, reference_share, point));
        if (point->state != FW_TRADEOFF_SKIPPED) return FW_OK;
    }
    return FW_OK;
}

/* by methods whose right-hand side is at most `dear` times that of chain, implicit ones less */
static fw_status search(fw_study_problem *p, fw_study_tradeoff *t, bool own_too, double dear,
                        fw_study_tradeoff_point *run, int *found) {
    const char *own = t->point[0].integrator;
    for (int i = 0; i < CANDIDATES && *found < 2; i++) {
        bool is_own = strcmp(table[i].integrator, own) == 0;
        bool had = *found && strcmp(run[0].integrator, table[i].integrator) == 0;
        if (is_own != own_too || had) continue;
        const char *first = *found ? run[0].method : NULL;
        bool implicit = fw_maths_stepper_find(table[i].integrator)->implicit;
        const char *method = other_method(p, t->point[0].method, first, implicit ? 8 : dear);
        FW_TRY(tight(p, method, &table[i], &run[*found]));
        if (run[*found].state == FW_TRADEOFF_DONE) ++*found;
    }
    return FW_OK;
}

/* a stiff scene: one explicit run whose steps are short for stability and hence good; it costs the
   same at every tolerance. Then the implicit one, tighter, by another method. */
static fw_status stiff(fw_study_problem *p, fw_study_tradeoff *t, fw_study_tradeoff_point *run,
                       int *found) {
    const char *own = t->point[0].method, *method = other_method(p, own, NULL, 8);
    FW_TRY(attempt(p, method, "dop853", 1e-11, stable_share, &run[0]));
    if (run[0].state != FW_TRADEOFF_DONE) return FW_OK;
    *found = 1;
    const candidate implicit = {"radau5", 1e-12};
    FW_TRY(tight(p, other_method(p, own, method, 60), &implicit, &run[1]));
    if (run[1].state == FW_TRADEOFF_DONE) *found = 2;
    return FW_OK;
}

/* nothing else ends within its share: one integrator, far tighter, by two methods */
static fw_status one_twice(fw_study_problem *p, const fw_study_tradeoff *t, const char *integrator,
                           fw_study_tradeoff_point *run, int *found) {
    const char *own = p->row ? "chain" : t->point[0].method;
    *found = 0;
    for (double rtol = 1e-12; rtol < 1e-7 && *found < 2; rtol *= 10) {
        const char *method = *found ? own : other_method(p, own, NULL, 8);
        FW_TRY(attempt(p, method, integrator, rtol, stable_share, &run[*found]));
        if (run[*found].state == FW_TRADEOFF_DONE) ++*found;
    }
    return FW_OK;
}

/* equilibria alone: at an accuracy far below the one wanted, and at a looser one */
static fw_status rows(fw_study_problem *p, fw_study_tradeoff_point *run, int *found) {
    *found = 0;
    for (int i = 0; i < 2; i++) {
        const fw_study_tradeoff_setting s = {.row = true, .rtol = i ? 1e-5 : 1e-7};
        FW_TRY(fw_study_problem_run(p, &s, &run[*found]));
        if (run[*found].state == FW_TRADEOFF_DONE) ++*found;
    }
    return FW_OK;
}

static bool independent(const fw_study_tradeoff_point *a, const fw_study_tradeoff_point *b,
                        const fw_study_tradeoff_point *own) {
    return strcmp(a->method, b->method) != 0 && strcmp(a->integrator, b->integrator) != 0 &&
           strcmp(a->method, own->method) != 0 && strcmp(b->method, own->method) != 0 &&
           strcmp(a->integrator, own->integrator) != 0;
}

fw_status fw_study_tradeoff_find_reference(fw_study_problem *p, fw_study_tradeoff *t) {
    int found = 0;
    fw_study_tradeoff_reference *r = &t->reference;
    fw_study_tradeoff_point *run = fw_arena_array(p->arena, fw_study_tradeoff_point, 2);
    FW_NEED(run);
    const fw_maths_stepper_row *own = fw_maths_stepper_find(t->point[0].integrator);
    if (p->row) { /* slow loads on fast modes: stiff */
        FW_TRY(one_twice(p, t, "radau5", run, &found));
        t->rows_only = found < 2;
        if (t->rows_only) FW_TRY(rows(p, run, &found));
    } else if (own && own->implicit) {
        FW_TRY(stiff(p, t, run, &found));
    } else {
        FW_TRY(search(p, t, false, 60, run, &found));
        for (int all = 0; all < 2 && found < 2; all++)
            FW_TRY(search(p, t, all, 20, run, &found));
    }
    if (found < 2 && !p->row) FW_TRY(one_twice(p, t, t->point[0].integrator, run, &found));
    *r = (fw_study_tradeoff_reference){.error = (double)NAN, .utilisation_error = (double)NAN};
    if (found > 0) r->run[0] = &run[0];
    if (found < 2) return FW_OK;
    r->run[1] = &run[1];
    /* what two doubles agree in by chance is no less than their last digits */
    r->error =
        fmax(fw_study_peaks_differ(run[1].peak_rad, run[0].peak_rad, p->mechanism->npin), 1e-15);
    r->utilisation_error = fabs(run[1].utilisation / run[0].utilisation - 1);
    r->independent = independent(&run[0], &run[1], &t->point[0]);
    return FW_OK;
}
