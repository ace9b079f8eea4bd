/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Unknowns: poses of the bodies from 1 on, wrenches of the flexures, forces of what holds. */
struct system {
    struct model *model;
    const struct state *state;
    double share;
    int n, wrench, held;
    double *a; /* n x n */
    double *r; /* what is left, to be made 0 */
};

static double *entry(struct system *s, int row, int column) {
    return s->a + (size_t)row * (size_t)s->n + column;
}

static void add(struct system *s, int row, int column, double value) {
    if (row >= 0 && column >= 0) *entry(s, row, column) += value;
}

/* First unknown of a body; the ground has none. */
static int of_body(int k) {
    return k ? 3 * (k - 1) : -4;
}

static void put(struct system *s, int row, double value) {
    if (row >= 0) s->r[row] += value;
}

static void lever(const struct system *s, int k, const double at[2], double out[2]) {
    const double *q = s->state->q + 3 * k;
    out[0] = k ? at[0] - s->model->body[k].x - q[0] : 0;
    out[1] = k ? at[1] - s->model->body[k].y - q[1] : 0;
}

/* The wrench of a root on its body; how it goes with p and with the turns of both bodies. */
static void root_wrench(struct system *s, const struct flexure *f, int k, const double at[2],
                        double sign, const double force[2], double moment,
                        const double moment_by[3], int column) {
    int row = of_body(k), turned = of_body(f->a) + 2;
    double l[2], c = cos(f->psi + s->state->q[3 * f->a + 2]),
                 sn = sin(f->psi + s->state->q[3 * f->a + 2]);
    if (row < 0) return;
    lever(s, k, at, l);
    double fx = sign * force[0], fy = sign * force[1];
    put(s, row, fx);
    put(s, row + 1, fy);
    put(s, row + 2, sign * moment + l[0] * fy - l[1] * fx);
    add(s, row + 2, column, sign * moment_by[0]);
    for (int j = 1; j < 3; j++) {
        double gx = sign * (j == 1 ? c : -sn), gy = sign * (j == 1 ? sn : c);
        add(s, row, column + j, gx);
        add(s, row + 1, column + j, gy);
        add(s, row + 2, column + j, sign * moment_by[j] + l[0] * gy - l[1] * gx);
    }
    if (f->a) { /* the force turns with the first body */
        add(s, row, turned, -fy);
        add(s, row + 1, turned, fx);
        add(s, row + 2, turned, l[0] * fx + l[1] * fy);
    }
    add(s, row + 2, row + 2, -l[1] * fy - l[0] * fx); /* and the lever with its own */
}

static void flexure_rows(struct system *s, int index) {
    struct flexure *f = &s->model->flexure[index];
    const double *q = s->state->q;
    const double *p = s->state->p + 3 * index;
    int row = s->wrench + 3 * index, a = of_body(f->a), b = of_body(f->b);
    double from[2], to[2], la[2], lb[2];
    struct shot shot;
    model_root(s->model, q, f, 0, s->share, from);
    model_root(s->model, q, f, 1, s->share, to);
    lever(s, f->a, from, la);
    lever(s, f->b, to, lb);
    beam_shoot(f, p, 0, &shot);
    double angle = f->psi + q[3 * f->a + 2], c = cos(angle), sn = sin(angle);
    double dx = to[0] - from[0], dy = to[1] - from[1], lx = c * dx + sn * dy,
           ly = -sn * dx + c * dy;
    put(s, row, shot.turn - (q[3 * f->b + 2] - q[3 * f->a + 2]));
    put(s, row + 1, shot.x - lx);
    put(s, row + 2, shot.y - ly);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            add(s, row + i, row + j, shot.by[i][j]);
    if (f->a) {
        double vx = -la[1], vy = la[0]; /* of the root per turn */
        add(s, row, a + 2, 1);
        add(s, row + 1, a, c);
        add(s, row + 1, a + 1, sn);
        add(s, row + 1, a + 2, c * vx + sn * vy - ly);
        add(s, row + 2, a, -sn);
        add(s, row + 2, a + 1, c);
        add(s, row + 2, a + 2, -sn * vx + c * vy + lx);
    }
    if (f->b) {
        double vx = -lb[1], vy = lb[0];
        add(s, row, b + 2, -1);
        add(s, row + 1, b, -c);
        add(s, row + 1, b + 1, -sn);
        add(s, row + 1, b + 2, -c * vx - sn * vy);
        add(s, row + 2, b, sn);
        add(s, row + 2, b + 1, -c);
        add(s, row + 2, b + 2, sn * vx - c * vy);
    }
    double force[2] = {c * p[1] - sn * p[2], sn * p[1] + c * p[2]};
    root_wrench(s, f, f->a, from, 1, force, p[0], (double[3]){1, 0, 0}, row);
    root_wrench(s, f, f->b, to, -1, force, shot.moment, shot.moment_by, row);
}

