/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mask's own trade: chord error of arcs against vertices and bytes of the GDSII. */
#include "plan/stages.h"
#include "study/problem.h"
#include <math.h>

static const double tolerance_m[] = {2e-9, 5e-9, 10e-9, 20e-9, 50e-9, 100e-9, 200e-9, 500e-9};
enum { COUNT = sizeof tolerance_m / sizeof tolerance_m[0] };

/* the flow of the scene, else the first one with a layer table */
static fw_plan_flow *flow_of(const fw_study_problem *p) {
    for (int i = 0; i < p->plan->nflow; i++) {
        fw_plan_flow *pf = &p->plan->flow[i];
        if (pf->flow && pf->table && &pf->variant == p->mechanism->variant) return pf;
    }
    return NULL;
}

static double narrowest_m(const fw_device *device) {
    double least = HUGE_VAL;
    for (int i = 0; i < device->nflexure; i++)
        if (device->flexure[i].width_m > 0) least = fmin(least, device->flexure[i].width_m);
    return least;
}

/* In: m, farthest that an edge is off; width of the narrowest flexure. Stiffness goes with the cube
   of the width, which two edges change: of a deflection under given loads at most 6 e / w to first
   order. Relative. Source: Euler-Bernoulli. Test: test_tradeoff.py. */
static double deflection(double edge_m, double width_m) {
    return isfinite(width_m) ? 6 * edge_m / width_m : (double)NAN;
}

static fw_status one(fw_study_problem *p, const fw_plan_flow *pf, const fw_layout *layout,
                     double tolerance, fw_study_tradeoff_mask *out, bool *fabricated) {
    fw_plan *plan = p->plan;
    fw_mask_options options = {.bias_m = pf->flow->bias_m,
                               .tolerance_m = tolerance,
                               .vertex_limit = plan->options.mask_vertices,
                               .thickness_m = pf->variant.thickness_m,
                               .no_islands = !fw_plan_insulated(pf)};
    if (!fw_mask_flattening_named(plan->options.mask_flatten, &options.flattening)) return FW_USAGE;
    fw_mark mark = fw_arena_mark(p->arena);
    fw_diags own = fw_diags_new(p->arena);
    const fw_mask *mask = NULL;
    fw_status status =
        fw_mask_examine(p->arena, layout, pf->table, plan->device->name, &options, &own, &mask);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    *fabricated = mask && mask->whole;
    if (*fabricated) {
        fw_text gds = fw_text_new(p->arena);
        FW_TRY(fw_mask_write_gds(mask, &gds));
        *out = (fw_study_tradeoff_mask){.tolerance_m = tolerance, .bytes = (long)gds.length};
        for (int i = 0; i < mask->table->nlayer; i++) {
            out->vertices += mask->measure[i].vertices;
            out->edge_m = fmax(out->edge_m, mask->measure[i].edge_m);
        }
        out->deflection = deflection(out->edge_m, narrowest_m(plan->device));
    }
    fw_arena_rewind(p->arena, mark);
    return FW_OK;
}

fw_status fw_study_tradeoff_masks(fw_study_problem *p, fw_study_tradeoff *t) {
    fw_plan_flow *pf = flow_of(p);
    const fw_layout *layout;
    int left_out;
    if (!pf) t->mask_why = "the device names no process flow";
    if (pf && (!p->plan->layout || !p->plan->layout->drawn))
        t->mask_why = "the device has no shapes to draw";
    if (!t->mask_why && !pf->flow->edges.solved)
        t->mask_why = "no bias brings the edges to where they are drawn";
    if (t->mask_why) return FW_OK;
    FW_NEED(t->mask = fw_arena_array(p->arena, fw_study_tradeoff_mask, COUNT));
    FW_TRY(fw_mask_frame_marks(p->arena, pf->table, p->plan->layout, &layout, &left_out));
    double usual = p->plan->options.mask_tolerance_m;
    if (!(usual > 0)) usual = 5e-9;
    for (int i = 0; i < COUNT; i++) {
        bool fabricated = false;
        FW_TRY(one(p, pf, layout, tolerance_m[i], &t->mask[t->nmask], &fabricated));
        if (!fabricated) continue;
        t->mask[t->nmask].usual = fabs(tolerance_m[i] / usual - 1) < 1e-6;
        t->nmask++;
    }
    if (t->nmask == 0) t->mask_why = "the mask cannot be drawn; see flexwright mask";
    return FW_OK;
}
