/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A text file that only grows: it is locked from reading to writing, a line is written in one piece
   and synced, and when that fails the file is as it was. */
#ifndef FW_BASE_APPEND_H
#define FW_BASE_APPEND_H
#include "base/diag.h"

typedef struct fw_append {
    const char *path;
    int fd;
    char *text; /* (n) what the file holds, NUL behind it */
    size_t n;
    fw_diags *diags;
} fw_append;

/* opens and locks (waits for another writer), makes the file when there is none, reads it: at most
   `most` bytes. FW-D220 to FW-D222 name the file. */
fw_status fw_append_open(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                         fw_append *file);
fw_status fw_append_text(fw_append *file, const char *text, size_t n);
void fw_append_close(fw_append *file); /* removes a file that it made and that is still empty */

#endif
