/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interval arithmetic with outward rounding: an operation on intervals gives an interval that holds
   the exact result of the operation on every pair of numbers in them. Beside it centred forms,
   which say what a function does at the middle of a box, over all of it and in between.

   Directed rounding without changing the rounding mode: for a double c that is the rounded result
   of an operation, e = fl(fl(phi |c|) + eta) with phi = u (1 + 2u), u = 2^-53, eta = 2^-1074 moves
   it by at least one unit in the last place: fl(c - e) <= pred(c), fl(c + e) >= succ(c). The exact
   result lies between, since rounding to nearest errs by at most half a unit. Source: Rump,
   Zimmermann, Boldo, Melquiond, BIT 49 (2009) 419, "Computing predecessor and successor in rounding
   to nearest". Assumed of the processor: IEEE 754 doubles rounded to nearest, no contraction
   (cmake/flags.cmake). Assumed of the C library: sin, cos, acos, atan2 err by less than 2 units in
   the last place (glibc states 1 for all of them on x86-64 and aarch64); sqrt is rounded correctly
   (IEEE 754). Valid: |values| below 1e300; beyond that bounds become NaN or infinite, and every
   comparison that would prove something is false. Cost: about three times the plain operation.
   Test: test_interval.c, test_centred.c. */
#ifndef FW_MATHS_MATHS_INTERVAL_H
#define FW_MATHS_MATHS_INTERVAL_H
#include <math.h>
#include <stdbool.h>

typedef struct fw_maths_interval {
    double lo, hi;
} fw_maths_interval;

static inline double fw_step_of(double c) {
    return fabs(c) * 0x1.0000000000001p-53 + 0x1p-1074;
}

static inline double fw_down(double c) {
    return c - fw_step_of(c);
}

static inline double fw_up(double c) {
    return c + fw_step_of(c);
}

static inline fw_maths_interval fw_interval_point(double x) {
    return (fw_maths_interval){x, x};
}

/* a bounds b from below and above */
static inline bool fw_interval_holds(fw_maths_interval a, double x) {
    return a.lo <= x && x <= a.hi;
}

static inline fw_maths_interval fw_interval_hull(fw_maths_interval a, fw_maths_interval b) {
    return (fw_maths_interval){fmin(a.lo, b.lo), fmax(a.hi, b.hi)};
}

static inline double fw_interval_width(fw_maths_interval a) {
    return fw_up(a.hi - a.lo);
}

static inline fw_maths_interval fw_interval_add(fw_maths_interval a, fw_maths_interval b) {
    return (fw_maths_interval){fw_down(a.lo + b.lo), fw_up(a.hi + b.hi)};
}

static inline fw_maths_interval fw_interval_sub(fw_maths_interval a, fw_maths_interval b) {
    return (fw_maths_interval){fw_down(a.lo - b.hi), fw_up(a.hi - b.lo)};
}

static inline fw_maths_interval fw_interval_negated(fw_maths_interval a) {
    return (fw_maths_interval){-a.hi, -a.lo};
}

/* of numbers that are not negative */
static inline fw_maths_interval fw_interval_mul_sizes(fw_maths_interval a, fw_maths_interval b) {
    return (fw_maths_interval){fw_down(a.lo * b.lo), fw_up(a.hi * b.hi)};
}

fw_maths_interval fw_maths_interval_mul(fw_maths_interval a, fw_maths_interval b);
/* all numbers where b holds 0 */
fw_maths_interval fw_maths_interval_div(fw_maths_interval a, fw_maths_interval b);
fw_maths_interval fw_maths_interval_sqr(fw_maths_interval a);
/* of the part that is not negative; NaN where there is none */
fw_maths_interval fw_maths_interval_sqrt(fw_maths_interval a);
fw_maths_interval fw_maths_interval_sin(fw_maths_interval a);
fw_maths_interval fw_maths_interval_cos(fw_maths_interval a);
/* of the part within -1..1; NaN where there is none */
fw_maths_interval fw_maths_interval_acos(fw_maths_interval a);
/* -pi..pi where the rectangle holds the origin or a point of the negative x axis */
fw_maths_interval fw_maths_interval_atan2(fw_maths_interval y, fw_maths_interval x);

#endif
