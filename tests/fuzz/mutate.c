/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A change at random that leaves a file most of what it is, so that readers come past its first line. Values of XML are drawn
   by the kind that the table of its rows states for them: what the reader accepts follows the table, and so does this. */
#include "mutate.h"
#include <ctype.h>
#include <stdio.h>
#include <string.h>

uint64_t fuzz_seed = 0x9e3779b97f4a7c15ULL;

size_t fuzz_below(size_t n) {
    fuzz_seed ^= fuzz_seed << 13, fuzz_seed ^= fuzz_seed >> 7, fuzz_seed ^= fuzz_seed << 17;
    return n ? (size_t)(fuzz_seed >> 11) % n : 0;
}

/* `length` bytes at `at` become the k bytes of `by`, if there is room */
static void put(fuzz_text *t, size_t at, size_t length, const char *by, size_t k) {
    if (at > t->n || length > t->n - at || t->n - length + k > t->room) return;
    char own[4096];
    if (k > sizeof own) return;
    memcpy(own, by, k); /* it may be a part of the text */
    memmove(t->data + at + k, t->data + at + length, t->n - at - length);
    memcpy(t->data + at, own, k);
    t->n += k - length;
}

static void put_text(fuzz_text *t, size_t at, size_t length, const char *by) {
    put(t, at, length, by, strlen(by));
}

static const char *one_of(const char *const *list, size_t n) {
    return list[fuzz_below(n)];
}
#define ONE_OF(list) one_of(list, sizeof(list) / sizeof(list)[0])

/* ---- values ---- */

static const char *const odd[] = {"",     "0",    "-1",     "1e309",   "nan",    "1e-320",
                                  "-0",   "&lt;", "&#x9b;", "../../x", "ground", "%n",
                                  "1/0",  "((((", "yes",    "{s}",     "a b",    "\xc2\xb5m",
                                  "\xff", "=1+1", "&#10;",  "x x",     "9e99 m", "1e-30 m"};

static void number(char *out, size_t n, const char *unit) {
    static const char *const size[] = {"0",   "1",  "2.5", "10", "100",  "1e3",   "0.01", "1e-6",
                                       "1e6", "-3", "7",   "33", "1e12", "1e-12", "50"};
    snprintf(out, n, fuzz_below(8) ? "%s %s" : "%s %s * 2", ONE_OF(size),
             unit && strcmp(unit, "1") ? unit : "");
}

/* a value of one of the rows of the table with this name; of any kind where there is none */
static const fw_xml_attribute_row *row_of(const fw_xml_table *table, const char *name, size_t n) {
    const fw_xml_element_row *e;
    const fw_xml_attribute_row *found = NULL;
    size_t count = 0;
    for (int i = 0; table && (e = fw_xml_row_at(table, i)) != NULL; i++)
        for (int k = 0; k < e->nattribute; k++)
            if (strlen(e->attribute[k].name) == n && memcmp(e->attribute[k].name, name, n) == 0 &&
                fuzz_below(++count) == 0)
                found = &e->attribute[k];
    return found;
}

static void value_of(const fw_xml_attribute_row *row, char out[256]) {
    static const char *const timed[] = {"t/(1 s)", "1 N * t/(1 s)", "sin(2*t*(1 rad/s))",
                                        "exp(-t/(1 ms)) * 1 um", "1 uN"};
    static const char *const table[] = {"0 s: 0 N; 1 s: 1 N", "0 s: 1; 0 s: 2",
                                        "0 s: 0 um; 1 ms: 3 um; 2 ms: 0 um"};
    static const char *const name[] = {"A", "b", "leaf", "x1", "_", "crank", "ground"};
    snprintf(out, 256, "%s", ONE_OF(odd));
    if (!row || fuzz_below(6) == 0) return;
    switch (row->kind) {
    case FW_KIND_WORD:
    case FW_KIND_WORDS: {
        size_t n = 0;
        while (row->words[n])
            n++;
        snprintf(out, 256, "%s", row->words[fuzz_below(n)]);
        break;
    }
    case FW_KIND_DECIMAL:
        number(out, 256, "");
        break;
    case FW_KIND_NUMBER:
    case FW_KIND_ANY:
        number(out, 256, row->unit);
        break;
    case FW_KIND_TIMED:
        snprintf(out, 256, "%s", ONE_OF(timed));
        break;
    case FW_KIND_TABLE:
        snprintf(out, 256, "%s", ONE_OF(table));
        break;
    case FW_KIND_ID:
    case FW_KIND_NAME:
    case FW_KIND_REF:
        snprintf(out, 256, "%s", ONE_OF(name));
        break;
    case FW_KIND_TEXT:
    case FW_KIND_FORM:
        break;
    }
}

