/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The certificate of the workspace as JSON, every number as its bits. */
#include "base/json.h"
#include "report/report.h"
#include "workspace/pose_load.h"
#include <stdio.h>

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
    if (!p->hold || !p->proved) {
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
