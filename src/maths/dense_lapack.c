/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sources: LAPACK Users' Guide (Anderson et al., 1999); Golub and Van Loan, Matrix Computations.
   Errors are those of LAPACK: backward stable, round-off times the norm. Test: test_lapack.c. */
#include "maths/dense.h"
#include <lapacke.h>
#include <math.h>
#include <pthread.h>
#include <sys/mman.h>

static const int column_major = LAPACK_COL_MAJOR;

static int least(int a, int b) {
    return a < b ? a : b;
}

static int at_least_one(int n) { /* leading dimensions */
    return n > 1 ? n : 1;
}

void openblas_set_num_threads(int count) __attribute__((weak));

/* OpenBLAS would split matrices of a dozen rows over all cores: on a busy machine that costs 50
   times the arithmetic, and the last digits follow the number of threads */
static void one_thread(void) {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
}

/* OpenBLAS maps a buffer at its first use and keeps it; where the system refuses, it asks again for
   ever. So the same is asked for here first, and a small problem then makes it take its own. */
static const size_t fw_blas_buffer = 160 << 20;

static bool take_buffer(void) {
    if (!openblas_set_num_threads) return true;
    void *place = mmap(NULL, fw_blas_buffer, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (place == MAP_FAILED) return false;
    munmap(place, fw_blas_buffer);
    double a[9] = {4, 1, 2, 1, 5, 3, 2, 3, 6}, value[3], work[32];
    return LAPACKE_dsyev_work(column_major, 'N', 'L', 3, a, 3, value, work, 32) == 0;
}

fw_status fw_maths_lapack_ready(void) {
    static pthread_mutex_t alone = PTHREAD_MUTEX_INITIALIZER; /* designs run in parallel */
    static bool ready;
    pthread_mutex_lock(&alone);
    if (!ready) {
        one_thread();
        ready = take_buffer();
    }
    bool good = ready;
    pthread_mutex_unlock(&alone);
    return good ? FW_OK : FW_NOMEM;
}

static fw_status space_of(fw_arena *arena, int info, double ask, fw_maths_lapack_space *space) {
    if (info != 0 || !(ask >= 0) || ask > 1e8) return FW_SOLVER;
    FW_TRY(fw_maths_lapack_ready());
    space->size = at_least_one((int)ask);
    FW_NEED(space->work = fw_arena_array(arena, double, (size_t)space->size));
    return FW_OK;
}

fw_status fw_maths_svd_space(fw_arena *arena, int m, int n, bool full,
                             fw_maths_lapack_space *space) {
    double ask = 0, none = 0;
    int k = least(m, n);
    int info = LAPACKE_dgesvd_work(column_major, 'S', full ? 'A' : 'S', m, n, &none,
                                   at_least_one(m), &none, &none, at_least_one(m), &none,
                                   at_least_one(full ? n : k), &ask, -1);
    return space_of(arena, info, ask, space);
}

bool fw_maths_svd(int m, int n, bool full, double *a, double *s, double *u, double *vt,
                  const fw_maths_lapack_space *space) {
    int k = least(m, n);
    return LAPACKE_dgesvd_work(column_major, 'S', full ? 'A' : 'S', m, n, a, at_least_one(m), s, u,
                               at_least_one(m), vt, at_least_one(full ? n : k), space->work,
                               space->size) == 0;
}

fw_status fw_maths_eigen_space(fw_arena *arena, int n, fw_maths_lapack_space *space) {
    double ask = 0, none = 0;
    int info =
        LAPACKE_dsyev_work(column_major, 'V', 'L', n, &none, at_least_one(n), &none, &ask, -1);
    return space_of(arena, info, ask, space);
}

bool fw_maths_eigen(int n, double *a, double *value, const fw_maths_lapack_space *space) {
    return LAPACKE_dsyev_work(column_major, 'V', 'L', n, a, at_least_one(n), value, space->work,
                              space->size) == 0;
}

fw_status fw_maths_qr_space(fw_arena *arena, int m, int n, fw_maths_lapack_space *space) {
    double ask = 0, apply = 0, none = 0;
    int pivot = 0, k = least(m, n);
    int info =
        LAPACKE_dgeqp3_work(column_major, m, n, &none, at_least_one(m), &pivot, &none, &ask, -1);
    if (info != 0) return FW_SOLVER;
    info = LAPACKE_dormqr_work(column_major, 'L', 'N', m, 1, k, &none, at_least_one(m), &none,
                               &none, at_least_one(m), &apply, -1);
    return space_of(arena, info, fmax(ask, apply), space);
}

bool fw_maths_qr(int m, int n, double *a, int *pivot, double *tau,
                 const fw_maths_lapack_space *space) {
    for (int j = 0; j < n; j++)
        pivot[j] = 0; /* free to move */
    if (LAPACKE_dgeqp3_work(column_major, m, n, a, at_least_one(m), pivot, tau, space->work,
                            space->size) != 0)
        return false;
    for (int j = 0; j < n; j++)
        pivot[j]--;
    return true;
}

bool fw_maths_qr_apply(bool transposed, int m, int n, const double *a, const double *tau, double *x,
                       const fw_maths_lapack_space *space) {
    return LAPACKE_dormqr_work(column_major, 'L', transposed ? 'T' : 'N', m, 1, least(m, n), a,
                               at_least_one(m), tau, x, at_least_one(m), space->work,
                               space->size) == 0;
}

bool fw_maths_triangle_solve(bool transposed, int n, const double *a, int ld, double *x) {
    return LAPACKE_dtrtrs_work(column_major, 'U', transposed ? 'T' : 'N', 'N', n, 1, a,
                               at_least_one(ld), x, at_least_one(n)) == 0;
}

fw_status fw_maths_indefinite_space(fw_arena *arena, int n, fw_maths_lapack_space *space) {
    double ask = 0, none = 0;
    int pivot = 0;
    int info = LAPACKE_dsytrf_work(column_major, 'L', n, &none, at_least_one(n), &pivot, &ask, -1);
    return space_of(arena, info, ask, space);
}

bool fw_maths_indefinite(int n, double *a, int *pivot, const fw_maths_lapack_space *space) {
    return LAPACKE_dsytrf_work(column_major, 'L', n, a, at_least_one(n), pivot, space->work,
                               space->size) == 0;
}

bool fw_maths_indefinite_solve(int n, const double *a, const int *pivot, double *x) {
    return LAPACKE_dsytrs_work(column_major, 'L', n, 1, a, at_least_one(n), pivot, x,
                               at_least_one(n)) == 0;
}

bool fw_maths_cholesky(int n, double *a) {
    return LAPACKE_dpotrf_work(column_major, 'L', n, a, at_least_one(n)) == 0;
}

bool fw_maths_cholesky_solve(int n, const double *a, double *x) {
    return LAPACKE_dpotrs_work(column_major, 'L', n, 1, a, at_least_one(n), x, at_least_one(n)) ==
           0;
}

bool fw_maths_lapack_lu(int n, double *a, int *pivot) {
    return LAPACKE_dgetrf_work(column_major, n, n, a, at_least_one(n), pivot) == 0;
}

bool fw_maths_lapack_lu_solve(bool transposed, int n, int count, const double *a, const int *pivot,
                              double *x) {
    return LAPACKE_dgetrs_work(column_major, transposed ? 'T' : 'N', n, count, a, at_least_one(n),
                               pivot, x, at_least_one(n)) == 0;
}

static void swap(int *order, int i, int j) {
    int other = order[i];
    order[i] = order[j];
    order[j] = other;
}

/* a[row[i]][column[j]] -= a[row[i]][column[k]] a[row[k]][column[j]] / a[row[k]][column[k]], the
   largest of what is left in front at every k. Cost m n min(m, n). Among equals the first, so that
   the order does not depend on anything but the matrix. Source: Golub and Van Loan, section 3.4.
   Test: test_lapack.c. */
int fw_maths_complete_pivoting(int m, int n, double *a, int *row, int *column, double stop,
                               double *last) {
    double first = 0;
    for (int i = 0; i < m; i++)
        row[i] = i;
    for (int j = 0; j < n; j++)
        column[j] = j;
    *last = 0;
    for (int k = 0; k < least(m, n); k++) {
        int at_row = k, at_column = k;
        double largest = -1;
        for (int i = k; i < m; i++)
            for (int j = k; j < n; j++) {
                double size = fabs(a[(size_t)row[i] * (size_t)n + (size_t)column[j]]);
                if (size > largest) largest = size, at_row = i, at_column = j;
            }
        if (k == 0) first = largest;
        if (!(largest > 0) || largest < stop * first) return k;
        *last = largest / first;
        swap(row, k, at_row);
        swap(column, k, at_column);
        const double *pivot = a + (size_t)row[k] * (size_t)n;
        for (int i = k + 1; i < m; i++) {
            double *to = a + (size_t)row[i] * (size_t)n, factor = to[column[k]] / pivot[column[k]];
            for (int j = k + 1; j < n; j++)
                to[column[j]] -= factor * pivot[column[j]];
        }
    }
    return least(m, n);
}
