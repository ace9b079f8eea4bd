/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Response surfaces against what they are made of: polynomials come back, what a point left out misses is what a surface
   without it misses, kinks are said to be off by. */
#include "chance/random.h"
#include "chance/surface.h"
#include "chance_test.h"

enum { DIMENSIONS = 3, MOST = 400 };
static double z[MOST * DIMENSIONS], y[MOST * 2];

static void place_points(size_t n) {
    for (size_t i = 0; i < n; i++)
        for (size_t v = 0; v < DIMENSIONS; v++)
            z[i * DIMENSIONS + v] = 2 * fw_chance_uniform(7, i, v) - 1;
}

/* column 0 is of the third degree, column 1 has a kink */
static void values(const double *at, double *out) {
    const double a = at[0], b = at[1], c = at[2];
    out[0] = 3 - 2 * a + a * b * c - 0.5 * b * b * b + 4 * c * c;
    out[1] = fabs(a + 0.3 * b) + c;
}

static fw_chance_surface fit(size_t n, size_t columns) {
    fw_chance_surface s;
    for (size_t i = 0; i < n; i++) {
        double both[2];
        values(z + i * DIMENSIONS, both);
        for (size_t c = 0; c < columns; c++)
            y[i * columns + c] = both[c];
    }
    assert_int_equal(fw_chance_surface_fit(arena, n, DIMENSIONS, z, columns, y, &s), FW_OK);
    return s;
}

static void terms(void **state) {
    (void)state;
    assert_int_equal(fw_chance_surface_terms(3, 0), 1);
    assert_int_equal(fw_chance_surface_terms(3, 1), 4);
    assert_int_equal(fw_chance_surface_terms(3, 4), 35);
    assert_int_equal(fw_chance_surface_terms(12, 3), 455);
}

static void a_polynomial_comes_back(void **state) {
    (void)state;
    place_points(150);
    fw_chance_surface s = fit(150, 2);
    double work[FW_CHANCE_SURFACE_TERMS], is[2], said[2], worst = 0;
    assert_int_equal(s.degree, 4);
    assert_true(s.missed[0] < 1e-12);
    assert_true(s.degree_of[0] >= 3);
    for (uint64_t i = 0; i < 3000; i++) {
        const double at[DIMENSIONS] = {2 * fw_chance_uniform(8, i, 0) - 1,
                                       2 * fw_chance_uniform(8, i, 1) - 1,
                                       2 * fw_chance_uniform(8, i, 2) - 1};
        values(at, is);
        fw_chance_surface_at(&s, at, work, said);
        assert_near(said[0], is[0], 1e-12);
        worst = fmax(worst, fabs(said[1] - is[1]));
    }
    /* a kink is no polynomial: what is missed says so, and is no small part of the worst of twenty times as many points */
    assert_true(s.missed[1] > 0.1 && worst > 0.1);
    assert_true(worst < 2 * s.missed[1]);
}

/* a surface of all points but one, at that one */
static void a_point_left_out_is_missed_by_as_much(void **state) {
    (void)state;
    enum { N = 14 }; /* enough for a plane, not for the second degree */
    place_points(N);
    double work[FW_CHANCE_SURFACE_TERMS], worst = 0;
    fw_chance_surface all = fit(N, 2);
    assert_int_equal(all.degree, 1);
    for (size_t out = 0; out < N; out++) {
        double left[DIMENSIONS], is[2], said[2];
        memcpy(left, z + out * DIMENSIONS, sizeof left);
        memcpy(z + out * DIMENSIONS, z + (N - 1) * DIMENSIONS, sizeof left);
        fw_chance_surface s = fit(N - 1, 2);
        place_points(N);
        values(left, is);
        fw_chance_surface_at(&s, left, work, said);
        if (s.degree_of[1] == all.degree_of[1]) worst = fmax(worst, fabs(said[1] - is[1]));
    }
    assert_near(worst, all.missed[1], 1e-12 * worst);
}

static void too_few_or_all_in_a_line_are_no_surface(void **state) {
    (void)state;
    place_points(MOST);
    assert_int_equal(fit(11, 1).terms, 0);
    assert_int_equal(fit(12, 1).degree, 1);
    for (size_t i = 0; i < 60; i++)
        for (size_t v = 1; v < DIMENSIONS; v++)
            z[i * DIMENSIONS + v] = z[i * DIMENSIONS];
    assert_int_equal(fit(60, 1).terms, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(terms),
                                       cmocka_unit_test(a_polynomial_comes_back),
                                       cmocka_unit_test(a_point_left_out_is_missed_by_as_much),
                                       cmocka_unit_test(too_few_or_all_in_a_line_are_no_surface)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
