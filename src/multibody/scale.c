/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/multibody_scratch.h"
#include <math.h>

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

void fw_multibody_scale_of(const fw_mechanism *mechanism, const fw_effects_loads *loads,
                           double duration_s, fw_multibody_scale *scale) {
    double mass = 0;
    for (int b = 0; b < mechanism->nbody; b++)
        mass += mechanism->body[b].mass_kg;
    scale->mass_kg = mass / mechanism->nbody;
    scale->length_m = scene_length(mechanism);
    scale->time_s = scene_time(mechanism, loads, scale->length_m, duration_s);
}
