/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pendulum released level (IFToMM A01) for 2000 s. Hard because 845 periods let errors of phase
   and of energy add up, and because it is written with x, y, phi and two constraints, so that the
   length of the rod must be kept to round-off all the time. */
#include "hard.h"

static const double reference[][5] = {
    /* t, x, y, vx, vy: elliptic functions, 22 digits */
    {100, -0.1815133514270313845424, -0.9833884803340575046828, 4.319536780534662456265,
     -0.797297927855360446968},
    {500, -0.7545596642427438165805, -0.6562314478123383249927, 2.354697157962729590976,
     -2.707519584483244698209},
    {1000, 0.6832301885523148554574, -0.7302030604227623275486, 2.763853217052379217833,
     2.586058669110933151661},
    {1500, 0.999992738419629687804, -0.003810919575387929569958, 0.001042063482475587529382,
     0.2734394927087337708175},
    {2000, 0.8146030685890321521218, -0.5800188278369354615919, -1.95664770788265787019,
     -2.747999117430392282023},
};

static void test_2000_s(void **state) {
    (void)state;
    static const int row[5] = {1, 5, 10, 15, 20};
    double error[5];
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_pendulum(arena);
    r.scene.duration_s = hard_quick() ? 100 : 2000;
    const fw_dynamics_motion *m = hard_run(
        arena, &r, (fw_dynamics_motion_options){.rtol = 1e-13, .samples = hard_quick() ? 2 : 21});
    int last = hard_quick() ? 0 : 4;
    for (int i = 0; i <= last; i++) { /* the bob of the reference is twice as far out */
        const double *q = hard_q(m, row[i]), *v = hard_v(m, row[i]), *want = reference[i] + 1;
        error[i] = fmax(fmax(fabs(2 * q[0] - want[0]), fabs(2 * q[1] - want[1])),
                        fmax(fabs(2 * v[0] - want[2]), fabs(2 * v[1] - want[3])));
    }
    print_message("pendulum, rtol 1e-13: state to %.1e at 100 s, %.1e at %g s; %ld steps, energy "
                  "%.1e, constraint %.1e\n",
                  error[0], error[last], r.scene.duration_s, m->stats.steps, m->stats.energy_error,
                  m->stats.max_constraint_norm);
    assert_true(error[0] < 1e-9);
    assert_true(error[last] < 2e-8);
    assert_true(m->stats.energy_error < 1e-11);
    fw_arena_free(arena);
}

/* 10 s: 1e-12 of the energy is wanted; without the projection it drifts */
static void test_10_s(void **state) {
    (void)state;
    static const char *const how[3] = {"projection", "baumgarte", "none"};
    double energy[3];
    for (int i = 0; i < 3; i++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_pendulum(arena);
        const fw_dynamics_motion *m = hard_run(
            arena, &r,
            (fw_dynamics_motion_options){.rtol = 1e-13, .samples = 11, .stabilise = how[i]});
        energy[i] = m->stats.energy_error;
        double x = 2 * hard_q(m, 10)[0];
        print_message("pendulum 10 s, stabilise %-10s: energy %.1e, x to %.1e, constraint %.1e, "
                      "velocity %.1e\n",
                      how[i], energy[i], fabs(x + 0.2750874625761168600544),
                      m->stats.max_constraint_norm, m->stats.max_velocity_norm);
        if (i == 0) {
            assert_near(x, -0.2750874625761168600544, 1e-11);
            assert_true(m->stats.max_constraint_norm < 1e-15);
        }
        fw_arena_free(arena);
    }
    assert_true(energy[0] < 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_10_s),
        cmocka_unit_test(test_2000_s),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
