/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/statics.h"
#include "base/constants.h"
#include "statics/statics_equilibrium.h"
#include "maths/matrix.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_visible = 0.22; /* amplitude of the frames: rad, or scaled lengths */

typedef struct damped { /* in modal coordinates, scaled */
    double *damping;    /* (dof x dof) Phi^T C Phi */
    double *re, *im;    /* (2 dof) eigenvalues */
    double *zre, *zim;  /* (2 dof x dof) their modal shapes */
} damped;

const char *fw_statics_mode_kind_text(fw_statics_mode_kind kind) {
    static const char *const text[] = {"oscillation", "overdamped", "free", "unstable"};
    return text[kind];
}

/* ---- damped eigenvalues ---- */

/* the same by entries: what the modes that are known do to each other */
static fw_status sparse_damping(const fw_statics_equilibrium *w, damped *d) {
    const fw_statics_reduced *r = &w->reduced;
    const size_t n = (size_t)r->n, modes = (size_t)r->modes;
    fw_statics_entries *k = &r->sparse->stiffness, *c = &r->sparse->damping;
    const fw_effects_matrix to_k = {.add = fw_statics_entries_add, .to = k},
                            to_c = {.add = fw_statics_entries_add, .to = c};
    fw_statics_entries_clear(k), fw_statics_entries_clear(c);
    const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
    fw_statics_tangent_to(w->system, pose, w->y + w->model->nq, w->lambda, &to_k, &to_c);
    if (k->failed || c->failed) return FW_NOMEM;
    for (size_t a = 0; a < modes; a++)
        for (size_t b = 0; b < modes; b++)
            for (int e = 0; e < c->count; e++)
                d->damping[a * modes + b] += r->shape[a * n + (size_t)c->row[e]] * c->value[e] *
                                             r->shape[b * n + (size_t)c->column[e]];
    return FW_OK;
}

/* Phi^T C Phi at the evaluated state */
static fw_status modal_damping(const fw_statics_equilibrium *w, damped *d) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n, dof = (size_t)r->modes;
    double *c, *part;
    if (w->sparse) return sparse_damping(w, d);
    fw_mark mark = fw_arena_mark(w->arena);
    FW_NEED(c = fw_arena_array(w->arena, double, n *n));
    FW_NEED(part = fw_arena_array(w->arena, double, n *dof));
    const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
    fw_statics_tangent(w->system, pose, w->y + w->model->nq, w->lambda, w->stiffness, c);
    for (size_t k = 0; k < dof; k++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                part[k * n + i] += c[i * n + j] * r->shape[k * n + j];
    for (size_t k = 0; k < dof; k++)
        for (size_t l = 0; l < dof; l++) {
            double sum = 0;
            for (size_t i = 0; i < n; i++)
                sum += r->shape[l * n + i] * part[k * n + i];
            d->damping[k * dof + l] = sum;
        }
    fw_arena_rewind(w->arena, mark);
    return FW_OK;
}

/* modal stiffness; what is zero within round-off is zero */
static double modal_stiffness(const fw_statics_reduced *r, int k) {
    return fabs(r->value[k]) <= r->zero[k] ? 0 : r->value[k];
}

/* value -> nearest root of  a x^2 + b x + c  with a = z.z, b = z.C z, c = z.K z (no conjugates):
   the two-sided Rayleigh quotient of a symmetric quadratic pencil; the error is squared */
