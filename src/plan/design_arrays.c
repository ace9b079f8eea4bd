/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of the public library: a row per set, composed when first asked for. */
#include "plan/arrays.h"
#include <string.h>

static const struct {
    unsigned needs;
    fw_plan_compose *compose;
} set_table[FW_DESIGN_NUMBERS] = {
    [FW_NUMBERS_PARAMETERS] = {FW_DONE_READ, fw_plan_numbers_parameters},
    [FW_NUMBERS_SCENES] = {FW_DONE_READ, fw_plan_numbers_scenes},
    [FW_NUMBERS_HINGES] = {FW_DONE_JUDGED, fw_plan_numbers_hinges},
    [FW_NUMBERS_FLOW_HINGES] = {FW_DONE_JUDGED, fw_plan_numbers_flow_hinges},
    [FW_NUMBERS_FLOWS] = {FW_DONE_JUDGED, fw_plan_numbers_flows},
    [FW_NUMBERS_GOVERNING] = {FW_DONE_JUDGED, fw_plan_numbers_governing},
    [FW_NUMBERS_CLEARANCES] = {FW_DONE_JUDGED, fw_plan_numbers_clearances},
    [FW_NUMBERS_REQUIREMENTS] = {FW_DONE_JUDGED, fw_plan_numbers_requirements},
    [FW_NUMBERS_PROBES] = {FW_DONE_JUDGED, fw_plan_numbers_probes},
    [FW_NUMBERS_MOTION] = {FW_DONE_SIMULATED, fw_plan_numbers_motion},
    [FW_NUMBERS_PEAKS] = {FW_DONE_SIMULATED, fw_plan_numbers_peaks},
    [FW_NUMBERS_MOTION_PROBES] = {FW_DONE_SIMULATED, fw_plan_numbers_motion_probes},
    [FW_NUMBERS_MODES] = {FW_DONE_MODES, fw_plan_numbers_modes},
    [FW_NUMBERS_STATICS] = {FW_DONE_STATICS, fw_plan_numbers_statics},
    [FW_NUMBERS_LOAD_PATH] = {FW_DONE_STATICS, fw_plan_numbers_load_path},
    [FW_NUMBERS_ASSEMBLY] = {FW_DONE_ASSEMBLED, fw_plan_numbers_assembly},
    [FW_NUMBERS_WORKSPACE] = {FW_DONE_WORKSPACE, fw_plan_numbers_workspace},
};

static bool is_set(int numbers) {
    return numbers >= 0 && numbers < FW_DESIGN_NUMBERS;
}

static fw_status compose(fw_design *d, void *argument) {
    const int numbers = *(const int *)argument;
    fw_plan_arrays *to = fw_arena_one(d->plan->arena, fw_plan_arrays);
    FW_NEED(to);
    to->arena = d->plan->arena;
    FW_TRY(set_table[numbers].compose(d, to));
    if (to->no_memory) return FW_NOMEM;
    d->numbers[numbers] = to;
    return FW_OK;
}

int fw_design_arrays(fw_design *design, int numbers, size_t *count) {
    if (count) *count = 0;
    if (!design) return FW_STATUS_USAGE;
    if (!is_set(numbers)) return (int)fw_plan_design_usage(design, "no such set of numbers");
    const unsigned needs = set_table[numbers].needs;
    if ((design->done & needs) != needs)
        return (int)fw_plan_design_usage(design,
                                         "the stage that makes these numbers was not called");
    if (!design->numbers[numbers]) {
        const int status = fw_plan_design_run(design, compose, &numbers);
        if (status != FW_STATUS_OK) return status;
    }
    if (count) *count = design->numbers[numbers]->count;
    return FW_STATUS_OK;
}

/* composed, if that can be; it adds no diagnostic where it cannot */
static const fw_plan_arrays *set_of(fw_design *design, int numbers) {
    if (!design || !is_set(numbers)) return NULL;
    const unsigned needs = set_table[numbers].needs;
    if ((design->done & needs) != needs) return NULL;
    if (fw_design_arrays(design, numbers, NULL) != FW_STATUS_OK) return NULL;
    return design->numbers[numbers];
}

const fw_array *fw_design_array(fw_design *design, int numbers, size_t i) {
    const fw_plan_arrays *set = set_of(design, numbers);
    return set && i < set->count ? set->item[i] : NULL;
}

const fw_array *fw_design_array_named(fw_design *design, int numbers, const char *name) {
    const fw_plan_arrays *set = set_of(design, numbers);
    for (size_t i = 0; set && name && i < set->count; i++)
        if (strcmp(set->item[i]->name, name) == 0) return set->item[i];
    return NULL;
}
