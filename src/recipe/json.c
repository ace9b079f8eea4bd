/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/members.h"
#include "recipe/words.h"

void fw_put_words(fw_text *out, const char *key, const char *text) {
    fw_put_text(out, key, text ? text : "");
}

static void number(fw_text *out, const char *key, double value) {
    fw_put_number(out, key, value, FW_PLAIN_DIGITS);
}

static void quantity(fw_text *out, const fw_row *row) {
    const fw_quantity *q = row->q;
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "name", row->name);
    if (q->unknown)
        fw_put_null(out, "value");
    else
        number(out, "value", fw_quantity_in_unit(q));
    fw_put_words(out, "unit", q->unit);
    if (q->unknown)
        fw_put_null(out, "uncertainty");
    else {
        fw_put_key(out, "uncertainty");
        fw_put_uncertainty(out, fw_row_uncertainty(q));
    }
    fw_put_words(out, "status", q->unknown ? "unknown" : fw_value_status_text(q->status));
    fw_put_words(out, "source", q->source);
    if (q->note) fw_put_words(out, "note", q->note);
    fw_text_add(out, "}");
}

static void strings(fw_text *out, const char *name, const char **list, int n) {
    fw_put_open(out, name, '[');
    for (int i = 0; i < n; i++)
        fw_put_words(out, NULL, list[i]);
    fw_text_add(out, "]");
}

static void times(fw_text *out, const fw_time *t) {
    if (!t->computable) {
        fw_put_null(out, "time_s");
        return;
    }
    fw_put_open(out, "time_s", '{');
    number(out, "nominal", t->nominal_s);
    number(out, "first_look", t->first_look_s);
    number(out, "clear_by", t->clear_by_s);
    number(out, "stop", t->stop_s);
    fw_put_key(out, "relative_uncertainty");
    fw_put_uncertainty(out, t->relative_uncertainty);
    fw_put_words(out, "status", fw_value_status_text(t->status));
    fw_text_add(out, "}");
}

static fw_status step(fw_text *out, const fw_step *s) {
    fw_row *row = NULL;
    int n = 0;
    FW_TRY(fw_step_rows(out->arena, s, &row, &n));
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "id", s->id);
    fw_put_words(out, "title", s->title);
    fw_put_truth(out, "in_source", s->in_source);
    fw_put_words(out, "law", s->law);
    times(out, &s->time);
    strings(out, "not_computable", s->time.missing, s->time.nmissing);
    strings(out, "contributions", s->time.contribution, s->time.ncontribution);
    fw_put_open(out, "quantities", '[');
    for (int i = 0; i < n; i++)
        quantity(out, &row[i]);
    fw_text_add(out, "]}");
    return FW_OK;
}

fw_status fw_recipe_write_json(const fw_flow *flow, const fw_recipe_header *header, fw_text *out) {
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "schema", "flexwright.recipe/1");
    fw_put_words(out, "flow", flow->id);
    fw_put_words(out, "device", header->device);
    fw_put_truth(out, "rejected", header->rejected);
    if (header->rejected) fw_put_words(out, "banner", "REJECTED");
    fw_put_open(out, "steps", '[');
    for (int i = 0; i < flow->nstep; i++) {
        fw_put_line(out);
        FW_TRY(step(out, &flow->step[i]));
    }
    fw_text_add(out, "]");
    number(out, "total_s", flow->total_s);
    fw_put_whole(out, "not_computable_steps", flow->not_computable);
    if (flow->manufacturable < 0)
        fw_put_null(out, "manufacturable");
    else
        fw_put_truth(out, "manufacturable", flow->manufacturable);
    strings(out, "reasons", flow->reason, flow->nreason);
    fw_put_open(out, "overrides", '[');
    for (int i = 0; i < flow->noverride; i++) {
        const fw_override *o = &flow->override[i];
        fw_put_open(out, NULL, '{');
        fw_put_words(out, "id", o->id);
        fw_put_words(out, "was", o->was);
        fw_put_words(out, "is", o->is);
        fw_put_words(out, "source", o->source);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    number(out, "bias_m", flow->bias_m);
    fw_put_words(out, "bias_note", flow->bias_note);
    fw_recipe_edges_json(flow, out);
    fw_text_add(out, "}\n");
    return fw_text_end(out);
}
