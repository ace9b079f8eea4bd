/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters, evaluated in the order of their dependencies. */
#include "device/device_table.h"
#include "device/device_reader.h"
#include "quantity/program.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum state { WAITING, OPEN, DONE, LOST } state;

typedef struct item {
    fw_xml_record *record;
    const fw_xml_attribute *value, *set; /* set: from --set, or NULL */
    state state;
    bool checked; /* against its bounds */
} item;

typedef struct work {
    fw_device_reader *r;
    item *item;
    int n;
    int path[256], depth; /* items being evaluated, outermost first */
} work;

static fw_status evaluate(work *w, int k);

static void lose(work *w, int k) {
    item *p = &w->item[k];
    if (p->state == LOST) return;
    p->state = LOST;
    const fw_xml_cell *name = fw_xml_cell_of(p->record, "name");
    if (name->given) w->r->xml.lost[w->r->xml.nlost++] = name->given->value;
}

static int find(const work *w, const char *name) {
    for (int i = 0; i < w->n; i++)
        if (strcmp(w->r->device->parameter[i].name, name) == 0) return i;
    return -1;
}

static void report_cycle(work *w, int k) {
    char chain[400] = "";
    size_t used = 0;
    int first = 0;
    while (w->path[first] != k)
        first++;
    for (int i = first; i < w->depth; i++) {
        const char *name = w->r->device->parameter[w->path[i]].name;
        if (used + strlen(name) + 5 < sizeof chain)
            used += (size_t)snprintf(chain + used, sizeof chain - used, "%s -> ", name);
    }
    fw_diag_error(w->r->diags, 53, w->item[k].value->place,
                  "parameter '%s' depends on itself: %s%s; give one of them a plain value",
                  w->r->device->parameter[k].name, chain, w->r->device->parameter[k].name);
    for (int i = first; i < w->depth; i++)
        lose(w, w->path[i]);
}

static fw_status evaluate_needed(work *w, const fw_xml_attribute *a) {
    const char *const *names;
    size_t count;
    FW_TRY(fw_quantity_expression_names(w->r->arena, a->value, strlen(a->value), &names, &count));
    for (size_t i = 0; i < count; i++) {
        int k = find(w, names[i]);
        if (k >= 0) FW_TRY(evaluate(w, k));
    }
    return FW_OK;
}

/* value of the file for the dimension, then --set's in its place */
static fw_status evaluate_one(work *w, int k) {
    item *p = &w->item[k];
    fw_device_parameter *out = &w->r->device->parameter[k];
    bool ok = true;
    if (p->value)
        FW_TRY(fw_xml_attribute_evaluate(&w->r->xml, p->value, out->name, NULL, &out->dimension,
                                         &out->value, &ok));
    if (ok && p->set) {
        fw_quantity_dimension found;
        FW_TRY(fw_xml_attribute_evaluate(&w->r->xml, p->set, out->name, &out->dimension, &found,
                                         &out->value, &ok));
        out->overridden = true;
    }
    if (!ok || !p->value || p->state == LOST || fw_xml_failed(p->record, "name")) {
        lose(w, k);
        return FW_OK;
    }
    p->state = DONE;
    w->r->name[w->r->xml.names.count] =
        (fw_quantity_name_value){out->name, out->value, out->dimension};
    w->r->xml.names.count++;
    return FW_OK;
}

static fw_status evaluate(work *w, int k) {
    item *p = &w->item[k];
    if (p->state == DONE || p->state == LOST) return FW_OK;
    if (p->state == OPEN) {
        report_cycle(w, k);
        return FW_OK;
    }
    p->state = OPEN;
    w->path[w->depth++] = k;
    if (p->value) FW_TRY(evaluate_needed(w, p->value));
    if (p->set) FW_TRY(evaluate_needed(w, p->set));
    w->depth--;
    return p->state == LOST ? FW_OK : evaluate_one(w, k);
}

static fw_status check(work *w, int k);

/* those that a value is computed from come first: what goes wrong there is not said again here */
static fw_status check_needed(work *w, const fw_xml_attribute *a) {
    const char *const *names;
    size_t count;
    FW_TRY(fw_quantity_expression_names(w->r->arena, a->value, strlen(a->value), &names, &count));
    for (size_t i = 0; i < count; i++) {
        int k = find(w, names[i]);
        if (k >= 0) FW_TRY(check(w, k));
    }
    return FW_OK;
}

