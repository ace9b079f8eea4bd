/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Building JSON: keys stay in the order in which they are put; failures stick. */
#ifndef FW_REPORT_JSON_COMMON_H
#define FW_REPORT_JSON_COMMON_H
#include "base/text.h"
#include <jansson.h>
#include <stdbool.h>

json_t *fw_json_real(double value);       /* null when not finite */
json_t *fw_json_text(const char *string); /* null for NULL */
/* takes `value` over; *failed is set when it or the container is missing */
void fw_json_put(json_t *object, const char *key, json_t *value, bool *failed);
void fw_json_push(json_t *array, json_t *value, bool *failed);
json_t *fw_json_pair(double a, double b, bool *failed);
/* writes and releases `root` (may be NULL) */
fw_status fw_json_write(json_t *root, bool failed, fw_text *out);
#endif
