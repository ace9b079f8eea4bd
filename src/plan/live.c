/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Live computing: its table, and changes to a text. Requests are read in live_request.c. */
#include "base/json.h"
#include "dynamics/dynamics.h"
#include "plan/live.h"
#include "plan/stages.h"
#include "report/report.h"
#include <math.h>
#include <string.h>

fw_plan_live *fw_plan_live_new(const fw_plan_live_settings *settings) {
    fw_arena *self = fw_arena_new(0);
    fw_plan_live *live = self ? fw_arena_one(self, fw_plan_live) : NULL;
    if (!live) {
        fw_arena_free(self);
        return NULL;
    }
    *live = (fw_plan_live){.self = self};
    if (settings) live->settings = *settings;
    return live;
}

void fw_plan_live_free(fw_plan_live *live) {
    if (!live) return;
    fw_plan_live_posed_free(live->posed);
    fw_plan_live_shown_free(live);
    if (live->kept) live->kept_free(live->kept);
    fw_arena_free(live->answer);
    fw_arena_free(live->self);
}

/* ---- what a form is generated from ----
   Everything comes from the tables that check the description, make --help and the reference
   pages. */

static void begin(fw_json *out, const char *key) {
    fw_json_line(out, 0);
    fw_json_list(out, key);
}

static void item(fw_json *out, const char *name) {
    fw_json_line(out, 0);
    fw_json_object(out, NULL);
    fw_json_text(out, "name", name);
}

