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
    use.joint = FW_NONE;
    assert_false(fw_effect_adhesion.called_for(&r.c));
    assert_false(fw_effects_adhesion_of(&r.c, &use, 0.05).known);
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(cylinders),
                                       cmocka_unit_test(in_the_ledger)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
