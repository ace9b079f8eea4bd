/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Manual pages and completions for shells, from the tables of commands and options. Not part of the program:
   tools/manuals writes them at build time. Private to the room, its tests and that tool. */
#ifndef FW_CLI_MANUALS_H
#define FW_CLI_MANUALS_H
#include "cli/options.h"

/* man(7), section 1; command NULL: of the program, which names those of the commands */
void fw_cli_manual(const fw_cli_command *command, fw_text *out);

typedef enum fw_cli_shell { FW_SHELL_BASH, FW_SHELL_ZSH, FW_SHELL_FISH } fw_cli_shell;
void fw_cli_completion(fw_cli_shell shell, fw_text *out);

/* what may stand behind an option: words with a space between, or NULL: a file, directory or anything, as
   *kind says; until the next call */
typedef enum fw_cli_value {
    FW_VALUE_WORDS,
    FW_VALUE_FILE,
    FW_VALUE_DIRECTORY,
    FW_VALUE_OTHER
} fw_cli_value;
const char *fw_cli_option_values(const fw_cli_option_row *row, fw_cli_value *kind);

#endif
