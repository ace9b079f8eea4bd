/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges: where the bulge points, the two rings about W. docs/theory/layout.md, sections 2 and 3.
 */
#include "base/constants.h"
#include "layout/draw.h"
#include <math.h>

static const double FILLET_SAME = 0.01; /* no mask shows the difference */

static const fw_layout_hinge_drawer drawers[] = {
    {FW_FLEXURE_CSFH, fw_layout_hinge_shape_csfh},
    {FW_FLEXURE_LEAF, fw_layout_hinge_shape_leaf},
};

static double cross(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x * q.y - p.y * q.x;
}
static double angle_of(fw_geometry_vec2 p) {
    return atan2(p.y, p.x);
}

/* ---- which way ---- */

/* Where the spokes of a body with more than two hinges meet: in the middle of them. With hinges in
   line one of them is in the way of the others' spokes there; then (beside: only for bodies that
   cannot be drawn otherwise) the hub stands beside the line, on the side where no other body
   leaves, clear of the longest flexure. test_layout_hubs.c */
fw_geometry_vec2 fw_layout_body_hub(const fw_layout_drawing *d, int body) {
    const fw_device *device = d->device;
    fw_geometry_vec2 sum = fw_v(0.0, 0.0), along = sum, others = sum, first = sum;
    double clear = 0.0;
    int n = 0;
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_device_revolute *t = &device->revolute[j];
        if (t->body_a != body && t->body_b != body) continue;
        fw_geometry_vec2 p = fw_layout_joint_point(device, j);
        int other = t->body_a == body ? t->body_b : t->body_a;
        if (n++ == 0) first = p;
        if (fw_norm(fw_sub(p, first)) > fw_norm(along)) along = fw_sub(p, first);
        if (other >= 0 && isfinite(device->body[other].x_m + device->body[other].y_m))
            others = fw_add(others, 1.0,
                            fw_sub(fw_v(device->body[other].x_m, device->body[other].y_m), p));
        clear = fmax(clear, device->flexure[t->flexure].length_m);
        sum = fw_add(sum, 1.0, p);
    }
    fw_geometry_vec2 hub = fw_v(sum.x / n, sum.y / n);
    if (!d->beside || !d->beside[body]) return hub;
    double size = fw_norm(along);
    fw_geometry_vec2 out =
        size > 0.0 ? fw_left(fw_v(along.x / size, along.y / size)) : fw_v(0.0, 1.0);
    return fw_add(
        hub, (fw_dot(out, others) > 0.0 ? -1.0 : 1.0) * (clear + fw_layout_rule.hub_clear_m), out);
}

/* where a body's material lies, seen from one of its hinges */
static fw_geometry_vec2 body_target(const fw_layout_drawing *d, int body, int joint) {
    const fw_device *device = d->device;
    fw_geometry_vec2 here = fw_layout_joint_point(device, joint), other = here;
    int n = 0;
    for (int j = 0; j < device->nrevolute; j++) {
        if (device->revolute[j].body_a != body && device->revolute[j].body_b != body) continue;
        fw_geometry_vec2 p = fw_layout_joint_point(device, j);
        n++;
        if (j != joint) other = p;
    }
    if (body >= 0 && !isnan(device->body[body].plate_width_m))
        return fw_v(device->body[body].plate_x_m, device->body[body].plate_y_m);
    if (n == 2 && (body >= 0 || !d->base_side)) return other;
    if (n > 2 && body >= 0) return fw_layout_body_hub(d, body);
    if (body >= 0) return fw_v(device->body[body].x_m, device->body[body].y_m);
    /* own base: straight to the frame (layout_build.c: draw_device) */
    if (d->base_side) return fw_add(here, 1.0, fw_layout_window_outward(d->base_side[joint]));
    fw_geometry_vec2 out = fw_sub(here, d->centre);
    if (fabs(out.x) > fabs(out.y)) return fw_add(here, out.x > 0.0 ? 1.0 : -1.0, fw_v(1.0, 0.0));
    return fw_add(here, out.y > 0.0 ? 1.0 : -1.0, fw_v(0.0, 1.0));
}

