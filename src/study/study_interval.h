/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Medians with intervals, for times on noisy machines. */
#ifndef FW_STUDY_STUDY_INTERVAL_H
#define FW_STUDY_STUDY_INTERVAL_H
#include <stdbool.h>

typedef struct fw_study_median {
    double value, low, high; /* NaN: too few samples for the interval */
} fw_study_median;

/* Median of n samples, which are sorted, and the interval of two order statistics x_(k), x_(n+1-k)
   that holds the median of their distribution with a probability of at least 95 %, whatever that
   distribution is: 1 - 2 B(k - 1; n, 1/2) of the binomial. Needs n >= 6; O(n log n). Source: David
   and Nagaraja, Order Statistics, 7.1. Test: test_medians.c. */
fw_study_median fw_study_median_of(double *sample, int n);

/* rank k of that interval, from 1; 0: n is too small */
int fw_study_median_rank(int n);

/* wider than this share of the median is not told */
static const double fw_interval_most = 0.1;
bool fw_study_median_told(const fw_study_median *m);

#endif
