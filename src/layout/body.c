/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One outline per body: bars and plate, cut free of the hinges, united with its own hinge heads. */
#include "geometry/segment.h"
#include "base/constants.h"
#include "layout/draw.h"
#include <math.h>

enum { MOST_JOINTS = 16, MOST_PARTS = 3 * MOST_JOINTS + 8 };

typedef struct parts {
    fw_contour item[MOST_PARTS];
    int count;
} parts;

static bool has_plate(const fw_drawing *d, int body) {
    return body >= 0 && !isnan(d->device->body[body].plate_width_m);
}

static const fw_side *side_of(const fw_drawing *d, int joint, int body) {
    const fw_hinge_plan *plan = &d->hinge[joint];
    return &plan->side[plan->side[1].body == body];
}

/* One end of a bar: it starts inside the neck, crosses the neck's edges at a small angle and widens
   to its full width. Fills the edge from the hinge outwards; returns the number of points. */
static int bar_end(const fw_side *side, double half, double length, fw_vec2 *p) {
    double from = fmax(side->neck_end_m - 72e-6, side->solid_m);
    double slope = 6e-6 / (side->neck_end_m - from);
    double widen = fmin(half - side->neck_m + 4e-6, slope * (length - from));
    p[0] = fw_v(from, side->neck_m - 4e-6);
    p[1] = fw_v(from + widen / slope, side->neck_m - 4e-6 + widen);
    return 2;
}

/* mirrors the n points of one edge to the other and closes the outline; local x along the bar */
static fw_status close_bar(fw_drawing *d, fw_vec2 w, fw_vec2 direction, fw_vec2 *p, int n,
                           fw_contour *bar) {
    fw_local local = {w, direction.x, direction.y, false};
    for (int i = 0; i < n; i++)
        p[2 * n - 1 - i] = fw_v(p[i].x, -p[i].y);
    return fw_layout_polygon(d->arena, &local, p, 2 * n, -1, bar);
}

/* from hinge to `end` on the hinge's own direction, square end */
static fw_status draw_spoke(fw_drawing *d, int joint, const fw_side *side, double half, double end,
                            fw_contour *bar) {
    fw_vec2 p[8];
    int n = bar_end(side, half, end, p);
    p[n++] = fw_v(end, half);
    return close_bar(d, fw_joint_point(d->device, joint), side->direction, p, n, bar);
}

/* bar between two hinges of a body */
static fw_status draw_link(fw_drawing *d, int body, const int joint[2], fw_contour *bar) {
    fw_vec2 p[8], w = fw_joint_point(d->device, joint[0]), far[2];
    const fw_side *a = side_of(d, joint[0], body), *b = side_of(d, joint[1], body);
    double length = fw_norm(fw_sub(fw_joint_point(d->device, joint[1]), w));
    int n = bar_end(a, a->half_width_m, 0.5 * length, p);
    bar_end(b, b->half_width_m, 0.5 * length, far);
    for (int i = 1; i >= 0; i--)
        p[n++] = fw_v(length - far[i].x, far[i].y);
    return close_bar(d, w, a->direction, p, n, bar);
}

/* cuts the keep-out discs of the given hinges (all but those in `skip`) out of a part of a body;
   the pieces that are left are appended */
static fw_status cut_free(fw_drawing *d, int body, const fw_contour *part, const int *skip,
                          int nskip, parts *out) {
    fw_region region = {(fw_contour *)part, 1};
    for (int j = 0; j < d->device->njoint; j++) {
        const fw_hinge_layout *h = &d->layout->hinge[j];
        bool own = false;
        for (int i = 0; i < nskip; i++)
            own = own || skip[i] == j;
        if (own) continue;
        fw_contour disc;
        double radius = h->keep_out_m;
        if (h->lower == body || h->upper == body) radius += fw_head_wider(side_of(d, j, body));
        FW_TRY(fw_contour_disc(d->arena, h->centre, radius, &disc));
        if (!fw_contour_contains(part, h->centre) &&
            fw_contour_distance_below(part, &disc, 1e-9, NULL, NULL) > 0.0)
            continue;
        fw_region hole = {&disc, 1}, left;
        FW_TRY(fw_region_boolean(d->arena, &region, &hole, FW_DIFFERENCE, &left));
        region = left;
    }
    for (int i = 0; i < region.count && out->count < MOST_PARTS; i++)
        out->item[out->count++] = region.contour[i];
    return FW_OK;
}

