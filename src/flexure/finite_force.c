/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure under forces: where it is displaced to and what it then bears, how its axis drifts, and where its conjugate
   surfaces meet. */
#include "base/constants.h"
#include "flexure/finite.h"
#include "flexure/path.h"
#include <math.h>

/* ---- forces of any size ----

   A flexure shortens as it is displaced across, and is stiffened by the pull that follows. With th
   the rotation, (w, v) the displacement of W along and across the axis in the frame half turned,
   d(th) the drift and F the force along the chord:

     U(th, w, v) = K th^2/2 + stationary over F of
                   F (v - d + h(w)) - ry F^2/2 - by F^2 N/2 + g(w)/(2 (bx A + rx))
     A = a(px F) + a4 q(y; 2/47, 1/47),  N = n(py F) + n4 q(y; 1/60, 1/55),  y = F L^2/EI
     q(y; b, e) = (y/(1 + b y + e^2 y^2))^2
     a(y) = 12 (z coth z - 1)/y,  z = sqrt(y)/2                    softness across a pulled strip
     n(y) = (b(y) + e a(y)) / ((1/60 + e) (1 + e y a(y))),  b = (1 - a)/y       and along its chord
     h(w) = w^2/2l (1 + h4 (w/l)^2),  g(w) = (w L/l)^2 (1 + g4 (w/l)^2),  l = L + ry F
     px = alpha(x) L^2/EI,  py = beta(x) L^2/EI,  e = share dL/6L

   bx, by, rx, ry, d and x = a + share th/2 are those of finite.c, functions of th. a, n and 6 w^2/5L
   of shortening are the exact beam column (a = 0: a straight leaf; roots included); alpha and beta
   make the third variation of the wound arc exact (V3 = 1/2 int (F.t) phi^2 ds with phi = int M/EI
   ds), h4 and g4 the fourth under a force along the axis, n4 that under one across it, a4 what both
   have in common (where it is above 0; b and e are what the fifth has in the mean). For any arc the
   law is thus exact to the third order of the forces, and for a leaf at any pull.

   a is a sum of simple fractions, two of its own poles and four for the rest, 5e-6 of a up to y =
   5000: the law's derivatives are its own to the last digits. The equation of F is convex between
   two poles; Newton's steps are kept there.
   In: rad, m; out: J, N m, N and derivatives. Valid: holds says |x| < pi, |w| < 0.4 L, py F above
   0.98 of the column's buckling load. Error against the exact beam, up to strains of 1 %, 30 deg
   and displacements of ten widths or 0.6 r: place 1 % (0.7 % was the largest of 2700 states), root
   moments 0.4 %; of a guided leaf whose ends keep their distance forces and moments 0.5 %. Cost
   2700 instructions with second derivatives, 700 more where the pull is of the size of a column's
   buckling load. Without them finite_lanes.c answers where its series hold, which is where motions ask:
   1500 instructions of one hinge, 390 of each of four side by side.
   Source: docs/theory/effects/nonlinear-hinge.md; stability functions: Livesley, Chandler 1956.
   Test: test_finite_force.c. */

/* so that what is not asked for is not worked out, at any level of optimisation */
#define INLINE static inline __attribute__((always_inline))

/* of numbers that are none of them NaN: the library's functions, which look for it, are calls */
INLINE double larger(double a, double b) {
    return a > b ? a : b;
}

/* ---- the pulled strip ---- */

enum { POLES = 6 };
/* a = sum r/(y + p): p = (2 k pi)^2, r = 24 of the first two; sum r/p = 1, sum r/p^2 = 1/60 */
#define POLE_1 39.47841760435743
static const double pole_at[POLES] = {39.47841760435743, 157.91367041742973, 365.74769220123466,
                                      921.6727715524736, 3629.757191009823,  41656.55094997054};
static const double residue[POLES] = {
    24, 24, 28.495653461249326, 65.22474971386626, 191.42906667627736, 1611.0185515279315};

typedef struct curve { /* a function with its first two derivatives */
    double v, d, dd;
} curve;

typedef double pair __attribute__((vector_size(16)));

