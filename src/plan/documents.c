/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Documents that span the flows of a plan; those of one flow are composed in its own room. */
#include "base/json.h"
#include "plan/ladder.h"
#include "plan/stages.h"
#include "report/report_json.h"

static fw_report_flow *report_flows(fw_plan *plan) {
    fw_report_flow *flow = fw_arena_array(plan->arena, fw_report_flow, (size_t)plan->nflow);
    for (int i = 0; flow && i < plan->nflow; i++)
        flow[i] =
            (fw_report_flow){&plan->verdict.variant[i], plan->flow[i].flow, plan->flow[i].mask,
                             plan->flow[i].mask_error, plan->flow[i].violated};
    return flow;
}

fw_report_input fw_plan_report_input(fw_plan *plan) {
    return (fw_report_input){.device = plan->device,
                             .layout = plan->layout,
                             .verdict = &plan->verdict,
                             .flow = report_flows(plan),
                             .nflow = plan->nflow,
                             .version = FW_VERSION,
                             .assumption = plan->assumption,
                             .nassumption = plan->nassumption,
                             .diags = &plan->diags};
}

fw_status fw_plan_verdict_json(fw_plan *plan, fw_text *out) {
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    return fw_report_verdict_json(&input, out);
}

fw_status fw_plan_verdict_text(fw_plan *plan, fw_report_terminal_style style, fw_text *out) {
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    return fw_report_verdict_text(&input, style, out);
}

/* mechanisms are built again: what there is to say of them has been said by the verdict */
static fw_status report_ladders(fw_plan *plan, fw_plan_ladders *ladders) {
    fw_diags said = plan->diags;
    plan->diags = fw_diags_new(plan->arena);
    fw_status status = fw_plan_ladders_run(plan, FW_LADDER_ONCE, ladders);
    plan->diags = said;
    return status;
}

fw_status fw_plan_report_html(fw_plan *plan, fw_text *out) {
    FW_TRY(fw_plan_assumptions(plan));
    fw_plan_ladders ladders;
    fw_report_hinge *hinge;
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    FW_TRY(report_ladders(plan, &ladders));
    FW_TRY(fw_plan_report_hinges(plan, &ladders, &hinge));
    input.hinge = hinge, input.nhinge = ladders.count;
    return fw_report_write_html(plan->arena, &input, out);
}

fw_status fw_plan_masks_json(fw_plan *plan, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.masks/1");
    fw_json_list(&json, "masks");
    for (int i = 0; i < plan->nflow; i++) {
        const fw_plan_flow *f = &plan->flow[i];
        if (!f->mask) continue;
        FW_TRY(fw_mask_write_certificate(f->mask, f->mask_sha256, fw_json_value(&json, NULL)));
    }
    fw_json_end(&json);
    fw_json_list(&json, "violations");
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].violated)
            FW_TRY(fw_mask_write_findings(plan->flow[i].violated, fw_json_value(&json, NULL)));
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

fw_recipe_header fw_plan_recipe_header(const fw_plan *plan, const fw_plan_flow *pf) {
    return (fw_recipe_header){.device = plan->device->name,
                              .flow_sha256 = pf->flow_sha256,
                              .mask_sha256 = pf->mask_sha256,
                              .program_version = FW_VERSION,
                              .rejected = plan->verdict.decision == FW_REJECT,
                              .schedule = pf->schedule,
                              .mask = pf->mask,
                              .cut = pf->cut};
}

/* of a rejected device */
static fw_status no_recipe(fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.recipe/1");
    fw_json_null(&json, "flow");
    fw_json_list(&json, "steps");
    fw_json_end(&json);
    fw_json_null(&json, "total_s");
    fw_json_truth(&json, "rejected", true);
    fw_json_text(&json, "banner", "REJECTED");
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

static fw_status recipe(const fw_plan *plan, int flow, fw_text *out) {
    fw_recipe_header header = fw_plan_recipe_header(plan, &plan->flow[flow]);
    return fw_recipe_write_json(plan->flow[flow].flow, &header, out);
}

/* one flow: its recipe; several: a document that holds them all */
fw_status fw_plan_recipes_json(fw_plan *plan, fw_text *out) {
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    if (plan->nflow == 1)
        return given && plan->flow[0].flow ? recipe(plan, 0, out) : no_recipe(out);
    if (plan->nflow == 0) return no_recipe(out);
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.recipes/1");
    fw_json_list(&json, "recipes");
    for (int i = 0; given && i < plan->nflow; i++)
        if (plan->flow[i].flow) FW_TRY(recipe(plan, i, fw_json_value(&json, NULL)));
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}
