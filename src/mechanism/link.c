/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What joins bodies beside pins: point-to-point springs, joints and drivers. Values that the file
   leaves open are those of the drawn pose. Before them, where points of a mechanism are: in the drawn pose, and on bodies and
   ground that have become longer. */
#include "geometry/segment.h"
#include "mechanism/mechanism.h"
#include "quantity/law_kind.h"
#include <float.h>
#include <math.h>

/* ---- places ---- */

fw_geometry_vec2 fw_mechanism_body_point(const fw_mechanism_mass *body, fw_geometry_vec2 local) {
    if (!body) return local;
    double c = cos(body->phi_rad), s = sin(body->phi_rad);
    return (fw_geometry_vec2){body->x_m + c * local.x - s * local.y,
                              body->y_m + s * local.x + c * local.y};
}

fw_geometry_vec2 fw_mechanism_pin_opened(const fw_mechanism_pin *p, const double *q) {
    const int body[2] = {p->body_a, p->body_b};
    fw_geometry_vec2 at[2] = {{p->ax_m, p->ay_m}, {p->bx_m, p->by_m}};
    for (int i = 0; i < 2; i++) {
        if (body[i] == FW_GROUND) continue;
        const double *pose = q + 3 * body[i];
        at[i] = fw_mechanism_body_point(
            &(fw_mechanism_mass){.x_m = pose[0], .y_m = pose[1], .phi_rad = pose[2]}, at[i]);
    }
    return (fw_geometry_vec2){at[1].x - at[0].x, at[1].y - at[0].y};
}

static double turned(const fw_mechanism *m, const double *q, int body) {
    return body == FW_GROUND ? 0 : q[3 * body + 2] - m->body[body].phi_rad;
}

double fw_mechanism_pin_half_turned(const fw_mechanism *m, const fw_mechanism_pin *p,
                                    const double *q) {
    return 0.5 * (turned(m, q, p->body_a) + turned(m, q, p->body_b));
}

const fw_device_scene *fw_mechanism_scene(const fw_mechanism *m, const fw_device *device,
                                          const fw_device_scene *scene) {
    for (int i = 0; i < device->nscene; i++)
        if (&device->scene[i] == scene) return &m->device->scene[i];
    return scene;
}

/* arm from the centre of mass to the frame's origin in the world; (0, 0) without a sine where it is
   that */
static fw_geometry_vec2 arm_of(const fw_mechanism_mass *body, double phi_rad) {
    const fw_geometry_vec2 f = body->frame;
    return f.x == 0 && f.y == 0 ? f : fw_geometry_vec_rotate(f, phi_rad);
}

void fw_mechanism_frame_pose(const fw_mechanism_mass *body, const double centre[3],
                             double frame[3]) {
    const fw_geometry_vec2 r = arm_of(body, centre[2]);
    frame[0] = centre[0] + r.x;
    frame[1] = centre[1] + r.y;
    frame[2] = centre[2];
}

void fw_mechanism_frame_velocity(const fw_mechanism_mass *body, double phi_rad,
                                 const double centre[3], double frame[3]) {
    fw_mechanism_frame_acceleration(body, phi_rad, 0, centre, frame);
}

void fw_mechanism_frame_acceleration(const fw_mechanism_mass *body, double phi_rad,
                                     double omega_rad_per_s, const double centre[3],
                                     double frame[3]) {
    const fw_geometry_vec2 r = arm_of(body, phi_rad);
    double w2 = omega_rad_per_s * omega_rad_per_s;
    frame[0] = centre[0] - centre[2] * r.y - w2 * r.x;
    frame[1] = centre[1] + centre[2] * r.x - w2 * r.y;
    frame[2] = centre[2];
}

fw_geometry_vec2 fw_mechanism_local_place(const fw_mechanism *m, int body, double x_m, double y_m) {
    return fw_mechanism_body_point(body == FW_GROUND ? NULL : &m->body[body],
                                   (fw_geometry_vec2){x_m, y_m});
}

