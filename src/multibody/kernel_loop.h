/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Part of kernel_blocks.c: the right-hand side of one closed loop of 3 to 6 bodies, both ends on
   the ground, by cutting it at a pin in the middle into two open chains.

   In an open chain the angular accelerations alpha are minimal coordinates. With T_k from a body's
   pin on the ground's side to its pin on the cut's side, C_k from the first to the centre of mass,
   G_k = m_k C_k + (mass beyond k) T_k, and squared speeds w_k^2, all arms in world axes:
     M_jk = T_j . G_k for j < k,   M_kk = J_k + m_k C_k^2 + (mass beyond k) T_k^2, a constant
     b_j += w_k^2 T_j x G_k,       b_k -= w_j^2 T_j x G_k,      b_k += torques + forces' moments
     M alpha = b + T^perp F,       F the force in the cut, -F on the other chain
   and the accelerations of the two tips are equal: a 2 x 2 system for F. The unknowns left over are
   exactly those of S lambda = r, in which all pins but the cut one are solved beforehand; the pose
   need not fulfil the constraints, since only angles enter. M = L D L^T begins at the tip, whose
   pivot is a constant: four divisions for the six-bar instead of eight, three of which wait for one
   another, and half the instructions of the 2 x 2 blocks.

   Units and signs of y and f as in kernel.h, of the joint forces as in the records. Valid where
   every pivot of M keeps 1e-4 of its diagonal and the 2 x 2 pivot is 100 times above the limit of
   the blocks; other lanes, and angles beyond fw_sincos_range, take the blocks. Error of the
   accelerations, of the largest that a joint force gives to the lightest body: 4e-16 at worst for
   masses alike, 3e-12 for masses over four decades; in the median a fifth of the blocks' or less.
   Cost for 5 bodies: 412 arithmetic operations, brief sines included. Source: Wittenburg, Dynamics
   of Multibody Systems, 2nd ed., ch. 5 (augmented bodies, cut joints). Test: test_kernel.c,
   test_lanes.c. */

enum { LOOP_MOST = FW_LOOP_MOST, HALF_MOST = 3 };

typedef struct loop_body {
    real phi0, tip_x, tip_y, beyond_x, beyond_y, centre_x, centre_y; /* T, G, C in body axes */
    real diagonal, low, inverse;     /* M_kk; what its pivot must exceed; 1/M_kk */
    real torque, by_cosine, by_sine; /* constant torque; moments of constant forces */
    real mass, force_x, force_y;
    int body, pin; /* the pin on the ground's side */
    double sign;   /* of its multiplier in the model, which counts pins from either body */
} loop_body;

typedef struct loop_pin {
    real k, c, torque0;
} loop_pin;

struct loop {
    int bodies;
    loop_body body[LOOP_MOST];   /* along the loop: the second chain reads them backwards */
    loop_pin pin[LOOP_MOST + 1]; /* pin i lies before body i */
    int cut;                     /* pin of the model that is cut */
    double sign;                 /* of its multiplier, seen from the second chain */
    real floor;                  /* of its pivot */
    real *spare;                 /* (ny + 2 pins) */
};

typedef struct chain { /* one half at this pose */
    real tx[HALF_MOST], ty[HALF_MOST], cx[HALF_MOST], cy[HALF_MOST], ww[HALF_MOST];
    real b[HALF_MOST], l[HALF_MOST][HALF_MOST];
    real zb[HALF_MOST], zx[HALF_MOST], zy[HALF_MOST]; /* D^-1 L^-1 of b and of the tip's rows */
    real xx, xy, yy, gx, gy; /* of the tip: compliance, acceleration without F (x negative) */
} chain;

#define UNROLL _Pragma("GCC unroll 8")

/* torques of the pins on the bodies, squared speeds; the power dissipated */
FW_INLINE real loop_torques(const struct loop *q, const int n, const real *y, const real *v,
                            real b[LOOP_MOST], real ww[LOOP_MOST]) {
    const real nothing = {0};
    real power = nothing, phi = nothing, w = nothing;
    UNROLL for (int i = 0; i <= n; i++) { /* pin i lies before body i */
        real next = nothing, speed = nothing;
        if (i < n) next = y[3 * q->body[i].body + 2], speed = v[3 * q->body[i].body + 2];
        real rate = speed - w, damping = q->pin[i].c * rate;
        real torque = (q->pin[i].torque0 + q->pin[i].k * (next - phi)) + damping;
        power += damping * rate;
        if (i > 0) b[i - 1] += torque;
        if (i < n) b[i] = q->body[i].torque - torque, ww[i] = speed * speed;
        phi = next, w = speed;
    }
    return power;
}

