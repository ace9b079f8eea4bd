/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Documents that span the flows of a plan; those of one flow are composed in its own room. */
#include "plan/ladder.h"
#include "plan/stages.h"
#include "report/json.h"

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

fw_status fw_plan_verdict_text(fw_plan *plan, fw_terminal_style style, fw_text *out) {
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    return fw_report_verdict_text(&input, style, out);
}

/* mechanisms are built again: what there is to say of them has been said by the verdict */
static fw_status report_ladders(fw_plan *plan, fw_ladders *ladders) {
    fw_diags said = plan->diags;
    plan->diags = fw_diags_new(plan->arena);
    fw_status status = fw_plan_ladders(plan, FW_LADDER_ONCE, ladders);
    plan->diags = said;
    return status;
}

fw_status fw_plan_report_html(fw_plan *plan, fw_text *out) {
    FW_TRY(fw_plan_assumptions(plan));
    fw_ladders ladders;
    fw_report_hinge *hinge;
    fw_report_input input = fw_plan_report_input(plan);
    FW_NEED(input.flow);
    FW_TRY(report_ladders(plan, &ladders));
    FW_TRY(fw_plan_report_hinges(plan, &ladders, &hinge));
    input.hinge = hinge, input.nhinge = ladders.count;
    return fw_report_write_html(plan->arena, &input, out);
}

fw_status fw_plan_masks_json(fw_plan *plan, fw_text *out) {
    fw_text_add(out, "{\"schema\":\"flexwright.masks/1\",\"masks\":[");
    int written = 0;
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].mask) {
            fw_text_add(out, written++ ? "," : "");
            FW_TRY(fw_mask_write_certificate(plan->flow[i].mask, plan->flow[i].mask_sha256, out));
        }
    fw_text_add(out, "],\"violations\":[");
    written = 0;
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].violated) {
            fw_text_add(out, written++ ? "," : "");
            FW_TRY(fw_mask_write_findings(plan->flow[i].violated, out));
        }
    fw_text_add(out, "]}\n");
    return fw_text_end(out);
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

/* one flow: its recipe; several: a document that holds them all */
fw_status fw_plan_recipes_json(fw_plan *plan, fw_text *out) {
    bool several = plan->nflow > 1;
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    if (several) fw_text_add(out, "{\"schema\":\"flexwright.recipes/1\",\"recipes\":[");
    int written = 0;
    for (int i = 0; given && i < plan->nflow; i++) {
        const fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        fw_recipe_header header = fw_plan_recipe_header(plan, pf);
        fw_text_add(out, written++ ? "," : "");
        FW_TRY(fw_recipe_write_json(pf->flow, &header, out));
    }
    if (several)
        fw_text_add(out, "]}\n");
    else if (!written)
        fw_text_add(out, "{\"schema\":\"flexwright.recipe/1\",\"flow\":null,\"steps\":[],"
                         "\"total_s\":null,\"rejected\":true,\"banner\":\"REJECTED\"}\n");
    return fw_text_end(out);
}
