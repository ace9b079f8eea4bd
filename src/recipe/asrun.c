/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The as-run log as a text: its chain, its entries, and the head beside it. */
#include "base/text.h"
#include "process/process_law.h"
#include "recipe/asrun.h"
#include "recipe/asrun_parts.h"
#include "schedule/schedule.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- the head of a log ----
   How many entries the log has, and the chain of the last one. A chain alone shows nothing of lines that were taken off
   at the end; a head beside the log does, unless both were changed. It is written after the line, so that a log that
   was interrupted between the two has one entry more than its head says, and is whole; that of no entry is written before
   the first line, which says that a head is kept (head=kept): a log without its head is not whole. Logs of before that
   word say nothing, and may have none.
     flexwright-log-head TAB entries=12 TAB chain=...
   Test: test_asrun.c, heads. */

static const char first_word[] = "flexwright-log-head\tentries=";

fw_status fw_recipe_asrun_head(fw_arena *arena, int nentry, const char *chain, const char **line) {
    FW_NEED(*line = fw_arena_printf(arena, "%s%d\tchain=%s\n", first_word, nentry, chain));
    return FW_OK;
}

static fw_status torn(fw_diags *diags, fw_place place, const char *what) {
    return fw_diag_error(diags, 280, place, "the head of the log %s", what);
}

fw_status fw_recipe_asrun_check_head(const fw_recipe_asrun *run, const char *file, const char *text,
                                     size_t n, fw_diags *diags) {
    fw_place place = {file, 1, 1};
    int entries = -1, end = 0;
    char chain[65];
    if (n <= sizeof first_word || strncmp(text, first_word, sizeof first_word - 1) != 0 ||
        sscanf(text + sizeof first_word - 1, "%9d\tchain=%64[0-9a-f]\n%n", &entries, chain, &end) !=
            2 ||
        sizeof first_word - 1 + (size_t)end != n || entries < 0 || strlen(chain) != 64)
        return torn(diags, place,
                    "is damaged; restore it, or keep both as they are and begin a new log");
    if (entries > run->nline)
        return fw_diag_error(
            diags, 280, place,
            "the log has %d entries, but its head says %d: lines were removed at its "
            "end",
            run->nline, entries);
    if (entries == 0 && run->nline == 0) return FW_OK; /* of a beginning that was interrupted */
    const char *there = entries > 0 ? run->link[entries - 1] : run->begun;
    if (strcmp(there, chain) != 0)
        return torn(diags, place,
                    "is of other entries: lines were changed, or it is of another log");
    return FW_OK;
}

/* ---- lines and their chain ---- */

static const char first_words[] = "flexwright as-run 1";
static const char chain_word[] = "\tchain=";
enum { HASH = 64, LONGEST_WORDS = 16000 };

static void link_of(fw_arena *arena, const char *before, const char *words, size_t n,
                    char chain[65]) {
    const char *both = fw_arena_printf(arena, "%s\n%.*s", before, (int)n, words);
    if (both)
        fw_sha256(both, strlen(both), chain);
    else
        chain[0] = '\0';
}

/* ---- the log ---- */
static fw_status damaged(const fw_recipe_asrun_reader *r, const char *why) {
    return fw_diag_error(r->diags, 280, r->place,
                         "the log was changed or damaged after it was written: %s. Keep the "
                         "file as it is, and begin a new log with a note about this",
                         why);
}

/* the words of a line without its chain, which must follow from `before` */
static fw_status unchain(const fw_recipe_asrun_reader *r, const char *line, size_t n,
                         char chain[65], size_t *words) {
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
    return fw_text_shown(arena, at, strcspn(at, "\t")); /* whoever wrote it */
}

/* "1,2,3"; a log of before there were wafers has none */
static fw_status read_wafers(const fw_recipe_asrun_reader *r, const char *list,
                             fw_recipe_asrun *run) {
    if (!list) return FW_OK;
    FW_NEED(run->wafer = fw_arena_array(r->arena, const char *, FW_RECIPE_WAFERS));
    for (size_t n; *list && run->nwafer < FW_RECIPE_WAFERS; list += n + (list[n] == ',')) {
        n = strcspn(list, ",");
        FW_NEED(run->wafer[run->nwafer++] = fw_arena_strndup(r->arena, list, n));
    }
    return FW_OK;
}

