/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Process bias on exact outlines: lines move along their normal, arcs change their radius. */
#include "geometry/segment.h"

typedef struct junction {        /* what becomes of a vertex */
    fw_geometry_vec2 end, start; /* end of the segment before it, start of the one after it */
    bool round;                  /* joined by an arc about the old vertex through `turn` */
    fw_geometry_vec2 centre;
    double turn;
} junction;

static fw_geometry_vec2 outward(const fw_geometry_segment *s, double t) {
    return vec_scale(-1, vec_left(fw_geometry_segment_tangent(s, t)));
}

/* carrier moved outward by d */
static fw_geometry_segment moved(const fw_geometry_segment *s, double d) {
    fw_geometry_segment m = *s;
    if (s->kind == FW_ARC) {
        m.radius += s->sweep_rad > 0 ? d : -d;
        return m;
    }
    m.a = vec_along(s->a, d, outward(s, 0));
    m.b = vec_along(s->b, d, outward(s, 1));
    return m;
}

/* The moved ends of a joint: it grows by d at both ends along its own line. The ends are ordered
   before computing, so that the two pieces that share the joint get the same doubles. */
static bool slide_joint(const fw_geometry_segment *joint, double d, fw_geometry_vec2 *a,
                        fw_geometry_vec2 *b) {
    bool swap = vec_before(joint->b, joint->a);
    fw_geometry_vec2 low = swap ? joint->b : joint->a, high = swap ? joint->a : joint->b;
    double length = vec_distance(low, high);
    if (joint->kind != FW_LINE || !(length + 2 * d > FW_COINCIDENT_M)) return false;
    fw_geometry_vec2 u = vec_scale(1 / length, vec_sub(high, low));
    fw_geometry_vec2 new_low = vec_along(low, -d, u), new_high = vec_along(high, d, u);
    *a = swap ? new_high : new_low;
    *b = swap ? new_low : new_high;
    return true;
}

/* The moved end of a joint at v whose edges run through it: where the joint's line meets the moved
   edge. Both pieces have that edge; their numbers for it may differ in the last digits, so that the
   way along the joint is rounded to 1e-15 m, a thousandth of what counts as one point. false: they
   meet nowhere near. */
static bool slide_through(const fw_geometry_segment *joint, const fw_geometry_segment *edge,
                          double d, fw_geometry_vec2 v, fw_geometry_vec2 *at) {
    fw_geometry_vec2 u = vec_unit(vec_sub(joint->b, joint->a)), hit[2] = {v, v};
    if (vec_same(v, joint->a)) u = vec_scale(-1, u);
    fw_geometry_segment m = moved(edge, d);
    int n = 1;
    if (m.kind == FW_LINE) {
        fw_geometry_vec2 e = fw_geometry_segment_tangent(&m, 0);
        double sine = vec_cross(u, e);
        if (fabs(sine) < 0.5) return false;
        hit[0] = vec_along(v, vec_cross(vec_sub(m.a, v), e) / sine, u);
    } else
        n = fw_geometry_line_circle(v, u, m.centre, m.radius, hit);
    if (n == 0) return false;
    fw_geometry_vec2 aim = vec_along(v, d, u);
    if (n == 2 && vec_distance(hit[1], aim) < vec_distance(hit[0], aim)) hit[0] = hit[1];
    double way = vec_dot(vec_sub(hit[0], v), u);
    *at = vec_along(v, 1e-15 * round(1e15 * way), u);
    return fabs(way - d) < 0.25 * fabs(d);
}

/* where the moved neighbour meets the edge that leaves the joint's moved end square to the joint:
   the neighbouring piece's own moved edge. Equal to that end when the neighbour is square itself.
 */
