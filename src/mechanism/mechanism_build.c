/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mechanism from a description, its layout and one variant: bodies, pins with their flexures, and what probes need. */
#include "base/constants.h"
#include "flexure/flexure.h"
#include "mechanism/mechanism.h"
#include <math.h>
#include <string.h>

/* ---- the variant ---- */

static fw_status check_variant(const fw_mechanism_builder *b) {
    const fw_mechanism_variant *v = b->variant;
    const fw_place nowhere = {b->device->file, 0, 0};
    const double scale[3] = {v->explicit_mass_scale, v->explicit_stiffness_scale,
                             v->explicit_damping_scale};
    char text[32];
    if (!(v->thickness_m > 0) || !isfinite(v->thickness_m))
        return fw_diag_error(b->diags, 80, nowhere, "layer thickness is %s m; give one above 0",
                             fw_number_text(text, sizeof text, v->thickness_m, 4));
    if (!fw_mechanism_all_finite(scale, 3) || scale[0] <= 0 || scale[1] < 0 || scale[2] < 0)
        return fw_diag_error(b->diags, 80, nowhere,
                             "scales of the explicit values must be finite and not negative");
    return fw_mechanism_tell_depths(b);
}

/* a property that is needed now; FW_INPUT when the material does not have it */
static fw_status need_property(const fw_mechanism_builder *b, const fw_quantity *q,
                               const char *what, const char *why, fw_place place) {
    if (!q->unknown && isfinite(q->value) && q->value > 0) return FW_OK;
    return fw_diag_error(b->diags, 81, place,
                         "%s of material %s is not known, and %s needs it; give it in <material>",
                         what, fw_text_name(b->variant->material.id), why);
}

/* ---- bodies ---- */

/* the description's frame of a body in the world; without a stated origin at the centroid of what is drawn */
static fw_geometry_vec2 frame_of(const fw_device_body *from, const fw_layout_body_layout *shape) {
    return (fw_geometry_vec2){isnan(from->x_m) && shape ? shape->centroid.x : from->x_m,
                              isnan(from->y_m) && shape ? shape->centroid.y : from->y_m};
}

static fw_geometry_vec2 to_local(const fw_mechanism_mass *m, fw_geometry_vec2 world) {
    if (!m) return world;
    double c = cos(m->phi_rad), s = sin(m->phi_rad);
    double dx = world.x - m->x_m, dy = world.y - m->y_m;
    return (fw_geometry_vec2){c * dx + s * dy, -s * dx + c * dy};
}

/* The centre of mass: of a stated mass where it is stated, or at the frame's origin; of what is
   drawn its centroid. */
static void place_body(const fw_device_body *from, const fw_layout_body_layout *shape,
                       fw_mechanism_mass *to, fw_mechanism_shape *drawn) {
    const fw_geometry_vec2 origin = frame_of(from, shape);
    const fw_mechanism_mass frame = {.x_m = origin.x, .y_m = origin.y, .phi_rad = from->phi_rad};
    const bool stated = !isnan(from->mass_kg);
    fw_geometry_vec2 centre = {isnan(from->com_x_m) ? 0 : from->com_x_m,
                               isnan(from->com_y_m) ? 0 : from->com_y_m};
    if (!stated) centre = to_local(&frame, shape->centroid);
    const fw_geometry_vec2 at = stated ? fw_mechanism_body_point(&frame, centre) : shape->centroid;
    to->x_m = at.x, to->y_m = at.y;
    to->frame = (fw_geometry_vec2){-centre.x, -centre.y};
    if (shape && stated) drawn->centroid = to_local(to, shape->centroid);
}

