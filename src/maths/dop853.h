/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DOP853: explicit Runge-Kutta 8(5,3) for y' = f(t, y), PI step control, dense output of order 7,
   and a hook that moves every accepted state back onto a manifold. */
#ifndef FW_MATHS_DOP853_H
#define FW_MATHS_DOP853_H
#include "base/arena.h"
#include "base/status.h"
#include <stdbool.h>

typedef struct fw_ode { /* the problem */
    void *context;
    void (*rhs)(void *context, double t, const double *y, double *f);
    /* moves y (n) onto the manifold and sets f = f(t, y) there; false: the step is not acceptable.
       NULL: no manifold */
    bool (*project)(void *context, double t, double *y, double *f);
    int n;          /* components */
    int controlled; /* the first ones count in the error; the rest are quadratures */
} fw_ode;

typedef enum fw_ode_result { FW_ODE_STEP, FW_ODE_SMALL, FW_ODE_NAN } fw_ode_result;

typedef struct fw_dop853 {
    fw_ode ode;
    double rtol, h_max;
    const double *atol; /* (n) */
    double t_old, t, h, h_next, t_end;
    double *y_old, *y, *f; /* (n) at t_old, t, and f(t, y) */
    double *y_new, *f_new; /* (n) scratch */
    double *k;             /* (16 x n) stages; row 0 is f(t_old, y_old), row 12 f(t, y) */
    double *dense;         /* (8 x n) */
    bool dense_ready, rejected_last;
    double err_old;
    long steps, rejected, rhs;
} fw_dop853;

/* memory for n components; atol (n) must live as long as the integrator */
fw_status fw_dop853_new(fw_arena *arena, const fw_ode *ode, double rtol, const double *atol,
                        fw_dop853 **integrator);
/* sets the start; y (n) should lie on the manifold. Chooses the first step. */
void fw_dop853_start(fw_dop853 *s, double t, const double *y, double t_end);
/* one accepted step, with as many rejections as it takes; ends exactly at t_end */
fw_ode_result fw_dop853_step(fw_dop853 *s);
/* the dense output of the last step: prepare once (three evaluations), then read at
   theta = (t - t_old)/h in [0, 1]. Fits y and f at both ends. */
void fw_dop853_dense_prepare(fw_dop853 *s);
void fw_dop853_dense(const fw_dop853 *s, double theta, double *y);
/* value and derivative with respect to theta of one component given by its 8 coefficients */
void fw_dop853_dense_value(const double r[8], double theta, double *value, double *slope);

#endif
