/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The explicit Runge-Kutta methods of our own, one row each: rk4, dopri5 and dop853. Tests: test_ode_rk.c
   (coefficients), test_ode_*.c */
#include "maths/ode.h"
#include "maths/ode_tables.h"
#include <math.h>
#include <string.h>

/* ---- rk4 ----

   The classical Runge-Kutta method of order 4 with equal steps: the baseline, which knows no error.
     y(t + h) = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
   h is (t_end - t)/N with the smallest N that keeps h <= min(h_fixed, h_max); where the caller
   changes h_max on the way, the rest is divided anew. Dense output by Hermite interpolation.
   Source: Kutta 1901; Hairer, Norsett and Wanner I, II.1. Cost 4 evaluations. */

typedef struct rk4 {
    fw_maths_stepper base;
    double *y_new, *f_new, *k; /* (padded), (padded), (3 padded) k2 to k4 */
    double t_start, count;     /* steps from t_start to t_end */
    double done;
    double whole;  /* from start to t_end */
    double wanted; /* step that the division is made for */
} rk4;

static fw_status rk4_create(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper) {
    rk4 *s = fw_arena_one(arena, rk4);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->k = fw_arena_array(arena, double, 3 * (size_t)fw_maths_ode_padded(ode->n)));
    *stepper = &s->base;
    return FW_OK;
}

static double rk4_wanted(const fw_maths_stepper *b, double span) {
    return fmin(b->h_fixed > 0 ? b->h_fixed : span / 1000, b->h_max);
}

/* the way from here to t_end in equal steps of at most h */
static void rk4_divide(rk4 *s, double h) {
    fw_maths_stepper *b = &s->base;
    double span = b->t_end - b->t;
    s->t_start = b->t;
    s->wanted = h;
    s->count = fmax(1, ceil(span / h * (1 - 1e-12)));
    s->done = 0;
    b->h_next = span / s->count;
}

static void rk4_start(fw_maths_stepper *b) {
    rk4 *s = (rk4 *)b;
    s->whole = b->t_end - b->t;
    rk4_divide(s, rk4_wanted(b, s->whole));
}

static fw_maths_ode_result rk4_step(fw_maths_stepper *b) {
    rk4 *s = (rk4 *)b;
    int n = b->ode.n, width = b->padded;
    if (rk4_wanted(b, s->whole) != s->wanted) rk4_divide(s, rk4_wanted(b, s->whole));
    double part = (s->done + 1) / s->count; /* from the start: rounding does not add up */
    double t_new = s->done + 1 >= s->count ? b->t_end : s->t_start + part * (b->t_end - s->t_start);
    double h = t_new - b->t, *k2 = s->k, *k3 = k2 + width, *k4 = k3 + width;
    if (!(h > 0)) return FW_ODE_SMALL;
    for (int c = 0; c < n; c++)
        s->y_new[c] = b->y[c] + h / 2 * b->f[c];
    fw_maths_ode_evaluate(b, b->t + h / 2, s->y_new, k2);
    for (int c = 0; c < n; c++)
        s->y_new[c] = b->y[c] + h / 2 * k2[c];
    fw_maths_ode_evaluate(b, b->t + h / 2, s->y_new, k3);
    for (int c = 0; c < n; c++)
        s->y_new[c] = b->y[c] + h * k3[c];
    fw_maths_ode_evaluate(b, t_new, s->y_new, k4);
    for (int c = 0; c < n; c++)
        s->y_new[c] = b->y[c] + h / 6 * (b->f[c] + 2 * k2[c] + (2 * k3[c] + k4[c]));
    if (!fw_maths_ode_finite(s->y_new, n)) return FW_ODE_NAN;
    if (!fw_maths_ode_finish(b, t_new, s->y_new, s->f_new))
        return fw_maths_ode_finite(s->y_new, n) && fw_maths_ode_finite(s->f_new, n) ? FW_ODE_SMALL
                                                                                    : FW_ODE_NAN;
    fw_maths_ode_accept(b, t_new, &s->y_new, &s->f_new);
    s->done++;
    return FW_ODE_STEP;
}

static void rk4_prepare(fw_maths_stepper *s) {
    (void)s;
}

const fw_maths_stepper_row fw_maths_rk4_row = {
    .name = "rk4",
    .summary = "classical Runge-Kutta of order 4 with equal steps and no error control: a baseline",
    .order = 4,
    .dense_order = 3,
    .dense_order_u = 4,
    .fixed_step = true,
    .create = rk4_create,
    .start = rk4_start,
    .step = rk4_step,
    .prepare = rk4_prepare,
    .dense = fw_maths_ode_hermite,
    .component = fw_maths_ode_hermite_component,
};

