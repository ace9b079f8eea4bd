/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radau IIA of order 5: implicit collocation at c = (4 -+ sqrt 6)/10 and 1, L-stable.
     z_i = h sum_j a_ij f(t + c_j h, y + z_j),   y(t + h) = y + z_3
   Simplified Newton in the coordinates W = T^-1 z, in which A^-1 is one real and one complex
   number, so that a step needs one real and one complex factorisation of (sigma I - J). Error
   estimate of order 3, filtered by the real factor; Gustafsson's predictive step control.
   The estimate falls with h^4 and the error at the end with h^5, so the tolerance inside is
   0.34 rtol^0.8: the error is proportional to rtol, and at 1e-4 the steps are about RADAU5's.
   Dense output: the collocation polynomial (order 3); for u of second order problems the quintic
   through both ends where the two agree within the tolerance, that is where the step is not stiff.
   Quadratures do not enter Newton's iteration: they are summed over the converged stages.
   Source: Hairer and Wanner, Solving ODEs II, 2nd ed., IV.8; Gustafsson, ACM TOMS 20 (1994).
   Tests: test_ode_*.c, test_ode_stiff.c */
#include "maths/ode.h"
#include "maths/ode_tables.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { ITERATIONS = 7 };

typedef struct radau5 {
    fw_maths_stepper base;
    fw_maths_ode_shifted real, complex;
    double *j;                  /* (n x controlled) */
    double *y_new, *f_new;      /* (padded) */
    double *z[3], *w[3], *r[3]; /* (padded) stages minus y, W = T^-1 z, right sides */
    double *row[3];             /* (padded) divided differences of the last step */
    double *work;               /* (2 padded) */
    bool *smooth;               /* (positions) the quintic serves */
    double h_factored;          /* 0: none */
    double h_old, err_old;      /* size and error of the last step */
    double rate, eta;           /* Newton's contraction, and rate/(1 - rate) */
    double gap;                 /* inner tolerance / rtol */
    double stiffness;           /* row sum norm of J in units of the step: (h |lambda|)^2 or so */
    bool have_j, fresh_j, first, rejected_last;
} radau5;

static fw_status create(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper) {
    radau5 *s = fw_arena_one(arena, radau5);
    FW_NEED(s);
    FW_TRY(fw_maths_ode_shifted_new(arena, ode, false, &s->real));
    FW_TRY(fw_maths_ode_shifted_new(arena, ode, true, &s->complex));
    FW_NEED(s->j = fw_arena_array(arena, double, (size_t)ode->n *(size_t)ode->controlled));
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->work = fw_maths_ode_vector(arena, 2 * fw_maths_ode_padded(ode->n)));
    FW_NEED(s->smooth = fw_arena_array(arena, bool, (size_t)ode->positions));
    for (int i = 0; i < 3; i++) {
        FW_NEED(s->z[i] = fw_maths_ode_vector(arena, ode->n));
        FW_NEED(s->w[i] = fw_maths_ode_vector(arena, ode->n));
        FW_NEED(s->r[i] = fw_maths_ode_vector(arena, ode->n));
        FW_NEED(s->row[i] = fw_maths_ode_vector(arena, ode->n));
    }
    *stepper = &s->base;
    return FW_OK;
}

static void start(fw_maths_stepper *b) {
    radau5 *s = (radau5 *)b;
    s->gap = 0.34 * pow(b->rtol, 0.8) / b->rtol;
    s->have_j = s->fresh_j = s->rejected_last = false;
    s->first = true;
    s->h_factored = 0;
    s->eta = 1;
    b->h_next = fw_maths_ode_first_step(b, 3, s->work);
}

/* in units of the inner tolerance */
static double size_of(const radau5 *s, const double *e) {
    return fw_maths_ode_norm(&s->base, e, s->base.y, s->base.y) / s->gap;
}

