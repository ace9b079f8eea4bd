/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Manual pages, and completions for bash, zsh and fish, from the tables of commands and options. */
#include "cli/cli.h"
#include "dynamics/dynamics.h"
#include "effects/effects.h"
#include "mask/mask.h"
#include "plan/plan.h"
#include <stdio.h>
#include <string.h>

/* ---- manual pages ---- */

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

/* a first hour, and where the rest is told: a reader of this page may have nothing else yet */
static void beginning(fw_text *out) {
    fw_text_add(out, ".SH EXAMPLES\n.EX\n");
    put(out, "flexwright init my-device > device.xml      # a small six-bar with comments\n"
             "flexwright check device.xml                 # the verdict\n"
             "flexwright check device.xml --set t=\"12 um\"\n"
             "flexwright plan device.xml -o out           # out/report.html, masks, recipes\n"
             "flexwright serve device.xml                 # the same on a page, moving\n"
             "flexwright explain FW-D204                  # the long text of a message\n");
    fw_text_add(out, ".EE\n.SH FILES\nBelow the prefix of the installation, /usr of a package:\n"
                     ".TP\n.I share/doc/flexwright/docs\n"
                     "the documentation: index.md, tutorial.md, reference/device.md (every element "
                     "and attribute of a device file), python.md, c\\-api.md, klayout.md\n"
                     ".TP\n.I share/doc/flexwright/docs/gallery\ndevices to start from\n"
                     ".TP\n.I share/flexwright/processes, share/flexwright/masks\n"
                     "process packs and layer tables, which are data: a laboratory edits a copy\n"
                     ".TP\n.I share/flexwright/device.rng, share/flexwright/study.rng, "
                     "share/flexwright/catalog.xml\n"
                     "schemas of device files, studies and process packs for editors\n"
                     ".TP\n.I share/flexwright/klayout\nthe package for KLayout\n");
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
    beginning(out);
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

/* ---- what may stand behind an option ---- */

typedef struct word_list {
    char text[600];
    size_t n;
} word_list;
static word_list words;

static void add(const char *name) {
    if (words.n < sizeof words.text)
        words.n += (size_t)snprintf(words.text + words.n, sizeof words.text - words.n, "%s%s",
                                    words.n ? " " : "", name);
}

static void rows_of(fw_multibody_method_row (*at)(size_t)) {
    for (size_t i = 0; at(i).name; i++)
        add(at(i).name);
}

static void methods(void) {
    rows_of(fw_multibody_method_at);
}

static void integrators(void) {
    rows_of(fw_dynamics_integrator_at);
}

static void stabilisations(void) {
    rows_of(fw_dynamics_stabilisation_at);
}

static void hinge_models(void) {
    for (size_t i = 0; i < fw_effects_hinge_model_count(); i++)
        add(fw_effects_hinge_model_text((fw_effects_hinge_model)i));
}

static void levels(void) {
    size_t count;
    const fw_plan_ladder_level *level = fw_plan_ladder_levels(&count);
    for (size_t i = 0; i < count; i++)
        add(level[i].name);
    add("all");
    add("auto");
}

static void formats(void) {
    const fw_mask_format *f;
    for (size_t i = 0; (f = fw_mask_format_at(i)) != NULL; i++)
        if (!f->beside) add(f->name);
    add("all");
}

static const struct {
    const char *option;
    void (*list)(void);
    const char *fixed; /* where there is no table */
} known[] = {{"method", methods, NULL},
             {"integrator", integrators, NULL},
             {"stabilise", stabilisations, NULL},
             {"hinge-model", hinge_models, NULL},
             {"level", levels, NULL},
             {"mask-format", formats, NULL},
             {"effects", NULL, "auto all none"},
             {"corners", NULL, "auto none"},
             {"advice", NULL, "auto none"},
             {"measurements", NULL, "auto all none"},
             {"mask-flatten", NULL, "inside equal-area"},
             {"mask-vertices", NULL, "199 4094 8190"},
             {"at", NULL, "rest equilibrium"},
             {"color", NULL, "auto always never"}};

const char *fw_cli_option_values(const fw_cli_option_row *row, fw_cli_value *kind) {
    *kind = FW_VALUE_OTHER;
    if (!row->argument) return NULL;
    if (strcmp(row->argument, "DIR") == 0) *kind = FW_VALUE_DIRECTORY;
    if (strcmp(row->argument, "FILE") == 0) *kind = FW_VALUE_FILE;
    if (strcmp(row->name, "flow") == 0) *kind = FW_VALUE_FLOW;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(known[i].option, row->name) != 0) continue;
        *kind = FW_VALUE_WORDS;
        words = (word_list){.n = 0};
        if (known[i].list)
            known[i].list();
        else
            add(known[i].fixed);
        return words.text;
    }
    return NULL;
}

