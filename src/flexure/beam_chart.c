/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact beam's law on a lattice of its solutions, for motions that ask for it a million times.

   With th the rotation, (w, v) the displacement of W along and across the axis in the frame half
   turned and F the force across (finite_force.c), the energy U(th, w, v) of the beam is kept as

     P(th, w, F) = U - F v,   dP/dth = M, dP/dw = G, dP/dF = -v   (M, G: dU/dth, dU/dw)

   which is smooth where U is stiff: a strip along its chord. At the points of a fixed lattice the
   beam is solved with th, w and F given; its tangent gives the second derivatives, and those beside
   the point the third and fourth mixed ones. In every cell P is the tensor product of Hermite's
   polynomials of degree 5 that have these at its eight corners: its forces and its stiffness are
   continuous, and it is a potential, so that it conserves what the beam conserves. F follows from v
   by Newton's method on -dP/dF = v.
   In: rad, m; out: as fw_flexure_hinge_law_bend. The lattice is the beam's alone, so that the force
   is a function of the pose, to the last bit, until so many corners are made that new ones are refused. Valid: where the beam has solutions at all corners of
   the cell; a cell whose forces off its middle are farther than 1e-6 from the beam's own is not used.
   Error: 1e-7 of the forces as a rule, 5e-6 at most. Cost 0.1 us where the cell is there, 0.1 ms a new
   corner (seven solutions). Source:
   Hermite interpolation, Davis, Interpolation and Approximation, 1975; Legendre's transform. Test:
   test_beam_chart.c. */
#include "flexure/beam.h"
#include "flexure/finite.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

enum { AXES = 3, ORDERS = 3, BASIS = 2 * ORDERS, NODE = 27, CELL = BASIS * BASIS * BASIS };
/* kept cells and corners, by a rank-1 lattice of their places: long tubes and small boxes are free of
   collisions */
enum { CELLS = 256, NODES = 1024 };
/* corners that may be made before, and for each of so many, questions are counted: where a motion
   goes to other places all the time the beam itself is cheaper */
enum { FREE_NODES = 400, QUESTIONS = 20 };
/* Steps of the lattice: rad, lengths, and of t in F = widen EI/L^2 sinh t: even where a strip is
   pressed or hardly pulled, in proportion to F where it is pulled hard */
static const double step_of[AXES] = {0.08, 0.025, 0.05}, widen = 20;
/* what a point beside a corner is away, in steps: differences of tangents */
static const double beside = 0.04;
/* of a corner's solution, and what a cell may be off, of the forces: the first one less */
static const double solved_to = 1e-11, allowed = 1e-6, first_allowed = 2e-7;
enum { HALVINGS = 3 };
/* where a cell is compared with the beam: error of the slope is largest */
static const double amid = 0.2763932;

typedef struct node {
    int at[AXES];
    bool made, sound;
    double d[NODE]; /* [i][j][k]: i, j, k times by th, w and F, times the steps */
} node;

typedef struct cell {
    int at[AXES];
    bool made, sound;
    double force_N[2]; /* force_N sinh t and cosh t at its corner of less t */
    double d[CELL];    /* [th][w][F], of each: corner and order */
} cell;

struct fw_flexure_chart {
    const fw_flexure_hinge_law *law;
    fw_flexure_hinge_rest rest;
    fw_flexure_elastica *solver;
    double step[AXES]; /* rad, m, of t */
    double force_N;    /* F = force_N sinh t */
    int level;         /* mesh on which solutions begin */
    long asked, made;  /* questions, corners */
    int last;          /* cell along F where the last answer was */
    cell cell[CELLS];
    node node[NODES];
};

/* ---- the beam at a point ---- */

typedef struct point { /* of P: value, gradient, second derivatives */
    double value, g[AXES], h[AXES][AXES];
} point;

/* second derivatives of U by (th, w, v) from the tangent by the twist: the inverse of
   fw_flexure_hinge_law_wrench; then those of P */