static bool meet_joint(const fw_geometry_segment *joint, const fw_geometry_segment *neighbour,
                       double d, fw_geometry_vec2 end, fw_geometry_vec2 *at) {
    fw_geometry_segment m = moved(neighbour, d);
    fw_geometry_vec2 square = vec_left(fw_geometry_segment_tangent(joint, 0)), hit[2];
    *at = end;
    if (m.kind == FW_LINE) {
        fw_geometry_vec2 u = fw_geometry_segment_tangent(&m, 0);
        double off = vec_cross(u, vec_sub(end, m.a)), sine = vec_cross(square, u);
        if (fabs(off) <= FW_COINCIDENT_M) return true;
        if (fabs(sine) < 1e-9) return false;
        *at = vec_along(end, -off / vec_cross(u, square), square);
        return true;
    }
    if (fabs(vec_distance(end, m.centre) - m.radius) <= FW_COINCIDENT_M) return true;
    int n = fw_geometry_line_circle(end, square, m.centre, m.radius, hit);
    if (n == 0) return false;
    *at = n == 2 && vec_distance(hit[1], end) < vec_distance(hit[0], end) ? hit[1] : hit[0];
    return true;
}

/* Corner of two moved segments. With turn w and unit normals n0, n1 the moved lines meet at
   v + d (n0 + n1) / (1 + cos w), d / cos(w/2) away; an opening corner is mitred up to 2 d, beyond
   that joined by an arc; a closing one is intersected. With an arc the carriers are intersected,
   except where the mitre point is on them within 1e-14 m. In: segments, d (m). False: no meeting.
   Test: test_offset.c. */
static bool corner(const fw_geometry_segment *before, const fw_geometry_segment *after, double d,
                   junction *j) {
    fw_geometry_vec2 v = before->b, n0 = outward(before, 1), n1 = outward(after, 0);
    double turn = fw_geometry_corner_turn(before, after), half = cos(0.5 * turn);
    bool opening = turn * d > 0;
    fw_geometry_segment p = moved(before, d), q = moved(after, d);
    *j = (junction){vec_along(v, d, n0), vec_along(v, d, n1), true, v, turn};
    if (half < 0.499999) {
        if (opening) return true;
        if (half < 1e-3) return false;
    }
    fw_geometry_vec2 mitre = vec_along(v, d / half, vec_unit(vec_add(n0, n1)));
    double tangent = d * tan(0.5 * turn), bend = 0;
    if (p.kind == FW_ARC) bend = fmax(bend, 1 / p.radius);
    if (q.kind == FW_ARC) bend = fmax(bend, 1 / q.radius);
    if (0.5 * tangent * tangent * bend > 1e-14) {
        fw_geometry_vec2 hit[2];
        int n = fw_geometry_carrier_meet(&p, &q, hit);
        if (n == 0) return opening;
        mitre =
            n == 2 && vec_distance(hit[1], mitre) < vec_distance(hit[0], mitre) ? hit[1] : hit[0];
        if (opening && vec_distance(mitre, v) > 2 * fabs(d)) return true;
    }
    j->end = j->start = mitre;
    j->round = false;
    return true;
}

static bool is_joint(const fw_geometry_segment *s) {
    return s->flags & FW_SEGMENT_JOINT;
}

static bool plan_vertex(const fw_geometry_segment *before, const fw_geometry_segment *after,
                        double d, junction *j) {
    if (!is_joint(before) && !is_joint(after)) return corner(before, after, d, j);
    *j = (junction){.centre = before->b};
    fw_geometry_vec2 a, b;
    double turn = fw_geometry_corner_turn(before, after);
    if (is_joint(before) && is_joint(after))
        return false; /* two cut lines meet: there is no edge to move */
    if (turn < -0.5 * FW_PI + FW_SMOOTH_RAD)
        return false; /* the neighbouring piece has no room beside this one */
    const fw_geometry_segment *joint = is_joint(before) ? before : after;
    if (joint->flags & FW_SEGMENT_THROUGH) {
        if (!slide_through(joint, joint == before ? after : before, d, before->b, &a)) return false;
        j->end = j->start = a;
        return true;
    }
    if (is_joint(before)) {
        if (!slide_joint(before, d, &a, &b)) return false;
        j->end = b;
        return meet_joint(before, after, d, b, &j->start);
    }
    if (!slide_joint(after, d, &a, &b)) return false;
    j->start = a;
    return meet_joint(after, before, d, a, &j->end);
}

