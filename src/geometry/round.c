/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"
#include <string.h>

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
                !((before->flags | after->flags) & FW_SEGMENT_JOINT);
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
