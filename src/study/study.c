/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study from its file to its result, and shards of it put together. */
#include "base/output.h"
#include "plan/design.h"
#include "plan/stages.h"
#include "study/study.h"
#include "study/study_parts.h"
#include "xml/xml.h"
#include <math.h>
#include <string.h>
#include <unistd.h>

enum { FILE_MOST = 8 << 20 };

/* ---- which study, of which device ---- */

/* by its first element; what cannot be read as XML is a device file, whose reader says what is wrong */
static fw_status is_study_file(const fw_study *study, const char *xml, size_t n, bool *is) {
    fw_arena *scratch = fw_arena_part(study->arena, 0);
    FW_NEED(scratch);
    fw_diags silent = fw_diags_new(scratch);
    fw_xml_element *root = NULL;
    fw_status status = fw_xml_read(scratch, study->options.file, xml, n, &silent, &root);
    *is = root && strcmp(root->name, "study") == 0;
    fw_arena_free(scratch);
    return status == FW_NOMEM ? FW_NOMEM : FW_OK;
}

/* path of a file that another one names beside it */
static const char *beside(fw_arena *arena, const char *file, const char *name) {
    const char *slash = strrchr(file, '/');
    return slash && name[0] != '/'
               ? fw_arena_printf(arena, "%.*s/%s", (int)(slash - file), file, name)
               : fw_arena_strdup(arena, name);
}

static fw_status choose(fw_study *study, const fw_device *device) {
    const char *wanted = study->options.study, *called = wanted ? wanted : "", *known;
    const fw_place at = {.file = study->options.file};
    const char **name = fw_arena_array(study->arena, const char *, (size_t)device->nstudy);
    FW_NEED(name);
    for (int i = 0; i < device->nstudy; i++) {
        name[i] = device->study[i].name;
        if (wanted ? strcmp(name[i], wanted) != 0 : device->nstudy > 1) continue;
        study->asked = &device->study[i];
        return FW_OK;
    }
    if (device->nstudy == 0)
        return fw_diag_error(&study->diags, 494, at,
                             "the device file has no <study>; add one, or name a study file");
    FW_NEED(known = fw_text_meant(study->arena, called, name, (size_t)device->nstudy));
    return fw_diag_error(&study->diags, 494, at,
                         wanted ? "there is no study '%s'%s"
                                : "%sseveral studies; name one with --study%s",
                         called, known);
}

static fw_status read_study_file(fw_study *study, char *xml, size_t n) {
    FW_TRY(fw_device_study_read(study->arena, study->options.file, xml, n, &study->diags,
                                &study->asked));
    FW_NEED(study->device_path = beside(study->arena, study->options.file, study->asked->device));
    return FW_OK;
}

/* ---- the description as it stands ---- */

static void take_errors(fw_study *study, const fw_diags *from) {
    for (size_t i = 0; i < from->count; i++)
        if (from->item[i].severity == FW_ERROR)
            fw_diags_add(&study->diags, &from->item[i], FW_ERROR);
}

/* read and judged as any sample is, and kept: places, names and hashes are of it */
static fw_status open_device(fw_study *study) {
    int status;
    fw_design *design = fw_study_design(study, study->options.cancel, NULL, &status);
    FW_NEED(design);
    fw_plan *plan = fw_plan_design_plan(design);
    study->design = design, study->plan = plan;
    if (status != FW_STATUS_OK) {
        take_errors(study, &plan->diags);
        return (fw_status)status;
    }
    FW_NEED(study->device_name = fw_arena_strdup(study->arena, plan->device->name));
    return FW_OK;
}

/* ---- inputs ---- */

static fw_status unit_of(const char *text, fw_quantity_unit *unit) {
    *unit = (fw_quantity_unit){.factor = 1};
    if (!*text) return FW_OK;
    return fw_quantity_unit_parse(text, strlen(text), unit, NULL, NULL) ? FW_OK : FW_INTERNAL;
}

/* the value that a parameter has now; NaN: it is a path, or there is none */
static double value_now(const fw_device *d, const char *what) {
    for (int i = 0; i < d->nparameter; i++)
        if (strcmp(d->parameter[i].name, what) == 0) return d->parameter[i].value;
    return (double)NAN;
}

