/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Torques: of a revolute on its body b what its flexure exerts there, as a force element or as the
   spring and damper -k angle - c rate; of prismatic joints and welds about their point b; of drivers
   that turn. Stops and friction are not counted. N m. Test: test_probe.py. */
#include "probe/probe.h"
#include <math.h>

static double turning(const fw_probe_state *s, int body) {
    return s->v && body != FW_GROUND ? s->v[3 * body + 2] : 0;
}

static double of_revolute(const fw_probe *p, const fw_probe_state *s) {
    fw_effects_port_state seen;
    int pin = p->asked->index;
    if (fw_probe_element_forces(p, s, &seen)) return p->f[3 * p->element->ports - 1];
    int k = p->loads.torsion_of ? p->loads.torsion_of[pin] : 0;
    if (k == 0) return 0;
    const fw_effects_torsion *t = &p->loads.torsion[k - 1];
    double rate = turning(s, t->body_b) - turning(s, t->body_a);
    return -t->stiffness_Nm_per_rad * s->angle_rad[pin] - t->damping_Nms_per_rad * rate;
}

static double value(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_probe *a = p->asked;
    switch (a->carrier) {
    case FW_CARRIER_REVOLUTE:
        return of_revolute(p, s);
    case FW_CARRIER_JOINT:
        return s->joint_N ? s->joint_N[3 * a->index + 2] : (double)NAN;
    case FW_CARRIER_DRIVER:
        return s->driver_N ? s->driver_N[a->index] : (double)NAN;
    case FW_CARRIER_SPRING:
    case FW_CARRIER_TENDON:
    case FW_CARRIER_COMB:
    case FW_CARRIER_CONTACT:
        break;
    }
    return 0;
}

const fw_probe_row fw_probe_torque = {.value = value};