/* ---- dopri5 ----

   Dormand and Prince 5(4): explicit Runge-Kutta in 7 stages of which the last is the first of the
   next step, error estimate of order 4, PI step control, and dense output of order 4 that costs no
   evaluation.
     Y_i = y + h sum_j a_ij f(t + c_j h, Y_j),   y(t + h) = Y_7,   e = h sum_i e_i f(t + c_i h, Y_i)
   Source: Hairer, Norsett and Wanner, Solving ODEs I, 2nd ed., II.5 table 5.2 and II.6 (dense
   output), II.4 (control). Cost of a step: 6 right-hand sides, one more with a projection, and
   32 n multiplications. */

enum { DOPRI_ROWS = 5 };

typedef struct dopri5 {
    fw_maths_stepper base;
    const fw_maths_rk_kernels *kernel;
    double *y_new, *f_new;             /* (padded) */
    double *k;                         /* (DOPRI_STAGES padded) stages; 0 is f_old instead */
    double *row;                       /* (ROWS padded) dense output */
    double *zero;                      /* (padded) */
    const double *stage[DOPRI_STAGES]; /* where they are */
    double e[2 * DOPRI_STAGES];        /* error weights, each followed by a zero */
    double err_old;
    bool rejected_last;
} dopri5;

static fw_status dopri5_create(fw_arena *arena, const fw_maths_ode *ode,
                               fw_maths_stepper **stepper) {
    size_t width = (size_t)fw_maths_ode_padded(ode->n);
    dopri5 *s = fw_arena_one(arena, dopri5);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->zero = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->k = fw_arena_array(arena, double, DOPRI_STAGES *width));
    FW_NEED(s->row = fw_arena_array(arena, double, DOPRI_ROWS *width));
    s->kernel = fw_maths_rk_kernels_best();
    for (size_t i = 0; i < DOPRI_STAGES; i++) {
        s->stage[i] = s->k + i * width;
        s->e[2 * i] = dopri_e[i];
    }
    *stepper = &s->base;
    return FW_OK;
}

static void dopri5_start(fw_maths_stepper *base) {
    dopri5 *s = (dopri5 *)base;
    s->err_old = 1e-4;
    s->rejected_last = false;
    base->h_next = fw_maths_ode_first_step(base, 5, s->k);
}

/* h / clamp(err^(0.2 - 0.75 beta) err_old^-beta / 0.9, 0.1, 5) with beta = 0.04 */
static double dopri5_next_step(const dopri5 *s, double h, double err) {
    const double beta = 0.04, safety = 0.9;
    double factor = pow(err, 0.2 - 0.75 * beta) / pow(s->err_old, beta) / safety;
    double next = h / fmin(5, fmax(0.1, factor));
    return s->rejected_last ? fmin(h, next) : next;
}

/* all stages and y_new = Y_7 of a step h; gives the error in units of the tolerance */
static double dopri5_attempt(dopri5 *s, double h) {
    fw_maths_stepper *b = &s->base;
    double sum[2];
    for (int i = 1; i < DOPRI_STAGES; i++) {
        s->kernel->combine(b->padded, h, i, dopri_a[i], s->stage, b->y, s->y_new);
        fw_maths_ode_evaluate(b, b->t + dopri_c[i] * h, s->y_new, s->k + i * b->padded);
    }
    s->kernel->errors(b->padded, DOPRI_STAGES, s->e, s->stage, b->rtol, b->tolerance, b->y,
                      s->y_new, sum);
    return b->ode.controlled ? h * sqrt(sum[0] / b->ode.controlled) : 0 * sum[0];
}

static fw_maths_ode_result dopri5_step(fw_maths_stepper *b) {
    dopri5 *s = (dopri5 *)b;
    double h = fmin(b->h_next, b->h_max);
    s->stage[0] = b->f;
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h);
        double err = dopri5_attempt(s, h);
        bool good = err <= 1, done = good; /* false for a NaN */
        if (good && b->ode.project) {
            done = fw_maths_ode_finish(b, t_new, s->y_new, s->f_new);
        } else if (good) {
            memcpy(s->f_new, s->stage[DOPRI_STAGES - 1], (size_t)b->ode.n * sizeof(double));
            done =
                fw_maths_ode_finite(s->f_new, b->ode.n) && fw_maths_ode_finite(s->y_new, b->ode.n);
        }
        if (done) {
            b->h_next = dopri5_next_step(s, h, err);
            s->err_old = fmax(err, 1e-4);
            s->rejected_last = false;
            fw_maths_ode_accept(b, t_new, &s->y_new, &s->f_new);
            s->stage[0] = b->f_old;
            return FW_ODE_STEP;
        }
        h = good || !isfinite(err) ? h / 4 : h / fmin(5, pow(err, 0.17) / 0.9);
        s->rejected_last = true;
        if (!fw_maths_ode_retry(b, h, &tries)) return isfinite(err) ? FW_ODE_SMALL : FW_ODE_NAN;
    }
}

