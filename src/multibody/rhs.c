/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Accelerations, of every state that an integrator asks for and of every step that it accepts, and
   the forces of the joints that go with them. */
#include "multibody/friction.h"
#include "multibody/kernel.h"
#include "multibody/multibody_scratch.h"
#include "multibody/system.h"
#include <math.h>
#include <string.h>

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
static bool evaluate_factored(fw_multibody_system *sys, const fw_multibody_factor *factor,
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
    if (factor) return evaluate_factored(sys, factor, y, energies, f);
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

/* ---- an accepted step ---- */

/* without projection the norms are only watched */
static void monitor(fw_multibody_system *sys, double t, const double *y) {
    fw_multibody_record *record = &sys->record;
    const fw_multibody_pose *pose = fw_multibody_pose_at(sys, t, y);
    double *right = sys->work->right;
    record->worst_position = fmax(record->worst_position, fw_multibody_residual(sys, pose, NULL));
    fw_multibody_velocity_residual(sys, pose, y + sys->model->nq, right);
    for (int i = 0; i < 2 * sys->model->nblock; i++)
        record->worst_velocity = fmax(record->worst_velocity, fabs(right[i]));
}

/* the kernel's own projection */
static bool project_plain(fw_multibody_system *sys, double *y, double *f) {
    if (!fw_multibody_kernel_project(sys->kernel, y, f)) return false;
    fw_multibody_kernel_norms norms = fw_multibody_kernel_norms_of(sys->kernel);
    sys->record.worst_position = fmax(sys->record.worst_position, norms.position);
    sys->record.worst_velocity = fmax(sys->record.worst_velocity, norms.velocity);
    return true;
}

/* an accepted step: q onto Psi = 0, then v onto G v = -Psi_t with the factor at the new pose, which
   the evaluation of f uses again */
bool fw_multibody_project(void *system, double t, double *y, double *f) {
    fw_multibody_system *sys = system;
    fw_multibody_record *record = &sys->record;
    if (!sys->projecting) {
        monitor(sys, t, y);
        return fw_multibody_evaluate(sys, t, y, true, f);
    }
    record->projections++;
    if (sys->kernel) return project_plain(sys, y, f);
    double worst = record->worst_position, worst_velocity = record->worst_velocity;
    const fw_multibody_factor *factor = fw_multibody_project_state(sys, t, y);
    if (!factor) { /* a rejected step does not count */
        record->worst_position = worst, record->worst_velocity = worst_velocity;
        return false;
    }
    if (sys->friction) fw_multibody_friction_settle(sys, factor, y + sys->model->nq);
    evaluate_factored(sys, factor, y, true, f);
    return true;
}

/* ---- forces of the joints ---- */

/* Forces of the joints from the multipliers of a solution. */

/* force of every pin on its body b, world axes: its multipliers, or what the element that stands
   for the pin does to the body of its last port */
void fw_multibody_pin_forces(const fw_multibody_model *m, const fw_multibody_solution *found,
                             double *out) {
    double unit = fw_multibody_newton(m);
    for (int i = 0; i < m->npin; i++) {
        int block = m->pin_block[i], element = m->pin_element[i];
        for (int k = 0; k < 2; k++)
            out[2 * i + k] = block != FW_NONE ? unit * found->lambda[2 * block + k] : 0;
        if (element == FW_NONE) continue;
        const fw_multibody_element *e = &m->element[element];
        for (int k = 0; k < 2; k++)
            out[2 * i + k] += found->element[3 * (e->first_port + e->own->ports - 1) + k];
    }
}

/* -G_b^T lambda of one block, as force and torque about its point b. Where b is the ground, which
   has no rows, the opposite of what a gets: G_a^T lambda, its torque moved from a's centre of mass
   by the arm of a and d to point b. */
static void add_block_force(const fw_multibody_model *m, const fw_multibody_solution *found,
                            int block, double *out) {
    const fw_multibody_pose *pose = found->pose;
    bool ground = m->body[2 * block + 1] == m->nbody;
    const double *g = pose->jac + 12 * block + (ground ? 0 : 6), *l = found->lambda + 2 * block;
    const double *r = pose->arm + 4 * block + (ground ? 0 : 2);
    double d[2] = {0}, e[2], n[2], sign = ground ? 1 : -1, force = fw_multibody_newton(m);
    if (ground) fw_multibody_frame(m, pose, block, d, e, n);
    double fx = sign * (g[0] * l[0] + g[3] * l[1]), fy = sign * (g[1] * l[0] + g[4] * l[1]);
    double turn = sign * (g[2] * l[0] + g[5] * l[1]);
    out[0] += force * fx;
    out[1] += force * fy;
    out[2] += force * m->scale.length_m * (turn - (r[0] + d[0]) * fy + (r[1] + d[1]) * fx);
}

void fw_multibody_joint_forces(const fw_multibody_model *m, const fw_multibody_solution *found,
                               const fw_mechanism *mechanism, double *joint, double *driver) {
    for (int i = 0; i < m->njoint; i++) {
        int block = m->joint_block[i];
        joint[3 * i] = joint[3 * i + 1] = joint[3 * i + 2] = 0;
        add_block_force(m, found, block, joint + 3 * i);
        for (int k = 0; k < m->nblock && mechanism->joint[i].kind == FW_JOINT_WELD; k++)
            if (m->block[k].joint == i && k != block) add_block_force(m, found, k, joint + 3 * i);
    }
    for (int i = 0; i < m->ndriver; i++) {
        const fw_multibody_block *b = &m->block[m->driver_block[i]];
        double unit = fw_multibody_newton(m) * (b->rows == FW_ROWS_TURN ? m->scale.length_m : 1);
        driver[i] = -unit * found->lambda[2 * m->driver_block[i]];
    }
}
