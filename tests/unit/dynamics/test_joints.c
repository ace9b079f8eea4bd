/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motions with joints other than pins, with drivers and with laws, against closed forms. */
#include "quantity/law_kind.h"
#include "models.h"

static const fw_dynamics_motion *run(fw_arena *arena, const rig *r, double rtol) {
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {
        .rtol = rtol, .samples = 11, .effects = {.mode = FW_EFFECTS_ALL}};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    assert_true(motion->stats.max_constraint_norm < 1e-12);
    return motion;
}

static fw_device_joint *rig_joint(fw_arena *arena, rig *r, fw_device_joint_kind kind, int a,
                                  int b) {
    if (!r->m.joint) r->m.joint = fw_arena_array(arena, fw_device_joint, 8);
    fw_device_joint *t = &r->m.joint[r->m.njoint++];
    *t = (fw_device_joint){.id = "tie", .kind = kind, .body_a = a, .body_b = b};
    return t;
}

static fw_device_driver *rig_driver(fw_arena *arena, rig *r, int revolute, int joint,
                                    fw_quantity_law law) {
    if (!r->m.driver) r->m.driver = fw_arena_array(arena, fw_device_driver, 4);
    fw_device_driver *d = &r->m.driver[r->m.ndriver++];
    *d = (fw_device_driver){.id = "driver", .revolute = revolute, .joint = joint, .law = law};
    return d;
}

/* a point mass on a massless rod is the pendulum A01, whatever the mass turns like */
static void test_rod_is_the_pendulum(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "bob", 1, 0.3, -1, 0, 0);
    rig_joint(arena, &r, FW_JOINT_DISTANCE, FW_GROUND, 0)->length_m = 1;
    rig_velocity(&r, 0, 0, 0, 0.25);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 10;
    const fw_dynamics_motion *m = run(arena, &r, 1e-13);
    const double *q = m->q + 3 * (m->nsample - 1);
    assert_near(q[0], -0.2750874625761168600544, 1e-11); /* elliptic functions, 22 digits */
    assert_near(q[1], -0.9614192050991250642651, 1e-11);
    assert_near(q[2], 2.5, 1e-12);
    assert_true(m->stats.energy_error < 1e-12);
    /* the rod pulls with m g sin + m v^2 / L = 3 m g (-y) */
    double pull = 3 * 9.81 * 0.9614192050991250642651, x = q[0], y = q[1];
    const double *f = m->joint_N + 3 * (m->nsample - 1);
    assert_near(f[0], -pull * x, 1e-9);
    assert_near(f[1], -pull * y, 1e-9);
    assert_near(f[2], 0, 1e-12);
    fw_arena_free(arena);
}

