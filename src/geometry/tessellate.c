/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outlines as polygons on the grid: each arc as chords, the way along an outline with what is proven of it, and the
   triangles of a polygon. */
#include "geometry/polygon.h"
#include "base/constants.h"
#include "geometry/segment.h"
#include <string.h>

/* ---- one arc as chords ---- */

#define FW_GRID_PER_M 1e9                  /* 1 dbu = 1 nm */
#define FW_SNAP_M     (FW_SQRT_HALF / 1e9) /* what rounding moves a vertex at most */

/* floor(x + 1/2) for |x| < 2^30, without a call */
static inline int32_t round_half_up(double x) {
    int32_t n = (int32_t)(x + 0.5);
    return n - ((double)n > x + 0.5);
}

typedef struct arc_chords {   /* of one arc, seen from its lexicographically smaller end */
    fw_geometry_segment arc;  /* that way round, radius and sweep from the shared points alone */
    bool reversed;            /* the contour runs the other way */
    int n;                    /* arc_chords */
    double reach;             /* radius of the inner vertices over that of the arc */
    double edge_m;            /* farthest that a chord is from the arc, before rounding */
    double area_m2, length_m; /* area between arc and chords at most; length of the arc_chords */
    bool clean;               /* rounding leaves no vertex out and turns none the wrong way */
} arc_chords;

enum {
    MOST_CHORDS = 1 << 22,
    LANES = 8, /* points that are turned side by side: no one waits for another */
    ANEW = 64, /* blocks of LANES until sine and cosine are taken anew */
};

/* the arc as both of its neighbours see it: from the lexicographically smaller end, radius and
   sweep recomputed from the shared points alone */
static fw_geometry_segment canonical(const fw_geometry_segment *s, bool *reversed) {
    *reversed = vec_before(s->b, s->a) || (vec_same(s->a, s->b) && s->sweep_rad < 0);
    fw_geometry_segment c = *reversed ? fw_geometry_segment_reverse(s) : *s;
    c.radius = vec_distance(c.a, c.centre);
    c.sweep_rad = vec_same(c.a, c.b)
                      ? FW_TURN
                      : fw_geometry_angle_near(
                            fw_geometry_vec_angle(vec_sub(c.a, c.centre), vec_sub(c.b, c.centre)),
                            c.sweep_rad);
    return c;
}

static int whole_number(double n) {
    n = ceil(n);
    return n < 1 ? 1 : n > MOST_CHORDS ? MOST_CHORDS : (int)n;
}

/* Chords of an arc whose vertices lie on it: a chord of angle w/n has the sagitta
   R (1 - cos(w/2n)); with 4 asin(sqrt(eps / 2R)) = 2 acos(1 - eps/R), without its cancellation,
   n = ceil(|w| / step).
   In: radius, sweep (rad), eps (m). Out: n >= 1; chords have at most 120 degrees. Source:
   docs/theory/contours.md. Test: test_tessellate.c. */
static int chord_count(double radius, double sweep_rad, double eps) {
    double step = eps < 0.5 * radius ? 4 * asin(sqrt(0.5 * eps / radius)) : FW_TURN / 3;
    return whole_number(fabs(sweep_rad) / step);
}

/* Inner vertices at rho R such that the chords enclose the arc's own area, ends being on the arc.
   With the step t = |w|/n and k = t / sin t the n triangles are worth n sectors when
   (n - 2) rho^2 + 2 rho = n k, hence rho = n k / (1 + sqrt(1 + n (n - 2) k)).
   In: n >= 2, t < pi (rad). Out: rho >= 1, 1 + t^2 n / (12 (n - 1)) for small t. Error: some ulp.
   Test: test_tessellate.c, against the area of the arc. */
static double equal_area_reach(int n, double t) {
    double k = t / sin(t);
    return n * k / (1 + sqrt(1 + (double)n * (n - 2) * k));
}

/* how far such chords are from the arc: outside at the inner vertices, inside in the middle of the
   chords between two of them, and inside on the first and last chord, which start on the arc: its
   line is R rho R sin t / length from the centre */
static double equal_area_error(double radius, int n, double t, double rho, double *end_length) {
    double x = rho * cos(t) - 1, y = rho * sin(t), length = sqrt(x * x + y * y);
    double inside = n > 2 ? 1 - rho * cos(0.5 * t) : 0;
    *end_length = radius * length;
    return radius * fmax(fmax(rho - 1, inside), 1 - rho * sin(t) / length);
}

/* least n >= 2 with an error of at most eps. The sagitta s gives (2/3) s n/(n - 1) at the vertices
   and 0.69 s on the end chords, so that s = 1.5 eps is nearly right and never too small a number to
   start from. */
