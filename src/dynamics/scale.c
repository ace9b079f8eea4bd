/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/model.h"
#include <math.h>

/* ---- sizes of the scene ---- */

/* twice the rms distance between the centres of mass and their pins; a mechanism without such arms
   takes its radius of gyration */
static double scene_length(const fw_mechanism *m) {
    double sum = 0, inertia = 0, mass = 0;
    int count = 0;
    for (int i = 0; i < m->npin; i++) {
        const fw_pin *p = &m->pin[i];
        if (p->body_a != FW_GROUND) sum += p->ax_m * p->ax_m + p->ay_m * p->ay_m, count++;
        if (p->body_b != FW_GROUND) sum += p->bx_m * p->bx_m + p->by_m * p->by_m, count++;
    }
    for (int b = 0; b < m->nbody; b++)
        inertia += m->body[b].inertia_kg_m2, mass += m->body[b].mass_kg;
    double arms = count ? 2 * sqrt(sum / count) : 0, gyration = sqrt(inertia / mass);
    return fmax(arms, gyration);
}

/* 1/T^2 = (sum k + sum k_s L^2 + L sum |F| + sum |torque|) / sum (J + m L^2) + (v/L)^2 + omega^2 */
static double scene_time(const fw_mechanism *m, const fw_terms *terms, double length,
                         double duration) {
    if (!terms) return 1;
    double inertia = 0, torque = 0, speed = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *f = terms->constant + 3 * b, *v = terms->velocity + 3 * b;
        inertia += m->body[b].inertia_kg_m2 + m->body[b].mass_kg * length * length;
        torque += length * hypot(f[0], f[1]) + fabs(f[2]);
        speed = fmax(speed, fmax(hypot(v[0], v[1]) / length, fabs(v[2])));
    }
    for (int i = 0; i < terms->ntorsion; i++)
        torque += terms->torsion[i].stiffness_Nm_per_rad;
    for (int i = 0; i < terms->nspring; i++)
        torque += terms->spring[i].stiffness_N_per_m * length * length;
    for (int i = 0; i < terms->nload; i++)
        torque += length * hypot(terms->load[i].fx_N, terms->load[i].fy_N);
    double square = torque / inertia + speed * speed;
    return square > 0 && isfinite(square) ? 1 / sqrt(square) : duration;
}

/* ---- arrays ---- */

static int index_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? m->nbody : body;
}

static fw_status allocate(fw_arena *arena, const fw_mechanism *mechanism, const fw_terms *terms,
                          fw_model *m) {
    size_t n = (size_t)mechanism->nbody, p = (size_t)mechanism->npin;
    FW_NEED(m->origin = fw_arena_array(arena, double, 3 * (n + 1)));
    FW_NEED(m->mass = fw_arena_array(arena, double, n));
    FW_NEED(m->inertia = fw_arena_array(arena, double, n));
    FW_NEED(m->minv = fw_arena_array(arena, double, n + 1));
    FW_NEED(m->jinv = fw_arena_array(arena, double, n + 1));
    FW_NEED(m->pin = fw_arena_array(arena, int, p));
    FW_NEED(m->body = fw_arena_array(arena, int, 2 * p));
    FW_NEED(m->local = fw_arena_array(arena, double, 4 * p));
    FW_NEED(m->offset = fw_arena_array(arena, double, 2 * p));
    FW_NEED(m->constant = fw_arena_array(arena, double, 3 * (n + 1)));
    FW_NEED(m->cosine = fw_arena_array(arena, double, n + 1));
    FW_NEED(m->sine = fw_arena_array(arena, double, n + 1));
    FW_NEED(m->arm = fw_arena_array(arena, double, 4 * p));
    FW_NEED(m->accel = fw_arena_array(arena, double, 3 * (n + 1)));
    FW_NEED(m->lambda = fw_arena_array(arena, double, 2 * p));
    FW_NEED(m->right = fw_arena_array(arena, double, 2 * p));
    FW_NEED(m->more = fw_arena_array(arena, double, 2 * p));
    if (terms) {
        FW_NEED(m->torsion = fw_arena_array(arena, fw_model_torsion, (size_t)terms->ntorsion));
        FW_NEED(m->load = fw_arena_array(arena, fw_model_load, (size_t)terms->nload));
        FW_NEED(m->spring = fw_arena_array(arena, fw_model_spring, (size_t)terms->nspring));
    }
    return FW_OK;
}

/* positions are taken from the middle of the mechanism, so that far-away coordinates cost no digits
 */
static fw_vec2 middle(const fw_mechanism *m, const double *q) {
    fw_vec2 sum = {0, 0};
    for (int b = 0; b < m->nbody; b++)
        sum.x += q[3 * b], sum.y += q[3 * b + 1];
    return (fw_vec2){sum.x / m->nbody, sum.y / m->nbody};
}

static void set_bodies(fw_model *m, const fw_mechanism *mechanism, const double *q,
                       fw_vec2 centre) {
    const fw_scale s = m->scale;
    for (int b = 0; b < m->nbody; b++) {
        m->mass[b] = mechanism->body[b].mass_kg / s.mass_kg;
        m->inertia[b] = mechanism->body[b].inertia_kg_m2 / (s.mass_kg * s.length_m * s.length_m);
        m->minv[b] = 1 / m->mass[b];
        m->jinv[b] = 1 / m->inertia[b];
        m->origin[3 * b] = (q[3 * b] - centre.x) / s.length_m;
        m->origin[3 * b + 1] = (q[3 * b + 1] - centre.y) / s.length_m;
        m->origin[3 * b + 2] = q[3 * b + 2];
    }
    m->cosine[m->nbody] = 1;
}

