/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where advice begins to look for smaller loads: the share of a scene's loads that may be accepted, from the pull-in voltages and
   fringe fields that are said beside it, for each reason that voltages give. And a motion that is nothing but round-off. */
#include "plan/plan.h"
#include "test.h"

static fw_plan *judged(const char *file) {
    fw_plan_options options = fw_plan_options_default();
    options.verdict.corners = FW_CORNERS_NONE;
    options.verdict.with_advice = false; /* where it would begin is said by what is judged */
    options.measurements = FW_MEASUREMENTS_NONE, options.without_masks = options.without_changes = true;
    fw_plan *plan = fw_plan_new(&options);
    const char *name = fw_arena_printf(plan->arena, "%s/tests/data/%s", FW_TEST_SOURCE_DIR, file);
    if (fw_plan_load(plan, name) != FW_OK || fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    return plan;
}

/* the reason of a scene with this number and these words; NULL: there is none */
static const fw_verdict_reason *reason_of(const fw_plan *plan, const char *scene, int number, const char *words) {
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].scene && strcmp(v->reason[i].scene, scene) == 0 && v->reason[i].number == number && strstr(v->reason[i].text, words))
            return &v->reason[i];
    return NULL;
}

static const fw_statics_pull_in *pull_in_of(const fw_plan *plan, int scene) {
    const fw_statics_pull_in *p = plan->verdict.variant[0].pull_in[scene];
    assert_non_null(p);
    return p;
}

/* pull goes with the square of a voltage: a step that throws only with the fringe fields asks for less by these and by what its flexures may be less stiff, one beyond pull-in
   by the square of its margin, never above 0.87 of that. Pull-in of this plate with its fringe is at 26.3 V. */
static void plates(void **state) {
    (void)state;
    fw_plan *plan = judged("said/thrown.xml");
    const fw_statics_pull_in *p = pull_in_of(plan, 0);
    const fw_verdict_reason *thrown = reason_of(plan, "step", 248, "dynamic pull-in"), *touched = reason_of(plan, "beyond", 242, "static pull-in");
    assert_non_null(thrown);
    assert_non_null(touched);
    assert_near(p->voltage_V, 26.31, 0.02);
    assert_true(p->fringe > 0.03 && p->fringe < 0.04);
    assert_int_equal(thrown->decision, FW_INCONCLUSIVE);
    assert_true(p->stiffness_error > 0.01 && p->stiffness_error < 0.03);
    assert_relative(thrown->keep, 0.98 * (1 - p->stiffness_error) / (1 + p->fringe), 1e-9);
    assert_int_equal(touched->decision, FW_REJECT);
    const double soft = pull_in_of(plan, 1)->stiffness_error,
                 by = p->voltage_V / (1.3 * 24.3 * sqrt((1 + p->fringe) / (1 - soft)));
    assert_true(by * by < 0.87);
    assert_relative(touched->keep, 0.98 * by * by, 1e-6);
    fw_plan_free(plan);
}

/* slender fingers: by which the scene is beyond what surely holds, and by the fringe */
static void fingers(void **state) {
    (void)state;
    fw_plan *plan = judged("said/slender.xml");
    const fw_statics_pull_in *p = pull_in_of(plan, 0);
    const fw_verdict_reason *snap = reason_of(plan, "oscillate", 595, "fingers");
    assert_non_null(snap);
    assert_relative(p->fingers, (40 / p->fingers_V) * (40 / p->fingers_V), 1e-9);
    assert_true(p->fingers > 2 && p->fringe > 0);
    assert_relative(snap->keep, 0.98 / ((1 + p->fringe) * p->fingers), 1e-9);
    fw_plan_free(plan);
}

/* loads that balance each other leave round-off, which no tolerance makes accurate: it was followed with tighter and tighter ones, to 1e-13, for
   half a minute */
static void balanced(void **state) {
    (void)state;
    fw_plan *plan = judged("balanced.xml");
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    assert_true(v->motion[0]->stats.rtol > 1e-9);
    assert_int_equal(v->requirement[0].decision, FW_REJECT);
    assert_true(fabs(v->requirement[0].value) < 1e-15);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(plates), cmocka_unit_test(fingers), cmocka_unit_test(balanced)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
