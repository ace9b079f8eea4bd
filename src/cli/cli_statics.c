/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

static int run(fw_design *design, const fw_cli_options *options) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_STATICS_JSON, "statics.json"},
                                               {FW_DOCUMENT_STATICS_SVG, "statics.svg"},
                                               {FW_DOCUMENT_LOAD_PATH_CSV, "statics.csv"},
                                               {FW_DOCUMENT_LOAD_PATH_SVG, "path.svg"}};
    int status = fw_design_statics(design);
    if (status == FW_STATUS_OK && options->csv)
        status = fw_design_save(design, FW_DOCUMENT_LOAD_PATH_CSV, options->csv);
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, options->design.path ? 4 : 3);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_STATICS_JSON);
    if (options->quiet || fw_cli_session_file_on_stdout(options)) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_STATICS_TEXT);
}

int fw_cli_command_statics(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    return fw_cli_session_close(design, options, run(design, options), 0);
}
