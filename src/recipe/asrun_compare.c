/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The log against the plan: durations against their windows, waiting times against their limits, measured values against
   what is accepted, settings against what was planned; as text and as JSON. */
#include "base/json.h"
#include "base/text.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe_words.h"
#include <math.h>
#include <string.h>

/* ---- what of a log is out of its limits ---- */

/* of one wafer, or both of the whole lot */
static bool same_wafer(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return a->wafer == b->wafer || (a->wafer && b->wafer && strcmp(a->wafer, b->wafer) == 0);
}

bool fw_recipe_asrun_is_last(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && same_wafer(later, e)) return false;
    return true;
}

/* A step is booked with its over-etch, its pauses and what is finished at the bench, and is logged from its start to its
   end, or to the end of the etch alone: short is below the first look, long above the stop time with all of that. A clock
   that was read to the minute leaves up to a minute either way. */
static const char *in_time(const fw_recipe_asrun_entry *e) {
    const bool to_the_second = strlen(e->start) > 16 && strlen(e->end) > 16;
    const double actual_s = e->end_s - e->start_s, read_s = to_the_second ? 0.0 : 60.0;
    if (!e->step->time.computable) return "no plan";
    if (actual_s + read_s < e->step->time.first_look_s) return "short";
    return actual_s - read_s > e->step->booked_stop_s * e->loads ? "long" : "in window";
}

const fw_process_accept *fw_recipe_asrun_accept(const fw_process_step *step, const char *measure) {
    for (int i = 0; i < step->naccept; i++)
        if (strcmp(step->accept[i].measure, measure) == 0) return &step->accept[i];
    return NULL;
}

double fw_recipe_asrun_limit(const char *text, double absent) {
    double value;
    return text[0] && fw_number_parse(text, strlen(text), &value) ? value : absent;
}

static bool inside(const char *low, const char *high, double value) {
    return value >= fw_recipe_asrun_limit(low, -(double)INFINITY) &&
           value <= fw_recipe_asrun_limit(high, (double)INFINITY);
}

bool fw_recipe_asrun_accepted(const fw_process_accept *a, const fw_recipe_measured *m) {
    if (isnan(m->number)) return !strstr(m->value, "no"); /* yes, at every site */
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        if (!isnan(m->site[i]) && !inside(a->low, a->high, m->site[i])) return false;
    return true;
}

bool fw_recipe_asrun_allowed(const fw_recipe_set *set) {
    return isnan(set->value) || inside(set->low, set->high, set->value);
}

/* waited from the end of the step that the lag names; NaN: that step is not in the log */
static double waited(const fw_recipe_asrun *run, const fw_process_lag *lag,
                     const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *from = NULL;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *other = &run->entry[i];
        bool of_it = !other->wafer || !e->wafer || strcmp(other->wafer, e->wafer) == 0;
        if (of_it && strcmp(other->step->id, lag->from) == 0) from = other;
    }
    return from ? e->start_s - from->end_s : (double)NAN;
}

static bool wait_is_fine(const fw_process_lag *lag, double wait_s) {
    return !(wait_s < lag->min_s) && !(wait_s > lag->max_s); /* NaN: no limit, or not known */
}

/* ---- the list of what is out ---- */

typedef struct builder {
    fw_arena *arena;
    fw_recipe_deviation *item;
    int n;
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
    b->item[b->n++] = (fw_recipe_deviation){e, what, planned->data, actual->data};
    return FW_OK;
}

/* "48 to 52", "at most 52" */
static void put_span(fw_text *out, const char *low, const char *high) {
    const char *between = low[0] && high[0] ? " to " : low[0] ? " or more" : "at most ";
    fw_text_printf(out, "%s%s%s", low, between, high);
}

/* the limits of a wait */
static void put_wait(fw_text *out, const fw_process_lag *lag) {
    fw_schedule_put_duration(out, isnan(lag->min_s) ? 0.0 : lag->min_s);
    fw_text_add(out, isnan(lag->max_s) ? " or more" : " to ");
    if (!isnan(lag->max_s)) fw_schedule_put_duration(out, lag->max_s);
}

