/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the description to outlines. The construction: docs/theory/layout.md. */
#include "layout/draw.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

enum { BODIES_MOST = 2000, JOINTS_MOST = 4000 };

/* of two bodies that a hinge of the six-bar joins already */
static bool is_second(const fw_device *d, int joint) {
    const fw_device_revolute *j = &d->revolute[joint];
    for (int i = 0; d->six_bar && joint >= 6 && i < 6; i++) {
        const fw_device_revolute *h = &d->revolute[i];
        if ((h->body_a == j->body_a && h->body_b == j->body_b) ||
            (h->body_a == j->body_b && h->body_b == j->body_a))
            return true;
    }
    return false;
}

/* NULL when every body has a shape and every joint a flexure; else what is missing */
static const char *missing(fw_arena *arena, const fw_device *device, bool *failed) {
    const char *why = NULL;
    *failed = false;
    if (device->nbody == 0) return "there is no mechanism";
    if (device->nrevolute == 0) return "no hinge holds it yet";
    if (device->nbody > BODIES_MOST || device->nrevolute > JOINTS_MOST)
        return "more than 2000 bodies or 4000 hinges are computed, but not drawn";
    for (int i = 0; i < device->nbody && !why; i++) {
        const fw_device_body *b = &device->body[i];
        int n = fw_layout_body_joints(device, i, NULL, 0);
        bool plate = b->plate_width_m > 0.0 && b->plate_height_m > 0.0 &&
                     isfinite(b->plate_x_m + b->plate_y_m + b->plate_angle_rad);
        bool shapes = fw_layout_only_shapes(device, i) && isfinite(b->x_m + b->y_m + b->phi_rad);
        if (!(b->width_m > 0.0 || plate || shapes))
            why = fw_arena_printf(arena, "%s%s has neither a width, a plate nor an outline",
                                  FW_NAMED("body", b->id));
        else if (!isnan(b->plate_width_m) && !plate)
            why = fw_arena_printf(arena, "the plate of %s%s lacks its size or place",
                                  FW_NAMED("body", b->id));
        else if (!plate && !shapes && (n == 0 || (n == 1 && !isfinite(b->x_m + b->y_m))))
            why = fw_arena_printf(arena, "%s%s has a width, but no second hinge to reach",
                                  FW_NAMED("body", b->id));
        else
            continue;
        *failed = !why;
    }
    for (int i = 0; i < device->nrevolute && !why && !*failed; i++) {
        const fw_device_revolute *j = &device->revolute[i];
        if (j->flexure == FW_NONE)
            why = fw_arena_printf(arena, "%s%s has no flexure: %s", FW_NAMED("joint", j->id),
                                  is_second(device, i)
                                      ? "it is a second joint of two bodies that a hinge of "
                                        "<six-bar> joins, and those hinges take no stops: remove "
                                        "it and bound the way by a <contact> in the scenes, or "
                                        "describe the device as a <mechanism>, whose <revolute> "
                                        "have hinge, stop-min and stop-max"
                                      : "give it hinge=\"...\", the id of one");
        else if (!isfinite(j->x_m + j->y_m))
            why = fw_arena_printf(arena, "%s%s has no place in the drawing",
                                  FW_NAMED("joint", j->id));
        else
            continue;
        *failed = !why;
    }
    return why;
}

/* its piece, and its sizes for those who ask what breaks it */
static fw_status add_tether(fw_layout_drawing *d, const fw_layout_attachment *a) {
    const fw_layout_rules *rule = &fw_layout_rule;
    fw_layout *l = d->layout;
    const char *label = fw_layout_body_label(d, a->body);
    FW_NEED(label);
    FW_NEED(label = fw_arena_printf(d->arena, "tether of %s", label));
    l->tether[l->ntether++] =
        (fw_layout_tether){.body = a->body,
                           .label = label,
                           .cut = fw_layout_window_point(l, a->side, a->at_m, a->cut_m),
                           .outward = fw_layout_window_outward(a->side),
                           .length_m = a->cut_m,
                           .finger_m = rule->tether_m,
                           .neck_m = rule->tether_neck_m,
                           .neck_long_m = rule->neck_long_m,
                           .flare_m = rule->tether_m - rule->tether_neck_m,
                           .stub_m = rule->neck_straight_m};
    return fw_layout_drawing_add(d, FW_ROLE_TETHER, FW_GROUND, FW_NONE, label, &a->tether);
}

