/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far a straight cut stays from everything else of a polygon. Private to the room. */
#ifndef FW_MASK_CUT_TREE_H
#define FW_MASK_CUT_TREE_H
#include "geometry/tessellate.h"

typedef struct fw_mask_cut_box { /* dbu */
    double x0, y0, x1, y1;
} fw_mask_cut_box;

typedef struct fw_mask_cut_tree { /* boxes of runs of edges: node k holds nodes 2k and 2k + 1 */
    const fw_geometry_polygon *polygon;
    fw_mask_cut_box *box; /* (2 leaves), from 1 on */
    int leaves;           /* a power of two */
} fw_mask_cut_tree;

fw_status fw_mask_cut_tree_new(fw_arena *arena, const fw_geometry_polygon *polygon,
                               fw_mask_cut_tree *tree);

/* Least distance (dbu) from the segment between vertices i and j to any other vertex, at most
   `most`; -1 where it meets an edge that ends at neither. As soon as it is known to be no more than
   `least`, any such number. */
double fw_mask_cut_clearance(const fw_mask_cut_tree *tree, int i, int j, double least, double most);

/* the same of one point and the segment from a to b */
double fw_mask_cut_distance(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c);
/* twice the area of a triangle: exact, |coordinate| < 2^30 */
int64_t fw_mask_cut_cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c);

#endif
