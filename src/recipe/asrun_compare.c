/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The log against the plan: durations against their windows, waiting times against their limits, measured values against
   what is accepted, settings against what was planned; as text. */
#include "base/text.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

/* ---- the list of what is out ---- */

typedef struct builder {
    fw_arena *arena;
    fw_recipe_deviation *item;
    int n;
    bool repeated; /* of the entry that is looked at */
} builder;

static fw_status add(builder *b, const fw_recipe_asrun_entry *e, const char *what, fw_text *planned,
                     fw_text *actual) {
    FW_TRY(fw_text_end(planned));
    FW_TRY(fw_text_end(actual));
    FW_NEED(what);
    fw_recipe_deviation *grown =
        fw_arena_grow(b->arena, b->item, (size_t)b->n, (size_t)b->n + 1, sizeof *grown);
    FW_NEED(grown);
    b->item = grown;
    b->item[b->n++] = (fw_recipe_deviation){e, what, planned->data, actual->data, b->repeated};
    return FW_OK;
}

static void put_unit(fw_text *out, const char *unit) {
    if (strcmp(unit, "1") != 0) fw_text_printf(out, " %s", unit);
}

bool fw_recipe_asrun_is_gone_on(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && fw_recipe_asrun_goes_on_from(run, later) == e) return true;
    return false;
}

static fw_status odd_time_of(builder *b, const fw_recipe_asrun *run,
                             const fw_recipe_asrun_entry *e) {
    const char *no_time;
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    FW_TRY(fw_recipe_asrun_odd_time(b->arena, run, e, &no_time));
    if (!no_time) return FW_OK;
    fw_text_add(&planned, no_time);
    fw_schedule_put_duration(&is, e->end_s - e->start_s);
    return add(b, e, "duration", &planned, &is);
}

static fw_status durations_of(builder *b, const fw_recipe_asrun *run,
                              const fw_recipe_asrun_entry *e) {
    int together;
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    const double loads = runs.n > 1 ? 1.0 : fw_recipe_asrun_loads(run, e, &together);
    const char *judged = fw_recipe_asrun_in_time(run, e);
    double surely;
    const bool brief = strcmp(judged, "short") == 0;
    if ((!brief && strcmp(judged, "long") != 0) || (brief && fw_recipe_asrun_is_gone_on(run, e)))
        return FW_OK;
    fw_recipe_asrun_stop_by(run, e, &runs, &surely);
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    fw_schedule_put_duration(&planned, e->as_set->booked_s * loads);
    fw_text_add(&planned, " at the machine; from the first look at ");
    fw_schedule_put_duration(&planned, e->as_set->time.first_look_s);
    fw_text_add(&planned, " to ");
    fw_schedule_put_duration(&planned, surely);
    fw_text_add(&planned, ", with the stop time");
    if (runs.n > 1) fw_text_add(&planned, " and the handling of each run");
    if (e->as_set != e->step)
        fw_text_add(&planned, e->former ? ", by the plan of its line" : ", at what was set");
    fw_recipe_asrun_put_took(&is, e, &runs);
    return add(b, e, "duration", &planned, &is);
}

static fw_status at_once_of(builder *b, const fw_recipe_asrun *run,
                            const fw_recipe_asrun_entry *e) {
    const char *many, *allowed;
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    FW_TRY(fw_recipe_asrun_too_many(b->arena, run, e, &many, &allowed));
    if (!many) return FW_OK;
    fw_text_add(&planned, allowed);
    fw_text_add(&is, many);
    return add(b, e, "wafers at once", &planned, &is);
}

static fw_status bath_of_entry(builder *b, const fw_recipe_asrun *run,
                               const fw_recipe_asrun_entry *e) {
    const char *is, *allowed;
    FW_TRY(fw_recipe_asrun_bath_life(b->arena, run, e, &is, &allowed));
    if (!is) return FW_OK;
    fw_text planned = fw_text_new(b->arena), actual = fw_text_new(b->arena);
    fw_text_add(&planned, allowed);
    fw_text_add(&actual, is);
    return add(b, e, fw_arena_printf(b->arena, "bath %s", e->bath), &planned, &actual);
}

static fw_status values_of(builder *b, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        if (fw_recipe_asrun_accepted(m)) continue;
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        bool word = isnan(m->number);
        if (word) {
            fw_text_add(&planned, "yes");
            fw_text_add(&is, m->value);
        } else {
            fw_recipe_put_span(&planned, m->low, m->high);
            put_unit(&planned, a->unit);
            fw_recipe_asrun_put_out(m, a->unit, &is);
        }
        FW_TRY(add(b, e, m->measure, &planned, &is));
    }
    return FW_OK;
}

