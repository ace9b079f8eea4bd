/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/maths_interval.h"

/* the double below pi: pi = 3.14159265358979323846..., 0x1.921fb54442d18p+1 + 1.2e-16 */
static const double pi_lo = 0x1.921fb54442d18p+1;

/* a library function that errs by less than 2 units in the last place */
static double below(double c) {
    return fw_down(fw_down(fw_down(c)));
}

static double above(double c) {
    return fw_up(fw_up(fw_up(c)));
}

static fw_maths_interval hull4(double a, double b, double c, double d) {
    return (fw_maths_interval){fmin(fmin(a, b), fmin(c, d)), fmax(fmax(a, b), fmax(c, d))};
}

static fw_maths_interval outward(fw_maths_interval a) {
    return (fw_maths_interval){fw_down(a.lo), fw_up(a.hi)};
}

/* a NaN among the corners (0 * inf) must not vanish in fmin: everything */
static fw_maths_interval checked(fw_maths_interval a, double sum) {
    return isnan(sum) ? (fw_maths_interval){-(double)INFINITY, (double)INFINITY} : outward(a);
}

fw_maths_interval fw_maths_interval_mul(fw_maths_interval a, fw_maths_interval b) {
    double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    return checked(hull4(p, q, r, s), p + q + r + s);
}

fw_maths_interval fw_maths_interval_div(fw_maths_interval a, fw_maths_interval b) {
    if (!(b.lo > 0.0 || b.hi < 0.0))
        return (fw_maths_interval){-(double)INFINITY, (double)INFINITY};
    double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
    return checked(hull4(p, q, r, s), p + q + r + s);
}

fw_maths_interval fw_maths_interval_sqrt(fw_maths_interval a) {
    if (!(a.hi >= 0.0)) return (fw_maths_interval){(double)NAN, (double)NAN};
    return (fw_maths_interval){a.lo > 0.0 ? fmax(fw_down(sqrt(a.lo)), 0.0) : 0.0,
                               fw_up(sqrt(a.hi))};
}

/* is there a whole number k with first + k period within a? "yes" where rounding leaves it open:
   that only widens the result. Quotients err by a few units in the last place. */
static bool passes(fw_maths_interval a, double first, double period) {
    double from = (a.lo - first) / period, to = (a.hi - first) / period;
    double slack = 0x1p-49 * (1.0 + fabs(from) + fabs(to));
    return !(ceil(from - slack) > floor(to + slack));
}

/* sin and cos: monotone between their extremes */
static fw_maths_interval wave(fw_maths_interval a, double (*of)(double), double top,
                              double bottom) {
    if (!(fabs(a.lo) < 1e5 && fabs(a.hi) < 1e5)) return (fw_maths_interval){-1.0, 1.0};
    double p = of(a.lo), q = of(a.hi);
    fw_maths_interval out = {below(fmin(p, q)), above(fmax(p, q))};
    if (passes(a, top, 2.0 * pi_lo)) out.hi = 1.0;
    if (passes(a, bottom, 2.0 * pi_lo)) out.lo = -1.0;
    return (fw_maths_interval){fmax(out.lo, -1.0), fmin(out.hi, 1.0)};
}

fw_maths_interval fw_maths_interval_sin(fw_maths_interval a) {
    return wave(a, sin, 0.5 * pi_lo, -0.5 * pi_lo);
}

fw_maths_interval fw_maths_interval_cos(fw_maths_interval a) {
    return wave(a, cos, 0.0, pi_lo);
}
