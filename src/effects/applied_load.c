/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->nforce; i++)
        if (c->scene->force[i].fx_N != 0 || c->scene->force[i].fy_N != 0) return true;
    for (int i = 0; i < c->scene->ntorque; i++)
        if (c->scene->torque[i].value_Nm != 0) return true;
    return false;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    (void)c;
    *value = (double)INFINITY;
    *reason = "the scene applies loads: they are the motion itself";
    return FW_OK;
}

static void add_force(const fw_device_force *f, fw_effects_loads *loads) {
    if (f->body == FW_GROUND) return;
    if (!fw_quantity_law_is_constant(f->law))
        loads->timed[loads->ntimed++] =
            (fw_effects_timed_load){f->body, f->x_m, f->y_m, f->fx_N, f->fy_N, 0, f->law};
    else if (f->x_m == 0 && f->y_m == 0) {
        loads->constant[3 * f->body] += f->fx_N;
        loads->constant[3 * f->body + 1] += f->fy_N;
    } else
        loads->load[loads->nload++] =
            (fw_effects_point_load){f->body, f->x_m, f->y_m, f->fx_N, f->fy_N};
}

/* what a law changes with time goes to `timed`; of the rest, forces at the centre of mass and
   torques are constants, and a force elsewhere turns its arm */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->scene->nforce; i++)
        add_force(&c->scene->force[i], loads);
    for (int i = 0; i < c->scene->ntorque; i++) {
        const fw_device_torque *t = &c->scene->torque[i];
        if (t->body == FW_GROUND) continue;
        if (fw_quantity_law_is_constant(t->law))
            loads->constant[3 * t->body + 2] += t->value_Nm;
        else
            loads->timed[loads->ntimed++] =
                (fw_effects_timed_load){.body = t->body, .torque_Nm = t->value_Nm, .law = t->law};
    }
    return FW_OK;
}

/* loads off the centre of mass turn their arm; a law takes nine times as much; the rest is added
 * once
 */
static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->scene->nforce; i++) {
        const fw_device_force *f = &c->scene->force[i];
        if (f->body != FW_GROUND)
            n += !fw_quantity_law_is_constant(f->law) ? 9 : f->x_m != 0 || f->y_m != 0;
    }
    for (int i = 0; i < c->scene->ntorque; i++)
        if (c->scene->torque[i].body != FW_GROUND)
            n += fw_quantity_law_is_constant(c->scene->torque[i].law) ? 0 : 9;
    return n;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    for (int i = 0; i < s->nforce; i++) {
        fw_effects_say(to, "; force on {s} ({u}, {u})", device->body[s->force[i].body].id,
                       s->force[i].fx_N, "N", s->force[i].fy_N, "N");
        fw_effects_say_law(to, s->force[i].law);
    }
    for (int i = 0; i < s->ntorque; i++) {
        fw_effects_say(to, "; torque on {s} {u}", device->body[s->torque[i].body].id,
                       s->torque[i].value_Nm, "N\u00b7m");
        fw_effects_say_law(to, s->torque[i].law);
    }
}

static void loads(const fw_device_scene *s, fw_effects_load_scaling *list) {
    if (s->nforce > 0)
        fw_effects_add_load(list, (fw_effects_load){.name = "forces", .ordinary = true});
    if (s->ntorque > 0)
        fw_effects_add_load(list, (fw_effects_load){.name = "torques", .ordinary = true});
}

static void scale(fw_device_scene *s, double by) {
    for (int i = 0; i < s->nforce; i++) {
        s->force[i].fx_N *= by;
        s->force[i].fy_N *= by;
    }
    for (int i = 0; i < s->ntorque; i++)
        s->torque[i].value_Nm *= by;
}

static void values(const fw_device_scene *s, fw_effects_load_values *list) {
    for (int i = 0; i < s->nforce; i++) {
        fw_effects_load_value v = {.element = "force", .number = i + 1, .unit = "N"};
        v.attribute = "fx", v.value = s->force[i].fx_N;
        fw_effects_add_load_value(list, v);
        v.attribute = "fy", v.value = s->force[i].fy_N;
        fw_effects_add_load_value(list, v);
    }
    for (int i = 0; i < s->ntorque; i++)
        fw_effects_add_load_value(list, (fw_effects_load_value){.element = "torque",
                                                                .number = i + 1,
                                                                .attribute = "value",
                                                                .unit = "N m",
                                                                .value = s->torque[i].value_Nm});
}

const fw_effect_row fw_effect_applied_load = {
    .id = "applied-load",
    .summary = "forces and torques of the scene with their laws in time",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 56,
    .count = count,
    .kept = true,
    .describe = describe,
    .loads = loads,
    .scale = scale,
    .values = values,
    .solid = FW_EFFECTS_SOLID_HAS};
