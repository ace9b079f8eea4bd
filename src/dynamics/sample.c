/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read off the steps: evenly spaced rows, the observer's instants, extremes of the joint
   forces. All from the dense output; rows are projected like accepted steps. */
#include "multibody/reactions.h"
#include "dynamics/run.h"
#include <math.h>
#include <string.h>

/* state y in SI: pose and joint angles */
static void pose_in_SI(const fw_run *r, const double *y, double *q, double *angle) {
    const fw_model *m = r->model;
    for (int i = 0; i < m->nq; i++)
        q[i] = r->q0[i] + (i % 3 == 2 ? 1 : m->scale.length_m) * y[i];
    for (int i = 0; i < r->mechanism->npin; i++) {
        const fw_pin *p = &r->mechanism->pin[i];
        angle[i] = (p->body_b == FW_GROUND ? 0 : q[3 * p->body_b + 2]) -
                   (p->body_a == FW_GROUND ? 0 : q[3 * p->body_a + 2]) - p->free_angle_rad;
    }
}

static void store(fw_run *r, double t_s, double t, const double *y) {
    fw_motion *out = r->motion;
    fw_model *m = r->model;
    const fw_scale s = m->scale;
    size_t row = (size_t)r->row, base = row * (size_t)m->nq;
    out->t_s[row] = t_s;
    pose_in_SI(r, y, out->q + base, out->angle_rad + row * (size_t)out->npin);
    fw_model_react(m, t, y, r->rate);
    for (int i = 0; i < m->nq; i++) {
        double unit = (i % 3 == 2 ? 1 : s.length_m) / s.time_s;
        out->v[base + (size_t)i] = unit * y[m->nq + i];
        out->accel[base + (size_t)i] = unit / s.time_s * r->rate[m->nq + i];
    }
    fw_pin_forces(m, out->reaction_N + row * 2 * (size_t)out->npin);
    fw_tie_forces(m, r->mechanism, out->tie_N + row * 3 * (size_t)out->ntie,
                  out->driver_N + row * (size_t)out->ndriver);
    r->row++;
}

static double sample_time(const fw_run *r, int row) {
    int last = r->motion->nsample - 1;
    return row == last ? r->scene->duration_s : r->scene->duration_s * row / (last > 0 ? last : 1);
}

void fw_run_first_sample(fw_run *r, const double *y) {
    r->row = 0;
    if (r->motion->nsample > 0) store(r, 0, 0, y);
}

/* onto the constraints, as accepted steps are; without projection as it is. A step that cannot be
   projected is made shorter, but a row lies where it was asked for: where that is so near a
   singular position that Newton's method goes astray, the row stays as integrated, within the
   tolerance, and the constraint norm tells. */
static bool settle(fw_run *r, double t, double *y) {
    fw_model *m = r->model;
    if (!m->projecting) return true;
    memcpy(r->moved, y, (size_t)m->nq * sizeof *y);
    fw_model_pose(m, y);
    if (!m->method->factor(m)) return false;
    if (!fw_model_project_position(m, t, y)) {
        memcpy(y, r->moved, (size_t)m->nq * sizeof *y);
        double norm = fw_model_residual(m, t, y, m->right);
        if (!(norm < (double)INFINITY)) return false;
        m->worst_position = fmax(m->worst_position, norm);
    }
    return m->method->factor(m) && fw_model_project_velocity(m, t, y + m->nq);
}

bool fw_run_samples(fw_run *r, fw_stepper *s, double theta_end) {
    fw_model *m = r->model;
    double reached = theta_end < 1 ? s->t_old + theta_end * s->h : s->t;
    double final = r->end[r->npiece - 1];
    for (; r->row < r->motion->nsample;) {
        double t_s = sample_time(r, r->row), t = t_s / m->scale.time_s;
        bool end = r->row == r->motion->nsample - 1;
        if (end ? reached < final : t > reached) return true;
        if (theta_end == 1 && (t >= s->t || end)) {
            store(r, t_s, s->t, s->y);
            continue;
        }
        fw_stepper_dense(s, fmin(theta_end, (t - s->t_old) / s->h), r->state);
        if (!settle(r, t, r->state)) return false;
        store(r, t_s, t, r->state);
    }
    return true;
}