/* the file's numbers win, but what the drawing contradicts is worth a word, once */
static void compare_mass(const fw_mechanism_builder *b, const fw_device_body *from,
                         const fw_layout_body_layout *shape, const fw_mechanism_mass *to,
                         const fw_mechanism_shape *drawn) {
    const fw_quantity *density = &b->variant->material.density;
    if (isnan(from->mass_kg) || !shape || density->unknown ||
        fw_diag_said(b->diags, 256, from->place))
        return;
    double surface = density->value * b->variant->thickness_m, mass = surface * shape->area_m2;
    double away = hypot(drawn->centroid.x, drawn->centroid.y);
    double inertia = surface * shape->polar_m4 + mass * away * away;
    if (fabs(to->mass_kg - mass) <= 0.05 * mass &&
        fabs(to->inertia_kg_m2 - inertia) <= 0.1 * inertia &&
        away <= 0.02 * sqrt(shape->polar_m4 / shape->area_m2))
        return;
    char text[5][32];
    fw_diag_note(b->diags, 256, from->place,
                 "%s%s states %s kg and %s kg m2; what is drawn of it has %s kg and, about the "
                 "same centre, %s kg m2, and its centroid is %s m from there: the stated values "
                 "hold; leave mass and inertia out to take those of the drawing",
                 FW_NAMED("body", fw_text_name(from->id)),
                 fw_number_text(text[0], sizeof text[0], to->mass_kg, 4),
                 fw_number_text(text[1], sizeof text[1], to->inertia_kg_m2, 4),
                 fw_number_text(text[2], sizeof text[2], mass, 4),
                 fw_number_text(text[3], sizeof text[3], inertia, 4),
                 fw_number_text(text[4], sizeof text[4], away, 3));
}

/* explicit values scaled by the variant's scales; NaN ones from the outline: m = rho h A,
   J = rho h I_p, centre of mass = centroid */
static fw_status build_body(const fw_mechanism_builder *b, int i) {
    const fw_device_body *from = &b->device->body[i];
    const fw_layout_body_layout *shape =
        b->layout && b->layout->drawn && b->layout->body[i].area_m2 > 0 ? &b->layout->body[i]
                                                                        : NULL;
    const fw_mechanism_variant *v = b->variant;
    fw_mechanism_mass *to = &b->mechanism->body[i];
    *to = (fw_mechanism_mass){.id = from->id,
                              .mass_kg = from->mass_kg * v->explicit_mass_scale,
                              .inertia_kg_m2 = from->inertia_kg_m2 * v->explicit_mass_scale,
                              .phi_rad = from->phi_rad};
    b->mechanism->shape[i] =
        (fw_mechanism_shape){shape ? shape->area_m2 : (double)NAN,
                             shape ? shape->polar_m4 : (double)NAN,
                             shape ? shape->perimeter_m : (double)NAN,
                             {0, 0},
                             shape ? shape->spread_m4 : (fw_geometry_vec2){0, 0}};
    bool needs =
        isnan(to->mass_kg) || isnan(to->inertia_kg_m2) || isnan(from->x_m) || isnan(from->y_m);
    const bool sized = from->width_m > 0 || from->plate_width_m > 0 || from->nshape > 0;
    if (needs && !shape && sized && b->layout && !b->layout->drawn && b->layout->why_not)
        return fw_diag_error(b->diags, 82, from->place,
                             "%s%s takes its mass, inertia and position from the drawing, and "
                             "nothing is drawn: %s; mend that, or give mass, inertia, x and y",
                             FW_NAMED("body", fw_text_name(from->id)), b->layout->why_not);
    if (needs && !shape)
        return fw_diag_error(b->diags, 82, from->place,
                             "%s%s has no shape that could give its mass, inertia and position; "
                             "give mass, inertia, x and y, or a width",
                             FW_NAMED("body", fw_text_name(from->id)));
    if (isnan(to->mass_kg) || isnan(to->inertia_kg_m2)) {
        FW_TRY(
            need_property(b, &v->material.density, "density", "the mass of a body", from->place));
        double surface = v->material.density.value * v->thickness_m; /* kg/m2 */
        if (isnan(to->mass_kg)) to->mass_kg = surface * shape->area_m2;
        if (isnan(to->inertia_kg_m2)) to->inertia_kg_m2 = surface * shape->polar_m4;
    }
    place_body(from, shape, to, &b->mechanism->shape[i]);
    compare_mass(b, from, shape, to, &b->mechanism->shape[i]);
    const double pose[3] = {to->x_m, to->y_m, to->phi_rad};
    char mass[32], inertia[32];
    if (!(to->mass_kg > 0) || !(to->inertia_kg_m2 > 0) || !isfinite(to->mass_kg) ||
        !isfinite(to->inertia_kg_m2))
        return fw_diag_error(b->diags, 83, from->place,
                             "%s%s has mass %s kg and inertia %s kg m2; both must be above 0",
                             FW_NAMED("body", fw_text_name(from->id)),
                             fw_number_text(mass, sizeof mass, to->mass_kg, 4),
                             fw_number_text(inertia, sizeof inertia, to->inertia_kg_m2, 4));
    if (!fw_mechanism_all_finite(pose, 3))
        return fw_diag_error(b->diags, 83, from->place, "the pose of %s%s is not finite",
                             FW_NAMED("body", fw_text_name(from->id)));
    return FW_OK;
}

