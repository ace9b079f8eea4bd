/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "geometry/geometry_flatten.h"
#include <string.h>

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
static void plan_equal_area(fw_geometry_chords *c, double eps) {
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

fw_geometry_chords fw_geometry_flatten_plan(const fw_geometry_segment *arc, double tolerance_m,
                                            fw_geometry_flattening kind) {
    fw_geometry_chords c = {.reach = 1};
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
void fw_geometry_flatten_points(const fw_geometry_chords *c, fw_geometry_point *at) {
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