/* from W along its direction until a body's plate begins; 0: inside, or no plate */
static double plate_begins(const fw_device_body *b, fw_geometry_vec2 w,
                           fw_geometry_vec2 direction) {
    double c = cos(b->plate_angle_rad), s = sin(b->plate_angle_rad), begin = 0.0;
    fw_geometry_vec2 to = fw_sub(w, fw_v(b->plate_x_m, b->plate_y_m));
    double x = fabs(c * to.x + s * to.y) - 0.5 * b->plate_width_m;
    double y = fabs(c * to.y - s * to.x) - 0.5 * b->plate_height_m;
    if (x > 0.0) begin = fmax(begin, x / fabs(c * direction.x + s * direction.y));
    if (y > 0.0) begin = fmax(begin, y / fabs(c * direction.y - s * direction.x));
    return begin;
}

static double half_width(const fw_layout_drawing *d, int body) {
    const fw_device *device = d->device;
    if (body >= 0) {
        const fw_device_body *b = &device->body[body];
        double plate = fw_layout_rule.neck_plate_share * fmin(b->plate_width_m, b->plate_height_m),
               wide = 0.5 * b->width_m;
        if (isnan(plate)) return isnan(wide) ? 0.5 * fw_layout_rule.neck_width_m : wide;
        return fmin(isnan(wide) ? 0.5 * fw_layout_rule.neck_width_m : wide, plate);
    }
    if (device->die.anchor_m > 0.0) return 0.5 * device->die.anchor_m;
    double widest = 0.0;
    for (int i = 0; i < device->nbody; i++)
        if (device->body[i].width_m > widest) widest = device->body[i].width_m;
    return 0.5 * (widest > 0.0 ? fmin(fw_layout_rule.base_width_m, 2.0 * widest)
                               : fw_layout_rule.base_width_m);
}

/* joints between a body and the ground, so that mirrored hinges get mirrored rings */
int fw_layout_steps_to_ground(const fw_device *device, int body) {
    enum { MOST = 64 };
    unsigned char level[MOST + 1] = {0}; /* 1 + steps; 0: not reached */
    if (device->nbody > MOST) return body;
    level[device->nbody] = 1;
    for (int round = 0; round < device->nbody; round++)
        for (int j = 0; j < device->nrevolute; j++) {
            int a = device->revolute[j].body_a, b = device->revolute[j].body_b;
            a = a < 0 ? device->nbody : a;
            b = b < 0 ? device->nbody : b;
            if (level[a] == round + 1 && !level[b]) level[b] = (unsigned char)(round + 2);
            if (level[b] == round + 1 && !level[a]) level[a] = (unsigned char)(round + 2);
        }
    return level[body < 0 ? device->nbody : body];
}

static double choose_axis(const fw_layout_drawing *d, int joint, fw_geometry_vec2 da,
                          fw_geometry_vec2 db) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    if (!isnan(j->axis_rad)) return j->axis_rad;
    fw_geometry_vec2 between = fw_add(da, 1.0, db);
    if (fw_norm(between) > fw_layout_rule.opposite_norm)
        return angle_of(fw_v(-between.x, -between.y));
    fw_geometry_vec2 side = fw_left(da),
                     away = fw_sub(fw_layout_joint_point(d->device, joint), d->centre);
    if (fw_dot(side, away) < 0.0) side = fw_v(-side.x, -side.y);
    return angle_of(side);
}

/* ---- the rings ---- */

/* radii about W, from inside: flexure, free width, convex ring, gap, concave ring */
typedef struct rings {
    double convex_in_m, convex_out_m, concave_in_m, concave_out_m;
} rings;