static void names(fw_json *out, const char *key, fw_multibody_method_row (*at)(size_t)) {
    begin(out, key);
    for (size_t i = 0; at(i).name; i++) {
        item(out, at(i).name);
        fw_json_text(out, "sentence", at(i).summary);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void effects(fw_json *out) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    begin(out, "effects");
    for (size_t i = 0; i < count; i++) {
        item(out, row[i]->id);
        fw_json_text(out, "sentence", row[i]->summary);
        fw_json_number(out, "cost", row[i]->cost, 6);
        fw_json_truth(out, "kept", row[i]->kept);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static fw_multibody_method_row hinge_model(size_t i) {
    if (i >= fw_effects_hinge_model_count()) return (fw_multibody_method_row){NULL, NULL};
    return (fw_multibody_method_row){fw_effects_hinge_model_text((fw_effects_hinge_model)i),
                                     fw_effects_hinge_model_summary((fw_effects_hinge_model)i)};
}

static void formats(fw_json *out) {
    const fw_mask_format *f;
    begin(out, "mask_formats");
    for (size_t i = 0; (f = fw_mask_format_at(i)) != NULL; i++) {
        item(out, f->name);
        fw_json_text(out, "ending", f->ending);
        fw_json_truth(out, "always", f->always);
        fw_json_truth(out, "usual", f->usual);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void units(fw_json *out) {
    size_t count;
    const char *const *name = fw_quantity_unit_names(&count);
    begin(out, "units");
    for (size_t i = 0; i < count; i++)
        fw_json_text(out, NULL, name[i]);
    fw_json_end(out);
    fw_json_line(out, 0);
    fw_json_list(out, "unit_factors");
    for (size_t i = 0; i < count; i++) {
        fw_quantity_unit unit = {.factor = 1.0};
        fw_quantity_unit_parse(name[i], strlen(name[i]), &unit, NULL, NULL);
        fw_json_number(out, NULL, unit.factor, 17);
    }
    fw_json_end(out);
}

static void limit(fw_json *out, const char *name, double least, double most, double usual) {
    fw_json_object(out, name);
    fw_json_number(out, "minimum", least, 6);
    fw_json_number(out, "maximum", most, 6);
    fw_json_number(out, "default", usual, 6);
    fw_json_end(out);
}

fw_status fw_plan_table_json(fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.table/1");
    fw_json_text(out, "version", FW_VERSION);
    fw_json_text(out, "namespace", "urn:flexwright:device:1");
    fw_json_line(out, 0);
    FW_TRY(fw_device_table_json(fw_json_value(out, "elements")));
    names(out, "methods", fw_multibody_method_at);
    names(out, "integrators", fw_dynamics_integrator_at);
    names(out, "stabilisations", fw_dynamics_stabilisation_at);
    names(out, "hinge_models", hinge_model);
    effects(out);
    formats(out);
    units(out);
    const fw_dynamics_motion_options usual = fw_plan_options_default().verdict.motion;
    fw_json_line(out, 0);
    fw_json_object(out, "limits");
    limit(out, "accuracy", FW_ACCURACY_LEAST, FW_ACCURACY_MOST, usual.accuracy);
    limit(out, "rtol", FW_RTOL_LEAST, FW_RTOL_MOST, (double)NAN);
    limit(out, "samples", 2, FW_LIVE_SAMPLES_MOST, FW_LIVE_SAMPLES);
    fw_json_end(out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

static fw_status table(fw_plan_live *live, fw_plan_live_request *request, fw_text *out) {
    (void)live, (void)request;
    return fw_plan_table_json(out);
}

fw_plan_live_answer fw_plan_live_table(fw_plan_live *live) {
    return fw_plan_live_call(live, NULL, 0, NULL, table);
}

/* ---- changes to the text of a description, asked for as JSON ---- */

enum { ATTRIBUTES_MOST = 64 }; /* as in any element */

/* {"name": "value", ...} */
static fw_status attributes(fw_plan_live_request *r, const json_t *from,
                            fw_device_text_change *change) {
    json_t *object = json_object_get(from, "attributes"), *value;
    const char *name;
    if (!object || json_is_null(object)) return FW_OK;
    if (!json_is_object(object))
        return fw_plan_live_wrong(r, "an object is needed for", "attributes");
    size_t n = json_object_size(object);
    if (n > ATTRIBUTES_MOST)
        return fw_plan_live_wrong(r, "more than 64 attributes, the most of one change", NULL);
    fw_device_text_attribute *item = fw_arena_array(r->arena, fw_device_text_attribute, n);
    FW_NEED(item);
    json_object_foreach(object, name, value) {
        if (!json_is_string(value)) return fw_plan_live_wrong(r, "a string is needed for", name);
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
    if (!json_is_object(from))
        return fw_plan_live_wrong(r, "every change has to be a JSON object", NULL);
    json_object_foreach((json_t *)from, key, value) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
            found = found || strcmp(key, known[i]) == 0;
        if (!found) return fw_plan_live_wrong(r, "this member is not known:", key);
    }
    *change = (fw_device_text_change){.kind = FW_CHANGE_SET};
    FW_TRY(fw_plan_live_string(r, from, "path", &path));
    FW_TRY(fw_plan_live_string(r, from, "add", &add));
    FW_TRY(fw_plan_live_string(r, from, "remove", &remove));
    FW_TRY(fw_plan_live_string(r, from, "value", &change->value));
    FW_TRY(fw_plan_live_string(r, from, "element", &change->element));
    FW_TRY(attributes(r, from, change));
    if ((path != NULL) + (add != NULL) + (remove != NULL) != 1)
        return fw_plan_live_wrong(r, "a change needs one of \"path\", \"add\" and \"remove\"",
                                  NULL);
    if (path && !json_object_get(from, "value"))
        return fw_plan_live_wrong(r, "a value (null removes the attribute) is needed with", "path");
    if (add && !change->element) return fw_plan_live_wrong(r, "an element is needed with", "add");
    change->kind = path ? FW_CHANGE_SET : add ? FW_CHANGE_ADD : FW_CHANGE_REMOVE;
    change->path = path ? path : add ? add : remove;
    return FW_OK;
}

static fw_status changes_of(fw_plan_live_request *r, fw_device_text_change **change, int *n) {
    const json_t *list = json_object_get(r->root, "changes");
    if (!json_is_array(list)) return fw_plan_live_wrong(r, "a list is needed for", "changes");
    if (json_array_size(list) > FW_LIVE_CHANGES_MOST)
        return fw_plan_live_wrong(r, "more than 256 changes, the most of one request", NULL);
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
