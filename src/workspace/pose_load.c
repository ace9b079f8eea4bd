/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics of the six-bar over a box of poses. With m_i = K_i theta_i, f_k the outer force on body
   k and M_k its moment about hinge B (links AB, BC) or E (links EF, DE), the moments about the
   elbows of both links of a leg give the leg's force at the ground,

     a x R_A = m_B - m_A + M_AB,   b x R_A = m_C - m_B + M_BC - b x (f_AB + f_BC),
     R_A = ((a x R_A) b - (b x R_A) a)/(a x b),   R_B = R_A + f_AB,   R_C = R_B + f_BC

   and of the right leg, counted down from the platform,

     a x R_F = m_E - m_F - M_EF,   b x R_F = m_D - m_E - M_DE + b x (f_DE + f_EF),
     R_E = R_F - f_EF,   R_D = R_E - f_DE.

   Linear in the moments and in the actuators' sizes; the three equations of the platform give
   these sizes (Cramer). What is given (springs, weight, contacts) counts with the moments, and so does friction, of either
   sign.
   in: box m, rad; out: N. Error: proved by maths_interval.h. Cost about 10 us and 3 us a grip. Source: docs/theory/workspace.md. Test: test_pose_strain.c. */
#include "workspace/pose_load.h"
#include <math.h>
#include <string.h>

/* ---- where everything is ---- */

static const double legs_sense[2] = {1.0, -1.0};

/* angle of the vector w from w0, both of the same length, its derivatives given */
static fw_workspace_jet angle_from(fw_geometry_vec2 w0, fw_workspace_jet2 w,
                                   const fw_workspace_jet d[3], const double half[3]) {
    fw_workspace_jet2 from = fw_jet2_exact(w0.x, w0.y);
    fw_workspace_jet sine = fw_jet2_cross(from, w), cosine = fw_jet2_dot(from, w), out;
    fw_maths_interval at = fw_centred_direction(sine.v, cosine.v);
    out.v.m = 0.5 * (at.lo + at.hi);
    out.v.e = fw_grown(fmax(at.hi - out.v.m, out.v.m - at.lo));
    out.v.r = (double)INFINITY;
    for (int i = 0; i < 3; i++)
        out.d[i] = d[i].v;
    return fw_jet_tight(out, half);
}

static fw_workspace_jet2 over_length2(fw_geometry_vec2 w0, fw_workspace_jet2 w,
                                      fw_maths_centred inverse) {
    fw_workspace_jet2 from = fw_jet2_exact(w0.x, w0.y);
    fw_workspace_jet k = {.v = inverse};
    return (fw_workspace_jet2){fw_jet_mul(fw_jet2_dot(from, w), k),
                               fw_jet_mul(fw_jet2_cross(from, w), k)};
}

/* both links of one leg to the platform hinge q (loop.c), and their rotations; false: may be out of
   reach */