static rings rings_of(const fw_layout_hinge_plan *plan, double gap) {
    const fw_layout_hinge_shape *s = &plan->shape[0], *t = &plan->shape[1];
    const fw_layout_rules *rule = &fw_layout_rule;
    double free_width =
        fmin(fmax(rule->ring_free_sizes * s->size_m, rule->ring_free_m), rule->ring_free_most_m);
    double sized = fmin(fmax(rule->ring_sizes * s->size_m, rule->ring_least_m), rule->ring_m);
    double thick = fmax(rule->ring_widths * fmax(s->width_m, t->width_m), sized);
    double reach = fmax(fmax(s->reach_m, fw_norm(s->inner_corner)),
                        fmax(t->reach_m, fw_norm(t->inner_corner)));
    rings r = {.convex_in_m = reach + free_width};
    r.convex_out_m = r.convex_in_m + thick;
    r.concave_in_m = r.convex_out_m + (gap > 0.0 ? gap : rule->corner_m);
    r.concave_out_m = r.concave_in_m + thick;
    return r;
}

static double keep_out_of(const fw_layout_hinge_plan *plan, double gap) {
    return rings_of(plan, gap).concave_out_m + fw_layout_rule.beside_ring_m;
}

static void choose_rings(fw_layout_hinge_plan *plan, const fw_device_flexure *f) {
    const double gap = f->gap_m;
    rings r = rings_of(plan, gap);
    fw_layout_side *in = &plan->side[plan->convex], *out = &plan->side[!plan->convex];
    in->ring_in_m = r.convex_in_m;
    in->ring_out_m = r.convex_out_m;
    out->ring_in_m = r.concave_in_m;
    out->ring_out_m = r.concave_out_m;
    for (int i = 0; i < 2; i++) {
        if (fw_layout_leaf_is_free(f)) { /* no surfaces: either side has the room of both rings */
            plan->side[i].ring_in_m = r.convex_in_m;
            plan->side[i].ring_out_m = r.concave_out_m;
            fw_layout_side_straighten(&plan->side[i], &plan->shape[i]);
        }
        fw_layout_neck_choose(&plan->side[i], keep_out_of(plan, gap));
    }
}

typedef struct way { /* from a hinge into one of its bodies */
    fw_geometry_vec2 direction;
    double half_m, drawn_at_m, drawn_half_m, plate_at_m; /* as of fw_layout_side */
    const fw_device_body *plate;
} way;

/* a hinge, and a body where there is one, that the last error is about; FW_GEOMETRY */
static fw_status blame(fw_layout_drawing *d, int number, int joint, int body) {
    fw_layout_fault fault = fw_layout_fault_at(fw_layout_joint_point(d->device, joint));
    fault.number = number;
    fault.joint[fault.njoint++] = joint;
    if (body >= 0) fault.body[fault.nbody++] = body;
    FW_TRY(fw_layout_fault_keep(d, fault));
    return FW_GEOMETRY;
}

/* What is drawn of a body lies where its shortest neck finds it; where a wide neck does not, a
   narrower one is tried. A body's own plate is one more of its shapes, and the neck leads towards its
   middle where no other is nearer. Necks that would close what the description leaves open come
   last (FW-D702). Decision 207; test_shapes.c necks_find_the_nearest */
