/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the mask of one die, and the plate of a wafer, hand to the process: areas, edges, openings;
   and the flows computed with them. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static bool is_structure(fw_layout_role role) {
    return role == FW_ROLE_STRUCTURE || role == FW_ROLE_FLEXURE || role == FW_ROLE_FRAME ||
           role == FW_ROLE_TETHER;
}

/* edges of the material: a joint is a cut between two pieces, not an edge */
static double free_perimeter(const fw_geometry_contour *contour) {
    double length = 0.0;
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        if (s->flags & FW_SEGMENT_JOINT) continue;
        length += s->kind == FW_ARC ? s->radius * fabs(s->sweep_rad)
                                    : hypot(s->b.x - s->a.x, s->b.y - s->a.y);
    }
    return length;
}

/* does what is not joined in the layer stay where it is, and insulated? */
bool fw_plan_insulated(const fw_plan_flow *pf) {
    return (pf->use && pf->use->insulating_carrier) || (pf->flow && pf->flow->insulating);
}

static void add_areas(const fw_layout *layout, bool islands, fw_process_mask_facts *facts) {
    for (int i = 0; i < layout->npiece; i++)
        if (layout->piece[i].body == FW_ISLAND && !islands) {
            continue;
        } else if (is_structure(layout->piece[i].role)) {
            facts->structure_area_m2 += fw_geometry_contour_area(&layout->piece[i].contour);
            facts->perimeter_m += free_perimeter(&layout->piece[i].contour);
        } else if (layout->piece[i].role == FW_ROLE_TEXT || layout->piece[i].role == FW_ROLE_MARK) {
            /* lettering and marks lie in the frame and are taken out of it */
            facts->structure_area_m2 -= fw_geometry_contour_area(&layout->piece[i].contour);
            facts->perimeter_m += fw_geometry_contour_perimeter(&layout->piece[i].contour);
        }
    facts->die_area_m2 = (layout->die.x1 - layout->die.x0) * (layout->die.y1 - layout->die.y0);
}

static void narrowest(const fw_device *device, const fw_layout *layout,
                      fw_process_mask_facts *facts) {
    facts->narrowest_slot_m = layout->narrowest_gap_m;
    facts->narrowest_line_m = (double)INFINITY;
    for (int j = 0; j < device->nrevolute; j++)
        if (device->revolute[j].flexure != FW_NONE)
            facts->narrowest_line_m =
                fmin(facts->narrowest_line_m,
                     fw_device_flexure_narrowest_m(&device->flexure[device->revolute[j].flexure]));
    facts->deepest_hinge_width_m = facts->narrowest_line_m;
}

/* comb drives of the scenes that hold in a flow, each once: scenes may name the same one */
static fw_status find_drives(fw_arena *arena, const fw_device *d, const char *flow,
                             fw_process_drive_facts **drive, int *n) {
    size_t most = 0;
    *n = 0;
    for (int i = 0; i < d->nscene; i++)
        most += (size_t)d->scene[i].ncomb;
    FW_NEED(*drive = fw_arena_array(arena, fw_process_drive_facts, most));
    for (int i = 0; i < d->nscene; i++) {
        const fw_device_scene *s = &d->scene[i];
        if (!fw_device_in_flow(s->flow, flow)) continue;
        for (int k = 0; k < s->ncomb; k++) {
            const fw_device_comb *c = &s->comb[k];
            bool there = false;
            for (int l = 0; l < *n && !there; l++)
                there = c->id && (*drive)[l].id && strcmp((*drive)[l].id, c->id) == 0 &&
                        (*drive)[l].gap_m == c->gap_m;
            if (!there) (*drive)[(*n)++] = (fw_process_drive_facts){c->id, c->gap_m, c->place};
        }
    }
    return FW_OK;
}

