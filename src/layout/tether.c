/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tethers: fingers of the frame that hold the moving bodies by a neck until it is broken. The body
   keeps a short stub; everything beyond the neck stays on the frame. */
#include "geometry/segment.h"
#include "layout/draw.h"
#include "layout/layout_text.h"
#include <math.h>

static bool finger_is_clear(const fw_layout_drawing *d, const fw_geometry_contour *finger,
                            int body) {
    const double space = fw_layout_rule.strip_clear_m, between = fw_layout_rule.fingers_apart_m;
    for (int s = 0; s < d->nslot; s++) {
        if (s == body || d->plain[s].count == 0) continue;
        if (fw_geometry_contour_distance_below(finger, &d->plain[s], space, NULL, NULL) < space)
            return false;
    }
    for (int i = 0; i < d->nlug; i++)
        if (fw_geometry_contour_distance_below(finger, &d->lug[i], space, NULL, NULL) < space)
            return false;
    for (int i = 0; i < d->nattachment; i++) {
        const fw_layout_attachment *a = &d->attachment[i];
        if (a->finger.count > 0 &&
            fw_geometry_contour_distance_below(finger, &a->finger, between, NULL, NULL) < between)
            return false;
    }
    fw_geometry_box box =
        fw_geometry_contour_box(finger); /* axis-parallel, so the box is the finger */
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &d->layout->hinge[j];
        double x = fmax(fmax(box.x0 - h->centre.x, h->centre.x - box.x1), 0.0);
        double y = fmax(fmax(box.y0 - h->centre.y, h->centre.y - box.y1), 0.0);
        if (hypot(x, y) < h->keep_out_m + fw_layout_rule.strip_disc_m) return false;
    }
    return true;
}

enum { FEW = 128 };

/* a lower bound of the distance from an outline: no segment's box is nearer */
static double clear_way(const fw_geometry_contour *c, const fw_geometry_box *box,
                        fw_geometry_vec2 p) {
    fw_geometry_box at = {p.x, p.y, p.x, p.y};
    double least = HUGE_VAL;
    for (int i = 0; i < c->count; i++) {
        fw_geometry_box own = i < FEW ? box[i] : fw_segment_box(&c->segment[i]);
        if (fw_box_apart(&at, &own, least)) continue;
        double gap = fw_box_gap(at, own);
        if (gap < least) gap = fmax(gap, fw_geometry_segment_clear_of(&c->segment[i], &at));
        if (gap < least) least = gap;
    }
    return least;
}

/* the finger may leave its own body only once: everything from a little outside on is free. Looked
   at every 2 um, but where no edge is near for longer */
static bool leaves_once(const fw_layout_drawing *d, const fw_layout_attachment *a,
                        fw_geometry_vec2 from) {
    const fw_geometry_contour *body = &d->plain[a->body];
    fw_geometry_vec2 out = fw_layout_window_outward(a->side);
    fw_geometry_vec2 side = fw_left(out);
    double length = fw_dot(fw_sub(fw_layout_window_point(d->layout, a->side, 0.0, 0.0), from), out);
    fw_geometry_box box = fw_geometry_contour_box(body), own[FEW];
    for (int i = 0; i < body->count && i < FEW; i++)
        own[i] = fw_segment_box(&body->segment[i]);
    const double beside = 0.5 * fw_layout_rule.tether_m + fw_layout_rule.finger_beside_m;
    for (int edge = -1; edge <= 1; edge++) {
        bool inside = true;
        double known = -1.0; /* up to there nothing changes */
        for (double s = 0.0; s < length; s += fw_layout_rule.finger_step_m) {
            if (s < known) continue;
            fw_geometry_vec2 p = fw_add(fw_add(from, s, out), edge * beside, side);
            bool in = p.x >= box.x0 && p.x <= box.x1 && p.y >= box.y0 && p.y <= box.y1 &&
                      fw_geometry_contour_contains(body, p);
            if (in && !inside) return false;
            inside = in;
            known = s + clear_way(body, own, p) - 1e-9;
        }
        if (inside) return false;
    }
    return fw_geometry_contour_contains(body, from);
}

/* where a line straight outwards leaves the body, as depth in the window: inside at `deep`, outside
   at the window's edge, once in between */
