/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The way to a solution of the elastica: Newton's method, where it begins, and load steps along the
   primary branch. */
#include "flexure/elastica_core.h"
#include <math.h>

enum { MOST_PASSES = 25 };

static int index_of(const fw_flexure_goal *g, fw_flexure_elastica_end end) {
    for (int i = 0; i < 3; i++)
        if (g->given[i] == end) return i;
    return -1;
}

static void ease(const fw_flexure_goal *g, const fw_flexure_end_state *end, double a[3][3],
                 double x[3][3]) {
    int along = index_of(g, FW_END_UX), across = index_of(g, FW_END_UY);
    double c = g->soft[0], s = g->soft[1];
    x[along][0] = c * x[along][0] + s * x[across][0];
    x[across][0] = 0;
    for (int k = 0; k < 3; k++) {
        a[along][k] = c * end->by[FW_END_UX][k] + s * end->by[FW_END_UY][k];
        a[across][k] = c * end->by[FW_END_FY][k] - s * end->by[FW_END_FX][k];
    }
}

static bool step_of(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                    fw_flexure_newton *n, double *change) {
    double a[3][3], x[3][3] = {{0}}, det;
    fw_flexure_mesh_pass(e, level, &n->end);
    for (int i = 0; i < 3; i++) {
        x[i][0] = g->value[i] - n->end.value[g->given[i]];
        for (int k = 0; k < 3; k++)
            a[i][k] = n->end.by[g->given[i]][k];
    }
    if (g->eased) ease(g, &n->end, a, x);
    bool regular = fw_flexure_solve3(a, 1, x, &det);
    n->stability = e->unloaded != 0 ? det / e->unloaded : (double)NAN;
    if (!regular || !isfinite(det) || n->stability * n->sign < 0) return false;
    const double dp[3] = {x[0][0], x[1][0], x[2][0]};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++)
            n->end.value[i] += n->end.by[i][k] * dp[k];
    *change = fw_flexure_mesh_update(e, level, dp, &n->span);
    n->span = fmin(n->span, 1);
    return isfinite(*change);
}

/* contraction by the affine covariant test of Deuflhard (Newton Methods for Nonlinear Problems,
   section 2.1): each change a fraction of the one before, and the next one in proportion to the
   square of the last; rounding ends what no longer falls.
   in: a state near the solution. out: the solution, n->change the last change (rad, and of p over
   its size), n->end twist and wrench after it with derivatives before it; false: no contraction,
   another sign of the determinant, or not finite. Cost 2 to 5 passes.
   Test: test_elastica_ways.c warm_is_cold, primary_branch */
bool fw_flexure_newton_run(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                           fw_flexure_newton *n) {
    double before = 0;
    n->ratio = 0;
    for (int i = 0; i < MOST_PASSES; i++) {
        if (!step_of(e, level, g, n, &n->change)) return false;
        if (n->change < 4e-14) return true;
        if (i > 0) {
            double ratio = n->change / before;
            if (ratio > n->contract && n->change > 1e-11) return false;
            if (ratio > 0.5 && n->change < 1e-11) return true;
            if (i == 1) n->ratio = ratio;
            n->square = ratio / before;
        }
        double next = 10 * n->change * n->change * n->square;
        if (n->square > 0 && n->change <= n->last && next < n->tolerance * n->span) return true;
        before = n->change;
    }
    return false;
}

/* ---- where to begin ---- */

static bool gives(const fw_flexure_goal *g, fw_flexure_elastica_end end, double *value) {
    int i = index_of(g, end);
    if (i >= 0) *value = g->value[i];
    return i >= 0;
}

static void set_moment(fw_flexure_elastica *e, int level, double moment) {
    fw_flexure_mesh *mesh = &e->mesh[level];
    fw_flexure_mesh_fill(e, level);
    e->p[0] = moment;
    e->p[1] = e->p[2] = 0;
    for (int n = 0; n < mesh->count; n++) {
        fw_flexure_element *el = &mesh->element[n];
        el->phi = moment * (el->cumulative + el->turned);
        el->start = moment * el->cumulative;
    }
    mesh->end = moment;
}

/* A strip that hardly stretches answers the least miss along its chord with a large force, which
   spoils the next passes. So the place is first gone to only along the direction that gives, half
   turned with the second body, and the force across is left as it is. */
static bool ease_in(fw_flexure_elastica *e, int level, const fw_flexure_goal *g, double turn) {
    const double stiff = 100; /* arcs have 24 at most, leaves (L/t)^2 */
    double(*c)[3] = e->linear.c, half = 0.5 * (c[1][1] - c[2][2]);
    double mean = 0.5 * (c[1][1] + c[2][2]), off = hypot(half, c[1][2]);
    double angle = 0.5 * (atan2(c[1][2], half) + turn);
    if (mean + off < stiff * (mean - off)) return true;
    if (index_of(g, FW_END_UX) < 0 || index_of(g, FW_END_UY) < 0) return true;
    fw_flexure_goal easy = *g;
    easy.eased = true;
    easy.soft[0] = cos(angle), easy.soft[1] = sin(angle);
    fw_flexure_newton n = {.tolerance = 1e-4, .last = 1e-3, .contract = 0.4};
    return fw_flexure_newton_run(e, level, &easy, &n);
}

/* an exact equilibrium: the beam wound by a moment alone, which has the rotation or the moment that
   is given; the first Newton step from there is the law of finite.h */