static bool leg_over(const fw_workspace_leg *leg, int side, fw_workspace_jet2 q,
                     const fw_workspace_jet2 dq[3], fw_workspace_jet phi,
                     fw_workspace_pose_load *o) {
    fw_workspace_jet2 v = fw_jet2_sub(q, fw_jet2_exact(leg->base.x, leg->base.y));
    fw_workspace_jet d2 = fw_jet2_dot(v, v), inverse = fw_jet_inverse(d2);
    fw_workspace_jet a2 = {.v = leg->a2}, b2 = {.v = leg->b2};
    fw_workspace_jet k =
        fw_jet_scaled(fw_jet_add(fw_jet_exact(1.0), fw_jet_mul(fw_jet_sub(a2, b2), inverse)), 0.5);
    fw_workspace_jet h2 =
        fw_jet_tight(fw_jet_sub(fw_jet_mul(a2, inverse), fw_jet_mul(k, k)), o->half);
    if (!(h2.v.m - h2.v.r > 0.0)) return false;
    fw_workspace_jet h = fw_jet_scaled(fw_jet_sqrt(h2), -leg->sign);
    fw_workspace_jet2 a = fw_jet2_add(fw_jet2_times(v, k), fw_jet2_times(fw_jet2_quarter(v), h));
    a.x = fw_jet_tight(a.x, o->half), a.y = fw_jet_tight(a.y, o->half);
    fw_workspace_jet2 b = fw_jet2_sub(v, a);
    b.x = fw_jet_tight(b.x, o->half), b.y = fw_jet_tight(b.y, o->half);
    o->a[side] = a, o->b[side] = b;
    o->gain[side] = fw_jet_tight(fw_jet_negated(fw_jet_inverse(fw_jet_mul(h, d2))), o->half);
    if (!isfinite(o->gain[side].v.r)) return false;
    fw_workspace_jet of_a[3], of_b[3];
    for (int i = 0; i < 3; i++) { /* loop.c: of the rotations of both links */
        of_a[i] = fw_jet_mul(fw_jet2_dot(dq[i], b), o->gain[side]);
        of_b[i] = fw_jet_negated(fw_jet_mul(fw_jet2_dot(dq[i], a), o->gain[side]));
    }
    fw_workspace_jet first = angle_from(leg->a, a, of_a, o->half),
                     second = angle_from(leg->b, b, of_b, o->half);
    const int base = side ? 5 : 0, step = side ? -1 : 1;
    double s = legs_sense[side];
    o->theta[base] = fw_jet_scaled(first, s);
    o->theta[base + step] = fw_jet_scaled(fw_jet_sub(second, first), s);
    o->theta[base + 2 * step] = fw_jet_scaled(fw_jet_sub(phi, second), s);
    o->turn[side ? 4 : 0] = over_length2(leg->a, a, fw_centred_inverse(leg->a2));
    o->turn[side ? 3 : 1] = over_length2(leg->b, b, fw_centred_inverse(leg->b2));
    return true;
}

/* half of the sum of two rotations, each below half a turn: (1 + u)/|1 + u|, u = both of them */
static bool half_way(fw_workspace_jet2 a, fw_workspace_jet2 b, const double axis[2],
                     const double half[3], fw_workspace_jet2 *out) {
    fw_workspace_jet2 u = fw_jet2_both(a, b);
    u.x = fw_jet_add(u.x, fw_jet_exact(1.0));
    fw_workspace_jet n2 = fw_jet_tight(fw_jet_scaled(u.x, 2.0), half);
    if (!(n2.v.m - n2.v.r > 1e-6)) return false;
    fw_workspace_jet inverse = fw_jet_inverse(fw_jet_sqrt(n2));
    *out = fw_jet2_turned(fw_jet2_times(u, inverse), axis[0], axis[1]);
    return true;
}

static bool frames(const fw_workspace_hold *hold, fw_workspace_pose_load *o) {
    const fw_workspace_jet2 still = fw_jet2_exact(1.0, 0.0);
    for (int i = 0; i < FW_SIX; i++) {
        if (hold->section[i].n == 0) continue;
        fw_workspace_jet2 lower = i > 0 ? o->turn[i - 1] : still;
        fw_workspace_jet2 upper = i < 5 ? o->turn[i] : still;
        if (!half_way(lower, upper, hold->section[i].axis, o->half, &o->frame[i])) return false;
    }
    return true;
}

/* ---- forces ---- */

typedef struct outer { /* what acts on the five bodies; moments about hold->at */
    fw_workspace_jet2 force[5];
    fw_workspace_jet moment[5];
} outer;

static bool is_zero(const fw_workspace_jet *a) {
    return a->v.m == 0.0 && a->v.r <= 1e-290;
}

/* torques and forces on the links of a leg alone reach its joints */
static bool acts_on(const outer *by, int side) {
    bool any = false;
    for (int i = side ? 3 : 0; i < (side ? 5 : 2); i++)
        any = any || !is_zero(&by->moment[i]) || !is_zero(&by->force[i].x) ||
              !is_zero(&by->force[i].y);
    return any;
}

