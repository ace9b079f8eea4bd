/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points that a page looks at: each is what the library says of that device, whatever was asked before, and what is
   no request is refused. */
#include "../plan/live_case.h"
#include "study/study.h"
#include <flexwright.h>

#define SIX_BAR "docs/gallery/reference-six-bar/device.xml"
#define ASKED                                                                                      \
    "\"inputs\":[\"flexure[C]/@width\"],\"values\":[\"governing.utilisation\","                    \
    "\"hinges[C].utilisation_band[1]\",\"governing.nothing\"],\"options\":{\"detail\":\"full\"}"

static json_t *explore(fw_plan_live *live, const char *more) {
    return ask_file(live, fw_study_explore, SIX_BAR, more);
}

/* decision, governing utilisation and upper end of hinge C's band, by the library's own calls */
static int by_itself(const char *width, double *governing, double *upper) {
    char path[512];
    const char *text;
    size_t n;
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.corners = "none", o.advice = "none";
    fw_design *design = fw_design_new(&o);
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, SIX_BAR);
    assert_int_equal(fw_design_set(design, "flexure[C]/@width", width), FW_STATUS_OK);
    assert_int_equal(fw_design_read(design, path), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(design), FW_STATUS_OK);
    assert_int_equal(fw_design_document(design, FW_DOCUMENT_VERDICT_JSON, &text, &n), FW_STATUS_OK);
    json_t *root = json_loadb(text, n, 0, NULL);
    *governing = real_at(json_object_get(root, "governing"), "utilisation");
    json_t *hinge = json_array_get(json_object_get(root, "hinges"), 2);
    assert_string_equal(text_at(hinge, "id"), "C");
    *upper = json_real_value(json_array_get(json_object_get(hinge, "utilisation_band"), 1));
    json_decref(root);
    int decision = fw_design_decision(design);
    fw_design_free(design);
    return decision;
}

static void same_as_by_itself(const json_t *answer, size_t i, const char *width) {
    double governing, upper;
    int decision = by_itself(width, &governing, &upper);
    const json_t *point = json_array_get(json_object_get(answer, "points"), i);
    json_t *values = json_object_get(point, "values");
    assert_string_equal(text_at(point, "state"), decision == 0   ? "accept"
                                                 : decision == 1 ? "reject"
                                                                 : "inconclusive");
    assert_true(json_real_value(json_array_get(values, 0)) == governing);
    assert_true(json_real_value(json_array_get(values, 1)) == upper);
    assert_true(json_is_null(json_array_get(values, 2))); /* there is no such key */
}

static void a_point_is_what_check_says(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    json_t *a = explore(live, ASKED ",\"points\":[[\"7 um\"],[\"14 um\"],[\"9.3 um\"]]");
    assert_string_equal(text_at(a, "schema"), "flexwright.explore/1");
    assert_string_equal(text_at(a, "status"), "ok");
    same_as_by_itself(a, 0, "7 um");
    same_as_by_itself(a, 1, "14 um");
    same_as_by_itself(a, 2, "9.3 um");
    const json_t *points = json_object_get(a, "points");
    assert_string_not_equal(text_at(json_array_get(points, 0), "state"),
                            text_at(json_array_get(points, 1), "state"));
    json_decref(a);
    fw_plan_live_free(live);
}

/* bounds of effects are found where somebody asks for them, though pins were asked for and they decide nothing */
static void a_bound_that_is_read_is_found(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    json_t *a = explore(live, "\"inputs\":[\"flexure[C]/@width\"],"
                              "\"values\":[\"effects[nonlinear-hinge,gentle-step].bound\"],"
                              "\"options\":{\"detail\":\"quick\"},\"points\":[[\"8 um\"]]");
    const json_t *point = json_array_get(json_object_get(a, "points"), 0);
    const double bound = json_real_value(json_array_get(json_object_get(point, "values"), 0));
    assert_true(bound > 1e-4 && bound < 1);
    json_decref(a);
    fw_plan_live_free(live);
}

/* its hinges hold, but no mask shows a line as narrow: check says no, whatever is asked for */
static void what_has_no_mask_is_rejected(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    json_t *a =
        explore(live, "\"inputs\":[\"flexure[C]/@width\"],\"values\":[\"governing.utilisation\","
                      "\"hinges[C].utilisation_band[1]\",\"governing.nothing\"],"
                      "\"options\":{\"detail\":\"quick\",\"corners\":\"none\"},"
                      "\"points\":[[\"3.4 um\"],[\"8 um\"]]");
    const json_t *points = json_object_get(a, "points");
    same_as_by_itself(a, 0, "3.4 um");
    same_as_by_itself(a, 1, "8 um");
    assert_string_equal(text_at(json_array_get(points, 0), "state"), "reject");
    assert_non_null(strstr(text_at(json_array_get(points, 0), "why"), "it cannot be made in "));
    assert_true(json_is_null(json_object_get(json_array_get(points, 1), "why")));
    assert_true(json_real_value(
                    json_array_get(json_object_get(json_array_get(points, 0), "values"), 0)) < 1);
    json_decref(a);
    fw_plan_live_free(live);
}

