/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include "effects/envelope.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    return c->scene->gravity && (c->scene->gx_m_per_s2 != 0 || c->scene->gy_m_per_s2 != 0);
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int b = 0; b < c->mechanism->nbody; b++) {
        loads->constant[3 * b] += c->mechanism->body[b].mass_kg * c->scene->gx_m_per_s2;
        loads->constant[3 * b + 1] += c->mechanism->body[b].mass_kg * c->scene->gy_m_per_s2;
    }
    return FW_OK;
}

/* The answer of the modes to the weights, put on at once, in angles and in displacement, and to
   what the joint forces that carry them take from the stiffness (a weight along a mast moves
   nothing and still makes it soft). Inputs m in kg, g in m/s2; output dimensionless; conservative for small motions. Cost modes times
   bodies. Test: test_effects.c, test_bounds.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_mechanism *m = c->mechanism;
    const fw_effects_envelope *e = c->envelope;
    *value = (double)INFINITY;
    if (!e->valid) {
        FW_NEED(*reason = fw_arena_printf(c->arena,
                                          "weight acts, and nothing bounds what it does: kept (%s)",
                                          e->why_not));
        return FW_OK;
    }
    fw_mark mark = fw_arena_mark(c->arena);
    double *force, *mode, part;
    FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
    FW_NEED(mode = fw_arena_array(c->arena, double, (size_t)e->modes));
    for (int b = 0; b < m->nbody; b++) {
        force[3 * b] = m->body[b].mass_kg * c->scene->gx_m_per_s2;
        force[3 * b + 1] = m->body[b].mass_kg * c->scene->gy_m_per_s2;
    }
    for (int j = 0; j < e->modes; j++)
        for (int k = 0; k < e->n; k++)
            mode[j] += e->shape[(size_t)j * (size_t)e->n + (size_t)k] * force[k];
    FW_TRY(fw_effects_envelope_softening(c, force, &part));
    *value = fw_effects_envelope_mode_answer(c, mode, 1) +
             fw_effects_envelope_displaced(c, force, 1) + fw_effects_envelope_stiffness(c, part);
    fw_arena_rewind(c->arena, mark);
    *reason = isfinite(*value)
                  ? "weight: answer of the modes to it, put on at once, and to what it takes from "
                    "the stiffness"
                  : "weight could take all stiffness: kept";
    return FW_OK;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    if (s->gravity && s->gz_m_per_s2 != 0)
        fw_effects_say(to, "; gravity ({n}, {n}, {n} across the plane) m/s\u00b2", s->gx_m_per_s2,
                       s->gy_m_per_s2, s->gz_m_per_s2);
    else if (s->gravity)
        fw_effects_say(to, "; gravity ({n}, {n}) m/s\u00b2", s->gx_m_per_s2, s->gy_m_per_s2);
}

const fw_effect_row fw_effect_gravity = {.id = "gravity",
                                         .summary = "weight of the bodies",
                                         .called_for = called_for,
                                         .bound = bound,
                                         .add = add,
                                         .adds_blindly = true,
                                         .alone_stays = true,
                                         .describe = describe};