/* m: to moments of the hinges; by: to outer forces; one of them may be NULL */
static void respond(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                    const fw_workspace_jet *m, const outer *by, fw_workspace_response *out) {
    fw_workspace_jet along[2][2], zero = fw_jet_exact(0.0); /* a x R, b x R of both legs */
    fw_workspace_jet turn = zero;
    for (int side = 0; side < 2; side++)
        along[side][0] = along[side][1] = zero;
    if (m) {
        along[0][0] = fw_jet_sub(m[1], m[0]), along[0][1] = fw_jet_sub(m[2], m[1]);
        along[1][0] = fw_jet_sub(m[4], m[5]), along[1][1] = fw_jet_sub(m[3], m[4]);
        turn = fw_jet_sub(m[3], m[2]);
    }
    if (by) {
        fw_workspace_jet2 left = fw_jet2_add(by->force[0], by->force[1]),
                          right = fw_jet2_add(by->force[3], by->force[4]);
        along[0][0] = fw_jet_add(along[0][0], by->moment[0]);
        along[0][1] =
            fw_jet_add(along[0][1], fw_jet_sub(by->moment[1], fw_jet2_cross(o->b[0], left)));
        along[1][0] = fw_jet_sub(along[1][0], by->moment[4]);
        along[1][1] =
            fw_jet_add(along[1][1], fw_jet_sub(fw_jet2_cross(o->b[1], right), by->moment[3]));
        turn = fw_jet_add(turn, by->moment[2]);
    }
    fw_workspace_jet2 ground[2];
    for (int side = 0; side < 2; side++) {
        fw_workspace_jet2 r = fw_jet2_sub(fw_jet2_times(o->b[side], along[side][0]),
                                          fw_jet2_times(o->a[side], along[side][1]));
        ground[side] = fw_jet2_times(r, o->gain[side]);
        ground[side].x = fw_jet_tight(ground[side].x, o->half);
        ground[side].y = fw_jet_tight(ground[side].y, o->half);
    }
    fw_workspace_jet2 *r = out->force;
    r[0] = r[1] = r[2] = ground[0];
    r[3] = r[4] = r[5] = ground[1];
    if (by) {
        r[1] = fw_jet2_add(r[0], by->force[0]);
        r[2] = fw_jet2_add(r[1], by->force[1]);
        r[4] = fw_jet2_sub(r[5], by->force[4]);
        r[3] = fw_jet2_sub(r[4], by->force[3]);
    }
    fw_workspace_jet2 push = fw_jet2_sub(r[2], r[3]);
    if (by) push = fw_jet2_add(push, by->force[2]);
    turn =
        fw_jet_add(turn, fw_jet_sub(fw_jet2_cross(o->to[0], r[2]), fw_jet2_cross(o->to[1], r[3])));
    out->wrench[0] = push.x, out->wrench[1] = push.y;
    out->wrench[2] = fw_jet_scaled(turn, 1.0 / hold->length_m);
    for (int side = 0; side < 2; side++)
        out->on_leg[side] = m || acts_on(by, side);
}