/* the polynomial of the last step, continued: z_i = p(1 + c_i h/h_old) - p(1); zeros at a start */
static void guess(radau5 *s, double h) {
    const fw_maths_stepper *b = &s->base;
    for (int i = 0; i < 3; i++) {
        double x = 1 + radau_c[i] * h / s->h_old;
        for (int c = 0; c < b->ode.n; c++)
            s->z[i][c] =
                s->first
                    ? 0
                    : b->y_old[c] - b->y[c] +
                          x * (s->row[0][c] +
                               (x - radau_c[0]) * (s->row[1][c] + (x - radau_c[1]) * s->row[2][c]));
    }
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < b->ode.controlled; c++)
            s->w[i][c] = radau_ti[i][0] * s->z[0][c] + radau_ti[i][1] * s->z[1][c] +
                         radau_ti[i][2] * s->z[2][c];
}

/* r = T^-1 F - (1/h) T^-1 A^-1 T W, the residual of the transformed stages; false: not finite */
static bool residual(radau5 *s, double h) {
    fw_maths_stepper *b = &s->base;
    int n = b->ode.n;
    for (int i = 0; i < 3; i++) {
        for (int c = 0; c < n; c++)
            s->work[c] = b->y[c] + (c < b->ode.controlled ? s->z[i][c] : 0);
        fw_maths_ode_evaluate_lean(b, b->t + radau_c[i] * h, s->work, s->r[i]);
        if (!fw_maths_ode_finite(s->r[i], b->ode.controlled)) return false;
    }
    const double real = radau_gamma / h, alpha = radau_alpha / h, beta = radau_beta / h;
    for (int c = 0; c < b->ode.controlled; c++) {
        double f0 = s->r[0][c], f1 = s->r[1][c], f2 = s->r[2][c];
        for (int i = 0; i < 3; i++)
            s->r[i][c] = radau_ti[i][0] * f0 + radau_ti[i][1] * f1 + radau_ti[i][2] * f2;
        s->r[0][c] -= real * s->w[0][c];
        s->r[1][c] -= alpha * s->w[1][c] - beta * s->w[2][c];
        s->r[2][c] -= alpha * s->w[2][c] + beta * s->w[1][c];
    }
    return true;
}

/* solves for the increment, adds it, and gives its size */
static double improve(radau5 *s) {
    fw_maths_stepper *b = &s->base;
    fw_maths_ode_shifted_solve(b, s->j, &s->real, s->r[0], NULL);
    fw_maths_ode_shifted_solve(b, s->j, &s->complex, s->r[1], s->r[2]);
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double size = size_of(s, s->r[i]);
        sum += size * size;
    }
    for (int c = 0; c < b->ode.controlled; c++) {
        for (int i = 0; i < 3; i++)
            s->w[i][c] += s->r[i][c];
        for (int i = 0; i < 3; i++)
            s->z[i][c] = radau_t[i][0] * s->w[0][c] + radau_t[i][1] * s->w[1][c] +
                         radau_t[i][2] * s->w[2][c];
    }
    b->newton++;
    return sqrt(sum / 3);
}

typedef struct newton_result {
    bool converged, finite;
    int iterations;
    double shrink; /* what h should be multiplied with when it failed */
} newton_result;

/* stops when the contraction seen so far promises an error below kappa tolerances; gives up early
   when it promises to miss that within the iterations left */
