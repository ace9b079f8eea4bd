/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/tessellate.h"
#include "geometry/geometry_flatten.h"
#include "geometry/polygon.h"
#include <string.h>

#define PROVEN_SAGITTA_M 0.3536e-9 /* g sqrt 2 / 4: rounding cannot turn such chords' corners */
enum { FEW_SEGMENTS = 16 };        /* planned on the stack */
static const double FARTHEST_DBU = 1073741823.0;

typedef struct builder {
    fw_geometry_point *vertex;
    int count;
    bool fixed;       /* the last vertex: an end of a joint, kept even on a straight line */
    bool first_fixed; /* so is the first one */
} builder;

static bool same_point(fw_geometry_point p, fw_geometry_point q) {
    return p.x_dbu == q.x_dbu && p.y_dbu == q.y_dbu;
}

/* is q on the straight way from p to r, exactly? */
static bool on_the_way(fw_geometry_point p, fw_geometry_point q, fw_geometry_point r) {
    int64_t ax = (int64_t)q.x_dbu - p.x_dbu, ay = (int64_t)q.y_dbu - p.y_dbu;
    int64_t bx = (int64_t)r.x_dbu - q.x_dbu, by = (int64_t)r.y_dbu - q.y_dbu;
    return ax * by - ay * bx == 0 && ax * bx + ay * by > 0;
}

/* the next vertex: none that repeats the last one, and the last one goes where it lies exactly on
   the way to this one, unless it ends a joint */
static void add(builder *b, fw_geometry_point p, bool fixed) {
    if (b->count > 0 && same_point(b->vertex[b->count - 1], p)) {
        b->fixed |= fixed;
    } else {
        if (b->count > 1 && !b->fixed &&
            on_the_way(b->vertex[b->count - 2], b->vertex[b->count - 1], p))
            b->count--;
        b->vertex[b->count++] = p;
        b->fixed = fixed;
    }
    if (b->count == 1) b->first_fixed |= b->fixed;
}

static fw_geometry_point rounded(fw_geometry_vec2 p) {
    return (fw_geometry_point){fw_round_half_up(p.x * FW_GRID_PER_M),
                               fw_round_half_up(p.y * FW_GRID_PER_M)};
}

/* Do the rounded corners of an arc's chords keep the sense of the arc? From one end to the other,
   both included; a corner that rounding made straight has gone. Exact integers. */
static bool keeps_sense(const fw_geometry_point *inner, int n, fw_geometry_point start,
                        fw_geometry_point end, bool left) {
    fw_geometry_point p = start, q = start;
    for (int i = 0; i <= n; i++) {
        fw_geometry_point r = i < n ? inner[i] : end;
        if (same_point(q, r)) continue;
        int64_t ax = (int64_t)q.x_dbu - p.x_dbu, ay = (int64_t)q.y_dbu - p.y_dbu;
        int64_t bx = (int64_t)r.x_dbu - q.x_dbu, by = (int64_t)r.y_dbu - q.y_dbu;
        int64_t turn = ax * by - ay * bx;
        if ((left ? turn < 0 : turn > 0) || (turn == 0 && ax * bx + ay * by < 0)) return false;
        p = q, q = r;
    }
    return true;
}

/* Rounding n up leaves a sagitta of eps/4 at worst (n = 2). From 0.354 nm on the corners are safe
   whatever the radius is; below, it is looked at what became of them. False: one turned; *next_m is
   the sagitta of one chord less. */
static bool arc_proven(const fw_geometry_chords *c, const fw_geometry_segment *s,
                       double tolerance_m, const fw_geometry_point *inner, fw_geometry_point start,
                       double *next_m) {
    double sine = sin(0.25 * fabs(c->arc.sweep_rad) / c->n);
    if (c->n < 2 || tolerance_m >= 4 * PROVEN_SAGITTA_M ||
        2 * c->arc.radius * sine * sine >= PROVEN_SAGITTA_M)
        return true;
    fw_geometry_point end = rounded(s->b);
    sine = sin(0.25 * fabs(c->arc.sweep_rad) / (c->n - 1));
    *next_m = 2 * c->arc.radius * sine * sine;
    return keeps_sense(inner, c->n - 1, start, end, s->sweep_rad > 0);
}

/* Inner vertices of an arc. Of a clean one (geometry_flatten.h) only the first can make its start
   needless or repeat it; then, and where rounding can do more, one by one. */
