/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The constraint equations of every kind of joint, and the points of the ground that move them. */
#include "multibody/multibody_scratch.h"
#include <math.h>
#include <string.h>

/* ---- ground points that move ---- */

/* Ground points that move: p(t) = p + s law(t) (p - centre), s the strain (temperature with a law).
   For every block the vector d from point a to point b (constraints.c) gains

     g law(t),   g = s (p_b - centre) where b is the ground, -s (p_a - centre) where a is,

   (p of a pin that stands for a flexure is where the strip begins), so that Psi_t and Psi_tt follow
   from d' += g law', d'' += g law''; ends of springs on the ground move likewise. A pose holds the
   ground of its time. Scaled units. Exact. What the moving ground feeds in goes to the energy
   balance: lambda . Psi_t of the joints (system.c), and that of springs and slides (forces.c). Test: test_constraints.c, test_temperature.c. */

void fw_multibody_stretch_gain(const fw_multibody_model *m, const double local[2], double gain[2]) {
    for (int k = 0; k < 2; k++)
        gain[k] = m->stretch.strain * (local[k] - m->stretch.centre[k]);
}

/* of a point that goes with one `root_m` away from it: a pin that stands for a flexure */
static void gain_of_pin(const fw_multibody_model *m, const double local[2],
                        const fw_geometry_vec2 *root_m, double gain[2]) {
    const double at[2] = {local[0] + (root_m ? root_m->x / m->scale.length_m : 0),
                          local[1] + (root_m ? root_m->y / m->scale.length_m : 0)};
    fw_multibody_stretch_gain(m, at, gain);
}

/* g of every block: of b's point, less that of a's */
static void gain_of_blocks(const fw_mechanism *mechanism, fw_multibody_model *m) {
    fw_multibody_stretch *s = &m->stretch;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        const fw_mechanism_pin *pin = b->pin != FW_NONE ? &mechanism->pin[b->pin] : NULL;
        double *g = s->block + 2 * i;
        if (b->b == m->nbody) {
            gain_of_pin(m, m->local + 4 * i + 2, pin ? &pin->root_b_m : NULL, g);
        } else if (b->a == m->nbody) {
            gain_of_pin(m, m->local + 4 * i, pin ? &pin->root_a_m : NULL, g);
            g[0] = -g[0], g[1] = -g[1];
        }
    }
}

static void gain_of_springs(fw_multibody_model *m) {
    for (int i = 0; i < m->nspring; i++) {
        const fw_multibody_spring *p = &m->spring[i];
        const double *end = m->spring_end + 4 * i;
        double *g = m->stretch.spring + 4 * i;
        if (p->a == m->nbody) fw_multibody_stretch_gain(m, end, g);
        if (p->b == m->nbody) fw_multibody_stretch_gain(m, end + 2, g + 2);
    }
}

fw_status fw_multibody_stretch_new(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_effects_stretch *from, fw_geometry_vec2 centre,
                                   fw_multibody_model *m) {
    fw_multibody_stretch *s = &m->stretch;
    s->strain = from->strain;
    s->centre[0] = (from->centre_m.x - centre.x) / m->scale.length_m;
    s->centre[1] = (from->centre_m.y - centre.y) / m->scale.length_m;
    FW_NEED(s->block = fw_arena_array(arena, double, 2 * (size_t)m->nblock));
    FW_NEED(s->spring = fw_arena_array(arena, double, 4 * (size_t)m->nspring));
    gain_of_blocks(mechanism, m);
    gain_of_springs(m);
    s->law = from->law;
    m->driven = true;
    return FW_OK;
}

/* the ground as it stands at t, for the pose that is being made */
static void stretch_pose(const fw_multibody_system *sys, double t) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_stretch *s = &m->stretch;
    fw_multibody_scratch *w = sys->work;
    if (t == w->ground_t && sys->piece_s == w->ground_piece_s) return;
    const double unit = m->scale.time_s;
    fw_quantity_law_value(s->law, t * unit, sys->piece_s, w->ground);
    w->ground[1] *= unit, w->ground[2] *= unit * unit;
    w->ground_t = t, w->ground_piece_s = sys->piece_s;
    for (int i = 0; i < 2 * m->nblock; i++) /* d = ... - offset */
        w->offset[i] = m->offset[i] - w->ground[0] * s->block[i];
    for (int i = 0; i < 4 * m->nspring; i++)
        w->spring_end[i] = m->spring_end[i] + w->ground[0] * s->spring[i];
}

