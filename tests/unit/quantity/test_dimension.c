/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/quantity.h"
#include "quantity/program.h"
#include "test.h"

static void dimensions_have_names(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    assert_string_equal(fw_quantity_dimension_text(arena, (fw_quantity_dimension){.m = 1}),
                        "length");
    assert_string_equal(
        fw_quantity_dimension_text(arena, (fw_quantity_dimension){2, 1, -2, 0, 0, 0, -1, 0}),
        "torsional stiffness");
    assert_string_equal(fw_quantity_dimension_text(arena, (fw_quantity_dimension){0}),
                        "pure number");
    assert_string_equal(
        fw_quantity_dimension_text(arena, (fw_quantity_dimension){1, 0, -3, 0, 0, 0, 1, 0}),
        "m s^-3 rad");
    assert_string_equal(fw_quantity_dimension_phrase(arena, (fw_quantity_dimension){.rad = 1}),
                        "an angle");
    assert_string_equal(fw_quantity_dimension_phrase(arena, (fw_quantity_dimension){.m = 1}),
                        "a length");
    fw_arena_free(arena);
}

/* the unit in SI of any dimension is read again as that dimension and as one of it, and is a word where the field has one */
static void units_in_si_are_read_again(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    assert_string_equal(fw_quantity_dimension_si(arena, (fw_quantity_dimension){1, 1, -2, 0, 0, 0, 0, 0}), "N");
    assert_string_equal(fw_quantity_dimension_si(arena, (fw_quantity_dimension){2, 1, -2, 0, 0, 0, -1, 0}), "N m/rad");
    assert_string_equal(fw_quantity_dimension_si(arena, (fw_quantity_dimension){2, 1, 0, 0, 0, 0, 0, 0}), "kg m^2");
    assert_string_equal(fw_quantity_dimension_si(arena, (fw_quantity_dimension){0}), "");
    for (int n = 0; n < 7 * 5 * 7 * 3 * 3; n++) {
        const fw_quantity_dimension d = {(int8_t)(n % 7 - 3), (int8_t)(n / 7 % 5 - 2), (int8_t)(n / 35 % 7 - 3),
                                         (int8_t)(n / 245 % 3 - 1), 0, 0, (int8_t)(n / 735 % 3 - 1), 0};
        const char *text = fw_quantity_dimension_si(arena, d);
        fw_quantity_unit unit;
        if (!text[0]) continue;
        if (!fw_quantity_unit_parse(text, strlen(text), &unit, NULL, NULL)) fail_msg("'%s' is no unit", text);
        assert_true(unit.factor == 1 && unit.offset == 0 && fw_quantity_dimension_equal(unit.dimension, d));
    }
    fw_arena_free(arena);
}

/* the unit suggested for a dimension has that dimension */
static void suggested_units_fit(void **state) {
    (void)state;
    size_t count;
    const char *const *names = fw_quantity_unit_names(&count);
    for (size_t i = 0; i < count; i++) {
        fw_quantity_unit unit, suggested;
        assert_true(fw_quantity_unit_parse(names[i], strlen(names[i]), &unit, NULL, NULL));
        const char *text = fw_quantity_dimension_unit(unit.dimension);
        if (!text) continue;
        assert_true(fw_quantity_unit_parse(text, strlen(text), &suggested, NULL, NULL));
        assert_true(fw_quantity_dimension_equal(suggested.dimension, unit.dimension));
    }
}

static void dimensions_without_memory(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_arena_fail_at(1, 1);
    const char *text =
        fw_quantity_dimension_text(arena, (fw_quantity_dimension){1, 2, 3, 4, 5, 6, 7, 0});
    const char *phrase = fw_quantity_dimension_phrase(arena, (fw_quantity_dimension){.rad = 1});
    fw_arena_fail_at(0, 0);
    assert_non_null(text);
    assert_non_null(phrase);
    fw_arena_free(arena);
}

static void statuses_go_both_ways(void **state) {
    (void)state;
    fw_quantity_value_status s;
    for (int i = FW_MEASURED; i <= FW_ASSUMED; i++) {
        assert_true(fw_quantity_value_status_parse(
            fw_quantity_value_status_text((fw_quantity_value_status)i), &s));
        assert_int_equal(s, i);
    }
    assert_false(fw_quantity_value_status_parse("guessed", &s));
    assert_false(fw_quantity_value_status_parse("", &s));
}

static void quantities_in_their_unit(void **state) {
    (void)state;
    fw_quantity q = {.value = 9e-6, .unit = "um"};
    assert_relative(fw_quantity_in_unit(&q), 9.0, 1e-15);
    q = (fw_quantity){.value = 293.15, .unit = "Cel"};
    assert_near(fw_quantity_in_unit(&q), 20.0, 1e-12);
    q = (fw_quantity){.value = 5.0, .unit = ""};
    assert_near(fw_quantity_in_unit(&q), 5.0, 0.0);
    q.unit = NULL;
    assert_near(fw_quantity_in_unit(&q), 5.0, 0.0);
}

static void other_spellings_are_understood_as_such(void **state) {
    (void)state;
    static const char *const pair[][2] = {{"\xc2\xb5m", "um"}, {"degC", "Cel"},   {"Nm", "N m"},
                                          {"sccm", "{sccm}"},  {"umm", "um"},     {"MPA", "MPa"},
                                          {"msec", "ms"},      {"Angstrom", "Ao"}};
    for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
        const char *got = fw_quantity_unit_suggestion(pair[i][0], strlen(pair[i][0]), NULL);
        assert_non_null(got);
        assert_string_equal(got, pair[i][1]);
    }
    assert_null(fw_quantity_unit_suggestion("quux-unit-of-no-kind", 20, "um"));
    assert_null(fw_quantity_unit_suggestion("", 0, "um"));
}

/* a factor of 1000 hangs on it: of equally near units the first letter decides, then the place */
static void ties_are_broken_by_prefix_and_place(void **state) {
    (void)state;
    static const char *const row[][3] = {
        /* written, unit of the place, suggested */
        {"umm", "mm", "um"}, {"mmm", "um", "mm"}, {"nmm", NULL, "nm"},   {"MMPa", "GPa", "MPa"},
        {"xm", "um", "um"},  {"xm", "mm", "mm"},  {"xPa", "GPa", "GPa"}, {"uNN", "mN", "uN"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        assert_string_equal(fw_quantity_unit_suggestion(row[i][0], strlen(row[i][0]), row[i][1]),
                            row[i][2]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dimensions_have_names), cmocka_unit_test(units_in_si_are_read_again),
        cmocka_unit_test(suggested_units_fit),
        cmocka_unit_test(dimensions_without_memory),
        cmocka_unit_test(ties_are_broken_by_prefix_and_place),
        cmocka_unit_test(statuses_go_both_ways),
        cmocka_unit_test(quantities_in_their_unit),
        cmocka_unit_test(other_spellings_are_understood_as_such),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
