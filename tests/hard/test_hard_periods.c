/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twenty thousand periods of a linkage without damping. Hard because the round-off of some
   millions of steps adds up: in the energy, in the phase, and, were it not for the projection, in
   the joints, where it would grow and not merely add. */
#include "hard.h"

/* a parallelogram with a torsion spring at one ground pin: its coupler only translates, so that the
   crank angle swings like a linear oscillator of J = 2 (J_c + m r^2) + m l^2, whatever the
   amplitude */
static rig oscillator(fw_arena *arena, double amplitude, double *omega) {
    const double l = 0.5, m = 1, k = 40;
    double angle = HARD_PI / 2, at = angle + amplitude;
    const double p[4][2] = {
        {0, 0}, {l * cos(at), l * sin(at)}, {1 + l * cos(at), l * sin(at)}, {1, 0}};
    rig r = rig_new(arena, 3, 4, 0);
    hard_bars(&r, p, 3, m);
    rig_pin(&r, "A", FW_GROUND, 0, 0, 0, k, 0);
    rig_pin(&r, "D", 2, FW_GROUND, 1, 0, 0, 0);
    r.m.pin[2].free_angle_rad = angle;
    double inertia = 2 * (m * l * l / 12 + m * l * l / 4) + m * l * l;
    *omega = sqrt(k / inertia);
    return r;
}

static void test_periods(void **state) {
    (void)state;
    long periods = hard_quick() ? 300 : 20000;
    double omega, amplitude = 0.8;
    for (int e = 9; e <= 12; e += 3) {
        fw_arena *arena = fw_arena_new(0);
        rig r = oscillator(arena, amplitude, &omega);
        r.scene.duration_s = (double)periods * 2 * HARD_PI / omega;
        const fw_dynamics_motion *m =
            hard_run(arena, &r,
                     (fw_dynamics_motion_options){
                         .rtol = pow(10, -e), .samples = 11, .most_steps = 40 * 1000 * 1000});
        double phase = 0, size = 0, couple = 0;
        for (int i = 1; i < 11; i++) {
            double u = (hard_q(m, i)[2] - HARD_PI / 2) / amplitude;
            double v = hard_v(m, i)[2] / (amplitude * omega);
            double want = remainder(omega * m->t_s[i], 2 * HARD_PI);
            phase = fmax(phase, fabs(remainder(atan2(-v, u) - want, 2 * HARD_PI)));
            size = fmax(size, fabs(hypot(u, v) - 1));
            couple = fmax(couple, fabs(hard_q(m, i)[5]));
        }
        print_message("periods: %ld at rtol 1e-%d: phase %.1e rad, amplitude %.1e, energy %.1e, "
                      "joints %.1e, their rates %.1e, coupler level to %.1e; %ld steps, %.1f s\n",
                      periods, e, phase, size, m->stats.energy_error, m->stats.max_constraint_norm,
                      m->stats.max_velocity_norm, couple, m->stats.steps, m->stats.cpu_s);
        assert_true(m->stats.max_constraint_norm < 1e-14);
        assert_true(couple < 1e-12);
        double per = pow(10, -e) * (double)periods; /* errors of a period add up */
        assert_true(m->stats.energy_error < 100 * per);
        assert_true(phase < 1000 * per);
        fw_arena_free(arena);
    }
}

/* without the projection the joints part, and the energy with them */
static void test_ablation(void **state) {
    (void)state;
    static const char *const how[3] = {"projection", "baumgarte", "none"};
    long periods = hard_quick() ? 100 : 2000;
    double omega;
    for (int k = 0; k < 3; k++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = oscillator(arena, 0.8, &omega);
        r.scene.duration_s = (double)periods * 2 * HARD_PI / omega;
        outcome out = hard_try(
            arena, &r,
            (fw_dynamics_motion_options){
                .rtol = 1e-9, .samples = 2, .stabilise = how[k], .most_steps = 1000 * 1000});
        if (out.status != FW_OK)
            print_message("periods: %ld, stabilise %-10s: %s\n", periods, how[k], out.message);
        else
            print_message("periods: %ld, stabilise %-10s: joints %.1e, energy %.1e\n", periods,
                          how[k], out.m->stats.max_constraint_norm, out.m->stats.energy_error);
        if (k == 0) assert_true(out.m->stats.max_constraint_norm < 1e-14);
        fw_arena_free(arena);
    }
}

/* the limit of steps is said in words, not met by silence */
static void test_limit(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double omega;
    rig r = oscillator(arena, 0.8, &omega);
    r.scene.duration_s = 1000 * 2 * HARD_PI / omega;
    outcome out = hard_try(
        arena, &r, (fw_dynamics_motion_options){.rtol = 1e-12, .samples = 2, .most_steps = 1000});
    assert_int_equal(out.status, FW_LIMIT);
    assert_int_equal(out.number, 108);
    print_message("periods: %s\n", out.message);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_periods),
        cmocka_unit_test(test_ablation),
        cmocka_unit_test(test_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
