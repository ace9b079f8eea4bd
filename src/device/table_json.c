/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of elements and attributes as JSON, for forms that are generated from it. */
#include "device/reader.h"
#include <string.h>

static void pair(fw_text *out, const char *key, const char *value) {
    fw_text_printf(out, ",\"%s\":", key);
    if (value)
        fw_text_json(out, value);
    else
        fw_text_add(out, "null");
}

static const char *const kind_text[] = {
    [FW_KIND_TEXT] = "text",     [FW_KIND_ID] = "id",         [FW_KIND_NAME] = "name",
    [FW_KIND_WORD] = "word",     [FW_KIND_NUMBER] = "number", [FW_KIND_ANY] = "expression",
    [FW_KIND_TIMED] = "in-time", [FW_KIND_TABLE] = "table",   [FW_KIND_REF] = "reference"};

/* in the unit of the row, to the digits that messages have */
static void bound(fw_text *out, const char *key, const fw_attribute_row *a, double value) {
    fw_unit unit = {.factor = 1.0};
    fw_text_printf(out, ",\"%s\":", key);
    if (a->unit && a->unit[0]) fw_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL);
    if (a->ranged)
        fw_text_number(out, fw_unit_from_si(&unit, value), 12);
    else
        fw_text_add(out, "null");
}

static void attribute(fw_text *out, const fw_attribute_row *a) {
    fw_text_add(out, "{\"name\":");
    fw_text_json(out, a->name);
    pair(out, "type", kind_text[a->kind]);
    pair(out, "unit", fw_kind_is_expression(a->kind) ? a->unit : NULL);
    pair(out, "dimension",
         a->kind == FW_KIND_NUMBER || a->kind == FW_KIND_TIMED
             ? fw_dimension_text(out->arena, a->dimension)
             : NULL);
    pair(out, "default", a->fallback);
    bound(out, "minimum", a, a->min);
    bound(out, "maximum", a, a->max);
    fw_text_printf(out, ",\"above_minimum\":%s,\"whole\":%s,\"required\":%s",
                   a->open ? "true" : "false", a->whole ? "true" : "false",
                   a->required ? "true" : "false");
    pair(out, "range_reason", a->ranged ? a->reason : NULL);
    fw_text_add(out, ",\"choices\":");
    fw_text_add(out, a->words ? "[" : "null");
    for (int i = 0; a->words && a->words[i]; i++) {
        fw_text_add(out, i ? "," : "");
        fw_text_json(out, a->words[i]);
    }
    fw_text_add(out, a->words ? "]" : "");
    pair(out, "refers_to", a->kind == FW_KIND_REF ? fw_space_text(a->space) : NULL);
    fw_text_printf(out, ",\"ground\":%s", a->ground ? "true" : "false");
    pair(out, "sentence", a->sentence);
    fw_text_add(out, "}");
}

fw_status fw_device_table_json(fw_text *out) {
    const fw_element_row *row;
    fw_text_add(out, "[");
    for (int i = 0; (row = fw_element_row_at(i)) != NULL; i++) {
        fw_text_add(out, i ? ",\n{\"name\":" : "\n{\"name\":");
        fw_text_json(out, row->name);
        pair(out, "parent", row->parent[0] ? row->parent : NULL);
        pair(out, "key", row->key);
        pair(out, "id_space", row->space != FW_SPACE_NONE ? fw_space_text(row->space) : NULL);
        fw_text_printf(out, ",\"once\":%s,\"most\":", row->once ? "true" : "false");
        if (row->most > 0)
            fw_text_printf(out, "%d", row->most);
        else
            fw_text_add(out, "null");
        pair(out, "sentence", row->sentence);
        fw_text_add(out, ",\"attributes\":[");
        for (int k = 0; k < row->nattribute; k++) {
            fw_text_add(out, k ? ",\n  " : "\n  ");
            attribute(out, &row->attribute[k]);
        }
        fw_text_add(out, "]}");
    }
    fw_text_add(out, "]");
    return fw_text_end(out);
}