static void plan_equal_area(arc_chords *c, double eps) {
    double end, w = fabs(c->arc.sweep_rad), r = c->arc.radius;
    for (int n = chord_count(r, w, 1.5 * eps) < 2 ? 2 : chord_count(r, w, 1.5 * eps);; n++) {
        c->n = n;
        c->reach = equal_area_reach(n, w / n);
        c->edge_m = equal_area_error(r, n, w / n, c->reach, &end);
        if (c->edge_m <= eps || n >= MOST_CHORDS) break;
    }
    c->area_m2 = 0;
    c->length_m = 2 * end + (c->n - 2) * 2 * c->reach * r * sin(0.5 * w / c->n);
}

static arc_chords plan_chords(const fw_geometry_segment *arc, double tolerance_m,
                              fw_geometry_flattening kind) {
    arc_chords c = {.reach = 1};
    c.arc = canonical(arc, &c.reversed);
    double r = c.arc.radius, w = fabs(c.arc.sweep_rad);
    c.n = chord_count(r, w, tolerance_m);
    if (kind == FW_FLATTEN_EQUAL_AREA && c.n > 1)
        plan_equal_area(&c, tolerance_m);
    else { /* t - sin t <= t^3 / 6 */
        double t = w / c.n, sine = sin(0.25 * t);
        c.edge_m = 2 * r * sine * sine;
        c.area_m2 = c.n * 0.5 * r * r * fmin(t * t * t / 6, t + 1);
        c.length_m = c.n * 2 * r * sin(0.5 * t);
    }
    /* Turns of w/n against four roundings of g/sqrt 2 on chords of length c: (w/n) c >= 2.83 g. The
       margin covers the tangent of the tilt on chords of 16 g. */
    double t = w / c.n, chord = 2 * r * sin(0.5 * t) * FW_GRID_PER_M;
    c.clean = chord >= 16 && t * chord >= 2.9;
    return c;
}

/* two side by side: what every machine of 64 bits can do at once */
typedef double pair __attribute__((vector_size(16)));
typedef int64_t whole_pair __attribute__((vector_size(16)));
typedef uint64_t bit_pair __attribute__((vector_size(16)));
enum { PAIRS = LANES / 2 };

/* Nearest whole numbers in the lower half of each lane, halves upwards. In: |x| < 2^31. Adding
   1.5 2^52 leaves the nearest even one of the two in the lowest bits, exactly; where that is half
   below x, one more. */
static inline whole_pair nearest(pair x) {
    const double magic = 6755399441055744.0;
    pair shifted = x + magic, rest = x - (shifted - magic);
    return (whole_pair)shifted - (rest >= 0.5);
}

/* two points from the lower halves, to at[0] and at[way] */
static inline void store(fw_geometry_point *at, int way, whole_pair x, whole_pair y) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    bit_pair both = ((bit_pair)x & 0xffffffffu) | ((bit_pair)y << 32);
    uint64_t first = both[0], second = both[1];
    memcpy(at, &first, sizeof first);
    memcpy(at + way, &second, sizeof second);
#else
    for (int i = 0; i < 2; i++)
        at[way * i] = (fw_geometry_point){(int32_t)(uint32_t)(x[i] & 0xffffffff),
                                          (int32_t)(uint32_t)(y[i] & 0xffffffff)};
#endif
}

static fw_geometry_vec2 product(fw_geometry_vec2 p, fw_geometry_vec2 q) { /* of complex numbers */
    return (fw_geometry_vec2){p.x * q.x - p.y * q.y, p.y * q.x + p.x * q.y};
}

/* LANES points, LANES / 2 of them at a time, and all of them turned on */
static inline void block_of(pair *x, pair *y, fw_geometry_vec2 centre, fw_geometry_vec2 step,
                            fw_geometry_point *at, int way) {
    for (int i = 0; i < PAIRS; i++) {
        store(at + 2 * i * way, way, nearest(centre.x + x[i]), nearest(centre.y + y[i]));
        pair turned = step.x * x[i] - step.y * y[i];
        y[i] = step.y * x[i] + step.x * y[i];
        x[i] = turned;
    }
}

/* Points end, turned by (first + k) h, k = 0 .. n-1, about the centre, rounded to the grid half up:
   LANES side by side, each turned on by LANES h, anew from sine and cosine every ANEW blocks.
   In: centre and arm (dbu), all points within 2^30; by: cosine and sine of h. Out: at[0], at[way]
   .. Error before rounding: ANEW steps of some 2^-53 R, below 1e-13 R. Cost: about 1 ns a point.
   Test: test_tessellate.c. */
