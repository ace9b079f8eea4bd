/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One outline per body: bars and plate, cut free of the hinges, united with its own hinge heads. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

enum { MOST_JOINTS = 16, ROUNDS = 64, MOST_PARTS = 3 * MOST_JOINTS + 8 };

typedef struct parts {
    fw_geometry_contour item[MOST_PARTS];
    int count;
} parts;

static bool has_plate(const fw_layout_drawing *d, int body) {
    return body >= 0 && !isnan(d->device->body[body].plate_width_m);
}

/* One end of a bar: it starts inside the neck, crosses the neck's edges at a small angle and widens
   to its full width. Where that gentle slope does not reach the stated width, a steeper shoulder
   beyond the neck does, as gentle as leaves the bar its full width on the share of it that the
   rules ask for. Fills the edge from the hinge outwards; returns the number of points, 0 where even
   the steepest shoulder does not reach: then *most_half_m is what does. The base has no stated
   width and is as wide as it gets. */
static int bar_end(const fw_layout_side *side, double length, fw_geometry_vec2 p[3],
                   double *most_half_m) {
    const fw_layout_rules *rule = &fw_layout_rule;
    double half = side->half_width_m, end = side->neck_end_m;
    double from = fmax(end - rule->bar_overlap_m, side->solid_m);
    double slope = rule->bar_rise_m / (end - from), start = side->neck_m - rule->bar_inset_m;
    double widen = half - side->neck_m + rule->bar_inset_m, gentle = slope * (length - from);
    p[0] = fw_v(from, start);
    if (side->body < 0 || widen <= gentle) {
        widen = fmin(widen, gentle);
        p[1] = fw_v(from + widen / slope, start + widen);
        return 2;
    }
    double room = (1.0 - rule->bar_full_share) * (length - end), at_end = start + rule->bar_rise_m;
    *most_half_m = fmax(start + gentle, at_end + rule->bar_steepest * room);
    if (half > *most_half_m) return 0;
    p[1] = fw_v(end, at_end);
    p[2] = fw_v(end + room, half);
    return 3;
}

enum { EDGE = 8 }; /* most points of one edge of a bar */

/* mirrors the n points of one edge to the other and closes the outline; local x along the bar */
static fw_status close_bar(fw_layout_drawing *d, fw_geometry_vec2 w, fw_geometry_vec2 direction,
                           fw_geometry_vec2 p[2 * EDGE], int n, fw_geometry_contour *bar) {
    fw_layout_local local = {w, direction.x, direction.y, false};
    for (int i = 0; i < n; i++)
        p[2 * n - 1 - i] = fw_v(p[i].x, -p[i].y);
    return fw_layout_polygon(d->arena, &local, p, 2 * n, -1, bar);
}

/* The stated width does not fit on `length_m` beyond one of the body's hinges. A narrower bar has narrower
   necks, so that most_m may be too wide as well: layout_build.c looks for what fits. */
static fw_status refuse_width(fw_layout_drawing *d, int body, int joint, double length_m,
                              double most_m) {
    const fw_device_body *b = &d->device->body[body];
    const double neck_m = fw_layout_side_of(d, joint, body)->neck_end_m;
    char wide[32], length[32], most[32];
    const char *label = fw_layout_body_label(d, body), *id = d->device->revolute[joint].id;
    FW_NEED(label);
    fw_layout_um(wide, b->width_m), fw_layout_um(length, length_m);
    if (length_m <= neck_m) /* with the neck of that width */
        fw_diag_error(
            d->diags, 137, b->width_place,
            "%s: a bar %s um wide cannot be drawn: it ends %s um from %s%s, whose "
            "neck is %s um long; write a narrower width, or none where all of the body is drawn "
            "by shapes inside it, or move the hinges apart (the bar of a body with one hinge ends "
            "at the body's x, y)",
            label, wide, length, FW_NAMED("hinge", id), fw_layout_um(most, neck_m));
    else
        fw_diag_error(
            d->diags, 137, b->width_place,
            "%s: a bar %s um wide cannot be drawn: at %s%s it has %s um, on which the "
            "layout widens it from the hinge's neck by 45 degrees at most and leaves half of "
            "the bar its full width; write a width below %s um, or move the hinges apart",
            label, wide, FW_NAMED("hinge", id), length,
            fw_layout_um(most, ceil(most_m * 1e7) / 1e7));
    if (d->diags == d->own) {
        d->too_wide = body;
        d->fits_m = fmin(most_m, length_m > neck_m ? b->width_m : 0.9 * b->width_m);
    }
    fw_layout_fault fault = fw_layout_fault_at(fw_layout_joint_point(d->device, joint));
    fault.body[fault.nbody++] = body;
    FW_TRY(fw_layout_fault_keep(d, fault));
    return FW_GEOMETRY;
}

