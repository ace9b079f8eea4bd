/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The writer of JSON: commas, escapes, lines, what is no number and what is no UTF-8, wrong nesting;
   random documents in every style are those of another library, byte by byte. */
#include "base/json.h"
#include "test.h"
#include <jansson.h>
#include <math.h>
#include <string.h>

static void commas_are_written_where_they_are_due(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_json json = fw_json_new(&t, FW_JSON_COMPACT);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "a", "x,[{\"\n");
    fw_json_list(&json, "list");
    fw_json_whole(&json, NULL, -7);
    fw_json_number(&json, NULL, 0.1, 3);
    fw_json_line(&json, 0);
    fw_json_object(&json, NULL);
    fw_json_end(&json);
    fw_json_fixed(&json, NULL, 2.50, 3);
    fw_json_end(&json);
    fw_json_truth(&json, "yes", true);
    fw_json_line(&json, 0);
    fw_json_null(&json, "no");
    fw_json_end(&json);
    assert_int_equal(fw_json_finish(&json, "\n"), FW_OK);
    assert_string_equal(t.data,
                        "{\"a\":\"x,[{\\\"\\u000a\",\"list\":[-7,0.1,\n{},2.5],\"yes\":true,\n"
                        "\"no\":null}\n");
    fw_arena_free(arena);
}

static void write_all(fw_json *json) {
    fw_json_object(json, NULL);
    fw_json_text(json, "a", "x");
    fw_json_list(json, "b");
    fw_json_object(json, NULL);
    fw_json_real(json, "a", 1.5);
    fw_json_end(json);
    fw_json_whole(json, NULL, 3);
    fw_json_end(json);
    fw_json_number(json, "c", 0.1, 3);
    fw_text_add(fw_json_value(json, "d"), "[7]");
    fw_json_textf(json, "e", "%d", 8);
    fw_json_object(json, "f");
    fw_json_null(json, "a");
    fw_json_truth(json, "b", true);
    fw_json_fixed(json, "c", 2.5, 1);
    fw_json_list(json, "d");
    fw_json_whole(json, NULL, 1);
    fw_json_object(json, NULL);
    fw_json_text(json, "e", "y");
    fw_json_whole(json, "c", 4);
    fw_json_object(json, "a");
    fw_json_whole(json, "b", 5);
    fw_json_end(json);
    fw_json_end(json);
    fw_json_end(json);
    fw_json_text(json, "e", "z");
    fw_json_end(json);
    fw_json_end(json);
}

/* of what a member holds: all texts, and of the rest what one of the keys names */
static void keep_inner(json_t *node, const char *const *inner) {
    const char *key;
    json_t *value;
    void *next;
    size_t i;
    json_object_foreach_safe(node, next, key, value) {
        bool keep = json_is_string(value);
        for (int k = 0; inner[k]; k++)
            keep = keep || strcmp(inner[k], key) == 0;
        if (keep)
            keep_inner(value, inner);
        else
            json_object_del(node, key);
    }
    json_array_foreach(node, i, value)
        keep_inner(value, inner);
}

/* what is left out leaves no trace: every choice of members is what another library makes of all of them */
static void members_that_nobody_wants_are_left_out(void **state) {
    (void)state;
    static const char *const name[] = {"a", "b", "c", "d", "e", "f"};
    fw_arena *arena = fw_arena_new(0);
    fw_text all = fw_text_new(arena);
    fw_json json = fw_json_new(&all, FW_JSON_INDENTED);
    write_all(&json);
    assert_int_equal(fw_json_finish(&json, ""), FW_OK);
    for (int chosen = 0; chosen < 64; chosen++) {
        const char *wanted[8] = {NULL};
        json_t *expected = json_loadb(all.data, all.length, 0, NULL);
        for (int k = 0, n = 0; k < 6; k++) {
            if (chosen >> k & 1)
                wanted[n++] = name[k];
            else
                json_object_del(expected, name[k]);
        }
        fw_text some = fw_text_new(arena);
        json = fw_json_new(&some, FW_JSON_INDENTED);
        fw_json_only(&json, (fw_json_wanted){wanted, NULL});
        write_all(&json);
        assert_int_equal(fw_json_finish(&json, ""), FW_OK);
        json_t *read = json_loadb(some.data, some.length, 0, NULL);
        assert_true(read && json_equal(read, expected));
        for (int among = 0; among < 16; among++) {
            const char *inner[5] = {NULL};
            for (int k = 0, n = 0; k < 4; k++)
                if (among >> k & 1) inner[n++] = name[k];
            json_t *rest = json_deep_copy(expected), *value, *less;
            const char *key;
            json_object_foreach(rest, key, value)
                keep_inner(value, strcmp(key, "d") == 0 ? name : inner); /* given as it is */
            some = fw_text_new(arena);
            json = fw_json_new(&some, FW_JSON_INDENTED);
            fw_json_only(&json, (fw_json_wanted){wanted, inner});
            write_all(&json);
            assert_int_equal(fw_json_finish(&json, ""), FW_OK);
            less = json_loadb(some.data, some.length, 0, NULL);
            assert_true(less && json_equal(less, rest));
            json_decref(less), json_decref(rest);
        }
        json_decref(read), json_decref(expected);
    }
    fw_arena_free(arena);
}

