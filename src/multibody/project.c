/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Positions onto Psi(q, t) = 0 and velocities onto G v = -Psi_t. */
#include "multibody/multibody_scratch.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_position_limit = 1e-12; /* scaled: what every accepted state satisfies */

static void move(const fw_multibody_system *sys, double *x) {
    for (int i = 0; i < sys->model->nq; i++)
        x[i] += sys->work->correction[i];
}

const fw_multibody_factor *fw_multibody_factorise(fw_multibody_system *sys,
                                                  const fw_multibody_pose *pose) {
    return sys->model->method->factor(sys, pose) ? &sys->work->factor : NULL;
}

/* a new factor where the last one converged slowly: near a singular position modes of S below eps
   shrink by eps/(s + eps) only, so the shift falls with every call, as far as S stays positive */
static bool sharpen(fw_multibody_system *sys, const fw_multibody_pose *pose) {
    double *epsilon = &sys->work->epsilon;
    *epsilon = fmax(0.1 * *epsilon, 1e-11);
    if (fw_multibody_factorise(sys, pose)) return true;
    *epsilon = fw_epsilon;
    return fw_multibody_factorise(sys, pose);
}

/* the joint that stays open, for the message when no smaller step helps */
static void remember_stuck(fw_multibody_system *sys, double t, const double *psi, double norm) {
    sys->record.stuck = 0;
    for (int i = 0; i < sys->model->nblock; i++)
        if (hypot(psi[2 * i], psi[2 * i + 1]) >= norm) sys->record.stuck = i;
    sys->record.stuck_time = t;
}

/* the method's own way */
static const fw_multibody_pose *close_by_method(fw_multibody_system *sys, double t, double *u) {
    const fw_multibody_pose *pose = sys->model->method->close(sys, t, u);
    if (!pose) return NULL;
    double norm = fw_multibody_residual(sys, pose, NULL);
    sys->record.worst_position = fmax(sys->record.worst_position, norm);
    return norm <= fw_position_limit ? pose : NULL;
}

/* Newton u += d, G d = -Psi with the factor at hand (of a pose a step's error away); it is renewed
   when that converges slowly. Ends at round-off: below 2 eps times the size, or no longer halving
   below 1e-13 of it and below the limit. NULL: |Psi| stays above 1e-12 scaled. Input and output u
   (3 nbody), scaled. Cost one to two solves. Source: coordinate projection in the mass metric, Eich
   1993. Test: test_simulate.c. */
static const fw_multibody_pose *project_position(fw_multibody_system *sys, double t, double *u) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_pose *pose = NULL;
    double before = (double)INFINITY, norm = 0, *psi = sys->work->right;
    const double round_off = fmin(1e-13 * m->size, fw_position_limit);
    if (m->method->close) return close_by_method(sys, t, u);
    for (int i = 0; i < 20; i++) {
        pose = fw_multibody_pose_at(sys, t, u);
        norm = fw_multibody_residual(sys, pose, psi);
        if (!(norm < (double)INFINITY)) break;
        bool slow = norm > 0.25 * before;
        if (norm <= 2 * DBL_EPSILON * m->size || (slow && norm <= round_off)) break;
        if (slow && i > 2 ? !sharpen(sys, pose)
                          : (slow || i == 4) && !fw_multibody_factorise(sys, pose))
            break;
        before = norm;
        m->method->correct(sys, pose, psi, sys->work->correction);
        move(sys, u);
    }
    sys->work->epsilon = fw_epsilon;
    if (norm <= fw_position_limit) {
        sys->record.worst_position = fmax(sys->record.worst_position, norm);
        return pose;
    }
    remember_stuck(sys, t, psi, norm);
    return NULL;
}

const fw_multibody_pose *fw_multibody_close_position(fw_multibody_system *sys, double t,
                                                     double *u) {
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, u);
    return fw_multibody_factorise(sys, pose) ? project_position(sys, t, u) : NULL;
}

