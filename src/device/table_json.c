/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of elements and attributes as JSON, for forms that are generated from it. */
#include "base/json.h"
#include "device/reader.h"
#include <string.h>

static const char *const kind_text[] = {
    [FW_KIND_TEXT] = "text",     [FW_KIND_ID] = "id",         [FW_KIND_NAME] = "name",
    [FW_KIND_WORD] = "word",     [FW_KIND_NUMBER] = "number", [FW_KIND_ANY] = "expression",
    [FW_KIND_TIMED] = "in-time", [FW_KIND_TABLE] = "table",   [FW_KIND_REF] = "reference"};

/* in the unit of the row, to the digits that messages have */
static void bound(fw_json *out, const char *key, const fw_attribute_row *a, double value) {
    fw_unit unit = {.factor = 1.0};
    if (a->unit && a->unit[0]) fw_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL);
    if (a->ranged)
        fw_json_number(out, key, fw_unit_from_si(&unit, value), 12);
    else
        fw_json_null(out, key);
}

static void attribute(fw_json *out, const fw_attribute_row *a) {
    bool fixed = a->kind == FW_KIND_NUMBER || a->kind == FW_KIND_TIMED;
    fw_json_object(out, NULL);
    fw_json_text(out, "name", a->name);
    fw_json_text(out, "type", kind_text[a->kind]);
    fw_json_text(out, "unit", fw_kind_is_expression(a->kind) ? a->unit : NULL);
    fw_json_text(out, "dimension", fixed ? fw_dimension_text(out->out->arena, a->dimension) : NULL);
    fw_json_text(out, "default", a->fallback);
    bound(out, "minimum", a, a->min);
    bound(out, "maximum", a, a->max);
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
    fw_json_text(out, "refers_to", a->kind == FW_KIND_REF ? fw_space_text(a->space) : NULL);
    fw_json_truth(out, "ground", a->ground);
    fw_json_text(out, "sentence", a->sentence);
    fw_json_end(out);
}

static fw_status element(fw_json *out, const fw_element_row *row) {
    fw_device_attributes all;
    FW_TRY(fw_device_attributes_of(out->out->arena, row, &all));
    fw_json_object(out, NULL);
    fw_json_text(out, "name", row->name);
    fw_json_text(out, "parent", row->parent[0] ? row->parent : NULL);
    fw_json_text(out, "key", row->key);
    fw_json_text(out, "id_space", row->space != FW_SPACE_NONE ? fw_space_text(row->space) : NULL);
    fw_json_truth(out, "once", row->once);
    if (row->most > 0)
        fw_json_whole(out, "most", row->most);
    else
        fw_json_null(out, "most");
    fw_json_text(out, "sentence", row->sentence);
    fw_json_list(out, "attributes");
    for (int k = 0; k < all.count; k++) {
        fw_json_line(out, 2);
        attribute(out, &all.item[k]);
    }
    fw_json_end(out);
    fw_json_end(out);
    return FW_OK;
}

fw_status fw_device_table_json(fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    const fw_element_row *row;
    fw_json_list(out, NULL);
    for (int i = 0; (row = fw_element_row_at(i)) != NULL; i++) {
        fw_json_line(out, 0);
        FW_TRY(element(out, row));
    }
    fw_json_end(out);
    return fw_json_finish(out, "");
}