INLINE void pulled(double y, curve *a, curve *b) {
    pair v = {0}, d = {0}, dd = {0}, bv = {0}, bd = {0}, bdd = {0};
    for (int k = 0; k < POLES; k += 2) {
        const pair p = {pole_at[k], pole_at[k + 1]}, own = {residue[k], residue[k + 1]};
        const pair over = {1 / pole_at[k], 1 / pole_at[k + 1]};
        const pair u = 1 / (y + p), r = own * u, ru = r * u, ruu = ru * u;
        v += r, d += ru, dd += ruu;
        bv += r * over, bd += ru * over, bdd += ruu * over;
    }
    *a = (curve){v[0] + v[1], -(d[0] + d[1]), 2 * (dd[0] + dd[1])};
    *b = (curve){bv[0] + bv[1], -(bd[0] + bd[1]), 2 * (bdd[0] + bdd[1])};
}

/* b = 1/60 - A_CURVE y + B_CURVE y^2: sums of r/p^3 and r/p^4 */
#define A_CURVE (1 / 2520.0)
#define B_CURVE 9.920628222132633e-06

/* n and its derivatives, roots included */
INLINE curve along_chord(double y, double e) {
    curve a, b;
    pulled(y, &a, &b);
    if (!(e > 0)) return (curve){60 * b.v, 60 * b.d, 60 * b.dd};
    double per = 1 / (1 / 60.0 + e), q = 1 / (1 + e * y * a.v);
    double d = e * (a.v + y * a.d), dd = e * (2 * a.d + y * a.dd);
    double v = (b.v + e * a.v) * q, v1 = (b.d + e * a.d - v * d) * q;
    return (curve){per * v, per * v1, per * (b.dd + e * a.dd - v * dd - 2 * v1 * d) * q};
}

/* what is of fourth order: q(y; 2/47, 1/47) and q(y; 1/60, 1/55) side by side, by y */
INLINE void fourth(double y, curve *of_a, curve *of_n) {
    const pair b = {2 / 47.0, 1 / 60.0}, e = {1 / (47.0 * 47), 1 / (55.0 * 55)};
    const pair over = 1 / (1 + y * (b + y * e)), root = y * over, flat = 1 - y * y * e;
    const pair d = flat * over * over;
    const pair dd = -2 * (y * e + flat * over * (b + 2 * y * e)) * over * over;
    const pair v = root * root, v1 = 2 * root * d, v2 = 2 * (d * d + root * dd);
    *of_a = (curve){v[0], v1[0], v2[0]}, *of_n = (curve){v[1], v1[1], v2[1]};
}

/* f(p F) + four q(per F), by F */
INLINE curve with_fourth(const curve *f, double p, const curve *q, double four, double per) {
    return (curve){f->v + four * q->v, p * f->d + four * per * q->d,
                   p * p * f->dd + four * per * per * q->dd};
}

/* ---- the stationary value ---- */

typedef struct terms { /* of one state (th, w, v) */
    fw_flexure_hinge_soft c;
    fw_flexure_hinge_wound x;
    double e, length_m, w, free; /* free: v - d */
} terms;

/* h and g of w over the stretched length l = L + ry F, and their derivatives by w, l, h4 and g4 */
typedef struct shortening {
    double h, h_w, h_ww, h_l, h_ll, h_wl, h_4, h_4w, h_4l;
    double g, g_w, g_ww, g_l, g_ll, g_wl, g_4, g_4w, g_4l;
} shortening;

typedef struct state { /* at one F: a(px F), n(py F), their q; by F: A, N and k = 1/(bx A + rx) */
    curve a, n, qa, qn, A, N, k;
    shortening s;
} state;

/* what the equation of F needs of it; returns l */
INLINE double shorten(const terms *t, double F, shortening *s) {
    double l = t->length_m + t->c.rest_y.value * F, over = 1 / l, z = t->w * over, z2 = z * z;
    double z4 = z2 * z2, h4 = t->x.h4.value, g4 = t->x.g4.value, L2 = t->length_m * t->length_m;
    s->h = 0.5 * l * (z2 + h4 * z4), s->g = L2 * (z2 + g4 * z4);
    s->h_l = -0.5 * z2 - 1.5 * h4 * z4, s->h_ll = (z2 + 6 * h4 * z4) * over;
    s->g_l = -L2 * (2 * z2 + 4 * g4 * z4) * over;
    s->g_ll = L2 * (6 * z2 + 20 * g4 * z4) * over * over;
    return l;
}

