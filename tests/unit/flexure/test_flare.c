/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/flexure.h"
#include "test.h"

/* H1: r 100 um, 270 deg, t 8 um, h 50 um, silicon */
static fw_flexure_input h1(void) {
    double angle = 1.5 * acos(-1.0);
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .length_m = 100e-6 * angle,
                              .angle_rad = angle,
                              .radius_m = 100e-6,
                              .width_m = 8e-6,
                              .fillet_m = 8e-6,
                              .depth_m = 50e-6,
                              .youngs_Pa = 169e9,
                              .poisson = 0.28,
                              .strength_Pa = 1e9,
                              .safety_factor = 1.5};
}

/* at depth z below the mask the width is w + 2 edge + 2 z slope: mean and flare */
static fw_flexure_result made_of(fw_flexure_input in, double edge_m, double slope) {
    fw_flexure_result out;
    in.width_m += 2 * edge_m + in.depth_m * slope;
    in.fillet_m -= edge_m + 0.5 * in.depth_m * slope;
    fw_flexure_closed_form(&in, &out);
    fw_flexure_flare(&in, in.depth_m * slope, &out);
    return out;
}

static fw_flexure_result made(double edge_m, double slope) {
    return made_of(h1(), edge_m, slope);
}

/* Simpson over the depth, of the cube of the width */
static double quadrature(double mean, double flare) {
    enum { N = 200 };
    double sum = 0;
    for (int i = 0; i <= N; i++) {
        double w = mean + flare * (2.0 * i / N - 1.0);
        sum += w * w * w * (i == 0 || i == N ? 1 : i % 2 ? 4 : 2);
    }
    return sum / (3.0 * N);
}

static void stiffness_is_the_integral_over_the_depth(void **state) {
    (void)state;
    const double share[] = {-0.9, -0.3, 0.05, 0.1, 0.7};
    for (size_t i = 0; i < sizeof share / sizeof share[0]; i++) {
        fw_flexure_input in = h1();
        fw_flexure_result plain, out;
        fw_flexure_closed_form(&in, &plain);
        out = plain;
        fw_flexure_flare(&in, share[i] * in.width_m, &out);
        double want = quadrature(1, share[i]);
        assert_relative(out.stiffness_Nm_per_rad / plain.stiffness_Nm_per_rad, want, 1e-12);
        /* the widest fibre, and the sharper notch of the wider face */
        double strained = out.strain_per_rad / plain.strain_per_rad;
        assert_true(strained >= 1 + fabs(share[i]));
        assert_true(strained < (1 + fabs(share[i])) * (1 + 0.15 * fabs(share[i])));
        assert_relative(out.limit_angle_rad * out.strain_per_rad,
                        plain.limit_angle_rad * plain.strain_per_rad, 1e-12);
        assert_near(out.centre_m, plain.centre_m, 0);
    }
}

static void no_flare_changes_no_bit(void **state) {
    (void)state;
    fw_flexure_input in = h1();
    fw_flexure_result plain, out;
    fw_flexure_closed_form(&in, &plain);
    out = plain;
    fw_flexure_flare(&in, 0, &out);
    assert_memory_equal(&plain, &out, sizeof out);
}

/* figures of an independent computation: an edge that comes out 0.25 um inside on either side makes
   K 17.6 % lower and the limit angle 6.7 % higher (t alone: 8/7.5; here the fillet, 8.25 um then,
   is wider than the flexure too, which adds 1 %, and the depth factor takes 0.4 % of it); walls at
   half a degree K 15 % lower or 18 % higher (plane stress; the fillet, which shrinks where the wall
   comes out, takes 0.2 % of that); sigma of the width 0.2 um: 8 % of K, 2.7 % of the strain per
   radian */
static void the_reference_hinge(void **state) {
    (void)state;
    fw_flexure_result drawn = made(0, 0), thin = made(-0.25e-6, 0);
    assert_near(thin.stiffness_Nm_per_rad / drawn.stiffness_Nm_per_rad, 1 - 0.176, 0.003);
    assert_near(drawn.strain_fit_per_rad / thin.strain_fit_per_rad, 1 + 0.067, 0.004);
    /* at the root the depth factor is not felt: what width and fillet do alone */
    assert_near(thin.limit_angle_rad / drawn.limit_angle_rad, 8 / 7.5 * 1.01, 0.004);
    fw_flexure_input flat = h1();
    flat.poisson = 0;
    const fw_flexure_result flat_thin = made_of(flat, -0.25e-6, 0),
                            flat_drawn = made_of(flat, 0, 0);
    double uncurved = (1 + 7.5 / 300) / (1 + 8 / 300.0);
    double straight = flat_drawn.strain_fit_per_rad / flat_thin.strain_fit_per_rad * uncurved;
    assert_near(straight, 1 + 0.067, 0.01); /* the wider fillet: 0.8 % */
    straight = flat_thin.limit_angle_rad / flat_drawn.limit_angle_rad * uncurved;
    assert_near(straight, (1 + 0.067) * 1.008, 0.004);
    double slope = tan(0.5 * acos(-1.0) / 180);
    double upright = made_of(flat, 0, 0).stiffness_Nm_per_rad;
    assert_near(made_of(flat, 0, -slope).stiffness_Nm_per_rad / upright, 0.85, 0.005);
    assert_near(made_of(flat, 0, slope).stiffness_Nm_per_rad / upright, 1.18, 0.007);
    fw_flexure_result wide = made(0.05e-6, 0), narrow = made(-0.05e-6, 0); /* +- 0.1 um */
    double k = log(wide.stiffness_Nm_per_rad / narrow.stiffness_Nm_per_rad) / 0.2;
    double e = log(wide.strain_fit_per_rad / narrow.strain_fit_per_rad) / 0.2;
    assert_near(0.2 * k, 3 * 0.2 / 8, 0.0015); /* published as 8 % */
    assert_near(0.2 * e, 0.027, 0.0015);       /* published as 2.7 % */
    /* at the root without what the depth factor takes: 0.4 % for 0.5 um */
    e = log(wide.strain_per_rad / narrow.strain_per_rad) / 0.2;
    assert_near(0.2 * e, 0.027 + 0.004 * 0.2 / 0.5, 0.0015);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stiffness_is_the_integral_over_the_depth),
        cmocka_unit_test(no_flare_changes_no_bit),
        cmocka_unit_test(the_reference_hinge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
