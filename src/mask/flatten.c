/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask_polygons.h"
#include <string.h>

static const char *const names[] = {
    [FW_FLATTEN_INSIDE] = "inside", [FW_FLATTEN_EQUAL_AREA] = "equal-area"};

bool fw_mask_flattening_named(const char *name, fw_geometry_flattening *kind) {
    *kind = FW_FLATTEN_INSIDE;
    if (!name || !*name) return true;
    for (int k = 0; k < 2; k++)
        if (strcmp(name, names[k]) == 0) {
            *kind = (fw_geometry_flattening)k;
            return true;
        }
    return false;
}

const char *fw_mask_flattening_name(fw_geometry_flattening kind) {
    return names[kind];
}

void fw_mask_set_flattening(fw_mask_shape *shape, int nshape, fw_geometry_flattening kind) {
    for (int k = 0; k < nshape; k++)
        shape[k].flattening = kind;
}

/* Nearest point of q over 65 points of p, from its middle outwards: of parallel edges the middle,
   where a microscope finds it. Where a chord square on both, or at an end, is shorter than that, it
   is the one. In: two edges. Out: the chord. Error: some ulp of the coordinates. Cost: 65 feet.
   Test: test_mask_flatten.c. */
fw_geometry_chord fw_mask_narrowest(const fw_geometry_segment *p, const fw_geometry_segment *q) {
    fw_geometry_chord best = {0}, exact[FW_MOST_CHORDS];
    double least = HUGE_VAL;
    for (int k = 0; k <= 64; k++) {
        fw_geometry_chord c = {.tp = 0.5 + (k % 2 ? 1 : -1) * ((k + 1) / 2) / 64.0};
        c.at_p = fw_geometry_segment_point(p, c.tp);
        double length = fw_geometry_segment_nearest(q, c.at_p, &c.tq, &c.at_q);
        if (length > least - FW_COINCIDENT_M) continue;
        least = length;
        best = c;
    }
    int n = fw_geometry_segment_chords(p, q, exact);
    for (int k = 0; k < n; k++) {
        double length = vec_distance(exact[k].at_p, exact[k].at_q);
        if (length > least - FW_COINCIDENT_M || length <= FW_COINCIDENT_M) continue;
        least = length;
        best = exact[k];
    }
    return best;
}

/* Can the arc be divided at t without a part so short that rounding turns its corners? A part of
   one chord needs the sagitta R (1 - cos(w/2)) >= g sqrt 2 / 4 (docs/theory/contours.md). */
static bool divisible(const fw_geometry_segment *s, double t) {
    const double least_m = 0.36e-9;
    if (s->kind != FW_ARC || !(t > 0 && t < 1)) return false;
    double sine = sin(0.25 * fmin(t, 1 - t) * fabs(s->sweep_rad));
    return 2 * s->radius * sine * sine >= least_m;
}

/* the outline with one more end on each of two arcs */
static fw_status divide(fw_arena *arena, const fw_geometry_contour *c, const fw_mask_neck *neck,
                        fw_geometry_contour *out) {
    int n = 0;
    FW_NEED(out->segment = fw_arena_array(arena, fw_geometry_segment, (size_t)c->count + 2));
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        int k = i == neck->segment[0] ? 0 : i == neck->segment[1] ? 1 : -1;
        if (k < 0 || !neck->divided[k]) {
            out->segment[n++] = *s;
            continue;
        }
        out->segment[n++] = fw_geometry_segment_cut(s, 0, s->a, neck->t[k], neck->at[k]);
        out->segment[n++] = fw_geometry_segment_cut(s, neck->t[k], neck->at[k], 1, s->b);
    }
    out->count = n;
    return FW_OK;
}

/* the vertex that a place became; false: there is none within the rounding */
static bool vertex_at(const fw_geometry_polygon *p, fw_geometry_vec2 at,
                      fw_geometry_point *vertex) {
    for (int i = 0; i < p->count; i++) {
        double x = p->vertex[i].x_dbu - at.x * 1e9, y = p->vertex[i].y_dbu - at.y * 1e9;
        if (!(fabs(x) <= 0.5 + 1e-6 && fabs(y) <= 0.5 + 1e-6)) continue;
        *vertex = p->vertex[i];
        return true;
    }
    return false;
}

