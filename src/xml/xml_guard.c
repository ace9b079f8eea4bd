/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The raw bytes: where tags and attributes stand, and what a file may not hold. That is refused
   here, so that no parser has to be trusted with it, and every refusal has an exact place. */
#include "base/text.h"
#include "xml/xml.h"
#include <string.h>

/* ---- where tags and attributes stand ---- */

fw_place fw_xml_place_at(const char *file, fw_xml_bytes xml, size_t offset) {
    fw_place place = {file, 1, 1};
    size_t start = 0;
    if (offset > xml.n) offset = xml.n;
    for (;;) {
        const char *end = memchr(xml.data + start, '\n', offset - start);
        if (!end) break;
        start = (size_t)(end - xml.data) + 1;
        place.line++;
    }
    place.column = (int)(offset - start) + 1;
    return place;
}

int fw_xml_starts_with(fw_xml_bytes xml, size_t at, const char *what) {
    size_t length = strlen(what);
    return xml.n - at >= length && memcmp(xml.data + at, what, length) == 0;
}

/* by the first byte of `what`: a checker of memory may look at all that a search by memmem is given, which is the rest of
   the file at each tag */
size_t fw_xml_find(fw_xml_bytes xml, size_t at, const char *what) {
    while (at < xml.n) {
        const char *first = memchr(xml.data + at, what[0], xml.n - at);
        if (!first) break;
        at = (size_t)(first - xml.data);
        if (fw_xml_starts_with(xml, at, what)) return at;
        at++;
    }
    return xml.n;
}

static int is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

size_t fw_xml_next_tag(fw_xml_bytes xml, size_t at) {
    for (;;) {
        at = fw_xml_find(xml, at, "<");
        if (at + 1 >= xml.n) return xml.n;
        if (fw_xml_starts_with(xml, at, "<!--"))
            at = fw_xml_find(xml, at + 4, "-->");
        else if (fw_xml_starts_with(xml, at, "<![CDATA["))
            at = fw_xml_find(xml, at + 9, "]]>");
        else if (xml.data[at + 1] == '?')
            at = fw_xml_find(xml, at + 2, "?>");
        else if (xml.data[at + 1] == '/' || xml.data[at + 1] == '!')
            at++;
        else
            return at;
    }
}

int fw_xml_next_attribute(fw_xml_bytes xml, size_t at, fw_xml_raw_attribute *a) {
    const char *s = xml.data;
    /* at stands behind the element's name or a closing quote */
    while (at < xml.n && (is_space(s[at]) || s[at] == '/'))
        at++;
    if (at >= xml.n || s[at] == '>' || s[at] == '<') return 0;
    a->name = at;
    while (at < xml.n && !is_space(s[at]) && !strchr("=<>\"'/", s[at]))
        at++;
    a->name_length = at - a->name;
    while (at < xml.n && is_space(s[at]))
        at++;
    if (at >= xml.n || s[at] != '=' || a->name_length == 0) return 0;
    at++;
    while (at < xml.n && is_space(s[at]))
        at++;
    if (at >= xml.n || (s[at] != '"' && s[at] != '\'')) return 0;
    a->value = at + 1;
    const char *end = memchr(s + a->value, s[at], xml.n - a->value);
    a->value_length = (end ? (size_t)(end - s) : xml.n) - a->value;
    return 1;
}

/* ---- what is refused ---- */

typedef struct guard {
    const char *file;
    fw_xml_bytes xml;
    fw_diags *diags;
    size_t at;
    int depth, elements, attributes;
} guard;

static fw_place place(const guard *g, size_t offset) {
    return fw_xml_place_at(g->file, g->xml, offset);
}

static fw_status check_size(const guard *g) {
    if (g->xml.n > FW_XML_BYTES_MOST)
        return fw_diag_error(g->diags, 1, (fw_place){g->file, 1, 1},
                             "the file has %zu bytes, the limit is 8 MiB (8388608 bytes); a "
                             "description needs a few kilobytes, so check the file name",
                             g->xml.n);
    size_t mark = fw_xml_starts_with(g->xml, 0, "\xef\xbb\xbf") ? 3 : 0;
    for (size_t i = mark; i < g->xml.n; i++)
        if (!strchr(" \t\r\n", g->xml.data[i]) || g->xml.data[i] == '\0') return FW_OK;
    return fw_diag_error(g->diags, 14, (fw_place){g->file, 1, 1},
                         "the file is empty; 'flexwright init' writes a device to start from");
}

/* length of the UTF-8 sequence at s, 0 when it is not one (overlong forms and surrogates included)
 */
