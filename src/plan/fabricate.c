/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/hash.h"
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static bool is_structure(fw_role role) {
    return role == FW_ROLE_STRUCTURE || role == FW_ROLE_FLEXURE || role == FW_ROLE_FRAME ||
           role == FW_ROLE_TETHER;
}

/* edges of the material: a joint is a cut between two pieces, not an edge */
static double free_perimeter(const fw_contour *contour) {
    double length = 0.0;
    for (int i = 0; i < contour->count; i++) {
        const fw_segment *s = &contour->segment[i];
        if (s->flags & FW_SEGMENT_JOINT) continue;
        length += s->kind == FW_ARC ? s->radius * fabs(s->sweep_rad)
                                    : hypot(s->b.x - s->a.x, s->b.y - s->a.y);
    }
    return length;
}

/* does what is not joined in the layer stay where it is, and insulated? */
static bool insulated(const fw_plan_flow *pf) {
    return (pf->use && pf->use->insulating_carrier) || (pf->flow && pf->flow->insulating);
}

/* what the process needs to know of the mask of one die, from the exact outlines */
static fw_mask_facts facts_of(const fw_device *device, const fw_layout *layout, bool islands) {
    fw_mask_facts facts = {.dies = 1};
    if (!layout || !layout->drawn) return facts;
    for (int i = 0; i < layout->npiece; i++)
        if (layout->piece[i].body == FW_ISLAND && !islands) {
            continue;
        } else if (is_structure(layout->piece[i].role)) {
            facts.structure_area_m2 += fw_contour_area(&layout->piece[i].contour);
            facts.perimeter_m += free_perimeter(&layout->piece[i].contour);
        } else if (layout->piece[i].role == FW_ROLE_TEXT || layout->piece[i].role == FW_ROLE_MARK) {
            /* lettering and marks lie in the frame and are taken out of it */
            facts.structure_area_m2 -= fw_contour_area(&layout->piece[i].contour);
            facts.perimeter_m += fw_contour_perimeter(&layout->piece[i].contour);
        }
    facts.die_area_m2 = (layout->die.x1 - layout->die.x0) * (layout->die.y1 - layout->die.y0);
    facts.narrowest_slot_m = layout->narrowest_gap_m;
    facts.narrowest_line_m = (double)INFINITY;
    for (int j = 0; j < device->njoint; j++)
        if (device->joint[j].flexure != FW_NONE)
            facts.narrowest_line_m =
                fmin(facts.narrowest_line_m,
                     fw_flexure_narrowest_m(&device->flexure[device->joint[j].flexure]));
    facts.deepest_hinge_width_m = facts.narrowest_line_m;
    return facts;
}

/* what the mask room does not know itself */
static fw_status notes_of(fw_plan *plan, const fw_plan_flow *pf, fw_mask_options *options) {
    char thickness[32];
    fw_number_text(thickness, sizeof thickness, pf->variant.thickness_m * 1e6, 6);
    const char *line[] = {
        fw_arena_printf(plan->arena, "material=%s", pf->variant.material.id),
        fw_arena_printf(plan->arena, "thickness_um=%s", thickness),
    };
    options->nnote = sizeof line / sizeof line[0];
    FW_NEED(options->note = fw_arena_alloc(plan->arena, (size_t)options->nnote, sizeof *line));
    for (int i = 0; i < options->nnote; i++)
        FW_NEED(options->note[i] = line[i]);
    return FW_OK;
}

/* a flow whose mask cannot be made says no, first of all its reasons */
fw_status fw_plan_flow_refused(fw_plan *plan, fw_flow *flow, const char *why) {
    const char **reason = fw_arena_alloc(plan->arena, (size_t)flow->nreason + 1, sizeof *reason);
    FW_NEED(reason);
    reason[0] = why;
    for (int i = 0; i < flow->nreason; i++)
        reason[i + 1] = flow->reason[i];
    flow->reason = reason;
    flow->nreason++;
    flow->manufacturable = 0;
    return FW_OK;
}

