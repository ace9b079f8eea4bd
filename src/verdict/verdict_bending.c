/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies are rigid in every model of the motion. What that leaves out is judged by energy: under the
   joint forces of the motion bodies would store at most U_b (body_arms.c), the hinges store U_h. By
   Castigliano the place where a load acts goes further by U_b/U_h, to first order, and a frequency is
   lower by half of it. Theory: docs/theory/verdict.md. Test: test_body_arms.c */
#include "base/text.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- along a motion ---- */

static double turned(const fw_verdict_bending *b, int body) {
    return body == FW_GROUND ? 0 : b->turn[body].rad;
}

/* a hinge that is softer one way than the other by more than this is a strip that bends there */
static const double fw_verdict_strip_bends = 0.1;

/* Across a leaf, N/m. What pulls it makes it stiffer there, guided at both ends by 6/5 of the pull over its length (S. Timoshenko, J. Gere,
   Theory of Elastic Stability, 2nd ed., art. 1.11): of a stage on clamped leaves that is most of what holds it, and is no energy that
   they store. What presses it is left out: it would store more, and bodies be less beside it. */
static double bends_N_per_m(const fw_mechanism_hinge *h, double pull_N) {
    const double k = h->closed_form.kx_N_per_m, guided = 1.2;
    if (h->input.kind != FW_FLEXURE_LEAF || !(pull_N > 0)) return k;
    return k + guided * pull_N / h->input.length_m;
}

/* By its rotation, and by the forces along and across its axis. *moving: what of it lets bodies move: rotation, and
   where the hinge is a strip the deflection across that */
static double of_hinge(const fw_mechanism_hinge *h, const fw_mechanism_pin *pin, double angle_rad,
                       const double force[2], double frame_rad, double *moving) {
    const double energy = 0.5 * pin->stiffness_Nm_per_rad * angle_rad * angle_rad;
    const fw_flexure_result *c = &h->closed_form;
    *moving += energy;
    if (!isfinite(h->axis_rad) || !(c->kx_N_per_m > 0) || !(c->ky_N_per_m > 0)) return energy;
    double x = cos(h->axis_rad + frame_rad), y = sin(h->axis_rad + frame_rad);
    double along = x * force[0] + y * force[1], across = x * force[1] - y * force[0];
    const double pull_N =
        h->first_is_a ? -across : across; /* of a leaf, which lies across its axis */
    const double by_x = 0.5 * along * along / bends_N_per_m(h, pull_N),
                 by_y = 0.5 * across * across / c->ky_N_per_m;
    if (c->kx_N_per_m < fw_verdict_strip_bends * c->ky_N_per_m) *moving += by_x;
    if (c->ky_N_per_m < fw_verdict_strip_bends * c->kx_N_per_m) *moving += by_y;
    return energy + by_x + by_y;
}

/* Forces of all hinges where the sum of their squares is largest so far: at this instant, or between the last three, each
   part by the parabola through them, of which `beside` makes the sum what its own parabola says. The forces of the nearest
   instant would do for the sum, which is flat there; parts of them go up and down, and what tips a device goes with them. */
static void take_hardest(fw_verdict_bending *b, const fw_mechanism *m,
                         const fw_dynamics_instant *now) {
    const int n = 2 * m->nhinge;
    const double at = b->peak->t_s, t0 = b->before_s[0], t1 = b->before_s[1], t2 = now->t_s;
    const bool between = at != t2;
    const double w0 = between ? (at - t1) * (at - t2) / ((t0 - t1) * (t0 - t2)) : 0,
                 w1 = between ? (at - t0) * (at - t2) / ((t1 - t0) * (t1 - t2)) : 0,
                 w2 = between ? (at - t0) * (at - t1) / ((t2 - t0) * (t2 - t1)) : 1;
    b->hardest_N2 = 0;
    for (int i = 0; i < n; i++) {
        const double f = now->reaction_N[2 * m->hinge[i / 2].pin + i % 2];
        b->hardest_N[i] = w0 * b->before_N[i] + w1 * b->before_N[n + i] + w2 * f;
        b->hardest_N2 += b->hardest_N[i] * b->hardest_N[i];
    }
    b->beside = b->hardest_N2 > 0 ? sqrt(b->peak->value / b->hardest_N2) : 1;
}

