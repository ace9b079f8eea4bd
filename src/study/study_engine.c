/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the samples of a study have in common, computed once: packs, layer tables and materials are read by a
   design of each thread, which is then one sample after the other (fw_plan_kept_again). And what nobody asks for is
   left out: rows of a motion wait (fw_dynamics_motion_rows), and clearances that are accepted are bounded, where no
   response is about them. A sample is what it would be by itself, to the last bit of what is asked for.

   Test: tests/unit/study/test_engine.c */
#include "plan/stages.h"
#include "study/study_parts.h"
#include <math.h>
#include <pthread.h>
#include <string.h>
#include <unistd.h>
#include <time.h>

/* files may change while a study runs: looked at this often, which costs a hundredth */
static const double look_again_s = 1;
/* samples after one whose bodies were too soft to be bounded, which is then judged twice */
enum { soft_for = 16 };

typedef struct engine { /* of one thread at a time */
    fw_arena *arena;    /* holds this */
    const fw_study *study;
    fw_design *design;
    double accuracy; /* that the design was read with */
    bool lent;       /* the study frees it */
    fw_plan_kept kept;
    fw_dynamics_tapes *tapes; /* motions that devices have in common */
    fw_device_set *set;       /* those of the study's options, then those of the sample */
    double looked_s;
    /* of dies whose drawing is always the same: it is judged once, and what follows is given back */
    bool one_drawing, judged;
    fw_verdict verdict;
    fw_verdict_variant_verdict variant;
    fw_mark mark;
    int soft; /* samples to come whose bodies are taken to be soft; results do not hang on it */
    struct engine *next;
} engine;

struct fw_study_engines {
    pthread_mutex_t lock; /* of what follows */
    engine *idle;
    fw_design *
        lent; /* the study's own, which nobody reads any more; NULL: there is none, or it is taken */
};

double fw_study_now_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

fw_status fw_study_engines_open(fw_study *study) {
    FW_NEED(study->engines = fw_arena_one(study->arena, fw_study_engines));
    FW_TRY(fw_study_failure_open(study));
    return pthread_mutex_init(&study->engines->lock, NULL) == 0 ? FW_OK : FW_NOMEM;
}

void fw_study_engines_lend(fw_study *study) {
    study->engines->lent = study->design;
}

static void engine_free(engine *e) {
    if (!e) return;
    fw_plan_kept_free(&e->kept);
    if (!e->lent) fw_design_free(e->design);
    fw_dynamics_tapes_free(e->tapes);
    fw_arena_free(e->arena);
}

void fw_study_engines_close(fw_study *study) {
    if (!study->engines) return;
    while (study->engines->idle) {
        engine *e = study->engines->idle;
        study->engines->idle = e->next;
        engine_free(e);
    }
    fw_study_failure_close(study);
    pthread_mutex_destroy(&study->engines->lock);
}

/* ---- one design after the other ---- */

/* clearances of devices that are made decide which of them are run */
static bool may_be_bounded(const engine *e) {
    const fw_plan *plan = fw_plan_design_plan(e->design);
    return plan->options.verdict.corners == FW_CORNERS_NONE &&
           fw_study_asks_for_no_clearance(e->study);
}

/* could a response be a bound of an effect? They stand in the verdict's JSON and in those of motions and equilibria */
static bool asks_for_bounds(const fw_study *study) {
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *r = &study->response[k];
        const unsigned stages = fw_study_documents[r->document].stages;
        if (stages & (FW_STUDY_STAGE_SIMULATE | FW_STUDY_STAGE_STATICS | FW_STUDY_STAGE_MODES))
            return true;
        if (strncmp(r->path, "effects", strlen("effects")) == 0) return true;
    }
    return false;
}

