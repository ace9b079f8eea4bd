/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requests with bytes changed, cut and repeated at random: every answer is one JSON document,
   either with a schema or with an error, and the next sound request is answered as ever. */
#include "base/arena.h"
#include "live_case.h"

static uint64_t seed = 0x9e3779b97f4a7c15ULL;

static size_t below(size_t n) { /* xorshift64 (Marsaglia 2003) */
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return n ? (size_t)(seed >> 11) % n : 0;
}

enum { ROOM = 1 << 16 };

/* one change of n bytes; returns how many there are then */
static size_t mutate(char *s, size_t n) {
    static const char *const word[] = {"\"", "{}", "[",    "null", "1e309", "-1",   "\\u0000",
                                       "<",  "&",  "\xff", "\\",   "/@",    "[99]", "\"set\":"};
    size_t at = below(n), length = 1 + below(12);
    if (at + length > n) length = n - at;
    switch (below(4)) {
    case 0: /* another byte */
        if (n) s[at] = (char)below(256);
        return n;
    case 1: /* cut out */
        memmove(s + at, s + at + length, n - at - length);
        return n - length;
    case 2: /* twice */
        if (n + length > ROOM) return n;
        memmove(s + at + length, s + at, n - at);
        return n + length;
    default: { /* something that means something */
        const char *w = word[below(sizeof word / sizeof word[0])];
        size_t k = strlen(w);
        if (n + k > ROOM) return n;
        memmove(s + at + k, s + at, n - at);
        memcpy(s + at, w, k);
        return n + k;
    }
    }
}

static void is_an_answer(fw_plan_live_answer a) {
    json_t *root = json_loadb(a.text, a.length, JSON_REJECT_DUPLICATES, NULL);
    if (!root) fail_msg("no JSON: %.400s", a.text);
    bool error = json_object_get(root, "error") != NULL;
    assert_true(error == (a.status != FW_OK));
    assert_true(error != json_is_string(json_object_get(root, "schema")));
    json_decref(root);
}

static void mutated_requests(const char *request, live_function f, int count) {
    fw_plan_live *live = live_new();
    char *s = malloc(ROOM + 1);
    size_t whole = strlen(request);
    assert_true(s && whole < ROOM);
    json_t *before = ask(live, f, request, FW_OK);
    for (int i = 0; i < count; i++) {
        memcpy(s, request, whole);
        size_t n = whole;
        for (size_t k = 1 + below(3); k > 0; k--)
            n = mutate(s, n);
        is_an_answer(f(live, s, n));
    }
    json_t *after = ask(live, f, request, FW_OK);
    json_object_del(before, "cost"), json_object_del(after, "cost"); /* CPU time */
    json_object_del(json_object_get(json_object_get(before, "motion"), "stats"), "cpu_s");
    json_object_del(json_object_get(json_object_get(after, "motion"), "stats"), "cpu_s");
    json_object_del(json_object_get(json_object_get(before, "motion"), "stats"), "estimate_cpu_s");
    json_object_del(json_object_get(json_object_get(after, "motion"), "stats"), "estimate_cpu_s");
    assert_true(json_equal(before, after));
    json_decref(before), json_decref(after);
    free(s);
    fw_plan_live_free(live);
}

#define SMALL "tests/data/effect-costs/free.xml"

static void previews(void **state) {
    (void)state;
    char *r =
        request_of(SMALL, "\"set\":{},\"options\":{\"samples\":5,\"scene\":null,\"rtol\":1e-6}");
    mutated_requests(r, fw_plan_live_preview, 300);
    free(r);
}

static void poses(void **state) {
    (void)state;
    char *r =
        request_of(SMALL, "\"platform\":{\"x_m\":1e-4,\"y_m\":0,\"phi_rad\":0.1},\"q\":[1,2,3]");
    mutated_requests(r, fw_plan_live_pose, 300);
    free(r);
}

