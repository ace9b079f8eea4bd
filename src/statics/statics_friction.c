/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where dry friction may hold a mechanism: around the equilibrium u without it

     |u' - u| <= sum_j |S_j| T_j,   S_j = sum_k phi_k (phi_k . h_j)/mu_k,   h_j = d x_j/du
     T = m r (preload + N),         N_i <= N0_i + sum_j G_ij T_j

   of every coordinate, first order in T. x_j: angle of a pin or travel of a slide that rubs; phi_k, mu_k: modes of the
   reduced stiffness (mass-orthonormal); m: the larger of the coefficients at rest and in motion; N0: what presses there
   without friction; G_ij: what the torque of j changes of the force on i, by a difference of 1e-3 of T_j. All signs are
   possible at rest, since each depends on the way there, so that the sum is what can be and not only a bound of it.

   Inputs: an evaluated stable equilibrium, scaled units. Outputs: m, rad. Valid to first order: test_statics.c compares
   with motions that come to rest from either side. Not where a contact presses (its force is another question), or the
   stiffness vanishes. Where friction makes what presses grow faster than itself (spectral radius of m r G at 1) it holds
   anywhere. Cost: one evaluation for each joint that rubs. Source: docs/theory/effects/friction.md.

   Cables that rub on eyelets: each segment may pull by the share c of the tension T more or less, x_j its length, and
   |S_j| T c_j adds up likewise (docs/theory/effects/eyelet-friction.md). Test: tests/cli/test_effects.py */
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

typedef struct rub {
    fw_statics_equilibrium *w;
    const fw_effects_friction *item;
    int count;
    double *row;      /* (count x n) h */
    double *give;     /* (count x n) S */
    double *arm;      /* (count) m r, SI */
    double *press_N;  /* (count) N0 */
    double *gain;     /* (count x count) G, N per torque unit in SI */
    double *force[3]; /* pins (2 npin), joints (3 njoint), drivers */
    double *before;   /* (2 count) force on each at the equilibrium, N */
} rub;

static int body_row(const fw_statics_equilibrium *w, int body) {
    return body == FW_GROUND || body >= w->model->nbody ? FW_NONE : 3 * body;
}

static void turn_row(const rub *r, const fw_effects_friction *f, double *h) {
    const fw_mechanism_pin *p = &r->w->mechanism->pin[f->pin];
    int a = body_row(r->w, p->body_a), b = body_row(r->w, p->body_b);
    if (a != FW_NONE) h[a + 2] -= 1;
    if (b != FW_NONE) h[b + 2] += 1;
}

/* travel along the axis e of body a, from its point to that of b: d = p_b - p_a turns with a */
static void slide_row(const rub *r, const fw_effects_friction *f, const fw_multibody_pose *pose,
                      double *h) {
    const fw_statics_equilibrium *w = r->w;
    const fw_device_joint *t = &w->mechanism->joint[f->joint];
    int block = w->model->joint_block[f->joint], a = body_row(w, t->body_a),
        b = body_row(w, t->body_b);
    const double *ra = pose->arm + 4 * block, *rb = ra + 2;
    double d[2], e[2], n[2];
    fw_multibody_frame(w->model, pose, block, d, e, n);
    if (a != FW_NONE) {
        h[a] -= e[0], h[a + 1] -= e[1];
        h[a + 2] += -(e[1] * ra[0] - e[0] * ra[1]) + n[0] * d[0] + n[1] * d[1];
    }
    if (b != FW_NONE) h[b] += e[0], h[b + 1] += e[1], h[b + 2] += e[1] * rb[0] - e[0] * rb[1];
}

/* by how much the mechanism gives way to a push of 1 along a row h (n): +=; a large one by the system that is factored */
static void give_way(const fw_statics_reduced *d, const double *h, double *give) {
    const size_t n = (size_t)d->n;
    if (d->sparse) {
        double *x = d->sparse->y + n + d->rows;
        for (size_t i = 0; i < n; i++)
            x[i] = h[i] * d->root[i] / d->sparse->unit;
        fw_statics_sparse_solve(d, x);
        for (size_t i = 0; i < n; i++)
            give[i] += x[i] * d->root[i];
        return;
    }
    for (size_t k = 0; k < (size_t)d->dof; k++) {
        double along = 0;
        for (size_t i = 0; i < n; i++)
            along += d->shape[k * n + i] * h[i];
        for (size_t i = 0; i < n; i++)
            give[i] += d->shape[k * n + i] * along / d->value[k];
    }
}