/* of a parabola through three samples, the middle one the largest; over that one */
static double parabola_over(const double t[3], const double f[3]) {
    const double a = (f[1] - f[0]) / (t[1] - t[0]), c = (f[2] - f[1]) / (t[2] - t[1]);
    const double bend = (c - a) / (t[2] - t[0]);
    if (!(bend < 0) || !(f[1] > 0)) return 1;
    const double slope = a + bend * (t[1] - t[0]); /* at the middle one */
    return 1 - 0.25 * slope * slope / (bend * f[1]);
}

/* Forces of all hinges where a component of one is largest or least so far. What tips a device goes with their signs, and
   a load that pulls first and pushes later, with less, does not tip it where it is hardest. */
static void take_extremes(fw_verdict_bending *b, const fw_mechanism *m,
                          const fw_dynamics_instant *now) {
    const int n = 2 * m->nhinge;
    for (int i = 0; i < 2 * n; i++) {
        const int k = i / 2;
        const double sign = i % 2 ? -1 : 1,
                     f = sign * now->reaction_N[2 * m->hinge[k / 2].pin + k % 2];
        fw_verdict_extreme *to = &b->extreme[i];
        if (f > to->value_N) {
            *to = (fw_verdict_extreme){f, now->t_s, 1};
            for (int l = 0; l < n; l++)
                b->extreme_N[(size_t)i * (size_t)n + (size_t)l] =
                    now->reaction_N[2 * m->hinge[l / 2].pin + l % 2];
        } else if (to->value_N > 0 && to->at_s == b->before_s[1] &&
                   b->before_s[1] > b->before_s[0] && now->t_s > to->at_s && !now->begins) {
            const double t[3] = {b->before_s[0], b->before_s[1], now->t_s},
                         v[3] = {sign * b->before_N[k], to->value_N, f};
            to->beside = fmax(to->beside, fmin(parabola_over(t, v), 2));
        }
    }
}

/* the last two instants */
static void remember_forces(fw_verdict_bending *b, const fw_mechanism *m,
                            const fw_dynamics_instant *now) {
    const int n = 2 * m->nhinge;
    memcpy(b->before_N, b->before_N + n, (size_t)n * sizeof *b->before_N);
    for (int i = 0; i < n; i++)
        b->before_N[n + i] = now->reaction_N[2 * m->hinge[i / 2].pin + i % 2];
    b->before_s[0] = b->before_s[1], b->before_s[1] = now->t_s;
}

/* What presses a straight flexure, and what acts across it, as its bodies have turned; of any other both are all of it */
static void pressed_by(const fw_verdict_bending *b, const fw_mechanism *m, int k,
                       const double force[2], double pressed[2]) {
    const fw_mechanism_hinge *h = &m->hinge[k];
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    pressed[0] = pressed[1] = hypot(force[0], force[1]);
    if (h->input.kind != FW_FLEXURE_LEAF || !isfinite(h->axis_rad)) return;
    const double to = h->axis_rad + 0.5 * (turned(b, pin->body_a) + turned(b, pin->body_b)),
                 way = h->first_is_a ? 1 : -1; /* from body a to body b */
    pressed[0] = fmax(way * (cos(to) * force[1] - sin(to) * force[0]), 0);
    pressed[1] = fabs(cos(to) * force[0] + sin(to) * force[1]);
}

static void take_jump(fw_verdict_bending *b, const fw_mechanism *m,
                      const fw_dynamics_instant *now) {
    const int n = 2 * m->nhinge;
    double sum = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < n; i++) {
            const double by = now->reaction_N[2 * m->hinge[i / 2].pin + i % 2] - b->before_N[n + i];
            if (!pass) sum += by * by;
            if (pass && sum > b->jumped_N[0]) b->jumped_N[1 + i] = by;
        }
    b->jumped_N[0] = fmax(b->jumped_N[0], sum);
}

