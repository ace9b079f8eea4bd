/* SPDX-License-Identifier: GPL-3.0-or-later */
/* qr: A^T P = [Q_1 Q_2] [R; 0] with column pivoting. N = M^-1/2 Q_2 spans the null space of G and
   carries the independent rates c_2 = Q_2^T w0, whose reduced mass matrix N^T M N is I in
   mass-weighted coordinates (multibody/multibody_dense.h). In the range, w = Q_1 y, the constraints
   ask R^T y = P^T b, y closest to Q_1^T w0:

       y += R dl,   (R^T R + eps) dl = P^T b - R^T y,   lambda = -P sum dl,

   swept as often as the chain does, so that small and vanishing diagonal elements of R need no
   rank. R^T R + eps comes as the triangle of [R; sqrt(eps)], never squared. Error: round-off times
   |R| |R^-1|. Cost 2 n rows^2 + (4/3) rows^3 and 4 n rows per solve. Source: Kim and Vanderploeg,
   J. Mech. Transm. Autom. Des. 108 (1986) 183-188; Golub and Van Loan, section 5.4. Test:
   test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

typedef struct ranges {
    int k;              /* rows of R: min(rows, n) */
    double *qr, *tau;   /* (n x rows), (k) */
    int *pivot, *again; /* (rows) P, and that of the damped triangle */
    double *damped;     /* ((k + rows) x rows) */
    double *damped_tau, *diagonal;
    double *c, *dl, *sorted; /* (n), (rows), (rows) */
    fw_maths_lapack_space lapack, damped_lapack;
} ranges;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    ranges *p;
    size_t rows = (size_t)d->rows, n = (size_t)d->n;
    FW_NEED(p = fw_arena_one(arena, ranges));
    p->k = d->rows < d->n ? d->rows : d->n;
    FW_NEED(p->qr = fw_arena_array(arena, double, n *rows));
    FW_NEED(p->damped = fw_arena_array(arena, double, ((size_t)p->k + rows) * rows));
    FW_NEED(p->pivot = fw_arena_array(arena, int, rows));
    FW_NEED(p->again = fw_arena_array(arena, int, rows));
    FW_NEED(p->c = fw_arena_array(arena, double, n));
    double **vectors[] = {&p->tau, &p->damped_tau, &p->diagonal, &p->dl, &p->sorted};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        FW_NEED(*vectors[i] = fw_arena_array(arena, double, rows));
    d->space = p;
    FW_TRY(fw_maths_qr_space(arena, d->n, d->rows, &p->lapack));
    return fw_maths_qr_space(arena, p->k + d->rows, d->rows, &p->damped_lapack);
}

static bool kernel_factor(fw_multibody_dense *d) {
    ranges *p = d->space;
    size_t rows = (size_t)d->rows, n = (size_t)d->n, k = (size_t)p->k, tall = k + rows;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < n; j++)
            p->qr[j + i * n] = d->a[i + j * rows];
    if (!fw_maths_qr(d->n, d->rows, p->qr, p->pivot, p->tau, &p->lapack)) return false;
    memset(p->damped, 0, tall * rows * sizeof *p->damped);
    for (size_t j = 0; j < rows; j++) {
        for (size_t i = 0; i < k && i <= j; i++)
            p->damped[i + j * tall] = p->qr[i + j * n];
        p->damped[k + j + j * tall] = sqrt(fw_epsilon);
    }
    for (size_t i = 0; i < k; i++)
        p->diagonal[i] = fabs(p->qr[i + i * n]);
    fw_multibody_dense_monitor(d, p->diagonal, p->k, fw_round_off);
    return fw_maths_qr((int)tall, d->rows, p->damped, p->again, p->damped_tau, &p->damped_lapack);
}

/* dl = (R^T R + eps)^-1 dl, with R^T R + eps = P' T^T T P'^T */
static bool damped_solve(ranges *p, int rows, double *dl) {
    int tall = p->k + rows;
    for (int i = 0; i < rows; i++)
        p->sorted[i] = dl[p->again[i]];
    if (!fw_maths_triangle_solve(true, rows, p->damped, tall, p->sorted) ||
        !fw_maths_triangle_solve(false, rows, p->damped, tall, p->sorted))
        return false;
    for (int i = 0; i < rows; i++)
        dl[p->again[i]] = p->sorted[i];
    return true;
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    ranges *p = d->space;
    size_t n = (size_t)d->n;
    double *y = p->c, size = 0;
    memcpy(p->c, w, n * sizeof *w);
    if (!fw_maths_qr_apply(true, d->n, d->rows, p->qr, p->tau, p->c, &p->lapack)) return false;
    memset(lambda, 0, (size_t)d->rows * sizeof *lambda);
    for (int sweep = 0; sweep < sweeps; sweep++) {
        for (int i = 0; i < d->rows; i++) { /* P^T b - R^T y */
            double sum = b[p->pivot[i]];
            for (int j = 0; j < p->k && j <= i; j++)
                sum -= p->qr[(size_t)j + (size_t)i * n] * y[j];
            p->dl[i] = sum;
        }
        double left = fw_multibody_dense_largest(p->dl, d->rows);
        if (sweep == 0) size = left;
        if (sweep > 1 && left <= 1e-14 * size) break;
        if (!damped_solve(p, d->rows, p->dl)) return false;
        for (int j = 0; j < p->k; j++)
            for (int i = j; i < d->rows; i++)
                y[j] += p->qr[(size_t)j + (size_t)i * n] * p->dl[i];
        for (int i = 0; i < d->rows; i++)
            lambda[p->pivot[i]] -= p->dl[i];
    }
    if (!fw_maths_qr_apply(false, d->n, d->rows, p->qr, p->tau, p->c, &p->lapack)) return false;
    memcpy(w, p->c, n * sizeof *w);
    return true;
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

const fw_multibody_method fw_multibody_method_qr = {
    .name = "qr",
    .summary = "independent rates along the null space from Householder's QR of the Jacobian",
    .source = "Kim and Vanderploeg 1986",
    .cost = {167000, 3},
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = fw_multibody_dense_model_correct,
    .report = fw_multibody_dense_model_report,
};