static fw_status way_to(fw_layout_drawing *d, int body, int joint, const fw_layout_hinge_plan *plan,
                        way *to) {
    static const double narrower[] = {1.0, 0.7, 0.5, 0.3};
    const fw_device *device = d->device;
    const fw_device_revolute *j = &device->revolute[joint];
    fw_geometry_vec2 w = fw_layout_joint_point(device, joint);
    *to = (way){.half_m = half_width(d, body),
                .direction = fw_towards(w, body_target(d, body, joint))};
    if (body >= 0 && !isnan(device->body[body].plate_width_m)) {
        to->plate = &device->body[body];
        to->plate_at_m = plate_begins(to->plate, w, to->direction);
    }
    if (!fw_layout_has_shapes(device, body) || (!to->plate && !fw_layout_only_shapes(device, body)))
        return FW_OK;
    const way into_plate = *to;
    const double keep_out = keep_out_of(plan, device->flexure[j->flexure].gap_m);
    fw_layout_neck_way neck = {w, keep_out, into_plate.half_m, false, 0.0};
    bool nearest = false, open = false, found = false;
    if (to->plate)
        FW_TRY(fw_layout_plate_way(d, body, &neck, to->direction, to->plate_at_m, &nearest, &open));
    if (nearest && open) return FW_OK;
    for (int across = 0; across < (open ? 1 : 2); across++)
        for (size_t i = 0; i < sizeof narrower / sizeof narrower[0]; i++) {
            neck.half_m = narrower[i] * into_plate.half_m;
            neck.across = across;
            to->half_m = neck.half_m;
            FW_TRY(
                fw_layout_shape_direction(d, body, &neck, &to->direction, &to->drawn_at_m, &found));
            to->plate = NULL;
            to->drawn_half_m = neck.half_there_m;
            if (found) return FW_OK;
        }
    if (into_plate.plate) {
        *to = into_plate;
        return FW_OK;
    }
    char x[32], y[32], r[32], least[32];
    fw_diag_error(
        d->diags, 317, j->place,
        "%s%s at (%s, %s) um hangs in the air: no straight neck of %s um width finds "
        "what is drawn of %s%s, starting from the hinge's free circle of radius %s "
        "um (that is the narrowest that is tried); draw the body nearer to the hinge and at "
        "least as wide there, or state a smaller width of the body, of which its necks are",
        FW_NAMED("hinge", j->id), fw_layout_um(x, w.x), fw_layout_um(y, w.y),
        fw_layout_um(least, 2.0 * to->half_m), FW_NAMED("body", device->body[body].id),
        fw_layout_um(r, keep_out));
    return blame(d, 317, joint, body);
}

/* Is a at the end on the left of the axis? Where both lead the same way, as a base does that was not turned yet, what is
   not the ground is at the end that lies towards it, whichever way the axis points. */
static bool a_is_up(const fw_device_revolute *j, fw_geometry_vec2 n, fw_geometry_vec2 da,
                    fw_geometry_vec2 db) {
    const double same = 1e-9, a = cross(n, da), b = cross(n, db);
    const bool alike = fabs(a - b) < same;
    if (alike && j->body_a == FW_GROUND) return b < 0.0;
    return alike && j->body_b == FW_GROUND ? a >= 0.0 : a >= b;
}

static fw_status choose_sides(fw_layout_drawing *d, int joint, fw_layout_hinge_plan *plan,
                              double *axis) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    fw_geometry_vec2 w = fw_layout_joint_point(d->device, joint);
    way to_a, to_b;
    FW_TRY(way_to(d, j->body_a, joint, plan, &to_a));
    FW_TRY(way_to(d, j->body_b, joint, plan, &to_b));
    fw_geometry_vec2 da = to_a.direction, db = to_b.direction;
    *axis = choose_axis(d, joint, da, db);
    fw_geometry_vec2 n = fw_polar(*axis);
    const bool a_up = a_is_up(j, n, da, db);
    for (int i = 0; i < 2; i++) {
        fw_layout_side *side = &plan->side[i];
        bool is_a = (i == 1) == a_up;
        side->body = is_a ? j->body_a : j->body_b;
        side->direction = is_a ? da : db;
        side->half_width_m = is_a ? to_a.half_m : to_b.half_m;
        side->form = fw_layout_head_form(0);
        side->plate = is_a ? to_a.plate : to_b.plate;
        side->plate_at_m = is_a ? to_a.plate_at_m : to_b.plate_at_m;
        side->drawn_at_m = is_a ? to_a.drawn_at_m : to_b.drawn_at_m;
        side->drawn_half_m = is_a ? to_a.drawn_half_m : to_b.drawn_half_m;
        side->local = (fw_layout_local){w, n.x, n.y, i == 0};
        double up = cross(n, side->direction), along = fw_dot(n, side->direction);
        side->own_rad = atan2(i == 0 ? -up : up, along);
        if (side->own_rad < -0.5 * FW_PI) side->own_rad += 2.0 * FW_PI;
    }
    int low = fw_layout_steps_to_ground(d->device, plan->side[0].body);
    int high = fw_layout_steps_to_ground(d->device, plan->side[1].body);
    plan->convex = low == high ? plan->side[1].body > plan->side[0].body : high > low;
    return FW_OK;
}

