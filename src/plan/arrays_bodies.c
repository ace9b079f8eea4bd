/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses, velocities and forces of a mechanism as arrays: poses are those of reference frames, as in all
   documents. */
#include "plan/arrays.h"
#include <string.h>

const char *const fw_plan_pose_labels[3] = {"x", "y", "phi"};
const char *const fw_plan_xy_labels[2] = {"x", "y"};
static const char *const load_labels[3] = {"x", "y", "torque"};

static fw_plan_axis axis_of(const char **label, int n) {
    return (fw_plan_axis){(size_t)n, label};
}

fw_status fw_plan_bodies_of(fw_plan_arrays *to, const fw_mechanism *m, fw_plan_bodies *out) {
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
    *out = (fw_plan_bodies){m, axis_of(body, m->nbody), axis_of(pin, m->npin),
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

void fw_plan_array_poses(fw_plan_arrays *to, const fw_plan_bodies *b, fw_plan_array_name name,
                         size_t rows, const double *q) {
    double *out = q ? table(to, name, rows, b->body, 3, fw_plan_pose_labels) : NULL;
    const size_t n = b->body.n;
    for (size_t i = 0; out && i < (rows ? rows : 1) * n; i++)
        fw_mechanism_frame_pose(&b->mechanism->body[i % n], q + 3 * i, out + 3 * i);
}

void fw_plan_array_velocities(fw_plan_arrays *to, const fw_plan_bodies *b, fw_plan_array_name name,
                              size_t rows, const double *q, size_t q_rows, const double *v) {
    double *out = q && v ? table(to, name, rows, b->body, 3, fw_plan_pose_labels) : NULL;
    const size_t n = b->body.n;
    for (size_t i = 0; out && i < (rows ? rows : 1) * n; i++)
        fw_mechanism_frame_velocity(&b->mechanism->body[i % n], q[3 * (i % (q_rows * n)) + 2],
                                    v + 3 * i, out + 3 * i);
}

void fw_plan_array_centres(fw_plan_arrays *to, const fw_plan_bodies *b, size_t rows,
                           const double *q) {
    const fw_plan_array_name name = {"com", "m", "places of the centres of mass"};
    double *out = q ? table(to, name, rows, b->body, 2, fw_plan_xy_labels) : NULL;
    for (size_t i = 0; out && i < (rows ? rows : 1) * b->body.n; i++)
        memcpy(out + 2 * i, q + 3 * i, 2 * sizeof *out);
}

void fw_plan_array_copy(fw_plan_arrays *to, fw_plan_array_name name, size_t rows, fw_plan_axis axis,
                        const double *value) {
    double *out = value ? table(to, name, rows, axis, 0, NULL) : NULL;
    const size_t n = (rows ? rows : 1) * axis.n;
    if (out && n) memcpy(out, value, n * sizeof *out);
}

void fw_plan_array_forces(fw_plan_arrays *to, const fw_plan_bodies *b, size_t rows,
                          const double *reaction_N, const double *joint_N, const double *driver_N) {
    const size_t n = rows ? rows : 1;
    double *out = NULL;
    if (reaction_N)
        out = table(to,
                    (fw_plan_array_name){"force", "N",
                                         "what a revolute joint does to its body b, world axes"},
                    rows, b->pin, 2, fw_plan_xy_labels);
    if (out && b->pin.n) memcpy(out, reaction_N, n * b->pin.n * 2 * sizeof *out);
    out = NULL;
    if (joint_N)
        out = table(to,
                    (fw_plan_array_name){"joint_force", "N,N,N m",
                                         "what another joint does to its body b, world axes, and "
                                         "the torque about its point b"},
                    rows, b->joint, 3, load_labels);
    if (out && b->joint.n) memcpy(out, joint_N, n * b->joint.n * 3 * sizeof *out);
    fw_plan_array_copy(to,
                       (fw_plan_array_name){"driver_force", "*",
                                            "force or torque of a driver along what it drives"},
                       rows, b->driver, driver_N);
    const char **unit = fw_plan_array_text(
        to, (fw_plan_array_name){"driver_force_unit", "", "unit of driver_force"}, b->driver);
    for (size_t i = 0; unit && i < b->driver.n; i++)
        unit[i] = b->mechanism->driver[i].revolute != FW_NONE ? "N m" : "N";
}
