/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a preview keeps of the one before it changes nothing: every answer of a course of edits, mistakes, settings, options,
   laboratory packs and changed files is the one of somebody who asks for the first time. */
#include "live_case.h"
#include <sys/stat.h>
#include <unistd.h>

#define DEVICE "docs/gallery/leaf-four-bar/device.xml"

static char *replaced(const char *text, const char *from, const char *to) {
    const char *at = strstr(text, from);
    if (!at) fail_msg("'%s' is not in the text", from);
    char *out = NULL;
    const size_t before = (size_t)(at - text);
    out = malloc(strlen(text) + strlen(to) + 1);
    assert_non_null(out);
    memcpy(out, text, before);
    strcpy(out + before, to);
    strcat(out, at + strlen(from));
    return out;
}

/* one request: a text of the file with one change, and further members */
typedef struct request {
    const char *from, *to, *more;
} request;

static char *composed(const request *r) {
    char *text = text_of_file(DEVICE), braced[2048];
    char *changed = replaced(text, r->from ? r->from : "<device", r->to ? r->to : "<device");
    snprintf(braced, sizeof braced, "{%s}", r->more ? r->more : "");
    json_t *root = json_loads(braced, 0, NULL);
    assert_non_null(root);
    json_object_set_new(root, "text", json_string(changed));
    char *dump = json_dumps(root, JSON_COMPACT);
    assert_non_null(dump);
    json_decref(root);
    free(text), free(changed);
    return dump;
}

static fw_plan_live *of_directory(const char *directory) {
    fw_plan_live *live = fw_plan_live_new(&(fw_plan_live_settings){.data_directory = directory});
    assert_non_null(live);
    return live;
}

