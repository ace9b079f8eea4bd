/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flows computed with what the mask of a die, or the plate of a wafer, hands to them: times, bias,
   judgement, and for a release the distances of the drawing. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

/* what one mask leaves standing, as drawn: + where a term of the plate draws, - where it takes away
   (lettering and marks lie within what they are taken out of) */
static void add_mask(const fw_mask *mask, const fw_mask_plate_term *term, int nterm, int times,
                     fw_process_mask_facts *facts) {
    for (int t = 0; t < nterm; t++)
        for (int i = 0; i < mask->nshape; i++) {
            const fw_geometry_contour *c = &mask->shape[i].piece->contour;
            if (mask->shape[i].layer != term[t].layer) continue;
            double sign = term[t].rule == FW_SET_NOT ? -1.0 : 1.0;
            facts->wafer_structure_m2 += sign * times * fw_geometry_contour_area(c);
            facts->wafer_perimeter_m += times * fw_plan_free_perimeter(c);
        }
}

/* what the plate of a wafer places, added to the facts of its die: exact areas and edges as
   drawn */
static fw_status add_wafer_facts(fw_arena *arena, const fw_wafer *wafer,
                                 fw_process_mask_facts *facts) {
    fw_mask_plate_term *term;
    int n;
    FW_TRY(fw_mask_plate_terms(arena, wafer->table, &term, &n));
    facts->wafer_structure_m2 = facts->wafer_perimeter_m = 0.0;
    for (int i = 0; i < wafer->ncell; i++)
        if (wafer->cell[i].mask)
            add_mask(wafer->cell[i].mask, term, n, wafer->cell[i].placed, facts);
    facts->wafer_diameter_m = wafer->form.diameter_m;
    for (int i = 0; i < wafer->grid.nsite; i++) {
        const fw_wafer_site *site = &wafer->grid.site[i];
        double x = fmax(fabs((double)site->x), fabs((double)site->x + wafer->grid.width)),
               y = fmax(fabs((double)site->y), fabs((double)site->y + wafer->grid.height));
        facts->wafer_reach_m = fmax(facts->wafer_reach_m, 1e-9 * hypot(x, y));
    }
    facts->wafer_area_m2 =
        (double)wafer->grid.nsite * wafer->grid.width * wafer->grid.height * 1e-18;
    return FW_OK;
}

/* distances from the openings of the device with the flow's own marks, once */
static fw_status release_of(fw_plan *plan, fw_plan_flow *pf) {
    if (pf->release || !plan->layout || !plan->layout->drawn) return FW_OK;
    if (!fw_process_flow_releases(pf->flow)) return FW_OK;
    FW_TRY(fw_plan_release_solve(plan, pf, plan->layout, &pf->release));
    return fw_release_hold_find(plan->arena, plan->device, plan->layout, pf->release, &pf->hold);
}

fw_status fw_plan_flow_facts(fw_plan *plan, const fw_plan_flow *pf, fw_process_mask_facts *facts) {
    FW_TRY(fw_plan_mask_facts(plan->arena, plan->device, plan->layout, &pf->variant, pf->table,
                              fw_plan_insulated(pf), facts));
    facts->dies = plan->dies;
    facts->release = pf->release;
    facts->hold = pf->hold;
    facts->release_change = pf->release_change;
    return pf->wafer ? add_wafer_facts(plan->arena, pf->wafer, facts) : FW_OK;
}

/* a flow computed with its facts */
static fw_status compute_flow(fw_plan *plan, fw_plan_flow *pf, fw_diags *diags) {
    bool drawn = plan->layout && plan->layout->drawn;
    fw_process_mask_facts facts;
    fw_mask_verdict contents; /* hollows, pads: what the other plates draw */
    FW_TRY(release_of(plan, pf));
    FW_TRY(fw_plan_flow_facts(plan, pf, &facts));
    FW_TRY(fw_mask_contents_judge(plan->arena, pf->table, plan->layout, &contents));
    facts.widest_hollow_m = contents.widest_hollow_m;
    FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, drawn ? &facts : NULL, diags));
    if (pf->flow->no_window && !pf->release_change) {
        fw_diags said = fw_diags_new(plan->arena);
        FW_TRY(fw_plan_release_change(plan, pf, &pf->release_change));
        facts.release_change = pf->release_change;
        FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, &facts, &said));
    }
    for (int i = 0; i < contents.n; i++)
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, contents.reason[i]));
    FW_TRY(fw_plan_check_hollows(plan, pf, diags));
    fw_process_drive_facts *drive;
    int n;
    FW_TRY(fw_plan_find_drives(plan->arena, plan->device, pf->variant.flow, &drive, &n));
    FW_TRY(fw_process_flow_judge_drives(plan->arena, pf->flow,
                                        pf->use && pf->use->insulating_carrier, drive, n, diags));
    return fw_plan_wiring(plan, pf);
}

fw_status fw_plan_compute_flows(fw_plan *plan) {
    FW_TRY(fw_plan_count_dies(plan));
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow) {
            fw_arena_tell(plan->arena, "computing the steps", i, plan->nflow, "flows");
            FW_TRY(compute_flow(plan, &plan->flow[i], &plan->diags));
        }
    return FW_OK;
}

fw_status fw_plan_compute_wafers(fw_plan *plan) {
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow || !pf->wafer) continue;
        fw_diags said = fw_diags_new(plan->arena);
        FW_TRY(compute_flow(plan, pf, &said));
        if (pf->mask_error)
            FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, pf->mask_error));
    }
    return FW_OK;
}
