/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The strip of a flexure when it bends: where it can be, and whether it comes to the roots and rings of its own two bodies. */
#include "clearance/clearance.h"
#include "flexure/path.h"
#include "geometry/segment.h"
#include <math.h>

/* ---- where it can be ---- */

/* Where the strip of a flexure can be, whatever bends it within its elastic limit.

   A section at s along the strip from a root turns against it by at most k s, where k is the largest
   change of curvature, and so a point of the strip, t/2 beside its centre line, goes by at most
     b(s) = k s (s + t)/2 + 2 e s
   against the body at that root: e is the largest strain of the centre line, twice for what shear
   adds. k <= 2 e/t, e the strain at the limit (of a thick arc the inner side has more, so less k).
   The same holds from the other root, against the other body. Hence
     |p - W| <= |p drawn - W| + min(b(s), b(L - s)),
   about the hinge point W of the nearer body: a disc that goes with either body.

   In: layout, hinge (SI); out: radius (m). Error: proved, to rounding. Cost: 24 points of an edge.
   Source: docs/theory/clearance.md. Test: test_clearance_strip.c */

/* ---- the strip ---- */

static bool joins(const fw_layout *layout, const fw_geometry_segment *joint, int body) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        if (p->role == FW_ROLE_FLEXURE || p->body != body) continue;
        for (int k = 0; k < p->contour.count; k++) {
            const fw_geometry_segment *s = &p->contour.segment[k];
            if ((s->flags & FW_SEGMENT_JOINT) && vec_same(s->a, joint->b) &&
                vec_same(s->b, joint->a))
                return true;
        }
    }
    return false;
}

/* segments from one joint to the other, whose places along the strip are shares of their length */
static int side_of(const fw_geometry_contour *c, int first, int last, bool back, double *length,
                   fw_clearance_strip_part *part) {
    int n = 0;
    double run = 0;
    for (int i = (first + 1) % c->count; i != last; i = (i + 1) % c->count) {
        double size = fw_geometry_segment_length(&c->segment[i]);
        part[n++] = (fw_clearance_strip_part){c->segment[i], run, run + size};
        run += size;
    }
    *length = run;
    for (int i = 0; back && i < n; i++) {
        part[i].from_m = run - part[i].from_m;
        part[i].to_m = run - part[i].to_m;
    }
    return n;
}

/* strip->known stays false where the roots cannot be told from each other */
fw_status fw_clearance_strip_of(fw_arena *arena, const fw_layout *layout,
                                const fw_layout_piece *piece, fw_clearance_strip *strip) {
    const fw_geometry_contour *c = &piece->contour;
    const fw_layout_hinge_layout *h = &layout->hinge[piece->joint];
    int joint[2], n = 0, lower = FW_NONE;
    *strip = (fw_clearance_strip){.hinge = h};
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].flags & FW_SEGMENT_JOINT) {
            if (n < 2) joint[n] = i;
            n++;
        }
    if (n != 2) return FW_OK;
    for (int i = 0; i < 2 && lower == FW_NONE; i++)
        if (joins(layout, &c->segment[joint[i]], h->lower)) lower = i;
    if (lower == FW_NONE) return FW_OK;
    FW_NEED(strip->part = fw_arena_array(arena, fw_clearance_strip_part, (size_t)c->count));
    double length[2];
    int first = side_of(c, joint[lower], joint[1 - lower], false, &length[0], strip->part);
    strip->count =
        first + side_of(c, joint[1 - lower], joint[lower], true, &length[1], strip->part + first);
    strip->length_m = fmax(length[0], length[1]);
    for (int i = 0; i < strip->count; i++) {
        double by = strip->length_m / length[i >= first];
        strip->part[i].from_m *= by;
        strip->part[i].to_m *= by;
    }
    strip->known = strip->length_m > 0;
    return FW_OK;
}

/* ---- how far it bends ---- */

static double least_width(const fw_flexure_input *in) {
    double least = in->width_m;
    if (in->width_middle_m > 0) least = fmin(least, in->width_middle_m);
    for (int i = 0; i < in->npiece; i++) {
        fw_geometry_strip_shape shape;
        double low, high;
        fw_geometry_strip_shape_of(&in->piece[i], &shape);
        fw_geometry_strip_widths(&shape, &low, &high);
        least = i ? fmin(least, low) : low;
    }
    return least;
}

