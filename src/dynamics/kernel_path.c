/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel of a path: bodies in a row, each pinned to the next, the ends free or on the ground -
   every chain, and the single loop of a six-bar. The elimination starts from both ends at once, one
   end in each lane of a register, and meets in the middle.

   Record i holds the i-th bodies from both ends and the i-th pins from both ends. In its lane a pin
   reads Psi = x_outer - x_inner, outer being the side of its own end; both lanes then do the same.
   With an even number of pins they meet in a body: the last pivot of either lane is updated by the
   other lane's (both Schur complements at once, no substitution between the two). With an odd
   number they meet in a pin, which both lanes hold with opposite signs. Ground: 1/m = 1/J = 0.
   Methods, errors and sources as in kernel_core.h. Test: test_kernel.c. */
#define FW_W 2
#include "dynamics/kernel_plan.h"
#include "dynamics/kernel_sincos.h"
#include <float.h>
#include <math.h>

typedef struct record {
    /* constants: bodies, then pins */
    real minv, jinv, ax, ay, at, phi0;
    real outer_x, outer_y, inner_x, inner_y; /* local arms */
    real masses, k, c, torque0, offset_x, offset_y;
    bits moves; /* 0 in the lane of a ground */
    int body[2], pin[2];
    double sign[2]; /* of the multiplier in the model */
    /* work: bodies */
    real cosine, sine, phi, w, a0, a1, a2;
    /* pins: arms at this pose and divided by J, pivot block and 1/determinant, L to the pin before,
       solution */
    real rox, roy, rix, riy, pox, poy, pix, piy;
    real xx, xy, yy, inverse, l0, l1, l2, l3, x0, x1;
} record;

struct fw_path {
    int pins, records, half; /* records of pins; those before the middle */
    int first;               /* 1: both ends on the ground, record 0 never turns */
    bool even, dissipates;
    int nq;
    record *r; /* (records + 1): the last one is the middle body of an even path, in both lanes */
    /* the last pivot of an even path: M adj(other)/det(other), and the pivot after the update */
    real m0, m1, m2, m3, last_xx, last_xy, last_yy, last_inverse;
    double size, healthy;
    real *keep; /* (4 records) */
    fw_kernel_norms norms;
};

static inline real swap(real a) {
    return __builtin_shufflevector(a, a, 1, 0);
}
static inline real gather(const record *r, const double *y, int c) {
    real both = {y[3 * r->body[0] + c], y[3 * r->body[1] + c]};
    return (real)((bits)both & r->moves);
}
/* the inner body of record i is the outer one of the next */
static inline int bodies(const fw_path *p) {
    return p->records + (p->even ? 1 : 0);
}

/* ---- pose and arms ---- */

static void set_sines(fw_path *p, const double *u) {
    bits outside = {0};
    for (int i = p->first; i < bodies(p); i++) {
        record *r = &p->r[i];
        r->phi = gather(r, u, 2);
        real angle = r->phi0 + r->phi;
        outside |= bits_of(fw_sincos_range - real_abs(angle));
        real_sincos(angle, &r->sine, &r->cosine);
    }
    if (!bits_any(bits_negative(outside))) return;
    for (int i = p->first; i < bodies(p); i++)
        for (int lane = 0; lane < 2; lane++) {
            double angle = p->r[i].phi0[lane] + p->r[i].phi[lane], s, c;
            if (!(fabs(angle) > fw_sincos_range)) continue;
            sincos(angle, &s, &c);
            p->r[i].sine[lane] = s, p->r[i].cosine[lane] = c;
        }
}

static inline __attribute__((always_inline)) void set_arms(fw_path *p, int i, bool middle) {
    record *r = &p->r[i], *n = r + 1;
    r->rox = r->cosine * r->outer_x - r->sine * r->outer_y;
    r->roy = r->sine * r->outer_x + r->cosine * r->outer_y;
    r->pox = r->jinv * r->rox;
    r->poy = r->jinv * r->roy;
    if (middle) {
        r->rix = swap(r->rox), r->riy = swap(r->roy);
        r->pix = swap(r->pox), r->piy = swap(r->poy);
        return;
    }
    r->rix = n->cosine * r->inner_x - n->sine * r->inner_y;
    r->riy = n->sine * r->inner_x + n->cosine * r->inner_y;
    r->pix = n->jinv * r->rix;
    r->piy = n->jinv * r->riy;
}

