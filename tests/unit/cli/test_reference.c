/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The generated reference pages are what the tables say. FW_UPDATE=1 in the environment rewrites
   them. */
#include "base/diag.h"
#include "cli/options.h"
#include "test.h"
#include <stdlib.h>

static void same_as_committed(const fw_text *text, const char *path) {
    if (getenv("FW_UPDATE")) {
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        assert_int_equal(fwrite(text->data, 1, text->length, file), text->length);
        assert_int_equal(fclose(file), 0);
        return;
    }
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("%s is missing: run this test with FW_UPDATE=1", path);
    static char committed[1 << 18];
    size_t n = fread(committed, 1, sizeof committed, file);
    fclose(file);
    if (n != text->length || memcmp(committed, text->data, n) != 0)
        fail_msg("%s is out of date: run this test with FW_UPDATE=1 and commit it", path);
}

static void command_line_page(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_cli_reference(&text);
    assert_int_equal(fw_text_end(&text), FW_OK);
    same_as_committed(&text, FW_TEST_SOURCE_DIR "/docs/reference/command-line.md");
    fw_arena_free(arena);
}

static void diagnostics_page(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    size_t n;
    const fw_diag_entry *entry = fw_diag_table(&n);
    fw_text_add(&text, "# Diagnostics\n\nGenerated from the table of diagnostics; do not edit. "
                       "`flexwright explain FW-Dnnn` prints the same text.\n");
    for (size_t i = 0; i < n; i++)
        fw_text_printf(&text, "\n## FW-D%03d: %s\n\n%s\n", entry[i].number, entry[i].title,
                       entry[i].text);
    assert_int_equal(fw_text_end(&text), FW_OK);
    same_as_committed(&text, FW_TEST_SOURCE_DIR "/docs/reference/diagnostics.md");
    fw_arena_free(arena);
}

static void every_command_is_complete(void **state) {
    (void)state;
    size_t n;
    const fw_cli_command *command = fw_cli_command_table(&n);
    for (size_t i = 0; i < n; i++) {
        assert_non_null(command[i].run);
        assert_true(strlen(command[i].summary) > 10 && strlen(command[i].text) > 40);
        assert_memory_equal(command[i].example, "flexwright ", 11);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(command_line_page),
        cmocka_unit_test(diagnostics_page),
        cmocka_unit_test(every_command_is_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
