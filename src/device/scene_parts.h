/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One function per element of <scene>: build_scenes.c, build_surroundings.c. Private to device/. */
#ifndef FW_DEVICE_SCENE_PARTS_H
#define FW_DEVICE_SCENE_PARTS_H
#include "device/device_reader.h"

typedef struct fw_device_scene_reader {
    fw_device_reader *r;
    fw_device_scene *scene; /* its arrays have room for all of its elements */
    double duration_s;
    int *moved; /* (nbody) 1 + index of its <initial> in this scene, 0: none yet */
} fw_device_scene_reader;

/* `at`: index of the element's record */
fw_status fw_device_build_force(fw_device_scene_reader *s, int at);
fw_status fw_device_build_torque(fw_device_scene_reader *s, int at);
fw_status fw_device_build_gravity(fw_device_scene_reader *s, int at);
fw_status fw_device_build_initial(fw_device_scene_reader *s, int at);
fw_status fw_device_build_tendon(fw_device_scene_reader *s, int at);
fw_status fw_device_build_comb(fw_device_scene_reader *s, int at);
fw_status fw_device_build_base_motion(fw_device_scene_reader *s, int at);
fw_status fw_device_build_friction(fw_device_scene_reader *s, int at);
fw_status fw_device_build_contact(fw_device_scene_reader *s, int at);
fw_status fw_device_build_material_damping(fw_device_scene_reader *s, int at);
fw_status fw_device_build_temperature(fw_device_scene_reader *s, int at);
fw_status fw_device_build_residual_stress(fw_device_scene_reader *s, int at);
fw_status fw_device_build_air(fw_device_scene_reader *s, int at);

/* the first of `names` (n) that is given is one too many: error `number`, "LABEL: NAME WHY" */
bool fw_device_refused(fw_device_reader *r, const fw_xml_record *record, int number,
                       const char *const *names, int n, const char *why);
/* the first of `names` (n) that is absent is one too few: error `number` at the element */
bool fw_device_needed(fw_device_reader *r, const fw_xml_record *record, int number,
                      const char *const *names, int n, const char *why);

#endif
