/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flexure of a row of solved solids: E 150 GPa, strength 500 MPa, lengths in um, angles in deg. */
#ifndef FW_TEST_SOLID_INPUT_H
#define FW_TEST_SOLID_INPUT_H
#include "base/constants.h"
#include "flexure/flexure.h"

typedef struct solid_shape {
    double size, width, angle, fillet, depth, poisson; /* size: radius; angle 0: a leaf's length */
} solid_shape;

static inline fw_flexure_input solid_input(const solid_shape *s) {
    double angle = s->angle * FW_PI / 180, size = s->size * 1e-6;
    bool leaf = !(angle > 0);
    return (fw_flexure_input){.kind = leaf ? FW_FLEXURE_LEAF : FW_FLEXURE_CSFH,
                              .length_m = leaf ? size : size * angle,
                              .angle_rad = angle,
                              .radius_m = leaf ? 0 : size,
                              .width_m = s->width * 1e-6,
                              .fillet_m = s->fillet * 1e-6,
                              .depth_m = s->depth * 1e-6,
                              .youngs_Pa = 150e9,
                              .poisson = s->poisson,
                              .strength_Pa = 500e6,
                              .safety_factor = 1};
}

#endif
