/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Costs and errors of several settings: what is worth its cost, and what a digit costs. Plain
   arrays, no physics. */
#ifndef FW_STUDY_FRONT_H
#define FW_STUDY_FRONT_H
#include <stdbool.h>

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

#endif
