/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact outlines: closed lists of straight lines and circular arcs, in metres; and strips, whose edges are such.

   A contour is counter-clockwise where it bounds material and clockwise where it bounds a hole.
   Everything up to the mask keeps arcs as arcs; geometry/polygon.h flattens them last. */
#ifndef FW_GEOMETRY_CONTOUR_H
#define FW_GEOMETRY_CONTOUR_H
#include "base/constants.h"
#include "base/svg.h"
#include "base/arena.h"
#include "base/diag.h"
#include "base/status.h"
#include <stdbool.h>

typedef struct fw_geometry_vec2 {
    double x, y; /* m */
} fw_geometry_vec2;

typedef enum fw_geometry_segment_kind { FW_LINE, FW_ARC } fw_geometry_segment_kind;

enum {
    FW_SEGMENT_JOINT = 1, /* shared with the neighbouring piece: its end corners stay as they are */
    FW_SEGMENT_THROUGH = 16, /* besides: at either end the edge runs on in the neighbouring piece on
                                the same line or circle, not square to the joint */
    FW_SEGMENT_DRAWN = 32,   /* as somebody drew it: a corner between two of them stays */
    FW_SEGMENT_ROUNDED = 64, /* its ends were rounded to the grid of masks before it came to be */
};

typedef struct fw_geometry_segment {
    fw_geometry_segment_kind kind;
    unsigned flags;
    fw_geometry_vec2 a, b;   /* start, end */
    fw_geometry_vec2 centre; /* arc only */
    double radius;           /* arc only, > 0, m */
    double sweep_rad;        /* arc only, signed: > 0 counter-clockwise; 0 < |sweep| <= 2 pi */
} fw_geometry_segment;

typedef struct fw_geometry_contour {
    fw_geometry_segment *segment; /* (count), segment[i].b == segment[i+1].a bit for bit, cyclic */
    int count;
} fw_geometry_contour;

typedef struct
    fw_geometry_region {          /* outer contours counter-clockwise, holes clockwise, disjoint */
    fw_geometry_contour *contour; /* (count) */
    int count;
} fw_geometry_region;

/* rotation by angle_rad about the origin, then translation */
typedef struct fw_geometry_pose {
    double x_m, y_m, angle_rad;
} fw_geometry_pose;

typedef struct fw_geometry_box {
    double x0, y0, x1, y1; /* m */
} fw_geometry_box;

/* ---- building: start, then segments, then close (adds the closing line when needed) ---- */
typedef struct fw_geometry_outline {
    fw_arena *arena;
    fw_geometry_segment *segment;
    int count, capacity;
    fw_geometry_vec2 first, at;
    bool failed;  /* out of memory */
    bool invalid; /* an arc whose end is off its circle, or a number that is not finite */
} fw_geometry_outline;
fw_geometry_outline fw_geometry_outline_start(fw_arena *arena, fw_geometry_vec2 point);
void fw_geometry_outline_line(fw_geometry_outline *outline, fw_geometry_vec2 to, unsigned flags);
/* arc about `centre` through the signed sweep; the end point is computed,
   `fw_geometry_outline_arc_to` takes an end point already known so that neighbours share it bit for
   bit */
void fw_geometry_outline_arc(fw_geometry_outline *outline, fw_geometry_vec2 centre,
                             double sweep_rad, unsigned flags);
void fw_geometry_outline_arc_to(fw_geometry_outline *outline, fw_geometry_vec2 centre,
                                double sweep_rad, fw_geometry_vec2 to, unsigned flags);
fw_status fw_geometry_outline_close(fw_geometry_outline *outline, fw_geometry_contour *contour);

fw_status fw_geometry_contour_rectangle(fw_arena *arena, fw_geometry_box box,
                                        fw_geometry_contour *contour);
fw_status fw_geometry_contour_disc(fw_arena *arena, fw_geometry_vec2 centre, double radius_m,
                                   fw_geometry_contour *contour);
/* rectangle of `width` whose axis runs from p to q, square ends */
fw_status fw_geometry_contour_bar(fw_arena *arena, fw_geometry_vec2 p, fw_geometry_vec2 q,
                                  double width_m, fw_geometry_contour *contour);
/* the part of a ring between two radii, from angle0 through sweep > 0 */
fw_status fw_geometry_contour_ring_sector(fw_arena *arena, fw_geometry_vec2 centre, double inner_m,
                                          double outer_m, double angle0_rad, double sweep_rad,
                                          fw_geometry_contour *contour);

