/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step along a sequence of equilibria, and what is read off it. */
#include "maths/functions.h"
#include "multibody/system.h"
#include "quantity/law_kind.h"
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- one step ---- */

/* One step along the equilibria of a scene. It solves for those in its middle and at its end, where
   du/dt is exact too; a step is good when the cubic through its ends meets the middle. Its curve,
   of degree 5, is far better than that. Source: predictor-corrector continuation, Allgower and
   Georg 1990, ch. 2; Hermite interpolation, Stoer and Bulirsch, 2.1. Test: test_quasi.c. */

enum { FW_TRIES = 12 };
static const double fw_farthest = 0.3; /* rad or scaled lengths: a correction, at most */

/* ---- one equilibrium ---- */

static bool stable(const fw_statics_reduced *r) {
    for (int k = 0; k < r->dof; k++)
        if (!(r->value[k] > r->zero[k])) return false;
    return true;
}

/* The equilibrium at scaled t nearest to r->guess; the model stays there. Newton from guess; forces and tangent are
   those within 1e-10 of the result. FW_SOLVER: there is none that it reaches in a few steps, or it is not stable */
static fw_status solve(fw_statics_quasi_static *r, double t) {
    fw_statics_equilibrium *w = &r->w;
    size_t n = (size_t)w->model->nq;
    double before = (double)INFINITY;
    fw_statics_equilibrium_at(w, t * w->model->scale.time_s, r->piece_s);
    memcpy(w->y, r->guess, n * sizeof(double));
    r->solved++;
    for (int i = 0; i < FW_TRIES; i++) {
        FW_TRY(fw_statics_equilibrium_evaluate(w));
        r->evaluated++;
        if (!stable(&w->reduced)) return FW_SOLVER;
        double most = fw_statics_equilibrium_newton(w, w->step);
        if (!(most <= fw_farthest)) return FW_SOLVER;
        for (size_t k = 0; k < n; k++)
            w->y[k] += w->step[k];
        if (most <= 1e-10 ||
            (most > 0.5 * before && (most < 1e-9 || fw_statics_equilibrium_quiet(w)))) {
            fw_statics_equilibrium_rate(w, r->rate);
            return FW_OK;
        }
        before = most;
    }
    return FW_SOLVER;
}

static void keep(fw_statics_quasi_static *r, double t, fw_statics_node *node) {
    size_t bytes = (size_t)r->w.model->nq * sizeof(double);
    double size;
    node->t = t;
    memcpy(node->u, r->w.y, bytes);
    memcpy(node->v, r->rate, bytes);
    for (int i = 0; i < r->w.model->nq; i++)
        r->size = fmax(r->size, fabs(node->u[i]));
    r->kinetic = fmax(r->kinetic, fw_multibody_kinetic_energy(r->w.model, r->rate));
    r->elastic = fmax(r->elastic, fabs(fw_statics_equilibrium_energy(&r->w, node->u, &size)));
    r->elastic = fmax(r->elastic, size / 2);
}

/* below these a landing is where the last step ended, or where the mechanism was assembled */
static const double fw_same_m = 1e-9, fw_same_rad = 1e-6;

/* the straight way from the last equilibrium to the one that the model is at, where that is elsewhere */
static void jump(const fw_statics_quasi_static *r, double t) {
    enum { NODES = 6 };
    const int nq = r->w.model->nq;
    bool elsewhere = false;
    if (!r->options->observe || !r->options->trace) return;
    for (int i = 0; i < NODES; i++) {
        double part = (double)i / (NODES - 1);
        for (int k = 0; k < nq; k++)
            r->guess[k] = r->from.u[k] + part * (r->w.y[k] - r->from.u[k]);
        fw_statics_equilibrium_pose(&r->w, r->guess, r->piece_q + (size_t)(i * nq), r->angle);
    }
    for (int k = 0; k < nq; k++) {
        double by = r->piece_q[(size_t)((NODES - 1) * nq + k)] - r->piece_q[k];
        elsewhere = elsewhere || fabs(by) > (k % 3 == 2 ? fw_same_rad : fw_same_m);
    }
    const double at_s = t * r->w.model->scale.time_s;
    const fw_dynamics_piece piece = {.from_s = at_s,
                                     .to_s = at_s,
                                     .jump = true,
                                     .nodes = NODES,
                                     .q = r->piece_q,
                                     .loads = r->motion->loads,
                                     .mechanism = r->w.mechanism};
    if (elsewhere) r->options->trace(r->options->context, &piece);
}

