/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A layout that cannot be made is shown all the same, and so is one that lacks a part: faults with their places, and what
   finds no room. */
#include "layout/draw.h"
#include <math.h>
#include <string.h>

/* ---- faults ----
   With their places, and the pieces that have an outline. docs/theory/layout.md, section 12 */

enum { MOST_FAULTS = FW_DIAG_MOST };

const fw_geometry_vec2 fw_layout_nowhere = {(double)NAN, (double)NAN};

fw_layout_fault fw_layout_fault_at(fw_geometry_vec2 at) {
    return (fw_layout_fault){.at = at};
}

/* number 0: of any */
static const fw_diag *last_error(const fw_diags *diags, int number) {
    for (size_t i = diags->count; i-- > 0;)
        if (diags->item[i].severity == FW_ERROR && (!number || diags->item[i].number == number))
            return &diags->item[i];
    return NULL;
}

fw_status fw_layout_fault_keep(fw_layout_drawing *d, fw_layout_fault fault) {
    fw_layout *l = d->layout;
    const fw_diag *said = last_error(d->diags, fault.number);
    if (d->diags != d->own || !said || d->diags->dropped > 0 || l->nfault == MOST_FAULTS)
        return FW_OK;
    if (l->nfault == d->fault_capacity) {
        int more = d->fault_capacity ? 2 * d->fault_capacity : 8;
        fw_layout_fault *grown = fw_arena_array(d->arena, fw_layout_fault, (size_t)more);
        FW_NEED(grown);
        if (l->nfault > 0) memcpy(grown, l->fault, (size_t)l->nfault * sizeof *grown);
        l->fault = grown;
        d->fault_capacity = more;
    }
    fault.number = said->number;
    fault.message = said->message;
    l->fault[l->nfault++] = fault;
    return FW_OK;
}

fw_status fw_layout_fault_rest(fw_layout_drawing *d, int before, int body) {
    if (d->layout->nfault > before) return FW_OK;
    fw_layout_fault fault = fw_layout_fault_at(fw_layout_nowhere);
    fault.body[fault.nbody++] = body;
    return fw_layout_fault_keep(d, fault);
}

/* ---- what can be shown ---- */

static fw_status add_outline(fw_layout_drawing *d, int body, const fw_geometry_contour *contour) {
    return fw_layout_drawing_add(d, FW_ROLE_STRUCTURE, body, FW_NONE, fw_layout_body_label(d, body),
                                 contour);
}

/* what a description draws of a body: united where that was possible, else each shape by itself */
static fw_status show_shapes(fw_layout_drawing *d, int body) {
    const fw_device_body *b = &d->device->body[body];
    const fw_geometry_pose pose = {b->x_m, b->y_m, b->phi_rad};
    const fw_geometry_region *solid = d->shapes ? &d->shapes[body].solid : NULL;
    for (int i = 0; solid && i < solid->count; i++)
        FW_TRY(add_outline(d, body, &solid->contour[i]));
    if ((solid && solid->count > 0) || !isfinite(b->x_m + b->y_m + b->phi_rad)) return FW_OK;
    for (int i = 0; i < b->nshape; i++) {
        fw_geometry_contour world;
        if (b->shape[i].text || b->shape[i].hole) continue;
        FW_TRY(fw_geometry_contour_transform(d->arena, &b->shape[i].contour, pose, false, &world));
        FW_TRY(add_outline(d, body, &world));
    }
    return FW_OK;
}

static fw_status show_plate(fw_layout_drawing *d, int body) {
    fw_geometry_contour plate;
    FW_TRY(fw_layout_plate_outline(d, body, &plate));
    return add_outline(d, body, &plate);
}