/* ---- measuring, all closed form ---- */
double fw_geometry_contour_area(const fw_geometry_contour *contour); /* m2, > 0 counter-clockwise */
double fw_geometry_contour_perimeter(const fw_geometry_contour *contour); /* m */
fw_geometry_box fw_geometry_contour_box(const fw_geometry_contour *contour);
double fw_geometry_contour_area_in(const fw_geometry_contour *contour,
                                   fw_geometry_box box); /* m2, where the box is known */
/* area, centroid and second moments about the centroid (m4), by Green's theorem: polar and, which way it is spread,
   the integral of (x^2 - y^2, 2 x y) */
typedef struct fw_geometry_moments {
    double area_m2;
    fw_geometry_vec2 centroid;
    double polar_m4;
    fw_geometry_vec2 spread_m4;
} fw_geometry_moments;
fw_geometry_moments fw_geometry_region_moments(const fw_geometry_region *region);
bool fw_geometry_contour_contains(const fw_geometry_contour *contour,
                                  fw_geometry_vec2 point); /* boundary: either answer */
/* least distance between two outlines, and where; 0 when they cross */
double fw_geometry_contour_distance(const fw_geometry_contour *p, const fw_geometry_contour *q,
                                    fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q);
/* the same where it is less than a limit; else the limit. Cost: pairs of segments whose boxes are
   nearer than that */
double fw_geometry_contour_distance_below(const fw_geometry_contour *p,
                                          const fw_geometry_contour *q, double limit_m,
                                          fw_geometry_vec2 *at_p, fw_geometry_vec2 *at_q);
/* an outline that many others are compared with */
enum { FW_GEOMETRY_BOXED_RUN = 8 };
typedef struct fw_geometry_boxed {
    const fw_geometry_contour *contour;
    const fw_geometry_box *box,
        *run; /* (count) of its segments, and around every FW_GEOMETRY_BOXED_RUN of them */
    fw_geometry_box whole;
} fw_geometry_boxed;
fw_status fw_geometry_contour_boxed(fw_arena *arena, const fw_geometry_contour *contour,
                                    fw_geometry_boxed *out); /* keeps the contour */
double fw_geometry_boxed_distance_below(const fw_geometry_contour *p, const fw_geometry_boxed *q,
                                        double limit_m, fw_geometry_vec2 *at_p,
                                        fw_geometry_vec2 *at_q);
/* least distance between segments of one outline that are not neighbours (space or width), with the
   indices of the two; `inside` true: through material (width), false: through the outside (space).
   Counted are chords between edges that face each other (outward normals more than 90 degrees
   apart) where neither end can slide along the outline to a shorter chord, past tangent joints too:
   so neither a rounded corner nor a step in an edge is a width. An arc of half a turn or more faces
   itself. JOINT segments are no edges. HUGE_VAL and -1, -1 when there is none. */
double fw_geometry_contour_clearance(const fw_geometry_contour *contour, bool inside, int *i,
                                     int *j);
/* the same where it is less than a limit; else the limit, and -1, -1. Cost: pairs of segments whose
   boxes are nearer than that */
double fw_geometry_contour_clearance_below(const fw_geometry_contour *contour, bool inside,
                                           double limit_m, int *i, int *j);
/* the same without pairs of segments that both have a flag of `except` */
double fw_geometry_contour_clearance_except(const fw_geometry_contour *contour, bool inside,
                                            double limit_m, unsigned except, int *i, int *j);

/* ---- changing ---- */
fw_status fw_geometry_contour_transform(fw_arena *arena, const fw_geometry_contour *contour,
                                        fw_geometry_pose pose, bool mirror_y,
                                        fw_geometry_contour *out); /* y -> -y first, stays ccw */
fw_status fw_geometry_contour_reverse(fw_arena *arena, const fw_geometry_contour *contour,
                                      fw_geometry_contour *out);
/* exact boolean of outlines in general position; coincident segments are allowed and merged.
   tolerance 1e-12 m. Result has no holes lost: outlines that touch themselves are split there.
   Outer outlines come first. FW_GEOMETRY: an operand is no closed outline, or edges run within a
   few 1e-12 m of each other without being the same to the tolerance and no consistent result was
   found (never a wrong one). */
