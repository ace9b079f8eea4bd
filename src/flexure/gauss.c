/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/gauss.h"
#include "base/constants.h"
#include <math.h>

/* P_0 .. P_n at x by their recurrence */
static void legendre(int n, long double x, long double *p) {
    p[0] = 1;
    if (n > 0) p[1] = x;
    for (int k = 2; k <= n; k++)
        p[k] = ((2 * k - 1) * x * p[k - 1] - (k - 1) * p[k - 2]) / k;
}

/* roots of P_n by Newton's method from cos(pi (i + 3/4)/(n + 1/2)), weight on [-1, 1]
     w = 2 (1 - x^2)/(n P_(n-1)(x))^2
   in: n <= FW_GAUSS_MOST. out: nodes and weights on [0, 1], rounded from long double; exact for
   polynomials of degree 2 n - 1. Source: Abramowitz and Stegun 25.4.29.
   Test: test_beam.c rules_are_exact */
void fw_flexure_gauss_rule(int n, double *node, double *weight) {
    long double p[FW_GAUSS_MOST + 1];
    for (int i = 0; i < (n + 1) / 2; i++) {
        long double x = cosl((long double)FW_PI * (i + 0.75L) / (n + 0.5L));
        for (int k = 0; k < 5; k++) {
            legendre(n, x, p);
            x -= p[n] * (x * x - 1) / (n * (x * p[n] - p[n - 1]));
        }
        legendre(n, x, p);
        node[n - 1 - i] = (double)(0.5L * (1 + x));
        node[i] = (double)(0.5L * (1 - x));
        weight[i] = weight[n - 1 - i] =
            (double)((1 - x * x) / ((long double)n * n * p[n - 1] * p[n - 1]));
    }
}

/* The j-th Lagrange polynomial is w_j sum_k (2k + 1)/2 P_k(x_j) P_k(x), since the rule is exact for
   the products; the integral of (2k + 1) P_k is P_(k+1) - P_(k-1).
   Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5.
   Test: test_beam.c rules_are_exact */
void fw_flexure_gauss_integrals(int n, const double *node, const double *weight, double *a) {
    long double at[FW_GAUSS_MOST + 2], of[FW_GAUSS_MOST + 2];
    for (int i = 0; i < n; i++) {
        long double x = 2 * (long double)node[i] - 1;
        legendre(n, x, at);
        for (int j = 0; j < n; j++) {
            legendre(n, 2 * (long double)node[j] - 1, of);
            long double sum = x + 1;
            for (int k = 1; k < n; k++)
                sum += of[k] * (at[k + 1] - at[k - 1]);
            a[i * n + j] = (double)(0.5L * (long double)weight[j] * sum);
        }
    }
}