/* what is said of points of bodies is said from their centres of mass from here on */
static fw_status refer_to_centres(fw_mechanism_builder *b) {
    fw_device_frame_move *move;
    bool any = false;
    FW_NEED(move = fw_arena_array(b->arena, fw_device_frame_move, (size_t)b->mechanism->nbody));
    for (int i = 0; i < b->mechanism->nbody; i++) {
        const fw_mechanism_mass *body = &b->mechanism->body[i];
        move[i].by = (fw_geometry_vec2){-body->frame.x, -body->frame.y};
        move[i].to = (fw_geometry_vec2){body->x_m, body->y_m};
        any = any || body->frame.x != 0 || body->frame.y != 0;
    }
    if (any) FW_TRY(fw_device_move_frames(b->arena, b->device, move, &b->device));
    b->mechanism->device = b->device;
    return FW_OK;
}

/* ---- pins ---- */

static const fw_mechanism_mass *body_of(const fw_mechanism_builder *b, int index) {
    return index == FW_GROUND ? NULL : &b->mechanism->body[index];
}

static bool known(fw_geometry_vec2 p) {
    return !isnan(p.x) && !isnan(p.y);
}

static fw_status pin_points(const fw_mechanism_builder *b, const fw_device_revolute *from,
                            fw_mechanism_pin *to) {
    const fw_mechanism_mass *ma = body_of(b, to->body_a), *mb = body_of(b, to->body_b);
    fw_geometry_vec2 world = {from->x_m, from->y_m};
    fw_geometry_vec2 a = {from->ax_m, from->ay_m}, c = {from->bx_m, from->by_m};
    if (!known(world) && known(a))
        world = fw_mechanism_body_point(ma, a);
    else if (!known(world) && known(c))
        world = fw_mechanism_body_point(mb, c);
    if (!known(a)) a = to_local(ma, world);
    if (!known(c)) c = to_local(mb, world);
    to->ax_m = a.x, to->ay_m = a.y, to->bx_m = c.x, to->by_m = c.y;
    const double all[4] = {a.x, a.y, c.x, c.y};
    if (!fw_mechanism_all_finite(all, 4))
        return fw_diag_error(b->diags, 84, from->place,
                             "%s%s has no place; give x and y, or local points on its bodies",
                             FW_NAMED("joint", fw_text_name(from->id)));
    return FW_OK;
}

/* moment of inertia about a point of the body; infinite for the ground */
static double inertia_about(const fw_mechanism_mass *m, double x, double y) {
    return m ? m->inertia_kg_m2 + m->mass_kg * (x * x + y * y) : (double)INFINITY;
}

static int flexures_in_use(const fw_device *device) {
    int n = 0;
    for (int j = 0; j < device->nrevolute; j++)
        n += device->revolute[j].flexure != FW_NONE;
    return n;
}

/* what it bears; in->strength_Pa becomes the governing static limit */
static fw_status limits_of(const fw_mechanism_builder *b, fw_flexure_input *in,
                           fw_flexure_limits *limits) {
    const fw_device_material *m = &b->variant->material;
    const fw_flexure_limit_input asked = {m, in, &b->device->limits, flexures_in_use(b->device)};
    fw_flexure_limits_of(&asked, limits);
    if (limits->missing && !fw_diag_said(b->diags, 235, limits->missing_place))
        return fw_diag_error(b->diags, 235, limits->missing_place,
                             "material '%s' has no data for this: give %s on <material>, or on the "
                             "material of the flow, or remove the attribute",
                             fw_text_name(m->id), limits->missing);
    const fw_device_limits_asked *of = &b->device->limits;
    if (of->failure_probability > 0 && !limits->missing && !limits->weibull.known &&
        !m->strength_stated && !fw_diag_said(b->diags, 236, of->probability_place))
        fw_diag_warning(b->diags, 236, of->probability_place,
                        "failure-probability has no meaning for material '%s', which yields: give "
                        "weibull-strength, -modulus and -area on <material>, or remove it",
                        fw_text_name(m->id));
    const fw_flexure_limit *governing = fw_flexure_limits_governing(limits);
    if (governing) in->strength_Pa = governing->allowable_Pa;
    return limits->missing ? FW_INPUT : FW_OK;
}