static void put_unit(fw_text *out, const char *unit) {
    if (strcmp(unit, "1") != 0) fw_text_printf(out, " %s", unit);
}

static fw_status durations_of(builder *b, const fw_recipe_asrun_entry *e) {
    double actual = e->end_s - e->start_s;
    const char *judged = in_time(e);
    if (strcmp(judged, "short") != 0 && strcmp(judged, "long") != 0) return FW_OK;
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    fw_schedule_put_duration(&planned, e->step->booked_s * e->loads);
    fw_text_add(&planned, " at the machine; from the first look at ");
    fw_schedule_put_duration(&planned, e->step->time.first_look_s);
    fw_text_add(&planned, " to ");
    fw_schedule_put_duration(&planned, e->step->booked_stop_s * e->loads);
    fw_text_add(&planned, ", with the stop time");
    fw_schedule_put_duration(&is, actual);
    return add(b, e, "duration", &planned, &is);
}

static fw_status values_of(builder *b, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        if (fw_recipe_asrun_accepted(a, m)) continue;
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        bool word = isnan(m->number);
        if (word) {
            fw_text_add(&planned, "yes");
            fw_text_add(&is, m->value);
        } else {
            put_span(&planned, a->low, a->high);
            put_unit(&planned, a->unit);
        }
        for (int k = 0, n = 0; k < FW_RECIPE_SITES && !word; k++) {
            if (isnan(m->site[k]) || inside(a->low, a->high, m->site[k])) continue;
            fw_text_add(&is, n++ ? ", " : "");
            fw_recipe_put_value(&is, m->site[k]);
            put_unit(&is, a->unit);
            if (m->nsite > 1) fw_text_printf(&is, " (%s)", fw_recipe_site_name[k]);
        }
        FW_TRY(add(b, e, m->measure, &planned, &is));
    }
    return FW_OK;
}

static fw_status settings_of(builder *b, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        if (fw_recipe_asrun_allowed(s)) continue;
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        if (!s->q->unknown) {
            fw_recipe_put_value(&planned, fw_quantity_in_unit(s->q));
            fw_text_add(&planned, "; ");
        }
        put_span(&planned, s->low, s->high);
        put_unit(&planned, s->q->unit);
        fw_recipe_put_value(&is, s->value);
        put_unit(&is, s->q->unit);
        FW_TRY(add(b, e, fw_arena_printf(b->arena, "setting %s", s->name), &planned, &is));
    }
    return FW_OK;
}

static fw_status waits_of(builder *b, const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (int i = 0; i < e->step->nlag; i++) {
        const fw_process_lag *l = &e->step->lag[i];
        double wait = waited(run, l, e);
        if (wait_is_fine(l, wait)) continue;
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        put_wait(&planned, l);
        fw_schedule_put_duration(&is, fmax(wait, 0.0));
        FW_TRY(add(b, e, fw_arena_printf(b->arena, "wait since %s", l->from), &planned, &is));
    }
    return FW_OK;
}

