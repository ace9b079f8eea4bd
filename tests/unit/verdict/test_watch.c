/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/strain.h"
#include "test.h"

/* |A cos| seen at uneven instants: the height and the time of its largest value */
static void finds_the_peak_between_instants(void **state) {
    (void)state;
    uint64_t seed = 9;
    for (int round = 0; round < 200; round++) {
        fw_verdict_strain_peak p = {0};
        double most = 0, at = 0;
        for (double t = 0; t < 20;) {
            double envelope = exp(-(t - 7.3) * (t - 7.3) / 8.0);
            fw_verdict_strain_peak_add(&p, t, fabs(envelope * cos(3.0 * t)));
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            t += 0.03 + 0.05 * (double)(seed >> 11) / 9007199254740992.0;
        }
        for (double t = 7; t < 8; t += 5e-5) {
            double s = fabs(exp(-(t - 7.3) * (t - 7.3) / 8.0) * cos(3.0 * t));
            if (s > most) most = s, at = t;
        }
        assert_near(p.strain, most, 2e-4);
        assert_near(p.t_s, at, 2e-3);
        assert_true(fabs(p.strain - most) <= p.between + 2e-5);
    }
}

static void ends_count_too(void **state) {
    (void)state;
    fw_verdict_strain_peak p = {0};
    for (int i = 0; i <= 10; i++)
        fw_verdict_strain_peak_add(&p, i, i); /* still rising at the end */
    assert_near(p.strain, 10, 0);
    assert_near(p.t_s, 10, 0);
    p = (fw_verdict_strain_peak){0};
    for (int i = 0; i <= 10; i++)
        fw_verdict_strain_peak_add(&p, i, 10 - i);
    assert_near(p.strain, 10, 0);
    assert_near(p.t_s, 0, 0);
    p = (fw_verdict_strain_peak){0};
    for (int i = 0; i <= 3; i++)
        fw_verdict_strain_peak_add(&p, i, 1); /* flat */
    assert_near(p.strain, 1, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_peak_between_instants),
        cmocka_unit_test(ends_count_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
