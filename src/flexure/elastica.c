/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solver of the elastica: Newton's method on all rotations and three unknowns at once, load
   steps where it does not contract, and a finer mesh for the error. */
#include "flexure/elastica.h"
#include "flexure/elastica_core.h"
#include <float.h>
#include <math.h>

typedef struct goal { /* what is given, without units */
    fw_elastica_end given[3];
    double value[3];
} goal;

typedef struct newton {
    double tolerance; /* on the change that would come next, over the largest rotation */
    double last;      /* on the last change itself, so that the tangent is as good */
    double contract;  /* largest quotient of two changes */
    double sign;      /* wanted of the determinant, 0: any */
    double square;    /* a change over the square of the one before; 0: not known. In and out */
    /* out: */
    double ratio, change, stability, span; /* span: largest rotation inside, at most 1 */
    fw_end_state end;                      /* after the last change, derivatives before it */
} newton;

enum { MOST_PASSES = 25 };

static bool step_of(fw_elastica *e, int level, const goal *g, newton *n, double *change) {
    double a[3][3], x[3][3] = {{0}}, det;
    fw_mesh_pass(e, level, &n->end);
    for (int i = 0; i < 3; i++) {
        x[i][0] = g->value[i] - n->end.value[g->given[i]];
        for (int k = 0; k < 3; k++)
            a[i][k] = n->end.by[g->given[i]][k];
    }
    bool regular = fw_solve3(a, 1, x, &det);
    n->stability = e->unloaded != 0 ? det / e->unloaded : (double)NAN;
    if (!regular || !isfinite(det) || n->stability * n->sign < 0) return false;
    const double dp[3] = {x[0][0], x[1][0], x[2][0]};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++)
            n->end.value[i] += n->end.by[i][k] * dp[k];
    *change = fw_mesh_update(e, level, dp, &n->span);
    n->span = fmin(n->span, 1);
    return isfinite(*change);
}

/* contraction by the affine covariant test of Deuflhard (Newton Methods for Nonlinear Problems,
   section 2.1): each change a fraction of the one before, and the next one in proportion to the
   square of the last; rounding ends what no longer falls. */
static bool newton_run(fw_elastica *e, int level, const goal *g, newton *n) {
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

static bool gives(const goal *g, fw_elastica_end end, double *value) {
    for (int i = 0; i < 3; i++)
        if (g->given[i] == end) {
            *value = g->value[i];
            return true;
        }
    return false;
}

static void set_moment(fw_elastica *e, int level, double moment) {
    fw_mesh *mesh = &e->mesh[level];
    fw_mesh_fill(e, level);
    e->p[0] = moment;
    e->p[1] = e->p[2] = 0;
    for (int n = 0; n < mesh->count; n++) {
        fw_element *el = &mesh->element[n];
        el->phi = moment * (el->cumulative + el->turned);
        el->start = moment * el->cumulative;
    }
    mesh->end = moment;
}

/* an exact equilibrium: the beam wound by a moment alone, which has the rotation or the moment that
   is given; the first Newton step from there is the law of finite.h */
static void begin_wound(fw_elastica *e, int level, const goal *g) {
    double moment = 0;
    if (!e->hinged && !gives(g, FW_END_THETA, &moment)) gives(g, FW_END_M, &moment);
    set_moment(e, level, moment);
}

static void keep(fw_elastica *e, int level) {
    const fw_mesh *mesh = &e->mesh[level];
    for (int n = 0; n < mesh->count; n++)
        mesh->element[n].kept = mesh->element[n].phi;
    for (int k = 0; k < FW_UNKNOWN; k++)
        e->kept[k] = e->p[k];
}

static void restore(fw_elastica *e, int level) {
    const fw_mesh *mesh = &e->mesh[level];
    for (int n = 0; n < mesh->count; n++)
        mesh->element[n].phi = mesh->element[n].kept;
    for (int k = 0; k < FW_UNKNOWN; k++)
        e->p[k] = e->kept[k];
}

static double determinant(fw_elastica *e, int level, const goal *g, double *size) {
    double a[3][3], x[3][3] = {{0}}, det;
    fw_end_state end;
    fw_mesh_pass(e, level, &end);
    *size = 1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            a[i][k] = end.by[g->given[i]][k];
        *size *= hypot(hypot(a[i][0], a[i][1]), a[i][2]);
    }
    fw_solve3(a, 0, x, &det);
    return det;
}

/* for another kind of task than the last: the determinant of the unloaded beam, 0 where nothing
   holds it, and the sign of the present one */