/* and the rest, by w, h4 and g4 */
INLINE void shorten_all(const terms *t, double F, shortening *s) {
    double l = shorten(t, F, s), over = 1 / l, z = t->w * over, z2 = z * z, z3 = z2 * z;
    double z4 = z2 * z2, h4 = t->x.h4.value, g4 = t->x.g4.value, L2 = t->length_m * t->length_m;
    s->h_w = z + 2 * h4 * z3, s->h_ww = (1 + 6 * h4 * z2) * over;
    s->h_wl = -(z + 6 * h4 * z3) * over;
    s->h_4 = 0.5 * l * z4, s->h_4w = 2 * z3, s->h_4l = -1.5 * z4;
    s->g_w = L2 * (2 * z + 4 * g4 * z3) * over, s->g_ww = L2 * (2 + 12 * g4 * z2) * over * over;
    s->g_wl = -L2 * (4 * z + 16 * g4 * z3) * over * over;
    s->g_4 = L2 * z4, s->g_4w = 4 * L2 * z3 * over, s->g_4l = -4 * L2 * z4 * over;
}

static void shorten_more(const terms *t, double F, shortening *s) {
    shorten_all(t, F, s);
}

/* A, N and k from a, n and their q */
INLINE void soften(const terms *t, state *s) {
    const fw_flexure_hinge_wound *x = &t->x;
    s->A = with_fourth(&s->a, x->px.value, &s->qa, x->a4.value, x->per_N);
    s->N = with_fourth(&s->n, x->py.value, &s->qn, x->n4.value, x->per_N);
    double c1 = t->c.bend_x.value * s->A.d, c2 = t->c.bend_x.value * s->A.dd;
    double k = 1 / (t->c.bend_x.value * s->A.v + t->c.rest_x.value);
    s->k = (curve){k, -c1 * k * k, (2 * c1 * c1 * k - c2) * k * k};
}

INLINE void look(const terms *t, double F, state *s) {
    curve unused;
    pulled(t->x.px.value * F, &s->a, &unused);
    s->n = along_chord(t->x.py.value * F, t->e);
    fourth(t->x.per_N * F, &s->qa, &s->qn);
    soften(t, s);
    shorten(t, F, &s->s);
}

/* dPhi/dF and its derivative by F */
INLINE double slope_of(const terms *t, const state *s, double F, double *second) {
    const shortening *p = &s->s;
    double by = t->c.bend_y.value, r = t->c.rest_y.value, k = s->k.v;
    double by_l = F * p->h_l + 0.5 * k * p->g_l;
    *second = -r - by * (s->N.v + F * (2 * s->N.d + 0.5 * F * s->N.dd)) + 0.5 * s->k.dd * p->g +
              2 * r * (p->h_l + 0.5 * s->k.d * p->g_l) + r * r * (F * p->h_ll + 0.5 * k * p->g_ll);
    return t->free + p->h - r * F - by * F * (s->N.v + 0.5 * F * s->N.d) + 0.5 * s->k.d * p->g +
           r * by_l;
}

/* the interval of F between the poles of a and n; an arc that is pressed bows below a column's load.
   Returns the largest y of a unit F */
static double between_poles(const terms *t, double *low, double *high) {
    const double most = 0.999 * pole_at[0];
    const double pressed = larger(t->x.per_N, larger(t->x.py.value, t->x.px.value));
    *low = -most / larger(pressed, 1e-300); /* 0: a plain spring */
    *high = t->x.px.value < 0 ? -most / t->x.px.value : (double)INFINITY;
    *low = larger(*low, -0.5 * t->length_m / larger(t->c.rest_y.value, 1e-300)); /* l > L/2 */
    return larger(pressed, -t->x.px.value);
}

/* dPhi/dF and its derivative at no force, where all functions are known */
static double unloaded(const terms *t, double *second) {
    static const curve a = {1, -1 / 60.0, 2 * A_CURVE};
    static const curve b = {1 / 60.0, -A_CURVE, 2 * B_CURVE};
    double e = t->e, per = 1 / (1 / 60.0 + e), d = e, dd = 2 * e * a.d, v = b.v + e;
    double v1 = b.d + e * a.d - v * d;
    state s = {.a = a,
               .n = {1, per * v1, per * (b.dd + e * a.dd - v * dd - 2 * v1 * d)},
               .qa = {0, 0, 2},
               .qn = {0, 0, 2}};
    soften(t, &s);
    shorten(t, 0, &s.s);
    return slope_of(t, &s, 0, second);
}