fw_geometry_vec2 fw_mechanism_pin_place(const fw_mechanism *m, const fw_mechanism_pin *pin,
                                        int side) {
    return side ? fw_mechanism_local_place(m, pin->body_b, pin->bx_m, pin->by_m)
                : fw_mechanism_local_place(m, pin->body_a, pin->ax_m, pin->ay_m);
}

bool fw_mechanism_hinge_end(const fw_mechanism *m, int body, int i, fw_geometry_vec2 *at,
                            fw_geometry_vec2 *root) {
    const int side = i % 2;
    const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
    if ((side ? pin->body_b : pin->body_a) != body) return false;
    *at = fw_mechanism_pin_place(m, pin, side);
    const fw_geometry_vec2 own = side ? pin->root_b_m : pin->root_a_m;
    *root =
        vec_add(*at, body == FW_GROUND ? own : fw_geometry_vec_rotate(own, m->drawn[body].phi_rad));
    return true;
}

/* ---- after a free strain ---- */

/* Bodies and ground that have become longer: a free strain changes where the joints sit on a body,
   and nothing else that counts. Source: similarity; docs/theory/effects/temperature.md. */

typedef struct mean {
    fw_geometry_vec2 sum;
    int count;
} mean;

static void count_in(mean *m, int body, double x_m, double y_m) {
    if (body != FW_GROUND) return;
    m->sum.x += x_m, m->sum.y += y_m;
    m->count++;
}

fw_geometry_vec2 fw_mechanism_ground_centre(const fw_mechanism *m) {
    mean all = {.count = 0};
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        count_in(&all, p->body_a, p->ax_m, p->ay_m);
        count_in(&all, p->body_b, p->bx_m, p->by_m);
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        count_in(&all, t->body_a, t->ax_m, t->ay_m);
        count_in(&all, t->body_b, t->bx_m, t->by_m);
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        count_in(&all, s->body_a, s->ax_m, s->ay_m);
        count_in(&all, s->body_b, s->bx_m, s->by_m);
    }
    if (all.count == 0) return (fw_geometry_vec2){0, 0};
    return (fw_geometry_vec2){all.sum.x / all.count, all.sum.y / all.count};
}

void fw_mechanism_strain_point(const double *strain, int nbody, fw_geometry_vec2 centre, int body,
                               double *x_m, double *y_m) {
    fw_mechanism_strain_pin(strain, nbody, centre, body, (fw_geometry_vec2){0, 0}, x_m, y_m);
}

void fw_mechanism_strain_pin(const double *strain, int nbody, fw_geometry_vec2 centre, int body,
                             fw_geometry_vec2 root, double *x_m, double *y_m) {
    bool ground = body == FW_GROUND;
    double e = strain[ground ? nbody : body];
    *x_m += e * (*x_m + root.x - (ground ? centre.x : 0));
    *y_m += e * (*y_m + root.y - (ground ? centre.y : 0));
}

/* Inputs: strain (nbody + 1), dimensionless; output: a copy that shares what does not change.
   Masses, inertias, angles, rest lengths and stiffnesses stay. Exact. Cost O(joints).
   Test: test_strained.c. */