static fw_status read_first(const fw_recipe_asrun_reader *r, const char *line, size_t n,
                            fw_recipe_asrun *run) {
    size_t words;
    if (!fw_recipe_asrun_is_log(line, n))
        return damaged(r, "it does not begin with 'flexwright as-run 1'");
    FW_TRY(unchain(r, line, n, run->chain, &words));
    if (!memmem(line, words, "\tflow=", 6) || !memmem(line, words, "\tplan=", 6))
        return damaged(r, "its first line lacks its flow or its plan");
    const char *flow = value_of(r->arena, line, words, "flow");
    run->plan = value_of(r->arena, line, words, "plan");
    run->lot = value_of(r->arena, line, words, "lot");
    run->zone = value_of(r->arena, line, words, "zone");
    FW_NEED(flow && run->plan);
    if (strcmp(flow, r->flow->id) != 0)
        return fw_diag_error(r->diags, 281, r->place, "this is a log of flow %s, not of %s", flow,
                             r->flow->id);
    FW_TRY(read_wafers(r, value_of(r->arena, line, words, "wafers"), run));
    const char *head = value_of(r->arena, line, words, "head");
    run->headed = head && strcmp(head, "kept") == 0;
    return FW_OK;
}

/* plan=HASH start= by= note=: from here on the lot follows another plan */
static fw_status read_replan(const fw_recipe_asrun_reader *r, const char *line, size_t n,
                             fw_recipe_asrun *run) {
    fw_recipe_replan *p = &run->replan[run->nreplan++];
    const char *whole = fw_arena_printf(r->arena, "\t%.*s", (int)n, line);
    FW_NEED(whole);
    *p = (fw_recipe_replan){.plan = value_of(r->arena, whole, n + 1, "plan"),
                            .start = value_of(r->arena, whole, n + 1, "start"),
                            .by = value_of(r->arena, whole, n + 1, "by"),
                            .note = value_of(r->arena, whole, n + 1, "note"),
                            .line = r->place.line};
    if (!p->plan || !p->start || !p->by)
        return damaged(r, "a line that names another plan lacks its time or its initials");
    run->plan = p->plan;
    return FW_OK;
}

/* a line behind the first one, into the next of run->entry. It is held against the plan where it is of that one */
static fw_status read_entry(fw_recipe_asrun_reader *r, const char *plan, const char *line,
                            size_t length, fw_recipe_asrun *run) {
    static const char replan[] = "plan=";
    size_t words = 0;
    FW_TRY(unchain(r, line, length, run->chain, &words));
    memcpy(run->link[run->nline++], run->chain, sizeof run->chain);
    if (words > sizeof replan && strncmp(line, replan, sizeof replan - 1) == 0)
        return read_replan(r, line, words, run);
    r->bound = plan && strcmp(run->plan, plan) == 0;
    r->former = plan && !r->bound;
    FW_TRY(fw_recipe_asrun_entry_read(r, line, words, '\t', &run->entry[run->nentry]));
    run->ahead_s = run->entry[run->nentry].ahead_s;
    memcpy(run->entry[run->nentry++].chain, run->chain, sizeof run->chain);
    return FW_OK;
}

fw_status fw_recipe_asrun_read_former(fw_arena *arena, const fw_process_flow *flow,
                                      const char *plan_sha256, const char *file, const char *text,
                                      size_t n, fw_diags *diags, fw_recipe_asrun *run) {
    fw_recipe_asrun_reader r = {
        .arena = arena, .flow = flow, .run = run, .diags = diags, .place = {file, 1, 1}};
    size_t lines = 1;
    *run = (fw_recipe_asrun){.flow = flow, .ahead_s = (double)NAN};
    for (size_t i = 0; i < n; i++)
        lines += text[i] == '\n';
    FW_NEED(run->entry = fw_arena_array(arena, fw_recipe_asrun_entry, lines));
    FW_NEED(run->replan = fw_arena_array(arena, fw_recipe_replan, lines));
    FW_NEED(run->link = fw_arena_alloc(arena, lines, sizeof *run->link));
    if (n == 0 || text[n - 1] != '\n') return damaged(&r, "its last line is not complete");
    if (memchr(text, '\0', n)) return damaged(&r, "it holds a NUL byte");
    for (const char *line = text; line < text + n; r.place.line++) {
        size_t length = strcspn(line, "\n");
        if (r.place.line == 1) {
            FW_TRY(read_first(&r, line, length, run));
            memcpy(run->begun, run->chain, sizeof run->begun);
        } else {
            FW_TRY(read_entry(&r, plan_sha256, line, length, run));
        }
        line += length + 1;
    }
    return FW_OK;
}

