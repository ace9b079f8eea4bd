/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria and modes of one scene. */
#include "plan/stages.h"

enum { DRAWN_MODES = 12 };

/* modes about rest need no scene: one without loads stands in where the device has none */
static const fw_device_scene without_loads = {.name = "(none)", .duration_s = 1.0};

fw_status fw_plan_modes(fw_plan *plan, const fw_statics_modes **modes,
                        const fw_mechanism **mechanism, const fw_device_scene **scene) {
    const fw_statics_mode_options o = {.effects = plan->options.verdict.motion.effects,
                                       .accuracy = plan->options.verdict.motion.accuracy,
                                       .at_equilibrium = plan->options.at_equilibrium,
                                       .drawn = DRAWN_MODES};
    *scene = NULL;
    if (plan->device->nscene == 0 && !plan->options.scene && !o.at_equilibrium)
        *scene = &without_loads;
    FW_TRY(fw_plan_start(plan, mechanism, scene, NULL));
    return fw_statics_small_motions(plan->arena, *mechanism, *scene, &o, &plan->diags, modes);
}

fw_status fw_plan_statics(fw_plan *plan, const fw_statics **statics, const fw_mechanism **mechanism,
                          const fw_device_scene **scene) {
    const fw_statics_static_options o = {.effects = plan->options.verdict.motion.effects,
                                         .accuracy = plan->options.verdict.motion.accuracy,
                                         .path = plan->options.path};
    *scene = NULL;
    FW_TRY(fw_plan_start(plan, mechanism, scene, NULL));
    FW_TRY(fw_statics_solve(plan->arena, *mechanism, *scene, &o, &plan->diags, statics));
    return fw_verdict_level_strains(plan->arena, *mechanism, (*statics)->level);
}
