/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/segment.h"
#include "base/constants.h"
#include "layout/draw.h"
#include <math.h>

enum { MOST_CROSSINGS = 64, MOST_REACHES = 256, RADII = 400, COARSE = 16 };

typedef struct crossing { /* of an outline with a circle, from its centre */
    fw_geometry_vec2 at;
    double angle_rad; /* NaN: not computed yet */
} crossing;

static int add_crossing(crossing *list, int n, fw_geometry_vec2 p) {
    if (n < MOST_CROSSINGS) list[n++] = (crossing){p, (double)NAN};
    return n;
}

/* p is on the arc's circle. By cross products with the ends; by the angle where these say nothing
 */
static bool on_arc(const fw_geometry_segment *s, fw_geometry_vec2 p) {
    fw_geometry_vec2 a = fw_sub(s->a, s->centre), b = fw_sub(p, s->centre),
                     c = fw_sub(s->b, s->centre);
    double side = s->sweep_rad > 0.0 ? 1.0 : -1.0, sweep = fabs(s->sweep_rad);
    double from = side * (a.x * b.y - a.y * b.x), to = side * (b.x * c.y - b.y * c.x);
    double margin = 1e-9 * s->radius * s->radius;
    if (sweep < 3.14) {
        if (from < -margin || to < -margin) return false;
        if (from > margin && to > margin) return true;
    } else if (sweep > 3.15) {
        if (from > margin || to > margin) return true;
        if (from < -margin && to < -margin) return false;
    }
    double turn = atan2(a.x * b.y - a.y * b.x, fw_dot(a, b));
    if (s->sweep_rad > 0.0 && turn < 0.0) turn += 2.0 * FW_PI;
    if (s->sweep_rad < 0.0 && turn > 0.0) turn -= 2.0 * FW_PI;
    return fabs(turn) <= fabs(s->sweep_rad);
}

typedef struct reach { /* distances from a centre between which a segment lies */
    const fw_geometry_segment *segment;
    double least, most;
    /* of its crossings with any circle about the centre: a line begins at `from`, runs along
       `along`, whose products these are; an arc's centre is at `from`, in the direction of `along`
     */
    fw_geometry_vec2 from, along;
    double from2, dot, along2;   /* of an arc: distance of its centre, squared; the distance; r^2 */
    double middle_rad, half_rad; /* directions in which it is seen from the centre, or more */
} reach;
typedef struct near_part {    /* of an outline, within a radius about a centre */
    reach item[MOST_REACHES]; /* by where they begin */
    int count;
} near_part;
typedef struct active { /* those that circles of a growing radius may cross */
    const reach *item[MOST_REACHES];
    int count, next;
} active;

static reach reach_of(const fw_geometry_segment *s, fw_geometry_vec2 w, double least, double most) {
    reach r = {.segment = s, .least = least, .most = most};
    if (s->kind == FW_LINE) {
        r.from = fw_sub(s->a, w);
        r.along = fw_sub(s->b, s->a);
        r.from2 = fw_dot(r.from, r.from);
        r.dot = fw_dot(r.from, r.along);
        r.along2 = fw_dot(r.along, r.along);
    } else {
        r.from = fw_sub(s->centre, w);
        double far = r.dot = fw_norm(r.from);
        r.along = fw_v(r.from.x / far, r.from.y / far);
        r.from2 = far * far;
        r.along2 = s->radius * s->radius;
    }
    return r;
}

/* half of the whole turn: in every direction, for all that is known */
static void see(reach *r, fw_geometry_vec2 w) {
    const fw_geometry_segment *s = r->segment;
    r->middle_rad = 0.0;
    r->half_rad = FW_PI;
    if (s->kind == FW_LINE) {
        fw_geometry_vec2 a = fw_sub(s->a, w), b = fw_sub(s->b, w);
        double turn = atan2(a.x * b.y - a.y * b.x, fw_dot(a, b));
        if (fabs(turn) > 3.0) return; /* through the centre, nearly */
        r->middle_rad = atan2(a.y, a.x) + 0.5 * turn;
        r->half_rad = 0.5 * fabs(turn);
    } else if (r->dot > 1.01 * s->radius) {
        r->middle_rad = atan2(r->from.y, r->from.x);
        r->half_rad = asin(s->radius / r->dot);
    }
}