fw_status fw_statics_quasi_static_land(fw_statics_quasi_static *r, double t) {
    fw_statics_equilibrium *w = &r->w;
    bool unstable = false;
    fw_statics_equilibrium_at(w, t * w->model->scale.time_s, r->piece_s);
    memcpy(w->y, r->from.u, (size_t)w->model->nq * sizeof(double));
    r->solved++;
    fw_status status = fw_statics_equilibrium_descend(w, &unstable);
    if (status == FW_OK && (unstable || !stable(&w->reduced))) status = FW_SOLVER;
    FW_TRY(status);
    r->evaluated++;
    fw_statics_equilibrium_rate(w, r->rate);
    jump(r, t);
    keep(r, t, &r->from);
    return FW_OK;
}

/* ---- the curve of a step ---- */

/* the step's curve at x in [0, 1], of degree 5; value, slope and bend (n) by scaled time, may be NULL: cubic through
   both ends plus x^2 (1 - x)^2 (c0 + c1 (x - 1/2)), which leaves the ends
   alone */
static void curve(const fw_statics_quasi_static *r, double x, double *value, double *slope,
                  double *bend) {
    double h = r->to.t - r->from.t, z = x - 0.5, p = x * (1 - x), dp = 1 - 2 * x;
    double bump = p * p, rise = 2 * p * dp, curl = 2 * dp * dp - 4 * p;
    for (int i = 0; i < r->w.model->nq; i++) {
        double a = r->from.u[i], b = r->to.u[i], m = r->middle.u[i];
        double va = h * r->from.v[i], vb = h * r->to.v[i], vm = h * r->middle.v[i];
        double c2 = 3 * (b - a) - 2 * va - vb, c3 = va + vb - 2 * (b - a);
        double c0 = 16 * (m - (a + va / 2 + c2 / 4 + c3 / 8));
        double c1 = 16 * (vm - (va + c2 + 0.75 * c3)), c = c0 + c1 * z;
        if (value) value[i] = a + x * (va + x * (c2 + x * c3)) + bump * c;
        if (slope) slope[i] = (va + x * (2 * c2 + 3 * x * c3) + rise * c + bump * c1) / h;
        if (bend) bend[i] = (2 * c2 + 6 * x * c3 + curl * c + 2 * rise * c1) / (h * h);
    }
}

double fw_statics_quasi_static_miss(const fw_statics_quasi_static *r) {
    double h = r->to.t - r->from.t, most = 0;
    for (int i = 0; i < r->w.model->nq; i++) {
        double cubic = 0.5 * (r->from.u[i] + r->to.u[i]) + h / 8 * (r->from.v[i] - r->to.v[i]);
        most = fmax(most, fabs(r->middle.u[i] - cubic));
    }
    return most;
}

/* from r->from to t: middle by the tangent, end by the cubic through start and middle */
fw_status fw_statics_quasi_static_step(fw_statics_quasi_static *r, double t) {
    double h = (t - r->from.t) / 2;
    int n = r->w.model->nq;
    for (int i = 0; i < n; i++)
        r->guess[i] = r->from.u[i] + h * r->from.v[i];
    FW_TRY(solve(r, r->from.t + h));
    keep(r, r->from.t + h, &r->middle);
    for (int i = 0; i < n; i++)
        r->guess[i] =
            5 * r->from.u[i] - 4 * r->middle.u[i] + h * (2 * r->from.v[i] + 4 * r->middle.v[i]);
    FW_TRY(solve(r, t));
    keep(r, t, &r->to);
    return FW_OK;
}

/* ---- what is read off ---- */

/* What is read off a sequence of equilibria: peaks of angles, rows, instants, extremes of
   forces. */

