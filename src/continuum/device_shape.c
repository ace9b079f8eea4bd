/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the mechanism as the engine has it to solids. */
#include "continuum/device_deck.h"
#include "effects/effects.h"
#include "mechanism/mechanism.h"
#include <math.h>

static fw_status refused(fw_diags *diags, fw_place place, const char *why) {
    fw_diag_error(diags, 213, place,
                  "the mechanism cannot be written as solid flexures and rigid bodies: %s", why);
    return FW_GEOMETRY;
}

/* whatever the scene calls for is either in the solids, or has no part in them, or is refused by
 * name */
static fw_status effects_fit(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                             fw_diags *diags) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    const fw_effect_case asked = {.arena = arena, .mechanism = m, .scene = s};
    for (size_t i = 0; i < count; i++) {
        if (row[i]->solid != FW_EFFECTS_SOLID_REFUSED || !row[i]->called_for(&asked)) continue;
        const char *why = fw_arena_printf(arena, "the scene has %s (%s), which solids do not have",
                                          row[i]->id, row[i]->summary);
        FW_NEED(why);
        return refused(diags, s->place, why);
    }
    return FW_OK;
}

static fw_status representable(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                               fw_diags *diags) {
    const fw_place none = {0};
    if (m->nhinge < 1) return refused(diags, none, "it has no flexure");
    if (m->nhinge != m->npin) return refused(diags, none, "some of its joints are no flexures");
    if (m->njoint > 0 || m->ndriver > 0 || m->nspring > 0)
        return refused(diags, none, "it has sliders, rods, welds, drivers or springs");
    for (int p = 0; p < m->npin; p++)
        if (m->pin[p].free_angle_rad != 0.0)
            return refused(diags, none, "a joint is strained in the drawn pose (free angle)");
    for (int h = 0; h < m->nhinge; h++)
        if (fw_flexure_input_varies(&m->hinge[h].input))
            return refused(diags, m->device->flexure[m->hinge[h].flexure].place,
                           "a flexure is a path, or its width varies");
    return s ? effects_fit(arena, m, s, diags) : FW_OK;
}

static void hinge_of(const fw_mechanism *m, int h, fw_continuum_solid_hinge *to) {
    const fw_mechanism_hinge *hinge = &m->hinge[h];
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    fw_continuum_shape_of(&hinge->input, &to->shape);
    /* W of the closed form lies at the pin, as in the layout */
    double W = to->shape.centre_x_m, c = cos(hinge->axis_rad), s = sin(hinge->axis_rad);
    fw_geometry_vec2 at = fw_mechanism_pin_place(m, pin, 0);
    to->id = pin->id;
    to->pose = (fw_geometry_pose){at.x - W * c, at.y - W * s, hinge->axis_rad};
    to->first = hinge->first_is_a ? pin->body_a : pin->body_b;
    to->second = hinge->first_is_a ? pin->body_b : pin->body_a;
}

static double factor_at_end(const fw_quantity_law *law, double duration_s) {
    double value[3] = {1.0, 0.0, 0.0};
    if (law) fw_quantity_law_value(law, duration_s, duration_s, value);
    return value[0];
}

fw_status fw_continuum_solid_device_of(fw_arena *arena, const fw_mechanism *m,
                                       const fw_device_scene *scene, fw_diags *diags,
                                       fw_continuum_solid_device *device) {
    const fw_device_material *material = &m->variant->material;
    FW_TRY(representable(arena, m, scene, diags));
    *device = (fw_continuum_solid_device){
        .nhinge = m->nhinge,
        .nbody = m->nbody,
        .material = {.youngs_Pa = material->youngs.value, .poisson = material->poisson.value}};
    int nforce = scene ? scene->nforce : 0;
    FW_NEED(device->hinge = fw_arena_array(arena, fw_continuum_solid_hinge, (size_t)m->nhinge));
    FW_NEED(device->body = fw_arena_array(arena, fw_continuum_solid_body, (size_t)m->nbody));
    FW_NEED(device->force = fw_arena_array(arena, fw_continuum_solid_force, (size_t)nforce));
    for (int h = 0; h < m->nhinge; h++)
        hinge_of(m, h, &device->hinge[h]);
    for (int b = 0; b < m->nbody; b++)
        device->body[b] = (fw_continuum_solid_body){
            .id = m->body[b].id, .x_m = m->body[b].x_m, .y_m = m->body[b].y_m};
    for (int i = 0; i < nforce; i++) {
        const fw_device_force *f = &scene->force[i];
        if (f->body < 0) continue;
        fw_geometry_vec2 at = fw_mechanism_local_place(m, f->body, f->x_m, f->y_m);
        double share = factor_at_end(f->law, scene->duration_s);
        device->force[device->nforce++] =
            (fw_continuum_solid_force){f->body, at.x, at.y, share * f->fx_N, share * f->fy_N};
    }
    for (int i = 0; scene && i < scene->ntorque; i++) {
        const fw_device_torque *t = &scene->torque[i];
        if (t->body < 0) continue;
        device->body[t->body].moment_Nm += factor_at_end(t->law, scene->duration_s) * t->value_Nm;
    }
    return FW_OK;
}
