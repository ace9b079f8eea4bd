/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enclosure: a shape of one layer lies inside the union of another, and farther than the limit (and
   what flattening takes) from its boundary: lettering inside the frame it is cleared from. Least
   distances of exact edges (rules_between.c); a shape that crosses the boundary, lies outside, or
   has a hole of the other layer in it is one finding with the value 0.
   In: edges of both layers, m. Out: one finding for each place. Error: a few ulp of the
   coordinates. Cost O(n log n), and O(pieces) for each point that says inside or not. Test:
   test_rule_seeded.c. */
#include "mask/rule.h"

static void add_outside(fw_mask_rule_search *between, const fw_mask_rule_edge *e) {
    fw_geometry_vec2 at = fw_geometry_segment_point(&e->s, 0.5);
    fw_mask_rule_add(between, (fw_mask_rule_finding){.shape = {e->shape, -1},
                                                     .segment = {e->segment, -1},
                                                     .at = {at, at},
                                                     .edge = {e, e}});
}

/* an edge of the outer layer's boundary that lies inside the shape, where none cross: a hole */
static bool holds_boundary(const fw_mask_rules *rules, const fw_mask_rule_range *r,
                           const fw_mask_rule_search *outer) {
    for (int i = 0; i < outer->nrange && outer->range[i].box.x0 <= r->box.x1; i++) {
        if (fw_box_gap(outer->range[i].box, r->box) > 0) continue;
        for (int j = 0; j < outer->range[i].count; j++) {
            const fw_mask_rule_edge *e = &outer->edge[outer->range[i].first + j];
            if (fw_box_gap(e->box, r->box) == 0 &&
                fw_geometry_contour_contains(&rules->shape[r->shape].contour,
                                             fw_geometry_segment_point(&e->s, 0.5)))
                return true;
        }
    }
    return false;
}

static fw_status add_all_outside(fw_mask_rules *rules, const fw_mask_rule *rule,
                                 fw_mask_rule_search *between) {
    const fw_mask_rule_search *inner = &rules->search[rule->layer],
                              *outer = &rules->search[rule->other];
    bool *crosses = fw_arena_array(rules->arena, bool, (size_t)rules->nshape);
    FW_NEED(crosses);
    for (int i = 0; i < between->nfound; i++)
        if (between->found[i].value_m == 0) crosses[between->found[i].edge[0]->shape] = true;
    for (int i = 0; i < inner->nrange; i++) {
        const fw_mask_rule_range *r = &inner->range[i];
        if (crosses[r->shape]) continue;
        if (holds_boundary(rules, r, outer)) add_outside(between, &inner->edge[r->first]);
        for (int j = 0; j < r->count; j++) {
            const fw_mask_rule_edge *e = &inner->edge[r->first + j];
            if (fw_mask_rules_first(rules, e) &&
                !fw_mask_rules_holding(rules, rule->other, fw_geometry_segment_point(&e->s, 0.5)))
                add_outside(between, e);
        }
    }
    return FW_OK;
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    fw_mask_rule_search between;
    FW_TRY(fw_mask_rules_between(rules, rule, &between));
    for (int i = 0; i < between.nfound; i++) /* the other layer is one union */
        between.found[i].shape[1] = -1;
    FW_TRY(add_all_outside(rules, rule, &between));
    return fw_mask_rules_distances(rules, rule, &between);
}

const fw_mask_rule_kind_row fw_mask_kind_enclosure = {
    .name = "enclosure",
    .advice = "move it inwards, or make what is around it larger",
    .number = 154,
    .marker = 8,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_INSIDE,
    .check = check,
};
