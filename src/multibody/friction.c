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

   Inputs: state, posed and factored model with a0, lambda0. Outputs: T, a, lambda. Cost: one
   solution per entry, and n^3 of the number n of entries. Error: round-off times cond(A_stick).
   Source: Coulomb 1785; affine form and contraction: Painleve 1895; Lotstedt, SIAM J. Appl. Math.
   42 (1982) 281-296; Glocker, Set-Valued Force Laws, 2001. Test: test_friction.c,
   test_friction_model.c. */
#include "multibody/friction.h"
#include "maths/lapack.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { SWEEPS = 50, ITERATIONS = 200, POWERS = 40 };
static const double fw_beta = 1;            /* per scaled time: of what sticks */
static const double fw_hold_epsilon = 1e-6; /* of `loose` */

static fw_status arrays(fw_arena *arena, fw_model *m, struct fw_frictions *s) {
    size_t n = (size_t)s->n, nq = 3 * (size_t)m->nbody + 3, rows = 2 * (size_t)m->nblock;
    double **const vector[] = {&s->bias,   &s->rate, &s->accel, &s->size,  &s->loose,
                               &s->torque, &s->left, &s->more,  &s->start, &s->right,
                               &s->step,   &s->push, &s->creep};
    double **const square[] = {&s->gain, &s->factor, &s->hold, &s->jacobian};
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
    FW_NEED(s->stuck = fw_arena_array(arena, int, n));
    FW_NEED(s->moving = fw_arena_array(arena, int, n));
    FW_NEED(s->pivot = fw_arena_array(arena, int, n));
    FW_NEED(s->state = fw_arena_array(arena, double, (size_t)m->ny));
    return FW_OK;
}

static int index_of(const fw_model *m, int body) {
    return body == FW_GROUND ? m->nbody : body;
}

/* what it takes to look at contacts that press, in SI */
static fw_status see(fw_arena *arena, const fw_model *m, const fw_terms *terms, const double *q,
                     struct fw_frictions *s) {
    size_t ports = 0, switches = 0, n = (size_t)m->nq;
    for (int i = 0; i < s->n; i++) {
        if (s->item[i].element == FW_NONE) continue;
        const fw_force_element *e = &terms->element[s->item[i].element];
        ports = (size_t)e->ports > ports ? (size_t)e->ports : ports;
        switches = (size_t)e->switches > switches ? (size_t)e->switches : switches;
    }
    s->element = terms->element;
    for (int c = 0; c < 2; c++)
        s->shift_m[c] = q[c] - m->origin[c] * m->scale.length_m;
    FW_NEED(s->place = fw_arena_array(arena, double, n));
    FW_NEED(s->going = fw_arena_array(arena, double, n));
    FW_NEED(s->seen = fw_arena_array(arena, double, 6 * ports));
    FW_NEED(s->on = fw_arena_array(arena, bool, switches));
    return FW_OK;
}

fw_status fw_friction_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_terms *terms,
                          const double *q, fw_model *m) {
    struct fw_frictions *s = NULL;
    if (!terms || terms->nfriction == 0) return FW_OK;
    FW_NEED(s = fw_arena_one(arena, struct fw_frictions));
    s->n = terms->nfriction;
    s->jam = s->met = -1;
    FW_NEED(s->item = fw_arena_array(arena, fw_model_friction, (size_t)s->n));
    FW_TRY(arrays(arena, m, s));
    double newton = m->scale.mass_kg * m->scale.length_m / (m->scale.time_s * m->scale.time_s);
    for (int i = 0; i < s->n; i++) {
        const fw_friction *f = &terms->friction[i];
        bool slides = f->pin == FW_NONE, gone = !slides && terms->released[f->pin];
        double arm = slides ? 1 : f->radius_m / m->scale.length_m;
        s->item[i] =
            (fw_model_friction){.block = slides ? m->tie_block[f->tie]
                                         : gone ? FW_NONE
                                                : m->pin_block[f->pin],
                                .slides = slides,
                                .element = f->element,
                                .rest = arm * fmax(f->static_coefficient, f->kinetic_coefficient),
                                .slide = arm * f->kinetic_coefficient,
                                .preload = f->preload_N / newton,
                                .id = f->id ? f->id : "(unnamed)",
                                .place = f->place};
        const fw_tie *t = slides ? &mechanism->tie[f->tie] : NULL;
        s->item[i].a = index_of(m, t ? t->body_a : mechanism->pin[f->pin].body_a);
        s->item[i].b = index_of(m, t ? t->body_b : mechanism->pin[f->pin].body_b);
    }
    m->friction = s;
    return see(arena, m, terms, q, s);
}