bool fw_workspace_pose_places(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                              const double *shift, fw_workspace_pose_load *o) {
    const fw_workspace_loop *k = hold->loop;
    fw_workspace_jet axis[3], s, c;
    for (int i = 0; i < 3; i++) {
        double middle = fw_box3_middle(box, i, &o->half[i]);
        axis[i] = fw_jet_exact(middle);
        axis[i].v.r = o->half[i];
        axis[i].d[i].m = 1.0;
    }
    s = c = fw_jet_exact(0.0);
    fw_centred_turn(axis[2].v, &s.v, &c.v);
    s.d[2] = c.v, c.d[2] = fw_centred_negated(s.v);
    o->turn[2] = (fw_workspace_jet2){c, s};
    fw_workspace_jet2 at = {fw_jet_add(fw_jet_exact(k->centre.x), axis[0]),
                            fw_jet_add(fw_jet_exact(k->centre.y), axis[1])};
    for (int side = 0; side < 2; side++) {
        const fw_workspace_leg *leg = &k->leg[side];
        fw_workspace_jet2 arm = fw_jet2_turned(o->turn[2], leg->to.x, leg->to.y);
        if (shift) arm = fw_jet2_add(arm, fw_jet2_exact(shift[2 * side], shift[2 * side + 1]));
        fw_workspace_jet2 dq[3] = {fw_jet2_exact(1.0, 0.0), fw_jet2_exact(0.0, 1.0),
                                   fw_jet2_quarter(arm)};
        o->to[side] = arm;
        if (!leg_over(leg, side, fw_jet2_add(at, arm), dq, axis[2], o)) return false;
    }
    for (int i = 0; i < FW_SIX; i++)
        o->theta[i] = fw_jet_add(o->theta[i], fw_jet_exact(k->start_rad[i]));
    return frames(hold, o);
}

/* ---- actuators ---- */

static fw_workspace_jet2 turn_of(const fw_workspace_pose_load *o, int body) {
    return body == FW_GROUND ? fw_jet2_exact(1.0, 0.0) : o->turn[body];
}

/* from the point that moments of the body are about; of the ground: from the origin */
static fw_workspace_jet2 arm_of(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                                const fw_workspace_body_point *p) {
    if (p->body == FW_GROUND) {
        const fw_geometry_vec2 stands = fw_workspace_on_ground(hold, p->x_m, p->y_m);
        return fw_jet2_exact(stands.x, stands.y);
    }
    fw_geometry_vec2 at = hold->at[p->body];
    return fw_jet2_turned(o->turn[p->body], p->x_m - at.x, p->y_m - at.y);
}

static fw_workspace_jet2 place_of(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                                  const fw_workspace_body_point *p) {
    fw_workspace_jet2 arm = arm_of(hold, o, p);
    if (p->body == FW_GROUND) return arm;
    const fw_workspace_loop *k = hold->loop;
    int side = p->body > 2; /* at: B, B, centre, E, E */
    fw_workspace_jet2 base = fw_jet2_exact(k->leg[side].base.x, k->leg[side].base.y);
    if (p->body != 2) return fw_jet2_add(fw_jet2_add(base, o->a[side]), arm);
    return fw_jet2_add(
        fw_jet2_sub(fw_jet2_add(fw_jet2_add(base, o->a[side]), o->b[side]), o->to[side]), arm);
}

static void push(outer *on, int body, fw_workspace_jet2 arm, fw_workspace_jet2 force) {
    if (body == FW_GROUND) return;
    on->force[body] = fw_jet2_add(on->force[body], force);
    on->moment[body] = fw_jet_add(on->moment[body], fw_jet2_cross(arm, force));
}

static void pull_along(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                       const fw_workspace_actuator *by, outer *on) {
    for (int i = 0; i + 1 < by->npoint; i++) {
        const fw_workspace_body_point *p = &by->point[i], *q = &by->point[i + 1];
        if (p->body == q->body) continue; /* within one body nothing is felt */
        fw_workspace_jet2 way = fw_jet2_sub(place_of(hold, o, q), place_of(hold, o, p));
        fw_workspace_jet n2 = fw_jet_tight(fw_jet2_dot(way, way), o->half);
        fw_workspace_jet2 e = fw_jet2_times(way, fw_jet_inverse(fw_jet_sqrt(n2)));
        push(on, p->body, arm_of(hold, o, p), e);
        push(on, q->body, arm_of(hold, o, q),
             (fw_workspace_jet2){fw_jet_negated(e.x), fw_jet_negated(e.y)});
    }
}

static outer nothing(void) {
    outer on;
    for (int i = 0; i < 5; i++)
        on.force[i] = fw_jet2_exact(0.0, 0.0), on.moment[i] = fw_jet_exact(0.0);
    return on;
}

