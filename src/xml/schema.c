/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is generated from the rows of a table: schemas for editors and xmllint (the program itself
   does not use them), reference pages, and a list in JSON for forms. */
#include "base/json.h"
#include "xml/xml_reader.h"
#include <stdio.h>
#include <string.h>

static bool is_expression(fw_xml_kind kind) {
    return kind == FW_KIND_NUMBER || kind == FW_KIND_ANY || kind == FW_KIND_TIMED ||
           kind == FW_KIND_TABLE;
}

/* ---- RELAX NG ---- */

static void schema_pattern(fw_text *out, const char *pattern) {
    fw_text_printf(out, "<data type=\"string\"><param name=\"pattern\">%s</param></data>", pattern);
}

static void schema_decimal(fw_text *out, const fw_xml_attribute_row *a) {
    fw_text_printf(out, "<data type=\"%s\">", a->whole ? "integer" : "double");
    if (a->ranged) {
        fw_text_printf(out, "<param name=\"min%slusive\">", a->open ? "Exc" : "Inc");
        fw_text_number(out, a->min, 6);
        fw_text_add(out, "</param>");
    }
    fw_text_add(out, "</data>");
}

/* ---- values with units, as patterns ----
   What the program refuses by the form of a value: a lone number without the unit that is wanted, or with a unit of
   another dimension, a unit that there is not, a comma, two values side by side. A regular expression cannot count: of
   products of several units ("N m/rad") only the symbols are looked at, of longer expressions that values and operators
   alternate; parentheses, names and what comes out of it are the program's to judge. Nothing that the program takes is
   refused. Test: test_device_table.c, tests/docs/schema.py. */

#define SCHEMA_NUMBER   "([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+\\-]?[0-9]+)?"
#define SCHEMA_NAME     "[A-Za-z_][A-Za-z0-9_]*"
#define SCHEMA_SIGNS    "[\\s+\\-]*"
#define SCHEMA_EXPONENT "(\\^-?[0-9]{1,3}|[0-9]{1,3})?"
#define SCHEMA_OPEN     "[\\s+\\-(]*(" SCHEMA_NAME "\\s*\\([\\s+\\-(]*)*"
#define SCHEMA_CLOSE    "[\\s)]*"

#define SCHEMA_MICRO "\xc2\xb5\xce\xbc" /* U+00B5 and U+03BC, which stand for u */

/* a symbol in a pattern; of ours only braces mean something there */
static void schema_symbol(fw_text *out, const char *symbol) {
    if (symbol[0] == '{')
        fw_text_printf(out, "\\{%.*s\\}", (int)strlen(symbol) - 2, symbol + 1);
    else if (symbol[0] == 'u' && symbol[1])
        fw_text_printf(out, "[u" SCHEMA_MICRO "]%s", symbol + 1);
    else
        fw_text_add(out, symbol);
}

/* the exponent that takes a symbol to the dimension; 0: none does */
static int schema_exponent(const char *symbol, fw_quantity_dimension wanted) {
    enum { LARGEST = 6 };
    for (int e = -LARGEST; e <= LARGEST; e++) {
        char text[FW_LABEL];
        fw_quantity_unit unit;
        snprintf(text, sizeof text, "%s^%d", symbol, e);
        bool plain = symbol[0] == '1' || symbol[0] == '%'; /* they take no exponent */
        if (e == 0 || (plain && e != 1)) continue;
        const char *given = plain ? symbol : text;
        if (fw_quantity_unit_parse(given, strlen(given), &unit, NULL, NULL) &&
            fw_quantity_dimension_equal(unit.dimension, wanted))
            return e;
    }
    return 0;
}

