/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A GDSII stream in pieces: head, any number of boundaries, tail. Private to the room, and for
   programs that write more polygons than they hold: what stands in the text may be taken out of it
   (length = 0) between two pieces. */
#ifndef FW_MASK_GDS_H
#define FW_MASK_GDS_H
#include "mask/mask.h"

void fw_gds_head(const fw_mask *mask, fw_text *out); /* down to the name of the one cell */
void fw_gds_boundary(const fw_mask_layer *layer, const fw_polygon *polygon, fw_text *out);
void fw_gds_tail(fw_text *out);

#endif