typedef enum fw_geometry_boolean { FW_UNION, FW_DIFFERENCE, FW_INTERSECTION } fw_geometry_boolean;
fw_status fw_geometry_region_boolean(fw_arena *arena, const fw_geometry_region *p,
                                     const fw_geometry_region *q, fw_geometry_boolean op,
                                     fw_geometry_region *out);
/* rounds corners with tangent arcs: convex corners (material angle < 180) with `convex_m`, concave
   ones with `concave_m`; radius 0 leaves them. A corner next to a JOINT segment stays, and so does
   one between two DRAWN ones. A segment
   between two corners of one side that is too short for both (and shorter than the radius, turns up
   to 120 degrees together) is left out: the rounding touches its neighbours. Where neighbouring
   segments are else too short the radius shrinks, never below a quarter, else FW_GEOMETRY with the
   corner's place in *where; what stays of a segment is nothing or 200 nm. */
fw_status fw_geometry_contour_round(fw_arena *arena, const fw_geometry_contour *contour,
                                    double convex_m, double concave_m, fw_geometry_contour *out,
                                    fw_geometry_vec2 *where);
/* moves every segment outward by d (inward for d < 0) along its normal; lines and arcs stay lines
   and arcs. Convex corners are mitred up to 2 d, else joined by an arc; concave ones are
   intersected. JOINT segments stay where they are (they are cut lines, not edges): each end slides
   by d along the joint's own line, outward, to the same doubles for both pieces. A neighbour that
   leaves the joint square (or tangent to the other piece's edge) ends there; any other is led there
   along the square of the joint, exact when the other piece's edge is straight, else off by d^2 /
   2R of its radius. A joint that is also THROUGH slides to where its own line meets the moved
   edges, to 1e-15 m, which both pieces find alike. Two JOINT segments at one vertex, and an arc as
   a joint, are refused. Refuses (FW_GEOMETRY, the two segments in *i, *j) when the topology could
   change: a concave arc with radius <= d, or a clearance <= 2 d. */
fw_status fw_geometry_contour_offset(fw_arena *arena, const fw_geometry_contour *contour,
                                     double d_m, fw_geometry_contour *out, int *i, int *j);
/* likewise, where it is known that its clearance on the side that d closes is clear_m at least: that need not be
   looked for again */
fw_status fw_geometry_contour_offset_clear(fw_arena *arena, const fw_geometry_contour *contour,
                                           double d_m, double clear_m, fw_geometry_contour *out,
                                           int *i, int *j);

/* ---- strips ----

   A strip: straight pieces and arcs one after the other, tangent to each other, each as wide as
   stated at its start, middle and end. Its two edges are exact: through those three points runs a
   circular arc (a line where they lie on one), and the width anywhere follows from the edges. */

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

/* ---- as commands of an SVG path: lines and true arcs (contour.c) ----
   The y axis of SVG points down, so y is turned round here and not by a transform that importers may lose. */

typedef struct fw_geometry_sheet { /* from the plane to the picture */
    double x0_m, y1_m;             /* upper left corner of the picture */
    double per_m;                  /* user units per metre */
    int decimals;
    double most_rad; /* arcs are written in equal parts of at most so much turn, see below */
} fw_geometry_sheet;

/* A reader of SVG finds an arc's centre from its end points, which fails where they are equal and
   loses half the digits near a half turn. For pictures it is enough to split what is nearly a full
   turn; with a third of a turn nothing is lost, and the large-arc flag is never set. */
#define FW_GEOMETRY_ARC_PICTURE (1.8 * FW_PI)
#define FW_GEOMETRY_ARC_EXACT   (2.0 * FW_PI / 3.0)

/* how many parts an arc has, and where part i = 1 ... parts ends: the last one exactly at s->b */
int fw_geometry_arc_parts(const fw_geometry_segment *s, double most_rad);
fw_geometry_vec2 fw_geometry_arc_end(const fw_geometry_segment *s, int i, int parts);

/* the closed outline, for filling */
void fw_geometry_svg_contour(fw_text *out, const fw_geometry_sheet *sheet,
                             const fw_geometry_contour *c);
/* its edges alone, for a line: without the cuts between pieces (FW_SEGMENT_JOINT) */
void fw_geometry_svg_edges(fw_text *out, const fw_geometry_sheet *sheet,
                           const fw_geometry_contour *c);

#endif
