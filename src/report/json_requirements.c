/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the device is for, beside its verdict: probes and requirements as JSON. */
#include "report/json_parts.h"
#include "report/report.h"

/* ---- JSON ---- */

static void value(fw_json *json, const fw_verdict_requirement *r) {
    fw_json_real(json, "value", r->value);
    fw_report_json_pair(json, "band", r->low, r->high);
    fw_json_real(json, "margin", r->margin);
    fw_json_real(json, "utilisation", r->utilisation);
    fw_json_real(json, "t_s", r->t_s);
    fw_json_text(json, "verdict", fw_verdict_decision_text(r->decision));
    fw_json_text(json, "why", r->why);
}

static void made(fw_json *json, const fw_verdict_variant_verdict *v, int k) {
    int corner = 0;
    const fw_verdict_requirement *r = fw_verdict_requirement_made(v, k, &corner);
    if (!r) {
        fw_json_null(json, "as_fabricated");
        return;
    }
    fw_json_object(json, "as_fabricated");
    value(json, r);
    fw_report_json_pair(json, "all_corners_band", r->all_low, r->all_high);
    fw_json_text(json, "corner", v->fabricated->corner[corner].what);
    fw_json_end(json);
}

void fw_report_json_requirement(fw_json *json, const fw_verdict_requirement *r) {
    fw_json_text(json, "probe", r->probe);
    fw_json_text(json, "kind", r->kind);
    fw_json_text(json, "measure", r->measure);
    fw_json_text(json, "unit", r->unit);
    fw_json_text(json, "scene", r->scene);
    fw_json_text(json, "flow", r->flow);
    fw_json_real(json, "min", r->min);
    fw_json_real(json, "max", r->max);
    value(json, r);
}

static void requirement(fw_json *json, const fw_verdict_variant_verdict *v, int k) {
    fw_json_object(json, NULL);
    fw_report_json_requirement(json, &v->requirement[k]);
    made(json, v, k);
    fw_json_end(json);
}

static bool probed(const fw_verdict_variant_verdict *v, int i) {
    return v->probed && v->motion && v->probed[i].known;
}

/* of every scene and flow; nothing where the device has no probe */
static void probes(fw_json *json, const fw_report_input *in) {
    const int n = in->device->nprobe;
    if (n == 0) return;
    fw_json_list(json, "probes");
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        for (int s = 0; s < in->device->nscene; s++)
            for (int k = 0; k < n; k++)
                if (probed(v, s * n + k))
                    fw_report_json_probe(json, &in->device->probe[k], in->device->scene[s].name,
                                         v->variant->flow, &v->probed[s * n + k]);
    }
    fw_json_end(json);
}

void fw_report_json_requirements(fw_json *json, const fw_report_input *in) {
    probes(json, in);
    fw_json_list(json, "requirements");
    for (int i = 0; i < in->verdict->nvariant; i++)
        for (int k = 0; k < in->verdict->variant[i].nrequirement; k++)
            requirement(json, &in->verdict->variant[i], k);
    fw_json_end(json);
}
