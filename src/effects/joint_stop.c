/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (fw_pin_has_stop(&c->mechanism->pin[i])) return true;
    return false;
}

/* gap to the stop of one side less what the hinge can turn: below 0, it may be reached. Half of the
   largest deflection is left for effects that the envelope does not know */
static double room(const fw_effect_case *c, int i, double side, double at_rad) {
    if (isnan(at_rad)) return (double)INFINITY;
    const fw_mechanism_pin *p = &c->mechanism->pin[i];
    double a = p->body_a == FW_GROUND ? 0 : c->mechanism->body[p->body_a].phi_rad;
    double b = p->body_b == FW_GROUND ? 0 : c->mechanism->body[p->body_b].phi_rad;
    return side * (at_rad - (b - a - p->free_angle_rad)) - c->envelope->angle[i] -
           0.5 * c->envelope->floor;
}

/* A stop that the envelope shows is never reached changes nothing: 0. Elsewhere what it changes is
   everything behind. Angles in rad; conservative for small motions. Cost O(pins). Test:
   test_envelope.c, test_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    *value = (double)INFINITY;
    *reason = "joints have stops: where one is reached it is the motion itself";
    if (!c->envelope->valid) return FW_OK;
    for (int i = 0; i < c->mechanism->npin; i++) {
        const fw_mechanism_pin *p = &c->mechanism->pin[i];
        if (fw_pin_has_stop(p) &&
            !(room(c, i, -1, p->stop_min_rad) > 0 && room(c, i, 1, p->stop_max_rad) > 0))
            return FW_OK;
    }
    *value = 0;
    *reason = "no joint can turn as far as its stops";
    return FW_OK;
}

static void add_side(const fw_mechanism_pin *p, int pin, double side, double at_rad,
                     fw_effects_loads *loads) {
    if (isnan(at_rad)) return;
    loads->stop[loads->nstop++] =
        (fw_effects_stop){.pin = pin,
                          .body_a = p->body_a,
                          .body_b = p->body_b,
                          .side = side,
                          .at_rad = at_rad,
                          .free_angle_rad = p->free_angle_rad,
                          .stiffness_Nm_per_rad = p->stop_stiffness_Nm_per_rad,
                          .damping_Nms_per_rad = p->stop_damping_Nms_per_rad};
}

/* torque -side k side (angle - at) on b while the stop is pressed, the opposite on a */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->mechanism->npin; i++) {
        const fw_mechanism_pin *p = &c->mechanism->pin[i];
        if (!fw_pin_has_stop(p)) continue;
        add_side(p, i, -1, p->stop_min_rad, loads);
        add_side(p, i, 1, p->stop_max_rad, loads);
    }
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->npin; i++) {
        const fw_mechanism_pin *p = &c->mechanism->pin[i];
        if (fw_pin_has_stop(p)) n += !isnan(p->stop_min_rad) + !isnan(p->stop_max_rad);
    }
    return n;
}

/* 5 where it is not reached, 81 where it is pressed */
const fw_effect_row fw_effect_joint_stop = {
    .id = "joint-stop",
    .summary = "springs and dampers at the ends of a joint's range",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 81,
    .count = count,
    .unbounded_stays = true};
