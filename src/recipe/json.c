/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/words.h"
#include <math.h>
#include <string.h>

void fw_put_json(fw_text *out, const char *text) {
    fw_text_json(out, text ? text : "");
}

void fw_put_or_null(fw_text *out, double value) {
    if (isfinite(value))
        fw_put_plain(out, value);
    else
        fw_text_add(out, "null");
}

static void key(fw_text *out, const char *name, bool first) {
    if (!first) fw_text_add(out, ",");
    fw_put_json(out, name);
    fw_text_add(out, ":");
}

static void named(fw_text *out, const char *name, const char *value, bool first) {
    key(out, name, first);
    fw_put_json(out, value ? value : "");
}

static void number(fw_text *out, const char *name, double value, bool first) {
    key(out, name, first);
    fw_put_plain(out, value);
}

static void quantity(fw_text *out, const fw_row *row) {
    const fw_quantity *q = row->q;
    fw_text_add(out, "{");
    named(out, "name", row->name, true);
    if (q->unknown)
        fw_text_add(out, ",\"value\":null");
    else
        number(out, "value", fw_quantity_in_unit(q), false);
    named(out, "unit", q->unit, false);
    if (q->unknown)
        fw_text_add(out, ",\"uncertainty\":null");
    else {
        key(out, "uncertainty", false);
        fw_put_uncertainty(out, fw_row_uncertainty(q));
    }
    named(out, "status", q->unknown ? "unknown" : fw_value_status_text(q->status), false);
    named(out, "source", q->source, false);
    if (q->note) named(out, "note", q->note, false);
    fw_text_add(out, "}");
}

static void strings(fw_text *out, const char *name, const char **list, int n) {
    key(out, name, false);
    fw_text_add(out, "[");
    for (int i = 0; i < n; i++) {
        fw_text_add(out, i ? "," : "");
        fw_put_json(out, list[i]);
    }
    fw_text_add(out, "]");
}

static void times(fw_text *out, const fw_time *t) {
    key(out, "time_s", false);
    if (!t->computable) {
        fw_text_add(out, "null");
        return;
    }
    fw_text_add(out, "{");
    number(out, "nominal", t->nominal_s, true);
    number(out, "first_look", t->first_look_s, false);
    number(out, "clear_by", t->clear_by_s, false);
    number(out, "stop", t->stop_s, false);
    key(out, "relative_uncertainty", false);
    fw_put_uncertainty(out, t->relative_uncertainty);
    named(out, "status", fw_value_status_text(t->status), false);
    fw_text_add(out, "}");
}

static fw_status step(fw_text *out, const fw_step *s) {
    fw_row *row = NULL;
    int n = 0;
    FW_TRY(fw_step_rows(out->arena, s, &row, &n));
    fw_text_add(out, "{");
    named(out, "id", s->id, true);
    named(out, "title", s->title, false);
    fw_text_printf(out, ",\"in_source\":%s", s->in_source ? "true" : "false");
    named(out, "law", s->law, false);
    times(out, &s->time);
    strings(out, "not_computable", s->time.missing, s->time.nmissing);
    strings(out, "contributions", s->time.contribution, s->time.ncontribution);
    key(out, "quantities", false);
    fw_text_add(out, "[");
    for (int i = 0; i < n; i++) {
        fw_text_add(out, i ? "," : "");
        quantity(out, &row[i]);
    }
    fw_text_add(out, "]}");
    return FW_OK;
}

fw_status fw_recipe_write_json(const fw_flow *flow, const fw_recipe_header *header, fw_text *out) {
    fw_text_add(out, "{");
    named(out, "schema", "flexwright.recipe/1", true);
    named(out, "flow", flow->id, false);
    named(out, "device", header->device, false);
    fw_text_printf(out, ",\"rejected\":%s", header->rejected ? "true" : "false");
    if (header->rejected) named(out, "banner", "REJECTED", false);
    key(out, "steps", false);
    fw_text_add(out, "[");
    for (int i = 0; i < flow->nstep; i++) {
        fw_text_add(out, i ? ",\n" : "\n");
        FW_TRY(step(out, &flow->step[i]));
    }
    fw_text_add(out, "]");
    number(out, "total_s", flow->total_s, false);
    fw_text_printf(out, ",\"not_computable_steps\":%d,\"manufacturable\":%s", flow->not_computable,
                   flow->manufacturable < 0   ? "null"
                   : flow->manufacturable > 0 ? "true"
                                              : "false");
    strings(out, "reasons", flow->reason, flow->nreason);
    key(out, "overrides", false);
    fw_text_add(out, "[");
    for (int i = 0; i < flow->noverride; i++) {
        const fw_override *o = &flow->override[i];
        fw_text_add(out, i ? ",{" : "{");
        named(out, "id", o->id, true);
        named(out, "was", o->was, false);
        named(out, "is", o->is, false);
        named(out, "source", o->source, false);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    number(out, "bias_m", flow->bias_m, false);
    named(out, "bias_note", flow->bias_note, false);
    fw_recipe_edges_json(flow, out);
    fw_text_add(out, "}\n");
    return fw_text_end(out);
}