/* ---- completions: what the shells share ---- */

/* the first option of a name in a command's list: a name stands there once */
static const fw_cli_option_row *option_at(const fw_cli_command *command, size_t *i) {
    size_t count;
    const fw_cli_option_row *row = fw_cli_option_rows(&count);
    while (*i < count && !(row[*i].group & command->options))
        ++*i;
    return *i < count ? &row[(*i)++] : NULL;
}

/* The first words of a sentence, without what a shell would take for its own: a colon between words is a comma there,
   an apostrophe a typographic one. */
static void sentence(fw_text *out, const char *text) {
    enum { MOST = 70 };
    size_t n = strcspn(text, ";\n{");
    if (n > MOST)
        for (n = MOST; n > 0 && text[n] != ' ';)
            n--;
    while (n > 0 && strchr(" ,:", text[n - 1]))
        n--;
    for (size_t i = 0; i < n; i++)
        if (text[i] == '\'' && i > 0 && i + 1 < n && text[i - 1] != ' ')
            fw_text_add(out, "\xe2\x80\x99");
        else if (text[i] == ':' && text[i + 1] == ' ')
            fw_text_add(out, ",");
        else if (!strchr("'\"`$\\[]:()", text[i]))
            fw_text_bytes(out, &text[i], 1);
}

static bool takes_device(const fw_cli_command *command) {
    return command->argument && strstr(command->argument, ".xml");
}

/* the flows that are installed, of what `doctor` says: those that have a table of masks */
#define FLOWS "sed -n \"s,^masks/\\([^ ]*\\)\\.xml .*,\\1,p\""

/* ---- bash ---- */

static void bash_values(const fw_cli_command *command, fw_text *out) {
    const fw_cli_option_row *row;
    for (size_t i = 0; (row = option_at(command, &i)) != NULL;) {
        fw_cli_value kind;
        const char *values = fw_cli_option_values(row, &kind);
        if (!row->argument) continue;
        fw_text_printf(out, "        %s:--%s", command->name, row->name);
        if (row->letter) fw_text_printf(out, "|%s:-%c", command->name, row->letter);
        switch (kind) {
        case FW_VALUE_WORDS:
            fw_text_printf(out, ") _flexwright_take -W '%s' ;;\n", values);
            break;
        case FW_VALUE_FILE:
            fw_text_add(out, ") _flexwright_take -f ;;\n");
            break;
        case FW_VALUE_DIRECTORY:
            fw_text_add(out, ") _flexwright_take -d ;;\n");
            break;
        case FW_VALUE_FLOW:
            fw_text_add(out, ") _flexwright_take -W \"$(_flexwright_flows)\" ;;\n");
            break;
        case FW_VALUE_OTHER:
            fw_text_add(out, ") COMPREPLY=() ;;\n");
            break;
        }
    }
}

static void bash_command(const fw_cli_command *command, fw_text *out) {
    const fw_cli_option_row *row;
    fw_text_printf(out,
                   "        %s:*)\n            if [[ $current == -* ]]; then\n"
                   "                _flexwright_take -W '",
                   command->name);
    for (size_t i = 0, n = 0; (row = option_at(command, &i)) != NULL;)
        fw_text_printf(out, "%s--%s", n++ ? " " : "", row->name);
    fw_text_printf(
        out, "'\n            else\n                _flexwright_take -f%s\n            fi ;;\n",
        takes_device(command) ? " -X '!*.xml' -o plusdirs" : "");
}

static void bash(const fw_cli_command *command, size_t n, fw_text *out) {
    fw_text_add(
        out,
        "# bash completion of flexwright; generated from its tables, do not edit\n"
        "_flexwright_flows() {\n    \"${COMP_WORDS[0]}\" doctor 2>/dev/null | " FLOWS "\n}\n"
        "_flexwright_take() {\n"
        "    [ \"$1\" = -W ] || compopt -o filenames 2>/dev/null\n"
        "    mapfile -t COMPREPLY < <(compgen \"$@\" -- \"$current\")\n}\n"
        "_flexwright() {\n"
        "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
        "    if [ \"$current\" = = ]; then\n        current=\n"
        "    elif [ \"$before\" = = ]; then\n        before=${COMP_WORDS[COMP_CWORD-2]}\n    fi\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        _flexwright_take -W '");
    for (size_t i = 0; i < n; i++)
        fw_text_printf(out, "%s ", command[i].name);
    fw_text_add(out, "--help --version'\n        return\n    fi\n"
                     "    case ${COMP_WORDS[1]}:$before in\n");
    for (size_t i = 0; i < n; i++) {
        bash_values(&command[i], out);
        bash_command(&command[i], out);
    }
    fw_text_add(out, "    esac\n}\ncomplete -F _flexwright flexwright\n");
}

