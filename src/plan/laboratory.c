/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laboratory packs of the options: read once, applied to every flow. */
#include "plan/stages.h"
#include "process/calibrate.h"
#include <string.h>

enum { MOST_BYTES = 1024 * 1024, MOST_PACKS = 8 };

struct fw_plan_lab {
    const char *file, *xml;
    size_t n;
    bool used;
};
typedef struct fw_plan_lab fw_plan_lab_pack;

static fw_status read_packs(fw_plan *plan) {
    const char *at = plan->options.laboratory;
    FW_NEED(plan->lab = fw_arena_array(plan->arena, fw_plan_lab_pack, MOST_PACKS));
    while (*at) {
        size_t n = strcspn(at, ",");
        fw_plan_lab_pack *pack = &plan->lab[plan->nlab];
        char *xml;
        if (plan->nlab == MOST_PACKS)
            return fw_diag_error(&plan->diags, 211, (fw_place){0}, "more than %d laboratory packs",
                                 MOST_PACKS);
        FW_NEED(pack->file = fw_arena_strndup(plan->arena, at, n));
        FW_TRY(fw_input_read(plan->arena, pack->file, MOST_BYTES, &plan->diags, &xml, &pack->n));
        pack->xml = xml;
        const char *slash = strrchr(pack->file, '/');
        FW_TRY(fw_plan_remember(plan, slash ? slash + 1 : pack->file, xml, pack->n));
        plan->nlab++;
        at += n + (at[n] == ',');
    }
    return FW_OK;
}

fw_status fw_plan_lab(fw_plan *plan, fw_process_flow *flow) {
    if (!plan->options.laboratory) return FW_OK;
    if (!plan->lab) FW_TRY(read_packs(plan));
    for (int i = 0; i < plan->nlab; i++) {
        fw_plan_lab_pack *pack = &plan->lab[i];
        int before = flow->noverride;
        FW_TRY(
            fw_process_lab_apply(plan->arena, pack->file, pack->xml, pack->n, flow, &plan->diags));
        pack->used = pack->used || flow->noverride > before;
    }
    return FW_OK;
}

fw_status fw_plan_lab_used(fw_plan *plan) {
    for (int i = 0; i < plan->nlab; i++)
        if (!plan->lab[i].used)
            fw_diag_warning(&plan->diags, 211, (fw_place){.file = plan->lab[i].file},
                            "this laboratory pack has no effect: it is for a flow that is not "
                            "planned here");
    return plan->diags.failed ? FW_NOMEM : FW_OK;
}

fw_status fw_plan_lab_assumptions(fw_plan *plan) {
    for (int i = 0; i < plan->nflow; i++) {
        const fw_process_flow *flow = plan->flow[i].flow;
        for (int k = 0; flow && k < flow->noverride; k++) {
            const fw_process_override *o = &flow->override[k];
            FW_TRY(fw_plan_assume(plan,
                                  "Flow %s: the laboratory's %s = %s stands for %s of the process "
                                  "pack. Source: %s.",
                                  flow->id, o->id, o->is, o->was, o->source));
        }
    }
    return FW_OK;
}