/* the direction of the hinge in the crystal: of its drawn axis, or of the stated one */
static fw_flexure_crystal crystal_of(const fw_device *device, const fw_layout *layout,
                                     const fw_mechanism_variant *variant, int joint) {
    const fw_device_material *m = &variant->material;
    if (!fw_device_material_is_crystal(m)) return (fw_flexure_crystal){.known = false};
    bool drawn = layout && layout->drawn && layout->hinge[joint].drawn;
    double axis = drawn ? layout->hinge[joint].axis_rad : device->revolute[joint].axis_rad;
    return fw_flexure_crystal_cubic(m->c11.value, m->c12.value, m->c44.value,
                                    axis - variant->orientation_rad);
}

fw_flexure_input fw_mechanism_flexure(const fw_device *device, const fw_layout *layout,
                                      const fw_mechanism_variant *variant, int joint) {
    const fw_device_flexure *f = &device->flexure[device->revolute[joint].flexure];
    const fw_device_material *m = &variant->material;
    double fillet = f->fillet_m;
    if (layout && layout->drawn && layout->hinge[joint].drawn)
        fillet = layout->hinge[joint].fillet_m;
    else if (isnan(fillet))
        fillet = fw_flexure_default_fillet(f);
    fw_flexure_input in = fw_flexure_input_of(f, fillet);
    in.depth_m = variant->thickness_m;
    in.youngs_Pa = m->youngs.value;
    in.poisson = m->poisson.unknown ? 0 : m->poisson.value;
    in.strength_Pa = m->strength.value;
    in.safety_factor = device->safety_factor;
    in.crystal = crystal_of(device, layout, variant, joint);
    return in;
}

/* said once per flexure: what its law at finite rotation leaves out of a strip that is no mirror
   image of itself */
static void report_left_out(const fw_mechanism_builder *b, const fw_device_flexure *f,
                            const fw_device_revolute *joint, const fw_flexure_path_way *way,
                            fw_mechanism_hinge *hinge) {
    double drift, coupling;
    char um[32], share[32], degrees[32];
    double most = fmin(hinge->closed_form.limit_angle_rad, 1.0);
    fw_flexure_path_left_out(way, most, &drift, &coupling);
    hinge->coupling = coupling;
    if (!(drift > 1e-9 || coupling > 0.01) || fw_diag_said(b->diags, 265, f->place)) return;
    fw_diag_warning(
        b->diags, 265, f->place,
        "%s%s: its path is not its own mirror image; up to %s deg the model of compliant "
        "hinges neglects %s um of drift along its axis and a coupling of %s between the two "
        "directions of force; make the path symmetric if that matters",
        FW_NAMED("hinge", fw_text_name(joint->id)),
        fw_number_text(degrees, sizeof degrees, most * 180 / FW_PI, 3),
        fw_number_text(um, sizeof um, 1e6 * drift, 2),
        fw_number_text(share, sizeof share, coupling, 2));
}

/* flared: what a section as made adds to the strain of a moment */
static fw_status varying(const fw_mechanism_builder *b, const fw_device_flexure *f,
                         const fw_device_revolute *joint, double flared,
                         fw_mechanism_hinge *hinge) {
    const fw_flexure_path_way *way;
    FW_TRY(fw_flexure_path_law(b->arena, &hinge->input, &hinge->closed_form, &hinge->law));
    fw_flexure_path_strain_bend(&hinge->section, flared);
    FW_TRY(fw_flexure_path_way_new(b->arena, &hinge->input, &way));
    report_left_out(b, f, joint, way, hinge);
    return FW_OK;
}

