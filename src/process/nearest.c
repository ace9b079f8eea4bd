/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nearest change of what a flow cannot make: a width of the narrowest openings, or an anisotropy, with which the whole
   flow is judged again and refuses nothing. What a closed form says of one reason alone may fail by the next one. */
#include "process/judge.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

typedef struct trial {
    fw_arena *arena;
    fw_process_flow *flow;
    const fw_process_mask_facts *facts;
    fw_process_mask_gap *gap; /* (facts->ngap) */
    /* where bias, time and gap begin to have a solution (fixed_point.c): below it nothing is made; NaN: they have one */
    double fold_gap_m, fold_anisotropy;
} trial;

/* every opening at least so wide: made, and printed with the gap of the flow, not in perfect contact only */
static fw_status with_gap(trial *t, double gap_m, bool *made) {
    fw_process_mask_facts facts = *t->facts;
    *made = false;
    if (gap_m < t->fold_gap_m) return FW_OK;
    fw_diags quiet = fw_diags_new(t->arena);
    for (int i = 0; i < facts.ngap; i++) {
        t->gap[i] = t->facts->gap[i];
        t->gap[i].gap_m = fmax(t->gap[i].gap_m, gap_m);
    }
    facts.gap = t->gap;
    facts.narrowest_slot_m = fmax(facts.narrowest_slot_m, gap_m);
    fw_status status = fw_process_flow_compute_once(t->arena, t->flow, &facts, &quiet);
    *made = status == FW_OK && t->flow->manufacturable != 0 && !t->flow->tight;
    return status == FW_INPUT ? FW_OK : status;
}

static double rounded_up(double x_m) { /* what a person draws */
    return 1e-7 * ceil(x_m / 1e-7 - 1e-9);
}

/* Bisection in the logarithm between what is drawn and twenty times that, then up to the next 0.1 um, and judged once
   more. NaN: no width that far is enough, another reason refuses. Error: 0.1 um above the least. Cost: some 12 times
   fw_process_flow_compute, only for what is refused. Test: test_fixed_point.c, a_proposal_is_accepted_and_least. */
static fw_status least_gap(trial *t, double *gap_m) {
    double low = t->facts->narrowest_slot_m, high = 20.0 * low;
    bool made;
    *gap_m = (double)NAN;
    if (!(low > 0.0) || !isfinite(low)) return FW_OK;
    FW_TRY(with_gap(t, high, &made));
    if (!made) return FW_OK;
    while (high - low > 0.05e-6) {
        double middle = sqrt(low * high);
        FW_TRY(with_gap(t, middle, &made));
        *(made ? &high : &low) = middle;
    }
    high = rounded_up(high);
    FW_TRY(with_gap(t, high, &made));
    if (made) *gap_m = high;
    return FW_OK;
}

static fw_status with_anisotropy(trial *t, fw_quantity *q, double value, bool *made) {
    *made = false;
    if (value < t->fold_anisotropy) return FW_OK;
    fw_diags quiet = fw_diags_new(t->arena);
    q->value = value;
    fw_status status = fw_process_flow_compute_once(t->arena, t->flow, t->facts, &quiet);
    *made = status == FW_OK && t->flow->manufacturable != 0;
    return status == FW_INPUT ? FW_OK : status;
}

/* of the cut of the device, where it is known; to 1e-4 */
static fw_status least_anisotropy(trial *t, double *least) {
    fw_quantity *q = NULL;
    *least = (double)NAN;
    for (int i = 0; i < t->flow->edges.ncut; i++)
        if (t->flow->edges.cut[i].device) q = (fw_quantity *)t->flow->edges.cut[i].quantity;
    if (!q || q->unknown) return FW_OK;
    const fw_quantity was = *q;
    double low = was.value, high = 1.0;
    bool made;
    q->interval = false;
    fw_status status = with_anisotropy(t, q, high, &made);
    while (status == FW_OK && made && high - low > 1e-4) {
        bool enough;
        double middle = 0.5 * (low + high);
        status = with_anisotropy(t, q, middle, &enough);
        *(enough ? &high : &low) = middle;
    }
    if (status == FW_OK && made) {
        double value = 1e-4 * ceil(high / 1e-4 - 1e-9);
        status = with_anisotropy(t, q, value, &made);
        if (made) *least = value;
    }
    *q = was;
    return status;
}

static fw_status nearest(fw_arena *arena, fw_process_flow *flow,
                         const fw_process_mask_facts *facts) {
    trial t = {.arena = arena,
               .flow = flow,
               .facts = facts,
               .fold_gap_m = flow->edges.least_gap_m,
               .fold_anisotropy = flow->edges.least_anisotropy};
    double gap, A;
    fw_mark mark = fw_arena_mark(arena);
    FW_NEED(t.gap = fw_arena_array(arena, fw_process_mask_gap, (size_t)facts->ngap + 1));
    FW_TRY(least_gap(&t, &gap));
    FW_TRY(least_anisotropy(&t, &A));
    fw_arena_rewind(arena, mark);
    flow->nearest_gap_m = gap;
    flow->nearest_anisotropy = A;
    flow->nearest_known = true;
    fw_diags quiet = fw_diags_new(arena); /* all was said already */
    return fw_process_flow_compute_once(arena, flow, facts, &quiet);
}

fw_status fw_process_flow_compute(fw_arena *arena, fw_process_flow *flow,
                                  const fw_process_mask_facts *facts, fw_diags *diags) {
    flow->nearest_known = false;
    FW_TRY(fw_process_flow_compute_once(arena, flow, facts, diags));
    bool drawn = facts && facts->structure_area_m2 > 0.0;
    return flow->manufacturable == 0 && drawn ? nearest(arena, flow, facts) : FW_OK;
}
