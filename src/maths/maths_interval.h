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
/* of the part that is not negative; NaN where there is none */
fw_maths_interval fw_maths_interval_sqrt(fw_maths_interval a);
fw_maths_interval fw_maths_interval_sin(fw_maths_interval a);
fw_maths_interval fw_maths_interval_cos(fw_maths_interval a);

/* Centred forms: a quantity over a box, as one number and two radii. At the middle of the box its
   value lies within m +- e (rounding), anywhere in the box within m +- r. On the way, at the share
   s of the distance from the middle, within m +- rho(s), where rho is convex in s, rho(0) <= e and
   rho(1) <= r: every operation below makes its radius from those of its operands by a convex
   function that does not decrease. So the mean of rho over the way is at most (e + r)/2, which
   makes Taylor's remainder from bounds of the gradient half as large as the mean-value form:

     f(c + d) = f(c) + integral_0^1 grad f(c + s d).d ds  within  f.m +- f.e + g.m d +- (g.e +
   g.r)/2 |d|

   Radii are rounded upward: a sum or product of numbers that are not negative errs by at most 2^-53
   relative per operation, of which there are at most six here; `grow` is 1 + 2^-50.
   Assumptions, validity as in maths_interval.h. Cost: about 12 flops each, the radii two at a
   time. Test:
   test_centred.c. */

typedef struct fw_maths_centred {
    double m, e, r;
} fw_maths_centred;

/* both radii side by side: one operation for two; lanes are rounded as numbers are */
typedef double fw_radii __attribute__((vector_size(16)));

/* a call, with its operands through memory, costs more than the operation */
#define FW_CENTRED static inline __attribute__((always_inline))

FW_CENTRED double fw_grown(double radius) {
    return radius * 0x1.0000000000004p+0 + 1e-300;
}

FW_CENTRED fw_radii fw_radii_of(fw_maths_centred a) {
    return (fw_radii){a.e, a.r};
}

/* m within radii that its rounding has grown by u */
FW_CENTRED fw_maths_centred fw_centred_within(double m, fw_radii radii, double u) {
    fw_radii grown = (radii + u) * 0x1.0000000000004p+0 + 1e-300;
    return (fw_maths_centred){m, grown[0], grown[1]};
}

/* a number known exactly */
FW_CENTRED fw_maths_centred fw_centred_exact(double x) {
    return (fw_maths_centred){x, 0.0, 0.0};
}

/* a coordinate of the box: c within +- half */
FW_CENTRED fw_maths_centred fw_centred_axis(double c, double half) {
    return (fw_maths_centred){c, 0.0, half};
}

FW_CENTRED fw_maths_interval fw_centred_range(fw_maths_centred a) {
    return (fw_maths_interval){fw_down(a.m - a.r), fw_up(a.m + a.r)};
}

FW_CENTRED fw_maths_centred fw_centred_negated(fw_maths_centred a) {
    return (fw_maths_centred){-a.m, a.e, a.r};
}

FW_CENTRED fw_maths_centred fw_centred_add(fw_maths_centred a, fw_maths_centred b) {
    double m = a.m + b.m;
    return fw_centred_within(m, fw_radii_of(a) + fw_radii_of(b), fabs(m) * 0x1p-53);
}

FW_CENTRED fw_maths_centred fw_centred_sub(fw_maths_centred a, fw_maths_centred b) {
    double m = a.m - b.m;
    return fw_centred_within(m, fw_radii_of(a) + fw_radii_of(b), fabs(m) * 0x1p-53);
}

/* |xy - ab| <= |a| rb + ra (|b| + rb) */
FW_CENTRED fw_maths_centred fw_centred_mul(fw_maths_centred a, fw_maths_centred b) {
    double m = a.m * b.m, x = fabs(a.m), y = fabs(b.m);
    fw_radii p = fw_radii_of(a), q = fw_radii_of(b);
    return fw_centred_within(m, x * q + p * (y + q), fabs(m) * 0x1p-53);
}

/* by a number known exactly */
FW_CENTRED fw_maths_centred fw_centred_scaled(fw_maths_centred a, double k) {
    double m = a.m * k;
    return fw_centred_within(m, fw_radii_of(a) * fabs(k), fabs(m) * 0x1p-53);
}

/* |1/x - 1/m| <= r/(|m| (|m| - r)); not finite where the box may hold 0 */
FW_CENTRED fw_maths_centred fw_centred_inverse(fw_maths_centred a) {
    double m = 1.0 / a.m, x = fabs(a.m);
    if (!(x - a.r > 0.0)) return (fw_maths_centred){m, (double)INFINITY, (double)INFINITY};
    fw_radii p = fw_radii_of(a);
    return fw_centred_within(m, p / (x * (x - p)), fabs(m) * 0x1p-53);
}

/* |sqrt(x) - sqrt(m)| <= sqrt(m) - sqrt(m - r) = r/(sqrt(m) + sqrt(m - r)); not finite where the
   box may hold a negative number */
FW_CENTRED fw_maths_centred fw_centred_sqrt(fw_maths_centred a) {
    double m = sqrt(a.m), full = a.m - a.r;
    if (!(full > 0.0)) return (fw_maths_centred){m, (double)INFINITY, (double)INFINITY};
    fw_radii roots = {sqrt(a.m - a.e), sqrt(full)};
    return fw_centred_within(m, fw_radii_of(a) / (m + roots), m * 0x1p-53);
}

/* |sin x - sin m| <= |cos m| r + r^2/2, and 2 units in the last place for the library */
FW_CENTRED void fw_centred_turn(fw_maths_centred a, fw_maths_centred *sine,
                                fw_maths_centred *cosine) {
    double s = sin(a.m), c = cos(a.m), x = fabs(s), y = fabs(c);
    double us = x * 0x1p-51, uc = y * 0x1p-51;
    fw_radii p = fw_radii_of(a), half = 0.5 * p * p;
    x *= 0x1.00000000001p+0, y *= 0x1.00000000001p+0; /* they err themselves */
    *sine = fw_centred_within(s, y * p + half, us);
    *cosine = fw_centred_within(c, x * p + half, uc);
}

/* direction of the vector (x, y) at the middle of the box only: |error| <= asin(rho/n) <= (pi/2)
   rho/n for a vector of length n known within rho < n */
FW_CENTRED fw_maths_interval fw_centred_direction(fw_maths_centred y, fw_maths_centred x) {
    double angle = atan2(y.m, x.m), n = fmax(fabs(x.m), fabs(y.m)), rho = x.e + y.e;
    double error = 1.5708 * rho / n * 1.000001 + 0x1p-50 * fabs(angle);
    if (!(rho < n)) error = (double)INFINITY;
    return (fw_maths_interval){fw_down(angle - error), fw_up(angle + error)};
}

#endif
