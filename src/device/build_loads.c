/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <force>, <torque>, <gravity>, <initial>. */
#include "device/scene_parts.h"

/* 0 may be stated, for example by a parameter that a study changes; nothing at all is a slip */
static void needs_size(fw_scene_reader *s, const fw_record *record, const char *element,
                       const char *x, const char *y, const char *example) {
    if (fw_given(record, x) || fw_given(record, y)) return;
    fw_diag_error(s->r->diags, 93, record->element->place,
                  "<%s> has no magnitude and therefore no effect; give %s or %s, for example "
                  "%s, or remove it",
                  element, x, y, example);
}

fw_status fw_build_force(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_force f = {.body = fw_reference(s->r, record, "on"),
                  .x_m = fw_number_or(record, "x", 0.0),
                  .y_m = fw_number_or(record, "y", 0.0),
                  .fx_N = fw_number_or(record, "fx", 0.0),
                  .fy_N = fw_number_or(record, "fy", 0.0),
                  .place = record->element->place};
    needs_size(s, record, "force", "fx", "fy", "fx=\"20 uN\"");
    FW_TRY(fw_time_law(s->r, record, &f.law));
    s->scene->force[s->scene->nforce++] = f;
    return FW_OK;
}

fw_status fw_build_torque(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_torque t = {.body = fw_reference(s->r, record, "on"),
                   .value_Nm = fw_number_of(record, "value"),
                   .place = record->element->place};
    FW_TRY(fw_time_law(s->r, record, &t.law));
    s->scene->torque[s->scene->ntorque++] = t;
    return FW_OK;
}

fw_status fw_build_gravity(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    needs_size(s, record, "gravity", "gx", "gy", "gy=\"-9.81 m/s^2\"");
    s->scene->gravity = true;
    s->scene->gx_m_per_s2 = fw_number_or(record, "gx", 0.0);
    s->scene->gy_m_per_s2 = fw_number_or(record, "gy", 0.0);
    return FW_OK;
}

fw_status fw_build_initial(fw_scene_reader *s, int at) {
    const fw_record *record = &s->r->record[at];
    fw_scene *scene = s->scene;
    fw_initial v = {.body = fw_reference(s->r, record, "body"),
                    .vx_m_per_s = fw_number_or(record, "vx", 0.0),
                    .vy_m_per_s = fw_number_or(record, "vy", 0.0),
                    .omega_rad_per_s = fw_number_or(record, "omega", 0.0),
                    .moves_free = !fw_given(record, "vx") && !fw_given(record, "vy"),
                    .turns_free = !fw_given(record, "omega"),
                    .place = record->element->place};
    if (v.body >= 0 && s->moved[v.body])
        fw_diag_error(s->r->diags, 45, fw_place_of(record, "body"),
                      "body '%s' has two <initial> in this scene (first at line %d); remove one",
                      fw_text_of(record, "body"), scene->initial[s->moved[v.body] - 1].place.line);
    else if (v.body >= 0)
        s->moved[v.body] = scene->ninitial + 1;
    scene->initial[scene->ninitial++] = v;
    return FW_OK;
}