/* What may tip the device out of its plane (verdict_out_of_plane.c), and strain rims. Largest between instants, too: by
   the parabola through three of them. */
static void record_forces(fw_verdict_bending *b, const fw_mechanism *m,
                          const fw_dynamics_instant *now) {
    double sum = 0, *most = b->hardest_N + 2 * m->nhinge, *tips = most + 2 * m->nhinge;
    fw_verdict_largest *peak = b->peak + 1, *along = peak + 2 * m->nhinge,
                       *press = along + 4 * m->nhinge;
    if (now->begins) /* no parabola across a jump */
        for (int i = 0; i <= 8 * m->nhinge; i++)
            b->peak[i].samples = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const int j = m->hinge[k].pin;
        const double *force = now->reaction_N + 2 * j,
                     squared = force[0] * force[0] + force[1] * force[1],
                     moment = fabs(m->pin[j].stiffness_Nm_per_rad * now->angle_rad[j]);
        double pressed[2];
        sum += squared;
        pressed_by(b, m, k, force, pressed);
        fw_verdict_largest_add(&peak[2 * k], now->t_s, squared);
        fw_verdict_largest_add(&peak[2 * k + 1], now->t_s, moment);
        most[2 * k] = peak[2 * k].value;
        most[2 * k + 1] = tips[3 * k + 1] = peak[2 * k + 1].value;
        for (int i = 0; i < 2; i++) {
            fw_verdict_largest_add(&press[2 * k + i], now->t_s, pressed[i] * pressed[i]);
            tips[3 * k + 2 * i] = press[2 * k + i].value;
        }
        for (int side = 0; side < 2; side++) {
            const int body = side ? m->pin[j].body_b : m->pin[j].body_a;
            if (body == FW_GROUND) continue;
            const fw_verdict_turn *turn = &b->turn[body];
            const double x = turn->cosine * force[0] + turn->sine * force[1],
                         y = turn->cosine * force[1] - turn->sine * force[0];
            const int end = 2 * (2 * k + side);
            fw_verdict_largest_add(&along[end], now->t_s, x * x);
            fw_verdict_largest_add(&along[end + 1], now->t_s, y * y);
            b->along_N[end] = sqrt(along[end].value);
            b->along_N[end + 1] = sqrt(along[end + 1].value);
        }
    }
    const double before = b->peak->value;
    if (now->begins) take_jump(b, m, now);
    fw_verdict_largest_add(b->peak, now->t_s, sum);
    if (b->peak->value > before) take_hardest(b, m, now);
    if (b->extreme) take_extremes(b, m, now);
    remember_forces(b, m, now);
}

/* what a hinge puts on its body at a side, in the axes in which that was drawn */
typedef struct put {
    fw_geometry_vec2 force_N;
    double moment_Nm;
} put;

/* what acts on a body beside its hinges is what these put on it together, and the inertia */
static void record_rests(fw_verdict_bending *b, const fw_mechanism *m,
                         const fw_dynamics_instant *now) {
    for (int i = 0; i < 2 * m->nbody; i++)
        b->rest[i] = 0;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const int j = m->hinge[i / 2].pin, body = i % 2 ? m->pin[j].body_b : m->pin[j].body_a;
        const double sign = i % 2 ? 1 : -1;
        if (body == FW_GROUND) continue;
        b->rest[2 * body] += sign * now->reaction_N[2 * j];
        b->rest[2 * body + 1] += sign * now->reaction_N[2 * j + 1];
    }
    for (int i = 0; i < m->nbody; i++)
        b->rest_N[i] = fmax(b->rest_N[i], hypot(b->rest[2 * i], b->rest[2 * i + 1]));
}

static put of_side(const fw_verdict_bending *b, const fw_mechanism_pin *pin, int j, int side,
                   const fw_dynamics_instant *now) {
    const int body = side ? pin->body_b : pin->body_a;
    const double sign = side ? 1 : -1, *force = now->reaction_N + 2 * j;
    const fw_geometry_vec2 f = {sign * force[0], sign * force[1]};
    return (put){fw_geometry_vec_rotate(f, -turned(b, body)),
                 -sign * pin->stiffness_Nm_per_rad * now->angle_rad[j]};
}

