/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holes of any shape in a body's outline. An outline has no holes, so each is reached by a cut from
   a straight place of the edge, and a piece of its own, the cap, closes the cut again, as at
   eyelets: outline and caps share the two sides of the cut bit for bit (JOINT, THROUGH), and their
   union is the body with its holes.

     outline   ... edge to P1 | P1 Q1 | the hole's edge from Q1 round to Q2 | Q2 P2 | edge from P2
     cap       edge P1 P2 | P2 Q2 | the hole's edge Q2 Q1 | Q1 P1

   Holes near the edge come first; one behind another is opened through it. Of all cuts that start
   square to a hole's edge the shortest is taken that leaves through one edge within 45 degrees of
   square, stays away from eyelets and electrodes and from holes that are still closed. Cuts are 12 um
   wide; where none fits 8, then 4 um; where none does, they begin askew by 15, 30 or 45 degrees, and
   holes as small as the dots of letters get cuts of 2 um: what a cut parts is joined again. A hole whose
   edges are all shorter, as the chords of a circle in GDSII are, is cut across several of them. In: outer
   outline and holes (clockwise). Cost: places on the holes' edges times segments. Test: test_shapes.c */
#include "base/constants.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

/* half the width of a cut, and how much of its edge is left beside it at the outline, at the hole:
   what a process bias takes off either end must leave an edge */
typedef struct cut_size {
    double half_m, beside_m, rim_m;
    bool askew, across; /* across: it may begin at more than one edge of the hole */
} cut_size;
static const cut_size sizes[] = {
    {6e-6, 16e-6, 3e-6, false, false}, {4e-6, 8e-6, 3e-6, false, false},
    {2e-6, 4e-6, 3e-6, false, false},  {6e-6, 16e-6, 3e-6, true, false},
    {4e-6, 8e-6, 3e-6, true, false},   {2e-6, 4e-6, 3e-6, true, false},
    {1e-6, 4e-6, 2e-6, false, false},  {1e-6, 4e-6, 2e-6, true, false},
    {2e-6, 4e-6, 0, false, true},      {1e-6, 4e-6, 0, false, true}};
enum { SIZES = sizeof sizes / sizeof *sizes, PLACES = 5, ARC_PLACES = 24 };
enum { TURNS = 6 }; /* ways askew: of 15, 30 and 45 degrees to either side */
static const double CLEAR_M = 6e-6, LONGEST_M = 5e-3;
static const double NEAR_M = 2.5e-6; /* of a cut's sides from other edges: two biases, and some */
/* Edges of a hole that a cut begins across are within 30 degrees of square to it, and so much of one is left beside it,
   besides what a bias takes off at its ends. */
static const double SQUARE = 0.5, LEFT_M = 5e-8, BIAS_M = 1.5e-6;

typedef struct cut {
    int segment[2], edge;        /* of the hole, where q lie; of the outline */
    fw_geometry_vec2 q[2], p[2]; /* on the hole, on the edge; right and left of the way out */
    double length_m;
} cut;

typedef struct opening {
    fw_layout_drawing *d;
    int body;
    fw_geometry_contour outline;
    fw_geometry_contour *hole; /* (nhole) those that are not open yet */
    int nhole;
} opening;

static fw_geometry_segment side_of_cut(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return (fw_geometry_segment){
        .kind = FW_LINE, .flags = FW_SEGMENT_JOINT | FW_SEGMENT_THROUGH, .a = a, .b = b};
}

/* the two places on a hole's segment, `half` to either side of the ray from `m` along u; an arc's is
   square to it */
static bool foot_on_hole(const fw_geometry_segment *s, fw_geometry_vec2 m, fw_geometry_vec2 u,
                         double half, double rim, fw_geometry_vec2 q[2]) {
    fw_geometry_vec2 v = fw_left(u), tangent = fw_geometry_segment_tangent(s, 0.5);
    for (int k = 0; k < 2; k++) {
        double aside = k == 0 ? -half : half;
        if (s->kind == FW_LINE)
            q[k] = fw_add(m, aside / fw_dot(tangent, v), tangent);
        else {
            double out = fw_dot(fw_sub(m, s->centre), u) < 0 ? -1.0 : 1.0;
            double in = s->radius * s->radius - half * half;
            if (!(in > 0.7 * s->radius * s->radius)) return false; /* within 33 degrees of square */
            q[k] = fw_add(fw_add(s->centre, out * sqrt(in), u), aside, v);
        }
        double length = fw_geometry_segment_length(s), t = fw_geometry_segment_parameter(s, q[k]);
        if (t * length < rim || (1 - t) * length < rim) return false;
    }
    return fw_geometry_segment_parameter(s, q[1]) < fw_geometry_segment_parameter(s, q[0]);
}

