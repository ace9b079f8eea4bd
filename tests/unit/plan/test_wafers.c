/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer of a plan: every step of its sweep is the device that --set would make, a rejected one
   is replaced unless forced, and the process works with the number of dies. */
#include "base/constants.h"
#include "plan/plan.h"
#include "plan/stages.h"
#include "test.h"
#include <stdlib.h>

#define WAFER "tests/data/wafer/leaf-wafer.xml"

static fw_plan *begun(const fw_device_set *set, int nset, bool force, int dies) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.set = set;
    o.nset = nset;
    o.force = force;
    o.dies = dies;
    o.verdict.with_advice = false;
    o.verdict.corners = FW_CORNERS_NONE; /* as drawn: quick */
    o.verdict.motion.accuracy = 3e-2;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    if (fw_plan_load(plan, FW_TEST_SOURCE_DIR "/" WAFER) != FW_OK || fw_plan_judge(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "?");
    return plan;
}

static fw_plan *planned(const fw_device_set *set, int nset, bool force, int dies) {
    fw_plan *plan = begun(set, nset, force, dies);
    if (fw_plan_fabricate(plan) != FW_OK)
        fail_msg("%s", plan->diags.count ? plan->diags.item[0].message : "?");
    return plan;
}

static fw_plan *shared;

static int set_up(void **state) {
    (void)state;
    shared = planned(NULL, 0, false, 0);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    fw_plan_free(shared);
    return 0;
}

static const fw_diag *said(const fw_plan *plan, int number) {
    for (size_t i = 0; i < plan->diags.count; i++)
        if (plan->diags.item[i].number == number) return &plan->diags.item[i];
    return NULL;
}

static bool same_polygons(const fw_mask *a, const fw_mask *b) {
    if (a->nshape != b->nshape) return false;
    for (int i = 0; i < a->nshape; i++) {
        const fw_geometry_polygon *p = &a->shape[i].polygon, *q = &b->shape[i].polygon;
        if (p->count != q->count || a->shape[i].layer != b->shape[i].layer) return false;
        for (int k = 0; k < p->count; k++)
            if (p->vertex[k].x_dbu != q->vertex[k].x_dbu ||
                p->vertex[k].y_dbu != q->vertex[k].y_dbu)
                return false;
    }
    return true;
}

static void steps_are_what_set_makes(void **state) {
    (void)state;
    fw_plan *plan = shared;
    const fw_wafer *w = plan->flow[0].wafer;
    assert_non_null(w);
    assert_int_equal(w->nvariant, 4);
    static const char *const value[] = {NULL, "7 um", NULL, "15 um"};
    for (int v = 0; v < 4; v++) {
        if (!value[v]) continue;
        fw_device_set set = {"width", value[v]};
        fw_plan *alone = planned(&set, 1, false, 1);
        assert_null(alone->flow[0].wafer);
        assert_true(same_polygons(alone->flow[0].mask, w->variant[v].mask));
        assert_string_equal(w->variant[v].decision,
                            fw_verdict_decision_text(alone->verdict.variant[0].decision));
        double most = 0;
        for (int k = 0; k < alone->verdict.variant[0].nhinge; k++)
            most = fmax(most, alone->verdict.variant[0].hinge[k].utilisation);
        assert_relative(w->variant[v].utilisation, most, 1e-12);
        assert_relative(w->variant[v].value[0], atof(value[v]) * 1e-6, 1e-12);
        fw_plan_free(alone);
    }
    assert_false(same_polygons(w->variant[1].mask, w->variant[2].mask));
}

static void rejected_steps(void **state) {
    (void)state;
    fw_plan *plan = shared;
    const fw_wafer *w = plan->flow[0].wafer;
    assert_null(w->variant[0].mask);
    assert_string_equal(w->variant[0].decision, "reject");
    assert_true(w->variant[0].utilisation > 1);
    assert_false(w->rejected);
    const fw_diag *d = said(plan, 194);
    assert_non_null(d);
    assert_non_null(strstr(d->message, "width = 3 um"));
    plan = planned(NULL, 0, true, 0);
    w = plan->flow[0].wafer;
    assert_non_null(w->variant[0].mask);
    assert_true(w->variant[0].mask->rejected && w->rejected);
    assert_null(said(plan, 194));
    fw_plan_free(plan);
}

/* a value that the description does not allow is no reason to stop */
static void refused_steps(void **state) {
    (void)state;
    fw_device_set set = {"sweep/@from", "2 um"};
    fw_plan *plan = planned(&set, 1, false, 0);
    const fw_wafer *w = plan->flow[0].wafer;
    assert_null(w->variant[0].mask);
    assert_null(w->variant[0].decision);
    assert_non_null(strstr(w->variant[0].why, "3 um"));
    assert_non_null(said(plan, 194));
    int dies = 0;
    for (int v = 0; v < w->nvariant; v++)
        dies += w->variant[v].dies;
    assert_int_equal(dies, w->dies);
    fw_plan_free(plan);
}

