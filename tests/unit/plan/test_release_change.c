/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A device that its flow cannot release, and the change that the flow proposes, made. */
#include "test.h"
#include "plan/plan.h"

static const char device_form[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"stage\">"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/><flow ref=\"soi-deep-rie\"/>"
    "<flexure id=\"leaf\" kind=\"leaf\" length=\"400 um\" width=\"6 um\" gap=\"10 um\"/><mechanism>"
    "<body id=\"left\" x=\"0 mm\" y=\"0.75 mm\" width=\"120 um\"/>"
    "<body id=\"stage\" x=\"0.9 mm\" y=\"1.5 mm\" plate-width=\"0.7 mm\" plate-height=\"0.5 mm\"/>"
    "<body id=\"right\" x=\"1.8 mm\" y=\"0.75 mm\" width=\"120 um\"/>"
    "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"left\" b-x=\"0 mm\" b-y=\"-0.75 "
    "mm\" "
    "hinge=\"leaf\"/>"
    "<revolute id=\"B\" a=\"left\" a-x=\"0 mm\" a-y=\"0.75 mm\" b=\"stage\" b-x=\"-0.9 mm\" "
    "b-y=\"0 mm\" "
    "hinge=\"leaf\"/>"
    "<revolute id=\"C\" a=\"stage\" a-x=\"0.9 mm\" a-y=\"0 mm\" b=\"right\" b-x=\"0 mm\" "
    "b-y=\"0.75 mm\" "
    "hinge=\"leaf\"/>"
    "<revolute id=\"D\" a=\"right\" a-x=\"0 mm\" a-y=\"-0.75 mm\" b=\"ground\" b-x=\"1.8 mm\" "
    "b-y=\"0 mm\" "
    "hinge=\"leaf\"/></mechanism>%s"
    "<scene name=\"push\" duration=\"1 ms\"><force on=\"stage\" fx=\"1 uN\"/></scene></device>";

static fw_plan *judged(const char *die) {
    static char text[4][4000];
    static int n;
    char *xml = text[n++ % 4];
    snprintf(xml, sizeof text[0], device_form, die);
    fw_plan_options options = fw_plan_options_default();
    fw_plan *plan = fw_plan_new(&options);
    if (fw_plan_load_memory(plan, "stage.xml", xml, strlen(xml)) != FW_OK ||
        fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    return plan;
}

/* the pitch of the sentence opens a window when it is drawn; a coarser one does not */
static void the_change_is_the_least(void **state) {
    (void)state;
    fw_plan *plan = judged("");
    const fw_process_flow *f = plan->flow[0].flow;
    char die[80];
    double pitch = 0.0;
    assert_int_equal(f->manufacturable, 0);
    assert_true(f->no_window);
    const char *at = strstr(f->reason[0], "<die release-pitch=\"");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "<die release-pitch=\"%lf", &pitch), 1);
    fw_plan_free(plan);
    snprintf(die, sizeof die, "<die release-pitch=\"%.17g um\"/>", pitch);
    plan = judged(die);
    assert_true(plan->flow[0].flow->manufacturable != 0);
    assert_false(plan->flow[0].flow->no_window);
    fw_plan_free(plan);
    snprintf(die, sizeof die, "<die release-pitch=\"%.17g um\"/>", pitch + 12.0);
    plan = judged(die);
    assert_true(plan->flow[0].flow->no_window);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_change_is_the_least)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
