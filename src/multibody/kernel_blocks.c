/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel for FW_W designs at once. Compiled for one design (FW_W 1, with baseline instructions)
   and by cmake/rooms.cmake for four and eight, which define

     FW_W          designs, one per lane of a register
     FW_BRIEF      1: shorter sines (maths/lanes.h)
     FW_CORE       name of the row of functions
     FW_CORE_NAME  as users read it

   One evaluation: sines, arms r, S = G M^-1 G^T and right-hand side G M^-1 Q + G' v pin by pin,
   block LDL^T with the forward substitution in the same sweep, backward substitution, a = M^-1 (Q -
   G^T lambda). All loops run over index tables that are read in order. The plain solution stands
   where every pivot block is healthy; otherwise the proximal iteration of block_chain.c is run from
   the start: S + eps D, two to six sweeps. Both solve S lambda = r, with an error of round-off
   times the condition of S; where S is singular the second moves no body along a redundant row. A
   closed loop of few bodies has a shorter form of its own, kernel_loop.h. Source: as system.c and
   block_chain.c. Test: test_kernel.c, test_lanes.c. */
#ifndef FW_W
#define FW_W         1
#define FW_BRIEF     0
#define FW_CORE      fw_multibody_core_single
#define FW_CORE_NAME "portable"
#endif
#include "multibody/kernel.h"
#include "maths/lanes.h"
#include <float.h>
#include <math.h>

#define CONST(member) ((const real *)k->member)
#define WORK(member)  ((real *)k->member)

/* ---- pose ---- */

static __attribute__((noinline)) void sines_of_far(fw_multibody_core *k, const real *u) {
    for (int b = 0; b < k->plan.bodies; b++) {
        real angle = CONST(body)[FW_BODY * b + FW_PHI0] + u[3 * b + 2], *w;
        w = WORK(state) + FW_STATE * b;
        for (int i = 0; i < FW_W; i++)
            if (fabs(LANE(angle, i)) > fw_sincos_range) {
                double s, c;
                sincos(LANE(angle, i), &s, &c);
                LANE(w[FW_S], i) = s, LANE(w[FW_C], i) = c;
            }
    }
}

static void set_sines(fw_multibody_core *k, const real *u) {
    bits outside = {0};
    for (int b = 0; b < k->plan.bodies; b++) {
        real angle = CONST(body)[FW_BODY * b + FW_PHI0] + u[3 * b + 2];
        real *w = WORK(state) + FW_STATE * b;
        outside |= bits_of(fw_sincos_range - real_abs(angle));
        real_sincos(angle, &w[FW_S], &w[FW_C]);
    }
    if (bits_any(bits_negative(outside))) sines_of_far(k, u);
}

/* arms in world axes */
static inline void set_arms(const fw_multibody_core *k, int i, real arm[4]) {
    const int a = k->plan.body[2 * i], b = k->plan.body[2 * i + 1];
    const real *l = CONST(pin) + FW_PIN * i + FW_LOCAL;
    const real *p = CONST(state) + FW_STATE * a, *q = CONST(state) + FW_STATE * b;
    arm[0] = p[FW_C] * l[0] - p[FW_S] * l[1];
    arm[1] = p[FW_S] * l[0] + p[FW_C] * l[1];
    arm[2] = q[FW_C] * l[2] - q[FW_S] * l[3];
    arm[3] = q[FW_S] * l[2] + q[FW_C] * l[3];
}

static void set_pose(fw_multibody_core *k, const real *u) {
    set_sines(k, u);
    for (int i = 0; i < k->plan.pins; i++)
        set_arms(k, i, WORK(row) + FW_ROW * i + FW_ARM);
}

/* ---- S ---- */

static inline void set_diagonal(const fw_multibody_core *k, int i, real *w) {
    const real *a = CONST(body) + FW_BODY * k->plan.body[2 * i];
    const real *b = CONST(body) + FW_BODY * k->plan.body[2 * i + 1];
    const real *r = w + FW_ARM;
    real ax = a[FW_JINV] * r[0], ay = a[FW_JINV] * r[1];
    real bx = b[FW_JINV] * r[2], by = b[FW_JINV] * r[3];
    real mass = CONST(pin)[FW_PIN * i + FW_MASSES];
    w[FW_DIAGONAL] = mass + (ay * r[1] + by * r[3]);
    w[FW_DIAGONAL + 1] = -(ay * r[0] + by * r[2]);
    w[FW_DIAGONAL + 2] = mass + (ax * r[0] + bx * r[2]);
}

