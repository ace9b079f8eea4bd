/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies as others ask for them: fw_design_study of the public library, with the options and settings of a
   design; and the points that a page looks at while somebody chooses them. */
#include "base/json.h"
#include "base/text.h"
#include "plan/live.h"
#include "report/report.h"
#include "study/study_parts.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct asked {
    const char *file;
    fw_study_settings settings;
    const char *json;
    size_t length;
} asked;

/* the design's own progress is told of devices */
static void told(void *context, long done, long all, double seconds) {
    fw_design *d = context;
    (void)seconds;
    fw_arena_tell(d->plan->arena, "judging devices", (double)done, (double)all, "devices");
}

static fw_status run(fw_study *study, fw_design *d, asked *a) {
    fw_text json = fw_text_new(d->plan->arena);
    FW_TRY(fw_study_run(study));
    if (a->settings.shards > 0) return FW_OK; /* merging makes the results */
    FW_TRY(fw_study_write(study));
    FW_TRY(fw_study_json(study, &json));
    a->json = json.data, a->length = json.length;
    return FW_OK;
}

static fw_status work(fw_design *d, void *argument) {
    asked *a = argument;
    const fw_study_options o = {.design = d->given,
                                .set = d->set,
                                .nset = d->plan->options.nset,
                                .file = a->file,
                                .study = a->settings.study,
                                .output = a->settings.directory,
                                .jobs = a->settings.jobs,
                                .shard = a->settings.shard,
                                .shards = a->settings.shards,
                                .resume = a->settings.resume != 0,
                                .cancel = &d->cancel,
                                .capped = &d->capped,
                                .progress = told,
                                .progress_context = d};
    fw_study *study;
    fw_status status = fw_study_open(&o, &study);
    FW_NEED(study);
    if (status == FW_OK) status = run(study, d, a);
    fw_diags_take(&d->plan->diags, &study->diags);
    fw_study_free(study);
    return d->plan->diags.failed ? FW_NOMEM : status;
}

static const char *wrong(const fw_study_settings *s) {
    if (!s->directory || !s->directory[0]) return "a study needs a directory for its samples";
    if (s->jobs < 0 || s->jobs > FW_JOBS_MOST) return "jobs of a study are 1 to 256, or 0";
    if (s->shards < 0 || s->shards > FW_STUDY_SHARDS_MOST ||
        (s->shards > 0 && (s->shard < 1 || s->shard > s->shards)))
        return "shard of a study is 1 to shards, and shards at most 100000; 0 and 0: all of it";
    return NULL;
}

int fw_design_study(fw_design *design, const char *file, const fw_study_settings *settings,
                    const char **json, size_t *length) {
    asked a = {.file = file};
    if (json) *json = NULL;
    if (length) *length = 0;
    if (!fw_plan_design_begin(design)) return FW_STATUS_USAGE;
    if (!file || !settings || settings->size < offsetof(fw_study_settings, study) ||
        settings->size > 4096)
        return (int)fw_plan_design_usage(design, "a study needs a file and its settings");
    memcpy(&a.settings, settings,
           settings->size < sizeof a.settings ? settings->size : sizeof a.settings);
    if (wrong(&a.settings)) return (int)fw_plan_design_usage(design, wrong(&a.settings));
    int status = fw_plan_design_run(design, work, &a);
    if (status == FW_STATUS_OK && json) *json = a.json;
    if (status == FW_STATUS_OK && length) *length = a.length;
    return status;
}

/* ---- POST /api/explore ---- */

enum { INPUTS_MOST = 8, VALUES_MOST = 64, POINTS_MOST = 512 };

typedef struct explored { /* the study of the last request */
    fw_arena *arena;      /* holds this */
    json_t *root;         /* of that request, without its points: strings belong to it */
    fw_device_study asked;
    fw_study *study;
    fw_status status; /* of opening it: FW_OK, or FW_INPUT with its diagnostics */
} explored;

static void explored_free(void *kept) {
    explored *e = kept;
    if (!e) return;
    fw_study_free(e->study);
    json_decref(e->root);
    fw_arena_free(e->arena);
}

static void forget(fw_plan_live *live) {
    if (live->kept) live->kept_free(live->kept);
    live->kept = NULL;
}

