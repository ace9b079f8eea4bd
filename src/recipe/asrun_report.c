/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planned against actual: durations against their windows, waiting times against their limits,
   measured values against what is accepted. */
#include "base/json.h"
#include "recipe/asrun.h"
#include "recipe/words.h"
#include <math.h>
#include <string.h>

/* the last entry of a step counts; NULL: none */
static const fw_asrun_entry *last_of(const fw_asrun *run, const fw_step *step, int *times) {
    const fw_asrun_entry *found = NULL;
    *times = 0;
    for (int i = 0; i < run->nentry; i++)
        if (run->entry[i].step == step) {
            found = &run->entry[i];
            ++*times;
        }
    return found;
}

static const char *in_time(const fw_time *planned, double actual_s) {
    if (!planned->computable) return "no plan";
    if (actual_s < planned->first_look_s) return "short";
    return actual_s > planned->stop_s ? "long" : "in window";
}

static const fw_accept *accept_of(const fw_step *step, const char *measure) {
    for (int i = 0; i < step->naccept; i++)
        if (strcmp(step->accept[i].measure, measure) == 0) return &step->accept[i];
    return NULL;
}

static bool accepted(const fw_accept *a, const fw_measured *m) {
    double low = -(double)INFINITY, high = (double)INFINITY;
    if (isnan(m->number)) return strcmp(m->value, "yes") == 0;
    if (a->low[0]) fw_number_parse(a->low, strlen(a->low), &low);
    if (a->high[0]) fw_number_parse(a->high, strlen(a->high), &high);
    return m->number >= low && m->number <= high;
}

/* waited from the end of the step that the lag names; NaN: that step is not in the log */
static double waited(const fw_flow *flow, const fw_asrun *run, const fw_lag *lag,
                     const fw_asrun_entry *e) {
    for (int i = 0; i < flow->nstep; i++) {
        int times;
        if (strcmp(flow->step[i].id, lag->from) != 0) continue;
        const fw_asrun_entry *from = last_of(run, &flow->step[i], &times);
        return from ? e->start_s - from->end_s : (double)NAN;
    }
    return (double)NAN;
}

static bool wait_is_fine(const fw_lag *lag, double wait_s) {
    return !(wait_s < lag->min_s) && !(wait_s > lag->max_s); /* NaN: no limit, or not known */
}

/* what is out of its limits in one entry */
static int deviations(const fw_flow *flow, const fw_asrun *run, const fw_asrun_entry *e) {
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
        fw_put_duration(&cell, seconds);
    if (fw_text_end(&cell) != FW_OK) {
        out->failed = 1;
        return;
    }
    fw_text_printf(out, "%*s", width, cell.data);
}

static void details(const fw_flow *flow, const fw_asrun *run, const fw_asrun_entry *e,
                    fw_text *out) {
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_measured *m = &e->measured[i];
        const fw_accept *a = accept_of(e->step, m->measure);
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
        const fw_lag *l = &e->step->lag[i];
        double wait = waited(flow, run, l, e);
        if (isnan(wait) || wait_is_fine(l, wait)) continue;
        fw_text_printf(out, "      waited ");
        fw_put_duration(out, fmax(wait, 0.0));
        fw_text_printf(out, " since %s: OUT of ", l->from);
        fw_put_duration(out, isnan(l->min_s) ? 0.0 : l->min_s);
        fw_text_add(out, " to ");
        if (isnan(l->max_s))
            fw_text_add(out, "any");
        else
            fw_put_duration(out, l->max_s);
        fw_text_add(out, "\n");
    }
    if (e->note) fw_text_printf(out, "      note: %s\n", e->note);
}

typedef struct total {
    int logged, out, repeated;
    double planned_s, actual_s;
} total;

static total sum_up(const fw_flow *flow, const fw_asrun *run) {
    total t = {0};
    for (int i = 0; i < flow->nstep; i++) {
        int times;
        const fw_asrun_entry *e = last_of(run, &flow->step[i], &times);
        if (!e) continue;
        t.logged++;
        t.repeated += times - 1;
        t.out += deviations(flow, run, e);
        t.actual_s += e->end_s - e->start_s;
        if (flow->step[i].time.computable) t.planned_s += flow->step[i].time.nominal_s;
    }
    return t;
}

fw_status fw_asrun_write_text(const fw_flow *flow, const fw_asrun *run, fw_text *out) {
    fw_text_printf(out, "as run: flow %s%s%s, plan %.12s\n\n", flow->id, run->lot ? ", lot " : "",
                   run->lot ? run->lot : "", run->plan);
    fw_text_printf(out, "%-5s %14s %14s %14s %14s  %-9s %s\n", "step", "planned", "first look",
                   "stop", "actual", "judged", "title");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_step *s = &flow->step[i];
        int times;
        const fw_asrun_entry *e = last_of(run, s, &times);
        const double cell[] = {
            s->time.computable ? s->time.nominal_s : (double)NAN,
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
    fw_put_duration(out, t.planned_s);
    fw_text_add(out, " for them, actual ");
    fw_put_duration(out, t.actual_s);
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

static void entry_json(const fw_flow *flow, const fw_asrun *run, const fw_asrun_entry *e,
                       fw_json *out) {
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
        const fw_measured *m = &e->measured[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "measure", m->measure);
        if (isnan(m->number))
            put_text(out, "value", m->value);
        else
            put_number(out, "value", m->number);
        const fw_accept *a = accept_of(e->step, m->measure);
        put_text(out, "unit", a->unit);
        fw_json_truth(out, "accepted", accepted(a, m));
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "waited");
    for (int i = 0; i < e->step->nlag; i++) {
        const fw_lag *l = &e->step->lag[i];
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

fw_status fw_asrun_write_json(const fw_flow *flow, const fw_asrun *run, fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    put_text(out, "schema", "flexwright.as-run/1");
    put_text(out, "flow", flow->id);
    put_text(out, "lot", run->lot);
    put_text(out, "plan_sha256", run->plan);
    put_text(out, "chain", run->chain);
    fw_json_list(out, "steps");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_step *s = &flow->step[i];
        const fw_time *p = &s->time;
        int times;
        const fw_asrun_entry *e = last_of(run, s, &times);
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
