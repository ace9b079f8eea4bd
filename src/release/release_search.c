/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an etch leaves of every part, searched over boxes of the field: the distance of its worst point, and the area
   that is still bonded after any reach. */
#include "release/release_field.h"
#include <math.h>

/* ---- the worst point of every part: branch and bound over boxes, all parts at once ----
   d(p), the distance to the nearest open edge, is continuous with slope 1. Of every box an upper bound
   of d is known (fw_release_box_most); of every part the largest d that was found at one of its points.
   A box is given up where its bound is not above the best of every part that it may hold by more than
   the tolerance; else it is quartered. In: field with edges of parts, m. Out: reach_m, at, and most_m,
   which no point of the part exceeds: the larger of reach_m with the tolerance and of bounds of boxes that
   became too small. Error: 5e-4 of the distance, at least 5 nm. Cost: boxes times the few edges near each;
   of a straight strip a number that does not depend on its length over its width, since two sides that
   face each other bound it exactly. Theory: docs/theory/release.md. Tests: test_reach.c, and
   tests/release against an independent program. */

static const double RELATIVE = 5e-4, LEAST_M = 5e-9, SMALLEST_M = 1e-9;

static double enough(const fw_release_part *p) {
    double more = RELATIVE * p->reach_m;
    return p->reach_m + (more > LEAST_M ? more : LEAST_M);
}

enum { FEW = 40 }; /* edges of a box in which seams are tried */

typedef struct search {
    fw_release_field *field;
    fw_release_part *part;
    double least_m; /* the least that is enough for any part */
    int boxes;
} search;

static void found(fw_release_part *p, double reach_m, fw_geometry_vec2 at) {
    if (reach_m <= p->reach_m) return;
    p->reach_m = reach_m;
    p->at = at;
}

/* d anywhere in the circle about the box: one of its edges is nearest */
static double distance_at(const search *s, const fw_release_level *level, const fw_release_box *box,
                          fw_geometry_vec2 p) {
    double near;
    fw_release_nearest(s->field, level->list + box->first, box->count, p, HUGE_VAL, &near);
    return near;
}

static void try_step(search *s, const fw_release_level *level, const fw_release_box *box,
                     fw_geometry_vec2 up, double rise_m, bool pure) {
    fw_geometry_vec2 p = {box->x + rise_m * up.x, box->y + rise_m * up.y};
    if (!(rise_m > 0.0) || fabs(p.x - box->x) > box->half_m || fabs(p.y - box->y) > box->half_m)
        return;
    double there = distance_at(s, level, box, p);
    int part = pure ? box->part : fw_release_field_part(s->field, p);
    if (part >= 0) found(&s->part[part], there, p);
}

/* A part ends at its seams, beyond which the distance may go on growing: their points are its own, too. */
static void try_seams(search *s, const fw_release_level *level, const fw_release_box *box) {
    double h = fw_release_box_about(box);
    fw_geometry_vec2 c = {box->x, box->y};
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &s->field->edge[level->list[box->first + i]];
        if (e->open || e->part < 0 || fw_release_edge_distance(e, c) > h) continue;
        fw_geometry_vec2 at = fw_release_edge_foot(e, c);
        found(&s->part[e->part], distance_at(s, level, box, at), at);
    }
}

/* could any part that the box may hold have a worse point in it? */
static bool matters(const search *s, const fw_release_level *level, const fw_release_box *box,
                    bool cut, double most) {
    double h = fw_release_box_about(box);
    fw_geometry_vec2 c = {box->x, box->y};
    if (!cut) return box->part >= 0 && most > enough(&s->part[box->part]);
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &s->field->edge[level->list[box->first + i]];
        if (e->part == FW_RELEASE_OPENING) continue;
        if (most <= (e->part >= 0 ? enough(&s->part[e->part]) : s->least_m)) continue;
        if (fw_release_edge_distance(e, c) > h) continue;
        if (e->open || e->part < 0) return true;
        if (fw_release_box_side(s->field, level, box, e) > enough(&s->part[e->part])) return true;
    }
    return false;
}

/* too small to go on: its bound is the part's */
static void give_up(search *s, const fw_release_level *level, const fw_release_box *box,
                    double most) {
    if (box->part >= 0) {
        s->part[box->part].most_m = fmax(s->part[box->part].most_m, most);
        return;
    }
    for (int i = 0; i < box->count; i++) {
        int part = s->field->edge[level->list[box->first + i]].part;
        for (int k = 0; part == FW_RELEASE_SEVERAL && k < s->field->npart; k++)
            s->part[k].most_m = fmax(s->part[k].most_m, most);
        if (part >= 0) s->part[part].most_m = fmax(s->part[part].most_m, most);
    }
}

