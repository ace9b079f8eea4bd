/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/section.h"
#include "flexure/kinds.h"
#include <math.h>

static double clamped_ratio(double width_m, double fillet_m) {
    return fmin(fmax(fillet_m / width_m, 0.05), 1.0);
}

/* dL = t (0.4192 - 0.5972 x - 0.1167 x^2), x = rho/t
   in: width t, fillet rho (m); out: length added per root, negative above x = 0.63 (m)
   valid 0.05 <= x <= 1, blocks of 5 t and more behind the root; error 0.005 t
   fitted to plane-stress finite elements of three geometries and two materials
   docs/theory/flexure.md eq. 6; test_flexure.c root_law_matches_finite_elements */
double fw_root_length_m(double width_m, double fillet_m) {
    if (fillet_m < 0) return 0; /* ideal ends */
    double x = clamped_ratio(width_m, fillet_m);
    return width_m * (0.4192 - 0.5972 * x - 0.1167 * x * x);
}

double fw_root_block_m(double width_m, double fillet_m) {
    return fillet_m < 0 ? 0 : 0.4192 * width_m;
}

/* The root of a crystal: what gives way in the block is stressed in all directions and has the mean
   compliance a0; the fillet takes away strip, which has that of the root's tangent:
     dL/E = 0.4192 t a0 + (dL - 0.4192 t) (a0 + a1 cos 4 psi)
   in: 1/Pa; out: m/Pa; isotropic: dL/E. Against 3-D finite elements of a silicon arc (r = 100 um,
   rho = t/2, psi = 0, 22.5, 45 deg) W moves by as much as in them within 0.04 um, less the 0.045 um
   by which an isotropic one is short too.
   Test: test_crystal.c roots_of_silicon */
double fw_root_m_per_Pa(const fw_flexure_shape *f, const fw_crystal *k, double cos4) {
    return f->root_length_m * k->a0_per_Pa +
           (f->root_length_m - f->root_block_m) * k->a1_per_Pa * cos4;
}

/* e = r - rn = r (1 - u/atanh u) (Winkler), by its series where the difference would cancel: what
   is left out is below 4e-16 of e at u = 0.1 */
double fw_neutral_offset(double r, double u) {
    static const double of[] = {1 / 3.0,
                                4 / 45.0,
                                44 / 945.0,
                                428 / 14175.0,
                                10196 / 467775.0,
                                10719068 / 638512875.0,
                                25865068 / 1915538625.0};
    double u2 = u * u, sum = 0;
    if (!(u < 0.1)) return r * (1.0 - u / atanh(u));
    for (int n = 6; n >= 0; n--)
        sum = sum * u2 + of[n];
    return r * u2 * sum;
}

double fw_golovin(double u) {
    double u2 = u * u;
    return 1.0 - 2.0 / 15.0 * u2 - u2 * u2 / 21.0;
}

/* Kt = 0.944 + 0.2113 (t/rho)^(2/3), without the curved-beam factor 1 + t/3r
   valid as above; within 1 % of the finite elements it was fitted to, -0.2..+2.9 % on held-out ones
   docs/theory/flexure.md eq. 7; test_flexure.c concentration_matches_finite_elements */
double fw_fillet_concentration(double width_m, double fillet_m) {
    if (fillet_m < 0) return 1;
    double q = cbrt(clamped_ratio(width_m, fillet_m));
    return 0.944 + 0.2113 / (q * q);
}

/* cylindrical strip of depth h bent about the wafer normal, free edges z = +-h/2:
     x = h [3 (1-nu^2)]^(1/4) / sqrt(r t),  f = (2/x)(cosh x - cos x)/(sinh x + sin x)
     EI_eff/EI = (1 - nu^2 f)/(1 - nu^2)
   hoop strain: inner fibre at mid-depth 1 - C1/(rt/2), outer fibre at the edge
     1 + (C1 ch c + C2 sh s)/(rt/2), all at X = x/2
   out: both factors; x -> 0 plane stress, x -> infinity plane strain; error below 0.3 % against 3-D
   finite elements (rigid ends), 0.5 % with real roots. Cost 25 ns
   docs/theory/flexure.md eq. 8-10; test_flexure.c depth_factor_limits_and_reference */
fw_depth fw_depth_factors(double radius_m, double width_m, double depth_m, double poisson) {
    return fw_depth_at(depth_m / sqrt(radius_m * width_m), poisson);
}

fw_depth fw_depth_at(double deep, double poisson) {
    double nu2 = poisson * poisson, per = 1.0 / (1.0 - nu2);
    double root = sqrt(3.0 * (1.0 - nu2)); /* lambda^2 r t */
    double x = deep * sqrt(root), X = 0.5 * x;
    double f, c1, edge; /* c1 = C1 / (rt/2); edge = the bracket / (rt/2) */
    double unit = poisson * root * per * (1.0 / 3.0); /* nu/root */
    if (x > 60.0) {                                   /* cosh would swamp everything: the limits */
        f = 2.0 / x;
        c1 = 0.0;
        edge = unit;
    } else if (x < 1e-3) { /* plane stress; the quotients cancel */
        f = 1.0;
        c1 = 0.0;
        edge = 0.0;
    } else {
        double s = sin(X), c = cos(X), up = exp(X), down = 1.0 / up;
        double sh = 0.5 * (up - down), ch = 0.5 * (up + down), D = s * c + sh * ch,
               q = 1.0 / (D * X);
        double over = q * X;       /* 1/D */
        f = (sh * sh + s * s) * q; /* (2/x)(cosh x - cos x)/(sinh x + sin x) */
        c1 = unit * over * (sh * c - ch * s);
        double c2 = unit * over * (ch * s + sh * c);
        edge = c1 * ch * c + c2 * sh * s;
    }
    return (fw_depth){(1.0 - nu2 * f) * per, 1.0 - c1, 1.0 + edge};
}

/* Peak stress at the fillet of a crystal over Kt M/Z of the same closed form:
     q(psi) = q0 (1 - c1 cos 4 psi + c2 |sin 4 psi|),  psi the root tangent from [100]
   the larger of both roots. Under a pure moment M/Z is the same all along the arc, the strain is
   not; at the fillet the stress gathers where the surface turns towards the stiff <110>.
   in: 4 psi = 4 (al0 +- a); out: 1. Calibrated on three 3-D finite elements of one silicon arc, one
   mesh each (peak 2006, 1747, 2089 MPa/rad at 4 psi = 180, 0, 270 deg): no shape is held out, the
   error is taken as 6 %. Other cubic crystals: scaled with a1/a0, not compared.
   source: docs/theory/flexure.md eq. 14; test_crystal.c peak_stress_of_silicon */
double fw_crystal_stress(const fw_crystal *k, double cos4, double sin4) {
    static const double q0 = 1.0638, c1 = 0.0704, c2 = 0.1130, silicon = 0.130229;
    double part = k->a1_per_Pa / k->a0_per_Pa / silicon;
    if (!k->aligned) return 1 + (q0 * (1 + hypot(c1, c2)) - 1) * fabs(part);
    double worst = 0;
    for (int side = -1; side <= 1; side += 2) {
        double c = k->cos4 * cos4 - side * k->sin4 * sin4;
        double s = k->sin4 * cos4 + side * k->cos4 * sin4;
        worst = fmax(worst, 1 + (q0 * (1 - c1 * c + c2 * fabs(s)) - 1) * part);
    }
    return worst;
}
