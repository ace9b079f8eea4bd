/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From mechanism and active effects to the scaled arrays of fw_multibody_model; what comes in is checked. */
#include "multibody/model.h"
#include "multibody/multibody_scratch.h"
#include <math.h>

/* ---- what comes in at the border of this room ---- */

static bool finite_all(const double *value, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(value[i])) return false;
    return true;
}

static bool body_ok(const fw_mechanism *m, int body) {
    return body >= FW_GROUND && body < m->nbody;
}

static fw_status check_joints(const fw_mechanism *m, fw_place place, fw_diags *diags) {
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        const double all[10] = {t->ax_m,
                                t->ay_m,
                                t->bx_m,
                                t->by_m,
                                t->axis_rad,
                                t->stiffness_N_per_m,
                                t->damping_Ns_per_m,
                                t->free_length_m,
                                t->kind == FW_JOINT_DISTANCE ? t->length_m : 1,
                                t->kind == FW_JOINT_DISTANCE ? 0 : t->angle_rad};
        if (!finite_all(all, 10) || all[5] < 0 || all[6] < 0 || all[8] <= 0 ||
            !body_ok(m, t->body_a) || !body_ok(m, t->body_b) || t->body_a == t->body_b)
            return fw_diag_error(diags, 107, place,
                                 "%s%s needs two different bodies and finite values",
                                 FW_NAMED("joint", fw_text_name(t->id)));
    }
    for (int i = 0; i < m->ndriver; i++) {
        const fw_device_driver *d = &m->driver[i];
        bool pin = d->revolute >= 0 && d->revolute < m->npin && d->joint == FW_NONE;
        bool joint = d->joint >= 0 && d->joint < m->njoint && d->revolute == FW_NONE;
        if (!pin && !(joint && m->joint[d->joint].kind != FW_JOINT_WELD))
            return fw_diag_error(diags, 107, place, "%s%s needs one joint that can move",
                                 FW_NAMED("driver", fw_text_name(d->id)));
    }
    return FW_OK;
}

static fw_status check_mechanism(const fw_mechanism *m, fw_place place, fw_diags *diags) {
    if (m->nbody <= 0) return fw_diag_error(diags, 107, place, "there is no body that could move");
    for (int b = 0; b < m->nbody; b++) {
        const fw_mechanism_mass *p = &m->body[b];
        const double all[5] = {p->mass_kg, p->inertia_kg_m2, p->x_m, p->y_m, p->phi_rad};
        if (!finite_all(all, 5) || all[0] <= 0 || all[1] <= 0)
            return fw_diag_error(diags, 107, place,
                                 "%s%s needs a finite pose, and mass and inertia above 0",
                                 FW_NAMED("body", fw_text_name(p->id)));
    }
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        const double all[7] = {p->ax_m,
                               p->ay_m,
                               p->bx_m,
                               p->by_m,
                               p->stiffness_Nm_per_rad,
                               p->damping_Nms_per_rad,
                               p->free_angle_rad};
        if (!finite_all(all, 7) || all[4] < 0 || all[5] < 0 || !body_ok(m, p->body_a) ||
            !body_ok(m, p->body_b) || p->body_a == p->body_b)
            return fw_diag_error(diags, 107, place,
                                 "%s%s needs two different bodies and finite values",
                                 FW_NAMED("joint", fw_text_name(p->id)));
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *p = &m->spring[i];
        const double all[7] = {
            p->ax_m,    p->ay_m, p->bx_m, p->by_m, p->stiffness_N_per_m, p->damping_Ns_per_m,
            p->length_m};
        if (!finite_all(all, 7) || all[4] < 0 || all[5] < 0 || !body_ok(m, p->body_a) ||
            !body_ok(m, p->body_b) || p->body_a == p->body_b)
            return fw_diag_error(diags, 107, place,
                                 "%s%s needs two different bodies and finite values",
                                 FW_NAMED("spring", fw_text_name(p->id)));
    }
    return FW_OK;
}

