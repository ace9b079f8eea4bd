/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Space: two edges that face each other across empty space, not nearer than the limit (and what
   flattening takes). Where the layer has a rule for notches, that one speaks for edges of one
   connected shape. Chords, error, cost: rules_pair.c. Test: test_rule_seeded.c. */
#include "mask/rule.h"

static bool of_two(const fw_mask_rules *rules, const fw_mask_rule_finding *f, const void *with) {
    const int *group = with;
    (void)rules;
    return group[f->shape[0]] != group[f->shape[1]];
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    bool notch = false;
    for (int i = 0; i < rules->nrule; i++)
        notch = notch ||
                (rules->rule[i].kind == &fw_mask_kind_notch && rules->rule[i].layer == rule->layer);
    int *group = NULL;
    if (notch) FW_TRY(fw_mask_rules_islands(rules, rule->layer, &group));
    return fw_mask_rules_chords(rules, rule, FW_RULE_SPACE, notch ? of_two : NULL, group);
}

const fw_mask_rule_kind_row fw_mask_kind_space = {
    .name = "space",
    .advice = "move the edges apart there, or choose a smaller bias",
    .number = 145,
    .marker = 1,
    .unit = FW_UNIT_LENGTH,
    .check = check,
};
