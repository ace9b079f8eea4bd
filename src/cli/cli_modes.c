/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

static int run(fw_design *design, const fw_cli_options *options) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_MODES_JSON, "modes.json"},
                                               {FW_DOCUMENT_MODES_SVG, "modes.svg"}};
    int status = fw_design_modes(design);
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, 2);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_MODES_JSON);
    if (options->quiet) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_MODES_TEXT);
}

int fw_cli_command_modes(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    return fw_cli_session_close(design, options, run(design, options), 0);
}
