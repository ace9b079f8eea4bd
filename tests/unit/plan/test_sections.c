/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cut of whole devices: what the section measures is what mask and certificate say. */
#include "mask/mask.h"
#include "plan/plan.h"
#include "recipe/recipe_profile.h"
#include "test.h"

static fw_plan *loaded(const char *name, const char *flow, const char *cut) {
    fw_plan_options o = fw_plan_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.flow = flow;
    o.force = true;
    o.cut = cut;
    fw_plan *plan = fw_plan_new(&o);
    assert_non_null(plan);
    const char *path =
        fw_arena_printf(plan->arena, "%s/docs/gallery/%s/device.xml", FW_TEST_SOURCE_DIR, name);
    assert_non_null(path);
    if (fw_plan_load(plan, path) != FW_OK) fail_msg("%s", plan->diags.item[0].message);
    return plan;
}

static fw_status fabricated(fw_plan *plan) {
    assert_int_equal(fw_plan_judge(plan), FW_OK);
    return fw_plan_fabricate(plan);
}

static void measure(fw_plan *plan, const char *id, double value) {
    fw_quantity *q = (fw_quantity *)fw_process_flow_quantity(plan->flow[0].flow, id);
    assert_non_null(q);
    q->unknown = false;
    q->value = value;
    q->uncertainty = 0.001;
    q->status = FW_MEASURED;
}

static const fw_recipe_section_opening *narrowest(const fw_recipe_section_plan *p) {
    const fw_recipe_section_opening *best = NULL;
    for (int i = 0; i < p->nopening; i++)
        if (!best || p->opening[i].drawn_m < best->drawn_m) best = &p->opening[i];
    assert_non_null(best);
    return best;
}

/* least distance between the top faces of different parts, from the outlines as fabricated */
static double fabricated_space(fw_plan *plan) {
    fw_mask_outlines o;
    double least = HUGE_VAL;
    assert_int_equal(fw_mask_outlines_of(plan->arena, plan->flow[0].mask, &o), FW_OK);
    for (int i = 0; i < o.n; i++)
        for (int k = 0; k < i; k++) {
            const fw_geometry_contour *p = &o.outline[i].top, *q = &o.outline[k].top;
            if (p->count == 0 || q->count == 0) continue;
            fw_geometry_vec2 a, b;
            double d = fw_geometry_contour_distance(p, q, &a, &b);
            if (d > 1e-9) least = fmin(least, d); /* pieces that hang together touch */
        }
    return least;
}

static void check_gap(const char *name, const char *flow, bool known) {
    fw_plan *plan = loaded(name, flow, NULL);
    if (known) measure(plan, "rie.A", 0.985);
    assert_int_equal(fabricated(plan), FW_OK);
    const fw_plan_flow *pf = &plan->flow[0];
    if (!pf->mask || !pf->cut) fail_msg("%s: %s", name, pf->mask_error);
    fw_recipe_slicer slicer;
    fw_recipe_section_plan p;
    assert_int_equal(fw_recipe_slicer_start(plan->arena, pf->mask, pf->cut, &slicer), FW_OK);
    assert_int_equal(fw_recipe_section_plan_of(&slicer, pf->flow, &p), FW_OK);
    const fw_recipe_section_opening *gap = narrowest(&p);
    const fw_process_edge_class *c = &pf->flow->edges.cls[0];
    /* the gap as drawn, as the mask's rules measure it, as fabricated */
    assert_near(gap->drawn_m, c->drawn_m, 1e-11);
    assert_near(gap->mask_m, pf->mask->measure[0].space_m, 1e-11);
    assert_near(gap->top_m, fabricated_space(plan), 1e-11);
    assert_near(gap->top_m, c->drawn_m - 2.0 * c->edge.top_m, 1e-11);
    assert_near(gap->bottom_m, c->drawn_m - 2.0 * c->edge.bottom_m, 1e-11);
    /* and square to the cut: along it the same */
    assert_near(gap->to_m - gap->from_m, gap->drawn_m, 1e-11);
    /* a flexure is in the section, and two bodies beside the gap */
    assert_true(p.npart >= 3);
    fw_plan_free(plan);
}

static void the_gap_of_the_certificate(void **state) {
    (void)state;
    check_gap("reference-six-bar", "al-masked-rie", false);
    check_gap("reference-six-bar", "al-masked-rie", true);
    check_gap("leaf-four-bar", "al-masked-rie", true);
    check_gap("free-form-four-bar", "al-masked-rie", true);
    check_gap("reference-six-bar", "copper-on-porous-silicon", false);
}

static void a_cut_of_ones_own(void **state) {
    (void)state;
    fw_plan *plan = loaded("reference-six-bar", "al-masked-rie", "0.1 mm, 0, 200, 50 um");
    assert_int_equal(fabricated(plan), FW_OK);
    const fw_recipe_cut *cut = plan->flow[0].cut;
    assert_near(cut->line.at.x, 1e-4, 1e-18);
    assert_near(cut->length_m, hypot(1e-4, 5e-5), 1e-18);
    assert_near(cut->line.along.y, 5e-5 / cut->length_m, 1e-15);
    plan->options.cut = "flexure:C";
    assert_int_equal(fw_plan_fabricate(plan), FW_OK);
    assert_non_null(strstr(plan->flow[0].cut->name, "hinge C"));
    static const char *const wrong[] = {"1,2,3",     "1,2,3,4,5", "1,2,3,4 kg", "5,5,5,5",
                                        "flexure:Z", "flexure:",  "a",          "0,0,1e9,0"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        plan->options.cut = wrong[i];
        assert_int_equal(fw_plan_fabricate(plan), FW_USAGE);
        assert_int_equal(plan->diags.item[plan->diags.count - 1].number, 277);
    }
    fw_plan_free(plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_gap_of_the_certificate),
                                       cmocka_unit_test(a_cut_of_ones_own)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
