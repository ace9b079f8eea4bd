/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer of every flow. Each step of its sweeps is a plan of its own over the same description
   with one or two parameters set: laid out, judged and drawn like any other. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static const char *first_error(const fw_plan *step, fw_status status) {
    for (size_t i = 0; i < step->diags.count; i++)
        if (step->diags.item[i].severity == FW_ERROR) return step->diags.item[i].message;
    return fw_status_text(status);
}

/* *why: NULL when the step was planned */
static fw_status run_step(fw_plan *plan, int v, double *value, const char **why) {
    fw_plan_options options = plan->options;
    fw_device_set *set;
    FW_TRY(fw_plan_sweep_settings(plan, v, &set, value));
    options.set = set;
    options.nset = plan->options.nset + plan->device->wafer.nsweep;
    options.dies = plan->dies;
    options.verdict.with_advice = false;
    options.measurements = FW_MEASUREMENTS_NONE;
    fw_plan *step = plan->step[v] = fw_plan_new(&options);
    FW_NEED(step);
    fw_arena_stop_with(step->arena, fw_arena_request(plan->arena));
    step->directory = plan->directory;
    step->drawing = plan->drawing;
    step->ndrawing = plan->ndrawing;
    step->swept = plan->swept; /* one plate, one bath: what all have counts for each */
    fw_status status =
        fw_plan_load_memory(step, plan->source_file, plan->source, plan->source_length);
    if (status == FW_OK) status = fw_plan_judge(step);
    if (status == FW_OK) status = fw_plan_masks(step);
    if (status == FW_OK) status = fw_plan_schedules(step);
    if (status != FW_OK && fw_plan_is_final(status)) return status;
    *why = status == FW_OK ? NULL : first_error(step, status);
    if (status == FW_OK) return FW_OK;
    FW_NEED(*why = fw_arena_strdup(plan->arena, *why));
    fw_plan_free(step);
    plan->step[v] = NULL;
    return FW_OK;
}

static fw_wafer_variant variant_of(const fw_plan *plan, int flow) {
    const fw_plan_flow *pf = &plan->flow[flow];
    const fw_verdict_variant_verdict *judged = &plan->verdict.variant[flow];
    fw_wafer_variant v = {.mask = pf->mask,
                          .decision = fw_verdict_decision_text(judged->decision),
                          .utilisation = (double)NAN,
                          .why = pf->mask_error};
    for (int k = 0; k < judged->nhinge; k++)
        v.utilisation = fmax(v.utilisation, judged->hinge[k].utilisation);
    if (plan->layout && plan->layout->nfault == 0) {
        v.die = plan->layout->die;
        v.window = plan->layout->window;
    }
    return v;
}

/* a step whose dies are other ones, once for all flows in which it is so for the same reason */
static fw_status say_replaced(fw_plan *plan, int v) {
    bool *told = fw_arena_array(plan->arena, bool, (size_t)plan->nflow);
    const char *name;
    FW_NEED(told);
    FW_TRY(fw_plan_step_name(plan, v, &name));
    for (int i = 0; i < plan->nflow; i++) {
        const fw_wafer *w = plan->flow[i].wafer;
        fw_text flows = fw_text_new(plan->arena);
        if (!w || told[i] || w->variant[v].mask) continue;
        for (int k = i; k < plan->nflow; k++) {
            const fw_wafer *other = plan->flow[k].wafer;
            if (!other || other->variant[v].mask ||
                !fw_text_same(other->variant[v].why, w->variant[v].why))
                continue;
            told[k] = true;
            fw_text_printf(&flows, "%s%s", flows.length ? ", " : "", plan->flow[k].use->ref);
        }
        FW_TRY(fw_text_end(&flows));
        fw_diag_warning(
            &plan->diags, 194, plan->device->wafer.sweep[0].place,
            "<sweep>: %s in flow %s: %s; its dies are those of the description as it stands", name,
            flows.data, w->variant[v].why ? w->variant[v].why : "no mask");
    }
    return plan->diags.failed ? FW_NOMEM : FW_OK;
}

