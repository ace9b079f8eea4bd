/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device at a point of what a flow may make says what the search of corners says of the same point. */
#include "plan/plan.h"
#include "test.h"
#include <math.h>

static void a_point_is_its_corner(void **state) {
    (void)state;
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = FW_TEST_SOURCE_DIR;
    options.verdict.with_advice = false;
    options.measurements = FW_MEASUREMENTS_NONE;
    fw_plan *plan = fw_plan_new(&options);
    assert_non_null(plan);
    assert_int_equal(
        fw_plan_load(plan, FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml"), FW_OK);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    int compared = 0;
    for (int i = 0; i < plan->nflow; i++) {
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        assert_non_null(v->fabricated);
        for (int c = 0; c < v->fabricated->ncorner; c++) {
            const fw_verdict_fabricated_corner *corner = &v->fabricated->corner[c];
            fw_verdict_made made;
            double most = 0;
            assert_int_equal(fw_verdict_made_at(plan->arena, plan->device, plan->layout,
                                                &plan->options.verdict, v, corner->x, &made),
                             FW_OK);
            for (int k = 0; k < v->nhinge; k++)
                if (corner->hinge[k].scene) most = fmax(most, corner->hinge[k].utilisation);
            /* and what no hinge says: what tips the device out of its plane, in every scene */
            const double *ln = v->fabricated->ln + (size_t)c * (size_t)v->fabricated->ncheck;
            const int across = 2 * plan->device->nscene;
            for (int r = v->fabricated->ncheck - across; r < v->fabricated->ncheck; r++)
                most = fmax(most, isnan(ln[r]) ? 0 : exp(ln[r]));
            /* both are a first look or closer: its accuracy is 3 % */
            if (!(fabs(made.ln - log(most)) < 0.03))
                fail_msg("%s: %g, not %g", corner->what, exp(made.ln), most);
            assert_true(made.low <= made.ln && made.ln <= made.high && made.high < made.ln + 0.2);
            compared++;
        }
    }
    assert_true(compared >= 6);
    fw_plan_free(plan);
}

/* of one drawing in one flow */
static fw_plan *judged_as_drawn(void) {
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = FW_TEST_SOURCE_DIR;
    options.verdict.with_advice = false;
    options.verdict.corners = FW_CORNERS_NONE;
    options.measurements = FW_MEASUREMENTS_NONE;
    options.flow = "al-masked-rie";
    fw_plan *plan = fw_plan_new(&options);
    assert_non_null(plan);
    assert_int_equal(
        fw_plan_load(plan, FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml"), FW_OK);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    return plan;
}

static bool edges_alone(const fw_verdict_fabrication_input *in) {
    return in->edge_m != 0 && in->flare_m == 0 && in->thickness == 0 && in->youngs == 0;
}

/* Which quantity it is that moves the edges makes no difference: response surfaces have the state of a die for their inputs
   (study_made.c) and not what made it. */
static void what_counts_is_what_is_made(void **state) {
    (void)state;
    fw_plan *plan = judged_as_drawn();
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    double x[FW_FABRICATION_INPUTS];
    int a = FW_NONE, b = FW_NONE;
    for (int k = 0; k < v->ninput; k++) {
        x[k] = v->input[k].nominal;
        if (!edges_alone(&v->input[k])) continue;
        if (a == FW_NONE)
            a = k;
        else
            b = k;
    }
    assert_int_not_equal(b, FW_NONE);
    fw_verdict_made made[2];
    for (int i = 0; i < 2; i++) {
        const int k = i == 0 ? a : b;
        x[k] += 40e-9 / v->input[k].edge_m;
        assert_int_equal(fw_verdict_made_at(plan->arena, plan->device, plan->layout,
                                            &plan->options.verdict, v, x, &made[i]),
                         FW_OK);
        x[k] = v->input[k].nominal;
    }
    assert_true(fabs(made[0].ln - made[1].ln) < 1e-9);
    fw_plan_free(plan);
}

/* a flexure that is etched away is beyond its limit */
static void what_is_gone_fails(void **state) {
    (void)state;
    fw_plan *plan = judged_as_drawn();
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    double x[FW_FABRICATION_INPUTS];
    int edge = FW_NONE;
    for (int k = 0; k < v->ninput; k++) {
        x[k] = v->input[k].nominal;
        if (edge == FW_NONE && v->input[k].edge_m != 0) edge = k;
    }
    assert_int_not_equal(edge, FW_NONE);
    x[edge] -=
        5e-6 / v->input[edge].edge_m; /* every wall 5 um further in: hinges of 8 um are gone */
    fw_verdict_made made;
    assert_int_equal(fw_verdict_made_at(plan->arena, plan->device, plan->layout,
                                        &plan->options.verdict, v, x, &made),
                     FW_OK);
    assert_true(made.ln > 0);
    assert_int_equal(made.decision, FW_REJECT);
    assert_non_null(made.why);
    fw_plan_free(plan);
}

/* a margin is used by value, as a hinge is, and its band is told beside it: both times it would count twice */
static void pull_in_is_by_value(void **state) {
    (void)state;
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = FW_TEST_SOURCE_DIR;
    options.verdict.with_advice = false;
    options.measurements = FW_MEASUREMENTS_NONE;
    fw_plan *plan = fw_plan_new(&options);
    assert_non_null(plan);
    assert_int_equal(fw_plan_load(plan, FW_TEST_SOURCE_DIR "/tests/data/near-pull-in.xml"), FW_OK);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    const fw_statics_pull_in *p = v->pull_in[0];
    double x[FW_FABRICATION_INPUTS];
    for (int k = 0; k < v->ninput; k++)
        x[k] = v->input[k].nominal;
    fw_verdict_made made;
    assert_int_equal(fw_verdict_made_at(plan->arena, plan->device, plan->layout,
                                        &plan->options.verdict, v, x, &made),
                     FW_OK);
    assert_true(p->margin > 1 && p->margin < fw_statics_pull_in_margin(p));
    assert_true(made.high > made.ln + 0.04 && made.high < made.ln + 0.1);
    assert_true(made.low < made.ln - 0.02);
    if (!(fabs(made.ln + log(p->margin)) < 0.01)) /* with its band 0.055 more */
        fail_msg("%g, not %g", made.ln, -log(p->margin));
    fw_plan_free(plan);
}

/* each check has its own band: that of what is required, which governs, and not that of a hinge that bears nothing */
static void a_requirement_is_as_far_off_as_it_is(void **state) {
    (void)state;
    fw_plan_options options = fw_plan_options_default();
    options.data_directory = FW_TEST_SOURCE_DIR;
    options.verdict.with_advice = false;
    options.measurements = FW_MEASUREMENTS_NONE;
    fw_plan *plan = fw_plan_new(&options);
    assert_non_null(plan);
    assert_int_equal(fw_plan_load(plan, FW_TEST_SOURCE_DIR "/tests/data/turned-by-a-moment.xml"),
                     FW_OK);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    const fw_verdict_requirement *r = &v->requirement[0];
    const double none = 0;
    fw_verdict_made made;
    assert_int_equal(fw_verdict_made_at(plan->arena, plan->device, plan->layout,
                                        &plan->options.verdict, v, &none, &made),
                     FW_OK);
    assert_true(r->by_max && r->utilisation_high > 1.02 * r->utilisation);
    assert_true(v->hinge[0].utilisation_high < 1e-6);
    assert_near(made.ln, log(0.1 / 0.14), 1e-4);
    assert_near(made.high, log(r->utilisation_high), 1e-9);
    assert_near(made.low, log(r->utilisation_low), 1e-9);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_is_its_corner),
        cmocka_unit_test(what_counts_is_what_is_made),
        cmocka_unit_test(what_is_gone_fails),
        cmocka_unit_test(pull_in_is_by_value),
        cmocka_unit_test(a_requirement_is_as_far_off_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