static void rows_and_gives(rub *r) {
    const fw_statics_equilibrium *w = r->w;
    const fw_statics_reduced *d = &w->reduced;
    const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
    size_t n = (size_t)d->n;
    for (int j = 0; j < r->count; j++) {
        double *h = r->row + (size_t)j * n, *s = r->give + (size_t)j * n;
        if (r->item[j].pin == FW_NONE)
            slide_row(r, &r->item[j], pose, h);
        else
            turn_row(r, &r->item[j], h);
        give_way(d, h, s);
    }
}

/* the force on each joint that rubs, N: (2 count) */
static void forces(rub *r, double *out) {
    fw_statics_equilibrium_reactions(r->w, r->force[0], r->force[1], r->force[2]);
    for (int i = 0; i < r->count; i++) {
        const fw_effects_friction *f = &r->item[i];
        const double *from =
            f->pin == FW_NONE ? r->force[1] + 3 * f->joint : r->force[0] + 2 * f->pin;
        out[2 * i] = from[0], out[2 * i + 1] = from[1];
    }
}

/* SI per scaled unit of what pushes along coordinate j */
static double unit(const rub *r, int j) {
    const fw_multibody_model *m = r->w->model;
    return fw_multibody_newton(m) * (r->item[j].pin == FW_NONE ? 1 : m->scale.length_m);
}

/* column j of the gains, at the pose that a thousandth of its torque leads to */
static fw_status gains_of(rub *r, int j, const double *u, double *work) {
    fw_statics_equilibrium *w = r->w;
    size_t n = (size_t)w->model->nq;
    double *after = work + n, torque = 1e-3 * r->arm[j] * r->press_N[j];
    if (!(torque > 0)) return FW_OK;
    for (size_t i = 0; i < n; i++)
        w->y[i] = u[i] + r->give[(size_t)j * n + i] * torque / unit(r, j);
    FW_TRY(fw_statics_equilibrium_evaluate(w));
    for (size_t i = 0; i < n; i++)
        work[i] = w->force[i] + r->row[(size_t)j * n + i] * torque / unit(r, j);
    fw_statics_reduced_multipliers(w->model, &w->reduced, work, w->lambda);
    forces(r, after);
    for (int i = 0; i < r->count; i++)
        r->gain[i * r->count + j] =
            hypot(after[2 * i] - r->before[2 * i], after[2 * i + 1] - r->before[2 * i + 1]) /
            torque;
    return FW_OK;
}

/* (1 - m r G) T = m r (preload + N0) by iteration from below; false: it grows without end */
static bool torques(const rub *r, double *limit) {
    enum { TURNS = 400 };
    for (int turn = 0; turn < TURNS; turn++) {
        double change = 0, largest = 0;
        for (int i = 0; i < r->count; i++) {
            double press = r->press_N[i];
            for (int j = 0; j < r->count; j++)
                press += r->gain[i * r->count + j] * limit[j];
            double next = r->arm[i] * press;
            change = fmax(change, fabs(next - limit[i]));
            largest = fmax(largest, next);
            limit[i] = next;
        }
        if (!isfinite(largest)) return false;
        if (change <= 1e-9 * largest) return true;
    }
    return false;
}

static fw_status find(rub *r, fw_statics_friction_range *out) {
    fw_statics_equilibrium *w = r->w;
    size_t n = (size_t)w->model->nq, count = (size_t)r->count;
    double *u, *work;
    FW_NEED(u = fw_arena_array(w->arena, double, n));
    FW_NEED(work = fw_arena_array(w->arena, double, n + 2 * count));
    memcpy(u, w->y, n * sizeof *u);
    rows_and_gives(r);
    forces(r, r->before);
    for (size_t i = 0; i < count; i++) {
        const fw_effects_friction *f = &r->item[i];
        r->arm[i] = fmax(f->static_coefficient, f->kinetic_coefficient) *
                    (f->pin == FW_NONE ? 1 : f->radius_m);
        r->press_N[i] = f->preload_N + hypot(r->before[2 * i], r->before[2 * i + 1]);
    }
    fw_status status = FW_OK;
    for (int j = 0; j < r->count && status == FW_OK; j++)
        status = gains_of(r, j, u, work);
    memcpy(w->y, u, n * sizeof *u);
    if (status == FW_SOLVER) out->why = "the joints do not close where friction would hold it";
    if (status != FW_OK && status != FW_SOLVER) return status;
    FW_TRY(fw_statics_equilibrium_evaluate(w));
    if (out->why) return FW_OK;
    if (!torques(r, out->limit)) {
        out->why = "what presses grows with the friction faster than this: it holds anywhere";
        return FW_OK;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < count; j++)
            out->q[i] += fabs(r->give[j * n + i]) * out->limit[j] / unit(r, (int)j) *
                         (i % 3 == 2 ? 1 : w->model->scale.length_m);
    for (int k = 0; k < w->mechanism->npin; k++) {
        const fw_mechanism_pin *p = &w->mechanism->pin[k];
        int a = body_row(w, p->body_a), b = body_row(w, p->body_b);
        for (size_t j = 0; j < count; j++) {
            const double *s = r->give + j * n;
            double turn = (b == FW_NONE ? 0 : s[b + 2]) - (a == FW_NONE ? 0 : s[a + 2]);
            out->angle_rad[k] += fabs(turn) * out->limit[j] / unit(r, (int)j);
        }
    }
    return FW_OK;
}

