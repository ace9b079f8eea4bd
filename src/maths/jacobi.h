/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues of a small symmetric matrix without LAPACK, whose first product of a matrix and a
   vector may wait for 128 MiB of its own. */
#ifndef FW_MATHS_JACOBI_H
#define FW_MATHS_JACOBI_H
#include <stdbool.h>

/* a (n x n, symmetric, used up) = sum of value[k] v_k v_k^T: value (n) ascending, v_k in row k of
   vector (n x n). false: not finite, or not found */
bool fw_maths_jacobi(int n, double *a, double *value, double *vector);

#endif
