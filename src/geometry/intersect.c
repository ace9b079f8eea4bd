/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where two lines or arcs meet. A contact within the coincidence tolerance is one touch, at the
   foot of the centre: that point is well conditioned where the two crossings of a grazing line are
   not. */
#include "geometry/segment.h"

/* Line and circle: foot f of the centre, h = |f - c|, half chord sqrt((r - h)(r + h)).
   In: point, unit direction; centre, radius (m). Out: 0, 1 (|h - r| <= 1e-12 m) or 2 points.
   Error: a few ulp across, 1e-18 m / sin(crossing angle) along. Test: test_segment.c. */
int fw_geometry_line_circle(fw_geometry_vec2 p, fw_geometry_vec2 u, fw_geometry_vec2 centre,
                            double radius, fw_geometry_vec2 hit[2]) {
    fw_geometry_vec2 foot = vec_along(p, vec_dot(vec_sub(centre, p), u), u);
    double h = fabs(vec_cross(u, vec_sub(centre, p)));
    if (h > radius + FW_COINCIDENT_M) return 0;
    if (h >= radius - FW_COINCIDENT_M) {
        hit[0] = foot;
        return 1;
    }
    double half = sqrt((radius - h) * (radius + h));
    hit[0] = vec_along(foot, -half, u);
    hit[1] = vec_along(foot, half, u);
    return 2;
}

/* Two circles at distance d: along the centre line x = (d^2 + r1^2 - r2^2) / 2d, across
   y = sqrt((r1 + r2 + d)(r1 + r2 - d)(d + r1 - r2)(d - r1 + r2)) / 2d, the factored form of Heron.
   Out: 0, 1 (touch within 1e-12 m, inside or outside) or 2 points; the same circle gives 0.
   Test: test_segment.c. */
int fw_geometry_circle_circle(fw_geometry_vec2 c1, double r1, fw_geometry_vec2 c2, double r2,
                              fw_geometry_vec2 hit[2]) {
    fw_geometry_vec2 between = vec_sub(c2, c1);
    double d = vec_length(between);
    double outside = r1 + r2 - d, inside = d - fabs(r1 - r2);
    if (outside < -FW_COINCIDENT_M || inside < -FW_COINCIDENT_M || d <= FW_COINCIDENT_M) return 0;
    fw_geometry_vec2 u = vec_scale(1 / d, between);
    if (outside <= FW_COINCIDENT_M) {
        hit[0] = vec_along(c1, r1, u);
        return 1;
    }
    if (inside <= FW_COINCIDENT_M) {
        hit[0] = vec_along(c1, r1 >= r2 ? r1 : -r1, u);
        return 1;
    }
    double x = 0.5 * (d + (r1 - r2) * (r1 + r2) / d);
    double y = sqrt((r1 + r2 + d) * outside * (d + r1 - r2) * (d - r1 + r2)) / (2 * d);
    fw_geometry_vec2 foot = vec_along(c1, x, u);
    hit[0] = vec_along(foot, -y, vec_left(u));
    hit[1] = vec_along(foot, y, vec_left(u));
    return 2;
}

static int line_line(const fw_geometry_segment *p, const fw_geometry_segment *q,
                     fw_geometry_vec2 hit[2]) {
    fw_geometry_vec2 u = vec_unit(vec_sub(p->b, p->a)), v = vec_unit(vec_sub(q->b, q->a));
    double sine = vec_cross(u, v);
    if (fabs(sine) < 1e-14) return 0;
    hit[0] = vec_along(p->a, vec_cross(vec_sub(q->a, p->a), v) / sine, u);
    return 1;
}

int fw_geometry_carrier_meet(const fw_geometry_segment *p, const fw_geometry_segment *q,
                             fw_geometry_vec2 hit[2]) {
    if (p->kind == FW_LINE && q->kind == FW_LINE) return line_line(p, q, hit);
    if (p->kind == FW_LINE)
        return fw_geometry_line_circle(p->a, fw_geometry_segment_tangent(p, 0), q->centre,
                                       q->radius, hit);
    if (q->kind == FW_LINE)
        return fw_geometry_line_circle(q->a, fw_geometry_segment_tangent(q, 0), p->centre,
                                       p->radius, hit);
    return fw_geometry_circle_circle(p->centre, p->radius, q->centre, q->radius, hit);
}

static int add_hit(fw_geometry_hit *hit, int n, double tp, double tq, fw_geometry_vec2 at) {
    for (int i = 0; i < n; i++)
        if (vec_distance(hit[i].at, at) <= FW_COINCIDENT_M) return n;
    if (n < FW_MOST_HITS) hit[n++] = (fw_geometry_hit){tp, tq, at};
    return n;
}

/* parameter with the ends caught: a point within the tolerance of an end is that end */
static double caught(const fw_geometry_segment *s, double t, fw_geometry_vec2 at) {
    if (vec_distance(at, s->a) <= FW_COINCIDENT_M && t < 0.5) return 0;
    if (vec_distance(at, s->b) <= FW_COINCIDENT_M && t >= 0.5) return 1;
    return t;
}

/* More than 1e-9 m beside the line or the circle, by products alone: |d^2 - r^2| = |d - r| (d + r).
   Then it is no point of the segment, whose ends are within 1e-10 m of the circle. False says
   nothing. */
static bool clearly_beside(const fw_geometry_segment *s, fw_geometry_vec2 at) {
    if (s->kind == FW_LINE) {
        fw_geometry_vec2 along = vec_sub(s->b, s->a);
        double across = vec_cross(along, vec_sub(at, s->a));
        return across * across > 1e-18 * vec_dot(along, along);
    }
    fw_geometry_vec2 ray = vec_sub(at, s->centre);
    double r = s->radius;
    return r > 1e-8 && fabs(vec_dot(ray, ray) - r * r) > 4e-9 * r;
}

/* Common points of two segments: every end of one that lies on the other (this alone gives the ends
   of an overlap), then the crossings and touches of the carriers that lie on both.
   In: two segments. Out: at most 6 hits, parameters and place. Error 1e-12 m. Test: test_segment.c
 */
int fw_geometry_segment_intersect(const fw_geometry_segment *p, const fw_geometry_segment *q,
                                  fw_geometry_hit hit[FW_MOST_HITS]) {
    int n = 0;
    for (int end = 0; end < 2; end++) {
        fw_geometry_vec2 at = end ? p->b : p->a, on;
        double t;
        if (!clearly_beside(q, at) &&
            fw_geometry_segment_nearest(q, at, &t, &on) <= FW_COINCIDENT_M)
            n = add_hit(hit, n, end, caught(q, t, at), at);
    }
    for (int end = 0; end < 2; end++) {
        fw_geometry_vec2 at = end ? q->b : q->a, on;
        double t;
        if (!clearly_beside(p, at) &&
            fw_geometry_segment_nearest(p, at, &t, &on) <= FW_COINCIDENT_M)
            n = add_hit(hit, n, caught(p, t, at), end, at);
    }
    fw_geometry_vec2 meet[2];
    int m = fw_geometry_carrier_meet(p, q, meet);
    for (int i = 0; i < m; i++) {
        double tp, tq;
        fw_geometry_vec2 on;
        if (fw_geometry_segment_nearest(p, meet[i], &tp, &on) <= 2 * FW_COINCIDENT_M &&
            fw_geometry_segment_nearest(q, meet[i], &tq, &on) <= 2 * FW_COINCIDENT_M)
            n = add_hit(hit, n, caught(p, tp, meet[i]), caught(q, tq, meet[i]), meet[i]);
    }
    return n;
}
