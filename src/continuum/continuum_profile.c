/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/mesh.h"
#include "base/constants.h"
#include <math.h>

/* frame at arc length s; beyond the ends the last piece goes on */
static fw_continuum_profile_frame frame_at(const fw_continuum_profile *p, double s_m) {
    int i = 0;
    while (i + 1 < p->shape->npiece && s_m >= p->s0_m[i + 1])
        i++;
    fw_continuum_profile_frame f = p->start[i];
    double ds = s_m - p->s0_m[i], turn = p->shape->piece[i].curvature_per_m * ds;
    /* chord of an arc: ds sinc(turn/2) at half the turn */
    double half = 0.5 * turn, chord = fabs(half) < 1e-9 ? ds : ds * sin(half) / half;
    double c = cos(half), s = sin(half);
    fw_continuum_profile_frame g = {.x = f.x + chord * (f.tx * c - f.ty * s),
                                    .y = f.y + chord * (f.ty * c + f.tx * s)};
    g.tx = f.tx * cos(turn) - f.ty * sin(turn);
    g.ty = f.ty * cos(turn) + f.tx * sin(turn);
    return g;
}

/* outward-looking frame at distance `before` inside end 0 or 1 (< 0: in the block) */
static fw_continuum_profile_frame frame_outwards(const fw_continuum_profile *p, int end,
                                                 double before_m) {
    fw_continuum_profile_frame f = frame_at(p, end ? p->length_m - before_m : before_m);
    if (!end) f.tx = -f.tx, f.ty = -f.ty;
    return f;
}

static fw_geometry_vec2 offset_from(fw_continuum_profile_frame f, double n_m) {
    return (fw_geometry_vec2){f.x - n_m * f.ty, f.y + n_m * f.tx};
}

static double end_curvature(const fw_continuum_profile *p, int end) {
    return end ? p->shape->piece[p->shape->npiece - 1].curvature_per_m
               : -p->shape->piece[0].curvature_per_m;
}

/* Fillet of radius rho tangent to the edge at n = +-t/2 and to the straight face of the root. Its
   centre lies at n_c = +-(t/2 + rho) and rho before the face; on a centre line of curvature k the
   circle about the arc's centre through it has radius |1/k - n_c|, so that it is
   asin(rho/|1/k - n_c|)/|k| before the root along the centre line.
   in: profile with lines placed; out: fillet; false: it does not fit inside the curve */
static bool fillet_at(const fw_continuum_profile *p, int end, int side,
                      fw_continuum_profile_fillet *fillet) {
    const fw_continuum_shape *shape = p->shape;
    double rho = shape->fillet_m, k = end_curvature(p, end), sign = side ? 1.0 : -1.0;
    double nc = sign * (0.5 * shape->width_m + rho);
    fillet->before_m = rho;
    if (k != 0.0) {
        double q = (1.0 / k - nc) * (k > 0.0 ? 1.0 : -1.0);
        if (!(q > 1.000001 * rho)) return false;
        fillet->before_m = asin(rho / q) / fabs(k);
    }
    double last = shape->piece[end ? shape->npiece - 1 : 0].length_m;
    if (!(fillet->before_m < last)) return false;
    fw_continuum_profile_frame f = frame_outwards(p, end, fillet->before_m);
    fillet->centre = offset_from(f, nc);
    fillet->from_rad = atan2(-sign * f.tx, sign * f.ty);
    fillet->sweep_rad = sign * 0.5 * FW_PI + k * fillet->before_m;
    return true;
}

fw_status fw_continuum_profile_build(const fw_continuum_shape *shape, fw_continuum_profile *profile,
                                     const char **why) {
    *profile = (fw_continuum_profile){.shape = shape};
    *why = "the centre line has no piece";
    if (shape->npiece < 1 || shape->npiece > FW_CONTINUUM_PIECES) return FW_GEOMETRY;
    profile->start[0] = (fw_continuum_profile_frame){
        shape->x_m, shape->y_m, cos(shape->direction_rad), sin(shape->direction_rad)};
    for (int i = 0; i < shape->npiece; i++) {
        const fw_continuum_piece *piece = &shape->piece[i];
        *why = "a piece of the centre line has no length or is curved more tightly than its width";
        if (!(piece->length_m > 0.0 && isfinite(piece->length_m) &&
              fabs(piece->curvature_per_m) * shape->width_m < 1.8))
            return FW_GEOMETRY;
        if (i > 0) {
            profile->s0_m[i] = profile->length_m;
            profile->start[i] = (fw_continuum_profile_frame){0};
            fw_continuum_profile before = *profile;
            fw_continuum_shape cut = *shape;
            cut.npiece = i;
            before.shape = &cut;
            profile->start[i] = frame_at(&before, profile->length_m);
        }
        profile->length_m += piece->length_m;
    }
    *why = "width or depth is not positive";
    if (!(shape->width_m > 0.0 && shape->depth_m > 0.0)) return FW_GEOMETRY;
    if (shape->root == FW_ROOT_RIGID) return FW_OK;
    *why = "the fillets leave no strip between them, or do not fit inside the curve";
    for (int end = 0; end < 2; end++)
        for (int side = 0; side < 2; side++)
            if (!(shape->fillet_m > 0.0) ||
                !fillet_at(profile, end, side, &profile->fillet[end][side]))
                return FW_GEOMETRY;
    for (int side = 0; side < 2; side++)
        if (!(profile->fillet[0][!side].before_m + profile->fillet[1][side].before_m <
              profile->length_m - 0.5 * shape->width_m))
            return FW_GEOMETRY;
    *why = "the root block is not larger than the strip with its fillets";
    double least = 0.5 * shape->width_m + shape->fillet_m;
    double k = fmax(fabs(end_curvature(profile, 0)), fabs(end_curvature(profile, 1)));
    if (!(shape->block_half_m > 1.2 * least && shape->block_length_m > 1.2 * least &&
          k * shape->block_half_m < 0.95 && k * shape->block_length_m < FW_PI))
        return FW_GEOMETRY;
    return FW_OK;
}

