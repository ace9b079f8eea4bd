/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Systems of mechanisms built by hand, at the poses that their bodies have. */
#ifndef FW_TEST_SYSTEMS_H
#define FW_TEST_SYSTEMS_H
#include "dynamics/models.h"
#include "multibody/multibody_scratch.h"

static inline const fw_multibody_model *rig_model_with(fw_arena *arena, const fw_mechanism *m,
                                                       const fw_effects_loads *loads,
                                                       double duration_s,
                                                       const fw_multibody_method *method) {
    const fw_multibody_model *model;
    double *q = fw_arena_array(arena, double, 3 * (size_t)m->nbody);
    for (int b = 0; b < m->nbody; b++) {
        const fw_mechanism_mass *p = &m->body[b];
        q[3 * b] = p->x_m, q[3 * b + 1] = p->y_m, q[3 * b + 2] = p->phi_rad;
    }
    assert_int_equal(fw_multibody_model_new(arena, m, loads, q, duration_s, method, &model), FW_OK);
    return model;
}

static inline fw_multibody_system *rig_system_of(fw_arena *arena, const fw_mechanism *m,
                                                 const fw_multibody_model *model) {
    fw_multibody_system *sys;
    fw_diags diags = fw_diags_new(arena);
    assert_int_equal(fw_multibody_system_new(arena, model, m, &diags, &sys), FW_OK);
    return sys;
}

static inline fw_multibody_system *rig_system_with(fw_arena *arena, const fw_mechanism *m,
                                                   const fw_effects_loads *loads, double duration_s,
                                                   const fw_multibody_method *method) {
    return rig_system_of(arena, m, rig_model_with(arena, m, loads, duration_s, method));
}

/* force += G^T lambda, from M^-1 G^T lambda */
static inline void rig_transpose(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 const double *lambda, double *force) {
    double a[512] = {0};
    assert_true(m->nq <= 512);
    fw_multibody_apply(m, pose, lambda, a);
    for (int i = 0; i < m->nq; i++)
        force[i] -= (i % 3 == 2 ? m->inertia : m->mass)[i / 3] * a[i];
}

#endif
