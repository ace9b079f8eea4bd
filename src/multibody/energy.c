/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/multibody_scratch.h"
#include <math.h>

static double work_of_loads(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                            const double *u) {
    const fw_multibody_model *m = sys->model;
    const double *constant = sys->loading.constant;
    double work = 0;
    for (int b = 0; b < m->nbody; b++)
        for (int c = 0; c < 3; c++)
            work += (c < 2 ? m->mass[b] : m->inertia[b]) * constant[3 * b + c] * u[3 * b + c];
    for (int i = 0; i < m->nload; i++) {
        const fw_multibody_load *l = &m->load[i];
        const double *f = sys->loading.force + 2 * i;
        double c = pose->cosine[l->body], s = pose->sine[l->body];
        double c0 = cos(m->origin[3 * l->body + 2]), s0 = sin(m->origin[3 * l->body + 2]);
        double dx = u[3 * l->body] + (c - c0) * l->x - (s - s0) * l->y;
        double dy = u[3 * l->body + 1] + (s - s0) * l->x + (c - c0) * l->y;
        work += f[0] * dx + f[1] * dy;
    }
    return work;
}

static double stored(const fw_multibody_system *sys, const fw_multibody_pose *pose, const double *u,
                     const double *v) {
    const fw_multibody_model *m = sys->model;
    double energy = 0, stretch, rate;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *s = &m->torsion[i];
        stretch = s->angle0 + (s->b < m->nbody ? u[3 * s->b + 2] : 0) -
                  (s->a < m->nbody ? u[3 * s->a + 2] : 0);
        energy += 0.5 * s->k * stretch * stretch;
    }
    for (int i = 0; i < m->nstop; i++) {
        if (!sys->on.stop[i]) continue;
        fw_multibody_stop_travel(m, pose, &m->stop[i], v, &stretch, &rate);
        energy += 0.5 * m->stop[i].k * stretch * stretch;
    }
    for (int i = 0; i < m->nspring; i++) {
        if (!sys->on.spring[i]) continue;
        stretch = fw_multibody_pull_of(sys, pose, i, v).length - m->spring[i].length;
        energy += 0.5 * m->spring[i].k * stretch * stretch;
    }
    for (int i = 0; i < m->nslide; i++) {
        fw_multibody_slide_travel(sys, pose, &m->slide[i], v, &stretch, &rate);
        energy += 0.5 * m->slide[i].k * stretch * stretch;
    }
    return energy + (m->nelement > 0 ? fw_multibody_element_energy(sys, pose, v, true) : 0);
}

double fw_multibody_kinetic_energy(const fw_multibody_model *m, const double *v) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++)
        sum += 0.5 * (m->mass[b] * (v[3 * b] * v[3 * b] + v[3 * b + 1] * v[3 * b + 1]) +
                      m->inertia[b] * v[3 * b + 2] * v[3 * b + 2]);
    return sum;
}

/* T = v^T M v / 2; V of torsion springs, stops, point springs and slides, k x^2 / 2 each, and what
   elements say that they store at time t; W = work of constant loads from the assembled pose, and
   of drivers, timed loads and laws of elements as carried with the state; D = what dampers took,
   carried with the state. T + V + D - W is constant. Scaled units. Models that have a kernel need
   no pose: no loads, stops or springs at points. Test: test_simulate.c, test_constraints.c. */
fw_multibody_energy fw_multibody_energy_at(fw_multibody_system *sys, double t, const double *y) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = sys->kernel ? NULL : fw_multibody_pose_at(sys, t, y);
    const double *u = y, *v = y + m->nq;
    fw_multibody_energy e = {.dissipated = m->dissipated >= 0 ? y[m->dissipated] : 0};
    e.kinetic = fw_multibody_kinetic_energy(m, v);
    e.elastic = stored(sys, pose, u, v);
    e.work = work_of_loads(sys, pose, u) + (m->worked >= 0 ? y[m->worked] : 0);
    return e;
}
