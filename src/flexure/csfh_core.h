/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outline of an arc, in line: what isotropic arcs and crystals begin with, one or four at once
   (lanes.h). Private to the room.
 */
#ifndef FW_FLEXURE_CSFH_CORE_H
#define FW_FLEXURE_CSFH_CORE_H
#include "flexure/finish.h"
#include "flexure/section_core.h"
#include <math.h>

#ifndef FW_FOUR_HINGES
/* as most hinges are: inside of what was compared, so that nothing is clamped, widened or beyond
   the range of a polynomial. What is compiled for these alone is one stretch without a branch,
   which is worth a tenth. With h <= 10 t and t <= 0.15 r, h^2/(r t) <= 15 and x <= 5.1 of the depth
   factors, whatever nu */
FW_INLINE bool fw_arc_usual(const fw_flexure_input *in) {
    double t = in->width_m, r = in->radius_m, h = in->depth_m, rho = in->fillet_m;
    return (in->angle_rad >= 0) & (in->angle_rad <= 6.2832) & (h >= 0) & (h <= 10 * t) &
           fw_shape_compared(rho, t, t, r, in->length_m);
}
#endif

/* usual: of such a one. s, c: sine and cosine of a = half the angle; what the outline of an arc
   gives: rn = r u/atanh u, u = t/2r (Winkler), the exact bending stiffness over the thin one, 1 -
   2/15 u^2 - u^4/21 (Golovin, plane stress, to u^4), roots, and W = 2 r (rn sin a + dL cos a)/(L +
   2 dL) from O, L = 2 a r in m, rad; valid 0 < a <= pi, u < 1; error of W 0.2 um at r = 100 um
   against 3-D finite elements. Members are set one by one: clearing all of them first would cost a
   tenth of the closed form. source: docs/theory/flexure.md eq. 1, 2, 6, 7; test_ladder.c,
   test_quick.c */
FW_INLINE void fw_arc_outline(const fw_flexure_input *in, bool usual, fw_flexure_real s,
                              fw_flexure_real c, fw_flexure_shape *f) {
    fw_flexure_real r = in->radius_m, a = 0.5 * in->angle_rad, t = in->width_m, rho = in->fillet_m;
    fw_flexure_real L = in->length_m, per_rt = 1 / (r * t), per_t = r * per_rt, half_t = 0.5 * t;
    fw_flexure_real dL = fw_all(0), block = dL, Kt = fw_all(1), ratio = dL,
                    u = half_t * (t * per_rt);
    fw_flexure_real off = FW_IF_USUAL(usual, fw_neutral_thin(u), fw_neutral_series(u));
    if (FW_IF_USUAL(usual, true, rho >= 0)) {
        fw_flexure_real x = FW_IF_USUAL(usual, rho * per_t, fw_fitted_ratio(rho * per_t));
        dL = t * fw_root_law(x), block = fw_root_block_law * t, Kt = fw_concentration_law(x);
        ratio = fw_larger(x, fw_all(0.1));
    }
    fw_flexure_real whole = L + 2 * dL, per = 1 / (L * whole), e = half_t * u * off;
    fw_flexure_real rn = r - e;
    f->kind = FW_FLEXURE_CSFH;
    f->length_m = L, f->radius_m = r, f->width_m = t, f->fillet_m = rho;
    f->half_angle_rad = a, f->sine = s, f->cosine = c;
    f->neutral_m = rn, f->eccentric_m = e, f->golovin = fw_golovin_law(u);
    f->root_length_m = dL, f->root_block_m = block, f->whole_m = whole;
    f->fillet_concentration = Kt, f->fillet_ratio = ratio;
    f->curved = (2 / 3.0) * u;
    f->per_rt = per_rt;
    f->per_eccentric = 1 / e;
    f->per_length = whole * per, f->per_whole = L * per;
    f->per_section = 12 * (per_t * per_t);
    f->centre_m = 2 * r * (rn * s + dL * c) * f->per_whole;
}

FW_INLINE void fw_arc_sine(const fw_flexure_input *in, bool usual, fw_flexure_real *s,
                           fw_flexure_real *c) {
    FW_IF_USUAL(usual, fw_quick_half_turn(in->angle_rad, s, c),
                fw_quick_half_angle(in->angle_rad, s, c));
}

/* marks the outline; by how much its errors widen */
FW_INLINE fw_flexure_real fw_arc_widened(fw_flexure_shape *f, const fw_flexure_input *in,
                                         bool usual) {
    f->sharp = f->beyond_fit = false, f->widening = 1;
#ifndef FW_FOUR_HINGES
    if (!usual) {
        fw_shape_marks(f);
        return fw_errors_widened(f, in->depth_m);
    }
#endif
    (void)in, (void)usual;
    return fw_all(1);
}

FW_INLINE fw_flexure_depth fw_arc_depth(const fw_flexure_depth_start *start, bool usual) {
    return FW_IF_USUAL(usual, fw_depth_near(start), fw_depth_law(start));
}

#endif
