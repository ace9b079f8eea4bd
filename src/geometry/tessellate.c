/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/tessellate.h"
#include "geometry/segment.h"
#include <string.h>

#define GRID_PER_M      1e9     /* 1 dbu = 1 nm */
#define LEAST_SAGITTA_M 1.42e-9 /* below it rounding can turn an arc's corners the wrong way */

enum { MOST_CHORDS = 1 << 22 };

/* Chords of an arc: a chord of angle h has the sagitta R (1 - cos(h/2)); with h = 4 asin(sqrt(eps /
   2R)) = 2 acos(1 - eps/R), without its cancellation, n = ceil(|sweep| / h).
   In: radius, sweep (rad), eps (m). Out: n >= 1; an arc of any size keeps chords of at most 120
   degrees. Source: docs/theory/contours.md. Test: test_tessellate.c. */
static int chord_count(double radius, double sweep_rad, double eps) {
    double step = eps < 0.5 * radius ? 4 * asin(sqrt(0.5 * eps / radius)) : FW_TURN / 3;
    double n = ceil(fabs(sweep_rad) / step);
    return n < 1 ? 1 : n > MOST_CHORDS ? MOST_CHORDS : (int)n;
}

/* the arc as both of its neighbours see it: from the lexicographically smaller end, radius and
   sweep recomputed from the shared points alone */
static fw_segment canonical(const fw_segment *s, bool *reversed) {
    *reversed = vec_before(s->b, s->a) || (vec_same(s->a, s->b) && s->sweep_rad < 0);
    fw_segment c = *reversed ? fw_segment_reverse(s) : *s;
    c.radius = vec_distance(c.a, c.centre);
    c.sweep_rad = vec_same(c.a, c.b)
                      ? FW_TURN
                      : fw_angle_near(fw_vec_angle(vec_sub(c.a, c.centre), vec_sub(c.b, c.centre)),
                                      c.sweep_rad);
    return c;
}

typedef struct builder {
    fw_point *vertex;
    unsigned char *fixed; /* an end of a joint: kept even when it lies on a straight line */
    int count;
    bool outside; /* a coordinate beyond 2^30 */
} builder;

/* floor(x + 1/2) for |x| < 2^30, without a call */
static int32_t rounded(double x) {
    int32_t n = (int32_t)(x + 0.5);
    return n - (n > x + 0.5);
}

static fw_point on_grid(builder *b, fw_vec2 p) {
    double x = p.x * GRID_PER_M, y = p.y * GRID_PER_M;
    if (fabs(x) < 1073741823.0 && fabs(y) < 1073741823.0) return (fw_point){rounded(x), rounded(y)};
    b->outside = true;
    return (fw_point){0, 0};
}

static void add(builder *b, fw_vec2 p, bool fixed) {
    b->fixed[b->count] = fixed;
    b->vertex[b->count++] = on_grid(b, p);
}

/* n points from an arm's end, each the one before turned by h, and anew from the end every 64, so
   that rounding adds up to less than 1e-13 R; into at[0], at[way], at[2 way].. */
static void turn_about(builder *b, fw_vec2 centre, fw_vec2 end, double h, int n, fw_point *at,
                       int way) {
    enum { ANEW = 64 };
    const fw_vec2 step = {cos(h), sin(h)};
    fw_vec2 arm = end;
    for (int k = 1; k <= n; k++, at += way) {
        if (k % ANEW == 0)
            arm = fw_vec_rotate(end, k * h);
        else
            arm = (fw_vec2){step.x * arm.x - step.y * arm.y, step.y * arm.x + step.x * arm.y};
        *at = on_grid(b, vec_add(centre, arm));
    }
}

/* vertices k/n of the arc, k = 1..n-1, from both ends to its middle: always as `canonical` has it,
   so that both neighbours of an arc find the same */
static void add_arc(builder *b, const fw_segment *s, double eps) {
    bool reversed;
    fw_segment c = canonical(s, &reversed);
    int n = chord_count(c.radius, c.sweep_rad, eps), half = n / 2;
    double h = c.sweep_rad / n;
    fw_point *first = b->vertex + b->count, *last = first + n - 2;
    turn_about(b, c.centre, vec_sub(c.a, c.centre), h, half < n ? half : n - 1, first, 1);
    turn_about(b, c.centre, vec_sub(c.b, c.centre), -h, n - 1 - half, last, -1);
    memset(b->fixed + b->count, 0, (size_t)(n - 1));
    b->count += n - 1;
    for (; reversed && first < last; first++, last--) {
        fw_point swap = *first;
        *first = *last;
        *last = swap;
    }
}