static fw_status amount_of(builder *b, const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    fw_recipe_amount_in_time a;
    FW_TRY(fw_recipe_asrun_amount_by_law(b->arena, run, e, &a, &planned, &is));
    if (a.fits || !fw_recipe_asrun_accepted(a.measured))
        return FW_OK; /* what is not accepted is in the list already */
    return add(b, e, fw_arena_printf(b->arena, "%s for its time", a.measured->measure), &planned,
               &is);
}

static fw_status settings_of(builder *b, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        if (fw_recipe_asrun_allowed(s)) continue;
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        if (!isnan(s->planned)) {
            fw_recipe_put_value(&planned, s->planned);
            fw_text_add(&planned, "; ");
        }
        fw_recipe_put_span(&planned, s->low, s->high);
        put_unit(&planned, s->q->unit);
        fw_recipe_asrun_put_set(s, &is);
        FW_TRY(add(b, e, fw_arena_printf(b->arena, "setting %s", s->name), &planned, &is));
    }
    return FW_OK;
}

static fw_status waits_of(builder *b, const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    const bool repeated = b->repeated; /* no other run puts right what the wafer waited before */
    int i = 0;
    for (fw_recipe_wait wait; fw_recipe_asrun_wait(run, e, &i, &wait);) {
        if (wait.fine) continue;
        b->repeated = repeated && !fw_recipe_asrun_wait_stands(run, e, &wait);
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        fw_recipe_put_wait_limits(&planned, &wait);
        if (wait.waited_s < 0.0)
            fw_recipe_put_waited(&is, &wait);
        else
            fw_schedule_put_duration(&is, wait.waited_s);
        const char *state = wait.is ? wait.is : "";
        FW_TRY(add(
            b, e,
            fw_arena_printf(b->arena, "wait since %s%s%s", wait.since, *state ? ", " : "", state),
            &planned, &is));
    }
    return FW_OK;
}

/* what was gone on without, though an earlier step was run again: is a later one in the log? */
static fw_status overtaken_of(builder *b, const fw_recipe_asrun *run,
                              const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *by = fw_recipe_asrun_overtaken(run, e, e->wafer);
    bool gone_on = false;
    for (int i = 0; by && i < run->nentry; i++) {
        const fw_recipe_asrun_entry *o = &run->entry[i];
        gone_on = gone_on || (o->step && o->step > e->step && o->start_s >= by->end_s &&
                              !fw_process_step_is_of_lot(o->step) &&
                              (!o->wafer || !e->wafer || fw_text_same(o->wafer, e->wafer)));
    }
    if (!gone_on) return FW_OK;
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    fw_text_printf(&planned, "once more after %s at %s (line %d)", by->step->id, by->start,
                   by->line);
    fw_text_printf(&is, "last at %s (line %d)", e->start, e->line);
    return add(b, e, "not run again", &planned, &is);
}

/* is a later entry of the same run, with what was read afterwards? Then that one has its times */
static bool goes_on(const fw_recipe_asrun *run, int i) {
    const fw_recipe_asrun_entry *e = &run->entry[i];
    for (int k = i + 1; k < run->nentry; k++) {
        const fw_recipe_asrun_entry *later = &run->entry[k];
        if (later->step == e->step && fw_text_same(e->wafer, later->wafer) &&
            later->start_s == e->start_s)
            return true;
    }
    return false;
}

fw_status fw_recipe_asrun_deviations(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_recipe_asrun *run, fw_recipe_deviation **list,
                                     int *n) {
    builder b = {.arena = arena};
    for (int s = 0; s < flow->nstep; s++)
        for (int i = 0; i < run->nentry; i++) {
            const fw_recipe_asrun_entry *e = &run->entry[i];
            if (e->step != &flow->step[s] || fw_recipe_asrun_taken_back(run, e)) continue;
            const bool last = fw_recipe_asrun_is_last(run, e), added = !last && goes_on(run, i);
            b.repeated = !last && !added;
            if (!added) FW_TRY(durations_of(&b, run, e));
            if (!added) FW_TRY(odd_time_of(&b, run, e));
            if (!added) FW_TRY(at_once_of(&b, run, e));
            if (!added) FW_TRY(bath_of_entry(&b, run, e));
            FW_TRY(values_of(&b, e));
            FW_TRY(amount_of(&b, run, e));
            FW_TRY(settings_of(&b, e));
            if (!added) FW_TRY(waits_of(&b, run, e));
            if (last) FW_TRY(overtaken_of(&b, run, e));
        }
    *list = b.item;
    *n = b.n;
    return FW_OK;
}