static void look_unloaded(fw_elastica *e, const goal *g) {
    if (e->kind[0] == g->given[0] && e->kind[1] == g->given[1] && e->kind[2] == g->given[2]) return;
    double size;
    fw_mesh_fill(e, 0);
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
   there. */
static double load_steps(fw_elastica *e, int level, const double from[3], const goal *to,
                         double sign, int *steps) {
    enum { HALVINGS = 13 };
    const double least = ldexp(1, -HALVINGS);
    double at = 0, step = 0.25;
    while (at < 1 && step >= least) {
        double next = fmin(1, at + step);
        goal part = *to;
        for (int i = 0; i < 3; i++)
            if (next < 1) part.value[i] = from[i] + next * (to->value[i] - from[i]);
        newton n = {.tolerance = 1e-7, .last = 1e-4, .contract = 0.25, .sign = sign};
        keep(e, level);
        ++*steps;
        if (newton_run(e, level, &part, &n)) {
            at = next;
            if (n.ratio < 0.08) step *= 2;
        } else {
            restore(e, level);
            step *= 0.5;
        }
    }
    return at;
}

typedef struct way {
    bool warm;
    double tolerance;
    double sign;
    double reached;
    int steps;
} way;

static bool from_last(fw_elastica *e, int level, const goal *g, way *w, newton *n) {
    const newton direct = *n;
    double from[3];
    for (int i = 0; i < 3; i++)
        from[i] = e->last[g->given[i]];
    keep(e, level);
    if (newton_run(e, level, g, n)) return true;
    restore(e, level);
    *n = direct;
    n->contract = 1;
    return load_steps(e, level, from, g, w->sign, &w->steps) == 1 && newton_run(e, level, g, n);
}

/* a solution on this mesh: from the last one, from the wound beam, or along the branch; false:
   none. Where the branch ends before, w->reached is below 1 and g holds that part of the values. */
static bool reach(fw_elastica *e, int level, goal *g, way *w, newton *n) {
    static const double nothing[3] = {0};
    const newton direct = {
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
    if (newton_run(e, level, g, n)) return true;
    set_moment(e, level, 0);
    w->reached = load_steps(e, level, nothing, g, 1, &w->steps);
    for (int i = 0; i < 3; i++)
        g->value[i] *= w->reached;
    *n = direct;
    n->sign = 1;
    n->contract = 1;
    return newton_run(e, level, g, n);
}

/* ---- the result ---- */

/* what rounding leaves: positions are of the size of the beam, wrenches what these ask for */
static void rounding(const double k[3][3], double twist[3], double wrench[3]) {
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int j = 0; j < 3; j++)
            if (isfinite(k[i][j])) sum += fabs(k[i][j]);
        twist[i] = 8 * DBL_EPSILON;
        wrench[i] = 8 * DBL_EPSILON * sum;
    }
}

/* K = T S^-1 from the derivatives of the twist (S) and of the wrench (T) by the unknowns */
static void tangent_of(const fw_end_state *end, double k[3][3]) {
    double a[3][3], x[3][3], det, size = 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            a[i][j] = end->by[j][i];
            x[i][j] = end->by[3 + j][i];
        }
    for (int j = 0; j < 3; j++)
        size *= hypot(hypot(a[0][j], a[1][j]), a[2][j]);
    bool regular = fw_solve3(a, 3, x, &det) && fabs(det) > 1e-13 * size;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k[i][j] = regular ? x[j][i] : (double)NAN;
}

typedef struct errors {
    double twist[3], wrench[3], mesh, whole; /* mesh: without rounding */
} errors;

static double relative(const double twist[3], const double wrench[3], const double *value) {
    double turn = fabs(value[0]) + hypot(value[1], value[2]);
    double load = fabs(value[3]) + hypot(value[4], value[5]), worst = 0;
    for (int i = 0; i < 3; i++) {
        if (turn > 0) worst = fmax(worst, twist[i] / turn);
        if (load > 0) worst = fmax(worst, wrench[i] / load);
    }
    return worst;
}

static void judge(const newton *fine, const double *coarse, const goal *g, const double k[3][3],
                  errors *out) {
    double round[2][3], rest = 10 * fine->change * fine->change; /* what the next pass would do */
    for (int i = 0; i < 3; i++) {
        out->twist[i] = fabs(fine->end.value[i] - coarse[i]) + rest;
        out->wrench[i] = fabs(fine->end.value[3 + i] - coarse[3 + i]) + rest;
    }
    rounding(k, round[0], round[1]);
    out->mesh = relative(out->twist, out->wrench, fine->end.value);
    for (int i = 0; i < 3; i++)
        out->twist[i] += round[0][i], out->wrench[i] += round[1][i];
    for (int i = 0; i < 3; i++)
        *(g->given[i] < 3 ? &out->twist[g->given[i]] : &out->wrench[g->given[i] - 3]) = 0;
    out->whole = relative(out->twist, out->wrench, fine->end.value);
}