static bool uses_lost(const work *w, const fw_xml_attribute *a) {
    return a &&
           fw_quantity_expression_uses(a->value, strlen(a->value), w->r->xml.lost, w->r->xml.nlost);
}

/* Both bounds are of one kind and the value of another: the value is the odd one out, and its users, which would each say
   so again, keep silent. *ok: it is not so */
static fw_status bounds_agree(work *w, int k, bool *ok) {
    fw_device_reader *r = w->r;
    const item *p = &w->item[k];
    const fw_device_parameter *out = &r->device->parameter[k];
    const fw_xml_attribute *low = fw_xml_cell_of(p->record, "min")->given,
                           *high = fw_xml_cell_of(p->record, "max")->given;
    fw_quantity_dimension of_low, of_high;
    double ignored;
    *ok = true;
    if (!low || !high || uses_lost(w, low) || uses_lost(w, high)) return FW_OK;
    fw_diags quiet = fw_diags_new(r->arena), *said = r->xml.diags;
    bool read = true, also = true;
    r->xml.diags = &quiet;
    fw_status status =
        fw_xml_attribute_evaluate(&r->xml, low, "min", NULL, &of_low, &ignored, &read);
    if (status == FW_OK)
        status = fw_xml_attribute_evaluate(&r->xml, high, "max", NULL, &of_high, &ignored, &also);
    r->xml.diags = said;
    if (status != FW_OK || !read || !also) return status;
    *ok = !fw_quantity_dimension_equal(
              of_low, of_high) || /* numbers that lack their unit are what is wrong */
          fw_quantity_dimension_equal(of_low, (fw_quantity_dimension){0}) ||
          fw_quantity_dimension_equal(of_low, out->dimension) ||
          fw_quantity_dimension_differs_in_angle(of_low, out->dimension);
    if (*ok) return FW_OK;
    const char *value = fw_quantity_dimension_phrase(r->arena, out->dimension),
               *bound = fw_quantity_dimension_phrase(r->arena, of_low);
    FW_NEED(value && bound ? value : NULL);
    fw_diag_error(r->diags, 25, p->set ? p->set->place : p->value->place,
                  "parameter '%s': its value is %s, and its min and max are each %s; give all "
                  "three in units of "
                  "one kind",
                  out->name, value, bound);
    lose(w, k);
    return FW_OK;
}

/* value and bounds; a parameter outside of its bounds is lost, so that its users keep silent */
static fw_status read_bounds(work *w, int k) {
    fw_device_reader *r = w->r;
    item *p = &w->item[k];
    fw_device_parameter *out = &r->device->parameter[k];
    if (uses_lost(w, p->set ? p->set : p->value)) {
        lose(w, k);
        return FW_OK;
    }
    double *bound[] = {&out->min, &out->max};
    static const char *const name[] = {"min", "max"};
    bool ok;
    FW_TRY(bounds_agree(w, k, &ok));
    if (!ok) return FW_OK;
    for (int i = 0; i < 2; i++) {
        const fw_xml_attribute *a = fw_xml_cell_of(p->record, name[i])->given;
        bool read = true;
        fw_quantity_dimension found;
        if (a)
            FW_TRY(fw_xml_attribute_evaluate(&r->xml, a, name[i], &out->dimension, &found, bound[i],
                                             &read));
        ok = ok && read;
    }
    if (!ok) return FW_OK;
    const char *unit = out->unit[0] ? out->unit : NULL;
    char value[FW_LABEL], limit[FW_LABEL];
    fw_place place = p->set ? p->set->place : out->place;
    if (out->min > out->max)
        fw_diag_error(r->diags, 63, fw_xml_place_of(p->record, "min"),
                      "parameter '%s': min %s is above max %s; exchange them", out->name,
                      fw_xml_in_unit(value, out->min, unit), fw_xml_in_unit(limit, out->max, unit));
    else if (out->value < out->min || out->value > out->max) {
        lose(w, k);
        fw_diag_error(r->diags, 57, place,
                      "parameter '%s' is %s; its declaration allows %s %s; change the value or the "
                      "declaration",
                      out->name, fw_xml_in_unit(value, out->value, unit),
                      out->value < out->min ? "at least" : "at most",
                      fw_xml_in_unit(limit, out->value < out->min ? out->min : out->max, unit));
    }
    return FW_OK;
}

