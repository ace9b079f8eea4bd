/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reference frames that move over their bodies: p' = p - by for every point p of a body that the
   description states in its frame. A new element with a point on a body has its line here. */
#include "device/device.h"
#include <string.h>

typedef const fw_device_frame_move *moves;

/* a point of a body; the ground's are of the world */
static void restate(moves move, int body, double *x_m, double *y_m) {
    if (body == FW_GROUND) return;
    *x_m -= move[body].by.x;
    *y_m -= move[body].by.y;
}

static fw_status restate_shapes(fw_arena *arena, fw_device_body *body, fw_geometry_vec2 by) {
    fw_device_shape *shape;
    size_t n = (size_t)body->nshape;
    FW_NEED(shape = fw_arena_grow(arena, body->shape, n, n, sizeof *shape));
    for (int i = 0; i < body->nshape; i++) {
        const fw_geometry_pose back = {-by.x, -by.y, 0};
        shape[i].pose.x_m -= by.x;
        shape[i].pose.y_m -= by.y;
        FW_TRY(fw_geometry_contour_transform(arena, &body->shape[i].contour, back, false,
                                             &shape[i].contour));
    }
    body->shape = shape;
    return FW_OK;
}

static fw_status restate_bodies(fw_arena *arena, fw_device *d, moves move) {
    for (int b = 0; b < d->nbody; b++) {
        fw_device_body *body = &d->body[b];
        if (move[b].by.x == 0 && move[b].by.y == 0) continue;
        body->x_m = move[b].to.x, body->y_m = move[b].to.y;
        restate(move, b, &body->com_x_m, &body->com_y_m);
        if (body->nshape > 0) FW_TRY(restate_shapes(arena, body, move[b].by));
    }
    return FW_OK;
}

static void restate_joints(fw_device *d, moves move) {
    for (int i = 0; i < d->nrevolute; i++) {
        fw_device_revolute *j = &d->revolute[i];
        restate(move, j->body_a, &j->ax_m, &j->ay_m);
        restate(move, j->body_b, &j->bx_m, &j->by_m);
    }
    for (int i = 0; i < d->njoint; i++) {
        fw_device_joint *j = &d->joint[i];
        restate(move, j->body_a, &j->ax_m, &j->ay_m);
        restate(move, j->body_b, &j->bx_m, &j->by_m);
    }
    for (int i = 0; i < d->nspring; i++) {
        fw_device_spring *s = &d->spring[i];
        restate(move, s->body_a, &s->ax_m, &s->ay_m);
        restate(move, s->body_b, &s->bx_m, &s->by_m);
    }
}

static void restate_probes(fw_device *d, moves move) {
    for (int i = 0; i < d->nprobe; i++) {
        fw_device_probe *p = &d->probe[i];
        restate(move, p->body, &p->x_m, &p->y_m);
        restate(move, p->body_b, &p->bx_m, &p->by_m);
    }
}

/* forces, eyelets, electrodes, contacts of points and squeezed walls are at points of bodies;
   initial velocities are of centres of mass; friction and contacts of hinges are at joints; torques,
   base motion, gravity, temperature, stress and damping have no point; of parts without a struct x
   and y are one of the body they are on */
static void restate_scene(fw_device_scene *s, moves move) {
    for (int i = 0; i < s->nforce; i++)
        restate(move, s->force[i].body, &s->force[i].x_m, &s->force[i].y_m);
    for (int i = 0; i < s->ntendon; i++)
        for (int k = 0; k < s->tendon[i].neyelet; k++) {
            fw_device_eyelet *e = &s->tendon[i].eyelet[k];
            restate(move, e->body, &e->x_m, &e->y_m);
        }
    for (int i = 0; i < s->ncomb; i++)
        restate(move, s->comb[i].body_b, &s->comb[i].bx_m, &s->comb[i].by_m);
    for (int i = 0; i < s->ncontact; i++) {
        fw_device_contact_use *c = &s->contact[i];
        if (c->joint != FW_NONE) continue;
        restate(move, c->body_a, &c->ax_m, &c->ay_m);
        restate(move, c->body_b, &c->bx_m, &c->by_m);
    }
    for (int i = 0; i < s->nair; i++) {
        fw_device_air *a = &s->air[i];
        if (a->kind == FW_AIR_SQUEEZE) restate(move, a->body, &a->x_m, &a->y_m);
    }
    for (int i = 0; i < s->npart; i++) {
        const fw_device_scene_part *p = &s->part[i];
        for (int k = 0; k < p->count && p->body != FW_GROUND; k++) {
            if (strcmp(p->name[k], "x") == 0) p->number[k] -= move[p->body].by.x;
            if (strcmp(p->name[k], "y") == 0) p->number[k] -= move[p->body].by.y;
        }
    }
}

fw_status fw_device_move_frames(fw_arena *arena, const fw_device *device,
                                const fw_device_frame_move *move, const fw_device **moved) {
    size_t b = (size_t)device->nbody, r = (size_t)device->nrevolute, j = (size_t)device->njoint,
           p = (size_t)device->nspring, s = (size_t)device->nscene, q = (size_t)device->nprobe;
    fw_device *d = fw_arena_one(arena, fw_device);
    FW_NEED(d);
    *d = *device;
    FW_NEED(d->body = fw_arena_grow(arena, d->body, b, b, sizeof *d->body));
    FW_NEED(d->revolute = fw_arena_grow(arena, d->revolute, r, r, sizeof *d->revolute));
    FW_NEED(d->joint = fw_arena_grow(arena, d->joint, j, j, sizeof *d->joint));
    FW_NEED(d->spring = fw_arena_grow(arena, d->spring, p, p, sizeof *d->spring));
    FW_NEED(d->scene = fw_arena_grow(arena, d->scene, s, s, sizeof *d->scene));
    FW_NEED(d->probe = fw_arena_grow(arena, d->probe, q, q, sizeof *d->probe));
    FW_TRY(restate_bodies(arena, d, move));
    restate_joints(d, move);
    restate_probes(d, move);
    for (int i = 0; i < d->nscene; i++) {
        FW_TRY(fw_device_own_scene(arena, &d->scene[i]));
        restate_scene(&d->scene[i], move);
    }
    *moved = d;
    return FW_OK;
}
