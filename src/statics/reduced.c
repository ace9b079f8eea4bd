/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <string.h>

fw_status fw_statics_reduced_new(fw_arena *arena, const fw_multibody_model *m,
                                 fw_statics_reduced *r) {
    size_t n = (size_t)m->nq, rows = (size_t)m->rows;
    *r = (fw_statics_reduced){.n = m->nq, .rows = m->rows};
    FW_NEED(r->shape = fw_arena_array(arena, double, n *n));
    FW_NEED(r->value = fw_arena_array(arena, double, n));
    FW_NEED(r->zero = fw_arena_array(arena, double, n));
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
    if (rows > 0) FW_TRY(fw_maths_svd_space(arena, m->rows, m->nq, true, &r->svd));
    FW_TRY(fw_maths_eigen_space(arena, m->nq, &r->eigen));
    for (int i = 0; i < m->nq; i++)
        r->root[i] = 1 / sqrt(i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]);
    return FW_OK;
}

/* A = D G M^-1/2, column-major, rows of norm 1; false: not finite */
static bool balanced(const fw_multibody_model *m, const fw_multibody_pose *pose,
                     fw_statics_reduced *r) {
    size_t n = (size_t)r->n, rows = (size_t)r->rows;
    fw_multibody_dense_jacobian(m, pose, r->g);
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
fw_status fw_statics_reduced_null(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                  fw_statics_reduced *r) {
    int most = r->rows < r->n ? r->rows : r->n, larger = r->rows > r->n ? r->rows : r->n;
    memset(r->small, 0, (size_t)r->n * (size_t)r->n * sizeof(double));
    for (int i = 0; i < r->n; i++)
        r->small[(size_t)i * (size_t)r->n + (size_t)i] = 1;
    if (r->rows > 0 && (!balanced(m, pose, r) || !fw_maths_svd(r->rows, r->n, true, r->a, r->sigma,
                                                               r->left, r->small, &r->svd)))
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

/* N^T K N for the rows of r->shape, into r->small (dof x dof), symmetric */
static void project(fw_statics_reduced *r, const double *stiffness) {
    size_t n = (size_t)r->n, dof = (size_t)r->dof;
    for (size_t k = 0; k < dof; k++) {
        for (size_t i = 0; i < n; i++) { /* K times row k */
            r->work[i] = 0;
            for (size_t j = 0; j < n; j++)
                r->work[i] += stiffness[i * n + j] * r->shape[k * n + j];
        }
        for (size_t l = 0; l <= k; l++) {
            double sum = 0;
            for (size_t i = 0; i < n; i++)
                sum += r->shape[l * n + i] * r->work[i];
            r->small[k * dof + l] = r->small[l * dof + k] = sum;
        }
    }
}

/* turns rows p and q of the modes so that entry (p, q) of the symmetric h vanishes */
static void rotate(fw_statics_reduced *r, double *h, size_t p, size_t q) {
    size_t n = (size_t)r->n, dof = (size_t)r->dof;
    double theta = (h[q * dof + q] - h[p * dof + p]) / (2 * h[p * dof + q]);
    double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c, step = t * h[p * dof + q];
    h[p * dof + p] -= step;
    h[q * dof + q] += step;
    h[p * dof + q] = h[q * dof + p] = 0;
    for (size_t i = 0; i < dof; i++) {
        if (i == p || i == q) continue;
        double a = h[i * dof + p], b = h[i * dof + q];
        h[i * dof + p] = h[p * dof + i] = c * a - s * b;
        h[i * dof + q] = h[q * dof + i] = s * a + c * b;
    }
    for (size_t i = 0; i < n; i++) {
        double a = r->shape[p * n + i], b = r->shape[q * n + i];
        r->shape[p * n + i] = c * a - s * b;
        r->shape[q * n + i] = s * a + c * b;
    }
}

/* Small stiffnesses beside large ones (light bodies, stiff springs) come out of the dense
   eigenproblem with the round-off of the largest. In the modes' own coordinates they do not: there
   N^T K N is graded, and Jacobi's rotations respect that. */
static void refine(fw_statics_reduced *r, const double *stiffness) {
    size_t dof = (size_t)r->dof;
    double *h = r->small;
    project(r, stiffness);
    for (int sweep = 0, turned = 1; sweep < 8 && turned; sweep++) {
        turned = 0;
        for (size_t p = 0; p < dof; p++)
            for (size_t q = p + 1; q < dof; q++) {
                double size = sqrt(fabs(h[p * dof + p] * h[q * dof + q]));
                if (!(fabs(h[p * dof + q]) > DBL_EPSILON * size)) continue;
                rotate(r, h, p, q);
                turned = 1;
            }
    }
    for (size_t k = 0; k < dof; k++)
        r->value[k] = h[k * dof + k];
}

/* modes by stiffness, ascending; few are out of order after the refinement */
static void sort_modes(fw_statics_reduced *r) {
    size_t n = (size_t)r->n;
    for (int i = 1; i < r->dof; i++)
        for (int k = i; k > 0 && r->value[k] < r->value[k - 1]; k--) {
            double *a = r->shape + (size_t)k * n, *b = a - n, keep = r->value[k];
            r->value[k] = r->value[k - 1];
            r->value[k - 1] = keep;
            for (size_t j = 0; j < n; j++)
                keep = a[j], a[j] = b[j], b[j] = keep;
        }
}

/* round-off of each value: of its own terms, and squared of what the largest may leave in its
   shape */
static void set_zero(fw_statics_reduced *r, const double *stiffness) {
    size_t n = (size_t)r->n;
    const double small = 64 * DBL_EPSILON;
    double most = 0;
    for (int k = 0; k < r->dof; k++)
        most = fmax(most, fabs(r->value[k]));
    for (size_t k = 0; k < (size_t)r->dof; k++) {
        const double *shape = r->shape + k * n;
        r->zero[k] = small * small * r->dof * most;
        for (size_t i = 0; i < n; i++) {
            double sum = 0;
            for (size_t j = 0; j < n; j++)
                sum += fabs(stiffness[i * n + j] * shape[j]);
            r->zero[k] += small * fabs(shape[i]) * sum;
        }
    }
}

/* Motions without stiffness have any basis: each takes the one coordinate that they move most in
   the mass metric, and the rest of them leave it alone. So what bodies do independently of each
   other stays apart, whatever their masses. Orthonormal as before: shape = P e_j / sqrt(P_jj) with
   the projector P onto the motions that are left. false: there are not two. Cost 3 n per pair.
   Test: test_modes.c. */
static bool separate_free(fw_statics_reduced *r) {
    size_t n = (size_t)r->n, first = 0, end;
    while (first < (size_t)r->dof && fabs(r->value[first]) > r->zero[first])
        first++;
    for (end = first; end < (size_t)r->dof && fabs(r->value[end]) <= r->zero[end];)
        end++;
    if (end < first + 2) return false;
    for (; first + 1 < end; first++) {
        size_t pivot = 0;
        double most = -1;
        for (size_t j = 0; j < n; j++) {
            double share = 0;
            for (size_t k = first; k < end; k++) {
                double part = r->shape[k * n + j] / r->root[j];
                share += part * part;
            }
            if (share > most * (1 + 1e-9)) most = share, pivot = j;
        }
        for (size_t k = first + 1; k < end; k++) { /* Givens: the pivot's part moves to `first` */
            double *a = r->shape + first * n, *b = r->shape + k * n;
            double length = hypot(a[pivot], b[pivot]);
            if (!(length > 0)) continue;
            double c = a[pivot] / length, s = b[pivot] / length;
            for (size_t j = 0; j < n; j++) {
                double keep = c * a[j] + s * b[j];
                b[j] = c * b[j] - s * a[j], a[j] = keep;
            }
            b[pivot] = 0;
        }
    }
    return true;
}

/* z^T K z of each mode */
static void rayleigh(fw_statics_reduced *r, const double *stiffness) {
    project(r, stiffness);
    for (size_t k = 0; k < (size_t)r->dof; k++)
        r->value[k] = r->small[k * (size_t)r->dof + k];
}

/* Modes of K on the null space: eigenvectors of V_0^T M^-1/2 K M^-1/2 V_0 by LAPACK, then a
   Rayleigh-Ritz step in the coordinates of the bodies with Jacobi rotations. Error of a value:
   round- off of its own terms. Cost 4 n^2 dof and 20 dof^3. Source: Demmel and Veselic, SIAM J.
   Matrix Anal. Appl. 13 (1992), on the accuracy of Jacobi's method. Test: test_modes.c (mass ratio
   1e8). */
fw_status fw_statics_reduced_spectrum(fw_statics_reduced *r, const double *stiffness) {
    size_t n = (size_t)r->n, dof = (size_t)r->dof;
    const double *basis = r->right + (size_t)r->rank * n;
    for (size_t k = 0; k < dof; k++)
        for (size_t i = 0; i < n; i++)
            r->shape[k * n + i] = basis[k * n + i] * r->root[i];
    project(r, stiffness);
    for (size_t k = 0; k < dof * dof; k++)
        if (!isfinite(r->small[k])) return FW_SOLVER;
    if (dof > 0 && !fw_maths_eigen(r->dof, r->small, r->value, &r->eigen)) return FW_SOLVER;
    for (size_t k = 0; k < dof; k++)
        for (size_t i = 0; i < n; i++) {
            double sum = 0;
            for (size_t l = 0; l < dof; l++)
                sum += r->small[k * dof + l] * basis[l * n + i];
            r->shape[k * n + i] = sum * r->root[i];
        }
    refine(r, stiffness);
    sort_modes(r);
    set_zero(r, stiffness);
    if (separate_free(r)) {
        rayleigh(r, stiffness);
        sort_modes(r);
        set_zero(r, stiffness);
    }
    return FW_OK;
}

void fw_statics_reduced_multipliers(const fw_multibody_model *m, const fw_statics_reduced *r,
                                    const double *force, double *lambda) {
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
    fw_multibody_unpack(m, mu, lambda);
}

void fw_statics_reduced_correct(const fw_multibody_model *m, const fw_statics_reduced *r,
                                const double *psi, double *d) {
    size_t n = (size_t)r->n, rows = (size_t)r->rows;
    double *packed = r->work;
    fw_multibody_pack(m, psi, packed);
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
