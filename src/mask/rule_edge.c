/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edge: none shorter than the limit.
     - polygon (usual): every edge that is written, joints included, length of an exact integer
   vector.
     - outline: every line and arc of the exact outline that is no joint, by its length.
   Out: one finding for each edge, m. Error: 1 ulp (polygon), a few ulp of the coordinates
   (outline). Cost O(n). Test: test_rule_seeded.c. */
#include "mask/rule.h"

static const double GRID_M = 1e-9;

static void found(fw_mask_rules *rules, const fw_mask_rule *rule, fw_geometry_vec2 from,
                  fw_geometry_vec2 to, double length_m, const fw_mask_shape *shape, int edge) {
    fw_mask_rules_add(rules, (fw_mask_finding){.rule = rule,
                                               .what = "edge",
                                               .at = {from, to},
                                               .box = fw_mask_box_around(from, to),
                                               .value = length_m,
                                               .limit = rule->least,
                                               .needed = rule->least,
                                               .label = {shape->piece->label, NULL},
                                               .edge = {edge, -1}});
}

static void of_polygon(fw_mask_rules *rules, const fw_mask_rule *rule, const fw_mask_shape *shape) {
    const fw_geometry_polygon *p = &shape->polygon;
    double long_dbu = rule->least / GRID_M;
    if (p->count > 0 && shape->report.shortest_edge_m > rule->least) return;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point a = p->vertex[i], b = p->vertex[i + 1 < p->count ? i + 1 : 0];
        if (fabs((double)b.x_dbu - a.x_dbu) > long_dbu ||
            fabs((double)b.y_dbu - a.y_dbu) > long_dbu)
            continue;
        double length = hypot((double)b.x_dbu - a.x_dbu, (double)b.y_dbu - a.y_dbu) * GRID_M;
        if (length < rule->least - FW_COINCIDENT_M)
            found(rules, rule, (fw_geometry_vec2){a.x_dbu * GRID_M, a.y_dbu * GRID_M},
                  (fw_geometry_vec2){b.x_dbu * GRID_M, b.y_dbu * GRID_M}, length, shape, -1);
    }
}

static void of_outline(fw_mask_rules *rules, const fw_mask_rule *rule, const fw_mask_shape *shape) {
    for (int i = 0; i < shape->contour.count; i++) {
        const fw_geometry_segment *s = &shape->contour.segment[i];
        double length = fw_geometry_segment_length(s);
        if (!(s->flags & FW_SEGMENT_JOINT) && length < rule->least - FW_COINCIDENT_M)
            found(rules, rule, s->a, s->b, length, shape, i);
    }
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    for (int k = 0; k < rules->nshape; k++) {
        if (rules->shape[k].layer != rule->layer) continue;
        if (rule->of == FW_OF_POLYGON)
            of_polygon(rules, rule, &rules->shape[k]);
        else
            of_outline(rules, rule, &rules->shape[k]);
    }
    return FW_OK;
}

const fw_mask_rule_kind_row fw_mask_kind_edge = {
    .name = "edge",
    .advice = "leave the step out, or choose another tolerance",
    .number = 155,
    .marker = 5,
    .unit = FW_UNIT_LENGTH,
    .takes = FW_TAKES_OF,
    .of = FW_OF_OUTLINE | FW_OF_POLYGON,
    .usual_of = FW_OF_POLYGON,
    .check = check,
};
