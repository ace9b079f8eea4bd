/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes to the text of a description, asked for as JSON. */
#include "base/json.h"
#include "plan/live_request.h"
#include "report/preview.h"
#include <string.h>

enum { ATTRIBUTES_MOST = 64 }; /* as in any element */

/* {"name": "value", ...} */
static fw_status attributes(fw_plan_live_request *r, const json_t *from,
                            fw_device_text_change *change) {
    json_t *object = json_object_get(from, "attributes"), *value;
    const char *name;
    if (!object || json_is_null(object)) return FW_OK;
    if (!json_is_object(object))
        return fw_plan_live_wrong(r, "an object is wanted for", "attributes");
    size_t n = json_object_size(object);
    if (n > ATTRIBUTES_MOST) return fw_plan_live_wrong(r, "more than 64 attributes", NULL);
    fw_device_text_attribute *item = fw_arena_array(r->arena, fw_device_text_attribute, n);
    FW_NEED(item);
    json_object_foreach(object, name, value) {
        if (!json_is_string(value)) return fw_plan_live_wrong(r, "a string is wanted for", name);
        item[change->nattribute++] = (fw_device_text_attribute){name, json_string_value(value)};
    }
    change->attribute = item;
    return FW_OK;
}

/* {"path", "value"}, {"add": PARENT, "element", "attributes"}, {"remove": PATH} */
static fw_status change_of(fw_plan_live_request *r, const json_t *from,
                           fw_device_text_change *change) {
    static const char *const known[] = {"path", "value", "add", "element", "attributes", "remove"};
    const char *key, *path = NULL, *add = NULL, *remove = NULL;
    json_t *value;
    if (!json_is_object(from)) return fw_plan_live_wrong(r, "a change is an object", NULL);
    json_object_foreach((json_t *)from, key, value) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
            found = found || strcmp(key, known[i]) == 0;
        if (!found) return fw_plan_live_wrong(r, "there is no key", key);
    }
    *change = (fw_device_text_change){.kind = FW_CHANGE_SET};
    FW_TRY(fw_plan_live_string(r, from, "path", &path));
    FW_TRY(fw_plan_live_string(r, from, "add", &add));
    FW_TRY(fw_plan_live_string(r, from, "remove", &remove));
    FW_TRY(fw_plan_live_string(r, from, "value", &change->value));
    FW_TRY(fw_plan_live_string(r, from, "element", &change->element));
    FW_TRY(attributes(r, from, change));
    if ((path != NULL) + (add != NULL) + (remove != NULL) != 1)
        return fw_plan_live_wrong(r, "a change has one of \"path\", \"add\" and \"remove\"", NULL);
    if (path && !json_object_get(from, "value"))
        return fw_plan_live_wrong(r, "a value is wanted (null takes the attribute out) with",
                                  "path");
    if (add && !change->element) return fw_plan_live_wrong(r, "an element is wanted with", "add");
    change->kind = path ? FW_CHANGE_SET : add ? FW_CHANGE_ADD : FW_CHANGE_REMOVE;
    change->path = path ? path : add ? add : remove;
    return FW_OK;
}

static fw_status changes_of(fw_plan_live_request *r, fw_device_text_change **change, int *n) {
    const json_t *list = json_object_get(r->root, "changes");
    if (!json_is_array(list)) return fw_plan_live_wrong(r, "a list is wanted for", "changes");
    if (json_array_size(list) > FW_LIVE_CHANGES_MOST)
        return fw_plan_live_wrong(r, "more than 256 changes", NULL);
    *n = (int)json_array_size(list);
    FW_NEED(*change = fw_arena_array(r->arena, fw_device_text_change, (size_t)*n));
    for (int i = 0; i < *n; i++)
        FW_TRY(change_of(r, json_array_get(list, (size_t)i), &(*change)[i]));
    return FW_OK;
}

static fw_status edit(fw_plan_live *live, fw_plan_live_request *r, fw_text *answer) {
    (void)live;
    fw_device_text_change *change = NULL;
    int n = 0;
    FW_TRY(changes_of(r, &change, &n));
    fw_diags diags = fw_diags_new(r->arena);
    fw_text text = fw_text_new(r->arena);
    fw_status status =
        fw_device_edit(r->arena, "device.xml", r->text, r->length, change, n, &diags, &text);
    if (status != FW_OK && status != FW_INPUT) return status;
    fw_json json = fw_json_new(answer, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.edit/1");
    fw_json_text(out, "status", status == FW_OK ? "ok" : "invalid");
    fw_json_line(out, 0);
    fw_report_preview_diagnostics(&diags, "device.xml", out);
    fw_json_line(out, 0);
    fw_json_text(out, "text", status == FW_OK ? text.data : NULL);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

fw_plan_live_answer fw_plan_live_edit(fw_plan_live *live, const char *request, size_t n) {
    static const char *const keys[] = {"text", "changes", NULL};
    return fw_plan_live_call(live, request, n, keys, edit);
}
