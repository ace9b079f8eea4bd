/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader by a table of its own: every kind of value, how often elements may stand, text,
   elements
   with several parents, and rows made for one element. */
#include "test.h"
#include "xml/xml_reader.h"

static bool is_even(const char *text) {
    return strlen(text) % 2 == 0;
}

static const char *const colours[] = {"red", "green", NULL};
static const fw_xml_attribute_row box_rows[] = {
    {"id", .kind = FW_KIND_ID, .required = true, .sentence = "Its name."},
    {"size", .kind = FW_KIND_NUMBER, .dimension = {.m = 1}, .unit = "um", .ranged = true,
     .open = true, .max = 1e-3, .reason = "it must fit", .sentence = "Its size."},
    {"count", .kind = FW_KIND_DECIMAL, .whole = true, .ranged = true, .min = 1, .max = 9,
     .reason = "there are so many", .sentence = "How many."},
    {"colour", .kind = FW_KIND_WORD, .words = colours, .sentence = "One colour."},
    {"stripes", .kind = FW_KIND_WORDS, .words = colours, .sentence = "Some colours."},
    {"label", .kind = FW_KIND_FORM, .form = is_even, .reason = "of even length",
     .sentence = "What is written on it."},
};
static const fw_xml_attribute_row long_rows[] = {
    {"kind", .required = true, .sentence = "What it is."},
    {"length", .kind = FW_KIND_DECIMAL, .required = true, .sentence = "How long."},
};
static fw_status lid_row(fw_xml_reader *r, const fw_xml_element *e,
                         const fw_xml_element_row **row) {
    static const fw_xml_element_row made = {"lid kind=\"long\"", "box", .attribute = long_rows,
                                            .nattribute = 2, .sentence = "A long one."};
    const fw_xml_attribute *kind = fw_xml_attribute_of(e, "kind");
    *row = kind && strcmp(kind->value, "long") == 0 ? &made : NULL;
    if (!*row) fw_diag_error(r->diags, 185, e->place, "no such lid");
    return FW_OK;
}
static const fw_xml_element_row rows[] = {
    {"shelf", "", .sentence = "A shelf."},
    {"box", "shelf", "id", 1, .needed = true, .attribute = box_rows, .nattribute = 6,
     .sentence = "A box."},
    {"note", "shelf box", .once = true, .text = true, .sentence = "For people."},
    {"lid", "box", .specialise = lid_row, .sentence = "What closes it."},
    {0},
};
static const fw_xml_element_row *const parts[] = {rows, NULL};
static const char *const spaces[] = {"name", "box"};
static const fw_xml_table table = {.file = "shelf file",
                                   .root = "shelf",
                                   .urn = "urn:s",
                                   .head = "",
                                   .source = "test_xml_reader.c",
                                   .part = parts,
                                   .space = spaces,
                                   .nspace = 2,
                                   .numbers = {.root = 15,
                                               .element = 40,
                                               .misplaced = 41,
                                               .attribute = 42,
                                               .missing = 43,
                                               .name = 44,
                                               .twice = 45,
                                               .range = 47,
                                               .word = 48,
                                               .form = 141,
                                               .text = 49,
                                               .once = 51,
                                               .needed = 180,
                                               .whole = 96,
                                               .decimal = 171}};

static fw_status read(fw_arena *arena, const char *xml, fw_diags *diags, fw_xml_reader *r) {
    *diags = fw_diags_new(arena);
    return fw_xml_table_read(arena, &table, "s.xml", xml, strlen(xml), diags, r);
}

#define SHELF(text) "<shelf xmlns=\"urn:s\">\n" text "\n</shelf>"
#define BOX(text)   SHELF("<box id=\"a\" " text "/>")

/* an int has no NaN: what a failed number becomes is stated, as what an absent one is */
static void whole_numbers_that_are_none(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const struct {
        const char *xml;
        int value;
    } of[] = {{BOX("size=\"1 um\" count=\"4\""), 4},
              {BOX("size=\"1 um\""), 9},
              {BOX("size=\"1 um\" count=\"many\""), 9},
              {BOX("size=\"1 um\" count=\"1e300\""), 9}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        fw_diags diags;
        fw_xml_reader r;
        read(arena, of[i].xml, &diags, &r);
        assert_int_equal(fw_xml_whole_or(r.record->first_child, "count", 9), of[i].value);
    }
    fw_arena_free(arena);
}