/* ---- the judgement of all dies ---- */

/* a reason without the names of devices: "link stage of step 2 (pitch = 300 um) is free last" -> "link stage is free last" */
static const char *without_names(fw_arena *arena, const char *reason) {
    static const char step[] = " of step ", own[] = " of the device of the description";
    fw_text text = fw_text_new(arena);
    while (*reason) {
        const char *end = strncmp(reason, step, sizeof step - 1) == 0 ? strchr(reason, ')') : NULL;
        if (end)
            reason = end + 1;
        else if (strncmp(reason, own, sizeof own - 1) == 0)
            reason += sizeof own - 1;
        else
            fw_text_printf(&text, "%c", *reason++);
    }
    return fw_text_end(&text) == FW_OK ? text.data : NULL;
}

/* why the step's own flow refuses it or does not guarantee it, where that is not said of all of them already; NULL: it does not */
static fw_status own_reason(fw_arena *arena, const fw_process_flow *step,
                            const fw_process_flow *all, const char **out) {
    const char *why = step->fails         ? step->fails
                      : step->nreason > 0 ? step->reason[0]
                                          : NULL,
               *plain;
    *out = NULL;
    if (!why || step->manufacturable == 1) return FW_OK;
    FW_NEED(plain = without_names(arena, why));
    for (int i = 0; i < all->nreason; i++) {
        const char *other = without_names(arena, all->reason[i]);
        FW_NEED(other);
        if (strcmp(other, plain) == 0) return FW_OK;
    }
    *out = why;
    return FW_OK;
}

/* what a flow cannot make of one step it cannot make of the wafer, on which its dies stand */
static fw_status judge_steps(fw_plan *plan, int flow) {
    fw_plan_flow *pf = &plan->flow[flow];
    for (int v = plan->nstep - 1; pf->wafer && v >= 0; v--) {
        const fw_process_flow *step = plan->step[v] ? plan->step[v]->flow[flow].flow : NULL;
        const fw_wafer_variant *x = &pf->wafer->variant[v];
        const char *why, *name;
        if (!step || !x->mask || x->dies == 0) continue;
        FW_TRY(own_reason(plan->arena, step, pf->flow, &why));
        if (!why) continue;
        FW_TRY(fw_plan_step_name(plan, v, &name));
        FW_NEED(why = fw_arena_printf(plan->arena, "%s of the <sweep>, %d dies: %s", name, x->dies,
                                      why));
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, step->manufacturable, why));
    }
    return FW_OK;
}

static fw_verdict_decision decision_of(const fw_wafer_variant *v) {
    for (int d = FW_ACCEPT; v->decision && d <= FW_REJECT; d++)
        if (strcmp(v->decision, fw_verdict_decision_text((fw_verdict_decision)d)) == 0)
            return (fw_verdict_decision)d;
    return FW_ACCEPT;
}

/* dies of a sweep that are judged worse than the device of the description, whose verdict is the headline */
static fw_status count_worse(fw_plan *plan, int flow) {
    fw_plan_flow *pf = &plan->flow[flow];
    const fw_wafer *w = pf->wafer;
    fw_text steps = fw_text_new(plan->arena);
    int worse[FW_REJECT + 1] = {0};
    for (int v = 0; w && plan->nstep > 0 && v < w->nvariant; v++) {
        const fw_wafer_variant *x = w->variant[v].mask ? &w->variant[v] : &w->stand_in;
        const fw_verdict_decision d = decision_of(x);
        const int dies = w->variant[v].dies;
        const char *name, *why = NULL;
        if (dies == 0 || !fw_verdict_is_worse(d, plan->verdict.decision)) continue;
        FW_TRY(fw_plan_step_name(plan, v, &name));
        const fw_verdict *judged = x == &w->stand_in ? &plan->verdict : &plan->step[v]->verdict;
        for (int k = 0; k < judged->variant[flow].nreason && !why; k++)
            if (judged->variant[flow].reason[k].decision == d)
                FW_TRY(fw_verdict_reason_words(plan->arena, judged, flow, k, &why));
        worse[d] += dies;
        fw_text_printf(&steps, "%s%s, %d dies, %s%s%s", steps.length ? "; " : "", name, dies,
                       d == FW_REJECT ? "rejected" : "inconclusive", why ? " because " : "",
                       why ? why : "");
    }
    if (steps.length == 0) return FW_OK;
    FW_TRY(fw_text_end(&steps));
    pf->dies_decision = worse[FW_REJECT] > 0 ? FW_REJECT : FW_INCONCLUSIVE;
    FW_NEED(pf->dies = fw_arena_printf(plan->arena, "in %s: %s", pf->use->ref, steps.data));
    FW_NEED(pf->dies_count = fw_arena_printf(
                plan->arena, "%d of %d dies are %s in %s", worse[pf->dies_decision], w->dies,
                pf->dies_decision == FW_REJECT ? "rejected" : "inconclusive", pf->use->ref));
    return FW_OK;
}

