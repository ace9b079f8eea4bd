/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plain arrays, no physics: what is worth its cost, what a digit costs, medians with intervals. */
#ifndef FW_STUDY_STUDY_NUMBERS_H
#define FW_STUDY_STUDY_NUMBERS_H
#include <stdbool.h>

/* ---- costs and errors of several settings ---- */

/* front[i]: no other point has both cost and error smaller (or one smaller, the other the same; of
   equal points the first). Points with a cost or error that is no number are never on it. In: n
   costs and errors > 0. O(n^2). Test: test_front.c. */
void fw_study_front_mark(const double *cost, const double *error, int n, bool *front);

/* Cost at which the front reaches an error: log-log line between its neighbours, no line beyond its
   ends: the cheapest point's cost where that reaches it, NaN where none does. */
double fw_study_front_cost(const double *cost, const double *error, const bool *front, int n,
                           double wanted);

/* Factor of cost for one more digit over the whole front: (c1/c0)^(1/log10(e0/e1)) of its ends; NaN
   with less than half a digit between them. */
double fw_study_front_digit(const double *cost, const double *error, const bool *front, int n);

/* Least-squares slope of -log error over log work: the order that is seen. Points at or below
   `least` are round-off or reference and do not count; NaN with fewer than three points. */
double fw_study_front_order(const double *work, const double *error, int n, double least);

/* ---- medians with intervals, for times on noisy machines ---- */

typedef struct fw_study_median {
    double value, low, high; /* NaN: too few samples for the interval */
} fw_study_median;

/* Median of n samples, which are sorted, and the interval of two order statistics x_(k), x_(n+1-k)
   that holds the median of their distribution with a probability of at least 95 %, whatever that
   distribution is: 1 - 2 B(k - 1; n, 1/2) of the binomial. Needs n >= 6; O(n log n). Source: David
   and Nagaraja, Order Statistics, 7.1. Test: test_medians.c. */
fw_study_median fw_study_median_of(double *sample, int n);

/* wider than this share of the median is not told */
static const double fw_interval_most = 0.1;
bool fw_study_median_told(const fw_study_median *m);

#endif
