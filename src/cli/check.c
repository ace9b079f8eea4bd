/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"

int fw_command_check(fw_cli_options *options) {
    int exit_status;
    fw_plan *plan = fw_session_open(options, &exit_status);
    if (!plan) return exit_status;
    fw_session_stage(options, "layout, mechanism, motion and verdict");
    fw_status status = fw_plan_judge(plan);
    if (status == FW_OK && options->json) {
        fw_text text = fw_text_new(plan->arena);
        status = fw_plan_verdict_json(plan, &text);
        if (status == FW_OK) fw_session_print(&text);
    } else if (status == FW_OK)
        fw_session_print_verdict(plan, options);
    int result = status == FW_OK ? fw_session_result(plan) : 0;
    return fw_session_close(plan, options, status, result);
}