bool fw_multibody_project_velocity(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                   double *v) {
    const fw_multibody_model *m = sys->model;
    const bool driven = sys->loading.driven;
    double before = (double)INFINITY, norm = 0, size = DBL_MIN;
    double *right = sys->work->right, *drift = sys->work->drift;
    for (int i = 0; i < m->nq; i++)
        size = fmax(size, fabs(v[i]));
    if (driven) fw_multibody_drift(sys, factor->pose, drift);
    for (int i = 0; i < 6; i++) {
        fw_multibody_jacobian(m, factor->pose, v, right);
        norm = 0;
        for (int j = 0; driven && j < 2 * m->nblock; j++)
            right[j] += drift[j];
        for (int j = 0; j < 2 * m->nblock; j++)
            norm = fmax(norm, fabs(right[j]));
        if (norm <= 2 * DBL_EPSILON * size || norm > 0.25 * before) break;
        before = norm;
        m->method->correct(sys, factor->pose, right, sys->work->correction);
        move(sys, v);
    }
    sys->record.worst_velocity = fmax(sys->record.worst_velocity, norm);
    return norm < (double)INFINITY;
}

/* v of a state whose u is closed */
static const fw_multibody_factor *close_velocity(fw_multibody_system *sys,
                                                 const fw_multibody_pose *pose, double *v) {
    const fw_multibody_factor *factor = pose ? fw_multibody_factorise(sys, pose) : NULL;
    return factor && fw_multibody_project_velocity(sys, factor, v) ? factor : NULL;
}

const fw_multibody_factor *fw_multibody_project_state(fw_multibody_system *sys, double t,
                                                      double *y) {
    return close_velocity(sys, project_position(sys, t, y), y + sys->model->nq);
}

bool fw_multibody_close_state(fw_multibody_system *sys, double t, double *y) {
    return close_velocity(sys, fw_multibody_close_position(sys, t, y), y + sys->model->nq);
}

void fw_multibody_velocity_residual(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                    const double *v, double *right) {
    double *drift = sys->work->drift;
    fw_multibody_jacobian(sys->model, pose, v, right);
    fw_multibody_drift(sys, pose, drift);
    for (int i = 0; i < 2 * sys->model->nblock; i++)
        right[i] += drift[i];
}

/* an impact without rebound: v += d with M d = -G^T L, G d = -(G v + Psi_t), the least change in
   the mass metric, whatever the method corrects its steps by */
bool fw_multibody_impact(fw_multibody_system *sys, const fw_multibody_factor *factor, double *v) {
    fw_multibody_scratch *w = sys->work;
    const fw_multibody_model *m = sys->model;
    fw_multibody_velocity_residual(sys, factor->pose, v, w->right);
    memset(w->correction, 0, (size_t)m->nq * sizeof *w->correction);
    m->method->accelerate(sys, factor, w->right, w->correction, w->solution.lambda);
    move(sys, v);
    return fw_multibody_project_velocity(sys, factor, v);
}

/* The correction v += M^-1 G^T lambda onto G v = -Psi_t is found with masses and inertias a million
   times smaller where nothing is stated, thrice, each time from the velocities that were, so that
   what is stated and fits stays to 1e-18. Test: test_hard_start.c. */
bool fw_multibody_follow_stated(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const bool *stated, const double *given, double *v, double *work) {
    fw_multibody_model light = *sys->model;
    fw_multibody_chain_numbers *s = &sys->work->chain;
    double *lambda = sys->work->solution.lambda;
    int count = 0;
    for (int i = 0; i < light.nq; i++)
        count += stated[i];
    if (count == 0 || count == light.nq) return true;
    light.minv = work, light.jinv = work + light.nbody + 1;
    for (int b = 0; b <= light.nbody; b++) {
        bool ground = b == light.nbody;
        light.minv[b] = sys->model->minv[b] * (ground || stated[3 * b] ? 1 : 1e6);
        light.jinv[b] = sys->model->jinv[b] * (ground || stated[3 * b + 2] ? 1 : 1e6);
    }
    for (int pass = 0; pass < 3; pass++) {
        for (int i = 0; i < light.nq; i++)
            if (stated[i]) v[i] = given[i];
        fw_multibody_chain_assemble(&light, pose, s);
        if (!fw_multibody_chain_factor(&light.chain, s, fw_epsilon)) return false;
        fw_multibody_velocity_residual(sys, pose, v, sys->work->right);
        fw_multibody_chain_proximal(&light, pose, s, sys->work->right, lambda);
        fw_multibody_apply(&light, pose, lambda, v);
    }
    return true;
}
