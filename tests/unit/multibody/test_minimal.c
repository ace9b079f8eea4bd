/* SPDX-License-Identifier: GPL-3.0-or-later */
/* minimal: which mechanisms it can place body by body, and that what it computes solves the
   equations of motion at every pose. */
#include "quantity/law_kind.h"
#include "multibody/multibody_scratch.h"
#include "multibody/systems.h"

typedef struct made {
    fw_status status;
    fw_multibody_system *sys;
    const char *message;
} made;

static made system_of(fw_arena *arena, const rig *r) {
    const fw_multibody_model *m =
        rig_model_with(arena, &r->m, NULL, 1, fw_multibody_method_find("minimal"));
    fw_diags *diags = fw_arena_one(arena, fw_diags);
    *diags = fw_diags_new(arena);
    made out = {0};
    out.status = fw_multibody_system_new(arena, m, &r->m, diags, &out.sys);
    out.message = diags->count ? diags->item[0].message : "";
    return out;
}

static void expect(fw_arena *arena, const rig *r, const char *report) {
    made k = system_of(arena, r);
    if (k.status != FW_OK) fail_msg("%s", k.message);
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_multibody_method_find("minimal")->report(k.sys, &r->m, &text), FW_OK);
    assert_string_equal(text.data, report);
}

static void refused(fw_arena *arena, const rig *r, const char *what) {
    made k = system_of(arena, r);
    assert_int_equal(k.status, FW_SOLVER);
    if (!strstr(k.message, what)) fail_msg("%s", k.message);
}

static void plans_are_found(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig six = rig_six_bar(arena, false), squeezer = rig_squeezer(arena);
    rig pendulum = rig_pendulum(arena), windows = rig_windows(arena, 40);
    expect(arena, &six, "independent coordinates: AB.phi, BC.phi, CD.phi; 1 dyad closed");
    expect(arena, &squeezer, "independent coordinates: K1.phi; 3 dyads closed");
    expect(arena, &pendulum, "independent coordinates: bob.phi; 0 dyads closed");
    expect(arena, &windows, "independent coordinates: crank.phi; 40 dyads closed");
    /* the squeezer written backwards: the first bodies to try are the wrong ones */
    rig back = rig_squeezer(arena);
    for (int b = 0; b < 7; b++)
        back.m.body[b] = squeezer.m.body[6 - b];
    for (int i = 0; i < back.m.npin; i++) {
        fw_mechanism_pin *p = &back.m.pin[i];
        if (p->body_a != FW_GROUND) p->body_a = 6 - p->body_a;
        if (p->body_b != FW_GROUND) p->body_b = 6 - p->body_b;
    }
    expect(arena, &back, "independent coordinates: K3.phi; 3 dyads closed");
    fw_arena_free(arena);
}

/* a platform on three legs; `folded` legs of two bars (3 degrees of freedom, class II), straight
   ones make a structure that no order of dyads closes */
static rig rig_platform(fw_arena *arena, bool folded) {
    rig r = rig_new(arena, 7, 9, 0);
    rig_body(&r, "platform", 1, 0.1, 0, 0, 0);
    for (int i = 0; i < 3; i++) {
        double a = 2 * M_PI * i / 3, c = cos(a), s = sin(a);
        int leg = r.m.nbody;
        if (!folded) {
            rig_body(&r, "leg", 1, 0.1, 2 * c, 2 * s, 0);
            rig_pin(&r, "inner", 0, leg, c, s, 0, 0);
            rig_pin(&r, "outer", leg, FW_GROUND, 3 * c, 3 * s, 0, 0);
            continue;
        }
        rig_body(&r, "upper", 1, 0.1, 1.5 * c - s, 1.5 * s + c, 0);
        rig_body(&r, "lower", 1, 0.1, 2.5 * c - s, 2.5 * s + c, 0);
        rig_pin(&r, "inner", 0, leg, c, s, 0, 0);
        rig_pin(&r, "knee", leg, leg + 1, 2 * c - 2 * s, 2 * s + 2 * c, 0, 0);
        rig_pin(&r, "outer", leg + 1, FW_GROUND, 3 * c, 3 * s, 0, 0);
    }
    return r;
}

static void what_does_not_fit_is_named(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig twice = rig_six_bar(arena, true), legs = rig_platform(arena, true);
    rig truss = rig_platform(arena, false), slider = rig_new(arena, 2, 1, 0);
    refused(arena, &twice, "joint D2 does not fit; use --method chain");
    expect(arena, &legs,
           "independent coordinates: lower.phi, upper.phi, platform.phi; 2 dyads closed");
    refused(arena, &truss, "body ");
    fw_device_joint rail = {
        .id = "rail", .kind = FW_JOINT_PRISMATIC, .body_a = FW_GROUND, .body_b = 1};
    rig_body(&slider, "arm", 1, 1, 1, 0, 0);
    rig_body(&slider, "cart", 1, 1, 3, 0, 0);
    rig_pin(&slider, "O", FW_GROUND, 0, 0, 0, 0, 0);
    refused(arena, &slider, "body cart"); /* hangs on nothing */
    slider.m.joint = &rail;
    slider.m.njoint = 1;
    refused(arena, &slider, "joint rail");
    fw_arena_free(arena);
}

/* M a + G^T lambda = M a0 and G a = -gamma for anything on the right, also with a driver and a
   weld, at poses that `close` finds from rough guesses */