static void legendre(double th, double w, double v, const double g[3], const double k[3][3],
                     point *out) {
    double c = cos(0.5 * th), s = sin(0.5 * th), t[3][3], h[3][3];
    const double back[3][3] = {
        {1, 0, 0}, {0.5 * (-s * w - c * v), c, -s}, {0.5 * (c * w - s * v), s, c}};
    const double wx = -0.5 * s, wy = 0.5 * c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            t[i][j] = 0.5 * (k[i][j] + k[j][i]);
    t[0][0] += 0.25 * (g[1] * w + g[2] * v);
    t[0][1] -= g[1] * wx - g[2] * wy, t[0][2] -= g[1] * wy + g[2] * wx;
    t[1][0] = t[0][1], t[2][0] = t[0][2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            h[i][j] = 0;
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    h[i][j] += back[a][i] * t[a][b] * back[b][j];
        }
    double soft = 1 / h[2][2];
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++)
            out->h[i][j] = h[i][j] - h[i][2] * h[j][2] * soft;
        out->h[i][2] = out->h[2][i] = h[i][2] * soft;
    }
    out->h[2][2] = -soft;
}

/* derivatives by F become those by t */
static void by_stretched(const fw_flexure_chart *x, double t, point *p) {
    double one = x->force_N * cosh(t), two = x->force_N * sinh(t);
    p->h[2][2] = p->h[2][2] * one * one + p->g[2] * two;
    for (int i = 0; i < 2; i++)
        p->h[i][2] = p->h[2][i] = p->h[i][2] * one;
    p->g[2] *= one;
}

/* at rest errors are relative to nothing */
static bool at_rest(fw_flexure_chart *x, point *out) {
    static const double none[3] = {0};
    fw_flexure_elastica_result r;
    fw_flexure_elastica_of_twist(x->solver, none, solved_to, false, &r);
    *out = (point){0};
    legendre(0, 0, 0, none, r.stiffness, out);
    by_stretched(x, 0, out);
    return isfinite(out->h[0][0]) && isfinite(out->h[1][2]);
}

static bool solve_at(fw_flexure_chart *x, const double at[AXES], point *out) {
    double th = at[0], w = at[1], F = x->force_N * sinh(at[2]), u[2], moment, pull;
    double c = cos(0.5 * th), s = sin(0.5 * th);
    fw_flexure_hinge_bent near;
    fw_flexure_elastica_result r;
    if (th == 0 && w == 0 && F == 0) return at_rest(x, out);
    if (!fw_flexure_hinge_law_held(x->law, &x->rest, th, F, w, u, &moment, &pull)) return false;
    fw_flexure_hinge_law_bend(x->law, &x->rest, (const double[3]){th, w, u[1]}, false, &near);
    double G = near.gradient[1], v = u[1];
    const double twist[3] = {th, c * w - s * v, s * w + c * v};
    const double wrench[3] = {moment + 0.5 * (v * G - w * F), c * G - s * F, s * G + c * F};
    fw_flexure_elastica_held(x->solver, twist, wrench, (const double[2]){c, s}, solved_to, &r);
    if (r.code != FW_ELASTICA_OK && !(r.code == FW_ELASTICA_ROUGH && r.error < 1e-6)) return false;
    v = c * r.twist[2] - s * r.twist[1];
    G = c * r.wrench[1] + s * r.wrench[2];
    const double g[3] = {r.wrench[0] - 0.5 * (v * G - w * F), G, F};
    out->value = fw_flexure_elastica_energy_J(x->solver) - F * v;
    out->g[0] = g[0], out->g[1] = G, out->g[2] = -v;
    legendre(th, w, v, g, r.stiffness, out);
    by_stretched(x, at[2], out);
    return isfinite(out->value) && isfinite(out->h[0][0]) && isfinite(out->h[1][2]);
}

/* Fourth derivatives are differences of tangents over the square of a twenty-fifth of a step, so that what
   tangents differ by is a thousand times more in them: all have meshes as fine as a bent beam needs */
static bool solve_alike(fw_flexure_chart *x, const double at[AXES], point *out) {
    fw_flexure_elastica_no_coarser(x->solver, x->level);
    bool sound = solve_at(x, at, out);
    fw_flexure_elastica_no_coarser(x->solver, 0);
    return sound;
}

/* ---- a corner of the lattice ---- */

static inline int index_of(int i, int j, int k) {
    return (i * ORDERS + j) * ORDERS + k;
}

/* orders by (th, w, F) as the axes a, b, c say */
static double *entry(double *d, const int *axis, int n) {
    int order[AXES] = {0};
    for (int i = 0; i < n; i++)
        order[axis[i]]++;
    return &d[index_of(order[0], order[1], order[2])];
}