/* at the elastic limit with its safety factor: what bends further is not accepted */
fw_clearance_bend fw_clearance_bend_of(const fw_mechanism *m, const fw_mechanism_hinge *hinge) {
    const fw_flexure_input *in = &hinge->input;
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&hinge->limits);
    const fw_flexure_crystal *x = &in->crystal;
    double allowed = limit ? limit->allowable_Pa : m->variant->material.strength.value;
    double strain = allowed / m->device->safety_factor / in->youngs_Pa;
    /* strains are stress over one modulus; along the softest direction there is more */
    if (x->known) strain *= fmax(1, (x->a0_per_Pa + fabs(x->a1_per_Pa)) * in->youngs_Pa);
    fw_clearance_bend b = {.strain = strain, .width_m = least_width(in), .forced_per_m = HUGE_VAL};
    b.curvature_per_m = 2 * strain / b.width_m;
    b.straight = in->kind == FW_FLEXURE_LEAF && !fw_flexure_input_varies(in);
    double roots = 2 * hinge->closed_form.root_length_m;
    b.root_share = fmax(0, roots / (in->length_m + roots));
    b.known = isfinite(b.curvature_per_m) && b.curvature_per_m > 0;
    return b;
}

double fw_clearance_bend_at(const fw_clearance_bend *b, double s_m) {
    return b->curvature_per_m * s_m * (s_m + b->width_m) / 2 + 2 * b->strain * s_m;
}

bool fw_clearance_bend_covers(const fw_clearance_bend *a, const fw_clearance_bend *b) {
    return isfinite(a->curvature_per_m) && a->turn_rad >= b->turn_rad && a->strain >= b->strain &&
           a->curvature_per_m >= b->curvature_per_m && a->forced_per_m >= b->forced_per_m;
}

/* least distance about a point that holds all of a part: of a chord the ends are the farthest, an arc
   leaves it by at most length^2/(8 r) */
static double farthest(const fw_geometry_segment *s, fw_geometry_vec2 from) {
    double far = fmax(vec_distance(s->a, from), vec_distance(s->b, from));
    if (s->kind != FW_ARC) return far;
    double length = fw_geometry_segment_length(s);
    return far + fmin(length * length / (8 * s->radius), length / 2);
}

/* the part between two parameters */
static fw_geometry_segment cut(const fw_geometry_segment *s, double from, double to) {
    if (from <= 0 && to >= 1) return *s;
    return fw_geometry_segment_cut(s, from, fw_geometry_segment_point(s, from), to,
                                   fw_geometry_segment_point(s, to));
}

double fw_clearance_strip_reach(const fw_clearance_strip *strip, const fw_clearance_bend *bend) {
    enum { PIECES = 12 };
    double reach = 0;
    for (int i = 0; i < strip->count; i++) {
        const fw_clearance_strip_part *p = &strip->part[i];
        for (int k = 0; k < PIECES; k++) {
            double from = (double)k / PIECES, to = (double)(k + 1) / PIECES;
            fw_geometry_segment s = cut(&p->segment, from, to);
            double s0 = p->from_m + from * (p->to_m - p->from_m);
            double s1 = p->from_m + to * (p->to_m - p->from_m);
            double near = fw_clearance_bend_at(bend, fmax(s0, s1));
            double other = fw_clearance_bend_at(bend, strip->length_m - fmin(s0, s1));
            reach = fmax(reach, farthest(&s, strip->hinge->centre) + fmin(near, other));
        }
    }
    return reach;
}

/* ---- what it comes to of its own two bodies ---- */