fw_status fw_recipe_asrun_read(fw_arena *arena, const fw_process_flow *flow,
                               const char *plan_sha256, const char *file, const char *text,
                               size_t n, fw_diags *diags, fw_recipe_asrun *run) {
    FW_TRY(fw_recipe_asrun_read_former(arena, flow, plan_sha256, file, text, n, diags, run));
    if (plan_sha256 && strcmp(run->plan, plan_sha256) != 0)
        return fw_diag_error(
            diags, 281, (fw_place){file, 1, 1},
            "the log is of plan %.12s..., but this device and these packs now give %.12s...: use "
            "the files of that plan; or, where the lot goes on by this one (a pack that was "
            "calibrated meanwhile), log that: --entry \"plan; start=TIME; by=INITIALS; note=WHY\"",
            run->plan, plan_sha256);
    return FW_OK;
}

fw_status fw_recipe_asrun_read_next(fw_arena *arena, const fw_process_flow *flow, const char *file,
                                    const char *line, fw_diags *diags, fw_recipe_asrun *run) {
    fw_recipe_asrun_reader r = {.arena = arena,
                                .flow = flow,
                                .run = run,
                                .diags = diags,
                                .place = {file, run->nline + 2, 1}};
    return read_entry(&r, run->plan, line, strcspn(line, "\n"), run);
}

/* of one wafer, or one of them of the whole lot */
static bool same_wafer(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return !a->wafer || !b->wafer || strcmp(a->wafer, b->wafer) == 0;
}

bool fw_recipe_asrun_is_log(const char *text, size_t n) {
    return n >= sizeof first_words && strncmp(text, first_words, sizeof first_words - 1) == 0;
}

fw_status fw_recipe_asrun_begin(fw_arena *arena, const fw_process_flow *flow,
                                const char *plan_sha256, const char *lot, const char *wafers,
                                const char *zone, const char **line) {
    char chain[65];
    const char *words =
        fw_arena_printf(arena, "%s\tflow=%s\tplan=%s%s%s%s%s%s%s\thead=kept", first_words, flow->id,
                        plan_sha256, lot ? "\tlot=" : "", lot ? lot : "", wafers ? "\twafers=" : "",
                        wafers ? wafers : "", zone ? "\tzone=" : "", zone ? zone : "");
    FW_NEED(words);
    link_of(arena, "", words, strlen(words), chain);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", words, chain_word, chain));
    return FW_OK;
}

/* A difference is small on either side: a whole width in its place lies further from its limits than twice the larger of them,
   and so does another unit; a line that was etched away altogether does not as a rule */
static bool ask_difference(const fw_recipe_asrun_reader *r, const fw_recipe_measured *m,
                           const fw_process_accept *a) {
    static const double times = 2.0;
    const double least = fw_recipe_asrun_limit(a->low, (double)NAN),
                 most = fw_recipe_asrun_limit(a->high, (double)NAN),
                 beyond = fmax(least - m->number, m->number - most);
    fw_quantity_unit unit;
    if (!(least < 0.0) || isnan(most) ||
        !fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL) ||
        !fw_quantity_dimension_equal(unit.dimension, (fw_quantity_dimension)FW_DIM_LENGTH))
        return false;
    if (beyond > times * fmax(fabs(least), fabs(most)))
        fw_diag_unreliable(
            r->diags, 283, r->place,
            "%s=%s is far from the %s to %s %s that are accepted: is the unit right, "
            "and is it the difference? A later entry of the step takes its place",
            m->measure, m->value, a->low, a->high, a->unit);
    return true;
}