static void polish(const fw_statics_reduced *r, const damped *d, int which) {
    size_t dof = (size_t)r->modes;
    double *zr = d->zre + (size_t)which * dof, *zi = d->zim + (size_t)which * dof;
    double a[2] = {0}, b[2] = {0}, c[2] = {0}, size = 0;
    for (size_t k = 0; k < dof; k++) {
        double cr = 0, ci = 0, mu = modal_stiffness(r, (int)k);
        for (size_t l = 0; l < dof; l++) {
            cr += d->damping[k * dof + l] * zr[l];
            ci += d->damping[k * dof + l] * zi[l];
        }
        double rr = zr[k] * zr[k] - zi[k] * zi[k], ri = 2 * zr[k] * zi[k];
        a[0] += rr, a[1] += ri, c[0] += mu * rr, c[1] += mu * ri;
        b[0] += zr[k] * cr - zi[k] * ci, b[1] += zr[k] * ci + zi[k] * cr;
        size += zr[k] * zr[k] + zi[k] * zi[k];
    }
    if (!(hypot(a[0], a[1]) > 1e-3 * size)) return; /* nearly defective: the quotient is blind */
    double x = d->re[which], y = d->im[which];
    for (int i = 0; i < 3; i++) { /* Newton on the quadratic */
        double fr = a[0] * (x * x - y * y) - a[1] * 2 * x * y + b[0] * x - b[1] * y + c[0];
        double fi = a[1] * (x * x - y * y) + a[0] * 2 * x * y + b[1] * x + b[0] * y + c[1];
        double gr = 2 * (a[0] * x - a[1] * y) + b[0], gi = 2 * (a[1] * x + a[0] * y) + b[1];
        double norm = gr * gr + gi * gi;
        if (!(norm > 0)) return;
        double dx = (fr * gr + fi * gi) / norm, dy = (fi * gr - fr * gi) / norm;
        if (!(hypot(dx, dy) <= 1e-4 * hypot(x, y))) return;
        x -= dx, y -= dy;
    }
    d->re[which] = x;
    d->im[which] = d->im[which] == 0 ? 0 : y;
}

static bool is_undamped(const damped *d, size_t dof) {
    for (size_t k = 0; k < dof * dof; k++)
        if (d->damping[k] != 0) return false;
    return true;
}

/* without damping each mode swings by itself: lambda = +- sqrt(-mu), to the last bit */
static void take_undamped(const fw_statics_reduced *r, damped *d) {
    const size_t dof = (size_t)r->modes;
    for (size_t k = 0; k < dof; k++) {
        const double mu = modal_stiffness(r, (int)k), root = sqrt(fabs(mu));
        d->re[2 * k] = mu < 0 ? root : 0, d->re[2 * k + 1] = -d->re[2 * k];
        d->im[2 * k] = mu < 0 ? 0 : root, d->im[2 * k + 1] = -d->im[2 * k];
        d->zre[2 * k * dof + k] = d->zre[(2 * k + 1) * dof + k] = 1;
    }
}

/* z'' + C z' + diag(mu) z = 0 as first-order system of (W z, z'), W = sqrt|mu|:
       [ 0, W; -sign(mu) W, -C ],
   which has the norm of the largest frequency instead of its square. Eigenvalues by dgeev, then one
   two-sided Rayleigh quotient. Error: round-off times the largest frequency over the value before
   it, its square behind. Cost 200 dof^3. Source: Tisseur and Meerbergen, SIAM Review 43 (2001).
   Test: test_modes.c (reference six-bar, 34-digit values). */
