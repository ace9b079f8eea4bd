/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues of a dense matrix that is not symmetric (LAPACK). */
#ifndef FW_MATHS_EIGEN_H
#define FW_MATHS_EIGEN_H
#include "base/arena.h"
#include "base/status.h"

/* a x = value x for any a (n x n, row-major), overwritten; re, im (n), conjugate pairs together,
   the one with im > 0 first; vector (n x n): row k is the eigenvector of a real value; of a pair k,
   k + 1 the rows are real and imaginary part of that of k. FW_SOLVER: not finite, or not found. */
fw_status fw_maths_eigen_general(fw_arena *arena, int n, double *a, double *re, double *im,
                                 double *vector);

#endif
