/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FW_BOUNDS_FIRST and FW_BOUNDS_COUNT: other devices. */
#include "hinge_bounds.h"

static void test_pins_for_hinges(void **state) {
    (void)state;
    const char *first = getenv("FW_BOUNDS_FIRST"), *count = getenv("FW_BOUNDS_COUNT");
    hinge_bounds_check(first ? strtoull(first, NULL, 10) : 1, count ? atoi(count) : 16);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pins_for_hinges)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
