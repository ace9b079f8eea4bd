/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"

fw_geometry_outline fw_geometry_outline_start(fw_arena *arena, fw_geometry_vec2 point) {
    return (fw_geometry_outline){
        .arena = arena, .first = point, .at = point, .invalid = !vec_finite(point)};
}

static void push(fw_geometry_outline *outline, fw_geometry_segment segment) {
    if (outline->failed) return;
    if (outline->count == outline->capacity) {
        int more = outline->capacity ? 2 * outline->capacity : 8;
        fw_geometry_segment *grown = fw_arena_grow(
            outline->arena, outline->segment, (size_t)outline->count, (size_t)more, sizeof *grown);
        if (!grown) {
            outline->failed = true;
            return;
        }
        outline->segment = grown;
        outline->capacity = more;
    }
    outline->segment[outline->count++] = segment;
    outline->at = segment.b;
}

/* a step shorter than the tolerance moves the last end instead of adding a sliver */
static void nudge(fw_geometry_outline *outline, fw_geometry_vec2 to) {
    if (outline->count > 0)
        outline->segment[outline->count - 1].b = to;
    else
        outline->first = to;
    outline->at = to;
}

void fw_geometry_outline_line(fw_geometry_outline *outline, fw_geometry_vec2 to, unsigned flags) {
    if (!vec_finite(to)) {
        outline->invalid = true;
        return;
    }
    fw_geometry_vec2 step = vec_sub(to, outline->at);
    bool far = fabs(step.x) > FW_COINCIDENT_M || fabs(step.y) > FW_COINCIDENT_M;
    if (!far && vec_length(step) <= FW_COINCIDENT_M) {
        nudge(outline, to);
        return;
    }
    push(outline,
         (fw_geometry_segment){.kind = FW_LINE, .flags = flags, .a = outline->at, .b = to});
}

void fw_geometry_outline_arc(fw_geometry_outline *outline, fw_geometry_vec2 centre,
                             double sweep_rad, unsigned flags) {
    fw_geometry_vec2 ray = vec_sub(outline->at, centre);
    fw_geometry_vec2 to = fabs(sweep_rad) == FW_TURN
                              ? outline->at
                              : vec_add(centre, fw_geometry_vec_rotate(ray, sweep_rad));
    fw_geometry_outline_arc_to(outline, centre, sweep_rad, to, flags);
}

void fw_geometry_outline_arc_to(fw_geometry_outline *outline, fw_geometry_vec2 centre,
                                double sweep_rad, fw_geometry_vec2 to, unsigned flags) {
    double radius = vec_distance(outline->at, centre);
    fw_geometry_segment arc = {FW_ARC, flags, outline->at, to, centre, radius, sweep_rad};
    /* the sweep is made to agree with the end points */
    arc.sweep_rad = fw_geometry_angle_near(
        fw_geometry_vec_angle(vec_sub(arc.a, centre), vec_sub(to, centre)), sweep_rad);
    if (fabs(arc.sweep_rad) > FW_TURN) arc.sweep_rad = copysign(FW_TURN, sweep_rad);
    if (radius * fabs(sweep_rad) <= FW_COINCIDENT_M &&
        vec_distance(outline->at, to) <= FW_COINCIDENT_M) {
        nudge(outline, to);
        return;
    }
    if (!fw_geometry_segment_valid(&arc) || arc.sweep_rad * sweep_rad < 0 ||
        fabs(arc.sweep_rad - sweep_rad) * radius > 16 * FW_COINCIDENT_M) {
        outline->invalid = true;
        return;
    }
    push(outline, arc);
}

fw_status fw_geometry_outline_close(fw_geometry_outline *outline, fw_geometry_contour *contour) {
    *contour = (fw_geometry_contour){0};
    if (!outline->failed && outline->count > 0 && !vec_same(outline->at, outline->first)) {
        if (vec_distance(outline->at, outline->first) <= FW_COINCIDENT_M)
            outline->segment[outline->count - 1].b = outline->first;
        else
            fw_geometry_outline_line(outline, outline->first, 0);
    }
    if (outline->failed) return FW_NOMEM;
    if (outline->invalid) return FW_GEOMETRY;
    fw_geometry_contour made = {outline->segment, outline->count};
    if (!fw_geometry_contour_valid(&made)) return FW_GEOMETRY;
    *contour = made;
    return FW_OK;
}