static bool add_arc(builder *b, const fw_geometry_chords *c, const fw_geometry_segment *s,
                    double tolerance_m, double *next_m) {
    if (c->n < 2) return true;
    fw_geometry_point *first = b->vertex + b->count, start = first[-1];
    fw_geometry_flatten_points(c, first);
    if (!arc_proven(c, s, tolerance_m, first, start, next_m)) return false;
    bool goes = b->count > 1 && !b->fixed && on_the_way(first[-2], start, first[0]);
    if (c->clean && !goes && !same_point(start, first[0])) {
        b->count += c->n - 1;
        b->fixed = false;
        return true;
    }
    for (int i = 0; i < c->n - 1; i++)
        add(b, first[i], false);
    return true;
}

/* where the last vertex meets the first */
static fw_geometry_point *closed(builder *b) {
    fw_geometry_point *v = b->vertex;
    while (b->count > 1 && same_point(v[0], v[b->count - 1])) {
        b->first_fixed |= b->fixed;
        b->count--;
        b->fixed = true; /* whether it is, was not kept: it may stay */
    }
    if (b->count > 3 && !b->fixed && on_the_way(v[b->count - 2], v[b->count - 1], v[0])) b->count--;
    if (b->count > 3 && !b->first_fixed && on_the_way(v[b->count - 1], v[0], v[1])) {
        b->count--;
        v++;
    }
    return v;
}

/* all of the outline within the grid's range, with room for vertices outside of arcs */
static bool in_range(const fw_geometry_box *box, double tolerance_m) {
    double most = fmax(fmax(fabs(box->x0), fabs(box->x1)), fmax(fabs(box->y0), fabs(box->y1)));
    return (most + tolerance_m) * FW_GRID_PER_M < FARTHEST_DBU;
}

/* Room for all vertices, and what of the bounds does not depend on rounding: *length_m of the
   polygon, chords instead of arcs. */
static void plan_arcs(const fw_geometry_contour *contour, double tolerance_m,
                      fw_geometry_flattening kind, fw_geometry_chords *chords, double *most,
                      double *length_m, fw_geometry_flat_bounds *bounds) {
    *most = *length_m = 0;
    *bounds = (fw_geometry_flat_bounds){.wavy = -1};
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        if (s->kind == FW_LINE) {
            *most += 1;
            *length_m += vec_distance(s->a, s->b);
            continue;
        }
        chords[i] = fw_geometry_flatten_plan(s, tolerance_m, kind);
        *most += chords[i].n;
        *length_m += chords[i].length_m;
        bounds->area_m2 += chords[i].area_m2;
        bounds->edge_m = fmax(bounds->edge_m, chords[i].edge_m);
    }
}

/* Rounding moves each vertex by at most e = g/sqrt 2. With moves m_i the area changes by
   sum m_i x (p_(i+1) - p_(i-1)) / 2 + sum m_i x m_(i+1) / 2 <= e (length) + n e^2 / 2; to which the
   error of the doubles is added, some 1e-12 of the numbers that are summed. Test:
   test_tessellate.c. */
static void bound_rounding(double length_m, int n, const fw_geometry_box *box,
                           fw_geometry_flat_bounds *bounds) {
    double size = (box->x1 - box->x0) * (box->y1 - box->y0);
    bounds->area_m2 = bounds->area_m2 * (1 + 1e-9) + FW_SNAP_M * length_m * (1 + 1e-9) +
                      0.5 * n * FW_SNAP_M * FW_SNAP_M + 1e-12 * size;
    bounds->edge_m = bounds->edge_m * (1 + 1e-9) + FW_SNAP_M;
}

/* the arc whose corners rounding turned, or -1 */
static int run_along(builder *b, const fw_geometry_contour *contour,
                     const fw_geometry_chords *chords, double tolerance_m, double *next_m) {
    for (int i = 0; i < contour->count; i++) {
        const fw_geometry_segment *s = &contour->segment[i];
        const fw_geometry_segment *before = &contour->segment[i > 0 ? i - 1 : contour->count - 1];
        add(b, rounded(s->a), (s->flags | before->flags) & FW_SEGMENT_JOINT);
        if (s->kind == FW_ARC && !add_arc(b, &chords[i], s, tolerance_m, next_m)) return i;
    }
    return -1;
}

