/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_common.h"
#include "report/workspace.h"
#include <stdio.h>

static json_t *interval(fw_interval a, bool *failed) {
    return fw_json_pair(a.lo, a.hi, failed);
}

static json_t *reals(const double *value, int count, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        fw_json_push(list, fw_json_real(value[i]), failed);
    return list;
}

static json_t *measure(const fw_measure *m, const char *key, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, key, interval(m->value, failed), failed);
    fw_json_put(o, "boxes", json_integer((json_int_t)m->boxes), failed);
    return o;
}

static json_t *by_hinge(const fw_mechanism *m, const double *value, bool *failed) {
    json_t *o = json_object();
    for (int i = 0; i < FW_SIX; i++)
        fw_json_put(o, m->pin[i].id, fw_json_real(value[i]), failed);
    return o;
}

static json_t *triangle(const fw_mechanism *m, const fw_triangle *t, bool *failed) {
    json_t *o = json_object(), *driven = json_array(), *passive = json_array();
    for (int i = 0; i < FW_SIX; i++) {
        bool held = i == t->hinge[0] || i == t->hinge[1] || i == t->hinge[2];
        fw_json_push(held ? passive : driven, fw_json_text(m->pin[i].id), failed);
    }
    fw_json_put(o, "driven", driven, failed);
    fw_json_put(o, "passive", passive, failed);
    fw_json_put(o, "regular", json_boolean(t->regular), failed);
    fw_json_put(o, "singular_inside", json_boolean(t->positive && t->negative), failed);
    fw_json_put(o, "twice_area_m2", interval(t->area2_m2, failed), failed);
    fw_json_put(o, "least_length_m", interval(t->length_m, failed), failed);
    fw_json_put(o, "at", reals(t->pose, 3, failed), failed);
    return o;
}

static json_t *regularity(const fw_mechanism *m, const fw_regularity *s, bool *failed) {
    json_t *o = json_object(), *serial = json_array(), *parallel = json_array();
    for (int side = 0; side < 2; side++) {
        json_t *leg = json_object();
        fw_json_put(leg, "elbow", fw_json_text(m->pin[side ? 4 : 1].id), failed);
        fw_json_put(leg, "sine", interval(s->sine[side], failed), failed);
        fw_json_put(leg, "regular", json_boolean(s->regular[side]), failed);
        fw_json_push(serial, leg, failed);
    }
    for (int i = 0; i < FW_TRIANGLES; i++)
        fw_json_push(parallel, triangle(m, &s->passive[i], failed), failed);
    fw_json_put(o, "serial", serial, failed);
    fw_json_put(o, "parallel", parallel, failed);
    return o;
}

static json_t *reachable(const fw_report_workspace_flow *f, bool *failed) {
    const fw_workspace_map *map = f->map;
    if (map->none) return json_null();
    static const char *const name[] = {"x_m", "y_m", "phi_rad"};
    json_t *o = json_object(), *extents = json_object(), *areas = json_array();
    fw_json_put(o, "certified", json_true(), failed);
    fw_json_put(o, "limit_rad", by_hinge(f->mechanism, map->limit_rad, failed), failed);
    fw_json_put(o, "volume", measure(&map->volume, "m2_rad", failed), failed);
    for (int c = 0; c < 3; c++) {
        json_t *ends = json_array();
        fw_json_push(ends, interval(map->survey.least[c], failed), failed);
        fw_json_push(ends, interval(map->survey.most[c], failed), failed);
        fw_json_put(extents, name[c], ends, failed);
    }
    fw_json_put(o, "extents", extents, failed);
    for (int i = 0; i < FW_SLICES; i++) {
        json_t *area = measure(&map->slice[i].area, "area_m2", failed);
        fw_json_put(area, "phi_rad", fw_json_real(map->slice[i].phi_rad), failed);
        fw_json_push(areas, area, failed);
    }
    fw_json_put(o, "areas", areas, failed);
    fw_json_put(o, "boundary_share", by_hinge(f->mechanism, map->survey.share, failed), failed);
    fw_json_put(o, "exponent", fw_json_real(map->survey.exponent), failed);
    fw_json_put(o, "singularities", regularity(f->mechanism, &map->survey.singular, failed),
                failed);
    return o;
}

static const char *within(const fw_workspace_proof *p, int hinge, double limit) {
    fw_interval a = p->angle_rad[hinge];
    if (!(limit > 0.0)) return NULL;
    if (a.hi <= limit && a.lo >= -limit) return "yes";
    bool beyond = p->most[hinge].angle_rad.lo > limit || p->least[hinge].angle_rad.hi < -limit;
    return beyond ? "no" : "undecided";
}

static json_t *hinge_range(const fw_report_workspace_flow *f, const fw_workspace_proof *p, int i,
                           bool *failed) {
    json_t *o = json_object();
    double limit = f->map->none ? (double)NAN : f->map->limit_rad[i];
    fw_json_put(o, "id", fw_json_text(f->mechanism->pin[i].id), failed);
    fw_json_put(o, "angle_rad", interval(p->angle_rad[i], failed), failed);
    fw_json_put(o, "limit_rad", fw_json_real(limit), failed);
    fw_json_put(o, "within", fw_json_text(within(p, i, limit)), failed);
    fw_json_put(o, "least_at", reals(p->least[i].pose, 3, failed), failed);
    fw_json_put(o, "most_at", reals(p->most[i].pose, 3, failed), failed);
    return o;
}

