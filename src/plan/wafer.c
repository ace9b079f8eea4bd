/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer of every flow. Each step of its sweeps is a plan of its own over the same description
   with one or two parameters set: laid out, judged and drawn like any other. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

static int steps_of(const fw_device_wafer_asked *w) {
    int n = 1;
    for (int k = 0; k < w->nsweep; k++)
        n *= w->sweep[k].steps;
    return n;
}

/* value of the sweep at step k, in its unit, as --set takes it */
static fw_status value_of(fw_arena *arena, const fw_device_sweep *s, int k, double *value,
                          const char **text) {
    fw_quantity_unit u = {.factor = 1};
    if (*s->unit) fw_quantity_unit_parse(s->unit, strlen(s->unit), &u, NULL, NULL);
    double from = fw_quantity_unit_from_si(&u, s->from), to = fw_quantity_unit_from_si(&u, s->to);
    char number[40];
    fw_number_text(number, sizeof number, from + (to - from) * k / (s->steps - 1), 12);
    double shown;
    if (!fw_number_parse(number, strlen(number), &shown)) return FW_INTERNAL;
    *value = fw_quantity_unit_to_si(&u, shown);
    FW_NEED(*text = fw_arena_printf(arena, "%s%s%s", number, *s->unit ? " " : "", s->unit));
    return FW_OK;
}

/* the settings of a plan and those of step v behind them: of two for one parameter the last
   holds */
static fw_status settings(fw_plan *plan, int v, fw_device_set **out, double *value) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    size_t n = (size_t)plan->options.nset;
    fw_device_set *set = fw_arena_array(plan->arena, fw_device_set, n + 2);
    FW_NEED(set);
    if (n > 0) memcpy(set, plan->options.set, n * sizeof *set);
    for (int k = 0, rest = v; k < w->nsweep; rest /= w->sweep[k++].steps) {
        const fw_device_sweep *s = &w->sweep[k];
        set[n + (size_t)k].path = plan->device->parameter[s->parameter].name;
        FW_TRY(value_of(plan->arena, s, rest % s->steps, &value[k], &set[n + (size_t)k].value));
    }
    *out = set;
    return FW_OK;
}

static bool is_final(fw_status status) {
    return status == FW_NOMEM || status == FW_CANCELLED || status == FW_INTERNAL ||
           status == FW_IO || status == FW_USAGE;
}

static const char *first_error(const fw_plan *step, fw_status status) {
    for (size_t i = 0; i < step->diags.count; i++)
        if (step->diags.item[i].severity == FW_ERROR) return step->diags.item[i].message;
    return fw_status_text(status);
}

/* *why: NULL when the step was planned */
static fw_status run_step(fw_plan *plan, int v, double *value, const char **why) {
    fw_plan_options options = plan->options;
    fw_device_set *set;
    FW_TRY(settings(plan, v, &set, value));
    options.set = set;
    options.nset = plan->options.nset + plan->device->wafer.nsweep;
    options.dies = plan->dies;
    options.verdict.with_advice = false;
    fw_plan *step = plan->step[v] = fw_plan_new(&options);
    FW_NEED(step);
    fw_arena_stop_with(step->arena, fw_arena_request(plan->arena));
    fw_status status =
        fw_plan_load_memory(step, plan->source_file, plan->source, plan->source_length);
    if (status == FW_OK) status = fw_plan_judge(step);
    if (status == FW_OK) status = fw_plan_fabricate(step);
    if (status != FW_OK && is_final(status)) return status;
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
    if (plan->layout) {
        v.die = plan->layout->die;
        v.window = plan->layout->window;
    }
    return v;
}

/* what is said of a step whose dies are other ones */
static void say(fw_plan *plan, const fw_device_wafer_asked *w, const fw_wafer_variant *v, int index,
                const char *flow) {
    char name[160] = "";
    size_t used = 0;
    for (int k = 0; k < w->nsweep; k++) {
        const fw_device_sweep *s = &w->sweep[k];
        fw_quantity_unit u = {.factor = 1};
        char number[40];
        if (*s->unit) fw_quantity_unit_parse(s->unit, strlen(s->unit), &u, NULL, NULL);
        fw_number_text(number, sizeof number, fw_quantity_unit_from_si(&u, v->value[k]), 9);
        const char *part =
            fw_arena_printf(plan->arena, "%s%.60s = %s %s", k ? ", " : "",
                            plan->device->parameter[s->parameter].name, number, s->unit);
        if (!part || used + strlen(part) >= sizeof name) continue;
        memcpy(name + used, part, strlen(part) + 1);
        used += strlen(part);
    }
    fw_diag_warning(&plan->diags, 194, w->sweep[0].place,
                    "<sweep>: step %d (%s) in flow %s: %s; its dies are those of the description "
                    "as it stands",
                    index + 1, name, flow, v->why ? v->why : "no mask");
}

