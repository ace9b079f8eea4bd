/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/reduced.h"
#include <float.h>
#include <math.h>
#include <string.h>

fw_status fw_reduced_new(fw_arena *arena, const fw_model *m, fw_reduced *r) {
    size_t n = (size_t)m->nq, rows = (size_t)m->rows;
    *r = (fw_reduced){.n = m->nq, .rows = m->rows};
    FW_NEED(r->shape = fw_arena_array(arena, double, n *n));
    FW_NEED(r->value = fw_arena_array(arena, double, n));
    FW_NEED(r->root = fw_arena_array(arena, double, n));
    FW_NEED(r->balance = fw_arena_array(arena, double, rows));
    size_t least = n < rows ? n : rows;
    FW_NEED(r->g = fw_arena_array(arena, double, rows *n));
    FW_NEED(r->a = fw_arena_array(arena, double, n *(rows > n ? rows : n)));
    FW_NEED(r->sigma = fw_arena_array(arena, double, least));
    FW_NEED(r->left = fw_arena_array(arena, double, rows *least));
    FW_NEED(r->right = fw_arena_array(arena, double, n *n));
    FW_NEED(r->small = fw_arena_array(arena, double, n *n));
    FW_NEED(r->work = fw_arena_array(arena, double, n + 2 * rows));
    if (rows > 0) FW_TRY(fw_svd_space(arena, m->rows, m->nq, true, &r->svd));
    FW_TRY(fw_eigen_space(arena, m->nq, &r->eigen));
    for (int i = 0; i < m->nq; i++)
        r->root[i] = 1 / sqrt(i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]);
    return FW_OK;
}

/* A = D G M^-1/2, column-major, rows of norm 1; false: not finite */
static bool balanced(const fw_model *m, fw_reduced *r) {
    size_t n = (size_t)r->n, rows = (size_t)r->rows;
    fw_model_dense_jacobian(m, r->g);
    for (size_t i = 0; i < rows; i++) {
        double *row = r->g + i * n, sum = 0;
        for (size_t j = 0; j < n; j++) {
            row[j] *= r->root[j];
            sum += row[j] * row[j];
        }
        if (!isfinite(sum)) return false;
        r->balance[i] = sum > 0 ? 1 / sqrt(sum) : 1;
        for (size_t j = 0; j < n; j++)
            r->a[j * rows + i] = row[j] * r->balance[i];
    }
    return true;
}

/* V^T of the decomposition to rows that lie one after the other */
static void transpose(int n, const double *from, double *to) {
    for (size_t k = 0; k < (size_t)n; k++)
        for (size_t j = 0; j < (size_t)n; j++)
            to[k * (size_t)n + j] = from[j * (size_t)n + k];
}

/* A = D G M^-1/2 = U S V^T with D so that every row has norm 1; the last rows of V^T, times M^-1/2,
   span the motions G allows and are M-orthonormal. The rank is the number of singular values above
   32 max(rows, n) eps times the largest; the values on both sides of the cut are kept for the
   reader, so that no rank is decided in silence. Error: round-off times largest / kept. Cost about
   20 n^3. Source: null-space reduction, e.g. Garcia de Jalon and Bayo 1994, ch. 5; LAPACK. Test:
   test_modes.c, test_statics.c (a hinge written twice). */
fw_status fw_reduced_null(const fw_model *m, fw_reduced *r) {
    int most = r->rows < r->n ? r->rows : r->n, larger = r->rows > r->n ? r->rows : r->n;
    memset(r->small, 0, (size_t)r->n * (size_t)r->n * sizeof(double));
    for (int i = 0; i < r->n; i++)
        r->small[(size_t)i * (size_t)r->n + (size_t)i] = 1;
    if (r->rows > 0 && (!balanced(m, r) ||
                        !fw_svd(r->rows, r->n, true, r->a, r->sigma, r->left, r->small, &r->svd)))
        return FW_SOLVER;
    transpose(r->n, r->small, r->right);
    r->largest = most > 0 ? r->sigma[0] : 0;
    for (r->rank = 0; r->rank < most; r->rank++)
        if (!(r->sigma[r->rank] > 32 * larger * DBL_EPSILON * r->largest)) break;
    r->dof = r->n - r->rank;
    r->kept = r->rank > 0 ? r->sigma[r->rank - 1] : 0;
    r->dropped = r->rank < most ? r->sigma[r->rank] : 0;
    return FW_OK;
}

