/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Release holes of one body while they are made. Private to layout/release*.c. */
#ifndef FW_LAYOUT_RELEASE_GRID_H
#define FW_LAYOUT_RELEASE_GRID_H
#include "layout/draw.h"

typedef struct fw_layout_release_grid {
    fw_layout_drawing *d;
    int body;
    const char *label;
    fw_geometry_contour outline; /* as it is now */
    fw_geometry_contour before;  /* without holes */
    fw_geometry_box box;         /* of that */
    fw_geometry_vec2 origin, x, y;
    double pitch_m, hole_m, rim_m; /* hole: diameter */
    fw_geometry_vec2 *hole;        /* (nhole) middles of those made */
    int nhole, room;
    fw_geometry_vec2 far; /* the farthest place for which no cut was found, */
    double far_m;         /* and how far from an opening it stays; 0: none */
} fw_layout_release_grid;
typedef fw_layout_release_grid grid;

fw_status fw_layout_note_hole(grid *g, fw_geometry_vec2 middle);
/* holes where the grid has left any point too far from an opening: heads, necks, ends of bars (release_rest.c) */
fw_status fw_layout_release_rest(grid *g);

#endif
