/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A system of a model: loads and flags as the model has them, its states brought onto the constraints, and the
   accelerations of every state that an integrator asks for and of every step that it accepts. */
#include "multibody/system.h"
#include "multibody/kernel.h"
#include "multibody/multibody_scratch.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- the methods that can be asked for by name ---- */

#define FW_MULTIBODY_METHOD(name) extern const fw_multibody_method fw_multibody_method_##name;
#include "multibody/methods.def"
#undef FW_MULTIBODY_METHOD
#define FW_MULTIBODY_METHOD(name) &fw_multibody_method_##name,
static const fw_multibody_method *const methods[] = {
#include "multibody/methods.def"
};
#undef FW_MULTIBODY_METHOD
enum { METHODS = sizeof methods / sizeof methods[0] };

const fw_multibody_method *fw_multibody_method_find(const char *name) {
    if (!name) return methods[0];
    for (size_t i = 0; i < METHODS; i++)
        if (strcmp(methods[i]->name, name) == 0) return methods[i];
    return NULL;
}

fw_multibody_method_row fw_multibody_method_at(size_t i) {
    return i < METHODS ? (fw_multibody_method_row){methods[i]->name, methods[i]->summary}
                       : (fw_multibody_method_row){NULL, NULL};
}

/* ---- a new system ---- */

static fw_status loading_new(fw_arena *arena, const fw_multibody_model *m,
                             fw_multibody_loading *l) {
    size_t n = 3 * ((size_t)m->nbody + 1);
    *l = (fw_multibody_loading){
        .driven = m->driven, .actuation = 1, .drive = 1, .actuation_rate = 1, .drive_rate = 1};
    FW_NEED(l->constant = fw_arena_array(arena, double, n));
    FW_NEED(l->force = fw_arena_array(arena, double, 2 * (size_t)m->nload));
    FW_NEED(l->value = fw_arena_array(arena, double, (size_t)m->nblock));
    memcpy(l->constant, m->constant, n * sizeof *l->constant);
    for (int i = 0; i < m->nload; i++)
        l->force[2 * i] = m->load[i].fx, l->force[2 * i + 1] = m->load[i].fy;
    for (int i = 0; i < m->nblock; i++)
        l->value[i] = m->block[i].value;
    return FW_OK;
}

static fw_status flags_new(fw_arena *arena, const fw_multibody_model *m, fw_multibody_flags *on) {
    FW_NEED(on->stop = fw_arena_array(arena, bool, (size_t)m->nstop));
    FW_NEED(on->spring = fw_arena_array(arena, bool, (size_t)m->nspring));
    FW_NEED(on->element = fw_arena_array(arena, bool, (size_t)m->nswitch));
    for (int i = 0; i < m->nspring; i++)
        on->spring[i] = !m->spring[i].cable;
    return FW_OK;
}

static fw_status pose_new(fw_arena *arena, const fw_multibody_model *m, fw_multibody_scratch *w) {
    size_t n = (size_t)m->nbody + 1, p = (size_t)m->nblock;
    FW_NEED(w->cosine = fw_arena_array(arena, double, n));
    FW_NEED(w->sine = fw_arena_array(arena, double, n));
    FW_NEED(w->arm = fw_arena_array(arena, double, 4 * p));
    FW_NEED(w->jac = fw_arena_array(arena, double, 12 * p));
    w->cosine[m->nbody] = 1;
    w->pose = (fw_multibody_pose){.cosine = w->cosine,
                                  .sine = w->sine,
                                  .arm = w->arm,
                                  .jac = w->jac,
                                  .ground = w->ground,
                                  .offset = m->offset,
                                  .spring_end = m->spring_end};
    if (!m->stretch.law) return FW_OK;
    FW_NEED(w->offset = fw_arena_array(arena, double, 2 * p));
    FW_NEED(w->spring_end = fw_arena_array(arena, double, 4 * (size_t)m->nspring));
    w->pose.offset = w->offset, w->pose.spring_end = w->spring_end;
    w->ground_t = (double)NAN;
    return FW_OK;
}

