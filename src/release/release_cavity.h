/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hollows in a carrier below what moves, and the ground that is left below what is held: for layers that are bonded
   to a carrier and are free where it is hollow, not where an etch has run below them.

   On square cells of a step s. A cell is hollow where one that a moving part touches is within k = ceil(margin/s) columns
   and rows; gaps of ground narrower than the wall are hollow too. So every point of what moves is at least the margin inside,
   and no more than 2 s farther than that; every edge of the outlines between two corners that point outward is longer
   than twice the margin. Theory: docs/theory/plates.md. */
#ifndef FW_RELEASE_RELEASE_CAVITY_H
#define FW_RELEASE_RELEASE_CAVITY_H
#include "release/release.h"

typedef struct fw_release_cavity_asked {
    double margin_m; /* around everything that moves */
    double wall_m;   /* ground narrower than this between two hollows does not stand */
    double step_m;
    bool drawn_only; /* the outlines alone: neither ground nor the widest square is asked for */
} fw_release_cavity_asked;

typedef struct fw_release_ground { /* below a part that must stay */
    const char *label;
    fw_layout_role role;
    int body;
    double area_m2;         /* of the part */
    double bonded_m2;       /* of it on ground: cells that lie in it whole */
    fw_geometry_box square; /* the largest on ground; x0 = x1: it stands on nothing */
} fw_release_ground;

typedef struct fw_release_cavity {
    fw_geometry_region hollow; /* outlines without their holes, counter-clockwise */
    fw_geometry_region land;   /* the holes, counter-clockwise: ground within a hollow */
    fw_release_ground *ground; /* (nground) */
    int nground;
    double area_m2;         /* hollow */
    fw_geometry_box widest; /* the largest square within it */
} fw_release_cavity;

/* Of a layout that is drawn. A hollow within a land within a hollow is joined with the outer one: the land goes, and
   what stands on it has no ground. Cost: cells times parts. Test: test_cavity.c, against distances to the exact outlines.
   FW_LIMIT: a step too fine for the drawing */
fw_status fw_release_cavity_make(fw_arena *arena, const fw_layout *layout,
                                 const fw_release_cavity_asked *asked, fw_release_cavity *cavity);

/* the largest square within part i of the drawing that keeps clear_m from its edges and from lettering and marks upon it, to
   a step; x0 = x1: there is none */
fw_status fw_release_square_in(fw_arena *arena, const fw_layout *layout, int piece, double clear_m,
                               double step_m, fw_geometry_box *square);

#endif