/* the study that is kept is of one input: another text, another set or another input is another one */
static void what_was_asked_before_does_not_matter(void **state) {
    (void)state;
    static const char *const first[] = {
        ASKED ",\"points\":[[\"7 um\"],[\"5 furlongs\"]]",
        ASKED ",\"set\":{\"limits/@safety-factor\":\"3\"},\"points\":[[\"9.3 um\"]]",
        ("\"inputs\":[\"arc\",\"flexure[A]/@width\"],\"values\":[\"governing.utilisation\"],"
         "\"points\":[[\"230 deg\",\"9 um\"]]")};
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++) {
        fw_plan_live *live = live_new(), *fresh = live_new();
        json_decref(explore(live, first[i]));
        json_decref(ask_file(live, fw_plan_live_preview, SIX_BAR, NULL));
        json_t *a = explore(live, ASKED ",\"points\":[[\"9.3 um\"]]");
        json_t *b = explore(fresh, ASKED ",\"points\":[[\"9.3 um\"]]");
        assert_true(json_equal(a, b));
        same_as_by_itself(a, 0, "9.3 um");
        json_decref(a), json_decref(b);
        fw_plan_live_free(live), fw_plan_live_free(fresh);
    }
}

static void a_device_that_cannot_be_is_told(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    json_t *a = explore(live, ASKED ",\"points\":[[\"-3 um\"],[\"7 um\"]]");
    const json_t *points = json_object_get(a, "points");
    assert_string_equal(text_at(json_array_get(points, 0), "state"), "failed");
    assert_true(strlen(text_at(json_array_get(points, 0), "why")) > 10);
    same_as_by_itself(a, 1, "7 um");
    json_decref(a);
    for (int again = 0; again < 2; again++) { /* the second one meets what the first one kept */
        a = explore(live, "\"set\":{\"nobody\":\"1\"}," ASKED ",\"points\":[[\"7 um\"]]");
        assert_string_equal(text_at(a, "status"), "invalid");
        assert_true(json_array_size(json_object_get(a, "diagnostics")) > 0);
        json_decref(a);
    }
    a = explore(live, ASKED ",\"points\":[[\"7 um\"]]");
    same_as_by_itself(a, 0, "7 um");
    json_decref(a);
    fw_plan_live_free(live);
}

#define PACK(id)                                                                                   \
    "\"lab\":{\"mine.xml\":\"<process xmlns='urn:flexwright:process:1' "                           \
    "flow='al-masked-rie'><source "                                                                \
    "id='s' kind='measured'>x</source><q id='" id                                                  \
    "' value='0.97' u='0.001' unit='1' status='measured' src='s'/></process>\"},"
#define MADE                                                                                       \
    "\"inputs\":[\"flexure[C]/"                                                                    \
    "@width\"],\"values\":[\"governing.utilisation\"],\"options\":{\"corners\":"                   \
    "\"auto\"},\"points\":[[\"7 um\"]]"

/* a laboratory pack in memory counts as its file does, and what is wrong with it is said of its name */
static void a_pack_of_the_laboratory_counts(void **state) {
    (void)state;
    static const char thick[] = PACK("rie.A") MADE;
    static const char wrong[] = PACK("rie.nobody") MADE;
    fw_plan_live *live = live_new();
    json_t *with = explore(live, thick);
    json_t *without = explore(live, MADE);
    assert_string_equal(text_at(with, "status"), "ok");
    assert_false(json_equal(json_object_get(with, "points"), json_object_get(without, "points")));
    json_t *bad = explore(live, wrong);
    assert_string_equal(text_at(bad, "status"), "invalid");
    const json_t *said = json_array_get(json_object_get(bad, "diagnostics"), 0);
    assert_string_equal(text_at(said, "file"), "mine.xml");
    json_t *preview =
        ask_file(live, fw_plan_live_preview, SIX_BAR, PACK("rie.nobody") "\"set\":{}");
    assert_string_equal(text_at(preview, "status"), "invalid");
    json_decref(with), json_decref(without), json_decref(bad), json_decref(preview);
    fw_plan_live_free(live);
}