static void edits(void **state) {
    (void)state;
    char *r = request_of(
        SIX_BAR, "\"changes\":[{\"path\":\"scene[step-load]/force[1]/@fx\",\"value\":\"1 N\"},"
                 "{\"add\":\"flexure[A]\",\"element\":\"line\",\"attributes\":{\"length\":\"1 "
                 "um\"}},{\"remove\":\"workspace[1]\"},{\"path\":\"die/@title\",\"value\":null}]");
    mutated_requests(r, fw_plan_live_edit, 300);
    free(r);
}

/* nested far deeper than anything needs, and larger than anything may be */
static void deep_and_large(void **state) {
    (void)state;
    enum { MANY = 200000 };
    fw_plan_live *live = live_new();
    char *s = malloc(MANY + 1);
    assert_non_null(s);
    memset(s, '[', MANY);
    is_an_answer(fw_plan_live_preview(live, s, MANY));
    memset(s, ' ', MANY);
    is_an_answer(fw_plan_live_edit(live, s, MANY));
    is_an_answer(fw_plan_live_pose(live, s, (size_t)1 << 40)); /* not one byte of it is looked at */
    is_an_answer(fw_plan_live_preview(live, NULL, 0));
    free(s);
    fw_plan_live_free(live);
}

/* a limit on memory is an error object, and the next request is answered */
static void memory_that_is_short(void **state) {
    (void)state;
    char *r = request_of(SIX_BAR, NULL);
    for (size_t cap = 1 << 16; cap < (size_t)1 << 26; cap *= 2) {
        fw_plan_live_settings settings = {.data_directory = FW_TEST_SOURCE_DIR, .memory_cap = cap};
        fw_plan_live *live = fw_plan_live_new(&settings);
        assert_non_null(live);
        is_an_answer(fw_plan_live_preview(live, r, strlen(r)));
        is_an_answer(fw_plan_live_table(live));
        fw_plan_live_free(live);
    }
    free(r);
    fw_plan_live_free(NULL);
}

/* whichever allocation fails, alone or with all behind it: an error object or a whole answer */
static void any_allocation_may_fail(void **state) {
    (void)state;
    static const char *const more[] = {
        "\"options\":{\"samples\":3}", "\"platform\":{\"x_m\":1e-5}",
        ("\"changes\":[{\"path\":\"device/"
         "@name\",\"value\":\"x\"},{\"add\":\"\",\"element\":\"flow\"}]")};
    static const live_function function[] = {fw_plan_live_preview, fw_plan_live_pose,
                                             fw_plan_live_edit};
    for (int k = 0; k < 3; k++) {
        char *r = request_of(SMALL, more[k]);
        long before = fw_arena_count();
        fw_plan_live *live = live_new();
        is_an_answer(function[k](live, r, strlen(r)));
        long all = fw_arena_count() - before, failed = 0;
        fw_plan_live_free(live);
        assert_true(all > 20);
        for (long n = 1; n <= all; n += 1 + all / 60)
            for (int ever_after = 0; ever_after < 2; ever_after++) {
                fw_arena_fail_at(n, ever_after);
                live = fw_plan_live_new(
                    &(fw_plan_live_settings){.data_directory = FW_TEST_SOURCE_DIR});
                if (live) {
                    fw_plan_live_answer a = function[k](live, r, strlen(r));
                    is_an_answer(a);
                    failed += a.status == FW_NOMEM;
                }
                fw_arena_fail_at(0, 0);
                if (live) is_an_answer(function[k](live, r, strlen(r)));
                fw_plan_live_free(live);
            }
        assert_true(failed > 20);
        free(r);
    }
}

/* ---- requests that are not what they should be ---- */

#define EMPTY "{\"text\":\"\","
#define EDIT  "{\"text\":\"<a/>\",\"changes\":"
#define DRAG  "{\"text\":\"<a/>\",\"platform\":"

typedef struct wrong {
    const char *request, *says;
} wrong;

