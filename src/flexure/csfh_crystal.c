/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/csfh_crystal.h"
#include "flexure/kinds.h"

void fw_flexure_arc_sums_of(double a, double s, double c, fw_flexure_arc_sums *even,
                            fw_flexure_arc_sums *along, fw_flexure_arc_sums *across) {
    const harmonic h = harmonic_of(s, c);
    *even = (fw_flexure_arc_sums){.w = 2 * a, .x = 2 * s, .xx = a + s * c, .yy = a - s * c};
    *along = (fw_flexure_arc_sums){.w = h.w, .x = h.x, .xx = h.xx, .yy = h.yy};
    *across = (fw_flexure_arc_sums){.y = h.y, .xy = h.xy};
}

void fw_flexure_crystal_arc(const fw_flexure_shape *f, const fw_flexure_input *in,
                            fw_flexure_result *out) {
    double h = in->depth_m;
    const soft m = soft_of(&in->crystal, f->half_angle_rad, f->sine, f->cosine);
    const fw_flexure_depth_start start =
        fw_depth_start_crystal(h * h * f->per_rt, &in->crystal, m.youngs_Pa);
    const ends e = ends_of(f, &in->crystal, &m);
    const fw_flexure_depth depth = fw_depth_law(&start);
    const flat o = flat_of(f, &in->crystal, &m, h, depth.bow);
    crystal_arc(f, in, &m, &o, &e, &depth, 1 / (h * f->width_m), out);
}

static __attribute__((noinline)) void any_at_once(const fw_flexure_input *in,
                                                  fw_flexure_result *out) {
    fw_crystal_arc_at_once(in, false, out);
}

void fw_flexure_crystal_at_once(const fw_flexure_input *in, fw_flexure_result *out) {
    if (fw_arc_usual(in) && in->crystal.aligned)
        fw_crystal_arc_at_once(in, true, out);
    else
        any_at_once(in, out);
}
