/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces that displace flexures without a turn, as the angle that strains them as much. */
#include "effects/envelope.h"
#include "test.h"
#include <math.h>

static void all_of_the_force_through_the_softest_flexure(void **state) {
    (void)state;
    fw_mechanism_hinge hinge[2] = {
        {.scale = 1,
         .closed_form = {.kx_N_per_m = 50, .ky_N_per_m = 9000},
         .input = {.length_m = 4e-4}},
        {.scale = 2,
         .closed_form = {.kx_N_per_m = 70, .ky_N_per_m = 20},
         .input = {.length_m = 2e-4}},
    };
    fw_mechanism m = {.hinge = hinge, .nbody = 2, .nhinge = 2};
    fw_effects_envelope e = {.valid = true, .floor = 0.1};
    const fw_effect_case c = {.mechanism = &m, .envelope = &e};
    const double force[6] = {3e-6, 4e-6, 1, 0, -2e-6, 1}; /* couples displace nothing: 7 uN */
    const double softest = 6 / (2 * 20 * 2e-4);
    assert_near(fw_effects_envelope_displaced(&c, force, 1), 2 * 7e-6 * softest / 0.1, 1e-15);
    assert_true(isinf(fw_effects_envelope_displaced(&c, force, (double)INFINITY)));
    m.nhinge = 0;
    assert_true(fw_effects_envelope_displaced(&c, force, 1) == 0);
    e.valid = false;
    assert_true(isinf(fw_effects_envelope_displaced(&c, force, 1)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_of_the_force_through_the_softest_flexure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
