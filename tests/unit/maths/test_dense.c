/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/matrix.h"
#include "test.h"

static double random_number(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53 - 0.5;
}

/* a saddle point matrix [K G^T; G 0] with random K > 0 and G; known x */
static void test_saddle(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    uint64_t seed = 1;
    enum { N = 12, M = 5, ALL = N + M };
    for (int run = 0; run < 50; run++) {
        double a[ALL * ALL] = {0}, x[ALL], b[ALL] = {0}, got[ALL];
        bool consistent;
        for (int i = 0; i < N; i++)
            a[i * ALL + i] = 1 + random_number(&seed);
        for (int i = N; i < ALL; i++)
            for (int j = 0; j < N; j++)
                a[i * ALL + j] = a[j * ALL + i] = random_number(&seed);
        for (int i = 0; i < ALL; i++)
            x[i] = random_number(&seed);
        for (int i = 0; i < ALL; i++)
            for (int j = 0; j < ALL; j++)
                b[i] += a[i * ALL + j] * x[j];
        assert_int_equal(fw_maths_dense_solve_symmetric(arena, ALL, a, b, got, &consistent), FW_OK);
        assert_true(consistent);
        for (int i = 0; i < ALL; i++)
            assert_near(got[i], x[i], 1e-11);
    }
    fw_arena_free(arena);
}

/* rank one: a consistent right-hand side gives the shortest solution, another one says no */
static void test_singular(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double a[4] = {1, 2, 2, 4}, yes[2] = {5, 10}, no[2] = {5, 0};
    double x[2];
    bool consistent;
    assert_int_equal(fw_maths_dense_solve_symmetric(arena, 2, a, yes, x, &consistent), FW_OK);
    assert_true(consistent);
    assert_near(x[0], 1, 1e-12);
    assert_near(x[1], 2, 1e-12);
    assert_int_equal(fw_maths_dense_solve_symmetric(arena, 2, a, no, x, &consistent), FW_OK);
    assert_false(consistent);
    for (long n = 1; n <= 7; n++) { /* LU takes three, least squares four */
        fw_arena_fail_at(n, 0);
        fw_status status = fw_maths_dense_solve_symmetric(arena, 2, a, yes, x, &consistent);
        assert_int_equal(status, FW_NOMEM);
    }
    fw_arena_fail_at(0, 0);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_saddle),
        cmocka_unit_test(test_singular),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