static inline void couple(const fw_multibody_core *k, int row_arm, int column_arm, const real *sign,
                          real out[4]) {
    const real *r = CONST(row) + FW_ROW * (row_arm / 2) + 2 * (row_arm % 2);
    const real *s = CONST(row) + FW_ROW * (column_arm / 2) + 2 * (column_arm % 2);
    real m = sign[0], jx = sign[1] * r[0], jy = sign[1] * r[1];
    out[0] = m + jy * s[1];
    out[1] = -(jy * s[0]);
    out[2] = -(jx * s[1]);
    out[3] = m + jx * s[0];
}

static void set_blocks(fw_multibody_core *k) {
    const fw_multibody_kernel_plan *p = &k->plan;
    for (int e = 0; e < p->blocks; e++)
        couple(k, p->arm[2 * e], p->arm[2 * e + 1], CONST(block) + FW_BLOCK * e,
               WORK(coupling) + FW_COUPLING * e + FW_B);
    for (int e = 0; e < p->extras; e++) {
        real more[4], *to = WORK(coupling) + FW_COUPLING * p->extra[3 * e] + FW_B;
        couple(k, p->extra[3 * e + 1], p->extra[3 * e + 2], CONST(extra) + FW_BLOCK * e, more);
        for (int i = 0; i < 4; i++)
            to[i] += more[i];
    }
}

static void set_matrix(fw_multibody_core *k) {
    for (int i = 0; i < k->plan.pins; i++)
        set_diagonal(k, i, WORK(row) + FW_ROW * i);
    set_blocks(k);
}

/* ---- elimination ---- */

/* S + epsilon D = L D L^T; with `forward` the right-hand sides become those of the backward
   substitution. The inverse of the determinant is kept off the longest path of dependent
   operations: B adj B^T is formed while the division runs. Lanes in which a pivot is not above
   `limit` (relative to the masses) are set in the answer; NaN passes and shows in the result. */
FW_INLINE bits eliminate(fw_multibody_core *k, double epsilon, double limit, bool forward) {
    const fw_multibody_kernel_plan *p = &k->plan;
    real *const rows = WORK(row), *const couplings = WORK(coupling);
    bits sick = {0};
    for (int i = 0; i < p->pins; i++) {
        real *w = rows + FW_ROW * i;
        real mass = CONST(pin)[FW_PIN * i + FW_MASSES], shift = epsilon * mass;
        real xx = w[FW_DIAGONAL] + shift, xy = w[FW_DIAGONAL + 1];
        real yy = w[FW_DIAGONAL + 2] + shift;
        real determinant = xx * yy - xy * xy;
        real least =
            limit *
            CONST(pin)[FW_PIN * i + FW_FLOOR]; /* det/trace is below the smaller eigenvalue */
        sick |= bits_of(determinant - least * (xx + yy)) | bits_of(xx - least);
        real inverse = 1.0 / determinant;
        w[FW_PIVOT] = yy * inverse;
        w[FW_PIVOT + 1] = -(xy * inverse);
        w[FW_PIVOT + 2] = xx * inverse;
        real z0 = {0}, z1 = {0};
        if (forward) {
            z0 = yy * w[FW_X] - xy * w[FW_X + 1];
            z1 = xx * w[FW_X + 1] - xy * w[FW_X];
            w[FW_X] = z0 * inverse;
            w[FW_X + 1] = z1 * inverse;
        }
        for (int e = p->column[i]; e < p->column[i + 1]; e++) {
            const real *b = couplings + FW_COUPLING * e + FW_B;
            real *l = couplings + FW_COUPLING * e + FW_L, *to = rows + FW_ROW * p->row[e];
            real t0 = b[0] * yy - b[1] * xy, t1 = b[1] * xx - b[0] * xy;
            real t2 = b[2] * yy - b[3] * xy, t3 = b[3] * xx - b[2] * xy;
            to[FW_DIAGONAL] -= (t0 * b[0] + t1 * b[1]) * inverse;
            to[FW_DIAGONAL + 1] -= (t0 * b[2] + t1 * b[3]) * inverse;
            to[FW_DIAGONAL + 2] -= (t2 * b[2] + t3 * b[3]) * inverse;
            l[0] = t0 * inverse, l[1] = t1 * inverse, l[2] = t2 * inverse, l[3] = t3 * inverse;
            if (forward) {
                to[FW_X] -= (b[0] * z0 + b[1] * z1) * inverse;
                to[FW_X + 1] -= (b[2] * z0 + b[3] * z1) * inverse;
            }
        }
        for (int u = p->first[i]; u < p->first[i + 1]; u++) {
            const fw_multibody_update *n = &p->update[u];
            const real *l = couplings + FW_COUPLING * n->left + FW_L;
            const real *b = couplings + FW_COUPLING * n->right + FW_B;
            real *to = couplings + FW_COUPLING * n->to + FW_B;
            to[0] -= l[0] * b[0] + l[1] * b[1];
            to[1] -= l[0] * b[2] + l[1] * b[3];
            to[2] -= l[2] * b[0] + l[3] * b[1];
            to[3] -= l[2] * b[2] + l[3] * b[3];
        }
    }
    return bits_negative(sick);
}

