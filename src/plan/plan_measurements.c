/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which measurement pays, of the flows of a plan: what is asked for and when; the work is measuring/'s. */
#include "plan/stages.h"

/* Bands cost the corners once more for every input. Where what a flow makes is undecided and changes are
   searched for they are a small part of that; else they are asked for. */
static bool wanted(const fw_plan *plan, const fw_verdict_variant_verdict *v, bool written,
                   bool *bands) {
    bool undecided = v->fabricated && v->fabricated->decision == FW_INCONCLUSIVE;
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    *bands = true;
    switch (plan->options.measurements) {
    case FW_MEASUREMENTS_NONE:
        return false;
    case FW_MEASUREMENTS_ALL:
        return true;
    case FW_MEASUREMENTS_AUTO:
        break;
    }
    *bands = undecided && plan->options.verdict.with_advice;
    return *bands || (written && given);
}

static fw_status find(fw_plan *plan, fw_plan_flow *pf, const fw_verdict_variant_verdict *v,
                      bool bands) {
    const fw_layout *layout = plan->verdict.layout;
    bool judged_drawn = layout && layout->drawn, drawn = plan->layout && plan->layout->drawn;
    fw_process_mask_facts of_verdict, of_times;
    fw_process_flow *flow;
    if (judged_drawn)
        FW_TRY(fw_plan_mask_facts(plan->arena, plan->device, layout, &pf->variant, pf->table,
                                  fw_plan_insulated(pf), &of_verdict));
    FW_TRY(fw_plan_flow_facts(plan, pf, &of_times));
    FW_TRY(fw_plan_flow_again(plan, pf, &flow));
    const fw_measuring_request request = {.device = plan->device,
                                          .layout = layout,
                                          .options = &plan->options.verdict,
                                          .bands = bands,
                                          .verdict = v,
                                          .flow = flow,
                                          .drawn = judged_drawn ? &of_verdict : NULL,
                                          .facts = drawn ? &of_times : NULL};
    return fw_measuring_run(plan->arena, &request, &pf->measuring);
}

fw_status fw_plan_measurements_find(fw_plan *plan, bool written) {
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        const fw_verdict_variant_verdict *v = &plan->verdict.variant[i];
        bool bands;
        if (!pf->flow || !wanted(plan, v, written, &bands)) continue;
        if (pf->measuring && pf->measured_on == pf->wafer) continue;
        FW_TRY(find(plan, pf, v, bands));
        pf->measured_on = pf->wafer; /* with a plate the times are others */
    }
    return FW_OK;
}