static fw_status add_bodies(fw_layout_drawing *d) {
    for (int s = 0; s < d->nslot; s++) {
        int body = s < d->device->nbody ? s : FW_GROUND;
        const fw_geometry_contour *whole = fw_layout_drawing_outline(d, s);
        if (whole->count == 0) continue;
        const char *label = fw_layout_body_label(d, body);
        FW_TRY(fw_layout_drawing_add(d, FW_ROLE_STRUCTURE, body, FW_NONE, label, whole));
        for (int i = 0; d->caps && body >= 0 && i < d->caps[body].count; i++)
            FW_TRY(fw_layout_drawing_add(d, FW_ROLE_STRUCTURE, body, FW_NONE, label,
                                         &d->caps[body].contour[i]));
    }
    FW_NEED(d->layout->tether = fw_arena_array(d->arena, fw_layout_tether, (size_t)d->nattachment));
    for (int i = 0; i < d->nattachment; i++)
        if (d->attachment[i].tether.count > 0) FW_TRY(add_tether(d, &d->attachment[i]));
    for (int j = 0; j < d->device->nrevolute; j++) {
        const char *label = fw_arena_printf(d->arena, "flexure of %s%s",
                                            FW_NAMED("hinge", d->device->revolute[j].id));
        FW_NEED(label);
        FW_TRY(fw_layout_drawing_add(d, FW_ROLE_FLEXURE, d->layout->hinge[j].lower, j, label,
                                     &d->hinge[j].flexure));
    }
    return FW_OK;
}

static void measure_free_rotation(fw_layout_drawing *d) {
    for (int j = 0; j < d->device->nrevolute; j++) {
        fw_layout_hinge_layout *h = &d->layout->hinge[j];
        const fw_geometry_contour *p =
            fw_layout_drawing_outline(d, fw_layout_drawing_slot(d, h->lower, j));
        const fw_geometry_contour *q =
            fw_layout_drawing_outline(d, fw_layout_drawing_slot(d, h->upper, j));
        h->solid[0] = *p, h->solid[1] = *q;
        h->free_rad = fw_layout_free_rotation(h->centre, p, q, 4.0 * h->keep_out_m);
    }
}

/* window and base around what is there; *why set: stators are in the way of that */
static fw_status try_ground(fw_layout_drawing *d, fw_status *base, const char **why) {
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    bool stators = fw_layout_stators_drawn(d);
    *why = NULL;
    if (stators) d->diags = &unsaid; /* it is tried again without them, and then said */
    fw_status status = fw_layout_window_choose(d);
    if (status == FW_GEOMETRY && stators) *why = "the die is too small for its stator";
    if (status == FW_OK) {
        *base = fw_layout_ground_draw(d);
        if (*base != FW_OK && *base != FW_GEOMETRY) status = *base;
        if (*base == FW_GEOMETRY && stators) *why = "its stator is in the way of the base";
    }
    for (int s = d->device->nbody; s < d->nslot && status == FW_OK && stators && !*why; s++)
        if (d->plain[s].count > 0 &&
            fw_layout_near_stator(d, &d->plain[s], fw_layout_rule.strip_clear_m))
            *why = "its stator would cross or nearly touch the base";
    d->diags = said;
    return *why ? FW_OK : status;
}

/* actuators on all bodies, then the ground; once more without drives that stand in its way */
static fw_status draw_ground(fw_layout_drawing *d, fw_status *base) {
    for (;;) {
        const char *why;
        *base = FW_OK;
        d->nattachment = 0;
        for (int s = d->device->nbody; s < d->nslot; s++)
            d->plain[s].count = d->raw[s].count = 0;
        FW_TRY(fw_layout_actuators_draw(d));
        FW_TRY(try_ground(d, base, &why));
        if (!why) return FW_OK;
        FW_TRY(fw_layout_stators_drop(d, why));
    }
}

static bool has_hub(const fw_device *device, int body) {
    return isnan(device->body[body].plate_width_m) && !fw_layout_only_shapes(device, body) &&
           fw_layout_body_joints(device, body, NULL, 0) > 2;
}

/* Bodies whose hinges stand in the way of their own spokes get the hub beside them. Tried without a
   word, and all is drawn anew. */
