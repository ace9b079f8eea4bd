/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mechanical power that an actuator feeds into the bodies: of a driver its force times the rate of
   its coordinate; of a tendon or comb drive the sum of f . w over its ports, without what the cable
   stores and what the source loses. W. Test: test_probe.py, against kinetic and elastic energy. */
#include "probe/probe.h"
#include <math.h>

static double turning(const fw_probe_state *s, int body) {
    return body == FW_GROUND ? 0 : s->v[3 * body + 2];
}

static double of_driver(const fw_probe *p, const fw_probe_state *s) {
    const fw_mechanism *m = p->mechanism;
    const fw_device_driver *d = &m->driver[p->asked->index];
    if (!s->driver_N || !s->v) return s->still ? 0 : (double)NAN;
    double force = s->driver_N[p->asked->index];
    if (d->revolute != FW_NONE) {
        const fw_mechanism_pin *pin = &m->pin[d->revolute];
        return force * (turning(s, pin->body_b) - turning(s, pin->body_a));
    }
    const fw_device_joint *j = &m->joint[d->joint];
    fw_probe at = *p;
    at.point[0] = (fw_effects_port){j->body_a, j->ax_m, j->ay_m};
    at.point[1] = (fw_effects_port){j->body_b, j->bx_m, j->by_m};
    const fw_geometry_vec2 a = fw_probe_place(&at, 0, s), b = fw_probe_place(&at, 1, s);
    const fw_geometry_vec2 va = fw_probe_speed(&at, 0, s), vb = fw_probe_speed(&at, 1, s);
    double dx = b.x - a.x, dy = b.y - a.y, wx = vb.x - va.x, wy = vb.y - va.y;
    if (j->kind == FW_JOINT_DISTANCE) return force * (dx * wx + dy * wy) / hypot(dx, dy);
    double axis = j->axis_rad + (j->body_a == FW_GROUND ? 0 : s->q[3 * j->body_a + 2]);
    double spin = turning(s, j->body_a), ex = cos(axis), ey = sin(axis);
    return force * (ex * wx + ey * wy + spin * (ex * dy - ey * dx));
}

static double value(const fw_probe *p, const fw_probe_state *s) {
    fw_effects_port_state seen;
    if (p->asked->carrier == FW_CARRIER_DRIVER) return of_driver(p, s);
    if (!fw_probe_element_forces(p, s, &seen)) return 0;
    double sum = 0;
    for (int i = 0; i < 3 * p->element->ports; i++)
        sum += p->f[i] * p->w[i];
    return sum;
}

const fw_probe_row fw_probe_power = {.value = value};