/* ---- joints ---- */

/* The constraint equations Psi(q, t) = 0 of every kind of joint: values, Jacobian G = Psi_q, time
   derivatives. With p(r) = (-r_y, r_x) the velocity of a body's point r is x' + p(r) w, and with
   d = x_b + r_b - x_a - r_a, axis e = e(phi_a), normal n = p(e):

   block    Psi                            rows of G for b         rows of G for a
   PIN      -d                             -[I, p(r_b)]            [I, p(r_a)]
   TURN     phi_b - phi_a - f              (0, 0, 1)               (0, 0, -1)
   SLIDE    TURN, and n.d                  (n, n.p(r_b))           -(n, n.p(r_a) + e.d)
   TRAVEL   e.d - f                        (e, e.p(r_b))           -(e, e.p(r_a) - n.d)
   ROD      |d| - f                        (d/|d|, d/|d|.p(r_b))   -(d/|d|, d/|d|.p(r_a))

   Only f depends on time, so Psi_t = -f', Psi_tt = -f'', Psi_qt = 0; where the ground's points move
   (constraints.c) d does too. Source: Haug, Computer Aided Kinematics and Dynamics, 1989, ch. 3; Garcia
   de Jalon and Bayo 1994. Test: test_constraints.c (differences of Psi along motions). */

static double dot(const double a[2], const double b[2]) {
    return a[0] * b[0] + a[1] * b[1];
}

/* value, first and second derivative of what a block keeps, scaled */
static void kept(const fw_multibody_system *sys, int block, double t, double f[3]) {
    const fw_multibody_block *b = &sys->model->block[block];
    f[0] = sys->loading.value[block], f[1] = f[2] = 0;
    if (!b->law || !sys->loading.driven) return;
    double law[3], unit = sys->model->scale.time_s;
    fw_quantity_law_value(b->law, t * unit, sys->piece_s, law);
    f[0] += law[0] / b->unit;
    f[1] = law[1] / b->unit * unit;
    f[2] = law[2] / b->unit * unit * unit;
}

/* d of block i */
static void point_to_point(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                           double d[2]) {
    const fw_multibody_block *b = &m->block[i];
    const double *r = pose->arm + 4 * i, *u = pose->u;
    d[0] = r[2] - r[0] - pose->offset[2 * i];
    d[1] = r[3] - r[1] - pose->offset[2 * i + 1];
    if (b->a < m->nbody) d[0] -= u[3 * b->a], d[1] -= u[3 * b->a + 1];
    if (b->b < m->nbody) d[0] += u[3 * b->b], d[1] += u[3 * b->b + 1];
}

void fw_multibody_frame(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                        double d[2], double e[2], double n[2]) {
    const fw_multibody_block *b = &m->block[i];
    point_to_point(m, pose, i, d);
    double c = pose->cosine[b->a], s = pose->sine[b->a];
    e[0] = c * b->cos_axis - s * b->sin_axis;
    e[1] = s * b->cos_axis + c * b->sin_axis;
    n[0] = -e[1], n[1] = e[0];
}

static void point_row(double *g, const double direction[2], const double arm[2], double sign) {
    g[0] = sign * direction[0];
    g[1] = sign * direction[1];
    g[2] = sign * (direction[1] * arm[0] - direction[0] * arm[1]);
}

/* the 2 x 3 Jacobians of block i for a (6), then for b (6) */
static void block_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                           double *g) {
    const fw_multibody_block *b = &m->block[i];
    const double *ra = pose->arm + 4 * i, *rb = ra + 2;
    double d[2], e[2], n[2];
    memset(g, 0, 12 * sizeof *g);
    fw_multibody_frame(m, pose, i, d, e, n);
    switch (b->rows) {
    case FW_ROWS_PIN:
        g[0] = g[4] = 1, g[2] = -ra[1], g[5] = ra[0];
        g[6] = g[10] = -1, g[8] = rb[1], g[11] = -rb[0];
        break;
    case FW_ROWS_TURN:
        g[2] = -1, g[8] = 1;
        break;
    case FW_ROWS_SLIDE:
        g[2] = -1, g[8] = 1;
        point_row(g + 3, n, ra, -1);
        g[5] -= dot(e, d);
        point_row(g + 9, n, rb, 1);
        break;
    case FW_ROWS_TRAVEL:
        point_row(g, e, ra, -1);
        g[2] += dot(n, d);
        point_row(g + 6, e, rb, 1);
        break;
    case FW_ROWS_ROD: {
        double length = sqrt(dot(d, d));
        const double along[2] = {d[0] / length, d[1] / length}; /* NaN where the points meet */
        point_row(g, along, ra, -1);
        point_row(g + 6, along, rb, 1);
        break;
    }
    }
    for (int k = 0; k < 6; k++) { /* the ground does not move */
        if (b->a == m->nbody) g[k] = 0;
        if (b->b == m->nbody) g[6 + k] = 0;
    }
}

