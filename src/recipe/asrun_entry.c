/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One entry of an as-run log, checked against the plan that the log is bound to. */
#include "base/text.h"
#include "process/process_law.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include "schedule/schedule.h"
#include <math.h>
#include <string.h>

static const fw_process_step *step_of(const fw_recipe_asrun_reader *r, const char *id) {
    for (int i = 0; i < r->flow->nstep; i++)
        if (strcmp(r->flow->step[i].id, id) == 0) return &r->flow->step[i];
    const fw_process_left_out *gone = fw_process_flow_left_out(r->flow, id);
    if (gone) {
        fw_diag_error(r->diags, 282, r->place,
                      "step '%s' (%s) is left out of this plan, because %s; a log has no entry for "
                      "it",
                      id, gone->title, gone->why);
        return NULL;
    }
    const char *best = NULL;
    for (int i = 0, least = 3; i < r->flow->nstep; i++) {
        int d = fw_edit_distance(id, r->flow->step[i].id, 2);
        if (d < least) {
            least = d;
            best = r->flow->step[i].id;
        }
    }
    fw_diag_error(r->diags, 282, r->place, "flow %s has no step '%s'%s%s%s", r->flow->id, id,
                  FW_DID_YOU_MEAN(best));
    return NULL;
}

static const char *const own_words[] = {"start", "end",     "by",        "second",     "tool",
                                        "bath",  "note",    "wafer",     "instrument", "scrapped",
                                        "held",  "resumed", "deviation", "replaces"};
static const char planned_word[] = "planned";
enum { OWN_WORDS = sizeof own_words / sizeof own_words[0], MOST_NAMES = 60 };

/* how many times yes or no stands there; 0: something else stands there, too */
static int answers_of(const char *value) {
    int n = 0;
    for (fw_word word; fw_word_next(&value, " ", &word); n++)
        if (!fw_word_is(word, "yes") && !fw_word_is(word, "no")) return 0;
    return n;
}

/* "no" or "none", once or for each site, of what is a number and may be 0: that number, in the unit of the sheet; else value */
static const char *none_is_zero(fw_arena *arena, const fw_process_flow *flow,
                                const fw_process_accept *a, const char *value) {
    const bool number = a->low[0] || a->high[0],
               may = !a->low[0] || fw_process_is_difference(flow, a) || strcmp(a->low, "0") == 0;
    fw_text zero = fw_text_new(arena);
    int n = 0;
    fw_word word;
    for (const char *at = value; number && may && fw_word_next(&at, " ", &word); n++) {
        if (!fw_word_is(word, "no") && !fw_word_is(word, "none")) return value;
        fw_text_add(&zero, n ? " 0" : "0");
    }
    if (n == 0) return value;
    if (strcmp(a->unit, "1") != 0) fw_text_printf(&zero, " %s", a->unit);
    return fw_text_end(&zero) == FW_OK ? zero.data : NULL;
}

/* as the step calls it, or as the sheet prints it: "aluminium left on coupon al-step" */
static const fw_process_accept *measure_named(const fw_process_step *step, const char *name) {
    static const char on[] = " on coupon ";
    const fw_process_accept *a = fw_recipe_asrun_accept(step, name);
    for (int i = 0; i < step->naccept && !a; i++) {
        const fw_process_accept *b = &step->accept[i];
        const size_t n = strlen(b->measure);
        if (b->coupon[0] && strncmp(name, b->measure, n) == 0 &&
            strncmp(name + n, on, sizeof on - 1) == 0 &&
            strcmp(name + n + sizeof on - 1, b->coupon) == 0)
            a = b;
    }
    return a;
}

