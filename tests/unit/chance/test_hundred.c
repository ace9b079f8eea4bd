/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The automatic choice in 100 dimensions with 8000 evaluations: apart, because a thousand repetitions take a minute. */
#include "limits.h"

static void hundred(void **state) {
    (void)state;
    for (size_t i = 0; i < LIMIT_STATES; i++) {
        double width;
        if (limit_states[i].dimensions != 100) continue;
        limit_coverage(&limit_states[i],
                       (fw_chance_options){.method = FW_CHANCE_AUTO, .budget = 8000},
                       test_fewest(test_cases(1000, 3), 1), &width);
        assert_true(width < 0.1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hundred)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
