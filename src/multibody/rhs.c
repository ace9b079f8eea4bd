/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multibody/friction.h"
#include "multibody/kernel.h"
#include "multibody/multibody_scratch.h"
#include <math.h>
#include <string.h>

const fw_multibody_factor *fw_multibody_factorise(fw_multibody_system *sys,
                                                  const fw_multibody_pose *pose) {
    return sys->model->method->factor(sys, pose) ? &sys->work->factor : NULL;
}

/* gamma + 2 alpha (G v + Psi_t) + alpha^2 Psi: the drift of a free run dies away. Source:
   Baumgarte 1972 */
static void baumgarte(fw_multibody_system *sys, const fw_multibody_pose *pose, const double *v,
                      double *gamma) {
    double alpha = sys->baumgarte, *more = sys->work->more, *drift = sys->work->drift;
    int n = 2 * sys->model->nblock;
    fw_multibody_jacobian(sys->model, pose, v, more);
    fw_multibody_drift(sys, pose, drift);
    for (int i = 0; i < n; i++)
        gamma[i] += 2 * alpha * (more[i] + drift[i]);
    fw_multibody_residual(sys, pose, more);
    for (int i = 0; i < n; i++)
        gamma[i] += alpha * alpha * more[i];
}

const fw_multibody_solution *fw_multibody_accelerate(fw_multibody_system *sys,
                                                     const fw_multibody_factor *factor,
                                                     const double *v) {
    const fw_multibody_pose *pose = factor->pose;
    const fw_multibody_solution *found = fw_multibody_forces(sys, pose, v);
    double *gamma = sys->work->right;
    fw_multibody_gamma(sys, pose, v, gamma);
    if (sys->baumgarte > 0) baumgarte(sys, pose, v, gamma);
    sys->model->method->accelerate(sys, factor, gamma, found->accel, found->lambda);
    return found;
}

/* rates of the dissipated energy and of the work of drivers and timed loads; friction takes
   `lost` */
static void energy_rates(fw_multibody_system *sys, const fw_multibody_solution *found,
                         const double *v, double lost, double *f) {
    const fw_multibody_model *m = sys->model;
    double power[2], *drift = sys->work->drift;
    fw_multibody_power(sys, found->pose, v, power);
    power[0] += lost;
    if (sys->loading.driven) {
        fw_multibody_drift(sys, found->pose, drift);
        for (int i = 0; i < 2 * m->nblock; i++)
            power[1] += found->lambda[i] * drift[i];
    }
    if (m->dissipated >= 0) f[m->dissipated] = power[0];
    if (m->worked >= 0) f[m->worked] = power[1];
}

/* f = (v, a, power) with M a + G^T lambda = Q, G a = -gamma, gamma = G' v + Psi_tt. Inputs: state
   y, the factor at its u. Output f (ny). Error: round-off times cond(S). Cost: the method's.
   Source: Lagrange multipliers in index-1 form; Garcia de Jalon and Bayo 1994, ch. 5. Test:
   test_simulate.c (reference six-bar). */
bool fw_multibody_evaluate_factored(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                    const double *y, bool energies, double *f) {
    const fw_multibody_model *m = sys->model;
    const double *v = y + m->nq;
    const fw_multibody_solution *found = fw_multibody_accelerate(sys, factor, v);
    double lost = 0;
    bool good = !sys->friction || fw_multibody_friction_apply(sys, factor, v, &lost);
    for (int i = 0; i < m->nq; i++) {
        f[i] = v[i];
        f[m->nq + i] = good ? found->accel[i] : (double)NAN;
    }
    if (m->ny > 2 * m->nq && energies) energy_rates(sys, found, v, lost, f);
    return good;
}

/* methods that integrate independent coordinates see the closed state that belongs to them */
static const fw_multibody_factor *close_stage(fw_multibody_system *sys, double t, const double *y,
                                              double *stage) {
    const fw_multibody_model *m = sys->model;
    memcpy(stage, y, (size_t)m->ny * sizeof *y);
    const fw_multibody_pose *pose = m->method->close(sys, t, stage);
    const fw_multibody_factor *factor = pose ? fw_multibody_factorise(sys, pose) : NULL;
    return factor && fw_multibody_project_velocity(sys, factor, stage + m->nq) ? factor : NULL;
}

bool fw_multibody_evaluate(fw_multibody_system *sys, double t, const double *y, bool energies,
                           double *f) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_factor *factor;
    if (sys->kernel && sys->baumgarte == 0) {
        fw_multibody_kernel_rhs(sys->kernel, y, f);
        return true; /* where there are none its accelerations are NaN */
    }
    if (m->method->closes_stages) {
        factor = close_stage(sys, t, y, sys->work->stage);
        y = sys->work->stage;
    } else {
        factor = fw_multibody_factorise(sys, fw_multibody_pose_at(sys, t, y));
    }
    if (factor) return fw_multibody_evaluate_factored(sys, factor, y, energies, f);
    memcpy(f, y + m->nq, (size_t)m->nq * sizeof *f);
    for (int i = m->nq; i < (energies ? m->ny : 2 * m->nq); i++)
        f[i] = (double)NAN;
    return false;
}

void fw_multibody_rhs(void *system, double t, const double *y, double *f) {
    fw_multibody_evaluate(system, t, y, true, f);
}

void fw_multibody_rhs_motion(void *system, double t, const double *y, double *f) {
    fw_multibody_evaluate(system, t, y, false, f);
}

const fw_multibody_solution *fw_multibody_react(fw_multibody_system *sys, double t, const double *y,
                                                double *f) {
    fw_multibody_solution *found = &sys->work->solution;
    fw_multibody_evaluate(sys, t, y, false, f);
    if (sys->kernel && sys->baumgarte == 0)
        memcpy(found->lambda, fw_multibody_kernel_lambda(sys->kernel),
               2 * (size_t)sys->model->nblock * sizeof(double));
    return found;
}
