/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What wet steps take of the device itself when it stands: the removal of a seed, for example,
   takes copper from every open face. Private to process/. */
#ifndef FW_PROCESS_WEAR_H
#define FW_PROCESS_WEAR_H
#include "process/process.h"

typedef struct fw_process_wear {
    double loss_m, uncertainty_m; /* of every open face, all such steps: the known part */
    const char *missing; /* what must be known to say how much a step takes; NULL: nothing */
    const fw_process_step *step; /* the first of them; NULL: there is none */
    const fw_process_exposed *exposed;
} fw_process_wear;

/* does the step's chemical attack walls as it attacks tops? */
bool fw_process_step_is_wet(const fw_process_step *step);
/* pure: from the pack's own quantities, whether or not steps were computed */
fw_process_wear fw_process_flow_wear(const fw_process_flow *flow);

#endif
