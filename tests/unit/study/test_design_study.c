/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fw_design_study of the public library: results, wrong use, being told, being stopped. */
#include "test.h"
#include <flexwright.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char form[] =
    "<study xmlns=\"urn:flexwright:study:1\" name=\"s\" kind=\"sweep\" as=\"drawn\" "
    "device=\"" FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml\">"
    "<vary what=\"arc\" from=\"200 deg\" to=\"260 deg\" steps=\"3\"/>"
    "<respond name=\"U\" value=\"governing.utilisation\"/></study>";

static char folder[32], file[64], out[64];

static int set_up(void **state) {
    (void)state;
    strcpy(folder, "fw-design-study-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(file, sizeof file, "%s/study.xml", folder);
    snprintf(out, sizeof out, "%s/out", folder);
    FILE *f = fopen(file, "wb");
    assert_non_null(f);
    fputs(form, f);
    return fclose(f);
}

static int tear_down(void **state) {
    static const char *const left[] = {"out/pictures/U-arc.svg",
                                       "out/pictures",
                                       "out/study.sqlite",
                                       "out/study.csv",
                                       "out/study.json",
                                       "out/study.html",
                                       "out/study.sqlite-wal",
                                       "out/study.sqlite-shm",
                                       "out",
                                       "study.xml"};
    char path[128];
    (void)state;
    for (size_t i = 0; i < sizeof left / sizeof left[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, left[i]);
        remove(path);
    }
    return rmdir(folder);
}

static fw_design *begin(void) {
    fw_design_options options = fw_design_options_default();
    options.data_directory = FW_TEST_SOURCE_DIR;
    options.flow = "al-masked-rie";
    return fw_design_new(&options);
}

typedef struct heard {
    fw_design *design;
    int told, stop_at;
    double done, of;
} heard;

static int hear(void *context, const char *what, double done, double of, const char *unit) {
    heard *h = context;
    assert_string_equal(what, "judging devices");
    assert_string_equal(unit, "devices");
    h->told++, h->done = done, h->of = of;
    return h->stop_at > 0 && done >= h->stop_at;
}

static void a_study_is_run(void **state) {
    const char *json;
    size_t n;
    (void)state;
    fw_design *d = begin();
    assert_non_null(d);
    heard h = {.design = d};
    assert_int_equal(fw_design_progress(d, hear, &h), FW_STATUS_OK);
    const fw_study_settings settings = {.size = sizeof settings, .directory = out, .jobs = 2};
    assert_int_equal(fw_design_study(d, file, &settings, &json, &n), FW_STATUS_OK);
    assert_non_null(strstr(json, "\"schema\": \"flexwright.study/1\""));
    assert_int_equal(strlen(json), n);
    assert_true(h.told >= 3 && h.of == 3);
    fw_design_free(d);
}

static void wrong_use_is_refused(void **state) {
    const char *json = "";
    size_t n = 1;
    (void)state;
    fw_design *d = begin();
    const fw_study_settings none = {.size = sizeof none},
                            good = {.size = sizeof good, .directory = out},
                            jobs = {.size = sizeof jobs, .directory = out, .jobs = 1000},
                            shard = {.size = sizeof shard,
                                     .directory = out,
                                     .shard = 3,
                                     .shards = 2},
                            old = {.directory = out};
    assert_int_equal(fw_design_study(NULL, file, &good, &json, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_study(d, NULL, &good, &json, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_study(d, file, NULL, &json, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_study(d, file, &none, &json, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_study(d, file, &jobs, &json, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_study(d, file, &shard, &json, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_study(d, file, &old, &json, &n), FW_STATUS_USAGE);
    assert_null(json);
    assert_int_equal(n, 0);
    assert_int_equal(fw_design_study(d, "fw-not-there.xml", &good, &json, &n), FW_STATUS_IO);
    assert_true(fw_design_diagnostics(d) > 0);
    fw_design_free(d);
}

static void it_is_stopped_and_goes_on(void **state) {
    const char *json;
    (void)state;
    fw_design *d = begin();
    heard h = {.design = d, .stop_at = 1};
    assert_int_equal(fw_design_progress(d, hear, &h), FW_STATUS_OK);
    fw_study_settings settings = {.size = sizeof settings, .directory = out, .jobs = 1};
    assert_int_equal(fw_design_study(d, file, &settings, &json, NULL), FW_STATUS_CANCELLED);
    assert_null(json);
    fw_design_cancel_clear(d);
    fw_design_progress(d, NULL, NULL);
    settings.resume = 1;
    assert_int_equal(fw_design_study(d, file, &settings, &json, NULL), FW_STATUS_OK);
    assert_non_null(strstr(json, "\"run\": 3"));
    fw_design_free(d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_study_is_run, set_up, tear_down),
        cmocka_unit_test_setup_teardown(wrong_use_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(it_is_stopped_and_goes_on, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
