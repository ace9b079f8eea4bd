/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/strain.h"
#include "base/constants.h"
#include "test.h"

/* |A cos| seen at uneven instants: the height and the time of its largest value */
static void finds_the_peak_between_instants(void **state) {
    (void)state;
    uint64_t seed = 9;
    for (int round = 0; round < 200; round++) {
        fw_verdict_largest p = {0};
        double most = 0, at = 0;
        for (double t = 0; t < 20;) {
            double envelope = exp(-(t - 7.3) * (t - 7.3) / 8.0);
            fw_verdict_largest_add(&p, t, fabs(envelope * cos(3.0 * t)));
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            t += 0.03 + 0.05 * (double)(seed >> 11) / 9007199254740992.0;
        }
        for (double t = 7; t < 8; t += 5e-5) {
            double s = fabs(exp(-(t - 7.3) * (t - 7.3) / 8.0) * cos(3.0 * t));
            if (s > most) most = s, at = t;
        }
        assert_near(p.value, most, 2e-4);
        assert_near(p.t_s, at, 2e-3);
        assert_true(fabs(p.value - most) <= p.between + 2e-5);
    }
}

static void ends_count_too(void **state) {
    (void)state;
    fw_verdict_largest p = {0};
    for (int i = 0; i <= 10; i++)
        fw_verdict_largest_add(&p, i, i); /* still rising at the end */
    assert_near(p.value, 10, 0);
    assert_near(p.t_s, 10, 0);
    p = (fw_verdict_largest){0};
    for (int i = 0; i <= 10; i++)
        fw_verdict_largest_add(&p, i, 10 - i);
    assert_near(p.value, 10, 0);
    assert_near(p.t_s, 0, 0);
    p = (fw_verdict_largest){0};
    for (int i = 0; i <= 3; i++)
        fw_verdict_largest_add(&p, i, 1); /* flat */
    assert_near(p.value, 1, 0);
}

/* ---- the thirds of a step ---- */

