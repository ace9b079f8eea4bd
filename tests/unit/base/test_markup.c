/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "base/svg.h"

#define NB "\u00a0"

static void expect(fw_arena *arena, const char *want, const char *format, double value) {
    fw_text out = fw_text_new(arena);
    fw_markup(&out, format, value);
    assert_int_equal(fw_text_end(&out), FW_OK);
    assert_string_equal(out.data, want);
}

static void expect_unit(fw_arena *arena, const char *want, double value, const char *unit) {
    fw_text out = fw_text_new(arena);
    fw_markup(&out, "{u}", value, unit);
    assert_string_equal(out.data, want);
}

static void units_for_people(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    expect_unit(arena, "9" NB "\u00b5m", 9e-6, "m");
    expect_unit(arena, "0", 0.0, "m");
    expect_unit(arena, "\u2212150" NB "\u00b5m", -150e-6, "m");
    expect_unit(arena, "1" NB "\u00b5m", 0.99999e-6, "m"); /* not 1000 nm */
    expect_unit(arena, "999.9" NB "nm", 0.9999e-6, "m");
    expect_unit(arena, "169" NB "GPa", 169e9, "Pa");
    expect_unit(arena, "403.1" NB "\u00b5N", 4.0311e-4, "N");
    expect_unit(arena, "\u2013", (double)NAN, "s");
    expect(arena, "6.875\u00b0", "{d}", 0.12);
    expect(arena, "11.00", "{D}", 11.0 / 57.29577951308232);
    expect(arena, "10.00", "{D}", 9.99999 / 57.29577951308232);
    expect(arena, "0.9999", "{D}", 0.9999 / 57.29577951308232);
    expect(arena, "97.8" NB "%", "{p}", 0.97821);
    expect(arena, "100" NB "%", "{p}", 0.99951);
    expect(arena, "0.80" NB "%", "{p}", 0.008);
    expect(arena, "0.0326" NB "%", "{p}", 3.26e-4);
    expect(arena, "5.7\u00d710\u207b\u2075", "{e}", 5.7e-5);
    expect(arena, "1\u00d710\u00b9\u00b2", "{e}", 1e12);
    expect(arena, "45" NB "s", "{h}", 45.0);
    expect(arena, "3" NB "min 20" NB "s", "{h}", 200.0);
    expect(arena, "4" NB "h 12" NB "min", "{h}", 15151.0);
    fw_arena_free(arena);
}

static void coordinates_are_always_numbers(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    expect(arena, "0", "{c}", (double)NAN);
    expect(arena, "0", "{c}", -HUGE_VAL);
    expect(arena, "1000000", "{c}", 1e300);
    expect(arena, "-1.25", "{c}", -1.25);
    fw_arena_free(arena);
}

static void text_is_escaped(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text out = fw_text_new(arena);
    fw_markup(&out, "<b title=\"{s}\">{r} {i} {l} {x</b>", "\"<&'>", "<i/>", -3, 7L);
    assert_int_equal(fw_text_end(&out), FW_OK);
    assert_string_equal(out.data, "<b title=\"&quot;&lt;&amp;&#39;&gt;\"><i/> -3 7 {x</b>");
    fw_arena_free(arena);
}

static void unknown_directive_is_noticed(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text out = fw_text_new(arena);
    fw_markup(&out, "{q}");
    assert_true(out.failed);
    fw_arena_free(arena);
}

static void an_id_that_says_its_kind_stands_alone(void **state) {
    (void)state;
    static const struct {
        const char *kind, *id, *said;
    } row[] = {{"hinge ", "A", "hinge "},       {"hinge ", "hinge-2", ""},
               {"hinge ", "Hinge2", ""},        {"hinge ", "hinge", ""},
               {"hinge ", "hinges", "hinge "},  {"hinge ", "hi", "hinge "},
               {"hinge ", "", "hinge "},        {"hinge ", NULL, "hinge "},
               {"comb drive ", "comb-drive-1", ""}, {"comb drive ", "comb_drive.up", ""},
               {"comb drive ", "comb-1", "comb drive "}, {"comb drive ", "combs", "comb drive "}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        assert_string_equal(fw_text_kind(row[i].kind, row[i].id), row[i].said);
}

static void a_long_list_names_the_first_few(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    assert_null(fw_text_few(arena, NULL));
    assert_string_equal(fw_text_few(arena, "a"), "a");
    assert_string_equal(fw_text_few(arena, "a, b, c, d, e, f, g, h"), "a, b, c, d, e, f, g, h");
    assert_string_equal(fw_text_few(arena, "a, b, c, d, e, f, g, h, i"),
                        "a, b, c, d, e, f, g, h and 1 more");
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_for_people),
        cmocka_unit_test(coordinates_are_always_numbers),
        cmocka_unit_test(text_is_escaped),
        cmocka_unit_test(unknown_directive_is_noticed),
        cmocka_unit_test(a_long_list_names_the_first_few),
        cmocka_unit_test(an_id_that_says_its_kind_stands_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
