/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/stages.h"
#include <jansson.h>
#include <stdlib.h>

static json_t *file_list(const fw_plan *plan) {
    json_t *list = json_array();
    for (int i = 0; i < plan->ninput; i++)
        json_array_append_new(list, json_pack("{s:s, s:I, s:s}", "name", plan->input[i].name,
                                              "bytes", (json_int_t)plan->input[i].size, "sha256",
                                              plan->input[i].sha256));
    return list;
}

static json_t *output_list(const fw_output_file *file, size_t count) {
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(list, json_pack("{s:s, s:I, s:s}", "name", file[i].name, "bytes",
                                              (json_int_t)file[i].size, "sha256", file[i].sha256));
    return list;
}

static json_t *option_list(const fw_plan *plan) {
    static const char *const effects[] = {"auto", "all", "none", "list"};
    const fw_plan_options *o = &plan->options;
    json_t *set = json_array();
    for (int i = 0; i < o->nset; i++)
        json_array_append_new(
            set, json_pack("{s:s, s:s}", "path", o->set[i].path, "value", o->set[i].value));
    const fw_effect_choice *e = &o->verdict.motion.effects;
    double tolerance_nm = o->mask_tolerance_m > 0 ? o->mask_tolerance_m * 1e9 : 5.0;
    const fw_schedule_options *c = &o->schedule;
    json_t *schedule = json_pack("{s:i, s:i, s:s, s:s?}", "wafers", c->wafers ? c->wafers : 1,
                                 "operators", c->operators ? c->operators : 1, "day",
                                 c->day ? c->day : FW_WORKING_DAY, "planning_times", c->planned);
    return json_pack(
        "{s:f, s:s?, s:i, s:f, s:s, s:s, s:s?, s:b, s:s?, s:s?, s:s?, s:o, s:o, s:s}",
        "mask_tolerance_nm", tolerance_nm, "mask_formats", o->mask_formats, "mask_vertices",
        o->mask_vertices ? o->mask_vertices : 4094, "accuracy", o->verdict.motion.accuracy,
        "effects", e->mode == FW_EFFECTS_LIST && e->list ? e->list : effects[e->mode],
        "hinge_model", fw_hinge_model_text(e->hinge), "flow", o->flow, "force", (int)o->force,
        "method", o->verdict.motion.method, "integrator", o->verdict.motion.integrator, "stabilise",
        o->verdict.motion.stabilise, "set", set, "schedule", schedule, "mask_flatten",
        o->mask_flatten && *o->mask_flatten ? o->mask_flatten : "inside");
}

/* hash of every input and output, the options, the version; no clock, no machine */
fw_status fw_plan_manifest(const fw_plan *plan, const fw_output_file *file, size_t count,
                           fw_text *out) {
    json_t *json = json_pack("{s:s, s:s, s:s, s:s, s:o, s:o, s:o}", "schema",
                             "flexwright.manifest/1", "program", "flexwright", "version",
                             FW_VERSION, "device", plan->device->name, "options", option_list(plan),
                             "inputs", file_list(plan), "outputs", output_list(file, count));
    if (plan->verdict.decision == FW_REJECT)
        json_object_set_new(json, "banner", json_string("REJECTED"));
    char *text = json ? json_dumps(json, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(json);
    FW_NEED(text);
    fw_text_add(out, text);
    fw_text_add(out, "\n");
    free(text);
    return fw_text_end(out);
}
