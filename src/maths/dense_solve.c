/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/dense.h"
#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* |a x - b| against the sizes of its terms, in the maximum norm; allowed 1e-9 */
static bool solves(int n, const double *a, const double *x, const double *b) {
    double worst = 0, size = 0;
    for (int i = 0; i < n; i++) {
        double sum = -b[i], terms = fabs(b[i]);
        for (int j = 0; j < n; j++) {
            double term = a[(size_t)i * (size_t)n + (size_t)j] * x[j];
            sum += term;
            terms += fabs(term);
        }
        worst = fmax(worst, fabs(sum));
        size = fmax(size, terms);
        if (isnan(sum)) return false;
    }
    return worst <= 1e-9 * size;
}

static bool finite_all(const double *value, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += 0 * value[i];
    return sum == 0;
}

static bool bounded(int n, const double *a, const double *x, const double *b) {
    double largest_a = 0, largest_x = 0, largest_b = 0;
    for (int i = 0; i < n * n; i++)
        largest_a = fmax(largest_a, fabs(a[i]));
    for (int i = 0; i < n; i++) {
        largest_x = fmax(largest_x, fabs(x[i]));
        largest_b = fmax(largest_b, fabs(b[i]));
    }
    return largest_a * largest_x <= 1e9 * largest_b;
}

static fw_status least_squares(fw_arena *arena, int n, const double *a, double *x) {
    size_t m = (size_t)n;
    int rank = 0, ask_integers = 0;
    double ask = 0, *copy, *singular, *work;
    lapack_int *integers;
    FW_TRY(fw_maths_lapack_ready());
    FW_NEED(copy = fw_arena_array(arena, double, m *m));
    FW_NEED(singular = fw_arena_array(arena, double, m));
    memcpy(copy, a, m * m * sizeof *a);
    int info = LAPACKE_dgelsd_work(LAPACK_COL_MAJOR, n, n, 1, copy, n, x, n, singular, 1e-12, &rank,
                                   &ask, -1, &ask_integers);
    if (info != 0 || !(ask > 0) || ask > 1e8) return FW_SOLVER;
    FW_NEED(work = fw_arena_array(arena, double, (size_t)ask));
    FW_NEED(integers = fw_arena_array(arena, lapack_int, (size_t)(ask_integers + 1)));
    info = LAPACKE_dgelsd_work(LAPACK_COL_MAJOR, n, n, 1, copy, n, x, n, singular, 1e-12, &rank,
                               work, (int)ask, integers);
    return info == 0 ? FW_OK : FW_SOLVER;
}

/* a x = b; a (n x n) symmetric, b (n), x (n), any unit that balances the rows. Error: round-off
   times the condition; a singular consistent system gives the minimum-norm x. Cost 2 n^3/3, and a
   singular value decomposition when that fails. LU by fw_maths_lu_factor: some BLAS wait for
   ever when memory is short. Source: LAPACK dgelsd. Test: test_dense.c. */
fw_status fw_maths_dense_solve_symmetric(fw_arena *arena, int n, const double *a, const double *b,
                                         double *x, bool *consistent) {
    size_t m = n > 0 ? (size_t)n : 0;
    *consistent = finite_all(a, m * m) && finite_all(b, m); /* LAPACK may loop on a NaN */
    if (m == 0 || !*consistent) return FW_OK;
    double *copy, *right;
    int *pivot;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(right = fw_arena_array(arena, double, m));
    FW_NEED(copy = fw_arena_array(arena, double, m *m));
    FW_NEED(pivot = fw_arena_array(arena, int, m));
    memcpy(right, b, m * sizeof *b);
    memcpy(copy, a, m * m * sizeof *a);
    memcpy(x, right, m * sizeof *x);
    fw_status status = FW_OK;
    bool regular = fw_maths_lu_factor(n, copy, pivot);
    if (regular) fw_maths_lu_solve(n, copy, pivot, x);
    if (!regular || !solves(n, a, x, right) || !bounded(n, a, x, right)) {
        memcpy(x, right, m * sizeof *x);
        status = least_squares(arena, n, a, x);
        *consistent = status == FW_OK && solves(n, a, x, right);
        if (status == FW_SOLVER) status = FW_OK;
    }
    fw_arena_rewind(arena, mark);
    return status;
}

/* LAPACK's answer to a query for the size of its work array; 0: nothing sensible */
static size_t asked(int info, double size) {
    return info == 0 && size >= 1 && size < 1e9 ? (size_t)size : 0;
}

static void transpose_square(int n, double *a) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            double *p = a + (size_t)i * (size_t)n + j, *q = a + (size_t)j * (size_t)n + i,
                   keep = *p;
            *p = *q;
            *q = keep;
        }
}

/* dgeev, balanced. Error of a value: round-off times |a| times its condition. Cost about 25 n^3.
   Test: test_eigen.c. */
fw_status fw_maths_eigen_general(fw_arena *arena, int n, double *a, double *re, double *im,
                                 double *vector) {
    if (n == 0) return FW_OK;
    if (!finite_all(a, (size_t)n * (size_t)n)) return FW_SOLVER;
    FW_TRY(fw_maths_lapack_ready());
    transpose_square(n, a);
    double size = 0, *work;
    int info = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, a, n, re, im, NULL, 1, vector, n,
                                  &size, -1);
    size_t length = asked(info, size);
    if (!length) return FW_SOLVER;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(work = fw_arena_array(arena, double, length));
    info = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, a, n, re, im, NULL, 1, vector, n, work,
                              (int)length);
    fw_arena_rewind(arena, mark);
    return info == 0 ? FW_OK : FW_SOLVER;
}

static void transpose(int rows, int columns, const double *from, double *to) {
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < columns; k++)
            to[(size_t)k * (size_t)rows + (size_t)i] =
                from[(size_t)i * (size_t)columns + (size_t)k];
}

/* Backward stable: errors of a few eps times the largest singular value. Cost about 4 rows columns
   (rows + columns). Source: LAPACK, by way of fw_maths_svd. Test: test_singular.c. */
fw_status fw_maths_singular_new(fw_arena *arena, int rows, int columns, const double *a,
                                fw_maths_singular *out) {
    size_t m = (size_t)rows, n = (size_t)columns, least = m < n ? m : n;
    *out = (fw_maths_singular){.rows = rows, .columns = columns};
    FW_NEED(out->sigma = fw_arena_array(arena, double, least));
    FW_NEED(out->u = fw_arena_array(arena, double, m *least));
    FW_NEED(out->v = fw_arena_array(arena, double, n *n));
    for (size_t i = 0; i < m * n; i++)
        if (!isfinite(a[i])) return FW_SOLVER; /* LAPACK may loop on a NaN */
    if (least == 0) {
        for (size_t i = 0; i < n; i++)
            out->v[i * n + i] = 1;
        return FW_OK;
    }
    double *copy, *vt;
    fw_maths_lapack_space space;
    FW_NEED(copy = fw_arena_array(arena, double, m *n));
    FW_NEED(vt = fw_arena_array(arena, double, n *n));
    FW_TRY(fw_maths_svd_space(arena, rows, columns, true, &space));
    transpose(rows, columns, a, copy); /* column-major there */
    if (!fw_maths_svd(rows, columns, true, copy, out->sigma, out->u, vt, &space)) return FW_SOLVER;
    transpose(columns, columns, vt, out->v);
    return FW_OK;
}