static newton_result newton(radau5 *s, double h) {
    double inner = s->gap * s->base.rtol;
    double kappa = fmax(10 * DBL_EPSILON / inner, fmin(0.03, sqrt(inner)));
    double size_old = 0, theta_old = 0;
    newton_result out = {.finite = true, .shrink = 0.5};
    s->eta = pow(fmax(s->eta, DBL_EPSILON), 0.8); /* trust the last step's rate a little less */
    s->rate = 0.001;
    for (int k = 1; k <= ITERATIONS; k++) {
        if (!residual(s, h)) return (newton_result){.shrink = 0.25};
        double size = improve(s);
        if (!isfinite(size)) return (newton_result){.shrink = 0.25};
        out.iterations = k;
        if (k > 1) {
            double theta = size / size_old;
            s->rate = k == 2 ? theta : sqrt(theta * theta_old);
            theta_old = theta;
            if (s->rate >= 0.99) return out;
            s->eta = s->rate / (1 - s->rate);
            double left = ITERATIONS - k;
            double miss = s->eta * size * pow(s->rate, left - 1) / kappa;
            if (left > 0 && miss >= 1) {
                double q = fmax(1e-4, fmin(20, miss));
                out.shrink = 0.8 * pow(q, -1 / (3 + left));
                return out;
            }
        }
        size_old = fmax(size, DBL_EPSILON);
        if (s->eta * size <= kappa) {
            out.converged = true;
            return out;
        }
    }
    return out;
}

/* (gamma/h - J)^-1 (f(t, y) + sum e_i z_i / h), and once more with f at y + that in steps that
   would otherwise be refused for an error which the filter had not seen */
static double error(radau5 *s, double h) {
    fw_maths_stepper *b = &s->base;
    int n = b->ode.controlled;
    memcpy(s->work, b->y, (size_t)b->ode.n * sizeof(double));
    double *e = s->r[0], *g = s->r[1], size = 0;
    for (int pass = 0; pass < 2; pass++) {
        const double *f = pass ? g : b->f;
        for (int c = 0; c < n; c++)
            e[c] =
                f[c] +
                (radau_e[0] * s->z[0][c] + radau_e[1] * s->z[1][c] + radau_e[2] * s->z[2][c]) / h;
        fw_maths_ode_shifted_solve(b, s->j, &s->real, e, NULL);
        size = fmax(size_of(s, e), 1e-10);
        if (!isfinite(size) || size < 1 || !(s->first || s->rejected_last) || pass == 1) break;
        for (int c = 0; c < n; c++)
            s->work[c] = b->y[c] + e[c];
        fw_maths_ode_evaluate_lean(b, b->t, s->work, g);
    }
    return size;
}

/* z_i = h sum_j a_ij g_j for the quadratures, with g_3 from the accepted end; false: not finite */
static bool quadratures(radau5 *s, double h) {
    fw_maths_stepper *b = &s->base;
    int first = b->ode.controlled, n = b->ode.n;
    if (first == n) return true;
    for (int i = 0; i < 2; i++) {
        for (int c = 0; c < n; c++)
            s->work[c] = b->y[c] + (c < first ? s->z[i][c] : 0);
        fw_maths_ode_evaluate(b, b->t + radau_c[i] * h, s->work, s->r[i]);
    }
    for (int c = first; c < n; c++) {
        for (int i = 0; i < 3; i++)
            s->z[i][c] = h * (radau_a[i][0] * s->r[0][c] + radau_a[i][1] * s->r[1][c] +
                              radau_a[i][2] * s->f_new[c]);
        s->y_new[c] = b->y[c] + s->z[2][c];
    }
    return fw_maths_ode_finite(s->y_new, n);
}

/* rows of the polynomial through 0, z_1, z_2 and the (projected) end */
static void keep_polynomial(radau5 *s) {
    const fw_maths_stepper *b = &s->base;
    const double c1 = radau_c[0], c2 = radau_c[1];
    for (int c = 0; c < b->ode.n; c++) {
        double z3 = b->y[c] - b->y_old[c];
        double d1 = s->z[0][c] / c1, e2 = (s->z[1][c] - s->z[0][c]) / (c2 - c1);
        double d2 = (e2 - d1) / c2, e3 = (z3 - s->z[1][c]) / (1 - c2);
        s->row[0][c] = d1;
        s->row[1][c] = d2;
        s->row[2][c] = (e3 - e2) / (1 - c1) - d2;
    }
}

