/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a schema cannot see in a pack. Private to process/. A check is a function and a row in
   lint.c; those that need times and the mask run after the flow was computed. */
#ifndef FW_PROCESS_LINT_H
#define FW_PROCESS_LINT_H
#include "process/pack.h"

fw_status fw_process_pack_lint(fw_process_pack *pack);

/* people and chemicals (FW-D174, FW-D175) */
fw_status fw_process_lint_people(fw_process_pack *pack);
fw_status fw_process_lint_chemicals(fw_process_pack *pack);
/* layers of the wafer, step by step (FW-D172, FW-D269, FW-D271 to FW-D275) */
fw_status fw_process_lint_absent(fw_process_pack *pack);
fw_status fw_process_lint_attacked(fw_process_pack *pack);
fw_status fw_process_lint_heat(fw_process_pack *pack);
fw_status fw_process_lint_contamination(fw_process_pack *pack);
fw_status fw_process_lint_exposure(fw_process_pack *pack);
fw_status fw_process_lint_masking(fw_process_pack *pack);

/* what a step takes of a material that lies open, nominal and at two standard uncertainties; m, NaN
   when an input is not known */
double fw_process_exposed_loss(const fw_process_step *step, const fw_process_exposed *exposed,
                               double *most_m);

/* after fw_process_flow_judge: adds to its reasons what the steps' times do to the layers, and
   derived
   values above their limits (FW-D270, FW-D273, FW-D279) */
fw_status fw_process_lint_computed(fw_arena *arena, fw_process_flow *flow, fw_diags *diags);

#endif