/* a list of texts, at most so many, none of them longer than a setting of a study */
static fw_status texts_of(fw_plan_live_request *r, const json_t *list, const char *key,
                          size_t most) {
    const json_t *item;
    size_t i;
    if (!json_is_array(list) || json_array_size(list) == 0)
        return fw_plan_live_wrong(r, "a list that is not empty is needed for", key);
    if (json_array_size(list) > most)
        return fw_plan_live_wrong(r, "more than a request may ask for in", key);
    json_array_foreach((json_t *)list, i, item) {
        if (!json_is_string(item)) return fw_plan_live_wrong(r, "texts are needed in", key);
        size_t n = json_string_length(item);
        if (n == 0 || n >= FW_STUDY_TEXT || strlen(json_string_value(item)) != n)
            return fw_plan_live_wrong(r, "texts of 1 to 95 bytes, without a NUL, are needed in",
                                      key);
    }
    return FW_OK;
}

static fw_status points_of(fw_plan_live_request *r, size_t inputs, const json_t **points) {
    const json_t *point;
    size_t i;
    *points = json_object_get(r->root, "points");
    if (!json_is_array(*points) || json_array_size(*points) == 0 ||
        json_array_size(*points) > POINTS_MOST)
        return fw_plan_live_wrong(r, "a list of 1 to 512 points is needed for", "points");
    json_array_foreach((json_t *)*points, i, point) {
        FW_TRY(texts_of(r, point, "points", inputs));
        if (json_array_size(point) != inputs)
            return fw_plan_live_wrong(r, "every point has a value for each of", "inputs");
    }
    return FW_OK;
}

static fw_status ask_inputs(explored *e) {
    const json_t *inputs = json_object_get(e->root, "inputs");
    const json_t *values = json_object_get(e->root, "values");
    fw_device_study *a = &e->asked;
    *a = (fw_device_study){.name = "explore",
                           .kind = FW_STUDY_IS_sweep,
                           .judge = FW_JUDGE_MADE, /* options.corners says of what */
                           .nvary = (int)json_array_size(inputs),
                           .nrespond = (int)json_array_size(values)};
    FW_NEED(a->vary = fw_arena_array(e->arena, fw_device_vary, (size_t)a->nvary));
    FW_NEED(a->respond = fw_arena_array(e->arena, fw_device_respond, (size_t)a->nrespond));
    for (int i = 0; i < a->nvary; i++)
        a->vary[i] = (fw_device_vary){.what = json_string_value(json_array_get(inputs, (size_t)i)),
                                      .unit = "",
                                      .from = (double)NAN,
                                      .to = (double)NAN};
    for (int i = 0; i < a->nrespond; i++) {
        const char *value = json_string_value(json_array_get(values, (size_t)i));
        a->respond[i] = (fw_device_respond){
            .name = value, .value = value, .min = (double)NAN, .max = (double)NAN};
    }
    return FW_OK;
}

/* ---- the way of a verdict: what it says in words and whole numbers, in one number ---- */

typedef struct way {
    uint64_t sum;
} way;

static void add_byte(way *w, unsigned char byte) {
    w->sum = fw_hash_add(w->sum, byte);
}

static void add_number(way *w, int number) {
    for (int shift = 0; shift < 32; shift += 8)
        add_byte(w, (unsigned char)((unsigned)number >> shift));
}

/* one that is not there is another than an empty one */
static void add_word(way *w, const char *word) {
    for (const char *c = word ? word : "\001"; *c; c++)
        add_byte(w, (unsigned char)*c);
    add_byte(w, 0);
}

/* How each is decided. Of the one that governs also where it uses most, and what limits it there: others have their edges where
   that changes, too, but what governs has none then. */
static void add_hinges(way *w, const fw_verdict_hinge_verdict *hinge, int n, int governing) {
    add_number(w, governing);
    for (int i = 0; i < n; i++)
        add_number(w, (int)hinge[i].decision);
    if (governing < 0 || governing >= n) return;
    const fw_verdict_hinge_verdict *h = &hinge[governing];
    add_word(w, h->scene), add_word(w, h->flow), add_word(w, h->actuation);
    add_word(w, h->limit ? h->limit->criterion : NULL);
    add_number(w, h->touches), add_number(w, h->open);
}

