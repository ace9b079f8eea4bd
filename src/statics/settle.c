/* SPDX-License-Identifier: GPL-3.0-or-later */
/* To a stable equilibrium: by descent from a state nearby, or to the full load without a path. */
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- from a state to a stable equilibrium nearby ---- */

static const double fw_longest_step = 0.5; /* rad, or scaled lengths */
/* beyond this the mechanism runs away: no load of a scene turns a part five times around */
static const double fw_far = 32;
/* an unstable equilibrium is left by a twentieth, or by less down to this: rad, or scaled lengths */
static const double fw_least_escape = 1e-6;
enum { FW_NEWTON_STEPS = 400, FW_ESCAPES = 20 };

/* M^1/2 times the step, with the least shift of 0 and powers of 4, of the largest stiffness over mass, that leaves no negative
   one, and none of nothing where forces push along it: Newton's where all stiffnesses are positive, a descent always.
   Source: Nocedal and Wright, Numerical Optimization 2006, ch. 3.4. NaN: there is no memory, or no such shift. */
static double sparse_newton(fw_statics_equilibrium *w, double *step) {
    fw_statics_reduced *r = &w->reduced;
    const fw_statics_sparse *s = r->sparse;
    double most = 0;
    int negative;
    /* from what the last step needed on, which is 0 most of the time */
    const double first = fmax(1e-14, s->shift / 64);
    enum { TRIES = 60 };
    for (int k = 0; k < TRIES; k++) {
        const double shift = k == 0 ? 0 : ldexp(first, 2 * (k - 1));
        if (fw_statics_sparse_factor(r, shift, &negative) != FW_OK) return (double)NAN;
        if (negative > 0 || (shift > 0 && s->zero > 0)) continue;
        for (int i = 0; i < r->n; i++)
            step[i] = s->unbalanced[i] / s->unit;
        fw_statics_sparse_solve(r, step);
        most = 0;
        for (int i = 0; i < r->n; i++)
            step[i] *= r->root[i], most = fmax(most, fabs(step[i]));
        if (s->zero == 0 || fw_statics_sparse_answers(r, step)) return most;
    }
    return (double)NAN;
}

/* du = sum of modes times force / |stiffness|: the Newton step where all stiffnesses are positive,
   a descent of the energy always. A mode without stiffness goes with its force when there is one
   above round-off, else it rests. */
double fw_statics_equilibrium_newton(fw_statics_equilibrium *w, double *step) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n;
    double most = 0;
    if (w->sparse) return sparse_newton(w, step);
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
    const fw_statics_sparse *s = w->reduced.sparse;
    for (int i = 0; s && i < w->reduced.n; i++)
        if (fabs(s->unbalanced[i]) > s->round_off[i]) return false;
    if (s) return true;
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

/* of the loads that come yet, along the lowest mode */
static double slope_of(const fw_statics_equilibrium *w) {
    double slope = 0;
    for (int i = 0; i < w->reduced.n; i++)
        slope += w->slope[i] * w->reduced.shape[i];
    return slope;
}

/* A pose so far along the mode from the equilibrium, to the side where the energy is less, or, before any load acts, to that
   of the loads that come yet; or to the other one, where that is asked for. 0: neither can be had */
static double side_of(fw_statics_equilibrium *w, double far, double *to) {
    const fw_statics_reduced *r = &w->reduced;
    double best = (double)INFINITY, size, length = 0;
    int sides = 0;
    for (int side = 1; side >= -1; side -= 2) {
        for (int i = 0; i < r->n; i++)
            to[i] = w->y[i] + side * far * r->shape[i];
        if (!fw_statics_equilibrium_close(w, to)) continue;
        double energy = fw_statics_equilibrium_energy(w, to, &size);
        if (energy < best - 1e-12 * size) best = energy, length = side * far;
        sides++;
    }
    if (sides < 2) return length;
    const double push = w->factor == 0 ? slope_of(w) : 0;
    if (fabs(push) > w->noise[0]) length = push > 0 ? far : -far;
    return w->other_side ? -length : length;
}

/* An equilibrium that is no minimum is left along its most unstable mode, to the side where the
   energy falls more: by a twentieth, or where no element of force has a formula on either side so
   far away (electrodes stand nearer) by a quarter of that, and so on; false: stable, or indifferent */
static bool escape(fw_statics_equilibrium *w, double *to) {
    const fw_statics_reduced *r = &w->reduced;
    if (r->modes == 0 || r->value[0] >= -r->zero[0]) return false;
    double most = 0, length = 0;
    for (int i = 0; i < r->n; i++)
        most = fmax(most, fabs(r->shape[i]));
    for (double far = 0.05; length == 0 && far > fw_least_escape; far /= 4)
        length = side_of(w, far / most, to);
    if (length == 0) return false;
    for (int i = 0; i < r->n; i++)
        to[i] = w->y[i] + length * r->shape[i];
    return fw_statics_equilibrium_close(w, to);
}

