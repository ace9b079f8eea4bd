/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of masks. Private to the room. */
#ifndef FW_CLI_OPTIONS_MASKS_H
#define FW_CLI_OPTIONS_MASKS_H
#include "cli/options.h"

/* NULL or what is wrong with the value */
const char *fw_cli_take_tolerance(fw_cli_options *o, const char *v);
const char *fw_cli_take_mask_format(fw_cli_options *o, const char *v);
const char *fw_cli_take_mask_flatten(fw_cli_options *o, const char *v);
const char *fw_cli_take_layers(fw_cli_options *o, const char *v);
const char *fw_cli_take_mask_vertices(fw_cli_options *o, const char *v);

#endif