static void set_pose(fw_path *p, const double *u) {
    set_sines(p, u);
    for (int i = 0; i < p->half; i++)
        set_arms(p, i, false);
    if (!p->even) set_arms(p, p->half, true);
}

/* ---- S and right-hand side ---- */

static inline __attribute__((always_inline)) void set_pivot(record *r, double epsilon) {
    real mass = r->masses;
    if (epsilon > 0) mass += epsilon * r->masses;
    r->xx = mass + (r->poy * r->roy + r->piy * r->riy);
    r->xy = -(r->poy * r->rox + r->piy * r->rix);
    r->yy = mass + (r->pox * r->rox + r->pix * r->rix);
}

static inline __attribute__((always_inline)) void set_right(record *r, bool middle) {
    const record *n = r + 1;
    real wo = r->w * r->w, wi = middle ? swap(wo) : n->w * n->w;
    real a0 = middle ? swap(r->a0) : n->a0, a1 = middle ? swap(r->a1) : n->a1;
    real a2 = middle ? swap(r->a2) : n->a2;
    r->x0 = ((r->a0 - r->a2 * r->roy) - wo * r->rox) - ((a0 - a2 * r->riy) - wi * r->rix);
    r->x1 = ((r->a1 + r->a2 * r->rox) - wo * r->roy) - ((a1 + a2 * r->rix) - wi * r->riy);
}

/* M^-1 Q of all bodies; the power dissipated */
static double set_accelerations(fw_path *p, const double *v) {
    real power = {0}, before = {0};
    for (int i = p->first; i < bodies(p); i++)
        p->r[i].w = gather(&p->r[i], v, 2);
    for (int i = 0; i < p->half; i++) {
        record *r = &p->r[i], *n = r + 1;
        real rate = n->w - r->w, damping = r->c * rate;
        real torque = (r->torque0 + r->k * (n->phi - r->phi)) + damping;
        r->a0 = r->ax, r->a1 = r->ay;
        r->a2 = r->at + r->jinv * (torque - before);
        before = torque;
        power += damping * rate;
    }
    record *r = &p->r[p->half];
    r->a0 = r->ax, r->a1 = r->ay;
    if (p->even) {
        r->a2 = r->at - r->jinv * (before + swap(before));
        return power[0] + power[1];
    }
    real rate = swap(r->w) - r->w, damping = r->c * rate;
    real torque = (r->torque0 + r->k * (swap(r->phi) - r->phi)) + damping;
    r->a2 = r->at + r->jinv * (torque - before);
    return power[0] + power[1] + damping[0] * rate[0];
}

/* ---- elimination ---- */

/* B adj B^T / det into the pivot, B z / det into the right-hand side, L = B adj / det */
typedef struct coupling {
    real b0, b1, b2, b3;
} coupling;

static inline __attribute__((always_inline)) coupling couple(real minv, real px, real py, real rx,
                                                             real ry) {
    return (coupling){minv + py * ry, -(py * rx), -(px * ry), minv + px * rx};
}

typedef struct update { /* what one pin takes off the next: of the pivot, of the right-hand side */
    real xx, xy, yy, x0, x1, l0, l1, l2, l3;
} update;

static inline __attribute__((always_inline)) update take(coupling b, real xx, real xy, real yy,
                                                         real inverse, real z0, real z1) {
    real t0 = b.b0 * yy - b.b1 * xy, t1 = b.b1 * xx - b.b0 * xy;
    real t2 = b.b2 * yy - b.b3 * xy, t3 = b.b3 * xx - b.b2 * xy;
    return (update){(t0 * b.b0 + t1 * b.b1) * inverse,
                    (t0 * b.b2 + t1 * b.b3) * inverse,
                    (t2 * b.b2 + t3 * b.b3) * inverse,
                    (b.b0 * z0 + b.b1 * z1) * inverse,
                    (b.b2 * z0 + b.b3 * z1) * inverse,
                    t0 * inverse,
                    t1 * inverse,
                    t2 * inverse,
                    t3 * inverse};
}

