/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parts of fw_mechanism_build share. Private to mechanism/. */
#ifndef FW_MECHANISM_BUILDER_H
#define FW_MECHANISM_BUILDER_H
#include "mechanism/mechanism.h"

typedef struct fw_mechanism_builder {
    fw_arena *arena;
    const fw_device *device;
    const fw_layout *layout; /* may be NULL */
    const fw_mechanism_variant *variant;
    fw_diags *diags;
    fw_mechanism *mechanism;
} fw_mechanism_builder;

const char *fw_mechanism_name_or_none(const char *id);
bool fw_mechanism_all_finite(const double *value, int count);
/* a message of this number for this place exists: flows share the file, but one message is enough
 */
bool fw_mechanism_said_already(const fw_diags *diags, int number, fw_place place);
/* world position, in the drawn pose, of a local point; body NULL: the ground */
fw_geometry_vec2 fw_mechanism_body_point(const fw_mechanism_mass *body, fw_geometry_vec2 local);

/* link.c: bodies, joints and pins are built */
fw_status fw_mechanism_build_spring(const fw_mechanism_builder *b, int i);
fw_status fw_mechanism_build_joint(const fw_mechanism_builder *b, int i);
fw_status fw_mechanism_build_driver(const fw_mechanism_builder *b, int i);

/* drawn_outlines.c: what probes between outlines are of is drawn */
fw_status fw_mechanism_check_outlines(const fw_mechanism_builder *b);

#endif
