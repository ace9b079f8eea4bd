/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense linear algebra: small matrices in the caller's memory, LAPACK in loops that must not allocate, and single
   answers that are made of both. */
#include "maths/matrix.h"
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <sys/mman.h>

/* ---- small, in the caller's memory ---- */

static void swap(double *x, double *y) {
    double z = *x;
    *x = *y;
    *y = z;
}

/* row of the largest entry below and on the diagonal of column k, and behind the last that is not 0; im may be
   NULL */
static int largest(int n, const double *re, const double *im, int k, int *below) {
    int best = k;
    double most = -1;
    for (int i = k; i < n; i++) {
        size_t at = (size_t)i * (size_t)n + (size_t)k;
        double size = fabs(re[at]) + (im ? fabs(im[at]) : 0);
        if (size > most) most = size, best = i;
        if (size != 0) *below = i + 1;
    }
    return most > 0 && isfinite(most) ? best : -1;
}

/* behind the last entry of a row (n) that is not 0, at least `from`. Where bodies are coupled to their neighbours
   alone most of a matrix is zeros, and elimination leaves them: skipped, they change no bit of a result */
static int row_ends(const double *re, const double *im, int from, int n) {
    while (n > from && re[n - 1] == 0 && (!im || im[n - 1] == 0))
        n--;
    return n;
}

/* Gaussian elimination with partial pivoting. Error: round-off times the growth and the condition;
   cost 2 n^3/3. Source: Golub and Van Loan, Matrix Computations, 3.4. Test: test_lu.c */
bool fw_maths_lu_factor(int n, double *a, int *pivot) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++) {
        int below = n, p = pivot[k] = largest(n, a, NULL, k, &below);
        if (p < 0) return false;
        double *top = a + (size_t)k * m, *other = a + (size_t)p * m;
        for (int j = 0; p != k && j < n; j++)
            swap(&top[j], &other[j]);
        const int end = row_ends(top, NULL, k + 1, n);
        for (int i = k + 1; i < below; i++) {
            double *restrict row = a + (size_t)i * m;
            if (row[k] == 0) continue;
            double factor = row[k] /= top[k];
            for (int j = k + 1; j < end; j++)
                row[j] -= factor * top[j];
        }
    }
    return true;
}

void fw_maths_lu_solve(int n, const double *a, const int *pivot, const int *within, double *x) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++)
        swap(&x[k], &x[pivot[k]]);
    for (int i = 1; i < n; i++)
        for (int j = within ? within[4 * i] : 0; j < i; j++)
            x[i] -= a[(size_t)i * m + (size_t)j] * x[j];
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1, end = within ? within[4 * i + 1] : n; j < end; j++)
            x[i] -= a[(size_t)i * m + (size_t)j] * x[j];
        x[i] /= a[(size_t)i * m + (size_t)i];
    }
}

/* (x + i y) /= (a + i b), |a + i b| neither tiny nor huge */
static void divide(double *x, double *y, double a, double b) {
    double size = a * a + b * b, re = (*x * a + *y * b) / size;
    *y = (*y * a - *x * b) / size;
    *x = re;
}

/* as above with |re| + |im| as size of a pivot; cost 8 n^3/3 */
bool fw_maths_lu_factor_complex(int n, double *re, double *im, int *pivot) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++) {
        int below = n, p = pivot[k] = largest(n, re, im, k, &below);
        if (p < 0) return false;
        double *top_re = re + (size_t)k * m, *top_im = im + (size_t)k * m;
        for (int j = 0; p != k && j < n; j++) {
            swap(&top_re[j], &re[(size_t)p * m + (size_t)j]);
            swap(&top_im[j], &im[(size_t)p * m + (size_t)j]);
        }
        const int end = row_ends(top_re, top_im, k + 1, n);
        for (int i = k + 1; i < below; i++) {
            double *restrict x = re + (size_t)i * m, *restrict y = im + (size_t)i * m;
            if (x[k] == 0 && y[k] == 0) continue;
            divide(&x[k], &y[k], top_re[k], top_im[k]);
            double a = x[k], b = y[k];
            for (int j = k + 1; j < end; j++) {
                x[j] -= a * top_re[j] - b * top_im[j];
                y[j] -= a * top_im[j] + b * top_re[j];
            }
        }
    }
    return true;
}

