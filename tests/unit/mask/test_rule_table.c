/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows <rule> of a layer table: what is read, limits as formulas, and mistakes at their place. */
#include "mask/rule.h"
#include "test.h"

#define HEAD "<mask-table xmlns=\"urn:flexwright:masks:1\" flow=\"f\" reading=\"r\">\n"
#define REST "purpose=\"p\" tone=\"data dark\" colour=\"#000000\""
#define LAYERS                                                                                     \
    "<layer gds=\"1/0\" id=\"a\" name=\"A\" " REST "/><layer gds=\"2/0\" id=\"bb\" name=\"B\" "    \
    "min-width=\"3 um\" source=\"s\" " REST "/><layer gds=\"63/0\" id=\"n\" name=\"N\" "           \
    "documentation=\"yes\" " REST "/>\n"
#define END "</mask-table>"

static fw_status read(fw_arena *arena, const char *xml, fw_diags *diags, fw_mask_table *t) {
    *diags = fw_diags_new(arena);
    return fw_mask_table_read(arena, "t.xml", xml, strlen(xml), diags, t);
}

static const char all_kinds[] =
    HEAD "<rule kind=\"width\" layer=\"a\" min=\"4 um\" source=\"one\"/>" LAYERS
         "<rule kind=\"space\" layer=\"a\" min=\"2 um + 3 um\" source=\"two\" severity=\"error\"/>"
         "<rule kind=\"notch\" layer=\"a\" min=\"6 um\" source=\"three\" severity=\"warning\"/>"
         "<rule kind=\"feature\" layer=\"bb\" wavelength=\"405 nm\" gap=\"10 um\" resist=\"16 um\" "
         "min=\"1.5*sqrt(wavelength*(gap + resist/2))\" source=\"Fresnel\"/>"
         "<rule kind=\"angle\" layer=\"a\" min=\"60 deg\" of=\"polygon\" source=\"s\"/>"
         "<rule kind=\"angle\" layer=\"a\" min=\"50 deg\" source=\"s\"/>"
         "<rule kind=\"edge\" layer=\"bb\" min=\"50 nm\" source=\"s\"/>"
         "<rule kind=\"area\" layer=\"a\" min=\"16 um2\" source=\"s\" of=\"hole\"/>"
         "<rule kind=\"density\" layer=\"a\" max=\"60 %\" window=\"500 um\" step=\"250 um\" "
         "source=\"s\"/>"
         "<rule kind=\"enclosure\" layer=\"bb\" inside=\"a\" min=\"4 um\" source=\"s\"/>"
         "<rule kind=\"separation\" layer=\"bb\" from=\"a\" min=\"5 um\" source=\"s\"/>" END;

static void every_kind_is_read(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags;
    fw_mask_table t;
    fw_status status = read(arena, all_kinds, &diags, &t);
    if (status != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : "no message");
    static const char *const name[] = {"width",   "space",     "notch",     "feature",
                                       "angle",   "angle",     "edge",      "area",
                                       "density", "enclosure", "separation"};
    assert_int_equal(t.nrule, 11);
    for (int i = 0; i < t.nrule; i++) {
        assert_string_equal(fw_mask_rule_name(&t.rule[i]), name[i]);
        assert_int_equal(t.rule[i].severity, i == 2 ? FW_WARNING : FW_ERROR);
        assert_true(t.rule[i].layer == (i == 3 || i == 6 || i > 8));
        assert_int_equal(t.rule[i].other, i > 8 ? 0 : -1);
        assert_non_null(t.rule[i].source);
        assert_int_equal(t.rule[i].place.line, i == 0 ? 2 : 3);
    }
    assert_near(t.layer[0].min_width_m, 4e-6, 1e-20); /* for those who ask the layer */
    assert_near(t.layer[0].min_space_m, 5e-6, 1e-20);
    assert_string_equal(t.layer[0].rule_source, "one");
    assert_near(t.layer[1].min_width_m, 3e-6, 1e-20);
    assert_near(t.rule[1].least, 5e-6, 1e-20);
    assert_near(t.rule[3].least, 1.5 * sqrt(405e-9 * 18e-6), 1e-19); /* 4.05 um */
    assert_string_equal(t.rule[3].formula, "1.5*sqrt(wavelength*(gap + resist/2))");
    assert_near(t.rule[4].least, acos(0.5), 1e-15);
    assert_int_equal(t.rule[4].of, FW_OF_POLYGON);
    assert_int_equal(t.rule[5].of, FW_OF_OUTLINE);
    assert_int_equal(t.rule[6].of, FW_OF_POLYGON);
    assert_near(t.rule[7].least, 16e-12, 1e-26);
    assert_int_equal(t.rule[7].of, FW_OF_HOLE);
    assert_true(t.rule[8].least == 0 && isinf(t.rule[0].most));
    assert_near(t.rule[8].most, 0.6, 1e-16);
    assert_near(t.rule[8].window_m, 500e-6, 1e-18);
    assert_near(t.rule[8].step_m, 250e-6, 1e-18);
    fw_arena_free(arena);
}