/* ---- planned against actual, as text ---- */

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

/* what was accepted of a wafer that was worked on again since */
static void put_overtaken(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                          fw_text *out) {
    const fw_recipe_asrun_entry *by = fw_recipe_asrun_overtaken(run, e, e->wafer);
    if (by)
        fw_text_printf(out,
                       "      overtaken: %s%s%s was run %s at %s (line %d); run and log this "
                       "step again\n",
                       by->step->id, by->wafer ? " of wafer " : "", by->wafer ? by->wafer : "",
                       fw_recipe_asrun_is_again(run, by, e, e->wafer) ? "again" : "after it",
                       by->start, by->line);
}

static void put_measured(fw_text *out, const fw_recipe_asrun_entry *e, bool overtaken,
                         const fw_recipe_measured *m) {
    const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
    bool fine = fw_recipe_asrun_accepted(m), yes = isnan(m->number), out_of = !fine && !overtaken;
    fw_text_printf(out, "      %s = ", m->measure);
    if (yes)
        fw_text_add(out, m->value);
    else
        fw_recipe_put_value(out, m->number);
    if (!yes) put_unit(out, a->unit);
    if (m->nsite > 1) fw_text_printf(out, ", mean of %d sites", m->nsite);
    fw_text_printf(out, ": %s", overtaken ? "of before" : fine ? "accepted" : "");
    if (out_of && m->nsite > 1) /* it is said of a site, and not of their mean */
        fw_recipe_asrun_put_out(m, a->unit, out);
    if (out_of) fw_text_printf(out, "%sOUT of %s", m->nsite > 1 ? " " : "", yes ? "yes" : "");
    if (out_of && !yes) {
        fw_recipe_put_span(out, m->low, m->high);
        put_unit(out, a->unit);
    }
    fw_text_add(out, "\n");
}

void fw_recipe_asrun_planned(const fw_quantity *q, double planned, fw_json *out) {
    if (q && q->word)
        fw_json_text(out, "planned", q->word);
    else
        fw_json_number(out, "planned", planned, FW_PLAIN_DIGITS);
}

void fw_recipe_asrun_put_set_beside_planned(const fw_recipe_set *s, fw_text *out) {
    fw_recipe_asrun_put_set(s, out);
    if (s->q && s->q->word) fw_text_printf(out, ", planned %s", s->q->word);
    if (isnan(s->planned) || (s->q && s->q->word)) return;
    fw_text_add(out, ", planned ");
    fw_recipe_put_value(out, s->planned);
    put_unit(out, s->q->unit);
}

static void put_setting(fw_text *out, const fw_recipe_set *s) {
    fw_text_printf(out, "      set %s = ", s->name);
    fw_recipe_asrun_put_set_beside_planned(s, out);
    if (!fw_recipe_asrun_allowed(s)) {
        fw_text_add(out, ": OUT of ");
        fw_recipe_put_span(out, s->low, s->high);
        put_unit(out, s->q->unit);
    }
    fw_text_add(out, "\n");
}

/* before the first run of e's wafer that it came to from there */
static void put_waits(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_text *out) {
    for (const fw_recipe_asrun_entry *o = e; o; o = fw_recipe_asrun_run_before(run, o)) {
        int next = 0;
        for (fw_recipe_wait wait; fw_recipe_asrun_wait(run, o, &next, &wait);) {
            if (wait.fine || (o != e && !fw_recipe_asrun_wait_stands(run, o, &wait))) continue;
            fw_text_add(out, "      ");
            fw_recipe_put_waited(out, &wait);
            fw_text_add(out, ": OUT of ");
            fw_recipe_put_wait_limits(out, &wait);
            fw_text_add(out, "\n");
        }
    }
}

/* the times that it is judged by, where they are others than those in the line above */
static void put_times_as_set(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                             fw_text *out) {
    const fw_process_step *s = e->as_set;
    if (s == e->step) return;
    fw_text_add(out, e->former ? "      by the plan of its line: " : "      at what was set: ");
    if (!s->time.computable) {
        fw_text_add(out, "the law has no time\n");
        return;
    }
    fw_schedule_put_duration(out, s->time.nominal_s);
    fw_text_add(out, ", first look ");
    fw_schedule_put_duration(out, s->time.first_look_s);
    fw_text_add(out, ", stop ");
    fw_schedule_put_duration(out, s->time.stop_s);
    fw_text_add(out, ", at the machine ");
    fw_schedule_put_duration(out, s->booked_s);
    if (fw_recipe_asrun_is_late_as_set(run, e))
        fw_text_add(out, "; it took longer, which may be what is finished at the bench");
    fw_text_add(out, "\n");
}

