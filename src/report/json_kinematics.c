/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The assembled position with its branches, the workspace, and its certificate, as JSON. */
#include "base/json.h"
#include "report/json_parts.h"
#include "report/report.h"
#include "workspace/pose_load.h"
#include <stdio.h>

/* ---- the assembled position ---- */

static const char *known(const char *id) {
    return id ? id : "?";
}

static void bodies(fw_json *json, const fw_report_assembly *in) {
    const fw_assembly *a = in->assembly;
    fw_json_list(json, "bodies");
    for (int b = 0; b < a->nbody; b++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "id", in->mechanism->body[b].id);
        fw_json_real(json, "moved_m", a->moved_m[b]);
        fw_json_real(json, "turned_rad", a->turned_rad[b]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void gaps(fw_json *json, const fw_assembly *a) {
    fw_json_list(json, "joints");
    for (int i = 0; i < a->ngap; i++) {
        const fw_assembly_joint_gap *g = &a->gap[i];
        const char *kind = g->pin != FW_NONE ? "revolute" : g->joint != FW_NONE ? "tie" : "driver";
        fw_json_object(json, NULL);
        fw_json_text(json, "id", g->id);
        fw_json_text(json, "kind", kind);
        fw_json_real(json, "gap_m", g->gap_m);
        fw_json_real(json, "gap_rad", g->gap_rad);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void freedom(fw_json *json, const fw_assembly_rank_result *r) {
    fw_json_object(json, "freedom");
    fw_json_whole(json, "dof", r->dof);
    fw_json_whole(json, "unknowns", r->unknowns);
    fw_json_whole(json, "rows", r->rows);
    if (r->known) {
        fw_json_whole(json, "rank", r->rank);
        fw_json_real(json, "sigma_kept", r->kept);
        fw_json_real(json, "sigma_dropped", r->dropped);
    } else {
        fw_json_null(json, "rank");
        fw_json_null(json, "sigma_kept");
        fw_json_null(json, "sigma_dropped");
    }
    fw_json_truth(json, "clear", r->known && r->clear);
    fw_json_list(json, "redundant");
    for (int i = 0; i < r->nredundant; i++)
        fw_json_text(json, NULL, r->redundant[i]);
    fw_json_end(json);
    fw_json_end(json);
}

static void branches(fw_json *json, const fw_assembly *a) {
    fw_json_list(json, "branches");
    for (int i = 0; i < a->nelbow; i++) {
        const fw_assembly_elbow *e = &a->elbow[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "elbow", e->id);
        fw_json_whole(json, "guess", e->guess);
        fw_json_whole(json, "found", e->found);
        fw_json_truth(json, "same", e->guess == e->found);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void alternatives(fw_json *json, const fw_report_assembly *in) {
    const fw_assembly *a = in->assembly;
    fw_json_list(json, "alternatives");
    for (int i = 0; i < a->nalternative; i++) {
        const fw_assembly_alternative *other = &a->alternative[i];
        fw_json_object(json, NULL);
        fw_json_real(json, "distance_m", other->distance_m);
        fw_json_list(json, "elbows_mirrored");
        for (int e = 0; e < a->nelbow; e++)
            if (other->side[e] != a->elbow[e].found) fw_json_text(json, NULL, a->elbow[e].id);
        fw_json_end(json);
        fw_report_json_poses(json, "q", in->mechanism, other->q);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void independent(fw_json *json, const fw_assembly_kinematics *k) {
    const fw_assembly_coordinate_choice *c = &k->independent;
    fw_json_object(json, "independent");
    fw_json_text(json, "coordinates", c->text);
    fw_json_text(json, "chosen", c->automatic ? "pivoting" : "asked");
    fw_json_real(json, "condition", c->condition);
    fw_json_text(json, "better", c->better);
    fw_json_list(json, "values");
    for (int i = 0; i < c->count; i++) {
        fw_json_object(json, NULL);
        fw_json_real(json, "rate", k->rate[i]);
        fw_json_real(json, "acceleration", k->accel[i]);
        fw_json_real(json, "drive", k->drive[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

static void forces(fw_json *json, const fw_report_assembly *in) {
    const fw_mechanism *m = in->mechanism;
    const fw_assembly_kinematics *k = in->kinematics;
    fw_json_object(json, "forces");
    fw_json_truth(json, "unique", k->unique);
    fw_json_object(json, "revolute_N");
    for (int i = 0; i < m->npin; i++)
        fw_report_json_reals(json, known(m->pin[i].id), k->reaction_N + 2 * (size_t)i, 2);
    fw_json_end(json);
    fw_json_object(json, "tie_N_Nm");
    for (int i = 0; i < m->njoint; i++)
        fw_report_json_reals(json, known(m->joint[i].id), k->joint_N + 3 * (size_t)i, 3);
    fw_json_end(json);
    fw_json_object(json, "driver_N_or_Nm");
    for (int i = 0; i < m->ndriver; i++)
        fw_json_real(json, known(m->driver[i].id), k->driver_N[i]);
    fw_json_end(json);
    fw_json_end(json);
}

fw_status fw_report_assemble_json(const fw_report_assembly *in, fw_text *out) {
    const fw_assembly *a = in->assembly;
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.assemble/1");
    fw_json_truth(&json, "closed", in->closed);
    fw_json_whole(&json, "iterations", a->iterations);
    fw_json_whole(&json, "restarts", a->restarts);
    fw_json_real(&json, "gap_before_m", a->gap_before_m);
    fw_json_real(&json, "gap_after_m", a->gap_after_m);
    fw_json_real(&json, "moved_m", a->most_moved_m);
    fw_json_real(&json, "turned_rad", a->most_turned_rad);
    fw_json_real(&json, "distance_m", a->distance_m);
    fw_report_json_poses(&json, "before", in->mechanism, a->before);
    fw_report_json_poses(&json, "after", in->mechanism, a->after);
    fw_report_json_centres(&json, in->mechanism, a->after);
    bodies(&json, in);
    gaps(&json, a);
    if (in->closed) {
        freedom(&json, &a->rank);
        branches(&json, a);
        alternatives(&json, in);
        fw_json_truth(&json, "alternatives_complete", !a->more);
    }
    if (in->kinematics) {
        fw_json_text(&json, "scene", in->scene ? in->scene->name : NULL);
        independent(&json, in->kinematics);
    }
    if (in->kinematics && in->motion) {
        const fw_assembly_kinematics *k = in->kinematics;
        fw_report_json_velocities(&json, "velocity", in->mechanism, a->after, k->v);
        fw_report_json_accelerations(&json, "acceleration", in->mechanism, a->after, k->v, k->a);
        forces(&json, in);
    }
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* ---- the workspace ---- */

static void interval(fw_json *json, const char *key, fw_maths_interval a) {
    fw_report_json_pair(json, key, a.lo, a.hi);
}

/* members of the object about a volume or an area */
static void measure(fw_json *json, const fw_workspace_measure *m, const char *key) {
    interval(json, key, m->value);
    fw_json_whole(json, "boxes", (long long)m->boxes);
}

static void by_hinge(fw_json *json, const char *key, const fw_mechanism *m, const double *value) {
    fw_json_object(json, key);
    for (int i = 0; i < FW_SIX; i++)
        fw_json_real(json, m->pin[i].id, value[i]);
    fw_json_end(json);
}

static bool holds(const fw_workspace_triangle *t, int hinge) {
    return hinge == t->hinge[0] || hinge == t->hinge[1] || hinge == t->hinge[2];
}

static void triangle(fw_json *json, const fw_mechanism *m, const fw_workspace_triangle *t) {
    fw_json_object(json, NULL);
    for (int passive = 0; passive < 2; passive++) {
        fw_json_list(json, passive ? "passive" : "driven");
        for (int i = 0; i < FW_SIX; i++)
            if (holds(t, i) == passive) fw_json_text(json, NULL, m->pin[i].id);
        fw_json_end(json);
    }
    fw_json_truth(json, "regular", t->regular);
    fw_json_truth(json, "singular_inside", t->positive && t->negative);
    interval(json, "twice_area_m2", t->area2_m2);
    interval(json, "least_length_m", t->length_m);
    fw_report_json_reals(json, "at", t->pose, 3);
    fw_json_end(json);
}

static void regularity(fw_json *json, const fw_mechanism *m, const fw_workspace_regularity *s) {
    fw_json_object(json, "singularities");
    fw_json_list(json, "serial");
    for (int side = 0; side < 2; side++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "elbow", m->pin[side ? 4 : 1].id);
        interval(json, "sine", s->sine[side]);
        fw_json_truth(json, "regular", s->regular[side]);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_list(json, "parallel");
    for (int i = 0; i < FW_TRIANGLES; i++)
        triangle(json, m, &s->passive[i]);
    fw_json_end(json);
    fw_json_end(json);
}

static void extents(fw_json *json, const fw_workspace_map *map) {
    static const char *const name[] = {"x_m", "y_m", "phi_rad"};
    fw_json_object(json, "extents");
    for (int c = 0; c < 3; c++) {
        fw_json_list(json, name[c]);
        interval(json, NULL, map->survey.least[c]);
        interval(json, NULL, map->survey.most[c]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void reachable(fw_json *json, const fw_report_workspace_flow *f) {
    const fw_workspace_map *map = f->map;
    if (map->none) {
        fw_json_null(json, "reachable");
        return;
    }
    fw_json_object(json, "reachable");
    fw_json_truth(json, "certified", true);
    by_hinge(json, "limit_rad", f->mechanism, map->limit_rad);
    fw_json_object(json, "volume");
    measure(json, &map->volume, "m2_rad");
    fw_json_end(json);
    extents(json, map);
    fw_json_list(json, "areas");
    for (int i = 0; i < FW_SLICES; i++) {
        fw_json_object(json, NULL);
        measure(json, &map->slice[i].area, "area_m2");
        fw_json_real(json, "phi_rad", map->slice[i].phi_rad);
        fw_json_end(json);
    }
    fw_json_end(json);
    by_hinge(json, "boundary_share", f->mechanism, map->survey.share);
    fw_json_real(json, "exponent", map->survey.exponent);
    regularity(json, f->mechanism, &map->survey.singular);
    fw_json_end(json);
}

static const char *within(const fw_workspace_proof *p, int hinge, double limit) {
    fw_maths_interval a = p->angle_rad[hinge];
    if (!(limit > 0.0)) return NULL;
    if (a.hi <= limit && a.lo >= -limit) return "yes";
    bool beyond = p->most[hinge].angle_rad.lo > limit || p->least[hinge].angle_rad.hi < -limit;
    return beyond ? "no" : "undecided";
}

static void hinge_range(fw_json *json, const fw_report_workspace_flow *f,
                        const fw_workspace_proof *p, const fw_workspace_strain_proof *strain,
                        int i) {
    double limit = f->map->none ? (double)NAN : f->map->limit_rad[i];
    fw_json_object(json, NULL);
    fw_json_text(json, "id", f->mechanism->pin[i].id);
    interval(json, "angle_rad", p->angle_rad[i]);
    fw_json_real(json, "limit_rad", limit);
    fw_json_text(json, "within", within(p, i, limit));
    fw_report_json_reals(json, "least_at", p->least[i].pose, 3);
    fw_report_json_reals(json, "most_at", p->most[i].pose, 3);
    bool loaded = strain->hold && strain->strain[i] > 0.0;
    fw_json_real(json, "strain", loaded ? strain->strain[i] : (double)NAN);
    fw_json_truth(json, "strain_certified", strain->proved);
    fw_json_text(json, "actuation", loaded ? fw_workspace_actuation(strain, i) : NULL);
    fw_json_end(json);
}

static void required_box(fw_json *json, const fw_report_workspace_flow *f,
                         const fw_device_workspace_box *b, int k) {
    const fw_workspace_proof *p = &f->required->proof[k];
    fw_json_object(json, NULL);
    fw_report_json_pair(json, "x_m", b->x_min_m, b->x_max_m);
    fw_report_json_pair(json, "y_m", b->y_min_m, b->y_max_m);
    fw_report_json_pair(json, "phi_rad", b->phi_min_rad, b->phi_max_rad);
    fw_json_truth(json, "reachable", f->required->box_reachable[k]);
    fw_json_truth(json, "certified", p->proved);
    fw_json_list(json, "hinges");
    for (int i = 0; i < FW_SIX && p->proved; i++)
        hinge_range(json, f, p, &f->required->strain[k], i);
    fw_json_end(json);
    if (p->proved)
        regularity(json, f->mechanism, &f->singular[k]);
    else
        fw_json_null(json, "singularities");
    fw_json_end(json);
}

fw_status fw_report_workspace_json(const fw_report_workspace *in, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.workspace/1");
    fw_json_text(&json, "device", in->device->name);
    fw_json_list(&json, "flows");
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        fw_json_object(&json, NULL);
        fw_json_text(&json, "flow", f->flow);
        reachable(&json, f);
        fw_json_text(&json, "none", f->map->none);
        fw_json_list(&json, "required");
        for (int k = 0; k < in->device->nworkspace; k++)
            if (f->required->asked && f->required->asked[k])
                required_box(&json, f, &in->device->workspace[k], k);
        fw_json_end(&json);
        fw_json_end(&json);
    }
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}

/* ---- the certificate of the workspace, every number as its bits ---- */

static void bits(fw_json *json, double value) {
    char text[40];
    snprintf(text, sizeof text, "%a", value);
    for (char *c = text; *c; c++)
        if (*c == ',') *c = '.'; /* a locale's decimal comma */
    fw_json_text(json, NULL, text);
}

static void bits_of(fw_json *json, const char *key, const double *value, int count) {
    fw_json_list(json, key);
    for (int i = 0; i < count; i++)
        bits(json, value[i]);
    fw_json_end(json);
}

static void point(fw_json *json, const char *key, fw_geometry_vec2 p) {
    bits_of(json, key, (double[]){p.x, p.y}, 2);
}

static void range(fw_json *json, const char *key, double low, double high) {
    bits_of(json, key, (double[]){low, high}, 2);
}

static void extreme(fw_json *json, const char *key, const fw_workspace_extreme *e) {
    fw_json_object(json, key);
    bits_of(json, "pose", e->pose, 3);
    range(json, "angle_rad", e->angle_rad.lo, e->angle_rad.hi);
    fw_json_end(json);
}

static void leg(fw_json *json, const char *key, const fw_workspace_leg *l) {
    fw_json_object(json, key);
    point(json, "base_m", l->base);
    point(json, "first_m", l->a);
    point(json, "second_m", l->b);
    point(json, "platform_m", l->to);
    fw_json_end(json);
}

/* one hinge's places and what is claimed of them */
static void strained_hinge(fw_json *json, const fw_report_workspace_flow *f,
                           const fw_workspace_strain_proof *p, int i) {
    const fw_workspace_section *s = &p->hold->section[i];
    fw_json_object(json, NULL);
    fw_json_text(json, "id", f->mechanism->pin[i].id);
    bits_of(json, "stiffness_Nm_per_rad", (double[]){s->spring_Nm_per_rad, s->moment_Nm_per_rad},
            2);
    bits_of(json, "axis", s->axis, 2);
    fw_json_list(json, "stations");
    for (int k = 0; k < s->n; k++) {
        const fw_workspace_station *at = &s->station[k];
        bits_of(json, NULL,
                (double[]){at->lever_m[0], at->lever_m[1], at->bending_per_Nm, at->axial_per_N}, 4);
    }
    fw_json_end(json);
    bits_of(json, "strain", (double[]){p->most[i].strain.lo, p->strain[i]}, 2);
    bits_of(json, "pose", p->most[i].pose, 3);
    fw_json_whole(json, "actuation", p->most[i].grip);
    fw_json_end(json);
}

static void certified_actuator(fw_json *json, const fw_workspace_actuator *a) {
    static const char *const kind[] = {[FW_ACTUATOR_TORQUE] = "torque",
                                       [FW_ACTUATOR_FORCE] = "force",
                                       [FW_ACTUATOR_TENDON] = "tendon",
                                       [FW_ACTUATOR_ELECTRODES] = "electrodes"};
    fw_json_object(json, NULL);
    fw_json_text(json, "id", a->id);
    fw_json_text(json, "kind", kind[a->kind]);
    fw_json_whole(json, "body", a->body);
    fw_json_whole(json, "against", a->against);
    bits_of(json, "direction", a->direction, 2);
    fw_json_truth(json, "pulls", a->pulls);
    fw_json_list(json, "points");
    for (int i = 0; i < a->npoint; i++) {
        fw_json_object(json, NULL);
        fw_json_whole(json, "body", a->point[i].body);
        bits_of(json, "at_m", (double[]){a->point[i].x_m, a->point[i].y_m}, 2);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_end(json);
}

/* what holds the poses, and the strains that nothing of it exceeds */
static void certified_strain(fw_json *json, const fw_report_workspace_flow *f,
                             const fw_workspace_strain_proof *p) {
    if (!p->hold || !p->proved ||
        (p->hold->ngiven > 0 ||
         p->hold->rubs)) { /* the certificate has no words for what is given */
        fw_json_null(json, "strain");
        return;
    }
    fw_json_object(json, "strain");
    bits_of(json, "length_m", &p->hold->length_m, 1);
    fw_json_list(json, "hinges");
    for (int i = 0; i < FW_SIX; i++)
        strained_hinge(json, f, p, i);
    fw_json_end(json);
    fw_json_list(json, "actuators");
    for (int i = 0; i < p->hold->nactuator; i++)
        certified_actuator(json, &p->hold->actuator[i]);
    fw_json_end(json);
    fw_json_list(json, "actuations");
    for (int i = 0; i < p->hold->ngrip; i++) {
        fw_json_list(json, NULL);
        for (int k = 0; k < 3; k++)
            fw_json_whole(json, NULL, p->hold->grip[i].actuator[k]);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_text(json, "tree", p->tree);
    fw_json_end(json);
}

static void mechanism_of(fw_json *json, const fw_workspace_loop *loop) {
    fw_json_object(json, "mechanism");
    leg(json, "left", &loop->leg[0]);
    leg(json, "right", &loop->leg[1]);
    point(json, "centre_m", loop->centre);
    bits_of(json, "start_rad", loop->start_rad, FW_SIX);
    fw_json_end(json);
}

static void certificate(fw_json *json, const fw_report_workspace_flow *f,
                        const fw_workspace_loop *loop, const fw_workspace_proof *p,
                        const fw_workspace_strain_proof *strain) {
    fw_json_object(json, NULL);
    fw_json_text(json, "flow", f->flow);
    mechanism_of(json, loop);
    fw_json_list(json, "box");
    for (int i = 0; i < 3; i++)
        range(json, NULL, p->low[i], p->high[i]);
    fw_json_end(json);
    fw_json_list(json, "hinges");
    for (int i = 0; i < FW_SIX; i++) {
        fw_json_object(json, NULL);
        fw_json_text(json, "id", f->mechanism->pin[i].id);
        range(json, "angle_rad", p->angle_rad[i].lo, p->angle_rad[i].hi);
        extreme(json, "least", &p->least[i]);
        extreme(json, "most", &p->most[i]);
        fw_json_end(json);
    }
    fw_json_end(json);
    fw_json_text(json, "tree", p->tree);
    certified_strain(json, f, strain);
    fw_json_end(json);
}

/* the bracket that is reported, and the boxes that prove it */
static void certified_volume(fw_json *json, const fw_report_workspace_flow *f) {
    const fw_workspace_map *map = f->map;
    fw_json_object(json, NULL);
    fw_json_text(json, "flow", f->flow);
    fw_json_text(json, "none", map->none);
    if (map->none) {
        fw_json_null(json, "volume");
        fw_json_end(json);
        return;
    }
    fw_json_object(json, "volume");
    mechanism_of(json, &map->loop);
    fw_json_list(json, "limits_rad");
    for (int i = 0; i < FW_SIX; i++)
        range(json, NULL, map->limits.low_rad[i], map->limits.high_rad[i]);
    fw_json_end(json);
    fw_json_list(json, "joint_box");
    for (int i = 0; i < 3; i++)
        range(json, NULL, map->proof.box.lo[i], map->proof.box.hi[i]);
    fw_json_end(json);
    range(json, "m2_rad", map->volume.value.lo, map->volume.value.hi);
    fw_json_text(json, "tree", map->proof.tree);
    fw_json_end(json);
    fw_json_end(json);
}

fw_status fw_report_certificate_json(const fw_report_workspace *in, fw_text *out) {
    fw_json json = fw_json_new(out, FW_JSON_INDENTED);
    fw_json_object(&json, NULL);
    fw_json_text(&json, "schema", "flexwright.workspace-certificate/2");
    fw_json_text(&json, "device", in->device->name);
    fw_json_list(&json, "boxes");
    for (int i = 0; i < in->nflow; i++) {
        const fw_report_workspace_flow *f = &in->flow[i];
        fw_workspace_loop loop;
        if (!fw_workspace_loop_set_up(f->mechanism, &loop)) continue;
        for (int k = 0; k < in->device->nworkspace; k++)
            if (f->required->asked && f->required->asked[k] && f->required->proof[k].proved)
                certificate(&json, f, &loop, &f->required->proof[k], &f->required->strain[k]);
    }
    fw_json_end(&json);
    fw_json_list(&json, "volumes");
    for (int i = 0; i < in->nflow; i++)
        certified_volume(&json, &in->flow[i]);
    fw_json_end(&json);
    fw_json_end(&json);
    return fw_json_finish(&json, "\n");
}
