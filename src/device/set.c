/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --set PATH=VALUE replaces an attribute before anything is evaluated. */
#include "device/device_reader.h"
#include "device/device_table.h"
#include <string.h>

typedef struct edit { /* one --set */
    const char *path, *value;
    fw_place place; /* "--set PATH": messages say which of several is meant */
} edit;

static fw_xml_attribute value_of(const edit *set, const char *name) {
    return (fw_xml_attribute){
        .name = name, .value = set->value, .place = set->place, .name_place = set->place};
}

static void unknown_path(fw_device_reader *r, const edit *set, const char *what, const char *word,
                         const char *const *names, size_t n) {
    const char *better = word && n ? fw_did_you_mean(word, names, n) : NULL;
    fw_diag_error(r->diags, 55, set->place, "%s%s%s%s", what, better ? "; did you mean '" : "",
                  better ? better : "",
                  better ? "'?"
                         : "; a path is a parameter's name or ELEMENT[ID]/@ATTRIBUTE, for example "
                           "flexure[A]/@length");
}

/* names of what the file holds: values of `key` of all elements with this name, to depth 3 */
static size_t collect(fw_xml_element *e, const char *element, const char *key,
                      fw_xml_element **found, const char **names, size_t room, size_t n) {
    for (; e; e = e->next) {
        if (n < room && strcmp(e->name, element) == 0) {
            const fw_xml_attribute *a = key ? fw_xml_attribute_of(e, key) : NULL;
            found[n] = e;
            names[n++] = a ? a->value : "";
        }
        n = collect(e->first_child, element, key, found, names, room, n);
    }
    return n;
}

static size_t count_named(const fw_xml_element *e, const char *element) {
    size_t n = 0;
    for (; e; e = e->next)
        n += (strcmp(e->name, element) == 0) + count_named(e->first_child, element);
    return n;
}

static fw_status set_parameter(fw_device_reader *r, const edit *set) {
    size_t most = count_named(r->xml.root->first_child, "parameter");
    fw_xml_element **found = fw_arena_array(r->arena, fw_xml_element *, most);
    const char **names = fw_arena_array(r->arena, const char *, most);
    FW_NEED(found && names);
    size_t n = collect(r->xml.root->first_child, "parameter", "name", found, names, most, 0);
    for (size_t i = 0; i < n; i++) {
        if (strcmp(names[i], set->path) != 0) continue;
        fw_xml_attribute *a = fw_arena_one(r->arena, fw_xml_attribute);
        FW_NEED(a);
        *a = value_of(set, set->path);
        r->override_[r->noverride++] = (fw_device_override){found[i], a};
        return FW_OK;
    }
    for (size_t i = 0; i < n; i++) /* a nameless one is reported; it may be the one meant */
        if (names[i][0] == '\0') return FW_OK;
    unknown_path(r, set, "no parameter has this name", set->path, names, n);
    return FW_OK;
}

static fw_status replace(fw_device_reader *r, const edit *set, fw_xml_element *e,
                         const fw_xml_element_row *row, const char *attribute) {
    const char *names[FW_ATTRIBUTES_MOST];
    size_t n = 0;
    fw_xml_attributes all;
    FW_TRY(fw_xml_attributes_of(r->arena, row, &all));
    for (int i = 0; i < all.count && n < FW_ATTRIBUTES_MOST; i++)
        names[n++] = all.item[i].name;
    size_t k = 0;
    while (k < n && strcmp(names[k], attribute) != 0)
        k++;
    if (k == n) {
        unknown_path(r, set, "the element has no such attribute", attribute, names, n);
        return FW_OK;
    }
    for (int i = 0; i < e->nattribute; i++)
        if (strcmp(e->attribute[i].name, attribute) == 0) {
            e->attribute[i] = value_of(set, attribute);
            return FW_OK;
        }
    size_t count = (size_t)e->nattribute;
    FW_NEED(e->attribute =
                fw_arena_grow(r->arena, e->attribute, count, count + 1, sizeof *e->attribute));
    e->attribute[e->nattribute++] = value_of(set, names[k]);
    return FW_OK;
}

