/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mask, recipe, verdict and outlines of whole devices have the same edges. */
#include "mask/mask.h"
#include "plan/plan.h"
#include "test.h"
#include <math.h>
#include <string.h>

static fw_plan *loaded(const char *name) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.flow = strcmp(name, "comb-stage") == 0 ? "silicon-on-glass" : "al-masked-rie";
    o.force = true;
    o.verdict.motion.effects.hinge = FW_HINGE_REVOLUTE; /* edges do not ask for more */
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *path =
        fw_arena_printf(plan->arena, "%s/docs/gallery/%s/device.xml", FW_TEST_SOURCE_DIR, name);
    assert_non_null(path);
    if (fw_plan_load(plan, path) != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    assert_int_equal(plan->nflow, 1);
    return plan;
}

/* as if the laboratory had measured it */
static void measure(fw_plan *plan, double A) {
    fw_quantity *q = (fw_quantity *)fw_process_flow_quantity(plan->flow[0].flow, "rie.A");
    assert_non_null(q);
    q->unknown = false;
    q->value = A;
    q->uncertainty = 0.001;
    q->status = FW_MEASURED;
}

static void same_contour(const fw_geometry_contour *p, const fw_geometry_contour *q,
                         const char *label) {
    if (p->count != q->count) fail_msg("%s: %d and %d segments", label, p->count, q->count);
    for (int i = 0; i < p->count; i++) {
        const fw_geometry_segment *a = &p->segment[i], *b = &q->segment[i];
        double off = hypot(a->a.x - b->a.x, a->a.y - b->a.y);
        if (!(off <= 1e-12)) fail_msg("%s: corner %d off by %g m", label, i, off);
        if (a->kind == FW_ARC) assert_near(a->radius, b->radius, 1e-12);
    }
}

/* taking back the whole bias gives every shape of the device as drawn, joints and all */
static void check_identity(fw_plan *plan) {
    fw_mask mask = *plan->flow[0].mask;
    const fw_mask_edges even = {.least_m = (double)NAN, .most_m = (double)NAN, .range = ""};
    mask.edges = &even;
    fw_mask_outlines o;
    assert_int_equal(fw_mask_outlines_of(plan->arena, &mask, &o), FW_OK);
    assert_true(o.n > 10 && o.gone_top == 0);
    for (int i = 0; i < o.n; i++)
        same_contour(&o.outline[i].top, &o.outline[i].shape->piece->contour,
                     o.outline[i].shape->piece->label);
}

static const fw_verdict_fabrication_input *anisotropy(const fw_plan *plan) {
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[0];
    for (int i = 0; i < v->ninput; i++)
        if (strcmp(v->input[i].name, "anisotropy") == 0) return &v->input[i];
    fail_msg("no anisotropy among the inputs");
    return NULL;
}

static void check_agreement(fw_plan *plan) {
    const fw_plan_flow *pf = &plan->flow[0];
    const fw_process_fixed_point *p = &pf->flow->edges;
    const fw_process_edge e = p->cls[p->field].edge;
    const fw_verdict_fabrication_input *in = anisotropy(plan);
    /* mask */
    assert_true(p->solved && pf->mask);
    assert_near(pf->mask->bias_m, p->bias_m, 0);
    assert_near(pf->mask->edges->top_m, e.top_m, 0);
    assert_near(pf->mask->edges->bottom_m, e.bottom_m, 0);
    /* the gap that the fixed point reckons with is the one that the mask's rules find */
    assert_near(pf->mask->measure[0].space_m, p->cls[0].plate_m, 1e-11);
    /* verdict: made before masks and times, from the same numbers */
    double x = in->unknown ? 1.0 : in->nominal;
    assert_near(in->edge_m * (x - in->even), e.middle_m, 1e-16);
    assert_near(in->flare_m * (x - in->drawn), e.bottom_m - e.top_m, 1e-16);
    /* recipe */
    for (int i = 0; i < pf->flow->nstep; i++)
        if (&pf->flow->step[i] == p->cut[0].step)
            assert_relative(pf->flow->step[i].time.nominal_s *
                                fw_process_flow_quantity(pf->flow, "rie.R")->value,
                            p->cut[0].planned_m, 1e-13);
}

static void one_result_for_everybody(void **state) {
    (void)state;
    static const char *const name[] = {"reference-six-bar", "comb-stage", "leaf-four-bar"};
    for (int i = 0; i < 3; i++)
        for (int known = 0; known < 2; known++) {
            fw_plan *plan = loaded(name[i]);
            if (known) measure(plan, 0.985);
            assert_int_equal(fw_plan_judge(plan), FW_OK);
            assert_int_equal(fw_plan_fabricate(plan), FW_OK);
            if (!plan->flow[0].mask) fail_msg("%s: %s", name[i], plan->flow[0].mask_error);
            check_agreement(plan);
            check_identity(plan);
            fw_plan_free(plan);
        }
}

/* where no bias exists no mask is made, and the flow says no */
static void no_mask_without_a_solution(void **state) {
    (void)state;
    fw_plan *plan = loaded("reference-six-bar");
    measure(plan, 0.85);
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    assert_int_equal(fw_plan_fabricate(plan), FW_OK);
    assert_false(plan->flow[0].flow->edges.solved);
    assert_null(plan->flow[0].mask);
    assert_non_null(strstr(plan->flow[0].mask_error, "no bias"));
    assert_int_equal(plan->flow[0].flow->manufacturable, 0);
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_result_for_everybody),
                                       cmocka_unit_test(no_mask_without_a_solution)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
