/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes over the field, each with the few edges that matter in it. */
#include "release/release_field.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

/* without zeros: what is added is written whole */
static void *grown(fw_arena *arena, const void *old, size_t count, size_t room, size_t size) {
    void *block = room <= SIZE_MAX / size ? fw_arena_raw(arena, room * size) : NULL;
    if (block && count > 0) memcpy(block, old, count * size);
    return block;
}

fw_status fw_release_level_room(fw_release_level *l, fw_arena *arena, size_t edges) {
    if ((size_t)l->nbox + 1 > l->box_room) {
        size_t more = l->box_room ? 2 * l->box_room : 1024;
        FW_NEED(l->box = grown(arena, l->box, (size_t)l->nbox, more, sizeof *l->box));
        l->box_room = more;
    }
    if ((size_t)l->nlist + edges > l->list_room) {
        size_t more = 2 * l->list_room + edges + 8192;
        FW_NEED(l->list = grown(arena, l->list, (size_t)l->nlist, more, sizeof *l->list));
        l->list_room = more;
    }
    if (edges > l->far_room) {
        FW_NEED(l->far_m = fw_arena_raw(arena, edges * sizeof *l->far_m));
        l->far_room = edges;
    }
    return FW_OK;
}

/* Keeps of the edges `from` (n) those that matter in a box of middle (x, y): open ones that may be
   nearest to any of its points, and all that run through the circle about it. With h the radius of
   that circle and d the distance of its middle from the nearest open edge, no point of the box is
   farther than d + h from one, and an edge farther than d + 2 h from the middle is farther than that
   from all of its points. Most edges are told by the circle around them. most_m: the middle is surely no
   farther from an open edge. */
static fw_status add_box(const fw_release_field *f, const int *from, int n, double x, double y,
                         double half_m, double most_m, int part, fw_release_level *to) {
    fw_geometry_vec2 c = {x, y};
    FW_TRY(fw_release_level_room(to, f->arena, (size_t)n));
    double h = 1.4142135623730951 * half_m, near = HUGE_VAL, *far = to->far_m;
    int *list = to->list + to->nlist, some = 0, kept = 0;
    double open_within = most_m + 2.0 * h;
    for (int i = 0; i < n; i++) {
        const fw_release_edge *e = &f->edge[from[i]];
        double dx = e->about.x - x, dy = e->about.y - y;
        double within = (e->open ? open_within : h) + e->around;
        if (dx * dx + dy * dy > within * within) continue;
        double d = fw_release_edge_distance(e, c);
        if (e->open && d < near) {
            near = d;
            if (near + 2.0 * h < open_within) open_within = near + 2.0 * h;
        }
        if (d > h && (!e->open || d > open_within)) continue;
        far[some] = d;
        list[some++] = from[i];
    }
    for (int i = 0; i < some; i++)
        if (far[i] <= h || far[i] <= near + 2.0 * h) list[kept++] = list[i];
    to->box[to->nbox++] = (fw_release_box){.x = x,
                                           .y = y,
                                           .half_m = half_m,
                                           .first = to->nlist,
                                           .count = kept,
                                           .part = part,
                                           .near_m = near};
    to->nlist += kept;
    return FW_OK;
}

fw_status fw_release_level_split(const fw_release_field *f, const fw_release_level *level,
                                 const fw_release_box *box, fw_release_level *next) {
    double q = 0.5 * box->half_m, most = box->near_m + 1.4142135623731 * q;
    for (int k = 0; k < 4; k++)
        FW_TRY(add_box(f, level->list + box->first, box->count, box->x + (k & 1 ? q : -q),
                       box->y + (k & 2 ? q : -q), q, most, box->part, next));
    return FW_OK;
}

const fw_release_edge *fw_release_nearest(const fw_release_field *f, const int *list, int n,
                                          fw_geometry_vec2 p, double most_m, double *near_m) {
    const fw_release_edge *nearest = NULL;
    *near_m = HUGE_VAL;
    for (int i = 0; i < n; i++) {
        const fw_release_edge *e = &f->edge[list[i]];
        double dx = e->about.x - p.x, dy = e->about.y - p.y, within = most_m + e->around;
        if (!e->open || dx * dx + dy * dy > within * within) continue;
        double d = fw_release_edge_distance(e, p);
        if (d < *near_m) *near_m = d, nearest = e;
        if (d < most_m) most_m = d;
    }
    return nearest;
}

