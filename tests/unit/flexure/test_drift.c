/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axis drift, pole, contact of the surfaces: table of the hinge's theory, geometry, load cases of
   the geometrically exact beam (um, uN there). */
#include "flexure/finite.h"
#include "test.h"

static const double degree = M_PI / 180;

static fw_flexure_hinge_law thin(double r_m, double angle_deg, double EI) {
    double a = 0.5 * angle_deg * degree, L = 2 * a * r_m;
    return (fw_flexure_hinge_law){.stiffness_Nm_per_rad = EI / L,
                                  .half_angle_rad = a,
                                  .length_m = L,
                                  .share = 1,
                                  .bend_m_per_N = L * L * L / (8 * EI)};
}

/* by the first term of the drift, sqrt(2 gap a^2/(r (sin a - a cos a) cos zeta)) of an arc without
   roots: within 2 % below 15 deg */
static double contact_small_rad(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(law, 0, &at);
    return sqrt(2 * s->gap_m / (fabs(at.drift_m.curve) * cos(s->aside_rad)));
}

/* printed digits of the angle at which the drift closes a gap, r = 100 um */
static void surfaces_meet(void **state) {
    (void)state;
    const double angle[] = {90, 120, 180, 225, 270, 300, 330, 360};
    const double deg[][4] = {{16.4, 23.3, 28.6, 37.0}, {14.6, 20.7, 25.4, 32.9},
                             {12.8, 18.2, 22.3, 29.0}, {12.4, 17.6, 21.6, 28.1},
                             {12.5, 17.8, 21.9, 28.5}, {12.9, 18.4, 22.6, 29.5},
                             {13.6, 19.4, 23.9, 31.2}, {14.7, 21.0, 25.9, 33.8}};
    const double gap[] = {1e-6, 2e-6, 3e-6, 5e-6};
    for (int i = 0; i < 8; i++)
        for (int g = 0; g < 4; g++) {
            fw_flexure_hinge_law law = thin(100e-6, angle[i], 1e-6);
            fw_flexure_surfaces s = {.gap_m = gap[g]};
            double th = fw_flexure_drift_contact_rad(&law, &s, NULL, 1),
                   a = 0.5 * angle[i] * degree;
            assert_near(th / degree, deg[i][g], 0.0501);
            assert_near(fw_flexure_drift_at(&law, &s, th).left_m, 0, 1e-6 * gap[g]);
            double small = sqrt(2 * gap[g] * a * a / (100e-6 * (sin(a) - a * cos(a))));
            assert_relative(contact_small_rad(&law, &s), small, 1e-12);
            assert_relative(th, small, 0.1);
            s.aside_rad = 0.5; /* sideways the same gap is wider */
            assert_relative(contact_small_rad(&law, &s), small / sqrt(cos(0.5)), 1e-12);
            assert_true(fw_flexure_drift_contact_rad(&law, &s, NULL, 1) > th);
        }
    fw_flexure_hinge_law law = thin(100e-6, 270, 1e-6);
    fw_flexure_surfaces wide = {.gap_m = 1e-3};
    assert_true(isnan(fw_flexure_drift_contact_rad(&law, &wide, NULL, 1)));
}

/* the point of the second body at the pole is where the first body's point is */
static void pole_stands_still(void **state) {
    (void)state;
    fw_flexure_hinge_law law = thin(100e-6, 200, 1e-6);
    fw_flexure_surfaces s = {.gap_m = 1e-6};
    for (double th = -1.2; th < 1.3; th += 0.15) {
        fw_flexure_drift_point at = fw_flexure_drift_at(&law, &s, th);
        double h = 0.5 * th, x = at.pole_m; /* (x, 0) in the half-turned frame, from the mean W */
        double ax = x * cos(h), ay = x * -sin(h), bx = x * cos(h), by = x * sin(h);
        assert_near(bx - ax, 0, 1e-20);
        assert_near(by - ay + at.drift_m, 0, 1e-15 + 1e-9 * fabs(at.drift_m));
    }
    /* first order: -r th (sin a - a cos a)/(2 a^2) */
    double a = 100 * degree, th = 1e-3;
    double first = -100e-6 * th * (sin(a) - a * cos(a)) / (2 * a * a);
    assert_relative(fw_flexure_drift_at(&law, &s, th).pole_m, first, 1e-3);
    assert_relative(fw_flexure_drift_at(&law, &s, 1e-6).pole_m, first * 1e-3, 1e-5);
    assert_near(fw_flexure_drift_at(&law, &s, 0).pole_m, 0, 1e-18);
    /* of one sign and one slope where the formula changes over to two terms of it; above, the drift
       is a difference of lengths, known to eps L = 8e-20 m of 2e-15 */
    for (int sense = -1; sense <= 1; sense += 2) {
        double low = fw_flexure_drift_at(&law, &s, 0.999e-5 * sense).pole_m,
               high = fw_flexure_drift_at(&law, &s, 1.001e-5 * sense).pole_m;
        assert_relative(low / 0.999, sense * first * 1e-2, 1e-5);
        assert_relative(high / 1.001, sense * first * 1e-2, 4e-5);
    }
}

