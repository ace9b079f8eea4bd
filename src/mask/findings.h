/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Findings in the room's outputs. Private to the room and its tests. */
#ifndef FW_MASK_FINDINGS_H
#define FW_MASK_FINDINGS_H
#include "mask/mask.h"

/* the highest layer up to 60 that the table does not use */
int fw_mask_marker_layer(const fw_mask_table *table);
/* what a marker covers: the chord, edge, corner or window, and at least 1 um around it */
fw_geometry_box fw_mask_marker(const fw_mask_finding *finding);

#endif
