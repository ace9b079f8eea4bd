/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the writers of files have for files of several cells, as a wafer's, and for programs that
   write more polygons than they hold. */
#ifndef FW_MASK_MASK_WRITERS_H
#define FW_MASK_MASK_WRITERS_H
#include "mask/mask.h"

/* ---- GDSII and SVG in parts ---- */
/* Parts of the GDSII and SVG writers for files of several cells, and for programs that write more
   polygons than they hold: what stands in the text may be taken out (length = 0) between two calls.
   A library is begin, then for each cell, children before parents, cell_begin, its content,
   cell_end, then end. */

void fw_mask_gds_begin(fw_text *out, const char *library);
void fw_mask_gds_cell_begin(fw_text *out, const char *name);
void fw_mask_gds_shapes(fw_text *out, const fw_mask *mask);
void fw_mask_gds_cell_end(fw_text *out);
void fw_mask_gds_end(fw_text *out);

/* the outlines of one layer as <path>s, um, y downwards from `upper_left` (m); one that is another
   one moved as a <use> of it */
void fw_mask_svg_paths(const fw_mask *mask, int layer, fw_geometry_vec2 upper_left, fw_text *out);

/* References to other cells and lines of text, for GDSII libraries of several cells (mask_writers.h). */

/* columns and rows at most 32767; both 1: a plain reference (SREF), else an array (AREF) whose
   corners divide by columns and rows exactly */
void fw_mask_gds_array(fw_text *out, const char *cell, fw_geometry_point at, int columns, int rows,
                       fw_geometry_point step);
void fw_mask_gds_note(fw_text *out, const fw_mask_layer *layer, fw_geometry_point at,
                      const char *line);

/* OASIS files of one or several cells: the mask of a device, and the whole plate. */

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

/* The lines "key=value" that a mask says about itself, shared by the writers. */

enum { FW_MASK_NOTE_MOST = 512 };
/* one line, "key=value" or the value alone where the key is ""; other bytes than ASCII become '?':
   two of the common readers stop at them */
fw_status fw_mask_note(fw_arena *arena, const char *key, const char *value, const char **line);
/* ASCII, at most 512 characters each, in a fixed order, from the writer's arena */
fw_status fw_mask_notes(fw_arena *arena, const fw_mask *mask, const char ***line, int *count);
/* index of the documentation layer, or -1 */
int fw_mask_notes_layer(const fw_mask_table *table);

#endif