/* Stress across a cut is somewhere at least what equilibrium asks of it: force over what is left, and
   moment over the integral of the distances. What else acts on the body, its inertia or a load, is what its hinges
   put on it together, and may act on either side. */
static void record_cuts(fw_verdict_bending *b, const fw_mechanism *m,
                        const fw_dynamics_instant *now) {
    for (int i = 0; i < 3 * m->nbody; i++)
        b->put[i] = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2 * m->nhinge; i++) {
            const int j = m->hinge[i / 2].pin, side = i % 2;
            const fw_mechanism_pin *pin = &m->pin[j];
            const int body = side ? pin->body_b : pin->body_a;
            const fw_verdict_arm *arm = &b->arm[i];
            if (body == FW_GROUND) continue;
            const put one = of_side(b, pin, j, side, now);
            const fw_geometry_vec2 at = fw_mechanism_pin_place(m, pin, side),
                                   middle = {m->drawn[body].x_m, m->drawn[body].y_m};
            double *all = b->put + 3 * body;
            if (pass == 0) {
                all[0] += one.force_N.x, all[1] += one.force_N.y;
                all[2] += one.moment_Nm + vec_cross(vec_sub(at, middle), one.force_N);
                continue;
            }
            if (!arm->known || !(arm->cut_m > 0)) continue;
            const fw_geometry_vec2 rest = {all[0], all[1]};
            const double here = one.moment_Nm + vec_cross(vec_sub(at, arm->cut), one.force_N),
                         there = all[2] + vec_cross(vec_sub(middle, arm->cut), rest);
            const double force = (vec_length(one.force_N) - vec_length(rest)) / arm->cut_m,
                         moment = (fabs(here) - fabs(there)) / arm->cut_m2;
            b->cut_N_per_m[i] = fmax(b->cut_N_per_m[i], fmax(force, moment));
        }
    for (int i = 0; i < m->nbody; i++)
        b->rest_Nm[i] = fmax(b->rest_Nm[i], fabs(b->put[3 * i + 2]));
}

/* Of what is told, what plain ways may come to where nobody looks for better ones: those have to be twice as soft to
   count. Of 1000 random six-bars they were 0.24 to 1.0 times as soft, 0.47 in the median. */
const double fw_verdict_straight_share = 0.5;

static fw_verdict_turn turn_of(const fw_mechanism *m, const fw_dynamics_instant *now, int body) {
    const double by = now->q[3 * body + 2] - m->drawn[body].phi_rad;
    return (fw_verdict_turn){by, cos(by), sin(by)};
}

/* What all bodies store at an instant, by the forces' sizes alone, whichever way they act; half of what is squared is
   taken at the end */
static double at_most(const fw_verdict_bending *b, const fw_mechanism *m,
                      const fw_dynamics_instant *now, double *hinges) {
    double sum = 0, turns = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const int j = m->hinge[k].pin;
        const double *f = now->reaction_N + 2 * j, *g = b->worst + 3 * k;
        const double moment = m->pin[j].stiffness_Nm_per_rad * now->angle_rad[j],
                     squared = f[0] * f[0] + f[1] * f[1];
        turns += moment * now->angle_rad[j];
        sum += g[0] * moment * moment + g[1] * fabs(moment) * sqrt(squared) + g[2] * squared;
    }
    *hinges = 0.5 * turns;
    return sum / (2 * b->stiff_N);
}

/* only whether bodies are to be counted: hinges by their rotation alone, and bodies where they might */
static void record_straight(fw_verdict_bending *b, const fw_mechanism *m,
                            const fw_dynamics_instant *now) {
    double hinges, bodies = 0;
    const double most = at_most(b, m, now, &hinges);
    b->hinges_J = b->moving_J = fmax(b->hinges_J, hinges);
    if (most <= fw_verdict_straight_share * fw_verdict_bending_told * b->hinges_J) return;
    for (int i = 0; i < m->nbody; i++)
        b->turn[i] = turn_of(m, now, i);
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const int j = m->hinge[i / 2].pin, body = i % 2 ? m->pin[j].body_b : m->pin[j].body_a;
        const double *force = now->reaction_N + 2 * j;
        if (b->arm[i].known)
            bodies += fw_verdict_arm_energy_J(&b->arm[i], b->stiff_N,
                                              -m->pin[j].stiffness_Nm_per_rad * now->angle_rad[j],
                                              force[0], force[1], &b->turn[body]);
    }
    b->bodies_J = fmax(b->bodies_J, bodies);
}