static size_t sequence(const unsigned char *s, size_t n) {
    if (s[0] < 0x80) return 1;
    size_t length = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    if (s[0] < 0xc2 || s[0] > 0xf4 || n < length) return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80) return 0;
    if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) ||
        (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] > 0x8f))
        return 0;
    return length;
}

/* characters that XML allows, and that give orders to a terminal or turn the order of reading: nothing that is
   described needs them, and what is shown would not be what is read */
static fw_status check_order(const guard *g, size_t at, unsigned code, const char *how) {
    if (!fw_text_is_order(code) || code == '\t' || code == '\n' || code == '\r') return FW_OK;
    return fw_diag_error(
        g->diags, 16, place(g, at),
        "character U+%04X%s; control characters and those that turn the order of reading are "
        "refused, since what is shown would not be what is read: remove it",
        code, how);
}

static fw_status check_bytes(const guard *g) {
    const unsigned char *s = (const unsigned char *)g->xml.data;
    size_t n = g->xml.n;
    if (n >= 2 && ((s[0] == 0xff && s[1] == 0xfe) || (s[0] == 0xfe && s[1] == 0xff)))
        return fw_diag_error(g->diags, 3, place(g, 0),
                             "the file is UTF-16; save it as UTF-8 and try again");
    for (size_t i = 0; i < n;) {
        if (s[i] == 0)
            return fw_diag_error(
                g->diags, 2, place(g, i),
                "NUL byte at byte %zu: not a text file, or UTF-16; save it as UTF-8", i);
        if (s[i] < 0x20 && s[i] != '\t' && s[i] != '\n' && s[i] != '\r')
            return fw_diag_error(g->diags, 16, place(g, i),
                                 "control character 0x%02x; XML allows only tab and line ends, so "
                                 "remove it",
                                 (unsigned)s[i]);
        size_t length = sequence(s + i, n - i);
        if (length == 0)
            return fw_diag_error(g->diags, 3, place(g, i),
                                 "byte 0x%02x is not UTF-8 here; save the file as UTF-8 (it may be "
                                 "Latin-1)",
                                 (unsigned)s[i]);
        if (s[i] == 0x7f || s[i] == 0xc2 || s[i] == 0xe2) { /* where such characters begin */
            unsigned code;
            fw_text_utf8(g->xml.data + i, &code);
            FW_TRY(check_order(g, i, code, ""));
        }
        i += length;
    }
    return FW_OK;
}

/* the character of &#65; or &#x41; from its digits on; one that no order has where it is none: the parser says that */
static unsigned numbered(const guard *g, size_t at) {
    const char *s = g->xml.data;
    const bool hexadecimal = at < g->xml.n && s[at] == 'x';
    unsigned code = 0;
    for (at += hexadecimal; at < g->xml.n && s[at] != ';' && code <= 0x10ffff; at++) {
        const int digit = s[at] >= '0' && s[at] <= '9'                 ? s[at] - '0'
                          : (s[at] | 32) >= 'a' && (s[at] | 32) <= 'f' ? (s[at] | 32) - 'a' + 10
                                                                       : 16;
        if (digit >= (hexadecimal ? 16 : 10)) return 'A';
        code = code * (hexadecimal ? 16 : 10) + (unsigned)digit;
    }
    return code ? code : 'A';
}

/* & at `at`: only the five built-in entities and character references; *behind is what follows */
static fw_status check_reference(const guard *g, size_t at, size_t *behind) {
    static const char *const allowed[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"};
    *behind = at + 1;
    for (size_t i = 0; i < sizeof allowed / sizeof allowed[0]; i++)
        if (fw_xml_starts_with(g->xml, at, allowed[i]))
            return allowed[i][1] == '#' ? check_order(g, at, numbered(g, at + 2), " by its number")
                                        : FW_OK;
    size_t end = at + 1;
    while (end < g->xml.n && end - at < 64 && !strchr(" \t\r\n<>&;\"'", g->xml.data[end]))
        end++;
    if (end < g->xml.n && end > at + 1 && g->xml.data[end] == ';')
        return fw_diag_error(g->diags, 5, place(g, at),
                             "entity '%.*s' is refused: only &amp; &lt; &gt; &quot; &apos; and "
                             "&#N; are read; write the text itself",
                             (int)(end - at + 1), g->xml.data + at);
    return fw_diag_error(g->diags, 11, place(g, at), "a lone '&'; write &amp; for the character");
}

static fw_status check_references(const guard *g, size_t from, size_t to) {
    for (size_t at = from;;) {
        const char *found = at < to ? memchr(g->xml.data + at, '&', to - at) : NULL;
        if (!found) return FW_OK;
        FW_TRY(check_reference(g, (size_t)(found - g->xml.data), &at));
    }
}

/* names become texts on the mask and file names, numbers do not */
static size_t longest(const guard *g, const fw_xml_raw_attribute *a) {
    static const char *const law[] = {"table", "factor", "value"};
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++)
        if (a->name_length == strlen(law[i]) &&
            memcmp(g->xml.data + a->name, law[i], a->name_length) == 0)
            return FW_XML_LAW_MOST;
    return FW_XML_VALUE_MOST;
}

