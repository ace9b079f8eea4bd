/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was probably meant by the name of a flow that is not there. */
#include "plan/stages.h"
#include <string.h>

static fw_status words_of(fw_plan *plan, const char *wrong, const char *const *name, size_t n,
                          const char **words) {
    const char *near = fw_did_you_mean(wrong, name, n);
    FW_NEED(*words = near ? fw_arena_printf(plan->arena, " (did you mean '%s'?)", near) : "");
    return FW_OK;
}

fw_status fw_plan_flow_meant(fw_plan *plan, const char *wrong, const char **words) {
    const fw_device *d = plan->device;
    const char **name = fw_arena_array(plan->arena, const char *, (size_t)d->nflow);
    size_t n = 0;
    FW_NEED(name);
    for (int i = 0; i < d->nflow; i++)
        if (d->flow[i].ref) name[n++] = d->flow[i].ref;
    return words_of(plan, wrong, name, n, words);
}

fw_status fw_plan_pack_meant(fw_plan *plan, const char *wrong, const char **words) {
    const char *const *all;
    size_t n, flows = 0;
    FW_TRY(fw_data_names(plan->arena, plan->options.data_directory, "processes", &all, &n));
    const char **name = fw_arena_array(plan->arena, const char *, n);
    FW_NEED(name);
    fw_text list = fw_text_new(plan->arena);
    for (size_t i = 0; i < n; i++) {
        if (strcmp(all[i], "base") == 0) continue; /* what all flows share */
        fw_text_printf(&list, "%s%s", flows ? ", " : "", all[i]);
        name[flows++] = all[i];
    }
    FW_TRY(words_of(plan, wrong, name, flows, words));
    if (**words || flows == 0) return fw_text_end(&list);
    FW_TRY(fw_text_end(&list));
    FW_NEED(*words = fw_arena_printf(plan->arena, " (there are %s)", list.data));
    return FW_OK;
}
