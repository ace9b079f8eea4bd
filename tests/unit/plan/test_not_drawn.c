/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A device whose motion has what its masks lack is rejected, with the reason on what is written all the
   same; the flow without that scene is not; advice says which parameter makes room. */
#include "plan/plan.h"
#include "plan/stages.h"
#include "test.h"
#include <stdio.h>
#include <string.h>

static const char text[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><parameter name=\"at\" value=\"%s um\" "
    "min=\"0 um\" max=\"600 um\"/><material ref=\"silicon-100\" thickness=\"50 um\"/>"
    "<flow ref=\"al-masked-rie\" carrier=\"insulating\"/><flexure id=\"f\" kind=\"csfh\" "
    "length=\"250 um\" angle=\"180 deg\" width=\"8 um\" gap=\"10 um\"/><mechanism><body "
    "id=\"paddle\" "
    "x=\"0.6 mm\" y=\"0 mm\" plate-width=\"0.8 mm\" plate-height=\"0.5 mm\"/><revolute id=\"H\" "
    "a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"paddle\" b-x=\"-0.6 mm\" b-y=\"0 mm\" hinge=\"f\"/>"
    "</mechanism><scene name=\"s\" duration=\"1 ms\"><comb-drive id=\"pull\" kind=\"comb\" "
    "on=\"paddle\" x=\"at\" y=\"0 mm\" direction=\"0 deg\" fingers=\"5\" gap=\"10 um\" "
    "overlap=\"40 um\" length=\"100 um\" voltage=\"10 V\"/></scene></device>";

static fw_plan *judged(const char *at, bool advice) {
    static char xml[2048];
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.with_advice = advice;
    o.verdict.corners = FW_CORNERS_NONE;
    o.force = true;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    snprintf(xml, sizeof xml, text, at);
    if (fw_plan_load_memory(plan, "d.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    if (fw_plan_judge(plan) != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

static void a_drawn_drive_is_accepted(void **unused) {
    (void)unused;
    fw_plan *plan = judged("480", false);
    assert_int_equal(plan->layout->nmissing, 0);
    assert_int_equal(plan->verdict.decision, FW_ACCEPT);
    assert_int_equal(plan->nbecause, 0);
    fw_plan_free(plan);
}

static void a_drive_without_room_is_rejected(void **unused) {
    (void)unused;
    fw_plan *plan = judged("100", false); /* within its own plate */
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    assert_int_equal(plan->layout->nmissing, 1);
    assert_int_equal(plan->verdict.decision, FW_REJECT);
    assert_int_equal(plan->verdict.drawn, FW_REJECT);
    assert_int_equal(v->nreason, 1);
    assert_int_equal(v->reason[0].number, 131);
    assert_non_null(strstr(v->reason[0].text, "comb drive pull at ("));
    assert_non_null(strstr(v->reason[0].text, "nearest room: x=\""));
    assert_int_equal(plan->nbecause, 1);
    assert_int_equal(fw_plan_masks(plan), FW_OK);
    assert_true(plan->flow[0].mask->rejected);
    assert_int_equal(plan->flow[0].mask->nbecause, 1);
    assert_string_equal(plan->flow[0].mask->because[0], plan->because[0]);
    fw_plan_free(plan);
}

/* a value of a parameter with which there is room is proposed, and nothing else is tried */
static void advice_finds_room(void **unused) {
    (void)unused;
    fw_plan *plan = judged("400", true);
    if (plan->layout->nmissing != 1) fail_msg("400 um has room");
    for (int i = 0; i < plan->verdict.nproposal; i++)
        assert_int_equal(plan->verdict.proposal[i].kind, FW_PROPOSE_PARAMETER);
    if (plan->verdict.nproposal == 0) assert_non_null(strstr(plan->verdict.advice_note, "no room"));
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drawn_drive_is_accepted),
        cmocka_unit_test(a_drive_without_room_is_rejected),
        cmocka_unit_test(advice_finds_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
