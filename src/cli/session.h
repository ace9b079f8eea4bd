/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the commands share. Private to the room. */
#ifndef FW_CLI_SESSION_H
#define FW_CLI_SESSION_H
#include "cli/options.h"

int fw_cli_command_plan(fw_cli_options *options);
int fw_cli_command_check(fw_cli_options *options);
int fw_cli_command_simulate(fw_cli_options *options);
int fw_cli_command_modes(fw_cli_options *options);
int fw_cli_command_statics(fw_cli_options *options);
int fw_cli_command_assemble(fw_cli_options *options);
int fw_cli_command_mask(fw_cli_options *options);
int fw_cli_command_recipe(fw_cli_options *options);
int fw_cli_command_log(fw_cli_options *options);
int fw_cli_command_workspace(fw_cli_options *options);
int fw_cli_command_hinge(fw_cli_options *options);
int fw_cli_command_tradeoff(fw_cli_options *options);
int fw_cli_command_calibrate(fw_cli_options *options);
int fw_cli_command_serve(fw_cli_options *options);
int fw_cli_command_init(fw_cli_options *options);
int fw_cli_command_explain(fw_cli_options *options);
int fw_cli_command_doctor(fw_cli_options *options);

/* a design that was read, or NULL with *exit_status set and everything said */
fw_design *fw_cli_session_open(fw_cli_options *options, int *exit_status);
/* prints the diagnostics on standard error and frees; returns the exit status */
int fw_cli_session_close(fw_design *design, const fw_cli_options *options, int status,
                         int result_if_ok);
/* a line on standard error with -v */
void fw_cli_session_stage(const fw_cli_options *options, const char *stage);
/* a document (FW_DOCUMENT_...) on standard output; returns the library's status */
int fw_cli_session_print(fw_design *design, const fw_cli_options *options, int document);

typedef struct fw_cli_session_file {
    int document; /* FW_DOCUMENT_... */
    const char *name;
} fw_cli_session_file;
/* documents as files of a directory, all of them or none; returns the library's status */
int fw_cli_session_save(fw_design *design, const char *directory, const fw_cli_session_file *file,
                        size_t count);
/* --csv - : the table has standard output for itself */
bool fw_cli_session_file_on_stdout(const fw_cli_options *options);

#endif
