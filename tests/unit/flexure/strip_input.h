/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strips that tests bend: an arc, or a leaf where the angle is 0. */
#ifndef FW_TEST_STRIP_INPUT_H
#define FW_TEST_STRIP_INPUT_H

#include "flexure/path.h"
#include <math.h>

/* slender: width/length; fillet: radius/width, below 0: rigid ends */
static inline fw_flexure_input strip_input(double length_m, double angle_deg, double slender,
                                           double fillet) {
    const double angle = angle_deg * (M_PI / 180), width_m = slender * length_m;
    return (fw_flexure_input){.kind = angle > 0 ? FW_FLEXURE_CSFH : FW_FLEXURE_LEAF,
                              .length_m = length_m,
                              .angle_rad = angle,
                              .radius_m = angle > 0 ? length_m / angle : 0,
                              .width_m = width_m,
                              .fillet_m = fillet * width_m,
                              .depth_m = 20e-6,
                              .youngs_Pa = 150e9,
                              .poisson = 0.25,
                              .strength_Pa = 1e9,
                              .safety_factor = 1};
}

#endif
