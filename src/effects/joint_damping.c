/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"
#include <math.h>

static bool called_for(const fw_effect_case *c) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (c->mechanism->pin[i].damping_Nms_per_rad > 0) return true;
    return false;
}

/* 1 - exp(-sigma T): no mode of amplitude A(t) decays faster than exp(-sigma t), with
   sigma = phi^T C phi / (2 phi^T M phi) <= max over bodies of (sum of c at its pins) / J,
   because (w_b - w_a)^2 <= 2 (w_a^2 + w_b^2) and translation only adds mass.
   Inputs c in N m s/rad, J in kg m2, T in s; conservative for small angles. Test: test_effects.c.
 */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_mechanism *m = c->mechanism;
    double fastest = 0;
    for (int b = 0; b < m->nbody; b++) {
        double sum = 0;
        for (int i = 0; i < m->npin; i++)
            if (m->pin[i].body_a == b || m->pin[i].body_b == b)
                sum += m->pin[i].damping_Nms_per_rad;
        fastest = fmax(fastest, sum / m->body[b].inertia_kg_m2);
    }
    *value = -expm1(-fastest * c->scene->duration_s);
    *reason = "hinges have damping: bound 1 - exp(-sigma T) with sigma = max(sum c / J)";
    return FW_OK;
}

static void add(const fw_effect_case *c, fw_terms *terms) {
    for (int i = 0; i < c->mechanism->npin; i++)
        if (c->mechanism->pin[i].damping_Nms_per_rad > 0)
            fw_terms_torsion(c->mechanism, terms, i)->damping_Nms_per_rad =
                c->mechanism->pin[i].damping_Nms_per_rad;
}

const fw_effect_row fw_effect_joint_damping = {
    "joint-damping", "viscous torque of the hinges, c times angular rate", called_for, bound, add};
