/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feature: neither a line nor a gap finer than exposure prints in the resist. The limit is a
   formula of the table over the rule's own wavelength, gap and resist thickness; for a shadow
   printer 1.5 sqrt(wavelength (gap + resist / 2)), the Fresnel shadow of a mask edge in the middle
   of the resist (textbook, e.g. Madou, Fundamentals of Microfabrication; the same as
   fw_process_print_limit
   of process/). It judges widths and spaces, whatever other rules say of them. Chords, error, cost:
   rules_pair.c. Test: test_rule_seeded.c, test_mask_table.c. */
#include "mask/rule.h"

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    FW_TRY(fw_mask_rules_chords(rules, rule, FW_RULE_WIDTH, NULL, NULL));
    return fw_mask_rules_chords(rules, rule, FW_RULE_SPACE, NULL, NULL);
}

const fw_mask_rule_kind_row fw_mask_kind_feature = {
    .name = "feature",
    .advice = "make it wider, expose with a smaller gap, or choose thinner resist",
    .number = 158,
    .marker = 3,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_PRINT,
    .check = check,
};