/* the first four coefficients fit y and f at both ends, projected or not; the fifth makes the
   interpolant exact to order 4 */
static void dopri5_prepare(fw_maths_stepper *b) {
    dopri5 *s = (dopri5 *)b;
    size_t width = (size_t)b->padded;
    double *r = s->row;
    for (size_t c = 0; c < (size_t)b->ode.n; c++) {
        double difference = b->y[c] - b->y_old[c], bend = b->h * b->f_old[c] - difference;
        r[c] = b->y_old[c];
        r[width + c] = difference;
        r[2 * width + c] = bend;
        r[3 * width + c] = difference - b->h * b->f[c] - bend;
    }
    s->kernel->combine(b->padded, b->h, DOPRI_STAGES, dopri_d, s->stage, s->zero, r + 4 * width);
    fw_ode_nested_tame(b, DOPRI_ROWS, r);
}

static void dopri5_dense(const fw_maths_stepper *b, double theta, double *y) {
    fw_ode_nested_dense(b, DOPRI_ROWS, ((const dopri5 *)b)->row, theta, y);
}

static void dopri5_component(const fw_maths_stepper *b, int i, double wi, int j, double wj,
                             double theta, double *value, double *slope) {
    fw_ode_nested_component(b, DOPRI_ROWS, ((const dopri5 *)b)->row, i, wi, j, wj, theta, value,
                            slope);
}

const fw_maths_stepper_row fw_maths_dopri5_row = {
    .name = "dopri5",
    .summary = "explicit Runge-Kutta 5(4) of Dormand and Prince, for loose tolerances",
    .order = 5,
    .dense_order = 4,
    .dense_order_u = 4,
    .create = dopri5_create,
    .start = dopri5_start,
    .step = dopri5_step,
    .prepare = dopri5_prepare,
    .dense = dopri5_dense,
    .component = dopri5_component,
};

/* ---- dop853 ----

   DOP853 of Dormand and Prince: explicit Runge-Kutta of order 8 in 12 stages with error estimates
   of order 5 and 3, PI step control, and dense output of order 7 from three more stages.
     Y_i = y + h sum_j a_ij f(t + c_j h, Y_j),   y(t + h) = y + h sum_i b_i f(t + c_i h, Y_i)
   Source: Hairer, Norsett and Wanner, Solving ODEs I, 2nd ed., II.5 and II.10. Cost of a step of n
   components: 12 right-hand sides and 74 n multiplications; of the dense output 3 and 72 n. */

enum { ENTRIES = sizeof dop_a / sizeof dop_a[0], DOP_ROWS = 8, LAST = DOP_STAGES };

typedef struct dop853 {
    fw_maths_stepper base;
    const fw_maths_rk_kernels *kernel;
    double *y_new, *f_new;       /* (padded) */
    double *k;                   /* (DOP_ALL padded) stages; 0 and 12 are f_old and f instead */
    double *row;                 /* (ROWS padded) dense output */
    double *zero;                /* (padded) */
    double a[ENTRIES];           /* dop_a as plain numbers */
    const double *list[ENTRIES]; /* and the stages that they belong to */
    double e[2 * DOP_STAGES];    /* errors of order 5 and 3, side by side, for the stages of b */
    double err_old;
    bool rejected_last;
} dop853;

