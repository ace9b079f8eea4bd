/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Descent onto Psi(q) = 0, and along it to the pose nearest to the guess. */
#include "assembly/closure.h"
#include "base/constants.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* what every block keeps (its law included), from Psi at the guess */
static void find_kept(fw_assembly_closure *c, const fw_multibody_pose *pose) {
    const fw_multibody_model *m = c->model;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        double d[2], e[2], n[2];
        fw_multibody_frame(m, pose, i, d, e, n);
        double now = b->rows == FW_ROWS_ROD      ? hypot(d[0], d[1])
                     : b->rows == FW_ROWS_TRAVEL ? e[0] * d[0] + e[1] * d[1]
                                                 : 0; /* TURN, SLIDE: angles since the guess */
        c->kept[i] = b->rows == FW_ROWS_PIN ? 0 : now - c->psi[2 * i];
    }
}

fw_status fw_assembly_closure_new(fw_arena *arena, const fw_mechanism *mechanism, const double *q,
                                  fw_diags *diags, fw_assembly_closure *c) {
    const fw_multibody_model *m;
    FW_TRY(fw_multibody_model_new(arena, mechanism, NULL, q, 1, NULL, &m));
    size_t n = (size_t)m->nq, k = (size_t)m->nblock;
    *c = (fw_assembly_closure){
        .arena = arena, .model = m, .goal = 4 * DBL_EPSILON * m->size, .left = 2000};
    FW_TRY(fw_multibody_system_new(arena, m, mechanism, diags, &c->system));
    FW_TRY(fw_multibody_chain_numbers_new(arena, m, &c->chain));
    FW_NEED(c->held = fw_arena_array(arena, double, n));
    FW_NEED(c->wanted = fw_arena_array(arena, double, n));
    FW_NEED(c->u = fw_arena_array(arena, double, n));
    FW_NEED(c->trial = fw_arena_array(arena, double, n));
    FW_NEED(c->step = fw_arena_array(arena, double, n));
    FW_NEED(c->psi = fw_arena_array(arena, double, 2 * k));
    FW_NEED(c->lambda = fw_arena_array(arena, double, 2 * k));
    FW_NEED(c->kept = fw_arena_array(arena, double, k));
    FW_NEED(c->active = fw_arena_array(arena, bool, k));
    FW_NEED(c->soft = fw_arena_array(arena, double, 2 * k));
    for (size_t i = 0; i < k; i++)
        c->active[i] = true, c->soft[2 * i] = c->soft[2 * i + 1] = 1;
    c->system->piece_s = DBL_MIN; /* the piece of the laws that begins at 0 */
    const fw_multibody_pose *pose = fw_multibody_pose_at(c->system, 0, c->u);
    fw_multibody_residual(c->system, pose, c->psi);
    find_kept(c, pose);
    return FW_OK;
}

static double worst_gap(const fw_assembly_closure *c) {
    double worst = 0;
    for (int i = 0; i < c->model->nblock; i++) {
        double gap = hypot(c->psi[2 * i], c->psi[2 * i + 1]);
        if (c->active[i] && !(gap <= worst)) worst = gap; /* NaN too */
    }
    return worst;
}

double fw_assembly_closure_mismatch(fw_assembly_closure *c, const double *u,
                                    const fw_multibody_pose **pose) {
    const fw_multibody_pose *at = fw_multibody_pose_at(c->system, 0, u);
    double sum = 0;
    fw_multibody_residual(c->system, at, c->psi);
    if (pose) *pose = at;
    for (int i = 0; i < c->model->nblock; i++) {
        if (!c->active[i]) c->psi[2 * i] = c->psi[2 * i + 1] = 0;
        double x = c->psi[2 * i] / c->soft[2 * i], y = c->psi[2 * i + 1] / c->soft[2 * i + 1];
        sum += x * x + y * y;
    }
    return sum;
}

/* rows and columns of blocks that do not count become those of the unit matrix */
static void leave_out(const fw_assembly_closure *c) {
    const fw_multibody_chain *chain = &c->model->chain;
    for (int k = 0; k < chain->pins; k++) {
        double *d = c->chain.diagonal + 3 * k;
        if (!c->active[k]) d[0] = d[2] = 1, d[1] = 0;
        for (int e = chain->column[k]; e < chain->column[k + 1]; e++)
            if (!c->active[k] || !c->active[chain->row[e]])
                memset(c->chain.block + 4 * e, 0, 4 * sizeof *c->chain.block);
    }
}

