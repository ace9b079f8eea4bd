/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel of a path: bodies in a row, each pinned to the next, the ends free or on the ground -
   every chain, and the single loop of a six-bar. The elimination starts from both ends at once and
   meets in the middle, so that half as many divisions wait for one another. Include once in a
   translation unit that defines FW_W, FW_PATH (name of the row of functions), FW_PATH_NAME and

     FW_SIDES 1: one design, FW_W = 2, the two ends in the two lanes of a register;
     FW_SIDES 2: FW_W designs in the lanes, the two ends in two records.

   Record i holds the i-th bodies from both ends and the i-th pins from both ends. On its side a pin
   reads Psi = x_outer - x_inner, outer being towards its own end; both sides then do the same.
   With an even number of pins they meet in a body: the last pivot of either side is updated by the
   other's (both Schur complements at once, no substitution between the two). With an odd number
   they meet in a pin, which both sides hold with opposite signs. Ground: 1/m = 1/J = 0.
   Methods, errors and sources as in kernel_core.h. Test: test_kernel.c, test_lanes.c. */
#include "multibody/kernel_plan.h"
#include "multibody/kernel_sincos.h"
#include <float.h>
#include <math.h>

#if FW_SIDES == 1
enum { ENDS = 2, DESIGNS = 1 };
#else
enum { ENDS = 1, DESIGNS = FW_W };
#endif

typedef struct arms { /* outer and inner, at this pose; then divided by J */
    real rox, roy, rix, riy, pox, poy, pix, piy;
} arms;

typedef struct record {
    /* constants: bodies, then pins */
    real minv, jinv, ax, ay, at, phi0;
    real outer_x, outer_y, inner_x, inner_y; /* local arms */
    real masses, floor, k, c, torque0, offset_x, offset_y;
    bits moves; /* 0 in the lane of a ground */
    int body[ENDS], pin[ENDS];
    double sign[ENDS]; /* of the multiplier in the model */
    /* work: bodies */
    real cosine, sine, phi, w, turn; /* turn: angular acceleration M^-1 Q; ax, ay are constant */
    arms arm; /* pins: then pivot block and 1/determinant, L to the pin before, solution */
    real xx, xy, yy, inverse, l0, l1, l2, l3, x0, x1;
} record;

typedef struct corner { /* the last pivot of an even path: M adj/det of the other, and itself after
                           the update */
    real m0, m1, m2, m3, xx, xy, yy, inverse;
} corner;

typedef struct path {
    int pins, records, half; /* records of pins; those before the middle */
    int first;               /* 1: both ends on the ground, record 0 never turns */
    int bodies;              /* records of bodies: an even path has one more for the middle */
    bool even, dissipates;
    int nq, ny;
    record *r; /* (bodies x FW_SIDES) */
    corner last[FW_SIDES];
    real size, rate;
    bool rated; /* rate is not 1 in some lane */
    double healthy;
    struct loop *loop; /* NULL: kernel_loop.h does not know this path */
    real *keep;        /* (4 records x FW_SIDES) */
    fw_kernel_norms norms;
} path;

#define SIDES(s)           for (int s = 0; s < FW_SIDES; s++)
#define RECORD(p, i, side) (&(p)->r[(i)*FW_SIDES + (side)])
#define NEXT(record)       ((record) + FW_SIDES)

/* a value of the other side, read from the record that `mate` gives */
#if FW_SIDES == 1
static inline const record *mate(const record *r, int side) {
    (void)side;
    return r;
}
static inline real cross(real a) {
    return __builtin_shufflevector(a, a, 1, 0);
}
static inline real gather(const record *r, const double *y, int c) {
    real both = {y[3 * r->body[0] + c], y[3 * r->body[1] + c]};
    return (real)((bits)both & r->moves);
}
#else
static inline const record *mate(const record *r, int side) {
    return side ? r - 1 : r + 1;
}
static inline real cross(real a) {
    return a;
}
static inline real gather(const record *r, const double *y, int c) {
    return (real)((bits)((const real *)y)[3 * r->body[0] + c] & r->moves);
}
#endif

/* ---- pose and arms ---- */

static __attribute__((noinline)) void sines_of_far(path *p) {
    for (int i = p->first * FW_SIDES; i < p->bodies * FW_SIDES; i++) {
        record *r = &p->r[i];
        for (int lane = 0; lane < FW_W; lane++) {
            double angle = r->phi0[lane] + r->phi[lane], s, c;
            if (!(fabs(angle) > fw_sincos_range)) continue;
            sincos(angle, &s, &c);
            r->sine[lane] = s, r->cosine[lane] = c;
        }
    }
}

