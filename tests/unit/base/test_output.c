/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "test.h"
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

typedef struct room {
    char path[64];
    fw_arena *arena;
    fw_diags diags;
} room;

static int enter(void **state) {
    static room r;
    strcpy(r.path, "fw-output-XXXXXX");
    if (!mkdtemp(r.path)) return -1;
    r.arena = fw_arena_new(0);
    r.diags = fw_diags_new(r.arena);
    *state = &r;
    return 0;
}

static int leave(void **state) {
    room *r = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", r->path);
    fw_arena_free(r->arena);
    return system(command);
}

static const char *below(room *r, const char *name) {
    return fw_arena_printf(r->arena, "%s/%s", r->path, name);
}

static fw_status plan(room *r, const char *to, const char *content) {
    fw_output *output;
    FW_TRY(fw_output_open(r->arena, below(r, to), &r->diags, &output));
    FW_TRY(fw_output_write(output, "deep/er/a.txt", content, strlen(content)));
    size_t count;
    const fw_output_file *file = fw_output_files(output, &count);
    const char *manifest =
        fw_arena_printf(r->arena, "{\"outputs\":[{\"name\":\"%s\",\"sha256\":\"%s\"}]}",
                        file[0].name, file[0].sha256);
    FW_TRY(fw_output_write(output, "manifest.json", manifest, strlen(manifest)));
    return fw_output_commit(output);
}

/* notes beside the results, and a result that somebody edited, both survive */
static void what_people_add_is_kept(void **state) {
    room *r = *state;
    assert_int_equal(plan(r, "out", "one"), FW_OK);
    assert_int_equal(
        system(fw_arena_printf(r->arena, "echo note > %s/out/deep/notes.txt", r->path)), 0);
    assert_int_equal(plan(r, "out", "two"), FW_IO);
    assert_int_equal(r->diags.item[0].number, 223);
    assert_non_null(strstr(r->diags.item[0].place.file, "out/deep/notes.txt"));
    assert_int_equal(system(fw_arena_printf(r->arena,
                                            "grep -q one %s/out/deep/er/a.txt && rm "
                                            "%s/out/deep/notes.txt && echo 1 >> "
                                            "%s/out/deep/er/a.txt",
                                            r->path, r->path, r->path)),
                     0);
    assert_int_equal(plan(r, "out", "two"), FW_IO);
    assert_non_null(strstr(r->diags.item[1].message, "was changed"));
    assert_int_equal(system(fw_arena_printf(r->arena, "ln -s out %s/link", r->path)), 0);
    assert_int_equal(plan(r, "link", "two"), FW_IO);
    assert_non_null(strstr(r->diags.item[2].message, "symbolic link"));
}

static void whole_and_replaced_whole(void **state) {
    room *r = *state;
    char *text;
    size_t n;
    assert_int_equal(plan(r, "x/y/out", "one"), FW_OK);
    assert_int_equal(plan(r, "x/y/out/", "two"), FW_OK); /* a slash at the end means the same */
    assert_int_equal(
        fw_input_read(r->arena, below(r, "x/y/out/deep/er/a.txt"), 100, &r->diags, &text, &n),
        FW_OK);
    assert_string_equal(text, "two");
    assert_int_equal(system(fw_arena_printf(r->arena, "test $(ls -a %s/x/y | wc -l) = 3", r->path)),
                     0); /* . .. out: nothing left behind */
}

static void aborted_leaves_nothing_and_keeps_the_old(void **state) {
    room *r = *state;
    assert_int_equal(plan(r, "out", "old"), FW_OK);
    fw_output *output;
    assert_int_equal(fw_output_open(r->arena, below(r, "out"), &r->diags, &output), FW_OK);
    assert_int_equal(fw_output_write(output, "deep/er/a.txt", "new", 3), FW_OK);
    fw_output_abort(output);
    fw_output_abort(output);
    fw_output_abort(NULL);
    assert_int_equal(system(fw_arena_printf(
                         r->arena, "grep -q old %s/out/deep/er/a.txt && test $(ls %s | wc -l) = 1",
                         r->path, r->path)),
                     0);
}

static void foreign_directories_are_refused(void **state) {
    room *r = *state;
    assert_int_equal(
        system(fw_arena_printf(r->arena, "mkdir %s/mine && echo thesis > %s/mine/thesis.tex",
                               r->path, r->path)),
        0);
    assert_int_equal(plan(r, "mine", "x"), FW_IO);
    assert_int_equal(r->diags.item[0].number, 223);
    assert_int_equal(
        system(fw_arena_printf(r->arena, "grep -q thesis %s/mine/thesis.tex", r->path)), 0);
    assert_int_equal(system(fw_arena_printf(r->arena, "mkdir %s/empty", r->path)), 0);
    assert_int_equal(plan(r, "empty", "x"), FW_OK);
}