/* one arm on a leaf, which is turned as is asked for, without a force */
static const char arm[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"arm\">\n"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/><limits safety-factor=\"1.5\"/>\n"
    "<flexure id=\"leaf\" kind=\"leaf\" width=\"8 um\" length=\"300 um\" fillet=\"8 um\" gap=\"6 "
    "um\"/>\n"
    "<mechanism><body id=\"a\" mass=\"0.02 mg\" inertia=\"0.002 mg mm^2\" x=\"0.5 mm\" y=\"0 "
    "mm\"/>\n"
    "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"a\" b-x=\"-0.5 mm\" b-y=\"0 "
    "mm\" hinge=\"leaf\"/></mechanism>\n"
    "<scene name=\"push\" duration=\"1 ms\"><force on=\"a\" fx=\"0 mN\" fy=\"1 uN\"/></scene>\n"
    "</device>\n";

static const fw_mechanism *arm_on_a_leaf(fw_arena *arena) {
    static fw_mechanism_variant variant = {.flow = "test",
                                           .thickness_m = 50e-6,
                                           .explicit_mass_scale = 1,
                                           .explicit_stiffness_scale = 1,
                                           .explicit_damping_scale = 1};
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    const fw_mechanism *m;
    fw_quantity is = {.unit = "Pa", .status = FW_TYPICAL, .source = "test"};
    variant.material =
        (fw_device_material){.id = "silicon-100", .name = "silicon", .criterion = "fracture"};
    is.value = 169e9, variant.material.youngs = is;
    is.value = 2e9, variant.material.strength = is;
    is.unit = "1", is.value = 0.28, variant.material.poisson = is;
    is.unit = "kg/m3", is.value = 2329, variant.material.density = is;
    is.value = 0, is.unknown = true, is.unit = "1";
    variant.material.loss = variant.material.expansion = is;
    variant.material.modulus_change = variant.substrate_expansion = is;
    if (fw_device_read(arena, "t.xml", arm, strlen(arm), NULL, 0, &diags, &device) != FW_OK)
        fail_msg("%d: %s", diags.item[0].place.line, diags.item[0].message);
    if (fw_mechanism_build(arena, device, NULL, &variant, &diags, &m) != FW_OK)
        fail_msg("%s", diags.item[0].message);
    return m;
}

/* a slow turn on which a quick one rides */
static double turn_at(double t_s, double slow, double quick) {
    return 0.02 * sin(FW_TURN * slow * t_s) + 0.008 * sin(FW_TURN * quick * t_s + 1);
}

static fw_dynamics_instant instant(double t_s, double *angle_rad, double slow, double quick) {
    static const double at_rest[3] = {0.5e-3, 0, 0}, no_force[2] = {0, 0};
    *angle_rad = turn_at(t_s, slow, quick);
    return (fw_dynamics_instant){.t_s = t_s,
                                 .q = at_rest,
                                 .angle_rad = angle_rad,
                                 .reaction_N = no_force,
                                 .hinge = FW_HINGE_COMPLIANCE};
}

static double damage(fw_arena *arena, const fw_verdict_strain_monitor *m) {
    static const fw_flexure_strain_life life = {
        .known = true, .amplitude_Pa = 110e6, .cycles = 1e7, .exponent = -0.1, .youngs_Pa = 169e9};
    fw_verdict_fatigue out;
    assert_int_equal(fw_verdict_fatigue_of(arena, &life, m->root[0], 0, 169e9, 1, NULL, &out), FW_OK);
    assert_true(out.damage > 0);
    return out.damage;
}

/* Steps of many lengths: what they do to a hinge is counted alike whether their thirds were taken,
   where these are offered and accepted, or sixty instants of each. Damage goes with the tenth
   power of the amplitude, so that its 0.5 % are 0.05 % of that. */
static void cycles_are_counted_by_thirds(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_mechanism *m = arm_on_a_leaf(arena);
    uint64_t seed = 5;
    int taken = 0, refused = 0;
    for (int round = 0; round < 9; round++) {
        fw_verdict_strain_monitor few, many;
        double slow = 1, quick = 3 + round % 7, t = 0, angle[FW_THIRDS];
        double longest = 0.15 / quick * (1 + round % 3);
        assert_int_equal(fw_verdict_strain_monitor_new(arena, m, true, &few), FW_OK);
        assert_int_equal(fw_verdict_strain_monitor_new(arena, m, true, &many), FW_OK);
        fw_verdict_strain_monitor_record(&few, NULL), fw_verdict_strain_monitor_record(&many, NULL);
        for (int step = 0; t < 3; step++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            double h = longest * (0.1 + 0.9 * (double)(seed >> 11) / 9007199254740992.0);
            fw_dynamics_instant third[FW_THIRDS];
            for (int i = 0; i < FW_THIRDS; i++)
                third[i] = instant(t + h * (i + 1) / FW_THIRDS, &angle[i], slow, quick);
            bool enough = step > 0 && fw_verdict_strain_monitor_glance(&few, third);
            taken += enough, refused += !enough;
            for (int i = step > 0; !enough && i <= FW_INSTANTS; i++) {
                fw_dynamics_instant now = instant(t + h * i / FW_INSTANTS, angle, slow, quick);
                fw_verdict_strain_monitor_record(&few, &now);
            }
            for (int i = step > 0; i <= 60; i++) {
                fw_dynamics_instant now = instant(t + h * i / 60, angle, slow, quick);
                fw_verdict_strain_monitor_record(&many, &now);
            }
            t += h;
        }
        assert_relative(damage(arena, &few), damage(arena, &many), 5e-3);
    }
    assert_true(taken > 60 && refused > 60); /* both are tried */
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_peak_between_instants),
        cmocka_unit_test(ends_count_too),
        cmocka_unit_test(cycles_are_counted_by_thirds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
