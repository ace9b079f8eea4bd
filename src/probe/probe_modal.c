/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliance of a point along a direction, from the small motions about a pose: shapes u_i of all
   degrees of freedom are orthogonal in mass and stiffness, M_i = u_i M u_i, K_i = M_i w_i^2, so that

     C = d . K^-1 d = sum_i (u_i . d)^2 / (M_i w_i^2),     stiffness 1/C

   over the motions that the joints allow. In: modes in SI; out: m/N. Exact but for round-off (1e-9
   with stiff axes beside soft ones). Infinite where a free motion moves the point, NaN where the
   pose is unstable. Cost: one term a mode. Source: Meirovitch, Fundamentals of Vibrations, 7.
   Test: test_probe.py, against a cantilever's end. */
#include "probe/probe.h"
#include <math.h>

double fw_probe_mode_along(const fw_probe *p, const fw_statics_modes *modes, int mode) {
    const fw_effects_port *at = &p->point[0];
    if (at->body == FW_GROUND) return 0;
    const double *u = modes->mode[mode].shape + 3 * at->body;
    double phi = modes->q[3 * at->body + 2], c = cos(phi), s = sin(phi);
    double rx = c * at->x_m - s * at->y_m, ry = s * at->x_m + c * at->y_m;
    return fw_probe_along(p, u[0] - u[2] * ry, u[1] + u[2] * rx);
}

static double compliance(const fw_probe *p, const fw_statics_modes *modes) {
    double sum = 0;
    for (int i = 0; i < modes->count; i++) {
        const fw_statics_mode *m = &modes->mode[i];
        double u = fw_probe_mode_along(p, modes, i);
        if (u == 0) continue;
        if (m->kind == FW_MODE_UNSTABLE) return (double)NAN;
        sum += m->kind == FW_MODE_FREE ? (double)INFINITY
                                       : u * u / (m->modal_mass_kg_m2 * m->stiffness_per_s2);
    }
    return sum;
}

static double stiffness(const fw_probe *p, const fw_statics_modes *modes) {
    return 1 / compliance(p, modes);
}

/* as `modes` counts them */
static double frequency(const fw_probe *p, const fw_statics_modes *modes) {
    int n = p->asked->mode;
    return n >= 1 && n <= modes->count ? modes->mode[n - 1].f_Hz : (double)NAN;
}

const fw_probe_row fw_probe_stiffness = {.small = stiffness};
const fw_probe_row fw_probe_compliance = {.small = compliance};
const fw_probe_row fw_probe_frequency = {.small = frequency};

double fw_probe_small(const fw_probe *p, const fw_statics_modes *modes) {
    return p->row->small ? p->row->small(p, modes) : (double)NAN;
}

double fw_probe_small_error(const fw_probe *p, const fw_statics_modes *modes) {
    double error = modes->frequency_error;
    if (isnan(error)) return (double)INFINITY;
    return p->kind->takes == FW_PROBE_MODE ? error : 2 * error;
}
