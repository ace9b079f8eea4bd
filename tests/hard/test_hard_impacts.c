/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stops hit hard and often, cables that snap taut, drivers with kinks. Hard because the forces have
   a corner at every touch, which an integrator of order 8 must meet exactly, and because a thousand
   touches located a little late would show in the energy: the books must close over all of them. */
#include "quantity/law_kind.h"
#include "hard.h"

/* a rotor between two elastic stops: 2 (gap/w + pi/w0) per round */
static void test_ten_thousand_touches(void **state) {
    (void)state;
    for (double k = 1e2; k < 2e8; k *= 1e3) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 1, 0);
        rig_body(&r, "rotor", 1, 1, 0, 0, 0);
        fw_mechanism_pin *p = rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
        p->stop_min_rad = -0.3, p->stop_max_rad = 0.3, p->stop_stiffness_Nm_per_rad = k;
        rig_velocity(&r, 0, 0, 0, 2);
        int rounds = hard_quick() ? 50 : 2500;
        double period = 2 * (0.3 + HARD_PI / sqrt(k));
        r.scene.duration_s = rounds * period;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = 1e-11, .samples = 6});
        double place = 0, rate = 0;
        for (int i = 1; i < 6; i++) {
            place = fmax(place, fabs(hard_q(m, i)[2]));
            rate = fmax(rate, fabs(hard_v(m, i)[2] - 2));
        }
        print_message(
            "impacts: %ld touches of stops of stiffness %.0e: angle to %.1e, rate to %.1e, "
            "energy %.1e, %ld steps\n",
            m->stats.events, k, place, rate, m->stats.energy_error, m->stats.steps);
        assert_int_equal(m->stats.events, 4 * rounds);
        /* a touch is left from the dense output, whose error is some ten times rtol */
        double per_touch = 1e-10 * (double)m->stats.events;
        assert_true(m->stats.energy_error < per_touch);
        assert_true(rate < 2 * per_touch);
        assert_true(place < per_touch * r.scene.duration_s);
        fw_arena_free(arena);
    }
}

/* the six-bar thrown against damped stops at all of its hinges */
static void test_six_bar_in_stops(void **state) {
    (void)state;
    for (int e = 7; e <= 11; e += 2) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_six_bar(arena, false);
        for (int i = 0; i < 6; i++) {
            fw_mechanism_pin *p = &r.m.pin[i];
            p->stop_min_rad = -0.02, p->stop_max_rad = 0.02;
            p->stop_stiffness_Nm_per_rad = 1e-2, p->stop_damping_Nms_per_rad = 1e-9;
        }
        rig_velocity(&r, 2, 3, 1, 500);
        r.scene.duration_s = 5e-3;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = pow(10, -e), .samples = 51});
        double most = 0;
        for (int i = 0; i < 6; i++)
            most = fmax(most, fabs(m->peak[i].angle_rad));
        print_message(
            "impacts: six-bar between twelve stops, rtol 1e-%d: %ld touches, deepest %.5f "
            "rad, energy %.1e, constraint %.1e, %ld steps, %.0f ms\n",
            e, m->stats.events, most, m->stats.energy_error, m->stats.max_constraint_norm,
            m->stats.steps, 1e3 * m->stats.cpu_s);
        assert_true(m->stats.events > 100);
        assert_true(m->stats.energy_error < 1e3 * pow(10, -e));
        fw_arena_free(arena);
    }
}

/* a body that hangs in four cables and is thrown about: taut, slack, taut */
static void test_cables(void **state) {
    (void)state;
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int e = 8; e <= 12; e += 2) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 0, 4);
        rig_body(&r, "weight", 1, 0.05, 0, 0, 0);
        for (int i = 0; i < 4; i++) {
            fw_device_spring *s = rig_spring(&r, "cable", FW_GROUND, corner[i][0], corner[i][1], 0,
                                             0.1 * corner[i][0], 0.1 * corner[i][1], 2e4, 1.3);
            s->cable = true;
            s->damping_Ns_per_m = i == 2 ? 3 : 0;
        }
        rig_velocity(&r, 0, 3, 2, 5);
        r.scene.gravity = true, r.scene.gy_m_per_s2 = -9.81;
        r.scene.duration_s = 5;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = pow(10, -e), .samples = 11});
        print_message("impacts: weight in four cables, rtol 1e-%d: %ld events, energy %.1e, %ld "
                      "steps\n",
                      e, m->stats.events, m->stats.energy_error, m->stats.steps);
        assert_true(m->stats.events > 20);
        assert_true(m->stats.energy_error < 1e4 * pow(10, -e));
        fw_arena_free(arena);
    }
}

