/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OASIS files of one or several cells: the mask of a device, and the whole plate. */
#ifndef FW_MASK_OASIS_H
#define FW_MASK_OASIS_H
#include "mask/mask.h"

typedef struct fw_mask_oasis_place { /* of another cell, once or as an equally spaced array, dbu */
    int cell;
    int64_t x, y;
    int columns, rows;
    int64_t step_x, step_y; /* > 0 where there are several */
} fw_mask_oasis_place;

typedef struct fw_mask_oasis_cell {
    const char *name;
    const fw_mask *mask;              /* its polygons; NULL: none of its own */
    const fw_mask_oasis_place *place; /* (nplace) of cells that stand before this one */
    int nplace;
    const char **note; /* (nnote) lines of text on the documentation layer, from (x, y) by step */
    int nnote;
    int64_t note_x, note_y, note_step; /* dbu */
} fw_mask_oasis_cell;

/* children before parents, the top cell last; all masks have the layers of one table */
fw_status fw_mask_oasis_write(const fw_mask_table *table, bool rejected,
                              const fw_mask_oasis_cell *cell, int ncell, fw_text *out);

#endif
