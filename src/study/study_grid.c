/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every method, integrator and tolerance, those first that say most: all integrators with the
   program's own method, all methods with its own integrator, then the rest, cheapest method first.
   What would go over its share of the budget is left out and says so. */
#include "maths/ode.h"
#include "study/problem.h"
#include <math.h>

#include <string.h>

/* shares of the budget: of the three parts, and of one run in them. Every pair of a part may take
   an equal share of what is left of it */
static const double share[3] = {0.12, 0.25, 0.08}, one[3] = {0.02, 0.03, 0.01};
static const double own_share = 0.08,
                    own_one = 0.04; /* of the program's own pair, which comes first */

static double tolerance(int k) {
    static const double rtol[FW_TRADEOFF_TOLERANCES] = {1e-5,  1e-6,  1e-7,  1e-8, 1e-9,
                                                        1e-10, 1e-11, 1e-12, 1e-13};
    return rtol[k];
}

static int find_curve(const fw_study_tradeoff *t, const char *method, const char *integrator) {
    for (int i = 0; i < t->ncurve; i++)
        if (strcmp(t->curve[i].method, method) == 0 &&
            strcmp(t->curve[i].integrator, integrator) == 0)
            return i;
    return -1;
}

/* an integrator that does not even end at the loosest tolerance by the program's own method */
static bool hopeless(const fw_study_tradeoff *t, const char *integrator) {
    for (int i = 0; i < t->ncurve; i++)
        if (t->curve[i].as_integrator && strcmp(t->curve[i].integrator, integrator) == 0)
            return t->point[t->curve[i].first].state == FW_TRADEOFF_SKIPPED;
    return false;
}

/* right-hand sides of the same integrator and tolerance with another method are nearly as many */
static double known_rhs(const fw_study_tradeoff *t, const char *integrator, int k) {
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *c = &t->curve[i];
        if (strcmp(c->integrator, integrator) != 0 || c->count <= k) continue;
        const fw_study_tradeoff_point *point = &t->point[c->first + k];
        if (point->state == FW_TRADEOFF_DONE) return (double)point->rhs;
    }
    return (double)NAN;
}

/* instructions that a run would take; NaN: nobody knows */
static double predicted(const fw_study_problem *p, const fw_study_tradeoff *t,
                        const fw_study_tradeoff_curve *c, int k) {
    const fw_study_tradeoff_point *before = k > 0 ? &t->point[c->first + k - 1] : NULL;
    double rhs = known_rhs(t, c->integrator, k);
    if (isfinite(rhs)) {
        fw_study_tradeoff_point like = {
            .method = c->method, .integrator = c->integrator, .rhs = (long)rhs};
        return fw_study_cost_answer(p, &like);
    }
    if (before && before->state == FW_TRADEOFF_DONE)
        return before->instructions * fw_study_cost_digit(c->integrator);
    return (double)NAN;
}

static fw_status leave_out(fw_study_problem *p, fw_study_tradeoff_point *point, double over) {
    char seconds[32];
    point->state = FW_TRADEOFF_SKIPPED;
    point->error = point->estimated = point->instructions = (double)NAN;
    point->utilisation = point->utilisation_error = (double)NAN;
    fw_number_text(seconds, sizeof seconds, over / 2.5e9, 2);
    point->why =
        isfinite(over)
            ? fw_arena_printf(p->arena, "would take some %s s, more than its share of the budget",
                              seconds)
            : "a looser tolerance was over its share of the budget already";
    return point->why ? FW_OK : FW_NOMEM;
}