/* negative: the pivot is not above the limit; NaN passes and shows in the result */
static inline __attribute__((always_inline)) bits check(real determinant, real xx, real yy,
                                                        real masses, double limit) {
    real least = limit * masses; /* det/trace is below the smaller eigenvalue */
    return bits_of(determinant - least * (xx + yy)) | bits_of(xx - least);
}

typedef struct carry { /* the pin before, in registers: pivot, reduced right-hand side, inner arm */
    real xx, xy, yy, inverse, z0, z1, rix, riy;
} carry;

static inline __attribute__((always_inline)) update take_from(const carry *b, coupling c) {
    return take(c, b->xx, b->xy, b->yy, b->inverse, b->z0, b->z1);
}

/* the last pivots of an even path: each lane's is updated by the other's */
static inline __attribute__((always_inline)) bits meet(fw_path *p, record *r, const carry *b,
                                                       double limit, bool forward) {
    const carry o = {swap(b->xx), swap(b->xy), swap(b->yy),  swap(b->inverse),
                     swap(b->z0), swap(b->z1), swap(b->rix), swap(b->riy)};
    update u = take_from(&o, couple(r[1].minv, r->pix, r->piy, o.rix, o.riy));
    real xx = b->xx - u.xx, xy = b->xy - u.xy, yy = b->yy - u.yy;
    real determinant = xx * yy - xy * xy, inverse = 1.0 / determinant;
    p->m0 = u.l0, p->m1 = u.l1, p->m2 = u.l2, p->m3 = u.l3;
    p->last_xx = xx, p->last_xy = xy, p->last_yy = yy, p->last_inverse = inverse;
    if (forward) {
        real x0 = r->x0 - u.x0, x1 = r->x1 - u.x1;
        r->x0 = (yy * x0 - xy * x1) * inverse;
        r->x1 = (xx * x1 - xy * x0) * inverse;
    }
    return check(determinant, xx, yy, r->masses, limit);
}

/* all pivots from the arms; with `forward` the right-hand sides are made and reduced on the way.
   Answers whether a pivot is not above `limit`. */
static inline __attribute__((always_inline)) bool eliminate(fw_path *p, double epsilon,
                                                            double limit, bool arms, bool forward) {
    bits sick = {0};
    carry b = {0};
    for (int i = 0; i < p->records; i++) {
        record *r = &p->r[i];
        bool middle = i == p->half;
        if (arms) set_arms(p, i, middle);
        set_pivot(r, epsilon);
        if (forward) set_right(r, middle);
        real xx = r->xx, xy = r->xy, yy = r->yy, x0 = r->x0, x1 = r->x1;
        if (i > 0) {
            /* of -B, since the bodies of the two pins differ in sign */
            update u = take_from(&b, couple(r->minv, r->pox, r->poy, b.rix, b.riy));
            r->l0 = u.l0, r->l1 = u.l1, r->l2 = u.l2, r->l3 = u.l3;
            if (middle) { /* both lanes take their share off the same pin */
                u.xx += swap(u.xx), u.xy += swap(u.xy), u.yy += swap(u.yy);
                u.x0 -= swap(u.x0), u.x1 -= swap(u.x1);
            }
            xx -= u.xx, xy -= u.xy, yy -= u.yy;
            x0 += u.x0, x1 += u.x1;
        }
        real determinant = xx * yy - xy * xy;
        sick |= check(determinant, xx, yy, r->masses, limit);
        b = (carry){xx,     xy,    yy, 1.0 / determinant, yy * x0 - xy * x1, xx * x1 - xy * x0,
                    r->rix, r->riy};
        r->xx = xx, r->xy = xy, r->yy = yy, r->inverse = b.inverse;
        if (!forward) continue;
        bool last = p->even && i + 1 == p->records;
        r->x0 = last ? x0 : b.z0 * b.inverse;
        r->x1 = last ? x1 : b.z1 * b.inverse;
    }
    if (p->even) sick |= meet(p, &p->r[p->half - 1], &b, limit, forward);
    return bits_any(bits_negative(sick));
}

