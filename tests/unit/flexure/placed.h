/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A solid that is turned by a moment, beside what a verdict takes of its strip: the least and the most, by the place
   of the peak, per radian and per moment. */
#ifndef FW_TEST_PLACED_H
#define FW_TEST_PLACED_H
#include "flexure/path.h"
#include "solid_input.h"
#include "test.h"
#include <math.h>
#include <stdio.h>

/* width of the band of strain per moment, over the peak */
static inline double placed_width(const fw_flexure_input *in, double strain, double stiffness,
                                  int line) {
    fw_arena *arena = fw_arena_new(0);
    fw_flexure_result c;
    fw_flexure_path_strain s;
    fw_flexure_strip_strains o;
    fw_flexure_closed_form(in, &c);
    assert_int_equal(fw_flexure_path_strain_new(arena, in, &c, &s), FW_OK);
    const double K = c.stiffness_Nm_per_rad, more = stiffness / K;
    const fw_flexure_strip_load load = {
        .rotation_rad = 1, .bend_Nm = K, .root_Nm = {K, K}, .drawn = true, .held = true};
    fw_flexure_strip_strain(&s, &load, &o);
    const fw_flexure_error *e = &c.error;
    const double low = 1 - e->strain_anywhere, high = 1 + e->above_anywhere;
    if (!(strain > o.least * low && strain < o.most * high))
        fail_msg("line %d: %.5f per radian, said %.5f to %.5f", line, strain, o.least * low,
                 o.most * high);
    double least = o.least * (low - e->load_less), most = o.most * (high + e->load_more);
    if (!(strain / more > least && strain / more < most))
        fail_msg("line %d: %.5f per moment, said %.5f to %.5f", line, strain / more, least, most);
    assert_true(o.least <= o.peak && o.most >= o.peak);
    fw_arena_free(arena);
    return (most - least) / o.peak;
}

#endif
