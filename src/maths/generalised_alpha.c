/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Generalised-alpha of Chung and Hulbert for u'' = a(t, u, u'), second order, damping the fastest
   oscillations by the spectral radius rho per step:
     u_1 = u_0 + h v_0 + h^2 ((1/2 - beta) p_0 + beta p_1)
     v_1 = v_0 + h ((1 - gamma) p_0 + gamma p_1)
     (1 - am) p_1 + am p_0 = (1 - af) a_1 + af a_0,   a_1 = a(t_1, u_1, v_1)
     am = (2 rho - 1)/(rho + 1), af = rho/(rho + 1)
     gamma = 1/2 - am + af, beta = (1 - am + af)^2/4
   p is a at t + (am - af) h to second order; when h changes, p - a is scaled with it, which keeps
   the order. The step is implicit in p_1: Newton with differences for a_u and a_v.
   Error estimate: u_1 and v_1 minus what the parabola through the accelerations at t_-1, t_0, t_1
   gives (Adams-Moulton, third order): asymptotically the local error itself, O(h^3); in the first
   step after a start the straight line through two. Quadratures by Simpson's rule.
   Source: Chung and Hulbert, J. Appl. Mech. 60 (1993); Arnold and Bruels, Multibody System
   Dynamics 18 (2007). Cost: an evaluation and a solution of n x n per iteration, n the number of u.
   Tests: test_ode_*.c, test_ode_stiff.c */
#include "maths/matrix.h"
#include "maths/ode.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { ITERATIONS = 8 };

typedef struct alpha {
    fw_maths_stepper base;
    double am, af, gamma, beta;
    double *j;                        /* (n x controlled) */
    double *matrix;                   /* (positions x positions) */
    int *pivot;                       /* (positions) */
    double *y_new, *f_new, *e, *work; /* (padded), work (2 padded) */
    double *g_old, *g;                /* (padded) f at both ends with the scheme's accelerations */
    double *a_old, *a, *a_new;        /* (positions) accelerations at t_-1, t_0, t_1 */
    double *lead;                     /* (positions) p - a for steps of h_lead */
    double *p, *p_new;                /* (positions) */
    double h_lead, h_before, h_factored;
    double rate;
    bool have_j, fresh_j, first;
} alpha;

static fw_status create(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper) {
    size_t n = (size_t)ode->positions;
    alpha *s = fw_arena_one(arena, alpha);
    FW_NEED(s);
    FW_NEED(s->j = fw_arena_array(arena, double, (size_t)ode->n *(size_t)ode->controlled));
    FW_NEED(s->matrix = fw_arena_array(arena, double, n *n));
    FW_NEED(s->pivot = fw_arena_array(arena, int, n));
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->e = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->work = fw_maths_ode_vector(arena, 2 * fw_maths_ode_padded(ode->n)));
    FW_NEED(s->g_old = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->g = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->a_old = fw_arena_array(arena, double, n));
    FW_NEED(s->a = fw_arena_array(arena, double, n));
    FW_NEED(s->a_new = fw_arena_array(arena, double, n));
    FW_NEED(s->lead = fw_arena_array(arena, double, n));
    FW_NEED(s->p = fw_arena_array(arena, double, n));
    FW_NEED(s->p_new = fw_arena_array(arena, double, n));
    *stepper = &s->base;
    return FW_OK;
}

/* p_0 - a_0 = (am - af) h a', with a' from a short explicit Euler step */
static void start(fw_maths_stepper *b) {
    alpha *s = (alpha *)b;
    int n = b->ode.positions;
    double rho = fmin(1, fmax(0, b->spectral_radius)), *y = s->work, *f = y + b->padded;
    s->am = (2 * rho - 1) / (rho + 1);
    s->af = rho / (rho + 1);
    s->gamma = 0.5 - s->am + s->af;
    s->beta = (1 - s->am + s->af) * (1 - s->am + s->af) / 4;
    b->h_next = s->h_lead = fw_maths_ode_first_step(b, 2, s->work);
    double d = 0.01 * b->h_next;
    for (int c = 0; c < b->ode.n; c++)
        y[c] = b->y[c] + d * b->f[c];
    fw_maths_ode_evaluate(b, b->t + d, y, f);
    for (int i = 0; i < n; i++) {
        double jerk = (f[n + i] - b->f[n + i]) / d;
        s->a[i] = b->f[n + i];
        s->lead[i] = isfinite(jerk) ? (s->am - s->af) * s->h_lead * jerk : 0;
    }
    memcpy(s->g, b->f, (size_t)b->ode.n * sizeof(double));
    s->have_j = s->fresh_j = false;
    s->first = true;
    s->h_factored = 0;
}

