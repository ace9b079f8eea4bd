/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Process bias on exact outlines: lines move along their normal, arcs change their radius. */
#include "geometry/segment.h"
#include <string.h>

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

fw_geometry_segment fw_geometry_segment_moved(const fw_geometry_segment *s, double d) {
    fw_geometry_segment m = moved(s, d);
    if (s->kind == FW_LINE) return m;
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
    return way * d > 0 && fabs(way) < 2.1 * fabs(d); /* d/sine, and what an arc bends meanwhile */
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
   |d| less than the least space (growing) or width (shrinking), which is clear_m at least */
static fw_status check_room(const fw_geometry_contour *contour, double d, double clear_m, int *i,
                            int *j) {
    for (int k = 0; k < contour->count; k++) {
        const fw_geometry_segment *s = &contour->segment[k];
        if (s->kind == FW_ARC && !(s->radius + (s->sweep_rad > 0 ? d : -d) > FW_COINCIDENT_M))
            return refuse(i, j, k, k);
    }
    int p, q;
    double most = 2 * fabs(d) * (1 + 1e-15) + 1e-18; /* a clearance of 2 d is refused */
    if (clear_m > most) return FW_OK;
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
    return fw_geometry_contour_offset_clear(arena, contour, d_m, 0.0, out, i, j);
}

fw_status fw_geometry_contour_offset_clear(fw_arena *arena, const fw_geometry_contour *contour,
                                           double d_m, double clear_m, fw_geometry_contour *out,
                                           int *i, int *j) {
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
    FW_TRY(check_room(contour, d_m, clear_m, i, j));
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

static const double MOST_SKIPPED_RAD = 2.0943951023931957; /* 120 degrees */

typedef struct fillet {
    bool wanted;
    double radius_m; /* asked for */
    double factor;   /* 1/4..1 of it that fits */
    double scale;    /* of the factor, found in this pass */
    double side;     /* +1 convex: the centre is on the left; -1 concave */
    fw_geometry_segment arc;
    double t_before, t_after;       /* where the arc leaves and meets the neighbours */
    double trim_before, trim_after; /* share of each neighbour that is cut away */
} fillet;

/* the segment's carrier moved by r to one side; false when an arc would vanish */
static bool beside(const fw_geometry_segment *s, double side, double r,
                   fw_geometry_segment *moved) {
    *moved = *s;
    if (s->kind == FW_ARC) {
        moved->radius -= (s->sweep_rad > 0 ? side : -side) * r;
        return moved->radius > FW_COINCIDENT_M;
    }
    fw_geometry_vec2 shift = vec_scale(side * r, vec_left(fw_geometry_segment_tangent(s, 0)));
    moved->a = vec_add(s->a, shift);
    moved->b = vec_add(s->b, shift);
    return true;
}

/* where the rounding circle about `centre` touches s; the parameter of a line is not clamped */
static bool touch(const fw_geometry_segment *s, fw_geometry_vec2 centre, double *t,
                  fw_geometry_vec2 *at) {
    if (s->kind == FW_LINE) {
        fw_geometry_vec2 along = vec_sub(s->b, s->a);
        *t = vec_dot(vec_sub(centre, s->a), along) / vec_dot(along, along);
        *at = vec_along(s->a, *t, along);
        return true;
    }
    fw_geometry_vec2 u = vec_unit(vec_sub(centre, s->centre));
    *at = vec_along(s->centre, s->radius, u);
    return fw_geometry_segment_faces(s, u, t);
}

/* Rounding arc of radius r at the corner of two segments: its centre is a common point of the two
   carriers moved by r to the inner side, the one nearest the corner; it touches at the feet.
   For two lines this cuts r tan(turn / 2) off each. In: segments (m). Out: arc, parameters.
   False: no such circle touches both. Error 1e-18 m / sin(turn). Test: test_round.c. */
static bool fit(const fw_geometry_segment *before, const fw_geometry_segment *after, fillet *f) {
    double r = f->radius_m * f->factor, least = HUGE_VAL;
    fw_geometry_segment p, q;
    fw_geometry_vec2 centre[2];
    if (!beside(before, f->side, r, &p) || !beside(after, f->side, r, &q)) return false;
    int n = fw_geometry_carrier_meet(&p, &q, centre);
    for (int i = 0; i < n; i++) {
        double t0, t1, away = vec_distance(centre[i], before->b);
        fw_geometry_vec2 a, b;
        if (!(away < least) || !touch(before, centre[i], &t0, &a) ||
            !touch(after, centre[i], &t1, &b))
            continue;
        double sweep = fw_geometry_vec_angle(vec_sub(a, centre[i]), vec_sub(b, centre[i]));
        if (sweep * f->side <= 0) continue;
        least = away;
        f->arc = (fw_geometry_segment){FW_ARC, 0, a, b, centre[i], r, sweep};
        f->t_before = t0;
        f->t_after = t1;
    }
    f->trim_before = 1 - f->t_before;
    f->trim_after = f->t_after;
    return least < HUGE_VAL;
}

/* A turn by its sine and cosine: no less than FW_SMOOTH_RAD? The angle itself is asked for only
   where it is about that. */
static bool is_corner(double sine, double cosine) {
    if (cosine <= 0 || fabs(sine) >= 2 * FW_SMOOTH_RAD * cosine) return true;
    return fabs(sine) > 0.5 * FW_SMOOTH_RAD * cosine && fabs(atan2(sine, cosine)) >= FW_SMOOTH_RAD;
}

static void plan_corner(const fw_geometry_segment *before, const fw_geometry_segment *after,
                        double convex_m, double concave_m, fillet *f) {
    fw_geometry_vec2 u = fw_geometry_segment_tangent(before, 1),
                     v = fw_geometry_segment_tangent(after, 0);
    double sine = vec_cross(u, v), cosine = vec_dot(u, v);
    bool left = sine > 0 || (sine == 0 && !signbit(sine) && cosine < 0); /* half a turn */
    *f = (fillet){.factor = 1, .scale = 1, .side = left ? 1 : -1};
    f->radius_m = left ? convex_m : concave_m;
    f->wanted = is_corner(sine, cosine) && f->radius_m > FW_COINCIDENT_M &&
                !((before->flags | after->flags) & FW_SEGMENT_JOINT) &&
                !(before->flags & after->flags & FW_SEGMENT_DRAWN);
}

/* is segment s too short for the rounding circles at its two ends, but one circle of that radius
   touches p before and q behind it? */
static bool rolls_past(const fw_geometry_segment *p, const fw_geometry_segment *s,
                       const fw_geometry_segment *q, double convex_m, double concave_m) {
    fillet first, second, both;
    if (fw_geometry_segment_length(s) > fmax(convex_m, concave_m))
        return false; /* of either corner */
    plan_corner(p, s, convex_m, concave_m, &first);
    plan_corner(s, q, convex_m, concave_m, &second);
    plan_corner(p, q, convex_m, concave_m, &both);
    if (!first.wanted || !second.wanted || !both.wanted) return false;
    if (first.side != second.side || first.side != both.side) return false;
    double turn = fabs(fw_geometry_corner_turn(p, s)) + fabs(fw_geometry_corner_turn(s, q));
    if (turn > MOST_SKIPPED_RAD || fw_geometry_segment_length(s) > first.radius_m) return false;
    if (fit(p, s, &first) && fit(s, q, &second) && first.trim_after + second.trim_before <= 1)
        return false;
    return fit(p, q, &both) && both.t_before > 0 && both.t_before <= 1 && both.t_after >= 0 &&
           both.t_after < 1;
}

/* A disc of the radius that rolls along the outline passes over a step that is shorter than it: the
   segment is left out, and the rounding touches its neighbours. For lines that is so exactly when
   r (tan(turn1 / 2) + tan(turn2 / 2)) exceeds its length; to shrink both radii instead would leave
   a tip or notch sharper than any rule of a mask allows. Only up to turns of 120 degrees together:
   beyond, much of a tip would go. Count of those kept. Test: test_round.c. */
static int leave_out(const fw_geometry_contour *contour, double convex_m, double concave_m,
                     fw_geometry_segment *kept) {
    int n = contour->count, i = 0;
    memcpy(kept, contour->segment, (size_t)n * sizeof *kept);
    for (int since = 0; since < n && n > 3; since++) {
        i = i < n ? i : 0;
        const fw_geometry_segment *p = &kept[(i + n - 1) % n], *q = &kept[(i + 1) % n];
        if (rolls_past(p, &kept[i], q, convex_m, concave_m)) {
            memmove(kept + i, kept + i + 1, (size_t)(n - i - 1) * sizeof *kept);
            n--;
            since = -1;
        } else {
            i++;
        }
    }
    return n;
}

/* factor for the radii at the two ends of segment s, whose roundings cut the share `cut` of it
   away. Either all of it is used up (the two arcs then share a point), or a whole edge stays: a
   rest of nanometres would be a sliver on the mask, where chords are some 200 nm and longer. The
   trim of a corner grows linearly with its radius between lines, else about so: the next pass looks
   again. Test: test_round.c. */
static double scale_for(const fw_geometry_segment *s, double cut) {
    const double slack = 1e-12, rest_m = 200e-9;
    if (cut > 1 + slack) return 1 / cut;
    double length = fw_geometry_segment_length(s), rest = (1 - cut) * length;
    if (rest >= rest_m || rest <= FW_COINCIDENT_M || length < 8 * rest_m) return 1;
    return (1 - 2 * rest_m / length) / cut;
}

/* one pass: fits all corners, shrinks those that do not fit; index of a corner that got too small,
   or -1. corner i is where segment i ends. */
static int shrink(const fw_geometry_contour *contour, fillet *f, bool *changed) {
    const double slack = 1e-12;
    int n = contour->count;
    *changed = false;
    for (int i = 0; i < n; i++)
        while (f[i].wanted && !fit(&contour->segment[i], &contour->segment[(i + 1) % n], &f[i])) {
            f[i].factor *= 0.95;
            *changed = true;
            if (f[i].factor < 0.25) return i;
        }
    for (int i = 0; i < n; i++) {
        fillet *start = &f[(i + n - 1) % n], *end = &f[i];
        double cut = (start->wanted ? start->trim_after : 0) + (end->wanted ? end->trim_before : 0);
        double scale = scale_for(&contour->segment[i], cut);
        if (scale == 1) continue;
        *changed = true;
        start->scale = fmin(start->scale, scale);
        end->scale = fmin(end->scale, scale);
    }
    for (int i = 0; i < n; i++) {
        f[i].factor *= f[i].scale;
        f[i].scale = 1;
        if (f[i].wanted && f[i].factor < 0.25 * (1 - slack)) return i;
    }
    return -1;
}

static int assemble(const fw_geometry_contour *contour, fillet *f, fw_geometry_segment *out) {
    int n = contour->count, count = 0;
    /* a segment that is used up: the two arcs beside it share one point */
    for (int i = 0; i < n; i++) {
        fillet *start = &f[(i + n - 1) % n], *end = &f[i];
        if (!start->wanted || !end->wanted) continue;
        if ((end->t_before - start->t_after) * fw_geometry_segment_length(&contour->segment[i]) <=
            FW_COINCIDENT_M)
            end->arc.a = start->arc.b;
    }
    for (int i = 0; i < n; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        const fillet *start = &f[(i + n - 1) % n], *end = &f[i];
        fw_geometry_vec2 a = start->wanted ? start->arc.b : s->a,
                         b = end->wanted ? end->arc.a : s->b;
        double ta = start->wanted ? start->t_after : 0, tb = end->wanted ? end->t_before : 1;
        if (!vec_same(a, b) || (ta <= 0 && tb >= 1))
            out[count++] = fw_geometry_segment_cut(s, ta, a, tb, b);
        if (end->wanted) out[count++] = end->arc;
    }
    return count;
}

fw_status fw_geometry_contour_round(fw_arena *arena, const fw_geometry_contour *contour,
                                    double convex_m, double concave_m, fw_geometry_contour *out,
                                    fw_geometry_vec2 *where) {
    *out = (fw_geometry_contour){0};
    if (!isfinite(convex_m) || !isfinite(concave_m) || convex_m < 0 || concave_m < 0 ||
        !fw_geometry_contour_valid(contour)) {
        if (where) *where = (fw_geometry_vec2){0, 0};
        return FW_GEOMETRY;
    }
    int n = contour->count, bad = -1;
    fw_geometry_segment *segment = fw_arena_raw(arena, 2 * (size_t)n * sizeof *segment);
    FW_NEED(segment);
    fw_mark mark = fw_arena_mark(arena);
    fw_geometry_segment *kept = fw_arena_raw(arena, (size_t)n * sizeof *kept);
    FW_NEED(kept);
    n = leave_out(contour, convex_m, concave_m, kept);
    fw_geometry_contour long_ones = {kept, n};
    contour = &long_ones;
    fillet *f = fw_arena_raw(arena, (size_t)n * sizeof *f);
    FW_NEED(f);
    for (int i = 0; i < n; i++)
        plan_corner(&contour->segment[i], &contour->segment[(i + 1) % n], convex_m, concave_m,
                    &f[i]);
    bool changed = true;
    for (int pass = 0; pass < 200 && changed && bad < 0; pass++)
        bad = shrink(contour, f, &changed);
    for (int i = 0; changed && bad < 0 && i < n; i++)
        if (f[i].factor < 1) bad = i;
    if (bad < 0)
        *out = (fw_geometry_contour){segment, assemble(contour, f, segment)};
    else if (where)
        *where = contour->segment[bad].b;
    fw_arena_rewind(arena, mark);
    return bad < 0 ? FW_OK : FW_GEOMETRY;
}
