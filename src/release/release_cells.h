/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Square cells over a drawing: which of them a part covers or touches, sets of them grown and closed, and the outlines of
   such a set. For what need not follow a drawing to the nanometre: hollows in the carrier, places of bond and metal. */
#ifndef FW_RELEASE_RELEASE_CELLS_H
#define FW_RELEASE_RELEASE_CELLS_H
#include "layout/layout.h"

typedef struct fw_release_cells {
    fw_geometry_vec2 from; /* lower left corner, a multiple of the step */
    double step_m;
    int columns, rows;
} fw_release_cells;

/* of a box with room around it; FW_LIMIT: more than 16 million cells */
fw_status fw_release_cells_over(fw_geometry_box box, double room_m, double step_m,
                                fw_release_cells *cells);
/* a set: one byte a cell, row by row from below */
fw_status fw_release_cells_set(fw_arena *arena, const fw_release_cells *cells, unsigned char **set);

/* adds the cells that an outline may touch: none that it touches is missing, none is added whose middle is farther than a
   step from it */
void fw_release_cells_touch(const fw_release_cells *cells, const fw_geometry_contour *outline,
                            unsigned char *set);
/* adds the cells with their middle in the outline that are not in `edge`, a set that holds all that the outline touches */
fw_status fw_release_cells_inside(fw_arena *arena, const fw_release_cells *cells,
                                  const fw_geometry_contour *outline, const unsigned char *edge,
                                  unsigned char *set);
/* every cell within k columns and rows of one of the set; k < 0: away from those that are not in it */
fw_status fw_release_cells_grow(fw_arena *arena, const fw_release_cells *cells, int k,
                                unsigned char *set);
/* the largest square within the set, the first from below; side 0: the set is empty */
fw_status fw_release_cells_square(fw_arena *arena, const fw_release_cells *cells,
                                  const unsigned char *set, fw_geometry_box *square);
/* numbers of connected parts (over edges) of the cells whose byte is `value`, from 1; others 0 */
fw_status fw_release_cells_label(fw_arena *arena, const fw_release_cells *cells,
                                 const unsigned char *set, unsigned char value, int **label,
                                 int *count);
/* outlines of the set, counter-clockwise around it and clockwise around its holes; no two of its cells may touch in a
   corner alone */
fw_status fw_release_cells_outlines(fw_arena *arena, const fw_release_cells *cells,
                                    const unsigned char *set, fw_geometry_region *outlines);

#endif
