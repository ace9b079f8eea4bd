/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lines "key=value" that a mask says about itself, shared by the writers. */
#ifndef FW_MASK_MASK_NOTES_H
#define FW_MASK_MASK_NOTES_H
#include "mask/mask.h"

enum { FW_MASK_NOTE_MOST = 512 };
/* one line, "key=value" or the value alone where the key is ""; other bytes than ASCII become '?':
   two of the common readers stop at them */
fw_status fw_mask_note(fw_arena *arena, const char *key, const char *value, const char **line);
/* ASCII, at most 512 characters each, in a fixed order, from the writer's arena */
fw_status fw_mask_notes(fw_arena *arena, const fw_mask *mask, const char ***line, int *count);
/* index of the documentation layer, or -1 */
int fw_mask_notes_layer(const fw_mask_table *table);

#endif
