/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The as-run log as a text: its chain, its entries, and the head beside it. */
#include "base/text.h"
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
    if (entries > run->nentry)
        return fw_diag_error(
            diags, 280, place,
            "the log has %d entries, but its head says %d: lines were removed at its "
            "end",
            run->nentry, entries);
    if (entries == 0 && run->nentry == 0) return FW_OK; /* of a beginning that was interrupted */
    const char *there = entries > 0 ? run->entry[entries - 1].chain : run->begun;
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

static fw_status read_first(const fw_recipe_asrun_reader *r, const char *plan, const char *line,
                            size_t n, fw_recipe_asrun *run) {
    size_t words;
    if (!fw_recipe_asrun_is_log(line, n))
        return damaged(r, "it does not begin with 'flexwright as-run 1'");
    FW_TRY(unchain(r, line, n, run->chain, &words));
    if (!memmem(line, words, "\tflow=", 6) || !memmem(line, words, "\tplan=", 6))
        return damaged(r, "its first line lacks its flow or its plan");
    const char *flow = value_of(r->arena, line, words, "flow");
    run->plan = value_of(r->arena, line, words, "plan");
    run->lot = value_of(r->arena, line, words, "lot");
    FW_NEED(flow && run->plan);
    if (strcmp(flow, r->flow->id) != 0)
        return fw_diag_error(r->diags, 281, r->place, "this is a log of flow %s, not of %s", flow,
                             r->flow->id);
    FW_TRY(read_wafers(r, value_of(r->arena, line, words, "wafers"), run));
    const char *head = value_of(r->arena, line, words, "head");
    run->headed = head && strcmp(head, "kept") == 0;
    if (plan && strcmp(run->plan, plan) != 0)
        return fw_diag_error(r->diags, 281, r->place,
                             "the log was begun for plan %.12s..., but this device and these packs "
                             "now give %.12s...: use the files of that plan, or begin a new log",
                             run->plan, plan);
    return FW_OK;
}

/* a line behind the first one, into the next of run->entry */
static fw_status read_entry(fw_recipe_asrun_reader *r, const char *line, size_t length,
                            fw_recipe_asrun *run) {
    size_t words = 0;
    FW_TRY(unchain(r, line, length, run->chain, &words));
    FW_TRY(fw_recipe_asrun_entry_read(r, line, words, '\t', &run->entry[run->nentry]));
    memcpy(run->entry[run->nentry++].chain, run->chain, sizeof run->chain);
    return FW_OK;
}

fw_status fw_recipe_asrun_read(fw_arena *arena, const fw_process_flow *flow,
                               const char *plan_sha256, const char *file, const char *text,
                               size_t n, fw_diags *diags, fw_recipe_asrun *run) {
    fw_recipe_asrun_reader r = {arena, flow, run, plan_sha256 != NULL, false, diags, {file, 1, 1}};
    size_t lines = 1;
    *run = (fw_recipe_asrun){.flow = flow};
    for (size_t i = 0; i < n; i++)
        lines += text[i] == '\n';
    FW_NEED(run->entry = fw_arena_array(arena, fw_recipe_asrun_entry, lines));
    if (n == 0 || text[n - 1] != '\n') return damaged(&r, "its last line is not complete");
    if (memchr(text, '\0', n)) return damaged(&r, "it holds a NUL byte");
    for (const char *line = text; line < text + n; r.place.line++) {
        size_t length = strcspn(line, "\n");
        if (r.place.line == 1) {
            FW_TRY(read_first(&r, plan_sha256, line, length, run));
            memcpy(run->begun, run->chain, sizeof run->begun);
        } else {
            FW_TRY(read_entry(&r, line, length, run));
        }
        line += length + 1;
    }
    return FW_OK;
}

fw_status fw_recipe_asrun_read_next(fw_arena *arena, const fw_process_flow *flow, const char *file,
                                    const char *line, fw_diags *diags, fw_recipe_asrun *run) {
    fw_recipe_asrun_reader r = {arena, flow, run, true, false, diags, {file, run->nentry + 2, 1}};
    return read_entry(&r, line, strcspn(line, "\n"), run);
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
                                const char **line) {
    char chain[65];
    const char *words = fw_arena_printf(
        arena, "%s\tflow=%s\tplan=%s%s%s%s%s\thead=kept", first_words, flow->id, plan_sha256,
        lot ? "\tlot=" : "", lot ? lot : "", wafers ? "\twafers=" : "", wafers ? wafers : "");
    FW_NEED(words);
    link_of(arena, "", words, strlen(words), chain);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", words, chain_word, chain));
    return FW_OK;
}

