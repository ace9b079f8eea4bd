/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

static int run(fw_design *design, const fw_cli_options *options) {
    int status = fw_design_simulate(design);
    if (status == FW_STATUS_OK && options->csv)
        status = fw_design_save(design, FW_DOCUMENT_MOTION_CSV, options->csv);
    if (status == FW_STATUS_OK && options->animate)
        status = fw_design_save(design, FW_DOCUMENT_ANIMATION_SVG, options->animate);
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
