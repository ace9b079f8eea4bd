/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems with known solutions, and a loop over the integrators' table. */
#ifndef FW_TEST_ODE_PROBLEMS_H
#define FW_TEST_ODE_PROBLEMS_H
#include "maths/ode.h"
#include "test.h"
#include <stdlib.h>

typedef struct problem {
    fw_maths_ode ode;
    void (*exact)(double t, double *y);
} problem;

/* first order: y1' = y1 cos t, y2' = -y2^2, quadrature (y1 y2)' */
static inline void first_rhs(void *context, double t, const double *y, double *f) {
    if (context) ++*(long *)context;
    f[0] = y[0] * cos(t);
    f[1] = -y[1] * y[1];
    f[2] = y[0] * cos(t) * y[1] - y[0] * y[1] * y[1];
}
static inline void first_exact(double t, double *y) {
    y[0] = exp(sin(t));
    y[1] = 1 / (1 + t);
    y[2] = y[0] * y[1];
}

/* second order: u1'' = -u1, u2'' = -4 u2 + 3 cos t, quadrature of v1^2 + t */
static inline void second_rhs(void *context, double t, const double *y, double *f) {
    if (context) ++*(long *)context;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = -y[0];
    f[3] = -4 * y[1] + 3 * cos(t);
    f[4] = y[2] * y[2] + t;
}
static inline void second_exact(double t, double *y) {
    y[0] = cos(t);
    y[1] = cos(t) + 0.25 * sin(2 * t);
    y[2] = -sin(t);
    y[3] = -sin(t) + 0.5 * cos(2 * t);
    y[4] = t / 2 - sin(2 * t) / 4 + t * t / 2;
}

static const problem first_order = {{.rhs = first_rhs, .n = 3, .controlled = 2}, first_exact};
static const problem second_order = {{.rhs = second_rhs, .n = 5, .controlled = 4, .positions = 2},
                                     second_exact};

/* a pendulum of length 1 under g = 9.81 in x and y, index 1; its constraint and its projection */
static const double pendulum_g = 9.81;
static inline void pendulum_rhs(void *context, double t, const double *y, double *f) {
    (void)t;
    if (context) ++*(long *)context;
    double r2 = y[0] * y[0] + y[1] * y[1];
    double lambda = (y[2] * y[2] + y[3] * y[3] - pendulum_g * y[1]) / r2;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = -lambda * y[0];
    f[3] = -lambda * y[1] - pendulum_g;
}
static inline bool pendulum_project(void *context, double t, double *y, double *f) {
    double r = hypot(y[0], y[1]);
    y[0] /= r;
    y[1] /= r;
    double radial = y[0] * y[2] + y[1] * y[3];
    y[2] -= radial * y[0];
    y[3] -= radial * y[1];
    pendulum_rhs(context, t, y, f);
    return true;
}

static const double all_atol[8] = {1, 1, 1, 1, 1, 1, 1, 1};

/* atol = rtol for every component; atol is 8 numbers that outlive the stepper */
static inline fw_maths_stepper *new_stepper(fw_arena *arena, const fw_maths_stepper_row *row,
                                            const fw_maths_ode *ode, double rtol) {
    fw_maths_stepper *s = NULL;
    double *atol = fw_arena_array(arena, double, 8);
    assert_non_null(atol);
    for (int i = 0; i < 8; i++)
        atol[i] = rtol * all_atol[i];
    assert_int_equal(fw_maths_stepper_new(arena, row, ode, rtol, atol, &s), FW_OK);
    return s;
}

static inline fw_maths_ode_result run_to_end(fw_maths_stepper *s) {
    fw_maths_ode_result result = FW_ODE_STEP;
    for (long i = 0; i < 2000000 && s->t < s->t_end && result == FW_ODE_STEP; i++)
        result = fw_maths_stepper_step(s);
    return result;
}

/* rows that can do this problem */
#define FOR_EACH_ROW(row, problem)                                                                 \
    for (size_t count_ = 0, i_ = 0, pass_ = (fw_maths_stepper_table(&count_), 0); i_ < count_;     \
         i_++, pass_ = 0)                                                                          \
        for (const fw_maths_stepper_row *row = fw_maths_stepper_table(&count_)[i_];                \
             pass_ == 0 && !(row->second_order && (problem).ode.positions == 0); pass_ = 1)

#endif
