/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"
#include "base/json.h"
#include "recipe/asrun.h"
#include "recipe/recipe_words.h"
#include <math.h>
#include <string.h>

static const char first_words[] = "flexwright as-run 1";
static const char chain_word[] = "\tchain=";
enum { HASH = 64, LONGEST_WORDS = 4000 };

typedef struct reader {
    fw_arena *arena;
    const fw_process_flow *flow;
    fw_diags *diags;
    fw_place place;
} reader;

static void link_of(fw_arena *arena, const char *before, const char *words, size_t n,
                    char chain[65]) {
    const char *both = fw_arena_printf(arena, "%s\n%.*s", before, (int)n, words);
    if (both)
        fw_sha256(both, strlen(both), chain);
    else
        chain[0] = '\0';
}

static bool digits(const char *s, int n, int *value) {
    *value = 0;
    for (int i = 0; i < n; i++) {
        if (s[i] < '0' || s[i] > '9') return false;
        *value = 10 * *value + (s[i] - '0');
    }
    return true;
}

/* YYYY-MM-DDTHH:MM or with :SS behind */
static bool read_time(const char *s, double *time_s) {
    int hour, minute, second = 0;
    long day;
    size_t n = strlen(s);
    if ((n != 16 && n != 19) || !fw_schedule_date_parse(s, &day) || s[10] != 'T' || s[13] != ':')
        return false;
    if (!digits(s + 11, 2, &hour) || !digits(s + 14, 2, &minute)) return false;
    if (n == 19 && (s[16] != ':' || !digits(s + 17, 2, &second))) return false;
    if (hour > 23 || minute > 59 || second > 59) return false;
    *time_s = 86400.0 * (double)day + 3600.0 * hour + 60.0 * minute + second;
    return true;
}

static const fw_process_step *step_of(const reader *r, const char *id) {
    for (int i = 0; i < r->flow->nstep; i++)
        if (strcmp(r->flow->step[i].id, id) == 0) return &r->flow->step[i];
    const char *best = NULL;
    for (int i = 0, least = 3; i < r->flow->nstep; i++) {
        int d = fw_edit_distance(id, r->flow->step[i].id, 2);
        if (d < least) {
            least = d;
            best = r->flow->step[i].id;
        }
    }
    fw_diag_error(r->diags, 282, r->place, "flow %s has no step '%s'%s%s%s", r->flow->id, id,
                  best ? "; did you mean '" : "", best ? best : "", best ? "'?" : "");
    return NULL;
}

static fw_status read_measure(const reader *r, fw_recipe_asrun_entry *e, const char *name,
                              const char *value) {
    enum { MOST_NAMES = 40 };
    const char *known[MOST_NAMES] = {"start", "end", "by", "second", "tool", "bath", "note"};
    int n = 7;
    fw_recipe_measured m = {name, value, (double)NAN};
    bool of_step = false;
    for (int i = 0; i < e->step->naccept && n < MOST_NAMES; i++) {
        known[n++] = e->step->accept[i].measure;
        of_step = of_step || strcmp(e->step->accept[i].measure, name) == 0;
    }
    if (!of_step) {
        const char *meant = fw_did_you_mean(name, known, (size_t)n);
        return fw_diag_error(r->diags, 282, r->place, "step %s measures no '%s'%s%s%s", e->step->id,
                             name, meant ? "; did you mean '" : "", meant ? meant : "",
                             meant ? "'?" : ", see <accept> of its pack");
    }
    bool word = strcmp(value, "yes") == 0 || strcmp(value, "no") == 0;
    if (!word && !fw_number_parse(value, strlen(value), &m.number))
        return fw_diag_error(r->diags, 282, r->place,
                             "%s=%s: give a number in the unit of the run sheet, or yes or no",
                             name, value);
    e->measured[e->nmeasured++] = m;
    return FW_OK;
}

