/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json.h"
#include "report/hinge_model.h"
#include "report/json_effects.h"
#include "report/json_rest.h"

json_t *fw_json_by_body(const fw_mechanism *mechanism, const double *triples, bool *failed) {
    json_t *o = json_object();
    for (int b = 0; b < mechanism->nbody; b++) {
        json_t *triple = json_array();
        for (int k = 0; k < 3; k++)
            fw_json_push(triple, fw_json_real(triples[3 * b + k]), failed);
        fw_json_put(o, mechanism->body[b].id, triple, failed);
    }
    return o;
}

json_t *fw_json_rank(const fw_row_rank *rank, bool *failed) {
    json_t *o = json_object();
    fw_json_put(o, "rows", json_integer(rank->rows), failed);
    fw_json_put(o, "rank", json_integer(rank->rank), failed);
    fw_json_put(o, "smallest_kept", fw_json_real(rank->kept), failed);
    fw_json_put(o, "largest_dropped", fw_json_real(rank->dropped), failed);
    fw_json_put(o, "redundant", fw_json_text(rank->joints), failed);
    return o;
}

/* {"BODY": [[re, im], [re, im], [re, im]]} */
static json_t *complex_shape(const fw_mechanism *m, const double *shape, bool *failed) {
    if (!shape) return json_null();
    json_t *o = json_object();
    for (int b = 0; b < m->nbody; b++) {
        json_t *triple = json_array();
        for (int k = 3 * b; k < 3 * b + 3; k++)
            fw_json_push(triple, fw_json_pair(shape[k], shape[3 * m->nbody + k], failed), failed);
        fw_json_put(o, m->body[b].id, triple, failed);
    }
    return o;
}

static json_t *one(const fw_mechanism *mechanism, const fw_mode *m, bool *failed) {
    const double(*e)[2] = m->eigenvalue_per_s;
    json_t *o = json_object();
    fw_json_put(o, "f_Hz", fw_json_real(m->f_Hz), failed);
    fw_json_put(o, "omega_rad_per_s", fw_json_real(m->omega_rad_per_s), failed);
    fw_json_put(o, "eigenvalue_per_s", fw_json_pair(e[0][0], e[0][1], failed), failed);
    fw_json_put(o, "second_eigenvalue_per_s", fw_json_pair(e[1][0], e[1][1], failed), failed);
    fw_json_put(o, "kind", fw_json_text(fw_mode_kind_text(m->kind)), failed);
    fw_json_put(o, "damping_ratio", fw_json_real(m->damping_ratio), failed);
    fw_json_put(o, "stiffness_per_s2", fw_json_real(m->stiffness_per_s2), failed);
    fw_json_put(o, "modal_mass_kg_m2", fw_json_real(m->modal_mass_kg_m2), failed);
    fw_json_put(o, "bodies", fw_json_text(m->bodies), failed);
    fw_json_put(o, "shape", fw_json_by_body(mechanism, m->shape, failed), failed);
    fw_json_put(o, "damped_shape", complex_shape(mechanism, m->damped, failed), failed);
    return o;
}

fw_status fw_report_modes_json(const fw_mechanism *mechanism, const fw_scene *scene,
                               const fw_modes *modes, fw_text *out) {
    bool failed = false;
    json_t *root = json_object(), *list = json_array(), *effects = json_array();
    fw_json_put(root, "schema", fw_json_text("flexwright.modes/1"), &failed);
    fw_json_put(root, "scene", fw_json_text(scene->name), &failed);
    fw_json_put(root, "at", fw_json_text(modes->at_equilibrium ? "equilibrium" : "rest"), &failed);
    fw_json_put(root, "out_of_rest", fw_json_real(modes->out_of_rest), &failed);
    fw_json_put(root, "unit_length_m", fw_json_real(modes->unit_length_m), &failed);
    fw_json_put(root, "constraints", fw_json_rank(&modes->rank, &failed), &failed);
    fw_json_put(root, "q", fw_json_by_body(mechanism, modes->q, &failed), &failed);
    for (int i = 0; i < modes->count; i++)
        fw_json_push(list, one(mechanism, &modes->mode[i], &failed), &failed);
    fw_json_put(root, "modes", list, &failed);
    fw_json_put(root, "hinge_model",
                fw_json_hinge_model(mechanism, &modes->ledger.hinge, NULL, &failed), &failed);
    fw_json_effects(effects, &modes->ledger, NULL, NULL, &failed);
    fw_json_put(root, "effects", effects, &failed);
    return fw_json_write(root, failed, out);
}
