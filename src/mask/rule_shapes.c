/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rules of one layer: chords (width, space, notch, feature), corners and shapes (angle, edge, area), and density.
   Each with its check and its row. */
#include "base/sort.h"
#include "mask/rule.h"
#include <stdlib.h>

/* ---- chords ----
   Width: two edges that face each other through material, not nearer than the limit (and what
   flattening takes). Chords, error, cost: rules_pair.c. Test: test_rule_seeded.c. */

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

/* ---- corners, edges, areas ----
   Angle: no corner sharper than the limit, in material or in empty space.
     - outline: where two edges of the union follow each other, across joints too, the lesser of the
   two angles between them is pi - |turn|, from exact tangents. Error: a few 1e-16 rad.
     - polygon: at every vertex of what is written, but for ends of joints, atan2(|cross|, dot) of
   exact integer vectors; nothing is allowed for the grid, which can sharpen a right angle by about
   g / edge length.
   In: edges of a layer, polygons on the 1 nm grid. Out: one finding for each corner, rad. Cost
   O(n log n). Test: test_rule_seeded.c. */

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
        if (angle < rule->least - SAME_RAD - fw_mask_rule_lean(e, &in->edge[next]))
            found_corner(rules, rule, e->s.b, angle, rules->shape[e->shape].piece->label,
                         e->segment);
    }
    return FW_OK;
}