/* ---- zsh ---- */

static void zsh_option(const fw_cli_option_row *row, fw_text *out) {
    fw_cli_value kind;
    const char *values = fw_cli_option_values(row, &kind);
    fw_text_add(out, " \\\n            ");
    if (row->letter)
        fw_text_printf(out, "{-%c,--%s}'[", row->letter, row->name);
    else
        fw_text_printf(out, "'--%s[", row->name);
    sentence(out, row->help);
    fw_text_add(out, "]");
    if (row->argument) {
        fw_text_add(out, ":");
        sentence(out, row->argument);
        switch (kind) {
        case FW_VALUE_WORDS:
            fw_text_printf(out, ":(%s)", values);
            break;
        case FW_VALUE_FILE:
            fw_text_add(out, ":_files");
            break;
        case FW_VALUE_DIRECTORY:
            fw_text_add(out, ":_files -/");
            break;
        case FW_VALUE_FLOW:
            fw_text_add(out, ":_flexwright_flows");
            break;
        case FW_VALUE_OTHER:
            fw_text_add(out, ": ");
            break;
        }
    }
    fw_text_add(out, "'");
}

static void zsh(const fw_cli_command *command, size_t n, fw_text *out) {
    fw_text_add(out,
                "#compdef flexwright\n# generated from the tables of the program, do not edit\n"
                "_flexwright_flows() {\n    compadd -- $(flexwright doctor 2>/dev/null | " FLOWS
                ")\n}\n"
                "_flexwright() {\n    local -a commands\n    commands=(\n");
    for (size_t i = 0; i < n; i++) {
        fw_text_printf(out, "        '%s:", command[i].name);
        sentence(out, command[i].summary);
        fw_text_add(out, "'\n");
    }
    fw_text_add(out, "    )\n    if (( CURRENT == 2 )); then\n        _describe command commands\n"
                     "        return\n    fi\n    case $words[2] in\n");
    for (size_t i = 0; i < n; i++) {
        const fw_cli_option_row *row;
        fw_text_printf(out, "        %s) shift words; (( CURRENT-- )); _arguments",
                       command[i].name);
        for (size_t k = 0; (row = option_at(&command[i], &k)) != NULL;)
            zsh_option(row, out);
        if (command[i].argument)
            fw_text_printf(out, " \\\n            '1:%s:_files%s'",
                           takes_device(&command[i]) ? "device" : "argument",
                           takes_device(&command[i]) ? " -g \"*.xml\"" : "");
        fw_text_add(out, " ;;\n");
    }
    fw_text_add(out, "    esac\n}\n_flexwright \"$@\"\n");
}

/* ---- fish ---- */

static void fish(const fw_cli_command *command, size_t n, fw_text *out) {
    fw_text_add(out,
                "# fish completion of flexwright; generated from its tables, do not edit\n"
                "complete -c flexwright -n __fish_use_subcommand -l help -d 'what there is'\n"
                "complete -c flexwright -n __fish_use_subcommand -l version -d 'its version'\n");
    for (size_t i = 0; i < n; i++) {
        const fw_cli_option_row *row;
        fw_text_printf(out, "complete -c flexwright -f -n __fish_use_subcommand -a %s -d '",
                       command[i].name);
        sentence(out, command[i].summary);
        fw_text_add(out, "'\n");
        for (size_t k = 0; (row = option_at(&command[i], &k)) != NULL;) {
            fw_cli_value kind;
            const char *values = fw_cli_option_values(row, &kind);
            fw_text_printf(out, "complete -c flexwright -n '__fish_seen_subcommand_from %s' -l %s",
                           command[i].name, row->name);
            if (row->letter) fw_text_printf(out, " -s %c", row->letter);
            if (kind == FW_VALUE_WORDS) fw_text_printf(out, " -x -a '%s'", values);
            if (kind == FW_VALUE_FILE) fw_text_add(out, " -r -F");
            if (kind == FW_VALUE_DIRECTORY)
                fw_text_add(out, " -x -a '(__fish_complete_directories)'");
            if (kind == FW_VALUE_FLOW)
                fw_text_add(out, " -x -a '(flexwright doctor 2>/dev/null | " FLOWS ")'");
            if (kind == FW_VALUE_OTHER && row->argument) fw_text_add(out, " -x");
            fw_text_add(out, " -d '");
            sentence(out, row->help);
            fw_text_add(out, "'\n");
        }
    }
}

void fw_cli_completion(fw_cli_shell shell, fw_text *out) {
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    switch (shell) {
    case FW_SHELL_BASH:
        bash(command, n, out);
        break;
    case FW_SHELL_ZSH:
        zsh(command, n, out);
        break;
    case FW_SHELL_FISH:
        fish(command, n, out);
        break;
    }
}