/* a bar dropped on a stop, with the damping that lets it rest: touches end, and it lies still but
   for what an explicit step at the limit of its stability leaves: some rtol per unit of the scene's
   time, sqrt((J + m l^2) / (m g l)) here */
static void at_rest(double rtol) {
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "bar", 1, 1.0 / 12, 0.5, 0, 0);
    fw_mechanism_pin *p = rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    p->stop_min_rad = -0.5, p->stop_max_rad = (double)NAN;
    p->stop_stiffness_Nm_per_rad = 1e6, p->stop_damping_Nms_per_rad = 30;
    r.scene.gravity = true, r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 10;
    const fw_dynamics_motion *m =
        hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = rtol, .samples = 11});
    double low = 0.5, high = 0.50001; /* m g l cos(angle) = k (angle - 0.5) */
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        *(9.81 * 0.5 * cos(middle) > 1e6 * (middle - 0.5) ? &low : &high) = middle;
    }
    double noise = 10 * rtol / sqrt((1.0 / 12 + 1) / 9.81);
    double place = fabs(hard_q(m, 10)[2] + low), rate = fabs(hard_v(m, 10)[2]);
    print_message(
        "impacts: bar dropped on a stop, rtol %.0e: %ld events, rests %.1e from the balance "
        "at %.1e rad/s, energy %.1e, by %s in %ld steps\n",
        rtol, m->stats.events, place, rate, m->stats.energy_error, m->integrator, m->stats.steps);
    assert_true(place < noise / 100); /* the stop's own time is 500 times shorter */
    assert_true(rate < noise);
    assert_true(m->stats.energy_error < 100 * rtol);
    fw_arena_free(arena);
}

static void test_comes_to_rest(void **state) {
    (void)state;
    at_rest(1e-7);
    at_rest(1e-8);
    at_rest(1e-10);
}

/* a driver whose speed jumps a hundred times: every jump is an impact without rebound, and what it
   costs is in the books */
static void test_driver_with_kinks(void **state) {
    (void)state;
    enum { KINKS = 100 };
    double t[KINKS + 1], v[KINKS + 1];
    uint64_t seed = 5;
    for (int i = 0; i <= KINKS; i++)
        t[i] = 0.02 * i, v[i] = i ? v[i - 1] + 0.1 * (rig_random(&seed) - 0.5) : 0;
    for (int e = 7; e <= 11; e += 2) {
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 4, 4, 0);
        static const double p[5][2] = {{0, 0}, {0.3, 0.4}, {0.9, 0.6}, {1.3, 0.3}, {1.6, 0}};
        hard_bars(&r, p, 4, 1);
        for (int i = 0; i < 3; i++)
            r.m.pin[i].stiffness_Nm_per_rad = 20, r.m.pin[i].damping_Nms_per_rad = 0.1,
            r.m.pin[i].free_angle_rad = r.m.body[i + 1].phi_rad - r.m.body[i].phi_rad;
        rig_pin(&r, "A", FW_GROUND, 0, 0, 0, 0, 0);
        r.m.pin[3].free_angle_rad = r.m.body[0].phi_rad;
        hard_driver(arena, &r, "motor", 3, FW_NONE,
                    (fw_quantity_law){.kind = &fw_quantity_law_table,
                                      .table_t_s = t,
                                      .table_value = v,
                                      .ntable = KINKS + 1});
        r.scene.duration_s = 2;
        const fw_dynamics_motion *m =
            hard_run(arena, &r, (fw_dynamics_motion_options){.rtol = pow(10, -e), .samples = 101});
        double worst = 0; /* rows at the kinks */
        for (int i = 0; i <= KINKS; i++)
            worst = fmax(worst, fabs(hard_q(m, i)[2] - r.m.body[0].phi_rad - v[i]));
        print_message("impacts: driver with %d kinks, rtol 1e-%d: angle to %.1e, energy %.1e, %ld "
                      "steps\n",
                      KINKS, e, worst, m->stats.energy_error, m->stats.steps);
        assert_true(worst < 1e-12);
        assert_true(m->stats.energy_error < 1e3 * pow(10, -e));
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ten_thousand_touches),
        cmocka_unit_test(test_six_bar_in_stops),
        cmocka_unit_test(test_cables),
        cmocka_unit_test(test_comes_to_rest),
        cmocka_unit_test(test_driver_with_kinks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