static void set_local(const fw_model *m, int body, double x, double y, fw_vec2 centre, double *to) {
    bool ground = body == m->nbody;
    to[0] = (x - (ground ? centre.x : 0)) / m->scale.length_m;
    to[1] = (y - (ground ? centre.y : 0)) / m->scale.length_m;
}

static void set_pins(fw_model *m, const fw_mechanism *mechanism, fw_vec2 centre) {
    for (int i = 0; i < m->npin; i++) {
        const fw_pin *p = &mechanism->pin[m->pin[i]];
        int a = index_of(mechanism, p->body_a), b = index_of(mechanism, p->body_b);
        m->body[2 * i] = a, m->body[2 * i + 1] = b;
        set_local(m, a, p->ax_m, p->ay_m, centre, m->local + 4 * i);
        set_local(m, b, p->bx_m, p->by_m, centre, m->local + 4 * i + 2);
        const double *xa = m->origin + 3 * a, *xb = m->origin + 3 * b;
        const double *l = m->local + 4 * i;
        m->offset[2 * i] = xa[0] - xb[0];
        m->offset[2 * i + 1] = xa[1] - xb[1];
        m->size = fmax(m->size, hypot(m->offset[2 * i], m->offset[2 * i + 1]) + hypot(l[0], l[1]) +
                                    hypot(l[2], l[3]));
    }
}

static void set_terms(fw_model *m, const fw_mechanism *mechanism, const fw_terms *terms,
                      fw_vec2 centre) {
    const fw_scale s = m->scale;
    double tt = s.time_s * s.time_s, turn = s.mass_kg * s.length_m * s.length_m;
    double force = tt / (s.mass_kg * s.length_m); /* N to scaled */
    for (int b = 0; b < m->nbody; b++)
        for (int c = 0; c < 3; c++)
            m->constant[3 * b + c] = c < 2 ? m->minv[b] * terms->constant[3 * b + c] * force
                                           : m->jinv[b] * terms->constant[3 * b + c] * tt / turn;
    for (int i = 0; i < terms->ntorsion; i++) {
        const fw_torsion *t = &terms->torsion[i];
        int a = index_of(mechanism, t->body_a), b = index_of(mechanism, t->body_b);
        m->torsion[i] = (fw_model_torsion){
            a, b, t->stiffness_Nm_per_rad * tt / turn, t->damping_Nms_per_rad * s.time_s / turn,
            m->origin[3 * b + 2] - m->origin[3 * a + 2] - t->free_angle_rad};
        m->dissipates = m->dissipates || t->damping_Nms_per_rad > 0;
    }
    for (int i = 0; i < terms->nload; i++) {
        const fw_point_load *l = &terms->load[i];
        m->load[i] = (fw_model_load){l->body, l->x_m / s.length_m, l->y_m / s.length_m,
                                     l->fx_N * force, l->fy_N * force};
    }
    for (int i = 0; i < terms->nspring; i++) {
        const fw_spring *p = &terms->spring[i];
        fw_model_spring *to = &m->spring[i];
        double local[4];
        to->a = index_of(mechanism, p->body_a), to->b = index_of(mechanism, p->body_b);
        set_local(m, to->a, p->ax_m, p->ay_m, centre, local);
        set_local(m, to->b, p->bx_m, p->by_m, centre, local + 2);
        to->ax = local[0], to->ay = local[1], to->bx = local[2], to->by = local[3];
        to->k = p->stiffness_N_per_m * tt / s.mass_kg;
        to->c = p->damping_Ns_per_m * s.time_s / s.mass_kg;
        to->length = p->length_m / s.length_m;
        m->dissipates = m->dissipates || to->c > 0;
    }
    m->ntorsion = terms->ntorsion;
    m->nload = terms->nload;
    m->nspring = terms->nspring;
}

/* the model in its own units: lengths of order 1 and masses of mean 1 bring the condition of the
   six-bar's equations from 1.5e14 (SI) to 2e2. Inputs SI, q (3 nbody) the pose that becomes u = 0.
 */
fw_status fw_model_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_terms *terms,
                       const double *q, double duration_s, fw_model **model) {
    fw_model *m = fw_arena_one(arena, fw_model);
    FW_NEED(m);
    m->nbody = mechanism->nbody;
    m->npin = mechanism->npin;
    m->nq = 3 * m->nbody;
    double mass = 0;
    for (int b = 0; b < m->nbody; b++)
        mass += mechanism->body[b].mass_kg;
    m->scale.mass_kg = mass / m->nbody;
    m->scale.length_m = scene_length(mechanism);
    m->scale.time_s = scene_time(mechanism, terms, m->scale.length_m, duration_s);
    FW_TRY(allocate(arena, mechanism, terms, m));
    FW_TRY(fw_topology_order(arena, mechanism, m->pin));
    fw_vec2 centre = middle(mechanism, q);
    set_bodies(m, mechanism, q, centre);
    set_pins(m, mechanism, centre);
    m->size = fmax(m->size, 1);
    if (terms) set_terms(m, mechanism, terms, centre);
    m->ny = 2 * m->nq + (m->dissipates ? 1 : 0);
    FW_TRY(fw_chain_compile(arena, m));
    *model = m;
    return FW_OK;
}
