/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From exact outlines to polygons: joints between pieces, corners, flattening, bounds. */
#include "base/constants.h"
#include "mask/mask_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- joints and corners ---- */

static const double SAME_M = 1e-12;
static const fw_place nowhere;

/* to a picometre: what rounding leaves of 0 is no place */
const char *fw_mask_place_text(char *text, size_t n, fw_geometry_vec2 at) {
    char x[32], y[32];
    snprintf(text, n, "(%s, %s) um",
             fw_number_text(x, sizeof x, round(at.x * 1e12) * 1e-6 + 0.0, 7),
             fw_number_text(y, sizeof y, round(at.y * 1e12) * 1e-6 + 0.0, 7));
    return text;
}

double fw_mask_layer_bias_m(const fw_mask *mask, int layer) {
    if (mask->table->layer[layer].biased) return mask->bias_m;
    return mask->layer_bias_m ? mask->layer_bias_m[layer] : 0.0;
}

typedef struct joint {     /* one JOINT segment of one shape */
    int shape, segment;    /* segment of the biased contour */
    fw_geometry_vec2 a, b; /* drawn ends */
    int partner;           /* -1: none yet */
} joint;

static int next_joint(const fw_geometry_contour *c, int from) {
    for (int i = from; i < c->count; i++)
        if (c->segment[i].flags & FW_SEGMENT_JOINT) return i;
    return -1;
}

/* Partners are found by ends: by those that are drawn, until both have the same bits after the bias. Bias keeps the
   JOINT segments and their order, so that the k-th drawn one is the k-th biased one. */
static fw_status list_joints(fw_arena *arena, const fw_mask_shape *shape, int nshape,
                             bool drawn_ends, joint **out, int *count) {
    int n = 0;
    for (int s = 0; s < nshape; s++)
        for (int i = next_joint(&shape[s].contour, 0); i >= 0;
             i = next_joint(&shape[s].contour, i + 1))
            n++;
    joint *list = fw_arena_array(arena, joint, (size_t)n);
    FW_NEED(list);
    *count = 0;
    for (int s = 0; s < nshape; s++) {
        const fw_geometry_contour *biased = &shape[s].contour,
                                  *drawn = drawn_ends ? &shape[s].piece->contour : biased;
        int i = next_joint(drawn, 0), k = next_joint(biased, 0);
        for (; i >= 0 && k >= 0; i = next_joint(drawn, i + 1), k = next_joint(biased, k + 1))
            list[(*count)++] = (joint){s, k, drawn->segment[i].a, drawn->segment[i].b, -1};
        if (i >= 0 || k >= 0) return FW_INTERNAL;
    }
    *out = list;
    return FW_OK;
}

static bool same(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x == q.x && p.y == q.y;
}

static double apart(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return hypot(p.x - q.x, p.y - q.y);
}

static void pair_up(const fw_mask_shape *shape, joint *list, int count) {
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count && list[i].partner < 0; j++)
            if (list[j].partner < 0 && shape[list[i].shape].layer == shape[list[j].shape].layer &&
                same(list[i].a, list[j].b) && same(list[i].b, list[j].a)) {
                list[i].partner = j;
                list[j].partner = i;
            }
}

static void set_start(fw_geometry_contour *c, int i, fw_geometry_vec2 at) {
    c->segment[i].a = at;
    c->segment[(i + c->count - 1) % c->count].b = at;
}

static void no_partner(fw_diags *diags, const fw_mask_shape *shape, const joint *j,
                       const char *why) {
    char at[80];
    fw_geometry_vec2 middle = {0.5 * (j->a.x + j->b.x), 0.5 * (j->a.y + j->b.y)};
    fw_diag_error(diags, 146, nowhere,
                  "the joint of %s at %s %s; give both pieces the same edge and the same width "
                  "there",
                  shape->piece->label, fw_mask_place_text(at, sizeof at, middle), why);
}

fw_status fw_mask_join(fw_arena *arena, fw_mask_shape *shape, int nshape, fw_diags *diags) {
    joint *list;
    int count;
    size_t errors = diags->errors;
    FW_TRY(list_joints(arena, shape, nshape, true, &list, &count));
    pair_up(shape, list, count);
    for (int i = 0; i < count; i++) {
        const joint *p = &list[i];
        if (p->partner < 0) {
            no_partner(diags, &shape[p->shape], p, "has no partner on its layer");
            continue;
        }
        if (p->partner < i) continue;
        const joint *q = &list[p->partner];
        fw_geometry_contour *c = &shape[q->shape].contour;
        const fw_geometry_segment *from = &shape[p->shape].contour.segment[p->segment];
        fw_geometry_segment *to = &c->segment[q->segment];
        if (!(apart(from->a, to->b) <= SAME_M && apart(from->b, to->a) <= SAME_M)) {
            no_partner(diags, &shape[p->shape], p, "does not fit its partner after bias");
            continue;
        }
        if (same(from->a, to->b) && same(from->b, to->a)) continue;
        set_start(c, q->segment, from->b);
        set_start(c, (q->segment + 1) % c->count, from->a);
    }
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}