/* mm for um, or nm: a hundred times what is accepted is in the range of its dimension, and seldom true. Said also to
   those who want no warnings (-q), since no line can be taken back. */
static void ask_units(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        double most = fw_recipe_asrun_limit(a->high, (double)NAN),
               least = fw_recipe_asrun_limit(a->low, (double)NAN), size = fabs(m->number);
        if (ask_difference(r, m, a)) continue;
        bool above = most > 0.0 && size > 100.0 * most,
             below = least > 0.0 && size > 0.0 && size < 0.01 * least;
        if (!above && !below) continue;
        fw_diag_unreliable(r->diags, 283, r->place,
                           "%s=%s is %s the %s %s that are accepted: is the unit right? A later "
                           "entry of the step takes its place",
                           m->measure, m->value,
                           above ? "more than 100 times" : "less than a hundredth of",
                           above ? a->high : a->low, a->unit);
    }
}

/* what is odd, and may still be true */
/* in the lot; 0 where the entry is of all wafers, or the log names none: then everything is measured */
static int index_of_wafer(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (int i = 0; e->wafer && i < run->nwafer; i++)
        if (strcmp(run->wafer[i], e->wafer) == 0) return i;
    return 0;
}

/* what only goes back into the pack, and has no limits, is given by the coupon itself */
static bool gives(const fw_recipe_asrun_entry *e, const fw_process_accept *a) {
    for (int i = 0; i < e->nmeasured; i++)
        if (strcmp(e->measured[i].measure, a->measure) == 0) return true;
    for (int i = 0; a->coupon && !a->low[0] && !a->high[0] && i < e->ncoupon; i++)
        if (strcmp(e->coupon[i].row.coupon, fw_process_coupon_called(a->coupon)) == 0) return true;
    return false;
}

/* what the sheet has a cell for, and the entry no value */
static void ask_missing(const fw_recipe_asrun_reader *r, const fw_recipe_asrun *run,
                        const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->step->naccept; i++) {
        const fw_process_accept *a = &e->step->accept[i];
        if (fw_process_accept_is_due(a, index_of_wafer(run, e)) && !gives(e, a))
            fw_diag_warning(r->diags, 283, r->place,
                            "the entry does not give '%s', which step %s measures of this wafer",
                            a->measure, e->step->id);
    }
}

/* what was looked at bounds from one side; the other side, or a value, may be of an earlier entry of the step */
static void ask_other_side(const fw_recipe_asrun_reader *r, const fw_recipe_asrun *run,
                           const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->ncoupon; i++) {
        const fw_process_measurement *row = &e->coupon[i].row;
        const char *other = fw_process_coupon_other_side(row);
        bool there = !other;
        for (int k = 0; k <= run->nentry && !there; k++) {
            const fw_recipe_asrun_entry *of = k < run->nentry ? &run->entry[k] : e;
            for (int c = 0; of->step == e->step && same_wafer(of, e) && c < of->ncoupon; c++)
                there = there || (strcmp(of->coupon[c].row.coupon, row->coupon) == 0 &&
                                  strcmp(of->coupon[c].row.feature, row->feature) != 0);
        }
        if (!there)
            fw_diag_warning(
                r->diags, 283, r->place,
                "coupon %s, %s without %s bounds on one side, and calibrate needs both: "
                "add it to this entry or a later one",
                row->coupon, row->feature, other);
    }
}

/* A wafer is at one step at a time; what was measured of a step later may have its times, and what is of no wafer (a bath
   that is mixed, a chamber that is prepared) is done beside it. Of a lot in several loads one is through while
   another is not. */
