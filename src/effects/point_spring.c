/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->nspring; i++)
        if (c->mechanism->spring[i].stiffness_N_per_m > 0 ||
            c->mechanism->spring[i].damping_Ns_per_m > 0)
            return true;
    return false;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    (void)c;
    *value = (double)INFINITY;
    *reason = "the mechanism has springs between points: they are the motion itself";
    return FW_OK;
}

/* force k (l - l0) + c l' along the line between the two points; a cable only pulls. No mask draws a spring: its l0 does not
   grow with the layer, and where that comes with a law the spring is an element that knows the time */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->mechanism->nspring; i++) {
        const fw_device_spring *s = &c->mechanism->spring[i];
        const fw_effects_foreign of = fw_effects_foreign_of(c, s->expansion_per_K);
        if (!(s->stiffness_N_per_m > 0 || s->damping_Ns_per_m > 0)) continue;
        if (of.law && s->stiffness_N_per_m > 0 && s->length_m > 0) {
            FW_TRY(fw_effects_spring_element(c, loads, s, &of));
            continue;
        }
        loads->spring[loads->nspring] = *s;
        if (!of.law)
            loads->spring[loads->nspring].length_m *= fw_effects_foreign_at(&of, 0, 0, NULL);
        loads->nspring++;
    }
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->nspring; i++)
        n += c->mechanism->spring[i].stiffness_N_per_m > 0 ||
             c->mechanism->spring[i].damping_Ns_per_m > 0;
    return n;
}

const fw_effect_row fw_effect_point_spring = {.id = "point-spring",
                                              .summary =
                                                  "springs, dampers and cables between two points",
                                              .called_for = called_for,
                                              .bound = bound,
                                              .add = add,
                                              .cost = 304,
                                              .count = count,
                                              .kept = true,
                                              .passive = true};
