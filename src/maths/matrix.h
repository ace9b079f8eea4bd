/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear algebra, all of it. Dense: what is small is factored here in the caller's memory, the rest by LAPACK; matrices are
   row-major unless said otherwise (dense.c). Sparse, further below: large symmetric systems with few entries, indefinite ones
   too: those of mechanisms, whose joint forces stand beside the displacements (sparse.c, sparse_order.c; why this is code of
   ours: docs/decisions/0101-sparse-rest.md). */
#ifndef FW_MATHS_MATRIX_H
#define FW_MATHS_MATRIX_H
#include "base/arena.h"
#include "base/status.h"
#include <stdbool.h>

/* ---- one answer, memory from the arena ---- */

/* solves a x = b for a symmetric, possibly singular a: LU first, then minimum-norm least squares
   where that fails. *consistent says whether |a x - b| <= 1e-9 (|a| |x| + |b|): false means that
   there is no solution, and nothing is hidden behind a rank decision. x may be b. */
fw_status fw_maths_dense_solve_symmetric(fw_arena *arena, int n, const double *a, const double *b,
                                         double *x, bool *consistent);

/* a x = value x for any a (n x n, row-major), overwritten; re, im (n), conjugate pairs together,
   the one with im > 0 first; vector (n x n): row k is the eigenvector of a real value; of a pair k,
   k + 1 the rows are real and imaginary part of that of k. FW_SOLVER: not finite, or not found. */
fw_status fw_maths_eigen_general(fw_arena *arena, int n, double *a, double *re, double *im,
                                 double *vector);

/* a = U diag(sigma) V^T. `a` (rows x columns) has its rows contiguous; sigma (min(rows, columns))
   from the largest down; u: left vector i at u + i rows; v: right vector i at v + i columns, all
   `columns` of them, so that those behind the rank span the null space. */
typedef struct fw_maths_singular {
    int rows, columns;
    double *sigma, *u, *v;
} fw_maths_singular;
/* rows 0 gives the unit matrix in v. FW_SOLVER where it does not converge or `a` is not finite. */
fw_status fw_maths_singular_new(fw_arena *arena, int rows, int columns, const double *a,
                                fw_maths_singular *out);

/* ---- small, in the caller's memory: LAPACK's first product may wait for ever where memory is
   short, which a step must not ---- */

/* solves a x = x for the first `columns` columns of x, rows exchanged for size; false: singular.
   *det: the determinant of a */
bool fw_maths_solve3(const double a[3][3], int columns, double x[3][3], double *det);

/* P a = L U in place, a (n x n) by rows, pivot (n); false: exactly singular, or not finite */
bool fw_maths_lu_factor(int n, double *a, int *pivot);
/* x (n): right side in. within (n x 4) or NULL: of each row of the factors the first and behind the last entry that is
   not 0; two places are the caller's */
void fw_maths_lu_solve(int n, const double *a, const int *pivot, const int *within, double *x);
/* the same for re + i im */
bool fw_maths_lu_factor_complex(int n, double *re, double *im, int *pivot);
void fw_maths_lu_solve_complex(int n, const double *re, const double *im, const int *pivot,
                               const int *within, double *x, double *y);

/* a (n x n, symmetric, used up) = sum of value[k] v_k v_k^T: value (n) ascending, v_k in row k of
   vector (n x n). false: not finite, or not found */
bool fw_maths_jacobi(int n, double *a, double *value, double *vector);

/* ---- LAPACK in loops that must not allocate: workspace comes once from an arena, matrices are
   column-major with the leading dimension equal to the number of rows unless said otherwise, and
   every function answers whether LAPACK succeeded. Inputs must be finite: some of these loop for
   ever on a NaN ---- */

/* before the first use: where OpenBLAS is the BLAS, one thread for the whole process, and
   FW_NOMEM where its buffer cannot be had, for which it would wait for ever. The functions that
   give workspace do it by themselves. */
fw_status fw_maths_lapack_ready(void);

typedef struct fw_maths_lapack_space { /* of one factorisation of one size */
    double *work;
    int size;
} fw_maths_lapack_space;

/* a (m x n, used up) = u diag(s) vt, s (min(m, n)) descending. u (m x min). vt: `full` (n x n),
   else (min x n) */
fw_status fw_maths_svd_space(fw_arena *arena, int m, int n, bool full,
                             fw_maths_lapack_space *space);
bool fw_maths_svd(int m, int n, bool full, double *a, double *s, double *u, double *vt,
                  const fw_maths_lapack_space *space);

/* symmetric a (n x n, lower part read) = w diag(value) w^T: values ascending, a becomes w */
fw_status fw_maths_eigen_space(fw_arena *arena, int n, fw_maths_lapack_space *space);
bool fw_maths_eigen(int n, double *a, double *value, const fw_maths_lapack_space *space);

/* a (m x n) P = Q R with column pivoting: a keeps R above the diagonal and the reflectors below,
   tau (min(m, n)); column j of a P was column pivot[j] of a */
fw_status fw_maths_qr_space(fw_arena *arena, int m, int n, fw_maths_lapack_space *space);
bool fw_maths_qr(int m, int n, double *a, int *pivot, double *tau,
                 const fw_maths_lapack_space *space);
/* x (m) = Q x, or Q^T x; n the columns that were factored */
bool fw_maths_qr_apply(bool transposed, int m, int n, const double *a, const double *tau, double *x,
                       const fw_maths_lapack_space *space);
