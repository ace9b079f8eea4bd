/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The base shakes: poses and velocities are counted in its frame, where every body feels -m a(t) at
   its centre of mass. The base does not turn, so there is no other force of that kind. Energies are
   those in the frame of the base: the work of -m a is what the shaker feeds in, seen from there. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

static bool shakes(const fw_device_base_motion *b) {
    return b->ax_m_per_s2 != 0 || b->ay_m_per_s2 != 0;
}

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->scene->nbase; i++)
        if (shakes(&c->scene->base[i])) return true;
    return false;
}

/* modal forces (modes) of -m a, and the force (n) itself */
static void modal_load_of(const fw_effect_case *c, const fw_device_base_motion *b, double size,
                          double *force, double *mode) {
    const fw_mechanism *m = c->mechanism;
    const fw_effects_envelope *e = c->envelope;
    for (int k = 0; k < m->nbody; k++) {
        force[3 * k] = -m->body[k].mass_kg * b->ax_m_per_s2 * size;
        force[3 * k + 1] = -m->body[k].mass_kg * b->ay_m_per_s2 * size;
    }
    for (int j = 0; j < e->modes; j++) {
        mode[j] = 0;
        for (int k = 0; k < e->n; k++)
            mode[j] += e->shape[(size_t)j * (size_t)e->n + (size_t)k] * force[k];
    }
}

/* Sum over the shakes of the envelope's answer to -m a on every body, in angles and in displacement,
   with the size and variation of the law, and to what the joint forces that carry them do to the
   stiffness meanwhile. Inputs SI; output dimensionless. Valid where the envelope is. Cost modes x
   bodies each. Test: test_base_motion.c, test_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    *value = (double)INFINITY;
    if (!e || !e->valid) {
        FW_NEED(*reason = fw_arena_printf(
                    c->arena, "the base shakes, and nothing bounds what that does: kept (%s)",
                    e ? e->why_not : "not looked at"));
        return FW_OK;
    }
    *reason = "the base shakes by a law without bounds, or could take all stiffness: kept";
    fw_mark mark = fw_arena_mark(c->arena);
    double *force, *mode, sum = 0;
    FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
    FW_NEED(mode = fw_arena_array(c->arena, double, (size_t)e->modes));
    for (int i = 0; i < c->scene->nbase; i++) {
        const fw_device_base_motion *b = &c->scene->base[i];
        double part;
        if (!shakes(b)) continue;
        fw_quantity_law_size size = fw_quantity_law_measure(b->law, c->scene->duration_s);
        if (size.most == 0) continue;
        if (!isfinite(size.most)) sum = (double)INFINITY;
        if (!isfinite(sum)) break;
        modal_load_of(c, b, size.most, force, mode);
        FW_TRY(fw_effects_envelope_softening(c, force, &part));
        sum += fw_effects_envelope_mode_answer(c, mode, size.variation / size.most) +
               fw_effects_envelope_displaced(c, force, size.variation / size.most) +
               (fw_quantity_law_is_constant(b->law) ? fw_effects_envelope_stiffness(c, part)
                                                    : fw_effects_envelope_varying(c, part));
    }
    fw_arena_rewind(c->arena, mark);
    if (!(sum < (double)INFINITY)) return FW_OK;
    *value = sum;
    *reason = "the base shakes: answer of the modes to the forces -m a with all turns of their "
              "laws, and to what they take from the stiffness";
    return FW_OK;
}

/* laws to `timed` (room for every body and shake is reserved), what is constant to the constants */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    const fw_mechanism *m = c->mechanism;
    for (int i = 0; i < c->scene->nbase; i++) {
        const fw_device_base_motion *b = &c->scene->base[i];
        for (int k = 0; k < m->nbody && shakes(b); k++) {
            double fx = -m->body[k].mass_kg * b->ax_m_per_s2;
            double fy = -m->body[k].mass_kg * b->ay_m_per_s2;
            if (!fw_quantity_law_is_constant(b->law)) {
                loads->timed[loads->ntimed++] =
                    (fw_effects_timed_load){.body = k, .fx_N = fx, .fy_N = fy, .law = b->law};
                continue;
            }
            loads->constant[3 * k] += fx;
            loads->constant[3 * k + 1] += fy;
        }
    }
    return FW_OK;
}

/* what is constant is among the constants */
static int count(const fw_effect_case *c) {
    int laws = 0;
    for (int i = 0; i < c->scene->nbase; i++)
        laws += shakes(&c->scene->base[i]) && !fw_quantity_law_is_constant(c->scene->base[i].law);
    return laws * c->mechanism->nbody;
}

/* it stays where nothing else moves the mechanism: there is then nothing else to judge */
static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    for (int i = 0; i < s->nbase; i++) {
        if (s->base[i].az_m_per_s2 != 0)
            fw_effects_say(to, "; base shaken with ({n}, {n}, {n} across the plane) m/s\u00b2",
                           s->base[i].ax_m_per_s2, s->base[i].ay_m_per_s2, s->base[i].az_m_per_s2);
        else
            fw_effects_say(to, "; base shaken with ({n}, {n}) m/s\u00b2", s->base[i].ax_m_per_s2,
                           s->base[i].ay_m_per_s2);
        fw_effects_say_law(to, s->base[i].law);
    }
}

static void loads(const fw_device_scene *s, fw_effects_load_scaling *list) {
    if (s->nbase > 0) fw_effects_add_load(list, (fw_effects_load){.name = "base motion"});
}

static void scale(fw_device_scene *s, double by) {
    for (int i = 0; i < s->nbase; i++) {
        s->base[i].ax_m_per_s2 *= by;
        s->base[i].ay_m_per_s2 *= by;
        s->base[i].az_m_per_s2 *= by;
    }
}

static void values(const fw_device_scene *s, fw_effects_load_values *list) {
    for (int i = 0; i < s->nbase; i++) {
        fw_effects_load_value v = {.element = "base-motion", .number = i + 1, .unit = "m/s^2"};
        v.attribute = "ax", v.value = s->base[i].ax_m_per_s2;
        fw_effects_add_load_value(list, v);
        v.attribute = "ay", v.value = s->base[i].ay_m_per_s2;
        fw_effects_add_load_value(list, v);
        v.attribute = "az", v.value = s->base[i].az_m_per_s2;
        fw_effects_add_load_value(list, v);
    }
}

const fw_effect_row fw_effect_base_motion = {.id = "base-motion",
                                             .summary = "acceleration of the base: -m a(t) on "
                                                        "every body, in the base's frame",
                                             .called_for = called_for,
                                             .bound = bound,
                                             .add = add,
                                             .adds_blindly = true,
                                             .cost = 449,
                                             .count = count,
                                             .alone_stays = true,
                                             .describe = describe,
                                             .loads = loads,
                                             .scale = scale,
                                             .values = values};
