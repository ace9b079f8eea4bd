/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion and small motions as arrays. */
#include "plan/arrays.h"
#include "probe/probe.h"
#include <math.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

/* ---- probes of a scene, by row or at one pose ---- */

typedef struct seen_probes {
    fw_probe *probe; /* (n) those that have a course in the scene first */
    const fw_probe **used;
    fw_plan_axis axis;
} seen_probes;

static fw_status see(fw_plan_arrays *to, const fw_mechanism *m, const fw_device_scene *scene,
                     const fw_effects_loads *loads, bool (*has)(const fw_probe *p),
                     seen_probes *out) {
    const int n = fw_probe_count(m);
    const char **label, **unit;
    FW_TRY(fw_probe_bind(to->arena, m, scene, loads, &out->probe));
    FW_NEED(out->used = fw_arena_array(to->arena, const fw_probe *, (size_t)n));
    FW_NEED(label = fw_plan_labels(to, (size_t)n));
    out->axis = (fw_plan_axis){0, label};
    for (int i = 0; i < n; i++)
        if (has(&out->probe[i])) {
            out->used[out->axis.n] = &out->probe[i];
            label[out->axis.n++] = out->probe[i].asked->id;
        }
    unit = fw_plan_array_text(to, (fw_plan_array_name){"probe_unit", "", "SI unit of each probe"},
                              out->axis);
    for (size_t i = 0; unit && i < out->axis.n; i++)
        unit[i] = out->used[i]->kind->unit;
    return FW_OK;
}

static bool moves(const fw_probe *p) {
    return p->in_scene && fw_device_probe_moves(p->kind);
}

static bool of_modes(const fw_probe *p) {
    return p->row->small != NULL;
}

/* ---- a motion ---- */

static void accelerations(fw_plan_arrays *to, const fw_plan_bodies *b,
                          const fw_dynamics_motion *m) {
    const size_t n = (size_t)m->nbody;
    const fw_plan_axis axis[3] = {{(size_t)m->nsample, NULL}, b->body, {3, fw_plan_pose_labels}};
    double *a = fw_plan_array_real(
        to, (fw_plan_array_name){"a", "m/s^2,m/s^2,rad/s^2", "accelerations of reference frames"},
        3, axis);
    for (size_t i = 0; a && i < (size_t)m->nsample * n; i++)
        fw_mechanism_frame_acceleration(&b->mechanism->body[i % n], m->q[3 * i + 2],
                                        m->v[3 * i + 2], m->accel + 3 * i, a + 3 * i);
}

static fw_status motion_probes(fw_design *d, fw_plan_arrays *to) {
    const fw_dynamics_motion *m = d->motion;
    seen_probes seen;
    FW_TRY(see(to, d->mechanism, d->scene, m->loads, moves, &seen));
    const fw_plan_axis axis[2] = {{(size_t)m->nsample, NULL}, seen.axis};
    double *value =
        fw_plan_array_real(to, (fw_plan_array_name){"probe", "*", "what each probe sees"}, 2, axis);
    for (size_t k = 0; value && k < seen.axis.n; k++)
        for (int i = 0; i < m->nsample; i++)
            value[(size_t)i * seen.axis.n + k] = fw_probe_at_row(seen.used[k], m, i);
    return FW_OK;
}

fw_status fw_plan_numbers_motion(fw_design *d, fw_plan_arrays *to) {
    const fw_dynamics_motion *m = d->motion;
    const size_t rows = (size_t)m->nsample;
    fw_plan_bodies b;
    fw_dynamics_motion_rows(m, 0, m->nsample);
    FW_TRY(fw_plan_bodies_of(to, d->mechanism, &b));
    fw_plan_array_copy(to, (fw_plan_array_name){"t", "s", "evenly over the scene"}, 0,
                       (fw_plan_axis){rows, NULL}, m->t_s);
    fw_plan_array_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses of reference frames"},
                        rows, m->q);
    fw_plan_array_velocities(
        to, &b, (fw_plan_array_name){"v", "m/s,m/s,rad/s", "velocities of reference frames"}, rows,
        m->q, rows, m->v);
    accelerations(to, &b, m);
    fw_plan_array_centres(to, &b, rows, m->q);
    fw_plan_array_copy(
        to,
        (fw_plan_array_name){"angle", "rad", "rotation of each revolute joint from its free angle"},
        rows, b.pin, m->angle_rad);
    fw_plan_array_forces(to, &b, rows, m->reaction_N, m->joint_N, m->driver_N);
    return motion_probes(d, to);
}

static const fw_plan_column peak_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_dynamics_peak, angle_rad, "angle", "rad",
                   "largest, between the rows too, with its sign"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_dynamics_peak, t_s, "t", "s", "when"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_dynamics_peak, error_rad, "error", "rad",
                   "estimated; infinite: there was no second run"),
};

fw_status fw_plan_numbers_peaks(fw_design *d, fw_plan_arrays *to) {
    FW_TRY(fw_plan_design_know(d, FW_WANTED_FIGURES));
    fw_plan_bodies b;
    FW_TRY(fw_plan_bodies_of(to, d->mechanism, &b));
    const char **id = fw_plan_array_text(to, (fw_plan_array_name){"id", "", "the joint"}, b.pin);
    for (size_t i = 0; id && i < b.pin.n; i++)
        id[i] = b.pin.label[i];
    fw_plan_array_columns(to, peak_columns, COUNT(peak_columns), d->motion->peak, b.pin.n,
                          sizeof *d->motion->peak, b.pin.label);
    return FW_OK;
}