/* the polygon's edge whose ends round from a and b; false when there is none */
static bool edge_at(const fw_geometry_polygon *polygon, fw_geometry_vec2 a, fw_geometry_vec2 b,
                    fw_geometry_point *u, fw_geometry_point *v) {
    double x = a.x / FW_GEOMETRY_GRID_M; /* within the grid's range */
    int32_t low = (int32_t)floor(x) - 2, high = low + 5;
    for (int i = 0; i < polygon->count; i++) {
        fw_geometry_point s = polygon->vertex[i];
        if (s.x_dbu < low || s.x_dbu > high) continue; /* as nearly all are */
        fw_geometry_point e = polygon->vertex[i + 1 < polygon->count ? i + 1 : 0];
        fw_geometry_vec2 ps = {s.x_dbu * FW_GEOMETRY_GRID_M, s.y_dbu * FW_GEOMETRY_GRID_M},
                         pe = {e.x_dbu * FW_GEOMETRY_GRID_M, e.y_dbu * FW_GEOMETRY_GRID_M};
        if (fabs(ps.x - a.x) < FW_GEOMETRY_GRID_M && apart(ps, a) < FW_GEOMETRY_GRID_M &&
            apart(pe, b) < FW_GEOMETRY_GRID_M) {
            *u = s;
            *v = e;
            return true;
        }
    }
    return false;
}

fw_status fw_mask_check_joints(fw_arena *arena, const fw_mask_shape *shape, int nshape,
                               fw_diags *diags) {
    joint *list;
    int count;
    size_t errors = diags->errors;
    FW_TRY(list_joints(arena, shape, nshape, false, &list, &count));
    pair_up(shape, list, count);
    for (int i = 0; i < count; i++) {
        const joint *p = &list[i];
        if (p->partner < i) continue;
        const joint *q = &list[p->partner];
        const fw_geometry_segment *s = &shape[p->shape].contour.segment[p->segment];
        fw_geometry_point u, v, x, y;
        bool found = edge_at(&shape[p->shape].polygon, s->a, s->b, &u, &v) &&
                     edge_at(&shape[q->shape].polygon, s->b, s->a, &x, &y);
        if (!found || u.x_dbu != y.x_dbu || u.y_dbu != y.y_dbu || v.x_dbu != x.x_dbu ||
            v.y_dbu != x.y_dbu)
            no_partner(diags, &shape[p->shape], p, "has different grid points on its two sides");
    }
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}

static fw_geometry_vec2 place_of(fw_geometry_point p) {
    return (fw_geometry_vec2){p.x_dbu * FW_GEOMETRY_GRID_M, p.y_dbu * FW_GEOMETRY_GRID_M};
}

static bool ends_joint(const fw_geometry_contour *c, fw_geometry_point vertex) {
    fw_geometry_vec2 at = place_of(vertex);
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (s->flags & FW_SEGMENT_JOINT &&
            (hypot(s->a.x - at.x, s->a.y - at.y) < FW_GEOMETRY_GRID_M ||
             hypot(s->b.x - at.x, s->b.y - at.y) < FW_GEOMETRY_GRID_M))
            return true;
    }
    return false;
}

/* cosine of the angle between two edges of a vertex; exact sign: |coordinates| < 2^30 */
static double cosine(fw_geometry_point a, fw_geometry_point v, fw_geometry_point b) {
    int64_t ax = (int64_t)a.x_dbu - v.x_dbu, ay = (int64_t)a.y_dbu - v.y_dbu;
    int64_t bx = (int64_t)b.x_dbu - v.x_dbu, by = (int64_t)b.y_dbu - v.y_dbu;
    int64_t dot = ax * bx + ay * by;
    if (dot <= 0) return 0;
    return (double)dot / (hypot((double)ax, (double)ay) * hypot((double)bx, (double)by));
}

