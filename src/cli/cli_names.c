/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names that the tables of other rooms know, in the words of a command line, and what is said of a
   wrong one. */
#include "cli/options.h"
#include "mask/mask.h"
#include "plan/ladder.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct name_list {
    char text[600];
    size_t n;
} name_list;

static void add_words(name_list *list, const char *between, const char *name, const char *words) {
    if (list->n >= sizeof list->text) return;
    list->n += (size_t)snprintf(list->text + list->n, sizeof list->text - list->n, "%s%s%s%s%s",
                                list->n ? between : "", name, words ? " (" : "", words ? words : "",
                                words ? ")" : "");
}

const char *fw_cli_mask_format_names(void) {
    static name_list all;
    const fw_mask_format *f;
    all = (name_list){.n = 0};
    for (size_t i = 0; (f = fw_mask_format_at(i)) != NULL; i++)
        if (!f->beside) add_words(&all, ", ", f->name, NULL);
    add_words(&all, " ", "with commas between, or all; default", NULL);
    for (size_t i = 0, n = 0; (f = fw_mask_format_at(i)) != NULL; i++)
        if (f->usual && !f->beside) add_words(&all, n++ ? "," : " ", f->name, NULL);
    return all.text;
}

const char *fw_cli_hinge_model_names(void) {
    static name_list all;
    all = (name_list){.n = 0};
    const size_t count = fw_effects_hinge_model_count();
    for (size_t i = 0; i < count; i++)
        add_words(&all, i + 1 < count ? ", " : " or ",
                  fw_effects_hinge_model_text((fw_effects_hinge_model)i),
                  fw_effects_hinge_model_summary((fw_effects_hinge_model)i));
    return all.text;
}

const char *fw_cli_level_names(void) {
    static name_list all;
    size_t count;
    const fw_plan_ladder_level *level = fw_plan_ladder_levels(&count);
    all = (name_list){.n = 0};
    for (size_t i = 0; i < count; i++)
        add_words(&all, i + 1 < count ? ", " : " or ", level[i].name, NULL);
    return all.text;
}

const char *fw_cli_option_help(const fw_cli_option_row *row) {
    static const struct {
        const char *option, *(*names)(void);
    } named[] = {{"mask-format", fw_cli_mask_format_names},
                 {"hinge-model", fw_cli_hinge_model_names},
                 {"level", fw_cli_level_names}};
    static char text[1400];
    const char *mark = strstr(row->help, "{names}");
    size_t i = 0;
    if (!mark) return row->help;
    while (strcmp(named[i].option, row->name) != 0)
        i++;
    snprintf(text, sizeof text, "%.*s%s%s", (int)(mark - row->help), row->help, named[i].names(),
             mark + strlen("{names}"));
    return text;
}

int fw_cli_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("flexwright: error: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs(" [FW-D230]\n", stderr);
    va_end(arguments);
    return fw_status_exit(FW_USAGE);
}
