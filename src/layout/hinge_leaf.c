/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include "base/constants.h"
#include <math.h>

/* straight leaf along y of the hinge frame, W in its middle: root faces at y = +-L/2, fillets of
   radius rho tangent to both, cut at L/2 - rho
   in: flexure (m), shape->fillet_m wanted; out: shape in the hinge frame; false: no room
   docs/theory/layout.md, section 2; test_layout.c leaf_is_exact */
bool fw_hinge_shape_leaf(const fw_flexure *flexure, fw_hinge_shape *shape) {
    double L = flexure->length_m, t = flexure->width_m, y = 0.5 * L, x = 0.5 * t;
    double rho = fmin(shape->fillet_m, 0.25 * L), cut = y - rho;
    if (!(L > 2.0 * FW_LEAST_SPACE_M && t > 0.0 && rho > 0.02 * t)) return false;

    shape->arc_centre = fw_v(0.0, 0.0);
    shape->strip_sweep_rad = 0.0;
    shape->fillet_m = rho;
    shape->cut_flags = FW_SEGMENT_JOINT;
    shape->width_m = t;
    shape->size_m = y;
    shape->joint_in = fw_v(-x, cut);
    shape->joint_out = fw_v(x, cut);
    shape->edge_sweep_rad = 0.0;
    shape->inner_end = shape->joint_in;
    shape->outer_start = shape->joint_out;
    shape->outer_centre = fw_v(x + rho, cut);
    shape->outer_end = fw_v(x + rho, y);
    shape->outer_sweep_rad = -0.5 * FW_PI;
    shape->inner_start = fw_v(-x - rho, y);
    shape->inner_centre = fw_v(-x - rho, cut);
    shape->inner_sweep_rad = -0.5 * FW_PI;
    shape->root = fw_v(0.0, y);
    shape->face = fw_v(1.0, 0.0);
    shape->into = fw_v(0.0, 1.0);
    shape->inner_corner = fw_v(-fmax(FW_RING_M, x + rho + 4.0 * t), y);
    shape->reach_m = fw_norm(shape->outer_end);
    return true;
}
