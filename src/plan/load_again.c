/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plan from its beginning to its end; and the description of a loaded one read again with other settings, where what
   was read of packs stays: those that are asked for, and those of the steps of a wafer's sweeps. */
#include "plan/stages.h"
#include <math.h>
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

bool fw_plan_is_final(fw_status status) {
    return status == FW_NOMEM || status == FW_CANCELLED || status == FW_INTERNAL ||
           status == FW_IO || status == FW_USAGE;
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

/* of the descriptions, diagnostics are said anew */
static bool said_of_others(const fw_plan *plan) {
    for (size_t i = 0; i < plan->diags.count; i++)
        if (!fw_text_same(plan->diags.item[i].place.file, plan->source_file)) return true;
    return false;
}

/* names of files in the data directory have a slash, and no other input has one */
fw_status fw_plan_same_packs(const fw_plan *plan, bool *same) {
    fw_mark mark = fw_arena_mark(plan->arena);
    fw_diags silent = fw_diags_new(plan->arena);
    *same = plan->ndrawing == 0;
    for (int i = 1; i < plan->ninput && *same; i++) {
        const fw_plan_input_file *input = &plan->input[i];
        const char *path;
        char *bytes, hash[65];
        size_t n;
        if (!strchr(input->name, '/')) continue;
        FW_TRY(fw_data_path(plan->arena, plan->options.data_directory, input->name, &path));
        *same = false;
        if (!path) break;
        fw_status status = fw_input_read(plan->arena, path, input->size, &silent, &bytes, &n);
        if (status == FW_NOMEM) return status;
        if (status != FW_OK || n != input->size) break;
        fw_sha256(bytes, n, hash);
        *same = strcmp(hash, input->sha256) == 0;
    }
    fw_arena_rewind(plan->arena, mark);
    return FW_OK;
}

fw_status fw_plan_replace_source(fw_plan *plan, const char *xml, size_t n, bool *same) {
    char *copy;
    *same = n <= FW_PLAN_FILE_MOST && !said_of_others(plan);
    if (*same) FW_TRY(fw_plan_same_packs(plan, same));
    if (!*same) return FW_OK;
    plan->diags = fw_diags_new(plan->arena);
    FW_NEED(copy = fw_arena_strndup(plan->arena, xml, n));
    plan->source = copy;
    plan->source_length = n;
    plan->input[0].size = n;
    const fw_text text = {.data = copy, .length = n};
    return fw_plan_hash(plan, &text, &plan->input[0].sha256);
}

/* ---- the steps of a wafer's sweeps, and how many dies there are with the largest of them ---- */

int fw_plan_sweep_steps(const fw_device_wafer_asked *w) {
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

fw_status fw_plan_sweep_settings(fw_plan *plan, int v, fw_device_set **out, double *value) {
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

/* the outline of step v, as far as it can be drawn; what is wrong with it is said when it is
   planned */
static fw_status enlarge(fw_plan *plan, fw_arena *arena, int v, fw_geometry_box *die) {
    fw_diags silent = fw_diags_new(arena);
    const fw_device *device;
    const fw_layout *layout;
    fw_device_set *set;
    double value[2];
    FW_TRY(fw_plan_sweep_settings(plan, v, &set, value));
    fw_status status = fw_plan_device_again(
        plan, arena, set, plan->options.nset + plan->device->wafer.nsweep, &silent, &device);
    if (status == FW_OK) status = fw_layout_build(arena, device, &silent, &layout);
    if (status == FW_OK && layout->drawn) {
        die->x1 = fmax(die->x1, die->x0 + layout->die.x1 - layout->die.x0);
        die->y1 = fmax(die->y1, die->y0 + layout->die.y1 - layout->die.y0);
    }
    return fw_plan_is_final(status) ? status : FW_OK;
}

fw_status fw_plan_count_dies(fw_plan *plan) {
    const fw_device_wafer_asked *w = &plan->device->wafer;
    plan->dies = plan->options.dies > 0 ? plan->options.dies : 1;
    if (plan->options.dies > 0 || !w->asked || !plan->layout || !plan->layout->drawn) return FW_OK;
    fw_arena *scratch = fw_arena_part(plan->arena, plan->options.memory_cap);
    FW_NEED(scratch);
    fw_geometry_box die = plan->layout->die;
    fw_status status = FW_OK;
    for (int v = 0; w->nsweep > 0 && v < fw_plan_sweep_steps(w) && status == FW_OK; v++) {
        fw_mark empty = fw_arena_mark(scratch);
        status = enlarge(plan, scratch, v, &die);
        fw_arena_rewind(scratch, empty);
    }
    if (status == FW_OK) status = fw_wafer_dies(scratch, w, die, &plan->dies);
    fw_arena_free(scratch);
    if (plan->dies == 0) plan->dies = 1; /* why, the wafer says */
    return status;
}
