/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Medians and their intervals, against tables and distributions whose median is known. */
#include "study/tradeoff.h"
#include "test.h"

static double uniform(uint64_t *s) {
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 11) + 0.5) * 0x1p-53;
}

/* Conover, Practical Nonparametric Statistics, table A3: ranks of the 95 % interval of a median */
static void ranks(void **state) {
    (void)state;
    static const int row[][2] = {{5, 0},  {6, 1},  {8, 1},  {9, 2},  {11, 2},
                                 {12, 3}, {15, 4}, {20, 6}, {21, 6}, {25, 8}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double sample[32];
        int n = row[i][0], rank = row[i][1];
        for (int k = 0; k < n; k++)
            sample[k] = k + 1;
        fw_study_median m = fw_study_median_of(sample, n);
        assert_true(rank == 0 ? isnan(m.low) && isnan(m.high)
                              : m.low == rank && m.high == n + 1 - rank);
    }
}

static void plain(void **state) {
    (void)state;
    double odd[] = {3, 1, 2, 9, 5, 7, 4}, even[] = {4, 1, 3, 2}, one[] = {5};
    fw_study_median m = fw_study_median_of(odd, 7);
    assert_near(m.value, 4, 0);
    assert_near(m.low, 1, 0);
    assert_near(m.high, 9, 0);
    m = fw_study_median_of(even, 4);
    assert_near(m.value, 2.5, 0);
    assert_true(isnan(m.low) && !fw_study_median_told(&m));
    m = fw_study_median_of(one, 1);
    assert_near(m.value, 5, 0);
    m = fw_study_median_of(one, 0);
    assert_true(isnan(m.value) && !fw_study_median_told(&m));
}

/* with normal, exponential and Cauchy samples (which have no mean) the interval holds the median in
   at least 95 % of 4000 trials, less three standard deviations; and not nearly always: it is no
   wider than it must be (98.1 % for 25 samples is the most that ranks next to each other allow) */
static void coverage(void **state) {
    (void)state;
    static const double pi = 3.141592653589793, median[] = {0, 0.6931471805599453, 0};
    uint64_t seed = 11;
    for (int kind = 0; kind < 3; kind++) {
        enum { TRIALS = 4000, N = 25 };
        int held = 0;
        for (int trial = 0; trial < TRIALS; trial++) {
            double x[N];
            for (int i = 0; i < N; i++) {
                double u = uniform(&seed), v = uniform(&seed);
                x[i] = kind == 0   ? sqrt(-2 * log(u)) * cos(2 * pi * v)
                       : kind == 1 ? -log(u)
                                   : tan(pi * (u - 0.5));
            }
            fw_study_median m = fw_study_median_of(x, N);
            held += m.low <= median[kind] && median[kind] <= m.high;
        }
        double share = held / (double)TRIALS;
        if (share < 0.95 - 0.0104 || share > 0.981) fail_msg("kind %d: %.4f", kind, share);
    }
}

/* a time that one in three looks doubles is not told; one with a few outliers is */
static void refusal(void **state) {
    (void)state;
    uint64_t seed = 3;
    double noisy[25], calm[25];
    for (int i = 0; i < 25; i++) {
        noisy[i] = 1 + uniform(&seed);
        calm[i] = (i % 6 == 5 ? 30 : 1) * (1 + 0.02 * uniform(&seed));
    }
    fw_study_median m = fw_study_median_of(noisy, 25);
    assert_false(fw_study_median_told(&m));
    m = fw_study_median_of(calm, 25);
    assert_true(fw_study_median_told(&m));
    assert_near(m.value, 1.01, 0.011);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranks),
        cmocka_unit_test(plain),
        cmocka_unit_test(coverage),
        cmocka_unit_test(refusal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