fw_status fw_statics_quasi_static_arrays(fw_statics_quasi_static *r) {
    const fw_mechanism *from = r->w.mechanism;
    fw_arena *arena = r->w.arena;
    size_t rows = (size_t)r->options->samples, n = 3 * (size_t)from->nbody;
    size_t pins = (size_t)from->npin, joints = (size_t)from->njoint,
           drivers = (size_t)from->ndriver;
    fw_dynamics_motion *m;
    if (rows > ((size_t)1 << 40) / (n + pins + 1)) return FW_LIMIT;
    FW_NEED(m = r->motion = fw_arena_one(arena, fw_dynamics_motion));
    m->nbody = from->nbody, m->npin = from->npin;
    m->njoint = from->njoint, m->ndriver = from->ndriver;
    m->nsample = r->options->samples;
    m->end_s = r->w.scene->duration_s;
    FW_NEED(m->t_s = fw_arena_array(arena, double, rows));
    FW_NEED(m->q = fw_arena_array(arena, double, rows *n));
    FW_NEED(m->v = fw_arena_array(arena, double, rows *n));
    FW_NEED(m->accel = fw_arena_array(arena, double, rows *n));
    FW_NEED(m->angle_rad = fw_arena_array(arena, double, rows *pins));
    FW_NEED(m->reaction_N = fw_arena_array(arena, double, rows * 2 * pins));
    FW_NEED(m->joint_N = fw_arena_array(arena, double, rows * 3 * joints));
    FW_NEED(m->driver_N = fw_arena_array(arena, double, rows *drivers));
    FW_NEED(m->peak = fw_arena_array(arena, fw_dynamics_peak, pins));
    FW_NEED(r->q = fw_arena_array(arena, double, n));
    FW_NEED(r->piece_q = fw_arena_array(arena, double, FW_PIECE_NODES *n));
    FW_NEED(r->angle = fw_arena_array(arena, double, pins));
    FW_NEED(r->angle0 = fw_arena_array(arena, double, pins));
    FW_NEED(r->reaction = fw_arena_array(arena, double, 2 * pins));
    FW_NEED(r->joint = fw_arena_array(arena, double, 3 * joints));
    FW_NEED(r->driver = fw_arena_array(arena, double, drivers));
    FW_NEED(r->speed = fw_arena_array(arena, double, n));
    memset(r->guess, 0, n * sizeof(double));
    fw_statics_equilibrium_pose(&r->w, r->guess, r->q, r->angle0);
    if (!r->options->reactions) return FW_OK;
    FW_NEED(r->track = fw_arena_array(arena, fw_statics_track, pins + 3 * joints + drivers));
    FW_NEED(m->force_peak = fw_arena_array(arena, fw_dynamics_force_peak, pins));
    FW_NEED(m->joint_peak = fw_arena_array(arena, fw_dynamics_force_peak, joints));
    FW_NEED(m->driver_peak = fw_arena_array(arena, fw_dynamics_force_peak, drivers));
    FW_NEED(m->travel_peak = fw_arena_array(arena, fw_dynamics_travel_peak, joints));
    return FW_OK;
}

/* ---- angles ---- */

static void offer(fw_dynamics_peak *peak, double angle, double t, double error) {
    if (fabs(angle) <= fabs(peak->angle_rad)) return;
    *peak = (fw_dynamics_peak){.angle_rad = angle, .t_s = t, .error_rad = error};
}

static double turn_of(const fw_statics_quasi_static *r, int pin, const double *u) {
    const fw_mechanism_pin *p = &r->w.mechanism->pin[pin];
    return (p->body_b == FW_GROUND ? 0 : u[3 * p->body_b + 2]) -
           (p->body_a == FW_GROUND ? 0 : u[3 * p->body_a + 2]);
}

typedef struct turning { /* of one pin along the step */
    fw_statics_quasi_static *r;
    int pin;
} turning;

static double rate_at(const void *context, double theta) {
    const turning *k = context;
    curve(k->r, theta, NULL, k->r->accel, NULL);
    return turn_of(k->r, k->pin, k->r->accel);
}

/* the equilibrium where the curve has an extreme: first order in the time does not count there */
static fw_status refine(fw_statics_quasi_static *r, int pin, double theta) {
    fw_dynamics_peak *peak = &r->motion->peak[pin];
    double t = r->from.t + theta * (r->to.t - r->from.t);
    curve(r, theta, r->guess, NULL, NULL);
    double rough = r->angle0[pin] + turn_of(r, pin, r->guess);
    if (fabs(rough) + r->worst < fabs(peak->angle_rad)) return FW_OK;
    fw_status status = solve(r, t);
    if (status != FW_OK) return status == FW_SOLVER ? FW_OK : status; /* the ends stand */
    double exact = r->angle0[pin] + turn_of(r, pin, r->w.y);
    offer(peak, exact, t, fabs(exact - rough));
    return FW_OK;
}