/* what a bias takes off an edge at a corner where the next one turns by the angle between these directions */
static double taken_off(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return BIAS_M * fabs(fw_dot(fw_left(a), b)) / (1 + fw_dot(a, b));
}

/* The place on the hole's edge, from segment `from` on forwards or back (way 1, -1), that lies `aside` of the ray from m
   along u: nothing on the way there is an arc, or far from square to u, and enough is left beside it. */
static bool foot_across(const fw_geometry_contour *hole, int from, int way, fw_geometry_vec2 m,
                        fw_geometry_vec2 u, double aside, int *segment, fw_geometry_vec2 *q) {
    const fw_geometry_vec2 v = fw_left(u);
    const int n = hole->count;
    for (int k = 0; k < n / 2; k++) {
        const int at = (from + way * k + n) % n, next = (at + way + n) % n;
        const fw_geometry_segment *s = &hole->segment[at], *then = &hole->segment[next];
        const fw_geometry_vec2 along = fw_geometry_segment_tangent(s, 0.5);
        if (s->kind != FW_LINE || fabs(fw_dot(along, u)) > SQUARE) return false;
        const double a = fw_dot(fw_sub(s->a, m), v), b = fw_dot(fw_sub(s->b, m), v);
        if (!((a - aside) * (b - aside) <= 0)) continue;
        const double t = (aside - a) / (b - a), length = fw_geometry_segment_length(s),
                     corner = taken_off(along, fw_geometry_segment_tangent(then, way > 0 ? 0 : 1));
        *segment = at;
        *q = fw_geometry_segment_point(s, t);
        return (way > 0 ? 1 - t : t) * length > LEFT_M + BIAS_M * fabs(fw_dot(along, u)) + corner;
    }
    return false;
}

/* both sides of the cut, and what is left beside it, leave through one edge */
static bool leaves(const fw_geometry_contour *c, fw_geometry_vec2 u, const cut_size *size, cut *k) {
    fw_geometry_vec2 v = fw_left(u);
    for (int i = 0; i < 2; i++) {
        fw_layout_ray_hit hit = fw_layout_first_hit(c, k->q[i], u);
        if (hit.segment < 0 || hit.far_m > LONGEST_M || hit.far_m < 1e-6) return false;
        if (i == 0) k->edge = hit.segment;
        if (hit.segment != k->edge) return false;
        k->p[i] = hit.at;
        k->length_m = i == 0 ? hit.far_m : fmax(k->length_m, hit.far_m);
        const fw_geometry_segment *s = &c->segment[k->edge];
        double t = fw_geometry_segment_parameter(s, hit.at);
        if (s->flags & FW_SEGMENT_JOINT) return false;
        if (fw_dot(fw_geometry_segment_tangent(s, t), v) < 0.7) return false;
    }
    for (int i = 0; i < 2; i++) { /* and nothing else of the outline is near */
        fw_geometry_vec2 beside = fw_add(k->q[i], i == 0 ? -NEAR_M : NEAR_M, v);
        if (fw_layout_first_hit(c, beside, u).segment != k->edge) return false;
    }
    const fw_geometry_segment *s = &c->segment[k->edge];
    double length = fw_geometry_segment_length(s);
    double t0 = fw_geometry_segment_parameter(s, k->p[0]),
           t1 = fw_geometry_segment_parameter(s, k->p[1]);
    return t0 < t1 && t0 * length >= size->beside_m && (1 - t1) * length >= size->beside_m;
}

/* Does segment i belong to where the cut begins, or lie next to it on the hole's edge? An edge that turns towards the cut
   does not. */
