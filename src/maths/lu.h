/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LU factors of small dense matrices in the caller's memory. The libraries' own take memory in
   every call (GSL from malloc; OpenBLAS waits for ever when there is none), which a step must not.
 */
#ifndef FW_MATHS_LU_H
#define FW_MATHS_LU_H
#include <stdbool.h>

/* P a = L U in place, a (n x n) by rows, pivot (n); false: exactly singular, or not finite */
bool fw_maths_lu_factor(int n, double *a, int *pivot);
void fw_maths_lu_solve(int n, const double *a, const int *pivot,
                       double *x); /* x (n): right side in */
/* the same for re + i im */
bool fw_maths_lu_factor_complex(int n, double *re, double *im, int *pivot);
void fw_maths_lu_solve_complex(int n, const double *re, const double *im, const int *pivot,
                               double *x, double *y);

#endif
