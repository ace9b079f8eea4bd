/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

static int run(fw_design *design, const fw_cli_options *options) {
    int status = fw_design_simulate(design);
    if (status == FW_STATUS_OK && options->csv)
        status = fw_design_save(design, FW_DOCUMENT_MOTION_CSV, options->csv);
    if (status == FW_STATUS_OK && options->forces)
        status = fw_design_save(design, FW_DOCUMENT_FORCES_CSV, options->forces);
    if (status == FW_STATUS_OK && options->animate)
        status = fw_design_save(design, FW_DOCUMENT_ANIMATION_SVG, options->animate);
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_MOTION_CSV, "motion.csv"},
                                               {FW_DOCUMENT_FORCES_CSV, "forces.csv"},
                                               {FW_DOCUMENT_ANIMATION_SVG, "motion.svg"}};
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, 3);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_SIMULATE_JSON);
    if (options->quiet || fw_cli_session_file_on_stdout(options)) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_SIMULATE_TEXT);
}

int fw_cli_command_simulate(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    return fw_cli_session_close(design, options, run(design, options), 0);
}
