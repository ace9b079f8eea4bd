/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_rest.h"
#include "report/json.h"
#include "report/hinge_model.h"
#include "report/json_effects.h"
#include "report/json_made.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *word(fw_decision decision) {
    return decision == FW_ACCEPT ? "accept" : decision == FW_REJECT ? "reject" : "inconclusive";
}

/* which criterion governs, and what it rests on */
static void limit(json_t *o, const fw_hinge_verdict *h, bool *failed) {
    const fw_limit *l = h->limit;
    fw_json_put(o, "criterion", fw_json_text(l ? l->criterion : NULL), failed);
    fw_json_put(o, "limit_definition", fw_json_text(l ? l->definition : NULL), failed);
    fw_json_put(o, "limit_Pa", fw_json_real(h->limit_Pa), failed);
    fw_json_put(o, "limit_source", fw_json_text(l ? l->source : NULL), failed);
    fw_json_put(o, "limit_status", fw_json_text(l ? fw_value_status_text(l->status) : NULL),
                failed);
    fw_json_put(o, "failure_probability", fw_json_real(h->failure_probability), failed);
    fw_json_put(o, "fatigue_utilisation", fw_json_real(h->fatigue_utilisation), failed);
    fw_json_put(o, "damage", fw_json_real(h->damage), failed);
    fw_json_put(o, "cycles", fw_json_real(h->cycles), failed);
}

static json_t *hinge(const fw_hinge_verdict *h, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "id", fw_json_text(h->id), failed);
    fw_json_put(o, "peak_angle_rad", fw_json_real(h->peak_angle_rad), failed);
    fw_json_put(o, "angle_error_rad", fw_json_real(h->angle_error_rad), failed);
    fw_json_put(o, "limit_angle_rad", fw_json_real(h->limit_angle_rad), failed);
    fw_json_put(o, "peak_strain", fw_json_real(h->peak_strain), failed);
    fw_json_put(o, "strain_limit", fw_json_real(h->strain_limit), failed);
    fw_json_put(o, "utilisation", fw_json_real(h->utilisation), failed);
    fw_json_put(o, "force_share", fw_json_real(h->force_share), failed);
    fw_json_put(o, "scene", fw_json_text(h->scene), failed);
    fw_json_put(o, "t_s", fw_json_real(h->t_s), failed);
    fw_json_put(o, "flow", fw_json_text(h->flow), failed);
    fw_json_put(o, "utilisation_band",
                fw_json_pair(h->utilisation_low, h->utilisation_high, failed), failed);
    fw_json_put(o, "verdict", fw_json_text(word(h->decision)), failed);
    limit(o, h, failed);
    return o;
}

