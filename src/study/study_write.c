/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The documents of a study: its table, JSON, one page, and the files that hold them. */
#include "base/json.h"
#include "base/output.h"
#include "study/study.h"
#include "study/study_parts.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- the table ---- */

typedef struct table {
    const fw_study *study;
    FILE *file;
    fw_text line;
    fw_arena *arena;
} table;

static void real(fw_text *out, double value) {
    fw_text_add(out, ",");
    if (!isnan(value)) fw_text_number(out, value, 17);
}

static fw_status row(void *context, const fw_study_sample *s) {
    table *t = context;
    fw_mark mark = fw_arena_mark(t->arena);
    fw_text line = fw_text_new(t->arena);
    fw_text_printf(&line, "%ld,", s->i);
    fw_text_add(&line, fw_study_state_text(s->run, s->decision));
    fw_text_add(&line, ",");
    fw_text_csv(&line, s->why);
    real(&line, s->used);
    for (int k = 0; k < t->study->ninput; k++)
        if (t->study->input[k].ntext > 0)
            fw_text_add(&line, ","), fw_text_csv(&line, s->text[k]);
        else
            real(&line, s->value[k]);
    for (int k = 0; k < t->study->nresponse; k++)
        real(&line, s->response[k]);
    fw_text_add(&line, "\n");
    fw_status status = fw_text_end(&line);
    if (status == FW_OK && fwrite(line.data, 1, line.length, t->file) != line.length)
        status = FW_IO;
    fw_arena_rewind(t->arena, mark);
    return status;
}

static fw_status write_table(table *t) {
    fw_text *head = &t->line;
    fw_text_add(head, "i,state,why,limit_used");
    for (int k = 0; k < t->study->ninput; k++)
        fw_text_add(head, ","), fw_text_csv(head, t->study->input[k].what);
    for (int k = 0; k < t->study->nresponse; k++)
        fw_text_add(head, ","), fw_text_csv(head, t->study->response[k].asked->name);
    fw_text_add(head, "\n");
    FW_TRY(fw_text_end(head));
    if (fwrite(head->data, 1, head->length, t->file) != head->length) return FW_IO;
    return fw_study_store_each(t->study->store, row, t);
}

/* rows go to the file as they are read: memory does not grow with them */
static fw_status save_table(fw_study *study, const char *path) {
    const char *aside = fw_arena_printf(study->arena, "%s.tmp-%ld", path, (long)getpid());
    FW_NEED(aside);
    table t = {.study = study, .line = fw_text_new(study->arena), .arena = study->arena};
    fw_output_remove_leftovers(study->arena, path);
    t.file = fopen(aside, "wb");
    fw_status status = t.file ? write_table(&t) : FW_IO;
    if (status == FW_OK && (fflush(t.file) != 0 || fsync(fileno(t.file)) != 0)) status = FW_IO;
    int why = errno;
    if (t.file && fclose(t.file) != 0 && status == FW_OK) status = FW_IO, why = errno;
    if (status == FW_OK && rename(aside, path) != 0) status = FW_IO, why = errno;
    if (status == FW_OK) return FW_OK;
    unlink(aside);
    if (status != FW_IO || study->diags.errors > 0) return status;
    return fw_diag_error(fw_diags_because(&study->diags, why), 222, (fw_place){.file = path},
                         "could not be written: %s", strerror(why)) == FW_NOMEM
               ? FW_NOMEM
               : FW_IO;
}

/* ---- JSON ---- */

static void settings(fw_json *j, const fw_study *study, char (*text)[FW_STUDY_TEXT]) {
    fw_json_list(j, "set");
    for (int k = 0; k < study->nvary; k++) {
        fw_json_object(j, NULL);
        fw_json_text(j, "path", study->input[k].what);
        fw_json_text(j, "value", text[k]);
        fw_json_end(j);
    }
    fw_json_end(j);
}

