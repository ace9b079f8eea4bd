/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes and directories of the server's own. Private to the room. */
#ifndef FW_SERVE_CHILD_H
#define FW_SERVE_CHILD_H
#include "base/diag.h"
#include <stdint.h>
#include <sys/types.h>

/* ---- child.c: the same program, run again, with limits ----
   It knows no secret of the server (nothing is inherited but what is named here), and ends with the
   server. */

typedef struct fw_serve_child_limits {
    /* these two not under a sanitizer, which needs it all and has to say what it found */
    uint64_t memory_bytes; /* address space */
    uint64_t file_bytes;   /* of one file */
    uint64_t cpu_s;        /* 0: none */
    uint64_t files;        /* open at once */
    int nice;              /* so much behind the server itself */
} fw_serve_child_limits;

typedef struct fw_serve_child_plan {
    const char *const *argv; /* NULL-terminated, [0] is the program's name */
    int directory;           /* to start in; -1: the server's */
    const char *temporary;   /* its $TMPDIR; NULL: the server's */
    int in, out, err;        /* become 0, 1 and 2; -1: /dev/null (err: the server's) */
    int channel;             /* becomes 3; -1: none */
    fw_serve_child_limits limits;
} fw_serve_child_plan;

/* the process (and group) or -1. The descriptors stay the caller's. */
pid_t fw_serve_child_start(const fw_serve_child_plan *plan);
/* has it ended? Then *status is as of waitpid */
int fw_serve_child_ended(pid_t pid, int *status);
/* ends it and all that it started, and waits for it */
void fw_serve_child_kill(pid_t pid);

/* ---- scratch.c: the server's directory for its jobs ----
   Below $TMPDIR or /tmp, for the owner alone. A lock in it says that its server lives: what a
   killed one left, the next one removes. */

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
