/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of fw_multibody_model_new. Private to multibody/. */
#ifndef FW_MULTIBODY_BUILD_H
#define FW_MULTIBODY_BUILD_H
#include "multibody/model.h"

/* scale.c */
void fw_multibody_model_scale(const fw_mechanism *mechanism, const fw_effects_loads *loads,
                              double duration_s, fw_multibody_scale *scale);
fw_status fw_multibody_model_body_arrays(fw_arena *arena, fw_multibody_model *m);
fw_status fw_multibody_model_block_arrays(fw_arena *arena, fw_multibody_model *m, int nblock);
/* elements.c: centre: origin of the scaled coordinates, m */
fw_status fw_multibody_model_elements_new(fw_arena *arena, fw_multibody_model *m,
                                          const fw_effects_loads *loads, fw_geometry_vec2 centre);
/* stretch.c: centre: m, origin of the scaled coordinates. After blocks and springs. */
fw_status fw_multibody_stretch_new(fw_arena *arena, const fw_effects_stretch *from,
                                   fw_geometry_vec2 centre, fw_multibody_model *m);

#endif
