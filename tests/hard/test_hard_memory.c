/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory. Hard because one allocation in a step is a leak in a million steps, and one table of all
   bodies by all bodies is the end of a mechanism of ten thousand: nothing is allocated after the
   first step, and what is allocated grows with the number of bodies. */
#include "hard.h"

/* allocations of one run; *said: a warning, whose text is allocated too, or the refusal */
static long allocations(const rig *r, fw_dynamics_motion_options o, long *steps, int *said) {
    fw_arena *arena = fw_arena_new(0);
    long before = fw_arena_count();
    outcome out = hard_try(arena, r, o);
    long count = fw_arena_count() - before;
    *said = out.number;
    *steps = out.status == FW_OK ? out.m->stats.steps : 0;
    fw_arena_free(arena);
    return count;
}

/* a run a hundred times as long allocates as often: every method, every integrator */
static void test_steps_allocate_nothing(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_six_bar(arena, false);
    for (int i = 0; i < 6; i++) { /* events too */
        r.m.pin[i].stop_min_rad = -0.1, r.m.pin[i].stop_max_rad = 0.1;
        r.m.pin[i].stop_stiffness_Nm_per_rad = 1e-4;
    }
    int said[2];
    for (int kind = 0; kind < 2; kind++)
        for (size_t i = 0;
             kind ? fw_dynamics_integrator_at(i).name : fw_multibody_method_at(i).name; i++) {
            const char *name =
                kind ? fw_dynamics_integrator_at(i).name : fw_multibody_method_at(i).name;
            fw_dynamics_motion_options o = {.rtol = 1e-5, .samples = 5, .reactions = true};
            *(kind ? &o.integrator : &o.method) = name;
            long count[2], steps[2];
            for (int k = 0; k < 2; k++) {
                r.scene.duration_s = !k ? 2e-4 : hard_quick() ? 1e-3 : 2e-2;
                count[k] = allocations(&r, o, &steps[k], &said[k]);
            }
            print_message("memory, %-23s: %ld allocations in %ld steps, %ld in %ld%s\n", name,
                          count[0], steps[0], count[1], steps[1],
                          said[1] ? ", a warning among them" : "");
            assert_int_equal(said[0], 0);
            assert_in_range(count[1] - count[0], 0, said[1] ? 4 : 0);
            if (!said[1]) assert_true(steps[1] > (hard_quick() ? 1 : 40) * steps[0]);
        }
    fw_arena_free(arena);
}

/* N-four-bar: bytes per body */
static void test_linear(void **state) {
    (void)state;
    double last = 0;
    for (int n = 10; n <= (hard_quick() ? 100 : 1000); n *= 10) {
        fw_arena *rigs = fw_arena_new(0), *arena = fw_arena_new((size_t)1 << 30);
        rig r = rig_windows(rigs, n);
        r.scene.duration_s = 0.05;
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-6, .samples = 2});
        double per = (double)fw_arena_peak(arena) / r.m.nbody;
        print_message("memory: N = %d four-bars, %d bodies: %.1f MB, %.0f bytes per body\n", n,
                      r.m.nbody, 1e-6 * (double)fw_arena_peak(arena), per);
        if (n > 100) assert_true(per < 1.5 * last);
        last = per;
        fw_arena_free(arena);
        fw_arena_free(rigs);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps_allocate_nothing),
        cmocka_unit_test(test_linear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