/* of size 1 */
static void act(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                const fw_workspace_actuator *by, outer *on) {
    switch (by->kind) {
    case FW_ACTUATOR_TORQUE:
        on->moment[by->body] = fw_jet_exact(hold->length_m);
        break;
    case FW_ACTUATOR_FORCE:
        push(on, by->point->body, arm_of(hold, o, by->point),
             fw_jet2_exact(by->direction[0], by->direction[1]));
        break;
    case FW_ACTUATOR_TENDON:
        pull_along(hold, o, by, on);
        break;
    case FW_ACTUATOR_ELECTRODES: {
        fw_workspace_jet2 f =
            fw_jet2_turned(turn_of(o, by->against), by->direction[0], by->direction[1]);
        push(on, by->point->body, arm_of(hold, o, by->point), f);
        if (by->against == FW_GROUND) break;
        fw_geometry_vec2 at = hold->at[by->against];
        const fw_workspace_body_point pivot = {by->against, at.x, at.y};
        fw_workspace_jet2 arm =
            fw_jet2_sub(place_of(hold, o, by->point), place_of(hold, o, &pivot));
        push(on, by->against, arm, (fw_workspace_jet2){fw_jet_negated(f.x), fw_jet_negated(f.y)});
        break;
    }
    }
}

void fw_workspace_pose_response(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                                const fw_workspace_actuator *by, fw_workspace_response *out) {
    outer on = nothing();
    *out = (fw_workspace_response){0};
    if (by->platform) { /* nothing of it reaches a joint by itself */
        if (by->kind == FW_ACTUATOR_TORQUE)
            out->wrench[2] = fw_jet_exact(1.0);
        else
            out->wrench[0] = fw_jet_exact(by->direction[0]),
            out->wrench[1] = fw_jet_exact(by->direction[1]);
        return;
    }
    act(hold, o, by, &on);
    respond(hold, o, NULL, &on, out);
}

/* ---- what is given ---- */

/* 0 where it is not above: nowhere steeper than it was, and somewhere in between of any slope from 0 to that */
static fw_workspace_jet above(fw_workspace_jet a) {
    if (a.v.m - a.v.r >= 0.0) return a;
    if (a.v.m + a.v.r <= 0.0) return fw_jet_exact(0.0);
    a.v.m = fmax(a.v.m, 0.0);
    for (int i = 0; i < 3; i++) {
        double most = fw_grown(fabs(a.d[i].m) + a.d[i].r);
        a.d[i] = (fw_maths_centred){0.5 * a.d[i].m, most, most};
    }
    return a;
}

/* fw_workspace_given_size over the box */
static fw_workspace_jet size_given(const fw_workspace_given *g, fw_workspace_jet l) {
    fw_workspace_jet size =
        fw_jet_scaled(fw_jet_sub(l, fw_jet_exact(g->length_m)), g->stiffness_N_per_m);
    if (g->sense == FW_WHERE_LONGER) return above(size);
    if (g->sense == FW_WHERE_SHORTER) return fw_jet_negated(above(fw_jet_negated(size)));
    return size;
}

/* the way between the two points of what is given */
static fw_workspace_jet2 way_of(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                                const fw_workspace_given *g) {
    const bool cable = g->by.kind == FW_ACTUATOR_TENDON;
    return fw_jet2_sub(place_of(hold, o, cable ? &g->by.point[1] : g->by.point),
                       place_of(hold, o, cable ? &g->by.point[0] : &g->from));
}