static json_t *required(const fw_device *d, const fw_report_workspace_flow *f, bool *failed) {
    json_t *list = json_array();
    for (int k = 0; k < d->nworkspace; k++) {
        if (!f->required->asked || !f->required->asked[k]) continue;
        const fw_workspace_box *b = &d->workspace[k];
        const fw_workspace_proof *p = &f->required->proof[k];
        json_t *o = json_object(), *hinges = json_array();
        fw_json_put(o, "x_m", fw_json_pair(b->x_min_m, b->x_max_m, failed), failed);
        fw_json_put(o, "y_m", fw_json_pair(b->y_min_m, b->y_max_m, failed), failed);
        fw_json_put(o, "phi_rad", fw_json_pair(b->phi_min_rad, b->phi_max_rad, failed), failed);
        fw_json_put(o, "reachable", json_boolean(f->required->box_reachable[k]), failed);
        fw_json_put(o, "certified", json_boolean(p->proved), failed);
        for (int i = 0; i < FW_SIX && p->proved; i++)
            fw_json_push(hinges, hinge_range(f, p, i, failed), failed);
        fw_json_put(o, "hinges", hinges, failed);
        fw_json_put(o, "singularities",
                    p->proved ? regularity(f->mechanism, &f->singular[k], failed) : json_null(),
                    failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

fw_status fw_report_workspace_json(const fw_report_workspace *in, fw_text *out) {
    bool failed = false;
    json_t *root = json_object(), *flows = json_array();
    fw_json_put(root, "schema", fw_json_text("flexwright.workspace/1"), &failed);
    fw_json_put(root, "device", fw_json_text(in->device->name), &failed);
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        json_t *o = json_object();
        fw_json_put(o, "flow", fw_json_text(f->flow), &failed);
        fw_json_put(o, "reachable", reachable(f, &failed), &failed);
        fw_json_put(o, "none", fw_json_text(f->map->none), &failed);
        fw_json_put(o, "required", required(in->device, f, &failed), &failed);
        fw_json_push(flows, o, &failed);
    }
    fw_json_put(root, "flows", flows, &failed);
    return fw_json_write(root, failed, out);
}

/* ---- the certificate: every number as its bits ---- */

static json_t *bits(double value) {
    char text[40];
    snprintf(text, sizeof text, "%a", value);
    for (char *c = text; *c; c++)
        if (*c == ',') *c = '.'; /* a locale's decimal comma */
    return json_string(text);
}

static json_t *bits_of(const double *value, int count, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        fw_json_push(list, bits(value[i]), failed);
    return list;
}

static json_t *point(fw_vec2 p, bool *failed) {
    return bits_of((double[]){p.x, p.y}, 2, failed);
}

static json_t *extreme(const fw_workspace_extreme *e, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "pose", bits_of(e->pose, 3, failed), failed);
    fw_json_put(o, "angle_rad", bits_of((double[]){e->angle_rad.lo, e->angle_rad.hi}, 2, failed),
                failed);
    return o;
}

static json_t *leg(const fw_leg *l, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "base_m", point(l->base, failed), failed);
    fw_json_put(o, "first_m", point(l->a, failed), failed);
    fw_json_put(o, "second_m", point(l->b, failed), failed);
    fw_json_put(o, "platform_m", point(l->to, failed), failed);
    return o;
}

static json_t *certificate(const fw_report_workspace_flow *f, const fw_loop *loop,
                           const fw_workspace_proof *p, bool *failed) {
    json_t *o = json_object(), *mechanism = json_object(), *box = json_array(),
           *hinges = json_array();
    fw_json_put(o, "flow", fw_json_text(f->flow), failed);
    fw_json_put(mechanism, "left", leg(&loop->leg[0], failed), failed);
    fw_json_put(mechanism, "right", leg(&loop->leg[1], failed), failed);
    fw_json_put(mechanism, "centre_m", point(loop->centre, failed), failed);
    fw_json_put(mechanism, "start_rad", bits_of(loop->start_rad, FW_SIX, failed), failed);
    fw_json_put(o, "mechanism", mechanism, failed);
    for (int i = 0; i < 3; i++)
        fw_json_push(box, bits_of((double[]){p->low[i], p->high[i]}, 2, failed), failed);
    fw_json_put(o, "box", box, failed);
    for (int i = 0; i < FW_SIX; i++) {
        json_t *h = json_object();
        double ends[2] = {p->angle_rad[i].lo, p->angle_rad[i].hi};
        fw_json_put(h, "id", fw_json_text(f->mechanism->pin[i].id), failed);
        fw_json_put(h, "angle_rad", bits_of(ends, 2, failed), failed);
        fw_json_put(h, "least", extreme(&p->least[i], failed), failed);
        fw_json_put(h, "most", extreme(&p->most[i], failed), failed);
        fw_json_push(hinges, h, failed);
    }
    fw_json_put(o, "hinges", hinges, failed);
    fw_json_put(o, "tree", fw_json_text(p->tree), failed);
    return o;
}

fw_status fw_report_certificate_json(const fw_report_workspace *in, fw_text *out) {
    bool failed = false;
    json_t *root = json_object(), *list = json_array();
    fw_json_put(root, "schema", fw_json_text("flexwright.workspace-certificate/1"), &failed);
    fw_json_put(root, "device", fw_json_text(in->device->name), &failed);
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        fw_loop loop;
        if (!fw_loop_set_up(f->mechanism, &loop)) continue;
        for (int k = 0; k < in->device->nworkspace; k++)
            if (f->required->asked && f->required->asked[k] && f->required->proof[k].proved)
                fw_json_push(list, certificate(f, &loop, &f->required->proof[k], &failed), &failed);
    }
    fw_json_put(root, "boxes", list, &failed);
    return fw_json_write(root, failed, out);
}