static fw_status room(rub *r, fw_statics_friction_range *out) {
    fw_statics_equilibrium *w = r->w;
    const fw_mechanism *m = w->mechanism;
    size_t n = (size_t)w->model->nq, count = (size_t)r->count;
    FW_NEED(r->row = fw_arena_array(w->arena, double, count *n));
    FW_NEED(r->give = fw_arena_array(w->arena, double, count *n));
    FW_NEED(r->arm = fw_arena_array(w->arena, double, count));
    FW_NEED(r->press_N = fw_arena_array(w->arena, double, count));
    FW_NEED(r->gain = fw_arena_array(w->arena, double, count *count));
    FW_NEED(r->before = fw_arena_array(w->arena, double, 2 * count));
    FW_NEED(r->force[0] = fw_arena_array(w->arena, double, 2 * (size_t)m->npin));
    FW_NEED(r->force[1] = fw_arena_array(w->arena, double, 3 * (size_t)m->njoint));
    FW_NEED(r->force[2] = fw_arena_array(w->arena, double, (size_t)m->ndriver));
    FW_NEED(out->q = fw_arena_array(w->arena, double, n));
    FW_NEED(out->angle_rad = fw_arena_array(w->arena, double, (size_t)m->npin));
    FW_NEED(out->limit = fw_arena_array(w->arena, double, count));
    FW_NEED(out->joint = fw_arena_array(w->arena, const char *, count));
    FW_NEED(out->slides = fw_arena_array(w->arena, bool, count));
    for (size_t i = 0; i < count; i++) {
        out->joint[i] = fw_text_name(r->item[i].id);
        out->slides[i] = r->item[i].pin == FW_NONE;
    }
    return FW_OK;
}

/* ---- cables on eyelets ---- */

/* as far as the poses and angles go by a push of 1 N along a row h (n) times `most` N: += */
static void go_by(const fw_statics_equilibrium *w, const double *h, double most_N, double *give,
                  fw_statics_friction_range *out) {
    const fw_statics_reduced *d = &w->reduced;
    const size_t n = (size_t)d->n;
    const double by = most_N / fw_multibody_newton(w->model);
    memset(give, 0, n * sizeof *give);
    give_way(d, h, give);
    for (size_t i = 0; i < n; i++)
        out->q[i] += fabs(give[i]) * by * (i % 3 == 2 ? 1 : w->model->scale.length_m);
    for (int k = 0; k < w->mechanism->npin; k++) {
        const fw_mechanism_pin *p = &w->mechanism->pin[k];
        const int a = body_row(w, p->body_a), b = body_row(w, p->body_b);
        out->angle_rad[k] +=
            by * fabs((b == FW_NONE ? 0 : give[b + 2]) - (a == FW_NONE ? 0 : give[a + 2]));
    }
}

typedef struct cable {
    double *p, *v, *f, *share, *force, *h, *give;
    bool *on;
} cable;

static fw_status cable_room(const fw_statics_equilibrium *w, int ports, cable *c) {
    const size_t n = 3 * (size_t)ports, bodies = 3 * (size_t)w->mechanism->nbody;
    double **of[] = {&c->p, &c->v, &c->f, &c->share};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(w->arena, double, n));
    FW_NEED(c->force = fw_arena_array(w->arena, double, bodies));
    FW_NEED(c->h = fw_arena_array(w->arena, double, bodies));
    FW_NEED(c->give = fw_arena_array(w->arena, double, bodies));
    FW_NEED(c->on = fw_arena_array(w->arena, bool, 1));
    return FW_OK;
}

