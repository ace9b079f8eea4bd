/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of finite_force.c, values and first derivatives, for FW_W hinges at once: where it is asked for by every
   right-hand side of a motion. Compiled for one hinge (FW_W 1) and once more for 2, 4 and 8 (cmake/rooms.cmake); every
   lane does the same operations in the same order, none of them contracted, so that a hinge's bits depend neither on the
   processor nor on how many stand beside it.

   In units of L, EI/L^2 and EI/L, in which the unknown F is y = F L^2/EI. What differs from finite_force.c is how its
   functions are worked out. Motions ask where |th| < 1.6 and |y| max(1, |px|, py) <= R = 1/4. There the sums of simple
   fractions are polynomials: Taylor's series with Chebyshev's polynomials of degree 7 and more taken away, 4e-18 off, n's
   the hinge's own (finite.c). Angles have their power series, and one Newton step from no force with what it leaves out
   (finite_force.c, hermite_step) finds y. Where one of these is not enough, the answer is that the hinge has to be asked
   for by itself, in full.

   In: numbers of hinges (fw_flexure_hinge_rest), th in rad, w and v in m. Out: J, N m, N, N/m. Error against
   finite_force.c: 1e-12 of the force. Cost 900 operations for FW_W hinges: 115 ns of one alone, 36 ns
   of each of four (AVX2), 37 ns of each of six (AVX-512). Source: finite_force.c. Test: test_finite_lanes.c. */
#ifndef FW_W
#define FW_W 1
#endif
#include "flexure/finite.h"
#include "maths/lanes.h"

#define UNROLL     _Pragma("GCC unroll 8")
#define JOIN(a, b) a##b
#define NAME(a, b) JOIN(a, b)

FW_INLINE real load(const double *from) {
    real a;
    memcpy(&a, from, sizeof a);
    return a;
}
FW_INLINE real larger(real a, real b) {
    return real_select(MASK(a > b), a, b);
}

typedef struct curve { /* a function with its first two derivatives */
    real v, d, dd;
} curve;

typedef struct line { /* and with the first one */
    real v, d;
} line;

/* ---- what depends on the rotation alone (finite.c) ---- */

typedef struct shape { /* sinc, z = sinc(2x), g and h of x, with derivatives */
    real s, s1, s2, z, z1, g, g1, h, h1;
} shape;

/* p(t) of eight terms and its slope, by Estrin's scheme: what waits for one another is a third of Horner's */
FW_INLINE line polynomial(const double *c, real t) {
    const real t2 = t * t, t4 = t2 * t2;
    return (line){((c[0] + c[1] * t) + t2 * (c[2] + c[3] * t)) +
                      t4 * ((c[4] + c[5] * t) + t2 * (c[6] + c[7] * t)),
                  ((c[1] + 2 * c[2] * t) + t2 * (3 * c[3] + 4 * c[4] * t)) +
                      t4 * ((5 * c[5] + 6 * c[6] * t) + t2 * (7 * c[7]))};
}

FW_INLINE void shape_near(real x, shape *at) {
    const real t = x * x, twice = 2 * x;
    const line s = polynomial(fw_flexure_sinc_of, t), g = polynomial(fw_flexure_g_of, t);
    const line h = polynomial(fw_flexure_h_of, t);
    at->s = s.v, at->s1 = twice * s.d, at->s2 = -s.v - 4 * s.d;
    at->g = g.v, at->g1 = twice * g.d;
    at->h = t * h.v, at->h1 = twice * (h.v + t * h.d);
    at->z = 1 - t * g.v, at->z1 = -twice * g.v - t * at->g1;
}

FW_INLINE void shape_far(real x, real sine, real cosine, shape *at) {
    const real over = 1 / x, square = over * over, twice = 2 * over;
    at->s = sine * over, at->s1 = (cosine - at->s) * over, at->s2 = -at->s - twice * at->s1;
    at->z = at->s * cosine, at->z1 = at->s1 * cosine - at->s * sine;
    at->g = (1 - at->z) * square, at->g1 = -at->z1 * square - twice * at->g;
    at->h = (1 + at->z - 2 * at->s * at->s) * square;
    at->h1 = (at->z1 - 4 * at->s * at->s1) * square - twice * at->h;
}

