/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of elements and attributes as JSON, for forms that are generated from it. */
#include "base/members.h"
#include "device/reader.h"
#include <string.h>

static const char *const kind_text[] = {
    [FW_KIND_TEXT] = "text",     [FW_KIND_ID] = "id",         [FW_KIND_NAME] = "name",
    [FW_KIND_WORD] = "word",     [FW_KIND_NUMBER] = "number", [FW_KIND_ANY] = "expression",
    [FW_KIND_TIMED] = "in-time", [FW_KIND_TABLE] = "table",   [FW_KIND_REF] = "reference"};

/* in the unit of the row, to the digits that messages have */
static void bound(fw_text *out, const char *key, const fw_attribute_row *a, double value) {
    fw_unit unit = {.factor = 1.0};
    if (a->unit && a->unit[0]) fw_unit_parse(a->unit, strlen(a->unit), &unit, NULL, NULL);
    if (a->ranged)
        fw_put_number(out, key, fw_unit_from_si(&unit, value), 12);
    else
        fw_put_null(out, key);
}

static void attribute(fw_text *out, const fw_attribute_row *a) {
    bool fixed = a->kind == FW_KIND_NUMBER || a->kind == FW_KIND_TIMED;
    fw_text_add(out, "{");
    fw_put_text(out, "name", a->name);
    fw_put_text(out, "type", kind_text[a->kind]);
    fw_put_text(out, "unit", fw_kind_is_expression(a->kind) ? a->unit : NULL);
    fw_put_text(out, "dimension", fixed ? fw_dimension_text(out->arena, a->dimension) : NULL);
    fw_put_text(out, "default", a->fallback);
    bound(out, "minimum", a, a->min);
    bound(out, "maximum", a, a->max);
    fw_put_truth(out, "above_minimum", a->open);
    fw_put_truth(out, "whole", a->whole);
    fw_put_truth(out, "required", a->required);
    fw_put_text(out, "range_reason", a->ranged ? a->reason : NULL);
    if (a->words) {
        fw_put_open(out, "choices", '[');
        for (int i = 0; a->words[i]; i++)
            fw_put_text(out, NULL, a->words[i]);
        fw_text_add(out, "]");
    } else
        fw_put_null(out, "choices");
    fw_put_text(out, "refers_to", a->kind == FW_KIND_REF ? fw_space_text(a->space) : NULL);
    fw_put_truth(out, "ground", a->ground);
    fw_put_text(out, "sentence", a->sentence);
    fw_text_add(out, "}");
}

static fw_status element(fw_text *out, const fw_element_row *row) {
    fw_device_attributes all;
    FW_TRY(fw_device_attributes_of(out->arena, row, &all));
    fw_put_open(out, NULL, '{');
    fw_put_text(out, "name", row->name);
    fw_put_text(out, "parent", row->parent[0] ? row->parent : NULL);
    fw_put_text(out, "key", row->key);
    fw_put_text(out, "id_space", row->space != FW_SPACE_NONE ? fw_space_text(row->space) : NULL);
    fw_put_truth(out, "once", row->once);
    if (row->most > 0)
        fw_put_whole(out, "most", row->most);
    else
        fw_put_null(out, "most");
    fw_put_text(out, "sentence", row->sentence);
    fw_put_open(out, "attributes", '[');
    for (int k = 0; k < all.count; k++) {
        fw_put_line(out);
        fw_text_add(out, "  ");
        attribute(out, &all.item[k]);
    }
    fw_text_add(out, "]}");
    return FW_OK;
}

fw_status fw_device_table_json(fw_text *out) {
    const fw_element_row *row;
    fw_put_open(out, NULL, '[');
    for (int i = 0; (row = fw_element_row_at(i)) != NULL; i++) {
        fw_put_line(out);
        FW_TRY(element(out, row));
    }
    fw_text_add(out, "]");
    return fw_text_end(out);
}