/* (1 - am)/(1 - af) I - h^2 beta a_u - h gamma a_v */
static fw_maths_ode_result linearise(alpha *s, double h) {
    fw_maths_stepper *b = &s->base;
    size_t n = (size_t)b->ode.positions, columns = (size_t)b->ode.controlled;
    if (!s->have_j) {
        s->h_factored = 0;
        if (!fw_maths_ode_jacobian(b, b->t, b->y, b->f, s->j, s->work)) return FW_ODE_NAN;
        s->have_j = s->fresh_j = true;
    }
    if (fabs(h - s->h_factored) <= 1e-6 * h) return FW_ODE_STEP;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++) {
            const double *row = s->j + (n + i) * columns;
            s->matrix[i * n + k] = (i == k ? (1 - s->am) / (1 - s->af) : 0) -
                                   h * h * s->beta * row[k] - h * s->gamma * row[n + k];
        }
    b->factorisations++;
    s->h_factored = 0;
    if (!fw_maths_lu_factor((int)n, s->matrix, s->pivot)) return FW_ODE_NEWTON;
    s->h_factored = h;
    return FW_ODE_STEP;
}

/* u, v and a at the end from p_1 */
static void from_p(alpha *s, double h) {
    const fw_maths_stepper *b = &s->base;
    int n = b->ode.positions;
    for (int i = 0; i < n; i++) {
        double p0 = s->p[i], p1 = s->p_new[i];
        s->y_new[i] = b->y[i] + h * (b->y[n + i] + h * ((0.5 - s->beta) * p0 + s->beta * p1));
        s->y_new[n + i] = b->y[n + i] + h * ((1 - s->gamma) * p0 + s->gamma * p1);
        s->a_new[i] = ((1 - s->am) * p1 + s->am * p0 - s->af * s->a[i]) / (1 - s->af);
    }
}

/* what the parabola (or line) through the last accelerations gives at the end: a first guess */
static void predict(alpha *s, double h) {
    int n = s->base.ode.positions;
    for (int i = 0; i < n; i++) {
        double slope = s->first ? 0 : (s->a[i] - s->a_old[i]) / s->h_before;
        double a1 = s->a[i] + h * slope;
        s->p[i] = s->a[i] + s->lead[i] * (h / s->h_lead);
        s->p_new[i] = ((1 - s->af) * a1 + s->af * s->a[i] - s->am * s->p[i]) / (1 - s->am);
    }
    memcpy(s->y_new, s->base.y, (size_t)s->base.ode.n * sizeof(double));
    from_p(s, h);
}

/* increments below a thousandth of the tolerance, or round-off, end it */
static fw_maths_ode_result newton(alpha *s, double h, double t_new) {
    fw_maths_stepper *b = &s->base;
    int n = b->ode.positions;
    double enough = fmax(1e-3, 20 * DBL_EPSILON / b->rtol), before = 0;
    double *f = s->work + b->padded, *r = s->work;
    s->rate = 0;
    for (int k = 1; k <= ITERATIONS; k++) {
        fw_maths_ode_evaluate(b, t_new, s->y_new, f);
        for (int i = 0; i < n; i++)
            r[i] = f[n + i] - s->a_new[i];
        if (!fw_maths_ode_finite(r, n)) return FW_ODE_NAN;
        fw_maths_lu_solve(n, s->matrix, s->pivot, NULL, r);
        b->newton++;
        for (int c = 0; c < b->ode.n; c++)
            s->e[c] = 0;
        for (int i = 0; i < n; i++) {
            s->p_new[i] += r[i];
            s->e[i] = h * h * s->beta * r[i];
            s->e[n + i] = h * s->gamma * r[i];
        }
        from_p(s, h);
        double size = fw_maths_ode_norm(b, s->e, b->y, s->y_new);
        if (!isfinite(size)) return FW_ODE_NAN;
        if (k > 1) s->rate = fmax(s->rate, size / fmax(before, DBL_MIN));
        if (size <= enough) return FW_ODE_STEP;
        if (s->rate >= 0.9) return FW_ODE_NEWTON;
        before = size;
    }
    return FW_ODE_NEWTON;
}

/* local errors of u and v, see the head of this file; units of the tolerance */
static double error(alpha *s, double h) {
    const fw_maths_stepper *b = &s->base;
    int n = b->ode.positions;
    for (int i = 0; i < n; i++) {
        double d12 = (s->a_new[i] - s->a[i]) / h;
        double d01 = s->first ? d12 : (s->a[i] - s->a_old[i]) / s->h_before;
        double d2 = s->first ? 0 : (d12 - d01) / (h + s->h_before);
        double dv = h * (s->a[i] + h * (d12 / 2 - h * d2 / 6));
        double du = h * (b->y[n + i] + h * (s->a[i] / 2 + h * (d12 / 6 - h * d2 / 12)));
        s->e[i] = s->y_new[i] - b->y[i] - du;
        s->e[n + i] = s->y_new[n + i] - b->y[n + i] - dv;
    }
    return fw_maths_ode_norm(b, s->e, b->y, s->y_new);
}

