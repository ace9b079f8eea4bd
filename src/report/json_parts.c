/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_parts.h"
#include <math.h>

void fw_report_json_pair(fw_json *json, const char *key, double a, double b) {
    fw_report_json_reals(json, key, (double[]){a, b}, 2);
}

void fw_report_json_reals(fw_json *json, const char *key, const double *value, int count) {
    fw_json_list(json, key);
    for (int i = 0; i < count; i++)
        fw_json_real(json, NULL, value[i]);
    fw_json_end(json);
}

void fw_report_json_effects(fw_json *json, const fw_effect_ledger *ledger, const char *scene,
                            const char *flow) {
    for (int i = 0; i < ledger->count; i++) {
        const fw_effect_entry *e = &ledger->item[i];
        fw_json_object(json, NULL);
        fw_json_text(json, "id", e->id);
        fw_json_truth(json, "active", e->active);
        fw_json_real(json, "bound", e->bound); /* null: it is the motion */
        fw_json_text(json, "reason", e->reason);
        fw_json_truth(json, "called_for", e->called_for);
        fw_json_real(json, "cost", e->cost); /* instructions per evaluation */
        if (scene) fw_json_text(json, "scene", scene);
        if (flow) fw_json_text(json, "flow", flow);
        fw_json_end(json);
    }
}

/* ---- how hinges were taken, and the step to the next level ---- */

static void changed_bodies(fw_json *json, const fw_mechanism *m, const fw_statics_level_step *s) {
    fw_json_object(json, "dq");
    for (int b = 0; b < m->nbody; b++) {
        double at[3], up[3];
        fw_mechanism_frame_pose(&m->body[b], s->at.q + 3 * (size_t)b, at);
        fw_mechanism_frame_pose(&m->body[b], s->up.q + 3 * (size_t)b, up);
        fw_json_list(json, m->body[b].id);
        for (int k = 0; k < 3; k++)
            fw_json_real(json, NULL, up[k] - at[k]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void changed_hinges(fw_json *json, const fw_mechanism *m, const fw_statics_level_step *s) {
    fw_json_list(json, "hinges");
    for (int k = 0; k < m->nhinge; k++) {
        int pin = m->hinge[k].pin;
        fw_json_object(json, NULL);
        fw_json_text(json, "hinge", m->pin[pin].id);
        fw_json_real(json, "angle_rad", s->at.angle_rad[pin]);
        fw_json_real(json, "next_angle_rad", s->up.angle_rad[pin]);
        fw_json_real(json, "strain", s->at.strain[k]);
        fw_json_real(json, "next_strain", s->up.strain[k]);
        fw_json_end(json);
    }
    fw_json_end(json);
}

static void level_step(fw_json *json, const fw_mechanism *m, const fw_statics_level_step *s) {
    if (!s) {
        fw_json_null(json, "step");
        return;
    }
    fw_json_object(json, "step");
    fw_json_text(json, "next", s->next == s->used ? NULL : fw_effects_hinge_model_text(s->next));
    fw_json_real(json, "t_s", s->t_s);
    fw_json_real(json, "relative", s->relative);
    if (s->why_not) {
        fw_json_null(json, "dq");
        fw_json_null(json, "hinges");
    } else {
        changed_bodies(json, m, s);
        changed_hinges(json, m, s);
    }
    fw_json_text(json, "why_not", s->why_not);
    fw_json_end(json);
}

void fw_report_json_hinge_model(fw_json *json, const fw_mechanism *m,
                                const fw_effects_hinge_use *use,
                                const fw_statics_level_step *level) {
    fw_json_text(json, "used", fw_effects_hinge_model_text(use->used));
    fw_json_text(json, "why", use->why);
    fw_json_real(json, "error", use->error);
    level_step(json, m, level);
}

void fw_report_json_pull_in(fw_json *json, const fw_statics_pull_in *p) {
    fw_json_text(json, "comb", p->comb);
    fw_json_real(json, "voltage_V", p->voltage_V);
    fw_json_real(json, "least_V", fw_statics_pull_in_least_V(p));
    fw_json_text(json, "kind", fw_statics_pull_in_kind_text(p->kind));
    fw_json_real(json, "margin", p->margin);
    fw_json_truth(json, "bifurcation", p->bifurcation);
    fw_json_real(json, "scene_voltage_V", p->largest_V);
    fw_json_real(json, "at_s", p->at_s);
    fw_json_real(json, "along_m", p->where[0]);
    fw_json_real(json, "across_m", p->where[1]);
    fw_json_real(json, "tilt_rad", p->where[2]);
    fw_json_text(json, "body", p->body);
    fw_json_real(json, "fringe", p->fringe);
    fw_json_real(json, "stiffness_error", p->stiffness_error);
    fw_json_real(json, "fingers_V", p->fingers_V);
    fw_json_text(json, "why", p->why);
}

/* ---- the preview ---- */

void fw_report_preview_put_um(fw_text *out, double metres) {
    fw_text_fixed(out, isfinite(metres) ? 1e6 * metres : 0.0, 3);
}

void fw_report_preview_um(fw_json *out, const char *key, double metres) {
    fw_report_preview_put_um(fw_json_value(out, key), metres);
}

void fw_report_preview_point(fw_json *out, const char *key, double x_m, double y_m) {
    fw_json_list(out, key);
    fw_report_preview_um(out, NULL, x_m);
    fw_report_preview_um(out, NULL, y_m);
    fw_json_end(out);
}

void fw_report_preview_bodies(fw_json *out, const char *key, int a, int b) {
    fw_json_list(out, key);
    fw_json_whole(out, NULL, a);
    fw_json_whole(out, NULL, b);
    fw_json_end(out);
}

/* ---- bodies by their reference frames ---- */

static const char *body_id(const fw_mechanism *m, int b) {
    return m->body[b].id ? m->body[b].id : "?";
}

void fw_report_json_poses(fw_json *json, const char *key, const fw_mechanism *m, const double *q) {
    fw_json_object(json, key);
    for (int b = 0; b < m->nbody; b++) {
        double frame[3];
        fw_mechanism_frame_pose(&m->body[b], q + 3 * (size_t)b, frame);
        fw_report_json_reals(json, body_id(m, b), frame, 3);
    }
    fw_json_end(json);
}

void fw_report_json_centres(fw_json *json, const fw_mechanism *m, const double *q) {
    fw_json_object(json, "com");
    for (int b = 0; b < m->nbody; b++)
        fw_report_json_reals(json, body_id(m, b), q + 3 * (size_t)b, 2);
    fw_json_end(json);
}

void fw_report_json_velocities(fw_json *json, const char *key, const fw_mechanism *m,
                               const double *q, const double *v) {
    fw_json_object(json, key);
    for (int b = 0; b < m->nbody; b++) {
        double frame[3];
        size_t at = 3 * (size_t)b;
        fw_mechanism_frame_velocity(&m->body[b], q[at + 2], v + at, frame);
        fw_report_json_reals(json, body_id(m, b), frame, 3);
    }
    fw_json_end(json);
}

void fw_report_json_accelerations(fw_json *json, const char *key, const fw_mechanism *m,
                                  const double *q, const double *v, const double *a) {
    fw_json_object(json, key);
    for (int b = 0; b < m->nbody; b++) {
        double frame[3];
        size_t at = 3 * (size_t)b;
        fw_mechanism_frame_acceleration(&m->body[b], q[at + 2], v[at + 2], a + at, frame);
        fw_report_json_reals(json, body_id(m, b), frame, 3);
    }
    fw_json_end(json);
}
