/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the server keeps on the disk: the page that a browser opens first, and which logs beside the file a job may write. */
#include "serve/jobs.h"
#include "test.h"
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static char *content(fw_arena *arena, const char *path) {
    FILE *file = fopen(path, "r");
    if (!file) return NULL;
    char *text = fw_arena_array(arena, char, 4096);
    size_t n = fread(text, 1, 4095, file);
    text[n] = '\0';
    fclose(file);
    return text;
}

static void a_page_leads_to_the_session(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_serve_scratch *scratch;
    assert_int_equal(fw_serve_scratch_open(arena, &diags, &scratch), FW_OK);
    const char *path = fw_serve_scratch_page(arena, scratch, "http://127.0.0.1:1234/s/abc");
    assert_non_null(path);
    assert_string_equal(content(arena, path), "<!doctype html><meta charset=\"utf-8\"><title>Flexwright</title><meta http-equiv=\"refresh\" "
                                              "content=\"0;url=http://127.0.0.1:1234/s/abc\">\n");
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 0777, 0600); /* its address is a secret */
    assert_null(fw_serve_scratch_page(arena, scratch, "http://127.0.0.1:1234/s/abc"));
    fw_serve_scratch_drop_page(scratch);
    assert_int_not_equal(stat(path, &info), 0);
    int made = fw_serve_scratch_make(scratch, "job-1");
    assert_true(made >= 0);
    close(made);
    assert_int_equal(fw_serve_scratch_make(scratch, "job-1"), -1);
    fw_serve_scratch_remove(scratch, "job-1");
    assert_int_not_equal(stat(fw_serve_scratch_path(arena, scratch, "job-1"), &info), 0);
    const char *root = fw_serve_scratch_path(arena, scratch, "");
    fw_serve_scratch_close(scratch);
    assert_int_not_equal(stat(root, &info), 0);
    fw_arena_free(arena);
}

static void logs_that_may_be_written(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    char place[] = "fw-unit-beside-XXXXXX";
    assert_non_null(mkdtemp(place));
    const char *notes = fw_arena_printf(arena, "%s/notes.log", place);
    FILE *file = fopen(notes, "w");
    assert_non_null(file);
    assert_true(fputs("no log of ours\n", file) >= 0);
    assert_int_equal(fclose(file), 0);
    const char *of_a_lot[] = {"lot 1.log"};
    const fw_serve_beside beside = {.directory = place, .log = of_a_lot, .nlog = 1};
    static const char *const may[] = {"lot 1.log", "lot-2.log", "A_b-9.log", "l.log", "123456789012345678901234567890123456789012345678901234567890.log"};
    static const char *const not[] = {"notes.log", ".log", "-a.log", "a.txt", "a.logs", "a", "a.b.log", "../a.log", "a/b.log", "lot 2.log", "",
                                      "1234567890123456789012345678901234567890123456789012345678901.log", "a.log\n"};
    for (size_t i = 0; i < sizeof may / sizeof *may; i++)
        if (!fw_serve_beside_is_log(&beside, may[i])) fail_msg("'%s' is no log", may[i]);
    for (size_t i = 0; i < sizeof not / sizeof *not; i++)
        if (fw_serve_beside_is_log(&beside, not[i])) fail_msg("'%s' is a log", not[i]);
    const fw_serve_beside nowhere = {.directory = NULL};
    assert_false(fw_serve_beside_is_log(&nowhere, "lot-2.log"));
    assert_int_equal(unlink(notes), 0);
    assert_int_equal(rmdir(place), 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_page_leads_to_the_session), cmocka_unit_test(logs_that_may_be_written)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
