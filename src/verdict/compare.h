/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which of two verdicts on hinges matters more; whether the description closes. Private to the
 * room. */
#ifndef FW_VERDICT_COMPARE_H
#define FW_VERDICT_COMPARE_H
#include "verdict/verdict.h"

void fw_verdict_keep_worst(fw_hinge_verdict *worst, const fw_hinge_verdict *other);
bool fw_verdict_governs(const fw_hinge_verdict *h, const fw_hinge_verdict *other);
/* one of these hinges is inconclusive, and a tighter run may decide it */
bool fw_verdict_undecided(const fw_hinge_verdict *hinge, int nhinge);
/* the same request at the tightest accuracy */
fw_verdict_options fw_verdict_tighter(const fw_verdict_options *options);
/* every joint is where both its bodies put it, within 10 nm, in the drawn position (FW-D206) */
fw_status fw_verdict_check_closure(const fw_device *device, const fw_mechanism *mechanism,
                                   fw_diags *diags);

#endif