/* of the verdict's JSON the members that responses begin with, and of these what any of their words names */
static fw_status wanted_of(engine *e, fw_json_wanted *out) {
    const fw_study *study = e->study;
    size_t n = 0, words = 1;
    for (int k = 0; k < study->nresponse; k++)
        words += strlen(study->response[k].path) + 1;
    const char **member = fw_arena_alloc(e->arena, (size_t)study->nresponse + 1, sizeof *member),
               **inner = fw_arena_alloc(e->arena, words, sizeof *inner);
    FW_NEED(member && inner ? member : NULL);
    words = 0;
    for (int k = 0; k < study->nresponse; k++) {
        const fw_study_response *r = &study->response[k];
        const char *path = r->path;
        if (fw_study_documents[r->document].document != FW_DOCUMENT_VERDICT_JSON) continue;
        FW_NEED(member[n++] = fw_arena_strndup(e->arena, path, strcspn(path, ".[")));
        for (size_t length; *path; path += length) {
            length = strcspn(path, ".[]");
            if (length > 0) FW_NEED(inner[words++] = fw_arena_strndup(e->arena, path, length));
            length += path[length] != '\0';
        }
    }
    *out = (fw_json_wanted){member, inner};
    return FW_OK;
}

/* of the description as it stands; *changed: its files are others by now */
static fw_status engine_new(const fw_study *study, const fw_cancel *cancel, engine *e,
                            bool *changed) {
    int status;
    e->study = study;
    e->accuracy = study->options.design.accuracy;
    e->one_drawing =
        study->asked && study->asked->judge == FW_JUDGE_DIE && study->nvary + study->nsetting == 0;
    e->looked_s = fw_study_now_s();
    FW_NEED(e->set = fw_arena_array(e->arena, fw_device_set,
                                    (size_t)(study->options.nset + study->ninput)));
    pthread_mutex_lock(&study->engines->lock);
    e->design = study->engines->lent;
    study->engines->lent = NULL;
    pthread_mutex_unlock(&study->engines->lock);
    e->lent = e->design != NULL;
    if (!e->lent) {
        FW_NEED(e->design = fw_study_design(study, cancel, NULL, &status));
        if (status != FW_STATUS_OK) return (fw_status)status;
        if (!fw_study_same_files(study, e->design)) {
            *changed = true;
            return FW_INPUT;
        }
    }
    fw_plan_options *options = &fw_plan_design_plan(e->design)->options;
    options->verdict.motion.late_rows = true;
    options->verdict.motion.effects.untold = !asks_for_bounds(study);
    FW_TRY(fw_dynamics_tapes_new(e->arena, &e->tapes));
    options->verdict.motion.tapes = e->tapes;
    FW_TRY(fw_workspace_kept_new(e->arena, &options->verdict.kept));
    FW_TRY(wanted_of(e, &options->wanted));
    return fw_plan_keep(e->design, &e->kept);
}

/* the files once more */
static fw_status look_again(const fw_cancel *cancel, engine *e, bool *changed) {
    int status;
    if (fw_study_now_s() - e->looked_s < look_again_s) return FW_OK;
    fw_design *design = fw_study_design(e->study, cancel, NULL, &status);
    FW_NEED(design);
    const bool final = fw_plan_is_final((fw_status)status);
    *changed = !final && (status != FW_STATUS_OK || !fw_study_same_files(e->study, design));
    fw_design_free(design);
    e->looked_s = fw_study_now_s();
    return final ? (fw_status)status : *changed ? FW_INPUT : FW_OK;
}

/* *taken NULL: the description cannot be read as it stands */
static fw_status take(const fw_study *study, const fw_cancel *cancel, engine **taken,
                      bool *changed) {
    struct fw_study_engines *all = study->engines;
    *taken = NULL;
    pthread_mutex_lock(&all->lock);
    engine *e = all->idle;
    if (e) all->idle = e->next;
    pthread_mutex_unlock(&all->lock);
    /* of another part of the study: one judges some of its devices more accurately */
    if (e && e->accuracy != study->options.design.accuracy) {
        engine_free(e);
        return take(study, cancel, taken, changed);
    }
    *taken = e;
    if (e) return look_again(cancel, e, changed);
    fw_arena *arena = fw_arena_part(study->arena, 0);
    FW_NEED(arena);
    if (!(e = fw_arena_one(arena, engine))) {
        fw_arena_free(arena);
        return FW_NOMEM;
    }
    e->arena = arena;
    fw_status status = engine_new(study, cancel, e, changed);
    if (status == FW_OK)
        *taken = e;
    else
        engine_free(e);
    return fw_plan_is_final(status) || *changed ? status : FW_OK;
}

static void give(const fw_study *study, engine *e) {
    if (!e) return;
    pthread_mutex_lock(&study->engines->lock);
    e->next = study->engines->idle;
    study->engines->idle = e;
    pthread_mutex_unlock(&study->engines->lock);
}