/* could it, as far as is known before its edges are looked at? No point is farther than `most` */
static bool may_matter(const search *s, const fw_release_level *level, const fw_release_box *box,
                       bool cut, double most) {
    if (!cut) return box->part >= 0 && most > enough(&s->part[box->part]);
    for (int i = 0; i < box->count; i++) {
        const int part = s->field->edge[level->list[box->first + i]].part;
        if (part != FW_RELEASE_OPENING && most > (part >= 0 ? enough(&s->part[part]) : s->least_m))
            return true;
    }
    return false;
}

static fw_status search_box(search *s, const fw_release_level *level, fw_release_box *box,
                            fw_release_level *next) {
    fw_geometry_vec2 up, c = {box->x, box->y};
    double rise, most;
    bool known = box->part != FW_RELEASE_MIXED, cut = !known;
    s->boxes++;
    if (!known) cut = fw_release_box_cut(s->field, level, box);
    if (!cut) fw_release_box_settle(s->field, box);
    if (!may_matter(s, level, box, cut, box->near_m + fw_release_box_about(box))) return FW_OK;
    most = fw_release_box_most(s->field, level, box, &up, &rise);
    if (!matters(s, level, box, cut, most)) return FW_OK;
    int part = cut ? fw_release_field_part(s->field, c) : box->part;
    if (part >= 0) found(&s->part[part], box->near_m, c);
    try_step(s, level, box, up, rise, !cut);
    if (cut && box->count <= FEW) try_seams(s, level, box);
    if (!matters(s, level, box, cut, most)) return FW_OK;
    if (box->half_m < SMALLEST_M) {
        give_up(s, level, box, most);
        return FW_OK;
    }
    return fw_release_level_split(s->field, level, box, next);
}

fw_status fw_release_search(fw_release_field *field, fw_release_part *part, int *boxes) {
    search s = {field, part, 0.0, 0};
    fw_release_level level[2] = {{0}, {0}}, *from = &field->start; /* by turns, each used again */
    for (int k = 0; from->nbox > 0; from = &level[k], k = 1 - k) {
        level[k].nbox = level[k].nlist = 0;
        s.least_m = HUGE_VAL;
        for (int i = 0; i < field->npart; i++)
            s.least_m = fmin(s.least_m, enough(&part[i]));
        if (fw_arena_cancelled(field->arena)) return FW_CANCELLED;
        for (int i = 0; i < from->nbox; i++)
            FW_TRY(search_box(&s, from, &from->box[i], &level[k]));
    }
    for (int i = 0; i < field->npart; i++)
        part[i].most_m = fmax(part[i].most_m, enough(&part[i]));
    *boxes = s.boxes;
    return FW_OK;
}

/* ---- how much of what must stay is still bonded after a reach r ----
   The area where the distance to the nearest opening is above r. Boxes as above; where few edges are near, and not
   one straight edge alone, a box is a raster of cells of at most a FINE-th of the part's greatest distance. In a
   cell the distance is taken to be linear, with the slope at its middle, which is exact beside one straight edge.
   Up to a reach of a seventh of the greatest, or of half of what all that moves needs where that is less, the area is
   taken from the exact area and the length of the edges, so that no corner of lettering is looked at: nobody stops an
   etch there. Cells near edges are at most a third of that need, so that narrow arms of wide parts count. In: field, parts with reach_m. Out: bonded_m2 (m2) for the reaches
   k reach_m/FW_RELEASE_STEPS. Error: below 2 % of the area (strip, disc, square). Test: test_reach.c,
   bonds_shrink_as_in_closed_form. */

static const double FINE = 24.0;
enum { EVEN = 9 }; /* of FW_RELEASE_STEPS: up to here by a parabola */
static const double PARABOLA = 0.5, NEAR = 2.0,
                    CELL = 6.0; /* of what is needed; of half a cell: its share */

/* share of the square |x|, |y| <= a in which g x + k y > t, a > 0 */
static double share_above(double g, double k, double a, double t) {
    double p = fabs(g) * a, q = fabs(k) * a;
    if (p < q) {
        double other = p;
        p = q, q = other;
    }
    if (t >= p + q) return 0.0;
    if (t <= -p - q) return 1.0;
    if (t < 0.0) return 1.0 - share_above(g, k, a, -t);
    if (t <= p - q) return 0.5 - t / (2.0 * p); /* a strip with parallel ends */
    double corner = p + q - t;
    return corner * corner / (8.0 * p * q);
}

typedef struct bond {
    fw_release_field *field;
    fw_release_part *part;
    double needed_m; /* of all that moves; HUGE_VAL: nothing does */
    double *whole;   /* (npart x (FW_RELEASE_STEPS + 1)) of boxes that are bonded up to there */
    fw_release_crossing *row;
} bond;