bool fw_release_box_cut(const fw_release_field *f, const fw_release_level *level,
                        const fw_release_box *box) {
    fw_geometry_vec2 c = {box->x, box->y};
    double h = fw_release_box_about(box);
    if (box->near_m <= h) return true;
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &f->edge[level->list[box->first + i]];
        if (!e->open && fw_release_edge_distance(e, c) <= h) return true;
    }
    return false;
}

void fw_release_box_settle(fw_release_field *f, fw_release_box *box) {
    if (box->part == FW_RELEASE_MIXED)
        box->part = fw_release_field_part(f, (fw_geometry_vec2){box->x, box->y});
}

/* ---- the upper bound ---- */

/* f(p) <= value + slope (p - c) + bend |p - c|^2 / 2 for all points of the box on the same side of the edge as its
   middle; on the other side, where the edge runs through the box, f(p) <= beyond */
typedef struct tangent {
    double value, bend, beyond;
    fw_geometry_vec2 slope;
    double curve,
        ray; /* of an arc: +1 seen from outside, -1 from inside, else 0; from its centre to c */
    fw_geometry_vec2 centre;
} tangent;

/* do all points of the circle h about p project into the edge itself, not to its ends? */
static bool within(const fw_release_edge *e, fw_geometry_vec2 p, double h) {
    if (e->radius == 0.0) {
        double t = vec_dot(vec_sub(p, e->a), e->along);
        return t >= h && t <= e->length - h;
    }
    fw_geometry_vec2 ray = vec_sub(p, e->centre);
    double length = vec_length(ray);
    if (e->cosine <= -1.0 + 1e-15) return true;
    if (length <= h || vec_dot(ray, e->middle) < e->cosine * length) return false;
    for (int k = 0; k < 2; k++) { /* and the two radii to its ends do not run through the circle */
        fw_geometry_vec2 u = vec_scale(1.0 / e->radius, vec_sub(k ? e->b : e->a, e->centre));
        if (vec_dot(ray, u) > -h && fabs(vec_cross(u, ray)) < h) return false;
    }
    return true;
}

/* of the distance from an edge: from a line it bends nowhere, from the outside of an arc by one over the
   distance from its centre, from the inside the other way; and from anything whatever by no more than
   one over the distance itself, since it is no farther than the foot */
static tangent touch(const fw_release_edge *e, fw_geometry_vec2 c, double h) {
    double d = fw_release_edge_distance(e, c);
    tangent t = {.value = d, .bend = HUGE_VAL, .slope = {0, 0}};
    if (!(d > 1e-15)) return t;
    t.slope = vec_scale(1.0 / d, vec_sub(c, fw_release_edge_foot(e, c)));
    if (d > h) t.bend = 1.0 / (d - h);
    if (!within(e, c, h)) return t;
    t.beyond = d < h ? h - d : 0.0;
    if (e->radius == 0.0) {
        t.bend = 0.0;
        return t;
    }
    t.ray = vec_distance(c, e->centre), t.centre = e->centre;
    if (t.ray <= e->radius)
        t.curve = -1.0, t.bend = 0.0;
    else if (t.ray > h)
        t.curve = 1.0, t.bend = 1.0 / (t.ray - h);
    return t;
}

/* The bend of a mean (1 - w) s + w t of two arcs that face each other, one seen from inside, the other from
   outside. |p - C| - |p - D| bends by no more than 2/sqrt(3) |C - D|/l^2, l the least distance of the circle from
   what is between C and D: the third derivative of a length l is no more than 2/sqrt(3)/l^2. Nothing, for arcs
   about the same centre. */
static double facing(const tangent *s, const tangent *t, double w, double h) {
    double plain = s->bend + w * (t->bend - s->bend);
    if (s->curve * t->curve >= 0.0) return plain;
    double apart = vec_distance(s->centre, t->centre), out = s->curve > 0.0 ? 1.0 - w : w;
    double least = (s->ray < t->ray ? s->ray : t->ray) - h - apart;
    if (least <= 0.0) return plain;
    double both = out < 1.0 - out ? out : 1.0 - out;
    double bend = both * 1.1547005383792517 * apart / (least * least) +
                  (out - both) * (s->curve > 0.0 ? s->bend : t->bend);
    return bend < plain ? bend : plain;
}

static double most_of(const tangent *t, double h) {
    double here = t->value + vec_length(t->slope) * h + 0.5 * t->bend * h * h;
    return here > t->beyond ? here : t->beyond;
}

static double lesser(double a, double b) {
    return a < b ? a : b;
}