int fw_friction_count(const fw_model *m) {
    return m->friction ? m->friction->n : 0;
}

/* ---- relative motion ---- */

static double of(const fw_model *m, const double *x, int body, int c) {
    return body < m->nbody ? x[3 * body + c] : 0;
}

/* h.x of entry i */
static double along(const fw_model *m, int i, const double *x) {
    const fw_model_friction *f = &m->friction->item[i];
    const double *h = m->friction->row + 6 * i;
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += h[c] * of(m, x, f->a, c) + h[3 + c] * of(m, x, f->b, c);
    return sum;
}

/* TRAVEL of constraints.c, at the points and with the axis of the joint's SLIDE */
static void slide_row(fw_model *m, int i, const double *y) {
    struct fw_frictions *s = m->friction;
    const fw_model_friction *f = &s->item[i];
    const double *v = y + m->nq, *ra = m->arm + 4 * f->block, *rb = ra + 2;
    double d[2], e[2], n[2], *h = s->row + 6 * i, rate[2], bend[2];
    fw_model_frame(m, f->block, y, d, e, n);
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

void fw_friction_rows(fw_model *m, const double *y) {
    struct fw_frictions *s = m->friction;
    for (int i = 0; i < s->n; i++) {
        double *h = s->row + 6 * i;
        s->bias[i] = 0;
        if (s->item[i].slides) {
            slide_row(m, i, y);
            continue;
        }
        memset(h, 0, 6 * sizeof *h);
        h[2] = -1, h[5] = 1;
    }
}

double fw_friction_coordinate(const fw_model *m, int i, const double *u) {
    const fw_model_friction *f = &m->friction->item[i];
    if (!f->slides) return of(m, u, f->b, 2) - of(m, u, f->a, 2);
    double d[2], e[2], n[2];
    fw_model_frame(m, f->block, u, d, e, n);
    return e[0] * d[0] + e[1] * d[1];
}

void fw_friction_rates(fw_model *m, const double *v) {
    for (int i = 0; i < m->friction->n; i++)
        m->friction->rate[i] = along(m, i, v);
}

/* a_j, lambda_j: unit T_j between the bodies of entry j */
static void respond_to(fw_model *m, int j) {
    struct fw_frictions *s = m->friction;
    const fw_model_friction *f = &s->item[j];
    const double *h = s->row + 6 * j;
    double *a = s->response + (size_t)j * (size_t)(m->nq + 3);
    memset(a, 0, (size_t)(m->nq + 3) * sizeof *a);
    for (int side = 0; side < 2; side++) {
        int b = side ? f->b : f->a;
        for (int c = 0; c < 3 && b < m->nbody; c++)
            a[3 * b + c] = (c < 2 ? m->minv[b] : m->jinv[b]) * h[3 * side + c];
    }
    s->loose[j] = along(m, j, a);
    m->method->accelerate(m, s->nothing, a, s->react + (size_t)j * 2 * (size_t)m->nblock);
}

void fw_friction_respond(fw_model *m, const double *y) {
    struct fw_frictions *s = m->friction;
    fw_friction_rows(m, y);
    fw_friction_rates(m, y + m->nq);
    for (int j = 0; j < s->n; j++)
        respond_to(m, j);
    for (int i = 0; i < s->n; i++)
        for (int j = 0; j < s->n; j++)
            s->gain[i * s->n + j] = along(m, i, s->response + (size_t)j * (size_t)(m->nq + 3));
}

/* ---- what presses ---- */

/* the part of the multipliers that presses the surfaces of entry i: of a slide the force across,
   not the couple */
static void presses(const fw_model *m, int i, const double *lambda, double rho[2]) {
    const fw_model_friction *f = &m->friction->item[i];
    bool own = f->element == FW_NONE && f->block != FW_NONE;
    rho[0] = own && !f->slides ? lambda[2 * f->block] : 0;
    rho[1] = own ? lambda[2 * f->block + 1] : 0;
}

/* the contact as it is at the state, scaled: what presses does not depend on T */
static double contact(fw_model *m, int i, double t, const double *y) {
    struct fw_frictions *s = m->friction;
    const fw_force_element *e = &s->element[s->item[i].element];
    const fw_scale unit = m->scale;
    for (int c = 0; c < m->nq; c++) {
        double size = c % 3 == 2 ? 1 : unit.length_m;
        s->place[c] = (m->origin[c] + y[c]) * size + (c % 3 == 2 ? 0 : s->shift_m[c % 3]);
        s->going[c] = y[m->nq + c] * size / unit.time_s;
    }
    double *p = s->seen, *w = p + 3 * e->ports;
    const fw_seen seen = {t * unit.time_s, m->piece, 1, p, w, s->on};
    fw_element_look(e, s->place, s->going, p, w);
    for (int k = 0; k < e->switches; k++)
        s->on[k] = e->class_->switch_value(e, &seen, k) > 0;
    double newton = unit.mass_kg * unit.length_m / (unit.time_s * unit.time_s);
    return e->class_->pressing(e, &seen) / newton;
}

double fw_friction_press(const fw_model *m, int i) {
    const struct fw_frictions *s = m->friction;
    const double *turn = s->turn + 2 * i * s->n;
    double x = s->base[2 * i], y = s->base[2 * i + 1];
    for (int j = 0; j < s->n; j++)
        x += turn[2 * j] * s->torque[j], y += turn[2 * j + 1] * s->torque[j];
    return s->push[i] + hypot(x, y);
}

void fw_friction_look(fw_model *m, double t, const double *y) {
    struct fw_frictions *s = m->friction;
    for (int i = 0; i < s->n; i++) {
        const fw_model_friction *f = &s->item[i];
        const double *h = s->row + 6 * i;
        s->accel[i] = along(m, i, m->accel) + s->bias[i];
        s->size[i] = fabs(s->bias[i]);
        for (int c = 0; c < 3; c++)
            s->size[i] +=
                fabs(h[c] * of(m, m->accel, f->a, c)) + fabs(h[3 + c] * of(m, m->accel, f->b, c));
        presses(m, i, m->lambda, s->base + 2 * i);
        double gone = fw_friction_coordinate(m, i, y) - f->held;
        s->creep[i] = 2 * fw_beta * s->rate[i] + fw_beta * fw_beta * gone;
        s->push[i] = f->preload;
        if (f->element != FW_NONE) s->push[i] += contact(m, i, t, y);
        for (int j = 0; j < s->n; j++)
            presses(m, i, s->react + (size_t)j * 2 * (size_t)m->nblock,
                    s->turn + 2 * (i * s->n + j));
    }
}

/* ---- the small system ---- */

bool fw_friction_hold(struct fw_frictions *s, int count, const int *which) {
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            double both = s->gain[which[i] * s->n + which[j]];
            both = 0.5 * (both + s->gain[which[j] * s->n + which[i]]);
            s->factor[i + j * count] = both + (i == j ? fw_hold_epsilon * s->loose[which[i]] : 0);
        }
    for (int i = 0; i < count; i++)
        if (!(s->factor[i + i * count] > 0)) return false;
    return count == 0 || fw_cholesky(count, s->factor);
}

