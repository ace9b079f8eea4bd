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

/* ---- what is lost first may be made wider ---- */

/* two narrow bars on small bases: what holds them goes before the bars are free */
static const char narrow_form[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"bars\">"
    "<material ref=\"silicon-100\" thickness=\"50 um\"/><flow ref=\"soi-deep-rie\"/>"
    "<flexure id=\"leaf\" kind=\"leaf\" length=\"400 um\" width=\"6 um\" gap=\"10 um\"/><mechanism>"
    "<body id=\"arm\" x=\"0 mm\" y=\"0.75 mm\" width=\"%s\"/>"
    "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"arm\" b-x=\"0 mm\" "
    "b-y=\"-0.75 mm\" hinge=\"leaf\"/></mechanism>%s"
    "<scene name=\"push\" duration=\"1 ms\"><force on=\"arm\" fx=\"1 nN\"/></scene></device>";

static fw_plan *of_arm(const char *width, const char *die) {
    static char text[4][3000];
    static int n;
    char *xml = text[n++ % 4];
    snprintf(xml, sizeof text[0], narrow_form, width, die);
    fw_plan_options options = fw_plan_options_default();
    fw_plan *plan = fw_plan_new(&options);
    if (fw_plan_load_memory(plan, "arm.xml", xml, strlen(xml)) != FW_OK ||
        fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    return plan;
}

/* a number of um behind a word of a text, which stays `other` where the word is not before `end` */
static double um_of(const char *text, const char *end, const char *word, double other) {
    const char *at = strstr(text, word);
    double um = other;
    if (at && at < end) assert_int_equal(sscanf(at + strlen(word), "%lf", &um), 1);
    return um;
}

static fw_plan *with(const char *width, const double *um) {
    char die[200];
    snprintf(die, sizeof die, "<die tethers=\"no\" anchor=\"%.17g um\" frame=\"%.17g um\"", um[0], um[1]);
    if (um[2] > 0.0) snprintf(die + strlen(die), sizeof die - strlen(die), " release-pitch=\"%.17g um\"", um[2]);
    snprintf(die + strlen(die), sizeof die - strlen(die), "/>");
    return of_arm(width, die);
}

/* Every <die .../> of a reason, beside what is stated, opens a window when it is drawn, and what is told of it is so; what is
   wider alone is no wider than it must be. How many there are. */
static int proposals_open(const fw_plan *plan, const char *width, const double *stated) {
    int n = 0;
    for (const char *at = strstr(plan->flow[0].flow->reason[0], "<die"); at; n++) {
        const char *end = strstr(at, "/>"), *next = strstr(end, "; or ");
        if (!next) next = end + strlen(end);
        double um[3] = {um_of(at, end, " anchor=\"", stated[0]), um_of(at, end, " frame=\"", stated[1]), um_of(at, end, " release-pitch=\"", 0.0)};
        fw_plan *again = with(width, um);
        if (again->flow[0].flow->no_window) fail_msg("%.*s opens nothing", (int)(end - at), at);
        assert_relative(1e6 * again->flow[0].release->needed_m, um_of(end, next, "free after ", 0.0), 6e-4);
        assert_relative(1e6 * again->flow[0].release->lost_m, um_of(end, next, "holds for ", 0.0), 6e-4);
        fw_plan_free(again);
        if (um[2] == 0.0) { /* steps of a hundredth of what is stated */
            for (int k = 0; k < 2; k++)
                um[k] -= um[k] > stated[k] ? 0.03 * stated[k] : 0.0;
            again = with(width, um);
            assert_true(again->flow[0].flow->no_window);
            fw_plan_free(again);
        }
        at = strstr(end, "<die");
    }
    return n;
}

static void wider_bases_open_a_window(void **state) {
    (void)state;
    static const double stated[][3] = {{60, 60, 0}, {200, 60, 0}};
    for (int i = 0; i < 2; i++) {
        fw_plan *plan = with("120 um", stated[i]);
        const fw_process_flow *f = plan->flow[0].flow;
        assert_true(f->no_window);
        const bool anchor = strstr(f->reason[0], "anchor=\"") != NULL, frame = strstr(f->reason[0], "frame=\"") != NULL;
        if (anchor != (i == 0) || !frame) fail_msg("%s", f->reason[0]);
        assert_non_null(strstr(f->reason[0], "release-pitch=\""));
        assert_int_equal(proposals_open(plan, "120 um", stated[i]), 2);
        fw_plan_free(plan);
    }
}

/* A pad that is lost first is made wider from what is stated, or from 150 um, and no wider than it must be. */
static double pad_wanted(int width_um, const char *die, bool *no_window) {
    static char text[2][4000];
    static int n;
    char *xml = text[n++ % 2];
    snprintf(xml, sizeof text[0],
             "<device xmlns=\"urn:flexwright:device:1\" name=\"pulled\"><material ref=\"silicon-100\" thickness=\"50 um\"/>"
             "<flow ref=\"soi-deep-rie\"/><flexure id=\"leaf\" kind=\"leaf\" length=\"400 um\" width=\"6 um\" gap=\"10 um\"/><mechanism>"
             "<body id=\"arm\" x=\"0 mm\" y=\"0.75 mm\" width=\"%d um\"/><revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"arm\" "
             "b-x=\"0 mm\" b-y=\"-0.75 mm\" hinge=\"leaf\"/></mechanism><die tethers=\"no\" anchor=\"500 um\" frame=\"500 um\" %s/>"
             "<scene name=\"pull\" duration=\"1 ms\"><comb-drive id=\"plate\" kind=\"plate\" on=\"arm\" x=\"%d um\" direction=\"0 deg\" "
             "gap=\"10 um\" length=\"200 um\" voltage=\"1 V\"/></scene></device>",
             width_um, die, width_um / 2 + 30);
    fw_plan_options options = fw_plan_options_default();
    fw_plan *plan = fw_plan_new(&options);
    if (fw_plan_load_memory(plan, "pulled.xml", xml, strlen(xml)) != FW_OK || fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "no message");
    const fw_process_flow *f = plan->flow[0].flow;
    double um = 0.0;
    *no_window = f->no_window;
    const char *at = f->no_window ? strstr(f->reason[0], " pad=\"") : NULL;
    if (f->no_window && (!at || strstr(f->reason[0], "frame=\"") || strstr(f->reason[0], "anchor=\""))) fail_msg("%s", f->reason[0]);
    if (at) assert_int_equal(sscanf(at, " pad=\"%lf", &um), 1);
    fw_plan_free(plan);
    return um;
}

static void wider_pads_open_a_window(void **state) {
    (void)state;
    static const struct {
        int width_um;
        double stated_um; /* 0: what is not stated, 150 um */
    } row[] = {{120, 0}, {120, 190}, {80, 105}};
    for (int i = 0; i < 3; i++) {
        char die[60] = "";
        bool none;
        const double stated = row[i].stated_um;
        if (stated > 0) snprintf(die, sizeof die, "pad=\"%.17g um\"", stated);
        double um = pad_wanted(row[i].width_um, die, &none);
        assert_true(none && um > (stated > 0 ? stated : 150));
        const double hundredths = round(um / (stated > 0 ? stated : 150) * 100); /* of what is there: such are the steps, and then to 1 um */
        assert_near(um, (stated > 0 ? stated : 150) * hundredths / 100, 0.51);
        snprintf(die, sizeof die, "pad=\"%.17g um\"", um);
        pad_wanted(row[i].width_um, die, &none);
        assert_false(none);
        snprintf(die, sizeof die, "pad=\"%.17g um\"", um - 0.03 * (stated > 0 ? stated : 150));
        pad_wanted(row[i].width_um, die, &none);
        assert_true(none);
    }
}

/* larger holes in a grid that is stated */
static void larger_holes_open_a_window(void **state) {
    (void)state;
    fw_plan *plan = judged("<die release-pitch=\"170 um\" release-hole=\"10 um\"/>");
    const fw_process_flow *f = plan->flow[0].flow;
    double hole = 0.0;
    if (!f->no_window) fail_msg("there is a window");
    const char *at = strstr(f->reason[0], "<die release-hole=\"");
    if (!at) fail_msg("%s", f->reason[0]);
    assert_int_equal(sscanf(at, "<die release-hole=\"%lf", &hole), 1);
    const char *pitch = strstr(f->reason[0], "<die release-pitch=\""), *frame = strstr(f->reason[0], "<die frame=\"");
    assert_true(frame && pitch && frame < pitch && pitch < at); /* the least change first: 2 %, 5 % and 40 % of what is there */
    assert_true(hole > 10.0 && hole <= 20.0);
    fw_plan_free(plan);
    char die[100];
    snprintf(die, sizeof die, "<die release-pitch=\"170 um\" release-hole=\"%.17g um\"/>", hole);
    plan = judged(die);
    assert_false(plan->flow[0].flow->no_window);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_change_is_the_least),
                                       cmocka_unit_test(wider_bases_open_a_window),
                                       cmocka_unit_test(wider_pads_open_a_window),
                                       cmocka_unit_test(larger_holes_open_a_window)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
