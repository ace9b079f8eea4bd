/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One function per element of <scene>: build_scenes.c, build_surroundings.c. Private to device/. */
#ifndef FW_DEVICE_SCENE_PARTS_H
#define FW_DEVICE_SCENE_PARTS_H
#include "device/reader.h"

typedef struct fw_scene_reader {
    fw_reader *r;
    fw_scene *scene; /* its arrays have room for all of its elements */
    double duration_s;
    int *moved; /* (nbody) 1 + index of its <initial> in this scene, 0: none yet */
} fw_scene_reader;

/* `at`: index of the element's record */
fw_status fw_build_force(fw_scene_reader *s, int at);
fw_status fw_build_torque(fw_scene_reader *s, int at);
fw_status fw_build_gravity(fw_scene_reader *s, int at);
fw_status fw_build_initial(fw_scene_reader *s, int at);
fw_status fw_build_tendon(fw_scene_reader *s, int at);
fw_status fw_build_comb(fw_scene_reader *s, int at);
fw_status fw_build_base_motion(fw_scene_reader *s, int at);
fw_status fw_build_friction(fw_scene_reader *s, int at);
fw_status fw_build_contact(fw_scene_reader *s, int at);
fw_status fw_build_material_damping(fw_scene_reader *s, int at);
fw_status fw_build_temperature(fw_scene_reader *s, int at);
fw_status fw_build_residual_stress(fw_scene_reader *s, int at);
fw_status fw_build_air(fw_scene_reader *s, int at);

/* the first of `names` (n) that is given is one too many: error `number`, "LABEL: NAME WHY" */
bool fw_refused(fw_reader *r, const fw_record *record, int number, const char *const *names, int n,
                const char *why);
/* the first of `names` (n) that is absent is one too few: error `number` at the element */
bool fw_needed(fw_reader *r, const fw_record *record, int number, const char *const *names, int n,
               const char *why);

#endif
