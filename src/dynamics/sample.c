/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read off the steps: evenly spaced rows, the observer's instants. All from the dense
   output; rows are projected like accepted steps. */
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

/* behind everything else of a row: the residual leaves nothing that the next step reads */
static void store_energy(fw_run *r, size_t row, double t, const double *y) {
    fw_model *m = r->model;
    double speed = m->scale.length_m / m->scale.time_s, joule = m->scale.mass_kg * speed * speed;
    fw_model_at(m, t);
    fw_model_pose(m, y);
    const fw_energy e = fw_model_energy(m, t, y);
    double *out = r->motion->energy_J + 4 * row;
    out[0] = joule * e.kinetic, out[1] = joule * e.elastic;
    out[2] = joule * e.dissipated, out[3] = joule * e.work;
    r->motion->constraint_norm[row] = fw_model_residual(m, t, y, m->right);
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
    if (out->energy_J) store_energy(r, row, t, y);
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
    fw_model_at(m, t);
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

/* who looks at this run, NULL: nobody */
static fw_observer observer(const fw_run *r, void **context) {
    *context = r->full ? r->motion->observed : r->motion->compared;
    return r->full || *context ? r->options->observe : NULL;
}

void fw_run_show_start(fw_run *r) {
    void *context;
    fw_observer see = observer(r, &context);
    if (see) see(context, NULL);
}

static void forces_at(fw_run *r, fw_stepper *s, double theta, double *force) {
    fw_stepper_dense(s, theta, r->state);
    fw_model_react(r->model, s->t_old + theta * s->h, r->state, r->rate);
    fw_pin_forces(r->model, force);
}

/* Where states are interpolated between a method's own ones, stiff axes make large forces of the
   error of that: forces are then interpolated instead, between those of the own states */
static bool own_forces(fw_run *r, fw_stepper *s, double theta_end, fw_grid *g) {
    if (!s->row->own) return false;
    size_t count = 2 * (size_t)r->mechanism->npin;
    fw_run_places(s, theta_end, g);
    for (int k = 0; k <= g->last; k++)
        forces_at(r, s, theta_end * g->at[k], r->seen_grid + (size_t)k * count);
    return true;
}

void fw_run_show(fw_run *r, fw_stepper *s, double theta_end) {
    void *context;
    fw_observer see = observer(r, &context);
    if (!see) return;
    bool fresh = r->fresh || !(s->t_old > 0);
    int count = 2 * r->mechanism->npin;
    fw_grid g;
    bool own = own_forces(r, s, theta_end, &g);
    r->fresh = false;
    for (int i = fresh ? 0 : 1; i <= FW_INSTANTS; i++) {
        double part = (double)i / FW_INSTANTS, theta = theta_end * i / FW_INSTANTS;
        if (own)
            fw_stepper_dense(s, theta, r->state);
        else
            forces_at(r, s, theta, r->seen_force);
        for (int k = 0; own && k < count; k++)
            r->seen_force[k] = fw_run_between(&g, r->seen_grid + k, count, part);
        pose_in_SI(r, r->state, r->seen_q, r->seen_angle);
        const fw_instant now = {.t_s = (s->t_old + theta * s->h) * r->model->scale.time_s,
                                .q = r->seen_q,
                                .angle_rad = r->seen_angle,
                                .reaction_N = r->seen_force,
                                .begins = fresh && i == 0,
                                .hinge = r->motion->ledger.hinge.used};
        see(context, &now);
    }
}
