/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON of this room: flexwright.recipe/1, flexwright.measurements/1, flexwright.schedule/1,
   flexwright.sections/1. */
#include "base/json.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe_profile.h"
#include "recipe/recipe.h"
#include <math.h>
#include <stdio.h>

/* NULL is "" */
static void words(fw_json *out, const char *key, const char *text) {
    fw_json_text(out, key, text ? text : "");
}

static void number(fw_json *out, const char *key, double value) {
    fw_json_number(out, key, value, FW_PLAIN_DIGITS);
}

static void quantity(fw_json *out, const fw_recipe_row *row) {
    const fw_quantity *q = row->q;
    fw_json_object(out, NULL);
    words(out, "name", row->name);
    if (q->unknown || q->word)
        fw_json_null(out, "value");
    else
        number(out, "value", fw_quantity_in_unit(q));
    if (fw_quantity_is_word(q)) fw_json_text(out, "word", q->word);
    words(out, "unit", q->unit);
    if (q->unknown || q->word)
        fw_json_null(out, "uncertainty");
    else
        fw_json_number(out, "uncertainty", fw_recipe_row_uncertainty(q), FW_UNCERTAINTY_DIGITS);
    words(out, "status", q->unknown ? "unknown" : fw_quantity_value_status_text(q->status));
    if (q->unknown || !(q->uncertainty > 0.0))
        fw_json_null(out, "uncertainty_status");
    else
        words(out, "uncertainty_status", fw_quantity_value_status_text(q->u_status));
    words(out, "source", q->source);
    if (q->note) words(out, "note", q->note);
    fw_json_end(out);
}

static void strings(fw_json *out, const char *name, const char *const *list, int n) {
    fw_json_list(out, name);
    for (int i = 0; i < n; i++)
        words(out, NULL, list[i]);
    fw_json_end(out);
}

static void times(fw_json *out, const fw_process_time *t) {
    if (!t->computable) {
        fw_json_null(out, "time_s");
        return;
    }
    fw_json_object(out, "time_s");
    number(out, "nominal", t->nominal_s);
    number(out, "first_look", t->first_look_s);
    number(out, "clear_by", t->clear_by_s);
    number(out, "stop", t->stop_s);
    fw_json_number(out, "relative_uncertainty", t->relative_uncertainty, FW_UNCERTAINTY_DIGITS);
    words(out, "status", fw_quantity_value_status_text(t->status));
    words(out, "uncertainty_status", fw_quantity_value_status_text(t->u_status));
    fw_json_end(out);
}

