/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the mask of one die hands to the process: areas, edges, openings. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static bool is_structure(fw_layout_role role) {
    return role == FW_ROLE_STRUCTURE || role == FW_ROLE_FLEXURE || role == FW_ROLE_FRAME ||
           role == FW_ROLE_TETHER;
}

/* edges of the material: a joint is a cut between two pieces, not an edge */
double fw_plan_free_perimeter(const fw_geometry_contour *contour) {
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
            facts->perimeter_m += fw_plan_free_perimeter(&layout->piece[i].contour);
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
fw_status fw_plan_find_drives(fw_arena *arena, const fw_device *d, const char *flow,
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
    FW_TRY(fw_plan_find_drives(arena, device, flow, &drive, &ndrive));
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