/* "um|mm|...": every symbol, or with `wanted` those that have this dimension to some power */
static int schema_symbols(fw_text *out, const fw_quantity_dimension *wanted) {
    size_t n;
    int count = 0;
    const char *const *symbol = fw_quantity_unit_names(&n);
    for (size_t i = 0; i < n; i++) {
        if (strcmp(symbol[i], "1") == 0) continue; /* stands before a "/" only */
        int e = wanted ? schema_exponent(symbol[i], *wanted) : 1;
        if (e == 0) continue;
        fw_text_add(out, count++ ? "|" : "");
        schema_symbol(out, symbol[i]);
        if (!wanted || symbol[i][0] == '%') continue;
        if (e == 1)
            fw_text_add(out, "(\\^?0*1)?");
        else
            fw_text_printf(out, e > 0 ? "\\^?0*%d" : "\\^-0*%d", e > 0 ? e : -e);
    }
    return count;
}

#define SCHEMA_JOIN "(\\s+|\\s*[/*.]\\s*)"

/* one symbol with its exponent */
static void schema_factor(fw_text *out, const char *before) {
    fw_text_printf(out, "%s(", before);
    schema_symbols(out, NULL);
    fw_text_add(out, ")" SCHEMA_EXPONENT);
}

/* products of two symbols and more, of which the first may be a 1 */
static void schema_products_of(fw_text *out) {
    schema_factor(out, "((1" SCHEMA_JOIN ")?");
    schema_factor(out, "(" SCHEMA_JOIN);
    schema_factor(out, ")+|1" SCHEMA_JOIN);
    fw_text_add(out, ")");
}

#define SCHEMA_DATA "<data type=\"string\"><param name=\"pattern\">"
#define SCHEMA_END  "</param></data>\n"

/* a number alone, with the unit that it has to have; `wanted` NULL: with any, or none */
static void schema_number(fw_text *out, const char *name, const fw_quantity_dimension *wanted) {
    bool bare = !wanted || fw_quantity_dimension_equal(*wanted, (fw_quantity_dimension){0});
    size_t start = out->length;
    fw_text_printf(out, "  <define name=\"number.%s\">\n    <choice>\n", name);
    if (bare) fw_text_add(out, "      " SCHEMA_DATA SCHEMA_SIGNS SCHEMA_NUMBER "\\s*" SCHEMA_END);
    start = out->length;
    fw_text_add(out, "      " SCHEMA_DATA SCHEMA_SIGNS SCHEMA_NUMBER "\\s*(");
    if (schema_symbols(out, wanted) > 0)
        fw_text_printf(out, ")%s\\s*" SCHEMA_END, wanted ? "" : SCHEMA_EXPONENT);
    else if (!out->failed)
        out->length = start; /* only products have this dimension */
    fw_text_add(out, "      <ref name=\"product\"/>\n      <ref name=\"expression\"/>\n"
                     "    </choice>\n  </define>\n");
}

/* "torsional stiffness" as a name of XML */
static const char *schema_dimension(fw_arena *arena, fw_quantity_dimension d) {
    const char *text = fw_quantity_dimension_text(arena, d);
    if (fw_quantity_dimension_equal(d, (fw_quantity_dimension){0})) return "pure";
    char *name = fw_arena_strndup(arena, text, strlen(text));
    for (char *c = name; c && *c; c++)
        if (*c == ' ')
            *c = '.';
        else if (*c == '^')
            *c = '_';
    return name ? name : "any";
}

/* is the dimension of this attribute known? */
static bool schema_fixed(const fw_xml_attribute_row *a) {
    fw_quantity_unit unit;
    return (a->kind == FW_KIND_NUMBER || a->kind == FW_KIND_TIMED) && a->unit &&
           fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL) &&
           fw_quantity_dimension_equal(unit.dimension, a->dimension);
}

static void schema_products(fw_text *out) {
    fw_text_add(out,
                "  <define name=\"product\">\n    " SCHEMA_DATA SCHEMA_SIGNS SCHEMA_NUMBER "\\s*");
    schema_products_of(out);
    fw_text_add(out, "\\s*" SCHEMA_END "  </define>\n");
}

/* An expression: two values and more with operators between them, a name, something in parentheses, or arguments with
   commas. Written so that at most places one way is open, because libxml2 tries all of them: units are words here, and
   their "/", "*" and "^" are operators. */
