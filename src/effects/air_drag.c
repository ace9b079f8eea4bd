/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Open air around a thin body that moves in its own plane: the disc of its size, edgewise and
   turning about its axis, in creeping flow,

     force -(32/3) mu R v,   couple -(32/3) mu R^3 omega,

   R of the disc of equal perimeter for the force, of equal polar moment for the couple; in rare air
   both faces feel mu/(2 path) per area instead, and the two resistances add:

     1/c = 1/(32/3 mu R) + path/(mu A),   1/k = 1/(32/3 mu R^3) + path/(mu I_p).

   Source: Happel and Brenner, Low Reynolds Number Hydrodynamics, 1965, 4-26 and 5-11 (discs); sum
   of resistances: Sherman 1963, within some 10 % between the limits. Bodies that are not round: the
   disc is a stand-in, some 20 % for bars up to 10:1. Valid for Reynolds numbers below 1 and bodies
   smaller than the penetration depth sqrt(2 nu/omega). Test: test_air.c. */
#include "effects/air.h"
#include "base/constants.h"
#include <math.h>

fw_effects_damper fw_effects_air_drag(const fw_effects_gas *gas, const fw_effects_face *face) {
    double mu = gas->viscosity_Pas, radius = face->perimeter_m / (2 * FW_PI);
    double turning = pow(2 * face->polar_m4 / FW_PI, 0.25);
    double force = 32 * mu * radius / 3, couple = 32 * mu * turning * turning * turning / 3;
    return (fw_effects_damper){1 / (1 / force + gas->path_m / (mu * face->area_m2)),
                               1 / (1 / couple + gas->path_m / (mu * face->polar_m4))};
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const fw_effects_damper *d = e->data;
    f[0] = -d->force_Ns_per_m * s->w[0];
    f[1] = -d->force_Ns_per_m * s->w[1];
    f[2] = -d->couple_Nms * s->w[2];
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const fw_effects_damper *d = e->data;
    (void)s;
    for (int i = 0; i < 9; i++)
        stiffness[i] = damping[i] = 0;
    damping[0] = damping[4] = d->force_Ns_per_m;
    damping[8] = d->couple_Nms;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    const fw_effects_damper *d = e->data;
    out[0] = d->force_Ns_per_m * (s->w[0] * s->w[0] + s->w[1] * s->w[1]) +
             d->couple_Nms * s->w[2] * s->w[2];
    out[1] = 0;
}

static const fw_effects_element_class drag_class = {
    .effect = "air", .force = force, .tangent = tangent, .power = power};

fw_status fw_effects_air_drag_add(const fw_effect_case *c, fw_effects_loads *loads,
                                  const fw_device_air *air, int body) {
    fw_effects_damper *data = fw_arena_one(c->arena, fw_effects_damper);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &drag_class, 1);
    FW_NEED(data && e);
    const fw_effects_gas gas = fw_effects_gas_of(air);
    const fw_effects_face face = fw_effects_air_face(c->mechanism, air, body);
    *data = fw_effects_air_drag(&gas, &face);
    e->id = c->mechanism->body[body].id;
    e->place = air->place;
    e->port[0] = (fw_effects_port){body, 0, 0};
    e->dissipates = true;
    e->data = data;
    return FW_OK;
}