static bool is_foot(const fw_geometry_contour *hole, const cut *k, int i) {
    const int n = hole->count;
    const fw_geometry_vec2 way = fw_sub(k->p[0], k->q[0]);
    const double square = SQUARE * sqrt(fw_dot(way, way));
    for (int at = k->segment[1];; at = (at + 1) % n) {
        if (at == i) return true;
        if (at == k->segment[0]) break;
    }
    if (k->segment[0] == k->segment[1]) return false;
    if (fabs(fw_dot(fw_geometry_segment_tangent(&hole->segment[i], 0.5), way)) > square)
        return false;
    for (int end = 0; end < 2; end++) {
        const int step = end == 0 ? 1 : -1;
        double far = 0;
        for (int at = (k->segment[end] + step + n) % n; far < 2 * NEAR_M;
             at = (at + step + n) % n) {
            if (at == i) return true;
            far += fw_geometry_segment_length(&hole->segment[at]);
        }
    }
    return false;
}

/* does a cut come near to the hole that it begins at? */
static bool near_own_hole(const fw_geometry_contour *hole, const cut *k) {
    for (int i = 0; i < hole->count; i++)
        for (int n = 0; n < 2 && !is_foot(hole, k, i); n++) {
            const fw_geometry_segment side = side_of_cut(k->q[n], k->p[n]);
            fw_geometry_vec2 a, b;
            if (fw_geometry_segment_distance(&side, &hole->segment[i], &a, &b) < NEAR_M)
                return true;
        }
    return false;
}

static bool near_disc(const fw_geometry_contour *way, fw_geometry_vec2 at, double radius) {
    if (fw_geometry_contour_contains(way, at)) return true;
    for (int i = 0; i < way->count; i++) {
        double t;
        fw_geometry_vec2 on;
        if (fw_geometry_segment_nearest(&way->segment[i], at, &t, &on) < radius) return true;
    }
    return false;
}

/* the place of a point that the description states on the body */
static fw_geometry_vec2 placed(const fw_layout_drawing *d, int body, double x, double y) {
    const fw_device_body *b = &d->device->body[body];
    fw_layout_local local = {fw_v(b->x_m, b->y_m), cos(b->phi_rad), sin(b->phi_rad), false};
    return fw_layout_local_point(&local, fw_v(x, y));
}

/* eyelets and electrodes that will be united with the body, holes that are closed, and hinges */
static bool in_the_way(const opening *o, const fw_geometry_contour *way) {
    const fw_layout_drawing *d = o->d;
    for (int i = 0; i < o->nhole; i++)
        if (fw_geometry_contour_distance_below(way, &o->hole[i], CLEAR_M, NULL, NULL) < CLEAR_M)
            return true;
    for (int i = 0; i < d->neyelet; i++) {
        const fw_layout_eyelet_plan *e = &d->eyelet[i];
        if (e->eyelet->body != o->body) continue;
        fw_geometry_vec2 at = placed(d, o->body, e->eyelet->x_m, e->eyelet->y_m);
        if (near_disc(way, at, 0.5 * e->hole_m + e->ring_m + 60e-6)) return true;
    }
    for (int i = 0; i < d->ncomb; i++) {
        const fw_device_comb *c = d->comb[i].comb;
        if (c->body_b != o->body) continue;
        double wide = c->kind == FW_ELECTRODES_COMB
                          ? 2.0 * c->fingers * (d->comb[i].width_m + c->gap_m)
                          : d->comb[i].length_m;
        double reach = fmax(0.5 * wide, d->comb[i].length_m) + 120e-6;
        if (near_disc(way, placed(d, o->body, c->bx_m, c->by_m), reach)) return true;
    }
    return false;
}

static fw_status is_free(opening *o, const cut *k, bool *is) {
    fw_geometry_contour way;
    fw_mark mark = fw_arena_mark(o->d->arena);
    fw_geometry_outline w = fw_geometry_outline_start(o->d->arena, k->q[0]);
    fw_geometry_outline_line(&w, k->p[0], 0);
    fw_geometry_outline_line(&w, k->p[1], 0);
    fw_geometry_outline_line(&w, k->q[1], 0);
    FW_TRY(fw_geometry_outline_close(&w, &way));
    *is = !in_the_way(o, &way);
    fw_arena_rewind(o->d->arena, mark);
    return FW_OK;
}