const fw_multibody_pose *fw_multibody_pose_at(fw_multibody_system *sys, double t, const double *u) {
    const fw_multibody_model *m = sys->model;
    fw_multibody_scratch *w = sys->work;
    const double *origin = m->origin;
    w->pose.t = t, w->pose.u = u;
    if (m->stretch.law) stretch_pose(sys, t);
    for (int b = 0; b < m->nbody; b++) {
        double angle = origin[3 * b + 2] + u[3 * b + 2];
        sincos(angle, &w->sine[b], &w->cosine[b]);
    }
    for (int i = 0; i < 2 * m->nblock; i++) {
        double c = w->cosine[m->body[i]], s = w->sine[m->body[i]];
        double x = m->local[2 * i], y = m->local[2 * i + 1];
        w->arm[2 * i] = c * x - s * y;
        w->arm[2 * i + 1] = s * x + c * y;
    }
    for (int i = 0; i < m->nblock && !m->plain; i++)
        block_jacobian(m, &w->pose, i, w->jac + 12 * i);
    return &w->pose;
}

/* angle of b against a less that at the origin */
static double turned(const fw_multibody_model *m, const fw_multibody_block *b, const double *u) {
    return (b->b < m->nbody ? u[3 * b->b + 2] : 0) - (b->a < m->nbody ? u[3 * b->a + 2] : 0);
}

static void block_residual(const fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                           double psi[2]) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_block *b = &m->block[i];
    double d[2], e[2], n[2], f[3];
    point_to_point(m, pose, i, d);
    psi[0] = -d[0], psi[1] = -d[1];
    if (b->rows == FW_ROWS_PIN) return; /* needs no axis */
    fw_multibody_frame(m, pose, i, d, e, n);
    kept(sys, i, pose->t, f);
    psi[1] = 0;
    switch (b->rows) {
    case FW_ROWS_SLIDE:
        psi[0] = turned(m, b, pose->u) - f[0];
        psi[1] = dot(n, d);
        break;
    case FW_ROWS_ROD:
        psi[0] = sqrt(dot(d, d)) - f[0];
        break;
    case FW_ROWS_TRAVEL:
        psi[0] = dot(e, d) - f[0];
        break;
    case FW_ROWS_TURN:
    case FW_ROWS_PIN:
        psi[0] = turned(m, b, pose->u) - f[0];
    }
}

double fw_multibody_residual(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                             double *psi) {
    double worst = 0, unwanted[2];
    for (int i = 0; i < sys->model->nblock; i++) {
        double *at = psi ? psi + 2 * i : unwanted;
        block_residual(sys, pose, i, at);
        double norm = sqrt(dot(at, at));
        worst = norm > worst || isnan(norm) ? norm : worst;
    }
    return worst;
}

/* ---- products with the Jacobian at the pose ---- */

static const double still[3] = {0};

static const double *of(const fw_multibody_model *m, const double *v, int body) {
    return body < m->nbody ? v + 3 * body : still;
}

static void jacobian_of_pins(const fw_multibody_model *m, const double *arm, const double *v,
                             double *r) {
    for (int i = 0; i < m->nblock; i++) {
        const double *p = of(m, v, m->body[2 * i]), *q = of(m, v, m->body[2 * i + 1]);
        const double *s = arm + 4 * i;
        r[2 * i] = p[0] - p[2] * s[1] - q[0] + q[2] * s[3];
        r[2 * i + 1] = p[1] + p[2] * s[0] - q[1] - q[2] * s[2];
    }
}

