/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A swept wafer: its dies lie in one bath and have one plate, so that what a flow computes is of all of them, and what
   it cannot make of one step it cannot make of the wafer. */
#include "plan/plan.h"
#include "report/report.h"
#include "test.h"
#include <string.h>

static const char before[] = "<device xmlns='urn:flexwright:device:1' name='swept'>"
                             "<parameter name='gp' value='14 um' min='5 um' max='30 um'/>"
                             "<parameter name='w' value='8 um' min='4 um' max='16 um'/>"
                             "<parameter name='pitch' value='60 um' min='20 um' max='400 um'/>"
                             "<material ref='silicon-100' thickness='50 um'/><limits safety-factor='2'/>",
                  after[] =
                      "<flexure id='leaf' kind='leaf' length='400 um' width='w' gap='gp'/><mechanism>"
                      "<body id='left' x='0 mm' y='0.75 mm' width='120 um'/>"
                      "<body id='stage' x='1.1 mm' y='1.5 mm' plate-width='0.6 mm' plate-height='0.6 mm'/>"
                      "<body id='right' x='2.2 mm' y='0.75 mm' width='120 um'/>"
                      "<revolute id='A' a='ground' a-x='0 mm' a-y='0 mm' b='left' b-x='0 mm' b-y='-0.75 mm' hinge='leaf'/>"
                      "<revolute id='B' a='left' a-x='0 mm' a-y='0.75 mm' b='stage' b-x='-1.1 mm' b-y='0 mm' hinge='leaf'/>"
                      "<revolute id='C' a='stage' a-x='1.1 mm' a-y='0 mm' b='right' b-x='0 mm' b-y='0.75 mm' hinge='leaf'/>"
                      "<revolute id='D' a='right' a-x='0 mm' a-y='-0.75 mm' b='ground' b-x='2.2 mm' b-y='0 mm' hinge='leaf'/>"
                      "</mechanism><scene name='on' duration='2 ms'><force on='stage' fx='1 uN' fy='0 uN'/></scene></device>";

/* printing and transport measured, so that bias and time go by the openings */
static const char lab[] = "<process xmlns='urn:flexwright:process:1' id='lab' version='1' title='lab' flow='soi-deep-rie'>"
                          "<source id='m' kind='measured' date='2026-11-01'>test die</source>"
                          "<q id='drie.S' value='0.1' u='0.005' unit='1' status='measured' src='m'/>"
                          "<q id='drie.A' value='0.985' lo='0.984' hi='0.986' unit='1' status='measured' src='m'/></process>";

static fw_verdict_corners corners = FW_CORNERS_NONE;

