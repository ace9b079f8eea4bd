/* SPDX-License-Identifier: GPL-3.0-or-later */
/* schur: A^T A = W diag(mu) W^T, the Schur form of a symmetric matrix. Columns of W with mu = 0
   span the null space of A (zero eigenvalue theorem) and carry the independent rates, whose reduced
   mass matrix is I in mass-weighted coordinates (multibody/multibody_dense.h); the others carry
   what the constraints prescribe:

       z_i = (w_i . A^T b) / mu_i  where constrained,   z_i = w_i . w0  where independent,
       w = W z,   lambda = A W diag(1/mu) W^T (w0 - w) .

   1/mu is share(mu) of multibody/multibody_dense.h. As mu is s^2, singular values below 1e-7 of the
   largest drown in round-off: those mu count as 0 (their share would be below 1e-5). Vectors turn
   by round-off/mu; a second pass with the residuals w0 - w - A^T lambda and b - A w takes out what
   that leaves. Error: round-off times (s_1/s_r)^2 before the second pass. Cost rows n^2 + 9 n^3.
   Source: Walton and Steeves, NASA TR R-326 (1969); Kamman and Huston, J. Appl. Mech. 51 (1984)
   899-903. Test: test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

static const double noise = 1e-14; /* of mu, relative to the largest */

typedef struct schur {
    double *w, *mu;                             /* (n x n), (n) ascending */
    double *s;                                  /* (n) descending */
    double *ask, *move, *force, *start, *again; /* (n) */
    double *push, *left;                        /* (rows) */
    fw_maths_lapack_space lapack;
} schur;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    schur *p;
    size_t rows = (size_t)d->rows, n = (size_t)d->n;
    FW_NEED(p = fw_arena_one(arena, schur));
    FW_NEED(p->w = fw_arena_array(arena, double, n *n));
    double **vectors[] = {&p->mu, &p->s, &p->ask, &p->move, &p->force, &p->start, &p->again};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        FW_NEED(*vectors[i] = fw_arena_array(arena, double, n));
    FW_NEED(p->push = fw_arena_array(arena, double, rows));
    FW_NEED(p->left = fw_arena_array(arena, double, rows));
    d->space = p;
    return fw_maths_eigen_space(arena, d->n, &p->lapack);
}

static bool kernel_factor(fw_multibody_dense *d) {
    schur *p = d->space;
    size_t rows = (size_t)d->rows, n = (size_t)d->n;
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++) {
            double sum = 0;
            for (size_t r = 0; r < rows; r++)
                sum += d->a[r + i * rows] * d->a[r + j * rows];
            p->w[i + j * n] = sum;
        }
    if (!fw_maths_eigen(d->n, p->w, p->mu, &p->lapack)) return false;
    for (size_t i = 0; i < n; i++) {
        p->mu[i] = fmax(p->mu[i], 0);
        p->s[n - 1 - i] = sqrt(p->mu[i]);
    }
    fw_multibody_dense_monitor(d, p->s, d->rows < d->n ? d->rows : d->n, 1e-7);
    return true;
}

/* (dw, dl) with dw + A^T dl = r1, A dw = r2: r1 becomes dw, lambda += dl */
static void pass(fw_multibody_dense *d, double *r1, const double *r2, double *lambda, int sweeps) {
    schur *p = d->space;
    size_t n = (size_t)d->n;
    memset(p->ask, 0, n * sizeof *p->ask);
    memset(p->move, 0, n * sizeof *p->move);
    memset(p->force, 0, n * sizeof *p->force);
    fw_multibody_dense_subtract_transpose(d, r2, p->ask); /* -A^T r2 */
    for (size_t i = 0; i < n; i++) {
        const double *w = p->w + i * n;
        double mu = p->mu[i], free = 0, given = 0;
        double share = mu > noise * p->mu[n - 1] ? fw_multibody_dense_share(mu, sweeps) : 0;
        for (size_t j = 0; j < n; j++) {
            free += w[j] * r1[j];
            given -= w[j] * p->ask[j];
        }
        double pull = share * (mu * free - given); /* w_i . A^T dl */
        for (size_t j = 0; j < n; j++) {
            p->move[j] += (free - pull) * w[j];
            p->force[j] += pull * share * w[j];
        }
    }
    fw_multibody_dense_times(d, p->force, p->push);
    for (int i = 0; i < d->rows; i++)
        lambda[i] += p->push[i];
    memcpy(r1, p->move, n * sizeof *r1);
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    schur *p = d->space;
    memset(lambda, 0, (size_t)d->rows * sizeof *lambda);
    memcpy(p->start, w, (size_t)d->n * sizeof *w);
    pass(d, w, b, lambda, sweeps);
    if (sweeps == 1) return true;
    for (int j = 0; j < d->n; j++)
        p->again[j] = p->start[j] - w[j];
    fw_multibody_dense_subtract_transpose(d, lambda, p->again);
    fw_multibody_dense_times(d, w, p->left);
    for (int i = 0; i < d->rows; i++)
        p->left[i] = b[i] - p->left[i];
    pass(d, p->again, p->left, lambda, sweeps);
    for (int j = 0; j < d->n; j++)
        w[j] += p->again[j];
    return true;
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

const fw_multibody_method fw_multibody_method_schur = {
    .name = "schur",
    .summary = "independent rates along the eigenvectors of G^T G with eigenvalue zero",
    .source = "Walton and Steeves 1969; Kamman and Huston 1984",
    .cost = {291000, 3},
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = fw_multibody_dense_model_correct,
    .report = fw_multibody_dense_model_report,
};