static fw_status check_value(const guard *g, const fw_xml_raw_attribute *a) {
    const char *value = g->xml.data + a->value;
    const char *less = memchr(value, '<', a->value_length);
    if (less) {
        /* a value that runs into the next line most likely lacks its closing quote */
        int far = memchr(value, '\n', (size_t)(less - value)) != NULL;
        size_t at = far ? a->value - 1 : (size_t)(less - g->xml.data);
        return fw_diag_error(g->diags, 11, place(g, at),
                             "'<' inside the value of attribute '%.*s'; close the value with a "
                             "quote, or write &lt;",
                             (int)(a->name_length < 64 ? a->name_length : 64),
                             g->xml.data + a->name);
    }
    if (a->value_length > longest(g, a))
        return fw_diag_error(g->diags, 10, place(g, a->value),
                             "the value has %zu bytes, the limit is %zu; shorten it",
                             a->value_length, longest(g, a));
    return check_references(g, a->value, a->value + a->value_length);
}

static fw_status check_twice(const guard *g, const fw_xml_raw_attribute *earlier, int count,
                             const fw_xml_raw_attribute *a) {
    for (int i = 0; i < count; i++)
        if (earlier[i].name_length == a->name_length &&
            memcmp(g->xml.data + earlier[i].name, g->xml.data + a->name, a->name_length) == 0)
            return fw_diag_error(g->diags, 13, place(g, a->name),
                                 "attribute '%.*s' is given twice (first at line %d, column %d); "
                                 "remove one",
                                 (int)(a->name_length < 64 ? a->name_length : 64),
                                 g->xml.data + a->name, place(g, earlier[i].name).line,
                                 place(g, earlier[i].name).column);
    return FW_OK;
}

static fw_status check_tag(guard *g) {
    size_t start = g->at, at = start + 1;
    if (++g->elements > FW_XML_ELEMENTS_MOST)
        return fw_diag_error(g->diags, 8, place(g, start),
                             "more than %d elements; the limit keeps reading quick, and no planar "
                             "mechanism needs so many",
                             FW_XML_ELEMENTS_MOST);
    if (++g->depth > FW_XML_DEPTH_MOST)
        return fw_diag_error(g->diags, 7, place(g, start),
                             "elements are nested more than %d levels deep; a description needs 3",
                             FW_XML_DEPTH_MOST);
    while (at < g->xml.n && !strchr(" \t\r\n/><", g->xml.data[at]))
        at++;
    fw_xml_raw_attribute earlier[FW_XML_ATTRIBUTES_MOST], a;
    int count = 0;
    while (fw_xml_next_attribute(g->xml, at, &a)) {
        if (count == FW_XML_ATTRIBUTES_MOST)
            return fw_diag_error(g->diags, 9, place(g, a.name),
                                 "more than %d attributes in one element", FW_XML_ATTRIBUTES_MOST);
        if (++g->attributes > FW_XML_ALL_ATTRIBUTES_MOST)
            return fw_diag_error(
                g->diags, 9, place(g, a.name),
                "more than %d attributes in the file; the limit keeps reading small",
                FW_XML_ALL_ATTRIBUTES_MOST);
        FW_TRY(check_value(g, &a));
        FW_TRY(check_twice(g, earlier, count, &a));
        earlier[count++] = a;
        at = a.value + a.value_length + 1;
        if (at > g->xml.n) at = g->xml.n;
    }
    while (at < g->xml.n && g->xml.data[at] != '>' && g->xml.data[at] != '<')
        at++;
    if (at < g->xml.n && g->xml.data[at] == '>') {
        if (g->xml.data[at - 1] == '/') g->depth--;
        at++;
    }
    g->at = at;
    return FW_OK;
}