/* step = -M^-1 G^T (S + mu s W)^-1 Psi, s the largest diagonal entry of S and W = soft^2: for every
   mu > 0 a descent direction of Psi^T W^-1 Psi, since with T = W^-1/2 S W^-1/2 its slope is -2 p^T
   T (T + mu s)^-1 p for p = W^-1/2 Psi. mu = 0: a proximal shift that goes down with Psi, because
   where a loop closes only just, S goes like Psi and a fixed shift would stop the descent. No body
   turns by more than half a radian or goes farther than the scene's length. */
static bool newton_step(fw_assembly_closure *c, double mu) {
    const fw_multibody_model *m = c->model;
    const fw_multibody_pose *pose;
    double *d = c->chain.diagonal, largest = 0;
    fw_assembly_closure_mismatch(c, c->u, &pose);
    double shift = fmax(1e-14, fmin(fw_epsilon, 1e-2 * worst_gap(c)));
    fw_multibody_chain_assemble(m, pose, &c->chain);
    leave_out(c);
    for (int i = 0; i < m->nblock; i++)
        if (c->active[i]) largest = fmax(largest, fmax(d[3 * i], d[3 * i + 2]));
    for (int i = 0; i < m->nblock && mu > 0; i++) {
        d[3 * i] += mu * largest * c->soft[2 * i] * c->soft[2 * i];
        d[3 * i + 2] += mu * largest * c->soft[2 * i + 1] * c->soft[2 * i + 1];
    }
    if (!fw_multibody_chain_factor(&m->chain, &c->chain, mu > 0 ? 0 : shift)) return false;
    memcpy(c->lambda, c->psi, 2 * (size_t)m->nblock * sizeof(double));
    fw_multibody_chain_solve(&m->chain, &c->chain, c->lambda);
    memset(c->step, 0, (size_t)m->nq * sizeof(double));
    fw_multibody_apply(m, pose, c->lambda, c->step);
    double most = 0;
    for (int i = 0; i < m->nq; i++) {
        double size = fabs(c->step[i]) / (i % 3 == 2 ? 0.5 : 1);
        if (!(size <= most)) most = size;
    }
    if (!(most < (double)INFINITY)) return false;
    for (int i = 0; i < m->nq && most > 1; i++)
        c->step[i] /= most;
    fw_multibody_jacobian(m, pose, c->step, c->lambda);
    c->promise = 0;
    for (int i = 0; i < 2 * m->nblock; i++)
        c->promise -= 2 * c->psi[i] * c->lambda[i] / (c->soft[i] * c->soft[i]);
    return c->promise > 0;
}

/* halves the step until the mismatch falls by a share of what its slope promises (Armijo); the
   share of the step that was taken, 0 when none descends */
