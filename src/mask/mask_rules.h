/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The joints between pieces, and what is said of places. The rules themselves: rule.h */
#ifndef FW_MASK_MASK_RULES_H
#define FW_MASK_MASK_RULES_H
#include "mask/mask.h"

/* Finds the partner of every JOINT segment among the shapes of each layer (drawn outlines, bit for
   bit), makes the biased end points of both the same bits, and marks the joint as inner. Distances
   above 1e-12 m and missing partners are FW-D146. */
fw_status fw_mask_join(fw_arena *arena, fw_mask_shape *shape, int nshape, fw_diags *diags);

/* after flattening: both sides of every joint share the same two grid points (FW-D146) */
fw_status fw_mask_check_joints(fw_arena *arena, const fw_mask_shape *shape, int nshape,
                               fw_diags *diags);

/* warns of corners that the grid made sharper than 90 degrees (FW-D153), once per shape; ends of
   joints are no corners */
void fw_mask_check_corners(const fw_mask_shape *shape, int nshape, fw_diags *diags);

/* "(123.456, -7.89) um" for messages; `text` holds at least 80 bytes */
const char *fw_mask_place_text(char *text, size_t n, fw_geometry_vec2 at);

#endif
