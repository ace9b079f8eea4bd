/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON member by member: commas, escapes, what is no number and what is no UTF-8; random documents
   are read back by another library. */
#include "base/members.h"
#include "test.h"
#include <jansson.h>
#include <math.h>
#include <string.h>

static void commas_are_written_where_they_are_due(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_put_open(&t, NULL, '{');
    fw_put_text(&t, "a", "x,[{\"\n");
    fw_put_open(&t, "list", '[');
    fw_put_whole(&t, NULL, -7);
    fw_put_number(&t, NULL, 0.1, 3);
    fw_put_line(&t);
    fw_put_open(&t, NULL, '{');
    fw_text_add(&t, "}");
    fw_put_fixed(&t, NULL, 2.50, 3);
    fw_text_add(&t, "]");
    fw_put_truth(&t, "yes", true);
    fw_put_line(&t);
    fw_put_null(&t, "no");
    fw_text_add(&t, "}");
    assert_int_equal(fw_text_end(&t), FW_OK);
    assert_string_equal(t.data,
                        "{\"a\":\"x,[{\\\"\\u000a\",\"list\":[-7,0.1,\n{},2.5],\"yes\":true,\n"
                        "\"no\":null}");
    fw_arena_free(arena);
}

static void numbers_that_are_none_are_null(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_put_open(&t, NULL, '[');
    fw_put_number(&t, NULL, (double)NAN, 6);
    fw_put_number(&t, NULL, -(double)INFINITY, 6);
    fw_put_fixed(&t, NULL, (double)INFINITY, 6);
    fw_put_number(&t, NULL, -0.0, 6);
    fw_put_text(&t, NULL, NULL);
    fw_text_add(&t, "]");
    assert_string_equal(t.data, "[null,null,null,0,null]");
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
        fw_put_text(&t, NULL, given[i]);
        json_t *read = json_loads(t.data, JSON_DECODE_ANY, NULL);
        assert_non_null(read);
        assert_string_equal(json_string_value(read), wanted[i]);
        json_decref(read);
    }
    fw_arena_free(arena);
}

static unsigned draw(unsigned *seed, unsigned n) {
    *seed = *seed * 1664525U + 1013904223U;
    return (*seed >> 8) % n;
}

/* writes a random value and builds the same one with the other library */
static json_t *random_value(fw_text *t, const char *key, unsigned *seed, int depth) {
    unsigned kind = draw(seed, depth > 3 ? 4 : 6);
    char name[8];
    if (draw(seed, 3) == 0) fw_put_line(t);
    if (kind == 0) {
        long value = (long)draw(seed, 100000) - 50000;
        fw_put_whole(t, key, value);
        return json_integer(value);
    }
    if (kind == 1) {
        double value = (draw(seed, 1u << 23) + 0.5) / 1024.0;
        fw_put_number(t, key, value, 17);
        return json_real(value);
    }
    if (kind == 2) {
        char text[] = {(char)(1 + draw(seed, 126)), ',', (char)(1 + draw(seed, 126)), '\0'};
        fw_put_text(t, key, text);
        return json_string(text);
    }
    if (kind == 3) {
        fw_put_truth(t, key, depth % 2 == 0);
        return json_boolean(depth % 2 == 0);
    }
    json_t *all = kind == 4 ? json_array() : json_object();
    fw_put_open(t, key, kind == 4 ? '[' : '{');
    for (unsigned i = 0, n = draw(seed, 5); i < n; i++) {
        snprintf(name, sizeof name, "k%u", i);
        json_t *value = random_value(t, kind == 4 ? NULL : name, seed, depth + 1);
        if (kind == 4)
            json_array_append_new(all, value);
        else
            json_object_set_new(all, name, value);
    }
    fw_text_add(t, kind == 4 ? "]" : "}");
    return all;
}

static void random_documents_are_read_back(void **state) {
    (void)state;
    unsigned seed = 7;
    for (int i = 0; i < 300; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_text t = fw_text_new(arena);
        json_t *built = random_value(&t, NULL, &seed, 0);
        assert_int_equal(fw_text_end(&t), FW_OK);
        json_t *read = json_loads(t.data, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, NULL);
        if (!read || !json_equal(built, read)) fail_msg("another document: %s", t.data);
        json_decref(read);
        json_decref(built);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commas_are_written_where_they_are_due),
        cmocka_unit_test(numbers_that_are_none_are_null),
        cmocka_unit_test(what_is_no_utf8_is_marked),
        cmocka_unit_test(random_documents_are_read_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
