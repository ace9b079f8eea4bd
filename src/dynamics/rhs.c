/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/model.h"
#include <math.h>

void fw_model_pose(fw_model *m, const double *u) {
    const double *origin = m->origin;
    for (int b = 0; b < m->nbody; b++) {
        double angle = origin[3 * b + 2] + u[3 * b + 2];
        sincos(angle, &m->sine[b], &m->cosine[b]);
    }
    for (int i = 0; i < 2 * m->npin; i++) {
        double c = m->cosine[m->body[i]], s = m->sine[m->body[i]];
        double x = m->local[2 * i], y = m->local[2 * i + 1];
        m->arm[2 * i] = c * x - s * y;
        m->arm[2 * i + 1] = s * x + c * y;
    }
}

static void push(fw_model *m, int body, double rx, double ry, double fx, double fy) {
    double *a = m->accel + 3 * body;
    a[0] += m->minv[body] * fx;
    a[1] += m->minv[body] * fy;
    a[2] += m->jinv[body] * (rx * fy - ry * fx);
}

typedef struct pull {      /* a spring between two points, as it is now */
    double ax, ay, bx, by; /* arms in world axes */
    double ux, uy, length, rate;
} pull;

static pull pull_of(const fw_model *m, const fw_model_spring *s, const double *y) {
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
        if (b == m->nbody) continue;
        p[0] += u[3 * b], p[1] += u[3 * b + 1];
        p[2] = v[3 * b] - v[3 * b + 2] * ry;
        p[3] = v[3 * b + 1] + v[3 * b + 2] * rx;
    }
    double dx = state[1][0] - state[0][0], dy = state[1][1] - state[0][1];
    double length = sqrt(dx * dx + dy * dy), inverse = length > 0 ? 1 / length : 0;
    double ux = dx * inverse, uy = dy * inverse;
    double rate = ux * (state[1][2] - state[0][2]) + uy * (state[1][3] - state[0][3]);
    return (pull){state[0][4], state[0][5], state[1][4], state[1][5], ux, uy, length, rate};
}

/* accel = M^-1 Q of the active effects; each kind is one loop that does not run when it is empty */
void fw_model_forces(fw_model *m, const double *y) {
    const double *u = y, *v = y + m->nq;
    double *a = m->accel;
    for (int i = 0; i < m->nq + 3; i++) /* the ground's three zeros too */
        a[i] = m->constant[i];
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_model_torsion *t = &m->torsion[i];
        double turn = t->angle0, rate = 0;
        if (t->a < m->nbody) turn -= u[3 * t->a + 2], rate -= v[3 * t->a + 2];
        if (t->b < m->nbody) turn += u[3 * t->b + 2], rate += v[3 * t->b + 2];
        double torque = t->k * turn + t->c * rate;
        a[3 * t->a + 2] += m->jinv[t->a] * torque;
        a[3 * t->b + 2] -= m->jinv[t->b] * torque;
    }
    for (int i = 0; i < m->nload; i++) {
        const fw_model_load *l = &m->load[i];
        double c = m->cosine[l->body], s = m->sine[l->body];
        push(m, l->body, c * l->x - s * l->y, s * l->x + c * l->y, l->fx, l->fy);
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_model_spring *s = &m->spring[i];
        pull p = pull_of(m, s, y);
        double f = s->k * (p.length - s->length) + s->c * p.rate;
        push(m, s->a, p.ax, p.ay, f * p.ux, f * p.uy);
        push(m, s->b, p.bx, p.by, -f * p.ux, -f * p.uy);
    }
}

static double dissipation(const fw_model *m, const double *y) {
    const double *v = y + m->nq;
    double power = 0;
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_model_torsion *t = &m->torsion[i];
        double rate =
            (t->b < m->nbody ? v[3 * t->b + 2] : 0) - (t->a < m->nbody ? v[3 * t->a + 2] : 0);
        power += t->c * rate * rate;
    }
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].c > 0) {
            pull p = pull_of(m, &m->spring[i], y);
            power += m->spring[i].c * p.rate * p.rate;
        }
    return power;
}

void fw_model_apply(const fw_model *m, const double *lambda, double *a) {
    for (int i = 0; i < m->npin; i++) {
        int p = m->body[2 * i], q = m->body[2 * i + 1];
        const double *r = m->arm + 4 * i;
        double x = lambda[2 * i], y = lambda[2 * i + 1];
        if (p < m->nbody) {
            a[3 * p] -= m->minv[p] * x;
            a[3 * p + 1] -= m->minv[p] * y;
            a[3 * p + 2] -= m->jinv[p] * (r[0] * y - r[1] * x);
        }
        if (q < m->nbody) {
            a[3 * q] += m->minv[q] * x;
            a[3 * q + 1] += m->minv[q] * y;
            a[3 * q + 2] += m->jinv[q] * (r[2] * y - r[3] * x);
        }
    }
}

void fw_model_jacobian(const fw_model *m, const double *v, double *r) {
    static const double still[3] = {0};
    for (int i = 0; i < m->npin; i++) {
        int p = m->body[2 * i], q = m->body[2 * i + 1];
        const double *s = m->arm + 4 * i;
        const double *vp = p < m->nbody ? v + 3 * p : still, *vq = q < m->nbody ? v + 3 * q : still;
        r[2 * i] = vp[0] - vp[2] * s[1] - vq[0] + vq[2] * s[3];
        r[2 * i + 1] = vp[1] + vp[2] * s[0] - vq[1] - vq[2] * s[2];
    }
}

/* f = (v, a, power) with a = M^-1 (Q - G^T lambda), S lambda = G M^-1 Q + G' v, where pin rows of
   G' v are -w_a^2 r_a + w_b^2 r_b. Inputs: state y; arms and factor at its pose. Output f (ny).
   Error: round-off times cond(S). Cost O(bodies). Source: Lagrange multipliers in index-1 form;
   Garcia de Jalon and Bayo 1994, ch. 5. Test: test_simulate.c (reference six-bar). */
void fw_model_accelerate(fw_model *m, const double *y, double *f) {
    const double *v = y + m->nq;
    fw_model_forces(m, y);
    double *r = m->right, *a = m->accel;
    for (int i = 0; i < m->npin; i++) {
        int p = m->body[2 * i], q = m->body[2 * i + 1];
        const double *s = m->arm + 4 * i, *ap = a + 3 * p, *aq = a + 3 * q;
        double wp = p < m->nbody ? v[3 * p + 2] : 0, wq = q < m->nbody ? v[3 * q + 2] : 0;
        wp *= wp, wq *= wq;
        r[2 * i] = ap[0] - ap[2] * s[1] - wp * s[0] - aq[0] + aq[2] * s[3] + wq * s[2];
        r[2 * i + 1] = ap[1] + ap[2] * s[0] - wp * s[1] - aq[1] - aq[2] * s[2] + wq * s[3];
    }
    fw_chain_proximal(&m->chain, r, m->lambda, m->more);
    fw_model_apply(m, m->lambda, a);
    for (int i = 0; i < m->nq; i++) {
        f[i] = v[i];
        f[m->nq + i] = m->broken ? (double)NAN : a[i];
    }
    if (m->dissipates) f[2 * m->nq] = dissipation(m, y);
}

void fw_model_rhs(void *model, double t, const double *y, double *f) {
    fw_model *m = model;
    (void)t; /* all effects so far are constant in time */
    fw_model_pose(m, y);
    fw_chain_assemble(m);
    m->broken = !fw_chain_factor(&m->chain, fw_epsilon);
    fw_model_accelerate(m, y, f);
}