static fw_status damped_pairs(const fw_statics_equilibrium *w, damped *d) {
    const fw_statics_reduced *r = &w->reduced;
    int dof = r->modes, n = 2 * dof;
    size_t wide = (size_t)n, half = (size_t)dof;
    double *a, *vector;
    FW_NEED(d->damping = fw_arena_array(w->arena, double, half *half));
    FW_NEED(d->re = fw_arena_array(w->arena, double, wide));
    FW_NEED(d->im = fw_arena_array(w->arena, double, wide));
    FW_NEED(d->zre = fw_arena_array(w->arena, double, wide *half));
    FW_NEED(d->zim = fw_arena_array(w->arena, double, wide *half));
    FW_TRY(modal_damping(w, d));
    if (is_undamped(d, half)) {
        take_undamped(r, d);
        return FW_OK;
    }
    FW_NEED(a = fw_arena_array(w->arena, double, wide *wide));
    FW_NEED(vector = fw_arena_array(w->arena, double, wide *wide));
    for (size_t k = 0; k < half; k++) {
        double mu = modal_stiffness(r, (int)k), root = sqrt(fabs(mu));
        a[k * wide + half + k] = root;
        a[(half + k) * wide + k] = mu < 0 ? root : -root;
        for (size_t l = 0; l < half; l++)
            a[(half + k) * wide + half + l] = -d->damping[k * half + l];
    }
    FW_TRY(fw_maths_eigen_general(w->arena, n, a, d->re, d->im, vector));
    for (int k = 0; k < n; k++) {
        bool second = d->im[k] < 0; /* of a pair: the conjugate */
        const double *p = vector + (size_t)(second ? k - 1 : k) * wide + half;
        for (size_t l = 0; l < half; l++) {
            d->zre[(size_t)k * half + l] = p[l];
            d->zim[(size_t)k * half + l] = d->im[k] == 0 ? 0 : (second ? -1 : 1) * p[wide + l];
        }
        if (!second)
            polish(r, d, k);
        else
            d->re[k] = d->re[k - 1], d->im[k] = -d->im[k - 1];
    }
    return FW_OK;
}

/* ---- which eigenvalue is of which mode ---- */

typedef struct matching {
    int dof;
    double *part; /* (2 dof x dof) of each mode in the modal shape of each eigenvalue, 0 to 1 */
    int *
        best; /* (2 dof) the mode that has most of it, of those with room for it; FW_NONE: there is none */
    int *owner; /* (2 dof) mode of each eigenvalue */
    int *room;  /* (dof) how many eigenvalues a mode may still take */
} matching;

static void find_parts(const damped *d, matching *m) {
    const size_t dof = (size_t)m->dof;
    for (size_t i = 0; i < 2 * dof; i++) {
        double *part = m->part + i * dof, sum = 0;
        for (size_t l = 0; l < dof; l++) {
            const double re = d->zre[i * dof + l], im = d->zim[i * dof + l];
            sum += part[l] = re * re + im * im;
        }
        for (size_t l = 0; l < dof; l++)
            part[l] = sum > 0 ? part[l] / sum : 0;
    }
}

static void find_best(matching *m, int i, int wanted) {
    const double *part = m->part + (size_t)i * (size_t)m->dof;
    m->best[i] = FW_NONE;
    for (int k = 0; k < m->dof; k++)
        if (m->room[k] >= wanted && (m->best[i] == FW_NONE || part[k] > part[m->best[i]]))
            m->best[i] = k;
}

/* the best match of what is not given yet first: pairs (two places of a mode), or real values (one) */
static void match_all(const damped *d, matching *m, bool pairs) {
    const int n = 2 * m->dof, wanted = pairs ? 2 : 1;
    for (int i = 0; i < n; i++) {
        const bool asked = m->owner[i] == FW_NONE && d->im[i] >= 0 && (d->im[i] > 0) == pairs;
        m->best[i] = FW_NONE;
        if (asked) find_best(m, i, wanted);
    }
    for (;;) {
        int next = FW_NONE;
        double most = -1;
        for (int i = 0; i < n; i++) {
            if (m->best[i] == FW_NONE) continue;
            const double part = m->part[(size_t)i * (size_t)m->dof + (size_t)m->best[i]];
            if (part > most) most = part, next = i;
        }
        if (next == FW_NONE) return;
        const int mode = m->best[next];
        m->owner[next] = mode, m->best[next] = FW_NONE, m->room[mode] -= wanted;
        if (pairs) m->owner[next + 1] = mode;
        for (int i = 0; m->room[mode] < wanted && i < n; i++)
            if (m->best[i] == mode) find_best(m, i, wanted);
    }
}

/* Every eigenvalue goes to the mode that it has most of: pairs first, so that the real ones fill what is left. Cost
   some 10 dof^2 where shapes are near their modes, dof^3 at most. */
