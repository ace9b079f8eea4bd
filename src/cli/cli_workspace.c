/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

static int run(fw_design *design, const fw_cli_options *options) {
    static const fw_cli_session_file file[] = {{FW_DOCUMENT_WORKSPACE_JSON, "workspace.json"},
                                               {FW_DOCUMENT_WORKSPACE_SVG, "workspace.svg"},
                                               {FW_DOCUMENT_CERTIFICATE_JSON, "certificate.json"}};
    fw_cli_session_stage(options, "inverse kinematics, interval branch and bound");
    int status = fw_design_workspace(design);
    if (status == FW_STATUS_OK && options->output)
        status = fw_cli_session_save(design, options->output, file, 3);
    if (status != FW_STATUS_OK) return status;
    if (options->json) return fw_cli_session_print(design, options, FW_DOCUMENT_WORKSPACE_JSON);
    if (options->quiet) return FW_STATUS_OK;
    return fw_cli_session_print(design, options, FW_DOCUMENT_WORKSPACE_TEXT);
}

int fw_cli_command_workspace(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    return fw_cli_session_close(design, options, run(design, options), 0);
}