/* as wide as stated, from the first hinge to every other one, or to the body's own place */
static fw_status show_bars(fw_layout_drawing *d, int body) {
    enum { MOST = 16 };
    const fw_device_body *b = &d->device->body[body];
    int joint[MOST], n = fw_layout_body_joints(d->device, body, joint, MOST);
    if (n == 0) return FW_OK;
    fw_geometry_vec2 from = fw_layout_joint_point(d->device, joint[0]);
    for (int i = 1; i < (n == 1 ? 2 : n) && i < MOST; i++) {
        fw_geometry_vec2 to =
            n == 1 ? fw_v(b->x_m, b->y_m) : fw_layout_joint_point(d->device, joint[i]);
        fw_geometry_contour bar;
        if (!(fw_norm(fw_sub(to, from)) > 0.0)) continue;
        FW_TRY(fw_geometry_contour_bar(d->arena, from, to, b->width_m, &bar));
        FW_TRY(add_outline(d, body, &bar));
    }
    return FW_OK;
}

/* a body without an outline of its own; the sketch of it is no measure */
static fw_status show_parts(fw_layout_drawing *d, int body) {
    const fw_device_body *b = &d->device->body[body];
    d->layout->body[body] = (fw_layout_body_layout){0};
    if (d->raw[body].count > 0) return add_outline(d, body, &d->raw[body]);
    FW_TRY(show_shapes(d, body));
    if (b->plate_width_m > 0.0) return show_plate(d, body);
    return b->width_m > 0.0 ? show_bars(d, body) : FW_OK;
}

/* heads of hinges whose bodies are not drawn, and all flexures */
static fw_status show_hinge(fw_layout_drawing *d, int j) {
    const fw_layout_hinge_plan *plan = &d->hinge[j];
    for (int k = 0; k < 2; k++) {
        const fw_layout_side *side = &plan->side[k];
        bool drawn = d->plain[fw_layout_drawing_slot(d, side->body, j)].count > 0;
        if (!drawn && side->head.count > 0) FW_TRY(add_outline(d, side->body, &side->head));
    }
    const char *label =
        fw_arena_printf(d->arena, "flexure of %s%s", FW_NAMED("hinge", d->device->revolute[j].id));
    return fw_layout_drawing_add(d, FW_ROLE_FLEXURE, plan->side[0].body, j, label, &plan->flexure);
}

static fw_status show_bodies(fw_layout_drawing *d) {
    for (int s = 0; s < d->nslot; s++) {
        int body = s < d->device->nbody ? s : FW_GROUND;
        const fw_geometry_contour *whole = fw_layout_drawing_outline(d, s);
        if (whole->count == 0) {
            if (body >= 0) FW_TRY(show_parts(d, body));
            continue;
        }
        FW_TRY(add_outline(d, body, whole));
        for (int i = 0; d->caps && body >= 0 && i < d->caps[body].count; i++)
            FW_TRY(add_outline(d, body, &d->caps[body].contour[i]));
    }
    return FW_OK;
}

fw_status fw_layout_show(fw_layout_drawing *d) {
    FW_TRY(show_bodies(d));
    for (int i = 0; i < d->nattachment; i++)
        if (d->attachment[i].tether.count > 0)
            FW_TRY(fw_layout_drawing_add(d, FW_ROLE_TETHER, FW_GROUND, FW_NONE, "tether",
                                         &d->attachment[i].tether));
    for (int j = 0; d->hinge && j < d->device->nrevolute; j++)
        if (d->layout->hinge[j].drawn && d->hinge[j].flexure.count > 0) FW_TRY(show_hinge(d, j));
    for (int i = 0; i < d->ncomb; i++)
        if (!d->comb[i].off && d->comb[i].stator.count > 0)
            FW_TRY(fw_layout_drawing_add(d, FW_ROLE_STRUCTURE, FW_ISLAND, FW_NONE,
                                         "stator of a comb drive", &d->comb[i].stator));
    return FW_OK;
}

/* ---- what finds no room ----
   Kept with its place, and said (FW-D131, FW-D127; FW-D130 of what is never drawn). The verdict
   rejects a device whose motion has what its masks lack. docs/theory/layout.md, section 13 */

