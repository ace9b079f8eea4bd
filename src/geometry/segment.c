/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"
#include <string.h>

fw_geometry_vec2 fw_geometry_vec_rotate(fw_geometry_vec2 p, double angle_rad) {
    double c = cos(angle_rad), s = sin(angle_rad);
    return (fw_geometry_vec2){c * p.x - s * p.y, s * p.x + c * p.y};
}

double fw_geometry_vec_angle(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return atan2(vec_cross(p, q), vec_dot(p, q));
}

double fw_geometry_angle_near(double angle_rad, double near_rad) {
    return angle_rad + FW_TURN * round((near_rad - angle_rad) / FW_TURN);
}

/* rotates the nearer end about the centre, so that both ends are met without drift */
int fw_geometry_segment_parts(const fw_geometry_segment *s) {
    const double sweep = s->kind == FW_LINE ? 0 : fabs(s->sweep_rad);
    return 1 + (int)(sweep / 0.2);
}

fw_geometry_vec2 fw_geometry_segment_point(const fw_geometry_segment *s, double t) {
    if (t <= 0) return s->a;
    if (t >= 1) return s->b;
    if (s->kind == FW_LINE)
        return t <= 0.5 ? vec_along(s->a, t, vec_sub(s->b, s->a))
                        : vec_along(s->b, t - 1, vec_sub(s->b, s->a));
    double angle = t <= 0.5 ? t * s->sweep_rad : (t - 1) * s->sweep_rad;
    fw_geometry_vec2 from = t <= 0.5 ? s->a : s->b;
    return vec_add(s->centre, fw_geometry_vec_rotate(vec_sub(from, s->centre), angle));
}

fw_geometry_vec2 fw_geometry_segment_tangent(const fw_geometry_segment *s, double t) {
    if (s->kind == FW_LINE) return vec_unit(vec_sub(s->b, s->a));
    fw_geometry_vec2 at = t <= 0 ? s->a : t >= 1 ? s->b : fw_geometry_segment_point(s, t);
    fw_geometry_vec2 left = vec_left(vec_unit(vec_sub(at, s->centre)));
    return s->sweep_rad > 0 ? left : vec_scale(-1, left);
}

double fw_geometry_segment_length(const fw_geometry_segment *s) {
    return s->kind == FW_LINE ? vec_distance(s->a, s->b) : s->radius * fabs(s->sweep_rad);
}

/* angle run from the arc's start to the direction, 0..2 pi; a hair before the start counts as 0 */
static double run_angle(const fw_geometry_segment *arc, fw_geometry_vec2 direction) {
    double angle = fw_geometry_vec_angle(vec_sub(arc->a, arc->centre), direction);
    if (arc->sweep_rad < 0) angle = -angle;
    double hair = FW_COINCIDENT_M / arc->radius;
    if (angle < 0) angle = angle > -hair ? 0 : angle + FW_TURN;
    return angle;
}

double fw_geometry_segment_parameter(const fw_geometry_segment *s, fw_geometry_vec2 on) {
    double t;
    if (s->kind == FW_LINE) {
        vec_line_foot(s->a, s->b, on, &t);
        return t;
    }
    t = run_angle(s, vec_sub(on, s->centre)) / fabs(s->sweep_rad);
    if (t > 1) /* outside: the nearer end */
        t = vec_distance(on, s->a) < vec_distance(on, s->b) ? 0 : 1;
    return t < 0 ? 0 : t;
}

/* clearly outside of the arc, by two cross products: of the sector when it is less than half a
   turn, else of the sector that is left. False says nothing. */
static bool clearly_outside(const fw_geometry_segment *arc, fw_geometry_vec2 direction) {
    double side = arc->sweep_rad > 0 ? 1 : -1, sweep = fabs(arc->sweep_rad);
    fw_geometry_vec2 u = vec_sub(arc->a, arc->centre), v = vec_sub(arc->b, arc->centre);
    double margin = 1e-9 * arc->radius * (fabs(direction.x) + fabs(direction.y));
    double from_a = side * vec_cross(u, direction), to_b = side * vec_cross(direction, v);
    if (sweep < 3.14) return from_a < -margin || to_b < -margin;
    return sweep > 3.15 && from_a < -margin && to_b < -margin;
}

bool fw_geometry_segment_faces(const fw_geometry_segment *arc, fw_geometry_vec2 direction,
                               double *t) {
    *t = 0;
    if (clearly_outside(arc, direction)) return false;
    double run = run_angle(arc, direction), sweep = fabs(arc->sweep_rad);
    *t = fmin(run / sweep, 1);
    return run <= sweep + FW_COINCIDENT_M / arc->radius;
}

/* Nearest point of a segment: line, foot of the perpendicular clamped to the ends; arc, the radial
   projection c + r (p - c) / |p - c| when the arc faces it, else the nearer end.
   Out: the point; *t. Closed form, error a few ulp. Test: test_distance.c. */