static void add_box(bond *b, int part, double near_m, fw_geometry_vec2 slope, double half_m,
                    double share) {
    fw_release_part *p = &b->part[part];
    double area = share * 4.0 * half_m * half_m, step = p->reach_m / FW_RELEASE_STEPS;
    double spread = (fabs(slope.x) + fabs(slope.y)) * half_m;
    int low = (int)floor((near_m - spread) / step), high = (int)ceil((near_m + spread) / step);
    if (low > FW_RELEASE_STEPS) low = FW_RELEASE_STEPS;
    if (high > FW_RELEASE_STEPS) high = FW_RELEASE_STEPS;
    if (low >= 0) b->whole[part * (FW_RELEASE_STEPS + 1) + low] += area;
    for (int k = low < 0 ? 0 : low + 1; k <= high; k++)
        p->bonded_m2[k] += area * share_above(slope.x, slope.y, half_m, k * step - near_m);
}

static bool stays(const bond *b, int part) {
    return part >= 0 && b->part[part].duty == FW_RELEASE_STAYS && b->part[part].reach_m > 0.0;
}

/* greatest distance of the least part that may be in the box; HUGE_VAL: nothing of it must stay */
static double least_of(const bond *b, const fw_release_level *level, const fw_release_box *box) {
    double least = HUGE_VAL;
    if (box->part != FW_RELEASE_MIXED)
        return stays(b, box->part) ? b->part[box->part].reach_m : HUGE_VAL;
    for (int i = 0; i < box->count; i++) {
        int part = b->field->edge[level->list[box->first + i]].part;
        for (int k = 0; part == FW_RELEASE_SEVERAL && k < b->field->npart; k++)
            if (stays(b, k)) least = fmin(least, b->part[k].reach_m);
        if (stays(b, part)) least = fmin(least, b->part[part].reach_m);
    }
    return least;
}

/* Beside one straight edge, and nothing else, the distance is linear all over the box: it needs no
   quarters. */
static bool beside_line(const fw_release_edge *e, const fw_release_box *box) {
    fw_geometry_vec2 from = {box->x - e->a.x, box->y - e->a.y};
    double t = vec_dot(from, e->along), h = fw_release_box_about(box);
    return e->radius == 0.0 && t >= h && t <= e->length - h;
}

/* The seams that run all through a cell, each with the share of the cell on its left, which is its part's: a long
   seam along the rows of a raster would else move by up to half a cell. 0: none, or not all of the way. */
static int seams_of(const bond *b, const int *list, int n, fw_geometry_vec2 c, double half,
                    int part[2], double share[2]) {
    int found = 0;
    for (int i = 0; i < n; i++) {
        const fw_release_edge *e = &b->field->edge[list[i]];
        if (e->open || e->part < 0 || e->radius > 0.0) continue;
        fw_geometry_vec2 from = vec_sub(c, e->a);
        double t = vec_dot(from, e->along), left = vec_cross(e->along, from);
        double wide = half * (fabs(e->along.x) + fabs(e->along.y));
        if (fabs(left) >= wide || t <= -wide || t >= e->length + wide) continue;
        if (t < wide || t > e->length - wide || found == 2) return 0;
        part[found] = e->part;
        share[found++] = share_above(-e->along.y, e->along.x, half, -left);
    }
    return found;
}

/* (n x n) cells of a box; of a row the parts are found at once, where there may be several and it matters. A
   cell counts for nothing where it is nearer than from_m. */
static void add_raster(bond *b, const fw_release_level *level, const fw_release_box *box, int n,
                       double from_m) {
    double half = box->half_m / n, left = box->x - box->half_m;
    const int *list = level->list + box->first;
    bool mixed = box->part == FW_RELEASE_MIXED;
    for (int j = 0; j < n; j++) {
        double y = box->y - box->half_m + (2 * j + 1) * half, near = HUGE_VAL;
        int crossings = -1, k = 0, part = box->part;
        for (int i = 0; i < n; i++) {
            fw_geometry_vec2 c = {left + (2 * i + 1) * half, y};
            const fw_release_edge *nearest =
                fw_release_nearest(b->field, list, box->count, c, near + 2.000001 * half, &near);
            if (!nearest || !(near > 0.0) || near + 1.5 * half < from_m) continue;
            if (mixed && crossings < 0)
                crossings = fw_release_field_row(b->field, y, left, box->x + box->half_m, b->row);
            while (k < crossings && b->row[k].x <= c.x)
                k++;
            if (mixed) part = b->row[k].part;
            int beside[2] = {part, part};
            double share[2] = {1.0, 0.0};
            int parts = mixed ? seams_of(b, list, box->count, c, half, beside, share) : 0;
            fw_geometry_vec2 slope =
                vec_scale(1.0 / near, vec_sub(c, fw_release_edge_foot(nearest, c)));
            for (int m = 0; m < (parts > 0 ? parts : 1); m++)
                if (stays(b, beside[m])) add_box(b, beside[m], near, slope, half, share[m]);
        }
    }
}