static double line_search(fw_assembly_closure *c, double *value) {
    int n = c->model->nq;
    double fraction = 1;
    for (int halving = 0; halving < 12; halving++, fraction /= 2) {
        for (int i = 0; i < n; i++)
            c->trial[i] = c->u[i] + fraction * c->step[i];
        double next = fw_assembly_closure_mismatch(c, c->trial, NULL);
        if (next <= *value - 1e-4 * fraction * c->promise) {
            memcpy(c->u, c->trial, (size_t)n * sizeof(double));
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
bool fw_assembly_closure_descend(fw_assembly_closure *c, int most) {
    static const double mu[] = {0, 1e-5, 1e-3, 1e-2, 1e-1, 1, 10, 100};
    const int levels = sizeof mu / sizeof mu[0];
    double value = fw_assembly_closure_mismatch(c, c->u, NULL);
    int level = 0, idle = 0;
    for (int i = 0; i < most && idle < 20 && c->left > 0; i++) {
        fw_assembly_closure_mismatch(c, c->u, NULL);
        if (worst_gap(c) <= c->goal) return true;
        double before = value;
        double taken = newton_step(c, mu[level]) ? line_search(c, &value) : 0;
        c->iterations++, c->left--;
        if (fw_arena_cancelled(c->arena)) c->left = 0;
        if (taken == 0 && level + 1 == levels) break;
        if (taken < 0.25 && level + 1 < levels)
            level++; /* short steps zigzag across a valley: damp */
        else if (taken == 1 && level > 0 && value < before - 0.5 * c->promise)
            level--;
        /* no progress: round-off, or the closest that an impossible mechanism comes */
        idle = value < (1 - 1e-7) * before ? 0 : idle + 1;
    }
    fw_assembly_closure_mismatch(c, c->u, NULL);
    return worst_gap(c) <= 1e-13 * c->model->size;
}

double fw_assembly_closure_distance(const fw_assembly_closure *c, const double *u) {
    const fw_multibody_model *m = c->model;
    double sum = 0;
    for (int b = 0; b < m->nbody; b++) {
        const double *v = u + 3 * b;
        sum += m->mass[b] * (v[0] * v[0] + v[1] * v[1]) + m->inertia[b] * v[2] * v[2];
    }
    return sum;
}

/* c->step = towards the point nearest to 0 on the tangent plane at the closed c->u */
static bool tangent_step(fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    const fw_multibody_pose *pose;
    fw_assembly_closure_mismatch(c, c->u, &pose);
    fw_multibody_jacobian(m, pose, c->u, c->lambda);
    for (int i = 0; i < 2 * m->nblock; i++)
        c->psi[i] -= c->lambda[i];
    fw_multibody_chain_assemble(m, pose, &c->chain);
    if (!fw_multibody_chain_factor(&m->chain, &c->chain, fw_epsilon)) return false;
    fw_multibody_chain_proximal(m, pose, &c->chain, c->psi, c->lambda);
    memset(c->step, 0, (size_t)m->nq * sizeof(double));
    fw_multibody_apply(m, pose, c->lambda, c->step);
    for (int i = 0; i < m->nq; i++)
        c->step[i] -= c->u[i];
    return true;
}

/* min u^T M u over Psi(u) = 0 from a closed u: steps to the nearest point of the tangent plane,
   each closed again by Newton, shortened until the distance falls. Every iterate is closed, so any
   of them is a valid answer. Converges linearly, fast where the guess is near. Source: Gauss-Newton
   with retraction; Absil, Mahony and Sepulchre 2008, ch. 4. Test: test_assemble.c (nearest). */
void fw_assembly_closure_nearest(fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    size_t bytes = (size_t)m->nq * sizeof(double);
    double distance = fw_assembly_closure_distance(c, c->u), *held = c->held;
    for (int i = 0; i < 100 && distance > 0; i++) {
        memcpy(held, c->u, bytes);
        if (!tangent_step(c)) return;
        double turned = 0, before = distance, fraction = 1;
        for (int k = 0; k < m->nq; k++)
            turned = fmax(turned, fabs(c->step[k]));
        if (!(turned > 1e-9)) return;
        memcpy(c->wanted, c->step, bytes); /* descending needs c->step */
        for (int halving = 0; halving < 8; halving++, fraction /= 2) {
            for (int k = 0; k < m->nq; k++)
                c->u[k] = held[k] + fraction * c->wanted[k];
            bool closed = fw_assembly_closure_descend(c, 12);
            double now = fw_assembly_closure_distance(c, c->u);
            if (closed && now < distance) {
                distance = now;
                break;
            }
            memcpy(c->u, held, bytes);
        }
        if (!(distance < before)) return; /* as near as the arithmetic can tell */
    }
}

/* bodies whose angles are held against each other turn together; group (nbody + 1) is work */
void fw_assembly_closure_unwind(const fw_assembly_closure *c, int *group) {
    const fw_multibody_model *m = c->model;
    for (int b = 0; b <= m->nbody; b++)
        group[b] = b;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *k = &m->block[i];
        if (k->rows != FW_ROWS_TURN && k->rows != FW_ROWS_SLIDE) continue;
        int from = group[k->a], to = group[k->b];
        for (int b = 0; b <= m->nbody; b++)
            if (group[b] == from) group[b] = to;
    }
    for (int g = 0; g <= m->nbody; g++) {
        double sum = 0;
        int count = 0;
        for (int b = 0; b < m->nbody; b++)
            if (group[b] == g) sum += c->u[3 * b + 2], count++;
        if (count == 0 || group[m->nbody] == g) continue;
        double turns = round(sum / count / (2 * FW_PI));
        for (int b = 0; b < m->nbody && turns != 0; b++)
            if (group[b] == g) c->u[3 * b + 2] -= turns * 2 * FW_PI;
    }
}
