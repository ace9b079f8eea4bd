/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a closer look may decide, by every outcome that it may have: the utilisation moves by no
   more than the part of the band that goes away, and the band that stays is put about it again. */
#include "verdict/verdict_parts.h"
#include "test.h"
#include <math.h>

static double unit(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static fw_verdict_hinge_verdict hinge(double u, double numeric, double model, double lasting) {
    fw_verdict_hinge_verdict h = {.scene = "s",
                                  .utilisation = u,
                                  .numeric = numeric,
                                  .lasting = lasting,
                                  .lasting_low = lasting};
    h.utilisation_low = u * (1 - model) - numeric;
    h.utilisation_high = u * (1 + model) + numeric;
    h.decision = h.utilisation_low > 1    ? FW_REJECT
                 : h.utilisation_high < 1 ? FW_ACCEPT
                                          : FW_INCONCLUSIVE;
    return h;
}

/* some outcome is not inconclusive */
static bool decides(const fw_verdict_hinge_verdict *h, double moves, double stays) {
    for (int i = 0; i <= 400; i++) {
        double u = h->utilisation + moves * (i - 200) / 200.0;
        if (u * (1 + stays) < 1 || u * (1 - stays) > 1) return true;
    }
    return false;
}

static void no_outcome_is_missed(void **state) {
    (void)state;
    uint64_t seed = 7;
    int count[FW_VERDICT_LOOKS] = {0};
    for (int i = 0; i < 20000; i++) {
        double u = 0.8 + 0.4 * unit(&seed), model = 0.02 + 0.1 * unit(&seed);
        double numeric = pow(10, -6 + 5 * unit(&seed));
        double lasting = model * unit(&seed);
        fw_verdict_hinge_verdict h = hinge(u, numeric, model, lasting);
        if (h.decision != FW_INCONCLUSIVE) continue;
        fw_verdict_refinement refinement = fw_verdict_refinement_of(&h, 1);
        count[refinement]++;
        if (refinement == FW_REFINE_NUMBERS) {
            assert_true(numeric > 1e-5 && decides(&h, numeric, model));
        } else {
            if (numeric > 1e-5) assert_false(decides(&h, numeric * 0.999, model));
            bool better = decides(&h, (numeric + u * (model - lasting)) * 0.999, lasting);
            if (refinement == FW_REFINE_NOTHING) assert_false(better);
        }
    }
    for (int c = 0; c < FW_VERDICT_LOOKS; c++)
        assert_true(c == FW_REFINE_BEAMS ? count[c] == 0 : count[c] > 100);
}

/* one hinge that stays inconclusive spares the look at another, unless that one may be rejected */
static void all_hinges_count(void **state) {
    (void)state;
    fw_verdict_hinge_verdict two[2] = {hinge(1, 1e-6, 0.03, 0.03), hinge(0.975, 0.01, 0.02, 0.02)};
    assert_int_equal(fw_verdict_refinement_of(two, 1), FW_REFINE_NOTHING);
    assert_int_equal(fw_verdict_refinement_of(two + 1, 1), FW_REFINE_NUMBERS);
    assert_int_equal(fw_verdict_refinement_of(two, 2), FW_REFINE_NOTHING);
    two[1] = hinge(1.025, 0.01, 0.02, 0.02);
    assert_int_equal(fw_verdict_refinement_of(two, 2), FW_REFINE_NUMBERS);
    two[1] = hinge(0.975, 0.01, 0.02, 0.02);
    two[1].touches = true; /* solids that meet are no question of numbers */
    assert_int_equal(fw_verdict_refinement_of(two + 1, 1), FW_REFINE_NOTHING);
}

/* where the utilisation stays and numbers go with the accuracy, the one that is asked for decides
 */
static void enough_decides(void **state) {
    (void)state;
    uint64_t seed = 11;
    int count = 0;
    for (int i = 0; i < 20000; i++) {
        fw_verdict_hinge_verdict two[2];
        double numeric[2], model[2];
        for (int k = 0; k < 2; k++) {
            numeric[k] = pow(10, -4 + 3 * unit(&seed));
            model[k] = 0.02 + 0.1 * unit(&seed);
            two[k] = hinge(0.85 + 0.1 * unit(&seed), numeric[k], model[k], 0.01);
        }
        if (fw_verdict_refinement_of(two, 2) != FW_REFINE_NUMBERS) continue;
        double share = fw_verdict_enough(two, 2, 1e-3) / 1e-3;
        assert_true(share > 0 && share <= 1);
        bool decided = true, looser = true, stays = true;
        for (int k = 0; k < 2; k++) /* without numbers it would be accepted */
            stays &= two[k].utilisation * (1 + model[k]) < 1;
        if (!stays) continue;
        for (int k = 0; k < 2; k++) {
            double u = two[k].utilisation;
            decided &= hinge(u, share * numeric[k], model[k], 0.01).decision == FW_ACCEPT;
            looser &= hinge(u, 2.01 * share * numeric[k], model[k], 0.01).decision == FW_ACCEPT;
        }
        assert_true(decided && (!looser || share > 0.49));
        count++;
    }
    assert_true(count > 100);
}

/* what was found is not found again: there is no mechanism here to find it of */
static void a_slowest_period_is_kept(void **state) {
    (void)state;
    double kept[4] = {2e-3, -1, -1, -1}, period_s = 0;
    const fw_verdict_variant_verdict v = {.slowest_s = kept};
    assert_int_equal(fw_verdict_longest_period(NULL, &v, 0, false, &period_s), FW_OK);
    assert_near(period_s, 2e-3, 0);
    assert_int_equal(fw_verdict_longest_period(NULL, &v, 1, true, &period_s), FW_OK); /* nothing swings */
    assert_near(period_s, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_outcome_is_missed),
                                       cmocka_unit_test(a_slowest_period_is_kept),
                                       cmocka_unit_test(enough_decides),
                                       cmocka_unit_test(all_hinges_count)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