/* what was looked at, at F + more: first derivatives by the second ones, values to the third order */
static void advance(const terms *t, double more, state *s) {
    curve *const of[4] = {&s->a, &s->n, &s->qa, &s->qn};
    const double by[4] = {t->x.px.value, t->x.py.value, t->x.per_N, t->x.per_N};
    for (int i = 0; i < 4; i++) {
        double y = by[i] * more;
        of[i]->v += y * (of[i]->d + 0.5 * y * of[i]->dd), of[i]->d += y * of[i]->dd;
    }
    soften(t, s);
}

/* A step of Newton's method from F, the first place behind no force, and what it leaves out by Hermite's
   interpolation of F over the slope: with p, q the slope and its derivative there, p0, q0 at no force
   and D = (0 - F)/(p0 - p)

     F - p/q + p^2 (c2 - c3 p0),  c2 = (D - 1/q)/(p0 - p),  c3 = (1/q0 - 2 D + 1/q)/(p0 - p)^2

   F is off by a part e of itself because the slope curves; what is added is e^3 of it, what is still left
   out e^5. 0: too far for that, 1e-13 of the law's force being what is allowed. Test:
   test_finite_force.c in_one_step */
static double hermite_step(double p0, double q0, double F, double p, double q) {
    const double far = 2e-3, most = 5e-9;
    double over = 1 / (p0 - p), D = -F * over, step = -p / q;
    double more = p * p * over * (D - 1 / q - p0 * over * (1 / q0 - 2 * D + 1 / q));
    return fabs(step) <= far * fabs(F) && fabs(more) <= most * fabs(F) ? step + more : 0;
}

/* Newton's method, from its first step from no force: near its end a step leaves its square. Where second
   derivatives are not asked for, those of the last place do for the rest of it, which one look at the
   functions mostly is enough for */
static double solve(const terms *t, bool hessian, state *s) {
    const double near = 1e-6, moved = 2e-4; /* of y, what `advance` is good for */
    double low, high, second, second_0, slope_0 = unloaded(t, &second_0);
    double pressed = between_poles(t, &low, &high), F = second_0 < 0 ? -slope_0 / second_0 : 0;
    if (!(F > low && F < high)) F = 0;
    for (int i = 0; i < 60; i++) {
        look(t, F, s);
        double slope = slope_of(t, s, F, &second);
        if (slope > 0)
            low = F;
        else
            high = F;
        double step = second < 0 ? -slope / second : 0, to = F + step;
        if (second < 0 && fabs(step) <= 2e-12 * fabs(F)) return to; /* s is that near, too */
        double rest = 0; /* of the way, where the derivatives of this place are good for it */
        if (!hessian && second < 0 && fabs(step) <= near * fabs(F))
            rest = step;
        else if (!hessian && second < 0 && i == 0 && pressed * fabs(step) <= moved)
            rest = hermite_step(slope_0, second_0, F, slope, second);
        if (rest != 0) {
            advance(t, rest, s);
            return F + rest;
        }
        if (!(to > low && to < high) || !(second < 0))
            to = isfinite(high) ? 0.5 * (low + high) : 2 * F + fabs(F - low) + 1 / t->x.py.value;
        F = to;
    }
    return F;
}

INLINE void prepare(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                    const double at[3], bool second, terms *t) {
    fw_flexure_hinge_law_soft(law, rest, at[0], second, &t->c);
    fw_flexure_hinge_law_wound(law, at[0], second, &t->x);
    t->e = fw_flexure_hinge_chord_roots(law);
    t->length_m = law->length_m;
    t->w = at[1];
    t->free = at[2] - t->c.drift_m.value;
}

/* explicit derivatives of Phi(th, w, v; F): by th, by th twice, by th and F, by th and w */
typedef struct turning {
    double one, two, with_F, with_w;
} turning;

