/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One device of a study: the description with its settings through the same calls that the commands make,
   so that a sample says what `check` would say of it, and its numbers from the same documents; values of inputs, and what
   all kinds of studies ask of their samples. */
#include "base/sort.h"
#include "base/text.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* ---- values of inputs ----
   Numbers in SI inside, texts as --set takes them outside. What counts is the text: the value of a sample is the
   one that its text has. Test: tests/unit/study/test_response.c */

enum {
    SWEPT = 12,
    TOLD = 6
}; /* digits of a step, as those of a wafer's sweep; of what is told and not judged */

fw_status fw_study_input_write(const fw_study_input *input, double value, int digits,
                               char text[FW_STUDY_TEXT], double *shown) {
    char number[40];
    double read;
    fw_number_text(number, sizeof number, fw_quantity_unit_from_si(&input->unit, value), digits);
    if (!fw_number_parse(number, strlen(number), &read)) return FW_INTERNAL;
    *shown = fw_quantity_unit_to_si(&input->unit, read);
    int n = snprintf(text, FW_STUDY_TEXT, "%s%s%s", number, *input->unit_text ? " " : "",
                     input->unit_text);
    return n < FW_STUDY_TEXT ? FW_OK : FW_LIMIT;
}

double fw_study_rounded(double value) {
    char text[40];
    double read = value;
    fw_number_text(text, sizeof text, value, TOLD);
    fw_number_parse(text, strlen(text), &read);
    return read;
}

int fw_study_input_steps(const fw_study_input *input) {
    return input->ntext > 0 ? input->ntext : input->steps;
}

static fw_status listed(const fw_study_input *input, int k, char text[FW_STUDY_TEXT],
                        double *value) {
    const char *given = input->text[k];
    size_t n = strcspn(given, " \t");
    double number;
    fw_quantity_unit unit = {.factor = 1};
    snprintf(text, FW_STUDY_TEXT, "%s", given);
    *value = (double)NAN;
    if (!fw_number_parse(given, n, &number)) return FW_OK;
    const char *rest = given + n + strspn(given + n, " \t");
    if (*rest && !fw_quantity_unit_parse(rest, strlen(rest), &unit, NULL, NULL)) return FW_OK;
    *value = fw_quantity_unit_to_si(&unit, number);
    return FW_OK;
}

static double between(const fw_study_input *input, double share) {
    if (share <= 0) return input->from;
    if (share >= 1) return input->to;
    return input->logarithmic ? input->from * pow(input->to / input->from, share)
                              : input->from + (input->to - input->from) * share;
}

fw_status fw_study_input_step(const fw_study_input *input, int k, char text[FW_STUDY_TEXT],
                              double *value) {
    if (input->ntext > 0) return listed(input, k, text, value);
    return fw_study_input_write(input, between(input, k / (input->steps - 1.0)), SWEPT, text,
                                value);
}

fw_status fw_study_input_at(const fw_study_input *input, double share, int digits,
                            char text[FW_STUDY_TEXT], double *value) {
    if (input->ntext > 0) {
        int k = (int)(share * input->ntext);
        return listed(input, k < 0 ? 0 : k >= input->ntext ? input->ntext - 1 : k, text, value);
    }
    return fw_study_input_write(input, between(input, share), digits, text, value);
}

double fw_study_input_share(const fw_study_input *input, double value) {
    double share = input->logarithmic ? log(value / input->from) / log(input->to / input->from)
                                      : (value - input->from) / (input->to - input->from);
    return fmin(fmax(share, 0), 1);
}

/* ---- may they have these values? ---- */

/* the description alone is read with one value of an input: what --set finds wrong with it is said at
   the input's row */
static fw_status check_value_in(fw_study *study, fw_arena *scratch, int k, const char *text) {
    const fw_study_input *in = &study->input[k];
    fw_plan *plan = study->plan;
    const size_t n = (size_t)plan->options.nset;
    const fw_device *device;
    fw_diags said = fw_diags_new(scratch);
    fw_device_set *set = fw_arena_array(scratch, fw_device_set, n + 1);
    FW_NEED(set);
    if (n > 0) memcpy(set, plan->options.set, n * sizeof *set);
    set[n] = (fw_device_set){in->what, text};
    fw_status status = fw_plan_device_again(plan, scratch, set, (int)n + 1, &said, &device);
    if (fw_plan_is_final(status)) return status;
    for (size_t i = 0; i < said.count; i++) {
        const fw_diag *d = &said.item[i];
        /* no such path, not a value of its kind, beyond what the parameter allows; what else may be wrong
           with a value is the sample's own affair */
        bool of_path = d->number == 55 || d->number == 57 || (d->number >= 20 && d->number < 30);
        if (d->severity == FW_ERROR && of_path && d->place.file &&
            strncmp(d->place.file, "--set", 5) == 0)
            return fw_diag_error(&study->diags, 493, in->place, "\"%s\" set to %s: %s", in->what,
                                 text, d->message);
    }
    return FW_OK;
}