static void ask_place(const fw_recipe_asrun_reader *r, const fw_recipe_asrun *run,
                      const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < run->nentry && !fw_process_step_is_of_lot(e->step) && e->loads <= 1; i++) {
        const fw_recipe_asrun_entry *of = &run->entry[i];
        if (of->fate != FW_FATE_RUN || of->step == e->step || fw_recipe_asrun_taken_back(run, of) ||
            fw_process_step_is_of_lot(of->step) || of->loads > 1 || !same_wafer(of, e) ||
            !(e->start_s < of->end_s && of->start_s < e->end_s))
            continue;
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s was done from %s to %s, and from %s to %s the same wafer was in "
                        "step %s: one of these times is wrong",
                        e->step->id, e->start, e->end, of->start, of->end, of->step->id);
        return;
    }
}

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* an entry with nothing that the other does not say, too */
static bool says_the_same(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    bool same = a->step == b->step && same_text(a->wafer, b->wafer) && a->start_s == b->start_s &&
                a->end_s == b->end_s && same_text(a->deviation, b->deviation) &&
                same_text(a->note, b->note) && a->nmeasured == b->nmeasured && a->nset == b->nset &&
                a->ncoupon == b->ncoupon;
    for (int i = 0; same && i < a->nmeasured; i++)
        same = strcmp(a->measured[i].measure, b->measured[i].measure) == 0 &&
               strcmp(a->measured[i].value, b->measured[i].value) == 0;
    for (int i = 0; same && i < a->nset; i++)
        same = strcmp(a->set[i].name, b->set[i].name) == 0 &&
               strcmp(a->set[i].text, b->set[i].text) == 0;
    for (int i = 0; same && i < a->ncoupon; i++)
        same = strcmp(a->coupon[i].text, b->coupon[i].text) == 0;
    return same;
}

static void ask_twice(const fw_recipe_asrun_reader *r, const fw_recipe_asrun *run,
                      const fw_recipe_asrun_entry *e) {
    for (int i = run->nentry - 1; i >= 0; i--) {
        if (run->entry[i].fate != FW_FATE_RUN || !says_the_same(&run->entry[i], e)) continue;
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s%s%s from %s to %s is in the log already, with the same values "
                        "(line %d)",
                        e->step->id, e->wafer ? " of wafer " : "", e->wafer ? e->wafer : "",
                        e->start, e->end, run->entry[i].line);
        return;
    }
}

/* steps between the last one before e that is in the log of its wafer, and e */
static void ask_skipped(const fw_recipe_asrun_reader *r, const fw_recipe_asrun *run,
                        const fw_recipe_asrun_entry *e) {
    const fw_process_step *from = r->flow->step; /* the first that is not there */
    for (int i = 0; i < run->nentry; i++) {
        const fw_process_step *s = run->entry[i].step;
        if (s && s < e->step && s + 1 > from && same_wafer(&run->entry[i], e)) from = s + 1;
    }
    if (from + 1 == e->step)
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s, which comes before it, is not in the log", from->id);
    else
        fw_diag_warning(r->diags, 283, r->place,
                        "%d steps that come before it are not in the log, %s to %s",
                        (int)(e->step - from), from->id, e->step[-1].id);
}

static void ask(const fw_recipe_asrun_reader *r, const fw_recipe_asrun *run,
                const fw_recipe_asrun_entry *e) {
    int index = (int)(e->step - r->flow->step);
    const fw_recipe_asrun_entry *last = run->nentry > 0 ? &run->entry[run->nentry - 1] : NULL;
    const fw_recipe_asrun_entry *before = NULL;
    for (int i = 0; i < run->nentry; i++)
        if (run->entry[i].step == e->step - 1 && same_wafer(&run->entry[i], e))
            before = &run->entry[i];
    const fw_recipe_asrun_entry *by =
        before ? fw_recipe_asrun_overtaken(run, before, e->wafer) : NULL;
    if (by)
        fw_diag_warning(
            r->diags, 687, r->place,
            "step %s, which comes before it, is in the log from before step %s was run%s "
            "(lines %d and %d): run it again, or log it where it was",
            before->step->id, by->step->id,
            fw_recipe_asrun_is_again(run, by, before, e->wafer) ? " again" : "", before->line,
            by->line);
    if (!before && index > 0) ask_skipped(r, run, e);
    if (last && same_wafer(last, e) && e->start_s < last->start_s)
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s starts before step %s, which was entered before it", e->step->id,
                        last->at->id);
    ask_place(r, run, e);
    ask_twice(r, run, e);
    ask_units(r, e);
    ask_missing(r, run, e);
    ask_other_side(r, run, e);
}