/* an edge that moves by e changes a line by 2e. Swept dies are on one plate: the least of all that are accepted */
static void narrow_effect(const fw_plan *plan, int flow, fw_wafer_width_effect *out) {
    const fw_verdict_variant_verdict *v = &plan->verdict.variant[flow];
    const fw_verdict_edge_room *room = v->fabricated ? &v->fabricated->room : NULL;
    const bool known = v->decision == FW_ACCEPT && room && room->says;
    const fw_wafer_width_effect own = {
        .says = v->decision != FW_ACCEPT
                    ? "the device is not accepted, so that no tolerance keeps it accepted"
                : known ? room->says
                        : "what a width changes of the verdict is not known",
        .left_m = known ? 2 * room->edge_m : (double)NAN,
        .looked_m = known ? 2 * room->looked_m : (double)NAN};
    if (!out->says || own.left_m < out->left_m || (known && isnan(out->left_m))) *out = own;
}

static double overlay_of(const fw_process_flow *flow) {
    double least = (double)NAN;
    for (int i = 0; flow && i < flow->nstep; i++) {
        const fw_process_align *a = &flow->step[i].align;
        if (a->to && a->overlay && !a->overlay->unknown) least = fmin(least, a->overlay->value);
    }
    return least;
}

static fw_status make(fw_plan *plan, int flow, const double (*value)[2], const char *const *why) {
    fw_plan_flow *pf = &plan->flow[flow];
    const fw_device_wafer_asked *w = &plan->device->wafer;
    int n = fw_plan_sweep_steps(w);
    fw_wafer_variant *v = fw_arena_array(plan->arena, fw_wafer_variant, (size_t)n);
    FW_NEED(v);
    fw_wafer_variant own = variant_of(plan, flow);
    for (int k = 0; k < w->nsweep; k++)
        own.value[k] = plan->device->parameter[w->sweep[k].parameter].value;
    for (int i = 0; i < n; i++) {
        v[i] = w->nsweep == 0  ? own
               : plan->step[i] ? variant_of(plan->step[i], flow)
                               : (fw_wafer_variant){.utilisation = (double)NAN, .why = why[i]};
        for (int k = 0; k < w->nsweep; k++)
            v[i].value[k] = value[i][k];
    }
    fw_wafer_width_effect effect = {.left_m = (double)NAN, .looked_m = (double)NAN};
    narrow_effect(plan, flow, &effect);
    for (int i = 0; i < n && w->nsweep > 0; i++)
        if (plan->step[i] && plan->step[i]->verdict.variant[flow].decision == FW_ACCEPT)
            narrow_effect(plan->step[i], flow, &effect);
    const fw_mask *test = w->asked && w->tests > 0 && pf->coupons ? pf->coupons->mask : NULL;
    const fw_wafer_input input = {.single = !w->asked,
                                  .effect = effect,
                                  .overlay_m = overlay_of(pf->flow),
                                  .device = plan->device,
                                  .table = pf->table,
                                  .variant = v,
                                  .nvariant = n,
                                  .stand_in = own,
                                  .test = {.mask = test, .die = plan->layout->die},
                                  .mask = {.bias_m = pf->mask->bias_m,
                                           .layer_bias_m = pf->mask->layer_bias_m,
                                           .tolerance_m = pf->mask->tolerance_m,
                                           .vertex_limit = pf->mask->vertex_limit,
                                           .flattening = pf->mask->flattening}};
    const fw_wafer **made = w->asked ? &pf->wafer : &pf->single;
    FW_TRY(fw_wafer_build(plan->arena, &input, &plan->diags, made));
    FW_TRY(fw_wafer_check_orders(plan->arena, *made, &plan->diags));
    if (!w->asked) return FW_OK;
    pf->wafer_gds = fw_text_new(plan->arena);
    FW_TRY(fw_wafer_write_gds(pf->wafer, &pf->wafer_gds));
    return fw_plan_hash(plan, &pf->wafer_gds, &pf->wafer_sha256);
}