/* is its box beyond a radius about a point? Of an arc that of its whole circle first, which needs no angles */
static bool out_of_circle(const fw_geometry_segment *s, const fw_geometry_box *at,
                          double radius_m) {
    const double r = s->kind == FW_ARC ? s->radius : 0.0;
    if (s->kind == FW_ARC &&
        (s->centre.x - r - at->x1 > radius_m || at->x0 - s->centre.x - r > radius_m ||
         s->centre.y - r - at->y1 > radius_m || at->y0 - s->centre.y - r > radius_m))
        return true;
    const fw_geometry_box own = fw_segment_box(s);
    return fw_box_beyond(at, &own, radius_m);
}

/* from segment `first` on; returns where to go on, or the number of segments */
static int find_near(const fw_geometry_contour *c, int first, fw_geometry_vec2 w, double radius_m,
                     near_part *near) {
    const fw_geometry_box at = {w.x, w.y, w.x, w.y};
    near->count = 0;
    for (int i = first; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (out_of_circle(s, &at, radius_m + 1e-8)) continue;
        double least = fw_geometry_segment_nearest(s, w, NULL, NULL) - 1e-9;
        if (least > radius_m) continue;
        if (near->count == MOST_REACHES) return i;
        double a = fw_norm(fw_sub(s->a, w)), b = fw_norm(fw_sub(s->b, w)), far = fmax(a, b);
        if (s->kind == FW_ARC) far = fw_norm(fw_sub(s->centre, w)) + s->radius;
        int k = near->count++;
        for (; k > 0 && near->item[k - 1].least > least; k--)
            near->item[k] = near->item[k - 1];
        near->item[k] = reach_of(s, w, least, far + 1e-9);
    }
    return c->count;
}

/* radius q is larger than ever before */
static void advance(active *a, const near_part *near, double q) {
    int n = 0;
    for (int i = 0; i < a->count; i++)
        if (q <= a->item[i]->most) a->item[n++] = a->item[i];
    for (; a->next < near->count && q >= near->item[a->next].least; a->next++)
        if (q <= near->item[a->next].most) a->item[n++] = &near->item[a->next];
    a->count = n;
}

/* where an outline crosses the circle of radius q about w */
static int crossings(const active *now, fw_geometry_vec2 w, double q, crossing *list) {
    int n = 0;
    for (int i = 0; i < now->count; i++) {
        const reach *r = now->item[i];
        const fw_geometry_segment *s = r->segment;
        if (s->kind == FW_LINE) {
            double dd = r->along2, b = r->dot, in = b * b - dd * (r->from2 - q * q);
            if (in < 0.0 || dd <= 0.0) continue;
            double root = sqrt(in);
            for (int sign = -1; sign <= 1; sign += 2) {
                double t = (-b + sign * root) / dd;
                if (t >= 0.0 && t <= 1.0) n = add_crossing(list, n, fw_add(r->from, t, r->along));
            }
        } else {
            double far = r->dot;
            if (far < 1e-12) continue; /* concentric: never crosses */
            double x = (r->from2 + q * q - r->along2) / (2.0 * far), y2 = q * q - x * x;
            if (y2 < 0.0) continue;
            fw_geometry_vec2 e = r->along, f = fw_left(e);
            double root = sqrt(y2);
            for (int sign = -1; sign <= 1; sign += 2) {
                fw_geometry_vec2 p = fw_add(fw_v(x * e.x, x * e.y), sign * root, f);
                if (on_arc(s, fw_add(w, 1.0, p))) n = add_crossing(list, n, p);
            }
        }
    }
    return n;
}

/* |angle| less whole turns, of an angle between -2 pi and 2 pi; the subtraction is exact */
static double turned_least(double angle) {
    double size = fabs(angle);
    return size <= FW_PI ? size : 2.0 * FW_PI - size;
}

static double angle_of(crossing *c) {
    if (isnan(c->angle_rad)) c->angle_rad = atan2(c->at.y, c->at.x);
    return c->angle_rad;
}

/* Over every step-th circle. Angles are computed only of crossings that by their cosine may be
   nearer than all before. */
