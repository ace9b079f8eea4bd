/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/matrix.h"
#include "test.h"

static double noise(unsigned i) {
    return sin(12.9898 * i + 0.3) * 0.7 + cos(3.7 * i * i);
}

/* a = U diag(sigma) V^T, both bases orthonormal, for wide, tall and rank-deficient matrices */
static void test_product(void **state) {
    (void)state;
    static const int size[][2] = {{1, 1}, {2, 7}, {7, 2}, {5, 5}, {12, 15}};
    for (size_t c = 0; c < sizeof size / sizeof size[0]; c++)
        for (int deficient = 0; deficient < 2; deficient++) {
            fw_arena *arena = fw_arena_new(0);
            int m = size[c][0], n = size[c][1], least = m < n ? m : n;
            double a[180];
            for (int i = 0; i < m * n; i++)
                a[i] = noise((unsigned)i);
            for (int k = 0; deficient && m > 1 && k < n; k++)
                a[(m - 1) * n + k] = 2 * a[k];
            fw_maths_singular s;
            assert_int_equal(fw_maths_singular_new(arena, m, n, a, &s), FW_OK);
            for (int i = 0; i < m; i++)
                for (int k = 0; k < n; k++) {
                    double sum = 0;
                    for (int j = 0; j < least; j++)
                        sum += s.u[j * m + i] * s.sigma[j] * s.v[j * n + k];
                    assert_near(sum, a[i * n + k], 1e-14 * n);
                }
            for (int i = 0; i < n; i++)
                for (int k = 0; k < n; k++) {
                    double dot = 0;
                    for (int j = 0; j < n; j++)
                        dot += s.v[i * n + j] * s.v[k * n + j];
                    assert_near(dot, i == k, 1e-14);
                }
            for (int j = 1; j < least; j++)
                assert_true(s.sigma[j] <= s.sigma[j - 1]);
            if (deficient && m > 1 && m <= n) assert_near(s.sigma[least - 1], 0, 1e-14);
            fw_arena_free(arena);
        }
}

static void test_edges(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_maths_singular s;
    assert_int_equal(fw_maths_singular_new(arena, 0, 3, NULL, &s), FW_OK);
    assert_near(s.v[0] + s.v[4] + s.v[8], 3, 0);
    double bad[2] = {1, (double)NAN};
    assert_int_equal(fw_maths_singular_new(arena, 1, 2, bad, &s), FW_SOLVER);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_product),
                                       cmocka_unit_test(test_edges)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
