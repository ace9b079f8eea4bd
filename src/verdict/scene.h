/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene is run, and what speaks against it beside its hinges is found. Private to the room. */
#ifndef FW_VERDICT_SCENE_H
#define FW_VERDICT_SCENE_H
#include "verdict/verdict.h"

enum { FW_REASONS = 3 }; /* of one scene at most */

/* scene i of the device: motion[i] (NULL where electrodes touch, or where the formula of another
   effect ends), pull_in[i], and reasons of v */
fw_status fw_verdict_scene(fw_arena *arena, const fw_device_scene *scene, int i,
                           const fw_dynamics_motion_options *options, fw_diags *diags,
                           fw_verdict_variant_verdict *v);

#endif
