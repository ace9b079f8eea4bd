/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json.h"
#include "report/hinge_model.h"
#include "report/json_effects.h"
#include "report/json_rest.h"
#include "report/rest.h"

static json_t *hinges(const fw_mechanism *m, const double *angle, const double *force,
                      bool *failed) {
    json_t *list = json_array();
    for (int k = 0; k < m->npin; k++) {
        json_t *o = json_object();
        fw_json_put(o, "hinge", fw_json_text(m->pin[k].id), failed);
        fw_json_put(o, "angle_rad", fw_json_real(angle[k]), failed);
        fw_json_put(o, "force_N", fw_json_pair(force[2 * k], force[2 * k + 1], failed), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *ties(const fw_mechanism *m, const double *force, bool *failed) {
    static const char *const kind[] = {
        [FW_TIE_PRISMATIC] = "prismatic", [FW_TIE_DISTANCE] = "distance", [FW_TIE_WELD] = "weld"};
    json_t *list = json_array();
    for (int k = 0; k < m->ntie; k++) {
        json_t *o = json_object();
        fw_json_put(o, "joint", fw_json_text(m->tie[k].id), failed);
        fw_json_put(o, "kind", fw_json_text(kind[m->tie[k].kind]), failed);
        fw_json_put(o, "force_N", fw_json_pair(force[3 * k], force[3 * k + 1], failed), failed);
        fw_json_put(o, "torque_Nm", fw_json_real(force[3 * k + 2]), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *drivers(const fw_mechanism *m, const double *force, bool *failed) {
    json_t *list = json_array();
    for (int k = 0; k < m->ndriver; k++) {
        bool turns = m->driver[k].joint != FW_NONE;
        json_t *o = json_object();
        fw_json_put(o, "driver", fw_json_text(m->driver[k].id), failed);
        fw_json_put(o, turns ? "torque_Nm" : "force_N", fw_json_real(force[k]), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *actives(const fw_statics *s, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < s->nactive; i++) {
        const fw_active *a = &s->active[i];
        json_t *o = json_object();
        fw_json_put(o, "id", fw_json_text(a->id), failed);
        const char *kind = a->effect ? a->effect : a->side == 0 ? "cable" : "stop";
        fw_json_put(o, "kind", fw_json_text(kind), failed);
        fw_json_put(o, "side", fw_json_real(a->side), failed);
        fw_json_put(o, "on", json_boolean(a->on), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

/* limit points, bifurcations, switches and the end, with their poses */
static json_t *events(const fw_mechanism *m, const fw_statics *s, bool *failed) {
    const fw_path *p = s->path;
    json_t *list = json_array();
    for (int i = 0; i < p->count; i++) {
        size_t at = (size_t)i;
        if (p->mark[i] == FW_PATH_POINT) continue;
        json_t *o = json_object();
        fw_json_put(o, "kind", fw_json_text(fw_report_path_mark(p->mark[i])), failed);
        fw_json_put(o, "point", json_integer(i), failed);
        fw_json_put(o, "load_factor", fw_json_real(p->factor[i]), failed);
        fw_json_put(o, "element",
                    fw_json_text(p->which[i] == FW_NONE ? NULL : s->active[p->which[i]].id),
                    failed);
        fw_json_put(o, "snaps_by_m", fw_json_real(p->snap_m[i]), failed);
        fw_json_put(o, "snaps_by_rad", fw_json_real(p->snap_rad[i]), failed);
        fw_json_put(o, "q", fw_json_by_body(m, p->q + at * 3 * (size_t)p->nbody, failed), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *path(const fw_mechanism *m, const fw_statics *s, bool *failed) {
    const fw_path *p = s->path;
    if (!p) return json_null();
    json_t *o = json_object(), *factor = json_array(), *lowest = json_array(), *sign = json_array();
    for (int i = 0; i < p->count; i++) {
        fw_json_push(factor, fw_json_real(p->factor[i]), failed);
        fw_json_push(lowest, fw_json_real(p->lowest_per_s2[i]), failed);
        fw_json_push(sign, json_integer(p->negative[i]), failed);
    }
    fw_json_put(o, "complete", json_boolean(p->complete), failed);
    fw_json_put(o, "events", events(m, s, failed), failed);
    fw_json_put(o, "load_factor", factor, failed);
    fw_json_put(o, "lowest_per_s2", lowest, failed);
    fw_json_put(o, "negative", sign, failed);
    return o;
}

json_t *fw_json_pull_in(const fw_pull_in *p, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "comb", fw_json_text(p->comb), failed);
    fw_json_put(o, "voltage_V", fw_json_real(p->voltage_V), failed);
    fw_json_put(o, "kind", fw_json_text(fw_pull_in_kind_text(p->kind)), failed);
    fw_json_put(o, "margin", fw_json_real(p->margin), failed);
    fw_json_put(o, "bifurcation", json_boolean(p->bifurcation), failed);
    fw_json_put(o, "scene_voltage_V", fw_json_real(p->largest_V), failed);
    fw_json_put(o, "along_m", fw_json_real(p->where[0]), failed);
    fw_json_put(o, "across_m", fw_json_real(p->where[1]), failed);
    fw_json_put(o, "tilt_rad", fw_json_real(p->where[2]), failed);
    fw_json_put(o, "body", fw_json_text(p->body), failed);
    fw_json_put(o, "fringe", fw_json_real(p->fringe), failed);
    fw_json_put(o, "why", fw_json_text(p->why), failed);
    return o;
}

/* none without comb drives, else the one that loses the equilibrium first */
static json_t *pull_ins(const fw_pull_in *p, bool *failed) {
    json_t *list = json_array();
    if (p) fw_json_push(list, fw_json_pull_in(p, failed), failed);
    return list;
}

fw_status fw_report_statics_json(const fw_mechanism *mechanism, const fw_scene *scene,
                                 const fw_statics *s, fw_text *out) {
    bool failed = false;
    json_t *root = json_object(), *values = json_array(), *effects = json_array();
    fw_json_put(root, "schema", fw_json_text("flexwright.statics/1"), &failed);
    fw_json_put(root, "scene", fw_json_text(scene->name), &failed);
    fw_json_put(root, "stable", json_boolean(s->negative == 0 && s->neutral == 0), &failed);
    fw_json_put(root, "negative", json_integer(s->negative), &failed);
    fw_json_put(root, "neutral", json_integer(s->neutral), &failed);
    fw_json_put(root, "loose", fw_json_text(s->loose), &failed);
    fw_json_put(root, "degrees_of_freedom", json_integer(s->dof), &failed);
    fw_json_put(root, "residual", fw_json_real(s->residual), &failed);
    fw_json_put(root, "iterations", json_integer(s->iterations), &failed);
    fw_json_put(root, "constraints", fw_json_rank(&s->rank, &failed), &failed);
    fw_json_put(root, "q", fw_json_by_body(mechanism, s->q, &failed), &failed);
    fw_json_put(root, "hinges", hinges(mechanism, s->angle_rad, s->reaction_N, &failed), &failed);
    fw_json_put(root, "ties", ties(mechanism, s->tie_N, &failed), &failed);
    fw_json_put(root, "drivers", drivers(mechanism, s->driver_N, &failed), &failed);
    fw_json_put(root, "active", actives(s, &failed), &failed);
    for (int i = 0; i < s->dof; i++)
        fw_json_push(values, fw_json_real(s->eigenvalue_per_s2[i]), &failed);
    fw_json_put(root, "eigenvalues_per_s2", values, &failed);
    fw_json_put(root, "pull_in", pull_ins(s->pull_in, &failed), &failed);
    fw_json_put(root, "path", path(mechanism, s, &failed), &failed);
    fw_json_put(root, "hinge_model",
                fw_json_hinge_model(mechanism, &s->ledger.hinge, s->level, &failed), &failed);
    fw_json_effects(effects, &s->ledger, NULL, NULL, &failed);
    fw_json_put(root, "effects", effects, &failed);
    return fw_json_write(root, failed, out);
}
