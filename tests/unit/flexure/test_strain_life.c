/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/flexure.h"
#include "test.h"

static const fw_flexure_strain_life basquin = {
    .known = true, .amplitude_Pa = 110e6, .cycles = 1e7, .exponent = -0.1, .youngs_Pa = 115e9};

static fw_flexure_strain_life both(void) {
    fw_flexure_strain_life law = basquin;
    law.ductility = 0.3;
    law.ductility_exponent = -0.51;
    return law;
}

static void basquin_is_a_line(void **state) {
    (void)state;
    assert_relative(fw_flexure_strain_life_amplitude_Pa(&basquin, 1e7), 110e6, 1e-15);
    /* a decade fewer cycles bear 10^0.1 as much, half the amplitude lasts 2^10 as long */
    assert_relative(fw_flexure_strain_life_amplitude_Pa(&basquin, 1e6), 110e6 * 1.2589254117941673,
                    1e-14);
    assert_relative(fw_flexure_strain_life_cycles(&basquin, 55e6), 1024e7, 1e-12);
    assert_true(isinf(fw_flexure_strain_life_cycles(&basquin, 0)));
}

/* both terms as they are written in books: sigma_f'/E (2N)^b + eps_f' (2N)^c, and their sum at N1
   is what was stated */
static void both_terms_add(void **state) {
    (void)state;
    const fw_flexure_strain_life law = both();
    assert_relative(fw_flexure_strain_life_amplitude_Pa(&law, 1e7), 110e6, 1e-14);
    double plastic = 0.3 * pow(2e7, -0.51), sigma_f = (110e6 - 115e9 * plastic) / pow(2e7, -0.1);
    assert_true(plastic * 115e9 > 5e6 && plastic * 115e9 < 8e6);
    for (double n = 10; n < 1e9; n *= 9)
        assert_relative(fw_flexure_strain_life_amplitude_Pa(&law, n),
                        sigma_f * pow(2 * n, -0.1) + 115e9 * 0.3 * pow(2 * n, -0.51), 1e-12);
}

static void life_is_the_inverse(void **state) {
    (void)state;
    const fw_flexure_strain_life laws[] = {basquin, both()};
    for (int i = 0; i < 2; i++)
        for (double n = 1; n < 1e14; n *= 3.7) {
            double s = fw_flexure_strain_life_amplitude_Pa(&laws[i], n);
            assert_relative(fw_flexure_strain_life_cycles(&laws[i], s), n, 1e-9);
            assert_relative(fw_flexure_strain_life_cycles(&laws[i], -s), n, 1e-9);
        }
}

static void more_cycles_bear_less(void **state) {
    (void)state;
    const fw_flexure_strain_life laws[] = {basquin, both()};
    for (int i = 0; i < 2; i++)
        for (double n = 1; n < 1e14; n *= 1.9)
            assert_true(fw_flexure_strain_life_amplitude_Pa(&laws[i], 1.9 * n) <
                        fw_flexure_strain_life_amplitude_Pa(&laws[i], n));
}

/* fully reversed: itself; from 0 to sigma: sigma/sqrt 2; the sign of the mean does not matter */
static void mean_stress(void **state) {
    (void)state;
    assert_relative(fw_flexure_equivalent_amplitude_Pa(80e6, 0), 80e6, 1e-15);
    assert_relative(fw_flexure_equivalent_amplitude_Pa(50e6, 50e6), 100e6 / sqrt(2), 1e-15);
    assert_near(fw_flexure_equivalent_amplitude_Pa(50e6, -20e6),
                fw_flexure_equivalent_amplitude_Pa(50e6, 20e6), 0);
    assert_true(fw_flexure_equivalent_amplitude_Pa(50e6, 20e6) > 50e6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(basquin_is_a_line),   cmocka_unit_test(both_terms_add),
        cmocka_unit_test(life_is_the_inverse), cmocka_unit_test(more_cycles_bear_less),
        cmocka_unit_test(mean_stress),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