/* largest sum of a row of |h^2 K_u| + |h K_v|, for first order problems of |h J| */
static double stiffness(const radau5 *s, double h) {
    const fw_maths_ode *ode = &s->base.ode;
    bool second = s->real.half;
    int columns = ode->controlled, first = second ? ode->positions : 0;
    double most = 0;
    for (int r = first; r < columns; r++) {
        double sum = 0;
        for (int c = 0; c < columns; c++)
            sum += fabs(s->j[r * columns + c]) * (second && c < first ? h * h : h);
        most = fmax(most, sum);
    }
    return most;
}

/* J and factors for h; 0: good, else what went wrong */
static fw_maths_ode_result linearise(radau5 *s, double h) {
    fw_maths_stepper *b = &s->base;
    if (!s->have_j) {
        s->h_factored = 0;
        if (!fw_maths_ode_jacobian(b, b->t, b->y, b->f, s->j, s->work)) return FW_ODE_NAN;
        s->have_j = s->fresh_j = true;
    }
    if (fabs(h - s->h_factored) <= 1e-6 * h) return FW_ODE_STEP; /* rounded times, last steps */
    s->h_factored = 0;
    if (!fw_maths_ode_shifted_factor(b, s->j, radau_gamma / h, 0, &s->real) ||
        !fw_maths_ode_shifted_factor(b, s->j, radau_alpha / h, radau_beta / h, &s->complex))
        return FW_ODE_NEWTON;
    s->h_factored = h;
    s->stiffness = stiffness(s, h);
    return FW_ODE_STEP;
}

/* h / err^(1/4), less where Newton worked hard, at most 8 times and at least a fifth */
static double next_step(double h, double err, int iterations) {
    double safety = fmin(0.9, 0.9 * (1 + 2 * ITERATIONS) / (iterations + 2 * ITERATIONS));
    return h / fmax(1.0 / 8, fmin(5, pow(err, 0.25) / safety));
}

static void accepted(radau5 *s, double h, double err, int iterations) {
    fw_maths_stepper *b = &s->base;
    double next = next_step(h, err, iterations);
    if (!s->first) {
        double trend = s->h_old / h * pow(err * err / s->err_old, 0.25) / 0.9;
        next = fmin(next, h / fmax(1.0 / 8, fmin(5, trend)));
    }
    if (s->rejected_last) next = fmin(next, h);
    s->h_old = h;
    s->err_old = fmax(1e-2, err);
    bool quick = s->rate <= 0.001;
    b->h_next = quick && next >= h && next <= 1.2 * h ? h : next;
    s->have_j = quick;
    s->fresh_j = s->first = s->rejected_last = false;
    keep_polynomial(s);
}

static fw_maths_ode_result step(fw_maths_stepper *b) {
    radau5 *s = (radau5 *)b;
    double h = fmin(b->h_next, b->h_max);
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h);
        fw_maths_ode_result cause = linearise(s, h);
        double shrink = 0.5;
        if (cause == FW_ODE_STEP) {
            guess(s, h);
            newton_result result = newton(s, h);
            double err = result.converged ? error(s, h) : (double)INFINITY;
            if (result.converged && err < 1) {
                for (int c = 0; c < b->ode.n; c++)
                    s->y_new[c] = b->y[c] + (c < b->ode.controlled ? s->z[2][c] : 0);
                if (fw_maths_ode_finish(b, t_new, s->y_new, s->f_new) && quadratures(s, h)) {
                    fw_maths_ode_accept(b, t_new, &s->y_new, &s->f_new);
                    accepted(s, h, err, result.iterations);
                    return FW_ODE_STEP;
                }
                shrink = 0.25;
                cause = fw_maths_ode_finite(s->f_new, b->ode.n) ? FW_ODE_SMALL : FW_ODE_NAN;
            } else if (result.converged) {
                shrink = s->first ? 0.1 : next_step(h, err, result.iterations) / h;
                if (!isfinite(err)) shrink = 0.25;
                cause = isfinite(err) ? FW_ODE_SMALL : FW_ODE_NAN;
            } else {
                shrink = result.shrink;
                cause = result.finite ? FW_ODE_NEWTON : FW_ODE_NAN;
                s->eta = 1;
            }
        }
        h *= shrink;
        s->rejected_last = true;
        if (!s->fresh_j) s->have_j = false;
        if (!fw_maths_ode_retry(b, h, &tries)) return cause;
    }
}