static fw_plan *planned(const char *flows, const char *die, const char *sweep, const fw_device_set *set, int nset,
                        bool force) {
    static const fw_plan_lab_text text[] = {{"lab.xml", lab, sizeof lab - 1}};
    static char xml[4096];
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.set = set, o.nset = nset, o.force = force;
    o.lab_text = text, o.nlab_text = strstr(flows, "'soi-deep-rie'") && !strstr(flows, "double") ? 1 : 0;
    o.verdict.with_advice = false;
    o.verdict.corners = corners;
    o.verdict.motion.accuracy = 3e-2;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const int n = snprintf(xml, sizeof xml, "%s%s<die anchor='400 um' pad='300 um' %s/>%s%s%s%s", before, flows, die,
                           *sweep ? "<wafer diameter='50.8 mm'>" : "", sweep, *sweep ? "</wafer>" : "", after);
    if (fw_plan_load_memory(plan, "swept.xml", xml, (size_t)n) != FW_OK || fw_plan_judge(plan) != FW_OK ||
        fw_plan_fabricate(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[plan->diags.count - 1].message : "?");
    return plan;
}

static const char soi[] = "<flow ref='soi-deep-rie'/>";

static const char *reason_with(const fw_process_flow *flow, const char *words) {
    for (int i = 0; i < flow->nreason; i++)
        if (strstr(flow->reason[i], words)) return flow->reason[i];
    return NULL;
}

static double time_of(const fw_process_flow *flow, const char *step) {
    for (int i = 0; i < flow->nstep; i++)
        if (strcmp(flow->step[i].id, step) == 0) return flow->step[i].time.nominal_s;
    return (double)NAN;
}

/* holes 300 um apart leave a stage that is free when its bases have gone: half of the dies could never be released */
static void release_of_all(void **state) {
    (void)state;
    static const char die[] = "release-pitch='pitch' release-hole='15 um'";
    fw_plan *alone = planned(soi, die, "", NULL, 0, false),
            *all = planned(soi, die, "<sweep parameter='pitch' from='60 um' to='400 um' steps='2'/>", NULL, 0, false);
    const fw_process_flow *one = alone->flow[0].flow, *flow = all->flow[0].flow;
    assert_int_not_equal(one->manufacturable, 0);
    assert_true(flow->release->needed_m > 1.5 * one->release->needed_m);
    assert_non_null(strstr(flow->release->part[flow->release->slowest].label, "of step 2 (pitch = 400 um)"));
    assert_int_equal(flow->manufacturable, 0);
    assert_non_null(reason_with(flow, "of step 2 (pitch = 400 um)"));
    assert_non_null(reason_with(flow, "out of the <sweep>"));
    assert_null(reason_with(flow, "dies: ")); /* what is said of all is not said of a step once more */
    assert_true(time_of(flow, "D12") > 1.5 * time_of(one, "D12"));
    fw_plan_free(alone);
    fw_plan_free(all);
}

/* the etch goes by the narrowest slot of all, and every device is drawn with the bias of that one time */
static void one_time_and_bias(void **state) {
    (void)state;
    const fw_device_set set = {"gp", "6 um"};
    fw_plan *alone = planned(soi, "", "", &set, 1, false),
            *all = planned(soi, "", "<sweep parameter='gp' from='6 um' to='30 um' steps='2'/>", NULL, 0, false);
    const fw_wafer *w = all->flow[0].wafer;
    assert_non_null(w);
    assert_relative(time_of(all->flow[0].flow, "D09"), time_of(alone->flow[0].flow, "D09"), 1e-2);
    assert_non_null(reason_with(all->flow[0].flow, "of step 1 (gp = 6 um)"));
    assert_non_null(w->variant[0].mask);
    assert_non_null(w->variant[1].mask);
    for (int v = 0; v < w->nvariant; v++) {
        assert_true(w->variant[v].mask->bias_m == all->flow[0].mask->bias_m);
        assert_true(time_of(all->step[v]->flow[0].flow, "D09") == time_of(all->flow[0].flow, "D09"));
    }
    assert_relative(all->flow[0].flow->bias_m, alone->flow[0].flow->bias_m, 2e-2);
    fw_plan_free(alone);
    fw_plan_free(all);
}

/* a step that the description does not allow, in two flows, is told once */
static void replaced_once(void **state) {
    (void)state;
    fw_plan *plan = planned("<flow ref='soi-deep-rie'/><flow ref='soi-double-sided'/>", "",
                            "<sweep parameter='w' from='2 um' to='8 um' steps='2'/>", NULL, 0, false);
    int told = 0;
    for (size_t i = 0; i < plan->diags.count; i++)
        if (plan->diags.item[i].number == 194) {
            told++;
            assert_non_null(strstr(plan->diags.item[i].message, "in flow soi-deep-rie, soi-double-sided"));
        }
    assert_int_equal(told, 1);
    fw_text json = fw_text_new(plan->arena);
    assert_int_equal(fw_wafer_write_json(plan->flow[0].wafer, "", &json), FW_OK);
    assert_non_null(strstr(json.data, "\"verdict\": \"accept\""));
    assert_null(strstr(json.data, "\"verdict\": null")); /* the dies that stand there are judged */
    fw_plan_free(plan);
}

/* the device of the description is accepted, and half of the dies on its wafer are not */
static void headline(void **state) {
    (void)state;
    const fw_device_set set[] = {{"scene/force/@fx", "100 uN"}, {"w", "16 um"}};
    fw_plan *plan = planned(soi, "", "<sweep parameter='w' from='4 um' to='16 um' steps='2'/>", set, 2, true);
    const fw_plan_flow *pf = &plan->flow[0];
    fw_text text = fw_text_new(plan->arena);
    assert_int_equal(plan->verdict.decision, FW_ACCEPT);
    assert_non_null(pf->dies);
    assert_int_equal(pf->dies_decision, FW_REJECT);
    assert_non_null(strstr(pf->dies, "step 1 (w = 4 um), "));
    assert_int_equal(fw_plan_verdict_text(plan, (fw_report_terminal_style){0}, &text), FW_OK);
    assert_non_null(strstr(text.data, "swept: ACCEPT, but "));
    assert_non_null(strstr(text.data, " dies are rejected in soi-deep-rie\n"));
    fw_plan_free(plan);
}

/* the order says what a width may be off by: on a plate of several devices by what the one with the least room has */
static void the_least_room_counts(void **state) {
    (void)state;
    corners = FW_CORNERS_AUTO;
    fw_plan *plan = planned("<flow ref='al-masked-rie'/>", "", "<sweep parameter='w' from='8 um' to='12 um' steps='2'/>", NULL, 0, false);
    corners = FW_CORNERS_NONE;
    double room[2];
    for (int v = 0; v < 2; v++) {
        const fw_verdict_variant_verdict *judged = &plan->step[v]->verdict.variant[0];
        assert_int_equal(judged->decision, FW_ACCEPT);
        room[v] = 2 * judged->fabricated->room.edge_m;
    }
    assert_true(room[0] < 0.9 * room[1]);
    assert_relative(plan->flow[0].wafer->effect.left_m, room[0], 1e-9);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(release_of_all), cmocka_unit_test(one_time_and_bias),
                                       cmocka_unit_test(replaced_once), cmocka_unit_test(headline), cmocka_unit_test(the_least_room_counts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