/* third and fourth mixed derivatives from the second ones on either side along an axis a */
static void beside_node(const point *p, const point *more, const point *less, int a, double e,
                        double *d) {
    for (int b = 0; b < AXES; b++)
        for (int c = b; c < AXES; c++) {
            if (a == b && b == c) continue;
            double one = (more->h[b][c] - less->h[b][c]) / (2 * e);
            double two = (more->h[b][c] - 2 * p->h[b][c] + less->h[b][c]) / (e * e);
            /* each third derivative but the mixed one is met once only with b = c or a = b, ... */
            int seen = b == c || a == b || a == c ? 2 : 3;
            *entry(d, (const int[]){a, b, c}, 3) += one / seen;
            if (a == b || a == c) continue;
            *entry(d, (const int[]){a, a, b, c}, 4) += b == c ? 0.5 * two : two;
        }
}

static void make_node(fw_flexure_chart *x, node *n) {
    point p, side[2];
    double at[AXES];
    memset(n->d, 0, sizeof n->d);
    for (int a = 0; a < AXES; a++)
        at[a] = n->at[a] * x->step[a];
    n->made = true;
    x->made++;
    n->sound = solve_alike(x, at, &p);
    if (!n->sound) return;
    n->d[0] = p.value;
    for (int a = 0; a < AXES; a++) {
        *entry(n->d, &a, 1) = p.g[a];
        for (int b = a; b < AXES; b++)
            *entry(n->d, (const int[]){a, b}, 2) = p.h[a][b];
    }
    for (int a = 0; a < AXES && n->sound; a++) {
        double there = at[a], e = beside * x->step[a];
        for (int i = 0; i < 2 && n->sound; i++) {
            at[a] = there + (i ? e : -e);
            n->sound = solve_alike(x, at, &side[i]);
        }
        at[a] = there;
        if (n->sound) beside_node(&p, &side[1], &side[0], a, e, n->d);
    }
    for (int i = 0; i < ORDERS; i++)
        for (int j = 0; j < ORDERS; j++)
            for (int k = 0; k < ORDERS; k++)
                n->d[index_of(i, j, k)] *=
                    pow(x->step[0], i) * pow(x->step[1], j) * pow(x->step[2], k);
}

static inline int slot_in(int size, const int at[AXES]) {
    return (at[0] + 11 * at[2] + 101 * at[1]) & (size - 1);
}

static const node *node_at(fw_flexure_chart *x, const int at[AXES]) {
    node *n = &x->node[slot_in(NODES, at)];
    if (n->made && memcmp(n->at, at, sizeof n->at) == 0) return n;
    memcpy(n->at, at, sizeof n->at);
    make_node(x, n);
    return n;
}

/* ---- a cell ---- */

/* Hermite's polynomials of degree 5 at t in [0, 1] with value, slope and curve 1 at 0 or at 1; and
   their derivatives */
static inline void hermite(double t, double b[BASIS], double d[BASIS]) {
    double s = 1 - t, t2 = t * t, s2 = s * s, t3 = t2 * t, s3 = s2 * s;
    b[0] = s3 * (1 + 3 * t + 6 * t2), b[1] = t * s3 * (1 + 3 * t), b[2] = 0.5 * t2 * s3;
    b[3] = t3 * (1 + 3 * s + 6 * s2), b[4] = -s * t3 * (1 + 3 * s), b[5] = 0.5 * s2 * t3;
    d[0] = -30 * t2 * s2, d[1] = s2 * (1 + 2 * t - 15 * t2), d[2] = 0.5 * t * s2 * (2 - 5 * t);
    d[3] = 30 * t2 * s2, d[4] = t2 * (1 + 2 * s - 15 * s2), d[5] = -0.5 * s * t2 * (2 - 5 * s);
}

static inline void hermite_curves(double t, double dd[BASIS]) {
    double s = 1 - t;
    dd[0] = -60 * t * s * (s - t), dd[1] = -12 * t * s * (3 - 5 * t);
    dd[2] = s * (1 - 8 * t + 10 * t * t);
    dd[3] = -dd[0], dd[4] = 12 * t * s * (3 - 5 * s), dd[5] = t * (1 - 8 * s + 10 * s * s);
}