/* Loads that go with the pose: their tangent by differences. */
static void load_rows(struct system *s) {
    int n = 3 * (s->model->bodies + 1);
    double q[3 * (BODIES + 1)], up[3 * (BODIES + 1)], down[3 * (BODIES + 1)];
    memcpy(q, s->state->q, sizeof q);
    memset(up, 0, sizeof up);
    model_loads(s->model, q, s->share, 0, up);
    for (int i = 3; i < n; i++)
        put(s, i - 3, up[i]);
    for (int j = 3; j < n; j++) {
        double step = j % 3 == 2 ? 1e-6 : 1e-4;
        memset(up, 0, sizeof up);
        memset(down, 0, sizeof down);
        q[j] = s->state->q[j] + step;
        model_loads(s->model, q, s->share, 0, up);
        q[j] = s->state->q[j] - step;
        model_loads(s->model, q, s->share, 0, down);
        q[j] = s->state->q[j];
        for (int i = 3; i < n; i++)
            add(s, i - 3, j - 3, (up[i] - down[i]) / (2 * step));
    }
}

/* One thing that is held: its miss, its gradient on the body, and the force m of it. */
static void hold(struct system *s, int row, int k, double miss, const double g[3], double m,
                 double curve) {
    int b = of_body(k);
    put(s, row, miss);
    for (int i = 0; i < 3; i++) {
        add(s, row, b + i, g[i]);
        add(s, b + i, row, g[i]);
        put(s, b + i, m * g[i]);
    }
    add(s, b + 2, b + 2, m * curve);
}

static void held_rows(struct system *s) {
    int row = s->held;
    const double *m = s->state->m;
    for (int i = 0; i < s->model->loads; i++) {
        const struct load *load = &s->model->load[i];
        const double *v = load->number;
        const double *q = s->state->q + 3 * load->body;
        if (load->kind == HOLD_SLIDE) {
            hold(s, row, load->body, q[0] - s->share * v[0], (double[3]){1, 0, 0}, m[0], 0);
            hold(s, row + 1, load->body, q[1] - s->share * v[1], (double[3]){0, 1, 0}, m[1], 0);
            hold(s, row + 2, load->body, q[2], (double[3]){0, 0, 1}, m[2], 0);
            row += 3;
            m += 3;
        } else if (load->kind == HOLD_TURN) {
            hold(s, row++, load->body, q[2] - s->share * v[0], (double[3]){0, 0, 1}, *m, 0);
            m++;
        } else if (load->kind == HOLD_ROD) {
            double at[2], l[2];
            model_point(s->model, s->state->q, load->body, v[0], v[1], at);
            lever(s, load->body, at, l);
            double dx = at[0] - v[2], dy = at[1] - v[3], length = hypot(dx, dy);
            double before = hypot(s->model->body[load->body].x + v[0] - v[2],
                                  s->model->body[load->body].y + v[1] - v[3]);
            double ux = dx / length, uy = dy / length, by = l[0] * uy - l[1] * ux;
            hold(s, row++, load->body, length - before - s->share * v[4], (double[3]){ux, uy, by},
                 *m, -(l[0] * ux + l[1] * uy));
            m++; /* the turn of ux, uy with the pose is left out: Newton's method does without it */
        }
    }
}

static int size_of(struct system *s) {
    s->wrench = 3 * s->model->bodies;
    s->held = s->wrench + 3 * s->model->flexures;
    s->n = s->held;
    for (int i = 0; i < s->model->loads; i++) {
        enum load_kind kind = s->model->load[i].kind;
        s->n += kind == HOLD_SLIDE ? 3 : kind == HOLD_ROD || kind == HOLD_TURN ? 1 : 0;
    }
    return s->n;
}

static void soften(struct model *model, double share) {
    for (int i = 0; i < model->loads; i++)
        if (model->load[i].kind == LOAD_HEAT)
            for (int k = 0; k < model->flexures; k++)
                model->flexure[k].softer = 1 + model->load[i].number[2] * share;
}

static void assemble(struct system *s) {
    memset(s->a, 0, (size_t)s->n * (size_t)s->n * sizeof *s->a);
    memset(s->r, 0, (size_t)s->n * sizeof *s->r);
    soften(s->model, s->share);
    for (int i = 0; i < s->model->flexures; i++)
        flexure_rows(s, i);
    load_rows(s);
    held_rows(s);
}

/* Eliminates the wrenches from their rows and from those of the bodies, whose own are then minus
 * the stiffness that they have through the strips. */