static fw_status ports_new(fw_arena *arena, const fw_multibody_model *m, fw_multibody_ports *k) {
    size_t ports = (size_t)m->most_ports, all = (size_t)m->nport;
    if (m->nelement == 0) return FW_OK;
    FW_NEED(k->p = fw_arena_array(arena, double, 3 * all));
    FW_NEED(k->w = fw_arena_array(arena, double, 3 * all));
    FW_NEED(k->arm = fw_arena_array(arena, double, 2 * all));
    FW_NEED(k->seen = fw_arena_array(arena, fw_effects_port_state, (size_t)m->nelement));
    FW_NEED(k->f = fw_arena_array(arena, double, 3 * ports));
    FW_NEED(k->stiffness = fw_arena_array(arena, double, 9 * ports * ports));
    FW_NEED(k->damping = fw_arena_array(arena, double, 9 * ports * ports));
    FW_NEED(k->pose = fw_arena_array(arena, double, (size_t)m->nq));
    return FW_OK;
}

static fw_status scratch_new(fw_arena *arena, const fw_multibody_model *m,
                             fw_multibody_scratch *w) {
    size_t n = (size_t)m->nbody + 1, p = (size_t)m->nblock;
    FW_TRY(pose_new(arena, m, w));
    FW_TRY(ports_new(arena, m, &w->port));
    FW_TRY(fw_multibody_chain_numbers_new(arena, m, &w->chain));
    w->epsilon = fw_epsilon;
    w->solution.pose = w->factor.pose = &w->pose;
    FW_NEED(w->solution.accel = fw_arena_array(arena, double, 3 * n));
    FW_NEED(w->solution.lambda = fw_arena_array(arena, double, 2 * p));
    FW_NEED(w->solution.element = fw_arena_array(arena, double, 3 * (size_t)m->nport));
    FW_NEED(w->right = fw_arena_array(arena, double, 2 * p));
    FW_NEED(w->more = fw_arena_array(arena, double, 2 * p));
    FW_NEED(w->drift = fw_arena_array(arena, double, 2 * p));
    FW_NEED(w->correction = fw_arena_array(arena, double, 3 * n));
    FW_NEED(w->stage = fw_arena_array(arena, double, (size_t)m->ny));
    return FW_OK;
}

fw_status fw_multibody_system_new(fw_arena *arena, const fw_multibody_model *model,
                                  const fw_mechanism *mechanism, fw_diags *diags,
                                  fw_multibody_system **system) {
    fw_multibody_system *sys = fw_arena_one(arena, fw_multibody_system);
    FW_NEED(sys);
    *sys = (fw_multibody_system){.model = model, .projecting = true, .record.stuck = -1};
    FW_TRY(loading_new(arena, model, &sys->loading));
    FW_TRY(flags_new(arena, model, &sys->on));
    FW_NEED(sys->work = fw_arena_one(arena, fw_multibody_scratch));
    FW_TRY(scratch_new(arena, model, sys->work));
    FW_TRY(fw_multibody_friction_new(arena, sys));
    if (model->method->prepare) FW_TRY(model->method->prepare(arena, sys, mechanism, diags));
    *system = sys;
    return FW_OK;
}

/* ---- positions onto Psi(q, t) = 0 and velocities onto G v = -Psi_t ---- */

/* scaled: what every accepted state satisfies; of a mechanism of thousands of lengths its round-off */
static double position_limit(const fw_multibody_model *m) {
    return fmax(1e-12, 8 * DBL_EPSILON * m->size);
}

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
    return norm <= position_limit(sys->model) ? pose : NULL;
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
    const double round_off = fmin(1e-13 * m->size, position_limit(m));
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
    if (norm <= position_limit(m)) {
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

/* the state onto Psi = 0 and G v = -Psi_t with the factor at hand, and the factor there;
   NULL: it does not get there */
static const fw_multibody_factor *project_state(fw_multibody_system *sys, double t, double *y) {
    return close_velocity(sys, project_position(sys, t, y), y + sys->model->nq);
}

bool fw_multibody_close_state(fw_multibody_system *sys, double t, double *y) {
    return close_velocity(sys, fw_multibody_close_position(sys, t, y), y + sys->model->nq);
}

/* right = G v + Psi_t, by how much velocities miss the constraints */
static void velocity_residual(const fw_multibody_system *sys, const fw_multibody_pose *pose,
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
    velocity_residual(sys, factor->pose, v, w->right);
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
        velocity_residual(sys, pose, v, sys->work->right);
        fw_multibody_chain_proximal(&light, pose, s, sys->work->right, lambda);
        fw_multibody_apply(&light, pose, lambda, v);
    }
    return true;
}

/* ---- accelerations, and the forces of the joints that go with them ---- */

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
    velocity_residual(sys, pose, y + sys->model->nq, right);
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
    const fw_multibody_factor *factor = project_state(sys, t, y);
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
