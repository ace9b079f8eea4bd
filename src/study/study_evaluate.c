/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device of a study: the description with its settings through the same calls that the commands make,
   so that a sample says what `check` would say of it, and its numbers from the same documents. */
#include "plan/design.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

fw_status fw_study_sample_new(fw_arena *arena, const fw_study *study, fw_study_sample *sample) {
    *sample = (fw_study_sample){.decision = -1};
    FW_NEED(sample->text = fw_arena_alloc(arena, (size_t)study->ninput, sizeof *sample->text));
    FW_NEED(sample->value = fw_arena_array(arena, double, (size_t)study->ninput));
    FW_NEED(sample->response = fw_arena_array(arena, double, (size_t)study->nresponse));
    return FW_OK;
}

const char *fw_study_state_text(bool run, int decision) {
    return !run            ? "failed"
           : decision == 0 ? "accept"
           : decision == 1 ? "reject"
           : decision == 4 ? "inconclusive"
                           : "run";
}

void fw_study_sample_copy(const fw_study *study, const fw_study_sample *from, fw_study_sample *to) {
    to->i = from->i, to->decision = from->decision, to->run = from->run, to->used = from->used;
    memcpy(to->why, from->why, FW_STUDY_WHY);
    memcpy(to->text, from->text, (size_t)study->ninput * sizeof *to->text);
    memcpy(to->value, from->value, (size_t)study->ninput * sizeof *to->value);
    memcpy(to->response, from->response, (size_t)study->nresponse * sizeof *to->response);
}

fw_status fw_study_files_hash(fw_arena *arena, const fw_plan *plan, const char **hash) {
    fw_text all = fw_text_new(arena);
    char digits[65];
    for (int i = 0; i < plan->ninput; i++)
        fw_text_printf(&all, "%s %s\n", plan->input[i].name, plan->input[i].sha256);
    FW_TRY(fw_text_end(&all));
    fw_sha256(all.data, all.length, digits);
    FW_NEED(*hash = fw_arena_strdup(arena, digits));
    return FW_OK;
}

fw_design *fw_study_design(const fw_study *study, const fw_cancel *cancel,
                           const char (*text)[FW_STUDY_TEXT], int *status) {
    fw_design *design = fw_design_new(&study->options.design);
    *status = FW_STATUS_NOMEM;
    if (!design) return NULL;
    fw_plan_design_cancel_with(design, cancel);
    fw_plan_design_plan(design)->options.verdict.hinges_only =
        study->asked && study->asked->judge == FW_JUDGE_HINGES;
    fw_plan_design_plan(design)->options.lab_text = study->options.lab_text;
    fw_plan_design_plan(design)->options.nlab_text = study->options.nlab_text;
    *status = FW_STATUS_OK;
    for (int i = 0; *status == FW_STATUS_OK && i < study->options.nset; i++)
        *status = fw_design_set(design, study->options.set[i].path, study->options.set[i].value);
    for (int i = 0; text && *status == FW_STATUS_OK && i < study->ninput; i++)
        if (text[i][0]) *status = fw_design_set(design, study->input[i].what, text[i]);
    if (*status == FW_STATUS_OK && study->options.text)
        *status = fw_design_read_memory(design, study->device_path, study->options.text,
                                        study->options.length);
    else if (*status == FW_STATUS_OK)
        *status = fw_design_read(design, study->device_path);
    return design;
}

/* what the responses need, in the order in which stages build on each other */
int fw_study_stages_run(fw_design *design, unsigned stages) {
    static const struct {
        unsigned stage;
        int (*call)(fw_design *design);
    } step[] = {{FW_STUDY_STAGE_JUDGE, fw_design_judge},
                {FW_STUDY_STAGE_FABRICATE, fw_design_fabricate},
                {FW_STUDY_STAGE_SIMULATE, fw_design_simulate},
                {FW_STUDY_STAGE_STATICS, fw_design_statics},
                {FW_STUDY_STAGE_MODES, fw_design_modes},
                {FW_STUDY_STAGE_WORKSPACE, fw_design_workspace}};
    int status = FW_STATUS_OK;
    for (size_t i = 0; i < sizeof step / sizeof step[0] && status == FW_STATUS_OK; i++)
        if (stages & step[i].stage) status = step[i].call(design);
    return status;
}

static void first_error(fw_design *design, int status, char why[FW_STUDY_WHY]) {
    const char *text = fw_status_name(status);
    for (size_t i = fw_design_diagnostics(design); i-- > 0;) {
        const fw_diagnostic *d = fw_design_diagnostic(design, i);
        if (d->severity == FW_SEVERITY_ERROR) text = d->message;
    }
    snprintf(why, FW_STUDY_WHY, "%s", text);
}

static bool begins_with(const fw_study *study, int document, const char *key, size_t n) {
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *r = &study->response[k];
        if (r->document == document && strcspn(r->path, ".[") == n && memcmp(r->path, key, n) == 0)
            return true;
    }
    return false;
}

/* Of a document only the members that responses begin with, cut out: reading the others costs as much as composing
   them all. Bytes between quotes are skipped with what stands behind a backslash. */
