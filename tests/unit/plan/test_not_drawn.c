/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A device whose motion has what its masks lack is rejected, with the reason on what is written all the
   same; the flow without that scene is not; advice says which parameter makes room. */
#include "plan/plan.h"
#include "plan/stages.h"
#include "report/report_page.h"
#include "test.h"
#include <math.h>
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

static fw_plan *of_text(const char *format, const char *at, bool advice) {
    static char xml[2048];
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.with_advice = advice;
    o.verdict.corners = FW_CORNERS_NONE;
    o.force = true;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *place = strstr(format, "%s");
    snprintf(xml, sizeof xml, "%.*s%s%s", (int)(place - format), format, at, place + 2);
    if (fw_plan_load_memory(plan, "d.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    if (fw_plan_judge(plan) != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

static fw_plan *judged(const char *at, bool advice) {
    return of_text(text, at, advice);
}

static void a_drawn_drive_is_accepted(void **unused) {
    (void)unused;
    fw_plan *plan = judged("480", false);
    assert_int_equal(plan->layout->nmissing, 0);
    assert_int_equal(plan->verdict.decision, FW_ACCEPT);
    assert_int_equal(plan->nbecause, 0);
    fw_plan_free(plan);
}

/* A coupler that is drawn tilted, its flexures' free-angle left out: it was run as one that is let go from a bent
   pose, with 24 mN in flexures that are made at rest, and bands from 0 to 3467 %. */
static const char tilted[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" thickness=\"50 um\"/>"
    "<flow ref=\"al-masked-rie\" carrier=\"insulating\"/><flexure id=\"f\" kind=\"leaf\" length=\"321 um\" "
    "width=\"6.6 um\" gap=\"10 um\"/><mechanism><body id=\"l\" x=\"0 mm\" y=\"0.6 mm\" width=\"120 um\"/><body "
    "id=\"c\" x=\"0.8 mm\" y=\"1.3 mm\" phi=\"7.125016 deg\" width=\"140 um\"/><body id=\"r\" x=\"1.6 mm\" "
    "y=\"0.7 mm\" width=\"120 um\"/><revolute id=\"A\" a=\"ground\" b=\"l\" b-y=\"-0.6 mm\" hinge=\"f\"/>"
    "<revolute id=\"B\" a=\"l\" a-y=\"0.6 mm\" b=\"c\" b-x=\"-0.8062258 mm\" free-angle=\"%s\" hinge=\"f\"/>"
    "<revolute id=\"C\" a=\"c\" a-x=\"0.8062258 mm\" b=\"r\" b-y=\"0.7 mm\" free-angle=\"-7.125016 deg\" "
    "hinge=\"f\"/><revolute id=\"D\" a=\"r\" a-y=\"-0.7 mm\" b=\"ground\" b-x=\"1.6 mm\" hinge=\"f\"/>"
    "</mechanism><scene name=\"s\" duration=\"1 ms\"><force on=\"c\" fx=\"5 uN\" fy=\"0 N\"/><material-damping "
    "loss-factor=\"0.1\"/></scene></device>";

static void a_flexure_is_at_rest_where_it_is_drawn(void **unused) {
    (void)unused;
    fw_plan *plan = of_text(tilted, "7.125016 deg", true);
    assert_int_equal(plan->verdict.decision, FW_ACCEPT);
    fw_plan_free(plan);
    plan = of_text(tilted, "0 deg", true);
    assert_int_equal(plan->verdict.drawn, FW_INCONCLUSIVE);
    const fw_verdict_reason *why = &plan->verdict.variant[0].reason[0];
    assert_int_equal(why->number, 622);
    assert_non_null(strstr(why->text, "hinge B by 7.125 deg (free-angle=\"7.125016 deg\", line 1)"));
    assert_null(strstr(why->text, "hinge C"));
    assert_int_equal(plan->verdict.nproposal, 0);
    assert_non_null(strstr(plan->verdict.advice_note, "free-angle"));
    fw_plan_free(plan);
    /* a free-angle that contradicts the drawing: its hinges "used" 879 and its loads "stood" on an unstable equilibrium,
       so that a device was rejected by the motion of another one; what is drawn bears its loads (3.2 %) */
    plan = of_text(tilted, "-30 deg", false);
    assert_int_equal(plan->verdict.variant[0].reason[0].number, 622);
    assert_int_equal(plan->verdict.drawn, FW_INCONCLUSIVE);
    for (int k = 0; k < plan->verdict.nhinge; k++)
        assert_int_equal(plan->verdict.hinge[k].decision, FW_INCONCLUSIVE);
    fw_plan_free(plan);
}

/* a word that stands again at the head of the next one: "link link-2"; none in what is written for a comb
   drive and a body that are called what they are */
static void no_kind_stands_before_an_id_that_begins_with_it(void **unused) {
    (void)unused;
    static char named[2048];
    const char *from[] = {"id=\"pull\"", "\"paddle\"", "id=\"H\"", "name=\"s\""};
    const char *to[] = {"id=\"comb-drive-1\"", "\"link-2\"", "id=\"hinge-1\"", "name=\"scene-1\""};
    snprintf(named, sizeof named, "%s", text);
    for (int i = 0; i < 4; i++)
        for (char *at; (at = strstr(named, from[i]));) {
            char rest[2048];
            snprintf(rest, sizeof rest, "%s", at + strlen(from[i]));
            snprintf(at, sizeof named - (size_t)(at - named), "%s%s", to[i], rest);
        }
    fw_plan *plan = of_text(named, "100", false);
    fw_text out = fw_text_new(plan->arena);
    assert_int_equal(fw_plan_masks(plan), FW_OK);
    assert_int_equal(fw_plan_verdict_json(plan, &out), FW_OK);
    assert_int_equal(fw_plan_verdict_text(plan, (fw_report_terminal_style){0}, &out), FW_OK);
    assert_non_null(strstr(out.data, "comb-drive-1 at ("));
    for (int i = 0; i < plan->layout->npiece; i++)
        fw_text_printf(&out, "%s\n", plan->layout->piece[i].label);
    const char *twice[] = {"comb drive comb-drive", "link link-", "hinge hinge-", "scene scene-"};
    for (int i = 0; i < 4; i++)
        if (strstr(out.data, twice[i])) fail_msg("%.60s", strstr(out.data, twice[i]));
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

/* ---- joints and springs that no drawing has ---- */

static const char jointed[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
    "thickness=\"50 um\"/><flow ref=\"al-masked-rie\"/><flexure id=\"f\" kind=\"leaf\" "
    "length=\"400 um\" width=\"8 um\" gap=\"10 um\"/><mechanism>"
    "<body id=\"p\" x=\"0.8 mm\" y=\"0 mm\" plate-width=\"0.8 mm\" plate-height=\"0.5 mm\"%s/>"
    "<body id=\"q\" x=\"0.8 mm\" y=\"1.5 mm\" plate-width=\"0.8 mm\" plate-height=\"0.5 mm\"%s/>"
    "<revolute id=\"P\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"p\" b-x=\"-0.8 mm\" b-y=\"0 "
    "mm\" "
    "hinge=\"f\"/><revolute id=\"Q\" a=\"ground\" a-x=\"0 mm\" a-y=\"1.5 mm\" b=\"q\" "
    "b-x=\"-0.8 mm\" b-y=\"0 mm\" hinge=\"f\"/>%s</mechanism>"
    "<scene name=\"s\" duration=\"1 ms\"><force on=\"p\" fx=\"1 nN\"/></scene></device>";

static fw_plan *with_joint(const char *mass, const char *joint) {
    static char xml[3000];
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.verdict.with_advice = true;
    o.verdict.corners = FW_CORNERS_NONE;
    o.force = true;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    snprintf(xml, sizeof xml, jointed, mass, mass, joint);
    if (fw_plan_load_memory(plan, "d.xml", xml, strlen(xml)) != FW_OK)
        fail_msg("%s", plan->diags.item[0].message);
    if (fw_plan_judge(plan) != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

/* each by its name and its place, with what does its work; nothing is searched for */
static void what_is_never_drawn_is_rejected(void **unused) {
    (void)unused;
    static const struct {
        const char *joint, *says, *instead;
    } row[] = {
        {"<distance id=\"rod\" a=\"p\" a-y=\"0.2 mm\" b=\"q\" b-y=\"-0.2 mm\"/>",
         "distance joint rod at (800, 200) um", "a body with a width"},
        {"<spring id=\"soft\" a=\"p\" a-x=\"0.1 mm\" b=\"q\" stiffness=\"1 mN/m\"/>",
         "spring soft at (900, 0) um", "a leaf or a path"},
        {"<spring id=\"rope\" a=\"p\" b=\"q\" stiffness=\"1 mN/m\" cable=\"yes\"/>",
         "cable rope at (800, 0) um", "a leaf or a path"},
        {"<prismatic id=\"slide\" a=\"p\" b=\"q\" axis=\"90 deg\"/>",
         "prismatic joint slide at (800, 0) um", "two pairs of leaves"},
        {"<weld id=\"glue\" a=\"p\" a-y=\"0.75 mm\" b=\"q\" b-y=\"-0.75 mm\"/>",
         "weld joint glue at (800, 750) um", "draw both as one body"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_plan *plan = with_joint("", row[i].joint);
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
        assert_int_equal(plan->verdict.decision, FW_REJECT);
        assert_int_equal(plan->layout->nmissing, 1);
        assert_int_equal(v->reason[0].number, 130);
        assert_non_null(strstr(v->reason[0].text, row[i].says));
        assert_non_null(strstr(v->reason[0].text, "body p and body q apart"));
        assert_non_null(strstr(v->reason[0].text, row[i].instead));
        assert_int_equal(plan->verdict.nproposal, 0);
        assert_non_null(strstr(plan->verdict.advice_note, "never drawn"));
        assert_int_equal(fw_plan_masks(plan), FW_OK); /* forced, with the reason */
        assert_true(plan->flow[0].mask->rejected);
        assert_string_equal(plan->flow[0].mask->because[0], plan->because[0]);
        fw_plan_free(plan);
    }
}

/* The stops of a hinge are angles: a hinge that only its stop keeps within its limit was accepted. What
   has no stiffness is no stop. */
static void a_stop_is_not_drawn(void **unused) {
    (void)unused;
    static const char hinge[] =
        "<body id=\"r\" x=\"0.8 mm\" y=\"-2 mm\" plate-width=\"0.8 mm\" plate-height=\"0.5 mm\"/>"
        "<revolute id=\"R\" a=\"ground\" a-x=\"0 mm\" a-y=\"-2 mm\" b=\"r\" b-x=\"-0.8 mm\" "
        "b-y=\"0 mm\" hinge=\"f\" stop-max=\"2 deg\" stop-stiffness=\"1e-5 N m/rad\"/>";
    fw_plan *plan = with_joint("", hinge);
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    assert_int_equal(plan->verdict.decision, FW_REJECT);
    assert_int_equal(plan->layout->nmissing, 1);
    assert_int_equal(v->nreason, 1);
    assert_int_equal(v->reason[0].number, 130);
    assert_non_null(strstr(v->reason[0].text, "stop of hinge R at (0, -2000) um"));
    assert_non_null(strstr(v->reason[0].text, "between the ground and body r there"));
    assert_non_null(strstr(v->reason[0].text, "<contact>"));
    assert_non_null(strstr(plan->verdict.advice_note, "never drawn"));
    fw_plan_free(plan);
}

/* A driver is of the world outside: accepted, and said where the decision stands, among
   the messages, and in the certificate. */
static void a_driver_is_from_outside(void **unused) {
    (void)unused;
    fw_plan *plan = with_joint("", "<driver id=\"hand\" joint=\"P\" value=\"0.1 deg*t/(1 ms)\"/>");
    const fw_diags *said = &plan->diags;
    int notes = 0;
    assert_int_equal(plan->verdict.decision, FW_ACCEPT);
    assert_int_equal(plan->noutside, 1);
    assert_int_equal(plan->outside[0].number, 598);
    assert_non_null(strstr(plan->outside[0].text, "driver hand moves and holds hinge P, "));
    for (size_t i = 0; i < said->count; i++)
        notes += said->item[i].number == 598;
    assert_int_equal(notes, 1);
    fw_report_summary top;
    const fw_report_input in = fw_plan_report_input(plan);
    assert_int_equal(fw_report_summarise(plan->arena, &in, &top), FW_OK);
    notes = 0;
    for (int i = 0; i < top.nline; i++)
        notes += strcmp(top.line[i].label, "from outside") == 0;
    assert_int_equal(notes, 1);
    assert_int_equal(fw_plan_masks(plan), FW_OK);
    const fw_mask *mask = plan->flow[0].mask;
    assert_non_null(strstr(mask->note[mask->nnote - 1], "from_outside=driver hand"));
    fw_plan_free(plan);
}

/* ---- a contact with what no mask draws ----
   A paddle is pushed against a stop 5 um away. By hand: edges stand out by up to 0.37 um (0.15 um printed, 0.22 um of
   the aluminium). Of a stop that is put there only the paddle's edge comes nearer, 5.034 - 0.374 um = 4.66 um; one that
   is etched comes as much nearer again, 4.29 um. 4.4 um are required. A stop that is stated without a distance was
   refused as a gap that closes. */

static const char paddle[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" thickness=\"50 um\"/>"
    "<flow ref=\"al-masked-rie\"/><flexure id=\"f\" kind=\"csfh\" length=\"250 um\" angle=\"180 deg\" width=\"8 um\"/>"
    "<mechanism><body id=\"p\" x=\"0.6 mm\" y=\"0 mm\" plate-width=\"0.8 mm\" plate-height=\"0.5 mm\"/><revolute "
    "id=\"H\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"p\" b-x=\"-0.6 mm\" b-y=\"0 mm\" hinge=\"f\"/></mechanism>"
    "<probe id=\"way\" kind=\"displacement\" on=\"p\" direction=\"90 deg\"/><require probe=\"way\" measure=\"final\" "
    "min=\"4.4 um\" scene=\"s\"/><scene name=\"s\" duration=\"30 ms\"><force on=\"p\" fy=\"40 uN\" law=\"ramp\" rise=\"10 ms\"/>"
    "<contact id=\"stop\" a=\"p\" a-y=\"0.25 mm\" a-face=\"90 deg\" b=\"ground\" b-x=\"0.6 mm\" b-y=\"0.275 mm\" "
    "side=\"outside\" distance=\"20 um\" stiffness=\"500 N/m\" damping=\"1e-3 N s/m\"%s/></scene></device>";

/* a surface to which nothing sticks: whether the stop is let go again is not asked here */
static const char lets_go[] =
    "<process xmlns=\"urn:flexwright:process:1\" id=\"lab\" flow=\"al-masked-rie\" version=\"1\" title=\"lab\"><source id=\"own\" "
    "kind=\"measured\"/><q id=\"surface.adhesion\" value=\"0.001\" u=\"0.0001\" unit=\"mJ/m2\" status=\"measured\" src=\"own\"/></process>";

static double least_way(const fw_plan *plan) {
    const fw_verdict_fabricated_verdict *f = plan->verdict.variant[0].fabricated;
    double least = HUGE_VAL;
    assert_non_null(f);
    for (int c = 0; c < f->ncorner; c++)
        least = fmin(least, f->corner[c].requirement[0].value);
    return least;
}

static void a_stop_of_no_mask_is_placed_or_etched(void **unused) {
    (void)unused;
    static const struct {
        const char *undrawn, *says;
        fw_verdict_decision decision;
        double least_um;
        int both;
    } row[] = {{"", "judged is that it stands where it is stated, and", FW_INCONCLUSIVE, 4.29, 1},
               {" undrawn=\"placed\"", "it has to be put there from elsewhere, and", FW_ACCEPT, 4.66, 0},
               {" undrawn=\"etched\"", "masks that you add", FW_INCONCLUSIVE, 4.29, 0}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_plan_options o = fw_plan_options_default();
        char xml[2000];
        int both = 0;
        const fw_plan_lab_text lab = {"lab.xml", lets_go, strlen(lets_go)};
        o.data_directory = FW_TEST_SOURCE_DIR;
        o.lab_text = &lab, o.nlab_text = 1;
        o.verdict.with_advice = false;
        fw_plan *plan = fw_plan_new(&o);
        assert_non_null(plan);
        snprintf(xml, sizeof xml, paddle, row[i].undrawn);
        assert_int_equal(fw_plan_load_memory(plan, "d.xml", xml, strlen(xml)), FW_OK);
        assert_int_equal(fw_plan_judge(plan), FW_OK);
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
        assert_int_equal(plan->verdict.decision, row[i].decision);
        assert_int_equal(v->drawn, FW_ACCEPT);
        assert_true(fabs(1e6 * least_way(plan) - row[i].least_um) < 0.01);
        for (int k = 0; k < v->nreason; k++)
            both += v->reason[k].number == 657 && strstr(v->reason[k].text, "contact stop touches what no mask");
        assert_int_equal(both, row[i].both);
        assert_int_equal(plan->noutside, 1); /* the paddle is drawn */
        assert_int_equal(plan->outside[0].number, 656);
        assert_non_null(strstr(plan->outside[0].text, "contact stop: the masks draw nothing of ground at (600, 255) um: "));
        assert_non_null(strstr(plan->outside[0].text, row[i].says));
        assert_int_equal(fw_plan_recipe_header(plan, &plan->flow[0]).noutside, 1);
        fw_plan_free(plan);
    }
}

/* ---- what a hinge hangs on ---- */

/* An arm straight up on one hinge whose base goes straight down: the root block beside the ring hung on a strip of
   3.6 um between the ring's inner surface and the edge of the neck (FW-D138); the ring runs on to carry it. */
static void an_upright_arm_hangs_on_a_whole_ring(void **unused) {
    (void)unused;
    static const char upright[] =
        "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
        "thickness=\"50 um\"/><flow ref=\"al-masked-rie\"/><flexure id=\"f\" kind=\"csfh\" "
        "radius=\"%d um\" angle=\"240 deg\" width=\"8 um\"/><mechanism><body id=\"arm\" x=\"0 mm\" "
        "y=\"0.5 mm\" width=\"%d um\"/><revolute id=\"A\" a=\"ground\" b=\"arm\" b-y=\"-0.5 mm\" "
        "hinge=\"f\"/></mechanism><scene name=\"s\" duration=\"1 ms\"/></device>";
    for (int r = 70; r <= 100; r += 10)
        for (int width = 80; width <= 120; width += 20) {
            static char xml[2000];
            fw_plan_options o = fw_plan_options_default();
            o.data_directory = FW_TEST_SOURCE_DIR;
            fw_plan *plan = fw_plan_new(&o);
            assert_non_null(plan);
            snprintf(xml, sizeof xml, upright, r, width);
            assert_int_equal(fw_plan_load_memory(plan, "d.xml", xml, strlen(xml)), FW_OK);
            fw_diags said = fw_diags_new(plan->arena);
            const fw_layout *l;
            assert_int_equal(fw_layout_build(plan->arena, plan->device, &said, &l), FW_OK);
            for (size_t i = 0; i < said.count; i++)
                if (said.item[i].number == 138)
                    fail_msg("radius %d, width %d: %s", r, width, said.item[i].message);
            fw_plan_free(plan);
        }
}

/* a spring to the ground is a load from outside; nor is a device without joints rejected */
static void loads_from_outside_stay(void **unused) {
    (void)unused;
    static const char *const fine[] = {
        "", "<spring id=\"probe\" a=\"p\" b=\"ground\" b-x=\"2 mm\" stiffness=\"1 mN/m\" "
            "length=\"1.2 mm\"/>"};
    for (int i = 0; i < 2; i++) {
        fw_plan *plan = with_joint("", fine[i]);
        assert_int_equal(plan->layout->nmissing, 0);
        assert_int_equal(plan->verdict.decision, FW_ACCEPT);
        fw_plan_free(plan);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drawn_drive_is_accepted),
        cmocka_unit_test(a_flexure_is_at_rest_where_it_is_drawn),
        cmocka_unit_test(a_drive_without_room_is_rejected),
        cmocka_unit_test(no_kind_stands_before_an_id_that_begins_with_it),
        cmocka_unit_test(advice_finds_room),
        cmocka_unit_test(what_is_never_drawn_is_rejected),
        cmocka_unit_test(an_upright_arm_hangs_on_a_whole_ring),
        cmocka_unit_test(a_stop_is_not_drawn),
        cmocka_unit_test(a_driver_is_from_outside),
        cmocka_unit_test(a_stop_of_no_mask_is_placed_or_etched),
        cmocka_unit_test(loads_from_outside_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