/* x (n) = R^-1 x, or R^-T x, of the upper triangle of a with leading dimension ld */
bool fw_maths_triangle_solve(bool transposed, int n, const double *a, int ld, double *x);

/* symmetric indefinite a (n x n, lower part) = L D L^T, Bunch and Kaufman; pivot (n) */
fw_status fw_maths_indefinite_space(fw_arena *arena, int n, fw_maths_lapack_space *space);
bool fw_maths_indefinite(int n, double *a, int *pivot, const fw_maths_lapack_space *space);
bool fw_maths_indefinite_solve(int n, const double *a, const int *pivot, double *x);

/* positive definite a (n x n, lower part) = L L^T; false: not positive */
bool fw_maths_cholesky(int n, double *a);
bool fw_maths_cholesky_solve(int n, const double *a, double *x);

/* a (n x n) = P L U; x (n x count) = a^-1 x, or a^-T x. false: exactly singular */
bool fw_maths_lapack_lu(int n, double *a, int *pivot);
bool fw_maths_lapack_lu_solve(bool transposed, int n, int count, const double *a, const int *pivot,
                              double *x);

/* Gaussian elimination of a (m x n, row-major, used up) with complete pivoting, up to the first
   pivot that is 0 or below `stop` times the largest. Returns the pivots taken; row (m) and column
   (n) are the order that was found; *last the smallest pivot taken over the first. */
int fw_maths_complete_pivoting(int m, int n, double *a, int *row, int *column, double stop,
                               double *last);

/* ---- small linear programmes: some dozens of unknowns and rows ---- */

/* Minimises  c x + penalty t  over x >= 0 and t >= 0, where

     A x - t <= b   in the first `nsoft` rows,  A x <= b  in the others, whose b is not below 0

   t is what the worst soft row has to be exceeded by: 0 where all can be held and the penalty is
   large. */
typedef struct fw_maths_linear_programme {
    int n, m, nsoft;
    const double *a; /* (m x n) */
    const double *b; /* (m) */
    const double *c; /* (n) not below 0 */
    double penalty;  /* above 0 */
} fw_maths_linear_programme;

/* x (n), *t. *solved false: round-off went in circles, x and t are of no use. Arrays are given back
   to the arena. */
fw_status fw_maths_linear_programme_solve(fw_arena *arena, const fw_maths_linear_programme *p,
                                          double *x, double *t, bool *solved);

/* ======== sparse ======== */

enum { FW_MATHS_NONE = -1 };

/* ---- P A P^T = L D L^T ---- */

/* Unknowns stand in groups that are eliminated together. Unknown i belongs to first[i], or to
   second[i] where that is eliminated before (FW_MATHS_NONE: there is no other). Two groups are coupled
   where an entry may stand between their unknowns. */
typedef struct fw_maths_sparse_shape {
    int n, groups, couplings;
    const int *first, *second; /* (n) */
    const int *coupled;        /* (2 couplings) */
} fw_maths_sparse_shape;

/* sparse_order.c: group (groups) in order, how many of those before it each waits for (children, zeroed by the
   caller), and the place of each */
fw_status fw_maths_sparse_order(fw_arena *arena, const fw_maths_sparse_shape *shape, int *group,
                                int *children, int *place);

typedef struct fw_maths_sparse fw_maths_sparse;

/* the order of elimination; entries may come */
fw_status fw_maths_sparse_new(fw_arena *arena, const fw_maths_sparse_shape *shape,
                              fw_maths_sparse **out);
void fw_maths_sparse_clear(fw_maths_sparse *s); /* no entries */
/* adds to entry (i, j), which is entry (j, i). Memory that is short is told by the factorisation */
void fw_maths_sparse_add(fw_maths_sparse *s, int i, int j, double value);

typedef struct
    fw_maths_sparse_signs { /* of the pivots, which are those of the eigenvalues (Sylvester) */
    int negative, nothing;  /* nothing: at most `nothing` of the factorisation in size */
} fw_maths_sparse_signs;
/* Entries of A are of order one; what is no larger than `nothing` where a pivot is wanted counts as 0,
   and its unknown stays 0 in what is solved. FW_SOLVER: not finite. FW_CANCELLED */
fw_status fw_maths_sparse_factor(fw_maths_sparse *s, double nothing, fw_maths_sparse_signs *signs);
/* A x = x (n), refined once; work (2 n) */
void fw_maths_sparse_solve(const fw_maths_sparse *s, double *x, double *work);
void fw_maths_sparse_product(const fw_maths_sparse *s, const double *x, double *y); /* y = A x */
/* first unknown whose pivot was nothing, from `from` on; FW_MATHS_NONE: there is no more */
int fw_maths_sparse_nothing(const fw_maths_sparse *s, int from);

/* ---- eigenvalues: lanczos.c ---- */

/* Those of a symmetric operator that are largest in size, and their vectors (count x n), orthonormal,
   from the largest down. `apply` may be nothing but on a subspace, which `apply` itself leads to.
   known: vectors (nknown x n) found before, which are left out. *found: how many came within 1e-10 of their size, at most
   `count`. The arena keeps nothing. */
typedef struct fw_maths_operator {
    int n;
    void (*apply)(void *context, const double *x, double *y);
    void *context;
} fw_maths_operator;
fw_status fw_maths_lanczos(fw_arena *arena, const fw_maths_operator *op, int count, int nknown,
                           const double *known, double *value, double *vector, int *found);

#endif