FW_INLINE void shape_at(real x, real sine, real cosine, shape *at) {
    const bits near = MASK(real_abs(x) < 1);
    const unsigned which = bits_lanes(near);
    if (which == (1u << FW_W) - 1) {
        shape_near(x, at);
        return;
    }
    shape_far(x, sine, cosine, at);
    if (which == 0) return;
    shape n;
    shape_near(x, &n);
    at->s = real_select(near, n.s, at->s), at->s1 = real_select(near, n.s1, at->s1);
    at->s2 = real_select(near, n.s2, at->s2);
    at->z = real_select(near, n.z, at->z), at->z1 = real_select(near, n.z1, at->z1);
    at->g = real_select(near, n.g, at->g), at->g1 = real_select(near, n.g1, at->g1);
    at->h = real_select(near, n.h, at->h), at->h1 = real_select(near, n.h1, at->h1);
}

/* sine and cosine below 0.8, as in finite.c */
FW_INLINE void turn(real angle, real *sine, real *cosine) {
    const real t = angle * angle, t2 = t * t, t4 = t2 * t2;
    const real s = (1 - t * (1 / 6.0)) + t2 * (1 / 120.0 - t * (1 / 5040.0)) +
                   t4 * ((1 / 362880.0 - t * (1 / 39916800.0)) +
                         t2 * (1 / 6227020800.0 - t * (1 / 1307674368000.0)));
    const real c = (1 - t * 0.5) + t2 * (1 / 24.0 - t * (1 / 720.0)) +
                   t4 * ((1 / 40320.0 - t * (1 / 3628800.0)) +
                         t2 * (1 / 479001600.0 - t * (1 / 87178291200.0))) +
                   t4 * t4 * (1 / 20922789888000.0);
    *sine = angle * s, *cosine = c;
}

typedef struct soft { /* compliances and drift by the rotation, over L^3/EI and L */
    line bend_x, bend_y, rest_x, rest_y, drift;
} soft;

/* hinge: field k of the first lane's is at k stride */
#define OF(field) load(hinge + (size_t)(field)*stride)

FW_INLINE void soften(const double *hinge, size_t stride, real th, real x, soft *c) {
    const real q = OF(FW_HINGE_Q), sa = OF(FW_HINGE_SINE), ca = OF(FW_HINGE_COSINE);
    const real along = OF(FW_HINGE_ALONG), across = OF(FW_HINGE_ACROSS), root = OF(FW_HINGE_ROOT);
    const real share = OF(FW_HINGE_ROOT_ACROSS), both = OF(FW_HINGE_BOTH);
    const real apart = OF(FW_HINGE_APART), a = OF(FW_HINGE_SINC), b = OF(FW_HINGE_TURN);
    real sp, cp, s2, c2;
    shape f;
    turn(q * th, &sp, &cp);
    turn(0.5 * th, &s2, &c2);
    shape_at(x, sa * cp + ca * sp, ca * cp - sa * sp, &f);
    const real rs = root * f.s, hs = share * f.s1, qa = q * apart;
    c->bend_x = (line){along * f.g, q * (along * f.g1)};
    c->rest_x = (line){rs * f.s + both + apart * f.z, q * (2 * rs * f.s1) + qa * f.z1};
    c->bend_y = (line){across * f.h + hs * f.s1, q * (across * f.h1 + 2 * hs * f.s2)};
    c->rest_y = (line){both - apart * f.z, -(qa * f.z1)};
    c->drift = (line){f.s - c2 * a - s2 * b, q * f.s1 + 0.5 * (s2 * a - c2 * b)};
}

/* ---- what a pull does ---- */

typedef struct wound { /* px and py over L^2/EI */
    line px, py, g4, h4, a4, n4;
} wound;