/* conjugate gaps of hinges, gaps of the comb drives that hold in this flow */
static fw_status name_gaps(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                           const char *flow, fw_process_mask_facts *facts) {
    fw_process_drive_facts *drive;
    int ndrive, n = 0;
    FW_TRY(find_drives(arena, device, flow, &drive, &ndrive));
    fw_process_mask_gap *gap =
        fw_arena_array(arena, fw_process_mask_gap, (size_t)device->nrevolute + (size_t)ndrive);
    FW_NEED(gap);
    for (int j = 0; j < device->nrevolute; j++) {
        if (!layout->hinge[j].drawn || !(layout->hinge[j].gap_m > 0.0)) continue;
        gap[n] = (fw_process_mask_gap){.kind = FW_GAP_HINGE, .gap_m = layout->hinge[j].gap_m};
        FW_NEED(gap[n++].name = fw_arena_printf(arena, "gap of hinge %s", device->revolute[j].id));
    }
    for (int i = 0; i < ndrive; i++) {
        gap[n] = (fw_process_mask_gap){.kind = FW_GAP_COMB, .gap_m = drive[i].gap_m};
        FW_NEED(gap[n++].name = fw_arena_printf(arena, "gap of comb drive %s",
                                                drive[i].id ? drive[i].id : "(unnamed)"));
    }
    facts->gap = gap;
    facts->ngap = n;
    return FW_OK;
}

fw_status fw_plan_mask_facts(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_mechanism_variant *variant, const fw_mask_table *table,
                             bool insulated, fw_process_mask_facts *facts) {
    *facts = (fw_process_mask_facts){.dies = 1, .device_thickness_m = variant->thickness_m};
    if (!layout || !layout->drawn) return FW_OK;
    const fw_layout *marked; /* marks of the flow are taken out of the frame */
    int left_out;
    FW_TRY(fw_mask_frame_marks(arena, table, layout, &marked, &left_out));
    add_areas(marked, insulated, facts);
    narrowest(device, layout, facts);
    return name_gaps(arena, device, layout, variant->flow, facts);
}

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
            facts->wafer_perimeter_m += times * free_perimeter(c);
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
    const fw_layout *marked;
    int left_out;
    if (pf->release || !plan->layout || !plan->layout->drawn) return FW_OK;
    if (!fw_process_flow_releases(pf->flow)) return FW_OK;
    FW_TRY(fw_mask_frame_marks(plan->arena, pf->table, plan->layout, &marked, &left_out));
    return fw_release_solve(plan->arena, marked, fw_plan_insulated(pf),
                            fw_process_flow_frees_all(pf->flow), fw_process_flow_bond(pf->flow),
                            &pf->release);
}

fw_status fw_plan_flow_facts(fw_plan *plan, const fw_plan_flow *pf, fw_process_mask_facts *facts) {
    FW_TRY(fw_plan_mask_facts(plan->arena, plan->device, plan->layout, &pf->variant, pf->table,
                              fw_plan_insulated(pf), facts));
    facts->dies = plan->dies;
    facts->release = pf->release;
    facts->release_change = pf->release_change;
    return pf->wafer ? add_wafer_facts(plan->arena, pf->wafer, facts) : FW_OK;
}

/* a flow computed with its facts */
static fw_status compute_flow(fw_plan *plan, fw_plan_flow *pf, fw_diags *diags) {
    bool drawn = plan->layout && plan->layout->drawn;
    fw_process_mask_facts facts;
    FW_TRY(release_of(plan, pf));
    FW_TRY(fw_plan_flow_facts(plan, pf, &facts));
    FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, drawn ? &facts : NULL, diags));
    if (pf->flow->no_window && !pf->release_change) {
        fw_diags said = fw_diags_new(plan->arena);
        FW_TRY(fw_plan_release_change(plan, pf, &pf->release_change));
        facts.release_change = pf->release_change;
        FW_TRY(fw_process_flow_compute(plan->arena, pf->flow, &facts, &said));
    }
    fw_process_drive_facts *drive;
    int n;
    FW_TRY(find_drives(plan->arena, plan->device, pf->variant.flow, &drive, &n));
    return fw_process_flow_judge_drives(plan->arena, pf->flow,
                                        pf->use && pf->use->insulating_carrier, drive, n, diags);
}

fw_status fw_plan_compute_flows(fw_plan *plan) {
    FW_TRY(fw_plan_count_dies(plan));
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].flow) FW_TRY(compute_flow(plan, &plan->flow[i], &plan->diags));
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
