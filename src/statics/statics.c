/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/statics.h"
#include "statics/level.h"
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_longest_step = 0.5; /* rad, or scaled lengths */
/* beyond this the mechanism runs away: no load of a scene turns a part five times around */
static const double fw_far = 32;
enum { FW_NEWTON_STEPS = 400, FW_ESCAPES = 20 };

/* ---- descent ---- */

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

/* ---- answer ---- */

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

static fw_status actives(const fw_statics_equilibrium *w, fw_statics *out) {
    const fw_multibody_model *m = w->model;
    out->nactive = fw_multibody_switch_count(m);
    FW_NEED(out->active = fw_arena_array(w->arena, fw_statics_active, (size_t)out->nactive));
    for (int i = 0; i < m->nstop; i++)
        out->active[i] = (fw_statics_active){.id = w->mechanism->pin[m->stop[i].pin].id,
                                             .side = m->stop[i].side};
    for (int i = 0, k = m->nstop; i < m->nspring; i++)
        if (m->spring[i].cable)
            out->active[k++] = (fw_statics_active){.id = w->mechanism->spring[i].id};
    for (int i = 0; i < m->nswitch; i++) {
        const fw_effects_force_element *e = fw_multibody_element_of_switch(m, i)->own;
        out->active[m->nstop + m->ncable + i] =
            (fw_statics_active){.id = e->id, .effect = e->class_->effect};
    }
    for (int i = 0; i < out->nactive; i++)
        out->active[i].on = fw_multibody_switch_on(w->system, i);
    return FW_OK;
}

static fw_status count_signs(const fw_statics_equilibrium *w, fw_statics *out) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    double *sum, largest = DBL_MIN, worst = 0;
    FW_NEED(sum = fw_arena_array(w->arena, double, n));
    for (int k = 0; k < r->dof; k++) {
        out->eigenvalue_per_s2[k] = r->value[k] * fw_statics_equilibrium_per_s2(w);
        worst = fmax(worst, fabs(w->gradient[k]));
        if (r->value[k] < -r->zero[k]) out->negative++;
        if (fabs(r->value[k]) > r->zero[k]) continue;
        out->neutral++;
        const double *shape = r->shape + (size_t)k * n;
        double most = fw_statics_equilibrium_part(shape, fw_statics_equilibrium_mover(w, shape));
        for (size_t i = 0; i < n; i++) /* each motion as large, whatever its masses */
            sum[i] = fmax(sum[i], fabs(shape[i]) / most);
    }
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, fabs(w->force[i]) * r->root[i]);
    out->residual = worst / fmax(largest, 1); /* forces of order one are the scale's */
    if (out->neutral == 0) return FW_OK;
    FW_TRY(fw_statics_equilibrium_bodies(w, sum, &out->loose));
    fw_diag_warning(w->diags, 113, w->scene->place,
                    "in scene %s nothing holds %s: its equilibrium is not unique",
                    fw_statics_equilibrium_scene_name(w), out->loose);
    return FW_OK;
}

static fw_status answer(const fw_statics_equilibrium *w, fw_statics *out) {
    size_t n = (size_t)w->model->nq, pins = (size_t)w->mechanism->npin;
    out->nbody = w->mechanism->nbody;
    out->npin = w->mechanism->npin;
    out->njoint = w->mechanism->njoint;
    out->ndriver = w->mechanism->ndriver;
    out->dof = w->reduced.dof;
    out->ledger = w->ledger;
    fw_effects_in_equilibrium(&out->ledger); /* whatever was asked for */
    out->iterations = w->iterations;
    out->rest_q = w->q0;
    out->pull_in = w->pull_in;
    FW_NEED(out->q = fw_arena_array(w->arena, double, n));
    FW_NEED(out->angle_rad = fw_arena_array(w->arena, double, pins));
    FW_NEED(out->reaction_N = fw_arena_array(w->arena, double, 2 * pins));
    FW_NEED(out->joint_N = fw_arena_array(w->arena, double, 3 * (size_t)out->njoint));
    FW_NEED(out->driver_N = fw_arena_array(w->arena, double, (size_t)out->ndriver));
    FW_NEED(out->eigenvalue_per_s2 = fw_arena_array(w->arena, double, (size_t)out->dof));
    fw_statics_equilibrium_pose(w, w->y, out->q, out->angle_rad);
    fw_statics_equilibrium_reactions(w, out->reaction_N, out->joint_N, out->driver_N);
    FW_TRY(actives(w, out));
    FW_TRY(fw_statics_equilibrium_rank(w, &out->rank));
    return count_signs(w, out);
}

