/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Third part of kernel_path.h, lanes only: the right-hand side of one closed loop of 3 to 6 bodies,
   both ends on the ground, by cutting it at a pin in the middle into two open chains.

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
   another, and half the operations of the 2 x 2 blocks.

   Units and signs of y and f as in kernel.h, of the joint forces as in the records. Valid where
   every pivot of M keeps 1e-4 of its diagonal and the 2 x 2 pivot is 100 times above the limit of
   the blocks; other lanes, and angles beyond fw_sincos_range, take the blocks. Error: 1e-14 of the
   largest acceleration for masses alike, 1e-11 for masses over four decades (the blocks lose 1e-12
   and 1e-8 there). Cost for 5 bodies: 412 operations, sines included (the blocks: about 900).
   Source: Wittenburg, Dynamics of Multibody Systems, 2nd ed., ch. 5 (augmented bodies, cut joints).
   Test: test_lanes.c. */

enum { LOOP_LEAST = 3, LOOP_MOST = 6, HALF_MOST = 3 };

typedef struct loop_body {
    real phi0, tip_x, tip_y, beyond_x, beyond_y, centre_x, centre_y; /* T, G, C in body axes */
    real diagonal, low, inverse;     /* M_kk; what its pivot must exceed; 1/M_kk */
    real torque, by_cosine, by_sine; /* constant torque; moments of constant forces */
    real mass, force_x, force_y;
    int body;
} loop_body;

typedef struct loop_pin {
    real k, c, torque0;
} loop_pin;

struct loop {
    int bodies;
    loop_body body[LOOP_MOST];   /* along the loop: the second chain reads them backwards */
    loop_pin pin[LOOP_MOST + 1]; /* pin i lies before body i */
    real floor;                  /* of the pin that is cut */
    real *spare;                 /* (ny + 4 records) */
};

typedef struct chain { /* one half at this pose */
    real tx[HALF_MOST], ty[HALF_MOST], cx[HALF_MOST], cy[HALF_MOST], ww[HALF_MOST];
    real b[HALF_MOST], l[HALF_MOST][HALF_MOST];
    real zb[HALF_MOST], zx[HALF_MOST], zy[HALF_MOST]; /* D^-1 L^-1 of b and of the tip's rows */
    real xx, xy, yy, gx, gy; /* of the tip: compliance, acceleration without F (x negative) */
} chain;

#define INLINE static inline __attribute__((always_inline))
#define UNROLL _Pragma("GCC unroll 8")

