/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/json.h"
#include <math.h>

void fw_mask_json_string(fw_text *out, const char *s) {
    if (s)
        fw_text_json(out, s);
    else
        fw_text_add(out, "null");
}

void fw_mask_json_text(fw_text *out, const char *key, const char *value) {
    fw_text_printf(out, "\"%s\": ", key);
    fw_mask_json_string(out, value);
}

void fw_mask_json_number(fw_text *out, const char *key, double value, int digits) {
    fw_text_printf(out, "\"%s\": ", key);
    if (isfinite(value))
        fw_text_number(out, value, digits);
    else
        fw_text_add(out, "null");
}