fw_status fw_multibody_check_motion(const fw_mechanism *m, const fw_device_scene *s,
                                    fw_diags *diags) {
    char text[32];
    if (!(s->duration_s > 0) || !isfinite(s->duration_s))
        return fw_diag_error(diags, 105, s->place, "%s%s lasts %s s; give a duration above 0",
                             FW_NAMED("scene", fw_text_name(s->name)),
                             fw_number_text(text, sizeof text, s->duration_s, 4));
    FW_TRY(check_mechanism(m, s->place, diags));
    FW_TRY(check_joints(m, s->place, diags));
    bool good = finite_all((const double[2]){s->gx_m_per_s2, s->gy_m_per_s2}, 2) || !s->gravity;
    for (int i = 0; i < s->nforce; i++) {
        const fw_device_force *f = &s->force[i];
        const double all[4] = {f->x_m, f->y_m, f->fx_N, f->fy_N};
        good = good && finite_all(all, 4) && body_ok(m, f->body);
    }
    for (int i = 0; i < s->ntorque; i++)
        good = good && isfinite(s->torque[i].value_Nm) && body_ok(m, s->torque[i].body);
    for (int i = 0; i < s->ninitial; i++) {
        const fw_device_initial *v = &s->initial[i];
        const double all[3] = {v->vx_m_per_s, v->vy_m_per_s, v->omega_rad_per_s};
        good = good && finite_all(all, 3) && body_ok(m, v->body);
    }
    if (good) return FW_OK;
    return fw_diag_error(diags, 105, s->place,
                         "loads and initial velocities of %s%s must be finite and act on bodies of "
                         "the mechanism",
                         FW_NAMED("scene", fw_text_name(s->name)));
}

/* ---- names ---- */

/* What a block of constraints is called in the description, and where it stands there. */

const char *fw_multibody_block_name(const fw_mechanism *m, const fw_multibody_block *b) {
    const char *id = b->pin != FW_NONE     ? m->pin[b->pin].id
                     : b->joint != FW_NONE ? m->joint[b->joint].id
                                           : m->driver[b->driver].id;
    return fw_text_name(id);
}

fw_place fw_multibody_block_place(const fw_mechanism *m, const fw_multibody_block *b) {
    const fw_device *d = m->device;
    if (b->driver != FW_NONE) return m->driver[b->driver].place;
    if (b->joint != FW_NONE) return m->joint[b->joint].place;
    return d && b->pin < d->nrevolute ? d->revolute[b->pin].place : (fw_place){0};
}

/* ---- sizes of the scene ---- */

static void add_arm(int body, double x, double y, double *sum, int *count) {
    if (body != FW_GROUND) *sum += x * x + y * y, ++*count;
}

/* twice the rms distance between the centres of mass and their joints; a mechanism without such
   arms takes its radius of gyration */
static double scene_length(const fw_mechanism *m) {
    double sum = 0, inertia = 0, mass = 0;
    int count = 0;
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        add_arm(p->body_a, p->ax_m, p->ay_m, &sum, &count);
        add_arm(p->body_b, p->bx_m, p->by_m, &sum, &count);
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        add_arm(t->body_a, t->ax_m, t->ay_m, &sum, &count);
        add_arm(t->body_b, t->bx_m, t->by_m, &sum, &count);
    }
    for (int b = 0; b < m->nbody; b++)
        inertia += m->body[b].inertia_kg_m2, mass += m->body[b].mass_kg;
    double arms = count ? 2 * sqrt(sum / count) : 0, gyration = sqrt(inertia / mass);
    return fmax(arms, gyration);
}

/* 1/T^2 = (sum k + sum k_s L^2 + L sum |F| + sum |torque|) / sum (J + m L^2) + (v/L)^2 + omega^2.
   Elements add the stiffness and the force that they state. */