/* the mask of one flow; when rules or offsets refuse, the reason is kept and the plan goes on */
static fw_status build_mask(fw_plan *plan, fw_plan_flow *pf, bool rejected) {
    if (!plan->layout) { /* dimensions that do not fit: no flow can make it */
        pf->mask_error = "the device cannot be drawn with these dimensions; see the diagnostics";
        return fw_plan_flow_refused(plan, pf->flow, pf->mask_error);
    }
    if (!plan->layout->drawn) {
        pf->mask_error = plan->layout->why_not ? plan->layout->why_not : "the device has no shapes";
        return FW_OK;
    }
    fw_mask_options options = {.bias_m = pf->flow->bias_m,
                               .tolerance_m = plan->options.mask_tolerance_m,
                               .vertex_limit = plan->options.mask_vertices,
                               .rejected = rejected,
                               .no_islands = !insulated(pf),
                               .title = plan->device->die.title};
    FW_TRY(notes_of(plan, pf, &options));
    fw_status status = fw_mask_build(plan->arena, plan->layout, pf->table, plan->device->name,
                                     &options, &plan->diags, &pf->mask);
    if (status == FW_OK) return FW_OK;
    if (status != FW_GEOMETRY && status != FW_INPUT) return status;
    pf->mask = NULL;
    pf->mask_error = "the mask breaks a design rule or cannot be biased; see the diagnostics";
    return fw_plan_flow_refused(plan, pf->flow, pf->mask_error);
}

/* comb drives of the scenes that hold in a flow, each once: scenes may name the same one */
static fw_status drives_of(fw_plan *plan, const char *flow, fw_drive_facts **drive, int *n) {
    const fw_device *d = plan->device;
    size_t most = 0;
    *n = 0;
    for (int i = 0; i < d->nscene; i++)
        most += (size_t)d->scene[i].ncomb;
    FW_NEED(*drive = fw_arena_array(plan->arena, fw_drive_facts, most));
    for (int i = 0; i < d->nscene; i++) {
        const fw_scene *s = &d->scene[i];
        if (!fw_device_in_flow(s->flow, flow)) continue;
        for (int k = 0; k < s->ncomb; k++) {
            const fw_comb *c = &s->comb[k];
            bool there = false;
            for (int l = 0; l < *n && !there; l++)
                there = c->id && (*drive)[l].id && strcmp((*drive)[l].id, c->id) == 0 &&
                        (*drive)[l].gap_m == c->gap_m;
            if (!there) (*drive)[(*n)++] = (fw_drive_facts){c->id, c->gap_m, c->place};
        }
    }
    return FW_OK;
}

fw_status fw_plan_compute_flows(fw_plan *plan) {
    bool drawn = plan->layout && plan->layout->drawn;
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        fw_mask_facts facts = facts_of(plan->device, plan->layout, insulated(pf));
        facts.device_thickness_m = pf->variant.thickness_m;
        FW_TRY(fw_flow_compute(plan->arena, pf->flow, drawn ? &facts : NULL, &plan->diags));
        fw_drive_facts *drive;
        int n;
        FW_TRY(drives_of(plan, pf->variant.flow, &drive, &n));
        FW_TRY(fw_flow_judge_drives(plan->arena, pf->flow, pf->use && pf->use->insulating_carrier,
                                    drive, n, &plan->diags));
    }
    return FW_OK;
}

fw_status fw_plan_fabricate(fw_plan *plan) {
    bool rejected = plan->verdict.decision == FW_REJECT;
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        if (rejected && !plan->options.force) {
            pf->mask_error = "the design is rejected";
            continue;
        }
        FW_TRY(build_mask(plan, pf, rejected));
        if (!pf->mask) continue;
        pf->gds = fw_text_new(plan->arena);
        char hash[65];
        FW_TRY(fw_mask_write_gds(pf->mask, &pf->gds));
        fw_sha256(pf->gds.data, pf->gds.length, hash);
        FW_NEED(pf->mask_sha256 = fw_arena_strdup(plan->arena, hash));
    }
    return fw_plan_schedules(plan);
}