void fw_multibody_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose,
                           const double *v, double *r) {
    if (m->plain) {
        jacobian_of_pins(m, pose->arm, v, r);
        return;
    }
    for (int i = 0; i < m->nblock; i++) {
        const double *p = of(m, v, m->body[2 * i]), *q = of(m, v, m->body[2 * i + 1]);
        const double *g = pose->jac + 12 * i, *h = g + 6;
        for (int k = 0; k < 2; k++, g += 3, h += 3)
            r[2 * i + k] =
                g[0] * p[0] + g[1] * p[1] + g[2] * p[2] + h[0] * q[0] + h[1] * q[1] + h[2] * q[2];
    }
}

static void add_transpose(const double *g, const double *lambda, double scale, double turn,
                          double *to) {
    double x = lambda[0], y = lambda[1];
    to[0] += scale * (g[0] * x + g[3] * y);
    to[1] += scale * (g[1] * x + g[4] * y);
    to[2] += turn * (g[2] * x + g[5] * y);
}

void fw_multibody_apply(const fw_multibody_model *m, const fw_multibody_pose *pose,
                        const double *lambda, double *a) {
    for (int i = 0; i < m->nblock; i++) {
        int p = m->body[2 * i], q = m->body[2 * i + 1];
        if (!m->plain) {
            const double *g = pose->jac + 12 * i;
            if (p < m->nbody) add_transpose(g, lambda + 2 * i, -m->minv[p], -m->jinv[p], a + 3 * p);
            if (q < m->nbody)
                add_transpose(g + 6, lambda + 2 * i, -m->minv[q], -m->jinv[q], a + 3 * q);
            continue;
        }
        const double *r = pose->arm + 4 * i;
        double x = lambda[2 * i], y = lambda[2 * i + 1];
        if (p < m->nbody) {
            a[3 * p] -= m->minv[p] * x;
            a[3 * p + 1] -= m->minv[p] * y;
            a[3 * p + 2] -= m->jinv[p] * (r[0] * y - r[1] * x);
        }
        if (q < m->nbody) {
            a[3 * q] += m->minv[q] * x;
            a[3 * q + 1] += m->minv[q] * y;
            a[3 * q + 2] += m->jinv[q] * (r[2] * y - r[3] * x);
        }
    }
}

/* also where only arms are kept */
void fw_multibody_side_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                                int side, double g[6]) {
    if (!m->plain) {
        memcpy(g, pose->jac + 12 * i + 6 * side, 6 * sizeof *g);
        return;
    }
    const double *r = pose->arm + 4 * i + 2 * side;
    double sign = m->body[2 * i + side] == m->nbody ? 0 : side ? -1 : 1;
    const double row[6] = {sign, 0, -sign * r[1], 0, sign, sign * r[0]};
    memcpy(g, row, sizeof row);
}

/* ---- time derivatives ---- */

/* r += Psi_t of the moving ground */
static void stretch_drift(const fw_multibody_model *m, const fw_multibody_pose *pose, double *r) {
    for (int i = 0; i < m->nblock; i++) {
        double d[2], e[2], n[2];
        const double x = pose->ground[1] * m->stretch.block[2 * i];
        const double y = pose->ground[1] * m->stretch.block[2 * i + 1];
        if (x == 0 && y == 0) continue;
        fw_multibody_frame(m, pose, i, d, e, n);
        switch (m->block[i].rows) {
        case FW_ROWS_PIN:
            r[2 * i] -= x, r[2 * i + 1] -= y;
            break;
        case FW_ROWS_SLIDE:
            r[2 * i + 1] += n[0] * x + n[1] * y;
            break;
        case FW_ROWS_TRAVEL:
            r[2 * i] += e[0] * x + e[1] * y;
            break;
        case FW_ROWS_ROD:
            r[2 * i] += (d[0] * x + d[1] * y) / sqrt(d[0] * d[0] + d[1] * d[1]);
            break;
        case FW_ROWS_TURN:
            break;
        }
    }
}

void fw_multibody_drift(const fw_multibody_system *sys, const fw_multibody_pose *pose, double *r) {
    const fw_multibody_model *m = sys->model;
    memset(r, 0, 2 * (size_t)m->nblock * sizeof *r);
    for (int i = 0; sys->loading.driven && i < m->nblock; i++) {
        double f[3];
        if (!m->block[i].law) continue;
        kept(sys, i, pose->t, f);
        r[2 * i] = -f[1];
    }
    if (m->stretch.law && sys->loading.driven) stretch_drift(m, pose, r);
}

