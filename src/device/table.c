/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/table.h"
#include <string.h>

static const struct {
    const fw_element_row *row;
    const int *count;
} parts[] = {{fw_table_device, &fw_table_device_count},
             {fw_table_mechanism, &fw_table_mechanism_count},
             {fw_table_scene, &fw_table_scene_count},
             {fw_table_effects, &fw_table_effects_count}};
enum { PARTS = sizeof parts / sizeof parts[0] };

const fw_element_row *fw_element_row_at(int i) {
    for (int k = 0; k < PARTS && i >= 0; i -= *parts[k++].count)
        if (i < *parts[k].count) return &parts[k].row[i];
    return NULL;
}

int fw_element_index(const char *name) {
    const fw_element_row *row;
    for (int i = 0; (row = fw_element_row_at(i)) != NULL; i++)
        if (strcmp(row->name, name) == 0) return i;
    return -1;
}

const fw_element_row *fw_element_row_find(const char *name) {
    return fw_element_row_at(fw_element_index(name));
}

const char *fw_space_text(fw_space space) {
    static const char *const text[FW_SPACE_COUNT] = {"name",  "parameter", "flow",       "flexure",
                                                     "body",  "joint",     "spring",     "driver",
                                                     "scene", "tendon",    "comb-drive", "contact"};
    return text[space];
}

bool fw_kind_is_expression(fw_kind kind) {
    return kind == FW_KIND_NUMBER || kind == FW_KIND_ANY || kind == FW_KIND_TIMED ||
           kind == FW_KIND_TABLE;
}
