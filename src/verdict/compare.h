/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which of two verdicts on hinges matters more; whether the description closes. Private to the
 * room. */
#ifndef FW_VERDICT_COMPARE_H
#define FW_VERDICT_COMPARE_H
#include "verdict/verdict.h"

void fw_verdict_keep_worst(fw_verdict_hinge_verdict *worst, const fw_verdict_hinge_verdict *other);
bool fw_verdict_governs(const fw_verdict_hinge_verdict *h, const fw_verdict_hinge_verdict *other);
/* hinges of which some are inconclusive: what may decide them (refinement.c) */
typedef enum fw_verdict_refinement {
    FW_REFINE_NOTHING,
    FW_REFINE_NUMBERS, /* tighter numbers alone */
    FW_REFINE_HINGES   /* those, and a better model of the hinges */
} fw_verdict_refinement;
fw_verdict_refinement fw_verdict_refinement_of(const fw_verdict_hinge_verdict *hinge, int nhinge);
/* accuracy at which numbers decide all that are inconclusive now, were nothing else to change */
extern const double fw_verdict_tightest; /* accuracy of the closest look */
double fw_verdict_enough(const fw_verdict_hinge_verdict *hinge, int nhinge, double accuracy);
/* the same request, as close as that */
fw_verdict_options fw_verdict_tighter(const fw_verdict_options *options,
                                      fw_verdict_refinement refinement);
/* every joint is where both its bodies put it, within 10 nm, in the drawn position (FW-D206) */
fw_status fw_verdict_check_closure(const fw_device *device, const fw_mechanism *mechanism,
                                   fw_diags *diags);

#endif