static double scene_time(const fw_mechanism *m, const fw_effects_loads *loads, double length,
                         double duration) {
    if (!loads) return 1;
    double inertia = 0, torque = 0, speed = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *f = loads->constant + 3 * b, *v = loads->velocity + 3 * b;
        inertia += m->body[b].inertia_kg_m2 + m->body[b].mass_kg * length * length;
        torque += length * hypot(f[0], f[1]) + fabs(f[2]);
        speed = fmax(speed, fmax(hypot(v[0], v[1]) / length, fabs(v[2])));
    }
    for (int i = 0; i < loads->ntorsion; i++)
        torque += loads->torsion[i].stiffness_Nm_per_rad;
    for (int i = 0; i < loads->nspring; i++)
        torque += loads->spring[i].stiffness_N_per_m * length * length;
    for (int i = 0; i < loads->nslide; i++)
        torque += loads->slide[i].stiffness_N_per_m * length * length;
    for (int i = 0; i < loads->nload; i++)
        torque += length * hypot(loads->load[i].fx_N, loads->load[i].fy_N);
    for (int i = 0; i < loads->ntimed; i++) {
        const fw_effects_timed_load *l = &loads->timed[i];
        torque += length * hypot(l->fx_N, l->fy_N) + fabs(l->torque_Nm);
    }
    for (int i = 0; i < loads->nelement; i++) {
        const fw_effects_force_element *e = &loads->element[i];
        torque += length * (e->size_N_per_m * length + e->force_N);
    }
    double square = torque / inertia + speed * speed;
    return square > 0 && isfinite(square) ? 1 / sqrt(square) : duration;
}

static void scale_of(const fw_mechanism *mechanism, const fw_effects_loads *loads,
                     double duration_s, fw_multibody_scale *scale) {
    double mass = 0;
    for (int b = 0; b < mechanism->nbody; b++)
        mass += mechanism->body[b].mass_kg;
    scale->mass_kg = mass / mechanism->nbody;
    scale->length_m = scene_length(mechanism);
    scale->time_s = scene_time(mechanism, loads, scale->length_m, duration_s);
}

/* ---- bodies ---- */

typedef struct builder {
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_effects_loads *loads; /* NULL: no forces */
    fw_multibody_model *m;
    fw_geometry_vec2 centre; /* m: origin of the scaled coordinates */
} builder;

static int index_of(const fw_multibody_model *m, int body) {
    return body == FW_GROUND ? m->nbody : body;
}

/* local point in scaled units; those of the ground are seen from the centre */
static void set_local(const builder *b, int body, double x, double y, double *to) {
    bool ground = body == b->m->nbody;
    to[0] = (x - (ground ? b->centre.x : 0)) / b->m->scale.length_m;
    to[1] = (y - (ground ? b->centre.y : 0)) / b->m->scale.length_m;
}

/* positions are taken from the middle of the mechanism, so that far-away coordinates cost no
   digits */
static fw_geometry_vec2 middle(const fw_mechanism *m, const double *q) {
    fw_geometry_vec2 sum = {0, 0};
    for (int b = 0; b < m->nbody; b++)
        sum.x += q[3 * b], sum.y += q[3 * b + 1];
    return (fw_geometry_vec2){sum.x / m->nbody, sum.y / m->nbody};
}

static void set_bodies(const builder *b, const double *q) {
    fw_multibody_model *m = b->m;
    const fw_multibody_scale s = m->scale;
    for (int i = 0; i < m->nbody; i++) {
        const fw_mechanism_mass *from = &b->mechanism->body[i];
        m->mass[i] = from->mass_kg / s.mass_kg;
        m->inertia[i] = from->inertia_kg_m2 / (s.mass_kg * s.length_m * s.length_m);
        m->minv[i] = 1 / m->mass[i];
        m->jinv[i] = 1 / m->inertia[i];
        m->origin[3 * i] = (q[3 * i] - b->centre.x) / s.length_m;
        m->origin[3 * i + 1] = (q[3 * i + 1] - b->centre.y) / s.length_m;
        m->origin[3 * i + 2] = q[3 * i + 2];
    }
}

/* ---- constraints ---- */

static double origin_turn(const fw_multibody_model *m, int a, int b) {
    return m->origin[3 * b + 2] - m->origin[3 * a + 2];
}

static bool released(const builder *b, int pin) {
    return b->loads && b->loads->released && b->loads->released[pin];
}

static void pin_blocks(const builder *b, fw_multibody_block *block, int *count) {
    for (int i = 0; i < b->mechanism->npin; i++) {
        const fw_mechanism_pin *p = &b->mechanism->pin[i];
        b->m->pin_element[i] = FW_NONE;
        if (released(b, i)) { /* an element stands for it */
            b->m->pin_block[i] = FW_NONE;
            b->m->nreleased++;
            continue;
        }
        block[(*count)++] = (fw_multibody_block){.rows = FW_ROWS_PIN,
                                                 .a = index_of(b->m, p->body_a),
                                                 .b = index_of(b->m, p->body_b),
                                                 .pin = i,
                                                 .joint = FW_NONE,
                                                 .driver = FW_NONE};
    }
}

