/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (c->mechanism->pin[i].damping_Nms_per_rad > 0) return true;
    for (int i = 0; i < c->mechanism->ntie; i++)
        if (c->mechanism->tie[i].damping_Ns_per_m > 0) return true;
    return false;
}

/* adds c/J of a turning damper, c (1/m + r^2/J) of a sliding one to its bodies */
static void add_rates(const fw_mechanism *m, double *rate) {
    for (int i = 0; i < m->npin; i++) {
        const fw_pin *p = &m->pin[i];
        for (int side = 0; side < 2; side++) {
            int b = side ? p->body_b : p->body_a;
            if (b != FW_GROUND) rate[b] += p->damping_Nms_per_rad / m->body[b].inertia_kg_m2;
        }
    }
    for (int i = 0; i < m->ntie; i++) {
        const fw_tie *t = &m->tie[i];
        for (int side = 0; side < 2; side++) {
            int b = side ? t->body_b : t->body_a;
            double x = side ? t->bx_m : t->ax_m, y = side ? t->by_m : t->ay_m;
            if (b == FW_GROUND) continue;
            rate[b] += t->damping_Ns_per_m *
                       (1 / m->body[b].mass_kg + (x * x + y * y) / m->body[b].inertia_kg_m2);
        }
    }
}

/* 1 - exp(-sigma T): no mode of amplitude A(t) decays faster than exp(-sigma t), with
   sigma = phi^T C phi / (2 phi^T M phi) <= max over bodies of the sum of c/J of its turning and
   c (1/m + r^2/J) of its sliding dampers: (w_b - w_a)^2 <= 2 (w_a^2 + w_b^2), likewise for the
   speeds of the two points along the axis, and (v + w r)^2 <= (1/m + r^2/J) (m v^2 + J w^2) by
   Cauchy and Schwarz.
   Inputs c in N m s/rad and N s/m, m in kg, J in kg m2, arm r of the joint's point in m, T in s;
   conservative for small motions. Cost O(joints). Test: test_effects.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_mechanism *m = c->mechanism;
    fw_mark mark = fw_arena_mark(c->arena);
    double fastest = 0, *rate = fw_arena_array(c->arena, double, (size_t)m->nbody);
    FW_NEED(rate);
    add_rates(m, rate);
    for (int b = 0; b < m->nbody; b++)
        fastest = fmax(fastest, rate[b]);
    fw_arena_rewind(c->arena, mark);
    *value = -expm1(-fastest * c->scene->duration_s);
    *reason = "joints have damping: bound 1 - exp(-sigma T) with sigma = max(sum of c/J, and "
              "c (1/m + r^2/J) where they slide)";
    return FW_OK;
}

static fw_status add(const fw_effect_case *c, fw_terms *terms) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (c->mechanism->pin[i].damping_Nms_per_rad > 0)
            fw_terms_torsion(c->mechanism, terms, i)->damping_Nms_per_rad =
                c->mechanism->pin[i].damping_Nms_per_rad;
    for (int i = 0; i < c->mechanism->ntie; i++)
        if (c->mechanism->tie[i].damping_Ns_per_m > 0)
            fw_terms_slide(terms, i)->damping_Ns_per_m = c->mechanism->tie[i].damping_Ns_per_m;
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int many = 0;
    for (int i = 0; i < c->mechanism->npin; i++)
        many += c->mechanism->pin[i].damping_Nms_per_rad > 0;
    for (int i = 0; i < c->mechanism->ntie; i++)
        many += c->mechanism->tie[i].damping_Ns_per_m > 0;
    return many;
}

const fw_effect_row fw_effect_joint_damping = {
    .id = "joint-damping",
    .summary = "viscous torque of hinges and force of sliding joints, c times rate",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 30,
    .count = count};