/* of a try nothing is said, nor of a device that was drawn before */
fw_status fw_layout_missing_add(fw_layout_drawing *d, fw_layout_missing item) {
    fw_layout *l = d->layout;
    size_t n = (size_t)l->nmissing;
    char x[32], y[32];
    FW_NEED(item.name && item.why ? l : NULL);
    FW_NEED(l->missing = fw_arena_grow(d->arena, l->missing, n, n + 1, sizeof *l->missing));
    l->missing[l->nmissing++] = item;
    if (d->said) return FW_OK;
    const bool known = isfinite(item.at.x) && isfinite(item.at.y);
    const char *at = known ? fw_arena_printf(d->arena, " at (%s, %s) um",
                                             fw_layout_um(x, item.at.x), fw_layout_um(y, item.at.y))
                           : "";
    FW_NEED(at);
    fw_diag_warning(d->diags, item.number, item.place,
                    "%s%s %s not drawn: %s; a device that lacks what it moves with or is "
                    "held by is rejected",
                    item.name, at, item.number == 127 ? "are" : "is", item.why);
    return FW_OK;
}

const char *fw_layout_missing_way(const fw_layout_missing *missing) {
    return missing->number == 130 || missing->narrow ? "; instead: " : "; nearest room: ";
}

bool fw_layout_same_eyelet(const fw_device_eyelet *p, const fw_device_eyelet *q) {
    return p->body == q->body && p->x_m == q->x_m && p->y_m == q->y_m;
}

static bool moves_scene(const fw_device_scene *s, const fw_layout_missing *m) {
    for (int i = 0; m->comb && i < s->ncomb; i++)
        if (fw_device_same_comb(&s->comb[i], m->comb)) return true;
    for (int t = 0; m->eyelet && t < s->ntendon; t++)
        for (int k = 0; k < s->tendon[t].neyelet; k++)
            if (fw_layout_same_eyelet(&s->tendon[t].eyelet[k], m->eyelet)) return true;
    return false;
}

bool fw_layout_missing_in_flow(const fw_device *device, const fw_layout_missing *m,
                               const char *flow) {
    if (!m->comb && !m->eyelet) return true;
    for (int i = 0; i < device->nscene; i++)
        if (fw_device_in_flow(device->scene[i].flow, flow) && moves_scene(&device->scene[i], m))
            return true;
    return false;
}

/* where a body puts a point of its own; false: where it stands is not stated */
static bool puts_at(const fw_device *device, int body, double x_m, double y_m,
                    fw_geometry_vec2 *at) {
    if (body >= 0) {
        const fw_device_body *b = &device->body[body];
        const fw_layout_local l = {fw_v(b->x_m, b->y_m), cos(b->phi_rad), sin(b->phi_rad), false};
        *at = fw_layout_local_point(&l, fw_v(x_m, y_m));
    } else {
        *at = fw_v(x_m, y_m);
    }
    return isfinite(at->x) && isfinite(at->y);
}

/* Of a drawing that failed: a hinge that hangs in the air may be one whose two bodies put it at two places. The
   verdict says it of drawings that succeed. */
void fw_layout_say_open_hinges(const fw_layout_drawing *d) {
    const double grid_m = 10e-9;
    for (int j = 0; j < d->device->nrevolute; j++) {
        const fw_device_revolute *r = &d->device->revolute[j];
        fw_geometry_vec2 a, b;
        char gap[32];
        if (!puts_at(d->device, r->body_a, r->ax_m, r->ay_m, &a) ||
            !puts_at(d->device, r->body_b, r->bx_m, r->by_m, &b))
            continue;
        double apart_m = fw_norm(fw_sub(a, b));
        if (apart_m > grid_m)
            fw_diag_error(
                d->diags, 206, r->place,
                "%s%s does not close in the drawn position: its two bodies put it %s um "
                "apart (10 nm is allowed), which may be all that is wrong with the drawing; "
                "correct the body positions or its coordinates; `flexwright assemble` prints "
                "poses that close",
                FW_NAMED("joint", r->id), fw_number_text(gap, sizeof gap, apart_m * 1e6, 4));
    }
}