static void equations_are_solved(void **state) {
    (void)state;
    uint64_t seed = 5;
    static const double t[2] = {0, 1}, g[2] = {0, 0.7};
    for (int c = 0; c < 60; c++) {
        fw_arena *arena = fw_arena_new(0);
        rig r = c % 3 == 0   ? rig_six_bar(arena, false)
                : c % 3 == 1 ? rig_squeezer(arena)
                             : rig_platform(arena, true);
        if (c % 2) { /* the first pin of the ground driven; a flag welded to a body */
            r.m.body = fw_arena_grow(arena, r.m.body, (size_t)r.m.nbody, (size_t)r.m.nbody + 1,
                                     sizeof *r.m.body);
            const fw_mechanism_mass *last = &r.m.body[r.m.nbody - 1];
            double at = last->x_m + 1e-4, up = last->y_m;
            rig_body(&r, "flag", 1e-8, 1e-15, at, up, 0);
            r.m.joint = fw_arena_array(arena, fw_device_joint, 1);
            r.m.joint[r.m.njoint++] = (fw_device_joint){.id = "seam",
                                                        .kind = FW_JOINT_WELD,
                                                        .body_a = r.m.nbody - 1,
                                                        .body_b = r.m.nbody - 2,
                                                        .ax_m = -1e-4,
                                                        .angle_rad = last->phi_rad};
            r.m.driver = fw_arena_array(arena, fw_device_driver, 1);
            int pin = 0;
            while (r.m.pin[pin].body_a != FW_GROUND && r.m.pin[pin].body_b != FW_GROUND)
                pin++;
            r.m.driver[r.m.ndriver++] = (fw_device_driver){
                .id = "motor",
                .revolute = pin,
                .joint = FW_NONE,
                .law = {
                    .kind = &fw_quantity_law_table, .table_t_s = t, .table_value = g, .ntable = 2}};
            fw_mechanism_pin *driven = &r.m.pin[pin]; /* the law starts at the pose that is there */
            double a = driven->body_a == FW_GROUND ? 0 : r.m.body[driven->body_a].phi_rad;
            double b = driven->body_b == FW_GROUND ? 0 : r.m.body[driven->body_b].phi_rad;
            driven->free_angle_rad = b - a;
        }
        made k = system_of(arena, &r);
        if (k.status != FW_OK) fail_msg("case %d: %s", c, k.message);
        fw_multibody_system *sys = k.sys;
        const fw_multibody_model *m = sys->model;
        double u[64], a0[64], a[64], gamma[64], lambda[64], force[67] = {0}, rows[64];
        for (int j = 0; j < m->nq; j++) {
            u[j] = 0.1 * (rig_random(&seed) - 0.5) * (j % 3 == 2 ? 1 : 0.1);
            a[j] = a0[j] = rig_random(&seed) - 0.5;
        }
        for (int i = 0; i < m->nblock; i++)
            for (int e = 0; e < 2; e++)
                gamma[2 * i + e] =
                    e == 0 || m->block[i].rows == FW_ROWS_PIN ? rig_random(&seed) - 0.5 : 0;
        const fw_multibody_pose *pose = m->method->close(sys, 0.01, u);
        assert_non_null(pose);
        assert_true(fw_multibody_residual(sys, pose, rows) <= 1e-14 * (1 + m->size));
        const fw_multibody_factor *factor = fw_multibody_factorise(sys, pose);
        assert_non_null(factor);
        m->method->accelerate(sys, factor, gamma, a, lambda);
        fw_multibody_jacobian(m, pose, a, rows);
        double largest = 0, pull = 0;
        for (int j = 0; j < m->nq; j++)
            largest = fmax(largest, fabs(a[j]));
        for (int i = 0; i < 2 * m->nblock; i++) {
            assert_near(rows[i], -gamma[i], 1e-13 * (1 + largest));
            pull = fmax(pull, fabs(lambda[i]));
        }
        rig_transpose(m, pose, lambda, force);
        for (int j = 0; j < m->nq; j++) {
            double mass = 1 / (j % 3 == 2 ? m->jinv[j / 3] : m->minv[j / 3]);
            assert_near(force[j], mass * (a0[j] - a[j]), 1e-12 * (1 + pull + mass * largest));
        }
        m->method->correct(sys, pose, gamma, a);
        fw_multibody_jacobian(m, pose, a, rows);
        for (int i = 0; i < 2 * m->nblock; i++)
            assert_near(rows[i], -gamma[i], 1e-12);
        fw_arena_free(arena);
    }
}

/* circles that do not meet, and dyads that lie flat, are refused */
static void impossible_poses_are_refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = rig_windows(arena, 1);
    made k = system_of(arena, &r);
    assert_int_equal(k.status, FW_OK);
    double u[9] = {0};
    u[2] = -M_PI / 2; /* cranks level: the coupler lies on the line of the ground */
    const fw_multibody_pose *pose = k.sys->model->method->close(k.sys, 0, u);
    assert_false(pose && fw_multibody_factorise(k.sys, pose));
    rig six = rig_six_bar(arena, false);
    k = system_of(arena, &six);
    double far[15] = {0};
    far[2] = 2.5, far[5] = 2.5, far[8] = 2.5; /* AB, BC, CD turned away from F */
    assert_null(k.sys->model->method->close(k.sys, 0, far));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_are_found),
        cmocka_unit_test(what_does_not_fit_is_named),
        cmocka_unit_test(equations_are_solved),
        cmocka_unit_test(impossible_poses_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
