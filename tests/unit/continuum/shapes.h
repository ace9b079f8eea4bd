/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The four flexures of the reference tables. */
#ifndef FW_TEST_SHAPES_H
#define FW_TEST_SHAPES_H
#include "continuum/continuum.h"
#include <math.h>

static inline fw_flexure_input flexure_of(int which) {
    static const double angle[5] = {0, 270, 180, 270, 0}, width[5] = {0, 8e-6, 10e-6, 10e-6, 8e-6};
    double a = angle[which] * M_PI / 180;
    return (fw_flexure_input){.kind = which == 4 ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                              .length_m = which == 4 ? 471.2389e-6 : a * 100e-6,
                              .angle_rad = a,
                              .radius_m = 100e-6,
                              .width_m = width[which],
                              .fillet_m = 4e-6,
                              .depth_m = which == 3 ? 9e-6 : 50e-6,
                              .youngs_Pa = which == 3 ? 115e9 : 169e9,
                              .poisson = which == 3 ? 0.34 : 0.22,
                              .strength_Pa = 500e6,
                              .safety_factor = 1};
}

/* as the tables have it: blocks r +- 40 um over 30 degrees, displacements at the thin strip's W */
static inline fw_continuum_shape shape_of(int which, fw_continuum_root root) {
    fw_flexure_input in = flexure_of(which);
    fw_continuum_shape shape;
    fw_continuum_shape_of(&in, &shape);
    shape.root = root;
    double a = in.angle_rad / 2;
    shape.centre_x_m = which == 4 ? 0 : in.radius_m * sin(a) / a;
    if (which != 4) {
        shape.block_half_m = 40e-6;
        shape.block_length_m = 100e-6 * M_PI / 6;
    }
    return shape;
}

static inline fw_continuum_material material_of(int which) {
    fw_flexure_input in = flexure_of(which);
    return (fw_continuum_material){.youngs_Pa = in.youngs_Pa, .poisson = in.poisson};
}

#endif
