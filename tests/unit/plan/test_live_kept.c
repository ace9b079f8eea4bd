/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a preview keeps of the one before it changes nothing: every answer of a course of edits, mistakes, settings, options,
   laboratory packs and changed files is the one of somebody who asks for the first time. */
#include "live_case.h"
#include <signal.h>
#include <sys/stat.h>
#include <sys/time.h>
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

/* without times of a processor; *judged_s, where somebody asks: that of judging, 0: nothing was judged */
static json_t *answered(fw_plan_live *live, const char *text, double *judged_s) {
    fw_plan_live_answer a = fw_plan_live_preview(live, text, strlen(text));
    json_t *root = json_loads(a.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    const json_t *cost = json_object_get(root, "cost");
    if (judged_s) *judged_s = json_number_value(json_object_get(cost, "judge_s"));
    json_object_set_new(root, "status of the call", json_integer(a.status));
    json_object_del(root, "cost");
    json_t *stats = json_object_get(json_object_get(root, "motion"), "stats");
    json_object_del(stats, "cpu_s"), json_object_del(stats, "estimate_cpu_s");
    return root;
}

/* the answer of both, which the caller releases */
static json_t *the_same(fw_plan_live *live, const char *directory, const request *r,
                        double *judged_s) {
    char *text = composed(r);
    fw_plan_live *fresh = of_directory(directory);
    json_t *mine = answered(live, text, judged_s), *want = answered(fresh, text, NULL);
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

/* of a picture all members are those of the preview but what only a judged flow has, and those of the motion that it has */
static void the_same_picture(const json_t *picture, const json_t *preview) {
    static const char *const same[] = {"name",   "scenes", "box_um",     "scene_box_um", "bodies",
                                       "ties",   "flexures", "springs", "loads", "not_drawn"};
    static const char *const moved[] = {"scene", "flow", "peaks", "load_factor",
                                        "tension_N", "t_s", "q", "angle_rad"};
    static const char *const used[] = {"id",           "at_um",           "shown_limit_rad",
                                       "shown_utilisation", "shown_criterion"};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
        assert_true(json_equal(json_object_get(picture, same[i]), json_object_get(preview, same[i])));
    const json_t *a = json_object_get(picture, "motion"), *b = json_object_get(preview, "motion");
    assert_int_equal(json_is_object(a), json_is_object(b));
    for (size_t i = 0; json_is_object(a) && i < sizeof moved / sizeof moved[0]; i++) {
        assert_non_null(json_object_get(a, moved[i]));
        assert_true(json_equal(json_object_get(a, moved[i]), json_object_get(b, moved[i])));
    }
    const json_t *pins = json_object_get(picture, "pins"), *judged = json_object_get(preview, "pins");
    assert_int_equal(json_array_size(pins), json_array_size(judged));
    for (size_t k = 0; k < json_array_size(pins); k++)
        for (size_t i = 0; i < sizeof used / sizeof used[0]; i++)
            assert_true(json_equal(json_object_get(json_array_get(pins, k), used[i]),
                                   json_object_get(json_array_get(judged, k), used[i])));
}

/* what a page shows first is what comes behind it, for devices that are accepted, rejected, refused and misread; and a
   picture changes nothing of the preview that follows */
static void a_picture_is_that_of_its_preview(void **state) {
    (void)state;
    const char *directory = FW_TEST_SOURCE_DIR;
    fw_plan_live *live = of_directory(directory);
    int pictures = 0;
    for (size_t i = 0; i < sizeof course / sizeof course[0]; i++) {
        char *text = composed(&course[i]);
        fw_plan_live_answer a = fw_plan_live_picture(live, text, strlen(text));
        json_t *picture = json_loads(a.text, JSON_REJECT_DUPLICATES, NULL);
        assert_non_null(picture);
        json_t *preview = the_same(live, directory, &course[i], NULL);
        const char *how = json_string_value(json_object_get(picture, "status"));
        assert_int_equal(a.status,
                         json_integer_value(json_object_get(preview, "status of the call")));
        if (how && strcmp(how, "ok") == 0) the_same_picture(picture, preview), pictures++;
        if (how && json_is_object(json_object_get(preview, "motion"))) assert_string_equal(how, "ok");
        json_decref(picture), json_decref(preview);
        free(text);
    }
    assert_true(pictures >= 12);
    fw_plan_live_free(live);
}

static void a_course_of_edits(void **state) {
    (void)state;
    fw_plan_live *live = of_directory(FW_TEST_SOURCE_DIR);
    int judged = 0, wrong = 0;
    for (size_t i = 0; i < sizeof course / sizeof course[0]; i++) {
        json_t *got = the_same(live, FW_TEST_SOURCE_DIR, &course[i], NULL);
        const char *status = text_at(got, "status");
        judged += strcmp(status, "ok") == 0, wrong += strcmp(status, "invalid") == 0;
        json_decref(got);
    }
    assert_true(judged >= 12 && wrong >= 4);
    fw_plan_live_free(live);
}

/* ---- what was held, and is text by now ---- */

#define WIDE(text) "value=\"8 um\"", "value=\"" text "\""
#define PUSH       "duration=\"20 ms\">\n    <force on=\"coupler\" fx=\"0.06 mN\""
#define TOO_MUCH(text) PUSH, "duration=\"20 ms\"><force on=\"coupler\" fx=\"" text "\""

/* a value that is held, then a text: is it answered by what was judged with the value held? */
static const struct {
    request held, text;
    bool taken;
} let_go[] = {
    {{NULL, NULL, "\"set\":{\"width\":\"9.5 um\"}"}, {WIDE("9.5 um"), NULL}, true},
    {{NULL, NULL, "\"set\":{\"width\":\"9.5 um\"}"}, {WIDE("9.6 um"), NULL}, false},
    {{NULL, NULL, "\"set\":{\"width\":\"0.009 mm\"}"}, {WIDE("0.009 mm"), NULL}, false},
    {{NULL, NULL, "\"set\":{\"width\":\"9 um\"}"}, {WIDE("9 um"), "\"rates\":true"}, false},
    {{NULL, NULL, "\"set\":{\"width\":\"9 um\"},\"rates\":true"},
     {WIDE("9 um"), "\"rates\":true"},
     true},
    {{NULL, NULL, "\"set\":{\"width\":\"9 um\"}"},
     {WIDE("9 um"), "\"options\":{\"samples\":9}"},
     false},
    {{NULL, NULL, "\"set\":{\"width\":\"9 um\"}," LAB("9")}, {WIDE("9 um"), NULL}, false},
    {{NULL, NULL, "\"set\":{\"width\":\"9 um\"}"},
     {WIDE("9 um"), "\"set\":{\"width\":\"9 um\"}"},
     false},
    {{NULL, NULL, "\"set\":{\"width\":\"9 um\"},\"options\":{\"detail\":\"full\"}"},
     {WIDE("9 um"), "\"options\":{\"detail\":\"full\"}"},
     true},
    /* a warning is about the line that changes, and may have another place in it */
    {{TOO_MUCH("0.06 mN"), "\"set\":{\"scene[push]/force/@fx\":\"60 mN\"}"},
     {TOO_MUCH("60 mN"), NULL},
     false},
    {{TOO_MUCH("0.06 mN"), "\"set\":{\"scene[push]/force/@fx\":\"0.05 mN\"}"},
     {TOO_MUCH("0.05 mN"), NULL},
     true},
};

static double judging_s(fw_plan_live *live, const request *r) {
    double s;
    char *text = composed(r);
    json_decref(answered(live, text, &s));
    free(text);
    return s;
}

/* The answer to the text is that of somebody who asks for the first time; and where it was composed anew, of what was
   judged with the value held, judging has cost the same to the microsecond. Asked for once more it is judged anew. */
static void what_was_held_is_text(void **state) {
    (void)state;
    fw_plan_live *live = of_directory(FW_TEST_SOURCE_DIR);
    for (size_t i = 0; i < sizeof let_go / sizeof let_go[0]; i++) {
        double held = judging_s(live, &let_go[i].held), text;
        json_decref(the_same(live, FW_TEST_SOURCE_DIR, &let_go[i].text, &text));
        assert_true(held > 0.0); /* it was judged */
        if (let_go[i].taken != (text == held))
            fail_msg("%s: judged %s", let_go[i].held.more, text == held ? "once" : "again");
        assert_true(i > 0 || judging_s(live, &let_go[i].text) != text);
    }
    fw_plan_live_free(live);
}

/* ---- given up ---- */

static fw_cancel given_up; /* a handler sees nothing but what is static */

static void give_up(int number) {
    fw_cancel_request(&given_up, number);
}

/* A preview that is given up in the middle leaves the design in any state, and the one after it begins from what was
   read all the same. The scene is a hundred times as long as the file's: it takes some tenths of a second of any processor,
   so that it is never done before it is given up. */
static void the_one_after_what_was_given_up(void **state) {
    (void)state;
    const fw_plan_live_settings settings = {.data_directory = FW_TEST_SOURCE_DIR,
                                            .cancel = &given_up};
    const request first = {"duration=\"20 ms\"", "duration=\"2 s\"", NULL}, after = {WIDE("8.5 um"), NULL};
    char *text = composed(&first);
    fw_plan_live *live = fw_plan_live_new(&settings);
    assert_non_null(live);
    assert_int_equal(fw_plan_live_preview(live, text, strlen(text)).status, FW_OK);
    assert_int_equal(sigaction(SIGPROF, &(struct sigaction){.sa_handler = give_up}, NULL), 0);
    for (int ms = 1; ms <= 21; ms += 5) { /* of the processor; the kernel rounds up */
        const struct itimerval soon = {.it_value.tv_usec = 1000 * ms}, never = {0};
        assert_int_equal(setitimer(ITIMER_PROF, &soon, NULL), 0);
        fw_status status = fw_plan_live_preview(live, text, strlen(text)).status;
        assert_int_equal(setitimer(ITIMER_PROF, &never, NULL), 0);
        fw_cancel_clear(&given_up);
        assert_int_equal(status, FW_CANCELLED);
        json_decref(the_same(live, FW_TEST_SOURCE_DIR, &after, NULL));
    }
    free(text);
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
    json_t *first = the_same(live, directory, &plain, NULL), *again = the_same(live, directory, &plain, NULL);
    assert_true(json_equal(first, again));
    json_decref(again);
    changed(BASE, directory, "value=\"147.08\"", "value=\"150.08\"");
    again = the_same(live, directory, &plain, NULL);
    assert_false(json_equal(first, again));
    json_decref(again);
    copied(BASE, directory);
    changed(PACK, directory, "</process>", "");
    again = the_same(live, directory, &plain, NULL);
    assert_string_equal(text_at(again, "status"), "invalid");
    json_decref(again);
    copied(PACK, directory);
    again = the_same(live, directory, &plain, NULL);
    assert_true(json_equal(first, again));
    json_decref(again);
    snprintf(path, sizeof path, "%s/%s", directory, MASK);
    assert_int_equal(unlink(path), 0);
    again = the_same(live, directory, &plain, NULL);
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
        cmocka_unit_test(a_picture_is_that_of_its_preview),
        cmocka_unit_test(what_was_held_is_text),
        cmocka_unit_test(the_one_after_what_was_given_up),
        cmocka_unit_test(files_that_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
