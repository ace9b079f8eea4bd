/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/maths_dense.h"
#include "maths/lapack.h"
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <lapacke.h>
#include <math.h>
#include <pthread.h>
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

static void set_handler_off(void) {
    gsl_set_error_handler_off();
}

/* the handler is one for the process, and designs run in parallel: it is written once */
void fw_maths_gsl_quiet(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_handler_off);
}

/* LU with partial pivoting by GSL, which needs no memory of its own; false: exactly singular */
static bool lu(int n, double *copy, size_t *order, double *x) {
    size_t m = (size_t)n;
    int sign;
    gsl_matrix_view a = gsl_matrix_view_array(copy, m, m);
    gsl_vector_view right = gsl_vector_view_array(x, m);
    gsl_permutation permutation = {m, order};
    fw_maths_gsl_quiet();
    return gsl_linalg_LU_decomp(&a.matrix, &permutation, &sign) == GSL_SUCCESS &&
           gsl_linalg_LU_svx(&a.matrix, &permutation, &right.vector) == GSL_SUCCESS;
}

/* a x = b; a (n x n) symmetric, b (n), x (n), any unit that balances the rows. Error: round-off
   times the condition; a singular consistent system gives the minimum-norm x. Cost 2 n^3/3, and a
   singular value decomposition when that fails. GSL first: some BLAS wait for ever when memory is
   short. Source: GSL LU, LAPACK dgelsd. Test: test_dense.c. */
fw_status fw_maths_dense_solve_symmetric(fw_arena *arena, int n, const double *a, const double *b,
                                         double *x, bool *consistent) {
    size_t m = n > 0 ? (size_t)n : 0;
    *consistent = finite_all(a, m * m) && finite_all(b, m); /* LAPACK may loop on a NaN */
    if (m == 0 || !*consistent) return FW_OK;
    double *copy, *right;
    size_t *order;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(right = fw_arena_array(arena, double, m));
    FW_NEED(copy = fw_arena_array(arena, double, m *m));
    FW_NEED(order = fw_arena_array(arena, size_t, m));
    memcpy(right, b, m * sizeof *b);
    memcpy(copy, a, m * m * sizeof *a);
    memcpy(x, right, m * sizeof *x);
    fw_status status = FW_OK;
    if (!lu(n, copy, order, x) || !solves(n, a, x, right) || !bounded(n, a, x, right)) {
        memcpy(x, right, m * sizeof *x);
        status = least_squares(arena, n, a, x);
        *consistent = status == FW_OK && solves(n, a, x, right);
        if (status == FW_SOLVER) status = FW_OK;
    }
    fw_arena_rewind(arena, mark);
    return status;
}
