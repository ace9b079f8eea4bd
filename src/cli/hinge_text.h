/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladder of `flexwright hinge` for people. Private to the room. */
#ifndef FW_CLI_HINGE_TEXT_H
#define FW_CLI_HINGE_TEXT_H
#include "plan/ladder.h"

/* hint: how to get the levels that were left out */
fw_status fw_cli_hinge_print(fw_arena *arena, const fw_plan_ladders *all, bool hint);
/* why the picked level is picked; 200 bytes hold it */
void fw_cli_ladder_why(const fw_plan_ladder *ladder, double accuracy, char *text, size_t n);

#endif
