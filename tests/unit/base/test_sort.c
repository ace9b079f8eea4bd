/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orders of numbers: they agree with < and are signs of one another; random lists come out ascending
   and hold the same numbers. */
#include "base/sort.h"
#include "test.h"
#include <math.h>

static void orders_agree_with_less(void **state) {
    (void)state;
    static const double x[] = {-HUGE_VAL, -1.0, -0.0, 0.0, 5e-324, 1.0, HUGE_VAL};
    const long long n[] = {-9223372036854775807LL, -1, 0, 1, 9223372036854775807LL};
    for (size_t i = 0; i < sizeof x / sizeof x[0]; i++)
        for (size_t k = 0; k < sizeof x / sizeof x[0]; k++) {
            int order = fw_order_doubles(x[i], x[k]);
            assert_int_equal(order, x[i] < x[k] ? -1 : x[i] > x[k] ? 1 : 0);
            assert_int_equal(order, -fw_order_doubles(x[k], x[i]));
            assert_int_equal(order, fw_compare_doubles(&x[i], &x[k]));
        }
    for (size_t i = 0; i < sizeof n / sizeof n[0]; i++)
        for (size_t k = 0; k < sizeof n / sizeof n[0]; k++) /* a difference would overflow */
            assert_int_equal(fw_order_wholes(n[i], n[k]), i < k ? -1 : i > k ? 1 : 0);
}

static void lists_come_out_ascending(void **state) {
    (void)state;
    unsigned seed = 3;
    fw_sort_doubles(NULL, 0);
    for (size_t n = 0; n < 60; n++) {
        double list[60], sum = 0;
        for (size_t i = 0; i < n; i++) {
            seed = seed * 1664525U + 1013904223U;
            list[i] = (double)(seed >> 24) - 128; /* some twice; sums are exact */
            sum += list[i];
        }
        fw_sort_doubles(list, n);
        for (size_t i = 0; i < n; i++) {
            if (i > 0) assert_true(list[i - 1] <= list[i]);
            sum -= list[i];
        }
        assert_true(sum == 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_agree_with_less),
        cmocka_unit_test(lists_come_out_ascending),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
