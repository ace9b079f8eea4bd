/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arcs of one modulus: the laws, of one hinge or four at once (lanes.h). Private to the room. */
#ifndef FW_FLEXURE_CSFH_EVEN_H
#define FW_FLEXURE_CSFH_EVEN_H
#include "flexure/csfh_core.h"

/* what csfh_crystal.h has for any crystal, of a uniform modulus, with what symmetry leaves; per_D
   1/D, per_EA 1/(E h t), K; rn^2 + e rn = r rn. Cost 5 ns */
FW_INLINE void fw_comply_evenly(const fw_flexure_shape *f, fw_flexure_real per_D,
                                fw_flexure_real per_EA, fw_flexure_real poisson, fw_flexure_real K,
                                fw_flexure_real C[3][3]) {
    fw_flexure_real r = f->radius_m, rn = f->neutral_m, a = f->half_angle_rad, s = f->sine,
                    c = f->cosine;
    fw_flexure_real X = f->centre_m, sc = s * c, bend = per_EA * f->per_eccentric,
                    square = bend * rn * r;
    fw_flexure_real end = f->per_section * per_EA * (f->root_length_m + f->root_length_m);
    fw_flexure_real x = r * c - X, y = r * s, shear = (2.4 + 2.4 * poisson) * r * per_EA,
                    twice = X + X;
    fw_flexure_real along = square * (a - sc) + end * (y * y);
    fw_flexure_real across =
        square * (a + sc) - bend * (twice * ((rn + rn) * s - X * a)) + end * (x * x);
    C[0][0] = 1 / K;
    C[0][1] = C[1][0] = C[0][2] = C[2][0] = C[1][2] = C[2][1] = fw_all(0);
    C[1][1] = along * per_D + shear * (a + sc);
    C[2][2] = across * per_D + shear * (a - sc);
}

/* circular arc of centre-line radius r, half-angle a, width t, depth h, L = 2 a r:
     K = 1/C_th, kx = 1/C_xx, ky = 1/C_yy of the above
     eps/rad = t/(2 (L + 2 dL)) max(Kt (1 + t/3r) G, inside), G of fw_root_rise,
     inside = max((1 + t/3r) F_inner, (1 - t/3r) F_outer); beside it the fit Kt inside
   error: K 0.15-0.51 %, W 0.2 um, strain 0 to 4 % above 3-D finite elements. Cost 29 ns with the
   shape at hand and its errors (bench_hinge_closed.c). Crystals: csfh_crystal.h.
   source: docs/theory/flexure.md eq. 1-11a; test_ladder.c, test_quick.c, test_root_strain.c */
FW_INLINE void fw_even_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                           const fw_flexure_depth *depth, fw_flexure_result *out) {
    fw_flexure_real t = f->width_m, E = in->youngs_Pa, EA = E * in->depth_m * t;
    fw_flexure_real D = depth->stiffness, thin = EA * t * t * (1 / 12.0);
    out->youngs_Pa = E, out->poisson = in->poisson;
    out->depth_factor = D;
    out->stiffness_thin = thin * f->per_length;
    fw_flexure_real K = out->stiffness_Nm_per_rad = thin * f->golovin * f->per_whole * D;
    fw_comply_evenly(f, depth->softness, 1 / EA, in->poisson, K, out->compliance);
    fw_flexure_real u = f->curved, h = in->depth_m, nu = in->poisson, Kt = f->fillet_concentration;
    fw_flexure_real inside = fw_larger((1 + u) * depth->inner, (1 - u) * depth->outer);
    fw_flexure_real G =
        fw_root_rise(f->fillet_ratio, fw_notch_of(Kt), h / (h + 4 * t), nu, nu * depth->bow, u);
    fw_peak_strain(f, 0.5 * t * f->per_whole, inside, Kt * (1 + u) * G, out);
}

/* the outline stays in registers, and is worked out while the depth factor, which takes longest,
   is on its way */
FW_INLINE void fw_even_arc_at_once(const fw_flexure_input *in, bool usual, fw_flexure_result *out) {
    fw_flexure_shape f;
    fw_flexure_real s, c;
    fw_arc_sine(in, usual, &s, &c);
    const fw_flexure_depth_start start = fw_depth_start_of(
        in->depth_m * in->depth_m * (1 / (in->radius_m * in->width_m)), in->poisson);
    fw_arc_outline(in, usual, s, c, &f);
    const fw_flexure_depth depth = fw_arc_depth(&start, usual);
    fw_flexure_real wide = fw_arc_widened(&f, in, usual);
    out->centre_m = f.centre_m;
    out->root_length_m = f.root_length_m;
    out->offset_m[0] = out->offset_m[1] = out->uneven_x = out->uneven_y = fw_all(0);
    fw_even_arc(&f, in, &depth, out);
    fw_stiffness_and_limit(&f, in, out);
    fw_flexure_real per_EI = out->compliance[0][0] * f.per_whole * f.golovin;
    fw_isotropic_errors(&f, in, out, per_EI, wide, &out->error);
    out->error.outside = FW_IF_USUAL(usual, false, wide > 1);
}

#endif