static void lines_are_broken_where_they_are_asked_for(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_json json = fw_json_new(&t, FW_JSON_SPACED);
    fw_json_object(&json, NULL);
    fw_json_line(&json, 2);
    fw_json_textf(&json, "gds", "%d/%d", 3, 0);
    fw_json_text(&json, "note", "a\tb");
    fw_json_line(&json, 2);
    fw_json_list(&json, "notes");
    fw_json_line(&json, 40);
    fw_text_add(fw_json_value(&json, NULL), "{\"given\": 1}");
    fw_json_end_line(&json, 2);
    fw_json_end_line(&json, 0);
    assert_int_equal(fw_json_finish(&json, ""), FW_OK);
    assert_string_equal(t.data, "{\n  \"gds\": \"3/0\", \"note\": \"a\\tb\",\n  \"notes\": [\n"
                                "                                        {\"given\": 1}\n  ]\n}");
    fw_arena_free(arena);
}

static void numbers_that_are_none_are_null(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_json json = fw_json_new(&t, FW_JSON_COMPACT);
    fw_json_list(&json, NULL);
    fw_json_number(&json, NULL, (double)NAN, 6);
    fw_json_number(&json, NULL, -(double)INFINITY, 6);
    fw_json_fixed(&json, NULL, (double)INFINITY, 6);
    fw_json_real(&json, NULL, (double)NAN);
    fw_json_number(&json, NULL, -0.0, 6);
    fw_json_real(&json, NULL, -0.0);
    fw_json_text(&json, NULL, NULL);
    fw_json_end(&json);
    assert_int_equal(fw_json_finish(&json, ""), FW_OK);
    assert_string_equal(t.data, "[null,null,null,null,0,0.0,null]");
    fw_arena_free(arena);
}

static void what_is_no_utf8_is_marked(void **state) {
    (void)state;
    /* whole; cut in two; overlong; a surrogate; beyond U+10FFFF; a lone second byte */
    static const char *const given[] = {"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80",
                                        "a\xe2\x82",
                                        "\xc0\xaf",
                                        "\xed\xa0\x80",
                                        "\xf4\x90\x80\x80",
                                        "\x80z"};
    static const char *const wanted[] = {
        "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80", "a??", "??", "???", "????", "?z"};
    fw_arena *arena = fw_arena_new(0);
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        fw_text t = fw_text_new(arena);
        fw_json json = fw_json_new(&t, FW_JSON_COMPACT);
        fw_json_text(&json, NULL, given[i]);
        json_t *read = json_loads(t.data, JSON_DECODE_ANY, NULL);
        assert_non_null(read);
        assert_string_equal(json_string_value(read), wanted[i]);
        assert_int_equal(fw_json_is_text(given[i], strlen(given[i])), i == 0);
        json_decref(read);
    }
    assert_false(fw_json_is_text("a\0b", 3));
    fw_arena_free(arena);
}