/* another die of the drawing that was judged; *done false: there is none yet */
static fw_status another_die(engine *e, fw_study_sample *sample, bool *done) {
    fw_plan *plan = fw_plan_design_plan(e->design);
    *done = e->judged;
    if (!e->judged) return FW_OK;
    fw_arena_rewind(plan->arena, e->mark);
    plan->verdict = e->verdict, plan->verdict.variant[0] = e->variant;
    fw_plan_design_forget_documents(e->design);
    return (fw_status)fw_study_answers_take(e->study, e->design, sample);
}

/* in a design that is there; *done false: it is to be read anew, by itself */
static fw_status again(engine *e, fw_study_sample *sample, bool *done) {
    const fw_study *study = e->study;
    int n = 0;
    FW_TRY(another_die(e, sample, done));
    if (*done) return FW_OK;
    for (int i = 0; i < study->options.nset; i++)
        e->set[n++] = study->options.set[i];
    for (int i = 0; i < study->ninput; i++)
        if (sample->text[i][0])
            e->set[n++] = (fw_device_set){study->input[i].what, sample->text[i]};
    const fw_status read = fw_plan_kept_again(&e->kept, e->set, n, done);
    fw_study_note_error(study, e->design, (int)read);
    FW_TRY(read);
    if (!*done) return FW_OK;
    fw_plan_options *options = &fw_plan_design_plan(e->design)->options;
    const bool die = study->asked && study->asked->judge == FW_JUDGE_DIE;
    options->verdict.bounded = may_be_bounded(e);
    options->verdict.grid_ways = e->soft > 0;
    /* a decision is that of check, which draws the masks: only who asks for hinges alone does without */
    options->without_masks = die || (options->verdict.bounded && options->verdict.hinges_only &&
                                     study->asked->kind != FW_STUDY_IS_size);
    options->without_changes = fw_study_asks_for_no_clearance(study);
    fw_study_look(study, sample, options);
    fw_status status = FW_OK;
    if (e->one_drawing) {
        status = (fw_status)fw_study_stages_run(e->design, study->stages);
        fw_plan *plan = fw_plan_design_plan(e->design);
        e->judged = status == FW_OK;
        e->mark = fw_arena_mark(plan->arena);
        if (e->judged) e->verdict = plan->verdict, e->variant = plan->verdict.variant[0];
    }
    if (status == FW_OK) status = (fw_status)fw_study_answers_take(study, e->design, sample);
    e->soft =
        fw_plan_design_plan(e->design)->verdict.soft_bodies ? soft_for : e->soft - (e->soft > 0);
    return fw_plan_is_final(status) ? status : FW_OK;
}

fw_status fw_study_evaluate(const fw_study *study, const fw_cancel *cancel, fw_study_sample *sample,
                            bool *changed) {
    engine *e = NULL;
    bool done = false;
    fw_status status = take(study, cancel, &e, changed);
    if (status == FW_OK && e) status = again(e, sample, &done);
    give(study, e);
    return status != FW_OK || done ? status
                                   : fw_study_evaluate_alone(study, cancel, sample, changed);
}

/* ---- what a sample takes ---- */

static const double tight = 1e-9; /* accuracy of a device that derivatives are taken from */

double fw_study_tighten(fw_study *study) {
    fw_design_options *o = &study->options.design;
    const double asked = o->accuracy;
    if (o->rtol == 0) o->accuracy = asked > 0 ? fmin(asked, tight) : tight;
    return asked;
}

enum { TIMED_MOST = 5 };
static const double timed_enough_s = 1; /* of CPU, for all of them */

static double cpu_now_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* inputs of number k: over all the ranges, or `near` 1: as near to the middle as derivatives are taken */
static fw_status place_timed(const fw_study *study, int k, double near, fw_study_sample *sample) {
    for (int v = 0; v < study->ninput; v++) {
        const fw_study_input *in = &study->input[v];
        /* the golden ratio and its powers spread points evenly */
        const double at = fmod(0.5 + k * pow(0.6180339887498949, 1 + v % 7), 1);
        /* of a flow beside what is drawn, which is judged already */
        sample->text[v][0] = '\0', sample->value[v] = 1.01 * in->now;
        if (v < study->nvary)
            FW_TRY(fw_study_input_at(in, near > 0 ? 0.5 + 0.1 * (at - 0.5) : at, 9, sample->text[v],
                                     &sample->value[v]));
    }
    return FW_OK;
}

