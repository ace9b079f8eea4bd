/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"

/* one y-monotone piece against the ray from the point to the right: +1 up, -1 down, 0 none.
   Half-open in y, so that a vertex on the ray counts once. */
static int crosses(double y0, double y1, double y) {
    if ((y0 <= y) == (y1 <= y)) return 0;
    return y0 <= y ? 1 : -1;
}

static int line_winding(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    int way = crosses(s->a.y, s->b.y, p.y);
    if (way == 0) return 0;
    /* the crossing lies to the right of p when p is to the left of the upward edge */
    double side = vec_cross(vec_sub(s->b, s->a), vec_sub(p, s->a));
    return (way > 0) == (side > 0) ? way : 0;
}

static int arc_winding(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    fw_geometry_vec2 c = s->centre;
    double r = s->radius, y = p.y - c.y;
    /* beside the circle (ends may be off it by less than 1e-10 m): nothing to the right, or all of
       it, and then the steps below add up to that from one end to the other */
    if (fabs(y) > r + 1e-10 || p.x >= c.x + r) return 0;
    if (p.x < c.x - r) return crosses(s->a.y, s->b.y, p.y);
    double half = fabs(y) < r ? sqrt((r - y) * (r + y)) : 0;
    double start = atan2(s->a.y - c.y, s->a.x - c.x), end = start + s->sweep_rad;
    double way = s->sweep_rad > 0 ? 1 : -1;
    /* quadrant pairs: right half between -pi/2 and pi/2 (+ 2 pi k), left half the others */
    double sector = floor((start + 0.5 * FW_PI) / FW_PI);
    double y0 = s->a.y;
    int total = 0;
    for (int guard = 0; guard < 4; guard++) {
        double limit = way > 0 ? (sector + 0.5) * FW_PI : (sector - 0.5) * FW_PI;
        bool last = way > 0 ? end <= limit : end >= limit;
        bool right = fmod(fabs(sector), 2) < 0.5;
        bool up = right == (way > 0);
        double y1 = last ? s->b.y : up ? c.y + r : c.y - r;
        int step = crosses(y0, y1, p.y);
        if (step != 0 && p.x < (right ? c.x + half : c.x - half)) total += step;
        if (last) break;
        y0 = y1;
        sector += way;
    }
    return total;
}

/* Winding number by a ray to the right: lines by the sign of a cross product, arcs cut at their top
   and bottom, where x = c_x +- sqrt(r^2 - (y - c_y)^2) is single-valued.
   In: contour, point (m). Exact for points off the outline by more than rounding. O(n).
   Test: test_distance.c. */
int fw_geometry_contour_winding(const fw_geometry_contour *contour, fw_geometry_vec2 point) {
    int total = 0;
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        total += s->kind == FW_LINE ? line_winding(s, point) : arc_winding(s, point);
    }
    return total;
}

bool fw_geometry_contour_contains(const fw_geometry_contour *contour, fw_geometry_vec2 point) {
    return fw_geometry_contour_winding(contour, point) != 0;
}