/* of f(p F) + four q(per F), whose p and four turn with th */
INLINE turning turned(const curve *f, const fw_flexure_hinge_jet *p, const curve *q,
                      const fw_flexure_hinge_jet *four, double per, double F) {
    double more = p->slope * F;
    return (turning){.one = f->d * more + four->slope * q->v,
                     .two = f->dd * more * more + f->d * p->curve * F + four->curve * q->v,
                     .with_F =
                         f->d * p->slope + f->dd * p->value * more + four->slope * per * q->d};
}

INLINE turning by_rotation(const terms *t, const state *s, double F) {
    const fw_flexure_hinge_jet *bx = &t->c.bend_x, *rx = &t->c.rest_x, *by = &t->c.bend_y;
    const fw_flexure_hinge_jet *ry = &t->c.rest_y, *d = &t->c.drift_m;
    const fw_flexure_hinge_jet *h4 = &t->x.h4, *g4 = &t->x.g4;
    const shortening *z = &s->s;
    const turning A = turned(&s->a, &t->x.px, &s->qa, &t->x.a4, t->x.per_N, F);
    const turning N = turned(&s->n, &t->x.py, &s->qn, &t->x.n4, t->x.per_N, F);
    double k = s->k.v, F2 = F * F, r = ry->value, l1 = ry->slope * F;
    /* bx A + rx */
    double c = bx->slope * s->A.v + bx->value * A.one + rx->slope;
    double cc = bx->curve * s->A.v + 2 * bx->slope * A.one + bx->value * A.two + rx->curve;
    double cF = bx->value * s->A.d, cm = bx->slope * s->A.d + bx->value * A.with_F;
    double k1 = -c * k * k, kF = -cF * k * k;
    double k2 = (2 * c * c * k - cc) * k * k, km = (2 * c * cF * k - cm) * k * k;
    /* what shortens, T = F h + k g/2: by th, by l, and both, at a held l first */
    double T1 = F * h4->slope * z->h_4 + 0.5 * (k1 * z->g + k * g4->slope * z->g_4);
    double T2 = F * h4->curve * z->h_4 +
                0.5 * (k2 * z->g + 2 * k1 * g4->slope * z->g_4 + k * g4->curve * z->g_4);
    double T1F = h4->slope * z->h_4 + 0.5 * (km * z->g + kF * g4->slope * z->g_4);
    double T1l = F * h4->slope * z->h_4l + 0.5 * (k1 * z->g_l + k * g4->slope * z->g_4l);
    double T1w = F * h4->slope * z->h_4w + 0.5 * (k1 * z->g_w + k * g4->slope * z->g_4w);
    double Tl = F * z->h_l + 0.5 * k * z->g_l, Tll = F * z->h_ll + 0.5 * k * z->g_ll;
    double TFl = z->h_l + 0.5 * kF * z->g_l, Twl = F * z->h_wl + 0.5 * k * z->g_wl;
    return (turning){
        .one = -F * d->slope - 0.5 * F2 * (ry->slope + by->slope * s->N.v + by->value * N.one) +
               T1 + Tl * l1,
        .two = -F * d->curve -
               0.5 * F2 *
                   (ry->curve + by->curve * s->N.v + 2 * by->slope * N.one + by->value * N.two) +
               T2 + 2 * T1l * l1 + Tll * l1 * l1 + Tl * ry->curve * F,
        .with_F = -d->slope - F * ry->slope - by->slope * F * (s->N.v + 0.5 * F * s->N.d) -
                  by->value * F * (N.one + 0.5 * F * N.with_F) + T1F + T1l * r + TFl * l1 +
                  Tll * r * l1 + Tl * ry->slope,
        .with_w = T1w + Twl * l1};
}