static fw_status read_word(const reader *r, fw_recipe_asrun_entry *e, const char *name,
                           const char *value) {
    const struct {
        const char *name;
        const char **text;
        double *time_s; /* NULL: a text */
    } field[] = {
        {"start", &e->start, &e->start_s}, {"end", &e->end, &e->end_s}, {"by", &e->by, NULL},
        {"second", &e->second, NULL},      {"tool", &e->tool, NULL},    {"bath", &e->bath, NULL},
        {"note", &e->note, NULL}};
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++) {
        if (strcmp(field[i].name, name) != 0) continue;
        if (*field[i].text)
            return fw_diag_error(r->diags, 282, r->place, "%s is given twice", name);
        *field[i].text = value;
        if (field[i].time_s && !read_time(value, field[i].time_s))
            return fw_diag_error(r->diags, 282, r->place,
                                 "%s=%s is not a time; write 2026-11-20T10:00, local time of the "
                                 "laboratory",
                                 name, value);
        return FW_OK;
    }
    return read_measure(r, e, name, value);
}

/* what no entry may lack */
static fw_status check_entry(const reader *r, const fw_recipe_asrun_entry *e) {
    const char *lacks = !e->start ? "start" : !e->end ? "end" : !e->by ? "by" : NULL;
    if (lacks)
        return fw_diag_error(r->diags, 282, r->place, "the entry of step %s lacks %s=", e->step->id,
                             lacks);
    if (e->end_s < e->start_s)
        return fw_diag_error(r->diags, 282, r->place, "step %s ends before it starts", e->step->id);
    if (e->step->second_signature && (!e->second || strcmp(e->second, e->by) == 0))
        return fw_diag_error(r->diags, 282, r->place,
                             "step %s is never done alone: add second= with the initials of the "
                             "other person",
                             e->step->id);
    return FW_OK;
}

/* cuts a copy of the words at `separator`; the first is the step, the others are name=value */
static fw_status read_entry(const reader *r, const char *words, size_t n, char separator,
                            fw_recipe_asrun_entry *e) {
    char *copy = fw_arena_strndup(r->arena, words, n);
    FW_NEED(copy);
    *e = (fw_recipe_asrun_entry){
        .start_s = (double)NAN, .end_s = (double)NAN, .line = r->place.line};
    size_t most = 1;
    for (const char *s = copy; *s; s++)
        most += *s == separator;
    FW_NEED(e->measured = fw_arena_array(r->arena, fw_recipe_measured, most));
    for (char *word = copy, *next; word; word = next) {
        char *end = strchr(word, separator);
        next = end ? end + 1 : NULL;
        if (end) *end = '\0';
        word += strspn(word, " ");
        for (size_t length = strlen(word); length > 0 && word[length - 1] == ' ';)
            word[--length] = '\0';
        if (!word[0]) continue;
        char *equal = strchr(word, '=');
        if (!e->step) {
            /* the step's id, alone or as step=ID */
            const char *id = equal && strncmp(word, "step=", 5) == 0 ? equal + 1 : word;
            if (!(e->step = step_of(r, id))) return FW_INPUT;
            continue;
        }
        if (!equal || equal == word || !equal[1])
            return fw_diag_error(r->diags, 282, r->place, "'%s' is not written as name=value",
                                 word);
        *equal = '\0';
        FW_TRY(read_word(r, e, word, equal + 1));
    }
    if (!e->step)
        return fw_diag_error(r->diags, 282, r->place,
                             "the entry names no step; add step= with its id");
    return check_entry(r, e);
}

/* ---- the log ---- */
static fw_status damaged(const reader *r, const char *why) {
    return fw_diag_error(r->diags, 280, r->place,
                         "the log was changed or damaged after it was written: %s. Keep the "
                         "file as it is, and begin a new log with a note about this",
                         why);
}

/* the words of a line without its chain, which must follow from `before` */
static fw_status unchain(const reader *r, const char *line, size_t n, char chain[65],
                         size_t *words) {
    size_t tail = sizeof chain_word - 1 + HASH;
    if (n <= tail || strncmp(line + n - tail, chain_word, sizeof chain_word - 1) != 0)
        return damaged(r, "a line does not end with its chain");
    char expected[65];
    *words = n - tail;
    link_of(r->arena, chain, line, *words, expected);
    if (strncmp(line + n - HASH, expected, HASH) != 0)
        return damaged(r, "this line, or one before it, was changed, removed or moved");
    memcpy(chain, expected, sizeof expected);
    return FW_OK;
}

