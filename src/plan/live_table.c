/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a form is generated from: everything comes from the tables that check the description, make
   --help and the reference pages. */
#include "base/members.h"
#include "dynamics/dynamics.h"
#include "plan/live_request.h"
#include "plan/stages.h"
#include "report/preview.h"
#include <math.h>

static void begin(fw_text *out, const char *key) {
    fw_put_line(out);
    fw_put_open(out, key, '[');
}

static void item(fw_text *out, const char *name) {
    fw_put_line(out);
    fw_put_open(out, NULL, '{');
    fw_put_text(out, "name", name);
}

static void names(fw_text *out, const char *key, fw_method_row (*at)(size_t)) {
    begin(out, key);
    for (size_t i = 0; at(i).name; i++) {
        item(out, at(i).name);
        fw_put_text(out, "sentence", at(i).summary);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void effects(fw_text *out) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    begin(out, "effects");
    for (size_t i = 0; i < count; i++) {
        item(out, row[i]->id);
        fw_put_text(out, "sentence", row[i]->summary);
        fw_put_number(out, "cost", row[i]->cost, 6);
        fw_put_truth(out, "kept", row[i]->kept);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static fw_method_row hinge_model(size_t i) {
    if (i > FW_HINGE_ELASTICA) return (fw_method_row){NULL, NULL};
    return (fw_method_row){fw_hinge_model_text((fw_hinge_model)i),
                           fw_hinge_model_summary((fw_hinge_model)i)};
}

static void formats(fw_text *out) {
    const fw_mask_format *f;
    begin(out, "mask_formats");
    for (size_t i = 0; (f = fw_mask_format_at(i)) != NULL; i++) {
        item(out, f->name);
        fw_put_text(out, "ending", f->ending);
        fw_put_truth(out, "always", f->always);
        fw_put_truth(out, "usual", f->usual);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void units(fw_text *out) {
    size_t count;
    const char *const *name = fw_unit_names(&count);
    begin(out, "units");
    for (size_t i = 0; i < count; i++)
        fw_put_text(out, NULL, name[i]);
    fw_text_add(out, "]");
}

static void limit(fw_text *out, const char *name, double least, double most, double usual) {
    fw_put_open(out, name, '{');
    fw_put_number(out, "minimum", least, 6);
    fw_put_number(out, "maximum", most, 6);
    fw_put_number(out, "default", usual, 6);
    fw_text_add(out, "}");
}

fw_status fw_plan_table_json(fw_text *out) {
    fw_text_add(out, "{\"schema\":\"flexwright.table/1\",\"version\":\"" FW_VERSION
                     "\",\"namespace\":\"urn:flexwright:device:1\",\n\"elements\":");
    FW_TRY(fw_device_table_json(out));
    names(out, "methods", fw_method_at);
    names(out, "integrators", fw_integrator_at);
    names(out, "stabilisations", fw_stabilisation_at);
    names(out, "hinge_models", hinge_model);
    effects(out);
    formats(out);
    units(out);
    const fw_motion_options usual = fw_plan_options_default().verdict.motion;
    fw_put_line(out);
    fw_put_open(out, "limits", '{');
    limit(out, "accuracy", FW_ACCURACY_LEAST, FW_ACCURACY_MOST, usual.accuracy);
    limit(out, "rtol", FW_RTOL_LEAST, FW_RTOL_MOST, (double)NAN);
    limit(out, "samples", 2, FW_LIVE_SAMPLES_MOST, FW_LIVE_SAMPLES);
    fw_text_add(out, "}}\n");
    return fw_text_end(out);
}

static fw_status table(fw_live *live, fw_live_request *request, fw_text *out) {
    (void)live, (void)request;
    return fw_plan_table_json(out);
}

fw_live_answer fw_live_table(fw_live *live) {
    return fw_live_call(live, NULL, 0, NULL, table);
}