/* what was set on the command line, of every device: studies of one file differ by it */
static void given(fw_json *j, const fw_study *study) {
    fw_json_list(j, "set");
    for (int k = 0; k < study->options.nset; k++) {
        fw_json_object(j, NULL);
        fw_json_text(j, "path", study->options.set[k].path);
        fw_json_text(j, "value", study->options.set[k].value);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void inputs(fw_json *j, const fw_study *study) {
    fw_json_list(j, "inputs");
    for (int k = 0; k < study->ninput; k++) {
        const fw_study_input *in = &study->input[k];
        fw_json_object(j, NULL);
        fw_json_text(j, "what", in->what);
        fw_json_text(j, "role", k < study->nvary ? "vary" : "uncertain");
        fw_json_text(j, "unit", in->unit_text);
        fw_json_real(j, "from_SI", in->from);
        fw_json_real(j, "to_SI", in->to);
        fw_json_real(j, "now_SI", in->now);
        fw_json_list(j, "values");
        for (int i = 0; i < in->ntext; i++)
            fw_json_text(j, NULL, in->text[i]);
        fw_json_end(j);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void extreme(fw_json *j, const fw_study_extreme *e) {
    double n = (double)e->n, mean = e->n > 0 ? e->first + e->sum / n : (double)NAN;
    double variance = e->n > 1 ? (e->square - e->sum * e->sum / n) / (n - 1) : (double)NAN;
    fw_json_whole(j, "values", e->n);
    fw_json_real(j, "least", e->least);
    fw_json_whole(j, "least_at", e->least_at);
    fw_json_real(j, "largest", e->largest);
    fw_json_whole(j, "largest_at", e->largest_at);
    fw_json_real(j, "mean", mean);
    fw_json_real(j, "deviation", sqrt(fmax(variance, 0)));
}

static void interval(fw_json *j, const char *key, double low, double high) {
    fw_json_list(j, key);
    fw_json_real(j, NULL, low);
    fw_json_real(j, NULL, high);
    fw_json_end(j);
}

static void derivatives(fw_json *j, const fw_study *study, int r) {
    const fw_study_result *result = study->result;
    if (!result->derivative) return;
    fw_json_list(j, "by");
    for (int k = 0; k < study->ninput; k++) {
        const size_t at = (size_t)r * (size_t)study->ninput + (size_t)k;
        const fw_study_derivative *d = &result->derivative[at];
        fw_json_object(j, NULL);
        fw_json_text(j, "what", study->input[k].what);
        fw_json_real(j, "at_SI", fw_study_input_centre(&study->input[k]));
        fw_json_truth(j, "at_description", fw_study_input_is_inside(&study->input[k]));
        fw_json_real(j, "derivative_SI", d->value);
        fw_json_real(j, "derivative_error_SI", d->error);
        fw_json_real(j, "derivative_over_SI", d->over);
        fw_json_real(j, "half_range_effect", d->spread);
        if (result->index) {
            const fw_study_index *x = &result->index[at];
            fw_json_real(j, "first", x->first);
            interval(j, "first_interval", x->first_low, x->first_high);
            fw_json_real(j, "total", x->total);
            interval(j, "total_interval", x->total_low, x->total_high);
        }
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void ends(fw_json *j, const fw_study *study, int r) {
    static const char *const name[] = {"worst_least", "worst_largest"};
    for (int e = 0; study->result->end && e < 2; e++) {
        const fw_study_end *end = &study->result->end[2 * r + e];
        if (!end->known) {
            fw_json_null(j, name[e]);
            continue;
        }
        fw_json_object(j, name[e]);
        fw_json_real(j, "value", end->value);
        settings(j, study, end->text);
        fw_json_end(j);
    }
}

/* devices of which the numbers above tell nothing, and the first of them */
static void without(fw_json *j, const fw_study *study, const fw_study_without *w) {
    if (w->at < 0) {
        fw_json_null(j, "without");
        return;
    }
    fw_json_object(j, "without");
    fw_json_whole(j, "devices", w->n);
    fw_json_whole(j, "accepted", w->accepted);
    fw_json_whole(j, "rejected", w->rejected);
    fw_json_whole(j, "inconclusive", w->inconclusive);
    fw_json_whole(j, "failed", w->failed);
    fw_json_whole(j, "first_at", w->at);
    fw_json_text(j, "first_state", w->state);
    settings(j, study, w->text);
    fw_json_end(j);
}

static void responses_json(fw_json *j, const fw_study *study) {
    fw_json_list(j, "responses");
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        fw_json_object(j, NULL);
        fw_json_text(j, "name", q->asked->name);
        fw_json_text(j, "value", q->asked->value);
        fw_json_text(j, "unit", q->unit);
        fw_json_truth(j, "share", q->share);
        fw_json_real(j, "min", q->min);
        fw_json_real(j, "max", q->max);
        fw_json_real(j, "now", q->now);
        fw_study_counted_json(j, study, r);
        if (study->result->fitted) fw_json_real(j, "told_within", study->result->fitted->off[r]);
        extreme(j, &study->result->extreme[r]);
        without(j, study, &study->result->extreme[r].without);
        if (study->result->index_rows) {
            fw_json_whole(j, "index_groups", (long)study->result->index_rows[r]);
            fw_json_whole(j, "index_groups_of", (long)study->result->index_rows_all);
        }
        derivatives(j, study, r);
        ends(j, study, r);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void fitted(fw_json *j, const fw_study *study) {
    const fw_study_fitted *f = study->result->fitted;
    if (!f) return;
    fw_json_object(j, "fitted");
    fw_json_real(j, "asked", study->asked->fitted);
    fw_json_whole(j, "judged", f->judged);
    fw_json_whole(j, "left_open", f->open);
    fw_json_whole(j, "told", f->told);
    fw_json_whole(j, "checked", f->checked);
    fw_json_real(j, "limit_used_within", f->used_off);
    fw_json_end(j);
}

static void found(fw_json *j, const char *key, const fw_study *study, const fw_study_found *f) {
    fw_json_object(j, key);
    fw_json_whole(j, "i", f->i);
    settings(j, study, f->text);
    fw_json_list(j, "responses");
    for (int r = 0; r < study->nresponse; r++) {
        fw_json_object(j, NULL);
        fw_json_text(j, "name", study->response[r].asked->name);
        fw_json_real(j, "value", f->response[r]);
        fw_json_end(j);
    }
    fw_json_end(j);
    fw_json_real(j, "excess", f->excess);
    fw_json_text(j, "verdict", fw_study_state_text(true, f->decision));
    fw_json_list(j, "limits");
    for (int k = 0; k < f->nlimit; k++)
        fw_json_text(j, NULL, f->limit[k]);
    fw_json_end(j);
    fw_json_end(j);
}

static void size(fw_json *j, const fw_study *study) {
    const fw_study_result *r = study->result;
    if (study->asked->kind != FW_STUDY_IS_size) return;
    fw_json_list(j, "found");
    for (int i = 0; i < r->nfound; i++)
        found(j, NULL, study, &r->found[i]);
    fw_json_end(j);
    if (r->nearest.text)
        found(j, "nearest", study, &r->nearest);
    else
        fw_json_null(j, "nearest");
}

static void share(fw_json *j, const char *key, const fw_chance_share *v) {
    fw_json_object(j, key);
    fw_json_real(j, "value", v->value);
    interval(j, "interval", v->low, v->high);
    fw_json_end(j);
}

static void places(fw_json *j, const fw_study_levels *l) {
    fw_json_list(j, "places");
    for (size_t q = 0; l->at && q < l->scatter->places; q++) {
        const fw_study_place *p = &l->scatter->place[q];
        fw_json_object(j, NULL);
        fw_json_text(j, "die", p->id);
        fw_json_real(j, "x_m", p->at.x_m);
        fw_json_real(j, "y_m", p->at.y_m);
        share(j, "yield", &l->at[q]);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void levels(fw_json *j, const fw_study_levels *l) {
    if (!l || l->used.units == 0) {
        fw_json_null(j, "levels");
        return;
    }
    fw_json_object(j, "levels");
    fw_json_whole(j, "devices", l->devices);
    fw_json_whole(j, "not_judged", l->not_judged);
    fw_json_object(j, "shares");
    share(j, "lot", &l->used.lot);
    share(j, "wafer", &l->used.wafer);
    share(j, "place", &l->used.place);
    share(j, "die", &l->used.die);
    share(j, "hinge", &l->used.hinge);
    fw_json_end(j);
    share(j, "dies_of_one_wafer", &l->used.of_one_wafer);
    share(j, "wafers_of_one_lot", &l->used.of_one_lot);
    fw_json_real(j, "yield_deviation_of_wafers", l->held.wafer_sd.value);
    interval(j, "yield_deviation_of_wafers_interval", l->held.wafer_sd.low, l->held.wafer_sd.high);
    fw_json_real(j, "yield_deviation_of_lots", l->held.lot_sd.value);
    interval(j, "yield_deviation_of_lots_interval", l->held.lot_sd.low, l->held.lot_sd.high);
    places(j, l);
    fw_json_end(j);
}

static void steps(fw_json *j, const fw_study_yield_end *y) {
    fw_json_list(j, "convergence");
    for (size_t k = 0; k < y->steps; k++) {
        fw_json_object(j, NULL);
        fw_json_whole(j, "devices", (long)y->step[k].evaluations);
        fw_json_real(j, "yield", 1 - y->step[k].probability);
        interval(j, "sampling_interval", 1 - y->step[k].high, 1 - y->step[k].low);
        fw_json_end(j);
    }
    fw_json_end(j);
}

/* of a range: its least and its most, each where it was found */
static void yield_end(fw_json *j, const char *key, const fw_study_flow_yield *y,
                      const fw_study_yield_end *end) {
    fw_json_object(j, key);
    fw_json_real(j, "yield", end->value);
    interval(j, "sampling_interval", end->low, end->high);
    fw_json_list(j, "assumed");
    for (int k = 0; k < y->nassumed; k++) {
        fw_json_object(j, NULL);
        fw_json_text(j, "what", y->assumed[k]);
        fw_json_text(j, "unit", y->assumed_unit[k]);
        fw_json_real(j, "value_SI", end->at[k]);
        fw_json_end(j);
    }
    fw_json_end(j);
    steps(j, end);
    fw_json_end(j);
}

/* of a yield, and of the device that a size at a wanted yield has found */
static void yields(fw_json *j, const fw_study *study) {
    if (study->asked->kind != FW_STUDY_IS_yield && !(study->asked->yield > 0)) return;
    fw_json_list(j, "yields");
    for (int i = 0; i < study->result->nyield; i++) {
        const fw_study_flow_yield *y = &study->result->yield[i];
        fw_json_object(j, NULL);
        fw_json_text(j, "flow", y->flow);
        interval(j, "yield_range", y->low, y->high);
        fw_json_real(j, "yield", y->value);
        interval(j, "sampling_interval", y->sampled_low, y->sampled_high);
        if (y->nassumed > 0) {
            yield_end(j, "least", y, &y->least);
            yield_end(j, "most", y, &y->most);
        } else {
            fw_json_null(j, "least");
            fw_json_null(j, "most");
        }
        fw_json_whole(j, "settings", y->settings);
        fw_json_truth(j, "inside", y->settings > 1L << y->nassumed);
        fw_json_text(j, "sought", y->sought);
        fw_json_real(j, "confidence", study->asked->confidence);
        fw_json_real(j, "model_band", y->band);
        fw_json_text(j, "method", y->method);
        fw_json_text(j, "reason", y->reason);
        fw_json_text(j, "caution", y->caution);
        fw_json_whole(j, "devices", y->evaluations);
        fw_json_whole(j, "devices_of_one_estimate", y->each);
        fw_json_whole(j, "not_judged", y->unevaluated);
        fw_json_real(j, "distance_sigma", y->beta);
        fw_json_list(j, "by");
        for (int k = 0; k < y->ninput; k++) {
            fw_json_object(j, NULL);
            fw_json_text(j, "what", y->input[k]);
            fw_json_text(j, "unit", y->unit[k]);
            fw_json_real(j, "share", y->share ? y->share[k] : (double)NAN);
            fw_json_real(j, "nearest_failing_SI", y->at ? y->at[k] : (double)NAN);
            fw_json_end(j);
        }
        fw_json_end(j);
        levels(j, y->levels);
        if (y->nassumed == 0) steps(j, &y->least);
        fw_json_end(j);
    }
    fw_json_end(j);
}

fw_status fw_study_json(const fw_study *study, fw_text *out) {
    const fw_study_result *r = study->result;
    fw_json j = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&j, NULL);
    fw_json_text(&j, "schema", "flexwright.study/1");
    fw_json_text(&j, "study", study->asked->name);
    fw_json_text(&j, "kind", fw_device_study_kind_text(study->asked->kind));
    fw_json_text(&j, "device", study->device_name);
    fw_json_text(&j, "version", FW_VERSION);
    fw_json_text(&j, "hash", study->hash);
    fw_json_whole(&j, "seed", study->asked->seed);
    fw_json_text(&j, "judged_as", fw_device_study_judge_text(study->asked->judge));
    fw_json_object(&j, "samples");
    fw_json_whole(&j, "run", r->run);
    fw_json_whole(&j, "failed", r->failed);
    fw_json_whole(&j, "accepted", r->accepted);
    fw_json_whole(&j, "accepted_at_some_corners", r->partly);
    fw_json_whole(&j, "rejected", r->rejected);
    fw_json_whole(&j, "inconclusive", r->inconclusive);
    fw_json_text(&j, "example_why", r->example_why);
    if (r->example_why)
        fw_json_whole(&j, "example_at", r->example_at);
    else
        fw_json_null(&j, "example_at");
    fw_json_end(&j);
    given(&j, study);
    inputs(&j, study);
    fitted(&j, study);
    responses_json(&j, study);
    size(&j, study);
    if (study->asked->yield > 0) fw_json_real(&j, "wanted_yield", study->asked->yield);
    yields(&j, study);
    fw_json_text(&j, "how", r->how);
    fw_json_end(&j);
    return fw_json_finish(&j, "\n");
}

/* ---- the page ----
   What was asked, what came of it, the pictures, the best designs. One file that needs nothing beside it,
   readable without script and on paper. */

static void text(fw_text *out, const char *before, const char *content, const char *behind) {
    fw_text_add(out, before);
    fw_text_escaped(out, content);
    fw_text_add(out, behind);
}

static void number(fw_text *out, const fw_study_response *response, double value) {
    fw_text_add(out, "<td>");
    if (isnan(value))
        fw_text_add(out, "&ndash;");
    else
        fw_study_response_text(out, response, value);
    fw_text_add(out, "</td>");
}

static void head(const fw_study *study, fw_text *out) {
    fw_text_add(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta "
                     "name=\"viewport\" "
                     "content=\"width=device-width\">");
    text(out, "<title>Study ", study->asked->name, " of ");
    text(out, "", study->device_name,
         "</title>\n<style>body{font:16px/1.5 system-ui,sans-serif;max-width:76rem;margin:1.5rem "
         "auto;padding:0 "
         "1rem;color:#1f2328;background:#fff}table{border-collapse:collapse;margin:.6rem "
         "0}td,th{border-bottom:1px "
         "solid #d0d7de;padding:.25rem "
         ".7rem;text-align:left;vertical-align:top}pre{background:#f6f8fa;padding:.8rem;overflow-x:"
         "auto;white-space:"
         "pre-wrap}figure{display:inline-block;width:min(100%,36rem);margin:.5rem .5rem .5rem "
         "0}figure "
         "svg{width:100%;height:auto}.wide{overflow-x:auto}</style></head>\n<body>\n");
    text(out, "<h1>Study ", study->asked->name, ": ");
    text(out, "", study->device_name, "</h1>\n");
}

static void response_table(const fw_study *study, fw_text *out) {
    if (study->nresponse == 0) return;
    fw_text_add(out, "<h2>Responses</h2>\n<div "
                     "class=\"wide\"><table><tr><th>name</th><th>value</th><th>now</th><th>least</"
                     "th><th>largest</th>"
                     "<th>at least</th><th>at most</th><th>devices without a value</th></tr>\n");
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        const fw_study_extreme *e = &study->result->extreme[r];
        text(out, "<tr><td>", q->asked->name, "</td>");
        text(out, "<td><code>", q->asked->value, "</code></td>");
        number(out, q, q->now);
        number(out, q, e->least);
        number(out, q, e->largest);
        number(out, q, q->min);
        number(out, q, q->max);
        fw_text_printf(out, "<td>%ld</td></tr>\n", e->without.n);
    }
    fw_text_add(out, "</table></div>\n");
}

/* a design with the line that goes on with it */
static void design(const fw_study *study, const fw_study_found *f, fw_text *out) {
    fw_text_add(out, "<tr>");
    for (int r = 0; r < study->nresponse; r++)
        number(out, &study->response[r], f->response[r]);
    fw_text_add(out, "<td><code>flexwright check ");
    fw_text_escaped(out, study->device_path);
    for (int k = 0; k < study->nvary; k++) {
        text(out, " --set &quot;", study->input[k].what, "=");
        text(out, "", f->text[k], "&quot;");
    }
    fw_text_add(out, "</code></td></tr>\n");
}

static void designs(const fw_study *study, fw_text *out) {
    const fw_study_result *result = study->result;
    if (study->asked->kind != FW_STUDY_IS_size) return;
    fw_text_add(out, result->nfound > 0 ? "<h2>Designs</h2>\n"
                                        : "<h2>No design holds every limit; the nearest</h2>\n");
    fw_text_add(out, "<div class=\"wide\"><table><tr>");
    for (int r = 0; r < study->nresponse; r++)
        text(out, "<th>", study->response[r].asked->name, "</th>");
    fw_text_add(out, "<th>go on with</th></tr>\n");
    for (int i = 0; i < result->nfound; i++)
        design(study, &result->found[i], out);
    if (result->nearest.text) design(study, &result->nearest, out);
    fw_text_add(out, "</table></div>\n");
}

static void figure(const fw_study_picture *p, fw_text *out) {
    fw_text_add(out, "<figure>");
    fw_text_add(out, p->svg.data);
    if (p->captioned) text(out, "<figcaption>", p->title, "</figcaption>");
    fw_text_add(out, "</figure>\n");
}

fw_status fw_study_html(const fw_study *study, const fw_study_picture *picture, int n,
                        fw_text *out) {
    fw_text said = fw_text_new(study->arena), asked = fw_text_new(study->arena);
    FW_TRY(fw_study_text(study, &said));
    FW_TRY(fw_study_asked_text(study, &asked));
    head(study, out);
    text(out, "<pre>", said.data, "</pre>\n");
    designs(study, out);
    for (int i = 0; i < n; i++)
        figure(&picture[i], out);
    response_table(study, out);
    text(out, "<h2>What was asked</h2>\n<pre>", asked.data, "</pre>\n");
    fw_text_add(out, "<p>All samples are in <code>study.sqlite</code> and <code>study.csv</code>; "
                     "the pictures are files of their own; the numbers above are "
                     "<code>study.json</code>.</p>\n");
    text(out, "<p>flexwright ", FW_VERSION, ", study ");
    fw_text_printf(out, "%.12s, seed %ld</p>\n</body>\n</html>\n", study->hash, study->asked->seed);
    return fw_text_end(out);
}

/* ---- files ---- */

static fw_output_member member(const char *name, const fw_text *text) {
    return (fw_output_member){name, text->data, text->length};
}

/* pictures of an earlier study in the directory went when its store did */
static fw_status write_pictures(fw_study *study, const fw_study_picture *picture, int n) {
    fw_output_member *file = fw_arena_array(study->arena, fw_output_member, (size_t)n);
    const char *directory = fw_arena_printf(study->arena, "%s/pictures", study->options.output);
    FW_NEED(file && directory ? file : NULL);
    for (int i = 0; i < n; i++) {
        const char *name = fw_arena_printf(study->arena, "%s.svg", picture[i].name);
        fw_text svg = fw_text_new(study->arena);
        fw_text_add(&svg, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        fw_text_add(&svg, picture[i].svg.data);
        FW_TRY(fw_text_end(&svg));
        FW_NEED(name);
        file[i] = member(name, &svg);
    }
    if (n == 0) return FW_OK;
    bool made;
    FW_TRY(fw_output_directory(study->arena, directory, &made));
    return fw_output_members(study->arena, directory, file, (size_t)n, &study->diags);
}

fw_status fw_study_write(fw_study *study) {
    fw_text json = fw_text_new(study->arena), html = fw_text_new(study->arena);
    const fw_study_picture *picture;
    int n;
    const char *csv = fw_arena_printf(study->arena, "%s/study.csv", study->options.output);
    FW_NEED(csv);
    FW_TRY(fw_study_json(study, &json));
    FW_TRY(fw_study_pictures(study, &picture, &n));
    FW_TRY(fw_study_html(study, picture, n, &html));
    FW_TRY(save_table(study, csv));
    FW_TRY(write_pictures(study, picture, n));
    const fw_output_member file[] = {member("study.html", &html), member("study.json", &json)};
    return fw_output_members(study->arena, study->options.output, file, 2, &study->diags);
}
