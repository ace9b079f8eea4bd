/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"
#include <math.h>

static double value(const fw_probe *p, const fw_probe_state *s) {
    if (!s->v && !s->still) return (double)NAN;
    const fw_geometry_vec2 v = fw_probe_speed(p, 0, s);
    return fw_probe_along(p, v.x, v.y);
}

const fw_probe_row fw_probe_velocity = {.value = value};
