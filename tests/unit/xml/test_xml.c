/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "xml/xml.h"
#include "test.h"

static fw_xml_element *parse(fw_arena *arena, const char *text) {
    fw_diags diags = fw_diags_new(arena);
    fw_xml_element *root;
    fw_status s = fw_xml_read(arena, "t.xml", text, strlen(text), &diags, &root);
    if (s != FW_OK) fail_msg("%s", diags.count ? diags.item[0].message : fw_status_text(s));
    return root;
}

static void assert_place(fw_place place, int line, int column) {
    if (place.line != line || place.column != column)
        fail_msg("place %d:%d, expected %d:%d", place.line, place.column, line, column);
}

static void places_of_everything(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *text = "<?xml version=\"1.0\"?>\n"
                       "<!-- <not a=\"tag\"> -->\n"
                       "<r xmlns=\"urn:x\"\n"
                       "   first = 'one'  second=\"a > b\">\n"
                       "  hello\n"
                       "  <c\n"
                       "\td=\"1\"/><![CDATA[<x y=\"z\">]]>\n"
                       "  <c e=\"\xc3\xa9\" f=\"2\">  text </c>\n"
                       "</r>\n";
    fw_xml_element *r = parse(arena, text);
    assert_string_equal(r->name, "r");
    assert_string_equal(r->space, "urn:x");
    assert_place(r->place, 3, 1);
    assert_int_equal(r->nattribute, 2); /* declarations of namespaces are not among them */
    assert_place(r->attribute[0].place, 4, 13);
    assert_place(r->attribute[0].name_place, 4, 4);
    assert_place(r->attribute[1].place, 4, 27);
    assert_string_equal(r->attribute[1].value, "a > b");
    assert_int_equal(r->attribute[1].exact, 1);
    assert_int_equal(memcmp(text + r->attribute[0].value_offset, "one", 3), 0);
    assert_place(r->text_place, 5, 3);
    assert_non_null(strstr(r->text, "<x y=\"z\">"));
    fw_xml_element *c = r->first_child, *d = c->next;
    assert_place(c->place, 6, 3);
    assert_place(c->attribute[0].place, 7, 5);
    assert_string_equal(c->text, "");
    assert_place(d->place, 8, 3);
    assert_place(d->attribute[1].place, 8, 16); /* columns count bytes: the letter has two */
    assert_string_equal(d->text, "text");
    assert_place(d->text_place, 8, 21);
    assert_ptr_equal(d, r->last_child);
    assert_ptr_equal(d->parent, r);
    assert_null(d->next);
    assert_null(fw_xml_attribute_of(d, "nothing"));
    assert_ptr_equal(fw_xml_attribute_of(d, "f"), &d->attribute[1]);
    fw_arena_free(arena);
}

/* a document that ends anywhere is told the same, whatever lies in memory behind its end */
static void nothing_behind_the_end_counts(void **state) {
    (void)state;
    static const char *const text[] = {("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- a -->\n<r xmlns=\"urn:x\" a='1'>\n<c>t&lt;&#65;</c>"
                                        "<![CDATA[x]]>\n<?pi x?><d e=\"\xc3\xa9\"/></r>\n"),
                                       "<r><!DOCTYPE x></r>", "<!DOCTYPE r [<!ENTITY a \"b\">]><r>&a;</r>"};
    static const char *const behind[] = {"", "d", "-- -->", "[CDATA[", "?>", "\"/></r>", ";", "\xa9", "DOCTYPE", "xml "};
    for (size_t t = 0; t < sizeof text / sizeof *text; t++)
        for (size_t n = 1; n < strlen(text[t]); n++) {
            char first[300] = "", said[300];
            for (size_t k = 0; k < sizeof behind / sizeof *behind; k++) {
                fw_arena *arena = fw_arena_new(0);
                fw_diags diags = fw_diags_new(arena);
                fw_xml_element *root;
                char *all = fw_arena_printf(arena, "%.*s%s", (int)n, text[t], behind[k]);
                int status = (int)fw_xml_read(arena, "t.xml", all, n, &diags, &root);
                const fw_diag *d = diags.count ? &diags.item[0] : NULL;
                snprintf(said, sizeof said, "%d: %d at %d:%d %.200s", status, d ? d->number : 0, d ? d->place.line : 0, d ? d->place.column : 0,
                         d ? d->message : "");
                if (k == 0) memcpy(first, said, sizeof first);
                if (strcmp(first, said) != 0) fail_msg("%zu of %zu, with \"%s\" behind: %s, else %s", n, t, behind[k], said, first);
                fw_arena_free(arena);
            }
        }
}

static void values_with_entities_are_not_exact(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_xml_element *r = parse(arena, "<r a=\"1 &lt; 2\" b=\"x\ny\tz\" c=\"&#181;m\" d=\"\"/>");
    const fw_xml_attribute *a = r->attribute;
    assert_string_equal(a[0].value, "1 < 2");
    assert_int_equal(a[0].exact, 0);
    assert_place(fw_xml_inside(&a[0], 3), 1, 7); /* only the value's own place is known */
    assert_string_equal(a[1].value, "x y z");
    assert_int_equal(a[1].exact, 1);
    assert_place(fw_xml_inside(&a[1], 0), 1, 20);
    assert_place(fw_xml_inside(&a[1], 4), 2, 3);
    assert_string_equal(a[2].value, "\xc2\xb5m");
    assert_int_equal(a[2].exact, 0);
    assert_int_equal(a[3].exact, 1);
    assert_place(fw_xml_inside(&a[3], 9), a[3].place.line, a[3].place.column);
    fw_arena_free(arena);
}

