/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report.h"
#include <math.h>
#include <string.h>

/* RFC 4180: quoted only where a name needs it */
static void name(fw_text *out, const char *id, const char *suffix) {
    bool quote = strpbrk(id, ",\"\r\n") != NULL;
    fw_text_add(out, quote ? ",\"" : ",");
    for (; *id; id++) {
        if (*id == '"') fw_text_add(out, "\"");
        fw_text_bytes(out, id, 1);
    }
    fw_text_add(out, suffix);
    if (quote) fw_text_add(out, "\"");
}

static void cell(fw_text *out, double value) {
    if (isfinite(value)) fw_text_number(out, value, 17);
}

fw_status fw_report_motion_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               fw_text *out) {
    static const char *const suffix[] = {".x_m",        ".y_m",        ".phi_rad",
                                         ".vx_m_per_s", ".vy_m_per_s", ".omega_rad_per_s"};
    fw_text_add(out, "t_s");
    for (int b = 0; b < motion->nbody; b++)
        for (int k = 0; k < 6; k++)
            name(out, mechanism->body[b].id, suffix[k]);
    fw_text_add(out, "\n");
    size_t wide = 3 * (size_t)motion->nbody;
    for (int i = 0; i < motion->nsample && !out->failed; i++) {
        cell(out, motion->t_s[i]);
        for (int b = 0; b < motion->nbody; b++)
            for (int k = 0; k < 6; k++) {
                const double *from = k < 3 ? motion->q : motion->v;
                fw_text_add(out, ",");
                cell(out, from[(size_t)i * wide + 3 * (size_t)b + (size_t)(k % 3)]);
            }
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}

/* accelerations of all bodies, forces of all joints and drivers */
fw_status fw_report_forces_csv(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                               fw_text *out) {
    static const char *const of_body[] = {".ax_m_per_s2", ".ay_m_per_s2", ".alpha_rad_per_s2"};
    static const char *const of_joint[] = {".fx_N", ".fy_N", ".torque_Nm"};
    fw_text_add(out, "t_s");
    for (int i = 0; i < 3 * motion->nbody; i++)
        name(out, mechanism->body[i / 3].id, of_body[i % 3]);
    for (int i = 0; i < 2 * motion->npin; i++)
        name(out, mechanism->pin[i / 2].id, of_joint[i % 2]);
    for (int i = 0; i < 3 * motion->njoint; i++)
        name(out, mechanism->joint[i / 3].id, of_joint[i % 3]);
    for (int i = 0; i < motion->ndriver; i++) {
        const fw_device_driver *d = &mechanism->driver[i];
        name(out, d->id, d->revolute != FW_NONE ? ".drive_Nm" : ".drive_N");
    }
    fw_text_add(out, "\n");
    const struct {
        const double *value;
        int wide;
    } part[] = {{motion->accel, 3 * motion->nbody},
                {motion->reaction_N, 2 * motion->npin},
                {motion->joint_N, 3 * motion->njoint},
                {motion->driver_N, motion->ndriver}};
    for (int i = 0; i < motion->nsample && !out->failed; i++) {
        cell(out, motion->t_s[i]);
        for (size_t k = 0; k < sizeof part / sizeof part[0]; k++)
            for (int c = 0; c < part[k].wide; c++) {
                fw_text_add(out, ",");
                cell(out, part[k].value[(size_t)i * (size_t)part[k].wide + (size_t)c]);
            }
        fw_text_add(out, "\n");
    }
    return fw_text_end(out);
}