/* from hinge to `end` on the hinge's own direction, square end */
static fw_status draw_spoke(fw_layout_drawing *d, int joint, const fw_layout_side *side,
                            double half, double end, fw_geometry_contour *bar) {
    fw_geometry_vec2 p[2 * EDGE];
    double most = 0.0;
    int n = bar_end(side, end, p, &most);
    if (n == 0) return refuse_width(d, side->body, joint, end, 2.0 * most);
    p[n++] = fw_v(end, half);
    return close_bar(d, fw_layout_joint_point(d->device, joint), side->direction, p, n, bar);
}

/* Bar between two hinges of a body, its ends meeting half-way between the hinges or, where the two
   necks leave too little there, half-way between the necks. */
static fw_status draw_link(fw_layout_drawing *d, int body, const int joint[2],
                           fw_geometry_contour *bar) {
    const fw_layout_side *side[2] = {fw_layout_side_of(d, joint[0], body),
                                     fw_layout_side_of(d, joint[1], body)};
    fw_geometry_vec2 p[2 * EDGE], w = fw_layout_joint_point(d->device, joint[0]), far[3];
    double length = fw_norm(fw_sub(fw_layout_joint_point(d->device, joint[1]), w));
    double part[2] = {0.5 * length, 0.5 * length}, most[2];
    int n = bar_end(side[0], part[0], p, &most[0]), m = bar_end(side[1], part[1], far, &most[1]);
    if (n != 2 || m != 2) {
        part[0] = 0.5 * (length + side[0]->neck_end_m - side[1]->neck_end_m);
        part[1] = length - part[0];
        n = bar_end(side[0], part[0], p, &most[0]);
        m = bar_end(side[1], part[1], far, &most[1]);
    }
    if (n == 0 || m == 0) {
        int at = n > 0 || (m == 0 && most[1] < most[0]);
        return refuse_width(d, body, joint[at], part[at], 2.0 * most[at]);
    }
    while (m-- > 0)
        p[n++] = fw_v(length - far[m].x, far[m].y);
    return close_bar(d, w, side[0]->direction, p, n, bar);
}

static bool reaches(const fw_geometry_region *region, const fw_geometry_contour *disc,
                    fw_geometry_vec2 centre) {
    for (int i = 0; i < region->count; i++)
        if (fw_geometry_contour_contains(&region->contour[i], centre) ||
            fw_geometry_contour_distance_below(&region->contour[i], disc, 1e-9, NULL, NULL) <= 0.0)
            return true;
    return false;
}

/* cuts the keep-out discs of the given hinges (all but those in `skip`) out of a region */
static fw_status cut_discs(fw_layout_drawing *d, int body, const int *skip, int nskip,
                           fw_geometry_region *region) {
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        bool own = false;
        for (int i = 0; i < nskip; i++)
            own = own || skip[i] == j;
        if (own) continue;
        fw_geometry_contour disc;
        const bool its = h->lower == body || h->upper == body;
        const fw_layout_side *side = its ? fw_layout_side_of(d, j, body) : NULL;
        const double radius = h->keep_out_m + (its ? side->form.wider_m : 0.0);
        FW_TRY(fw_layout_hinge_place(d->arena, side, h->centre, radius, &disc));
        if (!reaches(region, &disc, h->centre)) continue;
        fw_geometry_region hole = {&disc, 1}, left;
        FW_TRY(fw_geometry_region_boolean(d->arena, region, &hole, FW_DIFFERENCE, &left));
        *region = left;
    }
    return FW_OK;
}

/* the same of a part of a body; the pieces that are left are appended */
static fw_status cut_free(fw_layout_drawing *d, int body, const fw_geometry_contour *part,
                          const int *skip, int nskip, parts *out) {
    fw_geometry_region region = {(fw_geometry_contour *)part, 1};
    FW_TRY(cut_discs(d, body, skip, nskip, &region));
    for (int i = 0; i < region.count && out->count < MOST_PARTS; i++)
        out->item[out->count++] = region.contour[i];
    return FW_OK;
}

