/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The electrical side of the device in each flow: what the flow stands on, nets, and what they make of its
   judgement. */
#include "plan/stages.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

/* the material that insulates the layer from what is below it: the first one added that does not conduct */
static const fw_process_change *insulator_of(const fw_process_flow *flow, bool *handle) {
    *handle = false;
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++) {
            const fw_process_change *c = &flow->step[i].change[k];
            const fw_process_material *m = fw_process_flow_material(flow, c->material);
            if (strcmp(c->kind, "add") != 0) continue;
            if (m && m->conducts == 0) return c;
            *handle = true;
        }
    return NULL;
}

static double known(const fw_process_flow *flow, const char *id, const char **source) {
    const fw_quantity *q = fw_process_flow_quantity(flow, id);
    if (!q || q->unknown) return (double)NAN;
    if (source) *source = q->source;
    return q->value;
}

static fw_status carrier_of(fw_plan *plan, const fw_plan_flow *pf, fw_wiring_carrier *out) {
    const fw_process_flow *flow = pf->flow;
    *out = (fw_wiring_carrier){.insulates = fw_plan_insulated(pf),
                               .thickness_m = (double)NAN,
                               .breakdown_V_per_m = (double)NAN,
                               .resistivity_Ohm_m = (double)NAN};
    if (!out->insulates) {
        FW_NEED(out->words = fw_arena_printf(
                    plan->arena,
                    "nothing: the layer (%s) is one sheet or stands on a conductor, and all that "
                    "stands on the carrier is one net with it",
                    fw_process_flow_material_name(flow, flow->material)));
        return FW_OK;
    }
    if (!flow->insulating) {
        out->words =
            "an insulating carrier, as the description says in <flow carrier>: what is not "
            "joined in the layer is insulated; how well is not known";
        return FW_OK;
    }
    const fw_process_change *c = insulator_of(flow, &out->handle);
    out->breakdown_V_per_m = known(flow, "insulator.breakdown", &out->source);
    out->resistivity_Ohm_m = known(flow, "insulator.resistivity", &out->source);
    if (!c || !c->thickness || c->thickness->unknown) {
        out->handle = false;
        out->words = "an insulating carrier, as the flow says: what is not joined in the layer is "
                     "insulated; how well is not known";
        return FW_OK;
    }
    char um[32];
    out->thickness_m = c->thickness->value;
    FW_NEED(out->words = fw_arena_printf(plan->arena, "%s, %s um thick%s",
                                         fw_process_flow_material_name(flow, c->material),
                                         fw_number_text(um, sizeof um, 1e6 * out->thickness_m, 4),
                                         out->handle ? ", on a handle that conducts" : ""));
    return FW_OK;
}

static double outermost(const fw_process_edge *e) {
    return fmax(e->top_m, fmax(e->middle_m, e->bottom_m)); /* fmax ignores what is not known */
}

/* by how much two walls may come nearer than drawn: what the flow leaves of its edges, at the ends of all ranges */
static double walls_of(const fw_process_flow *flow) {
    double most = 0.0;
    for (int i = 0; i < flow->edges.ncls && flow->edges.solved; i++) {
        const fw_process_edge_class *c = &flow->edges.cls[i];
        most = fmax(most, fmax(outermost(&c->edge), fmax(outermost(&c->low), outermost(&c->high))));
    }
    return 2.0 * most;
}

static const fw_verdict_variant_verdict *verdict_of(const fw_plan *plan, const fw_plan_flow *pf) {
    ptrdiff_t i = pf - plan->flow;
    return plan->verdict.variant && i < plan->verdict.nvariant ? &plan->verdict.variant[i] : NULL;
}

fw_status fw_plan_wiring(fw_plan *plan, fw_plan_flow *pf) {
    const fw_layout *layout;
    int left_out;
    if (!pf->flow || !plan->layout || !plan->layout->drawn) return FW_OK;
    if (!pf->wiring) {
        const fw_verdict_variant_verdict *v = verdict_of(plan, pf);
        fw_wiring_asked asked = {.flow = pf->variant.flow, .wall_m = walls_of(pf->flow)};
        if (v) asked.moved = v->stator, asked.nmoved = v->nstator;
        FW_TRY(carrier_of(plan, pf, &asked.carrier));
        FW_TRY(fw_mask_frame_marks(plan->arena, pf->table, plan->layout, &layout, &left_out));
        FW_TRY(fw_wiring_find(plan->arena, plan->device, layout, &asked, &pf->wiring));
    }
    const fw_wiring *w = pf->wiring;
    bool routed = false;
    for (int i = 0; i < plan->layout->nelectrode; i++)
        routed = routed || plan->layout->electrode[i].routed;
    if (routed && !w->carrier.insulates)
        FW_TRY(fw_process_flow_add_reason(
            plan->arena, pf->flow, 0,
            "tracks to the chip's edge cut the frame, which hangs on nothing in a flow without an "
            "insulating carrier: leave pad=\"edge\" out for this flow"));
    for (int i = w->nrefusal - 1; i >= 0 && w->carrier.insulates; i--)
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, w->refusal[i]));
    for (int i = 0; i < w->nopen; i++)
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, -1, w->open[i]));
    return FW_OK;
}
