/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shaken devices with one degree of freedom against closed forms: a half-sine shock (shock
   spectrum) and a sine. Poses are in the frame of the base. */
#include "quantity/law_kind.h"
#include "models.h"

static const double pi = 3.14159265358979323846;

/* mass 2 on a spring along a direction in the plane, natural frequency omega */
static rig slider(fw_arena *arena, double omega, double axis) {
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "mass", 2, 0.3, 0, 0, 0);
    r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
    r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "guide",
                                                .kind = FW_JOINT_PRISMATIC,
                                                .body_a = FW_GROUND,
                                                .body_b = 0,
                                                .axis_rad = axis,
                                                .stiffness_N_per_m = 2 * omega * omega};
    r.scene.base = fw_arena_array(arena, fw_device_base_motion, 2);
    return r;
}

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r, int samples) {
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {.rtol = 1e-11, .samples = samples, .reactions = true};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    assert_true(motion->stats.energy_error < 1e-9);
    return motion;
}

/* largest relative displacement under a sin(pi t/tau), 0 < t < tau, over a/omega^2, with
   b = pi/(tau omega): during the shock sin(2 pi b/(1 + b))/(1 - b), 1/3 < b < 1, and behind it
   2 b cos(pi/(2 b))/(b^2 - 1), b > 1. Source: Clough and Penzien, Dynamics of Structures, 5-2. */
static void shock_spectrum(void **state) {
    (void)state;
    const double omega = 30, ratio[4] = {0.45, 0.6, 2, 7};
    for (int i = 0; i < 4; i++) {
        fw_arena *arena = fw_arena_new(0);
        double b = ratio[i], tau = pi / (b * omega), axis = 0.4 + i;
        rig r = slider(arena, omega, axis);
        const fw_quantity_law shock = {
            .kind = &fw_quantity_law_sine, .end_s = tau, .frequency_Hz = 1 / (2 * tau)};
        r.scene.base[r.scene.nbase++] = (fw_device_base_motion){
            .ax_m_per_s2 = 5 * cos(axis), .ay_m_per_s2 = 5 * sin(axis), .law = &shock};
        r.scene.duration_s = tau + 4 * pi / omega;
        const fw_dynamics_motion *m = run(arena, &r, 2);
        double want = b < 1 ? sin(2 * pi * b / (1 + b)) / (1 - b)
                            : fabs(2 * b * cos(pi / (2 * b)) / (b * b - 1));
        assert_relative(fabs(m->travel_peak[0].travel_m), want * 5 / (omega * omega), 1e-8);
        fw_arena_free(arena);
    }
}

/* x = -(a/(w^2 - p^2)) (sin p t - (p/w) sin w t) along the guide; a constant beside it swings as
   -(g/w^2)(1 - cos w t); across the guide nothing happens */
static void sine_and_constant(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double w = 12, p = 19.5, axis = -0.7, c = cos(axis), s = sin(axis);
    rig r = slider(arena, w, axis);
    const fw_quantity_law sine = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = p / (2 * pi)};
    r.scene.base[r.scene.nbase++] = (fw_device_base_motion){
        .ax_m_per_s2 = 3 * c - 8 * s, .ay_m_per_s2 = 3 * s + 8 * c, .law = &sine};
    r.scene.base[r.scene.nbase++] =
        (fw_device_base_motion){.ax_m_per_s2 = 2 * c, .ay_m_per_s2 = 2 * s};
    r.scene.duration_s = 2;
    const fw_dynamics_motion *m = run(arena, &r, 41);
    for (int i = 0; i < m->nsample; i++) {
        double t = m->t_s[i], x = -3 / (w * w - p * p) * (sin(p * t) - p / w * sin(w * t));
        x -= 2 / (w * w) * (1 - cos(w * t));
        assert_near(m->q[3 * i] * c + m->q[3 * i + 1] * s, x, 1e-9);
        assert_near(m->q[3 * i + 1] * c - m->q[3 * i] * s, 0, 1e-12);
    }
    fw_arena_free(arena);
}

/* a constant acceleration of the base is a weight the other way, for any mechanism */
static void like_a_weight(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig weight = rig_six_bar(arena, false), shaken = rig_six_bar(arena, false);
    weight.scene.gravity = true;
    weight.scene.gx_m_per_s2 = 40, weight.scene.gy_m_per_s2 = -25;
    fw_device_base_motion base = {.ax_m_per_s2 = -40, .ay_m_per_s2 = 25};
    shaken.scene.base = &base, shaken.scene.nbase = 1;
    weight.scene.duration_s = shaken.scene.duration_s = 2e-3;
    const fw_dynamics_motion *a = run(arena, &weight, 5), *b = run(arena, &shaken, 5);
    for (int i = 0; i < 5 * 15; i++)
        assert_near(b->q[i], a->q[i], 1e-11);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shock_spectrum),
                                       cmocka_unit_test(sine_and_constant),
                                       cmocka_unit_test(like_a_weight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