/* the moved segment between its new ends; false when it would vanish or turn round */
static bool respan(const fw_geometry_segment *s, double d, fw_geometry_vec2 a, fw_geometry_vec2 b,
                   fw_geometry_segment *out) {
    *out = is_joint(s) ? *s : moved(s, d);
    out->a = a;
    out->b = b;
    if (s->kind == FW_LINE)
        return vec_dot(vec_sub(b, a), vec_sub(s->b, s->a)) > 0 &&
               vec_distance(a, b) > FW_COINCIDENT_M;
    double start = fw_geometry_vec_angle(vec_sub(s->a, s->centre), vec_sub(a, s->centre));
    double end = fw_geometry_vec_angle(vec_sub(s->b, s->centre), vec_sub(b, s->centre));
    double near = s->sweep_rad - start + end;
    double angle = fw_geometry_vec_angle(vec_sub(a, s->centre), vec_sub(b, s->centre));
    out->sweep_rad = vec_same(a, b) ? near : fw_geometry_angle_near(angle, near);
    return out->sweep_rad * s->sweep_rad > 0 && fabs(out->sweep_rad) <= FW_TURN &&
           fabs(out->sweep_rad) * out->radius > FW_COINCIDENT_M;
}

static fw_status refuse(int *i, int *j, int first, int second) {
    if (i) *i = first;
    if (j) *j = second;
    return FW_GEOMETRY;
}

/* Check first (docs/theory/contours.md): no arc on the hollow side with radius <= |d|, and twice
   |d| less than the least space (growing) or width (shrinking) */
static fw_status check_room(const fw_geometry_contour *contour, double d, int *i, int *j) {
    for (int k = 0; k < contour->count; k++) {
        const fw_geometry_segment *s = &contour->segment[k];
        if (s->kind == FW_ARC && !(s->radius + (s->sweep_rad > 0 ? d : -d) > FW_COINCIDENT_M))
            return refuse(i, j, k, k);
    }
    int p, q;
    double most = 2 * fabs(d) * (1 + 1e-15) + 1e-18; /* a clearance of 2 d is refused */
    if (fw_geometry_contour_clearance_below(contour, d < 0, most, &p, &q) <= 2 * fabs(d))
        return refuse(i, j, p, q);
    return FW_OK;
}

static fw_status build(const fw_geometry_contour *contour, double d, const junction *vertex,
                       fw_geometry_contour *out, int *i, int *j) {
    int n = contour->count, count = 0;
    fw_geometry_segment *segment = out->segment;
    for (int k = 0; k < n; k++) {
        const junction *next = &vertex[(k + 1) % n];
        if (!respan(&contour->segment[k], d, vertex[k].start, next->end, &segment[count++]))
            return refuse(i, j, (k + n - 1) % n, (k + 1) % n);
        if (next->round)
            segment[count++] = (fw_geometry_segment){FW_ARC,       0,       next->end, next->start,
                                                     next->centre, fabs(d), next->turn};
        else if (!vec_same(next->end, next->start))
            segment[count++] =
                (fw_geometry_segment){.kind = FW_LINE, .a = next->end, .b = next->start};
    }
    out->count = count;
    return FW_OK;
}

fw_status fw_geometry_contour_offset(fw_arena *arena, const fw_geometry_contour *contour,
                                     double d_m, fw_geometry_contour *out, int *i, int *j) {
    *out = (fw_geometry_contour){0};
    if (!isfinite(d_m) || !fw_geometry_contour_valid(contour)) return refuse(i, j, -1, -1);
    int n = contour->count;
    fw_geometry_contour made = {fw_arena_raw(arena, 2 * (size_t)n * sizeof(fw_geometry_segment)),
                                n};
    FW_NEED(made.segment);
    if (d_m == 0) {
        for (int k = 0; k < n; k++)
            made.segment[k] = contour->segment[k];
        *out = made;
        return FW_OK;
    }
    FW_TRY(check_room(contour, d_m, i, j));
    fw_mark mark = fw_arena_mark(arena);
    junction *vertex = fw_arena_raw(arena, (size_t)n * sizeof *vertex);
    FW_NEED(vertex);
    for (int k = 0; k < n; k++) {
        int before = (k + n - 1) % n;
        if (!plan_vertex(&contour->segment[before], &contour->segment[k], d_m, &vertex[k]))
            return refuse(i, j, before, k);
    }
    FW_TRY(build(contour, d_m, vertex, &made, i, j));
    fw_arena_rewind(arena, mark);
    *out = made;
    return FW_OK;
}