/* The least upper bound that a mean of tangents gives: min f_i <= sum w_i f_i for weights w that add up
   to 1. Where the nearest edges stand around a point their slopes cancel, and the bound is as near as the
   square of the box. A point on the other side of an edge that is used is no farther from it than `beyond`. Weights
   are found one edge after the other, each with the part that makes the mean slope shortest. In: box with its edges. Out: m, never below what is true; *up, *rise_m: a step inside
   from the middle to where two edges are as near, 0 where there is none. Source: concavity of the minimum;
   Frank and Wolfe's step. Test: test_reach.c, bounds_hold, wedges_beside_slots; test_reach_field.c,
   boxes_hold_what_they_say. */
double fw_release_box_most(const fw_release_field *f, const fw_release_level *level,
                           const fw_release_box *box, fw_geometry_vec2 *up, double *rise_m) {
    enum { ROUNDS = 4, LOOKED = 24 };
    fw_geometry_vec2 c = {box->x, box->y};
    double h = fw_release_box_about(box), best = box->near_m + h;
    tangent of[LOOKED];
    int n = 0, nearest = -1;
    *rise_m = 0.0;
    *up = (fw_geometry_vec2){0, 0};
    for (int i = 0; i < box->count && n < LOOKED; i++) {
        const fw_release_edge *e = &f->edge[level->list[box->first + i]];
        if (!e->open) continue;
        of[n] = touch(e, c, h);
        if (nearest < 0 || of[n].value < of[nearest].value) nearest = n;
        n++;
    }
    if (nearest < 0) return best;
    tangent mean = of[nearest];
    *up = mean.slope;
    double step = HUGE_VAL;
    for (int i = 0; i < n; i++) {
        double closing = 1.0 - vec_dot(of[i].slope, *up);
        if (i != nearest && closing > 1e-3)
            step = lesser(step, (of[i].value - mean.value) / closing);
    }
    *rise_m = step < HUGE_VAL ? step : 0.0;
    for (int k = 0; k < ROUNDS; k++) {
        best = lesser(best, most_of(&mean, h));
        double length = vec_length(mean.slope), least = HUGE_VAL;
        int pick = -1;
        if (length < 1e-9 || mean.bend == HUGE_VAL) break;
        fw_geometry_vec2 g = vec_scale(1.0 / length, mean.slope);
        for (int i = 0; i < n; i++) {
            double there = of[i].value + h * vec_dot(of[i].slope, g) + 0.5 * of[i].bend * h * h;
            if (there < least) least = there, pick = i;
        }
        if (pick < 0) break;
        fw_geometry_vec2 to = vec_sub(of[pick].slope, mean.slope);
        double square = vec_dot(to, to);
        if (square < 1e-12) break;
        double w = -vec_dot(mean.slope, to) / square;
        w = w < 0.0 ? 0.0 : w > 1.0 ? 1.0 : w;
        if (w == 0.0) break;
        mean.value += w * (of[pick].value - mean.value);
        mean.bend =
            k == 0 ? facing(&mean, &of[pick], w, h) : mean.bend + w * (of[pick].bend - mean.bend);
        if (of[pick].beyond > mean.beyond) mean.beyond = of[pick].beyond;
        mean.slope = vec_along(mean.slope, w, to);
    }
    return lesser(best, most_of(&mean, h));
}

/* The same for the part of a box on one side of a seam, where the seam alone runs through it: with the
   nearest edge's tangent, whose largest value over the half of the circle is on its arc where the slope
   points there, else at an end of its chord. HUGE_VAL where anything else runs through the circle. */
double fw_release_box_side(const fw_release_field *f, const fw_release_level *level,
                           const fw_release_box *box, const fw_release_edge *seam) {
    fw_geometry_vec2 c = {box->x, box->y}, in = vec_left(seam->along);
    double h = fw_release_box_about(box);
    const fw_release_edge *nearest = NULL;
    if (seam->radius > 0.0 || !within(seam, c, h)) return HUGE_VAL;
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &f->edge[level->list[box->first + i]];
        double d = fw_release_edge_distance(e, c);
        bool twin = vec_same(e->a, seam->b) && vec_same(e->b, seam->a);
        if (d <= h && e != seam && !twin) return HUGE_VAL;
        if (e->open && d <= box->near_m) nearest = e;
    }
    if (!nearest) return HUGE_VAL;
    tangent t = touch(nearest, c, h);
    double m = vec_dot(vec_sub(seam->a, c), in); /* the half has in . step >= m */
    double length = vec_length(t.slope), most = h * length;
    if (vec_dot(t.slope, in) * h < m * length)
        most = vec_dot(t.slope, in) * m +
               fabs(vec_cross(t.slope, in)) * sqrt(fmax(h * h - m * m, 0.0));
    return t.value + most + 0.5 * t.bend * h * h;
}