INLINE void bend(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                 const double at[3], bool hessian, fw_flexure_hinge_bent *out) {
    terms t;
    state s;
    double second;
    prepare(law, rest, at, hessian, &t);
    double F = solve(&t, hessian, &s), K = law->stiffness_Nm_per_rad, k = s.k.v;
    const shortening *p = &s.s;
    shorten_more(&t, F, &s.s);
    const turning turn = by_rotation(&t, &s, F);
    double pressed = larger(t.x.per_N, larger(t.x.px.value, t.x.py.value));
    out->pull_N = F;
    out->energy_J = 0.5 * K * at[0] * at[0] + F * (t.free + p->h) -
                    0.5 * F * F * (t.c.rest_y.value + t.c.bend_y.value * s.N.v) + 0.5 * k * p->g;
    out->gradient[0] = K * at[0] + turn.one;
    out->gradient[1] = F * p->h_w + 0.5 * k * p->g_w;
    out->gradient[2] = F;
    out->holds = fw_flexure_hinge_law_holds(law, at[0]) && fabs(at[1]) < 0.4 * law->length_m &&
                 larger(-pressed * F, -t.x.px.value * F) < 0.98 * pole_at[0];
    out->kx_N_per_m = 1 / (t.c.bend_x.value + t.c.rest_x.value);
    out->ky_N_per_m = 1 / (t.c.bend_y.value + t.c.rest_y.value);
    out->drift_slope = t.c.drift_m.slope;
    if (!hessian) return;
    (void)slope_of(&t, &s, F, &second);
    double r = t.c.rest_y.value;
    double w_and_F = p->h_w + 0.5 * s.k.d * p->g_w + r * (F * p->h_wl + 0.5 * k * p->g_wl);
    const double with_F[3] = {turn.with_F, w_and_F, 1};
    const double explicit[3][3] = {
        {K + turn.two, turn.with_w, 0}, {0, F * p->h_ww + 0.5 * k * p->g_ww, 0}, {0, 0, 0}};
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            out->hessian[i][j] = out->hessian[j][i] =
                explicit[i][j] - with_F[i] * with_F[j] / second;
}

void fw_flexure_hinge_law_bend(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                               const double at[3], bool hessian, fw_flexure_hinge_bent *out) {
    if (hessian)
        bend(law, rest, at, true, out);
    else if (!(rest->number[FW_HINGE_RANGE] > 0 &&
               fw_flexure_lanes_bend_1(rest->number, 1, at, 1, &out)))
        bend(law, rest, at, false, out); /* beyond what the series are good for */
}

/* (w, v), dU/dth and the pull of a state whose w and F are known */
static void known(const fw_flexure_hinge_law *law, terms *t, state *s, double th, double F,
                  double displaced_m[2], double *moment_Nm, double *pull) {
    double second;
    shorten_more(t, F, &s->s);
    displaced_m[0] = t->w;
    displaced_m[1] = -slope_of(t, s, F, &second); /* dPhi/dF = 0 at v */
    *moment_Nm = law->stiffness_Nm_per_rad * th + by_rotation(t, s, F).one;
    *pull = t->x.px.value * F;
}

/* The same from the other side: (w, v) and dU/dth under a force (along, across) that is given. The
   pull F is then known, so that only w is sought, by Newton's method; h and g make it stiffer as it
   grows. in: rad, N; out: m, N m; false: no such equilibrium below the buckling load. What does not
   depend on the force is worked out once for many (`turned`). Test: test_finite_force.c
   under_a_force, under_many_forces */
void fw_flexure_hinge_law_rotated(const fw_flexure_hinge_law *law,
                                  const fw_flexure_hinge_rest *rest, double th,
                                  fw_flexure_hinge_rotated *out) {
    terms t;
    prepare(law, rest, (const double[3]){th, 0, 0}, false, &t);
    *out = (fw_flexure_hinge_rotated){
        .law = law, .soft = t.c, .wound = t.x, .rotation_rad = th, .roots = t.e};
    between_poles(&t, &out->least_N, &out->most_N);
}

bool fw_flexure_hinge_rotated_under(const fw_flexure_hinge_rotated *at, const double force_N[2],
                                    double displaced_m[2], double *moment_Nm, double *pull) {
    const double F = force_N[1];
    if (!(F > at->least_N && F < at->most_N)) return false;
    terms t = {.c = at->soft,
               .x = at->wound,
               .e = at->roots,
               .length_m = at->law->length_m,
               .free = 0 - at->soft.drift_m.value};
    state s;
    double w = 0;
    look(&t, F, &s);
    for (int i = 0; i < 40; i++) {
        t.w = w;
        shorten_all(&t, F, &s.s);
        double stiff = F * s.s.h_ww + 0.5 * s.k.v * s.s.g_ww;
        double step = (force_N[0] - F * s.s.h_w - 0.5 * s.k.v * s.s.g_w) / stiff;
        if (!(stiff > 0) || !(fabs(w + step) < at->law->length_m)) return false;
        w += step;
        if (fabs(step) > 1e-12 * fabs(w)) continue;
        t.w = w;
        known(at->law, &t, &s, at->rotation_rad, F, displaced_m, moment_Nm, pull);
        return true;
    }
    return false;
}

