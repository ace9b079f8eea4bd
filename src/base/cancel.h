/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request to stop, which signal handlers and other threads may make and long loops look at. Every
   design has one of its own; its arena carries it (fw_arena_cancelled), so that whatever computes
   for that design sees it and nothing else does. */
#ifndef FW_BASE_CANCEL_H
#define FW_BASE_CANCEL_H
#include <stdatomic.h>

typedef struct fw_cancel {
    atomic_int number;             /* 0: go on; else why to stop, by custom the signal's number */
    const struct fw_cancel *above; /* stops this work too: that of the whole program; may be NULL */
} fw_cancel;

void fw_cancel_request(fw_cancel *cancel, int number); /* async-signal-safe */
void fw_cancel_clear(fw_cancel *cancel);               /* not what stands above it */
int fw_cancel_requested(const fw_cancel *cancel);      /* the number, or 0; NULL is never stopped */

#endif
