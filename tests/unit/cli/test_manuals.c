/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Manual pages and completions have every command and option of the tables; that shells take them is tried in
   tests/install/test_install.py. */
#include "cli/cli.h"
#include "test.h"

static char *text_of(fw_arena *arena, fw_text *text) {
    assert_int_equal(fw_text_end(text), FW_OK);
    char *copy = fw_arena_strdup(arena, text->data);
    assert_non_null(copy);
    return copy;
}

/* "no-progress" as roff has it */
static const char *roff(fw_arena *arena, const char *name) {
    fw_text out = fw_text_new(arena);
    for (; *name; name++)
        fw_text_printf(&out, "%s%c", *name == '-' ? "\\" : "", *name);
    return text_of(arena, &out);
}

static void pages(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_cli_manual(NULL, &text);
    const char *program = text_of(arena, &text);
    size_t n, count;
    const fw_cli_command *command = fw_cli_command_table(&n);
    const fw_cli_option_row *row = fw_cli_option_rows(&count);
    for (size_t i = 0; i < n; i++) {
        assert_non_null(strstr(program, command[i].name));
        fw_text own = fw_text_new(arena);
        fw_cli_manual(&command[i], &own);
        const char *page = text_of(arena, &own);
        assert_non_null(strstr(page, "\n.SH EXIT STATUS\n"));
        for (size_t k = 0; k < count; k++)
            if (row[k].group & command[i].options)
                assert_non_null(strstr(
                    page, fw_arena_printf(arena, "\\fB\\-\\-%s\\fR", roff(arena, row[k].name))));
        for (const char *line = page; line; line = strchr(line + 1, '\n'))
            assert_true(line[1] != '\''); /* it would be a request */
    }
    fw_arena_free(arena);
}

static void completions(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const fw_cli_shell shell[] = {FW_SHELL_BASH, FW_SHELL_ZSH, FW_SHELL_FISH};
    size_t n, count;
    const fw_cli_command *command = fw_cli_command_table(&n);
    const fw_cli_option_row *row = fw_cli_option_rows(&count);
    for (size_t s = 0; s < 3; s++) {
        fw_text text = fw_text_new(arena);
        fw_cli_completion(shell[s], &text);
        const char *script = text_of(arena, &text);
        for (size_t i = 0; i < n; i++)
            assert_non_null(strstr(script, command[i].name));
        for (size_t k = 0; k < count; k++) {
            fw_cli_value kind;
            const char *values = fw_cli_option_values(&row[k], &kind);
            assert_non_null(strstr(script, row[k].name));
            if (values) assert_non_null(strstr(script, values));
            assert_int_equal(kind == FW_VALUE_WORDS, values != NULL);
        }
    }
    fw_arena_free(arena);
}

/* fish asks for a value behind those options that take one, and only there */
static void fish_asks_for_values(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_cli_completion(FW_SHELL_FISH, &text);
    const char *script = text_of(arena, &text);
    size_t count;
    const fw_cli_option_row *row = fw_cli_option_rows(&count);
    for (size_t k = 0; k < count; k++) {
        const char *name = fw_arena_printf(arena, " -l %s ", row[k].name);
        int lines = 0;
        for (const char *at = script; (at = strstr(at, name)) != NULL; at++, lines++) {
            const char *told = strstr(at, " -d '");
            assert_non_null(told);
            const char *words = fw_arena_printf(arena, "%.*s", (int)(told - at), at);
            const bool asks = strstr(words, " -x") || strstr(words, " -r");
            if (asks != (row[k].argument != NULL)) fail_msg("--%s: '%s'", row[k].name, words);
            if (!row[k].letter) assert_null(strstr(words, " -s "));
        }
        assert_true(lines > 0);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pages), cmocka_unit_test(completions), cmocka_unit_test(fish_asks_for_values)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
