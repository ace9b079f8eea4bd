/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/mesh.h"
#include "continuum/continuum_profile.h"
#include <math.h>

/* from the end of the strip's edge around fillet, face, block and back, on the way out at `end`,
   counter-clockwise: right side of the way out first */
static void round_block(fw_geometry_outline *o, const fw_continuum_profile *p, int end) {
    const fw_continuum_shape *s = p->shape;
    const fw_continuum_profile_fillet *right = &p->fillet[end][0], *left = &p->fillet[end][1];
    double k = end ? s->piece[s->npiece - 1].curvature_per_m : -s->piece[0].curvature_per_m;
    double half = s->block_half_m, length = s->block_length_m;
    fw_continuum_profile_frame near = fw_continuum_profile_out(p, end, 0.0),
                               far = fw_continuum_profile_out(p, end, -length);
    fw_geometry_vec2 centre =
        k != 0.0 ? fw_continuum_profile_offset(near, 1.0 / k) : (fw_geometry_vec2){0.0, 0.0};
    fw_geometry_outline_arc(o, right->centre, right->sweep_rad, 0);
    fw_geometry_outline_line(o, fw_continuum_profile_offset(near, -half), 0);
    if (k != 0.0)
        fw_geometry_outline_arc_to(o, centre, k * length, fw_continuum_profile_offset(far, -half),
                                   0);
    else
        fw_geometry_outline_line(o, fw_continuum_profile_offset(far, -half), 0);
    fw_geometry_outline_line(o, fw_continuum_profile_offset(far, half), 0);
    if (k != 0.0)
        fw_geometry_outline_arc_to(o, centre, -k * length, fw_continuum_profile_offset(near, half),
                                   0);
    else
        fw_geometry_outline_line(o, fw_continuum_profile_offset(near, half), 0);
    fw_continuum_profile_frame f = fw_continuum_profile_out(p, end, left->before_m);
    double last = left->from_rad + left->sweep_rad;
    fw_geometry_outline_line(o,
                             (fw_geometry_vec2){left->centre.x + s->fillet_m * cos(last),
                                                left->centre.y + s->fillet_m * sin(last)},
                             0);
    fw_geometry_outline_arc_to(o, left->centre, -left->sweep_rad,
                               fw_continuum_profile_offset(f, 0.5 * s->width_m), 0);
}

/* an edge of the strip, `side` of the way from first to second root, forwards or back */
static void along(fw_geometry_outline *o, const fw_continuum_profile *p, int side, bool forwards) {
    const fw_continuum_shape *s = p->shape;
    double a = 0.0, b = p->length_m, n = (side ? 0.5 : -0.5) * s->width_m;
    if (s->root == FW_ROOT_BLOCK)
        a = p->fillet[0][!side].before_m, b -= p->fillet[1][side].before_m;
    for (int step = 0; step < s->npiece; step++) {
        int i = forwards ? step : s->npiece - 1 - step;
        double from = fmax(a, p->s0_m[i]), k = s->piece[i].curvature_per_m;
        double to = fmin(b, p->s0_m[i] + s->piece[i].length_m);
        fw_geometry_vec2 target =
            fw_continuum_profile_offset(fw_continuum_profile_at(p, forwards ? to : from), n);
        if (k == 0.0)
            fw_geometry_outline_line(o, target, 0);
        else
            fw_geometry_outline_arc_to(o, fw_continuum_profile_offset(p->start[i], 1.0 / k),
                                       (forwards ? k : -k) * (to - from), target, 0);
    }
}

fw_status fw_continuum_outline(fw_arena *arena, const fw_continuum_shape *shape,
                               fw_geometry_contour *contour, const char **why) {
    fw_continuum_profile p;
    FW_TRY(fw_continuum_profile_build(shape, &p, why));
    *why = "the outline does not close";
    bool block = shape->root == FW_ROOT_BLOCK;
    fw_geometry_outline o =
        fw_geometry_outline_start(arena, fw_continuum_profile_strip_edge(&p, 0, 0.0).p);
    along(&o, &p, 0, true);
    if (block)
        round_block(&o, &p, 1);
    else
        fw_geometry_outline_line(&o, fw_continuum_profile_strip_edge(&p, 1, 1.0).p, 0);
    along(&o, &p, 1, false);
    if (block) round_block(&o, &p, 0);
    return fw_geometry_outline_close(&o, contour);
}