static void put_bath(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_text *out) {
    const char *is, *allowed;
    fw_text left = fw_text_new(out->arena), brief = fw_text_new(out->arena);
    if (fw_recipe_asrun_put_left_in_it(run, e, &left) && fw_text_end(&left) == FW_OK)
        fw_text_printf(out, "      %s; was the rest in it?\n", left.data);
    if (fw_recipe_asrun_put_inside(run, e, &brief) && fw_text_end(&brief) == FW_OK)
        fw_text_printf(out, "      %s; or was that without them?\n", brief.data);
    if (fw_recipe_asrun_bath_life(out->arena, run, e, &is, &allowed) == FW_OK && is)
        fw_text_printf(out, "      bath %s: %s: OUT, since %s\n", e->bath, is, allowed);
}

static void details(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_text *out) {
    const bool overtaken = fw_recipe_asrun_overtaken(run, e, e->wafer);
    for (int i = 0; i < e->nmeasured; i++)
        put_measured(out, e, overtaken, &e->measured[i]);
    for (int i = 0; i < e->nset; i++)
        put_setting(out, &e->set[i]);
    for (int i = 0; i < e->ncoupon; i++)
        fw_text_printf(out, "      coupon %s\n", e->coupon[i].text);
    put_waits(run, e, out);
    put_times_as_set(run, e, out);
    put_overtaken(run, e, out);
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    if (runs.n > 1) {
        const double stop = fw_recipe_asrun_stop_by(run, e, &runs, NULL);
        fw_text_add(out, "      adds up to ");
        fw_recipe_asrun_put_took(out, e, &runs);
        if (e->as_set->time.computable &&
            runs.time_s - runs.n * fw_recipe_asrun_clock_s(e) > stop) {
            fw_text_add(out, ", and one run is to stop by ");
            fw_schedule_put_duration(out, stop);
        }
        fw_text_add(out, "\n");
    }
    put_bath(run, e, out);
    if (e->note) fw_text_printf(out, "      note: %s\n", e->note);
}

/* of the last run of a wafer, and of those before it; planned is one */
static void sum_runs(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *last,
                     fw_recipe_asrun_total *t) {
    const fw_process_step *plan = last->former ? last->as_set : last->step; /* of its line */
    const bool known = plan->time.computable;
    for (const fw_recipe_asrun_entry *e = last; e; e = fw_recipe_asrun_run_before(run, e)) {
        if (!e->wafer && last->wafer) break; /* of the lot, which counts once */
        int together;
        const double loads = fw_recipe_asrun_loads(run, e, &together),
                     took = (e->end_s - e->start_s) / together;
        if (e == last && known) t->planned_s += plan->booked_s * loads / together;
        *(known ? &t->actual_s : &t->unplanned_s) += took;
        if (e != last && known) t->earlier_s += took;
    }
}

fw_status fw_recipe_asrun_sum_up(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                 fw_arena *arena, fw_recipe_asrun_total *t) {
    fw_recipe_deviation *list;
    *t = (fw_recipe_asrun_total){0};
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        bool any = false;
        for (int k = 0; k < run->nentry; k++) {
            const fw_recipe_asrun_entry *e = &run->entry[k];
            if (e->step != s) continue;
            any = true;
            if (fw_recipe_asrun_is_last(run, e))
                sum_runs(run, e, t);
            else if (!fw_recipe_asrun_is_gone_on(run, e) && !fw_recipe_asrun_taken_back(run, e))
                t->repeated++;
        }
        t->logged += any;
        for (int k = 0; k < run->nwafer; k++)
            t->left_out += fw_recipe_asrun_left_out(run, s, run->wafer[k]);
        if (run->nwafer == 0) t->left_out += fw_recipe_asrun_left_out(run, s, NULL);
        t->unplanned += any && !s->time.computable;
    }
    int n;
    FW_TRY(fw_recipe_asrun_deviations(arena, flow, run, &list, &n));
    for (int i = 0; i < n; i++)
        t->out += !list[i].repeated;
    return FW_OK;
}