static void begin_wound(fw_flexure_elastica *e, int level, const fw_flexure_goal *g) {
    double moment = 0;
    if (!e->hinged && !gives(g, FW_END_THETA, &moment)) gives(g, FW_END_M, &moment);
    set_moment(e, level, moment);
    if (!ease_in(e, level, g, moment)) set_moment(e, level, moment);
}

static void keep(fw_flexure_elastica *e, int level) {
    const fw_flexure_mesh *mesh = &e->mesh[level];
    for (int n = 0; n < mesh->count; n++)
        mesh->element[n].kept = mesh->element[n].phi;
    for (int k = 0; k < FW_UNKNOWN; k++)
        e->kept[k] = e->p[k];
}

static void restore(fw_flexure_elastica *e, int level) {
    const fw_flexure_mesh *mesh = &e->mesh[level];
    for (int n = 0; n < mesh->count; n++)
        mesh->element[n].phi = mesh->element[n].kept;
    for (int k = 0; k < FW_UNKNOWN; k++)
        e->p[k] = e->kept[k];
}

static double determinant(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                          double *size) {
    double a[3][3], x[3][3] = {{0}}, det;
    fw_flexure_end_state end;
    fw_flexure_mesh_pass(e, level, &end);
    *size = 1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            a[i][k] = end.by[g->given[i]][k];
        *size *= hypot(hypot(a[i][0], a[i][1]), a[i][2]);
    }
    fw_flexure_solve3(a, 0, x, &det);
    return det;
}

/* for another kind of task than the last: the determinant of the unloaded beam, 0 where nothing
   holds it, and the sign of the present one */
void fw_flexure_elastica_unloaded(fw_flexure_elastica *e, const fw_flexure_goal *g) {
    if (e->kind[0] == g->given[0] && e->kind[1] == g->given[1] && e->kind[2] == g->given[2]) return;
    double size;
    fw_flexure_mesh_fill(e, 0);
    keep(e, 0);
    set_moment(e, 0, 0);
    e->unloaded = determinant(e, 0, g, &size);
    if (!(fabs(e->unloaded) > 1e-11 * size)) e->unloaded = 0;
    restore(e, 0);
    for (int i = 0; i < 3; i++)
        e->kind[i] = g->given[i];
    if (e->solved > 0) e->sign = determinant(e, e->solved - 1, g, &size) * e->unloaded < 0 ? -1 : 1;
}

/* ---- the primary branch ---- */

/* all values change together, from those of the present state; a step is taken when the corrector
   contracts well and the determinant keeps its sign. Answers the part reached, with the state
   there: below 1 where steps of 2^-13 are still refused. Cost: in test_elastica_bench.c up to 80
   passes. Source: Deuflhard, section 5.1. Test: test_elastica_ways.c limits_are_told */
static double load_steps(fw_flexure_elastica *e, int level, const double from[3],
                         const fw_flexure_goal *to, double sign, int *steps) {
    enum { HALVINGS = 13 };
    const double least = ldexp(1, -HALVINGS);
    double at = 0, step = 0.25;
    while (at < 1 && step >= least) {
        double next = fmin(1, at + step);
        fw_flexure_goal part = *to;
        for (int i = 0; i < 3; i++)
            if (next < 1) part.value[i] = from[i] + next * (to->value[i] - from[i]);
        fw_flexure_newton n = {.tolerance = 1e-7, .last = 1e-4, .contract = 0.25, .sign = sign};
        keep(e, level);
        ++*steps;
        if (fw_flexure_newton_run(e, level, &part, &n)) {
            at = next;
            if (n.ratio < 0.08) step *= 2;
        } else {
            restore(e, level);
            step *= 0.5;
        }
    }
    return at;
}

static bool from_last(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                      fw_flexure_way *w, fw_flexure_newton *n) {
    const fw_flexure_newton direct = *n;
    double from[3], turn = e->last[FW_END_THETA];
    for (int i = 0; i < 3; i++)
        from[i] = e->last[g->given[i]];
    keep(e, level);
    gives(g, FW_END_THETA, &turn);
    if (ease_in(e, level, g, turn) && fw_flexure_newton_run(e, level, g, n)) return true;
    restore(e, level);
    *n = direct;
    n->contract = 1;
    return load_steps(e, level, from, g, w->sign, &w->steps) == 1 &&
           fw_flexure_newton_run(e, level, g, n);
}

/* a solution on this mesh: from the last one, from the wound beam, or along the branch; false:
   none. Where the branch ends before, w->reached is below 1 and g holds that part of the values. */
bool fw_flexure_elastica_reach(fw_flexure_elastica *e, int level, fw_flexure_goal *g,
                               fw_flexure_way *w, fw_flexure_newton *n) {
    static const double nothing[3] = {0};
    const fw_flexure_newton direct = {
        .tolerance = 0.1 * w->tolerance, .last = 1e-3, .contract = 0.4, .sign = w->sign};
    *n = direct;
    w->reached = 1;
    if (w->warm && from_last(e, level, g, w, n)) return true;
    if (w->warm && (e->unloaded == 0 || w->sign < 0)) return false; /* no other way to it */
    w->warm = false;
    w->sign = 1;
    begin_wound(e, level, g);
    *n = direct;
    n->sign = 1;
    if (fw_flexure_newton_run(e, level, g, n)) return true;
    set_moment(e, level, 0);
    w->reached = load_steps(e, level, nothing, g, 1, &w->steps);
    for (int i = 0; i < 3; i++)
        g->value[i] *= w->reached;
    *n = direct;
    n->sign = 1;
    n->contract = 1;
    return fw_flexure_newton_run(e, level, g, n);
}