/* value of name= in a line of tab-separated words; NULL when it is not there */
static const char *value_of(fw_arena *arena, const char *line, size_t n, const char *name) {
    const char *copy = fw_arena_strndup(arena, line, n);
    const char *key = fw_arena_printf(arena, "\t%s=", name);
    const char *at = copy && key ? strstr(copy, key) : NULL;
    if (!at) return NULL;
    at += strlen(key);
    return fw_arena_strndup(arena, at, strcspn(at, "\t"));
}

static fw_status read_first(const reader *r, const char *plan, const char *line, size_t n,
                            fw_recipe_asrun *run) {
    size_t words;
    if (n < sizeof first_words || strncmp(line, first_words, sizeof first_words - 1) != 0)
        return damaged(r, "it does not begin with 'flexwright as-run 1'");
    FW_TRY(unchain(r, line, n, run->chain, &words));
    const char *flow = value_of(r->arena, line, words, "flow");
    run->plan = value_of(r->arena, line, words, "plan");
    run->lot = value_of(r->arena, line, words, "lot");
    FW_NEED(flow && run->plan);
    if (strcmp(flow, r->flow->id) != 0)
        return fw_diag_error(r->diags, 281, r->place, "this is a log of flow %s, not of %s", flow,
                             r->flow->id);
    if (strcmp(run->plan, plan) != 0)
        return fw_diag_error(r->diags, 281, r->place,
                             "the log was begun for plan %.12s..., but this device and these packs "
                             "now give %.12s...: use the files of that plan, or begin a new log",
                             run->plan, plan);
    return FW_OK;
}

fw_status fw_recipe_asrun_read(fw_arena *arena, const fw_process_flow *flow,
                               const char *plan_sha256, const char *file, const char *text,
                               size_t n, fw_diags *diags, fw_recipe_asrun *run) {
    reader r = {arena, flow, diags, {file, 1, 1}};
    size_t lines = 1;
    *run = (fw_recipe_asrun){0};
    for (size_t i = 0; i < n; i++)
        lines += text[i] == '\n';
    FW_NEED(run->entry = fw_arena_array(arena, fw_recipe_asrun_entry, lines));
    if (n == 0 || text[n - 1] != '\n') return damaged(&r, "its last line is not complete");
    if (memchr(text, '\0', n)) return damaged(&r, "it holds a NUL byte");
    for (const char *line = text; line < text + n; r.place.line++) {
        size_t length = strcspn(line, "\n"), words;
        if (r.place.line == 1) {
            FW_TRY(read_first(&r, plan_sha256, line, length, run));
            memcpy(run->begun, run->chain, sizeof run->begun);
        } else {
            FW_TRY(unchain(&r, line, length, run->chain, &words));
            FW_TRY(read_entry(&r, line, words, '\t', &run->entry[run->nentry]));
            memcpy(run->entry[run->nentry++].chain, run->chain, sizeof run->chain);
        }
        line += length + 1;
    }
    return FW_OK;
}

static bool writable(const char *s) {
    for (; *s; s++)
        if ((unsigned char)*s < 0x20) return false;
    return true;
}

fw_status fw_recipe_asrun_begin(fw_arena *arena, const fw_process_flow *flow,
                                const char *plan_sha256, const char *lot, const char **line) {
    char chain[65];
    const char *words = fw_arena_printf(arena, "%s\tflow=%s\tplan=%s%s%s", first_words, flow->id,
                                        plan_sha256, lot ? "\tlot=" : "", lot ? lot : "");
    FW_NEED(words);
    link_of(arena, "", words, strlen(words), chain);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", words, chain_word, chain));
    return FW_OK;
}

