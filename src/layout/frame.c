/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/draw.h"
#include <math.h>

/* what a strip of the frame crosses or nearly touches */
typedef struct in_way {
    const char *name; /* NULL: nothing */
    int body, joint;  /* of it; FW_NONE */
    bool own;         /* there is no pedestal at all, and this says why */
} in_way;

static fw_status find_in_way(fw_layout_drawing *d, const fw_geometry_contour *strip, in_way *way) {
    const double space = fw_layout_rule.strip_clear_m, beside = fw_layout_rule.strip_disc_m;
    *way = (in_way){NULL, FW_NONE, FW_NONE, false};
    for (int b = 0; b < d->device->nbody && !way->name; b++)
        if (fw_geometry_contour_distance_below(strip, &d->plain[b], space, NULL, NULL) < space) {
            FW_NEED(way->name = fw_layout_body_label(d, b));
            way->body = b;
        }
    if (!way->name && fw_layout_near_stator(d, strip, space)) way->name = "a stator";
    for (int j = 0; j < d->device->nrevolute && !way->name; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        fw_geometry_contour disc;
        bool near = fw_geometry_contour_contains(strip, h->centre);
        if (!near) {
            fw_status status = fw_geometry_contour_disc(d->arena, h->centre, h->keep_out_m, &disc);
            if (status == FW_NOMEM) return status; /* not a reason to go to another side */
            near = status != FW_OK ||
                   fw_geometry_contour_distance_below(strip, &disc, beside, NULL, NULL) < beside;
        }
        if (!near) continue;
        way->joint = j;
        FW_NEED(way->name = fw_arena_printf(d->arena, "%s%s",
                                            FW_NAMED("hinge", d->device->revolute[j].id)));
    }
    return FW_OK;
}

/* where the pedestal leaves the base: the middle of the bar between two ground hinges, or the end
   of the spoke of one */
typedef struct foot {
    fw_geometry_vec2 middle, axis; /* axis of the bar or the spoke */
    double half,
        least;    /* half width wanted; the least of a narrower one: that of the bar or the spoke */
    double reach; /* half the free length of the bar, or how far along the spoke it may go */
} foot;

static foot choose_foot(const fw_layout_drawing *d, const int *joint, int n) {
    foot f = {{0.0, 0.0}, {0.0, 0.0}, 0.0, 0.0, 0.0};
    const fw_layout_side *side = fw_layout_side_of(d, joint[0], FW_GROUND);
    for (int i = 0; i < n; i++)
        f.middle = fw_add(f.middle, 1.0 / n, fw_layout_joint_point(d->device, joint[i]));
    f.half = side->half_width_m;
    if (n == 1) {
        double begin = side->neck_end_m, cut = fw_layout_base_reach(d, joint[0]);
        f.middle = fw_add(f.middle, begin + fw_layout_rule.pedestal_share * (cut - begin),
                          side->direction);
        f.axis = side->direction;
        f.reach = fw_layout_rule.pedestal_share * (cut - begin);
        f.half = fw_layout_rule.pedestal_widths * side->half_width_m;
        if (d->device->die.anchor_m > 0.0) f.half = 0.5 * d->device->die.anchor_m;
    }
    if (n == 2) {
        fw_geometry_vec2 between = fw_sub(fw_layout_joint_point(d->device, joint[1]),
                                          fw_layout_joint_point(d->device, joint[0]));
        double length = fw_norm(between), q = fmax(d->layout->hinge[joint[0]].keep_out_m,
                                                   d->layout->hinge[joint[1]].keep_out_m);
        f.axis = side->direction;
        f.reach = 0.5 * length - q - fw_layout_rule.pedestal_clear_m;
        f.half = fw_layout_rule.pedestal_bar_share * length;
        if (d->device->die.anchor_m > 0.0) f.half = 0.5 * d->device->die.anchor_m;
        f.half = fmin(f.half, f.reach);
    }
    f.least = d->device->die.anchor_m > 0.0 ? f.half : side->half_width_m;
    return f;
}

