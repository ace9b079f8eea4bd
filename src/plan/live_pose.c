/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses for dragging. The mechanism that was posed last stays until another text comes: laying it
   out takes longer than all the rest. */
#include "base/json.h"
#include "assembly/assembly.h"
#include "base/text.h"
#include "plan/design.h"
#include "plan/live_request.h"
#include "plan/stages.h"
#include "report/preview.h"
#include <math.h>
#include <string.h>

typedef struct fw_plan_live_posed {
    fw_design *design; /* its arena holds this struct and the mechanisms */
    char key[65];      /* of text, sets and options */
    fw_status status;  /* of reading and building: FW_OK, or the description is no good */
    const fw_mechanism **mechanism; /* (nflow) closed */
} fw_plan_live_posed;

void fw_plan_live_posed_free(fw_plan_live_posed *posed) {
    if (posed) fw_design_free(posed->design);
}

/* ---- the mechanisms of a text ---- */

static fw_status build(fw_design *d, void *argument) {
    fw_plan_live_posed *posed = argument;
    fw_plan *plan = fw_plan_design_plan(d);
    const fw_mechanism *first;
    size_t n = (size_t)plan->nflow;
    FW_NEED(posed->mechanism = fw_arena_alloc(plan->arena, n, sizeof *posed->mechanism));
    FW_TRY(fw_plan_mechanism(plan, NULL, &first)); /* with its drawing */
    for (size_t i = 0; i < n; i++) {
        fw_diags again = fw_diags_new(plan->arena);
        fw_diags *diags = i == 0 ? &plan->diags : &again;
        const fw_mechanism *m;
        FW_TRY(fw_mechanism_build(plan->arena, plan->device, plan->layout, &plan->flow[i].variant,
                                  &again, &m));
        FW_TRY(fw_assembly_assembled(plan->arena, m, diags, &posed->mechanism[i], NULL));
    }
    return FW_OK;
}

/* a value as it was read; the same values give the same text */
static void copied(fw_json *json, const char *key, const json_t *value) {
    const char *name;
    const json_t *item;
    size_t i;
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        fw_json_object(json, key);
        json_object_foreach((json_t *)value, name, item) copied(json, name, item);
        fw_json_end(json);
        break;
    case JSON_ARRAY:
        fw_json_list(json, key);
        json_array_foreach(value, i, item) copied(json, NULL, item);
        fw_json_end(json);
        break;
    case JSON_STRING:
        fw_json_text(json, key, json_string_value(value));
        break;
    case JSON_INTEGER:
        fw_json_whole(json, key, json_integer_value(value));
        break;
    case JSON_REAL:
        fw_json_real(json, key, json_real_value(value));
        break;
    case JSON_TRUE:
    case JSON_FALSE:
        fw_json_truth(json, key, json_is_true(value));
        break;
    case JSON_NULL:
        fw_json_null(json, key);
        break;
    }
}

static fw_status key_of(fw_plan_live_request *r, char key[65]) {
    fw_text all = fw_text_new(r->arena);
    fw_text_bytes(&all, r->text, r->length);
    fw_text_add(&all, "\n");
    fw_json json = fw_json_new(&all, FW_JSON_COMPACT);
    fw_json_list(&json, NULL);
    if (r->set) copied(&json, NULL, r->set);
    fw_json_null(&json, NULL);
    if (r->options) copied(&json, NULL, r->options);
    fw_json_end(&json);
    fw_status status = fw_json_finish(&json, "");
    if (status == FW_INTERNAL) return fw_plan_live_wrong(r, "nested too deeply:", "set or options");
    FW_TRY(status);
    fw_sha256(all.data, all.length, key);
    return FW_OK;
}

