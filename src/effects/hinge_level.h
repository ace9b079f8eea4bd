/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a choice of level enters the decision on effects. Private to the room. */
#ifndef FW_EFFECTS_HINGE_LEVEL_H
#define FW_EFFECTS_HINGE_LEVEL_H
#include "effects/effect.h"

/* this effect is in or out because of the level asked for, whatever else is asked */
bool fw_effects_hinge_forced(const char *effect, fw_effects_hinge_model asked, bool *in);
const char *fw_effects_hinge_forced_reason(const fw_effect_choice *choice);
/* after everything was added: fills ledger->hinge, makes beams of closed forms where asked for */
fw_status fw_effects_hinge_settle(const fw_effect_case *c, const fw_effect_choice *choice,
                                  fw_effect_ledger *ledger, fw_effects_loads *loads);

#endif
