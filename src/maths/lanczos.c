/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lanczos with all vectors kept orthogonal, twice at every step: T is what the operator is on them. An
   eigenvalue counts once the residual is 1e-10 of it, so that its own error is the square of that over
   the gap. A starting vector sees one of several equal eigenvalues: ask again with what is known. Cost:
   one application a step, up to 4 count + 40 of them, and 4 n m^2. Source: B. N. Parlett, The Symmetric
   Eigenvalue Problem, 1980, ch. 13. Test: test_sparse.c */
#include "maths/dense.h"
#include "maths/sparse.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { FW_LOOK_EVERY = 8 };
static const double fw_converged = 1e-10;

static double dot(const double *x, const double *y, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

static void take_off(double *x, const double *rows, int count, int n) {
    for (int k = 0; k < count; k++) {
        const double *v = rows + (size_t)k * (size_t)n, part = dot(x, v, n);
        for (int i = 0; i < n; i++)
            x[i] -= part * v[i];
    }
}

typedef struct lanczos {
    const fw_maths_operator *op;
    int n, most, steps, nknown;
    const double *known;
    double *v, *alpha, *beta, *t, *theta; /* v (most + 1 x n), t (most x most) */
    fw_maths_lapack_space space;
} lanczos;

/* the same numbers at every run; led to where the operator is at home */
static bool start(lanczos *k, double *work) {
    unsigned state = 12345;
    for (int i = 0; i < k->n; i++) {
        state = 1664525u * state + 1013904223u;
        work[i] = (double)(state >> 8) / (double)(1u << 24) - 0.5;
    }
    k->op->apply(k->op->context, work, k->v);
    take_off(k->v, k->known, k->nknown, k->n), take_off(k->v, k->known, k->nknown, k->n);
    double size = sqrt(dot(k->v, k->v, k->n));
    for (int i = 0; size > 0 && i < k->n; i++)
        k->v[i] /= size;
    return size > 0 && isfinite(size);
}

/* false: these vectors are all that there is */
static bool lanczos_step(lanczos *k) {
    const size_t n = (size_t)k->n;
    const int j = k->steps++;
    double *v = k->v + (size_t)j * n, *w = v + n;
    k->op->apply(k->op->context, v, w);
    k->alpha[j] = dot(v, w, k->n);
    for (int twice = 0; twice < 2; twice++)
        take_off(w, k->known, k->nknown, k->n), take_off(w, k->v, j + 1, k->n);
    k->beta[j] = sqrt(dot(w, w, k->n));
    double size = 0;
    for (int i = 0; i <= j; i++)
        size = fmax(size, fabs(k->alpha[i]) + (i > 0 ? k->beta[i - 1] : 0));
    if (!(k->beta[j] > 64 * DBL_EPSILON * size)) return k->beta[j] = 0, false;
    for (size_t i = 0; i < n; i++)
        w[i] /= k->beta[j];
    return true;
}

/* how many of the largest, without a gap, have converged; theta ascending, t their vectors in columns */
static int converged(lanczos *k, int count) {
    const int m = k->steps;
    memset(k->t, 0, (size_t)m * (size_t)m * sizeof *k->t);
    for (int i = 0; i < m; i++) {
        k->t[i * m + i] = k->alpha[i];
        if (i + 1 < m) k->t[i * m + i + 1] = k->t[(i + 1) * m + i] = k->beta[i];
    }
    if (!fw_maths_eigen(m, k->t, k->theta, &k->space)) return FW_MATHS_NONE;
    int found = 0;
    for (int c = m - 1; c >= 0 && found < count; c--, found++) {
        double off = k->beta[m - 1] * fabs(k->t[c * m + m - 1]);
        if (!(off <= fw_converged * fabs(k->theta[c]))) break;
    }
    return found;
}

static void give_vectors(const lanczos *k, int found, double *value, double *vector) {
    const size_t n = (size_t)k->n;
    for (int f = 0; f < found; f++) {
        const int c = k->steps - 1 - f;
        double *to = vector + (size_t)f * n;
        value[f] = k->theta[c];
        memset(to, 0, n * sizeof *to);
        for (int j = 0; j < k->steps; j++)
            for (size_t i = 0; i < n; i++)
                to[i] += k->t[c * k->steps + j] * k->v[(size_t)j * n + i];
    }
}

fw_status fw_maths_lanczos(fw_arena *arena, const fw_maths_operator *op, int count, int nknown,
                           const double *known, double *value, double *vector, int *found) {
    int most = 4 * count + 40 < op->n ? 4 * count + 40 : op->n;
    lanczos k = {.op = op, .n = op->n, .most = most, .nknown = nknown, .known = known};
    const size_t n = (size_t)op->n, m = (size_t)most;
    double *work;
    fw_mark mark = fw_arena_mark(arena);
    *found = 0;
    FW_NEED(k.v = fw_arena_raw(arena, (m + 1) * n * sizeof(double)));
    FW_NEED(k.alpha = fw_arena_array(arena, double, m));
    FW_NEED(k.beta = fw_arena_array(arena, double, m));
    FW_NEED(k.theta = fw_arena_array(arena, double, m));
    FW_NEED(k.t = fw_arena_array(arena, double, m *m));
    FW_NEED(work = fw_arena_array(arena, double, n));
    FW_TRY(fw_maths_eigen_space(arena, most, &k.space));
    bool goes_on = start(&k, work);
    while (goes_on && k.steps < most && *found < count) {
        if (fw_arena_cancelled(arena)) return FW_CANCELLED;
        goes_on = lanczos_step(&k);
        if (goes_on && k.steps < most && k.steps % FW_LOOK_EVERY != 0) continue;
        int now = converged(&k, count);
        if (now == FW_MATHS_NONE) return FW_SOLVER;
        *found = now;
    }
    if (*found > 0) give_vectors(&k, *found, value, vector);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
