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
#include <math.h>

/* so that what is not asked for is not worked out, at any level of optimisation */
#define INLINE static inline __attribute__((always_inline))

/* below this the quotients cancel and the power series are used */
static const double small = 1.0;

/* a function and its derivatives 0..3; the last ones only where they were asked for */
typedef struct fw_flexure_series {
    double d[4];
} fw_flexure_series;

/* of t = x^2, below |x| = 1; the first one left out changes the second derivative by 1e-16 of it */
enum { OF_SINC = 10, OF_BEND = 12 };
/* (-1)^n/(2n + 1)! */
static const double sinc_of[OF_SINC] = {
    1,
    -1 / 6.0,
    1 / 120.0,
    -1 / 5040.0,
    1 / 362880.0,
    -1 / 39916800.0,
    1 / 6227020800.0,
    -1 / 1307674368000.0,
    1 / 355687428096000.0,
    -1 / 121645100408832000.0,
};
/* g: -(-4)^n/(2n + 1)! t^(n-1);  h: (-4)^n (2n - 2)/(2n + 2)! t^(n-1);  n from 1 on */
static const double bend_of[OF_BEND][2] = {
    {4 / 6.0, 0},
    {-16 / 120.0, 16 / 120.0 / 3},
    {64 / 5040.0, -64 / 5040.0 * 2 / 4},
    {-256 / 362880.0, 256 / 362880.0 * 3 / 5},
    {1024 / 39916800.0, -1024 / 39916800.0 * 4 / 6},
    {-4096 / 6227020800.0, 4096 / 6227020800.0 * 5 / 7},
    {16384 / 1307674368000.0, -16384 / 1307674368000.0 * 6 / 8},
    {-65536 / 355687428096000.0, 65536 / 355687428096000.0 * 7 / 9},
    {262144 / 121645100408832000.0, -262144 / 121645100408832000.0 * 8 / 10},
    {-1048576 / 51090942171709440000.0, 1048576 / 51090942171709440000.0 * 9 / 11},
    {4194304 / 25852016738884976640000.0, -4194304 / 25852016738884976640000.0 * 10 / 12},
    {-16777216 / 15511210043330985984000000.0, 16777216 / 15511210043330985984000000.0 * 11 / 13},
};

/* p(t) and its derivatives to those of p(x^2) by x */
static fw_flexure_series of_square(double x, double p, double slope, double curve) {
    return (fw_flexure_series){{p, 2 * x * slope, 2 * slope + 4 * x * x * curve, 0}};
}