static fw_status dop853_create(fw_arena *arena, const fw_maths_ode *ode,
                               fw_maths_stepper **stepper) {
    size_t width = (size_t)fw_maths_ode_padded(ode->n);
    dop853 *s = fw_arena_one(arena, dop853);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->zero = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->k = fw_arena_array(arena, double, DOP_ALL *width));
    FW_NEED(s->row = fw_arena_array(arena, double, DOP_ROWS *width));
    s->kernel = fw_maths_rk_kernels_best();
    for (size_t i = 0; i < ENTRIES; i++) {
        s->a[i] = dop_a[i].a;
        s->list[i] = s->k + (size_t)dop_a[i].stage * width;
    }
    const dop_entry *b = dop_a + dop_row[LAST]; /* e5 has the same stages */
    for (size_t i = 0; i < sizeof dop_e5 / sizeof dop_e5[0]; i++) {
        s->e[2 * i] = dop_e5[i].a;
        s->e[2 * i + 1] = b[i].a;
        for (int j = 0; j < 3; j++)
            if (dop_b3[j].stage == b[i].stage) s->e[2 * i + 1] -= dop_b3[j].a;
    }
    *stepper = &s->base;
    return FW_OK;
}

static void dop853_start(fw_maths_stepper *base) {
    dop853 *s = (dop853 *)base;
    s->err_old = 1e-4;
    s->rejected_last = false;
    base->h_next = fw_maths_ode_first_step(base, 8, s->k);
}

/* out = y + h sum_j a_ij k_j for row i of the table */
static void dop853_combine(const dop853 *s, int i, double h, const double *y, double *out) {
    int first = dop_row[i];
    s->kernel->combine(s->base.padded, h, dop_row[i + 1] - first, s->a + first, s->list + first, y,
                       out);
}

/* err = |h| E5^2 / sqrt(n (E5^2 + 0.01 E3^2)) with E the sums of (e_i / scale_i)^2: the step is
   accepted for err <= 1 */
static double dop853_error(const dop853 *s, double h) {
    const fw_maths_stepper *b = &s->base;
    double sum[2];
    s->kernel->errors(b->padded, dop_row[LAST + 1] - dop_row[LAST], s->e, s->list + dop_row[LAST],
                      b->rtol, b->tolerance, b->y, s->y_new, sum);
    double both = sum[0] + 0.01 * sum[1];
    if (both < 1e-290) return 0; /* its reciprocal would overflow; a NaN falls through */
    return h * sum[0] * sqrt(1 / (b->ode.controlled * both));
}

/* h / clamp(err^alpha err_old^-beta / 0.9, 1/6, 3), alpha = 1/8 - 0.2 beta, beta = 0.04: the
   proportional-integral controller with the constants of the cited book */
static double dop853_next_step(const dop853 *s, double h, double err) {
    const double beta = 0.04, safety = 0.9;
    double factor = pow(err, 0.125 - 0.2 * beta) / pow(s->err_old, beta) / safety;
    double next = h / fmin(3, fmax(1.0 / 6, factor));
    return s->rejected_last ? fmin(h, next) : next;
}

static fw_maths_ode_result dop853_step(fw_maths_stepper *b) {
    dop853 *s = (dop853 *)b;
    double h = fmin(b->h_next, b->h_max);
    for (int i = 1; i <= LAST; i++)
        s->list[dop_row[i]] = b->f; /* stage 0 leads every row */
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h);
        for (int i = 1; i < DOP_STAGES; i++) {
            dop853_combine(s, i, h, b->y, s->y_new);
            fw_maths_ode_evaluate(b, b->t + dop_c[i] * h, s->y_new, s->k + i * b->padded);
        }
        dop853_combine(s, LAST, h, b->y, s->y_new);
        double err = dop853_error(s, h);
        bool good = err <= 1; /* false for a NaN */
        if (good && fw_maths_ode_finish(b, t_new, s->y_new, s->f_new)) {
            b->h_next = dop853_next_step(s, h, err);
            s->err_old = fmax(err, 1e-4);
            s->rejected_last = false;
            fw_maths_ode_accept(b, t_new, &s->y_new, &s->f_new);
            return FW_ODE_STEP;
        }
        h = good || !isfinite(err) ? h / 4 : h / fmin(3, pow(err, 0.117) / 0.9);
        s->rejected_last = true;
        if (!fw_maths_ode_retry(b, h, &tries)) return isfinite(err) ? FW_ODE_SMALL : FW_ODE_NAN;
    }
}

/* Where a step is far beyond what its stages are stable for, and nothing of that mode is excited, as across a stage whose one way
   is stated, the twelve stages pass by their tolerance, and rounding grows up in the three that the dense output adds: derivatives
   a thousand times as large as any before. Cost: seven multiplications a component */
