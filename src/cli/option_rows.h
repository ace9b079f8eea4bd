/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of options, for the parser, --help and the reference page. Private to the room. */
#ifndef FW_CLI_OPTION_ROWS_H
#define FW_CLI_OPTION_ROWS_H
#include "cli/options.h"

typedef struct fw_cli_option_row {
    const char *name;     /* without the dashes */
    char letter;          /* 0: none */
    const char *argument; /* NULL: none */
    const char *help;     /* {names}: of what may be named, from its table (fw_cli_option_help) */
    unsigned group;
    const char *(*take)(fw_cli_options *o, const char *value); /* NULL or what is wrong */
} fw_cli_option_row;
const fw_cli_option_row *fw_cli_option_rows(size_t *count);
/* "gds, svg or dxf", from the tables; until the next call */
const char *fw_cli_mask_format_names(void);
const char *fw_cli_hinge_model_names(void);
const char *fw_cli_level_names(void);
const char *
fw_cli_option_help(const fw_cli_option_row *row); /* with the names; until the next call */

#endif