static fw_workspace_jet how_much(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                                 const fw_workspace_given *g) {
    if (g->by.kind == FW_ACTUATOR_FORCE) return fw_jet_exact(g->size_N);
    fw_workspace_jet2 way = way_of(hold, o, g);
    if (g->by.kind == FW_ACTUATOR_TENDON) {
        fw_workspace_jet n2 = fw_jet_tight(fw_jet2_dot(way, way), o->half);
        /* what hangs slack may lie on itself, without a direction */
        double far = fw_grown(sqrt(fmax(fw_jet_range(&n2, o->half).hi, 0.0)));
        if (g->sense == FW_WHERE_LONGER && far < g->length_m) return fw_jet_exact(0.0);
        return size_given(g, fw_jet_tight(fw_jet_sqrt(n2), o->half));
    }
    fw_workspace_jet2 n =
        fw_jet2_turned(turn_of(o, g->by.against), g->by.direction[0], g->by.direction[1]);
    return size_given(g, fw_jet_tight(fw_jet2_dot(n, way), o->half));
}

/* A spring without length at rest pulls with k times the way, also where that is 0. */
static void pull_to_nothing(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                            const fw_workspace_given *g, outer *on) {
    fw_workspace_jet2 f = way_of(hold, o, g);
    f.x = fw_jet_scaled(f.x, g->stiffness_N_per_m), f.y = fw_jet_scaled(f.y, g->stiffness_N_per_m);
    const fw_workspace_body_point *p = &g->by.point[0], *q = &g->by.point[1];
    push(on, p->body, arm_of(hold, o, p), f);
    push(on, q->body, arm_of(hold, o, q),
         (fw_workspace_jet2){fw_jet_negated(f.x), fw_jet_negated(f.y)});
}

static void add_given(const fw_workspace_hold *hold, const fw_workspace_pose_load *o, outer *on) {
    for (int k = 0; k < hold->ngiven; k++) {
        const fw_workspace_given *g = &hold->given[k];
        if (g->by.kind == FW_ACTUATOR_TENDON && g->length_m == 0.0 &&
            g->sense != FW_WHERE_SHORTER) {
            pull_to_nothing(hold, o, g, on);
            continue;
        }
        outer one = nothing();
        fw_workspace_jet size = how_much(hold, o, g);
        if (is_zero(&size)) continue;
        act(hold, o, &g->by, &one);
        for (int i = 0; i < 5; i++) {
            on->force[i] = fw_jet2_add(on->force[i], fw_jet2_times(one.force[i], size));
            on->moment[i] = fw_jet_add(on->moment[i], fw_jet_mul(one.moment[i], size));
        }
    }
}

void fw_workspace_pose_own(const fw_workspace_hold *hold, fw_workspace_pose_load *o) {
    outer on = nothing();
    fw_workspace_jet m[FW_SIX];
    for (int i = 0; i < FW_SIX; i++)
        m[i] = fw_jet_scaled(o->theta[i], hold->section[i].spring_Nm_per_rad);
    add_given(hold, o, &on);
    respond(hold, o, m, hold->ngiven > 0 ? &on : NULL, &o->own);
}

bool fw_workspace_pose_load_over(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                                 const double *shift, fw_workspace_pose_load *o) {
    if (!fw_workspace_pose_places(hold, box, shift, o)) return false;
    fw_workspace_pose_own(hold, o);
    return true;
}

/* ---- a grip ---- */

static void cross3(const fw_workspace_jet p[3], const fw_workspace_jet q[3],
                   fw_workspace_jet out[3]) {
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = fw_jet_sub(fw_jet_mul(p[j], q[k]), fw_jet_mul(p[k], q[j]));
    }
}

static fw_workspace_jet dot3(const fw_workspace_jet p[3], const fw_workspace_jet q[3]) {
    return fw_jet_add(fw_jet_add(fw_jet_mul(p[0], q[0]), fw_jet_mul(p[1], q[1])),
                      fw_jet_mul(p[2], q[2]));
}

typedef struct gripping { /* three actuators, that are not all the wrench */
    const fw_workspace_hold *hold;
    const fw_workspace_pose_load *at;
    const fw_workspace_grip *grip;
    const fw_workspace_response *by[3];
    fw_workspace_jet others[3]; /* by[1] x by[2] */
    fw_workspace_jet gain;      /* -1/(by[0] . others) */
} gripping;