static fw_status flexure_result(const fw_mechanism_builder *b, int j,
                                const fw_device_revolute *joint, fw_mechanism_hinge *hinge) {
    fw_flexure_result *result = &hinge->closed_form;
    const fw_device_flexure *f = &b->device->flexure[joint->flexure];
    const fw_device_material *m = &b->variant->material;
    FW_TRY(need_property(b, &m->youngs, "Young's modulus", "a flexure", joint->place));
    FW_TRY(need_property(b, &m->strength, "strength", "a flexure", joint->place));
    hinge->input = fw_mechanism_flexure(b->device, b->layout, b->variant, j);
    FW_TRY(limits_of(b, &hinge->input, &hinge->limits));
    fw_flexure_closed_form(&hinge->input, result);
    const double drawn = result->strain_per_rad / result->stiffness_Nm_per_rad;
    fw_flexure_flare(&hinge->input, f->flare_m, result);
    const double flared = result->strain_per_rad / result->stiffness_Nm_per_rad / drawn,
                 least = fmin(result->kx_N_per_m, result->ky_N_per_m);
    if (!isfinite(result->stiffness_Nm_per_rad) || !(fmin(result->stiffness_Nm_per_rad, least) > 0))
        return fw_diag_error(b->diags, 85, f->place,
                             "%s%s has no stiffness above 0; check its length, width and fillet",
                             FW_NAMED("flexure", fw_text_name(f->id)));
    FW_TRY(fw_flexure_path_strain_new(b->arena, &hinge->input, result, &hinge->section));
    if (fw_flexure_input_varies(&hinge->input)) return varying(b, f, joint, flared, hinge);
    fw_flexure_hinge_law_of(&hinge->input, result, &hinge->law);
    return FW_OK;
}

/* the file's number wins, but a number that its own geometry contradicts is worth a word */
static void compare_stiffness(const fw_mechanism_builder *b, const fw_device_revolute *joint,
                              double given, double own) {
    if (!(fabs(given - own) > 0.1 * own) || fw_diag_said(b->diags, 86, joint->place)) return;
    char g[32], o[32];
    fw_diag_warning(b->diags, 86, joint->place,
                    "stiffness of %s%s is given as %s N m/rad, its flexure's geometry has %s; "
                    "they differ by more than 10 %%: check which of the two is meant",
                    FW_NAMED("joint", fw_text_name(joint->id)),
                    fw_number_text(g, sizeof g, given, 4), fw_number_text(o, sizeof o, own, 4));
}

static fw_status check_pin_bodies(const fw_mechanism_builder *b, const fw_device_revolute *joint) {
    int n = b->device->nbody, x = joint->body_a, y = joint->body_b;
    if (x < FW_GROUND || y < FW_GROUND || x >= n || y >= n || x == y || joint->flexure < FW_NONE ||
        joint->flexure >= b->device->nflexure)
        return fw_diag_error(b->diags, 87, joint->place,
                             "%s%s must join two different bodies of the mechanism",
                             FW_NAMED("joint", fw_text_name(joint->id)));
    return FW_OK;
}

/* damping of a flexure from the material's loss factor eta. c = eta k / omega holds at one
   frequency only; here omega = sqrt(k/J) with the smaller inertia of the two bodies about the pin,
   hence c = eta sqrt(k J): an assumption, stated in docs/theory/dynamics.md */
static double loss_damping(const fw_mechanism_builder *b, const fw_mechanism_pin *pin) {
    const fw_quantity *loss = &b->variant->material.loss;
    if (loss->unknown || !isfinite(loss->value) || loss->value <= 0) return 0;
    double ja = inertia_about(body_of(b, pin->body_a), pin->ax_m, pin->ay_m);
    double jb = inertia_about(body_of(b, pin->body_b), pin->bx_m, pin->by_m);
    return loss->value * sqrt(pin->stiffness_Nm_per_rad * fmin(ja, jb));
}

/* stops scale like the joint's own spring and damper; without any stop angle there is none */
static void build_stops(const fw_mechanism_builder *b, const fw_device_revolute *from,
                        fw_mechanism_pin *to) {
    double k = from->stop_stiffness_Nm_per_rad, c = from->stop_damping_Nms_per_rad;
    bool any = (!isnan(from->stop_min_rad) || !isnan(from->stop_max_rad)) && !isnan(k) && k != 0;
    to->stop_min_rad = any ? from->stop_min_rad : (double)NAN;
    to->stop_max_rad = any ? from->stop_max_rad : (double)NAN;
    to->stop_stiffness_Nm_per_rad = any ? k * b->variant->explicit_stiffness_scale : 0;
    to->stop_damping_Nms_per_rad = any && !isnan(c) ? c * b->variant->explicit_damping_scale : 0;
}

static bool is_drawn(const fw_mechanism_builder *b, int j) {
    return b->layout && b->layout->drawn && b->layout->hinge[j].drawn;
}