static fw_status peaks(fw_statics_quasi_static *r) {
    enum { PLACES = 8 };
    for (int i = 0; i < r->motion->npin; i++) {
        const turning k = {r, i};
        fw_dynamics_peak *peak = &r->motion->peak[i];
        offer(peak, r->angle0[i] + turn_of(r, i, r->middle.u), r->middle.t, 0);
        offer(peak, r->angle0[i] + turn_of(r, i, r->to.u), r->to.t, 0);
        double before = rate_at(&k, 0);
        for (int p = 1; p <= PLACES; p++) {
            double at = (double)p / PLACES, now = rate_at(&k, at);
            if ((before < 0) != (now < 0)) {
                double root = fw_maths_brent_root(rate_at, &k, at - 1.0 / PLACES, at, 1e-12);
                if (!isnan(root)) FW_TRY(refine(r, i, root));
            }
            before = now;
        }
    }
    return FW_OK;
}

/* ---- rows ---- */

static void units(const fw_statics_quasi_static *r, const double *from, double by_time,
                  double *to) {
    const fw_multibody_scale s = r->w.model->scale;
    for (int i = 0; i < r->w.model->nq; i++)
        to[i] = from[i] * by_time * (i % 3 == 2 ? 1 : s.length_m);
}

/* the equilibrium that the model holds, as the next row; bend: d2u/dt2, scaled */
static void store(fw_statics_quasi_static *r, double t_s, const double *bend) {
    fw_dynamics_motion *m = r->motion;
    const double second = r->w.model->scale.time_s;
    size_t row = (size_t)r->row++, n = 3 * (size_t)m->nbody, pins = (size_t)m->npin;
    m->t_s[row] = t_s;
    fw_statics_equilibrium_pose(&r->w, r->w.y, m->q + row * n, m->angle_rad + row * pins);
    units(r, r->rate, 1 / second, m->v + row * n);
    units(r, bend, 1 / (second * second), m->accel + row * n);
    fw_statics_equilibrium_reactions(&r->w, m->reaction_N + row * 2 * pins,
                                     m->joint_N + row * 3 * (size_t)m->njoint,
                                     m->driver_N + row * (size_t)m->ndriver);
}

static double row_time(const fw_statics_quasi_static *r, int row) {
    int last = r->motion->nsample - 1;
    double all = r->w.scene->duration_s;
    return row == last ? all : all * row / (last > 0 ? last : 1);
}

static fw_status rows(fw_statics_quasi_static *r) {
    double second = r->w.model->scale.time_s, h = r->to.t - r->from.t;
    for (; r->row < r->motion->nsample;) {
        double t_s = row_time(r, r->row), t = t_s / second;
        bool end = r->row == r->motion->nsample - 1;
        if (end ? r->to.t < r->duration : t > r->to.t) return FW_OK;
        double theta = end ? 1 : fmin(1, fmax(0, (t - r->from.t) / h));
        curve(r, theta, r->guess, NULL, r->accel);
        FW_TRY(solve(r, r->from.t + theta * h));
        store(r, t_s, r->accel);
    }
    return FW_OK;
}

/* ---- instants ---- */

/* sizes at equal or unequal distances; the largest, or the top of the parabola through three */
static void follow(fw_statics_track *k, double t, double value) {
    double s = fabs(value);
    if (k->samples >= 2) {
        double a = k->t[1] - k->t[0], b = t - k->t[1], up = k->s[1] - k->s[0], down = s - k->s[1];
        if (a > 0 && b > 0 && up >= 0 && down <= 0 && up - down > 0) {
            double slope = (up * b / a + down * a / b) / (a + b);
            double bend = 2 * (down / b - up / a) / (a + b), add = -slope * slope / (2 * bend);
            if (k->s[1] + add > k->most) {
                k->most = k->s[1] + add, k->at = k->t[1] - slope / bend;
                k->between = add;
            }
        }
    }
    if (s > k->most) k->most = s, k->at = t, k->between = 0;
    if (s >= k->most - k->between) k->value = value;
    k->t[0] = k->t[1], k->s[0] = k->s[1];
    k->t[1] = t, k->s[1] = s;
    k->samples++;
}

