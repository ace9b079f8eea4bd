/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stops and cables: events found on the dense output, against closed forms. */
#include "models.h"

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r, double rtol, int samples) {
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {
        .rtol = rtol, .samples = samples, .effects = {.mode = FW_EFFECTS_ALL}};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    return motion;
}

enum { J = 1 };
static const double PI = 3.14159265358979323846;

/* a rotor between two stops of stiffness 1e4 and damping c, at +-0.3 rad, with 2 rad/s */
static rig rotor(fw_arena *arena, double c) {
    rig r = rig_new(arena, 1, 1, 0);
    rig_body(&r, "rotor", 1, J, 0, 0, 0);
    fw_mechanism_pin *p = rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    p->stop_min_rad = -0.3, p->stop_max_rad = 0.3;
    p->stop_stiffness_Nm_per_rad = 1e4, p->stop_damping_Nms_per_rad = c;
    rig_velocity(&r, 0, 0, 0, 2);
    return r;
}

/* period = 2 (0.6 / 2 + pi / sqrt(k/J)): after 50 periods it is where it began */
static void test_elastic_stops(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rotor(arena, 0);
    double period = 2 * (0.3 + PI / 100);
    r.scene.duration_s = 50 * period;
    const fw_dynamics_motion *m = run(arena, &r, 1e-12, 201);
    for (int k = 0; k < 201; k += 4) {
        assert_near(m->q[3 * k + 2], 0, 1e-9); /* 200 events, some rtol each */
        assert_near(m->v[3 * k + 2], 2, 1e-9);
    }
    assert_int_equal(m->stats.events, 200);
    assert_near(m->peak[0].angle_rad, 0.3 + 2 / 100.0, 1e-11);
    assert_true(m->stats.energy_error < 1e-10);
    fw_arena_free(arena);
}

/* a damped stop lets go when its force is zero: t* = atan2(2 z sqrt(1-z^2), 2 z^2 - 1) / w_d after
   the touch, with the speed exp(-z w t*) of before */
static void test_damped_stop(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double w = 100, z = 0.2;
    rig r = rotor(arena, 2 * z * w);
    double wd = w * sqrt(1 - z * z), contact = atan2(2 * z * sqrt(1 - z * z), 2 * z * z - 1) / wd;
    double left = 2 * exp(-z * w * contact);
    r.scene.duration_s = 0.15 + contact + 0.2;
    const fw_dynamics_motion *m = run(arena, &r, 1e-12, 2);
    /* where it lets go: k g = c left */
    double g = 2 * z * w * left / (w * w);
    assert_near(m->v[3 + 2], -left, 1e-10);
    assert_near(m->q[3 + 2], 0.3 + g - 0.2 * left, 1e-10);
    assert_int_equal(m->stats.events, 2);
    assert_true(m->stats.energy_error < 1e-11);
    fw_arena_free(arena);
}

/* an oscillator that touches a stop with the last millionth of its swing: two touches that no grid
   of places in a step would hit. Free x = A (1 - cos wt); at the stop an arc about its rest there.
 */
static void test_grazing(void **state) {
    (void)state;
    const double k = 1e-6, stop = 1, inertia = 2e-12, amplitude = 0.1;
    for (double share = 1e-4; share > 5e-9; share /= 10) { /* far above the tolerance */
        fw_arena *arena = fw_arena_new(0);
        rig r = rig_new(arena, 1, 1, 0);
        rig_body(&r, "bar", 1e-6, 1e-12, 1e-3, 0, 0);
        fw_mechanism_pin *p = rig_pin(&r, "O", FW_GROUND, 0, 0, 0, k, 0);
        p->stop_min_rad = (double)NAN, p->stop_max_rad = 2 * amplitude * (1 - share);
        p->stop_stiffness_Nm_per_rad = stop;
        rig_torque(&r, 0, amplitude * k);
        r.scene.duration_s = 20e-3;
        double w = sqrt(k / inertia), at = p->stop_max_rad, touch = acos(1 - at / amplitude) / w;
        double v = amplitude * w * sin(w * touch), wk = sqrt((k + stop) / inertia);
        double rest = (amplitude * k - k * at) / inertia / (wk * wk),
               arc = 2 * atan2(v / wk, -rest);
        double period = 2 * touch + arc / wk, t = fmod(r.scene.duration_s, period);
        t = fmin(t, period - t);
        const fw_dynamics_motion *m = run(arena, &r, 1e-10, 2);
        assert_int_equal(m->stats.events, 4);
        assert_near(m->peak[0].angle_rad, at + rest + hypot(rest, v / wk), m->peak[0].error_rad);
        /* the time of a touch is known to the tolerance over its speed, which falls with
         * sqrt(share) */
        assert_near(m->q[3 + 2], amplitude * (1 - cos(w * t)), 1e-10 / sqrt(share));
        fw_arena_free(arena);
    }
}

/* a mass thrown up from a cable's rest length: flies 2 v/g, then swings once through the spring */
static void test_cable(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double g = 10, v = 3, k = 400, w = 20;
    rig r = rig_new(arena, 1, 1, 1);
    rig_body(&r, "weight", 1, 1, 0, -2, 0);
    r.m.npin = 0;
    r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "guide",
                                                .kind = FW_JOINT_PRISMATIC,
                                                .body_a = FW_GROUND,
                                                .body_b = 0,
                                                .axis_rad = PI / 2};
    r.m.spring[r.m.nspring++] = (fw_device_spring){.id = "cable",
                                                   .body_a = FW_GROUND,
                                                   .body_b = 0,
                                                   .stiffness_N_per_m = k,
                                                   .length_m = 2,
                                                   .cable = true};
    rig_velocity(&r, 0, 0, v, 0);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -g;
    /* taut: x'' = -w^2 x - g downwards stretch s: s = g/w^2 (1 - cos) + v/w sin; s = 0 again at
       2 atan2(v w, -g)... of tan(wt/2) = -v w / g */
    double taut = 2 * (PI - atan(v * w / g)) / w;
    r.scene.duration_s = 3 * (2 * v / g + taut);
    const fw_dynamics_motion *m = run(arena, &r, 1e-12, 4);
    for (int i = 0; i < 4; i++) {
        assert_near(m->q[3 * i + 1], -2, 1e-10);
        assert_near(m->v[3 * i + 1], v, 1e-9);
    }
    assert_true(m->stats.events == 5 || m->stats.events == 6); /* the last one is at the end */
    assert_true(m->stats.energy_error < 1e-10); /* the dense output is an order below the step */
    fw_arena_free(arena);
}

/* the peaks of angle and joint force of a swinging pendulum: g and 3 m g are exact */
static void test_force_peak(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_pendulum(arena);
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {.rtol = 1e-11, .reactions = true};
    const fw_dynamics_motion *m = NULL;
    assert_int_equal(fw_dynamics_simulate(arena, &r.m, &r.scene, &o, &diags, &m), FW_OK);
    /* released horizontally: w^2 = 2 m g l / (J + m l^2) at the bottom */
    double w2 = 2 * 9.81 * 0.5 / 0.5, most = 9.81 + w2 * 0.5;
    assert_near(m->force_peak[0].force_N, most, 1e-9);
    assert_true(m->force_peak[0].error_N >= fabs(m->force_peak[0].force_N - most));
    assert_true(m->force_peak[0].error_N < 1e-6);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_elastic_stops), cmocka_unit_test(test_damped_stop),
        cmocka_unit_test(test_grazing),       cmocka_unit_test(test_cable),
        cmocka_unit_test(test_force_peak),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
