/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worst point of every part: branch and bound over boxes, all parts at once.

   d(p), the distance to the nearest open edge, is continuous with slope 1. Of every box an upper bound
   of d is known (fw_release_box_most); of every part the largest d that was found at one of its points.
   A box is given up where its bound is not above the best of every part that it may hold by more than
   the tolerance; else it is quartered. In: field with edges of parts, m. Out: reach_m, at, and most_m,
   which no point of the part exceeds: the larger of reach_m with the tolerance and of bounds of boxes that
   became too small. Error: 5e-4 of the distance, at least 5 nm. Cost: boxes times the few edges near each;
   of a straight strip a number that does not depend on its length over its width, since two sides that
   face each other bound it exactly. Theory: docs/theory/release.md. Tests: test_reach.c, and
   tests/release against an independent program. */
#include "release/release_field.h"
#include <math.h>

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

static fw_status look(search *s, const fw_release_level *level, fw_release_box *box,
                      fw_release_level *next) {
    fw_geometry_vec2 up, c = {box->x, box->y};
    double rise, most;
    bool known = box->part != FW_RELEASE_MIXED, cut = !known;
    s->boxes++;
    if (known && box->part < 0) return FW_OK;
    if (known && box->near_m + fw_release_box_about(box) <= enough(&s->part[box->part]))
        return FW_OK;
    most = fw_release_box_most(s->field, level, box, &up, &rise);
    if (!known) cut = fw_release_box_cut(s->field, level, box);
    if (!cut) fw_release_box_settle(s->field, box);
    if (!cut && box->part < 0) return FW_OK;
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
            FW_TRY(look(&s, from, &from->box[i], &level[k]));
    }
    for (int i = 0; i < field->npart; i++)
        part[i].most_m = fmax(part[i].most_m, enough(&part[i]));
    *boxes = s.boxes;
    return FW_OK;
}
