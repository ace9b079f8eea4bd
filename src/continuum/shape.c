/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/continuum.h"
#include "base/constants.h"
#include <math.h>

/* blocks as in the finite elements that the closed form's root law was fitted to */
static void block_of(fw_continuum_shape *shape, double curvature) {
    double least = fmax(4.0 * shape->width_m, 2.5 * (0.5 * shape->width_m + shape->fillet_m));
    shape->root = FW_ROOT_BLOCK;
    shape->block_half_m = fmax(40e-6, least);
    if (curvature > 0.0) shape->block_half_m = fmin(shape->block_half_m, 0.7 / curvature);
    shape->block_length_m =
        fmax(curvature > 0.0 ? 0.52359877559829887 / curvature : 52.4e-6, 5.0 * shape->width_m);
}

void fw_continuum_shape_of(const fw_flexure_input *in, fw_continuum_shape *shape) {
    fw_flexure_result closed;
    fw_flexure_closed_form(in, &closed);
    *shape = (fw_continuum_shape){.npiece = 1,
                                  .width_m = in->width_m,
                                  .fillet_m = in->fillet_m,
                                  .depth_m = in->depth_m,
                                  .centre_x_m = closed.centre_m};
    if (in->kind == FW_FLEXURE_LEAF) {
        /* along y, as in flexure.h */
        shape->piece[0] = (fw_continuum_piece){in->length_m, 0.0};
        shape->y_m = -0.5 * in->length_m;
        shape->direction_rad = 0.5 * FW_PI;
        block_of(shape, 0.0);
        return;
    }
    double r = in->radius_m, a = 0.5 * in->angle_rad;
    shape->piece[0] = (fw_continuum_piece){2.0 * a * r, 1.0 / r};
    shape->x_m = r * cos(a), shape->y_m = -r * sin(a);
    shape->direction_rad = 0.5 * FW_PI - a;
    block_of(shape, 1.0 / r);
}
