/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solver of the elastica: a solution on one mesh, a finer one for the error, the result. */
#include "flexure/beam.h"
#include "flexure/elastica_core.h"
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <string.h>

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
static void tangent_of(const fw_flexure_end_state *end, double k[3][3]) {
    double a[3][3], x[3][3], det, size = 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            a[i][j] = end->by[j][i];
            x[i][j] = end->by[3 + j][i];
        }
    for (int j = 0; j < 3; j++)
        size *= hypot(hypot(a[0][j], a[1][j]), a[2][j]);
    bool regular = fw_maths_solve3(a, 3, x, &det) && fabs(det) > 1e-13 * size;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k[i][j] = regular ? x[j][i] : (double)NAN;
}

typedef struct errors {
    double twist[3], wrench[3], mesh, round, whole; /* mesh, round: without the other */
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

static void judge(const fw_flexure_newton *fine, const double *coarse, const fw_flexure_goal *g,
                  const double k[3][3], errors *out) {
    double round[2][3], rest = 10 * fine->change * fine->change; /* what the next pass would do */
    for (int i = 0; i < 3; i++) {
        out->twist[i] = fabs(fine->end.value[i] - coarse[i]) + rest;
        out->wrench[i] = fabs(fine->end.value[3 + i] - coarse[3 + i]) + rest;
    }
    rounding(k, round[0], round[1]);
    out->mesh = relative(out->twist, out->wrench, fine->end.value);
    for (int i = 0; i < 3; i++)
        round[g->given[i] / 3][g->given[i] % 3] = 0;
    out->round = relative(round[0], round[1], fine->end.value);
    for (int i = 0; i < 3; i++)
        out->twist[i] += round[0][i], out->wrench[i] += round[1][i];
    for (int i = 0; i < 3; i++)
        *(g->given[i] < 3 ? &out->twist[g->given[i]] : &out->wrench[g->given[i] - 3]) = 0;
    out->whole = relative(out->twist, out->wrench, fine->end.value);
}

/* units of (theta, ux, uy, M, Fx, Fy) */
static double unit(const fw_flexure_elastica *e, int which) {
    double l = e->length_m, C = e->soft;
    return which == 0 ? 1 : which < 3 ? l : which == 3 ? 1 / C : 1 / (C * l);
}

static void report(fw_flexure_elastica *e, const fw_flexure_newton *n, const fw_flexure_goal *g,
                   const double k[3][3], const errors *err, fw_flexure_elastica_result *out) {
    double value[6];
    for (int i = 0; i < 6; i++)
        value[i] = n->end.value[i];
    for (int i = 0; i < 3; i++) /* of a place that is eased only a part is given */
        if (!g->eased || (g->given[i] != FW_END_UX && g->given[i] != FW_END_UY))
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
    e->judged[0] = fabs(value[0]), e->judged[1] = hypot(value[4], value[5]);
    out->start_Nm = e->hinged ? 0 : e->p[0] * unit(e, 3);
    out->start_rad = e->hinged ? e->p[0] : 0;
    out->error = err->whole;
    out->stability = n->stability;
}

/* ---- solve ---- */

/* the solution on one mesh is the start on the next finer one and their difference the error of the
   coarser; what is handed out is the finer. The tangent is that of the finer mesh's last pass. */
static void refine(fw_flexure_elastica *e, int level, const fw_flexure_goal *g, fw_flexure_way *w,
                   fw_flexure_newton *n, fw_flexure_elastica_result *out) {
    bool have = true;
    out->code = FW_ELASTICA_FAILED;
    for (; level + 1 < FW_LEVELS; level++) {
        double coarse[6], k[3][3];
        errors err;
        fw_flexure_goal whole = *g;
        if (!have && (!fw_flexure_elastica_reach(e, level, &whole, w, n) || w->reached < 1))
            continue;
        for (int i = 0; i < 6; i++)
            coarse[i] = n->end.value[i];
        fw_flexure_mesh_refine(e, level);
        *n = (fw_flexure_newton){.tolerance = 0.1 * w->tolerance,
                                 .last = fmin(1e-7, w->tolerance),
                                 .contract = 0.5,
                                 .sign = w->sign,
                                 .square = n->square};
        have = fw_flexure_newton_run(e, level + 1, g, n);
        if (!have) {
            w->warm = false;
            continue;
        }
        tangent_of(&n->end, k);
        judge(n, coarse, g, k, &err);
        report(e, n, g, k, &err, out);
        e->solved = level + 1;
        e->halved = err.mesh <= w->tolerance;
        e->moved = false;
        e->square = n->square;
        e->sign = n->stability < 0 ? -1 : 1;
        out->mesh = e->mesh[level + 1].count;
        out->code = err.whole <= w->tolerance ? FW_ELASTICA_OK : FW_ELASTICA_ROUGH;
        if (err.whole <= w->tolerance || err.mesh <= err.round) return; /* no mesh rounds less */
    }
}

/* at a limit the tangent is singular and a finer mesh has it a little elsewhere: the result is the
   nearest state before it that both meshes have */
static double stop_before(fw_flexure_elastica *e, int level, const fw_flexure_goal *g,
                          double reached, fw_flexure_way *w, fw_flexure_newton *n,
                          fw_flexure_elastica_result *out) {
    for (int i = 0; i < 8; i++) {
        fw_flexure_goal part = *g;
        double to = reached * (1 - 1e-4 * (ldexp(1, i) - 1));
        for (int k = 0; k < 3; k++)
            part.value[k] *= to;
        if (!fw_flexure_elastica_reach(e, level, &part, w, n) || w->reached < 1) continue;
        refine(e, level, &part, w, n, out);
        if (out->code == FW_ELASTICA_FAILED) continue;
        out->code = FW_ELASTICA_LIMIT;
        return to;
    }
    out->code = FW_ELASTICA_FAILED;
    return 0;
}

/* the coarsest mesh that resolves how a strip bends near its roots under the force guessed, over
   lengths of 1/sqrt(F): of h^2 F above this Newton's method over 8 nodes comes near slowly or not */
static const double fw_resolved = 40;

static int first_level(fw_flexure_elastica *e, const double *guess) {
    if (!guess) return 0;
    double force = hypot(guess[FW_END_FX], guess[FW_END_FY]), most = 0;
    for (int n = 0; n < e->mesh[0].count; n++) {
        const fw_flexure_element *el = &e->mesh[0].element[n];
        most = fmax(most, force * el->h * el->turn); /* turn: h over EI */
    }
    int level = 0;
    for (; level < FW_LEVELS - 2 && most > fw_resolved; level++)
        most *= 0.25;
    return level;
}

static bool sensible(const fw_flexure_elastica_task *task, fw_flexure_goal *g,
                     const fw_flexure_elastica *e) {
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
   Where another law's state is given Newton's method begins there. From the unloaded beam: it begins
   from the beam wound by a moment alone, and where that does not contract at once load steps from
   nothing, so that what is found is the primary branch. A step is refused when two changes in a row do not fall to a quarter or the determinant changes
   sign; a branch that cannot be followed further is tried again on the next meshes before it is
   called a limit. Valid for any rotation and load that the finest mesh resolves (16 elements a
   piece). Error: that of the coarser of two meshes, given with the result of the finer, plus
   rounding; the true one is smaller by orders. Cost: tests/bench/bench_hinge.c. Source: Reissner,
   ZAMP 23 (1972) 795; Hairer, Lubich and Wanner, Geometric Numerical Integration, II.1 and VI.4;
   docs/theory/beams.md. Test: test_elastica.c, test_elastica_bench.c */
static void find(fw_flexure_elastica *e, const fw_flexure_elastica_task *task, double tolerance,
                 bool warm, const double *guess, const double *soft,
                 fw_flexure_elastica_result *out) {
    fw_flexure_goal g = {.eased = soft, .soft = {soft ? soft[0] : 1, soft ? soft[1] : 0}}, part = g;
    fw_flexure_newton n = {0};
    *out = (fw_flexure_elastica_result){.code = FW_ELASTICA_LOOSE};
    e->passes = 0;
    if (!sensible(task, &g, e)) return;
    warm = warm && e->solved > 0;
    fw_flexure_elastica_unloaded(e, &g);
    if (e->unloaded == 0 && !warm) return;
    fw_flexure_way w = {.warm = warm,
                        .guess = guess,
                        .tolerance = fmax(tolerance, 1e-13),
                        .sign = e->unloaded == 0 ? 0
                                : warm           ? e->sign
                                                 : 1};
    double reached = -1;
    bool found = false;
    int from = first_level(e, guess);
    if (from < e->least) from = e->least;
    for (int level = warm ? e->solved - !e->moved : from; level < FW_LEVELS - 1; level++) {
        fw_flexure_mesh_fill(e, level);
        part = g;
        found = fw_flexure_elastica_reach(e, level, &part, &w, &n);
        if (found && w.reached == 1) {
            refine(e, level, &part, &w, &n, out);
            break;
        }
        bool agrees = found && fabs(w.reached - reached) < 1e-3 * reached;
        reached = found ? w.reached : -1;
        if (agrees || (found && level == FW_LEVELS - 2)) {
            reached = stop_before(e, level, &g, reached, &w, &n, out);
            break;
        }
        out->code = FW_ELASTICA_FAILED;
        if (w.warm) break;
    }
    if (out->code == FW_ELASTICA_FAILED) e->solved = -1;
    out->reached = out->code == FW_ELASTICA_LIMIT ? reached : found ? 1 : 0;
    out->passes = e->passes;
    out->steps = w.steps;
}

int fw_flexure_elastica_level(const fw_flexure_elastica *e) {
    return e->solved > 0 ? e->solved - 1 : 0;
}

void fw_flexure_elastica_no_coarser(fw_flexure_elastica *e, int level) {
    e->least = level;
}

void fw_flexure_elastica_solve(fw_flexure_elastica *e, const fw_flexure_elastica_task *task,
                               double tolerance, bool warm, fw_flexure_elastica_result *out) {
    find(e, task, tolerance, warm, NULL, NULL, out);
}

static void without_units(const fw_flexure_elastica *e, const double twist[3],
                          const double wrench[3], double guess[6]) {
    for (int i = 0; i < 3; i++) {
        guess[i] = twist[i] / unit(e, i);
        guess[3 + i] = wrench[i] / unit(e, 3 + i);
    }
}

void fw_flexure_elastica_near(fw_flexure_elastica *e, const fw_flexure_elastica_task *task,
                              const double twist[3], const double wrench[3], double tolerance,
                              fw_flexure_elastica_result *out) {
    double guess[6];
    without_units(e, twist, wrench, guess);
    find(e, task, tolerance, false, guess, NULL, out);
}

/* of the last solution whose error is known: for half as much again the mesh is as good, and so is the
   one before it, whose error that was */
static const double more = 1.5, more_turn = 0.02, more_force = 1;

bool fw_flexure_elastica_again(fw_flexure_elastica *e, const fw_flexure_elastica_task *task,
                               double tolerance, fw_flexure_elastica_result *out) {
    fw_flexure_goal g = {.eased = false};
    fw_flexure_newton n = {.tolerance = 0.1 * tolerance,
                           .last = 0.01,
                           .contract = 0.4,
                           .sign = e->sign,
                           .square = e->square};
    if (e->solved < 0 || !sensible(task, &g, e)) return false;
    for (int i = 0; i < 3; i++)
        if (e->kind[i] != g.given[i]) return false;
    if (!e->moved && e->halved) e->solved--;
    e->moved = true;
    if (!fw_flexure_newton_run(e, e->solved, &g, &n)) {
        e->solved = -1;
        return false;
    }
    e->square = n.square;
    memcpy(e->last, n.end.value, sizeof e->last);
    *out = (fw_flexure_elastica_result){.code = FW_ELASTICA_OK};
    for (int i = 0; i < 3; i++) {
        out->twist[i] = e->last[i] * unit(e, i);
        out->wrench[i] = e->last[3 + i] * unit(e, 3 + i);
    }
    out->start_Nm = e->hinged ? 0 : e->p[0] * unit(e, 3);
    return fabs(e->last[0]) <= more * e->judged[0] + more_turn &&
           hypot(e->last[4], e->last[5]) <= more * e->judged[1] + more_force;
}

void fw_flexure_elastica_held(fw_flexure_elastica *e, const double twist[3], const double wrench[3],
                              const double along[2], double tolerance,
                              fw_flexure_elastica_result *out) {
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                           {twist[0], twist[1], twist[2]}};
    double guess[6];
    without_units(e, twist, wrench, guess);
    find(e, &task, tolerance, false, guess, along, out);
}

void fw_flexure_elastica_of_twist(fw_flexure_elastica *e, const double twist[3], double tolerance,
                                  bool warm, fw_flexure_elastica_result *out) {
    const fw_flexure_elastica_task task = {{FW_END_THETA, FW_END_UX, FW_END_UY},
                                           {twist[0], twist[1], twist[2]}};
    fw_flexure_elastica_solve(e, &task, tolerance, warm, out);
}

void fw_flexure_elastica_of_wrench(fw_flexure_elastica *e, const double wrench[3], double tolerance,
                                   bool warm, fw_flexure_elastica_result *out) {
    const fw_flexure_elastica_task task = {{FW_END_M, FW_END_FX, FW_END_FY},
                                           {wrench[0], wrench[1], wrench[2]}};
    fw_flexure_elastica_solve(e, &task, tolerance, warm, out);
}

/* ---- tables ---- */

/* an element of eight nodes takes up to 3/4 of a turn of an arc to 1e-8, halved to 1e-12 */
static int elements_of(const fw_flexure_beam_piece *piece) {
    return 1 + (int)(fabs(piece->curvature_per_m) * piece->length_m / 4.8);
}

static fw_status meshes(fw_arena *arena, fw_flexure_elastica *e) {
    int count = 0;
    FW_NEED(e->per_piece = fw_arena_array(arena, int, (size_t)e->beam->npiece));
    for (int i = 0; i < e->beam->npiece; i++)
        count += e->per_piece[i] = elements_of(&e->beam->piece[i]);
    for (int level = 0; level < FW_LEVELS; level++) {
        e->mesh[level].count = count << level;
        FW_NEED(e->mesh[level].element =
                    fw_arena_array(arena, fw_flexure_element, (size_t)count << level));
    }
    return FW_OK;
}

/* principal compliances of W */
static void find_stiff_direction(fw_flexure_elastica *e) {
    const double slender = 100; /* arcs have 24 at most, leaves (L/t)^2 */
    double(*c)[3] = e->linear.c, half = 0.5 * (c[1][1] - c[2][2]);
    double mean = 0.5 * (c[1][1] + c[2][2]), off = hypot(half, c[1][2]);
    e->stiff = !(mean + off < slender * (mean - off));
    e->twice_soft_rad = atan2(c[1][2], half);
    /* of the force that a rounded place asks for, over the largest stiffness; none: inextensible */
    double most = e->beam->inextensible ? 0 : e->soft * e->length_m * e->length_m / (mean - off);
    e->floor = 16 * DBL_EPSILON * most;
}

fw_status fw_flexure_elastica_new(fw_arena *arena, const fw_flexure_beam *beam,
                                  const double *point_m, bool hinged, fw_flexure_elastica **out) {
    fw_flexure_elastica *e = fw_arena_one(arena, fw_flexure_elastica);
    FW_NEED(e);
    e->beam = beam;
    e->hinged = hinged;
    e->solved = -1;
    e->kind[0] = e->kind[1] = e->kind[2] = FW_END_THETA; /* none */
    fw_flexure_rule_fill(&e->rule);
    fw_flexure_beam_compliance(beam, &e->linear);
    e->length_m = e->linear.length_m;
    e->soft = e->linear.c[0][0];
    find_stiff_direction(e);
    FW_NEED(e->pose = fw_arena_array(arena, fw_flexure_beam_pose, (size_t)beam->npiece + 1));
    fw_flexure_beam_poses(beam, e->pose);
    const double *point = point_m ? point_m : e->linear.centre_m;
    e->arm[0] = (point[0] - e->linear.end.x_m) / e->length_m;
    e->arm[1] = (point[1] - e->linear.end.y_m) / e->length_m;
    for (int end = 0; end < 2; end++) {
        fw_flexure_beam_section at;
        int piece = end ? beam->npiece - 1 : 0;
        fw_flexure_beam_at(beam, piece, &e->pose[piece], end ? beam->piece[piece].length_m : 0,
                           &at);
        e->root[end] = beam->root_m[end] * at.bend_per_Nm2 / e->soft;
    }
    FW_TRY(meshes(arena, e));
    *out = e;
    return FW_OK;
}

const fw_flexure_beam_linear *fw_flexure_elastica_linear(const fw_flexure_elastica *e) {
    return &e->linear;
}