/* what is odd, and may still be true */
static void ask(const reader *r, const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    int index = (int)(e->step - r->flow->step);
    const fw_recipe_asrun_entry *last = run->nentry > 0 ? &run->entry[run->nentry - 1] : NULL;
    bool before = index == 0;
    for (int i = 0; i < run->nentry && !before; i++)
        before = run->entry[i].step == e->step - 1;
    if (!before)
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s, which comes before it, is not in the log",
                        r->flow->step[index - 1].id);
    if (last && e->start_s < last->start_s)
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s starts before step %s, which was entered before it", e->step->id,
                        last->step->id);
    if (e->nmeasured < e->step->naccept)
        fw_diag_warning(r->diags, 283, r->place,
                        "the entry gives %d of the %d values that step %s measures", e->nmeasured,
                        e->step->naccept, e->step->id);
}

fw_status fw_recipe_asrun_add(fw_arena *arena, const fw_process_flow *flow,
                              const fw_recipe_asrun *run, const char *words, fw_diags *diags,
                              const char **line) {
    reader r = {arena, flow, diags, {"entry", 1, 1}};
    fw_recipe_asrun_entry e;
    char chain[65];
    size_t n = strlen(words);
    if (n > LONGEST_WORDS || !writable(words))
        return fw_diag_error(diags, 282, r.place,
                             "an entry has at most %d bytes and no tabs or line ends",
                             LONGEST_WORDS);
    FW_TRY(read_entry(&r, words, n, ';', &e));
    ask(&r, run, &e);
    fw_text out = fw_text_new(arena);
    fw_text_printf(&out, "step=%s\tstart=%s\tend=%s\tby=%s", e.step->id, e.start, e.end, e.by);
    const struct {
        const char *name, *value;
    } more[] = {{"second", e.second}, {"tool", e.tool}, {"bath", e.bath}, {"note", e.note}};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        if (more[i].value) fw_text_printf(&out, "\t%s=%s", more[i].name, more[i].value);
    for (int i = 0; i < e.nmeasured; i++)
        fw_text_printf(&out, "\t%s=%s", e.measured[i].measure, e.measured[i].value);
    FW_TRY(fw_text_end(&out));
    link_of(arena, run->chain, out.data, out.length, chain);
    FW_NEED(chain[0]);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", out.data, chain_word, chain));
    return FW_OK;
}

/* Planned against actual: durations against their windows, waiting times against their limits,
   measured values against what is accepted. */

/* the last entry of a step counts; NULL: none */
static const fw_recipe_asrun_entry *last_of(const fw_recipe_asrun *run, const fw_process_step *step,
                                            int *times) {
    const fw_recipe_asrun_entry *found = NULL;
    *times = 0;
    for (int i = 0; i < run->nentry; i++)
        if (run->entry[i].step == step) {
            found = &run->entry[i];
            ++*times;
        }
    return found;
}

static const char *in_time(const fw_process_time *planned, double actual_s) {
    if (!planned->computable) return "no plan";
    if (actual_s < planned->first_look_s) return "short";
    return actual_s > planned->stop_s ? "long" : "in window";
}

static const fw_process_accept *accept_of(const fw_process_step *step, const char *measure) {
    for (int i = 0; i < step->naccept; i++)
        if (strcmp(step->accept[i].measure, measure) == 0) return &step->accept[i];
    return NULL;
}

static bool accepted(const fw_process_accept *a, const fw_recipe_measured *m) {
    double low = -(double)INFINITY, high = (double)INFINITY;
    if (isnan(m->number)) return strcmp(m->value, "yes") == 0;
    if (a->low[0]) fw_number_parse(a->low, strlen(a->low), &low);
    if (a->high[0]) fw_number_parse(a->high, strlen(a->high), &high);
    return m->number >= low && m->number <= high;
}

/* waited from the end of the step that the lag names; NaN: that step is not in the log */
static double waited(const fw_process_flow *flow, const fw_recipe_asrun *run,
                     const fw_process_lag *lag, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < flow->nstep; i++) {
        int times;
        if (strcmp(flow->step[i].id, lag->from) != 0) continue;
        const fw_recipe_asrun_entry *from = last_of(run, &flow->step[i], &times);
        return from ? e->start_s - from->end_s : (double)NAN;
    }
    return (double)NAN;
}