/* the reach up to which no box counts, of parts that reach no less than `least` */
static double from_of(const bond *b, double least) {
    return fmin(EVEN * least / FW_RELEASE_STEPS, PARABOLA * b->needed_m);
}

static fw_status measure_box(bond *b, const fw_release_level *level, fw_release_box *box,
                             fw_release_level *next) {
    enum { MANY = 16 };
    double most = box->near_m + fw_release_box_about(box);
    if (box->part == FW_RELEASE_MIXED && !fw_release_box_cut(b->field, level, box))
        fw_release_box_settle(b->field, box);
    double least = least_of(b, level, box), fine = least / FINE;
    if (least == HUGE_VAL || most < from_of(b, least)) return FW_OK;
    if (box->near_m - fw_release_box_about(box) < NEAR * b->needed_m)
        fine = fmin(fine, b->needed_m / CELL);
    bool line = box->part != FW_RELEASE_MIXED && box->count == 1 &&
                beside_line(&b->field->edge[level->list[box->first]], box);
    if (!line && box->count > MANY && box->half_m > 2.0 * fine)
        return fw_release_level_split(b->field, level, box, next);
    add_raster(b, level, box, line ? 1 : (int)ceil(box->half_m / fine), from_of(b, least));
    return FW_OK;
}

/* the first steps: a parabola from the area, which falls by the length of the edges, to where boxes count */
static void start(const bond *b, fw_release_part *p, double edge_m) {
    double step = p->reach_m / FW_RELEASE_STEPS, steps = ceil(from_of(b, p->reach_m) / step);
    int even = steps > EVEN ? EVEN : (int)steps;
    double fall = p->area_m2 - p->bonded_m2[even];
    double bend =
        fmin(fmax(edge_m * even * step - fall, 0.0), fall); /* fall more slowly, never rise */
    for (int k = 0; k < even; k++) {
        double x = (double)k / even;
        p->bonded_m2[k] = p->area_m2 - (fall + bend) * x + bend * x * x;
    }
}

static void sum_up(bond *b, const double *edge) {
    for (int i = 0; i < b->field->npart; i++) {
        double above = 0.0, *whole = b->whole + i * (FW_RELEASE_STEPS + 1);
        fw_release_part *p = &b->part[i];
        for (int k = FW_RELEASE_STEPS; k >= 0; k--) {
            above += whole[k];
            p->bonded_m2[k] = fmin(p->bonded_m2[k] + above, p->area_m2);
        }
        start(b, p, edge[i]);
        p->bonded_m2[FW_RELEASE_STEPS] = 0.0;
    }
}

static double needed_of(const fw_release_part *part, int npart) {
    double needed = 0.0;
    for (int i = 0; i < npart; i++)
        if (part[i].duty == FW_RELEASE_MOVES) needed = fmax(needed, part[i].reach_m);
    return needed > 0.0 ? needed : HUGE_VAL;
}

fw_status fw_release_measure(fw_release_field *field, fw_release_part *part) {
    bond b = {.field = field, .part = part, .needed_m = needed_of(part, field->npart)};
    fw_release_level level[2] = {{0}, {0}}, *from = &field->start;
    FW_NEED(b.whole =
                fw_arena_array(field->arena, double, (size_t)field->npart *(FW_RELEASE_STEPS + 1)));
    FW_NEED(b.row = fw_arena_raw(field->arena, ((size_t)field->nclimb + 1) * sizeof *b.row));
    for (int k = 0; from->nbox > 0; from = &level[k], k = 1 - k) {
        level[k].nbox = level[k].nlist = 0;
        if (fw_arena_cancelled(field->arena)) return FW_CANCELLED;
        for (int i = 0; i < from->nbox; i++)
            FW_TRY(measure_box(&b, from, &from->box[i], &level[k]));
    }
    double *edge = fw_arena_array(field->arena, double, (size_t)field->npart);
    FW_NEED(edge);
    for (int i = 0; i < field->nedge; i++) {
        const fw_release_edge *e = &field->edge[i];
        double length = e->radius > 0.0 ? 2.0 * e->radius * acos(e->cosine) : e->length;
        if (e->open && e->part >= 0) edge[e->part] += length;
    }
    sum_up(&b, edge);
    return FW_OK;
}
