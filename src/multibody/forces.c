/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Applied forces of the active effects, as accelerations M^-1 Q; each kind is one loop that does
   not run when it is empty. Scaled units.

   torsion   torque -k angle - c rate between two bodies
   stop      the same beyond an angle, while it touches
   load      constant force at a point; timed: force and torque times a law
   spring    k (l - l0) + c l' along the line between two points; a cable only while taut. Where
             the points meet, along their relative velocity, which is where the line comes to lie
             next: the damping force is continuous there along every motion
   slide     -k s - c s' along the axis of a prismatic joint
   elements  in elements.c
   Test: test_simulate.c, test_constraints.c (against the derivative of the energy). */
#include "multibody/model.h"
#include <float.h>
#include <math.h>

static void push(fw_multibody_model *m, int body, double rx, double ry, double fx, double fy) {
    double *a = m->accel + 3 * body;
    a[0] += m->minv[body] * fx;
    a[1] += m->minv[body] * fy;
    a[2] += m->jinv[body] * (rx * fy - ry * fx);
}

static void twist(fw_multibody_model *m, int a, int b, double torque) {
    m->accel[3 * a + 2] -= m->jinv[a] * torque;
    m->accel[3 * b + 2] += m->jinv[b] * torque;
}

static double difference(const fw_multibody_model *m, const double *x, int a, int b) {
    return (b < m->nbody ? x[3 * b + 2] : 0) - (a < m->nbody ? x[3 * a + 2] : 0);
}

double fw_multibody_spring_round_off(const fw_multibody_model *m,
                                     const fw_multibody_model_spring *s) {
    const double *a = m->origin + 3 * s->a, *b = m->origin + 3 * s->b;
    double reach = fabs(a[0]) + fabs(a[1]) + fabs(b[0]) + fabs(b[1]);
    return 64 * DBL_EPSILON * (reach + fabs(s->ax) + fabs(s->ay) + fabs(s->bx) + fabs(s->by));
}

fw_multibody_pull fw_multibody_model_pull(const fw_multibody_model *m,
                                          const fw_multibody_model_spring *s, const double *y) {
    const double *u = y, *v = y + m->nq;
    double state[2][6] = {{0}}; /* x, y, vx, vy of each point, then the arm */
    const int body[2] = {s->a, s->b};
    const double local[2][2] = {{s->ax, s->ay}, {s->bx, s->by}};
    for (int i = 0; i < 2; i++) {
        int b = body[i];
        double rx = m->cosine[b] * local[i][0] - m->sine[b] * local[i][1];
        double ry = m->sine[b] * local[i][0] + m->cosine[b] * local[i][1];
        double *p = state[i];
        p[4] = rx, p[5] = ry;
        p[0] = m->origin[3 * b] + rx, p[1] = m->origin[3 * b + 1] + ry;
        if (b == m->nbody && m->stretch.law && m->held_s < 0) {
            const double *grows = m->stretch.spring + 4 * (s - m->spring) + 2 * i;
            p[2] = m->stretch.now[1] * grows[0], p[3] = m->stretch.now[1] * grows[1];
        }
        if (b == m->nbody) continue;
        p[0] += u[3 * b], p[1] += u[3 * b + 1];
        p[2] = v[3 * b] - v[3 * b + 2] * ry;
        p[3] = v[3 * b + 1] + v[3 * b + 2] * rx;
    }
    double dx = state[1][0] - state[0][0], dy = state[1][1] - state[0][1];
    double wx = state[1][2] - state[0][2], wy = state[1][3] - state[0][3];
    double length = sqrt(dx * dx + dy * dy), size = length;
    if (length <= fw_multibody_spring_round_off(m, s) && (wx != 0 || wy != 0))
        dx = wx, dy = wy, size = sqrt(wx * wx + wy * wy);
    double inverse = size > 0 ? 1 / size : 0, ux = dx * inverse, uy = dy * inverse;
    double rate = ux * wx + uy * wy;
    return (fw_multibody_pull){state[0][4], state[0][5], state[1][4], state[1][5],
                               ux,          uy,          length,      rate};
}

void fw_multibody_model_travel(const fw_multibody_model *m, const fw_multibody_model_slide *s,
                               const double *y, double *travel, double *rate) {
    double d[2], e[2], n[2], psi_rate = 0;
    const double *v = y + m->nq, *arm = m->arm + 4 * s->block;
    fw_multibody_model_frame(m, s->block, y, d, e, n);
    *travel = e[0] * d[0] + e[1] * d[1] - s->free;
    for (int side = 0; side < 2; side++) {
        int b = side ? s->b : s->a;
        if (b == m->nbody) continue;
        const double *w = v + 3 * b, *r = arm + 2 * side;
        double vx = w[0] - w[2] * r[1], vy = w[1] + w[2] * r[0];
        psi_rate += (side ? 1 : -1) * (e[0] * vx + e[1] * vy);
        if (!side) psi_rate += w[2] * (n[0] * d[0] + n[1] * d[1]);
    }
    const double *grows = m->stretch.block + 2 * s->block;
    if (m->stretch.law && m->held_s < 0)
        psi_rate += m->stretch.now[1] * (e[0] * grows[0] + e[1] * grows[1]);
    *rate = psi_rate;
}