/* of (njoint): 1 + index of the driver of each joint, the first where there are more; 0: none */
static fw_status drivers_of_joints(const builder *b, int **of) {
    const fw_mechanism *m = b->mechanism;
    FW_NEED(*of = fw_arena_array(b->arena, int, (size_t)m->njoint));
    for (int i = m->ndriver - 1; i >= 0; i--) {
        int joint = m->driver[i].joint;
        if (joint >= 0 && joint < m->njoint) (*of)[joint] = i + 1;
    }
    return FW_OK;
}

/* a rod with a driver is one row whose length follows the law; a weld is a pin and a turn */
static fw_status joint_blocks(const builder *b, fw_multibody_block *block, int *count) {
    const fw_multibody_model *m = b->m;
    int *driver_of;
    FW_TRY(drivers_of_joints(b, &driver_of));
    for (int i = 0; i < b->mechanism->njoint; i++) {
        const fw_device_joint *t = &b->mechanism->joint[i];
        fw_multibody_block k = {.a = index_of(m, t->body_a),
                                .b = index_of(m, t->body_b),
                                .pin = FW_NONE,
                                .joint = i,
                                .driver = FW_NONE};
        double turn = t->angle_rad - origin_turn(m, k.a, k.b);
        if (t->kind == FW_JOINT_DISTANCE) {
            const fw_device_driver *driver =
                driver_of[i] ? &b->mechanism->driver[driver_of[i] - 1] : NULL;
            k.rows = FW_ROWS_ROD;
            k.value = driver ? 0 : t->length_m / m->scale.length_m;
            if (driver) {
                k.law = &driver->law, k.unit = m->scale.length_m;
                k.driver = driver_of[i] - 1;
            }
        } else if (t->kind == FW_JOINT_PRISMATIC) {
            k.rows = FW_ROWS_SLIDE;
            k.cos_axis = cos(t->axis_rad), k.sin_axis = sin(t->axis_rad);
            k.value = turn;
        } else {
            k.rows = FW_ROWS_PIN;
            block[(*count)++] = k;
            k.rows = FW_ROWS_TURN;
            k.value = turn;
        }
        block[(*count)++] = k;
    }
    return FW_OK;
}

/* drivers of rods are in the rods' own blocks */
static void driver_blocks(const builder *b, fw_multibody_block *block, int *count) {
    const fw_multibody_model *m = b->m;
    for (int i = 0; i < b->mechanism->ndriver; i++) {
        const fw_device_driver *d = &b->mechanism->driver[i];
        fw_multibody_block k = {.law = &d->law, .pin = FW_NONE, .joint = FW_NONE, .driver = i};
        if (d->revolute != FW_NONE) {
            const fw_mechanism_pin *p = &b->mechanism->pin[d->revolute];
            k.rows = FW_ROWS_TURN;
            k.a = index_of(m, p->body_a), k.b = index_of(m, p->body_b);
            k.value = p->free_angle_rad - origin_turn(m, k.a, k.b);
            k.unit = 1;
        } else {
            const fw_device_joint *t = &b->mechanism->joint[d->joint];
            if (t->kind == FW_JOINT_DISTANCE) continue;
            k.rows = FW_ROWS_TRAVEL;
            k.a = index_of(m, t->body_a), k.b = index_of(m, t->body_b);
            k.cos_axis = cos(t->axis_rad), k.sin_axis = sin(t->axis_rad);
            k.value = t->free_length_m / m->scale.length_m;
            k.unit = m->scale.length_m;
        }
        block[(*count)++] = k;
    }
}

