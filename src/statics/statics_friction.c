/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where dry friction may hold a mechanism: extreme equilibria, with the friction of every joint and eyelet at the share
   sigma_j s of what it can be at most, there,

     Q(u) + sum_j h_j(u) T_j + F(u) = G^T lambda,   T_j = s sigma_j m_j r_j (preload_j + |N_j(u, lambda)|)
     tensions  T_i = T exp(s sum_(k > i) sigma_k mu beta_k(u)), their mean kept where the cable is drawn

   followed from s = 0 to 1 for the signs sigma = +-1 that all push a coordinate the same way; from the end along every edge,
   sigma_j to its opposite, and from any sigma on such an edge that takes a coordinate farther again, until none does. All
   that is passed is an equilibrium, so that nothing beyond the truth is told. Where that takes too many evaluations, the sum of
   what every friction does by itself, to first order of the pose, sum_j |du/dT_j| T_j, is told, and so called.

   u: pose; Q: forces; h_j: gradient of the angle or travel that rubs; m: the larger of the coefficients at rest and in
   motion; r: radius, 1 of a slide; N: what presses; T, beta: tension, bends. Inputs: an evaluated stable equilibrium,
   scaled. Outputs: offsets, m and rad. Valid where the ways do not end before all of the friction acts, else it is told
   that nothing is known; not where a contact presses on what rubs. Error: an extreme that no edge leads to, 1e-9 of the width
   at most in 56 random devices. Cost: some 5 evaluations for every step, 16 steps for every way and edge. Source: Coulomb; Euler;
   implicit function theorem. Test: tests/cli/test_friction_range.py, test_static_friction.c */
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