static fw_status match(fw_arena *arena, const damped *d, int dof, int *owner, int *room) {
    matching m = {.dof = dof, .owner = owner, .room = room};
    const size_t n = (size_t)dof;
    FW_NEED(m.part = fw_arena_array(arena, double, 2 * n * n));
    FW_NEED(m.best = fw_arena_array(arena, int, 2 * n));
    for (int k = 0; k < dof; k++)
        room[k] = 2;
    for (int i = 0; i < 2 * dof; i++)
        owner[i] = FW_NONE;
    find_parts(d, &m);
    match_all(d, &m, true);
    match_all(d, &m, false);
    return FW_OK;
}

/* ---- one mode ---- */

static double size_of(const double *x, int n) {
    double most = 0;
    for (int i = 0; i < n; i += 3)
        most = fmax(most, fmax(hypot(x[i], x[i + 1]), fabs(x[i + 2])));
    return most;
}

/* undamped shape k in SI, the largest part 1 and positive in its largest rotation */
static fw_status undamped_shape(const fw_statics_equilibrium *w, int k, fw_statics_mode *mode) {
    const fw_statics_reduced *r = &w->reduced;
    const fw_multibody_scale s = w->model->scale;
    const double *from = r->shape + (size_t)k * (size_t)r->n;
    FW_NEED(mode->shape = fw_arena_array(w->arena, double, (size_t)r->n));
    double size = size_of(from, r->n), turn = 0;
    for (int i = 2; i < r->n; i += 3)
        if (fabs(from[i]) > fabs(turn)) turn = from[i];
    for (int i = 0; fabs(turn) < 1e-6 * size && i < r->n; i++)
        if (fabs(from[i]) > fabs(turn)) turn = from[i];
    double unit = (turn < 0 ? -1 : 1) / size;
    for (int i = 0; i < r->n; i++)
        mode->shape[i] = unit * from[i] * (i % 3 == 2 ? 1 : s.length_m);
    mode->modal_mass_kg_m2 = unit * unit * s.mass_kg * s.length_m * s.length_m;
    int b = fw_statics_equilibrium_mover(w, from);
    mode->body = fw_text_name(w->mechanism->body[b].id);
    return fw_statics_equilibrium_bodies(w, from, &mode->bodies);
}

/* complex shape of eigenvalue i, the largest entry made real and 1 */
static fw_status damped_shape(const fw_statics_equilibrium *w, const damped *d, int which,
                              fw_statics_mode *mode) {
    const fw_statics_reduced *r = &w->reduced;
    size_t n = (size_t)r->n, dof = (size_t)r->modes;
    double *to, largest = 0;
    size_t at = 0;
    FW_NEED(to = mode->damped = fw_arena_array(w->arena, double, 2 * n));
    for (size_t i = 0; i < n; i++) {
        for (size_t l = 0; l < dof; l++) {
            to[i] += d->zre[(size_t)which * dof + l] * r->shape[l * n + i];
            to[n + i] += d->zim[(size_t)which * dof + l] * r->shape[l * n + i];
        }
        double now = hypot(to[i], to[n + i]);
        if (now > largest * (1 + 1e-9)) largest = now, at = i;
    }
    if (!(largest > 0)) { /* eigenvalue 0: speeds vanish, the undamped shape is meant */
        memcpy(to, mode->shape, n * sizeof *to);
        return FW_OK;
    }
    double c = to[at] / (largest * largest), s = -to[n + at] / (largest * largest);
    for (size_t i = 0; i < n; i++) {
        double x = to[i], y = to[n + i], unit = i % 3 == 2 ? 1 : w->model->scale.length_m;
        to[i] = unit * (c * x - s * y);
        to[n + i] = unit * (s * x + c * y);
    }
    return FW_OK;
}