/* Does a strip that bends come to the roots and rings of its own two bodies?

   Seen from one body, whose root it leaves at s = 0. A hinge that turns by th bends its strip by
     psi(s) = th (r/2 + (1 - r) C(s)),   C(s) = int_0^s ds/t^3 over that of all of it,
   where r = 2 dL/(L + 2 dL) is what both roots take: a pure moment, as in the closed form. Forces add
   a curvature f(s) whose integral is 0, since th is given. With k the largest change of curvature in
   the whole motion and m = th (1 - r)/L that of the moment, somewhere f adds to it, so that
     |f| <= g(th) = min(2 (k - m), k + m)
   (its other sign is at most twice as large), or what was seen of it, and a point goes off psi's curve by at most
     b(s) = g s^2/2 for s <= L/2, g (L^2/4 - (L - s)^2/2) beyond,
     b(s) = g (s^2/2 - s^3/3L) of a straight strip of one width, where f is linear in s,
   and by at most k s (s + t)/2 off where it is drawn. What shear and the edges' own strain add is
   3 e s. Parts of both edges that the second bound keeps off an edge of the body are off at any th;
   for the others th is stepped from 0 to the largest rotation, either way, each step as long as their
   least distance lasts at |dp/dth| <= s psi/th + s^2/L. Nearest to the root parts are halved.
   In: strip, bend (SI), what walls come nearer by; out: the edge that it is not proved to keep off.
   Error: what the program's own bending has; parts of L/24, 40 nm. Cost: 3000 boxes, some hundred
   distances. Source: docs/theory/clearance.md. Test: test_clearance_strip.c */

enum { PARTS = 24, DEEPEST = 24, MOST_STEPS = 400 };
static const double fw_root_m = 50e-9;  /* nearer to a root the strip is the root */
static const double fw_parts_m = 40e-9; /* what straight steps along it are off by */

typedef struct piece { /* of an edge, from the root of the body on */
    fw_geometry_segment segment;
    double from_m, to_m, share; /* share: psi/th in its middle */
    int start;                  /* first piece of the same edge */
    fw_geometry_box box;
    fw_geometry_vec2 middle;
    double half_m; /* no place of it is farther from there */
    double bent_m; /* what it goes by against the body, at most */
} piece;

typedef struct seen { /* a strip from one of its bodies */
    const fw_clearance_strip *strip;
    const fw_clearance_bend *bend;
    piece *piece; /* (count) */
    int count;
    double wall_m;
} seen;

typedef struct close { /* a piece that an edge may meet */
    int piece;
    const fw_clearance_edge *edge;
    double until; /* the rotation up to which what was last seen of it keeps them apart */
} close;

/* ---- as seen from one body ---- */

/* width where an edge is at this share of it: the other edge's point at the same share */
static double width_at(const fw_clearance_strip *s, double at_m) {
    fw_geometry_vec2 found[2] = {{0, 0}, {0, 0}};
    for (int i = 0; i < s->count; i++) {
        const fw_clearance_strip_part *p = &s->part[i];
        double low = fmin(p->from_m, p->to_m), high = fmax(p->from_m, p->to_m);
        if (at_m < low || at_m > high) continue;
        double t = (at_m - p->from_m) / (p->to_m - p->from_m);
        found[p->to_m < p->from_m] = fw_geometry_segment_point(&p->segment, t);
    }
    return vec_distance(found[0], found[1]);
}

/* C(s) at the middles of equal parts */
static void compliance(const fw_clearance_strip *s, double out[PARTS]) {
    double sum = 0, each[PARTS];
    for (int i = 0; i < PARTS; i++) {
        double width = width_at(s, s->length_m * (i + 0.5) / PARTS);
        each[i] = 1 / (width * width * width);
        sum += each[i];
    }
    double before = 0;
    for (int i = 0; i < PARTS; i++) {
        out[i] = (before + 0.5 * each[i]) / sum;
        before += each[i];
    }
}

static void add_pieces(seen *v, const fw_clearance_strip_part *p, bool upper, int start,
                       const double share[PARTS]) {
    const double length = v->strip->length_m;
    double s0 = upper ? length - p->from_m : p->from_m, s1 = upper ? length - p->to_m : p->to_m;
    fw_geometry_segment whole = s0 < s1 ? p->segment : fw_geometry_segment_reverse(&p->segment);
    double from = fmin(s0, s1), to = fmax(s0, s1);
    int n = (int)ceil((to - from) * PARTS / length);
    for (int i = 0; i < n; i++) {
        piece *q = &v->piece[v->count++];
        q->segment = cut(&whole, (double)i / n, (double)(i + 1) / n);
        q->from_m = from + (to - from) * i / n;
        q->to_m = from + (to - from) * (i + 1) / n;
        int at = (int)(PARTS * 0.5 * (q->from_m + q->to_m) / length);
        at = at < PARTS ? at : PARTS - 1;
        double c = upper ? 1 - share[PARTS - 1 - at] : share[at];
        q->share = 0.5 * v->bend->root_share + (1 - v->bend->root_share) * c;
        q->start = start;
        q->box = fw_segment_box(&q->segment);
        q->middle = fw_geometry_segment_point(&q->segment, 0.5);
        q->half_m = 0.5 * fw_geometry_segment_length(&q->segment);
        q->bent_m = fw_clearance_bend_at(v->bend, q->to_m);
    }
}

