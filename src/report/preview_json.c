/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_effects.h"
#include "report/preview.h"
#include <math.h>
#include <string.h>

/* ---- small parts ---- */

void fw_report_preview_number(fw_text *out, double value, int digits) {
    if (value == 0.0) value = 0.0; /* no minus zero */
    if (isfinite(value))
        fw_text_number(out, value, digits);
    else
        fw_text_add(out, "null");
}

/* length of the UTF-8 character at s, 0: it is none (RFC 3629) */
static size_t character(const unsigned char *s) {
    if (s[0] < 0x80) return 1;
    size_t n = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    unsigned least = n == 2 ? 0x80 : n == 3 ? 0x800 : 0x10000;
    unsigned code = s[0] & (0x7fU >> n);
    if (s[0] < 0xc2 || s[0] > 0xf4) return 0;
    for (size_t i = 1; i < n; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
        code = code << 6 | (s[i] & 0x3fU);
    }
    return code >= least && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff) ? n : 0;
}

void fw_report_preview_string(fw_text *out, const char *text) {
    if (!text) {
        fw_text_add(out, "null");
        return;
    }
    size_t n = strlen(text), at = 0;
    while (at < n && character((const unsigned char *)text + at))
        at += character((const unsigned char *)text + at);
    if (at == n) {
        fw_text_json(out, text);
        return;
    }
    char *whole = fw_arena_strdup(out->arena, text); /* what is cut in two becomes '?' */
    if (!whole) {
        out->failed = 1;
        return;
    }
    for (at = 0; at < n;) {
        size_t step = character((const unsigned char *)whole + at);
        if (!step) whole[at] = '?';
        at += step ? step : 1;
    }
    fw_text_json(out, whole);
}

static void key(fw_text *out, const char *name) {
    fw_text_printf(out, ",\"%s\":", name);
}

static void text(fw_text *out, const char *name, const char *value) {
    key(out, name);
    fw_report_preview_string(out, value);
}

static void number(fw_text *out, const char *name, double value) {
    key(out, name);
    fw_report_preview_number(out, value, 6);
}

static void truth(fw_text *out, const char *name, bool value) {
    key(out, name);
    fw_text_add(out, value ? "true" : "false");
}

/* ---- diagnostics ---- */

