/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons on the integer grid (1 dbu = 1 nm): how outlines become them, and what is exact of them. */
#ifndef FW_GEOMETRY_POLYGON_H
#define FW_GEOMETRY_POLYGON_H
#include "geometry/contour.h"
#include <stdint.h>

/* ---- flattening ----

   Last of all: lines and arcs to a polygon on the grid.

   n = ceil(|sweep| / (2 acos(1 - eps/R))) chords per arc (fewer, with vertices off the arc, where
   areas are kept), all arcs start and end on exact joints; then each vertex is rounded to the grid
   (half up, the same for both pieces that share it). Bounds (docs/theory/contours.md): vertex error
   <= 0.707 g; edge error <= eps + 0.707 g; area error <= perimeter (eps + 0.707 g); arcs keep
   one-signed turns: for eps >= 1.42 g always, from 0.36 g on where that is proven of each arc. */

/* the database unit of masks, in which points of polygons are whole numbers */
#define FW_GEOMETRY_GRID_M 1e-9
typedef struct fw_geometry_point {
    int32_t x_dbu, y_dbu;
} fw_geometry_point;

typedef struct fw_geometry_polygon { /* closed, first vertex not repeated, counter-clockwise */
    fw_geometry_point *vertex;       /* (count) */
    int count;
} fw_geometry_polygon;

typedef enum fw_geometry_flattening {
    FW_FLATTEN_INSIDE,     /* vertices on the arc: a convex arc loses area, a hollow one gains it */
    FW_FLATTEN_EQUAL_AREA, /* inner vertices a little outside, so that the chords enclose what the
                              arc does; its ends stay */
} fw_geometry_flattening;

typedef struct fw_geometry_flat_bounds { /* proven of the polygon, rounding included */
    double edge_m;                       /* no point of an edge is farther from the outline */
    double area_m2;                      /* |area of the polygon - area of the outline| */
    int wavy; /* where nothing is proven (FW_GEOMETRY): the arc whose corners rounding turned */
    double next_m; /* and the tolerance that takes one chord less for it; else -1 */
} fw_geometry_flat_bounds;

/* below, chords between vertices on the grid cannot keep the sense of any long arc */
#define FW_LEAST_TOLERANCE_M 0.36e-9
/* above, a mask's chords would be seen; it may be this itself */
#define FW_MOST_TOLERANCE_M 1e-6
/* from here on they do whatever the arc is; between, it depends on radius, sweep and place */
#define FW_SAFE_TOLERANCE_M 1.42e-9

/* Flattens an outline. tolerance_m: farthest that a chord may be from its arc, at least
   FW_LEAST_TOLERANCE_M (else FW_INPUT), before rounding to the grid of 1e-9 m. Below
   FW_SAFE_TOLERANCE_M: FW_GEOMETRY where an arc's corners turn the wrong way (bounds->wavy). bounds
   may be NULL. For the rest see fw_geometry_tessellate. */
fw_status fw_geometry_flatten(fw_arena *arena, const fw_geometry_contour *contour,
                              double tolerance_m, fw_geometry_flattening kind,
                              fw_geometry_polygon *polygon, fw_geometry_flat_bounds *bounds);

/* What an outline with this segment has as vertices from its start to its end, both included: at
   (n), n = 2 of a line. Before vertices that repeat others or lie on a straight way are left out. */
fw_status fw_geometry_flatten_segment(fw_arena *arena, const fw_geometry_segment *segment,
                                      double tolerance_m, fw_geometry_flattening kind,
                                      fw_geometry_point **at, int *n);

/* the same with vertices on the arcs. tolerance_m is the sagitta eps; grid 1e-9 m. Vertices that
   lie exactly on the way between their neighbours are left out, except the ends of JOINT segments.
   A clockwise outline gives a clockwise polygon. FW_LIMIT: a coordinate of 2^30 or more;
   FW_GEOMETRY: fewer than three vertices are left. */
fw_status fw_geometry_tessellate(fw_arena *arena, const fw_geometry_contour *contour,
                                 double tolerance_m, fw_geometry_polygon *polygon);
/* twice the signed area in dbu^2, exact (|coordinate| < 2^30) */
int64_t fw_geometry_polygon_area2(const fw_geometry_polygon *polygon);

typedef struct fw_geometry_polygon_triangle { /* vertex numbers, counter-clockwise */
    int vertex[3];
} fw_geometry_polygon_triangle;
/* out: (count - 2) triangles that make a simple polygon, counter-clockwise, none of them flat */
fw_status fw_geometry_polygon_triangulate(fw_arena *arena, const fw_geometry_polygon *polygon,
                                          fw_geometry_polygon_triangle *out);

/* exact integer certificate of one polygon */
typedef struct fw_geometry_polygon_report {
    bool simple;      /* no crossing, touch, zero edge or spike */
    int bad_i, bad_j; /* the two edges, when not simple */
    double shortest_edge_m;
    double sharpest_rad; /* smallest interior or exterior corner angle */
    double sharpest_material_rad, sharpest_space_rad; /* interior, exterior ones; pi: none */
    bool acute;             /* a corner is below 90 degrees on one of its sides, exactly */
    int zero_edges, spikes; /* none of a simple polygon */
    int straight;           /* vertices exactly between their neighbours: ends of joints */
} fw_geometry_polygon_report;
fw_status fw_geometry_polygon_check(fw_arena *arena, const fw_geometry_polygon *polygon,
                                    fw_geometry_polygon_report *report);

/* ---- between the files of the room: the two exact answers to "is this polygon simple?" ---- */

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

/* ---- cuts ----

   A straight line through exact outlines: the intervals of the line that lie in material, and what
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