/* one pair; `left` of its part of the budget, at most `each` for one run */
static fw_status pair(fw_study_problem *p, fw_study_tradeoff *t, const char *method,
                      const char *integrator, double *left, double each) {
    fw_study_tradeoff_curve *c = &t->curve[t->ncurve++];
    *c = (fw_study_tradeoff_curve){.method = method,
                                   .integrator = integrator,
                                   .first = t->npoint,
                                   .count = FW_TRADEOFF_TOLERANCES,
                                   .order = (double)NAN};
    t->npoint += c->count;
    bool over = hopeless(t, integrator);
    for (int k = 0; k < c->count; k++) {
        fw_study_tradeoff_point *point = &t->point[c->first + k];
        *point = (fw_study_tradeoff_point){.method = method, .integrator = integrator};
        point->rtol = tolerance(k);
        double most = fmin(each, *left), wants = predicted(p, t, c, k);
        if (over || wants > most || !(most > 0)) {
            FW_TRY(leave_out(p, point, over ? (double)NAN : wants));
            over = true;
            continue;
        }
        double step = fw_study_cost_step(p, method, integrator);
        fw_study_tradeoff_setting s = {
            .method = method, .integrator = integrator, .rtol = tolerance(k)};
        s.most_steps = (long)fmax(100, most / step);
        FW_TRY(fw_study_problem_run(p, &s, point));
        over = point->state == FW_TRADEOFF_SKIPPED; /* too many steps */
        *left -= over ? most : isfinite(point->instructions) ? point->instructions : 0.1 * each;
        if (over) point->why = "took more steps than its share of the budget allows";
        if (point->state == FW_TRADEOFF_FAILED) *left -= 0.1 * each;
        if (point->state == FW_TRADEOFF_DONE && point->rtol > 1.001 * tolerance(k)) {
            point->state = FW_TRADEOFF_SKIPPED; /* the one before it again */
            point->why = "tighter than round-off leaves room for";
        }
    }
    return FW_OK;
}

/* methods by what a right-hand side costs */
static int by_cost(const fw_study_problem *p, const char *name[FW_TRADEOFF_NAMES]) {
    int n = 0;
    for (size_t i = 0; fw_multibody_method_at(i).name && n < FW_TRADEOFF_NAMES; i++) {
        int at = n++;
        const char *mine = fw_multibody_method_at(i).name;
        for (; at > 0 && fw_study_cost_rhs(p, name[at - 1]) > fw_study_cost_rhs(p, mine); at--)
            name[at] = name[at - 1];
        name[at] = mine;
    }
    return n;
}

static int integrators(const char *name[FW_TRADEOFF_NAMES]) {
    int n = 0;
    for (size_t i = 0; fw_dynamics_integrator_at(i).name && n < FW_TRADEOFF_NAMES; i++)
        if (strcmp(fw_dynamics_integrator_at(i).name, "auto") != 0)
            name[n++] = fw_dynamics_integrator_at(i).name;
    return n;
}

/* what stands for the program's own choice where that is a row of equilibria */
static const char *known_or(const char *name, const char *otherwise, const char *const *table,
                            int n) {
    for (int i = 0; i < n; i++)
        if (strcmp(table[i], name) == 0) return name;
    return otherwise;
}

fw_status fw_study_tradeoff_grid(fw_study_problem *p, fw_study_tradeoff *t) {
    const char *method[FW_TRADEOFF_NAMES], *integrator[FW_TRADEOFF_NAMES];
    int m = by_cost(p, method), n = integrators(integrator);
    size_t most = (size_t)(m * n) * FW_TRADEOFF_TOLERANCES + (size_t)t->npoint;
    fw_study_tradeoff_point *all = fw_arena_array(p->arena, fw_study_tradeoff_point, most);
    FW_NEED(all);
    memcpy(all, t->point, (size_t)t->npoint * sizeof *all);
    t->point = all;
    FW_NEED(t->curve = fw_arena_array(p->arena, fw_study_tradeoff_curve, (size_t)(m * n)));
    const char *own_m = known_or(t->point[0].method, "chain", method, m);
    const char *own_i =
        known_or(t->point[0].integrator, p->row ? "radau5" : "dop853", integrator, n);
    double first = own_share * p->budget;
    FW_TRY(pair(p, t, own_m, own_i, &first, own_one * p->budget));
    t->curve[0].as_integrator = t->curve[0].as_method = true;
    for (int part = 0; part < 3; part++) {
        double left = share[part] * p->budget, each = one[part] * p->budget;
        int pairs = part == 0 ? n - 1 : part == 1 ? m - 1 : (m - 1) * (n - 1);
        for (int i = 0; i < m; i++)
            for (int k = 0; k < n; k++) {
                bool mine = strcmp(method[i], own_m) == 0, its = strcmp(integrator[k], own_i) == 0;
                if (find_curve(t, method[i], integrator[k]) >= 0) continue;
                if ((part == 0 && !mine) || (part == 1 && !its)) continue;
                double mine_left = left / fmax(1, pairs--), before = mine_left;
                FW_TRY(pair(p, t, method[i], integrator[k], &mine_left, each));
                left -= before - mine_left;
                fw_study_tradeoff_curve *c = &t->curve[t->ncurve - 1];
                c->as_integrator = mine;
                c->as_method = its;
            }
    }
    return FW_OK;
}
