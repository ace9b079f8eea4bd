/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tethers: fingers of the frame that hold the moving bodies by a neck until it is broken. The body
   keeps a short stub; everything beyond the neck stays on the frame. */
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>
#include <string.h>

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

/* is this edge one of the outline's, a cut of it? */
static bool has_cut(const fw_geometry_contour *c, fw_geometry_vec2 a, fw_geometry_vec2 b) {
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        const bool same = (vec_same(s->a, a) && vec_same(s->b, b)) ||
                          (vec_same(s->a, b) && vec_same(s->b, a)); /* sides of the window differ */
        if (same && (s->flags & FW_SEGMENT_JOINT)) return true;
    }
    return false;
}

/* Body with one more stub, rounded as without it; not done when the stub does not fit there, or does not end
   outside of the body: the finger would then run into it and be as wide as it is, without a neck. */
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
    if (!has_cut(&held, p[1], p[2])) return FW_OK;
    d->raw[body] = both.contour[0];
    d->held[body] = held;
    *done = true;
    return FW_OK;
}

/* a point of this body (local) within reach of a box */
static bool is_near(const fw_layout_drawing *d, int body, int of, fw_geometry_vec2 local,
                    const fw_geometry_box *box) {
    if (of != body || isnan(local.x) || isnan(local.y)) return false;
    const fw_device_body *b = &d->device->body[body];
    fw_geometry_vec2 frame = fw_v(b->x_m, b->y_m),
                     turned = fw_geometry_vec_rotate(local, b->phi_rad);
    if (!vec_finite(frame)) frame = d->layout->body[body].centroid;
    const fw_geometry_vec2 p = vec_add(frame, turned);
    const fw_geometry_box at = {p.x, p.y, p.x, p.y};
    return fw_box_gap(*box, at) < fw_layout_rule.finger_works_m;
}

/* Is the finger, from its cut to the frame's edge, where the body meets something, a contact or a spring
   of its own? Its stub, and what is left of the finger, would be between them. */
static bool works_at(const fw_layout_drawing *d, int body, fw_geometry_vec2 cut,
                     fw_geometry_vec2 edge) {
    const fw_geometry_box own = {fw_lesser(cut.x, edge.x), fw_lesser(cut.y, edge.y),
                                 fw_greater(cut.x, edge.x), fw_greater(cut.y, edge.y)};
    const fw_device *device = d->device;
    for (int i = 0; i < device->nspring; i++) {
        const fw_device_spring *s = &device->spring[i];
        if (is_near(d, body, s->body_a, fw_v(s->ax_m, s->ay_m), &own) ||
            is_near(d, body, s->body_b, fw_v(s->bx_m, s->by_m), &own))
            return true;
    }
    for (int k = 0; k < device->nscene; k++)
        for (int i = 0; i < device->scene[k].ncontact; i++) {
            const fw_device_contact_use *c = &device->scene[k].contact[i];
            if (c->joint == FW_NONE && (is_near(d, body, c->body_a, fw_v(c->ax_m, c->ay_m), &own) ||
                                        is_near(d, body, c->body_b, fw_v(c->bx_m, c->by_m), &own)))
                return true;
        }
    return false;
}

static fw_status try_finger(fw_layout_drawing *d, int body, fw_layout_window_side side,
                            fw_geometry_vec2 from, bool *done) {
    fw_layout_attachment a = {.body = body};
    bool up = side == FW_LEFT || side == FW_RIGHT;
    double start = up ? from.x : from.y, along = up ? from.y : from.x;
    *done = false;
    FW_TRY(fw_layout_strip_draw(d, side, start, start, along, 0.5 * fw_layout_rule.tether_m,
                                fw_layout_rule.tether_stub_m, &a));
    if (!fw_layout_finger_leaves_once(d, &a, from) ||
        !fw_layout_finger_is_clear(d, &a.finger, body))
        return FW_OK;
    fw_geometry_vec2 edge = fw_layout_window_point(d->layout, side, along, 0.0);
    double at = fw_layout_to_grid(along), deep = fw_norm(fw_sub(edge, from));
    double cut = fw_layout_finger_cut(d, &a, at, deep);
    if (cut < fw_layout_rule.finger_least_m)
        return FW_OK; /* no length for neck, finger and the frame's stub */
    if (works_at(d, body, fw_layout_window_point(d->layout, side, at, cut), edge)) return FW_OK;
    FW_TRY(add_stub(d, body, at, cut, deep, side, done));
    if (!*done) return FW_OK;
    a.at_m = at;
    a.cut_m = cut;
    FW_TRY(draw_tether(d, at, cut, &a));
    return fw_layout_attachment_add(d, &a);
}

