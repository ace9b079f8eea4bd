/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays with names and units, and tables of rows; and those of motions, probes and equilibria. */
#include "plan/design.h"
#include "probe/probe.h"
#include "report/report.h"
#include <math.h>
#include <string.h>

/* ---- one array ---- */

static const size_t size_of[] = {[FW_ARRAY_REAL] = sizeof(double),
                                 [FW_ARRAY_WHOLE] = sizeof(int32_t),
                                 [FW_ARRAY_TEXT] = sizeof(const char *),
                                 [FW_ARRAY_COMPLEX] = 2 * sizeof(double),
                                 [FW_ARRAY_TRUTH] = sizeof(int32_t)};

static void *add(fw_plan_arrays *to, fw_plan_array_name name, int32_t type, int dimensions,
                 const fw_plan_axis *axis) {
    fw_array *a = to->no_memory ? NULL : fw_arena_one(to->arena, fw_array);
    size_t n = 1;
    to->no_memory = !a || to->count == FW_PLAN_ARRAYS_MOST;
    if (to->no_memory) return NULL;
    *a = (fw_array){.name = name.name,
                    .unit = name.unit,
                    .about = name.about,
                    .type = type,
                    .dimensions = dimensions,
                    .extent = {1, 1, 1}};
    for (int i = 0; i < dimensions; i++) {
        a->extent[i] = axis[i].n;
        a->label[i] = axis[i].label;
        n *= axis[i].n;
    }
    void *data = fw_arena_alloc(to->arena, n, size_of[type]);
    a->data = data;
    to->no_memory = !data;
    if (data) to->item[to->count++] = a;
    return data;
}

double *fw_plan_array_real(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                           const fw_plan_axis *axis) {
    return add(to, name, FW_ARRAY_REAL, dimensions, axis);
}

double *fw_plan_array_complex(fw_plan_arrays *to, fw_plan_array_name name, int dimensions,
                              const fw_plan_axis *axis) {
    return add(to, name, FW_ARRAY_COMPLEX, dimensions, axis);
}

const char **fw_plan_array_text(fw_plan_arrays *to, fw_plan_array_name name, fw_plan_axis axis) {
    return add(to, name, FW_ARRAY_TEXT, 1, &axis);
}

int32_t *fw_plan_array_whole(fw_plan_arrays *to, fw_plan_array_name name, int32_t type,
                             fw_plan_axis axis) {
    return add(to, name, type, 1, &axis);
}

const char **fw_plan_labels(fw_plan_arrays *to, size_t n) {
    const char **label = to->no_memory ? NULL : fw_arena_array(to->arena, const char *, n);
    to->no_memory = !label;
    return label;
}

/* ---- rows ---- */

static void copy_member(int32_t type, void *to, size_t i, const unsigned char *from) {
    switch (type) {
    case FW_ARRAY_REAL:
        memcpy((double *)to + i, from, sizeof(double));
        break;
    case FW_ARRAY_TEXT:
        memcpy((const char **)to + i, from, sizeof(const char *));
        break;
    case FW_ARRAY_WHOLE:
    case FW_ARRAY_TRUTH:
        ((int32_t *)to)[i] = *(const int *)(const void *)from;
        break;
    }
}

void fw_plan_array_columns(fw_plan_arrays *to, const fw_plan_column *column, size_t ncolumn,
                           const void *row, size_t n, size_t size, const char *const *label) {
    const fw_plan_axis axis = {n, label};
    for (size_t k = 0; k < ncolumn; k++) {
        void *data = add(to, column[k].name, column[k].type, 1, &axis);
        for (size_t i = 0; data && i < n; i++)
            copy_member(column[k].type, data, i,
                        (const unsigned char *)row + i * size + column[k].at);
    }
}

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

/* ---- what they share ----
   Poses, velocities and forces of a mechanism: poses are those of reference frames, as in all documents. */

static const char *const pose_labels[3] = {"x", "y", "phi"};
static const char *const xy_labels[2] = {"x", "y"};
static const char *const load_labels[3] = {"x", "y", "torque"};

typedef struct mechanism_axes { /* the axes of a mechanism */
    const fw_mechanism *mechanism;
    fw_plan_axis body, pin, joint, driver;
} mechanism_axes;

static fw_plan_axis axis_of(const char **label, int n) {
    return (fw_plan_axis){(size_t)n, label};
}

