/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

int fw_cli_command_check(fw_cli_options *options) {
    int exit_status;
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    fw_cli_session_stage(options, "layout, mechanism, motion and verdict");
    int status = fw_design_judge(design);
    if (status == FW_STATUS_OK && options->output)
        status = fw_design_write(design, options->output, FW_DESIGN_VERDICT);
    if (status == FW_STATUS_OK)
        status = fw_cli_session_print(
            design, options, options->json ? FW_DOCUMENT_VERDICT_JSON : FW_DOCUMENT_VERDICT_TEXT);
    return fw_cli_session_close(design, options, status, fw_design_decision(design));
}
