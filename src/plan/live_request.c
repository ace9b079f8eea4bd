/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all live requests have in common: reading them, and answers that never leak. */
#include "plan/live.h"
#include "base/json.h"
#include "plan/stages.h"
#include <math.h>
#include <string.h>

/* ---- reading ---- */

fw_status fw_plan_live_wrong(fw_plan_live_request *r, const char *what, const char *key) {
    r->wrong = fw_arena_printf(r->arena, "%s%s%.100s%s", what, key ? " \"" : "", key ? key : "",
                               key ? "\"" : "");
    return r->wrong ? FW_USAGE : FW_NOMEM;
}

static bool listed(const char *key, const char *const *keys) {
    for (; *keys; keys++)
        if (strcmp(*keys, key) == 0) return true;
    return false;
}

static fw_status only(fw_plan_live_request *r, json_t *object, const char *const *keys) {
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value) if (!listed(key, keys)) return fw_plan_live_wrong(
        r, "this member is not known:", key);
    return FW_OK;
}

/* *value NULL: absent or null */
static fw_status object_of(fw_plan_live_request *r, const char *key, json_t **value) {
    *value = json_object_get(r->root, key);
    if (json_is_null(*value)) *value = NULL;
    if (*value && !json_is_object(*value))
        return fw_plan_live_wrong(r, "an object is needed for", key);
    return FW_OK;
}

/* takes the request apart; keys: those allowed beside "text", NULL at the end. FW_USAGE: `wrong` */
static fw_status read_request(fw_arena *arena, const char *json, size_t n, const char *const *keys,
                              fw_plan_live_request *r) {
    json_error_t error;
    *r = (fw_plan_live_request){.arena = arena};
    if (!json || n > FW_LIVE_REQUEST_MOST)
        return fw_plan_live_wrong(r, "the request is larger than 16 MiB", NULL);
    r->root = json_loadb(json, n, JSON_REJECT_DUPLICATES, &error);
    if (!r->root || !json_is_object(r->root))
        return fw_plan_live_wrong(r, "the request is not a JSON object", NULL);
    FW_TRY(only(r, r->root, keys));
    const json_t *text = json_object_get(r->root, "text");
    if (!json_is_string(text)) return fw_plan_live_wrong(r, "a string is needed for", "text");
    r->text = json_string_value(text);
    r->length = json_string_length(text);
    FW_TRY(object_of(r, "set", &r->set));
    FW_TRY(object_of(r, "lab", &r->lab));
    return object_of(r, "options", &r->options);
}

static void free_request(fw_plan_live_request *r) {
    json_decref(r->root);
    r->root = NULL;
}

fw_status fw_plan_live_string(fw_plan_live_request *r, const json_t *object, const char *key,
                              const char **value) {
    const json_t *v = object ? json_object_get(object, key) : NULL;
    if (!v || json_is_null(v)) return FW_OK;
    if (!json_is_string(v)) return fw_plan_live_wrong(r, "a string is needed for", key);
    *value = json_string_value(v);
    return FW_OK;
}

fw_status fw_plan_live_real(fw_plan_live_request *r, const json_t *object, const char *key,
                            double *value) {
    const json_t *v = object ? json_object_get(object, key) : NULL;
    if (!v || json_is_null(v)) return FW_OK;
    if (!json_is_number(v)) return fw_plan_live_wrong(r, "a number is needed for", key);
    *value = json_number_value(v);
    return FW_OK;
}

/* ---- the design of a request ---- */

fw_status fw_plan_live_options(fw_plan_live_request *r, fw_design_options *o, bool *full) {
    static const char *const keys[] = {"scene",    "method",  "integrator",  "stabilise", "rtol",
                                       "accuracy", "effects", "hinge_model", "samples",   "corners",
                                       "flow",     "detail",  NULL};
    double samples = FW_LIVE_SAMPLES;
    o->corners = "none";
    if (r->options) FW_TRY(only(r, r->options, keys));
    FW_TRY(fw_plan_live_string(r, r->options, "scene", &o->scene));
    FW_TRY(fw_plan_live_string(r, r->options, "method", &o->method));
    FW_TRY(fw_plan_live_string(r, r->options, "integrator", &o->integrator));
    FW_TRY(fw_plan_live_string(r, r->options, "stabilise", &o->stabilise));
    FW_TRY(fw_plan_live_string(r, r->options, "effects", &o->effects));
    FW_TRY(fw_plan_live_string(r, r->options, "hinge_model", &o->hinge_model));
    FW_TRY(fw_plan_live_string(r, r->options, "corners", &o->corners));
    FW_TRY(fw_plan_live_string(r, r->options, "flow", &o->flow));
    FW_TRY(fw_plan_live_real(r, r->options, "rtol", &o->rtol));
    FW_TRY(fw_plan_live_real(r, r->options, "accuracy", &o->accuracy));
    FW_TRY(fw_plan_live_real(r, r->options, "samples", &samples));
    if (!(samples >= 2 && samples <= FW_LIVE_SAMPLES_MOST) || samples != floor(samples))
        return fw_plan_live_wrong(r, "samples must be a whole number from 2 to 2001", NULL);
    o->samples = (int32_t)samples;
    const char *detail = "quick";
    FW_TRY(fw_plan_live_string(r, r->options, "detail", &detail));
    *full = strcmp(detail, "full") == 0;
    if (!*full && strcmp(detail, "quick") != 0)
        return fw_plan_live_wrong(r, "detail must be \"quick\" or \"full\"", NULL);
    if (!*full && !o->hinge_model) o->hinge_model = fw_effects_hinge_model_text(FW_HINGE_REVOLUTE);
    return FW_OK;
}