/* what acts, and how hinges are taken */
static void add_motion(way *w, const fw_dynamics_motion *motion) {
    add_number(w, motion != NULL);
    if (!motion) return;
    for (int i = 0; i < motion->ledger.count; i++)
        add_number(w, motion->ledger.item[i].active);
    add_number(w, (int)motion->ledger.hinge.used);
}

static void add_requirement(way *w, const fw_verdict_requirement *r) {
    add_number(w, (int)r->decision), add_number(w, r->why != NULL), add_number(w, r->open != NULL);
}

static void add_made(way *w, const fw_verdict_fabricated_verdict *f) {
    add_number(w, f != NULL);
    if (!f) return;
    add_number(w, (int)f->decision), add_number(w, f->governing), add_number(w, f->at);
    for (int k = 0; k < f->ncorner; k++)
        add_number(w, (int)f->corner[k].decision), add_number(w, f->corner[k].number);
}

static void add_variant(way *w, const fw_verdict_variant_verdict *v, int scenes) {
    add_number(w, (int)v->decision);
    for (int i = 0; i < v->nrequirement; i++)
        add_requirement(w, &v->requirement[i]);
    for (int i = 0; v->motion && i < scenes; i++)
        add_motion(w, v->motion[i]);
    for (int i = 0; i < v->nclearance; i++)
        add_number(w, (int)v->clearance[i].decision);
    add_made(w, v->fabricated);
}

/* Between devices that have it alike what governs is not known to have an edge or a step. */
static uint64_t way_of(const fw_verdict *verdict, int scenes) {
    way w = {FW_HASH_BEGIN};
    add_number(&w, (int)verdict->decision), add_number(&w, (int)verdict->drawn);
    for (int i = 0; i < verdict->ncomputed; i++)
        add_number(&w, (int)verdict->computed[i].refinement);
    add_hinges(&w, verdict->hinge, verdict->nhinge, verdict->governing);
    for (int i = 0; i < verdict->nvariant; i++)
        add_variant(&w, &verdict->variant[i], scenes);
    return w.sum;
}

/* ---- the study of the last request ---- */

static fw_status open_points(const fw_plan_live *live, fw_plan_live_request *r, explored *e) {
    bool full;
    fw_study_options o = {.design = fw_design_options_default(),
                          .file = "device.xml",
                          .text = r->text,
                          .length = r->length,
                          .cancel = live->settings.cancel};
    o.design.data_directory = live->settings.data_directory;
    o.design.memory_cap = live->settings.memory_cap;
    /* nothing shows the motion: it has as many rows as that of `check` */
    const int32_t as_check = o.design.samples;
    FW_TRY(fw_plan_live_options(r, &o.design, &full));
    if (!json_object_get(r->options, "samples")) o.design.samples = as_check;
    FW_TRY(ask_inputs(e));
    fw_device_set *set;
    FW_TRY(fw_plan_live_sets(r, e->arena, json_object_get(e->root, "set"), &set, &o.nset));
    o.set = set;
    FW_TRY(fw_plan_live_lab(r, e->arena, &o.lab_text, &o.nlab_text));
    FW_TRY(fw_study_open_points(&o, &e->asked, &e->study));
    e->study->way = way_of;
    return FW_OK;
}

/* live->kept holds the study of this request; FW_INPUT: the description is wrong, its study says how */
static fw_status prepare(fw_plan_live *live, fw_plan_live_request *r, explored **out) {
    json_t *root = json_copy(r->root);
    FW_NEED(root);
    json_object_del(root, "points");
    explored *e = live->kept;
    *out = e;
    if (e && json_equal(e->root, root)) {
        json_decref(root);
        return e->status;
    }
    forget(live);
    fw_arena *arena = fw_arena_new(0);
    if (!arena || !(e = fw_arena_one(arena, explored))) {
        json_decref(root);
        fw_arena_free(arena);
        return FW_NOMEM;
    }
    *e = (explored){.arena = arena, .root = root};
    live->kept = *out = e;
    live->kept_free = explored_free;
    e->status = open_points(live, r, e);
    const char *wrong = e->study && e->study->design ? e->study->design->wrong_option : NULL;
    return e->status == FW_USAGE && wrong ? fw_plan_live_wrong(r, wrong, NULL) : e->status;
}