/* live->posed holds the mechanisms of this request */
static fw_status prepare(fw_plan_live *live, fw_plan_live_request *r) {
    char key[65];
    FW_TRY(key_of(r, key));
    if (live->posed && strcmp(live->posed->key, key) == 0) return FW_OK;
    fw_plan_live_posed_free(live->posed);
    live->posed = NULL;
    fw_design *design;
    FW_TRY(fw_plan_live_design(live, r, &design));
    fw_plan_live_posed *posed =
        fw_arena_one(fw_plan_design_plan(design)->arena, fw_plan_live_posed);
    if (!posed) {
        fw_design_free(design);
        return FW_NOMEM;
    }
    posed->design = design;
    live->posed = posed;
    int status = fw_design_read_memory(posed->design, "device.xml", r->text, r->length);
    if (status == FW_STATUS_OK) status = fw_plan_design_run(posed->design, build, posed);
    if (status == FW_STATUS_USAGE)
        return fw_plan_live_wrong(r, design->wrong_option ? design->wrong_option : "wrong usage",
                                  NULL);
    if (status == FW_STATUS_NOMEM || status == FW_STATUS_CANCELLED) return (fw_status)status;
    posed->status = (fw_status)status;
    memcpy(posed->key, key, sizeof key); /* only now is it whole */
    return FW_OK;
}

/* ---- the request ---- */

static fw_status asked_of(fw_plan_live_request *r, double asked[3]) {
    static const char *const name[] = {"x_m", "y_m", "phi_rad"};
    const json_t *platform = json_object_get(r->root, "platform");
    if (!json_is_object(platform))
        return fw_plan_live_wrong(r, "an object is needed for", "platform");
    for (int k = 0; k < 3; k++) {
        asked[k] = k < 2 ? 0.0 : (double)NAN; /* any angle */
        FW_TRY(fw_plan_live_real(r, platform, name[k], &asked[k]));
        if (fabs(asked[k]) > 1e6)
            return fw_plan_live_wrong(r, "a pose may be at most 1e6 m or rad away:", name[k]);
    }
    return FW_OK;
}

/* the poses to start from, as the last answer gave them; NULL: none */
static fw_status start_of(fw_plan_live_request *r, const fw_mechanism *m, const double **from) {
    const json_t *list = json_object_get(r->root, "q");
    *from = NULL;
    if (!list || json_is_null(list)) return FW_OK;
    size_t n = 3 * (size_t)m->nbody;
    if (!json_is_array(list) || json_array_size(list) != n) return FW_OK; /* of another mechanism */
    double *q = fw_arena_array(r->arena, double, n);
    FW_NEED(q);
    for (size_t i = 0; i < n; i++) {
        const json_t *v = json_array_get(list, i);
        if (!json_is_number(v)) return fw_plan_live_wrong(r, "numbers are needed in", "q");
        q[i] = json_number_value(v);
        if (!(fabs(q[i]) <= 1e6)) return FW_OK;
    }
    *from = q;
    return FW_OK;
}

static fw_status body_of(fw_plan_live_request *r, const fw_mechanism *m, int *body) {
    const char *name = NULL;
    FW_TRY(fw_plan_live_string(r, r->root, "body", &name));
    *body = fw_plan_pose_body(m);
    if (!name && *body == FW_NONE)
        return fw_plan_live_wrong(r, "the device has no body to move", NULL);
    for (int b = 0; name && b < m->nbody; b++)
        if (strcmp(m->body[b].id, name) == 0) {
            *body = b;
            return FW_OK;
        }
    return name ? fw_plan_live_wrong(r, "the device has no body", name) : FW_OK;
}

/* the flow whose mechanism is moved: the one that is named, else the first */
static fw_status flow_of(fw_plan_live_request *r, const fw_plan *plan, int *flow) {
    const char *name = NULL;
    FW_TRY(fw_plan_live_string(r, r->root, "flow", &name));
    *flow = 0;
    for (int i = 0; name && i < plan->nflow; i++)
        if (plan->flow[i].variant.flow && strcmp(plan->flow[i].variant.flow, name) == 0) {
            *flow = i;
            return FW_OK;
        }
    return name ? fw_plan_live_wrong(r, "the device has no flow", name) : FW_OK;
}

/* ---- the answer ---- */

static void triple(fw_json *out, const char *key, const double at[3]) {
    static const char *const name[] = {"x_m", "y_m", "phi_rad"};
    fw_json_line(out, 0);
    fw_json_object(out, key);
    for (int k = 0; k < 3; k++)
        fw_json_number(out, name[k], at[k], 12);
    fw_json_end(out);
}

static void numbers(fw_json *out, const char *key, const double *value, int n) {
    fw_json_line(out, 0);
    fw_json_list(out, key);
    for (int k = 0; k < n; k++)
        fw_json_number(out, NULL, value[k], 15);
    fw_json_end(out);
}

