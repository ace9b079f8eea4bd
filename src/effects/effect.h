/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of the table, one file each. */
#ifndef FW_EFFECTS_EFFECT_H
#define FW_EFFECTS_EFFECT_H
#include "effects/effects.h"

extern const fw_effect_row fw_effect_joint_elasticity, fw_effect_joint_damping,
    fw_effect_point_spring, fw_effect_applied_load, fw_effect_gravity, fw_effect_initial_velocity;

/* the entry of a pin, made on first use */
fw_torsion *fw_terms_torsion(const fw_mechanism *mechanism, fw_terms *terms, int pin);
/* empty terms with room for everything that mechanism and scene can ask for */
fw_status fw_terms_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                       fw_terms *terms);

#endif
