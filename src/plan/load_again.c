/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plan from its beginning to its end; and the description of a loaded one read again with other settings, where what
   was read of packs stays. */
#include "plan/stages.h"
#include <string.h>

fw_plan_options fw_plan_options_default(void) {
    return (fw_plan_options){
        .verdict = {.motion = {.accuracy = 1e-3, .samples = 1001}, .with_advice = true}};
}

fw_plan *fw_plan_new(const fw_plan_options *options) {
    fw_arena *arena = fw_arena_new(options->memory_cap);
    if (!arena) return NULL;
    fw_plan *plan = fw_arena_one(arena, fw_plan);
    if (!plan) {
        fw_arena_free(arena);
        return NULL;
    }
    *plan = (fw_plan){.arena = arena, .options = *options, .diags = fw_diags_new(arena)};
    return plan;
}

void fw_plan_free_steps(fw_plan *plan) {
    for (int i = 0; i < plan->nstep; i++)
        if (plan->step[i]) fw_arena_free(plan->step[i]->arena); /* steps have none of their own */
    plan->nstep = 0;
}

void fw_plan_free(fw_plan *plan) {
    if (!plan) return;
    fw_plan_free_steps(plan);
    fw_arena_free(plan->arena);
}

/* ---- once more, with other settings ---- */

/* a plan of its own for messages and memory, over the packs of this one */
fw_status fw_plan_restated(const fw_plan *plan, fw_arena *arena, const fw_device_set *set, int nset,
                           const fw_device **device, fw_verdict_variant_verdict *variant) {
    size_t n = (size_t)plan->options.nset, more = (size_t)nset;
    fw_device_set *sets = fw_arena_array(arena, fw_device_set, n + more);
    fw_plan_flow *flow = fw_arena_array(arena, fw_plan_flow, (size_t)plan->nflow);
    FW_NEED(sets && flow ? sets : NULL);
    if (n > 0) memcpy(sets, plan->options.set, n * sizeof *sets);
    if (nset > 0) memcpy(sets + n, set, more * sizeof *sets); /* of two for one the last holds */
    memcpy(flow, plan->flow, (size_t)plan->nflow * sizeof *flow);
    fw_plan other = *plan;
    other.arena = arena;
    other.diags = fw_diags_new(arena);
    other.flow = flow;
    FW_TRY(
        fw_plan_device_again(&other, arena, sets, plan->options.nset + nset, &other.diags, device));
    FW_TRY(fw_plan_take_device(&other, *device));
    for (int i = 0; i < plan->nflow; i++)
        FW_TRY(fw_plan_fabricated_of(arena, &flow[i], &variant[i]));
    return FW_OK;
}

/* of the same packs and materials, in the same order? */
static bool names_the_same(const fw_device *a, const fw_device *b) {
    bool same = a->nflow == b->nflow && a->die.tethers == b->die.tethers &&
                fw_text_same(a->material_ref, b->material_ref);
    for (int i = 0; same && i < a->nflow; i++)
        same = fw_text_same(a->flow[i].ref, b->flow[i].ref) &&
               fw_text_same(a->flow[i].material, b->flow[i].material);
    return same;
}

fw_status fw_plan_load_again(fw_plan *plan, const fw_device_set *set, int nset, bool *same) {
    const fw_device *device = NULL;
    fw_status status = fw_plan_device_again(plan, plan->arena, set, nset, &plan->diags, &device);
    *same = status == FW_OK && names_the_same(plan->device, device);
    plan->options.set = set, plan->options.nset = nset;
    if (*same && (device->nflow > 0 || device->material_ref))
        status = fw_plan_take_device(plan, device);
    else if (*same)
        plan->device = device;
    *same = *same && status == FW_OK;
    return fw_plan_is_final(status) ? status : FW_OK;
}
