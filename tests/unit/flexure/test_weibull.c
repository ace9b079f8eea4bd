/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/section.h"
#include "flexure/flexure.h"
#include "test.h"

static fw_flexure_input strip(double L_um, double t_um, double h_um, double rho_um) {
    return (fw_flexure_input){.kind = FW_FLEXURE_LEAF,
                              .length_m = L_um * 1e-6,
                              .width_m = t_um * 1e-6,
                              .depth_m = h_um * 1e-6,
                              .fillet_m = rho_um * 1e-6};
}

/* int (sigma/peak)^m dA, by the midpoint rule: the side in tension at 1/Kt, both faces at 2y/t of
   that over the half in tension; then both fillets at 1, with the faces along them */
static double integral(const fw_flexure_input *f, double m) {
    enum { N = 200000 };
    double t = f->width_m, h = f->depth_m, L = f->length_m, rho = f->fillet_m;
    double kt = fw_flexure_fillet_concentration(t, rho), strip_side = 0, face = 0;
    for (int i = 0; i < N; i++) {
        double y = (i + 0.5) / N;             /* of the half width */
        face += pow(y, m) * (0.5 * t / N);    /* per length, of one face */
        strip_side += pow(1 / kt, m) * h / N; /* uniform over the depth */
    }
    double around = 0;
    for (int i = 0; i < N; i++)
        around += rho * (0.5 * acos(-1.0) / N) * h;
    return L * (strip_side + 2 * face * pow(1 / kt, m)) + 2 * (around + rho * 2 * face);
}

static void area_against_numerical_integration(void **state) {
    (void)state;
    static const double m[] = {1, 4.2, 10, 25};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            const fw_flexure_input f = strip(471.2389, 8, k == 0 ? 50 : 9, k == 2 ? 0.5 : 4);
            assert_relative(fw_flexure_weibull_area_m2(&f, m[i]), integral(&f, m[i]), 1e-6);
        }
}

/* without fillets the closed form of a strip under a pure moment: L h + L t/(m + 1) */
static void a_plain_strip(void **state) {
    (void)state;
    fw_flexure_input f = strip(471.2389, 8, 50, 1e-9);
    double kt = fw_flexure_fillet_concentration(8e-6, 1e-15), m = 10;
    double plain = 471.2389e-6 * (50e-6 + 8e-6 / 11);
    assert_relative(fw_flexure_weibull_area_m2(&f, m) * pow(kt, m), plain, 2e-4);
}

static fw_flexure_weibull silicon(double area_um2) {
    return (fw_flexure_weibull){true, 1.2e9, 10, 1e4 * 1e-12, area_um2 * 1e-12};
}

static void probability_and_stress_are_inverse(void **state) {
    (void)state;
    const fw_flexure_weibull w = silicon(24000);
    for (double p = 1e-12; p < 0.9; p *= 7) {
        double s = fw_flexure_weibull_stress_Pa(&w, p);
        assert_relative(fw_flexure_weibull_probability(&w, s), p, 1e-9);
        assert_relative(fw_flexure_weibull_probability(&w, -s), p, 1e-9);
    }
    /* sigma0 on A0: 1 - 1/e */
    const fw_flexure_weibull own = silicon(1e4);
    assert_relative(fw_flexure_weibull_probability(&own, 1.2e9), 0.6321205588285577, 1e-14);
    /* by hand: 1.2e9 (1e-4 0.41668750...)^(1/10) with -ln(1 - 1e-4) = 1.00005000333e-4 */
    assert_relative(fw_flexure_weibull_stress_Pa(&w, 1e-4),
                    1.2e9 * pow(1.0000500033335e-4 / 2.4, 0.1), 1e-12);
}

/* twice the surface, (1/2)^(1/m) of the strength: for small m much, for great m little */
static void size_effect(void **state) {
    (void)state;
    static const double m[] = {3, 10, 30},
                        by[] = {0.7937005259840998, 0.9330329915368074, 0.9771599684342459};
    for (int i = 0; i < 3; i++) {
        fw_flexure_weibull one = silicon(24000), two = silicon(48000);
        one.modulus = two.modulus = m[i];
        assert_relative(fw_flexure_weibull_stress_Pa(&two, 1e-3) /
                            fw_flexure_weibull_stress_Pa(&one, 1e-3),
                        by[i], 1e-12);
    }
    /* a deeper or longer flexure is weaker, a sharper root too */
    const fw_flexure_input f = strip(400, 8, 50, 4), longer = strip(800, 8, 50, 4);
    double grows = fw_flexure_weibull_area_m2(&longer, 10) / fw_flexure_weibull_area_m2(&f, 10);
    assert_true(grows > 1.5 && grows < 2);
}

/* six hinges in series: survival is the product of theirs; the share is what makes it come out */
static void series_is_the_product_of_survivals(void **state) {
    (void)state;
    double p[6], survives = 1;
    for (int i = 0; i < 6; i++) {
        p[i] = 0.01 * (i + 1);
        survives *= 1 - p[i];
    }
    assert_relative(fw_flexure_series_probability(p, 6), 1 - survives, 1e-13);
    for (int n = 1; n < 20; n++) {
        double each[20], share = fw_flexure_series_share(1e-6, n);
        for (int i = 0; i < n; i++)
            each[i] = share;
        assert_relative(fw_flexure_series_probability(each, n), 1e-6, 1e-12);
        assert_relative(share, 1e-6 / n, 1e-6);
    }
    /* n hinges of surface A break as one of surface n A does */
    const fw_flexure_weibull one = silicon(24000), six = silicon(6 * 24000);
    assert_relative(fw_flexure_weibull_stress_Pa(&one, fw_flexure_series_share(1e-4, 6)),
                    fw_flexure_weibull_stress_Pa(&six, 1e-4), 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(area_against_numerical_integration), cmocka_unit_test(a_plain_strip),
        cmocka_unit_test(probability_and_stress_are_inverse), cmocka_unit_test(size_effect),
        cmocka_unit_test(series_is_the_product_of_survivals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
