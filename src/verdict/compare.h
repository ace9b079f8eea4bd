/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which of two verdicts on hinges matters more. Private to the room. */
#ifndef FW_VERDICT_COMPARE_H
#define FW_VERDICT_COMPARE_H
#include "verdict/verdict.h"

void fw_verdict_keep_worst(fw_hinge_verdict *worst, const fw_hinge_verdict *other);
bool fw_verdict_governs(const fw_hinge_verdict *h, const fw_hinge_verdict *other);

#endif
