/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes to the text of a description: only the bytes that were meant change, there and back. */
#include "device/edit.h"
#include "xml/xml.h"
#include "files.h"
#include <stdbool.h>
#include <stdlib.h>

static fw_arena *arena;

static int fresh(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}

static int gone(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static fw_status edit(const char *xml, size_t n, const fw_device_text_change *change, int nchange,
                      fw_text *out, fw_diags *diags) {
    *diags = fw_diags_new(arena);
    *out = fw_text_new(arena);
    return fw_device_edit(arena, "t.xml", xml, n, change, nchange, diags, out);
}

static fw_device_text_change set(const char *path, const char *value) {
    return (fw_device_text_change){.kind = FW_CHANGE_SET, .path = path, .value = value};
}

/* the result of changes that can be made */
static const char *changed(const char *xml, const fw_device_text_change *change, int nchange) {
    fw_text out;
    fw_diags diags;
    if (edit(xml, strlen(xml), change, nchange, &out, &diags) != FW_OK)
        fail_msg("%s: %s", change->path, diags.count ? diags.item[0].message : "?");
    assert_int_equal(strlen(out.data), out.length);
    return out.data;
}

static void refused(const char *xml, fw_device_text_change change, const char *says) {
    fw_text out;
    fw_diags diags;
    assert_int_equal(edit(xml, strlen(xml), &change, 1, &out, &diags), FW_INPUT);
    if (diags.errors < 1 || diags.item[diags.count - 1].number != 288 ||
        !strstr(diags.item[diags.count - 1].message, says))
        fail_msg("'%s' expected, got '%s'", says,
                 diags.count ? diags.item[diags.count - 1].message : "");
}

/* ---- every attribute of the gallery ---- */

typedef struct place {
    char path[512];
    size_t offset, length; /* of the value in the text */
    char value[1024];
} place;

static int number_among_sisters(const fw_xml_element *e) {
    int n = 1;
    for (const fw_xml_element *s = e->parent ? e->parent->first_child : NULL; s && s != e;
         s = s->next)
        n += strcmp(s->name, e->name) == 0;
    return n;
}

static void path_of(const fw_xml_element *e, char *path, size_t n) {
    char above[512] = "";
    if (e->parent) path_of(e->parent, above, sizeof above);
    snprintf(path, n, "%.400s%s%.60s[%d]", above, above[0] ? "/" : "", e->name,
             number_among_sisters(e));
}

static int collect(const fw_xml_element *e, place *to, int n, int most) {
    for (; e; e = e->next) {
        for (int i = 0; i < e->nattribute; i++) {
            const fw_xml_attribute *a = &e->attribute[i];
            if (!a->raw) continue;
            assert_true(n < most);
            char element[480];
            path_of(e, element, sizeof element);
            snprintf(to[n].path, sizeof to[n].path, "%.440s/@%.60s", element, a->name);
            to[n].offset = a->value_offset, to[n].length = a->raw_length;
            snprintf(to[n].value, sizeof to[n].value, "%s", a->value);
            n++;
        }
        n = collect(e->first_child, to, n, most);
    }
    return n;
}

/* another spelling and back is the same text; in between, only that value is another */
static void every_attribute_there_and_back(void **state) {
    (void)state;
    static const char *const file[] = {"reference-six-bar", "comb-stage",         "copper-nodder",
                                       "four-tendons",      "free-form-four-bar", "leaf-four-bar"};
    enum { MOST = 600 };
    place *at = calloc(MOST, sizeof *at);
    assert_non_null(at);
    int attributes = 0;
    for (size_t k = 0; k < sizeof file / sizeof file[0]; k++) {
        char name[128];
        size_t n;
        snprintf(name, sizeof name, "docs/gallery/%s/device.xml", file[k]);
        fw_mark whole = fw_arena_mark(arena);
        const char *xml = load(arena, name, &n);
        fw_diags diags = fw_diags_new(arena);
        fw_xml_element *root;
        assert_int_equal(fw_xml_read(arena, name, xml, n, &diags, &root), FW_OK);
        int count = collect(root, at, 0, MOST);
        assert_true(count > 40);
        attributes += count;
        for (int i = 0; i < count; i++) {
            static const char other[] = "1.5 & <\"x\"> um";
            static const char raw[] = "1.5 &amp; &lt;&quot;x&quot;> um";
            fw_mark mark = fw_arena_mark(arena);
            fw_text out, back;
            fw_device_text_change there = set(at[i].path, other),
                                  here = set(at[i].path, at[i].value);
            if (edit(xml, n, &there, 1, &out, &diags) != FW_OK)
                fail_msg("%s %s: %s", name, at[i].path, diags.item[0].message);
            assert_int_equal(out.length, n - at[i].length + strlen(raw));
            assert_memory_equal(out.data, xml, at[i].offset);
            assert_memory_equal(out.data + at[i].offset, raw, strlen(raw));
            assert_memory_equal(out.data + at[i].offset + strlen(raw),
                                xml + at[i].offset + at[i].length, n - at[i].offset - at[i].length);
            assert_int_equal(edit(out.data, out.length, &here, 1, &back, &diags), FW_OK);
            assert_int_equal(back.length, n);
            assert_memory_equal(back.data, xml, n);
            fw_arena_rewind(arena, mark);
        }
        fw_arena_rewind(arena, whole);
    }
    assert_true(attributes > 400);
    free(at);
}

/* ---- paths ---- */

#define TWO                                                                                        \
    "<device xmlns=\"urn:flexwright:device:1\" name='d'><!-- <flexure id=\"A\" length=\"1\"/> -->" \
    "\n  <parameter name=\"arc\" value=\"1 deg\"/> <!-- kept -->"                                  \
    "\n  <scene name=\"one\"><force on=\"x\" fx=\"1\"/><force on=\"x\" fx=\"2\"/></scene>"         \
    "\n  <scene name=\"two\"><force on=\"x\" fx=\"3\"/></scene>\n</device>\n"

static void paths_find_one_place(void **state) {
    (void)state;
    static const struct {
        const char *path, *before, *after;
    } row[] = {
        {"arc", "value=\"1 deg\"", "value=\"9\""},
        {"parameter[arc]/@value", "value=\"1 deg\"", "value=\"9\""},
        {"parameter[1]/@value", "value=\"1 deg\"", "value=\"9\""},
        {"force[3]/@fx", "fx=\"3\"", "fx=\"9\""},
        {"scene[one]/force[2]/@fx", "fx=\"2\"", "fx=\"9\""},
        {"scene[2]/force/@fx", "fx=\"3\"", "fx=\"9\""},
        {"device/scene[two]/force[1]/@fx", "fx=\"3\"", "fx=\"9\""},
        {"device/@name", "name='d'", "name='9'"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_device_text_change c = set(row[i].path, "9");
        const char *got = changed(TWO, &c, 1);
        const char *at = strstr(TWO, row[i].before);
        assert_non_null(at);
        size_t head = (size_t)(at - TWO);
        assert_memory_equal(got, TWO, head);
        assert_memory_equal(got + head, row[i].after, strlen(row[i].after));
        assert_string_equal(got + head + strlen(row[i].after), at + strlen(row[i].before));
    }
}

static void places_that_are_not_there(void **state) {
    (void)state;
    refused(TWO, set("force/@fx", "1"), "several");
    refused(TWO, set("flexure[A]/@length", "1"), "no such element"); /* only in a comment */
    refused(TWO, set("force[4]/@fx", "1"), "no such element");
    refused(TWO, set("force[0]/@fx", "1"), "begin with 1");
    refused(TWO, set("force[99999999999999999999]/@fx", "1"), "no such element");
    refused(TWO, set("scene[three]/@name", "1"), "no such element");
    refused(TWO, set("nobody", "1"), "no such element");
    refused(TWO, set("scene[one]/@nme", "1"), "did you mean 'name'");
    refused(TWO, set("scene[one]/@a b", "1"), "no attribute can be called");
    refused(TWO, set("scene[one]", "1"), "an attribute is missing");
    refused(TWO, set("", "1"), "no path");
    refused(TWO, set("/@x", "1"), "no path");
    refused(TWO, set("scene[/@x", "1"), "no path");
    refused(TWO, set("scene[]/@x", "1"), "no path");
    refused(TWO, set("scene[one]x/@name", "1"), "no path");
    refused(TWO, set("scene[one]//@name", "1"), "no path");
    refused(TWO, set("scene[one]/@flow", NULL), "to take out");
    refused(TWO, set("arc", "\x01"), "no longer XML");
    refused(TWO, (fw_device_text_change){.kind = FW_CHANGE_REMOVE, .path = "device"},
            "whole device");
    refused(TWO, (fw_device_text_change){.kind = FW_CHANGE_REMOVE, .path = "arc/@x"},
            "no such element");
    refused(TWO,
            (fw_device_text_change){.kind = FW_CHANGE_ADD, .path = "scene[one]", .element = "a b"},
            "no element can be called");
    refused(
        TWO,
        (fw_device_text_change){.kind = FW_CHANGE_ADD, .path = "scene[one]/@name", .element = "a"},
        "added to an element");
}

static void text_that_is_no_xml_is_said_with_its_place(void **state) {
    (void)state;
    fw_text out;
    fw_diags diags;
    fw_device_text_change c = set("arc", "1");
    static const char broken[] = "<device>\n  <a b=c/>\n</device>";
    assert_int_equal(edit(broken, strlen(broken), &c, 1, &out, &diags), FW_INPUT);
    assert_true(diags.errors == 1 && diags.item[0].place.line == 2);
}

/* ---- attributes and elements that come and go ---- */

static void attributes_come_and_go(void **state) {
    (void)state;
    fw_device_text_change in = set("scene[one]/force[2]/@fy", "3 N"),
                          out = set("scene[one]/force[2]/@fy", NULL);
    const char *with = changed(TWO, &in, 1);
    assert_non_null(strstr(with, "<force on=\"x\" fx=\"2\" fy=\"3 N\"/>"));
    assert_string_equal(changed(with, &out, 1), TWO);
    fw_device_text_change first = set("scene[one]/force[1]/@on", NULL);
    assert_non_null(strstr(changed(TWO, &first, 1), "<force fx=\"1\"/><force on"));
    /* '=' and '>' in values, spaces around '=' */
    static const char odd[] = "<device><limits safety-factor = '=>' cycles='2'/></device>";
    fw_device_text_change odd_out = set("limits/@safety-factor", NULL);
    assert_string_equal(changed(odd, &odd_out, 1), "<device><limits cycles='2'/></device>");
    fw_device_text_change bare = set("limits/@cycles", "5");
    assert_string_equal(changed("<device><limits/></device>", &bare, 1),
                        "<device><limits cycles=\"5\"/></device>");
    assert_string_equal(changed("<device><limits  ></limits></device>", &bare, 1),
                        "<device><limits cycles=\"5\"  ></limits></device>");
}

static void elements_come_and_go(void **state) {
    (void)state;
    static const char lines[] = "<device>\n    <scene name=\"s\">\n        <force on=\"a\"/>\n"
                                "        <!-- last -->\n    </scene>\n    <die/>\n</device>\n";
    const fw_device_text_attribute given[] = {{"on", "CD"}, {"fx", "1 \"<N>\""}};
    fw_device_text_change add = {.kind = FW_CHANGE_ADD,
                                 .path = "scene[s]",
                                 .element = "force",
                                 .attribute = given,
                                 .nattribute = 2};
    fw_device_text_change remove = {.kind = FW_CHANGE_REMOVE, .path = "scene[s]/force[2]"};
    const char *with = changed(lines, &add, 1);
    assert_string_equal(with, "<device>\n    <scene name=\"s\">\n        <force on=\"a\"/>\n"
                              "        <!-- last -->\n"
                              "        <force on=\"CD\" fx=\"1 &quot;&lt;N>&quot;\"/>\n"
                              "    </scene>\n    <die/>\n</device>\n");
    assert_string_equal(changed(with, &remove, 1), lines);
    /* into an element that closes itself, into the root, on one line, with DOS line ends */
    fw_device_text_change inner = {.kind = FW_CHANGE_ADD, .path = "die", .element = "x"};
    assert_non_null(
        strstr(changed(lines, &inner, 1), "    <die>\n      <x/>\n    </die>\n</device>"));
    fw_device_text_change root = {.kind = FW_CHANGE_ADD, .path = "", .element = "flow"};
    assert_non_null(strstr(changed(lines, &root, 1), "    <die/>\n    <flow/>\n</device>\n"));
    assert_string_equal(changed("<device></device>", &root, 1), "<device>\n  <flow/>\n</device>");
    assert_string_equal(changed("<device/>", &root, 1), "<device>\n  <flow/>\n</device>");
    assert_string_equal(changed("<device>\r\n\t<die/>\r\n</device>\r\n", &root, 1),
                        "<device>\r\n\t<die/>\r\n\t<flow/>\r\n</device>\r\n");
    assert_string_equal(changed("<d:device xmlns:d='u'/>", &root, 1),
                        "<d:device xmlns:d='u'>\n  <flow/>\n</d:device>");
    /* what is removed takes its children and its line along, and leaves what shares the line */
    fw_device_text_change scene = {.kind = FW_CHANGE_REMOVE, .path = "scene[s]"};
    assert_string_equal(changed(lines, &scene, 1), "<device>\n    <die/>\n</device>\n");
    fw_device_text_change first = {.kind = FW_CHANGE_REMOVE, .path = "scene[one]/force[1]"};
    assert_non_null(
        strstr(changed(TWO, &first, 1), "<scene name=\"one\"><force on=\"x\" fx=\"2\"/></scene>"));
    fw_device_text_change tricky = {.kind = FW_CHANGE_REMOVE, .path = "a"};
    assert_string_equal(changed("<d><a x='/>'><!-- </a> --><a/><![CDATA[</a>]]></a><b/></d>",
                                &(fw_device_text_change){.kind = FW_CHANGE_REMOVE, .path = "a[1]"},
                                1),
                        "<d><b/></d>");
    refused("<d><a/><a/></d>", tricky, "several");
}

static void several_changes_are_all_or_nothing(void **state) {
    (void)state;
    fw_device_text_change both[] = {set("arc", "2 deg"), set("scene[two]/force/@fx", "4")};
    const char *got = changed(TWO, both, 2);
    assert_non_null(strstr(got, "value=\"2 deg\""));
    assert_non_null(strstr(got, "fx=\"4\""));
    assert_non_null(strstr(got, "<!-- kept -->"));
    both[1].path = "scene[nobody]/@name";
    fw_text out;
    fw_diags diags;
    assert_int_equal(edit(TWO, strlen(TWO), both, 2, &out, &diags), FW_INPUT);
    assert_int_equal(out.length, 0);
    assert_string_equal(changed(TWO, both, 0), TWO);
}

/* the file's unit, of an attribute or through the parameters that it names */
static void units_as_they_are_written(void **state) {
    (void)state;
    static const char text[] =
        "<device><parameter name='turn' value='-2 deg'/><parameter name='half' value='turn/2'/>"
        "<parameter name='far' value='0.2 mm'/><parameter name='n' value='3'/>"
        "<parameter name='area' value='far*far'/>"
        "<workspace x-min='-far' x-max='150 um' phi-min='half*n' phi-max='1 mrad + 2 deg'/>"
        "<scene name='s'><torque on='x' value='3 uN * 2 mm'/><force on='x' fx='area*(2 Pa)'/>"
        "</scene></device>";
    const fw_quantity_dimension length = {.m = 1}, angle = {.rad = 1}, area = {.m = 2},
                                force = {1, 1, -2, 0, 0, 0, 0, 0};
    const struct {
        const char *path;
        fw_quantity_dimension dimension;
        const char *unit;
    } row[] = {{"workspace[1]/@x-max", length, "um"},
               {"workspace[1]/@x-min", length, "mm"},
               {"workspace/@phi-min", angle, "deg"},
               {"workspace/@phi-max", angle, "mrad"},
               {"workspace/@y-max", length, ""},
               {"workspace[2]/@x-max", length, ""},
               {"half", angle, "deg"},
               {"area", area, ""},
               {"nobody", length, ""},
               {"scene[s]/torque[1]/@value", force, "uN"},
               {"scene[s]/force[1]/@fx", force, ""}};
    fw_device_parameter parameter[] = {{.name = "turn", .dimension = angle},
                                             {.name = "half", .dimension = angle},
                                             {.name = "far", .dimension = length},
                                             {.name = "n"},
                                             {.name = "area", .dimension = area}};
    fw_device device = {.file = "t.xml", .source = text, .source_length = sizeof text - 1};
    const fw_device_written *written;
    const char *unit;
    device.parameter = parameter;
    device.nparameter = sizeof parameter / sizeof *parameter;
    assert_int_equal(fw_device_written_open(arena, &device, &written), FW_OK);
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        assert_int_equal(
            fw_device_written_unit(arena, written, row[i].path, row[i].dimension, &unit), FW_OK);
        if (strcmp(unit, row[i].unit) != 0)
            fail_msg("%s: '%s' expected, got '%s'", row[i].path, row[i].unit, unit);
    }
    device.source = NULL; /* made by a program, not read */
    assert_int_equal(fw_device_written_open(arena, &device, &written), FW_OK);
    assert_int_equal(fw_device_written_unit(arena, written, "half", angle, &unit), FW_OK);
    assert_string_equal(unit, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_attribute_there_and_back, fresh, gone),
        cmocka_unit_test_setup_teardown(paths_find_one_place, fresh, gone),
        cmocka_unit_test_setup_teardown(places_that_are_not_there, fresh, gone),
        cmocka_unit_test_setup_teardown(text_that_is_no_xml_is_said_with_its_place, fresh, gone),
        cmocka_unit_test_setup_teardown(attributes_come_and_go, fresh, gone),
        cmocka_unit_test_setup_teardown(elements_come_and_go, fresh, gone),
        cmocka_unit_test_setup_teardown(several_changes_are_all_or_nothing, fresh, gone),
        cmocka_unit_test_setup_teardown(units_as_they_are_written, fresh, gone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
