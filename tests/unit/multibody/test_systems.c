/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two systems of one const model: stepped in turns they give the same bytes as each alone, whatever
   the method, and the model is as it was. */
#include "maths/ode.h"
#include "multibody/kernel_rigs.h"

enum { STEPS = 12, MOST = 128 };

typedef struct motion {
    fw_maths_stepper *stepper;
    const fw_multibody_system *sys;
} motion;

/* starts at rest or with the velocities of `seed` on the constraints */
static motion motion_of(fw_arena *arena, const rig *r, const fw_multibody_model *m, uint64_t seed) {
    motion out;
    fw_multibody_system *sys = rig_system_of(arena, &r->m, m);
    const fw_maths_ode ode = {.context = sys,
                              .rhs = fw_multibody_rhs,
                              .project = fw_multibody_project,
                              .n = m->ny,
                              .controlled = 2 * m->nq,
                              .positions = m->nq};
    double *atol = fw_arena_array(arena, double, (size_t)m->ny);
    double *y = fw_arena_array(arena, double, (size_t)m->ny);
    for (int i = 0; i < m->ny; i++)
        atol[i] = 1e-9;
    for (int i = 0; i < m->nq; i++)
        y[m->nq + i] = 0.3 * (rig_random(&seed) - 0.5);
    sys->piece_s = r->scene.duration_s / 2;
    assert_true(fw_multibody_close_state(sys, 0, y));
    fw_multibody_set_switches(sys, 0, y);
    fw_multibody_friction_begin(sys);
    assert_true(fw_multibody_friction_decide(sys, 0, y));
    assert_int_equal(fw_maths_stepper_new(arena, fw_maths_stepper_find("dop853"), &ode, 1e-9, atol,
                                          &out.stepper),
                     FW_OK);
    fw_maths_stepper_start(out.stepper, 0, y, 1e3);
    out.sys = sys;
    return out;
}

static void step(motion *m) {
    assert_int_equal(fw_maths_stepper_step(m->stepper), FW_ODE_STEP);
}

static void same(const motion *a, const motion *b) {
    const size_t bytes = (size_t)a->sys->model->ny * sizeof(double);
    assert_true(a->stepper->t == b->stepper->t);
    assert_memory_equal(a->stepper->y, b->stepper->y, bytes);
    assert_memory_equal(a->stepper->f, b->stepper->f, bytes);
    assert_memory_equal(&a->sys->record, &b->sys->record, sizeof a->sys->record);
}

/* bytes of what an evaluation could write to by mistake */
static void copy(const fw_multibody_model *m, double *to) {
    memcpy(to, m->offset, 2 * (size_t)m->nblock * sizeof *to), to += 2 * m->nblock;
    memcpy(to, m->constant, (size_t)m->nq * sizeof *to), to += m->nq;
    memcpy(to, m->minv, (size_t)m->nbody * sizeof *to), to += m->nbody;
    memcpy(to, m->chain.isotropic, 2 * (size_t)m->nblock * sizeof *to);
}

static void in_turns(const rig *r, const char *method) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_effect_choice all = {.mode = FW_EFFECTS_ALL};
    fw_effect_ledger ledger;
    fw_effects_loads loads;
    assert_int_equal(
        fw_effects_compile(arena, &r->m, &r->scene, &all, 1e-3, &diags, &ledger, &loads), FW_OK);
    const fw_multibody_model *m =
        rig_model_with(arena, &r->m, &loads, r->scene.duration_s, fw_multibody_method_find(method));
    const fw_multibody_model before = *m;
    double numbers[2][MOST] = {{0}};
    copy(m, numbers[0]);
    motion alone[2], turns[2];
    for (int i = 0; i < 2; i++) {
        alone[i] = motion_of(arena, r, m, (uint64_t)i + 3);
        for (int k = 0; k < STEPS; k++)
            step(&alone[i]);
    }
    for (int i = 0; i < 2; i++)
        turns[i] = motion_of(arena, r, m, (uint64_t)i + 3);
    for (int k = 0; k < 2 * STEPS; k++)
        step(&turns[k % 2]);
    for (int i = 0; i < 2; i++)
        same(&alone[i], &turns[i]);
    assert_true(memcmp(alone[0].stepper->y, alone[1].stepper->y, sizeof(double)) != 0);
    copy(m, numbers[1]);
    assert_memory_equal(numbers[0], numbers[1], sizeof numbers[0]);
    assert_memory_equal(&before, m, sizeof before);
    for (int i = 0; i < 2; i++)
        fw_maths_stepper_free(alone[i].stepper), fw_maths_stepper_free(turns[i].stepper);
    fw_arena_free(arena);
}

static void two_systems_of_one_model(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig plain = rig_six_bar(arena, false), rubs = rig_six_bar(arena, false);
    rubs.scene.friction = fw_arena_array(arena, fw_device_friction_use, 2);
    for (int i = 0; i < 2; i++)
        rubs.scene.friction[rubs.scene.nfriction++] =
            (fw_device_friction_use){.revolute = 2 * i,
                                     .joint = FW_NONE,
                                     .coefficient = 0.2,
                                     .static_coefficient = 0.3,
                                     .radius_m = 1e-5,
                                     .preload_N = 1e-4};
    for (size_t k = 0; fw_multibody_method_at(k).name; k++) {
        in_turns(&plain, fw_multibody_method_at(k).name);
        in_turns(&rubs, fw_multibody_method_at(k).name);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_systems_of_one_model)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
