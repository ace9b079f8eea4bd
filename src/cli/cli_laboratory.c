/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command of the laboratory that keeps what was done in a log. */
#include "base/output.h"
#include "base/text.h"
#include "cli/cli.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "process/calibrate.h"
#include "recipe/asrun.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- the head of a log, beside it ---- */

static const size_t LARGEST_LOG = 16u << 20;

static fw_status head_name(fw_arena *arena, const char *file, const char **name) {
    FW_NEED(*name = fw_arena_printf(arena, "%s.head", file));
    return FW_OK;
}

/* The log against its head, there since the log has begun. One that says that a head is kept is refused without: the next entry would write a new head,
   and then nothing would show any more that lines were removed. Of one of before there were heads only the beginning can be
   told to be whole, which is said also to those who want no warnings (-q). */
fw_status fw_cli_check_head(fw_arena *arena, fw_diags *diags, const char *file, bool begun,
                            const fw_recipe_asrun *run) {
    const char *name;
    char *text;
    size_t n;
    FW_TRY(head_name(arena, file, &name));
    if (access(name, F_OK) != 0) {
        if (begun && run->headed)
            return fw_diag_error(
                diags, 280, (fw_place){file, 1, 1},
                "there is no %s, which is kept beside this log: without it nothing "
                "shows whether lines were removed at its end. Put it back there "
                "(the two are copied together), or keep the log as it is and begin "
                "a new one",
                name);
        if (run->nentry > 0)
            fw_diag_unreliable(
                diags, 283, (fw_place){file, 1, 1},
                "there is no %s: whether lines were removed at the end of the log cannot "
                "be told",
                name);
        return FW_OK;
    }
    FW_TRY(fw_input_read(arena, name, LARGEST_LOG, diags, &text, &n));
    return fw_recipe_asrun_check_head(run, name, text, n, diags);
}

/* ---- the as-run log ---- */

static bool adds(const fw_cli_options *o) {
    return o->entry || o->entries;
}

/* the one flow that the log is about */
static fw_plan_flow *flow_of(fw_plan *plan) {
    fw_plan_flow *found = NULL;
    for (int i = 0; i < plan->nflow; i++) {
        if (!plan->flow[i].flow) continue;
        if (found) return NULL;
        found = &plan->flow[i];
    }
    return found;
}

/* of recipes/FLOW.json, as the manifest has it */
static fw_status hash_of(fw_plan *plan, const fw_plan_flow *pf, char hash[65]) {
    fw_text text = fw_text_new(plan->arena);
    fw_recipe_header header = fw_plan_recipe_header(plan, pf);
    FW_TRY(fw_recipe_write_json(pf->flow, &header, &text));
    fw_sha256(text.data, text.length, hash);
    return FW_OK;
}

static fw_status print_log(fw_plan *plan, const fw_process_flow *flow, const fw_recipe_asrun *run,
                           bool json) {
    fw_text text = fw_text_new(plan->arena);
    FW_TRY(json ? fw_recipe_asrun_write_json(flow, run, &text)
                : fw_recipe_asrun_write_text(flow, run, &text));
    fwrite(text.data, 1, text.length, stdout);
    return FW_OK;
}

/* --report FILE: an HTML page; with - it has standard output for itself */
static fw_status write_report(fw_plan *plan, const fw_process_flow *flow,
                              const fw_recipe_asrun *run, const fw_cli_options *options) {
    fw_text page = fw_text_new(plan->arena);
    FW_TRY(fw_recipe_asrun_write_html(flow, run, &page));
    return fw_output_single(plan->arena, options->report, page.data, page.length, &plan->diags);
}

static fw_status read_log(fw_plan *plan, const fw_plan_flow *pf, const char *hash,
                          const fw_cli_options *options) {
    char *text;
    size_t n;
    fw_recipe_asrun run = {.plan = hash};
    if (!options->run) return print_log(plan, pf->flow, &run, options->json);
    FW_TRY(fw_input_read(plan->arena, options->run, LARGEST_LOG, &plan->diags, &text, &n));
    FW_TRY(fw_recipe_asrun_read(plan->arena, pf->flow, hash, options->run, text, n, &plan->diags,
                                &run));
    FW_TRY(fw_cli_check_head(plan->arena, &plan->diags, options->run, true, &run));
    if (options->report) FW_TRY(write_report(plan, pf->flow, &run, options));
    if (options->report && strcmp(options->report, "-") == 0) return FW_OK;
    return print_log(plan, pf->flow, &run, options->json);
}