/* ---- XML ---- */

typedef struct spot { /* an attribute of the text */
    fw_xml_raw_attribute a;
    size_t tag;
} spot;

/* one of the text's attributes; n: other than 0 only of this name */
static int find_attribute(const fuzz_text *t, const char *name, size_t n, spot *found) {
    const fw_xml_bytes xml = {t->data, t->n};
    size_t count = 0;
    for (size_t tag = fw_xml_next_tag(xml, 0); tag < t->n; tag = fw_xml_next_tag(xml, tag + 1)) {
        size_t at = tag + 1;
        while (at < t->n && !isspace((unsigned char)t->data[at]) && !strchr("/><", t->data[at]))
            at++;
        fw_xml_raw_attribute a;
        while (fw_xml_next_attribute(xml, at, &a)) {
            int fits = n == 0 || (a.name_length == n && memcmp(t->data + a.name, name, n) == 0);
            if (fits && fuzz_below(++count) == 0) *found = (spot){a, tag};
            at = a.value + a.value_length + 1;
            if (at >= t->n) break;
        }
    }
    return count > 0;
}

static size_t find_tag(const fuzz_text *t) {
    const fw_xml_bytes xml = {t->data, t->n};
    size_t count = 0, found = t->n;
    for (size_t tag = fw_xml_next_tag(xml, 0); tag < t->n; tag = fw_xml_next_tag(xml, tag + 1))
        if (fuzz_below(++count) == 0) found = tag;
    return found;
}

/* behind the element that begins at `tag`, with all that is in it */
static size_t end_of(const fuzz_text *t, size_t tag) {
    int depth = 0;
    for (size_t at = tag; at < t->n; at++) {
        if (t->data[at] == '<' && at + 1 < t->n)
            depth += t->data[at + 1] == '/' ? -1 : t->data[at + 1] != '!' && t->data[at + 1] != '?';
        if (t->data[at] == '>') {
            depth -= at > 0 && t->data[at - 1] == '/';
            if (depth <= 0) return at + 1;
        }
    }
    return t->n;
}

static size_t name_end(const fuzz_text *t, size_t tag) {
    size_t at = tag + 1;
    while (at < t->n && !isspace((unsigned char)t->data[at]) && !strchr("/><", t->data[at]))
        at++;
    return at;
}

static const fw_xml_element_row *element_row(const fuzz_text *t, size_t tag,
                                             const fw_xml_table *table) {
    char name[64];
    const size_t n = name_end(t, tag) - tag - 1;
    if (!table || n >= sizeof name) return NULL;
    memcpy(name, t->data + tag + 1, n);
    name[n] = '\0';
    return fw_xml_row_find(table, name);
}

static void other_value(fuzz_text *t, const fw_xml_table *table) {
    spot s, from;
    if (!find_attribute(t, NULL, 0, &s)) return;
    char value[256];
    const char *name = t->data + s.a.name;
    switch (fuzz_below(4)) {
    case 0: /* what another of this name says, or of any */
        if (!find_attribute(t, name, fuzz_below(3) ? s.a.name_length : 0, &from)) return;
        put(t, s.a.value, s.a.value_length, t->data + from.a.value, from.a.value_length);
        return;
    case 1: { /* its number, larger or smaller */
        char old[64];
        double v;
        int used = 0;
        const size_t n = s.a.value_length < sizeof old - 1 ? s.a.value_length : sizeof old - 1;
        memcpy(old, t->data + s.a.value, n);
        old[n] = '\0';
        static const double factor[] = {-1, 0, 0.5, 0.9, 1.1, 2, 10, 1e3, 1e-3, 1e6, 1e-6, 1e9};
        if (sscanf(old, "%lf%n", &v, &used) != 1) break;
        snprintf(value, sizeof value, "%.6g",
                 v * factor[fuzz_below(sizeof factor / sizeof *factor)]);
        put_text(t, s.a.value, (size_t)used, value);
        return;
    }
    default:
        break;
    }
    value_of(row_of(table, name, s.a.name_length), value);
    put_text(t, s.a.value, s.a.value_length, value);
}

