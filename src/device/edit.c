/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes to the text of a description. Text in, text out: a path names an element, places come from the reader, and only
   the bytes of a change are touched. */
#include "device/device_table.h"
#include "device/edit.h"
#include "xml/xml.h"
#include <stdlib.h>
#include <string.h>

/* ---- which element a path names ---- */

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

/* ---- the changes ---- */

typedef struct editor {
    fw_arena *arena;
    fw_diags *diags;
    const char *file, *path; /* of the change at hand */
    fw_xml_bytes xml;
    fw_xml_element *root;
} editor;

/* FW_INPUT, said why */
static fw_status refuse(const editor *e, const char *what, const char *word) {
    return fw_diag_error(e->diags, 288, (fw_place){.file = e->file}, "%.100s: %s%s%.64s%s", e->path,
                         what, word ? " '" : "", word ? word : "", word ? "'" : "");
}

/* the element of a path; *attribute is what stands behind /@, or NULL */
static fw_status find(const editor *e, const fw_xml_element **found, const char **attribute) {
    fw_device_path path;
    fw_xml_element *element;
    *found = NULL;
    *attribute = NULL;
    if (!fw_device_path_find(e->root, e->path, &element, &path))
        return refuse(e, path.wrong, path.word);
    *found = element;
    *attribute = path.attribute;
    return FW_OK;
}

/* ---- writing ---- */

static bool name_valid(const char *name) {
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-");
    return n > 0 && name[n] == '\0' && !strchr("0123456789-", name[0]);
}

/* as it stands between quotes; what XML would turn into a space is written so that it stays */
static void add_value(fw_text *out, const char *value, char quote) {
    for (const char *c = value; *c; c++)
        switch (*c) {
        case '&':
            fw_text_add(out, "&amp;");
            break;
        case '<':
            fw_text_add(out, "&lt;");
            break;
        case '\n':
            fw_text_add(out, "&#10;");
            break;
        case '\r':
            fw_text_add(out, "&#13;");
            break;
        case '\t':
            fw_text_add(out, "&#9;");
            break;
        case '"':
        case '\'':
            if (*c == quote) {
                fw_text_add(out, quote == '"' ? "&quot;" : "&apos;");
                break;
            } /* fall through */
        default:
            fw_text_bytes(out, c, 1);
        }
}

static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* behind the name of a start tag */
static size_t behind_name(const editor *e, size_t tag) {
    while (tag < e->xml.n && !is_space(e->xml.data[tag]) && e->xml.data[tag] != '>' &&
           e->xml.data[tag] != '/')
        tag++;
    return tag;
}

/* of a start tag at `tag`: behind its name or its last attribute, and behind its '>' */
static size_t tag_body_end(const editor *e, size_t tag, size_t *end) {
    fw_xml_raw_attribute raw;
    size_t at = behind_name(e, tag);
    while (fw_xml_next_attribute(e->xml, at, &raw))
        at = raw.value + raw.value_length + 1;
    *end = fw_xml_find(e->xml, at, ">");
    *end += *end < e->xml.n;
    return at;
}

static bool closes_itself(const editor *e, size_t end) {
    return end >= 2 && e->xml.data[end - 2] == '/';
}

/* the end tag of an element whose start tag ends before `at`: its '<'; *end behind its '>' */
static size_t end_tag(const editor *e, size_t at, size_t *end) {
    int depth = 0;
    for (;;) {
        at = fw_xml_find(e->xml, at, "<");
        if (at + 1 >= e->xml.n) break;
        if (fw_xml_starts_with(e->xml, at, "<!--"))
            at = fw_xml_find(e->xml, at + 4, "-->");
        else if (fw_xml_starts_with(e->xml, at, "<![CDATA["))
            at = fw_xml_find(e->xml, at + 9, "]]>");
        else if (e->xml.data[at + 1] == '/') {
            *end = fw_xml_find(e->xml, at, ">");
            *end += *end < e->xml.n;
            if (depth-- == 0) return at;
            at = *end;
        } else {
            size_t behind;
            tag_body_end(e, at, &behind);
            depth += !closes_itself(e, behind);
            at = behind;
        }
    }
    *end = e->xml.n;
    return e->xml.n;
}

