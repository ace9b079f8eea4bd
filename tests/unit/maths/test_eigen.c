/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "maths/matrix.h"
#include "test.h"
#include <stdbool.h>

static double next(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-52 - 1;
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
        assert_int_equal(fw_maths_eigen_general(arena, N, a, re, im, x), FW_OK);
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

/* x^n = 1: the roots of unity, from the cyclic shift */
static void roots_of_unity(void **state) {
    (void)state;
    enum { N = 12 };
    fw_arena *arena = fw_arena_new(0);
    double a[N * N] = {0}, re[N], im[N], x[N * N], pi = acos(-1.0), sum = 0;
    for (int i = 0; i < N; i++)
        a[i * N + (i + 1) % N] = 1;
    assert_int_equal(fw_maths_eigen_general(arena, N, a, re, im, x), FW_OK);
    for (int k = 0; k < N; k++) {
        double turn = N * atan2(im[k], re[k]) / (2 * pi);
        assert_near(hypot(re[k], im[k]), 1, 1e-14);
        assert_near(turn, round(turn), 1e-13);
        sum += re[k];
    }
    assert_near(sum, 0, 1e-14);
    fw_arena_free(arena);
}

static void refusals(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    double a[4] = {1, (double)NAN, 0, 1}, b[4] = {2, 1, 1, 3}, s[2], l[2], r[4];
    assert_int_equal(fw_maths_eigen_general(arena, 2, a, s, l, r), FW_SOLVER);
    assert_int_equal(fw_maths_eigen_general(arena, 0, a, s, l, r), FW_OK);
    fw_arena_fail_at(1, 1);
    fw_status status = fw_maths_eigen_general(arena, 2, b, s, l, r);
    fw_arena_fail_at(0, 0);
    assert_int_equal(status, FW_NOMEM);
    fw_arena_free(arena);
}

/* a large one is the same problem, and whoever is asked to stop does not wait for its end */
static void stops_in_time(void **state) {
    (void)state;
    enum { N = 300 };
    fw_arena *arena = fw_arena_new(0);
    fw_cancel cancel = {0};
    fw_arena_stop_with(arena, &cancel);
    double *a = fw_arena_array(arena, double, N * N), *copy = fw_arena_array(arena, double, N * N),
           *x = fw_arena_array(arena, double, N * N), re[N], im[N], apart = 0;
    uint64_t seed = 7;
    assert_true(a && copy && x);
    for (int i = 0; i < N * N; i++)
        copy[i] = a[i] = next(&seed);
    assert_int_equal(fw_maths_eigen_general(arena, N, a, re, im, x), FW_OK);
    for (int k = 0; k < N; k++) {
        if (im[k] != 0) continue;
        for (int i = 0; i < N; i++) {
            double left = -re[k] * x[k * N + i];
            for (int j = 0; j < N; j++)
                left += copy[i * N + j] * x[k * N + j];
            apart = fmax(apart, fabs(left));
        }
    }
    assert_true(apart < 1e-11);
    memcpy(a, copy, N * N * sizeof *a);
    fw_cancel_request(&cancel, 1);
    assert_int_equal(fw_maths_eigen_general(arena, N, a, re, im, x), FW_CANCELLED);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(general_pairs_satisfy_their_equation),
        cmocka_unit_test(roots_of_unity),
        cmocka_unit_test(refusals),
                                       cmocka_unit_test(stops_in_time)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
