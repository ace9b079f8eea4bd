/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a layer is anchored to comes from its flow. A portal whose posts stand WIDE apart: its
   ground shrinks against a layer that expands more, and both posts lean by half of what that is
   between their flexures' roots over their height (they are held apart by a beam of the layer). The
   modulus is stated, so that the pins of silicon are where they are drawn. */
#include "plan/plan.h"
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

static fw_plan *loaded(const char *flow, const char *temperature) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.motion.effects.mode = FW_EFFECTS_ALL;
    o.verdict.motion.effects.hinge = FW_HINGE_REVOLUTE;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *xml = fw_arena_printf(plan->arena, "%s%s%s%s/></scene></device>", before, flow,
                                      behind, temperature);
    assert_non_null(xml);
    if (fw_plan_load_memory(plan, "portal.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

static void of_the_flow(void **state) {
    (void)state;
    static const struct {
        const char *flow, *temperature, *name;
        double layer_per_K, substrate_per_K;
    } row[] = {
        {"", "", "silicon substrate", 2.57e-6, 2.57e-6},
        {"<flow ref=\"al-masked-rie\"/>", "", "silicon substrate", 2.57e-6, 2.57e-6},
        {"<flow ref=\"al-masked-rie\" carrier=\"insulating\"/>", "", "borosilicate glass carrier",
         2.57e-6, 3.3e-6},
        {"<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" thickness=\"9 um\"/>",
         "", "silicon substrate", 16.7e-6, 2.57e-6},
        {"<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" thickness=\"9 um\"/>",
         " expansion=\"12 ppm/K\"", "silicon substrate", 12e-6, 2.57e-6},
        {"<flow ref=\"copper-on-porous-silicon\" material=\"copper-plated\" thickness=\"9 um\"/>",
         " substrate-expansion=\"1 ppm/K\"", "as the scene states it", 16.7e-6, 1e-6},
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_the_flow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
