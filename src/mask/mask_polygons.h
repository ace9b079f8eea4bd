/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From exact outlines to polygons: joints between pieces, necks, flattening, bounds, corners, cuts.
   Private to the room and its tests. */
#ifndef FW_MASK_MASK_POLYGONS_H
#define FW_MASK_MASK_POLYGONS_H
#include "geometry/segment.h"
#include "geometry/polygon.h"
#include "mask/mask.h"

/* Finds the partner of every JOINT segment among the shapes of each layer (drawn outlines, bit for
   bit), makes the biased end points of both the same bits, and marks the joint as inner. Distances
   above 1e-12 m and missing partners are FW-D146. */
fw_status fw_mask_join(fw_arena *arena, fw_mask_shape *shape, int nshape, fw_diags *diags);
/* mask_cells.c: the bias of cells that have holes, of which the outlines of all their parts are moved as they were drawn,
   and cut anew; after fw_mask_join. FW-D143 where outlines meet. Is a shape of such a cell? */
fw_status fw_mask_cells_bias(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                             fw_diags *diags);
bool fw_mask_cell_is_cut(const fw_mask *mask, int shape);
/* mask_cells.c: cells that lie on the frame become one with it, as they are on the mask; after fw_mask_join */
fw_status fw_mask_cells_unite(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                              fw_diags *diags);

/* after flattening: both sides of every joint share the same two grid points (FW-D146) */
fw_status fw_mask_check_joints(fw_arena *arena, const fw_mask_shape *shape, int nshape,
                               fw_diags *diags);

/* warns of corners that the grid made sharper than 90 degrees (FW-D153), once per shape; ends of
   joints are no corners */
void fw_mask_check_corners(const fw_mask_shape *shape, int nshape, fw_diags *diags);

/* "(123.456, -7.89) um" for messages; `text` holds at least 80 bytes */
const char *fw_mask_place_text(char *text, size_t n, fw_geometry_vec2 at);

/* the hinge that a place belongs to; NULL: none */
const fw_layout_hinge_layout *fw_mask_hinge_at(const fw_layout *layout, fw_geometry_vec2 at);
/* "; the place belongs to hinge A, ..." for messages, with what to do; "" where it is of none */
const char *fw_mask_cause(fw_arena *arena, const fw_layout *layout, fw_geometry_vec2 at);

/* ---- flattening ---- */

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

/* ---- polygons of more vertices than a reader takes ---- */

/* what a cut keeps to every vertex, as a share of the shortest edge, where it can */
#define FW_CUT_SHARE 0.9

/* Cuts along straight lines between existing vertices until no part has more than `most` >= 8 of
   them. The parts share their cut edges, point by point; nothing is moved or added. One part where
   nothing is to be cut. clear_dbu (may be NULL): no cut is nearer to a vertex that it does not end
   at; INFINITY where nothing is cut. FW_GEOMETRY: no cut was found. */
fw_status fw_mask_polygon_cut(fw_arena *arena, const fw_geometry_polygon *polygon, int most,
                              fw_geometry_polygon **part, int *npart, double *clear_dbu);

/* finds the nets that were asked for on the mask, FW-D441 where they differ: in `wired`; `wiring` becomes NULL where
   it is of another layout */
fw_status fw_mask_wiring_check(fw_arena *arena, const fw_layout *layout, fw_mask *mask,
                               fw_diags *diags);

#endif