fw_continuum_profile_edge fw_continuum_profile_strip_edge(const fw_continuum_profile *p, int side,
                                                          double u) {
    double a = 0.0, b = p->length_m, sign = side ? 1.0 : -1.0;
    if (p->shape->root == FW_ROOT_BLOCK) {
        a = p->fillet[0][!side].before_m;
        b = p->length_m - p->fillet[1][side].before_m;
    }
    fw_continuum_profile_frame f = frame_at(p, a + u * (b - a));
    return (fw_continuum_profile_edge){offset_from(f, sign * 0.5 * p->shape->width_m),
                                       {sign * f.ty, -sign * f.tx}};
}

fw_continuum_profile_edge fw_continuum_profile_fillet_edge(const fw_continuum_profile *p, int end,
                                                           int side, double u) {
    const fw_continuum_profile_fillet *fillet = &p->fillet[end][end ? side : !side];
    double at = fillet->from_rad + u * fillet->sweep_rad, c = cos(at), s = sin(at);
    return (fw_continuum_profile_edge){
        {fillet->centre.x + p->shape->fillet_m * c, fillet->centre.y + p->shape->fillet_m * s},
        {c, s}};
}

fw_geometry_vec2 fw_continuum_profile_block_edge(const fw_continuum_profile *p, int end,
                                                 double corner, double v) {
    double half = p->shape->block_half_m, length = p->shape->block_length_m;
    double deep = length, n;
    if (v < corner) {
        n = -half, deep = length * v / corner;
    } else if (v > 1.0 - corner) {
        n = half, deep = length * (1.0 - v) / corner;
    } else {
        n = half * (2.0 * (v - corner) / (1.0 - 2.0 * corner) - 1.0);
    }
    return offset_from(frame_outwards(p, end, -deep), n);
}

/* from the end of the strip's edge around fillet, face, block and back, on the way out at `end`,
   counter-clockwise: right side of the way out first */
static void round_block(fw_geometry_outline *o, const fw_continuum_profile *p, int end) {
    const fw_continuum_shape *s = p->shape;
    const fw_continuum_profile_fillet *right = &p->fillet[end][0], *left = &p->fillet[end][1];
    double k = end ? s->piece[s->npiece - 1].curvature_per_m : -s->piece[0].curvature_per_m;
    double half = s->block_half_m, length = s->block_length_m;
    fw_continuum_profile_frame near = frame_outwards(p, end, 0.0),
                               far = frame_outwards(p, end, -length);
    fw_geometry_vec2 centre = k != 0.0 ? offset_from(near, 1.0 / k) : (fw_geometry_vec2){0.0, 0.0};
    fw_geometry_outline_arc(o, right->centre, right->sweep_rad, 0);
    fw_geometry_outline_line(o, offset_from(near, -half), 0);
    if (k != 0.0)
        fw_geometry_outline_arc_to(o, centre, k * length, offset_from(far, -half), 0);
    else
        fw_geometry_outline_line(o, offset_from(far, -half), 0);
    fw_geometry_outline_line(o, offset_from(far, half), 0);
    if (k != 0.0)
        fw_geometry_outline_arc_to(o, centre, -k * length, offset_from(near, half), 0);
    else
        fw_geometry_outline_line(o, offset_from(near, half), 0);
    fw_continuum_profile_frame f = frame_outwards(p, end, left->before_m);
    double last = left->from_rad + left->sweep_rad;
    fw_geometry_outline_line(o,
                             (fw_geometry_vec2){left->centre.x + s->fillet_m * cos(last),
                                                left->centre.y + s->fillet_m * sin(last)},
                             0);
    fw_geometry_outline_arc_to(o, left->centre, -left->sweep_rad, offset_from(f, 0.5 * s->width_m),
                               0);
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
        fw_geometry_vec2 target = offset_from(frame_at(p, forwards ? to : from), n);
        if (k == 0.0)
            fw_geometry_outline_line(o, target, 0);
        else
            fw_geometry_outline_arc_to(o, offset_from(p->start[i], 1.0 / k),
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
