/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Against an independent ladder of references (finite elements and mpmath), micrometres and MPa
   there: stiffness uN um/rad, centre um. */
#include "flexure/flexure.h"
#include "flexure/section.h"
#include "test.h"

static fw_flexure_input arc(double r_um, double angle_deg, double t_um, double h_um, double E,
                            double nu, double rho_um) {
    double angle = angle_deg * acos(-1.0) / 180.0;
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .length_m = r_um * angle * 1e-6,
                              .angle_rad = angle,
                              .radius_m = r_um * 1e-6,
                              .width_m = t_um * 1e-6,
                              .fillet_m = rho_um * 1e-6,
                              .depth_m = h_um * 1e-6,
                              .youngs_Pa = E,
                              .poisson = nu,
                              .strength_Pa = 500e6,
                              .safety_factor = 1.0};
}

typedef struct ladder {
    fw_flexure_input in;
    double thin, corrected, centre_um, strain;    /* closed form, printed digits */
    double fe_stiffness, fe_centre_um, fe_strain; /* 3-D finite elements with real roots */
} ladder;

static void csfh_matches_the_reference_ladder(void **state) {
    (void)state;
    const ladder row[] = {
        {arc(100, 270, 8, 50, 169e9, 0.22, 4), 765075.5, 767465.1, 29.6829, 0.01163, 769198.6,
         29.8787, 0.01163},
        {arc(100, 180, 10, 50, 169e9, 0.22, 4), 2241432.1, 2227656.5, 62.9610, 0.02256, 2235484.8,
         63.1165, 0.02257},
        {arc(100, 270, 10, 9, 115e9, 0.34, 4), 183028.2, 181722.7, 29.2994, 0.01455, 181755.1,
         29.3113, 0.01444},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_flexure_result out;
        fw_flexure_closed_form(&row[i].in, &out);
        assert_relative(out.stiffness_thin * 1e12, row[i].thin, 1e-7);
        assert_relative(out.stiffness_Nm_per_rad * 1e12, row[i].corrected, 1e-7);
        assert_near(out.centre_m * 1e6, row[i].centre_um, 6e-5);
        assert_near(out.strain_fit_per_rad, row[i].strain, 6e-6);
        /* what the header of flexure_even.c promises against finite elements */
        assert_relative(out.stiffness_Nm_per_rad * 1e12, row[i].fe_stiffness, 0.0051);
        assert_near(out.centre_m * 1e6, row[i].fe_centre_um, 0.2);
        assert_relative(out.strain_per_rad, row[i].fe_strain, 0.03);
        assert_relative(out.limit_angle_rad * row[i].in.youngs_Pa * out.strain_per_rad, 500e6,
                        1e-14);
        fw_flexure_input in = row[i].in; /* with what the ends lose */
        in.ends = true;
        fw_flexure_closed_form(&in, &out);
        assert_relative(out.stiffness_Nm_per_rad * 1e12, row[i].fe_stiffness, 0.001);
        assert_near((out.centre_m + out.offset_m[0]) * 1e6, row[i].fe_centre_um, 0.06);
    }
}

static void translation_stiffness_matches_finite_elements(void **state) {
    (void)state;
    fw_flexure_input in = arc(100, 270, 8, 1e-6, 169e9, 0.22, -1);
    fw_flexure_result out; /* so shallow that it is plane stress; scale to 50 um */
    fw_flexure_closed_form(&in, &out);
    assert_relative(out.kx_N_per_m * 50e6, 126.191, 5e-4);
    assert_relative(out.ky_N_per_m * 50e6, 251.265, 5e-4);
}

static void leaf_matches_the_reference(void **state) {
    (void)state;
    fw_flexure_input in = arc(100, 270, 8, 50, 169e9, 0.22, -1);
    in.kind = FW_FLEXURE_LEAF;
    fw_flexure_result out;
    fw_flexure_closed_form(&in, &out);
    assert_relative(out.stiffness_thin * 1e12, 765075.5, 1e-7);
    assert_relative(out.kx_N_per_m, 41.326, 2e-3); /* plane-stress finite elements */
    assert_near(out.centre_m, 0.0, 0.0);
    in.ends = true; /* solids of 50 um, without blocks */
    fw_flexure_closed_form(&in, &out);
    assert_relative(out.stiffness_Nm_per_rad * 1e12, 767802.8, 0.001);
    assert_relative(out.kx_N_per_m, 41.717, 0.001);
}

static void root_law_matches_finite_elements(void **state) {
    (void)state;
    const double fe[][2] = {{.05, .387}, {.0625, .381}, {.1, .358}, {.125, .3445}, {.2, .296},
                            {.25, .265}, {.4, .162},    {.5, .093}, {.8, -.1375},  {1, -.290}};
    for (size_t i = 0; i < sizeof fe / sizeof fe[0]; i++)
        assert_near(fw_flexure_root_length_m(1.0, fe[i][0]), fe[i][1], 0.0055);
}

static void concentration_matches_finite_elements(void **state) {
    (void)state;
    const double fe[][2] = {{.05, 2.486}, {.0625, 2.298}, {.1, 1.925}, {.125, 1.801}, {.2, 1.553},
                            {.25, 1.472}, {.4, 1.324},    {.5, 1.275}, {.8, 1.191},   {1, 1.166}};
    for (size_t i = 0; i < sizeof fe / sizeof fe[0]; i++)
        assert_relative(fw_flexure_fillet_concentration(1.0, fe[i][0]), fe[i][1], 0.011);
}

static void depth_factor_limits_and_reference(void **state) {
    (void)state;
    double nu = 0.22;
    assert_relative(fw_flexure_depth_factors(100, 8, 1e-3, nu).stiffness, 1.0, 1e-9);
    assert_relative(fw_flexure_depth_factors(100, 8, 1e6, nu).stiffness, 1.0 / (1.0 - nu * nu),
                    1e-5);
    assert_near(fw_flexure_depth_factors(100, 8, 50, nu).inner, 1.0460, 6e-5); /* inner fibre, H1 */
    assert_near(fw_flexure_depth_factors(100, 10, 50, nu).inner, 1.0397, 6e-5);
    double before = 1.0; /* monotone, and continuous where the branches meet */
    for (double h = 0.01; h < 1e5; h *= 1.01) {
        double now = fw_flexure_depth_factors(100, 8, h, nu).stiffness;
        assert_true(now >= before - 3e-4 && now < before + 2e-3);
        before = now;
    }
}

static void silicon_limit_angle_of_the_literature_case(void **state) {
    (void)state; /* 500 MPa at 147.08 GPa, fillet t/2: 16.6 degrees */
    fw_flexure_input in = arc(100, 270, 8, 50, 147.08e9, 0.22, 4);
    fw_flexure_result out;
    fw_flexure_closed_form(&in, &out);
    assert_near(out.limit_angle_rad * 180 / acos(-1.0), 16.6, 0.2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csfh_matches_the_reference_ladder),
        cmocka_unit_test(translation_stiffness_matches_finite_elements),
        cmocka_unit_test(leaf_matches_the_reference),
        cmocka_unit_test(root_law_matches_finite_elements),
        cmocka_unit_test(concentration_matches_finite_elements),
        cmocka_unit_test(depth_factor_limits_and_reference),
        cmocka_unit_test(silicon_limit_angle_of_the_literature_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