static const double *local_of(const builder *b, const fw_multibody_block *k, double local[4]) {
    const fw_mechanism *from = b->mechanism;
    int joint = k->joint;
    for (int i = 0; i < 4; i++)
        local[i] = 0;
    if (k->driver != FW_NONE && joint == FW_NONE) joint = from->driver[k->driver].joint;
    if (k->pin != FW_NONE) {
        const fw_mechanism_pin *p = &from->pin[k->pin];
        set_local(b, k->a, p->ax_m, p->ay_m, local);
        set_local(b, k->b, p->bx_m, p->by_m, local + 2);
    } else if (joint != FW_NONE) {
        const fw_device_joint *t = &from->joint[joint];
        set_local(b, k->a, t->ax_m, t->ay_m, local);
        set_local(b, k->b, t->bx_m, t->by_m, local + 2);
    }
    return local;
}

/* blocks in the order of elimination, with what depends on it */
static fw_status block_arrays(fw_arena *arena, fw_multibody_model *m, int nblock) {
    size_t p = (size_t)nblock;
    m->nblock = nblock;
    FW_NEED(m->block = fw_arena_array(arena, fw_multibody_block, p));
    FW_NEED(m->body = fw_arena_array(arena, int, 2 * p));
    FW_NEED(m->local = fw_arena_array(arena, double, 4 * p));
    FW_NEED(m->offset = fw_arena_array(arena, double, 2 * p));
    return FW_OK;
}

static fw_status set_blocks(builder *b) {
    fw_multibody_model *m = b->m;
    const fw_mechanism *from = b->mechanism;
    size_t most = (size_t)from->npin + 2 * (size_t)from->njoint + (size_t)from->ndriver;
    fw_multibody_block *block;
    int *order, *body, count = 0;
    FW_NEED(block = fw_arena_array(b->arena, fw_multibody_block, most));
    FW_NEED(order = fw_arena_array(b->arena, int, most));
    FW_NEED(body = fw_arena_array(b->arena, int, 2 * most));
    pin_blocks(b, block, &count);
    FW_TRY(joint_blocks(b, block, &count));
    driver_blocks(b, block, &count);
    for (int i = 0; i < count; i++)
        body[2 * i] = block[i].a, body[2 * i + 1] = block[i].b;
    FW_TRY(fw_multibody_topology_order(b->arena, count, body, m->nbody, order));
    FW_TRY(block_arrays(b->arena, m, count));
    m->plain = count == from->npin - m->nreleased;
    for (int i = 0; i < count; i++) {
        fw_multibody_block *k = &m->block[i];
        double *local = m->local + 4 * i;
        *k = block[order[i]];
        m->body[2 * i] = k->a, m->body[2 * i + 1] = k->b;
        local_of(b, k, local);
        if (k->pin != FW_NONE) m->pin_block[k->pin] = i;
        if (k->joint != FW_NONE && k->rows != FW_ROWS_TURN) m->joint_block[k->joint] = i;
        if (k->driver != FW_NONE) m->driver_block[k->driver] = i;
        m->driven = m->driven || k->law;
        m->rows += fw_multibody_row_count(k);
        const double *xa = m->origin + 3 * k->a, *xb = m->origin + 3 * k->b;
        double *offset = m->offset + 2 * i;
        offset[0] = xa[0] - xb[0], offset[1] = xa[1] - xb[1];
        m->size = fmax(m->size, hypot(offset[0], offset[1]) + hypot(local[0], local[1]) +
                                    hypot(local[2], local[3]));
    }
    return FW_OK;
}

/* ---- forces ---- */

static void set_turning(const builder *b) {
    fw_multibody_model *m = b->m;
    const fw_multibody_scale s = m->scale;
    double tt = s.time_s * s.time_s, turn = s.mass_kg * s.length_m * s.length_m;
    for (int i = 0; i < b->loads->ntorsion; i++) {
        const fw_effects_torsion *t = &b->loads->torsion[i];
        int p = index_of(m, t->body_a), q = index_of(m, t->body_b);
        m->torsion[i] = (fw_multibody_torsion){p, q, t->stiffness_Nm_per_rad * tt / turn,
                                               t->damping_Nms_per_rad * s.time_s / turn,
                                               origin_turn(m, p, q) - t->free_angle_rad};
    }
    for (int i = 0; i < b->loads->nstop; i++) {
        const fw_effects_stop *t = &b->loads->stop[i];
        int p = index_of(m, t->body_a), q = index_of(m, t->body_b);
        m->stop[i] = (fw_multibody_stop){.a = p,
                                         .b = q,
                                         .pin = t->pin,
                                         .side = t->side,
                                         .at = t->at_rad + t->free_angle_rad - origin_turn(m, p, q),
                                         .k = t->stiffness_Nm_per_rad * tt / turn,
                                         .c = t->damping_Nms_per_rad * s.time_s / turn};
    }
    m->ntorsion = b->loads->ntorsion;
    m->nstop = b->loads->nstop;
}