/* one message for what follows each other with one label, as the parts of a cell do */
void fw_mask_check_corners(const fw_mask_shape *shape, int nshape, fw_diags *diags) {
    int count = 0;
    double most = 0;
    fw_geometry_point worst = {0};
    for (int k = 0; k < nshape; k++) {
        const fw_geometry_polygon *p = &shape[k].polygon;
        const char *label = shape[k].piece->label;
        if (k == 0 || strcmp(shape[k - 1].piece->label, label) != 0) count = 0, most = 0;
        const bool ends = k + 1 == nshape || strcmp(shape[k + 1].piece->label, label) != 0;
        fw_geometry_point a = {0}, v = {0}, b;
        const int n = shape[k].report.acute ? p->count : 0; /* as measured of all corners */
        if (n) a = p->vertex[n - 1], v = p->vertex[0];
        for (int i = 0; i < n; i++, a = v, v = b) {
            b = p->vertex[i + 1 < n ? i + 1 : 0];
            double c = cosine(a, v, b);
            if (c <= 0 || ends_joint(&shape[k].contour, v)) continue;
            count++;
            if (c > most) most = c, worst = v;
        }
        if (count == 0 || !ends) continue;
        char at[80], degrees[32];
        fw_diag_warning(diags, 153, nowhere,
                        "%s has %d corner(s) below 90 degrees on the grid, the sharpest %s at %s; "
                        "width checks report them; round the corner",
                        label, count,
                        fw_number_text(degrees, sizeof degrees, acos(most) * 180 / FW_PI, 8),
                        fw_mask_place_text(at, sizeof at, place_of(worst)));
    }
}

/* ---- flattening ---- */

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
    m->box = (fw_geometry_box){
        fmin(m->box.x0, FW_GEOMETRY_GRID_M * x0), fmin(m->box.y0, FW_GEOMETRY_GRID_M * y0),
        fmax(m->box.x1, FW_GEOMETRY_GRID_M * x1), fmax(m->box.y1, FW_GEOMETRY_GRID_M * y1)};
}

/* ---- what a place belongs to ----
   Of one that cannot be drawn: mostly a hinge whose two heads were given
   no room, and then neither bias nor tolerance is what to change. Test: test_causes.c. */

/* of a hinge's keep-out disc: necks and root blocks reach a little beyond it */
static const double REACH = 1.25;

static const fw_layout_hinge_layout *hinge_at(const fw_layout *layout, int nhinge,
                                              fw_geometry_vec2 at) {
    const fw_layout_hinge_layout *best = NULL;
    double least = 1;
    for (int j = 0; j < nhinge; j++) {
        const fw_layout_hinge_layout *h = &layout->hinge[j];
        if (!h->drawn || !(h->keep_out_m > 0)) continue;
        double share = vec_distance(h->centre, at) / (REACH * h->keep_out_m);
        if (share < least) least = share, best = h;
    }
    return best;
}

/* the highest joint that a piece belongs to: others are not drawn */
static int hinges_of(const fw_layout *layout) {
    int n = 0;
    for (int i = 0; i < layout->npiece; i++)
        n = layout->piece[i].joint >= n ? layout->piece[i].joint + 1 : n;
    return n;
}

const fw_layout_hinge_layout *fw_mask_hinge_at(const fw_layout *layout, fw_geometry_vec2 at) {
    return isfinite(at.x + at.y) ? hinge_at(layout, hinges_of(layout), at) : NULL;
}

const char *fw_mask_cause(fw_arena *arena, const fw_layout *layout, fw_geometry_vec2 at) {
    const fw_layout_hinge_layout *h = fw_mask_hinge_at(layout, at);
    if (!h || !h->id) return "";
    char axis[32], wide[32];
    fw_number_text(axis, sizeof axis, h->axis_rad * 180 / FW_PI, 6);
    fw_number_text(wide, sizeof wide, 1e6 * h->gap_m, 4);
    const char *gap =
        h->gap_m > 0 ? fw_arena_printf(arena, ", or take a wider gap than its %s um", wide) : "";
    if (!gap) return NULL;
    return h->axis_stated
               ? fw_arena_printf(
                     arena,
                     "; the place belongs to %s%s, whose flexure bulges towards %s "
                     "deg because the file says so: its two sides have no room for each "
                     "other there, so turn its axis, or leave axis out to have one "
                     "chosen%s",
                     FW_NAMED("hinge", h->id), axis, gap)
               : fw_arena_printf(arena,
                                 "; the place belongs to %s%s, whose flexure bulges towards %s "
                                 "deg: state another axis for it, or move what is beside it%s",
                                 FW_NAMED("hinge", h->id), axis, gap);
}
