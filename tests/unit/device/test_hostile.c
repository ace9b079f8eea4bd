/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hostile files: each refused with an id and a place, in little memory, before anything is opened.
 */
#include "files.h"
#include <stdlib.h>

typedef struct hostile {
    const char *name;
    int number; /* FW-Dnnn; 0: any */
    const char *text;
    size_t n; /* 0: strlen */
} hostile;

#define H       "<?xml version=\"1.0\"?>\n"
#define TEXT(s) s, sizeof(s) - 1
static const hostile files[] = {
    {"doctype", 4, H "<!DOCTYPE device><device/>", 0},
    {"doctype lower case", 4, H "<!doctype device><device/>", 0},
    {"doctype with system id", 4, H "<!DOCTYPE device SYSTEM \"file:///etc/hostname\"><device/>",
     0},
    {"doctype with public id", 4, H "<!DOCTYPE d PUBLIC \"-//X//Y\" \"http://127.0.0.1:1/x\"><d/>",
     0},
    {"external entity", 4,
     H "<!DOCTYPE d [<!ENTITY x SYSTEM \"file:///etc/hostname\">]><d name=\"&x;\"/>", 0},
    {"external entity in text", 4,
     H "<!DOCTYPE d [<!ENTITY x SYSTEM \"/etc/hostname\">]><d>&x;</d>", 0},
    {"parameter entity", 4, H "<!DOCTYPE d [<!ENTITY % x SYSTEM \"/etc/hostname\"> %x;]><d/>", 0},
    {"billion laughs", 4,
     H "<!DOCTYPE d [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c "
       "\"&b;&b;&b;&b;&b;&b;&b;&b;\"><!ENTITY e \"&c;&c;&c;&c;&c;&c;&c;&c;\">]><d>&e;</d>",
     0},
    {"billion laughs in an attribute", 4,
     H "<!DOCTYPE d [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;\">]><d name=\"&b;\"/>", 0},
    {"entity without doctype", 5, "<d>&x;</d>", 0},
    {"entity in an attribute", 5, "<d name=\"&x;\"/>", 0},
    {"instruction", 6, "<?php echo 1 ?><d/>", 0},
    {"stylesheet", 6, H "<?xml-stylesheet type=\"text/xsl\" href=\"/etc/hostname\"?><d/>", 0},
    {"instruction inside", 6, "<d><?x y?></d>", 0},
    {"instruction at the end", 6, "<d/><?x y?>", 0},
    {"two declarations", 6, H H "<d/>", 0},
    {"XInclude", 15,
     "<x:include xmlns:x=\"http://www.w3.org/2001/XInclude\" href=\"/etc/hostname\"/>", 0},
    {"NUL at the start", 2, TEXT("\0<d/>")},
    {"NUL in a value", 2, TEXT("<d name=\"a\0b\"/>")},
    {"NUL at the end", 2, TEXT("<d/>\0")},
    {"UTF-16 little endian", 3, TEXT("\xff\xfe<\0d\0/\0>\0")},
    {"UTF-16 big endian", 3, TEXT("\xfe\xff\0<\0d\0/\0>")},
    {"UTF-16 without a mark", 2, TEXT("<\0d\0/\0>\0")},
    {"declared UTF-16", 3, "<?xml version=\"1.0\" encoding=\"UTF-16\"?><d/>", 0},
    {"declared UTF-7", 3, "<?xml version='1.0' encoding='UTF-7'?><d/>", 0},
    {"latin-1 byte", 3, "<d name=\"9 \xb5m\"/>", 0},
    {"overlong slash", 3, "<d name=\"\xc0\xaf\"/>", 0},
    {"overlong in three bytes", 3, "<d name=\"\xe0\x80\xaf\"/>", 0},
    {"surrogate", 3, "<d name=\"\xed\xa0\x80\"/>", 0},
    {"beyond Unicode", 3, "<d name=\"\xf4\x90\x80\x80\"/>", 0},
    {"sequence cut off", 3, "<d/>\xe2\x82", 0},
    {"escape character", 16, "<d name=\"\x1b[31m\"/>", 0},
    {"DEL", 16, "<d name=\"a\x7f\"/>", 0},
    {"CSI of C1", 16, "<d name=\"a\xc2\x9b\x32J\"/>", 0},
    {"CSI of C1 by its number", 16, "<d name=\"&#155;2J\"/>", 0},
    {"CSI of C1 by its number in sixteens", 16, "<d name=\"&#x9B;2J\"/>", 0},
    {"ESC by its number", 16, "<d>&#27;[2J</d>", 0},
    {"read from right to left", 16, "<d name=\"a\xe2\x80\xae\"/>", 0},
    {"read from right to left by its number", 16, "<d name=\"&#x202e;\"/>", 0},
    {"isolate in a comment", 16, "<d><!-- \xe2\x81\xa6 --></d>", 0},
    {"character reference to NUL", 11, "<d name=\"&#0;\"/>", 0},
    {"character reference beyond", 11, "<d name=\"&#x110000;\"/>", 0},
    {"character reference not closed", 11, "<d name=\"&#65\"/>", 0},
    {"two attributes of one name", 13, "<d a=\"1\" a=\"2\"/>", 0},
    {"prefix without namespace", 11, "<x:d/>", 0},
    {"empty", 14, "", 0},
    {"only blanks", 14, "  \n\t", 0},
    {"only a mark", 14, "\xef\xbb\xbf", 0},
    {"text only", 0, "hello", 0},
    {"binary", 0,
     "\x7f"
     "ELF\x02\x01\x01",
     0},
    {"CDATA not closed", 0, "<d><![CDATA[ x", 0},
    {"comment not closed", 11, "<d><!-- x", 0},
    {"tag not closed", 0, "<d name=\"a\"", 0},
    {"a single less-than", 0, "<", 0},
    {"end tag only", 0, "</d>", 0},
    {"end tag too much", 0, "<d></d></d>", 0},
};
enum { COUNT = sizeof files / sizeof files[0] };