fw_status fw_recipe_asrun_deviations(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_recipe_asrun *run, fw_recipe_deviation **list,
                                     int *n) {
    builder b = {.arena = arena};
    for (int s = 0; s < flow->nstep; s++)
        for (int i = 0; i < run->nentry; i++) {
            const fw_recipe_asrun_entry *e = &run->entry[i];
            if (e->step != &flow->step[s] || !fw_recipe_asrun_is_last(run, e)) continue;
            FW_TRY(durations_of(&b, e));
            FW_TRY(values_of(&b, e));
            FW_TRY(settings_of(&b, e));
            FW_TRY(waits_of(&b, run, e));
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

static void put_measured(fw_text *out, const fw_recipe_asrun_entry *e,
                         const fw_recipe_measured *m) {
    const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
    bool fine = fw_recipe_asrun_accepted(a, m), yes = isnan(m->number);
    bool unit = !yes && strcmp(a->unit, "1") != 0;
    fw_text_printf(out, "      %s = ", m->measure);
    if (yes)
        fw_text_add(out, m->value);
    else
        fw_recipe_put_value(out, m->number);
    fw_text_printf(out, "%s%s", unit ? " " : "", unit ? a->unit : "");
    if (m->nsite > 1) fw_text_printf(out, ", mean of %d sites", m->nsite);
    fw_text_printf(out, ": %s", fine ? "accepted" : "OUT of ");
    if (!fine && yes)
        fw_text_add(out, "yes");
    else if (!fine)
        put_span(out, a->low, a->high);
    fw_text_add(out, "\n");
}

static void put_setting(fw_text *out, const fw_recipe_set *s) {
    fw_text_printf(out, "      set %s = %s", s->name, s->text);
    if (s->q && !s->q->unknown) {
        fw_text_add(out, ", planned ");
        fw_recipe_put_value(out, fw_quantity_in_unit(s->q));
    }
    if (!fw_recipe_asrun_allowed(s)) {
        fw_text_add(out, ": OUT of ");
        put_span(out, s->low, s->high);
    }
    fw_text_add(out, "\n");
}

static void details(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_text *out) {
    for (int i = 0; i < e->nmeasured; i++)
        put_measured(out, e, &e->measured[i]);
    for (int i = 0; i < e->nset; i++)
        put_setting(out, &e->set[i]);
    for (int i = 0; i < e->ncoupon; i++)
        fw_text_printf(out, "      coupon %s\n", e->coupon[i].text);
    for (int i = 0; i < e->step->nlag; i++) {
        const fw_process_lag *l = &e->step->lag[i];
        double wait = waited(run, l, e);
        if (isnan(wait) || wait_is_fine(l, wait)) continue;
        fw_text_printf(out, "      waited ");
        fw_schedule_put_duration(out, fmax(wait, 0.0));
        fw_text_printf(out, " since %s: OUT of ", l->from);
        put_wait(out, l);
        fw_text_add(out, "\n");
    }
    if (e->note) fw_text_printf(out, "      note: %s\n", e->note);
}

typedef struct total {
    int logged, out, repeated;
    double planned_s, actual_s;
} total;

static fw_status sum_up(const fw_process_flow *flow, const fw_recipe_asrun *run, fw_arena *arena,
                        total *t) {
    fw_recipe_deviation *list;
    *t = (total){0};
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        bool any = false;
        for (int k = 0; k < run->nentry; k++) {
            const fw_recipe_asrun_entry *e = &run->entry[k];
            if (e->step != s) continue;
            any = true;
            if (!fw_recipe_asrun_is_last(run, e)) {
                t->repeated++;
                continue;
            }
            t->actual_s += e->end_s - e->start_s;
            if (s->time.computable) t->planned_s += s->booked_s;
        }
        t->logged += any;
    }
    return fw_recipe_asrun_deviations(arena, flow, run, &list, &t->out);
}

static int times_of(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *last) {
    int times = 0;
    for (const fw_recipe_asrun_entry *e = run->entry; e <= last; e++)
        times += e->step == last->step && same_wafer(e, last);
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
    fw_text_printf(out, "  %-9s %s", e ? in_time(e) : "open", s->title);
    if (e && e->wafer) fw_text_printf(out, ", wafer %s", e->wafer);
    if (e && times_of(run, e) > 1) fw_text_printf(out, " (run %d times)", times_of(run, e));
    fw_text_add(out, "\n");
    if (e) details(run, e, out);
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

fw_status fw_recipe_asrun_write_text(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out) {
    fw_text_printf(out, "as run: flow %s%s%s, plan %.12s\n\n", flow->id, run->lot ? ", lot " : "",
                   run->lot ? run->lot : "", run->plan);
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
    }
    total t;
    FW_TRY(sum_up(flow, run, out->arena, &t));
    fw_text_printf(out,
                   "\n%d of %d steps run, %d repeated, %d outside of their limits; planned "
                   "at the machine ",
                   t.logged, flow->nstep, t.repeated, t.out);
    fw_schedule_put_duration(out, t.planned_s);
    fw_text_add(out, " for them, actual ");
    fw_schedule_put_duration(out, t.actual_s);
    fw_text_add(out, "\n");
    put_read_again(run, out);
    return fw_text_end(out);
}

/* ---- planned against actual, as JSON ---- */
static void put_number(fw_json *out, const char *key, double value) {
    fw_json_number(out, key, value, FW_PLAIN_DIGITS);
}

/* what nobody wrote down is left out */
static void put_text(fw_json *out, const char *key, const char *value) {
    if (value) fw_json_text(out, key, value);
}

static void sites_json(const fw_recipe_measured *m, fw_json *out) {
    if (m->nsite < 2) return;
    fw_json_object(out, "sites");
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        if (!isnan(m->site[i])) put_number(out, fw_recipe_site_name[i], m->site[i]);
    fw_json_end(out);
}

static void measured_json(const fw_recipe_asrun_entry *e, fw_json *out) {
    fw_json_list(out, "measured");
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "measure", m->measure);
        if (isnan(m->number))
            put_text(out, "value", m->value);
        else
            put_number(out, "value", m->number);
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        put_text(out, "unit", a->unit);
        fw_json_truth(out, "accepted", fw_recipe_asrun_accepted(a, m));
        sites_json(m, out);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void settings_json(const fw_recipe_asrun_entry *e, fw_json *out) {
    fw_json_list(out, "settings");
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "name", s->name);
        if (isnan(s->value))
            put_text(out, "value", s->text);
        else
            put_number(out, "value", s->value);
        put_number(out, "planned", s->q->unknown ? (double)NAN : fw_quantity_in_unit(s->q));
        put_text(out, "unit", s->q->unit);
        fw_json_truth(out, "accepted", fw_recipe_asrun_allowed(s));
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "coupons");
    for (int i = 0; i < e->ncoupon; i++)
        fw_json_text(out, NULL, e->coupon[i].text);
    fw_json_end(out);
}