fw_status fw_geometry_flatten(fw_arena *arena, const fw_geometry_contour *contour,
                              double tolerance_m, fw_geometry_flattening kind,
                              fw_geometry_polygon *polygon, fw_geometry_flat_bounds *bounds) {
    *polygon = (fw_geometry_polygon){0};
    if (bounds) *bounds = (fw_geometry_flat_bounds){.wavy = -1};
    if (!(tolerance_m >= FW_LEAST_TOLERANCE_M * (1 - 1e-12)) || !isfinite(tolerance_m))
        return FW_INPUT;
    if (!fw_geometry_contour_valid(contour)) return FW_GEOMETRY;
    fw_geometry_box box = fw_geometry_contour_box(contour);
    if (!in_range(&box, tolerance_m)) return FW_LIMIT;
    fw_geometry_chords few[FEW_SEGMENTS], *chords = few;
    fw_geometry_flat_bounds proven;
    double most, length_m;
    if (contour->count > FEW_SEGMENTS)
        FW_NEED(chords = fw_arena_raw(arena, (size_t)contour->count * sizeof *chords));
    plan_arcs(contour, tolerance_m, kind, chords, &most, &length_m, &proven);
    if (!(most < 1e9)) return FW_LIMIT;
    builder b = {
        .vertex = fw_arena_raw(arena, (size_t)most * sizeof(fw_geometry_point))}; /* < 8e9 bytes */
    FW_NEED(b.vertex);
    proven.wavy = run_along(&b, contour, chords, tolerance_m, &proven.next_m);
    if (proven.wavy >= 0) {
        if (bounds) *bounds = proven;
        return FW_GEOMETRY;
    }
    fw_geometry_point *vertex = closed(&b);
    if (b.count < 3) return FW_GEOMETRY;
    bound_rounding(length_m, (int)most, &box, &proven);
    *polygon = (fw_geometry_polygon){vertex, b.count};
    if (bounds) *bounds = proven;
    return FW_OK;
}

fw_status fw_geometry_flatten_segment(fw_arena *arena, const fw_geometry_segment *s,
                                      double tolerance_m, fw_geometry_flattening kind,
                                      fw_geometry_point **at, int *n) {
    fw_geometry_chords chords = {.n = 1};
    fw_geometry_box box = fw_segment_box(s);
    if (!in_range(&box, tolerance_m)) return FW_LIMIT;
    if (s->kind == FW_ARC) chords = fw_geometry_flatten_plan(s, tolerance_m, kind);
    *n = chords.n + 1;
    FW_NEED(*at = fw_arena_raw(arena, (size_t)*n * sizeof **at));
    (*at)[0] = rounded(s->a);
    if (chords.n > 1) fw_geometry_flatten_points(&chords, *at + 1);
    (*at)[chords.n] = rounded(s->b);
    return FW_OK;
}

fw_status fw_geometry_tessellate(fw_arena *arena, const fw_geometry_contour *contour,
                                 double tolerance_m, fw_geometry_polygon *polygon) {
    return fw_geometry_flatten(arena, contour, tolerance_m, FW_FLATTEN_INSIDE, polygon, NULL);
}

int64_t fw_geometry_polygon_area2(const fw_geometry_polygon *polygon) {
    uint64_t sum = 0; /* it may pass over 2^64 and back: the result does not */
    int n = polygon->count;
    fw_geometry_point p = n > 0 ? polygon->vertex[n - 1] : (fw_geometry_point){0, 0};
    for (int i = 0; i < n; i++) {
        fw_geometry_point q = polygon->vertex[i];
        sum += (uint64_t)((int64_t)p.x_dbu * q.y_dbu - (int64_t)p.y_dbu * q.x_dbu);
        p = q;
    }
    return (int64_t)sum;
}

/* Triangles of a polygon on the grid, in exact integers. */

typedef struct ring {
    const fw_geometry_point *v;
    int *next, *before; /* of the vertices that are left */
    int *not_convex;    /* (count) vertices that may lie in a triangle */
    int *place;         /* in that list; -1: convex */
    int count;
} ring;

static int64_t turn(const ring *r, int i) {
    return fw_cross(r->v[r->before[i]], r->v[i], r->v[r->next[i]]);
}

static void becomes_convex(ring *r, int i) {
    if (r->place[i] < 0 || turn(r, i) <= 0) return;
    int last = r->not_convex[--r->count];
    r->not_convex[r->place[i]] = last;
    r->place[last] = r->place[i];
    r->place[i] = -1;
}

