/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/quantity.h"
#include "test.h"

static void names_in_order_once(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const struct {
        const char *text, *want;
    } row[] = {
        {"2*b + a/b", "b a "},
        {"5 um/a + 3 m/s", "a "},
        {"sin(arc)*pi", "arc "},
        {"12", ""},
        {"min(x1, x2, x3, x4, x5)", "x1 x2 x3 x4 x5 "},
        {"5 umm + a", ""},
        {"", ""},
        {"um*a", "a "},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        const char *const *names;
        size_t count;
        char got[64] = "";
        assert_int_equal(
            fw_quantity_expression_names(arena, row[i].text, strlen(row[i].text), &names, &count),
            FW_OK);
        for (size_t k = 0; k < count; k++) {
            strcat(got, names[k]);
            strcat(got, " ");
        }
        assert_string_equal(got, row[i].want);
    }
    fw_arena_free(arena);
}

static void reserved_names(void **state) {
    (void)state;
    assert_true(fw_quantity_expression_reserved("um"));
    assert_true(fw_quantity_expression_reserved("h"));
    assert_true(fw_quantity_expression_reserved("sqrt"));
    assert_true(fw_quantity_expression_reserved("pi"));
    assert_false(fw_quantity_expression_reserved("t"));
    assert_false(fw_quantity_expression_reserved("width"));
}

static void use_of_a_name(void **state) {
    (void)state;
    static const char *const lost[] = {"arc", "w"};
    assert_true(fw_quantity_expression_uses("2*arc", 5, lost, 2));
    assert_true(fw_quantity_expression_uses("(w)", 3, lost, 2));
    assert_false(fw_quantity_expression_uses("2*arcs + ww", 11, lost, 2));
    assert_false(fw_quantity_expression_uses("2*arc", 5, lost, 0));
}

static void unit_as_written(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *unit;
    fw_quantity_dimension length = {.m = 1};
    fw_quantity_expression_unit(arena, "2*a + 5 um", 10, length, &unit);
    assert_string_equal(unit, "um");
    fw_quantity_expression_unit(arena, "3 s * 2 mm/s + 5 nm", 19, length, &unit);
    assert_string_equal(unit, "nm");
    fw_quantity_expression_unit(arena, "2*a", 3, length, &unit);
    assert_string_equal(unit, "");
    fw_arena_free(arena);
}

static void memory_runs_out(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *const *names;
    const char *unit;
    size_t count;
    for (long n = 1; n < 10; n++) {
        fw_arena_fail_at(n, 1);
        fw_status s = fw_quantity_expression_names(arena, "a*b*c*d*e", 9, &names, &count);
        long used = fw_arena_count();
        fw_arena_fail_at(0, 0);
        assert_int_equal(s, used >= n ? FW_NOMEM : FW_OK);
    }
    fw_arena_fail_at(1, 1);
    fw_status s =
        fw_quantity_expression_unit(arena, "5 um", 4, (fw_quantity_dimension){.m = 1}, &unit);
    fw_arena_fail_at(0, 0);
    assert_int_equal(s, FW_NOMEM);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_in_order_once), cmocka_unit_test(reserved_names),
        cmocka_unit_test(use_of_a_name),       cmocka_unit_test(unit_as_written),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