/* A line cannot be taken back, and a wrong year is soon typed: what ends more than a day after the clock's time has not
   been done yet. A day, since the clock may be set to another zone. */
static fw_status check_clock(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e,
                             double now_s) {
    const double day = 86400.0;
    if (e->end_s > now_s + day)
        return fw_diag_error(r->diags, 282, r->place,
                             "end=%s is in the future, and a log is of what was done; correct the "
                             "date, or the clock of this computer",
                             e->end);
    if (e->start_s < now_s - 365.25 * day)
        fw_diag_warning(r->diags, 283, r->place,
                        "start=%s is more than a year ago: is the year right?", e->start);
    return FW_OK;
}

fw_status fw_recipe_asrun_add(fw_arena *arena, const fw_process_flow *flow,
                              const fw_recipe_asrun *run, const char *words, fw_place place,
                              double now_s, fw_diags *diags, const char **line) {
    fw_recipe_asrun_reader r = {.arena = arena,
                                .flow = flow,
                                .run = run,
                                .bound = true,
                                .fresh = true,
                                .diags = diags,
                                .place = place};
    fw_recipe_asrun_entry e;
    char chain[65];
    size_t n = strlen(words);
    if (n > LONGEST_WORDS || !fw_text_is_line(words))
        return fw_diag_error(
            diags, 282, r.place,
            "an entry has at most %d bytes of UTF-8 and no tabs, line ends or other "
            "control characters",
            LONGEST_WORDS);
    FW_TRY(fw_recipe_asrun_entry_read(&r, words, n, ';', &e));
    FW_TRY(check_clock(&r, &e, now_s));
    if (e.fate == FW_FATE_RUN) ask(&r, run, &e);
    fw_text out = fw_text_new(arena);
    fw_text_printf(&out, "step=%s\tstart=%s\tend=%s\tby=%s", e.at->id, e.start, e.end, e.by);
    const struct {
        const char *name, *value;
    } more[] = {{"wafer", e.wafer},           {"second", e.second},    {"tool", e.tool},
                {"instrument", e.instrument}, {"bath", e.bath},        {"note", e.note},
                {"deviation", e.deviation},   {"replaces", e.replaces}};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        if (more[i].value) fw_text_printf(&out, "\t%s=%s", more[i].name, more[i].value);
    if (e.fate != FW_FATE_RUN) fw_text_printf(&out, "\t%s=%s", fw_recipe_fate_word(e.fate), e.why);
    for (int i = 0; i < e.nmeasured; i++)
        fw_text_printf(&out, "\t%s=%s", e.measured[i].measure, e.measured[i].value);
    for (int i = 0; i < e.nset; i++)
        fw_text_printf(&out, "\tset %s=%s", e.set[i].name, e.set[i].text);
    for (int i = 0; i < e.ncoupon; i++)
        fw_text_printf(&out, "\tcoupon=%s", e.coupon[i].text);
    fw_recipe_asrun_put_planned(&e, &out);
    fw_recipe_asrun_put_limits(&e, &out);
    FW_TRY(fw_text_end(&out));
    link_of(arena, run->chain, out.data, out.length, chain);
    FW_NEED(chain[0]);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", out.data, chain_word, chain));
    return FW_OK;
}

/* ---- another plan ---- */

bool fw_recipe_asrun_is_plan(const char *words) {
    words += strspn(words, " ");
    return strncmp(words, "plan", 4) == 0 && (words[4] == ';' || words[4] == ' ' || !words[4]);
}

