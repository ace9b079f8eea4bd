/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two functions per hinge kind; flexure_table.c has their rows. Private to the room. */
#ifndef FW_FLEXURE_KINDS_H
#define FW_FLEXURE_KINDS_H
#include "flexure/flexure.h"

void fw_flexure_csfh_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_csfh(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
/* both at once, the same to rounding */
void fw_flexure_csfh_at_once(const fw_flexure_input *in, fw_flexure_result *out);
/* as most arcs are: four of them, all crystals or none, may go at once; csfh_four.c */
bool fw_flexure_csfh_usual(const fw_flexure_input *in);
void fw_flexure_csfh_four(const fw_flexure_input *const in[4], fw_flexure_result *const out[4]);
void fw_flexure_csfh_four_avx(const fw_flexure_input *const in[4], fw_flexure_result *const out[4]);
/* an arc of a crystal; csfh_crystal.c */
void fw_flexure_crystal_arc(const fw_flexure_shape *shape, const fw_flexure_input *in,
                            fw_flexure_result *out);
void fw_flexure_crystal_at_once(const fw_flexure_input *in, fw_flexure_result *out);
void fw_flexure_leaf_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_leaf(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);

void fw_flexure_leaf_at_once(const fw_flexure_input *in, fw_flexure_result *out);

/* of all kinds and materials; error.c */
void fw_flexure_errors(const fw_flexure_shape *shape, const fw_flexure_input *in,
                       const fw_flexure_result *result, fw_flexure_error *out);
void fw_flexure_path_shape(const fw_flexure_input *in, fw_flexure_shape *shape);
void fw_flexure_path(const fw_flexure_shape *shape, const fw_flexure_input *in,
                     fw_flexure_result *out);
fw_flexure_error fw_flexure_path_errors(const fw_flexure_shape *shape, const fw_flexure_input *in);

/* int m(b) {1, cos b, sin b, cos^2 b, sin b cos b, sin^2 b} db over the arc -a .. a */
typedef struct fw_flexure_arc_sums {
    double w, x, y, xx, xy, yy;
} fw_flexure_arc_sums;
/* m = 1, cos 4b and -sin 4b; sin a, cos a */
void fw_flexure_arc_sums_of(double half_angle_rad, double sine, double cosine,
                            fw_flexure_arc_sums *even, fw_flexure_arc_sums *along,
                            fw_flexure_arc_sums *across);

/* dL/E of a root whose tangent has cos 4 psi, psi from [100]; flexure_section.c */
double fw_flexure_root_m_per_Pa(const fw_flexure_shape *shape, const fw_flexure_crystal *crystal,
                                double cos4);

#endif