static inline __attribute__((always_inline)) void set_sines(path *p, const double *u) {
    bits outside = {0};
    for (int i = p->first; i < p->bodies; i++) {
        bool once = FW_SIDES == 2 && i == p->records; /* the middle body is on both sides */
        for (int s = 0; s < FW_SIDES; s++) {
            record *r = RECORD(p, i, s);
            if (once && s) {
                r->phi = r[-1].phi, r->cosine = r[-1].cosine, r->sine = r[-1].sine;
                continue;
            }
            r->phi = gather(r, u, 2);
            real angle = r->phi0 + r->phi;
            outside |= bits_of(fw_sincos_range - real_abs(angle));
            real_sincos(angle, &r->sine, &r->cosine);
        }
    }
    if (bits_any(bits_negative(outside))) sines_of_far(p);
}

static inline __attribute__((always_inline)) void outer_arm(const record *r, arms *a) {
    a->rox = r->cosine * r->outer_x - r->sine * r->outer_y;
    a->roy = r->sine * r->outer_x + r->cosine * r->outer_y;
    a->pox = r->jinv * a->rox;
    a->poy = r->jinv * a->roy;
}

static inline __attribute__((always_inline)) arms arms_of(const record *r) {
    const record *n = NEXT(r);
    arms a;
    outer_arm(r, &a);
    a.rix = n->cosine * r->inner_x - n->sine * r->inner_y;
    a.riy = n->sine * r->inner_x + n->cosine * r->inner_y;
    a.pix = n->jinv * a.rix;
    a.piy = n->jinv * a.riy;
    return a;
}

/* of a middle pin: the inner arm is the other side's outer one */
static inline __attribute__((always_inline)) arms middle_arms(const record *r, int side) {
    arms a, o;
    outer_arm(r, &a);
    outer_arm(mate(r, side), &o);
    a.rix = cross(o.rox), a.riy = cross(o.roy);
    a.pix = cross(o.pox), a.piy = cross(o.poy);
    return a;
}

static void set_arms(path *p) {
    for (int i = 0; i < p->half; i++)
        SIDES(s) RECORD(p, i, s)->arm = arms_of(RECORD(p, i, s));
    if (!p->even) SIDES(s) RECORD(p, p->half, s)->arm = middle_arms(RECORD(p, p->half, s), s);
}

static void set_pose(path *p, const double *u) {
    set_sines(p, u);
    set_arms(p);
}

/* ---- S and right-hand side ---- */

typedef struct pivot { /* block and right-hand side, in registers while others are taken off */
    real xx, xy, yy, x0, x1;
} pivot;

static inline __attribute__((always_inline)) void set_pivot(pivot *t, const record *r,
                                                            const arms *a, double epsilon) {
    real mass = r->masses;
    if (epsilon > 0) mass += epsilon * r->masses;
    t->xx = mass + (a->poy * a->roy + a->piy * a->riy);
    t->xy = -(a->poy * a->rox + a->piy * a->rix);
    t->yy = mass + (a->pox * a->rox + a->pix * a->rix);
}

static inline __attribute__((always_inline)) void set_right(pivot *t, const record *r,
                                                            const arms *a, int side, bool middle) {
    const record *n = NEXT(r), *o = mate(r, side);
    real wo = r->w * r->w, w = middle ? cross(o->w) : n->w, wi = w * w;
    real ax = middle ? cross(o->ax) : n->ax, ay = middle ? cross(o->ay) : n->ay;
    real turn = middle ? cross(o->turn) : n->turn;
    t->x0 = ((r->ax - r->turn * a->roy) - wo * a->rox) - ((ax - turn * a->riy) - wi * a->rix);
    t->x1 = ((r->ay + r->turn * a->rox) - wo * a->roy) - ((ay + turn * a->rix) - wi * a->riy);
}

/* G M^-1 Q + G' v of all pins, for `solve` */
static void set_rights(path *p) {
    for (int i = 0; i < p->records; i++)
        SIDES(s) {
            record *r = RECORD(p, i, s);
            pivot t;
            set_right(&t, r, &r->arm, s, i == p->half);
            r->x0 = t.x0, r->x1 = t.x1;
        }
}