/* sinc(x) = sin(x)/x below |x| = 1; sinc'' = -sinc - 2 sinc'/x */
INLINE fw_flexure_series sinc_near(double x, bool second) {
    double t = x * x, p = 0, slope = 0, curve = 0; /* curve: of p''/2 */
    _Pragma("GCC unroll 10") for (int n = OF_SINC - 1; n >= 0; n--) {
        if (second) curve = curve * t + slope;
        slope = slope * t + p;
        p = p * t + sinc_of[n];
    }
    return (fw_flexure_series){{p, 2 * x * slope, -p - 4 * slope, -2 * x * (slope + 8 * curve)}};
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
    double t = x * x, p[2] = {0}, slope[2] = {0}, curve[2] = {0};
    at->s = sinc_near(x, second);
    _Pragma("GCC unroll 12") for (int n = OF_BEND - 1; n >= 0; n--) for (int i = 0; i < 2; i++) {
        if (second) curve[i] = curve[i] * t + slope[i];
        slope[i] = slope[i] * t + p[i];
        p[i] = p[i] * t + bend_of[n][i];
    }
    const fw_flexure_series g = at->g = of_square(x, p[0], slope[0], 2 * curve[0]);
    at->h = of_square(x, p[1], slope[1], 2 * curve[1]);
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

/* 1/c with its derivatives by the rotation, c by x = a + q th */
static inline fw_flexure_hinge_jet inverse(const double c[3], double q) {
    double k = 1 / c[0], slope = q * c[1] * k;
    return (fw_flexure_hinge_jet){k, -slope * k, (2 * slope * slope - q * q * c[2] * k) * k};
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

/* Clenshaw's recurrence for a Chebyshev series and its first two derivatives, x = th/(2 pi):
   error 1e-14 of the largest coefficient. Cost 70 ns. Source: Clenshaw 1955. Test: test_path_law.c
 */
static fw_flexure_hinge_jet series(const double *c, double th) {
    double x = 0.5 * (1 / FW_PI) * th, b1 = 0, b2 = 0, d1 = 0, d2 = 0, e1 = 0, e2 = 0;
    for (int n = FW_PATH_TERMS - 1; n > 0; n--) {
        double e = 4 * d1 + 2 * x * e1 - e2, d = 2 * b1 + 2 * x * d1 - d2;
        double b = c[n] + 2 * x * b1 - b2;
        e2 = e1, e1 = e, d2 = d1, d1 = d, b2 = b1, b1 = b;
    }
    double per = 0.5 * (1 / FW_PI);
    return (fw_flexure_hinge_jet){c[0] + x * b1 - b2, per * (b1 + x * d1 - d2),
                                  per * per * (2 * d1 + x * e1 - e2)};
}

static fw_flexure_hinge_jet one_over(fw_flexure_hinge_jet c) {
    const double at[3] = {c.value, c.slope, c.curve};
    return inverse(at, 1);
}

static turned table_at(const struct fw_flexure_hinge_table *t, double th, fw_flexure_hinge_at *at) {
    at->kx_N_per_m = one_over(series(t->along_m_per_N, th));
    at->ky_N_per_m = one_over(series(t->across_m_per_N, th));
    at->drift_m = series(t->drift_m, th);
    return (turned){.s2 = sin(0.5 * th), .c2 = cos(0.5 * th)};
}

/* `second` is a constant where this is expanded: without it no second derivative is worked out */
INLINE turned law_at(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest, double th,
                     bool second, fw_flexure_hinge_at *at) {
    if (__builtin_expect(law->table != NULL, 0)) return table_at(law->table, th, at);
    double q = 0.5 * law->share, x = law->half_angle_rad + q * th;
    double p = law->axial_m_per_N, v = law->shear_m_per_N;
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
    double cx[3] = {along * g[0] + root * s[0] * s[0] + (p + v) + (v - p) * z[0],
                    along * g[1] + 2 * root * s[0] * s[1] + (v - p) * z[1], 0};
    double cy[3] = {across * h[0] + share * s[1] * s[1] + (p + v) - (v - p) * z[0],
                    across * h[1] + 2 * share * s[1] * s[2] - (v - p) * z[1], 0};
    if (second) {
        cx[2] = along * g[2] + 2 * root * (s[1] * s[1] + s[0] * s[2]) + (v - p) * z[2];
        cy[2] = across * h[2] + 2 * share * (s[2] * s[2] + s[1] * s[3]) - (v - p) * z[2];
    }
    at->kx_N_per_m = inverse(cx, q);
    at->ky_N_per_m = inverse(cy, q);
    double L = law->length_m, c2 = tip.c2, s2 = tip.s2;
    at->drift_m.value = L * (s[0] - c2 * rest->sinc - s2 * rest->turn);
    at->drift_m.slope = L * (q * s[1] + 0.5 * s2 * rest->sinc - 0.5 * c2 * rest->turn);
    at->drift_m.curve =
        second ? L * (q * q * s[2] + 0.25 * c2 * rest->sinc + 0.25 * s2 * rest->turn) : 0;
    return tip;
}

fw_flexure_hinge_rest fw_flexure_hinge_rest_of(const fw_flexure_hinge_law *law) {
    const fw_flexure_series a = sinc(law->half_angle_rad);
    return (fw_flexure_hinge_rest){a.d[0], law->share * a.d[1], sin(law->half_angle_rad),
                                   cos(law->half_angle_rad)};
}

void fw_flexure_hinge_law_at(const fw_flexure_hinge_law *law, double th, fw_flexure_hinge_at *at) {
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_of(law);
    law_at(law, &rest, th, true, at);
}

/* U = K th^2/2 + kx w^2/2 + ky v^2/2 with w = c ux + s uy, y = c uy - s ux, v = y - drift,
   c, s = cos, sin(th/2):  dw/dth = y/2,  dy/dth = -w/2
   in: rad, m; out: N m, N and their derivatives, symmetric. Valid and exact as the law is. Cost 60
   ns. Source: docs/theory/effects/nonlinear-hinge.md. Test: test_finite.c wrench_and_tangent */
void fw_flexure_hinge_law_wrench(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                 const double twist[3], double wrench[3], double tangent[3][3]) {
    fw_flexure_hinge_at at;
    double th = twist[0];
    const turned half = law_at(law, rest, th, true, &at);
    double c = half.c2, s = half.s2;
    const fw_flexure_hinge_jet *X = &at.kx_N_per_m, *Y = &at.ky_N_per_m, *d = &at.drift_m;
    double w = c * twist[1] + s * twist[2], y = c * twist[2] - s * twist[1], v = y - d->value;
    double w1 = 0.5 * y, v1 = -0.5 * w - d->slope, w2 = -0.25 * w, v2 = -0.25 * y - d->curve;
    double fw = X->value * w, fv = Y->value * v;
    double fw1 = X->slope * w + X->value * w1, fv1 = Y->slope * v + Y->value * v1;
    wrench[0] = law->stiffness_Nm_per_rad * th + 0.5 * (X->slope * w * w + Y->slope * v * v) +
                fw * w1 + fv * v1;
    wrench[1] = c * fw - s * fv;
    wrench[2] = s * fw + c * fv;
    tangent[0][0] = law->stiffness_Nm_per_rad + 0.5 * (X->curve * w * w + Y->curve * v * v) +
                    X->slope * w * w1 + Y->slope * v * v1 + fw1 * w1 + fv1 * v1 + fw * w2 + fv * v2;
    tangent[0][1] = tangent[1][0] = c * fw1 - s * fv1 - 0.5 * (s * fw + c * fv);
    tangent[0][2] = tangent[2][0] = s * fw1 + c * fv1 + 0.5 * (c * fw - s * fv);
    tangent[1][1] = c * c * X->value + s * s * Y->value;
    tangent[2][2] = s * s * X->value + c * c * Y->value;
    tangent[1][2] = tangent[2][1] = c * s * (X->value - Y->value);
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
    if (!in->crystal.known || in->kind != FW_FLEXURE_CSFH) return;
    fw_flexure_hinge_at even, more;
    fw_flexure_hinge_law_at(law, 0, &even);
    law->uneven_x = law->uneven_y = 1; /* what bending alone contributes */
    fw_flexure_hinge_law_at(law, 0, &more);
    double x = 1 / even.kx_N_per_m.value, y = 1 / even.ky_N_per_m.value;
    law->uneven_x = closed_form->uneven_x * x / (1 / more.kx_N_per_m.value - x);
    law->uneven_y = closed_form->uneven_y * y / (1 / more.ky_N_per_m.value - y);
}

bool fw_flexure_hinge_law_holds(const fw_flexure_hinge_law *law, double th) {
    bool within = fabs(law->half_angle_rad + 0.5 * law->share * th) < FW_PI;
    return within && (!law->table || fabs(th) < 2 * FW_PI);
}

enum { STEPS = 256, HALVINGS = 60 };

/* Pole of the displacement that turns by th and moves W by drift along y of the frame half turned:
     p = -drift / (2 sin(th/2)) along x of that frame, -> -drift'(0), nothing, at th = 0
   To first order in th it is -drift''(0) th/2: what is called the shift of the rotation centre in
   the literature (Verotti 2016); the error of a pin at W is the drift itself, second order.
   in: rad, m; out: m. Valid |th| < pi. Exact for the law. Cost 50 ns.
   Below 1e-5 rad by two terms: the slope at th is drift'(0) + drift''(0) th.
   source: docs/theory/axis-drift.md eq. 15; test_drift.c pole_stands_still */
static double pole(const fw_flexure_hinge_at *at, double th) {
    double s = 2 * sin(0.5 * th);
    return fabs(th) < 1e-5 ? 0.5 * at->drift_m.curve * th - at->drift_m.slope
                           : -at->drift_m.value / s;
}

/* what is left of a gap when the surfaces are displaced by u: gap - |u| cos zeta */
static double left(const fw_flexure_surfaces *s, double x, double y) {
    return s->gap_m - hypot(x, y) * cos(s->aside_rad);
}

/* Displacement of the second body's W in the frame half turned, h = th/2, under a force F that
   keeps its direction in the first body's frame: w = (Fx cos h + Fy sin h)/kx,  v = (Fy cos h - Fx
   sin h)/ky + drift in: rad, N; out: m. Error of the law: docs/theory/effects/nonlinear-hinge.md,
   with the square of the force. Test: test_drift.c under_a_force */
static void displaced(const fw_flexure_hinge_law *law, double th, const double F[2], double u[2]) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(law, th, &at);
    double c = cos(0.5 * th), s = sin(0.5 * th), x = F ? F[0] : 0, y = F ? F[1] : 0;
    u[0] = (c * x + s * y) / at.kx_N_per_m.value;
    u[1] = (c * y - s * x) / at.ky_N_per_m.value + at.drift_m.value;
}

/* the offset o along y of the first body is o (sin h, cos h) in the frame half turned; a point c
   that both bodies carry parts by (R(h) - R(-h)) c = 2 sin h (-c_y, c_x) */
static double left_at(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s, double th,
                      const double F[2]) {
    double u[2], h = 0.5 * th;
    displaced(law, th, F, u);
    double turn = 2 * sin(h), x = u[0] - turn * s->centre_m[1], y = u[1] + turn * s->centre_m[0];
    return left(s, x - s->offset_m * sin(h), y - s->offset_m * cos(h));
}

void fw_flexure_drift_displacement(const fw_flexure_hinge_law *law, double th, const double F[2],
                                   double u_m[2]) {
    double u[2], c = cos(0.5 * th), s = sin(0.5 * th);
    displaced(law, th, F, u);
    u_m[0] = c * u[0] - s * u[1], u_m[1] = s * u[0] + c * u[1];
}

fw_flexure_drift_point fw_flexure_drift_at(const fw_flexure_hinge_law *law,
                                           const fw_flexure_surfaces *surfaces, double th) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(law, th, &at);
    return (fw_flexure_drift_point){th, at.drift_m.value, pole(&at, th),
                                    left_at(law, surfaces, th, NULL)};
}

