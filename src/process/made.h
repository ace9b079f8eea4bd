/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a flow makes of a device, for the verdict. */
#ifndef FW_PROCESS_MADE_H
#define FW_PROCESS_MADE_H
#include "process/process.h"
#include "verdict/made.h"

/* the flow's <corner>s as independent inputs of a variant; those without any range are left out.
   What an etch takes sideways is that of the fixed point with these facts of the mask (NULL:
   nothing drawn), the same that fw_flow_compute gives the mask and the recipe. */
fw_status fw_flow_made(fw_arena *arena, const fw_flow *flow, const fw_mask_facts *facts,
                       const fw_variant *variant, const fw_made_input **input, int *ninput);

#endif
