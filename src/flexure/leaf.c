/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/kinds.h"
#include "flexure/section.h"
#include <math.h>

/* straight strip of length L along y, W at its middle:
     K = EI/(L + 2 dL), kx = 12 EI/L^3 / (1 + 12 EI/(kGA L^2)), ky = EA/L
     eps/rad = t/(2L) Kt L/(L + 2 dL)
   no depth factor: a straight strip stays in plane stress in linear theory; the ends of a deep one
   add 0.36 % (finite elements), kept as uncertainty source: docs/theory/flexure.md eq. 11;
   test_flexure.c leaf_matches_the_reference */
void fw_flexure_leaf(const fw_flexure_input *in, fw_flexure_result *out) {
    double t = in->width_m, h = in->depth_m, L = in->length_m, E = in->youngs_Pa;
    double A = h * t, I = A * t * t / 12.0, EI = E * I;
    double kGA = 5.0 / 6.0 * A * E / (2.0 * (1.0 + in->poisson));
    double dL = fw_root_length_m(t, in->fillet_m), whole = L + 2.0 * dL;
    out->depth_factor = 1.0;
    out->root_length_m = dL;
    out->concentration = fw_fillet_concentration(t, in->fillet_m);
    out->stiffness_thin = EI / L;
    out->stiffness_Nm_per_rad = EI / whole;
    out->centre_m = 0.0;
    out->kx_N_per_m = 12.0 * EI / (L * L * L) / (1.0 + 12.0 * EI / (kGA * L * L));
    out->ky_N_per_m = E * A / L;
    out->strain_per_rad = t / (2.0 * L) * out->concentration * L / whole;
}
