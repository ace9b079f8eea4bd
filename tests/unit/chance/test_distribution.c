/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each kind: there and back, moments by quadrature, what is refused. */
#include "chance/joint.h"
#include "maths/functions.h"
#include "chance_test.h"

static const double table_x[] = {1, 2, 4, 4.5}, table_p[] = {0, 0.25, 0.5, 1};
#define INFINITE ((double)INFINITY)
static const fw_chance_distribution kinds[] = {
    {.kind = FW_CHANCE_CONSTANT, .mean = 3},
    {.kind = FW_CHANCE_NORMAL, .mean = -2, .sd = 0.5},
    {.kind = FW_CHANCE_LOGNORMAL, .mean = 3, .sd = 1.2},
    {.kind = FW_CHANCE_UNIFORM, .low = 1, .high = 5},
    {.kind = FW_CHANCE_TRUNCATED, .mean = 1, .sd = 2, .low = 0.5, .high = 4},
    {.kind = FW_CHANCE_TRUNCATED, .mean = 0, .sd = 1, .low = 6, .high = 6.5},
    {.kind = FW_CHANCE_TRUNCATED, .mean = 0, .sd = 1, .low = -INFINITE, .high = 1},
    {.kind = FW_CHANCE_TABLE, .count = 4, .x = table_x, .p = table_p},
    {.kind = FW_CHANCE_INTERVAL, .low = 2, .high = 3},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void there_and_back(void **state) {
    (void)state;
    for (size_t k = 1; k < KINDS; k++) {
        const char *why = NULL;
        assert_int_equal(fw_chance_distribution_check(arena, &kinds[k], &why), FW_OK);
        double before = -INFINITE;
        for (double u = -5; u <= 5; u += 0.01) {
            double x = fw_chance_distribution_value(&kinds[k], u), p = fw_maths_normal_cdf(u);
            assert_true(x >= before);
            /* near an end of 6 a unit of the last digit, 9e-16, is 2e-8 of the distance 5e-8 from there */
            assert_relative(fw_chance_distribution_cdf(&kinds[k], x), p, 1e-7);
            assert_near(fw_chance_distribution_quantile(&kinds[k], p), x, 1e-9 * (1e-3 + fabs(x)));
            before = x;
        }
    }
}

/* the mean and the variance as integrals over u */
static void moments(void **state) {
    (void)state;
    for (size_t k = 0; k < KINDS; k++) {
        double mean = 0, square = 0, h = 1.0 / 512, want = fw_chance_distribution_mean(&kinds[k]);
        for (double u = -10; u <= 10; u += h)
            mean += h * fw_maths_normal_density(u) * fw_chance_distribution_value(&kinds[k], u);
        for (double u = -10; u <= 10; u += h) {
            double off = fw_chance_distribution_value(&kinds[k], u) - want;
            square += h * fw_maths_normal_density(u) * off * off;
        }
        assert_near(mean, want, 1e-6);
        assert_near(sqrt(square), fw_chance_distribution_sd(&kinds[k]), 1e-5);
    }
}

static void known(void **state) {
    (void)state;
    assert_relative(fw_chance_distribution_value(&kinds[2], 0), 3 / sqrt(1 + 0.16),
                    1e-14); /* the median */
    assert_near(fw_chance_distribution_quantile(&kinds[3], 0.25), 2, 1e-15);
    assert_near(fw_chance_distribution_quantile(&kinds[7], 0.375), 3, 1e-14);
    assert_near(fw_chance_distribution_mean(&kinds[6]), -0.24197072451914337 / 0.84134474606854293,
                1e-14);
    /* in the tail beyond 6 the density falls as exp(-6 x): median 6 + 0.1127 */
    double median = fw_chance_distribution_value(&kinds[5], 0);
    assert_relative(fw_maths_normal_cdf(-median),
                    (fw_maths_normal_cdf(-6) + fw_maths_normal_cdf(-6.5)) / 2, 1e-13);
    /* 8 standard deviations out, above, the uniform's distance from its end is kept */
    assert_relative(1 - fw_chance_distribution_value(
                            &(fw_chance_distribution){.kind = FW_CHANCE_UNIFORM, .high = 1}, 6),
                    9.8658764503769458e-10, 1e-6);
    assert_near(fw_chance_distribution_cdf(&kinds[0], 2.9), 0, 0);
    assert_near(fw_chance_distribution_cdf(&kinds[0], 3), 1, 0);
    assert_near(fw_chance_distribution_cdf(&kinds[2], -1), 0, 0);
    assert_near(fw_chance_distribution_cdf(&kinds[7], 9), 1, 0);
    assert_near(fw_chance_distribution_cdf(&kinds[5], 5), 0, 0);
}

static void refused(void **state) {
    (void)state;
    static const double falling[] = {0, 2, 1}, rising[] = {0, 0.5, 1}, late[] = {0.1, 0.5, 1},
                        early[] = {0, 0.5, 0.9};
    double nothing = (double)NAN;
    const struct {
        fw_chance_distribution d;
        const char *says;
    } row[] = {{{.kind = FW_CHANCE_CONSTANT, .mean = nothing}, "not finite"},
               {{.kind = FW_CHANCE_NORMAL, .mean = 1}, "standard deviation"},
               {{.kind = FW_CHANCE_NORMAL, .mean = 1, .sd = nothing}, "standard deviation"},
               {{.kind = FW_CHANCE_LOGNORMAL, .mean = -1, .sd = 1}, "above 0"},
               {{.kind = FW_CHANCE_UNIFORM, .low = 2, .high = 2}, "lower end"},
               {{.kind = FW_CHANCE_TRUNCATED, .sd = 0, .low = 1, .high = 2}, "standard deviation"},
               {{.kind = FW_CHANCE_TRUNCATED, .sd = 1, .low = 3, .high = 2}, "lower end"},
               {{.kind = FW_CHANCE_TRUNCATED, .sd = 1, .low = 50, .high = 51}, "leave nothing"},
               {{.kind = FW_CHANCE_TABLE, .count = 1, .x = rising, .p = rising}, "two rows"},
               {{.kind = FW_CHANCE_TABLE, .count = 3, .x = falling, .p = rising},
                "values of the table do not rise"},
               {{.kind = FW_CHANCE_TABLE, .count = 3, .x = rising, .p = falling},
                "probabilities of the table do not"},
               {{.kind = FW_CHANCE_TABLE, .count = 3, .x = rising, .p = late}, "first probability"},
               {{.kind = FW_CHANCE_TABLE, .count = 3, .x = rising, .p = early}, "last probability"},
               {{.kind = FW_CHANCE_TABLE, .count = 2, .x = (double[]){0, INFINITE}, .p = rising},
                "not finite"},
               {{.kind = FW_CHANCE_INTERVAL, .low = 1, .high = 0}, "interval"}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        const char *why = NULL;
        assert_int_equal(fw_chance_distribution_check(arena, &row[i].d, &why), FW_INPUT);
        assert_non_null(strstr(why, row[i].says));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(there_and_back), cmocka_unit_test(moments),
                                       cmocka_unit_test(known), cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
