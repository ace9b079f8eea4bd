/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lanczos with all vectors kept orthogonal, twice at every step: T is what the operator is on them. An
   eigenvalue counts once the residual is 1e-10 of it, so that its own error is the square of that over
   the gap. A starting vector sees one of several equal eigenvalues: ask again with what is known. Cost:
   one application a step, up to 4 count + 40 of them, and 4 n m^2. Source: B. N. Parlett, The Symmetric
   Eigenvalue Problem, 1980, ch. 13. Test: test_sparse.c */
#include "maths/matrix.h"
#include <lapacke.h>
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <time.h>

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

/* ---- all eigenvalues of a matrix that is not symmetric ---- */

typedef struct general { /* one call of dgeev */
    int n, length;
    double *a, *re, *im, *vector, *work;
    bool good;
} general;

static void solve_general(general *g) {
    const int n = g->n;
    g->good = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, g->a, n, g->re, g->im, NULL, 1,
                                 g->vector, n, g->work, g->length) == 0;
}

static size_t work_of(int n) { /* LAPACK's answer to a query; 0: nothing sensible */
    double size = 0, none = 0;
    const int info = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, &none, n, &none, &none, NULL,
                                        1, &none, n, &size, -1);
    return info == 0 && size >= 1 && size < 1e9 ? (size_t)size : 0;
}

/* Nothing ends a call of LAPACK that has begun. Where one takes seconds it is made in a thread with memory of its own, so that
   whoever is asked to stop can leave it: the thread ends by itself and frees what it had, or with the program.
   Test: test_eigen.c, stops_in_time */
enum { APART_FROM = 256 }; /* some 0.1 s */

typedef enum apart_state { APART_RUNS, APART_DONE, APART_LEFT } apart_state;

typedef struct apart {
    fw_arena *own; /* holds this, too */
    general job;
    atomic_int state;
} apart;

static void *run_apart(void *of) {
    apart *p = of;
    solve_general(&p->job);
    if (atomic_exchange(&p->state, APART_DONE) == APART_LEFT) fw_arena_free(p->own);
    return NULL;
}

/* true: it was done; false: asked to stop, and p is the thread's */
static bool wait_for(const fw_arena *arena, apart *p) {
    const struct timespec pause = {.tv_nsec = 2000000};
    while (atomic_load(&p->state) == APART_RUNS) {
        if (fw_arena_cancelled(arena)) return atomic_exchange(&p->state, APART_LEFT) == APART_DONE;
        nanosleep(&pause, NULL); /* a signal ends it before */
    }
    return true;
}

static fw_status solve_apart(fw_arena *arena, general *g) {
    const size_t n = (size_t)g->n;
    fw_arena *own = fw_arena_part(arena, 0);
    FW_NEED(own);
    apart *p = fw_arena_one(own, apart);
    if (p) {
        p->own = own;
        p->job = *g;
        p->job.a = fw_arena_array(own, double, n *n);
        p->job.vector = fw_arena_array(own, double, n *n);
        p->job.re = fw_arena_array(own, double, n);
        p->job.im = fw_arena_array(own, double, n);
        p->job.work = fw_arena_array(own, double, (size_t)g->length);
    }
    pthread_t thread;
    if (!p || !p->job.a || !p->job.vector || !p->job.re || !p->job.im || !p->job.work) {
        fw_arena_free(own);
        return FW_NOMEM;
    }
    memcpy(p->job.a, g->a, n * n * sizeof *g->a);
    if (pthread_create(&thread, NULL, run_apart, p) != 0) {
        solve_general(&p->job);
    } else if (!wait_for(arena, p)) {
        pthread_detach(thread);
        return FW_CANCELLED;
    } else {
        pthread_join(thread, NULL);
    }
    memcpy(g->vector, p->job.vector, n * n * sizeof *g->vector);
    memcpy(g->re, p->job.re, n * sizeof *g->re);
    memcpy(g->im, p->job.im, n * sizeof *g->im);
    g->good = p->job.good;
    fw_arena_free(own);
    return FW_OK;
}

static bool transpose_finite(int n, double *a) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double *p = a + (size_t)i * (size_t)n + j, *q = a + (size_t)j * (size_t)n + i,
                   keep = *p;
            if (!isfinite(*p) || !isfinite(*q)) return false;
            *p = *q;
            *q = keep;
        }
    return true;
}

/* dgeev, balanced. Error of a value: round-off times |a| times its condition. Cost about 25 n^3.
   Test: test_eigen.c. */
fw_status fw_maths_eigen_general(fw_arena *arena, int n, double *a, double *re, double *im,
                                 double *vector) {
    if (n == 0) return FW_OK;
    if (!transpose_finite(n, a)) return FW_SOLVER; /* LAPACK may loop on a NaN */
    FW_TRY(fw_maths_lapack_ready());
    general g = {.n = n, .a = a, .re = re, .im = im, .vector = vector};
    const size_t length = work_of(n);
    if (!length) return FW_SOLVER;
    g.length = (int)length;
    const fw_mark mark = fw_arena_mark(arena);
    fw_status status = FW_OK;
    if (n >= APART_FROM) {
        status = solve_apart(arena, &g);
    } else {
        FW_NEED(g.work = fw_arena_array(arena, double, length));
        solve_general(&g);
    }
    fw_arena_rewind(arena, mark);
    FW_TRY(status);
    return g.good ? FW_OK : FW_SOLVER;
}
