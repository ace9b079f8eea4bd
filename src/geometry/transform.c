/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"

typedef struct frame {
    double c, s, x, y;
    bool mirror;
} frame;

static fw_geometry_vec2 moved(const frame *f, fw_geometry_vec2 p) {
    double y = f->mirror ? -p.y : p.y;
    return (fw_geometry_vec2){f->c * p.x - f->s * y + f->x, f->s * p.x + f->c * y + f->y};
}

fw_status fw_geometry_contour_transform(fw_arena *arena, const fw_geometry_contour *contour,
                                        fw_geometry_pose pose, bool mirror_y,
                                        fw_geometry_contour *out) {
    *out = (fw_geometry_contour){0};
    if (!isfinite(pose.x_m) || !isfinite(pose.y_m) || !isfinite(pose.angle_rad)) return FW_GEOMETRY;
    int n = contour->count;
    fw_geometry_segment *segment = fw_arena_array(arena, fw_geometry_segment, (size_t)n);
    FW_NEED(segment);
    frame f = {cos(pose.angle_rad), sin(pose.angle_rad), pose.x_m, pose.y_m, mirror_y};
    for (int i = 0; i < n; i++) {
        /* a mirrored outline runs the other way; read backwards it stays counter-clockwise */
        fw_geometry_segment s = mirror_y ? fw_geometry_segment_reverse(&contour->segment[n - 1 - i])
                                         : contour->segment[i];
        s.a = moved(&f, s.a);
        s.b = moved(&f, s.b);
        if (s.kind == FW_ARC) {
            s.centre = moved(&f, s.centre);
            if (mirror_y) s.sweep_rad = -s.sweep_rad;
        }
        segment[i] = s;
    }
    *out = (fw_geometry_contour){segment, n};
    return FW_OK;
}

fw_status fw_geometry_contour_reverse(fw_arena *arena, const fw_geometry_contour *contour,
                                      fw_geometry_contour *out) {
    *out = (fw_geometry_contour){0};
    int n = contour->count;
    fw_geometry_segment *segment = fw_arena_array(arena, fw_geometry_segment, (size_t)n);
    FW_NEED(segment);
    for (int i = 0; i < n; i++)
        segment[i] = fw_geometry_segment_reverse(&contour->segment[n - 1 - i]);
    *out = (fw_geometry_contour){segment, n};
    return FW_OK;
}