/* the plate without the discs of the hinges; the necks of its own hinges reach into it */
static fw_status plate_parts(fw_layout_drawing *d, int body, parts *out) {
    fw_geometry_contour plate;
    FW_TRY(fw_layout_plate_outline(d, body, &plate));
    return cut_free(d, body, &plate, NULL, 0, out);
}

static fw_status bar_parts(fw_layout_drawing *d, int body, const int *joint, int njoint,
                           parts *out) {
    fw_geometry_contour bar;
    if (njoint == 2) {
        FW_TRY(draw_link(d, body, joint, &bar));
        return cut_free(d, body, &bar, joint, 2, out);
    }
    fw_geometry_vec2 hub = fw_v(0.0, 0.0);
    double half = 0.0;
    for (int i = 0; i < njoint; i++) {
        fw_geometry_vec2 p = fw_layout_joint_point(d->device, joint[i]);
        hub = fw_add(hub, 1.0 / njoint, p);
        half = fw_layout_side_of(d, joint[i], body)->half_width_m;
    }
    if (njoint > 2 && body >= 0) hub = fw_layout_body_hub(d, body);
    if (njoint == 1 && body >= 0) hub = fw_v(d->device->body[body].x_m, d->device->body[body].y_m);
    if (njoint == 1 && body < 0) { /* the pedestal takes over before the frame */
        const fw_layout_side *side = fw_layout_side_of(d, joint[0], body);
        double begin = side->neck_end_m, cut = fw_layout_base_reach(d, joint[0]);
        hub = fw_add(hub, begin + fw_layout_rule.pedestal_reach * (cut - begin), side->direction);
    }
    for (int i = 0; i < njoint; i++) {
        const fw_layout_side *side = fw_layout_side_of(d, joint[i], body);
        double end = fw_norm(fw_sub(hub, fw_layout_joint_point(d->device, joint[i])));
        FW_TRY(draw_spoke(d, joint[i], side, half, end, &bar));
        FW_TRY(cut_free(d, body, &bar, &joint[i], 1, out));
    }
    if (njoint > 2) { /* a hub under the inner ends */
        fw_geometry_contour disc;
        FW_TRY(fw_geometry_contour_disc(d->arena, hub, fw_layout_rule.hub_radii * half, &disc));
        FW_TRY(cut_free(d, body, &disc, NULL, 0, out));
    }
    return FW_OK;
}

/* one simple outline, or FW_GEOMETRY */
static fw_status unite_parts(fw_layout_drawing *d, int body, const fw_geometry_contour *part,
                             int npart, fw_geometry_contour *out) {
    fw_geometry_region region = {(fw_geometry_contour *)part, 1};
    for (int i = 1; i < npart; i++) {
        fw_geometry_region next = {(fw_geometry_contour *)&part[i], 1}, both;
        FW_TRY(fw_geometry_region_boolean(d->arena, &region, &next, FW_UNION, &both));
        region = both;
    }
    if (region.count != 1) {
        const char *label = fw_layout_body_label(d, body);
        FW_NEED(label);
        bool hole = false;
        for (int i = 0; i < region.count; i++)
            hole = hole || fw_geometry_contour_area(&region.contour[i]) < 0.0;
        fw_diag_error(d->diags, 123, fw_layout_body_place(d, body),
                      "%s would %s; the layout draws a body as one outline without holes: move "
                      "its plate or hinges, or %s",
                      label, hole ? "enclose a hole" : "fall apart where hinges cut it",
                      hole && has_plate(d, body)
                          ? "draw it as <plate> inside <body>, which necks enter where it is "
                            "nearest to their hinge and not towards its middle"
                          : "change the width of its bars");
        return FW_GEOMETRY;
    }
    *out = region.contour[0];
    return FW_OK;
}

/* What is drawn of a body with shapes: they come first and keep their edges, hinges cut free; then
   parts are united with them one by one, those of its hinges from number `head` on, and holes are
   cut out and opened. */
