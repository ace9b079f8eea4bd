/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requests to fw_plan_live_*, and their answers as JSON. */
#ifndef FW_TEST_LIVE_CASE_H
#define FW_TEST_LIVE_CASE_H
#include "plan/live.h"
#include "test.h"
#include <jansson.h>
#include <stdbool.h>
#include <stdlib.h>

static inline fw_plan_live *live_new(void) {
    fw_plan_live_settings settings = {.data_directory = FW_TEST_SOURCE_DIR};
    fw_plan_live *live = fw_plan_live_new(&settings);
    assert_non_null(live);
    return live;
}

/* the text of a file below the source directory; the caller frees it */
static inline char *text_of_file(const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, name);
    FILE *f = fopen(path, "rb");
    if (!f) fail_msg("%s cannot be opened", path);
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, f) > 0);
    fclose(f);
    return text;
}

/* {"text": of the file, ...}; `more` is JSON members as in "\"flow\":\"x\"", or NULL */
static inline char *request_of(const char *file, const char *more) {
    char *text = text_of_file(file);
    json_t *root = json_object();
    json_object_set_new(root, "text", json_string(text));
    free(text);
    if (more) {
        char braced[2048];
        snprintf(braced, sizeof braced, "{%s}", more);
        json_t *rest = json_loads(braced, 0, NULL);
        if (!rest) fail_msg("%s", braced);
        json_object_update(root, rest);
        json_decref(rest);
    }
    char *dump = json_dumps(root, JSON_COMPACT);
    json_decref(root);
    assert_non_null(dump);
    return dump;
}

typedef fw_plan_live_answer (*live_function)(fw_plan_live *live, const char *request, size_t n);

/* the answer, which must be JSON; the caller releases it */
static inline json_t *ask(fw_plan_live *live, live_function f, const char *request,
                          fw_status wanted) {
    fw_plan_live_answer a = f(live, request, strlen(request));
    json_error_t error;
    assert_non_null(a.text);
    assert_int_equal(strlen(a.text), a.length);
    json_t *root = json_loads(a.text, JSON_REJECT_DUPLICATES, &error);
    if (!root) fail_msg("no JSON: %s in line %d of %s", error.text, error.line, a.text);
    if (a.status != wanted) fail_msg("status %d: %.500s", (int)a.status, a.text);
    return root;
}

static inline json_t *ask_file(fw_plan_live *live, live_function f, const char *file,
                               const char *more) {
    char *request = request_of(file, more);
    json_t *root = ask(live, f, request, FW_OK);
    free(request);
    return root;
}

static inline const char *text_at(const json_t *object, const char *key) {
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

static inline double real_at(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    if (!json_is_number(value)) fail_msg("no number %s", key);
    return json_number_value(value);
}

static inline double item(const json_t *array, int i) {
    const json_t *value = json_array_get(array, (size_t)i);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

#define SIX_BAR "docs/gallery/reference-six-bar/device.xml"
#endif