/* (G v)' at a = 0, of one block that is not a pin */
static void other_gamma(const fw_multibody_system *sys, const fw_multibody_pose *pose, int i,
                        const double *v, double r[2]) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_block *b = &m->block[i];
    const double *p = of(m, v, b->a), *q = of(m, v, b->b), *ra = pose->arm + 4 * i, *rb = ra + 2;
    double f[3], wa = p[2], wb = q[2];
    kept(sys, i, pose->t, f);
    r[0] = -f[2], r[1] = 0;
    if (b->rows == FW_ROWS_TURN) return;
    /* d, its rate and its second derivative without accelerations */
    double d[2], e[2], n[2];
    fw_multibody_frame(m, pose, i, d, e, n);
    double rate[2] = {q[0] - wb * rb[1] - p[0] + wa * ra[1], q[1] + wb * rb[0] - p[1] - wa * ra[0]};
    double bend[2] = {wa * wa * ra[0] - wb * wb * rb[0], wa * wa * ra[1] - wb * wb * rb[1]};
    for (int k = 0; k < 2 && m->stretch.law; k++) {
        rate[k] += pose->ground[1] * m->stretch.block[2 * i + k];
        bend[k] += pose->ground[2] * m->stretch.block[2 * i + k];
    }
    if (b->rows == FW_ROWS_SLIDE) {
        r[1] = dot(n, bend) - 2 * wa * dot(e, rate) - wa * wa * dot(n, d);
    } else if (b->rows == FW_ROWS_TRAVEL) {
        r[0] += dot(e, bend) + 2 * wa * dot(n, rate) - wa * wa * dot(e, d);
    } else {
        double length = sqrt(dot(d, d)), along = dot(d, rate) / length;
        r[0] += dot(d, bend) / length + (dot(rate, rate) - along * along) / length;
    }
}

void fw_multibody_gamma(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, double *r) {
    const fw_multibody_model *m = sys->model;
    for (int i = 0; i < m->nblock; i++) {
        if (m->block[i].rows != FW_ROWS_PIN) {
            other_gamma(sys, pose, i, v, r + 2 * i);
            continue;
        }
        const double *s = pose->arm + 4 * i;
        double wp = of(m, v, m->body[2 * i])[2], wq = of(m, v, m->body[2 * i + 1])[2];
        wp *= wp, wq *= wq;
        r[2 * i] = wq * s[2] - wp * s[0];
        r[2 * i + 1] = wq * s[3] - wp * s[1];
        if (!m->stretch.law) continue;
        r[2 * i] -= pose->ground[2] * m->stretch.block[2 * i];
        r[2 * i + 1] -= pose->ground[2] * m->stretch.block[2 * i + 1];
    }
}

/* ---- dense, without the empty rows ---- */

void fw_multibody_dense_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 double *g) {
    memset(g, 0, (size_t)m->rows * (size_t)m->nq * sizeof *g);
    for (int i = 0, row = 0; i < m->nblock; i++) {
        int count = fw_multibody_row_count(&m->block[i]);
        for (int side = 0; side < 2; side++) {
            int body = m->body[2 * i + side];
            double part[6];
            if (body == m->nbody) continue;
            fw_multibody_side_jacobian(m, pose, i, side, part);
            for (int k = 0; k < count; k++)
                for (int c = 0; c < 3; c++)
                    g[(size_t)(row + k) * (size_t)m->nq + (size_t)(3 * body + c)] +=
                        part[3 * k + c];
        }
        row += count;
    }
}

void fw_multibody_pack(const fw_multibody_model *m, const double *block, double *rows) {
    for (int i = 0, row = 0; i < m->nblock; i++) {
        rows[row++] = block[2 * i];
        if (fw_multibody_row_count(&m->block[i]) == 2) rows[row++] = block[2 * i + 1];
    }
}

void fw_multibody_unpack(const fw_multibody_model *m, const double *rows, double *block) {
    for (int i = 0, row = 0; i < m->nblock; i++) {
        block[2 * i] = rows[row++];
        block[2 * i + 1] = fw_multibody_row_count(&m->block[i]) == 2 ? rows[row++] : 0;
    }
}
