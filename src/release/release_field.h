/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The edges of everything drawn, and the boxes in which the field of distances is searched. Private to
   release/. */
#ifndef FW_RELEASE_RELEASE_FIELD_H
#define FW_RELEASE_RELEASE_FIELD_H
#include "base/constants.h"
#include "geometry/segment.h"
#include "release/release.h"

/* beside the numbers of parts */
enum { FW_RELEASE_OPENING = -1, FW_RELEASE_MIXED = -2, FW_RELEASE_SEVERAL = -3 };

/* a line or an arc; what a foot on an arc needs is known beforehand, so that no angle is computed */
typedef struct fw_release_edge {
    fw_geometry_vec2 a, b, centre;
    fw_geometry_vec2 along;  /* line: unit, from a to b */
    double length;           /* of the chord */
    fw_geometry_vec2 middle; /* arc: unit, from the centre to the middle of the arc */
    double radius, cosine;   /* arc: of half its sweep; radius 0: a line */
    fw_geometry_vec2 about;  /* of a circle around the edge, */
    double around;           /* and its radius */
    int part;  /* of what it bounds; of lettering: of what it is cut out of, FW_RELEASE_SEVERAL */
    bool open; /* beside it the layer is cut; false: a seam between two pieces */
} fw_release_edge;

/* a part of an edge that runs up or down all along, for the count of crossings */
typedef struct fw_release_climb {
    double y0, y1;         /* y0 < y1 */
    double x0, x1;         /* at those, of a line */
    double cx, cy, radius; /* of an arc; radius 0: a line */
    double side;           /* of an arc: +1 right of its centre, -1 left of it */
    double x_most;         /* no point of it lies farther right */
    int part, way;         /* way +1: it runs up */
} fw_release_climb;

typedef struct fw_release_box {
    double x, y, half_m; /* middle; half a side */
    int first, count;    /* its edges in the list of its level */
    int part;            /* FW_RELEASE_MIXED: an edge or a seam runs through it */
    double near_m;       /* distance of its middle from the nearest open edge */
} fw_release_box;

typedef struct fw_release_level { /* boxes of one size */
    double *far_m;                /* (far_room) distances while a box is made */
    size_t far_room;
    fw_release_box *box;
    int *list;
    int nbox, nlist;
    size_t box_room, list_room;
} fw_release_level;

typedef struct fw_release_field {
    fw_arena *arena;
    fw_release_edge *edge; /* (nedge) */
    int nedge;
    fw_release_climb *climb; /* (nclimb) */
    int nclimb, npart;
    fw_geometry_box box;
    int *first, *listed; /* climbs by height: of bin i those from first[i] to first[i + 1] */
    int bins;
    double bin_m, behind_m; /* climb: from right to left, but for what is nearer than behind_m */
    /* (npart + 1) of a question: lettering, then the parts; winding 0 and met false between two */
    int *winding, *touched;
    bool *met;
    fw_release_level start; /* boxes over all that is not opening: every search begins with them */
} fw_release_field;

/* part_of: (layout->npiece) number of the part, FW_RELEASE_OPENING for lettering, else
   FW_RELEASE_MIXED: it is not there */
fw_status fw_release_field_make(fw_arena *arena, const fw_layout *layout, const int *part_of,
                                int npart, fw_release_field *field);
/* which part lettering is cut out of: edge[].part of its edges, which is FW_RELEASE_OPENING before */
void fw_release_field_hosts(fw_release_field *field, const fw_layout *layout, const int *part_of);
/* the part whose material is at p; FW_RELEASE_OPENING: none */
int fw_release_field_part(fw_release_field *field, fw_geometry_vec2 p);
/* The crossings of a row between x0 and x1, from left to right; how many. row: (nclimb + 1), of which the one
   behind the last stands for what is right of it. */
typedef struct fw_release_crossing {
    double x;
    int edge_part, way; /* of its climb; edge_part 0: lettering, 1 and more: the parts */
    int part;           /* whose material is on the left of it, as far as the one before */
} fw_release_crossing;
int fw_release_field_row(fw_release_field *field, double y, double x0, double x1,
                         fw_release_crossing *row);
/* Distance of a point from a line or an arc. Of an arc: | |p - c| - R | where p lies in the sector of
   the arc, which the direction to its middle and the cosine of half its sweep tell, else the nearer
   end. In: edge, point (m). Out: distance (m). Error: a few ulp of the coordinates. Cost: at most two
   square roots. Test: test_reach_field.c, distances_are_those_of_geometry. */
static inline double fw_release_edge_distance(const fw_release_edge *e, fw_geometry_vec2 p) {
    fw_geometry_vec2 from = vec_sub(p, e->a);
    if (e->radius == 0.0) {
        double t = vec_dot(from, e->along);
        if (t <= 0.0) return vec_length(from);
        return t >= e->length ? vec_distance(p, e->b) : fabs(vec_cross(e->along, from));
    }
    fw_geometry_vec2 ray = vec_sub(p, e->centre), to = vec_sub(p, e->b);
    double length = vec_length(ray);
    if (vec_dot(ray, e->middle) >= e->cosine * length) return fabs(length - e->radius);
    double to_a = vec_dot(from, from), to_b = vec_dot(to, to);
    return sqrt(to_a < to_b ? to_a : to_b);
}
/* its nearest point to p */
fw_geometry_vec2 fw_release_edge_foot(const fw_release_edge *e, fw_geometry_vec2 p);
/* the nearest open edge of a list (n) to a point that is surely no farther than most_m from it; HUGE_VAL:
   that is not known. Most edges are told by the circle around them. */
const fw_release_edge *fw_release_nearest(const fw_release_field *field, const int *list, int n,
                                          fw_geometry_vec2 p, double most_m, double *near_m);
/* Field->start: boxes of equal size over all that is not opening, each with the edges that may be nearest to
   any point of it, or run through it */
fw_status fw_release_field_start(fw_release_field *field);
/* the four quarters of a box, added to the next level; parts are kept where the box has one */
fw_status fw_release_level_split(const fw_release_field *field, const fw_release_level *level,
                                 const fw_release_box *box, fw_release_level *next);
/* finds the part of a box through which nothing runs; does nothing where it is known */
void fw_release_box_settle(fw_release_field *field, fw_release_box *box);
/* does anything of the list run through the circle about the box? */
bool fw_release_box_cut(const fw_release_field *field, const fw_release_level *level,
                        const fw_release_box *box);
/* no point of the box is farther from an opening */
double fw_release_box_most(const fw_release_field *field, const fw_release_level *level,
                           const fw_release_box *box, fw_geometry_vec2 *up, double *rise_m);
/* the same for what is left of a seam that alone runs through it; HUGE_VAL: not known */
double fw_release_box_side(const fw_release_field *field, const fw_release_level *level,
                           const fw_release_box *box, const fw_release_edge *seam);
/* radius of the circle about the box */
static inline double fw_release_box_about(const fw_release_box *box) {
    return FW_SQRT_2 * box->half_m;
}

/* (npart) worst points of the parts */
fw_status fw_release_search(fw_release_field *field, fw_release_part *part, int *boxes);
/* bonded_m2 of the parts that stay */
fw_status fw_release_measure(fw_release_field *field, fw_release_part *part);
/* pieces to parts: *part (*npart) named, with duties and areas */
fw_status fw_release_parts(fw_arena *arena, const fw_layout *layout, bool islands, int **part_of,
                           fw_release_part **part, int *npart);

#endif