/* M^-1 Q of all bodies; the power dissipated (one side: sum of the lanes) */
static inline __attribute__((always_inline)) real set_accelerations(path *p, const double *v) {
    const real nothing = {0};
    real power = nothing, before[FW_SIDES];
    SIDES(s) before[s] = nothing;
    for (int i = p->first; i < p->bodies; i++)
        SIDES(s) RECORD(p, i, s)->w = gather(RECORD(p, i, s), v, 2);
    for (int i = 0; i < p->half; i++)
        SIDES(s) {
            record *r = RECORD(p, i, s), *n = NEXT(r);
            real rate = n->w - r->w, damping = r->c * rate;
            real torque = (r->torque0 + r->k * (n->phi - r->phi)) + damping;
            r->turn = r->at + r->jinv * (torque - before[s]);
            before[s] = torque;
            power += damping * rate;
        }
    SIDES(s) {
        record *r = RECORD(p, p->half, s);
        const record *o = mate(r, s);
        if (p->even) {
            r->turn = r->at - r->jinv * (before[s] + cross(before[FW_SIDES - 1 - s]));
            continue;
        }
        real rate = cross(o->w) - r->w, damping = r->c * rate;
        real torque = (r->torque0 + r->k * (cross(o->phi) - r->phi)) + damping;
        r->turn = r->at + r->jinv * (torque - before[s]);
        power += 0.5 * (damping * rate); /* both sides hold the pin */
    }
    return power;
}

/* ---- elimination ---- */

typedef struct coupling {
    real b0, b1, b2, b3;
} coupling;

static inline __attribute__((always_inline)) coupling couple(real minv, real px, real py, real rx,
                                                             real ry) {
    return (coupling){minv + py * ry, -(py * rx), -(px * ry), minv + px * rx};
}

typedef struct carry { /* the pin before, in registers: pivot, reduced right-hand side, inner arm */
    real xx, xy, yy, inverse, z0, z1, rix, riy;
} carry;

typedef struct update { /* what one pin takes off the next: B adj B^T/det of the pivot, B z/det of
                           the right-hand side, and L = B adj/det */
    real xx, xy, yy, x0, x1, l0, l1, l2, l3;
} update;

static inline __attribute__((always_inline)) update take(const carry *c, coupling b) {
    real t0 = b.b0 * c->yy - b.b1 * c->xy, t1 = b.b1 * c->xx - b.b0 * c->xy;
    real t2 = b.b2 * c->yy - b.b3 * c->xy, t3 = b.b3 * c->xx - b.b2 * c->xy;
    return (update){(t0 * b.b0 + t1 * b.b1) * c->inverse,
                    (t0 * b.b2 + t1 * b.b3) * c->inverse,
                    (t2 * b.b2 + t3 * b.b3) * c->inverse,
                    (b.b0 * c->z0 + b.b1 * c->z1) * c->inverse,
                    (b.b2 * c->z0 + b.b3 * c->z1) * c->inverse,
                    t0 * c->inverse,
                    t1 * c->inverse,
                    t2 * c->inverse,
                    t3 * c->inverse};
}

/* negative: the pivot is not above the limit; NaN passes and shows in the result */
static inline __attribute__((always_inline)) bits check(real determinant, real xx, real yy,
                                                        real floor, double limit) {
    real least = limit * floor; /* det/trace is below the smaller eigenvalue */
    return bits_of(determinant - least * (xx + yy)) | bits_of(xx - least);
}

/* the last pivots of an even path: each side's is updated by the other's */
static inline __attribute__((always_inline)) bits meet(record *r, const carry *b, const carry *o,
                                                       corner *last, double limit, bool forward) {
    const carry other = {cross(o->xx), cross(o->xy), cross(o->yy),  cross(o->inverse),
                         cross(o->z0), cross(o->z1), cross(o->rix), cross(o->riy)};
    update u = take(&other, couple(NEXT(r)->minv, r->arm.pix, r->arm.piy, other.rix, other.riy));
    real xx = b->xx - u.xx, xy = b->xy - u.xy, yy = b->yy - u.yy;
    real determinant = xx * yy - xy * xy, inverse = 1.0 / determinant;
    *last = (corner){u.l0, u.l1, u.l2, u.l3, xx, xy, yy, inverse};
    if (forward) {
        real x0 = r->x0 - u.x0, x1 = r->x1 - u.x1;
        r->x0 = (yy * x0 - xy * x1) * inverse;
        r->x1 = (xx * x1 - xy * x0) * inverse;
    }
    return check(determinant, xx, yy, r->floor, limit);
}