/* one mistake each: its number, and where it is told, on line 3 */
#define RULE(text) HEAD LAYERS "<rule " text "/>" END
static const struct {
    const char *xml;
    int number, column;
} wrong[] = {
    {RULE("layer=\"a\" min=\"4 um\" source=\"s\""), 135, 1},
    {RULE("kind=\"wdith\" layer=\"a\" min=\"4 um\" source=\"s\""), 135, 13},
    {RULE("kind=\"overlap\" layer=\"a\" min=\"4 um\" source=\"s\""), 135, 13},
    {RULE("kind=\"width\" min=\"4 um\" source=\"s\""), 135, 1},
    {RULE("kind=\"width\" layer=\"a\" source=\"s\""), 135, 1},
    {RULE("kind=\"width\" layer=\"a\" min=\"4 um\""), 135, 1},
    {RULE("kind=\"width\" layer=\"c\" min=\"4 um\" source=\"s\""), 135, 27},
    {RULE("kind=\"width\" layer=\"n\" min=\"4 um\" source=\"s\""), 135, 27},
    {RULE("kind=\"width\" layer=\"a\" min=\"4\" source=\"s\""), 0, 0},
    {RULE("kind=\"width\" layer=\"a\" min=\"4 deg\" source=\"s\""), 0, 0},
    {RULE("kind=\"width\" layer=\"a\" min=\"2*gap\" source=\"s\""), 0, 0},
    {RULE("kind=\"width\" layer=\"a\" min=\"-4 um\" source=\"s\""), 135, 35},
    {RULE("kind=\"width\" layer=\"a\" min=\"0 um\" source=\"s\""), 135, 35},
    {RULE("kind=\"width\" layer=\"a\" min=\"2 m\" source=\"s\""), 135, 35},
    {RULE("kind=\"width\" layer=\"a\" max=\"4 um\" min=\"3 um\" source=\"s\""), 135, 30},
    {RULE("kind=\"width\" layer=\"a\" min=\"3 um\" source=\"\xc2\xb5\""), 141, 49},
    {RULE("kind=\"width\" layer=\"bb\" min=\"4 um\" source=\"s\""), 135, 1}, /* min-width too */
    {RULE("kind=\"angle\" layer=\"a\" min=\"190 deg\" source=\"s\""), 135, 35},
    {RULE("kind=\"angle\" layer=\"a\" min=\"60 deg\" of=\"hole\" source=\"s\""), 135, 47},
    {RULE("kind=\"width\" layer=\"a\" min=\"4 um\" severity=\"fatal\" source=\"s\""), 135, 51},
    {RULE("kind=\"density\" layer=\"a\" min=\"50 %\" source=\"s\""), 135, 1},
    {RULE("kind=\"density\" layer=\"a\" min=\"50 %\" max=\"40 %\" window=\"1 mm\" source=\"s\""),
     135, 48},
    {RULE("kind=\"density\" layer=\"a\" window=\"1 mm\" source=\"s\""), 135, 1},
    {RULE("kind=\"enclosure\" layer=\"a\" min=\"4 um\" source=\"s\""), 135, 1},
    {RULE("kind=\"enclosure\" layer=\"a\" inside=\"a\" min=\"4 um\" source=\"s\""), 135, 42},
    {RULE("kind=\"separation\" layer=\"a\" from=\"b\" min=\"4 um\" source=\"s\""), 135, 41},
    {RULE("kind=\"feature\" layer=\"a\" wavelength=\"405 nm\" gap=\"9 um\" min=\"4 um\" "
          "source=\"s\""),
     135, 1},
    {HEAD LAYERS "<rule kind=\"space\" layer=\"a\" min=\"4 um\" source=\"s\"/><rule kind=\"space\" "
                 "layer=\"a\" min=\"5 um\" source=\"s\"/>" END,
     135, 53},
    {HEAD LAYERS "<rule kind=\"width\" layer=\"a\" min=\"4 um\" source=\"s\"><x/></rule>" END, 135,
     52},
};

static void mistakes_have_their_place(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags;
        fw_mask_table t;
        fw_status status = read(arena, wrong[i].xml, &diags, &t);
        bool found = false;
        for (size_t k = 0; k < diags.count; k++) {
            const fw_diag *d = &diags.item[k];
            found = found ||
                    (wrong[i].number == 0 && d->number >= 20 && d->number < 40 &&
                     d->place.line == 3 && d->place.column >= 35) ||
                    (d->number == wrong[i].number && d->place.line == 3 &&
                     d->place.column == wrong[i].column);
        }
        if (status != FW_INPUT || !found || diags.count != 1)
            fail_msg("case %zu: status %d, %zu messages, first D%03d at %d:%d: %s", i, (int)status,
                     diags.count, diags.count ? diags.item[0].number : 0,
                     diags.count ? diags.item[0].place.line : 0,
                     diags.count ? diags.item[0].place.column : 0,
                     diags.count ? diags.item[0].message : "none");
        fw_arena_free(arena);
    }
}

/* a warning beside the layer's own error, and the same rule of another window, are no repetition */
static void not_twice(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags;
    fw_mask_table t;
    assert_int_equal(
        read(arena,
             HEAD LAYERS
             "<rule kind=\"width\" layer=\"bb\" min=\"5 um\" severity=\"warning\" source=\"s\"/>"
             "<rule kind=\"density\" layer=\"a\" min=\"5 %\" window=\"1 mm\" source=\"s\"/>"
             "<rule kind=\"density\" layer=\"a\" min=\"9 %\" window=\"2 mm\" source=\"s\"/>" END,
             &diags, &t),
        FW_OK);
    assert_int_equal(t.nrule, 3);
    fw_arena_free(arena);
}

static void short_memory(void **state) {
    (void)state;
    fw_status status = FW_NOMEM;
    for (long at = 1; status != FW_OK && at < 2000; at++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags = fw_diags_new(arena);
        fw_mask_table t;
        fw_arena_fail_at(at, 1);
        status = fw_mask_table_read(arena, "t.xml", all_kinds, strlen(all_kinds), &diags, &t);
        fw_arena_fail_at(0, 0);
        assert_true(status == FW_OK || status == FW_NOMEM);
        fw_arena_free(arena);
    }
    assert_int_equal(status, FW_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_read),
        cmocka_unit_test(mistakes_have_their_place),
        cmocka_unit_test(not_twice),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