static gripping gripping_of(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                            const fw_workspace_response *response, const fw_workspace_grip *grip) {
    gripping g;
    g.hold = hold, g.at = o, g.grip = grip;
    for (int j = 0; j < 3; j++)
        g.by[j] = &response[grip->actuator[j]];
    cross3(g.by[1]->wrench, g.by[2]->wrench, g.others);
    g.gain = fw_jet_tight(dot3(g.by[0]->wrench, g.others), o->half);
    g.gain = fw_jet_negated(fw_jet_inverse(g.gain));
    return g;
}

static bool asked_for(const gripping *g, int j) {
    return g->by[j]->on_leg[0] || g->by[j]->on_leg[1] ||
           g->hold->actuator[g->grip->actuator[j]].pulls;
}

/* how strong the actuator has to be against a response, and what that does to the joints */
static fw_workspace_jet answer(const gripping *g, int j, const fw_workspace_response *to,
                               fw_workspace_jet2 force[FW_SIX]) {
    fw_workspace_jet others[3];
    if (j > 0) cross3(g->by[(j + 1) % 3]->wrench, g->by[(j + 2) % 3]->wrench, others);
    fw_workspace_jet size = fw_jet_tight(
        fw_jet_mul(dot3(to->wrench, j > 0 ? others : g->others), g->gain), g->at->half);
    for (int i = 0; i < FW_SIX; i++)
        if (g->by[j]->on_leg[i > 2])
            force[i] = fw_jet2_add(force[i], fw_jet2_times(g->by[j]->force[i], size));
    return size;
}

/* ---- friction ---- */

static fw_maths_interval length_over(const fw_workspace_jet2 *f, const double half[3]) {
    const fw_maths_interval x = fw_jet_range(&f->x, half), y = fw_jet_range(&f->y, half);
    const double near_x = fmax(fmax(x.lo, -x.hi), 0), near_y = fmax(fmax(y.lo, -y.hi), 0);
    return (fw_maths_interval){fw_down(hypot(near_x, near_y)) * (1 - 1e-15),
                               fw_grown(hypot(fmax(-x.lo, x.hi), fmax(-y.lo, y.hi)))};
}

/* T_j = arm_j (preload_j + |R_j|), |R_j| <= |R0_j| + sum_k T_k |G_kj|: the least solution, by its fixed point, which the
   ends from above are a hair beyond. It has one where friction does not press itself without end. */
static void torques_of(const fw_workspace_hold *h, const double own_N[FW_SIX],
                       const double gain[FW_SIX][FW_SIX], bool above, double torque[FW_SIX]) {
    enum { ROUNDS = 200 };
    double most = 0, change = HUGE_VAL;
    memset(torque, 0, FW_SIX * sizeof *torque);
    for (int round = 0; round < ROUNDS && change > 1e-12 * most; round++) {
        double now[FW_SIX];
        change = most = 0;
        for (int j = 0; j < FW_SIX; j++) {
            double press = h->rub_preload_N[j] + own_N[j];
            for (int k = 0; k < FW_SIX; k++)
                press += torque[k] * gain[k][j];
            now[j] = h->rub_arm_m[j] > 0 ? h->rub_arm_m[j] * press : 0;
            change = fmax(change, fabs(now[j] - torque[j])), most = fmax(most, now[j]);
        }
        memcpy(torque, now, sizeof now);
    }
    for (int j = 0; j < FW_SIX && above; j++)
        torque[j] = change <= 1e-12 * most ? torque[j] * (1 + 1e-9) : HUGE_VAL;
    for (int j = 0; j < FW_SIX; j++)
        if (!(h->rub_arm_m[j] > 0)) torque[j] = 0;
}