typedef struct rub {
    fw_statics_equilibrium *w;
    const fw_effects_friction *item;
    int count;
    double *row;      /* (count x n) h */
    double *arm;      /* (count) m r, SI */
    double *force[3]; /* pins (2 npin), joints (3 njoint), drivers */
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

static fw_status room(rub *r, fw_statics_friction_range *out) {
    fw_statics_equilibrium *w = r->w;
    const fw_mechanism *m = w->mechanism;
    size_t n = (size_t)w->model->nq, count = (size_t)r->count;
    FW_NEED(r->row = fw_arena_array(w->arena, double, count *n));
    FW_NEED(r->arm = fw_arena_array(w->arena, double, count));
    FW_NEED(r->force[0] = fw_arena_array(w->arena, double, 2 * (size_t)m->npin));
    FW_NEED(r->force[1] = fw_arena_array(w->arena, double, 3 * (size_t)m->njoint));
    FW_NEED(r->force[2] = fw_arena_array(w->arena, double, (size_t)m->ndriver));
    FW_NEED(out->q = fw_arena_array(w->arena, double, n));
    FW_NEED(out->angle_rad = fw_arena_array(w->arena, double, (size_t)m->npin));
    FW_NEED(out->from_q = fw_arena_array(w->arena, double, n));
    FW_NEED(out->to_q = fw_arena_array(w->arena, double, n));
    FW_NEED(out->from_angle_rad = fw_arena_array(w->arena, double, (size_t)m->npin));
    FW_NEED(out->to_angle_rad = fw_arena_array(w->arena, double, (size_t)m->npin));
    FW_NEED(out->limit = fw_arena_array(w->arena, double, count));
    FW_NEED(out->joint = fw_arena_array(w->arena, const char *, count));
    FW_NEED(out->slides = fw_arena_array(w->arena, bool, count));
    for (size_t i = 0; i < count; i++) {
        out->joint[i] = fw_text_name(r->item[i].id);
        out->slides[i] = r->item[i].pin == FW_NONE;
        if (!out->slides[i]) turn_row(r, &r->item[i], r->row + i * n);
        r->arm[i] = fmax(r->item[i].static_coefficient, r->item[i].kinetic_coefficient) *
                    (out->slides[i] ? 1 : r->item[i].radius_m);
    }
    return FW_OK;
}

/* ---- cables on eyelets ---- */

typedef struct cable {
    const fw_effects_force_element *element;
    bool kept; /* the tension behind the last eyelet, by the actuator; else the mean */
    int first; /* its first eyelet that rubs, among all that may */
    double *p, *v, *f, *share, *force;
    double *bends; /* (segments) mu times all bends behind */
    bool *on;
} cable;

static fw_status cable_room(const fw_statics_equilibrium *w, int ports, cable *c) {
    const size_t n = 3 * (size_t)ports, bodies = 3 * (size_t)w->mechanism->nbody;
    double **of[] = {&c->p, &c->v, &c->f, &c->share, &c->bends};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(w->arena, double, n));
    FW_NEED(c->force = fw_arena_array(w->arena, double, bodies));
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

/* K as it is: what gives way is asked of it */
static fw_status factor_again(fw_statics_equilibrium *w) {
    int negative;
    return fw_statics_sparse_factor(&w->reduced, 0, &negative);
}

/* ---- following all of it ---- */

typedef struct farther {
    int control; /* whose share took a coordinate farther, or FW_NONE */
    double share, by;
} farther;

typedef struct edge {
    rub *r;
    fw_statics_friction_range *out;
    cable *rope;
    int ropes, controls, coordinates; /* joints, then eyelets; poses, then angles of pins */
    double mu;
    double *base, *q, *all;        /* (n) without friction; (n) (n) work */
    double *sign, *torque, *after; /* (controls) (count) scaled, (2 count) */
    double *push, *last, *step;    /* (n) (n) (FW_FRICTION_TURNS x n) */
    double *seen[3], s[3];         /* coordinates at the last three steps, oldest first */
    int steps;
    double *at, *low, *high; /* (coordinates) without friction, least and largest */
    farther *farther[2];     /* (coordinates) which step along which edge made them so */
    int along;               /* the edge, or FW_NONE */
    double *first;           /* (coordinates) to first order, either way */
    double *try;             /* (FW_FRICTION_SIGNS x controls) */
    int tries, now;
    long left; /* evaluations */
    bool spent, grows;
} edge;

enum { FW_FRICTION_SIGNS = 256, FW_FRICTION_STEPS = 16, FW_FRICTION_TURNS = 40 };
/* beyond what was found, relative; and what is worth following further */
static const double fw_friction_margin = 1e-6, fw_friction_worth = 5e-4;

/* what the friction of a cable changes of the forces, at the pose q: push += */
static void rope_pull(const edge *e, const cable *c, double s) {
    const fw_statics_equilibrium *w = e->r->w;
    const fw_effects_force_element *t = c->element;
    const int segments = t->ports - 1;
    const double newton = fw_multibody_newton(w->model);
    double at = 0, length = 0, weighed = 0;
    fw_effects_element_place_ports(t, e->q, NULL, c->p, c->v);
    fw_effects_eyelet_friction_shares(c->p, t->ports, e->mu, true, c->share);
    const double tension = tension_of(w, t, c);
    for (int i = segments - 1; i >= 0; i--) { /* shares become what tensions are multiplied by */
        c->bends[i] = log1p(c->share[i]);
        if (i + 1 < segments) at += s * e->sign[c->first + i] * (c->bends[i] - c->bends[i + 1]);
        const double far = hypot(c->p[3 * i + 3] - c->p[3 * i], c->p[3 * i + 4] - c->p[3 * i + 1]);
        c->share[i] = exp(at), length += far, weighed += far * c->share[i];
    }
    memset(c->f, 0, 3 * (size_t)t->ports * sizeof *c->f);
    memset(c->force, 0, 3 * (size_t)w->mechanism->nbody * sizeof *c->force);
    for (int i = 0; i < segments; i++) {
        const double *a = c->p + 3 * i, x = a[3] - a[0], y = a[4] - a[1], far = hypot(x, y);
        const double more = tension * (c->share[i] * (c->kept ? 1 : length / weighed) - 1);
        if (!(far > 0)) continue;
        c->f[3 * i] += more * x / far, c->f[3 * i + 1] += more * y / far;
        c->f[3 * i + 3] -= more * x / far, c->f[3 * i + 4] -= more * y / far;
    }
    fw_effects_element_add_forces(t, e->q, c->f, c->force);
    for (int j = 0; j < w->model->nq; j++)
        e->push[j] += c->force[j] / newton / (j % 3 == 2 ? w->model->scale.length_m : 1);
}

/* the torques that belong to what they press themselves, at an evaluated pose; `all`: Q with them. false: they grow without end */
static bool torques_here(edge *e, double s) {
    const rub *r = e->r;
    fw_statics_equilibrium *w = r->w;
    const size_t n = (size_t)w->model->nq;
    const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
    enum { TURNS = 200 };
    for (int j = 0; j < r->count; j++) {
        double *h = r->row + (size_t)j * n;
        if (r->item[j].pin != FW_NONE) continue;
        memset(h, 0, n * sizeof *h);
        slide_row(r, &r->item[j], pose, h);
    }
    fw_statics_equilibrium_pose(w, w->y, e->q, NULL);
    memcpy(e->push, w->force, n * sizeof *e->push);
    for (int i = 0; i < e->ropes; i++)
        rope_pull(e, &e->rope[i], s);
    for (int turn = 0; turn < TURNS; turn++) {
        double change = 0, largest = 0;
        memcpy(e->all, e->push, n * sizeof *e->all);
        for (size_t j = 0; j < (size_t)r->count; j++)
            for (size_t i = 0; i < n; i++)
                e->all[i] += r->row[j * n + i] * e->torque[j];
        if (r->count == 0) return true;
        fw_statics_reduced_multipliers(w->model, &w->reduced, e->all, w->lambda);
        forces(e->r, e->after);
        for (int j = 0; j < r->count; j++) {
            const double press = r->item[j].preload_N + hypot(e->after[2 * j], e->after[2 * j + 1]);
            const double next = s * e->sign[j] * r->arm[j] * press / unit(r, j);
            change = fmax(change, fabs(next - e->torque[j]));
            largest = fmax(largest, fabs(next));
            e->torque[j] = next;
        }
        if (!isfinite(largest)) return false;
        if (change <= 1e-13 * largest) return true;
    }
    return false;
}

/* K^-1 of what is not balanced with the share s of the friction: step (n) += ; false: nothing is there */
static bool newton_step(edge *e, double s, double *step) {
    fw_statics_equilibrium *w = e->r->w;
    e->spent = e->spent || e->left-- <= 0;
    if (e->spent || fw_statics_equilibrium_evaluate(w) != FW_OK) return false;
    if (w->sparse && factor_again(w) != FW_OK) return false;
    if (!torques_here(e, s)) return false;
    if (!w->sparse) { /* forces of joints that friction changes bend the stiffness */
        const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
        fw_statics_tangent(w->system, pose, w->y + w->model->nq, w->lambda, w->stiffness, NULL);
        if (fw_statics_reduced_spectrum(&w->reduced, w->stiffness) != FW_OK) return false;
    }
    for (int k = 0; !w->sparse && k < w->reduced.dof; k++)
        if (!(fabs(w->reduced.value[k]) > w->reduced.zero[k])) return false;
    give_way(&w->reduced, e->all, step);
    return true;
}

static double inner(const double *a, const double *b, size_t n) {
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static double largest_of(const double *a, size_t n) {
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(a[i]));
    return isfinite(inner(a, a, n)) ? most : (double)INFINITY;
}

/* From w->y to the equilibrium with the share s of the friction. Newton's steps do not know what torques change with the
   pose, which may be more than the stiffness: Broyden's rule learns it from the steps made. Source: C. T. Kelley, Iterative
   Methods for Linear and Nonlinear Equations 1995, ch. 7.3. false: none was found from there */
static bool rest_with(edge *e, double s) {
    fw_statics_equilibrium *w = e->r->w;
    const size_t n = (size_t)w->model->nq;
    for (int turn = 0; turn < FW_FRICTION_TURNS; turn++) {
        double *next = e->step + (size_t)turn * n;
        memset(next, 0, n * sizeof *next);
        if (!newton_step(e, s, next)) return false;
        const double most = largest_of(next, n);
        for (int k = 0; k < turn; k++) {
            const double *made = e->step + (size_t)k * n;
            const double share = inner(made, next, n) / inner(made, made, n);
            const double by = k + 1 < turn ? share : share / (1 - share);
            const double *after = k + 1 < turn ? made + n : next;
            for (size_t i = 0; i < n; i++)
                next[i] += by * after[i];
        }
        if (!(largest_of(next, n) < 0.5)) return false;
        for (size_t i = 0; i < n; i++)
            w->y[i] += next[i];
        if (most < 1e-10) return true;
    }
    return false;
}

static void take(edge *e, int c, double value, double share) {
    const double width = e->high[c] - e->low[c];
    for (int side = 0; side < 2; side++) {
        double *most = side ? &e->high[c] : &e->low[c];
        const double more = side ? value - *most : *most - value;
        if (!(more > 0)) continue;
        farther *f = &e->farther[side][c];
        *most = value;
        *f = (farther){.control = e->along,
                       .share = share,
                       .by = (f->control == e->along ? f->by : 0) + more / (width + more)};
    }
}

/* coordinates of w->y; where a parabola through the last three has its peak between them, that too */
static void see(edge *e, double s) {
    const fw_statics_equilibrium *w = e->r->w;
    double *oldest = e->seen[0];
    e->seen[0] = e->seen[1], e->seen[1] = e->seen[2], e->seen[2] = oldest;
    e->s[0] = e->s[1], e->s[1] = e->s[2], e->s[2] = s;
    fw_statics_equilibrium_pose(w, w->y, oldest, oldest + w->model->nq);
    e->steps++;
    for (int c = 0; c < e->coordinates; c++) {
        const double v = e->seen[2][c], a = e->s[1] - e->s[0], b = e->s[2] - e->s[1];
        take(e, c, v, s);
        if (e->steps < 3) continue;
        const double first = (e->seen[1][c] - e->seen[0][c]) / a, second = (v - e->seen[1][c]) / b,
                     bent = (second - first) / (a + b);
        const double peak = 0.5 * (e->s[0] + e->s[1] - first / bent);
        if ((peak - e->s[0]) * (peak - s) < 0)
            take(e, c, e->seen[0][c] + (peak - e->s[0]) * (first + bent * (peak - e->s[1])), peak);
    }
}

/* With the signs set from no friction to all of it; or, along an edge, with control j from its share to the opposite one */
static bool carry(edge *e, int j) {
    fw_statics_equilibrium *w = e->r->w;
    const size_t n = (size_t)w->model->nq;
    const double own = j == FW_NONE ? 0 : e->sign[j], end = own < 0 ? 1 : -1;
    double t = 0, by = 1.0 / FW_FRICTION_STEPS, done = 0;
    double *from = e->out->from_q; /* not written yet: room for where a step begins */
    e->steps = 0, e->along = j;
    see(e, j == FW_NONE ? 0 : own);
    while (t < 1) {
        const double to = fmin(1, t + by), share = own + to * (end - own);
        memcpy(from, w->y, n * sizeof *from);
        for (size_t i = 0; i < n && done > 0; i++)
            w->y[i] += e->last[i] * (to - t) / done;
        if (j != FW_NONE) e->sign[j] = share;
        if (rest_with(e, j == FW_NONE ? to : 1)) {
            for (size_t i = 0; i < n; i++)
                e->last[i] = w->y[i] - from[i];
            done = to - t, t = to;
            see(e, j == FW_NONE ? t : share);
            continue;
        }
        memcpy(w->y, from, n * sizeof *from);
        memset(e->torque, 0, (size_t)e->r->count * sizeof *e->torque);
        by /= 2;
        if (e->spent || by < 1.0 / 1024) return false;
    }
    for (int k = 0; k < e->r->count; k++)
        e->out->limit[k] = fmax(e->out->limit[k], fabs(e->torque[k]) * unit(e->r, k));
    return true;
}

static void propose(edge *e, const double *sign) {
    const size_t n = (size_t)e->controls;
    for (int i = 0; i < e->tries; i++)
        if (memcmp(e->try + (size_t)i * n, sign, n * sizeof *sign) == 0) return;
    if (e->tries == FW_FRICTION_SIGNS) {
        e->spent = true;
        return;
    }
    memcpy(e->try + (size_t)e->tries++ * n, sign, n * sizeof *sign);
}

/* what control j by itself does to every coordinate, to first order of the pose: way (coordinates) */
static void alone(edge *e, int j, double *way) {
    fw_statics_equilibrium *w = e->r->w;
    const size_t n = (size_t)w->model->nq;
    double *q = e->seen[2];
    memset(e->sign, 0, (size_t)e->controls * sizeof *e->sign);
    memset(e->torque, 0, (size_t)e->r->count * sizeof *e->torque);
    memset(e->step, 0, n * sizeof *e->step);
    e->sign[j] = 1;
    if (!torques_here(e, 1))
        e->grows = true;
    else
        give_way(&w->reduced, e->all, e->step);
    if (j < e->r->count) e->out->limit[j] = fabs(e->torque[j]) * unit(e->r, j);
    for (size_t i = 0; i < n; i++)
        e->last[i] = e->base[i] + e->step[i];
    fw_statics_equilibrium_pose(w, e->last, q, q + n);
    for (int c = 0; c < e->coordinates; c++) {
        way[c] = q[c] - e->at[c];
        e->first[c] += fabs(way[c]);
    }
}

/* signs that push a coordinate up, and down, for every one of them */
static void first_signs(edge *e, double *way) {
    const size_t m = (size_t)e->coordinates;
    for (int j = 0; j < e->controls; j++)
        alone(e, j, way + (size_t)j * m);
    for (size_t c = 0; c < m; c++)
        for (int side = -1; side <= 1; side += 2) {
            for (int j = 0; j < e->controls; j++)
                e->sign[j] = way[(size_t)j * m + c] < 0 ? -side : side;
            propose(e, e->sign);
        }
}

/* from the end of a way along every edge; the shares that take a coordinate farther there are followed next */
static bool edges(edge *e, double *there) {
    fw_statics_equilibrium *w = e->r->w;
    const size_t n = (size_t)w->model->nq;
    const double *own = e->try + (size_t)e->now * (size_t)e->controls;
    memcpy(there, w->y, n * sizeof *there);
    for (int side = 0; side < 2; side++)
        for (int c = 0; c < e->coordinates; c++)
            e->farther[side][c].control = FW_NONE;
    for (int j = 0; j < e->controls; j++) {
        memcpy(w->y, there, n * sizeof *there);
        memcpy(e->sign, own, (size_t)e->controls * sizeof *own);
        if (!carry(e, j)) return false;
    }
    for (int side = 0; side < 2; side++)
        for (int c = 0; c < e->coordinates; c++) {
            const farther *f = &e->farther[side][c];
            if (f->control == FW_NONE || !(f->by > fw_friction_worth)) continue;
            memcpy(e->sign, own, (size_t)e->controls * sizeof *own);
            e->sign[f->control] = f->share;
            propose(e, e->sign);
        }
    return true;
}

static fw_status edge_room(edge *e) {
    const fw_statics_equilibrium *w = e->r->w;
    fw_arena *arena = w->arena;
    const size_t n = (size_t)w->model->nq, m = n + (size_t)w->mechanism->npin;
    double **of[] = {&e->base, &e->q, &e->all, &e->push, &e->last};
    double **wide[] = {&e->seen[0], &e->seen[1], &e->seen[2], &e->at, &e->low, &e->high, &e->first};
    e->coordinates = (int)m;
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        FW_NEED(*of[i] = fw_arena_array(arena, double, n));
    for (size_t i = 0; i < sizeof wide / sizeof wide[0]; i++)
        FW_NEED(*wide[i] = fw_arena_array(arena, double, m));
    FW_NEED(e->step = fw_arena_array(arena, double, FW_FRICTION_TURNS *n));
    FW_NEED(e->farther[0] = fw_arena_array(arena, farther, m));
    FW_NEED(e->farther[1] = fw_arena_array(arena, farther, m));
    FW_NEED(e->rope = fw_arena_array(arena, cable, (size_t)w->loads->nelement));
    e->controls = e->r->count;
    for (int i = 0, tendon = 0; e->mu > 0 && i < w->loads->nelement; i++) {
        const fw_effects_force_element *t = &w->loads->element[i];
        if (strcmp(t->class_->effect, "tendon") != 0) continue;
        cable *c = &e->rope[e->ropes++];
        FW_TRY(cable_room(w, t->ports, c));
        c->element = t, c->first = e->controls;
        c->kept = !isnan(w->scene->tendon[tendon++].pull_N);
        e->controls += t->ports - 2;
    }
    const size_t controls = (size_t)e->controls;
    FW_NEED(e->sign = fw_arena_array(arena, double, controls));
    FW_NEED(e->torque = fw_arena_array(arena, double, (size_t)e->r->count));
    FW_NEED(e->after = fw_arena_array(arena, double, 2 * (size_t)e->r->count));
    FW_NEED(e->try = fw_arena_array(arena, double, FW_FRICTION_SIGNS *controls));
    return FW_OK;
}

/* `spent`: it would take too long, and the first order stays */
static fw_status follow(edge *e, bool *ends) {
    fw_statics_equilibrium *w = e->r->w;
    const size_t n = (size_t)w->model->nq, m = (size_t)e->coordinates;
    double *way, *there;
    FW_NEED(way = fw_arena_array(w->arena, double, m *(size_t)e->controls));
    FW_NEED(there = fw_arena_array(w->arena, double, n));
    memcpy(e->base, w->y, n * sizeof *e->base);
    fw_statics_equilibrium_pose(w, w->y, e->at, e->at + n);
    memcpy(e->low, e->at, m * sizeof *e->at);
    memcpy(e->high, e->at, m * sizeof *e->at);
    first_signs(e, way);
    *ends = false;
    for (e->now = 0; e->now < e->tries && !*ends && !e->spent; e->now++) {
        memcpy(e->sign, e->try + (size_t)e->now * (size_t)e->controls,
               (size_t)e->controls * sizeof *e->sign);
        memcpy(w->y, e->base, n * sizeof *w->y);
        memset(e->torque, 0, (size_t)e->r->count * sizeof *e->torque);
        *ends = !carry(e, FW_NONE) || !edges(e, there);
    }
    memcpy(w->y, e->base, n * sizeof *e->base);
    FW_TRY(fw_statics_equilibrium_evaluate(w));
    return w->sparse ? factor_again(w) : FW_OK;
}

/* dense evaluations cost 30 n^3: so many that it takes seconds */
static long evaluations(const fw_statics_equilibrium *w) {
    const double n = (double)w->model->nq;
    return w->sparse ? 200 : (long)fmin(50000, 3e10 / (30 * n * n * n + 1e4));
}

static fw_status find(rub *r, fw_statics_friction_range *out, double mu) {
    const fw_statics_equilibrium *w = r->w;
    const size_t n = (size_t)w->model->nq;
    edge e = {.r = r, .out = out, .mu = mu, .left = evaluations(w)};
    bool ends;
    FW_TRY(edge_room(&e));
    FW_TRY(follow(&e, &ends));
    out->first_order = e.spent;
    if (e.spent ? e.grows : ends)
        out->why = "friction takes it to where nothing else holds it, or what presses grows with "
                   "the friction faster than this: it may rest far from here";
    for (int c = 0; c < e.coordinates; c++) {
        const bool pose = (size_t)c < n;
        const size_t k = pose ? (size_t)c : (size_t)c - n;
        double *from = pose ? out->from_q : out->from_angle_rad,
               *to = pose ? out->to_q : out->to_angle_rad;
        from[k] = (1 + fw_friction_margin) * (e.low[c] - e.at[c]);
        to[k] = (1 + fw_friction_margin) * (e.high[c] - e.at[c]);
        if (e.spent) from[k] = fmin(from[k], -e.first[c]), to[k] = fmax(to[k], e.first[c]);
        (pose ? out->q : out->angle_rad)[k] = fmax(-from[k], to[k]);
    }
    return FW_OK;
}

/* a solution for each of them, for each evaluation */
enum { FW_FRICTION_MOST = 500 };

fw_status fw_statics_equilibrium_rubbing(const fw_statics_equilibrium *w, int *count,
                                         double **row) {
    const fw_effects_loads *loads = w->loads;
    const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, w->y);
    const rub r = {.w = (fw_statics_equilibrium *)w};
    const size_t n = (size_t)w->model->nq;
    *count = loads ? loads->nfriction : 0;
    FW_NEED(*row = fw_arena_array(w->arena, double, (size_t)*count *n));
    for (int i = 0; i < *count; i++)
        if (loads->friction[i].pin == FW_NONE)
            slide_row(&r, &loads->friction[i], pose, *row + (size_t)i * n);
        else
            turn_row(&r, &loads->friction[i], *row + (size_t)i * n);
    return FW_OK;
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
    if (!out->why) FW_TRY(find(&r, out, rubs ? fw_effects_eyelet_friction_of(w->scene) : 0));
    *range = out;
    return FW_OK;
}
