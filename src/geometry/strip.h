/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A strip: straight pieces and arcs one after the other, tangent to each other, each as wide as
   stated at its start, middle and end. Its two edges are exact: through those three points runs a
   circular arc (a line where they lie on one), and the width anywhere follows from the edges. */
#ifndef FW_GEOMETRY_STRIP_H
#define FW_GEOMETRY_STRIP_H
#include "geometry/contour.h"

enum { FW_STRIP_MOST = 64 }; /* pieces */

typedef struct fw_geometry_strip_piece {
    double length_m, curvature_per_m; /* of the centre line; > 0: turns to the left */
    double width_m[3];                /* across it, at the start, in the middle, at the end */
} fw_geometry_strip_piece;

/* one piece with its edges in its own frame: the start at the origin, running along +x */
typedef struct fw_geometry_strip_side {
    bool line, concentric;
    fw_geometry_vec2 a, centre; /* line: a point; else the circle's centre */
    fw_geometry_vec2 along;     /* line: unit vector */
    double radius_m;            /* of the circle */
    double sweep_rad;           /* from the start of the piece to its end, signed; 0: line */
} fw_geometry_strip_side;

typedef struct fw_geometry_strip_shape {
    fw_geometry_strip_piece piece;
    bool uniform;
    fw_geometry_strip_side side[2]; /* left, right of the direction of travel */
} fw_geometry_strip_shape;

/* pose at s_m behind `start` on a centre line of constant curvature */
fw_geometry_pose fw_geometry_strip_along(fw_geometry_pose start, double curvature_per_m,
                                         double s_m);
fw_geometry_pose fw_geometry_strip_end(const fw_geometry_strip_piece *piece, int n,
                                       fw_geometry_pose start);
double fw_geometry_strip_length(const fw_geometry_strip_piece *piece, int n);
/* the other way round and mirrored about the line of travel's start: the same strip as seen by one
   who comes from its end and holds the paper from behind */
void fw_geometry_strip_turned(const fw_geometry_strip_piece *piece, int n,
                              fw_geometry_strip_piece *out);

void fw_geometry_strip_shape_of(const fw_geometry_strip_piece *piece,
                                fw_geometry_strip_shape *shape);
/* width across the centre line, and how far the middle between the edges lies to its left; NaN
   where an edge does not cross the normal */
double fw_geometry_strip_width(const fw_geometry_strip_shape *shape, double s_m);
double fw_geometry_strip_aside(const fw_geometry_strip_shape *shape, double s_m);
/* edge from start to end of a piece that starts at a pose; 0 left, 1 right */
fw_geometry_segment fw_geometry_strip_edge(const fw_geometry_strip_shape *shape,
                                           fw_geometry_pose start, int side);
/* least and greatest width of a piece; NaN as above */
void fw_geometry_strip_widths(const fw_geometry_strip_shape *shape, double *least_m,
                              double *most_m);

/* do two pieces' edges meet other than at a joint of neighbours? *i < *j: which */
bool fw_geometry_strip_crosses(const fw_geometry_strip_piece *piece, int n, int *i, int *j);

#endif
