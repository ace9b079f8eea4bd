/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where points of a mechanism are: in the drawn pose, and on bodies and ground that have become
   longer. */
#include "geometry/segment.h"
#include "mechanism/mechanism.h"
#include <math.h>

fw_geometry_vec2 fw_mechanism_body_point(const fw_mechanism_mass *body, fw_geometry_vec2 local) {
    if (!body) return local;
    double c = cos(body->phi_rad), s = sin(body->phi_rad);
    return (fw_geometry_vec2){body->x_m + c * local.x - s * local.y,
                              body->y_m + s * local.x + c * local.y};
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
