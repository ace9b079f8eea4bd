/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/path.h"

static double width(const void *context, int piece, double s_m) {
    return fw_geometry_strip_width((const fw_geometry_strip_shape *)context + piece, s_m);
}

/* One depth factor for the whole: what makes 1/C_th of the beam the stiffness of the closed form,
   which has it at every place. In, out: SI. Cost: that of fw_flexure_beam_compliance.
   Test: test_path.c beam_of_a_path */
fw_status fw_flexure_path_beam(fw_arena *arena, const fw_flexure_input *in,
                               const fw_flexure_result *closed_form, fw_flexure_beam *out) {
    fw_flexure_course *p;
    fw_flexure_beam_piece *piece;
    fw_flexure_beam_linear linear;
    FW_NEED(p = fw_arena_one(arena, fw_flexure_course));
    fw_flexure_path_of(in, p);
    FW_NEED(piece = fw_arena_array(arena, fw_flexure_beam_piece, (size_t)p->n));
    for (int i = 0; i < p->n; i++) {
        const fw_geometry_strip_piece *q = &p->shape[i].piece;
        piece[i] =
            (fw_flexure_beam_piece){.length_m = q->length_m,
                                    .curvature_per_m = q->curvature_per_m,
                                    .width_m = {q->width_m[0], q->width_m[1], q->width_m[2]}};
    }
    *out = (fw_flexure_beam){.piece = piece,
                             .npiece = p->n,
                             .x_m = p->start[0].x_m,
                             .y_m = p->start[0].y_m,
                             .psi_rad = p->start[0].angle_rad,
                             .depth_m = in->depth_m,
                             .youngs_Pa = closed_form->youngs_Pa,
                             .shear_Pa = closed_form->youngs_Pa / (2 * (1 + closed_form->poisson)),
                             .depth_factor = 1,
                             .root_m = {p->root_m[0], p->root_m[1]},
                             .width = width,
                             .context = p->shape};
    fw_flexure_beam_compliance(out, &linear);
    out->depth_factor = linear.c[0][0] * closed_form->stiffness_Nm_per_rad;
    return FW_OK;
}

fw_status fw_flexure_beam_of_input(fw_arena *arena, const fw_flexure_input *in,
                                   const fw_flexure_result *closed_form, fw_flexure_beam *out) {
    if (fw_flexure_input_varies(in)) return fw_flexure_path_beam(arena, in, closed_form, out);
    fw_flexure_beam_piece *piece = fw_arena_one(arena, fw_flexure_beam_piece);
    FW_NEED(piece);
    fw_flexure_beam_of_flexure(in, closed_form, piece, out);
    return FW_OK;
}
