/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coulomb friction of joints: the torques T (forces, along a slide) that go with the present flags.

   Whatever the method, accelerations and multipliers are affine in T:  a = a0 + sum T_j a_j,
   lambda = lambda0 + sum T_j lambda_j, one solution with the factor at hand for each a_j. With the
   row h_i of relative motion (rate_i = h_i.v, generalised force h_i T_i), gains A_ij = h_i.a_j and
   the pressing force N_i = preload + |rho_i|, rho the joint's force:

     sticks   h_i.a + bias_i = -2 beta rate_i - beta^2 (x_i - x_i at rest),  beta = 1 scaled
     slips    T_i = -mu r N_i(T) sign_i
     yields   the same with the static coefficient: at rest because others hold it

   The right-hand side of the first is round-off: it keeps what sticks from creeping. A is symmetric
   and positive semidefinite; where several entries hold the same freedom T is not unique, and the
   one of least norm is taken (proximal iteration, as for the joints), which no acceleration depends
   on. The second is a fixed point T = g(T) of a map with |dg_i/dT_j| <= K_ij = mu_i r_i |rho_ij|:
   with the spectral radius of K below 1 there is one solution, and only one; for a single slipping
   entry there are two or none where it is not (jamming). That is checked, never passed over.

   Inputs: state, factor, and the solution a0, lambda0 there. Outputs: T, a, lambda. Cost: one
   solution per entry, and n^3 of the number n of entries. Error: round-off times cond(A_stick).
   Source: Coulomb 1785; affine form and contraction: Painleve 1895; Lotstedt, SIAM J. Appl. Math.
   42 (1982) 281-296; Glocker, Set-Valued Force Laws, 2001. Test: test_friction.c,
   test_friction_model.c. */
#include "multibody/multibody_scratch.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

static const double fw_beta = 1; /* per scaled time: of what sticks */

static fw_status arrays(fw_arena *arena, const fw_multibody_model *m,
                        struct fw_multibody_frictions *s) {
    size_t n = (size_t)s->n, nq = 3 * (size_t)m->nbody + 3, rows = 2 * (size_t)m->nblock;
    double **const vector[] = {&s->bias,  &s->rate,  &s->accel, &s->size,   &s->loose, &s->torque,
                               &s->left,  &s->more,  &s->start, &s->right,  &s->step,  &s->push,
                               &s->creep, &s->shift, &s->most,  &s->centre, &s->before};
    double **const square[] = {&s->gain, &s->factor, &s->hold, &s->jacobian};
    FW_TRY(fw_maths_lapack_ready());
    for (size_t i = 0; i < sizeof vector / sizeof vector[0]; i++)
        FW_NEED(*vector[i] = fw_arena_array(arena, double, n));
    for (size_t i = 0; i < sizeof square / sizeof square[0]; i++)
        FW_NEED(*square[i] = fw_arena_array(arena, double, n *n));
    FW_NEED(s->row = fw_arena_array(arena, double, 6 * n));
    FW_NEED(s->base = fw_arena_array(arena, double, 2 * n));
    FW_NEED(s->turn = fw_arena_array(arena, double, 2 * n * n));
    FW_NEED(s->reach = fw_arena_array(arena, double, 2 * n * n));
    FW_NEED(s->press = fw_arena_array(arena, double, 2 * n));
    FW_NEED(s->response = fw_arena_array(arena, double, n *nq));
    FW_NEED(s->react = fw_arena_array(arena, double, n *rows));
    FW_NEED(s->nothing = fw_arena_array(arena, double, rows));
    FW_NEED(s->value = fw_arena_array(arena, double, 2 * n));
    FW_NEED(s->rests = fw_arena_array(arena, bool, n));
    FW_NEED(s->held = fw_arena_array(arena, bool, n));
    FW_NEED(s->slid = fw_arena_array(arena, bool, n));
    FW_NEED(s->side = fw_arena_array(arena, int, n));
    FW_NEED(s->free = fw_arena_array(arena, int, n));
    FW_NEED(s->inside = fw_arena_array(arena, int, n));
    FW_NEED(s->stuck = fw_arena_array(arena, int, n));
    FW_NEED(s->moving = fw_arena_array(arena, int, n));
    FW_NEED(s->pivot = fw_arena_array(arena, int, n));
    FW_NEED(s->state = fw_arena_array(arena, double, (size_t)m->ny));
    return FW_OK;
}

static int index_of(const fw_multibody_model *m, int body) {
    return body == FW_GROUND ? m->nbody : body;
}