static bool same(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* judging and moving say some things twice */
static bool said(const fw_diags *diags, size_t i) {
    const fw_diag *d = &diags->item[i];
    for (size_t k = 0; k < i; k++) {
        const fw_diag *e = &diags->item[k];
        if (e->number == d->number && e->severity == d->severity &&
            e->place.line == d->place.line && e->place.column == d->place.column &&
            same(e->place.file, d->place.file) && same(e->message, d->message))
            return true;
    }
    return false;
}

void fw_report_preview_diagnostics(const fw_diags *diags, const char *file, fw_text *out) {
    static const char *const word[] = {
        [FW_NOTE] = "note", [FW_WARNING] = "warning", [FW_ERROR] = "error"};
    int n = 0;
    fw_text_add(out, "\"diagnostics\":[");
    for (size_t i = 0; diags && i < diags->count; i++) {
        const fw_diag *d = &diags->item[i];
        if (said(diags, i)) continue;
        const fw_diag_entry *entry = fw_diag_find(d->number);
        bool here = same(d->place.file, file);
        fw_text_printf(out, "%s\n{\"severity\":\"%s\",\"code\":\"FW-D%03d\"", n++ ? "," : "",
                       word[d->severity], d->number);
        text(out, "title", entry ? entry->title : NULL);
        text(out, "message", d->message);
        text(out, "file", d->place.file ? fw_place_file(d->place) : NULL);
        truth(out, "in_text", here);
        key(out, "line");
        if (d->place.line > 0)
            fw_text_printf(out, "%d", d->place.line);
        else
            fw_text_add(out, "null");
        key(out, "column");
        if (d->place.line > 0 && d->place.column > 0)
            fw_text_printf(out, "%d", d->place.column);
        else
            fw_text_add(out, "null");
        text(out, "explain", entry ? entry->text : NULL);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    key(out, "diagnostics_dropped");
    fw_text_printf(out, "%zu", diags ? diags->dropped : 0);
}

/* ---- parameters ---- */

/* the value as it stands in the text, from its place to the closing quote */
static const char *written(fw_arena *arena, const fw_device *d, fw_place place) {
    const char *at = d->source;
    for (int line = 1; at && line < place.line; line++) {
        at = strchr(at, '\n');
        at += at != NULL;
    }
    size_t column = (size_t)(place.column > 0 ? place.column - 1 : 0);
    if (!at || place.line < 1 || strlen(at) < column || at + column == d->source) return NULL;
    const char quote[2] = {at[(ptrdiff_t)column - 1], '\0'};
    if (quote[0] != '"' && quote[0] != '\'') return NULL;
    return fw_arena_strndup(arena, at + column, strcspn(at + column, quote));
}

/* value, least and most in the unit that the file writes it in */
static fw_status parameters(fw_arena *arena, const fw_device *d, fw_text *out) {
    fw_text_add(out, "\"parameters\":[");
    for (int i = 0; d && i < d->nparameter; i++) {
        const fw_parameter *p = &d->parameter[i];
        fw_unit unit = {.factor = 1.0};
        if (p->unit[0]) fw_unit_parse(p->unit, strlen(p->unit), &unit, NULL, NULL);
        const char *raw = written(arena, d, p->place), *const *names = NULL;
        size_t uses = 0;
        if (raw) FW_TRY(fw_expression_names(arena, raw, strlen(raw), &names, &uses));
        fw_text_add(out, i ? ",\n{\"name\":" : "\n{\"name\":");
        fw_report_preview_string(out, p->name);
        key(out, "value");
        fw_report_preview_number(out, fw_unit_from_si(&unit, p->value), 12);
        text(out, "unit", p->unit);
        key(out, "value_SI");
        fw_report_preview_number(out, p->value, 17);
        key(out, "minimum");
        fw_report_preview_number(out, fw_unit_from_si(&unit, p->min), 12);
        key(out, "maximum");
        fw_report_preview_number(out, fw_unit_from_si(&unit, p->max), 12);
        text(out, "doc", p->doc);
        text(out, "written", raw);
        truth(out, "derived", uses > 0);
        truth(out, "overridden", p->overridden);
        fw_text_printf(out, ",\"line\":%d,\"column\":%d", p->place.line, p->place.column);
        const char *path = fw_arena_printf(arena, "parameter[%s]/@value", p->name);
        FW_NEED(path);
        text(out, "path", path);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    return FW_OK;
}

static void scenes_and_flows(const fw_report_preview *in, fw_text *out) {
    fw_text_add(out, "\"scenes\":[");
    for (int i = 0; in->device && i < in->device->nscene; i++) {
        const fw_scene *s = &in->device->scene[i];
        fw_text_add(out, i ? ",{\"name\":" : "{\"name\":");
        fw_report_preview_string(out, s->name);
        text(out, "flow", s->flow);
        number(out, "duration_s", s->duration_s);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "],\n\"flows\":[");
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_flow *f = &in->flow[i];
        const char *id = f->variant && f->variant->variant ? f->variant->variant->flow : NULL;
        fw_text_add(out, i ? ",{\"name\":" : "{\"name\":");
        fw_report_preview_string(out, id);
        text(out, "material",
             f->variant && f->variant->variant ? f->variant->variant->material.name : NULL);
        key(out, "manufacturable");
        bool known = f->flow && f->flow->manufacturable >= 0;
        fw_text_add(out, !known ? "null" : f->flow->manufacturable ? "true" : "false");
        fw_text_add(out, ",\"reasons\":[");
        for (int k = 0; f->flow && k < f->flow->nreason; k++) {
            fw_text_add(out, k ? "," : "");
            fw_report_preview_string(out, f->flow->reason[k]);
        }
        fw_text_add(out, "]}");
    }
    fw_text_add(out, "]");
}

/* ---- motion ---- */

/* so many decimals that a hundred millionth of the device shows */
static int decimals(const fw_mechanism *m) {
    double size = 0.0;
    for (int i = 0; i < m->npin; i++) {
        fw_vec2 p = fw_pin_place(m, &m->pin[i], 0), q = fw_pin_place(m, &m->pin[0], 0);
        size = fmax(size, fmax(fabs(p.x - q.x), fabs(p.y - q.y)));
    }
    if (!(size > 1e-12)) return 12;
    return (int)fmax(4.0, fmin(16.0, 8.0 - floor(log10(size))));
}

static void fixed(fw_text *out, double value, int places) {
    if (isfinite(value))
        fw_text_fixed(out, value, places);
    else
        fw_text_add(out, "null");
}

/* rows of the states: [x, y, phi, x, y, phi ...] and [angle ...] */
static void states(const fw_mechanism *m, const fw_motion *x, fw_text *out) {
    int places = decimals(m), n = 3 * x->nbody;
    fw_text_reserve(out, (size_t)x->nsample * (size_t)(16 * n + 14 * x->npin + 16));
    fw_text_add(out, "\"t_s\":[");
    for (int i = 0; i < x->nsample; i++) {
        fw_text_add(out, i ? "," : "");
        fw_report_preview_number(out, x->t_s[i], 7);
    }
    fw_text_add(out, "],\n\"q\":[");
    for (int i = 0; i < x->nsample; i++) {
        fw_text_add(out, i ? ",\n[" : "\n[");
        for (int k = 0; k < n; k++) {
            if (k) fw_text_add(out, ",");
            fixed(out, x->q[(size_t)i * (size_t)n + (size_t)k], k % 3 == 2 ? 8 : places);
        }
        fw_text_add(out, "]");
    }
    fw_text_add(out, "],\n\"angle_rad\":[");
    for (int i = 0; i < x->nsample; i++) {
        fw_text_add(out, i ? ",\n[" : "\n[");
        for (int k = 0; k < x->npin; k++) {
            if (k) fw_text_add(out, ",");
            fixed(out, x->angle_rad[(size_t)i * (size_t)x->npin + (size_t)k], 8);
        }
        fw_text_add(out, "]");
    }
    fw_text_add(out, "]");
}

static void column(fw_text *out, const char *name, const double *value, int stride, int count) {
    fw_text_printf(out, "\"%s\":[", name);
    for (int i = 0; i < count; i++) {
        fw_text_add(out, i ? "," : "");
        fw_report_preview_number(out, value[(size_t)i * (size_t)stride], 7);
    }
    fw_text_add(out, "]");
}

/* null of a row of equilibria, and where nobody asked */
static void energies(const fw_motion *x, fw_text *out) {
    static const char *const name[] = {"kinetic_J", "potential_J", "dissipated_J", "work_J"};
    fw_text_add(out, "\"energy\":");
    fw_text_add(out, x->energy_J ? "{" : "null");
    for (int k = 0; x->energy_J && k < 4; k++) {
        fw_text_add(out, k ? "," : "");
        column(out, name[k], x->energy_J + k, 4, x->nsample);
    }
    fw_text_add(out, x->energy_J ? "},\n" : ",");
    if (x->constraint_norm)
        column(out, "constraint_norm", x->constraint_norm, 1, x->nsample);
    else
        fw_text_add(out, "\"constraint_norm\":null");
}

static void peaks(const fw_mechanism *m, const fw_motion *x, fw_text *out) {
    fw_text_add(out, "\"peaks\":[");
    for (int i = 0; i < x->npin; i++) {
        fw_text_add(out, i ? ",{\"pin\":" : "{\"pin\":");
        fw_report_preview_string(out, m->pin[i].id);
        key(out, "angle_rad");
        fw_report_preview_number(out, x->peak[i].angle_rad, 17);
        number(out, "t_s", x->peak[i].t_s);
        number(out, "error_rad", x->peak[i].error_rad);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void stats(const fw_motion *x, fw_text *out) {
    const fw_motion_stats *s = &x->stats;
    fw_text_printf(out,
                   "\"stats\":{\"steps\":%ld,\"rejected\":%ld,\"rhs\":%ld,\"projections\":%ld,"
                   "\"events\":%ld,\"jacobians\":%ld,\"factorisations\":%ld",
                   s->steps, s->rejected, s->rhs, s->projections, s->events, s->jacobians,
                   s->factorisations);
    number(out, "cpu_s", s->cpu_s);
    number(out, "estimate_cpu_s", s->estimate_cpu_s);
    number(out, "energy_error", s->energy_error);
    number(out, "largest_energy_J", s->largest_energy_J);
    number(out, "max_constraint_norm", s->max_constraint_norm);
    number(out, "max_velocity_norm", s->max_velocity_norm);
    fw_text_add(out, "}");
}

static void ledger(const fw_motion *x, fw_text *out) {
    fw_text_add(out, "\"ledger\":[");
    for (int i = 0; i < x->ledger.count; i++) {
        const fw_effect_entry *e = &x->ledger.item[i];
        fw_text_add(out, i ? ",\n{\"id\":" : "\n{\"id\":");
        fw_report_preview_string(out, e->id);
        truth(out, "called_for", e->called_for);
        truth(out, "active", e->active);
        number(out, "bound", e->bound);
        number(out, "cost", e->cost);
        text(out, "reason", e->reason);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
    number(out, "ledger_left_out", x->ledger.left_out);
    text(out, "hinge_model", fw_hinge_model_text(x->ledger.hinge.used));
    text(out, "hinge_model_why", x->ledger.hinge.why);
}

static void motion(const fw_report_preview *in, fw_text *out) {
    const fw_motion *x = in->motion;
    fw_text_add(out, "\"motion\":");
    if (!x || !in->mechanism || x->nsample < 1) {
        fw_text_add(out, "null,\n\"ledger\":[],\"ledger_left_out\":null,\"hinge_model\":null,"
                         "\"hinge_model_why\":null");
        return;
    }
    fw_text_add(out, "{\"scene\":");
    fw_report_preview_string(out, in->scene ? in->scene->name : NULL);
    text(out, "flow", in->mechanism->variant ? in->mechanism->variant->flow : NULL);
    text(out, "method", x->method);
    text(out, "integrator", x->integrator);
    text(out, "reason", x->reason);
    text(out, "stabilise", x->stabilise);
    text(out, "method_report", x->method_report);
    number(out, "rtol", x->stats.rtol);
    truth(out, "ended", x->ended);
    number(out, "end_s", x->end_s);
    fw_text_add(out, ",\n");
    stats(x, out);
    fw_text_add(out, ",\n");
    peaks(in->mechanism, x, out);
    fw_text_add(out, ",\n");
    energies(x, out);
    fw_text_add(out, ",\n");
    states(in->mechanism, x, out);
    fw_text_add(out, "},\n");
    ledger(x, out);
}

/* ---- the document ---- */

static void left_out(const fw_report_preview *in, fw_text *out) {
    fw_text_add(out, "\"left_out\":[");
    for (int i = 0; i < in->nleft_out; i++) {
        fw_text_add(out, i ? ",{\"what\":" : "{\"what\":");
        fw_report_preview_string(out, in->left_out[i].what);
        text(out, "sentence", in->left_out[i].sentence);
        truth(out, "could_reject", in->left_out[i].could_reject);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

fw_status fw_report_preview_json(fw_arena *arena, const fw_report_preview *in, fw_text *out) {
    fw_text_add(out, "{\"schema\":\"flexwright.preview/1\"");
    text(out, "status", in->status);
    fw_text_printf(out, ",\"exit_status\":%d", in->exit_status);
    text(out, "decision", in->verdict ? fw_decision_text(in->verdict->decision) : NULL);
    truth(out, "provisional", in->provisional);
    fw_text_add(out, ",\n");
    left_out(in, out);
    fw_text_add(out, ",\n");
    fw_report_preview_diagnostics(in->diags, in->file, out);
    text(out, "name", in->device ? in->device->name : NULL);
    truth(out, "six_bar", in->device && in->device->six_bar);
    fw_text_add(out, ",\n");
    FW_TRY(parameters(arena, in->device, out));
    fw_text_add(out, ",\n");
    scenes_and_flows(in, out);
    fw_text_add(out, ",\n");
    FW_TRY(fw_report_preview_shapes(arena, in, out));
    fw_text_add(out, ",\n");
    motion(in, out);
    fw_text_add(out, ",\n\"verdict\":");
    fw_text_add(out, in->verdict_json ? in->verdict_json : "null");
    fw_text_add(out, ",\n\"cost\":{\"read_s\":");
    fw_report_preview_number(out, in->read_s, 4);
    number(out, "judge_s", in->judge_s);
    number(out, "simulate_s", in->simulate_s);
    fw_text_add(out, "}}\n");
    return fw_text_end(out);
}
