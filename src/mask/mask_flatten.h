/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From an exact outline to its polygon: necks, flattening, bounds. Private to the room. */
#ifndef FW_MASK_MASK_FLATTEN_H
#define FW_MASK_MASK_FLATTEN_H
#include "geometry/segment.h"
#include "mask/mask.h"

/* how all shapes are to be flattened */
void fw_mask_set_flattening(fw_mask_shape *shape, int nshape, fw_geometry_flattening kind);
/* Where a chord between two edges is shortest: of parallel or concentric ones in the middle. */
fw_geometry_chord fw_mask_narrowest(const fw_geometry_segment *p, const fw_geometry_segment *q);
typedef struct fw_mask_wavy_arc { /* for which a tolerance is too small */
    bool there;
    fw_geometry_segment arc;
    double next_m; /* the tolerance that takes one chord less */
} fw_mask_wavy_arc;

/* polygon, bounds and, of a flexure, the neck, whose ends on arcs become vertices (below 1.42 nm
   where that can be proven). FW_GEOMETRY with wavy->there: an arc that cannot */
fw_status fw_mask_flatten(fw_arena *arena, fw_mask_shape *shape, double tolerance_m,
                          fw_mask_wavy_arc *wavy);

/* of a layer: shortest edge, sharpest corners, farthest edge, straight vertices, box */
void fw_mask_measure_start(fw_mask_measure *measure);
void fw_mask_measure_add(fw_mask_measure *measure, const fw_mask_shape *shape);

#endif
