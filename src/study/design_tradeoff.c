/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fw_design_tradeoff of the public library: the stage, and who composes its documents. */
#include "plan/design_state.h"
#include "study/tradeoff.h"

static fw_status work(fw_design *d, void *argument) {
    FW_TRY(fw_study_tradeoff_run(d->plan, argument, &d->tradeoff));
    d->tradeoff_document[0] = fw_study_tradeoff_json;
    d->tradeoff_document[1] = fw_study_tradeoff_text;
    d->tradeoff_document[2] = fw_study_tradeoff_csv;
    d->tradeoff_document[3] = fw_study_tradeoff_svg;
    return FW_OK;
}

int fw_design_tradeoff(fw_design *design, double budget_s, int times) {
    fw_study_tradeoff_options options = {.budget_s = budget_s, .times = times != 0};
    if (!design) return FW_STATUS_USAGE;
    if (!(budget_s == 0 || (budget_s >= 1 && budget_s <= 3600)))
        return (int)fw_plan_design_usage(design, "the budget of tradeoff is 1 to 3600 s, or 0");
    if (!(design->done & READ))
        return (int)fw_plan_design_usage(design, "read a description before its tradeoff");
    if (design->done & TRADEOFF) return FW_STATUS_OK;
    int status = fw_plan_design_run(design, work, &options);
    if (status == FW_STATUS_OK) design->done |= TRADEOFF;
    fw_plan_design_forget_documents(design);
    return status;
}
