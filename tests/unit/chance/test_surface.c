/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Response surfaces against what they are made of: polynomials come back, what a point left out misses is what a surface
   without it misses, kinks are said to be off by. */
#include "chance/random.h"
#include "chance/joint.h"
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
    assert_int_equal(fw_chance_surface_terms(3, 0, 3), 1);
    assert_int_equal(fw_chance_surface_terms(3, 1, 3), 4);
    assert_int_equal(fw_chance_surface_terms(3, 4, 12), 35);
    assert_int_equal(fw_chance_surface_terms(12, 3, 3), 455);
    assert_int_equal(fw_chance_surface_terms(15, 3, 2), 1 + 15 * 3 + 105 * 3);
}

/* of 15 variables: pairs come back to the third degree, a product of three is in what is missed */
static void of_many_variables_pairs(void **state) {
    (void)state;
    enum { MANY = 15, N = 1100 };
    double *at = fw_arena_array(arena, double, N * MANY), *of = fw_arena_array(arena, double, 2 * N);
    fw_chance_surface s;
    assert_non_null(at);
    assert_non_null(of);
    for (size_t i = 0; i < N; i++) {
        double *a = at + i * MANY;
        for (size_t v = 0; v < MANY; v++)
            a[v] = 2 * fw_chance_uniform(9, i, v) - 1;
        of[2 * i] = 1 + a[0] * a[14] * a[14] - 2 * a[3] * a[7] + a[5] * a[5] * a[5];
        of[2 * i + 1] = of[2 * i] + 0.3 * a[1] * a[2] * a[4];
    }
    assert_int_equal(fw_chance_surface_fit(arena, N, MANY, at, 2, of, &s), FW_OK);
    assert_int_equal(s.terms, 361);
    assert_int_equal(s.degree, 3);
    assert_true(s.missed[0] < 1e-12);
    assert_true(s.missed[1] > 0.1 && s.missed[1] < 1);
}

/* values that are only known where they are not small go by a surface of the others */
static void what_some_points_lack_is_filled(void **state) {
    (void)state;
    double missed, worst = 0;
    place_points(150);
    for (size_t i = 0; i < 150; i++) {
        const double *at = z + i * DIMENSIONS, is = 1 + at[0] + 0.5 * at[1] * at[2];
        y[2 * i] = 7, y[2 * i + 1] = is > 0.4 ? is : 0;
    }
    assert_int_equal(fw_chance_surface_fill(arena, 150, DIMENSIONS, z, 2, 1, y, &missed), FW_OK);
    for (size_t i = 0; i < 150; i++) {
        const double *at = z + i * DIMENSIONS, is = 1 + at[0] + 0.5 * at[1] * at[2];
        assert_near(y[2 * i], 7, 0);
        worst = fmax(worst, fabs(y[2 * i + 1] - is));
    }
    assert_true(worst < 1e-9 && missed < 1e-12);
    assert_int_equal(fw_chance_surface_fill(arena, 150, DIMENSIONS, z, 2, 0, y, &missed), FW_OK);
    assert_true(missed == 0); /* all have one */
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
                                       cmocka_unit_test(of_many_variables_pairs),
                                       cmocka_unit_test(what_some_points_lack_is_filled),
                                       cmocka_unit_test(a_point_left_out_is_missed_by_as_much),
                                       cmocka_unit_test(too_few_or_all_in_a_line_are_no_surface)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
