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

/* forces at the centre of mass and torques are constants; a force elsewhere turns its arm */
static void add(const fw_effect_case *c, fw_terms *terms) {
    for (int i = 0; i < c->scene->nforce; i++) {
        const fw_force *f = &c->scene->force[i];
        if (f->body == FW_GROUND) continue;
        if (f->x_m == 0 && f->y_m == 0) {
            terms->constant[3 * f->body] += f->fx_N;
            terms->constant[3 * f->body + 1] += f->fy_N;
        } else {
            terms->load[terms->nload++] =
                (fw_point_load){f->body, f->x_m, f->y_m, f->fx_N, f->fy_N};
        }
    }
    for (int i = 0; i < c->scene->ntorque; i++)
        if (c->scene->torque[i].body != FW_GROUND)
            terms->constant[3 * c->scene->torque[i].body + 2] += c->scene->torque[i].value_Nm;
}

const fw_effect_row fw_effect_applied_load = {
    "applied-load", "forces and torques of the scene, constant from the start", called_for, bound,
    add};