void fw_maths_lu_solve_complex(int n, const double *re, const double *im, const int *pivot,
                               const int *within, double *x, double *y) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++) {
        swap(&x[k], &x[pivot[k]]);
        swap(&y[k], &y[pivot[k]]);
    }
    for (int pass = 0; pass < 2; pass++)
        for (int step = 0; step < n; step++) {
            int i = pass ? n - 1 - step : step, from = pass ? i + 1 : 0, to = pass ? n : i;
            if (within && pass) to = within[4 * i + 1];
            if (within && !pass) from = within[4 * i];
            const double *a = re + (size_t)i * m, *b = im + (size_t)i * m;
            for (int j = from; j < to; j++) {
                x[i] -= a[j] * x[j] - b[j] * y[j];
                y[i] -= a[j] * y[j] + b[j] * x[j];
            }
            if (pass) divide(&x[i], &y[i], a[i], b[i]);
        }
}

enum { FW_SWEEPS = 60 };

static double *at(double *a, int n, int i, int j) {
    return &a[(size_t)i * (size_t)n + (size_t)j];
}

/* rows and columns p and q of a, rows p and q of the vectors, so that a_pq becomes 0 */
static void turn(int n, double *a, double *v, int p, int q) {
    double apq = *at(a, n, p, q), apart = *at(a, n, q, q) - *at(a, n, p, p);
    double theta = 0.5 * apart / apq;
    double t = (theta < 0 ? -1 : 1) / (fabs(theta) + hypot(theta, 1));
    double c = 1 / hypot(t, 1), s = t * c;
    for (int k = 0; k < n; k++) {
        double x = *at(a, n, k, p), y = *at(a, n, k, q);
        *at(a, n, k, p) = c * x - s * y, *at(a, n, k, q) = s * x + c * y;
    }
    for (int k = 0; k < n; k++) {
        double x = *at(a, n, p, k), y = *at(a, n, q, k);
        *at(a, n, p, k) = c * x - s * y, *at(a, n, q, k) = s * x + c * y;
        x = *at(v, n, p, k), y = *at(v, n, q, k);
        *at(v, n, p, k) = c * x - s * y, *at(v, n, q, k) = s * x + c * y;
    }
    *at(a, n, p, q) = *at(a, n, q, p) = 0;
}

static void sort(int n, double *v, double *value) {
    for (int i = 0; i < n; i++) {
        int least = i;
        for (int k = i + 1; k < n; k++)
            if (value[k] < value[least]) least = k;
        double keep = value[i];
        value[i] = value[least], value[least] = keep;
        for (int k = 0; k < n && least != i; k++) {
            keep = *at(v, n, i, k);
            *at(v, n, i, k) = *at(v, n, least, k), *at(v, n, least, k) = keep;
        }
    }
}

/* Cyclic Jacobi: rotations until every entry beside the diagonal is round-off of its two diagonal
   ones, so that small eigenvalues of a graded positive matrix are accurate too. Error a few eps of
   the entries; cost about 8 sweeps of 6 n^3. Source: Golub and Van Loan, Matrix Computations, 8.5;
   Demmel and Veselic 1992. Test: test_jacobi.c. */
bool fw_maths_jacobi(int n, double *a, double *value, double *v) {
    bool done = false;
    memset(v, 0, (size_t)n * (size_t)n * sizeof *v);
    for (int i = 0; i < n; i++)
        *at(v, n, i, i) = 1;
    for (int sweep = 0; sweep < FW_SWEEPS && !done; sweep++) {
        done = true;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                double off = fabs(*at(a, n, p, q));
                double size = sqrt(fabs(*at(a, n, p, p)) * fabs(*at(a, n, q, q)));
                if (off <= DBL_EPSILON * size || off < DBL_MIN) continue;
                done = false;
                turn(n, a, v, p, q);
            }
    }
    for (int i = 0; i < n; i++) {
        value[i] = *at(a, n, i, i);
        done = done && isfinite(value[i]);
    }
    if (done) sort(n, v, value);
    return done;
}