static fw_status read_measure(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e,
                              const char *name, const char *value) {
    const fw_process_accept *a = measure_named(e->step, name);
    /* without its plan, whose values may stand in the name of a measure, and of a former one: what has a name in this flow */
    if (!r->bound && !a) return FW_OK;
    if (!a) {
        const char *known[MOST_NAMES];
        int n = 0;
        for (int i = 0; i < e->step->naccept && n < MOST_NAMES - OWN_WORDS; i++)
            known[n++] = e->step->accept[i].measure;
        for (int i = 0; i < OWN_WORDS; i++)
            known[n++] = own_words[i];
        return fw_recipe_asrun_unknown(
            r, fw_arena_printf(r->arena, "step %s measures no", e->step->id), name, known, n);
    }
    FW_NEED(value = none_is_zero(r->arena, r->flow, a, value));
    fw_recipe_measured m = {.measure = a->measure, .value = value, .number = (double)NAN};
    m.low = a->low, m.high = a->high;
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        m.site[i] = (double)NAN;
    int answers = answers_of(value);
    bool word = answers == 1 || (answers > 0 && answers == a->sites);
    if (r->fresh && word && (a->low[0] || a->high[0])) /* "no" grass is 0, and "yes" is no number */
        return fw_diag_error(r->diags, 282, r->place,
                             "%s=%s: its limits are numbers; give one, 0 where there is none", name,
                             value);
    if (!word && (answers > 0 || strcmp(a->unit, "yes/no") == 0)) {
        if (a->sites == 1)
            return fw_diag_error(r->diags, 282, r->place, "%s=%s: say yes or no", name, value);
        return fw_diag_error(r->diags, 282, r->place,
                             "%s=%s: say yes or no, once or for each of the %d sites", name, value,
                             a->sites);
    }
    if (!word) {
        fw_recipe_asrun_values v;
        /* A difference may be below 0, and as far off as a step that was badly overdone leaves it: what is to be done then
           stands in the sheet. What lies far from its limits is asked after (asrun.c). What stands in the log was looked at
           when it was written */
        const fw_quantity any = {
            .range = fw_process_is_difference(r->flow, a) ? FW_PROCESS_DIFFERENCE : NULL};
        FW_TRY(fw_recipe_asrun_values_read(r, name, value, a->sites, &v));
        FW_TRY(fw_recipe_asrun_values_in(r, name, a->unit, r->fresh ? &any : NULL, &v));
        memcpy(m.site, v.site, sizeof m.site);
        m.nsite = v.n;
        m.number = fw_recipe_asrun_mean(m.site);
    }
    for (int i = 0; i < e->nmeasured; i++)
        if (strcmp(e->measured[i].measure, m.measure) == 0)
            return fw_diag_error(r->diags, 282, r->place, "%s is given twice", name);
    e->measured[e->nmeasured++] = m;
    return FW_OK;
}

/* ---- what was set ---- */

/* whatever the sheet has a line and a cell for: what is set, what the time is computed from, and what the plan computes (a
   current, a spin speed) */
static fw_status setting_of(const fw_recipe_asrun_reader *r, const fw_process_step *s,
                            fw_recipe_set *set) {
    const char *known[MOST_NAMES];
    fw_recipe_row *row;
    int n, names = 0;
    FW_TRY(fw_recipe_step_rows(r->arena, s, &row, &n));
    for (int i = 0; i < n; i++) {
        if (!row[i].name) continue;
        if (strcmp(row[i].name, set->name) == 0) {
            set->q = row[i].q;
            set->low = row[i].low;
            set->high = row[i].high;
            if (!set->q->unknown && !set->q->word) set->planned = fw_quantity_in_unit(set->q);
            return FW_OK;
        }
        if (names < MOST_NAMES) known[names++] = row[i].name;
    }
    if (!r->bound) return FW_OK;
    return fw_recipe_asrun_unknown(r, fw_arena_printf(r->arena, "step %s sets no", s->id),
                                   set->name, known, names);
}

static fw_status read_setting(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e,
                              const char *name, const char *value) {
    name += strspn(name, " ");
    fw_recipe_set set = {.name = name, .text = value, .value = (double)NAN, .low = "", .high = ""};
    set.planned = (double)NAN;
    for (int i = 0; i < e->nset; i++)
        if (strcmp(e->set[i].name, name) == 0)
            return fw_diag_error(r->diags, 282, r->place, "set %s is given twice", name);
    FW_TRY(setting_of(r, e->step, &set));
    if (!set.q) { /* read without its plan, as calibrate does, which needs no settings */
        e->set[e->nset++] = set;
        return FW_OK;
    }
    fw_recipe_asrun_values v;
    double number;
    size_t first = strcspn(value, " ");
    bool text = fw_quantity_is_word(set.q) || /* which resist */
                (set.q->unknown && strcmp(set.q->unit, "1") == 0 &&
                 !fw_number_parse(value, first, &number));
    if (!text) {
        FW_TRY(fw_recipe_asrun_values_read(r, name, value, 1, &v));
        FW_TRY(fw_recipe_asrun_values_in(r, name, set.q->unit, set.q, &v));
        set.value = v.site[0];
    }
    e->set[e->nset++] = set;
    return FW_OK;
}