typedef struct looking {
    const json_t *points;
    fw_study_sample *sample; /* (points) */
    const fw_study *study;
} looking;

static fw_status fill(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const looking *l = context;
    const json_t *point = json_array_get(l->points, (size_t)k);
    sample->i = k;
    *wanted = true;
    for (int v = 0; v < l->study->ninput; v++) {
        sample->value[v] = (double)NAN;
        snprintf(sample->text[v], FW_STUDY_TEXT, "%s",
                 json_string_value(json_array_get(point, (size_t)v)));
    }
    return FW_OK;
}

static fw_status take(void *context, const fw_study_sample *sample) {
    const looking *l = context;
    fw_study_sample_copy(l->study, sample, &l->sample[sample->i]);
    return FW_OK;
}

static void point_json(const fw_study *study, const fw_study_sample *s, fw_json *out) {
    char digits[17];
    fw_json_line(out, 0);
    fw_json_object(out, NULL);
    fw_json_text(out, "state", fw_study_state_text(s->run, s->decision));
    fw_json_text(out, "why", s->why[0] ? s->why : NULL);
    fw_json_real(out, "limit_used", s->used);
    if (s->run) snprintf(digits, sizeof digits, "%016" PRIx64, s->way);
    fw_json_text(out, "way", s->run && s->decision >= 0 ? digits : NULL);
    fw_json_list(out, "values");
    for (int k = 0; k < study->nresponse; k++)
        fw_json_real(out, NULL, s->response[k]);
    fw_json_end(out);
    fw_json_end(out);
}

static fw_status explore_json(const explored *e, const looking *l, size_t n, fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_study *study = e->study;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.explore/1");
    fw_json_text(out, "status", l ? "ok" : "invalid");
    fw_json_line(out, 0);
    fw_report_preview_diagnostics(&study->diags, study->options.file, out);
    fw_json_line(out, 0);
    fw_json_list(out, "units");
    for (int k = 0; l && k < study->nresponse; k++)
        fw_json_text(out, NULL, study->response[k].unit);
    fw_json_end(out);
    fw_json_list(out, "points");
    for (size_t i = 0; l && i < n; i++)
        point_json(study, &l->sample[i], out);
    fw_json_end(out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

static fw_status look(fw_plan_live_request *r, explored *e, const json_t *points, fw_text *out) {
    size_t n = json_array_size(points);
    looking l = {.points = points, .study = e->study};
    FW_NEED(l.sample = fw_arena_array(r->arena, fw_study_sample, n));
    for (size_t i = 0; i < n; i++)
        FW_TRY(fw_study_sample_new(r->arena, e->study, &l.sample[i]));
    const fw_study_work work = {.n = (long)n, .fill = fill, .take = take, .context = &l};
    FW_TRY(fw_study_pool_run(e->study, &work));
    return explore_json(e, &l, n, out);
}

static fw_status explore(fw_plan_live *live, fw_plan_live_request *r, fw_text *out) {
    const json_t *inputs = json_object_get(r->root, "inputs"), *points;
    explored *e;
    FW_TRY(texts_of(r, inputs, "inputs", INPUTS_MOST));
    FW_TRY(texts_of(r, json_object_get(r->root, "values"), "values", VALUES_MOST));
    FW_TRY(points_of(r, json_array_size(inputs), &points));
    fw_status status = prepare(live, r, &e);
    if (status == FW_OK)
        status = look(r, e, points, out);
    else if (status == FW_INPUT && e->study)
        return explore_json(e, NULL, 0, out); /* the same request has the same mistakes */
    if (status != FW_OK) forget(live);        /* what was stopped half way is not gone on with */
    return status;
}

fw_plan_live_answer fw_study_explore(fw_plan_live *live, const char *request, size_t n) {
    static const char *const keys[] = {"text",   "set",    "options", "lab",
                                       "inputs", "values", "points",  NULL};
    return fw_plan_live_call(live, request, n, keys, explore);
}
