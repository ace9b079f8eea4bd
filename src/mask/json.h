/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Members of the JSON that this room writes by hand, in a fixed order. For this room and
   wafer/, whose certificate reads like those of masks. */
#ifndef FW_MASK_JSON_H
#define FW_MASK_JSON_H
#include "base/text.h"

void fw_mask_json_string(fw_text *out, const char *s); /* NULL: null */
void fw_mask_json_text(fw_text *out, const char *key, const char *value);
/* not finite means that nothing was found: null */
void fw_mask_json_number(fw_text *out, const char *key, double value, int digits);

#endif
