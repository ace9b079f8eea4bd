/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include <stdio.h>
#include <sys/stat.h>

/* -o DIR: motion.csv and motion.svg in it, each whole or not at all */
static int save_both(fw_design *design, const char *directory) {
    static const struct {
        int document;
        const char *name;
    } file[] = {{FW_DOCUMENT_MOTION_CSV, "motion.csv"}, {FW_DOCUMENT_ANIMATION_SVG, "motion.svg"}};
    mkdir(directory, 0777); /* what is wrong with it, saving will say */
    for (size_t i = 0; i < sizeof file / sizeof file[0]; i++) {
        char path[4200];
        if (snprintf(path, sizeof path, "%s/%s", directory, file[i].name) >= (int)sizeof path)
            return FW_STATUS_IO;
        int status = fw_design_save(design, file[i].document, path);
        if (status != FW_STATUS_OK) return status;
    }
    return FW_STATUS_OK;
}

static int run(fw_design *design, const fw_cli_options *options) {
    int status = fw_design_simulate(design);
    if (status == FW_STATUS_OK && options->csv)
        status = fw_design_save(design, FW_DOCUMENT_MOTION_CSV, options->csv);
    if (status == FW_STATUS_OK && options->animate)
        status = fw_design_save(design, FW_DOCUMENT_ANIMATION_SVG, options->animate);
    if (status == FW_STATUS_OK && options->output) status = save_both(design, options->output);
    if (status != FW_STATUS_OK) return status;
    bool csv_on_stdout = options->csv && options->csv[0] == '-' && !options->csv[1];
    if (options->json) return fw_session_print(design, options, FW_DOCUMENT_SIMULATE_JSON);
    if (options->quiet || csv_on_stdout) return FW_STATUS_OK;
    return fw_session_print(design, options, FW_DOCUMENT_SIMULATE_TEXT);
}

int fw_command_simulate(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_session_open(options, &exit_status);
    if (!design) return exit_status;
    return fw_session_close(design, options, run(design, options), 0);
}
