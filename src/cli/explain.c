/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int fw_cli_command_explain(fw_cli_options *options) {
    const char *code = options->device;
    const char *digits = strncmp(code, "FW-D", 4) == 0 ? code + 4 : code;
    double number;
    const fw_diag_entry *entry = NULL;
    if (fw_number_parse(digits, strlen(digits), &number) && number >= 0 && number < 1000)
        entry = fw_diag_find((int)number);
    if (!entry) return fw_cli_usage("no diagnostic '%s'; they look like FW-D041", code);
    printf("FW-D%03d: %s\n\n%s\n", entry->number, entry->title, entry->text);
    return 0;
}
