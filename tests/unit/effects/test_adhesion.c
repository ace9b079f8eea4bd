/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces that have met: the pull that two cylinders bear, against the turning point of the force over the width of the
   touch that it comes from, looked for in steps; and what the ledger says. */
#include "base/constants.h"
#include "element_check.h"
#include "hinge_rigs.h"
#include <math.h>

/* least of P(a) = pi Ec a^2/(4 R) - (2 pi Ec a w)^(1/2), by golden section */
static double pulled_off(double modulus, double relative, double w) {
    double low = 0, high = 10 * cbrt(2 * w * relative * relative / (FW_PI * modulus));
    const double part = 0.5 * (sqrt(5) - 1);
    for (int i = 0; i < 200; i++) {
        double a = high - part * (high - low), b = low + part * (high - low);
        double at[2] = {a, b}, p[2];
        for (int k = 0; k < 2; k++)
            p[k] = FW_PI * modulus * at[k] * at[k] / (4 * relative) -
                   sqrt(2 * FW_PI * modulus * at[k] * w);
        if (p[0] < p[1])
            high = b;
        else
            low = a;
    }
    return sqrt(2 * FW_PI * modulus * low * w) - FW_PI * modulus * low * low / (4 * relative);
}

static void cylinders(void **state) {
    (void)state;
    static const struct {
        double E, nu, h, R, gap, w;
    } of[] = {{169e9, 0.06, 50e-6, 40e-6, 5e-6, 0.1},
              {115e9, 0.34, 9e-6, 25e-6, 10e-6, 1e-3},
              {150e9, 0, 400e-6, 60e-6, 2e-6, 0.3}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        double relative = of[i].R * (of[i].R + of[i].gap) / of[i].gap,
               modulus = of[i].E / (2 * (1 - of[i].nu * of[i].nu));
        assert_relative(
            fw_effects_adhesion_holds(of[i].E, of[i].nu, of[i].h, of[i].R, of[i].gap, of[i].w),
            of[i].h * pulled_off(modulus, relative, of[i].w), 1e-9);
    }
}

/* not called for where no flow says how surfaces hold; then the ratio of both forces where a gap may close */
static void in_the_ledger(void **state) {
    (void)state;
    rig r;
    fw_device_contact_use use = {.id = "touch",
                                 .joint = 0,
                                 .distance_m = 2e-6,
                                 .stiffness_N_per_m = 1e4,
                                 .damping_Ns_per_m = (double)NAN};
    rig_new(&r, 1, 1);
    r.body[0] = (fw_mechanism_mass){"lever", 1e-8, 1e-15, 1e-4, 2e-4, 0, {0, 0}};
    rig_hinge(&r, 0, "H", FW_GROUND, 0, (fw_geometry_vec2){1e-4, 2e-4}, 0.3, true);
    fw_mechanism_variant variant = *r.m.variant;
    r.m.variant = &variant;
    r.hinge[0].surface_radius_m = 40e-6;
    r.scene.contact = &use, r.scene.ncontact = 1;
    rig_compile(&r);
    variant.drying.adhesion_words = NULL;
    assert_false(fw_effect_adhesion.called_for(&r.c));
    variant.material.youngs.value = 150e9;
    variant.drying = (fw_mechanism_drying){.adhesion_words = "stated", .adhesion_high = 0.05};
    assert_true(fw_effect_adhesion.called_for(&r.c));
    const fw_effects_adhered a = fw_effects_adhesion_of(&r.c, &use, 0.05);
    assert_true(a.known && a.holds_N > 0 && a.opens_N > 0);
    double more = fw_effects_adhesion_of(&r.c, &use, 0.4).holds_N;
    assert_relative(more / a.holds_N, 4, 1e-9); /* w^(2/3) */
    use.joint = FW_NONE; /* two bodies: of what is put there the flow knows nothing, and of a hole no radius */
    use.undrawn = FW_UNDRAWN_PLACED;
    assert_false(fw_effect_adhesion.called_for(&r.c));
    use.undrawn = FW_UNDRAWN_NOT_SAID;
    assert_true(fw_effect_adhesion.called_for(&r.c));
    use.side = FW_CONTACT_INSIDE;
    assert_false(fw_effects_adhesion_of(&r.c, &use, 0.05).known);
    use.side = FW_CONTACT_OUTSIDE, use.face = true, use.distance_m = 50e-6;
    const double flat = fw_effects_adhesion_of(&r.c, &use, 0.05).holds_N,
                 nu = variant.material.poisson.unknown ? 0 : variant.material.poisson.value;
    assert_relative(flat, variant.thickness_m * pulled_off(150e9 / 2 / (1 - nu * nu), 50e-6, 0.05),
                    1e-9);
    use.face = false; /* two rounds of 25 um are as near as one of 12.5 um on a face */
    assert_relative(flat / fw_effects_adhesion_of(&r.c, &use, 0.05).holds_N, cbrt(4), 1e-9);
    use.distance_m = 0;
    assert_false(fw_effects_adhesion_of(&r.c, &use, 0.05).known);
    fw_arena_free(r.arena);
}

/* what is left of a contact, and how it goes with where its bodies are, by differences */
static void two_bodies(void **state) {
    (void)state;
    rig r;
    rig_new(&r, 2, 1);
    r.body[0] = (fw_mechanism_mass){"jaw", 1e-8, 1e-15, 1e-4, 2e-4, 0.3, {0, 0}};
    r.body[1] = (fw_mechanism_mass){"stop", 1e-8, 1e-15, 6e-4, 1e-4, -0.7, {0, 0}};
    for (int kind = 0; kind < 6; kind++) {
        const fw_device_contact_use use = {.joint = FW_NONE,
                                           .body_a = 0,
                                           .body_b = kind % 2 ? FW_GROUND : 1,
                                           .ax_m = 1e-4,
                                           .ay_m = -3e-5,
                                           .bx_m = 5e-5,
                                           .by_m = 7e-5,
                                           .face = kind / 2 == 0,
                                           .face_rad = 0.2,
                                           .side = kind / 2 == 2 ? FW_CONTACT_INSIDE
                                                                 : FW_CONTACT_OUTSIDE,
                                           .distance_m = 4e-5};
        double slope[6], q[6] = {1e-4, 2e-4, 0.3, 6e-4, 1e-4, -0.7};
        const double open = fw_effects_contact_open(&r.m, &use, NULL, slope);
        assert_relative(fw_effects_contact_open(&r.m, &use, q, NULL), open, 1e-12);
        for (int i = 0; i < 6; i++) {
            const double h = i % 3 == 2 ? 1e-5 : 1e-9, was = q[i];
            q[i] = was + h;
            const double up = fw_effects_contact_open(&r.m, &use, q, NULL);
            q[i] = was - h;
            const double down = fw_effects_contact_open(&r.m, &use, q, NULL);
            q[i] = was;
            assert_near(slope[i], (up - down) / (2 * h), i % 3 == 2 ? 1e-9 : 1e-4);
        }
    }
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(cylinders),
                                       cmocka_unit_test(in_the_ledger),
                                       cmocka_unit_test(two_bodies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