/* ---- modes ---- */

static const fw_plan_column mode_columns[] = {
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_statics_mode, f_Hz, "f", "Hz", "undamped; 0: there is none"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_statics_mode, omega_rad_per_s, "omega", "rad/s", "undamped"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_statics_mode, stiffness_per_s2, "stiffness", "1/s^2",
                   "omega^2, below 0 where it is unstable"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_statics_mode, damping_ratio, "damping_ratio", "1",
                   "NaN: free or unstable"),
    FW_PLAN_COLUMN(FW_ARRAY_REAL, fw_statics_mode, modal_mass_kg_m2, "modal_mass", "kg m^2",
                   "of the shape as it is scaled"),
    FW_PLAN_COLUMN(FW_ARRAY_TEXT, fw_statics_mode, bodies, "bodies", "", "that take part"),
};

static void shapes(fw_plan_arrays *to, const fw_plan_bodies *b, const fw_statics_modes *m) {
    const size_t n = (size_t)m->count;
    const fw_plan_axis axis[3] = {{n, NULL}, b->body, {3, fw_plan_pose_labels}};
    double *shape = fw_plan_array_real(
        to,
        (fw_plan_array_name){"shape", "m,m,rad",
                             "undamped, of reference frames; the largest of rotation and "
                             "displacement over unit_length is 1"},
        3, axis);
    double *damped =
        fw_plan_array_complex(to,
                              (fw_plan_array_name){"damped_shape", "m,m,rad",
                                                   "of the first eigenvalue; NaN: there is none"},
                              3, axis);
    for (size_t i = 0; shape && damped && i < n * b->body.n; i++) {
        const fw_statics_mode *mode = &m->mode[i / b->body.n];
        const size_t at = 3 * (i % b->body.n);
        const fw_mechanism_mass *body = &b->mechanism->body[i % b->body.n];
        const double phi = m->q[at + 2];
        double part[2][3] = {{(double)NAN, (double)NAN, (double)NAN},
                             {(double)NAN, (double)NAN, (double)NAN}};
        fw_mechanism_frame_velocity(body, phi, mode->shape + at, shape + 3 * i);
        for (size_t k = 0; mode->damped && k < 2; k++)
            fw_mechanism_frame_velocity(body, phi, mode->damped + 3 * k * b->body.n + at, part[k]);
        for (size_t k = 0; k < 6; k++)
            damped[6 * i + k] = part[k % 2][k / 2];
    }
}

static fw_status mode_probes(fw_design *d, fw_plan_arrays *to) {
    seen_probes seen;
    FW_TRY(see(to, d->mechanism, d->scene, NULL, of_modes, &seen));
    double *value = fw_plan_array_real(
        to, (fw_plan_array_name){"probe", "*", "of small motions; NaN: nothing holds it"}, 1,
        &seen.axis);
    double *error = fw_plan_array_real(
        to, (fw_plan_array_name){"probe_error", "*", "of it; infinite: not known"}, 1, &seen.axis);
    for (size_t k = 0; value && error && k < seen.axis.n; k++) {
        value[k] = fw_probe_small(seen.used[k], d->modes);
        error[k] = fw_probe_small_error(seen.used[k], d->modes) * fabs(value[k]);
    }
    return FW_OK;
}

fw_status fw_plan_numbers_modes(fw_design *d, fw_plan_arrays *to) {
    const fw_statics_modes *m = d->modes;
    const fw_plan_axis modes = {(size_t)m->count, NULL}, one = {1, NULL};
    const fw_plan_axis pair[2] = {modes, {2, NULL}};
    fw_plan_bodies b;
    FW_TRY(fw_plan_bodies_of(to, d->mechanism, &b));
    fw_plan_array_columns(to, mode_columns, COUNT(mode_columns), m->mode, modes.n, sizeof *m->mode,
                          NULL);
    const char **kind = fw_plan_array_text(
        to, (fw_plan_array_name){"kind", "", "oscillation, overdamped, free, unstable"}, modes);
    double *eigenvalue = fw_plan_array_complex(
        to, (fw_plan_array_name){"eigenvalue", "1/s", "damped: both of the mode"}, 2, pair);
    for (size_t i = 0; kind && eigenvalue && i < modes.n; i++) {
        kind[i] = fw_statics_mode_kind_text(m->mode[i].kind);
        for (size_t k = 0; k < 4; k++)
            eigenvalue[4 * i + k] = m->mode[i].eigenvalue_per_s[k / 2][k % 2];
    }
    shapes(to, &b, m);
    fw_plan_array_poses(
        to, &b, (fw_plan_array_name){"q", "m,m,rad", "the pose that they are about"}, 0, m->q);
    fw_plan_array_copy(to, (fw_plan_array_name){"unit_length", "m", "of the shapes"}, 0, one,
                       &m->unit_length_m);
    fw_plan_array_copy(to,
                       (fw_plan_array_name){"frequency_error", "1", "relative, of every frequency"},
                       0, one, &m->frequency_error);
    return mode_probes(d, to);
}
