/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->ninitial; i++) {
        const fw_device_initial *v = &c->scene->initial[i];
        if (v->vx_m_per_s != 0 || v->vy_m_per_s != 0 || v->omega_rad_per_s != 0) return true;
    }
    return false;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    (void)c;
    *value = (double)INFINITY;
    *reason = "the scene starts with velocities: they are the motion itself";
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->scene->ninitial; i++) {
        const fw_device_initial *v = &c->scene->initial[i];
        if (v->body == FW_GROUND) continue;
        loads->velocity[3 * v->body] += v->vx_m_per_s;
        loads->velocity[3 * v->body + 1] += v->vy_m_per_s;
        loads->velocity[3 * v->body + 2] += v->omega_rad_per_s;
    }
    return FW_OK;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    if (s->ninitial) fw_effects_say(to, "; bodies start with a velocity");
}

const fw_effect_row fw_effect_initial_velocity = {.id = "initial-velocity",
                                                  .summary = "velocities at the start",
                                                  .called_for = called_for,
                                                  .bound = bound,
                                                  .by_rate = true,
                                                  .add = add,
                                                  .kept = true,
                                                  .describe = describe,
                                                  .solid = FW_EFFECTS_SOLID_NO_PART};