FW_INLINE line winding(int row, real x, real slope) {
    line p = polynomial(fw_flexure_winding[row], x * x);
    p.d = slope * p.d;
    return p;
}

FW_INLINE void wind(real q, real x, wound *at) {
    const real slope = q * (2 * x);
    at->px = winding(0, x, slope), at->py = winding(1, x, slope);
    at->g4 = winding(2, x, slope), at->h4 = winding(3, x, slope);
    at->a4 = winding(4, x, slope), at->n4 = winding(5, x, slope);
}

/* a: Taylor's series of its fractions with T7 and the next ones taken away */
static const double a_of[7] = {1,
                               -0.016666666666666774,
                               0.0003968249976586752,
                               -9.920628208228692e-06,
                               2.50521027485768e-07,
                               -6.341472759132152e-09,
                               1.6060331664955763e-10};

/* polynomials of degree 6 that are 1 at 0, by the coefficients of them, their slopes and second derivatives */
FW_INLINE curve series(real y, const real c[6], const real d[5], const real dd[4]) {
    const real y2 = y * y, y4 = y2 * y2;
    return (curve){((1 + c[0] * y) + y2 * (c[1] + c[2] * y)) + y4 * ((c[3] + c[4] * y) + y2 * c[5]),
                   ((c[0] + d[0] * y) + y2 * (d[1] + d[2] * y)) + y4 * (d[3] + d[4] * y),
                   ((d[0] + dd[0] * y) + y2 * (dd[1] + dd[2] * y)) + y4 * dd[3]};
}

FW_INLINE curve a_at(real y) {
    real c[6], d[5], dd[4];
    UNROLL for (int k = 0; k < 6; k++) c[k] = real_of(a_of[k + 1]);
    UNROLL for (int k = 0; k < 5; k++) d[k] = real_of((k + 2) * a_of[k + 2]);
    UNROLL for (int k = 0; k < 4; k++) dd[k] = real_of((k + 2) * (k + 3) * a_of[k + 3]);
    return series(y, c, d, dd);
}

FW_INLINE curve n_at(const double *hinge, size_t stride, real y) {
    real c[6], d[5], dd[4];
    UNROLL for (int k = 0; k < 6; k++) c[k] = OF(FW_HINGE_N + k);
    UNROLL for (int k = 0; k < 5; k++) d[k] = OF(FW_HINGE_N_SLOPE + k);
    UNROLL for (int k = 0; k < 4; k++) dd[k] = OF(FW_HINGE_N_CURVE + k);
    return series(y, c, d, dd);
}

/* q(y; b, e), e2 = e^2 */
FW_INLINE curve fourth(real y, double b, double e2) {
    const real ye = y * e2, over = 1 / (1 + y * (b + ye)), root = y * over, flat = 1 - y * ye;
    const real once = flat * over, d = once * over;
    const real dd = -2 * ((ye + once * (b + 2 * ye)) * (over * over));
    const real twice = 2 * root;
    return (curve){root * root, twice * d, 2 * (d * d) + twice * dd};
}

/* ---- the stationary value ---- */

/* of h and g at the stretched length l, over L: values and derivatives by l */
typedef struct shortened {
    real over, z, z2, z4, h, h_l, g, g_l;
} shortened;

FW_INLINE shortened shorten(const wound *x, real w, real l, bool stretched) {
    shortened s;
    s.over = stretched ? 1 / l : real_of(1), s.z = w * s.over, s.z2 = s.z * s.z, s.z4 = s.z2 * s.z2;
    const real h4 = x->h4.v * s.z4, g4 = x->g4.v * s.z4;
    s.h = 0.5 * l * (s.z2 + h4), s.h_l = -0.5 * s.z2 - 1.5 * h4;
    s.g = s.z2 + g4, s.g_l = -(2 * s.z2 + 4 * g4) * s.over;
    return s;
}

typedef struct slope { /* dPhi/dy and its derivative */
    real p, q;
} slope;