#define SCHEMA_WORD "[A-Za-z" SCHEMA_MICRO "]*[0-9]{0,3}"
#define SCHEMA_ANY  "A-Za-z" SCHEMA_MICRO "0-9_.%{}\\s+\\-*/^()"

/* a number with words behind it, or a name; behind a digit an e begins a unit only where there is such a unit */
static fw_status schema_operand(fw_text *out) {
    size_t n;
    const char *const *symbol = fw_quantity_unit_names(&n);
    fw_text_add(out, "(" SCHEMA_NUMBER "((\\s+1|\\s+[A-Za-z" SCHEMA_MICRO "]" SCHEMA_WORD
                     "|\\s*%|\\s*\\{[a-z]+\\}|[A-DF-Za-df-z" SCHEMA_MICRO "]" SCHEMA_WORD);
    for (size_t i = 0; i < n; i++)
        if (symbol[i][0] == 'e' || symbol[i][0] == 'E')
            fw_text_printf(out, "|%s[0-9]{0,3}", symbol[i]);
    fw_text_add(out,
                ")((\\s+|\\s*\\.\\s*)[A-Za-z" SCHEMA_MICRO "]" SCHEMA_WORD ")*)?|" SCHEMA_NAME ")");
    return fw_text_end(out);
}

static fw_status schema_expressions(fw_text *out) {
    fw_text value = fw_text_new(out->arena);
    FW_TRY(schema_operand(&value));
    const char *v = value.data;
    fw_text_add(out, "  <define name=\"expression\">\n    <choice>\n");
    fw_text_printf(out,
                   "      " SCHEMA_DATA SCHEMA_OPEN "%s" SCHEMA_CLOSE "([+\\-*/^]" SCHEMA_OPEN
                   "%s" SCHEMA_CLOSE ")+" SCHEMA_END,
                   v, v);
    fw_text_add(out, "      " SCHEMA_DATA SCHEMA_OPEN SCHEMA_NAME SCHEMA_CLOSE SCHEMA_END);
    fw_text_printf(out,
                   "      " SCHEMA_DATA SCHEMA_SIGNS "(" SCHEMA_NAME "\\s*)?\\(" SCHEMA_OPEN
                   "%s" SCHEMA_CLOSE SCHEMA_END,
                   v);
    fw_text_add(out, "      " SCHEMA_DATA "[" SCHEMA_ANY "]*\\([" SCHEMA_ANY "]+,[," SCHEMA_ANY
                     "]+" SCHEMA_END "    </choice>\n  </define>\n");
    return FW_OK;
}

/* definitions of the dimensions that the table's attributes have, each once */
static fw_status schema_dimensions(const fw_xml_table *table, fw_text *out) {
    fw_quantity_dimension known[FW_ELEMENTS_MOST];
    int n = 0;
    const fw_xml_element_row *e;
    for (int i = 0; (e = fw_xml_row_at(table, i)) != NULL; i++) {
        fw_xml_attributes all;
        FW_TRY(fw_xml_attributes_of(out->arena, e, &all));
        for (int k = 0; k < all.count; k++) {
            const fw_xml_attribute_row *a = &all.item[k];
            bool new = schema_fixed(a) && n < FW_ELEMENTS_MOST;
            for (int j = 0; j < n; j++)
                new = new && !fw_quantity_dimension_equal(known[j], a->dimension);
            if (!new) continue;
            known[n++] = a->dimension;
            schema_number(out, schema_dimension(out->arena, a->dimension), &a->dimension);
        }
    }
    schema_number(out, "any", NULL);
    schema_products(out);
    return schema_expressions(out);
}

