/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/loop.h"
#include "six_bar_fixture.h"
#include "test.h"

/* independent reference: pose of the platform's middle (um, rad), rotations of A..F (rad). The
   reference counts the right leg from the ground up; here F, E, D turn the other way. */
static const struct {
    double x_um, y_um, phi, turn[6];
} reference[] = {
    {0.0, 0.0, 0.0, {0, 0, 0, -0, -0, -0}},
    {50.0,
     0.0,
     0.0,
     {-0.03516804570757781, 0.0141570492443579, 0.02101099646321991, -0.02244935123792402,
      -0.01193821583698895, 0.03438756707491297}},
    {0.0,
     50.0,
     0.0,
     {-0.03153323404059094, 0.07582213929365844, -0.0442889052530675, -0.0442889052530675,
      0.07582213929365844, -0.03153323404059094}},
    {0.0,
     -50.0,
     0.0,
     {0.0294269900189823, -0.07220901199289997, 0.04278202197391767, 0.04278202197391767,
      -0.07220901199289997, 0.0294269900189823}},
    {0.0,
     0.0,
     0.05,
     {0.01165337618994755, -0.02914197579682032, 0.06748859960687277, -0.06729403239250527,
      0.0299788922142179, -0.01268485982171264}},
    {30.0,
     -20.0,
     -0.04,
     {-0.01883488853783888, 0.002397622920943032, -0.02356273438310415, 0.05739049120299363,
      -0.05957972694714275, 0.04218923574414912}},
    {-60.0,
     40.0,
     0.1,
     {0.03977462398478693, -0.01354615338970033, 0.07377152940491341, -0.1476848432619854,
      0.1418818942559739, -0.09419705099398845}},
    {100.0,
     80.0,
     -0.08,
     {-0.1438852040588063, 0.2090442457966111, -0.1451590417378048, -0.006462053664229986,
      0.05085335405279778, 0.0356086996114322}},
};

static void reference_poses(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    for (size_t i = 0; i < sizeof reference / sizeof reference[0]; i++) {
        double angle[FW_SIX];
        int leg;
        assert_true(fw_workspace_six_bar_inverse(&f.mechanism, reference[i].x_um * 1e-6,
                                                 reference[i].y_um * 1e-6, reference[i].phi, angle,
                                                 &leg));
        for (int j = 0; j < FW_SIX; j++)
            assert_near(angle[j], reference[i].turn[j], 1e-13);
    }
}

/* forward again: turning the links by what the inverse says puts C and D where the platform is */
static void round_trip_on_random_poses(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    uint64_t seed = 12345;
    int reached = 0;
    for (int i = 0; i < 20000; i++) {
        double u[3];
        for (int k = 0; k < 3; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            u[k] = (double)(seed >> 11) / 9007199254740992.0 - 0.5;
        }
        double x = u[0] * 2e-3, y = u[1] * 2e-3, phi = u[2] * 2.0, t[FW_SIX];
        int leg;
        if (!fw_workspace_six_bar_inverse(&f.mechanism, x, y, phi, t, &leg)) continue;
        reached++;
        const double(*p)[2] = six_bar_reference;
        double ax = p[0][0], ay = p[0][1];
        double c1 = cos(t[0]), s1 = sin(t[0]), c2 = cos(t[0] + t[1]), s2 = sin(t[0] + t[1]);
        double bx = p[1][0] - ax, by = p[1][1] - ay, dx = p[2][0] - p[1][0], dy = p[2][1] - p[1][1];
        double cx = ax + c1 * bx - s1 * by + c2 * dx - s2 * dy;
        double cy = ay + s1 * bx + c1 * by + s2 * dx + c2 * dy;
        double want_x = x * 1e6 - 400 * cos(phi), want_y = y * 1e6 + 700 - 400 * sin(phi);
        assert_near(cx, want_x, 1e-9);
        assert_near(cy, want_y, 1e-9);
        assert_near(t[0] + t[1] + t[2], phi, 1e-12);
        assert_near(t[3] + t[4] + t[5], -phi, 1e-12);
    }
    assert_true(reached > 5000);
}

/* all of it is in the platform's own hinges */
static void a_full_turn_of_the_platform_is_one(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    for (int turns = -2; turns <= 2; turns++) {
        double angle[FW_SIX], full = 2 * acos(-1.0) * turns;
        int leg;
        assert_true(fw_workspace_six_bar_inverse(&f.mechanism, 0, 0, full, angle, &leg));
        for (int j = 0; j < FW_SIX; j++)
            assert_near(angle[j], j == 2 ? full : j == 3 ? -full : 0.0, 1e-12);
    }
}

static void out_of_reach_names_the_leg(void **state) {
    (void)state;
    six_bar_fixture f;
    six_bar_make(&f, six_bar_reference);
    double angle[FW_SIX];
    int leg = -1;
    assert_false(fw_workspace_six_bar_inverse(&f.mechanism, 3e-3, 0, 0, angle, &leg));
    assert_int_equal(leg, 0);
    assert_false(fw_workspace_six_bar_inverse(&f.mechanism, -1.5e-3, 0, 0, angle, &leg));
    assert_int_equal(leg, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_poses),
        cmocka_unit_test(round_trip_on_random_poses),
        cmocka_unit_test(a_full_turn_of_the_platform_is_one),
        cmocka_unit_test(out_of_reach_names_the_leg),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
