/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much of what must stay is still bonded after a reach r: the area where the distance to the nearest
   opening is above r.

   Boxes as in release_search.c, down to a fortieth of the part's greatest distance, or less soon where one
   straight edge alone is near. In a box the distance is taken to be linear, with the slope at its middle,
   which is exact beside one straight edge. In: field, parts with reach_m. Out: bonded_m2 (m2) for the
   reaches k reach_m/FW_RELEASE_STEPS; that of reach 0 is the exact area. Error: below 1 % of the area
   (strip, disc, square: below 0.3 %). Test: test_reach.c, bonds_shrink_as_in_closed_form. */
#include "release/release_field.h"
#include <math.h>

static const double FINE = 40.0;

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
    double *whole; /* (npart x (FW_RELEASE_STEPS + 1)) of boxes that are bonded up to there */
} bond;

static void add_box(bond *b, int part, double near_m, fw_geometry_vec2 slope, double half_m) {
    fw_release_part *p = &b->part[part];
    double area = 4.0 * half_m * half_m, step = p->reach_m / FW_RELEASE_STEPS;
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

/* the finest size that a part of the box asks for; HUGE_VAL: nothing of it must stay */
static double finest(const bond *b, const fw_release_level *level, const fw_release_box *box) {
    double least = HUGE_VAL;
    if (box->part != FW_RELEASE_MIXED)
        return stays(b, box->part) ? b->part[box->part].reach_m / FINE : HUGE_VAL;
    for (int i = 0; i < box->count; i++) {
        int part = b->field->edge[level->list[box->first + i]].part;
        for (int k = 0; part == FW_RELEASE_SEVERAL && k < b->field->npart; k++)
            if (stays(b, k)) least = fmin(least, b->part[k].reach_m / FINE);
        if (stays(b, part)) least = fmin(least, b->part[part].reach_m / FINE);
    }
    return least;
}

static fw_status look(bond *b, const fw_release_level *level, fw_release_box *box,
                      fw_release_level *next) {
    fw_geometry_vec2 c = {box->x, box->y}, foot, at = c;
    const fw_release_edge *nearest = NULL;
    int open = 0;
    bool cut = box->part == FW_RELEASE_MIXED && fw_release_box_cut(b->field, level, box);
    if (!cut) fw_release_box_settle(b->field, box);
    double fine = finest(b, level, box);
    if (fine == HUGE_VAL) return FW_OK;
    for (int i = 0; i < box->count; i++) {
        const fw_release_edge *e = &b->field->edge[level->list[box->first + i]];
        if (!e->open) continue;
        double d = fw_release_edge_distance(e, c, &foot);
        if (!nearest || d <= box->near_m) nearest = e, at = foot;
        open++;
    }
    bool linear = !cut && open == 1 && nearest->radius == 0.0;
    if (!linear && box->half_m > fine) return fw_release_level_split(b->field, level, box, next);
    int part = cut ? fw_release_field_part(b->field, c) : box->part;
    if (stays(b, part))
        add_box(b, part, box->near_m, vec_scale(1.0 / box->near_m, vec_sub(c, at)), box->half_m);
    return FW_OK;
}

static void sum_up(bond *b) {
    for (int i = 0; i < b->field->npart; i++) {
        double above = 0.0, *whole = b->whole + i * (FW_RELEASE_STEPS + 1);
        fw_release_part *p = &b->part[i];
        for (int k = FW_RELEASE_STEPS; k >= 0; k--) {
            above += whole[k];
            p->bonded_m2[k] = fmin(p->bonded_m2[k] + above, p->area_m2);
        }
        p->bonded_m2[0] = p->area_m2;
        p->bonded_m2[FW_RELEASE_STEPS] = 0.0;
    }
}

fw_status fw_release_measure(fw_release_field *field, fw_release_part *part) {
    bond b = {.field = field, .part = part};
    fw_release_level level[2] = {{0}, {0}};
    FW_NEED(b.whole =
                fw_arena_array(field->arena, double, (size_t)field->npart *(FW_RELEASE_STEPS + 1)));
    FW_TRY(fw_release_level_first(field, &level[0]));
    for (int k = 0; level[k].nbox > 0; k = 1 - k) {
        level[1 - k].nbox = level[1 - k].nlist = 0;
        if (fw_arena_cancelled(field->arena)) return FW_CANCELLED;
        for (int i = 0; i < level[k].nbox; i++)
            FW_TRY(look(&b, &level[k], &level[k].box[i], &level[1 - k]));
    }
    sum_up(&b);
    return FW_OK;
}