static fw_status path_ends_early(const fw_statics_equilibrium *w, const fw_statics_path *path) {
    char text[32];
    fw_diag_warning(w->diags, 112, w->scene->place,
                    "the load path of scene %s ends after %d points at load factor %s, before "
                    "the full load: the equilibrium reported is not connected to the unloaded "
                    "one",
                    fw_statics_equilibrium_scene_name(w), path->count,
                    fw_number_text(text, sizeof text, path->factor[path->count - 1], 4));
    return FW_OK;
}

/* along the path when it is asked for and complete, else straight down */
static fw_status reach(fw_statics_equilibrium *w, const fw_statics_static_options *o,
                       fw_statics *out) {
    if (o->path) {
        fw_status status = fw_statics_equilibrium_descend(w, &out->left_unstable);
        if (status != FW_OK)
            return status == FW_SOLVER ? fw_statics_equilibrium_nowhere(w) : status;
        FW_TRY(fw_statics_equilibrium_follow(w, o->most_points, &out->path));
        if (out->path->complete) return FW_OK;
        FW_TRY(path_ends_early(w, out->path));
    }
    return fw_statics_equilibrium_settle(w, &out->left_unstable);
}

fw_status fw_statics_equilibrium_statics(fw_statics_equilibrium *w,
                                         const fw_statics_static_options *options,
                                         const fw_statics **statics) {
    fw_statics *out;
    FW_NEED(out = fw_arena_one(w->arena, fw_statics));
    FW_TRY(reach(w, options, out));
    FW_TRY(answer(w, out));
    *statics = out;
    return FW_OK;
}

static fw_status with_level(fw_arena *arena, const fw_statics *found,
                            const fw_statics_level_step *step, double accuracy,
                            const fw_statics_static_options *options, const fw_statics **statics) {
    fw_statics *own = fw_arena_one(arena, fw_statics);
    FW_NEED(own);
    *own = *found;
    own->level = step;
    FW_TRY(fw_statics_level_note(arena, step, accuracy, &options->effects, &own->ledger.hinge));
    *statics = own;
    return FW_OK;
}

static fw_status equilibrium(fw_arena *arena, const fw_mechanism *mechanism,
                             const fw_device_scene *scene, const fw_statics_static_options *options,
                             fw_diags *diags, const fw_statics **found,
                             const fw_statics_level_step **step) {
    fw_statics_equilibrium w;
    FW_TRY(fw_statics_equilibrium_new(arena, mechanism, scene, &options->effects, diags, &w));
    /* first: it says why there may be no equilibrium */
    FW_TRY(fw_statics_pull_in_find(arena, mechanism, scene, &options->effects, diags, &w.pull_in));
    FW_TRY(fw_statics_equilibrium_statics(&w, options, found));
    return fw_statics_level_of_equilibrium(&w, step);
}

/* the next level was wanted and has no equilibrium: what is there counts */
static fw_status stay(fw_arena *arena, const fw_statics **statics) {
    fw_statics *own = fw_arena_one(arena, fw_statics);
    FW_NEED(own);
    *own = **statics;
    *statics = own;
    return fw_statics_level_stays(arena, own->level, "the equilibrium could not be found with it",
                                  &own->ledger.hinge);
}

fw_status fw_statics_solve(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_device_scene *scene, const fw_statics_static_options *options,
                           fw_diags *diags, const fw_statics **statics) {
    fw_effect_choice choice = options->effects;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    *statics = NULL;
    for (;;) {
        const fw_statics_static_options o = {
            .effects = choice, .path = options->path, .most_points = options->most_points};
        fw_diags own = fw_diags_new(arena);
        const fw_statics_level_step *step = NULL;
        const fw_statics *found;
        bool higher = *statics != NULL;
        fw_status status =
            equilibrium(arena, mechanism, scene, &o, higher ? &own : diags, &found, &step);
        if (higher && status == FW_SOLVER) return stay(arena, statics);
        FW_TRY(status);
        FW_TRY(with_level(arena, found, step, accuracy, options, statics));
        if (!fw_statics_level_climb(step, accuracy, &options->effects, &choice)) return FW_OK;
    }
}