static void put_on_end(const fw_verdict_bending *b, const fw_mechanism *m, int end,
                       double angle_rad, const double force[2]) {
    const fw_mechanism_pin *pin = &m->pin[m->hinge[end / 2].pin];
    const double on[3] = {pin->stiffness_Nm_per_rad * angle_rad, force[0], force[1]};
    double w[3];
    fw_verdict_end_put(on, end % 2, &b->turn[end % 2 ? pin->body_b : pin->body_a], w);
    fw_verdict_wrench_about(fw_mechanism_pin_place(m, pin, end % 2), b->arm[end].shared->about, w,
                            b->end + 3 * end);
}

void fw_verdict_bending_record(fw_verdict_bending *b, const fw_mechanism *m,
                               const fw_dynamics_instant *now) {
    if (now && b->worst) {
        if (b->base) fw_verdict_bases_record(b, m, now);
        record_straight(b, m, now);
        return;
    }
    if (!now) { /* the run starts over */
        b->hinges_J = b->bodies_J = b->bases_J = b->bases_gone = b->moving_J = b->gone =
            b->hardest_N2 = b->jumped_N[0] = 0;
        for (int k = 0; k < 4 * m->nhinge; k++)
            b->before_N[k] = 0;
        for (int k = 0; k < 7 * m->nhinge; k++)
            b->hardest_N[k] = 0;
        for (int k = 0; k <= 8 * m->nhinge; k++)
            b->peak[k] = (fw_verdict_largest){0};
        for (int k = 0; b->extreme && k < 4 * m->nhinge; k++)
            b->extreme[k] = (fw_verdict_extreme){0};
        for (int k = 0; k < 4 * m->nhinge; k++)
            b->along_N[k] = 0;
        if (b->kept) fw_verdict_solid_keep_none(b->kept);
        fw_verdict_places_record(b, m, NULL);
        for (int i = 0; i < m->nbody; i++)
            b->body_J[i] = 0;
        for (int i = 0; b->rest_N && i < m->nbody; i++)
            b->rest_N[i] = 0;
        for (int i = 0; b->rest_Nm && i < m->nbody; i++)
            b->rest_Nm[i] = 0;
        for (int i = 0; b->cut_N_per_m && i < 2 * m->nhinge; i++)
            b->cut_N_per_m[i] = 0;
        if (b->courses) fw_verdict_courses_record(b, m, NULL);
        return;
    }
    if (b->base) fw_verdict_bases_record(b, m, now);
    double hinges = 0, bodies = 0, moving = 0, *each = b->body_J + m->nbody;
    for (int i = 0; i < m->nbody; i++) {
        each[i] = 0;
        b->turn[i] = turn_of(m, now, i);
    }
    if (!b->arm) {
        record_forces(b, m, now);
        return;
    }
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *h = &m->hinge[k];
        const fw_mechanism_pin *pin = &m->pin[h->pin];
        const double angle = now->angle_rad[h->pin], *force = now->reaction_N + 2 * h->pin;
        const int body[2] = {pin->body_a, pin->body_b};
        hinges += of_hinge(h, pin, angle, force, 0.5 * (turned(b, body[0]) + turned(b, body[1])),
                           &moving);
        for (int side = 0; side < 2; side++) {
            const fw_verdict_arm *arm = &b->arm[2 * k + side];
            if (!arm->known) continue;
            double one =
                fw_verdict_arm_energy_J(arm, b->stiff_N, -pin->stiffness_Nm_per_rad * angle,
                                        force[0], force[1], &b->turn[body[side]]);
            bodies += one;
            each[body[side]] += one;
            if (arm->shared) put_on_end(b, m, 2 * k + side, angle, force);
            b->gone =
                fmax(b->gone, fw_verdict_arm_gone(b, h, arm, -pin->stiffness_Nm_per_rad * angle,
                                                  force, &b->turn[body[side]]));
        }
    }
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_verdict_shared *shared = b->arm[i].shared;
        if (!shared || shared->first != i) continue;
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const double more = fw_verdict_shared_J(shared, b->stiff_N, b->end, 2 * m->nhinge);
        bodies += more, each[i % 2 ? pin->body_b : pin->body_a] += more;
    }
    record_forces(b, m, now);
    record_rests(b, m, now);
    fw_verdict_places_record(b, m, now);
    fw_verdict_solid_keep(b, m, now);
    if (b->cut_N_per_m) record_cuts(b, m, now);
    if (b->courses) fw_verdict_courses_record(b, m, now);
    for (int i = 0; i < m->nbody; i++)
        b->body_J[i] = fmax(b->body_J[i], each[i]);
    b->moving_J = fmax(b->moving_J, moving);
    b->hinges_J = fmax(b->hinges_J, hinges);
    b->bodies_J = fmax(b->bodies_J, bodies);
}

