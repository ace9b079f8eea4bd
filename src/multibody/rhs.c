/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/kernel.h"
#include <math.h>
#include <string.h>

/* gamma + 2 alpha (G v + Psi_t) + alpha^2 Psi: the drift of a free run dies away. Source:
   Baumgarte 1972 */
static void baumgarte(fw_multibody_model *m, double t, const double *y, double *gamma) {
    double alpha = m->baumgarte;
    fw_multibody_model_jacobian(m, y + m->nq, m->more);
    fw_multibody_model_drift(m, t, m->drift);
    for (int i = 0; i < 2 * m->nblock; i++)
        gamma[i] += 2 * alpha * (m->more[i] + m->drift[i]);
    fw_multibody_model_residual(m, t, y, m->more);
    for (int i = 0; i < 2 * m->nblock; i++)
        gamma[i] += alpha * alpha * m->more[i];
}

void fw_multibody_model_free(fw_multibody_model *m, double t, const double *y) {
    fw_multibody_model_forces(m, t, y);
    fw_multibody_model_gamma(m, t, y + m->nq, m->right);
    if (m->baumgarte > 0) baumgarte(m, t, y, m->right);
    m->method->accelerate(m, m->right, m->accel, m->lambda);
}

/* f = (v, a, power) with M a + G^T lambda = Q, G a = -gamma, gamma = G' v + Psi_tt. Inputs: state
   y; pose and factor at its u. Output f (ny). Error: round-off times cond(S). Cost: the method's.
   Source: Lagrange multipliers in index-1 form; Garcia de Jalon and Bayo 1994, ch. 5. Test:
   test_simulate.c (reference six-bar). */
void fw_multibody_model_accelerate(fw_multibody_model *m, double t, const double *y, double *f) {
    const double *v = y + m->nq;
    fw_multibody_model_free(m, t, y);
    if (m->friction) fw_multibody_friction_apply(m, t, y);
    for (int i = 0; i < m->nq; i++) {
        f[i] = v[i];
        f[m->nq + i] = m->broken ? (double)NAN : m->accel[i];
    }
    if (m->ny == 2 * m->nq || m->lean) return;
    double power[2];
    fw_multibody_model_power(m, t, y, power);
    if (m->friction) power[0] += fw_multibody_friction_power(m);
    if (m->driven) {
        fw_multibody_model_drift(m, t, m->drift);
        for (int i = 0; i < 2 * m->nblock; i++)
            power[1] += m->lambda[i] * m->drift[i];
    }
    if (m->dissipated >= 0) f[m->dissipated] = power[0];
    if (m->worked >= 0) f[m->worked] = power[1];
}

/* methods that integrate independent coordinates see the closed state that belongs to them */
static const double *closed(fw_multibody_model *m, double t, const double *y) {
    memcpy(m->stage, y, (size_t)m->ny * sizeof *y);
    m->broken = !m->method->close(m, t, m->stage) || !m->method->factor(m) ||
                !fw_multibody_model_project_velocity(m, t, m->stage + m->nq);
    return m->stage;
}

void fw_multibody_model_rhs(void *model, double t, const double *y, double *f) {
    fw_multibody_model *m = model;
    if (m->kernel && m->baumgarte == 0) {
        fw_multibody_kernel_rhs(m->kernel, y, f);
        return;
    }
    fw_multibody_model_at(m, t);
    if (m->method->closes_stages) {
        y = closed(m, t, y);
    } else {
        fw_multibody_model_pose(m, y);
        m->broken = !m->method->factor(m);
    }
    fw_multibody_model_accelerate(m, t, y, f);
}

void fw_multibody_model_lean_rhs(void *model, double t, const double *y, double *f) {
    fw_multibody_model *m = model;
    m->lean = true;
    fw_multibody_model_rhs(m, t, y, f);
    m->lean = false;
}

void fw_multibody_model_react(fw_multibody_model *m, double t, const double *y, double *f) {
    fw_multibody_model_lean_rhs(m, t, y, f);
    if (m->kernel && m->baumgarte == 0)
        memcpy(m->lambda, fw_multibody_kernel_lambda(m->kernel),
               2 * (size_t)m->nblock * sizeof(double));
}
