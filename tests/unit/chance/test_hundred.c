/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The automatic choice with 2e4 evaluations in 100 dimensions: apart, because a thousand repetitions take a minute. */
#include "limits.h"

static void hundred(void **state) {
    (void)state;
    for (size_t i = 0; i < LIMIT_STATES; i++) {
        double width;
        if (limit_states[i].dimensions != 100) continue;
        limit_coverage(&limit_states[i], (fw_chance_options){.method = FW_CHANCE_AUTO},
                       test_fewest(test_cases(1000, 3), 1), &width);
        assert_true(width < 0.06);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hundred)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
