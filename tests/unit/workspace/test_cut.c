/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/loop.h"
#include "test.h"

static uint64_t seed = 5;

static double unit(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* the share as a mean over one coordinate of the share in two: midpoint rule, nothing in common
   with the closed form but the case of one dimension */
static double slices(const double p[3], double t) {
    enum { N = 400 };
    double sum = 0;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++) {
            double rest = t - p[0] * ((2.0 * i + 1) / N - 1) - p[1] * ((2.0 * k + 1) / N - 1);
            sum += fmin(fmax(0.5 * (1 + rest / p[2]), 0.0), 1.0);
        }
    return sum / (N * N);
}

static void against_slices(void **state) {
    (void)state;
    for (int i = 0; i < 400; i++) {
        double p[3] = {pow(10, -4 * unit()), pow(10, -4 * unit()), 1.0};
        double t = (2 * unit() - 1) * (p[0] + p[1] + p[2]);
        fw_maths_interval v = fw_workspace_cut_share(p, t);
        assert_true(v.lo <= v.hi && v.lo >= 0 && v.hi <= 1);
        assert_near(0.5 * (v.lo + v.hi), slices(p, t), 2e-5);
        assert_true(v.hi - v.lo < 3e-13);
    }
}

/* the order does not matter, both sides add up to the whole, and the share grows with t without a
   jump where one case gives way to another */
static void identities(void **state) {
    (void)state;
    for (int i = 0; i < 20000; i++) {
        double p[3] = {pow(10, -12 * unit()), unit() < 0.1 ? 0 : unit(), unit() < 0.1 ? 0 : unit()};
        double q[3] = {p[2], p[0], p[1]}, sum = p[0] + p[1] + p[2];
        double corner = p[0] * (unit() < 0.5 ? 1 : -1) + p[1] * (unit() < 0.5 ? 1 : -1) - p[2];
        double t = unit() < 0.5 ? corner : (2 * unit() - 1) * sum;
        fw_maths_interval a = fw_workspace_cut_share(p, t), b = fw_workspace_cut_share(q, t),
                          c = fw_workspace_cut_share(p, -t);
        assert_near(0.5 * (a.lo + a.hi), 0.5 * (b.lo + b.hi), 1e-12);
        assert_near(0.5 * (a.lo + a.hi + c.lo + c.hi), 1.0, 1e-12);
        fw_maths_interval more = fw_workspace_cut_share(p, t + 1e-9 * sum);
        assert_true(more.hi >= a.lo);
        assert_near(more.lo, a.lo, 4e-9);
    }
}

static void ends(void **state) {
    (void)state;
    const double p[3] = {0.5, 0.0, 0.25}, none[3] = {0, 0, 0};
    assert_true(fw_workspace_cut_share(p, 0.76).lo == 1.0 &&
                fw_workspace_cut_share(p, -0.76).hi == 0.0);
    assert_true(fw_workspace_cut_share(none, 1.0).lo == 1.0 &&
                fw_workspace_cut_share(none, -1.0).hi == 0.0);
    fw_maths_interval open = fw_workspace_cut_share(none, 0.0);
    assert_true(open.lo == 0.0 && open.hi == 1.0);
    const double cube[3] = {1, 1, 1};
    assert_near(fw_workspace_cut_share(cube, -2.0).lo, 1.0 / 48.0,
                1e-12); /* a corner of legs 1 of 2 */
    assert_near(fw_workspace_cut_share(cube, -1.0).lo, 1.0 / 6.0, 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_slices),
        cmocka_unit_test(identities),
        cmocka_unit_test(ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
