/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a hinge is not linear, part by part, against the element's own force: opened by what the
   parts say, it carries the force that they were asked for, and its couples are theirs. */
#include "effects/modal.h"
#include "hinge_rigs.h"

static double random_(unsigned *seed) { /* in [-1, 1) */
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static void as_the_element(void **state) {
    (void)state;
    unsigned seed = 7;
    for (int i = 0; i < 400; i++) {
        rig r;
        rig_new(&r, 1, 1);
        r.body[0] = (fw_mechanism_mass){"lever", 1e-8, 8e-16, 5e-4, 1e-4, 0, {0, 0}};
        double axis = 3 * random_(&seed);
        rig_hinge(&r, 0, "H", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, axis, i % 2);
        if (i % 3 == 0) r.hinge[0].law.half_angle_rad = 0; /* a leaf: 1000 times as stiff along */
        rig_compile(&r);
        fw_effects_hinge_source h;
        fw_effects_hinge_source_of(&r.hinge[0], &h);
        double fe = 3e-4 * random_(&seed), fn = 3e-4 * random_(&seed), part[FW_HINGE_PARTS];
        double phi_a = 0.3 * random_(&seed), phi_b = 0.3 * random_(&seed), th = phi_b - phi_a;
        fw_effects_hinge_source_parts(&h, th, 0.5 * (phi_a + phi_b), fe, fn, part);
        double e = part[0] + h.softness_m_per_N[0] * fe, n = part[1] + h.softness_m_per_N[1] * fn;
        double c = cos(axis), s = sin(axis), w[6] = {0}, f[6];
        double p[6] = {0, 0, phi_a, c * e - s * n, s * e + c * n, phi_b};
        const fw_effects_port_state seen = {.load = 1, .p = p, .w = w};
        const fw_effects_force_element *element = &r.loads.element[0];
        element->class_->force(element, &seen, f);
        double K = r.hinge[0].law.stiffness_Nm_per_rad;
        assert_near(f[3], -(c * fe - s * fn), 1e-12);
        assert_near(f[4], -(s * fe + c * fn), 1e-12);
        assert_near(f[5], -K * th + part[2] + part[3], 1e-12 * K);
        assert_near(f[2], K * th - part[2] + part[3], 1e-12 * K);
        fw_arena_free(r.arena);
    }
}

/* nothing is left where nothing is turned; and only drift without force */
static void nothing_else(void **state) {
    (void)state;
    rig r;
    fw_effects_hinge_source h;
    fw_flexure_hinge_at law;
    double part[FW_HINGE_PARTS];
    rig_new(&r, 1, 1);
    rig_hinge(&r, 0, "H", FW_GROUND, 0, (fw_geometry_vec2){0, 0}, 0.4, true);
    fw_effects_hinge_source_of(&r.hinge[0], &h);
    fw_effects_hinge_source_parts(&h, 0, 0, 1e-9, 0, part);
    assert_near(part[0], 0, 1e-18);
    assert_near(part[1], 0, 1e-18);
    fw_effects_hinge_source_parts(&h, 0.1, 0, 0, 0, part);
    fw_flexure_hinge_law_at(&r.hinge[0].law, 0.1, &law);
    assert_near(part[1], law.drift_m.value, 1e-12 * law.drift_m.value);
    assert_true(part[0] == 0 && part[2] == 0 && part[3] == 0);
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_the_element),
        cmocka_unit_test(nothing_else),
    };
    return cmocka_run_group_tests_name("hinge_source", tests, NULL, NULL);
}