/* with what these flows make of them */
static json_t *hinges(const fw_hinge_verdict *item, int count, const fw_variant_verdict *variant,
                      int nvariant, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++) {
        json_t *o = hinge(&item[i], failed);
        fw_json_put(o, "as_fabricated",
                    fw_json_made_hinge(variant, nvariant, item[i].joint, failed), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *governing(const fw_hinge_verdict *item, int count, int index, bool *failed) {
    return index >= 0 && index < count ? hinge(&item[index], failed) : json_null();
}

/* ---- workspace: the required boxes; certified when all of them are ---- */

static json_t *box(const fw_workspace_box *b, const fw_variant_verdict *v, bool reachable,
                   bool *failed) {
    json_t *o = json_object();
    double volume =
        (b->x_max_m - b->x_min_m) * (b->y_max_m - b->y_min_m) * (b->phi_max_rad - b->phi_min_rad);
    fw_json_put(o, "flow", fw_json_text(v->variant ? v->variant->flow : NULL), failed);
    fw_json_put(o, "x_m", fw_json_pair(b->x_min_m, b->x_max_m, failed), failed);
    fw_json_put(o, "y_m", fw_json_pair(b->y_min_m, b->y_max_m, failed), failed);
    fw_json_put(o, "phi_rad", fw_json_pair(b->phi_min_rad, b->phi_max_rad, failed), failed);
    fw_json_put(o, "reachable", json_boolean(reachable), failed);
    fw_json_put(o, "certified", json_boolean(v->workspace.certified), failed);
    fw_json_put(o, "volume_m2_rad", fw_json_real(volume), failed);
    return o;
}

static json_t *workspace(const fw_report_input *in, bool *failed) {
    json_t *list = json_array();
    bool certified = true, any = false;
    double volume = (double)NAN;
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_variant_verdict *v = &in->verdict->variant[i];
        if (!v->workspace.required) continue;
        any = true;
        certified = certified && v->workspace.certified && v->workspace.reachable;
        volume = fmin(volume, v->workspace.volume_m2_rad); /* fmin ignores the first NaN */
        for (int k = 0; k < in->device->nworkspace; k++)
            if (v->workspace.asked && v->workspace.asked[k])
                fw_json_push(
                    list, box(&in->device->workspace[k], v, v->workspace.box_reachable[k], failed),
                    failed);
    }
    json_t *o = json_object();
    fw_json_put(o, "required", list, failed);
    fw_json_put(o, "certified", json_boolean(any && certified), failed);
    fw_json_put(o, "volume", fw_json_real(volume), failed); /* least of the boxes, m2 rad */
    return o;
}

/* ---- flows, effects, advice ---- */

static json_t *flow(const fw_report_flow *f, bool *failed) {
    const fw_variant_verdict *v = f->variant;
    const char *id = f->flow ? f->flow->id : v && v->variant ? v->variant->flow : NULL;
    json_t *o = json_object(), *reasons = json_array();
    fw_json_put(o, "id", fw_json_text(id), failed);
    bool known = f->flow && f->flow->manufacturable >= 0;
    fw_json_put(o, "manufacturable", known ? json_boolean(f->flow->manufacturable) : json_null(),
                failed);
    for (int i = 0; f->flow && i < f->flow->nreason; i++)
        fw_json_push(reasons, fw_json_text(f->flow->reason[i]), failed);
    fw_json_put(o, "reasons", reasons, failed);
    fw_json_put(o, "mask_error", fw_json_text(f->mask_error), failed);
    if (v) {
        fw_json_put(o, "verdict", fw_json_text(word(v->decision)), failed);
        fw_json_put(o, "governing", governing(v->hinge, v->nhinge, v->governing, failed), failed);
        fw_json_put(o, "hinges", hinges(v->hinge, v->nhinge, v, 1, failed), failed);
        fw_json_put(o, "drawn", fw_json_text(word(v->drawn)), failed);
        fw_json_put(o, "as_fabricated", fw_json_made(v, failed), failed);
    }
    return o;
}

static json_t *effects(const fw_report_input *in, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->motion && k < in->device->nscene; k++)
            if (v->motion[k])
                fw_json_effects(list, &v->motion[k]->ledger, in->device->scene[k].name,
                                v->variant ? v->variant->flow : NULL, failed);
    }
    return list;
}

/* of every scene with hinges, in every flow */
static json_t *hinge_models(const fw_report_input *in, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->motion && k < in->device->nscene; k++) {
            const fw_motion *x = v->motion[k];
            if (!x || !x->ledger.hinge.why) continue;
            json_t *o = fw_json_hinge_model(v->mechanism, &x->ledger.hinge, x->level, failed);
            fw_json_put(o, "model_error", fw_json_real(fw_motion_model_error(v->mechanism, x)),
                        failed);
            fw_json_put(o, "scene", fw_json_text(in->device->scene[k].name), failed);
            fw_json_put(o, "flow", fw_json_text(v->variant ? v->variant->flow : NULL), failed);
            fw_json_push(list, o, failed);
        }
    }
    return list;
}

/* of every scene with comb drives */
static json_t *pull_ins(const fw_report_input *in, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->pull_in && k < in->device->nscene; k++) {
            if (!v->pull_in[k]) continue;
            json_t *o = fw_json_pull_in(v->pull_in[k], failed);
            fw_json_put(o, "scene", fw_json_text(in->device->scene[k].name), failed);
            fw_json_put(o, "flow", fw_json_text(v->variant ? v->variant->flow : NULL), failed);
            fw_json_push(list, o, failed);
        }
    }
    return list;
}

static json_t *reasons(const fw_verdict *v, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < v->nvariant; i++)
        for (int k = 0; k < v->variant[i].nreason; k++) {
            const fw_reason *r = &v->variant[i].reason[k];
            char code[16];
            snprintf(code, sizeof code, "FW-D%03d", r->number);
            json_t *o = json_object();
            fw_json_put(o, "scene", fw_json_text(r->scene), failed);
            fw_json_put(o, "flow", fw_json_text(r->flow), failed);
            fw_json_put(o, "verdict", fw_json_text(word(r->decision)), failed);
            fw_json_put(o, "code", fw_json_text(code), failed);
            fw_json_put(o, "text", fw_json_text(r->text), failed);
            fw_json_push(list, o, failed);
        }
    return list;
}