static fw_status check_value(fw_study *study, int k, const char *text) {
    fw_arena *scratch = fw_arena_part(study->arena, 0);
    FW_NEED(scratch);
    fw_status status = check_value_in(study, scratch, k, text);
    fw_arena_free(scratch);
    return status;
}

/* a value that an input left to chance is sure to have nearby */
static double some_value(const fw_device_uncertain *u) {
    return isnan(u->mean) ? 0.5 * (u->from + u->to) : u->mean;
}

/* the ends of an input, or what is listed: is there such a parameter or attribute, and may it be so? */
fw_status fw_study_input_check(fw_study *study, int k) {
    const fw_study_input *in = &study->input[k];
    char text[FW_STUDY_TEXT];
    double shown;
    if (k >= study->nvary) {
        double value = some_value(in->uncertain);
        FW_TRY(fw_study_input_write(in, value, 12, text, &shown));
        return check_value(study, k, text);
    }
    int last = fw_study_input_steps(in) - 1, step = in->ntext > 0 || last == 0 ? 1 : last;
    for (int i = 0; i <= last; i += step) {
        FW_TRY(fw_study_input_step(in, i, text, &shown));
        FW_TRY(check_value(study, k, text));
    }
    return FW_OK;
}

fw_status fw_study_settings_write(const fw_study *study, const fw_study_sample *sample, int digits,
                                  char (*text)[FW_STUDY_TEXT]) {
    for (int v = 0; v < study->nvary; v++) {
        double shown;
        if (study->input[v].ntext > 0)
            memcpy(text[v], sample->text[v], FW_STUDY_TEXT);
        else
            FW_TRY(
                fw_study_input_write(&study->input[v], sample->value[v], digits, text[v], &shown));
    }
    return FW_OK;
}

/* ---- samples: are they due, kept, within their limits ---- */

bool fw_study_is_due(const fw_study *study, long i) {
    return study->options.shards == 0 || i % study->options.shards == study->options.shard - 1;
}

static int by_number(const void *a, const void *b) {
    return fw_order_wholes(((const fw_study_sample *)a)->i, ((const fw_study_sample *)b)->i);
}

void fw_study_sort_samples(fw_study_sample *sample, int n) {
    if (n > 1) qsort(sample, (size_t)n, sizeof *sample, by_number);
}

/* ---- one device ---- */

const char fw_study_told_by_surface[] = "response surface";

fw_status fw_study_sample_new(fw_arena *arena, const fw_study *study, fw_study_sample *sample) {
    *sample = (fw_study_sample){.decision = -1};
    FW_NEED(sample->text = fw_arena_alloc(arena, (size_t)study->ninput, sizeof *sample->text));
    FW_NEED(sample->value = fw_arena_array(arena, double, (size_t)study->ninput));
    FW_NEED(sample->response = fw_arena_array(arena, double, (size_t)study->nresponse));
    if (study->nuse > 0)
        FW_NEED(sample->use = fw_arena_array(arena, double, FW_USE_NUMBERS *(size_t)study->nuse));
    if (study->npart > 0)
        FW_NEED(sample->part = fw_arena_array(
                    arena, double, (size_t)(FW_PART_NUMBERS * FW_VERDICT_LOOKS * study->npart)));
    return FW_OK;
}

fw_status fw_study_keep_found(fw_study *study, const fw_study_sample *sample, double excess,
                              fw_study_found *found) {
    fw_study_sample own;
    FW_TRY(fw_study_sample_new(study->arena, study, &own));
    fw_study_sample_copy(study, sample, &own);
    *found = (fw_study_found){.text = own.text,
                              .value = own.value,
                              .response = own.response,
                              .excess = excess,
                              .decision = own.decision,
                              .i = own.i};
    return FW_OK;
}

const char *fw_study_state_text(bool run, int decision) {
    return !run            ? "failed"
           : decision == 0 ? "accept"
           : decision == 1 ? "reject"
           : decision == 4 ? "inconclusive"
                           : "run";
}