typedef struct path {
    char *element, *id, *attribute; /* id NULL: left out */
} path;

/* splits ELEMENT[ID]/@ATTRIBUTE; *ok false when it is not one */
static fw_status split(fw_arena *arena, const char *text, path *p, bool *ok) {
    const char *at = strstr(text, "/@");
    *p = (path){0};
    *ok = false;
    if (!at) return FW_OK;
    size_t head = (size_t)(at - text), name = strcspn(text, "[/");
    FW_NEED(p->attribute = fw_arena_strdup(arena, at + 2));
    FW_NEED(p->element = fw_arena_strndup(arena, text, name));
    if (name < head) {
        if (text[head - 1] != ']' || head < name + 2) return FW_OK;
        FW_NEED(p->id = fw_arena_strndup(arena, text + name + 1, head - name - 2));
    }
    *ok = true;
    return FW_OK;
}

static fw_status set_attribute(fw_device_reader *r, const edit *set) {
    path p;
    bool ok;
    FW_TRY(split(r->arena, set->path, &p, &ok));
    if (!ok) {
        unknown_path(r, set, "this is no path", NULL, NULL, 0);
        return FW_OK;
    }
    const char *element = p.element, *id = p.id, *attribute = p.attribute;
    const fw_xml_element_row *row = fw_xml_row_find(&fw_device_table, element);
    if (!row) {
        const char *names[FW_ELEMENTS_MOST];
        size_t n = 0;
        for (int i = 0; n < FW_ELEMENTS_MOST && (row = fw_xml_row_at(&fw_device_table, i)) != NULL;
             i++)
            names[n++] = row->name;
        unknown_path(r, set, "there is no such element", element, names, n);
        return FW_OK;
    }
    size_t most = count_named(r->xml.root, element);
    fw_xml_element **found = fw_arena_array(r->arena, fw_xml_element *, most);
    const char **names = fw_arena_array(r->arena, const char *, most);
    FW_NEED(found && names);
    size_t n = collect(r->xml.root, element, row->key, found, names, most, 0);
    size_t first = n, same = 0;
    for (size_t i = 0; i < n; i++)
        if (id ? row->key && strcmp(names[i], id) == 0 : n == 1) {
            first = first < n ? first : i;
            same++;
        }
    if (same > 1 && row->within) { /* ids of a scene: another scene may have the same */
        unknown_path(r, set,
                     "several scenes have an element with this id; give the attribute of each a "
                     "parameter and set that",
                     NULL, NULL, 0);
        return FW_OK;
    }
    if (first < n) return replace(r, set, found[first], row, attribute);
    unknown_path(r, set,
                 id  ? "no such element has this id"
                 : n ? row->key ? "several such elements; name one"
                                : "several such elements, which have no names; give the attribute "
                                  "of each a parameter and set that"
                     : "there is no such element",
                 id, names, row->key ? n : 0);
    return FW_OK;
}

fw_status fw_device_sets_apply(fw_device_reader *r, const fw_device_set *set, int nset) {
    FW_NEED(r->override_ =
                fw_arena_array(r->arena, fw_device_override, (size_t)(nset > 0 ? nset : 0)));
    for (int i = 0; i < nset; i++) {
        edit copy = {
            fw_arena_strdup(r->arena, set[i].path ? set[i].path : ""),
            fw_arena_strdup(r->arena, set[i].value ? set[i].value : ""),
            {fw_arena_printf(r->arena, "--set %.100s", set[i].path ? set[i].path : ""), 0, 0}};
        FW_NEED(copy.path && copy.value && copy.place.file);
        if (strpbrk(copy.path, "[]/@"))
            FW_TRY(set_attribute(r, &copy));
        else
            FW_TRY(set_parameter(r, &copy));
    }
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
