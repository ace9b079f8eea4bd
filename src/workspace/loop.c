/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed loop of the six-bar: its angles for a pose, and their bounds over boxes of poses. */
#include "workspace/loop.h"
#include "workspace/reach.h"
#include "base/constants.h"
#include <math.h>

/* ---- angles for a pose ---- */

enum { LINKS = 5 }; /* bodies 0..4 of the six-bar; they and the ground are its core */

typedef struct graph {
    const fw_mechanism *m;
    int *parent;   /* (nbody) trees of bodies that are joined to each other outside of the core */
    int *attached; /* (nbody) at a root: 2 + the body of the core that the tree hangs on, 0: none */
} graph;

static bool core(int body) {
    return body < LINKS;
}

static int root(const graph *g, int body) {
    while (g->parent[body] != body) /* halves the way each time */
        body = g->parent[body] = g->parent[g->parent[body]];
    return body;
}

static void join(const graph *g, int a, int b) {
    if (!core(a) && !core(b)) g->parent[root(g, a)] = root(g, b);
}

/* false: this joint holds two bodies of the core together */
static bool attach(const graph *g, int a, int b) {
    if (core(a) && core(b)) return false;
    if (core(a) == core(b)) return true;
    int inner = core(a) ? a : b, *hangs_on = &g->attached[root(g, core(a) ? b : a)];
    if (*hangs_on == 0) *hangs_on = 2 + inner; /* the ground is -1 */
    return *hangs_on == 2 + inner;
}

/* The joint that takes freedom from the six-bar's platform, so that its inverse kinematics does not
   hold: a driver of a hinge, or a joint that, alone or through further bodies, holds two of the
   six-bar's bodies (or the ground) together. What merely rides on one of them takes none.
   Output: its id, NULL when there is none. Cost linear in joints. Test: test_required.c riders. */
