/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mask as the shop writes it: the layers of the order joined to one, mirrored where asked for. */
#ifndef FW_MASK_MASK_MERGE_H
#define FW_MASK_MASK_MERGE_H
#include "mask/mask.h"

typedef struct fw_mask_window { /* dbu, in coordinates of the cell; x1 <= x0: none */
    int32_t x0, y0, x1, y1;
} fw_mask_window;

typedef struct fw_mask_merge_options {
    const fw_mask_table *written; /* of one layer: fw_mask_written_table */
    fw_mask_window window;        /* a part of the cell that another cell draws */
    int under; /* -1: the window is left out; else this is the other cell: all that lies in the window,
                     where layer `under` of the mask's table is whole */
    bool mirror;  /* x becomes -x */
    int vertices; /* most of a polygon */
} fw_mask_merge_options;

typedef struct fw_mask_merge_sums { /* added up over calls, each so many times */
    double polygons, vertices, cuts, holes, area_m2;
    int rounded;
} fw_mask_merge_sums;

/* The plate's expression over the polygons of a mask (fw_geometry_merge), as a mask of one layer whose
   writers are those of any other. FW_LIMIT: coordinates of more than 268 mm, or more layers in the
   expression than FW_MERGE_SETS - 1. FW_GEOMETRY: a polygon that is not simple, or has too many vertices
   and no cut. Test: tests/accept/wafer.sh, against KLayout */
fw_status fw_mask_merged(fw_arena *arena, const fw_mask *mask, const fw_mask_merge_options *options,
                         const fw_mask **out, fw_mask_merge_sums *sums);
/* the one layer: number and name of the laboratory for "plate", else those of the first layer of the
   order, and its tone */
fw_status fw_mask_written_table(fw_arena *arena, const fw_mask_table *table,
                                const fw_mask_table **out);

#endif