static const char *way_at(const json_t *answer, size_t i) {
    return text_at(json_array_get(json_object_get(answer, "points"), i), "way");
}

/* Between devices whose way is the same numbers go on smoothly: it changes with the decision and with what governs (hinge A below
   some 7.4 um of hinge C, else hinge C), and with nothing that has no word or whole number. */
static void the_way_of_a_verdict_is_told(void **state) {
    (void)state;
    fw_plan_live *live = live_new();
    json_t *a = explore(
        live, "\"inputs\":[\"flexure[C]/@width\"],\"values\":[\"governing.utilisation\"],"
              "\"options\":{\"detail\":\"quick\"},\"points\":[[\"9 um\"],[\"9.01 um\"],[\"10 um\"],"
              "[\"6 um\"],[\"6.01 um\"],[\"13 um\"],[\"-3 um\"]]");
    assert_string_equal(way_at(a, 0), way_at(a, 1));
    assert_string_equal(way_at(a, 0), way_at(a, 2));
    assert_string_equal(way_at(a, 3), way_at(a, 4));
    assert_string_not_equal(way_at(a, 0), way_at(a, 3)); /* another hinge governs */
    assert_string_not_equal(way_at(a, 0), way_at(a, 5)); /* not accepted any more */
    assert_int_equal(strlen(way_at(a, 0)), 16);
    assert_true(json_is_null(json_object_get(json_array_get(json_object_get(a, "points"), 6),
                                             "way"))); /* it cannot be judged */
    json_decref(a);
    fw_plan_live_free(live);
}

static void what_is_no_request_is_refused(void **state) {
    (void)state;
    static const char *const wrong[] = {
        "\"inputs\":[\"arc\"],\"values\":[\"governing.utilisation\"]",
        "\"inputs\":[\"arc\"],\"values\":[\"governing.utilisation\"],\"points\":[]",
        "\"inputs\":[\"arc\"],\"values\":[\"governing.utilisation\"],\"points\":[[\"1\",\"2\"]]",
        "\"inputs\":[\"arc\"],\"values\":[\"governing.utilisation\"],\"points\":[[7]]",
        "\"inputs\":[],\"values\":[\"governing.utilisation\"],\"points\":[[]]",
        "\"inputs\":[\"arc\"],\"values\":[],\"points\":[[\"230 deg\"]]",
        "\"inputs\":[\"arc\"],\"values\":[\"governing.utilisation\"],\"points\":[[\"230 deg\"]],"
        "\"options\":{\"accuracy\":7}",
        "\"inputs\":[\"arc\"],\"values\":[\"governing.utilisation\"],\"points\":[[\"230 deg\"]],"
        "\"set\":{\"arc\":3}"};
    fw_plan_live *live = live_new();
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char *request = request_of(SIX_BAR, wrong[i]);
        json_t *a = ask(live, fw_study_explore, request, FW_USAGE);
        const json_t *error = json_object_get(a, "error");
        assert_true(strlen(text_at(error, "message")) > 10);
        json_decref(a);
        free(request);
    }
    fw_plan_live_free(live);
}

/* stopped half way: the same is asked once more, and is the same */
static void a_request_that_was_stopped_leaves_nothing(void **state) {
    (void)state;
    fw_cancel cancel = {0};
    fw_plan_live_settings settings = {.data_directory = FW_TEST_SOURCE_DIR, .cancel = &cancel};
    fw_plan_live *live = fw_plan_live_new(&settings);
    json_decref(explore(live, ASKED ",\"points\":[[\"7 um\"]]"));
    char *request = request_of(SIX_BAR, ASKED ",\"points\":[[\"9.3 um\"],[\"14 um\"]]");
    fw_cancel_request(&cancel, 2);
    json_decref(ask(live, fw_study_explore, request, FW_CANCELLED));
    fw_cancel_clear(&cancel);
    json_t *a = ask(live, fw_study_explore, request, FW_OK);
    same_as_by_itself(a, 0, "9.3 um");
    same_as_by_itself(a, 1, "14 um");
    json_decref(a);
    free(request);
    fw_plan_live_free(live);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bound_that_is_read_is_found),
        cmocka_unit_test(a_point_is_what_check_says),
        cmocka_unit_test(what_has_no_mask_is_rejected),
        cmocka_unit_test(what_was_asked_before_does_not_matter),
        cmocka_unit_test(a_device_that_cannot_be_is_told),
        cmocka_unit_test(a_pack_of_the_laboratory_counts),
        cmocka_unit_test(the_way_of_a_verdict_is_told),
        cmocka_unit_test(what_is_no_request_is_refused),
        cmocka_unit_test(a_request_that_was_stopped_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
