/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Control charts: limits against worked examples and against the definition of their factors, rules, and charts that have
   too few points. */
#include "recipe/asrun_parts.h"
#include "test.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 400 };
static fw_recipe_chart_point point[MOST];

static fw_recipe_chart chart(int n) {
    return (fw_recipe_chart){.title = "t",
                             .unit = "um",
                             .low = (double)NAN,
                             .high = (double)NAN,
                             .point = point,
                             .npoint = n};
}

static uint64_t seed = 3;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return ((double)(seed >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) {
    return sqrt(-2.0 * log(uniform())) * cos(2.0 * acos(-1.0) * uniform());
}

/* A2 = 3/(d2 sqrt n), D4 = 1 + 3 d3/d2, D3 = max(1 - 3 d3/d2, 0), d2 and d3 mean and deviation of the range of n normal
   values, here of 400000 draws */
static void factors(void **state) {
    (void)state;
    double A2, D3, D4;
    for (int n = 2; n <= 10; n++) {
        int draws = test_cases(400000, 100000);
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < draws; i++) {
            double low = (double)INFINITY, high = -(double)INFINITY;
            for (int k = 0; k < n; k++) {
                double x = normal();
                low = fmin(low, x), high = fmax(high, x);
            }
            sum += high - low, squares += (high - low) * (high - low);
        }
        double d2 = sum / draws, d3 = sqrt(squares / draws - d2 * d2);
        assert_true(fw_recipe_chart_factors(n, &A2, &D3, &D4));
        assert_near(A2, 3.0 / (d2 * sqrt(n)), 0.006 * A2);
        assert_near(D4, 1.0 + 3.0 * d3 / d2, 0.012);
        assert_near(D3, fmax(1.0 - 3.0 * d3 / d2, 0.0), 0.012);
    }
    assert_false(fw_recipe_chart_factors(1, &A2, &D3, &D4));
    assert_false(fw_recipe_chart_factors(11, &A2, &D3, &D4));
}

/* ten batches of one value each: mean 52.0, mean moving range 16/9 */
static void individuals(void **state) {
    (void)state;
    static const double x[] = {52, 50, 53, 51, 52, 54, 50, 52, 53, 53};
    for (int i = 0; i < 10; i++)
        point[i] = (fw_recipe_chart_point){.label = "1", .mean = x[i], .n = 1};
    fw_recipe_chart c = chart(10);
    fw_recipe_chart_judge(&c);
    assert_true(c.limits && c.size == 1);
    double MR = (2 + 3 + 2 + 1 + 2 + 4 + 2 + 1 + 0) / 9.0;
    assert_near(c.centre, 52.0, 1e-12);
    assert_near(c.range_centre, MR, 1e-12);
    assert_near(c.upper, 52.0 + 2.66 * MR, 1e-12);
    assert_near(c.lower, 52.0 - 2.66 * MR, 1e-12);
    assert_near(c.range_upper, 3.267 * MR, 1e-12);
    assert_near(c.range_lower, 0.0, 0.0);
    assert_true(isnan(point[0].range));
    for (int i = 0; i < 10; i++)
        assert_false(point[i].beyond || point[i].run || point[i].range_beyond);
}

static void subgroups(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++)
        point[i] = (fw_recipe_chart_point){
            .label = "1", .mean = 10.0 + (i % 2 ? 0.05 : -0.05), .range = 0.2, .n = 5};
    point[7].mean = 10.2;
    point[12].range = 0.9;
    fw_recipe_chart c = chart(20);
    fw_recipe_chart_judge(&c);
    double R = (19 * 0.2 + 0.9) / 20.0, m = (9 * 10.05 + 10 * 9.95 + 10.2) / 20.0;
    assert_near(c.centre, m, 1e-12);
    assert_near(c.upper, m + 0.577 * R, 1e-12);
    assert_near(c.range_upper, 2.114 * R, 1e-12);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(point[i].beyond, i == 7);
        assert_int_equal(point[i].range_beyond, i == 12);
        assert_false(point[i].run);
    }
}

/* eight on one side: the eighth and further, not the seventh; a point on the centre ends a run */
static void runs(void **state) {
    (void)state;
    for (int i = 0; i < 18; i++)
        point[i] =
            (fw_recipe_chart_point){.label = "1", .mean = i < 9 ? 1.1 : 0.9, .range = 0.5, .n = 3};
    fw_recipe_chart c = chart(18);
    fw_recipe_chart_judge(&c);
    for (int i = 0; i < 18; i++)
        assert_int_equal(point[i].run, i % 9 >= 7);
    point[0].mean = 1.0, point[1].mean = 1.2; /* the centre stays */
    fw_recipe_chart_judge(&c);
    assert_true(point[8].run);
    assert_false(point[7].run);
}

/* seven are too few; sizes that differ: the most frequent one has the limits */
static void too_few(void **state) {
    (void)state;
    for (int i = 0; i < 7; i++)
        point[i] = (fw_recipe_chart_point){.label = "1", .mean = i, .range = 0.1, .n = 5};
    fw_recipe_chart c = chart(7);
    fw_recipe_chart_judge(&c);
    assert_false(c.limits);
    for (int i = 0; i < 7; i++)
        assert_false(point[i].beyond || point[i].run);
    for (int i = 7; i < 15; i++)
        point[i] = (fw_recipe_chart_point){.label = "1", .mean = 3, .range = 0.1, .n = 2};
    point[3].mean = 300.0;
    c = chart(15);
    fw_recipe_chart_judge(&c);
    assert_true(c.limits && c.size == 2 && c.counted == 8);
    assert_false(point[3].beyond);
    c = chart(0);
    fw_recipe_chart_judge(&c);
    assert_false(c.limits);
}

static void picture(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text out = fw_text_new(arena);
    for (int i = 0; i < 24; i++)
        point[i] = (fw_recipe_chart_point){
            .label = "<w>", .mean = 5.0 + 0.1 * (i % 3), .range = 0.2, .n = 5};
    fw_recipe_chart c = chart(24);
    c.high = 5.3;
    fw_recipe_chart_judge(&c);
    fw_recipe_chart_svg(&c, &out);
    assert_int_equal(fw_text_end(&out), FW_OK);
    assert_non_null(strstr(out.data, "UCL"));
    assert_non_null(strstr(out.data, "&lt;w&gt;"));
    assert_null(strstr(out.data, "nan"));
    assert_null(strstr(out.data, "inf"));
    /* all values zero, and one point alone */
    for (int n = 1; n <= 24; n += 23) {
        for (int i = 0; i < n; i++)
            point[i] = (fw_recipe_chart_point){.label = "1", .mean = 0.0, .n = 1};
        fw_text flat = fw_text_new(arena);
        c = chart(n);
        fw_recipe_chart_judge(&c);
        fw_recipe_chart_svg(&c, &flat);
        assert_int_equal(fw_text_end(&flat), FW_OK);
        assert_null(strstr(flat.data, "nan"));
        assert_null(strstr(flat.data, "inf"));
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(factors),   cmocka_unit_test(individuals),
                                       cmocka_unit_test(subgroups), cmocka_unit_test(runs),
                                       cmocka_unit_test(too_few),   cmocka_unit_test(picture)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
