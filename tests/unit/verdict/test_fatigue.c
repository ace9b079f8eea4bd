/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/strain.h"
#include "test.h"

static const fw_flexure_strain_life basquin = {
    .known = true, .amplitude_Pa = 110e6, .cycles = 1e7, .exponent = -0.1, .youngs_Pa = 115e9};
static const fw_flexure_strain_life both = {.known = true,
                                            .amplitude_Pa = 110e6,
                                            .cycles = 1e7,
                                            .exponent = -0.1,
                                            .youngs_Pa = 115e9,
                                            .ductility = 0.3,
                                            .ductility_exponent = -0.51};

/* n cycles of one amplitude: n/N, and 1 at their life */
static void miner_of_one_amplitude(void **state) {
    (void)state;
    const fw_flexure_strain_life *const laws[] = {&basquin, &both};
    for (int i = 0; i < 2; i++) {
        fw_maths_cycle c[3] = {{240e6, 0, 1}, {240e6, 0, 1}, {240e6, 0, 0.5}};
        double life = fw_flexure_strain_life_cycles(laws[i], 120e6);
        assert_relative(fw_verdict_miner(laws[i], c, 3, 1000, 1), 2500 / life, 1e-12);
        assert_relative(fw_verdict_miner(laws[i], c, 2, 0.5 * life, 1), 1, 1e-12);
        /* a mean stress makes it worse by sqrt(1 + mean/amplitude) in amplitude */
        c[0].mean = 120e6;
        assert_relative(fw_verdict_miner(laws[i], c, 1, 7, 1),
                        7 / fw_flexure_strain_life_cycles(laws[i], 120e6 * sqrt(2)), 1e-12);
    }
    const fw_maths_cycle c = {240e6, 0, 1}; /* by hand: (120/110)^10/1e7 a cycle */
    assert_relative(fw_verdict_miner(&basquin, &c, 1, 1, 1), pow(12.0 / 11.0, 10) * 1e-7, 1e-12);
}

/* of one amplitude: needed over allowable at that number of cycles, whatever the law */
static void utilisation_is_amplitude_over_allowable(void **state) {
    (void)state;
    const fw_flexure_strain_life *const laws[] = {&basquin, &both};
    for (int i = 0; i < 2; i++)
        for (double n = 1e3; n < 1e12; n *= 31)
            for (double s = 10e6; s < 500e6; s *= 2.3) {
                const fw_maths_cycle c = {2 * s, 0, 1};
                assert_relative(fw_verdict_fatigue_utilisation(laws[i], &c, 1, n),
                                s / fw_flexure_strain_life_amplitude_Pa(laws[i], n), 1e-9);
            }
}

static double uniform(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

/* by its own definition: all stresses over the utilisation, the sum is 1. It goes with the stress,
   and rises with every repetition and every cycle more */
static void utilisation_of_random_cycles(void **state) {
    (void)state;
    uint64_t seed = 11;
    for (int round = 0; round < 300; round++) {
        const fw_flexure_strain_life *law = round % 2 ? &both : &basquin;
        fw_maths_cycle c[12], twice[12];
        size_t n = 1 + (size_t)(uniform(&seed) * 12);
        for (size_t i = 0; i < n; i++) {
            c[i] = (fw_maths_cycle){exp(12 + 8 * uniform(&seed)), 2e8 * (uniform(&seed) - 0.5), 1};
            twice[i] = (fw_maths_cycle){2 * c[i].range, 2 * c[i].mean, 1};
        }
        double times = exp(25 * uniform(&seed)),
               u = fw_verdict_fatigue_utilisation(law, c, n, times);
        assert_relative(fw_verdict_miner(law, c, n, times, 1 / u), 1, 1e-8);
        assert_relative(fw_verdict_fatigue_utilisation(law, twice, n, times), 2 * u, 1e-8);
        assert_true(fw_verdict_fatigue_utilisation(law, c, n, 1.5 * times) > u);
        if (n > 1)
            assert_true(fw_verdict_fatigue_utilisation(law, c, n - 1, times) <= u * (1 + 1e-9));
    }
    const fw_maths_cycle nothing = {0, 0, 1};
    assert_near(fw_verdict_fatigue_utilisation(&basquin, &nothing, 1, 1e6), 0, 0);
    assert_near(fw_verdict_fatigue_utilisation(&basquin, &nothing, 0, 1e6), 0, 0);
}

/* ten turns to and fro of strain 1e-3 about 0 on one root, about 5e-4 on the other, which is worse
 */
static void a_history_of_two_roots(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_maths_turning root[FW_FACES] = {
        {.gate = 1e-6}, {.gate = 1e-6}, {.gate = 1e-6}, {.gate = 1e-6}};
    for (int i = 0; i <= 2000; i++) {
        double t = i / 2000.0, s = sin(2 * acos(-1.0) * 10 * t);
        fw_maths_turning_add(&root[0], arena, t, 1e-3 * s);
        fw_maths_turning_add(&root[1], arena, t, 1e-3 * s + 5e-4);
    }
    fw_verdict_fatigue f;
    assert_int_equal(fw_verdict_fatigue_of(arena, &basquin, root, 0, 115e9, 1e5, NULL, &f), FW_OK);
    double worse = 115e6 * sqrt(1.5);
    assert_near(f.cycles, 10, 0);
    assert_relative(f.utilisation, worse / fw_flexure_strain_life_amplitude_Pa(&basquin, 1e6),
                    1e-5);
    assert_relative(f.damage, 1e6 / fw_flexure_strain_life_cycles(&basquin, worse), 1e-4);
    fw_arena_free(arena);
}

/* amplitudes that fall by d from swing to swing: Miner's sum is that of the first over 1 - exp(-m d), m = 10 of Basquin's law,
   each block by its middle; one that carries another, twice as fast and damped alike, begins with both */
static void rings_out(void **state) {
    (void)state;
    fw_maths_cycle c[FW_RING_BLOCKS];
    const double m = -1 / basquin.exponent;
    for (double d = 1e-6; d < 1; d *= 7) {
        const fw_verdict_after after = {.rest = 0, .ring = {{0.5, d, 100}}, .n = 1};
        const size_t n = fw_verdict_rung_out(&after, 0, 2e8, c);
        const fw_maths_cycle first = {2e8 * exp(-0.5 * d), 0, 1};
        const double whole = fw_verdict_miner(&basquin, &first, 1, 1, 1) / (1 - exp(-m * d));
        assert_relative(fw_verdict_miner(&basquin, c, n, 1, 1), whole, 0.01);
    }
    const fw_verdict_after two = {.rest = 0.25, .ring = {{0.4, 1e-3, 100}, {0.1, 1e-3, 200}}, .n = 2};
    assert_true(fw_verdict_rung_out(&two, 0, 1e8, c) > 100);
    assert_relative(c[0].range, 1e8 * (0.8 * exp(-0.01) + 0.2 * exp(-0.02)), 1e-12);
    assert_relative(c[0].mean, 0.25e8, 1e-12);
    fw_verdict_rung_out(&two, 1, 1e8, c);
    assert_relative(c[0].range, 0.2e8 * exp(-0.01), 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(miner_of_one_amplitude),
        cmocka_unit_test(utilisation_is_amplitude_over_allowable),
        cmocka_unit_test(utilisation_of_random_cycles),
        cmocka_unit_test(a_history_of_two_roots),
        cmocka_unit_test(rings_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