void fw_flexure_drift_curve(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *surfaces,
                            double low_rad, double high_rad, int n, fw_flexure_drift_point *point) {
    for (int i = 0; i < n; i++) {
        double part = n > 1 ? (double)i / (n - 1) : 0;
        point[i] = fw_flexure_drift_at(law, surfaces, low_rad + part * (high_rad - low_rad));
    }
}

/* The surfaces meet where |u| cos zeta = gap (radii Rc and Rc + gap about centres u apart).
   In: rad, m, N; out rad, to 1e-15. Sought from 0 in steps of 0.7 deg, then halved: a touch that
   ends within one step is missed. After it the hinge is a pin joint of that clearance, which this
   does not follow (contact.c does). Cost 10 to 20 us.
   source: docs/theory/axis-drift.md eq. 16; test_drift.c surfaces_meet */
double fw_flexure_drift_contact_rad(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s,
                                    const double F[2], int sense) {
    double low = 0, step = (sense < 0 ? -FW_PI : FW_PI) / STEPS;
    if (!(left_at(law, s, 0, F) > 0)) return 0;
    for (int i = 1; i < STEPS; i++) {
        double high = i * step;
        if (left_at(law, s, high, F) > 0) {
            low = high;
            continue;
        }
        for (int k = 0; k < HALVINGS; k++) {
            double middle = 0.5 * (low + high);
            if (left_at(law, s, middle, F) > 0)
                low = middle;
            else
                high = middle;
        }
        return high;
    }
    return (double)NAN;
}