static double least_rotation(const near_part *p, const near_part *q, fw_geometry_vec2 w,
                             double radius_m, int step) {
    crossing a[MOST_CROSSINGS], b[MOST_CROSSINGS];
    active of_p = {.count = 0}, of_q = {.count = 0};
    double least = FW_PI, cosine = -2.0;
    for (int k = step; k <= RADII; k += step) {
        double circle = radius_m * k / RADII;
        advance(&of_p, p, circle);
        advance(&of_q, q, circle);
        if (of_p.count == 0 || of_q.count == 0) continue;
        int na = crossings(&of_p, w, circle, a);
        int nb = na ? crossings(&of_q, w, circle, b) : 0;
        for (int i = 0; i < na; i++)
            for (int j = 0; j < nb; j++) {
                double here = fw_dot(a[i].at, b[j].at) / (circle * circle);
                if (here < cosine - 1e-9) continue;
                cosine = fmax(cosine, here);
                least = fmin(least, turned_least(angle_of(&a[i]) - angle_of(&b[j])));
            }
    }
    return least;
}

/* can two edges be crossed by one circle at directions no more than `angle` apart? */
static bool may_be_near(const reach *a, const reach *b, double angle) {
    if (a->least > b->most || b->least > a->most) return false;
    double between = fabs(a->middle_rad - b->middle_rad); /* below 5 pi */
    while (between > FW_PI)
        between = fabs(between - 2.0 * FW_PI);
    return between - a->half_rad - b->half_rad <= angle;
}

/* Leaves out of both lists what no edge of the other one is near enough to. The margin is far more
   than the error of a crossing, some 1e-8 rad where a circle touches. */
static void leave_far_out(near_part *p, near_part *q, fw_geometry_vec2 w, double least) {
    const double margin_rad = 1e-3;
    bool near_q[MOST_REACHES] = {false};
    int n = 0;
    for (int i = 0; i < p->count; i++)
        see(&p->item[i], w);
    for (int j = 0; j < q->count; j++)
        see(&q->item[j], w);
    for (int i = 0; i < p->count; i++) {
        bool near = false;
        for (int j = 0; j < q->count; j++)
            if ((!near || !near_q[j]) && may_be_near(&p->item[i], &q->item[j], least + margin_rad))
                near = near_q[j] = true;
        if (near) p->item[n++] = p->item[i];
    }
    p->count = n;
    n = 0;
    for (int j = 0; j < q->count; j++)
        if (near_q[j]) q->item[n++] = q->item[j];
    q->count = n;
}

/* least angle about w between an edge of p and an edge of q, over 400 circles up to radius_m: one
   of the two bodies can turn by it before the outlines touch. A few of the circles bound it; edges
   that lie farther apart than that, seen from w, are left out of the others. Error: what lies
   between two circles (0.25 % of radius_m). Cost: 25 times the edges of p and q within radius_m,
   400 times those that may be the nearest, and every pair once.
   docs/theory/layout.md, section 3; test_layout.c free_rotation_of_two_sectors */
double fw_layout_free_rotation(fw_geometry_vec2 w, const fw_geometry_contour *p,
                               const fw_geometry_contour *q, double radius_m) {
    near_part of_p, of_q;
    double least = FW_PI;
    for (int i = 0, next = p->count; i < p->count; i = next) {
        for (int j = 0; j < q->count;) {
            next = find_near(p, i, w, radius_m, &of_p);
            j = find_near(q, j, w, radius_m, &of_q);
            least = fmin(least, least_rotation(&of_p, &of_q, w, radius_m, COARSE));
            leave_far_out(&of_p, &of_q, w, least);
            least = fmin(least, least_rotation(&of_p, &of_q, w, radius_m, 1));
        }
    }
    return least;
}

/* What a corner that closes as its edges move by d takes of either of them; 0 where it opens, and along a joint, which
   stays. Exact between lines, with an arc to d^2/2R. */
static double taken_by(const fw_geometry_segment *before, const fw_geometry_segment *after,
                       double d) {
    const double turn = fw_geometry_corner_turn(before, after);
    if ((before->flags | after->flags) & FW_SEGMENT_JOINT) return 0.0;
    return turn * d < 0.0 && fabs(turn) < 3.0 ? fabs(d) * tan(0.5 * fabs(turn)) : 0.0;
}

/* What circles about w may cross of an outline whose edges stand out by d: each edge moved along its normal, a joint
   where it is, and an arc of radius |d| about every corner that d opens. */
