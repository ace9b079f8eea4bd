/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which criterion governs a flexure, with which number; limit angles against the elastic limits
   "with everything included" of an independent set of closed forms and finite elements. */
#include "flexure/flexure.h"
#include "flexure/section.h"
#include "test.h"

static fw_flexure_input arc(double angle_deg, double t_um, double h_um, double E, double nu) {
    double angle = angle_deg * acos(-1.0) / 180.0;
    return (fw_flexure_input){.kind = FW_FLEXURE_CSFH,
                              .length_m = 100e-6 * angle,
                              .angle_rad = angle,
                              .radius_m = 100e-6,
                              .width_m = t_um * 1e-6,
                              .fillet_m = 0.5 * t_um * 1e-6,
                              .depth_m = h_um * 1e-6,
                              .youngs_Pa = E,
                              .poisson = nu,
                              .safety_factor = 1};
}

static fw_quantity q(const char *id, double value, fw_quantity_value_status status) {
    return (fw_quantity){.id = id, .value = value, .status = status, .unit = "", .source = id};
}

static const fw_device_limits_asked statically = {.cycles = (double)NAN,
                                                  .failure_probability = (double)NAN};

static fw_flexure_limits limits(const fw_device_material *m, const fw_flexure_input *f,
                                const fw_device_limits_asked *asked, int nhinge) {
    fw_flexure_limits all;
    const fw_flexure_limit_input in = {m, f, asked, nhinge};
    fw_flexure_limits_of(&in, &all);
    return all;
}

static double angle_deg(fw_flexure_input f, double stress_Pa) {
    fw_flexure_result out;
    f.strength_Pa = stress_Pa;
    fw_flexure_closed_form(&f, &out);
    return out.limit_angle_rad * 180 / acos(-1.0);
}

/* the same where only the inner fibre at mid-depth is looked at, as the reference did: of a strip
   that is deep against its radius the edge of the outer one is strained more */
static double inner_angle_deg(fw_flexure_input f, double stress_Pa) {
    fw_flexure_result out;
    fw_flexure_closed_form(&f, &out);
    double t = f.width_m, r = f.radius_m;
    double inner = fw_flexure_fillet_concentration(t, f.fillet_m) * (1 + t / (3 * r)) *
                   fw_flexure_depth_factors(r, t, f.depth_m, f.poisson).inner;
    double beam = 0.5 * t / (f.length_m + 2 * out.root_length_m);
    return angle_deg(f, stress_Pa) * out.strain_per_rad / (beam * inner);
}

static fw_device_material silicon(void) {
    fw_device_material m = {.criterion = "fracture", .strength = q("strength", 1e9, FW_TYPICAL)};
    m.limit.weibull_strength = q("weibull-strength", 1.2e9, FW_ASSUMED);
    m.limit.weibull_modulus = q("weibull-modulus", 10, FW_TYPICAL);
    m.limit.weibull_area = q("weibull-area", 1e-8, FW_STATED);
    return m;
}

static fw_device_material copper(void) {
    fw_device_material m = {.criterion = "yield (0.2 % offset)",
                            .strength = q("strength", 250e6, FW_TYPICAL)};
    m.limit.offset_yield = q("offset-yield", 350e6, FW_TYPICAL);
    m.limit.proportional_factor = q("proportional-factor", 0.65, FW_ASSUMED);
    m.limit.fatigue_strength = q("fatigue-strength", 110e6, FW_TYPICAL);
    m.limit.fatigue_cycles = q("fatigue-cycles", 1e7, FW_TYPICAL);
    m.limit.fatigue_exponent = q("fatigue-exponent", -0.1, FW_ASSUMED);
    return m;
}

/* silicon at 500 MPa, copper at 250, 250/1.5 and, for 1e7 cycles, 110 MPa, aluminium at 150/1.5 */
static void elastic_limits_with_everything_included(void **state) {
    (void)state;
    const fw_device_material si = silicon(), cu = copper();
    fw_device_material own = si;
    own.strength = q("strength", 500e6, FW_STATED);
    own.strength_stated = true;
    /* Poisson's ratio of the reference: of roots along <100> */
    const fw_flexure_input si_arc[] = {arc(270, 8, 50, 147.08e9, 0.278),
                                       arc(180, 10, 50, 147.08e9, 0.278),
                                       arc(270, 5, 50, 147.08e9, 0.278)};
    static const double si_deg[] = {16.6, 8.9, 26.4};
    const fw_flexure_input h3 = arc(270, 10, 9, 115e9, 0.34), al = arc(270, 10, 9, 70e9, 0.35);
    const fw_flexure_limit *g;
    for (int i = 0; i < 3; i++) {
        const fw_flexure_limits stated = limits(&own, &si_arc[i], &statically, 6);
        g = fw_flexure_limits_governing(&stated);
        assert_string_equal(g->criterion, "strength");
        double inner = inner_angle_deg(si_arc[i], g->allowable_Pa);
        assert_near(inner, si_deg[i], 0.05);
        assert_relative(angle_deg(si_arc[i], g->allowable_Pa), inner, 0.04);
    }

    const fw_flexure_limits plain = limits(&cu, &h3, &statically, 6);
    g = fw_flexure_limits_governing(&plain);
    assert_string_equal(g->criterion, "yield");
    assert_near(angle_deg(h3, g->allowable_Pa), 8.9, 0.05);
    assert_near(angle_deg(h3, g->allowable_Pa / 1.5), 5.9, 0.05);
    fw_device_limits_asked often = statically;
    often.cycles = 1e7;
    const fw_flexure_limits tired = limits(&cu, &h3, &often, 6);
    assert_near(angle_deg(h3, tired.item[tired.fatigue].allowable_Pa), 3.9, 0.05);
    assert_near(inner_angle_deg(al, 150e6 / 1.5), 5.8, 0.05);
    assert_relative(angle_deg(al, 150e6 / 1.5), inner_angle_deg(al, 150e6 / 1.5), 0.01);
}