static double edge_depth(const fw_layout_drawing *d, const fw_layout_attachment *a, double along,
                         double deep) {
    double in = deep, out = 0.0;
    const fw_geometry_contour *body = &d->plain[a->body];
    if (!fw_geometry_contour_contains(body, fw_layout_window_point(d->layout, a->side, along, in)))
        return deep;
    while (in - out > 1e-9) {
        double middle = 0.5 * (in + out);
        if (fw_geometry_contour_contains(body,
                                         fw_layout_window_point(d->layout, a->side, along, middle)))
            in = middle;
        else
            out = middle;
    }
    return in;
}

/* Depth of the neck's cut. The stub's corners at a body's edge of slope m (against the side) are
   rounded by r; the farther one ends r sqrt(1 + m2) outside the edge at r from the stub. A little
   more stays straight, so that the cut is square. Exact for a straight edge. test_layout.c
   tethers_break_at_the_body */
static double neck_depth(const fw_layout_drawing *d, const fw_layout_attachment *a, double at,
                         double deep) {
    double r = d->corner_m[a->body], far = 0.5 * fw_layout_rule.tether_neck_m + r;
    double low = edge_depth(d, a, at - far, deep), high = edge_depth(d, a, at + far, deep);
    double middle = edge_depth(d, a, at, deep), slope = (high - low) / (2.0 * far);
    double cut =
        fmin(middle, fmin(low, high)) - r * hypot(1.0, slope) - fw_layout_rule.neck_straight_m;
    return middle - cut < fw_layout_rule.tether_cut_m ? fw_layout_to_grid(cut)
                                                      : -1.0; /* else: no straight edge */
}

/* the tether's own outline: the neck, widened to the finger, to the frame's stub */
static fw_status draw_tether(fw_layout_drawing *d, double at, double cut, fw_layout_attachment *a) {
    const fw_layout_local world = {{0.0, 0.0}, 1.0, 0.0, false};
    double neck = 0.5 * fw_layout_rule.tether_neck_m, narrow = cut - fw_layout_rule.neck_long_m,
           wide = narrow - (fw_layout_rule.tether_m - fw_layout_rule.tether_neck_m);
    double along[8] = {at - neck, at - neck, a->low_m,  a->low_m,
                       a->high_m, a->high_m, at + neck, at + neck};
    double depth[8] = {cut, narrow, wide, a->stub_m, a->stub_m, wide, narrow, cut};
    fw_layout_sketch sketch = {.local = &world};
    fw_geometry_contour sharp;
    fw_geometry_vec2 where;
    for (int i = 0; i <= 8; i++) {
        fw_geometry_vec2 p = fw_layout_window_point(d->layout, a->side, along[i % 8], depth[i % 8]);
        if (i == 0)
            sketch = fw_layout_sketch_start(d->arena, &world, p);
        else
            fw_layout_sketch_line(&sketch, p, i == 4 || i == 8 ? FW_SEGMENT_JOINT : 0);
    }
    FW_TRY(fw_layout_sketch_close(&sketch, &sharp));
    return fw_geometry_contour_round(d->arena, &sharp, fw_layout_rule.corner_m,
                                     fw_layout_rule.corner_m, &a->tether, &where);
}

/* body with one more stub, rounded as without it; not done when the stub does not fit there */
static fw_status add_stub(fw_layout_drawing *d, int body, double at, double cut, double deep,
                          fw_layout_window_side side, bool *done) {
    const fw_layout_local world = {{0.0, 0.0}, 1.0, 0.0, false};
    double neck = 0.5 * fw_layout_rule.tether_neck_m, r = d->corner_m[body];
    fw_geometry_vec2 p[4] = {fw_layout_window_point(d->layout, side, at - neck, deep),
                             fw_layout_window_point(d->layout, side, at - neck, cut),
                             fw_layout_window_point(d->layout, side, at + neck, cut),
                             fw_layout_window_point(d->layout, side, at + neck, deep)};
    fw_geometry_contour stub, held;
    fw_geometry_region raw = {&d->raw[body], 1}, add = {&stub, 1}, both;
    fw_geometry_vec2 where;
    *done = false;
    FW_TRY(fw_layout_polygon(d->arena, &world, p, 4, 1, &stub));
    fw_status status = fw_geometry_region_boolean(d->arena, &raw, &add, FW_UNION, &both);
    if (status == FW_OK && both.count == 1)
        status = fw_geometry_contour_round(d->arena, &both.contour[0], r, r, &held, &where);
    if (status == FW_GEOMETRY || (status == FW_OK && both.count != 1)) return FW_OK;
    FW_TRY(status);
    d->raw[body] = both.contour[0];
    d->held[body] = held;
    *done = true;
    return FW_OK;
}