/* ` name="value"` of an attribute of the row */
static void add_attribute(fuzz_text *t, size_t at, const fw_xml_attribute_row *row) {
    char value[256], text[400];
    value_of(row, value);
    snprintf(text, sizeof text, " %s=\"%s\"", row->name, value);
    put_text(t, at, 0, text);
}

static void another_attribute(fuzz_text *t, const fw_xml_table *table) {
    const size_t tag = find_tag(t);
    const fw_xml_element_row *row = tag < t->n ? element_row(t, tag, table) : NULL;
    if (row && row->nattribute > 0)
        add_attribute(t, name_end(t, tag), &row->attribute[fuzz_below((size_t)row->nattribute)]);
}

static void without_attribute(fuzz_text *t) {
    spot s;
    if (find_attribute(t, NULL, 0, &s))
        put(t, s.a.name, s.a.value + s.a.value_length + 1 - s.a.name, "", 0);
}

/* an element that may stand in the one at `tag`, with what it needs */
static void another_element(fuzz_text *t, const fw_xml_table *table) {
    const size_t tag = find_tag(t), end = name_end(t, tag);
    const fw_xml_element_row *in = tag < t->n ? element_row(t, tag, table) : NULL, *e,
                             *chosen = NULL;
    size_t count = 0;
    for (int i = 0; in && (e = fw_xml_row_at(table, i)) != NULL; i++)
        if (fw_xml_row_inside(e, in->name) && fuzz_below(++count) == 0) chosen = e;
    if (!chosen) return;
    size_t close = end;
    while (close < t->n && t->data[close] != '>')
        close++;
    if (close >= t->n || t->data[close - 1] == '/') return;
    char text[100];
    snprintf(text, sizeof text, "<%s/>", chosen->name);
    put_text(t, close + 1, 0, text);
    for (int k = 0; k < chosen->nattribute; k++)
        if (chosen->attribute[k].required || fuzz_below(6) == 0)
            add_attribute(t, close + 2 + strlen(chosen->name), &chosen->attribute[k]);
}

static void copied_element(fuzz_text *t) {
    const size_t tag = find_tag(t), end = end_of(t, tag), to = find_tag(t);
    if (tag < t->n && to < t->n) put(t, to, 0, t->data + tag, end - tag);
}

/* one number, by a factor that most descriptions survive */
void fuzz_mutate_number(fuzz_text *t) {
    static const double factor[] = {0.3, 0.7, 0.9, 0.99, 1.01, 1.1, 1.5, 3, -1, 0};
    for (int tries = 0; tries < 20; tries++) {
        spot s;
        char old[64] = "", value[64];
        double v;
        int used = 0;
        if (!find_attribute(t, NULL, 0, &s)) return;
        memcpy(old, t->data + s.a.value,
               s.a.value_length < sizeof old - 1 ? s.a.value_length : sizeof old - 1);
        if (sscanf(old, "%lf%n", &v, &used) != 1 ||
            (s.a.name_length >= 5 && memcmp(t->data + s.a.name, "xmlns", 5) == 0))
            continue;
        snprintf(value, sizeof value, "%.6g",
                 v * factor[fuzz_below(sizeof factor / sizeof *factor)]);
        put_text(t, s.a.value, (size_t)used, value);
        return;
    }
}

void fuzz_mutate_xml(fuzz_text *t, const fw_xml_table *table) {
    switch (fuzz_below(12)) {
    case 0:
        another_attribute(t, table);
        break;
    case 1:
        without_attribute(t);
        break;
    case 2:
    case 3:
        another_element(t, table);
        break;
    case 4: {
        const size_t tag = find_tag(t);
        if (tag < t->n) put(t, tag, end_of(t, tag) - tag, "", 0);
        break;
    }
    case 5:
        copied_element(t);
        break;
    case 6:
        fuzz_mutate_bytes(t);
        break;
    default:
        other_value(t, table);
        break;
    }
}