static double limit_of(const fw_mechanism *m, int pin) {
    int h = m->pin[pin].hinge;
    double limit = h == FW_NONE ? (double)NAN : m->hinge[h].closed_form.limit_angle_rad;
    return limit > 0.0 ? limit : (double)NAN;
}

/* every hinge against its limit in this flow, and which is nearest to it */
static void flow_json(fw_json *out, const fw_mechanism *m, const double *angle) {
    int governing = FW_NONE;
    double most = -1.0;
    fw_json_object(out, NULL);
    fw_json_text(out, "name", m->variant->flow);
    fw_json_list(out, "hinges");
    for (int i = 0; i < m->npin; i++) {
        double limit = limit_of(m, i), used = fabs(angle[i]) / limit;
        if (isnan(limit)) continue;
        if (used > most) most = used, governing = i;
        fw_json_object(out, NULL);
        fw_json_text(out, "id", m->pin[i].id);
        fw_json_whole(out, "pin", i);
        fw_json_number(out, "angle_rad", angle[i], 12);
        fw_json_number(out, "limit_rad", limit, 9);
        fw_json_number(out, "utilisation", used, 9);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_text(out, "governing", governing == FW_NONE ? NULL : m->pin[governing].id);
    fw_json_number(out, "utilisation", governing == FW_NONE ? (double)NAN : most, 9);
    if (governing == FW_NONE)
        fw_json_null(out, "within_limits");
    else
        fw_json_truth(out, "within_limits", most <= 1.0);
    fw_json_end(out);
}

static void answer(fw_json *out, const fw_plan_live_posed *posed, int flow, int body,
                   const double asked[3], const fw_plan_posed *p) {
    const fw_plan *plan = fw_plan_design_plan(posed->design);
    const fw_mechanism *m = posed->mechanism[flow];
    fw_json_line(out, 0);
    fw_json_text(out, "body", m->body[body].id);
    fw_json_text(out, "how", p->closed_form ? "closed form" : "assembly");
    fw_json_truth(out, "reachable", p->reachable);
    fw_json_text(out, "reason", p->reason);
    triple(out, "asked", asked);
    triple(out, "at", p->at);
    fw_json_line(out, 0);
    fw_json_number(out, "share", p->share, 12);
    numbers(out, "q", p->q, 3 * m->nbody);
    numbers(out, "angle_rad", p->angle_rad, m->npin);
    fw_json_line(out, 0);
    fw_json_text(out, "flow", m->variant->flow);
    fw_json_list(out, "flows");
    for (int i = 0; i < plan->nflow; i++) {
        fw_json_line(out, 0);
        flow_json(out, posed->mechanism[i], p->angle_rad);
    }
    fw_json_end(out);
}

static fw_status pose(fw_plan_live *live, fw_plan_live_request *r, fw_text *text) {
    double asked[3];
    FW_TRY(asked_of(r, asked));
    FW_TRY(prepare(live, r));
    fw_plan_live_posed *posed = live->posed;
    const fw_plan *plan = fw_plan_design_plan(posed->design);
    fw_plan_posed p = {.reachable = false};
    const double *from = NULL;
    int flow = 0, body = FW_NONE;
    fw_status status = posed->status;
    if (status == FW_OK) {
        FW_TRY(flow_of(r, plan, &flow));
        FW_TRY(body_of(r, posed->mechanism[flow], &body));
        FW_TRY(start_of(r, posed->mechanism[flow], &from));
        status = fw_plan_pose_solve(r->arena, posed->mechanism[flow], body, asked, from, &p);
        if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    }
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    fw_json_text(out, "schema", "flexwright.pose/1");
    fw_json_text(out, "status",
                 status == FW_OK          ? "ok"
                 : posed->status == FW_OK ? "failed"
                                          : "invalid");
    fw_json_line(out, 0);
    fw_report_preview_diagnostics(&plan->diags, "device.xml", out);
    if (status == FW_OK) answer(out, posed, flow, body, asked, &p);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}

fw_plan_live_answer fw_plan_live_pose(fw_plan_live *live, const char *request, size_t n) {
    static const char *const keys[] = {"text", "set",      "options", "flow",
                                       "body", "platform", "q",       NULL};
    return fw_plan_live_call(live, request, n, keys, pose);
}
