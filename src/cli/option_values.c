/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands behind an option: the names that tables of other rooms know, in the words of a command
   line, and the values that options of masks, study and log take. */
#include "cli/cli.h"
#include "mask/mask.h"
#include "plan/plan.h"
#include "recipe/asrun.h"
#include "schedule/schedule.h"
#include <math.h>
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

/* ---- what is said of a wrong value ---- */

const char *fw_cli_needs(const char *(*names)(void)) {
    static char text[640];
    snprintf(text, sizeof text, "needs %s", names());
    return text;
}

/* the next of the names that "needs A, B (why) or C" lists; what is in brackets or behind ';' is none */
static const char *next_name(const char *at, char *name, size_t room) {
    int depth = 0;
    for (bool begins = true; *at && *at != ';'; at++) {
        if (*at == '(') depth++;
        if (*at == ')') depth--;
        const size_t n = strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789-");
        if (depth == 0 && begins && n >= 3 && n < room) {
            memcpy(name, at, n), name[n] = '\0';
            return at + n;
        }
        begins = *at == ' ' && (at[-1] == ',' || (at[-1] == 'r' && at[-2] == 'o' && at[-3] == ' '));
        if (n > 0) at += n - 1;
    }
    return NULL;
}

const char *fw_cli_meant(const char *value, const char *needs) {
    enum { NAMES = 24, NAME = 40 };
    static char text[NAME + 24], name[NAMES][NAME];
    const char *list[NAMES], *at = needs;
    const size_t lead = strlen("needs ");
    size_t n = 0;
    if (strncmp(needs, "needs ", lead) != 0) return "";
    for (at += lead; n < NAMES && (at = next_name(at, name[n], NAME)) != NULL; n++)
        list[n] = name[n];
    char word[NAME];
    for (const char *v = value;;
         v++) { /* of several with commas between the first that is none of them */
        const size_t length = strcspn(v, ",");
        if (length >= NAME) return "";
        memcpy(word, v, length), word[length] = '\0';
        bool known = false;
        for (size_t i = 0; i < n; i++)
            known = known || strcmp(word, list[i]) == 0;
        v += length;
        if (known && *v) continue;
        const char *near = known ? NULL : fw_did_you_mean(word, list, n);
        if (!near) return "";
        snprintf(text, sizeof text, "; did you mean %s?", near);
        return text;
    }
}

int fw_cli_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    char said[4096];
    vsnprintf(said, sizeof said, format, arguments);
    va_end(arguments);
    fw_arena *arena = fw_arena_new(0);
    const char *shown = arena ? fw_text_shown(arena, said, strlen(said)) : NULL;
    fprintf(stderr, "flexwright: error: %s [FW-D230]\n", shown ? shown : "out of memory");
    fw_arena_free(arena);
    return fw_status_exit(FW_USAGE);
}

/* ---- options of masks ---- */

const char *fw_cli_take_tolerance(fw_cli_options *o, const char *v) {
    double nm;
    if (!fw_number_parse(v, strlen(v), &nm) || !(nm >= 0.36 && nm <= 1000.0))
        return "needs nanometres from 0.36 (below, rounding to the 1 nm grid would bend arcs the "
               "wrong way) to 1000, both included";
    o->design.mask_tolerance_m = nm * 1e-9;
    return NULL;
}

const char *fw_cli_take_mask_format(fw_cli_options *o, const char *v) {
    unsigned set;
    o->design.mask_formats = v;
    return fw_mask_formats(v, &set) ? NULL : fw_cli_needs(fw_cli_mask_format_names);
}

const char *fw_cli_take_mask_flatten(fw_cli_options *o, const char *v) {
    fw_geometry_flattening kind;
    o->design.mask_flatten = v;
    return *v && fw_mask_flattening_named(v, &kind) ? NULL : "needs inside or equal-area";
}

