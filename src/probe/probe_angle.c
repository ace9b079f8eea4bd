/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"

static double value(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_probe *a = p->asked;
    if (a->of) return s->angle_rad[a->index];
    return s->q[3 * a->body + 2] - p->mechanism->body[a->body].phi_rad;
}

const fw_probe_row fw_probe_angle = {.value = value};
