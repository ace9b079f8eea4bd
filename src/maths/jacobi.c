/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/jacobi.h"
#include <float.h>
#include <math.h>
#include <string.h>

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
