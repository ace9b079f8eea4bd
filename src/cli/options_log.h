/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of log. Private to the room. */
#ifndef FW_CLI_OPTIONS_LOG_H
#define FW_CLI_OPTIONS_LOG_H
#include "cli/options.h"

/* NULL or what is wrong with the value */
const char *fw_cli_take_run(fw_cli_options *o, const char *v);
const char *fw_cli_take_entry(fw_cli_options *o, const char *v);
const char *fw_cli_take_entries(fw_cli_options *o, const char *v);
const char *fw_cli_take_lot(fw_cli_options *o, const char *v);
const char *fw_cli_take_wafer_ids(fw_cli_options *o, const char *v);
const char *fw_cli_take_wafer(fw_cli_options *o, const char *v);
const char *fw_cli_take_instrument(fw_cli_options *o, const char *v);
const char *fw_cli_take_report(fw_cli_options *o, const char *v);
const char *fw_cli_take_site(fw_cli_options *o, const char *v);
const char *fw_cli_take_setting(fw_cli_options *o, const char *v);
const char *fw_cli_take_coupon(fw_cli_options *o, const char *v);

#endif
