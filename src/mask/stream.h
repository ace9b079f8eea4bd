/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the GDSII and SVG writers for files of several cells, and for programs that write more
   polygons than they hold: what stands in the text may be taken out (length = 0) between two calls.
   A library is begin, then for each cell, children before parents, cell_begin, its content,
   cell_end, then end. */
#ifndef FW_MASK_STREAM_H
#define FW_MASK_STREAM_H
#include "mask/mask.h"

void fw_mask_gds_begin(fw_text *out, const char *library);
void fw_mask_gds_cell_begin(fw_text *out, const char *name);
void fw_mask_gds_boundary(fw_text *out, const fw_mask_layer *layer,
                          const fw_geometry_polygon *polygon);
void fw_mask_gds_shapes(fw_text *out, const fw_mask *mask);
void fw_mask_gds_cell_end(fw_text *out);
void fw_mask_gds_end(fw_text *out);

/* the outlines of one layer as <path>s, um, y downwards from `upper_left` (m); one that is another
   one moved as a <use> of it */
void fw_mask_svg_paths(const fw_mask *mask, int layer, fw_geometry_vec2 upper_left, fw_text *out);
/* (nshape) the first shape that each one of the layer repeats, -1: none */
fw_status fw_mask_svg_repeats(fw_arena *arena, const fw_mask *mask, int layer,
                              fw_geometry_vec2 upper_left, int **out);

#endif