/* by the damped eigenvalues, which are what the motion does. A double eigenvalue 0 comes out of the
   eigenproblem as +-sqrt(eps) of the largest: below 1e-7 of it a motion is free. */
static fw_statics_mode_kind kind_of(const fw_statics_mode *m, double largest_per_s) {
    const double(*e)[2] = m->eigenvalue_per_s;
    double size = fmax(hypot(e[0][0], e[0][1]), hypot(e[1][0], e[1][1]));
    if (m->stiffness_per_s2 == 0 || size <= 1e-7 * largest_per_s) {
        bool grows = e[0][0] > 1e-6 * largest_per_s;
        return grows ? FW_MODE_UNSTABLE : FW_MODE_FREE;
    }
    if (e[0][0] > 1e-9 * size) return FW_MODE_UNSTABLE;
    return e[0][1] > 0 ? FW_MODE_OSCILLATION : FW_MODE_OVERDAMPED;
}

static void take_values(const fw_statics_equilibrium *w, const damped *d, const int *owner, int k,
                        fw_statics_mode *mode, int *first) {
    double per_s = 1 / w->model->scale.time_s;
    int count = 0;
    *first = FW_NONE;
    for (int i = 0; i < 2 * w->reduced.modes && count < 2; i++) {
        if (owner[i] != k) continue;
        bool front = count == 0 || d->re[i] > d->re[*first];
        if (count == 1 && front) {
            mode->eigenvalue_per_s[1][0] = mode->eigenvalue_per_s[0][0];
            mode->eigenvalue_per_s[1][1] = mode->eigenvalue_per_s[0][1];
        }
        double *to = mode->eigenvalue_per_s[front ? 0 : 1];
        to[0] = d->re[i] * per_s, to[1] = d->im[i] * per_s;
        if (front) *first = i;
        count++;
    }
    double mu = modal_stiffness(&w->reduced, k);
    mode->stiffness_per_s2 = mu * per_s * per_s;
    mode->omega_rad_per_s = mu > 0 ? sqrt(mu) * per_s : 0;
    mode->f_Hz = mode->omega_rad_per_s / (2 * FW_PI);
    double largest = 0;
    for (int i = 0; i < 2 * w->reduced.modes; i++)
        largest = fmax(largest, hypot(d->re[i], d->im[i]) * per_s);
    mode->kind = kind_of(mode, largest);
    if (mode->kind == FW_MODE_FREE) mode->omega_rad_per_s = mode->f_Hz = 0;
    const double *value = mode->eigenvalue_per_s[0];
    mode->damping_ratio = (double)NAN;
    if (mode->kind == FW_MODE_OSCILLATION)
        mode->damping_ratio = -value[0] / hypot(value[0], value[1]);
    else if (mode->kind == FW_MODE_OVERDAMPED) /* c / (2 sqrt(k m)) of the two values */
        mode->damping_ratio = -(value[0] + mode->eigenvalue_per_s[1][0]) /
                              (2 * sqrt(value[0] * mode->eigenvalue_per_s[1][0]));
}

/* one period at a visible amplitude; the joints are closed at every frame where that goes */
static fw_status frames(fw_statics_equilibrium *w, fw_statics_mode *mode) {
    size_t n = (size_t)w->model->nq;
    double *u, length = w->model->scale.length_m;
    FW_NEED(mode->frame = fw_arena_array(w->arena, double, FW_MODE_FRAMES *n));
    FW_NEED(u = fw_arena_array(w->arena, double, n));
    for (int i = 0; i < FW_MODE_FRAMES; i++) {
        if (fw_arena_cancelled(w->arena)) return FW_CANCELLED;
        double phase = sin(2 * FW_PI * i / (FW_MODE_FRAMES - 1));
        if (i == FW_MODE_FRAMES - 1) phase = 0;
        for (size_t k = 0; k < n; k++)
            u[k] = w->y[k] + fw_visible * phase * mode->shape[k] / (k % 3 == 2 ? 1 : length);
        /* too far for the joints, or so many that they would take most of the time: as it is */
        if (w->sparse || !fw_statics_equilibrium_close(w, u))
            for (size_t k = 0; k < n; k++)
                u[k] = w->y[k] + fw_visible * phase * mode->shape[k] / (k % 3 == 2 ? 1 : length);
        fw_statics_equilibrium_pose(w, u, mode->frame + (size_t)i * n, NULL);
    }
    return FW_OK;
}

