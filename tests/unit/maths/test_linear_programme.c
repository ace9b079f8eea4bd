/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Known programmes, and the best vertex of random ones by looking at all of them. */
#include "maths/matrix.h"
#include "test.h"

static uint64_t seed = 5;
static double random_part(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static void known(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    /* x + y >= 2, x <= 1.5, y <= 3 at the cost x + 2 y: (1.5, 0.5) */
    const double a[] = {-1, -1, 1, 0, 0, 1}, b[] = {-2, 1.5, 3}, c[] = {1, 2};
    fw_maths_linear_programme p = {2, 3, 1, a, b, c, 100};
    double x[2], t;
    bool solved;
    assert_int_equal(fw_maths_linear_programme_solve(arena, &p, x, &t, &solved), FW_OK);
    assert_true(solved);
    assert_near(x[0], 1.5, 1e-12);
    assert_near(x[1], 0.5, 1e-12);
    assert_near(t, 0, 1e-12);
    /* x >= 2 cannot be held with x <= 1.5: exceeded by as little as can be */
    const double a2[] = {-1, 1}, b2[] = {-2, 1.5}, c2[] = {1};
    p = (fw_maths_linear_programme){1, 2, 1, a2, b2, c2, 100};
    assert_int_equal(fw_maths_linear_programme_solve(arena, &p, x, &t, &solved), FW_OK);
    assert_true(solved);
    assert_near(x[0], 1.5, 1e-12);
    assert_near(t, 0.5, 1e-12);
    /* nothing is exceeded: nothing is changed */
    const double b3[] = {2, 1.5};
    p.b = b3;
    assert_int_equal(fw_maths_linear_programme_solve(arena, &p, x, &t, &solved), FW_OK);
    assert_true(solved && x[0] == 0 && t == 0);
    fw_arena_free(arena);
}

enum { ROWS = 6 };

static bool holds(const double a[ROWS][2], const double *b, double x, double y) {
    for (int i = 0; i < ROWS; i++)
        if (a[i][0] * x + a[i][1] * y > b[i] + 1e-9) return false;
    return x > -1e-9 && y > -1e-9;
}

/* of two unknowns, all vertices: where two of the rows and the axes meet */
static double best_vertex(const double a[ROWS][2], const double *b, const double *c) {
    double best = HUGE_VAL;
    for (int i = 0; i < ROWS + 2; i++)
        for (int k = i + 1; k < ROWS + 2; k++) {
            const double u[2] = {i < ROWS ? a[i][0] : i == ROWS, i < ROWS ? a[i][1] : i > ROWS};
            const double v[2] = {k < ROWS ? a[k][0] : k == ROWS, k < ROWS ? a[k][1] : k > ROWS};
            const double p = i < ROWS ? b[i] : 0, q = k < ROWS ? b[k] : 0;
            const double det = u[0] * v[1] - u[1] * v[0];
            if (fabs(det) < 1e-9) continue;
            const double x = (p * v[1] - u[1] * q) / det, y = (u[0] * q - v[0] * p) / det;
            if (holds(a, b, x, y)) best = fmin(best, c[0] * x + c[1] * y);
        }
    return best;
}

static void random_ones(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    int possible = 0, impossible = 0;
    for (int k = 0; k < 3000; k++) {
        double a[ROWS][2], b[ROWS], c[2] = {random_part(), random_part()}, x[2], t;
        bool solved;
        for (int i = 0; i < ROWS; i++) {
            a[i][0] = 2 * random_part() - 1, a[i][1] = 2 * random_part() - 1;
            b[i] = i < 4 ? 2 * random_part() - 0.8 : random_part();
        }
        const fw_maths_linear_programme p = {2, ROWS, 4, &a[0][0], b, c, 1e4};
        assert_int_equal(fw_maths_linear_programme_solve(arena, &p, x, &t, &solved), FW_OK);
        assert_true(solved && x[0] >= 0 && x[1] >= 0 && t >= 0);
        const double best = best_vertex(a, b, c);
        if (isinf(best)) {
            assert_true(t > 1e-7);
            impossible++;
            continue;
        }
        possible++;
        if (t > 1e-9 || fabs(c[0] * x[0] + c[1] * x[1] - best) > 1e-7)
            fail_msg("case %d: %.12g, %.12g is best, t %g", k, c[0] * x[0] + c[1] * x[1], best, t);
    }
    assert_true(possible > 300 && impossible > 300);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(known), cmocka_unit_test(random_ones)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