static fw_status choose_hubs(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    bool any = false;
    for (int b = 0; b < device->nbody; b++)
        any = any || has_hub(device, b);
    if (!any) return FW_OK;
    FW_NEED(d->beside = fw_arena_array(d->arena, bool, (size_t)device->nbody));
    d->diags = &unsaid;
    fw_status status = fw_layout_hinges_plan(d);
    for (int b = 0; status == FW_OK && b < device->nbody; b++) {
        if (!has_hub(device, b)) continue;
        fw_status drawn = fw_layout_body_draw(d, b, FW_NONE, NULL, 0);
        if (drawn != FW_OK && drawn != FW_GEOMETRY) status = drawn;
        d->beside[b] = drawn == FW_GEOMETRY;
    }
    d->diags = said;
    d->nlug = 0;
    return status == FW_GEOMETRY ? FW_OK : status; /* the hinges themselves: said later */
}

static fw_status start(fw_layout_drawing *d) {
    const fw_device *device = d->device;
    int nground = fw_layout_body_joints(device, FW_GROUND, NULL, 0);
    d->nslot = device->nbody + (nground > 0 && fw_layout_own_bases(d) ? nground : 1);
    size_t slots = (size_t)d->nslot;
    FW_NEED(d->raw = fw_arena_array(d->arena, fw_geometry_contour, slots));
    FW_NEED(d->plain = fw_arena_array(d->arena, fw_geometry_contour, slots));
    FW_NEED(d->held = fw_arena_array(d->arena, fw_geometry_contour, slots));
    FW_NEED(d->corner_m = fw_arena_array(d->arena, double, slots));
    FW_NEED(d->caps = fw_arena_array(d->arena, fw_geometry_region, (size_t)device->nbody));
    FW_NEED(d->stuck = fw_arena_array(d->arena, bool, (size_t)device->nrevolute));
    return FW_OK;
}

static fw_status draw_bodies(fw_layout_drawing *d) {
    bool bad = false;
    FW_TRY(fw_layout_actuators_plan(d));
    for (int b = 0; b < d->device->nbody; b++) { /* all refusals in one run */
        int faults = d->layout->nfault;
        fw_status status = fw_layout_body_draw(d, b, FW_NONE, NULL, 0);
        if (status == FW_GEOMETRY) {
            bad = true;
            d->plain[b].count = 0;
            FW_TRY(fw_layout_fault_rest(d, faults, b));
        } else if (status != FW_OK)
            return status;
    }
    return bad ? FW_GEOMETRY : FW_OK;
}

static fw_status draw_frame(fw_layout_drawing *d, fw_status *base) {
    FW_TRY(draw_ground(d, base));
    FW_TRY(*base == FW_OK ? fw_layout_actuators_on_base(d) : FW_OK);
    FW_TRY(*base == FW_OK ? fw_layout_tethers_draw(d) : FW_OK);
    FW_TRY(*base == FW_OK ? fw_layout_tracks_route(d) : FW_OK);
    return fw_layout_frame_draw(d);
}

/* Hinges that are too close to each other, each of them drawn: what can be shown beside them, without
   a word. */
static fw_status show_beside(fw_layout_drawing *d) {
    fw_diags *said = d->diags, unsaid = fw_diags_new(d->arena);
    fw_status base = FW_OK;
    for (int j = 0; j < d->device->nrevolute; j++)
        if (!d->layout->hinge[j].drawn) return FW_GEOMETRY;
    d->diags = &unsaid;
    fw_status status = draw_bodies(d);
    if (status == FW_OK) status = draw_frame(d, &base);
    d->diags = said;
    return status == FW_OK ? FW_GEOMETRY : status;
}

static fw_status draw(fw_layout_drawing *d) {
    fw_status base, hinges;
    FW_TRY(start(d));
    FW_TRY(fw_layout_shapes_unite(d));
    FW_TRY(choose_hubs(d));
    hinges = fw_layout_hinges_plan(d);
    if (hinges == FW_GEOMETRY) return show_beside(d);
    FW_TRY(hinges);
    FW_TRY(draw_bodies(d));
    FW_TRY(draw_frame(d, &base));
    FW_TRY(fw_layout_clearance_check(d));
    FW_TRY(base);
    measure_free_rotation(d);
    FW_TRY(fw_layout_release_holes(d));
    FW_TRY(add_bodies(d));
    FW_TRY(fw_layout_actuators_add(d));
    fw_layout *l = d->layout;
    FW_TRY(fw_layout_annotate(d->arena, d->device, l->window, l->die, d->said ? NULL : d->diags,
                              &l->piece, &l->npiece, &d->capacity));
    FW_TRY(fw_layout_actuators_letters(d));
    return fw_layout_cells_add(d->arena, d->device->cell, d->device->ncell, l, &d->capacity);
}

