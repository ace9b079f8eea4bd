/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flow with one quantity as it would be once a laboratory has measured it. */
#include "process/pack.h"
#include "process/measurable.h"
#include <string.h>

/* ---- what counts ---- */

static bool among(const fw_process_argument *argument, int n, const fw_quantity *q) {
    for (int i = 0; i < n; i++)
        if (argument[i].q == q) return true;
    return false;
}

/* of a time that is computed: a time that is handed on as it is stated has no inputs to measure */
static bool step_takes(const fw_process_step *s, const fw_quantity *q) {
    const fw_process_law *law = fw_process_law_find(s->law);
    bool computes = law && !law->stated;
    if (computes && (among(s->argument, s->nargument, q) || among(s->need, s->nneed, q)))
        return true;
    for (int i = 0; i < s->nderive; i++) /* what is derived under an id is an input of others */
        if (s->derive[i].q && among(s->derive[i].argument, s->derive[i].nargument, q)) return true;
    for (int i = 0; i < s->nexposed; i++)
        if (s->exposed[i].rate == q || s->exposed[i].selectivity == q) return true;
    for (int i = 0; i < s->nchange; i++)
        if (s->change[i].anisotropy == q || s->change[i].reach == q) return true;
    return false;
}

bool fw_process_flow_takes(const fw_process_flow *flow, const fw_quantity *q) {
    if (!q->id || fw_process_quantity_computed(q) ||
        strncmp(q->id, FW_PROCESS_READ, strlen(FW_PROCESS_READ)) == 0)
        return false;
    for (int i = 0; i < flow->ncorner; i++)
        if (flow->corner[i].q == q) return true;
    for (int i = 0; i < flow->nstep; i++)
        if (step_takes(&flow->step[i], q)) return true;
    return false;
}

bool fw_process_flow_nominal(const fw_process_flow *flow, const fw_quantity *q, double *value) {
    for (int i = 0; q->unknown && i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        if (c->q != q || !c->assumed || c->assumed->unknown) continue;
        *value = c->assumed->value;
        return true;
    }
    *value = q->value;
    return !q->unknown;
}

/* ---- for a while ---- */

/* as fw_process_lab_apply leaves it */
static fw_quantity *replace(fw_process_flow *flow, const fw_process_with *with, fw_quantity *was) {
    fw_quantity *q = with->id ? fw_process_flow_own_quantity(flow, with->id) : NULL;
    if (!q) return NULL;
    *was = *q;
    q->value = with->value;
    q->uncertainty = with->uncertainty;
    q->unknown = q->interval = false;
    q->status = q->u_status = FW_MEASURED;
    return q;
}

fw_status fw_process_flow_fabricated_with(fw_arena *arena, fw_process_flow *flow,
                                          const fw_process_with *with,
                                          const fw_process_mask_facts *facts,
                                          const fw_mechanism_variant *variant,
                                          const fw_verdict_fabrication_input **input, int *ninput) {
    fw_quantity was, *q = replace(flow, with, &was);
    fw_status status = fw_process_flow_fabricated(arena, flow, facts, variant, input, ninput);
    if (q) *q = was;
    return status;
}

fw_status fw_process_flow_times_with(fw_arena *arena, fw_process_flow *flow,
                                     const fw_process_with *with,
                                     const fw_process_mask_facts *facts, fw_process_time *time) {
    fw_quantity was, *q = replace(flow, with, &was);
    fw_diags quiet = fw_diags_new(arena);
    fw_status status = fw_process_flow_compute_once(arena, flow, facts, &quiet);
    if (q) *q = was;
    FW_TRY(status);
    for (int i = 0; i < flow->nstep; i++)
        time[i] = flow->step[i].time;
    return FW_OK;
}