/* of a yield: what the flows may make differ, behind what the study file names */
static fw_status add_made_inputs(fw_study *study) {
    int more = 0, at = study->ninput;
    const fw_verdict *verdict = &study->plan->verdict;
    for (int i = 0; i < verdict->nvariant; i++)
        more += verdict->variant[i].ninput;
    FW_NEED(study->input = fw_arena_grow(study->arena, study->input, (size_t)at,
                                         (size_t)(at + more), sizeof *study->input));
    for (int i = 0; i < verdict->nvariant; i++)
        for (int k = 0; k < verdict->variant[i].ninput; k++) {
            const fw_verdict_fabrication_input *in = &verdict->variant[i].input[k];
            const char *flow = verdict->variant[i].variant->flow;
            const char *name = verdict->nvariant > 1 && flow
                                   ? fw_arena_printf(study->arena, "%s (%s)", in->name, flow)
                                   : in->name;
            FW_NEED(name);
            study->input[study->ninput++] =
                (fw_study_input){.what = name,
                                 .unit_text = in->q.unit ? in->q.unit : "",
                                 .unit = {.factor = 1},
                                 .from = (double)NAN,
                                 .to = (double)NAN,
                                 .now = in->nominal,
                                 .place = study->asked->place};
        }
    return FW_OK;
}

/* "flexure[*]/@width" of flexure i; else as it is */
static const char *of_flexure(fw_study *study, const char *what, int i) {
    static const char all[] = "flexure[*]";
    const fw_device *d = study->plan->device;
    return strncmp(what, all, sizeof all - 1) == 0 && d->nflexure > 0
               ? fw_arena_printf(study->arena, "flexure[%s]%s", d->flexure[i].id,
                                 what + sizeof all - 1)
               : what;
}

/* an input left to chance, of flexure[*] one each; further rows of it are levels of the same */
static fw_status take_uncertain(fw_study *study, const fw_device_uncertain *u) {
    const fw_device_study *asked = study->asked;
    if (u->flow) return FW_OK; /* stands in the place of what the pack states */
    for (const fw_device_uncertain *before = asked->uncertain; before < u; before++)
        if (!before->flow && strcmp(before->what, u->what) == 0) return FW_OK;
    int n = of_flexure(study, u->what, 0) != u->what ? study->plan->device->nflexure : 1;
    for (int i = 0; i < n; i++) {
        fw_study_input *in = &study->input[study->ninput++];
        *in = (fw_study_input){.what = of_flexure(study, u->what, i),
                               .unit_text = u->unit,
                               .from = (double)NAN,
                               .to = (double)NAN,
                               .now = value_now(study->plan->device, u->what),
                               .uncertain = u,
                               .place = u->place};
        FW_NEED(in->what);
        FW_TRY(unit_of(u->unit, &in->unit));
    }
    return FW_OK;
}

static fw_status take_inputs(fw_study *study) {
    const fw_device_study *asked = study->asked;
    int each = study->plan->device->nflexure > 1 ? study->plan->device->nflexure : 1;
    study->ninput = study->nvary = asked->nvary;
    FW_NEED(study->input = fw_arena_array(study->arena, fw_study_input,
                                          (size_t)(asked->nvary + each * asked->nuncertain)));
    for (int k = 0; k < asked->nvary; k++) {
        const fw_device_vary *v = &asked->vary[k];
        fw_study_input *in = &study->input[k];
        *in = (fw_study_input){.what = v->what,
                               .unit_text = v->unit,
                               .from = v->from,
                               .to = v->to,
                               .logarithmic = v->logarithmic,
                               .steps = v->steps,
                               .text = v->text,
                               .ntext = v->ntext,
                               .now = value_now(study->plan->device, v->what),
                               .place = v->place};
        FW_TRY(unit_of(v->unit, &in->unit));
    }
    for (int k = 0; fw_study_draws(study) && k < asked->nuncertain; k++)
        FW_TRY(take_uncertain(study, &asked->uncertain[k]));
    study->nsetting = study->ninput - study->nvary;
    return FW_OK;
}

/* names of columns are those of inputs and responses together */
static void check_names(fw_study *study) {
    for (int r = 0; r < study->asked->nrespond; r++)
        for (int k = -6; k < study->ninput; k++) {
            static const char *const own[] = {"i",          "state",          "why",
                                              "limit_used", "limit_used_low", "limit_used_high"};
            const char *other = k < 0 ? own[k + 6] : study->input[k].what;
            if (strcmp(study->asked->respond[r].name, other) == 0)
                fw_diag_error(&study->diags, 492, study->asked->respond[r].place,
                              "response '%s': another column of the results has this name; rename "
                              "the response",
                              other);
        }
}