/* A ring runs on past the bulge until the other body's stem (inside) or bar (outside) is the free
   rotation away. Returns the sector in which the two surfaces face each other. */
static double choose_ring_ends(fw_layout_hinge_plan *plan, double gap) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_layout_hinge_shape *s = &plan->shape[plan->convex];
    fw_layout_side *in = &plan->side[plan->convex], *out = &plan->side[!plan->convex];
    double stem = fmin(angle_of(fw_layout_ring_foot(s, in->ring_in_m)),
                       angle_of(fw_layout_ring_foot(s, in->ring_out_m)));
    double bar = in->own_rad - asin(in->neck_m / out->ring_in_m);
    in->ring_end_rad = fmax(rule->free_rad - stem, -rule->ring_past_rad);
    out->ring_end_rad = fmax(rule->free_rad - bar, -rule->ring_past_rad);
    for (int i = 0; i < 2; i++) {
        fw_layout_side *side = &plan->side[i];
        double q0 = side->ring_in_m, q1 = side->ring_out_m;
        double most =
            fmin(angle_of(fw_layout_ring_foot(&plan->shape[i], q0)) - rule->ring_from_face_m / q0,
                 side->own_rad - asin(side->neck_m / q1) - rule->ring_from_neck_m / q1);
        if (!(gap > 0.0) || side->ring_end_rad > most) side->ring_end_rad = most;
    }
    return -in->ring_end_rad - out->ring_end_rad;
}

static fw_status refuse(fw_layout_drawing *d, int joint, int number, const char *what) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    const fw_device_flexure *f = &d->device->flexure[j->flexure];
    char length[32], width[32], angle[32];
    bool turns = isfinite(f->angle_rad); /* not a leaf */
    fw_diag_error(d->diags, number, f->place, "%s%s (length %s um, width %s um%s%s%s): %s",
                  FW_NAMED("hinge", j->id), fw_layout_um(length, f->length_m),
                  fw_layout_um(width, f->width_m), turns ? ", angle " : "",
                  turns ? fw_number_text(angle, sizeof angle, f->angle_rad * 180.0 / FW_PI, 5) : "",
                  turns ? " deg" : "", what);
    return blame(d, number, joint, FW_GROUND);
}

/* a fillet of the file that does not fit; once per flexure. The layout has found the largest one
   that does: exactly for arcs and leaves, within 5 % at the ends of a path. */
static bool fillet_fits(fw_layout_drawing *d, int joint, double most_m) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    const fw_device_flexure *f = &d->device->flexure[j->flexure];
    char wanted[32], most[32], share[32], flat[32];
    if (isnan(f->fillet_m) || !(most_m < (1.0 - FILLET_SAME) * f->fillet_m)) return true;
    for (int i = 0; i < joint; i++)
        if (d->device->revolute[i].flexure == j->flexure) return false;
    const char *rule =
        f->kind == FW_FLEXURE_LEAF
            ? fw_arena_printf(d->arena, "at most %s of a leaf's length",
                              fw_number_text(share, sizeof share, fw_layout_rule.fillet_lengths, 3))
            : fw_arena_printf(
                  d->arena, "at most %s of the inner radius, with %s um of the root face left flat",
                  fw_number_text(share, sizeof share, fw_layout_rule.fillet_radii, 3),
                  fw_layout_um(flat, fw_layout_rule.root_flat_m));
    if (!rule) return false;
    fw_diag_error(d->diags, 129, f->fillet_place,
                  "%s%s: a fillet of %s um does not fit: the roots of this flexure have room "
                  "for %s um (layout rule: %s); write %s um or less, leave the fillet out, or make "
                  "the flexure longer",
                  FW_NAMED("flexure", f->id ? f->id : ""), fw_layout_um(wanted, f->fillet_m),
                  fw_layout_um(most, most_m), rule, most);
    return false;
}

