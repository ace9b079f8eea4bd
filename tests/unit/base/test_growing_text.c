/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/diag.h"
#include "base/text.h"
#include "test.h"

static void numbers_round_trip(void **state) {
    (void)state;
    uint64_t seed = 7;
    char buffer[64];
    for (int i = 0; i < 100000; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        double x;
        memcpy(&x, &seed, sizeof x);
        if (!isfinite(x)) continue;
        double back;
        fw_number_text(buffer, sizeof buffer, x, 17);
        assert_true(fw_number_parse(buffer, strlen(buffer), &back));
        assert_memory_equal(&x, &back, sizeof x);
    }
}

static void numbers_are_strict(void **state) {
    (void)state;
    static const char *const bad[] = {"",  " 1",  "1 ",  "0x10", "inf",   "nan",   "1e", "1e+",
                                      ".", "1,5", "--1", "+",    "1e999", "1.2.3", "1d3"};
    static const char *const good[] = {"1", "-1.5", "+.5", "5.", "1e-3", "1E+3"};
    double x;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_false(fw_number_parse(bad[i], strlen(bad[i]), &x));
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        assert_true(fw_number_parse(good[i], strlen(good[i]), &x));
}

static void percents_keep_three_digits(void **state) {
    (void)state;
    static const struct {
        double part;
        const char *shown;
    } row[] = {{0, "0"},           {0.001, "0.1"},    {0.0036409, "0.364"}, {9.996, "1000"},
               {43.449, "4340"},   {99.96, "10000"},  {110.59, "11100"},    {999.6, "100000"},
               {5678.9, "568000"}, {9995.1, "1e+06"}, {1e30, "1e+32"},      {3.2e-9, "3.2e-07"}};
    char buffer[32];
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        assert_string_equal(fw_percent_text(buffer, sizeof buffer, row[i].part), row[i].shown);
}

static void fixed_and_escaped(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_text_fixed(&t, 1.5, 6);
    fw_text_add(&t, " ");
    fw_text_fixed(&t, -0.0000001, 3);
    fw_text_add(&t, " ");
    fw_text_fixed(&t, 100, 2);
    fw_text_add(&t, " ");
    fw_text_escaped(&t, "<a href=\"x\">&'\x01</a>");
    assert_string_equal(t.data, "1.5 0 100 &lt;a href=&quot;x&quot;&gt;&amp;&#39; &lt;/a&gt;");
    assert_int_equal(fw_text_end(&t), FW_OK);
    fw_arena_free(arena);
}

/* the digits of printf without its trailing zeros, for every size, and next to halves */
static void fixed_as_printf(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 300000; i++) {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        int decimals = (int)(seed >> 60) % 12;
        double value = ldexp((double)(int64_t)seed, -(int)(seed >> 20 & 127));
        if (i % 4 == 1) value = (double)(int32_t)(seed >> 16) / 2000;     /* halves in decimal */
        if (i % 4 == 2) value = (double)(int32_t)(seed >> 30) / 128;      /* exact halves */
        if (i % 4 == 3) value = nextafter(value, seed >> 33 & 1 ? 0 : 9); /* just beside */
        char got[FW_FIXED_BYTES], want[FW_FIXED_BYTES];
        char *end = fw_fixed_text(got, value, decimals);
        snprintf(want, sizeof want, "%.*f", decimals, value);
        for (size_t n = strlen(want); strchr(want, '.') && strspn(want + n - 1, "0.") == 1; n--) {
            int point = want[n - 1] == '.';
            want[n - 1] = '\0';
            if (point) break;
        }
        assert_string_equal(got, strcmp(want, "-0") == 0 ? "0" : want);
        assert_ptr_equal(end, got + strlen(got));
        if (decimals != 6) continue;
        char fast[FW_FIXED_BYTES];
        end = fw_millionths_text(fast, value);
        assert_string_equal(fast, got);
        assert_ptr_equal(end, fast + strlen(fast));
        double micro = (double)(int64_t)(seed >> 22 & 0x3ffffffffff) * 1e-6 / (i % 7 ? 1000 : 1);
        fw_fixed_text(got, -micro, 6);
        fw_millionths_text(fast, -micro);
        assert_string_equal(fast, got);
        char two[2 * FW_FIXED_BYTES], both[2 * FW_FIXED_BYTES];
        snprintf(two, sizeof two, "%s %s", got, want);
        *fw_place_text(both, -micro, value) = '\0';
        assert_string_equal(both, strcmp(want, "-0") == 0 ? strcat(strcpy(two, got), " 0") : two);
    }
}

static void short_memory_sticks(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text t = fw_text_new(arena);
    fw_arena_fail_at(1, 0);
    fw_text_add(&t, "lost");
    fw_arena_fail_at(0, 0);
    fw_text_add(&t, "kept?");
    assert_int_equal(fw_text_end(&t), FW_NOMEM);
    fw_arena_free(arena);
}