/* the entry with what the other options say of it */
static fw_status entry_words(fw_arena *arena, const fw_cli_options *o, const char **words) {
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, o->entry);
    if (o->wafer) fw_text_printf(&text, "; wafer=%s", o->wafer);
    if (o->instrument) fw_text_printf(&text, "; instrument=%s", o->instrument);
    for (int i = 0; i < o->nlogged; i++)
        fw_text_printf(&text, "; %s%s", o->logged[i].before, o->logged[i].words);
    FW_TRY(fw_text_end(&text));
    *words = text.data;
    return FW_OK;
}

typedef struct entries { /* what is added at once */
    const char **words;
    fw_place *place;
    int n;
} entries;

static fw_status add_words(fw_arena *arena, entries *list, const char *words, fw_place place) {
    size_t n = (size_t)list->n;
    FW_NEED(list->words = fw_arena_grow(arena, list->words, n, n + 1, sizeof *list->words));
    FW_NEED(list->place = fw_arena_grow(arena, list->place, n, n + 1, sizeof *list->place));
    list->words[list->n] = words;
    list->place[list->n++] = place;
    return FW_OK;
}

/* where an entry says of which wafer it is; 0: nowhere. *n: how long that is */
static size_t wafer_in(const char *words, size_t *n) {
    static const char key[] = "wafer=";
    for (const char *at = words; (at = strstr(at, key)); at++) {
        const char *before = at;
        while (before > words && (before[-1] == ' ' || before[-1] == '\t'))
            before--;
        if (before > words && before[-1] != ';') continue;
        const char *id = at + sizeof key - 1;
        id += strspn(id, " \t");
        *n = strcspn(id, "; \t\r");
        return (size_t)(id - words);
    }
    return 0;
}

static int index_of(const fw_recipe_asrun *run, const char *id, size_t n) {
    for (int i = 0; i < run->nwafer; i++)
        if (strlen(run->wafer[i]) == n && memcmp(run->wafer[i], id, n) == 0) return i;
    return -1;
}

/* "2-4": numbers of wafers, or "W2-W4": names of two, in the order of the lot (*named: from and to are places in it). What
   is the name of a wafer itself is that wafer */
static bool is_range(const fw_recipe_asrun *run, const char *id, size_t n, int *from, int *to,
                     bool *named) {
    int used = 0;
    *named = true;
    if (index_of(run, id, n) >= 0) return false;
    for (size_t k = 1; k + 1 < n; k++) {
        if (id[k] != '-') continue;
        *from = index_of(run, id, k);
        *to = index_of(run, id + k + 1, n - k - 1);
        if (*from >= 0 && *from < *to) return true;
    }
    *named = false;
    if (sscanf(id, "%3d-%3d%n", from, to, &used) != 2) return false;
    return (size_t)used == n && *from > 0 && *from < *to && *to <= FW_RECIPE_WAFERS;
}

/* A load: "1-4", "1,2,5-6", as the schedule of the sheet has it, is an entry of each of its wafers, alike. What was
   measured at coupons is of one. */
static fw_status add_load(fw_plan *plan, const fw_recipe_asrun *run, entries *list,
                          const char *words, fw_place place, bool measured) {
    size_t n = 0;
    const size_t at = wafer_in(words, &n);
    const char *id = words + at, *end = id + n;
    int from, to;
    bool named;
    if (!at || (!memchr(id, ',', n) && !is_range(run, id, n, &from, &to, &named)))
        return add_words(plan->arena, list, words, place);
    if (measured || strstr(words, "coupon="))
        return fw_diag_error(&plan->diags, 282, place,
                             "an entry of several wafers (%.*s) has values that were measured at "
                             "sites or coupons of one: add these with an entry of each wafer",
                             (int)n, id);
    for (const char *part = id; part < end;) {
        const char *comma = memchr(part, ',', (size_t)(end - part));
        const size_t length = (size_t)((comma ? comma : end) - part);
        const bool range = is_range(run, part, length, &from, &to, &named);
        for (int i = range ? from : 0; i <= (range ? to : 0); i++) {
            const char *one = range && named ? run->wafer[i]
                              : range        ? fw_arena_printf(plan->arena, "%d", i)
                                             : fw_arena_strndup(plan->arena, part, length);
            FW_NEED(one);
            FW_NEED(one = fw_arena_printf(plan->arena, "%.*s%s%s", (int)at, words, one, end));
            FW_TRY(add_words(plan->arena, list, one, place));
        }
        part += length + 1;
    }
    return FW_OK;
}

