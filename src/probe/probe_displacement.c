/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"
#include <math.h>

static fw_geometry_vec2 displacement(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 now = fw_probe_place(p, 0, s);
    return (fw_geometry_vec2){now.x - p->drawn[0].x, now.y - p->drawn[0].y};
}

static double value(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 u = displacement(p, s);
    return fw_probe_along(p, u.x, u.y);
}

/* a quarter turn to the left of its direction; without a direction there is no across */
static double across(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 u = displacement(p, s);
    double direction = p->asked->direction_rad;
    return u.y * cos(direction) - u.x * sin(direction);
}

const fw_probe_row fw_probe_displacement = {.value = value, .across = across};