static fw_status stand_out(fw_arena *arena, const fw_geometry_contour *c, fw_geometry_vec2 w,
                           double radius_m, double d, fw_geometry_contour *out) {
    const fw_geometry_box at = {w.x, w.y, w.x, w.y};
    *out = (fw_geometry_contour){
        .segment = fw_arena_array(arena, fw_geometry_segment, 2 * (size_t)c->count)};
    FW_NEED(out->segment);
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i], *next = &c->segment[(i + 1) % c->count],
                                  *last = &c->segment[(i + c->count - 1) % c->count];
        if (fw_box_gap(at, fw_segment_box(s)) > radius_m + fabs(d)) continue;
        const bool joint = s->flags & FW_SEGMENT_JOINT;
        const fw_geometry_segment moved = joint ? *s : fw_geometry_segment_moved(s, d);
        const double whole = fw_geometry_segment_length(&moved),
                     turn = fw_geometry_corner_turn(s, next);
        const double from = taken_by(last, s, d) / whole, to = 1.0 - taken_by(s, next, d) / whole;
        if (from < to && (s->kind == FW_LINE || moved.radius > 0.0))
            out->segment[out->count++] =
                fw_geometry_segment_cut(&moved, from, fw_geometry_segment_point(&moved, from), to,
                                        fw_geometry_segment_point(&moved, to));
        if (joint || (next->flags & FW_SEGMENT_JOINT) || !(turn * d > 0.0) ||
            fabs(turn) < FW_SMOOTH_RAD)
            continue;
        const fw_geometry_segment after = fw_geometry_segment_moved(next, d);
        out->segment[out->count++] = (fw_geometry_segment){.kind = FW_ARC,
                                                           .a = moved.b,
                                                           .b = after.a,
                                                           .centre = s->b,
                                                           .radius = fabs(d),
                                                           .sweep_rad = turn};
    }
    return FW_OK;
}

fw_status fw_layout_free_rotation_made(fw_arena *arena, const fw_layout_hinge_layout *h,
                                       double out_m, double *free_rad) {
    const double radius_m = 4.0 * h->keep_out_m;
    fw_geometry_contour p, q;
    FW_TRY(stand_out(arena, &h->solid[0], h->centre, radius_m, out_m, &p));
    FW_TRY(stand_out(arena, &h->solid[1], h->centre, radius_m, out_m, &q));
    *free_rad = fw_layout_free_rotation(h->centre, &p, &q, radius_m);
    return FW_OK;
}

/* smallest gap that was asked for between two bodies; else the least space */
static double allowed(const fw_layout_drawing *d, int a, int b) {
    double limit = fw_layout_rule.least_space_m;
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_device_revolute *t = &d->device->revolute[j];
        double gap = d->device->flexure[t->flexure].gap_m;
        bool these = (t->body_a == a && t->body_b == b) || (t->body_a == b && t->body_b == a);
        if (these && gap > 0.0) limit = fmin(limit, gap);
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_device_comb *c = d->comb[i].comb;
        bool these = (a == FW_ISLAND && c->body_b == b) || (b == FW_ISLAND && c->body_b == a);
        if (these && !d->comb[i].off) limit = fmin(limit, c->gap_m * (1.0 - 1e-6));
    }
    return limit;
}

typedef struct part {
    int body;
    int joint;         /* a flexure; FW_NONE: something else */
    const char *label; /* NULL of a flexure */
    const fw_geometry_contour *contour;
    fw_geometry_box box;
} part;

/* the two with what both cover; where edges nearly coincide that is not known */
static fw_status keep_fault(fw_layout_drawing *d, const part *p, const part *q, double far,
                            fw_geometry_vec2 at) {
    enum { MOST_OVERLAPS = 40 };
    fw_layout_fault fault = {.body = {p->body, q->body}, .nbody = 2, .at = at};
    const fw_geometry_region a = {(fw_geometry_contour *)p->contour, 1},
                             b = {(fw_geometry_contour *)q->contour, 1};
    if (p->joint != FW_NONE) {
        fault.joint[fault.njoint++] = p->joint;
        fault.body[0] = q->body, fault.nbody = 1;
    }
    if (far <= 0.0 && d->layout->nfault < MOST_OVERLAPS) {
        fw_status status =
            fw_geometry_region_boolean(d->arena, &a, &b, FW_INTERSECTION, &fault.overlap);
        if (status != FW_OK && status != FW_GEOMETRY) return status;
        if (status == FW_GEOMETRY) fault.overlap = (fw_geometry_region){NULL, 0};
    }
    return fw_layout_fault_keep(d, fault);
}

