/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/json.h"
#include "plan/stages.h"

static void file(fw_json *json, const char *name, size_t bytes, const char *sha256) {
    fw_json_object(json, NULL);
    fw_json_text(json, "name", name);
    fw_json_whole(json, "bytes", (long long)bytes);
    fw_json_text(json, "sha256", sha256);
    fw_json_end(json);
}

static const char *effects_text(const fw_effect_choice *e) {
    static const char *const mode[] = {"auto", "all", "none", "list"};
    return e->mode == FW_EFFECTS_LIST && e->list ? e->list : mode[e->mode];
}

static void schedule(fw_json *json, const fw_schedule_options *c) {
    fw_json_object(json, "schedule");
    fw_json_whole(json, "wafers", c->wafers ? c->wafers : 1);
    fw_json_whole(json, "operators", c->operators ? c->operators : 1);
    fw_json_text(json, "day", c->day ? c->day : FW_WORKING_DAY);
    fw_json_text(json, "planning_times", c->planned);
    fw_json_end(json);
}

static void options(fw_json *json, const fw_plan_options *o) {
    const fw_dynamics_motion_options *motion = &o->verdict.motion;
    fw_json_object(json, "options");
    fw_json_real(json, "mask_tolerance_nm",
                 o->mask_tolerance_m > 0 ? o->mask_tolerance_m * 1e9 : 5.0);
    fw_json_text(json, "mask_formats", o->mask_formats);
    fw_json_whole(json, "mask_vertices", o->mask_vertices ? o->mask_vertices : 4094);
    fw_json_real(json, "accuracy", motion->accuracy);
    fw_json_text(json, "effects", effects_text(&motion->effects));
    fw_json_text(json, "hinge_model", fw_effects_hinge_model_text(motion->effects.hinge));
    fw_json_text(json, "flow", o->flow);
    fw_json_truth(json, "force", o->force);
    fw_json_text(json, "method", motion->method);
    fw_json_text(json, "integrator", motion->integrator);
    fw_json_text(json, "stabilise", motion->stabilise);
    fw_json_list(json, "set");
    for (int i = 0; i < o->nset; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "path", o->set[i].path);
        fw_json_text(json, "value", o->set[i].value);
        fw_json_end(json);
    }
    fw_json_end(json);
    schedule(json, &o->schedule);
    fw_json_text(json, "mask_flatten",
                 o->mask_flatten && *o->mask_flatten ? o->mask_flatten : "inside");
    fw_json_end(json);
}

/* hash of every input and output, the options, the version; no clock, no machine */
fw_status fw_plan_manifest(const fw_plan *plan, const fw_output_file *output, size_t count,
                           fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED_2);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.manifest/1");
    fw_json_text(&json, "program", "flexwright");
    fw_json_text(&json, "version", FW_VERSION);
    fw_json_text(&json, "device", plan->device->name);
    options(&json, &plan->options);
    fw_json_list(&json, "inputs");
    for (int i = 0; i < plan->ninput; i++)
        file(&json, plan->input[i].name, plan->input[i].size, plan->input[i].sha256);
    fw_json_end(&json);
    fw_json_list(&json, "outputs");
    for (size_t i = 0; i < count; i++)
        file(&json, output[i].name, output[i].size, output[i].sha256);
    fw_json_end(&json);
    if (plan->verdict.decision == FW_REJECT) fw_json_text(&json, "banner", "REJECTED");
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}