static fw_status unite_with_shapes(fw_layout_drawing *d, int body, const fw_geometry_contour *part,
                                   int npart, int head, fw_geometry_contour *out) {
    fw_geometry_region region = d->shapes[body].solid;
    int outer = 0;
    FW_TRY(cut_discs(d, body, NULL, 0, &region));
    for (int i = 0; i < npart; i++) {
        if (i == head) d->shapes[body].left = region;
        fw_geometry_region next = {(fw_geometry_contour *)&part[i], 1}, both;
        FW_TRY(fw_geometry_region_boolean(d->arena, &region, &next, FW_UNION, &both));
        region = both;
    }
    for (int i = 0; i < region.count; i++)
        outer += fw_geometry_contour_area(&region.contour[i]) > 0.0;
    if (outer != 1)
        return fw_layout_shape_refuse(
            d, 318, fw_layout_body_place(d, body), body,
            outer ? "what is drawn falls apart, or hinges cut it into pieces; join the parts, or "
                    "move them away from the hinge"
                  : "nothing of what is drawn is left beside its hinges",
            outer ? region.contour[1].segment[0].a
                  : fw_v(d->device->body[body].x_m, d->device->body[body].y_m));
    FW_TRY(fw_layout_shapes_pierce(d, body, &region));
    return fw_layout_holes_open(d, body, &region, out, &d->caps[body]);
}

/* Corners of 10 um; where the parts are too small for that, 5, 2.5 or 1.25 um for the whole body.
   Fillets at the roots and conjugate surfaces meet their neighbours smoothly or keep their arcs. */
fw_status fw_layout_body_round(fw_layout_drawing *d, int body, const fw_geometry_contour *in,
                               fw_geometry_contour *out, double *radius_m,
                               fw_geometry_vec2 *where) {
    for (double radius = fw_layout_rule.corner_m; radius > fw_layout_rule.least_corner_m;
         radius *= 0.5) {
        fw_status status = fw_geometry_contour_round(d->arena, in, radius, radius, out, where);
        *radius_m = radius;
        if (status != FW_GEOMETRY) return status;
    }
    char x[32], y[32], least[32];
    const char *label = fw_layout_body_label(d, body);
    FW_NEED(label);
    fw_diag_error(d->diags, 126, fw_layout_body_place(d, body),
                  "%s has a corner at (%s, %s) um where edges of two parts nearly coincide, so "
                  "that it cannot be rounded by even %s um, the least radius of the layout: "
                  "change a width or a position nearby by a few micrometres",
                  label, fw_layout_um(x, where->x), fw_layout_um(y, where->y),
                  fw_layout_um(least, *radius_m));
    fw_layout_fault fault = fw_layout_fault_at(*where);
    fault.body[fault.nbody++] = body;
    FW_TRY(fw_layout_fault_keep(d, fault));
    return FW_GEOMETRY;
}

/* what is drawn of one body: its hinges, parts of the base alone, and where its eyelets stand */
typedef struct work {
    int body, slot, joint[MOST_JOINTS], njoint;
    const fw_geometry_contour *extra;
    int nextra, lug_shift, first_lug;
} work;

static fw_status unite_all(fw_layout_drawing *d, const work *w) {
    parts *all;
    FW_NEED(all = fw_arena_one(d->arena, parts));
    if (has_plate(d, w->body))
        FW_TRY(plate_parts(d, w->body, all));
    else if (!fw_layout_only_shapes(d->device, w->body))
        FW_TRY(bar_parts(d, w->body, w->joint, w->njoint, all));
    const int head = all->count;
    for (int i = 0; i < w->njoint; i++)
        all->item[all->count++] = fw_layout_side_of(d, w->joint[i], w->body)->head;
    for (int i = 0; i < w->nextra; i++)
        all->item[all->count++] = w->extra[i];
    if (fw_layout_has_shapes(d->device, w->body))
        return unite_with_shapes(d, w->body, all->item, all->count, head, &d->raw[w->slot]);
    FW_TRY(unite_parts(d, w->body, all->item, all->count, &d->raw[w->slot]));
    d->nlug = w->first_lug;
    if (w->body < 0 || !d->device->body[w->body].platform) return FW_OK;
    static const double shift[] = {0.0, 1.0, -1.0, 2.0, -2.0}; /* nearest first */
    fw_geometry_contour lug[4];
    int nlug = 0;
    FW_TRY(fw_layout_platform_lugs(d, w->body, shift[w->lug_shift] * fw_layout_rule.lug_shift_m,
                                   lug, &nlug));
    for (int i = 0; i < nlug; i++) {
        fw_geometry_contour pair[2] = {d->raw[w->slot], lug[i]};
        FW_TRY(unite_parts(d, w->body, pair, 2, &d->raw[w->slot]));
    }
    return FW_OK;
}
enum { LUG_SHIFTS = 5 };