/* CPU of a device among others, after one that reads what all have in common; 0: none could be judged */
static fw_status time_some(const fw_study *study, double near, fw_study_sample *sample,
                           double *each_s) {
    bool changed = false;
    double all = 0;
    int n = 0;
    for (int k = 0; k <= TIMED_MOST && (n == 0 || all < timed_enough_s); k++) {
        FW_TRY(place_timed(study, k, near, sample));
        const double begun = cpu_now_s();
        FW_TRY(fw_study_evaluate(study, study->options.cancel, sample, &changed));
        const double took = cpu_now_s() - begun;
        if (k == 0 && took < timed_enough_s) continue;
        all += took, n++;
    }
    *each_s = n > 0 ? all / n : 0;
    return FW_OK;
}

fw_status fw_study_time_samples(fw_study *study) {
    fw_study_sample sample;
    FW_TRY(fw_study_sample_new(study->arena, study, &sample));
    FW_TRY(time_some(study, 0, &sample, &study->seconds_each));
    if (study->asked->kind != FW_STUDY_IS_sensitivity) return FW_OK;
    const double asked = fw_study_tighten(study);
    fw_status status = time_some(study, 1, &sample, &study->seconds_tight);
    study->options.design.accuracy = asked;
    return status;
}

/* ---- what decides a sample ---- */

static void add_real(fw_text *out, double value) {
    fw_text_add(out, " ");
    fw_text_number(out, value, 17);
}

static void add_text(fw_text *out, const char *text) {
    fw_text_printf(out, " %zu:%s", text ? strlen(text) : 0, text ? text : "");
}

/* what a message can name of the hash: options as they are written, one to a line */
static fw_status find_options(fw_study *study, const char **options) {
    const fw_design_options *o = &study->options.design;
    fw_text t = fw_text_new(study->arena);
    const struct {
        const char *name, *value;
    } word[] = {{"flow", o->flow},
                {"effects", o->effects},
                {"method", o->method},
                {"integrator", o->integrator},
                {"stabilise", o->stabilise},
                {"hinge-model", o->hinge_model},
                {"corners", o->corners},
                {"scene", o->scene},
                {"at", o->at},
                {"mask-format", o->mask_formats},
                {"mask-flatten", o->mask_flatten},
                {"day", o->day},
                {"planned", o->planning_times},
                {"cut", o->cut}};
    fw_text_add(&t, "");
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++)
        if (word[i].value) fw_text_printf(&t, "--%s %s\n", word[i].name, word[i].value);
    if (o->accuracy > 0) {
        fw_text_add(&t, "--accuracy ");
        fw_text_number(&t, o->accuracy, 17);
        fw_text_add(&t, "\n");
    }
    if (o->rtol > 0) {
        fw_text_add(&t, "--rtol ");
        fw_text_number(&t, o->rtol, 17);
        fw_text_add(&t, "\n");
    }
    for (int i = 0; i < study->options.nset; i++)
        fw_text_printf(&t, "--set %s=%s\n", study->options.set[i].path,
                       study->options.set[i].value);
    FW_TRY(fw_text_end(&t));
    *options = t.data;
    return FW_OK;
}

static fw_status find_files(fw_study *study, const char **files) {
    fw_text t = fw_text_new(study->arena);
    fw_text_add(&t, "");
    for (int i = 0; i < study->plan->ninput; i++)
        fw_text_printf(&t, "%s %s\n", study->plan->input[i].sha256, study->plan->input[i].name);
    FW_TRY(fw_text_end(&t));
    *files = t.data;
    return FW_OK;
}

