/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outlines behind a cut as polygons in the cut's own frame, clipped to the block that is shown,
   and the walls that stand on them. Private to recipe/. */
#ifndef FW_RECIPE_BLOCK_H
#define FW_RECIPE_BLOCK_H
#include "recipe/profile.h"

typedef struct fw_spot { /* of an outline in the frame of the cut: x along it, y behind it; m */
    double x, y;
    bool open; /* the edge that ends here is no wall: the block's own side, or a joint of pieces */
} fw_spot;

typedef struct fw_ring {
    fw_spot *corner; /* (n) */
    int n;
} fw_ring;

typedef struct fw_rings {
    fw_ring *ring; /* (n) pieces, and holes in them: inside where the number of rings is odd */
    int n;
} fw_rings;

/* the structure with its edges so far outside the drawn ones, arcs within tolerance_m */
fw_status fw_block_rings(fw_slicer *slicer, double edge_m, double tolerance_m, fw_rings *rings);

typedef struct fw_wall { /* from a to b, material on its left; m */
    fw_spot a, b;
    int film;
} fw_wall;

/* Sorts walls of one height so that none is drawn before one that it hides. toward: unit vector in
   the plane to the eye. */
fw_status fw_walls_sort(fw_arena *arena, fw_wall *wall, int n, double toward_x, double toward_y);

#endif
