/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/model.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct search {
    fw_model *model;
    double *u, *trial, *step, *psi, *lambda;
    double promise; /* first-order decrease of |Psi|^2 along the step */
} search;

/* squared norm of Psi at u; psi and the arms are set */
static double mismatch(search *s, const double *u) {
    fw_model_residual(s->model, 0, u, s->psi);
    double sum = 0;
    for (int i = 0; i < 2 * s->model->nblock; i++)
        sum += s->psi[i] * s->psi[i];
    return sum;
}

/* step = -M^-1 G^T (S + eps s I)^-1 Psi with s the largest diagonal entry of S: a descent direction
   of |Psi|^2 for every eps, since S (S + eps s I)^-1 is positive. No body turns by more than half a
   radian. */
static bool newton_step(search *s, double epsilon) {
    fw_model *m = s->model;
    double *d = m->chain.diagonal, largest = 0;
    fw_model_residual(m, 0, s->u, s->psi);
    fw_chain_assemble(m);
    for (int i = 0; i < m->nblock; i++)
        largest = fmax(largest, fmax(d[3 * i], d[3 * i + 2]));
    for (int i = 0; i < m->nblock; i++) {
        d[3 * i] += epsilon * largest;
        d[3 * i + 2] += epsilon * largest;
    }
    if (!fw_chain_factor(&m->chain, 0)) return false;
    memcpy(s->lambda, s->psi, 2 * (size_t)m->nblock * sizeof(double));
    fw_chain_solve(&m->chain, s->lambda);
    memset(s->step, 0, (size_t)m->nq * sizeof(double));
    fw_model_apply(m, s->lambda, s->step);
    double most = 0;
    for (int i = 0; i < m->nq; i++)
        most = fmax(most, fabs(s->step[i]) / (i % 3 == 2 ? 0.5 : 1));
    if (!(most < (double)INFINITY)) return false;
    for (int i = 0; i < m->nq && most > 1; i++)
        s->step[i] /= most;
    fw_model_jacobian(m, s->step, s->lambda);
    s->promise = 0;
    for (int i = 0; i < 2 * m->nblock; i++)
        s->promise -= 2 * s->psi[i] * s->lambda[i];
    return s->promise > 0;
}

/* halves the step until |Psi|^2 falls by a share of what its slope promises (Armijo); the share of
   the step that was taken, 0 when none descends */
static double line_search(search *s, double *value) {
    int n = s->model->nq;
    double fraction = 1;
    for (int halving = 0; halving < 12; halving++, fraction /= 2) {
        for (int i = 0; i < n; i++)
            s->trial[i] = s->u[i] + fraction * s->step[i];
        double next = mismatch(s, s->trial);
        if (next <= *value - 1e-4 * fraction * s->promise) {
            memcpy(s->u, s->trial, (size_t)n * sizeof(double));
            *value = next;
            return fraction;
        }
    }
    return 0;
}

/* damped Newton in the mass metric with a proximal term that grows where the plain step does not
   descend (near positions that cannot be assembled). Ends below 4 eps of the size, or when no step
   descends. Source: Levenberg 1944, Marquardt 1963; the mass metric as in multibody projection.
   Test: test_assemble.c. */
static bool solve(search *s) {
    static const double epsilon[] = {1e-8, 1e-5, 1e-3, 1e-2, 1e-1, 1, 10, 100};
    const int levels = sizeof epsilon / sizeof epsilon[0];
    double goal = 4 * DBL_EPSILON * s->model->size, value = mismatch(s, s->u);
    int level = 0, idle = 0;
    for (int i = 0; i < 500 && idle < 20; i++) {
        double worst = fw_model_residual(s->model, 0, s->u, s->psi);
        if (worst <= goal) return true;
        double before = value;
        double taken = newton_step(s, epsilon[level]) ? line_search(s, &value) : 0;
        if (taken == 0 && level + 1 == levels) break;
        if (taken < 0.25 && level + 1 < levels)
            level++; /* short steps zigzag across a valley: damp */
        else if (taken == 1 && level > 0 && value < before - 0.5 * s->promise)
            level--;
        /* no progress: round-off, or the closest that an impossible mechanism comes */
        idle = value < (1 - 1e-7) * before ? 0 : idle + 1;
    }
    return fw_model_residual(s->model, 0, s->u, s->psi) <= 1e-13 * s->model->size;
}

static fw_status cannot_close(const search *s, const fw_mechanism *mechanism, fw_diags *diags) {
    const fw_model *m = s->model;
    int worst = 0;
    double most = -1;
    for (int i = 0; i < m->nblock; i++) {
        double gap = hypot(s->psi[2 * i], s->psi[2 * i + 1]);
        if (gap > most || isnan(gap)) most = gap, worst = i;
    }
    const fw_block *b = &m->block[worst];
    const fw_driver *driver = b->driver != FW_NONE ? &mechanism->driver[b->driver] : NULL;
    const char *id = b->pin != FW_NONE   ? mechanism->pin[b->pin].id
                     : b->tie != FW_NONE ? mechanism->tie[b->tie].id
                                         : driver->id;
    fw_place place = {0};
    if (b->tie != FW_NONE) place = mechanism->tie[b->tie].place;
    if (driver) place = driver->place;
    if (b->pin != FW_NONE && mechanism->device && b->pin < mechanism->device->njoint)
        place = mechanism->device->joint[b->pin].place;
    char gap[32];
    fw_status status = fw_diag_error(
        diags, 100, place,
        "the mechanism cannot be assembled: joint %s stays open by %s um at best; check "
        "the joint points and the lengths around this loop",
        id ? id : "(unnamed)", fw_number_text(gap, sizeof gap, most * m->scale.length_m * 1e6, 4));
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

fw_status fw_assemble(fw_arena *arena, const fw_mechanism *mechanism, double *q, double *moved_m,
                      fw_diags *diags) {
    search s = {0};
    size_t n = 3 * (size_t)mechanism->nbody;
    *moved_m = 0;
    for (size_t i = 0; i < n; i++)
        if (!isfinite(q[i]))
            return fw_diag_error(diags, 105, (fw_place){0},
                                 "the position to assemble is not finite");
    if (mechanism->nbody == 0 || mechanism->npin + mechanism->ntie == 0) return FW_OK;
    FW_TRY(fw_model_new(arena, mechanism, NULL, q, 1, NULL, diags, &s.model));
    size_t rows = 2 * (size_t)s.model->nblock;
    FW_NEED(s.u = fw_arena_array(arena, double, n));
    FW_NEED(s.trial = fw_arena_array(arena, double, n));
    FW_NEED(s.step = fw_arena_array(arena, double, n));
    FW_NEED(s.psi = fw_arena_array(arena, double, rows));
    FW_NEED(s.lambda = fw_arena_array(arena, double, rows));
    if (!solve(&s)) return cannot_close(&s, mechanism, diags);
    for (size_t b = 0; b < n; b += 3) {
        double dx = s.model->scale.length_m * s.u[b], dy = s.model->scale.length_m * s.u[b + 1];
        q[b] += dx;
        q[b + 1] += dy;
        q[b + 2] += s.u[b + 2];
        *moved_m = fmax(*moved_m, hypot(dx, dy));
    }
    return FW_OK;
}