fw_status fw_workspace_six_bar_foreign_joint(fw_arena *arena, const fw_mechanism *m,
                                             const char **id) {
    fw_mark mark = fw_arena_mark(arena);
    graph g = {.m = m};
    FW_NEED(g.parent = fw_arena_array(arena, int, (size_t)m->nbody));
    FW_NEED(g.attached = fw_arena_array(arena, int, (size_t)m->nbody));
    *id = NULL;
    for (int i = 0; i < m->nbody; i++)
        g.parent[i] = i;
    for (int i = FW_SIX; i < m->npin; i++)
        join(&g, m->pin[i].body_a, m->pin[i].body_b);
    for (int i = 0; i < m->njoint; i++)
        join(&g, m->joint[i].body_a, m->joint[i].body_b);
    for (int i = FW_SIX; i < m->npin && !*id; i++)
        if (!attach(&g, m->pin[i].body_a, m->pin[i].body_b)) *id = m->pin[i].id;
    for (int i = 0; i < m->njoint && !*id; i++)
        if (!attach(&g, m->joint[i].body_a, m->joint[i].body_b)) *id = m->joint[i].id;
    for (int i = 0; i < m->ndriver && !*id; i++)
        if (m->driver[i].revolute != FW_NONE && m->driver[i].revolute < FW_SIX)
            *id = m->driver[i].id;
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

static double wrapped(double angle_rad) {
    return remainder(angle_rad, 2.0 * FW_PI);
}

static fw_workspace_dyad dyad(fw_geometry_vec2 o, fw_geometry_vec2 elbow, fw_geometry_vec2 q) {
    double ux = elbow.x - o.x, uy = elbow.y - o.y, wx = q.x - elbow.x, wy = q.y - elbow.y;
    double cross = ux * wy - uy * wx, dot = ux * wx + uy * wy;
    return (fw_workspace_dyad){.base = o,
                               .l_m = hypot(ux, uy),
                               .m_m = hypot(wx, wy),
                               .alpha0_rad = atan2(uy, ux),
                               .beta0_rad = atan2(cross, dot),
                               .sign = cross < 0.0 ? -1.0 : 1.0};
}

bool fw_workspace_six_bar_set_up(const fw_mechanism *m, fw_workspace_six_bar *out) {
    if (!m->device->six_bar || m->npin < FW_SIX || m->nbody < 5) return false;
    fw_geometry_vec2 p[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        p[i] = fw_mechanism_pin_place(m, &m->pin[i], 0);
    const fw_mechanism_mass *platform = &m->body[2];
    *out = (fw_workspace_six_bar){.left = dyad(p[0], p[1], p[2]), .right = dyad(p[5], p[4], p[3])};
    out->centre = (fw_geometry_vec2){platform->x_m, platform->y_m};
    out->to_c = (fw_geometry_vec2){p[2].x - platform->x_m, p[2].y - platform->y_m};
    out->to_d = (fw_geometry_vec2){p[3].x - platform->x_m, p[3].y - platform->y_m};
    for (int i = 0; i < FW_SIX; i++) { /* rotation already there in the drawn pose */
        const fw_mechanism_pin *pin = &m->pin[i];
        double a = pin->body_a == FW_GROUND ? 0.0 : m->body[pin->body_a].phi_rad;
        double b = pin->body_b == FW_GROUND ? 0.0 : m->body[pin->body_b].phi_rad;
        out->start_rad[i] = b - a - pin->free_angle_rad;
    }
    return true;
}

/* elbow:  beta = +-acos((d^2 - l^2 - m^2)/(2 l m)), base: alpha = ang(v) - atan2(m sin b, l + m cos
   b) out: rotations of the two links from the drawn pose; false when d is out of [|l-m|, l+m] */
static bool solve_dyad(const fw_workspace_dyad *k, fw_geometry_vec2 q, double *base_rad,
                       double *elbow_rad) {
    double vx = q.x - k->base.x, vy = q.y - k->base.y;
    double cosine = (vx * vx + vy * vy - k->l_m * k->l_m - k->m_m * k->m_m) / (2 * k->l_m * k->m_m);
    if (!(fabs(cosine) <= 1.0)) return false;
    double beta = k->sign * acos(cosine);
    double alpha = atan2(vy, vx) - atan2(k->m_m * sin(beta), k->l_m + k->m_m * cos(beta));
    *base_rad = wrapped(alpha - k->alpha0_rad);
    *elbow_rad = wrapped(beta - k->beta0_rad);
    return true;
}

/* two RRR dyads O-l-m to Q (O = A, Q = C and O = F, Q = D), branch of the drawn position
   in: displacement of the platform's centre (m) and its rotation (rad); out: phi_b - phi_a - free
   angle of A..F (6), rad; exact up to rounding (1e-15), cost two acos and four atan2 source:
   docs/theory/workspace.md; test_inverse.c reference_poses */
bool fw_workspace_six_bar_solve(const fw_workspace_six_bar *k, double x_m, double y_m,
                                double phi_rad, double angle_rad[FW_SIX], int *leg) {
    double c = cos(phi_rad), s = sin(phi_rad);
    fw_geometry_vec2 centre = {k->centre.x + x_m, k->centre.y + y_m};
    fw_geometry_vec2 at_c = {centre.x + c * k->to_c.x - s * k->to_c.y,
                             centre.y + s * k->to_c.x + c * k->to_c.y};
    fw_geometry_vec2 at_d = {centre.x + c * k->to_d.x - s * k->to_d.y,
                             centre.y + s * k->to_d.x + c * k->to_d.y};
    double a, b, f, e;
    *leg = 0;
    if (!solve_dyad(&k->left, at_c, &a, &b)) return false;
    *leg = 1;
    if (!solve_dyad(&k->right, at_d, &f, &e)) return false;
    /* Left leg counts from the ground up, right leg from the platform down. The elbow keeps its side, so that within half
       a turn of the first link all of a turn of the platform is in its own hinge. */
    const double turn[FW_SIX] = {a, b, phi_rad - a - b, -(phi_rad - f - e), -e, -f};
    for (int i = 0; i < FW_SIX; i++)
        angle_rad[i] = turn[i] + k->start_rad[i];
    return true;
}

bool fw_workspace_six_bar_inverse(const fw_mechanism *m, double x_m, double y_m, double phi_rad,
                                  double angle_rad[FW_SIX], int *leg) {
    fw_workspace_six_bar k;
    *leg = 0;
    return fw_workspace_six_bar_set_up(m, &k) &&
           fw_workspace_six_bar_solve(&k, x_m, y_m, phi_rad, angle_rad, leg);
}

/* ---- over boxes of poses ---- */

FW_CENTRED fw_workspace_centred2 plus(fw_workspace_centred2 a, fw_workspace_centred2 b) {
    return (fw_workspace_centred2){fw_centred_add(a.x, b.x), fw_centred_add(a.y, b.y)};
}

FW_CENTRED fw_workspace_centred2 minus(fw_workspace_centred2 a, fw_workspace_centred2 b) {
    return (fw_workspace_centred2){fw_centred_sub(a.x, b.x), fw_centred_sub(a.y, b.y)};
}

FW_CENTRED fw_maths_centred dot(fw_workspace_centred2 a, fw_workspace_centred2 b) {
    return fw_centred_add(fw_centred_mul(a.x, b.x), fw_centred_mul(a.y, b.y));
}

FW_CENTRED fw_maths_centred cross(fw_workspace_centred2 a, fw_workspace_centred2 b) {
    return fw_centred_sub(fw_centred_mul(a.x, b.y), fw_centred_mul(a.y, b.x));
}

FW_CENTRED fw_workspace_centred2 quarter(fw_workspace_centred2 a) { /* J a */
    return (fw_workspace_centred2){fw_centred_negated(a.y), a.x};
}

FW_CENTRED fw_workspace_centred2 exactly(fw_geometry_vec2 p) {
    return (fw_workspace_centred2){fw_centred_exact(p.x), fw_centred_exact(p.y)};
}

FW_CENTRED fw_workspace_centred2 rotated(fw_geometry_vec2 p, fw_maths_centred s,
                                         fw_maths_centred c) {
    return (fw_workspace_centred2){
        fw_centred_sub(fw_centred_scaled(c, p.x), fw_centred_scaled(s, p.y)),
        fw_centred_add(fw_centred_scaled(s, p.x), fw_centred_scaled(c, p.y))};
}

/* ---- the mechanism ---- */

static fw_geometry_vec2 from_to(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return (fw_geometry_vec2){b.x - a.x, b.y - a.y};
}

static fw_workspace_leg leg_of(fw_geometry_vec2 o, fw_geometry_vec2 elbow, fw_geometry_vec2 q,
                               fw_geometry_vec2 centre) {
    fw_workspace_leg leg = {.base = o, .a = from_to(o, elbow), .b = from_to(elbow, q)};
    leg.to = from_to(centre, q);
    leg.a2 = dot(exactly(leg.a), exactly(leg.a));
    leg.b2 = dot(exactly(leg.b), exactly(leg.b));
    fw_maths_interval side = fw_centred_range(cross(exactly(leg.a), exactly(leg.b)));
    leg.sign = side.lo > 0.0 ? 1.0 : side.hi < 0.0 ? -1.0 : 0.0;
    return leg;
}

static bool loop_make(const fw_geometry_vec2 p[FW_SIX], fw_geometry_vec2 centre,
                      const double start_rad[FW_SIX], fw_workspace_loop *out) {
    *out = (fw_workspace_loop){
        .leg = {leg_of(p[0], p[1], p[2], centre), leg_of(p[5], p[4], p[3], centre)},
        .centre = centre};
    for (int i = 0; i < FW_SIX; i++)
        out->start_rad[i] = start_rad[i];
    return out->leg[0].sign != 0.0 && out->leg[1].sign != 0.0;
}

bool fw_workspace_loop_set_up(const fw_mechanism *m, fw_workspace_loop *out) {
    fw_workspace_six_bar k;
    if (!fw_workspace_six_bar_set_up(m, &k)) return false;
    fw_geometry_vec2 p[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        p[i] = fw_mechanism_pin_place(m, &m->pin[i], 0);
    return loop_make(p, k.centre, k.start_rad, out);
}

static double sense(int hinge) {
    return hinge < 3 ? 1.0 : -1.0;
}

fw_maths_interval fw_workspace_loop_psi_range(const fw_workspace_loop *k, int hinge,
                                              fw_maths_interval angle) {
    fw_maths_interval turn = fw_interval_sub(angle, fw_interval_point(k->start_rad[hinge]));
    return sense(hinge) > 0.0 ? turn : fw_interval_negated(turn);
}

fw_maths_interval fw_workspace_loop_angle_range(const fw_workspace_loop *k, int hinge,
                                                fw_maths_interval psi) {
    fw_maths_interval turn = sense(hinge) > 0.0 ? psi : fw_interval_negated(psi);
    return fw_interval_add(turn, fw_interval_point(k->start_rad[hinge]));
}

/* ---- forms ---- */

/* at the middle of the box */
FW_CENTRED fw_maths_interval middle_of(fw_maths_centred a) {
    return (fw_maths_interval){fw_down(a.m - a.e), fw_up(a.m + a.e)};
}

/* f(c + d) = f(c) + g(c).d within sum |d_i| (g_i.e + g_i.r)/2 (maths_interval.h) */
FW_CENTRED fw_workspace_form form(fw_maths_interval at, const fw_maths_centred *grad, int n,
                                  const double half[3]) {
    fw_workspace_form f = {.at = at};
    for (int i = 0; i < n; i++) {
        f.grad[i] = grad[i].m;
        f.rest += half[i] * 0.5 * (grad[i].e + grad[i].r);
    }
    f.rest = fw_grown(f.rest);
    return f;
}

/* ---- one leg ---- */

static const fw_maths_interval any = {-(double)INFINITY, (double)INFINITY};

typedef struct coordinates { /* of the box: how the platform depends on them */
    int n;
    double turns[3]; /* d phi / d coordinate: 0 or 1 */
    double half[3];
} coordinates;

/* A dyad O-a-b to Q, with k = (1 + (|a|^2 - |b|^2)/d^2)/2, h^2 = |a|^2/d^2 - k^2, v = Q - O, d =
   |v|: a = k v + h J v,  b = v - a,  a x b = -h d^2,  h of the sign opposite to the branch's
   Rotations of both links from the drawn pose are those of a and b; with Q' the derivative of Q
     a' = (Q'.b)/(a x b),  b' = -(Q'.a)/(a x b)
   in: Q, Q' (n); out: psi of the leg's three hinges (base, elbow, platform), rad, the elbow's
   place, a x b. Error: proved by maths_interval.h. Out of reach where h^2 < 0. Cost about 80
   centred operations, 20 where only the reach is wanted. Source: the velocity of Q = O + a + b,
   dotted with b and with a. Test: test_loop.c.
 */
FW_CENTRED fw_workspace_reached solve(const fw_workspace_leg *leg, fw_workspace_centred2 q,
                                      const fw_workspace_centred2 *dq, const coordinates *on,
                                      fw_maths_centred phi, fw_maths_interval d2_allowed,
                                      unsigned wanted, fw_workspace_form *reach,
                                      fw_workspace_form psi[3], fw_workspace_centred2 *elbow,
                                      fw_maths_centred *side) {
    const unsigned legs = FW_WANT_D | FW_WANT_F | FW_WANT_REST;
    fw_workspace_centred2 v = minus(q, exactly(leg->base));
    fw_maths_centred d2 = dot(v, v), of_a[3], of_b[3], grad[3];
    if (wanted & FW_WANT_E) {
        for (int i = 0; i < on->n; i++)
            grad[i] = fw_centred_scaled(dot(v, dq[i]), 2.0);
        *reach = form(middle_of(d2), grad, on->n, on->half);
        fw_maths_interval range = fw_form_range(reach, on->half);
        if (range.hi < d2_allowed.lo || range.lo > d2_allowed.hi) return FW_OUT_OF_REACH;
    }
    if (!(wanted & (legs | FW_WANT_BRANCH))) return FW_REACHED;
    fw_maths_centred inverse = fw_centred_inverse(d2);
    fw_maths_centred k =
        fw_centred_scaled(fw_centred_add(fw_centred_exact(1.0),
                                         fw_centred_mul(fw_centred_sub(leg->a2, leg->b2), inverse)),
                          0.5);
    fw_maths_centred h2 = fw_centred_sub(fw_centred_mul(leg->a2, inverse), fw_centred_mul(k, k));
    if (h2.m + h2.r < 0.0) return FW_OUT_OF_REACH;
    if (!(h2.m - h2.r > 0.0)) return FW_MAY_BE_OUT;
    if (!(wanted & legs)) return FW_REACHED;
    fw_maths_centred h = fw_centred_scaled(fw_centred_sqrt(h2), -leg->sign);
    fw_workspace_centred2 jv = quarter(v);
    fw_workspace_centred2 a = {fw_centred_add(fw_centred_mul(k, v.x), fw_centred_mul(h, jv.x)),
                               fw_centred_add(fw_centred_mul(k, v.y), fw_centred_mul(h, jv.y))};
    fw_workspace_centred2 b = minus(v, a), a0 = exactly(leg->a), b0 = exactly(leg->b);
    *side = fw_centred_negated(fw_centred_mul(h, d2));
    *elbow = plus(exactly(leg->base), a);
    fw_maths_centred gain = fw_centred_inverse(*side);
    fw_maths_interval turn_a = any, turn_b = any;
    if (wanted & (FW_WANT_F | FW_WANT_REST)) {
        for (int i = 0; i < on->n; i++)
            of_a[i] = fw_centred_mul(dot(dq[i], b), gain);
        turn_a = fw_centred_direction(cross(a0, a), dot(a0, a));
        psi[0] = form(turn_a, of_a, on->n, on->half);
    }
    if (wanted & (FW_WANT_D | FW_WANT_REST)) {
        for (int i = 0; i < on->n; i++) {
            of_b[i] = fw_centred_negated(fw_centred_mul(dot(dq[i], a), gain));
            grad[i] = fw_centred_sub(fw_centred_exact(on->turns[i]), of_b[i]);
        }
        turn_b = fw_centred_direction(cross(b0, b), dot(b0, b));
        psi[2] = form(fw_interval_sub(middle_of(phi), turn_b), grad, on->n, on->half);
    }
    if (wanted & FW_WANT_REST) {
        for (int i = 0; i < on->n; i++)
            grad[i] = fw_centred_sub(of_b[i], of_a[i]);
        psi[1] = form(fw_interval_sub(turn_b, turn_a), grad, on->n, on->half);
    }
    return FW_REACHED;
}

/* platform hinge Q of a leg at the pose: T + R(phi) to, and its derivatives by x, y, phi */
FW_CENTRED fw_workspace_centred2 platform_hinge(const fw_workspace_leg *leg,
                                                fw_workspace_centred2 at, fw_maths_centred s,
                                                fw_maths_centred c, fw_workspace_centred2 dq[3]) {
    fw_workspace_centred2 arm = rotated(leg->to, s, c);
    dq[0] = exactly((fw_geometry_vec2){1.0, 0.0});
    dq[1] = exactly((fw_geometry_vec2){0.0, 1.0});
    dq[2] = quarter(arm);
    return plus(at, arm);
}

void fw_workspace_loop_pose_box(const fw_workspace_loop *k, const fw_workspace_box3 *box,
                                fw_workspace_loop_box *out) {
    coordinates on = {.n = 3, .turns = {0.0, 0.0, 1.0}};
    fw_maths_centred axis[3], s, c;
    for (int i = 0; i < 3; i++) {
        double middle = fw_box3_middle(box, i, &on.half[i]);
        axis[i] = fw_centred_axis(middle, on.half[i]);
    }
    fw_centred_turn(axis[2], &s, &c);
    out->place = (fw_workspace_centred2){axis[0], axis[1]};
    out->phi = axis[2];
    fw_workspace_centred2 at = plus(exactly(k->centre), out->place), dq[3];
    out->reached = FW_REACHED;
    for (int side = 0; side < 2; side++) {
        const fw_workspace_leg *leg = &k->leg[side];
        fw_workspace_form psi[3];
        int base = side ? 5 : 0, step = side ? -1 : 1;
        fw_workspace_centred2 q = platform_hinge(leg, at, s, c, dq);
        out->hinge[base] = exactly(leg->base);
        out->hinge[base + 2 * step] = q;
        fw_workspace_reached now = solve(leg, q, dq, &on, axis[2], any, FW_WANT_ALL, &out->d2[side],
                                         psi, &out->hinge[base + step], &out->cross[side]);
        for (int i = 0; i < 3 && now == FW_REACHED; i++)
            out->psi[base + i * step] = psi[i];
        if (now == FW_REACHED || out->reached == FW_OUT_OF_REACH) continue;
        out->reached = now;
        out->leg = side;
    }
}

/* ---- boxes of the left leg's rotations ---- */

/* where hinges and platform are, the left links turned: C = A + a + b, the platform's centre of
   mass C - to_c */
FW_CENTRED void places(const fw_workspace_loop *k, const coordinates *on, fw_workspace_centred2 a,
                       fw_workspace_centred2 at_c, fw_workspace_centred2 ja,
                       fw_workspace_centred2 jb, fw_workspace_centred2 to_c,
                       fw_workspace_loop_box *out) {
    fw_workspace_centred2 jc = quarter(to_c), dt[3], none = exactly((fw_geometry_vec2){0.0, 0.0});
    dt[2] = (fw_workspace_centred2){fw_centred_negated(jc.x), fw_centred_negated(jc.y)};
    dt[1] = plus(jb, on->n == 3 ? dt[2] : none);
    dt[0] = plus(ja, dt[1]);
    out->hinge[0] = exactly(k->leg[0].base);
    out->hinge[1] = plus(exactly(k->leg[0].base), a);
    out->hinge[2] = at_c;
    out->hinge[5] = exactly(k->leg[1].base);
    out->place = minus(minus(at_c, to_c), exactly(k->centre));
    fw_maths_centred x[3], y[3], one[3];
    for (int i = 0; i < on->n; i++)
        x[i] = dt[i].x, y[i] = dt[i].y, one[i] = fw_centred_exact(on->turns[i]);
    out->extent[0] = form(middle_of(out->place.x), x, on->n, on->half);
    out->extent[1] = form(middle_of(out->place.y), y, on->n, on->half);
    out->extent[2] = form(middle_of(out->phi), one, on->n, on->half);
}

/* C and D for rotations of the three left links, their derivatives by the coordinates. With the
   platform's rotation given (a slice) it does not depend on them. */
FW_CENTRED void from_joints(const fw_workspace_loop *k, const coordinates *on,
                            const fw_maths_centred turn[3], fw_maths_interval d2_m2,
                            unsigned wanted, fw_workspace_loop_box *out) {
    fw_maths_centred s, c;
    const fw_workspace_leg *left = &k->leg[0], *right = &k->leg[1];
    fw_centred_turn(turn[0], &s, &c);
    fw_workspace_centred2 a = rotated(left->a, s, c);
    fw_centred_turn(turn[1], &s, &c);
    fw_workspace_centred2 b = rotated(left->b, s, c);
    fw_centred_turn(turn[2], &s, &c);
    fw_workspace_centred2 platform = rotated(from_to(left->to, right->to), s, c);
    fw_workspace_centred2 at_c = plus(plus(exactly(left->base), a), b), at_d = plus(at_c, platform);
    fw_workspace_centred2 ja = quarter(a), jb = quarter(b), dq[3],
                          none = exactly((fw_geometry_vec2){0.0, 0.0});
    /* coordinates A, B, C turn the links from there on; a slice's platform does not turn */
    dq[2] = quarter(platform);
    dq[1] = plus(jb, on->n == 3 ? dq[2] : none);
    dq[0] = plus(ja, dq[1]);
    out->phi = turn[2];
    out->cross[0] = cross(a, b);
    out->hinge[3] = at_d;
    if (wanted & FW_WANT_REST) places(k, on, a, at_c, ja, jb, rotated(left->to, s, c), out);
    fw_workspace_form psi[3];
    out->leg = 1;
    out->reached = solve(right, at_d, dq, on, turn[2], d2_m2, wanted, &out->d2[1], psi,
                         &out->hinge[4], &out->cross[1]);
    if (out->reached != FW_REACHED) return;
    if (wanted & (FW_WANT_F | FW_WANT_REST)) out->psi[5] = psi[0];
    if (wanted & FW_WANT_REST) out->psi[4] = psi[1];
    if (wanted & (FW_WANT_D | FW_WANT_REST)) out->psi[3] = psi[2];
}

fw_maths_centred fw_workspace_loop_left_cross(const fw_workspace_loop *k, double c, double half) {
    fw_maths_centred sine, cosine;
    fw_centred_turn(fw_centred_axis(c, half), &sine, &cosine);
    return cross(exactly(k->leg[0].a), rotated(k->leg[0].b, sine, cosine));
}

void fw_workspace_loop_joint_box(const fw_workspace_loop *k, const fw_workspace_box3 *box,
                                 fw_maths_interval d2_m2, unsigned wanted,
                                 fw_workspace_loop_box *out) {
    coordinates on = {.n = 3, .turns = {1.0, 1.0, 1.0}};
    fw_maths_centred axis[3], turn[3];
    for (int i = 0; i < 3; i++) {
        double middle = fw_box3_middle(box, i, &on.half[i]);
        axis[i] = fw_centred_axis(middle, on.half[i]);
        turn[i] = i ? fw_centred_add(turn[i - 1], axis[i]) : axis[i];
        out->psi[i] =
            (fw_workspace_form){.at = fw_interval_point(middle), .grad = {i == 0, i == 1, i == 2}};
    }
    from_joints(k, &on, turn, d2_m2, wanted, out);
}

void fw_workspace_loop_slice_box(const fw_workspace_loop *k, const fw_workspace_box3 *box,
                                 double phi_rad, fw_maths_interval d2_m2, unsigned wanted,
                                 fw_workspace_loop_box *out) {
    coordinates on = {.n = 2};
    fw_maths_centred axis[2], turn[3];
    for (int i = 0; i < 2; i++) {
        double middle = fw_box3_middle(box, i, &on.half[i]);
        axis[i] = fw_centred_axis(middle, on.half[i]);
        out->psi[i] =
            (fw_workspace_form){.at = fw_interval_point(middle), .grad = {i == 0, i == 1}};
    }
    turn[0] = axis[0];
    turn[1] = fw_centred_add(axis[0], axis[1]);
    turn[2] = fw_centred_exact(phi_rad);
    out->psi[2] =
        (fw_workspace_form){.at = fw_interval_sub(fw_interval_point(phi_rad), middle_of(turn[1])),
                            .grad = {-1.0, -1.0}};
    from_joints(k, &on, turn, d2_m2, wanted, out);
}

/* ---- what the limits of the six hinges say of the rotations and of the right leg's reach ---- */

fw_workspace_reach_limits fw_workspace_limits_symmetric(const double limit_rad[FW_SIX]) {
    fw_workspace_reach_limits l;
    for (int i = 0; i < FW_SIX; i++)
        l.high_rad[i] = limit_rad[i], l.low_rad[i] = -limit_rad[i];
    return l;
}

/* The elbow turns on the side of its drawn branch only: from b by psi, with a x R(psi) b of that
   sign. Where a limit lets it pass the stretched or folded leg, the range ends there, rounded
   outward. */
static fw_workspace_bound on_branch(const fw_workspace_leg *leg, fw_workspace_bound psi) {
    double along = leg->a.x * leg->b.x + leg->a.y * leg->b.y;
    double side = leg->a.x * leg->b.y - leg->a.y * leg->b.x, elbow = atan2(side, along);
    double half = 0.5 * FW_TURN, slack = 1e-14;
    double lo = leg->sign > 0.0 ? -elbow : -half - elbow;
    double hi = leg->sign > 0.0 ? half - elbow : -elbow;
    if (psi.low.lo < lo) psi.low = (fw_maths_interval){lo - slack, lo + slack};
    if (psi.high.hi > hi) psi.high = (fw_maths_interval){hi - slack, hi + slack};
    return psi;
}

/* |O Q|^2 with the elbow turned by psi: |a|^2 + |b|^2 + 2 (cos psi a.b - sin psi a x b) */
static fw_maths_interval reach2(const fw_workspace_leg *leg, fw_maths_interval psi) {
    fw_maths_interval ax = fw_interval_point(leg->a.x), ay = fw_interval_point(leg->a.y);
    fw_maths_interval bx = fw_interval_point(leg->b.x), by = fw_interval_point(leg->b.y);
    fw_maths_interval along =
        fw_interval_add(fw_maths_interval_mul(ax, bx), fw_maths_interval_mul(ay, by));
    fw_maths_interval side =
        fw_interval_sub(fw_maths_interval_mul(ax, by), fw_maths_interval_mul(ay, bx));
    fw_maths_interval both =
        fw_interval_sub(fw_maths_interval_mul(fw_maths_interval_cos(psi), along),
                        fw_maths_interval_mul(fw_maths_interval_sin(psi), side));
    return fw_interval_add(fw_interval_add(fw_centred_range(leg->a2), fw_centred_range(leg->b2)),
                           fw_interval_add(both, both));
}

fw_workspace_allowed fw_workspace_limits_allow(const fw_workspace_loop *k,
                                               const fw_workspace_reach_limits *l) {
    fw_workspace_allowed out;
    for (int i = 0; i < FW_SIX; i++) {
        fw_maths_interval low = fw_workspace_loop_psi_range(k, i, fw_interval_point(l->low_rad[i]));
        fw_maths_interval high =
            fw_workspace_loop_psi_range(k, i, fw_interval_point(l->high_rad[i]));
        out.psi[i] = i < 3 ? (fw_workspace_bound){low, high} : (fw_workspace_bound){high, low};
    }
    out.psi[1] = on_branch(&k->leg[0], out.psi[1]);
    /* the right leg's elbow counts from the ground up, as psi does */
    const fw_workspace_leg *right = &k->leg[1];
    fw_workspace_bound elbow = on_branch(right, out.psi[4]);
    fw_maths_interval at_low = reach2(right, elbow.low), at_high = reach2(right, elbow.high);
    out.d2 = right->sign > 0.0 ? (fw_workspace_bound){at_high, at_low}
                               : (fw_workspace_bound){at_low, at_high};
    return out;
}

fw_workspace_box3 fw_workspace_reach_whole(const fw_workspace_loop *k,
                                           const fw_workspace_allowed *allowed) {
    (void)k;
    fw_workspace_box3 box;
    for (int i = 0; i < 3; i++)
        box.lo[i] = allowed->psi[i].low.lo, box.hi[i] = allowed->psi[i].high.hi;
    return box;
}