/* the pieces that can be shown, and at least one fault: the first error where none has a place */
static fw_status give_up(fw_layout_drawing *d) {
    fw_layout_fault whole = fw_layout_fault_at(fw_layout_nowhere);
    if (d->layout->nfault == 0) FW_TRY(fw_layout_fault_keep(d, whole));
    if (d->layout->nfault == 0) return FW_GEOMETRY;
    d->layout->why_not = "it cannot be made as it is stated";
    FW_TRY(fw_layout_show(d));
    return FW_GEOMETRY;
}

/* warnings and notes of a drawing, which are not repeated when the device is drawn again */
static bool comments_drawing(int number) {
    static const int of_drawing[] = {127, 130, 131, 138, 139, 189, 255, 258, 653};
    for (size_t i = 0; i < sizeof of_drawing / sizeof of_drawing[0]; i++)
        if (number == of_drawing[i]) return true;
    return false;
}

/* an empty one; what it says goes to `diags` */
static fw_status new_drawing(fw_arena *arena, const fw_device *device, fw_diags *diags,
                             fw_layout_drawing *d) {
    fw_layout *l;
    FW_NEED(l = fw_arena_one(arena, fw_layout));
    FW_NEED(l->hinge = fw_arena_array(arena, fw_layout_hinge_layout, (size_t)device->nrevolute));
    FW_NEED(l->body = fw_arena_array(arena, fw_layout_body_layout, (size_t)device->nbody));
    *d = (fw_layout_drawing){.arena = arena,
                             .device = device,
                             .diags = diags,
                             .own = diags,
                             .layout = l,
                             .base = FW_NONE,
                             .too_wide = FW_NONE};
    for (int j = 0; j < device->nrevolute; j++)
        d->centre = fw_add(d->centre, 1.0 / device->nrevolute, fw_layout_joint_point(device, j));
    return FW_OK;
}

/* ---- how wide a bar that was refused may be ---- */

enum { MOST_NARROWER = 12 };

/* the device with another width of a body is drawn, and what is said of it forgotten; *fits_m: the width, or
   what is given as the next one where that is refused, too */
static fw_status draw_narrower(fw_arena *arena, const fw_device *device, int body, double width_m,
                               double *fits_m) {
    const size_t n = (size_t)device->nbody;
    fw_device narrower = *device;
    fw_diags unsaid = fw_diags_new(arena);
    fw_layout_drawing d;
    FW_NEED(narrower.body = fw_arena_grow(arena, device->body, n, n, sizeof *device->body));
    narrower.body[body].width_m = width_m;
    FW_TRY(new_drawing(arena, &narrower, &unsaid, &d));
    const fw_status status = draw(&d);
    *fits_m = d.too_wide == body ? d.fits_m : width_m;
    return status == FW_NOMEM ? status : FW_OK;
}

/* By the secant of what is given over what was asked for, each to 0.1 um below; what is named was drawn
   without that refusal. */
static fw_status name_width(const fw_layout_drawing *refused) {
    const int body = refused->too_wide;
    double width = floor(1e7 * refused->fits_m) * 1e-7, next = width, before = 0, lacked = 0;
    for (int i = 0; i < MOST_NARROWER && width > 1e-6; i++) {
        fw_arena *scratch = fw_arena_part(refused->arena, 0);
        FW_NEED(scratch);
        const fw_status status = draw_narrower(scratch, refused->device, body, width, &next);
        fw_arena_free(scratch);
        FW_TRY(status);
        if (next >= width) break;
        const double lacks = width - next, slope = (lacks - lacked) / (width - before);
        double to = next;
        if (i > 0 && slope > 0) to = fmin(next, width - lacks / slope);
        before = width, lacked = lacks;
        width = floor(1e7 * fmax(to, 0.5 * width)) * 1e-7;
    }
    if (next < width) return FW_OK;
    char fits[32];
    const char *label = fw_layout_body_label((fw_layout_drawing *)refused, body);
    FW_NEED(label);
    fw_diag_warning(refused->diags, 560, refused->device->body[body].width_place,
                    "%s: a bar %s um wide fits between its hinges", label,
                    fw_layout_um(fits, width));
    return FW_OK;
}

/* ---- the sides to which bases leave, where these cannot be drawn ----
   A base of one ground hinge leaves it in line with its leaf (draw.c), else away from the mean of all hinges. In a long row
   that is along the row, through the places of its neighbours. Where a base cannot be drawn so, the device is drawn anew: all
   bases leave towards the side of the window that is nearest to their hinge, and one that cannot be drawn so either towards
   the next one. What could be drawn in the first place stays as it is. docs/theory/layout.md, section 5; decision 213; test_layout_hubs.c: rows */