static fw_status axes_of_bodies(fw_plan_arrays *to, const fw_mechanism *m, mechanism_axes *out) {
    const char **body, **pin, **joint, **driver;
    FW_NEED(body = fw_plan_labels(to, (size_t)m->nbody));
    FW_NEED(pin = fw_plan_labels(to, (size_t)m->npin));
    FW_NEED(joint = fw_plan_labels(to, (size_t)m->njoint));
    FW_NEED(driver = fw_plan_labels(to, (size_t)m->ndriver));
    for (int i = 0; i < m->nbody; i++)
        body[i] = m->body[i].id;
    for (int i = 0; i < m->npin; i++)
        pin[i] = m->pin[i].id;
    for (int i = 0; i < m->njoint; i++)
        joint[i] = m->joint[i].id;
    for (int i = 0; i < m->ndriver; i++)
        driver[i] = m->driver[i].id;
    *out = (mechanism_axes){m, axis_of(body, m->nbody), axis_of(pin, m->npin),
                            axis_of(joint, m->njoint), axis_of(driver, m->ndriver)};
    return FW_OK;
}

/* an array of rows of what `inner` counts by `last`; rows 0: the first axis is not there */
static double *table(fw_plan_arrays *to, fw_plan_array_name name, size_t rows, fw_plan_axis inner,
                     size_t last, const char *const *label) {
    const fw_plan_axis axis[3] = {{rows, NULL}, inner, {last, label}};
    const int from = rows ? 0 : 1, dimensions = (rows ? 1 : 0) + (last ? 2 : 1);
    return fw_plan_array_real(to, name, dimensions, axis + from);
}

/* (rows x body x 3) of reference frames, from (rows x 3 nbody) of centres of mass; rows 0: one pose,
   without that axis. What is NULL has no array */
static void add_poses(fw_plan_arrays *to, const mechanism_axes *b, fw_plan_array_name name,
                      size_t rows, const double *q) {
    double *out = q ? table(to, name, rows, b->body, 3, pose_labels) : NULL;
    const size_t n = b->body.n;
    for (size_t i = 0; out && i < (rows ? rows : 1) * n; i++)
        fw_mechanism_frame_pose(&b->mechanism->body[i % n], q + 3 * i, out + 3 * i);
}

static void add_velocities(fw_plan_arrays *to, const mechanism_axes *b, fw_plan_array_name name,
                           size_t rows, const double *q, size_t q_rows, const double *v) {
    double *out = q && v ? table(to, name, rows, b->body, 3, pose_labels) : NULL;
    const size_t n = b->body.n;
    for (size_t i = 0; out && i < (rows ? rows : 1) * n; i++)
        fw_mechanism_frame_velocity(&b->mechanism->body[i % n], q[3 * (i % (q_rows * n)) + 2],
                                    v + 3 * i, out + 3 * i);
}

/* "com" (rows x body x 2): centres of mass */
static void add_centres(fw_plan_arrays *to, const mechanism_axes *b, size_t rows, const double *q) {
    const fw_plan_array_name name = {"com", "m", "places of the centres of mass"};
    double *out = q ? table(to, name, rows, b->body, 2, xy_labels) : NULL;
    for (size_t i = 0; out && i < (rows ? rows : 1) * b->body.n; i++)
        memcpy(out + 2 * i, q + 3 * i, 2 * sizeof *out);
}

/* (rows x n) copied */
static void add_copy(fw_plan_arrays *to, fw_plan_array_name name, size_t rows, fw_plan_axis axis,
                     const double *value) {
    double *out = value ? table(to, name, rows, axis, 0, NULL) : NULL;
    const size_t n = (rows ? rows : 1) * axis.n;
    if (out && n) memcpy(out, value, n * sizeof *out);
}

/* "force" (pin x 2), "joint_force" (joint x 3), "driver_force" (driver) and "driver_unit" */
static void add_forces(fw_plan_arrays *to, const mechanism_axes *b, size_t rows,
                       const double *reaction_N, const double *joint_N, const double *driver_N) {
    const size_t n = rows ? rows : 1;
    double *out = NULL;
    if (reaction_N)
        out = table(to,
                    (fw_plan_array_name){"force", "N",
                                         "what a revolute joint does to its body b, world axes"},
                    rows, b->pin, 2, xy_labels);
    if (out && b->pin.n) memcpy(out, reaction_N, n * b->pin.n * 2 * sizeof *out);
    out = NULL;
    if (joint_N)
        out = table(to,
                    (fw_plan_array_name){"joint_force", "N,N,N m",
                                         "what another joint does to its body b, world axes, and "
                                         "the torque about its point b"},
                    rows, b->joint, 3, load_labels);
    if (out && b->joint.n) memcpy(out, joint_N, n * b->joint.n * 3 * sizeof *out);
    add_copy(to,
             (fw_plan_array_name){"driver_force", "*",
                                  "force or torque of a driver along what it drives"},
             rows, b->driver, driver_N);
    const char **unit = fw_plan_array_text(
        to, (fw_plan_array_name){"driver_force_unit", "", "unit of driver_force"}, b->driver);
    for (size_t i = 0; unit && i < b->driver.n; i++)
        unit[i] = b->mechanism->driver[i].revolute != FW_NONE ? "N m" : "N";
}

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

