/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/assembly.h"
#include "report/json_common.h"

static json_t *triples(const fw_mechanism *m, const double *value, bool *failed) {
    json_t *o = json_object();
    for (int b = 0; b < m->nbody; b++) {
        json_t *triple = json_array();
        for (int k = 0; k < 3; k++)
            fw_json_push(triple, fw_json_real(value[3 * b + k]), failed);
        fw_json_put(o, m->body[b].id ? m->body[b].id : "?", triple, failed);
    }
    return o;
}

static json_t *bodies(const fw_report_assembly *in, bool *failed) {
    const fw_assembly *a = in->assembly;
    json_t *list = json_array();
    for (int b = 0; b < a->nbody; b++) {
        json_t *o = json_object();
        fw_json_put(o, "id", fw_json_text(in->mechanism->body[b].id), failed);
        fw_json_put(o, "moved_m", fw_json_real(a->moved_m[b]), failed);
        fw_json_put(o, "turned_rad", fw_json_real(a->turned_rad[b]), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *gaps(const fw_assembly *a, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < a->ngap; i++) {
        const fw_joint_gap *g = &a->gap[i];
        json_t *o = json_object();
        fw_json_put(o, "id", fw_json_text(g->id), failed);
        fw_json_put(o, "kind",
                    fw_json_text(g->pin != FW_NONE   ? "revolute"
                                 : g->tie != FW_NONE ? "tie"
                                                     : "driver"),
                    failed);
        fw_json_put(o, "gap_m", fw_json_real(g->gap_m), failed);
        fw_json_put(o, "gap_rad", fw_json_real(g->gap_rad), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *rank(const fw_rank *r, bool *failed) {
    json_t *o = json_object(), *redundant = json_array();
    fw_json_put(o, "dof", json_integer(r->dof), failed);
    fw_json_put(o, "unknowns", json_integer(r->unknowns), failed);
    fw_json_put(o, "rows", json_integer(r->rows), failed);
    fw_json_put(o, "rank", r->known ? json_integer(r->rank) : json_null(), failed);
    fw_json_put(o, "sigma_kept", r->known ? fw_json_real(r->kept) : json_null(), failed);
    fw_json_put(o, "sigma_dropped", r->known ? fw_json_real(r->dropped) : json_null(), failed);
    fw_json_put(o, "clear", json_boolean(r->known && r->clear), failed);
    for (int i = 0; i < r->nredundant; i++)
        fw_json_push(redundant, fw_json_text(r->redundant[i]), failed);
    fw_json_put(o, "redundant", redundant, failed);
    return o;
}

static json_t *branches(const fw_assembly *a, bool *failed) {
    json_t *list = json_array();
    for (int i = 0; i < a->nelbow; i++) {
        const fw_elbow *e = &a->elbow[i];
        json_t *o = json_object();
        fw_json_put(o, "elbow", fw_json_text(e->id), failed);
        fw_json_put(o, "guess", json_integer(e->guess), failed);
        fw_json_put(o, "found", json_integer(e->found), failed);
        fw_json_put(o, "same", json_boolean(e->guess == e->found), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *alternatives(const fw_report_assembly *in, bool *failed) {
    const fw_assembly *a = in->assembly;
    json_t *list = json_array();
    for (int i = 0; i < a->nalternative; i++) {
        const fw_alternative *other = &a->alternative[i];
        json_t *o = json_object(), *differs = json_array();
        for (int e = 0; e < a->nelbow; e++)
            if (other->side[e] != a->elbow[e].found)
                fw_json_push(differs, fw_json_text(a->elbow[e].id), failed);
        fw_json_put(o, "distance_m", fw_json_real(other->distance_m), failed);
        fw_json_put(o, "elbows_mirrored", differs, failed);
        fw_json_put(o, "q", triples(in->mechanism, other->q, failed), failed);
        fw_json_push(list, o, failed);
    }
    return list;
}

static json_t *independent(const fw_kinematics *k, bool *failed) {
    const fw_coordinate_choice *c = &k->independent;
    json_t *o = json_object(), *list = json_array();
    fw_json_put(o, "coordinates", fw_json_text(c->text), failed);
    fw_json_put(o, "chosen", fw_json_text(c->automatic ? "pivoting" : "asked"), failed);
    fw_json_put(o, "condition", fw_json_real(c->condition), failed);
    fw_json_put(o, "better", fw_json_text(c->better), failed);
    for (int i = 0; i < c->count; i++) {
        json_t *one = json_object();
        fw_json_put(one, "rate", fw_json_real(k->rate[i]), failed);
        fw_json_put(one, "acceleration", fw_json_real(k->accel[i]), failed);
        fw_json_put(one, "drive", fw_json_real(k->drive[i]), failed);
        fw_json_push(list, one, failed);
    }
    fw_json_put(o, "values", list, failed);
    return o;
}

static json_t *forces(const fw_report_assembly *in, bool *failed) {
    const fw_mechanism *m = in->mechanism;
    const fw_kinematics *k = in->kinematics;
    json_t *o = json_object(), *pin = json_object(), *tie = json_object();
    json_t *driver = json_object();
    for (int i = 0; i < m->npin; i++)
        fw_json_put(pin, m->pin[i].id ? m->pin[i].id : "?",
                    fw_json_pair(k->reaction_N[2 * i], k->reaction_N[2 * i + 1], failed), failed);
    for (int i = 0; i < m->ntie; i++) {
        json_t *triple = json_array();
        for (int c = 0; c < 3; c++)
            fw_json_push(triple, fw_json_real(k->tie_N[3 * i + c]), failed);
        fw_json_put(tie, m->tie[i].id ? m->tie[i].id : "?", triple, failed);
    }
    for (int i = 0; i < m->ndriver; i++)
        fw_json_put(driver, m->driver[i].id ? m->driver[i].id : "?", fw_json_real(k->driver_N[i]),
                    failed);
    fw_json_put(o, "unique", json_boolean(k->unique), failed);
    fw_json_put(o, "revolute_N", pin, failed);
    fw_json_put(o, "tie_N_Nm", tie, failed);
    fw_json_put(o, "driver_N_or_Nm", driver, failed);
    return o;
}

fw_status fw_report_assemble_json(const fw_report_assembly *in, fw_text *out) {
    const fw_assembly *a = in->assembly;
    bool failed = false;
    json_t *root = json_object();
    fw_json_put(root, "schema", fw_json_text("flexwright.assemble/1"), &failed);
    fw_json_put(root, "closed", json_boolean(in->closed), &failed);
    fw_json_put(root, "iterations", json_integer(a->iterations), &failed);
    fw_json_put(root, "restarts", json_integer(a->restarts), &failed);
    fw_json_put(root, "gap_before_m", fw_json_real(a->gap_before_m), &failed);
    fw_json_put(root, "gap_after_m", fw_json_real(a->gap_after_m), &failed);
    fw_json_put(root, "moved_m", fw_json_real(a->most_moved_m), &failed);
    fw_json_put(root, "turned_rad", fw_json_real(a->most_turned_rad), &failed);
    fw_json_put(root, "distance_m", fw_json_real(a->distance_m), &failed);
    fw_json_put(root, "before", triples(in->mechanism, a->before, &failed), &failed);
    fw_json_put(root, "after", triples(in->mechanism, a->after, &failed), &failed);
    fw_json_put(root, "bodies", bodies(in, &failed), &failed);
    fw_json_put(root, "joints", gaps(a, &failed), &failed);
    if (in->closed) {
        fw_json_put(root, "freedom", rank(&a->rank, &failed), &failed);
        fw_json_put(root, "branches", branches(a, &failed), &failed);
        fw_json_put(root, "alternatives", alternatives(in, &failed), &failed);
        fw_json_put(root, "alternatives_complete", json_boolean(!a->more), &failed);
    }
    if (in->kinematics) {
        fw_json_put(root, "scene", fw_json_text(in->scene ? in->scene->name : NULL), &failed);
        fw_json_put(root, "independent", independent(in->kinematics, &failed), &failed);
    }
    if (in->kinematics && in->motion) {
        fw_json_put(root, "velocity", triples(in->mechanism, in->kinematics->v, &failed), &failed);
        fw_json_put(root, "acceleration", triples(in->mechanism, in->kinematics->a, &failed),
                    &failed);
        fw_json_put(root, "forces", forces(in, &failed), &failed);
    }
    return fw_json_write(root, failed, out);
}
