/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <scene>: loads and initial velocities. */
#include "device/reader.h"

static int count_children(const fw_reader *r, int scene, const char *element) {
    int count = 0;
    for (int i = scene + 1; i < r->nrecord && r->record[i].parent >= scene; i++)
        count += fw_is(&r->record[i], element);
    return count;
}

static fw_status add_force(fw_reader *r, fw_scene *s, const fw_record *record) {
    fw_force f = {.body = fw_reference(r, record, "on"),
                  .x_m = fw_number_or(record, "x", 0.0),
                  .y_m = fw_number_or(record, "y", 0.0),
                  .fx_N = fw_number_or(record, "fx", 0.0),
                  .fy_N = fw_number_or(record, "fy", 0.0),
                  .place = record->element->place};
    FW_TRY(fw_time_law(r, record, &f.law));
    s->force[s->nforce++] = f;
    return FW_OK;
}

static fw_status add_torque(fw_reader *r, fw_scene *s, const fw_record *record) {
    fw_torque t = {.body = fw_reference(r, record, "on"),
                   .value_Nm = fw_number_of(record, "value"),
                   .place = record->element->place};
    FW_TRY(fw_time_law(r, record, &t.law));
    s->torque[s->ntorque++] = t;
    return FW_OK;
}

/* `moved`, per body: 1 + index of its <initial> in this scene, 0: none yet */
static void add_initial(fw_reader *r, fw_scene *s, const fw_record *record, int *moved) {
    fw_initial v = {.body = fw_reference(r, record, "body"),
                    .vx_m_per_s = fw_number_or(record, "vx", 0.0),
                    .vy_m_per_s = fw_number_or(record, "vy", 0.0),
                    .omega_rad_per_s = fw_number_or(record, "omega", 0.0),
                    .moves_free = !fw_given(record, "vx") && !fw_given(record, "vy"),
                    .turns_free = !fw_given(record, "omega"),
                    .place = record->element->place};
    if (v.body >= 0 && moved[v.body])
        fw_diag_error(r->diags, 45, fw_place_of(record, "body"),
                      "body '%s' has two <initial> in this scene (first at line %d); remove one",
                      fw_text_of(record, "body"), s->initial[moved[v.body] - 1].place.line);
    else if (v.body >= 0)
        moved[v.body] = s->ninitial + 1;
    s->initial[s->ninitial++] = v;
}

static fw_status add_child(fw_reader *r, fw_scene *s, const fw_record *record, int *moved) {
    if (fw_is(record, "force")) return add_force(r, s, record);
    if (fw_is(record, "torque")) return add_torque(r, s, record);
    if (fw_is(record, "gravity")) {
        s->gravity = true;
        s->gx_m_per_s2 = fw_number_or(record, "gx", 0.0);
        s->gy_m_per_s2 = fw_number_or(record, "gy", 0.0);
    } else if (fw_is(record, "initial"))
        add_initial(r, s, record, moved);
    return FW_OK;
}

static fw_status build_scene(fw_reader *r, int at, fw_scene *s, int *moved) {
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
        FW_TRY(add_child(r, s, &r->record[i], moved));
    for (int i = 0; i < s->ninitial; i++)
        if (s->initial[i].body >= 0) moved[s->initial[i].body] = 0; /* for the next scene */
    return FW_OK;
}

/* a driver must have a value as long as the longest scene lasts */
static void check_drivers(fw_reader *r) {
    const fw_device *d = r->device;
    double longest_s = 0;
    for (int i = 0; i < d->nscene; i++)
        if (d->scene[i].duration_s > longest_s) longest_s = d->scene[i].duration_s;
    for (int i = 0, k = 0; i < r->nrecord && k < d->ndriver; i++)
        if (fw_is(&r->record[i], "driver")) {
            const fw_law *law = &d->driver[k++].law;
            if (law->program) fw_finite_check(r, &r->record[i], "value", law, longest_s);
        }
}

fw_status fw_build_scenes(fw_reader *r) {
    fw_device *d = r->device;
    int *moved = fw_arena_array(r->arena, int, (size_t)d->nbody);
    FW_NEED(moved);
    FW_NEED(d->scene = fw_arena_array(r->arena, fw_scene, (size_t)fw_count(r, "scene")));
    for (int i = 0; i < r->nrecord; i++)
        if (fw_is(&r->record[i], "scene")) FW_TRY(build_scene(r, i, &d->scene[d->nscene++], moved));
    check_drivers(r);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