fw_geometry_vec2 fw_geometry_segment_foot(const fw_geometry_segment *s, fw_geometry_vec2 from,
                                          double *t) {
    if (s->kind == FW_LINE) return vec_line_foot(s->a, s->b, from, t);
    fw_geometry_vec2 ray = vec_sub(from, s->centre);
    double length = vec_length(ray);
    if (length > 0 && fw_geometry_segment_faces(s, ray, t))
        return *t <= 0 ? s->a : *t >= 1 ? s->b : vec_along(s->centre, s->radius / length, ray);
    *t = vec_distance(from, s->b) < vec_distance(from, s->a) ? 1 : 0;
    return *t > 0 ? s->b : s->a;
}

double fw_geometry_segment_nearest(const fw_geometry_segment *s, fw_geometry_vec2 from, double *t,
                                   fw_geometry_vec2 *at) {
    double best_t;
    fw_geometry_vec2 best = fw_geometry_segment_foot(s, from, &best_t);
    if (t) *t = best_t;
    if (at) *at = best;
    return vec_distance(from, best);
}

fw_geometry_near fw_geometry_near_of(const fw_geometry_segment *s, double reach) {
    const double less = reach * (1 - 1e-9), more = reach * (1 + 1e-9) + 1e-10, r = s->radius;
    fw_geometry_near n = {.segment = s, .reach = reach};
    if (s->kind == FW_LINE) {
        n.u = vec_sub(s->b, s->a);
        n.square = vec_dot(n.u, n.u);
        n.sure = less * less * n.square, n.far = more * more * n.square;
        return n;
    }
    const double sweep = fabs(s->sweep_rad), hollow = r > more ? r - more : 0;
    const double way = s->sweep_rad > 0 ? 1 : -1;
    n.u = vec_scale(way, vec_sub(s->a, s->centre)), n.v = vec_scale(way, vec_sub(s->b, s->centre));
    n.both = sweep<3.14, n.either = sweep> 3.15;
    n.margin = 1e-9 * r;
    n.far = (r + more) * (r + more), n.within = hollow * hollow;
    n.sure = (r + less) * (r + less), n.sure_within = r > less ? (r - less) * (r - less) : -1;
    return n;
}

/* is the foot of a place between the ends of a line along x? Monotonic in x, so that what lies between two such is one */
static bool beside(const fw_geometry_near *n, double x) {
    const double t = (x - n->segment->a.x) * n->u.x;
    return t >= 0 && t <= n->square;
}

static void ask_row(const fw_geometry_near *n, double from_x, double step, double y, int first,
                    int last, unsigned char *row) {
    for (int i = first; i <= last; i++)
        if (!row[i])
            row[i] = fw_geometry_is_near(n, (fw_geometry_vec2){from_x + (i + 0.5) * step, y});
}

void fw_geometry_near_row(const fw_geometry_near *n, double from_x, double step, double y,
                          int first, int last, unsigned char *row) {
    const fw_geometry_segment *s = n->segment;
    const bool level = s->kind == FW_LINE && s->a.y == s->b.y;
    const double off = n->u.x * (y - s->a.y), square = off * off;
    int from = first, to = last;
    if (level && square > n->far) return;
    if (!level || !(square < n->sure)) from = last + 1;
    while (from <= to && !beside(n, from_x + (from + 0.5) * step))
        from++;
    while (to >= from && !beside(n, from_x + (to + 0.5) * step))
        to--;
    if (to >= from) memset(row + from, 1, (size_t)(to - from) + 1);
    ask_row(n, from_x, step, y, first, from - 1, row);
    ask_row(n, from_x, step, y, to + 1, last, row);
}

/* 0 .. 3: the quarter that a direction lies in, each with its first axis */
static int quarter(fw_geometry_vec2 v) {
    if (v.y >= 0) return v.x > 0 ? 0 : v.y > 0 ? 1 : 2;
    return v.x < 0 ? 2 : 3;
}

/* Ends, and the axes that the arc passes: as many as there are quarters from its start to its end,
   all four where it comes back to the first one over more than half a turn. In: segment (m). Out:
   box; it holds the circle's own points within the rounding. No angle is computed. Test:
   test_segment.c. */