/* a line for each, blank ones and remarks left out */
static fw_status entries_of_file(fw_plan *plan, const char *file, const fw_recipe_asrun *run,
                                 entries *list) {
    char *text;
    size_t n;
    FW_TRY(fw_input_read(plan->arena, file, LARGEST_LOG, &plan->diags, &text, &n));
    if (memchr(text, '\0', n))
        return fw_diag_error(&plan->diags, 282, (fw_place){file, 1, 1},
                             "entries are lines of text, and this file holds a zero byte");
    int number = 1;
    for (char *line = text; *line; number++) {
        size_t length = strcspn(line, "\n"), begins = strspn(line, " \t\r");
        char *next = line + length + (line[length] == '\n');
        if (length > 0 && line[length - 1] == '\r') length--;
        line[length] = '\0';
        if (begins < length && line[begins] != '#')
            FW_TRY(add_load(plan, run, list, line + begins,
                            (fw_place){file, number, (int)begins + 1}, false));
        line = next;
    }
    return list->n ? FW_OK
                   : fw_diag_error(&plan->diags, 282, (fw_place){file, 1, 1},
                                   "the file holds no entry");
}

static fw_status entries_of(fw_plan *plan, const fw_cli_options *options,
                            const fw_recipe_asrun *run, entries *list) {
    const char *words;
    bool measured = false;
    if (options->entries) return entries_of_file(plan, options->entries, run, list);
    FW_TRY(entry_words(plan->arena, options, &words));
    for (int i = 0; i < options->nlogged; i++)
        measured = measured || strncmp(options->logged[i].before, "set", 3) != 0;
    return add_load(plan, run, list, words, (fw_place){"entry", 1, 1}, measured);
}

/* the first line of a log that begins; "" where it has begun */
static fw_status first_line(fw_plan *plan, const fw_plan_flow *pf, const char *hash, bool begun,
                            const fw_cli_options *options, const char **first) {
    const char *wafers = NULL, *wrong;
    *first = "";
    if (begun && options->wafer_ids)
        return fw_diag_error(&plan->diags, 282, (fw_place){options->run, 1, 1},
                             "the wafers of a lot are stated where its log begins, and this one "
                             "has begun");
    if (begun && options->zone)
        return fw_diag_error(&plan->diags, 282, (fw_place){options->run, 1, 1},
                             "the zone of a log's clock is stated where it begins, and this one "
                             "has begun; write behind each time how far it is ahead of UTC: "
                             "start=2026-11-20T10:00+01:00");
    if (begun) return FW_OK;
    if (options->wafer_ids)
        FW_NEED(wafers = fw_recipe_asrun_wafers(plan->arena, options->wafer_ids, &wrong));
    return fw_recipe_asrun_begin(plan->arena, pf->flow, hash, options->lot, wafers, options->zone,
                                 first);
}

static bool said_before(const fw_diags *diags, size_t first, size_t n, const fw_diag *said,
                        fw_place place) {
    for (size_t i = first; i < n; i++) {
        const fw_diag *old = diags->item + i;
        if (old->severity == said->severity && old->place.line == place.line &&
            old->place.file == place.file && strcmp(old->message, said->message) == 0)
            return true;
    }
    return false;
}

/* what is said of an entry of several wafers is said of each of them, and is told once */
static void tell_once(fw_diags *diags, size_t before, size_t first, fw_place place) {
    size_t kept = before;
    for (size_t i = before; i < diags->count; i++) {
        const fw_diag said = diags->item[i];
        if (!said_before(diags, first, before, &said, place)) {
            diags->item[kept++] = said;
            continue;
        }
        diags->errors -= said.severity == FW_ERROR;
        diags->unreliable -= said.unreliable;
    }
    diags->count = kept;
}