static fw_status plan_hinge(fw_layout_drawing *d, int joint) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    const fw_device_flexure *f = &d->device->flexure[j->flexure];
    fw_layout_hinge_plan *plan = &d->hinge[joint];
    fw_layout_hinge_layout *layout = &d->layout->hinge[joint];
    double axis = 0.0;
    bool drawn = false;
    double fillet = isnan(f->fillet_m) ? fw_flexure_default_fillet(f) : f->fillet_m;
    plan->shape[0].fillet_m = fillet;
    if (fw_device_flexure_varies(f))
        drawn = fw_layout_hinge_shape_path(f, fillet, plan->shape);
    else {
        for (size_t i = 0; i < sizeof drawers / sizeof drawers[0]; i++)
            if (drawers[i].kind == f->kind) drawn = drawers[i].shape(f, &plan->shape[0]);
        plan->shape[1] = plan->shape[0];
    }
    if (!drawn)
        return refuse(d, joint, 121,
                      "no room for two root blocks 8 um apart and their fillets; lengthen the "
                      "flexure, or make it thinner or its angle smaller");
    if (!fillet_fits(d, joint, plan->shape[0].fillet_m)) return blame(d, 129, joint, FW_GROUND);
    FW_TRY(choose_sides(d, joint, plan, &axis));
    choose_rings(plan, f);
    double facing = choose_ring_ends(plan, f->gap_m);
    if (f->gap_m > 0.0 && facing < fw_layout_rule.facing_least_rad)
        return refuse(
            d, joint, 122,
            "the conjugate surfaces would face each other over less than 20 degrees; turn "
            "the bulge away from the links, or set gap=\"0 um\" to leave them out");
    for (int i = 0; i < 2; i++) {
        fw_status status = fw_layout_head_draw_shape(d->arena, &plan->shape[i], &plan->side[i]);
        if (status == FW_GEOMETRY)
            return refuse(d, joint, 122,
                          "the root block, the ring and the neck of one body do not join to one "
                          "outline; lengthen the flexure, or make it or the link thinner");
        FW_TRY(status);
    }
    FW_TRY(fw_layout_flexure_draw(d->arena, f, plan));
    if (fw_device_flexure_varies(f) && fw_layout_path_in_the_way(f, plan)) {
        /* a base that leaves towards another side may leave the strip free (layout_build.c: find_sides) */
        d->stuck[joint] = j->body_a == FW_GROUND || j->body_b == FW_GROUND;
        return refuse(d, joint, 264,
                      "the root blocks and rings that belong to its two ends would cross, or come "
                      "within 7 um of the strip; let the ends point away from the bulge, or open "
                      "the path");
    }

    const fw_layout_side *in = &plan->side[plan->convex], *out = &plan->side[!plan->convex];
    layout->drawn = true;
    layout->centre = fw_layout_joint_point(d->device, joint);
    layout->arc_centre = fw_layout_local_point(&plan->side[1].local, plan->shape[1].arc_centre);
    layout->axis_rad = axis;
    layout->id = d->device->revolute[joint].id;
    layout->place = d->device->flexure[d->device->revolute[joint].flexure].place;
    layout->axis_stated = !isnan(d->device->revolute[joint].axis_rad);
    layout->lower = plan->side[0].body;
    layout->upper = plan->side[1].body;
    layout->convex = in->body;
    layout->fillet_m = plan->shape[0].fillet_m;
    layout->surface_radius_m = f->gap_m > 0.0 ? in->ring_out_m : 0.0;
    layout->gap_m = f->gap_m;
    layout->facing_rad = f->gap_m > 0.0 ? facing : 0.0;
    layout->facing_from_rad = plan->side[1].ring_end_rad;
    layout->keep_out_m = out->ring_out_m + fw_layout_rule.beside_ring_m;
    return FW_OK;
}