/* both edges, each from the body's root on */
static fw_status see(fw_arena *arena, seen *v, bool upper) {
    const fw_clearance_strip *s = v->strip;
    double share[PARTS];
    compliance(s, share);
    v->count = 0;
    FW_NEED(v->piece = fw_arena_array(arena, piece, (size_t)(2 * PARTS + s->count)));
    for (int edge = 0; edge < 2; edge++) {
        bool back = edge == 1; /* the second one is walked from the upper root */
        int start = v->count, n = 0, first = 0;
        for (int i = 0; i < s->count; i++)
            if ((s->part[i].to_m < s->part[i].from_m) == back) first = n++ ? first : i;
        for (int i = 0; i < n; i++)
            add_pieces(v, &s->part[back == upper ? first + i : first + n - 1 - i], upper, start,
                       share);
    }
    return FW_OK;
}

/* ---- how near ---- */

/* walls come nearer; where root and strip are one they become thicker together */
static double room(double distance, double wall) {
    return distance - fmin(wall, 0.5 * distance);
}

/* a part that is kept off the edge however the strip bends; near the root it is halved */
static bool kept_off(const seen *v, const piece *p, double from, double to, int depth,
                     const fw_geometry_segment *edge) {
    fw_geometry_vec2 at, there;
    double end = p->from_m + to * (p->to_m - p->from_m);
    if (end < fw_root_m) return true;
    fw_geometry_segment s = cut(&p->segment, from, to);
    double d = fw_geometry_segment_distance(&s, edge, &at, &there);
    if (room(d, v->wall_m) > fw_clearance_bend_at(v->bend, end)) return true;
    if (p->from_m > fw_root_m || depth == DEEPEST) return false;
    double half = 0.5 * (from + to);
    return kept_off(v, p, from, half, depth + 1, edge) && kept_off(v, p, half, to, depth + 1, edge);
}

/* b(s) at a rotation, and how fast it may grow with it */
static double forced(const seen *v, const piece *p, double turn) {
    const double length = v->strip->length_m, k = v->bend->curvature_per_m;
    double m = fabs(turn) * (1 - v->bend->root_share) / length;
    double g = fmin(v->bend->forced_per_m, fmin(2 * fmax(0, k - m), k + m));
    double s = p->to_m, rest = length - s;
    double b = s <= 0.5 * length ? s * s / 2 : length * length / 4 - rest * rest / 2;
    if (v->bend->straight) b = s * s / 2 - s * s * s / (3 * length); /* its moments are linear */
    return g * b + 3 * v->bend->strain * s + fw_parts_m;
}

static fw_geometry_segment placed(const fw_geometry_segment *s, fw_geometry_vec2 start,
                                  double turn) {
    fw_geometry_segment out = *s;
    out.a = start;
    out.b = vec_add(start, fw_geometry_vec_rotate(vec_sub(s->b, s->a), turn));
    out.centre = vec_add(start, fw_geometry_vec_rotate(vec_sub(s->centre, s->a), turn));
    return out;
}

/* pieces at a rotation, in the body's frame */
static void bend_all(const seen *v, double turn, fw_geometry_segment *now) {
    for (int i = 0; i < v->count; i++) {
        const piece *p = &v->piece[i];
        fw_geometry_vec2 start = i == p->start ? p->segment.a : now[i - 1].b;
        now[i] = placed(&p->segment, start, turn * p->share);
    }
}

/* how much further the hinge may turn before the pair may meet */
static double lasts(const seen *v, const close *pair, double turn, const fw_geometry_segment *now) {
    const piece *p = &v->piece[pair->piece];
    fw_geometry_vec2 at, there;
    double d = fw_geometry_segment_distance(&now[pair->piece], &pair->edge->segment, &at, &there);
    double speed = p->to_m * (p->share + p->to_m / v->strip->length_m);
    return (room(d, v->wall_m) - forced(v, p, turn)) / speed;
}

/* The pair that may meet first, the first of those alike. A pair whose last distance lasts beyond the least
   found so far is not looked at again: it would last longer still. That which was the first one before
   begins. */
