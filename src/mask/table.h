/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading of layer tables, shared by its files. Private to the room. */
#ifndef FW_MASK_TABLE_H
#define FW_MASK_TABLE_H
#include "device/xml.h"
#include "mask/mask.h"

/* 1 to 400 plain ASCII characters, else FW-D141 and *out as it was */
void fw_table_text(fw_diags *diags, const fw_attribute *a, const char **out);
/* the rows <rule>, once all layers are known (table_rules.c) */
fw_status fw_table_rules(fw_arena *arena, const fw_element *root, fw_diags *diags,
                         fw_mask_table *table);

#endif