/* a pin from which all others are taken off: inverts, reduces, stores. `last`: the right-hand side
   is kept as it is, for `meet` */
static inline __attribute__((always_inline)) bits
close(record *r, const pivot *t, const arms *a, carry *b, double limit, bool forward, bool last) {
    real determinant = t->xx * t->yy - t->xy * t->xy, inverse = 1.0 / determinant;
    b->xx = r->xx = t->xx, b->xy = r->xy = t->xy, b->yy = r->yy = t->yy;
    b->inverse = r->inverse = inverse;
    b->rix = a->rix, b->riy = a->riy;
    if (forward) {
        b->z0 = t->yy * t->x0 - t->xy * t->x1, b->z1 = t->xx * t->x1 - t->xy * t->x0;
        r->x0 = last ? t->x0 : b->z0 * inverse;
        r->x1 = last ? t->x1 : b->z1 * inverse;
    }
    return check(determinant, t->xx, t->yy, r->floor, limit);
}

/* of -B, since the two pins hold their common body with opposite signs */
static inline __attribute__((always_inline)) update from_before(record *r, const arms *a,
                                                                const carry *b) {
    update u = take(b, couple(r->minv, a->pox, a->poy, b->rix, b->riy));
    r->l0 = u.l0, r->l1 = u.l1, r->l2 = u.l2, r->l3 = u.l3;
    return u;
}

/* one side up to the middle; `make`: the arms are made on the way, and only those divided by J are
   stored */
static inline __attribute__((always_inline)) bits
eliminate_side(path *p, int s, double epsilon, double limit, bool make, bool forward, carry *out) {
    const real nothing = {0};
    bits sick = {0};
    carry b = {nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing};
    for (int i = 0; i < p->half; i++) {
        record *r = RECORD(p, i, s);
        arms a = make ? arms_of(r) : r->arm;
        if (make) r->arm.pox = a.pox, r->arm.poy = a.poy, r->arm.pix = a.pix, r->arm.piy = a.piy;
        pivot t = {nothing, nothing, nothing, nothing, nothing};
        set_pivot(&t, r, &a, epsilon);
        if (forward) set_right(&t, r, &a, s, false);
        if (i > 0) {
            update u = from_before(r, &a, &b);
            t.xx -= u.xx, t.xy -= u.xy, t.yy -= u.yy;
            if (forward) t.x0 += u.x0, t.x1 += u.x1;
        }
        sick |= close(r, &t, &a, &b, limit, forward, p->even && i + 1 == p->half);
    }
    *out = b;
    return sick;
}

/* the middle pin of an odd path: both sides take their share off it */
static inline __attribute__((always_inline)) bits
eliminate_middle(path *p, double epsilon, double limit, bool make, bool forward, const carry *b) {
    bits sick = {0};
    arms a[FW_SIDES];
    update u[FW_SIDES];
    SIDES(s) {
        record *r = RECORD(p, p->half, s);
        a[s] = make ? middle_arms(r, s) : r->arm;
        r->arm = a[s];
        u[s] = from_before(r, &a[s], &b[s]); /* nothing, when no pin is before */
    }
    SIDES(s) {
        record *r = RECORD(p, p->half, s);
        const update *v = &u[s], *o = &u[FW_SIDES - 1 - s];
        pivot t;
        set_pivot(&t, r, &a[s], epsilon);
        t.xx -= v->xx + cross(o->xx), t.xy -= v->xy + cross(o->xy);
        t.yy -= v->yy + cross(o->yy);
        if (forward) {
            set_right(&t, r, &a[s], s, true);
            t.x0 += v->x0 - cross(o->x0), t.x1 += v->x1 - cross(o->x1);
        }
        carry end;
        sick |= close(r, &t, &a[s], &end, limit, forward, false);
    }
    return sick;
}

/* all pivots; with `forward` the right-hand sides are made and reduced on the way. Answers the
   designs in which a pivot is not above `limit`. */
static inline __attribute__((always_inline)) bits eliminate(path *p, double epsilon, double limit,
                                                            bool make, bool forward) {
    bits sick = {0};
    carry b[FW_SIDES];
    SIDES(s) sick |= eliminate_side(p, s, epsilon, limit, make, forward, &b[s]);
    if (p->even) SIDES(s) {
            record *r = RECORD(p, p->half - 1, s);
            sick |= meet(r, &b[s], &b[FW_SIDES - 1 - s], &p->last[s], limit, forward);
        }
    else
        sick |= eliminate_middle(p, epsilon, limit, make, forward, b);
    sick = bits_negative(sick);
#if FW_SIDES == 1
    sick |= __builtin_shufflevector(sick, sick, 1, 0);
#endif
    return sick;
}