/* the tension behind the last eyelet pulls at nothing but that */
static double tension_of(const fw_statics_equilibrium *w, const fw_effects_force_element *e,
                         const cable *c) {
    const double end = w->scene->duration_s;
    const fw_effects_port_state s = {
        .t_s = end, .piece_s = end, .load = 1, .p = c->p, .w = c->v, .on = c->on, .still = true};
    if (e->switches > 0) c->on[0] = e->class_->switch_value(e, &s, 0) > 0;
    e->class_->force(e, &s, c->f);
    return hypot(c->f[3 * (e->ports - 1)], c->f[3 * (e->ports - 1) + 1]);
}

static fw_status cables(const fw_statics_equilibrium *w, fw_statics_friction_range *out) {
    const double coefficient = fw_effects_eyelet_friction_of(w->scene);
    double *q, *angle;
    int tendon = 0;
    FW_NEED(q = fw_arena_array(w->arena, double, (size_t)w->model->nq));
    FW_NEED(angle = fw_arena_array(w->arena, double, (size_t)w->mechanism->npin));
    fw_statics_equilibrium_pose(w, w->y, q, angle);
    for (int i = 0; i < w->loads->nelement; i++) {
        const fw_effects_force_element *e = &w->loads->element[i];
        cable c;
        if (strcmp(e->class_->effect, "tendon") != 0) continue;
        const bool kept = !isnan(w->scene->tendon[tendon++].pull_N);
        FW_TRY(cable_room(w, e->ports, &c));
        fw_effects_element_place_ports(e, q, NULL, c.p, c.v);
        fw_effects_eyelet_friction_shares(c.p, e->ports, coefficient, kept, c.share);
        const double tension = tension_of(w, e, &c);
        for (int k = 0; k + 1 < e->ports; k++) {
            const double *a = c.p + 3 * k, x = a[3] - a[0], y = a[4] - a[1], far = hypot(x, y);
            if (!(far > 0)) continue;
            memset(c.f, 0, 3 * (size_t)e->ports * sizeof *c.f);
            memset(c.force, 0, 3 * (size_t)w->mechanism->nbody * sizeof *c.force);
            c.f[3 * k] = -x / far, c.f[3 * k + 1] = -y / far;
            c.f[3 * k + 3] = x / far, c.f[3 * k + 4] = y / far;
            fw_effects_element_add_forces(e, q, c.f, c.force);
            for (int j = 0; j < w->model->nq; j++)
                c.h[j] = c.force[j] / (j % 3 == 2 ? w->model->scale.length_m : 1);
            go_by(w, c.h, c.share[k] * tension, c.give, out);
        }
    }
    return FW_OK;
}

/* gains of each on each, and an evaluation for each */
enum { FW_FRICTION_MOST = 500 };

/* K as it is: what gives way is asked of it */
static fw_status factor_again(fw_statics_equilibrium *w) {
    int negative;
    return fw_statics_sparse_factor(&w->reduced, 0, &negative);
}

fw_status fw_statics_equilibrium_friction(fw_statics_equilibrium *w,
                                          const fw_statics_friction_range **range) {
    const fw_effects_loads *loads = w->loads;
    fw_statics_friction_range *out;
    *range = NULL;
    const bool rubs = loads && w->scene && fw_effects_eyelet_friction_of(w->scene) > 0;
    if (!loads || (loads->nfriction == 0 && !rubs)) return FW_OK;
    rub r = {.w = w, .item = loads->friction, .count = loads->nfriction};
    FW_NEED(out = fw_arena_one(w->arena, fw_statics_friction_range));
    out->count = r.count <= FW_FRICTION_MOST ? r.count : 0;
    if (w->sparse) FW_TRY(factor_again(w));
    if (r.count <= FW_FRICTION_MOST) FW_TRY(room(&r, out));
    for (int i = 0; i < r.count; i++)
        if (r.item[i].element != FW_NONE)
            out->why = "a contact presses on what rubs, with a force that this does not follow";
    if (r.count > FW_FRICTION_MOST) out->why = "more joints rub than are followed";
    for (int k = 0; k < w->reduced.modes; k++)
        if (!(w->reduced.value[k] > w->reduced.zero[k]))
            out->why = "nothing but friction holds it: it may rest anywhere nearby";
    if (!out->why && r.count > 0) FW_TRY(find(&r, out));
    if (!out->why && rubs && w->sparse) FW_TRY(factor_again(w));
    if (!out->why && rubs) FW_TRY(cables(w, out));
    *range = out;
    return FW_OK;
}
