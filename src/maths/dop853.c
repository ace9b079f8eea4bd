/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DOP853 of Dormand and Prince: explicit Runge-Kutta of order 8 in 12 stages with error estimates
   of order 5 and 3, PI step control, and dense output of order 7 from three more stages.
     Y_i = y + h sum_j a_ij f(t + c_j h, Y_j),   y(t + h) = y + h sum_i b_i f(t + c_i h, Y_i)
   Source: Hairer, Norsett and Wanner, Solving ODEs I, 2nd ed., II.5 and II.10. Cost of a step of n
   components: 12 right-hand sides and 74 n multiplications; of the dense output 3 and 72 n.
   Tests: test_ode_rk.c (coefficients), test_ode_*.c */
#include "maths/ode_tables.h"
#include "maths/ode.h"
#include "maths/ode_steps.h"
#include <math.h>

enum { ENTRIES = sizeof dop_a / sizeof dop_a[0], ROWS = 8, LAST = DOP_STAGES };

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

static fw_status create(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper) {
    size_t width = (size_t)fw_maths_ode_padded(ode->n);
    dop853 *s = fw_arena_one(arena, dop853);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->zero = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->k = fw_arena_array(arena, double, DOP_ALL *width));
    FW_NEED(s->row = fw_arena_array(arena, double, ROWS *width));
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

static void start(fw_maths_stepper *base) {
    dop853 *s = (dop853 *)base;
    s->err_old = 1e-4;
    s->rejected_last = false;
    base->h_next = fw_maths_ode_first_step(base, 8, s->k);
}

/* out = y + h sum_j a_ij k_j for row i of the table */
static void combine(const dop853 *s, int i, double h, const double *y, double *out) {
    int first = dop_row[i];
    s->kernel->combine(s->base.padded, h, dop_row[i + 1] - first, s->a + first, s->list + first, y,
                       out);
}

/* err = |h| E5^2 / sqrt(n (E5^2 + 0.01 E3^2)) with E the sums of (e_i / scale_i)^2: the step is
   accepted for err <= 1 */
static double error(const dop853 *s, double h) {
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
static double next_step(const dop853 *s, double h, double err) {
    const double beta = 0.04, safety = 0.9;
    double factor = pow(err, 0.125 - 0.2 * beta) / pow(s->err_old, beta) / safety;
    double next = h / fmin(3, fmax(1.0 / 6, factor));
    return s->rejected_last ? fmin(h, next) : next;
}

static fw_maths_ode_result step(fw_maths_stepper *b) {
    dop853 *s = (dop853 *)b;
    double h = fmin(b->h_next, b->h_max);
    for (int i = 1; i <= LAST; i++)
        s->list[dop_row[i]] = b->f; /* stage 0 leads every row */
    for (int tries = 0;;) {
        double t_new = fw_maths_ode_target(b, &h);
        for (int i = 1; i < DOP_STAGES; i++) {
            combine(s, i, h, b->y, s->y_new);
            fw_maths_ode_evaluate(b, b->t + dop_c[i] * h, s->y_new, s->k + i * b->padded);
        }
        combine(s, LAST, h, b->y, s->y_new);
        double err = error(s, h);
        bool good = err <= 1; /* false for a NaN */
        if (good && fw_maths_ode_finish(b, t_new, s->y_new, s->f_new)) {
            b->h_next = next_step(s, h, err);
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

/* coefficients of the order-7 interpolant; the first four fit y and f at both ends, so that it
   stays continuous with projected end points */
static void prepare(fw_maths_stepper *b) {
    dop853 *s = (dop853 *)b;
    size_t width = (size_t)b->padded;
    double h = b->h, *r = s->row;
    const double *stage[DOP_DENSE];
    for (int i = LAST + 1; i < DOP_ALL; i++) {
        for (int j = dop_row[i]; j < dop_row[i + 1]; j++) {
            if (dop_a[j].stage == 0) s->list[j] = b->f_old;
            if (dop_a[j].stage == LAST) s->list[j] = b->f;
        }
        combine(s, i, h, b->y_old, s->y_new);
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
    fw_ode_nested_tame(b, ROWS, r);
}

static void dense(const fw_maths_stepper *b, double theta, double *y) {
    fw_ode_nested_dense(b, ROWS, ((const dop853 *)b)->row, theta, y);
}

static void component(const fw_maths_stepper *b, int i, double wi, int j, double wj, double theta,
                      double *value, double *slope) {
    fw_ode_nested_component(b, ROWS, ((const dop853 *)b)->row, i, wi, j, wj, theta, value, slope);
}

const fw_maths_stepper_row fw_maths_dop853_row = {
    .name = "dop853",
    .summary = "explicit Runge-Kutta 8(5,3) of Dormand and Prince, for tight tolerances",
    .order = 8,
    .dense_order = 7,
    .dense_order_u = 7,
    .create = create,
    .start = start,
    .step = step,
    .prepare = prepare,
    .dense = dense,
    .component = component,
};