bool fw_flexure_hinge_law_under(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                double th, const double force_N[2], double displaced_m[2],
                                double *moment_Nm, double *pull) {
    fw_flexure_hinge_rotated at;
    fw_flexure_hinge_law_rotated(law, rest, th, &at);
    return fw_flexure_hinge_rotated_under(&at, force_N, displaced_m, moment_Nm, pull);
}

/* Where other flexures hold the bodies: the pull and w are given, not what it takes to keep them. in:
   rad, N, m; false: pressed by more than the buckling load with both ends clamped. Test:
   test_finite_force.c held_by_others */
bool fw_flexure_hinge_law_held(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                               double th, double pull_N, double w_m, double displaced_m[2],
                               double *moment_Nm, double *pull) {
    terms t;
    state s;
    double low, high;
    prepare(law, rest, (const double[3]){th, w_m, 0}, false, &t);
    between_poles(&t, &low, &high);
    if (!(pull_N > low && pull_N < high) || !(fabs(w_m) < law->length_m)) return false;
    look(&t, pull_N, &s);
    known(law, &t, &s, th, pull_N, displaced_m, moment_Nm, pull);
    return true;
}

void fw_flexure_hinge_law_wrench(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                 const double twist[3], double wrench[3], double tangent[3][3]) {
    fw_flexure_hinge_bent b;
    const fw_flexure_half_turned half = fw_flexure_hinge_half_turned(twist);
    fw_flexure_hinge_law_bend(law, rest, half.at, tangent != NULL, &b);
    fw_flexure_hinge_wrench_of(&b, &half, wrench, tangent);
}

/* ---- how a hinge's axis drifts, and where its conjugate surfaces meet ----

   Theory: docs/theory/axis-drift.md. */

enum { STEPS = 256, HALVINGS = 60 };

/* Pole of the displacement that turns by th and moves W by drift along y of the frame half turned:
     p = -drift / (2 sin(th/2)) along x of that frame, -> -drift'(0), nothing, at th = 0
   To first order in th it is -drift''(0) th/2: what is called the shift of the rotation centre in
   the literature (Verotti 2016); the error of a pin at W is the drift itself, second order.
   in: rad, m; out: m. Valid |th| < pi. Exact for the law. Cost 50 ns.
   Below 1e-5 rad by two terms: the slope at th is drift'(0) + drift''(0) th.
   source: docs/theory/axis-drift.md eq. 15; test_drift.c pole_stands_still */
static double pole(const fw_flexure_hinge_at *at, double th) {
    double s = 2 * sin(0.5 * th);
    return fabs(th) < 1e-5 ? 0.5 * at->drift_m.curve * th - at->drift_m.slope
                           : -at->drift_m.value / s;
}

/* what is left of a gap when the surfaces are displaced by u: gap - |u| cos zeta */
static double left(const fw_flexure_surfaces *s, double x, double y) {
    return s->gap_m - hypot(x, y) * cos(s->aside_rad);
}

/* Displacement of the second body's W in the frame half turned, h = th/2, under a force F that
   keeps its direction in the first body's frame; in: rad, N; out: m, NaN beyond the buckling load.
   Error of the law: finite_force.c. Test: test_drift.c under_a_force */
static void displaced(const fw_flexure_hinge_law *law, double th, const double F[2], double u[2]) {
    const fw_flexure_hinge_rest rest = fw_flexure_hinge_rest_bare(law);
    double c = cos(0.5 * th), s = sin(0.5 * th), x = F ? F[0] : 0, y = F ? F[1] : 0, moment, pull;
    if (!fw_flexure_hinge_law_under(law, &rest, th, (const double[2]){c * x + s * y, c * y - s * x},
                                    u, &moment, &pull))
        u[0] = u[1] = (double)NAN;
}

/* the offset o along y of the first body is o (sin h, cos h) in the frame half turned; a point c
   that both bodies carry parts by (R(h) - R(-h)) c = 2 sin h (-c_y, c_x) */
