/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/kinds.h"
#include "flexure/section.h"
#include <math.h>

/* e = r - rn = r (1 - u/atanh u), by its series where the difference would cancel */
static double neutral_offset(double r, double u) {
    double u2 = u * u;
    return u < 0.02 ? r * u2 * (1.0 / 3.0 + u2 * (4.0 / 45.0 + u2 * 44.0 / 945.0))
                    : r * (1.0 - u / atanh(u));
}

/* circular arc of centre-line radius r, half-angle a, width t, depth h, L = 2 a r, u = t/2r:
     K    = EI_eff (1 - 2/15 u^2 - u^4/21) / (L + 2 dL)       Golovin's exact plane-stress bending
     W    = (L rn sin(a)/a + 2 dL r cos(a)) / (L + 2 dL)       centre of elastic weights, from O
     Cxx  = r rn/(EAe) (a - sc) + r/kGA (a + sc)              Winkler: rn = r u/atanh u, e = r - rn
     Cyy  = rn/(EAe) (r (a + sc) - 2 rn s^2/a) + r/kGA (a - sc),  k = 5/6
     eps/rad = t/(2L) max((1 + t/3r) F_inner, (1 - t/3r) F_outer) Kt L/(L + 2 dL), at the root
   fillet error: K 0.15-0.51 %, W 0.2 um, strain -0.2..+2.9 % against 3-D finite elements on
   held-out shapes source: docs/theory/flexure.md eq. 1-10; test_flexure.c
   csfh_matches_the_reference_ladder */
void fw_flexure_csfh(const fw_flexure_input *in, fw_flexure_result *out) {
    double r = in->radius_m, a = 0.5 * in->angle_rad, t = in->width_m, h = in->depth_m;
    double L = in->length_m, s = sin(a), c = cos(a), u = 0.5 * t / r;
    double A = h * t, I = A * t * t / 12.0, E = in->youngs_Pa;
    double kGA = 5.0 / 6.0 * A * E / (2.0 * (1.0 + in->poisson));
    fw_depth depth = fw_depth_factors(r, t, h, in->poisson);
    double dL = fw_root_length_m(t, in->fillet_m), whole = L + 2.0 * dL;

    out->depth_factor = depth.stiffness;
    out->root_length_m = dL;
    out->stiffness_thin = E * I / L;
    double golovin = 1.0 - 2.0 / 15.0 * u * u - u * u * u * u / 21.0;
    out->stiffness_Nm_per_rad = E * I * depth.stiffness * golovin / whole;
    double e = neutral_offset(r, u), rn = r - e;
    out->centre_m = (L * rn * s / a + 2.0 * dL * r * c) / whole;

    double bend = rn / (E * A * e * depth.stiffness), shear = r / kGA;
    out->kx_N_per_m = 1.0 / (bend * r * (a - s * c) + shear * (a + s * c));
    out->ky_N_per_m = 1.0 / (bend * (r * (a + s * c) - 2.0 * rn * s * s / a) + shear * (a - s * c));

    double curved = t / (3.0 * r), Kt = fw_fillet_concentration(t, in->fillet_m);
    double worst = fmax((1.0 + curved) * depth.inner, (1.0 - curved) * depth.outer);
    out->concentration = Kt * worst;
    out->strain_per_rad = t / (2.0 * whole) * out->concentration;
}
