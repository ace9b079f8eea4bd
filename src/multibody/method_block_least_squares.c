/* SPDX-License-Identifier: GPL-3.0-or-later */
/* block-least-squares: Gauss' principle and the constraints as one stacked least-squares problem in
   mass-weighted coordinates (multibody/multibody_dense.h),

       min over w of  | [ A / sqrt(eps) ]     [ b / sqrt(eps) ] |
                      | [ I             ] w - [ w0            ] | ,

   solved by Householder's QR with column pivoting, the heavy block on top, so that A^T A is never
   formed. One solution leaves A w - b = eps lambda, that is eps relative; the next sweeps solve
   the same block matrix for the residuals

       r1 = w0 - w - A^T lambda,  r2 = b - A w,   dlambda = (A dw - r2)/eps,

   until both are round-off (method of weighting with deferred correction). It has a solution
   whatever the rank of A. Error: round-off times 1/sqrt(eps) before the sweeps. Cost 2 (rows +
   n/3) n^2 ... 2 (rows + n) n^2.

   What this is: the paper counts "Pennestri's least-squares block solution" among the methods
   without giving its equations, and no text of its source could be had. What is computed here
   is the block least-squares problem as it follows from Gauss' principle; whether
   Pennestri's blocks are weighted, ordered or factored in the same way could not be checked. The
   accelerations are the same in any case, as the minimum is unique. Source: Gauss 1829; Van Loan,
   SIAM J. Numer. Anal. 22 (1985) 851-864 (weighting); Bjorck, Numerical Methods for Least Squares
   Problems, 1996, ch. 5. Test: test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <math.h>
#include <string.h>

typedef struct stack {
    double *qr, *tau;         /* ((rows + n) x n), (n) */
    int *pivot;               /* (n) */
    double *right, *residual; /* (rows + n), (rows) */
    double *more, *start;     /* (n + rows), (n) */
    fw_maths_lapack_space lapack;
} stack;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    stack *p;
    size_t rows = (size_t)d->rows, n = (size_t)d->n, tall = rows + n;
    FW_NEED(p = fw_arena_one(arena, stack));
    FW_NEED(p->qr = fw_arena_array(arena, double, tall *n));
    FW_NEED(p->tau = fw_arena_array(arena, double, n));
    FW_NEED(p->pivot = fw_arena_array(arena, int, n));
    FW_NEED(p->right = fw_arena_array(arena, double, tall));
    FW_NEED(p->residual = fw_arena_array(arena, double, rows));
    FW_NEED(p->more = fw_arena_array(arena, double, tall));
    FW_NEED(p->start = fw_arena_array(arena, double, n));
    d->space = p;
    return fw_maths_qr_space(arena, (int)tall, d->n, &p->lapack);
}

static bool kernel_factor(fw_multibody_dense *d) {
    stack *p = d->space;
    size_t rows = (size_t)d->rows, n = (size_t)d->n, tall = rows + n;
    const double weight = 1 / sqrt(fw_epsilon);
    memset(p->qr, 0, tall * n * sizeof *p->qr);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < rows; i++)
            p->qr[i + j * tall] = weight * d->a[i + j * rows];
        p->qr[rows + j + j * tall] = 1;
    }
    return fw_maths_qr((int)tall, d->n, p->qr, p->pivot, p->tau, &p->lapack);
}

static bool step(fw_multibody_dense *d, double *r1, double *r2) {
    stack *p = d->space;
    int rows = d->rows, n = d->n, tall = rows + n;
    const double weight = 1 / sqrt(fw_epsilon);
    for (int i = 0; i < rows; i++)
        p->right[i] = weight * r2[i];
    memcpy(p->right + rows, r1, (size_t)n * sizeof *r1);
    if (!fw_maths_qr_apply(true, tall, n, p->qr, p->tau, p->right, &p->lapack) ||
        !fw_maths_triangle_solve(false, n, p->qr, tall, p->right))
        return false;
    for (int j = 0; j < n; j++)
        r1[p->pivot[j]] = p->right[j];
    fw_multibody_dense_times(d, r1, p->residual);
    for (int i = 0; i < rows; i++)
        r2[i] = (p->residual[i] - r2[i]) / fw_epsilon;
    return true;
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    stack *p = d->space;
    return fw_multibody_dense_sweep(d, b, w, lambda, sweeps, p->more, p->start, step);
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

const fw_multibody_method fw_multibody_method_block_least_squares = {
    .name = "block-least-squares",
    .summary = "Gauss' principle and the constraints as one stacked least-squares problem",
    .source = "Gauss 1829; Van Loan 1985; after Pennestri",
    .cost = {162000, 2},
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = fw_multibody_dense_model_correct,
};