static inline __attribute__((always_inline)) void substitute_backward(path *p) {
    SIDES(s) {
        const record *last = RECORD(p, p->records - 1, s);
        real x0 = last->x0, x1 = last->x1;
        for (int i = p->records - 1; i > 0; i--) {
            record *r = RECORD(p, i, s), *b = RECORD(p, i - 1, s);
            real y0 = b->x0 + (r->l0 * x0 + r->l2 * x1);
            x1 = b->x1 + (r->l1 * x0 + r->l3 * x1), x0 = y0;
            b->x0 = x0, b->x1 = x1;
        }
    }
}

/* solves with the factor at hand, in place */
static void solve(path *p) {
    real b0[FW_SIDES], b1[FW_SIDES]; /* reduced right-hand side of the pin before */
    const real nothing = {0};
    SIDES(s) b0[s] = b1[s] = nothing;
    for (int i = 0; i < p->records; i++) {
        bool middle = i == p->half;
        real u0[FW_SIDES], u1[FW_SIDES];
        SIDES(s) {
            const record *r = RECORD(p, i, s);
            u0[s] = i > 0 ? r->l0 * b0[s] + r->l1 * b1[s] : nothing;
            u1[s] = i > 0 ? r->l2 * b0[s] + r->l3 * b1[s] : nothing;
        }
        SIDES(s) {
            record *r = RECORD(p, i, s);
            int o = FW_SIDES - 1 - s;
            b0[s] = r->x0 + (middle ? u0[s] - cross(u0[o]) : u0[s]);
            b1[s] = r->x1 + (middle ? u1[s] - cross(u1[o]) : u1[s]);
            r->x0 = (r->yy * b0[s] - r->xy * b1[s]) * r->inverse;
            r->x1 = (r->xx * b1[s] - r->xy * b0[s]) * r->inverse;
        }
    }
    if (p->even) SIDES(s) {
            record *r = RECORD(p, p->half - 1, s);
            const corner *c = &p->last[s];
            real o0 = cross(b0[FW_SIDES - 1 - s]), o1 = cross(b1[FW_SIDES - 1 - s]);
            real x0 = b0[s] - (c->m0 * o0 + c->m1 * o1), x1 = b1[s] - (c->m2 * o0 + c->m3 * o1);
            r->x0 = (c->yy * x0 - c->xy * x1) * c->inverse;
            r->x1 = (c->xx * x1 - c->xy * x0) * c->inverse;
        }
    substitute_backward(p);
}

/* the factor of the arms at hand, shifted where a pivot is sick; designs without one in *broken */
static bits factor(path *p, bits *broken) {
    bits sick = eliminate(p, 0, p->healthy, false, false);
    *broken = (bits){0};
    if (bits_any(sick)) *broken = eliminate(p, fw_epsilon, DBL_MIN, false, false);
    return sick;
}

/* right-hand side again, proximal iteration with the shifted factor; designs that are not sick keep
   their solution */
static void solve_by_sweeps(path *p, bits sick) {
    const int n = p->records * FW_SIDES;
    real size = {0};
    for (int i = 0; i < n; i++)
        p->keep[4 * i] = p->r[i].x0, p->keep[4 * i + 1] = p->r[i].x1;
    set_rights(p);
    for (int i = 0; i < n; i++) {
        const record *r = &p->r[i];
        p->keep[4 * i + 2] = p->keep[4 * i + 3] = real_of(0);
        size = real_max(size, real_max(real_abs(r->x0), real_abs(r->x1)));
    }
    for (int sweep = 0; sweep < 6; sweep++) {
        real left = {0};
        solve(p);
        for (int i = 0; i < n; i++) {
            record *r = &p->r[i];
            p->keep[4 * i + 2] += r->x0, p->keep[4 * i + 3] += r->x1;
            r->x0 *= fw_epsilon * r->masses, r->x1 *= fw_epsilon * r->masses;
            left = real_max(left, real_max(real_abs(r->x0), real_abs(r->x1)));
        }
        if (sweep > 0 && !bits_any(MASK(left > 1e-14 * size) & sick)) break;
    }
    for (int i = 0; i < n; i++) {
        p->r[i].x0 = real_select(sick, p->keep[4 * i + 2], p->keep[4 * i]);
        p->r[i].x1 = real_select(sick, p->keep[4 * i + 3], p->keep[4 * i + 1]);
    }
}

