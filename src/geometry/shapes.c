/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simple outlines, all counter-clockwise. */
#include "geometry/segment.h"

static fw_status four_corners(fw_arena *arena, const fw_geometry_vec2 corner[4],
                              fw_geometry_contour *contour) {
    fw_geometry_outline outline = fw_geometry_outline_start(arena, corner[0]);
    for (int i = 1; i < 4; i++)
        fw_geometry_outline_line(&outline, corner[i], 0);
    FW_TRY(fw_geometry_outline_close(&outline, contour));
    return contour->count == 4 ? FW_OK : FW_GEOMETRY;
}

fw_status fw_geometry_contour_rectangle(fw_arena *arena, fw_geometry_box box,
                                        fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    if (!(box.x1 - box.x0 > FW_COINCIDENT_M && box.y1 - box.y0 > FW_COINCIDENT_M))
        return FW_GEOMETRY;
    const fw_geometry_vec2 corner[4] = {
        {box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
    return four_corners(arena, corner, contour);
}

/* two half circles: no writer needs a special case for an arc that ends where it begins */
fw_status fw_geometry_contour_disc(fw_arena *arena, fw_geometry_vec2 centre, double radius_m,
                                   fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    if (!vec_finite(centre) || !isfinite(radius_m) || radius_m <= FW_COINCIDENT_M)
        return FW_GEOMETRY;
    fw_geometry_vec2 right = {centre.x + radius_m, centre.y},
                     left = {centre.x - radius_m, centre.y};
    fw_geometry_segment *s = fw_arena_array(arena, fw_geometry_segment, 2);
    FW_NEED(s);
    s[0] = (fw_geometry_segment){FW_ARC, 0, right, left, centre, radius_m, FW_PI};
    s[1] = (fw_geometry_segment){FW_ARC, 0, left, right, centre, radius_m, FW_PI};
    *contour = (fw_geometry_contour){s, 2};
    return FW_OK;
}

fw_status fw_geometry_contour_bar(fw_arena *arena, fw_geometry_vec2 p, fw_geometry_vec2 q,
                                  double width_m, fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    fw_geometry_vec2 along = vec_sub(q, p);
    if (!(vec_length(along) > FW_COINCIDENT_M && width_m > FW_COINCIDENT_M) || !isfinite(width_m))
        return FW_GEOMETRY;
    fw_geometry_vec2 half = vec_scale(0.5 * width_m, vec_left(vec_unit(along)));
    const fw_geometry_vec2 corner[4] = {vec_sub(p, half), vec_sub(q, half), vec_add(q, half),
                                        vec_add(p, half)};
    return four_corners(arena, corner, contour);
}

fw_status fw_geometry_contour_ring_sector(fw_arena *arena, fw_geometry_vec2 centre, double inner_m,
                                          double outer_m, double angle0_rad, double sweep_rad,
                                          fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    bool sizes = inner_m >= 0 && outer_m - inner_m > FW_COINCIDENT_M && isfinite(outer_m);
    /* a closed ring has a hole and is no single outline */
    bool angles = isfinite(angle0_rad) && (FW_TURN - sweep_rad) * outer_m > FW_COINCIDENT_M &&
                  sweep_rad * outer_m > FW_COINCIDENT_M;
    if (!vec_finite(centre) || !sizes || !angles) return FW_GEOMETRY;
    fw_geometry_vec2 u0 = {cos(angle0_rad), sin(angle0_rad)};
    fw_geometry_vec2 u1 = {cos(angle0_rad + sweep_rad), sin(angle0_rad + sweep_rad)};
    bool pie = inner_m <= FW_COINCIDENT_M;
    fw_geometry_outline outline = fw_geometry_outline_start(arena, vec_along(centre, outer_m, u0));
    fw_geometry_outline_arc_to(&outline, centre, sweep_rad, vec_along(centre, outer_m, u1), 0);
    fw_geometry_outline_line(&outline, pie ? centre : vec_along(centre, inner_m, u1), 0);
    if (!pie)
        fw_geometry_outline_arc_to(&outline, centre, -sweep_rad, vec_along(centre, inner_m, u0), 0);
    return fw_geometry_outline_close(&outline, contour);
}