static bool ends_joint(const fw_geometry_contour *c, fw_geometry_vec2 at) {
    for (int i = 0; i < c->count; i++)
        if (c->segment[i].flags & FW_SEGMENT_JOINT &&
            (vec_distance(c->segment[i].a, at) < FW_GEOMETRY_GRID_M ||
             vec_distance(c->segment[i].b, at) < FW_GEOMETRY_GRID_M))
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
            fw_geometry_vec2 at = {v.x_dbu * FW_GEOMETRY_GRID_M, v.y_dbu * FW_GEOMETRY_GRID_M};
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
    double long_dbu = rule->least / FW_GEOMETRY_GRID_M;
    if (p->count > 0 && shape->report.shortest_edge_m > rule->least) return;
    for (int i = 0; i < p->count; i++) {
        fw_geometry_point a = p->vertex[i], b = p->vertex[i + 1 < p->count ? i + 1 : 0];
        if (fabs((double)b.x_dbu - a.x_dbu) > long_dbu ||
            fabs((double)b.y_dbu - a.y_dbu) > long_dbu)
            continue;
        double length =
            hypot((double)b.x_dbu - a.x_dbu, (double)b.y_dbu - a.y_dbu) * FW_GEOMETRY_GRID_M;
        if (length < rule->least - FW_COINCIDENT_M)
            found_edge(
                rules, rule,
                (fw_geometry_vec2){a.x_dbu * FW_GEOMETRY_GRID_M, a.y_dbu * FW_GEOMETRY_GRID_M},
                (fw_geometry_vec2){b.x_dbu * FW_GEOMETRY_GRID_M, b.y_dbu * FW_GEOMETRY_GRID_M},
                length, shape, -1);
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

/* ---- density ----
   Density: the share of a square window that a layer covers, least and most, in windows a step
   apart over the box of everything drawn (the last ones moved back inside; a box smaller than the
   window is one window).
   The area of an outline inside a window needs no clipping: with f(x, y) = min(max(x - x0, 0),
   x1 - x0) for y0 <= y <= y1 and 0 elsewhere, df/dx is 1 in the window and 0 outside, so by Green's
   theorem the area is the integral of f dy along the outline. An edge is taken between its
   crossings with the window's four lines; there f is 0, x1 - x0, or x - x0, whose integral is
   (mean x - x0) dy on a line and, with x = cx + R cos a,
   (cx - x0) R (sin a2 - sin a1) + R^2/2 (a2 - a1 + (sin 2 a2 - sin 2 a1)/2) on an arc.
   In: exact outlines, m. Out: windows out of bounds; those that overlap or touch are one finding,
   with the worst window. Error: relative 1e-14 of the window. Cost O(edges x windows their piece
   reaches). Source: Green's theorem. Test: test_rule_seeded.c. */

enum { MOST_WINDOWS = 1000000 };

/* parameters where an edge crosses x = c or y = c */
static int crossings(const fw_geometry_segment *s, bool x, double c, double *t) {
    int n = 0;
    if (s->kind == FW_LINE) {
        double a = x ? s->a.x : s->a.y, b = x ? s->b.x : s->b.y;
        if ((a < c) != (b < c)) t[n++] = (c - a) / (b - a);
        return n;
    }
    double d = (c - (x ? s->centre.x : s->centre.y)) / s->radius;
    if (!(fabs(d) < 1)) return 0;
    double other = sqrt(1 - d * d);
    for (int side = -1; side <= 1; side += 2) {
        fw_geometry_vec2 ray =
            x ? (fw_geometry_vec2){d, side * other} : (fw_geometry_vec2){side * other, d};
        if (fw_geometry_segment_faces(s, ray, &t[n])) n++;
    }
    return n;
}

/* integral of (x - x0) dy from parameter t to u */
static double below(const fw_geometry_segment *s, double t, double u, double x0) {
    if (s->kind == FW_LINE) {
        double x = s->a.x + 0.5 * (t + u) * (s->b.x - s->a.x);
        return (x - x0) * (u - t) * (s->b.y - s->a.y);
    }
    double start = atan2(s->a.y - s->centre.y, s->a.x - s->centre.x);
    double a = start + t * s->sweep_rad, b = start + u * s->sweep_rad, r = s->radius;
    return (s->centre.x - x0) * r * (sin(b) - sin(a)) +
           0.5 * r * r * (b - a + 0.5 * (sin(2 * b) - sin(2 * a)));
}

static double edge_area(const fw_geometry_segment *s, fw_geometry_box w) {
    double t[10] = {0, 1};
    int n = 2;
    n += crossings(s, true, w.x0, t + n);
    n += crossings(s, true, w.x1, t + n);
    n += crossings(s, false, w.y0, t + n);
    n += crossings(s, false, w.y1, t + n);
    fw_sort_doubles(t, (size_t)n);
    double sum = 0;
    for (int i = 0; i + 1 < n; i++) {
        fw_geometry_vec2 m = fw_geometry_segment_point(s, 0.5 * (t[i] + t[i + 1]));
        if (m.y < w.y0 || m.y > w.y1 || m.x < w.x0) continue;
        if (m.x <= w.x1)
            sum += below(s, t[i], t[i + 1], w.x0);
        else
            sum += (w.x1 - w.x0) * (fw_geometry_segment_point(s, t[i + 1]).y -
                                    fw_geometry_segment_point(s, t[i]).y);
    }
    return sum;
}

static double covered(const fw_mask_rules *rules, const fw_geometry_box *box, int layer,
                      fw_geometry_box w) {
    double sum = 0;
    for (int k = 0; k < rules->nshape; k++) {
        const fw_geometry_contour *c = &rules->shape[k].contour;
        if (rules->shape[k].layer != layer || box[k].x0 >= w.x1 || box[k].x1 <= w.x0 ||
            box[k].y0 >= w.y1 || box[k].y1 <= w.y0)
            continue;
        for (int i = 0; i < c->count; i++)
            sum += edge_area(&c->segment[i], w);
    }
    return sum;
}

static int windows(double from, double to, double side, double step) {
    return to - from <= side ? 1 : 1 + (int)ceil((to - from - side) / step - 1e-9);
}

static double start_of(int i, double from, double to, double side, double step) {
    return fmax(from, fmin(from + i * step, to - side));
}

/* < 1: out of bounds, and by how much */
static double badness(const fw_mask_rule *rule, double share) {
    double low = rule->least > 0 ? share / rule->least : HUGE_VAL;
    return fmin(low, share > 0 ? rule->most / share : HUGE_VAL);
}

static void merge(fw_mask_rules *rules, int first, fw_mask_finding f) {
    for (int i = first; i < rules->nfinding; i++) {
        fw_mask_finding *g = &rules->finding[i];
        if (g->what != f.what || fw_box_gap(g->box, f.box) > FW_COINCIDENT_M) continue;
        fw_geometry_box box = fw_box_join(g->box, f.box);
        if (badness(f.rule, g->value) < badness(f.rule, f.value)) f = *g;
        f.box = box;
        rules->finding[i] = rules->finding[--rules->nfinding];
        i = first - 1; /* the larger box may reach others */
    }
    fw_mask_rules_add(rules, f);
}

static void judge(fw_mask_rules *rules, const fw_mask_rule *rule, int first, fw_geometry_box w,
                  double share) {
    static const char thin[] = "low coverage", dense[] = "high coverage";
    if (!(badness(rule, share) < 1 - 1e-12)) return;
    bool low = share < rule->least;
    double limit = low ? rule->least : rule->most;
    merge(rules, first,
          (fw_mask_finding){.rule = rule,
                            .what = low ? thin : dense,
                            .at = {{w.x0, w.y0}, {w.x1, w.y1}},
                            .box = w,
                            .value = share,
                            .limit = limit,
                            .needed = limit,
                            .edge = {-1, -1}});
}

static fw_status check(fw_mask_rules *rules, const fw_mask_rule *rule) {
    fw_geometry_box all = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    fw_geometry_box *box = fw_arena_array(rules->arena, fw_geometry_box, (size_t)rules->nshape);
    FW_NEED(box);
    for (int k = 0; k < rules->nshape; k++)
        all = fw_box_join(all, box[k] = fw_geometry_contour_box(&rules->shape[k].contour));
    double step = fmax(rule->step_m, fmax(all.x1 - all.x0, all.y1 - all.y0) / sqrt(MOST_WINDOWS));
    double wide = fmin(rule->window_m, all.x1 - all.x0),
           high = fmin(rule->window_m, all.y1 - all.y0);
    int nx = windows(all.x0, all.x1, wide, step), ny = windows(all.y0, all.y1, high, step);
    int first = rules->nfinding;
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++) {
            double x = start_of(i, all.x0, all.x1, wide, step);
            double y = start_of(j, all.y0, all.y1, high, step);
            fw_geometry_box w = {x, y, x + wide, y + high};
            double share = covered(rules, box, rule->layer, w) / (wide * high);
            share = fmax(0, fmin(1, share)); /* round-off */
            judge(rules, rule, first, w, share);
        }
    return FW_OK;
}

const fw_mask_rule_kind_row fw_mask_kind_density = {
    .name = "density",
    .advice = "fill or empty the place, or spread what is there",
    .number = 157,
    .marker = 7,
    .unit = FW_UNIT_SHARE,
    .takes = FW_TAKES_MAX | FW_TAKES_WINDOW,
    .check = check,
};
