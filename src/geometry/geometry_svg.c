/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/contour.h"
#include <math.h>

int fw_geometry_arc_parts(const fw_geometry_segment *s, double most_rad) {
    return (int)ceil(fabs(s->sweep_rad) / most_rad - 1e-9);
}

fw_geometry_vec2 fw_geometry_arc_end(const fw_geometry_segment *s, int i, int parts) {
    if (i == parts) return s->b;
    double angle = s->sweep_rad * i / parts, c = cos(angle), n = sin(angle);
    fw_geometry_vec2 r = {s->a.x - s->centre.x, s->a.y - s->centre.y};
    return (fw_geometry_vec2){s->centre.x + r.x * c - r.y * n, s->centre.y + r.x * n + r.y * c};
}

static void point(fw_text *out, const fw_geometry_sheet *sheet, char command, fw_geometry_vec2 at) {
    fw_svg_point(out, command, (at.x - sheet->x0_m) * sheet->per_m,
                 (sheet->y1_m - at.y) * sheet->per_m, sheet->decimals);
}

static void arc(fw_text *out, const fw_geometry_sheet *sheet, const fw_geometry_segment *s) {
    int parts = fw_geometry_arc_parts(s, sheet->most_rad);
    double r = s->radius * sheet->per_m, half_turn = 0.5 * (3.0 * FW_GEOMETRY_ARC_EXACT);
    bool large = fabs(s->sweep_rad) / parts > half_turn;
    for (int i = 1; i <= parts; i++) {
        fw_svg_point(out, 'A', r, r, sheet->decimals);
        fw_text_add(out, large ? " 0 1" : " 0 0");
        fw_text_add(out, s->sweep_rad < 0.0 ? " 1" : " 0"); /* y points down */
        point(out, sheet, ' ', fw_geometry_arc_end(s, i, parts));
    }
}

static void run(fw_text *out, const fw_geometry_sheet *sheet, const fw_geometry_contour *c,
                bool edges) {
    bool down = false; /* the pen: a joint lifts it */
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (edges && s->flags & FW_SEGMENT_JOINT) {
            down = false;
            continue;
        }
        if (!down) point(out, sheet, 'M', s->a);
        down = true;
        if (s->kind == FW_ARC)
            arc(out, sheet, s);
        else
            point(out, sheet, 'L', s->b);
    }
}

void fw_geometry_svg_contour(fw_text *out, const fw_geometry_sheet *sheet,
                             const fw_geometry_contour *c) {
    run(out, sheet, c, false);
    if (c->count > 0) fw_text_add(out, "Z");
}

void fw_geometry_svg_edges(fw_text *out, const fw_geometry_sheet *sheet,
                           const fw_geometry_contour *c) {
    run(out, sheet, c, true);
}
