/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (c->mechanism->pin[i].stiffness_Nm_per_rad > 0) return true;
    for (int i = 0; i < c->mechanism->njoint; i++)
        if (c->mechanism->joint[i].stiffness_N_per_m > 0) return true;
    return false;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    (void)c;
    *value = (double)INFINITY;
    *reason = "joints have stiffness: it is the motion itself";
    return FW_OK;
}

/* turning: torque -k (phi_b - phi_a - free angle) on b, the opposite on a; sliding: force -k travel
   along the axis on b, the opposite on a */
static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (c->mechanism->pin[i].stiffness_Nm_per_rad > 0)
            fw_effects_loads_torsion(c->mechanism, loads, i)->stiffness_Nm_per_rad =
                c->mechanism->pin[i].stiffness_Nm_per_rad;
    for (int i = 0; i < c->mechanism->njoint; i++)
        if (c->mechanism->joint[i].stiffness_N_per_m > 0)
            fw_effects_loads_slide(loads, i)->stiffness_N_per_m =
                c->mechanism->joint[i].stiffness_N_per_m;
    return FW_OK;
}

static int count(const fw_effect_case *c) {
    int n = 0;
    for (int i = 0; i < c->mechanism->npin; i++)
        n += c->mechanism->pin[i].stiffness_Nm_per_rad > 0;
    for (int i = 0; i < c->mechanism->njoint; i++)
        n += c->mechanism->joint[i].stiffness_N_per_m > 0;
    return n;
}

const fw_effect_row fw_effect_joint_elasticity = {
    .id = "joint-elasticity",
    .summary = "elastic torque of hinges and force of sliding joints, k times angle or travel",
    .called_for = called_for,
    .bound = bound,
    .add = add,
    .cost = 49,
    .count = count,
    .kept = true,
    .passive = true,
    .solid = FW_EFFECTS_SOLID_HAS};