enum { SIDES = 4 };

typedef struct base_plan {        /* of one device */
    fw_layout_window_side *order; /* (njoint, SIDES) sides by their distance from the hinge */
    fw_layout_window_side *side;  /* (njoint) as tried last */
    int *at;                      /* (njoint) that is the so manieth */
} base_plan;

/* The nearest side first, of equally near ones that away from the body which the hinge holds, so that the two heads of
   the hinge lie in one line. */
static void order_sides(const fw_layout_drawing *d, int joint, fw_layout_window_side order[SIDES]) {
    const fw_device_revolute *j = &d->device->revolute[joint];
    const int body = j->body_a == FW_GROUND ? j->body_b : j->body_a;
    const fw_geometry_vec2 here = fw_layout_joint_point(d->device, joint);
    const fw_geometry_vec2 held = fw_layout_side_of(d, joint, body)->direction;
    const double same_m = 1e-8; /* of places on the grid */
    fw_layout_sides_by_distance(d->layout, here, order);
    double far[SIDES];
    for (int i = 0; i < SIDES; i++)
        far[i] = fw_dot(fw_sub(fw_layout_window_point(d->layout, order[i], 0.0, 0.0), here),
                        fw_layout_window_outward(order[i]));
    for (int i = 1; i < SIDES; i++)
        for (int k = i; k > 0 && far[k] - far[k - 1] < same_m; k--) {
            const fw_layout_window_side before = order[k - 1];
            if (fw_dot(fw_layout_window_outward(order[k]), held) >=
                fw_dot(fw_layout_window_outward(before), held) - 1e-9)
                break;
            order[k - 1] = order[k], order[k] = before;
        }
}

static fw_status plan_bases(const fw_layout_drawing *d, base_plan *p) {
    const int n = d->device->nrevolute;
    FW_NEED(p->order = fw_arena_array(d->arena, fw_layout_window_side, (size_t)(n * SIDES)));
    FW_NEED(p->side = fw_arena_array(d->arena, fw_layout_window_side, (size_t)n));
    FW_NEED(p->at = fw_arena_array(d->arena, int, (size_t)n));
    for (int j = 0; j < n; j++) {
        order_sides(d, j, &p->order[j * SIDES]);
        p->side[j] = p->order[j * SIDES];
    }
    return FW_OK;
}

/* those that could not be drawn, towards the next side; false: none of them has another one */
static bool turn_bases(base_plan *p, const bool *stuck, int njoint) {
    bool any = false;
    for (int j = 0; j < njoint; j++) {
        if (!stuck[j] || p->at[j] + 1 >= SIDES) continue;
        p->side[j] = p->order[j * SIDES + ++p->at[j]];
        any = true;
    }
    return any;
}

static bool any_stuck(const fw_layout_drawing *d) {
    for (int j = 0; d->stuck && j < d->device->nrevolute; j++)
        if (d->stuck[j]) return true;
    return false;
}

/* Sides with which the device can be drawn; else with which it has fewer errors than `errors`.
   Tried without a word. */
static fw_status find_sides(const fw_layout_drawing *first, size_t errors,
                            fw_layout_window_side *best, bool *found) {
    const int n = first->device->nrevolute;
    base_plan plan = {NULL, NULL, NULL};
    FW_TRY(plan_bases(first, &plan));
    for (bool more = true; more && errors > 0;) {
        fw_arena *scratch = fw_arena_part(first->arena, 0);
        fw_layout_drawing d;
        FW_NEED(scratch);
        fw_diags unsaid = fw_diags_new(scratch);
        fw_status status = new_drawing(scratch, first->device, &unsaid, &d);
        if (status == FW_OK) {
            d.base_side = plan.side;
            d.said = true;
            status = draw(&d);
            if (unsaid.errors < errors) {
                errors = unsaid.errors;
                memcpy(best, plan.side, (size_t)n * sizeof *best);
                *found = true;
            }
            more = any_stuck(&d) && turn_bases(&plan, d.stuck, n);
        }
        fw_arena_free(scratch);
        if (status != FW_OK && status != FW_GEOMETRY) return status;
    }
    return FW_OK;
}

/* what has no drawing, and the drawing; *status is FW_OK or FW_GEOMETRY */
static fw_status draw_once(fw_layout_drawing *d, fw_status *status) {
    FW_TRY(fw_layout_joints_missing(d));
    *status = draw(d);
    return *status == FW_GEOMETRY ? FW_OK : *status;
}