/* arms, M and b; `far` sums the squares of the angles */
FW_INLINE void loop_arms(const loop_body *body, const int step, const int n, const real *y,
                         chain *c, real *far, real gx[HALF_MOST], real gy[HALF_MOST]) {
    UNROLL for (int k = 0; k < n; k++) {
        const loop_body *r = &body[step * k];
        real angle = r->phi0 + y[3 * r->body + 2], sine, cosine;
        *far += angle * angle;
        real_sincos(angle, &sine, &cosine);
        c->tx[k] = cosine * r->tip_x - sine * r->tip_y;
        c->ty[k] = sine * r->tip_x + cosine * r->tip_y;
        c->cx[k] = cosine * r->centre_x - sine * r->centre_y;
        c->cy[k] = sine * r->centre_x + cosine * r->centre_y;
        gx[k] = cosine * r->beyond_x - sine * r->beyond_y;
        gy[k] = sine * r->beyond_x + cosine * r->beyond_y;
        c->b[k] += cosine * r->by_cosine + sine * r->by_sine;
    }
}

/* M = L D L^T from the tip to the ground, three right-hand sides; lanes with a weak pivot */
FW_INLINE bits loop_factor(const loop_body *body, const int step, const int n, chain *c,
                           const real gx[HALF_MOST], const real gy[HALF_MOST]) {
    real m[HALF_MOST][HALF_MOST], x[HALF_MOST], y[HALF_MOST];
    bits sick = {0};
    UNROLL for (int k = 0; k < n; k++) {
        m[k][k] = body[step * k].diagonal, x[k] = c->ty[k], y[k] = c->tx[k];
        UNROLL for (int j = 0; j < k; j++) {
            m[j][k] = c->tx[j] * gx[k] + c->ty[j] * gy[k];
            real turn = c->tx[j] * gy[k] - c->ty[j] * gx[k];
            c->b[j] += c->ww[k] * turn;
            c->b[k] -= c->ww[j] * turn;
        }
    }
    UNROLL for (int k = n - 1; k >= 0; k--) {
        real inverse = k == n - 1 ? body[step * k].inverse : 1.0 / m[k][k];
        if (k < n - 1) sick |= bits_of(m[k][k] - body[step * k].low);
        UNROLL for (int j = k - 1; j >= 0; j--) {
            real l = c->l[k][j] = m[j][k] * inverse;
            UNROLL for (int i = 0; i <= j; i++) m[i][j] -= m[i][k] * l;
            c->b[j] -= l * c->b[k], x[j] -= l * x[k], y[j] -= l * y[k];
        }
        real zx = x[k] * inverse, zy = y[k] * inverse;
        c->zb[k] = c->b[k] * inverse, c->zx[k] = zx, c->zy[k] = zy;
        if (k == n - 1) {
            c->xx = x[k] * zx, c->xy = x[k] * zy, c->yy = y[k] * zy;
            c->gx = c->b[k] * zx, c->gy = c->b[k] * zy;
        } else {
            c->xx += x[k] * zx, c->xy += x[k] * zy, c->yy += y[k] * zy;
            c->gx += c->b[k] * zx, c->gy += c->b[k] * zy;
        }
    }
    UNROLL for (int k = 0; k < n; k++) {
        c->gx += c->ww[k] * c->tx[k];
        c->gy -= c->ww[k] * c->ty[k];
    }
    return sick;
}

FW_INLINE void loop_put(fw_multibody_core *k, int pin, double sign, real x, real y) {
    real *row = WORK(row) + FW_ROW * pin + FW_X;
    row[0] = sign * x, row[1] = sign * y;
}

/* accelerations of one chain under the force (-h, v) at its tip, and the joint forces, which begin
   with that force */
FW_INLINE void loop_results(fw_multibody_core *core, const loop_body *body, const int step,
                            const int n, const chain *c, real h, real v, real *a) {
    real alpha[HALF_MOST], ax[HALF_MOST], ay[HALF_MOST], px = {0}, py = {0};
    UNROLL for (int k = 0; k < n; k++) {
        alpha[k] = c->zb[k] + (c->zx[k] * h + c->zy[k] * v);
        UNROLL for (int j = 0; j < k; j++) alpha[k] -= c->l[k][j] * alpha[j];
        ax[k] = (px - alpha[k] * c->cy[k]) - c->ww[k] * c->cx[k];
        ay[k] = (py + alpha[k] * c->cx[k]) - c->ww[k] * c->cy[k];
        px = (px - alpha[k] * c->ty[k]) - c->ww[k] * c->tx[k];
        py = (py + alpha[k] * c->tx[k]) - c->ww[k] * c->ty[k];
        real *to = a + 3 * body[step * k].body;
        to[0] = ax[k], to[1] = ay[k], to[2] = alpha[k];
    }
    real lambda_x = h, lambda_y = -v;
    UNROLL for (int k = n - 1; k >= 0; k--) {
        const loop_body *r = &body[step * k];
        lambda_x += r->mass * ax[k] - r->force_x;
        lambda_y += r->mass * ay[k] - r->force_y;
        loop_put(core, r->pin, r->sign, lambda_x, lambda_y);
    }
}

