/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every method, integrator and tolerance, those first that say most: all integrators with the
   program's own method, all methods with its own integrator, then the rest, cheapest method first.
   What would go over its share of the budget is left out and says so. */
#include "maths/ode.h"
#include "study/tradeoff.h"
#include <math.h>
#include <string.h>

/* shares of the budget: of the three parts, and of one run in them. Every pair of a part may take
   an equal share of what is left of it */
static const double part_share[3] = {0.12, 0.25, 0.08}, one[3] = {0.02, 0.03, 0.01};
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

/* room for all names of a table */
static const char **names(fw_arena *arena, fw_multibody_method_row (*at)(size_t)) {
    size_t n = 0;
    while (at(n).name)
        n++;
    return fw_arena_array(arena, const char *, n);
}

/* methods by what a right-hand side costs */
static int by_cost(const fw_study_problem *p, const char **name) {
    int n = 0;
    for (size_t i = 0; fw_multibody_method_at(i).name; i++) {
        int at = n++;
        const char *mine = fw_multibody_method_at(i).name;
        for (; at > 0 && fw_study_cost_rhs(p, name[at - 1]) > fw_study_cost_rhs(p, mine); at--)
            name[at] = name[at - 1];
        name[at] = mine;
    }
    return n;
}

static int integrators(const char **name) {
    int n = 0;
    for (size_t i = 0; fw_dynamics_integrator_at(i).name; i++)
        if (strcmp(fw_dynamics_integrator_at(i).name, "auto") != 0)
            name[n++] = fw_dynamics_integrator_at(i).name;
    return n;
}

/* what stands for the program's own choice where that is quasi-static */
static const char *known_or(const char *name, const char *otherwise, const char *const *table,
                            int n) {
    for (int i = 0; i < n; i++)
        if (strcmp(table[i], name) == 0) return name;
    return otherwise;
}

/* of all parts, where `left` of the budget is left of this one: no run begins beyond it, and what is left over is not used */
static double share_done(const fw_study_problem *p, int part, double left) {
    double before = own_share, all = own_share;
    for (int k = 0; k < 3; k++) {
        all += part_share[k];
        if (k <= part) before += part_share[k];
    }
    return (before - left / p->budget) / all;
}

static fw_status every_pair(fw_study_problem *p, fw_study_tradeoff *t, fw_progress_whole *told) {
    const char **method, **integrator;
    FW_NEED(method = names(p->arena, fw_multibody_method_at));
    FW_NEED(integrator = names(p->arena, fw_dynamics_integrator_at));
    int m = by_cost(p, method), n = integrators(integrator);
    size_t most = (size_t)(m * n) * FW_TRADEOFF_TOLERANCES + (size_t)t->npoint;
    fw_study_tradeoff_point *all = fw_arena_array(p->arena, fw_study_tradeoff_point, most);
    FW_NEED(all);
    memcpy(all, t->point, (size_t)t->npoint * sizeof *all);
    t->point = all;
    FW_NEED(t->curve = fw_arena_array(p->arena, fw_study_tradeoff_curve, (size_t)(m * n)));
    const char *own_m = known_or(t->point[0].method, "chain", method, m);
    const char *own_i =
        known_or(t->point[0].integrator, p->quasi_static ? "radau5" : "dop853", integrator, n);
    double first = own_share * p->budget;
    FW_TRY(pair(p, t, own_m, own_i, &first, own_one * p->budget));
    t->curve[0].as_integrator = t->curve[0].as_method = true;
    for (int part = 0; part < 3; part++) {
        double left = part_share[part] * p->budget, each = one[part] * p->budget;
        int pairs = part == 0 ? n - 1 : part == 1 ? m - 1 : (m - 1) * (n - 1);
        for (int i = 0; i < m; i++)
            for (int k = 0; k < n; k++) {
                bool mine = strcmp(method[i], own_m) == 0, its = strcmp(integrator[k], own_i) == 0;
                if (find_curve(t, method[i], integrator[k]) >= 0) continue;
                if ((part == 0 && !mine) || (part == 1 && !its)) continue;
                double mine_left = left / fmax(1, pairs--), before = mine_left;
                told->done = 100 * share_done(p, part, left);
                fw_arena_tell(p->arena, "", 0, 0, "");
                FW_TRY(pair(p, t, method[i], integrator[k], &mine_left, each));
                left -= before - mine_left;
                fw_study_tradeoff_curve *c = &t->curve[t->ncurve - 1];
                c->as_integrator = mine;
                c->as_method = its;
            }
    }
    return FW_OK;
}

fw_status fw_study_tradeoff_grid(fw_study_problem *p, fw_study_tradeoff *t) {
    fw_progress_whole told = {
        .what = "trying methods and tolerances", .done = 0, .of = -100, .unit = "%"};
    fw_arena_tell_of(p->arena, &told);
    const fw_status status = every_pair(p, t, &told);
    fw_arena_tell_alone(p->arena, &told);
    return status;
}

/* ---- the reference ----
   Two far tighter runs that share neither method nor integrator, nor with what the program takes by
   itself. What they differ by is what is known of it. */

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
    fw_arena_tell(p->arena, "looking for a reference", 0, 0, "runs");
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
    const char *own = p->quasi_static ? "chain" : t->point[0].method;
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
        const fw_study_tradeoff_setting s = {.quasi_static = true, .rtol = i ? 1e-5 : 1e-7};
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
    if (p->quasi_static) { /* slow loads on fast modes: stiff */
        FW_TRY(one_twice(p, t, "radau5", run, &found));
        t->quasi_static_only = found < 2;
        if (t->quasi_static_only) FW_TRY(rows(p, run, &found));
    } else if (own && own->implicit) {
        FW_TRY(stiff(p, t, run, &found));
    } else {
        FW_TRY(search(p, t, false, 60, run, &found));
        for (int all = 0; all < 2 && found < 2; all++)
            FW_TRY(search(p, t, all, 20, run, &found));
    }
    if (found < 2 && !p->quasi_static) FW_TRY(one_twice(p, t, t->point[0].integrator, run, &found));
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
