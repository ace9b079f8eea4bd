/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/effect.h"

bool fw_effect_not_proportional(const fw_effect_case *c) {
    const fw_mechanism *m = c->mechanism;
    if (m->ndriver > 0) return true;
    for (int i = 0; i < m->npin; i++)
        if (fw_pin_has_stop(&m->pin[i])) return true;
    if (c->scene->nfriction > 0) return true;
    for (int i = 0; i < m->nspring; i++)
        if (m->spring[i].cable) return true;
    for (int i = 0; i < c->scene->nforce; i++)
        if (!fw_law_is_constant(c->scene->force[i].law)) return true;
    for (int i = 0; i < c->scene->ntorque; i++)
        if (!fw_law_is_constant(c->scene->torque[i].law)) return true;
    return false;
}
