/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width: two edges that face each other through material, not nearer than the limit (and what
   flattening takes). Chords, error, cost: rules_pair.c. Test: test_rule_seeded.c. */
#include "mask/rule.h"

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    return fw_mask_rules_chords(rules, rule, FW_RULE_WIDTH, NULL, NULL);
}

const fw_mask_rule_kind_row fw_mask_kind_width = {
    .name = "width",
    .advice = "make the part wider there, or choose a smaller bias",
    .number = 144,
    .marker = 0,
    .unit = FW_UNIT_LENGTH,
    .check = check,
};