/* table of the exact beam, th = 5 deg, H1: ux, uy; and silicon closes 2 um by 220 or 438 uN */
static void under_a_force(void **state) {
    (void)state;
    const double row[][4] = {{100e-6, 0, .75432, .17633},
                             {-100e-6, 0, -.76823, .14486},
                             {0, 100e-6, .00865, .56254},
                             {0, -100e-6, -.02282, -.24059}};
    double EI = 169e9 * 50e-6 * pow(8e-6, 3) / 12;
    fw_flexure_hinge_law law = thin(100e-6, 270, EI);
    for (int i = 0; i < 4; i++) {
        double u[2];
        fw_flexure_drift_displacement(&law, 5 * degree, row[i], u);
        assert_near(u[0] * 1e6, row[i][2], 0.004); /* incl. axial and shear of the table's beam */
        assert_near(u[1] * 1e6, row[i][3], 0.004);
        fw_flexure_surfaces s = {.gap_m = hypot(u[0], u[1])};
        double th = fw_flexure_drift_contact_rad(&law, &s, row[i], 1);
        assert_true(th <= 5.0001 * degree); /* it meets there, or did before */
        fw_flexure_drift_displacement(&law, th, row[i], u);
        if (th > 0) assert_relative(hypot(u[0], u[1]), s.gap_m, 1e-9);
    }
    law = thin(100e-6, 270, 147.08e9 * 50e-6 * pow(8e-6, 3) / 12);
    fw_flexure_surfaces s = {.gap_m = 2e-6};
    const double x[] = {220e-6, 0}, y[] = {0, 438e-6}, less[] = {200e-6, 0};
    double u[2];
    fw_flexure_drift_displacement(&law, 0, x, u);
    assert_relative(u[0], 2e-6, 3e-3);
    fw_flexure_drift_displacement(&law, 0, y, u);
    assert_relative(u[1], 2e-6, 5e-3); /* 438 uN is what ky alone says */
    const double more[] = {221e-6, 0};
    assert_near(fw_flexure_drift_contact_rad(&law, &s, more, 1), 0, 0);
    assert_true(fw_flexure_drift_contact_rad(&law, &s, less, 1) > 0);
}

static void advice_halves_the_gap(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        fw_flexure_hinge_law law = thin(100e-6, 90 + 45 * i, 1e-6);
        double th = 0.25;
        fw_flexure_drift_advice a = fw_flexure_drift_advise(&law, -th, th);
        fw_flexure_surfaces s = {.gap_m = 1};
        double at = fmax(fw_flexure_drift_at(&law, &s, th).drift_m,
                         fw_flexure_drift_at(&law, &s, -th).drift_m);
        assert_relative(a.centred_m, at, 1e-12);
        assert_relative(a.offset_m, 0.5 * at, 1e-12);
        assert_relative(a.gap_m, 0.5 * at, 0.2);
        assert_near(a.pivot_x_m, 0, 0);
        s = (fw_flexure_surfaces){.gap_m = a.gap_m * 1.0001, .offset_m = a.offset_m};
        fw_flexure_drift_point point[41];
        fw_flexure_drift_curve(&law, &s, -th, th, 41, point);
        for (int k = 0; k < 41; k++)
            assert_true(point[k].left_m > 0);
        s.offset_m = 0;
        assert_true(fw_flexure_drift_at(&law, &s, th).left_m < 0);
        /* one side: a pin at the pivot is right at the end, a quarter of the drift off half way */
        a = fw_flexure_drift_advise(&law, 0, th);
        double end = fw_flexure_drift_at(&law, &s, th).drift_m;
        double half = fw_flexure_drift_at(&law, &s, 0.5 * th).drift_m;
        assert_near(end + 2 * a.pivot_x_m * sin(0.5 * th), 0, 1e-14);
        assert_relative(half + 2 * a.pivot_x_m * sin(0.25 * th), -0.25 * end, 0.1);
    }
}

/* surfaces drawn beside W part as the hinge turns: by hand, in the first body's frame */
static void surfaces_beside_W(void **state) {
    (void)state;
    fw_flexure_hinge_law law = thin(100e-6, 270, 1e-6);
    for (double th = -0.4; th < 0.5; th += 0.1) {
        const double c[2] = {0.7e-6, -1.1e-6};
        fw_flexure_surfaces s = {.gap_m = 8e-6, .centre_m = {c[0], c[1]}, .offset_m = 0.3e-6};
        double u[2];
        fw_flexure_drift_displacement(&law, th, NULL, u);
        double x = u[0] + cos(th) * c[0] - sin(th) * c[1] - c[0];
        double y = u[1] + sin(th) * c[0] + cos(th) * c[1] - (c[1] + 0.3e-6);
        assert_near(fw_flexure_drift_at(&law, &s, th).left_m, 8e-6 - hypot(x, y), 1e-17);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_meet),     cmocka_unit_test(pole_stands_still),
        cmocka_unit_test(under_a_force),     cmocka_unit_test(advice_halves_the_gap),
        cmocka_unit_test(surfaces_beside_W),
    };
    return cmocka_run_group_tests_name("drift", tests, NULL, NULL);
}