static inline void substitute_backward(fw_path *p) {
    const record *last = &p->r[p->records - 1];
    real x0 = last->x0, x1 = last->x1;
    for (int i = p->records - 1; i > 0; i--) {
        record *r = &p->r[i], *b = r - 1;
        real y0 = b->x0 + (r->l0 * x0 + r->l2 * x1);
        x1 = b->x1 + (r->l1 * x0 + r->l3 * x1), x0 = y0;
        b->x0 = x0, b->x1 = x1;
    }
}

/* solves with the factor at hand, in place */
static void solve(fw_path *p) {
    real b0 = {0}, b1 = {0}; /* reduced right-hand side of the pin before */
    for (int i = 0; i < p->records; i++) {
        record *r = &p->r[i];
        real x0 = r->x0, x1 = r->x1;
        if (i > 0) {
            real u0 = r->l0 * b0 + r->l1 * b1, u1 = r->l2 * b0 + r->l3 * b1;
            bool middle = i == p->half;
            x0 += middle ? u0 - swap(u0) : u0;
            x1 += middle ? u1 - swap(u1) : u1;
        }
        b0 = x0, b1 = x1;
        if (p->even && i + 1 == p->records) {
            real s0 = swap(b0), s1 = swap(b1);
            x0 -= p->m0 * s0 + p->m1 * s1;
            x1 -= p->m2 * s0 + p->m3 * s1;
            r->x0 = (p->last_yy * x0 - p->last_xy * x1) * p->last_inverse;
            r->x1 = (p->last_xx * x1 - p->last_xy * x0) * p->last_inverse;
        } else {
            r->x0 = (r->yy * x0 - r->xy * x1) * r->inverse;
            r->x1 = (r->xx * x1 - r->xy * x0) * r->inverse;
        }
    }
    substitute_backward(p);
}

/* the factor of the arms at hand: 0 plain, 1 shifted, -1 none */
static int factor(fw_path *p) {
    if (!eliminate(p, 0, p->healthy, false, false)) return 0;
    return eliminate(p, fw_epsilon, DBL_MIN, false, false) ? -1 : 1;
}

/* right-hand side again, proximal iteration with the shifted factor */
static void solve_by_sweeps(fw_path *p) {
    real size = {0};
    for (int i = 0; i < p->records; i++) {
        record *r = &p->r[i];
        set_right(r, i == p->half);
        p->keep[2 * i] = p->keep[2 * i + 1] = real_of(0);
        size = real_max(size, real_max(real_abs(r->x0), real_abs(r->x1)));
    }
    for (int sweep = 0; sweep < 6; sweep++) {
        real left = {0};
        solve(p);
        for (int i = 0; i < p->records; i++) {
            record *r = &p->r[i];
            p->keep[2 * i] += r->x0, p->keep[2 * i + 1] += r->x1;
            r->x0 *= fw_epsilon * r->masses, r->x1 *= fw_epsilon * r->masses;
            left = real_max(left, real_max(real_abs(r->x0), real_abs(r->x1)));
        }
        if (sweep > 0 && !(real_most(left) > 1e-14 * real_most(size))) break;
    }
    for (int i = 0; i < p->records; i++)
        p->r[i].x0 = p->keep[2 * i], p->r[i].x1 = p->keep[2 * i + 1];
}

static __attribute__((noinline)) bool solve_with_care(fw_path *p) {
    bool broken = eliminate(p, fw_epsilon, DBL_MIN, false, false);
    solve_by_sweeps(p);
    return !broken;
}

/* ---- results ---- */

typedef struct triple {
    real x, y, phi;
} triple;

/* -M^-1 G^T lambda of the i-th bodies */
static inline triple push_of(const fw_path *p, int i) {
    const record *r = &p->r[i], *b = r - 1;
    if (i == p->records) { /* middle body: inner of both lanes */
        real x = b->x0, y = b->x1, turn = b->pix * y - b->piy * x;
        return (triple){r->minv * (x + swap(x)), r->minv * (y + swap(y)), turn + swap(turn)};
    }
    triple t = {-(r->minv * r->x0), -(r->minv * r->x1), r->poy * r->x0 - r->pox * r->x1};
    if (i > 0) {
        t.x += r->minv * b->x0;
        t.y += r->minv * b->x1;
        t.phi += b->pix * b->x1 - b->piy * b->x0;
    }
    return t;
}

