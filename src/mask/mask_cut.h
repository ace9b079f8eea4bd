/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons of more vertices than a reader takes. Private to the room. */
#ifndef FW_MASK_MASK_CUT_H
#define FW_MASK_MASK_CUT_H
#include "geometry/tessellate.h"

/* what a cut keeps to every vertex, as a share of the shortest edge, where it can */
#define FW_CUT_SHARE 0.9

/* Cuts along straight lines between existing vertices until no part has more than `most` >= 8 of
   them. The parts share their cut edges, point by point; nothing is moved or added. One part where
   nothing is to be cut. clear_dbu (may be NULL): no cut is nearer to a vertex that it does not end
   at; INFINITY where nothing is cut. FW_GEOMETRY: no cut was found. */
fw_status fw_mask_polygon_cut(fw_arena *arena, const fw_geometry_polygon *polygon, int most,
                              fw_geometry_polygon **part, int *npart, double *clear_dbu);

#endif