static void a_stated_strength_is_alone(void **state) {
    (void)state;
    const fw_flexure_input f = arc(270, 8, 50, 147.08e9, 0.31);
    fw_device_material m = silicon();
    m.strength_stated = true;
    m.strength.status = FW_STATED;
    fw_device_limits_asked asked = statically;
    asked.failure_probability = 1e-9; /* would be far lower */
    fw_flexure_limits all = limits(&m, &f, &asked, 6);
    assert_int_equal(all.count, 1);
    assert_string_equal(all.item[0].criterion, "strength");
    assert_relative(all.item[0].allowable_Pa, 1e9, 0);
    assert_int_equal(all.item[0].status, FW_STATED);
    assert_false(all.weibull.known);
    assert_null(all.missing);
    /* but cycles that are asked for are looked at */
    m = copper();
    m.strength_stated = true;
    asked = statically;
    asked.cycles = 1e6;
    all = limits(&m, &f, &asked, 6);
    assert_int_equal(all.count, 2);
    assert_true(all.governing == 0 && all.fatigue == 1 && all.life.known);
}

/* what is asked for in the device, over all hinges, comes back from the stress that is allowed */
static void probability_of_the_device(void **state) {
    (void)state;
    const fw_flexure_input f = arc(270, 8, 50, 147.08e9, 0.31);
    const fw_device_material m = silicon();
    fw_device_limits_asked asked = statically;
    double before = 1e12;
    for (double p = 1e-2; p > 1e-8; p /= 10) {
        asked.failure_probability = p;
        const fw_flexure_limits all = limits(&m, &f, &asked, 6);
        const fw_flexure_limit *g = fw_flexure_limits_governing(&all);
        assert_string_equal(g->criterion, "fracture");
        assert_int_equal(g->status, FW_ASSUMED); /* the weakest of three */
        double each[6];
        for (int i = 0; i < 6; i++)
            each[i] = fw_flexure_weibull_probability(&all.weibull, g->allowable_Pa);
        assert_relative(fw_flexure_series_probability(each, 6), p, 1e-9);
        assert_true(g->allowable_Pa < before);
        before = g->allowable_Pa;
        const fw_flexure_limits alone = limits(&m, &f, &asked, 1);
        assert_relative(g->allowable_Pa / fw_flexure_limits_governing(&alone)->allowable_Pa,
                        pow(1 / 6.0, 0.1), 2e-4);
    }
    const fw_flexure_limits plain = limits(&m, &f, &statically, 6);
    assert_relative(fw_flexure_limits_governing(&plain)->allowable_Pa, 1e9, 0);
    assert_true(plain.weibull.known); /* to say how often it breaks */
}

static void yield_by_definition(void **state) {
    (void)state;
    const fw_flexure_input f = arc(270, 10, 9, 115e9, 0.34);
    fw_device_material m = copper();
    fw_device_limits_asked survive = statically;
    survive.survival = true;
    fw_flexure_limits all = limits(&m, &f, &survive, 6);
    assert_relative(all.item[0].allowable_Pa, 350e6, 0);
    /* an offset value of the device's own is what the proportional limit then follows */
    m.limit.offset_yield = q("offset-yield", 300e6, FW_STATED);
    m.limit.offset_yield.source = "device file";
    all = limits(&m, &f, &statically, 6);
    assert_relative(all.item[0].allowable_Pa, 0.65 * 300e6, 1e-15);
    assert_int_equal(all.item[0].status, FW_ASSUMED); /* the factor's */
    /* without a strength the material's own offset value serves */
    m.limit.offset_yield.source = "pack";
    m.strength = (fw_quantity){.id = "strength", .unknown = true};
    all = limits(&m, &f, &statically, 6);
    assert_relative(all.item[0].allowable_Pa, 0.65 * 300e6, 1e-15);
    m.limit.proportional_factor.unknown = true;
    all = limits(&m, &f, &statically, 6);
    assert_null(fw_flexure_limits_governing(&all));
}