/* two welded bars on a pin move like one bar of their common mass and inertia */
static void test_weld_is_one_body(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig two = rig_new(arena, 2, 1, 0), one = rig_new(arena, 1, 1, 0);
    rig_body(&two, "p", 1, 0.1, 0.5, 0, 0.2);
    rig_body(&two, "q", 3, 0.4, 1.1, 0.4, -0.3);
    rig_pin(&two, "O", FW_GROUND, 0, 0, 0, 0, 0);
    fw_device_joint *t = rig_joint(arena, &two, FW_JOINT_WELD, 0, 1);
    const fw_mechanism_mass *p = &two.m.body[0], *q = &two.m.body[1];
    double dx = q->x_m - p->x_m, dy = q->y_m - p->y_m; /* welded at the centre of q */
    t->ax_m = cos(0.2) * dx + sin(0.2) * dy, t->ay_m = -sin(0.2) * dx + cos(0.2) * dy;
    t->angle_rad = -0.5;
    double x = (p->x_m + 3 * q->x_m) / 4, y = (p->y_m + 3 * q->y_m) / 4;
    double inertia = 0.1 + 0.4 + 0.75 * (dx * dx + dy * dy);
    rig_body(&one, "both", 4, inertia, x, y, 0);
    rig_pin(&one, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig *const both[2] = {&two, &one};
    for (int i = 0; i < 2; i++) {
        both[i]->scene.gravity = true;
        both[i]->scene.gy_m_per_s2 = -9.81;
        both[i]->scene.duration_s = 5;
    }
    const fw_dynamics_motion *a = run(arena, &two, 1e-13), *b = run(arena, &one, 1e-13);
    for (int k = 0; k < a->nsample; k++) {
        assert_near(a->q[6 * k + 2] - 0.2, b->q[3 * k + 2], 1e-11);
        assert_near(a->q[6 * k + 5] + 0.3, b->q[3 * k + 2], 1e-11);
        /* the weld carries what q needs: m_q (acceleration - g) and its torque */
        const double *f = a->joint_N + 3 * k, *acc = a->accel + 6 * k + 3;
        assert_near(f[0], 3 * acc[0], 1e-9);
        assert_near(f[1], 3 * (acc[1] + 9.81), 1e-9);
        assert_near(f[2], 0.4 * acc[2], 1e-9);
    }
    fw_arena_free(arena);
}

/* slider-crank with a driven crank: x = r cos wt + sqrt(l^2 - r^2 sin^2 wt), all derivatives */
static void test_driven_slider_crank(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double radius = 1e-3, length = 3e-3, w = 500;
    rig r = rig_new(arena, 3, 3, 0);
    rig_body(&r, "crank", 1e-8, 1e-15, radius / 2, 0, 0);
    rig_body(&r, "rod", 2e-8, 2e-14, radius + length / 2, 0, 0);
    rig_body(&r, "piston", 3e-8, 1e-15, radius + length, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "B", 0, 1, radius, 0, 0, 0);
    rig_pin(&r, "P", 1, 2, radius + length, 0, 0, 0);
    fw_device_joint *slide = rig_joint(arena, &r, FW_JOINT_PRISMATIC, FW_GROUND, 2);
    slide->axis_rad = 0;
    fw_quantity_names none = {NULL, 0};
    fw_quantity_expression_error error;
    fw_quantity_program *program;
    const char *text = "500 rad/s * t";
    assert_int_equal(fw_quantity_program_compile(arena, text, strlen(text), &none,
                                                 (fw_quantity_dimension){.rad = 1}, &program,
                                                 &error),
                     FW_OK);
    rig_driver(arena, &r, 0, FW_NONE,
               (fw_quantity_law){.kind = &fw_quantity_law_expression, .program = program});
    r.scene.duration_s = 2e-2;
    rig_velocity(&r, 0, 0, w * radius / 2, w); /* fits: no warning needed */
    const fw_dynamics_motion *m = run(arena, &r, 1e-12);
    for (int k = 0; k < m->nsample; k++) {
        double a = w * m->t_s[k], s = radius * sin(a), root = sqrt(length * length - s * s);
        double x = radius * cos(a) + root;
        double sr = radius * w * cos(a), cr = -radius * w * sin(a), rootr = -s * sr / root;
        double sa = -w * w * s, ca = -w * w * radius * cos(a);
        double roota = -(sr * sr + s * sa + rootr * rootr) / root;
        const double *q = m->q + 9 * k + 6, *v = m->v + 9 * k + 6, *acc = m->accel + 9 * k + 6;
        assert_near(q[0], x, 1e-14);
        assert_near(v[0], cr + rootr, 1e-11);
        assert_near(acc[0], ca + roota, 1e-8);
        assert_near(q[1], 0, 1e-15);
        /* power: driver torque times speed = rate of the kinetic energy */
        double power = 0;
        for (int b = 0; b < 3; b++) {
            const double *vb = m->v + 9 * k + 3 * b, *ab = m->accel + 9 * k + 3 * b;
            power += r.m.body[b].mass_kg * (vb[0] * ab[0] + vb[1] * ab[1]) +
                     r.m.body[b].inertia_kg_m2 * vb[2] * ab[2];
        }
        assert_near(m->driver_N[k] * w, power, 1e-12 * 1e-3);
    }
    assert_true(m->stats.energy_error < 1e-11);
    fw_arena_free(arena);
}

/* a free mass on a slide under a table law: its velocity is the integral, exactly, kinks and all */
static void test_table_law(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const double t[4] = {0, 1e-3, 1.5e-3, 4e-3}, g[4] = {0, 2, -1, 0.5};
    fw_quantity_law law = {
        .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = g, .ntable = 4};
    rig r = rig_new(arena, 1, 0, 0);
    rig_body(&r, "cart", 1e-8, 1e-14, 0, 0, 0);
    rig_joint(arena, &r, FW_JOINT_PRISMATIC, FW_GROUND, 0)->axis_rad = 0.3;
    rig_force(&r, 0, 1e-4 * cos(0.3), 1e-4 * sin(0.3));
    r.scene.force[0].law = &law;
    r.scene.duration_s = 5e-3;
    const fw_dynamics_motion *m = run(arena, &r, 1e-10);
    double area = 0.5e-3 * 2 + 0.25e-3 * (2 - 1) + 1.25e-3 * (-1 + 0.5) + 1e-3 * 0.5;
    const double *v = m->v + 3 * (m->nsample - 1);
    assert_near(hypot(v[0], v[1]), 1e4 * area, 1e-10);
    assert_true(m->stats.energy_error < 1e-12);
    fw_arena_free(arena);
}

/* a driver whose speed jumps (a ramp) gives a jolt; the books still close, and the end is right */
static void test_ramped_driver(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const double t[3] = {0, 1e-3, 2e-3}, g[3] = {0, 0, 0.5};
    rig r = rig_new(arena, 2, 2, 0);
    rig_body(&r, "arm", 1e-8, 1e-14, 5e-4, 0, 0);
    rig_body(&r, "tip", 1e-8, 1e-14, 15e-4, 0, 0);
    rig_pin(&r, "O", FW_GROUND, 0, 0, 0, 0, 0);
    rig_pin(&r, "K", 0, 1, 1e-3, 0, 1e-6, 0);
    rig_driver(arena, &r, 0, FW_NONE,
               (fw_quantity_law){
                   .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = g, .ntable = 3});
    r.scene.duration_s = 3e-3;
    const fw_dynamics_motion *m = run(arena, &r, 1e-11);
    const double *q = m->q + 6 * (m->nsample - 1);
    assert_near(q[2], 0.5, 1e-14);
    assert_true(m->stats.energy_error < 1e-10);
    assert_near(m->q[6 * 3 + 2], 0, 1e-15); /* at 0.9 ms nothing has moved */
    fw_arena_free(arena);
}

/* joints that repeat each other in one direction only (two plates on two pins, a weld with a pin)
   leave pivots of condition 1e8; the motion, the steps it takes and the accelerations are those of
   the same plates welded once. Small inertias against m r^2 make it worse. */
static void test_half_redundant(void **state) {
    (void)state;
    for (double inertia = 5e-14; inertia > 1e-18; inertia /= 10) {
        fw_arena *arena = fw_arena_new(0);
        rig r[3];
        for (int i = 0; i < 3; i++) {
            r[i] = rig_new(arena, 2, 3, 0);
            rig_body(&r[i], "a", 1e-7, inertia, 1e-3, 0, 0);
            rig_body(&r[i], "b", 1e-7, inertia, 3e-3, 0, 0);
            rig_pin(&r[i], "O", FW_GROUND, 0, 0, 0, 1e-6, 0);
            if (i > 0) rig_joint(arena, &r[i], FW_JOINT_WELD, 0, 1)->ax_m = 2e-3;
            if (i != 1) rig_pin(&r[i], "p", 0, 1, 2e-3, 0, 0, 0);
            if (i == 0) rig_pin(&r[i], "q", 0, 1, 3e-3, 1e-3, 0, 0);
            rig_force(&r[i], 1, 0, 5e-5);
            r[i].scene.duration_s = 1e-2;
        }
        const fw_dynamics_motion *once = run(arena, &r[1], 1e-12);
        for (int i = 0; i < 3; i += 2) {
            const fw_dynamics_motion *m = run(arena, &r[i], 1e-12);
            assert_true(m->stats.steps < 3 * once->stats.steps);
            for (int k = 0; k < 6 * m->nsample; k++) {
                double unit = k % 3 == 2 ? 1 : 1e-3;
                assert_near(m->q[k], once->q[k], 1e-10 * unit);
                assert_near(m->accel[k], once->accel[k], 1e-9 * unit * 1e6);
            }
        }
        fw_arena_free(arena);
    }
}

static const fw_dynamics_motion *run_peaks(fw_arena *arena, const rig *r, double moved) {
    fw_diags diags = fw_diags_new(arena);
    fw_dynamics_motion_options o = {.rtol = 1e-11,
                                    .samples = 2,
                                    .effects = {.mode = FW_EFFECTS_ALL},
                                    .reactions = true,
                                    .moved_m = moved};
    const fw_dynamics_motion *motion = NULL;
    fw_status status = fw_dynamics_simulate(arena, &r->m, &r->scene, &o, &diags, &motion);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no diagnostic");
    assert_near(motion->stats.assembly_moved_m, moved, 1e-15);
    return motion;
}

static void near_peak(double value, double error, double expected) {
    assert_near(value, expected, error + 1e-13 * expected);
    assert_true(error < 1e-6 * expected);
}

/* extremes of what rods, slides, welds and drivers exert, and of travels, against closed forms */
static void test_peaks_of_joints(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_new(arena, 1, 0, 0); /* rod: 3 m g at the bottom, from rest at its level */
    rig_body(&r, "bob", 2, 0.3, -1, 0, 0);
    rig_joint(arena, &r, FW_JOINT_DISTANCE, FW_GROUND, 0)->length_m = 1;
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 1.5;
    const fw_dynamics_motion *m = run_peaks(arena, &r, 0);
    near_peak(m->joint_peak[0].force_N, m->joint_peak[0].error_N, 6 * 9.81);
    /* a quarter of the period: K(sin(pi/4)) sqrt(l/g), K = 1.8540746773013719 */
    assert_near(m->joint_peak[0].t_s, 1.8540746773013719 / sqrt(9.81), 1e-5);
    assert_near(m->joint_peak[0].torque_Nm, 0, 0);
    assert_near(m->travel_peak[0].travel_m, 0, 0);

    r = rig_new(arena, 1, 0, 0); /* a cart on a spring: amplitude v / omega, to the left first */
    rig_body(&r, "cart", 2, 1, 0, 0, 0);
    fw_device_joint *t = rig_joint(arena, &r, FW_JOINT_PRISMATIC, FW_GROUND, 0);
    t->stiffness_N_per_m = 50;
    rig_velocity(&r, 0, -1.5, 0, 0);
    r.scene.gravity = true;
    r.scene.gy_m_per_s2 = -9.81;
    r.scene.duration_s = 0.5; /* less than half a period: one extreme */
    rig_torque(&r, 0, 0.7);
    m = run_peaks(arena, &r, 3e-6);
    near_peak(-m->travel_peak[0].travel_m, m->travel_peak[0].error_m, 0.3);
    assert_near(m->travel_peak[0].t_s, acos(0.0) / 5, 1e-5);
    near_peak(m->joint_peak[0].force_N, m->joint_peak[0].error_N, 2 * 9.81);
    near_peak(m->joint_peak[0].torque_Nm, m->joint_peak[0].torque_error_Nm, 0.7);

    r = rig_new(arena, 3, 1, 0); /* a weld that hangs on a driven cart, a wheel that is driven */
    rig_body(&r, "cart", 2, 1, 0, 0, 0);
    rig_body(&r, "load", 3, 1, 0, 0, 0);
    rig_body(&r, "wheel", 3, 0.4, 5, 0, 0);
    rig_pin(&r, "hub", FW_GROUND, 2, 5, 0, 0, 0);
    rig_joint(arena, &r, FW_JOINT_PRISMATIC, FW_GROUND, 0);
    rig_joint(arena, &r, FW_JOINT_WELD, 0, 1)->by_m = -0.25;
    r.m.body[1].y_m = 0.25;
    const fw_quantity_law sine = {
        .kind = &fw_quantity_law_sine, .end_s = (double)INFINITY, .frequency_Hz = 2};
    rig_driver(arena, &r, FW_NONE, 0, sine);
    rig_driver(arena, &r, 0, FW_NONE, sine);
    rig_velocity(&r, 0, 4 * acos(-1.0), 0, 0); /* as fast as the laws start */
    rig_velocity(&r, 1, 4 * acos(-1.0), 0, 0);
    rig_velocity(&r, 2, 0, 0, 4 * acos(-1.0));
    r.scene.duration_s = 0.45;
    m = run_peaks(arena, &r, 0);
    double most = pow(4 * acos(-1.0), 2); /* of the acceleration: 1 m, 1 rad times omega^2 */
    near_peak(m->joint_peak[1].force_N, m->joint_peak[1].error_N, 3 * most);
    near_peak(m->joint_peak[1].torque_Nm, m->joint_peak[1].torque_error_Nm, 3 * most * 0.25);
    near_peak(m->driver_peak[0].force_N, m->driver_peak[0].error_N, 5 * most);
    assert_near(m->driver_peak[0].torque_Nm, 0, 0);
    near_peak(m->driver_peak[1].torque_Nm, m->driver_peak[1].torque_error_Nm, 0.4 * most);
    assert_near(m->driver_peak[1].force_N, 0, 0);
    near_peak(fabs(m->travel_peak[0].travel_m), m->travel_peak[0].error_m, 1);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rod_is_the_pendulum), cmocka_unit_test(test_weld_is_one_body),
        cmocka_unit_test(test_driven_slider_crank), cmocka_unit_test(test_table_law),
        cmocka_unit_test(test_ramped_driver),       cmocka_unit_test(test_peaks_of_joints),
        cmocka_unit_test(test_half_redundant),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