/* of a wrench's size: by the moment squared, by moment and force, and by the force squared, of both bodies */
static fw_status worst_of(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                          double **worst) {
    FW_NEED(*worst = fw_arena_array(arena, double, 3 * (size_t)m->nhinge));
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const double *g = arm[i].give;
        double *to = *worst + 3 * (i / 2);
        to[0] += g[0];
        to[1] += 2 * hypot(g[1], g[2]);
        to[2] += fw_verdict_arm_goes(&arm[i]);
    }
    return FW_OK;
}

fw_status fw_verdict_bending_watch(fw_arena *arena, const fw_mechanism *m,
                                   const fw_verdict_arm *arm, bool straight, int scene,
                                   fw_verdict_bending *bending) {
    const fw_mechanism_variant *of = m->variant;
    *bending = (fw_verdict_bending){
        .arm = arm, .stiff_N = of->material.youngs.value * of->thickness_m, .acted_J = HUGE_VAL};
    if (!arm && !m->layout) return FW_OK;
    FW_NEED(bending->body_J = fw_arena_array(arena, double, 2 * (size_t)m->nbody));
    FW_NEED(bending->turn = fw_arena_array(arena, fw_verdict_turn, (size_t)m->nbody));
    FW_NEED(bending->hardest_N = fw_arena_array(arena, double, 13 * (size_t)m->nhinge + 1));
    bending->before_N = bending->hardest_N + 7 * m->nhinge;
    bending->jumped_N = bending->hardest_N + 11 * m->nhinge;
    FW_NEED(bending->along_N = fw_arena_array(arena, double, 4 * (size_t)m->nhinge));
    FW_NEED(bending->peak = fw_arena_array(arena, fw_verdict_largest, 8 * (size_t)m->nhinge + 1));
    if (arm && fw_verdict_has_bases(m, arm))
        FW_NEED(bending->base = fw_arena_array(arena, double, 9 * (size_t)m->nhinge));
    if (straight) return worst_of(arena, m, arm, &bending->worst);
    if (m->nhinge <= FW_TIPPING_HINGES) {
        const size_t n = 2 * (size_t)m->nhinge;
        FW_NEED(bending->extreme = fw_arena_array(arena, fw_verdict_extreme, 2 * n));
        FW_NEED(bending->extreme_N = fw_arena_array(arena, double, 2 * n * n));
    }
    if (!arm) return FW_OK; /* nothing is drawn: what tips is found by forces alone */
    FW_NEED(bending->rest_N = fw_arena_array(arena, double, 3 * (size_t)m->nbody));
    bending->rest = bending->rest_N + m->nbody;
    FW_NEED(bending->end = fw_arena_array(arena, double, 6 * (size_t)m->nhinge));
    FW_TRY(fw_verdict_places_new(arena, m, scene, bending));
    FW_TRY(fw_verdict_solid_keep_new(arena, m, bending->nplace, &bending->kept));
    if (m->device->release_pitch_m > 0) {
        FW_NEED(bending->cut_N_per_m = fw_arena_array(arena, double, 2 * (size_t)m->nhinge));
        FW_NEED(bending->put = fw_arena_array(arena, double, 3 * (size_t)m->nbody));
        FW_NEED(bending->rest_Nm = fw_arena_array(arena, double, (size_t)m->nbody));
    }
    return fw_verdict_courses_new(arena, m, bending);
}

