/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <pattern> rows of a layer table. Private to the room. */
#ifndef FW_MASK_CONTENT_H
#define FW_MASK_CONTENT_H
#include "device/xml.h"
#include "mask/mask.h"

/* reads all <pattern> below <mask-table>; mistakes are FW-D185 */
fw_status fw_mask_table_content(fw_arena *arena, const fw_element *root, fw_diags *diags,
                                fw_mask_table *table);

#endif
