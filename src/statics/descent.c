/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a state to a stable equilibrium nearby, and what is said where there is none. */
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_longest_step = 0.5; /* rad, or scaled lengths */
/* beyond this the mechanism runs away: no load of a scene turns a part five times around */
static const double fw_far = 32;
enum { FW_NEWTON_STEPS = 400, FW_ESCAPES = 20 };

/* du = sum of modes times force / |stiffness|: the Newton step where all stiffnesses are positive,
   a descent of the energy always. A mode without stiffness goes with its force when there is one
   above round-off, else it rests. */
double fw_statics_equilibrium_newton(const fw_statics_equilibrium *w, double *step) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    double most = 0;
    memset(step, 0, n * sizeof *step);
    for (size_t k = 0; k < (size_t)r->dof; k++) {
        double stiff = fabs(r->value[k]), force = w->gradient[k];
        if (stiff <= r->zero[k]) {
            if (fabs(force) <= w->noise[k]) continue;
            stiff = fmax(r->zero[k], 1e-12);
        }
        for (size_t i = 0; i < n; i++)
            step[i] += r->shape[k * n + i] * (force / stiff);
    }
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(step[i]));
    return most;
}

bool fw_statics_equilibrium_quiet(const fw_statics_equilibrium *w) {
    for (int k = 0; k < w->reduced.dof; k++)
        if (fabs(w->gradient[k]) > w->noise[k]) return false;
    return true;
}

static double slope_along(const fw_statics_equilibrium *w, const double *step) {
    double slope = 0;
    for (int i = 0; i < w->model->nq; i++)
        slope += w->force[i] * step[i];
    return slope;
}

/* halves the step until the potential falls by a share of what the force promises (Armijo) */
static bool line_search(fw_statics_equilibrium *w, const double *from, const double *step,
                        double *to) {
    double size, promise = slope_along(w, step),
                 before = fw_statics_equilibrium_energy(w, from, &size);
    for (double share = 1; share > 1e-4; share /= 2) {
        for (int i = 0; i < w->model->nq; i++)
            to[i] = from[i] + share * step[i];
        if (!fw_statics_equilibrium_close(w, to)) continue;
        double after = fw_statics_equilibrium_energy(w, to, &size);
        if (after <= before - 1e-4 * share * promise + 8 * DBL_EPSILON * size) return true;
    }
    return false;
}

/* an equilibrium that is no minimum is left along its most unstable mode, to the side where the
   energy falls more; false: stable, or indifferent */
static bool escape(fw_statics_equilibrium *w, double *to) {
    const fw_statics_reduced *r = &w->reduced;
    if (r->dof == 0 || r->value[0] >= -r->zero[0]) return false;
    const double *u = w->y;
    double most = 0, best = (double)INFINITY, size, length = 0;
    for (int i = 0; i < r->n; i++)
        most = fmax(most, fabs(r->shape[i]));
    for (int side = 1; side >= -1; side -= 2) {
        for (int i = 0; i < r->n; i++)
            to[i] = u[i] + side * 0.05 / most * r->shape[i];
        if (!fw_statics_equilibrium_close(w, to)) continue;
        double energy = fw_statics_equilibrium_energy(w, to, &size);
        if (energy < best - 1e-12 * size) best = energy, length = side * 0.05 / most;
    }
    if (length == 0) return false;
    for (int i = 0; i < r->n; i++)
        to[i] = u[i] + length * r->shape[i];
    return fw_statics_equilibrium_close(w, to);
}

static bool too_far(const double *u, int n) {
    for (int i = 0; i < n; i++)
        if (!(fabs(u[i]) < fw_far)) return true;
    return false;
}

/* Minimises the potential over the poses that the joints allow: Newton in the modes of the tangent
   stiffness with |stiffness|, Armijo line search, corrections of the pose in the mass metric;
   saddles are left along negative curvature. Near the end, where energies differ by round-off only,
   full steps until they no longer halve. Start and result w->y, scaled; error: round-off times the
   ratio of the stiffnesses. Cost: one evaluation (30 n^3) per step, about 5 to 15 steps. Stops and
   cables bend the energy's slope but do not break it: their state follows the pose. Source: Nocedal
   and Wright, Numerical Optimization 2006, ch. 3; modified spectrum, Greenstadt 1967. Test:
   test_statics.c. */
fw_status fw_statics_equilibrium_descend(fw_statics_equilibrium *w, bool *left_unstable) {
    size_t bytes = (size_t)w->model->nq * sizeof(double);
    double *step, *next, before = (double)INFINITY;
    fw_mark mark = fw_arena_mark(w->arena);
    FW_NEED(step = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    FW_NEED(next = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    fw_status status = FW_SOLVER;
    int escapes = 0;
    for (int i = 0; i < FW_NEWTON_STEPS; i++, w->iterations++) {
        if (fw_arena_cancelled(w->arena)) return FW_CANCELLED;
        status = fw_statics_equilibrium_evaluate(w);
        if (status != FW_OK) break;
        double most = fw_statics_equilibrium_newton(w, step);
        bool settled = most <= 1e-15 ||
                       (most > 0.5 * before && (most < 1e-9 || fw_statics_equilibrium_quiet(w)));
        before = most;
        if (settled) {
            if (escapes == FW_ESCAPES || !escape(w, next)) break;
            escapes++;
            *left_unstable = true;
            before = (double)INFINITY;
            memcpy(w->y, next, bytes);
            continue;
        }
        for (int k = 0; most > fw_longest_step && k < w->model->nq; k++)
            step[k] *= fw_longest_step / most;
        if (most < 1e-5) {
            for (int k = 0; k < w->model->nq; k++)
                w->y[k] += step[k];
        } else if (line_search(w, w->y, step, next)) {
            memcpy(w->y, next, bytes);
        } else {
            status = FW_SOLVER;
            break;
        }
        status = FW_SOLVER; /* until it is settled */
        if (too_far(w->y, w->model->nq)) break;
    }
    fw_arena_rewind(w->arena, mark);
    return status;
}

/* ---- where there is none ---- */

/* the descent ended before a place where the formula of an element ends */
static fw_status does_not_hold(const fw_statics_equilibrium *w) {
    char factor[32];
    fw_status status =
        fw_diag_error(w->diags, 242, w->invalid->place, "%s of scene %s at load factor %s: %s",
                      w->invalid->id, fw_statics_equilibrium_scene_name(w),
                      fw_number_text(factor, sizeof factor, w->factor, 4), w->why);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

fw_status fw_statics_equilibrium_nowhere(const fw_statics_equilibrium *w) {
    const char *names;
    if (w->invalid) return does_not_hold(w);
    FW_TRY(fw_statics_equilibrium_bodies(w, w->y, &names));
    char far[32], factor[32];
    int b = fw_statics_equilibrium_mover(w, w->y);
    const double *u = w->y + 3 * b;
    double way = hypot(u[0], u[1]) * w->model->scale.length_m;
    bool turns = fabs(u[2]) >= hypot(u[0], u[1]);
    fw_status status = fw_diag_error(
        w->diags, 111, w->scene->place,
        "no equilibrium of scene %s was found at load factor %s: body %s keeps moving (it had %s "
        "by %s %s); nothing holds %s against the loads",
        fw_statics_equilibrium_scene_name(w), fw_number_text(factor, sizeof factor, w->factor, 4),
        w->mechanism->body[b].id ? w->mechanism->body[b].id : "(unnamed)",
        turns ? "turned" : "moved", fw_number_text(far, sizeof far, turns ? u[2] : way, 4),
        turns ? "rad" : "m", names);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}