/* Eigenvalues of V_0^T M^-1/2 K M^-1/2 V_0, by LAPACK. Error of a value: round-off times the
   largest one, which is the tolerance given. Cost 2 n^2 dof and 9 dof^3. Test: test_modes.c. */
fw_status fw_reduced_spectrum(fw_reduced *r, const double *stiffness) {
    size_t n = (size_t)r->n, dof = (size_t)r->dof;
    const double *basis = r->right + (size_t)r->rank * n;
    for (size_t k = 0; k < dof; k++) /* (K M^-1/2 V_0)^T, one row per motion */
        for (size_t i = 0; i < n; i++) {
            double sum = 0;
            for (size_t j = 0; j < n; j++)
                sum += stiffness[i * n + j] * r->root[j] * basis[k * n + j];
            r->shape[k * n + i] = sum * r->root[i];
        }
    for (size_t k = 0; k < dof; k++)
        for (size_t l = 0; l <= k; l++) {
            double one = 0, other = 0; /* both halves, so that round-off stays symmetric */
            for (size_t i = 0; i < n; i++) {
                one += basis[k * n + i] * r->shape[l * n + i];
                other += basis[l * n + i] * r->shape[k * n + i];
            }
            r->small[k * dof + l] = r->small[l * dof + k] = 0.5 * (one + other);
        }
    for (size_t k = 0; k < dof * dof; k++)
        if (!isfinite(r->small[k])) return FW_SOLVER;
    if (dof > 0 && !fw_eigen(r->dof, r->small, r->value, &r->eigen)) return FW_SOLVER;
    for (size_t k = 0; k < dof; k++)
        for (size_t i = 0; i < n; i++) {
            double sum = 0;
            for (size_t l = 0; l < dof; l++)
                sum += r->small[k * dof + l] * basis[l * n + i];
            r->shape[k * n + i] = sum * r->root[i];
        }
    double most = 1; /* the scale of time makes stiffnesses of order one */
    for (size_t k = 0; k < dof; k++)
        most = fmax(most, fabs(r->value[k]));
    r->tolerance = 64 * (double)r->dof * DBL_EPSILON * most;
    return FW_OK;
}

void fw_reduced_multipliers(const fw_model *m, const fw_reduced *r, const double *force,
                            double *lambda) {
    size_t n = (size_t)r->n, rows = (size_t)r->rows;
    double *mu = r->work, *part = r->work + rows;
    memset(mu, 0, rows * sizeof *mu);
    for (int k = 0; k < r->rank; k++) {
        double sum = 0;
        for (size_t j = 0; j < n; j++)
            sum += r->right[(size_t)k * n + j] * r->root[j] * force[j];
        part[k] = sum / r->sigma[k];
    }
    for (size_t i = 0; i < rows; i++) {
        for (int k = 0; k < r->rank; k++)
            mu[i] += r->left[(size_t)k * rows + i] * part[k];
        mu[i] *= r->balance[i];
    }
    fw_model_unpack(m, mu, lambda);
}

void fw_reduced_correct(const fw_model *m, const fw_reduced *r, const double *psi, double *d) {
    size_t n = (size_t)r->n, rows = (size_t)r->rows;
    double *packed = r->work;
    fw_model_pack(m, psi, packed);
    memset(d, 0, n * sizeof *d);
    for (int k = 0; k < r->rank; k++) {
        double sum = 0;
        for (size_t i = 0; i < rows; i++)
            sum += r->left[(size_t)k * rows + i] * r->balance[i] * packed[i];
        sum /= r->sigma[k];
        for (size_t j = 0; j < n; j++)
            d[j] -= r->right[(size_t)k * n + j] * r->root[j] * sum;
    }
}