fw_status fw_plan_live_sets(fw_plan_live_request *r, fw_arena *arena, json_t *object,
                            fw_device_set **set, int *n) {
    const char *key;
    json_t *value;
    *n = 0;
    if (json_object_size(object) > FW_LIVE_SETS_MOST)
        return fw_plan_live_wrong(r, "set holds more than 256 values, the most of one request",
                                  NULL);
    FW_NEED(*set = fw_arena_array(arena, fw_device_set, json_object_size(object)));
    json_object_foreach(object, key, value) {
        if (!json_is_string(value)) return fw_plan_live_wrong(r, "a string is needed for", key);
        if (!key[0])
            return fw_plan_live_wrong(
                r, "set needs the name of a parameter or a path before every value", NULL);
        (*set)[(*n)++] = (fw_device_set){key, json_string_value(value)};
    }
    return FW_OK;
}

static fw_status apply_sets(fw_plan_live_request *r, fw_design *design) {
    fw_device_set *set;
    int n;
    FW_TRY(fw_plan_live_sets(r, r->arena, r->set, &set, &n));
    for (int i = 0; i < n; i++) {
        int status = fw_design_set(design, set[i].path, set[i].value);
        if (status != FW_STATUS_OK) return (fw_status)status;
    }
    return FW_OK;
}

fw_status fw_plan_live_lab(fw_plan_live_request *r, fw_arena *arena, const fw_plan_lab_text **lab,
                           int *n) {
    const char *name;
    json_t *text;
    size_t count = json_object_size(r->lab);
    *lab = NULL, *n = 0;
    if (count == 0) return FW_OK;
    if (count > FW_LIVE_LABS_MOST)
        return fw_plan_live_wrong(r, "lab holds more than 4 packs, the most of one request", NULL);
    fw_plan_lab_text *item = fw_arena_array(arena, fw_plan_lab_text, count);
    FW_NEED(item);
    json_object_foreach(r->lab, name, text) {
        if (!json_is_string(text) || !name[0])
            return fw_plan_live_wrong(r, "the text of a laboratory pack is needed for", name);
        const size_t length = json_string_length(text);
        fw_plan_lab_text *to = &item[(*n)++];
        *to = (fw_plan_lab_text){fw_arena_strdup(arena, name),
                                 fw_arena_strndup(arena, json_string_value(text), length), length};
        FW_NEED(to->name && to->text ? to : NULL);
    }
    *lab = item;
    return FW_OK;
}

fw_status fw_plan_live_design(const fw_plan_live *live, fw_plan_live_request *r,
                              fw_design **design) {
    fw_design_options options = fw_design_options_default();
    *design = NULL;
    options.data_directory = live->settings.data_directory;
    options.memory_cap = live->settings.memory_cap;
    FW_TRY(fw_plan_live_options(r, &options, &r->full));
    FW_NEED(*design = fw_design_new(&options));
    fw_plan_design_cancel_with(*design, live->settings.cancel);
    fw_verdict_options *judge = &fw_plan_design_plan(*design)->options.verdict;
    judge->with_advice = false;
    fw_plan_design_plan(*design)->options.measurements = FW_MEASUREMENTS_NONE;
    judge->at_a_glance = !r->full;
    judge->motion.energies = !r->full; /* then its motion is the one that is shown */
    fw_plan_options *o = &fw_plan_design_plan(*design)->options;
    fw_status status =
        fw_plan_live_lab(r, fw_plan_design_plan(*design)->arena, &o->lab_text, &o->nlab_text);
    if (status == FW_OK && r->set) status = apply_sets(r, *design);
    if (status == FW_OK) return FW_OK;
    fw_design_free(*design);
    *design = NULL;
    return status;
}

/* ---- answering ---- */

static fw_plan_live_answer short_of_memory(void) {
    static const char text[] =
        "{\"error\":{\"message\":\"out of memory, or over the limit\",\"code\":null}}\n";
    return (fw_plan_live_answer){FW_NOMEM, text, sizeof text - 1};
}

static fw_plan_live_answer failure(fw_status status, const char *message, fw_text *out) {
    out->length = 0;
    fw_json json = fw_json_new(out, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_object(&json, "error");
    fw_json_text(&json, "message", message ? message : fw_status_text(status));
    fw_json_text(&json, "code", status == FW_USAGE ? "FW-D289" : NULL);
    fw_json_end(&json);
    fw_json_end(&json);
    if (fw_json_finish(&json, "\n") != FW_OK || status == FW_NOMEM) return short_of_memory();
    return (fw_plan_live_answer){status, out->data, out->length};
}

fw_plan_live_answer fw_plan_live_call(fw_plan_live *live, const char *json, size_t n,
                                      const char *const *keys, fw_plan_live_work work) {
    fw_plan_live_request request = {.wrong = NULL};
    fw_status status = FW_OK;
    fw_arena_free(live->answer);
    live->answer = fw_arena_new(live->settings.memory_cap);
    if (!live->answer) return short_of_memory();
    fw_arena_stop_with(live->answer, live->settings.cancel);
    fw_text out = fw_text_new(live->answer);
    if (keys) status = read_request(live->answer, json, n, keys, &request);
    if (status == FW_OK) status = work(live, &request, &out);
    if (status == FW_OK) status = fw_text_end(&out);
    free_request(&request);
    if (status != FW_OK) return failure(status, request.wrong, &out);
    return (fw_plan_live_answer){FW_OK, out.data, out.length};
}
