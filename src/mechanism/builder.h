/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parts of fw_mechanism_build share. Private to mechanism/. */
#ifndef FW_MECHANISM_BUILDER_H
#define FW_MECHANISM_BUILDER_H
#include "mechanism/mechanism.h"

typedef struct fw_builder {
    fw_arena *arena;
    const fw_device *device;
    const fw_layout *layout; /* may be NULL */
    const fw_variant *variant;
    fw_diags *diags;
    fw_mechanism *mechanism;
} fw_builder;

const char *fw_name_or_none(const char *id);
bool fw_all_finite(const double *value, int count);
/* a message of this number for this place exists: flows share the file, but one message is enough
 */
bool fw_said_already(const fw_diags *diags, int number, fw_place place);
/* world position, in the drawn pose, of a local point; body NULL: the ground */
fw_vec2 fw_body_point(const fw_mass *body, fw_vec2 local);

/* link.c: bodies, joints and pins are built */
fw_status fw_build_spring(const fw_builder *b, int i);
fw_status fw_build_tie(const fw_builder *b, int i);
fw_status fw_build_driver(const fw_builder *b, int i);

#endif