static void substitute_forward(fw_multibody_core *k) {
    const fw_multibody_kernel_plan *p = &k->plan;
    for (int i = 0; i < p->pins; i++) {
        real *w = WORK(row) + FW_ROW * i;
        real x0 = w[FW_X], x1 = w[FW_X + 1];
        for (int e = p->column[i]; e < p->column[i + 1]; e++) {
            const real *l = CONST(coupling) + FW_COUPLING * e + FW_L;
            real *to = WORK(row) + FW_ROW * p->row[e] + FW_X;
            to[0] -= l[0] * x0 + l[1] * x1;
            to[1] -= l[2] * x0 + l[3] * x1;
        }
        w[FW_X] = w[FW_PIVOT] * x0 + w[FW_PIVOT + 1] * x1;
        w[FW_X + 1] = w[FW_PIVOT + 1] * x0 + w[FW_PIVOT + 2] * x1;
    }
}

static void substitute_backward(fw_multibody_core *k) {
    const fw_multibody_kernel_plan *p = &k->plan;
    for (int i = p->pins - 1; i >= 0; i--) {
        real *w = WORK(row) + FW_ROW * i;
        real x0 = w[FW_X], x1 = w[FW_X + 1];
        for (int e = p->column[i]; e < p->column[i + 1]; e++) {
            const real *l = CONST(coupling) + FW_COUPLING * e + FW_L;
            const real *from = CONST(row) + FW_ROW * p->row[e] + FW_X;
            x0 -= l[0] * from[0] + l[2] * from[1];
            x1 -= l[1] * from[0] + l[3] * from[1];
        }
        w[FW_X] = x0, w[FW_X + 1] = x1;
    }
}

/* to -= M^-1 G^T x; `to` holds triples `stride` apart, the ground's too when it has them */
FW_INLINE void apply(const fw_multibody_core *k, real *to, int stride, bool ground) {
    const fw_multibody_kernel_plan *p = &k->plan;
    for (int i = 0; i < p->pins; i++) {
        const real *w = CONST(row) + FW_ROW * i, *r = w + FW_ARM;
        const int a = p->body[2 * i], b = p->body[2 * i + 1];
        real x = w[FW_X], y = w[FW_X + 1];
        if (ground || a < p->bodies) {
            const real *m = CONST(body) + FW_BODY * a;
            real *t = to + stride * a;
            t[0] -= m[FW_MINV] * x;
            t[1] -= m[FW_MINV] * y;
            t[2] -= m[FW_JINV] * (r[0] * y - r[1] * x);
        }
        if (ground || b < p->bodies) {
            const real *m = CONST(body) + FW_BODY * b;
            real *t = to + stride * b;
            t[0] += m[FW_MINV] * x;
            t[1] += m[FW_MINV] * y;
            t[2] += m[FW_JINV] * (r[2] * y - r[3] * x);
        }
    }
}

/* ---- right-hand side ---- */