void fw_layout_sides_by_distance(const fw_layout *l, fw_geometry_vec2 p,
                                 fw_layout_window_side order[4]) {
    double far[4];
    for (int i = 0; i < 4; i++) {
        fw_layout_window_side s = (fw_layout_window_side)i;
        far[i] =
            fw_dot(fw_sub(fw_layout_window_point(l, s, 0.0, 0.0), p), fw_layout_window_outward(s));
        int k = i;
        for (; k > 0 && far[order[k - 1]] > far[i] + 1e-9; k--)
            order[k] = order[k - 1];
        order[k] = s;
    }
}

/* A pedestal as wide as is wanted where the foot is, on the nearest side that it reaches freely; where there is none,
   narrower ones and beside that place, but for an anchor whose width is stated. Turned against the frame a bar has
   less room between the places of its two hinges: seen from a side it is shorter, and these are not. */
typedef struct attempt {
    double width,
        aside; /* shares: of half the width; of half the bar, or of the way along a spoke */
} attempt;
static const attempt fw_attempt[] = {{1.0, 0.0},  {0.7, 0.0},   {0.5, 0.0},  {0.35, 0.0},
                                     {0.5, 0.3},  {0.5, -0.3},  {0.25, 0.5}, {0.25, -0.5},
                                     {0.25, 0.7}, {0.25, -0.7}, {0.25, 0.0}};
enum { ATTEMPTS = sizeof fw_attempt / sizeof fw_attempt[0] };

/* why there is none, or NULL */
static fw_status draw_pedestal(fw_layout_drawing *d, const foot *f, int n, attempt t,
                               fw_layout_window_side side, fw_layout_attachment *a,
                               const char **why) {
    const bool whole = t.width == 1.0 && t.aside == 0.0;
    const bool up = fabs(fw_layout_window_outward(side).x) > 0.5;
    const fw_geometry_vec2 middle = fw_add(f->middle, t.aside * f->reach, f->axis);
    double across = up ? middle.x : middle.y, along = up ? middle.y : middle.x;
    double slope = 0.0, half = t.width * f->half;
    *why = "its own bar points";
    if (n == 2) {
        double s = up ? f->axis.y : f->axis.x, o = up ? f->axis.x : f->axis.y;
        if (fabs(s) < 0.5) return FW_OK;
        slope = o / s;
        half = fmin(half, (1.0 - fabs(t.aside)) * f->reach * fabs(s));
    }
    *why = "its own hinges leave no room";
    if (half < (whole ? 0.5 * fw_layout_rule.tether_m : f->least)) return FW_OK;
    double at = fw_layout_to_grid(along);
    double low = across + slope * (at - half - along), high = across + slope * (at + half - along);
    *a = (fw_layout_attachment){.body = FW_GROUND};
    *why = NULL;
    return fw_layout_strip_draw(d, side, low, high, at, half, fw_layout_rule.stub_m, a);
}

/* Where two hinges are nearer to each other than the least pedestal and what it keeps clear of their round places: how far
   apart they have to be; else "" */
static const char *say_apart(fw_layout_drawing *d, const foot *f, const int *joint) {
    char now[32], least[32];
    const double short_of = 0.5 * fw_layout_rule.tether_m - f->reach;
    if (!(short_of > 0)) return "";
    const double apart = fw_norm(fw_sub(fw_layout_joint_point(d->device, joint[1]),
                                        fw_layout_joint_point(d->device, joint[0])));
    fw_number_text(now, sizeof now, 1e6 * apart, 4);
    fw_number_text(least, sizeof least, 1e6 * (apart + 2 * short_of), 4);
    return fw_arena_printf(d->arena,
                           ". The two are %s um apart; a base between their round places needs "
                           "%s um at least",
                           now, least);
}

