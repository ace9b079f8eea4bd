/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What comes in at the border of this room. */
#include "multibody/model.h"
#include <math.h>

static const char *name_of(const char *id) {
    return id ? id : "(unnamed)";
}

static bool finite_all(const double *value, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(value[i])) return false;
    return true;
}

static bool body_ok(const fw_mechanism *m, int body) {
    return body >= FW_GROUND && body < m->nbody;
}

static fw_status check_joints(const fw_mechanism *m, fw_place place, fw_diags *diags) {
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        const double all[10] = {t->ax_m,
                                t->ay_m,
                                t->bx_m,
                                t->by_m,
                                t->axis_rad,
                                t->stiffness_N_per_m,
                                t->damping_Ns_per_m,
                                t->free_length_m,
                                t->kind == FW_JOINT_DISTANCE ? t->length_m : 1,
                                t->kind == FW_JOINT_DISTANCE ? 0 : t->angle_rad};
        if (!finite_all(all, 10) || all[5] < 0 || all[6] < 0 || all[8] <= 0 ||
            !body_ok(m, t->body_a) || !body_ok(m, t->body_b) || t->body_a == t->body_b)
            return fw_diag_error(diags, 107, place,
                                 "joint %s needs two different bodies and finite values",
                                 name_of(t->id));
    }
    for (int i = 0; i < m->ndriver; i++) {
        const fw_device_driver *d = &m->driver[i];
        bool pin = d->revolute >= 0 && d->revolute < m->npin && d->joint == FW_NONE;
        bool joint = d->joint >= 0 && d->joint < m->njoint && d->revolute == FW_NONE;
        if (!pin && !(joint && m->joint[d->joint].kind != FW_JOINT_WELD))
            return fw_diag_error(diags, 107, place, "driver %s needs one joint that can move",
                                 name_of(d->id));
    }
    return FW_OK;
}

static fw_status check_mechanism(const fw_mechanism *m, fw_place place, fw_diags *diags) {
    if (m->nbody <= 0) return fw_diag_error(diags, 107, place, "there is no body that could move");
    for (int b = 0; b < m->nbody; b++) {
        const fw_mechanism_mass *p = &m->body[b];
        const double all[5] = {p->mass_kg, p->inertia_kg_m2, p->x_m, p->y_m, p->phi_rad};
        if (!finite_all(all, 5) || all[0] <= 0 || all[1] <= 0)
            return fw_diag_error(diags, 107, place,
                                 "body %s needs a finite pose, and mass and inertia above 0",
                                 name_of(p->id));
    }
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        const double all[7] = {p->ax_m,
                               p->ay_m,
                               p->bx_m,
                               p->by_m,
                               p->stiffness_Nm_per_rad,
                               p->damping_Nms_per_rad,
                               p->free_angle_rad};
        if (!finite_all(all, 7) || all[4] < 0 || all[5] < 0 || !body_ok(m, p->body_a) ||
            !body_ok(m, p->body_b) || p->body_a == p->body_b)
            return fw_diag_error(diags, 107, place,
                                 "joint %s needs two different bodies and finite values",
                                 name_of(p->id));
    }
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *p = &m->spring[i];
        const double all[7] = {
            p->ax_m,    p->ay_m, p->bx_m, p->by_m, p->stiffness_N_per_m, p->damping_Ns_per_m,
            p->length_m};
        if (!finite_all(all, 7) || all[4] < 0 || all[5] < 0 || !body_ok(m, p->body_a) ||
            !body_ok(m, p->body_b) || p->body_a == p->body_b)
            return fw_diag_error(diags, 107, place,
                                 "spring %s needs two different bodies and finite values",
                                 name_of(p->id));
    }
    return FW_OK;
}

fw_status fw_multibody_check_motion(const fw_mechanism *m, const fw_device_scene *s,
                                    fw_diags *diags) {
    char text[32];
    if (!(s->duration_s > 0) || !isfinite(s->duration_s))
        return fw_diag_error(diags, 105, s->place, "scene %s lasts %s s; give a duration above 0",
                             name_of(s->name), fw_number_text(text, sizeof text, s->duration_s, 4));
    FW_TRY(check_mechanism(m, s->place, diags));
    FW_TRY(check_joints(m, s->place, diags));
    bool good = finite_all((const double[2]){s->gx_m_per_s2, s->gy_m_per_s2}, 2) || !s->gravity;
    for (int i = 0; i < s->nforce; i++) {
        const fw_device_force *f = &s->force[i];
        const double all[4] = {f->x_m, f->y_m, f->fx_N, f->fy_N};
        good = good && finite_all(all, 4) && body_ok(m, f->body);
    }
    for (int i = 0; i < s->ntorque; i++)
        good = good && isfinite(s->torque[i].value_Nm) && body_ok(m, s->torque[i].body);
    for (int i = 0; i < s->ninitial; i++) {
        const fw_device_initial *v = &s->initial[i];
        const double all[3] = {v->vx_m_per_s, v->vy_m_per_s, v->omega_rad_per_s};
        good = good && finite_all(all, 3) && body_ok(m, v->body);
    }
    if (good) return FW_OK;
    return fw_diag_error(
        diags, 105, s->place,
        "loads and initial velocities of scene %s must be finite and act on bodies of "
        "the mechanism",
        name_of(s->name));
}

/* ---- names ---- */

/* What a block of constraints is called in the description, and where it stands there. */

const char *fw_multibody_block_name(const fw_mechanism *m, const fw_multibody_block *b) {
    const char *id = b->pin != FW_NONE     ? m->pin[b->pin].id
                     : b->joint != FW_NONE ? m->joint[b->joint].id
                                           : m->driver[b->driver].id;
    return id ? id : "(unnamed)";
}

fw_place fw_multibody_block_place(const fw_mechanism *m, const fw_multibody_block *b) {
    const fw_device *d = m->device;
    if (b->driver != FW_NONE) return m->driver[b->driver].place;
    if (b->joint != FW_NONE) return m->joint[b->joint].place;
    return d && b->pin < d->nrevolute ? d->revolute[b->pin].place : (fw_place){0};
}