/* half of how far the assembled pose reaches, scaled: long chains go as far in earnest */
static double reach(const fw_multibody_model *m) {
    double most = 0;
    for (int i = 0; i < m->nq; i++)
        if (i % 3 != 2) most = fmax(most, fabs(m->origin[i]));
    return most;
}

static bool too_far(const fw_multibody_model *m, const double *u) {
    const double far = fmax(fw_far, 4 * reach(m));
    for (int i = 0; i < m->nq; i++)
        if (!(fabs(u[i]) < (i % 3 == 2 ? fw_far : far))) return true;
    return false;
}

/* the step is cut where it turns a body by more than the longest step, or moves one by more of that share of the reach */
static void cut(const fw_multibody_model *m, double most, double *step) {
    const double far = fmax(1, 0.25 * reach(m));
    double longest = 0;
    for (int i = 0; i < m->nq; i++)
        longest = fmax(longest, fabs(step[i]) / (i % 3 == 2 ? 1 : far));
    if (m->nq <= FW_STATICS_DENSE) longest = most;
    for (int k = 0; longest > fw_longest_step && k < m->nq; k++)
        step[k] *= fw_longest_step / longest;
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
        if (!isfinite(most)) {
            status = FW_SOLVER;
            break;
        }
        bool settled = most <= 1e-15 ||
                       (most > 0.5 * before && (most < 1e-9 || fw_statics_equilibrium_quiet(w)));
        before = most;
        if (settled) {
            status = fw_statics_equilibrium_lowest(w, FW_STATICS_LOWEST);
            if (status != FW_OK) break;
            if (escapes == FW_ESCAPES || !escape(w, next)) break;
            escapes++, w->sides++;
            *left_unstable = true;
            before = (double)INFINITY;
            memcpy(w->y, next, bytes);
            continue;
        }
        cut(w->model, most, step);
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
        if (too_far(w->model, w->y)) break;
    }
    /* what the sparse system has grown by meanwhile stays */
    if (!w->sparse) fw_arena_rewind(w->arena, mark);
    return status;
}

/* ---- where there is none ---- */

/* the descent ended before a place where the formula of an element ends */
static fw_status does_not_hold(const fw_statics_equilibrium *w) {
    char factor[32], at[48];
    snprintf(at, sizeof at, "load factor %s", fw_number_text(factor, sizeof factor, w->factor, 4));
    return fw_effects_element_ended(w->invalid, fw_statics_equilibrium_scene_name(w), at, w->why,
                                    w->diags);
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
        "no equilibrium of %s%s was found at load factor %s: %s%s keeps moving (it had %s "
        "by %s %s); nothing holds %s against the loads",
        FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)),
        fw_number_text(factor, sizeof factor, w->factor, 4),
        FW_NAMED("body", fw_text_name(w->mechanism->body[b].id)), turns ? "turned" : "moved",
        fw_number_text(far, sizeof far, turns ? u[2] : way, 4), turns ? "rad" : "m", names);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* ---- where strains leave no start ---- */

/* What acts without being a load, the strains of ground and bodies, acts in full at every s. In the assembled pose nothing
   has given way to it yet, and a leg that it presses may be one that no beam can be there, where the equilibrium is far
   below that. Equilibria are then followed along the strain, from none of it on, at s = 0, and the loads come after it.

   Steps of a share: from the last equilibrium the ground's points go on, and the descent follows; halved where it finds none.
   Inputs and error: those of the descent. Cost: 8 models and descents where none is halved. Source: homotopy, Allgower and
   Georg 1990, ch. 11. Test: test_heated (tests/cli/test_heated.py), references of beams of finite elements. */

static const double fw_most_strain = 1.0 / 8, fw_least_of_way = 1e-5;

typedef struct follower { /* of what grows from 0 to 1 */
    fw_statics_equilibrium *w;
    double *q;   /* (n) the last equilibrium: SI, absolute */
    bool strain; /* grows; else s, up to `end` */
    double end;
    bool *left_unstable;
} follower;

static void take_pose(fw_statics_equilibrium *w, const double *q) {
    memset(w->y, 0, (size_t)w->model->ny * sizeof(double));
    for (int i = 0; i < w->model->nq; i++)
        w->y[i] = (q[i] - w->q0[i]) / (i % 3 == 2 ? 1 : w->model->scale.length_m);
}

