/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A lever on a hinge that gives, warm: everything elastic in it goes with Young's modulus, so that
   statics, modes and motions follow from the cold ones by similarity. */
#include "plan/plan.h"
#include "test.h"
#include <math.h>

static fw_plan *loaded(const char *load, const char *temperature, double duration_ms) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.motion.effects.mode = FW_EFFECTS_ALL;
    o.verdict.motion.rtol = 1e-11;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *xml = fw_arena_printf(
        plan->arena,
        "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
        "thickness=\"50 um\"/><flexure id=\"f\" kind=\"csfh\" radius=\"100 um\" angle=\"270 deg\" "
        "width=\"8 um\" gap=\"2 um\" fillet=\"4 um\"/><mechanism><body id=\"arm\" mass=\"0.02 "
        "mg\" inertia=\"0.003 mg mm^2\" x=\"0.5 mm\" y=\"0 mm\" width=\"100 um\"/><revolute "
        "id=\"h\" a=\"ground\" b=\"arm\" b-x=\"-0.5 mm\" hinge=\"f\" axis=\"180 deg\" "
        "damping=\"0 N m s/rad\"/></mechanism><scene name=\"a\" duration=\"%.17g ms\">"
        "<force on=\"arm\" y=\"0.1 mm\" %s/>%s</scene></device>",
        duration_ms, load, temperature);
    assert_non_null(xml);
    if (fw_plan_load_memory(plan, "lever.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

static const char warm[] =
    "<temperature change=\"200 K\" modulus-change=\"-2000 ppm/K\" expansion=\"0 ppm/K\" "
    "substrate-expansion=\"0 ppm/K\"/>";
static const char ramped[] =
    "<temperature change=\"200 K\" modulus-change=\"-2000 ppm/K\" expansion=\"0 ppm/K\" "
    "substrate-expansion=\"0 ppm/K\" law=\"ramp\" rise=\"1 ms\"/>";
static const char full[] = "fx=\"30 uN\" fy=\"-20 uN\"",
                  six_tenths[] = "fx=\"18 uN\" fy=\"-12 uN\"";

static const fw_statics *rest_of(fw_plan *plan) {
    const fw_statics *s;
    const fw_mechanism *m;
    const fw_device_scene *scene;
    if (fw_plan_statics(plan, &s, &m, &scene) != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    return s;
}

/* 0.6 of the modulus and 0.6 of the load: the same pose; by a law that ends there too */
static void equilibrium(void **state) {
    (void)state;
    fw_plan *cold = loaded(full, "", 2),
            *other[2] = {loaded(six_tenths, warm, 2), loaded(six_tenths, ramped, 2)};
    const fw_statics *a = rest_of(cold);
    assert_true(fabs(a->angle_rad[0]) > 0.005);
    for (int i = 0; i < 2; i++) {
        const fw_statics *b = rest_of(other[i]);
        assert_relative(b->angle_rad[0], a->angle_rad[0], 1e-9);
        for (int k = 0; k < 3; k++)
            assert_near(b->q[k], a->q[k], 1e-12);
        fw_plan_free(other[i]);
    }
    fw_plan_free(cold);
}

/* all three frequencies, rotation and both directions that the hinge gives in */
static void frequencies(void **state) {
    (void)state;
    fw_plan *plan[2] = {loaded(full, "", 2), loaded(full, warm, 2)};
    const fw_statics_modes *modes[2];
    for (int i = 0; i < 2; i++) {
        const fw_mechanism *m;
        const fw_device_scene *scene;
        assert_int_equal(fw_plan_modes(plan[i], &modes[i], &m, &scene), FW_OK);
        assert_int_equal(modes[i]->count, 3);
    }
    for (int k = 0; k < 3; k++)
        assert_relative(modes[1]->mode[k].stiffness_per_s2,
                        0.6 * modes[0]->mode[k].stiffness_per_s2, 1e-10);
    fw_plan_free(plan[0]), fw_plan_free(plan[1]);
}

static const fw_dynamics_motion *motion_of(fw_plan *plan) {
    const fw_dynamics_motion *motion;
    const fw_mechanism *m;
    const fw_device_scene *scene;
    unsigned wanted = FW_WANTED_FIGURES;
    if (fw_plan_simulate(plan, &wanted, &motion, &m, &scene) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    return motion;
}

/* The same motion, slower by sqrt(0.6). With a law: the energy that it takes away is booked, and it
   ends as soft as that. */
static void motions(void **state) {
    (void)state;
    fw_plan *plan[3] = {loaded(full, "", 1), loaded(six_tenths, warm, 1 / sqrt(0.6)),
                        loaded(full, ramped, 4)};
    const fw_dynamics_motion *a = motion_of(plan[0]), *b = motion_of(plan[1]),
                             *c = motion_of(plan[2]);
    assert_relative(b->peak[0].angle_rad, a->peak[0].angle_rad, 1e-7);
    assert_true(c->stats.energy_error < 1e-7);
    assert_true(fabs(c->peak[0].angle_rad) > 1.1 * fabs(a->peak[0].angle_rad));
    for (int i = 0; i < 3; i++)
        fw_plan_free(plan[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equilibrium), cmocka_unit_test(frequencies),
                                       cmocka_unit_test(motions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
