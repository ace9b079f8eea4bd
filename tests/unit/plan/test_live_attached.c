/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the preview says of loads, springs, cables and electrodes: how much acts when, what the
   picture has to hold, which electrodes somebody has drawn. */
#include "live_case.h"
#include <math.h>

#define TENDONS "docs/gallery/four-tendons/device.xml"
#define COMBS   "tests/data/effects/comb.xml"

static fw_plan_live *live;

static int begin(void **state) {
    (void)state;
    live = live_new();
    return 0;
}

static int end(void **state) {
    (void)state;
    fw_plan_live_free(live);
    return 0;
}

static const json_t *at(const json_t *object, const char *key) {
    return json_object_get(object, key);
}

/* the preview of a file in which every `from` has become `to` */
static json_t *changed(const char *file, const char *from, const char *to) {
    char *text = text_of_file(file), *found;
    for (char *next = text; (found = strstr(next, from)) != NULL; next = found + strlen(to)) {
        size_t rest = strlen(found) - strlen(from);
        assert_true(strlen(text) + strlen(to) < 1 << 20);
        memmove(found + strlen(to), found + strlen(from), rest + 1);
        memcpy(found, to, strlen(to));
    }
    json_t *root = json_object();
    json_object_set_new(root, "text", json_string(text));
    json_object_set_new(root, "options", json_pack("{s:f}", "accuracy", 0.1));
    char *request = json_dumps(root, 0);
    json_t *p = ask(live, fw_plan_live_preview, request, FW_OK);
    free(request);
    json_decref(root);
    free(text);
    return p;
}

static void factors_are_those_of_the_laws(void **state) {
    (void)state;
    json_t *p = ask_file(live, fw_plan_live_preview, TENDONS,
                         "\"options\":{\"samples\":101,\"accuracy\":0.1}");
    const json_t *motion = at(p, "motion"), *all = at(motion, "load_factor");
    assert_int_equal(json_array_size(all), json_array_size(at(p, "loads")));
    for (size_t k = 0; k < 4; k++) {
        const json_t *list = json_array_get(all, k);
        bool constant = k == 0 || k == 3; /* T1 and T4 are not drawn in */
        assert_true(constant ? json_is_null(list) : json_array_size(list) == 101);
        for (int i = 0; !constant && i < 101; i++)
            assert_near(item(list, i), fmin(item(at(motion, "t_s"), i) / 2e-3, 1), 1e-5);
    }
    json_decref(p);
    /* at a jump the value after it: a step in the middle of 401 instants, off again at the end */
    p = changed(SIX_BAR, "<scene name=\"step-load\" duration=\"10 ms\" flow=\"al-masked-rie\">",
                "<scene name=\"step-load\" duration=\"10 ms\" flow=\"al-masked-rie\">"
                "<force on=\"CD\" fx=\"1 uN\" law=\"step\" start=\"5 ms\" end=\"7.5 ms\"/>");
    const json_t *step = json_array_get(at(at(p, "motion"), "load_factor"), 0);
    for (int i = 0; i < 401; i++)
        assert_near(item(step, i), i >= 200 && i < 300, 0);
    json_decref(p);
}

/* a point of a body in m, from a row of q */
static void place(const json_t *q, const json_t *eyelet, double to[2]) {
    int b = (int)real_at(eyelet, "body");
    double x = 1e-6 * item(at(eyelet, "at_um"), 0), y = 1e-6 * item(at(eyelet, "at_um"), 1);
    double phi = b < 0 ? 0 : item(q, 3 * b + 2);
    to[0] = cos(phi) * x - sin(phi) * y + (b < 0 ? 0 : item(q, 3 * b));
    to[1] = sin(phi) * x + cos(phi) * y + (b < 0 ? 0 : item(q, 3 * b + 1));
}

static double path_of(const json_t *q, const json_t *eyelets) {
    double length = 0, from[2], to[2];
    for (size_t i = 0; i < json_array_size(eyelets); i++) {
        place(q, json_array_get(eyelets, i), to);
        if (i) length += hypot(to[0] - from[0], to[1] - from[1]);
        from[0] = to[0], from[1] = to[1];
    }
    return length;
}

/* k g + c dg/dt by the poses of the document and central differences: what the file says of its
   cables is k = 262 N/m, c = 2e-4 N s/m, 1 um of tension as drawn; T3 is drawn in by 12 um */
static void tensions_are_those_of_the_motion(void **state) {
    (void)state;
    json_t *p = ask_file(live, fw_plan_live_preview, TENDONS, "\"options\":{\"accuracy\":0.1}");
    const json_t *motion = at(p, "motion"), *q = at(motion, "q"), *loads = at(p, "loads");
    for (size_t k = 0; k < 4; k++) {
        const json_t *eyelets = at(json_array_get(loads, k), "eyelets");
        const json_t *told = json_array_get(at(motion, "tension_N"), k);
        double draw = k == 1 || k == 2 ? 12e-6 : 0, dt = 10e-3 / 400, stretch[401];
        assert_int_equal(json_array_size(told), 401);
        for (int i = 0; i < 401; i++) {
            const json_t *row = json_array_get(q, (size_t)i);
            stretch[i] = path_of(row, eyelets) - path_of(json_array_get(q, 0), eyelets) + 1e-6 +
                         draw * fmin(i * dt / 2e-3, 1);
        }
        assert_near(item(told, 0), 262 * 1e-6 + 2e-4 * draw / 2e-3, 1e-9); /* at rest, drawing */
        for (int i = 1; i < 400; i++) {
            double rate = (stretch[i + 1] - stretch[i - 1]) / (2 * dt);
            double force = 262 * stretch[i] + 2e-4 * rate;
            if (i == 80) continue; /* the ramp ends */
            /* of some 2 mN; the differences see little of what is quicker than two rows */
            assert_near(item(told, i), fmin(force, 262 * stretch[i]) > 0 ? force : 0, 4e-6);
        }
    }
    json_decref(p);
}