/* the rings and where they end stay: only neck and block differ */
fw_status fw_layout_head_draw(fw_layout_drawing *d, int joint, int body, int attempt) {
    fw_layout_hinge_plan *plan = &d->hinge[joint];
    fw_layout_side *side = &plan->side[plan->side[1].body == body];
    side->attempt = attempt;
    side->form = fw_layout_head_form(attempt);
    fw_layout_neck_choose(side, d->layout->hinge[joint].keep_out_m);
    return fw_layout_head_draw_shape(d->arena, &plan->shape[side == &plan->side[1]], side);
}

/* ---- leaves that the layout turned off the legs that they hold ----
   A leaf in line with a leg bears the leg's force along itself; turned off it, it bends under that force, hundreds of times
   softer. Where pins let the bodies move, that hardly shows: the leaf turns. Where they do not, as in pairs of legs that
   snap through, all that moves does so by this give. docs/theory/layout.md, section 3; decision 137 */

/* freedoms that pins alone leave to what hangs together with a body without the ground; `in`: which
   bodies do (nbody) */
static int pin_freedoms(const fw_device *device, int body, bool *in) {
    for (int b = 0; b < device->nbody; b++)
        in[b] = b == body;
    for (bool more = true; more;) {
        more = false;
        for (int j = 0; j < device->nrevolute + device->njoint; j++) {
            const fw_device_joint *t =
                j < device->nrevolute ? NULL : &device->joint[j - device->nrevolute];
            int a = t ? t->body_a : device->revolute[j].body_a;
            int b = t ? t->body_b : device->revolute[j].body_b;
            if (a < 0 || b < 0 || in[a] == in[b]) continue;
            in[a] = in[b] = more = true;
        }
    }
    int free = 0;
    for (int b = 0; b < device->nbody; b++)
        free += in[b] ? 3 : 0;
    for (int j = 0; j < device->nrevolute; j++) {
        int a = device->revolute[j].body_a, b = device->revolute[j].body_b;
        if (in[a < 0 ? b : a]) free -= 2;
    }
    for (int j = 0; j < device->njoint; j++) {
        const fw_device_joint *t = &device->joint[j];
        if (!in[t->body_a < 0 ? t->body_b : t->body_a]) continue;
        switch (t->kind) {
        case FW_JOINT_PRISMATIC:
            free -= 2;
            break;
        case FW_JOINT_DISTANCE:
            free -= 1;
            break;
        case FW_JOINT_WELD:
            free -= 3;
            break;
        }
    }
    return free;
}

/* angle from the leaf of a joint to the line of a body between its two hinges, -90 to 90 degrees; not
   a number: the body is no leg */
static double off_leg(const fw_layout_drawing *d, int joint, int body) {
    const fw_device *device = d->device;
    int its[2];
    if (body < 0 || !isnan(device->body[body].plate_width_m) ||
        fw_layout_body_joints(device, body, its, 2) != 2)
        return (double)NAN;
    fw_geometry_vec2 leg =
        fw_sub(fw_layout_joint_point(device, its[1]), fw_layout_joint_point(device, its[0]));
    fw_geometry_vec2 leaf = fw_left(fw_polar(d->layout->hinge[joint].axis_rad));
    double angle = atan2(cross(leaf, leg), fw_dot(leaf, leg));
    if (angle > 0.5 * FW_PI) angle -= FW_PI;
    return angle < -0.5 * FW_PI ? angle + FW_PI : angle;
}

typedef struct off_its_leg {
    int joint, leg;
    double off_rad;
} off_its_leg;

/* the leg that the leaf of a joint is off by the least; leg FW_NONE: it is no such leaf */
static off_its_leg off_which_leg(const fw_layout_drawing *d, int joint, bool *scratch) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    double a = off_leg(d, joint, j->body_a), b = off_leg(d, joint, j->body_b);
    off_its_leg off = {joint, FW_NONE, 0.0};
    if (!isnan(j->axis_rad) || d->device->flexure[j->flexure].kind != FW_FLEXURE_LEAF) return off;
    if (isnan(a) && isnan(b)) return off;
    bool is_a = isnan(b) || fabs(a) < fabs(b);
    off.off_rad = is_a ? a : b;
    if (fabs(off.off_rad) < fw_layout_rule.off_leg_rad) return off;
    if (fabs(off.off_rad) < fw_layout_rule.across_leg_rad &&
        pin_freedoms(d->device, is_a ? j->body_a : j->body_b, scratch) > 0)
        return off;
    off.leg = is_a ? j->body_a : j->body_b;
    return off;
}