/* bytes from `from` to `to` become `middle` */
static fw_status splice(const editor *e, size_t from, size_t to, const fw_text *middle,
                        fw_text *out) {
    fw_text_reserve(out, e->xml.n + middle->length);
    fw_text_bytes(out, e->xml.data, from);
    fw_text_bytes(out, middle->data, middle->length);
    fw_text_bytes(out, e->xml.data + to, e->xml.n - to);
    return fw_text_end(out);
}

/* an attribute of the table, or one of an element that is in no table */
static fw_status check_attribute(const editor *e, const fw_xml_element *element, const char *name) {
    const char *names[FW_ATTRIBUTES_MOST];
    size_t n = 0;
    const fw_xml_element_row *row = fw_xml_row_in(&fw_device_table, element->name,
                                                  element->parent ? element->parent->name : "");
    if (!name_valid(name)) return refuse(e, "no attribute can be called", name);
    fw_xml_attributes all = {0};
    if (row) FW_TRY(fw_xml_attributes_of(e->arena, row, &all));
    for (int i = 0; i < all.count && n < FW_ATTRIBUTES_MOST; i++) {
        if (strcmp(all.item[i].name, name) == 0) return FW_OK;
        names[n++] = all.item[i].name;
    }
    const char *better = row && n > 0 ? fw_did_you_mean(name, names, n) : NULL;
    if (!row) return FW_OK;
    return refuse(e,
                  better ? "the element has no such attribute; did you mean"
                         : "the element has no attribute",
                  better ? better : name);
}

static fw_status set(const editor *e, const fw_device_text_change *change, fw_text *out) {
    const fw_xml_element *element;
    const char *name;
    fw_text middle = fw_text_new(e->arena);
    fw_text_add(&middle, "");
    FW_TRY(find(e, &element, &name));
    if (!name) return refuse(e, "an attribute is missing behind the element: .../@NAME", NULL);
    const fw_xml_attribute *a = fw_xml_attribute_of(element, name);
    if (!a) {
        if (!change->value) return refuse(e, "there is no such attribute to take out", name);
        FW_TRY(check_attribute(e, element, name));
        size_t end, at = tag_body_end(e, element->offset + 1, &end);
        fw_text_printf(&middle, " %s=\"", name);
        add_value(&middle, change->value, '"');
        fw_text_add(&middle, "\"");
        return splice(e, at, at, &middle, out);
    }
    if (!a->raw) return refuse(e, "this attribute cannot be found in the text", name);
    size_t from = a->value_offset, to = from + a->raw_length;
    if (change->value) {
        add_value(&middle, change->value, e->xml.data[from - 1]);
        return splice(e, from, to, &middle, out);
    }
    /* with the space in front of it */
    to++;
    from--;
    while (from > 0 && e->xml.data[from] != '=')
        from--;
    while (from > 0 && is_space(e->xml.data[from - 1]))
        from--;
    while (from > 0 && !is_space(e->xml.data[from - 1]))
        from--;
    while (from > 0 && is_space(e->xml.data[from - 1]))
        from--;
    return splice(e, from, to, &middle, out);
}

/* the white space between the line's start and `at`; 0 length where something else stands there */
static fw_xml_bytes indentation(const editor *e, size_t at) {
    size_t from = at;
    while (from > 0 && (e->xml.data[from - 1] == ' ' || e->xml.data[from - 1] == '\t'))
        from--;
    bool alone = from == 0 || e->xml.data[from - 1] == '\n';
    return (fw_xml_bytes){e->xml.data + from, alone ? at - from : 0};
}

static void add_element(fw_text *out, const fw_device_text_change *change) {
    fw_text_printf(out, "<%s", change->element);
    for (int i = 0; i < change->nattribute; i++) {
        fw_text_printf(out, " %s=\"", change->attribute[i].name);
        add_value(out, change->attribute[i].value, '"');
        fw_text_add(out, "\"");
    }
    fw_text_add(out, "/>");
}

