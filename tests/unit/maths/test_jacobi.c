/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/matrix.h"
#include "test.h"

static uint64_t seed = 3;
static double any(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-52 - 1;
}

/* A v = value v, orthonormal vectors, ascending values; graded by up to 1e12 */
static void random_matrices(void **state) {
    (void)state;
    enum { MOST = 24 };
    double a[MOST * MOST], used[MOST * MOST], v[MOST * MOST], value[MOST], scale[MOST];
    for (int round = 0; round < 200; round++) {
        int n = 1 + round % MOST;
        for (int i = 0; i < n; i++)
            scale[i] = round % 3 ? 1 : pow(10, 3 * any());
        for (int i = 0; i < n; i++)
            for (int k = 0; k <= i; k++)
                a[i * n + k] = a[k * n + i] = scale[i] * scale[k] * any();
        memcpy(used, a, sizeof a);
        assert_true(fw_maths_jacobi(n, used, value, v));
        double size = 0;
        for (int i = 0; i < n; i++)
            size = fmax(size, fabs(value[i]));
        for (int k = 0; k < n; k++) {
            if (k) assert_true(value[k] >= value[k - 1]);
            for (int i = 0; i < n; i++) {
                double left = 0, dot = 0;
                for (int j = 0; j < n; j++)
                    left += a[i * n + j] * v[k * n + j], dot += v[i * n + j] * v[k * n + j];
                assert_near(left, value[k] * v[k * n + i], 1e-13 * size);
                assert_near(dot, i == k, 1e-13);
            }
        }
    }
}

/* small eigenvalues of a graded positive matrix have as many digits as its entries: D H D with
   H = 1 + 0.5 on the sides; the product of the values is the determinant */
static void graded(void **state) {
    (void)state;
    double d[3] = {1, 1e-6, 1e-12}, a[9], v[9], value[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            a[3 * i + k] = d[i] * d[k] * (i == k ? 1 : 0.5);
    assert_true(fw_maths_jacobi(3, a, value, v));
    double det = 0.5 * 1e-36; /* det H = 1/2 */
    assert_near(value[0] * value[1] * value[2] / det, 1, 1e-13);
}

static void not_finite(void **state) {
    (void)state;
    double a[4] = {1, (double)NAN, (double)NAN, 1}, v[4], value[2];
    assert_false(fw_maths_jacobi(2, a, value, v));
    double one[1] = {-3}, w[1], x[1];
    assert_true(fw_maths_jacobi(1, one, x, w) && x[0] == -3 && w[0] == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_matrices), cmocka_unit_test(graded),
                                       cmocka_unit_test(not_finite)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
