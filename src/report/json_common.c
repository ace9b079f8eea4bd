/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_common.h"
#include <math.h>

json_t *fw_json_real(double value) {
    if (value == 0.0) value = 0.0; /* no minus zero */
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *fw_json_text(const char *string) {
    if (!string) return json_null();
    json_t *value = json_string(string);
    return value ? value : json_string("?"); /* text that is not UTF-8 */
}

void fw_json_put(json_t *object, const char *key, json_t *value, bool *failed) {
    if (json_object_set_new(object, key, value) != 0) /* releases `value` even when it fails */
        *failed = true;
}

void fw_json_push(json_t *array, json_t *value, bool *failed) {
    if (json_array_append_new(array, value) != 0) *failed = true;
}

json_t *fw_json_pair(double a, double b, bool *failed) {
    json_t *pair = json_array();
    fw_json_push(pair, fw_json_real(a), failed);
    fw_json_push(pair, fw_json_real(b), failed);
    return pair;
}

static int add(const char *buffer, size_t size, void *data) {
    fw_text *out = data;
    fw_text_bytes(out, buffer, size);
    return out->failed ? -1 : 0;
}

fw_status fw_json_write(json_t *root, bool failed, fw_text *out) {
    if (!root || failed) {
        json_decref(root);
        return FW_NOMEM;
    }
    int bad = json_dump_callback(root, add, out, JSON_REAL_PRECISION(17) | JSON_INDENT(1));
    json_decref(root);
    fw_text_add(out, "\n");
    return bad ? FW_NOMEM : fw_text_end(out);
}
