/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells of a wafer that no device file describes, and the lists they go into. Private to the room.
 */
#ifndef FW_WAFER_PARTS_H
#define FW_WAFER_PARTS_H
#include "wafer/wafer.h"

typedef struct fw_wafer_maker {
    fw_arena *arena;
    const fw_wafer_input *input;
    fw_diags *diags;
    fw_wafer *wafer;
    int cells, runs; /* capacities */
} fw_wafer_maker;

/* a list of pieces that becomes a mask with the bias and the rules of the flow */
typedef struct fw_wafer_sheet {
    fw_wafer_maker *maker;
    fw_layout_piece *piece;
    int npiece, capacity;
} fw_wafer_sheet;
fw_status fw_wafer_sheet_mask(fw_wafer_sheet *sheet, const char *name, const fw_mask **mask);
fw_status fw_wafer_sheet_add(fw_wafer_sheet *sheet, fw_layout_role role, const char *label,
                             const fw_geometry_vec2 *point, int n);
bool fw_wafer_draws(const fw_mask_table *table, fw_layout_role role);

/* wafer_cells.c */
fw_status fw_wafer_add_cell(fw_wafer_maker *m, const char *name, const fw_mask *mask, int32_t dx,
                            int32_t dy, int *cell);
fw_status fw_wafer_add_run(fw_wafer_maker *m, fw_wafer_run run);
/* arrays of equal cells in every row; cell_of[i]: of site i, -1: none */
fw_status fw_wafer_add_rows(fw_wafer_maker *m, const int *cell_of);

/* wafer_marks.c, wafer_ids.c */
fw_status fw_wafer_plate(fw_wafer_maker *m);
fw_status fw_wafer_alignment_mask(fw_wafer_maker *m, const fw_mask **mask);
fw_status fw_wafer_ids(fw_wafer_maker *m);

#endif
