/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader of a command's line: its options by the rows of options.c, and at most one name. */
#include "cli/options.h"
#include <string.h>

enum { MOST_OPTIONS = 256 }; /* of one command, for what was probably meant */

static const fw_cli_option_row *find(const fw_cli_command *command, const char *name, size_t n,
                                     char letter) {
    size_t count;
    const fw_cli_option_row *table = fw_cli_option_rows(&count);
    for (size_t i = 0; i < count; i++) {
        if (!(table[i].group & command->options)) continue;
        if (letter ? table[i].letter == letter
                   : strlen(table[i].name) == n && strncmp(table[i].name, name, n) == 0)
            return &table[i];
    }
    return NULL;
}

static bool unknown_option(const fw_cli_command *command, const char *argument) {
    const char *names[MOST_OPTIONS];
    size_t n = 0, count;
    const fw_cli_option_row *table = fw_cli_option_rows(&count);
    for (size_t i = 0; i < count && n < MOST_OPTIONS; i++)
        if (table[i].group & command->options) names[n++] = table[i].name;
    const char *near = argument[1] == '-' ? fw_did_you_mean(argument + 2, names, n) : NULL;
    fw_cli_usage("%s has no option '%s'%s%s%s; see flexwright %s --help", command->name, argument,
                 near ? "; did you mean --" : "", near ? near : "", near ? "?" : "", command->name);
    return false;
}

/* one option at argv[*i]; takes its value from behind '=' or from the next argument */
static bool one_option(const fw_cli_command *command, int argc, char **argv, int *i,
                       fw_cli_options *o) {
    const char *argument = argv[*i], *value = NULL;
    const fw_cli_option_row *row;
    if (argument[1] == '-') {
        size_t n = strcspn(argument + 2, "=");
        row = find(command, argument + 2, n, 0);
        value = argument[2 + n] == '=' ? argument + 3 + n : NULL;
    } else {
        row = find(command, NULL, 0, argument[1]);
        value = argument[2] ? argument + 2 : NULL;
    }
    if (!row || (!row->argument && value)) return unknown_option(command, argument);
    if (row->argument && !value) {
        if (*i + 1 >= argc) {
            fw_cli_usage("--%s needs %s: %s", row->name, row->argument, fw_cli_option_help(row));
            return false;
        }
        value = argv[++*i];
    }
    const char *wrong = row->take(o, value);
    if (wrong) fw_cli_usage("--%s%s%s %s", row->name, value ? " " : "", value ? value : "", wrong);
    return !wrong;
}

static bool is_stdout(const char *file) {
    return file && strcmp(file, "-") == 0;
}

/* standard output holds one document */
static bool one_document(const fw_cli_command *command, const fw_cli_options *o) {
    const struct {
        const char *name;
        bool wanted;
    } use[] = {{"--json", o->json},
               {"--csv -", is_stdout(o->csv)},
               {"--forces -", is_stdout(o->forces)},
               {"--animate -", is_stdout(o->animate)},
               {"--svg -", is_stdout(o->svg)}};
    const char *first = NULL;
    for (size_t i = 0; i < sizeof use / sizeof use[0]; i++) {
        if (!use[i].wanted) continue;
        if (first) {
            fw_cli_usage("%s: %s and %s both want standard output, which holds one document; give "
                         "one of them a file",
                         command->name, first, use[i].name);
            return false;
        }
        first = use[i].name;
    }
    return true;
}

bool fw_cli_parse(const fw_cli_command *command, int argc, char **argv, fw_cli_options *o) {
    bool only_names = false;
    for (int i = 2; i < argc; i++) {
        const char *argument = argv[i];
        if (!only_names && strcmp(argument, "--") == 0)
            only_names = true;
        else if (!only_names && argument[0] == '-' && argument[1]) {
            if (!one_option(command, argc, argv, &i, o)) return false;
        } else if (o->device && (command->options & FW_OPT_STUDY) && o->nmore < FW_MOST_NAMES) {
            o->more[o->nmore++] = argument;
        } else if (o->device) {
            fw_cli_usage("%s takes one %s, got '%s' and '%s'", command->name,
                         command->argument ? command->argument : "argument", o->device, argument);
            return false;
        } else
            o->device = argument;
    }
    if (!o->help && command->argument && command->argument[0] != '[' && !o->device) {
        fw_cli_usage("%s needs %s; see flexwright %s --help", command->name, command->argument,
                     command->name);
        return false;
    }
    return o->help || one_document(command, o);
}