fw_status fw_recipe_asrun_add_plan(fw_arena *arena, const fw_recipe_asrun *run,
                                   const char *plan_sha256, const char *words, fw_place place,
                                   fw_diags *diags, const char **line) {
    enum { START, BY, NOTE, FIELDS };
    static const char *const name[FIELDS] = {"start", "by", "note"};
    const char *value[FIELDS] = {0}, *wrong = NULL;
    char chain[65], *copy = fw_arena_strdup(arena, words);
    double time_s, ahead_s;
    FW_NEED(copy);
    if (strlen(words) > LONGEST_WORDS || !fw_text_is_line(words)) wrong = "it is no line of text";
    for (char *at = copy; at && !wrong;) {
        const char *word = fw_recipe_asrun_word(&at, ';');
        int k = 0;
        while (k < FIELDS &&
               (strncmp(word, name[k], strlen(name[k])) != 0 || word[strlen(name[k])] != '='))
            k++;
        if (k < FIELDS && !value[k])
            value[k] = word + strlen(name[k]) + 1;
        else if (word[0] && strcmp(word, "plan") != 0)
            wrong = "it takes start=, by= and note=, each once";
    }
    if (!wrong && (!value[START] || !fw_recipe_asrun_time_read(value[START], &time_s, &ahead_s)))
        wrong = "start= is needed, such as start=2026-11-20T10:00";
    if (!wrong && (!value[BY] || !value[BY][0])) wrong = "by= is needed: who says so";
    if (!wrong && strcmp(run->plan, plan_sha256) == 0) wrong = "the log is of this plan already";
    if (wrong)
        return fw_diag_error(diags, 282, place, "an entry that names another plan: %s", wrong);
    const char *text =
        fw_arena_printf(arena, "plan=%s\tstart=%s\tby=%s%s%s", plan_sha256, value[START], value[BY],
                        value[NOTE] ? "\tnote=" : "", value[NOTE] ? value[NOTE] : "");
    FW_NEED(text);
    link_of(arena, run->chain, text, strlen(text), chain);
    FW_NEED(chain[0]);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", text, chain_word, chain));
    return FW_OK;
}

/* ---- was it planned as the flow plans it here? ----
   What calibrate finds of edges is what is left beyond what the wet etch was planned to take. The line of the run says how long it
   was planned; the law of its step, with the values that the flow has here, how long it would be now. */

/* the last run of the step on the wafer by the time of e; NULL: none is in the log */
static const fw_recipe_asrun_entry *
run_by(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, const fw_process_step *step) {
    const fw_recipe_asrun_entry *last = NULL;
    for (const fw_recipe_asrun_entry *o = run->entry; o < run->entry + run->nentry; o++)
        if (o->step == step && same_wafer(o, e) && o->start_s <= e->start_s &&
            !fw_recipe_asrun_taken_back(run, o) && (!last || o->start_s >= last->start_s))
            last = o;
    return last;
}

fw_status fw_recipe_asrun_ask_plan(fw_arena *arena, const fw_recipe_asrun *run,
                                   const fw_recipe_asrun_entry *e, int n,
                                   const fw_recipe_coupon *first, bool *otherwise,
                                   fw_diags *diags) {
    fw_text how = fw_text_new(arena);
    *otherwise = false;
    for (const fw_process_step *s = run->flow->step; n > 0 && e->step && s <= e->step; s++) {
        bool takes = false;
        for (int k = 0; k < s->nchange; k++)
            takes = takes || fw_process_change_takes_edges(run->flow, &s->change[k]);
        if (!takes || how.length > 0) continue;
        const fw_recipe_asrun_entry *o = run_by(run, e, s);
        if (!o) fw_text_printf(&how, "step %s is not in the log of its wafer", s->id);
        for (; o && how.length == 0; o = fw_recipe_asrun_goes_on_from(run, o)) {
            FW_TRY(fw_recipe_asrun_put_otherwise(arena, run, o, &how));
            *otherwise = how.length > 0 && o->as_set->time.computable;
        }
    }
    if (how.length == 0) return FW_OK;
    FW_TRY(fw_text_end(&how));
    fw_diag_warning(
        diags, 735, first->row.place, "%d reading%s of %s at step %s%s%s %s: %s%s", n,
        n > 1 ? "s" : "", first->row.coupon, e->step->id, e->wafer ? " of wafer " : "",
        e->wafer ? e->wafer : "",
        *otherwise ? (n > 1 ? "do not count" : "does not count") : (n > 1 ? "count" : "counts"),
        how.data,
        *otherwise ? ". Calibrate them with the laboratory packs that their plan had (--lab)"
                   : ", so that what it was planned to take is taken to be what the flow "
                     "plans here");
    return diags->failed ? FW_NOMEM : FW_OK;
}