static fw_status check_comment(guard *g) {
    size_t start = g->at, end = fw_xml_find(g->xml, start + 4, "--");
    if (end + 2 < g->xml.n && g->xml.data[end + 2] == '>') {
        g->at = end + 3;
        return FW_OK;
    }
    int next_begins = end >= start + 6 && end < g->xml.n && g->xml.data[end - 1] == '!' &&
                      g->xml.data[end - 2] == '<';
    if (end + 2 >= g->xml.n || next_begins)
        return fw_diag_error(g->diags, 11, place(g, start),
                             "this comment is never closed; end it with '-->'");
    return fw_diag_error(g->diags, 11, place(g, end),
                         "'--' inside a comment is not XML; use a single '-' (the comment began at "
                         "line %d)",
                         place(g, start).line);
}

static int names_utf8(const char *s, size_t n) {
    return n == 5 && (s[0] | 32) == 'u' && (s[1] | 32) == 't' && (s[2] | 32) == 'f' &&
           s[3] == '-' && s[4] == '8';
}

/* <?xml ...?> may stand at the very start and say UTF-8; anything else behind <? is refused */
static fw_status check_instruction(guard *g, size_t body) {
    size_t start = g->at, end = fw_xml_find(g->xml, start, "?>");
    int declaration = fw_xml_starts_with(g->xml, start, "<?xml") && start + 5 < g->xml.n &&
                      strchr(" \t\r\n", g->xml.data[start + 5]);
    if (declaration && start != body)
        return fw_diag_error(g->diags, 6, place(g, start),
                             "the XML declaration may only stand at the very start of the file; "
                             "remove what is in front of it");
    if (!declaration)
        return fw_diag_error(g->diags, 6, place(g, start),
                             "processing instructions are refused; remove everything from '<?' to "
                             "'?>'");
    size_t encoding = fw_xml_find(g->xml, start, "encoding");
    if (encoding < end) {
        size_t quote = encoding;
        while (quote < end && g->xml.data[quote] != '"' && g->xml.data[quote] != '\'')
            quote++;
        const char *close =
            quote < end ? memchr(g->xml.data + quote + 1, g->xml.data[quote], end - quote - 1)
                        : NULL;
        size_t length = close ? (size_t)(close - g->xml.data) - quote - 1 : 0;
        if (close && !names_utf8(g->xml.data + quote + 1, length))
            return fw_diag_error(g->diags, 3, place(g, quote + 1),
                                 "encoding '%.*s' is refused; save the file as UTF-8",
                                 (int)(length < 40 ? length : 40), g->xml.data + quote + 1);
    }
    g->at = end < g->xml.n ? end + 2 : g->xml.n;
    return FW_OK;
}

static fw_status check_markup(guard *g, size_t body) {
    char next = g->at + 1 < g->xml.n ? g->xml.data[g->at + 1] : '\0';
    if (next == '?') return check_instruction(g, body);
    if (fw_xml_starts_with(g->xml, g->at, "<!--")) return check_comment(g);
    if (fw_xml_starts_with(g->xml, g->at, "<![CDATA[")) {
        g->at = fw_xml_find(g->xml, g->at + 9, "]]>");
        return FW_OK;
    }
    if (next == '!' && g->at + 2 < g->xml.n && (g->xml.data[g->at + 2] | 32) >= 'a' &&
        (g->xml.data[g->at + 2] | 32) <= 'z')
        return fw_diag_error(g->diags, 4, place(g, g->at),
                             "DOCTYPE and entity declarations are refused; remove them (units, "
                             "expressions and <parameter> serve instead)");
    if (next == '!')
        return fw_diag_error(g->diags, 11, place(g, g->at),
                             "'<!' begins nothing known here; a comment is <!-- ... -->");
    if (next == '/') {
        g->depth -= g->depth > 0;
        g->at++;
        return FW_OK;
    }
    return check_tag(g);
}

fw_status fw_xml_guard(const char *file, fw_xml_bytes xml, fw_diags *diags, size_t *body) {
    guard g = {.file = file, .xml = xml, .diags = diags};
    FW_TRY(check_size(&g));
    FW_TRY(check_bytes(&g));
    *body = fw_xml_starts_with(xml, 0, "\xef\xbb\xbf") ? 3 : 0;
    g.at = *body;
    while (g.at < xml.n) {
        const char *less = memchr(xml.data + g.at, '<', xml.n - g.at);
        size_t next = less ? (size_t)(less - xml.data) : xml.n;
        FW_TRY(check_references(&g, g.at, next));
        g.at = next;
        if (next < xml.n) FW_TRY(check_markup(&g, *body));
    }
    return FW_OK;
}