static bool same_point(fw_point p, fw_point q) {
    return p.x_dbu == q.x_dbu && p.y_dbu == q.y_dbu;
}

/* takes out vertices that repeat */
static void once_each(builder *b) {
    int kept = 0;
    for (int i = 0; i < b->count; i++) {
        if (kept > 0 && same_point(b->vertex[kept - 1], b->vertex[i])) {
            b->fixed[kept - 1] |= b->fixed[i];
            continue;
        }
        b->fixed[kept] = b->fixed[i];
        b->vertex[kept++] = b->vertex[i];
    }
    while (kept > 1 && same_point(b->vertex[0], b->vertex[kept - 1]))
        b->fixed[0] |= b->fixed[--kept];
    b->count = kept;
}

/* is q on the straight way from p to r, exactly? */
static bool on_the_way(fw_point p, fw_point q, fw_point r) {
    int64_t ax = (int64_t)q.x_dbu - p.x_dbu, ay = (int64_t)q.y_dbu - p.y_dbu;
    int64_t bx = (int64_t)r.x_dbu - q.x_dbu, by = (int64_t)r.y_dbu - q.y_dbu;
    return ax * by - ay * bx == 0 && ax * bx + ay * by > 0;
}

/* takes out vertices that repeat or lie exactly between their neighbours */
static void tidy(builder *b) {
    once_each(b);
    int n = b->count, kept = 0;
    if (n < 4) return;
    fw_point first = b->vertex[0];
    for (int i = 0; i < n; i++) {
        fw_point before = kept > 0 ? b->vertex[kept - 1] : b->vertex[n - 1];
        fw_point after = i + 1 < n ? b->vertex[i + 1] : first;
        if (!b->fixed[i] && on_the_way(before, b->vertex[i], after)) continue;
        if (kept == 0) first = b->vertex[i];
        b->fixed[kept] = b->fixed[i];
        b->vertex[kept++] = b->vertex[i];
    }
    b->count = kept;
}

static int most_vertices(const fw_contour *contour, double eps) {
    double total = 0;
    for (int i = 0; i < contour->count; i++) {
        const fw_segment *s = &contour->segment[i];
        bool reversed;
        fw_segment c = *s;
        if (s->kind == FW_ARC) c = canonical(s, &reversed);
        total += s->kind == FW_ARC ? chord_count(c.radius, c.sweep_rad, eps) : 1;
    }
    return total < 1e9 ? (int)total : -1;
}

fw_status fw_tessellate(fw_arena *arena, const fw_contour *contour, double tolerance_m,
                        fw_polygon *polygon) {
    *polygon = (fw_polygon){0};
    if (!(tolerance_m >= LEAST_SAGITTA_M) || !isfinite(tolerance_m)) return FW_INPUT;
    if (!fw_contour_valid(contour)) return FW_GEOMETRY;
    int most = most_vertices(contour, tolerance_m);
    if (most < 0) return FW_LIMIT;
    builder b = {.vertex = fw_arena_array(arena, fw_point, (size_t)most)};
    FW_NEED(b.vertex);
    fw_mark mark = fw_arena_mark(arena);
    b.fixed = fw_arena_array(arena, unsigned char, (size_t)most);
    FW_NEED(b.fixed);
    for (int i = 0; i < contour->count; i++) {
        const fw_segment *s = &contour->segment[i];
        const fw_segment *before = &contour->segment[i > 0 ? i - 1 : contour->count - 1];
        add(&b, s->a, (s->flags | before->flags) & FW_SEGMENT_JOINT);
        if (s->kind == FW_ARC) add_arc(&b, s, tolerance_m);
    }
    tidy(&b);
    fw_arena_rewind(arena, mark);
    if (b.outside) return FW_LIMIT;
    if (b.count < 3) return FW_GEOMETRY;
    *polygon = (fw_polygon){b.vertex, b.count};
    return FW_OK;
}

int64_t fw_polygon_area2(const fw_polygon *polygon) {
    __int128 sum = 0;
    for (int i = 0; i < polygon->count; i++) {
        fw_point p = polygon->vertex[i];
        fw_point q = polygon->vertex[i + 1 < polygon->count ? i + 1 : 0];
        sum += (int64_t)p.x_dbu * q.y_dbu - (int64_t)p.y_dbu * q.x_dbu;
    }
    return (int64_t)sum;
}
