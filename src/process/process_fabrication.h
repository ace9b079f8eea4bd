/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a flow makes of a device, for the verdict. */
#ifndef FW_PROCESS_PROCESS_FABRICATION_H
#define FW_PROCESS_PROCESS_FABRICATION_H
#include "process/process.h"
#include "verdict/verdict_fabrication.h"

/* the flow's <corner>s as independent inputs of a variant; those without any range are left out.
   What an etch takes sideways is that of the fixed point with these facts of the mask (NULL:
   nothing drawn), the same that fw_process_flow_compute gives the mask and the recipe. */
fw_status fw_process_flow_fabricated(fw_arena *arena, const fw_process_flow *flow,
                                     const fw_process_mask_facts *facts,
                                     const fw_mechanism_variant *variant,
                                     const fw_verdict_fabrication_input **input, int *ninput);

#endif