/* as the last child, on a line of its own, as far in as its elder sisters are, or two spaces more
   than the parent */
static fw_status add(const editor *e, const fw_device_text_change *change, fw_text *out) {
    const fw_xml_element *parent = e->root;
    const char *attribute = NULL;
    fw_text middle = fw_text_new(e->arena);
    if (change->path[0]) FW_TRY(find(e, &parent, &attribute));
    if (attribute) return refuse(e, "elements are added to an element, not to", attribute);
    if (!change->element || !name_valid(change->element))
        return refuse(e, "no element can be called", change->element ? change->element : "");
    for (int i = 0; i < change->nattribute; i++)
        if (!name_valid(change->attribute[i].name))
            return refuse(e, "no attribute can be called", change->attribute[i].name);
    size_t end, tag = parent->offset + 1, body = tag_body_end(e, tag, &end);
    bool empty = closes_itself(e, end);
    const char *eol = fw_xml_find(e->xml, 0, "\r\n") < fw_xml_find(e->xml, 0, "\n") ? "\r\n" : "\n";
    fw_xml_bytes outer = indentation(e, parent->offset);
    fw_text in = fw_text_new(e->arena);
    fw_text_add(&in, eol);
    fw_xml_bytes sister = {NULL, 0};
    if (parent->last_child) sister = indentation(e, parent->last_child->offset);
    fw_text_bytes(&in, sister.n ? sister.data : outer.data, sister.n ? sister.n : outer.n);
    if (!sister.n) fw_text_add(&in, "  ");
    size_t from = body, to = end;
    if (empty)
        fw_text_add(&middle, ">");
    else {
        size_t behind;
        from = end_tag(e, end, &behind);
        while (from > 0 && is_space(e->xml.data[from - 1]))
            from--;
        to = from;
    }
    fw_text_bytes(&middle, in.data, in.length);
    add_element(&middle, change);
    bool own_line = empty || memchr(e->xml.data + from, '\n', end_tag(e, end, &body) - from);
    if (empty || !own_line) {
        fw_text_add(&middle, eol);
        fw_text_bytes(&middle, outer.data, outer.n);
    }
    if (empty) { /* the name as it stands there, with its prefix */
        fw_text_add(&middle, "</");
        fw_text_bytes(&middle, e->xml.data + tag, behind_name(e, tag) - tag);
        fw_text_add(&middle, ">");
    }
    if (in.failed) return FW_NOMEM;
    return splice(e, from, to, &middle, out);
}

/* with its line, where nothing else stands on it */
static fw_status take_out(const editor *e, fw_text *out) {
    const fw_xml_element *element;
    const char *attribute;
    fw_text nothing = fw_text_new(e->arena);
    fw_text_add(&nothing, "");
    FW_TRY(find(e, &element, &attribute));
    if (attribute) return refuse(e, "an element is to be removed, not an attribute", attribute);
    if (element == e->root) return refuse(e, "the whole device cannot be removed", NULL);
    size_t from = element->offset, to;
    tag_body_end(e, from + 1, &to);
    if (!closes_itself(e, to)) end_tag(e, to, &to);
    size_t before = indentation(e, from).n, after = to;
    while (after < e->xml.n && (e->xml.data[after] == ' ' || e->xml.data[after] == '\t'))
        after++;
    bool last = after < e->xml.n && (e->xml.data[after] == '\n' || e->xml.data[after] == '\r');
    bool first = from == before || e->xml.data[from - before - 1] == '\n';
    if (first && last) {
        to = fw_xml_find(e->xml, after, "\n");
        to += to < e->xml.n;
        from -= before;
    }
    return splice(e, from, to, &nothing, out);
}

/* "arc" is parameter[arc]/@value */
static fw_status whole_path(fw_arena *arena, const char **path) {
    if ((*path)[0] && !strpbrk(*path, "[]/@"))
        FW_NEED(*path = fw_arena_printf(arena, "parameter[%s]/@value", *path));
    return FW_OK;
}