/* the narrowest place of a flexure; false: it has none (no two edges face each other) */
static bool find_neck(const fw_geometry_contour *c, int segment[2], fw_geometry_chord *chord) {
    if (!isfinite(fw_geometry_contour_clearance(c, true, &segment[0], &segment[1])) ||
        segment[0] < 0 || segment[0] == segment[1])
        return false;
    *chord = fw_mask_narrowest(&c->segment[segment[0]], &c->segment[segment[1]]);
    return true;
}

fw_status fw_mask_flatten(fw_arena *arena, fw_mask_shape *shape, double tolerance_m,
                          fw_mask_wavy_arc *wavy) {
    int segment[2];
    fw_geometry_chord chord;
    fw_geometry_contour contour = shape->contour;
    fw_geometry_flat_bounds bounds;
    fw_mask_neck *neck = &shape->neck;
    *neck = (fw_mask_neck){0};
    *wavy = (fw_mask_wavy_arc){.there = false};
    if (shape->piece->role == FW_ROLE_FLEXURE && find_neck(&shape->contour, segment, &chord)) {
        const fw_geometry_segment *s = shape->contour.segment;
        *neck = (fw_mask_neck){
            .at = {chord.at_p, chord.at_q},
            .segment = {segment[0], segment[1]},
            .t = {chord.tp, chord.tq},
            .divided = {divisible(&s[segment[0]], chord.tp), divisible(&s[segment[1]], chord.tq)},
            .there = true};
        FW_TRY(divide(arena, &shape->contour, neck, &contour));
    }
    fw_status status = fw_geometry_flatten(arena, &contour, tolerance_m, shape->flattening,
                                           &shape->polygon, &bounds);
    if (status == FW_GEOMETRY && bounds.wavy >= 0 && contour.count != shape->contour.count) {
        contour = shape->contour; /* the parts of an arc are shorter than it is */
        neck->divided[0] = neck->divided[1] = false;
        status = fw_geometry_flatten(arena, &contour, tolerance_m, shape->flattening,
                                     &shape->polygon, &bounds);
    }
    if (status == FW_GEOMETRY && bounds.wavy >= 0)
        *wavy = (fw_mask_wavy_arc){true, contour.segment[bounds.wavy], bounds.next_m};
    FW_TRY(status);
    shape->bound_m2 = bounds.area_m2;
    shape->edge_m = bounds.edge_m;
    for (int k = 0; neck->there && k < 2; k++)
        neck->on_vertex[k] = vertex_at(&shape->polygon, neck->at[k], &neck->vertex[k]);
    return FW_OK;
}

void fw_mask_measure_start(fw_mask_measure *m) {
    m->shortest_edge_m = m->sharpest_rad = HUGE_VAL;
    m->sharpest_material_rad = m->sharpest_space_rad = HUGE_VAL;
    m->edge_m = m->straight = 0;
    m->box = (fw_geometry_box){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
}

void fw_mask_measure_add(fw_mask_measure *m, const fw_mask_shape *s) {
    const fw_geometry_polygon_report *r = &s->report;
    m->shortest_edge_m = fmin(m->shortest_edge_m, r->shortest_edge_m);
    m->sharpest_rad = fmin(m->sharpest_rad, r->sharpest_rad);
    m->sharpest_material_rad = fmin(m->sharpest_material_rad, r->sharpest_material_rad);
    m->sharpest_space_rad = fmin(m->sharpest_space_rad, r->sharpest_space_rad);
    m->edge_m = fmax(m->edge_m, s->edge_m);
    m->straight += r->straight;
    int32_t x0 = INT32_MAX, y0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
    for (int i = 0; i < s->polygon.count; i++) {
        fw_geometry_point p = s->polygon.vertex[i];
        x0 = p.x_dbu < x0 ? p.x_dbu : x0, x1 = p.x_dbu > x1 ? p.x_dbu : x1;
        y0 = p.y_dbu < y0 ? p.y_dbu : y0, y1 = p.y_dbu > y1 ? p.y_dbu : y1;
    }
    m->box = (fw_geometry_box){fmin(m->box.x0, 1e-9 * x0), fmin(m->box.y0, 1e-9 * y0),
                               fmax(m->box.x1, 1e-9 * x1), fmax(m->box.y1, 1e-9 * y1)};
}