/* ---- the pose ---- */

static fw_status not_found(const fw_statics_equilibrium *w) {
    if (w->invalid) return fw_statics_equilibrium_nowhere(w);
    fw_status status = fw_diag_error(w->diags, 111, w->scene->place,
                                     "the pose of %s%s could not be evaluated: its numbers are not "
                                     "finite; check loads, masses and stiffnesses",
                                     FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)));
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* at rest the pose is taken as it is; says so when it is no equilibrium */
static fw_status at_rest(fw_statics_equilibrium *w, fw_statics_modes *out) {
    fw_status status = fw_statics_equilibrium_evaluate(w);
    if (status == FW_OK) status = fw_statics_equilibrium_lowest(w, FW_STATICS_LOWEST_MODES);
    if (status == FW_SOLVER) return not_found(w);
    FW_TRY(status);
    const fw_statics_reduced *r = &w->reduced;
    bool held = true;
    for (int k = 0; k < r->modes; k++)
        held = held && (fabs(r->value[k]) > r->zero[k] || fabs(w->gradient[k]) <= w->noise[k]);
    out->out_of_rest = held ? fw_statics_equilibrium_newton(w, w->step) : (double)INFINITY;
    if (held && out->out_of_rest < 1e-9) return FW_OK;
    char text[32];
    fw_diag_warning(w->diags, 114, w->scene->place,
                    "the assembled pose is not in equilibrium (%s%s): its modes are those of "
                    "the mechanism held there; --at equilibrium computes them at its equilibrium",
                    held ? "which lies some " : "nothing holds it",
                    held ? fw_number_text(text, sizeof text, out->out_of_rest, 2) : "");
    return FW_OK;
}

static fw_status reach_pose(fw_statics_equilibrium *w, const fw_statics_mode_options *o,
                            fw_statics_modes *out) {
    if (!o->at_equilibrium) return at_rest(w, out);
    bool unstable = false;
    w->other_side = o->other_side;
    fw_status status = fw_statics_equilibrium_reach(w, 0, &unstable, NULL);
    out->sides = w->sides;
    if (status == FW_OK) out->out_of_rest = 0;
    if (status == FW_OK) status = fw_statics_equilibrium_lowest(w, FW_STATICS_LOWEST_MODES);
    return status;
}

static void report_free(const fw_statics_equilibrium *w, const fw_statics_modes *out) {
    for (int k = 0; k < out->count; k++) {
        const fw_statics_mode *mode = &out->mode[k];
        if (mode->kind == FW_MODE_FREE)
            fw_diag_warning(w->diags, 113, w->scene->place,
                            "nothing holds %s in %s%s: mode %d is a free motion of frequency 0",
                            mode->bodies, FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)),
                            k + 1);
        else if (mode->kind == FW_MODE_UNSTABLE)
            fw_diag_warning(
                w->diags, 113, w->scene->place, "the pose of %s%s is unstable: mode %d (%s) grows",
                FW_NAMED("scene", fw_statics_equilibrium_scene_name(w)), k + 1, mode->bodies);
    }
}