static void refuse_within(const char *name, int number, const char *text, size_t n, size_t most) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device = (const void *)&diags;
    fw_status s = fw_device_read(arena, name, text, n, NULL, 0, &diags, &device);
    if (s != FW_INPUT || diags.errors == 0)
        fail_msg("%s: status %s, %zu errors", name, fw_status_text(s), diags.errors);
    if (number && diags.item[0].number != number)
        fail_msg("%s: FW-D%03d %s", name, diags.item[0].number, diags.item[0].message);
    assert_true(diags.item[0].place.line >= 1 && diags.item[0].place.column >= 1);
    if (fw_arena_peak(arena) > most)
        fail_msg("%s: %zu bytes of memory", name, fw_arena_peak(arena));
    fw_arena_free(arena);
}

static void refuse(const char *name, int number, const char *text, size_t n) {
    refuse_within(name, number, text, n, (size_t)64 * 1024 * 1024);
}

static void small_files(void **state) {
    (void)state;
    assert_true(COUNT >= 25);
    for (int i = 0; i < COUNT; i++) {
        size_t n = files[i].n ? files[i].n : strlen(files[i].text);
        char *copy = malloc(n ? n : 1); /* exact size: reading beyond is found by the sanitizer */
        assert_non_null(copy);
        memcpy(copy, files[i].text, n);
        refuse(files[i].name, files[i].number, copy, n);
        free(copy);
    }
}

/* head, then `piece` repeated until the text has about n bytes, then tail */
static char *repeated(const char *head, const char *piece, const char *tail, size_t count,
                      size_t *n) {
    size_t h = strlen(head), p = strlen(piece), t = strlen(tail);
    char *text = malloc(h + p * count + t + 1);
    assert_non_null(text);
    memcpy(text, head, h);
    for (size_t i = 0; i < count; i++)
        memcpy(text + h + p * i, piece, p);
    memcpy(text + h + p * count, tail, t + 1);
    *n = h + p * count + t;
    return text;
}

#define ROOT "<device xmlns=\"urn:flexwright:device:1\" name=\"d\">"
static void large_files(void **state) {
    (void)state;
    const struct {
        const char *name;
        int number;
        const char *head, *piece, *tail;
        size_t count;
    } big[] = {
        {"9 MiB of blanks", 1, "<d>", "         ", "</d>", 1048576},
        {"nested 100000 deep", 7, "", "<a>", "", 100000},
        {"nested 33 deep", 7, "", "<a>", "", 33},
        {"2 000 000 elements", 8, "<d>", "<a/>", "</d>", 2000000},
        {"200 001 elements", 8, "<d>", "<a/>", "</d>", 200000},
        {"attributes without end", 9, "<d ", "a%=\"\" ", "/>", 0},
        {"1 500 000 attributes", 9, "<d>",
         "<a b='' c='' d='' e='' f='' g='' h='' i='' j='' k='' l='' m='' n='' o='' p=''/>", "</d>",
         100000},
        {"a value of 8 MB", 10, "<d a=\"", "xxxxxxxx", "\"/>", 1000000},
        {"a value of 4104 bytes", 10, "<d a=\"", "xxxxxxxx", "\"/>", 513},
        {"a name like a law's", 10, "<d tables=\"", "xxxxxxxx", "\"/>", 513},
        {"a table of 65544 bytes", 10, "<d table=\"", "1 s: 1; ", "\"/>", 8193},
        {"brackets, 64 KiB of them", 31,
         ROOT ARM
         "<scene name=\"s\" duration=\"1 s\"><force on=\"arm\" fx=\"1 N\" law=\"expression\" "
         "factor=\"",
         "((((((((", "\"/></scene></device>", 8192},
        {"a name of 8 MB", 0, "<", "aaaaaaaa", "/>", 1000000},
        {"an attribute's name of 8 MB", 0, "<d ", "aaaaaaaa", "=\"\"/>", 1000000},
        {"8 MB of entities", 5, "<d>", "&x;", "</d>", 2500000},
        {"8 MB of ampersands", 11, "<d>", "&", "</d>", 8000000},
        {"8 MB of less-than", 0, "", "<", "", 8000000},
        {"8 MB of comments", 14, "", "<!---->", "", 1000000},
        {"quotes without end", 0, "<d ", "a=\"", "", 2000000},
        {"unknown elements", 40, ROOT, "<a/>\n", "</device>", 199999},
        {"text in many elements", 40, ROOT, "<a>some text here</a>", "</device>", 199999},
        {"unknown attributes", 42, ROOT, "<parameter nam=\"a\" valu=\"1\"/>\n", "</device>", 200},
        {"dangling references", 46, ROOT ARM "<scene name=\"s\" duration=\"1 s\">",
         "<force on=\"armm\" fx=\"1 N\"/>", "</scene></device>", 19000},
        {"gravity again and again", 51, ROOT ARM "<scene name=\"s\" duration=\"1 s\">",
         "<force on=\"arm\" fx=\"1 N\"/><gravity gx=\"1 m/s^2\"/>", "</scene></device>", 9000},
        {"broken expressions", 24, ROOT ARM "<scene name=\"s\" duration=\"1 s\">",
         "<force on=\"arm\" fx=\"((((((((1))))))))\"/>\n", "</scene></device>", 19000},
        {"too many flexures", 66, ROOT ARM,
         "<flexure id=\"a\" kind=\"leaf\" length=\"300 um\" width=\"9 um\"/>", "</device>", 4100},
        {"one id many times", 45, ROOT ARM,
         "<flexure id=\"a\" kind=\"leaf\" length=\"300 um\" width=\"9 um\"/>", "</device>", 3000},
    };
    for (size_t i = 0; i < sizeof big / sizeof big[0]; i++) {
        size_t n, count = big[i].count;
        char *text;
        /* mistakes that are only many: no limit is passed */
        if (big[i].number >= 40 && big[i].number != 66) count /= (size_t)test_fewest(1, 20);
        if (count)
            text = repeated(big[i].head, big[i].piece, big[i].tail, count, &n);
        else { /* distinct names */
            text = malloc(400000);
            assert_non_null(text);
            n = (size_t)sprintf(text, "<d ");
            for (int k = 0; k < 20000; k++)
                n += (size_t)sprintf(text + n, "a%d=\"\" ", k);
            n += (size_t)sprintf(text + n, "/>");
        }
        refuse(big[i].name, big[i].number, text, n);
        free(text);
    }
}

