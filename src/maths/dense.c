/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/dense.h"
#include <lapacke.h>
#include <math.h>
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
   times the condition; a singular consistent system gives the minimum-norm x. Cost n^3/3, and a
   singular value decomposition when that fails. Source: LAPACK dsysv, dgelsd. Test: test_dense.c.
 */
fw_status fw_dense_solve_symmetric(fw_arena *arena, int n, const double *a, const double *b,
                                   double *x, bool *consistent) {
    size_t m = n > 0 ? (size_t)n : 0;
    *consistent = finite_all(a, m * m) && finite_all(b, m); /* LAPACK may loop on a NaN */
    if (m == 0 || !*consistent) return FW_OK;
    double *copy, *right, *work;
    lapack_int *pivot;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(right = fw_arena_array(arena, double, m));
    FW_NEED(copy = fw_arena_array(arena, double, m *m));
    FW_NEED(work = fw_arena_array(arena, double, 64 * m));
    FW_NEED(pivot = fw_arena_array(arena, lapack_int, m));
    memcpy(right, b, m * sizeof *b);
    memcpy(copy, a, m * m * sizeof *a);
    memcpy(x, right, m * sizeof *x);
    int info = LAPACKE_dsysv_work(LAPACK_COL_MAJOR, 'L', n, 1, copy, n, pivot, x, n, work, 64 * n);
    fw_status status = FW_OK;
    if (info != 0 || !solves(n, a, x, right) || !bounded(n, a, x, right)) {
        memcpy(x, right, m * sizeof *x);
        status = least_squares(arena, n, a, x);
        *consistent = status == FW_OK && solves(n, a, x, right);
        if (status == FW_SOLVER) status = FW_OK;
    }
    fw_arena_rewind(arena, mark);
    return status;
}