/* What is told of an entry is a finding, which no line takes back and somebody must look at before the next step: it is told also
   to those who want no messages (-q). Test: test_manners.py, Log */
static void told_to_all(fw_diags *diags, size_t first) {
    for (size_t i = first; i < diags->count; i++) {
        fw_diag *said = &diags->item[i];
        if (said->severity != FW_WARNING || said->unreliable) continue;
        said->unreliable = true;
        diags->unreliable++;
    }
}

/* the one line that says that the lot goes on by another plan */
static fw_status replan(fw_plan *plan, const fw_plan_flow *pf, const char *hash,
                        const fw_cli_options *options, fw_text *added, fw_recipe_asrun *run) {
    const char *words, *line;
    FW_TRY(entry_words(plan->arena, options, &words));
    FW_TRY(fw_recipe_asrun_add_plan(plan->arena, run, hash, words, (fw_place){"entry", 1, 1},
                                    &plan->diags, &line));
    fw_text_add(added, line);
    FW_NEED(run->link = fw_arena_grow(plan->arena, run->link, (size_t)run->nline,
                                      (size_t)run->nline + 1, sizeof *run->link));
    FW_NEED(run->replan = fw_arena_grow(plan->arena, run->replan, (size_t)run->nreplan,
                                        (size_t)run->nreplan + 1, sizeof *run->replan));
    FW_TRY(fw_recipe_asrun_read_next(plan->arena, pf->flow, options->run, line, &plan->diags, run));
    return fw_text_end(added);
}

/* All lines behind what the log holds; each is read back behind those before it, as the next command would. The log after
   them is in *run. */
static fw_status compose(const fw_append *file, fw_plan *plan, const fw_plan_flow *pf,
                         const char *hash, const fw_cli_options *options, fw_text *added,
                         fw_recipe_asrun *run) {
    const bool begun = file->n > 0;
    fw_text whole = fw_text_new(plan->arena);
    const char *line;
    entries list = {0};
    FW_TRY(first_line(plan, pf, hash, begun, options, &line));
    fw_text_bytes(&whole, file->text, file->n);
    fw_text_add(&whole, line);
    fw_text_add(added, line);
    FW_TRY(fw_text_end(&whole));
    const bool replans = options->entry && fw_recipe_asrun_is_plan(options->entry);
    FW_TRY((replans ? fw_recipe_asrun_read_former : fw_recipe_asrun_read)(
        plan->arena, pf->flow, hash, options->run, whole.data, whole.length, &plan->diags, run));
    FW_TRY(fw_cli_check_head(plan->arena, &plan->diags, options->run, begun, run));
    run->table = pf->table;
    if (replans) return replan(plan, pf, hash, options, added, run);
    FW_TRY(entries_of(plan, options, run, &list));
    FW_NEED(run->entry = fw_arena_grow(plan->arena, run->entry, (size_t)run->nentry,
                                       (size_t)(run->nentry + list.n), sizeof *run->entry));
    FW_NEED(run->link = fw_arena_grow(plan->arena, run->link, (size_t)run->nline,
                                      (size_t)(run->nline + list.n), sizeof *run->link));
    fw_status wrong = FW_OK; /* every mistake of a list is told, and nothing of it is added */
    const size_t first = plan->diags.count;
    for (int i = 0; i < list.n; i++) {
        const size_t before = plan->diags.count;
        fw_status status = fw_recipe_asrun_add(plan->arena, pf->flow, run, list.words[i],
                                               list.place[i], options->now_s, &plan->diags, &line);
        tell_once(&plan->diags, before, first, list.place[i]);
        if (status != FW_OK && status != FW_INPUT) return status;
        if (status != FW_OK) wrong = status;
        if (status != FW_OK) continue;
        fw_text_add(added, line);
        FW_TRY(fw_recipe_asrun_read_next(plan->arena, pf->flow, options->run, line, &plan->diags,
                                         run));
    }
    FW_TRY(wrong);
    /* once all are there: wafers of one load share its time */
    for (int i = 0; i < list.n; i++) {
        const size_t before = plan->diags.count;
        FW_TRY(fw_recipe_asrun_ask_time(plan->arena, run, &run->entry[run->nentry - list.n + i],
                                        list.place[i], &plan->diags));
        tell_once(&plan->diags, before, first, list.place[i]);
    }
    told_to_all(&plan->diags, first);
    return fw_text_end(added);
}