static void set_loads(const builder *b) {
    fw_multibody_model *m = b->m;
    const fw_multibody_scale s = m->scale;
    double force = s.time_s * s.time_s / (s.mass_kg * s.length_m); /* N to scaled */
    for (int i = 0; i < m->nbody; i++)
        for (int c = 0; c < 3; c++)
            m->constant[3 * i + c] = b->loads->constant[3 * i + c] * force *
                                     (c < 2 ? m->minv[i] : m->jinv[i] / s.length_m);
    for (int i = 0; i < b->loads->nload; i++) {
        const fw_effects_point_load *l = &b->loads->load[i];
        m->load[i] = (fw_multibody_load){l->body, l->x_m / s.length_m, l->y_m / s.length_m,
                                         l->fx_N * force, l->fy_N * force};
    }
    for (int i = 0; i < b->loads->ntimed; i++) {
        const fw_effects_timed_load *l = &b->loads->timed[i];
        m->timed[i] = (fw_multibody_timed_load){
            l->body,         l->x_m / s.length_m, l->y_m / s.length_m,
            l->fx_N * force, l->fy_N * force,     l->torque_Nm * force / s.length_m,
            l->law};
    }
    m->nload = b->loads->nload;
    m->ntimed = b->loads->ntimed;
}

static void set_springs(const builder *b) {
    fw_multibody_model *m = b->m;
    const fw_multibody_scale s = m->scale;
    double tt = s.time_s * s.time_s;
    for (int i = 0; i < b->loads->nspring; i++) {
        const fw_device_spring *p = &b->loads->spring[i];
        int at = index_of(m, p->body_a), to = index_of(m, p->body_b);
        set_local(b, at, p->ax_m, p->ay_m, m->spring_end + 4 * i);
        set_local(b, to, p->bx_m, p->by_m, m->spring_end + 4 * i + 2);
        m->spring[i] = (fw_multibody_spring){.a = at,
                                             .b = to,
                                             .k = p->stiffness_N_per_m * tt / s.mass_kg,
                                             .c = p->damping_Ns_per_m * s.time_s / s.mass_kg,
                                             .length = p->length_m / s.length_m,
                                             .cable = p->cable};
        m->ncable += p->cable;
    }
    for (int i = 0; i < b->loads->nslide; i++) {
        const fw_effects_slide *p = &b->loads->slide[i];
        const fw_device_joint *t = &b->mechanism->joint[p->joint];
        int block = m->joint_block[p->joint];
        fw_multibody_slide *to = &m->slide[i];
        *to = (fw_multibody_slide){.a = m->block[block].a,
                                   .b = m->block[block].b,
                                   .block = block,
                                   .k = p->stiffness_N_per_m * tt / s.mass_kg,
                                   .c = p->damping_Ns_per_m * s.time_s / s.mass_kg,
                                   .free = t->free_length_m / s.length_m};
    }
    m->nspring = b->loads->nspring;
    m->nslide = b->loads->nslide;
}

/* which quadratures the state carries */
static void set_energy_integrals(fw_multibody_model *m) {
    bool loses = m->nfriction > 0;
    for (int i = 0; i < m->ntorsion; i++)
        loses = loses || m->torsion[i].c > 0;
    for (int i = 0; i < m->nspring; i++)
        loses = loses || m->spring[i].c > 0;
    for (int i = 0; i < m->nslide; i++)
        loses = loses || m->slide[i].c > 0;
    for (int i = 0; i < m->nstop; i++)
        loses = loses || m->stop[i].c > 0;
    bool driven = m->driven || m->ntimed > 0;
    for (int i = 0; i < m->nelement; i++) {
        loses = loses || m->element[i].own->dissipates;
        driven = driven || m->element[i].own->works;
    }
    m->ny = 2 * m->nq;
    m->dissipated = loses ? m->ny++ : -1;
    m->worked = driven ? m->ny++ : -1;
}

