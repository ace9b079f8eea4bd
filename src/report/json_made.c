/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_made.h"
#include <math.h>

static const char *word(fw_decision decision) {
    return fw_decision_text(decision);
}

static json_t *input(const fw_made_input *in, bool *failed) {
    json_t *o = json_object();
    fw_quantity q = in->q;
    fw_json_put(o, "name", fw_json_text(in->name), failed);
    fw_json_put(o, "unit", fw_json_text(q.unit), failed);
    const struct {
        const char *key;
        double value;
    } number[] = {{"nominal", in->nominal}, {"low", in->low}, {"high", in->high}};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        q.value = number[i].value;
        fw_json_put(o, number[i].key, fw_json_real(fw_quantity_in_unit(&q)), failed);
    }
    fw_json_put(o, "status", fw_json_text(fw_value_status_text(q.status)), failed);
    fw_json_put(o, "source", fw_json_text(q.source), failed);
    fw_json_put(o, "not_known", fw_json_text(in->unknown), failed);
    return o;
}

static json_t *corner(const fw_made_corner *c, int nhinge, bool *failed) {
    json_t *o = json_object();
    double most = 0.0;
    for (int k = 0; k < nhinge; k++)
        most = fmax(most, c->hinge[k].utilisation);
    fw_json_put(o, "at", fw_json_text(c->what), failed);
    fw_json_put(o, "verdict", fw_json_text(word(c->decision)), failed);
    fw_json_put(o, "utilisation", fw_json_real(most > 0.0 ? most : (double)NAN), failed);
    fw_json_put(o, "why", fw_json_text(c->why), failed);
    return o;
}

static json_t *held(const fw_variant_verdict *v, bool *failed) {
    const fw_made_verdict *m = v->made;
    if (m->held == FW_NONE) return json_null();
    json_t *o = json_object();
    fw_quantity q = v->input[m->held].q;
    fw_json_put(o, "name", fw_json_text(v->input[m->held].name), failed);
    q.value = m->held_low;
    fw_json_put(o, "low", fw_json_real(fw_quantity_in_unit(&q)), failed);
    q.value = m->held_high;
    fw_json_put(o, "high", fw_json_real(fw_quantity_in_unit(&q)), failed);
    return o;
}

json_t *fw_json_made(const fw_variant_verdict *v, bool *failed) {
    const fw_made_verdict *m = v->made;
    if (!m) return json_null();
    json_t *o = json_object(), *inputs = json_array(), *corners = json_array();
    for (int i = 0; i < v->ninput; i++)
        fw_json_push(inputs, input(&v->input[i], failed), failed);
    for (int i = 0; i < m->ncorner; i++)
        fw_json_push(corners, corner(&m->corner[i], v->nhinge, failed), failed);
    fw_json_put(o, "verdict", fw_json_text(word(m->decision)), failed);
    fw_json_put(o, "inputs", inputs, failed);
    fw_json_put(o, "corners", corners, failed);
    fw_json_put(o, "all_corners", json_boolean(m->all), failed);
    fw_json_put(o, "estimate_error", fw_json_real(m->error), failed);
    fw_json_put(o, "reason", fw_json_text(m->reason), failed);
    fw_json_put(o, "control", fw_json_text(m->control), failed);
    fw_json_put(o, "held", held(v, failed), failed);
    fw_json_put(o, "held_share", fw_json_real(m->held_share), failed);
    return o;
}

static json_t *contributions(const fw_variant_verdict *v, const fw_made_hinge *h, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < v->ninput; i++) {
        json_t *o = json_object();
        fw_json_put(o, "name", fw_json_text(v->input[i].name), failed);
        fw_json_put(o, "utilisation", fw_json_real(h->share[i]), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static const fw_hinge_verdict *tightest(const fw_variant_verdict *v, int joint, int *at) {
    for (int k = 0; v->made && k < v->nhinge; k++) {
        if (v->hinge[k].joint != joint) continue;
        const fw_hinge_verdict *h = &v->made->corner[v->made->hinge[k].corner].hinge[k];
        *at = k;
        return h->scene ? h : NULL;
    }
    return NULL;
}

json_t *fw_json_made_hinge(const fw_variant_verdict *variant, int nvariant, int joint,
                           bool *failed) {
    const fw_hinge_verdict *worst = NULL;
    const fw_variant_verdict *v = NULL;
    int k = 0;
    for (int i = 0; i < nvariant; i++) {
        int at = 0;
        const fw_hinge_verdict *h = tightest(&variant[i], joint, &at);
        if (h && (!worst || h->utilisation > worst->utilisation))
            worst = h, v = &variant[i], k = at;
    }
    if (!worst) return json_null();
    const fw_made_hinge *h = &v->made->hinge[k];
    json_t *o = json_object();
    fw_json_put(o, "utilisation", fw_json_real(worst->utilisation), failed);
    fw_json_put(o, "utilisation_band",
                fw_json_pair(worst->utilisation_low, worst->utilisation_high, failed), failed);
    fw_json_put(o, "verdict", fw_json_text(word(worst->decision)), failed);
    fw_json_put(o, "corner", fw_json_text(v->made->corner[h->corner].what), failed);
    fw_json_put(o, "flow", fw_json_text(worst->flow), failed);
    fw_json_put(o, "scene", fw_json_text(worst->scene), failed);
    fw_json_put(o, "peak_angle_rad", fw_json_real(worst->peak_angle_rad), failed);
    fw_json_put(o, "limit_angle_rad", fw_json_real(worst->limit_angle_rad), failed);
    fw_json_put(o, "most", fw_json_real(h->most), failed);
    fw_json_put(o, "nominal", fw_json_real(v->made->corner[0].hinge[k].utilisation), failed);
    fw_json_put(o, "sigma", fw_json_real(h->sigma), failed);
    fw_json_put(o, "contributions", contributions(v, h, failed), failed);
    return o;
}
