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

static void found_corner(fw_mask_rules *rules, const fw_mask_rule *rule, fw_geometry_vec2 at,
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

static fw_status corners_of_outline(fw_mask_rules *rules, const fw_mask_rule *rule) {
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
            found_corner(rules, rule, e->s.b, angle, rules->shape[e->shape].piece->label,
                         e->segment);
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
            if (!ends_joint(&s->contour, at))
                found_corner(rules, rule, at, angle, s->piece->label, -1);
        }
    }
}

static fw_status check_angle(fw_mask_rules *rules, const fw_mask_rule *rule) {
    if (rule->of != FW_OF_POLYGON) return corners_of_outline(rules, rule);
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
    .check = check_angle,
};

/* Edge: none shorter than the limit.
     - polygon (usual): every edge that is written, joints included, length of an exact integer
   vector.
     - outline: every line and arc of the exact outline that is no joint, by its length.
   Out: one finding for each edge, m. Error: 1 ulp (polygon), a few ulp of the coordinates
   (outline). Cost O(n). Test: test_rule_seeded.c. */

static void found_edge(fw_mask_rules *rules, const fw_mask_rule *rule, fw_geometry_vec2 from,
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
            found_edge(rules, rule, (fw_geometry_vec2){a.x_dbu * GRID_M, a.y_dbu * GRID_M},
                       (fw_geometry_vec2){b.x_dbu * GRID_M, b.y_dbu * GRID_M}, length, shape, -1);
    }
}

static void edges_of_outline(fw_mask_rules *rules, const fw_mask_rule *rule,
                             const fw_mask_shape *shape) {
    for (int i = 0; i < shape->contour.count; i++) {
        const fw_geometry_segment *s = &shape->contour.segment[i];
        double length = fw_geometry_segment_length(s);
        if (!(s->flags & FW_SEGMENT_JOINT) && length < rule->least - FW_COINCIDENT_M)
            found_edge(rules, rule, s->a, s->b, length, shape, i);
    }
}

static fw_status check_edge(fw_mask_rules *rules, const fw_mask_rule *rule) {
    for (int k = 0; k < rules->nshape; k++) {
        if (rules->shape[k].layer != rule->layer) continue;
        if (rule->of == FW_OF_POLYGON)
            of_polygon(rules, rule, &rules->shape[k]);
        else
            edges_of_outline(rules, rule, &rules->shape[k]);
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
    .check = check_edge,
};

/* Area: no island of material and no hole in one smaller than the limit.
     - island: the exact areas of all pieces that share joints, added.
     - hole: edges of the union are linked end to start, across joints; a ring that runs clockwise
   bounds a hole, whose area is minus its own.
   In: outlines whose joints have the same bits on either side. Out: one finding for each island or
   hole, m2. Error: that of fw_geometry_contour_area, relative 1e-15 of perimeter times extent. Cost
   O(n log n). Test: test_rule_seeded.c. */

static void found_area(fw_mask_rules *rules, const fw_mask_rule *rule, const char *what,
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
            found_area(rules, rule, "island", box[k], area[k], rules->shape[k].piece->label);
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
            found_area(rules, rule, "hole", fw_geometry_contour_box(&ring), area,
                       rules->shape[in->edge[i].shape].piece->label);
    }
    return FW_OK;
}

static fw_status check_area(fw_mask_rules *rules, const fw_mask_rule *rule) {
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
    .check = check_area,
};
