/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/bounds.h"

static void test_bounds_are_honest(void **state) {
    (void)state;
    bounds_check(1, test_cases(150, 60)); /* and 200 others in tests/hard */
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bounds_are_honest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
