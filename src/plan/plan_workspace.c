/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The workspace of every flow. */
#include "plan/stages.h"
#include "workspace/map.h"

/* what could not be proved, at the place of the box */
static void warn(fw_plan *plan, const fw_report_workspace_flow *f) {
    const fw_device *d = plan->device;
    for (int k = 0; k < d->nworkspace; k++)
        if (f->required->asked[k] && f->required->box_reachable[k] && !f->required->proof[k].proved)
            fw_diag_warning(&plan->diags, 218, d->workspace[k].place,
                            "the required workspace could not be proved: a leg comes close to "
                            "stretched or folded, or a hinge to half a turn; its angles are from "
                            "samples");
    const fw_workspace_measure *v = &f->map->volume;
    if (f->map->none || v->reached) return;
    char width[32];
    double relative = 100.0 * (v->value.hi - v->value.lo) / v->value.hi;
    fw_diag_note(&plan->diags, 219, (fw_place){0},
                 "%s%sthe volume of the workspace is certified to %s %% only",
                 f->flow ? f->flow : "", f->flow ? ": " : "",
                 fw_number_text(width, sizeof width, relative, 2));
}

static fw_status one_flow(fw_plan *plan, const fw_plan_flow *pf, fw_report_workspace_flow *f) {
    const fw_device *d = plan->device;
    fw_workspace_map *map = fw_arena_one(plan->arena, fw_workspace_map);
    fw_workspace_result *required = fw_arena_one(plan->arena, fw_workspace_result);
    fw_workspace_regularity *singular =
        fw_arena_array(plan->arena, fw_workspace_regularity, (size_t)d->nworkspace);
    FW_NEED(map);
    FW_NEED(required);
    FW_NEED(singular);
    f->flow = pf->variant.flow;
    f->map = map, f->required = required, f->singular = singular;
    FW_TRY(fw_mechanism_build(plan->arena, d, plan->layout, &pf->variant, &plan->diags,
                              &f->mechanism));
    FW_TRY(fw_workspace_required(plan->arena, f->mechanism, &plan->diags, required));
    FW_TRY(fw_workspace_map_make(plan->arena, f->mechanism, fw_workspace_usual, map));
    for (int k = 0; k < d->nworkspace; k++) {
        const fw_workspace_proof *p = &required->proof[k];
        if (!p->proved) continue;
        const fw_workspace_box3 box = {{p->low[0], p->low[1], p->low[2]},
                                       {p->high[0], p->high[1], p->high[2]}};
        FW_TRY(fw_workspace_required_survey(plan->arena, &map->loop, &box, &singular[k]));
    }
    warn(plan, f);
    return FW_OK;
}

fw_status fw_plan_workspace(fw_plan *plan, fw_report_workspace *workspace) {
    const fw_device *d = plan->device;
    if (!d->six_bar)
        return fw_diag_error(&plan->diags, 217, (fw_place){.file = d->file},
                             "%s is not described by a <six-bar>, whose closed-form inverse "
                             "kinematics the workspace needs: use scenes instead",
                             d->name);
    FW_TRY(fw_plan_need_material(plan));
    fw_diags drawing =
        fw_diags_new(plan->arena); /* what cannot be drawn can be moved all the same */
    bool from_shapes = fw_device_needs_shapes(d);
    fw_status status =
        fw_layout_build(plan->arena, d, from_shapes ? &plan->diags : &drawing, &plan->layout);
    if (status != FW_OK && (from_shapes || (status != FW_GEOMETRY && status != FW_INPUT)))
        return status;
    if (status != FW_OK) plan->layout = NULL;
    fw_report_workspace_flow *flow =
        fw_arena_array(plan->arena, fw_report_workspace_flow, (size_t)plan->nflow);
    FW_NEED(flow);
    *workspace = (fw_report_workspace){.device = d, .flow = flow, .nflow = plan->nflow};
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(one_flow(plan, &plan->flow[i], &flow[i]));
    return FW_OK;
}
