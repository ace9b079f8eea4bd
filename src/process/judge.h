/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can this flow make this device? Private to process/. */
#ifndef FW_PROCESS_JUDGE_H
#define FW_PROCESS_JUDGE_H
#include "process/process.h"

/* fills bias_m, bias_note, manufacturable and reason. Steps must have been computed. */
fw_status fw_flow_judge(fw_arena *arena, fw_flow *flow, const fw_mask_facts *facts);

#endif
