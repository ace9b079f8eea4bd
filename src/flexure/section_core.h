/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws of section.h in line, with what a hinge's closed form has worked out already. Private to
   the room. */
#ifndef FW_FLEXURE_SECTION_CORE_H
#define FW_FLEXURE_SECTION_CORE_H
#include "flexure/quick.h"
#include "flexure/section.h"

/* x = rho/t in the fitted range */
FW_INLINE double fw_fitted_ratio(double x) {
    return fw_smaller(fw_larger(x, 0.05), 1.0);
}

/* dL = t (0.4192 - 0.5972 x - 0.1167 x^2), x = rho/t
   in: x in the fitted range; out: length added per root over t, negative above x = 0.63
   valid 0.05 <= x <= 1, blocks of 5 t and more behind the root; error 0.005
   fitted to plane-stress finite elements of three geometries and two materials
   docs/theory/flexure.md eq. 6; test_flexure.c root_law_matches_finite_elements */
static const double fw_root_block_law = 0.4192;
FW_INLINE double fw_root_law(double x) {
    return fw_root_block_law - 0.5972 * x - 0.1167 * x * x;
}

/* Kt = 0.944 + 0.2113 (t/rho)^(2/3), without the curved-beam factor 1 + t/3r
   valid as above; within 1 % of the finite elements it was fitted to, -0.2..+2.9 % on held-out ones
   docs/theory/flexure.md eq. 7; test_flexure.c concentration_matches_finite_elements */
FW_INLINE double fw_concentration_law(double x) {
    double q = fw_quick_per_cube_root(x);
    return 0.944 + 0.2113 * (q * q);
}

/* e/(r u^2), e = r - rn = r (1 - u/atanh u) (Winkler), by its series where the difference would
   cancel: what is left out is below 4e-16 of e at u = 0.1; above by fw_neutral_thick */
FW_INLINE double fw_neutral_series(double u) {
    double z = u * u, z2 = z * z;
    if (!(u < 0.1)) return fw_neutral_thick(u);
    return ((1 / 3.0 + z * (4 / 45.0)) + z2 * (44 / 945.0 + z * (428 / 14175.0))) +
           z2 * z2 *
               ((10196 / 467775.0 + z * (10719068 / 638512875.0)) + z2 * (25865068 / 1915538625.0));
}

FW_INLINE double fw_golovin_law(double u) {
    double u2 = u * u;
    return 1.0 - 2.0 / 15.0 * u2 - u2 * u2 * (1 / 21.0);
}

/* cylindrical strip of depth h bent about the wafer normal, free edges z = +-h/2:
     x = h [3 (1-nu^2)]^(1/4) / sqrt(r t),  f = (2/x)(cosh x - cos x)/(sinh x + sin x)
     EI_eff/EI = (1 - nu^2 f)/(1 - nu^2)
   hoop strain: inner fibre at mid-depth 1 - C1/(rt/2), outer fibre at the edge
     1 + (C1 ch c + C2 sh s)/(rt/2), all at X = x/2
   as quotients of which both parts are taken times exp(-2 X), so that nothing overflows; below x =
   0.1, where they cancel, by the first terms of their series in x (what is left out: 1e-16).
   in: deep = h/sqrt(r t), nu, per = 1/(1 - nu^2); out: both factors; x -> 0 plane stress, x ->
   infinity plane strain; error below 0.3 % against 3-D finite elements (rigid ends), 0.5 % with
   real roots. Cost 12 ns
   docs/theory/flexure.md eq. 8-10; test_flexure.c depth_factor_limits_and_reference,
   test_quick.c depth_factors */
typedef struct fw_depth_start { /* what the square roots are in */
    double x, poisson, nu2, rest, per, unit;
} fw_depth_start;

FW_INLINE fw_depth_start fw_depth_start_of(double deep, double poisson) {
    double nu2 = poisson * poisson, rest = 1 - nu2, root = sqrt(3 * rest); /* lambda^2 r t */
    return (fw_depth_start){.x = deep * sqrt(root),
                            .poisson = poisson,
                            .nu2 = nu2,
                            .rest = rest,
                            .per = 1 / rest,
                            .unit = poisson / root};
}

FW_INLINE fw_depth fw_depth_law(const fw_depth_start *from) {
    double x = from->x, X = 0.5 * x, nu2 = from->nu2, unit = from->unit;
    double of, over, c1, edge; /* f = of over; c1 = C1 / (rt/2); edge = the bracket / (rt/2) */
    if (x > 60) {
        of = 2, over = x;
        c1 = 0, edge = unit;
    } else if (x < 0.1) {
        double X2 = X * X, X4 = X2 * X2, x4 = 16 * X4;
        over = 1 + x4 * (1 / 120.0 + x4 * (1 / 362880.0));
        of = 1 + x4 * (1 / 360.0 + x4 * (1 / 1814400.0));
        double part = unit * X2 / over;
        c1 = part * (X4 * (1 / 630.0) - 1 / 3.0);
        edge = c1 * (1 - X4 * (1 / 6.0)) + part * (1 - X4 * (1 / 30.0)) * (1 - X4 * (1 / 90.0));
    } else {
        double d = fw_quick_exp_minus(X), p = d * d, H = 0.5 - 0.5 * p, G = 0.5 + 0.5 * p, s, c;
        fw_quick_sincos_near(X, &s, &c); /* H, G: sh, ch times d */
        double D = s * c * p + H * G, part = unit / D;
        double less = H * c - G * s, more = G * s + H * c;
        of = H * H + s * s * p, over = D * X;
        c1 = part * d * less;
        edge = part * (less * G * c + more * H * s);
    }
    double left = over - nu2 * of; /* (1 - nu^2 f) over */
    return (fw_depth){.stiffness = left * from->per / over,
                      .softness = from->rest * over / left,
                      .inner = 1 - c1,
                      .outer = 1 + edge};
}

/* Peak stress at the fillet of a crystal over Kt M/Z of the same closed form:
     q(psi) = q0 (1 - c1 cos 4 psi + c2 |sin 4 psi|),  psi the root tangent from [100]
   the larger of both roots. Under a pure moment M/Z is the same all along the arc, the strain is
   not; at the fillet the stress gathers where the surface turns towards the stiff <110>.
   in: 4 psi = 4 (al0 +- a); out: 1. Calibrated on three 3-D finite elements of one silicon arc, one
   mesh each (peak 2006, 1747, 2089 MPa/rad at 4 psi = 180, 0, 270 deg): no shape is held out, the
   error is taken as 6 %. Other cubic crystals: scaled with a1/a0, not compared.
   source: docs/theory/flexure.md eq. 14; test_crystal.c peak_stress_of_silicon */
FW_INLINE double fw_crystal_rise(const fw_crystal *k, double cos4, double sin4) {
    const double q0 = 1.0638, c1 = 0.0704, c2 = 0.1130, silicon = 0.130229;
    double part = k->a1_per_Pa / k->a0_per_Pa * (1 / silicon);
    if (!k->aligned) return 1 + (q0 * (1 + hypot(c1, c2)) - 1) * fabs(part);
    double p = k->cos4 * cos4, q = k->sin4 * sin4, u = k->sin4 * cos4, v = k->cos4 * sin4;
    double first = c2 * fabs(u - v) - c1 * (p + q), second = c2 * fabs(u + v) - c1 * (p - q);
    double rise = 1 + (q0 * (1 + first) - 1) * part, other = 1 + (q0 * (1 + second) - 1) * part;
    return fw_larger(rise, other);
}

#endif