fw_status fw_mechanism_strained(fw_arena *arena, const fw_mechanism *from, const double *strain,
                                const fw_mechanism **strained) {
    fw_mechanism *to = fw_arena_one(arena, fw_mechanism);
    fw_geometry_vec2 centre = fw_mechanism_ground_centre(from);
    FW_NEED(to);
    *to = *from;
    FW_NEED(to->pin = fw_arena_array(arena, fw_mechanism_pin, (size_t)from->npin));
    FW_NEED(to->joint = fw_arena_array(arena, fw_device_joint, (size_t)from->njoint));
    FW_NEED(to->spring = fw_arena_array(arena, fw_device_spring, (size_t)from->nspring));
    for (int i = 0; i < from->npin; i++) {
        fw_mechanism_pin *p = &to->pin[i];
        *p = from->pin[i];
        fw_mechanism_strain_pin(strain, from->nbody, centre, p->body_a, p->root_a_m, &p->ax_m,
                                &p->ay_m);
        fw_mechanism_strain_pin(strain, from->nbody, centre, p->body_b, p->root_b_m, &p->bx_m,
                                &p->by_m);
    }
    for (int i = 0; i < from->njoint; i++) {
        fw_device_joint *t = &to->joint[i];
        *t = from->joint[i];
        fw_mechanism_strain_point(strain, from->nbody, centre, t->body_a, &t->ax_m, &t->ay_m);
        fw_mechanism_strain_point(strain, from->nbody, centre, t->body_b, &t->bx_m, &t->by_m);
    }
    for (int i = 0; i < from->nspring; i++) {
        fw_device_spring *s = &to->spring[i];
        *s = from->spring[i];
        fw_mechanism_strain_point(strain, from->nbody, centre, s->body_a, &s->ax_m, &s->ay_m);
        fw_mechanism_strain_point(strain, from->nbody, centre, s->body_b, &s->bx_m, &s->by_m);
    }
    *strained = to;
    return FW_OK;
}

/* ---- springs, joints, drivers ---- */

bool fw_mechanism_all_finite(const double *value, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(value[i])) return false;
    return true;
}

/* Nothing is drawn of a hinge, and by its axis the flexure begins in each of its bodies beyond where it ends, seen from that
   body: more than its chord on the other side of the pin from the mass centre */
void fw_mechanism_tell_turned(const fw_mechanism_builder *b, const fw_device_revolute *from,
                              const fw_mechanism_pin *pin) {
    const int body[2] = {pin->body_a, pin->body_b};
    const fw_geometry_vec2 local[2] = {{pin->ax_m, pin->ay_m}, {pin->bx_m, pin->by_m}},
                           root[2] = {pin->root_a_m, pin->root_b_m};
    fw_geometry_vec2 away[2] = {{0, 0}, {0, 0}}, end[2];
    for (int i = 0; i < 2; i++) {
        const double phi = body[i] == FW_GROUND ? 0 : b->mechanism->body[body[i]].phi_rad;
        end[i] = fw_geometry_vec_rotate(root[i], phi);
        if (body[i] != FW_GROUND)
            away[i] = fw_geometry_vec_rotate((fw_geometry_vec2){-local[i].x, -local[i].y}, phi);
    }
    const fw_geometry_vec2 chord = vec_sub(end[1], end[0]);
    const double far = vec_dot(chord, chord);
    for (int i = 0; i < 2; i++)
        if (body[i] != FW_GROUND && !((i ? -1 : 1) * vec_dot(away[i], chord) > far)) return;
    if (!(far > 0) || fw_diag_said(b->diags, 651, from->place)) return;
    fw_diag_warning(b->diags, 651, from->place,
                    "%s%s: nothing is drawn, so that its axis says which end is whose, and the "
                    "flexure begins in %s on the side away from it and runs back over it; "
                    "exchange a and b, of a leaf turn the axis by 180 deg, or draw the bodies",
                    FW_NAMED("hinge", from->id),
                    fw_text_name(b->mechanism->body[body[body[1] != FW_GROUND]].id));
}

static bool two_bodies(const fw_mechanism_builder *b, int x, int y) {
    int n = b->device->nbody;
    return x >= FW_GROUND && y >= FW_GROUND && x < n && y < n && x != y;
}

/* explicit values of the file, scaled; 0 where there is none */
static double scaled(double value, double scale) {
    return isnan(value) ? 0 : value * scale;
}

/* from point a to point b in the drawn pose */
static fw_geometry_vec2 span(const fw_mechanism_builder *b, int body_a, double ax, double ay,
                             int body_b, double bx, double by) {
    fw_geometry_vec2 from = fw_mechanism_local_place(b->mechanism, body_a, ax, ay);
    fw_geometry_vec2 to = fw_mechanism_local_place(b->mechanism, body_b, bx, by);
    return (fw_geometry_vec2){to.x - from.x, to.y - from.y};
}