static int times_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *last) {
    int times = 0;
    for (const fw_recipe_asrun_entry *e = run->entry; e <= last; e++)
        times += e->step == last->step && fw_text_same(e->wafer, last->wafer) &&
                 !fw_recipe_asrun_taken_back(run, e);
    return times;
}

/* e NULL: the step is open */
static void put_step(const fw_recipe_asrun *run, const fw_process_step *s,
                     const fw_recipe_asrun_entry *e, fw_text *out) {
    bool known = s->time.computable;
    const double cell[] = {
        known ? s->time.nominal_s : (double)NAN, known ? s->time.first_look_s : (double)NAN,
        known ? s->time.stop_s : (double)NAN,    known ? s->booked_s : (double)NAN,
        e ? e->end_s - e->start_s : (double)NAN,
    };
    fw_text_printf(out, "%-5s", s->id);
    for (int k = 0; k < 5; k++)
        put_cell(out, cell[k], 15);
    const bool overtaken = e && fw_recipe_asrun_overtaken(run, e, e->wafer);
    fw_text_printf(out, "  %-9s %s",
                   !e && run->nwafer == 0 && fw_recipe_asrun_left_out(run, s, NULL) ? "LEFT OUT"
                   : !e                                                             ? "open"
                   : overtaken                                                      ? "overtaken"
                               : fw_recipe_asrun_in_time(run, e),
                   s->title);
    if (e && e->wafer) fw_text_printf(out, ", wafer %s", e->wafer);
    if (e && times_of(run, e) > 1) fw_text_printf(out, " (run %d times)", times_of(run, e));
    fw_text_add(out, "\n");
    if (e) details(run, e, out);
}

/* wafers of which a step that others have run is not in the log yet, or that went on without it */
static void put_expected(const fw_recipe_asrun *run, const fw_process_step *s, bool any,
                         fw_text *out) {
    for (int gone_on = 0, n = 0; gone_on < 2; gone_on++, n = 0) {
        for (int i = 0; i < run->nwafer; i++) {
            const bool left = fw_recipe_asrun_left_out(run, s, run->wafer[i]);
            if (gone_on ? left : any && !left && fw_recipe_asrun_expects(run, s, run->wafer[i]))
                fw_text_printf(out, "%s%s",
                               n++       ? ", "
                               : gone_on ? "      LEFT OUT, and gone on without it: wafer "
                                         : "      not yet: wafer ",
                               run->wafer[i]);
        }
        if (n) fw_text_add(out, "\n");
    }
}

static void put_fates(const fw_process_flow *flow, const fw_recipe_asrun *run, fw_text *out) {
    int n = 0;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (e->fate == FW_FATE_RUN) continue;
        fw_text_printf(out, "%swafer %s: %s at %s, %s, by %s: %s\n", n++ ? "" : "\n", e->wafer,
                       fw_recipe_fate_word(e->fate), e->at->id, e->start, e->by, e->why);
    }
    if (n)
        fw_text_printf(out, "wafers: %d in, %d out, %d held\n", run->nwafer,
                       fw_recipe_asrun_count(flow, run, flow->nstep, FW_FATE_RUN),
                       fw_recipe_asrun_count(flow, run, flow->nstep, FW_FATE_HELD));
}

/* what was out in a run that another one put right; of the others the table above has it */
static fw_status put_repeated(const fw_process_flow *flow, const fw_recipe_asrun *run,
                              fw_text *out) {
    fw_recipe_deviation *list;
    int n, told = 0;
    FW_TRY(fw_recipe_asrun_deviations(out->arena, flow, run, &list, &n));
    for (int i = 0; i < n; i++) {
        const fw_recipe_asrun_entry *e = list[i].entry;
        if (!list[i].repeated) continue;
        fw_text_printf(out, "%s%s, %s%s, %s, by %s: %s was %s; allowed %s\n",
                       told++ ? "" : "\nout of limits in runs that were repeated:\n", e->step->id,
                       e->wafer ? "wafer " : "lot", e->wafer ? e->wafer : "", e->start, e->by,
                       list[i].what, list[i].actual, list[i].planned);
    }
    return FW_OK;
}

static void put_read_again(const fw_recipe_asrun *run, fw_text *out) {
    int i = 0, k = 0, n = 0;
    for (fw_recipe_read_again a; fw_recipe_asrun_read_again(run, &i, &k, &a); n++)
        fw_text_printf(
            out, "%s      line %d, %s: %s; line %d: %s\n",
            n ? "" : "\ncoupons that do not count, since a later line reads them again:\n",
            a.entry->line, a.entry->step->id, a.coupon->text, a.by->line, a.by_coupon->text);
    if (n) fw_text_add(out, FW_RECIPE_KEEP_BOTH "\n");
}

