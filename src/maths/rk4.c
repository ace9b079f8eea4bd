/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The classical Runge-Kutta method of order 4 with equal steps: the baseline, which knows no error.
     y(t + h) = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
   h is (t_end - t)/N with the smallest N that keeps h <= min(h_fixed, h_max); where the caller
   changes h_max on the way, the rest is divided anew. Dense output by Hermite interpolation.
   Source: Kutta 1901; Hairer, Norsett and Wanner I, II.1. Cost 4 evaluations. Tests: test_ode_*.c
 */
#include "maths/ode.h"
#include <math.h>

typedef struct rk4 {
    fw_maths_stepper base;
    double *y_new, *f_new, *k; /* (padded), (padded), (3 padded) k2 to k4 */
    double t_start, count;     /* steps from t_start to t_end */
    double done;
    double whole;  /* from start to t_end */
    double wanted; /* step that the division is made for */
} rk4;

static fw_status create(fw_arena *arena, const fw_maths_ode *ode, fw_maths_stepper **stepper) {
    rk4 *s = fw_arena_one(arena, rk4);
    FW_NEED(s);
    FW_NEED(s->y_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->f_new = fw_maths_ode_vector(arena, ode->n));
    FW_NEED(s->k = fw_arena_array(arena, double, 3 * (size_t)fw_maths_ode_padded(ode->n)));
    *stepper = &s->base;
    return FW_OK;
}

static double wanted(const fw_maths_stepper *b, double span) {
    return fmin(b->h_fixed > 0 ? b->h_fixed : span / 1000, b->h_max);
}

/* the way from here to t_end in equal steps of at most h */
static void divide(rk4 *s, double h) {
    fw_maths_stepper *b = &s->base;
    double span = b->t_end - b->t;
    s->t_start = b->t;
    s->wanted = h;
    s->count = fmax(1, ceil(span / h * (1 - 1e-12)));
    s->done = 0;
    b->h_next = span / s->count;
}

static void start(fw_maths_stepper *b) {
    rk4 *s = (rk4 *)b;
    s->whole = b->t_end - b->t;
    divide(s, wanted(b, s->whole));
}

static fw_maths_ode_result step(fw_maths_stepper *b) {
    rk4 *s = (rk4 *)b;
    int n = b->ode.n, width = b->padded;
    if (wanted(b, s->whole) != s->wanted) divide(s, wanted(b, s->whole));
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

static void prepare(fw_maths_stepper *s) {
    (void)s;
}

const fw_maths_stepper_row fw_maths_rk4_row = {
    .name = "rk4",
    .summary = "classical Runge-Kutta of order 4 with equal steps and no error control: a baseline",
    .order = 4,
    .dense_order = 3,
    .dense_order_u = 4,
    .fixed_step = true,
    .create = create,
    .start = start,
    .step = step,
    .prepare = prepare,
    .dense = fw_maths_ode_hermite,
    .component = fw_maths_ode_hermite_component,
};