static inline void scatter(const record *r, double *to, real x, real y, real phi) {
    for (int lane = 0; lane < 2; lane++) {
        if (!r->moves[lane]) continue;
        double *t = to + 3 * r->body[lane];
        t[0] = x[lane], t[1] = y[lane], t[2] = phi[lane];
    }
}

static void finish(fw_path *p, bool good, double power, const double *y, double *f) {
    const double *v = y + p->nq;
    double *a = f + p->nq;
    for (int i = p->first; i < bodies(p); i++) {
        const record *r = &p->r[i];
        triple t = push_of(p, i);
        scatter(r, a, r->a0 + t.x, r->a1 + t.y, r->a2 + t.phi);
    }
    for (int i = 0; i < p->nq; i++)
        f[i] = v[i];
    for (int i = 0; i < p->nq && !good; i++)
        a[i] = (double)NAN;
    if (p->dissipates) f[2 * p->nq] = power;
}

void fw_path_rhs(fw_path *p, const double *y, double *f) {
    set_sines(p, y);
    double power = set_accelerations(p, y + p->nq);
    bool good = true;
    if (eliminate(p, 0, p->healthy, true, true))
        good = solve_with_care(p);
    else
        substitute_backward(p);
    finish(p, good, power, y, f);
}

void fw_path_lambda(const fw_path *p, double *lambda) {
    for (int i = 0; i < p->records; i++)
        for (int lane = 0; lane < 2; lane++) {
            const record *r = &p->r[i];
            lambda[2 * r->pin[lane]] = r->sign[lane] * r->x0[lane];
            lambda[2 * r->pin[lane] + 1] = r->sign[lane] * r->x1[lane];
        }
}

void fw_path_set_healthy(fw_path *p, double relative) {
    p->healthy = relative;
}

fw_kernel_norms fw_path_norms(const fw_path *p) {
    return p->norms;
}

/* ---- projection: as in kernel_core.h ---- */

static double residual(fw_path *p, const double *u) {
    real worst = {0};
    set_pose(p, u);
    for (int i = 0; i < p->records; i++) {
        record *r = &p->r[i];
        bool middle = i == p->half;
        real ox = gather(r, u, 0), oy = gather(r, u, 1);
        real ix = middle ? swap(ox) : gather(r + 1, u, 0);
        real iy = middle ? swap(oy) : gather(r + 1, u, 1);
        r->x0 = r->offset_x + ox - ix + r->rox - r->rix;
        r->x1 = r->offset_y + oy - iy + r->roy - r->riy;
        worst = real_max(worst, r->x0 * r->x0 + r->x1 * r->x1);
    }
    return sqrt(real_most(worst));
}

static void move(fw_path *p, double *to) {
    for (int i = p->first; i < bodies(p); i++) {
        const record *r = &p->r[i];
        triple t = push_of(p, i);
        real x = gather(r, to, 0), y = gather(r, to, 1), phi = gather(r, to, 2);
        scatter(r, to, x + t.x, y + t.y, phi + t.phi);
    }
}

static bool project_position(fw_path *p, double *u, double *norm) {
    double before = (double)INFINITY;
    for (int i = 0; i < 20; i++) {
        *norm = residual(p, u);
        if (!(*norm < (double)INFINITY)) return false;
        bool slow = *norm > 0.25 * before;
        if (*norm <= 2 * DBL_EPSILON * p->size || (slow && *norm <= fmin(1e-13 * p->size, 1e-12)))
            break;
        if ((slow || i == 4) && factor(p) < 0) return false;
        before = *norm;
        solve(p);
        move(p, u);
    }
    return *norm <= 1e-12;
}