/* what lies between a base and each side, the nearest first, of the narrowest pedestal at its middle */
static fw_status say_no_way(fw_layout_drawing *d, const foot *f, const int *joint, int n,
                            const fw_layout_window_side order[4], const in_way way[4]) {
    static const char *const side_name[] = {
        [FW_LEFT] = "left", [FW_RIGHT] = "right", [FW_BOTTOM] = "lower", [FW_TOP] = "upper"};
    const char *all = "";
    for (int i = 0; i < 4; i++)
        FW_NEED(all = fw_arena_printf(d->arena, "%s%sto the %s %s %s%s", all, i ? ", " : "",
                                      side_name[order[i]], i ? "one" : "side", way[i].name,
                                      i || way[i].own ? "" : " is in the way"));
    const char *apart = n == 2 ? say_apart(d, f, joint) : "";
    FW_NEED(apart);
    fw_diag_error(d->diags, 128, d->device->revolute[joint[0]].place,
                  "the base at ground %s%s cannot reach the frame on any side without crossing "
                  "a moving part (%s); move the ground hinges to the rim of the mechanism%s%s",
                  FW_NAMED("hinge", d->device->revolute[joint[0]].id), all,
                  n == 2 ? ". These two have one base between them, which nothing that moves may "
                           "cross, and a base of its own for each has no way either: put both on "
                           "one side of what they hold"
                         : "",
                  apart);
    fw_layout_fault fault = fw_layout_fault_at(fw_layout_joint_point(d->device, joint[0]));
    fault.body[fault.nbody++] = FW_GROUND;
    fault.joint[fault.njoint++] = joint[0];
    for (int i = 0; i < 4 && fault.nbody == 1 && fault.njoint == 1; i++) {
        if (way[i].body != FW_NONE) fault.body[fault.nbody++] = way[i].body;
        if (way[i].joint != FW_NONE && way[i].joint != joint[0])
            fault.joint[fault.njoint++] = way[i].joint;
    }
    FW_TRY(fw_layout_fault_keep(d, fault));
    return FW_GEOMETRY;
}

/* one base: heads at its ground hinges, a bar between them, and a pedestal */
static fw_status draw_base(fw_layout_drawing *d, const int *joint, int n, int only) {
    const foot f = choose_foot(d, joint, n);
    fw_layout_window_side order[4];
    in_way way[4];
    fw_layout_sides_by_distance(d->layout, f.middle, order);
    for (int k = 0; k < ATTEMPTS; k++)
        for (int i = 0; i < 4; i++) {
            fw_layout_attachment a;
            in_way here;
            const char *why;
            FW_TRY(draw_pedestal(d, &f, n, fw_attempt[k], order[i], &a, &why));
            if (why && k == 0) way[i] = (in_way){why, FW_NONE, FW_NONE, true};
            if (why) continue;
            FW_TRY(find_in_way(d, &a.finger, &here));
            if (here.name && fw_attempt[k].aside == 0.0) way[i] = here;
            if (here.name) continue;
            fw_geometry_contour pedestal = a.finger;
            a.finger = (fw_geometry_contour){NULL, 0};
            FW_TRY(fw_layout_attachment_add(d, &a));
            return fw_layout_body_draw(d, FW_GROUND, only, &pedestal, 1);
        }
    return say_no_way(d, &f, joint, n, order, way);
}

/* one base for two ground hinges; with more, or where that has no way, every hinge has its own to the frame */
fw_status fw_layout_ground_draw(fw_layout_drawing *d) {
    int n = fw_layout_body_joints(d->device, FW_GROUND, NULL, 0), *joint;
    FW_NEED(joint = fw_arena_array(d->arena, int, (size_t)n));
    fw_layout_body_joints(d->device, FW_GROUND, joint, n);
    if (n == 2 && !fw_layout_own_bases(d)) { /* else each of them gets its own */
        const fw_status one = draw_base(d, joint, n, FW_NONE);
        d->stuck[joint[0]] = d->stuck[joint[1]] = one == FW_GEOMETRY;
        return one;
    }
    bool bad = false;
    for (int i = 0; i < n; i++) {
        fw_status status = draw_base(d, &joint[i], 1, n == 1 ? FW_NONE : joint[i]);
        if (status != FW_OK && status != FW_GEOMETRY) return status;
        d->stuck[joint[i]] = status == FW_GEOMETRY;
        bad = bad || status == FW_GEOMETRY;
    }
    return bad ? FW_GEOMETRY : FW_OK;
}