/* two fingers in mirrored places on the nearest side where that works, else any two, else one */
static fw_status hold_plate(fw_layout_drawing *d, int body, int *held) {
    const fw_device_body *b = &d->device->body[body];
    static const double place[] = {0.14, 0.22, 0.07, 0.3, 0.38};
    fw_geometry_vec2 middle = fw_v(b->plate_x_m, b->plate_y_m), x = fw_polar(b->plate_angle_rad);
    fw_layout_window_side order[4];
    fw_layout_sides_by_distance(d->layout, middle, order);
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
    fw_layout_sides_by_distance(d->layout, fw_v(0.5 * (p.x + q.x), 0.5 * (p.y + q.y)), order);
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

/* Two fingers to what a description draws of a body: on the nearest side of the window where that
   works, else on any two, from places in the inner part of the body's own extent */
static fw_status hold_shapes(fw_layout_drawing *d, int body, int *held) {
    static const double place[] = {0.5, 0.35, 0.65, 0.25, 0.75, 0.42, 0.58, 0.3, 0.7, 0.2, 0.8};
    const double into = 30e-6, apart = 0.25;
    fw_geometry_box box = fw_geometry_contour_box(&d->plain[body]);
    fw_layout_window_side order[4];
    double taken = HUGE_VAL; /* share of the place that has a finger on this side */
    fw_layout_sides_by_distance(d->layout, d->layout->body[body].centroid, order);
    for (int s = 0; s < 4 && *held < 2; s++, taken = HUGE_VAL) {
        bool up = order[s] == FW_LEFT || order[s] == FW_RIGHT;
        fw_geometry_vec2 out = fw_layout_window_outward(order[s]);
        for (size_t i = 0; i < sizeof place / sizeof place[0] && *held < 2; i++) {
            double along =
                up ? box.y0 + place[i] * (box.y1 - box.y0) : box.x0 + place[i] * (box.x1 - box.x0);
            fw_layout_ray_hit hit = fw_layout_finger_edge(d, body, order[s], along);
            bool done;
            if (hit.segment < 0 || fabs(place[i] - taken) < apart) continue;
            FW_TRY(try_finger(d, body, order[s], fw_add(hit.at, -into, out), &done));
            if (done) taken = place[i];
            *held += done;
        }
    }
    return FW_OK;
}

/* one finger to any place of a body's edge, where none of the usual ones has room: outwards from the
   middle of each side */
static fw_status hold_anywhere(fw_layout_drawing *d, int body, int *held) {
    const double into = 30e-6, step = 10e-6;
    fw_geometry_box box = fw_geometry_contour_box(&d->plain[body]);
    fw_layout_window_side order[4];
    fw_layout_sides_by_distance(d->layout, d->layout->body[body].centroid, order);
    for (int s = 0; s < 4 && *held < 1; s++) {
        bool up = order[s] == FW_LEFT || order[s] == FW_RIGHT;
        double low = up ? box.y0 : box.x0, high = up ? box.y1 : box.x1, middle = 0.5 * (low + high);
        fw_geometry_vec2 out = fw_layout_window_outward(order[s]);
        for (double off = 0.0; middle + off < high && *held < 1; off += step)
            for (int sign = -1; sign <= (off > 0.0) && *held < 1; sign += 2) {
                fw_layout_ray_hit hit =
                    fw_layout_finger_edge(d, body, order[s], middle + sign * off);
                bool done = false;
                if (hit.segment >= 0)
                    FW_TRY(try_finger(d, body, order[s], fw_add(hit.at, -into, out), &done));
                *held += done;
            }
    }
    return FW_OK;
}

/* one finger to a place between those, where an opening has just room for it */
static fw_status hold_in_opening(fw_layout_drawing *d, int body, int *held) {
    const double into = 30e-6;
    fw_layout_fit fit[FW_LAYOUT_FITS];
    fw_geometry_vec2 at;
    const char *why, *room;
    int nfit;
    FW_TRY(fw_layout_tether_room(d, body, fit, &nfit, &at, &why, &room));
    for (int i = 0; i < nfit && *held < 1; i++) {
        fw_layout_ray_hit hit = fw_layout_finger_edge(d, body, fit[i].side, fit[i].along);
        fw_geometry_vec2 out = fw_layout_window_outward(fit[i].side);
        bool done = false;
        if (hit.segment >= 0)
            FW_TRY(try_finger(d, body, fit[i].side, fw_add(hit.at, -into, out), &done));
        *held += done;
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

static fw_status say_missing(fw_layout_drawing *d, int body) {
    fw_layout_missing m = {.number = 127, .body = body, .place = d->device->body[body].place};
    fw_layout_fit fit[FW_LAYOUT_FITS];
    int nfit;
    const char *label = fw_layout_body_label(d, body);
    FW_NEED(label);
    FW_NEED(m.name = fw_arena_printf(d->arena, "the tethers of %s", label));
    FW_TRY(fw_layout_tether_room(d, body, fit, &nfit, &m.at, &m.why, &m.room));
    return fw_layout_missing_add(d, m);
}

/* fingers to a body, as its kind has them */
static fw_status hold(fw_layout_drawing *d, int body, int *held) {
    *held = 0;
    if (fw_layout_has_shapes(d->device, body))
        FW_TRY(hold_shapes(d, body, held));
    else if (is_heavy(d->device, body))
        FW_TRY(hold_plate(d, body, held));
    else
        FW_TRY(hold_bar(d, body, held));
    if (*held == 0) FW_TRY(hold_anywhere(d, body, held));
    return *held == 0 ? hold_in_opening(d, body, held) : FW_OK;
}

/* fingers to all bodies in this order; *without: how many of them have none, *first the first of them */
static fw_status hold_all(fw_layout_drawing *d, const int *order, int n, int *held, int *without,
                          int *first) {
    *without = 0;
    for (int i = 0; i < n; i++) {
        FW_TRY(hold(d, order[i], &held[order[i]]));
        if (held[order[i]] > 0) continue;
        if ((*without)++ == 0) *first = i;
    }
    return FW_OK;
}

/* the drawing as it was before any finger */
static void let_go(fw_layout_drawing *d, const fw_geometry_contour *raw, int nattachment) {
    for (int b = 0; b < d->device->nbody; b++) {
        d->raw[b] = raw[b];
        d->held[b].count = 0;
    }
    d->nattachment = nattachment;
}

/* a finger may stand in another body's way: one that got none goes first, and all is tried again */
static fw_status hold_in_turn(fw_layout_drawing *d, int *order, int n, int *held) {
    const int before = d->nattachment;
    const size_t bodies = (size_t)d->device->nbody;
    fw_geometry_contour *raw = fw_arena_grow(d->arena, d->raw, bodies, bodies, sizeof *raw);
    int *best = fw_arena_grow(d->arena, order, (size_t)n, (size_t)n, sizeof *best);
    int without, first = 0, least;
    FW_NEED(raw && best ? d : NULL);
    FW_TRY(hold_all(d, order, n, held, &without, &first));
    least = without;
    for (int round = 1; round < n && without > 0 && first > 0; round++) {
        int moved = order[first];
        memmove(order + 1, order, (size_t)first * sizeof *order);
        order[0] = moved;
        let_go(d, raw, before);
        FW_TRY(hold_all(d, order, n, held, &without, &first));
        if (without >= least) continue;
        least = without;
        memcpy(best, order, (size_t)n * sizeof *best);
    }
    if (without == least) return FW_OK;
    let_go(d, raw, before);
    return hold_all(d, best, n, held, &without, &first);
}

static fw_status say_held(fw_layout_drawing *d, int body, int held) {
    const char *label;
    if (held == 0) return say_missing(d, body);
    if (held > 1 || d->said || !is_heavy(d->device, body)) return FW_OK;
    FW_NEED(label = fw_layout_body_label(d, body));
    fw_diag_note(d->diags, 127, d->device->body[body].place,
                 "%s is held by one tether: a second finger finds no room", label);
    return FW_OK;
}

/* a body that no finger reaches is among what is missing */
fw_status fw_layout_tethers_draw(fw_layout_drawing *d) {
    size_t bodies = (size_t)d->device->nbody;
    int *order, *held, n = 0;
    if (!d->device->die.tethers) return FW_OK;
    FW_NEED(order = fw_arena_array(d->arena, int, bodies));
    FW_NEED(held = fw_arena_array(d->arena, int, bodies));
    for (int b = 0; b < d->device->nbody; b++)
        if (needs_tether(d->device, b)) order[n++] = b;
    FW_TRY(hold_in_turn(d, order, n, held));
    for (int b = 0; b < d->device->nbody; b++)
        if (needs_tether(d->device, b)) FW_TRY(say_held(d, b, held[b]));
    return FW_OK;
}