/* the equilibrium with a share of the strain, from the last one; at a share of 0 from the assembled pose */
static fw_status with_strain(const follower *f, double share) {
    fw_statics_equilibrium at, *w = f->w;
    bool left = false;
    fw_mark mark = fw_arena_mark(w->arena);
    fw_diags silent = fw_diags_new(w->arena);
    fw_status status = fw_statics_equilibrium_strained(w, share, &silent, &at);
    if (status == FW_OK) {
        if (share > 0) take_pose(&at, f->q);
        status = fw_statics_equilibrium_descend(&at, &left);
        w->iterations = at.iterations, w->sides = at.sides;
    }
    if (status == FW_OK) fw_statics_equilibrium_pose(&at, at.y, f->q, NULL);
    if (status == FW_OK && left) *f->left_unstable = true;
    fw_arena_rewind(w->arena, mark);
    return status == FW_OK || status == FW_NOMEM || status == FW_CANCELLED ? status : FW_SOLVER;
}

static fw_status with_loads(const follower *f, double share) {
    fw_statics_equilibrium *w = f->w;
    bool left = false;
    take_pose(w, f->q);
    fw_statics_equilibrium_factor(w, share * f->end);
    FW_TRY(fw_statics_equilibrium_descend(w, &left));
    fw_statics_equilibrium_pose(w, w->y, f->q, NULL);
    if (left) *f->left_unstable = true;
    return FW_OK;
}

static fw_status grow(const follower *f, double most) {
    double done = 0, by = most;
    while (done < 1) {
        const double to = fmin(1, done + by);
        if (fw_arena_cancelled(f->w->arena)) return FW_CANCELLED;
        fw_arena_tell(f->w->arena, "looking for the equilibrium", 100 * to, 100,
                      f->strain ? "% of the strain" : "% of the load");
        const fw_status status = f->strain ? with_strain(f, to) : with_loads(f, to);
        if (status != FW_OK && status != FW_SOLVER) return status;
        if (status == FW_OK)
            done = to, by = fmin(most, 2 * by);
        else if ((by /= 2) < fw_least_of_way)
            return FW_SOLVER;
    }
    return FW_OK;
}

