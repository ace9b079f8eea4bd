/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step along the equilibria of a scene. It solves for those in its middle and at its end, where
   du/dt is exact too; a step is good when the cubic through its ends meets the middle. Its curve,
   of degree 5, is far better than that. Source: predictor-corrector continuation, Allgower and
   Georg 1990, ch. 2; Hermite interpolation, Stoer and Bulirsch, 2.1. Test: test_quasi.c. */
#include "statics/quasi_static.h"
#include <math.h>
#include <string.h>

enum { FW_TRIES = 12 };
static const double fw_farthest = 0.3; /* rad or scaled lengths: a correction, at most */

/* ---- one equilibrium ---- */

static bool stable(const fw_statics_reduced *r) {
    for (int k = 0; k < r->dof; k++)
        if (!(r->value[k] > r->zero[k])) return false;
    return true;
}

/* Newton from guess; forces and tangent are those within 1e-10 of the result */
fw_status fw_statics_quasi_static_solve(fw_statics_quasi_static *r, double t) {
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
    const fw_dynamics_piece piece = {
        .from_s = at_s, .to_s = at_s, .jump = true, .nodes = NODES, .q = r->piece_q};
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

/* cubic through both ends plus x^2 (1 - x)^2 (c0 + c1 (x - 1/2)), which leaves the ends alone */
void fw_statics_quasi_static_curve(const fw_statics_quasi_static *r, double x, double *value,
                                   double *slope, double *bend) {
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
    FW_TRY(fw_statics_quasi_static_solve(r, r->from.t + h));
    keep(r, r->from.t + h, &r->middle);
    for (int i = 0; i < n; i++)
        r->guess[i] =
            5 * r->from.u[i] - 4 * r->middle.u[i] + h * (2 * r->from.v[i] + 4 * r->middle.v[i]);
    FW_TRY(fw_statics_quasi_static_solve(r, t));
    keep(r, t, &r->to);
    return FW_OK;
}