/* z += h/6 (z'_0 + 4 z'_m + z'_1) with the middle on the interpolant */
static bool quadratures(alpha *s, double h, double t_new) {
    fw_maths_stepper *b = &s->base;
    const fw_maths_ode_span span = {h, b->y, s->g, s->y_new, s->f_new, false};
    double *y = s->work, *f = y + b->padded, slope;
    int first = 2 * b->ode.positions;
    if (first == b->ode.n) return true;
    for (int c = 0; c < b->ode.n; c++)
        fw_maths_ode_span_value(&b->ode, &span, c, 0.5, &y[c], &slope);
    fw_maths_ode_evaluate(b, (b->t + t_new) / 2, y, f);
    for (int c = first; c < b->ode.n; c++)
        s->y_new[c] = b->y[c] + h / 6 * (b->f[c] + 4 * f[c] + s->f_new[c]);
    return fw_maths_ode_finite(s->y_new, b->ode.n);
}

static void swap(double **x, double **y) {
    double *z = *x;
    *x = *y;
    *y = z;
}

static void accepted(alpha *s, double h, double err) {
    fw_maths_stepper *b = &s->base;
    int n = b->ode.positions;
    for (int i = 0; i < n; i++)
        s->lead[i] = s->p_new[i] - s->a_new[i];
    s->h_lead = s->h_before = h;
    swap(&s->a_old, &s->a);
    swap(&s->a, &s->a_new);
    swap(&s->g_old, &s->g);
    memcpy(s->g, b->f, (size_t)b->ode.n * sizeof(double));
    memcpy(s->g + n, s->a, (size_t)n * sizeof(double));
    double factor = fmin(2, fmax(0.2, 0.9 / cbrt(fmax(err, 1e-9))));
    b->h_next = factor > 1 && factor < 1.2 ? h : h * factor; /* keeps the factors */
    s->have_j = s->rate < 0.2;
    s->fresh_j = s->first = false;
}

static fw_maths_ode_result step(fw_maths_stepper *b) {
    alpha *s = (alpha *)b;
    double h = fmin(b->h_next, b->h_max);
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h), shrink = 0.25;
        fw_maths_ode_result cause = linearise(s, h);
        if (cause == FW_ODE_STEP) {
            predict(s, h);
            cause = newton(s, h, t_new);
        }
        if (cause == FW_ODE_STEP) {
            double err = error(s, h);
            if (err <= 1 && fw_maths_ode_finish(b, t_new, s->y_new, s->f_new) &&
                quadratures(s, h, t_new)) {
                fw_maths_ode_accept(b, t_new, &s->y_new, &s->f_new);
                accepted(s, h, err);
                return FW_ODE_STEP;
            }
            if (err > 1) shrink = fmax(0.2, 0.9 / cbrt(err));
            cause =
                err <= 1 && !fw_maths_ode_finite(s->f_new, b->ode.n) ? FW_ODE_NAN : FW_ODE_SMALL;
        }
        h *= shrink;
        if (!s->fresh_j) s->have_j = false;
        if (!fw_maths_ode_retry(b, h, &tries)) return cause;
    }
}

/* ---- dense output: Hermite with the scheme's own accelerations, in which the error of stiff
   components is not multiplied with their stiffness ---- */

static fw_maths_ode_span span_of(const fw_maths_stepper *b) {
    const alpha *s = (const alpha *)b;
    return (fw_maths_ode_span){b->h, b->y_old, s->g_old, b->y, s->g, true};
}

static void prepare(fw_maths_stepper *s) {
    (void)s;
}

static void dense(const fw_maths_stepper *b, double theta, double *y) {
    const fw_maths_ode_span span = span_of(b);
    double slope;
    for (int c = 0; c < b->ode.n; c++)
        fw_maths_ode_span_value(&b->ode, &span, c, theta, &y[c], &slope);
}

static void component(const fw_maths_stepper *b, int i, double wi, int j, double wj, double theta,
                      double *value, double *slope) {
    const fw_maths_ode_span span = span_of(b);
    double p = 0, d = 0;
    fw_maths_ode_span_value(&b->ode, &span, i, theta, value, slope);
    if (j >= 0) fw_maths_ode_span_value(&b->ode, &span, j, theta, &p, &d);
    *value = wi * *value + wj * p;
    *slope = wi * *slope + wj * d;
}

const fw_maths_stepper_row fw_maths_generalised_alpha_row = {
    .name = "generalised-alpha",
    .summary =
        "implicit generalised-alpha of order 2 with chosen damping of fast oscillations, for "
        "stiff and non-smooth motion at loose tolerances",
    .order = 2,
    .dense_order = 2,
    .dense_order_u = 2,
    .implicit = true,
    .second_order = true,
    .create = create,
    .start = start,
    .step = step,
    .prepare = prepare,
    .dense = dense,
    .component = component,
};
