/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the closed form does not know, as a figure of each shape. */
#include "flexure/finish.h"
#include "flexure/kinds.h"
#include <math.h>

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
    if (in->crystal.known) fw_crystal_errors(f, &in->crystal, wide, out);
    out->outside = wide > 1 || (f->kind == FW_FLEXURE_PATH && f->error.outside);
}
