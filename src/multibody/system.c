/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new system of a model: loads and flags as the model has them, and memory. */
#include "multibody/multibody_scratch.h"
#include <math.h>
#include <string.h>

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
    size_t ports = (size_t)m->most_ports;
    if (m->nelement == 0) return FW_OK;
    FW_NEED(k->p = fw_arena_array(arena, double, 3 * ports));
    FW_NEED(k->w = fw_arena_array(arena, double, 3 * ports));
    FW_NEED(k->arm = fw_arena_array(arena, double, 2 * ports));
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
