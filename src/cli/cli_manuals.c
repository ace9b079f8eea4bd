/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Manual pages. */
#include "cli/manuals.h"
#include <stdio.h>
#include <string.h>

/* text of roff: no line begins with a dot or quote, and a minus is one */
static void put(fw_text *out, const char *text) {
    bool begins = true;
    for (; *text; text++) {
        if (begins && (*text == '.' || *text == '\'')) fw_text_add(out, "\\&");
        if (*text == '\\' || *text == '-')
            fw_text_printf(out, "\\%c", *text == '-' ? '-' : 'e');
        else
            fw_text_bytes(out, text, 1);
        begins = *text == '\n';
    }
}

static void head(fw_text *out, const char *page, const char *summary) {
    fw_text_add(out, ".\\\" Generated from the tables of commands and options; do not edit.\n.TH ");
    for (const char *c = page; *c; c++)
        fw_text_printf(out, "%c", *c >= 'a' && *c <= 'z' ? *c - 'a' + 'A' : *c);
    fw_text_printf(out, " 1 \"\" \"flexwright %s\" \"Flexwright\"\n.SH NAME\n", FW_VERSION);
    put(out, page);
    fw_text_add(out, " \\- ");
    put(out, summary);
    fw_text_add(out, "\n");
}

static void options_of(const fw_cli_command *command, fw_text *out) {
    size_t count;
    const fw_cli_option_row *row = fw_cli_option_rows(&count);
    fw_text_add(out, ".SH OPTIONS\n");
    for (size_t i = 0; i < count; i++) {
        if (!(row[i].group & command->options)) continue;
        fw_text_add(out, ".TP\n");
        if (row[i].letter) fw_text_printf(out, "\\fB\\-%c\\fR, ", row[i].letter);
        fw_text_add(out, "\\fB\\-\\-");
        put(out, row[i].name);
        fw_text_add(out, "\\fR");
        if (row[i].argument) fw_text_printf(out, " \\fI%s\\fR", row[i].argument);
        fw_text_add(out, "\n");
        put(out, fw_cli_option_help(&row[i]));
        fw_text_add(out, "\n");
    }
}

static void statuses(fw_text *out) {
    static const struct {
        int status;
        const char *text;
    } row[] = {{0, "accepted, or done"},
               {1, "the design is rejected"},
               {2, "wrong usage"},
               {3, "invalid input"},
               {4, "inconclusive: the error band straddles the limit"},
               {5, "input or output failed"},
               {6, "out of memory, or another limit"},
               {7, "no numerical solution"},
               {70, "a fault of the program"},
               {130, "interrupted; 143: terminated"}};
    fw_text_add(out, ".SH EXIT STATUS\n");
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        fw_text_printf(out, ".TP\n.B %d\n%s\n", row[i].status, row[i].text);
}

static void environment(fw_text *out) {
    fw_text_add(out,
                ".SH ENVIRONMENT\n.TP\n.B FLEXWRIGHT_DATA\nthe directory that holds processes/ "
                "and masks/; then only that one is used\n.TP\n.BR NO_COLOR \", \" "
                "FORCE_COLOR\nas usual\n");
}

static void program(fw_text *out) {
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    head(out, "flexwright",
         "from one description of a compliant micromanipulator to a verdict, masks and recipes");
    fw_text_add(out, ".SH SYNOPSIS\n.B flexwright\n.I COMMAND\n.RI [ argument ]\n.RI [ options ]\n"
                     ".SH DESCRIPTION\n");
    put(out, "Judges whether any flexure hinge of a planar compliant mechanism leaves its elastic "
             "range, draws its masks and computes the steps of its fabrication. Results go to "
             "standard output, messages to standard error.\n");
    fw_text_add(out, ".SH COMMANDS\n");
    for (size_t i = 0; i < n; i++) {
        fw_text_printf(out, ".TP\n.BR flexwright\\-%s (1)\n", command[i].name);
        put(out, command[i].summary);
        fw_text_add(out, "\n");
    }
    statuses(out);
    environment(out);
}

void fw_cli_manual(const fw_cli_command *command, fw_text *out) {
    if (!command) {
        program(out);
        return;
    }
    char page[64];
    snprintf(page, sizeof page, "flexwright-%s", command->name);
    head(out, page, command->summary);
    fw_text_printf(out, ".SH SYNOPSIS\n.B flexwright %s\n", command->name);
    if (command->argument) fw_text_printf(out, ".I %s\n", command->argument);
    fw_text_add(out, ".RI [ options ]\n.SH DESCRIPTION\n");
    put(out, command->text);
    fw_text_add(out, "\n");
    options_of(command, out);
    fw_text_add(out, ".SH EXAMPLE\n.EX\n");
    put(out, command->example);
    fw_text_add(out, "\n.EE\n");
    statuses(out);
    fw_text_add(out, ".SH SEE ALSO\n.BR flexwright (1)\n");
}
