/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/flare.h"
#include "flexure/section.h"
#include <math.h>

/* width over the depth w(z) = t + 2 d z/h, -h/2 <= z <= h/2, both walls alike, so that the bending
   axis stays the line of symmetry:
     I/I_rectangle = (1/h) integral (w/t)^3 dz = 1 + p^2,   p = d/t          (t^3 + t d^2)
     widest fibre  = (t + |d|)/2,   Kt of the wider face: t (1 + |p|), rho
     K and what bends go with 1 + p^2; the area, and so ky of a leaf, with the mean width
   in: mean width t, flare d, fillet rho (m), |d| < t; out: stiffnesses, strain per radian, limit.
   The curved-beam and depth factors are those of the mean width: p^2 of their small departure from
   1 is left out (below 0.1 % for |p| < 0.1). Translation stiffnesses of an arc are taken to be
   bending alone (their shear part times p^2 is left out). Source: elementary integral, the same as
   k/k0 in docs/theory/etching.md; test_flare.c against quadrature. */
void fw_flexure_flare(const fw_flexure_input *in, double flare_m, fw_flexure_result *out) {
    if (flare_m == 0.0) return;
    double p = fabs(flare_m) / in->width_m, stiffer = 1.0 + p * p;
    out->stiffness_Nm_per_rad *= stiffer;
    out->stiffness_thin *= stiffer;
    out->kx_N_per_m *= stiffer;
    if (in->kind != FW_FLEXURE_LEAF) out->ky_N_per_m *= stiffer;
    double sharper = fw_flexure_fillet_concentration(in->width_m * (1.0 + p), in->fillet_m) /
                     fw_flexure_fillet_concentration(in->width_m, in->fillet_m);
    double strained = (1.0 + p) * sharper;
    out->concentration *= sharper;
    out->strain_per_rad *= strained;
    out->strain_fit_per_rad *= strained;
    out->stress_per_rad_Pa *= strained;
    out->limit_angle_rad /= strained;
}
