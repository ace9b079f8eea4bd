/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells of a wafer that no device file describes, the lists they go into, and what its files say of
   it in words. Private to the room. */
#ifndef FW_WAFER_WAFER_PARTS_H
#define FW_WAFER_WAFER_PARTS_H
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
    fw_layout_role role; /* of lettering, bars and crosses beside the dies */
    fw_layout_piece *piece;
    int npiece, capacity;
    const fw_layout_cell *cell; /* (ncell) among them */
    int ncell;
} fw_wafer_sheet;
/* as_read: other plates than the device's are drawn as they are read, without what an etch takes */
fw_status fw_wafer_sheet_mask(fw_wafer_sheet *sheet, const char *name, bool as_read,
                              const fw_mask **mask);
bool fw_wafer_draws(const fw_mask_table *table, fw_layout_role role);

/* m to the nearest place on the grid */
int64_t fw_wafer_dbu(double m);

/* wafer_cells.c */
enum { FW_WAFER_LONGEST_NAME = 32 };
fw_status fw_wafer_add_cell(fw_wafer_maker *m, const char *name, const fw_mask *mask, int32_t dx,
                            int32_t dy, int *cell);
/* arrays of equal cells in every row; cell_of[i]: of site i, -1: none */
fw_status fw_wafer_add_rows(fw_wafer_maker *m, const int *cell_of);

/* wafer_marks.c, wafer_cells.c */
fw_status fw_wafer_plate(fw_wafer_maker *m);
fw_status fw_wafer_alignment_mask(fw_wafer_maker *m, const fw_mask **mask);
fw_status fw_wafer_ids(fw_wafer_maker *m);

/* ---- what the files of a wafer say of it: wafer_facts.c ---- */

/* lines "key=value" for the documentation layer, ASCII */
fw_status fw_wafer_notes(fw_arena *arena, const fw_wafer *wafer, const char ***line, int *count);
/* "arc = 220 deg, link = 120 um"; "" without sweeps */
const char *fw_wafer_values(fw_arena *arena, const fw_wafer *wafer, const fw_wafer_variant *v);
/* of one sweep, in its unit */
double fw_wafer_value(const fw_wafer *wafer, const fw_wafer_variant *v, int sweep);
const char *fw_wafer_kind_text(fw_wafer_kind kind);
/* are the dies of this variant the stand-in's? */
bool fw_wafer_stood_in(const fw_wafer_variant *v);

typedef struct fw_wafer_sum { /* of one layer over the whole plate */
    double polygons, vertices, area_m2, width_m, space_m;
    double over_m2;  /* of that area, what lies over the wafer */
    bool unfinished; /* as in fw_mask_measure */
} fw_wafer_sum;
fw_status fw_wafer_sums(const fw_wafer *wafer, fw_arena *arena, fw_wafer_sum **sum);
/* the die whose middle is nearest to a point, not one of those before; NULL: none is left */
const fw_wafer_site *fw_wafer_nearest_die(const fw_wafer *wafer, double x, double y,
                                          const fw_wafer_site *const *before, int n);
/* of all that is drawn: the fiducials stand outermost, without them the places do */
fw_geometry_box fw_wafer_extent(const fw_wafer *wafer);

#endif
