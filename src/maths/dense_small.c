/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/dense.h"
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

static void swap(double *x, double *y) {
    double z = *x;
    *x = *y;
    *y = z;
}

/* row of the largest entry below and on the diagonal of column k; im may be NULL */
static int largest(int n, const double *re, const double *im, int k) {
    int best = k;
    double most = -1;
    for (int i = k; i < n; i++) {
        size_t at = (size_t)i * (size_t)n + (size_t)k;
        double size = fabs(re[at]) + (im ? fabs(im[at]) : 0);
        if (size > most) most = size, best = i;
    }
    return most > 0 && isfinite(most) ? best : -1;
}

/* Gaussian elimination with partial pivoting. Error: round-off times the growth and the condition;
   cost 2 n^3/3. Source: Golub and Van Loan, Matrix Computations, 3.4. Test: test_lu.c */
bool fw_maths_lu_factor(int n, double *a, int *pivot) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++) {
        int p = pivot[k] = largest(n, a, NULL, k);
        if (p < 0) return false;
        double *top = a + (size_t)k * m, *other = a + (size_t)p * m;
        for (int j = 0; p != k && j < n; j++)
            swap(&top[j], &other[j]);
        for (int i = k + 1; i < n; i++) {
            double *restrict row = a + (size_t)i * m;
            double factor = row[k] /= top[k];
            if (factor == 0) continue;
            for (int j = k + 1; j < n; j++)
                row[j] -= factor * top[j];
        }
    }
    return true;
}

void fw_maths_lu_solve(int n, const double *a, const int *pivot, double *x) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++)
        swap(&x[k], &x[pivot[k]]);
    for (int i = 1; i < n; i++)
        for (int j = 0; j < i; j++)
            x[i] -= a[(size_t)i * m + (size_t)j] * x[j];
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++)
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
        int p = pivot[k] = largest(n, re, im, k);
        if (p < 0) return false;
        double *top_re = re + (size_t)k * m, *top_im = im + (size_t)k * m;
        for (int j = 0; p != k && j < n; j++) {
            swap(&top_re[j], &re[(size_t)p * m + (size_t)j]);
            swap(&top_im[j], &im[(size_t)p * m + (size_t)j]);
        }
        for (int i = k + 1; i < n; i++) {
            double *restrict x = re + (size_t)i * m, *restrict y = im + (size_t)i * m;
            divide(&x[k], &y[k], top_re[k], top_im[k]);
            double a = x[k], b = y[k];
            if (a == 0 && b == 0) continue;
            for (int j = k + 1; j < n; j++) {
                x[j] -= a * top_re[j] - b * top_im[j];
                y[j] -= a * top_im[j] + b * top_re[j];
            }
        }
    }
    return true;
}

void fw_maths_lu_solve_complex(int n, const double *re, const double *im, const int *pivot,
                               double *x, double *y) {
    size_t m = (size_t)n;
    for (int k = 0; k < n; k++) {
        swap(&x[k], &x[pivot[k]]);
        swap(&y[k], &y[pivot[k]]);
    }
    for (int pass = 0; pass < 2; pass++)
        for (int step = 0; step < n; step++) {
            int i = pass ? n - 1 - step : step, from = pass ? i + 1 : 0, to = pass ? n : i;
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