/* The window in the frame and the frame itself: two halves that share one cut on either side.

   Cuts are where both neighbouring edges are square to them (across a frame bar, across a stub), so
   that a process bias moves the edges and leaves the cuts alone on both pieces. */

static bool upright(fw_layout_window_side side) {
    return side == FW_LEFT || side == FW_RIGHT;
}

fw_geometry_vec2 fw_layout_window_point(const fw_layout *layout, fw_layout_window_side side,
                                        double along, double depth) {
    const fw_geometry_box *w = &layout->window;
    switch (side) {
    case FW_LEFT:
        return fw_v(w->x0 + depth, along);
    case FW_RIGHT:
        return fw_v(w->x1 - depth, along);
    case FW_BOTTOM:
        return fw_v(along, w->y0 + depth);
    case FW_TOP:
        break;
    }
    return fw_v(along, w->y1 - depth);
}

fw_status fw_layout_attachment_add(fw_layout_drawing *d, const fw_layout_attachment *item) {
    FW_NEED(d->attachment = fw_arena_grow(d->arena, d->attachment, (size_t)d->nattachment,
                                          (size_t)d->nattachment + 1, sizeof *d->attachment));
    d->attachment[d->nattachment++] = *item;
    return FW_OK;
}

/* low_start, high_start: coordinate across the side where the two edges of the strip begin */
fw_status fw_layout_strip_draw(fw_layout_drawing *d, fw_layout_window_side side, double low_start,
                               double high_start, double along, double half_m, double stub_m,
                               fw_layout_attachment *out) {
    const fw_layout_local world = {{0.0, 0.0}, 1.0, 0.0, false};
    double at = fw_layout_to_grid(along), half = fw_layout_to_grid(half_m);
    bool up = upright(side);
    out->side = side;
    out->stub_m = stub_m;
    out->low_m = at - half;
    out->high_m = at + half;
    fw_geometry_vec2 p[4] = {up ? fw_v(low_start, out->low_m) : fw_v(out->low_m, low_start),
                             fw_layout_window_point(d->layout, side, out->low_m, stub_m),
                             fw_layout_window_point(d->layout, side, out->high_m, stub_m),
                             up ? fw_v(high_start, out->high_m) : fw_v(out->high_m, high_start)};
    return fw_layout_polygon(d->arena, &world, p, 4, 1, &out->finger);
}

/* ---- window ---- */

static void enclose(fw_geometry_box *box, fw_geometry_box other) {
    box->x0 = fmin(box->x0, other.x0);
    box->y0 = fmin(box->y0, other.y0);
    box->x1 = fmax(box->x1, other.x1);
    box->y1 = fmax(box->y1, other.y1);
}

/* One axis of the window: around what lies between `low` and `high` or, in a die of stated size,
   what frame and lane leave of it, at no less than the clearance: the stated one, else what a
   tether needs at least. */
static fw_status one_axis(fw_layout_drawing *d, double low, double high, bool wide, double frame,
                          double lane, double *w0, double *w1) {
    const fw_device_die *die = &d->device->die;
    const fw_layout_rules *rule = &fw_layout_rule;
    bool stated = !isnan(die->clearance_m);
    double clearance = stated ? die->clearance_m : rule->clearance_m, rim = frame + lane;
    double size = wide ? die->width_m : die->height_m;
    if (isnan(size)) {
        *w0 = fw_layout_to_grid(low - clearance);
        *w1 = fw_layout_to_grid(high + clearance);
        return FW_OK;
    }
    double least = stated ? clearance : rule->clearance_least_m;
    double half = 0.5 * size - rim, need = high - low + 2.0 * least + 2.0 * rim;
    if (size < need) {
        char a[32], b[32], c[32];
        const char *name = wide ? "width" : "height";
        fw_diag_error(d->diags, 124, wide ? die->width_place : die->height_place,
                      "a die %s of %s um is too small: the drawn mechanism with frame, dicing lane "
                      "and %s um of clearance on either side (%s) needs %s um; enlarge the die, or "
                      "leave %s out, which then follows from the mechanism",
                      name, fw_layout_um(a, size), fw_layout_um(c, least),
                      stated ? "as the file asks" : "the least that the layout takes",
                      fw_layout_um(b, need), name);
        FW_TRY(fw_layout_fault_keep(d, fw_layout_fault_at(fw_layout_nowhere)));
        return FW_GEOMETRY;
    }
    double middle = fw_layout_to_grid(0.5 * (low + high));
    *w0 = fw_layout_to_grid(middle - half);
    *w1 = fw_layout_to_grid(middle + half);
    return FW_OK;
}

