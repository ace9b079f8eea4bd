/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notch: the same as space, but between edges of one connected shape (pieces that share joints), in
   the place of the layer's rule for space there. Chords, error, cost: rules_pair.c; islands:
   mask_rules.c. Test: test_rule_seeded.c. */
#include "mask/rule.h"

static bool of_one(const fw_mask_rules *rules, const fw_mask_rule_finding *f, const void *with) {
    const int *group = with;
    (void)rules;
    return group[f->shape[0]] == group[f->shape[1]];
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    int *group;
    FW_TRY(fw_mask_rules_islands(rules, rule->layer, &group));
    return fw_mask_rules_chords(rules, rule, FW_RULE_SPACE, of_one, group);
}

const fw_mask_rule_kind_row fw_mask_kind_notch = {
    .name = "notch",
    .advice = "widen the notch or close it",
    .number = 145,
    .marker = 2,
    .unit = FW_UNIT_LENGTH,
    .check = check,
};