static double least_of(const seen *v, close *pair, int count, int before, double turn,
                       const fw_geometry_segment *now, int *worst) {
    const double rounding = 1e-12;
    double least = lasts(v, &pair[before], turn, now);
    *worst = before;
    for (int i = 0; i < count; i++) {
        if (i == before || pair[i].until - turn > least + rounding) continue;
        const double left = lasts(v, &pair[i], turn, now);
        pair[i].until = turn + left;
        if (left < least || (left == least && i < *worst)) least = left, *worst = i;
    }
    pair[before].until = turn; /* it is looked at the next time */
    return least;
}

/* steps of the rotation, one way; the pair that is not proved to stay apart, or NULL */
static const close *step_through(const seen *v, close *pair, int count, double most,
                                 fw_geometry_segment *now) {
    double turn = 0, sign = most < 0 ? -1 : 1;
    int worst = 0;
    for (int i = 0; i < count; i++)
        pair[i].until = 0;
    for (int steps = 0; steps < MOST_STEPS; steps++) {
        bend_all(v, sign * turn, now);
        const double least = least_of(v, pair, count, worst, turn, now, &worst);
        if (least <= 1e-3 * fabs(most)) return &pair[worst];
        turn += least;
        if (turn >= fabs(most)) return NULL;
    }
    return pair;
}

/* the same from the distance of the middle, which costs a tenth */
static bool is_far(const seen *v, const piece *p, const fw_geometry_segment *edge) {
    const double d = fw_geometry_segment_nearest(edge, p->middle, NULL, NULL) - p->half_m;
    return room(d, v->wall_m) > p->bent_m;
}

/* pieces that an edge may meet go to the list; false: it folds onto its own root there */
static bool list_pairs(const seen *v, const fw_clearance_edge *edge, close *pair, int *count) {
    const fw_geometry_box box = fw_segment_box(&edge->segment);
    for (int i = 0; i < v->count; i++) {
        const piece *p = &v->piece[i];
        if (fw_box_gap(box, p->box) > p->bent_m + v->wall_m) continue;
        if (is_far(v, p, &edge->segment) || kept_off(v, p, 0, 1, 0, &edge->segment)) continue;
        if (p->from_m <= fw_root_m) return false;
        pair[(*count)++] = (close){i, edge, 0};
    }
    return true;
}

static fw_status from_body(fw_arena *arena, const fw_clearance_solid *solid, bool upper, seen *v,
                           const fw_clearance_edge **met) {
    int count = 0;
    fw_geometry_box all;
    double most = 0;
    FW_TRY(see(arena, v, upper));
    close *pair = fw_arena_raw(arena, (size_t)v->count * (size_t)solid->count * sizeof *pair + 1);
    fw_geometry_segment *now = fw_arena_array(arena, fw_geometry_segment, (size_t)v->count + 1);
    FW_NEED(pair && now ? pair : NULL);
    for (int i = 0; i < v->count; i++) {
        all = i ? fw_box_join(all, v->piece[i].box) : v->piece[i].box;
        most = fmax(most, v->piece[i].bent_m + v->wall_m);
    }
    for (int e = 0; e < solid->count && v->count > 0 && !*met; e++) {
        const fw_clearance_edge *edge = &solid->edge[e];
        if (edge->bends || fw_box_gap(fw_segment_box(&edge->segment), all) > most) continue;
        if (!list_pairs(v, edge, pair, &count)) *met = edge;
    }
    for (int way = -1; way <= 1 && !*met && count > 0; way += 2) {
        const close *worst = step_through(v, pair, count, way * v->bend->turn_rad, now);
        if (worst) *met = worst->edge;
    }
    return FW_OK;
}

fw_status fw_clearance_strip_meets(fw_arena *arena, const fw_clearance_things *things,
                                   const fw_clearance_strip *strip, const fw_clearance_bend *bend,
                                   double wall_m, const fw_clearance_edge **met) {
    fw_mark mark = fw_arena_mark(arena);
    seen v = {.strip = strip, .bend = bend, .wall_m = wall_m};
    *met = NULL;
    for (int side = 0; side < 2 && !*met; side++) {
        int body = side ? strip->hinge->upper : strip->hinge->lower;
        int solid = body >= 0 && body < things->nbody ? body : things->nbody;
        FW_TRY(from_body(arena, &things->solid[solid], side == 1, &v, met));
    }
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
