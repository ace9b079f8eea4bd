/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beam of beam.h that a flexure is, with the corrections of its closed form. */
#include "base/constants.h"
#include "flexure/beam.h"
#include "flexure/path.h"
#include "flexure/section.h"
#include <math.h>

/* the crystal of the closed form in the frame of the flexure; psi of a tangent is a quarter turn
   off the polar angle, which cos 4 psi does not feel. The two roots give as
   fw_flexure_root_m_per_Pa has it, the ends take away what fw_flexure_end_loss_of says, spread as
   it is found there */
static void elastic_of(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                       fw_flexure_beam *out) {
    const fw_flexure_crystal elastic = fw_flexure_elastic_of(in), *k = &elastic;
    double turn = 0.5 * FW_PI - out->psi_rad; /* from the middle to either end */
    fw_flexure_shape shape;
    fw_flexure_shape_of(in, &shape);
    out->cubic = true;
    out->a0_per_Pa = k->a0_per_Pa;
    out->a1_per_Pa = k->aligned ? k->a1_per_Pa : 0; /* else the mean over all directions */
    out->orientation_rad = 0.25 * atan2(k->sin4, k->cos4);
    out->depth_factor = closed_form->depth_factor * shape.golovin;
    out->shear_Pa = closed_form->youngs_Pa / (2 * (1 + closed_form->poisson));
    double h = in->depth_m, L = in->length_m, t = in->width_m, E = closed_form->youngs_Pa, f = 1;
    if (in->kind == FW_FLEXURE_CSFH)
        f = fw_flexure_depth_crystal(h / sqrt(in->radius_m * t), k, E).bow;
    const fw_flexure_end_loss loss = fw_flexure_end_loss_of(k, h, f, L, shape.root_block_m);
    double far = exp(-L / loss.reach_m);
    out->lost_m = loss.reach_m;
    out->lost_per_Pa = k->bow_per_Pa * loss.length_m / (loss.reach_m * (1 - far));
    for (int end = 0; end < 2; end++) {
        double four = 4 * (out->orientation_rad + (end ? turn : -turn));
        double per_E = out->a0_per_Pa + out->a1_per_Pa * cos(four) - out->lost_per_Pa * (1 + far);
        out->root_m[end] = fw_flexure_root_m_per_Pa(&shape, k, k->aligned ? cos(four) : 0) / per_E;
    }
}

/* EI is what makes K = EI/(L + 2 dL) the stiffness of the closed form, as in
   fw_flexure_hinge_law_of; of a crystal it goes with the direction. Test: test_beam.c, of a crystal
   tests/cli/test_hinge.py test_random_beams */
void fw_flexure_beam_of_flexure(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                                fw_flexure_beam_piece *piece, fw_flexure_beam *out) {
    bool arc = in->kind == FW_FLEXURE_CSFH;
    double t = in->width_m, L = in->length_m, dL = closed_form->root_length_m;
    double a = arc ? 0.5 * in->angle_rad : 0, r = arc ? in->radius_m : 0;
    double thin = in->youngs_Pa * in->depth_m * t * t * t / 12;
    *piece = (fw_flexure_beam_piece){
        .length_m = L, .curvature_per_m = arc ? 1 / r : 0, .width_m = {t, t, t}};
    *out =
        (fw_flexure_beam){.piece = piece,
                          .npiece = 1,
                          .x_m = r * cos(a),
                          .y_m = arc ? -r * sin(a) : -0.5 * L,
                          .psi_rad = 0.5 * FW_PI - a,
                          .depth_m = in->depth_m,
                          .youngs_Pa = in->youngs_Pa,
                          .shear_Pa = in->youngs_Pa / (2 * (1 + in->poisson)),
                          .depth_factor = closed_form->stiffness_Nm_per_rad * (L + 2 * dL) / thin,
                          .root_m = {dL, dL}};
    if (fw_flexure_elastic_of(in).known) elastic_of(in, closed_form, out);
}

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

void fw_flexure_beam_scale(fw_flexure_beam *beam, double by) {
    if (!(by > 0)) return;
    beam->youngs_Pa *= by, beam->shear_Pa *= by;
    beam->a0_per_Pa /= by, beam->a1_per_Pa /= by, beam->lost_per_Pa /= by;
}