/* ---- plain ways ----
   As those of body_arms.c, from the root straight to the middle (mechanism/body_give.c): a bound, too, for a tenth of their
   cost and without the grid, where the way stays inside and the bodies give little. */

typedef struct straight_way {
    fw_verdict_arm *arm;
    fw_geometry_vec2 pin;
} straight_way;

static void add_to_arm(void *to, fw_geometry_vec2 at, fw_geometry_vec2 from, fw_geometry_vec2 until,
                       double wide_m) {
    const straight_way *s = to;
    fw_verdict_arm_add(s->arm, s->pin, at, from, until, wide_m);
}

static bool walk(const fw_layout *layout, fw_mechanism_edges *edges, fw_geometry_vec2 pin,
                 fw_geometry_vec2 root, fw_verdict_arm *arm) {
    straight_way s = {arm, pin};
    const fw_mechanism_walker walker = {add_to_arm, &s};
    *arm = (fw_verdict_arm){.narrow_m = HUGE_VAL};
    return arm->known = fw_mechanism_walk(layout, edges, pin, root, &walker);
}

static fw_status straight_arms(fw_arena *arena, const fw_mechanism *m, const fw_layout *layout,
                               fw_verdict_arm *arm, bool *known) {
    *known = true;
    for (int body = 0; *known && body < m->nbody; body++) {
        fw_mechanism_edges edge;
        FW_TRY(fw_mechanism_edges_of(arena, layout, body, &edge));
        for (int i = 0; *known && i < 2 * m->nhinge; i++) {
            fw_geometry_vec2 pin, root;
            if (fw_mechanism_hinge_end(m, body, i, &pin, &root))
                *known = edge.all.n > 0 && walk(layout, &edge, pin, root, &arm[i]);
        }
    }
    return FW_OK;
}

fw_status fw_verdict_bending_begin(fw_arena *arena, const fw_layout *layout, const fw_mechanism *m,
                                   bool straight, fw_verdict_variant_verdict *v) {
    fw_verdict_arm *arm;
    if (v->straight && !straight) v->arm = NULL, v->straight = false;
    if (v->arm || !layout || !layout->drawn) return FW_OK;
    if (straight) {
        fw_mechanism_load_end *load;
        int nload;
        FW_TRY(fw_mechanism_load_ends(arena, m, &load, &nload)); /* their ways stay unknown */
        FW_NEED(arm = fw_arena_array(arena, fw_verdict_arm, 2 * (size_t)m->nhinge + (size_t)nload));
        FW_TRY(straight_arms(arena, m, layout, arm, &v->straight));
    }
    if (!v->straight) FW_TRY(fw_verdict_body_arms(arena, m, layout, &arm));
    v->arm = arm;
    return fw_verdict_bases(arena, m, layout, arm);
}

bool fw_verdict_bending_settled(const fw_verdict_variant_verdict *v) {
    for (int i = 0; v->straight && i < v->mechanism->device->nscene; i++) {
        const fw_verdict_strain_monitor *saw = v->motion[i] ? v->motion[i]->observed : NULL;
        const fw_verdict_bending *b = saw && saw->bending.arm ? &saw->bending : NULL;
        /* of leaves that do not turn at all, hinges have nothing by which bodies could be measured */
        if (b && b->bodies_J + b->bases_J >
                     fw_verdict_straight_share * fw_verdict_bending_told * b->hinges_J)
            return false;
    }
    return true;
}

/* ---- what it says ---- */

/* What hinges store a ten-millionth of their way to their limits: below it nothing moves, and bodies over hinges is round-off
   over round-off. A shock across the plane is such a scene. */
