/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include "base/constants.h"
#include <math.h>

double fw_hinge_centre(const fw_flexure *flexure, double fillet_m) {
    /* of a uniform modulus: one drawing serves every flow; what a crystal moves is the mechanism's
       business (fw_flexure_result.offset_m) */
    const fw_flexure_input in = fw_flexure_input_of(flexure, fillet_m);
    fw_flexure_shape shape;
    fw_flexure_shape_of(&in, &shape);
    return shape.centre_m;
}

/* circular arc, half-angle a, centre-line radius r, width t, from O; W at (centre_m, 0):
     outer fillet centre at r + t/2 + rho, offset asin(rho/(r + t/2 + rho)) from the root face,
     inner one at r - t/2 - rho, offset g = asin(rho/(r - t/2 - rho)), the larger: the cut is at a -
   g inner corner of the root block: 40 um or 4 t inside the centre line, at most r/2, but the two
   blocks keep the least space, and the face keeps 1 um flat: rho <= (ri^2 - (corner + 1 um)^2)/(2
   ri) in: flexure (m, rad), shape->fillet_m wanted; out: shape in the hinge frame; false: no room
   docs/theory/layout.md, section 2; test_layout.c hinge_is_exact */
bool fw_hinge_shape_csfh(const fw_flexure *flexure, fw_hinge_shape *shape) {
    const double flat = 1e-6;
    double r = flexure->radius_m, t = flexure->width_m, a = 0.5 * flexure->angle_rad;
    double ri = r - 0.5 * t, ro = r + 0.5 * t, sa = sin(a), ca = cos(a);
    if (!(ri > 0.0 && sa > 0.0)) return false;

    double least = (0.525 * FW_LEAST_SPACE_M + flat * fmax(0.0, -ca)) / sa;
    double corner = fmax(fmax(r - fmax(FW_RING_M, 4.0 * t), 0.5 * r), least);
    double room = ri * ri - (least + flat) * (least + flat);
    if (!(room > 0.0)) return false;
    double rho = fmin(shape->fillet_m, fmin(room / (2.0 * ri), 0.3 * ri));
    if (!(rho > 0.02 * t)) return false;
    double face_end = sqrt(ri * ri - 2.0 * ri * rho);
    if (corner > face_end - flat) corner = face_end - flat;

    double inner = asin(rho / (ri - rho)), outer = asin(rho / (ro + rho)), cut = a - inner;
    if (!(cut > 0.05)) return false;
    double far_end = sqrt((ro + rho) * (ro + rho) - rho * rho);
    fw_vec2 o = fw_v(-fw_hinge_centre(flexure, rho), 0.0), e = fw_v(ca, sa);

    shape->arc_centre = o;
    shape->strip_sweep_rad = 2.0 * cut;
    shape->fillet_m = rho;
    shape->cut_flags = FW_SEGMENT_JOINT;
    shape->width_m = t;
    shape->size_m = r;
    shape->joint_in = fw_add(o, ri, fw_polar(cut));
    shape->joint_out = fw_add(o, ro, fw_polar(cut));
    shape->edge_centre = o;
    shape->edge_sweep_rad = inner - outer;
    shape->inner_end = shape->joint_in;
    shape->outer_start = fw_add(o, ro, fw_polar(a - outer));
    shape->outer_centre = fw_add(o, ro + rho, fw_polar(a - outer));
    shape->outer_end = fw_add(o, far_end, e);
    shape->outer_sweep_rad = -(0.5 * FW_PI - outer);
    shape->inner_start = fw_add(o, face_end, e);
    shape->inner_centre = fw_add(o, ri - rho, fw_polar(cut));
    shape->inner_sweep_rad = -(0.5 * FW_PI + inner);
    shape->root = fw_add(o, r, e);
    shape->face = e;
    shape->into = fw_left(e);
    shape->inner_corner = fw_add(o, corner, e);
    shape->reach_m = fmax(fw_norm(shape->outer_end), fabs(o.x + ro));
    return true;
}
