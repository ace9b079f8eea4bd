/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free strains that act from the start on: temperature without a law, stress of the layer. */
#include "effects/effects.h"
#include <float.h>
#include <string.h>

/* arrays of these loads alone: whoever else holds the same loads keeps theirs as they were */
static void *copied(fw_arena *arena, const void *from, int count, size_t size) {
    void *to = fw_arena_alloc(arena, (size_t)count, size);
    if (to && count > 0) memcpy(to, from, (size_t)count * size);
    return to;
}

static fw_status own_arrays(fw_arena *arena, fw_effects_loads *t) {
    FW_NEED(t->load = copied(arena, t->load, t->nload, sizeof *t->load));
    FW_NEED(t->timed = copied(arena, t->timed, t->ntimed, sizeof *t->timed));
    FW_NEED(t->spring = copied(arena, t->spring, t->nspring, sizeof *t->spring));
    FW_NEED(t->element = copied(arena, t->element, t->nelement, sizeof *t->element));
    for (int i = 0; i < t->nelement; i++) {
        fw_effects_force_element *e = &t->element[i];
        FW_NEED(e->port = copied(arena, e->port, e->ports, sizeof *e->port));
    }
    return FW_OK;
}

static void strain_ports(const fw_effects_loads *loads, fw_geometry_vec2 centre,
                         fw_effects_force_element *e) {
    for (int i = 0; i < e->ports; i++)
        fw_mechanism_strain_point(loads->strain, loads->nbody, centre, e->port[i].body,
                                  &e->port[i].x_m, &e->port[i].y_m);
}

/* Inputs: loads->strain, dimensionless. Every point of the loads moves with the material
   that it lies on, as the joints do in fw_mechanism_strained. Cost O(loads). Test: test_thermal.c.
 */
fw_status fw_effects_strain(fw_arena *arena, const fw_mechanism *mechanism, fw_effects_loads *loads,
                            const fw_mechanism **strained) {
    *strained = mechanism;
    if (!loads->strained) return FW_OK;
    fw_geometry_vec2 centre = fw_mechanism_ground_centre(mechanism);
    const double *e = loads->strain;
    const int n = loads->nbody;
    FW_TRY(own_arrays(arena, loads));
    for (int i = 0; i < loads->nload; i++) {
        fw_effects_point_load *l = &loads->load[i];
        fw_mechanism_strain_point(e, n, centre, l->body, &l->x_m, &l->y_m);
    }
    for (int i = 0; i < loads->ntimed; i++) {
        fw_effects_timed_load *l = &loads->timed[i];
        fw_mechanism_strain_point(e, n, centre, l->body, &l->x_m, &l->y_m);
    }
    for (int i = 0; i < loads->nspring; i++) {
        fw_device_spring *s = &loads->spring[i];
        fw_mechanism_strain_point(e, n, centre, s->body_a, &s->ax_m, &s->ay_m);
        fw_mechanism_strain_point(e, n, centre, s->body_b, &s->bx_m, &s->by_m);
    }
    for (int i = 0; i < loads->nelement; i++)
        strain_ports(loads, centre, &loads->element[i]);
    return fw_mechanism_strained(arena, mechanism, e, strained);
}

fw_status fw_effects_at_start(fw_arena *arena, const fw_mechanism *mechanism,
                              const fw_effects_loads *loads, const fw_mechanism **start) {
    double law[3], *strain;
    *start = mechanism;
    if (!loads->stretch.law) return FW_OK;
    fw_quantity_law_value(loads->stretch.law, 0, DBL_MIN, law); /* the piece that begins at 0 */
    if (law[0] == 0) return FW_OK;
    FW_NEED(strain = fw_arena_array(arena, double, (size_t)mechanism->nbody + 1));
    strain[mechanism->nbody] = loads->stretch.strain * law[0];
    return fw_mechanism_strained(arena, mechanism, strain, start);
}
