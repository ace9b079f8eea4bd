/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"
#include <math.h>

static double value(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 a = fw_probe_place(p, 0, s), b = fw_probe_place(p, 1, s);
    return hypot(b.x - a.x, b.y - a.y);
}

const fw_probe_row fw_probe_distance = {.value = value};