/* Gauss with exchange of rows. Source: Golub and Van Loan, Matrix Computations, 3.4.
   Test: test_lu.c, test_elastica.c */
bool fw_maths_solve3(const double a[3][3], int columns, double x[3][3], double *det) {
    double m[3][3];
    *det = 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = a[i][j];
    for (int k = 0; k < 3; k++) {
        int best = k;
        for (int i = k + 1; i < 3; i++)
            if (fabs(m[i][k]) > fabs(m[best][k])) best = i;
        *det *= best == k ? m[k][k] : -m[best][k];
        if (!(fabs(m[best][k]) > 0)) return false;
        for (int j = 0; j < 3; j++) {
            swap(&m[k][j], &m[best][j]);
            swap(&x[k][j], &x[best][j]);
        }
        for (int i = k + 1; i < 3; i++) {
            double f = m[i][k] / m[k][k];
            for (int j = k + 1; j < 3; j++)
                m[i][j] -= f * m[k][j];
            for (int j = 0; j < columns; j++)
                x[i][j] -= f * x[k][j];
        }
    }
    for (int k = 2; k >= 0; k--)
        for (int j = 0; j < columns; j++) {
            for (int i = k + 1; i < 3; i++)
                x[k][j] -= m[k][i] * x[i][j];
            x[k][j] /= m[k][k];
        }
    return true;
}

/* ---- LAPACK, workspace from outside ----

   Sources: LAPACK Users' Guide (Anderson et al., 1999); Golub and Van Loan, Matrix Computations.
   Errors are those of LAPACK: backward stable, round-off times the norm. Test: test_lapack.c. */

static const int column_major = LAPACK_COL_MAJOR;

static int lesser(int a, int b) {
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
    int k = lesser(m, n);
    int info = LAPACKE_dgesvd_work(column_major, 'S', full ? 'A' : 'S', m, n, &none,
                                   at_least_one(m), &none, &none, at_least_one(m), &none,
                                   at_least_one(full ? n : k), &ask, -1);
    return space_of(arena, info, ask, space);
}

bool fw_maths_svd(int m, int n, bool full, double *a, double *s, double *u, double *vt,
                  const fw_maths_lapack_space *space) {
    int k = lesser(m, n);
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
    int pivot = 0, k = lesser(m, n);
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
    return LAPACKE_dormqr_work(column_major, 'L', transposed ? 'T' : 'N', m, 1, lesser(m, n), a,
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

static void swap_order(int *order, int i, int j) {
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
    for (int k = 0; k < lesser(m, n); k++) {
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
        swap_order(row, k, at_row);
        swap_order(column, k, at_column);
        const double *pivot = a + (size_t)row[k] * (size_t)n;
        for (int i = k + 1; i < m; i++) {
            double *to = a + (size_t)row[i] * (size_t)n, factor = to[column[k]] / pivot[column[k]];
            for (int j = k + 1; j < n; j++)
                to[column[j]] -= factor * pivot[column[j]];
        }
    }
    return lesser(m, n);
}

/* ---- one answer, memory from the arena ---- */

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
    if (regular) fw_maths_lu_solve(n, copy, pivot, NULL, x);
    if (!regular || !solves(n, a, x, right) || !bounded(n, a, x, right)) {
        memcpy(x, right, m * sizeof *x);
        status = least_squares(arena, n, a, x);
        *consistent = status == FW_OK && solves(n, a, x, right);
        if (status == FW_SOLVER) status = FW_OK;
    }
    fw_arena_rewind(arena, mark);
    return status;
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
