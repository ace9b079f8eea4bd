/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statics/statics_equilibrium.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- large mechanisms ---- */

/* unknowns: coordinates by bodies, then rows of joints by whichever of their bodies goes first */
static fw_status system_new(fw_arena *arena, const fw_multibody_model *m, fw_maths_sparse **out) {
    const size_t n = (size_t)m->nq + (size_t)m->rows;
    const int couplings = fw_statics_tangent_pairs(m, NULL);
    int *first, *second, *pair, at = m->nq;
    FW_NEED(first = fw_arena_array(arena, int, n));
    FW_NEED(second = fw_arena_array(arena, int, n));
    FW_NEED(pair = fw_arena_array(arena, int, 2 * (size_t)couplings));
    fw_statics_tangent_pairs(m, pair);
    for (int i = 0; i < m->nq; i++)
        first[i] = i / 3, second[i] = FW_MATHS_NONE;
    for (int i = 0; i < m->nblock; i++)
        for (int k = 0; k < fw_multibody_row_count(&m->block[i]); k++, at++) {
            const int a = m->block[i].a, b = m->block[i].b;
            first[at] = a < m->nbody ? a : b < m->nbody ? b : 0;
            second[at] = a < m->nbody && b < m->nbody ? b : FW_MATHS_NONE;
        }
    const fw_maths_sparse_shape shape = {(int)n, m->nbody, couplings, first, second, pair};
    return fw_maths_sparse_new(arena, &shape, out);
}

static fw_status sparse_new(fw_arena *arena, const fw_multibody_model *m, fw_statics_reduced *r) {
    const size_t n = (size_t)m->nq, all = n + (size_t)m->rows, most = FW_STATICS_LOWEST_MODES;
    fw_statics_sparse *s;
    FW_NEED(r->sparse = s = fw_arena_one(arena, fw_statics_sparse));
    s->stiffness.arena = s->damping.arena = s->joints.arena = arena;
    FW_NEED(r->shape = fw_arena_array(arena, double, most *n));
    FW_NEED(r->value = fw_arena_array(arena, double, most));
    FW_NEED(r->zero = fw_arena_array(arena, double, most));
    FW_NEED(r->work = fw_arena_array(arena, double, all + n));
    FW_NEED(s->x = fw_arena_array(arena, double, all));
    FW_NEED(s->y = fw_arena_array(arena, double, all + n));
    FW_NEED(s->work = fw_arena_array(arena, double, 2 * all));
    FW_NEED(s->unbalanced = fw_arena_array(arena, double, n));
    FW_NEED(s->round_off = fw_arena_array(arena, double, n));
    return system_new(arena, m, &s->system);
}

/* A by its entries; false: not finite */
static bool take_joints(const fw_multibody_model *m, const fw_multibody_pose *pose,
                        fw_statics_reduced *r) {
    fw_statics_entries *to = &r->sparse->joints;
    fw_statics_entries_clear(to);
    for (int i = 0, row = 0; i < m->nblock; i++) {
        const int rows = fw_multibody_row_count(&m->block[i]), before = to->count;
        double sum[2] = {0};
        for (int side = 0; side < 2; side++) {
            const int body = m->body[2 * i + side];
            double g[6];
            if (body == m->nbody) continue;
            fw_multibody_side_jacobian(m, pose, i, side, g);
            for (int k = 0; k < 3 * rows; k++) {
                const double a = g[k] * r->root[3 * body + k % 3];
                sum[k / 3] += a * a;
                fw_statics_entries_add(to, row + k / 3, 3 * body + k % 3, a);
            }
        }
        for (int k = 0; k < rows; k++) {
            if (!isfinite(sum[k])) return false;
            r->balance[row + k] = sum[k] > 0 ? 1 / sqrt(sum[k]) : 1;
        }
        for (int e = before; e < to->count; e++)
            to->value[e] *= r->balance[to->row[e]];
        row += rows;
    }
    return !to->failed;
}

/* without_K: 1 in its place */
static fw_status factor(fw_statics_reduced *r, bool without_K, double shift,
                        fw_maths_sparse_signs *signs) {
    fw_statics_sparse *s = r->sparse;
    const double nothing = without_K ? 1e-12 : 4e-15; /* rows repeat each other; round-off of K */
    fw_maths_sparse_clear(s->system);
    for (int i = 0; i < r->n; i++)
        fw_maths_sparse_add(s->system, i, i, without_K ? 1 : shift);
    for (int e = 0; e < s->stiffness.count && !without_K; e++) { /* the mean with its transpose */
        const int i = s->stiffness.row[e], j = s->stiffness.column[e];
        const double k = s->stiffness.value[e] * r->root[i] * r->root[j] / s->unit;
        fw_maths_sparse_add(s->system, i, j, i == j ? k : 0.5 * k);
    }
    for (int e = 0; e < s->joints.count; e++)
        fw_maths_sparse_add(s->system, r->n + s->joints.row[e], s->joints.column[e],
                            s->joints.value[e]);
    for (int i = 0; i < r->rows && s->give > 0; i++)
        fw_maths_sparse_add(s->system, r->n + i, r->n + i, -s->give);
    return fw_maths_sparse_factor(s->system, nothing, signs);
}