/* ---- where a body is too narrow ---- */

/* the hinge of the body whose head, which the layout draws, lies at that place; FW_NONE: what the file draws does */
static int head_at(const fw_device *device, const fw_layout *layout, int body,
                   fw_geometry_vec2 at) {
    const fw_device_body *b = &device->body[body];
    const double c = cos(b->plate_angle_rad), s = sin(b->plate_angle_rad);
    const fw_geometry_vec2 to = fw_sub(at, fw_v(b->plate_x_m, b->plate_y_m));
    const bool beside_plate = fabs(c * to.x + s * to.y) > 0.5 * b->plate_width_m ||
                              fabs(c * to.y - s * to.x) > 0.5 * b->plate_height_m;
    const bool by_heads = beside_plate && b->nshape == 0; /* all that is not its plate */
    double least = HUGE_VAL;
    int best = FW_NONE;
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &layout->hinge[j];
        const double far = fw_norm(fw_sub(at, h->centre));
        if (!h->drawn || (h->lower != body && h->upper != body) || far >= least) continue;
        if (!by_heads && far > h->keep_out_m + fw_layout_rule.neck_into_plate_m) continue;
        least = far, best = j;
    }
    return best;
}

const char *fw_layout_wider_there(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  int body, fw_geometry_vec2 at) {
    const fw_layout_rules *rule = &fw_layout_rule;
    const fw_device_body *b = &device->body[body];
    const int joint = layout && layout->drawn ? head_at(device, layout, body, at) : FW_NONE;
    if (joint == FW_NONE) return "make it wider there";
    const double wide = isnan(b->width_m) ? rule->neck_width_m : b->width_m,
                 plate = 2.0 * rule->neck_plate_share * fmin(b->plate_width_m, b->plate_height_m),
                 most = 2.0 * (rule->neck_rings *
                                   (layout->hinge[joint].keep_out_m - rule->beside_ring_m) +
                               rule->neck_inset_m);
    char now[32], up[32], share[32];
    const char *how = NULL;
    fw_layout_um(now, fmin(wide, plate)), fw_layout_um(up, most);
    if (fmin(wide, plate) >= most)
        how = "its neck is as wide as so short a flexure lets it be: make the flexure longer, or "
              "draw "
              "the body nearer to it";
    else if (plate < wide)
        how = fw_arena_printf(
            arena,
            "its neck is %s of the lesser side of the plate: make plate-width and "
            "plate-height larger, up to %s um of neck",
            fw_number_text(share, sizeof share, 2.0 * rule->neck_plate_share, 2), up);
    else
        how = fw_arena_printf(arena,
                              "its neck is as wide as the body's width%s, %s um, says: write "
                              "a larger width, up to %s um",
                              isnan(b->width_m) ? " where none is stated" : "", now, up);
    if (!how) return NULL;
    return fw_arena_printf(
        arena, "that is the head of %s%s, which the layout draws, and %s%s",
        FW_NAMED("hinge", device->revolute[joint].id), how,
        device->flexure[device->revolute[joint].flexure].gap_m > 0.0
            ? "; where nothing asks for conjugate surfaces leave out the gap, and with it the rings"
            : "");
}

/* ---- what the motion has and no drawing ----
   A guide that slides, a rod and a weld hold bodies together in the motion, and the masks leave them apart; so
   does a spring from one body to another. The stops of a hinge are angles that no solid of the drawing
   ends a turn at. (A spring to the ground and a driver are of the world outside, as a force is.) Decision 60. */

/* where point a of a joint stands as it is stated; not a number: nobody states it */
static fw_geometry_vec2 stated_at(const fw_device *device, int body, double x_m, double y_m) {
    if (body == FW_GROUND) return fw_v(x_m, y_m);
    const fw_device_body *b = &device->body[body];
    return fw_add(fw_add(fw_v(b->x_m, b->y_m), x_m, fw_polar(b->phi_rad)), y_m,
                  fw_left(fw_polar(b->phi_rad)));
}