/* how far an outline is from what a mask can show, and where it is worst */
typedef struct flaw {
    double value_m, limit_m;
    const char *what;
    fw_geometry_vec2 where;
} flaw;

static double share(const flaw *f) {
    return f->value_m / f->limit_m;
}

/* least width or space where that is below the limit; else the limit's share is without bound */
static flaw narrowest(const fw_geometry_contour *c, bool inside, double limit_m) {
    int i, j;
    flaw f = {HUGE_VAL, limit_m, inside ? "width" : "space", {0.0, 0.0}};
    double least =
        fw_geometry_contour_clearance_except(c, inside, limit_m, FW_SEGMENT_DRAWN, &i, &j);
    if (i < 0) return f;
    fw_geometry_vec2 other;
    f.value_m = least;
    f.where = c->segment[i].a;
    if (i != j) fw_geometry_segment_distance(&c->segment[i], &c->segment[j], &f.where, &other);
    return f;
}

/* least radius of an arc: where it turns by more than 45 degrees its neighbours nearly face each
   other, so that they are a width or a space across it; not at the root of a flexure */
static double arc_limit(const fw_geometry_contour *c, int i) {
    const fw_geometry_segment *s = &c->segment[i];
    int n = c->count;
    unsigned beside = c->segment[(i + 1) % n].flags | c->segment[(i + n - 1) % n].flags;
    bool hollow = s->sweep_rad < 0.0;
    bool tight = fabs(s->sweep_rad) > 0.25 * FW_PI;
    if (tight && !(beside & FW_SEGMENT_JOINT))
        return hollow ? fw_layout_rule.own_bend_m : fw_layout_rule.own_tip_m;
    return hollow ? fw_layout_rule.own_hollow_m : 1e-9;
}

static flaw worst_of(const fw_geometry_contour *c) {
    flaw worst = narrowest(c, true, fw_layout_rule.own_width_m);
    flaw space = narrowest(c, false, fw_layout_rule.own_space_m);
    if (share(&space) < share(&worst)) worst = space;
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        flaw arc = {s->radius, arc_limit(c, i), "radius", s->a};
        if (s->kind == FW_ARC && !(s->flags & FW_SEGMENT_DRAWN) && share(&arc) < share(&worst))
            worst = arc;
    }
    return worst;
}

/* The least of width, space and radius, each over its limit; >= 1 is good, and says nothing more.
   What a description draws is its own affair: the rules of the masks judge it. */
double fw_layout_body_soundness(const fw_geometry_contour *c, fw_geometry_vec2 *where) {
    flaw worst = worst_of(c);
    if (isfinite(worst.value_m)) *where = worst.where;
    return share(&worst);
}

static int nearest_joint(const fw_layout_drawing *d, const work *w, fw_geometry_vec2 p) {
    int best = w->joint[0];
    for (int i = 1; i < w->njoint; i++)
        if (fw_norm(fw_sub(p, fw_layout_joint_point(d->device, w->joint[i]))) <
            fw_norm(fw_sub(p, fw_layout_joint_point(d->device, best))))
            best = w->joint[i];
    return best;
}

static bool near_lug(const fw_layout_drawing *d, const work *w, fw_geometry_vec2 p) {
    for (int i = w->first_lug; i < d->nlug; i++) {
        fw_geometry_box b = fw_geometry_contour_box(&d->lug[i]);
        double q = fw_layout_rule.lug_near_m;
        if (p.x > b.x0 - q && p.x < b.x1 + q && p.y > b.y0 - q && p.y < b.y1 + q) return true;
    }
    return false;
}

/* one drawing of the body as its heads stand now; *sound 0 when it cannot be united (*where NaN) or
   rounded */
static fw_status attempt(fw_layout_drawing *d, const work *w, double *sound,
                         fw_geometry_vec2 *where) {
    *sound = 0.0;
    *where = fw_v((double)NAN, (double)NAN);
    FW_TRY(unite_all(d, w));
    FW_TRY(fw_layout_body_round(d, w->body, &d->raw[w->slot], &d->plain[w->slot],
                                &d->corner_m[w->slot], where));
    *sound = fw_layout_body_soundness(&d->plain[w->slot], where);
    return FW_OK;
}

