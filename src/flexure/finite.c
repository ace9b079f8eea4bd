/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With L the length of the strip, a half its subtended angle, lam = L/(L + 2 dL) the share of the
   rotation th that it takes (the roots take the rest), x = a + lam th/2 half its angle when wound:

     drift = L [sinc(x) - cos(th/2) sinc(a) - lam sin(th/2) sinc'(a)]
     1/kx  = L^3/(8EI) g(x) + dL L^2/(2EI) sinc(x)^2       + L/(2EA) (1 - z) + L/(2kGA) (1 + z)
     1/ky  = L^3/(8EI) h(x) + dL L^2/(2EI) lam sinc'(x)^2  + L/(2EA) (1 + z) + L/(2kGA) (1 - z)
     g(x) = (1 - z)/x^2,  h(x) = (1 + z - 2 sinc(x)^2)/x^2,  z = sinc(2x)

   Axis x along the symmetry axis of the arc, y along its chord, both half turned. Under a pure
   moment the strip stays a circular arc, which gives the drift exactly for an inextensible strip;
   the second variation about that state is the linear compliance of the wound arc, which makes
   forces exact to first order at any rotation (error of the displacement grows with the square of
   the force). dL = 0: the law of a plain arc; a = 0: a straight leaf; all functions are entire, so
   that no limit is special.
   In: geometry m, rad, E in Pa. Out: N/m and m with two derivatives. Valid |x| < pi (the arc does
   not close), |u| << r. Error against the geometrically exact beam: 0.5 % of u at 200 uN on 2a =
   270 deg, r = 100 um, a quarter of that at half the force; against 3-D finite elements with real
   roots kx is 0.4 to 0.9 %, ky 0.8 to 1.3 % too low, the drift right within 0.006 um. Cost of
   values and slopes 35 ns (tests/bench/bench_hinge_closed.c). Source:
   derived in docs/theory/effects/nonlinear-hinge.md. Test: test_finite.c. */
#include "flexure/finite.h"
#include "base/constants.h"
#include "flexure/path.h"
#include "flexure/section.h"
#include <math.h>

/* so that what is not asked for is not worked out, at any level of optimisation */
#define INLINE static inline __attribute__((always_inline))

/* below this the quotients cancel and the power series are used */
static const double small = 1.0;

/* a function and its derivatives 0..3; the last ones only where they were asked for */
typedef struct fw_flexure_series {
    double d[4];
} fw_flexure_series;

/* p(t) and its derivatives to those of p(x^2) by x */
static fw_flexure_series of_square(double x, double p, double slope, double curve) {
    return (fw_flexure_series){{p, 2 * x * slope, 2 * slope + 4 * x * x * curve, 0}};
}

typedef struct near_series { /* a polynomial of t and its first two derivatives */
    double p, slope, curve;
} near_series;

/* of eight terms, by Estrin's scheme as in finite_lanes.c, whose drift is to have the same bits: what v is off it by is
   what pulls a leaf, which hardly gives along its chord */
INLINE near_series estrin(const double *c, double t, bool second) {
    const double t2 = t * t, t4 = t2 * t2;
    return (near_series){((c[0] + c[1] * t) + t2 * (c[2] + c[3] * t)) +
                             t4 * ((c[4] + c[5] * t) + t2 * (c[6] + c[7] * t)),
                         ((c[1] + 2 * c[2] * t) + t2 * (3 * c[3] + 4 * c[4] * t)) +
                             t4 * ((5 * c[5] + 6 * c[6] * t) + t2 * (7 * c[7])),
                         second ? ((2 * c[2] + 6 * c[3] * t) + t2 * (12 * c[4] + 20 * c[5] * t)) +
                                      t4 * (30 * c[6] + 42 * c[7] * t)
                                : 0};
}

/* sinc(x) = sin(x)/x below |x| = 1; sinc'' = -sinc - 2 sinc'/x */
INLINE fw_flexure_series sinc_near(double x, bool second) {
    const near_series s = estrin(fw_flexure_sinc_of, x * x, second);
    return (fw_flexure_series){
        {s.p, 2 * x * s.slope, -s.p - 4 * s.slope, -2 * x * (s.slope + 4 * s.curve)}};
}

/* the same where x is large enough to divide by */
static inline fw_flexure_series sinc_far(double over, double sine, double cosine) {
    fw_flexure_series s;
    s.d[0] = sine * over;
    s.d[1] = (cosine - s.d[0]) * over;
    s.d[2] = -s.d[0] - 2 * s.d[1] * over;
    s.d[3] = -s.d[1] - 2 * over * (s.d[2] - s.d[1] * over);
    return s;
}

static fw_flexure_series sinc(double x) {
    return fabs(x) < small ? sinc_near(x, true) : sinc_far(1 / x, sin(x), cos(x));
}

typedef struct shape { /* what the law is made of, at x: sinc, z = sinc(2x), g and h */
    fw_flexure_series s, z, g, h;
} shape;

INLINE void shape_near(double x, bool second, shape *at) {
    const double t = x * x;
    const near_series b = estrin(fw_flexure_g_of, t, second),
                      c = estrin(fw_flexure_h_of, t, second);
    at->s = sinc_near(x, second);
    const fw_flexure_series g = at->g = of_square(x, b.p, b.slope, b.curve);
    at->h = of_square(x, t * c.p, c.p + t * c.slope, 2 * c.slope + t * c.curve);
    at->z = (fw_flexure_series){{1 - t * g.d[0], -2 * x * g.d[0] - t * g.d[1],
                                 -2 * g.d[0] - 4 * x * g.d[1] - t * g.d[2], 0}};
}

/* n(x)/x^2 from n and its first two derivatives */
static inline fw_flexure_series over_square(double n, double slope, double curve, double over) {
    double square = over * over, q = n * square, d = slope * square - 2 * q * over;
    return (fw_flexure_series){{q, d, (curve - 2 * q) * square - 4 * d * over, 0}};
}

static inline void shape_far(double x, double sine, double cosine, shape *at) {
    double over = 1 / x;
    const fw_flexure_series s = at->s = sinc_far(over, sine, cosine);
    const fw_flexure_series z = at->z =
        (fw_flexure_series){{s.d[0] * cosine, s.d[1] * cosine - s.d[0] * sine,
                             (s.d[2] - s.d[0]) * cosine - 2 * s.d[1] * sine, 0}};
    at->g = over_square(1 - z.d[0], -z.d[1], -z.d[2], over);
    at->h = over_square(1 + z.d[0] - 2 * s.d[0] * s.d[0], z.d[1] - 4 * s.d[0] * s.d[1],
                        z.d[2] - 4 * (s.d[1] * s.d[1] + s.d[0] * s.d[2]), over);
}

typedef double pair __attribute__((vector_size(16)));

/* sine and cosine of two angles below 0.8 side by side, by their power series to t^7, t = angle^2:
   what is left out is below 1e-16 of the sine, 1e-15 t^8 of one in the cosine. Cost 8 ns */
INLINE void turn_both(pair angle, pair *sine, pair *cosine) {
    const pair t = angle * angle, t2 = t * t, t4 = t2 * t2;
    const pair s = (1 - t * (1 / 6.0)) + t2 * (1 / 120.0 - t * (1 / 5040.0)) +
                   t4 * ((1 / 362880.0 - t * (1 / 39916800.0)) +
                         t2 * (1 / 6227020800.0 - t * (1 / 1307674368000.0)));
    const pair c = (1 - t * 0.5) + t2 * (1 / 24.0 - t * (1 / 720.0)) +
                   t4 * ((1 / 40320.0 - t * (1 / 3628800.0)) +
                         t2 * (1 / 479001600.0 - t * (1 / 87178291200.0))) +
                   t4 * t4 * (1 / 20922789888000.0);
    *sine = angle * s, *cosine = c;
}

typedef struct turned { /* sine and cosine of x and of th/2 */
    double sine, cosine, s2, c2;
} turned;

/* x = a + q th: the free arc's own sine and cosine are at hand */
INLINE turned turn(const fw_flexure_hinge_rest *rest, double x, double part, double half) {
    if (!(fabs(half) < 0.8 && fabs(part) < 0.8))
        return (turned){sin(x), cos(x), sin(half), cos(half)};
    pair s, c;
    turn_both((pair){part, half}, &s, &c);
    return (turned){rest->sine * c[0] + rest->cosine * s[0],
                    rest->cosine * c[0] - rest->sine * s[0], s[1], c[1]};
}

/* Clenshaw's recurrence for two Chebyshev series side by side, with their first two derivatives (the
   second only where it is wanted), x = th/(2 pi): error 1e-14 of the largest coefficient. Cost 60 ns
   without the second derivative. Source: Clenshaw 1955. Test: test_path_law.c */
INLINE void two_series(const double *c, const double *d, int terms, double th, bool second,
                       fw_flexure_hinge_jet out[2]) {
    double x = 0.5 * (1 / FW_PI) * th, per = 0.5 * (1 / FW_PI);
    pair b1 = {0}, b2 = {0}, d1 = {0}, d2 = {0}, e1 = {0}, e2 = {0};
    for (int n = terms - 1; n > 0; n--) {
        if (second) {
            pair e = 4 * d1 + 2 * x * e1 - e2;
            e2 = e1, e1 = e;
        }
        pair slope = 2 * b1 + 2 * x * d1 - d2, b = (pair){c[n], d[n]} + 2 * x * b1 - b2;
        d2 = d1, d1 = slope, b2 = b1, b1 = b;
    }
    for (int i = 0; i < 2; i++)
        out[i] = (fw_flexure_hinge_jet){(i ? d : c)[0] + x * b1[i] - b2[i],
                                        per * (b1[i] + x * d1[i] - d2[i]),
                                        per * per * (2 * d1[i] + x * e1[i] - e2[i])};
}

void fw_flexure_hinge_series(const double *c, const double *d, int terms, double th, bool second,
                             fw_flexure_hinge_jet out[2]) {
    if (second)
        two_series(c, d, terms, th, true, out);
    else
        two_series(c, d, terms, th, false, out);
}

/* ---- what a pull does, which depends on how far the arc is wound ---- */

enum { TERMS = FW_WINDING_TERMS };
/* two of them side by side */
INLINE void polynomials(const double (*c)[TERMS], double x, double q, const double by[2],
                        bool second, fw_flexure_hinge_jet out[2]) {
    double t = x * x;
    pair p = {0}, s = {0}, h = {0};
    for (int n = TERMS - 1; n >= 0; n--) {
        if (second) h = h * t + s;
        s = s * t + p;
        p = p * t + (pair){c[0][n], c[1][n]};
    }
    for (int i = 0; i < 2; i++)
        out[i] = (fw_flexure_hinge_jet){by[i] * p[i], by[i] * q * 2 * x * s[i],
                                        second ? by[i] * q * q * (2 * s[i] + 8 * t * h[i]) : 0};
}

INLINE void wind(const fw_flexure_hinge_law *law, double th, bool second,
                 fw_flexure_hinge_wound *at) {
    double q = 0.5 * law->share, x = law->half_angle_rad + q * th;
    /* beyond a full turn nothing is known: the ends' values go on */
    if (fabs(x) > FW_PI) x = copysign(FW_PI, x), q = 0;
    double per = 8 * law->bend_m_per_N / law->length_m; /* L^2/EI */
    fw_flexure_hinge_jet a[2], b[2], c[2];
    polynomials(fw_flexure_winding, x, q, (const double[2]){per, per}, second, a);
    polynomials(fw_flexure_winding + 2, x, q, (const double[2]){1, 1}, second, b);
    polynomials(fw_flexure_winding + 4, x, q, (const double[2]){1, 1}, second, c);
    *at = (fw_flexure_hinge_wound){a[0], a[1], b[0], b[1], c[0], c[1], per};
    if (!law->table) return;
    two_series(law->table->pull_x, law->table->pull_y, law->table->terms, th, second, a);
    at->px = a[0], at->py = a[1], at->per_N = 0;
}

void fw_flexure_hinge_law_wound(const fw_flexure_hinge_law *law, double th, bool second,
                                fw_flexure_hinge_wound *at) {
    if (second)
        wind(law, th, true, at);
    else
        wind(law, th, false, at);
}

static fw_flexure_hinge_jet one_over(fw_flexure_hinge_jet c) {
    double k = 1 / c.value, slope = c.slope * k;
    return (fw_flexure_hinge_jet){k, -slope * k, (2 * slope * slope - c.curve * k) * k};
}

static fw_flexure_hinge_jet sum_of(fw_flexure_hinge_jet a, fw_flexure_hinge_jet b) {
    return (fw_flexure_hinge_jet){a.value + b.value, a.slope + b.slope, a.curve + b.curve};
}

static turned table_at(const struct fw_flexure_hinge_table *t, double th, bool second,
                       fw_flexure_hinge_soft *at) {
    fw_flexure_hinge_jet x[2], y[2], drift[2];
    fw_flexure_hinge_series(t->bend_x, t->rest_x, t->terms, th, second, x);
    fw_flexure_hinge_series(t->bend_y, t->rest_y, t->terms, th, second, y);
    fw_flexure_hinge_series(t->drift_m, t->drift_m, t->terms, th, second, drift);
    *at = (fw_flexure_hinge_soft){
        .bend_x = x[0], .rest_x = x[1], .bend_y = y[0], .rest_y = y[1], .drift_m = drift[0]};
    return (turned){.s2 = sin(0.5 * th), .c2 = cos(0.5 * th)};
}

/* value and derivatives by x as those by th */
static inline fw_flexure_hinge_jet by_rotation(double value, double slope, double curve, double q) {
    return (fw_flexure_hinge_jet){value, q * slope, q * q * curve};
}

/* `second` is a constant where this is expanded: without it no second derivative is worked out */
INLINE turned soft_at(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest, double th,
                      bool second, fw_flexure_hinge_soft *at) {
    if (__builtin_expect(law->table != NULL, 0)) return table_at(law->table, th, second, at);
    double q = 0.5 * law->share, x = law->half_angle_rad + q * th;
    double p = law->axial_m_per_N, v = law->shear_m_per_N, both = p + v, apart = v - p;
    double root = law->root_m_per_N, share = root * law->share;
    double along = law->bend_m_per_N * (1 + law->uneven_x);
    double across = law->bend_m_per_N * (1 + law->uneven_y);
    const turned tip = turn(rest, x, q * th, 0.5 * th);
    shape f;
    if (fabs(x) < small)
        shape_near(x, second, &f);
    else
        shape_far(x, tip.sine, tip.cosine, &f);
    const double *s = f.s.d, *g = f.g.d, *h = f.h.d, *z = f.z.d;
    double c2 = second ? 1 : 0; /* of what is not worked out nothing is taken */
    at->bend_x = by_rotation(along * g[0], along * g[1], c2 * along * g[2], q);
    at->rest_x =
        by_rotation(root * s[0] * s[0] + both + apart * z[0], 2 * root * s[0] * s[1] + apart * z[1],
                    second ? 2 * root * (s[1] * s[1] + s[0] * s[2]) + apart * z[2] : 0, q);
    at->bend_y =
        by_rotation(across * h[0] + share * s[1] * s[1], across * h[1] + 2 * share * s[1] * s[2],
                    second ? across * h[2] + 2 * share * (s[2] * s[2] + s[1] * s[3]) : 0, q);
    at->rest_y = by_rotation(both - apart * z[0], -apart * z[1], second ? -apart * z[2] : 0, q);
    double L = law->length_m, c = tip.c2, s2 = tip.s2;
    at->drift_m.value = L * (s[0] - c * rest->sinc - s2 * rest->turn);
    at->drift_m.slope = L * (q * s[1] + 0.5 * s2 * rest->sinc - 0.5 * c * rest->turn);
    at->drift_m.curve =
        second ? L * (q * q * s[2] + 0.25 * c * rest->sinc + 0.25 * s2 * rest->turn) : 0;
    return tip;
}

INLINE void law_at(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest, double th,
                   bool second, fw_flexure_hinge_at *at) {
    fw_flexure_hinge_soft soft;
    soft_at(law, rest, th, second, &soft);
    at->kx_N_per_m = one_over(sum_of(soft.bend_x, soft.rest_x));
    at->ky_N_per_m = one_over(sum_of(soft.bend_y, soft.rest_y));
    at->drift_m = soft.drift_m;
}

void fw_flexure_hinge_law_soft(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                               double th, bool second, fw_flexure_hinge_soft *at) {
    if (second)
        soft_at(law, rest, th, true, at);
    else
        soft_at(law, rest, th, false, at);
}

fw_flexure_hinge_rest fw_flexure_hinge_rest_bare(const fw_flexure_hinge_law *law) {
    const fw_flexure_series a = sinc(law->half_angle_rad);
    return (fw_flexure_hinge_rest){.sinc = a.d[0],
                                   .turn = law->share * a.d[1],
                                   .sine = sin(law->half_angle_rad),
                                   .cosine = cos(law->half_angle_rad),
                                   .number[FW_HINGE_RANGE] = -1};
}

/* Taylor's series of n of finite_force.c,
     n = (b + e a)/((1/60 + e) (1 + e y a)),  a = sum a_k y^k, b = -sum a_(k+1) y^k
   with Chebyshev's polynomial of degree 7 on |y| <= R taken away: what is left out is (R/y0)^7/64 of one, y0 the pole,
   which is beyond -20 where e is below a tenth. Test: test_finite_lanes.c */
static void series_along(double e, double range, double *n) {
    enum { LAST = 7 };
    static const double a[LAST + 2] = {1,
                                       -0.016666666666666666,
                                       0.0003968249976586689,
                                       -9.920628222132633e-06,
                                       2.505210279888954e-07,
                                       -6.341027840654833e-09,
                                       1.6059043683015606e-10,
                                       -4.067616349232315e-12,
                                       1.0303274465129939e-13};
    double c[LAST + 1];
    for (int k = 0; k <= LAST; k++) {
        c[k] = e * a[k] - a[k + 1];
        for (int j = 1; j <= k; j++)
            c[k] -= e * a[j - 1] * c[k - j];
    }
    double r2 = range * range, over = 1 / (1 / 60.0 + e);
    c[1] += c[7] * 7 / 64 * r2 * r2 * r2, c[3] -= c[7] * 56 / 64 * r2 * r2;
    c[5] += c[7] * 112 / 64 * r2;
    for (int k = 1; k < LAST; k++) {
        n[k - 1] = over * c[k];
        if (k > 1) n[FW_HINGE_N_SLOPE - FW_HINGE_N + k - 2] = k * n[k - 1];
        if (k > 2) n[FW_HINGE_N_CURVE - FW_HINGE_N + k - 3] = k * (k - 1) * n[k - 1];
    }
}

/* for finite_lanes.c; a path's table, and what has no strip, are not for it */
static void count_up(const fw_flexure_hinge_law *law, fw_flexure_hinge_rest *rest) {
    const double L = law->length_m, range = 0.25, most_e = 0.1;
    const double per = 8 * law->bend_m_per_N / L, unit = 1 / (per * L); /* L^2/EI */
    const double e = fw_flexure_hinge_chord_roots(law);
    double *to = rest->number;
    if (law->table || !(law->bend_m_per_N > 0) || !(e < most_e)) return;
    to[FW_HINGE_RANGE] = range;
    to[FW_HINGE_STIFFNESS] = law->stiffness_Nm_per_rad;
    to[FW_HINGE_LENGTH] = L, to[FW_HINGE_PER_LENGTH] = 1 / L, to[FW_HINGE_FORCE] = 1 / per;
    to[FW_HINGE_HALF_ANGLE] = law->half_angle_rad, to[FW_HINGE_Q] = 0.5 * law->share;
    to[FW_HINGE_SINC] = rest->sinc, to[FW_HINGE_TURN] = rest->turn;
    to[FW_HINGE_SINE] = rest->sine, to[FW_HINGE_COSINE] = rest->cosine;
    to[FW_HINGE_ALONG] = 0.125 * (1 + law->uneven_x);
    to[FW_HINGE_ACROSS] = 0.125 * (1 + law->uneven_y);
    to[FW_HINGE_ROOT] = unit * law->root_m_per_N;
    to[FW_HINGE_ROOT_ACROSS] = law->share * to[FW_HINGE_ROOT];
    to[FW_HINGE_BOTH] = unit * (law->axial_m_per_N + law->shear_m_per_N);
    to[FW_HINGE_APART] = unit * (law->shear_m_per_N - law->axial_m_per_N);
    series_along(e, range, to + FW_HINGE_N);
}

fw_flexure_hinge_rest fw_flexure_hinge_rest_of(const fw_flexure_hinge_law *law) {
    fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_bare(law);
    count_up(law, &rest);
    return rest;
}

void fw_flexure_hinge_law_at(const fw_flexure_hinge_law *law, double th, fw_flexure_hinge_at *at) {
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_bare(law);
    law_at(law, &rest, th, true, at);
}

void fw_flexure_hinge_law_slopes(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                 double th, fw_flexure_hinge_at *at) {
    law_at(law, rest, th, false, at);
}

/* EI is what makes K = EI/(L + 2 dL) the stiffness of the closed form, so that depth and curvature
   corrections hold for forces too. A crystal's arc is one of its mean modulus that bends more along
   or across by what makes kx and ky at rest differ from those of that modulus; its C_xy is not in
   the law; the pins are at its own W. */
void fw_flexure_hinge_law_of(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                             fw_flexure_hinge_law *law) {
    double L = in->length_m, dL = closed_form->root_length_m;
    double EI = closed_form->stiffness_Nm_per_rad * (L + 2 * dL);
    double EA = closed_form->youngs_Pa * in->depth_m * in->width_m;
    double kGA = 5.0 / 6.0 * EA / (2 * (1 + closed_form->poisson));
    *law = (fw_flexure_hinge_law){.stiffness_Nm_per_rad = closed_form->stiffness_Nm_per_rad,
                                  .half_angle_rad =
                                      in->kind == FW_FLEXURE_CSFH ? 0.5 * in->angle_rad : 0,
                                  .length_m = L,
                                  .share = L / (L + 2 * dL),
                                  .bend_m_per_N = L * L * L / (8 * EI),
                                  .root_m_per_N = dL * L * L / (2 * EI),
                                  .axial_m_per_N = L / (2 * EA),
                                  .shear_m_per_N = L / (2 * kGA)};
    if (in->kind != FW_FLEXURE_CSFH || !fw_flexure_elastic_of(in).known) return;
    fw_flexure_hinge_at even, more;
    fw_flexure_hinge_law_at(law, 0, &even);
    law->uneven_x = law->uneven_y = 1; /* what bending alone contributes */
    fw_flexure_hinge_law_at(law, 0, &more);
    double x = 1 / even.kx_N_per_m.value, y = 1 / even.ky_N_per_m.value;
    law->uneven_x = closed_form->uneven_x * x / (1 / more.kx_N_per_m.value - x);
    law->uneven_y = closed_form->uneven_y * y / (1 / more.ky_N_per_m.value - y);
}

/* A table of its own, with compliances 1/`bend` times as large, those of axial and shear force along the chord 1/`rest_y` times, and
   1/`pull` times what a pull changes */
static fw_status scale_table(fw_arena *arena, fw_flexure_hinge_law *law, double bend, double rest_y,
                             double pull) {
    if (!law->table) return FW_OK;
    struct fw_flexure_hinge_table *t = fw_arena_one(arena, struct fw_flexure_hinge_table);
    FW_NEED(t);
    *t = *law->table;
    for (int n = 0; n < FW_PATH_TERMS; n++) {
        t->bend_x[n] /= bend, t->bend_y[n] /= bend;
        t->rest_x[n] /= bend, t->rest_y[n] /= rest_y;
        t->pull_x[n] /= pull, t->pull_y[n] /= pull;
    }
    law->table = t;
    return FW_OK;
}

fw_status fw_flexure_hinge_law_scale(fw_arena *arena, fw_flexure_hinge_law *law, double by) {
    law->stiffness_Nm_per_rad *= by;
    law->bend_m_per_N /= by, law->root_m_per_N /= by;
    law->axial_m_per_N /= by, law->shear_m_per_N /= by;
    return scale_table(arena, law, by, by, by);
}

bool fw_flexure_hinge_law_straight(const fw_flexure_hinge_law *law) {
    return law->table ? law->table->straight : law->half_angle_rad == 0;
}

fw_status fw_flexure_hinge_law_along(fw_arena *arena, fw_flexure_hinge_law *law, double by) {
    if (fw_flexure_hinge_law_straight(law)) {
        law->axial_m_per_N /= by;
        return scale_table(arena, law, 1, by, 1);
    }
    law->uneven_x = (1 + law->uneven_x) / by - 1, law->uneven_y = (1 + law->uneven_y) / by - 1;
    law->root_m_per_N /= by, law->axial_m_per_N /= by, law->shear_m_per_N /= by;
    return scale_table(arena, law, by, by, 1);
}

bool fw_flexure_hinge_law_holds(const fw_flexure_hinge_law *law, double th) {
    bool within = fabs(law->half_angle_rad + 0.5 * law->share * th) < FW_PI;
    return within && (!law->table || fabs(th) < 2 * FW_PI);
}

/* ---- twists, as the frame half turned sees them ---- */

/* w = c ux + s uy, v = c uy - s ux with c, s = cos, sin(th/2):  dw/dth = v/2,  dv/dth = -w/2
   in: rad, m; out: N m, N and their derivatives, symmetric. Test: test_finite_force.c
   wrench_and_tangent */
fw_flexure_half_turned fw_flexure_hinge_half_turned(const double twist[3]) {
    const double c = cos(0.5 * twist[0]), s = sin(0.5 * twist[0]);
    return (fw_flexure_half_turned){
        {twist[0], c * twist[1] + s * twist[2], c * twist[2] - s * twist[1]}, c, s};
}

void fw_flexure_hinge_wrench_of(const fw_flexure_hinge_bent *b, const fw_flexure_half_turned *half,
                                double wrench[3], double tangent[3][3]) {
    const double w = half->at[1], v = half->at[2], c = half->cosine, s = half->sine;
    const double *g = b->gradient;
    const double j[3][3] = {
        {1, 0, 0}, {0.5 * v, c, s}, {-0.5 * w, -s, c}}; /* d(th, w, v)/d twist */
    for (int i = 0; i < 3; i++) {
        wrench[i] = 0;
        for (int k = 0; k < 3; k++)
            wrench[i] += g[k] * j[k][i];
    }
    if (!tangent) return;
    for (int i = 0; i < 3; i++)
        for (int m = 0; m < 3; m++) {
            tangent[i][m] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    tangent[i][m] += j[k][i] * b->hessian[k][l] * j[l][m];
        }
    tangent[0][0] -= 0.25 * (g[1] * w + g[2] * v);
    const double wx = -0.5 * s, wy = 0.5 * c; /* d2w/dth du; of v: -wy, wx */
    tangent[0][1] += g[1] * wx - g[2] * wy, tangent[0][2] += g[1] * wy + g[2] * wx;
    tangent[1][0] = tangent[0][1], tangent[2][0] = tangent[0][2];
}
