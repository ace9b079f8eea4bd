/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the GDSII and SVG writers for files of several cells. A GDSII library is begin, then for
   each cell, children before parents, cell_begin, its content, cell_end, then end. */
#ifndef FW_MASK_STREAM_H
#define FW_MASK_STREAM_H
#include "mask/mask.h"

void fw_gds_begin(fw_text *out, const char *library);
void fw_gds_cell_begin(fw_text *out, const char *name);
void fw_gds_shapes(fw_text *out, const fw_mask *mask);
void fw_gds_cell_end(fw_text *out);
void fw_gds_end(fw_text *out);

/* the outlines of one layer as <path>s, um, y downwards from `upper_left` (m) */
void fw_svg_paths(const fw_mask *mask, int layer, fw_vec2 upper_left, fw_text *out);

#endif