/* by what lines of former plans are judged */
static void put_former(const fw_recipe_asrun *run, fw_text *out) {
    int n = 0;
    if (run->nreplan == 0) return;
    fw_text_add(out, "lines before are judged by the times and the limits that stand in them, and "
                     "what wafers waited by the last plan\n");
    for (const fw_recipe_asrun_entry *e = run->entry; e < run->entry + run->nentry; e++) {
        bool any = false;
        for (int i = 0; i < e->nmeasured; i++)
            any = any || !isnan(e->measured[i].number);
        for (int i = 0; i < e->nset; i++)
            any = any || !isnan(e->set[i].value);
        if (!e->former || e->limited || !any) continue;
        fw_text_printf(out, "%s%d",
                       n++ ? ", " : "without limits, and judged by the last plan's: line ",
                       e->line);
    }
    if (n) fw_text_add(out, "\n");
}

void fw_recipe_asrun_put_clock(const fw_recipe_asrun *run, fw_text *out) {
    if (run->zone || run->nentry == 0) return;
    if (isnan(run->ahead_s)) {
        fw_text_add(out, "times without a zone: taken to be of one clock that is never changed; "
                         "where it was (in summer), what lies over the change is an hour off");
        return;
    }
    const long minutes = lround(fabs(run->ahead_s) / 60.0);
    fw_text_printf(out,
                   "times without a zone: those that do not say how far they are ahead of UTC are "
                   "taken to be %c%02ld:%02ld",
                   run->ahead_s < 0.0 ? '-' : '+', minutes / 60, minutes % 60);
}

fw_status fw_recipe_asrun_write_text(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out) {
    fw_text_printf(out, "as run: flow %s%s%s, plan %.12s%s%s\n", flow->id, run->lot ? ", lot " : "",
                   run->lot ? run->lot : "", run->plan, run->zone ? ", times of " : "",
                   run->zone ? run->zone : "");
    for (int i = 0; i < run->nreplan; i++)
        fw_text_printf(out, "from line %d on plan %.12s: %s, by %s%s%s\n", run->replan[i].line,
                       run->replan[i].plan, run->replan[i].start, run->replan[i].by,
                       run->replan[i].note ? ": " : "",
                       run->replan[i].note ? run->replan[i].note : "");
    put_former(run, out);
    fw_recipe_asrun_put_clock(run, out);
    fw_text_add(out, "\n\n");
    fw_text_printf(out, "%-5s %14s %14s %14s %14s %14s  %-9s %s\n", "step", "planned", "first look",
                   "stop", "at the machine", "actual", "judged", "title");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        bool any = false;
        for (int k = 0; k < run->nentry; k++) {
            const fw_recipe_asrun_entry *e = &run->entry[k];
            if (e->step != s || !fw_recipe_asrun_is_last(run, e)) continue;
            put_step(run, s, e, out);
            any = true;
        }
        if (!any) put_step(run, s, NULL, out);
        put_expected(run, s, any, out);
    }
    fw_recipe_asrun_total t;
    FW_TRY(fw_recipe_asrun_sum_up(flow, run, out->arena, &t));
    fw_text_printf(out, "\n%d of %d steps run, %d repeated, %d outside of their limits", t.logged,
                   flow->nstep, t.repeated, t.out);
    fw_text_add(out, "; planned at the machine ");
    fw_schedule_put_duration(out, t.planned_s);
    fw_text_add(out, t.unplanned ? " for those that have a planned time, actual "
                                 : " for them, actual ");
    fw_schedule_put_duration(out, t.actual_s);
    if (t.earlier_s > 0.0) {
        fw_text_add(out, ", of which ");
        fw_schedule_put_duration(out, t.earlier_s);
        fw_text_add(out, " in earlier runs");
    }
    if (t.unplanned) {
        fw_text_printf(out, "; %d without a planned time took ", t.unplanned);
        fw_schedule_put_duration(out, t.unplanned_s);
    }
    if (t.left_out) fw_text_printf(out, "; steps left out: %d", t.left_out);
    fw_text_add(out, "\n");
    put_fates(flow, run, out);
    FW_TRY(put_repeated(flow, run, out));
    fw_recipe_asrun_put_declared(run, out);
    put_read_again(run, out);
    return fw_text_end(out);
}