/* an <order> of one plate names one that a flow prints */
static fw_status check_orders(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    for (int i = 0; i < w->nordered; i++) {
        const fw_device_order_asked *o = &w->ordered[i];
        fw_text known = fw_text_new(plan->arena);
        bool found = false;
        for (int f = 0; f < plan->nflow; f++) {
            const fw_mask_table *t = plan->flow[f].table;
            for (int p = 0; t && p < fw_mask_plates(t); p++) {
                const char *id = fw_mask_plate_at(t, p).id;
                found = found || strcmp(id, o->plate) == 0;
                fw_text_printf(&known, "%s%s of %s", known.length ? ", " : "", id, t->flow);
            }
        }
        FW_TRY(fw_text_end(&known));
        if (!found)
            fw_diag_error(&plan->diags, 550, o->place,
                          "<order>: no flow of this device prints a plate \"%s\"; there are: %s",
                          o->plate, known.data);
        if (!found) return FW_INPUT;
    }
    return FW_OK;
}

/* wafers of the flows that have a mask, with the devices of the sweeps, each planned by itself */
static fw_status make_all(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    bool any = false;
    for (int i = 0; i < plan->nflow; i++)
        any = any || plan->flow[i].mask;
    if ((!w->asked && !w->written) || plan->options.dies > 0 || !any) return FW_OK;
    FW_TRY(check_orders(plan));
    int n = fw_plan_sweep_steps(w);
    double(*value)[2] = fw_arena_alloc(plan->arena, (size_t)n, sizeof *value);
    const char **why = fw_arena_array(plan->arena, const char *, (size_t)n);
    FW_NEED(value && why ? why : NULL);
    if (w->nsweep > 0) {
        FW_NEED(plan->step = fw_arena_array(plan->arena, fw_plan *, (size_t)n));
        plan->nstep = n;
        for (int i = 0; i < n; i++) {
            fw_arena_tell(plan->arena, "planning the steps of the wafer's sweeps", i, n, "steps");
            FW_TRY(run_step(plan, i, value[i], &why[i]));
        }
    }
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].mask) FW_TRY(make(plan, i, (const double(*)[2])value, why));
    for (int v = 0; v < plan->nstep; v++)
        FW_TRY(say_replaced(plan, v));
    return FW_OK;
}

/* A step of a sweep has masks and schedules, but no wafer of its own. */
fw_status fw_plan_check_dates(fw_plan *plan) {
    const bool asked = !plan->options.drawn_alone && !plan->options.schedule.undated;
    for (int i = 0; asked && i < plan->nflow; i++)
        if (plan->flow[i].flow)
            FW_TRY(fw_schedule_tool_dates(plan->flow[i].flow, plan->options.schedule.day,
                                          &plan->diags));
    return FW_OK;
}

fw_status fw_plan_fabricate(fw_plan *plan) {
    FW_TRY(fw_plan_masks(plan));
    if (plan->options.drawn_alone) return FW_OK;
    FW_TRY(make_all(plan));
    FW_TRY(fw_plan_compute_wafers(plan));
    for (int i = 0; i < plan->nflow; i++) {
        FW_TRY(judge_steps(plan, i));
        FW_TRY(count_worse(plan, i));
    }
    return fw_plan_schedules(plan);
}