static void schema_value(fw_text *out, const fw_xml_attribute_row *a) {
    if (a->kind == FW_KIND_WORD || a->kind == FW_KIND_WORDS) {
        const char *open = a->kind == FW_KIND_WORD ? "" : "<list><zeroOrMore>";
        fw_text_printf(out, "%s<choice>", open);
        for (int i = 0; a->words[i]; i++)
            fw_text_printf(out, "<value>%s</value>", a->words[i]);
        fw_text_printf(out, "</choice>%s", open[0] ? "</zeroOrMore></list>" : "");
    } else if (a->datatype)
        fw_text_printf(out, "<data type=\"%s\"/>", a->datatype);
    else if (a->kind == FW_KIND_DECIMAL)
        schema_decimal(out, a);
    else if (a->kind == FW_KIND_ID || a->kind == FW_KIND_REF)
        schema_pattern(out, "[A-Za-z_][A-Za-z0-9_\\-]{0,63}");
    else if (a->kind == FW_KIND_NAME)
        schema_pattern(out, "[A-Za-z_][A-Za-z0-9_]{0,63}");
    else if (a->kind == FW_KIND_TABLE)
        schema_pattern(out, "[ -~\\s]*\\S[ -~\\s]*");
    else if (is_expression(a->kind))
        fw_text_printf(out, "<ref name=\"number.%s\"/>",
                       schema_fixed(a) ? schema_dimension(out->arena, a->dimension) : "any");
    else
        fw_text_add(out, "<text/>");
}

static void schema_attribute(fw_text *out, const fw_xml_attribute_row *a) {
    const char *open = a->required ? "" : "<optional>", *close = a->required ? "" : "</optional>";
    fw_text_printf(out, "      %s<attribute name=\"%s\">", open, a->name);
    schema_value(out, a);
    fw_text_printf(out, "</attribute>%s\n", close);
}

/* an element's definition has its name; of several rows with one name the later ones have their
   parent's besides */
static const char *definition_of(const fw_xml_table *table, const fw_xml_element_row *row,
                                 char name[FW_LABEL]) {
    if (fw_xml_row_find(table, row->name) == row) return row->name;
    snprintf(name, FW_LABEL, "%s.%.*s", row->name, (int)strcspn(row->parent, " "), row->parent);
    return name;
}

/* in any order; how often each may stand only where some row says so */
static void schema_children(const fw_xml_table *table, const fw_xml_element_row *parent,
                            fw_text *out) {
    const fw_xml_element_row *row;
    char name[FW_LABEL];
    int count = 0;
    bool counted = false;
    for (int i = 0; (row = fw_xml_row_at(table, i)) != NULL; i++) {
        if (!fw_xml_row_inside(row, parent->name)) continue;
        count++;
        counted = counted || row->once || row->needed;
    }
    if (count == 0) return;
    fw_text_add(out, counted ? "      <interleave>\n" : "      <zeroOrMore><choice>\n");
    for (int i = 0; (row = fw_xml_row_at(table, i)) != NULL; i++) {
        if (!fw_xml_row_inside(row, parent->name)) continue;
        const char *often = !counted                   ? ""
                            : row->once && row->needed ? ""
                            : row->once                ? "optional"
                            : row->needed              ? "oneOrMore"
                                                       : "zeroOrMore";
        if (often[0])
            fw_text_printf(out, "        <%s><ref name=\"%s\"/></%s>\n", often,
                           definition_of(table, row, name), often);
        else
            fw_text_printf(out, "        <ref name=\"%s\"/>\n", definition_of(table, row, name));
    }
    if (counted && parent->text) fw_text_add(out, "        <text/>\n");
    fw_text_add(out, counted ? "      </interleave>\n" : "      </choice></zeroOrMore>\n");
}

fw_status fw_xml_schema(const fw_xml_table *table, fw_text *out) {
    const fw_xml_element_row *e;
    fw_text_printf(out,
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<!-- generated from %s; do not edit -->\n"
                   "<grammar xmlns=\"http://relaxng.org/ns/structure/1.0\" "
                   "ns=\"%s\"\n"
                   "         datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\">\n"
                   "  <start><ref name=\"%s\"/></start>\n",
                   table->source, table->urn, table->root);
    for (int i = 0; (e = fw_xml_row_at(table, i)) != NULL; i++) {
        char name[FW_LABEL];
        fw_text_printf(out, "  <define name=\"%s\">\n    <element name=\"%s\">\n",
                       definition_of(table, e, name), e->name);
        fw_xml_attributes all;
        FW_TRY(fw_xml_attributes_of(out->arena, e, &all));
        for (int k = 0; k < all.count; k++)
            schema_attribute(out, &all.item[k]);
        size_t before = out->length;
        schema_children(table, e, out);
        if (out->length == before && e->text)
            fw_text_add(out, "      <text/>\n");
        else if (out->length == before && all.count == 0)
            fw_text_add(out, "      <empty/>\n");
        fw_text_add(out, "    </element>\n  </define>\n");
    }
    FW_TRY(schema_dimensions(table, out));
    fw_text_add(out, "</grammar>\n");
    return fw_text_end(out);
}

