/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/model.h"
#include <math.h>

static double work_of_loads(const fw_multibody_model *m, const double *u) {
    double work = 0;
    for (int b = 0; b < m->nbody; b++)
        for (int c = 0; c < 3; c++)
            work += (c < 2 ? m->mass[b] : m->inertia[b]) * m->constant[3 * b + c] * u[3 * b + c];
    for (int i = 0; i < m->nload; i++) {
        const fw_multibody_model_load *l = &m->load[i];
        double c = m->cosine[l->body], s = m->sine[l->body];
        double c0 = cos(m->origin[3 * l->body + 2]), s0 = sin(m->origin[3 * l->body + 2]);
        double dx = u[3 * l->body] + (c - c0) * l->x - (s - s0) * l->y;
        double dy = u[3 * l->body + 1] + (s - s0) * l->x + (c - c0) * l->y;
        work += l->fx * dx + l->fy * dy;
    }
    return work;
}

static double stored(const fw_multibody_model *m, double t, const double *y) {
    double energy = 0, stretch, rate;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_model_torsion *s = &m->torsion[i];
        stretch = s->angle0 + (s->b < m->nbody ? y[3 * s->b + 2] : 0) -
                  (s->a < m->nbody ? y[3 * s->a + 2] : 0);
        energy += 0.5 * s->k * stretch * stretch;
    }
    for (int i = 0; i < m->nstop; i++) {
        if (!m->stop[i].on) continue;
        fw_multibody_model_stopped(m, &m->stop[i], y, &stretch, &rate);
        energy += 0.5 * m->stop[i].k * stretch * stretch;
    }
    for (int i = 0; i < m->nspring; i++) {
        if (!m->spring[i].on) continue;
        stretch = fw_multibody_model_pull(m, &m->spring[i], y).length - m->spring[i].length;
        energy += 0.5 * m->spring[i].k * stretch * stretch;
    }
    for (int i = 0; i < m->nslide; i++) {
        fw_multibody_model_travel(m, &m->slide[i], y, &stretch, &rate);
        energy += 0.5 * m->slide[i].k * stretch * stretch;
    }
    return energy + (m->nelement > 0 ? fw_multibody_model_element_energy(m, t, y, true) : 0);
}

double fw_multibody_model_kinetic(const fw_multibody_model *m, const double *v) {
    double sum = 0;
    for (int b = 0; b < m->nbody; b++)
        sum += 0.5 * (m->mass[b] * (v[3 * b] * v[3 * b] + v[3 * b + 1] * v[3 * b + 1]) +
                      m->inertia[b] * v[3 * b + 2] * v[3 * b + 2]);
    return sum;
}

/* T = v^T M v / 2; V of torsion springs, stops, point springs and slides, k x^2 / 2 each, and what
   elements say that they store at time t; W = work of constant loads from the assembled pose, and
   of drivers, timed loads and laws of elements as carried with the state; D = what dampers took,
   carried with the state. T + V + D - W is constant. Scaled units. Uses the sines of the pose
   (fw_multibody_model_pose). Test: test_simulate.c, test_constraints.c. */
fw_multibody_energy fw_multibody_model_energy(fw_multibody_model *m, double t, const double *y) {
    const double *u = y, *v = y + m->nq;
    fw_multibody_energy e = {.dissipated = m->dissipated >= 0 ? y[m->dissipated] : 0};
    e.kinetic = fw_multibody_model_kinetic(m, v);
    e.elastic = stored(m, t, y);
    e.work = work_of_loads(m, u) + (m->worked >= 0 ? y[m->worked] : 0);
    return e;
}
