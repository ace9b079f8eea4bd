/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "element_check.h"
#include "hinge_rigs.h"

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

/* both senses, arcs and leaves, with roots, axial and shear compliance, a free angle and damping:
   power, tangent and balance on random states */
static void element_laws(void **state) {
    (void)state;
    unsigned seed = 7;
    for (int i = 0; i < 60; i++) {
        rig r;
        rig_new(&r, 2, 1);
        r.body[0] = (fw_mechanism_mass){"a", 1e-8, 1e-15, 1e-4, 2e-4, 0.3, {0, 0}};
        r.body[1] = (fw_mechanism_mass){"b", 1e-8, 1e-15, -1e-4, 3e-4, -0.2, {0, 0}};
        rig_hinge(&r, 0, "H", 0, 1, (fw_geometry_vec2){1e-4, 1e-4}, 4 * random_(&seed), i % 2 == 0);
        fw_flexure_hinge_law *law = &r.hinge[0].law;
        if (i % 3 == 0) law->half_angle_rad = 0;
        law->share = 0.96, law->root_m_per_N = 0.03 * law->bend_m_per_N;
        law->axial_m_per_N = 2e-4 * law->bend_m_per_N;
        law->shear_m_per_N = 6e-4 * law->bend_m_per_N;
        r.pin[0].free_angle_rad = 0.05;
        r.pin[0].damping_Nms_per_rad = i % 4 == 0 ? 0 : 1e-10;
        rig_compile(&r);
        assert_int_equal(r.loads.nelement, 1);
        const fw_effects_force_element *e = &r.loads.element[0];
        assert_int_equal(e->dissipates, i % 4 != 0);
        double p[6], w[6];
        for (int k = 0; k < 6; k++) {
            p[k] = (k % 3 == 2 ? 0.4 : 4e-6) * random_(&seed);
            w[k] = (k % 3 == 2 ? 300 : 4e-2) * random_(&seed);
        }
        fw_effects_port_state s = {.load = 1, .p = p, .w = w};
        fw_check_tangent(e, &s, 2e-8, 1e-3, 1e-7);
        fw_check_power(e, &s, 1e-7, 1e-7);
        fw_check_balance(e, &s, 1e-11);
        const char *why;
        assert_true(e->class_->valid(e, &s, &why));
        fw_arena_free(r.arena);
    }
}

/* the spring of the joint goes over to the element, its damper stays, and all of it but once */
static void released_once(void **state) {
    (void)state;
    rig r;
    rig_six_bar(&r, false);
    r.hinge[2].axis_rad = (double)NAN;
    r.hinge[3].axis_rad = (double)NAN;
    r.hinge[4].stated = true; /* another stiffness, the same strip */
    for (int i = 0; i < 6; i++)
        r.pin[i].damping_Nms_per_rad = 1e-12;
    rig_compile(&r);
    assert_int_equal(fw_effect_nonlinear_hinge.add(&r.c, &r.loads), FW_OK);
    assert_int_equal(r.loads.nreleased, 4);
    assert_int_equal(r.loads.nelement, 4);
    assert_int_equal(r.loads.ntorsion, 6);
    assert_int_equal(fw_effect_nonlinear_hinge.count(&r.c), 4);
    for (int i = 0; i < 6; i++) {
        bool kept = i == 2 || i == 3;
        const fw_effects_torsion *t = &r.loads.torsion[r.loads.torsion_of[i] - 1];
        assert_int_equal(r.loads.released[i], !kept);
        assert_near(t->stiffness_Nm_per_rad, kept ? r.pin[i].stiffness_Nm_per_rad : 0, 0);
        assert_near(t->damping_Nms_per_rad, 1e-12, 0);
    }
    for (int i = 0; i < r.loads.nelement; i++)
        assert_string_equal(r.loads.element[i].id, r.pin[r.loads.element[i].pin].id);
    for (int i = 0; i < 6; i++)
        r.hinge[i].stated = true, r.pin[i].stiffness_Nm_per_rad = 0; /* a pin without a spring */
    assert_false(fw_effect_nonlinear_hinge.called_for(&r.c));
    fw_device_contact_use touch = {.joint = 1};
    r.scene.contact = &touch, r.scene.ncontact = 1;
    assert_true(fw_effect_nonlinear_hinge.called_for(&r.c));
    assert_int_equal(fw_effect_nonlinear_hinge.count(&r.c), 1);
    fw_arena_free(r.arena);
}