/* ---- reference page ---- */

static void page_number(fw_text *out, double value, const char *unit) {
    char buffer[FW_LABEL];
    fw_text_add(out, fw_xml_in_unit(buffer, value, unit));
}

static void page_value(const fw_xml_table *table, const fw_xml_attribute_row *a, fw_text *out) {
    switch (a->kind) {
    case FW_KIND_TEXT:
        fw_text_add(out, "text");
        break;
    case FW_KIND_FORM:
        fw_text_add(out, a->reason);
        break;
    case FW_KIND_DECIMAL:
        fw_text_add(out, a->whole ? "whole number" : "plain number");
        break;
    case FW_KIND_ID:
    case FW_KIND_NAME:
        fw_text_add(out, "name");
        break;
    case FW_KIND_ANY:
        fw_text_add(out, "expression");
        break;
    case FW_KIND_TIMED:
        fw_text_printf(out, "expression in time, %s",
                       strcmp(a->unit, "1") == 0 ? "pure number" : a->unit);
        break;
    case FW_KIND_TABLE:
        fw_text_add(out, "points `TIME: NUMBER; ...`");
        break;
    case FW_KIND_REF:
        fw_text_printf(out, "id of a %s%s", table->space[a->space],
                       a->ground ? " or `ground`" : "");
        break;
    case FW_KIND_WORD:
    case FW_KIND_WORDS:
        fw_text_add(out, a->kind == FW_KIND_WORDS ? "some of " : "");
        for (int i = 0; a->words[i]; i++)
            fw_text_printf(out, "%s`%s`", i ? ", " : "", a->words[i]);
        break;
    case FW_KIND_NUMBER:
        if (strcmp(a->unit, "1") == 0)
            fw_text_add(out, a->whole ? "whole number" : "pure number");
        else
            fw_text_printf(out, "%s, e.g. in `%s`",
                           fw_quantity_dimension_text(out->arena, a->dimension), a->unit);
        break;
    }
}

static void page_range(fw_text *out, const fw_xml_attribute_row *a) {
    if (!a->ranged) return;
    fw_text_add(out, a->open ? " Above " : " At least ");
    page_number(out, a->min, a->unit);
    fw_text_add(out, ", at most ");
    page_number(out, a->max, a->unit);
    fw_text_printf(out, " (%s).", a->reason);
}

void fw_xml_page_attribute(const fw_xml_table *table, const fw_xml_attribute_row *a, fw_text *out) {
    fw_text_printf(out, "| `%s` | ", a->name);
    page_value(table, a, out);
    fw_text_printf(out, " | %s | %s",
                   a->required   ? "**required**"
                   : a->fallback ? a->fallback
                                 : "",
                   a->sentence);
    page_range(out, a);
    fw_text_add(out, " |\n");
}

void fw_xml_page_element(const fw_xml_element_row *e, fw_text *out) {
    fw_text_printf(out, "\n### `<%s>`\n\n%s", e->name, e->sentence);
    const char *parents = e->parent;
    for (fw_word word; fw_word_next(&parents, " ", &word);)
        fw_text_printf(out, "%s `<%.*s>`", word.at == e->parent ? " Inside" : " or",
                       (int)word.length, word.at);
    if (e->parent[0])
        fw_text_printf(out, "%s.",
                       e->once && e->needed ? ", exactly once"
                       : e->once            ? ", at most once"
                       : e->needed          ? ", at least once"
                                            : "");
    fw_text_add(out, "\n");
}