void fw_friction_holding(struct fw_frictions *s, int count, const int *which, const double *right,
                         double *x) {
    double size = 0, before = (double)INFINITY;
    for (int i = 0; i < count; i++) {
        size = fmax(size, fabs(right[i]));
        s->more[i] = right[i], x[i] = 0;
    }
    for (int sweep = 0; sweep < SWEEPS && count > 0; sweep++) {
        double worst = 0;
        fw_cholesky_solve(count, s->factor, s->more);
        for (int i = 0; i < count; i++)
            x[i] += s->more[i];
        for (int i = 0; i < count; i++) {
            s->more[i] = right[i];
            for (int j = 0; j < count; j++)
                s->more[i] -= s->gain[which[i] * s->n + which[j]] * x[j];
            worst = fmax(worst, fabs(s->more[i]));
        }
        if (!(worst > 4e-15 * size) || worst > 0.7 * before) return;
        before = worst;
    }
}

static double coefficient(const fw_model_friction *f) {
    return f->yields ? f->rest : f->slide;
}

/* eliminates what sticks: T_stuck = start - hold T_moving; reach (2 per pair): what presses a
   moving entry for unit T of another one while the stuck ones hold; more than `left` gains */
static void eliminate(struct fw_frictions *s, int stuck, int moving) {
    double *press = s->press;
    for (int e = 0; e < stuck; e++) {
        int i = s->stuck[e];
        s->right[e] = -(s->accel[i] + s->creep[i]);
    }
    fw_friction_holding(s, stuck, s->stuck, s->right, s->start);
    for (int c = 0; c < moving; c++) {
        for (int e = 0; e < stuck; e++)
            s->right[e] = s->gain[s->stuck[e] * s->n + s->moving[c]];
        fw_friction_holding(s, stuck, s->stuck, s->right, s->hold + c * stuck);
    }
    for (int r = 0; r < moving; r++) {
        int i = s->moving[r];
        const double *turn = s->turn + 2 * i * s->n;
        s->left[i] = s->gain[i * s->n + i];
        for (int e = 0; e < stuck; e++)
            s->left[i] -= s->gain[i * s->n + s->stuck[e]] * s->hold[r * stuck + e];
        for (int k = 0; k < 2; k++) {
            press[2 * r + k] = s->base[2 * i + k];
            for (int e = 0; e < stuck; e++)
                press[2 * r + k] += turn[2 * s->stuck[e] + k] * s->start[e];
            for (int c = 0; c < moving; c++) {
                double *to = &s->reach[2 * (r * moving + c) + k];
                *to = turn[2 * s->moving[c] + k];
                for (int e = 0; e < stuck; e++)
                    *to -= turn[2 * s->stuck[e] + k] * s->hold[c * stuck + e];
            }
        }
    }
}