static fw_status write_head(fw_plan *plan, const char *log, int nentry, const char *chain) {
    const char *head, *name;
    FW_TRY(fw_recipe_asrun_head(plan->arena, nentry, chain, &head));
    FW_TRY(head_name(plan->arena, log, &name));
    return fw_output_single(plan->arena, name, head, strlen(head), &plan->diags);
}

/* lines behind a log that has a head, and then the head of all */
static fw_status write_behind(fw_append *file, fw_plan *plan, const fw_text *added,
                              const fw_recipe_asrun *run) {
    const size_t before = file->n;
    FW_TRY(fw_append_text(file, added->data, added->length));
    fw_status status = write_head(plan, file->path, run->nline, run->chain);
    if (status != FW_OK)
        fw_append_take_back(file, before); /* else it would be added a second time */
    return status;
}

/* the file is locked from here to the end, so that two entries never have one line before them */
static fw_status add_to(fw_append *file, fw_plan *plan, const fw_plan_flow *pf, const char *hash,
                        const fw_cli_options *options) {
    fw_recipe_asrun run = {0};
    fw_text added = fw_text_new(plan->arena);
    const bool begins = file->n == 0;
    const char *name;
    FW_TRY(compose(file, plan, pf, hash, options, &added, &run));
    FW_TRY(head_name(plan->arena, options->run, &name));
    if (begins) FW_TRY(write_head(plan, options->run, 0, run.begun));
    fw_status status = write_behind(file, plan, &added, &run);
    if (status != FW_OK && begins) unlink(name); /* there is no log */
    if (status == FW_OK && !options->quiet) printf("%s: entry %d\n", options->run, run.nline);
    return status;
}

static fw_status keep(fw_plan *plan, const fw_cli_options *options) {
    fw_plan_flow *pf = flow_of(plan);
    char hash[65];
    if (!pf)
        return fw_diag_error(&plan->diags, 230, (fw_place){0},
                             "a log is about one flow: name it with --flow");
    FW_TRY(hash_of(plan, pf, hash));
    if (!adds(options)) return read_log(plan, pf, hash, options);
    fw_append file;
    FW_TRY(fw_append_open(plan->arena, options->run, LARGEST_LOG, &plan->diags, &file));
    fw_status status = add_to(&file, plan, pf, hash, options);
    fw_append_close(&file);
    return status;
}

/* said before the design is judged, which may take a while */
static int readable(fw_plan *plan, const fw_cli_options *options) {
    char *text;
    size_t n;
    if (!options->run) return FW_STATUS_OK; /* what is to be logged, before a log has begun */
    return (int)fw_input_read(plan->arena, options->run, LARGEST_LOG, &plan->diags, &text, &n);
}

int fw_cli_command_log(fw_cli_options *options) {
    int exit_status;
    if (!options->run && (adds(options) || options->report))
        return fw_cli_usage("log needs --run FILE, the log");
    if (!options->entry && (options->wafer || options->instrument || options->nlogged > 0))
        return fw_cli_usage("--wafer, --instrument, --site, --setting and --coupon belong to an "
                            "--entry");
    if (options->entry && options->entries)
        return fw_cli_usage("--entry and --entries are two ways: use one of them");
    if (adds(options) && options->report)
        return fw_cli_usage("--report is of a log that is read: leave out the entries");
    options->design.advice = "none"; /* neither is in a recipe */
    options->design.measurements = "none";
    fw_design *design = fw_cli_session_open(options, &exit_status);
    if (!design) return exit_status;
    int status = adds(options) ? FW_STATUS_OK : readable(fw_plan_design_plan(design), options);
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    if (status == FW_STATUS_OK) status = fw_design_fabricate(design);
    fw_plan *plan = fw_plan_design_plan(design);
    if (status == FW_STATUS_OK && plan->verdict.decision == FW_REJECT)
        status = (int)fw_diag_error(&plan->diags, 281, (fw_place){0},
                                    "the design is rejected: there is no recipe to run");
    if (status == FW_STATUS_OK) status = (int)keep(plan, options);
    return fw_cli_session_close(design, options, status, 0);
}