/* ---- JSON ---- */

static const char *const kind_text[] = {
    [FW_KIND_TEXT] = "text",     [FW_KIND_ID] = "id",         [FW_KIND_NAME] = "name",
    [FW_KIND_WORD] = "word",     [FW_KIND_NUMBER] = "number", [FW_KIND_ANY] = "expression",
    [FW_KIND_TIMED] = "in-time", [FW_KIND_TABLE] = "table",   [FW_KIND_REF] = "reference",
    [FW_KIND_WORDS] = "words",   [FW_KIND_FORM] = "form",     [FW_KIND_DECIMAL] = "decimal"};

/* in the unit of the row, to the digits that messages have */
static void json_bound(fw_json *out, const char *key, const fw_xml_attribute_row *a, double value) {
    fw_quantity_unit unit = {.factor = 1.0};
    if (a->unit && a->unit[0]) fw_quantity_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL);
    if (a->ranged)
        fw_json_number(out, key, fw_quantity_unit_from_si(&unit, value), 12);
    else
        fw_json_null(out, key);
}

static void json_attribute(const fw_xml_table *table, const fw_xml_attribute_row *a, fw_json *out) {
    bool fixed = a->kind == FW_KIND_NUMBER || a->kind == FW_KIND_TIMED;
    fw_json_object(out, NULL);
    fw_json_text(out, "name", a->name);
    fw_json_text(out, "type", kind_text[a->kind]);
    fw_json_text(out, "unit", is_expression(a->kind) ? a->unit : NULL);
    fw_json_text(out, "dimension",
                 fixed ? fw_quantity_dimension_text(out->out->arena, a->dimension) : NULL);
    fw_json_text(out, "default", a->fallback);
    json_bound(out, "minimum", a, a->min);
    json_bound(out, "maximum", a, a->max);
    fw_json_truth(out, "above_minimum", a->open);
    fw_json_truth(out, "whole", a->whole);
    fw_json_truth(out, "required", a->required);
    fw_json_text(out, "range_reason", a->ranged ? a->reason : NULL);
    if (a->words) {
        fw_json_list(out, "choices");
        for (int i = 0; a->words[i]; i++)
            fw_json_text(out, NULL, a->words[i]);
        fw_json_end(out);
    } else
        fw_json_null(out, "choices");
    fw_json_text(out, "refers_to", a->kind == FW_KIND_REF ? table->space[a->space] : NULL);
    fw_json_truth(out, "ground", a->ground);
    fw_json_text(out, "sentence", a->sentence);
    fw_json_end(out);
}

static fw_status json_element(const fw_xml_table *table, const fw_xml_element_row *row,
                              fw_json *out) {
    fw_xml_attributes all;
    FW_TRY(fw_xml_attributes_of(out->out->arena, row, &all));
    fw_json_object(out, NULL);
    fw_json_text(out, "name", row->name);
    fw_json_text(out, "parent", row->parent[0] ? row->parent : NULL);
    fw_json_text(out, "key", row->key);
    fw_json_text(out, "id_space", row->space ? table->space[row->space] : NULL);
    fw_json_truth(out, "once", row->once);
    if (row->most > 0)
        fw_json_whole(out, "most", row->most);
    else
        fw_json_null(out, "most");
    fw_json_text(out, "sentence", row->sentence);
    fw_json_list(out, "attributes");
    for (int k = 0; k < all.count; k++) {
        fw_json_line(out, 2);
        json_attribute(table, &all.item[k], out);
    }
    fw_json_end(out);
    fw_json_end(out);
    return FW_OK;
}

fw_status fw_xml_table_json(const fw_xml_table *table, fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    const fw_xml_element_row *row;
    fw_json_list(out, NULL);
    for (int i = 0; (row = fw_xml_row_at(table, i)) != NULL; i++) {
        fw_json_line(out, 0);
        FW_TRY(json_element(table, row, out));
    }
    fw_json_end(out);
    return fw_json_finish(out, "");
}