/* what the layout drew of the flexure; without a drawing its axis and surfaces are not known */
static void set_hinge_shape(const fw_mechanism_builder *b, int j, const fw_device_revolute *from,
                            fw_mechanism_hinge *to) {
    to->stated = !isnan(from->stiffness_Nm_per_rad);
    to->damping_stated = !isnan(from->damping_Nms_per_rad);
    to->axis_rad = from->axis_rad;
    to->first_is_a = true;
    to->cover_from_rad = to->cover_to_rad = (double)NAN;
    if (!is_drawn(b, j)) return;
    const fw_layout_hinge_layout *h = &b->layout->hinge[j];
    to->axis_rad = h->axis_rad;
    to->first_is_a = h->lower == from->body_a;
    to->surface_radius_m = h->surface_radius_m;
    if (!(h->surface_radius_m > 0)) return;
    double turned = from->body_a == FW_GROUND ? 0 : b->mechanism->body[from->body_a].phi_rad;
    to->convex_is_a = h->convex == from->body_a;
    to->cover_from_rad = h->axis_rad + h->facing_from_rad - turned;
    to->cover_to_rad = to->cover_from_rad + h->facing_rad;
}

static fw_geometry_vec2 turned_back(const fw_mechanism_mass *m, fw_geometry_vec2 world) {
    if (!m) return world;
    double c = cos(m->phi_rad), s = sin(m->phi_rad);
    return (fw_geometry_vec2){c * world.x + s * world.y, -s * world.x + c * world.y};
}

/* the pin of a crystal goes from where the hinge is drawn to its own centre of compliance; what is
   drawn, the conjugate surfaces too, stays, since one drawing serves all materials */
static void move_pin(const fw_mechanism_builder *b, fw_mechanism_hinge *hinge,
                     fw_mechanism_pin *pin) {
    const double *off = hinge->closed_form.offset_m;
    double c = cos(hinge->axis_rad), s = sin(hinge->axis_rad);
    if (!isfinite(hinge->axis_rad)) return;
    const fw_geometry_vec2 world = {c * off[0] - s * off[1], s * off[0] + c * off[1]};
    hinge->off_a_m = turned_back(body_of(b, pin->body_a), world);
    hinge->off_b_m = turned_back(body_of(b, pin->body_b), world);
    pin->ax_m += hinge->off_a_m.x, pin->ay_m += hinge->off_a_m.y;
    pin->bx_m += hinge->off_b_m.x, pin->by_m += hinge->off_b_m.y;
}

/* the ends of the strip, seen from its centre of compliance */
static void find_roots(const fw_mechanism_builder *b, const fw_mechanism_hinge *hinge,
                       fw_mechanism_pin *pin) {
    const fw_flexure_path_strain *strip = &hinge->section;
    double c = cos(hinge->axis_rad), s = sin(hinge->axis_rad);
    if (!isfinite(hinge->axis_rad) || strip->n < 2) return;
    fw_geometry_vec2 root[2];
    for (int i = 0; i < 2; i++) {
        const fw_flexure_path_point *p = &strip->point[i ? strip->n - 1 : 0];
        double x = p->x_m - strip->W_m[0], y = p->y_m - strip->W_m[1];
        root[i] = (fw_geometry_vec2){c * x - s * y, s * x + c * y};
    }
    pin->root_a_m = turned_back(body_of(b, pin->body_a), root[hinge->first_is_a ? 0 : 1]);
    pin->root_b_m = turned_back(body_of(b, pin->body_b), root[hinge->first_is_a ? 1 : 0]);
}

/* A stated stiffness was measured, or computed better than here: what made it another one than the
   geometry's makes the strip's other forces others by as much. One that is less than the geometry's with
   what its ends lose may also be a formula's that leaves these out, as the printed one does: then a
   moment strains the strip less than by a softer material */
static fw_status scale_hinge(const fw_mechanism_builder *b, double by, fw_mechanism_hinge *hinge) {
    const double ends = hinge->closed_form.ends_stiffer;
    hinge->scale = by;
    if (hinge->stated) hinge->stated_less = 1 - fmin(fmax(by, 1), ends) / ends;
    fw_flexure_path_strain_scale(&hinge->section, by);
    return fw_flexure_hinge_law_scale(b->arena, &hinge->law, by);
}