/* mm for um, or nm: a hundred times what is accepted is in the range of its dimension, and seldom true. Said also to
   those who want no warnings (-q), since no line can be taken back. */
static void ask_units(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        double most = fw_recipe_asrun_limit(a->high, (double)NAN),
               least = fw_recipe_asrun_limit(a->low, (double)NAN), size = fabs(m->number);
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
        if (of->fate != FW_FATE_RUN || of->step == e->step || fw_process_step_is_of_lot(of->step) ||
            of->loads > 1 || !same_wafer(of, e) ||
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

/* ---- what a wafer waited ---- */

/* of which entry of the step the wafer came to e: the last one, which takes the place of those before; one that was run again
   after e is another run, where there was one for e already. NULL: it is not in the log */
static const fw_recipe_asrun_entry *came_from(const fw_recipe_asrun *run, const char *step,
                                              const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *from = NULL;
    for (const fw_recipe_asrun_entry *of = run->entry; of < run->entry + run->nentry; of++) {
        if (!of->step || strcmp(of->step->id, step) != 0) continue;
        /* what is done without a wafer is done for each of them */
        if (!same_wafer(of, e) && (of->wafer || !fw_process_step_is_of_lot(of->step))) continue;
        const bool again = from && of > e && of->start_s >= e->start_s;
        if (!again) from = of;
    }
    return from;
}

/* what is looked at while what it will be a part of is made elsewhere: the second wafer of a bond, before it is there */
static bool is_beside(const fw_process_step *step) {
    for (int i = 0; i < step->nrequired; i++)
        if (step->required[i].material && !step->required[i].present &&
            strcmp(step->op, "inspect") == 0)
            return true;
    return fw_process_step_is_of_lot(step);
}

/* the step of the flow that the log has of this wafer before that of e; NULL: none, or e is beside the wafer */
static const fw_process_step *step_before(const fw_recipe_asrun *run,
                                          const fw_recipe_asrun_entry *e) {
    const fw_process_step *before = NULL;
    for (int i = 0; i < run->nentry && !is_beside(e->step); i++) {
        const fw_recipe_asrun_entry *of = &run->entry[i];
        if (of->step && of->step < e->step && same_wafer(of, e) && !is_beside(of->step) &&
            (!before || of->step > before))
            before = of->step;
    }
    return before;
}

/* of several loads in one entry, or in entries that share their time, one wafer is through while another is not */
static bool in_loads(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    int together;
    return fw_recipe_asrun_loads(run, e, &together) > 1.0;
}

static void wait_since(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                       fw_recipe_wait *wait) {
    const fw_recipe_asrun_entry *from = came_from(run, wait->since, e);
    wait->from = from;
    wait->waited_s = from ? e->start_s - from->end_s : (double)NAN;
    if (wait->waited_s < 0.0 && (in_loads(run, e) || in_loads(run, from)))
        wait->waited_s = (double)NAN;
    wait->fine = !(wait->waited_s < wait->min_s) && !(wait->waited_s > wait->max_s);
}

/* An earlier run of e's step ended the wait already, and is judged by it. From there on the wafer may wait as long again before
   it goes on; true: it did not wait longer */
static bool is_over(const fw_recipe_asrun *run, fw_recipe_wait *wait,
                    const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *before = wait->from ? fw_recipe_asrun_run_before(run, e) : NULL;
    if (!before || before->start_s < wait->from->end_s) return false;
    wait->since = e->step->id;
    wait->from = before;
    wait->min_s = 0.0, wait->waited_s = e->start_s - before->end_s;
    wait->fine = !(wait->waited_s > wait->max_s);
    return wait->fine;
}

/* A chamber is seasoned for the wafer that comes first: another one was in it before e */
static bool is_later_one(const fw_recipe_asrun *run, const fw_recipe_wait *wait,
                         const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *of = run->entry; of < run->entry + run->nentry; of++)
        if (of->step == e->step && !same_wafer(of, e) && wait->from &&
            of->start_s >= wait->from->end_s && of->start_s < e->start_s)
            return true;
    return false;
}

/* what the flow says of the wafer's state, which this step ends; false: nothing, or not of this wafer */
static bool wait_in_state(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                          const fw_process_wait *w, fw_recipe_wait *wait) {
    if (&run->flow->step[w->to] != e->step) return false;
    *wait = (fw_recipe_wait){.since = run->flow->step[w->from].id, .is = w->is, .max_s = w->max_s};
    wait_since(run, e, wait);
    return !is_over(run, wait, e) && (!w->first_only || !is_later_one(run, wait, e));
}

bool fw_recipe_asrun_wait_stands(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                 const fw_recipe_wait *wait) {
    bool again = false;
    if (strcmp(wait->since, e->step->id) == 0) return true; /* between two of its runs */
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && fw_recipe_asrun_run_before(run, later) == e) {
            if (came_from(run, wait->since, later) == wait->from) return true;
            again = true;
        }
    return !again && fw_recipe_asrun_is_last(run, e);
}

