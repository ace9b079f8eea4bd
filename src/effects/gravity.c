/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    return c->scene->gravity && (c->scene->gx_m_per_s2 != 0 || c->scene->gy_m_per_s2 != 0);
}

static fw_status add(const fw_effect_case *c, fw_terms *terms) {
    for (int b = 0; b < c->mechanism->nbody; b++) {
        terms->constant[3 * b] += c->mechanism->body[b].mass_kg * c->scene->gx_m_per_s2;
        terms->constant[3 * b + 1] += c->mechanism->body[b].mass_kg * c->scene->gy_m_per_s2;
    }
    return FW_OK;
}

static double largest(const double *value, int count) {
    double most = 0;
    for (int i = 0; i < count; i++)
        most = fmax(most, fabs(value[i]));
    return most;
}

bool fw_effect_not_proportional(const fw_effect_case *c) {
    const fw_mechanism *m = c->mechanism;
    if (m->ndriver > 0) return true;
    for (int i = 0; i < m->npin; i++)
        if (fw_pin_has_stop(&m->pin[i])) return true;
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].cable) return true;
    for (int i = 0; i < c->scene->nforce; i++)
        if (!fw_law_is_constant(c->scene->force[i].law)) return true;
    for (int i = 0; i < c->scene->ntorque; i++)
        if (!fw_law_is_constant(c->scene->torque[i].law)) return true;
    return false;
}

/* how much weight can change the stiffness, relative: in a chain of n joints the second derivative
   of the height of a centre of mass is at most n R per unit of sum theta_i^2, R the reach, and the
   springs give at least k_least, so that s = n R sum(m g) / k_least. Infinite where a joint has no
   spring. A weight along a mast moves nothing and still makes it soft. */
static double softening(const fw_mechanism *m, double g_m_per_s2) {
    double weight = 0, reach = 0, least = (double)INFINITY;
    for (int b = 0; b < m->nbody; b++)
        weight += m->body[b].mass_kg * g_m_per_s2;
    for (int i = 0; i < m->npin; i++) {
        fw_vec2 p = fw_pin_place(m, &m->pin[i], 0);
        least = fmin(least, m->pin[i].stiffness_Nm_per_rad);
        for (int b = 0; b < m->nbody; b++)
            reach = fmax(reach, hypot(m->body[b].x_m - p.x, m->body[b].y_m - p.y));
    }
    if (m->npin == 0 || m->ntie > 0 || !(least > 0)) return (double)INFINITY;
    return m->npin * reach * weight / least;
}

/* s/(1 - s) of the softening, and 2 max|theta_gravity| / max|theta_rest| of the linear static
   responses: a load put on at once
   moves up to twice its static response, and the rest moves at least by its own. Infinite where the
   mechanism has a free motion, nothing else moves it, it starts with a velocity, or the motion is
   not that of constant loads on springs: a load that comes late, a driver, a stop or a cable may
   move it by less than its own static response.
   Output dimensionless; conservative for small angles away from singular positions. Cost one dense
   solve each.
   Test: test_effects.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_mechanism *m = c->mechanism;
    size_t n = 3 * (size_t)m->nbody;
    *value = (double)INFINITY;
    *reason = "weight has nothing to be small against: kept";
    if (fw_effect_initial_velocity.called_for(c)) return FW_OK;
    if (fw_effect_not_proportional(c)) {
        *reason = "drivers, stops, cables or loads that change with time move the mechanism: "
                  "weight has no constant load to be small against: kept";
        return FW_OK;
    }
    fw_mark mark = fw_arena_mark(c->arena);
    fw_terms rest, weight;
    double *force, *displacement, *rotation;
    FW_TRY(fw_terms_new(c->arena, m, c->scene, &rest));
    FW_TRY(fw_terms_new(c->arena, m, c->scene, &weight));
    FW_NEED(force = fw_arena_array(c->arena, double, n));
    FW_NEED(displacement = fw_arena_array(c->arena, double, n));
    FW_NEED(rotation = fw_arena_array(c->arena, double, (size_t)m->npin));
    FW_TRY(fw_effect_joint_elasticity.add(c, &rest));
    FW_TRY(fw_effect_point_spring.add(c, &rest));
    FW_TRY(fw_effect_applied_load.add(c, &rest));
    FW_TRY(add(c, &weight));
    bool valid = false;
    FW_TRY(fw_static_response(c->arena, m, &rest, weight.constant, displacement, rotation, &valid));
    double moved = largest(rotation, m->npin), others = 0;
    if (valid) {
        fw_terms_initial_force(m, &rest, force);
        FW_TRY(fw_static_response(c->arena, m, &rest, force, displacement, rotation, &valid));
        others = largest(rotation, m->npin);
    }
    double soft = softening(m, hypot(c->scene->gx_m_per_s2, c->scene->gy_m_per_s2));
    if (valid && others > 0) {
        *value = soft < 1 ? 2 * moved / others + soft / (1 - soft) : (double)INFINITY;
        *reason = soft < 1 ? "bound: twice the static response to the weights over that to the "
                             "other loads, and what they can take from the stiffness"
                           : "weight could take all stiffness: kept";
    }
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

const fw_effect_row fw_effect_gravity = {.id = "gravity",
                                         .summary = "weight of the bodies",
                                         .called_for = called_for,
                                         .bound = bound,
                                         .add = add};