static void a_mark_and_line_ends(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_xml_element *r = parse(arena, "\xef\xbb\xbf<r>\r\n<c a=\"1\"/>\r\n</r>");
    assert_place(r->place, 1, 4);
    assert_place(r->first_child->place, 2, 1);
    assert_place(r->first_child->attribute[0].place, 2, 7);
    fw_arena_free(arena);
}

/* beyond 65535 lines, where libxml2's own counting may stop */
static void many_lines(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "<r>");
    for (int i = 0; i < 70000; i++)
        fw_text_add(&text, "\n");
    fw_text_add(&text, " <c a='1'/></r>");
    fw_xml_element *r = parse(arena, text.data);
    assert_place(r->first_child->place, 70001, 2);
    assert_place(r->first_child->attribute[0].place, 70001, 8);
    fw_arena_free(arena);
}

static void many_elements_keep_their_places(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "<r>\n");
    for (int i = 0; i < 19990; i++)
        fw_text_printf(&text, "<c%d a='%d'>t</c%d>\n", i, i, i);
    fw_text_add(&text, "</r>");
    fw_xml_element *r = parse(arena, text.data);
    int i = 0;
    for (fw_xml_element *c = r->first_child; c; c = c->next, i++) {
        char name[16], value[16];
        snprintf(name, sizeof name, "c%d", i);
        snprintf(value, sizeof value, "%d", i);
        assert_string_equal(c->name, name);
        assert_string_equal(c->attribute[0].value, value);
        assert_place(c->place, i + 2, 1);
        assert_place(c->attribute[0].place, i + 2, 7 + (int)strlen(value));
        assert_int_equal(c->attribute[0].exact, 1);
        assert_place(c->text_place, i + 2, 9 + 2 * (int)strlen(value));
    }
    assert_int_equal(i, 19990);
    fw_arena_free(arena);
}

/* a break in a value is a blank, whether it was written or given by its number; other numbers are characters */
static void values_are_lines(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_xml_element *r =
        parse(arena, "<r a=\"x&#10;y&#13;z&#x9;\n!\" b=\"&#xb5;&#955;&#x1F600;\"/>");
    assert_string_equal(r->attribute[0].value, "x y z  !");
    assert_int_equal(r->attribute[0].exact, 0);
    assert_string_equal(r->attribute[1].value, "\xc2\xb5\xce\xbb\xf0\x9f\x98\x80");
    fw_arena_free(arena);
}

static void memory_runs_out(void **state) {
    (void)state;
    const char *text = "<r a='1' b='2'>x<c d='3'/>y</r>";
    for (int ever = 0; ever < 2; ever++)
        for (long n = 1;; n++) {
            fw_arena *arena = fw_arena_new(0);
            fw_diags diags = fw_diags_new(arena);
            fw_xml_element *root;
            fw_arena_fail_at(n, ever);
            fw_status s = fw_xml_read(arena, "t", text, strlen(text), &diags, &root);
            long used = fw_arena_count();
            fw_arena_fail_at(0, 0);
            assert_int_equal(s, used >= n ? FW_NOMEM : FW_OK);
            assert_true((root != NULL) == (s == FW_OK));
            fw_arena_free(arena);
            if (used < n) break;
        }
}

/* elements and texts in their order, values without their prefixes, entities and sections as what they stand for */
static void documents_as_trees(void **state) {
    (void)state;
    const char *text = "<?xml version='1.0'?><!-- c --><s xmlns:x='u' x:href='#a&amp;b' k='1'>t&lt;<b/>u<![CDATA[<v>]]></s>";
    fw_arena *arena = fw_arena_new(0);
    fw_xml_node *root;
    int line = -1;
    assert_int_equal(fw_xml_tree(arena, text, strlen(text), &root, &line), FW_OK);
    assert_string_equal(root->name, "s");
    assert_string_equal(fw_xml_node_value(root, "href"), "#a&b");
    assert_string_equal(fw_xml_node_value(root, "k"), "1");
    assert_null(fw_xml_node_value(root, "x"));
    assert_string_equal(root->first->text, "t<");
    assert_null(root->first->name);
    assert_string_equal(root->first->next->name, "b");
    assert_ptr_equal(root->first->next->parent, root);
    assert_string_equal(root->last->text, "u<v>");
    assert_null(root->last->next);
    static const struct {
        const char *text;
        int line;
    } bad[] = {{"", 1}, {"x", 1}, {"<a>\n<b>\n</a>", 3}, {"<a>", 1}, {"<a/>\n<b/>", 2},
               {"\n<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", 2}, {"<a>&b;</a>", 1}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(fw_xml_tree(arena, bad[i].text, strlen(bad[i].text), &root, &line), FW_INPUT);
        assert_int_equal(line, bad[i].line);
    }
    fw_arena_free(arena);
    for (long n = 1;; n++) {
        arena = fw_arena_new(0);
        fw_arena_fail_at(n, 0);
        const fw_status s = fw_xml_tree(arena, text, strlen(text), &root, &line);
        const long used = fw_arena_count();
        fw_arena_fail_at(0, 0);
        fw_arena_free(arena);
        assert_int_equal(s, used >= n ? FW_NOMEM : FW_OK);
        if (used < n) break;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(documents_as_trees),
        cmocka_unit_test(places_of_everything),
        cmocka_unit_test(nothing_behind_the_end_counts),
        cmocka_unit_test(values_with_entities_are_not_exact),
        cmocka_unit_test(a_mark_and_line_ends),
        cmocka_unit_test(many_lines),
        cmocka_unit_test(many_elements_keep_their_places),
        cmocka_unit_test(values_are_lines),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