/* ---- dense output ---- */

static void polynomial(const radau5 *s, int c, double x, double *value, double *slope) {
    const double a = x - radau_c[0], b = x - radau_c[1];
    double d1 = s->row[0][c], d2 = s->row[1][c], d3 = s->row[2][c];
    *value = s->base.y_old[c] + x * (d1 + a * (d2 + b * d3));
    *slope = d1 + a * (d2 + b * d3) + x * (d2 + b * d3 + a * d3);
}

static void one(const radau5 *s, int c, double x, double *value, double *slope) {
    const fw_maths_stepper *b = &s->base;
    int n = b->ode.positions;
    if (c < 2 * n && s->smooth[c < n ? c : c - n]) {
        const fw_maths_ode_span span = {b->h, b->y_old, b->f_old, b->y, b->f, false};
        fw_maths_ode_span_value(&b->ode, &span, c, x, value, slope);
    } else {
        polynomial(s, c, x, value, slope);
    }
}

/* accelerations at the ends carry the error of stiff components times their stiffness: the quintic
   serves where it differs from the collocation polynomial by less than the tolerance of the step */
static void prepare(fw_maths_stepper *b) {
    radau5 *s = (radau5 *)b;
    const fw_maths_ode_span span = {b->h, b->y_old, b->f_old, b->y, b->f, false};
    for (int u = 0; u < b->ode.positions; u++) {
        s->smooth[u] = true;
        for (int k = 0; k < 2; k++) {
            int c = k ? u + b->ode.positions : u;
            double quintic, cubic, slope;
            double scale = b->tolerance[c] + b->rtol * fmax(fabs(b->y_old[c]), fabs(b->y[c]));
            fw_maths_ode_span_value(&b->ode, &span, c, 0.5, &quintic, &slope);
            polynomial(s, c, 0.5, &cubic, &slope);
            if (!(fabs(quintic - cubic) <= s->gap * scale)) s->smooth[u] = false;
        }
    }
}

static void dense(const fw_maths_stepper *b, double theta, double *y) {
    double slope;
    for (int c = 0; c < b->ode.n; c++)
        one((const radau5 *)b, c, theta, &y[c], &slope);
}

static void component(const fw_maths_stepper *b, int i, double wi, int j, double wj, double theta,
                      double *value, double *slope) {
    double p = 0, d = 0;
    one((const radau5 *)b, i, theta, value, slope);
    if (j >= 0) one((const radau5 *)b, j, theta, &p, &d);
    *value = wi * *value + wj * p;
    *slope = wi * *slope + wj * d;
}

/* stiff components are in balance at the stages; between them the polynomial is off by less than
   the tolerance, but a stiffness multiplies that */
static int own(const fw_maths_stepper *b, double *theta) {
    if (((const radau5 *)b)->stiffness < 100) return 0;
    theta[0] = radau_c[0], theta[1] = radau_c[1];
    return 2;
}

const fw_maths_stepper_row fw_maths_radau5_row = {
    .name = "radau5",
    .summary = "implicit Radau IIA of order 5, L-stable, for stiff mechanisms",
    .order = 5,
    .dense_order = 3,
    .dense_order_u = 5,
    .implicit = true,
    .create = create,
    .start = start,
    .step = step,
    .prepare = prepare,
    .dense = dense,
    .component = component,
    .own = own,
};