/* angles, speeds and accelerations M^-1 Q of every body; the power that is dissipated */
static real set_accelerations(fw_multibody_core *k, const real *u, const real *v) {
    const fw_multibody_kernel_plan *p = &k->plan;
    real *state = WORK(state);
    for (int b = 0; b < p->bodies; b++) {
        const real *c = CONST(body) + FW_BODY * b;
        real *w = state + FW_STATE * b;
        w[FW_PHI] = u[3 * b + 2];
        w[FW_SPEED] = v[3 * b + 2];
        w[FW_A] = c[FW_AX], w[FW_A + 1] = c[FW_AY], w[FW_A + 2] = c[FW_AT];
    }
    for (int i = 0; i < 3; i++) /* the ground, which may have caught a NaN */
        state[FW_STATE * p->bodies + FW_A + i] = real_of(0);
    real power = {0};
    for (int i = 0; i < p->torsions; i++) {
        const int a = p->torsion[2 * i], b = p->torsion[2 * i + 1];
        const real *c = CONST(torsion) + FW_TORSION * i;
        real *wa = state + FW_STATE * a, *wb = state + FW_STATE * b;
        real rate = wb[FW_SPEED] - wa[FW_SPEED], damping = c[1] * rate;
        real torque = (c[2] + c[0] * (wb[FW_PHI] - wa[FW_PHI])) + damping;
        wa[FW_A + 2] += CONST(body)[FW_BODY * a + FW_JINV] * torque;
        wb[FW_A + 2] -= CONST(body)[FW_BODY * b + FW_JINV] * torque;
        power += damping * rate;
    }
    return power;
}

static inline void set_right(const fw_multibody_core *k, int i, real *w) {
    const real *p = CONST(state) + FW_STATE * k->plan.body[2 * i];
    const real *q = CONST(state) + FW_STATE * k->plan.body[2 * i + 1];
    const real *r = w + FW_ARM, *a = p + FW_A, *b = q + FW_A;
    real wp = p[FW_SPEED] * p[FW_SPEED], wq = q[FW_SPEED] * q[FW_SPEED];
    w[FW_X] = ((a[0] - a[2] * r[1]) - wp * r[0]) - ((b[0] - b[2] * r[3]) - wq * r[2]);
    w[FW_X + 1] = ((a[1] + a[2] * r[0]) - wp * r[1]) - ((b[1] + b[2] * r[2]) - wq * r[3]);
}

/* the proximal iteration for the lanes that are sick; the others keep their plain solution. Answers
   the lanes that have no solution at all. */
static __attribute__((noinline)) bits solve_with_care(fw_multibody_core *k, bits sick,
                                                      bool assembled) {
    const fw_multibody_kernel_plan *p = &k->plan;
    real size = {0};
    if (!assembled) set_matrix(k);
    bits broken = assembled ? (bits){0} : eliminate(k, fw_epsilon, DBL_MIN, false);
    for (int i = 0; i < p->pins; i++) {
        real *w = WORK(row) + FW_ROW * i, *keep = WORK(keep) + FW_KEEP * i;
        keep[0] = w[FW_X], keep[1] = w[FW_X + 1];
        keep[2] = keep[3] = real_of(0);
        set_right(k, i, w);
        size = real_max(size, real_max(real_abs(w[FW_X]), real_abs(w[FW_X + 1])));
    }
    for (int sweep = 0; sweep < 6; sweep++) {
        substitute_forward(k);
        substitute_backward(k);
        real residual = {0};
        for (int i = 0; i < p->pins; i++) {
            real *w = WORK(row) + FW_ROW * i, *keep = WORK(keep) + FW_KEEP * i;
            real shift = fw_epsilon * CONST(pin)[FW_PIN * i + FW_MASSES];
            for (int c = 0; c < 2; c++) {
                keep[2 + c] += w[FW_X + c];
                w[FW_X + c] *= shift;
                residual = real_max(residual, real_abs(w[FW_X + c]));
            }
        }
        if (sweep > 0 && !bits_any(MASK(residual > 1e-14 * size) & sick)) break;
    }
    for (int i = 0; i < p->pins; i++) {
        real *w = WORK(row) + FW_ROW * i, *keep = WORK(keep) + FW_KEEP * i;
        w[FW_X] = real_select(sick, keep[2], keep[0]);
        w[FW_X + 1] = real_select(sick, keep[3], keep[1]);
    }
    return broken & sick;
}