static void rub_of(const fw_workspace_hold *h, const fw_workspace_pose_load *o, const gripping *g,
                   const fw_workspace_jet2 force[FW_SIX], fw_workspace_rub *rub) {
    double near_N[FW_SIX], far_N[FW_SIX], less[FW_SIX][FW_SIX] = {{0}},
                                          more[FW_SIX][FW_SIX] = {{0}};
    *rub = (fw_workspace_rub){0};
    for (int k = 0; k < FW_SIX; k++) {
        const fw_maths_interval size = length_over(&force[k], o->half);
        near_N[k] = size.lo, far_N[k] = size.hi;
        rub->rubs[k] = h->rub_arm_m[k] > 0;
        if (!rub->rubs[k]) continue;
        fw_workspace_jet m[FW_SIX];
        fw_workspace_response one;
        for (int i = 0; i < FW_SIX; i++)
            m[i] = fw_jet_exact(i == k);
        respond(h, o, m, NULL, &one);
        memcpy(rub->force[k], one.force, sizeof rub->force[k]);
        for (int j = 0; j < 3 && g; j++)
            if (asked_for(g, j)) rub->size[k][j] = answer(g, j, &one, rub->force[k]);
        for (int i = 0; i < FW_SIX; i++) {
            const fw_maths_interval gain = length_over(&rub->force[k][i], o->half);
            less[k][i] = gain.lo, more[k][i] = gain.hi;
        }
    }
    torques_of(h, near_N, (const double(*)[FW_SIX])less, false, rub->least_Nm);
    torques_of(h, far_N, (const double(*)[FW_SIX])more, true, rub->most_Nm);
    for (int k = 0; k < FW_SIX; k++) {
        if (!rub->rubs[k]) continue;
        for (int i = 0; i < FW_SIX; i++)
            rub->more_N[i] += rub->most_Nm[k] * more[k][i];
        for (int j = 0; j < 3; j++) {
            const fw_maths_interval by = fw_jet_range(&rub->size[k][j], o->half);
            rub->wider[j] += rub->most_Nm[k] * fmax(-by.lo, by.hi);
        }
    }
}

bool fw_workspace_pose_forces(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                              const fw_workspace_response *response, const fw_workspace_grip *grip,
                              bool *certain, bool own[2], fw_workspace_jet2 force[FW_SIX],
                              fw_workspace_rub *rub) {
    fw_workspace_jet size[3];
    *certain = own[0] = own[1] = true;
    for (int i = 0; i < FW_SIX; i++)
        force[i] = o->own.force[i];
    if (grip->wrench) {
        if (hold->rubs) rub_of(hold, o, NULL, force, rub);
        return true;
    }
    const gripping g = gripping_of(hold, o, response, grip);
    for (int j = 0; j < 3; j++) {
        if (!asked_for(&g, j)) continue;
        size[j] = answer(&g, j, &o->own, force);
        for (int side = 0; side < 2; side++)
            own[side] = own[side] && !g.by[j]->on_leg[side];
    }
    if (hold->rubs) rub_of(hold, o, &g, force, rub);
    for (int j = 0; j < 3; j++) {
        if (!hold->actuator[grip->actuator[j]].pulls) continue;
        const double wider = hold->rubs ? rub->wider[j] : 0.0;
        const fw_maths_interval range = fw_jet_range(&size[j], o->half);
        if (range.hi + wider < 0.0) return false;
        if (!(range.lo + wider >= 0.0)) *certain = false;
    }
    return true;
}

void fw_workspace_grip_sizes(const fw_workspace_hold *hold, const fw_workspace_pose_load *o,
                             const fw_workspace_response *response, const fw_workspace_grip *grip,
                             double size[3]) {
    fw_workspace_jet2 unused[FW_SIX];
    size[0] = size[1] = size[2] = 0;
    if (grip->wrench) return;
    const gripping g = gripping_of(hold, o, response, grip);
    memset(unused, 0, sizeof unused);
    for (int j = 0; j < 3; j++)
        if (asked_for(&g, j)) size[j] = answer(&g, j, &o->own, unused).v.m;
}