static int condense(struct system *s) {
    for (int k = s->wrench; k < s->held; k++) {
        int best = k;
        for (int i = k + 1; i < s->held; i++)
            if (fabs(*entry(s, i, k)) > fabs(*entry(s, best, k))) best = i;
        if (!(fabs(*entry(s, best, k)) > 0)) return 1;
        for (int j = 0; j < s->n; j++) {
            double t = *entry(s, k, j);
            *entry(s, k, j) = *entry(s, best, j);
            *entry(s, best, j) = t;
        }
        for (int i = 0; i < s->held; i++) {
            if (i >= s->wrench && i <= k) continue;
            double q = *entry(s, i, k) / *entry(s, k, k);
            if (q == 0) continue;
            for (int j = 0; j < s->held; j++)
                *entry(s, i, j) -= q * *entry(s, k, j);
        }
    }
    return 0;
}

/* The bodies' stiffness, with far stiffer springs for what holds them. */
static int stiffness_now(struct system *s, double *k) {
    int n = s->wrench;
    double size[2] = {0}; /* of ways and of turns */
    assemble(s);
    if (condense(s)) return 1;
    for (int i = 0; i < n; i++) {
        double *most = &size[i % 3 == 2];
        *most = fmax(*most, fabs(*entry(s, i, i)));
        for (int j = 0; j < n; j++)
            k[i * n + j] = -(*entry(s, i, j) + *entry(s, j, i)) / 2;
    }
    for (int h = s->held; h < s->n; h++) {
        double turns = 1;
        for (int i = 0; i < n; i++)
            if (i % 3 != 2 && fabs(*entry(s, h, i)) > 1e-9) turns = 0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                k[i * n + j] += 1e5 * size[turns > 0] * *entry(s, h, i) * *entry(s, h, j);
    }
    return 0;
}

/* Whether the energy is least: all pivots of that stiffness are above 0. */
static int stable(struct system *s) {
    static double k[9 * BODIES * BODIES];
    int n = s->wrench;
    if (stiffness_now(s, k)) return 0;
    for (int p = 0; p < n; p++) {
        if (!(k[p * n + p] > 0)) return 0;
        for (int i = p + 1; i < n; i++)
            for (int j = p + 1; j < n; j++)
                k[i * n + j] -= k[i * n + p] * k[p * n + j] / k[p * n + p];
    }
    return 1;
}

int statics_settle(struct model *model, double share, struct state *state, int *sign) {
    static double a[UNKNOWNS * UNKNOWNS], r[UNKNOWNS];
    struct system s = {.model = model, .state = state, .share = share, .a = a, .r = r};
    double before = HUGE_VAL;
    size_of(&s);
    for (int round = 0; round < 25; round++) {
        assemble(&s);
        double miss = 0; /* um, or a hundredth of a radian: of the strips' ends, and of the step */
        for (int i = s.wrench; i < s.held; i++)
            miss = fmax(miss, fabs(r[i]) * (i % 3 == 0 ? 100 : 1));
        for (int i = 0; i < s.n; i++)
            r[i] = -r[i];
        *sign = solve_dense(s.n, a, r);
        for (int i = 0; i < s.wrench; i++)
            miss = fmax(miss, fabs(r[i]) * (i % 3 == 2 ? 100 : 1));
        if (!*sign || !isfinite(miss) || miss > 1e3) return 1;
        for (int i = 0; i < s.wrench; i++)
            state->q[3 + i] += r[i];
        for (int i = s.wrench; i < s.held; i++)
            state->p[i - s.wrench] += r[i];
        for (int i = s.held; i < s.n; i++)
            state->m[i - s.held] += r[i];
        if (miss < 1e-8 || (miss < 1e-6 && miss > 0.2 * before)) return stable(&s) ? 0 : 2;
        if (round > 3 && miss > before) return 1;
        before = miss;
    }
    return 1;
}

int statics_stiffness_at(struct model *model, double share, const struct state *state, double *k) {
    static double a[UNKNOWNS * UNKNOWNS], r[UNKNOWNS];
    struct system s = {.model = model, .state = state, .share = share, .a = a, .r = r};
    size_of(&s);
    return stiffness_now(&s, k);
}

void statics_answer(const struct model *model, const struct state *state, struct answer *out) {
    memset(out, 0, sizeof *out);
    for (int i = 0; i < model->flexures; i++) {
        struct shot shot;
        beam_shoot(&model->flexure[i], state->p + 3 * i, 1, &shot);
        out->stress[i] = shot.worst;
        out->roots[i] = shot.roots;
        out->at[i] = shot.at;
        out->most = fmax(out->most, shot.worst);
    }
}

