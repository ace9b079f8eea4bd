/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/brent.h"
#include <float.h>
#include <math.h>

/* Brent's method: inverse quadratic interpolation and secant, bisection where they do not shrink
   the bracket. Inputs a, b, tolerance in the unit of x; output the root. Error: tolerance + 4 eps
   |x|. Cost: about 6 to 10 evaluations, never more than 200. Source: R. P. Brent, Algorithms for
   Minimization without Derivatives, 1973, ch. 4. Test: test_brent.c. */
double fw_maths_brent_root(fw_function *f, const void *context, double a, double b,
                           double tolerance) {
    double fa = f(context, a), fb = f(context, b);
    if (fa == 0) return a;
    if (fb == 0) return b;
    if (!(fa * fb < 0) && !((fa < 0) != (fb < 0))) return (double)NAN;
    if (isnan(fa) || isnan(fb)) return (double)NAN;
    double c = a, fc = fa, step = b - a, before = step;
    for (int i = 0; i < 200 && fb != 0; i++) {
        if ((fb > 0) == (fc > 0)) {
            c = a, fc = fa;
            before = step = b - a;
        }
        if (fabs(fc) < fabs(fb)) { /* b is always the best so far */
            a = b, b = c, c = a;
            fa = fb, fb = fc, fc = fa;
        }
        double least = 2 * DBL_EPSILON * fabs(b) + tolerance / 2, half = (c - b) / 2;
        if (fabs(half) <= least) break;
        double next = half, previous = half;
        if (fabs(before) >= least && fabs(fa) > fabs(fb)) {
            double s = fb / fa, p, q;
            if (a == c) {
                p = 2 * half * s;
                q = 1 - s;
            } else {
                double u = fa / fc, v = fb / fc;
                p = s * (2 * half * u * (u - v) - (b - a) * (v - 1));
                q = (u - 1) * (v - 1) * (s - 1);
            }
            if (p > 0) q = -q;
            p = fabs(p);
            if (2 * p < fmin(3 * half * q - fabs(least * q), fabs(before * q))) {
                previous = step;
                next = p / q;
            }
        }
        before = previous;
        step = next;
        a = b, fa = fb;
        b += fabs(step) > least ? step : (half > 0 ? least : -least);
        fb = f(context, b);
    }
    return b;
}
