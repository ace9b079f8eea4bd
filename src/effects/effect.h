/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of the table, one file each. */
#ifndef FW_EFFECTS_EFFECT_H
#define FW_EFFECTS_EFFECT_H
#include "effects/effects.h"
#include <math.h>

#define FW_EFFECT(name) extern const fw_effect_row fw_effect_##name;
#include "effects/effects.def"
#undef FW_EFFECT

/* a new element of the terms, zeroed, with memory for its ports; NULL without memory */
fw_force_element *fw_terms_add_element(fw_arena *arena, fw_terms *terms,
                                       const fw_element_class *class_, int ports);
fw_friction *fw_terms_add_friction(fw_arena *arena, fw_terms *terms);

/* the entry of a pin, made on first use */
fw_torsion *fw_terms_torsion(const fw_mechanism *mechanism, fw_terms *terms, int pin);
/* of a prismatic joint, made on first use */
fw_slide *fw_terms_slide(fw_terms *terms, int tie);
/* something in the scene or the mechanism answers out of proportion to a load: its response to a
   part of the loads says nothing about the whole (loads that go with time, drivers, stops, cables)
 */
bool fw_effect_not_proportional(const fw_effect_case *c);
static inline bool fw_pin_has_stop(const fw_pin *p) {
    return p->stop_stiffness_Nm_per_rad > 0 && (!isnan(p->stop_min_rad) || !isnan(p->stop_max_rad));
}
/* a cable that is not stretched in the drawn pose */
bool fw_spring_slack(const fw_mechanism *mechanism, const fw_spring *spring);
/* empty terms with room for everything that mechanism and scene can ask for */
fw_status fw_terms_new(fw_arena *arena, const fw_mechanism *mechanism, const fw_scene *scene,
                       fw_terms *terms);

#endif
