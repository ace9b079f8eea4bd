/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Separation: shapes of two layers are farther than the limit (and what flattening takes) from each
   other: the lane of the saw from the device. Least distances of exact edges (rules_between.c); two
   shapes that cross, or of which one lies in the other, are one finding with the value 0.
   In: edges of both layers, m. Out: one finding for each place. Error: a few ulp of the
   coordinates. Cost O(n log n), and O(pairs of shapes whose boxes lie in each other) for the point
   that says inside or not. Test: test_rule_seeded.c. */
#include "mask/rule.h"

static bool box_inside(fw_box in, fw_box out) {
    return in.x0 >= out.x0 && in.x1 <= out.x1 && in.y0 >= out.y0 && in.y1 <= out.y1;
}

static void look(const fw_rules *rules, fw_rule_search *between, const fw_rule_edge *p,
                 const fw_rule_edge *q, bool p_in_q) {
    const fw_rule_edge *in = p_in_q ? p : q, *out = p_in_q ? q : p;
    fw_vec2 at = fw_segment_point(&in->s, 0.5);
    if (fw_contour_contains(&rules->shape[out->shape].contour, at))
        fw_rule_add(between, (fw_finding){.shape = {p->shape, q->shape},
                                          .segment = {p->segment, q->segment},
                                          .at = {at, at},
                                          .edge = {p, q}});
}

static void add_nested(const fw_rules *rules, const fw_rule_search *a, const fw_rule_search *b,
                       fw_rule_search *between) {
    for (int i = 0; i < a->nrange; i++)
        for (int j = 0; j < b->nrange && b->range[j].box.x0 <= a->range[i].box.x1; j++) {
            const fw_rule_range *r = &a->range[i], *s = &b->range[j];
            bool in = box_inside(r->box, s->box);
            if (in || box_inside(s->box, r->box))
                look(rules, between, &a->edge[r->first], &b->edge[s->first], in);
        }
}

static fw_status check(fw_rules *rules, const fw_mask_rule *rule) {
    fw_rule_search between;
    FW_TRY(fw_rules_between(rules, rule, &between));
    add_nested(rules, &rules->search[rule->layer], &rules->search[rule->other], &between);
    if (between.no_memory) return FW_NOMEM;
    return fw_rules_distances(rules, rule, &between);
}

const fw_rule_row fw_kind_separation = {
    .name = "separation",
    .advice = "move the two apart",
    .number = 154,
    .marker = 9,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_FROM,
    .check = check,
};