/* the same device anew, and what was said of the former drawing forgotten; side NULL: each base away from the mean of all hinges */
static fw_status draw_again(fw_layout_drawing *d, fw_mark mark, const fw_layout_window_side *side,
                            fw_diags *first, fw_status *status) {
    fw_arena *arena = d->arena;
    const fw_device *device = d->device;
    const bool said = d->said;
    fw_arena_rewind(arena, mark);
    *first = fw_diags_new(arena);
    FW_TRY(new_drawing(arena, device, first, d));
    d->layout->fill = device->die.fill;
    d->base_side = side;
    d->said = said;
    return draw_once(d, status);
}

/* by a plan of the hinges as they stand without that, without a word */
static fw_status find_leaves(const fw_layout_drawing *d, fw_layout_window_side *side, bool *any) {
    if (!fw_layout_has_stated_leaf(d->device)) return FW_OK;
    fw_arena *scratch = fw_arena_part(d->arena, 0);
    fw_layout_drawing plan;
    FW_NEED(scratch);
    fw_diags unsaid = fw_diags_new(scratch);
    fw_status status = new_drawing(scratch, d->device, &unsaid, &plan);
    plan.said = true;
    if (status == FW_OK) status = start(&plan);
    if (status == FW_OK) status = fw_layout_shapes_unite(&plan);
    if (status == FW_OK) status = fw_layout_hinges_plan(&plan);
    *any = status == FW_OK && fw_layout_sides_by_leaf(&plan, side);
    fw_arena_free(scratch);
    return status == FW_GEOMETRY ? FW_OK : status;
}

/* something that stands on bases, or beside them, finds no room; what no mask draws at all (FW-D130) lacks in any drawing */
static int lacking(const fw_layout_drawing *d) {
    int n = 0;
    for (int i = 0; i < d->layout->nmissing; i++)
        n += d->layout->missing[i].number != 130;
    return n;
}

static fw_status draw_device(fw_layout_drawing *d, fw_diags *diags, fw_status *status) {
    fw_layout_window_side *side;
    bool turned = false, by_leaf = false;
    FW_NEED(side = fw_arena_array(d->arena, fw_layout_window_side, (size_t)d->device->nrevolute));
    const fw_mark mark = fw_arena_mark(d->arena);
    fw_diags first = fw_diags_new(d->arena);
    d->diags = &first;
    d->own = &first;
    FW_TRY(find_leaves(d, side, &by_leaf));
    if (by_leaf) d->base_side = side;
    FW_TRY(draw_once(d, status));
    const int lacks = by_leaf && *status == FW_OK ? lacking(d) : 0;
    if (by_leaf && (*status == FW_GEOMETRY || lacks > 0)) {
        FW_TRY(draw_again(d, mark, NULL, &first, status));
        if (lacks > 0 && (*status == FW_GEOMETRY || lacking(d) >= lacks))
            FW_TRY(draw_again(d, mark, side, &first, status));
    }
    if (*status == FW_GEOMETRY && any_stuck(d)) FW_TRY(find_sides(d, first.errors, side, &turned));
    if (turned) FW_TRY(draw_again(d, mark, side, &first, status));
    fw_diags_take(diags, &first);
    d->diags = diags;
    d->own = diags;
    return first.failed ? FW_NOMEM : FW_OK;
}

fw_status fw_layout_build(fw_arena *arena, const fw_device *device, fw_diags *diags,
                          const fw_layout **layout) {
    fw_layout_drawing d;
    bool failed;
    FW_TRY(new_drawing(arena, device, diags, &d));
    d.layout->why_not = missing(arena, device, &failed);
    if (failed) return FW_NOMEM;
    *layout = d.layout;
    if (d.layout->why_not) return FW_OK;
    fw_status status = FW_OK;
    d.layout->fill = device->die.fill;
    for (size_t i = 0; i < diags->count; i++)
        d.said = d.said || comments_drawing(diags->item[i].number);
    FW_TRY(draw_device(&d, diags, &status));
    const bool refused = status == FW_GEOMETRY && d.too_wide != FW_NONE && !d.said;
    if (refused) FW_TRY(name_width(&d));
    if (status == FW_GEOMETRY && !d.said) fw_layout_say_open_hinges(&d);
    if (status == FW_GEOMETRY) status = give_up(&d);
    d.layout->drawn = status == FW_OK;
    *layout = status == FW_OK || (status == FW_GEOMETRY && d.layout->nfault > 0) ? d.layout : NULL;
    return status;
}
