/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts of other programs in answers, against jansson's own reading of UTF-8. */
#include "serve/request.h"
#include "test.h"
#include <jansson.h>

static bool is_text(const char *text) {
    json_t *json = json_string(text); /* NULL when it is no UTF-8 */
    bool ok = json != NULL;
    json_decref(json);
    return ok;
}

/* random bytes, most of them where sequences begin and go on: what is text stays, all else becomes
 * it */
static void any_bytes_become_text(void **state) {
    (void)state;
    static const unsigned char often[] = {0xC0, 0xC2, 0xDF, 0xE0, 0xE1, 0xED, 0xEF,
                                          0xF0, 0xF1, 0xF4, 0xF5, 0x80, 0x8F, 0x90,
                                          0x9F, 0xA0, 0xBF, 0xFF, 'a',  '"'};
    uint64_t random = 20261121;
    int texts = 0;
    for (int round = 0; round < 200000; round++) {
        char text[8], cleaned[8];
        size_t n = 1 + (size_t)(round % 6);
        for (size_t i = 0; i < n; i++) {
            random = random * 6364136223846793005ULL + 1442695040888963407ULL;
            text[i] = (char)often[(random >> 33) % sizeof often];
        }
        text[n] = '\0';
        memcpy(cleaned, text, n + 1);
        fw_serve_reply_clean(cleaned);
        assert_int_equal(strlen(cleaned), n);
        assert_true(is_text(cleaned));
        if (is_text(text)) {
            assert_string_equal(cleaned, text);
            texts++;
        } else
            assert_string_not_equal(cleaned, text);
    }
    assert_true(texts > 5000);
}

static void every_character_stays(void **state) {
    (void)state;
    for (unsigned long c = 1; c < 0x110000; c += c < 0x1000 ? 1 : 61) {
        if (c >= 0xD800 && c < 0xE000) continue;
        char text[5] = {0}, cleaned[5];
        if (c < 0x80)
            text[0] = (char)c;
        else if (c < 0x800)
            text[0] = (char)(0xC0 | c >> 6), text[1] = (char)(0x80 | (c & 63));
        else if (c < 0x10000)
            text[0] = (char)(0xE0 | c >> 12), text[1] = (char)(0x80 | (c >> 6 & 63)),
            text[2] = (char)(0x80 | (c & 63));
        else
            text[0] = (char)(0xF0 | c >> 18), text[1] = (char)(0x80 | (c >> 12 & 63)),
            text[2] = (char)(0x80 | (c >> 6 & 63)), text[3] = (char)(0x80 | (c & 63));
        memcpy(cleaned, text, sizeof text);
        fw_serve_reply_clean(cleaned);
        assert_string_equal(cleaned, text);
    }
}

/* an error is JSON with its message, whatever stands in it */
static void an_error_is_json(void **state) {
    (void)state;
    fw_serve_request r = {.arena = fw_arena_new(0)};
    fw_serve_reply_error(&r, 400, "FW-D286", "%s \"quoted\" \\ \n\xff %s", "\xc3\xa4", "end");
    assert_int_equal(r.reply.status, 400);
    assert_string_equal(r.reply.type, "application/json");
    json_t *json = json_loadb(r.reply.data, r.reply.n, 0, NULL);
    const json_t *error = json_object_get(json, "error");
    assert_string_equal(json_string_value(json_object_get(error, "message")),
                        "\xc3\xa4 \"quoted\" \\ \n? end");
    assert_string_equal(json_string_value(json_object_get(error, "code")), "FW-D286");
    json_decref(json);
    fw_serve_reply_error(&r, 404, NULL, "%0700d", 1); /* cut, still whole */
    json = json_loadb(r.reply.data, r.reply.n, 0, NULL);
    assert_true(json_is_null(json_object_get(json_object_get(json, "error"), "code")));
    json_decref(json);
    fw_arena_free(r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_bytes_become_text),
        cmocka_unit_test(every_character_stays),
        cmocka_unit_test(an_error_is_json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
