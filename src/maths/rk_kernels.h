/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The vector work of explicit Runge-Kutta steps, for the vector units of the processor that it runs
   on. Vectors are padded with zeros to a multiple of 8 and aligned to 64 bytes. Every variant does
   the same operations in the same order on each component, so all give the same bits. */
#ifndef FW_MATHS_RK_KERNELS_H
#define FW_MATHS_RK_KERNELS_H
#include <stddef.h>

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
