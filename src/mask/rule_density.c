/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Density: the share of a square window that a layer covers, least and most, in windows a step
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
#include "mask/rule.h"
#include "base/sort.h"
#include <stdlib.h>

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