static fw_status set_applied_loads(const builder *b) {
    fw_multibody_model *m = b->m;
    const fw_effects_loads *t = b->loads;
    FW_NEED(m->torsion = fw_arena_array(b->arena, fw_multibody_torsion, (size_t)t->ntorsion));
    FW_NEED(m->stop = fw_arena_array(b->arena, fw_multibody_stop, (size_t)t->nstop));
    FW_NEED(m->load = fw_arena_array(b->arena, fw_multibody_load, (size_t)t->nload));
    FW_NEED(m->timed = fw_arena_array(b->arena, fw_multibody_timed_load, (size_t)t->ntimed));
    FW_NEED(m->slide = fw_arena_array(b->arena, fw_multibody_slide, (size_t)t->nslide));
    FW_NEED(m->spring = fw_arena_array(b->arena, fw_multibody_spring, (size_t)t->nspring));
    FW_NEED(m->spring_end = fw_arena_array(b->arena, double, 4 * (size_t)t->nspring));
    set_turning(b);
    set_loads(b);
    set_springs(b);
    m->special = t->nelement > 0 || m->nreleased > 0 || t->nfriction > 0 || t->stretch.law;
    return fw_multibody_elements_new(b->arena, m, t, b->centre);
}

static fw_status body_arrays(fw_arena *arena, fw_multibody_model *m) {
    size_t n = (size_t)m->nbody;
    FW_NEED(m->origin = fw_arena_array(arena, double, 3 * (n + 1)));
    FW_NEED(m->mass = fw_arena_array(arena, double, n));
    FW_NEED(m->inertia = fw_arena_array(arena, double, n));
    FW_NEED(m->minv = fw_arena_array(arena, double, n + 1));
    FW_NEED(m->jinv = fw_arena_array(arena, double, n + 1));
    FW_NEED(m->constant = fw_arena_array(arena, double, 3 * (n + 1)));
    FW_NEED(m->pin_block = fw_arena_array(arena, int, (size_t)m->npin));
    FW_NEED(m->pin_element = fw_arena_array(arena, int, (size_t)m->npin));
    FW_NEED(m->joint_block = fw_arena_array(arena, int, (size_t)m->njoint));
    FW_NEED(m->driver_block = fw_arena_array(arena, int, (size_t)m->ndriver));
    return FW_OK;
}

/* the model in its own units: lengths of order 1 and masses of mean 1 bring the condition of the
   six-bar's equations from 1.5e14 (SI) to 2e2. Inputs SI, q (3 nbody) the pose that becomes u = 0.
   Cost O(bodies) for chains and rings. Test: test_constraints.c, test_simulate.c. */
fw_status fw_multibody_model_new(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_effects_loads *loads, const double *q, double duration_s,
                                 const fw_multibody_method *method,
                                 const fw_multibody_model **model) {
    fw_multibody_model *m = fw_arena_one(arena, fw_multibody_model);
    FW_NEED(m);
    m->nbody = mechanism->nbody;
    m->npin = mechanism->npin, m->njoint = mechanism->njoint, m->ndriver = mechanism->ndriver;
    m->nq = 3 * m->nbody;
    m->method = method ? method : fw_multibody_method_find(NULL);
    scale_of(mechanism, loads, duration_s, &m->scale);
    FW_TRY(body_arrays(arena, m));
    builder b = {arena, mechanism, loads, m, middle(mechanism, q)};
    set_bodies(&b, q);
    FW_TRY(set_blocks(&b));
    m->size = fmax(m->size, 1);
    if (loads) FW_TRY(set_applied_loads(&b));
    if (loads && loads->stretch.law)
        FW_TRY(fw_multibody_stretch_new(arena, mechanism, &loads->stretch, b.centre, m));
    if (loads) FW_TRY(fw_multibody_friction_joints(arena, mechanism, loads, m));
    set_energy_integrals(m);
    FW_TRY(fw_multibody_chain_compile(arena, m));
    *model = m;
    return FW_OK;
}
