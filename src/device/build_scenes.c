/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <scene>: loads and initial velocities. */
#include "device/reader.h"

static int count_children(const fw_reader *r, int scene, const char *element) {
    int count = 0;
    for (int i = scene + 1; i < r->nrecord && r->record[i].parent >= scene; i++)
        count += fw_is(&r->record[i], element);
    return count;
}

static fw_force force_of(fw_reader *r, const fw_record *record) {
    return (fw_force){.body = fw_reference(r, record, "on"),
                      .x_m = fw_number_or(record, "x", 0.0),
                      .y_m = fw_number_or(record, "y", 0.0),
                      .fx_N = fw_number_or(record, "fx", 0.0),
                      .fy_N = fw_number_or(record, "fy", 0.0),
                      .place = record->element->place};
}

static void add_initial(fw_reader *r, fw_scene *s, const fw_record *record) {
    fw_initial v = {.body = fw_reference(r, record, "body"),
                    .vx_m_per_s = fw_number_or(record, "vx", 0.0),
                    .vy_m_per_s = fw_number_or(record, "vy", 0.0),
                    .omega_rad_per_s = fw_number_or(record, "omega", 0.0),
                    .place = record->element->place};
    for (int i = 0; i < s->ninitial && v.body >= 0; i++)
        if (s->initial[i].body == v.body) {
            fw_diag_error(
                r->diags, 45, fw_place_of(record, "body"),
                "body '%s' has two <initial> in this scene (first at line %d); remove one",
                fw_text_of(record, "body"), s->initial[i].place.line);
            break;
        }
    s->initial[s->ninitial++] = v;
}

static void add_child(fw_reader *r, fw_scene *s, const fw_record *record) {
    if (fw_is(record, "force"))
        s->force[s->nforce++] = force_of(r, record);
    else if (fw_is(record, "torque"))
        s->torque[s->ntorque++] = (fw_torque){.body = fw_reference(r, record, "on"),
                                              .value_Nm = fw_number_of(record, "value"),
                                              .place = record->element->place};
    else if (fw_is(record, "gravity")) {
        s->gravity = true;
        s->gx_m_per_s2 = fw_number_or(record, "gx", 0.0);
        s->gy_m_per_s2 = fw_number_or(record, "gy", 0.0);
    } else if (fw_is(record, "initial"))
        add_initial(r, s, record);
}

static fw_status build_scene(fw_reader *r, int at, fw_scene *s) {
    const fw_record *record = &r->record[at];
    *s = (fw_scene){.name = fw_text_of(record, "name"),
                    .duration_s = fw_number_of(record, "duration"),
                    .place = record->element->place};
    if (fw_reference(r, record, "flow") >= 0) s->flow = fw_text_of(record, "flow");
    size_t forces = (size_t)count_children(r, at, "force");
    size_t torques = (size_t)count_children(r, at, "torque");
    size_t initials = (size_t)count_children(r, at, "initial");
    FW_NEED(s->force = fw_arena_array(r->arena, fw_force, forces));
    FW_NEED(s->torque = fw_arena_array(r->arena, fw_torque, torques));
    FW_NEED(s->initial = fw_arena_array(r->arena, fw_initial, initials));
    for (int i = at + 1; i < r->nrecord && r->record[i].parent >= at; i++)
        add_child(r, s, &r->record[i]);
    return FW_OK;
}

fw_status fw_build_scenes(fw_reader *r) {
    fw_device *d = r->device;
    FW_NEED(d->scene = fw_arena_array(r->arena, fw_scene, (size_t)fw_count(r, "scene")));
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "scene")) FW_TRY(build_scene(r, i, &d->scene[d->nscene++]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