/* every way to nest wrongly is an internal error at the end, and no crash before */
static void wrong_nesting_is_told(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int way = 0; way < 7; way++) {
        fw_text t = fw_text_new(arena);
        fw_json json = fw_json_new(&t, FW_JSON_INDENTED);
        if (way != 4) fw_json_object(&json, NULL);
        if (way == 0) fw_json_null(&json, NULL);
        if (way == 1) fw_json_list(&json, "open");
        if (way == 2) fw_json_end(&json);
        if (way == 3)
            for (int i = 0; i < 2 * FW_JSON_DEPTH; i++)
                fw_json_object(&json, "deep");
        if (way == 5) fw_json_line(&json, 0);
        for (int i = 0; way == 3 && i < 2 * FW_JSON_DEPTH; i++)
            fw_json_end(&json);
        if (way != 4) fw_json_end(&json);
        if (way == 6) fw_json_null(&json, NULL);
        assert_int_equal(fw_json_finish(&json, ""), FW_INTERNAL);
    }
    fw_arena_free(arena);
}

static unsigned draw(unsigned *seed, unsigned n) {
    *seed = *seed * 1664525U + 1013904223U;
    return (*seed >> 8) % n;
}

/* writes a random value and builds the same one with the other library */
static json_t *random_value(fw_json *json, const char *key, unsigned *seed, int depth) {
    unsigned kind = draw(seed, depth > 3 ? 4 : 6);
    char name[16];
    if (kind == 0) {
        long value = (long)draw(seed, 100000) - 50000;
        fw_json_whole(json, key, value);
        return json_integer(value);
    }
    if (kind == 1) {
        double value = ((double)draw(seed, 1u << 23) - 4e6) * pow(10, (double)draw(seed, 40) - 20);
        fw_json_real(json, key, value);
        return json_real(value);
    }
    if (kind == 2) {
        char text[] = {(char)(1 + draw(seed, 126)), ',', (char)(1 + draw(seed, 126)), '\0'};
        fw_json_text(json, key, text);
        return json_string(text);
    }
    if (kind == 3) {
        fw_json_truth(json, key, depth % 2 == 0);
        return json_boolean(depth % 2 == 0);
    }
    json_t *all = kind == 4 ? json_array() : json_object();
    if (kind == 4)
        fw_json_list(json, key);
    else
        fw_json_object(json, key);
    for (unsigned i = 0, n = draw(seed, 5); i < n; i++) {
        snprintf(name, sizeof name, "k%u", i);
        json_t *value = random_value(json, kind == 4 ? NULL : name, seed, depth + 1);
        if (kind == 4)
            json_array_append_new(all, value);
        else
            json_object_set_new(all, name, value);
    }
    fw_json_end(json);
    return all;
}

static void random_documents_are_those_of_another_library(void **state) {
    static const size_t flags[] = {[FW_JSON_COMPACT] = JSON_COMPACT,
                                   [FW_JSON_SPACED] = 0,
                                   [FW_JSON_INDENTED] = JSON_INDENT(1),
                                   [FW_JSON_INDENTED_2] = JSON_INDENT(2)};
    (void)state;
    unsigned seed = 7;
    for (int i = 0; i < 1200; i++) {
        fw_json_style style = (fw_json_style)(i % 4);
        fw_arena *arena = fw_arena_new(0);
        fw_text t = fw_text_new(arena);
        fw_json json = fw_json_new(&t, style);
        json_t *built = random_value(&json, NULL, &seed, 0);
        assert_int_equal(fw_json_finish(&json, ""), FW_OK);
        json_t *read = json_loads(t.data, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, NULL);
        if (!read || !json_equal(built, read)) fail_msg("another document: %s", t.data);
        char *dumped = json_dumps(built, flags[style] | JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
        if (style != FW_JSON_COMPACT) assert_string_equal(t.data, dumped); /* its escapes differ */
        free(dumped);
        json_decref(read);
        json_decref(built);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commas_are_written_where_they_are_due),
        cmocka_unit_test(members_that_nobody_wants_are_left_out),
        cmocka_unit_test(lines_are_broken_where_they_are_asked_for),
        cmocka_unit_test(numbers_that_are_none_are_null),
        cmocka_unit_test(what_is_no_utf8_is_marked),
        cmocka_unit_test(wrong_nesting_is_told),
        cmocka_unit_test(random_documents_are_those_of_another_library),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