static void accelerations(fw_plan_arrays *to, const mechanism_axes *b,
                          const fw_dynamics_motion *m) {
    const size_t n = (size_t)m->nbody;
    const fw_plan_axis axis[3] = {{(size_t)m->nsample, NULL}, b->body, {3, pose_labels}};
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
    mechanism_axes b;
    fw_dynamics_motion_rows(m, 0, m->nsample);
    FW_TRY(axes_of_bodies(to, d->mechanism, &b));
    add_copy(to, (fw_plan_array_name){"t", "s", "evenly over the scene"}, 0,
             (fw_plan_axis){rows, NULL}, m->t_s);
    add_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses of reference frames"}, rows,
              m->q);
    add_velocities(to, &b,
                   (fw_plan_array_name){"v", "m/s,m/s,rad/s", "velocities of reference frames"},
                   rows, m->q, rows, m->v);
    accelerations(to, &b, m);
    add_centres(to, &b, rows, m->q);
    add_copy(
        to,
        (fw_plan_array_name){"angle", "rad", "rotation of each revolute joint from its free angle"},
        rows, b.pin, m->angle_rad);
    add_forces(to, &b, rows, m->reaction_N, m->joint_N, m->driver_N);
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
    mechanism_axes b;
    FW_TRY(axes_of_bodies(to, d->mechanism, &b));
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

static void shapes(fw_plan_arrays *to, const mechanism_axes *b, const fw_statics_modes *m) {
    const size_t n = (size_t)m->count;
    const fw_plan_axis axis[3] = {{n, NULL}, b->body, {3, pose_labels}};
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
    fw_mechanism_plates plates;
    FW_TRY(see(to, d->mechanism, d->scene, NULL, of_modes, &seen));
    FW_TRY(fw_mechanism_plates_new(d->plan->arena, d->mechanism, NULL, &plates));
    double *value = fw_plan_array_real(
        to, (fw_plan_array_name){"probe", "*", "of small motions; NaN: nothing holds it"}, 1,
        &seen.axis);
    double *error = fw_plan_array_real(
        to, (fw_plan_array_name){"probe_error", "*", "of it; infinite: not known"}, 1, &seen.axis);
    for (size_t k = 0; value && error && k < seen.axis.n; k++) {
        fw_report_probe_small(seen.used[k], d->modes, &plates, &value[k], &error[k]);
    }
    return FW_OK;
}

fw_status fw_plan_numbers_modes(fw_design *d, fw_plan_arrays *to) {
    const fw_statics_modes *m = d->modes;
    const fw_plan_axis modes = {(size_t)m->count, NULL}, one = {1, NULL};
    const fw_plan_axis pair[2] = {modes, {2, NULL}};
    mechanism_axes b;
    FW_TRY(axes_of_bodies(to, d->mechanism, &b));
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
    add_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "the pose that they are about"}, 0,
              m->q);
    add_copy(to, (fw_plan_array_name){"unit_length", "m", "of the shapes"}, 0, one,
             &m->unit_length_m);
    add_copy(to, (fw_plan_array_name){"frequency_error", "1", "relative, of every frequency"}, 0,
             one, &m->frequency_error);
    return mode_probes(d, to);
}

/* ---- equilibrium ---- */