/* A and N at one y; loaded: y is not 0 */
FW_INLINE slope slope_at(const soft *c, const wound *x, real w, real free, real y, bool loaded,
                         const curve *A, const curve *N) {
    const real ry = c->rest_y.v, by = c->bend_y.v;
    const shortened s = shorten(x, w, loaded ? 1 + ry * y : real_of(1), loaded);
    const real k = 1 / (c->bend_x.v * A->v + c->rest_x.v), k2 = k * k;
    const real c1 = c->bend_x.v * A->d, c2 = c->bend_x.v * A->dd;
    const real kd = -(c1 * k2), kdd = (2 * c1 * c1 * k - c2) * k2;
    const real g_ll = (6 * s.z2 + 20 * x->g4.v * s.z4) * (s.over * s.over);
    const real half = 0.5 * s.g, half_l = 0.5 * s.g_l;
    const real p = free + s.h + kd * half + ry * (k * half_l);
    const real q = kdd * half - ry + ry * (2 * (s.h_l + kd * half_l) + ry * (0.5 * k * g_ll));
    if (!loaded) return (slope){p, q - by * N->v};
    const real yN = 0.5 * y * N->d, h_ll = (s.z2 + 6 * x->h4.v * s.z4) * s.over;
    return (slope){p + y * (ry * s.h_l - ry - by * (N->v + yN)),
                   q - by * (N->v + y * (2 * N->d + 0.5 * y * N->dd)) + ry * ry * (y * h_ll)};
}

/* f(p y) + four q */
FW_INLINE curve with_fourth(const curve *f, real p, const curve *q, real four) {
    return (curve){f->v + four * q->v, p * f->d + four * q->d, p * p * f->dd + four * q->dd};
}

/* first guess: all functions are known at no force */
FW_INLINE slope unloaded(const double *hinge, size_t stride, const soft *c, const wound *x, real w,
                         real free) {
    const curve a = {real_of(1), real_of(a_of[1]), real_of(2 * a_of[2])},
                q = {real_of(0), real_of(0), real_of(2)};
    const curve n = {real_of(1), OF(FW_HINGE_N), OF(FW_HINGE_N_SLOPE)};
    const curve A = with_fourth(&a, x->px.v, &q, x->a4.v),
                N = with_fourth(&n, x->py.v, &q, x->n4.v);
    return slope_at(c, x, w, free, real_of(0), false, &A, &N);
}

typedef struct state { /* at one y: a(px y), n(py y), what is of fourth order */
    curve a, n, qa, qn;
} state;

/* the same at y + more: values to the third order, slopes to the second */
FW_INLINE void advance(curve *f, real more) {
    f->v += more * (f->d + 0.5 * more * f->dd), f->d += more * f->dd;
}

/* of |y|: a step, and what it leaves out; of the arguments of a and n, what `advance` is good for: 1e-13 of the force */
static const double far = 2e-3, most = 5e-9, little = 2e-4;

/* y where Phi is stationary, with the state there. A lane of `good` stays where Newton's step from the first guess and what it
   leaves out (finite_force.c hermite_step) are small enough */
