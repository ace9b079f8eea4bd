/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a layer is anchored to comes from its flow. A portal whose posts stand WIDE apart: its
   ground shrinks against a layer that expands more, and both posts lean by half of what that is
   between their flexures' roots over their height (they are held apart by a beam of the layer). The
   modulus is stated, so that the pins of silicon are where they are drawn. */
#include "plan/plan.h"
#include "plan/stages.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include "test.h"
#include <math.h>

static const char before[] = "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material "
                             "ref=\"silicon-100\" youngs-modulus=\"147.08 GPa\" "
                             "thickness=\"50 um\"/>";
static const char behind[] =
    "<flexure id=\"f\" kind=\"csfh\" radius=\"100 um\" angle=\"270 deg\" width=\"8 um\" gap=\"2 "
    "um\" fillet=\"4 um\"/><mechanism>"
    "<body id=\"left\" mass=\"0.01 mg\" inertia=\"0.001 mg mm^2\" x=\"0 mm\" y=\"0.5 mm\" "
    "width=\"100 um\"/>"
    "<body id=\"right\" mass=\"0.01 mg\" inertia=\"0.001 mg mm^2\" x=\"2 mm\" y=\"0.5 mm\" "
    "width=\"100 um\"/>"
    "<body id=\"beam\" mass=\"0.06 mg\" inertia=\"0.01 mg mm^2\" x=\"1 mm\" y=\"1 mm\" "
    "width=\"100 um\"/>"
    "<revolute id=\"A\" a=\"ground\" b=\"left\" b-y=\"-0.5 mm\" hinge=\"f\" stiffness=\"1e-6 N "
    "m/rad\"/>"
    "<revolute id=\"B\" a=\"left\" a-y=\"0.5 mm\" b=\"beam\" b-x=\"-1 mm\" hinge=\"f\" "
    "stiffness=\"1e-6 N m/rad\"/>"
    "<revolute id=\"C\" a=\"beam\" a-x=\"1 mm\" b=\"right\" b-y=\"0.5 mm\" hinge=\"f\" "
    "stiffness=\"1e-6 N m/rad\"/>"
    "<revolute id=\"D\" a=\"ground\" a-x=\"2 mm\" b=\"right\" b-y=\"-0.5 mm\" hinge=\"f\" "
    "stiffness=\"1e-6 N m/rad\"/>"
    "</mechanism><scene name=\"a\" duration=\"1 ms\"><temperature change=\"100 K\"";

static fw_plan *read_with(const char *flow, const char *temperature, fw_status *status) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.motion.effects.mode = FW_EFFECTS_ALL;
    o.verdict.motion.effects.hinge = FW_HINGE_REVOLUTE;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *xml = fw_arena_printf(plan->arena, "%s%s%s%s/></scene></device>", before, flow,
                                      behind, temperature);
    assert_non_null(xml);
    *status = fw_plan_load_memory(plan, "portal.xml", xml, strlen(xml));
    return plan;
}

