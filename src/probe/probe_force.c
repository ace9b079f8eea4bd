/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces in what carries them. A joint: what it exerts on its body b; a distance and springs: the
   tension T = k (l - l0) + c l', of a cable where that is above 0; a tendon: its tension, which is
   the force on its first eyelet; a comb drive: on its rotor, along the drive; a contact: the force
   that presses its surfaces. In: a state in SI; out: N. Error: that of the state. Test:
   test_probe.py. */
#include "probe/probe.h"
#include <math.h>

static fw_geometry_vec2 place(const fw_probe *p, const fw_probe_state *s, int body, double x,
                              double y, fw_geometry_vec2 *speed) {
    fw_probe at = *p;
    at.point[0] = (fw_effects_port){body, x, y};
    *speed = fw_probe_speed(&at, 0, s);
    return fw_probe_place(&at, 0, s);
}

/* length, its unit vector from a to b, and rate */
static double line(const fw_probe *p, const fw_probe_state *s, int a, double ax, double ay, int b,
                   double bx, double by, double unit[2], double *rate) {
    fw_geometry_vec2 va, vb, from = place(p, s, a, ax, ay, &va), to = place(p, s, b, bx, by, &vb);
    double dx = to.x - from.x, dy = to.y - from.y, length = hypot(dx, dy);
    unit[0] = length > 0 ? dx / length : 1, unit[1] = length > 0 ? dy / length : 0;
    *rate = unit[0] * (vb.x - va.x) + unit[1] * (vb.y - va.y);
    return length;
}

static double of_spring(const fw_probe *p, const fw_probe_state *s) {
    double unit[2], rate;
    if (p->spring == FW_NONE) return 0;
    const fw_device_spring *k = &p->loads.spring[p->spring];
    double length =
        line(p, s, k->body_a, k->ax_m, k->ay_m, k->body_b, k->bx_m, k->by_m, unit, &rate);
    double stretch = length - k->length_m;
    double tension = k->stiffness_N_per_m * stretch + k->damping_Ns_per_m * rate;
    return k->cable ? (stretch > 0 ? fmax(0, tension) : 0) : tension;
}

static double of_joint(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_joint *j = &p->mechanism->joint[p->asked->index];
    if (!s->joint_N) return (double)NAN;
    const double *f = s->joint_N + 3 * p->asked->index;
    double unit[2], rate;
    if (j->kind != FW_JOINT_DISTANCE || !isnan(p->asked->direction_rad))
        return fw_probe_along(p, f[0], f[1]);
    line(p, s, j->body_a, j->ax_m, j->ay_m, j->body_b, j->bx_m, j->by_m, unit, &rate);
    return -(f[0] * unit[0] + f[1] * unit[1]); /* it pulls b towards a */
}

static double of_comb(const fw_probe *p, const fw_probe_state *s) {
    fw_effects_port_state seen;
    if (!fw_probe_element_forces(p, s, &seen)) return 0;
    const double *f = p->f + 3; /* port 0: the stator, 1: the rotor */
    if (!isnan(p->asked->direction_rad)) return fw_probe_along(p, f[0], f[1]);
    const fw_effects_comb_element *c = fw_effects_comb_of(p->element);
    double direction = (c ? c->direction_rad : 0) + p->p[2];
    return f[0] * cos(direction) + f[1] * sin(direction);
}

static double value(const fw_probe *p, const fw_probe_state *s) {
    const fw_device_probe *a = p->asked;
    fw_effects_port_state seen;
    switch (a->carrier) {
    case FW_CARRIER_REVOLUTE:
        return s->reaction_N
                   ? fw_probe_along(p, s->reaction_N[2 * a->index], s->reaction_N[2 * a->index + 1])
                   : (double)NAN;
    case FW_CARRIER_JOINT:
        return of_joint(p, s);
    case FW_CARRIER_DRIVER:
        return s->driver_N ? s->driver_N[a->index] : (double)NAN;
    case FW_CARRIER_SPRING:
        return of_spring(p, s);
    case FW_CARRIER_TENDON:
        return fw_probe_element_forces(p, s, &seen) ? hypot(p->f[0], p->f[1]) : 0;
    case FW_CARRIER_COMB:
        return of_comb(p, s);
    case FW_CARRIER_CONTACT:
        break;
    }
    if (!fw_probe_element_forces(p, s, &seen)) return 0;
    return p->element->class_->pressing(p->element, &seen);
}

const fw_probe_row fw_probe_force = {.value = value};