void fw_multibody_model_stopped(const fw_multibody_model *m, const fw_multibody_model_stop *s,
                                const double *y, double *past, double *rate) {
    *past = s->side * (difference(m, y, s->a, s->b) - s->at);
    *rate = s->side * difference(m, y + m->nq, s->a, s->b);
}

static void turning(fw_multibody_model *m, const double *y) {
    const double *u = y, *v = y + m->nq;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_model_torsion *t = &m->torsion[i];
        double angle = t->angle0 + difference(m, u, t->a, t->b);
        twist(m, t->a, t->b, -t->k * angle - t->c * difference(m, v, t->a, t->b));
    }
    for (int i = 0; i < m->nstop; i++) {
        const fw_multibody_model_stop *s = &m->stop[i];
        double past, rate;
        if (!s->on) continue;
        fw_multibody_model_stopped(m, s, y, &past, &rate);
        twist(m, s->a, s->b, -s->side * (s->k * past + s->c * rate));
    }
}

static void loads(fw_multibody_model *m, double t) {
    for (int i = 0; i < m->nload; i++) {
        const fw_multibody_model_load *l = &m->load[i];
        double c = m->cosine[l->body], s = m->sine[l->body];
        push(m, l->body, c * l->x - s * l->y, s * l->x + c * l->y, l->fx, l->fy);
    }
    for (int i = 0; i < m->ntimed; i++) {
        const fw_multibody_model_timed *l = &m->timed[i];
        double c = m->cosine[l->body], s = m->sine[l->body], factor[3];
        fw_quantity_law_value(l->law, t * m->scale.time_s, m->piece, factor);
        push(m, l->body, c * l->x - s * l->y, s * l->x + c * l->y, factor[0] * l->fx,
             factor[0] * l->fy);
        m->accel[3 * l->body + 2] += m->jinv[l->body] * factor[0] * l->torque;
    }
}

static void springs(fw_multibody_model *m, const double *y) {
    for (int i = 0; i < m->nspring; i++) {
        const fw_multibody_model_spring *s = &m->spring[i];
        if (!s->on) continue;
        fw_multibody_pull p = fw_multibody_model_pull(m, s, y);
        double f = s->k * (p.length - s->length) + s->c * p.rate;
        push(m, s->a, p.ax, p.ay, f * p.ux, f * p.uy);
        push(m, s->b, p.bx, p.by, -f * p.ux, -f * p.uy);
    }
    for (int i = 0; i < m->nslide; i++) { /* acts where both bodies have the joint's point b */
        const fw_multibody_model_slide *s = &m->slide[i];
        const double *r = m->arm + 4 * s->block;
        double d[2], e[2], n[2], travel, rate;
        fw_multibody_model_frame(m, s->block, y, d, e, n);
        fw_multibody_model_travel(m, s, y, &travel, &rate);
        double f = s->k * travel + s->c * rate;
        push(m, s->a, r[0] + d[0], r[1] + d[1], f * e[0], f * e[1]);
        push(m, s->b, r[2], r[3], -f * e[0], -f * e[1]);
    }
}

void fw_multibody_model_forces(fw_multibody_model *m, double t, const double *y) {
    for (int i = 0; i < m->nq + 3; i++) /* the ground's three zeros too */
        m->accel[i] = m->constant[i];
    turning(m, y);
    loads(m, t);
    springs(m, y);
    if (m->nelement > 0) fw_multibody_model_element_forces(m, t, y);
}

static double taken(const fw_multibody_model *m, const double *y) {
    double power = 0, a, rate;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_model_torsion *t = &m->torsion[i];
        rate = difference(m, y + m->nq, t->a, t->b);
        power += t->c * rate * rate;
    }
    for (int i = 0; i < m->nstop; i++)
        if (m->stop[i].on && m->stop[i].c > 0) {
            fw_multibody_model_stopped(m, &m->stop[i], y, &a, &rate);
            power += m->stop[i].c * rate * rate;
        }
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].on && m->spring[i].c > 0) {
            rate = fw_multibody_model_pull(m, &m->spring[i], y).rate;
            power += m->spring[i].c * rate * rate;
        }
    for (int i = 0; i < m->nslide; i++)
        if (m->slide[i].c > 0) {
            fw_multibody_model_travel(m, &m->slide[i], y, &a, &rate);
            power += m->slide[i].c * rate * rate;
        }
    return power;
}

void fw_multibody_model_power(const fw_multibody_model *m, double t, const double *y,
                              double power[2]) {
    power[0] = m->dissipated >= 0 ? taken(m, y) : 0;
    power[1] = 0;
    for (int i = 0; i < m->ntimed; i++) {
        const fw_multibody_model_timed *l = &m->timed[i];
        const double *v = y + m->nq + 3 * l->body;
        double c = m->cosine[l->body], s = m->sine[l->body], factor[3];
        double rx = c * l->x - s * l->y, ry = s * l->x + c * l->y;
        fw_quantity_law_value(l->law, t * m->scale.time_s, m->piece, factor);
        power[1] += factor[0] *
                    (l->fx * (v[0] - v[2] * ry) + l->fy * (v[1] + v[2] * rx) + l->torque * v[2]);
    }
    if (m->nelement > 0) fw_multibody_model_element_power(m, t, y, power);
    if (m->stretch.law) power[1] += fw_multibody_stretch_power(m, y);
}