static double at_rest_J(const fw_mechanism *m) {
    const double share = 1e-7;
    double sum = 0;
    for (int k = 0; k < m->nhinge; k++) {
        const double angle = share * m->hinge[k].closed_form.limit_angle_rad;
        if (isfinite(angle))
            sum += 0.5 * m->hinge[k].closed_form.stiffness_Nm_per_rad * angle * angle;
    }
    return sum;
}

static const fw_verdict_bending *seen(const fw_dynamics_motion *motion) {
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    if (!saw || !saw->bending.arm) return NULL;
    return saw->bending.hinges_J > at_rest_J(saw->mechanism) ? &saw->bending : NULL;
}

double fw_verdict_bending_stored_J(const fw_dynamics_motion *motion) {
    const fw_verdict_bending *b = seen(motion);
    return b ? b->hinges_J : 0;
}

double fw_verdict_bending_share(const fw_dynamics_motion *motion) {
    const fw_verdict_bending *b = seen(motion);
    return b ? fw_verdict_bending_all_J(b) / b->hinges_J : 0;
}

double fw_verdict_bases_share(const fw_dynamics_motion *motion) {
    const fw_verdict_bending *b = seen(motion);
    return b ? b->bases_J / b->hinges_J : 0;
}

/* A device that is pressed along its flexures goes nowhere, and its bodies may then give many times what the hinges do.
   That changes no strain and no clearance as long as no end of a flexure goes by a fiftieth of the flexure's width or
   turns by a fiftieth of its limit. */
double fw_verdict_bending_moving(const fw_dynamics_motion *motion) {
    const double fiftieth = 0.02;
    const fw_verdict_bending *b = seen(motion);
    if (!b) return 0;
    if (b->moving_J < 0.5 * b->hinges_J && fmax(b->gone, b->bases_gone) < fiftieth) return 0;
    return fw_verdict_bending_share(motion);
}

double fw_verdict_bending_counted(const fw_dynamics_motion *motion) {
    const double share = fw_verdict_bending_moving(motion);
    return share > fw_verdict_bending_told ? share : 0;
}

/* bodies and bases over hinges, without what the bodies give under what presses on them */
static double alone(const fw_verdict_bending *b) {
    return (b->bodies_J + b->bases_J) / b->hinges_J;
}

/* Of small motions no forces are known: the most of any scene, but for one that hardly moves beside another (round-off), and
   without what the bodies give under what presses on them there.
   Bodies that give only soften: a stiffness by 1/(1 + share), a frequency by its root (Rayleigh). Solids of whole devices
   swing up to 0.3 % higher than computed: the other way the share counts up to 1 %. */
double fw_verdict_bending_of_any(const fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const double hardly = 1e-10; /* of the energy */
    double most = 0, largest_J = 0;
    for (int i = 0; i < m->device->nscene; i++)
        largest_J = fmax(largest_J, fw_verdict_bending_stored_J(v->motion[i]));
    for (int i = 0; i < m->device->nscene; i++)
        if (fw_verdict_bending_stored_J(v->motion[i]) >= hardly * largest_J)
            most = fmax(most, seen(v->motion[i]) ? alone(seen(v->motion[i])) : 0);
    return most;
}

/* ---- across the plane ---- */

fw_status fw_verdict_soft_plates(fw_arena *arena, const fw_mechanism *m, const fw_verdict_arm *arm,
                                 fw_mechanism_plates *soft) {
    const fw_device_material *of = &m->variant->material;
    const double nu = of->poisson.unknown ? 0.3 : of->poisson.value;
    double *give;
    FW_NEED(give = fw_arena_array(arena, double, 9 * (size_t)m->nhinge));
    for (int k = 0; arm && k < 2 * m->nhinge; k++) {
        const fw_verdict_arm *one = arm[k].known ? &arm[k] : arm[k].base;
        if (one)
            fw_verdict_arm_out_of_plane(one, of->youngs.value, nu, m->variant->thickness_m,
                                        give + 9 * (k / 2));
    }
    return fw_mechanism_plates_new(arena, m, give, soft);
}
