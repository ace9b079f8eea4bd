/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decompositions of small dense matrices (LAPACK): singular values, symmetric and general
   eigenproblems. Matrices are row-major; what is not finite is refused with FW_SOLVER, because
   LAPACK may loop on it. Working memory is taken from the arena and returned. */
#ifndef FW_MATHS_EIGEN_H
#define FW_MATHS_EIGEN_H
#include "base/arena.h"
#include "base/status.h"

/* a = left diag(sigma) right: a (m x n), overwritten; sigma (min(m, n)) descending; left (m x m),
   its columns the left singular vectors; right (n x n), its rows the right singular vectors, also
   those of the null space. m or n may be 0. */
fw_status fw_svd(fw_arena *arena, int m, int n, double *a, double *sigma, double *left,
                 double *right);

/* a x = value x for a symmetric a (n x n), of which the lower triangle is read; value (n)
   ascending; a is replaced by the orthonormal eigenvectors, one per row */
fw_status fw_eigen_symmetric(fw_arena *arena, int n, double *a, double *value);

/* a x = value x for any a (n x n), overwritten; re, im (n), conjugate pairs together, the one with
   im > 0 first; vector (n x n): row k is the eigenvector of a real value; of a pair k, k + 1 the
   rows are real and imaginary part of that of k */
fw_status fw_eigen_general(fw_arena *arena, int n, double *a, double *re, double *im,
                           double *vector);

#endif