/* the way out of a hole at parameter t, askew by the turn-th angle; 0: square to the edge */
static fw_geometry_vec2 way_out(const fw_geometry_segment *s, double t, int turn) {
    double angle = (turn % 2 ? 1 : -1) * ((turn + 1) / 2) * FW_PI / 12;
    return fw_geometry_vec_rotate(fw_left(fw_geometry_segment_tangent(s, t)), angle);
}

static fw_status try_cut(opening *o, const fw_geometry_contour *hole, const cut_size *size, cut k,
                         fw_geometry_vec2 m, fw_geometry_vec2 u, cut *best) {
    bool is = false;
    const int at = k.segment[0];
    const bool foot =
        size->across ? foot_across(hole, at, 1, m, u, -size->half_m, &k.segment[0], &k.q[0]) &&
                           foot_across(hole, at, -1, m, u, size->half_m, &k.segment[1], &k.q[1])
                     : foot_on_hole(&hole->segment[at], m, u, size->half_m, size->rim_m, k.q);
    if (!foot || !leaves(&o->outline, u, size, &k) || k.length_m >= best->length_m - 1e-9 ||
        near_own_hole(hole, &k))
        return FW_OK;
    FW_TRY(is_free(o, &k, &is));
    if (is) *best = k;
    return FW_OK;
}

/* the shortest cut of one size; best->segment -1: none */
static fw_status find_cut(opening *o, const fw_geometry_contour *hole, const cut_size *size,
                          cut *best) {
    best->segment[0] = best->segment[1] = -1;
    best->length_m = HUGE_VAL;
    for (int i = 0; i < hole->count; i++) {
        const fw_geometry_segment *s = &hole->segment[i];
        int places = s->kind == FW_ARC ? ARC_PLACES : PLACES;
        const double least = size->across ? 0 : 2.0 * (size->half_m + size->rim_m);
        if (fw_geometry_segment_length(s) < least) continue;
        for (int n = 0; n < places; n++) {
            double t = (n + 0.5) / places;
            fw_geometry_vec2 m = fw_geometry_segment_point(s, t);
            int last = size->askew && s->kind == FW_LINE ? TURNS : 0;
            for (int turn = size->askew ? 1 : 0; turn <= last; turn++)
                FW_TRY(
                    try_cut(o, hole, size, (cut){.segment = {i, i}}, m, way_out(s, t, turn), best));
        }
    }
    return FW_OK;
}

/* the part of the hole's edge from Q1 round to Q2 */
static int go_round(const fw_geometry_contour *hole, const cut *k, fw_geometry_segment *out) {
    const fw_geometry_segment *s = &hole->segment[k->segment[0]],
                              *e = &hole->segment[k->segment[1]];
    double t1 = fw_geometry_segment_parameter(s, k->q[0]),
           t2 = fw_geometry_segment_parameter(e, k->q[1]);
    int n = 0;
    out[n++] = fw_geometry_segment_cut(s, t1, k->q[0], 1.0, s->b);
    for (int i = k->segment[0] + 1; i % hole->count != k->segment[1]; i++)
        out[n++] = hole->segment[i % hole->count];
    out[n++] = fw_geometry_segment_cut(e, 0.0, e->a, t2, k->q[1]);
    return n;
}

/* the part of it between the sides of the cut, from Q2 to Q1 */
static int go_across(const fw_geometry_contour *hole, const cut *k, fw_geometry_segment *out) {
    const fw_geometry_segment *s = &hole->segment[k->segment[1]],
                              *e = &hole->segment[k->segment[0]];
    double t2 = fw_geometry_segment_parameter(s, k->q[1]),
           t1 = fw_geometry_segment_parameter(e, k->q[0]);
    int n = 0;
    if (s == e) {
        out[n++] = fw_geometry_segment_cut(s, t2, k->q[1], t1, k->q[0]);
        return n;
    }
    out[n++] = fw_geometry_segment_cut(s, t2, k->q[1], 1.0, s->b);
    for (int i = k->segment[1] + 1; i % hole->count != k->segment[0]; i++)
        out[n++] = hole->segment[i % hole->count];
    out[n++] = fw_geometry_segment_cut(e, 0.0, e->a, t1, k->q[0]);
    return n;
}

