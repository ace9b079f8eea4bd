/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include <stdio.h>

static int run(fw_design *design, const fw_cli_options *options, unsigned what,
               const char *directory) {
    fw_cli_session_stage(options, "layout, mechanism, motion and verdict");
    int status = fw_design_judge(design);
    if (status != FW_STATUS_OK) return status;
    fw_cli_session_stage(options, "bias, masks and recipes");
    status = fw_design_fabricate(design);
    if (status != FW_STATUS_OK) return status;
    fw_cli_session_stage(options, "writing");
    return directory ? fw_design_write(design, directory, what) : FW_STATUS_OK;
}

/* plan, mask and recipe differ only in what is written and shown */
static int fabricate(fw_cli_options *options, unsigned what, const char *kind, int json) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    char by_name[4200]; /* a name has at most 4096 bytes */
    snprintf(by_name, sizeof by_name, "out/%s%s", fw_design_name(design), kind);
    const char *directory = options->output ? options->output : by_name;
    /* with --json alone nothing is written unless -o asks for it; plan always writes */
    if (options->json && !options->output && what != FW_DESIGN_EVERYTHING) directory = NULL;
    int status = run(design, options, what, directory);
    if (status == FW_STATUS_OK)
        status =
            fw_cli_session_print(design, options, options->json ? json : FW_DOCUMENT_VERDICT_TEXT);
    if (status == FW_STATUS_OK && !options->json) {
        if (fw_design_files_written(design) > 0)
            printf("\nresults: %s/\n", directory);
        else
            printf("\nnothing was written: a rejected design gets no masks and no recipes (--force "
                   "writes them, marked REJECTED)\n");
    }
    return fw_cli_session_close(design, options, status, fw_design_decision(design));
}

int fw_cli_command_plan(fw_cli_options *options) {
    return fabricate(options, FW_DESIGN_EVERYTHING, "", FW_DOCUMENT_VERDICT_JSON);
}

int fw_cli_command_mask(fw_cli_options *options) {
    return fabricate(options, FW_DESIGN_MASKS, "-masks", FW_DOCUMENT_MASKS_JSON);
}

int fw_cli_command_recipe(fw_cli_options *options) {
    return fabricate(options, FW_DESIGN_RECIPES, "-recipes", FW_DOCUMENT_RECIPES_JSON);
}