static void refused(fw_plan_live *live, live_function f, const wrong *row, size_t n) {
    for (size_t i = 0; i < n; i++) {
        json_t *e = ask(live, f, row[i].request, FW_USAGE), *o = json_object_get(e, "error");
        assert_string_equal(text_at(o, "code"), "FW-D289");
        if (!strstr(text_at(o, "message"), row[i].says))
            fail_msg("%s: %s", row[i].request, text_at(o, "message"));
        json_decref(e);
    }
}

static void wrong_requests_are_said(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    static const wrong preview[] = {{"", "not a JSON object"},
                                    {"[", "not a JSON object"},
                                    {"[]", "not a JSON object"},
                                    {"1", "not a JSON object"},
                                    {"null", "not a JSON object"},
                                    {"{}", "\"text\""},
                                    {"{\"text\":1}", "\"text\""},
                                    {"{\"text\":null}", "\"text\""},
                                    {EMPTY "\"x\":1}", "\"x\""},
                                    {EMPTY "\"text\":\"\"}", "not a JSON object"},
                                    {EMPTY "\"set\":[]}", "\"set\""},
                                    {EMPTY "\"set\":{\"a\":1}}", "\"a\""},
                                    {EMPTY "\"set\":{\"\":\"1\"}}", "needs the name"},
                                    {EMPTY "\"options\":{\"scene\":3}}", "\"scene\""},
                                    {EMPTY "\"options\":{\"samples\":2.5}}", "samples"},
                                    {EMPTY "\"options\":{\"samples\":1e9}}", "samples"},
                                    {EMPTY "\"options\":{\"accuracy\":\"1\"}}", "\"accuracy\""},
                                    {EMPTY "\"options\":{\"accuracy\":7}}", "accuracy"},
                                    {EMPTY "\"options\":{\"nothing\":1}}", "\"nothing\""},
                                    {EMPTY "\"options\":{\"detail\":\"huge\"}}", "detail"},
                                    {EMPTY "\"options\":{\"method\":\"no\"}}", "method"},
                                    {EMPTY "\"options\":{\"corners\":\"x\"}}", "corners"},
                                    {"{\"text\":\"\\u0000\"}", "not a JSON object"},
                                    {"{\"text\":\"\xff\"}", "not a JSON object"}};
    static const wrong edit[] = {
        {"{\"text\":\"<a/>\"}", "\"changes\""},
        {EDIT "{}}", "\"changes\""},
        {EDIT "[1]}", "every change has to be a JSON object"},
        {EDIT "[{}]}", "one of"},
        {EDIT "[{\"path\":\"a\"}]}", "a value (null removes the attribute) is needed"},
        {EDIT "[{\"path\":\"a\",\"remove\":\"b\",\"value\":\"\"}]}", "one of"},
        {EDIT "[{\"add\":\"a\"}]}", "an element is needed"},
        {EDIT "[{\"add\":\"a\",\"element\":\"b\",\"attributes\":{\"c\":1}}]}", "\"c\""}};
    static const wrong pose[] = {{"{\"text\":\"<a/>\"}", "\"platform\""},
                                 {DRAG "3}", "\"platform\""},
                                 {DRAG "{\"x_m\":\"1\"}}", "\"x_m\""},
                                 {DRAG "{\"x_m\":1e300}}", "at most 1e6 m"}};
    refused(live, fw_plan_live_preview, preview, sizeof preview / sizeof preview[0]);
    refused(live, fw_plan_live_edit, edit, sizeof edit / sizeof edit[0]);
    refused(live, fw_plan_live_pose, pose, sizeof pose / sizeof pose[0]);
    json_t *invalid = ask(live, fw_plan_live_pose, DRAG "{}}", FW_OK);
    assert_string_equal(text_at(invalid, "status"), "invalid");
    json_decref(invalid);
    fw_plan_live_free(live);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(previews),
        cmocka_unit_test(poses),
        cmocka_unit_test(edits),
        cmocka_unit_test(deep_and_large),
        cmocka_unit_test(memory_that_is_short),
        cmocka_unit_test(wrong_requests_are_said),
        cmocka_unit_test(any_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
