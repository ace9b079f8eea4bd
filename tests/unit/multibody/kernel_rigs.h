/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models with their effects, and states for them. */
#ifndef FW_TEST_KERNEL_RIGS_H
#define FW_TEST_KERNEL_RIGS_H
#include "multibody/kernel.h"
#include "dynamics/models.h"

static inline fw_multibody_model *rig_model(fw_arena *arena, const rig *r) {
    fw_diags diags = fw_diags_new(arena);
    const fw_effect_choice choice = {0};
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(arena, fw_effects_loads);
    fw_multibody_model *m = NULL;
    double *q = fw_arena_array(arena, double, 3 * (size_t)r->m.nbody);
    for (int b = 0; b < r->m.nbody; b++) {
        q[3 * b] = r->m.body[b].x_m;
        q[3 * b + 1] = r->m.body[b].y_m;
        q[3 * b + 2] = r->m.body[b].phi_rad;
    }
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &choice, 1e-3, &diags, &ledger, loads), FW_OK);
    assert_int_equal(
        fw_multibody_model_new(arena, &r->m, loads, q, r->scene.duration_s, NULL, &diags, &m),
        FW_OK);
    return m;
}

/* any state: the equations hold whether the joints are closed or not */
static inline double *rig_state(fw_arena *arena, const fw_multibody_model *m, double size,
                                uint64_t seed) {
    double *y = fw_arena_array(arena, double, (size_t)m->ny);
    for (int i = 0; i < m->ny; i++)
        y[i] = size * (rig_random(&seed) - 0.5);
    return y;
}

/* f of the general code, whatever kernel the model has */
static inline void rig_general(fw_multibody_model *m, const double *y, double *f) {
    struct fw_multibody_kernel *kernel = m->kernel;
    m->kernel = NULL;
    fw_multibody_model_rhs(m, 0, y, f);
    m->kernel = kernel;
}

static inline double rig_largest(const double *a, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i]));
    return most;
}

#endif
