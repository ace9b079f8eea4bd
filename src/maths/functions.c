/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A root in a bracket; the distribution functions of statistics by GSL, and their inverses, some of which are such
   roots; turning points and cycles of a history; and functions of intervals (maths_interval.h). */
#include "maths/functions.h"
#include "maths/maths_interval.h"
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

/* ---- cycles of a history ---- */

static void push(fw_maths_turning *t, fw_arena *arena, double value) {
    if (t->count == t->room) {
        size_t room = t->room ? 2 * t->room : 64;
        double *more = fw_arena_grow(arena, t->value, t->count, room, sizeof *more);
        if (!more) {
            t->failed = true;
            return;
        }
        t->value = more;
        t->room = room;
    }
    t->value[t->count++] = value;
}

/* a turn is one when the history has come back by more than the gate */
static void follow(fw_maths_turning *t, fw_arena *arena, double value) {
    if (t->count == 0) {
        push(t, arena, value);
        t->latest = value;
    } else if (t->direction == 0) {
        if (fabs(value - t->latest) > t->gate) {
            t->direction = value > t->latest ? 1 : -1;
            t->latest = value;
        }
    } else if ((value - t->latest) * t->direction >= 0)
        t->latest = value;
    else if (fabs(value - t->latest) > t->gate) {
        push(t, arena, t->latest);
        t->direction = -t->direction;
        t->latest = value;
    }
}

/* extreme of the parabola through three samples, where the middle one is the outermost */
static bool vertex(const fw_maths_turning *p, double t, double s, double *value) {
    double a = p->t[1] - p->t[0], b = t - p->t[1], up = p->s[1] - p->s[0], down = s - p->s[1];
    if (!(a > 0) || !(b > 0) || !(up * down < 0)) return false;
    double slope = (up * b / a + down * a / b) / (a + b);
    double bend = 2 * (down / b - up / a) / (a + b);
    *value = p->s[1] - slope * slope / (2 * bend);
    return true;
}

/* One more sample. in: times s, values of any unit; out: t->value; error of a turning point
   O(spacing^3), turns below the gate are lost. Test: test_rainflow.c turning_points_of_a_sine */
void fw_maths_turning_add(fw_maths_turning *p, fw_arena *arena, double t, double s) {
    double top;
    if (p->samples >= 2 && vertex(p, t, s, &top)) follow(p, arena, top);
    follow(p, arena, s);
    p->t[0] = p->t[1];
    p->s[0] = p->s[1];
    p->t[1] = t;
    p->s[1] = s;
    p->samples++;
}

void fw_maths_turning_jump(fw_maths_turning *p) {
    p->samples = 0;
}

void fw_maths_turning_end(fw_maths_turning *p, fw_arena *arena) {
    if (p->direction != 0) push(p, arena, p->latest);
    p->direction = 0;
}

/* Rainflow counting, ASTM E1049 5.4.4: X the range of the last two turning points on the stack, Y
   that of the two before. X >= Y: Y is a cycle, or half a one where it begins the history. What
   stays at the end are half cycles.
   in: turn (n), in turn peaks and valleys; out: cycles; exact; cost O(n)
   source: ASTM E1049-85 (2017), the algorithm is described there; test_rainflow.c astm_example */
size_t fw_maths_rainflow(const double *turn, size_t n, double *work, fw_maths_cycle *cycle) {
    size_t top = 0, cycles = 0; /* work[0..top-1] is the stack */
    for (size_t i = 0; i < n; i++) {
        work[top++] = turn[i];
        while (top >= 3) {
            double a = work[top - 3], b = work[top - 2], c = work[top - 1];
            if (fabs(c - b) < fabs(b - a)) break;
            cycle[cycles++] = (fw_maths_cycle){fabs(b - a), 0.5 * (a + b), top == 3 ? 0.5 : 1.0};
            if (top == 3) {
                work[0] = b;
                work[1] = c;
                top = 2;
            } else {
                work[top - 3] = c;
                top -= 2;
            }
        }
    }
    for (size_t i = 0; i + 1 < top; i++)
        cycle[cycles++] =
            (fw_maths_cycle){fabs(work[i + 1] - work[i]), 0.5 * (work[i + 1] + work[i]), 0.5};
    return cycles;
}

/* ASTM E1049 5.4.5: a history that is repeated is cut where it is farthest out, so that only whole
   cycles are left, and closed there. Where its end is no turning point (end and beginning rise, or
   fall, into each other) it is left out.
   Test: test_rainflow.c astm_example_repeating */
size_t fw_maths_rainflow_repeating(const double *turn, size_t n, double *work,
                                   fw_maths_cycle *cycle) {
    size_t from = 0, m = 0;
    if (n < 2) return 0;
    for (size_t i = 1; i < n; i++)
        if (fabs(turn[i]) > fabs(turn[from])) from = i;
    for (size_t i = 0; i <= n; i++) {
        double v = turn[(from + i) % n];
        while (m >= 1 && v == work[m - 1])
            m--;
        while (m >= 2 && (work[m - 1] - work[m - 2]) * (v - work[m - 1]) > 0)
            m--; /* on the way, no turn */
        work[m++] = v;
    }
    /* the stack of the plain count grows behind what it reads */
    size_t cycles = fw_maths_rainflow(work, m, work, cycle), half = 0, whole = 0;
    for (size_t i = 0; i < cycles; i++) { /* two halves of the largest make one */
        if (cycle[i].count < 1 && half++ % 2) continue;
        cycle[whole] = cycle[i];
        cycle[whole++].count = 1;
    }
    return whole;
}

/* ---- intervals ---- */

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