static void extrapolate(const struct state *a, const struct state *b, double by,
                        struct state *out) {
    for (int i = 0; i < 3 * (BODIES + 1); i++)
        out->q[i] = b->q[i] + by * (b->q[i] - a->q[i]);
    for (int i = 0; i < 3 * FLEXURES; i++)
        out->p[i] = b->p[i] + by * (b->p[i] - a->p[i]);
    for (int i = 0; i < 3 * LOADS; i++)
        out->m[i] = b->m[i] + by * (b->m[i] - a->m[i]);
}

int statics_follow(struct model *model, double share, double stress, struct state *state,
                   double *reached, struct answer *out) {
    struct state last = {0}, now = {0}, next;
    double at = 0, before = 0, step = 1e-3 * share, had = 0;
    int rest = 0, sign = 0;
    if (statics_settle(model, 0, &now, &rest)) return 1;
    memset(&now, 0, sizeof now);
    memset(out, 0, sizeof *out);
    if (stress >
        0) { /* begin with a thousandth of it, in the linear range (combs: with the root of that) */
        double tiny = fmin(1e-6, 1e-3 * share);
        next = now;
        if (statics_settle(model, tiny, &next, &sign)) return 1;
        statics_answer(model, &next, out);
        step = fmin(step, tiny * 1e-3 * stress / out->most);
    }
    double least = 1e-6 * step;
    while (at < share * (1 - 1e-15)) {
        double to = fmin(at + step, share);
        if (at > before)
            extrapolate(&last, &now, (to - at) / (at - before), &next);
        else
            next = now;
        int lost = statics_settle(model, to, &next, &sign) || sign != rest;
        if (!lost) statics_answer(model, &next, out);
        /* no more than a tenth of the stress aimed at in one step: the branch is not left */
        if (lost || (stress > 0 && out->most - had > 0.1 * stress && to - at > least)) {
            step *= 0.5;
            if (step < least) return 1;
            continue;
        }
        if (stress > 0 &&
            out->most >= stress) { /* between at and to: regula falsi from the state before */
            double low = at, high = to, f_low = had - stress, f_high = out->most - stress;
            struct state base = now;
            for (int i = 0; i < 60 && fabs(f_high) > 1e-9 * stress; i++) {
                double mid = low + (high - low) * fmin(0.98, fmax(0.02, -f_low / (f_high - f_low)));
                next = base;
                if (statics_settle(model, mid, &next, &sign)) return 1;
                statics_answer(model, &next, out);
                if (out->most >= stress)
                    high = mid, f_high = out->most - stress;
                else
                    low = mid, f_low = out->most - stress, base = next;
                if (high - low < 1e-13 * high) break;
            }
            *reached = high;
            *state = next;
            if (statics_settle(model, high, state, &sign)) return 1;
            statics_answer(model, state, out);
            return 0;
        }
        last = now;
        before = at;
        now = next;
        at = to;
        had = out->most;
        step *= 1.7;
    }
    *reached = at;
    *state = now;
    statics_settle(model, at, state, &sign);
    statics_answer(model, state, out);
    return stress > 0;
}

void statics_stiffness(struct model *model, double *k) {
    static double a[UNKNOWNS * UNKNOWNS], r[UNKNOWNS];
    int n = 3 * model->bodies;
    struct state rest = {0};
    soften(model, 0);
    for (int j = 0; j < n; j++) {
        double force[3 * (BODIES + 1)] = {0};
        double step = j % 3 == 2 ? 1e-6 : 1e-4;
        for (int side = -1; side < 2; side += 2) {
            struct state moved = rest;
            moved.q[3 + j] = side * step;
            struct system s = {.model = model, .state = &moved, .a = a, .r = r};
            size_of(&s);
            for (int i = 0; i < model->flexures; i++) {
                struct flexure *f = &model->flexure[i];
                double from[2], to[2], turn = moved.q[3 * f->b + 2] - moved.q[3 * f->a + 2];
                struct shot shot;
                model_root(model, moved.q, f, 0, 0, from);
                model_root(model, moved.q, f, 1, 0, to);
                double c = cos(f->psi + moved.q[3 * f->a + 2]),
                       sn = sin(f->psi + moved.q[3 * f->a + 2]);
                double dx = to[0] - from[0], dy = to[1] - from[1];
                (void)beam_hold(f, (double[3]){turn, c * dx + sn * dy, -sn * dx + c * dy},
                                moved.p + 3 * i, &shot);
            }
            memset(a, 0, sizeof a);
            memset(r, 0, sizeof r);
            for (int i = 0; i < model->flexures; i++)
                flexure_rows(&s, i);
            for (int i = 0; i < n; i++)
                force[i] += side * r[i] / (2 * step);
        }
        for (int i = 0; i < n; i++)
            k[i * n + j] = -force[i];
    }
}
