/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The preview as JSON: its documents, motions and probes. */
#include "base/json.h"
#include "report/json_parts.h"
#include "report/report_page.h"
#include <math.h>
#include <string.h>

enum { DIGITS = 6 }; /* of what is looked at */

/* ---- diagnostics ---- */

/* judging and moving say some things twice */
static bool said(const fw_diags *diags, size_t i) {
    const fw_diag *d = &diags->item[i];
    for (size_t k = 0; k < i; k++) {
        const fw_diag *e = &diags->item[k];
        if (e->number == d->number && e->severity == d->severity &&
            e->place.line == d->place.line && e->place.column == d->place.column &&
            fw_text_same(e->place.file, d->place.file) && fw_text_same(e->message, d->message))
            return true;
    }
    return false;
}

static void position(fw_json *out, const char *key, int value, bool known) {
    if (known && value > 0)
        fw_json_whole(out, key, value);
    else
        fw_json_null(out, key);
}

void fw_report_preview_diagnostics(const fw_diags *diags, const char *file, fw_json *out) {
    static const char *const word[] = {
        [FW_NOTE] = "note", [FW_WARNING] = "warning", [FW_ERROR] = "error"};
    fw_json_list(out, "diagnostics");
    for (size_t i = 0; diags && i < diags->count; i++) {
        const fw_diag *d = &diags->item[i];
        if (said(diags, i)) continue;
        const fw_diag_entry *entry = fw_diag_find(d->number);
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "severity", word[d->severity]);
        fw_json_textf(out, "code", "FW-D%03d", d->number);
        fw_json_text(out, "title", entry ? entry->title : NULL);
        fw_json_text(out, "message", d->message);
        fw_json_text(out, "file", d->place.file ? fw_place_file(d->place) : NULL);
        fw_json_truth(out, "in_text", fw_text_same(d->place.file, file));
        position(out, "line", d->place.line, true);
        position(out, "column", d->place.column, d->place.line > 0);
        fw_json_text(out, "explain", entry ? entry->text : NULL);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_whole(out, "diagnostics_dropped", diags ? (long)diags->dropped : 0);
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
static fw_status parameters(fw_arena *arena, const fw_device *d, fw_json *out) {
    fw_json_list(out, "parameters");
    for (int i = 0; d && i < d->nparameter; i++) {
        const fw_device_parameter *p = &d->parameter[i];
        fw_quantity_unit unit = {.factor = 1.0};
        if (p->unit[0]) fw_quantity_unit_parse(p->unit, strlen(p->unit), &unit, NULL, NULL);
        const char *raw = written(arena, d, p->place), *const *names = NULL;
        size_t uses = 0;
        if (raw) FW_TRY(fw_quantity_expression_names(arena, raw, strlen(raw), &names, &uses));
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "name", p->name);
        fw_json_number(out, "value", fw_quantity_unit_from_si(&unit, p->value), 12);
        fw_json_text(out, "unit", p->unit);
        fw_json_number(out, "value_SI", p->value, 17);
        fw_json_number(out, "minimum", fw_quantity_unit_from_si(&unit, p->min), 12);
        fw_json_number(out, "maximum", fw_quantity_unit_from_si(&unit, p->max), 12);
        fw_json_text(out, "doc", p->doc);
        fw_json_text(out, "written", raw);
        fw_json_truth(out, "derived", uses > 0);
        fw_json_truth(out, "overridden", p->overridden);
        fw_json_whole(out, "line", p->place.line);
        fw_json_whole(out, "column", p->place.column);
        const char *path = fw_arena_printf(arena, "parameter[%s]/@value", p->name);
        FW_NEED(path);
        fw_json_text(out, "path", path);
        fw_json_end(out);
    }
    fw_json_end(out);
    return FW_OK;
}

