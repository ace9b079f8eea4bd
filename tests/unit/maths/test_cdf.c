/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distribution functions against closed forms and digits that were computed with 50 digits elsewhere. */
#include "maths/functions.h"
#include "test.h"

/* the doubles nearest to Phi(u), by its series and its continued fraction with 60 decimal digits */
static const struct {
    double u, p;
} row[] = {{-1, 0.15865525393145705},   {-2, 0.022750131948179207},    {-3, 0.0013498980316300946},
           {-5, 2.8665157187919391e-7}, {-8, 6.2209605742717841e-16},  {-0.1, 0.46017216272297101},
           {1, 0.84134474606854295},    {-37, 5.7255712225245768e-300}};

static void normal(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        assert_relative(fw_maths_normal_cdf(row[i].u), row[i].p, 1e-14);
        if (row[i].p < 0.5) {
            assert_relative(fw_maths_normal_quantile(row[i].p), row[i].u, 2e-15);
            assert_relative(fw_maths_normal_upper(row[i].p), -row[i].u, 2e-15);
        }
    }
    assert_near(fw_maths_normal_quantile(0.5), 0, 0);
    assert_near(fw_maths_normal_quantile(0.975), 1.9599639845400542, 2e-15);
    assert_near(fw_maths_normal_density(1.5), 0.12951759566589174, 1e-16);
}

/* there and back, in the middle and in both tails */
static void normal_inverse(void **state) {
    (void)state;
    for (double u = -8; u <= 0; u += 0.01)
        assert_near(fw_maths_normal_quantile(fw_maths_normal_cdf(u)), u, 4e-15 * (0.25 - u));
}

static void gamma_roots(void **state) {
    (void)state;
    for (double p = 1e-6; p < 1; p = p < 0.4 ? p * 3 : p + 0.1) /* shape 1: 1 - exp(-x) */
        assert_relative(fw_maths_gamma_quantile(p, 1), -log1p(-p), 1e-9);
    assert_relative(2 * fw_maths_gamma_quantile(0.95, 0.5), 3.841458820694124,
                    1e-9); /* 1.95996^2 */
    assert_relative(2 * fw_maths_gamma_quantile(0.025, 5), 3.2469727802368413, 1e-9);
    assert_relative(fw_maths_gamma_quantile(0.5, 1e6), 1e6 - 1.0 / 3, 1e-9);
}

static void beta_roots(void **state) {
    (void)state;
    for (double p = 1e-4; p < 1; p += 0.0999) { /* (1, n): 1 - (1 - x)^n; (n, 1): x^n */
        assert_relative(fw_maths_beta_quantile(p, 1, 20000), -expm1(log1p(-p) / 20000), 1e-9);
        assert_relative(fw_maths_beta_quantile(p, 30, 1), pow(p, 1.0 / 30), 1e-9);
    }
    assert_relative(fw_maths_beta_quantile(0.5, 7, 7), 0.5, 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(normal), cmocka_unit_test(normal_inverse),
                                       cmocka_unit_test(gamma_roots), cmocka_unit_test(beta_roots)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