/* units of (theta, ux, uy, M, Fx, Fy) */
static double unit(const fw_elastica *e, int which) {
    double l = e->length_m, C = e->soft;
    return which == 0 ? 1 : which < 3 ? l : which == 3 ? 1 / C : 1 / (C * l);
}

static void report(fw_elastica *e, const newton *n, const goal *g, const double k[3][3],
                   const errors *err, fw_elastica_result *out) {
    double value[6];
    for (int i = 0; i < 6; i++)
        value[i] = n->end.value[i];
    for (int i = 0; i < 3; i++)
        value[g->given[i]] = g->value[i];
    for (int i = 0; i < 6; i++)
        e->last[i] = value[i];
    for (int i = 0; i < 3; i++) {
        out->twist[i] = value[i] * unit(e, i);
        out->wrench[i] = value[3 + i] * unit(e, 3 + i);
        out->twist_error[i] = err->twist[i] * unit(e, i);
        out->wrench_error[i] = err->wrench[i] * unit(e, 3 + i);
        for (int j = 0; j < 3; j++)
            out->stiffness[i][j] = k[i][j] * unit(e, 3 + i) / unit(e, j);
    }
    out->start_Nm = e->hinged ? 0 : e->p[0] * unit(e, 3);
    out->start_rad = e->hinged ? e->p[0] : 0;
    out->error = err->whole;
    out->stability = n->stability;
}

/* ---- solve ---- */

/* the solution on one mesh is the start on the next finer one and their difference the error of the
   coarser; what is handed out is the finer. The tangent is that of the finer mesh's last pass. */
static void refine(fw_elastica *e, int level, goal *g, way *w, newton *n, fw_elastica_result *out) {
    bool have = true;
    out->code = FW_ELASTICA_FAILED;
    for (; level + 1 < FW_LEVELS; level++) {
        double coarse[6], k[3][3];
        errors err;
        if (!have && !reach(e, level, g, w, n)) continue;
        for (int i = 0; i < 6; i++)
            coarse[i] = n->end.value[i];
        fw_mesh_refine(e, level);
        *n = (newton){.tolerance = 0.1 * w->tolerance,
                      .last = fmin(1e-7, w->tolerance),
                      .contract = 0.5,
                      .sign = w->sign,
                      .square = n->square};
        have = newton_run(e, level + 1, g, n);
        if (!have) {
            w->warm = false;
            continue;
        }
        tangent_of(&n->end, k);
        judge(n, coarse, g, k, &err);
        report(e, n, g, k, &err, out);
        e->solved = level + 1;
        e->sign = n->stability < 0 ? -1 : 1;
        out->mesh = e->mesh[level + 1].count;
        out->code = err.whole <= w->tolerance ? FW_ELASTICA_OK : FW_ELASTICA_ROUGH;
        if (err.mesh <= w->tolerance) return;
    }
}

static bool sensible(const fw_elastica_task *task, goal *g, const fw_elastica *e) {
    for (int i = 0; i < 3; i++) {
        g->given[i] = task->given[i];
        g->value[i] = task->value[i] / unit(e, (int)task->given[i]);
        if (!isfinite(g->value[i])) return false;
        for (int j = 0; j < i; j++)
            if (g->given[i] == g->given[j]) return false;
    }
    return true;
}

/* Equations: elastica_pass.c. Unknown are the rotations at the nodes and p: the moment at the first
   root and the force. In: three of (theta, ux, uy, M, Fx, Fy); SI. Out: the other three, the
   tangent stiffness, errors.
   From the unloaded beam: Newton's method from the beam wound by a moment alone, and where that
   does not contract at once load steps from nothing, so that what is found is the primary branch. A
   step is refused when two changes in a row do not fall to a quarter or the determinant changes
   sign; a branch that cannot be followed further is tried again on the next meshes before it is
   called a limit. Valid for any rotation and load that the finest mesh resolves (16 elements a
   piece). Error: that of the coarser of two meshes, given with the result of the finer, plus
   rounding; the true one is smaller by orders. Cost: tests/bench/bench_hinge.c. Source: Reissner,
   ZAMP 23 (1972) 795; Hairer, Lubich and Wanner, Geometric Numerical Integration, II.1 and VI.4;
   docs/theory/flexure.md. Test: test_elastica.c, test_elastica_bench.c */
