/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a form is generated from: everything comes from the tables that check the description, make
   --help and the reference pages. */
#include "dynamics/dynamics.h"
#include "plan/live_request.h"
#include "plan/stages.h"
#include "report/preview.h"
#include <math.h>

static void names(fw_text *out, const char *key, fw_method_row (*at)(size_t)) {
    fw_text_printf(out, ",\n\"%s\":[", key);
    for (size_t i = 0; at(i).name; i++) {
        fw_text_add(out, i ? ",\n{\"name\":" : "\n{\"name\":");
        fw_text_json(out, at(i).name);
        fw_text_add(out, ",\"sentence\":");
        fw_report_preview_string(out, at(i).summary);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void effects(fw_text *out) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    fw_text_add(out, ",\n\"effects\":[");
    for (size_t i = 0; i < count; i++) {
        fw_text_add(out, i ? ",\n{\"name\":" : "\n{\"name\":");
        fw_text_json(out, row[i]->id);
        fw_text_add(out, ",\"sentence\":");
        fw_report_preview_string(out, row[i]->summary);
        fw_text_add(out, ",\"cost\":");
        fw_report_preview_number(out, row[i]->cost, 6);
        fw_text_printf(out, ",\"kept\":%s}", row[i]->kept ? "true" : "false");
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
    fw_text_add(out, ",\n\"mask_formats\":[");
    for (size_t i = 0; (f = fw_mask_format_at(i)) != NULL; i++) {
        fw_text_add(out, i ? ",\n{\"name\":" : "\n{\"name\":");
        fw_text_json(out, f->name);
        fw_text_add(out, ",\"ending\":");
        fw_text_json(out, f->ending);
        fw_text_printf(out, ",\"always\":%s,\"usual\":%s}", f->always ? "true" : "false",
                       f->usual ? "true" : "false");
    }
    fw_text_add(out, "]");
}

static void units(fw_text *out) {
    size_t count;
    const char *const *name = fw_unit_names(&count);
    fw_text_add(out, ",\n\"units\":[");
    for (size_t i = 0; i < count; i++) {
        fw_text_add(out, i ? "," : "");
        fw_text_json(out, name[i]);
    }
    fw_text_add(out, "]");
}

static void limit(fw_text *out, const char *name, double least, double most, double usual) {
    fw_text_printf(out, "\"%s\":{\"minimum\":", name);
    fw_report_preview_number(out, least, 6);
    fw_text_add(out, ",\"maximum\":");
    fw_report_preview_number(out, most, 6);
    fw_text_add(out, ",\"default\":");
    fw_report_preview_number(out, usual, 6);
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
    fw_text_add(out, ",\n\"limits\":{");
    limit(out, "accuracy", FW_ACCURACY_LEAST, FW_ACCURACY_MOST, usual.accuracy);
    fw_text_add(out, ",");
    limit(out, "rtol", FW_RTOL_LEAST, FW_RTOL_MOST, (double)NAN);
    fw_text_add(out, ",");
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
