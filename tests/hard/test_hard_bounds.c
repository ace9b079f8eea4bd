/* SPDX-License-Identifier: GPL-3.0-or-later */
/* More random devices (./test --all: 200) than the unit test has; FW_BOUNDS_FIRST and FW_BOUNDS_COUNT choose others. */
#include "dynamics/bounds.h"
#include <stdlib.h>

static void test_bounds_are_honest(void **state) {
    (void)state;
    const char *first = getenv("FW_BOUNDS_FIRST"), *count = getenv("FW_BOUNDS_COUNT");
    bounds_check(first ? strtoull(first, NULL, 10) : 1000, count ? atoi(count) : test_cases(200, 80));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bounds_are_honest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