static void waited_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_json *out) {
    fw_json_list(out, "waited");
    for (int i = 0; i < e->step->nlag; i++) {
        const fw_process_lag *l = &e->step->lag[i];
        double wait = waited(run, l, e);
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

static void entry_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_json *out) {
    put_text(out, "wafer", e->wafer);
    put_text(out, "start", e->start);
    put_text(out, "end", e->end);
    put_number(out, "actual_s", e->end_s - e->start_s);
    put_text(out, "judged", in_time(e));
    put_text(out, "by", e->by);
    put_text(out, "second", e->second);
    put_text(out, "tool", e->tool);
    put_text(out, "instrument", e->instrument);
    put_text(out, "bath", e->bath);
    put_text(out, "note", e->note);
    measured_json(e, out);
    settings_json(e, out);
    waited_json(run, e, out);
}

/* the last entry of a step itself, and the last ones of its other wafers in a list */
static void runs_json(const fw_recipe_asrun *run, const fw_process_step *s, fw_json *out) {
    const fw_recipe_asrun_entry *last = NULL;
    int times = 0, wafers = 0;
    for (int k = 0; k < run->nentry; k++) {
        if (run->entry[k].step != s) continue;
        last = &run->entry[k];
        times++;
        wafers += fw_recipe_asrun_is_last(run, last);
    }
    fw_json_whole(out, "times", times);
    if (last) entry_json(run, last, out);
    if (wafers < 2) return;
    fw_json_list(out, "others");
    for (int k = 0; k < run->nentry; k++) {
        const fw_recipe_asrun_entry *e = &run->entry[k];
        if (e->step != s || e == last || !fw_recipe_asrun_is_last(run, e)) continue;
        fw_json_object(out, NULL);
        entry_json(run, e, out);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static fw_status deviations_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                 fw_json *out, fw_arena *arena) {
    fw_recipe_deviation *list;
    int n;
    FW_TRY(fw_recipe_asrun_deviations(arena, flow, run, &list, &n));
    fw_json_list(out, "deviations");
    for (int i = 0; i < n; i++) {
        fw_json_object(out, NULL);
        fw_json_text(out, "step", list[i].entry->step->id);
        put_text(out, "wafer", list[i].entry->wafer);
        fw_json_text(out, "what", list[i].what);
        fw_json_text(out, "planned", list[i].planned);
        fw_json_text(out, "actual", list[i].actual);
        fw_json_end(out);
    }
    fw_json_end(out);
    return FW_OK;
}

static void read_again_json(const fw_recipe_asrun *run, fw_json *out) {
    int i = 0, k = 0;
    fw_json_list(out, "read_again");
    for (fw_recipe_read_again a; fw_recipe_asrun_read_again(run, &i, &k, &a);) {
        fw_json_object(out, NULL);
        fw_json_text(out, "step", a.entry->step->id);
        put_text(out, "wafer", a.entry->wafer);
        fw_json_whole(out, "line", a.entry->line);
        fw_json_text(out, "coupon", a.coupon->text);
        fw_json_whole(out, "by_line", a.by->line);
        fw_json_text(out, "by_coupon", a.by_coupon->text);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void set_json(const char *name, const fw_quantity *q, fw_json *out) {
    fw_json_object(out, NULL);
    fw_json_text(out, "name", name);
    put_number(out, "planned", q->unknown ? (double)NAN : fw_quantity_in_unit(q));
    fw_json_text(out, "unit", q->unit);
    fw_json_end(out);
}

/* what an entry of the step may say: what is measured and within which limits, and what is set */
static void asked_json(const fw_process_step *s, fw_json *out) {
    fw_json_list(out, "measures");
    for (int i = 0; i < s->naccept; i++) {
        const fw_process_accept *a = &s->accept[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "measure", a->measure);
        fw_json_text(out, "low", a->low);
        fw_json_text(out, "high", a->high);
        fw_json_text(out, "unit", a->unit);
        fw_json_whole(out, "sites", a->sites);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "sets");
    for (int i = 0; i < s->nsetting; i++)
        set_json(s->setting[i].name, s->setting[i].q, out);
    for (int i = 0; i < s->nderived; i++)
        if (s->derived[i]->id) set_json(s->derived[i]->id, s->derived[i], out);
    fw_json_end(out);
}

fw_status fw_recipe_asrun_write_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    put_text(out, "schema", "flexwright.as-run/1");
    put_text(out, "flow", flow->id);
    put_text(out, "lot", run->lot);
    if (run->nwafer > 0) {
        fw_json_list(out, "wafers");
        for (int i = 0; i < run->nwafer; i++)
            fw_json_text(out, NULL, run->wafer[i]);
        fw_json_end(out);
    }
    put_text(out, "plan_sha256", run->plan);
    put_text(out, "chain", run->chain[0] ? run->chain : NULL);
    fw_json_whole(out, "entries", run->nentry);
    fw_json_list(out, "steps");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        const fw_process_time *p = &s->time;
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", s->id);
        fw_json_text(out, "title", s->title);
        put_number(out, "planned_s", p->computable ? p->nominal_s : (double)NAN);
        put_number(out, "first_look_s", p->computable ? p->first_look_s : (double)NAN);
        put_number(out, "stop_s", p->computable ? p->stop_s : (double)NAN);
        put_number(out, "at_machine_s", p->computable ? s->booked_s : (double)NAN);
        put_number(out, "at_machine_most_s", p->computable ? s->booked_stop_s : (double)NAN);
        runs_json(run, s, out);
        asked_json(s, out);
        fw_json_end(out);
    }
    total t;
    FW_TRY(sum_up(flow, run, text->arena, &t));
    fw_json_end(out);
    fw_json_whole(out, "logged", t.logged);
    fw_json_whole(out, "repeated", t.repeated);
    fw_json_whole(out, "outside", t.out);
    put_number(out, "at_machine_s", t.planned_s);
    put_number(out, "actual_s", t.actual_s);
    FW_TRY(deviations_json(flow, run, out, text->arena));
    read_again_json(run, out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}