/* torques of the pins on the bodies, squared speeds; the power dissipated */
INLINE real loop_torques(const struct loop *q, const int n, const real *y, const real *v,
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
INLINE void loop_arms(const loop_body *body, const int step, const int n, const real *y, chain *c,
                      real *far, real gx[HALF_MOST], real gy[HALF_MOST]) {
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
INLINE bits loop_factor(const loop_body *body, const int step, const int n, chain *c,
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

/* accelerations of one chain under the force (-h, v) at its tip, and the joint forces: lambda of
   the tip's pin is what the record of that pin holds */
INLINE void loop_results(path *p, const loop_body *body, const int step, const int n,
                         const chain *c, real h, real v, real lambda_x, real lambda_y, real *a) {
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
    UNROLL for (int k = n - 1; k >= 0; k--) {
        lambda_x += body[step * k].mass * ax[k] - body[step * k].force_x;
        lambda_y += body[step * k].mass * ay[k] - body[step * k].force_y;
        record *r = RECORD(p, k, step < 0);
        r->x0 = lambda_x, r->x1 = lambda_y;
    }
}

/* answers the lanes that it cannot do */
INLINE bits loop_rhs(path *p, const int nl, const int nr, const real *restrict y,
                     real *restrict f) {
    const struct loop *q = p->loop;
    const int n = nl + nr, nq = 3 * n;
    const real *v = y + nq;
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
    sick |= check(determinant, xx, yy, q->floor, 100 * p->healthy);
    sick |= bits_of(fw_sincos_range * fw_sincos_range - far);
    real sx = right.gx - left.gx, sy = right.gy - left.gy;
    real h = (yy * sx - xy * sy) * inverse, w = (xx * sy - xy * sx) * inverse;
    real *a = f + nq;
    loop_results(p, first, 1, nl, &left, h, w, h, -w, a);
    loop_results(p, last, -1, nr, &right, -h, -w, -h, w, a);
    record *tip = RECORD(p, nr, 1);
    tip->x0 = -h, tip->x1 = w;
    if (nl == nr) { /* the cut pin is the middle one, on both sides */
        tip = RECORD(p, nl, 0);
        tip->x0 = h, tip->x1 = -w;
    }
    UNROLL for (int i = 0; i < nq; i++) f[i] = v[i];
    if (p->dissipates) f[2 * nq] = power;
    return sick;
}

/* one function per number of bodies, so that the registers hold what the chains share */
static __attribute__((noinline)) bits loop_of_3(path *p, const real *y, real *f) {
    return loop_rhs(p, 2, 1, y, f);
}
static __attribute__((noinline)) bits loop_of_4(path *p, const real *y, real *f) {
    return loop_rhs(p, 2, 2, y, f);
}
static __attribute__((noinline)) bits loop_of_5(path *p, const real *y, real *f) {
    return loop_rhs(p, 3, 2, y, f);
}
static __attribute__((noinline)) bits loop_of_6(path *p, const real *y, real *f) {
    return loop_rhs(p, 3, 3, y, f);
}

/* the sick lanes once more by the blocks; the others keep what they have */
static __attribute__((noinline)) void blocks_for(path *p, bits sick, const double *y, double *f) {
    const int n = p->records * FW_SIDES;
    real *other = p->loop->spare, *keep = other + p->ny, *to = (real *)f;
    for (int i = 0; i < n; i++)
        keep[2 * i] = p->r[i].x0, keep[2 * i + 1] = p->r[i].x1;
    blocks_rhs(p, y, (double *)other);
    for (int i = 0; i < p->ny; i++)
        to[i] = real_select(sick, other[i], to[i]);
    for (int i = 0; i < n; i++) {
        p->r[i].x0 = real_select(sick, p->r[i].x0, keep[2 * i]);
        p->r[i].x1 = real_select(sick, p->r[i].x1, keep[2 * i + 1]);
    }
}

static void loop_or_blocks(path *p, const double *y, double *f) {
    static bits (*const of[])(path *, const real *, real *) = {loop_of_3, loop_of_4, loop_of_5,
                                                               loop_of_6};
    bits sick = bits_negative(of[p->loop->bodies - LOOP_LEAST](p, (const real *)y, (real *)f));
    for (int i = 0; i < p->ny && p->rated; i++)
        ((real *)f)[i] *= p->rate;
    if (bits_any(sick)) blocks_for(p, sick, y, f);
}

/* ---- numbers ---- */

/* body k of a chain of n; `at` and `pin`: bodies and pins of the model from the ground to the cut
 */
static void fill_loop_body(loop_body *r, const fw_model *m, const int *at, const int *pin, int k,
                           int n, int lane) {
    const int b = at[k];
    const double *ground = m->local + 4 * pin[k] + (m->body[2 * pin[k]] == b ? 0 : 2);
    const double *cut = m->local + 4 * pin[k + 1] + (m->body[2 * pin[k + 1]] == b ? 0 : 2);
    const double cx = -ground[0], cy = -ground[1], tx = cut[0] - ground[0], ty = cut[1] - ground[1];
    double mass = 1 / m->minv[b], beyond = 0, fx = 0, fy = 0;
    for (int i = k + 1; i < n; i++) {
        double one = 1 / m->minv[at[i]];
        beyond += one;
        fx += one * m->constant[3 * at[i]], fy += one * m->constant[3 * at[i] + 1];
    }
    r->body = b;
    r->phi0[lane] = m->origin[3 * b + 2];
    r->tip_x[lane] = tx, r->tip_y[lane] = ty;
    r->centre_x[lane] = cx, r->centre_y[lane] = cy;
    r->beyond_x[lane] = mass * cx + beyond * tx, r->beyond_y[lane] = mass * cy + beyond * ty;
    double diagonal = 1 / m->jinv[b] + mass * (cx * cx + cy * cy) + beyond * (tx * tx + ty * ty);
    r->diagonal[lane] = diagonal, r->inverse[lane] = 1 / diagonal, r->low[lane] = 1e-4 * diagonal;
    r->torque[lane] = m->constant[3 * b + 2] / m->jinv[b];
    r->mass[lane] = mass;
    double own_x = mass * m->constant[3 * b], own_y = mass * m->constant[3 * b + 1];
    r->force_x[lane] = own_x, r->force_y[lane] = own_y;
    r->by_cosine[lane] = (cx * own_y - cy * own_x) + (tx * fy - ty * fx);
    r->by_sine[lane] = -(cx * own_x + cy * own_y) - (tx * fx + ty * fy);
}

static void fill_loop(struct loop *q, const fw_model *m, const fw_trail *t, int lane) {
    const int n = q->bodies, nl = (n + 1) / 2, nr = n / 2;
    int at[HALF_MOST], pin[HALF_MOST + 1];
    for (int side = 0; side < 2; side++) {
        int count = side ? nr : nl;
        for (int k = 0; k <= count; k++) {
            pin[k] = t->pin[side ? n - k : k];
            if (k < count) at[k] = t->body[side ? n - k : k + 1];
        }
        for (int k = 0; k < count; k++)
            fill_loop_body(&q->body[side ? n - 1 - k : k], m, at, pin, k, count, lane);
    }
    q->floor[lane] = fw_pin_floor(m, t->pin[nl]);
    for (int i = 0; i < m->ntorsion; i++) {
        const fw_model_torsion *s = &m->torsion[i];
        loop_pin *to = &q->pin[t->torsion[i]];
        to->k[lane] += s->k, to->c[lane] += s->c;
        to->torque0[lane] += (s->a == t->body[t->torsion[i]] ? 1 : -1) * s->k * s->angle0;
    }
}

static fw_status create_loop(fw_arena *arena, const fw_model *const *models, const fw_trail *t,
                             path *p) {
    const int bodies = t->count - 1;
    if (p->first == 0 || bodies < LOOP_LEAST || bodies > LOOP_MOST) return FW_OK;
    struct loop *q = fw_arena_one(arena, struct loop);
    FW_NEED(q);
    FW_NEED(q->spare = fw_arena_array(arena, real, (size_t)(p->ny + 2 * p->records * FW_SIDES)));
    q->bodies = bodies;
    for (int lane = 0; lane < DESIGNS; lane++)
        fill_loop(q, models[lane], t, lane);
    p->loop = q;
    return FW_OK;
}
