/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FW_REPORT_JSON_EFFECTS_H
#define FW_REPORT_JSON_EFFECTS_H
#include "effects/effects.h"
#include "report/json_common.h"

/* one object per line of the ledger; scene and flow are added where they are given */
void fw_json_effects(json_t *list, const fw_effect_ledger *ledger, const char *scene,
                     const char *flow, bool *failed);
#endif