static bool project_velocity(fw_path *p, double *v, double *norm) {
    double before = (double)INFINITY, size = DBL_MIN;
    for (int i = 0; i < p->nq; i++)
        size = fmax(size, fabs(v[i]));
    for (int sweep = 0; sweep < 6; sweep++) {
        real worst = {0};
        for (int i = 0; i < p->records; i++) {
            record *r = &p->r[i];
            bool middle = i == p->half;
            real ox = gather(r, v, 0), oy = gather(r, v, 1), ow = gather(r, v, 2);
            real ix = middle ? swap(ox) : gather(r + 1, v, 0);
            real iy = middle ? swap(oy) : gather(r + 1, v, 1);
            real iw = middle ? swap(ow) : gather(r + 1, v, 2);
            r->x0 = (ox - ow * r->roy) - (ix - iw * r->riy);
            r->x1 = (oy + ow * r->rox) - (iy + iw * r->rix);
            worst = real_max(worst, real_max(real_abs(r->x0), real_abs(r->x1)));
        }
        *norm = real_most(worst);
        if (*norm <= 2 * DBL_EPSILON * size || *norm > 0.25 * before) break;
        before = *norm;
        solve(p);
        move(p, v);
    }
    return *norm < (double)INFINITY;
}

bool fw_path_project(fw_path *p, double *y, double *f) {
    double position, velocity;
    if (!project_position(p, y, &position)) return false;
    int kind = factor(p);
    if (kind < 0 || !project_velocity(p, y + p->nq, &velocity)) return false;
    p->norms = (fw_kernel_norms){position, velocity};
    double power = set_accelerations(p, y + p->nq);
    if (kind > 0) {
        solve_by_sweeps(p);
    } else {
        for (int i = 0; i < p->records; i++)
            set_right(&p->r[i], i == p->half);
        solve(p);
    }
    finish(p, true, power, y, f);
    return true;
}

/* ---- the path of a model ---- */

typedef struct trail {
    int *pin, *body; /* pins in a row; bodies around them, one more */
    int count;
} trail;

static int other_pin(const int *pins_of, int body, int pin) {
    return pins_of[2 * body] == pin ? pins_of[2 * body + 1] : pins_of[2 * body];
}

/* follows the bodies from one end; false when that does not reach every pin and body once */
static bool follow(const fw_model *m, const int *pins_of, int start, int end, trail *t) {
    int moving = end == m->nbody ? 0 : 1, pin = start, body = end;
    t->count = 0;
    t->body[0] = body;
    while (pin >= 0 && t->count < m->nblock) {
        body = m->body[2 * pin] == body ? m->body[2 * pin + 1] : m->body[2 * pin];
        t->pin[t->count++] = pin;
        t->body[t->count] = body;
        if (body == m->nbody) break;
        moving++;
        pin = other_pin(pins_of, body, pin);
    }
    return t->count == m->nblock && moving == m->nbody;
}

static fw_status find_trail(fw_arena *arena, const fw_model *m, trail *t, bool *found) {
    int *pins_of;
    *found = false;
    FW_NEED(pins_of = fw_arena_array(arena, int, 2 * (size_t)m->nbody));
    FW_NEED(t->pin = fw_arena_array(arena, int, (size_t)m->nblock));
    FW_NEED(t->body = fw_arena_array(arena, int, (size_t)m->nblock + 1));
    for (int i = 0; i < 2 * m->nbody; i++)
        pins_of[i] = -1;
    for (int i = 0; i < 2 * m->nblock; i++) {
        int b = m->body[i];
        if (b == m->nbody) continue;
        if (pins_of[2 * b + 1] >= 0) return FW_OK; /* a branch */
        pins_of[2 * b + (pins_of[2 * b] >= 0)] = i / 2;
    }
    for (int i = 0; i < 2 * m->nblock && !*found; i++) {
        int b = m->body[i];
        if (b == m->nbody || pins_of[2 * b + 1] < 0) *found = follow(m, pins_of, i / 2, b, t);
        if (*found) return FW_OK;
    }
    return FW_OK;
}