/* ---- responses ---- */

/* a limit in the unit of the number */
static fw_status limit_in(fw_study *study, const fw_study_response *r, const char *name,
                          fw_place place, double *limit) {
    const fw_device_respond *asked = r->asked;
    const char *known = r->unit;
    fw_quantity_unit unit;
    if (isnan(*limit)) return FW_OK;
    FW_TRY(unit_of(known, &unit));
    *limit = fw_quantity_unit_from_si(&unit, *limit);
    if (fw_quantity_dimension_equal(asked->dimension, unit.dimension)) return FW_OK;
    return fw_diag_error(&study->diags, 25, place,
                         *known ? "response '%s' (%s): %s is given as a %s, and the number is in "
                                  "%s; write it in such a unit, or without one, which means %s"
                                : "response '%s' (%s): %s is given as a %s, and the number has no "
                                  "unit; write it without one",
                         asked->name, asked->value, name,
                         fw_quantity_dimension_text(study->arena, asked->dimension), known, known);
}

/* those without a unit are in that of the number */
static fw_status take_limits(fw_study *study, fw_study_response *r) {
    const fw_device_respond *asked = r->asked;
    r->min = asked->min, r->max = asked->max;
    if (fw_quantity_dimension_equal(asked->dimension, (fw_quantity_dimension){0})) return FW_OK;
    const fw_status min = limit_in(study, r, "min", asked->min_place, &r->min);
    const fw_status max = limit_in(study, r, "max", asked->max_place, &r->max);
    return min != FW_OK ? min : max;
}

static fw_status take_responses(fw_study *study) {
    const fw_device_study *asked = study->asked;
    study->nresponse = asked->nrespond;
    FW_NEED(study->response =
                fw_arena_array(study->arena, fw_study_response, (size_t)asked->nrespond));
    fw_status status = FW_OK;
    for (int k = 0; k < asked->nrespond; k++) {
        fw_status one = fw_study_response_parse(study->arena, &asked->respond[k], &study->diags,
                                                &study->response[k]);
        const bool hinges = asked->judge == FW_JUDGE_HINGES || asked->judge == FW_JUDGE_DIE;
        if (one == FW_OK && hinges && !fw_study_response_of_hinges(&study->response[k]))
            status = fw_diag_error(&study->diags, 576, asked->respond[k].place,
                                   "response '%s' (%s): as=\"%s\" judges hinges and "
                                   "requirements alone, and this is about something else; take "
                                   "as=\"drawn\", or ask for governing, hinges, requirements, "
                                   "hinge_model or failure_probability",
                                   asked->respond[k].name, asked->respond[k].value,
                                   fw_device_study_judge_text(asked->judge));
        if (one == FW_OK && !study->response[k].unit_beside)
            one = take_limits(study, &study->response[k]);
        if (one != FW_OK) status = one;
        if (one == FW_OK) study->stages |= fw_study_documents[study->response[k].document].stages;
    }
    study->watches = fw_study_may_watch(study);
    /* a yield and a size ask what check says */
    if (asked->kind == FW_STUDY_IS_yield || asked->kind == FW_STUDY_IS_size || asked->nrespond == 0)
        study->stages |= FW_STUDY_STAGE_JUDGE;
    return status;
}

/* Limits of a number whose unit stands in the document. runs: it was read */
static fw_status unit_beside(fw_study *study, fw_study_response *r, bool runs) {
    const fw_device_respond *asked = r->asked;
    const bool limited = !isnan(asked->min) || !isnan(asked->max),
               pure = fw_quantity_dimension_equal(asked->dimension, (fw_quantity_dimension){0});
    fw_status status = FW_OK;
    if (runs)
        status = take_limits(study, r);
    else if (limited && !pure)
        status = fw_diag_error(
            &study->diags, 25, isnan(asked->min) ? asked->max_place : asked->min_place,
            "response '%s' (%s): the unit of the number stands beside it in the document, and the "
            "description as it stands has none, since it could not be run; write the limit "
            "without a unit, as the document has the number",
            asked->name, asked->value);
    return status == FW_INPUT ? FW_OK : status; /* all of them are said */
}

