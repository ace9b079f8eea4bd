/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a form is generated from: everything comes from the tables that check the description, make
   --help and the reference pages. */
#include "base/json.h"
#include "dynamics/dynamics.h"
#include "plan/live_request.h"
#include "plan/stages.h"
#include "report/preview.h"
#include <math.h>

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