fw_status fw_mechanism_build_spring(const fw_mechanism_builder *b, int i) {
    const fw_device_spring *from = &b->device->spring[i];
    fw_device_spring *to = &b->mechanism->spring[i];
    *to = *from;
    to->stiffness_N_per_m = scaled(from->stiffness_N_per_m, b->variant->explicit_stiffness_scale);
    to->damping_Ns_per_m = scaled(from->damping_Ns_per_m, b->variant->explicit_damping_scale);
    const double all[7] = {
        to->ax_m,    to->ay_m, to->bx_m, to->by_m, to->stiffness_N_per_m, to->damping_Ns_per_m,
        to->length_m};
    if (!two_bodies(b, to->body_a, to->body_b) || !fw_mechanism_all_finite(all, 7) || all[4] < 0 ||
        all[5] < 0 || all[6] < 0)
        return fw_diag_error(b->diags, 89, from->place,
                             "%s%s must join two different bodies, with finite points and with "
                             "stiffness, damping and length that are not negative",
                             FW_NAMED("spring", fw_text_name(from->id)));
    fw_geometry_vec2 d = span(b, to->body_a, to->ax_m, to->ay_m, to->body_b, to->bx_m, to->by_m);
    /* a slack cable pushes in no direction, and so does a spring without a rest length */
    if (d.x == 0 && d.y == 0 && to->length_m > 0 && to->stiffness_N_per_m > 0 && !to->cable &&
        !fw_diag_said(b->diags, 91, from->place)) {
        char length[32];
        fw_diag_warning(b->diags, 91, from->place,
                        "both ends of %s%s lie on the same point as drawn, and its length at "
                        "rest is %s m: its force has no direction and is left out until they part; "
                        "move an end, or give length=\"0 um\"",
                        FW_NAMED("spring", fw_text_name(from->id)),
                        fw_number_text(length, sizeof length, to->length_m, 4));
    }
    return FW_OK;
}

/* phi_b - phi_a as drawn */
static double drawn_angle(const fw_mechanism_builder *b, int body_a, int body_b) {
    const fw_mechanism_mass *body = b->mechanism->body;
    return (body_b == FW_GROUND ? 0 : body[body_b].phi_rad) -
           (body_a == FW_GROUND ? 0 : body[body_a].phi_rad);
}

fw_status fw_mechanism_build_joint(const fw_mechanism_builder *b, int i) {
    const fw_device_joint *from = &b->device->joint[i];
    fw_device_joint *to = &b->mechanism->joint[i];
    *to = *from;
    bool distance = to->kind == FW_JOINT_DISTANCE, prismatic = to->kind == FW_JOINT_PRISMATIC;
    if (!two_bodies(b, to->body_a, to->body_b))
        return fw_diag_error(b->diags, 90, from->place,
                             "%s%s must join two different bodies of the mechanism",
                             FW_NAMED("joint", fw_text_name(from->id)));
    if (distance && isnan(to->length_m)) {
        fw_geometry_vec2 d =
            span(b, to->body_a, to->ax_m, to->ay_m, to->body_b, to->bx_m, to->by_m);
        to->length_m = hypot(d.x, d.y);
    } else if (!distance)
        to->length_m = 0;
    if (distance)
        to->angle_rad = 0;
    else if (isnan(to->angle_rad))
        to->angle_rad = drawn_angle(b, to->body_a, to->body_b);
    if (!prismatic) to->axis_rad = to->free_length_m = 0;
    to->stiffness_N_per_m =
        prismatic ? scaled(from->stiffness_N_per_m, b->variant->explicit_stiffness_scale) : 0;
    to->damping_Ns_per_m =
        prismatic ? scaled(from->damping_Ns_per_m, b->variant->explicit_damping_scale) : 0;
    const double all[] = {to->ax_m,
                          to->ay_m,
                          to->bx_m,
                          to->by_m,
                          to->axis_rad,
                          to->angle_rad,
                          to->length_m,
                          to->free_length_m,
                          to->stiffness_N_per_m,
                          to->damping_Ns_per_m};
    if (!fw_mechanism_all_finite(all, sizeof all / sizeof all[0]) || to->stiffness_N_per_m < 0 ||
        to->damping_Ns_per_m < 0)
        return fw_diag_error(b->diags, 90, from->place,
                             "points, axis, angle and lengths of %s%s must be finite, stiffness "
                             "and damping not negative",
                             FW_NAMED("joint", fw_text_name(from->id)));
    if (distance && !(to->length_m > 0))
        return fw_diag_error(b->diags, 90, from->place,
                             "the points of distance %s%s lie on the same point as drawn, and a "
                             "rod without length has no direction; give its length, or join the "
                             "bodies by a <revolute>",
                             FW_NAMED("joint", fw_text_name(from->id)));
    return FW_OK;
}

