/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two designs in two threads. One is cancelled, at moments from its start to its end; the other
   gives the bytes of a design that runs alone. tests/build/threads.sh runs this under
   ThreadSanitizer. */
#include "test.h"
#include <flexwright.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>

#define FILE_OF(name) FW_TEST_SOURCE_DIR "/docs/gallery/" name "/device.xml"

static const char *const cancelled_file = FILE_OF("reference-six-bar");
static const char *const other_file = FILE_OF("leaf-four-bar");

typedef struct outcome {
    int status;
    char *verdict, *masks; /* masks: certificates, with the hash of each mask's bytes */
} outcome;

static void outcome_free(outcome *o) {
    free(o->verdict);
    free(o->masks);
}

static fw_design *helped(const char *file, int jobs) {
    fw_design_options o = fw_design_options_default();
    o.jobs = jobs;
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.samples = 51;
    o.accuracy = 0.1;
    fw_design *design = fw_design_new(&o);
    if (design && fw_design_read(design, file) != FW_STATUS_OK) {
        fw_design_free(design);
        return NULL;
    }
    return design;
}

static int copy_of(fw_design *design, int document, char **copy) {
    const char *text;
    int status = fw_design_document(design, document, &text, NULL);
    if (status == FW_STATUS_OK && !(*copy = strdup(text))) status = FW_STATUS_NOMEM;
    return status;
}

static fw_design *fresh(const char *file) {
    return helped(file, 0);
}

/* no cmocka from here to the threads' end: it is not made for them */
static outcome run(fw_design *design) {
    outcome o = {.status = fw_design_judge(design)};
    if (o.status == FW_STATUS_OK) o.status = fw_design_fabricate(design);
    if (o.status == FW_STATUS_OK) o.status = copy_of(design, FW_DOCUMENT_VERDICT_JSON, &o.verdict);
    if (o.status == FW_STATUS_OK) o.status = copy_of(design, FW_DOCUMENT_MASKS_JSON, &o.masks);
    return o;
}

static bool same(const outcome *a, const outcome *b) {
    return a->status == FW_STATUS_OK && b->status == FW_STATUS_OK &&
           strcmp(a->verdict, b->verdict) == 0 && strcmp(a->masks, b->masks) == 0;
}

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct worker {
    fw_design *design;
    pthread_barrier_t *start;
    outcome out;
} worker;

static void *work(void *argument) {
    worker *w = argument;
    pthread_barrier_wait(w->start);
    w->out = run(w->design);
    return NULL;
}

/* the first design is cancelled `after_s` from the common start; a negative time: before it */
static void run_both(worker pair[2], double after_s) {
    pthread_barrier_t start;
    pthread_t thread[2];
    assert_int_equal(pthread_barrier_init(&start, NULL, 3), 0);
    if (after_s < 0) fw_design_cancel(pair[0].design);
    for (int i = 0; i < 2; i++) {
        pair[i].start = &start;
        assert_int_equal(pthread_create(&thread[i], NULL, work, &pair[i]), 0);
    }
    pthread_barrier_wait(&start);
    if (after_s >= 0) {
        struct timespec wait = {.tv_sec = (time_t)after_s};
        wait.tv_nsec = (long)(1e9 * (after_s - (double)wait.tv_sec));
        nanosleep(&wait, NULL);
        fw_design_cancel(pair[0].design);
    }
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_join(thread[i], NULL), 0);
    pthread_barrier_destroy(&start);
}

static void one_is_cancelled_and_the_other_is_not(void **state) {
    (void)state;
    const char *asked = getenv("FW_CANCEL_MOMENTS");
    const int moments = asked ? atoi(asked) : test_cases(8, 1);
    fw_design *first = fresh(cancelled_file), *second = fresh(other_file);
    assert_non_null(first);
    assert_non_null(second);
    double began = now_s();
    outcome alone = run(first);
    double lasts_s = now_s() - began;
    outcome want = run(second);
    assert_int_equal(alone.status, FW_STATUS_OK);
    assert_int_equal(want.status, FW_STATUS_OK);
    fw_design_free(first);
    fw_design_free(second);
    int cancelled = 0;
    for (int k = -1; k < moments; k++) {
        worker pair[2] = {{.design = helped(cancelled_file, 3)}, {.design = fresh(other_file)}};
        assert_non_null(pair[0].design);
        assert_non_null(pair[1].design);
        run_both(pair, (k + 0.5) * lasts_s / moments); /* the first: before it begins */
        assert_true(same(&pair[1].out, &want));
        if (pair[0].out.status == FW_STATUS_CANCELLED) {
            cancelled++;
            fw_design_cancel_clear(pair[0].design);
            outcome_free(&pair[0].out);
            pair[0].out = run(pair[0].design);
            assert_int_equal(pair[0].out.status, FW_STATUS_OK);
        } else
            assert_true(k >= 0 && same(&pair[0].out, &alone)); /* it was too late */
        for (int i = 0; i < 2; i++) {
            outcome_free(&pair[i].out);
            fw_design_free(pair[i].design);
        }
    }
    assert_true(cancelled > 0); /* at least the one that was told so before it began */
    outcome_free(&alone);
    outcome_free(&want);
}

/* flows, and devices that they may make, judged by threads at once: the bytes are those of one thread */
static void threads_that_help_change_no_byte(void **state) {
    (void)state;
    static const char *const file[] = {FILE_OF("free-form-gripper"), FILE_OF("reference-six-bar"),
                                       FILE_OF("comb-stage")};
    for (int f = 0; f < test_cases(3, 2); f++) {
        outcome want;
        for (int jobs = 1; jobs < 5; jobs += 3) {
            fw_design *design = helped(file[f], jobs);
            assert_non_null(design);
            outcome got = run(design);
            assert_int_equal(got.status, FW_STATUS_OK);
            if (jobs == 1)
                want = got;
            else
                assert_true(same(&got, &want)), outcome_free(&got);
            fw_design_free(design);
        }
        outcome_free(&want);
    }
    fw_design_options o = fw_design_options_default();
    o.jobs = 4;
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.effects = "fricton"; /* what a thread has to say is there when it has ended */
    fw_design *unknown = fw_design_new(&o);
    assert_int_equal(fw_design_read(unknown, file[0]), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(unknown), FW_STATUS_USAGE);
    size_t said = 0;
    for (size_t i = 0; i < fw_design_diagnostics(unknown); i++) /* beside notes on materials */
        said += strstr(fw_design_diagnostic(unknown, i)->message, "did you mean 'friction'") != NULL;
    assert_int_equal(said, 1);
    fw_design_free(unknown);
    o.effects = NULL, o.jobs = 257;
    fw_design *wrong = fw_design_new(&o);
    assert_int_equal(fw_design_read(wrong, file[0]), FW_STATUS_USAGE);
    fw_design_free(wrong);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_is_cancelled_and_the_other_is_not),
                                       cmocka_unit_test(threads_that_help_change_no_byte)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