static void fill_body(const fw_model *m, record *r, int lane, int body) {
    bool ground = body == m->nbody;
    r->body[lane] = ground ? 0 : body;
    r->moves[lane] = ground ? 0 : -1;
    r->cosine[lane] = 1;
    if (ground) return;
    r->minv[lane] = m->minv[body], r->jinv[lane] = m->jinv[body];
    r->ax[lane] = m->constant[3 * body], r->ay[lane] = m->constant[3 * body + 1];
    r->at[lane] = m->constant[3 * body + 2];
    r->phi0[lane] = m->origin[3 * body + 2];
}

static void fill_pin(const fw_model *m, record *r, int lane, int pin, int outer) {
    bool same = m->body[2 * pin] == outer;
    const double *l = m->local + 4 * pin;
    double sign = same ? 1 : -1;
    r->pin[lane] = pin, r->sign[lane] = sign;
    r->outer_x[lane] = l[same ? 0 : 2], r->outer_y[lane] = l[same ? 1 : 3];
    r->inner_x[lane] = l[same ? 2 : 0], r->inner_y[lane] = l[same ? 3 : 1];
    r->masses[lane] = m->minv[m->body[2 * pin]] + m->minv[m->body[2 * pin + 1]];
    r->offset_x[lane] = sign * m->offset[2 * pin];
    r->offset_y[lane] = sign * m->offset[2 * pin + 1];
}

/* a spring across pin number `at` of the trail, in the lanes that hold the pin */
static void add_torsion(fw_path *p, const trail *t, const fw_model_torsion *s, int at) {
    for (int lane = 0; lane < 2; lane++) {
        int i = lane ? p->pins - 1 - at : at;
        if (i >= p->records) continue;
        record *r = &p->r[i];
        int outer = t->body[lane ? at + 1 : at];
        r->k[lane] += s->k, r->c[lane] += s->c;
        r->torque0[lane] += (s->a == outer ? 1 : -1) * s->k * s->angle0;
    }
}

static bool add_torsions(fw_path *p, const fw_model *m, const trail *t, const int *place) {
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_model_torsion *s = &m->torsion[i];
        int inner = s->a == m->nbody ? s->b : s->a, outer = s->a == m->nbody ? s->a : s->b, at = -1;
        if (inner == m->nbody) return false;
        for (int k = place[inner] - 1; k <= place[inner]; k++) /* pins beside this body */
            if (k >= 0 && k < p->pins && (t->body[k] == outer || t->body[k + 1] == outer)) at = k;
        if (at < 0) return false;
        add_torsion(p, t, s, at);
    }
    return true;
}

fw_status fw_path_new(fw_arena *arena, const fw_model *m, fw_path **path) {
    trail t;
    bool found;
    int *place;
    *path = NULL;
    FW_TRY(find_trail(arena, m, &t, &found));
    if (!found) return FW_OK;
    fw_path *p = fw_arena_one(arena, fw_path);
    FW_NEED(p);
    int n = t.count;
    p->pins = n, p->half = n / 2, p->even = n % 2 == 0, p->records = n - n / 2;
    p->nq = m->nq, p->dissipates = m->dissipated >= 0, p->size = m->size, p->healthy = fw_healthy;
    p->first = t.body[0] == m->nbody && t.body[n] == m->nbody && n > 1 ? 1 : 0;
    FW_NEED(p->r = fw_arena_array(arena, record, (size_t)p->records + 1));
    FW_NEED(p->keep = fw_arena_array(arena, real, 2 * (size_t)p->records));
    FW_NEED(place = fw_arena_array(arena, int, (size_t)m->nbody + 1));
    for (int i = 0; i <= n; i++)
        place[t.body[i]] = i;
    for (int i = 0; i < p->records + (p->even ? 1 : 0); i++)
        for (int lane = 0; lane < 2; lane++)
            fill_body(m, &p->r[i], lane, t.body[lane ? n - i : i]);
    for (int i = 0; i < p->records; i++) {
        fill_pin(m, &p->r[i], 0, t.pin[i], t.body[i]);
        fill_pin(m, &p->r[i], 1, t.pin[n - 1 - i], t.body[n - i]);
    }
    if (add_torsions(p, m, &t, place)) *path = p;
    return FW_OK;
}
