/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/kernel.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_position_limit = 1e-12; /* scaled: what every accepted state satisfies */

static void move(const fw_multibody_model *m, double *x) {
    for (int i = 0; i < m->nq; i++)
        x[i] += m->correction[i];
}

/* a new factor where the last one converged slowly: near a singular position modes of S below eps
   shrink by eps/(s + eps) only, so the shift falls with every call, as far as S stays positive */
static bool sharpen(fw_multibody_model *m) {
    m->epsilon = fmax(0.1 * m->epsilon, 1e-11);
    if (m->method->factor(m)) return true;
    m->epsilon = fw_epsilon;
    return m->method->factor(m);
}

/* the joint that stays open, for the message when no smaller step helps; Psi is in m->right */
static void remember_stuck(fw_multibody_model *m, double t, double norm) {
    m->stuck = 0;
    for (int i = 0; i < m->nblock; i++)
        if (hypot(m->right[2 * i], m->right[2 * i + 1]) >= norm) m->stuck = i;
    m->stuck_time = t;
}

/* Newton u += d, G d = -Psi with the factor at hand (of a pose a step's error away); it is renewed
   when that converges slowly. Ends at round-off: below 2 eps times the size, or no longer halving
   below 1e-13 of it and below the limit. false: |Psi| stays above 1e-12 scaled. Input and output u
   (3 nbody), scaled; the model is left posed at the result. Cost one to two solves. Source:
   coordinate projection in the mass metric, Eich 1993. Test: test_simulate.c. */
bool fw_multibody_model_project_position(fw_multibody_model *m, double t, double *u) {
    double before = (double)INFINITY, norm = 0;
    const double round_off = fmin(1e-13 * m->size, fw_position_limit);
    if (m->method->close) {
        if (!m->method->close(m, t, u)) return false;
        norm = fw_multibody_model_residual(m, t, u, m->right);
        m->worst_position = fmax(m->worst_position, norm);
        return norm <= fw_position_limit;
    }
    for (int i = 0; i < 20; i++) {
        norm = fw_multibody_model_residual(m, t, u, m->right);
        if (!(norm < (double)INFINITY)) break;
        bool slow = norm > 0.25 * before;
        if (norm <= 2 * DBL_EPSILON * m->size || (slow && norm <= round_off)) break;
        if (slow && i > 2 ? !sharpen(m) : (slow || i == 4) && !m->method->factor(m)) break;
        before = norm;
        m->method->correct(m, m->right, m->correction);
        move(m, u);
    }
    m->epsilon = fw_epsilon;
    if (norm <= fw_position_limit) {
        m->worst_position = fmax(m->worst_position, norm);
        return true;
    }
    remember_stuck(m, t, norm);
    return false;
}

/* v += d, G d = -(G v + Psi_t); factor and pose must belong together */
bool fw_multibody_model_project_velocity(fw_multibody_model *m, double t, double *v) {
    double before = (double)INFINITY, norm = 0, size = DBL_MIN;
    for (int i = 0; i < m->nq; i++)
        size = fmax(size, fabs(v[i]));
    if (m->driven) fw_multibody_model_drift(m, t, m->drift);
    for (int i = 0; i < 6; i++) {
        fw_multibody_model_jacobian(m, v, m->right);
        norm = 0;
        for (int j = 0; j < 2 * m->nblock; j++) {
            if (m->driven) m->right[j] += m->drift[j];
            norm = fmax(norm, fabs(m->right[j]));
        }
        if (norm <= 2 * DBL_EPSILON * size || norm > 0.25 * before) break;
        before = norm;
        m->method->correct(m, m->right, m->correction);
        move(m, v);
    }
    m->worst_velocity = fmax(m->worst_velocity, norm);
    return norm < (double)INFINITY;
}

/* an impact without rebound: v += d with M d = -G^T L, G d = -(G v + Psi_t), the least change in
   the mass metric, whatever the method corrects its steps by. Pose and factor belong together. */
bool fw_multibody_model_impact(fw_multibody_model *m, double t, double *v) {
    fw_multibody_model_jacobian(m, v, m->right);
    fw_multibody_model_drift(m, t, m->drift);
    for (int i = 0; i < 2 * m->nblock; i++)
        m->right[i] += m->drift[i];
    memset(m->correction, 0, (size_t)m->nq * sizeof *m->correction);
    m->method->accelerate(m, m->right, m->correction, m->lambda);
    move(m, v);
    return fw_multibody_model_project_velocity(m, t, v);
}

/* without projection the norms are only watched */
static void monitor(fw_multibody_model *m, double t, const double *y) {
    m->worst_position = fmax(m->worst_position, fw_multibody_model_residual(m, t, y, m->right));
    fw_multibody_model_jacobian(m, y + m->nq, m->right);
    fw_multibody_model_drift(m, t, m->drift);
    for (int i = 0; i < 2 * m->nblock; i++)
        m->worst_velocity = fmax(m->worst_velocity, fabs(m->right[i] + m->drift[i]));
}

/* an accepted step: q onto Psi = 0, then v onto G v = -Psi_t with the factor at the new pose, which
   the evaluation of f uses again */
bool fw_multibody_model_project(void *model, double t, double *y, double *f) {
    fw_multibody_model *m = model;
    if (!m->projecting) {
        monitor(m, t, y);
        fw_multibody_model_rhs(m, t, y, f);
        return !m->broken;
    }
    m->projections++;
    if (m->kernel) {
        if (!fw_multibody_kernel_project(m->kernel, y, f)) return false;
        fw_multibody_kernel_norms norms = fw_multibody_kernel_norms_of(m->kernel);
        m->worst_position = fmax(m->worst_position, norms.position);
        m->worst_velocity = fmax(m->worst_velocity, norms.velocity);
        return true;
    }
    double worst = m->worst_position, worst_velocity = m->worst_velocity;
    bool good = fw_multibody_model_project_position(m, t, y);
    if (good) {
        m->broken = !m->method->factor(m);
        good = !m->broken && fw_multibody_model_project_velocity(m, t, y + m->nq);
    }
    if (!good) { /* a rejected step does not count */
        m->worst_position = worst;
        m->worst_velocity = worst_velocity;
        return false;
    }
    if (m->friction) fw_multibody_friction_settle(m, y);
    fw_multibody_model_accelerate(m, t, y, f);
    return true;
}