static json_t *advice(const fw_verdict *v, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < v->nadvice; i++) {
        json_t *o = json_object();
        fw_json_put(o, "set", fw_json_text(v->advice[i].set_path), failed);
        fw_json_put(o, "value", fw_json_text(v->advice[i].value_text), failed);
        fw_json_put(o, "value_SI", fw_json_real(v->advice[i].value), failed);
        fw_json_put(o, "text", fw_json_text(v->advice[i].text), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *parameters(const fw_verdict *v, bool *failed) {
    static const char *const found[] = {"accepts", "none", "not looked at"};
    json_t *list = json_array();
    for (int i = 0; i < v->nparameter; i++) {
        const fw_parameter_advice *p = &v->parameter[i];
        json_t *o = json_object();
        fw_json_put(o, "set", fw_json_text(p->name), failed);
        fw_json_put(o, "found", fw_json_text(found[p->found]), failed);
        fw_json_put(o, "value", fw_json_text(p->value_text), failed);
        fw_json_put(o, "value_SI", fw_json_real(p->to), failed);
        fw_json_put(o, "now_SI", fw_json_real(p->from), failed);
        fw_json_put(o, "change", fw_json_real(p->change), failed);
        fw_json_put(o, "from_SI", fw_json_real(p->low), failed);
        fw_json_put(o, "to_SI", fw_json_real(p->high), failed);
        fw_json_put(o, "text", fw_json_text(p->text), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

fw_status fw_report_verdict_json(const fw_report_input *input, fw_text *out) {
    const fw_verdict *v = input->verdict;
    bool failed = false;
    json_t *root = json_object();
    fw_json_put(root, "schema", fw_json_text("flexwright.verdict/1"), &failed);
    fw_json_put(root, "device", fw_json_text(input->device->name), &failed);
    fw_json_put(root, "version", fw_json_text(input->version), &failed);
    fw_json_put(root, "verdict", fw_json_text(word(v->decision)), &failed);
    fw_json_put(root, "drawn", fw_json_text(word(v->drawn)), &failed);
    if (v->decision == FW_REJECT) fw_json_put(root, "banner", fw_json_text("REJECTED"), &failed);
    fw_json_put(root, "governing", governing(v->hinge, v->nhinge, v->governing, &failed), &failed);
    fw_json_put(root, "hinges", hinges(v->hinge, v->nhinge, v->variant, v->nvariant, &failed),
                &failed);
    fw_json_put(root, "failure_probability", fw_json_real(v->failure_probability), &failed);
    fw_json_put(root, "repetitions", fw_json_real(input->device->limits.cycles), &failed);
    fw_json_put(root, "workspace", workspace(input, &failed), &failed);
    json_t *flows = json_array();
    for (int i = 0; i < input->nflow; i++)
        fw_json_push(flows, flow(&input->flow[i], &failed), &failed);
    fw_json_put(root, "flows", flows, &failed);
    fw_json_put(root, "effects", effects(input, &failed), &failed);
    fw_json_put(root, "hinge_model", hinge_models(input, &failed), &failed);
    json_t *pull_in = pull_ins(input, &failed); /* only where there are drives */
    if (json_array_size(pull_in) > 0)
        fw_json_put(root, "pull_in", pull_in, &failed);
    else
        json_decref(pull_in);
    fw_json_put(root, "reasons", reasons(v, &failed), &failed);
    json_t *accuracy = json_object();
    fw_json_put(accuracy, "wanted", fw_json_real(v->accuracy_wanted), &failed);
    fw_json_put(accuracy, "estimated", fw_json_real(v->accuracy_estimated), &failed);
    fw_json_put(accuracy, "left_out", fw_json_real(v->accuracy_left_out), &failed);
    fw_json_put(root, "accuracy", accuracy, &failed);
    fw_json_put(root, "advice", advice(v, &failed), &failed);
    fw_json_put(root, "advice_verified", json_boolean(v->advice_verified), &failed);
    fw_json_put(root, "advice_note", fw_json_text(v->advice_note), &failed);
    fw_json_put(root, "advice_parameters", parameters(v, &failed), &failed);
    return fw_json_write(root, failed, out);
}
