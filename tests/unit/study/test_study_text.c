/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is said of a study meanwhile and at its end, of results that are stated here. */
#include "study/study.h"
#include "study/study_parts.h"
#include "test.h"

/* how devices were judged is said where any was: also where most or all are inconclusive */
static void what_became_of_devices(void **state) {
    (void)state;
    static const struct {
        long run, accepted, rejected, inconclusive, failed;
        const char *says;
    } row[] = {
        {4, 1, 1, 2, 0, "4 devices: 1 accepted, 1 rejected, 2 inconclusive\n"},
        {3, 0, 0, 3, 0, "3 devices: 0 accepted, 0 rejected, 3 inconclusive\n"},
        {5, 5, 0, 0, 1,
         "6 devices: 5 accepted, 0 rejected, 0 inconclusive; 1 could not be judged (number 7: "
         "torn)\n"},
        {3, 0, 0, 0, 0, "3 devices\n"}, /* each was run, and none was judged */
    };
    const fw_device_study asked = {.kind = FW_STUDY_IS_sweep};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        fw_arena *arena = fw_arena_new(0);
        const fw_study_result result = {.run = row[i].run,
                                        .failed = row[i].failed,
                                        .accepted = row[i].accepted,
                                        .rejected = row[i].rejected,
                                        .inconclusive = row[i].inconclusive,
                                        .example_at = 7,
                                        .example_why = "torn"};
        const fw_study study = {
            .arena = arena, .asked = &asked, .device_name = "leaf", .result = &result};
        fw_text out = fw_text_new(arena);
        assert_int_equal(fw_study_text(&study, &out), FW_OK);
        const char *second = strchr(out.data, '\n');
        assert_non_null(second);
        assert_string_equal(second + 1, row[i].says);
        fw_arena_free(arena);
    }
}

typedef struct heard {
    long done, all;
    int times;
} heard;

static void hear(void *context, long done, long all, double seconds) {
    heard *h = context;
    assert_true(seconds >= 0);
    *h = (heard){done, all, h->times + 1};
}

/* a study of which only the most that it may judge is known tells it as a number below 0, in its own thread */
static void what_is_told_meanwhile(void **state) {
    (void)state;
    heard h = {0};
    fw_study_told told = {.most = 40, .thread = pthread_self()};
    fw_study study = {.options = {.progress = hear, .progress_context = &h}};
    fw_study_tell(&study);
    assert_int_equal(h.times, 0);
    study.told = &told;
    atomic_store(&told.done, 7);
    fw_study_tell(&study);
    assert_int_equal(h.times, 1);
    assert_int_equal(h.done, 7);
    assert_int_equal(h.all, -40);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_became_of_devices),
                                       cmocka_unit_test(what_is_told_meanwhile)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
