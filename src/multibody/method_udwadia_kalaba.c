/* SPDX-License-Identifier: GPL-3.0-or-later */
/* udwadia-kalaba: the explicit equation of constrained motion

       a = a0 + M^-1/2 (G M^-1/2)^+ (-gamma - G a0),   lambda = -(A A^T)^+ (b - A w0)

   with the Moore-Penrose inverse from the singular value decomposition A = U diag(s) V^T: the
   reciprocal of s is s * share(s^2) (multibody/multibody_dense.h), which is 1/s to round-off where
   s > 1e-3 and 0 where s is round-off, without a jump between the two. Balancing the rows changes
   neither a nor, at full rank, lambda. Error: round-off times s_1/s_r. Cost about 6 rows^2 n + 20
   rows^3 by QR iteration. Source: Udwadia and Kalaba, Proc. R. Soc. A 439 (1992) 407-410. Test:
   test_methods.c. */
#include "multibody/multibody_dense.h"
#include "maths/matrix.h"
#include <string.h>

typedef struct pseudo {
    int k;                     /* singular values */
    double *copy, *s, *u, *vt; /* u (rows x k), vt (k x n) */
    double *right;
    fw_maths_lapack_space lapack;
} pseudo;

static fw_status kernel_prepare(fw_arena *arena, fw_multibody_dense *d) {
    pseudo *p;
    size_t rows = (size_t)d->rows, n = (size_t)d->n;
    FW_NEED(p = fw_arena_one(arena, pseudo));
    p->k = d->rows < d->n ? d->rows : d->n;
    size_t k = (size_t)p->k;
    FW_NEED(p->copy = fw_arena_array(arena, double, rows *n));
    FW_NEED(p->s = fw_arena_array(arena, double, k));
    FW_NEED(p->u = fw_arena_array(arena, double, rows *k));
    FW_NEED(p->vt = fw_arena_array(arena, double, k *n));
    FW_NEED(p->right = fw_arena_array(arena, double, rows));
    d->space = p;
    return fw_maths_svd_space(arena, d->rows, d->n, false, &p->lapack);
}

static bool kernel_factor(fw_multibody_dense *d) {
    pseudo *p = d->space;
    memcpy(p->copy, d->a, (size_t)d->rows * (size_t)d->n * sizeof *d->a);
    if (!fw_maths_svd(d->rows, d->n, false, p->copy, p->s, p->u, p->vt, &p->lapack)) return false;
    fw_multibody_dense_monitor(d, p->s, p->k, fw_round_off);
    return true;
}

static bool kernel_solve(fw_multibody_dense *d, const double *b, double *w, double *lambda,
                         int sweeps) {
    pseudo *p = d->space;
    fw_multibody_dense_times(d, w, p->right);
    for (int i = 0; i < d->rows; i++) {
        p->right[i] = b[i] - p->right[i];
        lambda[i] = 0;
    }
    for (int i = 0; i < p->k && p->s[i] > fw_round_off * p->s[0]; i++) {
        const double *u = p->u + (size_t)i * (size_t)d->rows;
        double c = 0;
        for (int j = 0; j < d->rows; j++)
            c += u[j] * p->right[j];
        c *= fw_multibody_dense_share(p->s[i] * p->s[i], sweeps);
        for (int j = 0; j < d->rows; j++)
            lambda[j] -= c * u[j];
        for (int j = 0; j < d->n; j++)
            w[j] += p->s[i] * c * p->vt[i + j * p->k];
    }
    return true;
}

static const fw_multibody_dense_kernel kernel = {kernel_prepare, kernel_factor, kernel_solve};

const fw_multibody_method fw_multibody_method_udwadia_kalaba = {
    .name = "udwadia-kalaba",
    .summary = "explicit equation of constrained motion with the pseudo-inverse of G M^-1/2",
    .source = "Udwadia and Kalaba 1992",
    .cost = {371000, 3},
    .kernel = &kernel,
    .prepare = fw_multibody_dense_model_prepare,
    .factor = fw_multibody_dense_model_factor,
    .accelerate = fw_multibody_dense_model_accelerate,
    .correct = fw_multibody_dense_model_correct,
    .report = fw_multibody_dense_model_report,
};