fw_status fw_multibody_friction_joints(fw_arena *arena, const fw_mechanism *mechanism,
                                       const fw_effects_loads *loads, fw_multibody_model *m) {
    double newton = fw_multibody_newton(m);
    m->nfriction = loads->nfriction;
    FW_NEED(m->friction = fw_arena_array(arena, fw_multibody_friction_joint, (size_t)m->nfriction));
    for (int i = 0; i < m->nfriction; i++) {
        const fw_effects_friction *f = &loads->friction[i];
        bool slides = f->pin == FW_NONE, gone = false;
        if (!slides && loads->released) gone = loads->released[f->pin];
        double arm = slides ? 1 : f->radius_m / m->scale.length_m;
        m->friction[i] = (fw_multibody_friction_joint){
            .block = slides ? m->joint_block[f->joint]
                     : gone ? FW_NONE
                            : m->pin_block[f->pin],
            .slides = slides,
            .element = f->element,
            .rest = arm * fmax(f->static_coefficient, f->kinetic_coefficient),
            .slide = arm * f->kinetic_coefficient,
            .preload = f->preload_N / newton,
            .id = fw_text_name(f->id),
            .place = f->place};
        const fw_device_joint *t = slides ? &mechanism->joint[f->joint] : NULL;
        m->friction[i].a = index_of(m, t ? t->body_a : mechanism->pin[f->pin].body_a);
        m->friction[i].b = index_of(m, t ? t->body_b : mechanism->pin[f->pin].body_b);
    }
    return FW_OK;
}

fw_status fw_multibody_friction_new(fw_arena *arena, fw_multibody_system *sys) {
    struct fw_multibody_frictions *s;
    if (sys->model->nfriction == 0) return FW_OK;
    FW_NEED(s = sys->friction = fw_arena_one(arena, struct fw_multibody_frictions));
    s->n = sys->model->nfriction;
    s->joint = sys->model->friction;
    s->jam = s->jammed = s->met = -1;
    FW_NEED(s->item = fw_arena_array(arena, fw_multibody_friction_state, (size_t)s->n));
    return arrays(arena, sys->model, s);
}

/* ---- relative motion ---- */

static double of(const fw_multibody_model *m, const double *x, int body, int c) {
    return body < m->nbody ? x[3 * body + c] : 0;
}

/* h.x of entry i */
static double along(const fw_multibody_system *sys, int i, const double *x) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_friction_joint *f = &m->friction[i];
    const double *h = sys->friction->row + 6 * i;
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += h[c] * of(m, x, f->a, c) + h[3 + c] * of(m, x, f->b, c);
    return sum;
}

/* TRAVEL of constraints.c, at the points and with the axis of the joint's SLIDE */
static void slide_row(fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                      const double *v) {
    const fw_multibody_model *m = sys->model;
    struct fw_multibody_frictions *s = sys->friction;
    const fw_multibody_friction_joint *f = &s->joint[i];
    const double *ra = pose->arm + 4 * f->block, *rb = ra + 2;
    double d[2], e[2], n[2], *h = s->row + 6 * i, rate[2], bend[2];
    fw_multibody_frame(m, pose, f->block, d, e, n);
    h[0] = -e[0], h[1] = -e[1];
    h[2] = -(e[1] * ra[0] - e[0] * ra[1]) + n[0] * d[0] + n[1] * d[1];
    h[3] = e[0], h[4] = e[1], h[5] = e[1] * rb[0] - e[0] * rb[1];
    double wa = of(m, v, f->a, 2), wb = of(m, v, f->b, 2);
    for (int c = 0; c < 2; c++) {
        double turned = c ? wb * rb[0] - wa * ra[0] : -wb * rb[1] + wa * ra[1];
        rate[c] = of(m, v, f->b, c) - of(m, v, f->a, c) + turned;
        bend[c] = wa * wa * ra[c] - wb * wb * rb[c];
    }
    s->bias[i] = e[0] * bend[0] + e[1] * bend[1] + 2 * wa * (n[0] * rate[0] + n[1] * rate[1]) -
                 wa * wa * (e[0] * d[0] + e[1] * d[1]);
}

static void rates(fw_multibody_system *sys, const double *v) {
    for (int i = 0; i < sys->friction->n; i++)
        sys->friction->rate[i] = along(sys, i, v);
}

void fw_multibody_friction_rows(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v) {
    struct fw_multibody_frictions *s = sys->friction;
    for (int i = 0; i < s->n; i++) {
        double *h = s->row + 6 * i;
        s->bias[i] = 0;
        if (s->joint[i].slides) {
            slide_row(sys, pose, i, v);
            continue;
        }
        memset(h, 0, 6 * sizeof *h);
        h[2] = -1, h[5] = 1;
    }
    rates(sys, v);
}

double fw_multibody_friction_coordinate(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                        int i) {
    const fw_multibody_friction_joint *f = &m->friction[i];
    if (!f->slides) return of(m, pose->u, f->b, 2) - of(m, pose->u, f->a, 2);
    double d[2], e[2], n[2];
    fw_multibody_frame(m, pose, f->block, d, e, n);
    return e[0] * d[0] + e[1] * d[1];
}

/* a_j, lambda_j: unit T_j between the bodies of entry j */
static void respond_to(fw_multibody_system *sys, const fw_multibody_factor *factor, int j) {
    const fw_multibody_model *m = sys->model;
    struct fw_multibody_frictions *s = sys->friction;
    const fw_multibody_friction_joint *f = &s->joint[j];
    const double *h = s->row + 6 * j;
    double *a = s->response + (size_t)j * (size_t)(m->nq + 3);
    memset(a, 0, (size_t)(m->nq + 3) * sizeof *a);
    for (int side = 0; side < 2; side++) {
        int b = side ? f->b : f->a;
        for (int c = 0; c < 3 && b < m->nbody; c++)
            a[3 * b + c] = (c < 2 ? m->minv[b] : m->jinv[b]) * h[3 * side + c];
    }
    s->loose[j] = along(sys, j, a);
    m->method->accelerate(sys, factor, s->nothing, a, s->react + (size_t)j * 2 * (size_t)m->nblock);
}

