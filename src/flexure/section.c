/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/section.h"
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
    double x = clamped_ratio(width_m, fillet_m);
    return width_m * (0.4192 - 0.5972 * x - 0.1167 * x * x);
}

/* Kt = 0.944 + 0.2113 (t/rho)^(2/3), without the curved-beam factor 1 + t/3r
   valid as above; within 1 % of the finite elements it was fitted to, -0.2..+2.9 % on held-out ones
   docs/theory/flexure.md eq. 7; test_flexure.c concentration_matches_finite_elements */
double fw_fillet_concentration(double width_m, double fillet_m) {
    return 0.944 + 0.2113 * pow(clamped_ratio(width_m, fillet_m), -2.0 / 3.0);
}

/* cylindrical strip of depth h bent about the wafer normal, free edges z = +-h/2:
     x = h [3 (1-nu^2)]^(1/4) / sqrt(r t),  f = (2/x)(cosh x - cos x)/(sinh x + sin x)
     EI_eff/EI = (1 - nu^2 f)/(1 - nu^2)
   hoop strain: inner fibre at mid-depth 1 - C1/(rt/2), outer fibre at the edge
     1 + (C1 ch c + C2 sh s)/(rt/2), all at X = x/2
   out: both factors; x -> 0 plane stress, x -> infinity plane strain; error below 0.3 % against 3-D
   finite elements (rigid ends), 0.5 % with real roots
   docs/theory/flexure.md eq. 8-10; test_flexure.c depth_factor_limits_and_reference */
fw_depth fw_depth_factors(double radius_m, double width_m, double depth_m, double poisson) {
    double nu2 = poisson * poisson, rt = radius_m * width_m;
    double lambda = pow(3.0 * (1.0 - nu2), 0.25) / sqrt(rt);
    double x = lambda * depth_m, X = 0.5 * x;
    double f, c1, edge; /* c1 = C1 / (rt/2); edge = the bracket / (rt/2) */
    double unit = poisson / (2.0 * lambda * lambda) / (0.5 * rt);
    if (x > 60.0) { /* cosh would swamp everything: the limits */
        f = 2.0 / x;
        c1 = 0.0;
        edge = unit;
    } else if (x < 1e-3) { /* plane stress; the quotients cancel */
        f = 1.0;
        c1 = 0.0;
        edge = 0.0;
    } else {
        double s = sin(X), c = cos(X), sh = sinh(X), ch = cosh(X), D = s * c + sh * ch;
        f = 2.0 / x * (cosh(x) - cos(x)) / (sinh(x) + sin(x));
        c1 = unit * (sh * c - ch * s) / D;
        double c2 = unit * (ch * s + sh * c) / D;
        edge = c1 * ch * c + c2 * sh * s;
    }
    return (fw_depth){(1.0 - nu2 * f) / (1.0 - nu2), 1.0 - c1, 1.0 + edge};
}