static void values_are_read(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags;
    fw_xml_reader r;
    assert_int_equal(read(arena,
                          SHELF("<box id=\"a\" size=\"2*3 um\" count=\"4\" colour=\"red\" "
                                "stripes=\"red  green\" label=\"ab\"><note>hello</note>"
                                "<lid kind=\"long\" length=\"7.5\"/></box><note/><box id=\"b\"/>"),
                          &diags, &r),
                     FW_OK);
    assert_int_equal(diags.count, 0);
    const fw_xml_record *a = r.record->first_child;
    assert_int_equal(fw_xml_children(r.record, "box"), 2);
    assert_string_equal(fw_xml_text_of(a, "id"), "a");
    assert_near(fw_xml_number_of(a, "size"), 6e-6, 1e-20);
    assert_near(fw_xml_number_of(a, "count"), 4, 0);
    assert_string_equal(fw_xml_text_of(a, "stripes"), "red  green");
    assert_string_equal(a->first_child->element->text, "hello");
    assert_near(fw_xml_number_of(a->first_child->next, "length"), 7.5, 0);
    assert_true(fw_xml_is(a->next, "note") && fw_xml_is(a->next->next, "box") &&
                !a->next->next->next);
    assert_null(fw_xml_text_of(a->next->next, "colour"));
    fw_arena_free(arena);
}

static const struct {
    const char *xml;
    int number, line, column;
    const char *says;
} wrong[] = {
    {"<box xmlns=\"urn:s\"/>", 15, 1, 1, "a shelf file begins with <shelf"},
    {"<shelf xmlns=\"urn:t\"><box id=\"a\"/></shelf>", 15, 1, 1, "must be \"urn:s\""},
    {"<shelf xmlns=\"urn:s\"/>", 180, 1, 1, "<shelf> needs a <box> inside: A box."},
    {SHELF("<bx/><box id=\"a\"/>"), 40, 2, 1, "did you mean <box>?"},
    {SHELF("<box id=\"a\"/><lid/>"), 41, 2, 14, "move it into <box>"},
    {SHELF("<box id=\"a\"/><note/><note/>"), 51, 2, 21, "given twice"},
    {SHELF("<box id=\"a\">x</box>"), 49, 2, 13, "text is not expected"},
    {SHELF("<box id=\"a\"/><box id=\"a\"/>"), 45, 2, 23, "box 'a' is given twice"},
    {SHELF("<box/>"), 43, 2, 1, "<box> needs id=\"...\": Its name."},
    {BOX("colur=\"red\""), 42, 2, 13, "did you mean 'colour'?"},
    {BOX("size=\"0 um\""), 47, 2, 19, "above 0 um and at most 1000 um (it must fit)"},
    {BOX("size=\"1 s\""), 25, 2, 19, "size: "},
    {BOX("count=\"x\""), 171, 2, 20, "is not a number"},
    {BOX("count=\"1.5\""), 96, 2, 20, "whole number"},
    {BOX("count=\"10\""), 47, 2, 20, "at most 9"},
    {BOX("colour=\"gren\""), 48, 2, 21, "did you mean 'green'?"},
    {BOX("stripes=\"red blue\""), 48, 2, 22, "\"blue\" is not one of: red, green"},
    {BOX("label=\"abc\""), 141, 2, 20, "must be of even length"},
    {SHELF("<box id=\"a\"><lid kind=\"round\"/></box>"), 185, 2, 13, "no such lid"},
    {SHELF("<box id=\"a\"><lid kind=\"long\"/></box>"), 43, 2, 13,
     "<lid kind=\"long\"> needs length"},
};

static void mistakes_have_their_place(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags;
        fw_xml_reader r;
        read(arena, wrong[i].xml, &diags, &r);
        if (diags.count != 1) fail_msg("case %zu: %zu diagnostics", i, diags.count);
        const fw_diag *d = &diags.item[0];
        if (d->number != wrong[i].number || d->place.line != wrong[i].line ||
            d->place.column != wrong[i].column || !strstr(d->message, wrong[i].says))
            fail_msg("case %zu: D%03d at %d:%d: %s", i, d->number, d->place.line, d->place.column,
                     d->message);
        fw_arena_free(arena);
    }
}

static void the_schema_counts(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    assert_int_equal(fw_xml_schema(&table, &text), FW_OK);
    assert_non_null(strstr(text.data, "<oneOrMore><ref name=\"box\"/></oneOrMore>"));
    assert_non_null(strstr(text.data, "<optional><ref name=\"note\"/></optional>"));
    assert_non_null(strstr(text.data, "<data type=\"integer\"><param name=\"minInclusive\">1<"));
    assert_non_null(strstr(text.data, "<list><zeroOrMore><choice><value>red</value>"));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(values_are_read), cmocka_unit_test(whole_numbers_that_are_none),
                                       cmocka_unit_test(mistakes_have_their_place),
                                       cmocka_unit_test(the_schema_counts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