/* around all moving bodies, stators and hinges; from the die's size where it is given */
fw_status fw_layout_window_choose(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    const fw_device_die *die = &device->die;
    fw_layout *l = d->layout;
    fw_geometry_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int b = 0; b < device->nbody; b++)
        enclose(&box, fw_geometry_contour_box(&d->plain[b]));
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off) enclose(&box, fw_geometry_contour_box(&d->comb[i].stator));
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &l->hinge[j];
        double q = h->keep_out_m;
        enclose(&box, (fw_geometry_box){h->centre.x - q, h->centre.y - q, h->centre.x + q,
                                        h->centre.y + q});
    }
    double frame = fw_layout_to_grid(isnan(die->frame_m) ? fw_layout_rule.frame_m : die->frame_m);
    double lane = fw_layout_to_grid(isnan(die->lane_m) ? fw_layout_rule.lane_m : die->lane_m);
    double rim = frame + lane;
    fw_status x = one_axis(d, box.x0, box.x1, true, frame, lane, &l->window.x0, &l->window.x1);
    fw_status y = one_axis(d, box.y0, box.y1, false, frame, lane, &l->window.y0, &l->window.y1);
    FW_TRY(x);
    FW_TRY(y);
    l->die = (fw_geometry_box){
        fw_layout_to_grid(l->window.x0 - rim), fw_layout_to_grid(l->window.y0 - rim),
        fw_layout_to_grid(l->window.x1 + rim), fw_layout_to_grid(l->window.y1 + rim)};
    d->lane_m = lane;
    return FW_OK;
}

/* ---- frame ---- */

/* the inner edge along one side, from `from` (already there) to `to`, with its stubs */
static void walk_side(const fw_layout_drawing *d, fw_geometry_outline *o,
                      fw_layout_window_side side, double from, double to) {
    double at = from, sign = to > from ? 1.0 : -1.0;
    for (;;) {
        const fw_layout_attachment *next = NULL;
        for (int i = 0; i < d->nattachment; i++) {
            const fw_layout_attachment *a = &d->attachment[i];
            double ahead = sign * (a->low_m - at);
            if (a->side != side || ahead <= 0.0 || sign * (a->low_m - to) >= 0.0) continue;
            if (!next || ahead < sign * (next->low_m - at)) next = a;
        }
        if (!next) break;
        double first = sign > 0.0 ? next->low_m : next->high_m;
        double last = sign > 0.0 ? next->high_m : next->low_m;
        fw_geometry_outline_line(o, fw_layout_window_point(d->layout, side, first, 0.0), 0);
        fw_geometry_outline_line(o, fw_layout_window_point(d->layout, side, first, next->stub_m),
                                 0);
        fw_geometry_outline_line(o, fw_layout_window_point(d->layout, side, last, next->stub_m),
                                 FW_SEGMENT_JOINT);
        fw_geometry_outline_line(o, fw_layout_window_point(d->layout, side, last, 0.0), 0);
        at = next->low_m;
    }
    fw_geometry_outline_line(o, fw_layout_window_point(d->layout, side, to, 0.0), 0);
}

