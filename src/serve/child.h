/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A process of the server's own: the same program, run again, with limits. It knows no secret of
   the server (nothing is inherited but what is named here), and ends with the server. Private to
   the room. */
#ifndef FW_SERVE_CHILD_H
#define FW_SERVE_CHILD_H
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

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

#endif