/* as in dynamics/extreme.c: pins, then forces, torques and travels of joints, then drivers */
static void channels(fw_statics_quasi_static *r, double t) {
    const fw_mechanism *from = r->w.mechanism;
    const fw_multibody_model *m = r->w.model;
    const fw_multibody_pose *pose = fw_multibody_pose_at(r->w.system, t, r->w.y);
    fw_statics_track *k = r->track;
    for (int i = 0; i < from->npin; i++)
        follow(k++, t, hypot(r->reaction[2 * i], r->reaction[2 * i + 1]));
    for (int i = 0; i < from->njoint; i++, k += 3) {
        double d[2], e[2], n[2];
        follow(k, t, hypot(r->joint[3 * i], r->joint[3 * i + 1]));
        follow(k + 1, t, from->joint[i].kind == FW_JOINT_DISTANCE ? 0 : r->joint[3 * i + 2]);
        if (from->joint[i].kind != FW_JOINT_PRISMATIC) continue;
        fw_multibody_frame(m, pose, m->joint_block[i], d, e, n);
        follow(k + 2, t,
               (e[0] * d[0] + e[1] * d[1]) * m->scale.length_m - from->joint[i].free_length_m);
    }
    for (int i = 0; i < from->ndriver; i++)
        follow(k++, t, r->driver[i]);
}

static void observe_state(fw_statics_quasi_static *r, double t) {
    fw_statics_equilibrium_pose(&r->w, r->w.y, r->q, r->angle);
    fw_statics_equilibrium_reactions(&r->w, r->reaction, r->joint, r->driver);
    if (r->track) channels(r, t);
    if (!r->options->observe) return;
    const bool whole = r->options->whole;
    if (whole) units(r, r->rate, 1 / r->w.model->scale.time_s, r->speed);
    const fw_dynamics_instant now = {.t_s = t * r->w.model->scale.time_s,
                                     .q = r->q,
                                     .angle_rad = r->angle,
                                     .reaction_N = r->reaction,
                                     .hinge = r->w.ledger.hinge.used,
                                     .piece_s = r->piece_s,
                                     .loads = r->motion->loads,
                                     .v = whole ? r->speed : NULL,
                                     .joint_N = whole ? r->joint : NULL,
                                     .driver_N = whole ? r->driver : NULL};
    r->options->observe(r->options->context, &now);
}

static fw_status instants(fw_statics_quasi_static *r) {
    double h = r->to.t - r->from.t;
    if (!r->options->observe && !r->track) return FW_OK;
    for (int i = 1; i <= FW_INSTANTS; i++) {
        double theta = (double)i / FW_INSTANTS;
        curve(r, theta, r->guess, NULL, NULL);
        FW_TRY(solve(r, r->from.t + theta * h));
        observe_state(r, r->from.t + theta * h);
    }
    return FW_OK;
}

/* ---- when ---- */

/* at a landing: what jumped there is seen; the model is at r->from */
fw_status fw_statics_quasi_static_begin(fw_statics_quasi_static *r) {
    for (int i = 0; i < r->motion->npin; i++)
        offer(&r->motion->peak[i], r->angle0[i] + turn_of(r, i, r->from.u), r->from.t, 0);
    int count = r->motion->npin + 3 * r->motion->njoint + r->motion->ndriver;
    for (int i = 0; r->track && i < count; i++)
        r->track[i].samples = 0;
    if (r->options->observe || r->track) observe_state(r, r->from.t);
    return FW_OK;
}

/* the step's curve is a polynomial, and poses are linear in it */
static void trace(fw_statics_quasi_static *r) {
    enum { NODES = 6 };
    double unit = r->w.model->scale.time_s;
    if (!r->options->observe || !r->options->trace) return;
    for (int i = 0; i < NODES; i++) {
        curve(r, (double)i / (NODES - 1), r->guess, NULL, NULL);
        fw_statics_equilibrium_pose(&r->w, r->guess, r->piece_q + (size_t)(i * r->w.model->nq),
                                    r->angle);
    }
    const fw_dynamics_piece piece = {.from_s = r->from.t * unit,
                                     .to_s = r->to.t * unit,
                                     .nodes = NODES,
                                     .q = r->piece_q,
                                     .loads = r->motion->loads,
                                     .mechanism = r->w.mechanism};
    r->options->trace(r->options->context, &piece);
}