/* without times of a processor */
static json_t *answered(fw_plan_live *live, const char *text) {
    fw_plan_live_answer a = fw_plan_live_preview(live, text, strlen(text));
    json_t *root = json_loads(a.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    json_object_set_new(root, "status of the call", json_integer(a.status));
    json_object_del(root, "cost");
    json_t *stats = json_object_get(json_object_get(root, "motion"), "stats");
    json_object_del(stats, "cpu_s"), json_object_del(stats, "estimate_cpu_s");
    return root;
}

/* the answer of both, which the caller releases */
static json_t *the_same(fw_plan_live *live, const char *directory, const request *r) {
    char *text = composed(r);
    fw_plan_live *fresh = of_directory(directory);
    json_t *mine = answered(live, text), *want = answered(fresh, text);
    if (!json_equal(mine, want)) {
        char *a = json_dumps(mine, JSON_SORT_KEYS), *b = json_dumps(want, JSON_SORT_KEYS);
        size_t i = 0;
        while (a[i] && a[i] == b[i])
            i++;
        fail_msg("%s %s: %.200s\n... in place of %.200s", r->to ? r->to : "",
                 r->more ? r->more : "", a + (i > 80 ? i - 80 : 0), b + (i > 80 ? i - 80 : 0));
    }
    fw_plan_live_free(fresh);
    json_decref(want);
    free(text);
    return mine;
}

#define LAB(value)                                                                                 \
    "\"lab\":{\"our.xml\":\"<process xmlns='urn:flexwright:process:1' flow='al-masked-rie'>"       \
    "<source id='ours' kind='measured' date='2026-11-01'>ours</source>"                            \
    "<q id='inspect.t' value='" value                                                              \
    "' u='1' unit='min' status='measured' src='ours'/></process>\"}"

static const request course[] = {
    {NULL, NULL, NULL},
    {"value=\"8 um\"", "value=\"9 um\"", NULL},
    {NULL, NULL, "\"set\":{\"width\":\"7 um\"}"},
    {NULL, NULL, "\"set\":{\"width\":7}"},
    {NULL, NULL, "\"set\":{\"breadth\":\"7 um\"}"},
    {NULL, NULL, NULL},
    {"kind=\"leaf\"", "kind=\"leef\"", NULL},
    {"</mechanism>", "", NULL},
    {"width=\"160 um\"", "width=\"170 um\"", NULL},
    {"ref=\"al-masked-rie\"", "ref=\"al-masked-rye\"", NULL},
    {"ref=\"al-masked-rie\"", "ref=\"soi-deep-rie\"", NULL},
    {"ref=\"al-masked-rie\"", "ref=\"soi-deep-rie\" thickness=\"40 um\"", NULL},
    {"ref=\"silicon-100\"", "ref=\"copper-plated\" orientation=\"9 deg\"", NULL}, /* warns twice, */
    {"ref=\"silicon-100\"", "ref=\"copper-plated\"", NULL},                       /* once */
    {"<flow ref=\"al-masked-rie\"/>", "", NULL},
    {"value=\"8 um\"", "value=\"12 um\"", "\"options\":{\"samples\":9}"},
    {"value=\"8 um\"", "value=\"11 um\"", "\"options\":{\"samples\":9}"},
    {NULL, NULL, "\"options\":{\"samples\":9,\"flow\":\"soi-deep-rie\"}"},
    {NULL, NULL, "\"options\":{\"samples\":9,\"hinge_model\":\"none\"}"},
    {NULL, NULL, LAB("9")},
    {"value=\"8 um\"", "value=\"9 um\"", LAB("9")},
    {"value=\"8 um\"", "value=\"9 um\"", LAB("10")},
    {"ref=\"al-masked-rie\"", "ref=\"soi-deep-rie\"", LAB("10")}, /* of no flow of the device */
    {"ref=\"al-masked-rie\"", "ref=\"soi-deep-rie\"", LAB("10")},
    {"</device>", "<wafer diameter=\"100 mm\"/></device>", NULL},
    {"value=\"8 um\"", "value=\"9 um\"", NULL},
};

static void a_course_of_edits(void **state) {
    (void)state;
    fw_plan_live *live = of_directory(FW_TEST_SOURCE_DIR);
    int judged = 0, wrong = 0;
    for (size_t i = 0; i < sizeof course / sizeof course[0]; i++) {
        json_t *got = the_same(live, FW_TEST_SOURCE_DIR, &course[i]);
        const char *status = text_at(got, "status");
        judged += strcmp(status, "ok") == 0, wrong += strcmp(status, "invalid") == 0;
        json_decref(got);
    }
    assert_true(judged >= 12 && wrong >= 4);
    fw_plan_live_free(live);
}

/* ---- files that change meanwhile ---- */

static void copied(const char *name, const char *to) {
    char path[600], *text = text_of_file(name);
    snprintf(path, sizeof path, "%s/%s", to, name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_true(fputs(text, f) >= 0);
    assert_int_equal(fclose(f), 0);
    free(text);
}

static void changed(const char *name, const char *to, const char *from, const char *into) {
    char path[600], *text = text_of_file(name), *other = replaced(text, from, into);
    snprintf(path, sizeof path, "%s/%s", to, name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_true(fputs(other, f) >= 0);
    assert_int_equal(fclose(f), 0);
    free(text), free(other);
}

#define BASE "processes/base.xml"
#define PACK "processes/al-masked-rie.xml"
#define MASK "masks/al-masked-rie.xml"

static void files_that_change(void **state) {
    (void)state;
    char directory[] = "fw-kept-XXXXXX", path[600];
    static const char *const folder[] = {"processes", "masks"}, *const file[] = {BASE, PACK, MASK};
    assert_non_null(mkdtemp(directory));
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", directory, folder[i]);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    for (int i = 0; i < 3; i++)
        copied(file[i], directory);
    fw_plan_live *live = of_directory(directory);
    const request plain = {NULL, NULL, NULL};
    json_t *first = the_same(live, directory, &plain), *again = the_same(live, directory, &plain);
    assert_true(json_equal(first, again));
    json_decref(again);
    changed(BASE, directory, "value=\"147.08\"", "value=\"150.08\"");
    again = the_same(live, directory, &plain);
    assert_false(json_equal(first, again));
    json_decref(again);
    copied(BASE, directory);
    changed(PACK, directory, "</process>", "");
    again = the_same(live, directory, &plain);
    assert_string_equal(text_at(again, "status"), "invalid");
    json_decref(again);
    copied(PACK, directory);
    again = the_same(live, directory, &plain);
    assert_true(json_equal(first, again));
    json_decref(again);
    snprintf(path, sizeof path, "%s/%s", directory, MASK);
    assert_int_equal(unlink(path), 0);
    again = the_same(live, directory, &plain);
    assert_false(json_equal(first, again));
    json_decref(again), json_decref(first);
    fw_plan_live_free(live);
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", directory, file[i]);
        unlink(path);
    }
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", directory, folder[i]);
        assert_int_equal(rmdir(path), 0);
    }
    assert_int_equal(rmdir(directory), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_course_of_edits),
        cmocka_unit_test(files_that_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