/* 116 + 355 t^-0.473 MPa at 0.1, 1 and 3 um, and no further */
static void film_law(void **state) {
    (void)state;
    fw_device_material m = copper();
    m.strength = q("strength", 160e6, FW_ASSUMED);
    m.limit.film_yield = q("film-yield", 116e6, FW_TYPICAL);
    m.limit.film_yield_rise = q("film-yield-rise", 355e6, FW_TYPICAL);
    m.limit.film_exponent = q("film-exponent", 0.473, FW_TYPICAL);
    m.limit.film_thickest = q("film-thickest", 3e-6, FW_TYPICAL);
    static const double um[] = {0.1, 1, 3, 3.1}, MPa[] = {1170.94144127, 471, 327.13002522, 0};
    for (int i = 0; i < 4; i++) {
        const fw_flexure_input f = arc(270, 10, um[i], 92e9, 0.34);
        const fw_flexure_limits all = limits(&m, &f, &statically, 6);
        assert_relative(all.item[0].allowable_Pa, MPa[i] > 0 ? 0.65e6 * MPa[i] : 160e6, 1e-6);
    }
}

static void the_lowest_governs(void **state) {
    (void)state;
    const fw_flexure_input f = arc(270, 10, 9, 115e9, 0.34);
    const fw_device_material m = copper();
    double before = 1e12;
    for (double n = 1; n < 1e12; n *= 10) {
        fw_device_limits_asked asked = statically;
        asked.cycles = n;
        const fw_flexure_limits all = limits(&m, &f, &asked, 6);
        assert_int_equal(all.count, 2);
        assert_string_equal(fw_flexure_limits_governing(&all)->criterion,
                            "yield"); /* of the static ones */
        double now = all.item[all.fatigue].allowable_Pa;
        assert_true(now < before);
        before = now;
    }
    /* 110 (n/1e7)^-0.1 = 250 MPa at 1e7 (250/110)^-10 = 2720 */
    fw_device_limits_asked asked = statically;
    asked.cycles = 1e7 * pow(250.0 / 110.0, -10);
    const fw_flexure_limits all = limits(&m, &f, &asked, 6);
    assert_relative(all.item[all.fatigue].allowable_Pa, all.item[all.governing].allowable_Pa,
                    1e-12);
}

/* what breaks at 1 GPa and yields before or behind it: the lower of both */
static void fracture_and_yield(void **state) {
    (void)state;
    const fw_flexure_input f = arc(270, 8, 50, 147.08e9, 0.31);
    fw_device_material m = silicon();
    m.limit.proportional_factor = q("proportional-factor", 0.5, FW_TYPICAL);
    for (int soft = 0; soft < 2; soft++) {
        m.limit.offset_yield = q("offset-yield", soft ? 1.9e9 : 2.1e9, FW_TYPICAL);
        const fw_flexure_limits all = limits(&m, &f, &statically, 6);
        assert_int_equal(all.count, 2);
        assert_string_equal(fw_flexure_limits_governing(&all)->criterion,
                            soft ? "yield" : "fracture");
        assert_relative(fw_flexure_limits_governing(&all)->allowable_Pa, soft ? 0.95e9 : 1e9,
                        1e-14);
    }
}

static void what_is_asked_and_not_known_is_said(void **state) {
    (void)state;
    const fw_flexure_input f = arc(270, 8, 50, 147.08e9, 0.31);
    fw_device_material m = silicon();
    fw_device_limits_asked asked = statically;
    asked.cycles = 1e6;
    assert_non_null(limits(&m, &f, &asked, 6).missing);
    asked = statically;
    asked.failure_probability = 1e-3;
    m.limit.weibull_area.unknown = true;
    assert_non_null(limits(&m, &f, &asked, 6).missing);
    assert_null(limits(&m, &f, &statically, 6).missing);
    m = copper(); /* metals have no failure probability, and none is missing */
    assert_null(limits(&m, &f, &asked, 6).missing);
    m.limit.ductility = q("ductility", 9, FW_TYPICAL); /* nothing elastic would be left */
    m.limit.ductility_exponent = q("ductility-exponent", -0.5, FW_TYPICAL);
    asked.cycles = 1e6;
    assert_non_null(limits(&m, &f, &asked, 6).missing);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_limits_with_everything_included),
        cmocka_unit_test(a_stated_strength_is_alone),
        cmocka_unit_test(probability_of_the_device),
        cmocka_unit_test(yield_by_definition),
        cmocka_unit_test(film_law),
        cmocka_unit_test(the_lowest_governs),
        cmocka_unit_test(fracture_and_yield),
        cmocka_unit_test(what_is_asked_and_not_known_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