void fw_multibody_friction_respond(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                   const double *v) {
    struct fw_multibody_frictions *s = sys->friction;
    size_t n = (size_t)sys->model->nq + 3;
    fw_multibody_friction_rows(sys, factor->pose, v);
    for (int j = 0; j < s->n; j++)
        respond_to(sys, factor, j);
    for (int i = 0; i < s->n; i++)
        for (int j = 0; j < s->n; j++)
            s->gain[i * s->n + j] = along(sys, i, s->response + (size_t)j * n);
}

/* ---- what presses ---- */

/* the part of the multipliers that presses the surfaces of entry i: of a slide the force across,
   not the couple */
static void presses(const fw_multibody_friction_joint *f, const double *lambda, double rho[2]) {
    bool own = f->element == FW_NONE && f->block != FW_NONE;
    rho[0] = own && !f->slides ? lambda[2 * f->block] : 0;
    rho[1] = own ? lambda[2 * f->block + 1] : 0;
}

void fw_multibody_friction_evaluate(fw_multibody_system *sys, const fw_multibody_solution *found,
                                    const double *v) {
    const fw_multibody_model *m = sys->model;
    struct fw_multibody_frictions *s = sys->friction;
    const double *accel = found->accel;
    for (int i = 0; i < s->n; i++) {
        const fw_multibody_friction_joint *f = &s->joint[i];
        const double *h = s->row + 6 * i;
        s->accel[i] = along(sys, i, accel) + s->bias[i];
        s->size[i] = fabs(s->bias[i]);
        for (int c = 0; c < 3; c++)
            s->size[i] +=
                fabs(h[c] * of(m, accel, f->a, c)) + fabs(h[3 + c] * of(m, accel, f->b, c));
        presses(f, found->lambda, s->base + 2 * i);
        double gone = fw_multibody_friction_coordinate(m, found->pose, i) - s->item[i].held;
        s->creep[i] = 2 * fw_beta * s->rate[i] + fw_beta * fw_beta * gone;
        s->push[i] = f->preload;
        if (f->element != FW_NONE)
            s->push[i] += fw_multibody_element_pressing(sys, found->pose, f->element, v);
        for (int j = 0; j < s->n; j++)
            presses(f, s->react + (size_t)j * 2 * (size_t)m->nblock, s->turn + 2 * (i * s->n + j));
    }
}

/* ---- into the equations of motion ---- */

/* what entries that move take away */
static double power(const struct fw_multibody_frictions *s) {
    double sum = 0;
    for (int i = 0; i < s->n; i++)
        if (s->item[i].slip && !s->item[i].yields) sum -= s->torque[i] * s->rate[i];
    return sum;
}

bool fw_multibody_friction_apply(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                 const double *v, double *lost) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_solution *found = &sys->work->solution;
    struct fw_multibody_frictions *s = sys->friction;
    const double t = factor->pose->t;
    fw_multibody_friction_respond(sys, factor, v);
    fw_multibody_friction_evaluate(sys, found, v);
    if (!fw_multibody_friction_solve(s)) {
        if (s->jam >= 0) s->jammed = s->jam, s->jam_time = t;
        return false;
    }
    if (s->tight >= 0) s->jammed = s->tight, s->jam_time = t; /* should the run end here */
    for (int j = 0; j < s->n; j++) {
        const double *a = s->response + (size_t)j * (size_t)(m->nq + 3);
        const double *l = s->react + (size_t)j * 2 * (size_t)m->nblock;
        for (int i = 0; i < m->nq; i++)
            found->accel[i] += s->torque[j] * a[i];
        for (int i = 0; i < 2 * m->nblock; i++)
            found->lambda[i] += s->torque[j] * l[i];
    }
    *lost = power(s);
    return true;
}

void fw_multibody_friction_settle(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                  double *v) {
    struct fw_multibody_frictions *s = sys->friction;
    int stuck = 0, nq = sys->model->nq;
    for (int i = 0; i < s->n; i++)
        if (!s->item[i].slip) s->stuck[stuck++] = i;
    if (stuck == 0) return;
    fw_multibody_friction_respond(sys, factor, v);
    if (!fw_multibody_friction_hold(s, stuck, s->stuck)) return;
    for (int pass = 0; pass < 2; pass++) {
        for (int e = 0; e < stuck; e++)
            s->right[e] = -s->rate[s->stuck[e]];
        fw_multibody_friction_holding(s, stuck, s->stuck, s->right, s->start);
        for (int e = 0; e < stuck; e++) {
            const double *a = s->response + (size_t)s->stuck[e] * (size_t)(nq + 3);
            for (int i = 0; i < nq; i++)
                v[i] += s->start[e] * a[i];
        }
        rates(sys, v);
    }
}