static double left_at(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s, double th,
                      const double F[2]) {
    double u[2], h = 0.5 * th;
    displaced(law, th, F, u);
    double turn = 2 * sin(h), x = u[0] - turn * s->centre_m[1], y = u[1] + turn * s->centre_m[0];
    return left(s, x - s->offset_m * sin(h), y - s->offset_m * cos(h));
}

void fw_flexure_drift_displacement(const fw_flexure_hinge_law *law, double th, const double F[2],
                                   double u_m[2]) {
    double u[2], c = cos(0.5 * th), s = sin(0.5 * th);
    displaced(law, th, F, u);
    u_m[0] = c * u[0] - s * u[1], u_m[1] = s * u[0] + c * u[1];
}

fw_flexure_drift_point fw_flexure_drift_at(const fw_flexure_hinge_law *law,
                                           const fw_flexure_surfaces *surfaces, double th) {
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(law, th, &at);
    return (fw_flexure_drift_point){th, at.drift_m.value, pole(&at, th),
                                    left_at(law, surfaces, th, NULL)};
}

void fw_flexure_drift_curve(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *surfaces,
                            double low_rad, double high_rad, int n, fw_flexure_drift_point *point) {
    for (int i = 0; i < n; i++) {
        double part = n > 1 ? (double)i / (n - 1) : 0;
        point[i] = fw_flexure_drift_at(law, surfaces, low_rad + part * (high_rad - low_rad));
    }
}

/* The surfaces meet where |u| cos zeta = gap (radii Rc and Rc + gap about centres u apart).
   In: rad, m, N; out rad, to 1e-15. Sought from 0 in steps of 0.7 deg, then halved: a touch that
   ends within one step is missed. After it the hinge is a pin joint of that clearance, which this
   does not follow (contact.c does). Cost 10 to 20 us.
   source: docs/theory/axis-drift.md eq. 16; test_drift.c surfaces_meet */
double fw_flexure_drift_contact_rad(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *s,
                                    const double F[2], int sense) {
    double low = 0, step = (sense < 0 ? -FW_PI : FW_PI) / STEPS;
    if (!(left_at(law, s, 0, F) > 0)) return 0;
    for (int i = 1; i < STEPS; i++) {
        double high = i * step;
        if (left_at(law, s, high, F) > 0) {
            low = high;
            continue;
        }
        for (int k = 0; k < HALVINGS; k++) {
            double middle = 0.5 * (low + high);
            if (left_at(law, s, middle, F) > 0)
                low = middle;
            else
                high = middle;
        }
        return high;
    }
    return (double)NAN;
}

/* The drift has one sign for both senses of rotation, 0 at rest: surfaces that are concentric half
   way of it need half the gap. A pin at (p, 0) from W is off by drift + 2 p sin(th/2): none at th
   where p is the pole of th.
   source: docs/theory/axis-drift.md eq. 17; test_drift.c advice_halves_the_gap */
fw_flexure_drift_advice fw_flexure_drift_advise(const fw_flexure_hinge_law *law, double low_rad,
                                                double high_rad) {
    double most = 0, least = 0;
    fw_flexure_hinge_at at;
    for (int i = 0; i <= STEPS; i++) {
        fw_flexure_hinge_law_at(law, low_rad + i * (high_rad - low_rad) / STEPS, &at);
        most = fmax(most, at.drift_m.value), least = fmin(least, at.drift_m.value);
    }
    fw_flexure_drift_advice advice = {.offset_m = 0.5 * (most + least),
                                      .centred_m = fmax(most, -least)};
    /* the offset itself turns with the first body: a little more than half is needed */
    const fw_flexure_surfaces s = {.gap_m = 0, .offset_m = advice.offset_m};
    for (int i = 0; i <= STEPS; i++) {
        double th = low_rad + i * (high_rad - low_rad) / STEPS;
        advice.gap_m = fmax(advice.gap_m, -left_at(law, &s, th, NULL));
    }
    double far = high_rad > -low_rad ? high_rad : low_rad, near = far > 0 ? -low_rad : high_rad;
    fw_flexure_hinge_law_at(law, far, &at);
    advice.pivot_x_m = pole(&at, far) * (1 - fabs(near / far));
    if (!isfinite(advice.pivot_x_m)) advice.pivot_x_m = 0;
    return advice;
}