static void finishes(fw_json *out, const fw_process_step *s) {
    fw_json_list(out, "finish");
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        fw_json_object(out, NULL);
        words(out, "words", fw_recipe_finish_words(out->out->arena, f));
        number(out, "time_s", f->time && !f->time->unknown ? f->time->value : (double)NAN);
        words(out, "note", f->text);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void waits(fw_json *out, const fw_process_flow *flow, int index) {
    fw_json_list(out, "waits");
    for (int i = 0; i < flow->nwait; i++) {
        const fw_process_wait *w = &flow->wait[i];
        if (w->from != index) continue;
        fw_json_object(out, NULL);
        words(out, "is", w->is);
        words(out, "to", flow->step[w->to].id);
        number(out, "max_s", w->max_s);
        words(out, "status", w->q ? fw_quantity_value_status_text(w->q->status) : "assumed");
        words(out, "why", w->why);
        fw_json_end(out);
    }
    fw_json_end(out);
}

/* which plate it prints and how that is put on; what its equipment bears; in which parts it is done */
static void plate_and_parts(fw_json *out, const fw_process_step *s) {
    const fw_process_align *a = &s->align;
    if (s->mask[0]) {
        fw_json_object(out, "plate");
        words(out, "id", s->mask);
        words(out, "side", fw_process_step_on_back(s) ? "back" : "front");
        words(out, "aligned_to", a->to);
        words(out, "marks", a->to ? a->marks : NULL);
        number(out, "overlay_m", a->to && !a->overlay->unknown ? a->overlay->value : (double)NAN);
        fw_json_end(out);
    }
    if (s->bears) /* a step that drives the device */
        number(out, "bears_V", s->bears->unknown ? (double)NAN : s->bears->value);
    if (!s->pulse) return;
    fw_json_object(out, "parts");
    number(out, "part_s", s->pulse->unknown ? (double)NAN : s->pulse->value);
    number(out, "pause_s", s->pause->unknown ? (double)NAN : s->pause->value);
    fw_json_end(out);
}

static fw_status step(fw_json *out, const fw_process_flow *flow, int index) {
    const fw_process_step *s = &flow->step[index];
    fw_recipe_row *row = NULL;
    int n = 0;
    FW_TRY(fw_recipe_step_rows(out->out->arena, s, &row, &n));
    fw_json_object(out, NULL);
    words(out, "id", s->id);
    words(out, "title", s->title);
    fw_json_truth(out, "in_source", s->in_source);
    words(out, "law", s->law);
    times(out, &s->time);
    strings(out, "not_computable", s->time.missing, s->time.nmissing);
    strings(out, "contributions", s->time.contribution, s->time.ncontribution);
    fw_json_list(out, "quantities");
    for (int i = 0; i < n; i++)
        quantity(out, &row[i]);
    fw_json_end(out);
    finishes(out, s);
    number(out, "booked_s", s->time.computable ? s->booked_s : (double)NAN);
    waits(out, flow, index);
    plate_and_parts(out, s);
    fw_json_end(out);
    return FW_OK;
}

/* ---- bias, gaps and edges of the fixed point ---- */

static void face(fw_json *out, const char *key, double known_m, double low_m, double high_m) {
    fw_json_object(out, key);
    number(out, "known_m", known_m);
    number(out, "low_m", low_m);
    number(out, "high_m", high_m);
    fw_json_end(out);
}

static void opening(fw_json *out, const fw_process_edge_class *c) {
    fw_json_line(out, 0);
    fw_json_object(out, NULL);
    words(out, "name", c->name);
    number(out, "drawn_m", c->drawn_m);
    number(out, "mask_m", c->plate_m);
    number(out, "under_mask_m", c->opening_m);
    number(out, "through_s", c->through_s);
    number(out, "over_etch", c->over_etch);
    face(out, "top", c->edge.top_m, c->low.top_m, c->high.top_m);
    face(out, "bottom", c->edge.bottom_m, c->low.bottom_m, c->high.bottom_m);
    fw_json_end(out);
}

static void edges(const fw_process_flow *flow, fw_json *out) {
    const fw_process_fixed_point *p = &flow->edges;
    fw_json_object(out, "edges");
    fw_json_truth(out, "solved", p->solved);
    fw_json_truth(out, "open", p->open || p->wet_open || p->wear.missing);
    number(out, "printed_m", p->printed_m);
    number(out, "wet_m", p->wet_m);
    number(out, "worn_m", p->wear.loss_m);
    number(out, "etch_m", p->etch_m);
    number(out, "least_bias_m", p->low_m);
    number(out, "most_bias_m", p->high_m);
    fw_json_list(out, "openings");
    for (int i = 0; i < p->ncls; i++)
        opening(out, &p->cls[i]);
    fw_json_end(out);
    fw_json_end(out);
}

/* ---- the recipe ---- */

/* steps of the pack that this device does not need */
static void left_out(const fw_process_flow *flow, fw_json *out) {
    fw_json_list(out, "left_out");
    for (int i = 0; i < flow->nleft_out; i++) {
        const fw_process_left_out *l = &flow->left_out[i];
        fw_json_object(out, NULL);
        words(out, "id", l->id);
        words(out, "title", l->title);
        words(out, "before", l->before);
        words(out, "why", l->why);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void from_outside(const fw_recipe_header *header, fw_json *out) {
    fw_json_list(out, "from_outside");
    for (int i = 0; i < header->noutside; i++)
        words(out, NULL, header->outside[i].text);
    fw_json_end(out);
}

fw_status fw_recipe_write_json(const fw_process_flow *flow, const fw_recipe_header *header,
                               fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    words(out, "schema", "flexwright.recipe/1");
    words(out, "flow", flow->id);
    words(out, "device", header->device);
    fw_json_truth(out, "rejected", header->rejected);
    if (header->rejected) words(out, "banner", "REJECTED");
    if (header->nbecause > 0) strings(out, "rejected_because", header->because, header->nbecause);
    fw_json_list(out, "steps");
    for (int i = 0; i < flow->nstep; i++) {
        fw_json_line(out, 0);
        FW_TRY(step(out, flow, i));
    }
    fw_json_end(out);
    if (flow->nleft_out > 0) left_out(flow, out);
    number(out, "total_s", flow->total_s);
    fw_json_whole(out, "not_computable_steps", flow->not_computable);
    if (flow->manufacturable < 0)
        fw_json_null(out, "manufacturable");
    else
        fw_json_truth(out, "manufacturable", flow->manufacturable);
    strings(out, "reasons", flow->reason, flow->nreason);
    if (header->noutside > 0) from_outside(header, out);
    fw_json_list(out, "overrides");
    for (int i = 0; i < flow->noverride; i++) {
        const fw_process_override *o = &flow->override[i];
        fw_json_object(out, NULL);
        words(out, "id", o->id);
        words(out, "was", o->was);
        words(out, "is", o->is);
        words(out, "source", o->source);
        fw_json_end(out);
    }
    fw_json_end(out);
    number(out, "bias_m", flow->bias_m);
    words(out, "bias_note", flow->bias_note);
    edges(flow, out);
    fw_process_release_json(flow, out);
    fw_wiring_json(header->wiring, out);
    fw_statics_tethers_json(out, header->mechanism, header->tethers);
    FW_TRY(fw_recipe_json_bill(flow, header, out));
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

/* beside the recipe, which a log is bound to: that one says what is done, whatever is known of it */
fw_status fw_recipe_write_measurements_json(const fw_process_flow *flow,
                                            const fw_recipe_header *header, fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_INDENTED), *out = &json;
    fw_json_object(out, NULL);
    words(out, "schema", "flexwright.measurements/1");
    words(out, "flow", flow->id);
    words(out, "device", header->device);
    fw_json_truth(out, "rejected", header->rejected);
    if (header->rejected) words(out, "banner", "REJECTED");
    fw_measuring_json(out, header->measuring);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

/* ---- the schedule ---- */

static void tasks(fw_json *out, const fw_schedule *s) {
    const fw_schedule_shop *shop = s->shop;
    fw_json_list(out, "steps");
    for (int i = 0; i < shop->ntask; i++) {
        const fw_schedule_task *t = &shop->task[i];
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        words(out, "id", t->id);
        words(out, "equipment", shop->machine[t->machine].id);
        fw_json_number(out, "duration_s", t->duration_s, FW_PLAIN_DIGITS);
        fw_json_number(out, "attended_s", t->attended_s, FW_PLAIN_DIGITS);
        fw_json_truth(out, "attended_at_end", t->at_end);
        fw_json_whole(out, "load", t->load);
        words(out, "time", t->unknown ? "unknown" : t->stated ? "planned" : "computed");
        bool last = i + 1 == shop->ntask, known = s->pause_s && !last;
        fw_json_number(out, "longest_pause_s", known ? fmax(0.0, s->pause_s[i]) : (double)INFINITY,
                       FW_PLAIN_DIGITS);
        fw_json_truth(out, "safe_stop", s->pause_s && isinf(s->pause_s[i]));
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void holds(fw_json *out, const fw_schedule_shop *shop) {
    fw_json_list(out, "holds");
    for (int i = 0; i < shop->nhold; i++) {
        const fw_schedule_hold *h = &shop->hold[i];
        fw_json_object(out, NULL);
        words(out, "from", shop->task[h->from].id);
        words(out, "to", shop->task[h->to].id);
        fw_json_number(out, "min_s", h->min_s, FW_PLAIN_DIGITS);
        fw_json_number(out, "max_s", h->max_s, FW_PLAIN_DIGITS);
        fw_json_truth(out, "implied", h->implied);
        fw_json_truth(out, "first_only", h->first_only);
        words(out, "why", h->why ? h->why : h->keeps);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void pairs(fw_json *out, const char *key, const double (*pair)[2], int n) {
    fw_json_list(out, key);
    for (int i = 0; i < 2 * n; i++)
        fw_json_number(out, NULL, pair[i / 2][i % 2], FW_PLAIN_DIGITS);
    fw_json_end(out);
}

static void hours_of(fw_json *out, const fw_schedule_calendar *c) {
    fw_json_object(out, NULL);
    fw_json_number(out, "open_s", c->open_s, FW_PLAIN_DIGITS);
    fw_json_number(out, "close_s", c->close_s, FW_PLAIN_DIGITS);
    pairs(out, "breaks_s", c->break_s, c->breaks);
    fw_json_list(out, "days");
    for (int day = 0; day < 7; day++)
        if (!(c->closed_days >> day & 1u)) words(out, NULL, fw_schedule_weekday[day]);
    fw_json_end(out);
    fw_json_end(out);
}

static void machines(fw_json *out, const fw_schedule_shop *shop) {
    fw_json_list(out, "tool_hours");
    for (int i = 0; i < shop->nmachine; i++) {
        const fw_schedule_machine *m = &shop->machine[i];
        if (!m->nhours && !m->nclosed) continue;
        fw_json_object(out, NULL);
        words(out, "equipment", m->id);
        fw_json_list(out, "open");
        for (int k = 0; k < m->nhours; k++)
            hours_of(out, &m->hours[k]);
        fw_json_end(out);
        pairs(out, "closed_s", m->closed_s, m->nclosed);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void runs(fw_json *out, const fw_schedule *s) {
    fw_json_list(out, "runs");
    for (int i = 0; i < s->nrun; i++) {
        const fw_schedule_run *r = &s->run[i];
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        words(out, "step", s->shop->task[r->task].id);
        fw_json_whole(out, "first_wafer", r->first + 1);
        fw_json_whole(out, "wafers", r->count);
        fw_json_number(out, "start_s", r->start_s, FW_PLAIN_DIGITS);
        fw_json_number(out, "end_s", r->end_s, FW_PLAIN_DIGITS);
        if (r->operator_ >= 0)
            fw_json_whole(out, "operator", r->operator_ + 1);
        else
            fw_json_null(out, "operator");
        words(out, "waits_for", fw_schedule_wait_text(r->waits_for));
        fw_json_end(out);
    }
    fw_json_end(out);
}

fw_status fw_recipe_write_schedule_json(const fw_process_flow *flow, const fw_recipe_header *header,
                                        fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    const fw_schedule *s = header->schedule;
    const fw_schedule_shop *shop = s->shop;
    fw_json_object(out, NULL);
    words(out, "schema", "flexwright.schedule/1");
    words(out, "flow", flow->id);
    words(out, "device", header->device);
    fw_json_truth(out, "rejected", header->rejected);
    fw_json_whole(out, "wafers", shop->wafers);
    fw_json_whole(out, "operators", shop->operators);
    fw_json_number(out, "day_open_s", shop->calendar.open_s, FW_PLAIN_DIGITS);
    fw_json_number(out, "day_close_s", shop->calendar.close_s, FW_PLAIN_DIGITS);
    fw_json_truth(out, "weekends", shop->calendar.weekends);
    pairs(out, "breaks_s", shop->calendar.break_s, shop->calendar.breaks);
    if (shop->calendar.dated) {
        long civil[3];
        fw_quantity_civil(shop->calendar.first_day, civil);
        char date[40];
        snprintf(date, sizeof date, "%04ld-%02ld-%02ld", civil[0], civil[1], civil[2]);
        words(out, "first_day", date);
    } else
        fw_json_null(out, "first_day");
    if (shop->calendar.zoned)
        fw_json_whole(out, "zone_min", shop->calendar.zone_min);
    else
        fw_json_null(out, "zone_min");
    fw_json_list(out, "clock_changes");
    for (int k = 0; k < shop->calendar.changes; k++) {
        fw_json_object(out, NULL);
        fw_json_number(out, "at_s", shop->calendar.change_s[k], FW_PLAIN_DIGITS);
        fw_json_number(out, "ahead_s", shop->calendar.ahead_s[k], FW_PLAIN_DIGITS);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_truth(out, "feasible", s->feasible);
    words(out, "why", s->why);
    words(out, "at_stop_times", s->late);
    fw_json_number(out, "makespan_s", s->feasible ? s->makespan_s : (double)INFINITY,
                   FW_PLAIN_DIGITS);
    fw_json_number(out, "lower_bound_s", s->feasible ? s->bound.best_s : (double)INFINITY,
                   FW_PLAIN_DIGITS);
    fw_json_object(out, "bounds");
    fw_json_number(out, "one_wafer_s", s->bound.path_s, FW_PLAIN_DIGITS);
    fw_json_number(out, "machine_s", s->bound.machine_s, FW_PLAIN_DIGITS);
    words(out, "machine", shop->nmachine ? shop->machine[s->bound.machine].id : "");
    fw_json_number(out, "operators_s", s->bound.operator_s, FW_PLAIN_DIGITS);
    fw_json_end(out);
    fw_json_number(out, "gap", s->feasible ? s->gap : (double)INFINITY, FW_PLAIN_DIGITS);
    fw_json_truth(out, "optimal", s->optimal);
    words(out, "found_by", s->rule);
    fw_json_whole(out, "unknown_steps", s->unknown);
    tasks(out, s);
    holds(out, shop);
    machines(out, shop);
    runs(out, s);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

/* ---- sections ---- */

static void point(fw_json *out, const char *key, double x_m, double y_m) {
    fw_json_list(out, key);
    number(out, NULL, x_m);
    number(out, NULL, y_m);
    fw_json_end(out);
}

static void cut(const fw_recipe_cut *c, const fw_recipe_section_scale *scale, fw_json *out) {
    fw_json_object(out, "cut");
    words(out, "name", c->name);
    point(out, "from_m", c->line.at.x, c->line.at.y);
    point(out, "to_m", c->line.at.x + c->length_m * c->line.along.x,
          c->line.at.y + c->length_m * c->line.along.y);
    number(out, "length_m", c->length_m);
    number(out, "exaggeration", scale->exaggeration);
    fw_json_end(out);
}

static void along(const fw_recipe_section_plan *plan, fw_json *out) {
    fw_json_line(out, 0);
    fw_json_list(out, "parts");
    for (int i = 0; i < plan->npart; i++) {
        fw_json_object(out, NULL);
        words(out, "label", plan->part[i].label);
        number(out, "from_m", plan->part[i].from_m);
        number(out, "to_m", plan->part[i].to_m);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_line(out, 0);
    fw_json_list(out, "openings");
    for (int i = 0; i < plan->nopening; i++) {
        const fw_recipe_section_opening *o = &plan->opening[i];
        fw_json_object(out, NULL);
        number(out, "from_m", o->from_m);
        number(out, "to_m", o->to_m);
        number(out, "drawn_m", o->drawn_m);
        number(out, "mask_m", o->mask_m);
        number(out, "top_m", o->top_m);
        number(out, "bottom_m", o->bottom_m);
        number(out, "depth_m", o->depth_m);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void area(const fw_recipe_patch *p, fw_json *out) {
    fw_json_list(out, NULL);
    point(out, NULL, p->low_m[0], p->bottom_m);
    point(out, NULL, p->low_m[1], p->bottom_m);
    point(out, NULL, p->high_m[1], p->top_m);
    point(out, NULL, p->high_m[0], p->top_m);
    fw_json_end(out);
}

/* patches of one film follow each other */
static void films(const fw_recipe_cross_section *p, fw_json *out) {
    fw_json_list(out, "films");
    for (int i = 0; i < p->n;) {
        const fw_process_film *f = p->patch[i].film;
        if (i > 0) fw_json_line(out, 0);
        fw_json_object(out, NULL);
        words(out, "material", f->material);
        number(out, "thickness_m", f->thickness_m);
        fw_json_truth(out, "shortened", f->shortened);
        fw_json_truth(out, "exposed", f->exposed);
        fw_json_list(out, "areas_m");
        for (; i < p->n && p->patch[i].film == f; i++)
            area(&p->patch[i], out);
        fw_json_end(out);
        fw_json_end(out);
    }
    fw_json_end(out);
}

/* films that lie beside the cut: the view of the wafer shows them */
static void elsewhere(const fw_recipe_cross_section *p, fw_json *out) {
    fw_json_list(out, "elsewhere");
    for (int i = 0; i < p->films.n; i++) {
        const fw_process_film *f = &p->films.film[i];
        bool cut = false;
        for (int k = 0; k < p->n; k++)
            cut = cut || p->patch[k].film == f;
        if (cut) continue;
        fw_json_object(out, NULL);
        words(out, "material", f->material);
        number(out, "thickness_m", f->thickness_m);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static fw_status section(fw_recipe_slicer *slicer, const fw_process_flow *flow, int index,
                         fw_json *out) {
    const fw_process_step *s = &flow->step[index];
    fw_recipe_cross_section p;
    fw_json_object(out, NULL);
    words(out, "id", s->id);
    words(out, "title", s->title);
    fw_json_truth(out, "changes", fw_process_step_changes(s));
    if (fw_process_step_changes(s)) { /* else as before */
        FW_TRY(fw_recipe_cross_section_of(slicer, flow, index, &p));
        films(&p, out);
        elsewhere(&p, out);
        fw_json_list(out, "notes");
        for (int i = 0; i < p.films.nnote; i++)
            words(out, NULL, p.films.note[i]);
        fw_json_end(out);
    }
    fw_json_end(out);
    return FW_OK;
}

fw_status fw_recipe_write_sections_json(const fw_process_flow *flow, const fw_recipe_header *header,
                                        fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_recipe_slicer slicer;
    fw_recipe_section_scale scale;
    fw_recipe_section_plan plan;
    FW_TRY(fw_recipe_slicer_start(text->arena, header->mask, header->cut, &slicer));
    FW_TRY(fw_recipe_section_scale_of(text->arena, flow, header->cut, &scale));
    FW_TRY(fw_recipe_section_plan_of(&slicer, flow, &plan));
    fw_json_object(out, NULL);
    words(out, "schema", "flexwright.sections/1");
    words(out, "flow", flow->id);
    words(out, "device", header->device);
    fw_json_truth(out, "rejected", header->rejected);
    if (header->rejected) words(out, "banner", "REJECTED");
    cut(header->cut, &scale, out);
    along(&plan, out);
    fw_json_line(out, 0);
    fw_json_list(out, "steps");
    for (int i = 0; i < flow->nstep; i++) {
        fw_json_line(out, 0);
        FW_TRY(section(&slicer, flow, i, out));
    }
    fw_json_end(out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

static void overtaken_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                           fw_json *out) {
    const fw_recipe_asrun_entry *by = fw_recipe_asrun_overtaken(run, e, e->wafer);
    if (!by) return;
    fw_json_object(out, "overtaken_by");
    fw_json_text(out, "step", by->step->id);
    fw_json_text(out, "start", by->start);
    fw_json_whole(out, "line", by->line);
    fw_json_end(out);
}

/* what it was overtaken by, and the times that it is judged by, where what was set makes others of them */
void fw_recipe_asrun_as_set_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e,
                                 fw_json *out) {
    const fw_process_step *s = e->as_set;
    overtaken_json(run, e, out);
    if (s == e->step) return;
    const bool known = s->time.computable;
    fw_json_object(out, "as_set");
    number(out, "planned_s", known ? s->time.nominal_s : (double)NAN);
    number(out, "first_look_s", known ? s->time.first_look_s : (double)NAN);
    number(out, "stop_s", known ? s->time.stop_s : (double)NAN);
    number(out, "at_machine_s", known ? s->booked_s : (double)NAN);
    number(out, "at_machine_most_s", known ? s->booked_stop_s : (double)NAN);
    fw_json_truth(out, "longer_unless_finished", fw_recipe_asrun_is_late_as_set(run, e));
    fw_json_end(out);
}
