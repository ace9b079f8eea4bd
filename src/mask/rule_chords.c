/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Width: two edges that face each other through material, not nearer than the limit (and what
   flattening takes). Chords, error, cost: rules_pair.c. Test: test_rule_seeded.c. */
#include "mask/rule.h"

static fw_status check_width(fw_mask_rules *rules, const fw_mask_rule *rule) {
    return fw_mask_rules_chords(rules, rule, FW_RULE_WIDTH, NULL, NULL);
}

const fw_mask_rule_kind_row fw_mask_kind_width = {
    .name = "width",
    .advice = "make the part wider there, or choose a smaller bias",
    .number = 144,
    .marker = 0,
    .unit = FW_UNIT_LENGTH,
    .chords = FW_CHORD_WIDTH,
    .check = check_width,
};

/* Space: two edges that face each other across empty space, not nearer than the limit (and what
   flattening takes). Where the layer has a rule for notches, that one speaks for edges of one
   connected shape. Chords, error, cost: rules_pair.c. Test: test_rule_seeded.c. */

static bool of_two(const fw_mask_rules *rules, const fw_mask_rule_finding *f, const void *with) {
    const int *group = with;
    (void)rules;
    return group[f->shape[0]] != group[f->shape[1]];
}

static fw_status check_space(fw_mask_rules *rules, const fw_mask_rule *rule) {
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
    .chords = FW_CHORD_SPACE,
    .check = check_space,
};

/* Notch: the same as space, but between edges of one connected shape (pieces that share joints), in
   the place of the layer's rule for space there. Chords, error, cost: rules_pair.c; islands:
   rules_kinds.c. Test: test_rule_seeded.c. */

static bool of_one(const fw_mask_rules *rules, const fw_mask_rule_finding *f, const void *with) {
    const int *group = with;
    (void)rules;
    return group[f->shape[0]] == group[f->shape[1]];
}

static fw_status check_notch(fw_mask_rules *rules, const fw_mask_rule *rule) {
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
    .chords = FW_CHORD_SPACE,
    .check = check_notch,
};

/* Feature: neither a line nor a gap finer than exposure prints in the resist. The limit is a
   formula of the table over the rule's own wavelength, gap and resist thickness; for a shadow
   printer 1.5 sqrt(wavelength (gap + resist / 2)), the Fresnel shadow of a mask edge in the middle
   of the resist (textbook, e.g. Madou, Fundamentals of Microfabrication; the same as
   fw_process_print_limit of process/). It judges widths and spaces, whatever other rules say of
   them. Chords, error, cost: rules_pair.c. Test: test_rule_seeded.c, test_mask_table.c. */

static fw_status check_feature(fw_mask_rules *rules, const fw_mask_rule *rule) {
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
    .chords = FW_CHORD_WIDTH | FW_CHORD_SPACE,
    .check = check_feature,
};