const char *fw_cli_take_gds(fw_cli_options *o, const char *v) {
    o->gds = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_layers(fw_cli_options *o, const char *v) {
    o->design.layers = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_mask_vertices(fw_cli_options *o, const char *v) {
    static const char *const word[] = {"199", "4094", "8190"};
    static const int32_t most[] = {199, 4094, 8190};
    for (int i = 0; i < 3; i++)
        if (strcmp(v, word[i]) == 0) {
            o->design.mask_vertices = most[i];
            return NULL;
        }
    return "needs 199, 4094 or 8190";
}

/* ---- options of study ---- */

const char *fw_cli_take_study(fw_cli_options *o, const char *v) {
    o->study = v;
    return *v ? NULL : "needs the name of a study";
}

const char *fw_cli_take_jobs(fw_cli_options *o, const char *v) {
    double n;
    if (!fw_number_parse(v, strlen(v), &n) || n != floor(n) || n < 1 || n > 256)
        return "is not a whole number from 1 to 256";
    o->jobs = (int)n;
    return NULL;
}

const char *fw_cli_take_shard(fw_cli_options *o, const char *v) {
    size_t n = strcspn(v, "/");
    double shard, shards;
    bool read = v[n] == '/' && fw_number_parse(v, n, &shard) &&
                fw_number_parse(v + n + 1, strlen(v + n + 1), &shards);
    if (!read || shard != floor(shard) || shards != floor(shards) || shards < 1 ||
        shards > 100000 || shard < 1 || shard > shards)
        return "is not I/N with whole numbers from 1 to 100000, I at most N";
    o->shard = (int)shard, o->shards = (int)shards;
    return NULL;
}

const char *fw_cli_take_resume(fw_cli_options *o, const char *v) {
    (void)v;
    o->resume = true;
    return NULL;
}

const char *fw_cli_take_plan_only(fw_cli_options *o, const char *v) {
    (void)v;
    o->plan_only = true;
    return NULL;
}

const char *fw_cli_take_tasks(fw_cli_options *o, const char *v) {
    double n;
    if (!fw_number_parse(v, strlen(v), &n) || n != floor(n) || !(n >= 1 && n <= 1000))
        return "needs a whole number between 1 and 1000, the most tasks of an array where the "
               "cluster's MaxArraySize is not changed";
    o->tasks = (int)n;
    return NULL;
}

const char *fw_cli_take_no_submit(fw_cli_options *o, const char *v) {
    (void)v;
    o->no_submit = true;
    return NULL;
}

const char *fw_cli_take_sbatch(fw_cli_options *o, const char *v) {
    if (o->nsbatch == FW_MOST_SETS) return "is given more than 64 times";
    o->sbatch[o->nsbatch++] = v;
    return v[0] == '-' ? NULL : "needs options of sbatch, like \"--partition=long --time=60\"";
}

/* ---- options of log ---- */

const char *fw_cli_take_run(fw_cli_options *o, const char *v) {
    o->run = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_entry(fw_cli_options *o, const char *v) {
    o->entry = v;
    return *v ? NULL : "needs the words of an entry, see flexwright log --help";
}

const char *fw_cli_take_entries(fw_cli_options *o, const char *v) {
    o->entries = v;
    return *v ? NULL : "needs the name of a file";
}

const char *fw_cli_take_lot(fw_cli_options *o, const char *v) {
    o->lot = v;
    if (!fw_text_is_line(v)) return "has characters that cannot stand in a line";
    return *v && strlen(v) <= 100 ? NULL : "needs 1 to 100 characters";
}

const char *fw_cli_take_zone(fw_cli_options *o, const char *v) {
    double utc_s[2];
    o->zone = v;
    return fw_schedule_zone_times(v, 0.0, utc_s) >= 0
               ? NULL
               : "needs UTC, UTC+01:00, or a rule as POSIX writes it: CET-1CEST,M3.5.0,M10.5.0/3 "
                 "(the last line of its file in /usr/share/zoneinfo)";
}

const char *fw_cli_take_wafer_ids(fw_cli_options *o, const char *v) {
    fw_arena *arena = fw_arena_new(0);
    const char *wrong = "could not be looked at: out of memory";
    o->wafer_ids = v;
    if (arena) (void)fw_recipe_asrun_wafers(arena, v, &wrong);
    fw_arena_free(arena);
    return wrong;
}

const char *fw_cli_take_without(fw_cli_options *o, const char *v) {
    o->without = v;
    return *v ? NULL : "needs ids of wafers with commas between";
}

const char *fw_cli_take_all_runs(fw_cli_options *o, const char *v) {
    (void)v;
    o->all_runs = true;
    return NULL;
}

const char *fw_cli_take_wafer(fw_cli_options *o, const char *v) {
    o->wafer = v;
    return *v ? NULL : "needs the id of a wafer";
}

const char *fw_cli_take_instrument(fw_cli_options *o, const char *v) {
    o->instrument = v;
    return *v ? NULL : "needs the name of an instrument";
}

const char *fw_cli_take_report(fw_cli_options *o, const char *v) {
    o->report = v;
    return *v ? NULL : "needs the name of a file";
}

static const char *logged(fw_cli_options *o, const char *before, const char *v) {
    if (!*v || strchr(v, ';')) return "needs words without a semicolon";
    if (o->nlogged == FW_MOST_SETS) return "is given more than 64 times";
    o->logged[o->nlogged].before = before;
    o->logged[o->nlogged++].words = v;
    return NULL;
}

const char *fw_cli_take_site(fw_cli_options *o, const char *v) {
    return strchr(v, '=') ? logged(o, "", v)
                          : "needs MEASURE=VALUES, like \"thickness=9.1 9.0 9.2 9.1 9.1 um\"";
}

const char *fw_cli_take_setting(fw_cli_options *o, const char *v) {
    return strchr(v, '=') ? logged(o, "set ", v) : "needs NAME=VALUE, like \"power=251 W\"";
}

const char *fw_cli_take_coupon(fw_cli_options *o, const char *v) {
    return logged(o, "coupon=", v);
}