/* x (n + rows) = system^-1 x; what joints give way by is taken off again until it is round-off */
static void solve(const fw_statics_reduced *r, double *x) {
    fw_statics_sparse *s = r->sparse;
    enum { TURNS = 6 };
    if (s->give == 0) {
        fw_maths_sparse_solve(s->system, x, s->work);
        return;
    }
    const size_t bytes = (size_t)(r->n + r->rows) * sizeof *x;
    memcpy(s->y, x, bytes);
    for (int turn = 0; turn < TURNS; turn++) {
        for (int i = r->n; turn > 0 && i < r->n + r->rows; i++)
            x[i] = s->y[i] - s->give * x[i];
        if (turn > 0) memcpy(x, s->y, (size_t)r->n * sizeof *x);
        fw_maths_sparse_solve(s->system, x, s->work);
    }
}

/* how often the rows of joints say the same: a factor without K tells */
static fw_status sparse_null(const fw_multibody_model *m, const fw_multibody_pose *pose,
                             fw_statics_reduced *r) {
    fw_maths_sparse_signs signs;
    if (!take_joints(m, pose, r)) return r->sparse->joints.failed ? FW_NOMEM : FW_SOLVER;
    r->sparse->give = 0;
    FW_TRY(factor(r, true, 0, &signs));
    r->rank = r->rows - signs.nothing;
    r->dof = r->n - r->rank;
    r->modes = 0;
    r->largest = r->kept = r->dropped = 0;
    int *repeats = &r->sparse->repeats, at = r->n - 1;
    const int most = sizeof r->sparse->repeat / sizeof r->sparse->repeat[0];
    for (*repeats = 0; *repeats < signs.nothing && *repeats < most; (*repeats)++) {
        at = fw_maths_sparse_nothing(r->sparse->system, at + 1);
        if (at == FW_MATHS_NONE) break;
        r->sparse->repeat[*repeats] = at - r->n;
    }
    if (signs.nothing == 0) return FW_OK;
    r->sparse->give = 1e-8;
    return factor(r, true, 0, &signs);
}

/* after the multipliers, whose right side is that of `work` still: x = (M^-1/2 (Q - G^T lambda), mu) */
static void sparse_multipliers(const fw_multibody_model *m, const fw_statics_reduced *r,
                               const double *force, double *lambda) {
    double *x = r->sparse->x;
    memset(x, 0, (size_t)(r->n + r->rows) * sizeof *x);
    for (int i = 0; i < r->n; i++)
        x[i] = r->root[i] * force[i];
    solve(r, x);
    for (int i = 0; i < r->rows; i++)
        r->work[i] = x[r->n + i] * r->balance[i];
    fw_multibody_unpack(m, r->work, lambda);
}

static void sparse_correct(const fw_multibody_model *m, const fw_statics_reduced *r,
                           const double *psi, double *d) {
    double *x = r->sparse->x;
    memset(x, 0, (size_t)r->n * sizeof *x);
    fw_multibody_pack(m, psi, x + r->n);
    for (int i = 0; i < r->rows; i++)
        x[r->n + i] *= -r->balance[i];
    solve(r, x);
    for (int i = 0; i < r->n; i++)
        d[i] = x[i] * r->root[i];
}

void fw_statics_sparse_balance(fw_statics_reduced *r, const double *force) {
    fw_statics_sparse *s = r->sparse;
    const double small = 64 * DBL_EPSILON, *mu = s->x + r->n;
    double most = DBL_MIN;
    for (int i = 0; i < r->n; i++)
        s->unbalanced[i] = s->round_off[i] = r->root[i] * force[i];
    for (int e = 0; e < s->joints.count; e++) {
        const double part = s->joints.value[e] * mu[s->joints.row[e]];
        s->unbalanced[s->joints.column[e]] -= part;
        s->round_off[s->joints.column[e]] =
            fmax(fabs(s->round_off[s->joints.column[e]]), fabs(part));
    }
    for (int e = 0; e < s->stiffness.count; e++) {
        const int i = s->stiffness.row[e], j = s->stiffness.column[e];
        const double k = fabs(s->stiffness.value[e]) * r->root[i];
        most = fmax(most, k * r->root[j]);
        if (i == j) s->round_off[i] = fabs(s->round_off[i]) + k;
    }
    for (int i = 0; i < r->n; i++)
        s->round_off[i] = small * fabs(s->round_off[i]);
    s->unit = most;
}