static void turn_about(fw_geometry_vec2 centre, fw_geometry_vec2 end, double first, double h,
                       fw_geometry_vec2 by, int n, fw_geometry_point *at, int way) {
    fw_geometry_vec2 step = product(by, by);
    step = product(step, step);
    step = product(step, step); /* LANES = 8 times h */
    pair x[PAIRS] = {{0}}, y[PAIRS] = {{0}};
    for (int k = 0, block = 0; k < n; k += LANES, block++) {
        if (block % ANEW == 0) {
            fw_geometry_vec2 arm = fw_geometry_vec_rotate(end, (first + k) * h);
            for (int i = 0; i < LANES; i++, arm = product(by, arm))
                x[i / 2][i % 2] = arm.x, y[i / 2][i % 2] = arm.y;
        }
        fw_geometry_point rest[LANES];
        if (n - k >= LANES) {
            block_of(x, y, centre, step, at + way * k, way);
            continue;
        }
        block_of(x, y, centre, step, rest, 1);
        for (int i = 0; k + i < n; i++)
            at[way * (k + i)] = rest[i];
    }
}

/* vertices k/n of the arc, k = 1..n-1, from both ends to its middle: always as `canonical` has it,
   so that both neighbours of an arc find the same */
static void chord_points(const arc_chords *c, fw_geometry_point *at) {
    int n = c->n, half = n / 2 < n ? n / 2 : n - 1, rest = n - 1 - half;
    double h = c->arc.sweep_rad / n, scale = c->reach * FW_GRID_PER_M;
    fw_geometry_vec2 centre = vec_scale(FW_GRID_PER_M, c->arc.centre);
    fw_geometry_vec2 a = vec_scale(scale, vec_sub(c->arc.a, c->arc.centre));
    fw_geometry_vec2 b = vec_scale(scale, vec_sub(c->arc.b, c->arc.centre));
    fw_geometry_vec2 by = {cos(h), sin(h)};
    int way = c->reversed ? -1 : 1;
    if (c->reversed) at += n - 2;
    turn_about(centre, a, 1, h, by, half, at, way);
    turn_about(centre, b, -rest, h, by, rest, at + way * half, way);
}

/* ---- the way along an outline ---- */

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
    return (fw_geometry_point){round_half_up(p.x * FW_GRID_PER_M),
                               round_half_up(p.y * FW_GRID_PER_M)};
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
static bool arc_proven(const arc_chords *c, const fw_geometry_segment *s, double tolerance_m,
                       const fw_geometry_point *inner, fw_geometry_point start, double *next_m) {
    double sine = sin(0.25 * fabs(c->arc.sweep_rad) / c->n);
    if (c->n < 2 || tolerance_m >= 4 * PROVEN_SAGITTA_M ||
        2 * c->arc.radius * sine * sine >= PROVEN_SAGITTA_M)
        return true;
    fw_geometry_point end = rounded(s->b);
    sine = sin(0.25 * fabs(c->arc.sweep_rad) / (c->n - 1));
    *next_m = 2 * c->arc.radius * sine * sine;
    return keeps_sense(inner, c->n - 1, start, end, s->sweep_rad > 0);
}

/* Inner vertices of an arc. Of a clean one only the first can make its start
   needless or repeat it; then, and where rounding can do more, one by one. */
static bool add_arc(builder *b, const arc_chords *c, const fw_geometry_segment *s,
                    double tolerance_m, double *next_m) {
    if (c->n < 2) return true;
    fw_geometry_point *first = b->vertex + b->count, start = first[-1];
    chord_points(c, first);
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
                      fw_geometry_flattening kind, arc_chords *chords, double *most,
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
        chords[i] = plan_chords(s, tolerance_m, kind);
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
static int run_along(builder *b, const fw_geometry_contour *contour, const arc_chords *chords,
                     double tolerance_m, double *next_m) {
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
    arc_chords few[FEW_SEGMENTS], *chords = few;
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
    arc_chords chords = {.n = 1};
    fw_geometry_box box = fw_segment_box(s);
    if (!in_range(&box, tolerance_m)) return FW_LIMIT;
    if (s->kind == FW_ARC) chords = plan_chords(s, tolerance_m, kind);
    *n = chords.n + 1;
    FW_NEED(*at = fw_arena_raw(arena, (size_t)*n * sizeof **at));
    (*at)[0] = rounded(s->a);
    if (chords.n > 1) chord_points(&chords, *at + 1);
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

/* ---- triangles of a polygon on the grid, in exact integers ---- */

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