/* what is asked: kind, inputs, responses */
static fw_status add_asked(const fw_study *study, fw_text *t) {
    const fw_device_study *a = study->asked;
    fw_text_printf(t, "%s %s %s %d %ld", fw_device_study_kind_text(a->kind),
                   fw_device_study_points_text(a->points), fw_device_study_judge_text(a->judge),
                   a->samples, a->seed);
    add_text(t, a->name);
    add_real(t, a->confidence);
    if (a->yield > 0) add_real(t, a->yield);
    if (a->fitted > 0) fw_text_add(t, " fitted"), add_real(t, a->fitted);
    if (a->kind == FW_STUDY_IS_sensitivity)
        fw_text_add(t, " nearer"); /* eleven devices, not seven */
    for (int k = 0; k < a->nvary; k++) {
        const fw_device_vary *v = &a->vary[k];
        add_text(t, v->what);
        add_real(t, v->from), add_real(t, v->to);
        fw_text_printf(t, " %s %d %d", v->unit, v->steps, v->logarithmic);
        for (int i = 0; i < v->ntext; i++)
            add_text(t, v->text[i]);
    }
    for (int k = 0; k < a->nuncertain; k++) {
        const fw_device_uncertain *u = &a->uncertain[k];
        add_text(t, u->what);
        fw_text_printf(t, " %d %s", (int)u->spread, u->unit);
        add_real(t, u->mean), add_real(t, u->sd), add_real(t, u->from), add_real(t, u->to);
        for (int i = 0; i < u->ntable; i++)
            add_real(t, u->x[i]), add_real(t, u->p[i]);
        if (u->flow || u->levelled) add_text(t, u->flow), fw_text_printf(t, " %d", (int)u->level);
    }
    for (int k = 0; k < a->ntrend; k++) {
        const fw_device_trend *q = &a->trend[k];
        add_text(t, q->what), add_text(t, q->flow);
        add_real(t, q->radial), add_real(t, q->along_x), add_real(t, q->along_y);
    }
    for (int k = 0; k < a->ncorrelation; k++)
        add_text(t, a->correlation[k].of), add_text(t, a->correlation[k].with),
            add_text(t, a->correlation[k].flow), add_real(t, a->correlation[k].value);
    for (int k = 0; k < a->nrespond; k++) {
        const fw_device_respond *q = &a->respond[k];
        add_text(t, q->name), add_text(t, q->value);
        fw_text_printf(t, " %d %d", (int)q->take, (int)q->goal);
        add_real(t, q->min), add_real(t, q->max);
        if (!fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension){0}))
            add_text(t, "with units"); /* without, they are in the unit of the number */
    }
    return fw_text_end(t);
}

/* the hash is of the words of the options as they were given, in one line */
static fw_status add_given(fw_study *study, fw_text *t) {
    const fw_design_options *o = &study->options.design;
    const char *files;
    FW_TRY(fw_study_files_hash(study->arena, study->plan, &files));
    fw_text_printf(t, "flexwright %s %s\n", FW_VERSION, files);
    const char *const words[] = {
        o->flow,         o->effects, o->method,         o->integrator, o->stabilise,
        o->hinge_model,  o->corners, o->scene,          o->at,         o->mask_formats,
        o->mask_flatten, o->day,     o->planning_times, o->cut};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        add_text(t, words[i]);
    add_real(t, o->accuracy);
    add_real(t, o->rtol);
    for (int i = 0; i < study->options.nset; i++)
        add_text(t, study->options.set[i].path), add_text(t, study->options.set[i].value);
    return FW_OK;
}

fw_status fw_study_find_hash(fw_study *study) {
    fw_study_origin *o = &study->origin;
    fw_text t = fw_text_new(study->arena), asked = fw_text_new(study->arena);
    char digits[65];
    o->program = FW_VERSION;
    FW_TRY(find_options(study, &o->options));
    FW_TRY(find_files(study, &o->files));
    FW_TRY(add_asked(study, &asked));
    fw_sha256(asked.data, asked.length, digits);
    FW_NEED(o->asked = fw_arena_strdup(study->arena, digits));
    FW_TRY(add_given(study, &t));
    fw_text_printf(&t, "\n%s", asked.data);
    /* a store of before has not all of a die, or of a device of a size */
    if (study->asked->kind == FW_STUDY_IS_yield) fw_text_add(&t, "\nread by both ends of bands");
    if (study->asked->kind == FW_STUDY_IS_size) fw_text_add(&t, "\nwith what each hinge uses");
    FW_TRY(fw_text_end(&t));
    fw_sha256(t.data, t.length, digits);
    FW_NEED(study->hash = fw_arena_strdup(study->arena, digits));
    return FW_OK;
}