fw_status fw_statics_quasi_static_record(fw_statics_quasi_static *r) {
    FW_TRY(peaks(r));
    trace(r);
    FW_TRY(instants(r));
    return rows(r);
}

static fw_dynamics_force_peak force_peak(const fw_statics_quasi_static *r,
                                         const fw_statics_track *force,
                                         const fw_statics_track *torque) {
    double second = r->w.model->scale.time_s, part = r->worst / fmax(r->size, DBL_MIN) + 1e-12;
    fw_dynamics_force_peak p = {0};
    if (force)
        p.force_N = force->most, p.t_s = force->at * second,
        p.error_N = force->between + part * force->most;
    if (torque)
        p.torque_Nm = torque->most, p.torque_t_s = torque->at * second,
        p.torque_error_Nm = torque->between + part * torque->most;
    return p;
}

static void finish_tracks(fw_statics_quasi_static *r) {
    const fw_mechanism *from = r->w.mechanism;
    fw_dynamics_motion *m = r->motion;
    const fw_statics_track *k = r->track;
    if (!k) return;
    for (int i = 0; i < m->npin; i++)
        m->force_peak[i] = force_peak(r, k++, NULL);
    for (int i = 0; i < m->njoint; i++, k += 3) {
        m->joint_peak[i] = force_peak(r, k, k + 1);
        if (from->joint[i].kind != FW_JOINT_PRISMATIC) continue;
        double value = k[2].value < 0 ? -k[2].most : k[2].most;
        m->travel_peak[i] =
            (fw_dynamics_travel_peak){value, k[2].at * r->w.model->scale.time_s,
                                      k[2].between + r->worst * r->w.model->scale.length_m};
    }
    for (int i = 0; i < m->ndriver; i++, k++) {
        bool turns = from->driver[i].revolute != FW_NONE;
        m->driver_peak[i] = force_peak(r, turns ? NULL : k, turns ? k : NULL);
    }
}

/* errors: what a curve misses between its equilibria, and round-off */
void fw_statics_quasi_static_finish(fw_statics_quasi_static *r) {
    fw_dynamics_motion *m = r->motion;
    const fw_multibody_scale unit = r->w.model->scale;
    double speed = unit.length_m / unit.time_s;
    for (int i = 0; i < m->npin; i++) {
        m->peak[i].t_s *= unit.time_s;
        m->peak[i].error_rad +=
            2 * r->worst + 1e-10 * r->size + 64 * DBL_EPSILON * (1 + fabs(m->peak[i].angle_rad));
    }
    finish_tracks(r);
    m->nsample = r->row;
    m->ledger = r->w.ledger;
    fw_effects_in_equilibrium(&m->ledger);
    fw_dynamics_motion_widen(m);
    m->stats =
        (fw_dynamics_motion_stats){.steps = r->solved,
                                   .rejected = r->rejected,
                                   .rhs = r->evaluated,
                                   .runs = 1,
                                   .all_steps = r->solved,
                                   .all_rhs = r->evaluated,
                                   .projections = r->evaluated,
                                   .max_constraint_norm = r->w.system->record.worst_position,
                                   .energy_error = r->kinetic / fmax(r->elastic, DBL_MIN),
                                   .rtol = r->options->rtol > 0 ? r->options->rtol : r->tolerance,
                                   .largest_energy_J = r->elastic * unit.mass_kg * speed * speed,
                                   .assembly_moved_m = r->options->moved_m};
    m->method = m->integrator = m->stabilise = "quasi-static";
    m->reason = "inertia is left out: the motion is a quasi-static sequence of equilibria";
    m->accuracy = r->options->accuracy > 0 ? r->options->accuracy : 1e-3;
    m->tolerance =
        "as many equilibria as keep what is read off between them to a fiftieth of the accuracy";
}

/* ---- how far drivers and heat hold a device ----
   For one unit of one of them, all others as they begin: the equilibrium with it at its farthest less that without, over
   how far it goes, (3 nbody) in m and rad; 0 where there is no equilibrium. Error: that of a straight way. Cost: one or two
   equilibria. Test: test_effects.py, test_what_comes_again_whatever_drives_it */