fw_status fw_statics_sparse_factor(fw_statics_reduced *r, double shift, int *negative) {
    fw_maths_sparse_signs signs;
    FW_TRY(factor(r, false, shift, &signs));
    const int repeated = r->rows - r->rank;
    r->sparse->shift = shift;
    *negative = signs.negative - (r->sparse->give > 0 ? r->rows : r->rank);
    r->sparse->zero = signs.nothing - (r->sparse->give > 0 ? 0 : repeated);
    return FW_OK;
}

void fw_statics_sparse_solve(const fw_statics_reduced *r, double *x) {
    double *all = r->sparse->x;
    memcpy(all, x, (size_t)r->n * sizeof *x);
    memset(all + r->n, 0, (size_t)r->rows * sizeof *x);
    solve(r, all);
    memcpy(x, all, (size_t)r->n * sizeof *x);
}

bool fw_statics_sparse_answers(const fw_statics_reduced *r, const double *step) {
    const fw_statics_sparse *s = r->sparse;
    double *rest = s->work, most = 0, off = 0;
    for (int i = 0; i < r->n; i++)
        rest[i] = s->unbalanced[i], most = fmax(most, fabs(rest[i]));
    for (int e = 0; e < s->stiffness.count; e++)
        rest[s->stiffness.row[e]] -=
            s->stiffness.value[e] * r->root[s->stiffness.row[e]] * step[s->stiffness.column[e]];
    for (int e = 0; e < s->joints.count; e++)
        rest[s->joints.column[e]] -= s->joints.value[e] * s->unit * s->x[r->n + s->joints.row[e]];
    for (int i = 0; i < r->n; i++)
        off = fmax(off, fabs(rest[i]) - s->round_off[i]);
    return off <= 1e-6 * most;
}

static void apply_inverse(void *context, const double *x, double *y) {
    const fw_statics_reduced *r = context;
    memcpy(y, x, (size_t)r->n * sizeof *y);
    fw_statics_sparse_solve(r, y);
}

/* value, round-off of it, and shape in u from that in z: as set_zero below */
static void take_mode(fw_statics_reduced *r, int k) {
    const fw_statics_sparse *s = r->sparse;
    double *shape = r->shape + (size_t)k * (size_t)r->n, value = 0, zero = 0, size = 0;
    for (int i = 0; i < r->n; i++)
        size += shape[i] * shape[i], shape[i] *= r->root[i];
    for (int e = 0; e < s->stiffness.count; e++) {
        const double part =
            s->stiffness.value[e] * shape[s->stiffness.row[e]] * shape[s->stiffness.column[e]];
        value += part, zero += fabs(part);
    }
    /* where the sum has lost digits, the system has them still */
    const double of_system = r->value[k] != 0 ? s->unit * (1 / r->value[k] - s->shift) : 0;
    const double rest = DBL_EPSILON * zero / size;
    r->value[k] = fabs(value / size - of_system) > 1e3 * rest ? value / size : of_system;
    r->zero[k] = 64 * rest;
}

/* The lowest modes: Lanczos's method with the system at a shift below all of them, where the signs of its pivots say that
   none is, so that the largest values of its inverse are they; where equal ones are missed (the signs at a shift behind
   the last know) it is asked again. Error: that of the system, eps over the lowest stiffness in `unit`. Cost: some 4 count
   solves. Test: tests/cli/test_large.py */
static fw_status below_all(fw_statics_reduced *r) {
    enum { HALVINGS = 4 };
    int negative;
    FW_TRY(fw_statics_sparse_factor(r, 0, &negative));
    if (negative == 0 && r->sparse->zero == 0) return FW_OK;
    double low = 1e-9, high = 1e-8;
    for (;; low = high, high *= 10) {
        if (!(high < 1e6)) return FW_SOLVER;
        FW_TRY(fw_statics_sparse_factor(r, high, &negative));
        if (negative == 0 && r->sparse->zero == 0) break;
    }
    for (int i = 0; i < HALVINGS && low > 1e-9;
         i++) { /* near the lowest they lie far apart in the inverse */
        const double middle = sqrt(low * high);
        FW_TRY(fw_statics_sparse_factor(r, middle, &negative));
        *(negative == 0 && r->sparse->zero == 0 ? &high : &low) = middle;
    }
    return fw_statics_sparse_factor(r, high, &negative);
}

