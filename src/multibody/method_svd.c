/* SPDX-License-Identifier: GPL-3.0-or-later */
/* svd: the rows of V^T in A = U diag(s) V^T are rates z = V^T w of which those with s > 0 are given
   by the constraints and those with s = 0 are independent; their columns N = M^-1/2 V_2 span the
   null space of G. In mass-weighted coordinates N^T M N = I, so that the reduced equations of
   motion N^T M N z'' = N^T Q stand solved:

       z_i = (u_i . b) / s_i  where constrained,   z_i = v_i . w0  where independent,   w = V z,
       lambda = sum u_i (v_i . w0 - z_i) / s_i .

   A rate with small s is a weighted mean of the two (share f = s^2 share(s^2) of
   multibody/multibody_dense.h), one below round-off is free. Error: round-off times s_1/s_r. Cost
   about 4 rows^2 n + 20 rows^3 + 4 n^3. Source: Singh and Likins, J. Appl. Mech. 52 (1985) 943-948;
   Mani, Haug and Atkinson, J. Mech. Transm. Autom. Des. 107 (1985) 82-87. Test: test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <string.h>

typedef struct rates {
    int k;                     /* singular values */
    double *copy, *s, *u, *vt; /* u (rows x k), vt (n x n) */
    double *z;                 /* (n) */
    fw_maths_lapack_space lapack;
} rates;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    rates *p;
    size_t rows = (size_t)d->rows, n = (size_t)d->n;
    FW_NEED(p = fw_arena_one(arena, rates));
    p->k = d->rows < d->n ? d->rows : d->n;
    size_t k = (size_t)p->k;
    FW_NEED(p->copy = fw_arena_array(arena, double, rows *n));
    FW_NEED(p->s = fw_arena_array(arena, double, k));
    FW_NEED(p->u = fw_arena_array(arena, double, rows *k));
    FW_NEED(p->vt = fw_arena_array(arena, double, n *n));
    FW_NEED(p->z = fw_arena_array(arena, double, n));
    d->space = p;
    return fw_maths_svd_space(arena, d->rows, d->n, true, &p->lapack);
}

static bool kernel_factor(fw_multibody_dense *d) {
    rates *p = d->space;
    memcpy(p->copy, d->a, (size_t)d->rows * (size_t)d->n * sizeof *d->a);
    if (!fw_maths_svd(d->rows, d->n, true, p->copy, p->s, p->u, p->vt, &p->lapack)) return false;
    fw_multibody_dense_monitor(d, p->s, p->k, fw_round_off);
    return true;
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    rates *p = d->space;
    memset(p->z, 0, (size_t)d->n * sizeof *p->z);
    for (int j = 0; j < d->n; j++)
        for (int i = 0; i < d->n; i++)
            p->z[i] += p->vt[(size_t)i + (size_t)j * (size_t)d->n] * w[j];
    memset(lambda, 0, (size_t)d->rows * sizeof *lambda);
    for (int i = 0; i < p->k; i++) {
        const double *u = p->u + (size_t)i * (size_t)d->rows;
        double given = 0, s = p->s[i];
        double share = s > fw_round_off * p->s[0] ? fw_multibody_dense_share(s * s, sweeps) : 0;
        for (int j = 0; j < d->rows; j++)
            given += u[j] * b[j];
        double pull = share * (s * p->z[i] - given); /* u_i . lambda */
        p->z[i] -= s * pull;
        for (int j = 0; j < d->rows; j++)
            lambda[j] += pull * u[j];
    }
    for (int j = 0; j < d->n; j++) {
        w[j] = 0;
        for (int i = 0; i < d->n; i++)
            w[j] += p->vt[(size_t)i + (size_t)j * (size_t)d->n] * p->z[i];
    }
    return true;
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

const fw_multibody_method fw_multibody_method_svd = {
    .name = "svd",
    .summary = "independent rates along the null space from the singular value decomposition",
    .source = "Singh and Likins 1985; Mani, Haug and Atkinson 1985",
    .cost = {376000, 3},
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = fw_multibody_dense_model_correct,
    .report = fw_multibody_dense_model_report,
};
