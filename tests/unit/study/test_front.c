/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is worth its cost, on made-up numbers whose answer is known. */
#include "study/tradeoff.h"
#include "test.h"

/* a deterministic generator: numerical recipes' 64-bit LCG */
static double uniform(uint64_t *s) {
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return (double)(*s >> 11) * 0x1p-53;
}

static void by_hand(void **state) {
    (void)state;
    const double cost[] = {1, 2, 2, 3, 4, 4, (double)NAN, 9, 0.5};
    const double error[] = {1e-2, 1e-3, 1e-4, 1e-4, 1e-6, 1e-6, 1e-9, (double)NAN, 0};
    const bool want[] = {true, false, true, false, true, false, false, false, false};
    bool front[9];
    fw_study_front_mark(cost, error, 9, front);
    for (int i = 0; i < 9; i++)
        if (front[i] != want[i]) fail_msg("point %d", i);
}

/* the definition, pair by pair: nothing on the front is beaten, and what is not on it is */
static void of_random_clouds(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int trial = 0; trial < 200; trial++) {
        double cost[40], error[40];
        bool front[40];
        int n = 1 + trial % 40, members = 0;
        for (int i = 0; i < n; i++) {
            cost[i] = 1 + floor(20 * uniform(&seed)); /* joints happen */
            error[i] = pow(10, -floor(12 * uniform(&seed)));
        }
        fw_study_front_mark(cost, error, n, front);
        for (int i = 0; i < n; i++) {
            bool beaten = false, twin = false;
            for (int k = 0; k < n; k++) {
                bool no_worse = cost[k] <= cost[i] && error[k] <= error[i];
                beaten |= no_worse && (cost[k] < cost[i] || error[k] < error[i]);
                twin |= k < i && cost[k] == cost[i] && error[k] == error[i];
            }
            assert_int_equal(front[i], !beaten && !twin);
            members += front[i];
        }
        assert_true(members >= 1);
    }
}

/* cost = c e^-s: a digit costs 10^s, here and on average */
static void a_power_law(void **state) {
    (void)state;
    double cost[9], error[9];
    bool front[9];
    for (int i = 0; i < 9; i++)
        error[i] = pow(10, -2 - i), cost[i] = 3e6 * pow(error[i], -0.125);
    fw_study_front_mark(cost, error, 9, front);
    assert_relative(fw_study_front_digit(cost, error, front, 9), pow(10, 0.125), 1e-12);
    assert_relative(fw_study_front_cost(cost, error, front, 9, 3e-5), 3e6 * pow(3e-5, -0.125),
                    1e-12);
    assert_relative(fw_study_front_cost(cost, error, front, 9, 1), cost[0], 0);
    assert_true(isnan(fw_study_front_cost(cost, error, front, 9, 1e-11)));
    front[0] = true;
    for (int i = 1; i < 9; i++)
        front[i] = false;
    assert_true(isnan(fw_study_front_digit(cost, error, front, 9)));
}

static void orders(void **state) {
    (void)state;
    double work[7], error[7];
    for (int i = 0; i < 7; i++)
        work[i] = 100 * pow(1.7, i), error[i] = 5 * pow(work[i], -5);
    assert_relative(fw_study_front_order(work, error, 7, 0), 5, 1e-10);
    error[6] = 1e-15, error[5] = 2e-15; /* round-off does not count */
    assert_relative(fw_study_front_order(work, error, 7, 3e-15), 5, 1e-10);
    assert_true(isnan(fw_study_front_order(work, error, 2, 0)));
    error[1] = (double)NAN;
    assert_relative(fw_study_front_order(work, error, 5, 0), 5, 1e-10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(of_random_clouds),
        cmocka_unit_test(a_power_law),
        cmocka_unit_test(orders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
