/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/study_interval.h"
#include "base/sort.h"
#include <math.h>
#include <stdlib.h>

int fw_study_median_rank(int n) {
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
    int k = fw_study_median_rank(n);
    if (k < 1) return m;
    m.low = sample[k - 1];
    m.high = sample[n - k];
    return m;
}

bool fw_study_median_told(const fw_study_median *m) {
    return isfinite(m->low) && isfinite(m->high) && m->value > 0 &&
           m->high - m->low <= fw_interval_most * m->value;
}
