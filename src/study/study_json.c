/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/json.h"
#include "study/study_parts.h"
#include "study/study_result.h"
#include "study/study_write.h"
#include <math.h>

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

static void derivatives(fw_json *j, const fw_study *study, int r) {
    const fw_study_result *result = study->result;
    if (!result->derivative) return;
    fw_json_list(j, "by");
    for (int k = 0; k < study->ninput; k++) {
        const size_t at = (size_t)r * (size_t)study->ninput + (size_t)k;
        const fw_study_derivative *d = &result->derivative[at];
        fw_json_object(j, NULL);
        fw_json_text(j, "what", study->input[k].what);
        fw_json_real(j, "derivative_SI", d->value);
        fw_json_real(j, "derivative_error_SI", d->error);
        fw_json_real(j, "half_range_effect", d->spread);
        if (result->index) {
            const fw_study_index *x = &result->index[at];
            fw_json_real(j, "first", x->first);
            fw_json_list(j, "first_interval");
            fw_json_real(j, NULL, x->first_low);
            fw_json_real(j, NULL, x->first_high);
            fw_json_end(j);
            fw_json_real(j, "total", x->total);
            fw_json_list(j, "total_interval");
            fw_json_real(j, NULL, x->total_low);
            fw_json_real(j, NULL, x->total_high);
            fw_json_end(j);
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

static void responses(fw_json *j, const fw_study *study) {
    fw_json_list(j, "responses");
    for (int r = 0; r < study->nresponse; r++) {
        const fw_study_response *q = &study->response[r];
        fw_json_object(j, NULL);
        fw_json_text(j, "name", q->asked->name);
        fw_json_text(j, "value", q->asked->value);
        fw_json_text(j, "unit", q->unit);
        fw_json_real(j, "min", q->asked->min);
        fw_json_real(j, "max", q->asked->max);
        fw_json_real(j, "now", q->now);
        extreme(j, &study->result->extreme[r]);
        derivatives(j, study, r);
        ends(j, study, r);
        fw_json_end(j);
    }
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

static void yields(fw_json *j, const fw_study *study) {
    if (study->asked->kind != FW_STUDY_IS_yield) return;
    fw_json_list(j, "yields");
    for (int i = 0; i < study->result->nyield; i++) {
        const fw_study_flow_yield *y = &study->result->yield[i];
        fw_json_object(j, NULL);
        fw_json_text(j, "flow", y->flow);
        fw_json_list(j, "yield_range");
        fw_json_real(j, NULL, y->low);
        fw_json_real(j, NULL, y->high);
        fw_json_end(j);
        fw_json_real(j, "yield", y->value);
        fw_json_list(j, "sampling_interval");
        fw_json_real(j, NULL, y->sampled_low);
        fw_json_real(j, NULL, y->sampled_high);
        fw_json_end(j);
        fw_json_real(j, "confidence", study->asked->confidence);
        fw_json_real(j, "model_band", y->band);
        fw_json_text(j, "method", y->method);
        fw_json_text(j, "reason", y->reason);
        fw_json_text(j, "caution", y->caution);
        fw_json_whole(j, "devices", y->evaluations);
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
    fw_json_whole(&j, "rejected", r->rejected);
    fw_json_whole(&j, "inconclusive", r->inconclusive);
    fw_json_text(&j, "example_why", r->example_why);
    if (r->example_why)
        fw_json_whole(&j, "example_at", r->example_at);
    else
        fw_json_null(&j, "example_at");
    fw_json_end(&j);
    inputs(&j, study);
    responses(&j, study);
    size(&j, study);
    yields(&j, study);
    fw_json_text(&j, "how", r->how);
    fw_json_end(&j);
    return fw_json_finish(&j, "\n");
}