/* the cut across an upright bar: as near to the middle as the stubs leave room */
static double cut_height(const fw_layout_drawing *d, fw_layout_window_side side) {
    const fw_geometry_box *w = &d->layout->window;
    double middle = fw_layout_to_grid(0.5 * (w->y0 + w->y1));
    const double free_m = fw_layout_rule.frame_cut_clear_m;
    for (int step = 0; step < fw_layout_rule.frame_cut_steps; step++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double y = middle + sign * step * fw_layout_rule.frame_cut_step_m;
            bool clear = y > w->y0 + free_m && y < w->y1 - free_m;
            for (int i = 0; i < d->nattachment && clear; i++)
                if (d->attachment[i].side == side && y > d->attachment[i].low_m - free_m &&
                    y < d->attachment[i].high_m + free_m)
                    clear = false;
            for (int i = 0; i < d->neyelet && clear; i++) {
                const fw_layout_eyelet_plan *e = &d->eyelet[i];
                clear = e->off || fabs(y - e->at.y) > 0.5 * e->hole_m + e->ring_m + free_m;
            }
            for (int i = 0; i < d->ntrack && clear; i++)
                clear = d->track[i].right != (side == FW_RIGHT) ||
                        fabs(y - d->track[i].y_m) > free_m + d->track[i].half_m;
            if (clear) return fw_layout_to_grid(y);
        }
    return middle;
}

fw_status fw_layout_frame_draw(fw_layout_drawing *d) {
    const fw_geometry_box w = d->layout->window, die = d->layout->die;
    double lane = d->lane_m, yl = cut_height(d, FW_LEFT), yr = cut_height(d, FW_RIGHT);
    fw_geometry_box out = {fw_layout_to_grid(die.x0 + lane), fw_layout_to_grid(die.y0 + lane),
                           fw_layout_to_grid(die.x1 - lane), fw_layout_to_grid(die.y1 - lane)};
    for (int half = 0; half < 2; half++) { /* lower, then upper; both counter-clockwise */
        bool low = half == 0;
        fw_layout_window_side first = low ? FW_RIGHT : FW_LEFT, then = low ? FW_BOTTOM : FW_TOP;
        fw_layout_window_side last = low ? FW_LEFT : FW_RIGHT;
        double ya = low ? yl : yr, yb = low ? yr : yl, y0 = low ? out.y0 : out.y1;
        double xa = low ? out.x0 : out.x1, xb = low ? out.x1 : out.x0, end = low ? w.y0 : w.y1;
        fw_geometry_outline o = fw_geometry_outline_start(d->arena, fw_v(xa, ya));
        fw_geometry_outline_line(&o, fw_v(xa, y0), 0);
        fw_geometry_outline_line(&o, fw_v(xb, y0), 0);
        fw_geometry_outline_line(&o, fw_v(xb, yb), 0);
        fw_geometry_outline_line(&o, fw_v(low ? w.x1 : w.x0, yb), FW_SEGMENT_JOINT);
        walk_side(d, &o, first, yb, end);
        walk_side(d, &o, then, low ? w.x1 : w.x0, low ? w.x0 : w.x1);
        walk_side(d, &o, last, end, ya);
        fw_geometry_outline_line(&o, fw_v(xa, ya), FW_SEGMENT_JOINT);
        fw_geometry_contour raw, round;
        fw_geometry_vec2 where;
        FW_TRY(fw_geometry_outline_close(&o, &raw));
        FW_TRY(fw_layout_actuators_on_frame(d, &raw));
        fw_geometry_region parts = {&raw, 1}; /* what tracks leave of it */
        if (d->ntrack > 0) FW_TRY(fw_layout_tracks_cut(d, &raw, &parts));
        for (int i = 0; i < parts.count; i++) {
            FW_TRY(fw_geometry_contour_round(d->arena, &parts.contour[i], 0.0,
                                             fw_layout_rule.corner_m, &round, &where));
            FW_TRY(fw_layout_drawing_add(d, FW_ROLE_FRAME, FW_GROUND, FW_NONE,
                                         low ? "frame, lower half" : "frame, upper half", &round));
        }
    }
    return FW_OK;
}