/* ---- others ---- */

void fuzz_mutate_bytes(fuzz_text *t) {
    const size_t at = fuzz_below(t->n + 1), length = fuzz_below(8);
    const char byte = (char)fuzz_below(256);
    switch (fuzz_below(3)) {
    case 0:
        if (at < t->n) t->data[at] = byte;
        break;
    case 1:
        put(t, at, length < t->n - at ? length : t->n - at, "", 0);
        break;
    default:
        put_text(t, at, 0, ONE_OF(odd));
        break;
    }
}

static unsigned size_at(const fuzz_text *t, size_t at) {
    return (unsigned)(unsigned char)t->data[at] << 8 | (unsigned char)t->data[at + 1];
}

/* arrays of a thousand and more, which take a hundred times as long as all else, are left one time of a hundred */
void fuzz_smaller_arrays(fuzz_text *t) {
    enum { COLROW = 0x13 };
    if (fuzz_below(100) == 0) return;
    for (size_t at = 0; at + 8 <= t->n;) {
        const size_t n = size_at(t, at);
        if (n < 4 || at + n > t->n) return;
        if (t->data[at + 2] == COLROW && n >= 8)
            for (size_t k = 4; k < 8; k += 2)
                t->data[at + k] = 0, t->data[at + k + 1] &= 0x1f;
        at += n;
    }
}

/* records: one again, elsewhere, gone, or with other contents */
void fuzz_mutate_gds(fuzz_text *t) {
    size_t start[2] = {0}, count = 0;
    for (size_t at = 0; at + 4 <= t->n;) {
        const size_t n = size_at(t, at);
        if (n < 4 || at + n > t->n) break;
        count++;
        for (int i = 0; i < 2; i++)
            if (fuzz_below(count) == 0) start[i] = at;
        at += n;
    }
    if (count == 0 || fuzz_below(8) == 0) {
        fuzz_mutate_bytes(t);
        return;
    }
    const size_t n = size_at(t, start[0]);
    switch (fuzz_below(4)) {
    case 0:
        put(t, start[1], 0, t->data + start[0], n);
        break;
    case 1:
        put(t, start[0], n, "", 0);
        break;
    case 2:
        t->data[start[0] + 2] = (char)fuzz_below(0x3c); /* another kind */
        break;
    default:
        for (size_t k = 1 + fuzz_below(4); n > 4 && k > 0; k--) {
            static const char edge[] = {0, 1, 127, -128, -1, 64};
            t->data[start[0] + 4 + fuzz_below(n - 4)] = edge[fuzz_below(sizeof edge)];
        }
        break;
    }
}

static size_t line_at(const fuzz_text *t, size_t at, size_t *end) {
    while (at > 0 && t->data[at - 1] != '\n')
        at--;
    const char *stop = memchr(t->data + at, '\n', t->n - at);
    *end = stop ? (size_t)(stop - t->data) + 1 : t->n;
    return at;
}

void fuzz_mutate_lines(fuzz_text *t) {
    static const char *const words[] = {"\t",       ",",    "\"",           ";",  "=",
                                        " ",        "\n",   "1e308",        "-1", "0",
                                        "0\nEOF\n", "10\n", "\xe2\x80\xae", "nan"};
    size_t end, other_end, at = line_at(t, fuzz_below(t->n), &end),
                           other = line_at(t, fuzz_below(t->n), &other_end);
    switch (fuzz_below(5)) {
    case 0:
        put(t, other, 0, t->data + at, end - at);
        break;
    case 1:
        put(t, at, end - at, "", 0);
        break;
    case 2:
        put_text(t, at + fuzz_below(end - at), fuzz_below(2), ONE_OF(words));
        break;
    case 3: { /* the digits there */
        while (at < end && !isdigit((unsigned char)t->data[at]))
            at++;
        size_t n = 0;
        while (at + n < end && isdigit((unsigned char)t->data[at + n]))
            n++;
        put_text(t, at, n, ONE_OF(odd));
        break;
    }
    default:
        fuzz_mutate_bytes(t);
        break;
    }
}