/* answers the lanes that it cannot do */
FW_INLINE bits loop_rhs(fw_multibody_core *core, const int nl, const int nr, const real *restrict y,
                        real *restrict f) {
    const struct loop *q = core->loop;
    const int n = nl + nr, nq = 3 * n;
    const real *v = y + nq, rate = ((const real *)core->rate)[0];
    const loop_body *first = &q->body[0], *last = &q->body[n - 1];
    chain left, right;
    real far = {0}, gx[2][HALF_MOST], gy[2][HALF_MOST], b[LOOP_MOST], ww[LOOP_MOST];
    real power = loop_torques(q, n, y, v, b, ww);
    UNROLL for (int k = 0; k < nl; k++) left.b[k] = b[k], left.ww[k] = ww[k];
    UNROLL for (int k = 0; k < nr; k++) right.b[k] = b[n - 1 - k], right.ww[k] = ww[n - 1 - k];
    loop_arms(first, 1, nl, y, &left, &far, gx[0], gy[0]);
    loop_arms(last, -1, nr, y, &right, &far, gx[1], gy[1]);
    bits sick = loop_factor(first, 1, nl, &left, gx[0], gy[0]) |
                loop_factor(last, -1, nr, &right, gx[1], gy[1]);
    real xx = left.xx + right.xx, xy = left.xy + right.xy, yy = left.yy + right.yy;
    real determinant = xx * yy - xy * xy, inverse = 1.0 / determinant;
    real least = 100 * core->healthy * q->floor; /* det/trace is below the smaller eigenvalue */
    sick |= bits_of(determinant - least * (xx + yy)) | bits_of(xx - least);
    sick |= bits_of(fw_sincos_range * fw_sincos_range - far);
    real sx = right.gx - left.gx, sy = right.gy - left.gy;
    real h = (yy * sx - xy * sy) * inverse, w = (xx * sy - xy * sx) * inverse;
    real *a = f + nq;
    loop_results(core, first, 1, nl, &left, h, w, a);
    loop_results(core, last, -1, nr, &right, -h, -w, a);
    loop_put(core, q->cut, q->sign, -h, w);
    UNROLL for (int i = 0; i < nq; i++) f[i] = rate * v[i], a[i] *= rate;
    if (core->plan.dissipates) f[2 * nq] = rate * power;
    return bits_negative(sick);
}

/* one function per number of bodies, so that the registers hold what the chains share */
static __attribute__((noinline)) bits loop_of_3(fw_multibody_core *k, const real *y, real *f) {
    return loop_rhs(k, 2, 1, y, f);
}
static __attribute__((noinline)) bits loop_of_4(fw_multibody_core *k, const real *y, real *f) {
    return loop_rhs(k, 2, 2, y, f);
}
static __attribute__((noinline)) bits loop_of_5(fw_multibody_core *k, const real *y, real *f) {
    return loop_rhs(k, 3, 2, y, f);
}
static __attribute__((noinline)) bits loop_of_6(fw_multibody_core *k, const real *y, real *f) {
    return loop_rhs(k, 3, 3, y, f);
}

/* the sick lanes once more by the blocks; the others keep what they have */
static __attribute__((noinline)) void blocks_for(fw_multibody_core *k, bits sick, const real *y,
                                                 real *to) {
    const fw_multibody_kernel_plan *p = &k->plan;
    real *other = k->loop->spare, *keep = other + p->ny;
    for (int i = 0; i < p->pins; i++)
        for (int c = 0; c < 2; c++)
            keep[2 * i + c] = CONST(row)[FW_ROW * i + FW_X + c];
    blocks_rhs(k, y, other);
    for (int i = 0; i < p->ny; i++)
        to[i] = real_select(sick, other[i], to[i]);
    for (int i = 0; i < p->pins; i++)
        for (int c = 0; c < 2; c++) {
            real *x = &WORK(row)[FW_ROW * i + FW_X + c];
            *x = real_select(sick, *x, keep[2 * i + c]);
        }
}

