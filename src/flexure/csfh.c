/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/csfh_even.h"
#include "flexure/kinds.h"

void fw_flexure_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *f) {
    double s, c;
    fw_quick_half_angle(in->angle_rad, &s, &c);
    fw_arc_outline(in, false, s, c, f);
}

void fw_flexure_csfh(const fw_flexure_shape *f, const fw_flexure_input *in,
                     fw_flexure_result *out) {
    if (in->crystal.known) {
        fw_flexure_crystal_arc(f, in, out);
        return;
    }
    const fw_flexure_depth_start start =
        fw_depth_start_of(in->depth_m * in->depth_m * f->per_rt, in->poisson);
    const fw_flexure_depth depth = fw_depth_law(&start);
    fw_even_arc(f, in, &depth, out);
}

static __attribute__((noinline)) void any_at_once(const fw_flexure_input *in,
                                                  fw_flexure_result *out) {
    fw_even_arc_at_once(in, false, out);
}

bool fw_flexure_csfh_usual(const fw_flexure_input *in) {
    return fw_arc_usual(in) && (!in->crystal.known || in->crystal.aligned);
}

void fw_flexure_csfh_at_once(const fw_flexure_input *in, fw_flexure_result *out) {
    if (in->crystal.known)
        fw_flexure_crystal_at_once(in, out);
    else if (fw_arc_usual(in))
        fw_even_arc_at_once(in, true, out);
    else
        any_at_once(in, out);
}