/* P over F alone: at th and w of a cell, by order of F's corners */
typedef double row[BASIS];
typedef struct rows {
    row p, by_th, by_w, th_th, th_w, w_w; /* the last three only where they were asked for */
} rows;

/* n of c's polynomials, a whole number of fours, each sum to the last bit the same whatever the width of
   the processor's vectors */
#define INLINE static inline __attribute__((always_inline))
typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
typedef double two __attribute__((vector_size(16), aligned(8), may_alias));
enum { PLANE = BASIS * BASIS };

#define FROM(at) (*(const four *)(const void *)(at))
#define PAIR(at) (*(const two *)(const void *)(at))

/* sums over th, of P and of its slope */
INLINE void over_th(const double *d, const double b[BASIS], const double s[BASIS], double *p,
                    double *q) {
    for (int n = 0; n < PLANE; n += 4, d += 4) {
        const four c0 = FROM(d), c1 = FROM(d + PLANE), c2 = FROM(d + 2 * PLANE);
        const four c3 = FROM(d + 3 * PLANE), c4 = FROM(d + 4 * PLANE), c5 = FROM(d + 5 * PLANE);
        *(four *)(void *)(p + n) =
            b[0] * c0 + b[1] * c1 + b[2] * c2 + b[3] * c3 + b[4] * c4 + b[5] * c5;
        *(four *)(void *)(q + n) =
            s[0] * c0 + s[1] * c1 + s[2] * c2 + s[3] * c3 + s[4] * c4 + s[5] * c5;
    }
}

/* sums over w of a plane that is left */
INLINE void over_w(const double *c, const double e[BASIS], double *out) {
    for (int n = 0; n < BASIS; n += 2, c += 2)
        *(two *)(void *)(out + n) = e[0] * PAIR(c) + e[1] * PAIR(c + BASIS) +
                                    e[2] * PAIR(c + 2 * BASIS) + e[3] * PAIR(c + 3 * BASIS) +
                                    e[4] * PAIR(c + 4 * BASIS) + e[5] * PAIR(c + 5 * BASIS);
}

INLINE void contract_once(const cell *c, double t, double u, rows *out) {
    double b[BASIS], d[BASIS], e[BASIS], f[BASIS], p[PLANE], q[PLANE];
    hermite(t, b, d);
    hermite(u, e, f);
    over_th(c->d, b, d, p, q);
    over_w(p, e, out->p), over_w(p, f, out->by_w), over_w(q, e, out->by_th);
}

static void contract_plain(const cell *c, double t, double u, rows *out) {
    contract_once(c, t, u, out);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void contract_avx2(const cell *c, double t, double u,
                                                          rows *out) {
    contract_once(c, t, u, out);
}
#endif

static void contract(const cell *c, double t, double u, rows *out) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        contract_avx2(c, t, u, out);
    else
#endif
        contract_plain(c, t, u, out);
}

static void contract_twice(const cell *c, double t, double u, rows *out) {
    double b[BASIS], d[BASIS], dd[BASIS], e[BASIS], f[BASIS], ff[BASIS];
    double p[PLANE], q[PLANE], r[PLANE];
    hermite(t, b, d), hermite_curves(t, dd);
    hermite(u, e, f), hermite_curves(u, ff);
    over_th(c->d, b, d, p, q);
    over_th(c->d, d, dd, q, r);
    over_w(r, e, out->th_th), over_w(q, f, out->th_w), over_w(p, ff, out->w_w);
}

static inline double dot(const row a, const double *b) {
    double sum = 0;
    for (int k = 0; k < BASIS; k++)
        sum += a[k] * b[k];
    return sum;
}

/* P and its gradient amid a cell against the beam: of the forces there and those of a thousandth */
static bool agrees(fw_flexure_chart *x, const cell *c, double most) {
    static const double deflected = 1e-3;
    double at[AXES], b[BASIS], d[BASIS], g[AXES];
    rows r;
    point p;
    for (int a = 0; a < AXES; a++)
        at[a] = (c->at[a] + amid) * x->step[a];
    if (!solve_alike(x, at, &p)) return false;
    contract(c, amid, amid, &r);
    hermite(amid, b, d);
    g[0] = dot(r.by_th, b) / x->step[0], g[1] = dot(r.by_w, b) / x->step[1];
    g[2] = dot(r.p, d) / x->step[2];
    double L = x->law->length_m, small[AXES] = {deflected, deflected * L, 0};
    for (int i = 0; i < AXES; i++) {
        double size = fabs(p.g[i]);
        for (int j = 0; j < AXES; j++)
            size += fabs(p.h[i][j]) * small[j];
        if (!(fabs(g[i] - p.g[i]) <= most * size)) return false;
    }
    return true;
}