FW_INLINE real solve(const double *hinge, size_t stride, const soft *c, const wound *x, real w,
                     real free, state *s, bits *good) {
    const slope at0 = unloaded(hinge, stride, c, x, w, free);
    const real range = OF(FW_HINGE_RANGE), one0 = 1 / at0.q, y = -(at0.p * one0);
    const real pressed = larger(larger(real_abs(x->px.v), x->py.v), real_of(1));
    const bits within = MASK(at0.q < 0) & MASK(real_abs(y) * pressed <= range) & *good;
    if (!bits_lanes(*good = within)) return y;
    s->a = a_at(x->px.v * y), s->n = n_at(hinge, stride, x->py.v * y);
    s->qa = fourth(y, 2 / 47.0, 1 / (47.0 * 47)), s->qn = fourth(y, 1 / 60.0, 1 / (55.0 * 55));
    const curve A = with_fourth(&s->a, x->px.v, &s->qa, x->a4.v);
    const curve N = with_fourth(&s->n, x->py.v, &s->qn, x->n4.v);
    const slope at = slope_at(c, x, w, free, y, true, &A, &N);
    const real between = at0.p - at.p, apart = real_select(MASK(between == 0), real_of(1), between);
    const real over = 1 / apart, D = -(y * over), one = 1 / at.q, step = -(at.p * one);
    const real more = at.p * at.p * over * (D - one - at0.p * over * (one0 - 2 * D + one));
    const real size = real_abs(y), moved = real_abs(step);
    *good = within & MASK(at.q < 0) & MASK(moved <= far * size) &
            MASK(real_abs(more) <= most * size) & MASK(pressed * moved <= little);
    const real rest = step + more;
    advance(&s->a, x->px.v * rest), advance(&s->n, x->py.v * rest);
    s->qa.v += rest * (s->qa.d + 0.5 * rest * s->qa.dd);
    s->qn.v += rest * (s->qn.d + 0.5 * rest * s->qn.dd);
    return y + rest;
}

/* ---- what is asked for ---- */

typedef struct answer {
    real energy, pull, gradient[3], kx, ky, drift_slope;
} answer;

FW_INLINE void answer_at(const double *hinge, size_t stride, real th, const soft *c, const wound *x,
                         real w, real free, real y, const state *s, answer *out) {
    const real ry = c->rest_y.v, A = s->a.v + x->a4.v * s->qa.v, N = s->n.v + x->n4.v * s->qn.v;
    const real k = 1 / (c->bend_x.v * A + c->rest_x.v), half = 0.5 * k;
    const shortened z = shorten(x, w, 1 + ry * y, true);
    const real A1 = s->a.d * (x->px.d * y) + x->a4.d * s->qa.v;
    const real N1 = s->n.d * (x->py.d * y) + x->n4.d * s->qn.v;
    const real soft1 = c->bend_x.d * A + c->bend_x.v * A1 + c->rest_x.d,
               half1 = -(half * k) * soft1;
    const real yh = y * (x->h4.d * (0.5 * z.z4) * (1 + ry * y)), kg = half * (x->g4.d * z.z4);
    const real turned = yh + half1 * z.g + kg + (y * z.h_l + half * z.g_l) * (c->rest_y.d * y);
    const real squared = 0.5 * y * y, stretched = ry + c->bend_y.v * N;
    const real stretched1 = c->rest_y.d + c->bend_y.d * N + c->bend_y.v * N1;
    const real z3 = z.z2 * z.z, h_w = z.z + 2 * x->h4.v * z3;
    const real g_w = (2 * z.z + 4 * x->g4.v * z3) * z.over;
    const real L = OF(FW_HINGE_LENGTH), F = OF(FW_HINGE_FORCE), M = F * L;
    const real K = OF(FW_HINGE_STIFFNESS), turns = K * th, kL = OF(FW_HINGE_PER_LENGTH) * F;
    out->energy = 0.5 * turns * th + M * (y * (free + z.h) - squared * stretched + half * z.g);
    out->gradient[0] = turns + M * (turned - y * c->drift.d - squared * stretched1);
    out->gradient[1] = F * (y * h_w + half * g_w);
    out->gradient[2] = out->pull = F * y;
    out->kx = kL / (c->bend_x.v + c->rest_x.v), out->ky = kL / (c->bend_y.v + c->rest_y.v);
    out->drift_slope = L * c->drift.d;
}

/* what they know of a rotation only; a lane where it is not small enough is not good */
FW_INLINE bits rotated(const double *hinge, size_t stride, real th, soft *c, wound *x) {
    const real q = OF(FW_HINGE_Q), at = OF(FW_HINGE_HALF_ANGLE) + q * th;
    soften(hinge, stride, th, at, c);
    wind(q, at, x);
    return MASK(real_abs(th) < 1.6) & MASK(real_abs(at) < 3.14);
}

