/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hinges of a device whose layout cannot be made: their figures follow from flexures, material
   and thickness, and no mass is asked for. */
#include "mechanism/mechanism.h"
#include <math.h>
#include <string.h>

/* the middle of a body's joints that have a place; the origin where none has */
static fw_geometry_vec2 middle_of(const fw_device *device, int body) {
    fw_geometry_vec2 sum = {0, 0};
    int n = 0;
    for (int j = 0; j < device->nrevolute; j++) {
        const fw_device_revolute *r = &device->revolute[j];
        if ((r->body_a != body && r->body_b != body) || !isfinite(r->x_m + r->y_m)) continue;
        sum.x += r->x_m, sum.y += r->y_m, n++;
    }
    return n > 0 ? (fw_geometry_vec2){sum.x / n, sum.y / n} : sum;
}

/* a mass, and a place, that nothing states and nothing of the hinge depends on */
static void stand_in(const fw_device *device, int i, fw_device_body *body) {
    const fw_geometry_vec2 at = middle_of(device, i);
    if (isnan(body->mass_kg)) body->mass_kg = 1;
    if (isnan(body->inertia_kg_m2)) body->inertia_kg_m2 = 1;
    if (isnan(body->x_m)) body->x_m = at.x;
    if (isnan(body->y_m)) body->y_m = at.y;
}

fw_status fw_mechanism_build_hinges(fw_arena *arena, const fw_device *device,
                                    const fw_layout *shown, const fw_mechanism_variant *variant,
                                    fw_diags *diags, const fw_mechanism **mechanism) {
    fw_device *with = fw_arena_one(arena, fw_device);
    fw_layout *layout = fw_arena_one(arena, fw_layout);
    fw_device_body *body = fw_arena_array(arena, fw_device_body, (size_t)device->nbody);
    FW_NEED(with && layout ? body : NULL);
    *with = *device;
    *layout = *shown;
    layout->drawn = true; /* what is not has neither an area nor a hinge */
    if (device->nbody > 0) memcpy(body, device->body, (size_t)device->nbody * sizeof *body);
    with->body = body;
    for (int i = 0; i < device->nbody; i++)
        if (!(layout->body[i].area_m2 > 0)) stand_in(device, i, &body[i]);
    return fw_mechanism_build(arena, with, layout, variant, diags, mechanism);
}
