/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps of a wafer's sweeps: what each sets, and how many dies there are with the largest of
   them. */
#include "plan/stages.h"
#include <math.h>
#include <string.h>

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

bool fw_plan_is_final(fw_status status) {
    return status == FW_NOMEM || status == FW_CANCELLED || status == FW_INTERNAL ||
           status == FW_IO || status == FW_USAGE;
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