static fw_status check(work *w, int k) {
    item *p = &w->item[k];
    fw_device_parameter *out = &w->r->device->parameter[k];
    if (p->state != DONE || p->checked) return FW_OK;
    p->checked = true;
    FW_TRY(fw_quantity_expression_unit(w->r->arena, p->value->value, strlen(p->value->value),
                                       out->dimension, &out->unit));
    if (strcmp(out->unit, "Cel") == 0) w->r->xml.celsius[w->r->xml.ncelsius++] = out->name;
    FW_TRY(check_needed(w, p->set ? p->set : p->value));
    return read_bounds(w, k);
}

static fw_status prepare(work *w) {
    fw_device_reader *r = w->r;
    int n = w->n = fw_xml_count(&r->xml, "parameter");
    r->device->nparameter = n;
    FW_NEED(w->item = fw_arena_array(r->arena, item, (size_t)n));
    FW_NEED(r->device->parameter = fw_arena_array(r->arena, fw_device_parameter, (size_t)n));
    FW_NEED(r->name = fw_arena_array(r->arena, fw_quantity_name_value, (size_t)n));
    FW_NEED(r->xml.lost = fw_arena_array(r->arena, const char *, (size_t)n));
    FW_NEED(r->xml.celsius = fw_arena_array(r->arena, const char *, (size_t)n));
    r->xml.names = (fw_quantity_names){r->name, 0};
    for (int i = 0, k = 0; i < r->xml.nrecord; i++) {
        fw_xml_record *record = &r->xml.record[i];
        if (!fw_xml_is(record, "parameter")) continue;
        const fw_xml_attribute *name = fw_xml_cell_of(record, "name")->given;
        const fw_xml_attribute *doc = fw_xml_cell_of(record, "doc")->given;
        w->item[k] = (item){.record = record, .value = fw_xml_cell_of(record, "value")->given};
        for (int j = 0; j < r->noverride; j++)
            if (r->override_[j].element == record->element)
                w->item[k].set = r->override_[j].attribute;
        r->device->parameter[k++] =
            (fw_device_parameter){.name = name ? name->value : "",
                                  .doc = doc ? doc->value : "",
                                  .min = -(double)INFINITY,
                                  .max = (double)INFINITY,
                                  .unit = "",
                                  .place = fw_xml_place_of(record, "value")};
    }
    return FW_OK;
}

fw_status fw_device_parameters_read(fw_device_reader *r) {
    work w = {.r = r};
    FW_TRY(prepare(&w));
    for (int i = 0; i < w.n; i++)
        FW_TRY(evaluate(&w, i));
    for (int i = 0; i < w.n; i++)
        FW_TRY(check(&w, i));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}

/* --set PATH=VALUE replaces an attribute before anything is evaluated. */

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
    const char *meant = word && n ? fw_text_meant(r->arena, word, names, n) : NULL;
    const bool near = meant && strstr(meant, "did you mean");
    fw_diag_error(r->diags, 55, set->place, "%s%s%s", what, meant ? meant : "",
                  near ? ""
                  : strchr(set->path, '.')
                      ? "; a value of a process, such as cavity.d, is set in a laboratory pack "
                        "(--lab FILE)"
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

/* SCENE[ID]/ELEMENT[ID]/@ATTRIBUTE, or an element by its number: as changes of a text name them */
static bool is_long(const char *text) {
    const char *at = strstr(text, "/@"), *slash = strchr(text, '/'), *in = strchr(text, '[');
    return at && (slash < at || (in && in < at && in[1] >= '0' && in[1] <= '9'));
}

static fw_status set_long(fw_device_reader *r, const edit *set) {
    fw_device_path p;
    fw_xml_element *e;
    bool there = fw_device_path_find(r->xml.root, set->path, &e, &p);
    const fw_xml_element_row *row =
        there ? fw_xml_row_in(&fw_device_table, e->name, e->parent ? e->parent->name : "") : NULL;
    if (row && p.attribute) return replace(r, set, e, row, p.attribute);
    unknown_path(r, set, there ? "this is no path" : p.wrong, NULL, NULL, 0);
    return FW_OK;
}

static fw_status set_attribute(fw_device_reader *r, const edit *set) {
    path p;
    bool ok;
    if (is_long(set->path)) return set_long(r, set);
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
                     "several scenes have an element with this id; name the scene, too, as in "
                     "scene[NAME]/tendon[ID]/@pull",
                     NULL, NULL, 0);
        return FW_OK;
    }
    if (first < n) return replace(r, set, found[first], row, attribute);
    unknown_path(r, set,
                 id  ? "no such element has this id"
                 : n ? row->key ? "several such elements; name one"
                                : "several such elements, which have no names; give the number of "
                                  "one, as in force[2]/@fx"
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