/* in the closed triangle, which runs counter-clockwise */
static bool covers(fw_geometry_point a, fw_geometry_point b, fw_geometry_point c,
                   fw_geometry_point p) {
    return fw_cross(a, b, p) >= 0 && fw_cross(b, c, p) >= 0 && fw_cross(c, a, p) >= 0;
}

static int32_t least(int32_t a, int32_t b, int32_t c) {
    int32_t m = a < b ? a : b;
    return m < c ? m : c;
}

static int32_t most(int32_t a, int32_t b, int32_t c) {
    int32_t m = a > b ? a : b;
    return m > c ? m : c;
}

static bool is_ear(const ring *r, int i) {
    if (r->place[i] >= 0) return false;
    int p = r->before[i], n = r->next[i];
    fw_geometry_point a = r->v[p], b = r->v[i], c = r->v[n];
    int32_t x0 = least(a.x_dbu, b.x_dbu, c.x_dbu), x1 = most(a.x_dbu, b.x_dbu, c.x_dbu);
    int32_t y0 = least(a.y_dbu, b.y_dbu, c.y_dbu), y1 = most(a.y_dbu, b.y_dbu, c.y_dbu);
    for (int k = 0; k < r->count; k++) {
        int q = r->not_convex[k];
        fw_geometry_point at = r->v[q];
        if (at.x_dbu < x0 || at.x_dbu > x1 || at.y_dbu < y0 || at.y_dbu > y1) continue;
        if (q != p && q != n && covers(a, b, c, at)) return false;
    }
    return true;
}

static fw_status start(fw_arena *arena, const fw_geometry_polygon *p, ring *r) {
    size_t n = (size_t)p->count;
    *r = (ring){.v = p->vertex,
                .next = fw_arena_array(arena, int, n),
                .before = fw_arena_array(arena, int, n),
                .not_convex = fw_arena_array(arena, int, n),
                .place = fw_arena_array(arena, int, n)};
    if (!r->next || !r->before || !r->not_convex || !r->place) return FW_NOMEM;
    for (int i = 0; i < p->count; i++) {
        r->next[i] = i + 1 < p->count ? i + 1 : 0;
        r->before[i] = i > 0 ? i - 1 : p->count - 1;
    }
    for (int i = 0; i < p->count; i++) {
        r->place[i] = turn(r, i) > 0 ? -1 : r->count;
        if (r->place[i] >= 0) r->not_convex[r->count++] = i;
    }
    return FW_OK;
}

/* Ears are cut off until three vertices are left (Meisters 1975: there are always two). An ear is a
   corner of less than 180 degrees whose closed triangle has no other vertex in it; vertices on a
   straight way count as such, so that no triangle is flat and every vertex is used. In: a simple
   polygon, counter-clockwise (fw_geometry_polygon_check). Out: (count - 2) triangles, vertex
   numbers, counter-clockwise. Exact. Cost: O(n r) for r corners that are not convex, n tries at
   best, n^2 at worst. FW_GEOMETRY: the polygon is not simple. Source: G. H. Meisters, "Polygons
   have ears", Am. Math. Monthly 82 (1975) 648. Test: test_triangulate.c. */
fw_status fw_geometry_polygon_triangulate(fw_arena *arena, const fw_geometry_polygon *polygon,
                                          fw_geometry_polygon_triangle *out) {
    ring r;
    if (polygon->count < 3) return FW_GEOMETRY;
    fw_mark mark = fw_arena_mark(arena);
    FW_TRY(start(arena, polygon, &r));
    int left = polygon->count, at = 0, made = 0, missed = 0;
    while (left > 3 && missed <= left) {
        if (!is_ear(&r, at)) {
            at = r.next[at];
            missed++;
            continue;
        }
        int p = r.before[at], n = r.next[at];
        out[made++] = (fw_geometry_polygon_triangle){{p, at, n}};
        r.next[p] = n;
        r.before[n] = p;
        becomes_convex(&r, p);
        becomes_convex(&r, n);
        at = r.next[n]; /* not from one corner only: triangles would be needles */
        left--;
        missed = 0;
    }
    bool whole = left == 3 && turn(&r, at) > 0;
    out[made] = (fw_geometry_polygon_triangle){{r.before[at], at, r.next[at]}};
    fw_arena_rewind(arena, mark);
    return whole ? FW_OK : FW_GEOMETRY;
}
