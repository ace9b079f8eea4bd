/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/device_path.h"
#include "device/device_table.h"
#include <stdlib.h>
#include <string.h>

typedef struct step {
    const char *name, *in; /* in: between the brackets, NULL without */
    size_t name_length, in_length;
} step;

/* reads one step at *at and goes behind it; false: it is none */
static bool read_step(const char **at, step *out) {
    const char *s = *at;
    *out = (step){.name = s, .name_length = strcspn(s, "[]/@")};
    s += out->name_length;
    if (*s == '[') {
        out->in = s + 1;
        out->in_length = strcspn(s + 1, "[]/");
        s += 1 + out->in_length;
        if (*s != ']' || out->in_length == 0) return false;
        s++;
    }
    *at = s;
    return out->name_length > 0;
}

static bool named(const char *text, const char *name, size_t n) {
    return strlen(text) == n && memcmp(text, name, n) == 0;
}

/* the number between the brackets; 0: an id stands there (ids do not begin with a digit) */
static long number_of(const step *s) {
    if (!s->in || s->in[0] < '0' || s->in[0] > '9') return 0;
    char *end;
    long n = strtol(s->in, &end, 10);
    return end == s->in + s->in_length && n >= 1 ? n : -1;
}

static bool fits(const fw_xml_element *e, const step *s, const char *key) {
    if (!named(e->name, s->name, s->name_length)) return false;
    if (!s->in || number_of(s) != 0) return true;
    const fw_xml_attribute *id = key ? fw_xml_attribute_of(e, key) : NULL;
    return id && named(id->value, s->in, s->in_length);
}

typedef struct search {
    const step *step;
    const char *key;
    long wanted, matches; /* wanted: number of it, 0: the only one */
    fw_xml_element *found;
} search;

/* `e` and what follows it; `deep`: what is inside, too. In file order. */
static void find_wanted(search *s, fw_xml_element *e, bool deep) {
    for (; e; e = e->next) {
        if (fits(e, s->step, s->key) && (++s->matches == s->wanted || s->wanted == 0)) s->found = e;
        if (deep) find_wanted(s, e->first_child, true);
    }
}

static bool wrong(fw_device_path *out, const char *what, const char *word) {
    out->wrong = what;
    out->word = word;
    return false;
}

/* of the root, or of what is inside *found */
static bool find_step(fw_xml_element *root, const step *s, fw_xml_element **found,
                      fw_device_path *out) {
    memset(out->name, 0, sizeof out->name);
    memcpy(out->name, s->name,
           s->name_length < sizeof out->name ? s->name_length : sizeof out->name - 1);
    const fw_xml_element_row *row = fw_xml_row_find(&fw_device_table, out->name);
    search all = {.step = s, .key = row ? row->key : NULL, .wanted = number_of(s)};
    if (all.wanted < 0)
        return wrong(out, "this is no path; numbers of elements begin with 1", NULL);
    find_wanted(&all, *found ? (*found)->first_child : root, !*found);
    if (!all.found) return wrong(out, "there is no such element", out->name);
    if (all.wanted == 0 && all.matches > 1)
        return wrong(out, "there are several; name one by its id or its number, as in NAME[2]",
                     out->name);
    *found = all.found;
    return true;
}

bool fw_device_path_find(fw_xml_element *root, const char *path, fw_xml_element **found,
                         fw_device_path *out) {
    const char *at = path;
    step s;
    *found = NULL;
    *out = (fw_device_path){.attribute = NULL};
    for (;;) {
        if (!read_step(&at, &s))
            return wrong(out,
                         "this is no path; it is like flexure[A]/@length or "
                         "scene[step-load]/force[2]/@fx",
                         NULL);
        if (!find_step(root, &s, found, out)) return false;
        if (*at == '\0') return true;
        if (*at != '/')
            return wrong(out, "this is no path; '/' or the end is missing behind", s.name);
        at++;
        if (*at != '@') continue;
        out->attribute = at + 1;
        return true;
    }
}