static fw_status along_strain(fw_statics_equilibrium *w, double s, bool *left_unstable) {
    follower f = {.w = w, .strain = true, .end = s, .left_unstable = left_unstable};
    FW_NEED(f.q = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    fw_statics_equilibrium_factor(w, 0);
    FW_TRY(with_strain(&f, 0));
    FW_TRY(grow(&f, fw_most_strain));
    f.strain = false;
    FW_TRY(with_loads(&f, 0));
    return s > 0 ? grow(&f, 1) : FW_OK;
}

/* What the layer's strain buckles does so when it is made, before any load of a scene acts: these do not decide the side, though
   the descent under both goes to theirs. In the assembled pose without loads: it is unstable, and the descent stays on it */
static fw_status strain_buckles(fw_statics_equilibrium *w, bool *buckles) {
    const int before = w->sides, iterations = w->iterations;
    *buckles = false;
    if (!w->frozen || !w->frozen->strained || w->sparse) return FW_OK;
    memset(w->y, 0, (size_t)w->model->ny * sizeof(double));
    fw_statics_equilibrium_factor(w, 0);
    fw_status status = fw_statics_equilibrium_evaluate(w);
    bool left = false;
    if (status == FW_OK && w->reduced.dof > 0 && w->reduced.value[0] < -w->reduced.zero[0])
        status = fw_statics_equilibrium_descend(w, &left);
    *buckles = status == FW_OK && left;
    if (!*buckles || !w->other_side) w->sides = before, w->iterations = iterations;
    return status == FW_SOLVER ? FW_OK : status;
}

/* on the other side of what the strain buckles: the loads come once it has */
static fw_status against_loads(fw_statics_equilibrium *w, double s, bool *left_unstable) {
    follower f = {.w = w, .end = s, .left_unstable = left_unstable};
    *left_unstable = true;
    FW_NEED(f.q = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    fw_statics_equilibrium_pose(w, w->y, f.q, NULL);
    return grow(&f, 1);
}

fw_status fw_statics_equilibrium_begin(fw_statics_equilibrium *w, double s, bool *left_unstable) {
    bool buckles = false;
    if (s > 0) FW_TRY(strain_buckles(w, &buckles));
    if (buckles && w->other_side) return against_loads(w, s, left_unstable);
    *left_unstable = false;
    memset(w->y, 0, (size_t)w->model->ny * sizeof(double));
    fw_statics_equilibrium_factor(w, s);
    fw_status status = fw_statics_equilibrium_descend(w, left_unstable);
    if (status == FW_OK && buckles && !*left_unstable) *left_unstable = true, w->sides++;
    if (status != FW_SOLVER || !w->invalid || !w->frozen || !w->frozen->strained) return status;
    if (w->beams_next && w->invalid->class_->closed_form) return status;
    const fw_effects_force_element *first = w->invalid;
    const char *why = w->why;
    *left_unstable = false;
    status = along_strain(w, s, left_unstable);
    if (status != FW_SOLVER) return status;
    fw_statics_equilibrium_factor(w, s); /* what is said is what was found first */
    w->invalid = first, w->why = why;
    return FW_SOLVER;
}

/* ---- to the full load ---- */

/* To the full load without a path: one descent, or, with drivers that move, along their way.

   Drivers take the mechanism along in steps of the load factor s. One step: u + ds du/ds with the
   motion du/ds that the drivers force (least mass norm), closed by Newton, then the descent to
   equilibrium. It counts when the closing corrects little of it and du/ds has turned little, so
   that the assembly stays on its branch, also across places where another branch crosses; else it
   is halved. Error of what is found: that of the descent. Cost: about 60 evaluations (30 n^3) per
   radian that a driver turns. Source: predictor-corrector continuation, Allgower and Georg 1990,
   ch. 2. Test: test_statics.c (turning mechanisms). */

static const double fw_first_share = 1.0 / 16, fw_least_share = 1e-9;
static const double fw_most_way = 0.3;   /* of any coordinate in one step: rad, scaled lengths */
static const double fw_correction = 0.1; /* of a step, at most, by closing the joints */
static const double fw_straight = 0.99;  /* cosine between du/ds before and after, at least */
static const double fw_contradiction = 1e-6; /* of dPsi/ds, when no motion follows it */

typedef struct walker {
    fw_statics_equilibrium *w;
    double *from, *tangent; /* (n) last equilibrium, du/ds there */
    int dof;
    bool *blamed; /* (nblock) drivers that no motion can follow */
} walker;

/* ---- why drivers are not followed ---- */

/* what of dPsi/ds lies outside of the range of G, at the evaluated state: with A = D G M^-1/2 = U S
   V^T, D dPsi/ds less its part in U_1. Blocks with a part of it contradict each other. */
static fw_status find_contradiction(walker *k) {
    const fw_statics_equilibrium *w = k->w;
    const fw_statics_reduced *r = &w->reduced;
    const fw_multibody_model *m = w->model;
    size_t rows = (size_t)r->rows;
    double *packed, *block, size = 0;
    FW_NEED(packed = fw_arena_array(w->arena, double, rows));
    FW_NEED(block = fw_arena_array(w->arena, double, 2 * (size_t)m->nblock));
    for (int i = 0; i < m->nblock; i++)
        block[2 * i] = w->way[i];
    fw_multibody_pack(m, block, packed);
    for (size_t i = 0; i < rows; i++) {
        packed[i] *= r->balance[i];
        size = fmax(size, fabs(packed[i]));
    }
    for (int l = 0; l < r->rank && !w->sparse; l++) {
        const double *u = r->left + (size_t)l * rows;
        double share = 0;
        for (size_t i = 0; i < rows; i++)
            share += u[i] * packed[i];
        for (size_t i = 0; i < rows; i++)
            packed[i] -= share * u[i];
    }
    fw_multibody_unpack(m, packed, block);
    for (int i = 0; i < m->nblock; i++)
        k->blamed[i] = !w->sparse && m->block[i].driver != FW_NONE &&
                       fabs(block[2 * i]) > fw_contradiction * size;
    return FW_OK;
}

static fw_status driver_names(const walker *k, fw_text *names, int *count) {
    const fw_multibody_model *m = k->w->model;
    *count = 0;
    for (int i = 0; i < m->ndriver; i++) { /* in the order of the file */
        if (!k->blamed[m->driver_block[i]]) continue;
        fw_text_printf(names, "%s%s", (*count)++ ? ", " : "",
                       fw_multibody_block_name(k->w->mechanism, &m->block[m->driver_block[i]]));
    }
    return fw_text_end(names);
}

static fw_status cannot_follow(walker *k, double s) {
    fw_statics_equilibrium *w = k->w;
    const fw_multibody_model *m = w->model;
    char at[32];
    int count;
    fw_text names = fw_text_new(w->arena);
    int stuck = w->system->record.stuck;
    fw_statics_equilibrium_factor(w, s);
    memcpy(w->y, k->from, (size_t)m->nq * sizeof(double));
    if (fw_statics_equilibrium_evaluate(w) == FW_OK) FW_TRY(find_contradiction(k));
    FW_TRY(driver_names(k, &names, &count));
    const char *few = count > 0 ? fw_text_few(w->arena, names.data) : "";
    FW_NEED(few);
    fw_number_text(at, sizeof at, s, 4);
    fw_status status;
    if (count > 0)
        status = fw_diag_error(w->diags, 118, w->scene->place,
                               "the drivers of %s%s contradict %s from load factor %s on: "
                               "%s prescribe%s values that the joints do not allow%s",
                               FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)),
                               count > 1 ? "each other" : "the joints", at, few,
                               count > 1 ? "" : "s", count > 1 ? " together" : "");
    else
        status = fw_diag_error(
            w->diags, 118, w->scene->place,
            "the mechanism cannot follow its drivers in %s%s beyond load factor %s: %s"
            "%s cannot be kept closed, because the mechanism cannot reach any farther",
            FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)), at,
            FW_NAMED("joint", stuck >= 0 ? fw_multibody_block_name(w->mechanism, &m->block[stuck])
                                         : "(unnamed)"));
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* ---- one step of the drivers ---- */