static void the_picture_holds_what_is_attached(void **state) {
    (void)state;
    json_t *near = ask_file(live, fw_plan_live_preview, TENDONS, "\"options\":{\"accuracy\":0.1}");
    const double eyelet[4] = {-1050, -720, 4050, 3400}; /* the outermost, in um */
    for (int k = 0; k < 4; k++)
        assert_near(item(at(near, "scene_box_um"), k), eyelet[k], 1e-9);
    /* without the scene the device is as large as it can be */
    assert_true(item(at(near, "box_um"), 0) > -100 && item(at(near, "box_um"), 2) < 3200);
    /* one that is a metre away is not waited for: the rest stays legible */
    json_t *far = changed(TENDONS, "\"4.05 mm\"", "\"1 m\"");
    double wide = item(at(far, "scene_box_um"), 2);
    assert_true(wide > 4050 && wide < 10e3);
    for (int k = 0; k < 2; k++)
        assert_near(item(at(far, "scene_box_um"), k), eyelet[k], 1e-9);
    json_decref(near);
    json_decref(far);
    json_t *spring =
        ask_file(live, fw_plan_live_preview, "docs/gallery/leaf-four-bar/device.xml", NULL);
    const json_t *s = json_array_get(at(spring, "springs"), 0);
    assert_near(item(at(spring, "box_um"), 3), item(at(s, "on_b_um"), 1), 1e-9);
    assert_near(real_at(s, "length_um"), 1000, 1e-9);
    json_decref(spring);
}

static void electrodes_say_what_they_are(void **state) {
    (void)state;
    json_t *stage = ask_file(live, fw_plan_live_preview, "docs/gallery/comb-stage/device.xml",
                             "\"options\":{\"accuracy\":0.1}");
    assert_int_equal(json_array_size(at(stage, "loads")), 2);
    for (size_t i = 0; i < 2; i++)
        assert_true(json_is_true(at(json_array_get(at(stage, "loads"), i), "drawn")));
    json_decref(stage);
    json_t *p = ask_file(live, fw_plan_live_preview, COMBS,
                         "\"options\":{\"scene\":\"oscillate\",\"accuracy\":0.1}");
    const json_t *comb = json_array_get(at(p, "loads"), 0);
    assert_true(json_is_false(at(comb, "drawn")));
    assert_string_equal(text_at(comb, "electrodes"), "comb");
    assert_int_equal((int)real_at(comb, "fingers"), 30);
    assert_near(real_at(comb, "gap_um"), 6, 1e-9);
    assert_near(real_at(comb, "overlap_um"), 30, 1e-9);
    assert_near(real_at(comb, "length_um"), 60, 1e-9); /* not said: twice the overlap */
    const json_t *sine = json_array_get(at(at(p, "motion"), "load_factor"), 0);
    for (int i = 0; i < 401; i++)
        assert_near(item(sine, i), sin(2 * acos(-1.0) * 300 * 20e-3 * i / 400), 2e-5);
    json_decref(p);
    p = ask_file(live, fw_plan_live_preview, COMBS,
                 "\"options\":{\"scene\":\"pull-back\",\"accuracy\":0.1}");
    comb = json_array_get(at(p, "loads"), 0);
    assert_string_equal(text_at(comb, "electrodes"), "plate");
    assert_near(real_at(comb, "gap_um"), 20, 1e-9);
    json_decref(p);
}

/* what no picture shows is named, as the effect's own row calls it */
static void loads_without_a_picture_are_named(void **state) {
    (void)state;
    json_t *shaken = ask_file(live, fw_plan_live_preview, "tests/data/effects/shaken.xml",
                              "\"options\":{\"accuracy\":0.1}");
    assert_int_equal(json_array_size(at(shaken, "not_drawn")), 1);
    assert_string_equal(json_string_value(json_array_get(at(shaken, "not_drawn"), 0)),
                        "base motion");
    json_decref(shaken);
    json_t *pulled =
        ask_file(live, fw_plan_live_preview, TENDONS, "\"options\":{\"accuracy\":0.1}");
    assert_int_equal(json_array_size(at(pulled, "not_drawn")), 0);
    json_decref(pulled);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_are_those_of_the_laws),
        cmocka_unit_test(tensions_are_those_of_the_motion),
        cmocka_unit_test(the_picture_holds_what_is_attached),
        cmocka_unit_test(electrodes_say_what_they_are),
        cmocka_unit_test(loads_without_a_picture_are_named),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
