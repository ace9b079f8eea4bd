/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The schedule of every flow that will be written. */
#include "plan/stages.h"
#include <string.h>

static bool is_step(const fw_plan *plan, const char *id, size_t n) {
    for (int i = 0; i < plan->nflow; i++)
        for (int k = 0; plan->flow[i].flow && k < plan->flow[i].flow->nstep; k++) {
            const char *step = plan->flow[i].flow->step[k].id;
            if (strlen(step) == n && strncmp(step, id, n) == 0) return true;
        }
    return false;
}

/* a planning time for a step that no flow of the device has is a slip of the pen */
static fw_status check_planned(fw_plan *plan) {
    for (const char *at = plan->options.schedule.planned; at && *at;) {
        size_t part = strcspn(at, ","), name = strcspn(at, "=,");
        if (name < part && !is_step(plan, at, name)) {
            const char *id = fw_arena_strndup(plan->arena, at, name);
            FW_NEED(id);
            fw_diag_error(&plan->diags, 199, (fw_place){0},
                          "planning time for '%s': no flow of this device has such a step", id);
            return FW_USAGE;
        }
        at += part + (at[part] == ',');
    }
    return FW_OK;
}

fw_status fw_plan_schedules(fw_plan *plan) {
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    FW_TRY(check_planned(plan));
    for (int i = 0; given && i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        FW_TRY(fw_schedule_make(plan->arena, pf->flow, &plan->options.schedule, &plan->diags,
                                &pf->schedule));
        if (pf->schedule->feasible || pf->schedule->pause_s) continue;
        const char *why = fw_arena_printf(
            plan->arena, "the hold windows of the steps cannot be kept: %s", pf->schedule->why);
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, why));
    }
    return FW_OK;
}
