/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces of one layer that meet without a shared joint, or lie in each other: built in, because
   area and width of the union would be wrong. One finding for every two pieces. Points where edges
   meet: fw_geometry_segment_intersect, a few ulp; nesting: one point of a piece against the others
   whose box
   holds it. Test: test_mask_rules.c, test_rule_seeded.c. */
#include "mask/rule.h"
#include <stdlib.h>

static int by_shapes(const void *left, const void *right) {
    const fw_mask_rule_finding *p = left, *q = right;
    for (int k = 0; k < 2; k++)
        if (p->shape[k] != q->shape[k]) return p->shape[k] - q->shape[k];
    for (int k = 0; k < 2; k++)
        if (p->segment[k] != q->segment[k]) return p->segment[k] - q->segment[k];
    return vec_same(p->at[0], q->at[0]) ? 0 : vec_before(p->at[0], q->at[0]) ? -1 : 1;
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    const fw_mask_rule_search *in = &rules->search[rule->layer];
    int n = 0;
    if (in->nfound == 0) return FW_OK;
    fw_mask_rule_finding *list =
        fw_arena_array(rules->arena, fw_mask_rule_finding, (size_t)in->nfound);
    FW_NEED(list);
    for (int i = 0; i < in->nfound; i++)
        if (in->found[i].kind == FW_RULE_OVERLAP) list[n++] = in->found[i];
    if (n) qsort(list, (size_t)n, sizeof *list, by_shapes);
    for (int i = 0, next; i < n; i = next) {
        const fw_mask_rule_finding *f = &list[i];
        fw_mask_finding found = {.rule = rule,
                                 .what = "overlap",
                                 .at = {f->at[0], f->at[1]},
                                 .box = fw_mask_box_around(f->at[0], f->at[1]),
                                 .label = {rules->shape[f->shape[0]].piece->label,
                                           rules->shape[f->shape[1]].piece->label},
                                 .edge = {f->segment[0], f->segment[1]}};
        for (next = i;
             next < n && list[next].shape[0] == f->shape[0] && list[next].shape[1] == f->shape[1];
             next++)
            found.box =
                fw_box_join(found.box, fw_mask_box_around(list[next].at[0], list[next].at[1]));
        fw_mask_rules_add(rules, found);
    }
    return FW_OK;
}

const fw_mask_rule_kind_row fw_mask_kind_overlap = {
    .name = "overlap",
    .advice = "move them apart or join them",
    .number = 152,
    .marker = 10,
    .unit = FW_UNIT_LENGTH,
    .built_in = true,
    .check = check,
};
