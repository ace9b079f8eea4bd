/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"
#include <math.h>

/* in the frame of a, so that jaws that turn together keep their opening */
static double value(const fw_probe *p, const fw_probe_state *s) {
    const fw_geometry_vec2 a = fw_probe_place(p, 0, s), b = fw_probe_place(p, 1, s);
    int body = p->asked->body;
    double direction = p->asked->direction_rad + (body == FW_GROUND ? 0 : s->q[3 * body + 2]);
    return (b.x - a.x) * cos(direction) + (b.y - a.y) * sin(direction);
}

const fw_probe_row fw_probe_opening = {.value = value};