static __attribute__((noinline)) bits solve_with_care(path *p, bits sick) {
    set_arms(p);
    bits broken = eliminate(p, fw_epsilon, DBL_MIN, false, false) & sick;
    solve_by_sweeps(p, sick);
    return broken;
}

/* ---- results ---- */

typedef struct triple {
    real x, y, phi;
} triple;

/* -M^-1 G^T lambda of the i-th bodies */
static inline __attribute__((always_inline)) triple push_of(const path *p, int i, int side) {
    const record *r = RECORD(p, i, side), *b = r - FW_SIDES;
    if (i == p->records) { /* middle body: inner of both sides */
        const record *o = mate(b, side);
        return (triple){r->minv * (b->x0 + cross(o->x0)), r->minv * (b->x1 + cross(o->x1)),
                        (b->arm.pix * b->x1 - b->arm.piy * b->x0) +
                            cross(o->arm.pix * o->x1 - o->arm.piy * o->x0)};
    }
    triple t = {-(r->minv * r->x0), -(r->minv * r->x1), r->arm.poy * r->x0 - r->arm.pox * r->x1};
    if (i > 0) {
        t.x += r->minv * b->x0;
        t.y += r->minv * b->x1;
        t.phi += b->arm.pix * b->x1 - b->arm.piy * b->x0;
    }
    return t;
}

static inline __attribute__((always_inline)) void scatter(const record *r, double *to, real x,
                                                          real y, real phi) {
#if FW_SIDES == 1
    for (int lane = 0; lane < 2; lane++) {
        if (!r->moves[lane]) continue;
        double *t = to + 3 * r->body[lane];
        t[0] = x[lane], t[1] = y[lane], t[2] = phi[lane];
    }
#else
    if (!r->moves[0]) return;
    real *t = (real *)to + 3 * r->body[0];
    t[0] = x, t[1] = y, t[2] = phi;
#endif
}

/* does this side write the i-th bodies? The middle one is on both */
static inline bool writes(const path *p, int i, int side) {
    return side == 0 || i < p->records;
}

static inline __attribute__((always_inline)) void finish(path *p, bits broken, real power,
                                                         const double *y, double *f) {
    double *a = f + p->nq * DESIGNS;
#if FW_SIDES == 1
    const real rate = {1, 1};
    for (int i = 0; i < p->nq; i++)
        f[i] = y[p->nq + i];
    if (p->dissipates) f[2 * p->nq] = power[0] + power[1];
#else
    const real rate = p->rate, *v = (const real *)y + p->nq;
    for (int i = 0; i < p->nq; i++)
        ((real *)f)[i] = rate * v[i];
    if (p->dissipates) ((real *)f)[2 * p->nq] = rate * power;
#endif
    for (int i = p->first; i < p->bodies; i++)
        SIDES(s) {
            const record *r = RECORD(p, i, s);
            if (!writes(p, i, s)) continue;
            triple t = push_of(p, i, s);
            t = (triple){r->ax + t.x, r->ay + t.y, r->turn + t.phi};
            if (FW_SIDES == 2) t.x *= rate, t.y *= rate, t.phi *= rate;
            scatter(r, a, t.x, t.y, t.phi);
        }
    if (!bits_any(broken)) return;
    for (int i = 0; i < p->nq * DESIGNS; i++)
        if (broken[i % DESIGNS]) a[i] = (double)NAN;
}

/* by the 2 x 2 blocks of S */
static void blocks_rhs(path *p, const double *y, double *f) {
    set_sines(p, y);
    real power = set_accelerations(p, y + p->nq * DESIGNS);
    bits sick = eliminate(p, 0, p->healthy, true, true), broken = {0};
    substitute_backward(p);
    if (bits_any(sick)) broken = solve_with_care(p, sick);
    finish(p, broken, power, y, f);
}

#if FW_SIDES == 2
#include "multibody/kernel_loop.h"
#endif

static void path_rhs(path *p, const double *y, double *f) {
#if FW_SIDES == 2
    if (p->loop) {
        loop_or_blocks(p, y, f);
        return;
    }
#endif
    blocks_rhs(p, y, f);
}

#include "multibody/kernel_path_project.h"

#include "multibody/kernel_path_fill.h"