static fw_status quiet_attempt(fw_layout_drawing *d, const work *w, double *sound,
                               fw_geometry_vec2 *where) {
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    d->diags = &unsaid;
    fw_status status = attempt(d, w, sound, where);
    d->diags = said;
    return status == FW_GEOMETRY ? FW_OK : status;
}

static fw_status choose_heads(fw_layout_drawing *d, const work *w, const int *choice) {
    for (int i = 0; i < w->njoint; i++)
        if (fw_layout_side_of(d, w->joint[i], w->body)->attempt != choice[i])
            FW_TRY(fw_layout_head_draw(d, w->joint[i], w->body, choice[i]));
    return FW_OK;
}

/* the next thing to try where an outline is unsound: other eyelets, else another head there */
static bool vary(const fw_layout_drawing *d, work *w, fw_geometry_vec2 where, int *choice) {
    if (isnan(where.x)) {
        bool exist = true;
        for (int i = 0; i < w->njoint; i++)
            exist = ++choice[i] < fw_layout_rule.form_attempts && exist;
        return exist;
    }
    if (near_lug(d, w, where) && w->lug_shift + 1 < LUG_SHIFTS) {
        w->lug_shift++;
        return true;
    }
    int near = nearest_joint(d, w, where);
    for (int i = 0; i < w->njoint; i++)
        if (w->joint[i] == near && ++choice[i] >= fw_layout_rule.form_attempts) return false;
    return true;
}

static const double SOUND_ENOUGH = 1e-3; /* of a limit: 10 nm, below what a mask writer places */

fw_status fw_layout_rotor_flaw(fw_layout_drawing *d, int body, const fw_layout_comb_plan *p,
                               const fw_geometry_contour *raw, const char **why) {
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    fw_geometry_contour plain;
    fw_geometry_vec2 at;
    double radius, tip = fw_layout_comb_tip(p->width_m);
    char is[32], least[32], x[32], y[32], wide[32];
    *why = NULL;
    d->diags = &unsaid;
    fw_status status = fw_layout_body_round(d, body, raw, &plain, &radius, &at);
    d->diags = said;
    if (status == FW_GEOMETRY) return FW_OK;
    FW_TRY(status);
    flaw f = worst_of(&plain);
    const bool thin =
        p->comb->kind == FW_ELECTRODES_COMB &&
        p->width_m < fw_layout_comb_width_shown(); /* wider ones lack something else */
    if (share(&f) >= 1.0) return FW_OK;
    fw_layout_um(is, f.value_m), fw_layout_um(least, f.limit_m);
    if (thin && *f.what == 'r' && fabs(f.value_m - tip) < 1e-9)
        *why =
            fw_arena_printf(d->arena,
                            "its fingers are %s um wide, so that their tips are rounded with %s um "
                            "only, and every mask shows %s um; make them %s um wide or wider",
                            fw_layout_um(wide, p->width_m), is, least,
                            fw_layout_um(x, fw_layout_comb_width_shown()));
    else if (thin && *f.what == 'w' && fabs(f.value_m - p->width_m) < 1e-9)
        *why = fw_arena_printf(d->arena,
                               "its fingers are %s um wide, and the least width that every mask "
                               "shows is %s um; make them %s um wide or wider",
                               is, least, fw_layout_um(x, fw_layout_comb_width_shown()));
    else
        *why = fw_arena_printf(d->arena,
                               "with it the outline of its body would have a %s of only %s um at "
                               "(%s, %s) um, and every mask shows %s um",
                               f.what, is, fw_layout_um(x, f.where.x), fw_layout_um(y, f.where.y),
                               least);
    FW_NEED(*why);
    return FW_OK;
}

