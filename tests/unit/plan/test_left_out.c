/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What auto leaves out is in the stated error of every peak, of both kinds of motion, and counts
   once in the verdict. */
#include "plan/plan.h"
#include "test.h"
#include <math.h>

static fw_plan *loaded(const char *scene, fw_effect_mode mode, double accuracy) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.motion.effects.mode = mode;
    o.verdict.motion.effects.hinge = FW_HINGE_REVOLUTE;
    o.verdict.motion.accuracy = accuracy;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *xml = fw_arena_printf(
        plan->arena,
        "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
        "thickness=\"50 um\"/><flexure id=\"f\" kind=\"csfh\" radius=\"100 um\" angle=\"270 deg\" "
        "width=\"8 um\" gap=\"2 um\" fillet=\"4 um\"/><mechanism><body id=\"arm\" mass=\"0.02 "
        "mg\" inertia=\"0.003 mg mm^2\" x=\"0.5 mm\" y=\"0 mm\" width=\"100 um\"/><revolute "
        "id=\"h\" a=\"ground\" b=\"arm\" b-x=\"-0.5 mm\" hinge=\"f\" axis=\"180 deg\" "
        "stiffness=\"1e-6 N m/rad\" damping=\"0 N m s/rad\"/></mechanism>%s</device>",
        scene);
    assert_non_null(xml);
    if (fw_plan_load_memory(plan, "lever.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    return plan;
}

static const char *const slow =
    "<scene name=\"a\" duration=\"2 s\"><force on=\"arm\" x=\"0.5 mm\" fy=\"0.05 mN\" "
    "law=\"ramp\" rise=\"1.5 s\"/></scene>";
static const char *const quick =
    "<scene name=\"a\" duration=\"3 ms\"><force on=\"arm\" x=\"0.5 mm\" fy=\"0.05 mN\"/><gravity "
    "gy=\"-0.2 m/s^2\"/></scene>";

static void counted_once(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        fw_plan *some = loaded(i ? quick : slow, FW_EFFECTS_AUTO, 1e-2);
        fw_plan *all = loaded(i ? quick : slow, FW_EFFECTS_ALL, 1e-5);
        const fw_dynamics_motion *a = some->verdict.variant[0].motion[0];
        const fw_dynamics_motion *b = all->verdict.variant[0].motion[0];
        double out = a->ledger.left_out, peak = fabs(a->peak[0].angle_rad);
        assert_int_equal(strcmp(a->method, "quasi-static") == 0, i == 0);
        assert_true(out > 0 && out < 1e-2 && b->ledger.left_out == 0);
        double part = out / (1 - out) * peak;
        assert_true(a->peak[0].error_rad > part && a->peak[0].error_rad < part + 3e-3 * peak);
        assert_true(b->peak[0].error_rad < 1e-4 * peak);
        assert_true(fabs(peak - fabs(b->peak[0].angle_rad)) <
                    a->peak[0].error_rad + b->peak[0].error_rad);
        assert_true(some->verdict.variant[0].hinge[0].angle_error_rad == a->peak[0].error_rad);
        assert_true(some->verdict.accuracy_left_out == out);
        fw_plan_free(some), fw_plan_free(all);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(counted_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