/* where it rests in a scene, as drivers stand at its end; false: nowhere */
static fw_status rests_at(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                          const double **from, const double **to, bool *known) {
    const fw_statics_static_options o = {.accuracy = 0.03};
    const fw_statics *found = NULL;
    fw_diags own = fw_diags_new(arena);
    const fw_status status = fw_statics_solve(arena, m, scene, &o, &own, &found);
    *known = status == FW_OK && found;
    if (*known) *from = found->rest_q, *to = found->q;
    if (status == FW_CANCELLED) return status;
    return status == FW_NOMEM || own.failed ? FW_NOMEM : FW_OK;
}

fw_status fw_statics_driven_way(fw_arena *arena, const fw_mechanism *m, int driver, double end_s,
                                double *way, bool *known) {
    enum { HALVINGS = 6 };
    static const double ends[2] = {0, 1};
    const fw_device_scene still = {.name = "(none)", .duration_s = 1};
    const size_t n = (size_t)m->ndriver;
    fw_mechanism held = *m;
    double *value, turned = 1;
    const double *from, *to;
    FW_NEED(held.driver = fw_arena_grow(arena, m->driver, n, n, sizeof *held.driver));
    FW_NEED(value = fw_arena_array(arena, double, 2 * n));
    for (int i = 0; i < m->ndriver; i++) {
        double *at = value + 2 * i;
        fw_quantity_law_goes(&m->driver[i].law, end_s, &at[0], &at[1]);
        if (i == driver)
            turned = at[1] - at[0];
        else
            at[1] = at[0];
        held.driver[i].law = (fw_quantity_law){
            .kind = &fw_quantity_law_table, .table_t_s = ends, .table_value = at, .ntable = 2};
    }
    FW_TRY(rests_at(arena, &held, &still, &from, &to, known));
    for (int k = 0; !*known && k < HALVINGS; k++) { /* it comes so far in motion alone */
        double *at = value + 2 * driver;
        at[1] = 0.5 * (at[0] + at[1]), turned *= 0.5;
        FW_TRY(rests_at(arena, &held, &still, &from, &to, known));
    }
    for (int i = 0; *known && i < 3 * m->nbody; i++)
        way[i] = (to[i] - from[i]) / turned;
    return FW_OK;
}

/* of a still scene that has something more, against one that has not */
static fw_status way_of(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *held,
                        double *way, bool *known) {
    const fw_device_scene still = {.name = "(none)", .duration_s = 1};
    const double *rest, *from, *to;
    bool there[2];
    FW_TRY(rests_at(arena, m, &still, &rest, &from, &there[0]));
    FW_TRY(rests_at(arena, m, held, &rest, &to, &there[1]));
    *known = there[0] && there[1];
    for (int i = 0; *known && i < 3 * m->nbody; i++)
        way[i] = to[i] - from[i];
    return FW_OK;
}

fw_status fw_statics_heated_way(fw_arena *arena, const fw_mechanism *m,
                                const fw_device_temperature *heat, double *way, bool *known) {
    fw_device_temperature steady = *heat;
    const fw_device_scene heated = {
        .name = "(none)", .duration_s = 1, .temperature = &steady, .ntemperature = 1};
    steady.law = NULL;
    return way_of(arena, m, &heated, way, known);
}

fw_status fw_statics_stressed_way(fw_arena *arena, const fw_mechanism *m,
                                  const fw_device_scene *scene, double *way, bool *known) {
    const fw_device_scene stressed = {
        .name = "(none)", .duration_s = 1, .stress = scene->stress, .nstress = scene->nstress};
    return way_of(arena, m, &stressed, way, known);
}

/* ---- does anything take hold while it moves ---- */

bool fw_statics_takes_hold(const fw_mechanism *m, const fw_device_scene *scene,
                           const fw_dynamics_motion *x, long events) {
    bool may = scene && (scene->ntendon > 0 || scene->ncontact > 0);
    for (int i = 0; i < m->nspring; i++)
        may = may || m->spring[i].cable;
    for (int i = 0; i < m->npin; i++)
        may = may || m->pin[i].stop_stiffness_Nm_per_rad > 0;
    return may && x->stats.events >= events && !x->loads->quasi_static;
}
