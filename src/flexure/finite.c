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
   roots kx is 0.4 to 0.9 %, ky 0.8 to 1.3 % too low, the drift right within 0.006 um. Cost about
   0.2 us. Source: derived in docs/theory/effects/nonlinear-hinge.md. Test: test_finite.c. */
#include "flexure/finite.h"
#include <math.h>

/* below this the quotients cancel and the power series are used */
static const double small = 1.0;

/* sum of c_n x^(2n + shift), c from ratio(n) = c_n/c_(n-1), and its derivatives 0..3 */
typedef struct fw_series {
    double d[4];
} fw_series;

static void add_power(fw_series *s, double c, double x, int power) {
    for (int k = 0; k < 4 && k <= power; k++) {
        s->d[k] += c * pow(x, power - k);
        c *= power - k;
    }
}

enum { TERMS = 13 }; /* the first one left out is below 2^26/27! of the sum */

/* sinc(x) = sin(x)/x and three derivatives */
static fw_series sinc(double x) {
    fw_series s = {{0}};
    if (fabs(x) < small) {
        double c = 1;
        for (int n = 0; n < TERMS; n++) {
            add_power(&s, c, x, 2 * n);
            c /= -(2.0 * n + 2) * (2.0 * n + 3);
        }
        return s;
    }
    s.d[0] = sin(x) / x;
    s.d[1] = (cos(x) - s.d[0]) / x;
    s.d[2] = -s.d[0] - 2 * s.d[1] / x;
    s.d[3] = -s.d[1] - 2 * s.d[2] / x + 2 * s.d[1] / (x * x);
    return s;
}

/* n(x)/x^2 from the derivatives 0..2 of n */
static fw_series over_square(const double n[3], double x) {
    double x2 = x * x;
    return (fw_series){{n[0] / x2, n[1] / x2 - 2 * n[0] / (x2 * x),
                        n[2] / x2 - 4 * n[1] / (x2 * x) + 6 * n[0] / (x2 * x2), 0}};
}

/* g: sum over n >= 1 of -(-4)^n x^(2n-2)/(2n+1)!; h: over n >= 2 of (-4)^n (2n-2) x^(2n-2)/(2n+2)!
 */
static void bending(double x, const fw_series *s, const double z[3], fw_series *g, fw_series *h) {
    *g = *h = (fw_series){{0}};
    if (fabs(x) < small) {
        double c = 1; /* (-4)^n/(2n+1)! */
        for (int n = 1; n < TERMS; n++) {
            c *= -4 / ((2.0 * n) * (2.0 * n + 1));
            add_power(g, -c, x, 2 * n - 2);
            if (n > 1) add_power(h, c * (2.0 * n - 2) / (2.0 * n + 2), x, 2 * n - 2);
        }
        return;
    }
    const double square[3] = {s->d[0] * s->d[0], 2 * s->d[0] * s->d[1],
                              2 * (s->d[1] * s->d[1] + s->d[0] * s->d[2])};
    const double ng[3] = {1 - z[0], -z[1], -z[2]};
    const double nh[3] = {1 + z[0] - 2 * square[0], z[1] - 2 * square[1], z[2] - 2 * square[2]};
    *g = over_square(ng, x);
    *h = over_square(nh, x);
}

/* 1/c with its derivatives by the rotation, c by x = a + q th */
static fw_hinge_jet inverse(const double c[3], double q) {
    double k = 1 / c[0];
    return (fw_hinge_jet){k, -q * c[1] * k * k, q * q * (2 * c[1] * c[1] * k - c[2]) * k * k};
}

void fw_hinge_law_at(const fw_hinge_law *law, double th, fw_hinge_at *at) {
    double a = law->half_angle_rad, q = 0.5 * law->share, x = a + q * th;
    fw_series s = sinc(x), free_ = sinc(a), twice = sinc(2 * x), g, h;
    const double z[3] = {twice.d[0], 2 * twice.d[1], 4 * twice.d[2]};
    bending(x, &s, z, &g, &h);
    const double end[3] = {s.d[0] * s.d[0], 2 * s.d[0] * s.d[1],
                           2 * (s.d[1] * s.d[1] + s.d[0] * s.d[2])};
    const double side[3] = {s.d[1] * s.d[1], 2 * s.d[1] * s.d[2],
                            2 * (s.d[2] * s.d[2] + s.d[1] * s.d[3])};
    double cx[3], cy[3];
    for (int k = 0; k < 3; k++) {
        double p = law->axial_m_per_N, v = law->shear_m_per_N, one = k == 0 ? p + v : 0;
        cx[k] = law->bend_m_per_N * g.d[k] + law->root_m_per_N * end[k] + one + (v - p) * z[k];
        cy[k] = law->bend_m_per_N * h.d[k] + law->root_m_per_N * law->share * side[k] + one +
                (p - v) * z[k];
    }
    at->kx_N_per_m = inverse(cx, q);
    at->ky_N_per_m = inverse(cy, q);
    double L = law->length_m, c2 = cos(0.5 * th), s2 = sin(0.5 * th),
           turn = law->share * free_.d[1];
    at->drift_m.value = L * (s.d[0] - c2 * free_.d[0] - s2 * turn);
    at->drift_m.slope = L * (q * s.d[1] + 0.5 * s2 * free_.d[0] - 0.5 * c2 * turn);
    at->drift_m.curve = L * (q * q * s.d[2] + 0.25 * c2 * free_.d[0] + 0.25 * s2 * turn);
}

/* EI is what makes K = EI/(L + 2 dL) the stiffness of the closed form, so that depth and curvature
   corrections hold for forces too */
void fw_hinge_law_of(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                     fw_hinge_law *law) {
    double L = in->length_m, dL = closed_form->root_length_m;
    double EI = closed_form->stiffness_Nm_per_rad * (L + 2 * dL);
    double EA = in->youngs_Pa * in->depth_m * in->width_m;
    double kGA = 5.0 / 6.0 * EA / (2 * (1 + in->poisson));
    *law = (fw_hinge_law){.stiffness_Nm_per_rad = closed_form->stiffness_Nm_per_rad,
                          .half_angle_rad = in->kind == FW_FLEXURE_CSFH ? 0.5 * in->angle_rad : 0,
                          .length_m = L,
                          .share = L / (L + 2 * dL),
                          .bend_m_per_N = L * L * L / (8 * EI),
                          .root_m_per_N = dL * L * L / (2 * EI),
                          .axial_m_per_N = L / (2 * EA),
                          .shear_m_per_N = L / (2 * kGA)};
}

static double drift_at(const fw_hinge_law *law, double th) {
    fw_hinge_at at;
    fw_hinge_law_at(law, th, &at);
    return fabs(at.drift_m.value);
}

/* bisection on the side where it is reached first; the drift grows with |th| */
double fw_hinge_drift_reaches(const fw_hinge_law *law, double gap_m) {
    double best = (double)NAN;
    for (int side = -1; side <= 1; side += 2) {
        double low = 0, high = 0, step = M_PI / 64;
        while (high < M_PI && drift_at(law, side * high) < gap_m)
            low = high, high += step;
        if (high >= M_PI) continue;
        for (int i = 0; i < 60; i++) {
            double middle = 0.5 * (low + high);
            if (drift_at(law, side * middle) < gap_m)
                low = middle;
            else
                high = middle;
        }
        if (!(best <= high)) best = high;
    }
    return best;
}