static bool wait_is_fine(const fw_process_lag *lag, double wait_s) {
    return !(wait_s < lag->min_s) && !(wait_s > lag->max_s); /* NaN: no limit, or not known */
}

/* what is out of its limits in one entry */
static int deviations(const fw_process_flow *flow, const fw_recipe_asrun *run,
                      const fw_recipe_asrun_entry *e) {
    double actual = e->end_s - e->start_s;
    const char *judged = in_time(&e->step->time, actual);
    int n = strcmp(judged, "short") == 0 || strcmp(judged, "long") == 0;
    for (int i = 0; i < e->nmeasured; i++)
        n += !accepted(accept_of(e->step, e->measured[i].measure), &e->measured[i]);
    for (int i = 0; i < e->step->nlag; i++)
        n += !wait_is_fine(&e->step->lag[i], waited(flow, run, &e->step->lag[i], e));
    return n;
}

/* ---- text ---- */
static void put_cell(fw_text *out, double seconds, int width) {
    fw_text cell = fw_text_new(out->arena);
    if (isnan(seconds))
        fw_text_add(&cell, "-");
    else
        fw_schedule_put_duration(&cell, seconds);
    if (fw_text_end(&cell) != FW_OK) {
        out->failed = 1;
        return;
    }
    fw_text_printf(out, "%*s", width, cell.data);
}

static void details(const fw_process_flow *flow, const fw_recipe_asrun *run,
                    const fw_recipe_asrun_entry *e, fw_text *out) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        const fw_process_accept *a = accept_of(e->step, m->measure);
        bool fine = accepted(a, m), yes = isnan(m->number);
        fw_text_printf(out, "      %s = %s%s%s: %s", m->measure, m->value, yes ? "" : " ",
                       yes ? "" : a->unit, fine ? "accepted" : "OUT of ");
        if (!fine && yes)
            fw_text_add(out, "yes");
        else if (!fine)
            fw_text_printf(out, "%s to %s", a->low[0] ? a->low : "any",
                           a->high[0] ? a->high : "any");
        fw_text_add(out, "\n");
    }
    for (int i = 0; i < e->step->nlag; i++) {
        const fw_process_lag *l = &e->step->lag[i];
        double wait = waited(flow, run, l, e);
        if (isnan(wait) || wait_is_fine(l, wait)) continue;
        fw_text_printf(out, "      waited ");
        fw_schedule_put_duration(out, fmax(wait, 0.0));
        fw_text_printf(out, " since %s: OUT of ", l->from);
        fw_schedule_put_duration(out, isnan(l->min_s) ? 0.0 : l->min_s);
        fw_text_add(out, " to ");
        if (isnan(l->max_s))
            fw_text_add(out, "any");
        else
            fw_schedule_put_duration(out, l->max_s);
        fw_text_add(out, "\n");
    }
    if (e->note) fw_text_printf(out, "      note: %s\n", e->note);
}

typedef struct total {
    int logged, out, repeated;
    double planned_s, actual_s;
} total;

static total sum_up(const fw_process_flow *flow, const fw_recipe_asrun *run) {
    total t = {0};
    for (int i = 0; i < flow->nstep; i++) {
        int times;
        const fw_recipe_asrun_entry *e = last_of(run, &flow->step[i], &times);
        if (!e) continue;
        t.logged++;
        t.repeated += times - 1;
        t.out += deviations(flow, run, e);
        t.actual_s += e->end_s - e->start_s;
        if (flow->step[i].time.computable) t.planned_s += flow->step[i].booked_s;
    }
    return t;
}

