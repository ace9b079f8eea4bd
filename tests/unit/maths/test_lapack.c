/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "maths/matrix.h"

enum { M = 7, N = 5 };

static double next(uint64_t *seed) { /* in [-1, 1) */
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-52 - 1;
}

static void fill(double *a, int count, uint64_t seed) {
    for (int i = 0; i < count; i++)
        a[i] = next(&seed);
}

/* y = a x, column-major */
static void times(int m, int n, const double *a, const double *x, double *y) {
    for (int i = 0; i < m; i++) {
        y[i] = 0;
        for (int j = 0; j < n; j++)
            y[i] += a[i + j * m] * x[j];
    }
}

static void svd_gives_the_matrix_back(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    for (int full = 0; full < 2; full++) {
        double a[M * N], copy[N * M], s[N], u[N * N], vt[M * M];
        fw_maths_lapack_space space;
        fill(a, N * M, 3);
        memcpy(copy, a, sizeof a);
        assert_int_equal(fw_maths_svd_space(arena, N, M, full, &space), FW_OK);
        assert_true(fw_maths_svd(N, M, full, copy, s, u, vt, &space)); /* wide, as Jacobians are */
        int ld = full ? M : N;
        for (int i = 0; i < N; i++)
            for (int j = 0; j < M; j++) {
                double sum = 0;
                for (int k = 0; k < N; k++)
                    sum += u[i + k * N] * s[k] * vt[k + j * ld];
                assert_near(sum, a[i + j * N], 1e-14);
            }
        for (int k = N; full && k < M; k++) { /* the rest spans the null space */
            double row[M], zero[N];
            for (int j = 0; j < M; j++)
                row[j] = vt[k + j * M];
            times(N, M, a, row, zero);
            for (int i = 0; i < N; i++)
                assert_near(zero[i], 0, 1e-14);
        }
    }
    fw_arena_free(arena);
}

static void eigenvectors_diagonalise(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double a[N * N], w[N * N], value[N], y[N];
    fw_maths_lapack_space space;
    fill(a, N * N, 5);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < i; j++)
            a[j + i * N] = a[i + j * N];
    memcpy(w, a, sizeof a);
    assert_int_equal(fw_maths_eigen_space(arena, N, &space), FW_OK);
    assert_true(fw_maths_eigen(N, w, value, &space));
    for (int k = 0; k < N; k++) {
        times(N, N, a, w + k * N, y);
        for (int i = 0; i < N; i++)
            assert_near(y[i], value[k] * w[i + k * N], 1e-14);
        if (k > 0) assert_true(value[k] >= value[k - 1]);
    }
    fw_arena_free(arena);
}

static void qr_gives_the_matrix_back(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double a[M * N], r[M * N], tau[N];
    int pivot[N];
    fw_maths_lapack_space space;
    fill(a, M * N, 7);
    memcpy(r, a, sizeof a);
    assert_int_equal(fw_maths_qr_space(arena, M, N, &space), FW_OK);
    assert_true(fw_maths_qr(M, N, r, pivot, tau, &space));
    for (int j = 0; j < N; j++) {
        double x[M] = {0};
        for (int i = 0; i <= j; i++)
            x[i] = r[i + j * M];
        assert_true(fw_maths_qr_apply(false, M, N, r, tau, x, &space));
        for (int i = 0; i < M; i++)
            assert_near(x[i], a[i + pivot[j] * M], 1e-14);
        assert_true(fw_maths_qr_apply(true, M, N, r, tau, x, &space));
        assert_true(fw_maths_triangle_solve(false, N, r, M, x)); /* R^-1 (column j of R) = e_j */
        for (int i = 0; i < N; i++)
            assert_near(x[i], i == j, 1e-13);
    }
    fw_arena_free(arena);
}

static void solvers_solve(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double a[N * N], f[N * N], x[N], b[N];
    int pivot[N];
    fw_maths_lapack_space space;
    fill(a, N * N, 9);
    fill(x, N, 10);
    memcpy(f, a, sizeof a);
    assert_true(fw_maths_lapack_lu(N, f, pivot));
    times(N, N, a, x, b);
    assert_true(fw_maths_lapack_lu_solve(false, N, 1, f, pivot, b));
    for (int i = 0; i < N; i++)
        assert_near(b[i], x[i], 1e-13);
    for (int i = 0; i < N; i++) { /* a^T x */
        b[i] = 0;
        for (int j = 0; j < N; j++)
            b[i] += a[j + i * N] * x[j];
    }
    assert_true(fw_maths_lapack_lu_solve(true, N, 1, f, pivot, b));
    for (int i = 0; i < N; i++)
        assert_near(b[i], x[i], 1e-13);

    for (int i = 0; i < N; i++)
        for (int j = 0; j < i; j++)
            a[j + i * N] = a[i + j * N];
    memcpy(f, a, sizeof a);
    assert_int_equal(fw_maths_indefinite_space(arena, N, &space), FW_OK);
    assert_true(fw_maths_indefinite(N, f, pivot, &space));
    times(N, N, a, x, b);
    assert_true(fw_maths_indefinite_solve(N, f, pivot, b));
    for (int i = 0; i < N; i++)
        assert_near(b[i], x[i], 1e-13);

    for (int i = 0; i < N; i++)
        a[i + i * N] += 4;
    memcpy(f, a, sizeof a);
    assert_true(fw_maths_cholesky(N, f));
    times(N, N, a, x, b);
    assert_true(fw_maths_cholesky_solve(N, f, b));
    for (int i = 0; i < N; i++)
        assert_near(b[i], x[i], 1e-14);
    a[0] = -1;
    assert_false(fw_maths_cholesky(N, a));
    memset(a, 0, sizeof a);
    assert_false(fw_maths_lapack_lu(N, a, pivot));
    fw_arena_free(arena);
}

static void complete_pivoting_finds_the_rank(void **state) {
    (void)state;
    double a[N * M], copy[N * M], last;
    int row[N], column[M];
    fill(a, N * M, 11);
    memcpy(copy, a, sizeof a);
    assert_int_equal(fw_maths_complete_pivoting(N, M, copy, row, column, 1e-12, &last), N);
    assert_true(last > 1e-3 && last <= 1);
    for (int j = 0; j < M; j++) { /* two rows depend on the others */
        a[3 * M + j] = a[j] - 2 * a[M + j];
        a[4 * M + j] = 0.5 * a[2 * M + j];
    }
    memcpy(copy, a, sizeof a);
    assert_int_equal(fw_maths_complete_pivoting(N, M, copy, row, column, 1e-12, &last), 3);
    memset(a, 0, sizeof a);
    assert_int_equal(fw_maths_complete_pivoting(N, M, a, row, column, 1e-12, &last), 0);
}

static void memory_short_is_said(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_maths_lapack_space space;
    fw_arena_fail_at(1, 1);
    assert_int_equal(fw_maths_svd_space(arena, M, N, true, &space), FW_NOMEM);
    assert_int_equal(fw_maths_eigen_space(arena, N, &space), FW_NOMEM);
    assert_int_equal(fw_maths_qr_space(arena, M, N, &space), FW_NOMEM);
    assert_int_equal(fw_maths_indefinite_space(arena, N, &space), FW_NOMEM);
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(svd_gives_the_matrix_back),
        cmocka_unit_test(eigenvectors_diagonalise),
        cmocka_unit_test(qr_gives_the_matrix_back),
        cmocka_unit_test(solvers_solve),
        cmocka_unit_test(complete_pivoting_finds_the_rank),
        cmocka_unit_test(memory_short_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
