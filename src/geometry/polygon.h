/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room: the two exact answers to "is this polygon simple?". */
#ifndef FW_GEOMETRY_POLYGON_H
#define FW_GEOMETRY_POLYGON_H
#include "geometry/contour.h"
#include "geometry/tessellate.h"

/* -1, 0, 1 left of, on, right of .. : twice the area of the triangle, exact for |coordinate| < 2^30
 */
static inline int64_t fw_cross(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c) {
    return ((int64_t)b.x_dbu - a.x_dbu) * ((int64_t)c.y_dbu - a.y_dbu) -
           ((int64_t)b.y_dbu - a.y_dbu) * ((int64_t)c.x_dbu - a.x_dbu);
}

/* *proved: no two edges have a common point but the vertex of neighbours. false says nothing: then
   polygon.c's sweep over edges decides and names the two. */
fw_status fw_geometry_polygon_prove(fw_arena *arena, const fw_geometry_polygon *polygon,
                                    bool *proved);

/* A straight line through exact outlines: the intervals of the line that lie in material, and what
   sets of such intervals have in common. */

typedef struct fw_geometry_cut_line {
    fw_geometry_vec2 at, along; /* a point of the line; unit vector */
} fw_geometry_cut_line;

typedef struct fw_geometry_slice { /* from < to, m from `at` along the line */
    double from_m, to_m;
    double from_sine, to_sine; /* of the angle between line and outline there, > 0: an edge that
                                  moves by d moves the end by d/sine */
} fw_geometry_slice;

typedef struct fw_geometry_slices { /* ascending, apart from each other by more than 1e-12 m */
    fw_geometry_slice *item;        /* (n) */
    int n;
} fw_geometry_slices;

/* what of the line lies inside a contour (of either direction) */
fw_status fw_geometry_contour_slice(fw_arena *arena, const fw_geometry_contour *contour,
                                    fw_geometry_cut_line line, fw_geometry_slices *out);

typedef enum fw_geometry_set_rule {
    FW_SET_OR,
    FW_SET_AND,
    FW_SET_NOT,
    FW_SET_XOR
} fw_geometry_set_rule;
/* p OR q, p AND q, p NOT q (what of p is not in q), p XOR q. Gaps and pieces of up to 1e-12 m are
   closed and dropped: outlines that share an edge leave nothing between them. */
fw_status fw_geometry_slices_combine(fw_arena *arena, fw_geometry_slices p, fw_geometry_slices q,
                                     fw_geometry_set_rule rule, fw_geometry_slices *out);

#endif