/* once, for every path */
static fw_status run_as_it_stands(fw_study *study) {
    double *now = fw_arena_array(study->arena, double, (size_t)study->nresponse);
    size_t errors = study->diags.errors;
    int status;
    FW_NEED(now);
    if (study->asked->kind == FW_STUDY_IS_yield && study->nresponse == 0) return FW_OK;
    fw_design *design = fw_study_design(study, study->options.cancel, NULL, &status);
    FW_NEED(design);
    if (status == FW_STATUS_OK) status = fw_study_stages_run(design, study->stages);
    if (status == FW_STATUS_OK) status = fw_study_responses_take(study, design, now, &study->diags);
    if (status == FW_STATUS_OK) fw_study_parts_of(fw_plan_design_plan(design), study);
    fw_design_free(design);
    if (fw_plan_is_final((fw_status)status)) return (fw_status)status;
    const bool runs = status == FW_STATUS_OK;
    for (int k = 0; k < study->nresponse; k++) {
        fw_study_response *r = &study->response[k];
        if (runs) r->now = now[k];
        if (r->unit_beside) FW_TRY(unit_beside(study, r, runs));
    }
    /* others may be run where it is not: paths cannot be looked up */
    return study->diags.errors > errors ? FW_INPUT : FW_OK;
}

/* ---- opening and running ---- */

/* of every device of the study: no advice, and as drawn where that is asked */
static void settle_options(fw_study *study) {
    fw_design_options *o = &study->options.design;
    o->advice = "none";
    o->measurements = "none";
    if (study->asked->judge != FW_JUDGE_MADE || study->asked->kind == FW_STUDY_IS_yield)
        o->corners = "none";
}

/* with the options that only the study tells, and as drawn: what is made of it is the yield's own affair */
static fw_status judge_device(fw_study *study) {
    int status;
    fw_design *design = fw_study_design(study, study->options.cancel, NULL, &status);
    FW_NEED(design);
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    fw_design *former = study->design;
    study->design = design;
    study->plan = fw_plan_design_plan(design);
    study->former = former; /* places of the study are of it */
    if (status != FW_STATUS_OK) take_errors(study, &study->plan->diags);
    return (fw_status)status;
}

static fw_study *new_study(const fw_study_options *options) {
    fw_arena *arena = fw_arena_new(options->design.memory_cap);
    fw_study *study = arena ? fw_arena_one(arena, fw_study) : NULL;
    fw_team *team = study ? fw_arena_one(arena, fw_team) : NULL;
    if (!team) {
        fw_arena_free(arena);
        return NULL;
    }
    *study =
        (fw_study){.arena = arena, .diags = fw_diags_new(arena), .options = *options, .team = team};
    if (options->cancel) fw_arena_stop_with(arena, options->cancel);
    fw_arena_capped_with(arena, options->capped);
    return study;
}

/* a yield of the device that a sample of a size has chosen, or NULL: of the description; *out is freed after any status */
static fw_status open_dies_of(const fw_study *of, const fw_study_sample *chosen, fw_study **out) {
    fw_study_options o = of->options;
    o.output = NULL, o.shards = 0, o.resume = false, o.progress = NULL, o.waits = NULL;
    fw_study *study = *out = new_study(&o);
    FW_NEED(study);
    const int n = o.nset;
    fw_device_set *set = fw_arena_array(study->arena, fw_device_set, (size_t)(n + of->nvary));
    FW_NEED(set);
    if (n > 0) memcpy(set, o.set, (size_t)n * sizeof *set);
    for (int k = 0; chosen && k < of->nvary; k++) {
        const char *text = fw_arena_strdup(study->arena, chosen->text[k]);
        FW_NEED(text);
        set[study->options.nset++] = (fw_device_set){of->input[k].what, text};
    }
    study->options.set = set;
    study->device_path = of->device_path;
    FW_TRY(fw_study_dies_asked(study->arena, of, chosen, &study->asked));
    FW_TRY(open_device(study));
    settle_options(study);
    FW_TRY(take_inputs(study));
    for (int k = 0; k < study->ninput; k++) {
        fw_status status = fw_study_input_check(study, k);
        if (status != FW_OK && status != FW_INPUT) return status;
    }
    if (study->diags.errors > 0) return FW_INPUT;
    FW_TRY(judge_device(study));
    FW_TRY(fw_study_scatter_check(study));
    FW_TRY(add_made_inputs(study));
    return fw_study_counted_open(study, of);
}

static void close_dies_of(fw_study *of, fw_study *dies, fw_status status) {
    if (dies && status != FW_OK) take_errors(of, &dies->diags);
    fw_study_free(dies);
}