fw_status fw_mechanism_build_driver(const fw_mechanism_builder *b, int i) {
    const fw_device_driver *from = &b->device->driver[i];
    b->mechanism->driver[i] = *from;
    bool revolute = from->revolute >= 0 && from->revolute < b->device->nrevolute;
    bool joint = from->joint >= 0 && from->joint < b->device->njoint &&
                 b->device->joint[from->joint].kind != FW_JOINT_WELD;
    double value[3] = {(double)NAN, (double)NAN, (double)NAN};
    if (revolute == joint || (revolute ? from->joint : from->revolute) != FW_NONE)
        return fw_diag_error(b->diags, 92, from->place,
                             "%s%s must drive one revolute, prismatic or distance joint",
                             FW_NAMED("driver", fw_text_name(from->id)));
    if (fw_quantity_law_is_ready(&from->law))
        fw_quantity_law_value(&from->law, 0, DBL_MIN, value); /* the piece that begins at 0 */
    if (!fw_mechanism_all_finite(value, 3))
        return fw_diag_error(b->diags, 92, from->value_place,
                             "the value of %s%s, its rate or its acceleration is not finite at the "
                             "start",
                             FW_NAMED("driver", fw_text_name(from->id)));
    if (joint && b->device->joint[from->joint].kind == FW_JOINT_DISTANCE && !(value[0] > 0))
        return fw_diag_error(b->diags, 92, from->value_place,
                             "%s%s gives its rod a length that is not above 0 at the start",
                             FW_NAMED("driver", fw_text_name(from->id)));
    return FW_OK;
}

/* ---- electrodes ---- */

/* Masks draw electrodes through all of the layer, whatever depth the file states: what is drawn and made is what acts
   (fw_effects_comb_as_drawn), and a number that says otherwise is worth a word. Test: tests/cli/test_effects.py */
fw_status fw_mechanism_tell_depths(const fw_mechanism_builder *b) {
    const fw_device *d = b->device;
    const double layer = b->variant->thickness_m;
    char stated[32], made[32];
    for (int i = 0; i < d->nscene; i++)
        for (int k = 0; k < d->scene[i].ncomb; k++) {
            const fw_device_comb *c = &d->scene[i].comb[k];
            if (!(fabs(c->depth_m - layer) > 1e-3 * layer) || fw_diag_said(b->diags, 713, c->place))
                continue;
            fw_diag_warning(b->diags, 713, c->place,
                            "%s%s states a depth of %s um, and no flow makes that: masks draw its "
                            "electrodes through all "
                            "of the layer, %s um, and it is judged with these; remove depth, or "
                            "state the layer's",
                            FW_NAMED("comb drive", fw_text_name(c->id)),
                            fw_number_text(stated, sizeof stated, 1e6 * c->depth_m, 4),
                            fw_number_text(made, sizeof made, 1e6 * layer, 4));
        }
    return b->diags->failed ? FW_NOMEM : FW_OK;
}