static void make_cell(fw_flexure_chart *x, cell *c, double most) {
    double t = c->at[2] * x->step[2];
    c->made = true;
    c->sound = true;
    c->force_N[0] = x->force_N * sinh(t), c->force_N[1] = x->force_N * cosh(t);
    for (int n = 0; n < 8 && c->sound; n++) {
        const int side[AXES] = {n >> 2, n >> 1 & 1, n & 1};
        const node *from =
            node_at(x, (const int[]){c->at[0] + side[0], c->at[1] + side[1], c->at[2] + side[2]});
        c->sound = from->sound;
        for (int i = 0; i < ORDERS; i++)
            for (int j = 0; j < ORDERS; j++)
                memcpy(&c->d[((ORDERS * side[0] + i) * BASIS + ORDERS * side[1] + j) * BASIS +
                             ORDERS * side[2]],
                       &from->d[index_of(i, j, 0)], ORDERS * sizeof(double));
    }
    if (c->sound) c->sound = agrees(x, c, most);
}

static cell *slot_of(fw_flexure_chart *x, const int at[AXES]) {
    return &x->cell[slot_in(CELLS, at)];
}

static bool is_at(const cell *c, const int at[AXES]) {
    return c->made && memcmp(c->at, at, sizeof c->at) == 0;
}

static const cell *cell_at(fw_flexure_chart *x, const int at[AXES]) {
    cell *c = slot_of(x, at);
    if (is_at(c, at)) return c;
    if (x->made > FREE_NODES + x->asked / QUESTIONS) return NULL;
    memcpy(c->at, at, sizeof c->at);
    make_cell(x, c, allowed);
    return c;
}

/* ---- the law ---- */

/* F and its derivative by t, at t from the cell's corner and up to a tenth of it: series to rounding */
static inline void force_at(const cell *c, double t, double *F, double *slope) {
    double z = t * t;
    double s = t * (1 + z * (1 / 6.0 + z * (1 / 120.0 + z * (1 / 5040.0 + z * (1 / 362880.0)))));
    double k = 1 + z * (0.5 + z * (1 / 24.0 + z * (1 / 720.0 + z * (1 / 40320.0))));
    *F = c->force_N[0] * k + c->force_N[1] * s;
    *slope = c->force_N[1] * k + c->force_N[0] * s;
}

/* slope of a row's polynomial, by powers */
static inline void slope_of(const row p, double c[BASIS - 1]) {
    double rise = p[3] - p[0] - p[1] - 0.5 * p[2], turn = p[4] - p[1] - p[2], bend = p[5] - p[2];
    c[0] = p[1], c[1] = p[2];
    c[2] = 3 * (10 * rise - 4 * turn + 0.5 * bend);
    c[3] = 4 * (-15 * rise + 7 * turn - bend);
    c[4] = 5 * (6 * rise - 3 * turn + 0.5 * bend);
}

/* -dP/dF = v in steps of the cell, from its middle: the same bits whichever cell was looked at first.
   Near the end a step leaves its square. */
static double force_in(const fw_flexure_chart *x, const cell *at, const rows *r, double v) {
    const double step = x->step[2], near = 1e-8;
    double c[BASIS - 1], t = 0.5;
    slope_of(r->p, c);
    for (int i = 0; i < 30; i++) {
        double F, one;
        force_at(at, t * step, &F, &one);
        double off = v * one * step + c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
        double slope = v * F * step * step + c[1] + t * (2 * c[2] + t * (3 * c[3] + t * 4 * c[4]));
        double to = slope < 0 ? t - off / slope : (double)NAN;
        if (!(to > -1 && to < 2)) return to; /* another cell, or none */
        if (fabs(to - t) < near) return to;
        t = to;
    }
    return t;
}

