/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a log is out of its limits. */
#include "base/text.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe_words.h"
#include <math.h>
#include <string.h>

bool fw_recipe_asrun_same_wafer(const fw_recipe_asrun_entry *a, const fw_recipe_asrun_entry *b) {
    return a->wafer == b->wafer || (a->wafer && b->wafer && strcmp(a->wafer, b->wafer) == 0);
}

bool fw_recipe_asrun_is_last(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e) {
    for (const fw_recipe_asrun_entry *later = e + 1; later < run->entry + run->nentry; later++)
        if (later->step == e->step && fw_recipe_asrun_same_wafer(later, e)) return false;
    return true;
}

/* A step is booked with its over-etch, its pauses and what is finished at the bench, and is logged from its start to its
   end, or to the end of the etch alone: short is below the first look, long above the stop time with all of that. */
const char *fw_recipe_asrun_in_time(const fw_process_step *step, double actual_s) {
    if (!step->time.computable) return "no plan";
    if (actual_s < step->time.first_look_s) return "short";
    return actual_s > step->booked_stop_s ? "long" : "in window";
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
double fw_recipe_asrun_waited(const fw_recipe_asrun *run, const fw_process_lag *lag,
                              const fw_recipe_asrun_entry *e) {
    const fw_recipe_asrun_entry *from = NULL;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *other = &run->entry[i];
        bool of_it = !other->wafer || !e->wafer || strcmp(other->wafer, e->wafer) == 0;
        if (of_it && strcmp(other->step->id, lag->from) == 0) from = other;
    }
    return from ? e->start_s - from->end_s : (double)NAN;
}

bool fw_recipe_asrun_wait_is_fine(const fw_process_lag *lag, double wait_s) {
    return !(wait_s < lag->min_s) && !(wait_s > lag->max_s); /* NaN: no limit, or not known */
}

/* ---- the list ---- */

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

void fw_recipe_asrun_put_span(fw_text *out, const char *low, const char *high) {
    fw_text_printf(out, "%s to %s", low[0] ? low : "any", high[0] ? high : "any");
}

void fw_recipe_asrun_put_wait(fw_text *out, const fw_process_lag *lag) {
    fw_schedule_put_duration(out, isnan(lag->min_s) ? 0.0 : lag->min_s);
    fw_text_add(out, " to ");
    if (isnan(lag->max_s))
        fw_text_add(out, "any");
    else
        fw_schedule_put_duration(out, lag->max_s);
}

static void put_unit(fw_text *out, const char *unit) {
    if (strcmp(unit, "1") != 0) fw_text_printf(out, " %s", unit);
}

static fw_status times_of(builder *b, const fw_recipe_asrun_entry *e) {
    double actual = e->end_s - e->start_s;
    const char *judged = fw_recipe_asrun_in_time(e->step, actual);
    if (strcmp(judged, "short") != 0 && strcmp(judged, "long") != 0) return FW_OK;
    fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
    fw_schedule_put_duration(&planned, e->step->booked_s);
    fw_text_add(&planned, "; ");
    fw_schedule_put_duration(&planned, e->step->time.first_look_s);
    fw_text_add(&planned, " to ");
    fw_schedule_put_duration(&planned, e->step->booked_stop_s);
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
            fw_recipe_asrun_put_span(&planned, a->low, a->high);
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
        fw_recipe_asrun_put_span(&planned, s->low, s->high);
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
        double wait = fw_recipe_asrun_waited(run, l, e);
        if (fw_recipe_asrun_wait_is_fine(l, wait)) continue;
        fw_text planned = fw_text_new(b->arena), is = fw_text_new(b->arena);
        fw_recipe_asrun_put_wait(&planned, l);
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
            FW_TRY(times_of(&b, e));
            FW_TRY(values_of(&b, e));
            FW_TRY(settings_of(&b, e));
            FW_TRY(waits_of(&b, run, e));
        }
    *list = b.item;
    *n = b.n;
    return FW_OK;
}