/* of `count` hinges, at most FW_W; at: th, w and v of all */
unsigned NAME(fw_flexure_lanes_bend_, FW_W)(const double *hinge, size_t stride, const double *at,
                                            int count, fw_flexure_hinge_bent *const *out) {
    const real th = load(at), per = OF(FW_HINGE_PER_LENGTH), w = load(at + stride) * per;
    const real v = load(at + 2 * stride), L = OF(FW_HINGE_LENGTH);
    soft c;
    wound x;
    state s;
    answer a;
    bits good = rotated(hinge, stride, th, &c, &x);
    const real free = (v - L * c.drift.v) * per;
    const real y = solve(hinge, stride, &c, &x, w, free, &s, &good);
    const unsigned known = bits_lanes(good), holds = bits_lanes(MASK(real_abs(w) < 0.4));
    if (!known) return 0;
    answer_at(hinge, stride, th, &c, &x, w, free, y, &s, &a);
    for (int i = 0; i < count; i++) {
        if (!(known >> i & 1)) continue;
        fw_flexure_hinge_bent *b = out[i];
        b->energy_J = LANE(a.energy, i), b->pull_N = LANE(a.pull, i);
        b->gradient[0] = LANE(a.gradient[0], i), b->gradient[1] = LANE(a.gradient[1], i);
        b->gradient[2] = LANE(a.gradient[2], i);
        b->kx_N_per_m = LANE(a.kx, i), b->ky_N_per_m = LANE(a.ky, i);
        b->drift_slope = LANE(a.drift_slope, i);
        b->holds = holds >> i & 1;
    }
    return known;
}

/* ---- any number of hinges ---- */

#if FW_W == 1

typedef unsigned bend_lanes(const double *hinge, size_t stride, const double *at, int count,
                            fw_flexure_hinge_bent *const *out);

fw_status fw_flexure_hinge_lanes_new(fw_arena *arena, int count,
                                     const fw_flexure_hinge_rest *const *rest,
                                     fw_flexure_hinge_lanes *lanes) {
    const size_t stride = ((size_t)count + 7) / 8 * 8;
    double *number;
    *lanes = (fw_flexure_hinge_lanes){.count = count, .stride = stride, .widest = 2};
    FW_NEED(number = fw_arena_array(arena, double, FW_HINGE_NUMBERS *stride));
    FW_NEED(lanes->at = fw_arena_array(arena, double, 3 * stride));
    FW_NEED(lanes->out = fw_arena_array(arena, fw_flexure_hinge_bent *, stride));
    for (size_t i = 0; i < stride; i++) /* those that fill the last lanes are at rest */
        for (size_t k = 0; k < FW_HINGE_NUMBERS; k++)
            number[k * stride + i] = rest[i < (size_t)count ? i : (size_t)count - 1]->number[k];
    lanes->number = number;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) lanes->widest = 4;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) lanes->widest = 8;
#endif
    return FW_OK;
}

/* the narrowest that take what is left, or the widest */
static int width_of(int left, int widest, bend_lanes **bend) {
#if defined(__x86_64__)
    if (left > 4 && widest >= 8) return *bend = fw_flexure_lanes_bend_8, 8;
    if (left > 2 && widest >= 4) return *bend = fw_flexure_lanes_bend_4, 4;
#endif
    if (left > 1 && widest >= 2) return *bend = fw_flexure_lanes_bend_2, 2;
    return *bend = fw_flexure_lanes_bend_1, 1;
}

void fw_flexure_hinge_lanes_bend(const fw_flexure_hinge_lanes *lanes, bool *known) {
    for (int from = 0, width; from < lanes->count; from += width) {
        bend_lanes *bend;
        width = width_of(lanes->count - from, lanes->widest, &bend);
        const int left = lanes->count - from, count = left < width ? left : width;
        const unsigned good =
            bend(lanes->number + from, lanes->stride, lanes->at + from, count, lanes->out + from);
        for (int i = 0; i < count; i++)
            known[from + i] = good >> i & 1;
    }
}
#endif