static bool is_of(const fw_layout_pattern *pattern, const fw_process_measurement *row) {
    return strcmp(pattern->kind->name, row->coupon) == 0 || strcmp(pattern->id, row->coupon) == 0;
}

/* A line of a log cannot be taken back, and what the flow does not have is of no use to calibrate. */
static fw_status check_coupon(const fw_recipe_asrun_reader *r, const fw_process_measurement *row) {
    const fw_mask_table *table = r->run->table;
    bool there = !table || !fw_process_coupon_on_test_die(row->coupon);
    for (int i = 0; !there && i < table->npattern; i++)
        there = is_of(&table->pattern[i], row);
    if (there) return fw_process_measurement_of_flow(r->flow, row, r->diags);
    return fw_diag_error(r->diags, 605, r->place,
                         "coupon %s stands on the test dies of other flows; that of %s has none",
                         row->coupon, r->flow->id);
}

/* a width that the test die does not have is another one that was read, or a slip */
static fw_status ask_drawn(const fw_recipe_asrun_reader *r, const fw_process_measurement *row) {
    static const double close = 1e-6; /* relatively: as it is written */
    const fw_mask_table *table = r->run->table;
    fw_text sizes = fw_text_new(r->arena);
    int n = 0;
    for (int i = 0; table && i < table->npattern && !isnan(row->drawn_m); i++) {
        const fw_layout_pattern *p = &table->pattern[i];
        for (int k = 0; is_of(p, row) && k < p->nsize; k++) {
            if (fabs(p->size_m[k] - row->drawn_m) <= close * row->drawn_m) return FW_OK;
            fw_text_add(&sizes, n++ ? ", " : "");
            fw_text_number(&sizes, p->size_m[k] * 1e6, 4);
        }
    }
    if (n == 0) return FW_OK;
    FW_TRY(fw_text_end(&sizes));
    char drawn[32];
    fw_diag_warning(r->diags, 283, r->place,
                    "coupon %s, drawn=%s um: on the test die it is drawn with %s um", row->coupon,
                    fw_number_text(drawn, sizeof drawn, row->drawn_m * 1e6, 4), sizes.data);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* what it reads is there at this step: a line of a log is read as what exists then */
static fw_status check_stage(const fw_recipe_asrun_reader *r, const fw_process_step *step,
                             const fw_process_measurement *row) {
    fw_process_coupon_stage stage;
    const char *where;
    bool there;
    FW_TRY(fw_process_coupon_stage_at(r->arena, r->flow, row, step, &there, &stage, &where));
    if (there) return FW_OK;
    return fw_diag_error(r->diags, 706, r->place,
                         "coupon %s is not read at step %s: it reads %s. Log it with the step at "
                         "which it was read, and its time",
                         row->coupon, step->id, where);
}

static fw_status read_coupon(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e,
                             const char *value) {
    fw_recipe_coupon *c = &e->coupon[e->ncoupon++];
    FW_TRY(fw_recipe_asrun_coupon_read(r, value, c));
    if (!r->fresh) return FW_OK;
    FW_TRY(check_coupon(r, &c->row));
    FW_TRY(check_stage(r, e->step, &c->row));
    return ask_drawn(r, &c->row);
}

static fw_status check_wafer(const fw_recipe_asrun_reader *r, const char *id) {
    const fw_recipe_asrun *run = r->run;
    for (int i = 0; i < run->nwafer; i++)
        if (strcmp(run->wafer[i], id) == 0) return FW_OK;
    if (run->nwafer == 0)
        return fw_diag_error(r->diags, 282, r->place,
                             run->nentry > 0
                                 ? "wafer=%s: the log was begun without wafers; begin one with "
                                   "--wafers, how many there are or their ids"
                                 : "wafer=%s: this log has no wafers yet; say with its first entry "
                                   "how many there are or their ids, with --wafers",
                             id);
    return fw_recipe_asrun_unknown(r, "the lot has no wafer", id, run->wafer, run->nwafer);
}

/* ---- what became of a wafer ---- */

static fw_status read_fate(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e,
                           fw_recipe_fate fate, const char *why) {
    if (e->fate != FW_FATE_RUN)
        return fw_diag_error(r->diags, 282, r->place,
                             "the entry says %s and %s of a wafer: one entry says one of them",
                             fw_recipe_fate_word(e->fate), fw_recipe_fate_word(fate));
    e->fate = fate;
    e->why = why;
    return FW_OK;
}

/* a wafer is held once, resumed where it is held, and scrapped for good; in the order of their times */
static fw_status check_fate(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *out = NULL;
    for (int i = 0; i < r->run->nentry; i++) {
        const fw_recipe_asrun_entry *other = &r->run->entry[i];
        if (other->wafer && strcmp(other->wafer, e->wafer) == 0 && e->start_s < other->end_s)
            return fw_diag_error(r->diags, 603, r->place,
                                 "wafer %s is %s at %s, before what is in line %d (%s, to %s)",
                                 e->wafer, fw_recipe_fate_word(e->fate), e->start, other->line,
                                 other->at->id, other->end);
        if (other->fate != FW_FATE_RUN && strcmp(other->wafer, e->wafer) == 0) out = other;
    }
    const bool held = out && out->fate == FW_FATE_HELD;
    if (e->fate == FW_FATE_RESUMED && !held)
        return fw_diag_error(r->diags, 603, r->place,
                             "wafer %s is not held, so that it cannot be "
                             "resumed%s",
                             e->wafer,
                             out && out->fate == FW_FATE_SCRAPPED ? ": it is scrapped" : "");
    if ((held && e->fate == FW_FATE_HELD) || (out && out->fate == FW_FATE_SCRAPPED))
        return fw_diag_error(r->diags, 603, r->place, "wafer %s was %s at %s already (line %d)",
                             e->wafer, fw_recipe_fate_word(out->fate), out->at->id, out->line);
    return FW_OK;
}

/* no step of a wafer that is scrapped or held, and none of a lot of which nothing is left */
static fw_status check_there(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e,
                             int there) {
    if (!e->wafer && r->run->nwafer > 0 && there == 0)
        return fw_diag_error(r->diags, 603, r->place,
                             "all wafers of the lot are scrapped or held: step %s is run of none",
                             e->at->id);
    if (!e->wafer) return FW_OK;
    const fw_recipe_asrun_entry *out = fw_recipe_asrun_out(r->run, e->wafer, e->end_s);
    if (!out) out = fw_recipe_asrun_out(r->run, e->wafer, e->start_s);
    if (!out) return FW_OK;
    return fw_diag_error(r->diags, 603, r->place,
                         "wafer %s was %s at %s, %s (line %d: %s): no later entry of it is taken%s",
                         e->wafer, fw_recipe_fate_word(out->fate), out->at->id, out->start,
                         out->line, out->why,
                         out->fate == FW_FATE_HELD ? "; where it goes on, log resumed= first" : "");
}

/* ---- the times that the entry is judged by ----
   They stand in its line, in seconds: whoever reads the log without its device and packs, as calibrate does, judges by them,
   too. planned=TIME FIRST-LOOK STOP MACHINE MACHINE-AT-STOP THE-SAME-WITHOUT-HANDLING FINISHES, at what was set. */
enum { PLANNED = 7 };

void fw_recipe_asrun_put_planned(const fw_recipe_asrun_entry *e, fw_text *out) {
    const fw_process_step *s = e->as_set;
    if (e->fate != FW_FATE_RUN || !s->time.computable) return;
    const double value[PLANNED] = {s->time.nominal_s, s->time.first_look_s, s->time.stop_s,
                                   s->booked_s,       s->booked_stop_s,     s->booked_stop_own_s,
                                   s->finish_s};
    fw_text_printf(out, "\t%s=", planned_word);
    for (int i = 0; i < PLANNED; i++) {
        fw_text_add(out, i ? " " : "");
        fw_text_number(out, value[i], 6);
    }
}

static fw_status read_planned(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e,
                              const char *text) {
    double value[PLANNED];
    int n = 0;
    if (r->fresh)
        return fw_diag_error(r->diags, 282, r->place,
                             "planned= is written by the program, from the plan and what was set");
    fw_word word;
    for (const char *at = text; fw_word_next(&at, " ", &word); n++)
        if (n == PLANNED || !fw_number_parse(word.at, word.length, &value[n]))
            return fw_diag_error(r->diags, 282, r->place, "planned=%s is not %d numbers", text,
                                 PLANNED);
    if (n != PLANNED)
        return fw_diag_error(r->diags, 282, r->place, "planned=%s is not %d numbers", text,
                             PLANNED);
    fw_process_step *s = fw_arena_array(r->arena, fw_process_step, 1);
    FW_NEED(s);
    *s = *e->step;
    s->time = (fw_process_time){.computable = true,
                                .nominal_s = value[0],
                                .first_look_s = value[1],
                                .stop_s = value[2],
                                .slowed = 1.0};
    s->booked_s = value[3], s->booked_stop_s = value[4];
    s->booked_stop_own_s = value[5], s->finish_s = value[6];
    const bool alike = e->step->time.computable &&
                       fabs(s->time.stop_s - e->step->time.stop_s) <= 1e-5 * s->time.stop_s &&
                       fabs(s->booked_stop_s - e->step->booked_stop_s) <= 1e-5 * s->booked_stop_s;
    e->as_set = alike ? e->step : s;
    return FW_OK;
}

static fw_status read_word(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e,
                           const char *name, const char *value) {
    const struct {
        const char *name;
        const char **text;
    } field[] = {
        {"start", &e->start},         {"end", &e->end},          {"by", &e->by},
        {"second", &e->second},       {"tool", &e->tool},        {"bath", &e->bath},
        {"note", &e->note},           {"wafer", &e->wafer},      {"instrument", &e->instrument},
        {"deviation", &e->deviation}, {"replaces", &e->replaces}};
    double time_s, ahead_s;
    for (size_t i = 0; i < sizeof field / sizeof field[0]; i++) {
        if (strcmp(field[i].name, name) != 0) continue;
        if (*field[i].text)
            return fw_diag_error(r->diags, 282, r->place, "%s is given twice", name);
        *field[i].text = value;
        const bool is_time = field[i].text == &e->start || field[i].text == &e->end;
        if (is_time && !fw_recipe_asrun_time_read(value, &time_s, &ahead_s))
            return fw_diag_error(r->diags, 282, r->place,
                                 "%s=%s is not a time; write 2026-11-20T10:00, local time of the "
                                 "laboratory, or 2026-11-20T10:00+01:00, 2026-11-20T09:00Z with "
                                 "how far it is ahead of UTC",
                                 name, value);
        return field[i].text == &e->wafer ? check_wafer(r, value) : FW_OK;
    }
    for (fw_recipe_fate fate = FW_FATE_HELD; fate <= FW_FATE_SCRAPPED; fate++)
        if (strcmp(name, fw_recipe_fate_word(fate)) == 0) return read_fate(r, e, fate, value);
    if (strcmp(name, planned_word) == 0 && !fw_recipe_asrun_accept(e->step, name))
        return read_planned(r, e, value);
    if (!r->fresh && fw_recipe_asrun_is_limits(name)) /* of its own plan they are the flow's */
        return r->bound ? FW_OK : fw_recipe_asrun_take_limits(r->arena, e, name, value);
    if (strncmp(name, "set ", 4) == 0) return read_setting(r, e, name + 4, value);
    if (strcmp(name, "coupon") == 0) return read_coupon(r, e, value);
    if (r->bound || r->former) return read_measure(r, e, name, value);
    fw_diags quiet =
        fw_diags_new(r->arena); /* it was looked at with its plan, where it was written */
    fw_recipe_asrun_reader without = *r;
    without.diags = &quiet;
    const fw_status status = read_measure(&without, e, name, value);
    return status == FW_INPUT ? FW_OK : status;
}

/* an entry of what became of a wafer is of that wafer, and of nothing else */
static fw_status check_alone(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e) {
    if (!e->wafer)
        return fw_diag_error(r->diags, 282, r->place,
                             "%s= is of one wafer: add wafer=, and an entry for each of several",
                             fw_recipe_fate_word(e->fate));
    if (e->nmeasured || e->nset || e->ncoupon || e->end_s != e->start_s)
        return fw_diag_error(r->diags, 282, r->place,
                             "%s= is an entry of its own, at one time and without values: log what "
                             "was run and measured of wafer %s with an entry of the step before it",
                             fw_recipe_fate_word(e->fate), e->wafer);
    return r->fresh ? check_fate(r, e) : FW_OK;
}

/* the entry that it takes the place of is one of the same step and wafer before it, which no other one took the place of */
static fw_status check_replaced(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *of = NULL;
    for (int i = 0; i < r->run->nentry; i++)
        if (fw_recipe_asrun_replaces(e, &r->run->entry[i])) of = &r->run->entry[i];
    const char *wrong = !of                                  ? "no entry of the log stands there"
                        : of->step != e->step                ? "it is of another step"
                        : !fw_text_same(of->wafer, e->wafer) ? "it is not of the same wafer"
                        : fw_recipe_asrun_taken_back(r->run, of)
                            ? "another entry took its place already"
                            : NULL;
    if (!wrong) return FW_OK;
    return fw_diag_error(r->diags, 282, r->place,
                         "replaces=%s: %s; give the line of the log that this entry stands for",
                         e->replaces, wrong);
}

/* what no entry may lack */
static fw_status check_entry(const fw_recipe_asrun_reader *r, const fw_recipe_asrun_entry *e) {
    const char *lacks = !e->start ? "start" : !e->end ? "end" : !e->by ? "by" : NULL;
    if (lacks)
        return fw_diag_error(r->diags, 282, r->place, "the entry of step %s lacks %s=%s",
                             e->step->id, lacks,
                             e->fate == FW_FATE_RUN ? ""
                             : lacks[0] == 's'      ? ", when it was seen"
                                                    : ", who says so");
    if (e->end_s < e->start_s)
        return fw_diag_error(r->diags, 282, r->place, "step %s ends before it starts", e->step->id);
    if (e->fate != FW_FATE_RUN) return check_alone(r, e);
    if (e->replaces) FW_TRY(check_replaced(r, e));
    if (e->step->second_signature && (!e->second || strcmp(e->second, e->by) == 0))
        return fw_diag_error(r->diags, 282, r->place,
                             "step %s is never done alone: add second= with the initials of the "
                             "other person",
                             e->step->id);
    return FW_OK;
}

/* is it what the step measures, what its sheet has a line for, or a word of ours? */
static bool is_name(const fw_recipe_asrun_reader *r, const fw_process_step *step,
                    const char *name) {
    fw_recipe_row *row;
    int n;
    for (int i = 0; i < OWN_WORDS; i++)
        if (strcmp(own_words[i], name) == 0) return true;
    if (strncmp(name, "set ", 4) != 0) return measure_named(step, name);
    if (fw_recipe_step_rows(r->arena, step, &row, &n) != FW_OK) return false;
    for (int i = 0; i < n; i++)
        if (row[i].name && strcmp(row[i].name, name + 4 + strspn(name + 4, " ")) == 0) return true;
    return false;
}

/* the = behind the name, which may have one itself: "set time for the narrowest slot (S = 0.1)=100 min" */
static char *equal_of(const fw_recipe_asrun_reader *r, const fw_process_step *step, char *word) {
    char *first = strchr(word, '=');
    if (!first || !step || !r->bound || !strchr(first + 1, '=')) return first;
    for (char *at = first; at; at = strchr(at + 1, '=')) {
        *at = '\0';
        const bool known = is_name(r, step, word);
        *at = '=';
        if (known) return at;
    }
    return first;
}

/* ---- a step as it was set ---- */

/* what an entry sets, SI; of what was not known as exactly as it is written, else as what was planned */
static bool read_set(const fw_recipe_set *set, fw_process_set *as) {
    fw_quantity_unit unit;
    if (!set->q || isnan(set->value) ||
        !fw_quantity_unit_parse(set->q->unit, strlen(set->q->unit), &unit, NULL, NULL))
        return false;
    *as = (fw_process_set){.planned = set->q,
                           .value = fw_quantity_unit_to_si(&unit, set->value),
                           .uncertainty = set->q->uncertainty};
    unit.offset = 0.0;
    if (set->q->unknown)
        as->uncertainty = fw_quantity_unit_to_si(&unit, fw_process_written_uncertainty(set->text));
    return true;
}

/* an entry of the same run, which says what was read of it afterwards, or puts it right */
static bool same_run(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return a->step == b->step && fw_text_same(a->wafer, b->wafer) && a->start_s == b->start_s;
}

fw_status fw_recipe_asrun_as_set(fw_arena *arena, const fw_recipe_asrun *run,
                                 const fw_recipe_asrun_entry *e, bool anew,
                                 const fw_process_step **as_set) {
    int n = 0, most = e->nset + (anew ? e->step->nargument : 0);
    *as_set = e->step;
    for (int i = 0; i < run->nentry; i++)
        if (same_run(&run->entry[i], e)) most += run->entry[i].nset;
    if (most == 0) return FW_OK;
    fw_process_set *set = fw_arena_array(arena, fw_process_set, (size_t)most);
    FW_NEED(set);
    for (int i = 0; anew && i < e->step->nargument; i++) {
        const fw_quantity *q = e->step->argument[i].q;
        if (!q->unknown) set[n++] = (fw_process_set){q, q->value, q->uncertainty};
    }
    for (int i = 0; i <= run->nentry; i++) { /* the last one says how it was */
        const fw_recipe_asrun_entry *of = i < run->nentry ? &run->entry[i] : e;
        for (int k = 0; k < of->nset && (of == e || same_run(of, e)); k++)
            n += read_set(&of->set[k], &set[n]);
    }
    return fw_process_step_as_set(arena, e->step, set, n, as_set);
}

static fw_status take_settings(const fw_recipe_asrun_reader *r, fw_recipe_asrun_entry *e) {
    if (!r->bound && e->as_set) return FW_OK; /* by its line */
    e->as_set = e->step;
    if (!r->bound || !e->step) return FW_OK;
    return fw_recipe_asrun_as_set(r->arena, r->run, e, false, &e->as_set);
}

fw_status fw_recipe_asrun_entry_read(const fw_recipe_asrun_reader *r, const char *words, size_t n,
                                     char separator, fw_recipe_asrun_entry *e) {
    char *copy = fw_arena_strndup(r->arena, words, n);
    FW_NEED(copy);
    *e = (fw_recipe_asrun_entry){
        .start_s = (double)NAN, .end_s = (double)NAN, .line = r->place.line, .former = r->former};
    size_t most = 1;
    for (const char *s = copy; *s; s++)
        most += *s == separator;
    FW_NEED(e->measured = fw_arena_array(r->arena, fw_recipe_measured, most));
    FW_NEED(e->set = fw_arena_array(r->arena, fw_recipe_set, most));
    FW_NEED(e->coupon = fw_arena_array(r->arena, fw_recipe_coupon, most));
    for (char *at = copy; at;) {
        char *word = fw_recipe_asrun_word(&at, separator);
        if (!word[0]) continue;
        char *equal = equal_of(r, e->step, word);
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
        /* whoever wrote the log: it is shown on terminals and pages */
        const char *value = fw_text_shown(r->arena, equal + 1, strlen(equal + 1));
        const char *name = fw_text_shown(r->arena, word, strlen(word));
        FW_NEED(value);
        FW_NEED(name);
        FW_TRY(read_word(r, e, name, value));
    }
    if (!e->step)
        return fw_diag_error(r->diags, 282, r->place,
                             "the entry names no step; add step= with its id");
    e->at = e->step;
    if (e->fate != FW_FATE_RUN && !e->end) e->end = e->start;
    FW_TRY(fw_recipe_asrun_times(r, e));
    int there = 0;
    for (int i = 0; i < r->run->nwafer; i++)
        there += !fw_recipe_asrun_out(r->run, r->run->wafer[i], e->start_s);
    e->loads = fw_process_step_is_of_lot(e->step)
                   ? fw_process_step_times(r->flow, e->step, r->run->nwafer)
               : e->wafer ? 1
                          : (there + e->step->batch - 1) / e->step->batch;
    if (e->loads < 1) e->loads = 1; /* a log of before there were wafers */
    FW_TRY(check_entry(r, e));
    FW_TRY(take_settings(r, e));
    if (e->fate != FW_FATE_RUN)
        e->step = NULL;
    else if (r->fresh)
        return check_there(r, e, there);
    return FW_OK;
}