/* no head, and no place of the eyelets, that was tried makes the outline sound */
static fw_status say_flaw(fw_layout_drawing *d, const work *w) {
    flaw f = worst_of(&d->plain[w->slot]);
    char x[32], y[32], value[32], limit[32];
    const char *label = fw_layout_body_label(d, w->body);
    FW_NEED(label);
    if (d->said) return FW_OK;
    for (int i = 0; i < w->njoint && *f.what == 'r'; i++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[w->joint[i]];
        if (fabs(f.value_m - h->fillet_m) < 1e-9 &&
            vec_distance(f.where, h->centre) < h->keep_out_m)
            return fw_layout_say_fillet(d, w->joint[i], label, f.where, f.limit_m);
    }
    fw_diag_warning(
        d->diags, 138, fw_layout_body_place(d, w->body),
        "the outline of %s has a %s of only %s um at (%s, %s) um; the layout's own rule is "
        "%s um, so that every mask shows it, and no other neck or root block of the "
        "hinge there does better: change a width, a fillet or a position nearby, or see "
        "whether the rules of the mask accept it",
        label, f.what, fw_layout_um(value, f.value_m), fw_layout_um(x, f.where.x),
        fw_layout_um(y, f.where.y), fw_layout_um(limit, f.limit_m));
    return FW_OK;
}

/* Where edges of parts nearly coincide, the united outline has steps, teeth or slits that no mask
   can show. Then the free dimensions of the head (or the eyelets) next to the worst place are
   changed (fw_layout_head_form) until it is sound; else the best of the attempts stands, the first
   one unless another is better by 5 %, and what is wrong with it is said. test_layout_sweep.c */
static fw_status draw_soundly(fw_layout_drawing *d, work *w) {
    int choice[MOST_JOINTS] = {0}, best[MOST_JOINTS] = {0}, best_shift = 0;
    double most = 0.0, sound;
    fw_geometry_vec2 where;
    for (int round = 0; round < ROUNDS; round++) {
        fw_status heads = choose_heads(d, w, choice);
        if (heads == FW_GEOMETRY) break; /* no such head: what was drawn before stands */
        FW_TRY(heads);
        const fw_mark before = fw_arena_mark(d->arena);
        FW_TRY(quiet_attempt(d, w, &sound, &where));
        if (sound >= 1.0) return FW_OK;
        if (w->body < 0) fw_arena_rewind(d->arena, before); /* nothing else is left of it there */
        if (sound > fw_layout_rule.sounder_share * most) {
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
    if (status == FW_OK && sound < 1.0 - SOUND_ENOUGH) return say_flaw(d, w);
    if (status != FW_GEOMETRY || d->diags->errors > errors) return status;
    const char *label = fw_layout_body_label(d, w->body);
    FW_NEED(label);
    fw_diag_error(d->diags, 126, fw_layout_body_place(d, w->body),
                  "%s: edges of two of its parts nearly coincide over some length, so that the "
                  "parts cannot be united to one outline; change a width or a position by a few "
                  "micrometres%s",
                  label,
                  w->body >= 0 ? ""
                               : ". A base leaves its hinge straight towards a side of the frame "
                                 "however the device lies on the wafer, so that the same device "
                                 "turned by some degrees may be drawn");
    return FW_GEOMETRY;
}

/* raw (united) and plain (rounded) outline of one body, and its moments. `extra` are parts that
   only the base has. */
fw_status fw_layout_body_draw(fw_layout_drawing *d, int body, int only,
                              const fw_geometry_contour *extra, int nextra) {
    int slot = fw_layout_drawing_slot(d, body, only);
    work w = {.body = body, .slot = slot, .extra = extra, .nextra = nextra, .first_lug = d->nlug};
    w.njoint = fw_layout_body_joints(d->device, body, w.joint, MOST_JOINTS);
    if (only != FW_NONE) {
        w.joint[0] = only;
        w.njoint = 1;
    }
    if (w.njoint > MOST_JOINTS) {
        const char *label = fw_layout_body_label(d, body);
        FW_NEED(label);
        fw_diag_error(d->diags, 123, fw_layout_body_place(d, body),
                      "%s has %d hinges; at most %d can be drawn on one body", label, w.njoint,
                      (int)MOST_JOINTS);
        return FW_GEOMETRY;
    }
    if (body < 0) d->base = w.joint[0];
    const fw_status status = draw_soundly(d, &w);
    d->base = FW_NONE;
    FW_TRY(status);
    if (body < 0) return FW_OK;
    if (fw_layout_has_shapes(d->device, body)) {
        FW_TRY(fw_layout_shapes_say_cut(d, body));
        FW_TRY(fw_layout_shapes_say_closed(d, body));
    }
    return fw_layout_body_measure(d, body, NULL, 0);
}