static fw_status tell(fw_layout_drawing *d, const part *p, const part *q, double far,
                      fw_geometry_vec2 at, double limit) {
    char a[32], b[32], x[32], y[32];
    const char *label = p->label;
    if (p->joint != FW_NONE)
        label = fw_arena_printf(d->arena, "flexure of %s%s",
                                FW_NAMED("hinge", d->device->revolute[p->joint].id));
    FW_NEED(label);
    FW_NEED(q->label);
    fw_diag_error(d->diags, 120, fw_layout_body_place(d, p->body >= 0 ? p->body : q->body),
                  far > 0.0
                      ? "%s and %s are only %s um apart at (%s, %s) um; parts that move keep "
                        "%s um (layout rule): move the hinges or make bars narrower"
                      : "%s and %s overlap (%s um apart) at (%s, %s) um; parts that move keep "
                        "%s um (layout rule): move the hinges or make bars narrower",
                  label, q->label, fw_layout_um(a, far), fw_layout_um(x, at.x),
                  fw_layout_um(y, at.y), fw_layout_um(b, limit));
    return keep_fault(d, p, q, far, at);
}

static bool holds(const part *outer, const part *inner) {
    fw_geometry_vec2 p = inner->contour->segment[0].a;
    fw_geometry_box b = outer->box;
    return p.x >= b.x0 && p.x <= b.x1 && p.y >= b.y0 && p.y <= b.y1 &&
           fw_geometry_contour_contains(outer->contour, p);
}

/* What is farther apart than the rule and the least gap found so far changes nothing. */
static fw_status check_pair(fw_layout_drawing *d, const part *p, const part *q, bool *bad) {
    double *narrowest = &d->layout->narrowest_gap_m, gap = fw_box_gap(p->box, q->box);
    if (gap >= fmax(fw_layout_rule.least_space_m, *narrowest))
        return FW_OK; /* no rule asks for more */
    double limit = allowed(d, p->body, q->body);
    fw_geometry_vec2 at_p = fw_v(0.0, 0.0);
    double far = fw_geometry_contour_distance_below(p->contour, q->contour, fmax(limit, *narrowest),
                                                    &at_p, NULL);
    if (far > 0.0 && (holds(p, q) || holds(q, p))) far = 0.0; /* one inside the other */
    *narrowest = fmin(*narrowest, far);
    if (far >= limit * (1.0 - 1e-9)) return FW_OK;
    *bad = true;
    return tell(d, p, q, far, at_p, limit);
}

static part part_of(int body, const char *label, const fw_geometry_contour *contour) {
    return (part){body, FW_NONE, label, contour, fw_geometry_contour_box(contour)};
}

/* bodies, stators and frame: all that must keep apart; *out (returned) */
static fw_status list_parts(fw_layout_drawing *d, part **out, int *count) {
    int n = 0, most = d->nslot + d->layout->npiece + d->ncomb;
    part *all;
    FW_NEED(all = fw_arena_array(d->arena, part, (size_t)most));
    for (int s = 0; s < d->nslot; s++) {
        int body = s < d->device->nbody ? s : FW_GROUND;
        const char *label;
        if (d->plain[s].count == 0) continue;
        FW_NEED((label = fw_layout_body_label(d, body)));
        all[n++] = part_of(body, label, fw_layout_drawing_outline(d, s));
    }
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off)
            all[n++] = part_of(FW_ISLAND, "the stator of a comb drive", &d->comb[i].stator);
    for (int i = 0; i < d->layout->npiece; i++) {
        const fw_layout_piece *piece = &d->layout->piece[i];
        if (piece->role == FW_ROLE_FRAME)
            all[n++] = part_of(FW_GROUND, piece->label, &piece->contour);
    }
    *out = all;
    *count = n;
    return FW_OK;
}

/* every pair of parts that move apart, tethers not counted: they are broken first */
fw_status fw_layout_clearance_check(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    int n;
    part *all;
    bool bad = false;
    FW_TRY(list_parts(d, &all, &n));
    d->layout->narrowest_gap_m = HUGE_VAL;
    for (int i = 0; i < n; i++)
        for (int k = i + 1; k < n; k++)
            if (all[i].body != all[k].body) FW_TRY(check_pair(d, &all[i], &all[k], &bad));
    for (int j = 0; j < device->nrevolute; j++) { /* flexures and third bodies */
        const fw_device_revolute *t = &device->revolute[j];
        part flexure = part_of(t->body_a, NULL, &d->hinge[j].flexure);
        flexure.joint = j;
        for (int i = 0; i < n; i++)
            if (all[i].body != t->body_a && all[i].body != t->body_b)
                FW_TRY(check_pair(d, &flexure, &all[i], &bad));
    }
    return bad ? FW_GEOMETRY : FW_OK;
}