fw_status fw_device_edit(fw_arena *arena, const char *file, const char *xml, size_t n,
                         const fw_device_text_change *change, int nchange, fw_diags *diags,
                         fw_text *out) {
    editor e = {.arena = arena, .diags = diags, .file = file, .xml = {xml, n}, .path = ""};
    for (int i = 0;; i++) { /* read again behind every change, the last one too */
        fw_xml_element *root;
        fw_status read = fw_xml_read(arena, file, e.xml.data, e.xml.n, diags, &root);
        if (read == FW_INPUT && i > 0) refuse(&e, "with this change it is no longer XML", NULL);
        FW_TRY(read);
        if (i == nchange) break;
        e.root = root;
        e.path = change[i].path ? change[i].path : "";
        if (change[i].kind == FW_CHANGE_SET) FW_TRY(whole_path(arena, &e.path));
        fw_text next = fw_text_new(arena);
        FW_TRY(change[i].kind == FW_CHANGE_ADD      ? add(&e, &change[i], &next)
               : change[i].kind == FW_CHANGE_REMOVE ? take_out(&e, &next)
                                                    : set(&e, &change[i], &next));
        e.xml = (fw_xml_bytes){next.data, next.length};
    }
    fw_text_bytes(out, e.xml.data, e.xml.n);
    return fw_text_end(out);
}

/* ---- the unit that a value is written in ---- */

struct fw_device_written {
    const fw_device *device;
    fw_xml_element *root; /* NULL: there is no file */
};

fw_status fw_device_written_open(fw_arena *arena, const fw_device *device,
                                 const fw_device_written **written) {
    fw_diags quiet = fw_diags_new(arena); /* it was read before */
    fw_device_written *w = fw_arena_one(arena, fw_device_written);
    FW_NEED(w);
    w->device = device;
    *written = w;
    if (!device->source) return FW_OK;
    fw_status status =
        fw_xml_read(arena, device->file, device->source, device->source_length, &quiet, &w->root);
    if (status != FW_OK) w->root = NULL;
    return status == FW_INPUT ? FW_OK : status;
}

/* of the attribute that a path names; NULL: it is not there */
static const char *text_of(const fw_device_written *w, const char *path) {
    fw_device_path parts;
    fw_xml_element *e;
    if (!w->root || !fw_device_path_find(w->root, path, &e, &parts) || !parts.attribute)
        return NULL;
    const fw_xml_attribute *a = fw_xml_attribute_of(e, parts.attribute);
    return a ? a->value : NULL;
}

/* the first parameter of this dimension that the text names; NULL: it names none */
static fw_status first_named(fw_arena *arena, const fw_device *d, const char *text,
                             fw_quantity_dimension dimension, const char **name) {
    const char *const *names;
    size_t count;
    *name = NULL;
    FW_TRY(fw_quantity_expression_names(arena, text, strlen(text), &names, &count));
    for (size_t i = 0; i < count && !*name; i++)
        for (int k = 0; k < d->nparameter && !*name; k++)
            if (strcmp(d->parameter[k].name, names[i]) == 0 &&
                fw_quantity_dimension_equal(d->parameter[k].dimension, dimension))
                *name = d->parameter[k].name;
    return FW_OK;
}

fw_status fw_device_written_unit(fw_arena *arena, const fw_device_written *w, const char *path,
                                 fw_quantity_dimension dimension, const char **unit) {
    *unit = "";
    for (int i = 0; i <= w->device->nparameter && path; i++) { /* none is computed from itself */
        FW_TRY(whole_path(arena, &path));
        const char *text = text_of(w, path);
        if (!text) return FW_OK;
        FW_TRY(fw_quantity_expression_unit(arena, text, strlen(text), dimension, unit));
        if ((*unit)[0]) return FW_OK;
        FW_TRY(first_named(arena, w->device, text, dimension, &path));
    }
    return FW_OK;
}