static void scenes(const fw_report_preview *in, fw_json *out) {
    fw_json_list(out, "scenes");
    for (int i = 0; in->device && i < in->device->nscene; i++) {
        const fw_device_scene *s = &in->device->scene[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "name", s->name);
        fw_json_text(out, "flow", s->flow);
        fw_json_number(out, "duration_s", s->duration_s, DIGITS);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void flows(const fw_report_preview *in, fw_json *out) {
    fw_json_list(out, "flows");
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_flow *f = &in->flow[i];
        const fw_mechanism_variant *v = f->variant ? f->variant->variant : NULL;
        fw_json_object(out, NULL);
        fw_json_text(out, "name", v ? v->flow : NULL);
        fw_json_text(out, "material", v ? v->material.name : NULL);
        if (f->flow && f->flow->manufacturable >= 0)
            fw_json_truth(out, "manufacturable", f->flow->manufacturable);
        else
            fw_json_null(out, "manufacturable");
        fw_json_list(out, "reasons");
        for (int k = 0; f->flow && k < f->flow->nreason; k++)
            fw_json_text(out, NULL, f->flow->reason[k]);
        fw_json_end(out);
        fw_json_end(out);
    }
    fw_json_end(out);
}

/* ---- motion ---- */

/* so many decimals that a hundred millionth of the device shows */
static int decimals(const fw_mechanism *m) {
    double size = 0.0;
    for (int i = 0; i < m->npin; i++) {
        fw_geometry_vec2 p = fw_mechanism_pin_place(m, &m->pin[i], 0),
                         q = fw_mechanism_pin_place(m, &m->pin[0], 0);
        size = fmax(size, fmax(fabs(p.x - q.x), fabs(p.y - q.y)));
    }
    if (!(size > 1e-12)) return 12;
    return (int)fmax(4.0, fmin(16.0, 8.0 - floor(log10(size))));
}

static void column(fw_json *out, const char *name, const double *value, int stride, int count) {
    fw_json_list(out, name);
    for (int i = 0; i < count; i++)
        fw_json_number(out, NULL, value[(size_t)i * (size_t)stride], 7);
    fw_json_end(out);
}

/* rows like those of q: m/s and rad/s */
static void velocities(const fw_dynamics_motion *x, fw_json *out) {
    const int n = 3 * x->nbody;
    fw_json_list(out, "v");
    for (int i = 0; i < x->nsample; i++) {
        fw_dynamics_motion_rows(x, i, 1);
        fw_json_line(out, 0);
        column(out, NULL, x->v + (size_t)i * (size_t)n, 1, n);
    }
    fw_json_end(out);
    fw_json_line(out, 0);
}

/* rows of the states: [x, y, phi, x, y, phi ...] and [angle ...] */
static void states(const fw_mechanism *m, const fw_dynamics_motion *x, fw_json *out) {
    int places = decimals(m), n = 3 * x->nbody;
    fw_text_reserve(out->out, (size_t)x->nsample * (size_t)(16 * n + 14 * x->npin + 16));
    column(out, "t_s", x->t_s, 1, x->nsample);
    fw_json_line(out, 0);
    fw_json_list(out, "q");
    for (int i = 0; i < x->nsample; i++) {
        fw_json_line(out, 0);
        fw_json_list(out, NULL);
        for (int k = 0; k < n; k++)
            fw_json_fixed(out, NULL, x->q[(size_t)i * (size_t)n + (size_t)k],
                          k % 3 == 2 ? 8 : places);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_line(out, 0);
    fw_json_list(out, "angle_rad");
    for (int i = 0; i < x->nsample; i++) {
        fw_json_line(out, 0);
        fw_json_list(out, NULL);
        for (int k = 0; k < x->npin; k++)
            fw_json_fixed(out, NULL, x->angle_rad[(size_t)i * (size_t)x->npin + (size_t)k], 8);
        fw_json_end(out);
    }
    fw_json_end(out);
}

/* null of a sequence of equilibria, and where nobody asked */
static void energies(const fw_dynamics_motion *x, fw_json *out) {
    static const char *const name[] = {"kinetic_J", "potential_J", "dissipated_J", "work_J"};
    if (x->energy_J) {
        fw_json_object(out, "energy");
        for (int k = 0; k < 4; k++)
            column(out, name[k], x->energy_J + k, 4, x->nsample);
        fw_json_end(out);
        fw_json_line(out, 0);
    } else
        fw_json_null(out, "energy");
    if (x->constraint_norm)
        column(out, "constraint_norm", x->constraint_norm, 1, x->nsample);
    else
        fw_json_null(out, "constraint_norm");
}

static void peaks(const fw_mechanism *m, const fw_dynamics_motion *x, fw_json *out) {
    fw_json_list(out, "peaks");
    for (int i = 0; i < x->npin; i++) {
        fw_json_object(out, NULL);
        fw_json_text(out, "pin", m->pin[i].id);
        fw_json_number(out, "angle_rad", x->peak[i].angle_rad, 17);
        fw_json_number(out, "t_s", x->peak[i].t_s, DIGITS);
        fw_json_number(out, "error_rad", x->peak[i].error_rad, DIGITS);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void stats(const fw_dynamics_motion *x, fw_json *out) {
    const fw_dynamics_motion_stats *s = &x->stats;
    fw_json_object(out, "stats");
    fw_json_whole(out, "steps", s->steps);
    fw_json_whole(out, "rejected", s->rejected);
    fw_json_whole(out, "rhs", s->rhs);
    fw_json_whole(out, "projections", s->projections);
    fw_json_whole(out, "events", s->events);
    fw_json_whole(out, "jacobians", s->jacobians);
    fw_json_whole(out, "factorisations", s->factorisations);
    fw_json_number(out, "cpu_s", s->cpu_s, DIGITS);
    fw_json_number(out, "estimate_cpu_s", s->estimate_cpu_s, DIGITS);
    fw_json_number(out, "energy_error", s->energy_error, DIGITS);
    fw_json_number(out, "largest_energy_J", s->largest_energy_J, DIGITS);
    fw_json_number(out, "max_constraint_norm", s->max_constraint_norm, DIGITS);
    fw_json_number(out, "max_velocity_norm", s->max_velocity_norm, DIGITS);
    fw_json_end(out);
}

static void ledger(const fw_dynamics_motion *x, fw_json *out) {
    fw_json_list(out, "ledger");
    for (int i = 0; i < x->ledger.count; i++) {
        const fw_effect_entry *e = &x->ledger.item[i];
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", e->id);
        fw_json_truth(out, "called_for", e->called_for);
        fw_json_truth(out, "active", e->active);
        fw_json_number(out, "bound", e->bound, DIGITS);
        fw_json_number(out, "cost", e->cost, DIGITS);
        fw_json_text(out, "reason", e->reason);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_number(out, "ledger_left_out", x->ledger.left_out, DIGITS);
    fw_json_text(out, "hinge_model", fw_effects_hinge_model_text(x->ledger.hinge.used));
    fw_json_text(out, "hinge_model_why", x->ledger.hinge.why);
}

/* of a probe that is a length or an angle how fast it changes; null of all others */
static void rates(const fw_probe *probe, const fw_dynamics_motion *x, double *room, fw_json *out) {
    if (!fw_probe_has_rate(probe)) {
        fw_json_null(out, "rate");
        return;
    }
    fw_json_list(out, "rate");
    for (int k = 0; k < x->nsample; k++)
        fw_json_number(out, NULL, fw_probe_rate_at_row(probe, x, k, room), 7);
    fw_json_end(out);
}

/* a column each, in SI; nothing where the device has none */
static fw_status probes(fw_arena *arena, const fw_report_preview *in, fw_json *out) {
    const fw_dynamics_motion *x = in->motion;
    const int n = fw_probe_count(in->mechanism);
    double *room = NULL;
    fw_probe *probe;
    if (n == 0 || !in->scene) return FW_OK;
    const size_t numbers = 3 * (size_t)x->nbody + (size_t)x->npin;
    if (in->rates) FW_NEED(room = fw_arena_array(arena, double, numbers));
    FW_TRY(fw_probe_bind(arena, in->mechanism, in->scene, x->loads, &probe));
    fw_json_list(out, "probes");
    for (int i = 0; i < n; i++) {
        if (!fw_report_probe_moves(&probe[i])) continue;
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", probe[i].asked->id);
        fw_json_text(out, "kind", probe[i].kind->name);
        fw_json_text(out, "unit", probe[i].kind->unit);
        fw_json_list(out, "value");
        for (int k = 0; k < x->nsample; k++)
            fw_json_number(out, NULL, fw_probe_at_row(&probe[i], x, k), 7);
        fw_json_end(out);
        if (in->rates) rates(&probe[i], x, room, out);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_line(out, 0);
    return FW_OK;
}

static void begin_motion(const fw_report_preview *in, fw_json *out) {
    fw_json_object(out, "motion");
    fw_json_text(out, "scene", in->scene ? in->scene->name : NULL);
    fw_json_text(out, "flow", in->mechanism->variant ? in->mechanism->variant->flow : NULL);
}

static fw_status motion(fw_arena *arena, const fw_report_preview *in, fw_json *out) {
    const fw_dynamics_motion *x = in->motion;
    if (!x || !in->mechanism || x->nsample < 1) {
        fw_json_null(out, "motion");
        fw_json_line(out, 0);
        fw_json_list(out, "ledger");
        fw_json_end(out);
        fw_json_null(out, "ledger_left_out");
        fw_json_null(out, "hinge_model");
        fw_json_null(out, "hinge_model_why");
        return FW_OK;
    }
    begin_motion(in, out);
    fw_json_text(out, "method", x->method);
    fw_json_text(out, "integrator", x->integrator);
    fw_json_text(out, "reason", x->reason);
    fw_json_text(out, "stabilise", x->stabilise);
    fw_json_text(out, "method_report", x->method_report);
    fw_json_number(out, "rtol", x->stats.rtol, DIGITS);
    fw_json_truth(out, "ended", x->ended);
    fw_json_number(out, "end_s", x->end_s, DIGITS);
    fw_json_line(out, 0);
    stats(x, out);
    fw_json_line(out, 0);
    peaks(in->mechanism, x, out);
    fw_json_line(out, 0);
    energies(x, out);
    fw_json_line(out, 0);
    fw_report_preview_factors(in->scene, x, out);
    fw_json_line(out, 0);
    FW_TRY(fw_report_preview_tensions(arena, in->mechanism, in->scene, x, out));
    fw_json_line(out, 0);
    FW_TRY(probes(arena, in, out));
    if (in->rates) velocities(x, out);
    states(in->mechanism, x, out);
    fw_json_end(out);
    fw_json_line(out, 0);
    ledger(x, out);
    return FW_OK;
}

/* of it what a picture shows */
static fw_status pictured_motion(fw_arena *arena, const fw_report_preview *in, fw_json *out) {
    const fw_dynamics_motion *x = in->motion;
    if (!x || !in->mechanism || x->nsample < 1) {
        fw_json_null(out, "motion");
        return FW_OK;
    }
    begin_motion(in, out);
    fw_json_line(out, 0);
    peaks(in->mechanism, x, out);
    fw_json_line(out, 0);
    fw_report_preview_factors(in->scene, x, out);
    fw_json_line(out, 0);
    FW_TRY(fw_report_preview_tensions(arena, in->mechanism, in->scene, x, out));
    fw_json_line(out, 0);
    states(in->mechanism, x, out);
    fw_json_end(out);
    return FW_OK;
}

/* ---- what the picture marks ---- */

static fw_status marks(fw_arena *arena, const fw_report_preview *in, fw_json *out) {
    fw_report_marks all = {0};
    if (in->device) FW_TRY(fw_report_marks_of(arena, in->device, in->layout, in->verdict, &all));
    fw_json_list(out, "marks");
    for (int i = 0; i < all.count; i++) {
        const fw_report_mark *m = &all.item[i];
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        if (m->number > 0)
            fw_json_textf(out, "code", "FW-D%03d", m->number);
        else
            fw_json_null(out, "code");
        fw_json_text(out, "label", m->label);
        fw_json_text(out, "text", m->text);
        if (isfinite(m->at.x) && isfinite(m->at.y))
            fw_report_preview_point(out, "at_um", m->at.x, m->at.y);
        else
            fw_json_null(out, "at_um");
        fw_json_list(out, "bodies");
        for (int k = 0; k < m->nbody; k++)
            if (m->body[k] >= 0) fw_json_text(out, NULL, in->device->body[m->body[k]].id);
        fw_json_end(out);
        fw_json_list(out, "hinges");
        for (int k = 0; k < m->njoint; k++)
            fw_json_text(out, NULL, in->device->revolute[m->joint[k]].id);
        fw_json_end(out);
        fw_report_preview_outlines(out, "overlap", m->overlap);
        fw_json_end(out);
    }
    fw_json_end(out);
    return FW_OK;
}

/* ---- the document ---- */

static void left_out(const fw_report_preview *in, fw_json *out) {
    fw_json_list(out, "left_out");
    for (int i = 0; i < in->nleft_out; i++) {
        fw_json_object(out, NULL);
        fw_json_text(out, "what", in->left_out[i].what);
        fw_json_text(out, "sentence", in->left_out[i].sentence);
        fw_json_truth(out, "could_reject", in->left_out[i].could_reject);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void cost(const fw_report_preview *in, fw_json *out) {
    fw_json_object(out, "cost");
    fw_json_number(out, "read_s", in->read_s, 4);
    fw_json_number(out, "judge_s", in->judge_s, DIGITS);
    fw_json_number(out, "simulate_s", in->simulate_s, DIGITS);
    fw_json_end(out);
}

fw_status fw_report_preview_json(fw_arena *arena, const fw_report_preview *in, fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.preview/1");
    fw_json_text(out, "status", in->status);
    fw_json_whole(out, "exit_status", in->exit_status);
    fw_json_text(out, "decision",
                 in->verdict ? fw_verdict_decision_text(in->verdict->decision) : NULL);
    fw_json_truth(out, "provisional", in->provisional);
    fw_json_line(out, 0);
    left_out(in, out);
    fw_json_line(out, 0);
    fw_report_preview_diagnostics(in->diags, in->file, out);
    fw_json_text(out, "name", in->device ? in->device->name : NULL);
    fw_json_truth(out, "six_bar", in->device && in->device->six_bar);
    fw_json_line(out, 0);
    FW_TRY(parameters(arena, in->device, out));
    fw_json_line(out, 0);
    scenes(in, out);
    fw_json_line(out, 0);
    flows(in, out);
    fw_json_line(out, 0);
    FW_TRY(fw_report_preview_shapes(arena, in, out));
    fw_json_line(out, 0);
    FW_TRY(marks(arena, in, out));
    fw_json_line(out, 0);
    FW_TRY(motion(arena, in, out));
    fw_json_line(out, 0);
    /* a document of its own, which ends in a line break */
    fw_text_add(fw_json_value(out, "verdict"), in->verdict_json ? in->verdict_json : "null");
    fw_json_line(out, 0);
    cost(in, out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

fw_status fw_report_picture_json(fw_arena *arena, const fw_report_preview *in, fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.picture/1");
    fw_json_text(out, "status", in->status);
    fw_json_text(out, "name", in->device ? in->device->name : NULL);
    fw_json_line(out, 0);
    scenes(in, out);
    fw_json_line(out, 0);
    FW_TRY(fw_report_preview_shapes(arena, in, out));
    fw_json_line(out, 0);
    FW_TRY(marks(arena, in, out));
    fw_json_line(out, 0);
    FW_TRY(pictured_motion(arena, in, out));
    fw_json_line(out, 0);
    cost(in, out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}