void fw_elastica_solve(fw_elastica *e, const fw_elastica_task *task, double tolerance, bool warm,
                       fw_elastica_result *out) {
    goal g, part = {0};
    newton n = {0};
    *out = (fw_elastica_result){.code = FW_ELASTICA_LOOSE};
    e->passes = 0;
    if (!sensible(task, &g, e)) return;
    warm = warm && e->solved > 0;
    look_unloaded(e, &g);
    if (e->unloaded == 0 && !warm) return;
    way w = {.warm = warm,
             .tolerance = fmax(tolerance, 1e-13),
             .sign = e->unloaded == 0 ? 0
                     : warm           ? e->sign
                                      : 1};
    double reached = -1;
    bool found = false;
    for (int level = warm ? e->solved - 1 : 0; level < FW_LEVELS - 1; level++) {
        fw_mesh_fill(e, level);
        part = g;
        found = reach(e, level, &part, &w, &n);
        if (found && w.reached == 1) {
            refine(e, level, &part, &w, &n, out);
            break;
        }
        bool agrees = found && fabs(w.reached - reached) < 1e-3 * reached;
        reached = found ? w.reached : -1;
        if (agrees || (found && level == FW_LEVELS - 2)) {
            refine(e, level, &part, &w, &n, out);
            out->code = FW_ELASTICA_LIMIT;
            break;
        }
        out->code = FW_ELASTICA_FAILED;
        if (w.warm) break;
    }
    if (out->code == FW_ELASTICA_FAILED) e->solved = -1;
    out->reached = found ? w.reached : 0;
    out->passes = e->passes;
    out->steps = w.steps;
}

void fw_elastica_of_twist(fw_elastica *e, const double twist[3], double tolerance, bool warm,
                          fw_elastica_result *out) {
    const fw_elastica_task task = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                   {twist[0], twist[1], twist[2]}};
    fw_elastica_solve(e, &task, tolerance, warm, out);
}

void fw_elastica_of_wrench(fw_elastica *e, const double wrench[3], double tolerance, bool warm,
                           fw_elastica_result *out) {
    const fw_elastica_task task = {{FW_END_M, FW_END_FX, FW_END_FY},
                                   {wrench[0], wrench[1], wrench[2]}};
    fw_elastica_solve(e, &task, tolerance, warm, out);
}

/* ---- tables ---- */

/* an element of eight nodes takes up to 3/4 of a turn of an arc to 1e-10 */
static int elements_of(const fw_beam_piece *piece) {
    return 1 + (int)(fabs(piece->curvature_per_m) * piece->length_m / 4.8);
}

static fw_status meshes(fw_arena *arena, fw_elastica *e) {
    int count = 0;
    FW_NEED(e->per_piece = fw_arena_array(arena, int, (size_t)e->beam->npiece));
    for (int i = 0; i < e->beam->npiece; i++)
        count += e->per_piece[i] = elements_of(&e->beam->piece[i]);
    for (int level = 0; level < FW_LEVELS; level++) {
        e->mesh[level].count = count << level;
        FW_NEED(e->mesh[level].element = fw_arena_array(arena, fw_element, (size_t)count << level));
    }
    return FW_OK;
}

fw_status fw_elastica_new(fw_arena *arena, const fw_beam *beam, const double *point_m, bool hinged,
                          fw_elastica **out) {
    fw_elastica *e = fw_arena_one(arena, fw_elastica);
    FW_NEED(e);
    e->beam = beam;
    e->hinged = hinged;
    e->solved = -1;
    e->kind[0] = e->kind[1] = e->kind[2] = FW_END_THETA; /* none */
    fw_rule_fill(&e->rule);
    fw_beam_compliance(beam, &e->linear);
    e->length_m = e->linear.length_m;
    e->soft = e->linear.c[0][0];
    FW_NEED(e->pose = fw_arena_array(arena, fw_beam_pose, (size_t)beam->npiece + 1));
    fw_beam_poses(beam, e->pose);
    const double *point = point_m ? point_m : e->linear.centre_m;
    e->arm[0] = (point[0] - e->linear.end.x_m) / e->length_m;
    e->arm[1] = (point[1] - e->linear.end.y_m) / e->length_m;
    for (int end = 0; end < 2; end++) {
        fw_beam_section at;
        int piece = end ? beam->npiece - 1 : 0;
        fw_beam_at(beam, piece, &e->pose[piece], end ? beam->piece[piece].length_m : 0, &at);
        e->root[end] = beam->root_m[end] * at.bend_per_Nm2 / e->soft;
    }
    FW_TRY(meshes(arena, e));
    *out = e;
    return FW_OK;
}

const fw_beam_linear *fw_elastica_linear(const fw_elastica *e) {
    return &e->linear;
}
