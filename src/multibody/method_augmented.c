/* SPDX-License-Identifier: GPL-3.0-or-later */
/* augmented: accelerations and multipliers together,

       [ I   A^T ] [ w      ]   [ w0 ]
       [ A  -eps ] [ lambda ] = [ b + eps lambda_before ]

   in mass-weighted coordinates (multibody/multibody_dense.h), swept until A w = b. The matrix is
   symmetric and quasi-definite whatever the rank of A, so that it always has a factorisation. Bunch
   and Kaufman's L D L^T, once per evaluation. Error: round-off times 1/sqrt(eps), refined by the
   sweeps. Cost (n + rows)^3/3. Source: Lagrange multipliers in index-1 form, Haug 1989, ch. 11;
   quasi-definite matrices, Vanderbei 1995; the proximal sweeps, Carpentier, Budhiraja and Mansard
   2021. Test: test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"

typedef struct augmented {
    double *matrix; /* (size x size), lower part */
    int *pivot;
    double *more, *start;
    fw_maths_lapack_space lapack;
} augmented;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    augmented *s;
    size_t size = (size_t)d->n + (size_t)d->rows;
    FW_NEED(s = fw_arena_one(arena, augmented));
    FW_NEED(s->matrix = fw_arena_array(arena, double, size *size));
    FW_NEED(s->pivot = fw_arena_array(arena, int, size));
    FW_NEED(s->more = fw_arena_array(arena, double, size));
    FW_NEED(s->start = fw_arena_array(arena, double, (size_t)d->n));
    d->space = s;
    return fw_maths_indefinite_space(arena, d->n + d->rows, &s->lapack);
}

static bool kernel_factor(fw_multibody_dense *d) {
    augmented *s = d->space;
    size_t n = (size_t)d->n, rows = (size_t)d->rows, size = n + rows;
    for (size_t j = 0; j < size; j++)
        for (size_t i = j; i < size; i++) {
            double value = i == j ? (j < n ? 1 : -fw_epsilon) : 0;
            if (j < n && i >= n) value = d->a[i - n + j * rows];
            s->matrix[i + j * size] = value;
        }
    return fw_maths_indefinite((int)size, s->matrix, s->pivot, &s->lapack);
}

static bool step(fw_multibody_dense *d, double *r1, double *r2) {
    augmented *s = d->space;
    (void)r2; /* follows r1 in memory */
    return fw_maths_indefinite_solve(d->n + d->rows, s->matrix, s->pivot, r1);
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    augmented *s = d->space;
    return fw_multibody_dense_sweep(d, b, w, lambda, sweeps, s->more, s->start, step);
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

const fw_multibody_method fw_multibody_method_augmented = {
    .name = "augmented",
    .summary = "accelerations and multipliers from one symmetric system, regularised; redundant "
               "joints and singular positions allowed",
    .source = "Haug 1989; Carpentier, Budhiraja and Mansard 2021",
    .cost = {133000, 3},
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = fw_multibody_dense_model_correct,
};
