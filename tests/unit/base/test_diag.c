/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/diag.h"
#include "test.h"

static void printed_in_file_order_with_caret(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const char *source = "<a>\n  <b c=\"\xc3\xa4x\"/>\n</a>\n";
    assert_int_equal(fw_diag_error(&diags, 41, (fw_place){"f.xml", 2, 11}, "wrong %s", "x"),
                     FW_INPUT);
    fw_diag_warning(&diags, 40, (fw_place){"f.xml", 1, 1}, "odd");
    fw_text out = fw_text_new(arena);
    fw_diag_note(&diags, 42, (fw_place){"other.xml", 3, 1}, "elsewhere");
    fw_diags_print(&diags, &out, "f.xml", source, strlen(source), 0);
    assert_string_equal(out.data, "f.xml:1:1: warning: odd [FW-D040]\n"
                                  "     1 | <a>\n"
                                  "       | ^\n"
                                  "f.xml:2:11: error: wrong x [FW-D041]\n"
                                  "     2 |   <b c=\"\xc3\xa4x\"/>\n"
                                  "       |          ^\n"
                                  "other.xml:3:1: note: elsewhere [FW-D042]\n");
    assert_int_equal(diags.errors, 1);
    fw_arena_free(arena);
}

/* of the error that is said next, and of it where another list takes it over */
static void reasons_of_the_system_are_numbers(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena), other = fw_diags_new(arena);
    fw_diag_error(fw_diags_because(&diags, 2), 220, (fw_place){.file = "f.xml"}, "none");
    fw_diag_error(&diags, 41, (fw_place){"f.xml", 1, 1}, "wrong");
    fw_diag_warning(fw_diags_because(&diags, 2), 41, (fw_place){"f.xml", 1, 1}, "odd");
    fw_diag_error(&diags, 41, (fw_place){"f.xml", 2, 1}, "wrong");
    fw_diags_take(&other, &diags);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(diags.item[i].reason, i == 0 ? 2 : 0);
        assert_int_equal(other.item[i].reason, i == 0 ? 2 : 0);
    }
    fw_arena_free(arena);
}

static void only_the_first_hundred(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    for (int i = 0; i < 250; i++)
        fw_diag_error(&diags, 41, (fw_place){"f.xml", i + 1, 1}, "one");
    assert_int_equal(diags.count, 100);
    assert_int_equal(diags.dropped, 150);
    assert_int_equal(diags.errors, 250);
    fw_arena_free(arena);
}

/* what is only told never hides an error: the last note goes first, then the last warning */
static void errors_are_kept(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    for (int i = 0; i < 98; i++)
        fw_diag_warning(&diags, 41, (fw_place){"f.xml", i + 1, 1}, "warned");
    fw_diag_note(&diags, 42, (fw_place){"f.xml", 99, 1}, "noted");
    for (int i = 0; i < 4; i++)
        fw_diag_warning(&diags, 41, (fw_place){"f.xml", 100 + i, 1}, "warned");
    assert_int_equal(diags.dropped, 3);
    for (int i = 0; i < 3; i++)
        fw_diag_error(&diags, 43, (fw_place){"f.xml", 200 + i, 1}, "wrong");
    assert_int_equal(diags.count, 100);
    assert_int_equal(diags.dropped, 6);
    for (int i = 0; i < 97; i++) /* the note and the two last warnings are gone */
        assert_int_equal(diags.item[i].place.line, i + 1);
    for (int i = 0; i < 3; i++)
        assert_int_equal(diags.item[97 + i].place.line, 200 + i);
    fw_arena_free(arena);
}

/* a list that is asked of over and over: what a later call says is not lost behind errors of earlier ones, and of one call the
   first are kept as ever */
static void a_later_call_finds_room(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_diag_warning(&diags, 41, (fw_place){"f.xml", 1, 1}, "of the description");
    for (int i = 0; i < 120; i++) {
        fw_diags_call(&diags);
        assert_int_equal(diags.before, i < 99 ? i + 1 : 100);
        fw_diag_error(&diags, 223, (fw_place){0}, "call %d", i);
        assert_int_equal(diags.item[diags.before].number, 223);
        assert_int_equal(diags.before + 1, diags.count);
    }
    assert_int_equal(diags.count, 100);
    assert_string_equal(diags.item[0].message, "of the description");
    assert_string_equal(diags.item[1].message, "call 21");
    fw_diags_call(&diags);
    fw_diag_note(&diags, 42, (fw_place){0}, "told");
    fw_diag_error(&diags, 230, (fw_place){0}, "the budget");
    assert_int_equal(diags.before, 98);
    assert_string_equal(diags.item[98].message, "told");
    assert_string_equal(diags.item[99].message, "the budget");
    for (int i = 0; i < 300;
         i++) /* of one call the first; note and warning go before an error is lost */
        fw_diag_error(&diags, 41, (fw_place){"f.xml", i + 1, 1}, "one");
    assert_int_equal(diags.before, 0);
    assert_int_equal(diags.item[0].number, 230);
    assert_int_equal(diags.item[99].place.line, 99);
    fw_diags_put(&diags, (fw_diag){.number = 720, .severity = FW_ERROR, .message = "ready"});
    assert_string_equal(diags.item[99].message, "ready");
    assert_int_equal(diags.count, 100);
    fw_arena_free(arena);
}

