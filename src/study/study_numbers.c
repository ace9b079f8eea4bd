/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/study_numbers.h"
#include "base/sort.h"
#include <math.h>
#include <stdlib.h>

static bool real(double x) {
    return isfinite(x) && x > 0;
}

void fw_study_front_mark(const double *cost, const double *error, int n, bool *front) {
    for (int i = 0; i < n; i++) {
        front[i] = real(cost[i]) && real(error[i]);
        for (int k = 0; k < n && front[i]; k++) {
            if (k == i || !real(cost[k]) || !real(error[k])) continue;
            bool less = cost[k] < cost[i] || error[k] < error[i] || k < i;
            if (cost[k] <= cost[i] && error[k] <= error[i] && less) front[i] = false;
        }
    }
}

/* the dearest front point that does not reach it and the cheapest that does; -1: none */
static void neighbours(const double *cost, const double *error, const bool *front, int n,
                       double wanted, int *below, int *reached) {
    *below = *reached = -1;
    for (int i = 0; i < n; i++) {
        if (!front[i]) continue;
        if (error[i] <= wanted) {
            if (*reached < 0 || cost[i] < cost[*reached]) *reached = i;
        } else if (*below < 0 || cost[i] > cost[*below])
            *below = i;
    }
}

double fw_study_front_cost(const double *cost, const double *error, const bool *front, int n,
                           double wanted) {
    int a, b;
    neighbours(cost, error, front, n, wanted, &a, &b);
    if (b < 0) return (double)NAN;
    if (a < 0) return cost[b];
    double part = log(error[a] / wanted) / log(error[a] / error[b]);
    return cost[a] * pow(cost[b] / cost[a], part);
}

double fw_study_front_digit(const double *cost, const double *error, const bool *front, int n) {
    int cheap = -1, best = -1;
    for (int i = 0; i < n; i++) {
        if (!front[i]) continue;
        if (cheap < 0 || cost[i] < cost[cheap]) cheap = i;
        if (best < 0 || error[i] < error[best]) best = i;
    }
    if (cheap < 0) return (double)NAN;
    double digits = log10(error[cheap] / error[best]);
    return digits < 0.5 ? (double)NAN : pow(cost[best] / cost[cheap], 1 / digits);
}

double fw_study_front_order(const double *work, const double *error, int n, double least) {
    double count = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < n; i++) {
        if (!real(work[i]) || !real(error[i]) || error[i] <= least) continue;
        double u = log(work[i]), v = -log(error[i]);
        count++, x += u, y += v, xx += u * u, xy += u * v;
    }
    double spread = xx - x * x / fmax(count, 1);
    if (count < 3 || !(spread > 1e-6)) return (double)NAN;
    return (xy - x * y / count) / spread;
}

/* ---- medians ---- */

/* rank k of that interval, from 1; 0: n is too small */
static int interval_rank(int n) {
    double term = pow(0.5, n), below = 0; /* P(fewer than k of n samples lie below the median) */
    int k = 0;
    while (k < n / 2 && below + term <= 0.025) {
        below += term;
        term *= (double)(n - k) / (double)(k + 1);
        k++;
    }
    return k;
}

fw_study_median fw_study_median_of(double *sample, int n) {
    fw_study_median m = {(double)NAN, (double)NAN, (double)NAN};
    if (n < 1) return m;
    fw_sort_doubles(sample, (size_t)n);
    m.value = 0.5 * (sample[(n - 1) / 2] + sample[n / 2]);
    int k = interval_rank(n);
    if (k < 1) return m;
    m.low = sample[k - 1];
    m.high = sample[n - k];
    return m;
}

bool fw_study_median_told(const fw_study_median *m) {
    return isfinite(m->low) && isfinite(m->high) && m->value > 0 &&
           m->high - m->low <= fw_interval_most * m->value;
}
