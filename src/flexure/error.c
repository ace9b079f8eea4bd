/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the closed form does not know, as a figure of each shape. */
#include "flexure/finish.h"
#include "flexure/kinds.h"
#include <math.h>

/* A crystal: K 1.4 %, kx 1 %, ky 1.6 % more (linear finite elements of two arcs, three directions
   each, ideal ends), W twice, strain 3.1 % more; where its direction is not known the spread over
   all of them. source: docs/theory/flexure.md; test_crystal.c */
static void of_crystal(const fw_flexure_shape *f, const fw_crystal *k, double wide,
                       fw_flexure_error *e) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double spread = k->aligned ? 0 : fabs(k->a1_per_Pa / k->a0_per_Pa);
    e->stiffness += wide * (0.014 + (arc ? 0 : spread));
    e->kx += wide * (0.010 + (arc ? 0.1 * spread : spread));
    e->ky += wide * (0.016 + spread);
    e->strain += wide * 0.031;
    e->centre_m = 2 * e->centre_m + wide * (arc ? (0.001 + 0.2 * spread) * f->radius_m : 0);
}

/* outside of the shapes that were compared nothing is known: times 2 for each of fillet outside
   [0.05, 1] t, arc thicker than t/r = 0.15, strip shorter than 16 t, depth above 10 t; times 10 in
   all above t/r = 0.3 */
void fw_flexure_errors(const fw_flexure_shape *f, const fw_flexure_input *in,
                       const fw_flexure_result *r, fw_flexure_error *out) {
    double wide = fw_errors_widened(f, in->depth_m);
    if (f->kind == FW_FLEXURE_PATH) {
        const fw_flexure_error *e = &f->error;
        *out = (fw_flexure_error){.stiffness = wide * e->stiffness,
                                  .kx = wide * e->kx,
                                  .ky = wide * e->ky,
                                  .strain = wide * e->strain,
                                  .centre_m = wide * e->centre_m};
    } else {
        double t = f->width_m;
        double EI = r->youngs_Pa * in->depth_m * t * t * t / 12 * r->depth_factor;
        fw_isotropic_errors(f, in, r, 1 / EI, wide, out);
    }
    if (in->crystal.known) of_crystal(f, &in->crystal, wide, out);
    out->outside = wide > 1 || (f->kind == FW_FLEXURE_PATH && f->error.outside);
}