/* a message that is there already is said where there is no memory at all */
static void said_without_memory(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    assert_true(fw_diags_reserve(&diags));
    fw_arena_fail_at(1, 1);
    fw_diag_error(&diags, 41, (fw_place){0}, "no room for this");
    fw_diags_put(&diags, (fw_diag){.number = 721, .severity = FW_ERROR, .message = "ready"});
    fw_arena_fail_at(0, 0);
    assert_true(diags.failed);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 721);
    fw_diags_call(&diags);
    assert_false(diags.failed); /* that call has answered so */
    fw_arena_free(arena);
}

/* a message, a file's name and a line of the file are shown as they are, but for orders to the terminal */
static void orders_are_not_shown(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    fw_text out = fw_text_new(arena);
    const char *source = "x \xc2\x9b\x1b[31m\xe2\x80\xae\xc3\xa4 y", *file = "a\nb\x1b.xml";
    fw_diag_error(&diags, 20, (fw_place){file, 1, 15}, "'%s' is\nno name%s", source, "\xe2\x82");
    assert_string_equal(
        diags.item[0].message,
        "'x \xef\xbf\xbd [31m\xef\xbf\xbd\xc3\xa4 y' is no name\xef\xbf\xbd\xef\xbf\xbd");
    fw_diags_print(&diags, &out, file, source, strlen(source), 0);
    assert_string_equal(out.data, "a b .xml:1:15: error: 'x \xef\xbf\xbd [31m\xef\xbf\xbd\xc3\xa4 "
                                  "y' is no name\xef\xbf\xbd\xef\xbf\xbd [FW-D020]\n"
                                  "     1 | x \xef\xbf\xbd [31m\xef\xbf\xbd\xc3\xa4 y\n"
                                  "       |           ^\n");
    fw_arena_free(arena);
}

static void table_is_sorted_and_complete(void **state) {
    (void)state;
    size_t n;
    const fw_diag_entry *entry = fw_diag_table(&n);
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && entry[i].number <= entry[i - 1].number)
            fail_msg("FW-D%03d is out of order or doubled", entry[i].number);
        if (strlen(entry[i].title) < 5 || strlen(entry[i].text) < 40)
            fail_msg("FW-D%03d has no long text", entry[i].number);
        assert_ptr_equal(fw_diag_find(entry[i].number), &entry[i]);
    }
    assert_null(fw_diag_find(999));
}

/* what is said once of a place is not said again by a list that is taken over; anything else is, as often as it comes */
static void once_of_a_place(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_place here = {"d.xml", 3, 4}, there = {"d.xml", 3, 5};
    fw_diags all = fw_diags_new(arena);
    for (int flow = 0; flow < 3; flow++) {
        fw_diags own = fw_diags_new(arena);
        for (int twice = 0; twice < 2; twice++) {
            if (!fw_diag_said(&own, 134, here)) fw_diag_warning(&own, 134, here, "flow %d", flow);
            if (!fw_diag_said(&own, 134, there)) fw_diag_warning(&own, 134, there, "flow %d", flow);
        }
        fw_diag_warning(&own, 201, here, "flow %d", flow);
        assert_int_equal(own.count, 3);
        fw_diags_take(&all, &own);
    }
    static const int number[] = {134, 134, 201, 201, 201}, flow[] = {0, 0, 0, 1, 2};
    assert_int_equal(all.count, 5);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(all.item[i].number, number[i]);
        assert_int_equal(all.item[i].message[5], '0' + flow[i]);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(printed_in_file_order_with_caret),
        cmocka_unit_test(reasons_of_the_system_are_numbers),
        cmocka_unit_test(only_the_first_hundred),
        cmocka_unit_test(errors_are_kept),
        cmocka_unit_test(a_later_call_finds_room),
        cmocka_unit_test(said_without_memory),
        cmocka_unit_test(orders_are_not_shown),
        cmocka_unit_test(once_of_a_place),
        cmocka_unit_test(table_is_sorted_and_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