/* is the spectral radius of K, K_rc = mu_r |reach_rc|, below 1? (K x)_r / x_r of any positive x has
   it below its largest; x by powers of K. *worst: the entry that matters most. Source: Collatz
   1942, Wielandt 1950. */
static bool contracts(struct fw_frictions *s, int moving, int *worst) {
    double *x = s->right, *kx = s->step;
    for (int r = 0; r < moving; r++)
        x[r] = 1;
    for (int k = 0; k < POWERS; k++) {
        double bound = 0, largest = 0;
        for (int r = 0; r < moving; r++) {
            const fw_model_friction *f = &s->item[s->moving[r]];
            kx[r] = 0;
            for (int c = 0; c < moving; c++) {
                const double *reach = s->reach + 2 * (r * moving + c);
                kx[r] += coefficient(f) * hypot(reach[0], reach[1]) * x[c];
            }
            if (!(kx[r] / x[r] <= bound)) bound = kx[r] / x[r], *worst = s->moving[r];
            largest = fmax(largest, kx[r]);
        }
        if (bound < 1) return true;
        if (!(largest < (double)INFINITY)) return false;
        for (int r = 0; r < moving; r++)
            x[r] = kx[r] / largest + 1e-6;
    }
    return false;
}

/* F_r = T_r + sign mu N_r(T) at x, and its largest; with `slopes` the Jacobian too (by columns) */
static double mismatch(struct fw_frictions *s, int moving, const double *x, double *f,
                       double *slopes) {
    double worst = 0;
    for (int r = 0; r < moving; r++) {
        const fw_model_friction *item = &s->item[s->moving[r]];
        double mu = item->slip * coefficient(item), rho[2] = {s->press[2 * r], s->press[2 * r + 1]};
        const double *reach = s->reach + 2 * r * moving;
        for (int c = 0; c < moving; c++)
            rho[0] += reach[2 * c] * x[c], rho[1] += reach[2 * c + 1] * x[c];
        double n = hypot(rho[0], rho[1]), over = n > 0 ? 1 / n : 0;
        f[r] = x[r] + mu * (s->push[s->moving[r]] + n);
        worst = fmax(worst, fabs(f[r]));
        if (isnan(f[r])) return (double)INFINITY;
        for (int c = 0; c < moving && slopes; c++)
            slopes[r + c * moving] =
                (r == c) + mu * over * (rho[0] * reach[2 * c] + rho[1] * reach[2 * c + 1]);
    }
    return worst;
}

/* the fixed point of the contraction by Newton's method; where a step does not bring F down to 0.9,
   a plain iteration x - F, which does by the spectral radius of K in some norm */
