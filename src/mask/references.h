/* SPDX-License-Identifier: GPL-3.0-or-later */
/* References to other cells and lines of text, for GDSII libraries of several cells (stream.h). */
#ifndef FW_MASK_REFERENCES_H
#define FW_MASK_REFERENCES_H
#include "mask/mask.h"

/* columns and rows at most 32767; both 1: a plain reference (SREF), else an array (AREF) whose
   corners divide by columns and rows exactly */
void fw_mask_gds_array(fw_text *out, const char *cell, fw_geometry_point at, int columns, int rows,
                       fw_geometry_point step);
void fw_mask_gds_note(fw_text *out, const fw_mask_layer *layer, fw_geometry_point at,
                      const char *line);

#endif