/* the first line of `of` that `in` has not; its length in *n, 0: all are there */
static const char *only_in(const char *of, const char *in, size_t *n) {
    for (const char *line = of; *line; line += *n + 1) {
        bool there = false;
        *n = strcspn(line, "\n");
        for (const char *other = in; *other && !there; other += strcspn(other, "\n") + 1)
            there = strcspn(other, "\n") == *n && strncmp(line, other, *n) == 0;
        if (!there) return line;
    }
    *n = 0;
    return of;
}

enum { HASH = 65 }; /* of a line of a file, with the blank behind */

static bool is_named(const char *files, const char *name, size_t n) {
    for (const char *line = files; *line; line += strcspn(line, "\n") + 1)
        if (strcspn(line, "\n") == n + HASH && strncmp(line + HASH, name, n) == 0) return true;
    return false;
}

static void add_files(fw_text *out, const char *then, const char *now) {
    size_t n;
    const char *line = only_in(then, now, &n);
    const bool gone = n > HASH;
    if (!gone) line = only_in(now, then, &n);
    if (n <= HASH) return;
    const char *name = line + HASH;
    const int length = (int)(n - HASH);
    if (is_named(gone ? now : then, name, n - HASH))
        fw_text_printf(out, "; %.*s was another file", length, name);
    else
        fw_text_printf(out,
                       gone ? "; %.*s was read then and is not now (the same --lab, and the same "
                              "place to start from?)"
                            : "; %.*s is read now and was not then",
                       length, name);
}

static void add_options(fw_text *out, const char *then, const char *now) {
    size_t n;
    const char *line = only_in(then, now, &n);
    if (n) fw_text_printf(out, "; it had %.*s", (int)n, line);
    line = only_in(now, then, &n);
    if (n) fw_text_printf(out, "; now there is %.*s", (int)n, line);
}

fw_status fw_study_difference(fw_study *study, fw_study_says *says, struct sqlite3 *db,
                              const char **words) {
    const fw_study_origin *now = &study->origin;
    fw_study_origin then;
    fw_text t = fw_text_new(study->arena);
    const struct {
        const char *key, **value;
    } of[] = {{"program", &then.program},
              {"options", &then.options},
              {"files", &then.files},
              {"asked", &then.asked}};
    *words = "";
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        *of[i].value = says(study->arena, db, of[i].key);
        if (!*of[i].value) return FW_OK;
    }
    fw_text_add(&t, "");
    if (strcmp(then.program, now->program) != 0)
        fw_text_printf(&t, "; it is of version %s, and this is %s", then.program, now->program);
    add_options(&t, then.options, now->options);
    add_files(&t, then.files, now->files);
    if (strcmp(then.asked, now->asked) != 0)
        fw_text_add(&t, "; it was asked for something else (inputs, ranges, responses, seed or "
                        "samples of the study)");
    FW_TRY(fw_text_end(&t));
    *words = t.data;
    return FW_OK;
}

fw_status fw_study_gives_up(fw_study *study,
                            const char *(*says)(fw_arena *arena, struct sqlite3 *store,
                                                const char *key),
                            struct sqlite3 *store, long held) {
    const char *name = says(study->arena, store, "study"),
               *device = says(study->arena, store, "device"),
               *hash = says(study->arena, store, "hash"),
               *path = fw_arena_printf(study->arena, "%s/study.json", study->options.output);
    const bool same = hash && strcmp(hash, study->hash) == 0;
    const fw_place place = {.file = study->options.output};
    FW_NEED(path);
    if (!name || !device) return FW_OK; /* it was not begun */
    if (strcmp(name, study->asked->name) != 0 || strcmp(device, study->device_name) != 0)
        return fw_diag_error(&study->diags, 743, place,
                             "it holds %ld samples of study '%s' of %s, and this is study '%s' of "
                             "%s: name another directory with -o, or remove it",
                             held, name, device, study->asked->name, study->device_name);
    if (access(path, F_OK) == 0) return FW_OK; /* it came to its results, which are replaced */
    fw_diag_warning(&study->diags, 745, place,
                    "the %ld samples of study '%s' that a run before this one left here are "
                    "given up, and all is judged anew: %s",
                    held, name,
                    same ? "--resume would have gone on with them"
                         : "they are of other inputs or options, or another version");
    return FW_OK;
}
