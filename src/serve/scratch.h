/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server's directory for its jobs, below $TMPDIR or /tmp, for the owner alone. A lock in it
   says that its server lives: what a killed one left, the next one removes. Private to the room. */
#ifndef FW_SERVE_SCRATCH_H
#define FW_SERVE_SCRATCH_H
#include "base/diag.h"

typedef struct fw_serve_scratch fw_serve_scratch;

fw_status fw_serve_scratch_open(fw_arena *arena, fw_diags *diags, fw_serve_scratch **scratch);
void fw_serve_scratch_close(fw_serve_scratch *scratch); /* with all that is in it; NULL allowed */
/* a new directory in it: its descriptor, or -1 */
int fw_serve_scratch_make(fw_serve_scratch *scratch, const char *name);
/* where it is, from the root */
const char *fw_serve_scratch_path(fw_arena *arena, const fw_serve_scratch *scratch,
                                  const char *name);
/* open.html, for the owner alone, which leads to the address: a command line would show its token
   to every user of the machine. Its path, NULL when it cannot be written. */
const char *fw_serve_scratch_page(fw_arena *arena, fw_serve_scratch *scratch, const char *url);
void fw_serve_scratch_drop_page(fw_serve_scratch *scratch); /* it has served */
void fw_serve_scratch_remove(fw_serve_scratch *scratch, const char *name);

#endif