fw_status fw_statics_sparse_lowest(fw_arena *arena, fw_statics_reduced *r, int count) {
    const fw_maths_operator op = {r->n, apply_inverse, r};
    const size_t n = (size_t)r->n;
    if (count > r->dof) count = r->dof;
    r->modes = 0;
    FW_TRY(below_all(r));
    for (int turn = 0; turn < 4 && r->modes < count; turn++) {
        int found;
        FW_TRY(fw_maths_lanczos(arena, &op, count - r->modes, r->modes, r->shape,
                                r->value + r->modes, r->shape + (size_t)r->modes * n, &found));
        r->modes += found;
        if (found == 0) break;
    }
    if (r->modes == 0 && count > 0) return FW_SOLVER; /* of some less than asked for is enough */
    for (int k = 0; k < r->modes; k++)
        take_mode(r, k);
    return FW_OK;
}

/* u onto the joints by Newton's method with a factor at every pose: of thousands of links the way that motions take, with
   one factor for small corrections, does not get there */
bool fw_statics_sparse_close(fw_statics_equilibrium *w, double *u) {
    const fw_multibody_model *m = w->model;
    double before = (double)INFINITY;
    const double round_off = fmax(1e-12, 8 * DBL_EPSILON * m->size);
    for (int i = 0; i < 20; i++) {
        const fw_multibody_pose *pose = fw_multibody_pose_at(w->system, w->t, u);
        const double norm = fw_multibody_residual(w->system, pose, w->psi);
        if (!isfinite(norm) || norm > 1e3 * before) return false;
        if (norm <= round_off && norm > 0.25 * before) return true;
        before = norm;
        if (fw_statics_reduced_null(m, pose, &w->reduced) != FW_OK) return false;
        fw_statics_reduced_correct(m, &w->reduced, w->psi, w->step);
        for (int k = 0; k < m->nq; k++)
            u[k] += w->step[k];
    }
    return before <= round_off;
}

/* ---- a new one ---- */

fw_status fw_statics_reduced_new(fw_arena *arena, const fw_multibody_model *m, bool sparse,
                                 fw_statics_reduced *r) {
    size_t n = (size_t)m->nq, rows = (size_t)m->rows;
    *r = (fw_statics_reduced){.n = m->nq, .rows = m->rows, .cancel = fw_arena_request(arena)};
    FW_NEED(r->root = fw_arena_array(arena, double, n));
    FW_NEED(r->balance = fw_arena_array(arena, double, rows));
    for (int i = 0; i < m->nq; i++)
        r->root[i] = 1 / sqrt(i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]);
    if (sparse) return sparse_new(arena, m, r);
    FW_NEED(r->shape = fw_arena_array(arena, double, n *n));
    FW_NEED(r->value = fw_arena_array(arena, double, n));
    FW_NEED(r->zero = fw_arena_array(arena, double, n));
    size_t least = n < rows ? n : rows;
    FW_NEED(r->g = fw_arena_array(arena, double, rows *n));
    FW_NEED(r->a = fw_arena_array(arena, double, n *(rows > n ? rows : n)));
    FW_NEED(r->sigma = fw_arena_array(arena, double, least));
    FW_NEED(r->left = fw_arena_array(arena, double, rows *least));
    FW_NEED(r->right = fw_arena_array(arena, double, n *n));
    FW_NEED(r->small = fw_arena_array(arena, double, n *n));
    FW_NEED(r->work = fw_arena_array(arena, double, n + 2 * rows));
    if (rows > 0) FW_TRY(fw_maths_svd_space(arena, m->rows, m->nq, true, &r->svd));
    return fw_maths_eigen_space(arena, m->nq, &r->eigen);
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
    if (r->sparse) return sparse_null(m, pose, r);
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
    r->dof = r->modes = r->n - r->rank;
    r->kept = r->rank > 0 ? r->sigma[r->rank - 1] : 0;
    r->dropped = r->rank < most ? r->sigma[r->rank] : 0;
    return FW_OK;
}

/* N^T K N for the rows of r->shape, into r->small (dof x dof), symmetric */
static void project(fw_statics_reduced *r, const double *stiffness) {
    size_t n = (size_t)r->n, dof = (size_t)r->dof;
    for (size_t k = 0; k < dof && !fw_cancel_requested(r->cancel); k++) {
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
        for (size_t p = 0; p < dof && !fw_cancel_requested(r->cancel); p++)
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
    for (size_t k = 0; k < (size_t)r->dof && !fw_cancel_requested(r->cancel); k++) {
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
    if (fw_cancel_requested(r->cancel)) return FW_CANCELLED;
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
    return fw_cancel_requested(r->cancel) ? FW_CANCELLED : FW_OK;
}

void fw_statics_reduced_multipliers(const fw_multibody_model *m, const fw_statics_reduced *r,
                                    const double *force, double *lambda) {
    size_t n = (size_t)r->n, rows = (size_t)r->rows;
    double *mu = r->work, *part = r->work + rows;
    if (r->sparse) {
        sparse_multipliers(m, r, force, lambda);
        return;
    }
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
    if (r->sparse) {
        sparse_correct(m, r, psi, d);
        return;
    }
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
