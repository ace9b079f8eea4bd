/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters, evaluated in the order of their dependencies. */
#include "device/device_reader.h"
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
    bool ok = true;
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
