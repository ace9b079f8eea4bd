/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Area: no island of material and no hole in one smaller than the limit.
     - island: the exact areas of all pieces that share joints, added.
     - hole: edges of the union are linked end to start, across joints; a ring that runs clockwise
   bounds a hole, whose area is minus its own.
   In: outlines whose joints have the same bits on either side. Out: one finding for each island or
   hole, m2. Error: that of fw_geometry_contour_area, relative 1e-15 of perimeter times extent. Cost
   O(n log n). Test: test_rule_seeded.c. */
#include "mask/rule.h"

static void found(fw_mask_rules *rules, const fw_mask_rule *rule, const char *what,
                  fw_geometry_box box, double area_m2, const char *label) {
    fw_mask_rules_add(rules, (fw_mask_finding){.rule = rule,
                                               .what = what,
                                               .at = {{box.x0, box.y0}, {box.x1, box.y1}},
                                               .box = box,
                                               .value = area_m2,
                                               .limit = rule->least,
                                               .needed = rule->least,
                                               .label = {label, NULL},
                                               .edge = {-1, -1}});
}

static bool too_small(const fw_mask_rule *rule, double area_m2) {
    return area_m2 < rule->least * (1 - 1e-12);
}

static fw_status islands(fw_mask_rules *rules, const fw_mask_rule *rule) {
    int *group;
    FW_TRY(fw_mask_rules_islands(rules, rule->layer, &group));
    double *area = fw_arena_array(rules->arena, double, (size_t)rules->nshape);
    fw_geometry_box *box = fw_arena_array(rules->arena, fw_geometry_box, (size_t)rules->nshape);
    FW_NEED(area);
    FW_NEED(box);
    for (int k = 0; k < rules->nshape; k++) {
        int g = group[k];
        if (g < 0) continue;
        fw_geometry_box own = fw_geometry_contour_box(&rules->shape[k].contour);
        area[g] += fw_geometry_contour_area_in(&rules->shape[k].contour, own);
        box[g] = g == k ? own : fw_box_join(box[g], own);
    }
    for (int k = 0; k < rules->nshape; k++)
        if (group[k] == k && too_small(rule, area[k]))
            found(rules, rule, "island", box[k], area[k], rules->shape[k].piece->label);
    return FW_OK;
}

/* the ring that starts with edge `first`; its edges are marked as done */
static fw_geometry_contour ring_of(const fw_mask_rule_search *in, int first, bool *done,
                                   fw_geometry_segment *segment) {
    fw_geometry_contour ring = {segment, 0};
    for (int e = first; e >= 0 && !done[e];) {
        done[e] = true;
        segment[ring.count++] = in->edge[e].s;
        fw_geometry_vec2 at = in->edge[e].s.b;
        for (e = fw_mask_rule_start_at(in, at, -1); e >= 0 && done[e];)
            e = fw_mask_rule_start_at(in, at, e);
    }
    return ring;
}

static fw_status holes(fw_mask_rules *rules, const fw_mask_rule *rule) {
    const fw_mask_rule_search *in = &rules->search[rule->layer];
    size_t n = (size_t)in->nedge;
    bool *done = fw_arena_array(rules->arena, bool, n);
    fw_geometry_segment *segment = fw_arena_array(rules->arena, fw_geometry_segment, n);
    FW_NEED(done);
    FW_NEED(segment);
    for (int i = 0; i < in->nedge; i++) {
        if (done[i]) continue;
        fw_geometry_contour ring = ring_of(in, i, done, segment);
        if (!vec_same(ring.segment[ring.count - 1].b, ring.segment[0].a)) continue;
        double area = -fw_geometry_contour_area(&ring);
        if (area > 0 && too_small(rule, area))
            found(rules, rule, "hole", fw_geometry_contour_box(&ring), area,
                  rules->shape[in->edge[i].shape].piece->label);
    }
    return FW_OK;
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    if (rule->of & FW_OF_ISLAND) FW_TRY(islands(rules, rule));
    return rule->of & FW_OF_HOLE ? holes(rules, rule) : FW_OK;
}

const fw_mask_rule_kind_row fw_mask_kind_area = {
    .name = "area",
    .advice = "make it larger, or leave it out",
    .number = 156,
    .marker = 6,
    .unit = FW_UNIT_AREA,
    .takes = FW_TAKES_OF,
    .of = FW_OF_ISLAND | FW_OF_HOLE,
    .usual_of = FW_OF_ISLAND | FW_OF_HOLE,
    .check = check,
};