static fw_status statics_probes(fw_design *d, fw_plan_arrays *to) {
    const fw_mechanism *m = d->mechanism;
    const size_t n = (size_t)fw_probe_count(m);
    fw_probe *probe;
    fw_plan_axis axis = {0, NULL};
    const char **label = fw_plan_labels(to, n);
    const char **unit_of = fw_plan_labels(to, n);
    double *seen = fw_arena_array(to->arena, double, n);
    if (!label || !unit_of || !seen) return FW_NOMEM;
    FW_TRY(fw_probe_bind(to->arena, m, d->scene, d->statics->loads, &probe));
    for (size_t i = 0; i < n; i++) {
        if (!fw_report_probe_moves(&probe[i])) continue;
        label[axis.n] = probe[i].asked->id;
        unit_of[axis.n] = probe[i].kind->unit;
        seen[axis.n++] = fw_probe_at_equilibrium(&probe[i], d->scene, d->statics);
    }
    axis.label = label;
    add_copy(to, (fw_plan_array_name){"probe", "*", "what each probe sees"}, 0, axis, seen);
    const char **unit = fw_plan_array_text(
        to, (fw_plan_array_name){"probe_unit", "", "SI unit of each probe"}, axis);
    for (size_t i = 0; unit && i < axis.n; i++)
        unit[i] = unit_of[i];
    return FW_OK;
}

fw_status fw_plan_numbers_statics(fw_design *d, fw_plan_arrays *to) {
    const fw_statics *s = d->statics;
    const fw_plan_axis one = {1, NULL};
    mechanism_axes b;
    FW_TRY(axes_of_bodies(to, d->mechanism, &b));
    add_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses of reference frames"}, 0, s->q);
    add_poses(to, &b, (fw_plan_array_name){"rest_q", "m,m,rad", "the same where nothing acts"}, 0,
              s->rest_q);
    add_centres(to, &b, 0, s->q);
    add_copy(
        to,
        (fw_plan_array_name){"angle", "rad", "rotation of each revolute joint from its free angle"},
        0, b.pin, s->angle_rad);
    add_forces(to, &b, 0, s->reaction_N, s->joint_N, s->driver_N);
    add_copy(to,
             (fw_plan_array_name){"eigenvalue", "1/s^2",
                                  "of the tangent stiffness over the mass, ascending; "
                                  "below 0: unstable"},
             0, (fw_plan_axis){(size_t)s->eigenvalues, NULL}, s->eigenvalue_per_s2);
    int32_t *stable = fw_plan_array_whole(to, (fw_plan_array_name){"stable", "1", "0: it is not"},
                                          FW_ARRAY_TRUTH, one);
    if (stable) *stable = s->negative == 0;
    add_copy(to, (fw_plan_array_name){"residual", "1", "force that is left over the largest force"},
             0, one, &s->residual);
    return statics_probes(d, to);
}

fw_status fw_plan_numbers_load_path(fw_design *d, fw_plan_arrays *to) {
    const fw_statics_path *p = d->statics->path;
    mechanism_axes b;
    if (!p || p->count == 0) return FW_OK;
    const size_t rows = (size_t)p->count;
    const fw_plan_axis points = {rows, NULL};
    FW_TRY(axes_of_bodies(to, d->mechanism, &b));
    add_copy(to, (fw_plan_array_name){"factor", "1", "of the loads: 0 at rest, 1 all of them"}, 0,
             points, p->factor);
    add_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses of reference frames"}, rows,
              p->q);
    add_centres(to, &b, rows, p->q);
    add_copy(
        to,
        (fw_plan_array_name){"angle", "rad", "rotation of each revolute joint from its free angle"},
        rows, b.pin, p->angle_rad);
    add_forces(to, &b, rows, p->reaction_N, p->joint_N, p->driver_N);
    add_copy(to, (fw_plan_array_name){"lowest", "1/s^2", "least eigenvalue; below 0: unstable"}, 0,
             points, p->lowest_per_s2);
    int32_t *negative = fw_plan_array_whole(
        to, (fw_plan_array_name){"negative", "1", "eigenvalues below 0"}, FW_ARRAY_WHOLE, points);
    const char **mark = fw_plan_array_text(
        to, (fw_plan_array_name){"kind", "", "what the point is, fold or bifurcation too"}, points);
    for (size_t i = 0; negative && mark && i < rows; i++) {
        negative[i] = p->negative[i];
        mark[i] = fw_report_path_mark(p->mark[i]);
    }
    return FW_OK;
}

/* ---- the assembled position ---- */

