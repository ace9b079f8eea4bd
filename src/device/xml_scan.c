/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/xml_scan.h"
#include <string.h>

fw_place fw_place_at(const char *file, fw_bytes xml, size_t offset) {
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

int fw_starts_with(fw_bytes xml, size_t at, const char *what) {
    size_t length = strlen(what);
    return xml.n - at >= length && memcmp(xml.data + at, what, length) == 0;
}

size_t fw_find(fw_bytes xml, size_t at, const char *what) {
    if (at >= xml.n) return xml.n;
    const char *found = memmem(xml.data + at, xml.n - at, what, strlen(what));
    return found ? (size_t)(found - xml.data) : xml.n;
}

static int is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

size_t fw_next_tag(fw_bytes xml, size_t at) {
    for (;;) {
        at = fw_find(xml, at, "<");
        if (at + 1 >= xml.n) return xml.n;
        if (fw_starts_with(xml, at, "<!--"))
            at = fw_find(xml, at + 4, "-->");
        else if (fw_starts_with(xml, at, "<![CDATA["))
            at = fw_find(xml, at + 9, "]]>");
        else if (xml.data[at + 1] == '?')
            at = fw_find(xml, at + 2, "?>");
        else if (xml.data[at + 1] == '/' || xml.data[at + 1] == '!')
            at++;
        else
            return at;
    }
}

int fw_next_attribute(fw_bytes xml, size_t at, fw_raw_attribute *a) {
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
