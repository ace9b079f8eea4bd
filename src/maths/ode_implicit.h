/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What implicit integrators share: the Jacobian, and systems (sigma I - J) x = r. */
#ifndef FW_MATHS_ODE_IMPLICIT_H
#define FW_MATHS_ODE_IMPLICIT_H
#include "maths/ode.h"

/* j (n x controlled) by rows at (t, y) with f = f(t, y): the problem's own, or by differences with
   one evaluation per column; work: 2 padded. false: not finite */
bool fw_maths_ode_jacobian(fw_maths_stepper *s, double t, const double *y, const double *f,
                           double *j, double *work);

/* (sigma I - J) x = r for the controlled components, sigma real or complex */
typedef struct fw_maths_ode_shifted {
    bool half; /* u' = v was eliminated: (sigma^2 - sigma K_v - K_u) is factored */
    int size;
    double a, b;      /* sigma = a + i b */
    double *re, *im;  /* (size x size); im NULL: sigma is real */
    double *right[2]; /* (size) */
    int *pivot;       /* (size) */
} fw_maths_ode_shifted;

fw_status fw_maths_ode_shifted_new(fw_arena *arena, const fw_maths_ode *ode, bool complex,
                                   fw_maths_ode_shifted *m);
bool fw_maths_ode_shifted_factor(fw_maths_stepper *s, const double *j, double a, double b,
                                 fw_maths_ode_shifted *m);
/* x, y (controlled): real and imaginary part of r in, of the solution out; y NULL when sigma is
   real */
void fw_maths_ode_shifted_solve(const fw_maths_stepper *s, const double *j,
                                const fw_maths_ode_shifted *m, double *x, double *y);

#endif