static fw_status make(fw_plan *plan, int flow, const double (*value)[2], const char *const *why) {
    fw_plan_flow *pf = &plan->flow[flow];
    const fw_device_wafer_asked *w = &plan->device->wafer;
    int n = steps_of(w);
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
        if (!v[i].mask) say(plan, w, &v[i], i, pf->use->ref);
    }
    const fw_wafer_input input = {
        .device = plan->device,
        .table = pf->table,
        .variant = v,
        .nvariant = n,
        .stand_in = own,
        .test = {.mask = pf->coupons ? pf->coupons->mask : NULL, .die = plan->layout->die},
        .mask = {.bias_m = pf->mask->bias_m,
                 .tolerance_m = pf->mask->tolerance_m,
                 .vertex_limit = pf->mask->vertex_limit,
                 .flattening = pf->mask->flattening}};
    FW_TRY(fw_wafer_build(plan->arena, &input, &plan->diags, &pf->wafer));
    pf->wafer_gds = fw_text_new(plan->arena);
    FW_TRY(fw_wafer_write_gds(pf->wafer, &pf->wafer_gds));
    return fw_plan_hash(plan, &pf->wafer_gds, &pf->wafer_sha256);
}

fw_status fw_plan_wafers(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    bool any = false;
    for (int i = 0; i < plan->nflow; i++)
        any = any || plan->flow[i].mask;
    if (!w->asked || plan->options.dies > 0 || !any) return FW_OK;
    int n = steps_of(w);
    double(*value)[2] = fw_arena_alloc(plan->arena, (size_t)n, sizeof *value);
    const char **why = fw_arena_array(plan->arena, const char *, (size_t)n);
    FW_NEED(value && why ? why : NULL);
    if (w->nsweep > 0) {
        FW_NEED(plan->step = fw_arena_array(plan->arena, fw_plan *, (size_t)n));
        plan->nstep = n;
        for (int i = 0; i < n; i++)
            FW_TRY(run_step(plan, i, value[i], &why[i]));
    }
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].mask) FW_TRY(make(plan, i, (const double(*)[2])value, why));
    return FW_OK;
}

/* the outline of step v, as far as it can be drawn; what is wrong with it is said when it is
   planned */
static fw_status enlarge(fw_plan *plan, fw_arena *arena, int v, fw_geometry_box *die) {
    fw_diags silent = fw_diags_new(arena);
    const fw_device *device;
    const fw_layout *layout;
    fw_device_set *set;
    double value[2];
    FW_TRY(settings(plan, v, &set, value));
    fw_status status =
        fw_device_read(arena, plan->source_file, plan->source, plan->source_length, set,
                       plan->options.nset + plan->device->wafer.nsweep, &silent, &device);
    if (status == FW_OK) status = fw_layout_build(arena, device, &silent, &layout);
    if (status == FW_OK && layout->drawn) {
        die->x1 = fmax(die->x1, die->x0 + layout->die.x1 - layout->die.x0);
        die->y1 = fmax(die->y1, die->y0 + layout->die.y1 - layout->die.y0);
    }
    return is_final(status) ? status : FW_OK;
}

fw_status fw_plan_count_dies(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    plan->dies = plan->options.dies > 0 ? plan->options.dies : 1;
    if (plan->options.dies > 0 || !w->asked || !plan->layout || !plan->layout->drawn) return FW_OK;
    fw_arena *scratch = fw_arena_part(plan->arena, plan->options.memory_cap);
    FW_NEED(scratch);
    fw_geometry_box die = plan->layout->die;
    fw_status status = FW_OK;
    for (int v = 0; w->nsweep > 0 && v < steps_of(w) && status == FW_OK; v++) {
        fw_mark empty = fw_arena_mark(scratch);
        status = enlarge(plan, scratch, v, &die);
        fw_arena_rewind(scratch, empty);
    }
    if (status == FW_OK) status = fw_wafer_dies(scratch, w, die, &plan->dies);
    fw_arena_free(scratch);
    if (plan->dies == 0) plan->dies = 1; /* why, the wafer says */
    return status;
}
