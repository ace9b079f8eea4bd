/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/functions.h"
#include "test.h"

static int calls;
static double cubic(const void *context, double x) {
    calls++;
    return x * x * x - *(const double *)context;
}
static double kink(const void *context, double x) {
    (void)context;
    calls++;
    return x < 0.3 ? -1 : 1;
}
static double flat(const void *context, double x) {
    (void)context;
    calls++;
    return pow(x - 0.7, 9);
}

static void test_roots(void **state) {
    (void)state;
    for (double a = 0.001; a < 1000; a *= 1.7) {
        calls = 0;
        assert_near(fw_maths_brent_root(cubic, &a, 0, 20, 1e-13), cbrt(a), 1e-12 * (1 + cbrt(a)));
        assert_true(calls < 60);
        assert_near(fw_maths_brent_root(cubic, &a, 20, 0, 1e-13), cbrt(a), 1e-12 * (1 + cbrt(a)));
    }
    calls = 0;
    assert_near(fw_maths_brent_root(kink, NULL, -4, 5, 1e-12), 0.3, 1e-11); /* bisection does it */
    assert_true(calls < 150);
    assert_near(fw_maths_brent_root(flat, NULL, 0, 1, 1e-9), 0.7, 1e-1);
    assert_true(calls < 400);
}

static void test_ends_and_refusals(void **state) {
    (void)state;
    double a = 8, nothing = (double)NAN;
    assert_true(fw_maths_brent_root(cubic, &a, 2, 5, 1e-12) == 2);
    assert_true(fw_maths_brent_root(cubic, &a, 0, 2, 1e-12) == 2);
    assert_true(isnan(fw_maths_brent_root(cubic, &a, 3, 5, 1e-12)));
    assert_true(isnan(fw_maths_brent_root(cubic, &nothing, 3, 5, 1e-12)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_roots),
        cmocka_unit_test(test_ends_and_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
