/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include <stdio.h>

static fw_status run(fw_plan *plan, fw_cli_options *options, unsigned what, const char *directory) {
    fw_session_stage(options, "layout, mechanism, motion and verdict");
    FW_TRY(fw_plan_judge(plan));
    fw_session_stage(options, "bias, masks and recipes");
    FW_TRY(fw_plan_fabricate(plan));
    fw_session_stage(options, "writing");
    if (directory) FW_TRY(fw_plan_write(plan, directory, what));
    return FW_OK;
}

/* plan, mask and recipe differ only in what is written and shown */
static int fabricate(fw_cli_options *options, unsigned what,
                     fw_status (*json)(fw_plan *plan, fw_text *out)) {
    int exit_status;
    fw_plan *plan = fw_session_open(options, &exit_status);
    if (!plan) return exit_status;
    /* with --json alone nothing is written unless -o asks for it; plan always writes */
    const char *directory = options->json && !options->output && what != FW_WRITE_ALL
                                ? NULL
                                : fw_session_directory(plan, options);
    fw_status status = run(plan, options, what, directory);
    if (status == FW_OK && options->json) {
        fw_text text = fw_text_new(plan->arena);
        status = json(plan, &text);
        if (status == FW_OK) status = fw_text_end(&text);
        if (status == FW_OK) fw_session_print(&text);
    } else if (status == FW_OK) {
        fw_session_print_verdict(plan, options);
        printf("\nresults: %s/\n", directory);
    }
    int result = status == FW_OK ? fw_session_result(plan) : 0;
    return fw_session_close(plan, options, status, result);
}

int fw_command_plan(fw_cli_options *options) {
    return fabricate(options, FW_WRITE_ALL, fw_plan_verdict_json);
}

static fw_status masks_json(fw_plan *plan, fw_text *out) {
    fw_text_add(out, "{\"schema\":\"flexwright.masks/1\",\"masks\":[");
    int written = 0;
    for (int i = 0; i < plan->nflow; i++)
        if (plan->flow[i].mask) {
            fw_text_add(out, written++ ? "," : "");
            FW_TRY(fw_mask_write_certificate(plan->flow[i].mask, plan->flow[i].mask_sha256, out));
        }
    fw_text_add(out, "]}\n");
    return FW_OK;
}

int fw_command_mask(fw_cli_options *options) {
    return fabricate(options, FW_WRITE_MASKS, masks_json);
}

static fw_status recipes_json(fw_plan *plan, fw_text *out) {
    bool several = plan->nflow > 1;
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    if (several) fw_text_add(out, "{\"schema\":\"flexwright.recipes/1\",\"recipes\":[");
    int written = 0;
    for (int i = 0; given && i < plan->nflow; i++) {
        const fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        fw_recipe_header header = {plan->device->name, pf->flow_sha256, pf->mask_sha256, FW_VERSION,
                                   plan->verdict.decision == FW_REJECT};
        fw_text_add(out, written++ ? "," : "");
        FW_TRY(fw_recipe_write_json(pf->flow, &header, out));
    }
    if (several)
        fw_text_add(out, "]}\n");
    else if (!written)
        fw_text_add(out, "{\"schema\":\"flexwright.recipe/1\",\"flow\":null,\"steps\":[],"
                         "\"total_s\":null,\"rejected\":true}\n");
    return FW_OK;
}

int fw_command_recipe(fw_cli_options *options) {
    return fabricate(options, FW_WRITE_RECIPES, recipes_json);
}
