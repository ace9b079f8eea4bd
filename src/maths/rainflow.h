/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cycles of a history, for fatigue: turning points on the fly, rainflow counting behind. */
#ifndef FW_MATHS_RAINFLOW_H
#define FW_MATHS_RAINFLOW_H
#include "base/arena.h"
#include <stdbool.h>
#include <stddef.h>

typedef struct fw_maths_cycle {
    double range, mean, count; /* peak to valley; middle; 1 or 0.5 */
} fw_maths_cycle;

typedef struct fw_maths_turning { /* turning points of a history that comes sample by sample */
    double gate;                  /* turns smaller than this are none */
    double *value;                /* (count) */
    size_t count, room;
    double latest;     /* extreme since the last turning point */
    int direction;     /* +1 rising, -1 falling, 0: nothing yet */
    double t[2], s[2]; /* the last two samples */
    int samples;
    bool failed; /* no memory */
} fw_maths_turning;

void fw_maths_turning_add(fw_maths_turning *turning, fw_arena *arena, double t, double value);
void fw_maths_turning_jump(fw_maths_turning *turning); /* no parabola across what comes next */
void fw_maths_turning_end(fw_maths_turning *turning, fw_arena *arena);

/* of n turning points; cycle (n) and work (n) are the caller's; returns the number of cycles */
size_t fw_maths_rainflow(const double *turn, size_t n, double *work, fw_maths_cycle *cycle);
/* of n turning points that come again and again: whole cycles only. work (2n + 1), cycle (n + 1) */
size_t fw_maths_rainflow_repeating(const double *turn, size_t n, double *work,
                                   fw_maths_cycle *cycle);

#endif