void fw_run_show(fw_run *r, fw_stepper *s, double theta_end) {
    if (!r->options->observe) return;
    for (int i = s->t_old > 0 ? 1 : 0; i <= FW_INSTANTS; i++) {
        double theta = theta_end * i / FW_INSTANTS;
        fw_stepper_dense(s, theta, r->state);
        pose_in_SI(r, r->state, r->seen_q, r->seen_angle);
        fw_model_react(r->model, s->t_old + theta * s->h, r->state, r->rate);
        fw_pin_forces(r->model, r->seen_force);
        const fw_instant now = {(s->t_old + theta * s->h) * r->model->scale.time_s, r->seen_q,
                                r->seen_angle, r->seen_force};
        r->options->observe(r->options->context, &now);
    }
}

/* ---- extremes of the joint forces ---- */

static void forces_at(fw_run *r, fw_stepper *s, double theta) {
    const fw_model *m = r->model;
    fw_stepper_dense(s, theta, r->state);
    fw_model_react(r->model, s->t_old + theta * s->h, r->state, r->rate);
    for (int i = 0; i < m->npin; i++) {
        const double *l = m->lambda + 2 * m->pin_block[i];
        r->force_now[i] = fw_newton(m) * sqrt(l[0] * l[0] + l[1] * l[1]);
    }
}

static void offer(fw_force_peak *peak, double force, double t) {
    if (force > peak->force_N) peak->force_N = force, peak->t_s = t;
}

enum { GRID = 8 };

/* Chebyshev-Lobatto points of [0, 1]: a polynomial through values there does not swing */
static double place(int k) {
    static const double PI = 3.14159265358979323846;
    return 0.5 - 0.5 * cos(PI * k / GRID);
}

/* the polynomial of degree 8 through one force at the nine places (column of the grid), by the
   barycentric formula; its error in a step of one radian is some 1e-10. Source: Berrut and
   Trefethen 2004. */
static double between(const double *column, int stride, double x) {
    double above = 0, below = 0;
    for (int k = 0; k <= GRID; k++) {
        double distance = x - place(k), weight = (k % 2 ? -1.0 : 1.0) * (k % GRID ? 1 : 0.5);
        if (distance == 0) return column[k * stride];
        above += weight / distance * column[k * stride];
        below += weight / distance;
    }
    return above / below;
}

/* maximum of that polynomial in [a, b] by golden section; no further evaluation of forces */
static double highest(const double *column, int stride, double a, double b, double *at) {
    const double golden = 0.6180339887498949;
    double x = b - golden * (b - a), y = a + golden * (b - a);
    double fx = between(column, stride, x), fy = between(column, stride, y);
    for (int i = 0; i < 40 && b - a > 1e-8; i++) {
        if (fx > fy) {
            b = y, y = x, fy = fx, x = b - golden * (b - a);
            fx = between(column, stride, x);
        } else {
            a = x, x = y, fx = fy, y = a + golden * (b - a);
            fy = between(column, stride, y);
        }
    }
    *at = fx > fy ? x : y;
    return fmax(fx, fy);
}

/* every force at nine places of the step; where an inner one is highest and comes near the peak so
   far, the maximum between its neighbours is searched. Cost nine evaluations per step, whatever the
   number of joints. */
void fw_run_forces(fw_run *r, fw_stepper *s, double theta_end) {
    if (!r->force) return;
    int pins = r->model->npin;
    double *grid = r->force_grid, span = theta_end * s->h;
    for (int k = 0; k <= GRID; k++) {
        forces_at(r, s, theta_end * place(k));
        for (int i = 0; i < pins; i++)
            grid[k * pins + i] = r->force_now[i];
    }
    for (int i = 0; i < pins; i++) {
        int best = 0;
        for (int k = 1; k <= GRID; k++)
            if (grid[k * pins + i] > grid[best * pins + i]) best = k;
        double most = grid[best * pins + i], at;
        offer(&r->force[i], most, s->t_old + place(best) * span);
        if (best == 0 || best == GRID) continue;
        double before = grid[(best - 1) * pins + i], after = grid[(best + 1) * pins + i];
        /* a parabola through three points rises above the middle one by less than its bend */
        if (most + fabs(before - 2 * most + after) < r->force[i].force_N) continue;
        double top = highest(grid + i, pins, place(best - 1), place(best + 1), &at);
        offer(&r->force[i], top, s->t_old + at * span);
    }
}
