/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Systems with their effects, and states for them. */
#ifndef FW_TEST_KERNEL_RIGS_H
#define FW_TEST_KERNEL_RIGS_H
#include "multibody/kernel.h"
#include "multibody/systems.h"

static inline fw_multibody_system *rig_system(fw_arena *arena, const rig *r) {
    fw_diags diags = fw_diags_new(arena);
    const fw_effect_choice choice = {0};
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(arena, fw_effects_loads);
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &choice, 1e-3, &diags, &ledger, loads), FW_OK);
    return rig_system_with(arena, &r->m, loads, r->scene.duration_s, NULL);
}

static inline const fw_multibody_model *rig_model(fw_arena *arena, const rig *r) {
    return rig_system(arena, r)->model;
}

/* any state: the equations hold whether the joints are closed or not */
static inline double *rig_state(fw_arena *arena, const fw_multibody_model *m, double size,
                                uint64_t seed) {
    double *y = fw_arena_array(arena, double, (size_t)m->ny);
    for (int i = 0; i < m->ny; i++)
        y[i] = size * (rig_random(&seed) - 0.5);
    return y;
}

/* f of the general code, whatever kernel the system has */
static inline void rig_general(fw_multibody_system *sys, const double *y, double *f) {
    struct fw_multibody_kernel *kernel = sys->kernel;
    sys->kernel = NULL;
    fw_multibody_rhs(sys, 0, y, f);
    sys->kernel = kernel;
}

static inline double rig_largest(const double *a, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i]));
    return most;
}

#endif