static double product(const fw_multibody_model *m, const double *x, const double *y) {
    double sum = 0;
    for (int i = 0; i < m->nq; i++)
        sum += (i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]) * x[i] * y[i];
    return sum;
}

static void keep(walker *k) {
    size_t bytes = (size_t)k->w->model->nq * sizeof(double);
    memcpy(k->from, k->w->y, bytes);
    memcpy(k->tangent, k->w->follow, bytes);
    k->dof = k->w->reduced.dof;
}

/* from the kept equilibrium over ds to a closed pose at s, evaluated; *good: near enough */
static fw_status predict(walker *k, double s, double ds, bool *good) {
    fw_statics_equilibrium *w = k->w;
    const fw_multibody_model *m = w->model;
    double moved = 0, off = 0;
    *good = false;
    for (int i = 0; i < m->nq; i++) {
        w->y[i] = k->from[i] + ds * k->tangent[i];
        moved = fmax(moved, fabs(ds * k->tangent[i]));
    }
    if (!(moved <= fw_most_way)) return FW_OK;
    fw_statics_equilibrium_factor(w, s);
    fw_status status = fw_statics_equilibrium_evaluate(w);
    if (status != FW_OK) return status == FW_SOLVER ? FW_OK : status;
    for (int i = 0; i < m->nq; i++)
        off = fmax(off, fabs(w->y[i] - k->from[i] - ds * k->tangent[i]));
    double before = product(m, k->tangent, k->tangent), after = product(m, w->follow, w->follow);
    double both = product(m, k->tangent, w->follow);
    *good = off <= fw_correction * moved + 1e-9 && w->reduced.dof <= k->dof &&
            both >= fw_straight * sqrt(before * after);
    return FW_OK;
}

static fw_status walk(walker *k, bool *left_unstable) {
    fw_statics_equilibrium *w = k->w;
    double s = 0, ds = fw_first_share;
    while (s < 1) {
        if (fw_arena_cancelled(w->arena)) return FW_CANCELLED;
        fw_arena_tell(w->arena, "looking for the equilibrium", 100 * s, 100, "% of the load");
        double to = s + ds >= 1 ? 1 : s + ds;
        bool good;
        FW_TRY(predict(k, to, to - s, &good));
        if (!good) {
            ds /= 2;
            if (ds < fw_least_share) return cannot_follow(k, s);
            continue;
        }
        if (w->reduced.dof > 0) {
            fw_status status = fw_statics_equilibrium_descend(w, left_unstable);
            if (status != FW_OK)
                return status == FW_SOLVER ? fw_statics_equilibrium_nowhere(w) : status;
        }
        keep(k);
        s = to;
        ds *= 2;
    }
    return FW_OK;
}

fw_status fw_statics_equilibrium_settle(fw_statics_equilibrium *w, bool *left_unstable) {
    size_t n = (size_t)w->model->nq;
    walker k = {.w = w};
    fw_status status = fw_statics_equilibrium_begin(w, w->moving ? 0 : 1, left_unstable);
    if (status != FW_OK) return status == FW_SOLVER ? fw_statics_equilibrium_nowhere(w) : status;
    if (!w->moving) return FW_OK;
    FW_NEED(k.from = fw_arena_array(w->arena, double, n));
    FW_NEED(k.tangent = fw_arena_array(w->arena, double, n));
    FW_NEED(k.blamed = fw_arena_array(w->arena, bool, (size_t)w->model->nblock));
    keep(&k);
    return walk(&k, left_unstable);
}
