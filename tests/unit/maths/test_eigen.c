/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/eigen.h"
#include "test.h"
#include <stdbool.h>

static double next(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-52 - 1;
}

/* a = left diag(sigma) right, both orthogonal, for wide, tall, square and deficient matrices */
static void singular_values_rebuild_the_matrix(void **state) {
    (void)state;
    enum { MOST = 12 };
    uint64_t seed = 7;
    for (int round = 0; round < 60; round++) {
        fw_arena *arena = fw_arena_new(0);
        int m = round % MOST, n = (round * 5 + 1) % MOST, k = m < n ? m : n;
        double a[MOST * MOST], copy[MOST * MOST], sigma[MOST], left[MOST * MOST],
            right[MOST * MOST];
        for (int i = 0; i < m * n; i++)
            a[i] = next(&seed);
        for (int j = 0; m > 2 && j < n; j++)
            a[(m - 1) * n + j] = a[j]; /* a row twice */
        memcpy(copy, a, sizeof a);
        assert_int_equal(fw_svd(arena, m, n, a, sigma, left, right), FW_OK);
        for (int i = 0; i < m; i++)
            for (int j = 0; j < n; j++) {
                double sum = 0;
                for (int l = 0; l < k; l++)
                    sum += left[i * m + l] * sigma[l] * right[l * n + j];
                assert_near(sum, copy[i * n + j], 1e-14 * MOST);
            }
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                double sum = 0;
                for (int l = 0; l < n; l++)
                    sum += right[i * n + l] * right[j * n + l];
                assert_near(sum, i == j, 1e-14);
            }
        for (int l = 1; l < k; l++)
            assert_true(sigma[l] <= sigma[l - 1]);
        if (m > 2 && m <= n) assert_true(sigma[m - 1] <= 1e-14);
        fw_arena_free(arena);
    }
}

static void symmetric_known_values(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    enum { N = 9 };
    double a[N * N] = {0}, value[N], pi = acos(-1.0);
    for (int i = 0; i < N; i++) { /* the string of springs: 2 - 2 cos(k pi / (N + 1)) */
        a[i * N + i] = 2;
        if (i) a[i * N + i - 1] = -1; /* lower triangle only */
    }
    assert_int_equal(fw_eigen_symmetric(arena, N, a, value), FW_OK);
    for (int k = 0; k < N; k++) {
        assert_near(value[k], 2 - 2 * cos((k + 1) * pi / (N + 1)), 4e-15);
        double size = 0;
        for (int i = 0; i < N; i++) {
            double v = a[k * N + i], before = i ? a[k * N + i - 1] : 0;
            double after = i + 1 < N ? a[k * N + i + 1] : 0;
            assert_near(2 * v - before - after, value[k] * v, 1e-14);
            size += v * v;
        }
        assert_near(size, 1, 1e-14);
    }
    fw_arena_free(arena);
}

/* each pair satisfies a x = value x, complex ones too */
static void general_pairs_satisfy_their_equation(void **state) {
    (void)state;
    enum { N = 8 };
    uint64_t seed = 3;
    int complex_ones = 0;
    for (int round = 0; round < 40; round++) {
        fw_arena *arena = fw_arena_new(0);
        double a[N * N], copy[N * N], re[N], im[N], x[N * N];
        for (int i = 0; i < N * N; i++)
            a[i] = next(&seed);
        memcpy(copy, a, sizeof a);
        assert_int_equal(fw_eigen_general(arena, N, a, re, im, x), FW_OK);
        for (int k = 0; k < N; k++) {
            bool pair = im[k] > 0;
            const double zero[N] = {0};
            const double *p = x + k * N, *q = pair ? x + (k + 1) * N : zero;
            if (pair) assert_near(im[k + 1], -im[k], 0);
            for (int i = 0; i < N; i++) {
                double left_re = 0, left_im = 0;
                for (int j = 0; j < N; j++) {
                    left_re += copy[i * N + j] * p[j];
                    left_im += copy[i * N + j] * q[j];
                }
                assert_near(left_re, re[k] * p[i] - im[k] * q[i], 1e-12);
                assert_near(left_im, re[k] * q[i] + im[k] * p[i], 1e-12);
            }
            if (pair) complex_ones++, k++;
        }
        fw_arena_free(arena);
    }
    assert_true(complex_ones > 40);
}

static void what_is_not_finite_is_refused(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double a[4] = {1, (double)NAN, 0, 1}, b[4] = {1, 0, (double)INFINITY, 1}, s[2], l[4], r[4];
    assert_int_equal(fw_svd(arena, 2, 2, a, s, l, r), FW_SOLVER);
    assert_int_equal(fw_eigen_symmetric(arena, 2, b, s), FW_SOLVER);
    assert_int_equal(fw_eigen_general(arena, 2, a, s, l, r), FW_SOLVER);
    assert_int_equal(fw_eigen_symmetric(arena, 0, b, s), FW_OK);
    fw_arena_free(arena);
}

static void short_memory_is_said(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double a[4] = {2, 1, 1, 3}, s[2], l[4], r[4];
    fw_arena_fail_at(1, 1);
    fw_status first = fw_svd(arena, 2, 2, a, s, l, r), second = fw_eigen_symmetric(arena, 2, a, s);
    fw_status third = fw_eigen_general(arena, 2, a, s, l, r);
    fw_arena_fail_at(0, 0);
    assert_int_equal(first, FW_NOMEM);
    assert_int_equal(second, FW_NOMEM);
    assert_int_equal(third, FW_NOMEM);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singular_values_rebuild_the_matrix),
        cmocka_unit_test(symmetric_known_values),
        cmocka_unit_test(general_pairs_satisfy_their_equation),
        cmocka_unit_test(what_is_not_finite_is_refused),
        cmocka_unit_test(short_memory_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
