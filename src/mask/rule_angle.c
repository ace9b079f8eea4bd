/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Angle: no corner sharper than the limit, in material or in empty space.
     - outline: where two edges of the union follow each other, across joints too, the lesser of the
   two angles between them is pi - |turn|, from exact tangents. Error: a few 1e-16 rad.
     - polygon: at every vertex of what is written, but for ends of joints, atan2(|cross|, dot) of
   exact integer vectors; nothing is allowed for the grid, which can sharpen a right angle by about
   g / edge length.
   In: edges of a layer, polygons on the 1 nm grid. Out: one finding for each corner, rad. Cost
   O(n log n). Test: test_rule_seeded.c. */
#include "mask/rule.h"

static const double GRID_M = 1e-9;
static const double SAME_RAD = 1e-9; /* tangents of arcs are not better */

static void found(fw_mask_rules *rules, const fw_mask_rule *rule, fw_geometry_vec2 at,
                  double angle_rad, const char *label, int edge) {
    fw_mask_rules_add(rules, (fw_mask_finding){.rule = rule,
                                               .what = "corner",
                                               .at = {at, at},
                                               .box = fw_mask_box_around(at, at),
                                               .value = angle_rad,
                                               .limit = rule->least,
                                               .needed = rule->least,
                                               .label = {label, NULL},
                                               .edge = {edge, -1}});
}

static fw_geometry_vec2 tangent(const fw_mask_rule_edge *e, double t) {
    return e->s.kind == FW_LINE ? e->along : fw_geometry_segment_tangent(&e->s, t);
}

static fw_status of_outline(fw_mask_rules *rules, const fw_mask_rule *rule) {
    const fw_mask_rule_search *in = &rules->search[rule->layer];
    double blunt = -cos(rule->least - SAME_RAD) + 1e-12; /* most corners: no angle is computed */
    for (int i = 0; i < in->nedge; i++) {
        const fw_mask_rule_edge *e = &in->edge[i];
        int next = e->corner_b ? fw_mask_rule_start_at(in, e->s.b, -1) : -1;
        if (next < 0) continue;
        fw_geometry_vec2 u = tangent(e, 1), v = tangent(&in->edge[next], 0);
        if (vec_dot(u, v) > blunt) continue;
        double angle = FW_PI - fabs(atan2(vec_cross(u, v), vec_dot(u, v)));
        if (angle < rule->least - SAME_RAD)
            found(rules, rule, e->s.b, angle, rules->shape[e->shape].piece->label, e->segment);
    }
    return FW_OK;
}

static bool ends_joint(const fw_geometry_contour *c, fw_geometry_vec2 at) {
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].flags & FW_SEGMENT_JOINT && (vec_distance(c->segment[i].a, at) < GRID_M ||
                                                       vec_distance(c->segment[i].b, at) < GRID_M))
            return true;
    return false;
}

/* |coordinates| < 2^30: products of differences fit into 63 bits */
static double angle_at(const fw_geometry_polygon *p, int i) {
    fw_geometry_point v = p->vertex[i], a = p->vertex[i > 0 ? i - 1 : p->count - 1];
    fw_geometry_point b = p->vertex[i + 1 < p->count ? i + 1 : 0];
    int64_t ax = (int64_t)a.x_dbu - v.x_dbu, ay = (int64_t)a.y_dbu - v.y_dbu;
    int64_t bx = (int64_t)b.x_dbu - v.x_dbu, by = (int64_t)b.y_dbu - v.y_dbu;
    return atan2(fabs((double)(ax * by - ay * bx)), (double)(ax * bx + ay * by));
}

static void of_polygons(fw_mask_rules *rules, const fw_mask_rule *rule) {
    for (int k = 0; k < rules->nshape; k++) {
        const fw_mask_shape *s = &rules->shape[k];
        for (int i = 0; s->layer == rule->layer && i < s->polygon.count; i++) {
            double angle = angle_at(&s->polygon, i);
            if (!(angle < rule->least - 1e-12)) continue;
            fw_geometry_point v = s->polygon.vertex[i];
            fw_geometry_vec2 at = {v.x_dbu * GRID_M, v.y_dbu * GRID_M};
            if (!ends_joint(&s->contour, at)) found(rules, rule, at, angle, s->piece->label, -1);
        }
    }
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    if (rule->of != FW_OF_POLYGON) return of_outline(rules, rule);
    of_polygons(rules, rule);
    return FW_OK;
}

const fw_mask_rule_kind_row fw_mask_kind_angle = {
    .name = "angle",
    .advice = "round the corner",
    .number = 155,
    .marker = 4,
    .unit = FW_UNIT_ANGLE,
    .takes = FW_TAKES_OF,
    .of = FW_OF_OUTLINE | FW_OF_POLYGON,
    .usual_of = FW_OF_OUTLINE,
    .check = check,
};
