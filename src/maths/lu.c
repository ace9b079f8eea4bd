/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/lu.h"
#include <math.h>
#include <stddef.h>

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