static void leftovers_of_the_dead_are_removed(void **state) {
    room *r = *state; /* process numbers end at 2^22 */
    assert_int_equal(
        system(fw_arena_printf(r->arena, "mkdir -p %s/out.tmp-99999999/masks %s/out.tmp-1/masks",
                               r->path, r->path)),
        0);
    assert_int_equal(plan(r, "out", "x"), FW_OK);
    assert_int_not_equal(access(below(r, "out.tmp-99999999"), F_OK), 0);
    assert_int_equal(access(below(r, "out.tmp-1"), F_OK), 0); /* init is alive */
}

static void input_says_what_is_wrong(void **state) {
    room *r = *state;
    char *text;
    size_t n;
    assert_int_equal(fw_input_read(r->arena, below(r, "none"), 10, &r->diags, &text, &n), FW_IO);
    assert_int_equal(fw_input_read(r->arena, r->path, 10, &r->diags, &text, &n), FW_IO);
    assert_int_equal(fw_output_single(r->arena, below(r, "eleven"), "12345678901", 11, &r->diags),
                     FW_OK);
    assert_int_equal(fw_input_read(r->arena, below(r, "eleven"), 10, &r->diags, &text, &n),
                     FW_INPUT);
    assert_int_equal(r->diags.item[0].number, 220);
    assert_int_equal(r->diags.item[2].number, 221);
    assert_int_equal(fw_output_single(r->arena, "/dev/full", "x", 1, &r->diags), FW_IO);
}

/* none of them is waited for: the test would not end */
static void what_is_no_file_is_refused(void **state) {
    room *r = *state;
    static const char *const what[] = {"pipe", "socket", "device", "directory"};
    assert_int_equal(mkfifo(below(r, "pipe"), 0600), 0);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s/socket", r->path);
    int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_int_equal(bind(fd, (struct sockaddr *)&address, sizeof address), 0);
    assert_int_equal(symlink("/dev/zero", below(r, "device")), 0);
    assert_int_equal(mkdir(below(r, "directory"), 0700), 0);
    for (size_t i = 0; i < sizeof what / sizeof what[0]; i++) {
        char *text;
        size_t n;
        const char *path = below(r, what[i]);
        r->diags.count = 0;
        assert_int_equal(fw_input_read(r->arena, path, 10, &r->diags, &text, &n), FW_IO);
        assert_int_equal(r->diags.item[0].number, 220);
        assert_non_null(strstr(r->diags.item[0].message, what[i]));
        fw_append file;
        assert_int_equal(fw_append_open(r->arena, path, 10, &r->diags, &file), FW_IO);
    }
    close(fd);
}

/* the last one's place is taken by a directory: the first is as it was, and nothing else is there */
static void members_are_all_or_none(void **state) {
    room *r = *state;
    const fw_output_member old[] = {{"a", "old", 3}};
    const fw_output_member three[] = {{"a", "new", 3}, {"b", "new", 3}, {"c", "new", 3}};
    assert_int_equal(fw_output_members(r->arena, r->path, old, 1, &r->diags), FW_OK);
    assert_int_equal(mkdir(below(r, "c"), 0700), 0);
    assert_int_equal(fw_output_members(r->arena, r->path, three, 3, &r->diags), FW_IO);
    assert_int_equal(
        system(fw_arena_printf(
            r->arena, "cd %s && test $(cat a) = old && test $(ls | tr -d '\\n') = ac", r->path)),
        0);
    assert_int_equal(rmdir(below(r, "c")), 0);
    assert_int_equal(fw_output_members(r->arena, r->path, three, 3, &r->diags), FW_OK);
    assert_int_equal(
        system(fw_arena_printf(
            r->arena, "cd %s && test $(cat a b c) = newnewnew && test $(ls | wc -l) = 3", r->path)),
        0);
}

static void what_was_added_is_taken_back(void **state) {
    room *r = *state;
    fw_append file;
    assert_int_equal(fw_append_open(r->arena, below(r, "log"), 100, &r->diags, &file), FW_OK);
    assert_int_equal(fw_append_text(&file, "one\n", 4), FW_OK);
    assert_int_equal(fw_append_text(&file, "two\n", 4), FW_OK);
    fw_append_take_back(&file, 4);
    fw_append_close(&file);
    assert_int_equal(system(fw_arena_printf(r->arena, "test $(cat %s/log) = one", r->path)), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(whole_and_replaced_whole, enter, leave),
        cmocka_unit_test_setup_teardown(aborted_leaves_nothing_and_keeps_the_old, enter, leave),
        cmocka_unit_test_setup_teardown(foreign_directories_are_refused, enter, leave),
        cmocka_unit_test_setup_teardown(what_people_add_is_kept, enter, leave),
        cmocka_unit_test_setup_teardown(leftovers_of_the_dead_are_removed, enter, leave),
        cmocka_unit_test_setup_teardown(input_says_what_is_wrong, enter, leave),
        cmocka_unit_test_setup_teardown(what_is_no_file_is_refused, enter, leave),
        cmocka_unit_test_setup_teardown(members_are_all_or_none, enter, leave),
        cmocka_unit_test_setup_teardown(what_was_added_is_taken_back, enter, leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
