/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer's layers after a step, as the <change> elements make them: two columns, one through the
   structure and one through the field beside it. Heights are drawn heights, not to scale. */
#ifndef FW_PROCESS_STACK_H
#define FW_PROCESS_STACK_H
#include "process/process.h"

typedef struct fw_process_cell {
    const char *material;
    double thickness_m;    /* NaN: unknown */
    double bottom, height; /* drawn, in units of about a millimetre on paper */
    bool exposed;          /* latent image in resist */
} fw_process_cell;

enum { FW_STACK_STRUCTURE, FW_STACK_FIELD, FW_STACK_COLUMNS };

typedef struct fw_process_stack {
    fw_process_cell *cell[FW_STACK_COLUMNS]; /* (n), bottom to top; removed ones are gone */
    int n[FW_STACK_COLUMNS], capacity;
} fw_process_stack;

/* layers after step `index` (-1: before the first). *absent (may be NULL) is the first change that
   touches a material which is not there, else NULL. */
fw_status fw_process_flow_stack(fw_arena *arena, const fw_process_flow *flow, int index,
                                fw_process_stack *stack, const fw_process_change **absent);

/* does `material` lie open anywhere: on top of a column, below films that have holes, or at its
   side, where it stands above the top of the other column */
bool fw_process_stack_open(const fw_process_flow *flow, const fw_process_stack *stack,
                           const char *material);

#endif