/* the plate without the discs of the hinges; the necks of its own hinges reach into it */
static fw_status plate_parts(fw_drawing *d, int body, parts *out) {
    const fw_body *b = &d->device->body[body];
    double w = 0.5 * b->plate_width_m, h = 0.5 * b->plate_height_m;
    fw_local local = {fw_v(b->plate_x_m, b->plate_y_m), cos(b->plate_angle_rad),
                      sin(b->plate_angle_rad), false};
    fw_vec2 corner[4] = {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
    fw_contour plate;
    FW_TRY(fw_layout_polygon(d->arena, &local, corner, 4, -1, &plate));
    return cut_free(d, body, &plate, NULL, 0, out);
}

/* Where the spokes of a body with more than two hinges meet: in the middle of them. With hinges in
   line one of them is in the way of the others' spokes there; then (beside: only for bodies that
   cannot be drawn otherwise) the hub stands beside the line, on the side where no other body
   leaves, clear of the longest flexure. test_layout_hubs.c */
fw_vec2 fw_body_hub(const fw_drawing *d, int body) {
    const fw_device *device = d->device;
    fw_vec2 sum = fw_v(0.0, 0.0), along = sum, others = sum, first = sum;
    double clear = 0.0;
    int n = 0;
    for (int j = 0; j < device->njoint; j++) {
        const fw_joint *t = &device->joint[j];
        if (t->body_a != body && t->body_b != body) continue;
        fw_vec2 p = fw_joint_point(device, j);
        int other = t->body_a == body ? t->body_b : t->body_a;
        if (n++ == 0) first = p;
        if (fw_norm(fw_sub(p, first)) > fw_norm(along)) along = fw_sub(p, first);
        if (other >= 0 && isfinite(device->body[other].x_m + device->body[other].y_m))
            others = fw_add(others, 1.0,
                            fw_sub(fw_v(device->body[other].x_m, device->body[other].y_m), p));
        clear = fmax(clear, device->flexure[t->flexure].length_m);
        sum = fw_add(sum, 1.0, p);
    }
    fw_vec2 hub = fw_v(sum.x / n, sum.y / n);
    if (!d->beside || !d->beside[body]) return hub;
    double size = fw_norm(along);
    fw_vec2 out = size > 0.0 ? fw_left(fw_v(along.x / size, along.y / size)) : fw_v(0.0, 1.0);
    return fw_add(hub, (fw_dot(out, others) > 0.0 ? -1.0 : 1.0) * (clear + 100e-6), out);
}

static fw_status bar_parts(fw_drawing *d, int body, const int *joint, int njoint, parts *out) {
    fw_contour bar;
    if (njoint == 2) {
        FW_TRY(draw_link(d, body, joint, &bar));
        return cut_free(d, body, &bar, joint, 2, out);
    }
    fw_vec2 hub = fw_v(0.0, 0.0);
    double half = 0.0;
    for (int i = 0; i < njoint; i++) {
        fw_vec2 p = fw_joint_point(d->device, joint[i]);
        hub = fw_add(hub, 1.0 / njoint, p);
        half = side_of(d, joint[i], body)->half_width_m;
    }
    if (njoint > 2 && body >= 0) hub = fw_body_hub(d, body);
    if (njoint == 1 && body >= 0) hub = fw_v(d->device->body[body].x_m, d->device->body[body].y_m);
    if (njoint == 1 && body < 0) { /* the pedestal takes over before the frame */
        const fw_side *side = side_of(d, joint[0], body);
        double begin = side->neck_end_m, cut = fw_base_reach(d, joint[0]);
        hub = fw_add(hub, begin + 0.6 * (cut - begin), side->direction);
    }
    for (int i = 0; i < njoint; i++) {
        const fw_side *side = side_of(d, joint[i], body);
        double end = fw_norm(fw_sub(hub, fw_joint_point(d->device, joint[i])));
        FW_TRY(draw_spoke(d, joint[i], side, half, end, &bar));
        FW_TRY(cut_free(d, body, &bar, &joint[i], 1, out));
    }
    if (njoint > 2) { /* a hub under the inner ends */
        fw_contour disc;
        FW_TRY(fw_contour_disc(d->arena, hub, 1.3 * half, &disc));
        FW_TRY(cut_free(d, body, &disc, NULL, 0, out));
    }
    return FW_OK;
}

/* one simple outline, or FW_GEOMETRY */
fw_status fw_body_unite(fw_drawing *d, int body, const fw_contour *part, int npart,
                        fw_contour *out) {
    fw_region region = {(fw_contour *)part, 1};
    for (int i = 1; i < npart; i++) {
        fw_region next = {(fw_contour *)&part[i], 1}, both;
        FW_TRY(fw_region_boolean(d->arena, &region, &next, FW_UNION, &both));
        region = both;
    }
    if (region.count != 1) {
        const char *label = fw_body_label(d, body);
        FW_NEED(label);
        bool hole = false;
        for (int i = 0; i < region.count; i++)
            hole = hole || fw_contour_area(&region.contour[i]) < 0.0;
        fw_diag_error(d->diags, 123, fw_body_place(d, body),
                      "%s would %s; a body must be one outline without holes: move its plate or "
                      "hinges, or change the width of its bars",
                      label, hole ? "enclose a hole" : "fall apart where hinges cut it");
        return FW_GEOMETRY;
    }
    *out = region.contour[0];
    return FW_OK;
}

/* Corners of 10 um; where the parts are too small for that, 5, 2.5 or 1.25 um for the whole body.
   Fillets at the roots and conjugate surfaces meet their neighbours smoothly or keep their arcs. */
fw_status fw_body_round(fw_drawing *d, int body, const fw_contour *in, fw_contour *out,
                        double *radius_m, fw_vec2 *where) {
    for (double radius = FW_CORNER_M; radius > 1e-6; radius *= 0.5) {
        fw_status status = fw_contour_round(d->arena, in, radius, radius, out, where);
        *radius_m = radius;
        if (status != FW_GEOMETRY) return status;
    }
    char x[32], y[32];
    const char *label = fw_body_label(d, body);
    FW_NEED(label);
    fw_diag_error(d->diags, 126, fw_body_place(d, body),
                  "%s has a corner at (%s, %s) um that cannot be rounded by even 0.3 um; parts of "
                  "it nearly coincide: change a width or a position slightly",
                  label, fw_layout_um(x, where->x), fw_layout_um(y, where->y));
    return FW_GEOMETRY;
}

/* what is drawn of one body: its hinges, parts that only the base has, and where its eyelets stand
 */
typedef struct work {
    int body, slot, joint[MOST_JOINTS], njoint;
    const fw_contour *extra;
    int nextra, lug_shift, first_lug;
} work;

static fw_status unite_all(fw_drawing *d, const work *w) {
    parts *all;
    FW_NEED(all = fw_arena_one(d->arena, parts));
    if (has_plate(d, w->body))
        FW_TRY(plate_parts(d, w->body, all));
    else
        FW_TRY(bar_parts(d, w->body, w->joint, w->njoint, all));
    for (int i = 0; i < w->njoint; i++)
        all->item[all->count++] = side_of(d, w->joint[i], w->body)->head;
    for (int i = 0; i < w->nextra; i++)
        all->item[all->count++] = w->extra[i];
    FW_TRY(fw_body_unite(d, w->body, all->item, all->count, &d->raw[w->slot]));
    d->nlug = w->first_lug;
    if (w->body < 0 || !d->device->body[w->body].platform) return FW_OK;
    static const double shift_m[] = {0.0, 14e-6, -14e-6, 28e-6, -28e-6};
    fw_contour lug[4];
    int nlug = 0;
    FW_TRY(fw_platform_lugs(d, w->body, shift_m[w->lug_shift], lug, &nlug));
    for (int i = 0; i < nlug; i++) {
        fw_contour pair[2] = {d->raw[w->slot], lug[i]};
        FW_TRY(fw_body_unite(d, w->body, pair, 2, &d->raw[w->slot]));
    }
    return FW_OK;
}
enum { LUG_SHIFTS = 5 };

/* least width or space over its limit, and where; HUGE_VAL and nowhere above the limit */
static double share(const fw_contour *c, bool inside, double limit_m, fw_vec2 *where) {
    int i, j;
    double least = fw_contour_clearance_below(c, inside, limit_m, &i, &j);
    if (i < 0) return HUGE_VAL;
    fw_vec2 other;
    *where = c->segment[i].a;
    if (i != j) fw_segment_distance(&c->segment[i], &c->segment[j], where, &other);
    return least / limit_m;
}

/* least radius of an arc: where it turns by more than 45 degrees its neighbours nearly face each
   other, so that they are a width or a space across it; not at the root of a flexure */
static double arc_limit(const fw_contour *c, int i) {
    const fw_segment *s = &c->segment[i];
    int n = c->count;
    unsigned beside = c->segment[(i + 1) % n].flags | c->segment[(i + n - 1) % n].flags;
    bool hollow = s->sweep_rad < 0.0;
    bool tight = fabs(s->sweep_rad) > 0.25 * FW_PI;
    if (tight && !(beside & FW_SEGMENT_JOINT)) return hollow ? FW_OWN_BEND_M : FW_OWN_TIP_M;
    return hollow ? FW_OWN_HOLLOW_M : 1e-9;
}

/* How far an outline is from what a mask can show: the least of width, space and radius, each over
   its limit; >= 1 is good, and says nothing more. */
double fw_body_soundness(const fw_contour *c, fw_vec2 *where) {
    fw_vec2 slit = *where;
    double least = share(c, true, FW_OWN_WIDTH_M, where);
    double space = share(c, false, FW_OWN_SPACE_M, &slit);
    if (space < least) {
        least = space;
        *where = slit;
    }
    for (int i = 0; i < c->count; i++) {
        const fw_segment *s = &c->segment[i];
        double here = s->radius / arc_limit(c, i);
        if (s->kind != FW_ARC || !(here < least)) continue;
        least = here;
        *where = s->a;
    }
    return least;
}

static int nearest_joint(const fw_drawing *d, const work *w, fw_vec2 p) {
    int best = w->joint[0];
    for (int i = 1; i < w->njoint; i++)
        if (fw_norm(fw_sub(p, fw_joint_point(d->device, w->joint[i]))) <
            fw_norm(fw_sub(p, fw_joint_point(d->device, best))))
            best = w->joint[i];
    return best;
}

static bool near_lug(const fw_drawing *d, const work *w, fw_vec2 p) {
    for (int i = w->first_lug; i < d->nlug; i++) {
        fw_box b = fw_contour_box(&d->lug[i]);
        if (p.x > b.x0 - 8e-6 && p.x < b.x1 + 8e-6 && p.y > b.y0 - 8e-6 && p.y < b.y1 + 8e-6)
            return true;
    }
    return false;
}

/* one drawing of the body as its heads stand now; *sound 0 when it cannot be united (*where NaN) or
   rounded */
static fw_status attempt(fw_drawing *d, const work *w, double *sound, fw_vec2 *where) {
    *sound = 0.0;
    *where = fw_v((double)NAN, (double)NAN);
    FW_TRY(unite_all(d, w));
    FW_TRY(fw_body_round(d, w->body, &d->raw[w->slot], &d->plain[w->slot], &d->corner_m[w->slot],
                         where));
    *sound = fw_body_soundness(&d->plain[w->slot], where);
    return FW_OK;
}

static fw_status quiet_attempt(fw_drawing *d, const work *w, double *sound, fw_vec2 *where) {
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    d->diags = &unsaid;
    fw_status status = attempt(d, w, sound, where);
    d->diags = said;
    return status == FW_GEOMETRY ? FW_OK : status;
}

static fw_status choose_heads(fw_drawing *d, const work *w, const int *choice) {
    for (int i = 0; i < w->njoint; i++)
        if (side_of(d, w->joint[i], w->body)->choice != choice[i])
            FW_TRY(fw_head_draw(d, w->joint[i], w->body, choice[i]));
    return FW_OK;
}

/* the next thing to try where an outline is unsound: other eyelets, else another head there */
static bool vary(const fw_drawing *d, work *w, fw_vec2 where, int *choice) {
    if (isnan(where.x)) {
        bool exist = true;
        for (int i = 0; i < w->njoint; i++)
            exist = fw_head_exists(++choice[i]) && exist;
        return exist;
    }
    if (near_lug(d, w, where) && w->lug_shift + 1 < LUG_SHIFTS) {
        w->lug_shift++;
        return true;
    }
    int near = nearest_joint(d, w, where);
    for (int i = 0; i < w->njoint; i++)
        if (w->joint[i] == near && !fw_head_exists(++choice[i])) return false;
    return true;
}

/* Where edges of parts nearly coincide, the united outline has steps, teeth or slits that no mask
   can show. Then the free dimensions of the head (or the eyelets) next to the worst place are
   changed, row by row, until it is sound; else the best of the attempts stands, the first one
   unless another is better by 5 %. test_layout_sweep.c */
static fw_status draw_soundly(fw_drawing *d, work *w) {
    int choice[MOST_JOINTS] = {0}, best[MOST_JOINTS] = {0}, best_shift = 0;
    double most = 0.0, sound;
    fw_vec2 where;
    for (int round = 0; round < 4 * MOST_JOINTS; round++) {
        fw_status heads = choose_heads(d, w, choice);
        if (heads == FW_GEOMETRY) break; /* no such head: what was drawn before stands */
        FW_TRY(heads);
        FW_TRY(quiet_attempt(d, w, &sound, &where));
        if (sound >= 1.0) return FW_OK;
        if (sound > 1.05 * most) {
            most = sound;
            best_shift = w->lug_shift;
            for (int i = 0; i < w->njoint; i++)
                best[i] = choice[i];
        }
        if (!vary(d, w, where, choice)) break;
    }
    w->lug_shift = best_shift;
    FW_TRY(choose_heads(d, w, best));
    size_t errors = d->diags->errors;
    fw_status status = attempt(d, w, &sound, &where);
    if (status != FW_GEOMETRY || d->diags->errors > errors) return status;
    const char *label = fw_body_label(d, w->body);
    FW_NEED(label);
    fw_diag_error(d->diags, 126, fw_body_place(d, w->body),
                  "%s: parts of it run along each other at almost no distance; change a width or a "
                  "position slightly",
                  label);
    return FW_GEOMETRY;
}

/* raw (united) and plain (rounded) outline of one body, and its moments. `extra` are parts that
   only the base has. Half of each adjacent flexure's mass is not added: it is about 1 % of a
   link's. */
fw_status fw_body_draw(fw_drawing *d, int body, int only, const fw_contour *extra, int nextra) {
    int slot = fw_drawing_slot(d, body, only);
    work w = {.body = body, .slot = slot, .extra = extra, .nextra = nextra, .first_lug = d->nlug};
    w.njoint = fw_body_joints(d->device, body, w.joint, MOST_JOINTS);
    if (only != FW_NONE) {
        w.joint[0] = only;
        w.njoint = 1;
    }
    if (w.njoint > MOST_JOINTS) {
        const char *label = fw_body_label(d, body);
        FW_NEED(label);
        fw_diag_error(d->diags, 123, fw_body_place(d, body),
                      "%s has %d hinges; at most %d can be drawn on one body", label, w.njoint,
                      (int)MOST_JOINTS);
        return FW_GEOMETRY;
    }
    FW_TRY(draw_soundly(d, &w));
    if (body < 0) return FW_OK;
    fw_region region = {&d->plain[slot], 1};
    fw_moments m = fw_region_moments(&region);
    d->layout->body[body] =
        (fw_body_layout){m.area_m2, fw_contour_perimeter(&d->plain[slot]), m.centroid, m.polar_m4};
    return FW_OK;
}
