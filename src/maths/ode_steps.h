/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What implicit integrators share: the Jacobian, and systems (sigma I - J) x = r. */
#ifndef FW_MATHS_ODE_STEPS_H
#define FW_MATHS_ODE_STEPS_H
#include "maths/ode.h"
#include <stddef.h>

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

/* The vector work of explicit Runge-Kutta steps, for the vector units of the processor that it runs
   on. Vectors are padded with zeros to a multiple of 8 and aligned to 64 bytes. Every variant does
   the same operations in the same order on each component, so all give the same bits. */

typedef struct fw_maths_rk_kernels {
    const char *name;
    int (*usable)(void); /* on this processor */
    /* out = y + h sum_j a_j k_j, j < count */
    void (*combine)(int n, double h, int count, const double *a, const double *const *k,
                    const double *y, double *out);
    /* sum_i = sum_c ((sum_j e_2j+i k_j[c]) / (tolerance[c] + rtol max(|y[c]|, |z[c]|)))^2 for i in
       {0, 1}: two error estimates at once, their weights side by side in e (2 count) */
    void (*errors)(int n, int count, const double *e, const double *const *k, double rtol,
                   const double *tolerance, const double *y, const double *z, double sum[2]);
} fw_maths_rk_kernels;

/* narrowest first */
const fw_maths_rk_kernels *fw_maths_rk_kernels_table(size_t *count);
const fw_maths_rk_kernels *fw_maths_rk_kernels_best(void);

#endif