static fw_status build_pin(const fw_mechanism_builder *b, int j) {
    const fw_device_revolute *from = &b->device->revolute[j];
    const fw_mechanism_variant *v = b->variant;
    fw_mechanism_pin *to = &b->mechanism->pin[j];
    FW_TRY(check_pin_bodies(b, from));
    to->id = from->id;
    to->body_a = from->body_a, to->body_b = from->body_b;
    to->free_angle_rad = isnan(from->free_angle_rad) ? 0 : from->free_angle_rad;
    to->hinge = FW_NONE;
    FW_TRY(pin_points(b, from, to));
    to->stiffness_Nm_per_rad = from->stiffness_Nm_per_rad * v->explicit_stiffness_scale;
    to->damping_Nms_per_rad = from->damping_Nms_per_rad * v->explicit_damping_scale;
    if (from->flexure != FW_NONE) {
        fw_mechanism_hinge *hinge = &b->mechanism->hinge[b->mechanism->nhinge];
        *hinge = (fw_mechanism_hinge){.pin = j, .flexure = from->flexure, .scale = 1};
        FW_TRY(flexure_result(b, j, from, hinge));
        set_hinge_shape(b, j, from, hinge);
        move_pin(b, hinge, to);
        find_roots(b, hinge, to);
        if (!is_drawn(b, j)) fw_mechanism_tell_turned(b, from, to);
        to->hinge = b->mechanism->nhinge++;
        double own = hinge->closed_form.stiffness_Nm_per_rad;
        if (to->stiffness_Nm_per_rad > 0)
            FW_TRY(scale_hinge(b, to->stiffness_Nm_per_rad / own, hinge));
        if (isnan(to->stiffness_Nm_per_rad))
            to->stiffness_Nm_per_rad = own;
        else
            compare_stiffness(b, from, to->stiffness_Nm_per_rad, own);
    }
    if (isnan(to->stiffness_Nm_per_rad)) to->stiffness_Nm_per_rad = 0;
    if (isnan(to->damping_Nms_per_rad))
        to->damping_Nms_per_rad = from->flexure == FW_NONE ? 0 : loss_damping(b, to);
    build_stops(b, from, to);
    const double all[5] = {to->stiffness_Nm_per_rad, to->damping_Nms_per_rad, to->free_angle_rad,
                           to->stop_stiffness_Nm_per_rad, to->stop_damping_Nms_per_rad};
    if (!fw_mechanism_all_finite(all, 5) || all[0] < 0 || all[1] < 0 || all[3] < 0 || all[4] < 0 ||
        isinf(to->stop_min_rad) || isinf(to->stop_max_rad))
        return fw_diag_error(b->diags, 88, from->place,
                             "stiffness and damping of %s%s must be finite and not negative",
                             FW_NAMED("joint", fw_text_name(from->id)));
    return FW_OK;
}

/* ---- probes between outlines need what is drawn of both sides ---- */

static const char *name_of(const fw_device *d, int body) {
    return body < 0 ? "ground" : d->body[body].id;
}

/* of a layout that cannot be made nothing is said here: its own errors say why */
static fw_status check_outlines(const fw_mechanism_builder *b) {
    const fw_device *d = b->device;
    const fw_layout *layout = b->layout;
    fw_status status = FW_OK;
    if (!layout || layout->nfault > 0) return FW_OK;
    for (int i = 0; i < d->nprobe; i++) {
        const fw_device_probe *p = &d->probe[i];
        if (fw_device_probe_kinds[p->row].takes != FW_PROBE_OUTLINES) continue;
        const int side[2] = {p->body, p->body_b};
        for (int k = 0; k < 2; k++) {
            if (layout->drawn && fw_layout_has_outline(layout, side[k])) continue;
            status = FW_INPUT;
            if (fw_diag_said(b->diags, 323, p->place)) break;
            fw_diag_error(
                b->diags, 323, p->place,
                "probe '%s': nothing is drawn of %s%s%s, so that it has no outline; draw it, or "
                "give points: kind=\"distance\" or \"opening\"",
                p->id ? p->id : "", fw_text_name(name_of(d, side[k])),
                !layout->drawn && layout->why_not ? ": " : "",
                !layout->drawn && layout->why_not ? layout->why_not : "");
            break;
        }
    }
    return status;
}

/* ---- all of it ---- */

/* goes on after mistakes, so that all of them are reported in one run */
static fw_status keep_going(fw_status so_far, fw_status now) {
    return so_far == FW_OK || now == FW_NOMEM ? now : so_far;
}

