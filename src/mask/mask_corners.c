/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask_rules.h"
#include "base/constants.h"
#include <math.h>

static const double GRID_M = 1e-9;
static const fw_place nowhere;

static fw_geometry_vec2 place_of(fw_geometry_point p) {
    return (fw_geometry_vec2){p.x_dbu * GRID_M, p.y_dbu * GRID_M};
}

static bool ends_joint(const fw_geometry_contour *c, fw_geometry_point vertex) {
    fw_geometry_vec2 at = place_of(vertex);
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (s->flags & FW_SEGMENT_JOINT && (hypot(s->a.x - at.x, s->a.y - at.y) < GRID_M ||
                                            hypot(s->b.x - at.x, s->b.y - at.y) < GRID_M))
            return true;
    }
    return false;
}

/* cosine of the angle between two edges of a vertex; exact sign: |coordinates| < 2^30 */
static double cosine(fw_geometry_point a, fw_geometry_point v, fw_geometry_point b) {
    int64_t ax = (int64_t)a.x_dbu - v.x_dbu, ay = (int64_t)a.y_dbu - v.y_dbu;
    int64_t bx = (int64_t)b.x_dbu - v.x_dbu, by = (int64_t)b.y_dbu - v.y_dbu;
    int64_t dot = ax * bx + ay * by;
    if (dot <= 0) return 0;
    return (double)dot / (hypot((double)ax, (double)ay) * hypot((double)bx, (double)by));
}

void fw_mask_check_corners(const fw_mask_shape *shape, int nshape, fw_diags *diags) {
    for (int k = 0; k < nshape; k++) {
        const fw_geometry_polygon *p = &shape[k].polygon;
        int count = 0, worst = 0;
        double most = 0;
        if (!shape[k].report.acute) continue; /* as measured of all corners */
        fw_geometry_point a = p->vertex[p->count - 1], v = p->vertex[0], b;
        for (int i = 0; i < p->count; i++, a = v, v = b) {
            b = p->vertex[i + 1 < p->count ? i + 1 : 0];
            double c = cosine(a, v, b);
            if (c <= 0 || ends_joint(&shape[k].contour, v)) continue;
            count++;
            if (c > most) {
                most = c;
                worst = i;
            }
        }
        if (count == 0) continue;
        char at[80], degrees[32];
        fw_diag_warning(diags, 153, nowhere,
                        "%s has %d corner(s) below 90 degrees on the grid, the sharpest %s at %s; "
                        "width checks report them; round the corner",
                        shape[k].piece->label, count,
                        fw_number_text(degrees, sizeof degrees, acos(most) * 180 / FW_PI, 8),
                        fw_mask_place_text(at, sizeof at, place_of(p->vertex[worst])));
    }
}