void fw_study_state_take(const char *state, fw_study_sample *sample) {
    static const int decisions[] = {0, 1, 4};
    sample->run = strcmp(state, fw_study_state_text(false, -1)) != 0;
    sample->decision = -1;
    for (int i = 0; i < 3; i++)
        if (strcmp(state, fw_study_state_text(true, decisions[i])) == 0)
            sample->decision = decisions[i];
}

void fw_study_sample_copy(const fw_study *study, const fw_study_sample *from, fw_study_sample *to) {
    to->i = from->i, to->decision = from->decision, to->run = from->run, to->used = from->used;
    to->used_low = from->used_low, to->used_high = from->used_high, to->way = from->way;
    memcpy(to->why, from->why, FW_STUDY_WHY);
    memcpy(to->corner, from->corner, FW_PLAN_CORNER);
    if (study->nuse > 0)
        memcpy(to->use, from->use, FW_USE_NUMBERS * (size_t)study->nuse * sizeof *to->use);
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

/* ---- what ended a study ---- */

struct fw_study_failure {
    pthread_mutex_t lock;
    int number; /* of the first error of a file, or of memory, whose design is gone; 0: there was none */
    char file[256], message[512];
    int line, column, reason;
};

fw_status fw_study_failure_open(fw_study *study) {
    FW_NEED(study->failure = fw_arena_one(study->arena, struct fw_study_failure));
    return pthread_mutex_init(&study->failure->lock, NULL) == 0 ? FW_OK : FW_NOMEM;
}

void fw_study_failure_close(fw_study *study) {
    if (study->failure) pthread_mutex_destroy(&study->failure->lock);
    study->failure = NULL;
}

/* statuses that end a study, and of which the design says more */
static bool ends_it(int status) {
    return status == FW_STATUS_IO || status == FW_STATUS_NOMEM;
}

void fw_study_note_error(const fw_study *study, fw_design *design, int status) {
    if (!ends_it(status) || !study->failure) return;
    const fw_diags *from = &fw_plan_design_plan(design)->diags;
    pthread_mutex_lock(&study->failure->lock);
    struct fw_study_failure *e = study->failure;
    for (size_t i = 0; i < from->count && e->number == 0; i++) {
        const fw_diag *d = &from->item[i];
        if (d->severity != FW_ERROR) continue;
        e->number = d->number, e->line = d->place.line, e->column = d->place.column;
        e->reason = d->reason;
        snprintf(e->file, sizeof e->file, "%s", d->place.file ? d->place.file : "");
        snprintf(e->message, sizeof e->message, "%s", d->message);
    }
    pthread_mutex_unlock(&study->failure->lock);
}

fw_status fw_study_said(fw_study *study, fw_status status) {
    if (!ends_it((int)status) || !study->failure || study->diags.errors > 0) return status;
    const struct fw_study_failure *e = study->failure;
    if (e->number == 0) return status;
    const fw_place place = {e->file[0] ? e->file : NULL, e->line, e->column};
    return fw_diag_error(fw_diags_because(&study->diags, e->reason), e->number, place, "%s",
                         e->message) == FW_NOMEM
               ? FW_NOMEM
               : status;
}

fw_design *fw_study_design(const fw_study *study, const fw_cancel *cancel,
                           const char (*text)[FW_STUDY_TEXT], int *status) {
    fw_design *design = fw_design_new(&study->options.design);
    *status = FW_STATUS_NOMEM;
    if (!design) return NULL;
    fw_plan_design_cancel_with(design, cancel);
    fw_arena_help_with(fw_plan_design_plan(design)->arena, study->team);
    fw_verdict_options *verdict = &fw_plan_design_plan(design)->options.verdict;
    verdict->hinges_only = study->asked && study->asked->judge == FW_JUDGE_HINGES;
    verdict->unheld = true;
    verdict->all_made =
        study->asked && study->asked->judge == FW_JUDGE_MADE &&
        (study->asked->kind == FW_STUDY_IS_sweep || study->asked->kind == FW_STUDY_IS_sensitivity ||
         study->asked->kind == FW_STUDY_IS_worst_case);
    /* of a die nobody reads the drawn device, which says where there is something to look at */
    if (study->asked && study->asked->judge == FW_JUDGE_DIE)
        verdict->at_a_glance = verdict->bounded = true;
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
    fw_study_note_error(study, design, *status);
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

/* why a document of what is made has nothing in it */
static const char *unmade(fw_design *design, int document) {
    const bool made = fw_study_documents[document].stages & FW_STUDY_STAGE_FABRICATE;
    return made && fw_design_decision(design) == 1 /* rejected */
               ? "; there are no masks and recipes, since check rejects the description as it "
                 "stands: begin with one that it accepts (--set)"
               : "";
}

int fw_study_responses_take(const fw_study *study, fw_design *design, double *value,
                            fw_diags *diags) {
    char why[2 * FW_STUDY_WHY]; /* with the keys that there are */
    for (int d = 0; d < fw_study_document_count; d++) {
        json_t *root = NULL;
        for (int k = 0; k < study->nresponse; k++) {
            fw_study_response *r = &study->response[k];
            const char *text, *unit;
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
            if (!fw_study_response_find(r, root, &value[k], &unit, why, sizeof why) && diags)
                fw_diag_error(diags, 492, r->asked->place, "response '%s' (%s): %s%s",
                              r->asked->name, r->asked->value, why, unmade(design, d));
            if (diags && r->unit_beside && unit && !(r->unit = fw_arena_strdup(study->arena, unit)))
                return FW_STATUS_NOMEM;
        }
        json_decref(root);
    }
    return FW_STATUS_OK;
}

bool fw_study_same_files(const fw_study *study, fw_design *design) {
    fw_plan *plan = fw_plan_design_plan(design);
    const char *was, *is;
    fw_status status = FW_OK;
    if (study->files)
        was = study->files;
    else
        status = fw_study_files_hash(plan->arena, study->plan, &was);
    return status == FW_OK && fw_study_files_hash(plan->arena, plan, &is) == FW_OK &&
           strcmp(was, is) == 0;
}

static void blank(const fw_study *study, fw_study_sample *sample) {
    sample->run = false, sample->decision = -1, sample->why[0] = sample->corner[0] = '\0';
    sample->used = sample->used_low = sample->used_high = (double)NAN;
    sample->nlook = 0, sample->way = 0;
    for (int k = 0; k < FW_USE_NUMBERS * study->nuse; k++)
        sample->use[k] = (double)NAN;
    for (int k = 0; k < study->nresponse; k++)
        sample->response[k] = (double)NAN;
}

/* of who explores: why a device that bears its motion is rejected all the same */
static void say_unmade(const fw_plan *plan, char *why) {
    for (int i = 0; i < plan->nflow && plan->verdict.decision == FW_ACCEPT; i++) {
        const fw_process_flow *flow = plan->flow[i].flow;
        if (!flow || flow->manufacturable != 0) continue;
        snprintf(why, FW_STUDY_WHY, "it cannot be made in %s: %s", flow->id,
                 flow->fails         ? flow->fails
                 : flow->nreason > 0 ? flow->reason[0]
                                     : "");
        return;
    }
}

int fw_study_answers_take(const fw_study *study, fw_design *design, fw_study_sample *sample) {
    const bool die = study->asked && study->asked->judge == FW_JUDGE_DIE;
    fw_plan *plan = fw_plan_design_plan(design);
    bool numbers = true;
    blank(study, sample);
    /* dies of one drawing follow each other in a design that was judged (study_engine.c) */
    int status = die && design->done & FW_DONE_JUDGED ? FW_STATUS_OK
                                                      : fw_study_stages_run(design, study->stages);
    fw_study_note_error(study, design, status);
    if (status == FW_STATUS_OK && die)
        status = (int)fw_study_die_take(study, plan, sample, &numbers);
    if (status == FW_STATUS_OK && numbers)
        status = fw_study_responses_take(study, design, sample->response, NULL);
    if (status != FW_STATUS_OK) {
        sample->run = false;
        first_error(design, status, sample->why);
    } else if (die) {
        sample->used = fw_study_used(sample->used, sample->decision);
    } else {
        sample->run = true;
        sample->decision = fw_design_decision(design);
        if (sample->decision >= 0 && study->asked && study->asked->fitted > 0)
            fw_study_parts_take(study, &plan->verdict, sample);
        if (sample->decision >= 0)
            sample->used = fw_study_used_of(&plan->verdict, sample->decision);
        if (sample->decision >= 0 && study->nuse > 0)
            fw_study_uses_take(study, &plan->verdict, sample);
        if (sample->decision >= 0 && study->way)
            sample->way = study->way(&plan->verdict, plan->device->nscene);
        if (sample->decision > 0 && study->explored) say_unmade(plan, sample->why);
        fw_study_say_corner(study, plan, sample);
    }
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
    fw_study_look(study, sample, &fw_plan_design_plan(design)->options);
    if (status == FW_STATUS_OK)
        status = fw_study_answers_take(study, design, sample);
    else
        first_error(design, status, sample->why);
    fw_design_free(design);
    if (*changed) return FW_INPUT;
    return fw_plan_is_final((fw_status)status) ? (fw_status)status : FW_OK;
}
