/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dormand and Prince 5(4): explicit Runge-Kutta in 7 stages of which the last is the first of the
   next step, error estimate of order 4, PI step control, and dense output of order 4 that costs no
   evaluation.
     Y_i = y + h sum_j a_ij f(t + c_j h, Y_j),   y(t + h) = Y_7,   e = h sum_i e_i f(t + c_i h, Y_i)
   Source: Hairer, Norsett and Wanner, Solving ODEs I, 2nd ed., II.5 table 5.2 and II.6 (dense
   output), II.4 (control). Cost of a step: 6 right-hand sides, one more with a projection, and
   32 n multiplications. Tests: test_ode_rk.c (coefficients), test_ode_*.c */
#include "maths/ode_tables.h"
#include "maths/ode.h"
#include "maths/ode_steps.h"
#include <math.h>
#include <string.h>

enum { ROWS = 5 };

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

static fw_status create(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper) {
    size_t width = (size_t)fw_maths_ode_padded(ode->n);
    dopri5 *s = fw_arena_one(arena, dopri5);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->zero = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->k = fw_arena_array(arena, double, DOPRI_STAGES *width));
    FW_NEED(s->row = fw_arena_array(arena, double, ROWS *width));
    s->kernel = fw_maths_rk_kernels_best();
    for (size_t i = 0; i < DOPRI_STAGES; i++) {
        s->stage[i] = s->k + i * width;
        s->e[2 * i] = dopri_e[i];
    }
    *stepper = &s->base;
    return FW_OK;
}

static void start(fw_maths_stepper *base) {
    dopri5 *s = (dopri5 *)base;
    s->err_old = 1e-4;
    s->rejected_last = false;
    base->h_next = fw_maths_ode_first_step(base, 5, s->k);
}

/* h / clamp(err^(0.2 - 0.75 beta) err_old^-beta / 0.9, 0.1, 5) with beta = 0.04 */
static double next_step(const dopri5 *s, double h, double err) {
    const double beta = 0.04, safety = 0.9;
    double factor = pow(err, 0.2 - 0.75 * beta) / pow(s->err_old, beta) / safety;
    double next = h / fmin(5, fmax(0.1, factor));
    return s->rejected_last ? fmin(h, next) : next;
}

/* all stages and y_new = Y_7 of a step h; gives the error in units of the tolerance */
static double attempt(dopri5 *s, double h) {
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

static fw_maths_ode_result step(fw_maths_stepper *b) {
    dopri5 *s = (dopri5 *)b;
    double h = fmin(b->h_next, b->h_max);
    s->stage[0] = b->f;
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h);
        double err = attempt(s, h);
        bool good = err <= 1, done = good; /* false for a NaN */
        if (good && b->ode.project) {
            done = fw_maths_ode_finish(b, t_new, s->y_new, s->f_new);
        } else if (good) {
            memcpy(s->f_new, s->stage[DOPRI_STAGES - 1], (size_t)b->ode.n * sizeof(double));
            done =
                fw_maths_ode_finite(s->f_new, b->ode.n) && fw_maths_ode_finite(s->y_new, b->ode.n);
        }
        if (done) {
            b->h_next = next_step(s, h, err);
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
static void prepare(fw_maths_stepper *b) {
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
    fw_ode_nested_tame(b, ROWS, r);
}

static void dense(const fw_maths_stepper *b, double theta, double *y) {
    fw_ode_nested_dense(b, ROWS, ((const dopri5 *)b)->row, theta, y);
}

static void component(const fw_maths_stepper *b, int i, double wi, int j, double wj, double theta,
                      double *value, double *slope) {
    fw_ode_nested_component(b, ROWS, ((const dopri5 *)b)->row, i, wi, j, wj, theta, value, slope);
}

const fw_maths_stepper_row fw_maths_dopri5_row = {
    .name = "dopri5",
    .summary = "explicit Runge-Kutta 5(4) of Dormand and Prince, for loose tolerances",
    .order = 5,
    .dense_order = 4,
    .dense_order_u = 4,
    .create = create,
    .start = start,
    .step = step,
    .prepare = prepare,
    .dense = dense,
    .component = component,
};