/* one warning of all of them */
static fw_status say_off_legs(fw_layout_drawing *d) {
    enum { NAMED = 4 };
    const fw_device *device = d->device;
    fw_text text = fw_text_new(d->arena);
    bool *scratch;
    int n = 0, first = FW_NONE;
    FW_NEED(scratch = fw_arena_array(d->arena, bool, (size_t)device->nbody));
    for (int i = 0; i < device->nrevolute; i++) {
        off_its_leg off = off_which_leg(d, i, scratch);
        char turned[32], along[32];
        if (off.leg == FW_NONE) continue;
        if (n++ == 0) first = i;
        if (n > NAMED) continue;
        fw_number_text(turned, sizeof turned, fabs(off.off_rad) * FW_DEG_PER_RAD, 3);
        double in_line = remainder(d->layout->hinge[i].axis_rad + off.off_rad, 2.0 * FW_PI);
        fw_number_text(along, sizeof along, in_line * FW_DEG_PER_RAD, 6);
        fw_text_printf(&text, "%s%s%s by %s deg off %s%s (axis=\"%s deg\" lays it in line)",
                       n > 1 ? ", " : "", FW_NAMED("hinge", device->revolute[i].id), turned,
                       FW_NAMED("body", device->body[off.leg].id), along);
    }
    if (n > NAMED) fw_text_printf(&text, ", and %d more", n - NAMED);
    FW_TRY(fw_text_end(&text));
    if (n == 0) return FW_OK;
    fw_diag_warning(
        d->diags, 653, device->revolute[first].place,
        "no axis is stated, and the layout turns the %s of %s: forces along such a body "
        "bend its leaf in place of pulling it, so that the device gives far more, and what is "
        "to snap through may not; state the axis, which is the direction across the leaf, "
        "also to keep it as it is",
        n > 1 ? "leaves" : "leaf", text.data);
    return FW_OK;
}

fw_status fw_layout_hinges_plan(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    bool bad = false;
    FW_NEED(d->hinge = fw_arena_array(d->arena, fw_layout_hinge_plan, (size_t)device->nrevolute));
    for (int i = 0; i < device->nrevolute; i++) { /* all refusals in one run */
        fw_status status = plan_hinge(d, i);
        if (status == FW_GEOMETRY)
            bad = true;
        else if (status != FW_OK)
            return status;
    }
    if (bad) return FW_GEOMETRY;
    for (int i = 0; i < device->nrevolute; i++)
        for (int k = i + 1; k < device->nrevolute; k++) {
            const fw_layout_hinge_layout *p = &d->layout->hinge[i], *q = &d->layout->hinge[k];
            double apart = fw_norm(fw_sub(p->centre, q->centre)),
                   least = p->keep_out_m + q->keep_out_m;
            char a[32], b[32];
            if (apart >= least) continue;
            fw_diag_error(d->diags, 125, device->revolute[k].place,
                          "hinges %s and %s are %s um apart, but their surfaces and clearance need "
                          "%s um; move them apart, or make the flexures shorter",
                          device->revolute[i].id, device->revolute[k].id, fw_layout_um(a, apart),
                          fw_layout_um(b, least));
            fw_layout_fault fault =
                fw_layout_fault_at(fw_add(fw_add(fw_v(0, 0), 0.5, p->centre), 0.5, q->centre));
            fault.joint[0] = i, fault.joint[1] = k, fault.njoint = 2;
            FW_TRY(fw_layout_fault_keep(d, fault));
            bad = true;
        }
    if (!bad && !d->said) FW_TRY(say_off_legs(d));
    return bad ? FW_GEOMETRY : FW_OK;
}