/* The drift has one sign for both senses of rotation, 0 at rest: surfaces that are concentric half
   way of it need half the gap. A pin at (p, 0) from W is off by drift + 2 p sin(th/2): none at th
   where p is the pole of th.
   source: docs/theory/axis-drift.md eq. 17; test_drift.c advice_halves_the_gap */
fw_flexure_drift_advice fw_flexure_drift_advise(const fw_flexure_hinge_law *law, double low_rad,
                                                double high_rad) {
    double most = 0, least = 0;
    fw_flexure_hinge_at at;
    for (int i = 0; i <= STEPS; i++) {
        fw_flexure_hinge_law_at(law, low_rad + i * (high_rad - low_rad) / STEPS, &at);
        most = fmax(most, at.drift_m.value), least = fmin(least, at.drift_m.value);
    }
    fw_flexure_drift_advice advice = {.offset_m = 0.5 * (most + least),
                                      .centred_m = fmax(most, -least)};
    /* the offset itself turns with the first body: a little more than half is needed */
    const fw_flexure_surfaces s = {.gap_m = 0, .offset_m = advice.offset_m};
    for (int i = 0; i <= STEPS; i++) {
        double th = low_rad + i * (high_rad - low_rad) / STEPS;
        advice.gap_m = fmax(advice.gap_m, -left_at(law, &s, th, NULL));
    }
    double far = high_rad > -low_rad ? high_rad : low_rad, near = far > 0 ? -low_rad : high_rad;
    fw_flexure_hinge_law_at(law, far, &at);
    advice.pivot_x_m = pole(&at, far) * (1 - fabs(near / far));
    if (!isfinite(advice.pivot_x_m)) advice.pivot_x_m = 0;
    return advice;
}