static bool fixed_point(struct fw_frictions *s, int moving, double *x) {
    double *f = s->right, *step = s->step, *trial = s->value;
    memset(x, 0, (size_t)moving * sizeof *x);
    for (int k = 0; k < ITERATIONS; k++) {
        double size = 0, now = mismatch(s, moving, x, f, s->jacobian);
        if (!(now < (double)INFINITY)) return false;
        for (int r = 0; r < moving; r++)
            size = fmax(size, fabs(x[r]));
        if (now <= 4 * DBL_EPSILON * size) return true;
        memcpy(step, f, (size_t)moving * sizeof *f);
        memcpy(s->more, f, (size_t)moving * sizeof *f);
        bool newton = fw_lapack_lu(moving, s->jacobian, s->pivot) &&
                      fw_lapack_lu_solve(false, moving, 1, s->jacobian, s->pivot, step);
        for (int r = 0; r < moving; r++)
            trial[r] = x[r] - step[r];
        double next = newton ? mismatch(s, moving, trial, f, NULL) : (double)INFINITY;
        if (!(next < 0.9 * now)) {
            if (now <= 1e-13 * size) return true; /* round-off */
            for (int r = 0; r < moving; r++)
                trial[r] = x[r] - s->more[r];
        }
        memcpy(x, trial, (size_t)moving * sizeof *x);
    }
    return false;
}

bool fw_friction_solve(fw_model *m) {
    struct fw_frictions *s = m->friction;
    int stuck = 0, moving = 0, worst = 0;
    for (int i = 0; i < s->n; i++)
        if (s->item[i].slip)
            s->moving[moving++] = i;
        else
            s->stuck[stuck++] = i;
    s->jam = -1;
    for (int i = 0; i < s->n; i++) /* a state that is no number is no jam */
        if (!isfinite(s->accel[i]) || !isfinite(s->base[2 * i] + s->base[2 * i + 1])) return false;
    s->jam = moving ? s->moving[0] : s->stuck[0];
    if (!fw_friction_hold(s, stuck, s->stuck)) return false;
    eliminate(s, stuck, moving);
    if (!contracts(s, moving, &worst)) {
        s->jam = worst;
        return false;
    }
    double *x = s->value + s->n; /* of twice the length */
    if (!fixed_point(s, moving, x)) return false;
    for (int e = 0; e < stuck; e++) {
        double torque = s->start[e];
        for (int c = 0; c < moving; c++)
            torque -= s->hold[c * stuck + e] * x[c];
        s->torque[s->stuck[e]] = torque;
    }
    for (int r = 0; r < moving; r++)
        s->torque[s->moving[r]] = x[r];
    for (int i = 0; i < s->n; i++)
        s->item[i].torque = s->torque[i], s->item[i].press = fw_friction_press(m, i);
    s->jam = -1;
    return true;
}

/* ---- into the equations of motion ---- */

void fw_friction_apply(fw_model *m, double t, const double *y) {
    struct fw_frictions *s = m->friction;
    if (m->broken) return;
    fw_friction_respond(m, y);
    fw_friction_look(m, t, y);
    if (!fw_friction_solve(m)) {
        m->broken = true;
        s->jam_time = t;
        return;
    }
    for (int j = 0; j < s->n; j++) {
        const double *a = s->response + (size_t)j * (size_t)(m->nq + 3);
        const double *l = s->react + (size_t)j * 2 * (size_t)m->nblock;
        for (int i = 0; i < m->nq; i++)
            m->accel[i] += s->torque[j] * a[i];
        for (int i = 0; i < 2 * m->nblock; i++)
            m->lambda[i] += s->torque[j] * l[i];
    }
}

double fw_friction_power(const fw_model *m) {
    const struct fw_frictions *s = m->friction;
    double power = 0;
    for (int i = 0; i < s->n; i++)
        if (s->item[i].slip && !s->item[i].yields) power -= s->torque[i] * s->rate[i];
    return power;
}

void fw_friction_settle(fw_model *m, double *y) {
    struct fw_frictions *s = m->friction;
    double *v = y + m->nq;
    int stuck = 0;
    for (int i = 0; i < s->n; i++)
        if (!s->item[i].slip) s->stuck[stuck++] = i;
    if (stuck == 0) return;
    fw_friction_respond(m, y);
    if (!fw_friction_hold(s, stuck, s->stuck)) return;
    for (int pass = 0; pass < 2; pass++) {
        for (int e = 0; e < stuck; e++)
            s->right[e] = -s->rate[s->stuck[e]];
        fw_friction_holding(s, stuck, s->stuck, s->right, s->start);
        for (int e = 0; e < stuck; e++) {
            const double *a = s->response + (size_t)s->stuck[e] * (size_t)(m->nq + 3);
            for (int i = 0; i < m->nq; i++)
                v[i] += s->start[e] * a[i];
        }
        fw_friction_rates(m, v);
    }
}