fw_geometry_box fw_geometry_arc_box(const fw_geometry_segment *s, fw_geometry_box box) {
    bool left = s->sweep_rad > 0;
    fw_geometry_vec2 u = vec_sub(left ? s->a : s->b, s->centre),
                     v = vec_sub(left ? s->b : s->a, s->centre);
    if (u.x * v.x > 0 && u.y * v.y > 0 && fabs(s->sweep_rad) <= FW_PI)
        return box; /* within one quarter, as most are */
    int from = quarter(u), to = quarter(v), axes = (to - from) & 3;
    if (axes == 0 && fabs(s->sweep_rad) > FW_PI) axes = 4;
    for (int k = 1; k <= axes; k++)
        switch ((from + k) & 3) {
        case 0:
            box.x1 = fw_greater(box.x1, s->centre.x + s->radius);
            break;
        case 1:
            box.y1 = fw_greater(box.y1, s->centre.y + s->radius);
            break;
        case 2:
            box.x0 = fw_lesser(box.x0, s->centre.x - s->radius);
            break;
        case 3:
            box.y0 = fw_lesser(box.y0, s->centre.y - s->radius);
            break;
        }
    return box;
}

/* Least distance of anything in the box from the arc's whole circle: the box lies between two
   distances from the centre. In: segment, box (m). Out: m, a lower bound, 1e-15 m short of it for
   rounding; 0 of a line. Test: test_segment.c. */
double fw_geometry_segment_clear_of(const fw_geometry_segment *s, const fw_geometry_box *box) {
    if (s->kind == FW_LINE) return 0;
    double x = fw_greater(s->centre.x - box->x0, box->x1 - s->centre.x);
    double y = fw_greater(s->centre.y - box->y0, box->y1 - s->centre.y);
    double far = s->radius - sqrt(x * x + y * y);
    x = fw_greater(fw_greater(box->x0 - s->centre.x, s->centre.x - box->x1), 0);
    y = fw_greater(fw_greater(box->y0 - s->centre.y, s->centre.y - box->y1), 0);
    double near = sqrt(x * x + y * y) - s->radius;
    return fw_greater(fw_greater(far, near) - 1e-11, 0); /* ends may be off the circle by that */
}

fw_geometry_segment fw_geometry_segment_reverse(const fw_geometry_segment *s) {
    fw_geometry_segment r = *s;
    r.a = s->b;
    r.b = s->a;
    r.sweep_rad = s->kind == FW_ARC ? -s->sweep_rad : 0;
    return r;
}

fw_geometry_segment fw_geometry_segment_cut(const fw_geometry_segment *s, double t0,
                                            fw_geometry_vec2 p0, double t1, fw_geometry_vec2 p1) {
    fw_geometry_segment r = *s;
    r.a = p0;
    r.b = p1;
    if (t0 <= 0 && t1 >= 1 && vec_same(p0, s->a) && vec_same(p1, s->b)) return r;
    if (s->kind == FW_ARC)
        r.sweep_rad = fw_geometry_angle_near(
            fw_geometry_vec_angle(vec_sub(p0, s->centre), vec_sub(p1, s->centre)),
            s->sweep_rad * (t1 - t0));
    return r;
}

double fw_geometry_corner_turn(const fw_geometry_segment *before,
                               const fw_geometry_segment *after) {
    return fw_geometry_vec_angle(fw_geometry_segment_tangent(before, 1),
                                 fw_geometry_segment_tangent(after, 0));
}

/* Is an end within the slack of the circle? |d - r| = |d^2 - r^2| / (d + r) is below half of it
   wherever |d^2 - r^2| <= slack r / 2; only what is farther off, and huge circles, take a root. */
static bool on_circle(const fw_geometry_segment *s, fw_geometry_vec2 end, double slack) {
    fw_geometry_vec2 ray = vec_sub(end, s->centre);
    double square = vec_dot(ray, ray), r = s->radius;
    if (r < 1e3 && fabs(square - r * r) <= 0.5 * slack * r) return true;
    return fabs(sqrt(square) - r) <= slack;
}

bool fw_geometry_segment_valid(const fw_geometry_segment *s) {
    if (!vec_finite(s->a) || !vec_finite(s->b)) return false;
    if (s->kind == FW_LINE) return !vec_same(s->a, s->b);
    double sweep = fabs(s->sweep_rad);
    /* ends may lie off the circle by the tolerance each operation adds */
    double slack = 16 * FW_COINCIDENT_M;
    return s->kind == FW_ARC && vec_finite(s->centre) && isfinite(s->radius) && s->radius > 0 &&
           sweep > 0 && sweep <= FW_TURN * (1 + 1e-15) && on_circle(s, s->a, slack) &&
           on_circle(s, s->b, slack);
}

bool fw_geometry_contour_valid(const fw_geometry_contour *contour) {
    if (contour->count < 1 || !contour->segment) return false;
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i], *next = s + 1;
        if (i + 1 == contour->count) next = contour->segment;
        if (!fw_geometry_segment_valid(s) || !vec_same(s->b, next->a)) return false;
    }
    return contour->count > 1 || contour->segment[0].kind == FW_ARC;
}

/* Where two lines or arcs meet. A contact within the coincidence tolerance is one touch, at the
   foot of the centre: that point is well conditioned where the two crossings of a grazing line are
   not. */

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
