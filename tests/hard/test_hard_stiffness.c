/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two hinges a million times stiffer than the rest. Hard because the slow motion that is wanted
   lasts a thousand times longer than the fast oscillation that limits explicit steps; an implicit
   method may pass over it, but must not change the answer. */
#include "hard.h"

enum { ROWS = 11 };
static const double mm = 1e-3;

static rig stiff(fw_arena *arena, double factor) {
    rig r = rig_six_bar(arena, false);
    r.m.pin[1].stiffness_Nm_per_rad *= factor;
    r.m.pin[3].stiffness_Nm_per_rad *= factor;
    /* the same damping ratio */
    r.m.pin[1].damping_Nms_per_rad *= sqrt(factor);
    r.m.pin[3].damping_Nms_per_rad *= sqrt(factor);
    return r;
}

static double apart(const fw_dynamics_motion *a, const fw_dynamics_motion *b) {
    double worst = 0;
    for (int i = 0; i < ROWS * 15; i++)
        worst = fmax(worst, fabs(a->q[i] - b->q[i]) / (i % 3 == 2 ? 1 : mm));
    return worst;
}

static void test_two_stiff_hinges(void **state) {
    (void)state;
    static const char *const name[] = {"dop853", "radau5", "dopri5", "generalised-alpha", "auto"};
    double factor = hard_quick() ? 1e4 : 1e6;
    fw_arena *arena = fw_arena_new(0);
    rig r = stiff(arena, factor);
    const fw_dynamics_motion *fine = hard_run(
        arena, &r,
        (fw_dynamics_motion_options){.rtol = 1e-11, .samples = ROWS, .integrator = "dop853"});
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        if (strcmp(name[i], "auto") != 0 && !fw_maths_stepper_find(name[i])) continue;
        double rtol = strcmp(name[i], "generalised-alpha") == 0 ? 1e-4 : 1e-8;
        outcome out = hard_try(
            arena, &r,
            (fw_dynamics_motion_options){.rtol = rtol, .samples = ROWS, .integrator = name[i]});
        if (out.status != FW_OK) {
            print_message("stiffness ratio %.0e, %s: %s\n", factor, name[i], out.message);
            fail_msg("%s", name[i]);
        }
        const fw_dynamics_motion_stats *s = &out.m->stats;
        double error = apart(out.m, fine);
        print_message("stiffness ratio %.0e, %-17s (%s) rtol %.0e: off by %.1e, %ld steps, %ld "
                      "evaluations, %ld factorisations, %.0f ms, energy %.1e\n",
                      factor, name[i], out.m->integrator, s->rtol, error, s->steps, s->rhs,
                      s->factorisations, 1e3 * s->cpu_s, s->energy_error);
        if (rtol < 1e-6) assert_true(error < 1e-5);
    }
    fw_arena_free(arena);
}

/* as stiff as can be is welded: the difference falls with the stiffness */
static void test_limit_is_a_weld(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig w = rig_six_bar(arena, false);
    hard_tie_at(arena, &w, "B", FW_JOINT_WELD, 0, 1, 0.20 * mm, 1.40 * mm);
    hard_tie_at(arena, &w, "D", FW_JOINT_WELD, 2, 3, 2.20 * mm, 2.75 * mm);
    w.scene.duration_s = 2e-3;
    const fw_dynamics_motion *welded =
        hard_run(arena, &w, (fw_dynamics_motion_options){.rtol = 1e-11, .samples = ROWS});
    for (double factor = 1e2; factor <= (hard_quick() ? 1e4 : 1e6); factor *= 100) {
        rig r = stiff(arena, factor);
        r.scene.duration_s = 2e-3;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-10, .samples = ROWS});
        double off = apart(m, welded);
        print_message("stiffness ratio %.0e: %.1e off a weld, by %s, %ld steps\n", factor, off,
                      m->integrator, m->stats.steps);
        assert_true(off < 20 / factor);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_stiff_hinges),
        cmocka_unit_test(test_limit_is_a_weld),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