/* "body cart" or "the ground" */
static const char *holds_on(fw_layout_drawing *d, int body) {
    return body == FW_GROUND
               ? "the ground"
               : fw_arena_printf(d->arena, "%s%s", FW_NAMED("body", d->device->body[body].id));
}

static const char *instead_of(fw_device_joint_kind kind) {
    switch (kind) {
    case FW_JOINT_PRISMATIC:
        return "two pairs of leaves guide a stage as straight, as in docs/gallery/straight-stage";
    case FW_JOINT_DISTANCE:
        return "a body with a width between two hinges is a rod that is drawn, with its mass";
    case FW_JOINT_WELD:
        return "draw both as one body: a body may have several <outline> and <plate> elements";
    }
    return "";
}

/* ends a sentence about two things that move against each other */
typedef enum undrawn { LEFT_APART, NOT_STOPPED } undrawn;

static fw_status add_undrawn(fw_layout_drawing *d, const char *what, const char *id, int a, int b,
                             fw_geometry_vec2 at, fw_place place, undrawn kind,
                             const char *instead) {
    fw_layout_missing m = {
        .number = 130, .body = b >= 0 ? b : a, .at = at, .place = place, .room = instead};
    const char *from = holds_on(d, a), *to = holds_on(d, b);
    FW_NEED(from && to ? d : NULL);
    FW_NEED(m.name = fw_arena_printf(d->arena, "%s %s", what, fw_text_name(id)));
    const char *why = kind == LEFT_APART
                          ? "flexures are the only joints that are fabricated, and the masks leave"
                          : "a stop is an angle of the description, and the masks have no solid "
                            "that ends the turn between";
    FW_NEED(m.why = fw_arena_printf(d->arena, "%s %s and %s%s", why, from, to,
                                    kind == LEFT_APART ? " apart" : " there"));
    return fw_layout_missing_add(d, m);
}

/* without a stiffness it is none, and the motion has none (mechanism_build.c) */
static bool has_stop(const fw_device_revolute *j) {
    return j->stop_stiffness_Nm_per_rad > 0 && (!isnan(j->stop_min_rad) || !isnan(j->stop_max_rad));
}

static fw_status add_stops(fw_layout_drawing *d) {
    for (int i = 0; i < d->device->nrevolute; i++) {
        const fw_device_revolute *j = &d->device->revolute[i];
        if (!has_stop(j)) continue;
        FW_TRY(add_undrawn(d, "stop of hinge", j->id, j->body_a, j->body_b, fw_v(j->x_m, j->y_m),
                           j->place, NOT_STOPPED,
                           "a <contact> of the hinge's own surfaces (on=) or with a round that is "
                           "drawn is a stop; without stop-min and stop-max the hinge is judged as "
                           "it turns freely"));
    }
    return FW_OK;
}

fw_status fw_layout_joints_missing(fw_layout_drawing *d) {
    static const char *const kind[] = {[FW_JOINT_PRISMATIC] = "prismatic joint",
                                       [FW_JOINT_DISTANCE] = "distance joint",
                                       [FW_JOINT_WELD] = "weld joint"};
    const fw_device *device = d->device;
    for (int i = 0; i < device->njoint; i++) {
        const fw_device_joint *t = &device->joint[i];
        FW_TRY(add_undrawn(d, kind[t->kind], t->id, t->body_a, t->body_b,
                           stated_at(device, t->body_a, t->ax_m, t->ay_m), t->place, LEFT_APART,
                           instead_of(t->kind)));
    }
    for (int i = 0; i < device->nspring; i++) {
        const fw_device_spring *s = &device->spring[i];
        if (s->body_a == FW_GROUND || s->body_b == FW_GROUND) continue;
        FW_TRY(add_undrawn(d, s->cable ? "cable" : "spring", s->id, s->body_a, s->body_b,
                           stated_at(device, s->body_a, s->ax_m, s->ay_m), s->place, LEFT_APART,
                           "a leaf or a path between both is a spring that is drawn"));
    }
    return add_stops(d);
}
