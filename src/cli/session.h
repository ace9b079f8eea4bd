/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the commands share. Private to the room. */
#ifndef FW_CLI_SESSION_H
#define FW_CLI_SESSION_H
#include "cli/options.h"

int fw_command_plan(fw_cli_options *options);
int fw_command_check(fw_cli_options *options);
int fw_command_simulate(fw_cli_options *options);
int fw_command_mask(fw_cli_options *options);
int fw_command_recipe(fw_cli_options *options);
int fw_command_hinge(fw_cli_options *options);
int fw_command_init(fw_cli_options *options);
int fw_command_explain(fw_cli_options *options);
int fw_command_doctor(fw_cli_options *options);

/* plan with the device loaded, or NULL with *exit_status set and everything said */
fw_plan *fw_session_open(fw_cli_options *options, int *exit_status);
/* prints the diagnostics on standard error and frees; returns the exit status */
int fw_session_close(fw_plan *plan, const fw_cli_options *options, fw_status status,
                     int result_if_ok);
/* a line on standard error with -v */
void fw_session_stage(const fw_cli_options *options, const char *stage);
/* 0 accept, 1 reject, 4 inconclusive; 1 as well when a flow cannot make the device */
int fw_session_result(const fw_plan *plan);
/* verdict for people, on standard output */
void fw_session_print_verdict(const fw_plan *plan, const fw_cli_options *options);
void fw_session_print(const fw_text *text);
/* -o, or out/NAME */
const char *fw_session_directory(fw_plan *plan, const fw_cli_options *options);

#endif
