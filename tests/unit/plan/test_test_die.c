/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The test die has what steps read: as large as it needs where it is a file of its own, and said with the die that has room
   where it takes the place of a small die of a wafer. */
#include "plan/plan.h"
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char form[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"small\">"
    "<material ref=\"%s\" thickness=\"%s\"/><flow ref=\"%s\"/><die%s/>"
    "<flexure id=\"leaf\" kind=\"leaf\" length=\"200 um\" width=\"8 um\" gap=\"12 um\"/><mechanism>"
    "<body id=\"arm\" x=\"0.2 mm\" y=\"0.6 mm\" width=\"80 um\"/>"
    "<revolute id=\"A\" a=\"ground\" a-x=\"0.2 mm\" a-y=\"0 mm\" b=\"arm\" b-x=\"0 mm\" b-y=\"-0.6 mm\" hinge=\"leaf\"/>"
    "</mechanism><scene name=\"p\" duration=\"1 ms\"><force on=\"arm\" fx=\"1 uN\"/></scene>%s</device>";

static const struct {
    const char *id, *material, *thickness;
} flow[] = {{"al-masked-rie", "silicon-100", "50 um"},
            {"soi-deep-rie", "silicon-100", "50 um"},
            {"soi-double-sided", "silicon-100", "50 um"},
            {"silicon-on-glass", "silicon-100", "50 um"},
            {"copper-on-porous-silicon", "copper-plated", "9 um"}};
enum { FLOWS = sizeof flow / sizeof flow[0] };

static fw_plan *planned(int i, const char *die, const char *wafer) {
    static char xml[4000];
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.force = true;
    o.verdict.with_advice = false;
    o.verdict.corners = FW_CORNERS_NONE;
    o.verdict.motion.accuracy = 3e-2;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    snprintf(xml, sizeof xml, form, flow[i].material, flow[i].thickness, flow[i].id, die, wafer);
    if (fw_plan_load_memory(plan, "small.xml", xml, strlen(xml)) != FW_OK || fw_plan_judge(plan) != FW_OK ||
        fw_plan_fabricate(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "?");
    return plan;
}

static const char *said(const fw_plan *plan, int number) {
    for (size_t i = 0; i < plan->diags.count; i++)
        if (plan->diags.item[i].number == number) return plan->diags.item[i].message;
    return NULL;
}

/* every coupon that a step names is drawn; *read: how many were looked for */
static bool all_there(const fw_plan *plan, int *read) {
    const fw_plan_flow *pf = &plan->flow[0];
    bool all = true;
    *read = 0;
    assert_non_null(pf->coupons);
    for (int s = 0; s < pf->flow->nstep; s++)
        for (int k = 0; k < pf->flow->step[s].naccept; k++) {
            const char *coupon = pf->flow->step[s].accept[k].coupon;
            bool placed = false;
            for (int c = 0; c < pf->coupons->content->ncoupon; c++)
                placed |= pf->coupons->content->coupon[c].placed &&
                          strcmp(pf->coupons->content->coupon[c].pattern->id, coupon) == 0;
            *read += coupon[0] != '\0';
            all = all && (!coupon[0] || placed);
        }
    return all;
}

static void grows_where_it_is_alone(void **state) {
    (void)state;
    for (int i = 0; i < FLOWS; i++) {
        fw_plan *plan = planned(i, "", "");
        int read;
        const fw_geometry_box *own = &plan->layout->die, *test = &plan->flow[0].coupons->content->layout->die;
        assert_true(all_there(plan, &read) && read > 0);
        assert_null(said(plan, 621));
        assert_null(said(plan, 186));
        assert_null(plan->flow[0].coupons_lack);
        assert_true(test->x1 - test->x0 > own->x1 - own->x0 + 0.2e-3);
        assert_near(test->x0 + test->x1, own->x0 + own->x1, 1e-8);
        fw_plan_free(plan);
    }
}

static void a_place_of_a_wafer_is_said(void **state) {
    (void)state;
    for (int i = 0; i < FLOWS; i++) {
        char die[200], wide[32], high[32];
        int read;
        fw_plan *plan = planned(i, "", "<wafer diameter=\"50.8 mm\" test-dies=\"1\"/>");
        const char *why = said(plan, 621), *with = why ? strstr(why, "with <die width=") : NULL;
        assert_false(all_there(plan, &read));
        assert_non_null(said(plan, 186));
        assert_non_null(with);
        assert_non_null(plan->flow[0].coupons_lack);
        assert_non_null(strstr(why, plan->flow[0].coupons_lack));
        assert_int_equal(sscanf(with, "with <die width=\"%31[^\"]\" height=\"%31[^\"]\">", wide, high), 2);
        fw_plan_free(plan);
        snprintf(die, sizeof die, " width=\"%s\" height=\"%s\"", wide, high);
        plan = planned(i, die, "<wafer diameter=\"50.8 mm\" test-dies=\"1\"/>");
        assert_true(all_there(plan, &read));
        assert_null(said(plan, 621));
        fw_plan_free(plan);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grows_where_it_is_alone),
        cmocka_unit_test(a_place_of_a_wafer_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