/* rows that say how dies differ are looked up before anything is run */
static fw_status open_dies(fw_study *study) {
    study->open_dies = open_dies_of, study->close_dies = close_dies_of;
    fw_status status = open_dies_of(study, NULL, &study->dies);
    FW_NEED(study->dies);
    if (status == FW_OK) status = fw_study_yielding_check(study->dies);
    if (status == FW_INPUT) take_errors(study, &study->dies->diags);
    return status;
}

static fw_status check_kind(fw_study *study) {
    switch (study->asked->kind) {
#define FW_STUDY(name, word, sentence)                                                             \
    case FW_STUDY_IS_##name:                                                                       \
        return fw_study_check_##name(study);
#include "device/studies.def"
#undef FW_STUDY
    case FW_STUDY_KINDS:
        break;
    }
    return FW_OK;
}

static fw_status open_all(fw_study *study) {
    char *xml;
    size_t n;
    FW_TRY(fw_study_engines_open(study));
    FW_TRY(fw_input_read(study->arena, study->options.file, FILE_MOST, &study->diags, &xml, &n));
    study->source = xml, study->source_length = n;
    study->device_path = study->options.file;
    bool alone;
    FW_TRY(is_study_file(study, xml, n, &alone));
    if (alone) FW_TRY(read_study_file(study, xml, n));
    FW_TRY(open_device(study));
    if (!alone) FW_TRY(choose(study, study->plan->device));
    settle_options(study);
    FW_TRY(take_inputs(study));
    fw_status responses = take_responses(study);
    check_names(study);
    for (int k = 0; k < study->ninput; k++) {
        fw_status status = fw_study_input_check(study, k);
        if (status != FW_OK && status != FW_INPUT) return status;
    }
    FW_TRY(responses);
    if (study->diags.errors > 0) return FW_INPUT;
    FW_TRY(check_kind(study));
    FW_TRY(fw_study_say_idle(study));
    if (fw_study_draws(study)) {
        FW_TRY(judge_device(study));
        FW_TRY(fw_study_scatter_check(study));
        FW_TRY(add_made_inputs(study));
        const bool die = study->asked->judge == FW_JUDGE_DIE;
        FW_TRY(die ? fw_study_dies_check(study) : fw_study_counted_open(study, study));
        if (!die) FW_TRY(fw_study_yielding_check(study));
    }
    if (study->asked->yield > 0) FW_TRY(open_dies(study));
    fw_study_counted_warn(study);
    FW_TRY(fw_study_find_hash(study));
    FW_TRY(run_as_it_stands(study));
    /* a yield was timed where it was foreseen */
    const bool timed = study->options.timed && study->asked->kind != FW_STUDY_IS_yield;
    return timed ? fw_study_time_samples(study) : FW_OK;
}

fw_status fw_study_open(const fw_study_options *options, fw_study **study) {
    *study = new_study(options);
    FW_NEED(*study);
    return fw_study_said(*study, open_all(*study));
}

fw_status fw_study_open_points(const fw_study_options *options, const fw_device_study *asked,
                               fw_study **out) {
    fw_study *study = *out = new_study(options);
    FW_NEED(study);
    study->asked = asked, study->explored = true;
    study->device_path = options->file;
    FW_TRY(fw_study_engines_open(study));
    settle_options(study); /* before the device is opened: samples are judged in that very design */
    FW_TRY(open_device(study));
    FW_TRY(take_inputs(study));
    FW_TRY(take_responses(study));
    if (study->diags.errors > 0) return FW_INPUT;
    /* nothing is asked of the description but its samples: the first thread works in it */
    FW_TRY(fw_study_files_hash(study->arena, study->plan, &study->files));
    fw_study_engines_lend(study);
    return FW_OK;
}

void fw_study_free(fw_study *study) {
    if (!study) return;
    fw_study_free(study->dies);
    fw_study_store_close(study->store);
    fw_study_counted_close(study);
    fw_study_engines_close(study);
    fw_design_free(study->design);
    fw_design_free(study->former);
    fw_arena_free(study->arena);
}

static void count(fw_study_result *result, const fw_study_sample *sample) {
    result->run += sample->run, result->failed += !sample->run;
    result->partly += fw_study_is_partly(sample);
    result->accepted += sample->run && sample->decision == 0 && !fw_study_is_partly(sample);
    result->rejected += sample->run && sample->decision == 1;
    result->inconclusive += sample->run && sample->decision == 4;
}

