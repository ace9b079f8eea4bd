/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to the room: drawn tendons and the envelope. */
#ifndef FW_EFFECTS_TENDON_SLACK_H
#define FW_EFFECTS_TENDON_SLACK_H
#include "effects/effect.h"
#include "effects/envelope.h"

/* marks in loose (ntendon) the drawn tendons that the envelope, which has all unmarked ones as
   springs, does not keep taut; of an envelope that is not valid all. False: there are no more */
bool fw_effects_tendons_loosen(const fw_effect_case *c, const fw_effects_envelope *e, bool *loose);
/* what those of `loose` change at most, which the valid envelope does not have */
fw_status fw_effects_tendons_pull(const fw_effect_case *c, const fw_effects_envelope *e,
                                  const bool *loose, double *bound);

#endif
