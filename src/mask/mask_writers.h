/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the writers of files share: the parts of a GDSII library, and the lines of text. */
#ifndef FW_MASK_MASK_WRITERS_H
#define FW_MASK_MASK_WRITERS_H
#include "mask/mask.h"

/* one writer for each line of formats.def: same mask, same bytes */
#define FW_MASK_FORMAT(name, ...) fw_status fw_mask_write_##name(const fw_mask *mask, fw_text *out);
#include "mask/formats.def"
#undef FW_MASK_FORMAT

/* A GDSII library for programs that write more polygons than they hold: what stands in the text may
   be taken out (length = 0) between two calls. A library is begin, then for each cell, children
   before parents, cell_begin, its content, cell_end, then end. */
void fw_mask_gds_begin(fw_text *out, const char *library);
void fw_mask_gds_cell_begin(fw_text *out, const char *name);
void fw_mask_gds_boundary(fw_text *out, const fw_mask_layer *layer,
                          const fw_geometry_polygon *polygon);
void fw_mask_gds_cell_end(fw_text *out);
void fw_mask_gds_end(fw_text *out);

/* The lines "key=value" that a mask says about itself, shared by the writers. */
enum { FW_MASK_NOTE_MOST = 512 };
/* one line, "key=value" or the value alone where the key is ""; other bytes than ASCII become '?':
   two of the common readers stop at them */
fw_status fw_mask_note(fw_arena *arena, const char *key, const char *value, const char **line);
/* ASCII, at most 512 characters each, in a fixed order, from the writer's arena */
fw_status fw_mask_notes(fw_arena *arena, const fw_mask *mask, const char ***line, int *count);
/* index of the documentation layer, or -1 */
int fw_mask_notes_layer(const fw_mask_table *table);

/* nets on the certificate; contacts on the order sheets, where something is driven (mask_wiring.c) */
void fw_mask_wiring_json(fw_json *json, const fw_mask *mask);
void fw_mask_wiring_order_json(fw_json *json, const fw_mask *mask);
fw_status fw_mask_wiring_order_text(const fw_mask *mask, fw_text *out);

#endif