/* lambda is known: f = (v, a, power) times the rate of each lane */
static void finish(fw_multibody_core *k, bits broken, real power, const real *y, real *f) {
    const fw_multibody_kernel_plan *p = &k->plan;
    real *state = WORK(state);
    apply(k, state + FW_A, FW_STATE, true);
    const real *v = y + p->nq;
    real *a = f + p->nq, nothing = real_of((double)NAN);
    real rate = CONST(rate)[0];
    for (int b = 0; b < p->bodies; b++)
        for (int c = 0; c < 3; c++) {
            f[3 * b + c] = rate * v[3 * b + c];
            a[3 * b + c] = rate * state[FW_STATE * b + FW_A + c];
        }
    if (p->dissipates) f[2 * p->nq] = rate * power;
    if (bits_any(broken))
        for (int i = 0; i < p->nq; i++)
            a[i] = real_select(broken, nothing, a[i]);
}

static void blocks_rhs(fw_multibody_core *k, const real *y, real *f) {
    const fw_multibody_kernel_plan *p = &k->plan;
    set_sines(k, y);
    real power = set_accelerations(k, y, y + p->nq);
    for (int i = 0; i < p->pins; i++) {
        real *w = WORK(row) + FW_ROW * i;
        set_arms(k, i, w + FW_ARM);
        set_diagonal(k, i, w);
        set_right(k, i, w);
    }
    bits sick = ~(bits){0}, broken = {0};
    if (!k->redundant) {
        set_blocks(k);
        sick = eliminate(k, 0, k->healthy, true);
        substitute_backward(k);
    }
    if (bits_any(sick)) broken = solve_with_care(k, sick, false);
    finish(k, broken, power, y, f);
}

#include "multibody/kernel_loop.h"

static void core_rhs(fw_multibody_core *k, const real *y, real *f) {
    if (k->loop)
        loop_or_blocks(k, y, f);
    else
        blocks_rhs(k, y, f);
}

/* ---- projection ---- */

/* Psi into the rows; the largest |Psi| of any design, and that relative to its size */
static double residual(fw_multibody_core *k, const real *u, double *relative) {
    const fw_multibody_kernel_plan *p = &k->plan;
    static const double still[3 * FW_W] __attribute__((aligned(64))) = {0};
    set_pose(k, u);
    real worst = {0};
    for (int i = 0; i < p->pins; i++) {
        const int a = p->body[2 * i], b = p->body[2 * i + 1];
        real *w = WORK(row) + FW_ROW * i;
        const real *r = w + FW_ARM, *offset = CONST(pin) + FW_PIN * i + FW_OFFSET;
        const real *ua = a < p->bodies ? u + 3 * a : (const real *)still;
        const real *ub = b < p->bodies ? u + 3 * b : (const real *)still;
        w[FW_X] = offset[0] + ua[0] - ub[0] + r[0] - r[2];
        w[FW_X + 1] = offset[1] + ua[1] - ub[1] + r[1] - r[3];
        worst = real_max(worst, w[FW_X] * w[FW_X] + w[FW_X + 1] * w[FW_X + 1]);
    }
    real size = CONST(size)[0];
    *relative = sqrt(real_most(worst / (size * size)));
    return sqrt(real_most(worst));
}

/* the factor of this pose, the shifted one where a pivot is small; lanes without one in *broken */
static bits factor(fw_multibody_core *k, bits *broken) {
    bits sick = ~(bits){0};
    if (!k->redundant) {
        set_matrix(k);
        sick = eliminate(k, 0, k->healthy, false);
    }
    *broken = (bits){0};
    if (bits_any(sick)) {
        set_matrix(k);
        *broken = eliminate(k, fw_epsilon, DBL_MIN, false);
    }
    return sick;
}

