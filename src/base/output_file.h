/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single files and their places, under sets of files (output.h). Private to the room. */
#ifndef FW_BASE_OUTPUT_FILE_H
#define FW_BASE_OUTPUT_FILE_H
#include "base/output.h"

/* FW_D222 with the reason in errno: FW_IO */
fw_status fw_output_failed(fw_diags *diags, const char *path, const char *what);
/* makes, writes, syncs and closes a file; false: errno says why */
bool fw_output_put(const char *path, const void *data, size_t n);
/* what has the two names gets the other's; both must be there. false: errno says why, and all is as
   it was. In one step where the file system can, else `spare` is the name of one of them for a
   moment. */
bool fw_output_exchange(const char *a, const char *b, const char *spare);
/* what a directory lists survives a power cut; false: errno says why */
bool fw_output_sync_directory(const char *path);
/* the directory that a path is in; NULL: out of memory */
const char *fw_output_parent(fw_arena *arena, const char *path);

#endif
