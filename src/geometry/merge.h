/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Booleans of polygons on the grid, in whole numbers: what lies on several layers becomes one layer of
   simple polygons that do not overlap. Nothing is flattened and nothing moves but where edges of the
   input cross between points of the grid: there the crossing is rounded to the grid, and what passes
   through a rounded point is led through it. */
#ifndef FW_GEOMETRY_MERGE_H
#define FW_GEOMETRY_MERGE_H
#include "geometry/polygon.h"

enum { FW_MERGE_SETS = 16 };

typedef struct fw_geometry_merge_input { /* a polygon of one of the sets, in either direction */
    const fw_geometry_polygon *polygon;
    int set; /* 0 .. FW_MERGE_SETS - 1 */
} fw_geometry_merge_input;

typedef struct fw_geometry_merge_term { /* sets are joined from the left; the first: OR */
    int set;
    fw_geometry_set_rule rule;
} fw_geometry_merge_term;

typedef struct fw_geometry_merged {
    /* (n) simple, counter-clockwise, no straight vertices but at cuts */
    fw_geometry_polygon *polygon;
    int n;
    int outlines, holes; /* of the region that they cover */
    int cuts;     /* edges that two polygons share: where a hole, or too many vertices, needs it */
    double cut_m; /* their length in all */
    double
        clear_m; /* least distance of one from a vertex that it does not end at; INFINITY: none */
    int rounded; /* crossings that were not on the grid */
    int64_t area2_dbu; /* twice the area */
    int vertices;      /* of all polygons */
} fw_geometry_merged;

/* The region of the terms: of each set what its polygons cover, overlaps counted once.

   In: polygons with |coordinate| < 2^28 dbu (268 mm; else FW_LIMIT), terms, most: vertices of a polygon
   that is put together of pieces (>= 8; a piece that needs no cut may have more). Out: polygons in a
   fixed order. Exact, but for crossings between points of the grid: each is rounded by at most 0.5 dbu
   in x and y, and an edge that is led through a rounded point moves there by at most 0.71 dbu; `rounded`
   counts them. Cost: O((n + k) log n) for k crossings, but for lists that are moved at local extremes;
   where edges lie so close upon each other that it would be more than some seconds, FW_LIMIT. FW_CANCELLED as the arena says.

   Method: (1) snap rounding: every edge is cut at each vertex and rounded crossing whose square of 1 dbu
   it passes, after which edges meet at their ends only; (2) equal edges become one, and a sweep finds the
   winding number of every set below and above each; edges with the region on one side bound it;
   (3) diagonals between vertices cut the region into monotone polygons, so that none has a hole; (4) those
   that separate two polygons which would be simple together are left out, the longest first.
   Source: Hobby, Computational Geometry 13 (1999) 199 (snap rounding); Garey, Johnson, Preparata and
   Tarjan, Inf. Proc. Letters 7 (1978) 175 (monotone parts). Test: test_merge.c; KLayout's booleans in
   tests/accept/wafer.sh. */
fw_status fw_geometry_merge(fw_arena *arena, const fw_geometry_merge_input *input, int ninput,
                            const fw_geometry_merge_term *term, int nterm, int most,
                            fw_geometry_merged *out);

/* The same region as it is bounded: closed lines, each counter-clockwise, and in how many others each lies: outlines of what is covered have 0, 2, ..., holes 1, 3, ... Of a depth of FW_MERGE_SETS or more: FW_LIMIT. */
fw_status fw_geometry_merge_loops(fw_arena *arena, const fw_geometry_merge_input *input, int ninput,
                                  const fw_geometry_merge_term *term, int nterm,
                                  fw_geometry_polygon **loop, int **depth, int *n);

/* ---- between the files of the room ---- */

typedef struct fw_geometry_merge_edge { /* low before high, by x, then y */
    fw_geometry_point low, high;
    int set, times; /* +1: runs from low to high */
} fw_geometry_merge_edge;

typedef struct fw_geometry_merge_edges {
    fw_geometry_merge_edge *edge; /* (n) */
    int n, capacity;
} fw_geometry_merge_edges;

static inline int64_t fw_geometry_merge_key(fw_geometry_point p) {
    return (int64_t)p.x_dbu * ((int64_t)1 << 32) + p.y_dbu;
}

/* edges cut so that they meet at their ends only */
fw_status fw_geometry_merge_nodes(fw_arena *arena, const fw_geometry_merge_edges *in,
                                  fw_geometry_merge_edges *out, int *rounded);

typedef struct fw_geometry_merge_side { /* an edge from a to b with the region on its left */
    fw_geometry_point a, b;
    bool cut; /* a diagonal: its other side is there, too */
    int twin; /* index of that; else -1 */
} fw_geometry_merge_side;

typedef struct fw_geometry_merge_sides {
    fw_geometry_merge_side *side; /* (n) */
    int n, capacity;
} fw_geometry_merge_sides;
fw_status fw_geometry_merge_add_side(fw_arena *arena, fw_geometry_merge_sides *list,
                                     fw_geometry_merge_side side);

/* closed lines of sides: next[i] of each, as the region's border runs on; sorts the sides by where
   they start */
fw_status fw_geometry_merge_follow(fw_arena *arena, fw_geometry_merge_sides *sides, int **next);
/* the sides that bound the region of the terms, without straight vertices */
fw_status fw_geometry_merge_border(fw_arena *arena, const fw_geometry_merge_edges *edges,
                                   const fw_geometry_merge_term *term, int nterm,
                                   fw_geometry_merge_sides *out, int *outlines, int *holes);
/* adds diagonals, so that every part is monotone in x */
fw_status fw_geometry_merge_monotone(fw_arena *arena, fw_geometry_merge_sides *sides);
/* takes out diagonals that need not be, and lists the polygons */
fw_status fw_geometry_merge_parts(fw_arena *arena, fw_geometry_merge_sides *sides, int most,
                                  fw_geometry_merged *out);

#endif
