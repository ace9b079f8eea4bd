/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Separation: shapes of two layers are farther than the limit (and what flattening takes) from each
   other: the lane of the saw from the device. Least distances of exact edges (rules_between.c); two
   shapes that cross, or of which one lies in the other, are one finding with the value 0.
   In: edges of both layers, m. Out: one finding for each place. Error: a few ulp of the
   coordinates. Cost O(n log n), and O(pieces) for each point that says inside or not. Test:
   test_rule_seeded.c. */
#include "mask/rule.h"

/* runs of one layer's boundary that lie inside the other layer; those that cross it are known */
static void add_inside(const fw_mask_rules *rules, int layer, int other, bool turned,
                       fw_mask_rule_search *between) {
    const fw_mask_rule_search *in = &rules->search[layer], *out = &rules->search[other];
    for (int i = 0; i < in->nedge; i++) {
        const fw_mask_rule_edge *e = &in->edge[i];
        if (!fw_mask_rules_first(rules, e)) continue;
        fw_geometry_vec2 at = fw_geometry_segment_point(&e->s, 0.5);
        const fw_mask_rule_range *around = fw_mask_rules_holding(rules, other, at);
        if (!around) continue;
        const fw_mask_rule_edge *q = &out->edge[around->first], *own = turned ? q : e;
        if (turned) q = e;
        fw_mask_rule_add(between, (fw_mask_rule_finding){.shape = {own->shape, q->shape},
                                                         .segment = {own->segment, q->segment},
                                                         .at = {at, at},
                                                         .edge = {own, q}});
    }
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    fw_mask_rule_search between;
    FW_TRY(fw_mask_rules_between(rules, rule, &between));
    add_inside(rules, rule->layer, rule->other, false, &between);
    add_inside(rules, rule->other, rule->layer, true, &between);
    if (between.no_memory) return FW_NOMEM;
    return fw_mask_rules_distances(rules, rule, &between);
}

const fw_mask_rule_kind_row fw_mask_kind_separation = {
    .name = "separation",
    .advice = "move the two apart",
    .number = 154,
    .marker = 9,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_FROM,
    .check = check,
};
