/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of options, for the parser, --help and the reference page. Private to the room. */
#ifndef FW_CLI_OPTION_ROWS_H
#define FW_CLI_OPTION_ROWS_H
#include "cli/options.h"

typedef struct fw_option_row {
    const char *name;     /* without the dashes */
    char letter;          /* 0: none */
    const char *argument; /* NULL: none */
    const char *help;
    unsigned group;
    const char *(*take)(fw_cli_options *o, const char *value); /* NULL or what is wrong */
} fw_option_row;
const fw_option_row *fw_option_rows(size_t *count);

#endif