fw_status fw_plan_numbers_assembly(fw_design *d, fw_plan_arrays *to) {
    const fw_plan_assembly *in = &d->assembly;
    const fw_assembly *a = in->assembly;
    const fw_assembly_kinematics *k = in->kinematics;
    mechanism_axes b;
    FW_TRY(axes_of_bodies(to, in->mechanism, &b));
    add_poses(to, &b, (fw_plan_array_name){"before", "m,m,rad", "as the file states them"}, 0,
              a->before);
    add_poses(to, &b, (fw_plan_array_name){"q", "m,m,rad", "poses with closed joints"}, 0,
              a->after);
    add_centres(to, &b, 0, a->after);
    add_copy(to, (fw_plan_array_name){"moved", "m", "of each centre of mass"}, 0, b.body,
             a->moved_m);
    add_copy(to, (fw_plan_array_name){"turned", "rad", "of each body"}, 0, b.body, a->turned_rad);
    if (!k) return FW_OK;
    add_velocities(to, &b,
                   (fw_plan_array_name){"v", "m/s,m/s,rad/s", "velocities of reference frames"}, 0,
                   k->q, 1, k->v);
    add_forces(to, &b, 0, k->reaction_N, k->joint_N, k->driver_N);
    return FW_OK;
}

/* ---- the workspace ---- */

static fw_status limits(fw_plan_arrays *to, const fw_report_workspace *w, fw_plan_axis flows) {
    const char **hinge = fw_plan_labels(to, FW_SIX);
    FW_NEED(hinge);
    for (int i = 0; w->nflow > 0 && i < FW_SIX; i++)
        hinge[i] = w->flow[0].mechanism->pin[i].id;
    const fw_plan_axis axis[2] = {flows, {FW_SIX, hinge}};
    double *limit = fw_plan_array_real(
        to, (fw_plan_array_name){"limit_angle", "rad", "of each hinge"}, 2, axis);
    double *share = fw_plan_array_real(
        to, (fw_plan_array_name){"boundary_share", "1", "of the boundary, by hinge; an estimate"},
        2, axis);
    for (size_t i = 0; limit && share && i < flows.n * FW_SIX; i++) {
        const fw_workspace_map *map = w->flow[i / FW_SIX].map;
        limit[i] = map->none ? (double)NAN : map->limit_rad[i % FW_SIX];
        share[i] = map->none ? (double)NAN : map->survey.share[i % FW_SIX];
    }
    return FW_OK;
}

static void extents(fw_plan_arrays *to, const fw_report_workspace *w, fw_plan_axis flows) {
    static const char *const bracket[2] = {"low", "high"};
    const double none = (double)NAN;
    const fw_plan_axis axis[3] = {flows, {2, bracket}, {3, pose_labels}};
    double *volume = fw_plan_array_real(
        to, (fw_plan_array_name){"volume", "m^2 rad", "of the reachable poses, proved bracket"}, 2,
        axis);
    double *least = fw_plan_array_real(
        to, (fw_plan_array_name){"least", "m,m,rad", "where the displacements end, proved bracket"},
        3, axis);
    double *most = fw_plan_array_real(
        to, (fw_plan_array_name){"most", "m,m,rad", "the other end, proved bracket"}, 3, axis);
    for (size_t i = 0; volume && least && most && i < flows.n; i++) {
        const fw_workspace_map *map = w->flow[i].map;
        volume[2 * i] = map->none ? none : map->volume.value.lo;
        volume[2 * i + 1] = map->none ? none : map->volume.value.hi;
        for (size_t c = 0; c < 3; c++) {
            least[6 * i + c] = map->none ? none : map->survey.least[c].lo;
            least[6 * i + 3 + c] = map->none ? none : map->survey.least[c].hi;
            most[6 * i + c] = map->none ? none : map->survey.most[c].lo;
            most[6 * i + 3 + c] = map->none ? none : map->survey.most[c].hi;
        }
    }
}

fw_status fw_plan_numbers_workspace(fw_design *d, fw_plan_arrays *to) {
    const fw_report_workspace *w = &d->workspace;
    const char **label = fw_plan_labels(to, (size_t)w->nflow);
    FW_NEED(label);
    const fw_plan_axis flows = {(size_t)w->nflow, label};
    for (int i = 0; i < w->nflow; i++)
        label[i] = w->flow[i].flow ? w->flow[i].flow : "";
    const char **flow =
        fw_plan_array_text(to, (fw_plan_array_name){"flow", "", "of the row"}, flows);
    const char **none = fw_plan_array_text(
        to, (fw_plan_array_name){"none", "", "why there is nothing; none: there is"}, flows);
    for (size_t i = 0; flow && none && i < flows.n; i++) {
        flow[i] = w->flow[i].flow;
        none[i] = w->flow[i].map->none;
    }
    extents(to, w, flows);
    return limits(to, w, flows);
}
