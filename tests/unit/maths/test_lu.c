/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/matrix.h"
#include "test.h"

enum { MOST = 24 };
static double a[MOST * MOST], b[MOST * MOST], f[MOST * MOST], g[MOST * MOST], x[MOST], y[MOST];

static double noise(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 2147483648.0 - 1;
}

/* a x = r and (a + i b)(x + i y) = r + i s for random matrices with a zero on the diagonal */
static void test_residuals(void **state) {
    (void)state;
    unsigned seed = 7;
    int pivot[MOST];
    for (int n = 1; n <= MOST; n++) {
        double r[MOST], s[MOST];
        for (int i = 0; i < n * n; i++)
            a[i] = f[i] = noise(&seed), b[i] = g[i] = noise(&seed);
        if (n > 1) a[0] = f[0] = b[0] = g[0] = 0;
        for (int i = 0; i < n; i++)
            x[i] = r[i] = noise(&seed), y[i] = s[i] = noise(&seed);
        assert_true(fw_maths_lu_factor(n, f, pivot));
        fw_maths_lu_solve(n, f, pivot, NULL, x);
        for (int i = 0; i < n; i++) {
            double sum = -r[i], size = 0;
            for (int j = 0; j < n; j++) {
                sum += a[i * n + j] * x[j];
                size += fabs(a[i * n + j] * x[j]);
            }
            assert_near(sum, 0, 1e-13 * (size + 1)); /* growth of partial pivoting is small here */
        }
        for (int i = 0; i < n * n; i++)
            f[i] = a[i];
        for (int i = 0; i < n; i++)
            x[i] = r[i];
        assert_true(fw_maths_lu_factor_complex(n, f, g, pivot));
        fw_maths_lu_solve_complex(n, f, g, pivot, NULL, x, y);
        for (int i = 0; i < n; i++) {
            double re = -r[i], im = -s[i], size = 0;
            for (int j = 0; j < n; j++) {
                re += a[i * n + j] * x[j] - b[i * n + j] * y[j];
                im += a[i * n + j] * y[j] + b[i * n + j] * x[j];
                size += fabs(x[j]) + fabs(y[j]);
            }
            assert_near(hypot(re, im), 0, 1e-13 * (size + 1));
        }
    }
}

static void test_refusals(void **state) {
    (void)state;
    int pivot[2];
    double singular[4] = {1, 2, 2, 4}, im[4] = {0}, nan[4] = {1, (double)NAN, 2, 3};
    double infinite[4] = {(double)INFINITY, 1, 1, 1};
    assert_false(fw_maths_lu_factor(2, singular, pivot));
    double again[4] = {1, 2, 2, 4};
    assert_false(fw_maths_lu_factor_complex(2, again, im, pivot));
    assert_false(fw_maths_lu_factor(2, nan, pivot));
    assert_false(fw_maths_lu_factor(2, infinite, pivot));
}

/* by rows that have to change places, with the determinant; a singular one is refused */
static void test_three(void **state) {
    (void)state;
    const double three[3][3] = {{0, 2, 1}, {1, 1, 1}, {4, 1, -2}};
    double right[3][3] = {{7, 2}, {6, 1}, {0, 4}}, det;
    assert_true(fw_maths_solve3(three, 2, right, &det));
    assert_near(det, 9, 1e-14);
    for (int j = 0; j < 2; j++) {
        const double is[2][3] = {{7, 6, 0}, {2, 1, 4}};
        for (int i = 0; i < 3; i++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += three[i][k] * right[k][j];
            assert_near(sum, is[j][i], 1e-14);
        }
    }
    const double flat[3][3] = {{1, 2, 3}, {2, 4, 6}, {1, 0, 1}};
    assert_false(fw_maths_solve3(flat, 1, right, &det));
    assert_near(det, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_residuals),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_three),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