typedef struct pose { /* of the tables, um and rad: load on body (N, N m), platform */
    int body[2];
    double load[2][3];
    double exact[3]; /* geometrically exact beams */
} pose;

static const pose poses[] = {
    {{0, 4},
     {{0, 0, 1.5e-7}, {0, 0, 0.5e-7}},
     {-155.04022506993311, -21.8362154572784, 0.03650960718103183}},
    {{0, 4},
     {{0, 0, -3e-7}, {0, 0, 3e-7}},
     {1.3913825568937488, 81.44031273173971, -1.2500889802526859e-05}},
    {{2, 2},
     {{150e-6, 0, 0}, {0, 0, 0}},
     {160.238868236719, -6.057972332452664, -0.020282277220120427}},
    {{2, 2},
     {{0, 0, 3e-7}, {0, 0, 0}},
     {-40.30551076969056, -4.828665370104318, 0.10959798125006724}},
};

/* six flexures in two loops: the platform's pose; mirrored, with bodies named the other way round
   and first_is_a false, everything is mirrored */
static void six_bar_poses(void **state) {
    (void)state;
    for (int mirrored = 0; mirrored < 2; mirrored++)
        for (size_t i = 0; i < sizeof poses / sizeof poses[0]; i++) {
            const pose *t = &poses[i];
            double q[RIG_N], load[RIG_N] = {0}, s = mirrored ? -1 : 1;
            rig r;
            rig_six_bar(&r, mirrored);
            rig_compile(&r);
            rig_drawn(&r, q);
            for (int k = 0; k < 6; k++)
                load[3 * t->body[k / 3] + k % 3] += t->load[k / 3][k % 3] * (k % 3 == 1 ? 1 : s);
            rig_equilibrium(&r, load, 10, q);
            double x = s * (q[6] - r.body[2].x_m) * 1e6, y = (q[7] - r.body[2].y_m) * 1e6;
            assert_true(hypot(x - t->exact[0], y - t->exact[1]) < 3e-6);
            assert_near(s * q[8], t->exact[2], 4e-9);
            fw_arena_free(r.arena);
        }
}

/* hinges that were worked out together push with the bits of each alone, near rest and far from it */
static void beside_each_other(void **state) {
    (void)state;
    unsigned seed = 11;
    rig r;
    rig_six_bar(&r, false);
    rig_compile(&r);
    fw_effects_beside *beside;
    assert_int_equal(fw_effects_beside_new(r.arena, r.loads.nelement, r.loads.element, &beside),
                     FW_OK);
    assert_non_null(beside);
    for (int k = 0; k < 200; k++) {
        double p[6 * RIG_N], w[6] = {0, 1e-3, 20, 2e-3, 0, -20}, together[6 * RIG_N], alone[6];
        const double far = k % 4 ? 1 : 8;
        for (int i = 0; i < 6 * r.loads.nelement; i++)
            p[i] = far * (i % 3 == 2 ? 0.2 : 1e-6) * random_(&seed);
        fw_effects_beside_bend(beside, p);
        for (int pass = 0; pass < 2; pass++)
            for (int i = 0; i < r.loads.nelement; i++) {
                const fw_effects_force_element *e = &r.loads.element[i];
                const fw_effects_flexed *f = e->data;
                const fw_effects_port_state s = {.load = 1, .p = p + 6 * i, .w = w};
                assert_true(f->last->known);
                if (pass) f->last->known = false;
                e->class_->force(e, &s, pass ? alone : together + 6 * i);
                if (pass) assert_memory_equal(alone, together + 6 * i, sizeof alone);
            }
    }
    assert_int_equal(fw_effects_beside_new(r.arena, 1, r.loads.element, &beside), FW_OK);
    assert_null(beside); /* of one alone nothing is gained */
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(element_laws),
        cmocka_unit_test(released_once),
        cmocka_unit_test(six_bar_poses),
        cmocka_unit_test(beside_each_other),
    };
    return cmocka_run_group_tests_name("nonlinear-hinge", tests, NULL, NULL);
}