fw_status fw_mechanism_build(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_mechanism_variant *variant, fw_diags *diags,
                             const fw_mechanism **mechanism) {
    fw_mechanism *m = fw_arena_one(arena, fw_mechanism);
    FW_NEED(m);
    fw_mechanism_builder b = {arena, device, layout, variant, diags, m};
    *mechanism = NULL;
    FW_TRY(check_variant(&b));
    m->variant = variant;
    m->layout = layout;
    FW_NEED(m->body = fw_arena_array(arena, fw_mechanism_mass, (size_t)device->nbody));
    FW_NEED(m->shape = fw_arena_array(arena, fw_mechanism_shape, (size_t)device->nbody));
    FW_NEED(m->pin = fw_arena_array(arena, fw_mechanism_pin, (size_t)device->nrevolute));
    FW_NEED(m->spring = fw_arena_array(arena, fw_device_spring, (size_t)device->nspring));
    FW_NEED(m->hinge = fw_arena_array(arena, fw_mechanism_hinge, (size_t)device->nrevolute));
    FW_NEED(m->joint = fw_arena_array(arena, fw_device_joint, (size_t)device->njoint));
    FW_NEED(m->driver = fw_arena_array(arena, fw_device_driver, (size_t)device->ndriver));
    m->drawn = m->body;
    m->nbody = device->nbody;
    m->npin = device->nrevolute;
    m->nspring = device->nspring;
    m->njoint = device->njoint;
    m->ndriver = device->ndriver;
    fw_status status = check_outlines(&b);
    for (int i = 0; i < m->nbody; i++)
        status = keep_going(status, build_body(&b, i));
    if (status != FW_OK) return status; /* the rest would only repeat what is missing here */
    FW_TRY(refer_to_centres(&b));
    for (int j = 0; j < m->npin; j++)
        status = keep_going(status, build_pin(&b, j));
    for (int i = 0; i < m->nspring; i++)
        status = keep_going(status, fw_mechanism_build_spring(&b, i));
    for (int i = 0; i < m->njoint; i++)
        status = keep_going(status, fw_mechanism_build_joint(&b, i));
    for (int i = 0; i < m->ndriver; i++)
        status = keep_going(status, fw_mechanism_build_driver(&b, i));
    if (status == FW_OK) status = fw_mechanism_find_gives(arena, m);
    if (status == FW_OK) *mechanism = m;
    return status;
}

/* ---- hinges alone ----

   Those of a device whose layout cannot be made: their figures follow from flexures, material
   and thickness, and no mass is asked for. */

/* the middle of a body's joints that have a place; the origin where none has */
static fw_geometry_vec2 middle_of(const fw_device *device, int body) {
    fw_geometry_vec2 sum = {0, 0};
    int n = 0;
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_device_revolute *r = &device->revolute[j];
        if ((r->body_a != body && r->body_b != body) || !isfinite(r->x_m + r->y_m)) continue;
        sum.x += r->x_m, sum.y += r->y_m, n++;
    }
    return n > 0 ? (fw_geometry_vec2){sum.x / n, sum.y / n} : sum;
}

/* a mass, and a place, that nothing states and nothing of the hinge depends on */
static void stand_in(const fw_device *device, int i, fw_device_body *body) {
    const fw_geometry_vec2 at = middle_of(device, i);
    if (isnan(body->mass_kg)) body->mass_kg = 1;
    if (isnan(body->inertia_kg_m2)) body->inertia_kg_m2 = 1;
    if (isnan(body->x_m)) body->x_m = at.x;
    if (isnan(body->y_m)) body->y_m = at.y;
}

fw_status fw_mechanism_build_hinges(fw_arena *arena, const fw_device *device,
                                    const fw_layout *shown, const fw_mechanism_variant *variant,
                                    fw_diags *diags, const fw_mechanism **mechanism) {
    fw_device *with = fw_arena_one(arena, fw_device);
    fw_layout *layout = fw_arena_one(arena, fw_layout);
    fw_device_body *body = fw_arena_array(arena, fw_device_body, (size_t)device->nbody);
    FW_NEED(with && layout ? body : NULL);
    *with = *device;
    *layout = *shown;
    layout->drawn = true; /* what is not has neither an area nor a hinge */
    if (device->nbody > 0) memcpy(body, device->body, (size_t)device->nbody * sizeof *body);
    with->body = body;
    for (int i = 0; i < device->nbody; i++)
        if (!(layout->body[i].area_m2 > 0)) stand_in(device, i, &body[i]);
    return fw_mechanism_build(arena, with, layout, variant, diags, mechanism);
}
