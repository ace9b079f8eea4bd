/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/model.h"
#include <math.h>

static double work_of_loads(const fw_model *m, const double *u) {
    double work = 0;
    for (int b = 0; b < m->nbody; b++)
        for (int c = 0; c < 3; c++)
            work += (c < 2 ? m->mass[b] : m->inertia[b]) * m->constant[3 * b + c] * u[3 * b + c];
    for (int i = 0; i < m->nload; i++) {
        const fw_model_load *l = &m->load[i];
        double c = m->cosine[l->body], s = m->sine[l->body];
        double c0 = cos(m->origin[3 * l->body + 2]), s0 = sin(m->origin[3 * l->body + 2]);
        double dx = u[3 * l->body] + (c - c0) * l->x - (s - s0) * l->y;
        double dy = u[3 * l->body + 1] + (s - s0) * l->x + (c - c0) * l->y;
        work += l->fx * dx + l->fy * dy;
    }
    return work;
}

static void point(const fw_model *m, int b, double x, double y, const double *u, double out[2]) {
    out[0] = m->origin[3 * b] + m->cosine[b] * x - m->sine[b] * y;
    out[1] = m->origin[3 * b + 1] + m->sine[b] * x + m->cosine[b] * y;
    if (b < m->nbody) out[0] += u[3 * b], out[1] += u[3 * b + 1];
}

/* T = v^T M v / 2, V = sum k angle^2 / 2 + sum k (l - l0)^2 / 2, W = work of constant loads from
   the assembled pose, D = integral of the damping power (carried with the state). T + V + D - W is
   constant. Scaled units. Uses the sines of the pose (fw_model_pose). Test: test_simulate.c. */
fw_energy fw_model_energy(fw_model *m, const double *y) {
    const double *u = y, *v = y + m->nq;
    fw_energy e = {.dissipated = m->dissipates ? y[2 * m->nq] : 0};
    for (int b = 0; b < m->nbody; b++)
        e.kinetic += 0.5 * (m->mass[b] * (v[3 * b] * v[3 * b] + v[3 * b + 1] * v[3 * b + 1]) +
                            m->inertia[b] * v[3 * b + 2] * v[3 * b + 2]);
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_model_torsion *t = &m->torsion[i];
        double turn = t->angle0 + (t->b < m->nbody ? u[3 * t->b + 2] : 0) -
                      (t->a < m->nbody ? u[3 * t->a + 2] : 0);
        e.elastic += 0.5 * t->k * turn * turn;
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_model_spring *s = &m->spring[i];
        double a[2], b[2];
        point(m, s->a, s->ax, s->ay, u, a);
        point(m, s->b, s->bx, s->by, u, b);
        double stretch = hypot(b[0] - a[0], b[1] - a[1]) - s->length;
        e.elastic += 0.5 * s->k * stretch * stretch;
    }
    e.work = work_of_loads(m, u);
    return e;
}