static const fw_quantity *quantity(const fw_process_flow *flow, const char *id) {
    for (int i = 0; i < flow->nquantity; i++)
        if (flow->quantity[i]->id && strcmp(flow->quantity[i]->id, id) == 0)
            return flow->quantity[i];
    return NULL;
}

/* from the polygons, which have the bias: the aluminium is A = A0 - b P + O(b^2) once its etch has taken b from all edges, of
   lettering and marks, too */
static double standing(const fw_mask *mask, double taken_m) {
    const fw_mask_measure *m = mask->measure;
    return m[0].polygon_area_m2 - m[1].polygon_area_m2 - m[2].polygon_area_m2 -
           taken_m * (m[0].perimeter_m + m[1].perimeter_m + m[2].perimeter_m);
}

/* what the process etches is the area of everything that the plate places: dies of every step, the
   test die, alignment sites; whether or not other dies are planned too */
static void process_knows_dies(void **state) {
    (void)state;
    fw_plan *plan = shared;
    const fw_wafer *w = plan->flow[0].wafer;
    const fw_quantity *dies = quantity(plan->flow[0].flow, "mask.dies");
    const fw_quantity *area = quantity(plan->flow[0].flow, "mask.open-area");
    assert_true(dies || area);
    if (dies) assert_near(dies->value, w->dies, 0);
    /* the rim of the wafer lies in the plasma, too: a disc less the segment beyond its flat */
    const double R = 0.5 * w->form.diameter_m, turn = asin(0.5 * w->form.flat_m / R);
    double sites = (double)w->grid.nsite * w->grid.width * w->grid.height * 1e-18, left = 0.0;
    double whole = R * R * (FW_PI - turn + sin(turn) * cos(turn));
    assert_true(whole > 1.05 * sites);
    int placed = 0;
    for (int i = 0; i < w->ncell; i++) {
        left += w->cell[i].placed * standing(w->cell[i].mask, plan->flow[0].flow->edges.wet_m);
        placed += w->cell[i].placed;
    }
    assert_true(placed >= w->dies + w->tests + w->alignments);
    assert_non_null(area);
    assert_near(area->value, whole - left, 2e-3 * left);
    /* and that is not what so many dies of the description would be */
    fw_plan *one = planned(NULL, 0, false, 1);
    const fw_process_flow *single = one->flow[0].flow;
    const double D = quantity(single, "wafer.D")->value;
    double times = (0.25 * FW_PI * D * D - quantity(single, "mask.open-area")->value) * w->dies;
    assert_true(fabs(whole - area->value - times) > 5e-3 * times);
    fw_plan_free(one);
}

/* as many dies as there is room for the largest of the sweep, whichever way it is larger */
static void largest_step_counts(void **state) {
    (void)state;
    const fw_device_set to_it[] = {{"sweep/@parameter", "room"},
                                   {"sweep/@from", "400 um"},
                                   {"sweep/@to", "1.2 mm"},
                                   {"sweep/@steps", "2"}},
                        at_it[] = {to_it[0],
                                   {"sweep/@from", "1.1 mm"},
                                   to_it[2],
                                   to_it[3],
                                   {"room", "1.2 mm"}};
    fw_plan *sweep = begun(to_it, 4, false, 0), *alone = begun(at_it, 5, false, 0);
    assert_true(alone->dies > 1 && 2 * alone->dies < shared->dies);
    assert_int_equal(sweep->dies, alone->dies);
    fw_plan_free(sweep);
    fw_plan_free(alone);
}

/* a working day of five minutes is the shop's: the flow has no schedule there, and nothing is wrong with its windows */
static void a_short_day_is_no_reason_against_a_flow(void **state) {
    (void)state;
    fw_plan *plan = begun(NULL, 0, false, 1);
    plan->options.schedule.day = "08:00-08:05";
    assert_int_equal(fw_plan_schedules(plan), FW_OK);
    const fw_plan_flow *pf = &plan->flow[0];
    assert_true(!pf->schedule->feasible && pf->schedule->pause_s);
    assert_non_null(said(plan, 197));
    for (int i = 0; i < pf->flow->nreason; i++)
        assert_null(strstr(pf->flow->reason[i], "the hold windows of the steps cannot be kept"));
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_what_set_makes),
        cmocka_unit_test(largest_step_counts),
        cmocka_unit_test(rejected_steps),
        cmocka_unit_test(refused_steps),
        cmocka_unit_test(process_knows_dies),
        cmocka_unit_test(a_short_day_is_no_reason_against_a_flow),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