bool fw_recipe_asrun_wait(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, int *i,
                          fw_recipe_wait *wait) {
    const int nlag = e->step->nlag, nwait = run->flow->nwait;
    int k;
    while ((k = (*i)++) < nlag) {
        const fw_process_lag *lag = &e->step->lag[k];
        *wait = (fw_recipe_wait){
            .since = lag->from, .min_s = isnan(lag->min_s) ? 0.0 : lag->min_s, .max_s = lag->max_s};
        wait_since(run, e, wait);
        if (!is_over(run, wait, e)) return true;
    }
    for (int n = k - nlag; n < nwait; n++, (*i)++)
        if (wait_in_state(run, e, &run->flow->wait[n], wait)) return true;
    const fw_process_step *before = *i == nlag + nwait + 1 ? step_before(run, e) : NULL;
    if (!before) return false;
    *wait = (fw_recipe_wait){.since = before->id, .max_s = (double)NAN};
    for (int n = 0; n < nlag; n++) /* it has been told */
        if (strcmp(e->step->lag[n].from, before->id) == 0) return false;
    for (const fw_process_wait *w = run->flow->wait; w < run->flow->wait + nwait; w++)
        if (w->from == before - run->flow->step && w->to == e->step - run->flow->step) return false;
    wait_since(run, e, wait);
    return wait->waited_s < 0.0;
}

static fw_status ask_wait(const fw_recipe_asrun_entry *e, const fw_recipe_wait *wait,
                          fw_place place, fw_diags *diags) {
    fw_text text = fw_text_new(diags->arena);
    /* of one wafer at two steps at once ask_place has said it */
    if (e->start_s < wait->from->end_s && wait->from->start_s < e->end_s &&
        !fw_process_step_is_of_lot(e->step) && !fw_process_step_is_of_lot(wait->from->step))
        return FW_OK;
    fw_text_printf(&text, "step %s%s%s ", e->step->id, e->wafer ? " of wafer " : "",
                   e->wafer ? e->wafer : "");
    fw_recipe_put_waited(&text, wait);
    if (wait->waited_s < 0.0) {
        fw_text_printf(&text,
                       " (%s to %s), and comes after it: one of these times is wrong; an entry "
                       "with the right ones takes the place of the wrong one",
                       wait->from->start, wait->from->end);
    } else {
        fw_text_add(&text, ", and allowed is ");
        fw_recipe_put_wait_limits(&text, wait);
        fw_text_add(&text, "; look at what that leaves before the next step");
        fw_text_add(&text, e->deviation ? "" : ", and write down why (deviation=...)");
    }
    FW_TRY(fw_text_end(&text));
    fw_diag_warning(diags, 648, place, "%s", text.data);
    return diags->failed ? FW_NOMEM : FW_OK;
}

fw_status fw_recipe_asrun_ask_waits(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                    fw_place place, fw_diags *diags) {
    for (const fw_recipe_asrun_entry *of = run->entry; of <= e; of++) {
        int i = 0;
        if (!of->step || (of != e && !fw_recipe_asrun_is_last(run, of))) continue;
        for (fw_recipe_wait wait; fw_recipe_asrun_wait(run, of, &i, &wait);)
            if (!wait.fine && (of == e || wait.from == e))
                FW_TRY(ask_wait(of, &wait, place, diags));
    }
    return FW_OK;
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
        fw_diag_warning(r->diags, 687, r->place,
                        "step %s, which comes before it, is in the log from before step %s was run "
                        "again (lines %d and %d): run it again, or log it where it was",
                        before->step->id, by->step->id, before->line, by->line);
    if (!before && index > 0)
        fw_diag_warning(r->diags, 283, r->place,
                        "step %s, which comes before it, is not in the log",
                        r->flow->step[index - 1].id);
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
    fw_recipe_asrun_reader r = {arena, flow, run, true, true, diags, place};
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
    } more[] = {{"wafer", e.wafer},           {"second", e.second}, {"tool", e.tool},
                {"instrument", e.instrument}, {"bath", e.bath},     {"note", e.note},
                {"deviation", e.deviation}};
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
    FW_TRY(fw_text_end(&out));
    link_of(arena, run->chain, out.data, out.length, chain);
    FW_NEED(chain[0]);
    FW_NEED(*line = fw_arena_printf(arena, "%s%s%s\n", out.data, chain_word, chain));
    return FW_OK;
}