/* as many known elements as a file may hold, each with a mistake: nothing is quadratic in them (a
   test that hangs is killed), and the arena's own limit of 256 MiB holds */
static void mistakes_at_the_limit(void **state) {
    (void)state;
    const struct {
        const char *name;
        int number;
        const char *head, *piece, *tail;
        size_t count;
    } big[] = {
        {"dangling references", 46, ROOT ARM "<scene name=\"s\" duration=\"1 s\">",
         "<force on=\"armm\" fx=\"1 N\"/>", "</scene></device>", 199000},
        {"one body, one driver, often", 45, ROOT "<mechanism>",
         "<body id=\"a\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"0 m\" y=\"0 m\"/>"
         "<driver joint=\"b\" value=\"t\"/>",
         "</mechanism></device>", 50000},
        {"gravity again and again", 51, ROOT ARM "<scene name=\"s\" duration=\"1 s\">",
         "<force on=\"arm\" fx=\"1 N\"/><gravity gx=\"1 m/s^2\"/>", "</scene></device>", 99000},
        {"initial again and again", 45, ROOT ARM "<scene name=\"s\" duration=\"1 s\">",
         "<initial body=\"arm\"/>", "</scene></device>", 199000},
    };
    for (size_t i = 0; i < sizeof big / sizeof big[0]; i++) {
        size_t n;
        char *text = repeated(big[i].head, big[i].piece, big[i].tail,
                              big[i].count / (size_t)test_fewest(test_cases(1, 8), 80), &n);
        refuse_within(big[i].name, big[i].number, text, n, (size_t)256 * 1024 * 1024);
        free(text);
    }
}

/* what looks hostile and is allowed */
static void harmless_files(void **state) {
    (void)state;
    static const char *const text[] = {
        "\xef\xbb\xbf" DEVICE(ARM),
        ("<?xml version=\"1.0\" encoding='utf-8' standalone=\"yes\"?>\r\n<!-- <!DOCTYPE x> <?y?> "
         "&z; -->" DEVICE(ARM) "\r\n<!-- end -->"),
        DEVICE("<die title=\"&lt;&amp;&gt;&quot;&#39;&#181; "
               "\xc2\xb5\xe2\x82\xac\xf0\x9f\x98\x80\"/>" ARM),
        DEVICE("<![CDATA[   ]]>" ARM),
        "<f:device xmlns:f=\"urn:flexwright:device:1\" name=\"d\"><f:mechanism><f:body id=\"a\" "
        "mass=\"1 mg\"\ninertia=\"1\tmg mm^2\" x=\"0 mm\" y=\"0 mm\"/></f:mechanism></f:device>",
    };
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        sound(arena, text[i], NULL, 0);
        fw_arena_free(arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_files),
        cmocka_unit_test(large_files),
        cmocka_unit_test(mistakes_at_the_limit),
        cmocka_unit_test(harmless_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