static fw_status members_of(const fw_study *study, int document, fw_arena *arena, const char *text,
                            size_t n, json_t **root) {
    fw_text cut = fw_text_new(arena);
    int depth = 0;
    const char *member = NULL; /* at its key's quote; NULL: none is begun */
    size_t key = 0;            /* its length */
    for (size_t i = 0; i < n; i++) {
        const char c = text[i];
        if (c == '"') {
            const char *from = text + i;
            for (i++; i < n && text[i] != '"'; i++)
                i += text[i] == '\\';
            if (depth == 1 && !member) member = from, key = (size_t)(text + i - from) - 1;
        } else if (depth == 1 && (c == ',' || c == '}')) {
            if (member && begins_with(study, document, member + 1, key))
                fw_text_printf(&cut, "%c%.*s", cut.length > 0 ? ',' : '{', (int)(text + i - member),
                               member);
            member = NULL;
            depth -= c == '}';
        } else
            depth += (c == '{' || c == '[') - (c == '}' || c == ']');
    }
    fw_text_add(&cut, cut.length > 0 ? "}" : "{}");
    FW_TRY(fw_text_end(&cut));
    FW_NEED(*root = json_loadb(cut.data, cut.length, 0, NULL));
    return FW_OK;
}

int fw_study_responses_take(const fw_study *study, fw_design *design, double *value,
                            fw_diags *diags) {
    char why[FW_STUDY_WHY];
    for (int d = 0; d < fw_study_document_count; d++) {
        json_t *root = NULL;
        for (int k = 0; k < study->nresponse; k++) {
            const fw_study_response *r = &study->response[k];
            const char *text;
            size_t n;
            if (r->document != d) continue;
            if (!root) {
                int status = fw_design_document(design, fw_study_documents[d].document, &text, &n);
                if (status != FW_STATUS_OK) return status;
                if (diags)
                    root = json_loadb(text, n, 0, NULL);
                else
                    status = (int)members_of(study, d, fw_plan_design_plan(design)->arena, text, n,
                                             &root);
                if (status != FW_STATUS_OK) return status;
                if (!root) return FW_STATUS_NOMEM;
            }
            if (!fw_study_response_find(r, root, &value[k], why, sizeof why) && diags)
                fw_diag_error(diags, 492, r->asked->place, "response '%s' (%s): %s", r->asked->name,
                              r->asked->value, why);
        }
        json_decref(root);
    }
    return FW_STATUS_OK;
}

static double of_requirements(const fw_verdict_requirement *r, int n, double most) {
    for (int i = 0; r && i < n; i++)
        most = fmax(most, r[i].utilisation_high); /* NaN is passed */
    return most;
}

static double of_hinges(const fw_verdict_hinge_verdict *h, int n, double most) {
    for (int i = 0; i < n; i++)
        if (h[i].scene) most = fmax(most, h[i].utilisation_high);
    return most;
}

/* Reasons beside hinges and requirements say no number: a device that is not accepted uses at least this. The
   search is told by it which way is out where nothing else tells. */
static const double beyond = 1.001;

static double used_of(const fw_verdict *verdict, int decision) {
    double most = 0;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        most = of_hinges(v->hinge, v->nhinge, most);
        most = of_requirements(v->requirement, v->nrequirement, most);
        for (int k = 0; v->fabricated && k < v->fabricated->ncorner; k++) {
            const fw_verdict_fabricated_corner *c = &v->fabricated->corner[k];
            most = of_hinges(c->hinge, v->nhinge, most);
            most = of_requirements(c->requirement, v->nrequirement, most);
        }
        for (int k = 0; k < v->nreason; k++)
            if (v->reason[k].decision != FW_ACCEPT && v->reason[k].keep > 0)
                most = fmax(most, fmin(1 / v->reason[k].keep, 10));
    }
    return decision == 0 ? fmin(most, 1) : fmax(most, beyond);
}

bool fw_study_same_files(const fw_study *study, fw_design *design) {
    fw_plan *plan = fw_plan_design_plan(design);
    const char *was, *is;
    return fw_study_files_hash(plan->arena, study->plan, &was) == FW_OK &&
           fw_study_files_hash(plan->arena, plan, &is) == FW_OK && strcmp(was, is) == 0;
}

static void blank(const fw_study *study, fw_study_sample *sample) {
    sample->run = false, sample->decision = -1, sample->why[0] = '\0';
    sample->used = (double)NAN;
    for (int k = 0; k < study->nresponse; k++)
        sample->response[k] = (double)NAN;
}

int fw_study_answers_take(const fw_study *study, fw_design *design, fw_study_sample *sample) {
    blank(study, sample);
    int status = fw_study_stages_run(design, study->stages);
    if (status == FW_STATUS_OK)
        status = fw_study_responses_take(study, design, sample->response, NULL);
    sample->run = status == FW_STATUS_OK;
    if (sample->run) {
        sample->decision = fw_design_decision(design);
        if (sample->decision >= 0)
            sample->used = used_of(&fw_plan_design_plan(design)->verdict, sample->decision);
    } else
        first_error(design, status, sample->why);
    return status;
}

fw_status fw_study_evaluate_alone(const fw_study *study, const fw_cancel *cancel,
                                  fw_study_sample *sample, bool *changed) {
    int status;
    blank(study, sample);
    fw_design *design =
        fw_study_design(study, cancel, (const char(*)[FW_STUDY_TEXT])sample->text, &status);
    FW_NEED(design);
    if (status == FW_STATUS_OK && !fw_study_same_files(study, design)) *changed = true;
    if (status == FW_STATUS_OK)
        status = fw_study_answers_take(study, design, sample);
    else
        first_error(design, status, sample->why);
    fw_design_free(design);
    if (*changed) return FW_INPUT;
    return fw_plan_is_final((fw_status)status) ? (fw_status)status : FW_OK;
}
