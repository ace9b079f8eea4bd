/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A root in a bracket; the distribution functions of statistics by GSL, and their inverses, some of which are such
   roots. */
#include "maths/functions.h"
#include <float.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <pthread.h>

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

/* ---- GSL ---- */

static void set_handler_off(void) {
    gsl_set_error_handler_off();
}

void fw_maths_gsl_quiet(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_handler_off);
}

/* ---- distributions ----

   Normal distribution by GSL: gsl_cdf_ugaussian_* (W. J. Cody, Math. Comp. 23 (1969) 631; inverse M. J. Wichura, Applied
   Statistics 37 (1988) 477). Quantiles of the gamma and beta distribution are roots of GSL's gsl_cdf_gamma_P and
   gsl_cdf_beta_P, because GSL's own inverses may not converge; its errors, which would end the process, become NaN.
   Error: 1e-15 relative for the normal distribution, 1e-9 for the others. Cost: below 1 us, of a root some 20 us.
   Test: test_cdf.c. */

/* (2 pi)^(-1/2) exp(-u^2/2) */
double fw_maths_normal_density(double u) {
    return gsl_ran_ugaussian_pdf(u);
}

/* P(U <= u); the upper tail is the cdf of -u */
double fw_maths_normal_cdf(double u) {
    return gsl_cdf_ugaussian_P(u);
}

/* u with P(U <= u) = p, 0 <= p <= 1; infinite at the ends */
double fw_maths_normal_quantile(double p) {
    return gsl_cdf_ugaussian_Pinv(p);
}

/* u with P(U > u) = q: exact where p = 1 - q would be rounded to 1 */
double fw_maths_normal_upper(double q) {
    return gsl_cdf_ugaussian_Qinv(q);
}

typedef struct wanted {
    double p, a, b;
} wanted;

/* in y = ln x: small quantiles keep their relative error */
static double gamma_less(const void *context, double y) {
    const wanted *w = context;
    return gsl_cdf_gamma_P(exp(y), w->a, 1.0) - w->p;
}

/* x with P(X <= x) = p, 0 < p < 1, of the gamma distribution with 1e-3 <= shape <= 1e9 and scale 1, 1e-9 <= p <=
   1 - 1e-9; chi-square with n degrees of freedom is twice that of shape n/2 */
double fw_maths_gamma_quantile(double p, double shape) {
    wanted w = {p, shape, 0};
    double most = shape + 8 * sqrt(shape) + 40;
    fw_maths_gsl_quiet();
    return exp(fw_maths_brent_root(gamma_less, &w, -700, log(most), 1e-12));
}

static double beta_less(const void *context, double y) {
    const wanted *w = context;
    return gsl_cdf_beta_P(exp(y), w->a, w->b) - w->p;
}

/* x with P(X <= x) = p, 0 < p < 1, of the beta distribution with a, b >= 1 */
double fw_maths_beta_quantile(double p, double a, double b) {
    wanted w = {p, a, b};
    fw_maths_gsl_quiet();
    return exp(fw_maths_brent_root(beta_less, &w, -700, 0, 1e-12));
}

/* Quantile of Student's t with n > 0 degrees of freedom: P(T <= t) = p, 0 < p < 1. Error 1e-12 relative. Source: GSL,
   gsl_cdf_tdist_Pinv (Hill, Comm. ACM 13 (1970) 619). Test: test_student.c (Abramowitz and Stegun, table 26.10). */
double fw_maths_student_quantile(double p, double n) {
    return gsl_cdf_tdist_Pinv(p, n);
}
