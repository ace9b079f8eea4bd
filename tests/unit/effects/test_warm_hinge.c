/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hinges that give, at another temperature: all that they store goes with Young's modulus. */
#include "quantity/law_kind.h"
#include "element_check.h"
#include "hinge_rigs.h"

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static void one_hinge(rig *r, int i, unsigned *seed) {
    rig_new(r, 2, 1);
    r->body[0] = (fw_mechanism_mass){"a", 1e-8, 1e-15, 1e-4, 2e-4, 0.3, {0, 0}};
    r->body[1] = (fw_mechanism_mass){"b", 1e-8, 1e-15, -1e-4, 3e-4, -0.2, {0, 0}};
    rig_hinge(r, 0, "H", 0, 1, (fw_geometry_vec2){1e-4, 1e-4}, 4 * random_(seed), i % 2 == 0);
    r->pin[0].free_angle_rad = 0.05;
    r->pin[0].damping_Nms_per_rad = i % 3 == 0 ? 0 : 1e-10;
}

static void warm(rig *r) {
    assert_true(fw_effect_temperature.called_for(&r->c));
    assert_int_equal(fw_effect_temperature.add(&r->c, &r->loads), FW_OK);
}

/* A constant one and one that goes with time; force, energy and tangent are those of the cold hinge
   times 1 + beta (dT1 + dT2 law) at rest, and the dampers' forces stay. */
static void follows_the_modulus(void **state) {
    (void)state;
    static const fw_quantity_law sine = {.kind = &fw_quantity_law_sine,
                                         .end_s = (double)INFINITY,
                                         .frequency_Hz = 3e3,
                                         .phase_rad = 0.4};
    unsigned seed = 3;
    for (int i = 0; i < 40; i++) {
        rig cold, now;
        unsigned same = seed;
        one_hinge(&cold, i, &seed);
        one_hinge(&now, i, &same);
        fw_device_temperature t[2] = {
            {.change_K = 100, .modulus_change_per_K = -2e-3},
            {.change_K = 200, .modulus_change_per_K = 1e-3, .law = &sine}};
        now.scene.temperature = t, now.scene.ntemperature = 2;
        rig_compile(&cold);
        rig_compile(&now);
        warm(&now);
        assert_int_equal(now.loads.nelement, 1);
        const fw_effects_force_element *e = now.loads.element, *was = cold.loads.element;
        assert_true(e->works && e->laws == 1 && e->law[0] == &sine && !was->works);
        assert_int_equal(e->dissipates, i % 3 != 0);
        double p[6], w[6], f[6], g[6], still[6] = {0}, k[36], l[36], c[36], d[36];
        for (int j = 0; j < 6; j++) {
            p[j] = (j % 3 == 2 ? 0.4 : 4e-6) * random_(&seed);
            w[j] = (j % 3 == 2 ? 300 : 4e-2) * random_(&seed);
        }
        double at = 1e-5 * i, factor = 1 - 0.2 + 0.2 * sin(6e3 * M_PI * at + 0.4);
        fw_effects_port_state s = {.t_s = at, .piece_s = at + 1e-6, .load = 1, .p = p, .w = w};
        fw_check_tangent(e, &s, 2e-8, 1e-3, 1e-7);
        fw_check_power(e, &s, 1e-7, 1e-7);
        fw_check_balance(e, &s, 1e-11);
        assert_relative(e->class_->energy(e, &s), factor * was->class_->energy(was, &s), 1e-13);
        e->class_->tangent(e, &s, k, c), was->class_->tangent(was, &s, l, d);
        for (int j = 0; j < 36; j++)
            assert_near(c[j], d[j], 1e-12 * fabs(d[j]));
        e->class_->force(e, &s, f), was->class_->force(was, &s, g);
        double damped[6], size = 0;
        for (int j = 0; j < 6; j++)
            damped[j] = g[j], size = fmax(size, fabs(g[j]));
        s.w = still;
        was->class_->force(was, &s, g);
        for (int j = 0; j < 6; j++) /* what is left of the warm one is the cold one's damping */
            assert_near(f[j] - factor * g[j], damped[j] - g[j], 1e-12 * size);
        fw_arena_free(cold.arena), fw_arena_free(now.arena);
    }
}

/* without a law nothing of it is fed in from outside; hinges that do not give are the springs' */
static void constant_one(void **state) {
    (void)state;
    rig r;
    unsigned seed = 5;
    one_hinge(&r, 1, &seed);
    fw_device_temperature t = {.change_K = 100, .modulus_change_per_K = -2e-3};
    r.scene.temperature = &t, r.scene.ntemperature = 1;
    rig_compile(&r);
    double size = r.loads.element[0].size_N_per_m;
    warm(&r);
    assert_true(!r.loads.element[0].works && r.loads.element[0].laws == 0);
    assert_relative(r.loads.element[0].size_N_per_m, 0.8 * size, 1e-14);
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(follows_the_modulus),
                                       cmocka_unit_test(constant_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