static int first_cell(fw_flexure_chart *x, int at[AXES], const double state[3]) {
    at[2] = x->last;
    if (is_at(slot_of(x, at), at)) return at[2];
    fw_flexure_hinge_bent near;
    fw_flexure_hinge_law_bend(x->law, &x->rest, state, false, &near);
    double k = floor(asinh(near.pull_N / x->force_N) / x->step[2]);
    return fabs(k) < 1e6 ? (int)k : 0;
}

/* second derivatives, of a cell at its places */
static void curves(const fw_flexure_chart *x, const cell *c, const double place[2], double t,
                   double v, const rows *r, fw_flexure_hinge_bent *out) {
    double b[BASIS], d[BASIS], dd[BASIS], F, one;
    rows s;
    hermite(t, b, d), hermite_curves(t, dd);
    contract_twice(c, place[0], place[1], &s);
    force_at(c, t * x->step[2], &F, &one);
    double s0 = x->step[0], s1 = x->step[1], s2 = x->step[2] * one;
    double stiff = -s2 * s2 / (dot(r->p, dd) + v * F * x->step[2] * x->step[2]);
    const double with_F[2] = {dot(r->by_th, d) / (s0 * s2), dot(r->by_w, d) / (s1 * s2)};
    const double own[2][2] = {{dot(s.th_th, b) / (s0 * s0), dot(s.th_w, b) / (s0 * s1)},
                              {dot(s.th_w, b) / (s0 * s1), dot(s.w_w, b) / (s1 * s1)}};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++)
            out->hessian[i][j] = own[i][j] + with_F[i] * with_F[j] * stiff;
        out->hessian[i][2] = out->hessian[2][i] = with_F[i] * stiff;
    }
    out->hessian[2][2] = stiff;
}

bool fw_flexure_chart_bend(fw_flexure_chart *x, const double state[3], bool hessian,
                           fw_flexure_hinge_bent *out) {
    enum { TRIES = 12 };
    double place[2], t = (double)NAN, b[BASIS], d[BASIS], F, one;
    int at[AXES];
    const cell *c = NULL;
    rows r;
    x->asked++;
    for (int a = 0; a < 2; a++) {
        double scaled = state[a] / x->step[a];
        if (!(fabs(scaled) < 1e6)) return false;
        at[a] = (int)floor(scaled);
        place[a] = scaled - at[a];
    }
    at[2] = first_cell(x, at, state);
    for (int i = 0; i < TRIES; i++) {
        c = cell_at(x, at);
        if (!c || !c->sound) return false;
        contract(c, place[0], place[1], &r);
        t = force_in(x, c, &r, state[2]);
        if (t >= 0 && t < 1) break;
        if (isnan(t)) return false;
        at[2] += (int)fmax(-8, fmin(8, floor(t)));
    }
    if (!(t >= 0 && t < 1)) return false;
    x->last = at[2];
    hermite(t, b, d);
    force_at(c, t * x->step[2], &F, &one);
    out->pull_N = out->gradient[2] = F;
    out->energy_J = dot(r.p, b) + F * state[2];
    out->gradient[0] = dot(r.by_th, b) / x->step[0];
    out->gradient[1] = dot(r.by_w, b) / x->step[1];
    out->holds = true;
    if (hessian) curves(x, c, place, t, state[2], &r, out);
    return true;
}

fw_status fw_flexure_chart_new(fw_arena *arena, const fw_flexure_hinge_law *law,
                               fw_flexure_elastica *solver, fw_flexure_chart **out) {
    fw_flexure_chart *x = fw_arena_one(arena, fw_flexure_chart);
    FW_NEED(x);
    x->law = law;
    x->rest = fw_flexure_hinge_rest_of(law);
    x->solver = solver;
    double L = law->length_m;
    x->step[0] = step_of[0], x->step[1] = step_of[1] * L;
    x->step[2] = step_of[2];
    x->force_N = widen * L / (8 * law->bend_m_per_N); /* EI/L^2 = L/(8 bend) */
    point bent;
    if (solve_at(x, x->step, &bent)) x->level = fw_flexure_elastica_level(solver);
    for (int i = 0; i < HALVINGS; i++) { /* until the cell beside rest is good */
        make_cell(x, &x->cell[0], first_allowed);
        if (x->cell[0].sound) break;
        for (int a = 0; a < AXES; a++)
            x->step[a] *= 0.5;
        memset(x->node, 0, sizeof x->node);
        x->cell[0].made = false;
    }
    *out = x;
    return FW_OK;
}
