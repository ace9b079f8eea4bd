/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "effects/envelope.h"
#include <math.h>

fw_status fw_envelope_find(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                           fw_envelope *envelope) {
    (void)arena, (void)mechanism, (void)scene;
    *envelope = (fw_envelope){.why_not = "not computed"};
    return FW_OK;
}

double fw_envelope_answer(const fw_effect_case *c, const double *force, double variation) {
    (void)c, (void)force, (void)variation;
    return (double)INFINITY;
}

double fw_envelope_stiffness(const fw_effect_case *c, double part) {
    (void)c, (void)part;
    return (double)INFINITY;
}