static void spelling(void **state) {
    (void)state;
    static const char *const names[] = {"plan", "check", "simulate"};
    assert_string_equal(fw_did_you_mean("simualte", names, 3), "simulate");
    assert_string_equal(fw_did_you_mean("plam", names, 3), "plan");
    assert_null(fw_did_you_mean("serve", names, 3));
    /* nothing is near: the one that begins alike, where there is one */
    const char *const words[] = {"require", "step-load", "gentle-step", "width-front", "width-rear", "arc"};
    assert_string_equal(fw_did_you_mean("requirment", words, 6), "require");
    assert_string_equal(fw_did_you_mean("step", words, 6), "step-load");
    assert_null(fw_did_you_mean("width", words, 6));
    assert_null(fw_did_you_mean("requests", words, 6));
    assert_null(fw_did_you_mean("archway", words, 6));
    assert_int_equal(fw_edit_distance("ab", "ba", 2), 1);
    assert_int_equal(fw_edit_distance("", "abc", 2), 3);
    assert_int_equal(fw_edit_distance("kitten", "sitting", 5), 3);
}

static void zero_has_no_sign(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const struct {
        const char *conversion;
        double value;
        const char *shown;
    } row[] = {{"%5.4g %%", -0.0, "    0 %"}, {"%8.2f", -0.001, "    0.00"},
               {"%.1e", -0.0, "0.0e+00"},     {"%.2f", -0.006, "-0.01"},
               {"%.1e", -3e-9, "-3.0e-09"},   {"%g", -(double)INFINITY, "-inf"}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_text text = fw_text_new(arena);
        fw_text_real(&text, row[i].conversion, row[i].value);
        assert_int_equal(fw_text_end(&text), FW_OK);
        assert_string_equal(text.data, row[i].shown);
    }
    fw_arena_free(arena);
}

/* a terminal, a browser and a spreadsheet get no orders from a text */
static void orders_are_not_given(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const struct {
        const char *text, *shown, *csv;
    } row[] = {
        {"plain, \xc2\xb5m \xf0\x9f\x98\x80", "plain, \xc2\xb5m \xf0\x9f\x98\x80",
         "\"plain, \xc2\xb5m \xf0\x9f\x98\x80\""},
        {"a\x1b[31m\tb\r\nc", "a [31m b  c", "\"a [31m b  c\""},
        {"\x7f\xc2\x9b\x32J\xe2\x80\xae!\xe2\x81\xa7",
         "\xef\xbf\xbd\xef\xbf\xbd\x32J\xef\xbf\xbd!\xef\xbf\xbd",
         "\xef\xbf\xbd\xef\xbf\xbd\x32J\xef\xbf\xbd!\xef\xbf\xbd"},
        {"\xff\xc3", "\xef\xbf\xbd\xef\xbf\xbd",
         "\xef\xbf\xbd\xef\xbf\xbd"}, /* no UTF-8, and cut off */
        {"=1+1", "=1+1", "\"'=1+1\""},
        {"\t=1+1", " =1+1", "\"' =1+1\""},
        {" @x", " @x", "\"' @x\""},
        {"\xef\xbc\x9d\x31", "\xef\xbc\x9d\x31", "\"'\xef\xbc\x9d\x31\""},
        {"a \"b\"", "a \"b\"", "\"a \"\"b\"\"\""},
        {"3 - 2 = 1", "3 - 2 = 1", "3 - 2 = 1"},
        {"", "", ""},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        assert_string_equal(fw_text_shown(arena, row[i].text, strlen(row[i].text)), row[i].shown);
        assert_int_equal(fw_text_is_line(row[i].text), strcmp(row[i].text, row[i].shown) == 0);
        fw_text csv = fw_text_new(arena), escaped = fw_text_new(arena);
        fw_text_add(&csv, "");
        fw_text_add(&escaped, "");
        fw_text_csv(&csv, row[i].text);
        assert_string_equal(csv.data, row[i].csv);
        fw_text_escaped(&escaped, row[i].text); /* keeps tabs and line ends */
        for (const char *c = escaped.data; *c;) {
            unsigned code = fw_text_character(&c);
            assert_true(!fw_text_is_order(code) || code == '\t' || code == '\n');
        }
    }
    /* nothing beyond n is read or shown */
    assert_string_equal(fw_text_shown(arena, "\xe2\x82\xac", 2), "\xef\xbf\xbd\xef\xbf\xbd");
    assert_string_equal(fw_text_shown(arena, "a\0b", 3), "a b");
    fw_arena_free(arena);
}

static void what_was_meant(void **state) {
    (void)state;
    static const char *const ids[] = {"A", "left", "A", "stage"};
    static const char *const many[] = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n"};
    fw_arena *arena = fw_arena_new(1 << 20);
    assert_string_equal(fw_text_meant(arena, "stag", ids, 4), "; did you mean 'stage'?");
    assert_string_equal(fw_text_meant(arena, "B7", ids, 4), "; there are A left stage");
    assert_string_equal(fw_text_meant(arena, "B7", ids, 0), "");
    assert_string_equal(fw_text_meant(arena, "B7", many, 12), "; there are a b c d e f g h i j k l");
    assert_string_equal(fw_text_meant(arena, "B7", many, 14), "; there are a b c d e f g h i j k l ...");
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_are_not_given),       cmocka_unit_test(zero_has_no_sign),
        cmocka_unit_test(numbers_round_trip),         cmocka_unit_test(numbers_are_strict),
        cmocka_unit_test(fixed_and_escaped),          cmocka_unit_test(fixed_as_printf),
        cmocka_unit_test(short_memory_sticks),        cmocka_unit_test(spelling),
        cmocka_unit_test(percents_keep_three_digits), cmocka_unit_test(what_was_meant),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