static bool dop853_grown_up(const dop853 *s) {
    const fw_maths_stepper *b = &s->base;
    const size_t width = (size_t)b->padded;
    const double much = 1e6, part = 1 / b->h; /* squares */
    const double *k = s->k + (LAST + 1) * width;
    for (size_t c = 0; c < (size_t)b->ode.n; c++) {
        const double p = k[c], q = k[width + c], r = k[2 * width + c],
                     least = part * b->tolerance[c], added = p * p + q * q + r * r;
        double seen = b->f_old[c] * b->f_old[c] + b->f[c] * b->f[c] + least * least;
        if (added <= much * seen) continue;
        for (size_t i = 1; i < DOP_STAGES; i++)
            seen += s->k[i * width + c] * s->k[i * width + c];
        if (!(added <= much * seen)) return true;
    }
    return false;
}

/* without these three stages: the quintic of places by u, v and accelerations at both ends, of what is no place the cubic.
   x^2 (1 - x)^2 (r4 + x r5) beside the cubic has the second derivatives 2 r4 and 2 (r4 + r5) at the ends */
static void dop853_by_ends(const fw_maths_stepper *b, size_t width, double *r) {
    const size_t n = (size_t)b->ode.positions;
    const double h = b->h, wild = 100;
    memset(r + 4 * width, 0, 4 * width * sizeof *r);
    for (size_t c = 0; c < n; c++) {
        const double way = b->y[c] - b->y_old[c], v0 = h * b->f_old[c], v1 = h * b->f[c],
                     first = h * h * b->f_old[c + n] - (6 * way - 4 * v0 - 2 * v1),
                     last = h * h * b->f[c + n] - (4 * v1 + 2 * v0 - 6 * way);
        /* accelerations of what is stiff are its rounding times its stiffness */
        if (fmax(fabs(first), fabs(last)) > wild * (fabs(way) + fabs(v0) + fabs(v1))) continue;
        r[4 * width + c] = 0.5 * first;
        r[5 * width + c] = 0.5 * (last - first);
    }
}

/* coefficients of the order-7 interpolant; the first four fit y and f at both ends, so that it
   stays continuous with projected end points */
static void dop853_prepare(fw_maths_stepper *b) {
    dop853 *s = (dop853 *)b;
    size_t width = (size_t)b->padded;
    double h = b->h, *r = s->row;
    const double *stage[DOP_DENSE];
    for (int i = LAST + 1; i < DOP_ALL; i++) {
        for (int j = dop_row[i]; j < dop_row[i + 1]; j++) {
            if (dop_a[j].stage == 0) s->list[j] = b->f_old;
            if (dop_a[j].stage == LAST) s->list[j] = b->f;
        }
        dop853_combine(s, i, h, b->y_old, s->y_new);
        fw_maths_ode_evaluate(b, b->t_old + dop_c[i] * h, s->y_new, s->k + (size_t)i * width);
    }
    for (size_t c = 0; c < (size_t)b->ode.n; c++) {
        double difference = b->y[c] - b->y_old[c], bend = h * b->f_old[c] - difference;
        r[c] = b->y_old[c];
        r[width + c] = difference;
        r[2 * width + c] = bend;
        r[3 * width + c] = difference - h * b->f[c] - bend;
    }
    for (int j = 0; j < DOP_DENSE; j++)
        stage[j] = dop_d_stage[j] == 0      ? b->f_old
                   : dop_d_stage[j] == LAST ? b->f
                                            : s->k + (size_t)dop_d_stage[j] * width;
    for (size_t m = 0; m < 4; m++)
        s->kernel->combine(b->padded, h, DOP_DENSE, dop_d[m], stage, s->zero, r + (4 + m) * width);
    if (dop853_grown_up(s)) dop853_by_ends(b, width, r);
    fw_ode_nested_tame(b, DOP_ROWS, r);
}

static void dop853_dense(const fw_maths_stepper *b, double theta, double *y) {
    fw_ode_nested_dense(b, DOP_ROWS, ((const dop853 *)b)->row, theta, y);
}

static void dop853_component(const fw_maths_stepper *b, int i, double wi, int j, double wj,
                             double theta, double *value, double *slope) {
    fw_ode_nested_component(b, DOP_ROWS, ((const dop853 *)b)->row, i, wi, j, wj, theta, value,
                            slope);
}

const fw_maths_stepper_row fw_maths_dop853_row = {
    .name = "dop853",
    .summary = "explicit Runge-Kutta 8(5,3) of Dormand and Prince, for tight tolerances",
    .order = 8,
    .dense_order = 7,
    .dense_order_u = 7,
    .create = dop853_create,
    .start = dop853_start,
    .step = dop853_step,
    .prepare = dop853_prepare,
    .dense = dop853_dense,
    .component = dop853_component,
};