/* u -= M^-1 G^T (S + eps D)^-1 Psi until round-off; see system.c */
static bool project_position(fw_multibody_core *k, real *u, double *norm) {
    double before = (double)INFINITY, relative = 0;
    bits broken;
    for (int i = 0; i < 20; i++) {
        *norm = residual(k, u, &relative);
        if (!(*norm < (double)INFINITY)) return false;
        bool slow = relative > 0.25 * before;
        if (relative <= 2 * DBL_EPSILON || (slow && relative <= 1e-13 && *norm <= 1e-12)) break;
        /* the loop's right-hand side leaves no factor of the blocks */
        if (slow || i == 4 || (i == 0 && k->loop)) {
            factor(k, &broken);
            if (bits_any(broken)) return false;
        }
        before = relative;
        substitute_forward(k);
        substitute_backward(k);
        apply(k, u, 3, false);
    }
    return *norm <= 1e-12;
}

/* v -= M^-1 G^T S^-1 G v with the factor of the pose */
static bool project_velocity(fw_multibody_core *k, real *v, double *norm) {
    const fw_multibody_kernel_plan *p = &k->plan;
    static const double still[3 * FW_W] __attribute__((aligned(64))) = {0};
    real size = real_of(DBL_MIN);
    double before = (double)INFINITY;
    for (int i = 0; i < p->nq; i++)
        size = real_max(size, real_abs(v[i]));
    for (int sweep = 0; sweep < 6; sweep++) {
        real worst = {0};
        for (int i = 0; i < p->pins; i++) {
            const int a = p->body[2 * i], b = p->body[2 * i + 1];
            real *w = WORK(row) + FW_ROW * i;
            const real *r = w + FW_ARM;
            const real *va = a < p->bodies ? v + 3 * a : (const real *)still;
            const real *vb = b < p->bodies ? v + 3 * b : (const real *)still;
            w[FW_X] = va[0] - va[2] * r[1] - vb[0] + vb[2] * r[3];
            w[FW_X + 1] = va[1] + va[2] * r[0] - vb[1] - vb[2] * r[2];
            worst = real_max(worst, real_max(real_abs(w[FW_X]), real_abs(w[FW_X + 1])));
        }
        *norm = real_most(worst);
        double relative = real_most(worst / size);
        if (relative <= 2 * DBL_EPSILON || relative > 0.25 * before) break;
        before = relative;
        substitute_forward(k);
        substitute_backward(k);
        apply(k, v, 3, false);
    }
    return *norm < (double)INFINITY;
}

/* position, velocity, then f with the same factor */
static bool core_project(fw_multibody_core *k, double *at, double *slope) {
    const fw_multibody_kernel_plan *p = &k->plan;
    real *y = (real *)at;
    double position, velocity;
    bits broken, sick;
    if (!project_position(k, y, &position)) return false;
    sick = factor(k, &broken);
    if (bits_any(broken) || !project_velocity(k, y + p->nq, &velocity)) return false;
    k->norms = (fw_multibody_kernel_norms){position, velocity};
    real power = set_accelerations(k, y, y + p->nq);
    if (bits_any(sick)) {
        solve_with_care(k, ~(bits){0}, true);
    } else {
        for (int i = 0; i < p->pins; i++)
            set_right(k, i, WORK(row) + FW_ROW * i);
        substitute_forward(k);
        substitute_backward(k);
    }
    finish(k, broken, power, y, (real *)slope);
    return true;
}

/* leaves no upper halves behind: baseline code that runs next would wait for them */
#if defined(__AVX__)
#define END_OF_VECTORS() __builtin_ia32_vzeroupper()
#else
#define END_OF_VECTORS() ((void)0)
#endif

static void rhs(fw_multibody_core *k, const double *y, double *f) {
    core_rhs(k, (const real *)y, (real *)f);
    END_OF_VECTORS();
}
static bool project(fw_multibody_core *k, double *y, double *f) {
    bool good = core_project(k, y, f);
    END_OF_VECTORS();
    return good;
}
static bool core_singular(fw_multibody_core *k, const double *u) {
    set_pose(k, (const real *)u);
    set_matrix(k);
    return bits_any(eliminate(k, 0, k->healthy, false));
}

const fw_multibody_core_ops FW_CORE = {FW_CORE_NAME, FW_W,     rhs,      core_singular,
                                       project,      loop_new, loop_fill};

#if FW_W == 1
void fw_multibody_kernel_sincos(double angle_rad, double *sine, double *cosine) {
    real_sincos(angle_rad, sine, cosine);
    if (!(fabs(angle_rad) <= fw_sincos_range)) sincos(angle_rad, sine, cosine);
}
#endif