static fw_status tally(void *context, const fw_study_sample *sample) {
    fw_study *study = context;
    fw_study_result *result = (fw_study_result *)study->result;
    count(result, sample);
    if (!sample->run && !result->example_why) {
        FW_NEED(result->example_why = fw_arena_strdup(study->arena, sample->why));
        result->example_at = sample->i;
    }
    for (int k = 0; k < study->nresponse && !fw_study_is_partly(sample); k++) {
        fw_study_extreme *e = &result->extreme[k];
        double value = sample->response[k];
        if (isnan(value)) {
            FW_TRY(fw_study_without_take(study, sample, &e->without));
            continue;
        }
        if (e->n++ == 0)
            e->first = e->least = e->largest = value, e->least_at = e->largest_at = sample->i;
        if (value < e->least) e->least = value, e->least_at = sample->i;
        if (value > e->largest) e->largest = value, e->largest_at = sample->i;
        e->sum += value - e->first;
        e->square += (value - e->first) * (value - e->first);
    }
    return FW_OK;
}

fw_status fw_study_run(fw_study *study) {
    fw_study_result *result = fw_arena_one(study->arena, fw_study_result);
    FW_NEED(result);
    FW_NEED(result->extreme =
                fw_arena_array(study->arena, fw_study_extreme, (size_t)study->nresponse));
    for (int k = 0; k < study->nresponse; k++)
        result->extreme[k] = (fw_study_extreme){.least = (double)NAN,
                                                .largest = (double)NAN,
                                                .least_at = -1,
                                                .largest_at = -1,
                                                .without.at = -1};
    if (study->options.shards > 0) FW_TRY(fw_study_check_apart(study));
    if (study->options.output && !study->store) {
        bool made;
        FW_TRY(fw_output_directory(study->arena, study->options.output, &made));
        FW_TRY(fw_study_store_open(study, &study->store));
    }
    fw_status status = FW_INTERNAL;
    switch (study->asked->kind) {
#define FW_STUDY(name, word, sentence)                                                             \
    case FW_STUDY_IS_##name:                                                                       \
        status = fw_study_kind_##name(study, result);                                              \
        break;
#include "device/studies.def"
#undef FW_STUDY
    case FW_STUDY_KINDS:
        break;
    }
    FW_TRY(fw_study_said(study, status));
    study->result = result;
    if (!study->store) return FW_OK;
    FW_TRY(fw_study_store_finish(study->store));
    FW_TRY(fw_study_store_each(study->store, tally, study));
    if (result->failed > 0 && result->run == 0 && study->options.shards == 0)
        fw_diag_warning(&study->diags, 498, study->asked->place,
                        "study '%s': none of its %ld devices could be judged (number %ld: %s)",
                        study->asked->name, result->failed, result->example_at,
                        result->example_why);
    return study->diags.failed ? FW_NOMEM : FW_OK;
}

long fw_study_count(const fw_study *study) {
    switch (study->asked->kind) {
#define FW_STUDY(name, word, sentence)                                                             \
    case FW_STUDY_IS_##name:                                                                       \
        return fw_study_count_##name(study);
#include "device/studies.def"
#undef FW_STUDY
    case FW_STUDY_KINDS:
        break;
    }
    return 0;
}

/* ---- shards ---- */

fw_status fw_study_open_merge(const fw_study_options *options, const char *directory,
                              fw_study **out) {
    fw_study *study = new_study(options);
    *out = study;
    FW_NEED(study);
    const char *file, *name;
    FW_TRY(fw_study_store_said(study->arena, &study->diags, directory, "file", &file));
    FW_TRY(fw_study_store_said(study->arena, &study->diags, directory, "study", &name));
    if (!file || !name)
        return fw_diag_error(&study->diags, 497, (fw_place){.file = directory},
                             "its store does not say which study it is of");
    study->options.file = file, study->options.study = name;
    return open_all(study);
}

fw_status fw_study_merge(fw_study *study, const char *const *directory, int n) {
    bool made;
    FW_TRY(fw_study_check_shards(study, directory, n));
    FW_TRY(fw_output_directory(study->arena, study->options.output, &made));
    fw_status status = fw_study_store_open(study, &study->store);
    const bool open = status == FW_OK; /* else it may be somebody else's */
    if (open) status = fw_study_store_merge(study->store, directory, n);
    study->stored_only = true;
    if (status == FW_OK) status = fw_study_run(study);
    if (open && status != FW_OK) fw_study_store_abandon(study->store);
    if (made && status != FW_OK) (void)rmdir(study->options.output);
    return status;
}