static void loop_or_blocks(fw_multibody_core *k, const real *y, real *f) {
    static bits (*const of[])(fw_multibody_core *, const real *, real *) = {loop_of_3, loop_of_4,
                                                                            loop_of_5, loop_of_6};
    bits sick = of[k->loop->bodies - FW_LOOP_LEAST](k, y, f);
    if (bits_any(sick)) blocks_for(k, sick, y, f);
}

/* ---- numbers ---- */

/* body k of a chain of n; `at` and `pin`: bodies and pins of the model from the ground to the
   cut */
static void fill_loop_body(loop_body *r, const fw_multibody_model *m, const int *at, const int *pin,
                           int k, int n, int lane) {
    const int b = at[k];
    const bool second = m->body[2 * pin[k]] != b; /* of the two bodies of the pin before */
    const double *ground = m->local + 4 * pin[k] + (second ? 2 : 0);
    const double *cut = m->local + 4 * pin[k + 1] + (m->body[2 * pin[k + 1]] == b ? 0 : 2);
    const double cx = -ground[0], cy = -ground[1], tx = cut[0] - ground[0], ty = cut[1] - ground[1];
    double mass = 1 / m->minv[b], beyond = 0, fx = 0, fy = 0;
    for (int i = k + 1; i < n; i++) {
        double one = 1 / m->minv[at[i]];
        beyond += one;
        fx += one * m->constant[3 * at[i]], fy += one * m->constant[3 * at[i] + 1];
    }
    r->body = b, r->pin = pin[k], r->sign = second ? 1 : -1;
    LANE(r->phi0, lane) = m->origin[3 * b + 2];
    LANE(r->tip_x, lane) = tx, LANE(r->tip_y, lane) = ty;
    LANE(r->centre_x, lane) = cx, LANE(r->centre_y, lane) = cy;
    LANE(r->beyond_x, lane) = mass * cx + beyond * tx;
    LANE(r->beyond_y, lane) = mass * cy + beyond * ty;
    double diagonal = 1 / m->jinv[b] + mass * (cx * cx + cy * cy) + beyond * (tx * tx + ty * ty);
    LANE(r->diagonal, lane) = diagonal, LANE(r->inverse, lane) = 1 / diagonal;
    LANE(r->low, lane) = 1e-4 * diagonal;
    LANE(r->torque, lane) = m->constant[3 * b + 2] / m->jinv[b];
    LANE(r->mass, lane) = mass;
    double own_x = mass * m->constant[3 * b], own_y = mass * m->constant[3 * b + 1];
    LANE(r->force_x, lane) = own_x, LANE(r->force_y, lane) = own_y;
    LANE(r->by_cosine, lane) = (cx * own_y - cy * own_x) + (tx * fy - ty * fx);
    LANE(r->by_sine, lane) = -(cx * own_x + cy * own_y) - (tx * fx + ty * fy);
}

static void loop_fill(fw_multibody_core *k, const fw_multibody_model *m, int lane) {
    struct loop *q = k->loop;
    const fw_multibody_kernel_plan *p = &k->plan;
    const int n = q->bodies, nl = (n + 1) / 2, nr = n / 2;
    int at[HALF_MOST], pin[HALF_MOST + 1];
    for (int side = 0; side < 2; side++) {
        int count = side ? nr : nl;
        for (int i = 0; i <= count; i++) {
            pin[i] = p->loop_pin[side ? n - i : i];
            if (i < count) at[i] = p->loop_body[side ? n - i : i + 1];
        }
        for (int i = 0; i < count; i++)
            fill_loop_body(&q->body[side ? n - 1 - i : i], m, at, pin, i, count, lane);
    }
    q->cut = p->loop_pin[nl];
    q->sign = m->body[2 * q->cut] == p->loop_body[nl + 1] ? 1 : -1;
    LANE(q->floor, lane) = k->pin[FW_W * (FW_PIN * q->cut + FW_FLOOR) + lane];
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_multibody_torsion *s = &m->torsion[i];
        loop_pin *to = &q->pin[p->loop_torsion[i]];
        LANE(to->k, lane) += s->k, LANE(to->c, lane) += s->c;
        LANE(to->torque0, lane) +=
            (s->a == p->loop_body[p->loop_torsion[i]] ? 1 : -1) * s->k * s->angle0;
    }
}

static fw_status loop_new(fw_arena *arena, fw_multibody_core *k) {
    struct loop *q = fw_arena_one(arena, struct loop);
    FW_NEED(q);
    FW_NEED(q->spare = fw_arena_array(arena, real, (size_t)(k->plan.ny + 2 * k->plan.pins)));
    q->bodies = k->plan.bodies;
    k->loop = q;
    return FW_OK;
}
