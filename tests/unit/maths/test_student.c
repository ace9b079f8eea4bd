/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Student's t against the printed table: Abramowitz and Stegun, table 26.10. */
#include "maths/functions.h"
#include "test.h"

static void table(void **state) {
    (void)state;
    static const struct {
        double p, n, t;
    } row[] = {{0.975, 1, 12.706}, {0.975, 4, 2.776}, {0.975, 10, 2.228}, {0.975, 120, 1.980},
               {0.95, 2, 2.920},   {0.995, 5, 4.032}, {0.5, 7, 0.0}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        assert_near(fw_maths_student_quantile(row[i].p, row[i].n), row[i].t, 6e-4);
    assert_near(fw_maths_student_quantile(0.05, 2), -2.920, 6e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(table)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