fw_status fw_recipe_asrun_write_text(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out) {
    fw_text_printf(out, "as run: flow %s%s%s, plan %.12s\n\n", flow->id, run->lot ? ", lot " : "",
                   run->lot ? run->lot : "", run->plan);
    fw_text_printf(out, "%-5s %14s %14s %14s %14s  %-9s %s\n", "step", "planned", "first look",
                   "stop", "actual", "judged", "title");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        int times;
        const fw_recipe_asrun_entry *e = last_of(run, s, &times);
        const double cell[] = {
            s->time.computable ? s->booked_s : (double)NAN,
            s->time.computable ? s->time.first_look_s : (double)NAN,
            s->time.computable ? s->time.stop_s : (double)NAN,
            e ? e->end_s - e->start_s : (double)NAN,
        };
        fw_text_printf(out, "%-5s", s->id);
        for (int k = 0; k < 4; k++)
            put_cell(out, cell[k], 15);
        fw_text_printf(out, "  %-9s %s", e ? in_time(&s->time, cell[3]) : "open", s->title);
        if (times > 1) fw_text_printf(out, " (run %d times)", times);
        fw_text_add(out, "\n");
        if (e) details(flow, run, e, out);
    }
    total t = sum_up(flow, run);
    fw_text_printf(out, "\n%d of %d steps run, %d repeated, %d outside of their limits; planned ",
                   t.logged, flow->nstep, t.repeated, t.out);
    fw_schedule_put_duration(out, t.planned_s);
    fw_text_add(out, " for them, actual ");
    fw_schedule_put_duration(out, t.actual_s);
    fw_text_add(out, "\n");
    return fw_text_end(out);
}

/* ---- JSON ---- */
static void put_number(fw_json *out, const char *key, double value) {
    fw_json_number(out, key, value, FW_PLAIN_DIGITS);
}

/* what nobody wrote down is left out */
static void put_text(fw_json *out, const char *key, const char *value) {
    if (value) fw_json_text(out, key, value);
}

static void entry_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                       const fw_recipe_asrun_entry *e, fw_json *out) {
    put_text(out, "start", e->start);
    put_text(out, "end", e->end);
    put_number(out, "actual_s", e->end_s - e->start_s);
    put_text(out, "judged", in_time(&e->step->time, e->end_s - e->start_s));
    put_text(out, "by", e->by);
    put_text(out, "second", e->second);
    put_text(out, "tool", e->tool);
    put_text(out, "bath", e->bath);
    put_text(out, "note", e->note);
    fw_json_list(out, "measured");
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "measure", m->measure);
        if (isnan(m->number))
            put_text(out, "value", m->value);
        else
            put_number(out, "value", m->number);
        const fw_process_accept *a = accept_of(e->step, m->measure);
        put_text(out, "unit", a->unit);
        fw_json_truth(out, "accepted", accepted(a, m));
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "waited");
    for (int i = 0; i < e->step->nlag; i++) {
        const fw_process_lag *l = &e->step->lag[i];
        double wait = waited(flow, run, l, e);
        fw_json_object(out, NULL);
        fw_json_text(out, "from", l->from);
        put_number(out, "waited_s", wait);
        put_number(out, "min_s", l->min_s);
        put_number(out, "max_s", l->max_s);
        if (isnan(wait))
            fw_json_null(out, "accepted");
        else
            fw_json_truth(out, "accepted", wait_is_fine(l, wait));
        fw_json_end(out);
    }
    fw_json_end(out);
}

fw_status fw_recipe_asrun_write_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    put_text(out, "schema", "flexwright.as-run/1");
    put_text(out, "flow", flow->id);
    put_text(out, "lot", run->lot);
    put_text(out, "plan_sha256", run->plan);
    put_text(out, "chain", run->chain);
    fw_json_list(out, "steps");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        const fw_process_time *p = &s->time;
        int times;
        const fw_recipe_asrun_entry *e = last_of(run, s, &times);
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", s->id);
        put_number(out, "planned_s", p->computable ? p->nominal_s : (double)NAN);
        put_number(out, "first_look_s", p->computable ? p->first_look_s : (double)NAN);
        put_number(out, "stop_s", p->computable ? p->stop_s : (double)NAN);
        fw_json_whole(out, "times", times);
        if (e) entry_json(flow, run, e, out);
        fw_json_end(out);
    }
    total t = sum_up(flow, run);
    fw_json_end(out);
    fw_json_whole(out, "logged", t.logged);
    fw_json_whole(out, "repeated", t.repeated);
    fw_json_whole(out, "outside", t.out);
    put_number(out, "planned_s", t.planned_s);
    put_number(out, "actual_s", t.actual_s);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}
