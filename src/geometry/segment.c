/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"

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