static fw_status try_finger(fw_layout_drawing *d, int body, fw_layout_window_side side,
                            fw_geometry_vec2 from, bool *done) {
    fw_layout_attachment a = {.body = body};
    bool up = side == FW_LEFT || side == FW_RIGHT;
    double start = up ? from.x : from.y, along = up ? from.y : from.x;
    *done = false;
    FW_TRY(fw_layout_strip_draw(d, side, start, start, along, 0.5 * fw_layout_rule.tether_m,
                                fw_layout_rule.tether_stub_m, &a));
    if (!leaves_once(d, &a, from) || !finger_is_clear(d, &a.finger, body)) return FW_OK;
    fw_geometry_vec2 edge = fw_layout_window_point(d->layout, side, along, 0.0);
    double at = fw_layout_to_grid(along), deep = fw_norm(fw_sub(edge, from));
    double cut = neck_depth(d, &a, at, deep);
    if (cut < fw_layout_rule.finger_least_m)
        return FW_OK; /* no length for neck, finger and the frame's stub */
    FW_TRY(add_stub(d, body, at, cut, deep, side, done));
    if (!*done) return FW_OK;
    FW_TRY(draw_tether(d, at, cut, &a));
    return fw_layout_attachment_add(d, &a);
}

static void sides_by_distance(const fw_layout *l, fw_geometry_vec2 p,
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

/* two fingers in mirrored places on the nearest side where that works, else any two, else one */
static fw_status hold_plate(fw_layout_drawing *d, int body, int *held) {
    const fw_device_body *b = &d->device->body[body];
    static const double place[] = {0.14, 0.22, 0.07, 0.3, 0.38};
    fw_geometry_vec2 middle = fw_v(b->plate_x_m, b->plate_y_m), x = fw_polar(b->plate_angle_rad);
    fw_layout_window_side order[4];
    sides_by_distance(d->layout, middle, order);
    for (int s = 0; s < 4 && *held < 2; s++) {
        fw_geometry_vec2 out = fw_layout_window_outward(order[s]), y = fw_left(x);
        bool across = fabs(fw_dot(out, y)) > fabs(fw_dot(out, x));
        fw_geometry_vec2 along = across ? x : y;
        double size = across ? b->plate_width_m : b->plate_height_m;
        for (size_t i = 0; i < sizeof place / sizeof place[0] && *held < 2; i++)
            for (int sign = -1; sign <= 1 && *held < 2; sign += 2) {
                bool done;
                FW_TRY(try_finger(d, body, order[s], fw_add(middle, sign * place[i] * size, along),
                                  &done));
                *held += done;
            }
    }
    return FW_OK;
}

/* one finger from the bar of a link, near its middle */
static fw_status hold_bar(fw_layout_drawing *d, int body, int *held) {
    int joint[2];
    static const double place[] = {0.5, 0.42, 0.58, 0.35, 0.65};
    if (fw_layout_body_joints(d->device, body, joint, 2) != 2) return FW_OK;
    fw_geometry_vec2 p = fw_layout_joint_point(d->device, joint[0]),
                     q = fw_layout_joint_point(d->device, joint[1]);
    fw_layout_window_side order[4];
    sides_by_distance(d->layout, fw_v(0.5 * (p.x + q.x), 0.5 * (p.y + q.y)), order);
    for (int s = 0; s < 4 && *held < 1; s++) {
        fw_geometry_vec2 along = fw_towards(p, q), out = fw_layout_window_outward(order[s]);
        if (fabs(fw_dot(along, out)) > 0.8) continue; /* would run along the bar */
        for (size_t i = 0; i < sizeof place / sizeof place[0] && *held < 1; i++) {
            bool done;
            FW_TRY(try_finger(d, body, order[s], fw_add(p, place[i], fw_sub(q, p)), &done));
            *held += done;
        }
    }
    return FW_OK;
}

/* where a line straight inwards from a side meets the body, if its edge is one there and beside; a
   stub near a corner that somebody drew would leave a slit. Segment -1: it is not */
static fw_layout_ray_hit smooth_edge(const fw_layout_drawing *d, int body,
                                     fw_layout_window_side side, double along) {
    const double beside = 30e-6;
    fw_geometry_vec2 out = fw_layout_window_outward(side), in = fw_v(-out.x, -out.y);
    fw_layout_ray_hit hit[3];
    for (int k = 0; k < 3; k++) {
        double at = along + (k - 1) * beside;
        hit[k] = fw_layout_first_hit(&d->plain[body],
                                     fw_layout_window_point(d->layout, side, at, 0.0), in);
    }
    if (hit[0].segment != hit[1].segment || hit[2].segment != hit[1].segment) hit[1].segment = -1;
    return hit[1];
}

/* Two fingers to what a description draws of a body: on the nearest side of the window where that
   works, else on any two, from places in the inner part of the body's own extent */
static fw_status hold_shapes(fw_layout_drawing *d, int body, int *held) {
    static const double place[] = {0.5, 0.35, 0.65, 0.25, 0.75, 0.42, 0.58, 0.3, 0.7, 0.2, 0.8};
    const double into = 30e-6, apart = 0.25;
    fw_geometry_box box = fw_geometry_contour_box(&d->plain[body]);
    fw_layout_window_side order[4];
    double taken = HUGE_VAL; /* share of the place that has a finger on this side */
    sides_by_distance(d->layout, d->layout->body[body].centroid, order);
    for (int s = 0; s < 4 && *held < 2; s++, taken = HUGE_VAL) {
        bool up = order[s] == FW_LEFT || order[s] == FW_RIGHT;
        fw_geometry_vec2 out = fw_layout_window_outward(order[s]);
        for (size_t i = 0; i < sizeof place / sizeof place[0] && *held < 2; i++) {
            double along =
                up ? box.y0 + place[i] * (box.y1 - box.y0) : box.x0 + place[i] * (box.x1 - box.x0);
            fw_layout_ray_hit hit = smooth_edge(d, body, order[s], along);
            bool done;
            if (hit.segment < 0 || fabs(place[i] - taken) < apart) continue;
            FW_TRY(try_finger(d, body, order[s], fw_add(hit.at, -into, out), &done));
            if (done) taken = place[i];
            *held += done;
        }
    }
    return FW_OK;
}

static bool is_heavy(const fw_device *device, int body) {
    return !isnan(device->body[body].plate_width_m) || fw_layout_has_shapes(device, body);
}

/* what a broken tether leaves standing is in nobody's way and everything is held: platforms and
   bodies of shapes or, without one, the bodies furthest from the ground; the links between hang on
   their hinges */
static bool needs_tether(const fw_device *device, int body) {
    int most = 0;
    bool plates = false;
    for (int b = 0; b < device->nbody; b++) {
        plates = plates || is_heavy(device, b);
        int steps = fw_layout_steps_to_ground(device, b);
        most = steps > most ? steps : most;
    }
    return plates ? is_heavy(device, body) : fw_layout_steps_to_ground(device, body) == most;
}

/* a body that no finger reaches freely stays without; a platform without is worth a warning */
fw_status fw_layout_tethers_draw(fw_layout_drawing *d) {
    if (!d->device->die.tethers) return FW_OK;
    for (int b = 0; b < d->device->nbody; b++) {
        bool plate = is_heavy(d->device, b);
        int held = 0;
        if (!needs_tether(d->device, b)) continue;
        if (fw_layout_has_shapes(d->device, b))
            FW_TRY(hold_shapes(d, b, &held));
        else if (plate)
            FW_TRY(hold_plate(d, b, &held));
        else
            FW_TRY(hold_bar(d, b, &held));
        if (!plate || held > 0) continue;
        const char *label = fw_layout_body_label(d, b);
        FW_NEED(label);
        fw_diag_warning(d->diags, 127, d->device->body[b].place,
                        "%s has no tether: no straight finger of the frame reaches it without "
                        "crossing another part, so that nothing holds it between release and "
                        "use; handle the released device with care, or leave it free access to "
                        "one side",
                        label);
    }
    return FW_OK;
}
