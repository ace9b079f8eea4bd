/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of study. Private to the room. */
#ifndef FW_CLI_OPTIONS_STUDY_H
#define FW_CLI_OPTIONS_STUDY_H
#include "cli/options.h"

/* NULL or what is wrong with the value */
const char *fw_cli_take_study(fw_cli_options *o, const char *v);
const char *fw_cli_take_jobs(fw_cli_options *o, const char *v);
const char *fw_cli_take_shard(fw_cli_options *o, const char *v);
const char *fw_cli_take_resume(fw_cli_options *o, const char *v);
const char *fw_cli_take_plan_only(fw_cli_options *o, const char *v);

#endif