static fw_status all_modes(fw_statics_equilibrium *w, const fw_statics_mode_options *o,
                           fw_statics_modes *out) {
    damped d;
    int *owner, *room, first, dof = w->reduced.modes;
    out->count = dof, out->dof = w->reduced.dof;
    FW_NEED(out->mode = fw_arena_array(w->arena, fw_statics_mode, (size_t)dof));
    FW_NEED(owner = fw_arena_array(w->arena, int, 2 * (size_t)dof));
    FW_NEED(room = fw_arena_array(w->arena, int, (size_t)dof));
    FW_TRY(damped_pairs(w, &d));
    FW_TRY(match(w->arena, &d, dof, owner, room));
    for (int k = 0; k < dof; k++) {
        fw_statics_mode *mode = &out->mode[k];
        FW_TRY(undamped_shape(w, k, mode));
        take_values(w, &d, owner, k, mode, &first);
        if (first != FW_NONE) FW_TRY(damped_shape(w, &d, first, mode));
    }
    for (int k = 0; k < dof && k < o->drawn; k++)
        FW_TRY(frames(w, &out->mode[k]));
    report_free(w, out);
    return fw_statics_equilibrium_stick(w, out);
}

fw_status fw_statics_equilibrium_modes(fw_statics_equilibrium *w,
                                       const fw_statics_mode_options *options,
                                       const fw_statics_modes **modes) {
    fw_statics_modes *out;
    FW_NEED(out = fw_arena_one(w->arena, fw_statics_modes));
    FW_TRY(reach_pose(w, options, out));
    out->nbody = w->mechanism->nbody;
    out->npin = w->mechanism->npin;
    out->at_equilibrium = options->at_equilibrium;
    out->unit_length_m = w->model->scale.length_m;
    out->ledger = w->ledger;
    FW_NEED(out->q = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    fw_statics_equilibrium_pose(w, w->y, out->q, NULL);
    FW_TRY(fw_statics_equilibrium_rank(w, &out->rank));
    fw_status status = all_modes(w, options, out);
    if (status == FW_SOLVER) return not_found(w);
    FW_TRY(status);
    *modes = out;
    return FW_OK;
}

/* ---- what flexures' errors do to frequencies ---- */

/* each: what the next level changes; NULL: not compared by mode */
static fw_status set_errors(const fw_statics_equilibrium *w, const double *each,
                            fw_statics_modes *modes) {
    const fw_mechanism *m = w->mechanism;
    const double level = m->nhinge > 0 ? modes->ledger.hinge.error : 0;
    const bool pins = modes->ledger.hinge.used == FW_HINGE_REVOLUTE;
    double first = 0;
    for (int k = modes->count - 1; k >= 0; k--) {
        fw_statics_mode *mode = &modes->mode[k];
        const double whole = mode->stiffness_per_s2 * mode->modal_mass_kg_m2;
        double *energy;
        FW_TRY(fw_statics_hinge_energies(w, modes->q, mode->shape, &energy));
        mode->stiffness_error =
            fw_statics_shape_error(m, modes->q, mode->shape, pins, whole, energy);
        mode->model_error = each && m->nhinge > 0 ? each[k] * (1 + each[k]) : level;
        if (mode->kind == FW_MODE_OSCILLATION) first = mode->stiffness_error;
    }
    for (int k = 0; k < m->nhinge; k++) /* any of the slow ones may live in one alone */
        if (!m->hinge[k].stated) first = fmax(first, m->hinge[k].closed_form.error.stiffness);
    modes->stiffness_error = first;
    modes->frequency_error = fw_statics_root_error(first) + level;
    return FW_OK;
}

static fw_status modes_at(fw_arena *arena, const fw_mechanism *mechanism,
                          const fw_device_scene *scene, const fw_statics_mode_options *options,
                          const fw_effect_choice *choice, fw_diags *diags,
                          fw_statics_equilibrium *w, const fw_statics_modes **found) {
    FW_TRY(fw_statics_equilibrium_new(arena, mechanism, scene, choice, FW_STATICS_DENSE, diags, w));
    return fw_statics_equilibrium_modes(w, options, found);
}

/* softer (count x count), by modes that may have been turned round to be shown; or NULL */
static double *as_shapes_are(const fw_statics_reduced *r, const fw_statics_modes *modes,
                             double *softer) {
    const size_t n = (size_t)modes->count;
    for (size_t k = 0; softer && k < n; k++) {
        double same = 0;
        for (size_t i = 0; i < (size_t)r->n; i++)
            same += r->shape[k * (size_t)r->n + i] * modes->mode[k].shape[i];
        for (size_t j = 0; same < 0 && j < n; j++)
            softer[k * n + j] *= -1, softer[j * n + k] *= -1;
    }
    return softer;
}

/* What closed forms say along and across a flexure is within a percent of its beam where it is its own mirror image */
static const double fw_mirrored = 0.01;

/* Of frequencies; where those that what hinges give adds, or the root of a stiffness, may change by more than the
   accuracy and than symmetric flexures do, of these */
static double changes(const fw_statics_level_small *next, double accuracy) {
    const double any = 0.5 * next->apart;
    return any >= fmax(accuracy, fw_mirrored) && any > next->relative ? any : next->relative;
}

static const char of_any[] = "a frequency, or half of a stiffness";

/* exact beams were wanted, and have no equilibrium here */
static fw_status stay(fw_arena *arena, const fw_statics_level_step *step,
                      const fw_statics_modes **modes) {
    fw_statics_modes *own = fw_arena_one(arena, fw_statics_modes);
    FW_NEED(own);
    *own = **modes;
    *modes = own;
    return fw_statics_level_stays(arena, step, "small motions could not be found with it",
                                  &own->ledger.hinge);
}

fw_status fw_statics_small_motions(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_device_scene *scene,
                                   const fw_statics_mode_options *options, fw_diags *diags,
                                   const fw_statics_modes **modes) {
    fw_effect_choice choice = options->effects;
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    double stated = fw_statics_level_stated * accuracy;
    fw_statics_level_step step;
    bool tried;
    FW_TRY(fw_statics_level_pins_first(arena, mechanism, scene, &choice, &tried));
    *modes = NULL;
    if (tried) choice.hinge = FW_HINGE_REVOLUTE, choice.pins_first = true;
    for (;;) {
        fw_statics_equilibrium w;
        fw_statics_level_small next = {.relative = (double)NAN};
        const fw_statics_modes *found;
        fw_diags own = fw_diags_new(arena);
        fw_status status = modes_at(arena, mechanism, scene, options, &choice,
                                    tried || *modes ? &own : diags, &w, &found);
        if (status == FW_OK) status = fw_statics_level_of_modes(&w, &next);
        const double relative = changes(&next, accuracy);
        bool pins_do = status == FW_OK && relative < stated;
        if (tried && !pins_do && (status == FW_OK || status == FW_SOLVER || status == FW_INPUT)) {
            choice = options->effects, tried = false; /* as if they had not been tried */
            continue;
        }
        if (*modes && status == FW_SOLVER) return stay(arena, &step, modes);
        FW_TRY(status);
        if (tried) accuracy = stated;
        if (tried || *modes) fw_diags_take(diags, &own);
        step = (fw_statics_level_step){.used = found->ledger.hinge.used,
                                       .next = found->ledger.hinge.used + 1,
                                       .relative = relative,
                                       .why_not = isnan(relative) ? "not computed" : NULL};
        fw_statics_modes *to;
        FW_NEED(to = fw_arena_one(arena, fw_statics_modes));
        *to = *found, *modes = to;
        FW_TRY(fw_statics_level_note(arena, &step, accuracy, &options->effects, &to->ledger.hinge));
        to->softer = as_shapes_are(&w.reduced, found, next.softer);
        FW_TRY(set_errors(&w, next.each, to));
        FW_TRY(fw_statics_films_raise(arena, mechanism, scene, diags, to));
        if (!fw_statics_level_climb(&step, accuracy, &options->effects, &choice)) return FW_OK;
        choice.below_of = of_any;
    }
}