static fw_plan *loaded(const char *flow, const char *temperature) {
    fw_status status;
    fw_plan *plan = read_with(flow, temperature, &status);
    if (status != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

static void of_the_flow(void **state) {
    (void)state;
    enum { CHANGE_K = 100 }; /* means over it: at 300 K, slope and curvature of the packs */
#define SILICON (2.57e-6 + CHANGE_K * (4.4e-9 - CHANGE_K * 6.5e-12))
#define COPPER  (16.7e-6 + CHANGE_K * (5e-9 - CHANGE_K * 3.5e-12))
    static const struct {
        const char *flow, *temperature, *name;
        double layer_per_K, substrate_per_K;
    } row[] = {
        {"", "", "silicon substrate", SILICON, SILICON},
        {"<flow ref=\"al-masked-rie\"/>", "", "silicon substrate", SILICON, SILICON},
        {"<flow ref=\"al-masked-rie\" carrier=\"insulating\"/>", "", "borosilicate glass carrier",
         SILICON, 3.3e-6},
        {"<flow ref=\"silicon-on-glass\"/>", "", "borosilicate glass carrier", SILICON, 3.3e-6},
        {"<flow ref=\"silicon-on-glass\" carrier=\"insulating\"/>", "",
         "borosilicate glass carrier", SILICON, 3.3e-6},
        {"<flow ref=\"soi-deep-rie\" carrier=\"insulating\"/>", "", "silicon substrate", SILICON,
         SILICON},
        {"<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" thickness=\"9 um\"/>",
         "", "silicon substrate", COPPER, SILICON},
        {"<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" thickness=\"9 um\"/>",
         " expansion=\"12 ppm/K\"", "silicon substrate", 12e-6, SILICON},
        {"<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" thickness=\"9 um\"/>",
         " substrate-expansion=\"1 ppm/K\"", "as the scene states it", COPPER, 1e-6},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_plan *plan = loaded(row[i].flow, row[i].temperature);
        const fw_statics *s;
        const fw_mechanism *m;
        const fw_device_scene *scene;
        if (fw_plan_statics(plan, &s, &m, &scene) != FW_OK)
            fail_msg("%s", plan->diags.item[0].message);
        double strain = (1 + 100 * row[i].substrate_per_K) / (1 + 100 * row[i].layer_per_K) - 1;
        /* posts 1 mm high, 2 mm apart: their feet move as the places do where the arcs begin in the
           ground, a radius from the pins, and towards each other here */
        double apart = 2e-3 + m->pin[3].root_a_m.x - m->pin[0].root_a_m.x;
        assert_near(hypot(m->pin[0].root_a_m.x, m->pin[0].root_a_m.y), 130e-6, 40e-6);
        assert_near(s->angle_rad[0], -asin(strain * apart / 2e-3), 1e-9);
        assert_near(s->angle_rad[3], asin(strain * apart / 2e-3), 1e-9);
        bool named = false;
        for (int k = 0; k < s->ledger.count; k++)
            named = named || strstr(s->ledger.item[k].reason, row[i].name);
        if (!named) fail_msg("row %zu does not name %s", i, row[i].name);
        fw_plan_free(plan);
    }
}

/* ---- what comes down to it first as it dries ---- */

static const char bridge[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"bridge\"><material ref=\"silicon-100\" "
    "youngs-modulus=\"150 GPa\" poisson=\"0.25\" "
    "thickness=\"40 um\"/><flow ref=\"silicon-on-glass\" carrier=\"insulating\"/>"
    "<flexure id=\"short\" kind=\"leaf\" length=\"130 um\" width=\"30 um\" gap=\"10 um\"/>"
    "<flexure id=\"long\" kind=\"leaf\" length=\"1.3 mm\" width=\"6 um\" gap=\"10 um\"/><mechanism>"
    "<body id=\"left\" x=\"0 mm\" y=\"0.72 mm\" width=\"120 um\"/><body id=\"top\" x=\"1.4 mm\" "
    "y=\"1.44 mm\" width=\"120 um\"/>"
    "<body id=\"right\" x=\"2.4 mm\" y=\"0.72 mm\" width=\"120 um\"/>"
    "<revolute id=\"A\" a=\"ground\" b=\"left\" b-y=\"-0.72 mm\" hinge=\"short\" stiffness=\"1 N "
    "m/rad\"/>"
    "<revolute id=\"B\" a=\"left\" a-y=\"0.72 mm\" b=\"top\" b-x=\"-1.4 mm\" hinge=\"long\"/>"
    "<revolute id=\"C\" a=\"top\" a-x=\"1 mm\" b=\"right\" b-y=\"0.72 mm\" hinge=\"short\" "
    "stiffness=\"1 N m/rad\"/>"
    "<revolute id=\"D\" a=\"right\" a-y=\"-0.72 mm\" b=\"ground\" b-x=\"2.4 mm\" hinge=\"short\" "
    "stiffness=\"1 N m/rad\"/>"
    "</mechanism><scene name=\"s\" duration=\"1 ms\"><torque on=\"right\" value=\"0.001 uN "
    "m\"/></scene></device>";

/* A long leaf between bodies that stand still: where nothing is known of what these give, it is the first to be pulled down, by
   116.94 E I g^2/(2 (1 + t/w) w L^4) at the least gap, less by the leaf's own error; and its peel number is a strip's. */
static void a_strip_comes_down_first(void **state) {
    (void)state;
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    fw_plan *plan = fw_plan_new(&o);
    const fw_mechanism *built = NULL;
    if (fw_plan_load_memory(plan, "bridge.xml", bridge, strlen(bridge)) != FW_OK ||
        fw_plan_compute_flows(plan) != FW_OK ||
        fw_plan_mechanism(plan, plan->device->scene, &built) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    fw_mechanism_variant variant = *built->variant;
    variant.below =
        (fw_mechanism_below){.known = true, .m = 20e-6, .low_m = 18e-6, .high_m = 22e-6};
    variant.drying = (fw_mechanism_drying){.how = FW_DRIED_CALM, .words = "nothing"};
    fw_mechanism m = *built;
    m.variant = &variant;
    const fw_verdict_hung stiff = {.bears_N_per_m = HUGE_VAL}; /* and nothing of them hangs over */
    fw_verdict_hung hung[3] = {stiff, stiff, stiff};
    fw_verdict_out_of_plane flat = {.hung = hung};
    fw_verdict_variant_verdict v = {.variant = &variant, .mechanism = &m, .out_of_plane = &flat};
    assert_int_equal(m.nbody, 3);
    assert_int_equal(fw_verdict_stiction_judge(plan->arena, &m, false, &v), FW_OK);
    assert_non_null(v.stiction);
    const double E = 150e9, w = 6e-6, h = 40e-6, L = 1.3e-3, g = v.variant->below.low_m,
                 EI = E * w * h * h * h / 12;
    const double bears = 116.94 * EI * g * g / (2 * (1 + h / w) * w * L * L * L * L);
    assert_string_equal(v.stiction->below.a, "B");
    assert_null(v.stiction->below.b);
    const double share = v.stiction->below.tension_N_per_m[0] / bears;
    if (!(share > 0.9 && share < 0.98)) fail_msg("%g of what is borne", share);
    fw_plan_free(plan);
}

static void what_contradicts_the_flow_is_refused(void **state) {
    (void)state;
    fw_status status;
    fw_plan *plan = read_with("<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" "
                              "thickness=\"9 um\" carrier=\"insulating\"/>",
                              "", &status);
    assert_int_not_equal(status, FW_OK);
    assert_int_equal(plan->diags.item[0].number, 666);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_the_flow),
                                       cmocka_unit_test(a_strip_comes_down_first),
                                       cmocka_unit_test(what_contradicts_the_flow_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