static fw_status splice(opening *o, const fw_geometry_contour *hole, const cut *k,
                        fw_geometry_contour *cap) {
    const fw_geometry_contour *from = &o->outline;
    const fw_geometry_segment *edge = &from->segment[k->edge];
    double t1 = fw_geometry_segment_parameter(edge, k->p[0]),
           t2 = fw_geometry_segment_parameter(edge, k->p[1]);
    size_t room = (size_t)(from->count + hole->count + 5);
    fw_geometry_contour to = {0};
    FW_NEED(to.segment = fw_arena_array(o->d->arena, fw_geometry_segment, room));
    FW_NEED(cap->segment =
                fw_arena_array(o->d->arena, fw_geometry_segment, (size_t)hole->count + 4));
    for (int i = 0; i < from->count; i++) {
        if (i != k->edge) {
            to.segment[to.count++] = from->segment[i];
            continue;
        }
        to.segment[to.count++] = fw_geometry_segment_cut(edge, 0.0, edge->a, t1, k->p[0]);
        to.segment[to.count++] = side_of_cut(k->p[0], k->q[0]);
        to.count += go_round(hole, k, to.segment + to.count);
        to.segment[to.count++] = side_of_cut(k->q[1], k->p[1]);
        to.segment[to.count++] = fw_geometry_segment_cut(edge, t2, k->p[1], 1.0, edge->b);
    }
    cap->count = 2;
    cap->segment[0] = fw_geometry_segment_cut(edge, t1, k->p[0], t2, k->p[1]);
    cap->segment[1] = side_of_cut(k->p[1], k->q[1]);
    cap->count += go_across(hole, k, cap->segment + cap->count);
    cap->segment[cap->count++] = side_of_cut(k->q[0], k->p[0]);
    o->outline = to;
    return FW_OK;
}

/* the hole nearest to the edge comes first; deterministic, of equally near ones the earlier */
static void sort_holes(opening *o) {
    for (int i = 0; i < o->nhole; i++) {
        int best = i;
        double least = HUGE_VAL;
        for (int k = i; k < o->nhole; k++) {
            double far =
                fw_geometry_contour_distance_below(&o->outline, &o->hole[k], least, NULL, NULL);
            if (far < least - 1e-9) least = far, best = k;
        }
        fw_geometry_contour first = o->hole[best];
        for (int k = best; k > i; k--)
            o->hole[k] = o->hole[k - 1];
        o->hole[i] = first;
    }
}

/* opens the first hole that any cut reaches; *done false: there is none */
static fw_status open_one(opening *o, fw_geometry_contour *cap, bool *done) {
    *done = false;
    for (int size = 0; size < SIZES && !*done; size++)
        for (int i = 0; i < o->nhole && !*done; i++) {
            fw_geometry_contour hole = o->hole[i];
            cut best = {.segment = {-1, -1}};
            for (int k = i; k + 1 < o->nhole; k++)
                o->hole[k] = o->hole[k + 1];
            o->nhole--; /* it is not in its own way */
            FW_TRY(find_cut(o, &hole, &sizes[size], &best));
            *done = best.segment[0] >= 0;
            if (*done) {
                FW_TRY(splice(o, &hole, &best, cap));
                break;
            }
            for (int k = o->nhole++; k > i; k--)
                o->hole[k] = o->hole[k - 1];
            o->hole[i] = hole;
        }
    return FW_OK;
}

fw_status fw_layout_holes_open(fw_layout_drawing *d, int body, const fw_geometry_region *all,
                               fw_geometry_contour *outline, fw_geometry_region *caps) {
    opening o = {.d = d, .body = body, .outline = all->contour[0]};
    size_t n = (size_t)all->count;
    FW_NEED(o.hole = fw_arena_array(d->arena, fw_geometry_contour, n));
    FW_NEED(caps->contour = fw_arena_array(d->arena, fw_geometry_contour, n));
    caps->count = 0;
    for (int i = 1; i < all->count; i++)
        o.hole[o.nhole++] = all->contour[i];
    sort_holes(&o);
    while (o.nhole > 0) {
        bool done;
        FW_TRY(open_one(&o, &caps->contour[caps->count], &done));
        if (!done)
            return fw_layout_shape_refuse(
                d, 316, fw_layout_body_place(d, body), body,
                "a hole has no edge from which a straight way of 2 um width leads to the "
                "outer edge, so that it cannot be opened; move it or make it larger",
                o.hole[0].segment[0].a);
        caps->count++;
    }
    *outline = o.outline;
    return FW_OK;
}
